-- | Neovim with the configuration of editors/nvim shows the reports that the command line prints.
module Lsp.NeovimSpec (spec) where

import Control.Monad (when)
import Data.Aeson (FromJSON (..), withObject, (.:))
import Data.Aeson qualified as Aeson
import Data.ByteString qualified as ByteString
import Data.List (sort)
import Data.Maybe (isNothing)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Files (readText)
import System.Directory (copyFile, createDirectory, findExecutable, makeAbsolute)
import System.Environment (getEnvironment)
import System.Exit (ExitCode (..))
import System.FilePath ((</>))
import System.IO.Temp (withSystemTempDirectory)
import System.Process (CreateProcess (..), proc, readCreateProcessWithExitCode)
import Test.Hspec

spec :: Spec
spec = do
  it "shows the reports, jumps to a definition, shows a hover, and removes reports that are fixed" $
    inFolder $ \folder -> do
      file <- written folder
      expected <- reported file
      length expected `shouldBe` 2
      shown <- neovim 20000 "{'partc', 'lsp'}" folder file
      filetype shown `shouldBe` "part"
      sort (diagnostics shown) `shouldBe` sort expected
      (jumped shown, cursor shown) `shouldBe` (True, [7, 4])
      hover shown `shouldSatisfy` Text.isInfixOf "длина = 41 mm"
      fixed shown `shouldBe` True
  it "shows nothing when the server is silent or missing" $
    inFolder $ \folder -> do
      file <- written folder
      silent <- neovim 500 "{'sleep', '60'}" folder file
      missing <- neovim 500 "{'/nowhere/partc', 'lsp'}" folder file
      [(diagnostics a, jumped a, hover a, fixed a) | a <- [silent, missing]]
        `shouldBe` replicate 2 ([], False, "", False)

-- | A diagnostic of Neovim: line and byte of both ends, from 0; the code; true for an error.
data Shown = Shown {from :: (Int, Int), to :: (Int, Int), code :: Text, severe :: Bool}
  deriving stock (Eq, Ord, Show)

instance FromJSON Shown where
  parseJSON = withObject "a diagnostic" $ \o ->
    Shown <$> o .: "from" <*> o .: "to" <*> o .: "code" <*> ((== (1 :: Int)) <$> o .: "severity")

-- | Display of Neovim, as the script test/Lsp/neovim.lua writes it: the file type, the diagnostics,
-- true if the jump was made, the cursor after it, the text of the hover, and true if the reports
-- are gone after the program is fixed.
data Answer = Answer
  { filetype :: Text,
    diagnostics :: [Shown],
    jumped :: Bool,
    cursor :: [Int],
    hover :: Text,
    fixed :: Bool
  }

instance FromJSON Answer where
  parseJSON = withObject "an answer" $ \o ->
    Answer
      <$> o
        .: "filetype" <*> o
        .: "diagnostics" <*> o
        .: "jumped" <*> o
        .: "cursor" <*> o
        .: "hover" <*> o
        .: "fixed"

-- | Copies a program with two mistakes after characters of two and of four bytes into the folder.
written :: FilePath -> IO FilePath
written folder = file <$ copyFile "test/programs/names/bad/beside-wide-letters.part" file
  where
    file = folder </> "деталь.part"

-- | The reports of the command line, with positions as Neovim counts them.
reported :: FilePath -> IO [Shown]
reported file = do
  text <- readText file
  (_, out, err) <-
    readCreateProcessWithExitCode (proc "partc" ["check", "--format", "json", file]) ""
  out `shouldBe` ""
  traverse
    (either fail (pure . inBytes text) . Aeson.eitherDecodeStrict . Encoding.encodeUtf8)
    (Text.lines (Text.pack err))

-- | A report of the command line: lines and columns count characters from 1.
data Report = Report {start :: TextPosition, end :: TextPosition, code' :: Text, severity :: Text}

data TextPosition = TextPosition {line :: Int, column :: Int}

instance FromJSON Report where
  parseJSON =
    withObject
      "a report"
      (\o -> Report <$> o .: "start" <*> o .: "end" <*> o .: "code" <*> o .: "severity")

instance FromJSON TextPosition where
  parseJSON = withObject "a place" (\o -> TextPosition <$> o .: "line" <*> o .: "column")

-- | Converts the positions of a report of a program from characters to bytes.
inBytes :: Text -> Report -> Shown
inBytes text r =
  Shown {from = bytes (start r), to = bytes (end r), code = code' r, severe = severity r == "error"}
  where
    bytes place =
      ( line place - 1,
        ByteString.length
          ( Encoding.encodeUtf8
              (Text.take (column place - 1) (Text.lines text !! (line place - 1)))
          )
      )

-- | Opens a file in Neovim with this server, and reads what the editor shows. The script waits for
-- each answer at most @patience@ milliseconds.
neovim :: Int -> String -> FilePath -> FilePath -> IO Answer
neovim patience server folder file = do
  there <- findExecutable "nvim"
  when (isNothing there) (fail "Neovim is not installed (Debian: neovim)")
  setup <- makeAbsolute "editors/nvim"
  script <- makeAbsolute "test/Lsp/neovim.lua"
  environment <- getEnvironment
  let answer = folder </> "answer.json"
      home =
        [ (name, folder)
          | name <- ["HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME"]
        ]
      own =
        home
          <> [ ("PARTC_TEST_ANSWER", answer),
               ("PARTC_TEST_PATIENCE", show patience),
               ("LC_ALL", "C.UTF-8")
             ]
      arguments =
        ["-k", "5", "120", "nvim", "--headless", "-u", "NONE", "-i", "NONE", "-n"]
          <> [ "--cmd",
               "set runtimepath^=" <> setup,
               "--cmd",
               "lua vim.g.partc_command = " <> server
             ]
          <> ["-c", "filetype plugin on", "-c", "edit " <> file, "-c", "luafile " <> script]
  ByteString.writeFile answer ""
  (status, out, err) <-
    readCreateProcessWithExitCode
      (proc "timeout" arguments)
        { env =
            Just (own <> [e | e@(name, _) <- environment, name `notElem` map fst own])
        }
      ""
  decoded <- Aeson.eitherDecodeStrict <$> ByteString.readFile answer
  case (status, decoded) of
    (ExitSuccess, Right shown) -> pure shown
    (_, Left why) ->
      fail ("Neovim gave no answer (" <> show status <> ", " <> why <> "): " <> out <> err)
    (ExitFailure n, Right _) -> fail ("Neovim ended with " <> show n <> ": " <> out <> err)

inFolder :: (FilePath -> IO a) -> IO a
inFolder act =
  withSystemTempDirectory "partc" $ \folder -> createDirectory (folder </> "nvim") *> act folder
