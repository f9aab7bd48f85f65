-- | The loops around the region of a pocket that the cutter's centre can reach. A loop is a closed
-- chain of segments with the free space on its left. "Offset.Kernel" computes the loops.
module Toolpath.Inset
  ( oriented,
    inset,
    insetWithSlots,
    insetOfLoops,
  )
where

import Base.Quantity (Mm (..), minus, plus, times, total)
import Control.Applicative ((<|>))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, mapMaybe)
import Geometry.Carrier qualified as Carrier
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Polyarc (Ends (Closed), Polyarc (Polyarc))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Offset.Kernel qualified as Kernel
import Offset.Loop qualified as Loop
import Offset.Tolerance qualified as Tolerance
import Toolpath.PocketTree (Loop)

-- | An outer contour and islands, each oriented with the free space on its left.
oriented :: Polyarc -> [Polyarc] -> NonEmpty Polyarc
oriented outer islands = orient (> 0) outer :| map (orient (< 0)) islands
  where
    orient wanted c = if wanted (Polyarc.signedArea c) then c else Polyarc.reverse c

-- | The loops at a distance to the left of an outer contour and islands. Each contour must have the
-- free space on its left, and must not intersect itself. There are no loops when the contours
-- intersect each other, or when the kernel cannot certify its answer. To get loops at several
-- distances, apply the function to the contours only once: then they are converted only once.
inset :: NonEmpty Polyarc -> Mm -> [Loop]
inset contours@(outer :| _) = loopsAt
  where
    walls = map (fst . FlatPolyarc.fromPolyarc) (NonEmpty.toList contours)
    BoundingBox l b r t = boundingBox (Polyarc.segments outer)
    loopsAt distance@(Mm d)
      -- Under this condition a circle of the radius @d@ is at least as wide or as high as the outer
      -- contour, so it does not fit. Without this test the kernel would have to distinguish a
      -- cutter that covers the whole contour from one that fits.
      | 2 * d >= min (r - l) (t - b) = []
      -- A slightly smaller distance avoids the coincidence that the kernel cannot decide.
      | otherwise =
        fromMaybe
          []
          (decided walls distance <|> decided walls (minus distance Tolerance.clearance))

-- | The loops at @distance@, including loops along slots: narrow passages that are exactly twice as
-- wide as @distance@. @loopsAt@ is 'inset' applied to the contours. @loopsAt distance@ has no loop
-- in a slot, because the centre can only move on a line there. If there is a slot, all loops of the
-- result are at a distance that is smaller by 'Tolerance.clearance'.
insetWithSlots :: (Mm -> [Loop]) -> Mm -> [Loop]
insetWithSlots loopsAt distance
  | minus (totalLength smaller) (totalLength own) > Tolerance.ignoredSlot = smaller
  | otherwise = own
  where
    own = loopsAt distance
    smaller = loopsAt (minus distance Tolerance.clearance)
    totalLength loops = total [Segment.length s | loop <- loops, s <- NonEmpty.toList loop]

-- | The loops at @distance@ to the left of other loops, which 'inset' gave. This is less work than
-- to compute them from the contours. Nothing when the kernel cannot decide, for instance because
-- loops touch; then the caller computes them from the contours.
insetOfLoops :: [Loop] -> Mm -> Maybe [Loop]
insetOfLoops loops distance
  | times 2 (plus distance (times 2 Tolerance.clearance)) >= Mm (min (r - l) (t - b)) = Just []
  | otherwise = decided (map (fst . FlatPolyarc.fromPolyarc . Polyarc Closed) loops) distance
  where
    -- The bounding box of all loops. A circle that is at least as wide or as high as the box fits
    -- into no loop. If it is narrower by some clearances only, its centre has room in a spot at
    -- most. This counts as no room: in the raw offset, all segments of a round loop cross each
    -- other there. Loops with slots are too large by one clearance ('insetWithSlots').
    BoundingBox l b r t =
      maybe
        (BoundingBox 0 0 0 0)
        (foldr1 BoundingBox.union)
        (NonEmpty.nonEmpty (map boundingBox loops))

-- | The loops at a distance to the left of contours, as the kernel gives them. Nothing when it
-- cannot decide.
decided :: [FlatPolyarc] -> Mm -> Maybe [Loop]
decided walls distance =
  either
    (const Nothing)
    (Just . loopsOf)
    (Kernel.offset (Kernel.roundOffset Carrier.LeftOf distance) walls)

-- | The bounding box of segments.
boundingBox :: NonEmpty Segment -> BoundingBox
boundingBox (s :| more) =
  foldl (\box s' -> BoundingBox.union box (BoundingBox.ofSegment s')) (BoundingBox.ofSegment s) more

-- | The loops around a region that the centre can reach, each as a list of segments.
loopsOf :: Kernel.ReachableRegion -> [Loop]
loopsOf region =
  mapMaybe (NonEmpty.nonEmpty . FlatPolyarc.segments) (Loop.polyarcs (Kernel.loops region))
