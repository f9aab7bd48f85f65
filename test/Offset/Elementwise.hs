-- | The equidistant element by element: the oracle of "Offset.Equidistant".
--
-- Each element is moved sideways, and each corner is passed by a rule about its two elements alone.
-- Nothing is trimmed and no winding number is counted, so the result is right only where the cutter
-- fits. The module shares no code with "Offset.SourceOffset" and "Offset.LoopPath".
module Offset.Elementwise
  ( elementwise,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier (Sense (..), Side (..))
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Offset.Equidistant (CornerStyle (..), OffsetSegment (..), Origin (..))

-- | The equidistant of a contour whose elements and corners the cutter can all pass.
elementwise :: CornerStyle -> Side -> Mm -> Polyarc -> NonEmpty OffsetSegment
elementwise style side radius (Polyarc ends segments) =
  maybe
    (moved side (radiusAt style radius 0) 0 (NonEmpty.head segments) :| [])
    (Polyarc.closeGaps segment (\s p -> p {segment = s}) ends)
    (NonEmpty.nonEmpty (filter isLong (concatMap pieces [0 .. count - 1])))
  where
    isLong p = Segment.length (segment p) > Tolerance.coincident
    count = NonEmpty.length segments
    corners =
      [ corner style side radius i j (segments NonEmpty.!! i) (segments NonEmpty.!! j)
        | i <- [0 .. count - 1 - (if ends == Open then 1 else 0)],
          let j = (i + 1) `mod` count
      ]
    alongElement i = moved side (radiusAt style radius i) i (segments NonEmpty.!! i)
    before i
      | i > 0 = Just (corners !! (i - 1))
      | ends == Open = Nothing
      | otherwise = Just (last corners)
    after i = if i < length corners then Just (corners !! i) else Nothing
    pieces i =
      shortened
        (maybe 0 (\c -> front c) (before i))
        (maybe 0 (\c -> back c) (after i))
        (alongElement i) :
      maybe [] passing (after i)

-- | The segments that pass a corner, and the lengths in mm that the corner cuts off the segments
-- before and after it.
data Corner = Corner {passing :: [OffsetSegment], back, front :: Double}

radiusAt :: CornerStyle -> Mm -> Int -> Mm
radiusAt style radius i = plus radius (extra style i)

leftward :: Side -> Double
leftward side = case side of
  LeftOf -> 1
  RightOf -> -1

-- | The corner between two elements, given their numbers.
corner :: CornerStyle -> Side -> Mm -> Int -> Int -> Segment -> Segment -> Corner
corner style side radius i j before after
  | abs turned <= smooth =
    Corner [around (Straight (from r1 before') (from r2 after')) | r1 /= r2] 0 0
  | turned * leftward side > 0 && r1 == r2 && pi - abs turned > smooth =
    let Mm r = r1
        (b, f) =
          meeting
            (r * tan (abs turned / 2))
            (segment (moved side r1 i before))
            (segment (moved side r2 j after))
     in Corner [] b f
  | sharp style && r1 == r2 && abs turned <= 2 * pi / 3 =
    passed [Straight (from r1 before') (tip r1), Straight (tip r1) (from r2 after')]
  | r1 == r2 = passed [rounded r1]
  | r1 < r2 = passed [Straight (from r1 before') (from r2 before'), rounded r2]
  | otherwise = passed [rounded r1, Straight (from r1 after') (from r2 after')]
  where
    passed pieces = Corner (map around pieces) 0 0
    around = OffsetSegment (Around i)
    r1 = radiusAt style radius i
    r2 = radiusAt style radius j
    Rad smooth = Tolerance.smoothAngle
    Rad turned = Vec.signedAngle before' after'
    before' = Segment.endDirection before
    after' = Segment.startDirection after
    vertex = Segment.end before
    from (Mm r) direction = Vec.shift (Vec.scale (leftward side * r) (Vec.left direction)) vertex
    tip (Mm r) = Vec.shift (Vec.scale (r * tan (abs turned / 2)) before') (from (Mm r) before')
    rounded r = Segment.arc sense vertex (from r before') (from r after')
    sense = case side of
      LeftOf -> Clockwise
      RightOf -> CounterClockwise

-- | The lengths cut off two segments at their intersection near a slight corner, by Newton's
-- method. For two lines both are @t@.
meeting :: Double -> Segment -> Segment -> (Double, Double)
meeting t before after = case (before, after) of
  (Straight _ _, Straight _ _) -> (t, t)
  _ -> go (3 :: Int) t t
  where
    Mm l = Segment.length before
    Mm l' = Segment.length after
    go n a b
      | n == 0 = (a, b)
      | a' > 0 && a' < min l (2 * t) && b' > 0 && b' < min l' (2 * t) = go (n - 1) a' b'
      | otherwise = (t, t)
      where
        (k, k') = (1 - a / l, b / l')
        (u, v) = (Segment.directionAt k before, Segment.directionAt k' after)
        gap = Vec.to (Segment.at k before) (Segment.at k' after)
        a' = a - Vec.cross gap v / Vec.cross u v
        b' = b - Vec.cross u gap / Vec.cross u v

-- | Cuts lengths in mm off the start and off the end of a segment.
shortened :: Double -> Double -> OffsetSegment -> OffsetSegment
shortened front back p
  | front + back <= 0 = p
  | otherwise =
    p
      { segment =
          snd
            (Segment.cutAt (front / (l - back)) (fst (Segment.cutAt (1 - back / l) (segment p))))
      }
  where
    Mm l = Segment.length (segment p)

-- | The offset of one element.
moved :: Side -> Mm -> Int -> Segment -> OffsetSegment
moved side (Mm r) number s = case s of
  Straight a b ->
    let n = Vec.scale (leftward side * r) (Vec.left (Vec.unit (Vec.to a b)))
     in OffsetSegment (Along number) (Straight (Vec.shift n a) (Vec.shift n b))
  Arc {start, end, centre, sweep = sweep@(Rad angle)} ->
    let Mm before = Segment.radius centre start
        after = if signum angle == leftward side then max 0 (before - r) else before + r
        shifted p = Vec.shift (Vec.scale (after / before) (Vec.to centre p)) centre
     in OffsetSegment (Along number) Arc {start = shifted start, end = shifted end, centre, sweep}
