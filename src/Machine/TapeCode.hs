-- | The medium on which frames are punched, and the code: the row of holes for each symbol.
module Machine.TapeCode
  ( Medium (..),
    Spare (..),
    TapeCode (..),
  )
where

import Base.Quantity (Mm (..))
import Data.Map.Strict (Map)
import Data.Text (Text)
import Data.Word (Word8)

-- | Physical form of a tape, and what it contains besides frames.
data Medium = Medium
  { -- | number of tracks, 1 to 8; bit k−1 of a row is track k
    tracks :: Int,
    -- | distance between neighbouring rows; 'Nothing' for a text file
    pitch :: Maybe Mm,
    -- | width of the tape; 'Nothing' for that of the standard
    width :: Maybe Mm,
    -- | highest speed of the tape punch, in rows per minute; 'Nothing' if it is not known
    punchRate :: Maybe Double,
    -- | extension of a file's name, without the point
    suffix :: Text,
    -- | number of blank rows in the leader at the start of the tape; the trailer at its end has as
    -- many
    leader :: Int,
    -- | number of blank rows after each frame
    gap :: Int,
    -- | number of additional blank rows before the second frame, the fourth one, the sixth one and
    -- so on
    evenShift :: Int,
    spare :: Spare,
    -- | symbols between the leader and the first frame
    opening :: Text,
    -- | symbols between the last frame and the trailer
    closing :: Text
  }
  deriving stock (Eq, Show)

-- | Rule by which a tape reader treats the blank rows of a tape. 'Medium' gives their number in
-- the leader, between frames and in the trailer.
data Spare
  = -- | The reader counts the blank rows, and skips no rows. The blank rows must be exactly as many
    -- as 'Medium' gives.
    Counted
  | -- | The blank rows must be at least as many as 'Medium' gives. The reader skips any blank rows
    -- beyond this number. Anywhere on the tape it also skips the rows in 'skips'. If 'skips'
    -- contains the blank row, the minimum applies to the leader and the trailer only.
    Skipped
  deriving stock (Eq, Show)

-- | Tape code: the row of holes for each symbol.
data TapeCode = TapeCode
  { codeName :: Text,
    -- | holes of each symbol, without the hole in the parity track. The holes of a digit, a sign
    -- or a point contain none in the service track. No two symbols have the same holes.
    symbols :: Map Char Word8,
    -- | contribution of a symbol to the check sum of a frame; 0 for symbols that are not listed
    weights :: Map Char Int,
    -- | number of the parity track, which makes the number of holes in every row even
    evenTrack :: Maybe Int,
    -- | number of the service track. In the row of a digit, a hole in this track is a sign or a
    -- mark ('Machine.FrameLayout.Service')
    serviceTrack :: Maybe Int,
    -- | rows that a tape reader skips if 'spare' is 'Skipped'; for example erased rows, which have
    -- a hole in every track
    skips :: [Word8]
  }
  deriving stock (Eq, Show)
