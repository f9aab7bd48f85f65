-- | A line of the program with marks under a part of it, aligned by the width that
-- characters have on a terminal.
module Report.Excerpt
  ( Excerpt (..),
    excerpts,
    visible,
  )
where

import Base.Region (Position (..), Region (..), Source)
import Base.Region qualified as Region
import Data.Char (GeneralCategory (Format), generalCategory, isControl, ord)
import Data.List (mapAccumL)
import Data.Text (Text)
import Data.Text qualified as Text
import Text.DocLayout (realLength)

-- | A line to print, and where under it the marks go, in columns of the terminal from 0; so many of
-- its characters are left out at its front, and the same line as that of the excerpt before need
-- not be printed again.
data Excerpt = Excerpt
  { place :: Position,
    shown :: Text,
    indent :: Int,
    width :: Int,
    skipped :: Int,
    isSame :: Bool
  }
  deriving stock (Eq, Show)

-- | The line on which each region begins. A region of several lines is marked to the end of its
-- first.
excerpts :: Source -> [Region] -> [Excerpt]
excerpts source =
  snd . mapAccumL (\before region -> let e = excerpt source before region in (Just e, e)) Nothing

-- | The line on which a region begins, behind another one.
excerpt :: Source -> Maybe Excerpt -> Region -> Excerpt
excerpt source before region =
  Excerpt
    { place,
      shown = Text.concat (cutBefore <> window <> cutAfter),
      indent,
      width,
      skipped,
      isSame
    }
  where
    place@Position {file = file', line = line', column} = Region.position source (start region)
    content = Region.lineText source (start region)
    cells = expand 0 (Text.unpack content)
    length' = max 0 (min (end region - start region) (Text.length content - column + 1))
    -- Of a very long line only the surroundings of the place are shown.
    (skipped, isSame) = case before of
      Just Excerpt {place = Position {file, line}, skipped = front}
        | file == file',
          line == line',
          front == own || front < column && column - 1 + length' <= front + longest ->
          (front, True)
      _ -> (own, False)
    own = if Text.length content > longest then max 0 (column - 1 - longest `div` 2) else 0
    window = take longest (drop skipped cells)
    cutBefore = ["…" | skipped > 0]
    cutAfter = ["…" | Text.length content - skipped > longest]
    (ahead, rest) = splitAt (column - 1 - skipped) window
    indent = realLength (Text.concat (cutBefore <> ahead))
    width = max 1 (realLength (Text.concat (take length' rest)))

-- | How many characters of a line are shown.
longest :: Int
longest = 120

-- | A text without characters that a terminal would obey.
visible :: Text -> Text
visible = Text.map sign
  where
    sign c = if c == '\n' then c else shownAs c

-- | Control characters become visible signs, those that steer the writing direction a mark.
shownAs :: Char -> Char
shownAs c
  | ord c < 0x20 = toEnum (0x2400 + ord c)
  | isControl c || generalCategory c == Format = '\xFFFD'
  | otherwise = c

-- | What each character becomes on the terminal: tabs reach the next multiple of four.
expand :: Int -> String -> [Text]
expand at string = case string of
  [] -> []
  c : rest -> cell : expand (at + realLength cell) rest
    where
      cell
        | c == '\t' = Text.replicate (4 - at `mod` 4) " "
        | otherwise = Text.singleton (shownAs c)
