-- | Random lines with canned cycles, and the moves that the reader of files makes of them.
module Generate.CannedCycle
  ( lines',
    readMoves,
    ofCanonical,
    distinct,
  )
where

import Base.Decimal qualified as Decimal
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Gcode.ModalState (MotionMode (..))
import Gcode.Run (Action (..), Coordinate (..), Step (..), ToolPlace (..), Travel (..))
import Gcode.Run qualified as Run
import LinuxCnc (Canonical (..), Position (..))
import Machine.Machine qualified as Machine
import Machines qualified
import Test.QuickCheck

-- | Lines for LinuxCNC: a position, and cycles of all kinds with G98 and G99, some of which repeat
-- only what changes.
lines' :: Gen [Text]
lines' = do
  z <- value (-2, 20)
  count <- chooseInt (1, 5)
  blocks <- vectorOf count block
  pure (["M3 S500", "G0 X1.000 Y2.000 Z" <> z] <> concat blocks)
  where
    block = do
      code <- elements ["G81", "G82", "G83", "G73", "G85"]
      back <- elements ["G98", "G99"]
      (x, y) <- (,) <$> value (-50, 50) <*> value (-50, 50)
      r <- fives 0 (0, 6)
      bottom <- fives 1 (-15, -1)
      more <- vectorOf' 3 $ do
        (x', y') <- (,) <$> value (-50, 50) <*> value (-50, 50)
        z' <- fives 1 (-15, -1)
        elements ["X" <> x' <> " Y" <> y', "X" <> x', "Y" <> y' <> " Z" <> z']
      q <- fives 0 (1, 5)
      up <- value (5, 20)
      pure $
        [ Text.unwords
            ( [back, code, "X" <> x, "Y" <> y, "Z" <> bottom, "R" <> r]
                <> ["P0.2" | code == "G82"]
                <> ["Q" <> q | code `elem` ["G83", "G73"]]
                <> ["F100"]
            )
        ]
          <> more
          <> ["G80", "G0 Z" <> up]
    vectorOf' most one = chooseInt (0, most) >>= \n -> vectorOf n one

-- | A length in mm: a multiple of 0.005 mm and so many thousandths more. So no depth is a multiple
-- of a peck: then LinuxCNC may make one peck more, of no depth, because it rounds.
fives :: Int -> (Int, Int) -> Gen Text
fives more (low, high) = thousandths . (+ more) . (5 *) <$> chooseInt (200 * low, 200 * high)

-- | A length in mm with three decimals.
value :: (Int, Int) -> Gen Text
value (low, high) = thousandths <$> chooseInt (1000 * low, 1000 * high)

thousandths :: Int -> Text
thousandths = Decimal.fixed 3 . (/ 1000) . fromIntegral

-- | The ends of the moves of lines: true for a rapid move, and the position in mm.
readMoves :: [Text] -> [(Bool, [Double])]
readMoves written = case Run.run form Nothing 1 (Text.unlines ("G21 G17 G90 G94 G40" : written)) of
  Left fault -> error (show fault)
  Right steps ->
    [ (mode t == RapidMode, map coordinate [placeX (to t), placeY (to t), placeZ (to t)])
      | Travels t <- map action steps
    ]
  where
    form =
      fromMaybe (error "no form") (Machine.programForm (Machines.named "linuxcnc-mill"))
    coordinate c = case c of
      At p -> Run.picometres p
      _ -> 0 / 0

-- | The end of a canonical move in the same form.
ofCanonical :: Canonical -> (Bool, [Double])
ofCanonical call = case call of
  Traverse (Position x y z) -> (True, [x, y, z])
  Feeding _ (Position x y z) -> (False, [x, y, z])
  Rounding _ _ _ (Position x y z) -> (False, [x, y, z])

-- | Moves without those that go nowhere. The first one comes from 0.
distinct :: [(Bool, [Double])] -> [(Bool, [Double])]
distinct = go [0, 0, 0]
  where
    go at moves = case moves of
      [] -> []
      m@(_, p) : more
        | and (zipWith (\a b -> abs (a - b) < 1.0e-4) at p) -> go p more
        | otherwise -> m : go p more
