-- | The loops that bound what the cutter's centre can reach in a pocket, by the offset kernel.
module Path.Inset
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
import Geometry.Box (Box (..))
import Geometry.Box qualified as Box
import Geometry.Contour (Contour (Contour), Ends (Closed))
import Geometry.Contour qualified as Contour
import Geometry.Offset.Kernel qualified as Kernel
import Geometry.Offset.Loops qualified as Loops
import Geometry.Outline qualified as Outline
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Path.Nest (Loop)

-- | An outline and islands, each walked with the free space on its left.
oriented :: Contour -> [Contour] -> NonEmpty Contour
oriented outline islands = turned (> 0) outline :| map (turned (< 0)) islands
  where
    turned wanted c = if wanted (Contour.signedArea c) then c else Contour.reverse c

-- | The loops at a distance to the left of an outline and islands, which are oriented, simple and apart. They are made
-- ready once for all distances. None where contours meet that have to be apart.
inset :: NonEmpty Contour -> Mm -> [Loop]
inset contours@(outline :| _) = within
  where
    walls = map (fst . Outline.fromContour) (NonEmpty.toList contours)
    Box l b r t = about (Contour.segments outline)
    within distance@(Mm d)
      -- No circle in the outline is larger; the kernel would have to tell a cutter that covers all of it from one that fits.
      | 2 * d >= min (r - l) (t - b) = []
      | otherwise = case Kernel.offset (Kernel.plain Kernel.LeftOf distance) walls of
        Right reach -> loopsOf reach
        Left Kernel.Uncertain -> Crash.bug "the passes of a pocket failed their certificate"
        Left (Kernel.Crossed _ _) -> []
        Left Kernel.Misplaced -> []

-- | The loops at a distance, and down slots of just twice that width: no area is there in which the centre could stand, but a line, which is
-- the loop at a distance that is less by 'Tolerance.clearance'.
fitting :: (Mm -> [Loop]) -> Mm -> [Loop]
fitting within distance
  | minus (longAll smaller) (longAll own) > Tolerance.slot = smaller
  | otherwise = own
  where
    own = within distance
    smaller = within (minus distance Tolerance.clearance)
    longAll loops = total [Segment.length s | loop <- loops, s <- NonEmpty.toList loop]

-- | The loops further in by a distance, of loops. From loop to loop the kernel has less to do than from the walls to each. Nothing where
-- it cannot tell, as when loops touch.
further :: [Loop] -> Mm -> Maybe [Loop]
further loops distance@(Mm d)
  | 2 * d >= min (r - l) (t - b) = Just []
  | otherwise = case Kernel.offset (Kernel.plain Kernel.LeftOf distance) (map (fst . Outline.fromContour . Contour Closed) loops) of
    Right reach -> Just (loopsOf reach)
    Left _ -> Nothing
  where
    -- No circle in any of them is larger.
    Box l b r t = maybe (Box 0 0 0 0) (foldr1 Box.union) (NonEmpty.nonEmpty (map about loops))

-- | The box about segments.
about :: NonEmpty Segment -> Box
about (s :| more) = foldl (\box s' -> Box.union box (Box.ofSegment s')) (Box.ofSegment s) more

loopsOf :: Kernel.Reach -> [Loop]
loopsOf reach = mapMaybe (NonEmpty.nonEmpty . Outline.segments) (Loops.outlines (Kernel.loops reach))
