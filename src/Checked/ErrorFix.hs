{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Fixes of mistakes in names and types.
module Checked.ErrorFix
  ( WrittenTerm (..),
    unwritten,
    subject,
    nameFixes,
    linkFixes,
    callFixes,
    mismatchFixes,
    disagreeFixes,
    measureFixes,
    placeholder,
    argumentFixes,
    decimalFixes,
    listFixes,
    curveFixes,
    cipherFixes,
    formsHint,
    joinedWords,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name qualified as Name
import Base.Quantity (LengthUnit)
import Base.Region (Region (..))
import Checked.NameMeaning qualified as NameMeaning
import Checked.Syntax (Operator (..))
import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Data.Char (isDigit)
import Data.Containers.ListUtils (nubOrd)
import Data.Maybe (isJust, listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix (..), FixEdit (..), FixText (..))
import Report.Fix qualified as Fix
import Report.Report (quote)
import Surface.Token (Unit (..))
import Prelude hiding (words)

-- | Facts about a term from the text of the program.
data WrittenTerm = WrittenTerm
  { -- | the digits and the unit of a term that is a number with a unit
    literal :: Maybe (Text, Unit),
    -- | the region of the statement that contains the term
    statement :: Maybe Region,
    -- | a name that the program does not use, made from the name that the term is
    freeName :: Maybe (Text, Text),
    -- | the term as it is written, if it is a number or a name
    words :: Maybe Text,
    -- | true of a call of a function of the program, in whose body the mistake may be
    isOwnCall :: Bool,
    -- | true of a list of two or three items
    isPairList :: Bool,
    -- | the call of which the term is an argument, with the names of its parameters
    callForm :: Maybe Text,
    -- | the name of the curve through the points of a table that the term names
    curve :: Maybe Text,
    -- | the sense in which a contour of the term would be milled: @cw@ or @ccw@
    sense :: Text,
    -- | the regions of the calculations that define names of the program
    definitions :: [Region]
  }
  deriving stock (Eq, Show)

-- | A term of which nothing is known but its region.
unwritten :: WrittenTerm
unwritten =
  WrittenTerm
    { literal = Nothing,
      statement = Nothing,
      freeName = Nothing,
      words = Nothing,
      isOwnCall = False,
      isPairList = False,
      callForm = Nothing,
      curve = Nothing,
      sense = "ccw",
      definitions = []
    }

-- | A term as the subject of a sentence: as it is written, or "this".
subject :: WrittenTerm -> Text
subject = maybe "this" quote . words

-- Names

-- | Fixes of an unknown name at some regions; @known@ has the names and words that are known.
nameFixes :: [Region] -> Text -> [Text] -> [Fix]
nameFixes regions name known
  | [one] <- meant = [put one]
  | not (null meant) = map (Fix.proposed . put) (take 3 meant)
  | not (null similar) = map put (take 2 similar)
  | Just new <- computed name = [put new]
  | otherwise = []
  where
    put new =
      Fix.joined
        ("Write " <> quote new <> (if length regions > 1 then " at all these places." else "."))
        [Fix.exchange "" region new | region <- regions]
    similar =
      nubOrd (Name.lookAlike name known <> Name.nearest name known)
    meant = filter (`elem` known) (nubOrd (NameMeaning.meanings name <> longer))
    longer = [name <> ending | ending <- ["_of", "d", "ed"]]
    computed text = case Text.uncons text of
      Just (letter, digits)
        | not (Text.null digits),
          Text.all isDigit digits ->
          if letter `elem` ("RrРр" :: String)
            then Just digits
            else if letter `elem` ("ØøDdФф" :: String) then Just (digits <> " / 2") else Nothing
      _ -> case Text.stripSuffix "²" text of
        Just base | base `elem` known -> Just (base <> " * " <> base)
        _ -> Nothing

-- | Fixes of an unknown name before a value in a contour: the word of a link instead of it, or
-- nothing.
linkFixes :: Region -> Text -> Region -> [Text] -> [Fix]
linkFixes region name next links
  | w : _ <- nubOrd (NameMeaning.linksMeant name <> Name.nearest name links),
    w `elem` links =
    [Fix.exchange ("Write " <> quote w <> " instead of " <> quote name <> ".") region w]
  | Text.toLower name `elem` ["x", "х", "by", "at"] =
    [ Fix.removal
        ("Leave this out, from " <> quote name <> " on: a chamfer has one length.")
        (Region (start region) (end next))
    ]
  | null links =
    [Fix.removal ("Leave " <> quote name <> " out.") (Region (start region) (start next))]
  | otherwise = []

-- | Fixes of an unknown function.
callFixes :: Region -> Text -> [Text] -> [Fix]
callFixes region name known
  | Text.toLower name `elem` ["point", "vector", "pt", "p", "vec", "xy"] =
    [ Fix.proposed
        (Fix.removal ("Leave " <> quote name <> " out: a point is written (x, y).") region)
    ]
  | otherwise = nameFixes [region] name known

-- Types

-- | Fixes that give a term the type that is needed. @fileUnit@ is the unit of lengths of the
-- program.
mismatchFixes :: LengthUnit -> Region -> Type -> Type -> WrittenTerm -> [Fix]
mismatchFixes fileUnit region wanted found term = case literal term of
  Just (digits, unit)
    | Just new <- unitFor fileUnit wanted unit ->
      let fix = Fix.exchange ("Write " <> written digits new <> ".") region (written digits new)
       in [if isSpeed wanted && found == Type.len then fix else Fix.proposed fix]
  _
    | isOwnCall term -> []
    | otherwise -> contourFixes <> enclosed region (conversions fileUnit wanted found)
  where
    written digits unit = Text.strip (digits <> " " <> unit)
    isSpeed t = t == Type.feed
    contourFixes = case (wanted, found, statement term, freeName term) of
      (Spatial _, ListOf _, _, _)
        | isPairList term ->
          [ Fix.joined
              "Write the point in round brackets."
              [ Fix.exchange "" (Region (start region) (start region + 1)) "(",
                Fix.exchange "" (Region (end region - 1) (end region)) ")"
              ]
          ]
      (Contour, Circle, Just whole, Just names) -> [circleFix region whole names (sense term)]
      _ -> []

-- | The fix that makes a contour of the circle at a region, above the statement that takes it. It
-- has the circle as it is written, a free name for the contour, and the sense.
circleFix :: Region -> Region -> (Text, Text) -> Text -> Fix
circleFix region whole (name, free) turn =
  Fix.proposed
    Fix
      { title =
          "Write above this statement: " <> before <> name <> " }, and write " <> quote free
            <> " here.",
        isProposal = True,
        edits =
          [ FixEdit
              (Region (start whole) (start whole))
              [Written before, Copied region, Written " }\n"],
            FixEdit region [Written free]
          ]
      }
  where
    before = "contour " <> free <> " closed { " <> turn <> " "

-- | The unit of a type, if a number with the given unit can have it instead.
unitFor :: LengthUnit -> Type -> Unit -> Maybe Text
unitFor fileUnit wanted unit
  | wanted == Type.number = Just ""
  | wanted == Type.feed = Just $ case unit of
    Inch -> "in/min"
    Metre -> "m/min"
    _ -> Decimal.unitText fileUnit <> "/min"
  | wanted == Type.len = Just $ case unit of
    InPerMin -> "in"
    FtPerMin -> "in"
    MPerMin -> "m"
    _ -> Decimal.unitText fileUnit
  | otherwise = unitOf fileUnit wanted

-- | The name of the unit in which numbers of a type are usually written. 'Nothing' for other types
-- than lengths, angles, feeds and speeds of rotation.
unitOf :: LengthUnit -> Type -> Maybe Text
unitOf fileUnit t =
  lookup
    True
    [ (t == Type.len, Decimal.unitText fileUnit),
      (t == Type.angle, "deg"),
      (t == Type.feed, Decimal.unitText fileUnit <> "/min"),
      (t == Type.spindleSpeed, "rpm")
    ]

enclosed :: Region -> [(Text, Text, Text)] -> [Fix]
enclosed region cs =
  [Fix.proposed (Fix.enclosure title' before region after) | (title', before, after) <- cs]

-- | Conversions of a term to the type @wanted@: the title of a fix, and the texts before and after
-- the term.
conversions :: LengthUnit -> Type -> Type -> [(Text, Text, Text)]
conversions fileUnit wanted found = case (wanted, found) of
  _
    | wanted == Type.angle && found == Type.number ->
      [ times "deg" "Multiply the number by 1 deg, if it is in degrees.",
        times "rad" "Multiply the number by 1 rad, if it is in radians."
      ]
  _
    | wanted == Type.number && found == Type.angle ->
      [("Divide the angle by 1 rad: a number of radians.", "(", ") / 1 rad")]
  (Quantity _, Quantity _)
    | wanted == Type.number,
      Just u <- unitOf fileUnit found ->
      [("Divide by 1 " <> u <> ".", "(", ") / 1 " <> u)]
    | found == Type.number,
      Just u <- unitOf fileUnit wanted ->
      [times u ("Multiply the number by 1 " <> u <> ".")]
    | Just u <- unitOf fileUnit found,
      Just v <- unitOf fileUnit wanted ->
      [ ( "Take the number of " <> u <> " for a number of " <> v <> ".",
          "(",
          ") / 1 " <> u <> " * 1 " <> v
        )
      ]
  (Spatial _, Circle) | wanted == Type.aPoint -> [call "Take the centre of the circle." "centre_of"]
  (Spatial _, Spatial _)
    | wanted == Type.aVector && found == Type.aPoint ->
      [("Take the vector from (0, 0) to the point.", "(", " - (0, 0))")]
    | wanted == Type.aPoint && found == Type.aVector ->
      [("Take the point to which the vector leads from (0, 0).", "((0, 0) + ", ")")]
  (Quantity _, Circle) | wanted == Type.len -> [call "Take the radius of the circle." "radius_of"]
  (Quantity _, Line)
    | wanted == Type.len -> [call "Take the length of the line." "length_of"]
    | wanted == Type.angle -> [call "Take the direction of the line." "direction_of"]
  (Quantity _, Contour) | wanted == Type.len -> [call "Take the length of the contour." "length_of"]
  (Quantity _, Curve _) | wanted == Type.len -> [call "Take the length of the curve." "length_of"]
  (Curve _, Table _) -> [call "Lay a spline through the points of the table." "spline"]
  (Curve _, ListOf (Spatial _)) -> [call "Lay a spline through the points." "spline"]
  (ListOf item, Table _)
    | item == Type.aPoint || isUnknown item -> [call "Take the points of the table." "points_of"]
  (ListOf (Spatial _), Spatial _) -> [("Write a list of one point.", "[", "]")]
  (ListOf item, _)
    | item == found -> [("Write a list of one item.", "[", "]")]
  _ -> []
  where
    isUnknown t = case t of
      Variable _ -> True
      _ -> False
    call title' name = (title', name <> "(", ")")
    times u title' = (title', "(", ") * 1 " <> u)

