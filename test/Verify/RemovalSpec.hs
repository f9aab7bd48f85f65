-- | Files with helices, ramps, tabs, pockets and cycles, judged by what they leave.
module Verify.RemovalSpec (spec) where

import CaseCount (askedCount)
import Data.Maybe (fromMaybe)
import System.Directory (findExecutable)
import System.Exit (ExitCode (ExitSuccess))
import System.Process (readProcessWithExitCode)
import Test.Hspec

spec :: Spec
spec = do
  parts <- runIO (fromMaybe 10 <$> askedCount "PARTC_REMOVAL")
  it "files of random parts leave what has to stand, and no more (pending without Shapely)" $ do
    (found, _, _) <- readProcessWithExitCode python ["-c", "import numpy, shapely"] ""
    if found /= ExitSuccess
      then pendingWith "the packages python3-numpy and python3-shapely are not installed"
      else do
        program <- findExecutable "partc" >>= maybe (fail "partc is not on the path") pure
        (code, out, _) <-
          readProcessWithExitCode
            python
            ["-B", "test/heights/removal.py", program, "--parts", show parts, "--altered", "5"]
            ""
        if code == ExitSuccess then pure () else expectationFailure out
  where
    python = "/usr/bin/python3"
