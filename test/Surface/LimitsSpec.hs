-- | Extreme texts give few reports, with regions inside the text.
module Surface.LimitsSpec (spec) where

import Base.Region qualified as Region
import Base.Result qualified as Result
import Compile qualified
import Data.List (sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (Report, ReportCode (..), ReportPlace (..))
import Report.Report qualified as Report
import Surface.Keyword qualified as Keyword
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "nesting a hundred thousand deep gives one report" $
    mapM_
      nested
      [ ( "parentheses",
          "part p\nlet a = " <> Text.replicate 100000 "(" <> "1" <> Text.replicate 100000 ")"
        ),
        ("open lists", "part p\nlet a = " <> Text.replicate 100000 "["),
        ("blocks", "part p\n" <> Text.replicate 100000 "for a in [1] {\n"),
        ( "blocks of a contour",
          "part p\ncontour c closed {\n" <> Text.replicate 100000 "for a in [1] {\n"
        ),
        ("signs", "part p\nlet a = " <> Text.replicate 100000 "- " <> "1"),
        ("conditions", "part p\nlet a = " <> Text.replicate 100000 "if true then 1 else " <> "1"),
        ("negations", "part p\nlet a = " <> Text.replicate 100000 "not " <> "true")
      ]
  describe "a line of ten million characters" $ do
    it "with one word gives one report" $
      codes ("part p " <> Text.replicate 10000000 "x") `shouldBe` ["E0108"]
    it "with many tokens is too long" $
      codes ("part p\nlet a = 1" <> Text.replicate 5000000 "+1") `shouldBe` ["E0116"]
    it "with one comment gives no report" $
      codes ("part p --" <> Text.replicate 10000000 "x") `shouldBe` []
  it "random words and characters give reports, all with regions inside the text" $
    withMaxSuccess 300 . property $
      forAllShow noise Text.unpack $ \text ->
        let places = [r | Report.Report {Report.place = InSource r} <- reports text]
         in all (\r -> Region.start r >= 0 && Region.end r <= Text.length text + 1) places
              .&&. not (null (reports text))
  it "the lines and columns of reports do not depend on the kind of line ends" $
    property $
      forAllShow noise Text.unpack $ \text ->
        let unix = Text.replace "\r" "" text
            placed t =
              sort
                [ (line, column, c)
                  | r <- reports t,
                    InSource at <- [Report.place r],
                    let Region.Position {Region.line, Region.column} =
                          Region.position (Region.fromText "" t) (Region.start at)
                        ReportCode c = Report.code r
                ]
         in placed (Text.replace "\n" "\r\n" unix)
              === placed unix .&&. placed (Text.replace "\n" "\r" unix)
              === placed unix
  where
    nested (name, text) = it name $ codes text `shouldBe` ["E0110"]

reports :: Text -> [Report]
reports text = Result.errors (Compile.analyse [] (LoadedProgram.fromText "p.part" text))

codes :: Text -> [Text]
codes text = [c | ReportCode c <- map Report.code (reports text)]

-- | A text of words, symbols, arbitrary characters and line ends in random order.
noise :: Gen Text
noise =
  Text.concat
    <$> listOf
      ( frequency
          [ (6, (<> " ") <$> elements words'),
            (3, elements signs),
            (1, Text.singleton <$> arbitrary),
            (1, pure "\n")
          ]
      )
  where
    words' =
      Keyword.reservedWords
        <> ["a", "b", "рука", "12", "3.5", "7 mm", "45 deg", "circle(", "line(", "\"text\"", "--"]
    signs = map Text.singleton "(){}[],=+-*/<>.\"%#;"
