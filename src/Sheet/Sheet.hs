-- | The input sheet of the Minsk-22 system as data: what each number of it means
-- (docs/input-sheet.md).
module Sheet.Sheet
  ( Sheet (..),
    General (..),
    Number,
    Waypoint (..),
    Array (..),
    LinkedPiece (..),
    Piece (..),
    Digit (..),
    Recalculation (..),
    PointRow (..),
    Surface (..),
    Link (..),
    Side (..),
    arrays,
    pieces,
    digitOf,
    digitText,
    surfaced,
    rapidFeed,
    mostArrays,
    generalWords,
    address,
  )
where

import Base.Region (Located)
import Data.List.NonEmpty (NonEmpty (..), (<|))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Numeric (showOct)

-- | A whole sheet. The points of the way to the first piece begin with the place at which the
-- cutter stands. The feed of a point holds from there on, so that of the last point of all is 0.
data Sheet = Sheet
  { general :: General,
    approach :: NonEmpty Waypoint,
    first :: Array,
    others :: [Array]
  }
  deriving stock (Eq, Show)

-- | A number and where it stands.
type Number = Located Double

-- | The general data.
data General = General
  { -- | the ciphers of product and part, and the number of the program: whole numbers
    productCipher :: Number,
    partCipher :: Number,
    program :: Number,
    -- | of the tool, mm
    diameter :: Number,
    -- | of the wheel that swivels a blade, mm; 0 without a blade
    gear :: Number,
    -- | of a cone, degrees; 0 without a cone
    bevel :: Number,
    -- | of what a cone cuts, mm; 0 without a cone
    height :: Number,
    -- | of the approximation, mm
    tolerance :: Number,
    -- | of the walk on which the tool goes; nothing when it goes on the pieces themselves
    side :: Located (Maybe Side)
  }
  deriving stock (Eq, Show)

-- | A place in space, mm, and the feed with which the tool leaves it, mm/min.
data Waypoint = Waypoint {x :: Number, y :: Number, z :: Number, feed :: Number}
  deriving stock (Eq, Show)

-- | Pieces joined to one another, and the way on behind them.
data Array = Array {joined :: [LinkedPiece], final :: Piece, onward :: NonEmpty Waypoint}
  deriving stock (Eq, Show)

-- | A piece and its link to the one behind it.
data LinkedPiece = LinkedPiece Piece (Located Link)
  deriving stock (Eq, Show)

-- | A curve by points of the theoretical contour, and what is made of it. When a recalculation
-- looks at the bevel, every row tells it; otherwise none does. A distance for each point is one for
-- each row.
data Piece = Piece
  { -- | towards which the distances count
    towards :: Located Side,
    cipher :: Located [Recalculation],
    rows :: NonEmpty PointRow,
    -- | the feed goes down at the end
    slow :: Located Bool,
    -- | left on the piece, mm
    allowance :: Number
  }
  deriving stock (Eq, Show)

-- | The digits of a cipher.
data Digit = One | Two | Four | Six
  deriving stock (Eq, Show, Enum, Bounded)

data Recalculation
  = -- | 1: from one distance to another, evenly along the curve
    Growing Number Number
  | -- | 2: one distance
    Constant Number
  | -- | 4: what the bevel makes of the height
    Bevelled
  | -- | 6: a distance for each point
    Pointwise (NonEmpty Number)
  deriving stock (Eq, Show)

-- | A point, mm, and the surface there.
data PointRow = PointRow {px :: Number, py :: Number, surface :: Maybe Surface}
  deriving stock (Eq, Show)

-- | The bevel, degrees, and the height of the flange, mm.
data Surface = Surface {mu :: Number, flange :: Number}
  deriving stock (Eq, Show)

data Link
  = -- | @+@: the pieces touch
    Joint
  | -- | @-@: they intersect
    Intersection
  | -- | an arc: clockwise if positive, mm
    Rounding Double
  deriving stock (Eq, Show)

-- | Of the direction of the walk.
data Side = LeftSide | RightSide
  deriving stock (Eq, Show, Enum, Bounded)

-- | All arrays.
arrays :: Sheet -> NonEmpty Array
arrays sheet = first sheet :| others sheet

-- | The pieces of an array.
pieces :: Array -> NonEmpty Piece
pieces array = foldr (\(LinkedPiece p _) rest -> p <| rest) (final array :| []) (joined array)

-- | The digit of a recalculation.
digitOf :: Recalculation -> Digit
digitOf r = case r of
  Growing _ _ -> One
  Constant _ -> Two
  Bevelled -> Four
  Pointwise _ -> Six

-- | A digit as it is written.
digitText :: Digit -> Text
digitText digit = case digit of
  One -> "1"
  Two -> "2"
  Four -> "4"
  Six -> "6"

-- | Whether the rows of a piece tell the bevel of the surface.
surfaced :: Piece -> Bool
surfaced piece = isJust (surface (NonEmpty.head (rows piece)))

-- | This feed means rapid, mm/min: the largest number of four digits.
rapidFeed :: Double
rapidFeed = 9999

-- | A program has no more of them (control stop 10746).
mostArrays :: Int
mostArrays = 30

-- | Where the first number of a sheet stood in the store of the machine.
firstAddress :: Int
firstAddress = 0o70

-- | So many numbers are general data: 0070 to 0107.
generalWords :: Int
generalWords = 16

-- | The address of a number of the sheet, which are counted from 1.
address :: Int -> Text
address number = Text.justifyRight 4 '0' (Text.pack (showOct (firstAddress + number - 1) ""))
