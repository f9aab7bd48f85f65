{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Errors and warnings of the step from the toolpath to frames: requests of the program that a
-- machine cannot carry out, or carries out differently.
--
-- The constructors hold regions and facts. Words appear only in 'toReport' and 'warningReport'.
module Frame.Error
  ( Error (..),
    Warning (..),
    CommandKind (..),
    toReport,
    warningReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Feed (..), LengthUnit (..), Mm (..), plus, times)
import Base.Region (Region)
import Data.Maybe (isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.TapError (TapFault)
import Frame.TapError qualified as TapError
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Axis, Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), ReportPlace (..), report)
import Report.Report qualified as Report
import Toolpath.ErrorFix qualified as ErrorFix

-- | Reason why no frames are made. Every error has the region of the part program that causes it.
data Error
  = -- | a feed along the path for which the machine has no code: the feed asked for, and the lowest
    -- and the highest feed of the machine
    FeedOutOfRange Region Feed Feed Feed
  | -- | a feed for one turn of the spindle for which the machine has no code: the lowest and the
    -- highest feed of the machine for one turn
    TurnFeedOutOfRange Region Mm Mm
  | -- | a feed for one turn of the spindle, on a machine that needs a feed per minute, where the
    -- speed of the spindle is not known
    TurnFeedUnknown Region
  | -- | a constant cutting speed, on a machine that has none
    NoCuttingSpeed Region
  | -- | a feed for which the leading axis of a frame, the axis with the most pulses, would need a
    -- frequency that the machine does not have. The arguments are the feed asked for, and the
    -- frequency that it would need, in pulses per second. Then come the lowest and the highest
    -- frequency of the machine, each with the feed that it gives along an axis
    FrequencyOutOfRange Region Feed Double (Double, Feed) (Double, Feed)
  | -- | a point with a coordinate that exceeds the given limit in mm
    OutOfReach Region Point Mm
  | -- | a milling statement in which the sum of the tolerance and one pulse is not below the radius
    -- of the cutter: the tolerance and the radius in mm, and the region of the tolerance
    ToleranceTooLarge Region Mm Mm Region
  | -- | a number of a command that is too high for the machine, and the highest number that the
    -- machine has. This highest number is 0 if the machine has no such command
    NoSuchCommand Region CommandKind Int Int
  | -- | a command at which the machine has to wait, and for which it has no word
    CannotWait Region CommandKind
  | -- | more than the given number of frames, the largest that is allowed
    TooManyFrames Region Int
  | -- | more than the given number of contours, the largest that is allowed. The region is that of
    -- the first contour beyond this number
    TooManyContours Region Int
  | -- | a move along an axis that the machine does not have
    NoSuchAxis Region Axis
  | -- | a position in mm on an axis that does not fit its field, and the largest position that fits
    PositionOutOfField Region Axis Mm Mm
  | -- | a request for cutter compensation on a control without it
    NoCompensation Region
  | -- | a cutter diameter in mm that the word for it cannot hold
    DiameterOutOfRange Region Mm
  | CannotTap Region TapFault
  deriving stock (Eq, Ord, Show)

-- | Difference between a request of the program and the frames.
data Warning
  = -- | the feed asked for, and the lowest and the highest feed that the frames get
    FeedDiffers Region Feed Feed Feed
  | -- | a start that is not in whole pulses: the start in the program, and the nearest position in
    -- whole pulses, both in mm, and the height of the start
    StartRounded Region Point Point Mm
  | -- | a move in z on a machine whose historical source does not mention moves in z
    HeightUncertain Region
  | -- | a command for which the machine has no word, so that the operator has to carry it out
    ManualCommand Region CommandKind
  | -- | spindle speeds in turns per minute: the one asked for, the one that the machine gives, and
    -- the lowest and the highest that it has, if it has a table of them
    SpindleSpeedDiffers Region Double Double (Maybe (Double, Double))
  | -- | a spindle command without the speed that its word needs
    SpindleSpeedMissing Region
  | -- | frames between two feed moves that are not read in time, so that the machine stands still:
    -- the number of the first one, whose region this is, and how many there are
    ReaderTooSlow Region Int Int
  deriving stock (Eq, Ord, Show)

