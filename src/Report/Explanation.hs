-- | What the code of a report means: a text for people, with a wrong program and a right one. Each
-- stands in a file of its own in @explain/@; this module reads these files, finds one by its code,
-- and lays it out for a terminal.
module Report.Explanation
  ( Explanation (..),
    Example (..),
    Language (..),
    everything,
    parse,
    find,
    near,
    list,
    render,
    markdown,
  )
where

import Data.Char (isDigit)
import Data.List (nub, sortOn)
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Report.Embedded qualified as Embedded
import Report.Report (ReportCode (..))

data Explanation = Explanation
  { code :: ReportCode,
    -- | one line, no full stop
    title :: Text,
    -- | paragraphs in Markdown, lines ready for a terminal
    prose :: Text,
    wrong :: Example,
    right :: Example
  }
  deriving stock (Eq, Show)

-- | An example, each line with its end.
data Example = Example Language Text
  deriving stock (Eq, Show)

-- | What an example is written in.
data Language
  = -- | a part program, complete
    Part
  | -- | a session at the terminal, or a piece of a tape
    Session
  deriving stock (Eq, Show)

-- | All that the program holds, ordered by their codes.
everything :: [Explanation]
everything = sortOn order (mapMaybe readOne Embedded.files)
  where
    readOne (file, bytes) = either (const Nothing) Just (Encoding.decodeUtf8' bytes) >>= parse file
    -- Warnings stand behind the errors of their group.
    order e = let ReportCode c = code e in (Text.take 2 (Text.drop 1 c), Text.take 1 c, c)

-- | Read a file: a heading with the code that its name tells, paragraphs, the wrong example, the
-- right one.
parse :: FilePath -> Text -> Maybe Explanation
parse file text = do
  name <- Text.stripSuffix ".md" (Text.pack file)
  let (heading, body) = Text.breakOn "\n" text
  title <- Text.stripPrefix ("# " <> name <> ": ") heading
  let (prose, examples) = Text.breakOn "\n```" body
  (wrong, behind) <- example "wrong" examples
  (right, rest) <- example "right" behind
  if Text.null (Text.strip rest) && not (Text.null (Text.strip prose))
    then Just Explanation {code = ReportCode name, title, prose = Text.strip prose, wrong, right}
    else Nothing

-- | The fenced block of this kind that a text begins with, and what follows it.
example :: Text -> Text -> Maybe (Example, Text)
example kind text = case Text.stripPrefix ("```part " <> kind <> "\n") begun of
  Just rest -> closed Part rest
  Nothing -> Text.stripPrefix ("```text " <> kind <> "\n") begun >>= closed Session
  where
    begun = Text.stripStart text
    closed language rest = case Text.breakOn "\n```\n" rest of
      (_, "") -> Nothing
      (content, behind) -> Just (Example language (content <> "\n"), Text.drop 5 behind)

-- | The explanations that a person asks for. The letter may be small, it and zeros in front may be
-- left out, and a code may be copied with its brackets: @e314@, @314@, @error[E0314]@.
find :: Text -> [Explanation]
find word = filter isMeant everything
  where
    (letters, number) = readCode word
    isMeant e =
      let ReportCode c = code e
       in number /= "" && Text.drop 1 c == number && (letters == "" || Text.take 1 c == letters)

-- | A code as it was probably meant: its letters in upper case, four digits. No digits when it is
-- none.
readCode :: Text -> (Text, Text)
readCode word =
  (letters, if isNumber then Text.justifyRight 4 '0' (Text.dropWhile (== '0') digits) else "")
  where
    within = Text.takeWhile (/= ']') (snd (Text.breakOnEnd "[" (Text.strip word)))
    (letters, digits) = Text.break isDigit (Text.toUpper within)
    isNumber = not (Text.null digits) && Text.all isDigit digits && Text.length letters <= 1

-- | At most three codes that may have been meant by one that there is not: the same number with the
-- other letter, else two digits exchanged, else the nearest of its group.
near :: Text -> [Text]
near word
  | number == "" = []
  | null sameNumber = take 3 (nub (exchanged <> map snd (sortOn fst sameGroup)))
  | otherwise = sameNumber
  where
    (letters, number) = readCode word
    codes = [(Text.drop 1 c, c) | e <- everything, let ReportCode c = code e]
    sameNumber = [c | (n, c) <- codes, n == number]
    sameLetter =
      [(n, c) | (n, c) <- codes, letters `notElem` ["E", "W"] || Text.take 1 c == letters]
    exchanged = [c | (n, c) <- sameLetter, n `elem` exchanges number]
    sameGroup =
      [ (abs (value n - value number), c)
        | (n, c) <- sameLetter,
          Text.take 2 n == Text.take 2 number
      ]
    value = Text.foldl' (\n d -> 10 * n + fromEnum d - fromEnum '0') 0

-- | A number with two neighbouring digits exchanged, in every place.
exchanges :: Text -> [Text]
exchanges number =
  [ before <> Text.reverse (Text.take 2 behind) <> Text.drop 2 behind
    | k <- [0 .. Text.length number - 2],
      let (before, behind) = Text.splitAt k number
  ]

-- | All codes with their titles, one a line.
list :: Text
list = Text.unlines [c <> "  " <> plain (title e) | e <- everything, let ReportCode c = code e]

-- | One explanation for a terminal: no fences, programs indented.
render :: Explanation -> Text
render e = page (c <> ": " <> plain (title e)) (plain (prose e)) indented e
  where
    ReportCode c = code e
    indented content =
      Text.intercalate "\n" [if Text.null l then "" else "    " <> l | l <- Text.lines content]

-- | One explanation for a viewer of Markdown.
markdown :: Explanation -> Text
markdown e = page ("# " <> c <> ": " <> title e) (prose e) fenced e
  where
    ReportCode c = code e
    fenced content = "```\n" <> content <> "```"

page :: Text -> Text -> (Text -> Text) -> Explanation -> Text
page heading body shown e =
  Text.unlines
    [heading, "", body, "", "Wrong:", "", content (wrong e), "", "Right:", "", content (right e)]
  where
    content (Example _ text) = shown text

-- | Words of a program stand between quotation marks on a terminal.
plain :: Text -> Text
plain text = Text.concat (zipWith (<>) ("" : cycle ["‘", "’"]) (Text.splitOn "`" text))
