-- | The command @run@: its forms, its options, and its reports.
module Cli.RunCommandSpec (spec) where

import Command (inFolder, partc)
import Data.ByteString qualified as ByteString
import Data.List (isInfixOf)
import System.Exit (ExitCode (..))
import System.FilePath ((</>))
import Test.Hspec

spec :: Spec
spec = describe "partc run" $ do
  it "prints a line for each frame, and the totals" $ do
    (code, out, _) <- partc ["run", shaft, "-t", "kontur-3p"]
    code `shouldBe` ExitSuccess
    length (filter ("    900 Hz" `isInfixOf`) (lines out)) `shouldBe` 4
    out `shouldSatisfy` isInfixOf "spindle 8"
    out `shouldSatisfy` isInfixOf "stops                                    at the end of the tape"
  it "shows chosen frames only" $ do
    (_, out, _) <- partc ["run", shaft, "-t", "kontur-3p", "--from", "2", "--to", "3"]
    map (take 7) (take 3 (lines out)) `shouldBe` ["  frame", "      2", "      3"]
  it "writes JSON lines, the total last" $ do
    (code, out, _) <- partc ["run", shaft, "-t", "kontur-3p", "--json"]
    code `shouldBe` ExitSuccess
    length (lines out) `shouldBe` 9
    last (lines out) `shouldSatisfy` isInfixOf "\"total\""
  it "writes one line for each pulse: axis, sign, tick" $ do
    (code, out, _) <- partc ["run", shaft, "-t", "kontur-3p", "--pulses", "--to", "1"]
    code `shouldBe` ExitSuccess
    length (lines out) `shouldBe` 6000
    all ((== ["y", "+"]) . take 2 . words) (lines out) `shouldBe` True
  it "takes a tape, corrects feeds, and refuses a position that the switch lacks (E0816)" $ do
    let five options = partc (["run", "examples/cone.n55.tape", "-t", "n55"] <> options)
    (whole, _, _) <- five []
    (half, out, _) <- five ["--override", "50"]
    (none, _, err) <- five ["--override", "55"]
    (whole, half, none) `shouldBe` (ExitSuccess, ExitSuccess, ExitFailure 1)
    out `shouldSatisfy` isInfixOf "at the end of the program"
    err `shouldSatisfy` isInfixOf "E0816"
  it "stops before a damaged frame with the signal of the control (E0601)" $
    inFolder $ \folder -> do
      _ <- partc ["compile", "examples/shaft.part", "-t", "kontur-3p", "-o", folder </> "s.tape"]
      rows <- ByteString.readFile (folder </> "s.tape")
      -- The check digit of frame 1 is a 9, and becomes an 8.
      ByteString.writeFile
        (folder </> "bad.tape")
        (ByteString.take 25 rows <> ByteString.pack [8] <> ByteString.drop 26 rows)
      (code, out, err) <- partc ["run", folder </> "bad.tape", "-t", "kontur-3p"]
      code `shouldBe` ExitFailure 1
      out `shouldSatisfy` isInfixOf "ошибка считывания"
      err `shouldSatisfy` isInfixOf "E0601"
  it "has times but no pulses for G-code (E0815)" $ do
    (code, out, _) <- partc ["run", "examples/flange.part", "-t", "iso6983"]
    (none, _, err) <- partc ["run", "examples/flange.part", "-t", "iso6983", "--pulses"]
    (code, none) `shouldBe` (ExitSuccess, ExitFailure 1)
    out `shouldSatisfy` isInfixOf "at the end of the program"
    err `shouldSatisfy` isInfixOf "E0815"
  where
    shaft = "examples/shaft.part"
