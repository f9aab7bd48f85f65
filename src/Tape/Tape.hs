-- | A tape: rows of holes, one byte a row, bit k−1 for a hole in track k.
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

newtype Tape = Tape ByteString
  deriving newtype (Eq)
  deriving stock (Show)

rowCount :: Tape -> Int
rowCount (Tape rows) = ByteString.length rows

-- | The length of a tape on a machine's pitch, in metres; none for a text.
metres :: Machine -> Tape -> Maybe Double
metres machine tape = case Machine.pitch (Machine.medium machine) of
  Nothing -> Nothing
  Just (Mm pitch) -> Just (fromIntegral (rowCount tape) * pitch / 1000)
