{-# OPTIONS_GHC -O2 #-}

-- | How far a segment lies beyond the reach of others: an element beyond that of the strokes, or a
-- stroke beyond that of the elements. Exact over the whole segment, and fast where there are many
-- others, short ones.
module Verify.Coverage
  ( Others (..),
    DistanceBounds (..),
    Beyond (..),
    furthest,
    distanceTo,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Base.Quantity (Mm (..), minus, plus, times)
import Data.List (sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Offset.Tolerance qualified as Tolerance
import Prelude hiding (lines)

-- | What may lie within reach, by an index of it.
data Others a = Others
  { index :: BoxTree a,
    -- | what has to be within reach of it: all of these
    lines :: a -> NonEmpty Segment,
    -- | whether it counts at all
    counts :: a -> Bool,
    reach :: Mm,
    -- | how much beyond its reach a point may lie
    allowance :: Mm
  }

-- | What is known of a segment without comparing exactly: one of its points is further from all the
-- others than the one, and none is further from all of them than the other.
data DistanceBounds = DistanceBounds {atLeast :: Mm, atMost :: Mm}

-- | How far beyond the reach a point lies, the point, and the others around it.
data Beyond a = Beyond {most :: Mm, place :: Point, around :: [a]}

-- | The most by which a point of a segment lies beyond the reach of all the others, if it is more
-- than a bound. An excess beyond 'lost' is given as that.
furthest :: Others a -> Maybe DistanceBounds -> Mm -> Segment -> Maybe (Beyond a)
furthest others known least segment
  | covered least = Nothing
  | otherwise = case dropWhile (not . covered) widths of
    [] -> witness lost
    enough : _ ->
      witness (snd (BinarySearch.turningPoint Tolerance.resolution (not . covered) least enough))
  where
    covered m = case known of
      Just DistanceBounds {atMost} | plus (reach others) m > plus atMost touching -> True
      Just DistanceBounds {atLeast} | plus (reach others) m < minus atLeast touching -> False
      _ -> isCovered others (plus (reach others) m) segment
    widths = takeWhile (< lost) (iterate (times 2) (max (times 2 least) (allowance others)))
    witness m = case near others (plus (reach others) m) segment of
      [] -> Nothing
      around ->
        let place =
              case uncovered
                (minus (plus (reach others) m) (times 2 Tolerance.resolution))
                (map (lines others) around)
                segment of
                (a, b) : _ -> Segment.at ((a + b) / 2) segment
                [] -> Segment.start segment
         in Just Beyond {most = m, place, around}

-- | An excess that is as good as infinite: the part is not cut there at all.
lost :: Mm
lost = Mm 1e7

-- | What two circles miss one another by may be so much and pass for a touch.
touching :: Mm
touching = times 3 Tolerance.coincident

-- | The others that have a point of a segment within a distance.
near :: Others a -> Mm -> Segment -> [a]
near others distance segment =
  filter
    (counts others)
    ( filter
        reaches
        ( BoxTree.within
            (BoundingBox.inflate distance (BoundingBox.ofSegment segment))
            (index others)
        )
    )
  where
    -- No point of a segment is further from its middle than half of its length.
    reaches a =
      distanceTo (Segment.at 0.5 segment) (lines others a)
        <= plus distance (times 0.5 (Segment.length segment))

-- | Whether every point of a segment has one of the others within a distance. Many others are
-- walked past one by one: from where the last one ends to cover the segment, the one that is
-- nearest there covers the next stretch of it.
isCovered :: Others a -> Mm -> Segment -> Bool
isCovered others distance segment
  | null (drop fewAtMost all') = together
  | otherwise = from 0
  where
    all' = map (lines others) (near others distance segment)
    together = null (uncovered distance all' segment)
    from t = case nearestAt t of
      Nothing -> False
      Just other -> case [g | g@(_, b) <- uncovered distance [lines others other] segment, b > t] of
        [] -> True
        (a, _) : _
          | a > t + Tolerance.hair -> from a
          -- It ends right here, and what is nearest a hair further on does not begin before.
          | otherwise -> maybe False (const together) (nearestAt (min 1 (t + Tolerance.hair)))
    nearestAt t =
      let p = Segment.at t segment
       in case BoxTree.closest (away p) p (index others) of
            Just (d, other) | d <= distance -> Just other
            _ -> Nothing
    away p other =
      let d = distanceTo p (lines others other)
       in if d > distance || counts others other then d else Mm (1 / 0)

-- | How far a point is from that of some lines from which it is furthest.
distanceTo :: Point -> NonEmpty Segment -> Mm
distanceTo p = maximum . fmap (Distance.toPoint p)

-- | The stretches of a segment, as fractions of its length, for which none of the others has all of
-- its lines within a distance.
uncovered :: Mm -> [NonEmpty Segment] -> Segment -> [(Double, Double)]
uncovered distance others segment =
  foldl
    inBoth
    (Distance.uncovered distance [s | s :| [] <- others] segment)
    [gaps ss | ss@(_ :| _ : _) <- others]
  where
    gaps ss =
      inEither
        (sort (concatMap (\s -> Distance.uncovered distance [s] segment) (NonEmpty.toList ss)))

-- | What two lists of stretches have in common; each is in order and does not overlap itself.
inBoth :: [(Double, Double)] -> [(Double, Double)] -> [(Double, Double)]
inBoth as bs = case (as, bs) of
  ((a, b) : as', (c, d) : bs') ->
    [(max a c, min b d) | max a c < min b d] <> if b <= d then inBoth as' bs else inBoth as bs'
  _ -> []

-- | Stretches in the order of their beginnings, those that overlap as one.
inEither :: [(Double, Double)] -> [(Double, Double)]
inEither stretches = case stretches of
  (a, b) : (c, d) : rest | c <= b -> inEither ((a, max b d) : rest)
  s : rest -> s : inEither rest
  [] -> []

-- | So many others are taken together.
fewAtMost :: Int
fewAtMost = 30
