-- | The laws of arcs in whole pulses.
module Frame.ArcSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Feed (..), Mm (..), Pulses (..), Rad (..))
import Base.Region (Located (..), Region (Region))
import Control.Motion qualified as Control
import Data.ByteString qualified as ByteString
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
import Frame.Frame (Frame (increment), Planned (frame))
import Frame.Frame qualified as Frame
import Frame.Made qualified as Made
import Geometry.Carrier (Sense (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), BrakingForm (..), Machine)
import Machine.Machine qualified as Machine
import Machines qualified
import Part.Part qualified as Part
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "an arc" $ do
    it
      "keeps the machine's rules (catches a cut beside the axis, and a centre that does not fit \
      \its field)"
      $ property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) ->
          onArc m a $ \p -> Frame.invariants m (framesOf p) === []
    it
      "has frames within a pulse, along all of it (catches a centre that is merely rounded, and a \
      \sagitta that is added to the rounding of the ends)"
      $ property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          let Mm grain = Machine.pulse m
              path = Made.walked m p
              most = 1.01 * grain
           in counterexample (show (Made.worstOff [a] path, Made.worstOff path [a])) $
                Made.worstOff [a] path <= most .&&. (null path || Made.worstOff path [a] <= most)
    it
      "has frames within a pulse with the radius of either end (catches radii of which only one is \
      \right)"
      $ property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          let Mm grain = Machine.pulse m
              both =
                concatMap
                  (NonEmpty.toList . Control.between . Control.segment m)
                  (Control.run (Frame.start p) (framesOf p))
              off = maximum (0 : [offCircle a w | w@Arc {} <- both])
           in counterexample (show off) (off <= 1.01 * grain)
    it
      "keeps its sweep (catches an arc that rounding turns into nearly a full circle, or into \
      \nothing)"
      $ property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          let Mm grain = Machine.pulse m
              whole = sum [s | Arc {sweep = Rad s} <- Made.walked m p]
              Mm r = Segment.radius (centre a) (start a)
              Rad exact = sweep a
              straight = length (filter (not . Made.roundly) (framesOf p))
              -- A frame that is written straight turns by no more than half a pulse of sagitta
              -- does.
              rounds = length (filter Made.roundly (framesOf p))
              slack =
                fromIntegral (max 1 rounds) * 4 * grain / r
                  + fromIntegral straight * 4 * sqrt (grain / r)
           in r
                > 20
                  * grain
                    ==> counterexample
                      (show (whole, exact, straight))
                      (abs (whole - exact) <= slack)
    it "has increments of zero only as a full circle (catches a zero that means a full circle)" $
      property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          and [not (increment f == 0 && Made.roundly f) || start a == end a | f <- framesOf p]
            .&&. [f | f <- framesOf p, not (Made.roundly f), increment f == 0] === []
    it "ends at its rounded end (catches rounding errors of cuts that add up)" $
      property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          let Mm grain = Machine.pulse m
              at =
                Frame.position
                  m
                  (Frame.start p + sum (map (Frame.increment . Frame.frame) (Frame.planned p)))
           in counterexample
                (show (at, end a))
                ( max (abs (Vec.x at - Vec.x (end a))) (abs (Vec.y at - Vec.y (end a)))
                    <= grain / 2 + 1e-9
                )
    it
      "has radii at its ends that agree to two pulses (catches a centre beside the middle of the \
      \chord)"
      $ property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          let radiiOf f =
                let Pulses2 i j =
                      centre' f
                    Pulses3 x y _ = increment f
                 in (long (Pulses2 i j), long (Pulses2 (x - i) (y - j)))
              centre' = Frame.centre
              long (Pulses2 (Pulses x) (Pulses y)) = sqrt (fromIntegral (x * x + y * y)) :: Double
           in conjoin
                [ counterexample (show f) (abs (r - q) <= 2 + 1e-9)
                  | f <- framesOf p,
                    Made.roundly f,
                    let (r, q) = radiiOf f
                ]
    it "takes one frame where one is enough (catches needless cuts)" $
      property $
        forAll (ordinary (0.3, 6)) $ \a -> onArc (Machines.named "lki-u") a $ \p ->
          classify (length (framesOf p) == 1) "one" $
            length (framesOf p) <= (if alone (Machines.named "lki-u") a then 1 else 4)
    it
      "deviates no more than about any grid point beside its centre (catches a centre that is \
      \rejected too early)"
      $ property $
        forAll (ordinary (0.3, 6)) $ \a -> onArc (Machines.named "lki-u") a $ \p ->
          let m = Machines.named "lki-u"
              Mm grain = Machine.pulse m
           in case Made.walked m p of
                [w@Arc {}] ->
                  counterexample
                    (show (offEither a (centre w) w, offAbout 1 m a))
                    (all (>= offEither a (centre w) w - 0.02 * grain) (offAbout 1 m a))
                _ -> property True
    it
      "takes about one frame for each quadrant on a machine with quadrants (catches an extra frame \
      \for a rounding remainder at an axis)"
      $ property $
        checkCoverage $
          forAll quarters $ \(a, n) -> onArc (Machines.named "lki-fm") a $ \p ->
            cover 90 (length (framesOf p) == n) "as many as quadrants" $
              length (framesOf p) <= 2 * n
    it "becomes chords where its centre does not fit (catches a centre cut off to its digits)" $
      do
        let far =
              Arc
                { start = at 3e4 0,
                  end = at 3e4 5e-3,
                  centre = Vec.point (-3e4) 0,
                  sweep = Rad 5e-3
                }
            at r t = Vec.point (r * cos t - 3e4) (r * sin t)
        fmap Made.arcsIn (Made.program (Machines.named "lki-u") (Made.along feed [far]))
          `shouldBe` Just 0
  describe "a full circle" $ do
    it "is one frame where the machine has full circles, else halves or quadrants" $
      [ length
          ( maybe
              []
              framesOf
              ( Made.program
                  (bare (Machines.named m))
                  (Made.along feed [circle (Vec.point 12.003 4.001) 7.0071])
              )
          )
        | m <- ["lki-u", "lki-un", "n55", "iso6983", "lki-fm"]
      ]
        `shouldBe` [1, 1, 1, 2, 4]
    it
      "with radius and centre off the grid has frames within a pulse (catches a radius of whole \
      \pulses)"
      $ property $
        forAllShow
          ((,) <$> machine <*> ((,,) <$> offGrid <*> offGrid <*> choose (0.5, 80)))
          (const "")
          $ \(m, (x, y, r)) ->
            onArc m (circle (Vec.point x y) r) $ \p ->
              let Mm grain = Machine.pulse m
               in Frame.invariants m (framesOf p)
                    === [] .&&. Made.worstOff (Made.walked m p) [circle (Vec.point x y) r]
                      <= 1.01 * grain
  describe "the flange" $
    it "has twelve arcs along its contour, eighteen on a machine with quadrants" $ do
      text <- Encoding.decodeUtf8 <$> ByteString.readFile "examples/flange.part"
      [cuts machine' text | machine' <- ["lki-u", "lki-fm"]] `shouldBe` [Just 12, Just 18]
  where
    cuts :: Text -> Text -> Maybe Int
    cuts m text =
      fmap
        ( \p ->
            length
              [() | f <- Frame.planned p, Frame.role f == Frame.Cutting 0, Made.roundly (frame f)]
        )
        (Made.program (Machines.named m) (Made.pathOf text))

