-- | How far a segment lies beyond the reach of others: an element beyond that of the strokes, or a stroke beyond that
-- of the elements. Exact over the whole segment, and fast where there are many others, short ones.
module Verify.Cover
  ( Others (..),
    Beyond (..),
    furthest,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Geometry.Box qualified as Box
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)

-- | What may lie within reach, by an index of it.
data Others a = Others
  { index :: Box.Index a,
    line :: a -> Segment,
    -- | whether it counts at all
    counts :: a -> Bool,
    reach :: Mm,
    -- | how much beyond its reach a point may lie
    allowance :: Mm
  }

-- | How far beyond the reach a point lies, the point, and the others around it.
data Beyond a = Beyond {most :: Mm, place :: Point, around :: [a]}

-- | The most by which a point of a segment lies beyond the reach of all the others, if it is more than a bound. An
-- excess beyond 'lost' is given as that.
furthest :: Others a -> Mm -> Segment -> Maybe (Beyond a)
furthest others least segment
  | covered least = Nothing
  | otherwise = case dropWhile (not . covered) widths of
    [] -> witness lost
    enough : _ -> witness (halve covered least enough)
  where
    covered m = isCovered others (plus (reach others) m) segment
    widths = takeWhile (< lost) (iterate (times 2) (max (times 2 least) (allowance others)))
    witness m = case near others (plus (reach others) m) segment of
      [] -> Nothing
      around ->
        let place = case Distance.uncovered (minus (plus (reach others) m) (times 2 Tolerance.resolution)) (map (line others) around) segment of
              (a, b) : _ -> Segment.at ((a + b) / 2) segment
              [] -> Segment.start segment
         in Just Beyond {most = m, place, around}

-- | An excess that is as good as infinite: the part is not cut there at all.
lost :: Mm
lost = Mm 1e7

-- | Between a value that does not hold and one that does, the smallest that does.
halve :: (Mm -> Bool) -> Mm -> Mm -> Mm
halve holds low high
  | minus high low <= Tolerance.resolution = high
  | holds middle = halve holds low middle
  | otherwise = halve holds middle high
  where
    middle = times 0.5 (plus low high)

-- | The others that have a point of a segment within a distance.
near :: Others a -> Mm -> Segment -> [a]
near others distance segment = filter (counts others) (filter reaches (Box.within (Box.inflate distance (Box.ofSegment segment)) (index others)))
  where
    -- No point of a segment is further from its middle than half of its length.
    reaches a = Distance.toPoint (Segment.at 0.5 segment) (line others a) <= plus distance (times 0.5 (Segment.length segment))

-- | Whether every point of a segment has one of the others within a distance. A few of them are taken first, those
-- nearest to the middle of what the ones before have left; where the nearest is too far, there is a gap.
isCovered :: Others a -> Mm -> Segment -> Bool
isCovered others distance segment = go fewAtMost []
  where
    go :: Int -> [Segment] -> Bool
    go tries few = case Distance.uncovered distance few segment of
      [] -> True
      (a, b) : _
        | tries <= 0 -> null (Distance.uncovered distance (map (line others) (near others distance segment)) segment)
        | otherwise -> case Box.closest away (Segment.at ((a + b) / 2) segment) (index others) of
          Just (d, other) | d <= distance -> go (tries - 1) (line others other : few)
          _ -> False
        where
          away other =
            let d = Distance.toPoint (Segment.at ((a + b) / 2) segment) (line others other)
             in if d > distance || counts others other then d else Mm (1 / 0)

-- | So many are tried before all are.
fewAtMost :: Int
fewAtMost = 20
