-- | What the documents show of the command is what it prints.
--
-- A block @```console@ holds commands, each behind @$@, and what they print: reports first, then
-- results. They run beside the last whole program above them, @```part@ or @```part wrong@, in a
-- file named for the part, or beside the last input sheet, @```sheet NAME@. With PARTC_RECORD set,
-- what they print is written into the document anew.
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
import System.Environment (lookupEnv)
import System.FilePath ((</>))
import System.Process (CreateProcess (cwd), proc, readCreateProcessWithExitCode)
import Test.Hspec

spec :: Spec
spec = describe "sessions show what partc prints" $ do
  recording <- runIO (lookupEnv "PARTC_RECORD")
  documents <- runIO Blocks.documents
  forM_ documents $ \file -> do
    text <- runIO (readText file)
    let pieces = located (Text.splitOn "```" text)
        sessions = [() | Session _ _ <- pieces]
    if null sessions
      then pure ()
      else it file $ do
        now <- Text.intercalate "```" <$> traverse again pieces
        case recording of
          Just _ -> ByteString.writeFile file (Encoding.encodeUtf8 now)
          Nothing -> Text.lines now `shouldBe` Text.lines text

-- | A document between its fences: text and blocks by turns.
data Piece
  = Plain Text
  | -- | with the file above, by its name
    Session (FilePath, Text) Text

located :: [Text] -> [Piece]
located = snd . mapAccumL one (".part", "") . zip [0 :: Int ..]
  where
    one program (n, piece)
      | odd n, Just body <- Text.stripPrefix "console\n" piece = (program, Session program body)
      | odd n,
        Just body <- programOf piece,
        Text.isPrefixOf "part " body =
        ((nameOf body, body), Plain piece)
      | odd n,
        Just named <- Text.stripPrefix "sheet " piece,
        (name, body) <- Text.breakOn "\n" named =
        ((Text.unpack name <> ".sheet", Text.drop 1 body), Plain piece)
      | otherwise = (program, Plain piece)
    nameOf program =
      Text.unpack (Text.takeWhile (`notElem` [' ', '\n']) (Text.drop 5 program)) <> ".part"
    programOf piece = case Text.stripPrefix "part wrong\n" piece of
      Nothing -> Text.stripPrefix "part\n" piece
      found -> found

-- | A piece with what the commands print now.
again :: Piece -> IO Text
again piece = case piece of
  Plain text -> pure text
  Session (name, program) body -> inFolder $ \folder -> do
    ByteString.writeFile (folder </> name) (Encoding.encodeUtf8 program)
    shown <-
      traverse (run folder) [c | line <- Text.lines body, Just c <- [Text.stripPrefix "$ " line]]
    pure ("console\n" <> Text.concat shown)
  where
    run folder command = case Text.words command of
      "partc" : arguments -> do
        (_, out, err) <-
          readCreateProcessWithExitCode
            (proc "partc" (map Text.unpack arguments)) {cwd = Just folder}
            ""
        pure ("$ " <> command <> "\n" <> Text.pack err <> Text.pack out)
      _ -> fail ("no command of ours: " <> Text.unpack command)
