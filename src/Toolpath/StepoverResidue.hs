-- | Residue between passes whose distance exceeds the cutter's radius, and the detours that clear
-- it.
--
-- A /pass/ consists of all loops of the centre at one distance from the walls. Let @r@ be the
-- cutter's radius. Let passes run at the distances @c@ and @c + s@, with @r < s ≤ 2·r@. Between
-- them, at @c + r@, lies the /edge/: the border of the area that the outer pass sweeps. A point
-- between the edge and the inner pass has a distance of at most @s − r ≤ r@ from the edge. Where
-- the inner pass is parallel to the edge at the distance @s − r@, the cutter sweeps all points
-- between the two. Elsewhere the edge has a corner or a narrow part that the inner pass does not
-- enter. There the cutter makes a /detour/ along the edge itself.
module Toolpath.StepoverResidue
  ( Residue (..),
    none,
    between,
  )
where

import Base.Quantity (Mm (..), Rad (..), total)
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance

-- | The additional paths that clear residue.
data Residue = Residue
  { -- | detours from the inner pass; the key is the number of a loop of that pass, and of the
    -- segment at whose end the detour begins and ends, both from 0
    detours :: Map (Int, Int) [NonEmpty Segment],
    -- | loops of the edge. The inner pass runs beside no part of these loops
    isolated :: [NonEmpty Segment]
  }

-- | The value for passes without residue.
none :: Residue
none = Residue Map.empty []

