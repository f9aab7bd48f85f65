-- | The template of the Ural paper: its sections, their deviations from the points, and its page in
-- docs/.
module TemplateSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import Compile (Analysis (part), Compiled (..), Punched (..))
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
import Machines qualified
import Part.Curve (Fitting (..))
import Part.Curve qualified as Curve
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec

spec :: Spec
spec = do
  analysis <- runIO analysed
  let fitted name = [f | (Located _ n, f) <- Part.fittings (part analysis), n == Name name]
      paper = concatMap (NonEmpty.toList . sections) (fitted "paper")
      missed = concatMap deviations (fitted "paper")
      points = concatMap (Vector.toList . Curve.fittedPoints) (fitted "paper")
  it "the formulas of the three sections are the paper's, corrected" $
    map formula paper
      `shouldBe` [ "0.6336634 -17.545050",
                   "-0.00722596 1.1707467 -27.504988",
                   "-0.00460579 0.8200501 -16.220749"
                 ]
  it "the deviations are those of Tables 2 to 4 to 0.01 mm" $
    [ (SectionFit.rowNumber d, Decimal.fixed 2 x)
      | d <- missed,
        let Mm x = SectionFit.signedDeviation d,
        abs x >= 0.005
    ]
      `shouldBe` [(2, "0.01"), (4, "0.03"), (7, "-0.02"), (9, "-0.02"), (11, "0.01"), (12, "0.03")]
  it "three sections are needed within 0.03 mm, and three are found" $ do
    map (length . sections) (fitted "fitted") `shouldBe` [3]
    [k | k <- [2 .. 12], isSingle (take k points), isSingle (drop (k - 1) points)] `shouldBe` []
    let isOutside d = let Mm x = SectionFit.signedDeviation d in abs x > 0.03
    filter isOutside (concatMap deviations (fitted "fitted")) `shouldBe` []
  it "its page shows the points of the program, and the computed values" $ do
    page <- rows <$> readText "docs/template.md"
    [(x, y) | [n, _, _, x, y, _] <- page, isNumber n]
      `shouldBe` [(Decimal.fixed 2 (Vec.x p), Decimal.fixed 2 (Vec.y p)) | p <- points]
    [(n, y, d) | [n, _, _, _, _, y, d] <- page, isNumber n]
      `shouldBe` [ ( Decimal.whole (SectionFit.rowNumber d),
                     Decimal.fixed 4 (Vec.y p + x),
                     Decimal.fixed 4 x
                   )
                   | (d, p) <- zip missed points,
                     let Mm x = SectionFit.signedDeviation d
                 ]
  it "its page shows the program of examples/, and the number of its frames" $ do
    page <- readText "docs/template.md"
    program' <- readText file
    page `shouldSatisfy` Text.isInfixOf (snd (Text.breakOn "part template" program'))
    let loaded = LoadedProgram.fromText (Text.pack file) program'
    case Result.ifSound (Compile.compile (Machines.jobFor lkp01f []) loaded) of
      Just [Compiled {punched = Punched {program}}] ->
        page
          `shouldSatisfy` Text.isInfixOf
            (Decimal.whole (length (Frame.plannedFrames program)) <> " frames")
      _ -> expectationFailure "no tape"
  where
    file = "examples/template.part"
    analysed = do
      text <- readText file
      maybe
        (fail "the template has errors")
        pure
        (Result.ifSound (Compile.analyse [] (LoadedProgram.fromText (Text.pack file) text)))
    -- The cells of the tables, without the marks of bold text.
    rows page =
      [ map (Text.strip . Text.replace "*" "") (drop 1 (init (Text.splitOn "|" line)))
        | line <- Text.lines page,
          Text.isPrefixOf "|" line
      ]
    isNumber n = not (Text.null n) && Text.all (`elem` ['0' .. '9']) n

-- | The coefficients of a polynomial with the digits of the paper.
formula :: Section.Section -> Text
formula p = case Section.formula p of
  Section.Polynomial 0 b c -> Text.unwords [Decimal.fixed 7 b, Decimal.fixed 6 c]
  Section.Polynomial a b c -> Text.unwords [Decimal.fixed 8 a, Decimal.fixed 7 b, Decimal.fixed 6 c]
  Section.Circle _ _ -> "an arc"

-- | Does one line, parabola or arc pass within 0.03 mm, the paper's tolerance, of all these points?
isSingle :: [Point] -> Bool
isSingle points = case Section.table points of
  Right t ->
    length
      (SectionFit.fit (Section.LineKind :| [Section.ParabolaKind, Section.ArcKind]) (Mm 0.03) t)
      == 1
  Left _ -> False
