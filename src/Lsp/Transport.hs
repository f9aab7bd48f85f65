-- | Messages on a stream of bytes: a header with the number of bytes, an empty line, the body.
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

-- | The first message of the bytes received so far.
data Received
  = -- | part of a message, and the least number of missing bytes
    Incomplete Int
  | -- | the body of a message, and the bytes after it
    Complete ByteString ByteString
  | -- | the bytes after a header without a length
    Headless ByteString
  deriving stock (Eq, Show)

-- | Separates the first message.
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

-- | The number after @Content-Length:@, if it is a possible length. The header may begin with a
-- message whose own header had no length.
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

-- | The greatest length of a message, in bytes. A larger number means that the stream is damaged.
longest :: Int
longest = 256 * 1024 * 1024

-- | The body of a message with its header.
framed :: ByteString -> ByteString
framed body = "Content-Length: " <> Char8.pack (show (ByteString.length body)) <> "\r\n\r\n" <> body
