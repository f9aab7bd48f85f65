-- | Circular interpolation in the plane of x and y by an evaluation function.
--
-- The function is F = x² + y² − R², for a position (x, y) relative to the centre and the radius R
-- at the start of the arc. All numbers are whole: F is 0 at the start and changes by 2|x| + 1 or
-- 2|x| − 1 with a pulse along x.
--
-- In each quadrant, one axis makes the pulses that lead away from the centre, and the other makes
-- the pulses that lead towards it. With 'OneAxis', a cycle has one pulse. With 'EightDirections',
-- the axis along which the arc is steeper makes a pulse in each cycle, and the other axis may make
-- one too. Both choose the pulses after which |F| is smaller.
--
-- /Bounds./ 'EightDirections': on the line of the leading pulse, the choice is the whole point
-- next to the circle, so the distance from the circle is at most 1\/2. 'OneAxis': the two choices
-- have values of F that differ by 2(p + q), with p and q the distances from the axes, so |F| ≤ p +
-- q ≤ √2·r, and the distance from the circle is about |F|\/(2r) or less: at most √½. Both bounds
-- are tested exactly, for all small arcs.
--
-- /End./ A whole point on the circle has F = 0. Both walks pass through every such point: the
-- column or row of the point is reached on the circle's side of it, where only the pulse towards
-- the point makes |F| smaller. So the end of an arc whose radii are equal is reached exactly. If
-- the radii differ, the walk follows the circle of the start up to the direction of the end. It
-- stops before the pulse that would pass this direction, and a straight line leads to the end.
--
-- Source: J. E. Bresenham, "A linear algorithm for incremental digital display of circular arcs",
-- Communications of the ACM 20 (1977). The rule for unequal radii is reconstructed.
module Pulse.EvaluationArc
  ( EvaluationArc,
    StepRule (..),
    ArcCycle (..),
    start,
    next,
    isFinished,
    leadingShare,
    angleLeft,
  )
where

import Pulse.Steps (Pulses5 (..), Steps)
import Pulse.Steps qualified as Steps

-- | Pulses that one cycle may have.
data StepRule
  = -- | one pulse
    OneAxis
  | -- | one pulse, or one on each axis
    EightDirections
  deriving stock (Eq, Show)

-- | Constants of an arc: the rule, true for a clockwise arc, and the position of
-- the end as 'p' and 'q' of its quadrant.
data Plan = Plan {rule :: StepRule, isMirrored :: Bool, endP :: Int, endQ :: Int, radius2 :: Int}

-- | State of the walk. A clockwise arc is walked as its mirror image at the x axis. In the
-- quadrant, p is the distance from the axis that the arc approaches, and q the distance from the
-- axis that it leaves; p is never 0.
data EvaluationArc = EvaluationArc
  { plan :: Plan,
    -- | 0 to 3, counter-clockwise from the quadrant of positive x and y
    quadrant :: Int,
    -- | count of quadrants between this one and that of the end
    quadrantsLeft :: Int,
    p :: Int,
    q :: Int,
    -- | F at the position
    evaluation :: Int,
    -- | in the last quadrant: the cross product of the position and the end, positive before the
    -- direction of the end
    ahead :: Int,
    -- | pulses towards the centre and away from it
    inward :: Steps,
    outward :: Steps
  }

-- | Result of one step.
data ArcCycle
  = -- | pulses, and the walk after them
    ArcCycle Steps EvaluationArc
  | -- | The direction of the end is reached. The increments lead to the end; all are 0 if the end
    -- itself is reached.
    ArcEnd Pulses5

-- | Walk from the start of an arc. The arguments are the rule, true for a clockwise arc, the start
-- and the end relative to the centre, in pulses. Neither is the centre. If both lie in the same
-- direction, the arc is a full circle.
start :: StepRule -> Bool -> (Int, Int) -> (Int, Int) -> EvaluationArc
start chosen clockwise from to =
  inQuadrant
    EvaluationArc
      { plan = Plan {rule = chosen, isMirrored = clockwise, endP = ep, endQ = eq, radius2},
        quadrant = k,
        quadrantsLeft =
          if l == k && p0 * eq - q0 * ep <= 0 then 4 else (l - k) `mod` 4,
        p = p0,
        q = q0,
        evaluation = 0,
        ahead = 0,
        inward = Steps.none,
        outward = Steps.none
      }
  where
    (k, p0, q0) = located (mirrored from)
    (l, ep, eq) = located (mirrored to)
    radius2 = p0 * p0 + q0 * q0
    mirrored (x, y) = if clockwise then (x, negate y) else (x, y)

