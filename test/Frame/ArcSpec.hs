-- | Laws of arcs in whole pulses.
module Frame.ArcSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Feed (..), Mm (..), Pulses (..), Rad (..))
import Base.Region (Located (..), Region (Region))
import Control.Motion qualified as Control
import Data.ByteString qualified as ByteString
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
import Frame.Frame (Frame (increment), PlannedFrame (frame))
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
import Part.CutFeed (CutFeed (..))
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
          onArc m a $ \p -> Frame.violations m (framesOf p) === []
    it
      "has frames within a pulse, along all of it (catches a centre that is merely rounded, and a \
      \sagitta that is added to the rounding of the ends)"
      $ property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          let Mm pulse = Machine.planeResolution m
              path = Made.frameSegments m p
              most = 1.01 * pulse
           in counterexample (show (Made.largestDistance [a] path, Made.largestDistance path [a])) $
                Made.largestDistance [a] path
                  <= most .&&. (null path || Made.largestDistance path [a] <= most)
    it
      "has frames within a pulse with the radius of either end (catches radii of which only one is \
      \right)"
      $ property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          let Mm pulse = Machine.planeResolution m
              both =
                concatMap
                  (NonEmpty.toList . Control.boundingPaths . Control.segment m)
                  (Control.run (Frame.start p) (framesOf p))
              off = maximum (0 : [circleError a w | w@Arc {} <- both])
           in counterexample (show off) (off <= 1.01 * pulse)
    it
      "keeps its sweep (catches an arc that rounding turns into nearly a full circle, or into \
      \nothing)"
      $ property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          let Mm pulse = Machine.planeResolution m
              whole = sum [s | Arc {sweep = Rad s} <- Made.frameSegments m p]
              Mm r = Segment.radius (centre a) (start a)
              Rad exact = sweep a
              straight = length (filter (not . Made.isArc) (framesOf p))
              -- A straight frame stands for a sweep with a sagitta of at most half a pulse.
              rounds = length (filter Made.isArc (framesOf p))
              slack =
                fromIntegral (max 1 rounds) * 4 * pulse / r
                  + fromIntegral straight * 4 * sqrt (pulse / r)
           in r
                > 20
                  * pulse
                    ==> counterexample
                      (show (whole, exact, straight))
                      (abs (whole - exact) <= slack)
    it "has increments of zero only as a full circle (catches a zero that means a full circle)" $
      property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          and [not (increment f == 0 && Made.isArc f) || start a == end a | f <- framesOf p]
            .&&. [f | f <- framesOf p, not (Made.isArc f), increment f == 0] === []
    it "ends at its rounded end (catches rounding errors of cuts that add up)" $
      property $
        forAllShow ((,) <$> machine <*> arc) (const "") $ \(m, a) -> onArc m a $ \p ->
          let Mm pulse = Machine.planeResolution m
              at =
                Frame.position
                  m
                  ( Frame.start p
                      + sum (map (Frame.increment . Frame.frame) (Frame.plannedFrames p))
                  )
           in counterexample
                (show (at, end a))
                ( max (abs (Vec.x at - Vec.x (end a))) (abs (Vec.y at - Vec.y (end a)))
                    <= pulse / 2 + 1e-9
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
                    Made.isArc f,
                    let (r, q) = radiiOf f
                ]
    it "takes one frame where one is enough (catches needless cuts)" $
      property $
        forAll (ordinaryArc (0.3, 6)) $ \a -> onArc (Machines.named "lki-u") a $ \p ->
          classify (length (framesOf p) == 1) "one" $
            length (framesOf p) <= (if fitsOneFrame (Machines.named "lki-u") a then 1 else 4)
    it
      "deviates no more than about any grid point beside its centre (catches a centre that is \
      \rejected too early)"
      $ property $
        forAll (ordinaryArc (0.3, 6)) $ \a -> onArc (Machines.named "lki-u") a $ \p ->
          let m = Machines.named "lki-u"
              Mm pulse = Machine.planeResolution m
           in case Made.frameSegments m p of
                [w@Arc {}] ->
                  counterexample
                    (show (arcError a (centre w) w, errorsAbout 1 m a))
                    (all (>= arcError a (centre w) w - 0.02 * pulse) (errorsAbout 1 m a))
                _ -> property True
    it
      "takes about one frame for each quadrant on a machine with quadrants (catches an extra frame \
      \for a rounding remainder at an axis)"
      $ property $
        checkCoverage $
          forAll arcWithQuadrants $ \(a, n) -> onArc (Machines.named "lki-fm") a $ \p ->
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
        fmap Made.arcCount (Made.program (Machines.named "lki-u") (Made.pathAlong feed [far]))
          `shouldBe` Just 0
  describe "a full circle" $ do
    it "is one frame where the machine has full circles, else halves or quadrants" $
      [ length
          ( maybe
              []
              framesOf
              ( Made.program
                  (withFramesOnly (Machines.named m))
                  (Made.pathAlong feed [circle (Vec.point 12.003 4.001) 7.0071])
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
              let Mm pulse = Machine.planeResolution m
               in Frame.violations m (framesOf p)
                    === []
                      .&&. Made.largestDistance (Made.frameSegments m p) [circle (Vec.point x y) r]
                      <= 1.01 * pulse
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
              [ ()
                | f <- Frame.plannedFrames p,
                  Frame.role f == Frame.Cutting 0,
                  Made.isArc (frame f)
              ]
        )
        (Made.program (Machines.named m) (Made.pathOf text))

onArc :: Testable t => Machine -> Segment -> (Frame.FrameProgram -> t) -> Property
onArc m a law =
  counterexample (show (Machine.name m, a)) $
    case Made.program (withFramesOnly m) (Made.pathAlong feed [a]) of
      Nothing ->
        counterexample
          ("no frames: " <> show (Made.quantised (withFramesOnly m) (Made.pathAlong feed [a])))
          False
      Just p -> counterexample (show (take 12 (framesOf p))) (law p)

-- | Machine without braking frames and without frames at the end of a program.
withFramesOnly :: Machine -> Machine
withFramesOnly m =
  m
    { Machine.braking = (Machine.braking m) {Machine.brakingForm = ByControl},
      Machine.commandWords = (Machine.commandWords m) {Machine.finish = []}
    }

framesOf :: Frame.FrameProgram -> [Frame]
framesOf = map frame . Frame.plannedFrames

feed :: Part.Pace
feed = Part.At (Located (Region 0 0) (PerMinute (Feed 60)))

-- | Machines with circular interpolation.
machine :: Gen Machine
machine = elements [m | m <- Machines.known, Machine.arcs m /= NoArcs]

-- | Largest distance in mm of the second arc from the circle of the first.
circleError :: Segment -> Segment -> Double
circleError a w =
  maximum
    [ abs (d - r)
      | k <- [0 .. 96 :: Int],
        let Mm d = Vec.distance (centre a) (Segment.at (fromIntegral k / 96) w)
    ]
  where
    Mm r = Segment.radius (centre a) (start a)

-- | True if some grid point near the centre of an arc gives one frame well within a pulse.
fitsOneFrame :: Machine -> Segment -> Bool
fitsOneFrame m a = any (<= 0.98 * pulse) (errorsAbout 3 m a)
  where
    Mm pulse = Machine.planeResolution m

-- | Deviations in mm of one frame for an arc, about each grid point up to @most@ pulses from its
-- centre. Only those are listed that stay well within a pulse with the radius of either end, whose
-- radii differ by at most two pulses, and that keep the sweep of the arc.
errorsAbout :: Double -> Machine -> Segment -> [Double]
errorsAbout most m a =
  [ arcError a c w
    | di <- [-most .. most],
      dj <- [-most .. most],
      let c = on (Vec.shift (Vec.vec (di * pulse) (dj * pulse)) (Segment.centre a)),
      let w =
            Segment.arc
              (if sweep a > Rad 0 then CounterClockwise else Clockwise)
              c
              (on (start a))
              (on (end a)),
      maximum (map (circleError a) [withStartRadius c w, withEndRadius c w]) <= 0.98 * pulse,
      abs (distance c (end w) - distance c (start w)) <= 2 * pulse,
      let (Rad s, Rad exact) =
            (sweep w, sweep a)
       in abs (s - exact) <= 4 * pulse / distance (Segment.centre a) (start a)
  ]
  where
    Mm pulse = Machine.planeResolution m
    on p = Vec.point (nearest (Vec.x p)) (nearest (Vec.y p))
    nearest x = pulse * fromIntegral (floor (x / pulse + 0.5) :: Int)
    -- The arc with the radius of its end throughout.
    withEndRadius c w =
      let k =
            distance c (end w) / distance c (start w)
          scaled p = Vec.shift (Vec.scale k (Vec.to c p)) c
       in w {start = scaled (start w), end = scaled (end (withStartRadius c w))}

-- | Largest deviation in mm of an arc about the point @c@, with the radius of its beginning or with
-- a linear change to that of its end.
arcError :: Segment -> Point -> Segment -> Double
arcError a c w = max (circleError a (withStartRadius c w)) (linearError a c w)

-- | Largest deviation in mm of an arc about the point @c@ whose radius changes linearly from its
-- beginning to its end.
linearError :: Segment -> Point -> Segment -> Double
linearError a c w =
  maximum
    [ abs (distance (Segment.centre a) p - distance (Segment.centre a) (start a))
      | k <- [0 .. 24 :: Int],
        let t = fromIntegral k / 24,
        let r = distance c (start w),
        let p =
              Vec.shift
                ( Vec.scale
                    (1 + t * (distance c (end w) - r) / r)
                    (Vec.to c (Segment.at t (withStartRadius c w)))
                )
                c
    ]

-- | Arc with the radius of its beginning throughout.
withStartRadius :: Point -> Segment -> Segment
withStartRadius c w =
  let r =
        distance c (start w)
   in w {end = Vec.shift (Vec.scale (r / distance c (end w)) (Vec.to c (end w))) c}

distance :: Point -> Point -> Double
distance p q = let Mm d = Vec.distance p q in d

circle :: Point -> Double -> Segment
circle c r =
  let a = Vec.shift (Vec.vec r 0) c in Arc {start = a, end = a, centre = c, sweep = Rad (2 * pi)}

-- | Arcs of all sizes, with radii from a hundredth of a millimetre to a metre. Some are nearly full
-- circles, some nearly points; some have ends and centres on the axes or on the grid.
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

ordinaryArc :: (Double, Double) -> Gen Segment
ordinaryArc sweeps = do
  r <- choose (2, 300)
  s <- choose sweeps
  arcAt <$> (Vec.point <$> offGrid <*> offGrid) <*> pure r <*> choose (-4, 4) <*> elements [s, -s]

-- | Arcs that begin and end on the axes or well within quadrants, with the number of quadrants.
arcWithQuadrants :: Gen (Segment, Int)
arcWithQuadrants = do
  r <- choose (2, 300)
  n <- choose (1, 4 :: Int)
  leftOut <- oneof [pure 0, choose (0.3, 0.8)]
  leftOutAtEnd <- oneof [pure 0, choose (0.3, 0.7)]
  from <- elements [0, pi / 2, pi, -pi / 2]
  sign <- elements [1, -1]
  c <- Vec.point <$> offGrid <*> offGrid
  let s = fromIntegral n * pi / 2 - leftOut - leftOutAtEnd
  pure $
    if n == 1 && s <= 0.1
      then (arcAt c r from (sign * pi / 2), 1)
      else (arcAt c r (from + sign * leftOut) (sign * s), n)

offGrid :: Gen Double
offGrid = choose (-100, 100)
