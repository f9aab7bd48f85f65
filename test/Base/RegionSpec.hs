-- | The laws of places in a text.
module Base.RegionSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.Text (Text)
import Data.Text qualified as Text
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  describe "places in a text" $ do
    it
      "pieces of lines have the words of the whole (catches a line that is cut where another one \
      \is)"
      $ property $
        forAll ((,,) <$> texts <*> texts <*> texts) $ \(above, inside, below) ->
          let source = Region.fromText "p.part" (above <> inside <> below)
              from = Text.length above
           in label (if Text.any (== '\n') inside then "lines" else "one line") $
                concatMap
                  Text.words
                  (Region.pieces source (Region from (from + Text.length inside)))
                  === Text.words inside
    it "so it is in what is imported" $
      property $
        forAll ((,,) <$> texts <*> texts <*> texts) $ \(own, above, inside) ->
          let source = Region.add "q.part" (above <> inside) (Region.fromText "p.part" own)
              from = Region.next (Region.fromText "p.part" own) + Text.length above
           in concatMap Text.words (Region.pieces source (Region from (from + Text.length inside)))
                === Text.words inside

texts :: Gen Text
texts = Text.concat <$> listOf (elements ["a", "бв", " ", "  ", "\n", "\r\n", "(1, 2)", "\t"])
