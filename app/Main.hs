-- | The command @partc@: sets up the streams, runs the command line, and returns the exit status.
module Main (main) where

import Base.Crash (Bug)
import Cli.OptionError qualified as OptionError
import Cli.Options qualified as Options
import Cli.Output (Exit (..))
import Cli.Subcommand qualified as Subcommand
import Control.Exception
  ( AsyncException (UserInterrupt),
    Handler (..),
    SomeException,
    catches,
    toException,
  )
import Data.Version (showVersion)
import GHC.IO.Encoding (mkTextEncoding, setFileSystemEncoding, setLocaleEncoding, utf8)
import Options.Applicative qualified as Opt
import Paths_partc (version)
import System.Environment (getArgs, getProgName)
import System.Exit (ExitCode (..), exitWith)
import System.IO (hPutStr, hPutStrLn, hSetEncoding, stderr, stdin, stdout)

main :: IO ()
main = do
  setLocaleEncoding utf8
  -- File names may be any bytes: this encoding also keeps names that are not UTF-8.
  mkTextEncoding "UTF-8//ROUNDTRIP" >>= setFileSystemEncoding
  mapM_ (`hSetEncoding` utf8) [stdin, stdout, stderr]
  code <- work `catches` [Handler pure, Handler interrupted, Handler crashed, Handler unexpected]
  exitWith code

-- | Parses the command line and runs its subcommand.
work :: IO ExitCode
work = do
  arguments <- getArgs
  name <- getProgName
  let parsed = Opt.execParserPure (Opt.prefs Opt.showHelpOnEmpty) parser arguments
  case parsed of
    -- Optparse-applicative treats --help and --version as failures with the status of success.
    Opt.Failure request
      | (text, ExitSuccess) <- Opt.renderFailure request name ->
        statusOf <$> Subcommand.showHelp text
      | (text, status) <- Opt.renderFailure request name,
        Just report <- OptionError.explained parser text arguments ->
        status <$ hPutStr stderr report
    _ -> statusOf <$> (Opt.handleParseResult parsed >>= Subcommand.run versionText)
  where
    versionText = showVersion version
    parser = Options.parser versionText

-- | The exit status: 0 for success, 1 for errors, 3 for a tape that @verify@ has proven wrong.
statusOf :: Exit -> ExitCode
statusOf end = case end of
  Done -> ExitSuccess
  Failed -> ExitFailure 1
  Disproven -> ExitFailure 3

-- | The exit status after an asynchronous exception: 130 for Ctrl-C. Any other exception is
-- reported as a bug.
interrupted :: AsyncException -> IO ExitCode
interrupted e = case e of
  UserInterrupt -> pure (ExitFailure 130)
  _ -> unexpected (toException e)

crashed :: Bug -> IO ExitCode
crashed b = reportBug (show b)

unexpected :: SomeException -> IO ExitCode
unexpected e = reportBug (show e)

-- | Asks the user to report a bug of the compiler; @what@ is the message of the exception. The exit
-- status is 70.
reportBug :: String -> IO ExitCode
reportBug what = do
  hPutStrLn
    stderr
    "This is a bug in partc. Please send us the program that you compiled and these lines:"
  hPutStrLn stderr what
  pure (ExitFailure 70)