-- | Fixes of a sum, a difference or a comparison of two terms that do not fit.
disagreeFixes ::
  LengthUnit ->
  Operator ->
  (Region, Type, WrittenTerm) ->
  (Region, Type, WrittenTerm) ->
  [Fix]
disagreeFixes fileUnit operator (leftRegion, left, leftTerm) (rightRegion, right, rightTerm) =
  case (left, right) of
    (Spatial _, Spatial _)
      | operator == Equal ->
        [ Fix.joined
            "Compare the distance of the points with 0."
            [ Fix.insertion "" (start leftRegion) "distance(",
              Fix.exchange "" between ", ",
              Fix.insertion "" (end rightRegion) ") = 0"
            ]
        ]
    (Spatial _, Quantity _) | isSum && right == Type.len -> vectors rightRegion
    (Quantity _, Spatial _) | isSum && left == Type.len -> vectors leftRegion
    _ ->
      concatMap
        (take 1)
        [ mismatchFixes fileUnit rightRegion left right rightTerm,
          mismatchFixes fileUnit leftRegion right left leftTerm
        ]
  where
    isSum = operator `elem` [Add, Subtract]
    between = Region (end leftRegion) (start rightRegion)
    vectors region =
      enclosed
        region
        [ ("Write the vector along x.", "(", ", 0)"),
          ("Write the vector along y.", "(0, ", ")")
        ]

