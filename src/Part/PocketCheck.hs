-- | Checks the contours of a pocket: the outline and the islands, which must all be closed. The
-- islands must lie inside the outline, and must touch neither the outline nor one another.
module Part.PocketCheck
  ( misfits,
    halfWidth,
    Named (..),
  )
where

import Base.Name (Name)
import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region)
import Data.List (find, nubBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.WindingNumber qualified as WindingNumber
import Part.Part (Contour (..), Ends (..))
import Part.Part qualified as Part
import Part.PocketError (PocketMisfit (..))

-- | A contour, and the region of its name in the pocket statement.
data Named = Named {mention :: Region, contour :: Contour}

-- | The faults of a pocket's contours. @cutter@ is the diameter of the cutter, if it is known; the
-- reports name it. If some of the contours are open, only these are reported. Otherwise
-- the contours are compared with one another.
misfits :: Maybe Mm -> Named -> [Named] -> [PocketMisfit]
misfits cutter outline islands = case filter isOpen numbered of
  [] -> map meets meetings <> mapMaybe (misplaced outline isInOutline boxes) apart
  open -> [OpenContour (mention n) (nameOf n) (definition n) | (_, n) <- open]
  where
    numbered = zip [0 ..] (outline : islands)
    isOpen (_, n) = ends (contour n) == Open
    isInOutline = WindingNumber.encloses (Part.polyarcOf (contour outline))
    boxes = BoxTree.index (boxOf . snd) (drop 1 numbered)
    meetings
      | null islands = []
      | otherwise = nubBy (\(i, j, _) (k, l, _) -> (i, j) == (k, l)) (crossings numbered)
    meets (i, j, p) =
      let (a, b) = (named j, named i)
          places = (definition a, definition b)
       in Meets (mention a) (nameOf a) (nameOf b) places (i == 0) p cutter
    named i = (outline : islands) !! i
    -- An island that meets another contour is already reported as meeting it.
    apart = [(k, n) | (k, n) <- drop 1 numbered, k `notElem` met]
    met = concat [[i, j] | (i, j, _) <- meetings]

-- | The fault of an island that lies outside of the outline or inside another island.
-- @isInOutline@ is the test that a point lies inside the outline. @k@ is the number of the island,
-- from 1; @islands@ are all islands with their numbers. The island is known to meet no other
-- contour, so testing one of its points suffices.
misplaced ::
  Named -> (Point -> Bool) -> BoxTree (Int, Named) -> (Int, Named) -> Maybe PocketMisfit
misplaced outline isInOutline islands (k, island)
  | not (isInOutline (startOf island)) =
    Just (Outside (mention island) (nameOf island) (nameOf outline))
  | otherwise = InIsland (mention island) (nameOf island) . nameOf <$> find isAround others
  where
    others = [other | (l, other) <- BoxTree.within (boxOf island) islands, l /= k]
    isAround other = WindingNumber.encloses (Part.polyarcOf (contour other)) (startOf island)

-- | The points in which two contours of the pocket cross or touch. Each result consists of the
-- lower number of the two contours, the higher number, and the point. Each pair of segments gives
-- at most one point.
crossings :: [(Int, Named)] -> [(Int, Int, Point)]
crossings numbered =
  [ (i, j, p)
    | (j, n) <- numbered,
      s <- segments n,
      (i, other) <- BoxTree.within (BoundingBox.ofSegment s) index,
      i < j,
      p <- take 1 (Distance.intersections s other)
  ]
  where
    index =
      BoxTree.index (BoundingBox.ofSegment . snd) [(i, s) | (i, n) <- numbered, s <- segments n]

segments :: Named -> [Segment]
segments n = NonEmpty.toList (Polyarc.segments (Part.polyarcOf (contour n)))

-- | The bounding box of a contour.
boxOf :: Named -> BoundingBox
boxOf n = foldl BoundingBox.union first others
  where
    first :| others = fmap BoundingBox.ofSegment (Polyarc.segments (Part.polyarcOf (contour n)))

-- | Half of the shorter side of a contour's bounding box. No point inside the contour is further
-- from the contour than this. Divided by the stepover, it estimates the largest count of passes.
halfWidth :: Named -> Mm
halfWidth n = let BoundingBox.BoundingBox l b r t = boxOf n in Mm (min (r - l) (t - b) / 2)

startOf :: Named -> Point
startOf n = Segment.start (Part.segment (NonEmpty.head (elements (contour n))))

nameOf :: Named -> Name
nameOf n = value (contourName (contour n))

-- | The region of the contour's name where the contour is defined.
definition :: Named -> Region
definition n = region (contourName (contour n))
