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
    -- | extension of a file's name, without the point
    suffix :: Text,
    -- | number of blank rows of the leader, before the first frame, and again of the trailer, after
    -- the last one
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

-- | Treatment of blank rows between frames by a tape reader.
data Spare
  = -- | The reader counts the blank rows. Their number must be exactly the one that 'Medium' gives.
    Counted
  | -- | The reader skips blank rows, and the rows in 'skips' wherever they are. The number of blank
    -- rows must be at least the one that 'Medium' gives. If 'skips' contains the blank row, this
    -- holds for the leader and the trailer only.
    Skipped
  deriving stock (Eq, Show)

-- | Tape code: the row of holes for each symbol.
data TapeCode = TapeCode
  { codeName :: Text,
    -- | holes of each symbol, without those of the service track and the parity track; no two
    -- symbols have the same holes
    symbols :: Map Char Word8,
    -- | contribution of a symbol to the check sum of a frame; 0 for symbols that are not listed
    weights :: Map Char Int,
    -- | number of the parity track, which makes the number of holes in every row even
    evenTrack :: Maybe Int,
    -- | number of the track that contains signs and marks beside the digits
    serviceTrack :: Maybe Int,
    -- | rows that a tape reader skips, such as erased rows, which have a hole in every track
    skips :: [Word8]
  }
  deriving stock (Eq, Show)
