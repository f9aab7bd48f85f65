-- | The parts of a contour that a cutter can touch at all, for a program that lets stay what it cannot.
--
-- A cutter that touches an element at a place has its centre square above it, at its radius. It can stand there when no other
-- element is nearer to that centre. This looks at one element and its neighbourhood at a time, by distances; it knows
-- nothing of how the path was found.
module Verify.Reachable
  ( parts,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus)
import Geometry.Box qualified as Box
import Geometry.Distance qualified as Distance
import Geometry.Nearest (Nearest)
import Geometry.Nearest qualified as Nearest
import Geometry.Offset (Side (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec

-- | The parts of a segment that a cutter touches with its centre at a distance on a side, among all segments of the contour.
parts :: Side -> Mm -> Nearest Segment -> Segment -> [Segment]
parts side distance all' segment = case beside side distance segment of
  Nothing -> []
  Just centres ->
    let near = Nearest.within (Box.inflate distance (Box.ofSegment centres)) all'
        free = Distance.uncovered (minus distance Tolerance.clearance) near centres
     in [part a b | (a, b) <- free, b - a > Tolerance.hair]
  where
    part a b
      | a <= 0 && b >= 1 = segment
      | a <= 0 = fst (Segment.cutAt b segment)
      | b >= 1 = snd (Segment.cutAt a segment)
      | otherwise = snd (Segment.cutAt (a / b) (fst (Segment.cutAt b segment)))

-- | Where the centre is while the cutter rolls along a segment alone, if it can.
beside :: Side -> Mm -> Segment -> Maybe Segment
beside side (Mm d) segment = case segment of
  Straight a b
    | a == b -> Nothing
    | otherwise -> let n = Vec.scale (leftward * d) (Vec.left (Vec.unit (Vec.to a b))) in Just (Straight (Vec.shift n a) (Vec.shift n b))
  Arc {start, end, centre, sweep = sweep@(Rad s)}
    | r <= 0 || grown <= 0 -> Nothing
    | otherwise -> Just Arc {start = moved start, end = moved end, centre, sweep}
    where
      Mm r = Segment.radius centre start
      -- The centre of an arc lies on the left when it is walked counter-clockwise.
      grown = if signum s == leftward then r - d else r + d
      moved p = Vec.shift (Vec.scale (grown / r) (Vec.to centre p)) centre
  where
    leftward = case side of
      LeftOf -> 1
      RightOf -> -1
