-- | Conversion of an input sheet to a part program.
--
-- An input sheet is the form of numbers that the Minsk-22 system reads. A piece is a curve with its
-- recalculations, each of which shifts the curve along its normal. The cipher of a piece has a
-- digit for each recalculation. A waypoint is a point with a feed. An array is a sequence of linked
-- pieces with the waypoints after them.
--
-- Every node of the syntax tree has the region of the numbers from which it is made. So the reports
-- of later compiler passes point at the sheet.
module Sheet.ToSurface
  ( program,
    text,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (Name))
import Base.Region (Located (..))
import Base.Region qualified as Region
import Data.List (transpose)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Sheet.Sheet hiding (program)
import Sheet.Sheet qualified as Sheet
import Surface.FileUnit qualified as FileUnit
import Surface.PrintProgram qualified as PrintProgram
import Surface.Syntax
  ( Expr,
    Expr_ (..),
    Item,
    Pace (..),
    Setting,
    Statement,
    Statement_ (Contour, Curve, Feed, From, Machine, Mill, Part, Table, Tolerance, Tool),
    Stop (..),
  )
import Surface.Syntax qualified as Surface
import Surface.Token (Numeral (..), Unit (..))

-- | The program that makes the part of a sheet.
program :: Sheet -> Surface.Program
program sheet =
  FileUnit.program 0 (concat (paragraphs sheet)) []

-- | The program of a sheet as text, in the layout of the formatter.
text :: Sheet -> Text
text sheet =
  Text.intercalate
    "\n"
    [PrintProgram.program (FileUnit.program 0 statements []) | statements <- paragraphs sheet]

-- | The name of the part, made of the program's number on the sheet.
partName :: Double -> Text
partName number = "program_" <> Decimal.exact number

-- | The title of the part, made of the identification numbers of the product and the part.
partTitle :: Double -> Double -> Text
partTitle product' part' = "Product " <> Decimal.exact product' <> ", part " <> Decimal.exact part'

-- | The statements of a sheet's program in groups. The text has an empty line between two groups.
paragraphs :: Sheet -> [[Statement]]
paragraphs sheet =
  [headStatement (general sheet)] : settings sheet : concatMap (arrayStatements sheet) (runs sheet)

-- | An array with its number, its feeds and the number of its first piece.
data Run = Run
  { -- | the number of the array, from 1
    ordinal :: Int,
    -- | the number of the array's first piece, from 1, counted over all pieces of the sheet
    firstPiece :: Int,
    -- | the feed of the array's pieces, mm\/min
    working :: Number,
    -- | the feed of the previous array's pieces, mm\/min; Nothing for the first array
    earlier :: Maybe Number,
    array :: Array
  }

-- | The arrays of a sheet.
runs :: Sheet -> [Run]
runs sheet = go 1 1 (leaving (approach sheet)) Nothing (NonEmpty.toList (arrays sheet))
  where
    go ordinal firstPiece working earlier list = case list of
      [] -> []
      array : rest ->
        Run {ordinal, firstPiece, working, earlier, array} :
        go
          (ordinal + 1)
          (firstPiece + length (pieces array))
          (leaving (retract array))
          (Just working)
          rest
    leaving = feed . NonEmpty.last

-- | The statement that names the part.
headStatement :: General -> Statement
headStatement g = Located (region number) (Part (Name . partName <$> number) (Just title))
  where
    number = Sheet.program g
    title =
      Located
        (Region.merge (region (productCipher g)) (region (partCipher g)))
        (partTitle (value (productCipher g)) (value (partCipher g)))

-- | The machine of a sheet: Kolsanova's system punched tapes for the interpolators ЛКИ-ФМ, ЛКИ-У
-- and ЛКИ-УН. The first one is chosen, because its name fits the phase pulses into which, as she
-- says, the interpolator converts a tape (docs/input-sheet.md).
defaultMachine :: Text
defaultMachine = "lki-fm"

-- | The statements for the machine, the tool, the feed, the tolerance and the starting position.
settings :: Sheet -> [Statement]
settings sheet@Sheet {general = g, approach} =
  [ Located at (Machine (Located at (Surface.Named defaultMachine))),
    Located (region (diameter g)) (Tool Nothing (Located (region (diameter g)) tool)),
    Located (region working) (Feed (measured MmPerMin working)),
    Located (region (tolerance g)) (Tolerance (Surface.Within (measured Millimetre (tolerance g)))),
    Located (region (x start)) (From (pointOf (isFlat sheet) start))
  ]
  where
    at = region (Sheet.program g)
    working = feed (NonEmpty.last approach)
    start = NonEmpty.head approach
    tool
      | value (gear g) /= 0 =
        Surface.BladeCutter (measured Millimetre (diameter g)) (measured Millimetre (gear g))
      | value (bevel g) /= 0 =
        Surface.ConeCutter
          (measured Millimetre (diameter g))
          (measured Degree (bevel g))
          (measured Millimetre (height g))
      | otherwise = Surface.MillCutter (measured Millimetre (diameter g)) []

