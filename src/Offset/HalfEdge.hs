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
    halfEdgesAround,
    twin,
    edgeOf,
    startNode,
    neighbour,
    componentsOf,
    faces,
    faceArea,
  )
where

import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet qualified as IntSet
import Data.List (foldl', maximumBy, sortBy, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Ord (comparing)
import Data.Primitive.PrimArray (primArrayFromList)
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
halfEdgesAround :: Vector (Double, Double) -> Vector ArrangementEdge -> IntMap (Vector Int)
halfEdgesAround coordinates es = fmap (Vector.fromList . ring coordinates es) outgoing
  where
    outgoing = IntMap.fromListWith (<>) (concatMap leavingBoth (Vector.indexed es))
    leavingBoth (i, e) = [(from e, [2 * i]), (to e, [2 * i + 1])]

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
  [_] -> halves
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

-- | The half-edge that is @steps@ places further counter-clockwise around a node than half-edge
-- @h@. @halves@ are the half-edges that leave the node. Nothing if @h@ does not leave it.
neighbour :: Int -> Int -> Vector Int -> Maybe Int
neighbour steps h halves = do
  k <- Vector.elemIndex h halves
  pure (halves Vector.! ((k + steps) `mod` Vector.length halves))

-- | The connected component of every node, named by the least number of the component's nodes.
componentsOf :: Vector ArrangementEdge -> IntMap (Vector Int) -> IntMap Int
componentsOf es ordered =
  foldl'
    (\known k -> if IntMap.member k known then known else reach k known [k])
    IntMap.empty
    (IntMap.keys ordered)
  where
    reach name known todo = case todo of
      [] -> known
      k : rest
        | IntMap.member k known -> reach name known rest
        | otherwise ->
          reach
            name
            (IntMap.insert k name known)
            (maybe [] (map other . Vector.toList) (IntMap.lookup k ordered) <> rest)
    other h = let e = es Vector.! (h `div` 2) in if even h then to e else from e

-- | The faces, each with the half-edges around it that have it on their left. A face with holes
-- comes once for each connected component of its boundary.
faces :: Vector ArrangementEdge -> IntMap (Vector Int) -> [NonEmpty Int]
faces es ordered = from' (IntSet.fromDistinctAscList [0 .. 2 * Vector.length es - 1])
  where
    from' left = case IntSet.minView left of
      Nothing -> []
      Just (h, rest) ->
        let others = takeWhile (/= h) (drop 1 (iterate next h))
         in (h :| others) : from' (foldl' (flip IntSet.delete) rest others)
    next h = fromMaybe h $ do
      halves <- IntMap.lookup (startNode es (twin h)) ordered
      neighbour (-1) (twin h) halves

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
