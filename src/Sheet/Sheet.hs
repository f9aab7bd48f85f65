-- | The input sheet of the Minsk-22 system as data, with the meaning of every number
-- (docs/input-sheet.md).
--
-- A piece is a curve with its recalculations, each of which shifts the curve along its normal. The
-- cipher of a piece has a digit 1, 2, 4 or 6 for each recalculation. An array is a sequence of
-- linked pieces with the points after them.
--
-- Numbers have the units of the sheet: mm, degrees and mm\/min. Every number keeps its region in
-- the text, so that reports can point at it. The words of a sheet are numbered from 1.
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

-- | A whole sheet: the general data, the approach, and the arrays.
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

-- | The general data: the numbers that hold for the whole sheet.
data General = General
  { -- | the identification number of the product, a whole number
    productCipher :: Number,
    -- | the identification number of the part, a whole number
    partCipher :: Number,
    -- | the number of the program, a whole number
    program :: Number,
    -- | diameter of the tool, mm; a cone has this diameter at its tip
    diameter :: Number,
    -- | diameter of the wheel that swivels a blade, mm; 0 for other tools
    gear :: Number,
    -- | bevel of a cone, degrees: the angle between its flank and its axis; 0 for other tools
    bevel :: Number,
    -- | height of a cone, mm; 0 for other tools
    height :: Number,
    -- | largest chord error, mm
    tolerance :: Number,
    -- | the tool travels on this side of every piece; if Nothing, its centre travels on the pieces
    side :: Located (Maybe Side)
  }
  deriving stock (Eq, Show)

-- | A point in space, mm, and a feed, mm\/min. The feed is that of the move from this point to the
-- next one. The last point before an array has the feed of the array's pieces; the last point of
-- the sheet has the feed 0.
data Waypoint = Waypoint {x :: Number, y :: Number, z :: Number, feed :: Number}
  deriving stock (Eq, Show)

-- | A sequence of linked pieces: @joined@ has all pieces but the last one, @final@ is the last one.
-- @retract@ has the points to which the tool moves after the last piece, up to the next array.
data Array = Array {joined :: [LinkedPiece], final :: Piece, retract :: NonEmpty Waypoint}
  deriving stock (Eq, Show)

-- | A piece, and the link that joins it to the next piece.
data LinkedPiece = LinkedPiece Piece (Located Link)
  deriving stock (Eq, Show)

-- | A curve through points of the theoretical contour, and its recalculations. The theoretical
-- contour is the given curve from which the contours of the part are recalculated. If the cipher
-- has a digit 4, every point comes with a 'Surface': the bevel and the height of the flange there.
data Piece = Piece
  { -- | the side to which a positive distance shifts the curve
    shiftSide :: Located Side,
    -- | the recalculations in their order
    cipher :: Located [Recalculation],
    -- | the points, at least two
    rows :: NonEmpty PointRow,
    -- | the flag of the feed: True to slow down at the end of the piece
    slow :: Located Bool,
    -- | the material left on the piece, mm
    allowance :: Number,
    -- | the feed along the piece, mm\/min; without it, that of the array's pieces applies
    ownFeed :: Maybe Number
  }
  deriving stock (Eq, Show)

-- | A digit of a cipher.
data Digit = One | Two | Four | Six
  deriving stock (Eq, Show, Enum, Bounded)

-- | A recalculation of a curve: it shifts every point along the normal by a distance in mm.
data Recalculation
  = -- | Digit 1: the distance changes evenly along the curve from the first number to the second.
    Growing Number Number
  | -- | Digit 2: the distance is constant.
    Constant Number
  | -- | Digit 4: the distance is H tan μ, from the height of the flange H and the bevel μ.
    Bevelled
  | -- | Digit 6: each point has its own distance.
    Pointwise (NonEmpty Number)
  deriving stock (Eq, Show)

-- | A point, mm, and the surface of the part there; Nothing for a piece without the digit 4.
data PointRow = PointRow {px :: Number, py :: Number, surface :: Maybe Surface}
  deriving stock (Eq, Show)

-- | The bevel of the part's surface at a point, degrees, and the height of the flange there, mm.
-- The bevel is the angle between the surface and the tool axis.
data Surface = Surface {mu :: Number, flangeHeight :: Number}
  deriving stock (Eq, Show)

-- | The link that joins two neighbouring pieces.
data Link
  = -- | @+@: the pieces touch, and the direction of travel is the same on both
    Joint
  | -- | @-@: the pieces intersect
    Intersection
  | -- | an arc of this radius, mm; a positive radius is clockwise, a negative one counter-clockwise
    Rounding Double
  deriving stock (Eq, Show)

-- | Side of a curve, seen in the direction of travel.
data Side = LeftSide | RightSide
  deriving stock (Eq, Show, Enum, Bounded)

-- | All arrays of a sheet.
arrays :: Sheet -> NonEmpty Array
arrays sheet = first sheet :| others sheet

-- | All pieces of an array in order.
pieces :: Array -> NonEmpty Piece
pieces array = foldr (\(LinkedPiece p _) rest -> p <| rest) (final array :| []) (joined array)

-- | The digit that a cipher has for a recalculation.
digitOf :: Recalculation -> Digit
digitOf r = case r of
  Growing _ _ -> One
  Constant _ -> Two
  Bevelled -> Four
  Pointwise _ -> Six

-- | A digit as the sheet writes it.
digitText :: Digit -> Text
digitText digit = case digit of
  One -> "1"
  Two -> "2"
  Four -> "4"
  Six -> "6"

-- | True if the points of a piece have a surface.
hasSurface :: Piece -> Bool
hasSurface piece = isJust (surface (NonEmpty.head (rows piece)))

-- | The feed that means a rapid move: the largest number of four digits, in mm\/min.
rapidFeed :: Double
rapidFeed = 9999

-- | The largest count of arrays on a sheet. If there were more, the Minsk-22 system stopped with
-- the code 10746.
maxArrays :: Int
maxArrays = 30

-- | The address of a sheet's first number in the memory of the Minsk-22.
firstAddress :: Int
firstAddress = 0o70

-- | The count of the numbers of the general data on a sheet. They have the octal addresses 0070 to
-- 0107. The last six are unused and 0.
generalCount :: Int
generalCount = 16

-- | The octal address, in four digits, of the sheet's word @number@, counted from 1.
address :: Int -> Text
address number = Text.justifyRight 4 '0' (Text.pack (showOct (firstAddress + number - 1) ""))