-- | The paragraphs of an array: one for each piece, one for the contour, one for the milling
-- statement.
arrayStatements :: Sheet -> Run -> [[Statement]]
arrayStatements sheet run@Run {ordinal, firstPiece, working, earlier, array} =
  zipWith pieceStatements [firstPiece ..] (NonEmpty.toList (pieces array))
    <> [[contour], feeds <> [mill]]
  where
    at = region (cipher (NonEmpty.head (pieces array)))
    name = Name ("array_" <> Decimal.whole ordinal)
    links = [Just l | LinkedPiece _ l <- joined array] <> [Nothing]
    contour = Located at (Contour (Located at name) (Located at Surface.Open) items)
    items = zipWith3 (item (isBlade sheet)) [firstPiece ..] (NonEmpty.toList (pieces array)) links
    feeds =
      [ Located (region working) (Feed (measured MmPerMin working))
        | Just old <- [earlier],
          value old /= value working
      ]
    mill =
      Located
        at
        ( Mill
            (Located at (Variable name))
            (sideOf <$> side (general sheet))
            (linkingMoves sheet run)
        )

-- | The settings @approach@ and @retract@ of an array's milling statement. Only the first array has
-- an approach: the retract of each array leads to the next one.
linkingMoves :: Sheet -> Run -> [Setting]
linkingMoves sheet Run {working, earlier, array} = approaching <> retracting
  where
    isFlat' = isFlat sheet
    approaching = case (earlier, approach sheet) of
      (Nothing, from :| rest) -> setting Surface.Approach (stops isFlat' working (feed from) rest)
      (Just _, _) -> []
    retracting =
      setting Surface.Retract (stops isFlat' working working (NonEmpty.toList (retract array)))
    setting make list =
      [ Located (region (point (NonEmpty.head s))) (make s)
        | Just s <- [NonEmpty.nonEmpty list]
      ] ::
        [Setting]

sideOf :: Maybe Side -> Surface.Side
sideOf side = case side of
  Just LeftSide -> Surface.LeftSide
  Just RightSide -> Surface.RightSide
  Nothing -> Surface.On

-- | True if the tool is a swivelling blade.
isBlade :: Sheet -> Bool
isBlade sheet = value (gear (general sheet)) /= 0

-- Points

-- | True if the program can give points without heights: all heights of the sheet are 0, and the
-- tool is not a swivelling blade, which moves in z when it swivels.
isFlat :: Sheet -> Bool
isFlat sheet =
  not (isBlade sheet)
    && all (all ((== 0) . value . z)) (approach sheet : retracts)
  where
    retracts = map retract (NonEmpty.toList (arrays sheet))

-- | A point as x and y if @isFlat'@, otherwise with its height.
pointOf :: Bool -> Waypoint -> Expr
pointOf isFlat' Waypoint {x, y, z}
  | isFlat' = Located (Region.merge (region x) (region y)) (Pair (unitless x) (unitless y))
  | otherwise =
    Located (Region.merge (region x) (region z)) (Triple (unitless x) (unitless y) (unitless z))

-- | Converts waypoints to stops, the points of an approach or a retract in a part program. A
-- waypoint has the feed of the move that starts there, a stop the feed of the move to it. @isFlat'@
-- is the result of 'isFlat'. @working@ is the feed of the pieces; a stop with this feed is written
-- without a feed. @leaving@ is the feed of the move to the first waypoint.
stops :: Bool -> Number -> Number -> [Waypoint] -> [Stop]
stops isFlat' working leaving list = case list of
  [] -> []
  w : rest -> Stop (pointOf isFlat' w) pace : stops isFlat' working (feed w) rest
  where
    pace
      | value leaving == rapidFeed = Rapid
      | value leaving == value working = Cutting
      | otherwise = AtFeed (unitless leaving)

-- Pieces

-- | The statement of a piece's table, and the statement that defines the piece. If the cipher is 0,
-- which means no recalculation, the second statement defines a curve. @count@ is the number of the
-- piece, from which both names are made.
pieceStatements :: Int -> Piece -> [Statement]
pieceStatements count piece =
  [ Located at (Table (Located at points) (tableOf piece)),
    Located at definition
  ]
  where
    at = region (cipher piece)
    points = Name ("points_" <> Decimal.whole count)
    function = Name (if length (rows piece) > 2 then "spline" else "polyline")
    curve =
      Located
        at
        (Call (Located at function) (Surface.Given (Located at (Variable points)) :| []))
    name = Located at (pieceName count)
    definition = case value (cipher piece) of
      [] -> Curve name curve
      rs -> Surface.Piece name curve (ciphers piece rs) (surfaceSide <$> shiftSide piece) []
    surfaceSide s = case s of
      LeftSide -> Surface.LeftSide
      RightSide -> Surface.RightSide

-- | The table of a piece. It has a line for each point: the coordinates, the bevel @mu@ and the
-- flange height @H@ of the surface if the piece has surfaces, and a distance for each recalculation
-- with the digit 6.
tableOf :: Piece -> Surface.Lines
tableOf piece = Surface.WrittenLines (Located at (Surface.Header headings) : map line linesOf)
  where
    at = region (cipher piece)
    rowList = NonEmpty.toList (rows piece)
    given = [NonEmpty.toList ts | Pointwise ts <- value (cipher piece)]
    linesOf = zip rowList (if null given then repeat [] else transpose given)
    headings =
      heading "x" :| [heading "y"]
        <> concat
          [[Surface.Heading (Located at (Name "mu")) (Just Degree), heading "H"] | hasSurface piece]
        <> map heading (thicknessNames (length given))
    heading word = Surface.Heading (Located at (Name word)) Nothing
    line (row, ts) =
      Located
        (Region.merge (region (px row)) (region (py row)))
        (Surface.Entries (fmap cell (px row :| [py row] <> surfaceCells row <> ts)))
    cell = Surface.ValueCell . unitless
    surfaceCells row = concat [[mu s, flangeHeight s] | Just s <- [surface row]]

pieceName :: Int -> Name
pieceName count = Name ("piece_" <> Decimal.whole count)

-- | The headings of the columns with the distances of digit 6: @t@ for one column, @t_1@, @t_2@ and
-- so on for several. @count@ is the count of columns.
thicknessNames :: Int -> [Text]
thicknessNames count = if count == 1 then ["t"] else ["t_" <> Decimal.whole k | k <- [1 .. count]]

-- | The ciphers of a piece in the part program, where each recalculation has a cipher of its own: a
-- digit with arguments. If the points of the piece have surfaces, the digits 1, 2 and 6 get a last
-- argument @mu@. It states that their distances are measured square to the surface.
ciphers :: Piece -> [Recalculation] -> [Surface.Cipher]
ciphers piece recalculations =
  go (thicknessNames (length [() | Pointwise _ <- recalculations])) recalculations
  where
    go names list = case (list, names) of
      ([], _) -> []
      (r@(Pointwise _) : rest, name : others') ->
        cipherOf r (column name :| square) : go others' rest
      (r@(Pointwise _) : rest, []) -> cipherOf r (column "t" :| square) : go [] rest
      (r@(Growing a b) : rest, _) -> cipherOf r (unitless a :| unitless b : square) : go names rest
      (r@(Constant a) : rest, _) -> cipherOf r (unitless a :| square) : go names rest
      (r@Bevelled : rest, _) -> cipherOf r (column "mu" :| [column "H"]) : go names rest
    at = region (cipher piece)
    column name = Located at (Variable (Name name))
    square = [column "mu" | hasSurface piece]
    cipherOf r arguments =
      Located at (Surface.Cipher (Located at (numeral (digitNumber (digitOf r)))) arguments)
    digitNumber digit = case digit of
      One -> 1
      Two -> 2
      Four -> 4
      Six -> 6

-- | A piece as an element of its contour. @isSwivelling@ is True if the tool is a swivelling blade.
-- @count@ is the number of the piece, from 1. @link@ is the piece's link to the next piece, Nothing
-- for the last one.
item :: Bool -> Int -> Piece -> Maybe (Located Link) -> Item
item isSwivelling count piece link =
  Located
    at
    (Surface.Element Nothing (Located at (Variable (pieceName count))) modifiers (linked <$> link))
  where
    at = region (cipher piece)
    modifiers =
      [Located at (Surface.Bevel bevelOfPiece) | isSwivelling]
        <> [Located (region f) (Surface.ElementFeed (unitless f)) | Just f <- [ownFeed piece]]
        <> [Located (region (slow piece)) Surface.Slow | value (slow piece)]
        <> [Located (region left) (Surface.ElementAllowance (unitless left)) | value left /= 0]
    bevelOfPiece
      | hasSurface piece = Located at (Variable (Name "mu"))
      | otherwise = unitless (Located at 0)
    left = allowance piece
    linked (Located r l) = Located r $ case l of
      Joint -> Surface.Smooth
      Intersection -> Surface.Meet Nothing
      Rounding radius -> Surface.Fillet (unitless (Located r radius))

-- Numbers

-- | A number without a unit.
unitless :: Number -> Expr
unitless = literal Nothing

-- | A number with a unit.
measured :: Unit -> Number -> Expr
measured = literal . Just

literal :: Maybe Unit -> Number -> Expr
literal unit (Located at n)
  | n < 0 = Located at (Negate (Located at (Literal (numeral (abs n)) unit)))
  | otherwise = Located at (Literal (numeral n) unit)

numeral :: Double -> Numeral
numeral n = Numeral (Decimal.exact n) n
