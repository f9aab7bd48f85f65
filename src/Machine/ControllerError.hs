{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Conflicts between the section @controller@ of a description and its other sections, and their
-- reports.
module Machine.ControllerError
  ( ControllerFault (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region)
import Data.Text (Text)
import Report.Report (Report (..), ReportPlace (..), Severity (..), quote, report)

-- | Conflict between the section @controller@ and the other sections.
data ControllerFault
  = -- | frames can describe arcs, but the interpolator makes lines only
    ArcsNotForIt
  | -- | arcs, although the pulses of x and y have different lengths
    UnequalPulses
  | -- | feeds in pulses per second of the leading axis, for another interpolator
    FrequenciesNotForIt
  | -- | words with more digits than this count
    NumberTooLong Int
  | -- | arcs without a job that computes the feed of their direction
    NoDirectionJob
  | -- | job after a command for which frames have neither a word nor bits: the name of the command
    NoSuchCommand Text
  | -- | jobs that come by the clock and need this part of the time, 1 or more
    Overloaded Double
  | -- | commands for cutter compensation with a switch, but no switch for a radius
    NoSwitches
  deriving stock (Eq, Ord, Show)

-- | Report of a conflict; the region is that of the section @controller@.
toReport :: Region -> ControllerFault -> Report
toReport region fault = case fault of
  ArcsNotForIt ->
    (wrong "a digital differential analyser makes no arcs, but the frames describe some")
      { hints = ["Write: arcs none. Or choose another interpolator."]
      }
  UnequalPulses ->
    (wrong "the controller makes arcs, but the pulses of x and y have different lengths")
      { hints = ["Give both axes the same pulse, or write: arcs none."]
      }
  FrequenciesNotForIt ->
    (wrong "the feeds are pulses per second, which only a differential analyser takes")
      { hints = ["Write in the feeds: measure mm/min"]
      }
  NumberTooLong most ->
    (wrong ("the word of an axis has more than " <> Decimal.whole most <> " digits"))
      { hints = ["The model of the controller computes with numbers of that length."]
      }
  NoDirectionJob ->
    (wrong "no job computes the feed for the direction of an arc")
      { hints = ["Add a job with, for example: request direction 16 8 cycles"]
      }
  NoSuchCommand name ->
    (wrong ("no frame can give the command " <> quote name <> ", after which a job is requested"))
      { hints = ["Take the name of a word or of bits of the frame."]
      }
  Overloaded load ->
    ( wrong
        ( "the jobs that come by the clock need "
            <> Decimal.short 0 (100 * load)
            <> " % of the time, so nothing else is ever done"
        )
    )
      { hints = ["Request them less often, or make them shorter."]
      }
  NoSwitches ->
    (wrong "the commands for cutter compensation name a switch, but the control has none")
      { hints = ["Write how many there are, for example: switches 35"]
      }
  where
    wrong = report Error "E1015" (InSource region)
