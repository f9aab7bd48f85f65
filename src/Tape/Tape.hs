-- | Tape: rows of holes. Each row is one byte; bit k−1 is set for a hole in track k.
module Tape.Tape
  ( Tape (..),
    rowCount,
    metres,
  )
where

import Base.Quantity (Mm (..))
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine

-- | Rows of a punched tape in order, one byte each. For a machine that reads a text instead of a
-- tape, these are the bytes of the text.
newtype Tape = Tape ByteString
  deriving newtype (Eq)
  deriving stock (Show)

-- | Number of rows of a tape, or of bytes of a text.
rowCount :: Tape -> Int
rowCount (Tape rows) = ByteString.length rows

-- | Length of a tape in metres: the number of rows times the distance between two rows. 'Nothing'
-- if the machine reads a text, which has no such distance.
metres :: Machine -> Tape -> Maybe Double
metres machine tape = case Machine.pitch (Machine.medium machine) of
  Nothing -> Nothing
  Just (Mm pitch) -> Just (fromIntegral (rowCount tape) * pitch / 1000)
