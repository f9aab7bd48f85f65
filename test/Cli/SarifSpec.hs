-- | The option @--format sarif@: one log for each run, on standard error.
module Cli.SarifSpec (spec) where

import Command (inFolder, partc)
import Data.Aeson qualified as Aeson
import Data.ByteString.Lazy qualified as LazyByteString
import Data.List (isInfixOf)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import System.Exit (ExitCode (..))
import System.FilePath ((</>))
import Test.Hspec

spec :: Spec
spec = do
  it "gives one log without results if there are no reports" $ do
    (code, out, err) <- partc ["check", "--format", "sarif", "examples/flange.part"]
    (code, out) `shouldBe` (ExitSuccess, "")
    err
      `shouldBe` "{\"$schema\":\"https://json.schemastore.org/sarif-2.1.0.json\",\
                 \\"version\":\"2.1.0\",\
                 \\"runs\":[{\"tool\":{\"driver\":{\"name\":\"partc\",\
                 \\"semanticVersion\":\"0.1.0\",\"rules\":[]}},\
                 \\"originalUriBaseIds\":{\"%SRCROOT%\":{\"description\":{\"text\":\
                 \\"the folder in which partc was run\"}}},\
                 \\"columnKind\":\"unicodeCodePoints\",\"results\":[]}]}\n"
  it "contains the reports of all files, in the order of the command line" $ do
    (code, out, err) <-
      partc
        [ "--format",
          "sarif",
          "check",
          "test/programs/surface/bad/five-mistakes.part",
          "examples/flange.part",
          "no such.part",
          "test/programs/machine/good/feed-warning.part"
        ]
    (code, out) `shouldBe` (ExitFailure 1, "")
    length (lines err) `shouldBe` 1
    isJson err `shouldBe` True
    codesOf err `shouldBe` ["E0105", "E0105", "E0101", "E0101", "E0108", "E0801", "W0501", "W0501"]
    err `shouldSatisfy` isInfixOf "\"uri\":\"no%20such.part\""
  it "keeps results on standard output, and omits warnings with -q" $ do
    (code, out, err) <-
      partc ["--format", "sarif", "-q", "report", "test/programs/machine/good/feed-warning.part"]
    code `shouldBe` ExitSuccess
    out `shouldSatisfy` isInfixOf "frames"
    (isJson err, codesOf err) `shouldBe` (True, [])
  it "contains the warnings if they count as errors (--werror)" $ do
    (code, _, err) <-
      partc
        ["--format", "sarif", "--werror", "check", "test/programs/machine/good/feed-warning.part"]
    (code, codesOf err) `shouldBe` (ExitFailure 1, ["W0501", "W0501"])
  it "contains the reports on a damaged tape and on the command line" $
    inFolder $ \folder -> do
      writeFile (folder </> "x.tape") "abc"
      (code, _, err) <- partc ["--format", "sarif", "decode", "-t", "lkp-01f", folder </> "x.tape"]
      (code, codesOf err) `shouldBe` (ExitFailure 1, ["E0601"])
      (code', _, err') <- partc ["explain", "E9999", "--format", "sarif"]
      (code', codesOf err') `shouldBe` (ExitFailure 1, ["E0809"])

isJson :: String -> Bool
isJson text =
  case Aeson.decode (LazyByteString.fromStrict (Encoding.encodeUtf8 (Text.pack text))) of
    Just (Aeson.Object _) -> True
    _ -> False

-- | The codes of the results, in their order.
codesOf :: String -> [String]
codesOf text =
  [Text.unpack (Text.take 5 rest) | rest <- drop 1 (Text.splitOn "\"ruleId\":\"" (Text.pack text))]
