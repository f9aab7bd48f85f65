-- | Lines of other languages in the text of a program, and the statements that say the same.
--
-- A line is looked at only if the parser found a mistake in a line of the same language.
module Surface.Foreign
  ( ForeignText (..),
    ForeignLine (..),
    ForeignLanguage (..),
    recognise,
    blanked,
  )
where

import Base.Region (Region (..))
import Data.Char (isSpace)
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Ord (Down (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.ForeignLine (ForeignLanguage (..), Reading (..))
import Surface.ForeignLine qualified as ForeignLine

-- | Lines of another language in a text.
data ForeignText = ForeignText {language :: ForeignLanguage, lines' :: NonEmpty ForeignLine}

-- | Line of another language.
data ForeignLine = ForeignLine
  { -- | region of the line without the spaces around it
    place :: Region,
    -- | text at this region
    written :: Text,
    -- | statements that say the same, each on a line; empty if there are none
    translation :: Text
  }
  deriving stock (Eq, Ord, Show)

-- | Finds the lines of another language. The text begins at the offset @begin@; @mistakes@ are the
-- regions of the mistakes in it. Of several languages, the one with the most lines is found.
-- 'Nothing' if no mistake is in such a line.
recognise :: Int -> Text -> [Region] -> Maybe ForeignText
recognise begin text mistakes =
  listToMaybe
    ( sortOn
        (Down . length . lines')
        [ ForeignText {language, lines' = found}
          | language <- [minBound .. maxBound],
            Just found <- [NonEmpty.nonEmpty (linesOf language)],
            any (\l -> any (isIn (place l)) mistakes) found
        ]
    )
  where
    linesOf language =
      concat (zipWith located ofText (ForeignLine.readLines language (map snd ofText)))
    ofText = numbered begin (Text.split (`elem` ['\n', '\r']) text)
    isIn (Region from to) mistake = start mistake >= from && start mistake <= to

-- | Lines with the offsets at which they start.
numbered :: Int -> [Text] -> [(Int, Text)]
numbered offset ls = case ls of
  [] -> []
  l : more -> (offset, l) : numbered (offset + Text.length l + 1) more

located :: (Int, Text) -> Reading -> [ForeignLine]
located (offset, line) reading = case reading of
  Own -> []
  Other translation ->
    let from = offset + Text.length (Text.takeWhile isSpace line)
        written = Text.strip line
     in [ForeignLine {place = Region from (from + Text.length written), written, translation}]

-- | The text, which begins at the offset @begin@, with spaces in place of the lines.
blanked :: Int -> Text -> ForeignText -> Text
blanked begin text found = Text.concat (go begin text (NonEmpty.toList (lines' found)))
  where
    go offset rest ls = case ls of
      [] -> [rest]
      l : more ->
        let Region from to = place l
            (kept, after) = Text.splitAt (from - offset) rest
         in kept : Text.replicate (to - from) " " : go to (Text.drop (to - from) after) more
