-- | Reads the section @controller@ of a description, and checks it against the other sections.
--
-- The line @interpolator@ names the kind of control. It decides which other keys the section has.
module Machine.ControllerFromText
  ( controller,
    check,
  )
where

import Base.Quantity (Seconds (..))
import Base.Region (Located (..), Region)
import Base.Result (Result)
import Base.Result qualified as Result
import Data.List (sortOn)
import Data.Maybe (isJust)
import Data.Text (Text)
import Machine.Controller
import Machine.ControllerError (ControllerFault (..))
import Machine.Error (Error (..))
import Machine.FrameFromText (quotedText)
import Machine.Machine
  ( Arcs (..),
    Axis (..),
    CommandName (..),
    FeedMeasure (..),
    Machine,
    NumberForm (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Machine.Section
import Machine.Syntax (Argument, Argument_ (..), Statement (..))

-- | Kind of control that the line @interpolator@ names.
data ControlKind
  = AnalyserKind
  | EvaluationKind
  | IntegratorKind
  | PlannerKind

-- | Reads the section @controller@.
controller :: Statement -> Result w Error Controller
controller s = do
  ((), section) <- withBlock ["controller { … }"] "the controller" noArguments s
  kind <- required "interpolator" "interpolator differential-analyser" kindFrom section
  case kind of
    AnalyserKind -> Stepping <$> stepControl DifferentialAnalyser section
    EvaluationKind -> Stepping <$> stepControl EvaluationFunction section
    IntegratorKind -> Integrating <$> integratorControl section
    PlannerKind -> Planning <$> pathControl section
  where
    kindFrom =
      choice
        [ ("differential-analyser", AnalyserKind),
          ("evaluation-function", EvaluationKind),
          ("feed-integrator", IntegratorKind),
          ("path-planner", PlannerKind)
        ]

stepControl :: InterpolationMethod -> DescriptionSection -> Result w Error StepControl
stepControl method section =
  StepControl method
    <$> required "clock" "clock 1000000 Hz" clockFrom section
    <*> optional "ramp" Nothing (fmap Just . rampFrom) section
    <*> required "reader" "reader 300 rows/s" (optionalReader section) section
    <*> limitsFrom section
    <* allowKeys
      ( ["interpolator", "clock", "ramp", "reader", "start-time", "frames-ahead", "fault-signal"]
          <> limitKeys
      )
      []
      section
  where
    optionalReader whole s = case map value (arguments s) of
      [Word "none"] -> pure Nothing
      _ -> Just <$> readerFrom whole s
    rampFrom = withArguments ["ramp 5 mm/s2 every 1 ms"] oneRamp
    oneRamp args = case args of
      [a, b, Located _ (Word "every"), c, d] ->
        liftedPair SpeedRamp (accelerationIn a b) (timeIn "the time between two changes" c d)
      _ -> Nothing

integratorControl :: DescriptionSection -> Result w Error IntegratorControl
integratorControl section =
  IntegratorControl
    <$> required "clock" "clock 80000 Hz" clockFrom section
    <*> required "capacity" "capacity 26 bits" (countWith "capacity" 8 40 "bits") section
    <*> required "reader" "reader 300 rows/s" (readerFrom section) section
    <*> required "acceleration" "acceleration 5 mm/s2" accelerationFrom section
    <*> required "override" "override 0 50 100" overrideFrom section
    <*> required "cycle-line" "cycle-line 4 ticks" (ticksFrom "cycle-line") section
    <*> required "cycle-arc" "cycle-arc 8 ticks" (ticksFrom "cycle-arc") section
    <*> optional "switches" 0 (countWith "switches" 0 99 "") section
    <*> limitsFrom section
    <*> (sortOn priority <$> jobsFrom section)
    <* allowKeys keys ["job"] section
  where
    keys =
      [ "interpolator",
        "clock",
        "capacity",
        "reader",
        "start-time",
        "fault-signal",
        "acceleration",
        "override",
        "cycle-line",
        "cycle-arc",
        "switches"
      ]
        <> limitKeys
    overrideFrom = withArguments ["override 0 50 100"] positions
    positions args
      | null args = Nothing
      | otherwise = sequence <$> traverse (wholeIn "the position of the switch" 0 200) args

pathControl :: DescriptionSection -> Result w Error PathControl
pathControl section =
  PathControl
    <$> required "acceleration" "acceleration 500 mm/s2" accelerationFrom section
    <*> required "corners" "corners exact-stop" cornersFrom section
    <* allowKeys ["interpolator", "acceleration", "corners"] [] section
  where
    cornersFrom = choice [("exact-stop", ExactStop), ("blended", Blending)]

-- | Reads what the drives of the axes can follow.
limitsFrom :: DescriptionSection -> Result w Error FrequencyLimits
limitsFrom section =
  FrequencyLimits
    <$> optional "highest-frequency" Nothing (fmap Just . frequency "highest-frequency") section
    <*> optional "largest-jump" Nothing (fmap Just . frequency "largest-jump") section
  where
    frequency word = withArguments [word <> " 900 Hz"] (one word)
    one word args = case args of
      [a, b] -> quantityIn ("‘" <> word <> "’") "Hz" 10000000 a b
      _ -> Nothing

limitKeys :: [Text]
limitKeys = ["highest-frequency", "largest-jump"]

-- | Reads the reader of the tape from the line @reader@ and from other lines of the section.
readerFrom :: DescriptionSection -> Statement -> Result w Error TapeReader
readerFrom section s =
  TapeReader
    <$> withArguments ["reader 300 rows/s", "reader none"] speed s
    <*> optional "start-time" (Seconds 0) startFrom section
    <*> optional "frames-ahead" 1 (countWith "frames-ahead" 1 2 "") section
    <*> optional "fault-signal" Nothing (fmap Just . quotedText) section
  where
    speed args = case args of
      [a, b] -> quantityIn "the speed of the reader" "rows/s" 100000 a b
      _ -> Nothing
    startFrom = withArguments ["start-time 20 ms"] oneTime
    oneTime args = case args of
      [Located _ (Number _ 0), Located _ (Word u)] | u `elem` ["s", "ms"] -> Just (pure (Seconds 0))
      [a, b] -> timeIn "the time" a b
      _ -> Nothing

-- Jobs --------------------------------------------------------------------------------------------

-- | Reads all jobs. Two jobs of one name, and two jobs of one priority, are reported.
jobsFrom :: DescriptionSection -> Result w Error [ControlJob]
jobsFrom section = do
  found <- allWith "job" jobFrom section
  Result.failing (repetitions found) (map value found)
  where
    repetitions found =
      concat
        [ [Twice r "a job" first | Located first b <- take k found, jobName b == jobName a]
            <> [ Twice r "a priority" first
                 | Located first b <- take k found,
                   priority b == priority a
               ]
          | (k, Located r a) <- zip [0 ..] found
        ]

jobFrom :: Statement -> Result w Error (Located ControlJob)
jobFrom s = do
  (name, section) <- withBlock ["job indication { … }"] "the job" nameOf s
  job <-
    ControlJob name
      <$> required "length" "length 4 ticks" (ticksFrom "length") section
      <*> required "priority" "priority 3" (countWith "priority" 1 99 "") section
      <*> required "request" "request every 100 ms" requestFrom section
      <* allowKeys ["length", "priority", "request"] [] section
  pure (Located (extent s) job)
  where
    nameOf args = case map value args of
      [Word w] -> Just (pure w)
      _ -> Nothing

requestFrom :: Statement -> Result w Error JobRequest
requestFrom =
  withArguments
    [ "request every 100 ms",
      "request character",
      "request number",
      "request transfer",
      "request compensation",
      "request direction 16 8 cycles",
      "request acceleration 5 ms",
      "request command T 20 ms 50 times"
    ]
    one
  where
    one args = case args of
      [Located _ (Word "every"), a, b] -> fmap Periodic <$> time a b
      [Located _ (Word "character")] -> Just (pure AtCharacter)
      [Located _ (Word "number")] -> Just (pure AtNumber)
      [Located _ (Word "transfer")] -> Just (pure AtTransfer)
      [Located _ (Word "compensation")] -> Just (pure AtCompensation)
      [Located _ (Word "direction"), a, b, Located _ (Word "cycles")] ->
        liftedPair AtDirection (wholeIn cycles 1 10000 a) (wholeIn cycles 0 10000 b)
      [Located _ (Word "acceleration"), a, b] -> fmap AtAcceleration <$> time a b
      [Located _ (Word "command"), Located _ name, a, b, n, Located _ (Word "times")] ->
        case name of
          Word w -> afterCommand w (time a b) n
          Quoted w -> afterCommand w (time a b) n
          _ -> Nothing
      _ -> Nothing
    afterCommand w t n =
      liftedPair
        (AfterCommand (CommandName w))
        t
        (wholeIn "the count of requests" 1 1000000 n)
    time = timeIn "the time between two requests"
    cycles = "the count of cycles"

-- Numbers -----------------------------------------------------------------------------------------

-- | Reads a line with the key @word@, a whole number from @low@ to @high@, and the word @unit@
-- after it; no word if @unit@ is empty.
countWith :: Text -> Int -> Int -> Text -> Statement -> Result w Error Int
countWith word low high unit = withArguments [example] one
  where
    example = word <> " 4" <> (if unit == "" then "" else " " <> unit)
    one args = case args of
      [a] | unit == "" -> wholeIn ("‘" <> word <> "’") low high a
      [a, Located _ (Word u)] | u == unit && unit /= "" -> wholeIn ("‘" <> word <> "’") low high a
      _ -> Nothing

ticksFrom :: Text -> Statement -> Result w Error Int
ticksFrom word = countWith word 1 100000 "ticks"

clockFrom :: Statement -> Result w Error Int
clockFrom = countWith "clock" 1000 100000000 "Hz"

accelerationFrom :: Statement -> Result w Error Double
accelerationFrom = withArguments ["acceleration 5 mm/s2"] one
  where
    one args = case args of
      [a, b] -> accelerationIn a b
      _ -> Nothing

accelerationIn :: Argument -> Argument -> Maybe (Result w Error Double)
accelerationIn = quantityIn "the acceleration" "mm/s2" 1000000

-- | Reads a time in milliseconds or seconds. @name@ says what the time is.
timeIn :: Text -> Argument -> Argument -> Maybe (Result w Error Seconds)
timeIn name a b = case value b of
  Word "ms" -> fmap (\t -> Seconds (t / 1000)) <$> quantityIn name "ms" 3600000 a b
  _ -> fmap Seconds <$> quantityIn name "s" 3600 a b

-- | Combines two arguments that may not have the form that is read.
liftedPair :: Applicative f => (a -> b -> c) -> Maybe (f a) -> Maybe (f b) -> Maybe (f c)
liftedPair make a b = case (a, b) of
  (Just x, Just y) -> Just (make <$> x <*> y)
  _ -> Nothing

-- Checks ------------------------------------------------------------------------------------------

-- | Checks the controller against the machine. @region@ is that of the section @controller@. The
-- rules:
--
-- * A digital differential analyser makes no arcs, so frames describe none.
-- * A control that makes arcs has the same pulse along x and y.
-- * Frequencies of the leading axis are for a digital differential analyser only.
-- * Words of axes and of centres have at most 'mostDigits' digits.
-- * A job that follows a command names a command that frames can give.
-- * A control with a feed integrator that makes arcs has a job for their direction.
-- * The jobs that come by the clock leave time for the others.
-- * Commands for cutter compensation with a switch need a switch.
check :: Machine -> Region -> Controller -> [Error]
check machine region control = map (BadController region) (common <> special)
  where
    hasArcs = case Machine.arcs machine of
      NoArcs -> False
      Arcs {} -> True
    measure = Machine.feedMeasure (Machine.feeds machine)
    unequal = [UnequalPulses | hasArcs, pulse X /= pulse Y]
    pulse = Machine.resolutionOf machine
    long = [NumberTooLong mostDigits | any tooLong (Machine.wordsOf machine)]
    tooLong w = case content w of
      Machine.Along _ -> digits (form w) > mostDigits
      Machine.Centre _ -> digits (form w) > mostDigits
      _ -> False
    frequencies = [FrequenciesNotForIt | measure == LeadingAxis]
    common = case control of
      Planning _ -> []
      Stepping _ -> long
      Integrating _ -> long
    special = case control of
      Planning _ -> frequencies
      Stepping s -> case interpolation s of
        DifferentialAnalyser -> [ArcsNotForIt | hasArcs]
        EvaluationFunction -> unequal <> frequencies
      Integrating i ->
        unequal
          <> frequencies
          <> [NoDirectionJob | hasArcs, Nothing <- [jobFor isDirection i]]
          <> [ NoSuchCommand c
               | ControlJob {request = AfterCommand name@(CommandName c) _ _} <- jobs i,
                 Nothing <- [Machine.commandCapacity machine name]
             ]
          <> [Overloaded load | let load = timedLoad i, load >= 1]
          <> [NoSwitches | switches i == 0, isJust (compensated >>= Machine.radiusSwitch)]
    compensated = Machine.compensation (Machine.commandWords machine)
    isDirection r = case r of
      AtDirection _ _ -> True
      _ -> False

-- | Part of the time that the jobs need that come by the clock or with each row of the tape.
timedLoad :: IntegratorControl -> Double
timedLoad control =
  sum
    [ fromIntegral (duration j) / fromIntegral ticks
      | j <- jobs control,
        Just ticks <- [requestInterval control (request j)]
    ]

-- | Largest count of digits in the word of an axis for which the model of a controller computes
-- with 64 bits.
mostDigits :: Int
mostDigits = 9
