{-# OPTIONS_GHC -O0 #-}

-- | Mistakes in the syntax of a program, its imports and its table files, and their reports.
module Surface.Error
  ( Error (..),
    FoundText (..),
    Enclosure (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name qualified as Name
import Base.Region (Region (..))
import Data.Char (isLetter)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report
  ( Label (..),
    Report (..),
    ReportCode,
    ReportPlace (..),
    Severity (..),
    quote,
    report,
  )
import Surface.Keyword qualified as Keyword
import Surface.Token (Token_ (..), columnUnits, describe, unitName)

-- | A mistake with the region that a report points at, and the facts of the report.
data Error
  = -- | an unexpected token: the text found, the expected tokens in words, the tokens on both sides
    Unexpected Region FoundText [Text] Neighbours
  | -- | an enclosure without its closing bracket: the region where the bracket was expected, the
    -- region of the opening bracket, the enclosure
    Unclosed Region Region Enclosure
  | -- | a word that begins no statement: the word, the keywords that begin a statement
    UnknownStatement Region Text [Text]
  | -- | a reserved word where a name is defined
    Reserved Region Text
  | -- | a token after a complete statement on the same line
    Trailing Region Token_ Neighbours
  | -- | a token that begins no cell, in a row of a table
    NotInRow Region Token_ Neighbours
  | -- | a token that begins no heading, among the headings of a table
    NotInHeadings Region Token_ Neighbours
  | -- | a @piece@ statement that does not say on which side of its curve the piece lies; the text
    -- found instead
    NoSide Region FoundText
  | -- | a statement in the braces of another statement: the keyword of the inner one
    Misplaced Region Text
  | -- | brackets nested too deep: the limit
    TooDeep Region Int
  | -- | a program with too many tokens: the limit
    TooLong Region Int
  | -- | parentheses with more than three values
    ManyCoordinates Region
  | -- | a file that cannot be imported: its name as written, the reason
    ImportMissing Region Text Text
  | -- | imports nested deeper than the limit: the name of the file as written, the limit
    ImportTooDeep Region Text Int
  | -- | an import of an input sheet: the name of the file as written
    ImportOfSheet Region Text
  | -- | a table file that cannot be read: its name as written, the reason
    LinesMissing Region Text Text
  | -- | an import cycle: the paths of files, each of which imports the next one; the first path is
    -- also the last
    ImportCycle Region [Text]
  | -- | an empty table file
    EmptyTable Region
  | -- | a heading of a table file that is not the name of a column with an optional unit: its text
    BadHeading Region Text
  | -- | a cell of a table file that is not a number: its text
    BadCell Region Text
  | -- | a row with too many or too few cells in a table file: the row's index from 1, the count of
    -- columns, the count of cells. The flag is true if the row's commas may be decimal commas
    CellCount Region Int Int Int Bool
  | -- | a command-line value for an unknown parameter: its name, the names of all parameters
    NoSuchParam Text [Text]
  | -- | a command-line value that cannot be parsed: the region of the parameter, its name, the text
    -- of the value, the number of errors in the text
    BadAssignment Region Text Text Int
  deriving stock (Eq, Ord, Show)

-- | The neighbours of a wrong token: the token before it, and the token after it if that follows
-- without a space. 'Nothing' for a missing neighbour.
type Neighbours = (Maybe Token_, Maybe Token_)

-- | The text found at a region: a token, or the end of the text.
data FoundText = FoundToken Token_ | FoundEnd
  deriving stock (Eq, Ord, Show)

-- | A part of a program between two brackets.
data Enclosure
  = -- | a part in parentheses or square brackets: the opening bracket
    BracketOf Text
  | -- | the block of the contour with the given name
    ContourBlock Text
  | TableBlock
  | RepetitionBlock
  | -- | the block of a statement with the given keyword
    BlockOf Text
  deriving stock (Eq, Ord, Show)

-- | The report of a mistake.
toReport :: Error -> Report
toReport err = case err of
  Unexpected region (FoundToken (Stray c)) _ _ ->
    ( at
        region
        "E0102"
        ("the character " <> quote (Text.singleton c) <> " has no place in a program")
    )
      { fixes = strayFixes region c,
        hints = strayHint c
      }
  Unexpected region (FoundToken OpenText) _ _ ->
    (at region "E0103" "a text without its closing quotation mark")
      { hints = ["A text ends with \" on the line on which it begins."]
      }
  Unexpected region (FoundToken (BadNumber text)) _ _ ->
    (at region "E0104" (quote text <> " is not a number"))
      { hints = ["Numbers look like 41, 59.3 or 0.02; a unit may follow: 20 mm, 45 deg, 60 mm/min."]
      }
  Unexpected region found expected neighbours ->
    (at region "E0101" ("found " <> shown found <> expectation expected))
      { label = "here",
        fixes = case found of
          FoundToken token
            | isWord expected -> meant region token expected
            | otherwise -> meant region token expected <> tokenFixes region token neighbours
          FoundEnd -> [],
        hints = case found of
          FoundToken (Symbol "=")
            | quote "closed" `elem` expected ->
              ["A contour has no such sign: contour name closed { … }"]
          FoundToken token
            | not (isWord expected) -> advice token neighbours
          FoundToken _ -> []
          FoundEnd -> []
      }
  Unclosed region opened what ->
    (at region "E0105" (enclosureWords what <> " is not closed"))
      { label = "the closing bracket was expected before this",
        others = [Label opened "opened here"],
        fixes = case what of
          BracketOf _ -> []
          _ -> [Fix.proposed (Fix.insertion "Write } before this." (start region) "}\n")]
      }
  UnknownStatement region word known ->
    (at region "E0106" (quote word <> " begins no statement"))
      { message = ["A statement begins with one of: " <> Text.intercalate ", " known <> "."],
        fixes =
          if word `elem` declaring
            then [Fix.exchange ("Write let instead of " <> quote word <> ".") region "let"]
            else nearby region word known,
        hints = case (Name.lookAlike word known, Name.nearest word known) of
          (_ : _, _) -> ["One of them has a letter of the other alphabet, Cyrillic or Latin."]
          ([], _ : _) -> []
          ([], []) ->
            ["To give a name to a value, write: let " <> word <> " = …" | word `notElem` declaring]
      }
  Reserved region word ->
    (at region "E0107" (quote word <> " is a word of the language and cannot be a name"))
      { hints = ["Choose another name, for example " <> word <> "1."]
      }
  Trailing region token neighbours
    | isBroken token ->
      toReport (Unexpected region (FoundToken token) [] neighbours)
  Trailing region token neighbours ->
    (at region "E0108" ("the statement ends before " <> describe token))
      { message = ["Every statement begins on a line of its own."],
        fixes = tokenFixes region token neighbours,
        hints = advice token neighbours
      }
  NotInRow region token _
    | isBroken token && token `notElem` map Stray [';', '|'] ->
      toReport (Unexpected region (FoundToken token) [] (Nothing, Nothing))
  NotInRow region token neighbours ->
    (at region "E0120" (describe token <> " does not belong in a row of a table"))
      { fixes = rowFixes region token neighbours,
        hints = rowAdvice token neighbours
      }
  NotInHeadings region token _
    | isBroken token ->
      toReport (Unexpected region (FoundToken token) [] (Nothing, Nothing))
  NotInHeadings region token _ ->
    (at region "E0120" (describe token <> " does not belong among the names of columns"))
      { hints = headingAdvice token
      }
  NoSide region found ->
    (at region "E0101" ("found " <> shown found <> expectation (map quote ["left", "right"])))
      { label = "here",
        hints =
          [ "Say on which side of its curve the piece lies, to the left or to the right of the \
            \direction of travel: piece q = c left"
          ]
      }
  Misplaced region word ->
    (at region "E0109" (quote word <> " is a statement and does not belong in these braces"))
      { hints =
          if word `elem` ["rapid", "feed"]
            then ["Behind a point, " <> quote word <> " stands on the line of that point."]
            else ["Move it above the statement in whose braces it stands."]
      }
  TooLong region limit ->
    (at region "E0116" ("the program has more than " <> Decimal.whole limit <> " words and signs"))
      { hints = ["Repeat with for and functions what repeats."]
      }
  ManyCoordinates region ->
    (at region "E0111" "a point has two or three coordinates")
      { hints =
          [ "A decimal point is a point: 59.3. A comma separates values.",
            "A list stands in square brackets: [1, 2, 3, 4]."
          ]
      }
  LinesMissing region name why ->
    (at region "E0112" ("the table " <> quote name <> " cannot be read: " <> why))
      { hints = ["The name is looked for from the folder of the file that names it."]
      }
  ImportMissing region name why -> notImported region name why
  ImportTooDeep region name limit ->
    notImported
      region
      name
      ("imports are nested more than " <> Decimal.whole limit <> " deep")
  ImportOfSheet region name ->
    notImported region name "it is an input sheet, of which partc import makes a program"
  ImportCycle region files ->
    (at region "E0113" "this file imports itself")
      { message = [Text.intercalate " imports " files <> "."],
        hints = ["Put what both need into a third file." | length files > 2]
      }
  EmptyTable region ->
    (at region "E0117" "the file of a table is empty")
      { hints =
          [ "Its first line names the columns, its others have a number for each: x,y and \
            \below it 0,40"
          ]
      }
  BadHeading region text ->
    ( at
        region
        "E0118"
        ( if Text.null text
            then "a column without a name"
            else quote text <> " cannot name a column"
        )
    )
      { hints =
          [ "The first line of the file names the columns, with a unit if there is one: \
            \x,y,mu deg"
          ]
      }
  BadCell region text ->
    ( at
        region
        "E0119"
        ( if Text.null text
            then "a cell of the table is empty"
            else quote text <> " is not a number"
        )
    )
      { hints = ["Every line has a number for each column; the unit stands in the first line."]
      }
  CellCount region number columns cells decimal ->
    ( at
        region
        "E0226"
        ( "row "
            <> Decimal.whole number
            <> " has "
            <> counted cells "cell"
            <> ", but the table has "
            <> counted columns "column"
        )
    )
      { hints =
          [ "A row is one line of the file, with a number for each column that the first line \
            \names."
          ]
            <> [ "If these are decimal commas, put semicolons between the columns: x;y and below \
                 \it 0,5;40"
                 | decimal
               ]
      }
  NoSuchParam name known ->
    (report Error "E0114" InFile ("the program has no parameter " <> quote name))
      { hints =
          ["Did you mean " <> quote w <> "?" | w <- take 1 (Name.nearest name known)]
            <> [ if null known
                   then "A parameter is defined by: param " <> name <> " = 25 mm"
                   else "Its parameters are: " <> Text.intercalate ", " known <> "."
               ]
      }
  BadAssignment region name text _ ->
    (at region "E0115" (quote text <> " is no value for " <> quote name))
      { label = "the parameter",
        hints =
          ["A decimal point is a point: 59.3." | Text.isInfixOf "," text]
            <> ["Write a value as in the program, for example: --set " <> name <> "=\"25 mm\""]
      }
  TooDeep region limit ->
    at region "E0110" ("brackets are nested more than " <> Decimal.whole limit <> " deep")

-- | The report of a file that cannot be imported: the region of the import, the name of the file as
-- written, and the reason.
notImported :: Region -> Text -> Text -> Report
notImported region name why =
  (at region "E0112" (quote name <> " cannot be imported: " <> why))
    { hints = ["The name is looked for from the folder of the file that imports it."]
    }

-- | The words for an enclosure in a report.
enclosureWords :: Enclosure -> Text
enclosureWords enclosure = case enclosure of
  BracketOf bracket -> quote bracket
  ContourBlock name -> "the contour " <> quote name
  TableBlock -> "the table"
  RepetitionBlock -> "the repetition"
  BlockOf keyword -> "the block of " <> quote keyword

-- | Fixes that put an expected keyword in place of the token @token@, which resembles it;
-- @expected@ has the descriptions of the expected tokens.
meant :: Region -> Token_ -> [Text] -> [Fix]
meant region token expected = case token of
  Word word -> nearby region word words'
  _ -> []
  where
    words' = map (Text.dropAround (`elem` ("‘’" :: String))) expected

-- | Words with which a value gets its name in other languages.
declaring :: [Text]
declaring =
  Text.words "var const def val auto int float double real number length angle point line circle"

-- | Fix that puts a similar word in place of a word; none if no known word is similar.
nearby :: Region -> Text -> [Text] -> [Fix]
nearby region word known =
  [ Fix.exchange ("Write " <> quote w <> " instead of " <> quote word <> ".") region w
    | w <- take 1 (Name.lookAlike word known <> Name.nearest word known)
  ]

-- | Fixes for a misplaced token, judged by the tokens on both sides of it.
tokenFixes :: Region -> Token_ -> Neighbours -> [Fix]
tokenFixes region token neighbours = case (token, neighbours) of
  (Symbol ",", (Just (Number _ Nothing), Just (Number _ _))) ->
    [Fix.exchange "Write a decimal point." region "."]
  (Symbol ",", (Just (Symbol ")"), _)) -> [Fix.removal "Remove the comma." region]
  (Symbol "+", _) -> [Fix.removal "Remove the sign +." region]
  (Symbol "=", (Just (Symbol "="), _)) -> [Fix.removal "Write one sign: a = b." region]
  (Symbol "/", (Just (Symbol "/"), _)) ->
    [Fix.exchange "Begin the comment with --." (Region (start region - 1) (end region)) "--"]
  _ -> []

-- | Suggests what the author meant by a misplaced token, judged by the tokens on both sides of it.
advice :: Token_ -> Neighbours -> [Text]
advice token neighbours = case (token, neighbours) of
  (Symbol ",", (Just (Number _ Nothing), Just (Number _ _))) ->
    ["A decimal point is a point: 59.3. A comma separates values."]
  (Symbol ",", _) ->
    [ "No comma belongs here: the elements of a contour stand one after another, and a point in \
      \brackets: (0, 0)."
    ]
  (Symbol "(", (Just (Word _), _)) ->
    ["The parenthesis of a call, or of a function's parameters, touches the name: f(3)."]
  (Symbol "(", _) -> ["Is a comma missing before it?"]
  (Symbol "+", _) -> ["A positive number needs no sign."]
  (Symbol "*", (Just (Symbol "*"), _)) -> ["There are no powers: write x * x."]
  (Symbol "=", (Just (Symbol "="), _)) -> []
  (Symbol "=", _) -> ["To give a name to a value, write: let name = value"]
  (Word word, (Just (Number _ _), _))
    | word `notElem` Keyword.reservedWords ->
      [ "If this was meant as a unit: the units are "
          <> Text.intercalate ", " (map unitName [minBound .. maxBound])
          <> "."
      ]
  _ -> []

-- | Fixes for a token that begins no cell of a row.
rowFixes :: Region -> Token_ -> Neighbours -> [Fix]
rowFixes region token neighbours = case (token, neighbours) of
  (Symbol ",", (Just (Number _ Nothing), Just (Number _ _))) ->
    [Fix.exchange "Write a decimal point." region ".", space]
  (Symbol ",", _) -> [space]
  (Stray _, _) -> [space]
  (Symbol "+", (_, Just (Number _ _))) -> [Fix.removal "Remove the sign +." region]
  (_, _) -> []
  where
    space = Fix.exchange "Write a space between the values." region " "

-- | Suggests what to write instead of a token that begins no cell of a row.
rowAdvice :: Token_ -> Neighbours -> [Text]
rowAdvice token neighbours = case (token, neighbours) of
  (Symbol ",", _) -> [spaces]
  (Stray _, _) -> [spaces]
  (Symbol "(", (Just (Symbol "-"), _)) -> ["The sign stands in the brackets too: (-h)."]
  (Symbol "+", (_, Just (Number _ _))) -> ["A positive number needs no sign.", computed "2 + 6"]
  (Symbol s, _) | s `elem` ["*", "/", "-", "+"] -> [computed ("2 " <> s <> " 6")]
  (Word word, (_, touching))
    | not (Keyword.isReserved word) ->
      [computed (if touching == Just (Symbol "(") then word <> "(…)" else word)]
  (_, _) -> [spaces, computed "2 * h"]
  where
    spaces = "The values of a row stand one after another with spaces between them: 0 40"
    computed what = "What is no plain number stands in brackets: (" <> what <> ")."

-- | Suggests what to write instead of a token that begins no heading of a table.
headingAdvice :: Token_ -> [Text]
headingAdvice token = case token of
  Symbol "/" -> [units]
  Symbol "," -> [names]
  Symbol _ -> [names, units]
  Word word
    | word `elem` map unitName [minBound .. maxBound] -> [units]
    | otherwise ->
      ["It is a word of the language: choose another name, for example " <> word <> "1."]
  _ -> [names, "In a row below them, what is no plain number stands in brackets: (h)."]
  where
    names = "The line with the names of the columns has nothing else: x y mu deg H"
    units =
      "A column has one of the units "
        <> Text.intercalate ", " (map unitName columnUnits)
        <> ", or none."

counted :: Int -> Text -> Text
counted n thing = Decimal.whole n <> " " <> thing <> (if n == 1 then "" else "s")

-- | Tells if exactly one token is expected, and it is a keyword. The report names this keyword and
-- leaves 'advice' out.
isWord :: [Text] -> Bool
isWord expected = case expected of
  [one] -> Text.any isLetter one && Text.isPrefixOf "‘" one
  _ -> False

-- | Tells if a token is wrong at every position of a program, such as a stray character.
isBroken :: Token_ -> Bool
isBroken token = case token of
  Stray _ -> True
  OpenText -> True
  BadNumber _ -> True
  Word _ -> False
  Number _ _ -> False
  Text _ -> False
  Symbol _ -> False

at :: Region -> ReportCode -> Text -> Report
at region code = report Error code (InSource region)

shown :: FoundText -> Text
shown found = case found of
  FoundToken token -> describe token
  FoundEnd -> "the end of the program"

expectation :: [Text] -> Text
expectation expected = case expected of
  [] -> ""
  [one] -> ", expected " <> one
  many' -> ", expected " <> Text.intercalate ", " (init many') <> " or " <> last many'

-- | Fixes for a character that has no place in a program.
strayFixes :: Region -> Char -> [Fix]
strayFixes region c
  | c `elem` ("−–—" :: String) = [put "Write the minus sign as -." "-"]
  | c `elem` ("×·" :: String) = [put "Write the product with *." "*"]
  | c == ':' = [Fix.removal "Remove the colon." region]
  | c == '#' = [put "Begin the comment with --." "--"]
  | c == ';' = [put "Begin a new line instead." "\n"]
  | c == '°' = [put "Write degrees as deg." " deg"]
  | otherwise = []
  where
    put title = Fix.exchange title region

strayHint :: Char -> [Text]
strayHint c
  | c `elem` ("“”„«»'" :: String) = ["A text stands between \" and \"."]
  | c == '^' = ["There are no powers: write x * x, and sqrt(x) for a root."]
  | c == '±' = ["A tolerance is a statement of its own: tolerance 0.02 mm"]
  | c == '&' = ["Write: and"]
  | c == '|' = ["Write: or"]
  | c == '!' = ["Write: not"]
  | c == ';' = ["If it begins a comment: comments begin with --."]
  | c == '.' = ["Write a number with digits on both sides of its point: 0.5, 5.0 or 5."]
  | otherwise = []
