-- | Errors that concern a program as a whole: its machine is missing, unknown or wrongly described,
-- or there is nothing to punch.
module Project.Error
  ( Error (..),
    toReport,
    argumentReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name qualified as Name
import Base.Region (Position (..), Region (..))
import Base.Region qualified as Region
import Data.Function (on)
import Data.List (nub, nubBy)
import Data.Text (Text)
import Data.Text qualified as Text
import Project.MachineDescription (DescriptionText (..))
import Project.MachineDescription qualified as MachineDescription
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), ReportPlace (..), report)
import Report.Report qualified as Report

-- | An error of a program as a whole. The region in a constructor is that of the machine's name in
-- the program. It is 'Nothing' if the command line names the machine.
data Error
  = -- | neither the program nor the command line names a machine: the names of the built-in
    -- machines, and the offset at which the program may name one
    NoMachine [Text] (Maybe Int)
  | -- | no machine has this name: the region, this name, and the names of the built-in machines
    UnknownMachine (Maybe Region) Text [Text]
  | -- | a machine description that cannot be read: the region, the name of its file, and the reason
    DescriptionMissing (Maybe Region) Text Text
  | -- | a machine description with errors: the region, the name of its file, the description, and
    -- the errors
    DescriptionWrong (Maybe Region) Text DescriptionText [Report]
  | -- | the program moves nothing, so that the tape would be empty
    NothingToPunch
  deriving stock (Eq, Show)

-- | The report of an error of a program, or of an option that names its machine.
toReport :: Error -> Report
toReport = reportWith "-t "

-- | The report of an error in the argument of a subcommand that is the name of a machine.
argumentReport :: Error -> Report
argumentReport = reportWith ""

-- | The report of an error. @option@ stands before the name of a machine on the command line.
reportWith :: Text -> Error -> Report
reportWith option err = case err of
  NoMachine known offset ->
    (wrong "E0804" InFile "the program names no machine")
      { message = ["The machines are: " <> Text.intercalate ", " known <> "."],
        fixes =
          [ Fix.proposed
              ( Fix.insertion
                  ("Write in the program: machine " <> name <> ", or another one.")
                  at
                  ("machine " <> name <> "\n")
              )
            | Just at <- [offset],
              name <- take 1 known
          ],
        hints =
          ["Write in the program: machine NAME" | null offset]
            <> ["Or name it on the command line: -t NAME"]
      }
  UnknownMachine place name known ->
    ( wrong
        "E0805"
        (maybe InCommandLine InSource place)
        ("there is no machine named ‘" <> name <> "’")
    )
      { message = ["The machines are: " <> Text.intercalate ", " known <> "."],
        fixes =
          [ if isFile
              then
                Fix.exchange
                  ("Write its description in quotation marks: machine \"" <> name <> "\"")
                  region
                  ("\"" <> name <> "\"")
              else chosen (Fix.exchange (advised <> n <> ".") region n)
            | Just region <- [place],
              n <- if isFile then [name] else similar
          ],
        hints =
          ["Write " <> option <> n <> "." | null place, not isFile, n <- take 1 similar]
            <> [ "For G-code write iso6983; docs/machines.md describes the other machines."
                 | null similar,
                   not isFile,
                   gCode `elem` known
               ]
      }
    where
      isFile = MachineDescription.isDescription name
      advised = if isGCode then "For G-code write " else "Write "
      -- Machines of the same family differ much, so the choice is left to the user.
      chosen = if isGCode || length similar > 1 then Fix.proposed else id
      similar
        | named@(_ : _) <- [n | n <- known, Text.toLower name `Text.isPrefixOf` n] = named
        | isGCode = [gCode]
        | otherwise = take 1 (Name.lookAlike name known <> Name.nearest name known)
      isGCode = gCode `elem` known && any (`Text.isPrefixOf` Text.toLower name) gCodeControls
      gCode = "iso6983"
  DescriptionMissing place file why ->
    ( wrong
        "E0806"
        (maybe InCommandLine InSource place)
        ("the machine’s description ‘" <> file <> "’ cannot be read: " <> why)
    )
      { hints =
          [ "A description is looked for in the folder of the program that names it, or in the \
            \folder that the command line gives."
          ]
      }
  DescriptionWrong place file described reports ->
    descriptionReport (maybe InCommandLine InSource place) file described reports
  NothingToPunch ->
    (wrong "E0808" InFile "the program moves nothing, so there is no tape to punch")
      { hints =
          [ "Write a statement that moves the cutter: mill, pocket, turn, drill, rapid or move."
          ]
      }
  where
    wrong = report Report.Error

-- | The beginnings of the names of controls and programs that read G-code.
gCodeControls :: [Text]
gCodeControls =
  Text.words
    "fanuc haas heidenhain siemens sinumerik mach3 mach4 linuxcnc grbl gcode g-code iso din66025 \
    \marlin okuma mazak mitsubishi centroid tormach uccnc emc fagor num cnc generic balt-system \
    \smoothie duet"

-- | The report of a machine description with errors. @at'@ is the place that names the description,
-- and @file@ is its name. The report points at the first error if the program's source contains the
-- description.
descriptionReport :: ReportPlace -> Text -> DescriptionText -> [Report] -> Report
descriptionReport at' file DescriptionText {base, text} reports =
  ( report
      Report.Error
      "E0810"
      at'
      ( "the machine’s description ‘"
          <> file
          <> "’ has mistakes"
          <> Text.concat [": " <> title r | r <- first]
      )
  )
    { others = pointed,
      message =
        concat [lineOf file text r | null pointed, r <- first]
          <> map (inOneLine file text) (drop 1 shown)
          <> ["The same is wrong at more places." | length shown < length reports],
      hints = nub (concatMap Report.remedies shown)
    }
  where
    shown = nubBy ((==) `on` title) (Report.sorted reports)
    first = take 1 shown
    pointed =
      [ Label (Region (offset + from) (offset + to)) (if Text.null words' then "here" else words')
        | Just offset <- [base],
          r <- first,
          let words' = Report.label r,
          InSource (Region from to) <- [place r]
      ]

-- | The line of a description to which a report points, with its number.
lineOf :: Text -> Text -> Report -> [Text]
lineOf file text r = case place r of
  InSource region ->
    let described = Region.fromText file text
        Position {line, column} = Region.position described (Region.start region)
     in [ file <> ":" <> Decimal.whole line <> ":" <> Decimal.whole column <> ": "
            <> Text.strip (Region.lineText described (Region.start region))
        ]
  _ -> []

-- | A report on a machine description as one line of text: file, line number, column and title, or
-- only the title if the report has no region. @file@ and @text@ are the name and the text of the
-- description.
inOneLine :: Text -> Text -> Report -> Text
inOneLine file text r = case place r of
  InSource region ->
    let Position {line, column} = Region.position (Region.fromText file text) (Region.start region)
     in file <> ":" <> Decimal.whole line <> ":" <> Decimal.whole column <> ": " <> title r
  _ -> title r
