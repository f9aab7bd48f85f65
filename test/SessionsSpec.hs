-- | The documents show the output of the command.
--
-- A block @```console@ contains commands, each after @$@, and their output: reports first, then
-- results. A command is one of @partc@, or of the system if it shows or edits a text file. The
-- commands of a block run in a folder with one file: the last program above them that has a
-- @part@ statement (@```part@ or @```part wrong@), in a file named for the part, or the last input
-- sheet (@```sheet NAME@). Beside it lie the tapes of @examples@ that the commands name. With
-- PARTC_RECORD set, the output is written into the document.
module SessionsSpec (spec) where

import Blocks qualified
import Command (inFolder)
import Control.Monad (forM_)
import Data.ByteString qualified as ByteString
import Data.List (mapAccumL)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Files (readText)
import System.Directory (copyFile, listDirectory)
import System.Environment (lookupEnv)
import System.FilePath (takeExtension, (</>))
import System.Process (CreateProcess (cwd), proc, readCreateProcessWithExitCode, shell)
import Test.Hspec

spec :: Spec
spec = describe "sessions show the output of partc" $ do
  recording <- runIO (lookupEnv "PARTC_RECORD")
  documents <- runIO Blocks.documents
  forM_ documents $ \file -> do
    text <- runIO (readText file)
    let sections = withPrograms (Text.splitOn "```" text)
        sessions = [() | Session _ _ <- sections]
    if null sessions
      then pure ()
      else it file $ do
        now <- Text.intercalate "```" <$> traverse rerun sections
        case recording of
          Just _ -> ByteString.writeFile file (Encoding.encodeUtf8 now)
          Nothing -> Text.lines now `shouldBe` Text.lines text

-- | A section of a document between its fences: text and blocks alternate.
data Section
  = Plain Text
  | -- | a block of commands, with the name and the text of the file that they use
    Session (FilePath, Text) Text

-- | The sections of a document, in which texts and blocks alternate. Each block of commands gets
-- the program or input sheet above it.
withPrograms :: [Text] -> [Section]
withPrograms = snd . mapAccumL one (".part", "") . zip [0 :: Int ..]
  where
    one program (n, section)
      | odd n, Just body <- Text.stripPrefix "console\n" section = (program, Session program body)
      | odd n,
        Just body <- programOf section,
        Text.isPrefixOf "part " body =
        ((nameOf body, body), Plain section)
      | odd n,
        Just named <- Text.stripPrefix "sheet " section,
        (name, body) <- Text.breakOn "\n" named =
        ((Text.unpack name <> ".sheet", Text.drop 1 body), Plain section)
      | otherwise = (program, Plain section)
    nameOf program =
      Text.unpack (Text.takeWhile (`notElem` [' ', '\n']) (Text.drop 5 program)) <> ".part"
    programOf section = case Text.stripPrefix "part wrong\n" section of
      Nothing -> Text.stripPrefix "part\n" section
      found -> found

-- | A section as text, with the present output of its commands.
rerun :: Section -> IO Text
rerun section = case section of
  Plain text -> pure text
  Session (name, program) body -> inFolder $ \folder -> do
    ByteString.writeFile (folder </> name) (Encoding.encodeUtf8 program)
    files <- listDirectory "examples"
    let isNamed file = takeExtension file == ".tape" && Text.isInfixOf (Text.pack file) body
    forM_ (filter isNamed files) $ \file -> copyFile ("examples" </> file) (folder </> file)
    outputs <-
      traverse (run folder) [c | line <- Text.lines body, Just c <- [Text.stripPrefix "$ " line]]
    pure ("console\n" <> Text.concat outputs)
  where
    run folder command = case Text.words command of
      "partc" : arguments -> shown folder command (proc "partc" (map Text.unpack arguments))
      tool : _
        | tool `elem` ["head", "sed"] -> shown folder command (shell (Text.unpack command))
      _ -> fail ("no command of ours: " <> Text.unpack command)
    shown folder command process = do
      (_, out, err) <- readCreateProcessWithExitCode process {cwd = Just folder} ""
      pure ("$ " <> command <> "\n" <> Text.pack err <> Text.pack out)
