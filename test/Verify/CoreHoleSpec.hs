-- | Law of tools that need a hole: a tap, a reamer and a thread mill in random holes.
module Verify.CoreHoleSpec
  ( spec,
  )
where

import Base.Decimal qualified as Decimal
import Base.Result qualified as Result
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Machines qualified
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (ReportCode (..))
import Report.Report qualified as Report
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  it
    "a tap, a reamer or a thread mill is refused in a hole that is too narrow or too shallow, and \
    \in no other (catches holes of which only the depth counts)"
    $ property $
      forAll (elements tools) $ \tool ->
        forAll (elements [-0.5, -0.1, 0.1, 0.5]) $ \wider ->
          forAll (elements [-1, -0.1, 0, 0.1, 1]) $ \deeper ->
            let enters = wider < 0 || deeper < 0
             in checkCoverage $
                  cover 10 (wider < 0 && deeper >= 0) "too narrow" $
                    cover 10 (wider > 0 && deeper < 0) "too shallow" $
                      cover 10 (not enters) "fits" $
                        errorsOf (programOf tool wider deeper)
                          === [ReportCode "E0746" | enters]

-- | A tool that needs a hole.
data Tool = Tool
  { -- | statements of the tool; the hole is at (10, 10), and 8 mm deep where the tool works
    statements :: [Text],
    -- | radius in mm within which it cannot cut
    coreRadius :: Double
  }

instance Show Tool where
  show = Text.unpack . Text.unlines . statements

tools :: [Tool]
tools =
  [ Tool ["change 2 tap(diameter 10)", slow, "tap at (10, 10) pitch 1.5 depth 8"] (5 - thread),
    Tool ["change 2 drill(diameter 10)", slow, "ream at (10, 10) depth 8"] (0.8 * 5),
    Tool
      [ "change 2 threadmill(diameter 4, pitch 1.5)",
        slow,
        "thread at (10, 10) diameter 14 pitch 1.5 depth 8 inside"
      ]
      (7 - thread)
  ]
  where
    slow = "spindle cw 300 rpm"
    -- Depth of a thread with the pitch 1.5 mm (ISO 68-1).
    thread = 17 / 24 * 1.5 * sqrt 3 / 2

-- | A program that makes a hole for a tool. Radius and depth of the hole are larger than those of
-- the tool by @wider@ and @deeper@, in mm.
programOf :: Tool -> Double -> Double -> Text
programOf Tool {statements, coreRadius} wider deeper =
  Text.unlines $
    [ "part p",
      "machine linuxcnc-mill",
      "tool 1 mill(diameter " <> mm (2 * (coreRadius + wider)) <> ")",
      "feed 120",
      "tolerance 0.01",
      "clearance 3",
      "from (0, 0, 3)",
      "stock rectangle((-20, -20), (60, 60)) from -20 to 0",
      "spindle cw 500 rpm",
      "drill at (10, 10) depth " <> mm (8 + deeper)
    ]
      <> statements
  where
    mm = Decimal.short 4

-- | Codes of the errors of a program.
errorsOf :: Text -> [ReportCode]
errorsOf text = map Report.code (Result.errors outcome)
  where
    outcome = Compile.compile (Machines.jobFor (Machines.named "linuxcnc-mill") []) loaded
    loaded = LoadedProgram.fromText "p.part" text
