{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Errors and warnings that concern files and the command line. Errors in programs and machine
-- descriptions are defined in the folders of the compiler passes that find them.
module Cli.Error
  ( Error (..),
    Warning (..),
    toReport,
    reason,
    warningReport,
  )
where

import Base.Decimal qualified as Decimal
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.BuiltIn qualified as BuiltIn
import Machine.Controller qualified as Controller
import Machine.Machine (MachineName (..))
import Machine.Machine qualified as Machine
import Pulse.FramePath (AskedFeed, feedText, roundedDown)
import Report.Report (Report (..), ReportPlace (..), report)
import Report.Report qualified as Report
import Tape.FrameRecord (RecordObstacle (..))

-- | Error of a file or of the command line.
data Error
  = -- | The file named in the report's heading cannot be read, for the given reason.
    CannotRead Text
  | -- | A file cannot be written. The arguments: its path, the reason.
    CannotWrite Text Text
  | -- | The output path is not a folder, and there are so many files.
    NoFolder Text Int
  | -- | A file is not UTF-8 text.
    NotUtf8
  | -- | The command line names no machine for a tape. The list contains the names of the built-in
    -- machines, for the hint.
    NoMachineForTape [Text]
  | -- | The output would replace this file: the program, a program or table that it imports, or one
    -- of its machine descriptions.
    OverwritesProgram Text
  | -- | Several tapes would be written to this path; @-@ is standard output.
    OneForSeveral Text
  | -- | The range of the command line lies beyond the end of the tape. The arguments: the unit in
    -- which the range counts (frame, row or line), and the count of these units on the tape.
    NothingInRange Text Int
  | -- | The tape of this machine is a text, so there is nothing to draw.
    NotPunched Text
  | -- | The frames of this machine have no record in letters and digits.
    NoRecord Text RecordObstacle
  | -- | No program that converts drawings is installed.
    NoRenderer
  | -- | No installed program could convert the drawing: the name of the last one, and what it said.
    RendererFails Text
  | -- | The name of the file for a drawing ends in this, the ending of another form. The second
    -- text lists the endings that it may have.
    NoSuchForm Text Text
  | -- | The command line gives a value to the parameter of this name, but the program is an input
    -- sheet, which has no parameters.
    SheetAssigned Text
  | -- | An input sheet cannot be formatted.
    SheetLaidOut
  | -- | No description says how this machine's controller works.
    NoController Text
  | -- | The model of this machine's controller makes no pulses.
    NoPulses Text
  | -- | This machine's controller has no dispatcher.
    NoDispatcher Text
  | -- | The switch that corrects the feed has no such position: the position, and those that it
    -- has.
    NoSuchOverride Int [Int]
  | -- | The control has no switch with this number: the number, and the count of its switches.
    NoSuchSwitch Int Int
  | -- | The command line sets the switch with this number twice.
    SwitchSetTwice Int
  | -- | The controller stops before a frame that it cannot run: the number of the frame, its feed,
    -- and the largest feed that it can run there.
    FeedTooHigh Int AskedFeed AskedFeed
  | -- | A frame switches cutter compensation on, but the switch for the radius is not set: the
    -- number of the frame, and that of the switch.
    SwitchMissing Int Int
  | -- | The controller stops before a frame under cutter compensation: its number, and the reason.
    CompensationFails Int Text
  | -- | Another number of files than the program has: the count of files on the command line, and
    -- the names of the files that belong to the program.
    WrongFileCount Int [Text]
  | -- | The page of the preview cannot be served, for the given reason.
    CannotListen Text
  | -- | The preview should follow standard input.
    NothingToFollow
  | -- | No report has the code that the user asks about. The arguments: this code as the user wrote
    -- it, and similar codes that exist, for the hint.
    UnknownCode Text [Text]
  deriving stock (Eq, Show)

-- | Warning about the command line.
data Warning
  = -- | The tape is written without verification.
    Unproven
  | -- | The text for a modern control has no beginning that could be proven. The name of the
    -- machine.
    BeginningUnproven Text
  deriving stock (Eq, Show)

-- | The report of an error.
toReport :: Error -> Report
toReport err = case err of
  CannotRead why -> wrong "E0801" InFile ("the file cannot be read: " <> why)
  CannotWrite path why -> wrong "E0802" InFile ("cannot write " <> path <> ": " <> why)
  NoFolder path count ->
    (wrong "E0802" InFile ("cannot write into " <> path <> ": there is no such folder"))
      { hints =
          [ "There are " <> Decimal.whole count
              <> " files, one for each tool or machine: name an \
                 \existing folder, or leave -o out to have them beside the program."
          ]
      }
  NotUtf8 ->
    (wrong "E0803" InFile "the file is not UTF-8 text")
      { hints = ["Save it as UTF-8 in your editor."]
      }
  NoMachineForTape known ->
    (wrong "E0804" InFile "no machine is chosen")
      { hints =
          [ "Name the machine of this tape on the command line: -t NAME. The machines are: "
              <> Text.intercalate ", " known
              <> "."
          ]
      }
  OverwritesProgram path ->
    (wrong "E0807" InFile ("the output would replace " <> path <> ", from which it is made"))
      { hints = ["Give the output another name: -o FILE."]
      }
  OneForSeveral place ->
    ( wrong
        "E0811"
        InFile
        ("several tapes would go to " <> (if place == "-" then "standard output" else place))
    )
      { hints =
          [ if place == "-"
              then "Leave -o out, or name a folder: then each machine has a file of its own."
              else
                "Two of the machines have one name: give one of them another, or compile for \
                \one after the other with -o."
          ]
      }
  NothingInRange counted count ->
    (wrong "E0812" InFile ("the tape has no such " <> counted))
      { hints =
          [ "It has "
              <> Decimal.whole count
              <> " "
              <> counted
              <> (if count == 1 then "." else "s.")
          ]
      }
  NotPunched machine ->
    (wrong "E0819" InFile ("the tape of " <> machine <> " is a text, without holes"))
      { hints = ["Leave -o out: then its lines are printed with their meaning."]
      }
  NoRecord machine obstacle ->
    (wrong "E0824" InFile ("the frames of " <> machine <> " have no record in letters and digits"))
      { message =
          [ case obstacle of
              LinesOfFile -> "The control reads the lines of a file."
              NoAddress -> "Their words have no letters; the place of a word gives its meaning."
              HolesBesideDigits -> "Holes beside the digits have a meaning of their own."
          ],
        hints =
          [ case obstacle of
              LinesOfFile -> "Write the file: partc compile. Or leave --record out for the table."
              NoAddress -> noRows
              HolesBesideDigits -> noRows
          ]
      }
  NoRenderer ->
    (wrong "E0820" InFile "no program that makes PNG or PDF of a drawing is installed")
      { hints =
          [ "Install rsvg-convert: apt-get install librsvg2-bin. Or take Inkscape or Chromium.",
            "Or write SVG: give the output a name that ends in .svg."
          ]
      }
  RendererFails why ->
    (wrong "E0820" InFile ("the drawing could not be converted: " <> why))
      { hints = ["Write SVG: give the output a name that ends in .svg."]
      }
  NoSuchForm ending known ->
    (wrong "E0823" InCommandLine ("a drawing cannot be written as ‘" <> ending <> "’"))
      { hints = ["Give the output a name that ends in " <> known <> "."]
      }
  CannotListen why ->
    (wrong "E0821" InCommandLine ("the page cannot be served: " <> why))
      { hints = ["Leave --port out: then any free port is taken."]
      }
  NothingToFollow ->
    (wrong "E0822" InFile "standard input cannot be followed")
      { hints = ["Name the file of the program or of the tape."]
      }
  SheetAssigned name ->
    (wrong "E0913" InFile ("an input sheet has no parameters, so ‘" <> name <> "’ cannot be set"))
      { hints = ["Make a program of it with partc import, and a param in that."]
      }
  SheetLaidOut ->
    (wrong "E0914" InFile "an input sheet is no part program and has no layout")
      { hints = ["partc import makes a program of it."]
      }
  NoController machine ->
    (wrong "E0815" InFile ("the description of " <> machine <> " has no section ‘controller’"))
      { hints = ["Add the section to the description; docs/new-machine.md says how."]
      }
  NoDispatcher machine ->
    (wrong "E0817" InFile ("the controller of " <> machine <> " has no dispatcher"))
      { hints = ["Only a controller with a feed integrator has one: n55, for example."]
      }
  NoPulses machine ->
    (wrong "E0815" InFile ("the model of the controller of " <> machine <> " makes no pulses"))
      { hints =
          [ "Leave --pulses and --speed out, or take a machine whose pulses are known: "
              <> Text.intercalate ", " pulseMachines
              <> "."
          ]
      }
  WrongFileCount count names ->
    ( wrong
        "E0818"
        InFile
        ( "the program has "
            <> Decimal.whole (length names)
            <> (if length names == 1 then " file" else " files")
            <> ", and the command line names "
            <> Decimal.whole count
        )
    )
      { hints =
          [ "Name all its files in the order in which they are run: "
              <> Text.intercalate ", " names
              <> "."
          ]
      }
  NoSuchOverride n positions ->
    ( wrong
        "E0816"
        InFile
        ("the control cannot run the feeds at " <> Decimal.whole n <> " percent")
    )
      { hints =
          [ if null positions
              then "This controller has no switch for it."
              else
                "The switch has the positions "
                  <> Text.intercalate ", " (map Decimal.whole positions)
                  <> "."
          ]
      }
  NoSuchSwitch n count ->
    ( wrong
        "E0816"
        InFile
        ("the control has no switch " <> Decimal.whole n <> " for the radius of a cutter")
    )
      { hints =
          [ if count == 0
              then "The machine's control has no such switches; leave --switch out."
              else "Its switches have the numbers 1 to " <> Decimal.whole count <> "."
          ]
      }
  SwitchSetTwice n ->
    (wrong "E0816" InFile ("switch " <> Decimal.whole n <> " is set twice"))
      { hints = ["Leave one of the two --switch options out."]
      }
  FeedTooHigh n asked most ->
    ( wrong
        "E0602"
        InFile
        ( "frame "
            <> Decimal.whole n
            <> " asks for "
            <> feedText asked
            <> ", which is too fast for the controller"
        )
    )
      { hints =
          ["The largest feed that it can run there is " <> feedText (roundedDown most) <> "."]
      }
  SwitchMissing n k ->
    ( wrong
        "E0602"
        InFile
        ( "frame "
            <> Decimal.whole n
            <> " switches compensation on with switch "
            <> Decimal.whole k
            <> ", which is not set"
        )
    )
      { hints = ["Set the cutter's radius in mm: --switch " <> Decimal.whole k <> "=5"]
      }
  CompensationFails n why ->
    ( wrong
        "E0602"
        InFile
        ("the controller stops before frame " <> Decimal.whole n <> ", which " <> why)
    )
      { hints = ["Set a smaller radius, or punch a tape with longer elements."]
      }
  UnknownCode code close ->
    (wrong "E0809" InFile ("no report has the code ‘" <> code <> "’"))
      { hints =
          ["Did you mean " <> Text.intercalate " or " close <> "?" | not (null close)]
            <> ["partc explain alone lists all codes."]
      }
  where
    wrong = report Report.Error
    noRows = "Leave --record out for the table. Or print the rows of the tape: partc tape."

-- | The reason why a file cannot be read, without a report code and without the name of the file.
-- It completes the sentence of another report, such as the report on an @import@ statement.
reason :: Error -> Text
reason err = case err of
  CannotRead why -> why
  _ -> "the file is not UTF-8 text; save it as UTF-8 in your editor"

-- | The report of a warning.
warningReport :: Warning -> Report
warningReport warning = case warning of
  Unproven ->
    report Report.Warning "W0801" InFile "the tape is written without a proof (--no-verify)"
  BeginningUnproven machine ->
    ( report
        Report.Warning
        "W0802"
        InFile
        ("the proof for " <> machine <> " covers the path of the cutter only")
    )
      { message = ["The way to the start, the tool length and the path mode are not in the file."],
        hints = ["Compile for the control itself, such as linuxcnc-mill or grbl."]
      }

-- | The names of the built-in machines whose controllers make pulses.
pulseMachines :: [Text]
pulseMachines =
  [ name
    | m <- BuiltIn.machines,
      Just control <- [Machine.controller m],
      Controller.makesPulses control,
      let MachineName name = Machine.name m
  ]
