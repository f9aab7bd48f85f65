-- | The equations and angles of sections, as the Ural paper writes them.
module Cli.StepTableSpec (spec) where

import Base.Quantity (LengthUnit (..), Mm (..), Rad (..), radians)
import Cli.StepTable (StepSection (..))
import Cli.StepTable qualified as StepTable
import Data.Text qualified as Text
import Frame.SectionSteps (SectionSteps (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec qualified as Vec
import Test.Hspec

spec :: Spec
spec = describe "the table of steps" $ do
  -- Equation (12) of the paper, from the printed nodes 0 and 1: 20.5/2.5 = 8.2, and 41 − 8.2·5 = 0.
  it "has the paper's equation of section 0–1, y = 8.2x" $
    equation (5, 41) (7.5, 61.5) `shouldBe` "y = 8.2000000 x"
  -- The paper's first section of the template, corrected: 6.4/10.1 and −1.45 − 0.6336634·25.4.
  it "has the constant term with its sign" $
    equation (25.4, -1.45) (35.5, 4.95) `shouldBe` "y = 0.6336634 x − 17.545050"
  it "has equations of lines parallel to an axis (catches an infinite slope)" $
    [equation (3, 0) (3 + 1e-9, 20), equation (0, -4) (20, -4)]
      `shouldBe` ["x = 3.000", "y = -4.000"]
  it "has a constant term in the unit of the program" $
    StepTable.equation Inches (Vec.point 0 25.4) (Vec.point 25.4 50.8)
      `shouldBe` "y = 1.0000000 x + 1.000000"
  it "has angles in degrees and minutes, as the paper prints 172°30′ and 127°" $
    map
      (StepTable.degreesAndMinutes . radians)
      [172.5, 127, 127.272, 0, -67, -0.5, 359.999]
      `shouldBe` ["172°30′", "127°00′", "127°16′", "0°00′", "-67°00′", "-0°30′", "360°00′"]
  it "leaves out columns without a value, and itself if none is left" $ do
    fmap titles (StepTable.steps Millimetres [line, curve])
      `shouldBe` Just ["section", "kind", "equation"]
    StepTable.steps Millimetres [curve] `shouldBe` Nothing
  it "has the numbers of each section in its row" $
    fmap
      (map Text.words . drop 1 . Text.lines)
      ( StepTable.steps
          Millimetres
          [ line {divided = Just (LineSteps 3 (Mm (-2.5)))},
            arc {divided = Just (ArcSteps 9 (Rad (-0.0887)))},
            curve {divided = Just (CurveSteps 4)}
          ]
      )
      `shouldBe` Just
        [ ["0–1", "line", "3", "-2.500", "y", "=", "8.2000000", "x"],
          ["1–2", "arc", "9", "-0.0887", "90°00′", "-90°00′"],
          ["2–3", "curve", "4"]
        ]
  where
    equation (a, b) (c, d) = StepTable.equation Millimetres (Vec.point a b) (Vec.point c d)
    titles = concatMap Text.words . take 1 . Text.lines
    line =
      StepSection
        { name = "0–1",
          kind = "line",
          segment = Just (Straight (Vec.point 5 41) (Vec.point 7.5 61.5)),
          divided = Nothing
        }
    arc =
      StepSection
        { name = "1–2",
          kind = "arc",
          segment =
            Just
              Arc
                { start = Vec.point 0 10,
                  end = Vec.point 0 (-10),
                  centre = Vec.point 0 0,
                  sweep = Rad (-pi)
                },
          divided = Nothing
        }
    curve = StepSection {name = "2–3", kind = "curve", segment = Nothing, divided = Nothing}