-- | Kind of a command.
data CommandKind
  = SpindleCommand
  | CoolantCommand
  | ToolCommand
  | StopCommand
  | DwellCommand
  | -- | every other command, by its number
    AuxiliaryCommand
  deriving stock (Eq, Ord, Show)

-- | Report of an error; @machine@ is the machine for which the program is compiled.
toReport :: LengthUnit -> Machine -> Error -> Report
toReport unit machine err = case err of
  FeedOutOfRange region asked lowest highest ->
    ( report
        Report.Error
        "E0501"
        (InSource region)
        (machineName machine <> " has no feed of " <> feed unit asked)
    )
      { message = ["Its feeds go from " <> feed unit lowest <> " to " <> feed unit highest <> "."],
        fixes =
          [ if asked > highest
              then feedFix "Write its largest feed" region (roundedTo unit floor highest)
              else feedFix "Write its lowest feed" region (roundedTo unit ceiling lowest)
          ],
        hints = perTurn unit asked
      }
  TurnFeedOutOfRange region (Mm lowest) (Mm highest) ->
    (report Report.Error "E0501" (InSource region) (machineName machine <> " has no such feed"))
      { message =
          [ "Its feeds for one turn of the spindle go from "
              <> Decimal.short 6 lowest
              <> " to "
              <> Decimal.short 6 highest
              <> " mm/rev."
          ]
      }
  TurnFeedUnknown region ->
    ( report
        Report.Error
        "E0520"
        (InSource region)
        "the speed of the spindle for this feed is not known"
    )
      { message = [machineName machine <> " takes feeds in mm/min, so mm/rev needs the speed."],
        hints = ["Write the speed before the cut: ‘spindle cw 800 rpm’, or a feed in mm/min."]
      }
  CannotTap region fault -> TapError.toReport unit (machineName machine) region fault
  NoCuttingSpeed region ->
    (report Report.Error "E0521" (InSource region) (machineName machine <> " has no cutting speed"))
      { message = ["Its spindle turns at the same speed until the program changes it."],
        hints = ["Write the speed of the spindle, as in ‘spindle cw 800 rpm’."]
      }
  FrequencyOutOfRange region asked needed (low, lowFeed) (high, highFeed) ->
    ( report
        Report.Error
        "E0501"
        (InSource region)
        (machineName machine <> " cannot run a feed of " <> feed unit asked <> " in this move")
    )
      { message =
          [ "The leading axis of this move would need "
              <> Decimal.short 2 needed
              <> " pulses a second, and the machine makes "
              <> Decimal.short 2 low
              <> " to "
              <> Decimal.short 2 high
              <> ".",
            "In a move along one axis these are feeds from "
              <> feed unit lowFeed
              <> " to "
              <> feed unit highFeed
              <> "."
          ],
        -- The frequency is in proportion to the feed.
        fixes =
          [ if needed > high
              then feedFix "Write the largest feed for this move" region (limited floor high)
              else feedFix "Write the lowest feed for this move" region (limited ceiling low)
          ],
        hints = perTurn unit asked
      }
    where
      limited :: (Double -> Int) -> Double -> Text
      limited towards limit =
        let Feed f = asked in roundedTo unit towards (Feed (f * limit / needed))
  OutOfReach region p limit ->
    ( report
        Report.Error
        "E0502"
        (InSource region)
        ("the cutter would go to " <> Vec.toText unit 4 p <> ", further than any machine reaches")
    )
      { message = ["Coordinates may be up to " <> Decimal.inUnit unit limit <> "."],
        hints = ["Check the units and the decimal points of the numbers."]
      }
  ToleranceTooLarge region tolerance radius written ->
    ( report
        Report.Error
        "E0504"
        (InSource region)
        ( "a tolerance of "
            <> Decimal.inUnit unit tolerance
            <> " is too large for a cutter of radius "
            <> Decimal.inUnit unit radius
        )
    )
      { message =
          [ "The tolerance and one pulse ("
              <> Decimal.mm (Machine.planeResolution machine)
              <> ") together have to be less than the radius of the cutter. Otherwise the proof \
                 \could not tell a good part from a bad one."
          ],
        others = [Label written "the tolerance is written here"],
        fixes =
          [ Fix.proposed
              (Fix.exchange ("Write a smaller tolerance: " <> text <> ".") written text)
            | usual < plus radius (times (-1) (Machine.planeResolution machine)),
              let text = Decimal.inUnit unit usual
          ],
        hints = ["Take a larger cutter."]
      }
  NoSuchCommand region kind n highest ->
    ( report
        Report.Error
        "E0505"
        (InSource region)
        (machineName machine <> " has no " <> numbered kind <> " " <> Decimal.whole n)
    )
      { message =
          [ if highest == 0
              then "It has none at all."
              else "Its tape holds the numbers up to " <> Decimal.whole highest <> "."
          ],
        fixes =
          [ Fix.proposed (Fix.exchange ("Write its highest one: " <> text <> ".") region text)
            | kind == AuxiliaryCommand,
              highest > 0,
              let text = "aux " <> Decimal.whole highest
          ],
        hints =
          [ maybe "Leave it out, or compile for another machine." (\c -> "Write " <> c <> ".") meant
            | highest == 0,
              let meant = if kind == AuxiliaryCommand then commandOf n else Nothing
          ]
      }
  CannotWait region kind ->
    ( report
        Report.Error
        "E0510"
        (InSource region)
        ("the tape of " <> machineName machine <> " cannot hold " <> subjectOf kind)
    )
      { message = ["The machine would run on at a place at which it has to wait."],
        fixes = [Fix.proposed (Fix.removal "Leave it out." region)],
        hints =
          [ "Write an auxiliary command that the machine is wired for: aux 1"
            | not (null (Machine.auxiliary (Machine.commandWords machine)))
          ]
      }
  TooManyContours region limit ->
    ( report
        Report.Error
        "E0506"
        (InSource region)
        ("the program machines more than " <> Decimal.whole limit <> " contours")
    )
      { message =
          [ "A program for "
              <> machineName machine
              <> " may machine no more than "
              <> Decimal.whole limit
              <> " contours."
          ],
        controlStop = Just "10746",
        hints = ["Make two programs, the second of which begins where the first one ends."]
      }
  NoSuchAxis region axis ->
    ( report
        Report.Error
        "E0507"
        (InSource region)
        (machineName machine <> " has no axis " <> axisName axis)
    )
      { message = ["The cutter would move in " <> axisName axis <> " here."],
        hints =
          [ "Compile for a machine that has this axis: "
              <> Text.intercalate
                ", "
                [ machineName m
                  | m <- BuiltIn.machines,
                    isJust (Machine.axisForm m axis) && axis `elem` Machine.drivenAxes m
                ]
              <> "."
          ]
      }
  PositionOutOfField region axis position limit ->
    ( report
        Report.Error
        "E0508"
        (InSource region)
        ( "a frame of "
            <> machineName machine
            <> " cannot hold the position "
            <> axisName axis
            <> " = "
            <> Decimal.inUnit unit position
        )
    )
      { message = ["It holds positions up to " <> Decimal.inUnit unit limit <> "."],
        hints =
          [ "Check the units and the decimal points of the numbers, or put the zero nearer to \
            \the part."
          ]
      }
  NoCompensation region ->
    ( report
        Report.Error
        "E0509"
        (InSource region)
        (machineName machine <> " has no cutter compensation")
    )
      { message = ["The frames of its tape have no word for it."],
        fixes = [ErrorFix.compensationFix region]
      }
  DiameterOutOfRange region diameter ->
    ( report
        Report.Error
        "E0509"
        (InSource region)
        ( "the tape of "
            <> machineName machine
            <> " cannot hold a cutter diameter of "
            <> Decimal.inUnit unit diameter
        )
    )
      { message =
          [ "The number has more digits than its word, or the word does not hold it to one pulse, "
              <> Decimal.mm (Machine.planeResolution machine)
              <> "."
          ],
        fixes = [ErrorFix.compensationFix region]
      }
  TooManyFrames region limit ->
    ( report
        Report.Error
        "E0503"
        (InSource region)
        ("the tape would have more than " <> Decimal.whole limit <> " frames")
    )
      { hints =
          [ "Look for a coordinate in a wrong unit, or for a loop that runs too often.",
            "Or allow a larger tolerance, or make several programs of it."
          ]
      }

