-- | The file of a contour, for every program of the benchmark: little-endian doubles, x y bulge for
-- each vertex.
module ContourFile
  ( write,
    read,
    builder,
  )
where

import Control.Monad (forM_)
import Data.ByteString.Builder (Builder)
import Data.ByteString.Builder qualified as Builder
import Data.Primitive.PrimArray qualified as PrimArray
import Foreign.Marshal.Alloc (allocaBytes)
import Foreign.Storable (peekElemOff)
import Geometry.FlatPolyarc (FlatPolyarc (..))
import Geometry.Polyarc (Ends (..))
import System.IO (IOMode (..), hFileSize, hGetBuf, withBinaryFile)
import Prelude hiding (read)

-- | Writes a contour.
write :: FilePath -> FlatPolyarc -> IO ()
write file o = withBinaryFile file WriteMode (\handle -> Builder.hPutBuilder handle (builder o))

-- | The bytes of the vertices.
builder :: FlatPolyarc -> Builder
builder FlatPolyarc {xs, ys, bulges} = foldMap vertex [0 .. PrimArray.sizeofPrimArray xs - 1]
  where
    vertex i = foldMap (\a -> Builder.doubleLE (PrimArray.indexPrimArray a i)) [xs, ys, bulges]

-- | Reads a closed contour through a small buffer, so that only the contour stays in memory.
read :: FilePath -> IO FlatPolyarc
read file = withBinaryFile file ReadMode $ \handle -> do
  count <- (`div` 24) . fromIntegral <$> hFileSize handle
  arrays <- traverse (const (PrimArray.newPrimArray count)) [(), (), ()]
  allocaBytes (24 * chunk) $ \buffer ->
    forM_ [0, chunk .. count - 1] $ \begin -> do
      got <- hGetBuf handle buffer (24 * chunk)
      forM_ [0 .. got `div` 24 - 1] $ \i ->
        forM_ (zip [0 ..] arrays) $ \(part, array) ->
          peekElemOff buffer (3 * i + part) >>= PrimArray.writePrimArray array (begin + i)
  frozen <- traverse PrimArray.unsafeFreezePrimArray arrays
  case frozen of
    [xs, ys, bulges] -> pure FlatPolyarc {ends = Closed, xs, ys, bulges}
    _ -> ioError (userError "three arrays")
  where
    chunk = 1024
