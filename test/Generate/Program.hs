-- | Random programs as syntax trees, and random layouts of their texts.
module Generate.Program
  ( program,
    respaced,
    constructors,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.NumberTable qualified as NumberTable
import Base.Quantity (LengthUnit (..))
import Base.Region (Located (..), Region (..))
import Data.Char (isAlphaNum)
import Data.List.NonEmpty (NonEmpty (..))
import Data.Maybe (fromMaybe)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.FileUnit qualified as FileUnit
import Surface.HoleForm qualified as HoleForm
import Surface.Keyword qualified as Keyword
import Surface.Lexer qualified as Lexer
import Surface.Syntax hiding (statements)
import Surface.Token (Token (..), Token_ (..), columnUnits)
import Test.QuickCheck

-- | A program without mistakes, as the parser could give it, except that all its regions are equal.
program :: Gen Program
program =
  sized $ \n ->
    (\ss -> FileUnit.program 0 ss [])
      <$> some' (min 8 (1 + n `div` 6)) (statement (min 4 (n `div` 12)))

here :: a -> Located a
here = Located (Region 0 0)

at :: Functor f => f a -> f (Located a)
at = fmap here

-- | A list of at most @most@ values.
some' :: Int -> Gen a -> Gen [a]
some' most one = choose (0, most) >>= \k -> vectorOf k one

-- | A list of one to @most + 1@ values.
nonEmpty :: Int -> Gen a -> Gen (NonEmpty a)
nonEmpty most one = (:|) <$> one <*> some' most one

maybe' :: Gen a -> Gen (Maybe a)
maybe' one = oneof [pure Nothing, Just <$> one]

every :: (Enum a, Bounded a) => Gen a
every = elements [minBound .. maxBound]

-- | A name. It may be a keyword that is not reserved.
name :: Gen Name
name = Name <$> frequency [(4, elements plainNames), (2, elements softWords), (1, made)]
  where
    made =
      (Text.pack <$> ((:) <$> elements "abхуz_" <*> listOf (elements "abхуz_019")))
        `suchThat` (not . Keyword.isReserved)

plainNames :: [Text]
plainNames =
  [ "a",
    "b",
    "p",
    "lug",
    "радиус",
    "Ёж",
    "x1",
    "_",
    "half_turn",
    "a_rather_long_name_for_a_thing"
  ]

-- | Keywords that are not reserved, and names that begin like a keyword.
softWords :: [Text]
softWords =
  [ "by",
    "at",
    "depth",
    "step",
    "diameter",
    "nose",
    "line",
    "arc",
    "out",
    "round",
    "sharp",
    "climb",
    "conventional",
    "start",
    "plunge",
    "peck",
    "ramp",
    "helix",
    "pitch",
    "spiral",
    "tabs",
    "tab",
    "width",
    "angle",
    "shortest",
    "corners",
    "compensation",
    "controller",
    "compiler",
    "lead",
    "cipher",
    "joggle",
    "radius",
    "cone",
    "vbit",
    "vcarve",
    "blade",
    "gear",
    "bevel1",
    "to",
    "rpm1",
    "min",
    "byte",
    "pocket",
    "islands",
    "rest",
    "allowed",
    "work",
    "program",
    "safe",
    "stop",
    "optional",
    "dwell",
    "spot",
    "ream",
    "countersink",
    "counterbore",
    "bore",
    "tap",
    "thread",
    "threadmill",
    "pitch",
    "angle",
    "chip",
    "break",
    "hand",
    "floating",
    "manual",
    "tip",
    "s",
    "units"
  ]

number :: Gen Numeral
number =
  numeral
    <$> frequency
      [ (3, whole),
        (2, (\a b -> a <> "." <> b) <$> whole <*> whole),
        (1, Text.pack <$> vectorOf 18 (choose ('0', '9')))
      ]
  where
    whole = Text.pack <$> (choose (1, 4) >>= \k -> vectorOf k (choose ('0', '9')))
    numeral digits = Numeral digits (fromMaybe 0 (Decimal.parse digits))

-- | A part of a drawing.
drawingReference :: Gen DrawingReference
drawingReference =
  DrawingReference
    <$> at ((<> ".dxf") <$> title)
    <*> maybe' (at (elements [OnLayer, WithIdentifier, WithClass] <*> title))
    <*> maybe' (at (elements [Millimetres, Inches]))
    <*> maybe' (at (Literal <$> number <*> maybe' every))

title :: Gen Text
title = Text.pack <$> listOf (elements "ab Фл-.,(){}'\t%0")

-- Statements