-- | Report of a warning about frames. @machine@ is the machine for which the program is compiled.
warningReport :: LengthUnit -> Machine -> Warning -> Report
warningReport unit machine warning = case warning of
  FeedDiffers region asked lowest highest ->
    ( report
        Report.Warning
        "W0501"
        (InSource region)
        ( machineName machine
            <> " runs this feed at "
            <> ( if feed unit lowest == feed unit highest
                   then feed unit lowest
                   else feed unit lowest <> " to " <> feed unit highest
               )
        )
    )
      { message = ["The program asks for " <> feed unit asked <> "; " <> reason <> "."],
        fixes =
          [ feedFix "Write the feed that the machine runs" region (exactFeed unit lowest)
            | feed unit lowest == feed unit highest,
              Machine.feedMeasure (Machine.feeds machine) == Machine.AlongPath
          ]
      }
  StartRounded region asked given z ->
    ( report
        Report.Warning
        "W0502"
        (InSource region)
        ("the cutter cannot start at " <> Vec.toText unit 4 asked <> ": it is between two pulses")
    )
      { message =
          [ "The tape is computed for a start at "
              <> Vec.toText unit 4 given
              <> " (a pulse is "
              <> Decimal.mm (Machine.planeResolution machine)
              <> ")."
          ],
        fixes =
          [ Fix.proposed (Fix.exchange ("Write this start: " <> text <> ".") region text)
            | let text = "from " <> startText unit given z
          ]
      }
  HeightUncertain region ->
    ( report
        Report.Warning
        "W0503"
        (InSource region)
        (machineName machine <> " is not known to move in z")
    )
      { message =
          [ "The document that describes it mentions moves in x and y only. The tape holds the \
            \moves in z, but the machine may ignore them."
          ],
        hints =
          [ "Run the tape without a part first. If nothing moves in z, set the height by hand, and \
            \leave the depths and the third coordinates out."
          ]
      }
  ManualCommand region kind ->
    ( report
        Report.Warning
        "W0504"
        (InSource region)
        ("the tape of " <> machineName machine <> " cannot hold " <> subjectOf kind)
    )
      { message =
          [ "The operator has to do it by hand here."
              <> ( if kind == ToolCommand
                     then
                       " The tape does not wait for it: stop the machine, or give the next tool \
                       \a tape of its own."
                     else ""
                 )
          ],
        hints =
          [ "If the machine is wired for it, write an auxiliary command: aux 1"
            | kind /= ToolCommand,
              not (null (Machine.auxiliary (Machine.commandWords machine)))
          ]
      }
  SpindleSpeedDiffers region asked given range ->
    ( report
        Report.Warning
        "W0505"
        (InSource region)
        (machineName machine <> " turns the spindle at " <> turns given)
    )
      { message =
          [ "The program asks for "
              <> turns asked
              <> ", and the machine has no speed nearer to it."
          ]
            <> [ "Its speeds go from "
                   <> Decimal.short 1 low
                   <> " to "
                   <> Decimal.short 1 high
                   <> " turns a minute."
                 | Just (low, high) <- [range]
               ],
        hints = ["Write " <> Decimal.short 1 given <> " rpm, if this speed is meant."]
      }
  SpindleSpeedMissing region ->
    ( report
        Report.Warning
        "W0506"
        (InSource region)
        ("‘spindle’ needs a speed on " <> machineName machine)
    )
      { message = ["So the tape does not start the spindle here."],
        hints = ["Write the speed, for example: spindle cw 800 rpm"]
      }
  ReaderTooSlow region n count ->
    ( report
        Report.Warning
        "W0507"
        (InSource region)
        (machineName machine <> " stands still within a cut, because a frame is read late")
    )
      { message =
          [ "The frame before frame "
              <> Decimal.whole n
              <> " takes less time than the reading of frame "
              <> Decimal.whole n
              <> ".",
            if count == 1
              then "This is the only such frame. The cutter may leave a mark there."
              else
                "There are "
                  <> Decimal.whole count
                  <> " such frames. The cutter may leave a mark at each."
          ],
        hints =
          [ "Allow a larger tolerance, which makes the frames longer"
              <> ( if Machine.arcs machine == Machine.NoArcs
                     then ", or compile for a machine with arcs."
                     else "."
                 )
          ]
      }
  where
    reason =
      case (Machine.feedMeasure (Machine.feeds machine), Machine.rule (Machine.feeds machine)) of
        (Machine.AlongPath, Machine.NotAbove) ->
          "the machine runs the largest of its feeds that is not above it"
        (Machine.AlongPath, Machine.Nearest) -> "the machine runs the nearest of its feeds"
        (Machine.LeadingAxis, _) -> "the feeds of this machine are steps along the leading axis"
    turns n = Decimal.short 1 n <> " turns a minute"

