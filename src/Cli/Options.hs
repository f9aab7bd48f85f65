-- | The command line: subcommands, options, help.
module Cli.Options
  ( Subcommand (..),
    CompileOptions (..),
    RunOptions (..),
    RunForm (..),
    FrameForm (..),
    PreviewOptions (..),
    Invocation (..),
    parser,
  )
where

import Base.Quantity (Mm (..))
import Cli.ImportCommand (ImportOptions (..), importOptions)
import Cli.OptionReader
  ( assignment,
    choice,
    fromTo,
    portNumber,
    switchRadius,
    tickRange,
  )
import Cli.Output (ColourChoice (..), Format (..), OutputSettings (..))
import Control.Applicative (many, optional, some, (<|>))
import Control.Monad (void)
import Data.List (intercalate)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.CutClass (Colouring (..))
import Draw.LineStyle (Appearance (..))
import Draw.Page (PageFormat (..))
import Draw.PlotSettings (PlotSettings (PlotSettings, appearance, colouring))
import Draw.PlotSettings qualified as PlotSettings
import Draw.TapeRows (RowRange)
import Draw.TapeRows qualified as TapeRows
import Options.Applicative (Parser, ParserInfo)
import Options.Applicative qualified as Opt
import Report.Explanation qualified as Explanation
import Report.Report (ReportCode (..))

-- | A parsed command line.
data Invocation = Invocation {settings :: OutputSettings, command :: Subcommand}
  deriving stock (Eq, Show)

-- | A subcommand with its arguments. A @Maybe Text@ is the name or the file of a machine; nothing
-- means the machine that the program names. A @Maybe FilePath@ is a file to write; nothing means
-- standard output. Comments on constructors say where this differs.
data Subcommand
  = Compile CompileOptions
  | -- | names or files of machines, or none for the machine that each program names; the programs
    Check [Text] (NonEmpty FilePath)
  | -- | the program, the machine, the files of the tape, one for each tool if the control cannot
    -- change tools; without a file, the tape that the compiler makes of the program is proven; true
    -- to prove the pulses of the controller, too
    Verify FilePath (Maybe Text) [FilePath] Bool
  | -- | the program, the machine, the form of the list
    Frames FilePath (Maybe Text) FrameForm
  | -- | the program, the machine, true to list the reference points of pieces, too
    Report FilePath (Maybe Text) Bool
  | Import ImportOptions
  | -- | the program, the input sheet to write
    ExportSheet FilePath (Maybe FilePath)
  | -- | the machine, without which the command fails; the tape
    Decode (Maybe Text) FilePath
  | Run RunOptions
  | -- | the program, the drawing to write, its page and its line styles
    Plot FilePath (Maybe FilePath) PlotSettings
  | -- | the program, the drawing for CAD programs to write
    Export FilePath (Maybe FilePath)
  | -- | the machine, without which the command fails; the rows to show; the drawing to write, or
    -- nothing for a picture in letters, and true if it is punched into film; the tape
    DrawTape (Maybe Text) RowRange (Maybe (FilePath, Bool)) FilePath
  | -- | the machine, or nothing for the list of all machines; true for the text of the machine's
    -- description instead of a table
    Machines (Maybe Text) Bool
  | -- | the report code, or nothing for the list of all codes
    Explain (Maybe Text)
  | Preview PreviewOptions
  | LanguageServer
  | -- | true to check the layout and write nothing; the programs
    Fmt Bool (NonEmpty FilePath)
  | -- | true to show the changes and write nothing; the programs
    Mend Bool (NonEmpty FilePath)
  deriving stock (Eq, Show)

-- | The arguments of @compile@.
data CompileOptions = CompileOptions
  { file :: FilePath,
    -- | names or files of machines; an empty list means the machine that the program names
    targets :: [Text],
    -- | the file or folder to write to, @-@ for standard output; nothing for a file in the folder
    -- of the program
    place :: Maybe FilePath,
    -- | true to write tapes without verification
    unproven :: Bool
  }
  deriving stock (Eq, Show)

