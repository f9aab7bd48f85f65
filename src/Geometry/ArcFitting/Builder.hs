-- | Growing array of the vertices of an open polyarc, to which arc fitting appends. A polyarc is a
-- chain of lines and arcs. The bulge of a segment is the tangent of a quarter of its sweep; it is
-- kept with the vertex at the segment's start.
module Geometry.ArcFitting.Builder
  ( Vertices,
    new,
    push,
    polyarc,
  )
where

import Control.Monad.ST (ST)
import Data.Primitive.PrimArray (MutablePrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.STRef (STRef, newSTRef, readSTRef, writeSTRef)
import Geometry.FlatPolyarc (FlatPolyarc (..))
import Geometry.Polyarc (Ends (..))

-- | Array of vertices, which doubles its capacity when it is full.
newtype Vertices s = Vertices (STRef s (Buffer s))

-- | Count of vertices, and the array with x (mm), y (mm) and bulge of one vertex after the other.
data Buffer s = Buffer Int (MutablePrimArray s Double)

-- | Array without vertices.
new :: ST s (Vertices s)
new = do
  array <- PrimArray.newPrimArray (3 * 16)
  Vertices <$> newSTRef (Buffer 0 array)

-- | Appends a vertex: x and y in mm, and the bulge of the segment that starts there.
push :: Vertices s -> Double -> Double -> Double -> ST s ()
push (Vertices ref) x y bulge = do
  Buffer n array <- readSTRef ref
  capacity <- PrimArray.getSizeofMutablePrimArray array
  array' <-
    if 3 * n < capacity
      then pure array
      else PrimArray.resizeMutablePrimArray array (2 * capacity)
  PrimArray.writePrimArray array' (3 * n) x
  PrimArray.writePrimArray array' (3 * n + 1) y
  PrimArray.writePrimArray array' (3 * n + 2) bulge
  writeSTRef ref (Buffer (n + 1) array')

-- | Open polyarc of all vertices. The caller must not append a vertex afterwards, because the array
-- is frozen without a copy.
polyarc :: Vertices s -> ST s FlatPolyarc
polyarc (Vertices ref) = do
  Buffer n array <- readSTRef ref
  written <- PrimArray.unsafeFreezePrimArray array
  let part k = PrimArray.generatePrimArray n (\i -> PrimArray.indexPrimArray written (3 * i + k))
  pure FlatPolyarc {ends = Open, xs = part 0, ys = part 1, bulges = part 2}
