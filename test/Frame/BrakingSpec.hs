-- | Laws of braking, compared with sums over the frames and over the toolpath.
module Frame.BrakingSpec (spec) where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Feed (..), LengthUnit (..), Mm (..), Rad (..))
import Base.Region (Located (..), Region (Region))
import Frame.FeedCode qualified as FeedCode
import Frame.Frame (Frame (..), PlannedFrame (frame))
import Frame.Frame qualified as Frame
import Frame.Made qualified as Made
import Geometry.Carrier (Sense (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Machines qualified
import Part.CutFeed (CutFeed (..))
import Part.Part (Pace (..), SpacePoint (SpacePoint))
import Test.Hspec
import Test.QuickCheck
import Toolpath.Toolpath (Block (..), Manner (Manner), Move (Move), Toolpath (Toolpath))
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec = do
  describe "a machine with braking frames" $ do
    it
      "is never too fast to reach a lower feed in time (catches a braking section that does not \
      \reach back over a short move)"
      $ property $
        forAll moves $ \ms -> onMachine ms $ \m fs ->
          let pulse = let Mm g = Machine.planeResolution m in g
              lengths = map fst fs
              -- Lower feeds after a frame with the distance to them; the last one is the end of the
              -- program.
              ahead k =
                [ (v, sum (take (j - k - 1) (drop (k + 1) lengths)), j - k)
                  | (j, (_, Just v)) <- drop (k + 1) (zip [0 ..] fs)
                ]
                  <> [(10 / 60, sum (drop (k + 1) lengths), length fs - k)]
              broken =
                [ (k, v, v2, s)
                  | (k, (_, Just v)) <- zip [0 ..] fs,
                    (v2, s, n) <- ahead k,
                    v * v > v2 * v2 + 2 * 5 * (s + pulse * fromIntegral (n + 2))
                ]
           in counterexample (show fs) (broken === [])
    it
      "slows down where it has to, and nowhere else (catches a section of the length v²/2a before \
      \every feed)"
      $ property $
        forAll moves $ \ms -> onMachine ms $ \m fs ->
          let pulse = let Mm g = Machine.planeResolution m in g
              slowing = sum [l | (l, Nothing) <- fs]
              needed = neededLength m ms
           in counterexample
                (show (fs, slowing, needed))
                ( abs (slowing - needed)
                    <= pulse * fromIntegral (3 * length ms + length fs)
                      + 0.02 * fromIntegral (length ms)
                )
    it
      "is at the braking feed after an element that asks for it (catches a slow end without effect)"
      $ do
        let ms = [to 0 60 (At (here 1000)) True, to 60 120 (At (here 1000)) False]
        fmap (map brief) (framesFor (Machines.named "lki-u") ms)
          `shouldBe` Just [(1611, 40, False), (1389, 0, True), (1611, 40, False), (1389, 0, True)]
    it "leaves out a section shorter than a pulse" $ do
      let ms = [to 0 50 (At (here 25.2)) False]
      fmap (map brief) (framesFor (Machines.named "lki-u") ms) `shouldBe` Just [(2500, 8, False)]
  describe "a machine without braking frames" $ do
    it
      "takes the lowest code at the end of an element that asks for it (catches a section before \
      \every feed)"
      $ do
        let ms = [to 0 60 (At (here 240)) True, to 60 120 (At (here 240)) False]
        fmap (map brief) (framesFor (Machines.named "lkp-01f") ms)
          `shouldBe` Just [(2920, 9, False), (80, 1, False), (3000, 9, False)]
    it "has no slow frames if its control slows down by itself" $
      fmap
        (map brief)
        ( framesFor
            (Machines.named "n55")
            [to 0 60 (At (here 240)) True, to 60 120 (At (here 24)) False]
        )
        `shouldBe` Just [(6000, 240, False), (6000, 24, False)]
  where
    brief f = (pulses f, code f, braking f)
    pulses f = let Pulses3 x y z = abs (increment f) in fromIntegral (x + y + z) :: Int
    code f = Machine.codeNumber (feedCode f)
    to a b pace slow =
      Move
        (Straight (Vec.point a 0) (Vec.point b 0))
        (Manner (Mm 0, Mm 0) pace slow)
        (Region 0 0)
        False

here :: Double -> Located CutFeed
here = Located (Region 0 0) . PerMinute . Feed

framesFor :: Machine -> [Move] -> Maybe [Frame]
framesFor m ms =
  fmap
    (filter Frame.isMoving . map frame . Frame.plannedFrames)
    ( Made.program
        m
        ( Toolpath
            (Located (Region 0 0) (SpacePoint (Segment.start (Toolpath.segment (head ms))) (Mm 0)))
            [Travelling (Mm 0) [] ms]
            False
            Toolpath.noSetup
            Millimetres
        )
    )

-- | Lengths of the frames in mm with their feeds in mm/s; no feed for braking frames.
onMachine :: Testable t => [Move] -> (Machine -> [(Double, Maybe Double)] -> t) -> Property
onMachine ms law =
  forAllBlind (elements (map Machines.named ["lki-fm", "lki-u", "lki-un"])) $ \m ->
    counterexample (show (Machine.name m)) $ case framesFor m ms of
      Nothing -> counterexample "no frames" False
      Just fs ->
        property
          ( law
              m
              [ (l, if braking f then Nothing else Just (v / 60))
                | f <- fs,
                  let Mm l = FeedCode.frameLength m f,
                  let v = maybe 0 (\(Feed x) -> x) (FeedCode.feedOf m f (Mm l))
              ]
          )

-- | Length in mm on which the obtained feeds are too high for a later lower feed, summed in small
-- steps.
neededLength :: Machine -> [Move] -> Double
neededLength m ms =
  sum
    [ d
      | (k, (l, v)) <- zip [0 ..] pieces,
        let n = max 1 (ceiling (l / 0.01)) :: Int,
        let d = l / fromIntegral n,
        j <- [0 .. n - 1],
        tooFast v (l - d * (fromIntegral j + 0.5)) (feedLimits !! k)
    ]
  where
    pieces =
      [(l, speedOf (Toolpath.pace x)) | x <- ms, let Mm l = Segment.length (Toolpath.segment x)]
    speedOf p = case p of
      Rapid -> snd (Machine.feedRange m) / 60
      At (Located _ (PerTurn _ _)) -> error "no feed per turn"
      At (Located _ (PerMinute (Feed v))) -> case Machine.choose m v of
        Machine.Given _ g -> g / 60
        Machine.NoSuchFeed _ _ -> v / 60
    -- The lower feeds after the end of each move, and their distances.
    feedLimits = [[(s, v2) | (s, v2) <- limits k] | k <- [0 .. length ms - 1]]
    limits k =
      concat
        ( zipWith3
            ( \j x (s, (_, v)) ->
                [(s, v) | j > k]
                  <> [(s + fst (pieces !! j), 10 / 60) | Toolpath.isBraked x || j == length ms - 1]
            )
            [k :: Int ..]
            (drop k ms)
            (zip (starts k) (drop k pieces))
        )
    starts k = scanl (+) (-(fst (pieces !! k))) (map fst (drop k pieces))
    tooFast v rest later =
      or [v * v > v2 * v2 + 2 * 5 * (rest + s) | (s, v2) <- later]

-- | Consecutive lines and arcs at all feeds, some of them with braking at their ends.
moves :: Gen [Move]
moves = do
  n <- choose (1, 6)
  go (n :: Int) (Vec.point 3.337 (-1.219))
  where
    go n p
      | n <= 0 = pure []
      | otherwise = do
        s <- oneof [line p, arcFrom p]
        pace <- frequency [(4, At . here . (10 **) <$> choose (1, 2.99)), (1, pure Rapid)]
        slow <- frequency [(4, pure False), (1, pure True)]
        (Move s (Manner (Mm 0, Mm 0) pace slow) (Region 0 0) False :) <$> go (n - 1) (Segment.end s)
    line p = do
      l <- (10 **) <$> choose (-0.5, 1.8)
      a <- choose (-pi, pi)
      pure (Straight p (Vec.shift (Vec.polar (Mm l) (Rad a)) p))

arcFrom :: Point -> Gen Segment
arcFrom p = do
  r <- choose (1, 30)
  a <- choose (-pi, pi)
  s <- choose (0.3, 5)
  sense <- elements [Clockwise, CounterClockwise]
  let c = Vec.shift (Vec.polar (Mm r) (Rad a)) p
      signed = if sense == Clockwise then -s else s
  pure (Segment.arc sense c p (Vec.shift (Vec.rotate (Rad signed) (Vec.to c p)) c))
