-- | Polyarcs in flat arrays: the input and output of the offset kernel ("Offset.Kernel") and of arc
-- fitting.
--
-- A vertex is the start of a segment, or the end of an open polyarc. It has coordinates in mm and
-- the bulge of the segment that starts there, @tan(sweep/4)@: 0 for a line, positive for a
-- counter-clockwise arc, ±1 for a half circle. An arc that sweeps more than a half circle is stored
-- as two segments. So every bulge is from −1 to 1, and a full circle has no chord of length 0.
--
-- The arrays are unboxed: a vertex takes 24 bytes, while a segment in a list takes 64 to 88. A flat
-- polyarc is made from a "Geometry.Polyarc" or from its vertices.
module Geometry.FlatPolyarc
  ( FlatPolyarc (..),
    fromVertices,
    vertices,
    size,
    reverse,
    area,
    length,
    fromPolyarc,
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

-- | Arrays of the vertices' x and y in mm and of their bulges, all three of the same length. The
-- last segment of a closed polyarc leads from its last vertex to its first. An open one ends at its
-- last vertex, whose bulge has no meaning.
data FlatPolyarc = FlatPolyarc
  { ends :: Ends,
    xs :: PrimArray Double,
    ys :: PrimArray Double,
    bulges :: PrimArray Double
  }
  deriving stock (Eq, Show)

-- | The polyarc of vertices in order. Each is given by x and y in mm and by the bulge.
fromVertices :: Ends -> [(Double, Double, Double)] -> FlatPolyarc
fromVertices ends vs =
  FlatPolyarc
    { ends,
      xs = PrimArray.primArrayFromList [x | (x, _, _) <- vs],
      ys = PrimArray.primArrayFromList [y | (_, y, _) <- vs],
      bulges = PrimArray.primArrayFromList [b | (_, _, b) <- vs]
    }

-- | The vertices in order, each as x and y in mm and the bulge.
vertices :: FlatPolyarc -> [(Double, Double, Double)]
vertices o =
  zip3
    (PrimArray.primArrayToList (xs o))
    (PrimArray.primArrayToList (ys o))
    (PrimArray.primArrayToList (bulges o))

-- | The number of segments of a flat polyarc.
size :: FlatPolyarc -> Int
size o = case ends o of
  Closed -> PrimArray.sizeofPrimArray (xs o)
  Open -> max 0 (PrimArray.sizeofPrimArray (xs o) - 1)

-- | The polyarc in the opposite direction. A closed one keeps its first vertex.
reverse :: FlatPolyarc -> FlatPolyarc
reverse o@FlatPolyarc {ends} =
  FlatPolyarc
    { ends,
      xs = reordered (xs o),
      ys = reordered (ys o),
      bulges = PrimArray.generatePrimArray n bulge
    }
  where
    n = PrimArray.sizeofPrimArray (xs o)
    reordered a = PrimArray.generatePrimArray n (PrimArray.indexPrimArray a . old)
    old i = case ends of
      Closed -> if i == 0 then 0 else n - i
      Open -> n - 1 - i
    -- In the opposite direction, the segment that ended at a vertex starts there.
    bulge i = case ends of
      Closed -> -(PrimArray.indexPrimArray (bulges o) (n - 1 - i))
      Open -> if i == n - 1 then 0 else -(PrimArray.indexPrimArray (bulges o) (n - 2 - i))

-- | The area that a closed polyarc encloses, in mm²; positive when the polyarc runs
-- counter-clockwise. It is the area of the polygon of chords (shoelace formula) plus the areas
-- between arcs and chords. The area between an arc with the sweep @s@ and its chord of length @c@
-- is @c²·(s − sin s)/(8·sin²(s/2))@; it has the sign of @s@.
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
      -- The next line has the first terms of the power series, since the formula after it loses
      -- digits for small bulges.
      | abs b < 1e-3 = cc * b / 3 * (1 + b * b / 5)
      | otherwise = let s = 4 * atan b in cc * (s - sin s) / (8 * square (sin (s / 2)))

-- | The length of a flat polyarc: the sum of its segments' lengths.
length :: FlatPolyarc -> Mm
length o = Mm . folded o $ \x0 y0 x1 y1 b ->
  let chord = sqrt ((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0))
   in if b == 0
        then chord
        else
          let s = 4 * atan (abs b)
           in if s < 1e-6 then chord * (1 + s * s / 24) else chord * s / (2 * sin (s / 2))

-- | The sum of a measure, such as the length, over the segments. The arguments of the measure @f@
-- are x and y of a segment's start, x and y of its end, and its bulge.
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

-- | The flat form of a polyarc, and an array with one number for each segment of the flat form.
-- This number is the index, from 0, of the polyarc's segment from which the flat one is made.
fromPolyarc :: Polyarc -> (FlatPolyarc, PrimArray Int)
fromPolyarc (Polyarc ends ss) =
  fromSegments ends (Vector.fromListN (NonEmpty.length ss) (NonEmpty.toList ss))

-- | The flat form of a polyarc, given as a vector of at least one segment; and an array with one
-- number for each segment of the flat form. This number is the index, in the vector, of the segment
-- from which the flat one is made.
fromSegments :: Ends -> Vector Segment -> (FlatPolyarc, PrimArray Int)
fromSegments ends ss = runST $ do
  let room = Vector.foldl' (\k s -> if isOverHalf s then k + 2 else k + 1) 1 ss
  px <- PrimArray.newPrimArray room
  py <- PrimArray.newPrimArray room
  pb <- PrimArray.newPrimArray room
  numbers <- PrimArray.newPrimArray room
  let vertex k p b = do
        PrimArray.writePrimArray px k (Vec.x p)
        PrimArray.writePrimArray py k (Vec.y p)
        PrimArray.writePrimArray pb k b
      put k i s = do
        vertex k (Segment.start s) (Segment.bulge s)
        PrimArray.writePrimArray numbers k (i :: Int)
      fill k i
        | i >= Vector.length ss = pure k
        | isOverHalf s,
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
  xs <- PrimArray.unsafeFreezePrimArray px
  ys <- PrimArray.unsafeFreezePrimArray py
  bulges <- PrimArray.unsafeFreezePrimArray pb
  (FlatPolyarc {ends, xs, ys, bulges},) <$> PrimArray.unsafeFreezePrimArray numbers

-- | True for an arc that sweeps more than a half circle; it becomes two segments.
isOverHalf :: Segment -> Bool
isOverHalf s = case s of
  Straight _ _ -> False
  Arc {sweep = Rad a} -> abs a > pi

-- | The segments of a flat polyarc in order.
segments :: FlatPolyarc -> [Segment]
segments o = map segment [0 .. size o - 1]
  where
    n = PrimArray.sizeofPrimArray (xs o)
    vertex i = Vec.point (PrimArray.indexPrimArray (xs o) i) (PrimArray.indexPrimArray (ys o) i)
    next i = if i + 1 == n then 0 else i + 1
    segment i =
      Segment.fromBulge (vertex i) (vertex (next i)) (PrimArray.indexPrimArray (bulges o) i)
