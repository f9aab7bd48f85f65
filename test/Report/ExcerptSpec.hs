-- | Law of the excerpts of a program: each mark is under the region that it means.
module Report.ExcerptSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.List (sort)
import Data.Text qualified as Text
import Report.Excerpt (Excerpt (..))
import Report.Excerpt qualified as Excerpt
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  it
    "marks are under the regions that they mean (catches a mark under the window of another mark)"
    $ property $
      forAll ((,) <$> choose (60, 140) <*> text) $ \(room, content) ->
        forAll (sort <$> listOf1 (spot content)) $ \spots ->
          let source = Region.fromText "a.part" (Text.pack content)
              found = Excerpt.excerpts room source [Region from to | (from, to) <- spots]
              -- For each mark, the line above it.
              printed = drop 1 (scanl (\line e -> if isSame e then line else shown e) "" found)
              under =
                [ Text.unpack (Text.take (width e) (Text.drop (indent e) line))
                  | (e, line) <- zip found printed
                ]
           in counterexample
                (show (room, spots, printed))
                ( conjoin (map (\line -> property (Text.length line <= room)) printed)
                    .&&. conjoin
                      [ marked === takeWhile (/= '\n') (take (to - from) (drop from content))
                        | (marked, (from, to)) <- zip under spots
                      ]
                )
  where
    text = unlines <$> listOf1 (choose (1, 300) >>= \n -> vectorOf n (elements ['a' .. 'z']))
    -- A region on one line that is not longer than the window.
    spot content = do
      (begin, line) <-
        elements (zip (scanl (\at l -> at + length l + 1) 0 (lines content)) (lines content))
      from <- choose (0, length line - 1)
      size <- choose (1, min 50 (length line - from))
      pure (begin + from, begin + from + size)
