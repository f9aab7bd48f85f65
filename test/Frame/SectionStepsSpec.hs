-- | The steps of sections: the numbers k, h and Δφ of the Ural paper.
module Frame.SectionStepsSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad (..))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Data.IntMap.Strict qualified as IntMap
import Data.Text (Text)
import Data.Text qualified as Text
import Flange qualified
import Frame.Frame (PlannedFrame (role), Role (Cutting))
import Frame.Frame qualified as Frame
import Frame.SectionSteps (SectionSteps (..))
import Frame.SectionSteps qualified as SectionSteps
import Machine.Machine (Machine)
import Machines (iso6983, lkp01f, n55)
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Toolpath.Toolpath (Toolpath)

spec :: Spec
spec = describe "the steps of sections" $ do
  -- docs/flange.md: the arc from 173.007° to 127.272° sweeps −45.735°, nine steps of −0.0887 rad.
  -- A lug sweeps −74.007°: 0.02 mm at R = 19 is a step of 0.0918 rad, so fifteen. A hollow of
  -- R = 26 sweeps 45.469°: a step of 0.0785 rad, so eleven.
  it "are those of the flange's page (catches chords for the radius of the part)" $
    map brief (take 6 (ofFlange lkp01f))
      `shouldBe` [ "15 chords -0.0861",
                   "1 of 2.500",
                   "9 chords -0.0887",
                   "11 chords 0.0721",
                   "9 chords -0.0887",
                   "1 of 16.398"
                 ]
  it "are as many as the frames of the contour (catches a section that is left out)" $
    sum (map countOf (ofFlange lkp01f))
      `shouldBe` length [p | p <- Frame.plannedFrames Flange.program, role p == Cutting 0]
  it "are none where the machine makes an arc" $
    map brief (steps n55 (arcAndLine "tolerance 0.02 mm"))
      `shouldBe` ["1 of 10.000", "none", "1 of -450.000"]
  -- 450 mm are 22500 pulses; a frame of lkp-01f has at most 9999.
  it "divide a line that does not fit into a frame (catches one frame for every line)" $
    map brief (drop 2 (steps lkp01f (arcAndLine "tolerance 0.02 mm"))) `shouldBe` ["3 of -150.000"]
  -- On R = 55 with 0.1 mm outwards a chord spans at most 2·arccos(55/55.1) = 0.1205. The first
  -- chord and the last one span half of it. Between them 3.1416 − 0.1205 needs 26 chords of 0.1162.
  it "have the angle of the inner chords of a tolerance with two sides" $
    map brief (take 1 (drop 1 (steps lkp01f (arcAndLine "tolerance inside 0 outside 0.1"))))
      `shouldBe` ["28 chords 0.1162"]
  it "are left out if the control computes the path" $
    SectionSteps.sectionSteps iso6983 (pathOf compensated) `shouldBe` IntMap.empty

brief :: SectionSteps -> Text
brief s = case s of
  LineSteps k (Mm h) -> Decimal.whole k <> " of " <> Decimal.fixed 3 h
  ArcSteps k (Rad a) -> Decimal.whole k <> " chords " <> Decimal.fixed 4 a
  CurveSteps k -> Decimal.whole k <> " chords"
  NoSteps -> "none"

countOf :: SectionSteps -> Int
countOf s = case s of
  LineSteps k _ -> k
  ArcSteps k _ -> k
  CurveSteps k -> k
  NoSteps -> 0

steps :: Machine -> Text -> [SectionSteps]
steps machine = ofPath machine . pathOf

ofFlange :: Machine -> [SectionSteps]
ofFlange machine = ofPath machine (path Flange.analysis)

ofPath :: Machine -> Toolpath -> [SectionSteps]
ofPath machine = concat . IntMap.elems . SectionSteps.sectionSteps machine

-- | The path of a program.
pathOf :: Text -> Toolpath
pathOf text =
  maybe
    (error "the program has mistakes")
    path
    (Result.output (Compile.analyse [] (LoadedProgram.fromText "p.part" text)))

-- | A line of 10 mm, a half circle of radius 50, counter-clockwise, and a line of 450 mm in the
-- direction of −x, milled on their right with a cutter of radius 5.
arcAndLine :: Text -> Text
arcAndLine tolerance =
  Text.unlines
    [ "part p",
      "tool mill(diameter 10 mm)",
      "feed 60 mm/min",
      tolerance,
      "from (-30, -60)",
      "contour c open {",
      "line((-10, -50), (0, -50)) smooth",
      "ccw circle((0, 0), 50) smooth",
      "line((0, 50), (-450, 50))",
      "}",
      "mill c right { }"
    ]

compensated :: Text
compensated =
  Text.unlines
    [ "part p",
      "tool mill(diameter 10 mm)",
      "feed 60 mm/min",
      "tolerance 0.02 mm",
      "clearance 5 mm",
      "from (-30, 40, 5)",
      "contour c open { line((0, 0), (60, 0)) }",
      "mill c left {",
      "compensation controller",
      "depth 2 mm",
      "lead in line 12",
      "lead out line 12",
      "approach (-20, 40)",
      "retract (90, 40)",
      "}"
    ]
