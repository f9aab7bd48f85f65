-- | The subcommand @preview@: serves a page that follows a program, or shows a tape.
module Cli.PreviewCommand
  ( preview,
  )
where

import Base.Region qualified as Region
import Cli.Error (Error (..))
import Cli.Error qualified as Cli
import Cli.GcodeFile qualified as GcodeFile
import Cli.InputFile (displayName, loadText, readProgram)
import Cli.Options (PreviewOptions (..))
import Cli.Outcome (failWith, printResult)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Cli.TapeDifference qualified as TapeDifference
import Cli.TapeInput (withTapeFile)
import Control.Concurrent (threadDelay)
import Control.Exception (IOException, try)
import Control.Monad (unless, void, when)
import Data.Maybe (catMaybes, listToMaybe, maybeToList)
import Data.Text qualified as Text
import Data.Time.Clock.POSIX (POSIXTime)
import Gcode.ToFrames qualified as ToFrames
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Preview.Server (Listening (..), Site)
import Preview.Server qualified as Server
import Preview.Subject (Sound (..), TapeState (..))
import Preview.Subject qualified as Subject
import Project.LoadedProgram qualified as LoadedProgram
import Project.MachineDescription qualified as MachineDescription
import Report.Report (Report)
import System.Directory (findExecutable)
import System.Environment (lookupEnv)
import System.Posix.Files
  ( fileID,
    fileSize,
    getFileStatus,
    modificationTimeHiRes,
    statusChangeTimeHiRes,
  )
import System.Posix.Types (FileID, FileOffset)
import System.Process
  ( CreateProcess (std_err, std_in, std_out),
    StdStream (NoStream),
    createProcess,
    proc,
  )
import Tape.Tape (Tape (..))

-- | Serves the page until the program is interrupted.
preview :: Reporter -> PreviewOptions -> IO Exit
preview reporter options
  | file == "-" = failWith reporter (displayName file) NothingToFollow
  | LoadedProgram.isProgram file =
    readProgram file
      >>= either
        (failWith reporter (displayName file))
        (const (served reporter options (followProgram reporter options)))
  | otherwise = withTapeFile reporter (previewTarget options) file $ \machine _ ->
    served reporter options (followTape options machine)
  where
    file = previewFile options

-- | Serves a site while an action follows the file, and opens the page in a browser.
served :: Reporter -> PreviewOptions -> (Site -> IO ()) -> IO Exit
served reporter options followed = do
  site <- Server.newSite Nothing (Subject.nothingYet name (previewTarget options))
  done <- Server.withServer (maybe AnyPort AtPort (previewPort options)) site $ \address -> do
    printed <- printResult reporter (address <> "\n")
    when (previewOpens options) (openBrowser (Text.unpack address))
    unless (printed == Failed) (followed site)
    pure printed
  either (failWith reporter "" . CannotListen . Output.ioProblem) pure done
  where
    name = displayName (previewFile options)

-- Following ---------------------------------------------------------------------------------------

-- | Evaluates the program now, and again whenever one of its files changes.
followProgram :: Reporter -> PreviewOptions -> Site -> IO ()
followProgram reporter options site = follow [file] $ do
  content <- readProgram file
  case content of
    Left e -> pure ([file], Server.publish site (Subject.withReports [Cli.toReport e]))
    Right text -> do
      loaded <- loadText targets (displayName file) text
      pure
        ( file : map Text.unpack (described <> LoadedProgram.files loaded),
          Server.publish site (Subject.following values loaded)
        )
  where
    file = previewFile options
    targets = maybeToList (previewTarget options)
    described = filter MachineDescription.isFileName targets
    values = Output.values (Output.settings reporter)

-- | Shows a tape, and shows it again whenever its file changes.
followTape :: PreviewOptions -> Machine -> Site -> IO ()
followTape options machine site = follow [file] $ do
  content <- Output.readBytes file
  pure . ([file],) . Server.publish site $ case tapeAlone machine file . Tape <$> content of
    Left why -> Subject.withReports [Cli.toReport (CannotRead why)]
    Right (Left (described, fault)) -> Subject.withText described [fault] Nothing
    Right (Right state) ->
      Subject.withText (Region.fromText (displayName file) "") [] (Just state)
  where
    file = previewFile options

-- | Reads files now, and again whenever one of them changes. The reading gives the files that
-- matter from then on, and what is to be done with their contents. Files are looked at ten times a
-- second: unlike the messages of a file system, that also works for files on other machines, and
-- for files that do not exist yet.
follow :: [FilePath] -> IO ([FilePath], IO ()) -> IO ()
follow first reading = traverse signed first >>= again
  where
    again before = do
      (files, use) <- reading
      known <- traverse (\f -> maybe (signed f) (pure . (f,)) (lookup f before)) files
      use
      wait known
    wait known = do
      threadDelay 100000
      now <- traverse (signed . fst) known
      if now == known then wait known else settled patience now
    -- An editor may still be writing.
    settled left before = do
      threadDelay 20000
      now <- traverse (signed . fst) before
      if now == before || left == 0 then again now else settled (left - 1) now
    patience = 25 :: Int
    signed file = (file,) <$> signatureOf file

-- | Facts that change with a file; Nothing if there is no such file.
type FileSignature = Maybe (FileID, FileOffset, POSIXTime, POSIXTime)

-- | Signature of a file at this moment.
signatureOf :: FilePath -> IO FileSignature
signatureOf file = either (const Nothing :: IOException -> FileSignature) Just <$> try found
  where
    found = do
      status <- getFileStatus file
      pure
        ( fileID status,
          fileSize status,
          modificationTimeHiRes status,
          statusChangeTimeHiRes status
        )

-- Tapes -------------------------------------------------------------------------------------------

-- | Tape or file of G-code without its program.
tapeAlone :: Machine -> FilePath -> Tape -> Either (Region.Source, Report) Sound
tapeAlone machine file rows = case Machine.programForm machine of
  Nothing -> Right (of' rows Nothing)
  Just form -> withFrames <$> GcodeFile.tapeAlone machine form gcode
  where
    text = TapeDifference.textOf rows
    gcode = GcodeFile.GcodeFile (displayName file) text
    of' aloneTape gcodeText = TapeAlone TapeState {tapeMachine = machine, aloneTape, gcodeText}
    withFrames (made, reading) =
      of' made (Just (text, map ToFrames.readFrom (ToFrames.readFrames reading)))

-- Browser -----------------------------------------------------------------------------------------

-- | Opens an address in the browser of the user, if there is a screen and a program that opens it.
openBrowser :: String -> IO ()
openBrowser address = do
  screens <- traverse lookupEnv ["DISPLAY", "WAYLAND_DISPLAY"]
  openers <- traverse findExecutable ["xdg-open", "sensible-browser"]
  case (catMaybes screens, listToMaybe (catMaybes openers)) of
    (_ : _, Just opener) ->
      void (try (void (createProcess (silent opener))) :: IO (Either IOException ()))
    _ -> pure ()
  where
    silent opener =
      (proc opener [address]) {std_in = NoStream, std_out = NoStream, std_err = NoStream}
