-- | The command @partc@: sets up the streams, runs the command line, and returns the exit status.
module Main (main) where

import Base.Crash (Bug)
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
import System.IO (hPutStrLn, hSetEncoding, stderr, stdin, stdout)

main :: IO ()
main = do
  setLocaleEncoding utf8
  -- File names are bytes; those that are not UTF-8 pass unchanged.
  mkTextEncoding "UTF-8//ROUNDTRIP" >>= setFileSystemEncoding
  mapM_ (`hSetEncoding` utf8) [stdin, stdout, stderr]
  code <- work `catches` [Handler pure, Handler interrupted, Handler crashed, Handler unexpected]
  exitWith code

work :: IO ExitCode
work = do
  parsed <-
    Opt.execParserPure (Opt.prefs Opt.showHelpOnEmpty) (Options.parser (showVersion version))
      <$> getArgs
  name <- getProgName
  statusOf <$> case parsed of
    -- The parser gives the help and the version as failures with the status of success.
    Opt.Failure request
      | (text, ExitSuccess) <- Opt.renderFailure request name -> Subcommand.showHelp text
    _ -> Opt.handleParseResult parsed >>= Subcommand.run

statusOf :: Exit -> ExitCode
statusOf end = case end of
  Done -> ExitSuccess
  Failed -> ExitFailure 1
  Disproven -> ExitFailure 3

interrupted :: AsyncException -> IO ExitCode
interrupted e = case e of
  UserInterrupt -> pure (ExitFailure 130)
  _ -> unexpected (toException e)

crashed :: Bug -> IO ExitCode
crashed b = reportBug (show b)

unexpected :: SomeException -> IO ExitCode
unexpected e = reportBug (show e)

-- | Reports a bug of the compiler: exit status 70.
reportBug :: String -> IO ExitCode
reportBug what = do
  hPutStrLn
    stderr
    "This is a bug in partc. Please send us the program that you compiled and these lines:"
  hPutStrLn stderr what
  pure (ExitFailure 70)
