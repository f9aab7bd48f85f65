-- | Excerpts of a program with marks under them.
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
    "marks stand under what they mean (catches the window of one mark under which another one is \
    \put)"
    $ property $
      forAll text $ \content ->
        forAll (sort <$> listOf1 (spot content)) $ \spots ->
          let source = Region.fromText "a.part" (Text.pack content)
              found = Excerpt.excerpts source [Region from to | (from, to) <- spots]
              -- The line that is printed last before the mark.
              printed = drop 1 (scanl (\line e -> if isSame e then line else shown e) "" found)
              under =
                [ Text.unpack (Text.take (width e) (Text.drop (indent e) line))
                  | (e, line) <- zip found printed
                ]
           in counterexample
                (show (spots, printed))
                ( conjoin
                    [ marked === takeWhile (/= '\n') (take (to - from) (drop from content))
                      | (marked, (from, to)) <- zip under spots
                    ]
                )
  where
    text = unlines <$> listOf1 (choose (1, 300) >>= \n -> vectorOf n (elements ['a' .. 'z']))
    -- On one line, and no longer than is shown of it.
    spot content = do
      (begin, line) <-
        elements (zip (scanl (\at l -> at + length l + 1) 0 (lines content)) (lines content))
      from <- choose (0, length line - 1)
      size <- choose (1, min 50 (length line - from))
      pure (begin + from, begin + from + size)
