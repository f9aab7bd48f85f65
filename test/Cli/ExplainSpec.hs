-- | The subcommand @partc explain@.
module Cli.ExplainSpec (spec) where

import Command (partc)
import Data.List (isInfixOf, isPrefixOf)
import System.Exit (ExitCode (..))
import Test.Hspec

spec :: Spec
spec = do
  it "explains a code, in upper or lower case" $ do
    (code, out, err) <- partc ["explain", "E0314"]
    (code, err) `shouldBe` (ExitSuccess, "")
    take 1 (lines out) `shouldBe` ["E0314: Neighbours that meet in more than one point"]
    lines out `shouldContain` ["Wrong:", "", "    part hump"]
    lines out `shouldContain` ["Right:", "", "    part hump"]
    out `shouldNotSatisfy` isInfixOf "```"
    partc ["explain", "e0314"] `shouldReturn` (ExitSuccess, out, "")
    partc ["explain", "314"] `shouldReturn` (ExitSuccess, out, "")
  it "lists all codes with their titles when none is named" $ do
    (code, out, err) <- partc ["explain"]
    (code, err) `shouldBe` (ExitSuccess, "")
    lines out `shouldContain` ["E0101  A word or sign is in a place where it is not allowed"]
    length (lines out) `shouldSatisfy` (> 80)
  it "refuses an unknown code, and suggests similar ones" $ do
    (code, out, err) <- partc ["explain", "E0250"]
    (code, out) `shouldBe` (ExitFailure 1, "")
    take 2 (lines err)
      `shouldBe` [ "error[E0809]: no report has the code ‘E0250’",
                   "  = hint: Did you mean E0205 or E0520 or E0229?"
                 ]
  it "refuses a word that is not a code" $ do
    (code, out, err) <- partc ["explain", "--format", "short", "tangent"]
    (code, out) `shouldBe` (ExitFailure 1, "")
    err `shouldSatisfy` isInfixOf "[E0809]"
  it "refuses more than one code" $ do
    (code, _, err) <- partc ["explain", "E0314", "E0315"]
    code `shouldBe` ExitFailure 2
    err `shouldSatisfy` isPrefixOf "Invalid argument"
