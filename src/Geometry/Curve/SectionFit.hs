-- | Piecewise fit of a table of points (second method of the paper on the Ural-1 computer, Tables
-- 1–4). A section is a line, a parabola or a circular arc from one row to a later one. The fit has
-- the fewest sections within a tolerance of every row, or the sections that the user chooses.
module Geometry.Curve.SectionFit
  ( fit,
    sections,
    SectionFault (..),
    Deviation (..),
    deviations,
  )
where

import Base.Quantity (Mm (..))
import Data.Foldable (toList)
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Geometry.Curve.Section
  ( PointTable,
    Section (..),
    SectionKind (..),
    SectionShape (..),
    best,
    bestWithin,
    deviationFrom,
    parabola,
    row,
    rows,
  )
import Geometry.Tolerance qualified as Tolerance

-- Choice of sections ---------------------------------------------------------------------------

-- | Best fit by sections of the given kinds within a tolerance in y. Fits are compared by these
-- numbers, of which the smaller one is better. A later number decides only between fits that are
-- equal in the earlier ones.
--
-- 1. the number of sections
-- 2. the largest deviation of a row
-- 3. the sum of the ranks of the sections: the rank is the index of the section's kind in
--    'SectionKind'
-- 4. the sum of the largest deviations of the sections
--
-- A fit always exists, because a line joins any two neighbouring rows.
--
-- A section that deviates by more than /twice/ the tolerance d is not extended. This pruning loses
-- no fit. Proof: let a section A start at row i, end after row j and keep within d. Let B be the
-- best section of the same kind from i to j, with the largest deviation D. The difference of two
-- parabolas has at most one extremum. The same is true of two arcs that are single-valued in x,
-- since the sine of an arc's slope angle is linear in x. The difference A − B has its first zero at
-- row i, and is monotone from its second zero on. B deviates by D to one side at some row and to
-- the other side at another row. If D > d, then A − B has its second zero between these two rows.
-- The absolute value of A − B is at least D − d at the later of these rows, and no smaller at row
-- j. At row j it is at most d, since B passes through this row and A keeps within d. So D is at
-- most 2·d. The result holds also if B is an arc with a vertical tangent at an end, which may
-- deviate by D to one side only.
--
-- With n rows, and sections of at most m rows within twice the tolerance, n·m pairs of first and
-- last rows are tested. Most pairs are rejected by the two rows that rejected the previous pair;
-- the others take one or two passes over the rows between. A single section over the whole table is
-- found at once. The worst case is three sections: they take about n³/27 evaluations of a section
-- (300 rows take a tenth of a second, 1000 rows a second or two).
fit :: NonEmpty SectionKind -> Mm -> PointTable -> NonEmpty Section
fit kinds (Mm tolerance) t = fmap section (simplest t steps (bottleneck steps))
  where
    steps = layers t (toList (NonEmpty.nub (NonEmpty.sort kinds))) tolerance
    section (i, j, k) = let (d, c) = best t k i j in sectionBetween t i j c (Mm d)

-- | Section between the rows @i@ and @j@ (indices from 0) with a shape and its largest deviation.
sectionBetween :: PointTable -> Int -> Int -> SectionShape -> Mm -> Section
sectionBetween t i j curve largestDeviation =
  Section {first = i + 1, final = j + 1, from = row t i, to = row t j, curve, largestDeviation}

-- | Sections that start at one row. Each has the index of its last row, from 0, and the kinds that
-- are possible, with their largest deviations in mm.
type SectionsFrom = [(Int, NonEmpty (SectionKind, Double))]

-- | Sections that a fit with the fewest sections can contain. The list has one map for the first
-- section of a fit, one for the second, and so on. The key is the index of a section's first row,
-- from 0.
type Layers = NonEmpty (IntMap SectionsFrom)

-- | Layers within @tolerance@ (mm), by breadth-first search from the first row to the last. Step k
-- finds the rows that are reached by k sections and not by fewer.
layers :: PointTable -> [SectionKind] -> Double -> Layers
layers t kinds tolerance = go (IntMap.singleton 0 ()) (IntMap.singleton 0 ())
  where
    final = rows t - 1
    within = tolerance + Tolerance.equal
    go seen current = case IntMap.mapMaybe id (IntMap.mapWithKey (\i _ -> direct i) current) of
      done | not (IntMap.null done) -> done :| []
      _ ->
        let reachable =
              IntMap.mapWithKey
                (\i _ -> lengthen (`IntMap.member` seen) i (i + 1) [(k, Nothing) | k <- kinds])
                current
            next = IntMap.fromList [(j, ()) | ps <- IntMap.elems reachable, (j, _) <- ps]
         in NonEmpty.cons reachable (go (IntMap.union seen next) next)
    direct i =
      fmap
        (\ks -> [(final, ks)])
        ( NonEmpty.nonEmpty
            [(k, d) | (k, d, _) <- deviationsOf [(k, Nothing) | k <- kinds] i final, d <= within]
        )
    -- Sections that begin at row @i@ and end at row @j@ or a later row, of each candidate kind.
    -- Drops the kinds that can no longer come within the tolerance. Skips rows that were reached by
    -- fewer sections. Each kind comes with the pair of rows that determines the deviation of its
    -- section up to row @j − 1@, if it is known. 'bestWithin' starts its search with this pair.
    lengthen reached i j candidates
      | j > final || null candidates = []
      | reached j = lengthen reached i (j + 1) candidates
      | otherwise =
        let ms = deviationsOf candidates i j
            survivors =
              if j == i + 1
                then candidates
                else [(k, most) | (k, d, most) <- ms, d <= tolerance + within]
            good = [(k, d) | (k, d, _) <- ms, d <= within]
         in maybe
              id
              (\g -> ((j, g) :))
              (NonEmpty.nonEmpty good)
              (lengthen reached i (j + 1) survivors)
    deviationsOf ks i j
      | j == i + 1 = [(LineKind, 0, Nothing)]
      | otherwise =
        [(k, d, most) | (k, before) <- ks, let (d, _, most) = bestWithin within before t k i j]

