-- | The record of a frame: its symbols in letters and digits, as a program is written by hand
-- before it is punched. The NC course writes a frame of the Контур-3П-68 as @9Д56000П27Ш08Н@.
--
-- A frame has a record if its symbols alone say everything. That is so if every word has an address
-- and no meaning is in the service track, whose holes are beside the symbols. The end of a line,
-- which ends a frame of some machines, is left out.
module Tape.FrameRecord
  ( RecordObstacle (..),
    obstacle,
    records,
  )
where

import Base.PulseVector (Pulses3)
import Data.Maybe (isJust, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Frame)
import Machine.Machine (Machine, NumberForm (service), Word' (address, form))
import Machine.Machine qualified as Machine
import Tape.FrameWriter qualified as FrameWriter
import Tape.Layout (MarkedRow (holes), PreparedLayout)
import Tape.Layout qualified as Layout
import Tape.ModalState (State)
import Tape.ModalState qualified as ModalState
import Tape.Symbol qualified as Symbol

-- | A reason why the frames of a machine have no records.
data RecordObstacle
  = -- | The control reads a file of lines, which has more in it than its frames.
    LinesOfFile
  | -- | A word has no address, because its place in the frame gives its meaning.
    NoAddress
  | -- | Holes beside the digits of a word have a meaning of their own.
    HolesBesideDigits
  deriving stock (Eq, Show)

-- | The reason why the frames of a machine have no records; Nothing if they have them.
obstacle :: Machine -> Maybe RecordObstacle
obstacle machine
  | isJust (Machine.programForm machine) = Just LinesOfFile
  | any (Text.null . address) (Machine.wordsOf machine) = Just NoAddress
  | not (all (null . service . form) (Machine.wordsOf machine)) = Just HolesBesideDigits
  | otherwise = Nothing

-- | The records of frames, in order, for a machine without 'obstacle'. The cutter begins at the
-- position @start@, in pulses.
records :: Machine -> Pulses3 -> [Frame] -> [Text]
records machine start frames =
  go (ModalState.initial (ModalState.changesHeight frames) start) frames
  where
    layout = Layout.fromMachine machine
    go state todo = case todo of
      [] -> []
      f : more -> record layout state f : go (Layout.after layout state f) more

-- | The record of one frame. @state@ is the modal state before the frame.
record :: PreparedLayout -> State -> Frame -> Text
record layout state frame =
  Text.filter
    (`notElem` ['\n', '\r'])
    (Text.pack (mapMaybe symbolOf (FrameWriter.frameRows layout state frame)))
  where
    symbolOf row = Symbol.symbolAt (Layout.symbols layout) (holes row)
