-- | Tables of a Markdown page, and the markers between which they are written.
module Table
  ( Row,
    table,
    number,
    exponent,
    replace,
  )
where

import Base.Decimal qualified as Decimal
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Prelude hiding (exponent)

-- | The cells of a row.
type Row = [Text]

-- | A table of a heading and rows. The first column contains words, the others numbers.
table :: Row -> [Row] -> Text
table heading rows = Text.unlines (map line (heading : rule : rows))
  where
    rule = zipWith (\i _ -> if i == (0 :: Int) then "---" else "--:") [0 ..] heading
    line cells = "| " <> Text.intercalate " | " cells <> " |"

-- | A number with three significant digits.
number :: Double -> Text
number x
  | abs x >= 100 = Decimal.whole (round x)
  | abs x >= 10 = Decimal.fixed 1 x
  | otherwise = Decimal.fixed 2 x

-- | The exponent of growth between two sizes with their times.
exponent :: (Int, Double) -> (Int, Double) -> Double
exponent (n, t) (n', t') = logBase (fromIntegral n' / fromIntegral n) (t' / t)

-- | Replaces the text between @<!-- NAME -->@ and @<!-- end of NAME -->@ in a page. The result is
-- False if the page lacks these markers.
replace :: FilePath -> Text -> Text -> IO Bool
replace file name text = do
  page <- Text.readFile file
  let (begin, end) = ("<!-- " <> name <> " -->\n", "<!-- end of " <> name <> " -->\n")
      (before, from) = Text.breakOn begin page
      (_, after) = Text.breakOn end from
      found = not (Text.null after)
  if found then Text.writeFile file (before <> begin <> "\n" <> text <> "\n" <> after) else pure ()
  pure found
