{-# OPTIONS_GHC -O0 #-}

-- | What can be wrong with files, machines and the command line.
module Cli.Error
  ( Error (..),
    Warning (..),
    toReport,
    whyNot,
    warningReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name qualified as Name
import Base.Region (Position (..), Region)
import Base.Region qualified as Region
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (Place (..), Report (..), report)
import Report.Report qualified as Report

data Error
  = -- | why
    CannotRead Text
  | -- | file and why
    CannotWrite Text Text
  | NotUtf8
  | -- | neither the program nor the command line names a machine; the machines there are
    NoMachine [Text]
  | -- | no machine for a tape; the machines there are
    NoMachineForTape [Text]
  | -- | a name that no machine has, where the program says it, the machines there are
    UnknownMachine (Maybe Region) Text [Text]
  | -- | a description that cannot be read: where the program names it, its name, why
    DescriptionMissing (Maybe Region) Text Text
  | -- | a description with mistakes: where the program names it, its name, its text, what is wrong
    DescriptionWrong (Maybe Region) Text Text [Report]
  | -- | the output would replace the program
    OverwritesProgram Text
  | -- | several tapes would go to one place
    OneForSeveral Text
  | -- | the program punches nothing
    NothingToPunch
  | -- | nothing of a tape is in the range that was asked for: what is counted, and how much of it there is
    NothingInRange Text Int
  | -- | a value for a parameter of an input sheet
    SheetAssigned Text
  | -- | an input sheet to be laid out as a program
    SheetLaidOut
  | -- | a code that no report has; the codes that may be meant
    UnknownCode Text [Text]
  deriving stock (Eq, Show)

data Warning
  = -- | the tape is written as it is
    Unproven
  deriving stock (Eq, Show)

-- | The words for it.
toReport :: Error -> Report
toReport err = case err of
  CannotRead why -> wrong "E0801" InFile ("the file cannot be read: " <> why)
  CannotWrite path why -> wrong "E0802" InFile ("cannot write " <> path <> ": " <> why)
  NotUtf8 ->
    (wrong "E0803" InFile "the file is not UTF-8 text")
      { hints = ["Save it as UTF-8 in your editor."]
      }
  NoMachine known ->
    (wrong "E0804" InFile "no machine is chosen")
      { hints = ["Say in the program: machine NAME, or on the command line: -t NAME. Machines: " <> Text.intercalate ", " known <> "."]
      }
  NoMachineForTape known ->
    (wrong "E0804" InFile "no machine is chosen")
      { hints = ["Say on the command line whose tape this is: -t NAME. Machines: " <> Text.intercalate ", " known <> "."]
      }
  UnknownMachine place name known ->
    (wrong "E0805" (maybe InFile InSource place) ("there is no machine named ‘" <> name <> "’"))
      { message = ["The machines are: " <> Text.intercalate ", " known <> "."],
        hints =
          if ".machine" `Text.isSuffixOf` name
            then ["A description stands in quotation marks: machine \"" <> name <> "\"."]
            else ["Did you mean ‘" <> n <> "’?" | n <- take 1 (Name.nearest name known)]
      }
  DescriptionMissing place file why ->
    (wrong "E0806" (maybe InFile InSource place) ("the machine’s description ‘" <> file <> "’ cannot be read: " <> why))
      { hints = ["A description is looked for beside the program that names it, or where the command line says."]
      }
  DescriptionWrong place file text reports ->
    (wrong "E0810" (maybe InFile InSource place) ("the machine’s description ‘" <> file <> "’ has mistakes"))
      { message = [placed file text r | r <- Report.sorted reports],
        hints = ["partc machines " <> file <> " shows them in full."]
      }
  OverwritesProgram path -> wrong "E0807" InFile ("the output would replace " <> path <> ", of which it is made")
  OneForSeveral place ->
    (wrong "E0811" InFile ("several tapes would go to " <> (if place == "-" then "standard output" else place)))
      { hints = [if place == "-" then "Leave -o out, or name a folder: then each machine has a file of its own." else "Two of the machines have one name: give one of them another, or compile for one after the other with -o."]
      }
  NothingToPunch ->
    (wrong "E0808" InFile "the program moves nothing, so there is no tape to punch")
      { hints = ["Mill a contour (mill NAME outside { approach … retract … }), or go somewhere (rapid, move)."]
      }
  NothingInRange counted count ->
    (wrong "E0812" InFile ("the tape has no such " <> counted))
      { hints = ["It has " <> Decimal.whole count <> " " <> counted <> (if count == 1 then "." else "s.")]
      }
  SheetAssigned name ->
    (wrong "E0913" InFile ("an input sheet has no parameters, so ‘" <> name <> "’ cannot be set"))
      { hints = ["Make a program of it with partc import, and a param in that."]
      }
  SheetLaidOut ->
    (wrong "E0914" InFile "an input sheet is no part program and has no layout")
      { hints = ["partc import makes a program of it."]
      }
  UnknownCode code close ->
    (wrong "E0809" InFile ("no report has the code ‘" <> code <> "’"))
      { hints = ["Did you mean " <> Text.intercalate " or " close <> "?" | not (null close)] <> ["partc explain alone lists all codes."]
      }
  where
    wrong = report Report.Error

-- | A report in one line, with its place in a text.
placed :: Text -> Text -> Report -> Text
placed file text r = case place r of
  InSource region ->
    let Position {line, column} = Region.position (Region.fromText file text) (Region.start region)
     in Decimal.whole line <> ":" <> Decimal.whole column <> ": " <> title r
  _ -> title r

-- | Why a file can not be had, as the end of a sentence.
whyNot :: Error -> Text
whyNot err = case err of
  CannotRead why -> why
  _ -> "the file is not UTF-8 text; save it as UTF-8 in your editor"

warningReport :: Warning -> Report
warningReport warning = case warning of
  Unproven -> report Report.Warning "W0801" InFile "the tape is written without a proof (--no-verify)"
