-- | Proof of tapes with arcs: the flange and random contours on machines with circular
-- interpolation, and damaged tapes of both.
module Verify.ArcSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (LengthUnit (..), Mm (..), Pulses (..), Rad (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Flange qualified
import Frame.Frame (Frame (..), FrameMotion (..), FrameProgram)
import Frame.Frame qualified as Frame
import Generate (Case (..))
import Generate qualified
import Generate.Arcs (Deviation (..))
import Generate.Arcs qualified as Arcs
import Geometry.Carrier (Circle (Circle), Sense (..), Side (..))
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Braking (deceleration), FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Machines qualified
import Offset.Equidistant qualified as Equidistant
import Part.Part qualified as Part
import Test.Hspec
import Test.QuickCheck
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromTape qualified as Verify
import Verify.Proof (Finding (..), Refusal (..))
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  describe "the flange" $
    mapM_ flange ["lki-u", "lki-fm", "lki-un", "n55", "iso6983"]
  it
    "random contours of lines and arcs are proven in frames with arcs (catches an arc that is \
    \measured by its chord)"
    $ property $
      forAll
        ( (,)
            <$> elements ["lki-u", "lki-fm", "lki-un", "n55"]
              <*> (Generate.closedCase `suchThat` ((> 0.4) . Generate.radiusOf))
        )
        $ \(name, c) ->
          case Generate.milled (Mm 0.02) c of
            Nothing -> discard
            Just path ->
              let program =
                    Arcs.quantise (quick name) path
               in findings (quick name) path program (own program) === []
  it
    "a changed tape of a random contour is found if it cuts too deep or leaves too much (catches \
    \a motion that is measured at its middle alone)"
    $ property $
      withMaxSuccess 300 $
        forAll
          ( (,)
              <$> elements ["lki-u", "lki-fm", "lki-un"]
                <*> (Generate.closedCase `suchThat` ((> 0.4) . Generate.radiusOf))
          )
          $ \(name, c) ->
            case Generate.milled (Mm 0.02) c of
              Nothing -> discard
              Just path ->
                let program =
                      Arcs.quantise (quick name) path
                 in changed
                      (quick name)
                      path
                      program
                      (NonEmpty.toList (segments (contour c)))
                      (Generate.radiusOf c)
  describe "a full circle in one frame" $ do
    it "is proven, inside and outside" $
      [s | (s, (path, program)) <- rounds, findings uncut path program (own program) /= []]
        `shouldBe` []
    it
      "is an excess if it is left out, and not followed in the opposite sense (catches a circle \
      \that is dropped because its increment is zero)"
      $ do
        [s | (s, found) <- changedBy (filter (not . isCircle)), not (any isExcess found)]
          `shouldBe` []
        [s | (s, found) <- changedBy (map mirrored), not (any isNotFollowed found)]
          `shouldBe` []
    it
      "gouges or leaves material if its centre changes, although its ends do not (catches a \
      \circle taken for a point)"
      $ [ (s, d)
          | (s, (path, program)) <- rounds,
            d <- [Pulses2 5 0, Pulses2 (-5) 0, Pulses2 0 5, Pulses2 0 (-5)],
            not
              ( any
                  (\f -> isGouge f || isExcess f)
                  ( findings
                      uncut
                      path
                      program
                      [if isCircle f then f {centre = centre f + d} else f | f <- own program]
                  )
              )
        ]
        `shouldBe` []
    it
      "is a gouge if it meets the part during the approach (catches linking moves that are \
      \measured at their ends alone)"
      $ [ s
          | (s, (path, program)) <- rounds,
            f : fs <- [own program],
            let loop =
                  Frame
                    { motion = Circular Clockwise,
                      increment = 0,
                      turn = 0,
                      centre = Pulses2 (-1000) 0,
                      feedCode = feedCode f,
                      braking = False,
                      commands = []
                    },
            not (any isGouge (findings uncut path program (loop : f : fs)))
        ]
        `shouldBe` []
  describe "frames that the control would refuse" $ do
    it
      "are arcs without a centre, arcs without a sweep, and arcs whose radii differ by more than \
      \2 pulses, but no other arcs"
      $ [(what, refusals uncut f) | (what, expected, f) <- arcs, refusals uncut f /= expected]
        `shouldBe` []
    it
      "are all arcs on a machine without arcs, and arcs that leave their quadrant where a \
      \machine forbids it"
      $ do
        [refusals (quick "lki-fm") f | f <- [quarter, half, long]]
          `shouldBe` [[], ["motion"], ["motion"]]
        refusals (quick "lkp-01f") quarter `shouldBe` ["motion"]
  it
    "a gouge is found on either bounding path of an arc whose radii differ (catches a proof for \
    \one of them)"
    $ property $
      forAll (elements [Clockwise, CounterClockwise]) $ \sense ->
        forAll ((,) <$> arbitrary <*> elements [-2, -1, 1, 2]) $ \(atStart, d) ->
          let found = findingsBeside sense atStart d
           in (any isGouge found, any isExcess found) === (d == -2, d == 2)
  where
    uncut = quick "lki-u"
    own program = map Frame.frame (Frame.plannedFrames program)
    rounds = [(s, circle s) | s <- [LeftOf, RightOf]]
    circle s =
      let path =
            toolpathAround
              (if s == LeftOf then Vec.point 0 0 else Vec.point 60 0)
              (Mm 0.02)
              s
              ( Polyarc
                  Closed
                  ( Segment.fullCircle
                      CounterClockwise
                      (Circle (Vec.point 0 0) (Mm 20))
                      (Vec.point 20 0)
                      :| []
                  )
              )
       in (path, Arcs.quantise uncut path)
    isCircle f = increment f == 0
    -- Findings after a change of all frames, for both sides.
    changedBy change =
      [(s, findings uncut path program (change (own program))) | (s, (path, program)) <- rounds]
    mirrored f = case motion f of
      Circular t -> f {motion = Circular (if t == Clockwise then CounterClockwise else Clockwise)}
      _ -> f

-- | Machine by its name, with a deceleration so large that no frame has to brake.
quick :: Text -> Machine
quick name = m {Machine.braking = (Machine.braking m) {deceleration = 1e12}}
  where
    m = Machines.named name

findings :: Machine -> Toolpath -> FrameProgram -> [Frame] -> [Finding]
findings machine path program fs = Proof.findings (Verify.prove machine path program fs)

-- | Toolpath around a contour with a cutter of radius 5, from a point straight to its start.
toolpathAround :: Point -> Mm -> Side -> Polyarc -> Toolpath
toolpathAround from tolerance side polyarc = case Equidistant.equidistant side (Mm 5) polyarc of
  Right pieces
    | Just path <-
        Result.output
          ( Toolpath.toToolpath
              ( Generate.partOf
                  from
                  ( Part.Mill
                      ( Located
                          (Region 0 0)
                          (Generate.job Case {contour = polyarc, side, radius = Mm 5, pieces})
                            { Part.tolerance =
                                Part.OnPath tolerance
                            }
                      )
                  )
              )
          ) ->
      path
  _ -> error "no path"

-- | Laws of the flange on a machine: its own frames are proven, and damage is found.
flange :: Text -> Spec
flange name = describe (Text.unpack name) $ do
  it "its own frames are proven" $
    findings machine path' program (map Frame.frame (Frame.plannedFrames program)) `shouldBe` []
  it
    "every change that cuts too deep or leaves too much is found (catches an arc that is measured \
    \at its ends)"
    $ property $ withMaxSuccess 200 $ changed machine path' program contour 10
  where
    machine = quick name
    path' = path Flange.analysis
    program = Arcs.quantise machine path'
    contour =
      concat
        [ map Part.segment (NonEmpty.toList (Part.elements (Part.contour m)))
          | Toolpath.Cutting {Toolpath.job = Located _ m} <- Toolpath.blocks path'
        ]

-- | Law of a damaged tape: if samples show that it cuts too deep, there is a gouge; if they show
-- that it leaves too much, there is an excess.
changed :: Machine -> Toolpath -> FrameProgram -> [Segment] -> Double -> Property
changed machine path program contour radius =
  forAll (Arcs.change (map Frame.frame (Frame.plannedFrames program))) $ \(what, fs) ->
    let Deviation {deepestGouge, largestExcess} =
          Arcs.deviation machine (Frame.start program) fs contour radius
        found = findings machine path program fs
        gouges = deepestGouge > allowed + 0.001
        leaves = largestExcess > allowed + 0.001 + 0.01 / (2 * radius)
     in counterexample (show (deepestGouge, largestExcess, found)) $
          tabulate "change" [takeWhile (/= '(') what]
            . classify (not gouges && not leaves) "within"
            . classify (null found) "proven"
            $ (not gouges || any isGouge found) && (not leaves || any isExcess found)
  where
    allowed = 0.02 + (let Mm pulse = Machine.planeResolution machine in pulse)

-- | Arcs with a name and the reasons why a control refuses them.
arcs :: [(String, [String], Frame)]
arcs =
  [ ("a quarter", [], quarter),
    ("a half", [], half),
    ("three quarters", [], long),
    ("a full circle", [], quarter {increment = 0}),
    ("radii that differ by 2 pulses", [], quarter {increment = Pulses3 (-1000) 1002 0}),
    ("radii that differ by 3 pulses", ["radii"], quarter {increment = Pulses3 (-1000) 1003 0}),
    ("no centre", ["centre"], quarter {centre = 0}),
    ("no centre and no increment", ["centre"], quarter {centre = 0, increment = 0}),
    ("the end at the centre", ["sweep"], quarter {increment = Pulses3 (-1000) 0 0}),
    ("the end beyond the beginning", ["sweep"], quarter {increment = Pulses3 1 0 0}),
    ("an arc that rises", ["motion"], quarter {increment = Pulses3 (-1000) 1000 1}),
    ( "a straight frame that goes nowhere",
      ["motion"],
      quarter {motion = Linear, centre = 0, increment = 0}
    )
  ]

quarter, half, long :: Frame
quarter =
  Frame
    { motion = Circular CounterClockwise,
      increment = Pulses3 (-1000) 1000 0,
      turn = 0,
      centre = Pulses2 (-1000) 0,
      feedCode = FeedCode 1,
      braking = False,
      commands = []
    }
half = quarter {increment = Pulses3 (-2000) 0 0}
long = quarter {increment = Pulses3 (-1000) (-1000) 0}

-- | Reasons why a control refuses a frame, in one word each.
refusals :: Machine -> Frame -> [String]
refusals machine f =
  [ why r
    | Refused r <-
        findings
          machine
          ( Toolpath.Toolpath
              (Located (Region 0 0) (Part.SpacePoint (Vec.point 0 0) (Mm 0)))
              []
              False
              Toolpath.noSetup
              Millimetres
          )
          (Frame.FrameProgram 0 [])
          [f]
  ]
  where
    why r = case r of
      UnequalRadii _ _ -> "radii"
      NoSweep _ -> "sweep"
      ByRule (Frame.BadCentre _) -> "centre"
      ByRule (Frame.NoSuchMotion _) -> "motion"
      ByRule other -> show other
      NotCompensated _ -> "compensation"

-- | Findings for a cutter of radius 5 on an arc of radius 25, from one axis to the other, beside
-- the middle of an arc of radius 20. The start or the end of the arc is @d@ pulses too far out.
findingsBeside :: Sense -> Bool -> Int -> [Finding]
findingsBeside sense atStart d = findings machine path (Arcs.quantise machine path) [f]
  where
    machine = quick "lki-u"
    path =
      toolpathAround
        (Vec.point (fromIntegral sx * 0.02) (fromIntegral sy * 0.02))
        (Mm 0.001)
        RightOf
        (Polyarc Open (middle :| []))
    middle = Segment.arc CounterClockwise (Vec.point 0 0) (on (pi / 6)) (on (pi / 3))
    on a = Vec.shift (Vec.polar (Mm 20) (Rad a)) (Vec.point 0 0)
    off here = Pulses (1250 + if here then d else 0)
    ((sx, sy), (ex, ey)) = case sense of
      CounterClockwise -> ((off atStart, 0), (0, off (not atStart)))
      Clockwise -> ((0, off atStart), (off (not atStart), 0))
    f =
      Frame
        { motion = Circular sense,
          increment = Pulses3 (ex - sx) (ey - sy) 0,
          turn = 0,
          centre = Pulses2 (-sx) (-sy),
          feedCode = FeedCode 1,
          braking = False,
          commands = []
        }

isGouge, isExcess, isNotFollowed :: Finding -> Bool
isGouge f = case f of
  Gouge {} -> True
  _ -> False
isExcess f = case f of
  Excess {} -> True
  _ -> False
isNotFollowed f = case f of
  NotFollowed _ -> True
  _ -> False
