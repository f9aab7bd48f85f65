-- | The printer of programs: the canonical layout of a syntax tree without comments.
--
-- Statements and items with a mistake, the broken nodes of the syntax tree, are not printed. The
-- parameter @indent@ is always an indentation in characters.
module Surface.PrintProgram
  ( program,
    rows,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.NumberTable qualified as NumberTable
import Base.Quantity (LengthUnit (..))
import Base.Region (Located (Located))
import Base.Region qualified as Region
import Data.Char (isDigit)
import Data.List (transpose)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (maybeToList)
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Alignment (AlignedLine (..), AlignmentColumn (..), LineCells (..))
import Surface.Alignment qualified as Alignment
import Surface.HoleForm qualified as HoleForm
import Surface.PrettyPrinter (Doc (..), Member)
import Surface.PrettyPrinter qualified as PrettyPrinter
import Surface.PrintExpression (CommentPositions, spaced)
import Surface.PrintExpression qualified as PrintExpression
import Surface.Syntax
import Surface.Token (unitName)

-- | The text of a program in canonical layout, without its comments.
program :: Program -> Text
program = Text.unlines . Alignment.render . rows PrintExpression.noComments . statements

-- | The printed lines of statements. If the source has comments inside a list of values, the list
-- is broken into several lines, so that the comments keep their positions.
rows :: CommentPositions -> [Statement] -> [AlignedLine]
rows comments = concatMap (statement comments 0)

-- Rows

-- | The lines of one document, each with one cell. All lines but the first are continuations.
whole :: Int -> Doc -> [AlignedLine]
whole indent doc = case PrettyPrinter.render indent doc of
  [] -> []
  first : more ->
    AlignedLine
      { indent = PrettyPrinter.indent first,
        cells = WholeLine (PrettyPrinter.text first),
        isContinuation = False
      } :
    map continued more

-- | One line with the two cells @first@ and @second@, if both documents fit on it. The second cell
-- is aligned with the second cells of neighbouring lines that have the same @column@. If the
-- documents do not fit on one line, the second follows the first on several lines, not aligned.
cells' :: AlignmentColumn -> Int -> Doc -> Doc -> [AlignedLine]
cells' column indent first second =
  case (PrettyPrinter.render indent first, PrettyPrinter.render indent second, alone) of
    ([a], [b], [_]) ->
      [ AlignedLine
          { indent,
            cells = LineCells column (PrettyPrinter.text a) (PrettyPrinter.text b),
            isContinuation = False
          }
      ]
    _ -> alone
  where
    alone = whole indent (Beside [first, Text (Alignment.separator column), second])

continued :: PrettyPrinter.PrintedLine -> AlignedLine
continued line =
  AlignedLine
    { indent = PrettyPrinter.indent line,
      cells = WholeLine (PrettyPrinter.text line),
      isContinuation = True
    }

-- | The lines of a block: the document @before@ with the opening brace, the lines @inside@, and the
-- closing brace.
braces :: Int -> Doc -> [AlignedLine] -> [AlignedLine]
braces indent before inside
  | null inside = whole indent (spaced [before, Text "{ }"])
  | otherwise = opened indent before <> inside <> whole indent (Text "}")

-- | The lines of the document @before@, with the opening brace of a block after it.
opened :: Int -> Doc -> [AlignedLine]
opened indent before = whole indent (spaced [before, Text "{"])

-- Statements

-- | The lines of a statement that is indented by @indent@ characters.
statement :: CommentPositions -> Int -> Statement -> [AlignedLine]
statement comments indent (Located _ s) = case s of
  Part (Located _ (Name name)) title ->
    plain (spaced (map Text ("part" : name : maybe [] (\t -> [quoted (Region.value t)]) title)))
  Units Millimetres -> worded "units" (Text "mm")
  Units Inches -> worded "units" (Text "in")
  Machine (Located _ ref) -> worded "machine" (Text (machineRef ref))
  Import (Located _ file) -> worded "import" (Text (quoted file))
  Tool number c -> worded "tool" (spaced (map value (maybeToList number) <> [cutter comments c]))
  Feed e -> worded "feed" (value e)
  Tolerance a -> worded "tolerance" (accuracy comments a)
  Clearance e -> worded "clearance" (value e)
  From e -> worded "from" (value e)
  WorkOffset e -> worded "work" (value e)
  ProgramNumber e -> worded "program" (value e)
  SafeHeight e -> worded "safe" (value e)
  Stock e zs -> worded "stock" (spaced (value e : heights comments zs))
  Avoid e zs -> worded "avoid" (spaced (value e : heights comments zs))
  LetValue (Located _ (Name name)) e -> defined ("let " <> name) e
  LetFunction (Located _ (Name name)) parameters e ->
    defined ("let " <> name <> "(" <> names parameters <> ")") e
  Param (Located _ (Name name)) e -> defined ("param " <> name) e
  Contour (Located _ (Name name)) (Located _ closure) items ->
    braces
      indent
      (Text ("contour " <> name <> " " <> closureName closure))
      (concatMap (item comments (indent + 2)) items)
  Drawn outlines (Located _ (Name name)) part ->
    plain (spaced (Text (drawnWord outlines <> " " <> name) : drawingReference comments part))
  DrawnText (Located _ (Name name)) (Located _ font) text _ ->
    plain (lettering comments ("contours " <> name <> " from " <> quoted font <> " text") text)
  Table (Located _ (Name name)) (LinesFromDrawing part) ->
    plain (spaced (Text ("table " <> name) : drawingReference comments part))
  Table (Located _ (Name name)) (LinesFromFile (Located _ file)) ->
    plain (Text ("table " <> name <> " from " <> quoted file))
  Table (Located _ (Name name)) (WrittenLines ls) ->
    braces indent (Text ("table " <> name)) (table comments (indent + 2) ls)
  Curve (Located _ (Name name)) e -> defined ("curve " <> name) e
  Piece (Located _ (Name name)) e ciphers (Located _ side) joggles ->
    cells'
      Definitions
      indent
      (Text ("piece " <> name))
      (spaced [Text "=", piece comments e ciphers side joggles])
  Assert e within ->
    plain (spaced ([Text "assert", value e] <> maybe [] (\w -> [Text "within", value w]) within))
  Mill e side settings -> machining "mill" e side settings
  Pocket e step own settings ->
    clearing (spaced ([Text "pocket", value e, Text "step", value step] <> namedAs own)) settings
  RestOf e step settings ->
    clearing (spaced [Text "rest of", value e, Text "step", value step]) settings
  Face e step settings ->
    clearing (spaced [Text "face", value e, Text "step", value step]) settings
  Engrave text settings -> clearing (lettering comments "engrave" text) settings
  Vcarve e own settings -> clearing (spaced ([Text "vcarve", value e] <> namedAs own)) settings
  Turn e side settings -> machining "turn" e side settings
  Drill at depth settings ->
    let before = spaced [Text "drill at", value at, Text "depth", value depth]
     in if null settings
          then plain before
          else braces indent before (concatMap (setting comments (indent + 2)) settings)
  Hole work at sizes side settings ->
    let size (what, e) = [Text (HoleForm.sizeWord what), value e]
        before =
          spaced $
            [Text (HoleForm.word work <> " at"), value at]
              <> concatMap size sizes
              <> [Text (sideName to) | Just (Located _ to) <- [side]]
     in if null settings
          then plain before
          else braces indent before (concatMap (setting comments (indent + 2)) settings)
  Travel RapidMotion to -> worded "rapid" (stops comments to)
  Travel FeedMotion to -> worded "move" (stops comments to)
  Change number c place ->
    let point = concat [[Text "at", value p] | Just p <- [place]]
     in worded "change" (spaced ([value number, cutter comments c] <> point))
  Spindle spin -> worded "spindle" (spinning spin)
  Coolant SwitchOn -> worded "coolant" (Text "on")
  Coolant SwitchOff -> worded "coolant" (Text "off")
  Auxiliary e -> worded "aux" (value e)
  ProgramStop -> plain (Text "stop")
  OptionalStop -> plain (Text "optional stop")
  Dwell e -> worded "dwell" (spaced [value e, Text "s"])
  Repeat (Located _ (Name name)) from inside ->
    braces indent (spaced [Text ("for " <> name <> " in"), value from]) (block inside)
  When condition yes no -> alternatives choices indent (Text "if") (Choice condition yes no)
  With e inside -> braces indent (spaced [Text "with", value e]) (block inside)
  Broken _ _ -> []
  where
    plain = whole indent
    value = PrintExpression.value comments
    worded word = cells' Values indent (Text word)
    defined what e = cells' Definitions indent (Text what) (spaced [Text "=", value e])
    block = concatMap (statement comments (indent + 2))
    machining word e (Located _ side) = clearing (spaced [Text word, value e, Text (sideName side)])
    clearing before settings =
      braces indent before (concatMap (setting comments (indent + 2)) settings)
    namedAs own = [Text ("as " <> name) | Just (Located _ (Name name)) <- [own]]
    spinning spin = case spin of
      SpindleStop -> Text "off"
      SpindleByHand -> Text "manual"
      Spinning sense speed limit ->
        spaced
          ( Text (senseName sense) :
            maybe [] (\e -> [value e]) speed
              <> maybe [] (\e -> [Text "limit", value e]) limit
          )
    choices = ChoicePrinter {conditionOf = value, blockOf = block, onlyChoice = onlyWhen}
    onlyWhen inside = case inside of
      [Located _ (When c yes no)] -> Just (Choice c yes no)
      _ -> Nothing

-- | The lines of a table with aligned columns.
table :: CommentPositions -> Int -> [TableLine] -> [AlignedLine]
table comments indent ls =
  map row (alignColumns (concat [tableCells comments l | Located _ l <- ls]))
  where
    row texts =
      AlignedLine
        { indent,
          cells = WholeLine (Text.stripEnd (Text.intercalate "  " texts)),
          isContinuation = False
        }

-- | Pads the cells of rows with spaces. The columns are then aligned, and so are the decimal points
-- within a column.
alignColumns :: [[Text]] -> [[Text]]
alignColumns rows' = map (zipWith3 pad fronts widths) rows'
  where
    pad front width text = Text.justifyLeft width ' ' (pointed front text)
    pointed front text =
      if isNumber text then Text.replicate (front - frontOf text) " " <> text else text
    -- The number of characters before the decimal point.
    frontOf = Text.length . Text.takeWhile (\c -> isDigit c || c == '-')
    isNumber text = Text.any (\c -> isDigit c || c == '-') (Text.take 1 text)
    fronts = map (maximum . (0 :) . map frontOf . filter isNumber) (transpose rows') <> repeat 0
    widths =
      zipWith (\front -> maximum . map (Text.length . pointed front)) fronts (transpose rows')
        <> repeat 0

-- | The rows of cells for a line of a table. The 'Numbers' of a file give several rows, any other
-- line gives at most one. Values other than literals and negated literals are put in parentheses.
tableCells :: CommentPositions -> TableLine_ -> [[Text]]
tableCells comments l = case l of
  Header columns ->
    [ [ name <> maybe "" ((" " <>) . unitName) unit
        | Heading (Located _ (Name name)) unit <- NonEmpty.toList columns
      ]
    ]
  Entries es -> [map cell (NonEmpty.toList es)]
  Numbers numbers ->
    [ map Decimal.exact (NumberTable.cells numbers k)
      | k <- [0 .. NumberTable.count numbers - 1]
    ]
  BrokenLine -> []
  where
    cell c = case c of
      ValueCell e -> valueText e
      TextCell t -> quoted (Region.value t)
    valueText e = case Region.value e of
      Literal _ _ -> text (PrintExpression.value comments e)
      Negate (Located _ (Literal _ _)) -> text (PrintExpression.value comments e)
      _ -> "(" <> text (PrintExpression.value comments e) <> ")"
    text doc = Text.unwords (map PrettyPrinter.text (PrettyPrinter.render 0 doc))

-- | The document of what a @piece@ statement has after @=@: curve, ciphers, side and joggles.
piece :: CommentPositions -> Expr -> [Cipher] -> Side -> [Joggle] -> Doc
piece comments e ciphers side joggles =
  Series
    ( map
        PrintExpression.member
        ([value e] <> recalculations <> [Text (sideName side)] <> concatMap joggle joggles)
    )
  where
    value = PrintExpression.value comments
    recalculations = case zip ciphers (replicate (length ciphers - 1) "," <> [""]) of
      [] -> []
      (first, comma) : rest ->
        spaced [Text "cipher", cipher first comma] : map (uncurry cipher) rest
    cipher (Located region (Cipher (Located _ digit) es)) comma =
      Beside [PrintExpression.callDocument comments region (digits digit <> "(") es, Text comma]
    joggle (Located _ (Joggle from to depth radius)) =
      [ spaced
          [ Text "joggle from",
            value from,
            Text "to",
            value to,
            Text "depth",
            value depth,
            Text "radius",
            value radius
          ]
      ]

-- | An @if@ with blocks of statements or items: the condition, the block for true, the block for
-- false.
data Choice a = Choice Expr [a] [a]

-- | The printers for the parts of a choice.
data ChoicePrinter a = ChoicePrinter
  { conditionOf :: Expr -> Doc,
    blockOf :: [a] -> [AlignedLine],
    -- | the choice in a block that contains one choice and nothing else; 'Nothing' for other blocks
    onlyChoice :: [a] -> Maybe (Choice a)
  }

-- | The lines of a choice: @if c { … } else if d { … } else { … }@. The document @before@ precedes
-- the condition: @if@ or @} else if@.
alternatives :: ChoicePrinter a -> Int -> Doc -> Choice a -> [AlignedLine]
alternatives printer indent before (Choice condition yes no) = case (no, onlyChoice printer no) of
  ([], _) -> braces indent begin (block yes)
  (_, Just inner) ->
    opened indent begin <> block yes <> alternatives printer indent (Text "} else if") inner
  (_, Nothing) -> opened indent begin <> block yes <> braces indent (Text "} else") (block no)
  where
    block = blockOf printer
    begin = spaced [before, conditionOf printer condition]

quoted :: Text -> Text
quoted text = "\"" <> text <> "\""

names :: NonEmpty (Located Name) -> Text
names = Text.intercalate ", " . map (\(Located _ (Name name)) -> name) . NonEmpty.toList

machineRef :: MachineRef -> Text
machineRef ref = case ref of
  Named name -> name
  Described file -> quoted file

cutter :: CommentPositions -> Cutter -> Doc
cutter comments (Located _ c) = case c of
  MillCutter e sizes -> made "mill(diameter " e sizes
  DrillCutter e sizes -> made "drill(diameter " e sizes
  TapCutter e sizes -> made "tap(diameter " e sizes
  ThreadMillCutter e pitch sizes ->
    Beside
      ( [Text "threadmill(diameter ", value e, Text ", pitch ", value pitch]
          <> concatMap (size . Region.value) sizes
          <> [Text ")"]
      )
  TurningCutter e tip ->
    let direction = concat [[Text ", tip ", value n] | Just n <- [tip]]
     in Beside ([Text "turn(nose ", value e] <> direction <> [Text ")"])
  ConeCutter d a h ->
    Beside
      [ Text "cone(diameter ",
        value d,
        Text ", bevel ",
        value a,
        Text ", height ",
        value h,
        Text ")"
      ]
  VBitCutter a t d ->
    Beside
      [Text "vbit(angle ", value a, Text ", tip ", value t, Text ", diameter ", value d, Text ")"]
  BladeCutter d g -> Beside [Text "blade(diameter ", value d, Text ", gear ", value g, Text ")"]
  where
    made before e sizes =
      Beside ([Text before, value e] <> concatMap (size . Region.value) sizes <> [Text ")"])
    size s = case s of
      Flutes e -> [Text ", flutes ", value e]
      StickOut e -> [Text ", stickout ", value e]
      PointAngle e -> [Text ", angle ", value e]
      HolderCylinder d h ->
        [Text ", holder ", value d] <> concat [[Text " height ", value e] | Just e <- [h]]
    value = PrintExpression.value comments

-- | The documents of the heights of a body, after its region.
heights :: CommentPositions -> Maybe (Expr, Expr) -> [Doc]
heights comments zs =
  concat [[Text "from", value a, Text "to", value b] | Just (a, b) <- [zs]]
  where
    value = PrintExpression.value comments

-- | A text with its place, after the words before it.
lettering :: CommentPositions -> Text -> Lettering -> Doc
lettering comments words' (Lettering (Located _ text) at height course alignment) =
  spaced $
    [Text (words' <> " " <> quoted text <> " at"), value at, Text "height", value height]
      <> case course of
        Level -> []
        Inclined e -> [Text "direction", value e]
        Around e side ->
          [Text "around", value e] <> [Text (sideName s) | Just (Located _ s) <- [side]]
      <> [Text ("align " <> alignmentName a) | Just a <- [alignment]]
  where
    value = PrintExpression.value comments
    alignmentName a = case a of
      AlignLeft -> "left"
      AlignCentre -> "centre"
      AlignRight -> "right"

accuracy :: CommentPositions -> Accuracy -> Doc
accuracy comments a = case a of
  Within e -> PrintExpression.value comments e
  Between inside outside ->
    spaced
      [ Text "inside",
        PrintExpression.value comments inside,
        Text "outside",
        PrintExpression.value comments outside
      ]

-- | The document of points separated by commas. The pace of the motion to a point, @rapid@ or a
-- feed, stays on the line of the point.
stops :: CommentPositions -> NonEmpty Stop -> Doc
stops comments = Series . NonEmpty.toList . PrintExpression.list comments . fmap stop
  where
    stop Stop {point, pace} = case pace of
      Cutting -> (Region.region point, value point)
      Rapid -> (Region.region point, spaced [value point, Text "rapid"])
      AtFeed e ->
        ( Region.span (Region.region point) (Region.region e),
          spaced [value point, Text "feed", value e]
        )
    value = PrintExpression.value comments

closureName :: Closure -> Text
closureName closure = case closure of
  Open -> "open"
  Closed -> "closed"

sideName :: Side -> Text
sideName side = case side of
  Outside -> "outside"
  Inside -> "inside"
  LeftSide -> "left"
  RightSide -> "right"
  On -> "on"

drawnWord :: DrawnOutlines -> Text
drawnWord outlines = case outlines of
  OneOutline -> "contour"
  AllOutlines -> "contours"

-- | A part of a drawing, from the word @from@ on.
drawingReference :: CommentPositions -> DrawingReference -> [Doc]
drawingReference comments (DrawingReference (Located _ file) chosen unit within) =
  [Text ("from " <> quoted file)]
    <> [ Text $ case choice of
           OnLayer name -> "layer " <> quoted name
           WithIdentifier name -> "id " <> quoted name
           WithClass name -> "class " <> quoted name
         | Just (Located _ choice) <- [chosen]
       ]
    <> [Text (if u == Inches then "unit in" else "unit mm") | Just (Located _ u) <- [unit]]
    <> concat [[Text "within", PrintExpression.value comments e] | Just e <- [within]]

senseName :: Sense -> Text
senseName sense = case sense of
  Clockwise -> "cw"
  CounterClockwise -> "ccw"

-- Items of a contour

item :: CommentPositions -> Int -> Item -> [AlignedLine]
item comments indent (Located _ i) = case i of
  Element sense e modifiers link ->
    let withSense = case sense of
          Nothing -> PrintExpression.element comments e
          Just (Located _ s) -> spaced [Text (senseName s), value e]
        first = spaced (withSense : map (modifier comments) modifiers)
     in maybe (whole indent first) (cells' Links indent first . linked comments) link
  For (Located _ (Name name)) from inside ->
    braces indent (spaced [Text ("for " <> name <> " in"), value from]) (block inside)
  Choose condition yes no -> alternatives choices indent (Text "if") (Choice condition yes no)
  BrokenItem _ -> []
  where
    value = PrintExpression.value comments
    block = concatMap (item comments (indent + 2))
    choices = ChoicePrinter {conditionOf = value, blockOf = block, onlyChoice = onlyChoose}
    onlyChoose inside = case inside of
      [Located _ (Choose c yes no)] -> Just (Choice c yes no)
      _ -> Nothing

modifier :: CommentPositions -> Modifier -> Doc
modifier comments (Located _ m) = case m of
  ElementFeed e -> spaced [Text "feed", PrintExpression.value comments e]
  Slow -> Text "slow"
  ElementAllowance e -> spaced [Text "allowance", PrintExpression.value comments e]
  Bevel e -> spaced [Text "bevel", PrintExpression.value comments e]

linked :: CommentPositions -> Link -> Doc
linked comments (Located _ l) = case l of
  Meet near -> spaced (Text "meet" : maybe [] (\p -> [Text "near", value p]) near)
  Smooth -> Text "smooth"
  Tangent -> Text "tangent"
  Fillet e -> spaced [Text "fillet", value e]
  Chamfer e -> spaced [Text "chamfer", value e]
  where
    value = PrintExpression.value comments

-- Settings

setting :: CommentPositions -> Int -> Setting -> [AlignedLine]
setting comments indent (Located _ s) = case s of
  Approach to -> worded "approach" (stops comments to)
  Retract to -> worded "retract" (stops comments to)
  Depth e step -> worded "depth" (spaced (value e : maybe [] (\x -> [Text "step", value x]) step))
  LeadBy lead form e -> worded ("lead " <> leadName lead) (spaced [Text (formName form), value e])
  Allowances es -> worded "allowance" (Series (pieces es))
  CornerStyle Round -> worded "corners" (Text "round")
  CornerStyle Sharp -> worded "corners" (Text "sharp")
  CutBy Climb -> whole indent (Text "climb")
  CutBy Conventional -> whole indent (Text "conventional")
  CompensationBy ByCompiler -> worded "compensation" (Text "compiler")
  CompensationBy ByController -> worded "compensation" (Text "controller")
  StartNear p -> worded "start near" (value p)
  Plunge e -> worded "plunge" (value e)
  Ramp e -> worded "ramp" (value e)
  Helix p d ->
    worded "helix" (spaced ([Text "pitch", value p] <> also "diameter" d))
  Spiral -> whole indent (Text "spiral")
  Tabs (TabCount n) w h a -> worded "tabs" (spaced (value n : tabSizes w h a))
  Tabs (TabsAt ps) w h a ->
    worded "tab at" (spaced ([Series (pieces ps)] <> tabSizes w h a))
  Peck e -> worded "peck" (value e)
  ShortestWay -> whole indent (Text "shortest")
  Angle e -> worded "angle" (value e)
  ChipBreak e -> worded "chip break" (value e)
  Pause e -> worded "dwell" (spaced [value e, Text "s"])
  TurnPitch e -> worded "pitch" (value e)
  Hand side -> worded "hand" (Text (sideName side))
  Floating -> whole indent (Text "floating")
  Islands es -> worded "islands" (Series (pieces es))
  RestAllowed -> worded "rest" (Text "allowed")
  BrokenSetting -> []
  where
    value = PrintExpression.value comments
    worded word = cells' SettingValues indent (Text word)
    also word = maybe [] (\e -> [Text word, value e])
    tabSizes w h a = also "width" (Just w) <> also "height" (Just h) <> also "angle" a
    pieces :: NonEmpty Expr -> [Member]
    pieces =
      NonEmpty.toList . PrintExpression.list comments . fmap (\e -> (Region.region e, value e))

leadName :: Lead -> Text
leadName lead = case lead of
  LeadIn -> "in"
  LeadOut -> "out"

formName :: LeadForm -> Text
formName form = case form of
  LeadLine -> "line"
  LeadArc -> "arc"
