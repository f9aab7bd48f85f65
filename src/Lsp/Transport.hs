-- | Messages of the Language Server Protocol on a stream of bytes. Each message has a header with
-- the length of its body in bytes, an empty line, and the body.
module Lsp.Transport
  ( Received (..),
    next,
    framed,
  )
where

import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Char8 qualified as Char8
import Data.Char (toLower)
import Data.List (isSuffixOf)
import Data.Maybe (listToMaybe)

-- | The first message in the bytes received so far.
data Received
  = -- | an incomplete message, and the least count of bytes that are missing from it
    Incomplete Int
  | -- | the body of a complete message, and the bytes after it
    Complete ByteString ByteString
  | -- | a header without a valid length, whose body cannot be read; the argument is the bytes after
    -- the header
    Headless ByteString
  deriving stock (Eq, Show)

-- | Separates the first message in the bytes received so far from the bytes after it.
next :: ByteString -> Received
next received = case ByteString.breakSubstring "\r\n\r\n" received of
  (header, rest)
    | ByteString.null rest -> Incomplete 1
    | otherwise -> case contentLength header of
      Nothing -> Headless (ByteString.drop 4 rest)
      Just size
        | ByteString.length body < size -> Incomplete (size - ByteString.length body)
        | otherwise -> uncurry Complete (ByteString.splitAt size body)
        where
          body = ByteString.drop 4 rest

-- | The length of the body in bytes, from the key @Content-Length:@. Nothing if the length is
-- missing or not from 0 to 'longest'. The key need not be at the beginning of its line: if the
-- previous message had no valid length, the end of its body comes before the key on the same line.
contentLength :: ByteString -> Maybe Int
contentLength header =
  listToMaybe
    [ n
      | line <- Char8.lines header,
        (key, rest) <- [Char8.breakEnd (== ':') line],
        isKey key,
        Just (n, "") <- [Char8.readInt (Char8.strip rest)],
        n >= 0,
        n <= longest
    ]
  where
    isKey key = "content-length:" `isSuffixOf` filter (/= ' ') (map toLower (Char8.unpack key))

-- | The greatest length of a body in bytes: 256 MiB. A larger number means that the stream is
-- damaged.
longest :: Int
longest = 256 * 1024 * 1024

-- | The bytes of a message: the header with the length, the empty line, and the body.
framed :: ByteString -> ByteString
framed body = "Content-Length: " <> Char8.pack (show (ByteString.length body)) <> "\r\n\r\n" <> body
