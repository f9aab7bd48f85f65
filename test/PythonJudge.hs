-- | Independent judges in Python, which the tests run on the program that was built.
module PythonJudge (agrees) where

import System.Directory (findExecutable)
import System.Exit (ExitCode (ExitSuccess))
import System.Process (readProcessWithExitCode)
import Test.Hspec

-- | The expectation that a script finds no fault in the program @partc@. The script gets the path
-- of the program and then @arguments@; its output tells of the faults. Pending without the Python
-- packages that it imports, which come as their Python names and as the names of Debian packages.
agrees :: FilePath -> [(String, String)] -> [String] -> Expectation
agrees script packages arguments = do
  (found, _, _) <- python ["-c", unlines ["import " <> name | (name, _) <- packages]]
  if found /= ExitSuccess
    then pendingWith ("not all of these are installed: " <> unwords (map snd packages))
    else do
      program <- findExecutable "partc" >>= maybe (fail "partc is not on the path") pure
      (code, out, _) <- python ("-B" : script : program : arguments)
      if code == ExitSuccess then pure () else expectationFailure out
  where
    python given = readProcessWithExitCode "/usr/bin/python3" given ""
