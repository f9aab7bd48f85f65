-- | Chains of lines and arcs in flat arrays: what the offset kernel reads and writes.
--
-- A vertex has its place in mm and the bulge of the segment that begins there, @tan(sweep/4)@: 0
-- for a line, positive for an arc that is walked counter-clockwise, ±1 for half a circle. Arcs of
-- more than half a turn are two segments here, so that each bulge is a small number and each chord
-- has a length.
module Geometry.FlatPolyarc
  ( FlatPolyarc (..),
    outline,
    vertices,
    size,
    reverse,
    area,
    length,
    fromContour,
    fromSegments,
    segments,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Control.Monad.ST (runST)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Polyarc (Ends (..), Polyarc (Polyarc))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Prelude hiding (length, reverse)

-- | The arrays are equally long. A closed outline goes on from its last vertex to its first; an
-- open one ends at its last vertex, whose bulge means nothing.
data FlatPolyarc = FlatPolyarc
  { ends :: Ends,
    xs :: PrimArray Double,
    ys :: PrimArray Double,
    bulges :: PrimArray Double
  }
  deriving stock (Eq, Show)

-- | From vertices in order: x and y in mm, bulge.
outline :: Ends -> [(Double, Double, Double)] -> FlatPolyarc
outline ends vs =
  FlatPolyarc
    { ends,
      xs = PrimArray.primArrayFromList [x | (x, _, _) <- vs],
      ys = PrimArray.primArrayFromList [y | (_, y, _) <- vs],
      bulges = PrimArray.primArrayFromList [b | (_, _, b) <- vs]
    }

-- | x and y in mm, bulge; in order.
vertices :: FlatPolyarc -> [(Double, Double, Double)]
vertices o =
  zip3
    (PrimArray.primArrayToList (xs o))
    (PrimArray.primArrayToList (ys o))
    (PrimArray.primArrayToList (bulges o))

-- | How many segments it has.
size :: FlatPolyarc -> Int
size o = case ends o of
  Closed -> PrimArray.sizeofPrimArray (xs o)
  Open -> max 0 (PrimArray.sizeofPrimArray (xs o) - 1)

-- | The same outline walked the other way; a closed one begins at the same vertex.
reverse :: FlatPolyarc -> FlatPolyarc
reverse o@FlatPolyarc {ends} =
  FlatPolyarc
    { ends,
      xs = turned (xs o),
      ys = turned (ys o),
      bulges = PrimArray.generatePrimArray n bulge
    }
  where
    n = PrimArray.sizeofPrimArray (xs o)
    turned a = PrimArray.generatePrimArray n (PrimArray.indexPrimArray a . place)
    place i = case ends of
      Closed -> if i == 0 then 0 else n - i
      Open -> n - 1 - i
    -- The segment behind a vertex is the one that was before it.
    bulge i = case ends of
      Closed -> -(PrimArray.indexPrimArray (bulges o) (n - 1 - i))
      Open -> if i == n - 1 then 0 else -(PrimArray.indexPrimArray (bulges o) (n - 2 - i))

-- | The area that a closed outline encloses, in mm²; positive when it is walked counter-clockwise.
-- Of a chord @c@ and an arc that sweeps @s@ over it the part between them is @c²·(s − sin
-- s)/(8·sin²(s/2))@.
area :: FlatPolyarc -> Double
area o = folded o $ \x0 y0 x1 y1 b ->
  let ax = x0 - ox
      ay = y0 - oy
   in 0.5 * (ax * (y1 - oy) - (x1 - ox) * ay) + between (square (x1 - x0) + square (y1 - y0)) b
  where
    (ox, oy) =
      if PrimArray.sizeofPrimArray (xs o) == 0
        then (0, 0)
        else (PrimArray.indexPrimArray (xs o) 0, PrimArray.indexPrimArray (ys o) 0)
    square a = a * a
    between cc b
      | b == 0 = 0
      -- The series of the formula below, which loses its digits here.
      | abs b < 1e-3 = cc * b / 3 * (1 + b * b / 5)
      | otherwise = let s = 4 * atan b in cc * (s - sin s) / (8 * square (sin (s / 2)))

-- | The length of the walk.
length :: FlatPolyarc -> Mm
length o = Mm . folded o $ \x0 y0 x1 y1 b ->
  let chord = sqrt ((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0))
   in if b == 0
        then chord
        else
          let s =
                4 * atan (abs b)
           in if s < 1e-6 then chord * (1 + s * s / 24) else chord * s / (2 * sin (s / 2))

-- | The sum of a measure over the segments: of both ends and the bulge.
folded :: FlatPolyarc -> (Double -> Double -> Double -> Double -> Double -> Double) -> Double
folded o f = go 0 0
  where
    n = PrimArray.sizeofPrimArray (xs o)
    count = size o
    go :: Int -> Double -> Double
    go i total
      | i >= count = total
      | otherwise =
        let j = if i + 1 == n then 0 else i + 1
            at a = PrimArray.indexPrimArray a
         in go
              (i + 1)
              (total + f (at (xs o) i) (at (ys o) i) (at (xs o) j) (at (ys o) j) (at (bulges o) i))
{-# INLINE folded #-}

-- | A contour, and for each segment of the outline the number of the contour's segment, from 0.
fromContour :: Polyarc -> (FlatPolyarc, PrimArray Int)
fromContour (Polyarc ends ss) =
  fromSegments ends (Vector.fromListN (NonEmpty.length ss) (NonEmpty.toList ss))

-- | The same of the segments of a contour, of which there is one at least.
fromSegments :: Ends -> Vector Segment -> (FlatPolyarc, PrimArray Int)
fromSegments ends ss = runST $ do
  -- A long arc takes two.
  let room = Vector.foldl' (\k s -> if isLong s then k + 2 else k + 1) 1 ss
  px <- PrimArray.newPrimArray room
  py <- PrimArray.newPrimArray room
  pb <- PrimArray.newPrimArray room
  numbers <- PrimArray.newPrimArray room
  let vertex k p b = do
        PrimArray.writePrimArray px k (Vec.x p)
        PrimArray.writePrimArray py k (Vec.y p)
        PrimArray.writePrimArray pb k b
      put k i s = do
        vertex k (Segment.start s) (bulge s)
        PrimArray.writePrimArray numbers k (i :: Int)
      fill k i
        | i >= Vector.length ss = pure k
        | isLong s,
          (front, back) <- Segment.cutAt 0.5 s =
          put k i front >> put (k + 1) i back >> fill (k + 2) (i + 1)
        | otherwise = put k i s >> fill (k + 1 :: Int) (i + 1)
        where
          s = ss Vector.! i
  count <- fill 0 0
  used <- case ends of
    Closed -> pure count
    Open -> (count + 1) <$ vertex count (Segment.end (Vector.last ss)) 0
  mapM_ (`PrimArray.shrinkMutablePrimArray` used) [px, py, pb]
  PrimArray.shrinkMutablePrimArray numbers count
  o <-
    FlatPolyarc ends
      <$> PrimArray.unsafeFreezePrimArray px
        <*> PrimArray.unsafeFreezePrimArray py
        <*> PrimArray.unsafeFreezePrimArray pb
  (o,) <$> PrimArray.unsafeFreezePrimArray numbers
  where
    bulge s = case s of
      Straight _ _ -> 0
      Arc {sweep = Rad a} -> tan (a / 4)
    isLong s = case s of
      Straight _ _ -> False
      Arc {sweep = Rad a} -> abs a > pi

-- | The segments in order.
segments :: FlatPolyarc -> [Segment]
segments o = map segment [0 .. size o - 1]
  where
    n = PrimArray.sizeofPrimArray (xs o)
    vertex i = Vec.point (PrimArray.indexPrimArray (xs o) i) (PrimArray.indexPrimArray (ys o) i)
    segment i =
      let a = vertex i
          b = vertex (if i + 1 == n then 0 else i + 1)
          g = PrimArray.indexPrimArray (bulges o) i
       in if g == 0
            then Straight a b
            else Arc {start = a, end = b, centre = centreOf a b g, sweep = Rad (4 * atan g)}
    centreOf a b g =
      Vec.shift (Vec.scale ((1 - g * g) / (4 * g)) (Vec.left (Vec.to a b))) (Vec.between 0.5 a b)