onArc :: Testable t => Machine -> Segment -> (Frame.FrameProgram -> t) -> Property
onArc m a law =
  counterexample (show (Machine.name m, a)) $ case Made.program (bare m) (Made.along feed [a]) of
    Nothing ->
      counterexample ("no frames: " <> show (Made.made (bare m) (Made.along feed [a]))) False
    Just p -> counterexample (show (take 12 (framesOf p))) (law p)

-- | A machine that neither brakes nor ends programs.
bare :: Machine -> Machine
bare m =
  m
    { Machine.braking = (Machine.braking m) {Machine.brakingForm = ByControl},
      Machine.orders = (Machine.orders m) {Machine.finish = []}
    }

framesOf :: Frame.FrameProgram -> [Frame]
framesOf = map frame . Frame.planned

feed :: Part.Pace
feed = Part.At (Located (Region 0 0) (Feed 60))

-- | The machines that walk arcs.
machine :: Gen Machine
machine = elements [m | m <- Machines.known, Machine.arcs m /= NoArcs]

-- | How far another arc is from the circle of one, at most.
offCircle :: Segment -> Segment -> Double
offCircle a w =
  maximum
    [ abs (d - r)
      | k <- [0 .. 96 :: Int],
        let Mm d = Vec.distance (centre a) (Segment.at (fromIntegral k / 96) w)
    ]
  where
    Mm r = Segment.radius (centre a) (start a)

-- | Whether some lattice point near the centre of an arc gives one frame that stays well within a
-- pulse.
alone :: Machine -> Segment -> Bool
alone m a = any (<= 0.98 * grain) (offAbout 3 m a)
  where
    Mm grain = Machine.pulse m

