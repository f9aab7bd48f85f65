-- | Deviation of the pulses of a frame from its path, and the largest deviation that each
-- interpolator promises. All deviations are in pulses.
--
-- On a line the deviation is measured from the point of the line that belongs to the position. For
-- a differential analyser this is the point with the same count of pulses of the leading axis, and
-- the deviation is the largest one along an axis. For evaluation functions it is the nearest
-- point, and the deviation is the distance.
--
-- On an arc the deviation is radial. If the radii at both ends of the arc differ, it is measured
-- from the band between the two circles. A position before the start of the arc or behind its end
-- also deviates by its distance from the ray through this end. At the end of the frame, the part of
-- the arc that was not travelled counts as a deviation too, so a full circle cannot be left out.
module Pulse.PathDeviation
  ( promise,
    roundingOfDeviation,
    PathTrace (reached),
    begin,
    stepped,
    deviation,
    deviationAtEnd,
  )
where

import Machine.Controller (InterpolationMethod (..))
import Pulse.FramePath (FramePath (..))
import Pulse.FramePath qualified as FramePath
import Pulse.Steps (Pulses5 (..), Steps)
import Pulse.Steps qualified as Steps

-- | Largest deviation that an interpolation method promises on a path. The proofs are in
-- "Pulse.DifferentialAnalyser", "Pulse.EvaluationLine" and "Pulse.EvaluationArc".
promise :: InterpolationMethod -> FramePath -> Double
promise method path = case (method, path) of
  (DifferentialAnalyser, Line _) -> analyserPromise
  (DifferentialAnalyser, Arc {}) -> analyserPromise
  (EvaluationFunction, Line d) -> evaluationPromise (length (filter (/= 0) (Steps.toList d)))
  (EvaluationFunction, Arc {}) -> evaluationPromise 2

-- | Half a pulse: along each axis of a line, and radially on an arc with steps in eight directions.
analyserPromise :: Double
analyserPromise = 1 / 2

-- | Half a pulse on each of the axes that move, all at once: √½ in a plane and on an arc, √¾ on a
-- line in space.
evaluationPromise :: Int -> Double
evaluationPromise axesMoved = sqrt (fromIntegral axesMoved) / 2

-- | Tolerance of a comparison with a promise. Deviations are floating-point numbers, which are
-- exact to 10⁻⁷ pulses on paths of up to 10⁸ pulses.
roundingOfDeviation :: Double
roundingOfDeviation = 1e-6

-- | Trace of a frame up to a pulse.
data PathTrace = PathTrace
  { -- | position relative to the start of the frame
    reached :: Pulses5,
    -- | on an arc, the angle from its start in radians, in the sense of the arc
    turned :: Double
  }

-- | Trace at the start of a frame.
begin :: PathTrace
begin = PathTrace (Pulses5 0 0 0 0 0) 0

-- | Trace after the pulses of one tick. The angle is computed anew from the start of the arc, so
-- that rounding does not add up; the angle before tells the count of whole turns.
stepped :: FramePath -> Steps -> PathTrace -> PathTrace
stepped path steps trace = PathTrace to $ case path of
  Line _ -> 0
  Arc {clockwise, from} ->
    let signed = FramePath.angleBetween clockwise from (fromCentre from to)
        turns = round ((turned trace - signed) / (2 * pi)) :: Int
     in signed + 2 * pi * fromIntegral turns
  where
    to = Steps.advance steps (reached trace)

-- | Position relative to the centre of an arc; the first argument is its start.
fromCentre :: (Int, Int) -> Pulses5 -> (Int, Int)
fromCentre (i, j) (Pulses5 x y _ _ _) = (i + x, j + y)

-- | Deviation of the position that is reached.
deviation :: InterpolationMethod -> FramePath -> PathTrace -> Double
deviation method path trace = case path of
  Line d -> case method of
    DifferentialAnalyser -> largest (offLine (sameLead d p) d p)
    EvaluationFunction -> size (offLine (nearest d p) d p)
  Arc {from, to} ->
    let radius = length2 (fromCentre from p)
        (r, s) = (length2 from, length2 to)
        outside = max (radius - max r s) (min r s - radius)
        over = max (negate (turned trace)) (turned trace - FramePath.sweep path)
        offEnd = if over > 0 then radius * sin (min over (pi / 2)) else 0
     in max 0 (max outside offEnd)
  where
    p = reached trace

-- | Deviation at the end of the frame: also the length of the arc that is not travelled.
deviationAtEnd :: InterpolationMethod -> FramePath -> PathTrace -> Double
deviationAtEnd method path trace = case path of
  Line _ -> deviation method path trace
  Arc {to} ->
    max (deviation method path trace) (length2 to * abs (FramePath.sweep path - turned trace))

length2 :: (Int, Int) -> Double
length2 (a, b) = sqrt (fromIntegral (a * a + b * b))

-- | Fraction of a line at which the leading axis has as many pulses as at the position.
sameLead :: Pulses5 -> Pulses5 -> Double
sameLead d p
  | n == 0 = 0
  | otherwise = fromIntegral (max 0 (min n made)) / fromIntegral n
  where
    n = FramePath.leadingPulses d
    k = FramePath.leadingAxis d
    made = signum (Steps.component k d) * Steps.component k p

-- | Fraction of a line at which its nearest point to the position lies.
nearest :: Pulses5 -> Pulses5 -> Double
nearest (Pulses5 dx dy dz da db) (Pulses5 x y z a b)
  | whole == 0 = 0
  | otherwise = max 0 (min 1 (fromIntegral along / fromIntegral whole))
  where
    whole = dx * dx + dy * dy + dz * dz + da * da + db * db
    along = dx * x + dy * y + dz * z + da * a + db * b

-- | Vector of five lengths in pulses.
data Offset5 = Offset5 Double Double Double Double Double

-- | Position relative to the point of a line at a fraction of it.
offLine :: Double -> Pulses5 -> Pulses5 -> Offset5
offLine t (Pulses5 dx dy dz da db) (Pulses5 x y z a b) =
  Offset5 (off x dx) (off y dy) (off z dz) (off a da) (off b db)
  where
    off i d = fromIntegral i - t * fromIntegral d

largest, size :: Offset5 -> Double
largest (Offset5 x y z a b) =
  max (abs x) (max (abs y) (max (abs z) (max (abs a) (abs b))))
size (Offset5 x y z a b) = sqrt (x * x + y * y + z * z + a * a + b * b)
