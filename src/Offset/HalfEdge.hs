{-# OPTIONS_GHC -O2 #-}

-- | The edges of an arrangement and how they lie around its nodes and its faces.
--
-- Every edge has two half-edges, one leaving each of its nodes. The half-edges at a node are sorted
-- by angle, counter-clockwise. A face is a connected area between the edges.
--
-- Nodes and edges are given by number from 0. The two half-edges of edge @e@ have the numbers @2e@
-- and @2e + 1@: the first leaves the node at which the edge begins. Coordinates are in mm.
module Offset.HalfEdge
  ( ArrangementEdge (..),
    Rings,
    ringsOf,
    ringAt,
    twin,
    startNode,
    neighbour,
    componentsOf,
    faces,
    faceArea,
  )
where

import Control.Monad (foldM, forM_)
import Control.Monad.ST (runST)
import Data.Int (Int8)
import Data.List (maximumBy, sortBy, sortOn)
import Data.List qualified as List
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Data.Primitive.PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.FlatPolyarc (FlatPolyarc (FlatPolyarc))
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (Closed))

-- | A directed edge between two nodes.
data ArrangementEdge = ArrangementEdge
  { -- | the node at which the edge begins
    from :: Int,
    -- | the node at which the edge ends
    to :: Int,
    -- | the multiplicity: the number of segments that run along the edge in its direction, less the
    -- number of those that run in the opposite direction
    times :: Int,
    -- | @tan(sweep/4)@, 0 for a line
    bulge :: Double,
    -- | the least number of the segments of the polyarcs that run along the edge in its direction
    segment :: Int
  }

-- | The half-edges that leave each node, counter-clockwise.
data Rings = Rings
  { -- | the index in 'items' of each node's first half-edge, and the count of all half-edges
    starts :: PrimArray Int,
    -- | the half-edges of the first node, then those of the second, and so on
    items :: PrimArray Int,
    -- | the index in 'items' of each half-edge
    indices :: PrimArray Int
  }

-- | The half-edges around the nodes, which are given by their coordinates.
ringsOf :: Vector (Double, Double) -> Vector ArrangementEdge -> Rings
ringsOf coordinates es = Rings {starts, items, indices}
  where
    nodeCount = Vector.length coordinates
    halves = 2 * Vector.length es
    starts = runPrimArray $ do
      a <- newPrimArray (nodeCount + 1)
      setPrimArray a 0 (nodeCount + 1) 0
      forM_ [0 .. halves - 1] $ \h -> increment a (startNode es h + 1)
      forM_ [1 .. nodeCount] $ \k -> do
        before <- readPrimArray a (k - 1)
        own <- readPrimArray a k
        writePrimArray a k (before + own)
      pure a
    unsorted = runPrimArray $ do
      a <- newPrimArray halves
      next <- thawPrimArray starts 0 nodeCount
      forM_ [0 .. halves - 1] $ \h -> do
        let k = startNode es h
        readPrimArray next k >>= \i -> writePrimArray a i h
        increment next k
      pure a
    items =
      primArrayFromListN
        halves
        (concatMap (ring coordinates es . range starts unsorted) [0 .. nodeCount - 1])
    indices = runPrimArray $ do
      a <- newPrimArray halves
      forM_ [0 .. halves - 1] $ \i -> writePrimArray a (indexPrimArray items i) i
      pure a
    increment a k = readPrimArray a k >>= writePrimArray a k . (+ 1)

-- | The half-edges that leave a node, counter-clockwise.
ringAt :: Rings -> Int -> [Int]
ringAt rings = range (starts rings) (items rings)

-- | The items of a node, given the indices of all nodes' first items, and the items.
range :: PrimArray Int -> PrimArray Int -> Int -> [Int]
range firsts array k =
  map (indexPrimArray array) [indexPrimArray firsts k .. indexPrimArray firsts (k + 1) - 1]

-- | A half-edge at the node that it leaves.
data Leaving = Leaving
  { halfEdge :: Int,
    -- | the direction in which the half-edge leaves the node, as an angle in radians
    angle :: Double,
    -- | the direction in which the half-edge leaves the node, as a vector of length 1
    directionX, directionY :: Double,
    -- | the length of the half-edge's chord in mm
    chordLength :: Double,
    -- | the half-edge's curvature in 1/mm, positive to the left
    curvature :: Double
  }

-- | The half-edges of a node, given and returned by number, sorted counter-clockwise. The order
-- begins after the widest angle between two neighbours, so that it does not separate directions
-- that are nearly equal.
ring :: Vector (Double, Double) -> Vector ArrangementEdge -> [Int] -> [Int]
ring coordinates es halves = case halves of
  -- One order exists of up to two half-edges.
  [] -> halves
  [_] -> halves
  [_, _] -> halves
  _ -> map halfEdge (sortBy counterClockwise [h {angle = angleFrom cut (angle h)} | h <- aimed])
  where
    aimed = sortOn angle (map (leaving coordinates es) halves)
    angles = map angle aimed
    gaps =
      zipWith
        (\a b -> (b - a, (a + b) / 2))
        angles
        (drop 1 angles <> map (+ 2 * pi) (take 1 angles))
    -- The direction in the middle of the widest gap, an angle between two neighbours.
    cut = snd (maximumBy (comparing fst) gaps)
    angleFrom :: Double -> Double -> Double
    angleFrom from' a =
      let t = a - from' in t - 2 * pi * fromIntegral (floor (t / (2 * pi)) :: Int)

