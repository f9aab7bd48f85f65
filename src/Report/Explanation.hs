-- | Explanations of report codes: a text, a wrong program and the same program corrected.
--
-- Each explanation is a Markdown file in @explain/@, compiled into the program. This module parses
-- the files, finds an explanation by its code, and renders it for a terminal or for Markdown.
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
    firstParagraph,
    plain,
    subjects,
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

-- | Explanation of one code.
data Explanation = Explanation
  { code :: ReportCode,
    -- | one line without a full stop, in Markdown
    title :: Text,
    -- | paragraphs in Markdown, whose lines fit a terminal of 80 columns
    prose :: Text,
    -- | example for which partc reports the code
    wrong :: Example,
    -- | the corrected example
    right :: Example
  }
  deriving stock (Eq, Show)

-- | Example text; each line has its line end.
data Example = Example Language Text
  deriving stock (Eq, Show)

-- | Language of an example.
data Language
  = -- | a complete part program
    Part
  | -- | lines of a terminal, or rows of a tape
    Session
  deriving stock (Eq, Show)

-- | All explanations, ordered by group (the first two digits of the code), in each group the errors
-- before the warnings.
everything :: [Explanation]
everything = sortOn order (mapMaybe readOne Embedded.files)
  where
    readOne (file, bytes) = either (const Nothing) Just (Encoding.decodeUtf8' bytes) >>= parse file
    order e = let ReportCode c = code e in (Text.take 2 (Text.drop 1 c), Text.take 1 c, c)

-- | Parses the text of an explanation. The name @file@ is the code with the extension @.md@. The
-- text has a heading with the code and the title, paragraphs, the wrong example, and the right
-- example. Nothing if the text has another form.
parse :: FilePath -> Text -> Maybe Explanation
parse file text = do
  name <- Text.stripSuffix ".md" (Text.pack file)
  let (heading, body) = Text.breakOn "\n" text
  title <- Text.stripPrefix ("# " <> name <> ": ") heading
  let (prose, examples) = Text.breakOn "\n```" body
  (wrong, following) <- example "wrong" examples
  (right, rest) <- example "right" following
  if Text.null (Text.strip rest) && not (Text.null (Text.strip prose))
    then Just Explanation {code = ReportCode name, title, prose = Text.strip prose, wrong, right}
    else Nothing

-- | Parses the fenced block of Markdown at the beginning of a text. @kind@ is @wrong@ or @right@.
-- Gives the example and the text after the block; nothing if there is no block of this kind.
example :: Text -> Text -> Maybe (Example, Text)
example kind text = case Text.stripPrefix ("```part " <> kind <> "\n") trimmed of
  Just rest -> closed Part rest
  Nothing -> Text.stripPrefix ("```text " <> kind <> "\n") trimmed >>= closed Session
  where
    trimmed = Text.stripStart text
    closed language rest = case Text.breakOn "\n```\n" rest of
      (_, "") -> Nothing
      (content, following) -> Just (Example language (content <> "\n"), Text.drop 5 following)

-- | Finds the explanations of a code as a user may write it: @E0314@, @e314@, @314@ or
-- @error[E0314]@. A number without a letter finds the error and the warning of this number. The
-- list is empty if no explanation has the code.
find :: Text -> [Explanation]
find word = filter isMeant everything
  where
    (letters, number) = readCode word
    isMeant e =
      let ReportCode c = code e
       in number /= "" && Text.drop 1 c == number && (letters == "" || Text.take 1 c == letters)

-- | Splits a code as a user writes it into its letter in upper case and its four digits. The letter
-- may be empty. The digits are empty if the word is no code.
readCode :: Text -> (Text, Text)
readCode word =
  (letters, if isNumber then Text.justifyRight 4 '0' (Text.dropWhile (== '0') digits) else "")
  where
    within = Text.takeWhile (/= ']') (snd (Text.breakOnEnd "[" (Text.strip word)))
    (letters, digits) = Text.break isDigit (Text.toUpper within)
    isNumber = not (Text.null digits) && Text.all isDigit digits && Text.length letters <= 1

-- | Suggests codes in place of @word@, for which there is no explanation. If the number of @word@
-- exists with another letter (E or W), the result has the codes with this number. Otherwise it has
-- at most three codes. First come those that differ from @word@ by an exchange of neighbouring
-- digits, then the nearest numbers with the same first two digits.
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

-- | All numbers that result if two neighbouring digits of @number@ are exchanged.
exchanges :: Text -> [Text]
exchanges number =
  [ before <> Text.reverse (Text.take 2 following) <> Text.drop 2 following
    | k <- [0 .. Text.length number - 2],
      let (before, following) = Text.splitAt k number
  ]

-- | All codes with their titles, one per line.
list :: Text
list = Text.unlines [c <> "  " <> plain (title e) | e <- everything, let ReportCode c = code e]

-- | Renders an explanation for a terminal: the examples are indented instead of fenced.
render :: Explanation -> Text
render e = layOut (c <> ": " <> plain (title e)) (plain (prose e)) indented e
  where
    ReportCode c = code e
    indented content =
      Text.intercalate "\n" [if Text.null l then "" else "    " <> l | l <- Text.lines content]

-- | Renders an explanation in Markdown.
markdown :: Explanation -> Text
markdown e = layOut ("# " <> c <> ": " <> title e) (prose e) fenced e
  where
    ReportCode c = code e
    fenced content = "```\n" <> content <> "```"

-- | Joins a heading, a text and the two examples of an explanation. @shown@ renders the text of an
-- example.
layOut :: Text -> Text -> (Text -> Text) -> Explanation -> Text
layOut heading body shown e =
  Text.unlines
    [heading, "", body, "", "Wrong:", "", content (wrong e), "", "Right:", "", content (right e)]
  where
    content (Example _ text) = shown text

-- | Replaces the backquotes of Markdown by the marks ‘ and ’ in turn.
plain :: Text -> Text
plain text = Text.concat (zipWith (<>) ("" : cycle ["‘", "’"]) (Text.splitOn "`" text))

-- | The first paragraph of an explanation as one line of Markdown.
firstParagraph :: Explanation -> Text
firstParagraph e = Text.unwords (Text.lines (fst (Text.breakOn "\n\n" (prose e))))

-- | The subjects of a code, which its first two digits name, as words for a search. The manual has
-- the same groups of codes.
subjects :: ReportCode -> [Text]
subjects (ReportCode c) = case Text.take 2 (Text.drop 1 c) of
  "01" -> ["form"]
  "02" -> ["names", "types"]
  "03" -> ["values", "geometry"]
  "04" -> ["path"]
  "05" -> ["machine"]
  "06" -> ["tape"]
  "07" -> ["proof"]
  "08" -> ["files", "command-line"]
  "09" -> ["input-sheets"]
  "10" -> ["machine-descriptions"]
  _ -> []