-- | Largest deviation (mm) of the fit in which it is least, among all fits through the layers.
bottleneck :: Layers -> Double
bottleneck steps = minimum (IntMap.elems (foldl advance (IntMap.singleton 0 0) steps))
  where
    advance reached layer =
      IntMap.fromListWith
        min
        [ (j, max before (minimum (fmap snd ks)))
          | (i, ps) <- IntMap.toList layer,
            Just before <- [IntMap.lookup i reached],
            (j, ks) <- ps
        ]

-- | Simplest fit whose largest deviation is at most @deviation@ (mm): index of the first row, index
-- of the last row (both from 0), and kind of each section. The simplest fit has the least sum of
-- the ranks of its sections, which are the indices of their kinds. Of fits with the same sum, it
-- has the least sum of their largest deviations. Deviations are rounded to whole steps of
-- 'Tolerance.equal', so that errors of the arithmetic do not decide. Of equally good fits, the one
-- whose sections end at earlier rows is taken.
simplest :: PointTable -> Layers -> Double -> NonEmpty (Int, Int, SectionKind)
simplest t steps deviation = case NonEmpty.nonEmpty (reverse reversedChain) of
  Just chain -> chain
  Nothing -> (0, rows t - 1, LineKind) :| []
  where
    (_, _, reversedChain) =
      minimumBy
        (comparing cost)
        (IntMap.elems (foldl advance (IntMap.singleton 0 (0 :: Int, 0 :: Int, [])) steps))
    cost (rank, total, _) = (rank, total)
    advance reached layer =
      IntMap.fromListWith
        (\new old -> if cost new < cost old then new else old)
        [ (j, (rank + fromEnum k, total + round (d / Tolerance.equal), (i, j, k) : chain))
          | (i, ps) <- IntMap.toList layer,
            Just (rank, total, chain) <- [IntMap.lookup i reached],
            (j, ks) <- ps,
            (k, d) <- take 1 (NonEmpty.filter ((<= deviation + Tolerance.equal) . snd) ks)
        ]

-- | Fault of the sections that the user chose. Rows and sections are counted from 1.
data SectionFault
  = NoSections
  | -- | the number of a section, and the count of its rows, which is neither two nor three
    WrongCount Int Int
  | -- | the number of a section, and a row that the table does not have
    NoSuchRow Int Int
  | -- | the number of a section whose row numbers do not rise
    RowsDoNotRise Int
  | -- | the number of a section, the row at which it begins, and the row at which it must begin
    NotJoined Int Int Int
  | -- | the row at which the last section ends, and the last row of the table
    EndsEarly Int Int
  deriving stock (Eq, Show)

-- | Sections that the user chooses. Each inner list of @chosen@ has the rows, counted from 1,
-- through which a section passes: two rows give a line, three rows a parabola. The first section
-- must begin at row 1, and every other one at the last row of the section before it. The last
-- section must end at the last row of the table.
sections :: PointTable -> [[Int]] -> Either SectionFault (NonEmpty Section)
sections t chosen = case NonEmpty.nonEmpty chosen of
  Nothing -> Left NoSections
  Just some -> do
    found <- traverse section (NonEmpty.zip (1 :| [2 ..]) some)
    checkAll checkJoined (zip3 [1 ..] (1 : map final (toList found)) (toList found))
    let ends = final (NonEmpty.last found)
    if ends == rows t then Right found else Left (EndsEarly ends (rows t))
  where
    checkJoined (number, before, p) =
      if first p == before then Right () else Left (NotJoined number (first p) before)
    checkAll f = foldr (\a rest -> f a >> rest) (Right ())
    section (number, ks) = case filter (\k -> k < 1 || k > rows t) ks of
      k : _ -> Left (NoSuchRow number k)
      [] -> case ks of
        [a, b] | a < b -> Right (chosenSection (a - 1) (b - 1) Line)
        [a, m, b]
          | a < m && m < b ->
            let through = parabola (row t (a - 1)) (row t (m - 1)) (row t (b - 1))
             in Right (chosenSection (a - 1) (b - 1) through)
        _ | length ks `elem` [2, 3] -> Left (RowsDoNotRise number)
        _ -> Left (WrongCount number (length ks))
    chosenSection i j c =
      let p = sectionBetween t i j c (Mm 0)
       in p {largestDeviation = Mm (maximum (map (\k -> abs (deviationFrom p (row t k))) [i .. j]))}

-- Deviations ------------------------------------------------------------------------------------

-- | Vertical distance of a row from the section that contains it.
data Deviation = Deviation
  { -- | number of the row, counted from 1
    rowNumber :: Int,
    -- | number of the section that contains the row, counted from 1; the earlier one if two meet at
    -- the row
    sectionNumber :: Int,
    -- | y of the section minus y of the row, as in the paper's tables
    signedDeviation :: Mm
  }
  deriving stock (Eq, Show)

-- | Deviations of all rows from the sections. A row at which two sections meet is listed once, with
-- the earlier section.
deviations :: PointTable -> NonEmpty Section -> [Deviation]
deviations t fitted = concat (zipWith onOne [1 ..] (toList fitted))
  where
    onOne number p =
      [ Deviation k number (Mm (deviationFrom p (row t (k - 1))))
        | k <- [(if number == 1 then first p else first p + 1) .. final p]
      ]
