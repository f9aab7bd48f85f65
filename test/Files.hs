-- | Files for tests that look at the repository itself.
module Files
  ( readText,
    walk,
  )
where

import Control.Monad (filterM)
import Data.ByteString qualified as ByteString
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
import System.Directory (doesDirectoryExist, listDirectory)
import System.FilePath ((</>))

-- | A file in UTF-8.
readText :: FilePath -> IO Text
readText file = Encoding.decodeUtf8 <$> ByteString.readFile file

-- | All files below a folder.
walk :: FilePath -> IO [FilePath]
walk folder = do
  entries <- map (folder </>) <$> listDirectory folder
  folders <- filterM doesDirectoryExist entries
  (filter (`notElem` folders) entries <>) . concat <$> traverse walk folders