-- | The hint for a feed that is so low that it may be meant for one turn of the spindle.
perTurn :: LengthUnit -> Feed -> [Text]
perTurn unit (Feed f) =
  [ "A feed without a unit is in "
      <> Decimal.unitText unit
      <> "/min. Write "
      <> Decimal.unitText unit
      <> "/rev for a feed for one turn of the spindle."
    | f < 2
  ]

-- | Fix that writes another feed.
feedFix :: Text -> Region -> Text -> Fix
feedFix what region text = Fix.proposed (Fix.exchange (what <> ": " <> text <> ".") region text)

-- | Text of a feed, rounded to 0.01 mm/min or 0.001 in/min in the direction @towards@.
roundedTo :: LengthUnit -> (Double -> Int) -> Feed -> Text
roundedTo unit towards (Feed f) = Decimal.feedIn unit 2 (Feed (fromIntegral n / steps))
  where
    steps = Decimal.stepsPerMm unit / 10
    nearest = round (f * steps) :: Int
    n = if abs (f * steps - fromIntegral nearest) < 1e-6 then nearest else towards (f * steps)

-- | Text of a feed with all its decimals.
exactFeed :: LengthUnit -> Feed -> Text
exactFeed unit f = Decimal.exactFeedIn unit f

-- | Tolerance that is usual for milling.
usual :: Mm
usual = Mm 0.02

