-- | Reference points of the rows of a table, worked out by hand.
module Toolpath.ReferencePointSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (SpacePoint (..))
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Toolpath.ReferencePoint (PieceRows (..), ReferencePoint (..))
import Toolpath.ReferencePoint qualified as ReferencePoint
import Toolpath.Toolpath (Block (..))
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec = describe "the reference points of a pass" $ do
  -- The cipher moves y = 20 to 22, and the cutter of 10 mm moves on y = 27. The axis is at
  -- π·μ·60/360 for μ = 3°, 6° and 9°. The fillet cuts off the contour at x = 42, so row 4 is not on
  -- it.
  it
    "are a radius beside the piece, with the height of a blade's axis (catches a row behind a \
    \link)"
    $ shown (pointsIn bladed)
      `shouldBe` [ ( 4,
                     [ (1, "0.000 20.000", "0.000 22.000", "0.000 27.000 1.571"),
                       (2, "20.000 20.000", "20.000 22.000", "20.000 27.000 3.142"),
                       (3, "40.000 20.000", "40.000 22.000", "40.000 27.000 4.712")
                     ]
                   )
                 ]
  it "are on the other side if the contour is milled on its right (catches a fixed side)" $
    [ place
      | (_, rows) <- shown (pointsIn (Text.replace "mill edge left" "mill edge right" bladed)),
        (_, _, _, place) <- rows
    ]
      `shouldBe` [ "0.000 17.000 -1.571",
                   "20.000 17.000 -3.142",
                   "40.000 17.000 -4.712"
                 ]
  it "keep the allowance of the pass and that of the element" $
    [ place
      | (_, rows) <- shown (pointsIn allowed),
        (_, _, _, place) <- rows
    ]
      `shouldBe` ["0.000 26.500 -2.000", "20.000 26.500 -2.000", "40.000 26.500 -2.000"]
      <> ["0.000 25.500 -2.000", "20.000 25.500 -2.000", "40.000 25.500 -2.000"]
  it "are absent where the cutter does not fit (catches a point that the path does not pass)" $
    [ (k, place /= "")
      | (_, rows) <- shown (pointsIn narrow),
        (k, _, _, place) <- rows
    ]
      `shouldBe` [(1, True), (2, False), (3, True)]
  it "are those of every curve, also in a contour with another start" $
    map fst (shown (pointsIn closed)) `shouldBe` [5]

shown :: [PieceRows] -> [(Int, [(Int, Text, Text, Text)])]
shown pieces =
  [ (rowCount p, [(row r, at (given r), at (onPart r), maybe "" place (centre r)) | r <- points p])
    | p <- pieces
  ]
  where
    at :: Point -> Text
    at q = number (Vec.x q) <> " " <> number (Vec.y q)
    place (SpacePoint q (Mm z)) = at q <> " " <> number z
    number = Decimal.fixed 3

-- | The pieces of all passes of a program.
pointsIn :: Text -> [PieceRows]
pointsIn text =
  concat
    [ ReferencePoint.ofPass part job pass cut
      | Just Analysis {part, path} <-
          [Result.output (Compile.analyse [] (LoadedProgram.fromText "p.part" text))],
        Cutting {job = Located _ job, pass, cut} <- Toolpath.blocks path
    ]

bladed :: Text
bladed =
  Text.unlines
    [ "part p",
      "tool blade(diameter 10 mm, gear 60 mm)",
      "feed 60 mm/min",
      "tolerance 0.02 mm",
      "from (-50, 27, 0)",
      "table hull { x y mu deg",
      "0 20 3",
      "20 20 6",
      "40 20 9",
      "60 20 9",
      "}",
      "curve skin = spline(hull)",
      "piece rim = skin cipher 2(2) left",
      "contour edge open { rim bevel mu fillet -8 line((50, 22), (50, 80)) bevel 9 deg }",
      "mill edge left { }"
    ]

-- | A cutter of 10 mm along y = 20, with an allowance of 1 mm for the first pass only, and one of
-- 0.5 mm on the element.
allowed :: Text
allowed =
  Text.unlines
    [ "part p",
      "tool mill(diameter 10 mm)",
      "feed 60 mm/min",
      "tolerance 0.02 mm",
      "clearance 5 mm",
      "from (-50, 27, 5)",
      "table hull { x y",
      "0 20",
      "20 20",
      "40 20",
      "}",
      "contour edge open { spline(hull) allowance 0.5 }",
      "mill edge left { depth 2 mm allowance 1, 0 }"
    ]

-- | A hollow that is narrower than the cutter.
narrow :: Text
narrow =
  Text.unlines
    [ "part p",
      "tool mill(diameter 30 mm)",
      "feed 60 mm/min",
      "tolerance 0.02 mm",
      "clearance 40 mm",
      "from (-50, 50, 40)",
      "table hull { x y",
      "0 30",
      "15 5",
      "30 30",
      "}",
      "contour edge open { spline(hull) }",
      "mill edge left { depth 2 mm rest allowed }"
    ]

-- | A closed contour that is milled from another start.
closed :: Text
closed =
  Text.unlines
    [ "part p",
      "tool mill(diameter 10 mm)",
      "feed 60 mm/min",
      "tolerance 0.02 mm",
      "clearance 5 mm",
      "from (-50, 50, 5)",
      "table hull { x y",
      "0 0",
      "10 5",
      "20 0",
      "30 5",
      "40 0",
      "}",
      "contour edge closed {",
      "spline(hull)",
      "line((40, 0), (40, -30))",
      "line((40, -30), (0, -30))",
      "line((0, -30), (0, 0))",
      "}",
      "mill edge outside { start near (40, -30) depth 2 mm rest allowed }"
    ]
