{-# LANGUAGE BangPatterns #-}

-- | The commands.
module Cli.Subcommand
  ( run,
    told,
    checked,
  )
where

import Base.Crash (bug)
import Base.Region (Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Base.Result qualified as Result
import Cli.Error (Error (..), Warning (..))
import Cli.Error qualified as Cli
import Cli.Formatter qualified as Formatter
import Cli.FrameTable qualified as FrameTable
import Cli.MachineTable qualified as MachineTable
import Cli.NodeTable qualified as NodeTable
import Cli.Options (CompileOptions (..), Invocation (..), Subcommand (..))
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Cli.Progress qualified as Progress
import Cli.ProofTable qualified as ProofTable
import Cli.Target qualified as Target
import Compile (Analysis (Analysis, part, path), Punched (..))
import Compile qualified
import Control.Exception (IOException, evaluate, try)
import Control.Monad (filterM, void)
import Data.ByteString (ByteString)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Draw.Plot qualified as Plot
import Draw.TapeRows qualified as TapeRows
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Lsp.Server (Host (Host, input, load))
import Lsp.Server qualified as Lsp
import Lsp.Session (Ending (..))
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Part.Part qualified as Part
import Report.Explanation qualified as Explanation
import Report.Report (Report)
import Sheet.Error qualified as Sheet
import Sheet.FromPart qualified as Sheet
import Sheet.FromText qualified as Sheet
import Sheet.ToSurface qualified as Sheet
import Sheet.ToText qualified as Sheet
import Sheet.Unsupported qualified as Unsupported
import Surface.Import qualified as Import
import System.Directory (canonicalizePath, doesDirectoryExist, doesFileExist)
import System.FilePath
  ( dropExtension,
    hasTrailingPathSeparator,
    replaceDirectory,
    takeDirectory,
    takeFileName,
    (<.>),
    (</>),
  )
import System.IO (stdin, stdout)
import Tape.Punch qualified as Tape
import Tape.Tape (Tape (..))
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | Run a command.
run :: Invocation -> IO Exit
run (Invocation settings command) = Output.reporting settings (`perform` command)

-- | Print what the command line says of itself.
told :: String -> IO Exit
told text = Output.reporting Output.plainly (`printed` (Text.pack text <> "\n"))

perform :: Reporter -> Subcommand -> IO Exit
perform reporter command = case command of
  Compile options -> compile reporter options
  Check files -> maximum <$> traverse (check reporter) (NonEmpty.toList files)
  Verify file target tape -> verify reporter file target tape
  Frames file target json -> frames reporter file target json
  Report file target -> report reporter file target
  Import file output -> import' reporter file output
  ExportSheet file output -> exportSheet reporter file output
  Decode target tape -> decode reporter target tape
  Plot file output -> plot reporter file output
  Machines name asText -> machines reporter name asText
  DrawTape target range tape -> drawTape reporter target range tape
  Explain code -> explain reporter code
  LanguageServer -> languageServer reporter
  Fmt onlyAsked files ->
    maximum <$> traverse (Formatter.fmt reporter onlyAsked) (NonEmpty.toList files)

-- Reading

-- | A program that could be read, and the values for its parameters.
data Loaded = Loaded {name :: Text, texts :: Compile.LoadedProgram, values :: [(Text, Text)]}

source :: Loaded -> Source
source = Compile.source . texts

-- | Read a program and what it imports, and the descriptions of the machines that it or the command
-- line names, and go on with it.
withProgram :: Reporter -> FilePath -> [Text] -> (Loaded -> IO Exit) -> IO Exit
withProgram reporter file targets continue = do
  text <- readProgram file
  case text of
    Left e -> complain reporter (displayName file) e
    Right _
      | Compile.isSheet file,
        (assigned, _) : _ <- given ->
        complain reporter (displayName file) (SheetAssigned assigned)
    Right t -> do
      texts <- Compile.load (fromDisk imported) (Text.unpack (displayName file)) t
      descriptions <- descriptionsFor targets (Compile.descriptions texts)
      continue
        Loaded {name = displayName file, texts = texts {Compile.descriptions}, values = given}
  where
    given = Output.values (Output.settings reporter)
    imported there = either (Left . Cli.whyNot) Right <$> readProgram there

-- | Files whose texts are had so, and that are themselves however they are reached.
fromDisk :: (FilePath -> IO (Either Text Text)) -> Import.Reader IO
fromDisk contents =
  Import.Reader
    { Import.contents,
      Import.identity =
        \there ->
          either (const there :: IOException -> FilePath) id <$> try (canonicalizePath there)
    }

-- | The text of a program file.
readProgram :: FilePath -> IO (Either Error Text)
readProgram file = do
  bytes <- readBytes file
  pure $ case fmap Encoding.decodeUtf8' bytes of
    Left e -> Left e
    Right (Left _) -> Left NotUtf8
    -- A mark of the byte order is not part of the text.
    Right (Right text) -> Right (fromMaybe text (Text.stripPrefix "\xFEFF" text))

readBytes :: FilePath -> IO (Either Error ByteString)
readBytes file = either (Left . CannotRead) Right <$> Output.readBytes file

displayName :: FilePath -> Text
displayName file = if file == "-" then "<stdin>" else Text.pack file

-- | A mistake that belongs to a file as a whole.
complain :: Reporter -> Text -> Error -> IO Exit
complain reporter path e =
  Failed <$ Output.show' reporter path (Region.fromText path "") [Cli.toReport e]

-- | Write what a stage says; go on with its output when there is nothing against it.
settle :: Reporter -> Loaded -> Result Report Report a -> (a -> IO Exit) -> IO Exit
settle reporter loaded result continue = do
  Progress.during ("working on " <> name loaded) (computed result)
  stopped <- Output.show' reporter (name loaded) (source loaded) (errors result <> warnings result)
  case output result of
    Just a | not stopped -> continue a
    Nothing | not stopped -> bug "a stage gave neither an output nor a report"
    _ -> pure Failed

-- | Compute a result as far as its errors and warnings depend on it.
computed :: Result w e a -> IO ()
computed result = void (evaluate (length (errors result) + length (warnings result)))

-- | Print a result.
printed :: Reporter -> Text -> IO Exit
printed reporter text = delivered reporter =<< Output.result text

delivered :: Reporter -> Either Text () -> IO Exit
delivered reporter written = case written of
  Left why -> complain reporter "" (CannotWrite "to standard output" why)
  Right () -> pure Done

analyse :: Loaded -> Result Report Report Analysis
analyse loaded = Compile.analyse (values loaded) (texts loaded)

-- Machines

-- | The descriptions that the command line names, with those of the program.
descriptionsFor :: [Text] -> [(Text, Either Text Text)] -> IO Compile.Descriptions
descriptionsFor targets own =
  (<> own) <$> traverse (Compile.described readText "") (filter Compile.isDescription targets)
  where
    readText file = either (Left . Cli.whyNot) Right <$> readProgram file

-- | The machines to work for.
chosen :: Loaded -> [Text] -> Analysis -> Result w Report [Machine]
chosen loaded = Target.chosen (Compile.descriptions (texts loaded))

-- | The machine of the command line, for commands that have no program.
withMachine :: Reporter -> Text -> Text -> (Machine -> IO Exit) -> IO Exit
withMachine reporter about wanted continue = do
  descriptions <- descriptionsFor [wanted] []
  either (complain reporter about) continue (Target.named descriptions wanted)

-- Commands

-- | Punch a path for one machine and prove the tape.
proven :: Bool -> Toolpath -> Machine -> Result Report Report (Machine, Punched)
proven unproven' path machine =
  asked `seq` do
    punched <- Compile.punch machine path >>= moving
    if unproven'
      then Result.warned [Cli.warningReport Unproven]
      else do
        read' <- Compile.readOwn machine (program punched) (tape punched)
        _ <- Compile.prove machine asked (program punched) read'
        pure ()
    pure (machine, punched)
  where
    -- The moves along the contours are dropped as their frames are made.
    asked = Toolpath.withoutCuts path

-- | The same for several machines. While the last tape is proven nothing waits for the path any
-- more.
provenOn :: Bool -> Toolpath -> [Machine] -> Result Report Report [(Machine, Punched)]
provenOn unproven' path ms = case ms of
  [] -> pure []
  [m] -> (: []) <$> proven unproven' path m
  m : more -> (:) <$> proven unproven' path m <*> provenOn unproven' path more

-- | A tape that moves something.
moving :: Punched -> Result w Report Punched
moving punched =
  if null (Frame.planned (program punched))
    then Result.failed (Cli.toReport NothingToPunch)
    else pure punched

compile :: Reporter -> CompileOptions -> IO Exit
compile reporter options = withProgram reporter (file options) (targets options) $ \loaded -> do
  -- The program as it was read is not kept while its path is laid and its tape made: a large one
  -- takes more room than both.
  let !rest = loaded {texts = Compile.withoutSurface (texts loaded)}
      laid =
        analyse loaded `Result.thenSound` \a@Analysis {path = way} ->
          (way,) <$> chosen rest (targets options) a
  Progress.during ("working on " <> name rest) (computed laid)
  settle reporter rest (laid `Result.thenSound` uncurry (provenOn (unproven options))) $ \tapes ->
    do
      places <- traverse (\(m, p) -> (,p) <$> destination options (length tapes) m) tapes
      clash <- overwrites (ownFiles (file options) rest) (map fst places)
      case (clash, twice (map fst places)) of
        (Just place, _) -> complain reporter (name rest) (OverwritesProgram (Text.pack place))
        (Nothing, Just place) -> complain reporter (name rest) (OneForSeveral (Text.pack place))
        (Nothing, Nothing) ->
          writeAll reporter [(place, bytes) | (place, Punched {tape = Tape bytes}) <- places]
  where
    -- The first place that stands there again.
    twice places = case places of
      [] -> Nothing
      p : more -> if p `elem` more then Just p else twice more

-- | Where a tape goes: beside the program, into a folder, or to the file that is named.
destination :: CompileOptions -> Int -> Machine -> IO FilePath
destination options count machine = case place options of
  Nothing -> pure (if file options == "-" then standard else replaceDirectory' standard)
  Just "-" -> pure "-"
  Just there -> do
    folder <- doesDirectoryExist there
    pure
      (if folder || hasTrailingPathSeparator there || count > 1 then there </> standard else there)
  where
    MachineName machineName = Machine.name machine
    base = if file options == "-" then "stdin" else dropExtension (takeFileName (file options))
    standard =
      base <.> Text.unpack machineName <.> Text.unpack (Machine.suffix (Machine.medium machine))
    replaceDirectory' f = replaceDirectory f (directory (file options))
    directory f = take (length f - length (takeFileName f)) f

-- | The files that a program is made of: its own, those that it imports, the descriptions of its
-- machines.
ownFiles :: FilePath -> Loaded -> [FilePath]
ownFiles file' loaded =
  file' :
  map (Text.unpack . snd) (Compile.imports (texts loaded))
    <> concat
      [ [Text.unpack d, takeDirectory file' </> Text.unpack d]
        | (d, _) <- Compile.descriptions (texts loaded)
      ]

-- | The first output that is one of the files that it is made of.
overwrites :: [FilePath] -> [FilePath] -> IO (Maybe FilePath)
overwrites sources places = do
  present <- filterM doesFileExist sources
  selves <- traverse canonicalizePath present
  others <- traverse canonicalizePath places
  pure (listToMaybe [place | (other, place) <- zip others places, other `elem` selves])

writeAll :: Reporter -> [(FilePath, ByteString)] -> IO Exit
writeAll reporter files = case files of
  [] -> pure Done
  (place, bytes) : rest -> do
    written <- if place == "-" then Output.resultBytes bytes else Output.writeFileWhole place bytes
    case written of
      Left why -> complain reporter "" (CannotWrite (Text.pack place) why)
      Right () -> writeAll reporter rest

-- | Mistakes only: nothing past the path and the machine's limits.
check :: Reporter -> FilePath -> IO Exit
check reporter file' = withProgram reporter file' [] $ \loaded ->
  settle reporter loaded (checked (values loaded) (texts loaded)) (const (pure Done))

-- | All that can be said against a program without its tape: up to the limits of the machine that
-- it names.
checked :: [(Text, Text)] -> Compile.LoadedProgram -> Result Report Report Analysis
checked values' texts' = Compile.analyse values' texts' `Result.thenSound` \a -> a <$ limits a
  where
    limits a = case Part.machine (part a) of
      Nothing -> pure []
      Just _ ->
        Target.chosen (Compile.descriptions texts') [] a
          >>= traverse (\m -> Compile.punch m (path a))

-- | Answer an editor until it leaves. What is open in the editor is read there rather than from the
-- disk.
languageServer :: Reporter -> IO Exit
languageServer reporter =
  statusOf
    <$> Lsp.serve
      Host
        { input = stdin,
          Lsp.output = stdout,
          load,
          Lsp.check = checked (Output.values (Output.settings reporter))
        }
  where
    load open path' =
      Compile.load
        ( fromDisk
            ( \there ->
                maybe
                  (either (Left . Cli.whyNot) Right <$> readProgram there)
                  (pure . Right)
                  (open (Text.pack there))
            )
        )
        (Text.unpack path')
    statusOf ending = case ending of
      Orderly -> Done
      Abrupt -> Failed

verify :: Reporter -> FilePath -> Maybe Text -> Maybe FilePath -> IO Exit
verify reporter file' target tapeFile =
  withProgram reporter file' (maybe [] pure target) $ \loaded ->
    settle reporter loaded (prepared target loaded) $ \(analysis, machine, punched) -> do
      given <- maybe (pure (Right (tape punched))) (fmap (fmap Tape) . readBytes) tapeFile
      case given of
        Left e -> complain reporter (maybe "" displayName tapeFile) e
        Right t -> do
          let read' = Compile.readBack machine (program punched) t
              tapeName = maybe (name loaded) displayName tapeFile
          broken <- Output.show' reporter tapeName (source loaded) (errors read')
          case output read' of
            Just fs | not broken -> do
              let result = Compile.prove machine (path analysis) (program punched) fs
              Progress.during ("proving " <> tapeName) (computed result)
              table <-
                maybe (pure Done) (printed reporter . ProofTable.proof machine) (output result)
              _ <- Output.show' reporter (name loaded) (source loaded) (errors result)
              pure (if null (errors result) then table else Disproven)
            _ -> pure Failed

-- | A program with its frames and tape for one machine.
prepared :: Maybe Text -> Loaded -> Result Report Report (Analysis, Machine, Punched)
prepared target loaded =
  analyse loaded `Result.thenSound` \a -> do
    ms <- chosen loaded (maybe [] pure target) a
    case ms of
      m : _ -> (a,m,) <$> (Compile.punch m (path a) >>= moving)
      [] -> Result.failed (Cli.toReport (NoMachine Target.known))

frames :: Reporter -> FilePath -> Maybe Text -> Bool -> IO Exit
frames reporter file' target json = withProgram reporter file' (maybe [] pure target) $ \loaded ->
  settle reporter loaded (prepared target loaded) $ \(_, machine, punched) -> do
    printed
      reporter
      ( (if json then FrameTable.framesJson else FrameTable.frames)
          machine
          (source loaded)
          (program punched)
      )

report :: Reporter -> FilePath -> Maybe Text -> IO Exit
report reporter file' target = withProgram reporter file' (maybe [] pure target) $ \loaded ->
  settle reporter loaded (analyse loaded `Result.thenSound` \a -> (a,) <$> onMachine loaded a) $
    \(a, punched) ->
      printed reporter (NodeTable.nodes punched a)
  where
    onMachine loaded a = case (target, Part.machine (part a)) of
      (Nothing, Nothing) -> pure Nothing
      _ ->
        chosen loaded (maybe [] pure target) a >>= \case
          m : _ -> (\p -> Just (m, p)) <$> Compile.punch m (path a)
          [] -> pure Nothing

decode :: Reporter -> Maybe Text -> FilePath -> IO Exit
decode reporter target tapeFile =
  withTape reporter target tapeFile $ \machine fs ->
    printed reporter (FrameTable.decoded machine fs)

-- | Draw a tape, or some of it.
drawTape :: Reporter -> Maybe Text -> TapeRows.RowRange -> FilePath -> IO Exit
drawTape reporter target range tapeFile = withTape reporter target tapeFile $ \machine fs ->
  let rows = Tape.rows machine 0 fs
   in maybe
        ( complain
            reporter
            (displayName tapeFile)
            (uncurry NothingInRange (TapeRows.extent machine range rows))
        )
        (printed reporter)
        (TapeRows.picture machine range rows)

-- | Read a tape for itself: the cutter is taken to stand at zero before it.
withTape :: Reporter -> Maybe Text -> FilePath -> (Machine -> [Frame] -> IO Exit) -> IO Exit
withTape reporter target tapeFile continue = case target of
  Nothing -> complain reporter (displayName tapeFile) (NoMachineForTape Target.known)
  Just wanted -> withMachine reporter (displayName tapeFile) wanted $ \machine -> do
    bytes <- readBytes tapeFile
    case bytes of
      Left e -> complain reporter (displayName tapeFile) e
      Right b -> do
        let result = Compile.readTape machine 0 (Tape b)
        _ <-
          Output.show'
            reporter
            (displayName tapeFile)
            (Region.fromText (displayName tapeFile) "")
            (errors result)
        maybe (pure Failed) (continue machine) (output result)

plot :: Reporter -> FilePath -> Maybe FilePath -> IO Exit
plot reporter file' place = withProgram reporter file' [] $ \loaded ->
  settle reporter loaded (analyse loaded) $ \analysis ->
    deliver
      reporter
      (displayName file')
      (ownFiles file' loaded)
      place
      (Plot.plot (part analysis) (path analysis))

-- | Write a sheet as a program.
import' :: Reporter -> FilePath -> Maybe FilePath -> IO Exit
import' reporter file' place = do
  text <- readProgram file'
  case text of
    Left e -> complain reporter (displayName file') e
    Right t -> do
      let result = Result.mapErrors id Sheet.toReport (Sheet.read t)
      stopped <-
        Output.show'
          reporter
          (displayName file')
          (Region.fromText (displayName file') t)
          (errors result)
      case output result of
        Just sheet
          | not stopped ->
            deliver reporter (displayName file') [file'] place (Sheet.text sheet)
        _ -> pure Failed

-- | Write a program as a sheet.
exportSheet :: Reporter -> FilePath -> Maybe FilePath -> IO Exit
exportSheet reporter file' place = withProgram reporter file' [] $ \loaded ->
  settle
    reporter
    loaded
    ( Compile.evaluated (values loaded) (texts loaded)
        `Result.thenSound` (Result.mapErrors id Unsupported.toReport . uncurry Sheet.fromPart)
    )
    $ deliver reporter (displayName file') (ownFiles file' loaded) place . Sheet.write

-- | Write a text to a file, but not over one of those that it was made from, or to standard output.
deliver :: Reporter -> Text -> [FilePath] -> Maybe FilePath -> Text -> IO Exit
deliver reporter about sources place text = case place of
  Just p | p /= "-" -> do
    clash <- overwrites sources [p]
    case clash of
      Just same -> complain reporter about (OverwritesProgram (Text.pack same))
      Nothing -> writeAll reporter [(p, Encoding.encodeUtf8 text)]
  _ -> printed reporter text

-- | The list of machines, or one of them: its sheet or the text of its description. The mistakes of
-- a description stand at their places in it.
machines :: Reporter -> Maybe Text -> Bool -> IO Exit
machines reporter wanted asText = case wanted of
  Nothing -> printed reporter (MachineTable.machineList BuiltIn.machines)
  Just n -> do
    descriptions <- descriptionsFor [n] []
    case (Target.named descriptions n, lookup n descriptions) of
      (Left (DescriptionWrong _ file' text reports), _) ->
        Failed <$ Output.show' reporter file' (Region.fromText file' text) reports
      (Left e, _) -> complain reporter "" e
      (Right _, Just (Right text)) | asText -> printed reporter text
      (Right m, _)
        | asText -> maybe (pure Failed) (printed reporter) (BuiltIn.text (Machine.name m))
        | otherwise -> printed reporter (MachineTable.machineSheet m)

explain :: Reporter -> Maybe Text -> IO Exit
explain reporter wanted = case wanted of
  Nothing -> printed reporter Explanation.list
  Just word -> case Explanation.find word of
    [] -> complain reporter "" (UnknownCode word (Explanation.near word))
    found -> printed reporter (Text.intercalate "\n" (map Explanation.render found))
