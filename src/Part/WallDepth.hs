-- | Works on the wall or the rim of a hole, and the depths to which they cut into the cylinder that
-- is there before.
module Part.WallDepth
  ( worksOn,
    wallDepth,
    threadDepth,
    reamedShare,
  )
where

import Base.Quantity (Mm (..), Rad (..), times)
import Geometry.Carrier (Side (LeftOf))
import Geometry.Segment (Segment (Arc, centre))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Drilling, HoleForm (..))
import Part.Part qualified as Part

-- | True for a segment of a contour that a work on holes may cut: an arc about the axis, with the
-- axis on its free side, or for an outside thread with the material on the side of the axis. @side@
-- is the side of the segment on which the cutter moves that machines it, in the direction of the
-- segment; Nothing if the cutter's centre moves on it.
worksOn :: HoleForm -> Point -> Maybe Side -> Segment -> Bool
worksOn form axis side s = case (s, side) of
  (Arc {centre}, Just free)
    | Rad turned <- Segment.sweep s ->
      Vec.isNear centre axis && ((turned > 0) == (free == LeftOf)) == isInside
  _ -> False
  where
    isInside = case form of
      Threaded h -> Part.isInside h
      _ -> True

-- | The largest depth that a work on holes may cut into a cylinder about its axis, beside the tool
-- itself. The value is by the radius of the hole at the top of the part. Nothing for works that
-- make a hole of their own.
wallDepth :: Drilling -> Mm -> Maybe Mm
wallDepth d mouth = case Part.form d of
  Threaded h -> Just (threadDepth (Part.pitch h))
  Tapped stroke -> Just (threadDepth (Part.tapPitch stroke))
  Reamed -> Just (times (1 - reamedShare) (Part.drillRadius d))
  -- Only the point of the tool works, as wide as the countersink.
  Plunged | mouth < Part.drillRadius d -> Just (Part.drillRadius d)
  Plunged -> Nothing
  Bored _ -> Nothing

-- | Depth of an external thread with 60 degrees between its flanks, by its pitch: 17\/24 of the
-- height of its triangle (ISO 68-1).
threadDepth :: Mm -> Mm
threadDepth = times (17 / 24 * sqrt 0.75)

-- | Share of the radius of a reamer that has to be free before.
reamedShare :: Double
reamedShare = 0.8
