-- | The command as a user runs it, for tests.
module Command
  ( partc,
    inFolder,
  )
where

import System.Directory (findExecutable)
import System.Exit (ExitCode)
import System.IO.Temp (withSystemTempDirectory)
import System.Process (readProcessWithExitCode)

-- | Run it with these arguments: exit status, standard output, standard error.
partc :: [String] -> IO (ExitCode, String, String)
partc arguments = do
  there <- findExecutable "partc"
  case there of
    Nothing -> fail "partc is not on the path"
    Just program -> readProcessWithExitCode program arguments ""

-- | Work in a folder that vanishes behind it.
inFolder :: (FilePath -> IO a) -> IO a
inFolder = withSystemTempDirectory "partc"
