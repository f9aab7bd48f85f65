-- | Input and output of subcommands. Reports are written to standard error, results to standard
-- output. A file is written completely or not at all.
module Cli.Output
  ( Format (..),
    ColourChoice (..),
    OutputSettings (..),
    defaultSettings,
    Exit (..),
    Reporter (settings),
    reporting,
    showReports,
    result,
    resultBytes,
    resultStream,
    collectingOften,
    readBytes,
    writeFileWhole,
    ioProblem,
  )
where

import Base.Decimal qualified as Decimal
import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.Region (Source)
import Cli.Terminal qualified as Terminal
import Control.Concurrent (forkIO, killThread, threadDelay)
import Control.Exception (bracket, onException, try)
import Control.Monad (forever)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Builder (Builder)
import Data.ByteString.Builder qualified as Builder
import Data.IORef (IORef, modifyIORef, newIORef, readIORef)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Data.Text.IO qualified as Text
import Foreign.C.Error (Errno (Errno), eBADF, ePIPE)
import GHC.IO.Exception (IOErrorType (..), IOException (ioe_errno, ioe_type))
import Report.Explanation qualified as Explanation
import Report.Human qualified as Human
import Report.LineFormat qualified as LineFormat
import Report.Report (Report)
import Report.Report qualified as Report
import Report.Sarif (Filed (..))
import Report.Sarif qualified as Sarif
import System.Directory (canonicalizePath, removeFile, renameFile)
import System.Environment (lookupEnv)
import System.FilePath (takeDirectory, takeFileName)
import System.IO
  ( Handle,
    IOMode (ReadMode),
    hClose,
    hFlush,
    hIsTerminalDevice,
    openBinaryTempFileWithDefaultPermissions,
    stderr,
    stdin,
    stdout,
    withBinaryFile,
  )
import System.IO.Error
  ( ioeGetErrorString,
    isDoesNotExistError,
    isFullError,
    isPermissionError,
    mkIOError,
    permissionErrorType,
  )
import System.Mem (performMajorGC)
import System.Posix.Files
  ( FileStatus,
    fileAccess,
    fileMode,
    getFileStatus,
    isDirectory,
    isRegularFile,
    setFileMode,
  )

-- | The form of reports: excerpts for a person, one line for each report, one JSON object for each
-- report, or one SARIF log of all reports.
data Format = HumanFormat | ShortFormat | JsonFormat | SarifFormat
  deriving stock (Eq, Show)

-- | The user's choice of coloured reports. 'Auto' colours them if they go to a terminal and the
-- environment variable @NO_COLOR@ is empty or not set.
data ColourChoice = Auto | Always | Never
  deriving stock (Eq, Show)

-- | The settings that every subcommand has.
data OutputSettings = OutputSettings
  { format :: Format,
    colour :: ColourChoice,
    -- | true to leave out warnings; no effect if 'werror' is true
    quiet :: Bool,
    -- | true if warnings count as errors
    werror :: Bool,
    -- | names of parameters of the program, with the values that replace those of the program
    values :: [(Text, Text)]
  }
  deriving stock (Eq, Show)

-- | The settings of a command line without options.
defaultSettings :: OutputSettings
defaultSettings =
  OutputSettings {format = HumanFormat, colour = Auto, quiet = False, werror = False, values = []}

-- | The exit status of a command. The constructors are in ascending order of severity. A command
-- on several files ends with the maximum of the statuses of these files.
data Exit
  = Done
  | -- | the program or the tape has errors, or a file cannot be read or written
    Failed
  | -- | the proof finds that the tape does not make the part
    Disproven
  deriving stock (Eq, Ord, Show)

-- | The reason why a file cannot be read or written, for the end of a report's sentence.
ioProblem :: IOException -> Text
ioProblem e
  | isDoesNotExistError e = "there is no such file or folder"
  | isPermissionError e = "permission denied"
  | isFullError e = "the disk is full"
  | ioe_errno e == Just closed = "it is closed"
  | otherwise = case ioe_type e of
    InappropriateType -> "it is not a file"
    InvalidArgument -> "this is not a possible file name"
    _ -> Text.pack (ioeGetErrorString e)
  where
    Errno closed = eBADF

-- | The means to write the reports of one run of partc. In the SARIF format, one log contains the
-- reports of the whole run. They are kept in @collected@ until the end, the latest first. For
-- other formats the list stays empty.
data Reporter = Reporter {settings :: OutputSettings, collected :: IORef [Filed]}

-- | Runs a command. In the SARIF format, writes the log of the collected reports after the
-- command. @version@ is that of partc, which the log contains.
reporting :: Text -> OutputSettings -> (Reporter -> IO a) -> IO a
reporting version settings work = do
  collected <- newIORef []
  a <- work Reporter {settings, collected}
  case format settings of
    SarifFormat ->
      readIORef collected >>= writeError . Sarif.log version Explanation.everything . reverse
    HumanFormat -> pure ()
    ShortFormat -> pure ()
    JsonFormat -> pure ()
  pure a

-- | Writes the reports about one file. The result is true if one of the reports stops the command:
-- an error, or a warning if 'werror' is true. @path@ is the name of the file; @source@ is its
-- text, to which the regions refer.
showReports :: Reporter -> Text -> Source -> [Report] -> IO Bool
showReports Reporter {settings, collected} path source reports = do
  case format settings of
    HumanFormat -> do
      colours <- useColour settings stderr
      width <- fromMaybe Human.usualWidth <$> Terminal.columns stderr
      let (shown, more) = splitAt mostReports visible
      mapM_ (\r -> writeError (Human.renderWithin width colours path source r <> "\n")) shown
      writeError
        (if null more then "" else Decimal.whole (length more) <> " more reports are not shown.\n")
      writeError (Human.summary colours visible)
    ShortFormat -> mapM_ (writeError . LineFormat.short path source) visible
    JsonFormat -> mapM_ (writeError . LineFormat.json path source) visible
    SarifFormat -> modifyIORef collected (reverse filed <>)
  pure (any Report.isError reports || werror settings && not (null reports))
  where
    filed = [Filed {path, source, report} | report <- visible]
    visible =
      Report.sorted
        (if quiet settings && not (werror settings) then filter Report.isError reports else reports)