-- | Half-edge number @h@ with its direction, length and curvature.
leaving :: Vector (Double, Double) -> Vector ArrangementEdge -> Int -> Leaving
leaving coordinates es h =
  Leaving
    { halfEdge = h,
      angle = atan2 directionY directionX,
      directionX,
      directionY,
      chordLength = l,
      curvature = 4 * g * q / l
    }
  where
    e = es Vector.! (h `div` 2)
    (a, b, g) = if even h then (from e, to e, bulge e) else (to e, from e, -(bulge e))
    (x, y) = coordinates Vector.! a
    (x', y') = coordinates Vector.! b
    l = sqrt ((x' - x) * (x' - x) + (y' - y) * (y' - y))
    ux = (x' - x) / l
    uy = (y' - y) / l
    q = 1 / (1 + g * g)
    co = (1 - g * g) * q
    si = 2 * g * q
    directionX = ux * co + uy * si
    directionY = uy * co - ux * si

-- | The order of half-edges by their angles, counter-clockwise. Rounding can exchange two
-- directions that are nearly equal. Such half-edges are compared a short distance from the node:
-- the one further to the left comes later.
counterClockwise :: Leaving -> Leaving -> Ordering
counterClockwise first second
  | abs (angle first - angle second) > tie = compare (angle first) (angle second)
  | otherwise = compare 0 (lean + (curvature second - curvature first) * step / 2)
  where
    step = 0.25 * min (chordLength first) (chordLength second)
    lean = asin (max (-1) (min 1 cross))
    cross = directionX first * directionY second - directionY first * directionX second

-- | The difference of two directions (radians) below which rounding may exchange them.
tie :: Double
tie = 1e-3

-- | The half-edge along the same edge in the opposite direction.
twin :: Int -> Int
twin h = if even h then h + 1 else h - 1

-- | The edge of a half-edge.
edgeOf :: Vector ArrangementEdge -> Int -> ArrangementEdge
edgeOf es h = es Vector.! (h `div` 2)

-- | The node that a half-edge leaves.
startNode :: Vector ArrangementEdge -> Int -> Int
startNode es h = (if even h then from else to) (edgeOf es h)

-- | The half-edge that is @steps@ places further counter-clockwise around the node that half-edge
-- @h@ leaves.
neighbour :: Vector ArrangementEdge -> Rings -> Int -> Int -> Int
neighbour es rings steps h =
  indexPrimArray (items rings) (first + (indexPrimArray (indices rings) h - first + steps) `mod` n)
  where
    k = startNode es h
    first = indexPrimArray (starts rings) k
    n = indexPrimArray (starts rings) (k + 1) - first

-- | The connected component of every node, named by the least number of the component's nodes.
componentsOf :: Vector ArrangementEdge -> Rings -> PrimArray Int
componentsOf es rings = runPrimArray $ do
  names <- newPrimArray count
  setPrimArray names 0 count unnamed
  let reach name todo = case todo of
        [] -> pure ()
        k : rest -> do
          known <- readPrimArray names k
          if known /= unnamed
            then reach name rest
            else do
              writePrimArray names k name
              reach name (map (startNode es . twin) (ringAt rings k) <> rest)
  forM_ [0 .. count - 1] $ \k -> reach k [k]
  pure names
  where
    count = sizeofPrimArray (starts rings) - 1
    unnamed = -1

-- | The faces, each with the half-edges around it that have it on their left. A face with holes
-- comes once for each connected component of its boundary.
faces :: Vector ArrangementEdge -> Rings -> [NonEmpty Int]
faces es rings = runST $ do
  visited <- newPrimArray count
  setPrimArray visited 0 count (0 :: Int8)
  let around h others first
        | next == first = pure (h : others)
        | otherwise = around next (h : others) first
        where
          next = neighbour es rings (-1) (twin h)
      step found h = do
        v <- readPrimArray visited h
        if v /= 0
          then pure found
          else do
            face <- NonEmpty.fromList . List.reverse <$> around h [] h
            forM_ face $ \g -> writePrimArray visited g 1
            pure (face : found)
  foldM step [] [0 .. count - 1]
  where
    count = sizeofPrimArray (items rings)

-- | The signed area in mm² of a face, negative if the half-edges round it run clockwise.
faceArea :: Vector (Double, Double) -> Vector ArrangementEdge -> NonEmpty Int -> Double
faceArea coordinates es face =
  FlatPolyarc.area
    FlatPolyarc
      { FlatPolyarc.ends = Closed,
        FlatPolyarc.xs = listed (fst . begin),
        FlatPolyarc.ys = listed (snd . begin),
        FlatPolyarc.bulges = listed (\h -> (if even h then id else negate) (bulge (edgeOf es h)))
      }
  where
    begin h = coordinates Vector.! startNode es h
    listed f = primArrayFromList (map f (NonEmpty.toList face))
