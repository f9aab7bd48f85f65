-- | How often closed chains of segments go round a point, and with that what lies inside them.
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

-- | How often closed chains go round a point, counter-clockwise; the order of the segments does not
-- matter. Any number for a point on one of them.
--
-- The chords go round it by the sum of the angles under which they are seen; an arc goes round what
-- lies between it and its chord once more than the chord does.
about :: Foldable f => Point -> f Segment -> Int
about p chains = round (seen / (2 * pi)) + extra
  where
    (seen, extra) = foldl add (0, 0) chains
    add (angle, count) s =
      let angle' = angle + chord s in angle' `seq` (angle', count + bow s) :: (Double, Int)
    chord s = case s of
      _ | Vec.norm (from s) == 0 || Vec.norm (to s) == 0 -> 0
      -- The arc tells on which side of its chord it goes past a point on that.
      Arc {sweep = Rad w} | side s == 0 && Vec.dot (from s) (to s) < 0 -> signum w * pi
      _ -> let Rad t = Vec.turn (from s) (to s) in t
    bow s = case s of
      Straight _ _ -> 0
      Arc {start = a, end = b, centre, sweep = Rad w}
        | Vec.distance centre p >= Segment.radius centre a -> 0
        | a == b -> round (signum w)
        | w > 0 && side s < 0 -> 1
        | w < 0 && side s > 0 -> -1
        | otherwise -> 0
    from = Vec.to p . start
    to = Vec.to p . end
    -- Both ask for the side of the chord, and get the same answer.
    side s = Vec.cross (from s) (to s)

-- | Whether a point lies inside a closed contour, whichever way that is walked.
encloses :: Polyarc -> Point -> Bool
encloses contour p = about p (Polyarc.segments contour) /= 0
