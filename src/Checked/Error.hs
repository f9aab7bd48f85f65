{-# OPTIONS_GHC -O0 #-}

-- | Mistakes in names, types and the order of statements, and their reports.
--
-- A piece is a curve that is shifted by ciphers, as in the Minsk-22 system. A cipher is a digit, 1,
-- 2, 4 or 6, with values: the digit says by which rule the values give the distance of the shift.
--
-- A form of a function is one list of parameters with which it can be called.
module Checked.Error
  ( Error (..),
    RequiredSetting (..),
    UndefinedOperation (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Name qualified as Name
import Base.Region (Region (start))
import Checked.Syntax (Operator (..))
import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
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

-- | A mistake. The first field of every constructor is the region that the report points at. The
-- comment of a constructor names the other fields in order.
data Error
  = -- | an unknown name: this name, and all names and words that are known, for a suggestion
    UndefinedName Region Name [Text]
  | -- | a name that is defined only below: the name, and the region of the definition
    UsedBeforeDefinition Region Name Region
  | -- | a name that is already defined: the name, and the region of the first definition
    DefinedTwice Region Name Region
  | -- | a definition of a name that belongs to the language: the name
    NameTaken Region Name
  | -- | a term of the wrong type: the required type, the type of the term, and the other regions at
    -- which these types were decided, each with the decided type
    Mismatch Region Type Type [(Region, Type)]
  | -- | a sum, a difference or a comparison whose operands do not fit: the operator, the left and
    -- the right operand, and the other regions at which their types were decided, each with the
    -- decided type
    Disagree Region Operator (Region, Type) (Region, Type) [(Region, Type)]
  | -- | an operation that is not defined for its operands: the operation, and the operands
    NoOperation Region UndefinedOperation [(Region, Type)]
  | -- | a call with a wrong number of arguments: the function, its parameters, and the number of
    -- arguments in the call
    ArgumentCount Region Name [Text] Int
  | -- | a call of a name that is no function: the name, and the region of its definition unless it
    -- is built in
    NotAFunction Region Name (Maybe Region)
  | -- | the name of a function without the arguments that it needs: the name, and the forms of the
    -- function as calls
    FunctionAsValue Region Name [Text]
  | -- | a circle as an element of a contour without the sense that it needs
    SenseMissing Region
  | -- | a sense before an element that is no circle: the type of the element
    SenseUnneeded Region Type
  | -- | an expression that cannot be an element of a contour: its type
    NotAnElement Region Type
  | -- | a program that does not begin with @part@
    NoPart Region
  | -- | a setting of the whole program that occurs again: the setting, and the region of its first
    -- statement
    SettingTwice Region RequiredSetting Region
  | -- | a statement that needs settings above it which are missing: the missing settings. The
    -- report points at the keyword of the statement
    SettingsMissing Region (NonEmpty RequiredSetting)
  | -- | a name that is used in its own definition: the name
    Recursive Region Name
  | -- | arguments that fit no form of a built-in function: the function, the regions and types of
    -- the arguments, and the forms of the function as calls
    NoForm Region Text [(Region, Type)] [Text]
  | -- | a call for which the number of arguments, or the words such as @near@ before them, belong
    -- to no form: the built-in function, and its forms as calls
    NoSuchCall Region Text [Text]
  | -- | a statement that is not allowed in a block: the keyword of the statement
    NotInBlock Region Text
  | -- | a setting that is not allowed in its statement: the setting, the keyword of the statement,
    -- and the settings that are allowed in this statement
    ForeignSetting Region Text Text [Text]
  | -- | a setting that occurs again in a block: the setting, and the region of an earlier
    -- occurrence
    RepeatedSetting Region Text Region
  | -- | a tolerance of an assertion that is no equality
    WithinWithoutEquality Region
  | -- | a table whose first line does not name the columns
    HeadingsMissing Region
  | -- | headings below the first line of a table
    HeadingsRepeated Region
  | -- | a column whose name an earlier column has: the name, and the region of that column
    ColumnTwice Region Name Region
  | -- | a table without a column x or y: the name of the missing column
    ColumnMissing Region Name
  | -- | a row of the wrong length: the number of the row from 1, the number of columns, and the
    -- number of cells in the row
    RowLength Region Int Int Int
  | -- | an unknown cipher: the digit of the cipher
    NoSuchCipher Region Text
  | -- | a cipher with a wrong number of values: the digit of the cipher, and the number of its
    -- values
    CipherMisfit Region Text Int
  | -- | a name that is neither a column of the curve's table nor a name in scope, in an expression
    -- whose value may vary along the curve: the name, and the columns
    NoColumn Region Name [Text]
  | -- | the name of a column in an expression that must have one value for the whole piece: the
    -- digit of the cipher, and the column
    ColumnForWholePiece Region Text Name
  deriving stock (Eq, Show)

-- | The operation of a 'NoOperation' error.
data UndefinedOperation = UndefinedNegation | UndefinedProduct | UndefinedQuotient
  deriving stock (Eq, Show)

-- | A setting that a statement such as @tool@ makes. Other statements may need it above them.
data RequiredSetting
  = PartSetting
  | MachineSetting
  | ToolSetting
  | FeedSetting
  | ToleranceSetting
  | FromSetting
  | ClearanceSetting
  deriving stock (Eq, Ord, Show)

-- | The report of a mistake.
toReport :: Error -> Report
toReport err = case err of
  UndefinedName region (Name name) known ->
    (at region "E0201" ("nothing is named " <> quote name))
      { fixes =
          [ Fix.exchange ("Write " <> quote w <> ".") region w
            | w <- take 2 (Name.lookAlike name known <> Name.nearest name known)
          ],
        hints =
          [ "One of both names has a letter of the other alphabet, Cyrillic or Latin."
            | _ : _ <- [Name.lookAlike name known]
          ]
      }
  UsedBeforeDefinition region (Name name) defined ->
    (at region "E0202" (quote name <> " is used before it is defined"))
      { others = [Label defined "it is defined here"],
        hints = ["Move the definition above its first use."]
      }
  DefinedTwice region (Name name) before ->
    (at region "E0203" (quote name <> " is defined twice"))
      { label = "defined again here",
        others = [Label before "first defined here"],
        hints = ["Give one of them another name."]
      }
  NameTaken region (Name name) ->
    (at region "E0204" (quote name <> " already means something in the language"))
      { hints = ["Choose another name, for example " <> name <> "1."]
      }
  Mismatch region expected found elsewhere ->
    ( at
        region
        "E0205"
        ( "this is "
            <> Type.describe found
            <> ", but "
            <> Type.describe expected
            <> " is needed here"
        )
    )
      { label = Type.describe found,
        others = decidedLabels elsewhere,
        fixes = mismatchFixes region expected found,
        hints = mismatchHint expected found
      }
  Disagree region operator (leftRegion, left) (rightRegion, right) elsewhere ->
    ( at
        region
        "E0206"
        ( Type.describe left
            <> " and "
            <> Type.describe right
            <> " cannot be "
            <> (if operator `elem` [Add, Subtract] then "added or subtracted" else "compared")
        )
    )
      { others =
          [Label leftRegion (Type.describe left), Label rightRegion (Type.describe right)]
            <> decidedLabels elsewhere,
        hints =
          [ "Compare their distance: distance(p, q) < 0.001"
            | operator `notElem` [Add, Subtract],
              Spatial _ <- [left],
              Spatial _ <- [right]
          ]
      }
  NoOperation region operation operands ->
    ( at
        region
        "E0207"
        ( operationWords operation
            <> " is not defined for "
            <> Text.intercalate " and " (map (Type.describe . snd) operands)
        )
    )
      { others = [Label r (Type.describe t) | (r, t) <- operands]
      }
  ArgumentCount region (Name name) wanted given ->
    ( at
        region
        "E0208"
        ( quote name
            <> " takes "
            <> arguments (length wanted)
            <> ", but "
            <> Decimal.whole given
            <> (if given == 1 then " is" else " are")
            <> " given"
        )
    )
      { hints = ["Write " <> name <> "(" <> Text.intercalate ", " wanted <> ")."]
      }
  NotAFunction region (Name name) defined ->
    (at region "E0209" (quote name <> " is a value, not a function"))
      { others = [Label r "defined here" | Just r <- [defined]]
      }
  FunctionAsValue region (Name name) known ->
    (at region "E0210" (quote name <> " is a function and needs its arguments"))
      { hints =
          ["Write " <> Text.intercalate ", or " (take 3 known) <> "."]
            <> ["For a feed write mm/min without spaces." | name == "min"]
      }
  SenseMissing region ->
    (at region "E0211" "a circle in a contour needs a sense")
      { fixes =
          [ Fix.insertion "Write ccw before it: counter-clockwise." (start region) "ccw ",
            Fix.insertion "Write cw before it: clockwise." (start region) "cw "
          ]
      }
  SenseUnneeded region t ->
    (at region "E0212" ("cw and ccw stand before a circle, but this is " <> Type.describe t))
      { fixes = [Fix.removal "Leave the word out." region],
        hints = maybe [] pure (traversalHint t)
      }
  NotAnElement region t ->
    (at region "E0213" (Type.describe t <> " cannot be an element of a contour"))
      { message =
          [ "A contour leads along lines, circles, curves and open contours, and through \
            \points."
          ],
        hints =
          ["Put the items of a list into a contour with: for p in list { p }" | ListOf _ <- [t]]
            <> [ "Lay a curve through its points, for example spline(t) for a table t."
                 | Table _ <- [t]
               ]
      }
  NoPart region ->
    (at region "E0215" "the program does not begin with ‘part’")
      { fixes =
          [ Fix.proposed
              ( Fix.insertion
                  "Begin with the name of the part: part unnamed"
                  (start region)
                  "part unnamed\n"
              )
          ]
      }
  SettingTwice region setting before ->
    (at region "E0216" (settingWord setting <> " is set twice"))
      { label = "set again here",
        others = [Label before "first set here"],
        fixes = [Fix.proposed (Fix.removal "Leave the second one out." region)]
      }
  SettingsMissing region missing ->
    ( at
        region
        "E0217"
        ( joinedWords (NonEmpty.toList (fmap settingWord missing))
            <> (if length missing == 1 then " is" else " are")
            <> " not given"
        )
    )
      { label = "needed here",
        hints =
          [ "Say before it, for example: "
              <> Text.intercalate "; " (NonEmpty.toList (fmap example missing))
          ]
      }
  NoForm region name given known ->
    ( at
        region
        "E0218"
        (quote name <> " does not take " <> joinedWords (map (Type.describe . snd) given))
    )
      { others = [Label r (Type.describe t) | (r, t) <- given],
        hints = formsHint known
      }
  NoSuchCall region name known ->
    (at region "E0219" (quote name <> " is not called like this"))
      { hints = formsHint known
      }
  NotInBlock region word ->
    (at region "E0220" (quote word <> " does not belong in a block"))
      { hints = ["It holds for the whole program: move it above the block."]
      }
  ForeignSetting region setting statement known ->
    (at region "E0221" (quote statement <> " has no setting " <> quote setting))
      { message = ["It has: " <> Text.intercalate ", " known <> "."],
        fixes = [Fix.proposed (Fix.removal "Leave it out." region)],
        hints =
          [ "The depth of the holes stands before the braces: drill at P depth 10"
            | setting == "depth",
              statement == "drill"
          ]
      }
  RepeatedSetting region setting before ->
    (at region "E0222" (quote setting <> " is given twice"))
      { others = [Label before "first given here"]
      }
  HeadingsMissing region ->
    (at region "E0224" "the first line of a table names its columns")
      { hints = ["Write above the numbers, for example: x y mu deg H"]
      }
  HeadingsRepeated region ->
    (at region "E0224" "the columns of this table are named already")
      { hints =
          ["A row has a number for each column; a value in words stands in brackets: (2 * h)."]
      }
  ColumnTwice region (Name name) before ->
    (at region "E0225" ("the table has two columns " <> quote name))
      { others = [Label before "the first one"]
      }
  ColumnMissing region (Name name) ->
    (at region "E0225" ("the table has no column " <> quote name))
      { hints = ["Every table has columns x and y; others may follow."]
      }
  RowLength region number columns cells ->
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
          [ "A row stands on one line. A value that is no plain number stands in brackets: (2 \
            \* h)."
          ]
      }
  NoSuchCipher region digit ->
    (at region "E0227" ("there is no cipher " <> digit))
      { message =
          [ "This was control stop 14441 of the Minsk-22 system: the cipher is not provided \
            \for."
          ],
        hints =
          [ "One digit at a time: cipher "
              <> Text.intercalate ", " [Text.singleton d <> "(…)" | d <- Text.unpack digit]
            | isSeveralCiphers digit
          ]
            <> [ "The ciphers are 1 (a distance that changes uniformly), 2 (one distance), 4 \
                 \(bevel and height), 6 (a distance at each point)."
               ]
      }
  CipherMisfit region digit count ->
    (at region "E0228" ("cipher " <> digit <> " does not work with " <> counted count "value"))
      { message =
          [ "This was control stop 14623 of the Minsk-22 system: the piece has no data for \
            \the cipher."
          ],
        hints = ["Write " <> Text.intercalate ", or " (cipherForms digit) <> "."]
      }
  ColumnForWholePiece region digit (Name name) ->
    ( at
        region
        "E0228"
        ( "cipher "
            <> digit
            <> " takes one value here for the whole piece, and "
            <> quote name
            <> " is a column"
        )
    )
      { message =
          [ "This was control stop 14623 of the Minsk-22 system: the piece has no data for \
            \the cipher."
          ],
        hints = ["For a distance at each point write 6(" <> name <> ")." | digit == "2"]
      }
  NoColumn region (Name name) columns ->
    (at region "E0229" ("the curve has no column " <> quote name))
      { message =
          [ "This was control stop 14623 of the Minsk-22 system: the piece has no data for \
            \the cipher."
          ],
        fixes =
          [ Fix.exchange ("Write " <> quote w <> ".") region w
            | w <- take 1 (Name.nearest name columns)
          ],
        hints = case (Name.nearest name columns, columns) of
          (_ : _, _) -> []
          ([], []) ->
            [ "Only a curve through a table with more columns than x and y has values at its \
              \points; the first line of the table names them."
            ]
          ([], _) -> ["Its columns are " <> Text.intercalate ", " columns <> "."]
      }
  WithinWithoutEquality region ->
    (at region "E0223" "‘within’ needs two values that are to be equal")
      { hints = ["Write: assert a = b within d"]
      }
  Recursive region (Name name) ->
    (at region "E0214" (quote name <> " is used in its own definition"))
      { message =
          [ "Every program must come to an end, so a definition uses only what stands above \
            \it."
          ]
      }

-- | The hint that says in which direction a contour traverses an element of the type @t@. 'Nothing'
-- for types other than lines, curves and contours.
traversalHint :: Type -> Maybe Text
traversalHint t = case t of
  Line -> Just "A line is traversed from its first point to its second."
  Curve _ ->
    Just "A curve is traversed from its start to its end; for the reverse, write reversed(c)."
  Contour ->
    Just "A contour is traversed from its start to its end; for the reverse, write reversed(c)."
  _ -> Nothing

-- | Does a number such as @24@ consist of the digits of several ciphers, written as one word?
isSeveralCiphers :: Text -> Bool
isSeveralCiphers digit = Text.length digit > 1 && Text.all (`elem` ['1', '2', '4', '6']) digit

-- | The ways to write the cipher with the given digit, for hints.
cipherForms :: Text -> [Text]
cipherForms digit = case digit of
  "1" ->
    [ "1(from, to)",
      "1(from, to, mu)",
      "1(from, to, start_point, end_point)",
      "1(from, to, mu, start_point, end_point)"
    ]
  "2" -> ["2(distance)", "2(distance, mu)"]
  "4" -> ["4(mu, height)", "4(mu, height, allowance)"]
  _ -> ["6(distance)", "6(distance, mu)"]

counted :: Int -> Text -> Text
counted n thing = Decimal.whole n <> " " <> thing <> (if n == 1 then "" else "s")

at :: Region -> ReportCode -> Text -> Report
at region code = report Error code (InSource region)

arguments :: Int -> Text
arguments n = if n == 1 then "1 argument" else Decimal.whole n <> " arguments"

-- | The labels of a report on types that do not fit. They are at other regions than the report, at
-- which the use of a term decided one of these types. A pair contains such a region and the type.
decidedLabels :: [(Region, Type)] -> [Label]
decidedLabels elsewhere =
  [Label r (Type.describe t <> ", since it is used as one here") | (r, t) <- elsewhere]

-- | The word for an operation, with its article.
operationWords :: UndefinedOperation -> Text
operationWords operation = case operation of
  UndefinedNegation -> "a minus"
  UndefinedProduct -> "a product"
  UndefinedQuotient -> "a quotient"

mismatchHint :: Type -> Type -> [Text]
mismatchHint expected found
  | expected == found = []
  | Type.isSquare expected =
    ["The root is taken of a number, of an area, or of another product of two equal quantities."]
  | otherwise = []

-- | Fixes that give an expression the type that is needed.
mismatchFixes :: Region -> Type -> Type -> [Fix]
mismatchFixes region expected found = map Fix.proposed (wrapped region expected found)

wrapped :: Region -> Type -> Type -> [Fix]
wrapped region expected found
  | expected == Type.angle && found == Type.number =
    [ Fix.enclosure "Multiply the number by 1 deg, if it is in degrees." "(" region ") * 1 deg",
      Fix.enclosure "Multiply the number by 1 rad, if it is in radians." "(" region ") * 1 rad"
    ]
  | expected == Type.number && found == Type.angle =
    [Fix.enclosure "Divide the angle by 1 rad: a number of radians." "(" region ") / 1 rad"]
  | expected == Type.len && found == Type.number =
    [Fix.enclosure "Multiply the number by 1 mm." "(" region ") * 1 mm"]
  | expected == Type.number && found == Type.len =
    [Fix.enclosure "Divide the length by 1 mm." "(" region ") / 1 mm"]
  | Table _ <- found,
    expected == ListOf Type.aPoint =
    [Fix.enclosure "Take the points of the table." "points_of(" region ")"]
  | otherwise = []

settingWord :: RequiredSetting -> Text
settingWord setting = case setting of
  PartSetting -> "the name of the part"
  MachineSetting -> "the machine"
  ToolSetting -> "the tool"
  FeedSetting -> "the feed"
  ToleranceSetting -> "the tolerance"
  FromSetting -> "the starting point"
  ClearanceSetting -> "the clearance height"

example :: RequiredSetting -> Text
example setting = case setting of
  PartSetting -> "part NAME"
  MachineSetting -> "machine lkp-01f"
  ToolSetting -> "tool mill(diameter 20 mm)"
  FeedSetting -> "feed 60 mm/min"
  ToleranceSetting -> "tolerance 0.02 mm"
  FromSetting -> "from (0, 0)"
  ClearanceSetting -> "clearance 5 mm"

-- | The hint that shows how to call a function. It lists at most six of its forms.
formsHint :: [Text] -> [Text]
formsHint known = case known of
  [] -> []
  [one] -> ["Write " <> one <> "."]
  _ ->
    [ "Write one of: "
        <> Text.intercalate "; " (take 6 known)
        <> (if length known > 6 then "; …" else ".")
    ]

-- | Joins words to a list such as "a, b and c".
joinedWords :: [Text] -> Text
joinedWords words' = case reverse words' of
  [] -> ""
  [one] -> one
  final : before -> Text.intercalate ", " (reverse before) <> " and " <> final
