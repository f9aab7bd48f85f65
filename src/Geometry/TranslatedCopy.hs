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
      [fmap (\(k, loops) -> ((k, shapeOf loops), (loops, compute k loops))) g | g <- groups]
    firsts = Map.fromListWith (\_ first -> first) (concatMap NonEmpty.toList keyed)
    valueOf (key, (loops, own)) = case Map.lookup key firsts of
      Just (first, value)
        | first == loops -> value
        | isCopy v first loops -> move v value
        where
          v = Vec.to (startOf first) (startOf loops)
      _ -> own

-- | True for contours that are others moved by a vector. Equal numbers of 'shapeOf' only find
-- contours that may be so.
isCopy :: Vec -> NonEmpty Polyarc -> NonEmpty Polyarc -> Bool
isCopy v first loops = length first == length loops && and (NonEmpty.zipWith isSame first loops)
  where
    isSame a b =
      let (ss, ts) = (Polyarc.segments a, Polyarc.segments b)
       in length ss == length ts && and (NonEmpty.zipWith isSameSegment ss ts)
    isSameSegment s t = case (s, t) of
      (Straight p q, Straight p' q') -> near p p' && near q q'
      (Arc p q c (Rad w), Arc p' q' c' (Rad w')) ->
        near p p' && near q q' && near c c' && abs (w - w') <= most
      _ -> False
    near p q = Vec.distance (Vec.shift v p) q <= Mm most
    most = let Mm resolution = Tolerance.sameCopy in 2 * resolution

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
