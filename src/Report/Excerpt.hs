-- | A line of the program with marks under a part of it, aligned by the width that
-- characters have on a terminal.
module Report.Excerpt
  ( Excerpt (..),
    excerpt,
  )
where

import Base.Region (Position (..), Region (..), Source)
import Base.Region qualified as Region
import Data.Char (isControl, ord)
import Data.Text (Text)
import Data.Text qualified as Text
import Text.DocLayout (realLength)

-- | A line to print, and where under it the marks go, in columns of the terminal from 0.
data Excerpt = Excerpt {lineNumber :: Int, shown :: Text, indent :: Int, width :: Int}
  deriving stock (Eq, Show)

-- | The line on which a region begins. A region of several lines is marked to the end of its first.
excerpt :: Source -> Region -> Excerpt
excerpt source region = Excerpt {lineNumber = line, shown = Text.concat cells, indent, width}
  where
    Position {line, column} = Region.position source (start region)
    content = Region.lineText source line
    cells = expand 0 (Text.unpack content)
    length' = max 0 (min (end region - start region) (Text.length content - column + 1))
    (before, rest) = splitAt (column - 1) cells
    indent = realLength (Text.concat before)
    width = max 1 (realLength (Text.concat (take length' rest)))

-- | What each character becomes on the terminal: tabs reach the next multiple of four,
-- control characters become visible signs.
expand :: Int -> String -> [Text]
expand at string = case string of
  [] -> []
  c : rest -> cell : expand (at + realLength cell) rest
    where
      cell
        | c == '\t' = Text.replicate (4 - at `mod` 4) " "
        | ord c < 0x20 = Text.singleton (toEnum (0x2400 + ord c))
        | isControl c = "\xFFFD"
        | otherwise = Text.singleton c
