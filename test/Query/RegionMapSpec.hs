-- | Regions of an old text in a new one.
module Query.RegionMapSpec (spec) where

import Base.Region (Region (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Query.RegionMap qualified as RegionMap
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck

spec :: Spec
spec = do
  prop "a region that is carried forward contains the same text"
    . forAll ((,) <$> text' <*> text')
    $ \(old, new) ->
      forAll (stretch old) $ \region -> case RegionMap.forward (RegionMap.between old new) region of
        Nothing -> property True
        Just there -> slice new there === slice old region
  prop "back undoes forward" . forAll ((,) <$> text' <*> text') $ \(old, new) ->
    forAll (stretch old) $ \(Region from to) ->
      case RegionMap.forward (RegionMap.between old new) (Region from to) of
        Just (Region there _)
          | from < to ->
            RegionMap.back (RegionMap.between old new) there === Just from
        _ -> property True
  prop "between equal texts every region is unchanged" . forAll text' $ \text ->
    forAll (stretch text) $ \region ->
      RegionMap.forward (RegionMap.between text text) region === Just region
  it "a word that becomes longer has no counterpart" $
    RegionMap.forward (RegionMap.between "let ab = 1" "let abc = 1") (Region 4 6) `shouldBe` Nothing
  it "a word after a word that becomes longer is moved" $
    RegionMap.forward (RegionMap.between "let ab = cd" "let abc = cd") (Region 9 11)
      `shouldBe` Just (Region 10 12)

text' :: Gen Text
text' = Text.pack <$> listOf (elements "ab 🙂\n")

-- | A region of a text.
stretch :: Text -> Gen Region
stretch text = do
  from <- chooseInt (0, Text.length text)
  Region from <$> chooseInt (from, Text.length text)

slice :: Text -> Region -> Text
slice text (Region from to) = Text.take (to - from) (Text.drop from text)
