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

-- | The alignment of a column.
data Align = ToLeft | ToRight

-- | Lays out rows of cells in columns with two spaces between them. A column is as wide as its
-- widest cell. Widths are those on a terminal, which shows some characters in double width and
-- some in none.
columns :: [Align] -> [[Text]] -> Text
columns aligns rows =
  Text.unlines (map (Text.stripEnd . Text.intercalate "  " . zipWith3 pad aligns widths) rows)
  where
    widths = map (maximum . map realLength) (transpose rows)
    pad align width cell = case align of
      ToLeft -> cell <> spaces (width - realLength cell)
      ToRight -> spaces (width - realLength cell) <> cell
    spaces n = Text.replicate n " "