-- | The arguments of @run@.
data RunOptions = RunOptions
  { -- | a program or a tape
    runInput :: FilePath,
    -- | name or file of the machine; nothing for the machine that the program names
    runTarget :: Maybe Text,
    runForm :: RunForm,
    -- | first and last frame to show
    fromFrame :: Maybe Int,
    toFrame :: Maybe Int,
    -- | position of the switch that corrects the feed, in percent
    overrideAt :: Maybe Int,
    -- | radius of the cutter for each switch that is set
    switchesAt :: [(Int, Mm)]
  }
  deriving stock (Eq, Show)

-- | The arguments of @preview@.
data PreviewOptions = PreviewOptions
  { -- | a program or a tape
    previewFile :: FilePath,
    -- | name or file of the machine with which the page begins; nothing for the machine that the
    -- program names
    previewTarget :: Maybe Text,
    -- | port of the page; nothing for any free one
    previewPort :: Maybe Int,
    -- | true to open the page in a browser
    previewOpens :: Bool
  }
  deriving stock (Eq, Show)

-- | Form in which a run is written. A @Maybe FilePath@ is the file of a picture; nothing means
-- standard output.
data RunForm
  = RunAsTable
  | RunAsJson
  | PulseStream
  | -- | picture of the feed and the frequencies of the axes over time
    SpeedPicture (Maybe FilePath)
  | -- | picture of the dispatcher's jobs; first and last tick that it shows
    TimelinePicture (Maybe (Int, Int)) (Maybe FilePath)
  deriving stock (Eq, Show)

-- | Form in which frames are listed: a table, JSON lines, or the record of each frame in letters
-- and digits.
data FrameForm = FramesAsTable | FramesAsJson | FrameRecords
  deriving stock (Eq, Show)

-- | The parser of the whole command line; the argument is the version of partc.
parser :: String -> ParserInfo Invocation
parser version =
  Opt.info
    ( Opt.helper
        <*> Opt.infoOption ("partc " <> version) (Opt.long "version" <> Opt.help "Show the version")
        <*> invocation
    )
    ( Opt.fullDesc
        <> Opt.header "partc - from part programs to proven tapes"
        <> Opt.progDesc
          "Compiles part programs for numerically controlled machine tools, reads its own tapes \
          \back and proves them against the drawing."
        <> Opt.footer "Example: partc compile flange.part -t lkp-01f"
        <> Opt.failureCode 2
    )

invocation :: Parser Invocation
invocation =
  (\before (after, command) -> Invocation (settingsFrom (after `over` before)) command)
    <$> overrides <*> commands

