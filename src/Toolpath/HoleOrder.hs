-- | The order of the holes of a statement that asks for a short way ("docs/language.md",
-- "Drilling"). It owns the search for this order, and knows nothing of heights and solids: the way
-- is measured in the plane, from the position of the tool to the last hole.
--
-- The search begins with the order in which the nearest hole that is left is always the next one.
-- If the order of the program gives a shorter way, it begins with that order. Then it exchanges two
-- links of the way for two others as long as such an exchange shortens it (2-opt).
module Toolpath.HoleOrder
  ( ordered,
    inOrder,
    way,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (value))
import Control.Monad (foldM, foldM_, when)
import Control.Monad.ST (ST, runST)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Primitive.PrimArray (MutablePrimArray, PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Vector qualified as Vector
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Drilling, Hole (holeCentre), VisitOrder (..))
import Part.Part qualified as Part
import Toolpath.Tolerance qualified as Tolerance

-- | The holes of a drilling statement in the order of drilling. @begin@ is the position of the tool
-- before the statement.
ordered :: Point -> Drilling -> NonEmpty Hole
ordered begin d = case Part.visits d of
  AsListed -> Part.holes d
  Shortest ->
    let holes = Vector.fromList (NonEmpty.toList (Part.holes d))
        centres = map (value . holeCentre) (Vector.toList holes)
     in NonEmpty.fromList (map (holes Vector.!) (inOrder begin centres))

-- | The length of the way from a point through others in their order.
way :: Point -> [Point] -> Mm
way begin points = Mm (sum (zipWith apart (begin : points) points))
  where
    apart a b = let Mm d = Vec.distance a b in d

-- | The order of a short way from the point @begin@ through all @points@: their indices from 0.
inOrder :: Point -> [Point] -> [Int]
inOrder begin points = map (subtract 1) (drop 1 (PrimArray.primArrayToList improved))
  where
    improved = runST $ do
      tour <- nearestFirst places
      greedy <- wayAlong places tour
      listed <- PrimArray.thawPrimArray asListed 0 size
      written <- wayAlong places listed
      let chosen = if written < greedy then listed else tour
      untangle places chosen
      PrimArray.unsafeFreezePrimArray chosen
    asListed = PrimArray.generatePrimArray size id
    size = count places
    places = placesOf (begin : points)

-- | Points in flat arrays. The first one is the position of the tool.
data Places = Places {xs :: PrimArray Double, ys :: PrimArray Double}

placesOf :: [Point] -> Places
placesOf points =
  Places
    { xs = PrimArray.primArrayFromList (map Vec.x points),
      ys = PrimArray.primArrayFromList (map Vec.y points)
    }

count :: Places -> Int
count = PrimArray.sizeofPrimArray . xs

-- | The distance in mm of two points, given by their indices.
between :: Places -> Int -> Int -> Double
between places a b = sqrt (dx * dx + dy * dy)
  where
    dx = PrimArray.indexPrimArray (xs places) a - PrimArray.indexPrimArray (xs places) b
    dy = PrimArray.indexPrimArray (ys places) a - PrimArray.indexPrimArray (ys places) b

-- | The indices of the points in the order of a way.
type Tour s = MutablePrimArray s Int

-- | The length in mm of a way.
wayAlong :: Places -> Tour s -> ST s Double
wayAlong places tour = foldM link 0 [1 .. count places - 1]
  where
    link done k = do
      a <- PrimArray.readPrimArray tour (k - 1)
      b <- PrimArray.readPrimArray tour k
      pure $! done + between places a b

-- | The way on which the nearest point that is left is always the next one. Of several points at
-- the same distance it is the first one of the program.
nearestFirst :: Places -> ST s (Tour s)
nearestFirst places = do
  tour <- PrimArray.newPrimArray size
  mapM_ (\k -> PrimArray.writePrimArray tour k k) [0 .. size - 1]
  mapM_ (next tour) [1 .. size - 1]
  pure tour
  where
    size = count places
    next tour k = do
      from <- PrimArray.readPrimArray tour (k - 1)
      first <- PrimArray.readPrimArray tour k
      (_, _, at) <- nearest tour from (k + 1) (between places from first, first, k)
      swap tour k at
    nearest tour from k best@(least, index, _)
      | k == size = pure best
      | otherwise = do
        p <- PrimArray.readPrimArray tour k
        let d = between places from p
        nearest tour from (k + 1) $
          if d < least || d == least && p < index then (d, p, k) else best

swap :: Tour s -> Int -> Int -> ST s ()
swap tour i j = do
  a <- PrimArray.readPrimArray tour i
  b <- PrimArray.readPrimArray tour j
  PrimArray.writePrimArray tour i b
  PrimArray.writePrimArray tour j a

-- | Exchanges links of a way until no exchange of two links shortens it.
--
-- A pass takes the links in their order. For each of them it makes the exchange with a later link
-- that saves most, if it saves more than 'Tolerance.wayShortened'. So every exchange shortens the
-- way by at least this length, and the passes come to an end.
untangle :: Places -> Tour s -> ST s ()
untangle places tour = do
  hasChanged <- foldM (\changed i -> (|| changed) <$> exchange i) False [1 .. size - 2]
  when hasChanged (untangle places tour)
  where
    size = count places
    Mm least = Tolerance.wayShortened
    exchange i = do
      a <- PrimArray.readPrimArray tour (i - 1)
      b <- PrimArray.readPrimArray tour i
      next <- PrimArray.readPrimArray tour (i + 1)
      (saved, j) <- best a b (between places a b) (i + 1) next (least, i)
      when (saved > least) (reverseBetween tour i j)
      pure (saved > least)
    -- The best exchange with a link from @j@ or later; @c@ is the point at @j@.
    best a b ab j c found
      | j == size - 1 = pure (better found (ab - between places a c) j)
      | otherwise = do
        d <- PrimArray.readPrimArray tour (j + 1)
        let gain = ab + between places c d - between places a c - between places b d
        best a b ab (j + 1) d $! better found gain j
    better found@(saved, _) gain j = if gain > saved then (gain, j) else found

-- | Reverses the part of a way between two positions, both included.
reverseBetween :: Tour s -> Int -> Int -> ST s ()
reverseBetween tour i j =
  foldM_ (\_ k -> swap tour (i + k) (j - k)) () [0 .. (j - i + 1) `quot` 2 - 1]