-- | Fixes that calculate with a measure of every operand that is no quantity.
measureFixes :: LengthUnit -> [(Region, Type)] -> [Fix]
measureFixes fileUnit operands = case filter (isJust . measure . snd) operands of
  [] -> []
  measured ->
    [ Fix.proposed
        ( Fix.joined
            ( Text.unwords
                ( take
                    1
                    [ title' | (_, t) <- measured, Just (title', _, _) <- [measure t]
                    ]
                )
            )
            [ Fix.enclosure "" before region after
              | (region, t) <- measured,
                Just (_, before, after) <- [measure t]
            ]
        )
    ]
  where
    measure t = listToMaybe $ case t of
      Spatial _ | t == Type.aPoint -> conversions fileUnit Type.aVector t
      Quantity _ -> []
      _ -> conversions fileUnit Type.len t

-- Calls

-- | A value that can stand in a program until the right one is known; 'Nothing' for types that
-- have none. Lengths and numbers have none, because radii and counts cannot be zero.
placeholder :: Type -> Maybe Text
placeholder t = case t of
  Quantity _ | t == Type.angle -> Just "0"
  Spatial _ -> Just "(0, 0)"
  _ -> Nothing

-- | Fixes of a call with too few or too many arguments: the parameters with their placeholders, and
-- the regions of the arguments.
argumentFixes :: [(Text, Maybe Text)] -> [Region] -> [Fix]
argumentFixes parameters given
  | (_ : _) <- missing,
    Just values <- traverse snd missing,
    lastGiven : _ <- reverse given =
    [ Fix.proposed
        ( Fix.insertion
            ( "Write "
                <> Text.intercalate ", " values
                <> " for "
                <> Text.intercalate ", " (map fst missing)
                <> ", and put the right value there."
            )
            (end lastGiven)
            (Text.concat (map (", " <>) values))
        )
    ]
  | kept : _ <- reverse (take count given),
    surplus : _ <- reverse (drop count given) =
    [Fix.proposed (Fix.removal "Leave out what is too much." (Region (end kept) (end surplus)))]
  | otherwise = []
  where
    count = length parameters
    missing = drop (length given) parameters