-- | The greatest count of reports about one file that are shown in 'HumanFormat'. If there are
-- more, a line says how many are left out.
mostReports :: Int
mostReports = 50

-- | Writes a text to standard error. A failure, such as a closed pipe, does not stop the command.
writeError :: Text -> IO ()
writeError text = do
  _ <- try (Text.hPutStr stderr text) :: IO (Either IOException ())
  pure ()

-- | Decides if reports that go to the stream @handle@ are coloured. With 'Auto' they are not
-- coloured on a terminal of the type @dumb@.
useColour :: OutputSettings -> Handle -> IO Human.Colour
useColour settings handle = case colour settings of
  Always -> pure Human.Coloured
  Never -> pure Human.Plain
  Auto -> do
    isTerminal <- hIsTerminalDevice handle
    noColour <- lookupEnv "NO_COLOR"
    terminal <- lookupEnv "TERM"
    pure
      ( if isTerminal && maybe True null noColour && terminal /= Just "dumb"
          then Human.Coloured
          else Human.Plain
      )

-- | Writes a command's result to standard output. 'Left' is the reason of a failure. A pipe that
-- its reader has closed is not a failure, because the reader wants no more.
result :: Text -> IO (Either Text ())
result = resultBytes . Encoding.encodeUtf8

-- | Writes bytes to standard output. 'Left' is the reason of a failure. A pipe that its reader has
-- closed is not a failure.
resultBytes :: ByteString -> IO (Either Text ())
resultBytes bytes = either judge Right <$> try (ByteString.hPut stdout bytes *> hFlush stdout)
  where
    judge e
      | ioe_errno e == Just pipe = Right ()
      | otherwise = Left (ioProblem e)
    Errno pipe = ePIPE

-- | Writes the parts of a stream to standard output, one after the other, and gives the value at
-- its end. 'Left' is the reason of a failure. Nothing takes the place of the value if the reader of
-- a pipe has closed it.
resultStream :: LazyList e Builder -> IO (Either Text (Maybe e))
resultStream list = case list of
  LazyList.End e -> either judge (const (Right (Just e))) <$> try (hFlush stdout)
  LazyList.Next part more ->
    try (Builder.hPutBuilder stdout part) >>= either (pure . judge) (const (resultStream more))
  where
    judge e
      | ioe_errno e == Just pipe = Right Nothing
      | otherwise = Left (ioProblem e)
    Errno pipe = ePIPE

-- | Runs an action while another thread collects garbage again and again. So a stream needs little
-- memory even though the runtime of the program is set to collect rarely.
collectingOften :: IO a -> IO a
collectingOften action =
  bracket (forkIO (forever (threadDelay 30000 *> performMajorGC))) killThread (const action)

-- | The bytes of a file, or of standard input for @-@; or the reason why they cannot be read. A
-- file of more than 'mostBytes' is refused, also one without an end, such as a device.
readBytes :: FilePath -> IO (Either Text ByteString)
readBytes file = either (Left . ioProblem) id <$> try contents
  where
    contents
      | file == "-" = readAtMost mostBytes stdin
      | otherwise = withBinaryFile file ReadMode (readAtMost mostBytes)

-- | Reads to the end of the input, or gives a reason if there are more than @most@ bytes.
readAtMost :: Int -> Handle -> IO (Either Text ByteString)
readAtMost most handle = go [] 0
  where
    go chunks size
      | size > most = pure (Left "it has more than 256 MB, or no end")
      | otherwise = do
        chunk <- ByteString.hGetSome handle chunkSize
        if ByteString.null chunk
          then pure (Right (ByteString.concat (reverse chunks)))
          else go (chunk : chunks) (size + ByteString.length chunk)
    chunkSize = 1048576

-- | The largest input, 256 MB. A program of a million rows has some 30 MB.
mostBytes :: Int
mostBytes = 268435456

-- | Writes a file under a temporary name and renames it, so the old file stays until the new one
-- is complete. The new file has the permissions of the old one. A device or a pipe is written
-- directly. 'Left' is the reason of a failure.
writeFileWhole :: FilePath -> ByteString -> IO (Either Text ())
writeFileWhole path bytes = either problem Right <$> try write
  where
    write = do
      status <- try (getFileStatus path) :: IO (Either IOException FileStatus)
      case status of
        Right known
          | not (isRegularFile known || isDirectory known) ->
            ByteString.writeFile path bytes
        -- Renaming would replace even a write-protected file, so the protection is checked first.
        Right known | isRegularFile known -> do
          isWritable <- fileAccess path False True False
          if isWritable
            then replaceKeepingMode status
            else ioError (mkIOError permissionErrorType "writeFile" Nothing (Just path))
        _ -> replaceKeepingMode status
    replaceKeepingMode status =
      canonicalizePath path >>= replace (either (const Nothing) (Just . fileMode) status)
    replace mode target = do
      (temporary, handle) <-
        openBinaryTempFileWithDefaultPermissions
          (takeDirectory target)
          (takeFileName target <> ".new")
      flip onException (hClose handle *> removeFile temporary) $ do
        ByteString.hPut handle bytes
        hClose handle
        mapM_ (setFileMode temporary) mode
        renameFile temporary target
    problem :: IOException -> Either Text ()
    problem = Left . ioProblem
