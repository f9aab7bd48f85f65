-- | Solids that no tool may touch, such as clamps, prepared for questions about motions.
--
-- A tool is a pile of cylinders about its axis ("Part.CutterBody").
module Part.AvoidedSolid
  ( AvoidedSolid,
    prepared,
    top,
    boundingBox,
    depthOf,
    heightOver,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Data.List (foldl', sort)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.WindingNumber qualified as WindingNumber
import Part.CutterBody (Cylinder (Cylinder))
import Part.CutterBody qualified as CutterBody
import Part.Part (Cutter, Solid (..))
import Part.Part qualified as Part

-- | A solid with an index of the segments of its outlines.
data AvoidedSolid = AvoidedSolid {boundary :: BoxTree Segment, top :: Mm}

-- | Prepares a solid.
prepared :: Solid -> AvoidedSolid
prepared solid =
  AvoidedSolid
    { boundary = BoxTree.index BoundingBox.ofSegment (concatMap segmentsOf (outlines solid)),
      top = highest solid
    }
  where
    segmentsOf = map Part.segment . NonEmpty.toList . Part.elements

-- | The bounding box of a solid in the plane.
boundingBox :: AvoidedSolid -> BoundingBox
boundingBox = BoxTree.boundingBox . boundary

-- | The depth to which a cylinder enters the base of a solid while its axis moves along a path, in
-- mm. If the axis enters it, the depth is at least this, and it is measured at the ends of the path
-- and in the middle of each part inside. It is at most 0 if the cylinder stays beside the solid;
-- then it may be any such number.
depthOf :: AvoidedSolid -> Mm -> Segment -> Mm
depthOf solid r path = case filter isInside (map (`Segment.at` path) middles) of
  [] -> minus r (nearest [Distance.distance (Distance.segments path s) | s <- near])
  inside -> plus r (maximum [nearest (map (Distance.toPoint p) edges) | p <- ends' <> inside])
  where
    ends' = filter isInside [Segment.start path, Segment.end path]
    edges = BoxTree.toList (boundary solid)
    near = BoxTree.within (BoundingBox.inflate r (BoundingBox.ofSegment path)) (boundary solid)
    nearest = foldl' min (Mm (1 / 0))
    isInside p = odd (WindingNumber.about p edges)
    -- The middles of the parts into which the boundary cuts the path, as fractions.
    middles = zipWith (\a b -> (a + b) / 2) (0 : cuts) (cuts <> [1])
    cuts =
      sort
        [ t
          | s <- near,
            p <- Distance.intersections path s,
            let t = Segment.fraction path p,
            t > 0,
            t < 1
        ]

-- | The height at which a tool moves over all solids that its way enters: the clearance height
-- above the highest of them. Nothing if it enters none, or only those that have no top. @path@ is
-- the way in the plane, and @z@ the lower one of the heights of the tip at its ends.
heightOver :: Mm -> [AvoidedSolid] -> Cutter -> Segment -> Mm -> Maybe Mm
heightOver clearance solids cutter path z = case highestFree of
  [] -> Nothing
  some -> Just (plus clearance (maximum some))
  where
    highestFree =
      [ free
        | solid <- solids,
          top solid < Tolerance.reach,
          Cylinder r h <- CutterBody.cylindersOf cutter,
          let free = minus (top solid) h,
          free > z,
          depthOf solid r path > Mm 0
      ]