-- | Fixes of commas that may be decimal commas.
decimalFixes :: [Region] -> [Fix]
decimalFixes commas =
  [ Fix.proposed
      (Fix.joined "Write a decimal point." [Fix.exchange "" comma "." | comma <- commas])
    | not (null commas)
  ]

-- | Fixes that take the curve through a table instead of the table, or else other ones.
curveFixes :: Region -> WrittenTerm -> [Fix] -> [Fix]
curveFixes region term others = case (curve term, words term) of
  (Just name, Just table) ->
    [Fix.exchange ("Write " <> name <> ", the curve through " <> table <> ".") region name]
  _ -> others

-- | Fixes that make elements of a contour of the items of a list, or of a table.
listFixes :: LengthUnit -> Region -> Type -> [Fix]
listFixes fileUnit region t = case t of
  ListOf Circle -> [each "ccw ", each "cw "]
  ListOf item | isElement item -> [each ""]
  Table _ -> enclosed region (conversions fileUnit (Curve t) t)
  _ -> []
  where
    each sense =
      Fix.proposed $
        Fix.enclosure
          ( "Take the items of the list one after another"
              <> (if Text.null sense then "." else ": " <> sense)
          )
          "for item in "
          region
          (" { " <> sense <> "item }")
    isElement item = case item of
      Spatial _ -> True
      Line -> True
      Contour -> True
      Curve _ -> True
      _ -> False

-- | Fixes of a cipher: its digit and the region of the digit, the regions of its values, and the
-- numbers of values that it can have.
cipherFixes :: Region -> Text -> Region -> [Region] -> [Int] -> [Fix]
cipherFixes region digit digitRegion values counts
  | Text.length digit > 1 = several
  | digit == "1", length values == 1 = [digitFix "2", digitFix "6"]
  | most : _ <- reverse (filter (< length values) counts),
    kept : _ <- reverse (take most values),
    surplus : _ <- reverse values =
    [Fix.proposed (Fix.removal "Leave out what is too much." (Region (end kept) (end surplus)))]
  | otherwise = []
  where
    digitFix d = Fix.proposed (Fix.exchange ("Write cipher " <> d <> ".") digitRegion d)
    several =
      [ Fix
          { title = "Write one cipher after the other.",
            isProposal = False,
            edits = [FixEdit region (separate (Text.unpack digit) values)]
          }
        | sum (map least (Text.unpack digit)) == length values
      ]
    least d = if d `elem` ['1', '4'] then 2 else 1
    separate ds rs = case ds of
      [] -> []
      d : more ->
        let (own, others) = splitAt (least d) rs
         in Written (Text.singleton d <> "(") :
            commas [Copied r | r <- own]
              <> [Written (if null more then ")" else "), ")]
              <> separate more others
    commas parts' = case parts' of
      a : more@(_ : _) -> a : Written ", " : commas more
      _ -> parts'

-- Words

-- | The hint that shows how to call a function. It lists at most four of its forms.
formsHint :: [Text] -> [Text]
formsHint known = case nubOrd known of
  [] -> []
  [one] -> ["Write " <> one <> "."]
  several ->
    ["Write one of: " <> Text.intercalate "; " (take 4 several) <> "."]

-- | Joins words to a list such as "a, b and c".
joinedWords :: [Text] -> Text
joinedWords words' = case reverse words' of
  [] -> ""
  [one] -> one
  final : before -> Text.intercalate ", " (reverse before) <> " and " <> final
