-- | File addresses (URIs) of the Language Server Protocol. Clients percent-encode different sets of
-- characters. So the server compares decoded addresses, and sends an address back as the client
-- wrote it.
module Lsp.Uri
  ( Uri (..),
    toPath,
    fromPath,
  )
where

import Data.Aeson (FromJSON, ToJSON)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.Char (chr, digitToInt, intToDigit, isAlphaNum, isAscii, isHexDigit, ord)
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Data.Text.Encoding.Error qualified as Encoding
import Data.Word (Word8)

-- | An address as the client wrote it, or as 'fromPath' made it.
newtype Uri = Uri Text
  deriving newtype (Eq, Ord, FromJSON, ToJSON)
  deriving stock (Show)

-- | The path of a @file:@ address. An address with another scheme, such as @untitled:@, is decoded
-- and kept whole.
toPath :: Uri -> Text
toPath (Uri uri) = decoded (Maybe.fromMaybe uri local)
  where
    local = afterHost <$> Text.stripPrefix "file://" uri
    -- There may be a host before the path: file://localhost/part
    afterHost rest = if "/" `Text.isPrefixOf` rest then rest else Text.dropWhile (/= '/') rest

-- | The @file:@ address of an absolute path.
fromPath :: Text -> Uri
fromPath path =
  Uri ("file://" <> Text.concat (map escaped (ByteString.unpack (Encoding.encodeUtf8 path))))

-- | Percent-encodes a byte; ASCII letters, digits and @/-._~@ stay as they are.
escaped :: Word8 -> Text
escaped byte
  | isAscii c && (isAlphaNum c || c `elem` ("/-._~" :: String)) = Text.singleton c
  | otherwise = Text.pack ['%', digit (byte `div` 16), digit (byte `mod` 16)]
  where
    c = chr (fromIntegral byte)
    digit = intToDigit' . fromIntegral
    intToDigit' n = if n < 10 then intToDigit n else chr (ord 'A' + n - 10)

-- | Decodes percent-encoded bytes as UTF-8; wrong UTF-8 becomes replacement characters.
decoded :: Text -> Text
decoded = Encoding.decodeUtf8With Encoding.lenientDecode . bytes . Encoding.encodeUtf8

-- | Decodes percent-encoded bytes; a percent sign without two hexadecimal digits stays.
bytes :: ByteString -> ByteString
bytes encoded = case ByteString.uncons rest of
  Nothing -> plain
  Just (percent, more) ->
    case map (chr . fromIntegral) (ByteString.unpack (ByteString.take 2 more)) of
      [a, b]
        | isHexDigit a && isHexDigit b ->
          plain
            <> ByteString.cons
              (fromIntegral (16 * digitToInt a + digitToInt b))
              (bytes (ByteString.drop 2 more))
      _ -> plain <> ByteString.cons percent (bytes more)
  where
    (plain, rest) = ByteString.break (== 0x25) encoded
