-- | Laws of regions of a text.
module Base.RegionSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.Text (Text)
import Data.Text qualified as Text
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  describe "regions of a text" $ do
    it
      "the lines of a region contain the words of its text (catches a line that is cut at the \
      \column of another line)"
      $ property $
        forAll ((,,) <$> texts <*> texts <*> texts) $ \(above, inside, below) ->
          let source = Region.fromText "p.part" (above <> inside <> below)
              from = Text.length above
           in label (if Text.any (== '\n') inside then "lines" else "one line") $
                concatMap
                  Text.words
                  (Region.linesIn source (Region from (from + Text.length inside)))
                  === Text.words inside
    it "the lines of a region in an imported file contain the words of its text" $
      property $
        forAll ((,,) <$> texts <*> texts <*> texts) $ \(own, above, inside) ->
          let source = Region.addFile "q.part" (above <> inside) (Region.fromText "p.part" own)
              from = Region.nextOffset (Region.fromText "p.part" own) + Text.length above
           in concatMap Text.words (Region.linesIn source (Region from (from + Text.length inside)))
                === Text.words inside

texts :: Gen Text
texts = Text.concat <$> listOf (elements ["a", "бв", " ", "  ", "\n", "\r\n", "(1, 2)", "\t"])
