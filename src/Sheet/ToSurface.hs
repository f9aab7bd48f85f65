-- | A sheet as a part program. Everything in the program stands where the numbers of the sheet
-- stand that it came from, so what later stages say points at the sheet.
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

-- | The program that a sheet stands for.
program :: Sheet -> Surface.Program
program sheet =
  Surface.Program {Surface.statements = concat (paragraphs sheet), Surface.comments = []}

-- | The program as text, in the canonical layout.
text :: Sheet -> Text
text sheet =
  Text.intercalate
    "\n"
    [PrintProgram.program (Surface.Program statements []) | statements <- paragraphs sheet]

-- | The name of the part, by the number of the program.
partName :: Double -> Text
partName number = "program_" <> Decimal.exact number

-- | The title of the part, by the ciphers of the product and the part.
partTitle :: Double -> Double -> Text
partTitle product' part' = "Product " <> Decimal.exact product' <> ", part " <> Decimal.exact part'

-- | Statements between which empty lines stand.
paragraphs :: Sheet -> [[Statement]]
paragraphs sheet =
  [headStatement (general sheet)] : settings sheet : concatMap (arrayStatements sheet) (runs sheet)

-- | An array with what is known before it: its number, that of its first piece, the feed of its
-- pieces, and that of the pieces before it.
data Run = Run
  { count :: Int,
    firstPiece :: Int,
    working :: Number,
    earlier :: Maybe Number,
    array :: Array
  }

runs :: Sheet -> [Run]
runs sheet = go 1 1 (leaving (approach sheet)) Nothing (NonEmpty.toList (arrays sheet))
  where
    go count firstPiece working earlier list = case list of
      [] -> []
      array : rest ->
        Run {count, firstPiece, working, earlier, array} :
        go
          (count + 1)
          (firstPiece + length (pieces array))
          (leaving (onward array))
          (Just working)
          rest
    leaving = feed . NonEmpty.last

headStatement :: General -> Statement
headStatement g = Located (region number) (Part (Name . partName <$> number) (Just title))
  where
    number = Sheet.program g
    title =
      Located
        (Region.merge (region (productCipher g)) (region (partCipher g)))
        (partTitle (value (productCipher g)) (value (partCipher g)))

settings :: Sheet -> [Statement]
settings sheet@Sheet {general = g, approach} =
  [ Located at (Machine (Located at (Surface.Named "lkp-01f"))),
    Located (region (diameter g)) (Tool (Located (region (diameter g)) tool)),
    Located (region working) (Feed (measured MmPerMin working)),
    Located (region (tolerance g)) (Tolerance (Surface.Within (measured Millimetre (tolerance g)))),
    Located (region (x start)) (From (place (isFlat sheet) start))
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
      | otherwise = Surface.MillCutter (measured Millimetre (diameter g))

-- | The paragraphs of an array.
arrayStatements :: Sheet -> Run -> [[Statement]]
arrayStatements sheet Run {count, firstPiece, working, earlier, array} =
  zipWith pieceStatements [firstPiece ..] (NonEmpty.toList (pieces array))
    <> [[contour], feeds <> [mill]]
  where
    at = region (cipher (NonEmpty.head (pieces array)))
    flat = isFlat sheet
    name = Name ("array_" <> Decimal.whole count)
    links = [Just l | LinkedPiece _ l <- joined array] <> [Nothing]
    contour =
      Located
        at
        ( Contour
            (Located at name)
            Surface.Open
            (zipWith3 (item (blade sheet)) [firstPiece ..] (NonEmpty.toList (pieces array)) links)
        )
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
            (approaching <> retracting)
        )
    -- The way to an array behind another one is that from the other one.
    approaching = case (earlier, approach sheet) of
      (Nothing, from :| rest) -> setting Surface.Approach (stops flat working (feed from) rest)
      (Just _, _) -> []
    retracting =
      setting Surface.Retract (stops flat working working (NonEmpty.toList (onward array)))
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

-- | Whether the tool is a swivelling blade.
blade :: Sheet -> Bool
blade sheet = value (gear (general sheet)) /= 0

-- Points on the way

-- | Whether the tool never leaves the height 0; a blade does when it swivels.
isFlat :: Sheet -> Bool
isFlat sheet =
  not (blade sheet)
    && all (all ((== 0) . value . z)) (approach sheet : map onward (NonEmpty.toList (arrays sheet)))

-- | A place; without its height when all are 0.
place :: Bool -> Waypoint -> Expr
place flat Waypoint {x, y, z}
  | flat = Located (Region.merge (region x) (region y)) (Pair (bare x) (bare y))
  | otherwise = Located (Region.merge (region x) (region z)) (Triple (bare x) (bare y) (bare z))

