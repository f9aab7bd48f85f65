-- | The height of a swivelling blade's axis, @z = ∓π·μ°·D2/360@ (Kolsanova, section 3, corrected:
-- the print divides by 360 twice).
module Toolpath.SwivelSpec (spec) where

import Base.Quantity (Mm (..))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Toolpath.Toolpath (Block (..))
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec =
  describe "the axis of a swivelling blade" $ do
    -- μ = 6° and D2 = 60 mm: π·6·60/360 = π mm.
    it "is at π·μ°·D2/360 below its middle on the right (catches a second division by 360)" $
      heightsOn "right" "(0, 0), (60, 0)" "6 deg" `shouldBeNear` [(-pi, -pi)]
    it "is as far above its middle on the left (catches exchanged signs)" $
      heightsOn "left" "(0, 0), (60, 0)" "6 deg" `shouldBeNear` [(pi, pi)]
    it "changes its sign with the bevel (catches an absolute value)" $ do
      heightsOn "right" "(0, 0), (60, 0)" "-6 deg" `shouldBeNear` [(pi, pi)]
      heightsOn "left" "(0, 0), (60, 0)" "-6 deg" `shouldBeNear` [(-pi, -pi)]
    it "has the sign of the side in the direction of travel (catches a side of the drawing)" $
      heightsOn "right" "(60, 0), (0, 0)" "6 deg" `shouldBeNear` [(-pi, -pi)]

-- | The heights at both ends of each move along a line that a blade with a wheel of 60 mm mills on
-- the given side.
heightsOn :: Text -> Text -> Text -> [(Double, Double)]
heightsOn side line bevel =
  [ (a, b)
    | Just Analysis {path} <- [Result.output (Compile.analyse [] program)],
      Cutting {cut} <- Toolpath.blocks path,
      m <- NonEmpty.toList cut,
      let (Mm a, Mm b) = Toolpath.heights m
  ]
  where
    program =
      LoadedProgram.fromText
        "blade.part"
        ( Text.unlines
            [ "part p",
              "tool blade(diameter 20 mm, gear 60 mm)",
              "feed 60 mm/min",
              "tolerance 0.02 mm",
              "from (0, 50)",
              "contour edge open { line(" <> line <> ") bevel " <> bevel <> " }",
              "mill edge " <> side <> " { }"
            ]
        )

-- | Compares heights in mm up to the rounding of doubles.
shouldBeNear :: [(Double, Double)] -> [(Double, Double)] -> Expectation
shouldBeNear found expected =
  (length found, all near (zip found expected)) `shouldBe` (length expected, True)
  where
    near ((a, b), (c, d)) = abs (a - c) < 1e-9 && abs (b - d) < 1e-9
