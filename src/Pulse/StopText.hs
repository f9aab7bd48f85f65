-- | Words for the stop of a run.
module Pulse.StopText
  ( stopText,
  )
where

import Base.Decimal qualified as Decimal
import Data.Text (Text)
import Machine.Controller
  ( Controller (..),
    IntegratorControl (reader),
    StepControl (stepReader),
    TapeReader (faultSignal),
  )
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (StopReason (..))

-- | Place and reason of a stop, after the word *stops*.
stopText :: Machine -> StopReason -> Text
stopText machine why = case why of
  TapeEnds
    | null (Machine.finish (Machine.commandWords machine)) -> "at the end of the tape"
    | otherwise -> "at the end of the tape, without the end of the program"
  ProgramEnds -> "at the end of the program"
  Unreadable _ ->
    "before a frame that cannot be read"
      <> maybe
        ""
        (\t -> "; the control lights ‘" <> t <> "’")
        (signal (Machine.controller machine))
  TooFast n _ _ -> "before frame " <> Decimal.whole n <> ", whose feed is too high"
  FeedHeld n -> "before frame " <> Decimal.whole n <> ", because the feed is held"
  SwitchNotSet n k ->
    "before frame " <> Decimal.whole n <> ", because switch " <> Decimal.whole k <> " is not set"
  NotCompensated n fault -> "before frame " <> Decimal.whole n <> ", which " <> fault
  where
    signal control = case control of
      Just (Stepping c) -> stepReader c >>= faultSignal
      Just (Integrating c) -> faultSignal (reader c)
      _ -> Nothing
