-- | Tape: rows of holes. Each row is one byte; bit k−1 is set for a hole in track k.
module Tape.Tape
  ( Tape (..),
    rowCount,
    metres,
    punchingTime,
  )
where

import Base.Quantity (Mm (..), Seconds (..))
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

-- | Least time in which a tape can be punched: the number of rows divided by the highest speed of
-- the punch. 'Nothing' if the machine reads a text, or if the speed of its punch is not known.
punchingTime :: Machine -> Tape -> Maybe Seconds
punchingTime machine tape = case (Machine.pitch medium, Machine.punchRate medium) of
  (Just _, Just rate) -> Just (Seconds (60 * fromIntegral (rowCount tape) / rate))
  _ -> Nothing
  where
    medium = Machine.medium machine
