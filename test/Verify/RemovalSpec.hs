-- | Files with helices, ramps, tabs, pockets and cycles, judged by what they leave.
module Verify.RemovalSpec (spec) where

import CaseCount (askedCount)
import Data.Maybe (fromMaybe)
import PythonJudge qualified
import Test.Hspec

spec :: Spec
spec = do
  parts <- runIO (fromMaybe 10 <$> askedCount "PARTC_REMOVAL")
  it "files of random parts leave what has to stand, and no more (pending without Shapely)" $
    PythonJudge.agrees
      "test/heights/removal.py"
      [("numpy", "python3-numpy"), ("shapely", "python3-shapely")]
      ["--parts", show parts, "--altered", "5"]
