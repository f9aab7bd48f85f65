-- | Heights along an arc that rises: the frames of a helix.
module Frame.Helix
  ( isHelix,
    raised,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Rad (..))
import Data.List (mapAccumL)
import Data.List.NonEmpty (NonEmpty (..))
import Frame.Arc (ArcStep (..))
import Frame.Frame qualified as Frame
import Frame.Rounding qualified as Rounding
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), Machine)
import Machine.Machine qualified as Machine
import Toolpath.Toolpath (Move (segment))

-- | True for the moves of a run that the machine can make as a helix: a single arc.
isHelix :: Machine -> NonEmpty Move -> Bool
isHelix machine run = case (Machine.arcs machine, run) of
  (Arcs {Machine.rising}, m :| []) | Arc {} <- segment m -> rising
  _ -> False

-- | Steps along the move @m@ with its heights, from steps that all stay at one height. The height
-- changes in proportion to the angle about the centre of the move's arc, or along a line in
-- proportion to the length. The last step ends at the rounded height of the move's end.
raised :: Machine -> Move -> [ArcStep] -> [ArcStep]
raised machine m steps = snd (mapAccumL raise 0 (zip [1 :: Int ..] steps))
  where
    count = length steps
    raise done (k, step@ArcStep {target = Pulses3 x y _}) =
      let made
            | k == count = 1
            | otherwise = max done (fractionOf (segment m) (Frame.position machine (target step)))
          Pulses3 _ _ z = Rounding.rounded machine (Vec.point 0 0, Rounding.heightAt made m)
       in (made, step {target = Pulses3 x y z})

-- | Fraction of a segment, from 0 to 1, at which it passes a point near it.
fractionOf :: Segment -> Point -> Double
fractionOf s p = max 0 (min 1 fraction)
  where
    once = Segment.fraction s p
    fraction = case s of
      Straight _ _ -> once
      Arc {sweep = Rad sweep}
        -- A point just before the beginning of the arc.
        | once > 1 && once - period > -0.25 * period -> once - period
        | otherwise -> once
        where
          period = 2 * pi / abs sweep
