-- | The command @partc@ as a user runs it, for tests.
module Command
  ( partc,
    inFolder,
  )
where

import System.Directory (findExecutable)
import System.Exit (ExitCode)
import System.IO.Temp (withSystemTempDirectory)
import System.Process (readProcessWithExitCode)

-- | Runs @partc@ with these arguments. Yields the exit status, standard output and standard error.
partc :: [String] -> IO (ExitCode, String, String)
partc arguments = do
  found <- findExecutable "partc"
  case found of
    Nothing -> fail "partc is not on the path"
    Just program -> readProcessWithExitCode program arguments ""

-- | Runs an action in a temporary folder.
inFolder :: (FilePath -> IO a) -> IO a
inFolder = withSystemTempDirectory "partc"
