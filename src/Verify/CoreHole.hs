-- | Holes that have to be there before a tap, a reamer or a thread mill comes.
--
-- These tools cut a little at the wall of a hole. In solid metal they break. If the program states
-- its stock, the motions before must have removed all that the tool cannot cut: within the core of
-- the thread, or within 'WallDepth.reamedShare' of the radius of a reamer. Without a @stock@
-- statement nothing is known of the holes that the blank has.
module Verify.CoreHole
  ( MotionsInStock (..),
    CoreHoleFault (..),
    coreHoleFaults,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe, maybeToList)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Cutter (..), CutterKind (..))
import Part.Part qualified as Part
import Part.WallDepth qualified as WallDepth
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.CollisionFinding (CoreTool (..))
import Verify.Motion (CutterMotion (..))
import Verify.Motion qualified as Motion
import Verify.RemainingStock (Probe (Probe), Removals, StockSolid)
import Verify.RemainingStock qualified as Stock

-- | Motions of a tape, and what they leave.
data MotionsInStock = MotionsInStock
  { toolpath :: Toolpath,
    -- | all motions, in the order of the tape
    motions :: [CutterMotion],
    isRapid :: CutterMotion -> Bool,
    -- | tools that may be in the spindle in a motion, each with its index
    toolsIn :: CutterMotion -> [(Int, Cutter)],
    removals :: Removals,
    -- | stock of the program
    solids :: [StockSolid],
    -- | depth of a contact in the plane, and along z, that does not count
    allowed :: Mm,
    allowedHeight :: Mm
  }

-- | Motion of a tool that needs a hole, and finds stock.
data CoreHoleFault = CoreHoleFault
  { coreMotion :: CutterMotion,
    coreTool :: CoreTool,
    -- | radius that has to be free
    needed :: Mm,
    -- | lowest height of the tip
    coreLowest :: Mm,
    -- | point at which stock is left above this height
    stockAt :: Point
  }

-- | The first motion in which one of these tools runs into stock, for each tool.
coreHoleFaults :: MotionsInStock -> [CoreHoleFault]
coreHoleFaults scene = concatMap firstOf (needsOf (toolpath scene))
  where
    numbered = zip [0 ..] (motions scene)
    firstOf need = take 1 [f | (k, m) <- numbered, f <- maybeToList (faultIn scene need k m)]

-- | Needs of a statement: the index of its tool, its work, the depth of the thread below the
-- cutter's edge, and the centres of its holes.
data Need = Need Int CoreTool Mm [Point]

-- | Needs of the statements of a toolpath.
needsOf :: Toolpath -> [Need]
needsOf path =
  [ Need t w deep (map centreOf (NonEmpty.toList (Part.holes d)))
    | (t, Toolpath.Holing (Located _ d) _) <- zip (Toolpath.toolIndices blocks) blocks,
      (w, deep) <- case Part.form d of
        Part.Tapped stroke -> [(TapInHole, WallDepth.threadDepth (Part.tapPitch stroke))]
        Part.Threaded h -> [(ThreadMillAtWall, WallDepth.threadDepth (Part.pitch h))]
        Part.Reamed -> [(ReamerInHole, times (1 - WallDepth.reamedShare) (Part.drillRadius d))]
        Part.Plunged -> []
        Part.Bored _ -> []
  ]
  where
    blocks = Toolpath.blocks path
    centreOf (Part.Hole (Located _ p) _ _) = p

-- | The fault of the motion with the number @k@, if its tool is the one of the need. Taps and
-- reamers are examined on the way down at one of their holes, thread mills in all motions.
faultIn :: MotionsInStock -> Need -> Int -> CutterMotion -> Maybe CoreHoleFault
faultIn scene (Need tool w deep centres) k m = case toolsIn scene m of
  [(t, c)]
    | t == tool && not (isRapid scene m) && isOfWork c ->
      listToMaybe
        [ CoreHoleFault
            { coreMotion = m,
              coreTool = w,
              needed = radius,
              coreLowest = low,
              stockAt = p
            }
          | let radius = radiusOf c,
            solid <- solids scene,
            Just p <-
              [ Stock.remaining
                  (removals scene)
                  solid
                  (Probe k (segment m) (minus radius (allowed scene)) level t)
              ]
        ]
  _ -> Nothing
  where
    low = min (fromHeight m) (toHeight m)
    level = plus low (allowedHeight scene)
    isSink = Motion.isVertical m && toHeight m < fromHeight m
    isOfWork c = case (w, Part.kind c) of
      (ThreadMillAtWall, ThreadCutter _) -> True
      (ThreadMillAtWall, _) -> False
      _ -> isSink && any isHere centres
    isHere p = Vec.distance p (Segment.end (segment m)) <= allowed scene
    -- A thread mill goes down beside the wall, without cutting.
    radiusOf c
      | w == ThreadMillAtWall && isSink = cutterRadius c
      | otherwise = minus (cutterRadius c) deep
