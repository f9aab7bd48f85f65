-- | The input sheet of the Minsk-22 system as data: the meaning of every number
-- (docs/input-sheet.md).
--
-- Numbers are as written: mm, degrees and mm\/min. Every number keeps its region, so that reports
-- can point at it.
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
    hasSurface,
    rapidFeed,
    maxArrays,
    generalCount,
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

-- | A whole sheet.
data Sheet = Sheet
  { general :: General,
    -- | the points up to the first array; the first one is the cutter's starting position
    approach :: NonEmpty Waypoint,
    first :: Array,
    others :: [Array]
  }
  deriving stock (Eq, Show)

-- | A number and its region.
type Number = Located Double

-- | The general data.
data General = General
  { -- | the cipher of the product, a whole number
    productCipher :: Number,
    -- | the cipher of the part, a whole number
    partCipher :: Number,
    -- | the number of the program, a whole number
    program :: Number,
    -- | of the tool, mm
    diameter :: Number,
    -- | the diameter of the wheel that swivels a blade, mm; 0 without a blade
    gear :: Number,
    -- | of a cone, degrees; 0 without a cone
    bevel :: Number,
    -- | of a cone's flank, mm; 0 without a cone
    height :: Number,
    -- | the chord error allowed, mm
    tolerance :: Number,
    -- | the side of the tool; nothing when its centre moves on the pieces
    side :: Located (Maybe Side)
  }
  deriving stock (Eq, Show)

-- | A point in space, mm, and the feed from it to the next point, mm\/min. The feed of the last
-- point of a sheet is 0.
data Waypoint = Waypoint {x :: Number, y :: Number, z :: Number, feed :: Number}
  deriving stock (Eq, Show)

-- | Linked pieces, and the points after them.
data Array = Array {joined :: [LinkedPiece], final :: Piece, retract :: NonEmpty Waypoint}
  deriving stock (Eq, Show)

-- | A piece, and its link to the next piece.
data LinkedPiece = LinkedPiece Piece (Located Link)
  deriving stock (Eq, Show)

-- | A curve through points of the theoretical contour, and its recalculations. When one of these
-- uses the bevel, every point has a surface; otherwise none has.
data Piece = Piece
  { -- | the side to which the distances count
    shiftSide :: Located Side,
    cipher :: Located [Recalculation],
    rows :: NonEmpty PointRow,
    -- | the flag of the feed: slow down at the end
    slow :: Located Bool,
    -- | the material left on the piece, mm
    allowance :: Number
  }
  deriving stock (Eq, Show)

-- | A digit of a cipher.
data Digit = One | Two | Four | Six
  deriving stock (Eq, Show, Enum, Bounded)

-- | A recalculation of a curve, with distances in mm.
data Recalculation
  = -- | 1: a distance that changes evenly along the curve, from one value to another
    Growing Number Number
  | -- | 2: a constant distance
    Constant Number
  | -- | 4: the distance that follows from the bevel and the height of the flange
    Bevelled
  | -- | 6: a distance for each point
    Pointwise (NonEmpty Number)
  deriving stock (Eq, Show)

-- | A point, mm, and the surface there.
data PointRow = PointRow {px :: Number, py :: Number, surface :: Maybe Surface}
  deriving stock (Eq, Show)

-- | The bevel, degrees, and the height of the flange, mm.
data Surface = Surface {mu :: Number, flangeHeight :: Number}
  deriving stock (Eq, Show)

-- | The link of two pieces.
data Link
  = -- | @+@: the pieces touch
    Joint
  | -- | @-@: they intersect
    Intersection
  | -- | an arc of this radius, mm; positive is clockwise
    Rounding Double
  deriving stock (Eq, Show)

-- | The side of the direction of travel.
data Side = LeftSide | RightSide
  deriving stock (Eq, Show, Enum, Bounded)

-- | All arrays of a sheet.
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

-- | A digit as written.
digitText :: Digit -> Text
digitText digit = case digit of
  One -> "1"
  Two -> "2"
  Four -> "4"
  Six -> "6"

-- | Tells whether the points of a piece have a surface.
hasSurface :: Piece -> Bool
hasSurface piece = isJust (surface (NonEmpty.head (rows piece)))

-- | The feed that means rapid, mm\/min: the largest number of four digits.
rapidFeed :: Double
rapidFeed = 9999

-- | The largest number of arrays in a program (control stop 10746).
maxArrays :: Int
maxArrays = 30

-- | The address of a sheet's first number in the store of the Minsk-22.
firstAddress :: Int
firstAddress = 0o70

-- | The count of general data, at the addresses 0070 to 0107.
generalCount :: Int
generalCount = 16

-- | The octal address of a number of the sheet, counted from 1.
address :: Int -> Text
address number = Text.justifyRight 4 '0' (Text.pack (showOct (firstAddress + number - 1) ""))