-- | The paths that clear the residue between the edge, whose loops are @edges@, and the inner pass,
-- whose loops are @passes@. @apart@ is the distance of the inner pass from the edge. It is at most
-- the cutter's @radius@. All loops have the free space on their left.
between :: Mm -> Mm -> [NonEmpty Segment] -> [NonEmpty Segment] -> Residue
between radius apart edges passes = foldr (gather . gapsOf) none edges
  where
    gather found (Residue ts ls) = case found of
      Nothing -> Residue ts ls
      Just (Left loop) -> Residue ts (loop : ls)
      Just (Right gaps) -> Residue (foldr add ts gaps) ls
    add gap ts =
      maybe
        ts
        (\(at, detour) -> Map.insertWith (<>) at [detour] ts)
        (detourAlong radius ends gap)
    ends =
      Map.fromList
        [ (n, Ends (length loop) (Map.fromList (zip [0 ..] (map end (NonEmpty.toList loop)))))
          | (n, loop) <- zip [0 ..] passes
        ]
    index =
      BoxTree.index
        (BoundingBox.inflate Tolerance.clearance . BoundingBox.ofSegment . snd)
        [ ((n, i), s')
          | (n, loop) <- zip [0 ..] passes,
            (i, s) <- zip [0 ..] (NonEmpty.toList loop),
            Just s' <- [Segment.offset Carrier.RightOf apart s]
        ]
    gapsOf edge = gapsIn edge (concatMap (divided index) (NonEmpty.toList edge))

-- | The count of a loop's segments, and the end point of each segment by its number, from 0.
data Ends = Ends Int (Map Int Point)

-- | A part of the edge. 'Beside': the inner pass runs beside the part, on the segment with these
-- numbers of loop and segment. 'Free': the inner pass does not run beside the part.
data EdgePart = Beside (Int, Int) | Free Segment

-- | Consecutive free parts of the edge, between two parts beside which the inner pass runs. Each
-- pair has the numbers of loop and segment of the inner pass: the first pair beside the part of the
-- edge before the gap, the second beside the part after it.
data Gap = Gap (Int, Int) (NonEmpty Segment) (Int, Int)

-- | The gaps in a loop of the edge. @marks@ are the parts of the loop in order. Nothing when there
-- are no gaps. 'Left' with the whole loop @edge@ when the inner pass runs beside no part of it.
gapsIn :: NonEmpty Segment -> [EdgePart] -> Maybe (Either (NonEmpty Segment) [Gap])
gapsIn edge marks = case break isBeside marks of
  (_, []) -> Just (Left edge)
  (before, Beside first : rest) -> case gapsAfter first (rest <> before <> [Beside first]) of
    [] -> Nothing
    gaps -> Just (Right gaps)
  (_, Free _ : _) -> Nothing
  where
    isBeside m = case m of
      Beside _ -> True
      Free _ -> False
    gapsAfter owner ms = case break isBeside ms of
      (free, Beside next : more) ->
        [Gap owner gap next | Just gap <- [worthwhile [s | Free s <- free]]] <> gapsAfter next more
      (_, _) -> []
    worthwhile ss
      | total (map Segment.length ss) <= Tolerance.clearance = Nothing
      | otherwise = NonEmpty.nonEmpty (filter ((> Tolerance.coincident) . Segment.length) ss)

-- | The detour along a gap. It leaves the inner pass at the end of the segment that the first pair
-- of the gap names, follows the gap, and returns to that end. The result has this pair and the
-- detour. If the pairs of the gap name neighbouring segments, these meet at a corner of the inner
-- pass. When the whole gap then lies within the cutter's radius of the corner, the inner pass
-- clears the gap, and the result is Nothing.
detourAlong :: Mm -> Map Int Ends -> Gap -> Maybe ((Int, Int), NonEmpty Segment)
detourAlong radius ends (Gap owner@(loop, i) free next) = do
  Ends count corners <- Map.lookup loop ends
  corner <- Map.lookup i corners
  let isCorner = next == (loop, (i + 1) `mod` count)
      out = Straight corner (start (NonEmpty.head free)) : NonEmpty.toList free
      back
        | isCorner = [Straight (end (NonEmpty.last free)) corner]
        | otherwise = reverse (map Segment.reverse out)
  if isCorner && all ((<= radius) . furthest corner) free
    then Nothing
    else
      (owner,)
        <$> NonEmpty.nonEmpty (filter ((> Tolerance.coincident) . Segment.length) (out <> back))

-- | The largest distance of the point @p@ from a point of the segment @s@.
furthest :: Point -> Segment -> Mm
furthest p s = case s of
  Straight a b -> max (Vec.distance p a) (Vec.distance p b)
  Arc {start = a, end = b, centre}
    | opposite /= centre && Segment.hasFootOf s opposite ->
      let Mm d =
            Vec.distance p centre
          Mm r = Segment.radius centre a
       in Mm (d + r)
    | otherwise -> max (Vec.distance p a) (Vec.distance p b)
    where
      opposite = Vec.shift (Vec.to p centre) centre

-- | Divides the segment @s@ of the edge into the parts beside segments of the inner pass and the
-- free parts between them. @index@ contains the offsets of the segments of the inner pass, at the
-- distance between the inner pass and the edge. Where the two are parallel, such an offset lies on
-- the edge. Each offset comes with the numbers, from 0, of loop and segment.
divided :: BoxTree ((Int, Int), Segment) -> Segment -> [EdgePart]
divided index s =
  partsFrom
    0
    ( sortOn
        (fst . fst)
        [ (range, owner)
          | (owner, other) <- BoxTree.within (BoundingBox.ofSegment s) index,
            range <- covered s other
        ]
    )
  where
    partsFrom from ranges = case ranges of
      [] -> [Free (part from 1) | from < 1]
      ((a, b), owner) : rest
        | b <= from -> partsFrom from rest
        | otherwise -> [Free (part from a) | a > from] <> [Beside owner] <> partsFrom b rest
    part a b
      | a <= 0 && b >= 1 = s
      | b >= 1 = snd (Segment.cutAt a s)
      | otherwise =
        let front =
              fst (Segment.cutAt b s)
         in if a <= 0 then front else snd (Segment.cutAt (a / b) front)

-- | The parts of the segment @s@ that coincide with the segment @other@ and have the same
-- direction. Each is given by its beginning and end as fractions of the length of @s@, from 0 to 1.
covered :: Segment -> Segment -> [(Double, Double)]
covered s other = filter coincides (filter (uncurry (<)) (map clip ranges))
  where
    clip (a, b) = (max 0 a, min 1 b)
    coincides (a, b) =
      all (\t -> Distance.toPoint (Segment.at t s) other <= Tolerance.clearance) [a, (a + b) / 2, b]
    ranges = case (s, other) of
      (Straight a b, Straight c d) | a /= b -> [(Segment.fraction s c, Segment.fraction s d)]
      (Arc {start = a, centre, sweep = Rad w}, Arc {start = c, sweep = Rad v})
        | w * v > 0 ->
          let Rad angle = Vec.signedAngle (Vec.to centre a) (Vec.to centre c)
              ahead = signum w * angle
           in [ ((ahead + k * 2 * pi) / abs w, (ahead + k * 2 * pi + abs v) / abs w)
                | k <- [-1, 0, 1]
              ]
      _ -> []
