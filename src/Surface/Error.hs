{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Mistakes in the syntax of a program, its imports and its table files, and their reports.
module Surface.Error
  ( Error (..),
    FoundText (..),
    Enclosure (..),
    toReport,
    failureOf,
    withRepairs,
    merged,
    valueHint,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name qualified as Name
import Base.Region (Region (..))
import Data.List (find, partition)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust, isNothing, listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), ReportPlace (..), Severity (..), at, quote, report)
import Report.Report qualified as Report
import Surface.CharacterFix qualified as CharacterFix
import Surface.CharacterReport (lookAlikeHint, strayHint, strayTitle)
import Surface.DrawingError (DrawingMistake)
import Surface.DrawingError qualified as DrawingError
import Surface.FileUnitReport qualified as FileUnitReport
import Surface.Foreign (ForeignLanguage, ForeignLine)
import Surface.ForeignReport (foreignReport)
import Surface.Keyword qualified as Keyword
import Surface.RowFix qualified as RowFix
import Surface.StatementForm qualified as StatementForm
import Surface.Token (Numeral (..), Token (attached, shape), Token_ (..), describe)
import Surface.Token qualified as Surface
import Surface.TokenContext (TokenContext (..))
import Surface.TokenFix qualified as TokenFix

-- | A mistake with the region that a report points at, and the facts of the report.
data Error
  = -- | an unexpected token: the text found, the expected tokens in words, the tokens around it
    Unexpected Region FoundText [Text] TokenContext
  | -- | an enclosure without its closing bracket: the region where the bracket was expected, the
    -- region of the opening bracket, the enclosure, the tokens around that region
    Unclosed Region Region Enclosure TokenContext
  | -- | a word that begins no statement: the word, the keywords that begin a statement, the tokens
    -- around the word
    UnknownStatement Region Text [Text] TokenContext
  | -- | the same mistake at several places: the first error and the others
    Repeated Error (NonEmpty Error)
  | -- | lines of another language: the language, and the lines
    ForeignLines Region ForeignLanguage (NonEmpty ForeignLine)
  | -- | a line that is a comment in round brackets: its text without them
    BracketComment Region Text
  | -- | a reserved word where a name is defined: the word, a similar name that is free
    Reserved Region Text Text ~[Fix]
  | -- | a token after a complete statement on the same line
    Trailing Region Token_ TokenContext
  | -- | a token that begins no cell, in a row of a table
    NotInRow Region Token_ TokenContext
  | -- | a token that begins no heading, among the headings of a table
    NotInHeadings Region Token_ TokenContext
  | -- | a @piece@ statement that does not say on which side of its curve the piece lies; the text
    -- found instead, the tokens around it
    NoSide Region FoundText TokenContext
  | -- | a statement in the braces of another statement: the keyword of the inner one, the start of
    -- the outer one, the tokens around the keyword
    Misplaced Region Text (Maybe Int) TokenContext
  | -- | a @units@ statement that does not stand at the beginning of its file: the region of the
    -- first one if this is not the first, the offset at which it belongs
    UnitsMisplaced Region (Maybe Region) Int
  | -- | brackets nested too deep: the limit
    TooDeep Region Int
  | -- | a program with too many tokens: the limit
    TooLong Region Int
  | -- | parentheses with more than three values: their tokens
    ManyCoordinates Region [Token]
  | -- | a file that cannot be imported: its name as written, the reason, and the name of a file
    -- that may be meant
    ImportMissing Region Text Text (Maybe Text)
  | -- | imports nested deeper than the limit: the name of the file as written, the limit
    ImportTooDeep Region Text Int
  | -- | an import of an input sheet: the name of the file as written
    ImportOfSheet Region Text
  | -- | a table, a drawing or a font that cannot be read: the word for it, its name as written, the
    -- reason, and the name of a file that may be meant
    FileMissing Region Text Text Text (Maybe Text)
  | -- | a mistake in a drawing, or a remark about it
    InDrawing DrawingMistake
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
  Unexpected region (FoundToken (Stray c)) _ around ->
    (at (CharacterFix.signRegion region c around) "E0102" (strayTitle c around))
      { fixes = CharacterFix.characterFixes region c around,
        hints = strayHint c around
      }
  Unexpected region (FoundToken OpenText) _ around ->
    (at region "E0103" "this text has no closing quotation mark")
      { fixes = CharacterFix.textFixes region around,
        hints =
          [ "A text begins and ends with \" on one line."
            | null (CharacterFix.textFixes region around)
          ]
      }
  Unexpected region (FoundToken (BadNumber text)) _ around ->
    (at region "E0104" (quote text <> " is neither a number nor a name"))
      { fixes = CharacterFix.numberFixes region text around,
        hints =
          [ "A number has digits and one point at most: 41, 59.3 or 0.02. A unit may follow: 20 \
            \mm, 45 deg, 60 mm/min. A name begins with a letter."
          ]
      }
  Unexpected region found expected around ->
    (at (gapRegion region expected around) "E0101" (unexpectedTitle region found expected around))
      { fixes = mends,
        hints = if null mends then advised else []
      }
    where
      mends = case found of
        FoundToken token -> TokenFix.unexpectedFixes region token expected around
        FoundEnd -> repairs around
      advised = case found of
        FoundToken token
          | hint : _ <- TokenFix.advice token around -> [hint]
        _ -> StatementForm.formHint (StatementForm.isItemStart expected) around
  Unclosed region opened what around ->
    case what of
      BracketOf bracket ->
        (at (TokenFix.closingRegion region around) "E0105" (quote bracket <> " is not closed"))
          { label = "the closing bracket is missing here",
            others = [Label opened "opened here"],
            fixes = TokenFix.closingFixes region around
          }
      _ ->
        (at region "E0105" ("the ‘{’ of " <> enclosureWords what <> " has no ‘}’"))
          { label = "the closing bracket belongs before this",
            others = [Label opened "opened here"],
            fixes = [TokenFix.braceFix region around]
          }
  UnknownStatement region word known around ->
    let mends = TokenFix.statementFixes region word known around
     in (at region "E0106" ("no statement begins with " <> quote word))
          { message =
              [ "A statement begins with one of: " <> Text.intercalate ", " known <> "."
                | null mends
              ],
            fixes = mends,
            hints =
              lookAlikeHint word known
                <> [ "The setting " <> word
                       <> " belongs in the braces of mill, pocket, turn or drill."
                     | null mends,
                       Keyword.beginsItem word
                   ]
                <> [ "To give a name to a value, write: let " <> word <> " = …"
                     | null mends,
                       not (Keyword.beginsItem word)
                   ]
          }
  Repeated first others' -> repeatedReport (toReport first) (map toReport (NonEmpty.toList others'))
  ForeignLines region language ls -> foreignReport region language (NonEmpty.toList ls)
  BracketComment region text ->
    (at region "E0101" "a comment begins with ‘--’, and is not in round brackets")
      { fixes = [Fix.exchange "Write the comment with --." region ("-- " <> text)]
      }
  Reserved region word free mends ->
    (at region "E0107" (quote word <> " is a word of the language and cannot be a name"))
      { fixes =
          if null mends
            then [Fix.exchange ("Name it " <> free <> ".") region free]
            else mends
      }
  Trailing region token around
    | isBroken token ->
      toReport (Unexpected region (FoundToken token) [] around)
  Trailing region token around ->
    (at region "E0108" (trailingTitle region token around))
      { message =
          [ "Every statement begins on a line of its own."
            | Word word <- [token],
              null mends || word `elem` Keyword.statements
          ],
        fixes = mends,
        hints =
          if null mends
            then take 1 (TokenFix.advice token around <> StatementForm.formHint False around)
            else []
      }
    where
      mends = TokenFix.trailingFixes region token around
  NotInRow region token around
    | isBroken token && token `notElem` map Stray [';', '|'] ->
      toReport (Unexpected region (FoundToken token) [] around)
  NotInRow region token around ->
    (at region "E0120" (fromMaybe title (RowFix.separatorTitle token)))
      { fixes = RowFix.rowFixes region token around,
        hints = if isJust (RowFix.separatorTitle token) then [] else RowFix.rowAdvice token around
      }
    where
      title = describe token <> " does not belong in a row of a table"
  NotInHeadings region token around
    | isBroken token && token `notElem` map Stray [';', '|'] ->
      toReport (Unexpected region (FoundToken token) [] around)
  NotInHeadings region token around ->
    (at region "E0120" (fromMaybe title (RowFix.separatorTitle token)))
      { fixes = mends,
        hints =
          if null (repairs around) && isNothing (RowFix.separatorTitle token)
            then RowFix.headingAdvice token
            else []
      }
    where
      mends =
        if null (repairs around) then RowFix.headingFixes region token around else repairs around
      title = describe token <> " does not belong among the names of columns"
  NoSide region found around ->
    ( at
        (gapRegion region sides around)
        "E0101"
        (unexpectedTitle region found sides around)
    )
      { fixes = TokenFix.sideFixes region (tokenOf found) around,
        hints =
          [ "The word says on which side of its curve the piece lies, seen in the direction of \
            \travel: piece q = c left"
          ]
      }
    where
      sides = map quote ["left", "right"]
  Misplaced region word outer around ->
    (at region "E0109" (quote word <> " is a statement and does not belong in these braces"))
      { message =
          [ "The feed of all statements below is set by a statement outside of braces."
            | word == "feed"
          ],
        fixes = TokenFix.misplacedFixes region word outer around,
        hints =
          [ "If it belongs to a point, write it after that point on the same line."
            | word `elem` ["rapid", "feed"]
          ]
      }
  UnitsMisplaced region first place' -> FileUnitReport.misplaced region first place'
  TooLong region limit ->
    (at region "E0116" ("the program has more than " <> Decimal.whole limit <> " words and signs"))
      { hints = ["Repeat with for and functions what repeats."]
      }
  ManyCoordinates region tokens ->
    (at region "E0111" "these brackets have more than the three coordinates of a point")
      { fixes = TokenFix.coordinateFixes region tokens,
        hints = ["A number has a decimal point, 59.3, and a comma separates two values."]
      }
  FileMissing region kind name why near ->
    (at region "E0112" ("the " <> kind <> " " <> quote name <> " cannot be read: " <> why))
      { fixes = nearFile region near,
        hints = ["The name is looked for from the folder of the file that names it." | null near]
      }
  InDrawing fault -> DrawingError.toReport fault
  ImportMissing region name why near
    | null near -> notImported region name why
    | otherwise -> (notImported region name why) {fixes = nearFile region near, hints = []}
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
      { hints = ["Every line has a number for each column. Write the unit in the first line."]
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
    (report Error "E0114" InCommandLine ("the program has no parameter " <> quote name))
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
            <> [valueHint name]
      }
  TooDeep region limit ->
    at region "E0110" ("brackets are nested more than " <> Decimal.whole limit <> " deep")

