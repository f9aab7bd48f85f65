-- | The command @run@: its forms, its options, and its reports.
module Cli.RunCommandSpec (spec) where

import Command (inFolder, partc)
import Data.ByteString qualified as ByteString
import Data.List (isInfixOf)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
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
  it "refuses frames that the tape lacks, and switches that the control lacks" $ do
    let refused code options = do
          (exit, out, err) <- partc (["run", "examples/cone.n55.tape", "-t", "n55"] <> options)
          (exit, out) `shouldBe` (ExitFailure 1, "")
          err `shouldSatisfy` isInfixOf ("error[" <> code <> "]")
    refused "E0812" ["--from", "8", "--to", "3"]
    refused "E0812" ["--pulses", "--from", "99"]
    refused "E0812" ["--speed", "--from", "13"]
    refused "E0816" ["--switch", "36=5"]
    refused "E0816" ["--switch", "1=5", "--switch", "1=6"]
  it "draws no picture of a run that stops at a fault, and keeps the file that was there" $
    inFolder $ \folder -> do
      tape <- ByteString.readFile "examples/cone.n55.tape"
      let torn = folder </> "torn.n55.tape"
          picture = folder </> "speed.svg"
      ByteString.writeFile torn (ByteString.take 150 tape <> "\255" <> ByteString.drop 151 tape)
      ByteString.writeFile picture "kept"
      (code, _, err) <- partc ["run", torn, "-t", "n55", "--speed", "-o", picture]
      code `shouldBe` ExitFailure 1
      err `shouldSatisfy` isInfixOf "E0601"
      ByteString.readFile picture `shouldReturn` "kept"
  it "begins where the program begins, on a machine whose tapes give positions" $
    inFolder $ \folder -> do
      let file = folder </> "away.part"
      ByteString.writeFile file . Encoding.encodeUtf8 . Text.unlines $
        [ "part away",
          "machine iso6983",
          "tool mill(diameter 10 mm)",
          "tolerance 0.02 mm",
          "from (100, 0)",
          "feed 60 mm/min",
          "move (110, 0)"
        ]
      (_, out, _) <- partc ["run", file, "--json", "--to", "1"]
      out `shouldSatisfy` isInfixOf "\"pulses\":{\"x\":10000,\"y\":0,\"z\":0}"
  it "has times but no pulses for G-code (E0815)" $ do
    (code, out, _) <- partc ["run", "examples/flange.part", "-t", "iso6983"]
    (none, _, err) <- partc ["run", "examples/flange.part", "-t", "iso6983", "--pulses"]
    (code, none) `shouldBe` (ExitSuccess, ExitFailure 1)
    out `shouldSatisfy` isInfixOf "at the end of the program"
    err `shouldSatisfy` isInfixOf "E0815"
  it "draws the speed into a file or to standard output, and refuses to replace the program" $
    inFolder $ \folder -> do
      text <- readFile "examples/flange.part"
      writeFile (folder </> "flange.part") text
      let speed options =
            partc (["run", folder </> "flange.part", "-t", "lki-u", "--speed"] <> options)
      (code, out, _) <- speed ["--to", "3"]
      (written, _, _) <- speed ["--to", "3", "-o", folder </> "x.svg"]
      drawn <- ByteString.readFile (folder </> "x.svg")
      (refused, _, err) <- speed ["-o", folder </> "flange.part"]
      (code, written, refused) `shouldBe` (ExitSuccess, ExitSuccess, ExitFailure 1)
      Encoding.encodeUtf8 (Text.pack out) `shouldBe` drawn
      out `shouldSatisfy` isInfixOf "flange.part on lki-u"
      err `shouldSatisfy` isInfixOf "E0807"
      readFile (folder </> "flange.part") `shouldReturn` text
  it "draws the jobs of a dispatcher, which other controllers lack (E0817)" $ do
    let timeline machine options =
          partc (["run", "examples/flange.part", "-t", machine, "--timeline"] <> options)
    (code, out, _) <- timeline "n55" ["--from", "3"]
    (none, _, err) <- timeline "lki-u" []
    (late, _, err') <- timeline "n55" ["--ticks", "90000000..90000100"]
    (code, none, late) `shouldBe` (ExitSuccess, ExitFailure 1, ExitFailure 1)
    out `shouldSatisfy` isInfixOf "frame 3"
    err `shouldSatisfy` isInfixOf "E0817"
    err' `shouldSatisfy` isInfixOf "E0812"
  it "draws no frames that the tape lacks (E0812), and no speed of a path planner (E0815)" $ do
    (late, _, err) <- partc ["run", shaft, "-t", "kontur-3p", "--speed", "--from", "9"]
    (none, _, err') <- partc ["run", "examples/flange.part", "-t", "iso6983", "--speed"]
    (late, none) `shouldBe` (ExitFailure 1, ExitFailure 1)
    err `shouldSatisfy` isInfixOf "E0812"
    err' `shouldSatisfy` isInfixOf "E0815"
  where
    shaft = "examples/shaft.part"
