-- | Winding numbers of closed chains of segments, and the test for points inside a closed polyarc.
module Geometry.WindingNumber
  ( about,
    encloses,
  )
where

import Base.Quantity (Rad (..))
import Geometry.Polyarc (Polyarc)
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The winding number, about the point @p@, of closed chains of segments: the count of turns that
-- they make counter-clockwise around it, less the count of clockwise turns. The order of the
-- segments does not matter. For a point on a segment the number is arbitrary.
--
-- The sum of the angles that the chords subtend at the point gives the winding number of the
-- polygon of chords. An arc that has the point between itself and its chord adds 1 to this number,
-- or subtracts 1 if it is clockwise.
about :: Foldable f => Point -> f Segment -> Int
about p segments = round (angles / (2 * pi)) + corrections
  where
    (angles, corrections) = foldl add (0, 0) segments
    add (angle, count) s =
      let angle' = angle + subtended s
       in angle' `seq` (angle', count + correction s) :: (Double, Int)
    subtended s = case s of
      _ | Vec.norm (from s) == 0 || Vec.norm (to s) == 0 -> 0
      -- If the point lies on an arc's chord, the chord subtends a half turn in the arc's sense.
      Arc {sweep = Rad w} | side s == 0 && Vec.dot (from s) (to s) < 0 -> signum w * pi
      _ -> let Rad t = Vec.signedAngle (from s) (to s) in t
    correction s = case s of
      Straight _ _ -> 0
      Arc {start = a, end = b, centre, sweep = Rad w}
        | Vec.distance centre p >= Segment.radius centre a -> 0
        | a == b -> round (signum w)
        | w > 0 && side s < 0 -> 1
        | w < 0 && side s > 0 -> -1
        | otherwise -> 0
    from = Vec.to p . start
    to = Vec.to p . end
    -- A number that is positive if the point lies on the left of the chord, and negative on the
    -- right. 'subtended' and 'correction' use the same rounded number. So they assume the same side
    -- even for a point very near the chord.
    side s = Vec.cross (from s) (to s)

-- | True when a point lies inside a closed polyarc of either sense.
encloses :: Polyarc -> Point -> Bool
encloses contour p = about p (Polyarc.segments contour) /= 0