commands :: Parser (Overrides, Subcommand)
commands =
  Opt.hsubparser . mconcat $
    [ entry
        "compile"
        "Punch the tape of a program, proven"
        "partc compile flange.part -t lkp-01f -o flange.tape"
        (Compile <$> compileOptions),
      entry
        "check"
        "Look for mistakes only"
        "partc check flange.part -t lkp-01f"
        (Check <$> many target <*> (NonEmpty.fromList <$> some program)),
      entry
        "verify"
        "Prove a tape against its program"
        "partc verify flange.part flange.tape"
        (Verify <$> program <*> optional target <*> many tape <*> pulsesFlag),
      entry
        "frames"
        "List the frames of a program"
        "partc frames flange.part -t lkp-01f --json"
        (Frames <$> program <*> optional target <*> frameForm),
      entry
        "report"
        "Tables of nodes, lengths, times and steps"
        "partc report flange.part"
        (Report <$> program <*> optional target <*> pointsFlag),
      entry
        "decode"
        "List the frames of a tape"
        "partc decode -t lkp-01f flange.tape"
        (Decode <$> optional target <*> tape),
      entry
        "run"
        "Run a tape on its controller, with times and pulses"
        "partc run flange.part -t lkp-01f"
        (Run <$> runOptions),
      entry
        "tape"
        "Draw the rows of a tape with their meaning"
        "partc tape -t lkp-01f flange.tape --frames 1..3"
        (DrawTape <$> optional target <*> rangeOption <*> optional tapeDrawing <*> tape),
      entry
        "plot"
        "Draw part, path, nodes and cutter as SVG"
        "partc plot flange.part -o flange.svg"
        (Plot <$> program <*> optional outputFile <*> plotSettings),
      entry
        "export"
        "Draw part and path for CAD programs as DXF or SVG"
        "partc export flange.part -o flange.dxf"
        (Export <$> program <*> optional exportedFile),
      entry
        "preview"
        "Serve a page that follows a program and plays its tape"
        "partc preview flange.part"
        (Preview <$> previewOptions),
      entry
        "import"
        "Make a part program of an input sheet or a drawing"
        "partc import plate.dxf -o plate.part"
        (Import <$> importOptions outputFile),
      entry
        "export-sheet"
        "Make an input sheet of a program"
        "partc export-sheet rib.part -o rib.sheet"
        (ExportSheet <$> program <*> optional outputFile),
      entry
        "machines"
        "List the machines, or describe one"
        "partc machines lkp-01f"
        (Machines <$> optional machineName <*> textFlag),
      entry
        "explain"
        "Say what a report's code means, or list all codes"
        "partc explain E0314"
        (Explain <$> optional reportCode),
      entry
        "lsp"
        "Serve an editor on standard input and output"
        "partc lsp"
        (LanguageServer <$ editorOptions),
      entry
        "fmt"
        "Bring programs into the canonical layout, in place"
        "partc fmt flange.part"
        (Fmt <$> checkFlag <*> (NonEmpty.fromList <$> some program)),
      entry
        "fix"
        "Mend the mistakes that leave no choice, in place"
        "partc fix --dry-run flange.part"
        (Mend <$> dryRunFlag <*> (NonEmpty.fromList <$> some program))
    ]
  where
    entry name description example p =
      Opt.command
        name
        ( Opt.info
            ((,) <$> overrides <*> p)
            (Opt.progDesc description <> Opt.footer ("Example: " <> example) <> Opt.failureCode 2)
        )

-- | The options that editors pass to every language server. They are accepted without effect. This
-- server always uses standard input and output, and ends when its input ends.
editorOptions :: Parser ()
editorOptions =
  void (Opt.switch (Opt.long "stdio" <> Opt.internal))
    <* optional (Opt.strOption (Opt.long "clientProcessId" <> Opt.internal) :: Parser String)

compileOptions :: Parser CompileOptions
compileOptions =
  CompileOptions
    <$> program
    <*> many target
    <*> optional (outputOption "The file to write, or a folder; - for standard output")
    <*> Opt.switch (Opt.long "no-verify" <> Opt.help "Write the tape without proving it")

previewOptions :: Parser PreviewOptions
previewOptions =
  PreviewOptions
    <$> Opt.strArgument
      ( Opt.metavar "FILE"
          <> Opt.help "A part program, an input sheet, a tape, or a file of G-code"
          <> Opt.action "file"
      )
    <*> optional target
    <*> optional
      ( Opt.option
          portNumber
          ( Opt.long "port"
              <> Opt.metavar "N"
              <> Opt.help "The port of the page; any free one if left out"
          )
      )
    <*> (not <$> Opt.switch (Opt.long "no-open" <> Opt.help "Do not open a browser"))

runOptions :: Parser RunOptions
runOptions =
  RunOptions
    <$> programOrTape
    <*> optional target
    <*> runFormOption
    <*> optional (frameOption "from" "Only this frame and later ones")
    <*> optional (frameOption "to" "Only frames up to this one")
    <*> optional
      ( Opt.option
          Opt.auto
          ( Opt.long "override"
              <> Opt.metavar "N"
              <> Opt.help "The position of the switch that corrects the feed, in percent"
          )
      )
    <*> many
      ( Opt.option
          switchRadius
          ( Opt.long "switch"
              <> Opt.metavar "N=MM"
              <> Opt.help "The cutter's radius at the correction switch N"
          )
      )
  where
    frameOption name description =
      Opt.option Opt.auto (Opt.long name <> Opt.metavar "FRAME" <> Opt.help description)

programOrTape :: Parser FilePath
programOrTape =
  Opt.strArgument
    ( Opt.metavar "FILE"
        <> Opt.help "A part program, an input sheet, or a tape; - for a tape on standard input"
        <> Opt.action "file"
    )

