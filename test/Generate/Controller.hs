-- | Random controllers that fit a machine.
module Generate.Controller
  ( controllerFor,
  )
where

import Base.Quantity (Seconds (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Machine.Controller hiding (capacity)
import Machine.Machine hiding (choose)
import Machine.Machine qualified as Machine
import Test.QuickCheck

-- | A controller that a description of the machine may have; 'Nothing' if none fits, or sometimes.
controllerFor :: Machine -> Gen (Maybe Controller)
controllerFor m = oneof (pure Nothing : [Just <$> kind | not tooLong, kind <- kinds])
  where
    hasArcs = case Machine.arcs m of
      NoArcs -> False
      Arcs {} -> True
    tooLong = or [digits (form w) > 9 | w <- Machine.wordsOf m]
    hasFrequencies = feedMeasure (feeds m) == LeadingAxis
    isEven = Machine.resolutionOf m X == Machine.resolutionOf m Y || not hasArcs
    kinds =
      [Stepping <$> stepping DifferentialAnalyser | not hasArcs]
        <> [Stepping <$> stepping EvaluationFunction | isEven, not hasFrequencies]
        <> [Integrating <$> integrating m | isEven, not hasFrequencies]
        <> [Planning <$> planning | not hasFrequencies]

stepping :: InterpolationMethod -> Gen StepControl
stepping method =
  StepControl method
    <$> choose (1000, 2000000)
    <*> oneof [pure Nothing, Just <$> (SpeedRamp <$> tenths <*> milliseconds)]
    <*> oneof [pure Nothing, Just <$> tapeReader]
    <*> driveLimit

driveLimit :: Gen FrequencyLimits
driveLimit = FrequencyLimits <$> limit <*> limit
  where
    limit = oneof [pure Nothing, Just <$> tenths]

planning :: Gen PathControl
planning = PathControl <$> tenths <*> elements [ExactStop, Blending]

-- | Control with a feed integrator. Its clock is so fast that the jobs below need less than all of
-- the time: each is asked for at most 1000 times a second, and takes at most 50 ticks.
integrating :: Machine -> Gen IntegratorControl
integrating m =
  IntegratorControl
    <$> choose (400000, 2000000)
    <*> choose (8, 40)
    <*> ((\r -> r {framesAhead = 1}) <$> tapeReader)
    <*> tenths
    <*> (NonEmpty.toList . NonEmpty.fromList <$> listOf1 (choose (0, 200)))
    <*> choose (1, 20)
    <*> choose (1, 20)
    <*> choose (0, 99)
    <*> driveLimit
    <*> (zipWith ($) <$> traverse job requests <*> pure [1 ..])
  where
    job (n, r) = (\k t p -> ControlJob n k p t) <$> choose (1, 50) <*> r
    requests :: [(Text, Gen JobRequest)]
    requests =
      [ ("transfer", pure AtTransfer),
        ("direction", AtDirection <$> choose (1, 40) <*> choose (0, 40)),
        ("character", pure AtCharacter),
        ("number", pure AtNumber),
        ("equidistant", pure AtCompensation),
        ("acceleration", AtAcceleration <$> milliseconds),
        ("indication", Periodic <$> milliseconds)
      ]
        <> [ (n, AfterCommand c <$> milliseconds <*> choose (1, 60))
             | (n, w) <- zip ["a", "b"] (Machine.wordsOf m),
               Command c <- [content w]
           ]

tapeReader :: Gen TapeReader
tapeReader =
  TapeReader
    <$> tenths
    <*> oneof [pure (Seconds 0), milliseconds]
    <*> choose (1, 2)
    <*> elements [Nothing, Just "ошибка считывания"]

-- | A positive number with one decimal.
tenths :: Gen Double
tenths = (/ 10) . fromIntegral <$> choose (1 :: Int, 10000)

milliseconds :: Gen Seconds
milliseconds = (\n -> Seconds (fromIntegral n / 1000)) <$> choose (1 :: Int, 1000)
