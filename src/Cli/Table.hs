-- | Text in columns.
module Cli.Table
  ( Align (..),
    columns,
  )
where

import Data.List (transpose)
import Data.Text (Text)
import Data.Text qualified as Text
import Text.DocLayout (realLength)

-- | To which side of its column a text stands.
data Align = ToLeft | ToRight

-- | Rows in columns, two spaces apart.
columns :: [Align] -> [[Text]] -> Text
columns aligns rows =
  Text.unlines (map (Text.stripEnd . Text.intercalate "  " . zipWith3 pad aligns widths) rows)
  where
    widths = map (maximum . map realLength) (transpose rows)
    pad align width cell = case align of
      ToLeft -> cell <> spaces (width - realLength cell)
      ToRight -> spaces (width - realLength cell) <> cell
    spaces n = Text.replicate n " "
