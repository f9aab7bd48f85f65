-- | The loops that bound what the cutter's centre can reach in a pocket, by the offset kernel.
module Toolpath.Inset
  ( oriented,
    inset,
    fitting,
    further,
  )
where

import Base.Crash qualified as Crash
import Base.Quantity (Mm (..), minus, total)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Geometry.Carrier qualified as Carrier
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

-- | An outline and islands, each walked with the free space on its left.
oriented :: Polyarc -> [Polyarc] -> NonEmpty Polyarc
oriented outline islands = turned (> 0) outline :| map (turned (< 0)) islands
  where
    turned wanted c = if wanted (Polyarc.signedArea c) then c else Polyarc.reverse c

-- | The loops at a distance to the left of an outline and islands, which are oriented, simple and
-- apart. They are made ready once for all distances. None where contours meet that have to be
-- apart.
inset :: NonEmpty Polyarc -> Mm -> [Loop]
inset contours@(outline :| _) = within
  where
    walls = map (fst . FlatPolyarc.fromContour) (NonEmpty.toList contours)
    BoundingBox l b r t = about (Polyarc.segments outline)
    within distance@(Mm d)
      -- No circle in the outline is larger; the kernel would have to tell a cutter that covers all
      -- of it from one that fits.
      | 2 * d >= min (r - l) (t - b) = []
      | otherwise = case Kernel.offset (Kernel.plain Carrier.LeftOf distance) walls of
        Right reach -> loopsOf reach
        Left Kernel.Uncertain -> Crash.bug "the passes of a pocket failed their certificate"
        Left (Kernel.Crossed _ _) -> []
        Left Kernel.Misplaced -> []

-- | The loops at a distance, and down slots of just twice that width: no area is there in which the
-- centre could stand, but a line, which is the loop at a distance that is less by
-- 'Tolerance.clearance'.
fitting :: (Mm -> [Loop]) -> Mm -> [Loop]
fitting within distance
  | minus (longAll smaller) (longAll own) > Tolerance.slot = smaller
  | otherwise = own
  where
    own = within distance
    smaller = within (minus distance Tolerance.clearance)
    longAll loops = total [Segment.length s | loop <- loops, s <- NonEmpty.toList loop]

-- | The loops further in by a distance, of loops. From loop to loop the kernel has less to do than
-- from the walls to each. Nothing where it cannot tell, as when loops touch.
further :: [Loop] -> Mm -> Maybe [Loop]
further loops distance@(Mm d)
  | 2 * d >= min (r - l) (t - b) = Just []
  | otherwise =
    case Kernel.offset
      (Kernel.plain Carrier.LeftOf distance)
      (map (fst . FlatPolyarc.fromContour . Polyarc Closed) loops) of
      Right reach -> Just (loopsOf reach)
      Left _ -> Nothing
  where
    -- No circle in any of them is larger.
    BoundingBox l b r t =
      maybe (BoundingBox 0 0 0 0) (foldr1 BoundingBox.union) (NonEmpty.nonEmpty (map about loops))

-- | The box about segments.
about :: NonEmpty Segment -> BoundingBox
about (s :| more) =
  foldl (\box s' -> BoundingBox.union box (BoundingBox.ofSegment s')) (BoundingBox.ofSegment s) more

loopsOf :: Kernel.ReachableRegion -> [Loop]
loopsOf reach =
  mapMaybe (NonEmpty.nonEmpty . FlatPolyarc.segments) (Loop.outlines (Kernel.loops reach))
