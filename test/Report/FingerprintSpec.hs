-- | Fingerprints of lines. The expected ones were computed by a program in another language that
-- reads the text one character after the other, as that of GitHub does.
module Report.FingerprintSpec (spec) where

import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fingerprint qualified as Fingerprint
import Test.Hspec hiding (example)

spec :: Spec
spec = do
  it "are those that GitHub computes" $ do
    Fingerprint.ofLines example
      `shouldBe` [ "29642ed1378fedf5:1",
                   "c5b6b9ba980c71fc:1",
                   "e303ad912f780aa8:1",
                   "d767eff5dd38f7de:1",
                   "43b6461eda086fe2:1"
                 ]
    Fingerprint.ofLines [""] `shouldBe` ["c129715d7a2bc9a3:1"]
  it "count equal lines" $ do
    let found = Fingerprint.ofLines (replicate 150 "a" <> [""])
    take 3 found `shouldBe` ["83d4df87b9db256:1", "83d4df87b9db256:2", "83d4df87b9db256:3"]
    drop 147 found
      `shouldBe` [ "e5109e06824fe778:1",
                   "ee4468fa4a9bc719:1",
                   "243cbaa4685aab12:1",
                   "c129715d7a2bc9a3:1"
                 ]
  it "do not change when lines before them or their indentation do" $ do
    drop 1 (Fingerprint.ofLines ("another" : example)) `shouldBe` Fingerprint.ofLines example
    Fingerprint.ofLines (map ("\t  " <>) example) `shouldBe` Fingerprint.ofLines example
  where
    example :: [Text]
    example =
      Text.splitOn "\n" "part p \"Фланец 😀\"\nmill c outside { }\n\n  mill c outside { }\nend"