-- | Text of a start: its coordinates, and its height unless that is 0. Six decimals are finer than
-- any pulse.
startText :: LengthUnit -> Point -> Mm -> Text
startText unit p (Mm z) =
  "("
    <> Text.intercalate
      ", "
      ( map
          (Decimal.shortIn unit 6 . Mm)
          ( [Vec.x p, Vec.y p]
              <> [z | z /= 0]
          )
      )
    <> ")"

-- | Words for a command of a kind in a report.
subjectOf :: CommandKind -> Text
subjectOf kind = case kind of
  SpindleCommand -> "a command for the spindle"
  CoolantCommand -> "a command for the coolant"
  ToolCommand -> "a change of the tool"
  StopCommand -> "a stop"
  DwellCommand -> "a dwell"
  AuxiliaryCommand -> "this command"

-- | Noun before the number of a command in a report, as in "the machine has no tool 7".
numbered :: CommandKind -> Text
numbered kind = case kind of
  SpindleCommand -> "spindle speed"
  CoolantCommand -> "coolant command"
  ToolCommand -> "tool"
  StopCommand -> "stop"
  DwellCommand -> "dwell"
  AuxiliaryCommand -> "auxiliary command"

-- | Name of an axis in a report: x, y or z.
axisName :: Axis -> Text
axisName axis = Machine.contentName (Machine.Along axis)

-- | Name of a machine.
machineName :: Machine -> Text
machineName machine = let MachineName name = Machine.name machine in name

-- | Feed with its unit, for a report.
feed :: LengthUnit -> Feed -> Text
feed unit f = Decimal.feedIn unit 2 f

-- | The statement of the language for the command that G-code writes as M and this number (ISO
-- 6983).
commandOf :: Int -> Maybe Text
commandOf n = case n of
  3 -> Just "spindle cw and a speed: spindle cw 1000 rpm"
  4 -> Just "spindle ccw and a speed: spindle ccw 1000 rpm"
  5 -> Just "spindle off"
  6 -> Just "change, a number and a cutter: change 2 mill(diameter 8 mm)"
  7 -> Just "coolant on"
  8 -> Just "coolant on"
  9 -> Just "coolant off"
  _ -> Nothing
