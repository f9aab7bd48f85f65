-- | Lines of a text with their line ends: LF, CR or CR LF.
module Base.Lines
  ( divided,
    withoutEnd,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text

-- | Divides a text into its lines. Each line has its line end; only the last one has none, and it
-- is empty if the text ends with a line end. Together the lines are the text.
divided :: Text -> [Text]
divided text = case Text.unpack (Text.take 2 rest) of
  [] -> [text]
  '\r' : '\n' : _ -> split 2
  _ -> split 1
  where
    (before, rest) = Text.break isLineEnd text
    split ending =
      let (line, more) = Text.splitAt (Text.length before + ending) text in line : divided more

-- | Line without its line end.
withoutEnd :: Text -> Text
withoutEnd = Text.dropWhileEnd isLineEnd

isLineEnd :: Char -> Bool
isLineEnd c = c == '\n' || c == '\r'
