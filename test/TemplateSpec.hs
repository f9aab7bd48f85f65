-- | The template of the Ural paper: its pieces, by how much they miss the points, and its page.
module TemplateSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import Compile (Analysis (..), Punched (..))
import Compile qualified
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Files (readText)
import Frame.Frame qualified as Frame
import Geometry.Curve.Section qualified as Section
import Geometry.Curve.SectionFit qualified as SectionFit
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machines (lkp01f)
import Part.Curve (Fitting (..))
import Part.Curve qualified as Curve
import Part.Part qualified as Part
import Test.Hspec

spec :: Spec
spec = do
  analysis <- runIO analysed
  let fitted name = [f | (Located _ n, f) <- Part.fittings (part analysis), n == Name name]
      paper = concatMap (NonEmpty.toList . pieces) (fitted "paper")
      missed = concatMap misses (fitted "paper")
      points = concatMap (Vector.toList . Curve.through) (fitted "paper")
  it "the formulas of the three sections are the paper's, corrected" $
    map formula paper
      `shouldBe` [ "0.6336634 -17.545050",
                   "-0.00722596 1.1707467 -27.504988",
                   "-0.00460579 0.8200501 -16.220749"
                 ]
  it "the deviations are those of Tables 2 to 4 to 0.01 mm" $
    [ (SectionFit.ofRow d, Decimal.fixed 2 x)
      | d <- missed,
        let Mm x = SectionFit.miss d,
        abs x >= 0.005
    ]
      `shouldBe` [(2, "0.01"), (4, "0.03"), (7, "-0.02"), (9, "-0.02"), (11, "0.01"), (12, "0.03")]
  it "three pieces are needed within 0.03 mm, and three are found" $ do
    map (length . pieces) (fitted "fitted") `shouldBe` [3]
    [k | k <- [2 .. 12], single (take k points), single (drop (k - 1) points)] `shouldBe` []
    [SectionFit.ofRow d | f <- fitted "fitted", d <- misses f, let Mm x = SectionFit.miss d, abs x > 0.03]
      `shouldBe` []
  it "its page shows the points of the program, and what is computed" $ do
    page <- rows <$> readText "docs/template.md"
    [(x, y) | [n, _, _, x, y, _] <- page, isNumber n]
      `shouldBe` [(Decimal.fixed 2 (Vec.x p), Decimal.fixed 2 (Vec.y p)) | p <- points]
    [(n, y, d) | [n, _, _, _, _, y, d] <- page, isNumber n]
      `shouldBe` [ ( Decimal.whole (SectionFit.ofRow d),
                     Decimal.fixed 4 (Vec.y p + x),
                     Decimal.fixed 4 x
                   )
                   | (d, p) <- zip missed points,
                     let Mm x = SectionFit.miss d
                 ]
  it "its page shows the program as it stands among the examples, and counts its frames" $ do
    page <- readText "docs/template.md"
    program' <- readText file
    page `shouldSatisfy` Text.isInfixOf (snd (Text.breakOn "part template" program'))
    frames <-
      maybe
        (fail "no tape")
        pure
        ( Result.settled
            ( Compile.punch lkp01f (path analysis) `Result.thenSound` \p ->
                Compile.readTape lkp01f (Frame.start (program p)) (tape p)
            )
        )
    page `shouldSatisfy` Text.isInfixOf (Decimal.whole (length frames) <> " frames")
  where
    file = "examples/template.part"
    analysed = do
      text <- readText file
      maybe
        (fail "the template has errors")
        pure
        (Result.settled (Compile.analyse [] (Compile.alone (Text.pack file) text)))
    -- The cells of the tables, bold or not.
    rows page =
      [ map (Text.strip . Text.replace "*" "") (drop 1 (init (Text.splitOn "|" line)))
        | line <- Text.lines page,
          Text.isPrefixOf "|" line
      ]
    isNumber n = not (Text.null n) && Text.all (`elem` ['0' .. '9']) n

-- | The coefficients of a polynomial with as many digits as the paper has.
formula :: Section.Section -> Text
formula p = case Section.formula p of
  Section.Polynomial 0 b c -> Text.unwords [Decimal.fixed 7 b, Decimal.fixed 6 c]
  Section.Polynomial a b c -> Text.unwords [Decimal.fixed 8 a, Decimal.fixed 7 b, Decimal.fixed 6 c]
  Section.Circle _ _ -> "an arc"

-- | Whether one line, parabola or arc goes through these points within the paper's tolerance.
single :: [Point] -> Bool
single points = case Section.table points of
  Right t ->
    length
      (SectionFit.fit (Section.LineKind :| [Section.ParabolaKind, Section.ArcKind]) (Mm 0.03) t)
      == 1
  Left _ -> False
