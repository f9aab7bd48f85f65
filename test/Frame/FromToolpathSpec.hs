-- | Laws of frames.
module Frame.FromToolpathSpec (spec) where

import Base.Quantity (Feed (..), LengthUnit (..), Mm (..), Rad (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Error qualified as Error
import Frame.Frame (Frame (increment), PlannedFrame (frame))
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Frame.Made qualified as Made
import Generate qualified
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Machines qualified
import Part.CutFeed (CutFeed (..))
import Part.Part qualified as Part
import Report.Report (ReportCode (..))
import Report.Report qualified as Report
import Test.Hspec
import Test.QuickCheck
import Toolpath.FromPart qualified as FromPart
import Toolpath.Toolpath (Move (segment), Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromTape qualified as Verify
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  describe "chords" $ do
    it
      "stay within the sagitta of their arc in both directions (catches the radius of the part in \
      \the step's formula)"
      $ property $
        forAll ((,) <$> arc <*> sagitta) $ \(a, y) ->
          let chords = chordsOf y a
              furthest c =
                maximum
                  [ d
                    | k <- [0 .. 20 :: Int],
                      let Mm d = Distance.toPoint (Segment.at (fromIntegral k / 20) c) a
                  ]
              missed = Distance.uncovered (Mm (y + 1e-9)) chords a
           in counterexample
                (show (map furthest chords))
                (all ((<= y + 1e-9) . furthest) chords && null missed)
    it
      "are as few as the sagitta allows, up to a quarter turn each and no shorter than a pulse \
      \(catches a wasteful step)"
      $ property $
        forAll ((,) <$> arc <*> sagitta) $ \(a, y) ->
          let n = FromToolpath.chordCount lkp01f (Mm y) a
              Mm r = Segment.radius (centre a) (start a)
              Rad s = sweep a
              sag k = r * (1 - cos (abs s / fromIntegral k / 2))
           in n
                > 1
                  ==> counterexample
                    (show n)
                    (sag (n - 1) > y - 1e-9 || abs s / fromIntegral (n - 1) > pi / 2 - 1e-9)
    it
      "in a band stay within it, and end where the arc ends (catches the edges of the band \
      \exchanged)"
      $ property $
        forAll ((,,) <$> arc <*> sagitta <*> sagitta) $ \(a, toward, away) ->
          forAll (elements [(toward, away), (0, away), (toward, 0)]) $ \(i, o) ->
            let ends = FromToolpath.bandChords lkp01f (Mm i) (Mm o) a
                Mm r = Segment.radius (centre a) (start a)
                radii =
                  [ d
                    | (p, q) <- zip (start a : ends) ends,
                      k <- [0 .. 40 :: Int],
                      let Mm d = Vec.distance (centre a) (Vec.interpolate (fromIntegral k / 40) p q)
                  ]
             in -- A step of a pulse is taken also where it leaves the band.
                (r + o) * cos (asin (min 1 (0.02 / (2 * r))))
                  >= r
                    - i
                      ==> counterexample
                        (show (r, minimum radii, maximum radii))
                        ( minimum radii >= r - i - 1e-9
                            && maximum radii <= r + o + 1e-9
                            && last ends == end a
                        )
    it "in a band are fewer than on the arc alone (catches corners that stay on the arc)" $
      property $
        forAll ((,) <$> arc <*> choose (0.02, 0.1)) $ \(a, y) ->
          let n = FromToolpath.chordCount lkp01f (Mm y) a
           in n >= 8
                && y
                  < 0.05
                    * (let Mm r = Segment.radius (centre a) (start a) in r)
                      ==> length (FromToolpath.bandChords lkp01f (Mm y) (Mm y) a)
                  < n
    it "of arc 1–2 of the Ural paper are nine" $
      FromToolpath.chordCount
        lkp01f
        (Mm 0.02)
        ( Segment.Arc
            (Vec.point 18 0)
            (Vec.point (18 * cos 0.7982) (18 * sin 0.7982))
            (Vec.point 0 0)
            (Rad 0.7982)
        )
        `shouldBe` 9
    it "are no shorter for a tolerance of 0 than rounding requires (catches chords of one pulse)" $
      do
        let quarterArc =
              Segment.Arc (Vec.point 50 0) (Vec.point 0 50) (Vec.point 0 0) (Rad (pi / 2))
            quarter =
              fmap
                (length . Frame.plannedFrames)
                ( Made.program
                    lkp01f
                    ( Made.pathAlong
                        (Part.At (Located (Region 0 0) (PerMinute (Feed 60))))
                        [quarterArc]
                    )
                )
        quarter `shouldSatisfy` maybe False (< 60)
  describe "tapes" $
    it "are proven for every tolerance (catches an error beyond the tolerance and a pulse)" $
      property $
        forAllBlind machine $ \m ->
          forAll (oneof [Generate.closedCase, Generate.openCase]) $ \c -> forAll accuracy $ \a ->
            case Result.output
              ( FromPart.toToolpath
                  ( Generate.partOf
                      (Generate.begin c)
                      (Part.Mill (Located (Region 0 0) (Generate.job c) {Part.tolerance = a}))
                  )
              ) of
              Nothing -> counterexample "no path" False
              Just path -> case Made.program m path of
                -- The tolerance is too large for the cutter.
                Nothing -> label "none" True
                Just p ->
                  Proof.findings (Verify.prove m path p (map frame (Frame.plannedFrames p))) === []
  describe "increments" $ do
    it "of a closed contour add to zero (catches rounded increments instead of rounded positions)" $
      property $
        forAllBlind machine $ \m ->
          forAll Generate.closedCase $ \c -> onPath m (Generate.milled (Mm 0.02) c) $ \_ program ->
            sum
              [ increment (frame p)
                | p <- Frame.plannedFrames program,
                  Frame.role p == Frame.Cutting 0
              ]
              === 0
    it "lead to within half a pulse of every node (catches rounding errors that add up)" $
      property $
        forAllBlind machine $ \m ->
          forAll Generate.openCase $ \c -> onPath m (Generate.milled (Mm 0.02) c) $ \path program ->
            let positions =
                  map
                    (Frame.position m)
                    ( scanl
                        (+)
                        (Frame.start program)
                        (map (increment . frame) (Frame.plannedFrames program))
                    )
                Mm pulse = Machine.planeResolution m
                distanceTo n =
                  minimum [max (abs (Vec.x n - Vec.x p)) (abs (Vec.y n - Vec.y p)) | p <- positions]
             in conjoin
                  [ counterexample (show (n, distanceTo n)) (distanceTo n <= pulse / 2 + 1e-9)
                    | n <- Made.nodesOf path
                  ]
    it "keep the machine's invariants (catches a move that does not fit its field)" $
      property $
        forAll (choose (-3e4, 3e4)) $ \x -> forAll (choose (-3e4, 3e4)) $ \y ->
          let frames = longMove x y
           in Frame.violations lkp01f frames
                === []
                  .&&. counterexample
                    (show (length frames))
                    (length frames <= 1 + ceiling (max (abs x) (abs y) / 199.98 :: Double))
  describe "frames" $ do
    it
      "keep the machine's invariants on every machine (catches a frame that its machine cannot run)"
      $ property $
        forAllBlind machine $ \m ->
          forAll anyCase $ \c ->
            forAllBlind Generate.settings $ \set ->
              case Result.output
                ( FromPart.toToolpath
                    ( Generate.partOf
                        (Vec.point (-200) 0)
                        (Part.Mill (Located (Region 0 0) (set (Generate.job c))))
                    )
                ) of
                Nothing -> property Discard
                Just path ->
                  onPath m (Just path) $ \_ program ->
                    Frame.violations m (map frame (Frame.plannedFrames program)) === []
    it
      "stay within the tolerance and a pulse of the toolpath, along all of it (catches a chord on \
      \the wrong side, a lost part)"
      $ property $
        forAllBlind machine $ \m ->
          forAll anyCase $ \c ->
            forAll
              ( elements
                  [ y
                    | let Mm pulse = Machine.planeResolution m,
                      y <- [0.005, 0.02, 0.1],
                      y + pulse < Generate.radiusOf c
                  ]
              )
              $ \y ->
                onPath m (Generate.milled (Mm y) c) $ \path program ->
                  let exact = concatMap (map segment . Toolpath.moves) (Toolpath.blocks path)
                      actual = filter (\s -> Segment.length s > Mm 0) (Made.frameSegments m program)
                      Mm pulse = Machine.planeResolution m
                   in counterexample
                        ( show
                            (Made.largestDistance exact actual, Made.largestDistance actual exact)
                        )
                        $ Made.largestDistance exact actual
                          <= y + pulse .&&. Made.largestDistance actual exact
                          <= y + pulse
    it
      "along an axis that the machine does not have are refused (catches a division by its digits)"
      $ [errorsOn (Machines.named m) upAndDown | m <- ["kontur-2p", "kontur-3p"]]
        `shouldBe` [["E0507"], []]
    it "beyond the field of a position are refused (catches a position cut off to its digits)" $
      errorsOn short (Generate.straightPath 150 0) `shouldBe` ["E0508"]
    it "of too many contours are refused (catches a limit that is ignored)" $
      [errorsOn (Machines.named "lki-u") (contoursOf n) | n <- [30, 31]] `shouldBe` [[], ["E0506"]]
  where
    anyCase = oneof [Generate.openCase, Generate.closedCase, Generate.smoothCase]
    short =
      let m =
            Machines.named "iso6983"
       in m
            { Machine.layout =
                (Machine.layout m)
                  { Machine.items =
                      fmap fiveDigits (Machine.items (Machine.layout m))
                  }
            }
    fiveDigits i = case i of
      Machine.AWord w
        | Machine.Along _ <- Machine.content w ->
          Machine.AWord w {Machine.form = (Machine.form w) {Machine.digits = 5}}
      _ -> i
    upAndDown =
      let down =
            Toolpath.Move
              (Straight (Vec.point 0 0) (Vec.point 0 0))
              ( Toolpath.Manner
                  (Mm 0, Mm (-1))
                  (Part.At (Located (Region 0 0) (PerMinute (Feed 60))))
                  False
              )
              (Region 0 0)
              False
       in Toolpath.Toolpath
            (Located (Region 0 0) (Part.SpacePoint (Vec.point 0 0) (Mm 0)))
            [Toolpath.Travelling (Mm 0) [] [down]]
            False
            Toolpath.noSetup
            Millimetres

-- | Toolpath along @n@ contours.
contoursOf :: Int -> Toolpath
contoursOf n =
  Made.pathOf
    ( Text.unlines
        ( [ "part p",
            "tool mill(diameter 4 mm)",
            "feed 60 mm/min",
            "tolerance 0.02 mm",
            "from (-10, 0)"
          ]
            <> concat
              [ [ "contour c" <> k <> " open { (" <> k <> ", 0) (" <> k <> ", 9) }",
                  "mill c" <> k <> " left { }"
                ]
                | i <- [1 .. n],
                  let k = Text.pack (show (20 * i))
              ]
        )
    )

errorsOn :: Machine -> Toolpath -> [Text]
errorsOn m path =
  [ c
    | ReportCode c <-
        map
          (Report.code . Error.toReport Millimetres m)
          (Result.errors (Made.quantised m path))
  ]

machine :: Gen Machine
machine = elements Machines.known

-- | Law of the frames of a toolpath on a machine.
onPath ::
  Testable t =>
  Machine ->
  Maybe Toolpath ->
  (Toolpath -> Frame.FrameProgram -> t) ->
  Property
onPath m found law = counterexample (show (Machine.name m)) $ case found of
  Nothing -> counterexample "no path" False
  Just path -> case Made.program m path of
    Nothing -> counterexample ("no frames: " <> show (Result.errors (Made.quantised m path))) False
    Just program -> property (law path program)

lkp01f :: Machine
lkp01f = Machines.named "lkp-01f"

chordsOf :: Double -> Segment -> [Segment]
chordsOf y a =
  let ends = start a : FromToolpath.chords lkp01f (Mm y) a in zipWith Straight ends (drop 1 ends)

-- | Arcs with radii from a hundredth of a millimetre to ten metres.
arc :: Gen Segment
arc = do
  r <- (10 **) <$> choose (-2, 4)
  a <- choose (-4, 4)
  s <- choose (0.001, 2 * pi)
  sign <- elements [1, -1]
  let at t = Vec.point (r * cos t) (r * sin t)
  pure (Arc (at a) (at (a + sign * s)) (Vec.point 0 0) (Rad (sign * s)))

accuracy :: Gen Part.Accuracy
accuracy =
  elements
    ( [Part.OnPath (Mm y) | y <- [0, 0.001, 0.005, 0.02, 0.1]]
        <> [Part.Band (Mm 0) (Mm 0.05), Part.Band (Mm 0.05) (Mm 0)]
    )

sagitta :: Gen Double
sagitta = elements [0.005, 0.02, 0.1, 1]

longMove :: Double -> Double -> [Frame]
longMove x y =
  maybe
    []
    (map frame . Frame.plannedFrames)
    (Result.output (FromToolpath.quantise lkp01f (Generate.straightPath x y)))
