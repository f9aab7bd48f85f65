-- | Container: a header in JSON and arrays of numbers, as one answer to the page. The README of
-- this folder describes the bytes.
module Preview.Container
  ( Numbers (..),
    encode,
  )
where

import Data.Aeson (object, (.=))
import Data.Aeson qualified as Aeson
import Data.Aeson.Key qualified as Key
import Data.Aeson.Types (Pair)
import Data.ByteString (ByteString)
import Data.ByteString.Builder qualified as Builder
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Int (Int64)
import Data.Text (Text)

-- | Array of numbers: floating-point numbers of 8 bytes, whole numbers of 4 bytes, or bytes.
data Numbers = Reals [Double] | Wholes [Int] | Octets ByteString

-- | Bytes of a container. The arguments are the members of the header, without @arrays@, and the
-- arrays with their names.
encode :: [Pair] -> [(Text, Numbers)] -> LazyByteString.ByteString
encode members columns =
  Builder.toLazyByteString
    ( Builder.word32LE (fromIntegral (LazyByteString.length header))
        <> Builder.word32LE 0
        <> Builder.lazyByteString header
    )
    <> LazyByteString.concat [padded '\0' bytes | (_, _, bytes) <- encoded]
  where
    encoded = [(name, column, columnBytes column) | (name, column) <- columns]
    header =
      padded
        ' '
        (Aeson.encode (object (members <> ["arrays" .= object (zipWith entry offsets encoded)])))
    offsets = scanl (+) 0 [roundedUp (LazyByteString.length bytes) | (_, _, bytes) <- encoded]
    entry offset (name, column, bytes) =
      Key.fromText name
        .= object
          [ "type" .= typeName column,
            "offset" .= offset,
            "length" .= (LazyByteString.length bytes `div` size column)
          ]

-- | Bytes of a column, the least significant byte of each number first.
columnBytes :: Numbers -> LazyByteString.ByteString
columnBytes column = case column of
  Reals numbers -> Builder.toLazyByteString (foldMap Builder.doubleLE numbers)
  Wholes numbers -> Builder.toLazyByteString (foldMap (Builder.int32LE . fromIntegral) numbers)
  Octets bytes -> LazyByteString.fromStrict bytes

-- | Name of the type of a column's numbers.
typeName :: Numbers -> Text
typeName column = case column of
  Reals _ -> "f64"
  Wholes _ -> "i32"
  Octets _ -> "u8"

-- | Count of the bytes of one number.
size :: Numbers -> Int64
size column = case column of
  Reals _ -> 8
  Wholes _ -> 4
  Octets _ -> 1

-- | Bytes filled up to a multiple of 8 with an ASCII character.
padded :: Char -> LazyByteString.ByteString -> LazyByteString.ByteString
padded with bytes =
  bytes
    <> LazyByteString.replicate
      (roundedUp (LazyByteString.length bytes) - LazyByteString.length bytes)
      (fromIntegral (fromEnum with))

-- | The next multiple of 8.
roundedUp :: Int64 -> Int64
roundedUp n = (n + 7) `div` 8 * 8
