-- | The formats of drawings, by the names of their files.
module Drawing.FileFormat
  ( FileFormat (..),
    formatOf,
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
  | hasEnd ".dxf" = Just Dxf
  | hasEnd ".svg" = Just Svg
  | otherwise = Nothing
  where
    hasEnd extension = extension `Text.isSuffixOf` Text.toLower name
