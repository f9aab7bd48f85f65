-- | The order in which a drilling statement has its holes drilled (docs/language.md, "Drilling").
-- "Toolpath.HoleOrder" computes the same order by itself; nothing is imported from there, so that
-- the proof notices a toolpath in another order.
module Verify.RequiredOrder
  ( holesInOrder,
  )
where

import Base.Region (Located (value))
import Data.List (foldl')
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector qualified as Boxed
import Data.Vector.Unboxed (Vector, (!))
import Data.Vector.Unboxed qualified as Vector
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Drilling, Hole)
import Part.Part qualified as Part

-- | Holes of a drilling statement in the order of drilling. @begin@ is the position of the drill
-- before the statement.
holesInOrder :: Point -> Drilling -> [Hole]
holesInOrder begin drilling = case Part.visits drilling of
  Part.AsListed -> holes
  Part.Shortest -> [numbered Boxed.! (k - 1) | k <- Vector.toList (Vector.drop 1 (shortWay stops))]
  where
    holes = NonEmpty.toList (Part.holes drilling)
    numbered = Boxed.fromList holes
    stops = Vector.fromList [(Vec.x p, Vec.y p) | p <- begin : map centre holes]
    centre = value . Part.holeCentre

-- | Positions in the plane, in mm: that of the drill, and then those of the holes in the order of
-- the program.
type Stops = Vector (Double, Double)

-- | A way that begins with the nearest hole again and again, or with the order of the program if
-- that is shorter, and then exchanges two links as long as this shortens it.
shortWay :: Stops -> Vector Int
shortWay stops = settled (if lengthOf listed < lengthOf greedy then listed else greedy)
  where
    lengthOf = wayLength stops
    listed = Vector.enumFromN 0 (Vector.length stops)
    greedy = nearestFirst stops
    settled way =
      let next = foldl' (exchanged stops) way [1 .. Vector.length way - 2]
       in if next == way then way else settled next

-- | Distance in mm of two stops.
gap :: Stops -> Int -> Int -> Double
gap stops a b = sqrt (dx * dx + dy * dy)
  where
    (ax, ay) = stops ! a
    (bx, by) = stops ! b
    dx = ax - bx
    dy = ay - by

-- | Length of a way in mm.
wayLength :: Stops -> Vector Int -> Double
wayLength stops way = Vector.sum (Vector.zipWith (gap stops) way (Vector.drop 1 way))

-- | A way on which the nearest hole that is left is the next one; of several at the same distance,
-- the first one of the program.
nearestFirst :: Stops -> Vector Int
nearestFirst stops = Vector.fromList (0 : from 0 [1 .. Vector.length stops - 1])
  where
    from here left = case left of
      [] -> []
      first : others ->
        let (_, next) = foldl' (nearer here) (gap stops here first, first) others
         in next : from next (filter (/= next) left)
    nearer here best@(least, _) k =
      let d = gap stops here k
       in if d < least then (d, k) else best

-- | A way after the exchange of the link to its stop number @i@ with the later link that saves
-- most. Without an exchange that saves more than 'smallestSaving', it stays as it is.
exchanged :: Stops -> Vector Int -> Int -> Vector Int
exchanged stops way i = case foldl' better (smallestSaving, i) [i + 1 .. size - 1] of
  (_, j) | j == i -> way
  (_, j) ->
    Vector.concat
      [ Vector.take i way,
        Vector.reverse (Vector.slice i (j - i + 1) way),
        Vector.drop (j + 1) way
      ]
  where
    size = Vector.length way
    (a, b) = (way ! (i - 1), way ! i)
    better best@(most, _) j = let s = saving j in if s > most then (s, j) else best
    saving j
      | j == size - 1 = gap stops a b - gap stops a (way ! j)
      | otherwise =
        let (c, d) = (way ! j, way ! (j + 1))
         in gap stops a b + gap stops c d - gap stops a c - gap stops b d

-- | Length in mm by which an exchange of two links has to shorten the way.
smallestSaving :: Double
smallestSaving = 1e-6
