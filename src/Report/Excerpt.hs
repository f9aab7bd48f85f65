-- | Excerpts of a program: source lines with a mark under a region.
--
-- The mark is aligned by the widths that characters have on a terminal. Characters that would
-- control the terminal are replaced by visible ones. "Report.Human" adds the colours.
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

-- | A source line to print, and the mark under the region of a report.
data Excerpt = Excerpt
  { -- | position of the region's first character
    place :: Position,
    -- | text of the line; of a long line only a window, which is a range of the line's characters.
    -- The character … replaces what is left out before or after the window
    shown :: Text,
    -- | terminal column of the mark, from 0
    indent :: Int,
    -- | width of the mark in terminal columns, at least 1
    width :: Int,
    -- | count of characters left out at the front of the line
    skipped :: Int,
    -- | true if the previous excerpt shows exactly this line or window, so that the line need not
    -- be printed again
    isSame :: Bool
  }
  deriving stock (Eq, Show)

-- | Makes one excerpt for each region, in the order of the list. A region of several lines is
-- marked only to the end of its first line. @room@ is the count of terminal columns for a line.
excerpts :: Int -> Source -> [Region] -> [Excerpt]
excerpts room source = snd . mapAccumL next Nothing
  where
    next before region = let e = excerpt room source before region in (Just e, e)

-- | Makes the excerpt of a region. @before@ is the previous excerpt; it is 'Nothing' for the first
-- region. A line that is wider than @room@ columns is cut to a window around the region.
excerpt :: Int -> Source -> Maybe Excerpt -> Region -> Excerpt
excerpt room source before region =
  Excerpt
    { place,
      shown = Text.concat (ellipsisBefore <> window <> ellipsisAfter),
      indent,
      width,
      skipped,
      isSame
    }
  where
    place@Position {file = file', line = line', column} = Region.position source (start region)
    content = Region.lineText source (start region)
    printed = expand 0 (Text.unpack content)
    length' = max 0 (min (end region - start region) (Text.length content - column + 1))
    isCut = realLength (Text.concat printed) > room
    -- The characters of a window from the character @front@ on. Two columns are for the ellipses.
    windowFrom front
      | isCut = takeColumns (max 1 (room - 2)) (drop front printed)
      | otherwise = printed
    -- If the window of the previous excerpt contains the region, this excerpt has the same window,
    -- so that the line is printed only once.
    (skipped, isSame) = case before of
      Just Excerpt {place = Position {file, line}, skipped = front}
        | file == file',
          line == line',
          front == ownStart
            || front < column
            && column - 1 + length' <= front + length (windowFrom front) ->
          (front, True)
      _ -> (ownStart, False)
    -- The region is in the middle of its window. A longer region begins with its window.
    ownStart
      | isCut = max 0 (column - 1 - max 0 (room - 2 - length') `div` 2)
      | otherwise = 0
    window = windowFrom skipped
    ellipsisBefore = ["…" | skipped > 0]
    ellipsisAfter = ["…" | Text.length content - skipped > length window]
    (beforeMark, rest) = splitAt (column - 1 - skipped) window
    indent = realLength (Text.concat (ellipsisBefore <> beforeMark))
    width = max 1 (realLength (Text.concat (take length' rest)))

-- | The longest beginning of a list of printed characters that has at most @columns@ columns.
takeColumns :: Int -> [Text] -> [Text]
takeColumns columns characters = case characters of
  c : rest
    | realLength c <= columns -> c : takeColumns (columns - realLength c) rest
  _ -> []

-- | Replaces the control and format characters of a text by visible ones, but keeps line feeds.
visible :: Text -> Text
visible = Text.map sign
  where
    sign c = if c == '\n' then c else shownAs c

-- | Visible form of a character. Characters below U+0020 become their control pictures (U+2400 and
-- following). Other control characters and format characters, such as those that change the writing
-- direction, become U+FFFD.
shownAs :: Char -> Char
shownAs c
  | ord c < 0x20 = toEnum (0x2400 + ord c)
  | isControl c || generalCategory c == Format = '\xFFFD'
  | otherwise = c

-- | Printed form of each character of a string. The string begins at the terminal column @at@, from
-- 0. A tab becomes spaces up to the next column that is a multiple of four.
expand :: Int -> String -> [Text]
expand at string = case string of
  [] -> []
  c : rest -> printedCharacter : expand (at + realLength printedCharacter) rest
    where
      printedCharacter
        | c == '\t' = Text.replicate (4 - at `mod` 4) " "
        | otherwise = Text.singleton (shownAs c)
