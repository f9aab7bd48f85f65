-- | Curves in the tables of nodes and in the drawing.
module Cli.NodeTableSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Cli.NodeTable qualified as NodeTable
import Compile (Analysis (..))
import Compile qualified
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text qualified as Text
import Draw.Plot qualified as Plot
import Draw.PlotSettings qualified as PlotSettings
import Generate (Case (..))
import Generate qualified
import Generate.Run qualified as Curve
import Geometry.Carrier (Side (..))
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Offset.Equidistant (OffsetSegment (..), Origin (..))
import Part.Part (Part)
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Toolpath.FromPart qualified as FromPart
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec =
  case ( Result.output (FromPart.toToolpath winding),
         Result.output (Compile.analyse [] (LoadedProgram.fromText "p.part" "part p\n"))
       ) of
    (Just path, Just analysis) -> do
      it
        "a curve is one section of the table, with its whole length (catches a row for each of its \
        \arcs)"
        $ do
          let rows =
                [ Text.words l
                  | l <-
                      takeWhile (not . Text.isPrefixOf "length") . Text.lines $
                        NodeTable.nodes Nothing Nothing analysis {part = winding, path},
                    "–" `Text.isInfixOf` l
                ]
          map (take 2) rows `shouldBe` [["0–1", "line"], ["1–2", "curve"], ["2–3", "line"]]
          map (take 1 . drop 5) rows
            `shouldBe` [ ["20.000"],
                         [Decimal.fixed 3 (sum [l | s <- waves path, let Mm l = Segment.length s])],
                         ["20.000"]
                       ]
      it "a curve has nodes only at its ends (catches a node for each of its arcs)" $
        Text.count "<circle" (layer "nodes" (Plot.plot PlotSettings.standard winding path))
          `shouldBe` 4
    _ -> it "has a path" (expectationFailure "there is none")
  where
    waves path =
      [ Toolpath.segment m
        | Toolpath.Cutting {Toolpath.cut} <- Toolpath.blocks path,
          m <- drop 1 (NonEmpty.init cut)
      ]
    layer name text = fst (Text.breakOn "</g>" (snd (Text.breakOn ("id=\"" <> name <> "\"") text)))

-- | A line, a wave of a hundred arcs and a line, milled on the left.
winding :: Part
winding = Generate.partOf (Vec.point (-40) 0) (Part.Mill (Located (Region 0 0) job))
  where
    along = Curve.wave 3 60 120 50
    (p, q) = (Segment.start (head along), Segment.end (last along))
    out d v = Vec.shift (Vec.scale d (Vec.unit v))
    ahead = Straight (out (-20) (Segment.startDirection (head along)) p) p
    behind = Straight q (out 20 (Segment.endDirection (last along)) q)
    job =
      ( Generate.job
          Case
            { contour = Polyarc Open (ahead :| along <> [behind]),
              side = LeftOf,
              radius = Mm 5,
              pieces = OffsetSegment (Along 0) ahead :| []
            }
      )
        { Part.contour =
            Part.Contour
              (Located (Region 0 0) (Name "c"))
              Open
              (NonEmpty.fromList (Curve.elements [[ahead], along, [behind]]))
              []
              [],
          Part.approach = []
        }
