-- | Outlines: the paths of a drawing, joined at their ends.
--
-- A path is a chain of parts. Two ends are joined if they are within a tolerance of each other and
-- no third end is. Where three ends meet, the drawing does not say which of them belong together,
-- so that is a fault. Of two paths that coincide, the later one is left out.
module Drawing.Outline
  ( Outline (..),
    DrawnPart (..),
    Joining (..),
    ClosedGap (..),
    JoinFault (..),
    joined,
    openBy,
  )
where

import Base.Quantity (Mm (..), plus, times, total)
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet qualified as IntSet
import Data.List (sort, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Data.Semigroup (sconcat)
import Drawing.Drawing (Ellipse, Entity, PathPart (..), Shape (..))
import Drawing.Drawing qualified as Drawing
import Drawing.OutlineTolerance qualified as Tolerance
import Drawing.PathPart qualified as PathPart
import Geometry.Carrier (Circle (..), Sense (CounterClockwise))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | A chain of parts; each begins exactly where the one before it ends. The last part of a closed
-- outline ends where the first one begins.
data Outline = Outline {ends :: Ends, parts :: NonEmpty DrawnPart}
  deriving stock (Eq, Show)

-- | A part of an outline, with its entity.
data DrawnPart = DrawnPart {entity :: Entity, part :: PathPart}
  deriving stock (Eq, Show)

-- | The outlines of some entities.
data Joining = Joining
  { -- | outlines in the order of their first entities
    outlines :: [Outline],
    -- | the gaps that were closed, without those below 'Tolerance.same'
    gaps :: [ClosedGap],
    -- | the entities that were left out because they coincide with an earlier one, each with it
    repeated :: [(Entity, Entity)],
    faults :: [JoinFault]
  }
  deriving stock (Eq, Show)

-- | A gap between two ends that was closed: its width, the entities, and the place of the joint.
data ClosedGap = ClosedGap {width :: Mm, before :: Entity, after :: Entity, joint :: Point}
  deriving stock (Eq, Show)

-- | A reason for which outlines cannot be made.
data JoinFault
  = -- | more than two ends meet at a point: the entities
    Branch Point (NonEmpty Entity)
  | -- | two entities run along the same line or circle over a length
    Overlap Entity Entity Mm Point
  deriving stock (Eq, Show)

-- | A chain of parts between two free ends.
data Chain = Chain {first :: Point, final :: Point, links :: NonEmpty DrawnPart}

-- | Joins the paths of some entities. Ends within the tolerance of each other are joined.
joined :: Mm -> [Entity] -> Joining
joined tolerance entities =
  Joining
    { outlines = map snd (sortOn fst (zip (map lineOf made) made)),
      gaps = concatMap snd closings,
      repeated = [(e, original) | (e, Just original) <- marked],
      faults = branches <> overlaps tolerance (concatMap (NonEmpty.toList . parts) made)
    }
  where
    marked = withOriginals entities
    kept = [e | (e, Nothing) <- marked]
    whole = mapMaybe wholeOutline kept
    chains = IntMap.fromList (zip [0 ..] (mapMaybe openChain kept))
    (partners, branches) = partnersOf tolerance chains
    closings = map closed (walks chains partners)
    made = whole <> map fst closings
    lineOf o = Drawing.line (entity (NonEmpty.head (parts o)))
    closed = withoutGaps

-- | The distance between the ends of an open outline that is probably meant to be closed: at most
-- 'Tolerance.nearEnds' or 'Tolerance.nearShare' of its length, and at most 'Tolerance.farShare' of
-- it. Nothing for others.
openBy :: Outline -> Maybe Mm
openBy o
  | ends o == Open && gap <= limit = Just gap
  | otherwise = Nothing
  where
    gap = Vec.distance (PathPart.start (part (NonEmpty.head (parts o)))) (PathPart.end final)
    final = part (NonEmpty.last (parts o))
    whole = total [Segment.length s | p <- NonEmpty.toList (parts o), s <- segmentsOf (part p)]
    segmentsOf = NonEmpty.toList . PathPart.segments
    limit =
      min (times Tolerance.farShare whole) $
        max Tolerance.nearEnds (times Tolerance.nearShare whole)

-- | An entity that is an outline by itself.
wholeOutline :: Entity -> Maybe Outline
wholeOutline e = case Drawing.shape e of
  Path Closed ps -> Just (Outline Closed (fmap (DrawnPart e) ps))
  FullCircle circle@(Circle c (Mm r)) ->
    let begin = Vec.shift (Vec.vec r 0) c
     in alone (Plain (Segment.fullCircle CounterClockwise circle begin))
  FullEllipse ellipse -> alone (wholeEllipse ellipse)
  _ -> Nothing
  where
    alone p = Just (Outline Closed (DrawnPart e p :| []))

wholeEllipse :: Ellipse -> PathPart
wholeEllipse ellipse = EllipseArc ellipse 0 (2 * pi)

openChain :: Entity -> Maybe Chain
openChain e = case Drawing.shape e of
  Path Open ps ->
    Just
      Chain
        { first = PathPart.start (NonEmpty.head ps),
          final = PathPart.end (NonEmpty.last ps),
          links = fmap (DrawnPart e) ps
        }
  _ -> Nothing

-- Ends --------------------------------------------------------------------------------------------

-- | The ends of the chains: that of the chain @k@ at its start has the number 2·k, that at its end
-- 2·k + 1.
pointAt :: IntMap Chain -> Int -> Point
pointAt chains n =
  let c = chains IntMap.! (n `div` 2) in if even n then first c else final c

-- | The end that is joined to each end, and the places at which more than two ends meet.
partnersOf :: Mm -> IntMap Chain -> (IntMap Int, [JoinFault])
partnersOf tolerance chains = (IntMap.fromList single, branches)
  where
    numbers = concat [[2 * k, 2 * k + 1] | k <- IntMap.keys chains]
    cells = Map.fromListWith (<>) [(cellOf tolerance (pointAt chains n), [n]) | n <- numbers]
    near n =
      [ m
        | m <- around tolerance cells (pointAt chains n),
          m /= n,
          m `div` 2 /= n `div` 2 || isAway (pointAt chains n) (chains IntMap.! (n `div` 2)),
          Vec.distance (pointAt chains m) (pointAt chains n) <= reach
      ]
    -- The ends of a chain that does not leave them, such as a short line, are not joined.
    isAway p c = any ((> reach) . Vec.distance p . PathPart.middlePoint . part) (links c)
    -- A gap that is as wide as the tolerance may come in wider by rounding.
    reach = plus tolerance Tolerance.rounding
    found = [(n, near n) | n <- numbers]
    single = [(n, m) | (n, [m]) <- found, near m == [n]]
    crowded = [(n, ms) | (n, ms@(_ : _ : _)) <- found, all (n <) ms]
    branches =
      [ Branch (pointAt chains n) (fmap (entityAt . (`div` 2)) (n :| ms))
        | (n, ms) <- crowded
      ]
    entityAt k = entity (NonEmpty.head (links (chains IntMap.! k)))

-- | The square cell of a grid in which a point lies; its side is twice the tolerance.
cellOf :: Mm -> Point -> (Int, Int)
cellOf (Mm tolerance) p = (index (Vec.x p), index (Vec.y p))
  where
    index v = floor (v / (2 * tolerance))

-- | Contents of the cell of a point and of the cells beside it.
around :: Mm -> Map (Int, Int) [a] -> Point -> [a]
around tolerance cells p =
  concat
    [ Map.findWithDefault [] (i + a, j + b) cells
      | a <- [-1, 0, 1],
        b <- [-1, 0, 1]
    ]
  where
    (i, j) = cellOf tolerance p

-- | The chains in the order in which they are joined: open walks from their free ends, then closed
-- ones. Each walk has its ends, and its chains in its direction.
walks :: IntMap Chain -> IntMap Int -> [(Ends, NonEmpty Chain)]
walks chains partners = open free IntSet.empty
  where
    free = [n | k <- IntMap.keys chains, n <- [2 * k, 2 * k + 1], IntMap.notMember n partners]
    open starts done = case starts of
      [] -> loops (IntMap.keys chains) done
      n : more
        | IntSet.member (n `div` 2) done -> open more done
        | otherwise ->
          let ns = walk n in (Open, fmap chainFrom ns) : open more (visited ns done)
    loops ks done = case ks of
      [] -> []
      k : more
        | IntSet.member k done -> loops more done
        | otherwise ->
          let ns = walk (2 * k) in (Closed, fmap chainFrom ns) : loops more (visited ns done)
    visited ns done = foldr (IntSet.insert . (`div` 2)) done ns
    -- The ends at which the walk enters its chains; it begins at the end @n@.
    walk n = n :| go n
      where
        go m = case IntMap.lookup (opposite m) partners of
          Just next | next /= n -> next : go next
          _ -> []
    opposite m = if even m then m + 1 else m - 1
    chainFrom n = let c = chains IntMap.! (n `div` 2) in if even n then c else backwards c

-- | A chain in the opposite direction.
backwards :: Chain -> Chain
backwards (Chain p q ls) = Chain q p (NonEmpty.reverse (fmap back ls))
  where
    back l = l {part = PathPart.reversed (part l)}

-- | The outline of joined chains, with the gaps between them closed.
withoutGaps :: (Ends, NonEmpty Chain) -> (Outline, [ClosedGap])
withoutGaps (ends, chains) =
  ( Outline ends (sconcat (NonEmpty.zipWith between (NonEmpty.zip starts stops) list)),
    [ ClosedGap {width, before = entity a, after = entity b, joint = p}
      | (a, b, p) <- joints,
        let width = Vec.distance (PathPart.end (part a)) (PathPart.start (part b)),
        width > Tolerance.same
    ]
  )
  where
    list = sconcat (fmap links chains)
    following = NonEmpty.tail list <> [NonEmpty.head list | ends == Closed]
    joints =
      [ (a, b, PathPart.joint (part a) (part b))
        | (a, b) <- zip (NonEmpty.toList list) following
      ]
    places = [p | (_, _, p) <- joints]
    ownStart = PathPart.start (part (NonEmpty.head list))
    ownEnd = PathPart.end (part (NonEmpty.last list))
    begin = if ends == Closed then fromMaybe ownStart (listToMaybe (reverse places)) else ownStart
    starts = begin :| places
    stops = foldr NonEmpty.cons (ownEnd :| []) places
    between (p, q) l = fmap (\moved -> l {part = moved}) (PathPart.withEnds p q (part l))

-- Entities that coincide --------------------------------------------------------------------------

-- | The entities, each with the earlier one that it coincides with, if there is one.
withOriginals :: [Entity] -> [(Entity, Maybe Entity)]
withOriginals = go Map.empty
  where
    go known es = case es of
      [] -> []
      e : more -> case [o | o <- around cell known (markOf e), isSame e o] of
        original : _ -> (e, Just original) : go known more
        [] -> (e, Nothing) : go (Map.insertWith (<>) (cellOf cell (markOf e)) [e] known) more
    cell = Tolerance.same

-- | A point of an entity that does not depend on its direction.
markOf :: Entity -> Point
markOf e = case Drawing.shape e of
  Path _ ps -> meanOf (fmap PathPart.middlePoint ps)
  FullCircle (Circle c _) -> c
  FullEllipse ellipse -> Drawing.middle ellipse
  Dot p -> p
  where
    meanOf ps =
      let n = fromIntegral (NonEmpty.length ps)
       in Vec.point (sum (fmap Vec.x ps) / n) (sum (fmap Vec.y ps) / n)

-- | True for two entities whose shapes coincide, in either direction.
isSame :: Entity -> Entity -> Bool
isSame a b = case (Drawing.shape a, Drawing.shape b) of
  (Path c ps, Path d qs) ->
    c == d && NonEmpty.length ps == NonEmpty.length qs
      && (areAlike ps qs || areAlike ps (NonEmpty.reverse (fmap PathPart.reversed qs)))
  (FullCircle (Circle c r), FullCircle (Circle d s)) -> isNear c d && isEqual r s
  (FullEllipse e, FullEllipse f) ->
    all
      (\t -> isNear (Drawing.ellipsePoint e t) (Drawing.ellipsePoint f t))
      [0, pi / 2, pi]
  (Dot p, Dot q) -> isNear p q
  _ -> False
  where
    areAlike ps qs = and (NonEmpty.zipWith alike ps qs)
    alike p q =
      isNear (PathPart.start p) (PathPart.start q)
        && isNear (PathPart.end p) (PathPart.end q)
        && isNear (PathPart.middlePoint p) (PathPart.middlePoint q)
    isNear p q = Vec.distance p q <= Tolerance.same
    isEqual (Mm r) (Mm s) = let Mm most = Tolerance.same in abs (r - s) <= most

-- Overlaps ----------------------------------------------------------------------------------------

-- | Lines and arcs of which two run along each other over more than the tolerance.
overlaps :: Mm -> [DrawnPart] -> [JoinFault]
overlaps tolerance list =
  [ Overlap (entity a) (entity b) long p
    | (k, a, s) <- plain,
      (j, b, t) <- BoxTree.within (BoundingBox.ofSegment s) index,
      j > k,
      Just (long, p) <- [commonPart s t],
      long > tolerance
  ]
  where
    plain = [(k, l, s) | (k, l@DrawnPart {part = Plain s}) <- zip [0 :: Int ..] list]
    index = BoxTree.index (\(_, _, s) -> BoundingBox.ofSegment s) plain

-- | The length and the middle of the part that two segments have in common; Nothing if this is at
-- most a point.
commonPart :: Segment -> Segment -> Maybe (Mm, Point)
commonPart s t =
  listToMaybe
    [ (times (b - a) (Segment.length s), middle)
      | (a, b) <- zip shares (drop 1 shares),
        b > a,
        let middle = Segment.at ((a + b) / 2) s,
        isOn t middle
    ]
  where
    shares =
      sort
        [ Distance.nearestFraction p s
          | p <- [Segment.start s, Segment.end s, Segment.start t, Segment.end t],
            isOn s p && isOn t p
        ]
    isOn g p = Distance.toPoint p g <= Tolerance.same
