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
import Data.List (foldl')
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
-- mm. It is at most 0 if the cylinder stays beside the solid, and then it may be any such number.
depthOf :: AvoidedSolid -> Mm -> Segment -> Mm
depthOf solid r path
  | isInside = plus r (distanceTo (BoxTree.toList (boundary solid)))
  | otherwise = minus r (distanceTo (BoxTree.within around (boundary solid)))
  where
    distanceTo = foldl' min (Mm (1 / 0)) . map (Distance.distance . Distance.segments path)
    around = BoundingBox.inflate r (BoundingBox.ofSegment path)
    isInside =
      odd (WindingNumber.about (Segment.start path) (BoxTree.toList (boundary solid)))

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
