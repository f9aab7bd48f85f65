-- | Tapes that cut the same as those of the compiler, in other frames: lines divided at points of
-- the grid, lines in one direction joined, arcs divided.
module Generate.RightTape
  ( otherwiseDivided,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Data.Function (on)
import Data.List (groupBy)
import Frame.Frame (Frame (..), FrameMotion (..), FrameProgram (..), PlannedFrame (..))
import Machine.Machine (Axis (..), Machine)
import Machine.Machine qualified as Machine
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

-- | A line divided at a random point of the grid that lies on it exactly; any other frame as it is.
divided :: Frame -> Gen [Frame]
divided f
  | motion f `elem` [Linear, Rapid],
    isPlain f,
    g > 1 = do
    k <- choose (0, g)
    pure ([f {increment = times k} | k > 0] <> [f {increment = times (g - k)} | k < g])
  | otherwise = pure [f]
  where
    Pulses3 (Pulses x) (Pulses y) (Pulses z) = increment f
    g = gcd x (gcd y z)
    times k = Pulses3 (Pulses (x `div` g * k)) (Pulses (y `div` g * k)) (Pulses (z `div` g * k))

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
