-- | Surrogates in JSON: a character outside of the basic multilingual plane is written as two
-- escapes, @\\ud83d\\ude42@. One half without the other is no character.
module Lsp.Surrogate
  ( replaced,
  )
where

import Data.ByteString (ByteString)
import Data.ByteString.Char8 qualified as Char8
import Data.Char (digitToInt, isHexDigit)

-- | JSON in which each half of a surrogate pair that stands alone is a replacement character
-- (U+FFFD). All other bytes stay as they are.
replaced :: ByteString -> ByteString
replaced = mconcat . go
  where
    go rest = case Char8.break (== '\\') rest of
      (before, after)
        | Char8.null after -> [before]
        | Just high <- escaped after,
          isHigh high,
          Just low <- escaped (Char8.drop 6 after),
          isLow low ->
          before : Char8.take 12 after : go (Char8.drop 12 after)
        | Just half <- escaped after,
          isHigh half || isLow half ->
          before : "\\ufffd" : go (Char8.drop 6 after)
        | otherwise -> before : Char8.take 2 after : go (Char8.drop 2 after)
    isHigh code = code >= 0xD800 && code < 0xDC00
    isLow code = code >= 0xDC00 && code < 0xE000

-- | The code of an escape @\\uXXXX@ at the beginning of some bytes.
escaped :: ByteString -> Maybe Int
escaped bytes
  | "\\u" `Char8.isPrefixOf` bytes && Char8.length digits == 4 && Char8.all isHexDigit digits =
    Just (Char8.foldl' (\code digit -> 16 * code + digitToInt digit) 0 digits)
  | otherwise = Nothing
  where
    digits = Char8.take 4 (Char8.drop 2 bytes)
