-- | What can be wrong with the form of a program.
module Surface.Error
  ( Error (..),
    Found (..),
    toReport,
  )
where

import Base.Name qualified as Name
import Base.Region (Region)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (Code, Label (..), Place (..), Report (..), Severity (..), report)
import Surface.Token (Token_ (..), describe)

-- | A fact about the text, and where it stands.
data Error
  = -- | a token where something else was expected
    Unexpected Region Found [Text]
  | -- | a bracket that is never closed: where it was missed, the bracket, what it opened
    Unclosed Region Region Text
  | -- | a word that begins no statement; the words that do
    UnknownStatement Region Text [Text]
  | -- | a keyword or a unit where a name was to be given
    Reserved Region Text
  deriving stock (Eq, Ord, Show)

-- | What stands there.
data Found = FoundToken Token_ | FoundEnd
  deriving stock (Eq, Ord, Show)

-- | The words for it.
toReport :: Error -> Report
toReport err = case err of
  Unexpected region (FoundToken (Stray c)) _ ->
    (at region "E0102" ("the character " <> quote (Text.singleton c) <> " has no place in a program"))
      { hints = strayHint c
      }
  Unexpected region (FoundToken OpenText) _ ->
    (at region "E0103" "a text without its closing quotation mark")
      { hints = ["A text ends with \" on the line on which it begins."]
      }
  Unexpected region (FoundToken (BadNumber text)) _ ->
    (at region "E0104" (quote text <> " is not a number"))
      { hints = ["Numbers look like 41, 59.3 or 0.02; a unit may follow: 20 mm, 45 deg, 60 mm/min."]
      }
  Unexpected region found expected ->
    (at region "E0101" ("found " <> shown found <> expectation expected))
      { label = "here",
        hints = case (found, expected) of
          (FoundToken (Symbol ","), _) ->
            ["A decimal point is a point: 59.3. A comma separates values."]
          _ -> []
      }
  Unclosed region opened what ->
    (at region "E0105" (what <> " is not closed"))
      { label = "the closing bracket was expected before this",
        others = [Label opened "opened here"]
      }
  UnknownStatement region word known ->
    (at region "E0106" (quote word <> " begins no statement"))
      { message = ["A statement begins with one of: " <> Text.intercalate ", " known <> "."],
        hints = ["Did you mean " <> quote w <> "?" | w <- take 1 (Name.nearest word known)]
      }
  Reserved region word ->
    (at region "E0107" (quote word <> " is a word of the language and cannot be a name"))
      { hints = ["Choose another name, for example " <> word <> "1."]
      }

at :: Region -> Code -> Text -> Report
at region code = report Error code (InSource region)

shown :: Found -> Text
shown found = case found of
  FoundToken token -> describe token
  FoundEnd -> "the end of the program"

expectation :: [Text] -> Text
expectation expected = case expected of
  [] -> ""
  [one] -> ", expected " <> one
  many' -> ", expected " <> Text.intercalate ", " (init many') <> " or " <> last many'

quote :: Text -> Text
quote text = "‘" <> text <> "’"

strayHint :: Char -> [Text]
strayHint c
  | c `elem` ("−–—" :: String) = ["Write the minus sign as -."]
  | c `elem` ("“”„«»'" :: String) = ["A text stands between \" and \"."]
  | c == ';' = ["Statements need no separator; a comment begins with --."]
  | c == '°' = ["Write degrees as deg: 45 deg."]
  | otherwise = []
