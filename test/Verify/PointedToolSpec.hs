-- | Proof of profiles that are turned with a nose without radius: its tip lies on the contour.
module Verify.PointedToolSpec (spec) where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Generate (Case (..))
import Generate qualified
import Generate.Arcs qualified as Arcs
import Geometry.Carrier (Sense (..), Side (..))
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine (Braking (deceleration), Machine)
import Machine.Machine qualified as Machine
import Machines qualified
import Offset.Equidistant qualified as Equidistant
import Part.Part qualified as Part
import Test.Hspec
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Toolpath)
import Verify.FromTape qualified as Verify
import Verify.Proof (Finding (..), Witness (amount))
import Verify.Proof qualified as Proof

spec :: Spec
spec = describe "a nose without radius" $ do
  it
    "is proven on the contour, outside and inside, in both directions (catches motions on the \
    \contour that do not count as beside it)"
    $ [ (side, back)
        | side <- [Part.Outside, Part.Inside],
          back <- [False, True],
          let path = turned side back; program = Arcs.quantise machine path,
          found path program (own program) /= []
      ]
      `shouldBe` []
  it
    "gouges if it is shifted into the material, and leaves material if it is shifted out of it \
    \(catches a cutter that is taken for one on the contour)"
    $ [ (side, back, d, map kind fs)
        | side <- [Part.Outside, Part.Inside],
          back <- [False, True],
          d <- [-10, -5, 5, 10],
          let path = turned side back
              program = Arcs.quantise machine path
              fs = found path program (shifted d (own program)),
          -- The tool is outside at a greater distance from the axis.
          let deep = (d < 0) == (side == Part.Outside),
          any isGouge fs /= deep || any isExcess fs == deep
      ]
      `shouldBe` []
  it "is found with the depth of its gouge: 10 pulses on a profile that is shifted by 10 pulses" $
    [ round (amount worst `inPulses` machine)
      | path <- [turned Part.Outside False],
        let program = Arcs.quantise machine path,
        Gouge _ worst _ <- found path program (shifted (-10) (own program))
    ]
      `shouldBe` [10 :: Int]
  it "gouges in a linking move that crosses the profile (catches a proof by the distance 0)" $
    [ map kind fs
      | let path = turned Part.Outside False
            program = Arcs.quantise machine path
            fs =
              found
                path
                program
                (own program <> map dip [Pulses3 4000 0 0, Pulses3 0 (-3000) 0, Pulses3 0 3000 0]),
        not (any isGouge fs)
    ]
      `shouldBe` []
  where
    own program = map Frame.frame (Frame.plannedFrames program)
    found path program fs = Proof.findings (Verify.prove machine path program fs)
    -- Frames between the first and the last one, @d@ pulses further from the axis.
    shifted d fs = case fs of
      f : rest
        | final : _ <- reverse rest ->
          f {increment = increment f + Pulses3 0 d 0} :
          init rest
            <> [final {increment = increment final - Pulses3 0 d 0}]
      _ -> fs
    dip d =
      Frame
        { motion = Linear,
          increment = d,
          Frame.turn = 0,
          Frame.centre = 0,
          feedCode = Machine.rapidCode machine,
          braking = False,
          commands = []
        }
    Mm a `inPulses` m = let Mm p = Machine.planeResolution m in a / p
    kind f = takeWhile (/= ' ') (show f)
    isGouge f = case f of
      Gouge {} -> True
      _ -> False
    isExcess f = case f of
      Excess {} -> True
      _ -> False

machine :: Machine
machine = m {Machine.braking = (Machine.braking m) {deceleration = 1e12}}
  where
    m = Machines.named "lki-u"

-- | Shaft with a cone, a shoulder and a round of radius 12 beside the axis y = 0, turned by a tool
-- without radius on a side, forwards or backwards.
turned :: Part.Side -> Bool -> Toolpath
turned side back =
  case Result.output
    ( Toolpath.toToolpath
        ( Generate.partOf
            (Vec.point (if back then -100 else 10) 80)
            (Part.Mill (Located (Region 0 0) job))
        )
    ) of
    Just path -> path
    Nothing -> error "no path"
  where
    profile =
      Straight (p 0 20) (p (-15) 20)
        :| [ Straight (p (-15) 20) (p (-30) 26),
             Straight (p (-30) 26) (p (-30) 30),
             Segment.arc CounterClockwise (p (-42) 30) (p (-30) 30) (p (-42) 42),
             Straight (p (-42) 42) (p (-60) 42)
           ]
    p = Vec.point
    contour' = if back then NonEmpty.reverse (fmap Segment.reverse profile) else profile
    begin' = Segment.start (NonEmpty.head contour')
    job =
      ( Generate.job
          Case
            { contour = Polyarc Open contour',
              side = LeftOf,
              radius = Mm 0,
              pieces =
                Equidistant.OffsetSegment (Equidistant.Along 0) (NonEmpty.head contour') :| []
            }
      )
        { Part.work = Part.Turned,
          Part.side = Located (Region 0 0) side,
          Part.radius = Mm 0,
          Part.approach = [Part.Stop (Located (Region 0 0) begin') Nothing Part.Rapid],
          Part.retract =
            [ Part.Stop
                (Located (Region 0 0) (Vec.point (if back then 40 else -100) 80))
                Nothing
                Part.Rapid
            ]
        }
