-- | Tapes that cut the same as those of the compiler in another way: lines are divided at points of
-- the grid, lines in one direction are joined, curves have other chords, and closed contours begin
-- elsewhere.
module Generate.RightTape
  ( otherwiseDivided,
    withOtherChords,
    otherStarts,
    lineMachine,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), times)
import Base.Region (Located (..))
import Data.Function (on)
import Data.List (groupBy)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Frame.Frame (Frame (..), FrameMotion (..), FrameProgram (..), PlannedFrame (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (..), Machine)
import Machine.Machine qualified as Machine
import Part.ContourStart qualified as ContourStart
import Part.Part (Part)
import Part.Part qualified as Part
import Test.QuickCheck

-- | A tape with the same path in other frames. Frames with commands, and braking frames, stay.
-- Frames with different roles are not joined.
otherwiseDivided :: Machine -> FrameProgram -> Gen [Frame]
otherwiseDivided machine program =
  concatMap (joined (fits machine))
    <$> traverse (fmap concat . traverse flagged) (groupBy ((==) `on` role) (plannedFrames program))
  where
    flagged p = divided (frame p) >>= traverse keptOrNot
    keptOrNot f = (,) f <$> frequency [(3, pure False), (1, pure True)]

-- | The part with smaller tolerances: its tape has other chords, and is right for the part itself,
-- too.
withOtherChords :: Part -> Gen Part
withOtherChords part = do
  share <- elements [0.3, 0.6, 0.9, 1]
  pure part {Part.operations = map (narrowed share) (Part.operations part)}
  where
    narrowed share o = case o of
      Part.Mill (Located at m) -> Part.Mill (Located at (finer share m))
      Part.Pocket (Located at p) ->
        Part.Pocket (Located at p {Part.wall = finer share (Part.wall p)})
      _ -> o
    finer share m = m {Part.tolerance = smaller share (Part.tolerance m)}
    smaller share t = case t of
      Part.OnPath e -> Part.OnPath (times share e)
      Part.Band a b -> Part.Band (times share a) (times share b)

-- | The machine without arcs: it makes chords of them. The machine itself if its feed codes do not
-- say the feed along the path: the chords of an arc may then need other codes than the arc.
lineMachine :: Machine -> Machine
lineMachine machine = case Machine.feedMeasure (Machine.feeds machine) of
  Machine.AlongPath -> machine {Machine.arcs = Machine.NoArcs}
  Machine.LeadingAxis -> machine

-- | Random points at which the contours may begin whose start the part leaves open, by the number
-- of the statement. Empty if there are none.
otherStarts :: Part -> Gen (Map Int Point)
otherStarts part =
  Map.fromList <$> traverse (\n -> (n,) <$> near) free
  where
    near = Vec.point <$> choose (-60, 60) <*> choose (-60, 60)
    free =
      [ n
        | (n, Part.Mill (Located _ m)) <- zip [0 ..] (filter isCounted (Part.operations part)),
          ContourStart.isFree m
      ]
    isCounted o = case o of
      Part.Mill _ -> True
      Part.Pocket _ -> True
      _ -> False

-- | A line divided at a random point of the grid that lies on it exactly; any other frame as it is.
divided :: Frame -> Gen [Frame]
divided f
  | motion f `elem` [Linear, Rapid],
    isPlain f,
    g > 1 = do
    k <- choose (0, g)
    pure ([f {increment = multiple k} | k > 0] <> [f {increment = multiple (g - k)} | k < g])
  | otherwise = pure [f]
  where
    Pulses3 (Pulses x) (Pulses y) (Pulses z) = increment f
    g = gcd x (gcd y z)
    multiple k = Pulses3 (Pulses (x `div` g * k)) (Pulses (y `div` g * k)) (Pulses (z `div` g * k))

-- | Neighbouring lines in the same direction and with the same feed as one line, where the flag of
-- the first one is true.
-- The function tells whether a frame can hold an increment.
joined :: (Pulses3 -> Bool) -> [(Frame, Bool)] -> [Frame]
joined canHold frames = case frames of
  (f, True) : (g, isNext) : rest
    | isPlain f,
      isPlain g,
      motion f `elem` [Linear, Rapid],
      motion f == motion g,
      feedCode f == feedCode g,
      isAlong (increment f) (increment g),
      canHold (increment f + increment g) ->
      joined canHold ((f {increment = increment f + increment g}, isNext) : rest)
  (f, _) : rest -> f : joined canHold rest
  [] -> []

-- | True if one frame of the machine can hold an increment.
fits :: Machine -> Pulses3 -> Bool
fits machine (Pulses3 x y z) =
  and [abs d <= Machine.capacity machine axis | (d, axis) <- [(x, X), (y, Y), (z, Z)]]

-- | True for two vectors in the same direction.
isAlong :: Pulses3 -> Pulses3 -> Bool
isAlong (Pulses3 (Pulses a) (Pulses b) (Pulses c)) (Pulses3 (Pulses x) (Pulses y) (Pulses z)) =
  a * y == b * x && b * z == c * y && a * z == c * x && a * x + b * y + c * z > 0

-- | True for a frame that only moves.
isPlain :: Frame -> Bool
isPlain f = null (commands f) && not (braking f) && centre f == Pulses2 0 0
