-- | The command @fix@.
module Cli.FixCommandSpec (spec) where

import Command (inFolder, partc)
import Data.ByteString qualified as ByteString
import Data.List (isInfixOf)
import System.Exit (ExitCode (..))
import System.FilePath ((</>))
import Test.Hspec

spec :: Spec
spec = describe "partc fix" $ do
  it "mends what leaves no choice, prints it, and reports the rest" $
    inFolder $ \folder -> do
      let file = folder </> "a.part"
          wrong = "part a\nlett width = 1,5\nlet c = widht\nlet d = unknown\n"
          mended = "part a\nlet width = 1.5\nlet c = width\nlet d = unknown\n"
      ByteString.writeFile file wrong
      (dry, planned, _) <- partc ["fix", "--dry-run", file]
      ByteString.readFile file `shouldReturn` wrong
      (code, out, err) <- partc ["fix", file]
      (dry, planned) `shouldBe` (code, out)
      code `shouldBe` ExitFailure 1
      out `shouldSatisfy` isInfixOf (file <> ":2:1: Write ‘let’ instead of ‘lett’.")
      err `shouldSatisfy` isInfixOf "nothing is named ‘unknown’"
      ByteString.readFile file `shouldReturn` mended
  it "leaves a choice to the user" $
    inFolder $ \folder -> do
      let file = folder </> "a.part"
          text = "part a\ncontour k closed { circle((0, 0), 5) }\n"
      ByteString.writeFile file text
      (code, out, err) <- partc ["fix", file]
      (code, out) `shouldBe` (ExitFailure 1, "")
      err `shouldSatisfy` isInfixOf "Write ccw before it"
      ByteString.readFile file `shouldReturn` text
  it "mends standard input, and leaves a sound program as it is" $ do
    (code, out, err) <- partc ["fix", "examples/flange.part"]
    (code, out, err) `shouldBe` (ExitSuccess, "", "")