-- | The page and the line styles of a plot.
plotSettings :: Parser PlotSettings
plotSettings =
  PlotSettings
    <$> word
      (PlotSettings.format PlotSettings.standard)
      "sheet"
      "The format of the paper"
      [("a4", A4), ("a3", A3), ("a2", A2), ("a1", A1), ("a0", A0)]
    <*> word
      (colouring PlotSettings.standard)
      "by"
      "The property that the line styles of the cutter's path show"
      [("depth", ByDepth), ("tool", ByTool), ("feed", ByFeed)]
    <*> word
      (appearance PlotSettings.standard)
      "style"
      "Colours, black and white for a printer, or colours on a dark ground"
      [("screen", Screen), ("print", Print), ("dark", Dark)]
  where
    word usual name description table =
      Opt.option
        (choice table)
        ( Opt.long name
            <> Opt.value usual
            <> Opt.metavar (intercalate "|" (map fst table))
            <> Opt.help description
            <> Opt.completeWith (map fst table)
        )

-- | The form in which a run is written.
runFormOption :: Parser RunForm
runFormOption =
  Opt.flag' RunAsJson (Opt.long "json" <> Opt.help "One JSON object a line")
    <|> Opt.flag'
      PulseStream
      (Opt.long "pulses" <> Opt.help "One line for each pulse: axis, sign, tick")
    <|> ( Opt.flag'
            SpeedPicture
            (Opt.long "speed" <> Opt.help "Draw feed and frequencies over time, as SVG")
            <*> optional outputFile
        )
    <|> ( Opt.flag'
            TimelinePicture
            (Opt.long "timeline" <> Opt.help "Draw the jobs of the dispatcher, as SVG")
            <*> optional
              ( Opt.option
                  tickRange
                  ( Opt.long "ticks"
                      <> Opt.metavar "A..B"
                      <> Opt.help "The ticks of the clock that the timeline shows"
                  )
              )
            <*> optional outputFile
        )
    <|> pure RunAsTable

frameForm :: Parser FrameForm
frameForm =
  Opt.flag' FramesAsJson (Opt.long "json" <> Opt.help "One JSON object a line")
    <|> Opt.flag'
      FrameRecords
      ( Opt.long "record"
          <> Opt.help "One frame a line, in the letters and digits of the machine's code"
      )
    <|> pure FramesAsTable

pointsFlag :: Parser Bool
pointsFlag =
  Opt.switch
    ( Opt.long "points"
        <> Opt.help "The cutter's position for each row of the tables of curves, too"
    )

pulsesFlag :: Parser Bool
pulsesFlag =
  Opt.switch (Opt.long "pulses" <> Opt.help "Prove the pulses of the machine's controller, too")

textFlag :: Parser Bool
textFlag =
  Opt.switch (Opt.long "text" <> Opt.help "The text of its description, to begin one's own with")

dryRunFlag :: Parser Bool
dryRunFlag =
  Opt.switch (Opt.long "dry-run" <> Opt.help "Write nothing, and print what would be changed")

checkFlag :: Parser Bool
checkFlag =
  Opt.switch
    (Opt.long "check" <> Opt.help "Write nothing, and name the programs that are not laid out")

machineName :: Parser Text
machineName =
  Opt.strArgument
    ( Opt.metavar "NAME"
        <> Opt.help "A machine that is built in, or a description NAME.machine"
    )

reportCode :: Parser Text
reportCode =
  Opt.strArgument
    ( Opt.metavar "CODE"
        <> Opt.help "A code as a report shows it; lower case and 314 will do"
        <> Opt.completeWith codes
    )
  where
    codes = [Text.unpack c | e <- Explanation.everything, let ReportCode c = Explanation.code e]

program :: Parser FilePath
program =
  Opt.strArgument
    ( Opt.metavar "FILE"
        <> Opt.help
          "A part program, or an input sheet NAME.sheet; - for a program on standard input"
        <> Opt.action "file"
    )

