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

-- | The function @compute@ of settings and contours, with a table of its values for the contours
-- @known@. An entry is computed when it is first asked for. The value for contours that are a
-- translated copy of known ones, to 'Tolerance.sameCopy', is the entry of those, which @move@ moves
-- by a vector. @compute@ has to give a translated value for translated contours.
shared ::
  Ord k =>
  (k -> NonEmpty Polyarc -> a) ->
  (Vec -> a -> a) ->
  [(k, NonEmpty Polyarc)] ->
  (k -> NonEmpty Polyarc -> a)
shared compute move known = valueFor
  where
    table =
      Map.fromListWith
        (\_ first -> first)
        [((k, shapeOf loops), (startOf loops, compute k loops)) | (k, loops) <- known]
    valueFor k loops = case Map.lookup (k, shapeOf loops) table of
      Just (begin, value)
        | begin == startOf loops -> value
        | otherwise -> move (Vec.to begin (startOf loops)) value
      Nothing -> compute k loops

-- | The point at which the first contour starts.
startOf :: NonEmpty Polyarc -> Point
startOf loops = Segment.start (NonEmpty.head (Polyarc.segments (NonEmpty.head loops)))

-- | Numbers that are equal for translated copies: the count of segments of each contour, its start,
-- and for each segment its end, its centre and its sweep, as multiples of 'Tolerance.sameCopy' from
-- the start of the first contour. A line has its end in place of a centre.
shapeOf :: NonEmpty Polyarc -> PrimArray Int
shapeOf loops = PrimArray.primArrayFromList (concatMap ofLoop loops)
  where
    ofLoop loop =
      let ss = Polyarc.segments loop
       in NonEmpty.length ss :
          multiples (Segment.start (NonEmpty.head ss)) (concatMapSegments ss)
    concatMapSegments = foldr ofSegment []
    ofSegment s more = case s of
      Straight _ q -> multiples q (multiples q (0 : more))
      Arc {end = q, centre = c, sweep = Rad w} -> multiples q (multiples c (steps w : more))
    multiples p more = steps (Vec.x p - Vec.x begin) : steps (Vec.y p - Vec.y begin) : more
    steps :: Double -> Int
    steps v = round (v / resolution)
    begin = startOf loops
    Mm resolution = Tolerance.sameCopy
