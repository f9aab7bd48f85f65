-- | Cuts, below the top of the part, at positions where the planned frames do not cut, or deeper
-- than the planned frames cut. Planned frames are those that the compiler made for the program.
module Verify.ForeignCut
  ( foreignCuts,
    largestTolerance,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part (Milling)
import Part.Part qualified as Part
import Toolpath.Toolpath (Block, Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Motion (CutterMotion (number, segment))
import Verify.Motion qualified as Motion
import Verify.Proof (Finding (CutsElsewhere))

-- | Findings for @motions@ of a tape that cut elsewhere or deeper than the @planned@ motions. The
-- comparison uses the sample points of a motion that lie more than a pulse below the top of the
-- part. Each of them needs a planned motion near it that is at least as deep; a pulse less is
-- allowed. Near means within two pulses plus twice 'largestTolerance', because two tapes with
-- different chords may deviate to opposite sides.
foreignCuts :: Machine -> Toolpath -> [CutterMotion] -> [CutterMotion] -> [Finding]
foreignCuts machine path planned motions =
  [ CutsElsewhere (number m) p
    | m <- motions,
      isDeep (lowest m),
      p : _ <- [[p | (p, z) <- samplesOf m, isDeep z, not (isKnown p z)]]
  ]
  where
    pulse = Machine.planeResolution machine
    isDeep z = z < minus (Mm 0) pulse
    index =
      BoxTree.index
        (BoundingBox.ofSegment . segment)
        (filter ((< Mm 0) . lowest) planned)
    slack = plus (times 2 pulse) (times 2 (largestTolerance path))
    isKnown p z =
      or
        [ Distance.toPoint p (segment o) <= slack && lowest o <= plus z pulse
          | o <- BoxTree.within (BoundingBox.inflate slack (BoundingBox.ofPoints p [])) index
        ]

-- | Smaller of the heights of a motion at its start and at its end.
lowest :: CutterMotion -> Mm
lowest = uncurry min . Motion.heights

-- | Start and sample points of a motion with their heights.
samplesOf :: CutterMotion -> [(Point, Mm)]
samplesOf m =
  [ (Segment.at k (segment m), plus from (times k (minus to from)))
    | k <- 0 : Motion.samples m
  ]
  where
    (from, to) = Motion.heights m

-- | Largest chord error that any milling, pocket or carving statement of the toolpath allows; 0 if
-- there is no such statement.
largestTolerance :: Toolpath -> Mm
largestTolerance path =
  maximum
    ( Mm 0 :
        [ uncurry max (Part.deviationLimits t)
          | b <- Toolpath.blocks path,
            t <- map Part.tolerance (millingOf b) <> carvingTolerances b
        ]
    )

carvingTolerances :: Block -> [Part.Accuracy]
carvingTolerances block = case block of
  Toolpath.Carved (Located _ c) _ _ -> [Part.carvingTolerance c]
  _ -> []

-- | Milling of a block that cuts along a contour or clears a pocket; empty for any other block.
millingOf :: Block -> [Milling]
millingOf block = case block of
  Toolpath.Cutting {Toolpath.job = Located _ m} -> [m]
  Toolpath.Clearing {Toolpath.pocket = Located _ p} -> [Part.wall p]
  Toolpath.Travelling {} -> []
  Toolpath.Holing _ _ -> []
  Toolpath.Carved {} -> []
  Toolpath.Commanding _ -> []
