-- | Drawings that other programs convert.
module Cli.DrawingFileSpec (spec) where

import Command (inFolder)
import Data.ByteString qualified as ByteString
import Data.List (isInfixOf)
import System.Directory
  ( createDirectory,
    doesFileExist,
    findExecutable,
    listDirectory,
  )
import System.Exit (ExitCode (..))
import System.FilePath ((</>))
import System.Process (CreateProcess (env), proc, readCreateProcessWithExitCode, readProcess)
import Test.Hspec

spec :: Spec
spec = describe "drawings as PNG and PDF" $ do
  it "are refused if no renderer is installed, with the package to install" $
    inFolder $ \folder -> do
      (code, _, complaint) <- plotted folder [] "x.png"
      code `shouldBe` ExitFailure 1
      complaint `shouldSatisfy` ("error[E0820]" `isInfixOf`)
      complaint `shouldSatisfy` ("librsvg2-bin" `isInfixOf`)
      doesFileExist (folder </> "x.png") `shouldReturn` False
  it "are what the renderer writes (catches SVG in a file that is called PNG)" $
    inFolder $ \folder -> do
      (code, _, _) <- plotted folder [("rsvg-convert", copying "rsvg $7")] "x.PDF"
      code `shouldBe` ExitSuccess
      ByteString.readFile (folder </> "x.PDF") `shouldReturn` "rsvg pdf\n"
  it "are converted by the next renderer if the first one fails" $
    inFolder $ \folder -> do
      (code, _, _) <-
        plotted folder [("rsvg-convert", "exit 1"), ("inkscape", copying "inkscape $1")] "x.png"
      code `shouldBe` ExitSuccess
      ByteString.readFile (folder </> "x.png")
        `shouldReturn` "inkscape --export-type=png\n"
  it "are refused with the words of the renderer if it fails (catches an exception)" $
    inFolder $ \folder -> do
      (code, _, complaint) <-
        plotted folder [("rsvg-convert", "echo 'no memory' >&2; exit 1")] "x.png"
      code `shouldBe` ExitFailure 1
      complaint `shouldSatisfy` ("rsvg-convert: no memory" `isInfixOf`)
      doesFileExist (folder </> "x.png") `shouldReturn` False
  it "are refused in another form (catches SVG in a file that is called JPEG)" $
    inFolder $ \folder -> do
      (code, _, complaint) <- plotted folder [] "x.jpg"
      code `shouldNotBe` ExitSuccess
      complaint `shouldSatisfy` ("error[E0823]" `isInfixOf`)
      doesFileExist (folder </> "x.jpg") `shouldReturn` False
  it "leave nothing in the temporary folder" $
    inFolder $ \folder -> do
      _ <- plotted folder [("rsvg-convert", copying "")] "x.png"
      listDirectory (folder </> "tmp") `shouldReturn` []
  it "have the size of the page (pending without rsvg-convert)" $
    inFolder $ \folder -> do
      found <- findExecutable "rsvg-convert"
      case found of
        Nothing -> pendingWith "rsvg-convert is not installed"
        Just real -> do
          (code, _, _) <- plotted folder [("rsvg-convert", "exec " <> real <> " \"$@\"")] "x.png"
          code `shouldBe` ExitSuccess
          bytes <- ByteString.readFile (folder </> "x.png")
          -- A4 in landscape: 2339 × 1654 pixels of 1/200 inch.
          ByteString.take 8 (ByteString.drop 16 bytes)
            `shouldBe` ByteString.pack [0, 0, 9, 35, 0, 0, 6, 118]

-- | Plots the flange to a file in a folder, with no programs on the path but these scripts. Yields
-- the exit status, standard output and standard error.
plotted :: FilePath -> [(FilePath, String)] -> FilePath -> IO (ExitCode, String, String)
plotted folder scripts name = do
  createDirectory (folder </> "bin")
  createDirectory (folder </> "tmp")
  mapM_ install scripts
  Just program <- findExecutable "partc"
  readCreateProcessWithExitCode
    (proc program ["plot", "-q", "examples/flange.part", "-o", folder </> name])
      { env =
          Just
            [ ("PATH", folder </> "bin"),
              ("TMPDIR", folder </> "tmp"),
              ("LANG", "C.UTF-8"),
              ("LC_ALL", "C.UTF-8")
            ]
      }
    ""
  where
    -- A process of its own writes the script. A script that this process has open for writing would
    -- be open in the children of tests that run at the same time, and then it cannot be executed.
    install (script, body) =
      readProcess
        "/bin/sh"
        ["-c", "cat > \"$0\" && chmod 500 \"$0\"", folder </> "bin" </> script]
        ("#!/bin/sh\n" <> body <> "\n")

-- | Script that writes a text to the outputs of the renderer, which are beside the drawing.
copying :: String -> String
copying text =
  "for f; do case $f in *drawing.svg) for end in png pdf; do echo \""
    <> text
    <> "\" > \"${f%svg}$end\"; done;; esac; done"
