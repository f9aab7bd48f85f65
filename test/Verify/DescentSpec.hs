-- | Programs with ramps, helices, spirals and tabs on all machines.
module Verify.DescentSpec (spec) where

import Base.Result qualified as Result
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Machines qualified
import Numeric (showFFloat)
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (ReportCode (..))
import Report.Report qualified as Report
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  it
    "tapes with ways down and tabs are proven, or refused before there is a tape (catches a helix \
    \of chords, and a ramp on the wrong side)"
    $ withMaxSuccess 150 . checkCoverage . forAll program $ \text ->
      forAll (elements machines) $ \machine ->
        let outcome =
              Compile.compile
                (Machines.jobFor (Machines.named machine) [])
                (LoadedProgram.fromText "p.part" text)
            codes = [code | r <- Result.errors outcome, ReportCode code <- [Report.code r]]
            atPoints = "tab at" `Text.isInfixOf` text
         in cover 20 (null codes) "tapes"
              . classify (null codes && atPoints) "tapes with tabs at points"
              . classify ("E0426" `elem` codes && atPoints) "points without room"
              . counterexample (Text.unpack text <> show codes)
              $ not (any ("E07" `Text.isPrefixOf`) codes)
  where
    machines =
      ["iso6983", "linuxcnc-mill", "grbl", "haas", "fanuc", "marlin", "lki-un", "n55", "lkp-01f"]

-- | A random program with one or two statements that go down by ramps, helices and spirals.
program :: Gen Text
program = do
  r <- choose (1, 4)
  n <- choose (1, 2)
  statements <- vectorOf n (statement r)
  pure . Text.unlines $
    [ "part p",
      "tool 1 mill(diameter " <> number (2 * r) <> ")",
      "spindle manual",
      "feed 60",
      "tolerance 0.05",
      "clearance 5",
      "safe 20",
      "from (-100, -100, 20)",
      "let room = rounded((0, 0), 60, 40, 6)",
      "let round = rounded((0, 0), 70, 50, 8)",
      "contour disc closed { ccw circle((0, 0), 22) }",
      "let star = offset_of(polygon([(0, 0), (60, 10), (80, 60), (20, 50)]), 5)",
      "contour key open { (0, 0) (40, 0) (40, 30) }",
      "contour boss closed { cw circle((30, 20), 4) }",
      "rapid (-100, -100, 5)"
    ]
      <> statements
      <> ["rapid (-100, -100, 20)"]

-- | A random statement for a cutter of the radius @r@.
statement :: Double -> Gen Text
statement r = do
  deep <- choose (1, 7)
  step <- choose (0.4, 4)
  contour' <- elements ["room", "disc", "star", "round"]
  side <- elements ["inside", "outside"]
  angle <- choose (1, 40)
  pitch <- choose (0.3, 3)
  share <- choose (0.15, 1)
  across <- elements ["", " diameter " <> number (2 * r * share)]
  tabs <- tabsOf (" width 3 height " <> number (deep * 0.4) <> " angle " <> number (angle + 20))
  left <- elements ["", " allowance 0.5, 0"]
  retract <- elements ["", " retract (-100, -100) rapid"]
  let depth = " depth " <> number deep <> " step " <> number step
      ramp = " ramp " <> number angle
      helix = " helix pitch " <> number pitch <> across
      mill what = "mill " <> what <> " {" <> depth
  elements
    [ mill (contour' <> " " <> side) <> ramp <> tabs <> left <> " }",
      mill (contour' <> " " <> side) <> " spiral" <> tabs <> left <> retract <> " }",
      mill (contour' <> " outside") <> " approach (-50, -50) rapid" <> helix <> tabs <> " }",
      mill "room inside" <> " approach (30, 20) rapid" <> helix <> " lead in arc 2 }",
      mill "key on" <> ramp <> left' left <> " }",
      mill "key left" <> ramp <> tabs <> " }",
      "pocket room step " <> number r <> " { islands boss" <> depth <> ramp <> left <> " }",
      "pocket room step " <> number r <> " { islands boss" <> depth <> helix <> left <> " }",
      "pocket disc step " <> number r <> " {" <> depth <> helix <> retract <> " }",
      "pocket star step " <> number r <> " { approach (40, 30) rapid" <> depth <> helix <> " }"
    ]
  where
    -- There is no allowance on a contour.
    left' _ = ""

-- | No tabs, two tabs along the contour, or two at points: near each other, near a corner, or with
-- room. @size@ has the width, the height and the angle.
tabsOf :: Text -> Gen Text
tabsOf size = do
  x <- choose (12, 36)
  gap <- choose (1, 30)
  frequency . zip [1, 1, 2] . map pure $
    [ "",
      " tabs 2" <> size,
      " tab at (" <> number x <> ", 0), (" <> number (x + gap) <> ", 0)" <> size
    ]

number :: Double -> Text
number x = Text.pack (showFFloat (Just 4) x "")
