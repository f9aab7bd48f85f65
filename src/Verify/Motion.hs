-- | Motion of the cutter's centre in one frame of a tape, stored as a few numbers, because a long
-- tape has very many motions. Everything else about a motion is computed when it is needed.
--
-- The /bounding paths/ of a motion enclose its real path: one path, or two for an arc whose radii
-- at start and end differ (see "Control.Motion").
module Verify.Motion
  ( CutterMotion (..),
    motionsOf,
    ofNoLength,
    heights,
    endPosition,
    paths,
    pathList,
    connectors,
    box,
    isSame,
    isVertical,
    changesHeight,
    samples,
    sampleCount,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Control.Compensation (Moved)
import Control.Compensation qualified as Compensation
import Control.Motion qualified as Control
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Machine.Machine (Machine)

-- | Motion of the cutter's centre in one frame, or a part of that motion. A frame has two parts if
-- cutter compensation inserts an arc round a corner before the programmed motion. The segment of a
-- vertical motion has length 0.
data CutterMotion = CutterMotion
  { -- | number of the frame, from 1
    number :: Int,
    -- | number of the part among the parts of its frame, from 0
    part :: Int,
    -- | path in the plane, in mm; an arc has the radius of its start
    segment :: Segment,
    -- | heights at the start and at the end of the motion; the top of the part is 0
    fromHeight :: Mm,
    toHeight :: Mm
  }

-- | Prepend the parts of the motion @moved@ to the list @later@ of later motions. Only the last
-- part changes the height.
motionsOf :: Machine -> Moved -> [CutterMotion] -> [CutterMotion]
motionsOf machine moved later = go 0 (Compensation.centrePath moved)
  where
    programmed = Compensation.programmed moved
    (from, to) = Control.height machine programmed
    go n (path :| others) = case others of
      [] -> let m = partOf n path to in m `seq` (m : later)
      next : more -> let m = partOf n path from in m `seq` (m : go (n + 1) (next :| more))
    partOf n path end =
      CutterMotion
        { number = Control.number programmed,
          part = n,
          segment = path,
          fromHeight = from,
          toHeight = end
        }

-- | Motion of length 0 at a position and a height. It belongs to no frame, so its number is 0.
ofNoLength :: Point -> Mm -> CutterMotion
ofNoLength p height =
  CutterMotion
    { number = 0,
      part = 0,
      segment = Straight p p,
      fromHeight = height,
      toHeight = height
    }

-- | Heights of a motion at its start and at its end, in mm.
heights :: CutterMotion -> (Mm, Mm)
heights m = (fromHeight m, toHeight m)

-- | Position and height at the end of a motion, in mm.
endPosition :: CutterMotion -> (Point, Mm)
endPosition m = (Segment.end (segment m), toHeight m)

-- | Bounding paths of the motion: the paths between which the cutter's centre stays. There is one,
-- or two for an arc whose radii at its start and its end differ.
paths :: CutterMotion -> NonEmpty Segment
paths = Control.boundingPaths . segment

-- | Bounding paths of a motion as a list. The function is fast for a line, and most motions are
-- lines.
pathList :: CutterMotion -> [Segment]
pathList m
  | FastDistance.isLine (segment m) = [segment m]
  | otherwise = NonEmpty.toList (paths m)

-- | Lines that connect the starts, and the ends, of two bounding paths; empty for one path.
connectors :: CutterMotion -> [Segment]
connectors m
  | FastDistance.isLine (segment m) = []
  | otherwise = Control.connectors (paths m)

-- | Bounding box of all bounding paths.
box :: CutterMotion -> BoundingBox
box m = case FastDistance.uneven (segment m) of
  0 -> FastDistance.box (segment m)
  -- The difference is that between the arc's radii at its start and its end. The two bounding arcs
  -- have ends and sagittas that differ by at most twice this difference.
  difference -> BoundingBox.inflate (Mm (2 * difference)) (FastDistance.box (segment m))

-- | Test that two motions are the same part of the same frame.
isSame :: CutterMotion -> CutterMotion -> Bool
isSame a b = number a == number b && part a == part b

-- | Test that a motion has no length in the plane. A full circle has a length.
isVertical :: CutterMotion -> Bool
isVertical m = case segment m of
  Straight a b -> a == b
  Arc {} -> False

-- | Test that a motion is vertical and leads to another height. False where a blade swivels without
-- moving in the plane: its motions along a contour are at the height of the pass ("Verify.Swivel").
changesHeight :: CutterMotion -> Bool
changesHeight m = isVertical m && fromHeight m /= toHeight m

-- | Sample points of a motion, as fractions of its length. They are equally spaced; 0 is left out
-- and 1 is included.
samples :: CutterMotion -> [Double]
samples m = let n = sampleCount m in [fromIntegral k / fromIntegral n | k <- [1 .. n]]

-- | Number of sample points: two on a line, at least four on an arc. The direction of an arc
-- changes by no more than π\/8 between neighbouring sample points.
sampleCount :: CutterMotion -> Int
sampleCount m = case segment m of
  Straight _ _ -> 2
  Arc {sweep = Rad s} -> max 4 (ceiling (abs s / (pi / 8)))
