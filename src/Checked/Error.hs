{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Mistakes in names, types and the order of statements, and their reports.
--
-- A form of a function is one list of parameters with which it can be called.
module Checked.Error
  ( Error (..),
    UndefinedOperation (..),
    StatementMove (..),
    LabelChange (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Name qualified as Name
import Base.Quantity (LengthUnit)
import Base.Region (Region (..))
import Checked.ArithmeticReport
import Checked.CallReport
import Checked.ErrorFix (WrittenTerm)
import Checked.ErrorFix qualified as ErrorFix
import Checked.ListError (listReport)
import Checked.NameMeaning qualified as NameMeaning
import Checked.PieceError (PieceError)
import Checked.PieceError qualified as PieceError
import Checked.ProgramSetting (ProgramSetting (..))
import Checked.ProgramSetting qualified as ProgramSetting
import Checked.Syntax (Operator (..))
import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Data.List (nub)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, isNothing)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at, quote)
import Surface.Token (Numeral, Unit)

-- | A mistake. The first field of every constructor but the last is the region that the report
-- points at. The comment of a constructor names the other fields in order.
data Error
  = -- | an unknown name: this name, all names and words that are known, for a suggestion, and the
    -- other regions of the name
    UndefinedName Region Name [Text] [Region]
  | -- | an unknown name before a value that is no element: the name, the value, the words for links
    UnknownLink Region Name Region [Text]
  | -- | a call of an unknown function: its name, and all names and words that are known
    UndefinedFunction Region Name [Text]
  | -- | a name that is defined below: the name, its definition, and the move that mends the mistake
    UsedBeforeDefinition Region Name Region (Maybe StatementMove)
  | -- | a name that is already defined: the name, the region of the first definition, the second
    -- definition, and the regions of its uses
    DefinedTwice Region Name Region WrittenTerm [Region]
  | -- | a sum of points: the regions of both, and the region of the half of the sum, if the program
    -- takes the half
    PointsAdded Region Region Region (Maybe Region)
  | -- | a point without its comma: the difference of its coordinates, the offset of the comma
    CommaMissing Region Int
  | -- | a feed whose unit the language does not have: its number, the unit of its length, the word
    -- after the stroke, and the speed of the spindle in turns per minute if the program gives it
    UnknownUnit Region Numeral Unit Text (Maybe Double)
  | -- | a cutting speed without the limit of the spindle's speed
    CuttingSpeedWithoutLimit Region
  | -- | a cutting speed whose number has no unit
    CuttingSpeedWithoutUnit Region
  | -- | the coordinates of a point without its brackets
    BareCoordinates Region
  | -- | a number with pi that is used as an angle without a unit
    RadiansWithoutUnit Region
  | -- | a definition of a name that belongs to the language: the name, facts about its definition,
    -- and the regions of its uses
    NameTaken Region Name WrittenTerm [Region]
  | -- | a term of the wrong type: the required type, the type of the term, the other regions at
    -- which these types were decided, each with the decided type, and facts about the term
    Mismatch Region Type Type [(Region, Type)] WrittenTerm
  | -- | lists among the items of a list, at its region: the type that the place of the list needs
    -- of each item; the lists with their types; an item that is no list; the first of the lists as
    -- it is written, and the fixes. The report points at the first of the lists
    ListAmongItems
      Region
      (Maybe Type)
      (NonEmpty (Region, Type))
      (Maybe (Region, Type))
      (Maybe Text)
      [Fix]
  | -- | a sum, a difference or a comparison whose operands do not fit: the operator, the left and
    -- the right operand, and the other regions at which their types were decided, each with the
    -- decided type. Then the facts about both operands; 'Nothing' if the operation is in the body
    -- of a function and the region is that of a call
    Disagree
      Region
      Operator
      (Region, Type)
      (Region, Type)
      [(Region, Type)]
      (Maybe (WrittenTerm, WrittenTerm))
  | -- | an operation that is not defined for its operands: the operation, and the operands
    NoOperation Region UndefinedOperation [(Region, Type)]
  | -- | a call with a wrong number of arguments: the function, its parameters, each with a value
    -- that could stand in its place, the regions of the arguments in the call,
    -- the commas that may be decimal commas, the fix of points without brackets, and the call as
    -- the program writes it
    ArgumentCount Region Name [(Text, Maybe Text)] [Region] [Region] [Fix] WrittenCall
  | -- | two arguments in the wrong order: the function, the arguments with their types, the right
    -- order as a call, the indices of the two arguments, and the other regions at which the types
    -- of the arguments were decided, each with the decided type
    Swapped Region Name [(Region, Type)] Text (Int, Int) [(Region, Type)]
  | -- | an argument that another call uses as another type, where either of the calls may have its
    -- arguments in the wrong order. The report points at the later one of both uses
    UsedAsBoth Region BothUses
  | -- | a call of a name that is no function: the name, the region of its definition unless it is
    -- built in, and the number of arguments
    NotAFunction Region Name (Maybe Region) Int
  | -- | the name of a function without the arguments that it needs: the name, and the forms of the
    -- function as calls. If the name is that of a divisor, also the end of the dividend
    FunctionAsValue Region Name [Text] (Maybe Int)
  | -- | a space between the name of a function and the bracket of its arguments: the name, and the
    -- space
    CallApart Region Name Region
  | -- | a number with a letter before it: the name, its digits, the words for the number
    NumberLetter Region Name Text Text
  | -- | numbers in place of vectors in one call: the function, the regions of the numbers, each
    -- with the name of its parameter, and the call with the names of all parameters
    NumberForVector Region Name [(Region, Text)] Text
  | -- | a circle as an element of a contour without the sense that it needs
    SenseMissing Region
  | -- | a sense before an element that is no circle: the type of the element
    SenseUnneeded Region Type
  | -- | an expression that cannot be an element of a contour: its type, and facts about it
    NotAnElement Region Type WrittenTerm
  | -- | a program that does not begin with @part@
    NoPart Region
  | -- | a setting of the whole program that occurs again: the setting, and the region of its first
    -- statement
    SettingTwice Region ProgramSetting Region
  | -- | a statement that needs settings above it which are missing: the keyword of the statement,
    -- the missing settings, and for each the region of a statement below that gives it. The report
    -- points at the keyword
    SettingsMissing Region Text (NonEmpty (ProgramSetting, Maybe Region))
  | -- | a name that is used in its own definition: the name
    Recursive Region Name
  | -- | arguments that fit no form of a built-in function: the function, the regions and types of
    -- the arguments, the forms of the function as calls, and arguments that alone do not fit a
    -- form, each with the type that would fit and its own. Then the words that lead to a form,
    -- the commas that may be decimal commas, and the fix of points without brackets
    NoForm Region Text [(Region, Type)] [Text] [(Region, Type, Type)] [LabelChange] [Region] [Fix]
  | -- | a call for which the number of arguments, or the words such as @near@ before them, belong
    -- to no form: the built-in function, its forms as calls, changes of one word that lead to a
    -- form. If there are no such words: the regions of the arguments, and the parameters of the
    -- form with the nearest number of parameters, each with a value that could stand in its place.
    -- Then the commas that may be decimal commas, and the fix of points without brackets
    NoSuchCall
      Region
      Text
      [Text]
      [LabelChange]
      (Maybe ([Region], [(Text, Maybe Text)]))
      [Region]
      [Fix]
  | -- | a statement that is not allowed in a block: the keyword of the statement, and its move to a
    -- place above the block
    NotInBlock Region Text StatementMove
  | -- | a setting that is not allowed in its statement: the setting, the keyword of the statement,
    -- and the settings that are allowed in this statement
    ForeignSetting Region Text Text [Text]
  | -- | a setting that occurs again in a block: the setting, and the region of an earlier
    -- occurrence
    RepeatedSetting Region Text Region
  | -- | a tolerance of an assertion that is no equality: the region between the condition and the
    -- end of the tolerance, and that between the operands of a comparison
    WithinWithoutEquality Region Region (Maybe Region)
  | -- | a mistake in a table or a piece
    InPiece PieceError
  deriving stock (Eq, Show)

-- | The move of a statement: its region, and the offset to which it goes.
data StatementMove = StatementMove Region Int
  deriving stock (Eq, Show)

-- | A change of the word before an argument: the region that is replaced, and the new text.
data LabelChange = LabelChange Region Text
  deriving stock (Eq, Ord, Show)

-- | The operation of a 'NoOperation' error.
data UndefinedOperation = UndefinedNegation | UndefinedProduct | UndefinedQuotient
  deriving stock (Eq, Show)

-- | The report of a mistake in a program with this unit of lengths.
toReport :: LengthUnit -> Error -> Report
toReport unit err = case err of
  UndefinedName region (Name name) known again ->
    (at region "E0201" ("nothing is named " <> quote name))
      { others = [Label r "here too" | r <- take 4 again],
        message =
          [ "It is used at " <> Decimal.whole (length again + 1) <> " places."
            | length again > 4
          ],
        fixes = ErrorFix.nameFixes (region : again) name known,
        hints = lookAlikeHint name known
      }
  UnknownLink region (Name name) next links ->
    (at region "E0201" ("nothing is named " <> quote name))
      { fixes = ErrorFix.linkFixes region name next links
      }
  UndefinedFunction region (Name name) known ->
    (at region "E0201" ("no function is named " <> quote name))
      { fixes = if null advised then ErrorFix.callFixes region name known else [],
        hints = if null advised then lookAlikeHint name known else advised
      }
    where
      advised = maybe [] pure (NameMeaning.advice name)
  UsedBeforeDefinition region (Name name) defined move ->
    (at region "E0202" (quote name <> " is used above its definition"))
      { others = [Label defined "it is defined here"],
        fixes =
          [ Fix.proposed (Fix.move "Move the definition above its first use." statement offset)
            | Just (StatementMove statement offset) <- [move]
          ],
        hints = ["Move the definition above its first use." | Nothing <- [move]]
      }
  CommaMissing region offset -> commaMissingReport region offset
  PointsAdded region left right half -> pointsAddedReport region left right half
  UnknownUnit region n u word speed -> unknownUnitReport region n u word speed
  CuttingSpeedWithoutLimit region -> cuttingSpeedReport region
  CuttingSpeedWithoutUnit region -> bareCuttingSpeedReport unit region
  BareCoordinates region -> bareCoordinatesReport region
  RadiansWithoutUnit region -> radiansReport region
  DefinedTwice region (Name name) before again uses ->
    (at region "E0203" (quote name <> " is defined twice"))
      { label = "defined again here",
        others = [Label before "first defined here"],
        fixes =
          [ Fix.proposed
              ( Fix.joined
                  ( "Name the second one " <> free
                      <> (if null uses then "." else ", here and where it is used below.")
                  )
                  [Fix.exchange "" r free | r <- region : uses]
              )
            | Just (_, free) <- [ErrorFix.freeName again]
          ]
            <> [ Fix.proposed (Fix.removal "Leave the second one out." whole)
                 | Just whole <- [ErrorFix.statement again]
               ]
      }
  NameTaken region (Name name) term uses ->
    (at region "E0204" (quote name <> " has a meaning in the language already"))
      { fixes =
          [ Fix.joined ("Name it " <> free <> ".") [Fix.exchange "" r free | r <- region : uses]
            | Just (_, free) <- [ErrorFix.freeName term]
          ]
      }
  Mismatch region expected found elsewhere term ->
    ( at
        region
        "E0205"
        ( ErrorFix.subject term
            <> " is "
            <> Type.describe found
            <> ", but "
            <> Type.describe expected
            <> " is needed here"
        )
    )
      { label = Type.describe found,
        others = decidedLabels (ErrorFix.definitions term) elsewhere,
        fixes = ErrorFix.mismatchFixes unit region expected found term,
        hints = mismatchHint expected found <> callHint term
      }
  ListAmongItems _ needed lists single written found ->
    listReport needed lists single written found
  Disagree region operator (leftRegion, left) (rightRegion, right) elsewhere terms ->
    ( at
        region
        "E0206"
        ( operands terms
            <> " cannot be "
            <> case operator of
              Add -> "added"
              Subtract -> "subtracted"
              _ -> "compared"
            <> ( if Type.describe left == Type.describe right
                   then ": each is " <> Type.describe left
                   else ": they are " <> Type.describe left <> " and " <> Type.describe right
               )
        )
    )
      { others =
          [Label leftRegion (Type.describe left), Label rightRegion (Type.describe right)]
            <> decidedLabels (maybe [] (ErrorFix.definitions . fst) terms) elsewhere,
        fixes =
          concat
            [ ErrorFix.disagreeFixes unit operator (leftRegion, left, a) (rightRegion, right, b)
              | Just (a, b) <- [terms]
            ],
        hints =
          [ "Compare their distance: distance(p, q) < 0.001"
            | operator `notElem` [Add, Subtract, Equal],
              Spatial _ <- [left],
              Spatial _ <- [right]
          ]
      }
  NoOperation region operation values ->
    ( at
        region
        "E0207"
        (operationTitle operation (map (Type.describe . snd) values))
    )
      { others = [Label r (Type.describe t) | (r, t) <- values],
        fixes = ErrorFix.measureFixes unit values
      }
  ArgumentCount region (Name name) wanted given commas points call ->
    argumentCountReport region name (map fst wanted) given call $
      if null points
        then ErrorFix.decimalFixes commas <> ErrorFix.argumentFixes wanted given
        else points
  Swapped region (Name name) given form order _ -> swappedReport region name given form order
  UsedAsBoth region uses -> bothReport region uses
  CallApart region (Name name) gap -> apartReport region name gap
  NumberLetter region (Name name) digits what -> numberLetterReport region name digits what
  NumberForVector region (Name name) numbers form -> vectorReport region name numbers form
  NotAFunction region (Name name) defined count ->
    (at region "E0209" (quote name <> " is a value, not a function"))
      { others = [Label r "defined here" | Just r <- [defined]],
        fixes =
          [ Fix.proposed (Fix.insertion "Write the product with *." (end region) " * ")
            | count == 1
          ]
      }
  FunctionAsValue region (Name name) known feed ->
    (at region "E0210" (quote name <> " is a function and needs its arguments"))
      { fixes =
          [ Fix.exchange
              "Write the unit of the feed without spaces."
              (Region from (start region))
              "/"
            | Just from <- [feed]
          ],
        hints = ["Write " <> Text.intercalate ", or " (take 3 known) <> "." | Nothing <- [feed]]
      }
  SenseMissing region ->
    (at region "E0211" "a circle in a contour needs a sense")
      { fixes =
          [ Fix.insertion "Write ccw before it: counter-clockwise." (start region) "ccw ",
            Fix.insertion "Write cw before it: clockwise." (start region) "cw "
          ]
      }
  SenseUnneeded region t ->
    (at region "E0212" ("cw and ccw belong before a circle, but this is " <> Type.describe t))
      { fixes = [Fix.removal "Leave the word out." region],
        hints = maybe [] pure (traversalHint t)
      }
  NotAnElement region t term ->
    ( at
        region
        "E0213"
        ( case ErrorFix.words term of
            Just written ->
              quote written <> ", " <> Type.describe t <> ", cannot be an element of a contour"
            Nothing -> Type.describe t <> " cannot be an element of a contour"
        )
    )
      { message =
          [ "A contour leads along lines, circles, curves and open contours, and through \
            \points."
          ],
        fixes = ErrorFix.curveFixes region term (ErrorFix.listFixes unit region t),
        hints =
          ["If two numbers are a point, write them in brackets: (40, 0)." | Quantity _ <- [t]]
            <> [ "Its contours are outlines_of(…) and holes_of(…), for example: \
                 \item_of(outlines_of(…), 1)."
                 | PlaneRegion <- [t]
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
    (at region "E0216" (ProgramSetting.description setting <> " is set twice"))
      { label = "set again here",
        others = [Label before "first set here"],
        fixes =
          [ Fix.proposed (Fix.removal "Leave the second one out." region),
            Fix.proposed (Fix.removal "Leave the first one out." before)
          ]
      }
  SettingsMissing region keyword missing ->
    ( at
        region
        "E0217"
        ( quote keyword
            <> " needs "
            <> ErrorFix.joinedWords
              (map (ProgramSetting.description . fst) (NonEmpty.toList missing))
            <> " above it"
        )
    )
      { label = "needed here",
        message =
          [ "Because of its depth, the tool comes down from the clearance height and rises to it \
            \again."
            | ClearanceSetting `elem` fmap fst missing
          ],
        fixes =
          [ Fix.proposed
              ( Fix.joined
                  "Move what is given below above this statement."
                  [Fix.move "" below (start region) | (_, Just below) <- NonEmpty.toList missing]
              )
            | all (isJust . snd) missing
          ],
        hints =
          [ "Write above it, for example: " <> Text.intercalate "; " examples
            | let absent = NonEmpty.filter (isNothing . snd) missing
                  examples = map (ProgramSetting.example . fst) absent,
              not (null absent)
          ]
      }
  NoForm region name given known misfits changes commas points ->
    ( at
        region
        "E0218"
        ( quote name
            <> if null points
              then " does not take " <> ErrorFix.joinedWords (map (Type.describe . snd) given)
              else " takes a point as (x, y), in brackets of its own"
        )
    )
      { others = [Label r (Type.describe t) | null points, (r, t) <- given],
        fixes =
          points
            <> ErrorFix.decimalFixes commas
            <> map changeFix (take 4 changes)
            <> nub
              [ fix
                | (r, wanted, found) <- misfits,
                  fix <- ErrorFix.mismatchFixes unit r wanted found ErrorFix.unwritten
              ],
        hints = if null points then ErrorFix.formsHint known else []
      }
  NoSuchCall region name known changes unlabelled commas points ->
    ( at
        region
        "E0219"
        ( case unlabelled of
            Just (given, _) -> quote name <> " does not take " <> arguments (length given)
            Nothing -> quote name <> " does not take these words before its arguments"
        )
    )
      { fixes =
          ErrorFix.decimalFixes commas
            <> map changeFix (take 4 changes)
            <> points
            <> concat
              [ ErrorFix.argumentFixes parameters given
                | null points,
                  Just (given, parameters) <- [unlabelled]
              ],
        hints = if null points then ErrorFix.formsHint known else []
      }
  NotInBlock region word (StatementMove statement offset) ->
    (at region "E0220" (quote word <> " applies to the whole program and cannot be in braces"))
      { fixes = [Fix.proposed (Fix.move "Move it above the braces." statement offset)]
      }
  ForeignSetting region setting statement known ->
    (at region "E0221" (quote statement <> " has no setting " <> quote setting))
      { message = ["It has: " <> Text.intercalate ", " known <> "."],
        fixes = [Fix.proposed (Fix.removal "Leave it out." region)],
        hints =
          [ "Write the depth of the holes before the braces: drill at P depth 10"
            | setting == "depth",
              statement == "drill"
          ]
      }
  RepeatedSetting region setting before ->
    (at region "E0222" (quote setting <> " is given twice"))
      { others = [Label before "first given here"],
        fixes =
          [ Fix.proposed (Fix.removal "Leave the second one out." region),
            Fix.proposed (Fix.removal "Leave the first one out." before)
          ]
      }
  InPiece e -> PieceError.toReport e
  WithinWithoutEquality region tolerance operator ->
    (at region "E0223" "‘within’ belongs after two values that are to be equal")
      { fixes =
          [Fix.proposed (Fix.removal "Leave the tolerance out." tolerance)]
            <> [ Fix.proposed (Fix.exchange "Compare with =." between " = ")
                 | Just between <- [operator]
               ]
      }
  Recursive region (Name name) ->
    (at region "E0214" (quote name <> " is used in its own definition"))
      { message =
          ["Every program must come to an end, so a definition uses only what is above it."],
        hints = ["Give a corrected value a name of its own."]
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

-- | The labels of a report on types that do not fit. They are at other regions than the report, at
-- which the use of a term decided one of these types. A pair contains such a region and the type.
-- The regions @made@ are those of calculations that define names.
decidedLabels :: [Region] -> [(Region, Type)] -> [Label]
decidedLabels made elsewhere =
  [ Label
      r
      ( Type.describe t
          <> (if r `elem` made then ", as defined here" else ", since it is used as one here")
      )
    | (r, t) <- elsewhere
  ]

-- | The operands of a sum or a comparison as the subject of a sentence.
operands :: Maybe (WrittenTerm, WrittenTerm) -> Text
operands terms = case terms of
  Just (a, b)
    | Just left <- ErrorFix.words a,
      Just right <- ErrorFix.words b ->
      quote left <> " and " <> quote right
  _ -> "these values"

-- | The title of the report of an operation that is not defined for operands, which are described.
operationTitle :: UndefinedOperation -> [Text] -> Text
operationTitle operation described = case (operation, described) of
  (UndefinedQuotient, [a, b]) -> a <> " cannot be divided by " <> b
  (UndefinedProduct, [a, b]) -> a <> " cannot be multiplied by " <> b
  (_, _) -> Text.intercalate " and " described <> " cannot have a minus sign"

mismatchHint :: Type -> Type -> [Text]
mismatchHint expected found
  | expected == found = []
  | Type.isSquare expected =
    ["The root is taken of a number, of an area, or of another product of two equal quantities."]
  | otherwise = []

-- | The hint that shows the call of which a term is an argument.
callHint :: WrittenTerm -> [Text]
callHint term = ["It is called as " <> form <> "." | Just form <- [ErrorFix.callForm term]]

-- | Names the letters of the other alphabet in a name that looks like a known one.
lookAlikeHint :: Text -> [Text] -> [Text]
lookAlikeHint name known =
  [ "In "
      <> quote name
      <> " the letter "
      <> quote (Text.singleton a)
      <> " is "
      <> (if a > '~' then "Cyrillic" else "Latin")
      <> "."
    | w <- take 1 (Name.lookAlike name known),
      (a, _) <- take 1 (filter (uncurry (/=)) (Text.zip name w))
  ]

-- | Fix that changes the word before an argument.
changeFix :: LabelChange -> Fix
changeFix (LabelChange r new) = Fix.proposed (Fix.exchange title r new)
  where
    title
      | Text.null new = "Leave this word out."
      | otherwise = "Write " <> Text.strip new <> " before this argument."
