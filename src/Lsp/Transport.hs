-- | Messages on a stream of bytes. Each has a header with the length of its body in bytes, an empty
-- line, and the body.
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

-- | The beginning of the bytes received so far.
data Received
  = -- | an incomplete message, of which at least this count of bytes is missing
    Incomplete Int
  | -- | the body of a complete message, and the bytes after it
    Complete ByteString ByteString
  | -- | a header without a length, of which no body can be read; the bytes after it
    Headless ByteString
  deriving stock (Eq, Show)

-- | Separates the first message from the bytes after it.
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

-- | The number after @Content-Length:@, if it is from 0 to 'longest'. Before the header there may
-- be the body of a message whose header had no length, so the key need not be at the beginning of a
-- line.
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

-- | The body of a message with its header.
framed :: ByteString -> ByteString
framed body = "Content-Length: " <> Char8.pack (show (ByteString.length body)) <> "\r\n\r\n" <> body
