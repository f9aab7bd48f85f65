-- | Cuts of an arc at the axes through its centre, in whole pulses, for controls whose arcs have to
-- stay within a quadrant.
--
-- The centre is chosen first, for the whole arc. The cuts then lie exactly on the axes through it,
-- so rounding cannot move a cut to the wrong side of an axis.
module Frame.Arc.Quadrant
  ( Crossings (..),
    crossings,
    frameEnds,
    isInQuadrant,
  )
where

import Base.PulseVector (Pulses2 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Frame.Arc.Context (Grid (..))
import Frame.Arc.Context qualified as Context
import Geometry.Carrier (Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), Axis (..), Machine)
import Machine.Machine qualified as Machine

-- | Crossings of a circle with the axes through a grid point near its centre, as distances from the
-- grid point in pulses: positive to the right and upwards, negative to the left and downwards.
data Crossings = Crossings {right :: Pulses, left :: Pulses, up :: Pulses, down :: Pulses}

-- | Crossings of a circle with the axes through the grid point @c@. The circle has the radius @r@
-- in mm and the given exact centre.
crossings :: Grid -> Mm -> Point -> Pulses2 -> Crossings
crossings grid (Mm r) exactCentre c =
  Crossings
    { right = crossing X 1 dx dy,
      left = -(crossing X (-1) dx dy),
      up = crossing Y 1 dy dx,
      down = -(crossing Y (-1) dy dx)
    }
  where
    off = Vec.to exactCentre (Context.gridPoint grid c)
    dx = Vec.dot (Vec.vec 1 0) off
    dy = Vec.dot (Vec.vec 0 1) off
    crossing axis sign along across =
      let Mm p = Machine.resolutionOf (machine grid) axis
       in Pulses (max 1 (round ((sqrt (max 0 (r * r - across * across)) - sign * along) / p)))

-- | Ends of the frames of an arc about the grid point @c@, from the grid point @begin@ to @finish@.
-- @at@ are the crossings of the arc's circle with the axes through @c@. When the control's arcs
-- have to stay within a quadrant, a frame ends at each crossing before @finish@, and the last one
-- ends at @finish@. Otherwise @finish@ is the only end. The list is empty when the control has no
-- arcs. It is also empty when the arc has to be cut at the axes, but begins or ends at @c@ itself.
frameEnds :: Machine -> Crossings -> Sense -> Pulses2 -> Pulses2 -> Pulses2 -> [Pulses2]
frameEnds machine at sense c begin finish = case Machine.arcs machine of
  NoArcs -> []
  Arcs {Machine.quadrants}
    | quadrants -> map (c +) (toCrossings (5 :: Int) (begin - c))
    | otherwise -> [finish]
  where
    goal = finish - c
    toCrossings most from
      | isInQuadrant sense from goal = [goal]
      | most <= 0 || from == 0 || goal == 0 = []
      | otherwise = let next = nextCrossing sense at from in next : toCrossings (most - 1) next

-- | True for an arc about zero, from the first point to the second, that stays within one quadrant.
-- The points are in pulses.
isInQuadrant :: Sense -> Pulses2 -> Pulses2 -> Bool
isInQuadrant sense (Pulses2 a b) (Pulses2 c d) =
  a * c >= 0 && b * d >= 0 && Carrier.senseSign sense * fromIntegral (a * d - b * c) > 0

-- | First of the crossings @at@ that an arc about zero meets after the point (@x@, @y@). All points
-- are in pulses.
nextCrossing :: Sense -> Crossings -> Pulses2 -> Pulses2
nextCrossing sense at (Pulses2 x y) = case sense of
  CounterClockwise
    | x > 0 && y >= 0 -> Pulses2 0 (up at)
    | x <= 0 && y > 0 -> Pulses2 (left at) 0
    | x < 0 -> Pulses2 0 (down at)
    | otherwise -> Pulses2 (right at) 0
  Clockwise
    | x > 0 && y <= 0 -> Pulses2 0 (down at)
    | x <= 0 && y < 0 -> Pulses2 (left at) 0
    | x < 0 -> Pulses2 0 (up at)
    | otherwise -> Pulses2 (right at) 0
