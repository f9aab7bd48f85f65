-- | The formats of drawings and fonts, by the names of their files.
module Drawing.FileFormat
  ( FileFormat (..),
    formatOf,
    isFont,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text

-- | A format of a drawing.
data FileFormat = Dxf | Svg
  deriving stock (Eq, Show)

-- | The format of a file with a name; Nothing if it is no drawing.
formatOf :: Text -> Maybe FileFormat
formatOf name
  | hasEnd name ".dxf" = Just Dxf
  | hasEnd name ".svg" = Just Svg
  | otherwise = Nothing

-- | True for the name of a font file.
isFont :: Text -> Bool
isFont name = any (hasEnd name) [".ttf", ".otf", ".ttc"]

hasEnd :: Text -> Text -> Bool
hasEnd name extension = extension `Text.isSuffixOf` Text.toLower name
