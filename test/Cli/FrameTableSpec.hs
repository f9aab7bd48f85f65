-- | The subcommands @frames@ and @report@: records, frequencies, reference points.
module Cli.FrameTableSpec (spec) where

import Command (partc)
import Data.List (isInfixOf, isPrefixOf)
import Data.Text qualified as Text
import Files (readText)
import System.Exit (ExitCode (..))
import Test.Hspec

spec :: Spec
spec = do
  describe "partc frames --record" $ do
    it "prints the frames of the shaft that docs/machines.md lists" $ do
      page <- readText "docs/machines.md"
      let written =
            [ Text.unpack (Text.dropAround (== '`') (Text.strip cell))
              | line <- Text.lines (snd (Text.breakOn "### The shaft of the course" page)),
                [_, _, cell, _, _, _] <- [Text.splitOn "|" line],
                "`" `Text.isPrefixOf` Text.strip cell,
                "Н`" `Text.isSuffixOf` Text.strip cell
            ]
      length written `shouldBe` 8
      (code, out, _) <- partc ["frames", "examples/shaft.part", "--record"]
      code `shouldBe` ExitSuccess
      lines out `shouldBe` written
    it "is refused on a machine whose words have no letters" $ do
      (code, out, err) <- partc ["frames", "examples/flange.part", "--record"]
      (code, out) `shouldBe` (ExitFailure 1, "")
      err `shouldSatisfy` isInfixOf "error[E0824]"
    it "is not combined with --json" $ do
      (code, _, _) <- partc ["frames", "examples/shaft.part", "--record", "--json"]
      code `shouldBe` ExitFailure 2
  describe "partc frames" $ do
    it "has columns of frequencies for codes that are frequencies, and no others" $ do
      (_, shaft, _) <- partc ["frames", "examples/shaft.part"]
      (_, flange, _) <- partc ["frames", "examples/flange.part"]
      take 1 (lines shaft) `shouldSatisfy` all (isInfixOf "mm/min  Hz x     Hz y ")
      flange `shouldNotSatisfy` isInfixOf "Hz"
    it "has them in JSON, too" $ do
      (_, shaft, _) <- partc ["frames", "examples/shaft.part", "--json"]
      (_, flange, _) <- partc ["frames", "examples/flange.part", "--json"]
      ["\"frequencies\":{\"x\":0,\"y\":900,\"z\":0}" `isInfixOf` l | l <- take 1 (lines shaft)]
        `shouldBe` [True]
      flange `shouldNotSatisfy` isInfixOf "frequencies"
  describe "partc report --points" $
    it "adds the tables of reference points, and nothing else" $ do
      (_, plain, _) <- partc ["report", "-q", "examples/template.part"]
      (_, whole, _) <- partc ["report", "-q", "--points", "examples/template.part"]
      let (before', from) = break ("Reference points" `isPrefixOf`) (lines whole)
          behind = drop 1 (dropWhile (/= "") (drop 2 from))
      take 1 from
        `shouldBe` ["Reference points of section, curve in line 38: 13 of 13 rows on the contour"]
      before' <> behind `shouldBe` lines plain
