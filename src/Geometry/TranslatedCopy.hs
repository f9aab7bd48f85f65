-- | Values of a function of contours, computed once for all contours that differ only by a
-- translation. Equal letters of a text are such contours.
module Geometry.TranslatedCopy
  ( shared,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Lazy qualified as Map
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Geometry.Polyarc (Polyarc)
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | The values of a function @compute@ of settings and closed contours, for groups of both. The
-- value for contours that are a translated copy of earlier ones, to 'Tolerance.sameCopy', is that
-- of those, which @move@ moves by a vector. @compute@ has to give a translated value for translated
-- contours.
shared ::
  Ord k =>
  (k -> NonEmpty Polyarc -> a) ->
  (Vec -> a -> a) ->
  [NonEmpty (k, NonEmpty Polyarc)] ->
  [NonEmpty a]
shared compute move groups = map (fmap valueOf) keyed
  where
    keyed =
      [fmap (\(k, loops) -> ((k, shapeOf loops), (startOf loops, compute k loops))) g | g <- groups]
    firsts = Map.fromListWith (\_ first -> first) (concatMap NonEmpty.toList keyed)
    valueOf (key, own@(begin, _)) = case Map.findWithDefault own key firsts of
      (start, value)
        | start == begin -> value
        | otherwise -> move (Vec.to start begin) value

-- | The point at which the first contour starts.
startOf :: NonEmpty Polyarc -> Point
startOf loops = Segment.start (NonEmpty.head (Polyarc.segments (NonEmpty.head loops)))

-- | Numbers that are equal for translated copies: the count of segments of each contour, its start,
-- and for each segment 0 and the end of a line, or 1 and the end, the centre and the sweep of an
-- arc. Positions are multiples of 'Tolerance.sameCopy' from the start of the first contour. Without
-- the centre all full circles would be equal.
shapeOf :: NonEmpty Polyarc -> PrimArray Int
shapeOf loops = PrimArray.primArrayFromList (concatMap ofLoop loops)
  where
    ofLoop loop =
      let ss = Polyarc.segments loop
       in NonEmpty.length ss :
          multiples (Segment.start (NonEmpty.head ss)) (concatMapSegments ss)
    concatMapSegments = foldr ofSegment []
    ofSegment s more = case s of
      Straight _ q -> 0 : multiples q more
      Arc {end = q, centre = c, sweep = Rad w} -> 1 : multiples q (multiples c (steps w : more))
    multiples p more = steps (Vec.x p - Vec.x begin) : steps (Vec.y p - Vec.y begin) : more
    steps :: Double -> Int
    steps v = round (v / resolution)
    begin = startOf loops
    Mm resolution = Tolerance.sameCopy
