-- | The codes of the reports that there are, as the sources say.
module Codes
  ( inSources,
    isCode,
  )
where

import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText, walk)
import System.FilePath (takeExtension)

-- | Every code that stands between quotation marks in a module of the program.
inSources :: IO (Set Text)
inSources = do
  sources <- filter ((== ".hs") . takeExtension) <$> walk "src"
  texts <- traverse readText sources
  pure (Set.fromList (filter isCode (concatMap (Text.splitOn "\"") texts)))

-- | A letter and four digits.
isCode :: Text -> Bool
isCode t =
  Text.length t == 5
    && Text.take 1 t `elem` ["E", "W"]
    && Text.all (`elem` ['0' .. '9']) (Text.drop 1 t)
