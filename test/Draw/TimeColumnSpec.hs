-- | Laws of the columns of a drawing over time.
module Draw.TimeColumnSpec (spec) where

import Data.List (foldl', nub)
import Draw.TimeColumn (Band (..))
import Draw.TimeColumn qualified as TimeColumn
import Pulse.RunSample (RunSample (..), SampleKind (..))
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "columns over time" $ do
  it "keep the least and the highest value (catches a column that forgets one of its halves)" $
    forAll samples $ \list ->
      conjoin
        [ (minimum (map least bs), maximum (map highest bs))
            === (minimum (map value ofKind), maximum (map value ofKind))
          | k <- kinds,
            let ofKind = filter ((== k) . kind) list,
            not (null ofKind),
            let bs = map snd (TimeColumn.bands k (columnsOf list))
        ]
  it "keep the sum of the values over time (catches a mean of one of the halves)" $
    forAll samples $ \list ->
      conjoin
        [ counterexample (show (k, kept, given)) (abs (kept - given) <= 1e-9 * (1 + abs given))
          | k <- kinds,
            let given = sum [value s * fromIntegral (to s - from s) | s <- list, kind s == k],
            let kept = sum (map (weighted . snd) (TimeColumn.bands k (columnsOf list)))
        ]
  it "are never more than their largest count (catches a column too many)" $
    forAll samples $ \list ->
      let count = length (nub [t | k <- kinds, (t, _) <- TimeColumn.bands k (columnsOf list)])
       in cover 50 (count > 4) "more than half of the columns" (count <= 8)
  where
    columnsOf = foldl' (flip TimeColumn.add) (TimeColumn.empty 8)
    kinds = [FeedMeasured, AxisFrequency 0]

-- | Samples without gaps, of two kinds.
samples :: Gen [RunSample]
samples = do
  start <- choose (0, 1000)
  lengths <- listOf1 (choose (1, 60))
  concat <$> traverse piece (zip (scanl (+) start lengths) lengths)
  where
    piece (t, l) = do
      a <- choose (-100, 100)
      b <- choose (-100, 100)
      pure [RunSample FeedMeasured t (t + l) a, RunSample (AxisFrequency 0) t (t + l) b]
