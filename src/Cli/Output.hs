-- | Reports to standard error, results to standard output, files whole or not at all.
module Cli.Output
  ( Format (..),
    ColourChoice (..),
    OutputSettings (..),
    plainly,
    Exit (..),
    Reporter (settings),
    reporting,
    show',
    result,
    resultBytes,
    readBytes,
    writeFileWhole,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Source)
import Control.Exception (onException, try)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.IORef (IORef, modifyIORef, newIORef, readIORef)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Data.Text.IO qualified as Text
import Foreign.C.Error (Errno (Errno), eBADF, ePIPE)
import GHC.IO.Exception (IOErrorType (..), IOException (ioe_errno, ioe_type))
import Report.Explanation qualified as Explanation
import Report.Human qualified as Human
import Report.Line qualified as Line
import Report.Report (Report)
import Report.Report qualified as Report
import Report.Sarif (Filed (..))
import Report.Sarif qualified as Sarif
import System.Directory (canonicalizePath, removeFile, renameFile)
import System.Environment (lookupEnv)
import System.FilePath (takeDirectory, takeFileName)
import System.IO
  ( Handle,
    hClose,
    hFlush,
    hIsTerminalDevice,
    openBinaryTempFileWithDefaultPermissions,
    stderr,
    stdout,
  )
import System.IO.Error
  ( ioeGetErrorString,
    isDoesNotExistError,
    isFullError,
    isPermissionError,
    mkIOError,
    permissionErrorType,
  )
import System.Posix.Files
  ( FileStatus,
    fileAccess,
    fileMode,
    getFileStatus,
    isDirectory,
    isRegularFile,
    setFileMode,
  )

-- | How reports are written.
data Format = HumanFormat | ShortFormat | JsonFormat | SarifFormat
  deriving stock (Eq, Show)

data ColourChoice = Auto | Always | Never
  deriving stock (Eq, Show)

-- | What holds for every command.
data OutputSettings = OutputSettings
  { format :: Format,
    colour :: ColourChoice,
    quiet :: Bool,
    -- | warnings count as errors
    werror :: Bool,
    -- | values for the parameters of the program
    values :: [(Text, Text)]
  }
  deriving stock (Eq, Show)

-- | Where nothing was asked.
plainly :: OutputSettings
plainly =
  OutputSettings {format = HumanFormat, colour = Auto, quiet = False, werror = False, values = []}

-- | How a command ended.
data Exit
  = Done
  | -- | the program or the tape has errors, or a file can not be read or written
    Failed
  | -- | a tape is proven wrong
    Disproven
  deriving stock (Eq, Ord, Show)

-- | Why a file can not be read or written.
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

-- | How a run reports. A format with one log for all is kept until the end, the latest first.
data Reporter = Reporter {settings :: OutputSettings, kept :: IORef [Filed]}

-- | Run a command, and write in the end what it has kept.
reporting :: OutputSettings -> (Reporter -> IO a) -> IO a
reporting settings work = do
  kept <- newIORef []
  a <- work Reporter {settings, kept}
  case format settings of
    SarifFormat -> readIORef kept >>= say . Sarif.log Explanation.everything . reverse
    HumanFormat -> pure ()
    ShortFormat -> pure ()
    JsonFormat -> pure ()
  pure a

-- | Write the reports on one file. Says whether anything among them stops the work.
show' :: Reporter -> Text -> Source -> [Report] -> IO Bool
show' Reporter {settings, kept} path source reports = do
  case format settings of
    HumanFormat -> do
      painted <- useColour settings stderr
      let (shown, more) = splitAt mostReports visible
      mapM_ (\r -> say (Human.render painted path source r <> "\n")) shown
      say
        (if null more then "" else Decimal.whole (length more) <> " more reports are not shown.\n")
      say (Human.summary painted visible)
    ShortFormat -> mapM_ (say . Line.short path source) visible
    JsonFormat -> mapM_ (say . Line.json path source) visible
    SarifFormat -> modifyIORef kept (reverse [Filed {path, source, report} | report <- visible] <>)
  pure (any Report.isError reports || werror settings && not (null reports))
  where
    visible =
      Report.sorted
        (if quiet settings && not (werror settings) then filter Report.isError reports else reports)

-- | A person reads no more reports at once.
mostReports :: Int
mostReports = 50

-- | Write to standard error. When nobody reads there, the work goes on.
say :: Text -> IO ()
say text = do
  _ <- try (Text.hPutStr stderr text) :: IO (Either IOException ())
  pure ()

useColour :: OutputSettings -> Handle -> IO Human.Colour
useColour settings handle = case colour settings of
  Always -> pure Human.Coloured
  Never -> pure Human.Plain
  Auto -> do
    terminal <- hIsTerminalDevice handle
    none <- lookupEnv "NO_COLOR"
    dumb <- lookupEnv "TERM"
    pure
      ( if terminal && maybe True null none && dumb /= Just "dumb"
          then Human.Coloured
          else Human.Plain
      )

-- | A result on standard output, all of it. The answer says what went wrong; a reader who has seen
-- enough and closed the pipe is nothing wrong.
result :: Text -> IO (Either Text ())
result = resultBytes . Encoding.encodeUtf8

-- | The same for bytes.
resultBytes :: ByteString -> IO (Either Text ())
resultBytes bytes = either judge Right <$> try (ByteString.hPut stdout bytes *> hFlush stdout)
  where
    judge e
      | ioe_errno e == Just pipe = Right ()
      | otherwise = Left (ioProblem e)
    Errno pipe = ePIPE

-- | All of a file, or of standard input for @-@. The answer says what went wrong.
readBytes :: FilePath -> IO (Either Text ByteString)
readBytes file =
  either (Left . ioProblem) Right
    <$> try (if file == "-" then ByteString.getContents else ByteString.readFile file)

-- | Write a file under a temporary name and rename it: what was there before stays until the new
-- one is complete. A device or a pipe is written to as it is. The answer says what went wrong.
writeFileWhole :: FilePath -> ByteString -> IO (Either Text ())
writeFileWhole path bytes = either problem Right <$> try write
  where
    write = do
      before <- try (getFileStatus path) :: IO (Either IOException FileStatus)
      case before of
        Right status
          | not (isRegularFile status || isDirectory status) ->
            ByteString.writeFile path bytes
        -- Whoever may write in the folder could replace a file that is write-protected.
        Right status | isRegularFile status -> do
          allowed <- fileAccess path False True False
          if allowed
            then replacing before
            else ioError (mkIOError permissionErrorType "writeFile" Nothing (Just path))
        _ -> replacing before
    replacing before =
      canonicalizePath path >>= replace (either (const Nothing) (Just . fileMode) before)
    replace mode place = do
      (temporary, handle) <-
        openBinaryTempFileWithDefaultPermissions
          (takeDirectory place)
          (takeFileName place <> ".new")
      flip onException (hClose handle *> removeFile temporary) $ do
        ByteString.hPut handle bytes
        hClose handle
        mapM_ (setFileMode temporary) mode
        renameFile temporary place
    problem :: IOException -> Either Text ()
    problem = Left . ioProblem
