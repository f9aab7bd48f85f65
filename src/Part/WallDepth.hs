-- | Depths to which works on the wall or the rim of a hole cut into the cylinder that is there
-- before.
module Part.WallDepth
  ( wallDepth,
    threadDepth,
    reamedShare,
  )
where

import Base.Quantity (Mm (..), times)
import Part.Part (Drilling, HoleForm (..))
import Part.Part qualified as Part

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
