-- | The program @partc@ as a user runs it: exit status, streams, files.
module Cli.CommandSpec (spec) where

import Command (inFolder, partc)
import Control.Monad (forM_)
import Data.Aeson qualified as Aeson
import Data.ByteString qualified as ByteString
import Data.Either (isRight)
import Data.List (isInfixOf, isPrefixOf, isSuffixOf)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Flange qualified
import System.Directory
  ( copyFile,
    createFileLink,
    doesFileExist,
    getPermissions,
    listDirectory,
    setPermissions,
    writable,
  )
import System.Exit (ExitCode (..))
import System.FilePath ((</>))
import System.Process (readCreateProcessWithExitCode, shell)
import Tape.Tape (Tape (..))
import Test.Hspec

spec :: Spec
spec = do
  describe "compile" $ do
    it "writes the tape beside the program, and nothing else" $
      inFolder $ \folder -> do
        copyFlange folder
        partc ["compile", folder </> "flange.part"] `shouldReturn` (ExitSuccess, "", "")
        tape <- ByteString.readFile (folder </> "flange.lkp-01f.tape")
        Tape tape `shouldBe` Flange.tape
        files <- listDirectory folder
        files `shouldMatchList` ["flange.part", "flange.lkp-01f.tape"]
    it "gives the same bytes through a folder, a file, and standard output" $
      inFolder $ \folder -> do
        copyFlange folder
        _ <- partc ["compile", folder </> "flange.part", "-o", folder <> "/"]
        _ <- partc ["compile", folder </> "flange.part", "-t", "lkp-01f", "-o", folder </> "x.tape"]
        a <- ByteString.readFile (folder </> "flange.lkp-01f.tape")
        b <- ByteString.readFile (folder </> "x.tape")
        (code, _, _) <-
          readCreateProcessWithExitCode
            ( shell
                ( "partc compile - -o - < "
                    <> (folder </> "flange.part")
                    <> " > "
                    <> (folder </> "y.tape")
                )
            )
            ""
        c <- ByteString.readFile (folder </> "y.tape")
        code `shouldBe` ExitSuccess
        [b, c] `shouldBe` [a, a]
    it "leaves an old tape unchanged when the program has errors" $
      inFolder $ \folder -> do
        writeFile (folder </> "x.part") "part x\nlet a = (1,\n"
        writeFile (folder </> "x.tape") "keep"
        (code, out, err) <-
          partc ["compile", folder </> "x.part", "-t", "lkp-01f", "-o", folder </> "x.tape"]
        (code, out) `shouldBe` (ExitFailure 1, "")
        err `shouldSatisfy` isInfixOf "error[E0105]"
        readFile (folder </> "x.tape") `shouldReturn` "keep"
    it "reports a file without an end, as a program and as a tape" $
      inFolder $ \folder -> do
        copyFlange folder
        (code, _, err) <- partc ["check", "/dev/zero"]
        (code, "error[E0801]" `isInfixOf` err) `shouldBe` (ExitFailure 1, True)
        (code', _, err') <- partc ["verify", folder </> "flange.part", "/dev/zero"]
        (code', "error[E0801]" `isInfixOf` err') `shouldBe` (ExitFailure 1, True)
    it "leaves a write-protected file unchanged" $
      inFolder $ \folder -> do
        copyFlange folder
        writeFile (folder </> "x.tape") "keep"
        permissions <- getPermissions (folder </> "x.tape")
        setPermissions (folder </> "x.tape") permissions {writable = False}
        mayWrite <- writable <$> getPermissions (folder </> "x.tape")
        -- An administrator may write to every file.
        if mayWrite
          then pendingWith "run by someone who may write into protected files"
          else do
            (code, out, err) <-
              partc ["compile", folder </> "flange.part", "-o", folder </> "x.tape"]
            (code, out) `shouldBe` (ExitFailure 1, "")
            err `shouldSatisfy` isInfixOf "error[E0802]"
            readFile (folder </> "x.tape") `shouldReturn` "keep"
    it "reports imports that are nested more than 100 deep, even without a cycle" $
      inFolder $ \folder -> do
        forM_ [0 .. 120 :: Int] $ \k ->
          writeFile
            (folder </> ("i" <> show k <> ".part"))
            ( if k < 120
                then "import \"i" <> show (k + 1) <> ".part\"\nlet a" <> show k <> " = 1\n"
                else "let a120 = 1\n"
            )
        writeFile (folder </> "x.part") "part x\nimport \"i0.part\"\n"
        (code, _, err) <- partc ["check", folder </> "x.part"]
        code `shouldBe` ExitFailure 1
        (err, isInfixOf "error[E0112]" err && isInfixOf "more than 100 deep" err)
          `shouldSatisfy` snd
    it "reads a file once, by whatever paths it is imported" $
      inFolder $ \folder -> do
        writeFile (folder </> "size.part") "let r = 5 mm\n"
        createFileLink "size.part" (folder </> "other.part")
        writeFile
          (folder </> "x.part")
          ( unlines
              [ "part x",
                "import \"size.part\"",
                "import \"other.part\"",
                "import " <> show (folder </> "size.part"),
                "contour k closed { cw circle((0, 0), r) }"
              ]
          )
        partc ["check", folder </> "x.part"] `shouldReturn` (ExitSuccess, "", "")
        writeFile (folder </> "size.part") "import \"other.part\"\nlet r = 5 mm\n"
        (code, _, err) <- partc ["check", folder </> "x.part"]
        code `shouldBe` ExitFailure 1
        err `shouldSatisfy` isInfixOf "error[E0113]"
    it "writes no file for any bad program" $
      inFolder $ \folder ->
        forM_
          [ "fillet/bad/cannot-fit",
            "values/bad/nan-angle",
            "values/bad/zero-line",
            "tangent/bad/concentric",
            "tangent/bad/coincident",
            "mill/bad/concave-radius",
            "settings/bad/feed-not-there"
          ]
          $ \name ->
            do
              (code, out, err) <-
                partc ["compile", "test/programs/" <> name <> ".part", "-o", folder </> "out.tape"]
              (code, out) `shouldBe` (ExitFailure 1, "")
              err `shouldSatisfy` isInfixOf "error[E"
              doesFileExist (folder </> "out.tape") `shouldReturn` False
    it "refuses to overwrite the program, and to write into a missing folder" $
      inFolder $ \folder -> do
        copyFlange folder
        forM_ [folder </> "flange.part", folder </> "no" </> "x.tape"] $ \place -> do
          (code, _, err) <- partc ["compile", folder </> "flange.part", "-o", place]
          code `shouldBe` ExitFailure 1
          err `shouldSatisfy` isInfixOf "error[E080"
        fmap Tape (ByteString.readFile (folder </> "flange.part")) `shouldNotReturn` Flange.tape
    it "refuses to overwrite a file that the program reads, in every subcommand" $
      inFolder $ \folder -> do
        forM_ ["skin.csv", "skin.part"] $ \name ->
          copyFile ("test/programs/table/good" </> name) (folder </> name)
        kept <- readFile (folder </> "skin.csv")
        forM_ ["compile", "plot", "export", "export-sheet"] $ \command -> do
          (code, out, err) <- partc [command, folder </> "skin.part", "-o", folder </> "skin.csv"]
          (code, out) `shouldBe` (ExitFailure 1, "")
          (command, err) `shouldSatisfy` (isInfixOf "error[E0807]" . snd)
          readFile (folder </> "skin.csv") `shouldReturn` kept
        (drawn, _, _) <- partc ["plot", folder </> "skin.part", "-o", folder </> "skin.svg"]
        drawn `shouldBe` ExitSuccess
    it "refuses to write several tapes to one file" $
      inFolder $ \folder -> do
        copyFlange folder
        (code, out, err) <-
          partc ["compile", folder </> "flange.part", "-t", "iso6983", "-t", "lkp-01f", "-o", "-"]
        (code, out) `shouldBe` (ExitFailure 1, "")
        err `shouldSatisfy` isInfixOf "error[E0811]"
        (_, description, _) <- partc ["machines", "iso6983", "--text"]
        writeFile (folder </> "same.machine") description
        (code', _, err') <-
          partc
            ["compile", folder </> "flange.part", "-t", "iso6983", "-t", folder </> "same.machine"]
        code' `shouldBe` ExitFailure 1
        err' `shouldSatisfy` isInfixOf "error[E0811]"
        listDirectory folder >>= (`shouldMatchList` ["flange.part", "same.machine"])
    it "asks for a folder for several tapes (catches a tape as the name of a folder)" $
      inFolder $ \folder -> do
        copyFlange folder
        (code, out, err) <-
          partc
            ( ["compile", "-t", "iso6983", "-t", "lkp-01f"]
                <> [folder </> "flange.part", "-o", folder </> "x"]
            )
        (code, out) `shouldBe` (ExitFailure 1, "")
        err `shouldSatisfy` isInfixOf "error[E0802]"
        err `shouldSatisfy` isInfixOf "there is no such folder"
        err `shouldSatisfy` isInfixOf "2 files"
        listDirectory folder `shouldReturn` ["flange.part"]
    it "finds machines by name, and descriptions by their file, in quotation marks" $
      inFolder $ \folder -> do
        (_, description, _) <- partc ["machines", "iso6983", "--text"]
        writeFile (folder </> "shop.machine") description
        forM_
          [ ("\"shop.machine\"", ""),
            ("shop.machine", "E0805"),
            ("lkp-02f", "E0805"),
            ("\"store.machine\"", "E0806")
          ]
          $ \(named, report) ->
            do
              writeFile
                (folder </> "x.part")
                ( unlines
                    [ "part x",
                      "machine " <> named,
                      "tool mill(diameter 6)",
                      "feed 60",
                      "tolerance 0.02",
                      "from (0, 0)",
                      "move (10, 0)"
                    ]
                )
              (code, _, err) <- partc ["check", folder </> "x.part"]
              (named, code) `shouldBe` (named, if null report then ExitSuccess else ExitFailure 1)
              (named, err) `shouldSatisfy` (isInfixOf report . snd)
              isInfixOf "in quotation marks: machine \"shop.machine\"" err
                `shouldBe` (named == "shop.machine")
    it "shows a mistake in a description in the description itself" $
      inFolder $ \folder -> do
        (_, description, _) <- partc ["machines", "iso6983", "--text"]
        let wrong = Text.replace "decimals 3" "decimals many" (Text.pack description)
            file = folder </> "shop.machine"
        ByteString.writeFile file (Encoding.encodeUtf8 wrong)
        writeFile (folder </> "x.part") "part x\nmachine \"shop.machine\"\nfeed 60\n"
        (code, _, err) <- partc ["check", folder </> "x.part"]
        code `shouldBe` ExitFailure 1
        err `shouldSatisfy` isInfixOf (folder </> "x.part:2:9")
        err `shouldSatisfy` isInfixOf ("::: " <> file <> ":")
        err `shouldSatisfy` isInfixOf "decimals many"
    it "warns when it does not verify the tape" $
      inFolder $ \folder -> do
        copyFlange folder
        (code, _, err) <-
          partc ["compile", folder </> "flange.part", "--no-verify", "-o", folder </> "x.tape"]
        code `shouldBe` ExitSuccess
        err `shouldSatisfy` isInfixOf "warning[W0801]"
  describe "check" $ do
    it "checks the frames for the machine of the program, or for each one that is given" $ do
      let program = "test/programs/machine/good/commands.part"
          codesFor options = do
            (code, out, err) <- partc (["check", "-q", "--format", "short", program] <> options)
            out `shouldBe` ""
            pure (code, length (lines err))
      codesFor [] `shouldReturn` (ExitSuccess, 0)
      codesFor ["-t", "lkp-01f"] `shouldReturn` (ExitSuccess, 0)
      codesFor ["-t", "n55"] `shouldReturn` (ExitFailure 1, 4)
      codesFor ["-t", "lkp-01f", "-t", "n55", "-t", "lki-u"] `shouldReturn` (ExitFailure 1, 8)
    it "refuses a machine that is not known" $ do
      (code, _, err) <- partc ["check", "examples/stub.part", "-t", "lkp-99"]
      code `shouldBe` ExitFailure 1
      err `shouldSatisfy` isInfixOf "E0805"
    it "points at the command line for a machine that it names, with the nearest name" $ do
      (_, _, err) <- partc ["check", "examples/stub.part", "-t", "n-55"]
      err `shouldSatisfy` isInfixOf "--> the command line"
      err `shouldSatisfy` isInfixOf "hint: Write -t n55."
      (_, _, err') <- partc ["machines", "n-55"]
      err' `shouldSatisfy` isInfixOf "hint: Write n55."
  describe "verify" $ do
    it "proves its own tape, and disproves one with a changed digit with status 3" $
      inFolder $ \folder -> do
        (good, table, _) <- partc ["verify", "examples/flange.part"]
        good `shouldBe` ExitSuccess
        table `shouldSatisfy` isInfixOf "proven"
        let Tape rows = Flange.tape
            (front, back) = ByteString.splitAt (25 + 15 * 49 + 2 * 25 + 3) rows
        ByteString.writeFile
          (folder </> "bad.tape")
          (front <> ByteString.cons 0x0F (ByteString.drop 1 back))
        (bad, table', err) <- partc ["verify", "examples/flange.part", folder </> "bad.tape"]
        bad `shouldBe` ExitFailure 3
        table' `shouldSatisfy` isInfixOf "WRONG"
        err `shouldSatisfy` isInfixOf "Row 814 (frame 50) has the holes 01111"
        err `shouldSatisfy` isInfixOf "All other rows are the same."
    it "names the machine that reads the tape of another one" $
      inFolder $ \folder -> do
        let tape = folder </> "n55.tape"
        (made, _, _) <- partc ["compile", "examples/flange.part", "-t", "n55", "-o", tape]
        made `shouldBe` ExitSuccess
        (code, _, err) <- partc ["verify", "examples/flange.part", tape]
        code `shouldBe` ExitFailure 1
        err `shouldSatisfy` isInfixOf "this is a tape of n55, and lkp-01f cannot read it"
        err `shouldSatisfy` isInfixOf "hint: Write -t n55."
    it "points to the changed line of G-code" $
      inFolder $ \folder -> do
        let tape = folder </> "stub.ngc"
        (made, _, _) <- partc ["compile", "examples/flange.part", "-t", "iso6983", "-o", tape]
        made `shouldBe` ExitSuccess
        own <- lines <$> readFile tape
        let (front, back) = break ("G1 " `isPrefixOf`) own
        writeFile
          (folder </> "bad.ngc")
          (unlines (front <> map (<> "9") (take 1 back) <> drop 1 back))
        (code, _, err) <-
          partc
            ( ["verify", "examples/flange.part", folder </> "bad.ngc"]
                <> words "-t iso6983 --format short"
            )
        code `shouldSatisfy` (/= ExitSuccess)
        err `shouldSatisfy` isInfixOf ("bad.ngc:" <> show (length front + 1) <> ":")
    it "reports a damaged tape with its row" $
      inFolder $ \folder -> do
        let Tape rows = Flange.tape
        ByteString.writeFile (folder </> "cut.tape") (ByteString.take 1007 rows)
        (code, out, err) <- partc ["decode", "-t", "lkp-01f", folder </> "cut.tape"]
        (code, out) `shouldBe` (ExitFailure 1, "")
        err `shouldSatisfy` isInfixOf "the tape ends within a frame"
        err `shouldSatisfy` isInfixOf "hint: The file is cut off: copy it again, or punch it anew"
    it "proves the pulses of a tape, and disproves a controller that stops with status 3" $
      inFolder $ \folder -> do
        (good, table, _) <- partc ["verify", "examples/flange.part", "--pulses"]
        good `shouldBe` ExitSuccess
        table `shouldSatisfy` isInfixOf "verdict on the pulses  proven"
        (_, text, _) <- partc ["machines", "n55", "--text"]
        let slow = Text.replace "cycle-line 4 ticks" "cycle-line 1000 ticks" (Text.pack text)
            machine = folder </> "slow.machine"
        ByteString.writeFile machine (Encoding.encodeUtf8 slow)
        (bad, table', err) <- partc ["verify", "examples/flange.part", "-t", machine, "--pulses"]
        bad `shouldBe` ExitFailure 3
        table' `shouldSatisfy` isInfixOf "verdict on the pulses  WRONG"
        err `shouldSatisfy` isInfixOf "error[E0721]: the controller stops before frame 2"
        (refused, _, err'') <- partc ["run", "examples/flange.part", "-t", machine]
        refused `shouldBe` ExitFailure 1
        err''
          `shouldSatisfy` isInfixOf
            "error[E0602]: frame 2 asks for 60 mm/min, which is too fast for the controller"
        err'' `shouldSatisfy` isInfixOf "The largest feed that it can run there is 47.87 mm/min."
        (none, _, err') <- partc ["verify", "examples/flange.part", "-t", "iso6983", "--pulses"]
        none `shouldBe` ExitFailure 1
        err' `shouldSatisfy` isInfixOf "error[E0815]"
    it "prints the table that the README shows" $ do
      (_, table, _) <- partc ["verify", "examples/flange.part"]
      page <- readFile "README.md"
      page `shouldSatisfy` isInfixOf table
  describe "fmt" $ do
    it "formats programs in place, and is silent on formatted ones" $
      inFolder $ \folder -> do
        text <- ByteString.readFile "examples/flange.part"
        ByteString.writeFile (folder </> "good.part") text
        ByteString.writeFile
          (folder </> "bad.part")
          ("\xEF\xBB\xBF" <> ByteString.intercalate "\r\n  " (ByteString.split 10 text))
        partc ["fmt", "--check", folder </> "good.part", folder </> "bad.part"]
          `shouldReturn` (ExitFailure 1, folder </> "bad.part\n", "")
        partc ["fmt", folder </> "good.part", folder </> "bad.part"]
          `shouldReturn` (ExitSuccess, "", "")
        ByteString.readFile (folder </> "bad.part") `shouldReturn` text
        partc ["fmt", "--check", folder </> "good.part", folder </> "bad.part"]
          `shouldReturn` (ExitSuccess, "", "")
    it "works from standard input to standard output" $
      readCreateProcessWithExitCode (shell "partc fmt -") "let  a=1\n"
        `shouldReturn` (ExitSuccess, "let a = 1\n", "")
    it "leaves a program with mistakes unchanged, and reports them" $
      inFolder $ \folder -> do
        writeFile (folder </> "x.part") "part  x\nlet a = (1,\n"
        (code, out, err) <- partc ["fmt", folder </> "x.part"]
        (code, out) `shouldBe` (ExitFailure 1, "")
        err `shouldSatisfy` isInfixOf "error[E0105]"
        readFile (folder </> "x.part") `shouldReturn` "part  x\nlet a = (1,\n"
  describe "input sheets" $ do
    it "compile to the same tape as the imported program, and exporting this gives the sheet" $
      inFolder $ \folder -> do
        let there = (folder </>)
        partc ["compile", "examples/spar.sheet", "-o", there "a.tape"]
          `shouldReturn` (ExitSuccess, "", "")
        partc ["import", "examples/spar.sheet", "-o", there "rib.part"]
          `shouldReturn` (ExitSuccess, "", "")
        partc ["fmt", "--check", there "rib.part"] `shouldReturn` (ExitSuccess, "", "")
        partc ["compile", there "rib.part", "-o", there "b.tape"]
          `shouldReturn` (ExitSuccess, "", "")
        a <- ByteString.readFile (there "a.tape")
        ByteString.readFile (there "b.tape") `shouldReturn` a
        sheet <- readFile "examples/spar.sheet"
        partc ["export-sheet", there "rib.part"] `shouldReturn` (ExitSuccess, sheet, "")
    it "have no parameters and no layout, and are not overwritten" $
      inFolder $ \folder -> do
        ByteString.readFile "examples/spar.sheet" >>= ByteString.writeFile (folder </> "rib.sheet")
        forM_
          [ (["check", "--set", "h=1"], "E0913"),
            (["fmt"], "E0914"),
            (["import", "-o", folder </> "rib.sheet"], "E0807"),
            (["export-sheet", "-o", folder </> "rib.sheet"], "E0807")
          ]
          $ \(arguments, wanted) ->
            do
              (code, out, err) <- partc (arguments <> [folder </> "rib.sheet"])
              (code, out) `shouldBe` (ExitFailure 1, "")
              err `shouldSatisfy` isInfixOf ("error[" <> wanted <> "]")
    it "with errors are not converted to a program" $
      inFolder $ \folder -> do
        (code, out, err) <-
          partc ["import", "test/programs/sheet/bad/piece-short.sheet", "-o", folder </> "x.part"]
        (code, out) `shouldBe` (ExitFailure 1, "")
        err `shouldSatisfy` isInfixOf "14623"
        doesFileExist (folder </> "x.part") `shouldReturn` False
  describe "formats of reports" $ do
    it "short writes one line for each report, and nothing else" $ do
      (_, _, err) <-
        partc ["check", "--format", "short", "test/programs/surface/bad/five-mistakes.part"]
      length (lines err) `shouldBe` 5
      lines err `shouldSatisfy` all ("test/programs/surface/bad/five-mistakes.part:" `isPrefixOf`)
      take 1 (lines err)
        `shouldSatisfy` all ("part:2:14: error: ‘(’ is not closed [E0105]" `isSuffixOf`)
      (_, _, err') <- partc ["explain", "--format", "short", "E9999"]
      err' `shouldBe` "partc: error: no report has the code ‘E9999’ [E0809]\n"
    it "json writes one object on each line, and nothing else" $ do
      (_, _, err) <-
        partc ["--format", "json", "check", "test/programs/surface/bad/five-mistakes.part"]
      length (lines err) `shouldBe` 5
      filter (not . isJson) (lines err) `shouldBe` []
    it "have no colours in a pipe unless --color always is given" $ do
      (_, _, plain) <- partc ["check", "test/programs/surface/bad/five-mistakes.part"]
      (_, _, coloured) <-
        partc ["check", "--color", "always", "test/programs/surface/bad/five-mistakes.part"]
      plain `shouldNotSatisfy` isInfixOf "\ESC["
      coloured `shouldSatisfy` isInfixOf "\ESC["
  describe "the streams" $ do
    it "a closed pipe is no error, and errors are still in the exit status" $ do
      (a, _, err) <-
        readCreateProcessWithExitCode
          (shell "partc frames examples/flange.part | head -1 > /dev/null")
          ""
      (a, err) `shouldBe` (ExitSuccess, "")
      (b, _, _) <-
        readCreateProcessWithExitCode
          ( shell
              "bash -c 'set -o pipefail; partc check test/programs/surface/bad/five-mistakes.part \
              \2>&1 | true'"
          )
          ""
      b `shouldBe` ExitFailure 1
    it "a full disk is reported" $ do
      (code, _, err) <-
        readCreateProcessWithExitCode (shell "partc report examples/flange.part > /dev/full") ""
      code `shouldBe` ExitFailure 1
      err `shouldSatisfy` isInfixOf "the disk is full"
    it "a full disk is reported for help and version too" $
      mapM_
        ( \command -> do
            (code, _, err) <-
              readCreateProcessWithExitCode (shell ("partc " <> command <> " > /dev/full")) ""
            code `shouldBe` ExitFailure 1
            err `shouldSatisfy` isInfixOf "the disk is full"
        )
        ["--help", "--version", "compile --help"]
    it "a closed standard output is reported" $ do
      (code, _, err) <-
        readCreateProcessWithExitCode (shell "partc report examples/flange.part >&-") ""
      code `shouldBe` ExitFailure 1
      err `shouldSatisfy` isInfixOf "cannot write to standard output: it is closed"
    it "Cyrillic letters are written in every locale" $ do
      (code, out, _) <-
        readCreateProcessWithExitCode (shell "LC_ALL=C partc report examples/flange.part") ""
      code `shouldBe` ExitSuccess
      out `shouldSatisfy` isInfixOf "Фланец"
    it "a wrong command line has the exit status 2" $ do
      (code, _, _) <- partc ["compile"]
      code `shouldBe` ExitFailure 2
    it "an option that a subcommand lacks is named, with the one that may be meant" $ do
      let lines' command =
            (\(code, _, err) -> (code, lines err)) <$> partc (words command)
      lines' "compile a.part --machine n55"
        `shouldReturn` ( ExitFailure 2,
                         [ "partc compile has no option --machine",
                           "Write -t n55.",
                           "‘partc compile --help’ lists its options."
                         ]
                       )
      take 2 . snd <$> lines' "plot --outptu=a.svg a.part"
        `shouldReturn` ["partc plot has no option --outptu", "Write -o a.svg."]
      take 2 . snd <$> lines' "check --quite a.part"
        `shouldReturn` ["partc check has no option --quite", "Write -q."]
  it "every subcommand has an example in its help" $
    forM_
      [ "compile",
        "check",
        "verify",
        "frames",
        "report",
        "decode",
        "tape",
        "plot",
        "export",
        "import",
        "export-sheet",
        "machines",
        "explain",
        "lsp",
        "fmt"
      ]
      $ \command ->
        do
          (code, out, _) <- partc [command, "--help"]
          code `shouldBe` ExitSuccess
          out `shouldSatisfy` isInfixOf ("Example: partc " <> command)

-- | True of a line that is a JSON object.
isJson :: String -> Bool
isJson line =
  isRight
    ( Aeson.eitherDecodeStrict (Encoding.encodeUtf8 (Text.pack line)) ::
        Either String Aeson.Object
    )

-- | Copies the program of the flange into a folder.
copyFlange :: FilePath -> IO ()
copyFlange folder =
  ByteString.readFile "examples/flange.part" >>= ByteString.writeFile (folder </> "flange.part")
