-- | Files of the repository, for tests.
module Files
  ( readText,
    filesBelow,
    expected,
  )
where

import Control.Monad (filterM)
import Data.ByteString qualified as ByteString
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
import System.Directory (doesDirectoryExist, doesFileExist, listDirectory)
import System.Environment (lookupEnv)
import System.FilePath ((</>))
import Test.Hspec (Expectation, expectationFailure, shouldBe)

-- | The text of a file in UTF-8.
readText :: FilePath -> IO Text
readText file = Encoding.decodeUtf8 <$> ByteString.readFile file

-- | All files below a folder.
filesBelow :: FilePath -> IO [FilePath]
filesBelow folder = do
  entries <- map (folder </>) <$> listDirectory folder
  folders <- filterM doesDirectoryExist entries
  (filter (`notElem` folders) entries <>) . concat <$> traverse filesBelow folders

-- | Compares a text with a file. With PARTC_RECORD set, writes the file instead.
expected :: FilePath -> Text -> Expectation
expected file actual = do
  recording <- lookupEnv "PARTC_RECORD"
  exists <- doesFileExist file
  case recording of
    Just _ -> ByteString.writeFile file (Encoding.encodeUtf8 actual)
    Nothing
      | exists -> readText file >>= (actual `shouldBe`)
      | otherwise -> expectationFailure (file <> " is missing; PARTC_RECORD=1 records it")
