-- | Holes of the part that the tape does not drill.
module Verify.HoleCheck
  ( missingHoles,
  )
where

import Base.Quantity (Mm (..), minus, times)
import Base.Region (Located (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isNothing)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part qualified as Part
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Motion (CutterMotion (segment))
import Verify.Motion qualified as Motion
import Verify.Proof (Finding (HoleMissing))

-- | Findings for holes that no vertical motion drills. The motion has to be within a pulse of the
-- hole's centre. Its lowest point may be at most 0.6 pulses above the hole's bottom. Both limits
-- allow for rounding to pulses, which moves a position by up to half a pulse on each axis.
missingHoles :: Machine -> Toolpath -> [CutterMotion] -> [Finding]
missingHoles machine path motions =
  [ HoleMissing at p
    | Toolpath.Holing (Located _ drilling) _ <- Toolpath.blocks path,
      -- The moves of circles are compared one by one.
      isNothing (Part.runsOf drilling),
      Part.Hole (Located at p) bottom _ <- NonEmpty.toList (Part.holes drilling),
      not (any (isDrilled machine bottom p) (near p))
  ]
  where
    near p =
      BoxTree.within
        ( BoundingBox.inflate
            (times 2 (Machine.planeResolution machine))
            (BoundingBox.ofPoints p [])
        )
        index
    index = BoxTree.index Motion.box (filter Motion.isVertical motions)

-- | Test that the vertical motion @m@ drills the hole with the centre @p@ down to the height
-- @bottom@ or deeper.
isDrilled :: Machine -> Mm -> Point -> CutterMotion -> Bool
isDrilled machine bottom p m =
  Vec.distance (Segment.start (segment m)) p <= Machine.planeResolution machine
    && minus (uncurry min (Motion.heights m)) bottom
      <= times 0.6 (Machine.resolutionOf machine Machine.Z)
