-- | Solids that no tool may touch, such as clamps, prepared for questions about motions.
--
-- A tool is a pile of cylinders about its axis ("Part.CutterBody").
module Part.AvoidedSolid
  ( AvoidedSolid,
    prepared,
    top,
    boundingBox,
    depthOf,
    deepestPoint,
    heightOver,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Data.List (foldl', sort, sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
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
depthOf solid r path = case insidePoints solid r path of
  [] -> minus r (foldl' min far (map Distance.distance (closestTo solid r path)))
  inside -> plus r (maximum (map (depthAt solid) inside))

-- | The place of the cylinder's axis on the path at which 'depthOf' measures the depth. Nothing if
-- the cylinder stays beside the solid.
deepestPoint :: AvoidedSolid -> Mm -> Segment -> Maybe Point
deepestPoint solid r path = case insidePoints solid r path of
  [] -> case sortOn Distance.distance (closestTo solid r path) of
    closest : _ | Distance.distance closest < r -> Just (Distance.nearestPoint closest)
    _ -> Nothing
  inside -> Just (last (sortOn (depthAt solid) inside))

-- | The points inside the base of a solid at which the depth of a path is measured.
insidePoints :: AvoidedSolid -> Mm -> Segment -> [Point]
insidePoints solid r path = case filter isInside (map (`Segment.at` path) middles) of
  [] -> []
  inside -> filter isInside [Segment.start path, Segment.end path] <> inside
  where
    isInside p = odd (WindingNumber.about p (BoxTree.toList (boundary solid)))
    -- The middles of the parts into which the boundary cuts the path, as fractions.
    middles = zipWith (\a b -> (a + b) / 2) (0 : cuts) (cuts <> [1])
    cuts =
      sort
        [ t
          | s <- nearPath solid r path,
            p <- Distance.intersections path s,
            let t = Segment.fraction path p,
            t > 0,
            t < 1
        ]

-- | The distance of a point from the boundary of a solid's base.
depthAt :: AvoidedSolid -> Point -> Mm
depthAt solid p = foldl' min far (map (Distance.toPoint p) (BoxTree.toList (boundary solid)))

-- | The least distances between a path and the segments of the boundary near it.
closestTo :: AvoidedSolid -> Mm -> Segment -> [Distance.ClosestPoint]
closestTo solid r path = map (Distance.segments path) (nearPath solid r path)

-- | The segments of the boundary whose boxes come near the path.
nearPath :: AvoidedSolid -> Mm -> Segment -> [Segment]
nearPath solid r path =
  BoxTree.within (BoundingBox.inflate r (BoundingBox.ofSegment path)) (boundary solid)

far :: Mm
far = Mm (1 / 0)

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