tape :: Parser FilePath
tape =
  Opt.strArgument
    ( Opt.metavar "TAPE"
        <> Opt.help
          "A tape; - for standard input. For GRBL and Marlin, the files of all tools in their order"
        <> Opt.action "file"
    )

target :: Parser Text
target =
  Opt.strOption
    ( Opt.long "target"
        <> Opt.short 't'
        <> Opt.metavar "MACHINE"
        <> Opt.help
          "The machine, instead of the program's own: a name, or a description such as \
          \./mine.machine"
    )

rangeOption :: Parser RowRange
rangeOption =
  ( uncurry TapeRows.Frames
      <$> Opt.option
        fromTo
        (Opt.long "frames" <> Opt.metavar "A..B" <> Opt.help "Only these frames")
  )
    <|> ( uncurry TapeRows.Rows
            <$> Opt.option
              fromTo
              (Opt.long "rows" <> Opt.metavar "A..B" <> Opt.help "Only these rows")
        )
    <|> pure TapeRows.Everything

outputFile :: Parser FilePath
outputFile = outputOption "The file to write; - for standard output"

exportedFile :: Parser FilePath
exportedFile = outputOption "The file to write: X.dxf or X.svg; - for DXF on standard output"

tapeDrawing :: Parser (FilePath, Bool)
tapeDrawing =
  (,)
    <$> outputOption "A drawing of the tape at its true size, instead of a picture in letters"
    <*> Opt.switch (Opt.long "film" <> Opt.help "With -o: the tape as 35 mm film, not as paper")

outputOption :: String -> Parser FilePath
outputOption help =
  Opt.strOption
    (Opt.long "output" <> Opt.short 'o' <> Opt.metavar "PATH" <> Opt.help help <> Opt.action "file")

-- | The general settings that are written before the subcommand, or those that are written after
-- it. Nothing, false and the empty list mean that a setting is not among them.
data Overrides = Overrides
  { format' :: Maybe Format,
    colour' :: Maybe ColourChoice,
    quiet' :: Bool,
    werror' :: Bool,
    values' :: [(Text, Text)]
  }

overrides :: Parser Overrides
overrides =
  Overrides
    <$> optional
      ( Opt.option
          ( choice
              [ ("human", HumanFormat),
                ("short", ShortFormat),
                ("json", JsonFormat),
                ("sarif", SarifFormat)
              ]
          )
          ( Opt.long "format"
              <> Opt.metavar "human|short|json|sarif"
              <> Opt.help "How errors and warnings are written, on standard error"
              <> Opt.completeWith ["human", "short", "json", "sarif"]
          )
      )
    <*> optional
      ( Opt.option
          (choice [("auto", Auto), ("always", Always), ("never", Never)])
          ( Opt.long "color"
              <> Opt.metavar "auto|always|never"
              <> Opt.help "Colours in reports"
              <> Opt.completeWith ["auto", "always", "never"]
          )
      )
    <*> Opt.switch (Opt.long "quiet" <> Opt.short 'q' <> Opt.help "No warnings")
    <*> Opt.switch (Opt.long "werror" <> Opt.help "Warnings count as errors")
    <*> many
      ( Opt.option
          assignment
          ( Opt.long "set"
              <> Opt.metavar "NAME=VALUE"
              <> Opt.help "Give a parameter of the program another value"
          )
      )

-- | Joins the settings written after the subcommand (@later@) with those written before it
-- (@earlier@). If both have a format or a choice of colour, that of @later@ is taken. All
-- parameter values are kept, the earlier ones first.
over :: Overrides -> Overrides -> Overrides
over later earlier =
  Overrides
    { format' = format' later <|> format' earlier,
      colour' = colour' later <|> colour' earlier,
      quiet' = quiet' later || quiet' earlier,
      werror' = werror' later || werror' earlier,
      values' = values' earlier <> values' later
    }

settingsFrom :: Overrides -> OutputSettings
settingsFrom o =
  OutputSettings
    { format = fromMaybe HumanFormat (format' o),
      colour = fromMaybe Auto (colour' o),
      quiet = quiet' o,
      werror = werror' o,
      values = values' o
    }
