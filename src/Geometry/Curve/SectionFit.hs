-- | Curves through a table of points: the fewest straight lines, parabolas and circular arcs that
-- stay within a tolerance of every row, or those that the user has chosen (the second method of the
-- Ural paper, Tables 1–4).
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
    missed,
    parabola,
    row,
    rows,
  )
import Geometry.Tolerance qualified as Tolerance

-- Choosing them ---------------------------------------------------------------------------------

-- | The fewest pieces of some kinds within a tolerance in y; of those the ones whose largest
-- deviation is least; of those the simplest: each piece as simple as it can be without a larger
-- deviation, and the rows so chosen that the kinds are simplest in sum, then that the sum of the
-- deviations is least. Two neighbouring rows can always be joined by a line.
--
-- A piece that misses by more than /twice/ the tolerance d is not extended, and none is lost by
-- that. Say that a piece A from row i goes on beyond row j and keeps within d, and that B is the
-- best of its kind from i to j, missing by D. The difference of two parabolas, or of two arcs that
-- are single-valued in x, from one point on is monotone behind the second point that they have in
-- common (the sine of an arc's slope is linear in x). B misses by D on one side at some row and on
-- the other side at another, or it has a vertical tangent at an end, with the same result. If D >
-- d, A − B has its second zero between these rows, is at least D − d at the later one, and no
-- smaller at row j; but there it is at most d. So D is at most 2·d.
--
-- With n rows, and pieces over at most m of them at twice the tolerance, n·m pairs of rows are
-- looked at: those that are too far apart by the two rows that said so before, the others in one or
-- two passes over the rows between. One piece over the whole table is found at once; the worst is
-- three, about n³/27 times a pass (300 rows a tenth of a second, 1000 rows a second or two).
fit :: NonEmpty SectionKind -> Mm -> PointTable -> NonEmpty Section
fit kinds (Mm tolerance) t = fmap piece (simplest t steps (bottleneck steps))
  where
    steps = layers t (toList (NonEmpty.nub (NonEmpty.sort kinds))) tolerance
    piece (i, j, k) = let (d, c) = best t k i j in pieceOf t i j c (Mm d)

pieceOf :: PointTable -> Int -> Int -> SectionShape -> Mm -> Section
pieceOf t i j curve largest =
  Section {first = i + 1, final = j + 1, from = row t i, to = row t j, curve, largest}

-- | The pieces that start from a row: where they end, with what deviation for each kind.
type Pieces = [(Int, NonEmpty (SectionKind, Double))]

-- | The pieces that a shortest chain can use, by their number in it; each from its first row.
type Layers = NonEmpty (IntMap Pieces)

-- | The rows that can be reached with no fewer than k pieces, from k = 0, until the last row can
-- be.
layers :: PointTable -> [SectionKind] -> Double -> Layers
layers t kinds tolerance = go (IntMap.singleton 0 ()) (IntMap.singleton 0 ())
  where
    final = rows t - 1
    within = tolerance + Tolerance.equal
    go seen current = case IntMap.mapMaybe id (IntMap.mapWithKey (\i _ -> direct i) current) of
      done | not (IntMap.null done) -> done :| []
      _ ->
        let out =
              IntMap.mapWithKey
                (\i _ -> grow (`IntMap.member` seen) i (i + 1) [(k, Nothing) | k <- kinds])
                current
            next = IntMap.fromList [(j, ()) | ps <- IntMap.elems out, (j, _) <- ps]
         in NonEmpty.cons out (go (IntMap.union seen next) next)
    direct i =
      fmap
        (\ks -> [(final, ks)])
        ( NonEmpty.nonEmpty
            [(k, d) | (k, d, _) <- misses [(k, Nothing) | k <- kinds] i final, d <= within]
        )
    -- Longer and longer pieces from a row, of the kinds that can still become good, to rows that
    -- have not been reached; each kind with the rows at which it missed most.
    grow reached i j alive
      | j > final || null alive = []
      | reached j = grow reached i (j + 1) alive
      | otherwise =
        let ms = misses alive i j
            onward =
              if j == i + 1
                then alive
                else [(k, most) | (k, d, most) <- ms, d <= tolerance + within]
            good = [(k, d) | (k, d, _) <- ms, d <= within]
         in maybe id (\g -> ((j, g) :)) (NonEmpty.nonEmpty good) (grow reached i (j + 1) onward)
    misses ks i j
      | j == i + 1 = [(LineKind, 0, Nothing)]
      | otherwise =
        [(k, d, most) | (k, before) <- ks, let (d, _, most) = bestWithin within before t k i j]

-- | The least largest deviation of a chain through the layers.
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

-- | The simplest chain with that largest deviation: first row, last row and kind of each piece. The
-- sum of the deviations is taken in steps of 'Tolerance.equal', so that rounding does not choose;
-- of chains that are alike the one with the earlier rows.
simplest :: PointTable -> Layers -> Double -> NonEmpty (Int, Int, SectionKind)
simplest t steps deviation = case NonEmpty.nonEmpty (reverse walk) of
  Just chain -> chain
  Nothing -> (0, rows t - 1, LineKind) :| []
  where
    (_, _, walk) =
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

-- | What is wrong with the user's sections. Rows and sections are counted from 1.
data SectionFault
  = NoSections
  | -- | a section, and how many rows it names: neither two nor three
    WrongCount Int Int
  | -- | a section, and the row that the table does not have
    NoSuchRow Int Int
  | -- | a section whose rows do not rise
    RowsDoNotRise Int
  | -- | a section, the row with which it begins, and the row where it must
    NotJoined Int Int Int
  | -- | the row with which the last section ends, and the last row of the table
    EndsEarly Int Int
  deriving stock (Eq, Show)

-- | The pieces that the user has chosen: for each the rows, counted from 1, that it goes through.
-- Two are joined by a line, three by a parabola. Each begins with the row with which the one before
-- ends, the first with row 1; the last ends with the last row.
sections :: PointTable -> [[Int]] -> Either SectionFault (NonEmpty Section)
sections t chosen = case NonEmpty.nonEmpty chosen of
  Nothing -> Left NoSections
  Just some -> do
    pieces <- traverse section (NonEmpty.zip (1 :| [2 ..]) some)
    traverse_' joined (zip3 [1 ..] (1 : map final (toList pieces)) (toList pieces))
    let ends = final (NonEmpty.last pieces)
    if ends == rows t then Right pieces else Left (EndsEarly ends (rows t))
  where
    joined (number, before, p) =
      if first p == before then Right () else Left (NotJoined number (first p) before)
    traverse_' f = foldr (\a rest -> f a >> rest) (Right ())
    section (number, ks) = case filter (\k -> k < 1 || k > rows t) ks of
      k : _ -> Left (NoSuchRow number k)
      [] -> case ks of
        [a, b] | a < b -> Right (drawn (a - 1) (b - 1) Line)
        [a, m, b]
          | a < m && m < b ->
            Right (drawn (a - 1) (b - 1) (parabola (row t (a - 1)) (row t (m - 1)) (row t (b - 1))))
        _ | length ks `elem` [2, 3] -> Left (RowsDoNotRise number)
        _ -> Left (WrongCount number (length ks))
    drawn i j c =
      let p = pieceOf t i j c (Mm 0)
       in p {largest = Mm (maximum (map (\k -> abs (missed p (row t k))) [i .. j]))}

-- What they miss by -----------------------------------------------------------------------------

-- | What a row deviates by.
data Deviation = Deviation
  { -- | counted from 1
    ofRow :: Int,
    -- | the piece that the row lies in, counted from 1; the earlier of two
    onPiece :: Int,
    -- | y of the piece less y of the row, as in the paper's tables
    miss :: Mm
  }
  deriving stock (Eq, Show)

-- | The deviation of every row that a piece passes.
deviations :: PointTable -> NonEmpty Section -> [Deviation]
deviations t pieces = concat (zipWith onOne [1 ..] (toList pieces))
  where
    onOne number p =
      [ Deviation k number (Mm (missed p (row t (k - 1))))
        | k <- [(if number == 1 then first p else first p + 1) .. final p]
      ]
