-- | Tables of a Markdown page, and the places of the page where they stand.
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

type Row = [Text]

-- | A heading and rows; the first column is of words, the others of numbers.
table :: Row -> [Row] -> Text
table heading rows = Text.unlines (map line (heading : rule : rows))
  where
    rule = zipWith (\i _ -> if i == (0 :: Int) then "---" else "--:") [0 ..] heading
    line cells = "| " <> Text.intercalate " | " cells <> " |"

-- | With three digits that matter.
number :: Double -> Text
number x
  | abs x >= 100 = Decimal.whole (round x)
  | abs x >= 10 = Decimal.fixed 1 x
  | otherwise = Decimal.fixed 2 x

-- | How time grows with size: the exponent between two of both.
exponent :: (Int, Double) -> (Int, Double) -> Double
exponent (n, t) (n', t') = logBase (fromIntegral n' / fromIntegral n) (t' / t)

-- | Put a text where a page says @<!-- NAME -->@ … @<!-- end of NAME -->@; whether there is such a
-- place.
replace :: FilePath -> Text -> Text -> IO Bool
replace file name text = do
  page <- Text.readFile file
  let (begin, end) = ("<!-- " <> name <> " -->\n", "<!-- end of " <> name <> " -->\n")
      (before, from) = Text.breakOn begin page
      (_, after) = Text.breakOn end from
      found = not (Text.null after)
  if found then Text.writeFile file (before <> begin <> "\n" <> text <> "\n" <> after) else pure ()
  pure found
