{-# OPTIONS_GHC -O2 #-}

-- | Planar arrangement of closed polyarcs: they are cut at all their self-intersections, and every
-- edge gets the winding numbers on its left and on its right.
--
-- This module handles polyarcs whose segments coincide, touch or intersect at vertices. Points that
-- agree within a tolerance become one node. A slice is the part of a segment between two
-- consecutive nodes. Slices between the same two nodes with the same sagitta become one edge with a
-- multiplicity. Every edge has two half-edges, one leaving each of its nodes. The half-edges at
-- each node are sorted by angle, and the winding numbers are propagated from edge to edge (de Berg
-- et al., "Computational Geometry", chapter 8). 'arrange' refuses an arrangement whose winding
-- numbers contradict each other at a node: then the half-edges are in the wrong order.
--
-- Nodes, edges and segments are given by number from 0. The two half-edges of edge @e@ have the
-- numbers @2e@ and @2e + 1@. Coordinates are in mm, tolerances too.
module Offset.Arrangement
  ( Arrangement,
    arrange,
    arrangeWeighted,
    windingNumbers,
    intersectingSegments,
    loops,
    BoundaryEdge (..),
    boundary,
  )
where

import Control.Monad (forM_)
import Control.Monad.ST (ST, runST)
import Data.Bifunctor qualified as Bifunctor
import Data.Int (Int32)
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet (IntSet)
import Data.IntSet qualified as IntSet
import Data.List (find, foldl', sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Primitive.MutVar
import Data.Primitive.PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Sense (..))
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Index.SegmentBoxTree (SegmentBoxTree)
import Geometry.Index.SegmentBoxTree qualified as SegmentBoxTree
import Offset.HalfEdge (ArrangementEdge (..), Rings)
import Offset.HalfEdge qualified as HalfEdge
import Offset.Loop (OffsetLoops (OffsetLoops))
import Offset.SegmentIntersection (Visitor (..))
import Offset.SegmentIntersection qualified as SegmentIntersection
import Offset.WindingNumber qualified as WindingNumber

-- | An arrangement of closed polyarcs. Nodes and edges are numbered from 0.
data Arrangement = Arrangement
  { -- | the polyarcs of which the arrangement was made
    chain :: ClosedPolyarcs,
    -- | x and y of the nodes, in mm
    nodes :: Vector (Double, Double),
    -- | the node of every vertex of the polyarcs
    vertexNodes :: PrimArray Int,
    edges :: Vector ArrangementEdge,
    rings :: Rings,
    -- | the winding number on the left of every edge
    lefts :: PrimArray Int,
    -- | pairs of segments that cross between their ends
    proper :: [(Int, Int)]
  }

-- | Builds the arrangement of the polyarcs @c@. @boxes@ is the tree of their segments' bounding
-- boxes, each enlarged by at least the tolerance (mm). Points whose coordinates differ by at most
-- four tolerances become one node. Nothing when the winding numbers contradict each other.
arrange :: Double -> ClosedPolyarcs -> SegmentBoxTree -> Maybe Arrangement
arrange = arrangeWeighted (const 1)

-- | Does the same for polyarcs with weights, by the number of their segments: a point has the sum
-- of the products of each polyarc's weight and winding number. The weights are positive.
arrangeWeighted ::
  (Int -> Int) -> Double -> ClosedPolyarcs -> SegmentBoxTree -> Maybe Arrangement
arrangeWeighted weight tolerance c boxes
  | all (isOnSegment tolerance c) cuts && isConsistent arrangement = Just arrangement
  | otherwise = Nothing
  where
    (cuts, pairs) = intersections tolerance c boxes
    (coordinates, nodeOf, cutNodes) = nodesOf tolerance c cuts
    cut = slices c coordinates nodeOf cutNodes
    found = Vector.fromList (merged weight tolerance coordinates cut)
    ordered = HalfEdge.ringsOf coordinates found
    arrangement =
      Arrangement
        { chain = c,
          nodes = coordinates,
          vertexNodes = nodeOf,
          edges = found,
          rings = ordered,
          lefts = propagated coordinates found ordered,
          proper = pairs
        }

-- | True if a cut lies on its segment's line or circle. Where two circles nearly coincide, the
-- computed intersection may lie far from both.
isOnSegment :: Double -> ClosedPolyarcs -> (Int, Double, Double) -> Bool
isOnSegment tolerance c (i, x, y)
  | indexPrimArray (ClosedPolyarcs.bulges c) i == 0 =
    ClosedPolyarcs.chord c i $ \dx dy ->
      let ax = x - indexPrimArray (ClosedPolyarcs.xs c) i
          ay = y - indexPrimArray (ClosedPolyarcs.ys c) i
       in abs (dx * ay - dy * ax) <= most * sqrt (dx * dx + dy * dy)
  | otherwise = abs (ClosedPolyarcs.power c i x y) <= most * ClosedPolyarcs.diameter c i
  where
    most = 100 * tolerance

-- | The points at which segments are cut, and the pairs of segments that cross between their ends.
-- Each cut has the number of the segment, and x and y of the point in mm.
intersections ::
  Double ->
  ClosedPolyarcs ->
  SegmentBoxTree ->
  ([(Int, Double, Double)], [(Int, Int)])
intersections tolerance c boxes = runST $ do
  cuts <- newMutVar []
  pairs <- newMutVar []
  let cut s x y = modifyMutVar' cuts ((s, x, y) :)
      at k f = f (indexPrimArray (ClosedPolyarcs.xs c) k) (indexPrimArray (ClosedPolyarcs.ys c) k)
      visitor =
        Visitor
          { crossing = \i _ j _ x y _ -> cut i x y >> cut j x y >> modifyMutVar' pairs ((i, j) :),
            resting = \s k -> at k (cut s),
            touching = \i j x y -> cut i x y >> cut j x y
          }
  SegmentBoxTree.pairs boxes (pure True :: ST s Bool) (SegmentIntersection.meet tolerance c visitor)
  found <- readMutVar cuts
  crossings <- readMutVar pairs
  pure (found, reverse crossings)

-- | The coordinates of the nodes in mm; the node of every vertex; and for each segment the nodes at
-- its cuts, in any order. Each of @cuts@ has the segment's number, and x and y of the point in mm.
nodesOf ::
  Double ->
  ClosedPolyarcs ->
  [(Int, Double, Double)] ->
  (Vector (Double, Double), PrimArray Int, IntMap [Int])
nodesOf tolerance c cuts =
  ( Vector.fromList (map position clusters),
    own,
    IntMap.fromListWith (<>) [(s, [indexPrimArray ids (n + k)]) | (k, (s, _, _)) <- zip [0 ..] cuts]
  )
  where
    n = sizeofPrimArray (ClosedPolyarcs.xs c)
    points =
      [ (indexPrimArray (ClosedPolyarcs.xs c) i, indexPrimArray (ClosedPolyarcs.ys c) i, i)
        | i <- [0 .. n - 1]
      ]
        <> [(x, y, n + k) | (k, (_, x, y)) <- zip [0 ..] cuts]
    clusters = concatMap (clustered snd3 . sortOn snd3) (clustered fst3 (sortOn fst3 points))
    -- Divides points, sorted by the coordinate @f@, into clusters: where @f@ grows by more than
    -- four tolerances from one point to the next, a new cluster begins.
    clustered f ps = case ps of
      [] -> []
      p : rest -> let (same, others) = grab f (f p) rest in (p : same) : clustered f others
    grab f v ps = case ps of
      q : rest
        | f q - v <= 4 * tolerance ->
          let (same, others) = grab f (f q) rest
           in (q : same, others)
      _ -> ([], ps)
    fst3 (x, _, _) = x
    snd3 (_, y, _) = y
    number (_, _, i) = i
    -- A node has the exact coordinates of its first vertex, or else of its first cut.
    position ps = let (x, y, _) = foldr1 (\p q -> if number p < number q then p else q) ps in (x, y)
    ids =
      runPrimArray'
        (n + length cuts)
        (concat [map (\p -> (number p, k)) ps | (k, ps) <- zip [0 ..] clusters])
    own = clonePrimArray ids 0 n

-- | An array of size @n@. Each pair in @filled@ is an index and the value at this index.
runPrimArray' :: Int -> [(Int, Int)] -> PrimArray Int
runPrimArray' n filled = runPrimArray $ do
  a <- newPrimArray n
  mapM_ (uncurry (writePrimArray a)) filled
  pure a

-- | The slices of all segments. Each has the numbers of its first node, its last node and its
-- segment, and its bulge. @nodeOf@ has the node of every vertex, and @cutNodes@ the nodes at the
-- cuts of each segment.
slices ::
  ClosedPolyarcs ->
  Vector (Double, Double) ->
  PrimArray Int ->
  IntMap [Int] ->
  [(Int, Int, Int, Double)]
slices c coordinates nodeOf cutNodes =
  concatMap
    one
    [ i
      | i <- [0 .. sizeofPrimArray (ClosedPolyarcs.xs c) - 1],
        not
          ( ClosedPolyarcs.hasMark
              ClosedPolyarcs.repeatedMark
              (indexPrimArray (ClosedPolyarcs.marks c) i)
          )
    ]
  where
    one i =
      let a = indexPrimArray nodeOf i
          b = indexPrimArray nodeOf (i + 1)
          inner =
            maybe
              []
              ( map snd
                  . sortOn fst
                  . map (\k -> (alongChord c coordinates i k, k))
                  . IntSet.toList
                  . IntSet.delete a
                  . IntSet.delete b
                  . IntSet.fromList
              )
              (IntMap.lookup i cutNodes)
          stops = a : inner <> [b]
       in [ ( p,
              q,
              i,
              if null inner then indexPrimArray (ClosedPolyarcs.bulges c) i else bulgeOf i p q
            )
            | (p, q) <- zip stops (drop 1 stops),
              p /= q
          ]
    bulgeOf i p q =
      let ((x, y), (x', y')) = (coordinates Vector.! p, coordinates Vector.! q)
       in ClosedPolyarcs.partialBulge c i x y x' y'

-- | The position of a node along the chord of segment @i@, in mm from the chord's start, multiplied
-- by the chord's length in mm. Nodes on one segment are sorted by it.
alongChord :: ClosedPolyarcs -> Vector (Double, Double) -> Int -> Int -> Double
alongChord c coordinates i node =
  ClosedPolyarcs.chord c i $ \dx dy ->
    let (x, y) = coordinates Vector.! node
     in (x - indexPrimArray (ClosedPolyarcs.xs c) i) * dx
          + (y - indexPrimArray (ClosedPolyarcs.ys c) i) * dy

-- | Merges slices (first node, last node, segment, bulge) between the same nodes with the same
-- sagitta into one edge, whose multiplicity is the sum of the segments' weights. Slices cancel and
-- give no edge if those in both directions have equal weights.
merged ::
  (Int -> Int) ->
  Double ->
  Vector (Double, Double) ->
  [(Int, Int, Int, Double)] ->
  [ArrangementEdge]
merged weight tolerance coordinates cut =
  concatMap
    (edgesOf . Bifunctor.first (`divMod` nodeCount))
    ( IntMap.toList
        ( IntMap.fromListWith
            (<>)
            [ (min a b * nodeCount + max a b, [(a < b, i, if a < b then g else -g)])
              | (a, b, i, g) <- cut
            ]
        )
    )
  where
    nodeCount = Vector.length coordinates
    edgesOf ((a, b), list) = case list of
      [one@(_, i, _)] -> [edge a b (weight i) one]
      _ -> concatMap (bundle a b) (bySagitta (sortOn rise list))
      where
        rise (_, _, g) = g * chordOf a b / 2
        bySagitta ps = case ps of
          [] -> []
          p : rest ->
            let (same, others) = span (\q -> rise q - rise p <= 4 * tolerance) rest
             in (p : same) : bySagitta others
    chordOf a b =
      let ((x, y), (x', y')) = (coordinates Vector.! a, coordinates Vector.! b)
       in sqrt ((x' - x) * (x' - x) + (y' - y) * (y' - y))
    edge a b m (forth, i, g)
      | forth = ArrangementEdge a b m g i
      | otherwise = ArrangementEdge b a m (-g) i
    bundle a b list = case compare net 0 of
      EQ -> []
      -- The bulge and the number are those of the first coinciding segment in the edge's direction.
      GT -> [edge a b net one | one : _ <- [sortOn second [s | s@(True, _, _) <- list]]]
      LT -> [edge a b (-net) one | one : _ <- [sortOn second [s | s@(False, _, _) <- list]]]
      where
        second (_, i, _) = i
        net = sum [if forth then weight i else -(weight i) | (forth, i, _) <- list]

-- | The winding number on the left of every edge. It is propagated over each connected component
-- from the component's outer face.
propagated :: Vector (Double, Double) -> Vector ArrangementEdge -> Rings -> PrimArray Int
propagated coordinates es ordered = runPrimArray $ do
  known <- newPrimArray (Vector.length es)
  setPrimArray known 0 (Vector.length es) unknown
  forM_ (IntMap.elems outerFaces) $ \(_, h) ->
    spread es ordered known [(HalfEdge.twin h, outside (HalfEdge.startNode es h))]
  pure known
  where
    components = HalfEdge.componentsOf es ordered
    outside = outsideNumber coordinates es components
    -- The signed area of each component's outer face, the only negative one, and a half-edge that
    -- has this face on its left.
    outerFaces =
      IntMap.fromListWith
        min
        [ ( indexPrimArray components (HalfEdge.startNode es h),
            (HalfEdge.faceArea coordinates es face, h)
          )
          | face@(h :| _) <- HalfEdge.faces es ordered
        ]

-- | The winding number of an edge to which none has been propagated yet.
unknown :: Int
unknown = minBound

-- | The winding number at a node, counting all components except the node's own. @components@ has
-- the component of every node, and the last argument is the node's number. The first three
-- arguments are applied once, so that all nodes share one bounding-box tree of the edges.
outsideNumber :: Vector (Double, Double) -> Vector ArrangementEdge -> PrimArray Int -> Int -> Int
outsideNumber coordinates es components =
  \k ->
    let (x, y) = coordinates Vector.! k
        own = indexPrimArray components k
        add total i
          | indexPrimArray components (from edge) == own = total
          | otherwise = total + times edge * WindingNumber.contribution edgePolyarcs x y i
          where
            edge = es Vector.! (i `div` 2)
     in SegmentBoxTree.around tree (-1e300) y x y (0 :: Int) add
  where
    edgePolyarcs =
      ClosedPolyarcs.fromSeparateSegments
        [ (x, y, x', y', bulge e)
          | e <- Vector.toList es,
            let ((x, y), (x', y')) = (coordinates Vector.! from e, coordinates Vector.! to e)
        ]
    tree = SegmentBoxTree.build 0 edgePolyarcs

-- | Writes into @known@ the winding number on the left of every edge that is connected with the
-- half-edges in @todo@. Each pair in @todo@ is a half-edge and the winding number on its right,
-- seen in the direction in which it leaves its node. Edges whose number is known are not visited
-- again.
spread :: Vector ArrangementEdge -> Rings -> MutablePrimArray s Int -> [(Int, Int)] -> ST s ()
spread es ordered known todo = case todo of
  [] -> pure ()
  (h, right) : rest -> do
    let e = h `div` 2
        edge = es Vector.! e
        left = if even h then right + times edge else right
    before <- readPrimArray known e
    if before /= unknown
      then spread es ordered known rest
      else do
        writePrimArray known e left
        spread
          es
          ordered
          known
          (othersAround (2 * e) left (othersAround (2 * e + 1) (left - times edge) rest))
  where
    -- Adds to a list the other half-edges of the node of half-edge @h@, counter-clockwise from @h@
    -- on, each with the winding number on its right. @leftward@ is the winding number on the left
    -- of @h@. The winding number on the left of each is the one on the right of the next.
    othersAround h = from' (HalfEdge.neighbour es ordered 1 h)
      where
        from' h' right more
          | h' == h = more
          | otherwise =
            (h', right) : from' (HalfEdge.neighbour es ordered 1 h') (right + gain h') more
    gain h = let m = times (es Vector.! (h `div` 2)) in if even h then m else -m

-- | True when the winding numbers agree around every node: the number on the left of each half-edge
-- is that on the right of the next one counter-clockwise.
isConsistent :: Arrangement -> Bool
isConsistent a = all fits [0 .. 2 * Vector.length (edges a) - 1]
  where
    fits h = fst (sides a h) == snd (sides a (HalfEdge.neighbour (edges a) (rings a) 1 h))

-- | The winding numbers on the left and on the right of half-edge @h@ as it leaves its node.
sides :: Arrangement -> Int -> (Int, Int)
sides a h = if even h then (left, left - m) else (left - m, left)
  where
    left = indexPrimArray (lefts a) (h `div` 2)
    m = times (edges a Vector.! (h `div` 2))

-- | The least and the largest winding number of all faces, among them the unbounded one with 0.
windingNumbers :: Arrangement -> (Int, Int)
windingNumbers a =
  foldl'
    (\(low, high) v -> (min low v, max high v))
    (0, 0)
    (concat [[l, r] | e <- [0 .. Vector.length (edges a) - 1], let (l, r) = sides a (2 * e)])

-- | The numbers of two segments that intersect, the smaller one first; Nothing when none is found.
-- The caller reports them as the reason why a winding number is below @low@ or above @high@. Pairs
-- that cross between their ends have priority. Otherwise one segment has such a winding number on
-- one side; the other one meets it at a node, and is not its neighbour.
intersectingSegments :: (Int, Int) -> Arrangement -> Maybe (Int, Int)
intersectingSegments (low, high) a =
  listToMaybe
    ( proper a
        <> [ (min i j, max i j)
             | (k, e) <- Vector.toList (Vector.indexed (edges a)),
               let (l, r) = sides a (2 * k),
               max l r > high || min l r < low,
               let i = segment e,
               node <- [from e, to e],
               h <- HalfEdge.ringAt (rings a) node,
               let j = segment (edges a Vector.! (h `div` 2)),
               abs (i - j) > 1
           ]
    )

-- | The loops around the faces that the cutter's centre can reach. @sense@ is the sense of a face's
-- outer loop. If it is counter-clockwise, the faces are on the left of the loops and have the
-- winding number @wanted@. If it is clockwise, they are on the right and have @wanted − 1@. The
-- result is Nothing when a loop does not close.
loops :: Sense -> Int -> Arrangement -> Maybe OffsetLoops
loops sense wanted a =
  toLoops . map vertices
    <$> closedChains next (IntSet.fromList (filter isKept [0 .. Vector.length (edges a) - 1]))
  where
    isKept e =
      let (l, r) = sides a (2 * e)
       in case sense of
            CounterClockwise -> l == wanted
            Clockwise -> r == wanted - 1
    -- The edge after edge @e@ around the reachable face: at the node where @e@ ends, the next
    -- half-edge on the face's side. Nothing when no edge that is kept begins with this half-edge.
    next e
      | even h && isKept (h `div` 2) = Just (h `div` 2)
      | otherwise = Nothing
      where
        turn = if sense == CounterClockwise then -1 else 1
        h = HalfEdge.neighbour (edges a) (rings a) turn (2 * e + 1)
    -- Consecutive edges on the same segment become one segment again.
    vertices loop = map (loopVertex a) (NonEmpty.groupBy onSameSegment (rotated loop))
    onSameSegment e e' = segment (edges a Vector.! e) == segment (edges a Vector.! e')
    rotated loop = case span (onSameSegment (last loop)) loop of
      (front, rest) | not (null rest) -> rest <> front
      _ -> loop

-- | An edge on the boundary of a region that lies on the edge's left.
data BoundaryEdge = BoundaryEdge
  { -- | x and y of the beginning, in mm
    begin :: (Double, Double),
    -- | @tan(sweep/4)@, 0 for a line
    edgeBulge :: Double,
    -- | the number of a segment along which the edge runs
    alongSegment :: Int,
    -- | false if the edge runs against the direction of this segment
    isForward :: Bool
  }

-- | The closed loops around the region of all faces whose winding numbers satisfy @isInside@. The
-- region lies on the left of each loop. No loop visits a node twice. Nothing when a loop does not
-- close.
boundary :: (Int -> Bool) -> Arrangement -> Maybe [NonEmpty BoundaryEdge]
boundary isInside a =
  map (fmap (boundaryEdge a)) . concatMap (simpleLoops a)
    <$> closedChains next (IntSet.fromList kept)
  where
    kept = filter isKept [0 .. 2 * Vector.length (edges a) - 1]
    isKept h = let (l, r) = sides a h in isInside l && not (isInside r)
    -- The half-edge after @h@ around the same face of the region: the first one that is kept,
    -- clockwise from the reversed @h@.
    next h = find isKept (takeWhile (/= back) (drop 1 (iterate clockwise back)))
      where
        back = HalfEdge.twin h
    clockwise = HalfEdge.neighbour (edges a) (rings a) (-1)

-- | Divides a set of numbers into closed chains. @next@ gives the number after another one. Nothing
-- when a chain does not close.
closedChains :: (Int -> Maybe Int) -> IntSet -> Maybe [[Int]]
closedChains next left = case IntSet.minView left of
  Nothing -> Just []
  Just (e, rest) -> do
    (chain', rest') <- follow e e rest
    (chain' :) <$> closedChains next rest'
  where
    -- The chain from @e@ on, and the numbers left over. Nothing when it does not reach @first@.
    follow first e rest = case next e of
      Just e'
        | e' == first -> Just ([e], rest)
        | IntSet.member e' rest -> do
          (more, rest') <- follow first e' (IntSet.delete e' rest)
          Just (e : more, rest')
      _ -> Nothing

-- | Divides a loop of half-edges where it visits a node again.
simpleLoops :: Arrangement -> [Int] -> [NonEmpty Int]
simpleLoops a = go IntSet.empty []
  where
    -- @seen@ has the nodes at which the half-edges of @open@ begin, of which the last one is first.
    go seen open halves = case halves of
      [] -> maybe [] (pure . NonEmpty.reverse) (NonEmpty.nonEmpty open)
      h : more
        | IntSet.member node seen,
          (front, e : rest) <- span ((/= node) . nodeOf) open,
          loop <- NonEmpty.reverse (foldr NonEmpty.cons (e :| []) front) ->
          loop : go (IntSet.insert node (foldr (IntSet.delete . nodeOf) seen loop)) (h : rest) more
        | otherwise -> go (IntSet.insert node seen) (h : open) more
        where
          node = nodeOf h
    nodeOf = HalfEdge.startNode (edges a)

-- | A half-edge as an edge of a boundary.
boundaryEdge :: Arrangement -> Int -> BoundaryEdge
boundaryEdge a h =
  BoundaryEdge
    { begin = nodes a Vector.! HalfEdge.startNode (edges a) h,
      edgeBulge = if even h then bulge e else -(bulge e),
      alongSegment = segment e,
      isForward = even h
    }
  where
    e = edges a Vector.! (h `div` 2)

-- | Loops as flat arrays. Each vertex has x, y, the bulge of the segment that starts there, and the
-- number of the raw segment from which that segment was cut.
toLoops :: [[(Double, Double, Double, Int)]] -> OffsetLoops
toLoops made =
  OffsetLoops
    (primArrayFromList (scanl (+) 0 (map length made)))
    (listed (\(x, _, _, _) -> x))
    (listed (\(_, y, _, _) -> y))
    (listed (\(_, _, b, _) -> b))
    (primArrayFromList [fromIntegral i :: Int32 | (_, _, _, i) <- concat made])
  where
    listed f = primArrayFromList (map f (concat made))

-- | One vertex of a loop for consecutive edges of one segment: x, y, bulge, the segment's number.
loopVertex :: Arrangement -> NonEmpty.NonEmpty Int -> (Double, Double, Double, Int)
loopVertex a run = (x, y, joined, i)
  where
    e = edges a Vector.! NonEmpty.head run
    e' = edges a Vector.! NonEmpty.last run
    (x, y) = nodes a Vector.! from e
    (x', y') = nodes a Vector.! to e'
    i = segment e
    -- True when the edges are the whole segment, which then keeps its bulge.
    isEntire =
      indexPrimArray (vertexNodes a) i == from e
        && indexPrimArray (vertexNodes a) (i + 1) == to e'
    joined
      | NonEmpty.length run == 1 = bulge e
      | isEntire = indexPrimArray (ClosedPolyarcs.bulges (chain a)) i
      | otherwise = ClosedPolyarcs.partialBulge (chain a) i x y x' y'