-- | A statement. The number bounds the nesting of its blocks and expressions; the functions below
-- have the same parameter.
statement :: Int -> Gen Statement
statement n = at (frequency ([(1, s) | s <- simple] <> [(3, s) | n > 0, s <- deep]))
  where
    simple =
      [ Part <$> at name <*> maybe' (at title),
        Units <$> every,
        Machine <$> at (oneof [Named <$> machine, Described <$> title]),
        Import <$> at title,
        Tool <$> maybe' toolNumber <*> cutter n,
        Feed <$> expr n,
        Tolerance <$> oneof [Within <$> expr n, Between <$> expr n <*> expr n],
        Clearance <$> expr n,
        From <$> expr n,
        WorkOffset <$> expr n,
        ProgramNumber <$> expr n,
        SafeHeight <$> expr n,
        Stock <$> expr n <*> maybe' ((,) <$> expr n <*> expr n),
        Avoid <$> expr n <*> maybe' ((,) <$> expr n <*> expr n),
        LetValue <$> at name <*> expr (n + 1),
        LetFunction <$> at name <*> nonEmpty 2 (at name) <*> expr (n + 1),
        Param <$> at name <*> expr n,
        Table <$> at name <*> (LinesFromFile <$> at title),
        Table <$> at name <*> (LinesFromDrawing <$> drawingReference),
        Drawn <$> elements [OneOutline, AllOutlines] <*> at name <*> drawingReference,
        DrawnText <$> at name <*> at ((<> ".ttf") <$> title) <*> lettering n <*> pure [],
        Curve <$> at name <*> expr (n + 1),
        Piece
          <$> at name
            <*> expr n
            <*> some' 3 (at cipher)
            <*> at (elements [LeftSide, RightSide])
            <*> some' 2 (at joggle),
        Assert <$> expr (n + 1) <*> maybe' (expr n),
        Drill <$> expr n <*> expr n <*> some' 3 (setting n),
        hole n,
        Travel <$> every <*> nonEmpty 3 (stop n),
        Change <$> expr n <*> cutter n <*> maybe' (expr n),
        Spindle
          <$> oneof
            [ pure SpindleStop,
              pure SpindleByHand,
              (\s v -> Spinning s v Nothing) <$> every <*> maybe' (expr n),
              (\s v l -> Spinning s (Just v) (Just l)) <$> every <*> expr n <*> expr n
            ],
        Coolant <$> every,
        Auxiliary <$> expr n,
        pure ProgramStop,
        pure OptionalStop,
        Dwell <$> expr n
      ]
    deep =
      [ Contour <$> at name <*> at every <*> some' 5 (item (n - 1)),
        Table
          <$> at name
            <*> ( WrittenLines
                    <$> ( (:)
                            <$> at (Header <$> nonEmpty 3 heading)
                              <*> some'
                                4
                                (at (oneof [Entries <$> nonEmpty 3 anyCell, Numbers <$> rows]))
                        )
                ),
        Mill <$> expr n <*> at every <*> some' 4 (setting n),
        Pocket <$> expr n <*> expr n <*> maybe' (at name) <*> some' 4 (setting n),
        RestOf <$> expr n <*> expr n <*> some' 4 (setting n),
        Face <$> expr n <*> expr n <*> some' 4 (setting n),
        Engrave <$> lettering n <*> some' 4 (setting n),
        Vcarve <$> expr n <*> maybe' (at name) <*> some' 4 (setting n),
        Turn <$> expr n <*> at every <*> some' 4 (setting n),
        Repeat <$> at name <*> expr n <*> inside,
        When <$> expr n <*> inside <*> inside,
        With <$> expr n <*> inside
      ]
    inside = some' 3 (statement (n - 1))
    anyCell = frequency [(4, ValueCell <$> cell), (1, TextCell <$> at title)]
    toolNumber = at (oneof [flip Literal Nothing <$> number, Variable <$> name])
    cipher =
      Cipher <$> at (number `suchThat` (not . Text.any (== '.') . digits)) <*> nonEmpty 3 (expr n)
    joggle = Joggle <$> expr n <*> expr n <*> expr n <*> expr n
    rows =
      chooseInt (1, 3) >>= \width ->
        NumberTable.fromList
          <$> listOf1
            ( (Region 0 0,) . PrimArray.primArrayFromList
                <$> vectorOf width ((/ 1000) . fromIntegral <$> chooseInt (-1000000, 1000000))
            )
    heading = Heading <$> at name <*> maybe' (elements columnUnits)
    cell =
      oneof
        [ at (Literal <$> number <*> maybe' every),
          at (Negate <$> at (Literal <$> number <*> maybe' every)),
          expr (n + 1)
        ]

-- | A text that is cut.
lettering :: Int -> Gen Lettering
lettering n =
  Lettering
    <$> at title <*> expr n <*> expr n
      <*> oneof
        [ pure Level,
          Inclined <$> expr n,
          Around <$> expr n <*> maybe' (at (elements [Inside, Outside]))
        ]
      <*> maybe' every

-- | A work on holes with the sizes of one of its forms.
hole :: Int -> Gen Statement_
hole n = do
  work <- every
  sizes <- elements (HoleForm.sizeForms work) >>= traverse (\s -> (s,) <$> expr n)
  side <- if work == Threading then Just <$> at (elements [Inside, Outside]) else pure Nothing
  (\points -> Hole work points sizes side) <$> expr n <*> some' 3 (setting n)

machine :: Gen Text
machine =
  oneof
    [ pure "lkp-01f",
      (Text.pack <$> listOf1 (elements "abж.-079")) `suchThat` (not . Text.isInfixOf "--")
    ]

cutter :: Int -> Gen Cutter
cutter n =
  at
    ( oneof
        [ MillCutter <$> expr n <*> some' 3 (at (bodySize n)),
          DrillCutter
            <$> expr n
              <*> some' 3 (at (frequency [(3, bodySize n), (1, PointAngle <$> expr n)])),
          TapCutter <$> expr n <*> some' 3 (at (bodySize n)),
          ThreadMillCutter <$> expr n <*> expr n <*> some' 3 (at (bodySize n)),
          TurningCutter <$> expr n <*> maybe' (expr n),
          ConeCutter <$> expr n <*> expr n <*> expr n,
          VBitCutter <$> expr n <*> expr n <*> expr n,
          BladeCutter <$> expr n <*> expr n
        ]
    )

bodySize :: Int -> Gen BodySize_
bodySize n =
  oneof
    [Flutes <$> expr n, StickOut <$> expr n, HolderCylinder <$> expr n <*> maybe' (expr n)]

stop :: Int -> Gen Stop
stop n = Stop <$> expr n <*> oneof [pure Cutting, pure Rapid, AtFeed <$> expr n]

item :: Int -> Gen Item
item n = at (frequency ((6, element) : [(1, i) | n > 0, i <- deep]))
  where
    element =
      Element <$> maybe' (at every) <*> expr (n + 1) <*> some' 2 (at modifier) <*> maybe' (at link)
    modifier =
      oneof [ElementFeed <$> expr n, pure Slow, ElementAllowance <$> expr n, Bevel <$> expr n]
    link =
      oneof
        [Meet <$> maybe' (expr n), pure Smooth, pure Tangent, Fillet <$> expr n, Chamfer <$> expr n]
    deep = [For <$> at name <*> expr n <*> inside, Choose <$> expr n <*> inside <*> inside]
    inside = some' 3 (item (n - 1))

setting :: Int -> Gen Setting
setting n =
  at . oneof $
    [ Approach <$> nonEmpty 3 (stop n),
      Retract <$> nonEmpty 3 (stop n),
      Depth <$> expr n <*> maybe' (expr n),
      LeadBy <$> every <*> every <*> expr n,
      Allowances <$> nonEmpty 3 (expr n),
      CornerStyle <$> every,
      CutBy <$> every,
      CompensationBy <$> every,
      StartNear <$> expr n,
      Plunge <$> expr n,
      Ramp <$> expr n,
      Helix <$> expr n <*> maybe' (expr n),
      pure Spiral,
      Tabs . TabCount <$> expr n <*> expr n <*> expr n <*> maybe' (expr n),
      Tabs . TabsAt <$> nonEmpty 3 (expr n) <*> expr n <*> expr n <*> maybe' (expr n),
      Peck <$> expr n,
      pure ShortestWay,
      Angle <$> expr n,
      ChipBreak <$> expr n,
      Pause <$> expr n,
      TurnPitch <$> expr n,
      Hand <$> elements [LeftSide, RightSide],
      pure Floating,
      Islands <$> nonEmpty 3 (expr n),
      pure RestAllowed
    ]

-- Expressions

expr :: Int -> Gen Expr
expr n =
  at
    ( frequency
        ( [(if n > 0 then 1 else 4, leaf) | leaf <- leaves]
            <> [(1, e) | n > 0, e <- deep]
            <> [(4, e) | n > 0, e <- binary]
        )
    )
  where
    leaves = [Literal <$> number <*> maybe' every, Variable <$> name]
    less = expr (n - 1)
    binary = [Binary <$> every <*> less <*> less]
    deep =
      [ Call <$> at name <*> nonEmpty 3 argument,
        Negate <$> less,
        Not <$> less,
        Range <$> less <*> less <*> maybe' less,
        If <$> less <*> less <*> less,
        Pair <$> less <*> less,
        Triple <$> less <*> less <*> less,
        List <$> some' 12 less,
        Each <$> less <*> at name <*> less
      ]
    argument =
      frequency [(3, Given <$> less), (1, Chosen <$> at every <*> less), (1, Ranked <$> at every)]

-- Layouts

-- | A program text with the same tokens and random comments, blank lines, indentation and line
-- breaks, where they have no meaning.
respaced :: Text -> Gen Text
respaced text = do
  end' <- elements ["\n", "\r\n", "\r"]
  mark <- elements ["", "\xFEFF"]
  before <- Text.concat <$> ownLines
  spacedTokens <-
    traverse spaced (zip3 (inTables tokens) tokens (map Just (drop 1 tokens) <> [Nothing]))
  pure (mark <> Text.replace "\n" end' (before <> Text.concat spacedTokens))
  where
    tokens = fst (Lexer.tokens 0 text)
    spaced (inTable, t, next) =
      (written text t <>) <$> maybe newLines (if inTable then inLine t else between t) next

-- | Tells for each token if it is inside the braces of a table, where line breaks have a meaning.
inTables :: [Token] -> [Bool]
inTables = go False
  where
    go inside tokens = case tokens of
      a : _ : c : rest
        | not inside && newLine a && map shape [a, c] == [Word "table", Symbol "{"] ->
          False : False : True : go True rest
      t : rest | inside && shape t == Symbol "}" -> False : go False rest
      _ : rest -> inside : go inside rest
      [] -> []

-- | Random white space between two tokens of a table.
inLine :: Token -> Token -> Gen Text
inLine _ u
  | newLine u = (<> "  ") <$> newLines
  | otherwise = pure (if attached u then "" else " ")

-- | Random white space between two tokens outside of tables.
between :: Token -> Token -> Gen Text
between t u
  | newLine u && begins u = (<>) <$> newLines <*> indentation
  | newLine u = oneof [(<>) <$> newLines <*> indentation, pure " "]
  | glued t u = pure (if attached u then "" else " ")
  | attached u && shape t /= Symbol "-" =
    frequency [(8, pure ""), (1, pure " "), (1, (<>) <$> newLines <*> indentation)]
  | any (\x -> shape x `elem` map Symbol [",", "+", "*", "=", "<="]) [t, u]
      && shape u `notElem` [Symbol "-", Symbol "("] =
    frequency [(6, pure " "), (2, pure ""), (1, (<>) <$> newLines <*> indentation)]
  | otherwise = frequency [(8, pure " "), (1, (<>) <$> newLines <*> indentation)]
  where
    indentation = elements ["", "  ", "\t", "        "]

-- | A line end, sometimes after a comment, and sometimes blank lines and comment lines after it.
newLines :: Gen Text
newLines = do
  ending <- frequency [(3, pure ""), (2, elements ["  ", " -- behind", " --", "\t-- ещё один  "])]
  more <- frequency [(3, pure []), (1, ownLines)]
  pure (ending <> "\n" <> Text.concat more)

-- | Blank lines and comment lines.
ownLines :: Gen [Text]
ownLines = some' 4 (elements ["\n", "   \n", "-- own line\n", "    -- own, set in\n", "--x\n"])

-- | A token as it is written in a text.
written :: Text -> Token -> Text
written text t = Text.take (end (place t) - start (place t)) (Text.drop (start (place t)) text)

-- | Tells if a token may begin a statement, so that its line break must be kept.
begins :: Token -> Bool
begins t = case shape t of
  Word word -> word `elem` Keyword.statements <> Keyword.softStatements <> Keyword.blocks
  _ -> False

-- | Tells if the white space between two tokens must be kept.
glued :: Token -> Token -> Bool
glued t u = case (shape t, shape u) of
  (Word _, Symbol "(") -> True
  (Word word, _) | word `elem` ["machine", "cw", "ccw"] -> True
  (_, Text _) -> True
  (_, Word word) -> word `elem` ["rapid", "feed"]
  (_, Symbol "{") -> True
  _ -> False

-- Constructors

-- | The names of all constructors in the syntax tree of a program.
constructors :: Program -> Set Text
constructors =
  Set.fromList
    . filter capital
    . Text.split (\c -> not (isAlphaNum c || c == '\'' || c == '_'))
    . unquoted
    . Text.pack
    . show
  where
    capital word = Text.any (`elem` ['A' .. 'Z']) (Text.take 1 word)
    -- Words between quotation marks are not constructors.
    unquoted text = Text.concat (evens (Text.splitOn "\"" text))
    evens ts = case ts of
      a : _ : rest -> a : evens rest
      [a] -> [a]
      [] -> []
