-- | Suggestions for misspelt names.
module Base.NameSpec (spec) where

import Base.Name qualified as Name
import Data.List (sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it
    "suggests names within one edit for every three letters, nearest first (catches names that are \
    \discarded too early, or an exchange of neighbours)"
    $ property . forAll word $ \wanted -> forAll (listOf (oneof [word, edited wanted])) $ \known ->
      let found = Name.nearest wanted known
          allowed = Text.length wanted `div` 3
       in cover 50 (not (null found)) "some" $
            sort found === sort [k | k <- known, edits wanted k <= allowed]
              .&&. map (edits wanted) found === sort (map (edits wanted) found)
  it "counts an exchange of neighbours as one edit" $
    Name.nearest "depht" ["depth", "deep"] `shouldBe` ["depth"]
  it "ignores capital letters" $
    Name.nearest "Bolts" ["bolt", "BOLTS", "nuts"] `shouldBe` ["BOLTS", "bolt"]
  it "finds names that look the same in another alphabet, and no others" $
    Name.lookAlike "сора" ["copa", "сора", "cope", "cop"] `shouldBe` ["copa"]

word :: Gen Text
word = do
  n <- choose (1, 8)
  Text.pack <$> vectorOf n (elements "abcж")

-- | A word with up to three edits: letters removed, inserted or replaced.
edited :: Text -> Gen Text
edited w = choose (0, 3 :: Int) >>= go w
  where
    go t n
      | n == 0 = pure t
      | otherwise = do
        k <- choose (0, Text.length t)
        c <- elements ["", "a", "b", "ж"]
        gone <- choose (0, 1)
        go (Text.take k t <> c <> Text.drop (k + gone) t) (n - 1)

-- | The edit distance by its definition: letters are inserted, deleted or replaced, and neighbours
-- exchanged.
edits :: Text -> Text -> Int
edits a b = case (Text.uncons a, Text.uncons b) of
  (Nothing, _) -> Text.length b
  (_, Nothing) -> Text.length a
  (Just (c, a'), Just (d, b'))
    | c == d -> edits a' b'
    | otherwise -> 1 + minimum ([edits a' b, edits a b', edits a' b'] <> exchanged c a' d b')
  where
    exchanged c a' d b' = case (Text.uncons a', Text.uncons b') of
      (Just (c', a''), Just (d', b'')) | c == d', c' == d -> [edits a'' b'']
      _ -> []
