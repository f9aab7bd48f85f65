-- | The codes of all reports, from the sources.
module Codes
  ( inSources,
    isCode,
  )
where

import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Files (filesBelow, readText)
import System.FilePath (takeExtension)

-- | All report codes that are string literals in a module of src/.
inSources :: IO (Set Text)
inSources = do
  sources <- filter ((== ".hs") . takeExtension) <$> filesBelow "src"
  texts <- traverse readText sources
  pure (Set.fromList (filter isCode (concatMap (Text.splitOn "\"") texts)))

-- | Is this a code: E or W and four digits?
isCode :: Text -> Bool
isCode t =
  Text.length t == 5
    && Text.take 1 t `elem` ["E", "W"]
    && Text.all (`elem` ['0' .. '9']) (Text.drop 1 t)
