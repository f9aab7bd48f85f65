-- | Laws of the reports for a person.
module Report.HumanSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.List (isInfixOf)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Human (Colour (Plain))
import Report.Human qualified as Human
import Report.Report (Label (..), Report (..), ReportPlace (..), Severity (..), report)
import Test.Hspec
import Test.QuickCheck hiding (label)

spec :: Spec
spec = do
  describe "source lines, labels, sentences and hints" $ do
    it
      "keep to the width of the terminal (catches a label that is written beside its mark however \
      \long it is)"
      $ property $
        forAll cases $ \(columns, content, given) ->
          let source = Region.fromText "a.part" (Text.pack content)
              shown = Human.renderWithin columns Plain "a.part" source given
              -- The title and the position keep to no width.
              rows = drop 2 (Text.lines shown)
           in counterexample
                (Text.unpack shown)
                (conjoin [Text.length row <= max 40 columns | row <- rows])
    it "lose no word of a label" $
      property $
        forAll ((,) <$> choose (40, 140) <*> sentence) $ \(columns, words') ->
          let source = Region.fromText "a.part" (Text.replicate 20 "word ")
              given = said {label = Text.unwords words'}
              shown = Human.renderWithin columns Plain "a.part" source given
           in counterexample
                (Text.unpack shown)
                (words' `isInfixOf` filter (`notElem` ["|", "^^^^"]) (Text.words shown))
  describe "the summary" $ do
    it "names the command that explains the first error" $ do
      summary [warning, second, first]
        `shouldBe` "2 errors, 1 warning. ‘partc explain E0202’ explains the first.\n"
      summary [warning] `shouldBe` "1 warning. ‘partc explain W0501’ explains it.\n"
      summary [] `shouldBe` ""
  where
    summary = Human.summary Plain
    said = report Error "E0101" (InSource (Region 40 44)) "x"
    warning = report Warning "W0501" InFile "a"
    second = report Error "E0202" InFile "b"
    first = report Error "E0101" InFile "c"
    word = Text.pack <$> (choose (1, 9) >>= \n -> vectorOf n (elements ['a' .. 'z']))
    sentence = choose (1, 40) >>= \n -> vectorOf n word
    lines' = unlines <$> listOf1 (unwords . map Text.unpack <$> sentence)
    -- The width of a terminal, a text, and a report on it.
    cases = do
      content <- lines'
      texts <- vectorOf 6 (Text.unwords <$> sentence)
      given <- (\places -> reportOn (length content) places texts) <$> vectorOf 3 place'
      columns <- choose (30, 140)
      pure (columns, content, given)
    place' = (,) <$> choose (0, 1) <*> choose (0, 80)

-- | A report on a text of @size@ characters. A place is given by its distance from the start of the
-- text, as a share of its size, and by its own size.
reportOn :: Int -> [(Double, Int)] -> [Text] -> Report
reportOn size places texts = case (map region places, texts) of
  (main : others', title : label' : sentence : hint : labels) ->
    (report Error "E0101" (InSource main) title)
      { label = label',
        others = zipWith Label others' labels,
        message = [sentence],
        hints = [hint]
      }
  _ -> report Error "E0101" InFile ""
  where
    region (share, count) =
      let at = floor (share * fromIntegral size) in Region at (min size (at + count))