-- | Quadrant of a position, with 'p' and 'q' there.
located :: (Int, Int) -> (Int, Int, Int)
located (x, y)
  | x > 0 && y >= 0 = (0, x, y)
  | x <= 0 && y > 0 = (1, y, negate x)
  | x < 0 && y <= 0 = (2, negate x, negate y)
  | otherwise = (3, negate y, x)

-- | Sets what depends on the quadrant only.
inQuadrant :: EvaluationArc -> EvaluationArc
inQuadrant w =
  w
    { ahead = p w * endQ (plan w) - q w * endP (plan w),
      inward = towards (-1) 0,
      outward = towards 0 1
    }
  where
    towards dp dq =
      let (x, y) = turned w dp dq in Steps.together (Steps.towards 0 x) (Steps.towards 1 y)

-- | Components along x and y of a vector that is given along p and q.
turned :: EvaluationArc -> Int -> Int -> (Int, Int)
turned w dp dq = if isMirrored (plan w) then (x, negate y) else (x, y)
  where
    (x, y) = case quadrant w of
      0 -> (dp, dq)
      1 -> (negate dq, dp)
      2 -> (negate dp, negate dq)
      _ -> (dq, negate dp)

-- | Next cycle.
next :: EvaluationArc -> ArcCycle
next w
  | quadrantsLeft w == 0 && ahead' < 0 = ending w
  | p' == 0 =
    ArcCycle
      pulses
      ( inQuadrant
          w
            { quadrant = if quadrant w == 3 then 0 else quadrant w + 1,
              quadrantsLeft = quadrantsLeft w - 1,
              p = q',
              q = 0,
              evaluation = f'
            }
      )
  | otherwise = ArcCycle pulses w {p = p', q = q', evaluation = f', ahead = ahead'}
  where
    f = evaluation w
    fIn = f - 2 * p w + 1
    fOut = f + 2 * q w + 1
    fBoth = fIn + 2 * q w + 1
    chosen = case rule (plan w) of
      OneAxis -> if fIn + fOut > 0 then Inwards else Outwards
      EightDirections
        | p w > q w -> if fOut + fBoth > 0 then Diagonally else Outwards
        | otherwise -> if fIn + fBoth < 0 then Diagonally else Inwards
    goesIn = chosen /= Outwards
    goesOut = chosen /= Inwards
    p' = if goesIn then p w - 1 else p w
    q' = if goesOut then q w + 1 else q w
    f' = case chosen of
      Inwards -> fIn
      Outwards -> fOut
      Diagonally -> fBoth
    ahead' =
      ahead w
        - (if goesIn then endQ (plan w) else 0)
        - (if goesOut then endP (plan w) else 0)
    pulses = pulsesIn chosen w

-- | Pulses in a direction.
pulsesIn :: Direction -> EvaluationArc -> Steps
pulsesIn direction w = case direction of
  Inwards -> inward w
  Outwards -> outward w
  Diagonally -> Steps.together (inward w) (outward w)

-- | Direction of the pulses of a cycle, relative to the centre.
data Direction = Inwards | Outwards | Diagonally
  deriving stock (Eq)

-- | End of the walk, with the increments that lead to the end of the arc.
ending :: EvaluationArc -> ArcCycle
ending w = ArcEnd (Pulses5 x y 0 0 0)
  where
    (x, y) = turned w (endP (plan w) - p w) (endQ (plan w) - q w)

-- | True if the end of the arc is reached.
isFinished :: EvaluationArc -> Bool
isFinished w = quadrantsLeft w == 0 && p w == endP (plan w) && q w == endQ (plan w)

-- | Share of the feed along the arc that falls on the leading axis, for the direction that the arc
-- has after the given count of cycles: the larger component of the unit tangent.
leadingShare :: Int -> EvaluationArc -> Double
leadingShare cycles w = max a b / sqrt (a * a + b * b)
  where
    along = fromIntegral (q w)
    towardsIt = fromIntegral (p w)
    r2 = fromIntegral (radius2 (plan w))
    steps = fromIntegral cycles :: Double
    -- In the first half of a quadrant q grows by a pulse in each cycle, in the second half p
    -- falls.
    (a, b)
      | p w > q w = let v = along + steps in (sqrt (max 0 (r2 - v * v)), v)
      | otherwise = let u = abs (towardsIt - steps) in (u, sqrt (max 0 (r2 - u * u)))

-- | Angle in radians from the position to the direction of the end, along the arc.
angleLeft :: EvaluationArc -> Double
angleLeft w =
  fromIntegral (quadrantsLeft w) * pi / 2 + angleOf (endP e) (endQ e) - angleOf (p w) (q w)
  where
    e = plan w
    angleOf x y = atan2 (fromIntegral y) (fromIntegral x :: Double)