-- | How far frames about lattice points are off in mm, so many pulses from the centre of an arc at
-- most, that stay well within a pulse with the radius of either end and turn by what the arc turns,
-- as far as one frame may.
offAbout :: Double -> Machine -> Segment -> [Double]
offAbout most m a =
  [ offEither a c w
    | di <- [-most .. most],
      dj <- [-most .. most],
      let c = on (Vec.shift (Vec.vec (di * grain) (dj * grain)) (Segment.centre a)),
      let w =
            Segment.arc
              (if sweep a > Rad 0 then CounterClockwise else Clockwise)
              c
              (on (start a))
              (on (end a)),
      maximum (map (offCircle a) [turned c w, other c w]) <= 0.98 * grain,
      abs (away c (end w) - away c (start w)) <= 2 * grain,
      let (Rad s, Rad exact) =
            (sweep w, sweep a)
       in abs (s - exact) <= 4 * grain / away (Segment.centre a) (start a)
  ]
  where
    Mm grain = Machine.pulse m
    on p = Vec.point (nearest (Vec.x p)) (nearest (Vec.y p))
    nearest x = grain * fromIntegral (floor (x / grain + 0.5) :: Int)
    -- With the radius of the end all the way.
    other c w =
      let k =
            away c (end w) / away c (start w)
          scaled p = Vec.shift (Vec.scale k (Vec.to c p)) c
       in w {start = scaled (start w), end = scaled (end (turned c w))}

-- | With the radius of its beginning all the way, or going evenly to that of its end.
offEither :: Segment -> Point -> Segment -> Double
offEither a c w = max (offCircle a (turned c w)) (evenly a c w)

-- | How far an arc about a point is off another one at most, when its radius changes evenly from
-- the beginning to the end.
evenly :: Segment -> Point -> Segment -> Double
evenly a c w =
  maximum
    [ abs (away (Segment.centre a) p - away (Segment.centre a) (start a))
      | k <- [0 .. 24 :: Int],
        let t = fromIntegral k / 24,
        let r = away c (start w),
        let p =
              Vec.shift
                ( Vec.scale
                    (1 + t * (away c (end w) - r) / r)
                    (Vec.to c (Segment.at t (turned c w)))
                )
                c
    ]

-- | With the radius of the beginning all the way.
turned :: Point -> Segment -> Segment
turned c w =
  let r =
        away c (start w)
   in w {end = Vec.shift (Vec.scale (r / away c (end w)) (Vec.to c (end w))) c}

away :: Point -> Point -> Double
away p q = let Mm d = Vec.distance p q in d

circle :: Point -> Double -> Segment
circle c r =
  let a = Vec.shift (Vec.vec r 0) c in Arc {start = a, end = a, centre = c, sweep = Rad (2 * pi)}

-- | Arcs of all sizes: from a hundredth of a millimetre to a metre, now and then nearly circles,
-- nearly nothing, with ends and centres on the axes and on the grid.
arc :: Gen Segment
arc = do
  r <- oneof [(10 **) <$> choose (-2, 3), fromIntegral <$> choose (1, 60 :: Int)]
  s <-
    frequency
      [ (6, choose (0.001, 2 * pi)),
        (1, pure (2 * pi)),
        (1, (\d -> 2 * pi - d / r) <$> choose (0.0001, 0.1)),
        (1, (\d -> min 6 (d / r)) <$> choose (0.0001, 0.3)),
        (2, elements [pi / 2, pi, 3 * pi / 2])
      ]
  a <- oneof [choose (-4, 4), elements [0, pi / 2, pi, -pi / 2]]
  x <- oneof [offGrid, pure 0]
  y <- oneof [offGrid, pure 0]
  sign <- elements [1, -1]
  pure (arcAt (Vec.point x y) r a (sign * s))

arcAt :: Point -> Double -> Double -> Double -> Segment
arcAt c r a s
  | abs s >= 2 * pi = Arc {start = at a, end = at a, centre = c, sweep = Rad s}
  | otherwise = Arc {start = at a, end = at (a + s), centre = c, sweep = Rad s}
  where
    at t = Vec.shift (Vec.polar (Mm r) (Rad t)) c

ordinary :: (Double, Double) -> Gen Segment
ordinary sweeps = do
  r <- choose (2, 300)
  s <- choose sweeps
  arcAt <$> (Vec.point <$> offGrid <*> offGrid) <*> pure r <*> choose (-4, 4) <*> elements [s, -s]

-- | Arcs that begin and end well within quadrants or on the axes, with the number of quadrants.
quarters :: Gen (Segment, Int)
quarters = do
  r <- choose (2, 300)
  n <- choose (1, 4 :: Int)
  skipped <- oneof [pure 0, choose (0.3, 0.8)]
  behind <- oneof [pure 0, choose (0.3, 0.7)]
  from <- elements [0, pi / 2, pi, -pi / 2]
  way <- elements [1, -1]
  c <- Vec.point <$> offGrid <*> offGrid
  let s = fromIntegral n * pi / 2 - skipped - behind
  pure $
    if n == 1 && s <= 0.1
      then (arcAt c r from (way * pi / 2), 1)
      else (arcAt c r (from + way * skipped) (way * s), n)

offGrid :: Gen Double
offGrid = choose (-100, 100)
