-- | Lists of numbers in the attributes of SVG elements.
module Drawing.SvgNumber
  ( numbers,
    skipBlanks,
    skipComma,
  )
where

import Data.Char (isSpace)
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.Number qualified as Number

-- | The numbers of a whole text, separated by blanks, by commas or by their signs and points. The
-- rest of the text at the first mistake in 'Left'.
numbers :: Text -> Either Text [Double]
numbers text = go [] (skipBlanks text)
  where
    go found rest
      | Text.null rest = Right (reverse found)
      | otherwise = case Number.leading rest of
        Just (x, more) -> go (x : found) (skipComma more)
        Nothing -> Left rest

-- | The text after the blanks at its beginning.
skipBlanks :: Text -> Text
skipBlanks = Text.dropWhile isSpace

-- | The text after blanks, at most one comma, and blanks again.
skipComma :: Text -> Text
skipComma text = case Text.uncons (skipBlanks text) of
  Just (',', rest) -> skipBlanks rest
  _ -> skipBlanks text