-- | The report of the same mistake at several places.
repeatedReport :: Report -> [Report] -> Report
repeatedReport first others' =
  first
    { others = others first <> [Label r "here too" | InSource r <- map place' (take 4 others')],
      message =
        message first
          <> [ Decimal.whole (length others' + 1) <> " places have the same mistake."
               | length others' > 4
             ],
      fixes =
        [ if all (== f) fs
            then f
            else
              Fix.joined
                (Text.dropWhileEnd (== '.') (Fix.title f) <> "; likewise at the other places.")
                (f : fs)
          | f <- fixes first,
            Just fs <- [traverse (find (isLike f) . fixes) others']
        ]
    }
  where
    place' = Report.place
    isLike f g = kindOf f == kindOf g
    kindOf = Text.takeWhile (/= ':') . Fix.title

-- | Errors of which those that are the same mistake at several places are one, and those that the
-- repair of an error before them mends are gone.
merged :: [Error] -> [Error]
merged errors = case errors of
  [] -> []
  e : rest -> case partition (isSame e) (filter (not . isMended e) rest) of
    ([], others') -> e : merged others'
    (o : more, others') -> Repeated e (o :| more) : merged others'
  where
    isSame a b = case (a, b) of
      (NotInHeadings _ s around, NotInRow _ s' around') ->
        isJust (RowFix.separatorTitle s) && s == s' && firstOf around == firstOf around'
      _ -> isJust (repetitionOf a) && repetitionOf a == repetitionOf b
    firstOf around = listToMaybe (reverse (before around))

-- | True if the only repair of the statement of the first error changes the place of the second.
isMended :: Error -> Error -> Bool
isMended e later = case (e, contextOf later) of
  (Reserved _ word _ _, Just _)
    | Unexpected _ (FoundToken (Word word')) expected _ <- later ->
      word == word' && "a value" `elem` expected
  (Unexpected _ _ _ around, Just own)
    | lastOf around == lastOf own,
      [fix] <- repairs around,
      not (Fix.isProposal fix),
      Just (region, _) <- failureOf later ->
      or [start r < start region && end region <= end r | r <- map Fix.replaced (Fix.edits fix)]
  _ -> False
  where
    lastOf c = listToMaybe (reverse (before c))

contextOf :: Error -> Maybe TokenContext
contextOf e = case e of
  Unexpected _ _ _ around -> Just around
  Trailing _ _ around -> Just around
  _ -> Nothing

-- | The mark that is equal for the same mistake at several places: a sign in one statement, or a
-- character of no statement in the whole text.
repetitionOf :: Error -> Maybe (Int, Token_, Maybe Token)
repetitionOf e = case e of
  Unexpected _ (FoundToken (Stray c)) _ _ -> Just (0, Stray c, Nothing)
  Unexpected _ (FoundToken (Symbol s)) _ around
    | s `elem` [",", "=", "-"] -> Just (1, Symbol s, statement around)
  Trailing _ token around
    | TokenFix.isDecimalComma token around -> Just (2, token, Nothing)
  NotInRow _ token@(Symbol _) around
    | TokenFix.isDecimalComma token around -> Just (5, token, statement around)
    | token == Symbol "," -> Just (3, token, statement around)
  NotInHeadings _ (Number _ _) around -> Just (4, Symbol "0", statement around)
  BracketComment _ _ -> Just (6, Symbol "(", Nothing)
  _ -> Nothing
  where
    statement around = listToMaybe (reverse (before around))

-- | The region of an error at which a statement cannot be parsed, and the expected tokens in words.
failureOf :: Error -> Maybe (Region, [Text])
failureOf e = case e of
  Unexpected region _ expected _ -> Just (region, expected)
  Trailing region _ _ -> Just (region, [])
  _ -> case Report.place (toReport e) of
    InSource region -> Just (region, [])
    _ -> Nothing

-- | An error with the repairs that a function gives for its region and its expected tokens, if
-- these are all that is wrong with the statement.
withRepairs :: (Region -> [Text] -> [Fix]) -> Error -> Error
withRepairs repairsFor e = case e of
  Unexpected region found expected around ->
    Unexpected region found expected around {repairs = repairsFor region expected}
  Trailing region token around -> Trailing region token around {repairs = repairsFor region []}
  UnknownStatement region word known around ->
    UnknownStatement region word known around {repairs = repairsFor region (map quote known)}
  NotInHeadings region token around ->
    NotInHeadings region token around {repairs = repairsFor region []}
  Reserved region word free _ -> Reserved region word free (repairsFor region ["a name"])
  _ -> e

-- | The hint that shows how the command line gives a value to the parameter @name@.
valueHint :: Text -> Text
valueHint name = "Write a value as in the program, for example: --set " <> name <> "=\"25 mm\""

-- | The report of a file that cannot be imported: the region of the import, the name of the file as
-- written, and the reason.
notImported :: Region -> Text -> Text -> Report
notImported region name why =
  (at region "E0112" (quote name <> " cannot be imported: " <> why))
    { hints = ["The name is looked for from the folder of the file that imports it."]
    }

-- | The fix that writes the name of a file that exists.
nearFile :: Region -> Maybe Text -> [Fix]
nearFile region near =
  [ Fix.exchange ("Write " <> written <> ": this file is there.") region written
    | Just file <- [near],
      let written = "\"" <> file <> "\""
  ]

-- | The words for an enclosure in a report.
enclosureWords :: Enclosure -> Text
enclosureWords enclosure = case enclosure of
  BracketOf bracket -> quote bracket
  ContourBlock name -> "the contour " <> quote name
  TableBlock -> "the table"
  RepetitionBlock -> "the repetition"
  BlockOf keyword -> "the block of " <> quote keyword

tokenOf :: FoundText -> Maybe Token_
tokenOf found = case found of
  FoundToken token -> Just token
  FoundEnd -> Nothing

-- | The region of the report of an unexpected token: that of the token before it, if that one's
-- line ends too early.
gapRegion :: Region -> [Text] -> TokenContext -> Region
gapRegion region expected around = maybe region Surface.place (endedAt expected around)

-- | The last token of a line that ends too early, before a token that begins the next line.
endedAt :: [Text] -> TokenContext -> Maybe Token
endedAt expected around
  | isLineStart around && not (StatementForm.isItemStart expected) = listToMaybe (before around)
  | otherwise = Nothing

-- | Title of the report of an unexpected token.
unexpectedTitle :: Region -> FoundText -> [Text] -> TokenContext -> Text
unexpectedTitle region found expected around = case found of
  FoundEnd -> needed <> ", but the program ends here"
  FoundToken token -> case signTitle region token around of
    Just title -> title
    Nothing
      | Just t <- endedAt expected around,
        not (null expected) ->
        wanted <> " is needed after " <> describe (shape t) <> ", but the line ends"
      | Just title <- StatementForm.settingTitle token expected around -> title
      | null expected -> describe token <> " does not belong here"
      | otherwise -> needed <> ", not " <> describe token
  where
    needed = if null expected then "more is needed here" else wanted <> " is needed here"
    wanted = case filter isTold expected of
      [] -> "more"
      [one] -> one
      many' -> Text.intercalate ", " (init many') <> " or " <> last many'
    -- A value may begin with if, which is of no interest here.
    isTold word = word /= quote "if" || "a value" `notElem` expected

-- | Title of the report of a token after a complete statement.
trailingTitle :: Region -> Token_ -> TokenContext -> Text
trailingTitle region token around = case signTitle region token around of
  Just title -> title
  Nothing -> "the statement is complete before " <> describe token

-- | Title of the report of a sign that another language uses.
signTitle :: Region -> Token_ -> TokenContext -> Maybe Text
signTitle region token around = case (token, map shape (before around), map shape (after around)) of
  (Symbol ",", Number a _ : _, Number b _ : _)
    | TokenFix.isDecimalComma token around ->
      Just
        ( "the number "
            <> digits a
            <> ","
            <> digits b
            <> " has a comma instead of a decimal point"
        )
  (Symbol "=", Symbol "=" : _, _) -> Just "‘==’ is no sign of the language: equality is one ‘=’"
  (Symbol "*", Symbol "*" : _, _) -> Just "‘**’ is no sign of the language: there are no powers"
  (Symbol "/", _, Symbol "/" : _) | or (take 1 (map attached (after around))) -> Just foreignComment
  (Symbol "/", Symbol "/" : _, _) -> Just foreignComment
  (Symbol "(", Word word : _, _)
    | TokenFix.isCallApart token region around ->
      Just ("there is a space between " <> quote word <> " and the bracket of its arguments")
  _ -> Nothing
  where
    foreignComment = "‘//’ begins no comment: a comment begins with ‘--’"

counted :: Int -> Text -> Text
counted n thing = Decimal.whole n <> " " <> thing <> (if n == 1 then "" else "s")

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
