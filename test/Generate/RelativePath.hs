-- | Random SVG files with one closed path in relative coordinates, with few decimals, as drawing
-- programs write them. The sums of these numbers miss the start of the path by rounding.
module Generate.RelativePath
  ( RelativePath (..),
    relativePath,
  )
where

import Data.ByteString (ByteString)
import Data.List (intercalate)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Numeric (showFFloat)
import Test.QuickCheck

-- | A path by the commands of its steps, and its file.
data RelativePath = RelativePath {steps :: [String], svgOfPath :: ByteString}

instance Show RelativePath where
  show = Text.unpack . Encoding.decodeUtf8 . svgOfPath

-- | A closed path of lines and flat arcs around a centre. It does not cross itself.
relativePath :: Gen RelativePath
relativePath = do
  places <- choose (1, 3) :: Gen Int
  count <- choose (3, 9)
  corners <- traverse (corner count) [1 .. count]
  let moves = zipWith (zipWith (-)) (drop 1 corners <> take 1 corners) corners
  origin <- vectorOf 2 (choose (-900, 900))
  (attributes, transform) <- elements pages
  letters <- vectorOf (length moves) (frequency [(3, pure ""), (1, elements (arcs places))])
  ending <- elements ["z", " Z", ""]
  let shown p = intercalate "," (map (written places) p)
      steps = [step letter (shown m) | (letter, m) <- zip letters moves]
      text = "m " <> shown origin <> " " <> unwords steps <> ending
  pure
    RelativePath
      { steps,
        svgOfPath =
          Encoding.encodeUtf8 . Text.pack $
            "<svg " <> attributes <> "><g transform='" <> transform <> "'><path d='" <> text
              <> "'/></g></svg>"
      }
  where
    corner :: Int -> Int -> Gen [Int]
    corner count k = do
      r <- choose (400, 600)
      let angle = 2 * pi * fromIntegral k / fromIntegral count
      pure [round (r * cos angle), round (r * sin angle :: Double)]
    step letter p = if null letter then "l " <> p else letter <> p
    arcs places =
      [ "a " <> radius <> "," <> radius <> " 0 0 " <> side
        | let radius = written places 4000,
          side <- ["0 ", "1 "]
      ]
    written :: Int -> Int -> String
    written places n =
      showFFloat (Just places) (fromIntegral n / 10 ^^ places :: Double) ""
    pages =
      [ ("width='130mm' height='110mm' viewBox='0 0 130 110'", "scale(1)"),
        ("width='130mm' height='110mm' viewBox='0 0 130 110'", "translate(-40.2,-95.7)"),
        ("width='13cm' height='11cm' viewBox='0 0 491.34 415.75'", "rotate(7.3)")
      ]