-- | Points behind one another, from the feed of the pieces and the one at which the point before is
-- left.
stops :: Bool -> Number -> Number -> [Waypoint] -> [Stop]
stops flat working leaving list = case list of
  [] -> []
  w : rest -> Stop (place flat w) pace : stops flat working (feed w) rest
  where
    pace
      | value leaving == rapidFeed = Rapid
      | value leaving == value working = Cutting
      | otherwise = AtFeed (bare leaving)

-- Pieces

-- | The table of a piece, and the piece, with its number.
pieceStatements :: Int -> Piece -> [Statement]
pieceStatements count piece =
  [ Located
      at
      ( Table
          (Located at points)
          ( Surface.WrittenLines
              ( Located at (Surface.Header headings) :
                zipWith line rowList (each (map NonEmpty.toList given))
              )
          )
      ),
    Located at made
  ]
  where
    at = region (cipher piece)
    points = Name ("points_" <> Decimal.whole count)
    rowList = NonEmpty.toList (rows piece)
    given = [ts | Pointwise ts <- value (cipher piece)]
    headings =
      heading "x" :| [heading "y"]
        <> concat
          [[Surface.Heading (Located at (Name "mu")) (Just Degree), heading "H"] | surfaced piece]
        <> map heading (thicknessNames (length given))
    each lists = if null lists then repeat [] else transpose lists
    heading word = Surface.Heading (Located at (Name word)) Nothing
    line row ts =
      Located
        (Region.merge (region (px row)) (region (py row)))
        (Surface.Entries (bare (px row) :| [bare (py row)] <> surfaceCells row <> map bare ts))
    surfaceCells row = concat [[bare (mu s), bare (flange s)] | Just s <- [surface row]]
    curve =
      Located
        at
        ( Call
            (Located at (Name (if length rowList > 2 then "spline" else "polyline")))
            (Surface.Given (Located at (Variable points)) :| [])
        )
    name = Located at (pieceName count)
    made = case value (cipher piece) of
      [] -> Curve name curve
      rs -> Surface.Piece name curve (ciphers piece rs) (sideTowards <$> towards piece) []
    sideTowards s = case s of
      LeftSide -> Surface.LeftSide
      RightSide -> Surface.RightSide

pieceName :: Int -> Name
pieceName count = Name ("piece_" <> Decimal.whole count)

-- | The columns of distances for each point.
thicknessNames :: Int -> [Text]
thicknessNames count = if count == 1 then ["t"] else ["t_" <> Decimal.whole k | k <- [1 .. count]]

-- | Distances are square to the surface where the bevel is known.
ciphers :: Piece -> [Recalculation] -> [Surface.Cipher]
ciphers piece recalculations =
  go (thicknessNames (length [() | Pointwise _ <- recalculations])) recalculations
  where
    go names list = case (list, names) of
      ([], _) -> []
      (r@(Pointwise _) : rest, name : others') ->
        cipherOf r (column name :| square) : go others' rest
      (r@(Pointwise _) : rest, []) -> cipherOf r (column "t" :| square) : go [] rest
      (r@(Growing a b) : rest, _) -> cipherOf r (bare a :| bare b : square) : go names rest
      (r@(Constant a) : rest, _) -> cipherOf r (bare a :| square) : go names rest
      (r@Bevelled : rest, _) -> cipherOf r (column "mu" :| [column "H"]) : go names rest
    at = region (cipher piece)
    column name = Located at (Variable (Name name))
    square = [column "mu" | surfaced piece]
    cipherOf r arguments =
      Located at (Surface.Cipher (Located at (numeral (read' (digitOf r)))) arguments)
    read' digit = case digit of
      One -> 1
      Two -> 2
      Four -> 4
      Six -> 6

-- | A piece in its contour, by its number; whether the tool is a swivelling blade.
item :: Bool -> Int -> Piece -> Maybe (Located Link) -> Item
item swivels count piece link =
  Located
    at
    (Surface.Element Nothing (Located at (Variable (pieceName count))) modifiers (linked <$> link))
  where
    at = region (cipher piece)
    modifiers =
      [ Located
          at
          ( Surface.Bevel
              (if surfaced piece then Located at (Variable (Name "mu")) else bare (Located at 0))
          )
        | swivels
      ]
        <> [Located (region (slow piece)) Surface.Slow | value (slow piece)]
        <> [ Located (region (allowance piece)) (Surface.ElementAllowance (bare (allowance piece)))
             | value (allowance piece) /= 0
           ]
    linked (Located r l) = Located r $ case l of
      Joint -> Surface.Smooth
      Intersection -> Surface.Meet Nothing
      Rounding radius -> Surface.Fillet (bare (Located r radius))

-- Numbers

bare :: Number -> Expr
bare = literal Nothing

measured :: Unit -> Number -> Expr
measured = literal . Just

literal :: Maybe Unit -> Number -> Expr
literal unit (Located at n)
  | n < 0 = Located at (Negate (Located at (Literal (numeral (abs n)) unit)))
  | otherwise = Located at (Literal (numeral n) unit)

numeral :: Double -> Numeral
numeral n = Numeral (Decimal.exact n) n
