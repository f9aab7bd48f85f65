-- | Messages on a stream of bytes: a header that counts the bytes, an empty line, the message.
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

-- | What the bytes received so far begin with.
data Received
  = -- | part of a message; at least so many bytes are missing
    Incomplete Int
  | -- | a message, and what follows it
    Complete ByteString ByteString
  | -- | a header that does not say how long its message is, and what follows it
    Headless ByteString
  deriving stock (Eq, Show)

-- | Take the first message off.
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

-- | The number behind @Content-Length:@, if it can be one. Before that may stand a message whose
-- own header did not say how long it was.
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

-- | No client sends longer messages; a larger number is a damaged stream.
longest :: Int
longest = 256 * 1024 * 1024

-- | A message with its header.
framed :: ByteString -> ByteString
framed body = "Content-Length: " <> Char8.pack (show (ByteString.length body)) <> "\r\n\r\n" <> body
