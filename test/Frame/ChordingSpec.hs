-- | Laws of chords along a curve.
module Frame.ChordingSpec (spec) where

import Base.Quantity (Feed (..), Mm (..), Rad (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Data.List (partition)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Frame.Chording (Bounds (..))
import Frame.Chording qualified as Chording
import Frame.Frame (Frame (..))
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate (Case (contour))
import Generate qualified
import Generate.Run qualified as Curve
import Geometry.Distance qualified as Distance
import Geometry.Polyarc (Polyarc (segments))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (FeedCode (..), Machine)
import Machines qualified
import Part.CutFeed (CutFeed (..))
import Part.Part qualified as Part
import Test.Hspec
import Test.QuickCheck
import Toolpath.FromPart qualified as FromPart
import Toolpath.Toolpath (Move (segment), heights)
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec = do
  describe "chords of a curve" $ do
    it
      "keep every point of it within the bound on its side, and end on it (catches the two sides \
      \exchanged)"
      $ property $
        forAll ((,) <$> chain <*> bounds) $ \(ss, b) ->
          let ends = chordsOf b ss
              finish = Segment.end (last ss)
           in counterexample (show (length ends, largestExcess b ss ends)) $
                largestExcess b ss ends <= 1e-7
                  .&&. conjoin
                    [ counterexample
                        (show p)
                        ( minimum [d | s <- ss, let Mm d = Distance.toPoint p s]
                            <= largestOffset b + 1e-7
                        )
                      | p <- ends
                    ]
                  .&&. last ends === finish
    it
      "are about as few as the fewest on a fine grid (catches chords that stop at an inflection)"
      $ property $
        forAll
          (chain >>= \ss -> (ss,) <$> coarseBounds (sum [l | s <- ss, let Mm l = Segment.length s]))
          $ \(ss, b) ->
            let n = length (chordsOf b ss)
                fewest = fewestOn b (grid 150 ss)
             in n <= 15
                  ==> counterexample (show (n, fewest))
                  $ classify (fewest >= 4) "four and more" $
                    fromIntegral n <= 1.15 * fromIntegral fewest + (1 :: Double)
    it
      "pass over bends to both sides that are within the bounds (catches chords that stop at an \
      \inflection)"
      $ length (chordsOf (evenly 0.1) (Curve.bent (take 40 (cycle [(5, 0.02), (5, -0.02)]))))
        `shouldBe` 1
    it
      "end within an arc of which they reach neither end (catches a search at the ends of the arcs \
      \only)"
      $ length
        ( chordsOf
            (evenly 0.038)
            ( Curve.bent
                [ (3.2041, -0.0001),
                  (2.7333, -0.0125),
                  (8.0266, 0.0057),
                  (5.6682, -0.0206),
                  (5.5173, -0.025)
                ]
            )
        )
        `shouldBe` 4
    it
      "are tried from the end as well (catches a longest first chord that costs one chord more)"
      $ length
        ( chordsOf
            (evenly 0.583)
            ( Curve.bent
                [ (7.3199, -0.0012),
                  (14.8941, 0.0141),
                  (4.135, -0.0058),
                  (17.0171, -0.0102),
                  (13.8977, 0.0066),
                  (14.9307, 0.0049)
                ]
            )
        )
        `shouldBe` 2
    it
      "of an arc cut into many parts are as many as those of the arc, one more or less (catches a \
      \chord for each part)"
      $ property $
        forAll ((,,) <$> arc <*> choose (2, 200) <*> elements [0.005, 0.02, 0.1]) $ \(a, k, y) ->
          let n =
                length
                  ( chordsOf
                      Bounds {left = Mm y, right = Mm y, rise = Mm 0.01, shortest = Mm 0.01}
                      (Curve.parts k a)
                  )
              alone = FromToolpath.chordCount lkp01f (Mm y) a
           in counterexample (show (n, alone)) (abs (n - alone) <= 1)
    it "are of about equal length on an arc (catches a short remainder as the last chord)" $
      property $
        forAll ((,,) <$> arc <*> choose (2, 200) <*> elements [0.02, 0.0005]) $ \(a, k, y) ->
          let ends =
                chordsOf
                  Bounds {left = Mm y, right = Mm y, rise = Mm 0.01, shortest = Mm 0.01}
                  (Curve.parts k a)
              lengths = [d | (p, q) <- zip (start a : ends) ends, let Mm d = Vec.distance p q]
           in length ends
                > 1
                  ==> classify
                    (length ends > 256)
                    "more than are evened"
                    (counterexample (show lengths) (minimum lengths >= 0.8 * maximum lengths))
    it "keep the heights as well (catches heights that are compared at the ends of the run only)" $
      property $
        forAll ((,,) <$> Curve.open <*> bounds <*> vectorOf 130 (choose (-0.2, 0.2))) $
          \(ss, b, rises) ->
            let zs = scanl (+) 0 rises
                moves =
                  NonEmpty.zipWith
                    (\(z, z') -> Toolpath.atHeights (Mm z, Mm z'))
                    (NonEmpty.fromList (zip zs (drop 1 zs)))
                    (Curve.run ss)
                ends = [(p, z) | (p, Mm z) <- Chording.chordEnds 100000 b moves]
             in counterexample
                  (show (length ends))
                  (largestHeightError b (NonEmpty.toList moves) ends <= 0.01 + 1e-6)
    it
      "slow down as early before the end of a curve as elsewhere (catches braking on the last of \
      \its arcs only)"
      $ property $
        forAll Curve.curveCase $ \c ->
          let job = Curve.jobAlong c
              slowly e = e {Part.finish = Part.plainFinish {Part.slow = True}}
              braked' =
                job
                  { Part.feed = PerMinute (Feed 240) <$ Part.feed job,
                    Part.contour =
                      (Part.contour job)
                        { Part.elements =
                            fmap slowly (Part.elements (Part.contour job))
                        }
                  }
           in case Result.output
                ( FromPart.toToolpath
                    (Generate.partOf (Generate.begin c) (Part.Mill (Located (Region 0 0) braked')))
                )
                >>= Result.output . FromToolpath.quantise lkp01f of
                Nothing -> counterexample "no frames" False
                Just program ->
                  let frames = map Frame.frame (Frame.plannedFrames program)
                      (quick, slow) = span ((== FeedCode 9) . feedCode) frames
                      travelOf f =
                        let Mm d =
                              Vec.distance (Vec.point 0 0) (Frame.position lkp01f (increment f))
                         in d
                   in counterexample (show (map feedCode frames)) $
                        not (null quick)
                          && all ((== FeedCode 1) . feedCode) slow
                          && abs (sum (map travelOf slow) - 1.6) <= 0.05
    it
      "follow the same runs on a contour in the opposite sense (catches arcs that continue the \
      \wrong neighbour)"
      $ property $
        forAll ((,) <$> Curve.curveCase <*> choose (2, 9)) $ \(c, k) ->
          let job = Curve.jobAlong c
              halves =
                let (a, b) =
                      splitAt k (NonEmpty.toList (segments (contour c)))
                 in NonEmpty.fromList (Curve.elements [a, b])
              sensed sense =
                job
                  { Part.side =
                      (if Generate.outside c then Part.Outside else Part.Inside)
                        <$ Part.side job,
                    Part.sense = Just (Located (Region 0 0) sense),
                    Part.contour = (Part.contour job) {Part.elements = halves}
                  }
              runsOf sense =
                case Result.output
                  ( FromPart.toToolpath
                      ( Generate.partOf
                          (Generate.begin c)
                          (Part.Mill (Located (Region 0 0) (sensed sense)))
                      )
                  ) of
                  Just path ->
                    [ map NonEmpty.length (Toolpath.curveRuns (NonEmpty.toList cut))
                      | Toolpath.Cutting {Toolpath.cut} <- Toolpath.blocks path
                    ]
                  Nothing -> []
           in (runsOf Part.Climb === map reverse (runsOf Part.Conventional))
                .&&. map length (runsOf Part.Climb) === [2]
  where
    chain = oneof [Curve.open, Curve.closed]
    evenly y = Bounds {left = Mm y, right = Mm y, rise = Mm 0.01, shortest = Mm 0.001}
    arc = do
      r <- (10 **) <$> choose (0, 2)
      s <- choose (0.3, 2 * pi)
      sign <- elements [1, -1]
      let at t = Vec.point (r * cos t) (r * sin t)
      pure (Arc (at 0.7) (at (0.7 + sign * s)) (Vec.point 0 0) (Rad (sign * s)))

-- | Ends of the chords of a chain of segments.
chordsOf :: Bounds -> [Segment] -> [Point]
chordsOf b ss = map fst (Chording.chordEnds 100000 b (Curve.run ss))

bounds :: Gen Bounds
bounds = do
  a <- elements [0.005, 0.02, 0.1, 1]
  b <- oneof [pure a, elements [0.005, 0.02, 0.1, 1]]
  pure Bounds {left = Mm a, right = Mm b, rise = Mm 0.01, shortest = Mm 0.001}

-- | Bounds under which a curve of the given length has few chords.
coarseBounds :: Double -> Gen Bounds
coarseBounds whole = do
  a <- (whole *) . (10 **) <$> choose (-3.2, -1.2)
  b <- oneof [pure a, (a *) <$> choose (0.1, 1)]
  pure Bounds {left = Mm a, right = Mm b, rise = Mm 0.01, shortest = Mm 0.001}

-- | Largest distance from the chain at which chords may meet: the middle between the two bounds.
largestOffset :: Bounds -> Double
largestOffset Bounds {left = Mm l, right = Mm r} = abs (l - r) / 2

-- | Chords with the parts of the chain that they replace: segments with their first and last
-- fraction. Each end of a chord is searched after the previous one.
coveredParts :: Bounds -> [Segment] -> [Point] -> [(Point, Point, [(Segment, Double, Double)])]
coveredParts b ss ends = go (Segment.start (head ss)) [(s, 0) | s <- ss] ends
  where
    go p rest qs = case qs of
      [] -> []
      q : more -> let (covered, remaining) = upTo q rest in (p, q, covered) : go q remaining more
    upTo q rest = case rest of
      [] -> ([], [])
      (s, t) : more
        | u >= t - 1e-9 && u <= 1 && off <= largestOffset b + 1e-7 && (u < 1 || off <= 1e-12) ->
          ([(s, t, u)], (s, u) : more)
        | otherwise -> let (covered, remaining) = upTo q more in ((s, t, 1) : covered, remaining)
        where
          u
            | Vec.distance q (Segment.end s) <= Mm 1e-12 = 1
            -- A foot just before the beginning of an arc has a fraction of nearly a whole turn.
            | Arc {sweep = Rad a} <- s, 2 * pi - Segment.fraction s q * abs a <= 1e-9 = 0
            | otherwise = Segment.fraction s q
          Mm off = Vec.distance q (Segment.at u s)

-- | Largest excess in mm of a point of the chain over the bounds of its chord.
largestExcess :: Bounds -> [Segment] -> [Point] -> Double
largestExcess b ss ends =
  maximum
    (-1 : concat [offs p q s t u | (p, q, covered) <- coveredParts b ss ends, (s, t, u) <- covered])
  where
    offs p q s t u = [excessOf b p q (Segment.at (t + (u - t) * k / 8) s) | k <- [0 .. 8]]

-- | Excess in mm of a point over the bounds of a chord.
excessOf :: Bounds -> Point -> Point -> Point -> Double
excessOf b@Bounds {left = Mm l, right = Mm r} p q x =
  maximum
    [ aside - l,
      -aside - r,
      -ahead - largestOffset b,
      ahead - Vec.norm (Vec.to p q) - largestOffset b
    ]
  where
    along = Vec.unit (Vec.to p q)
    aside = Vec.cross along (Vec.to p x)
    ahead = Vec.dot along (Vec.to p x)

-- | Largest difference in mm between the heights of a run and of its chords, at the ends of its
-- moves.
largestHeightError :: Bounds -> [Move] -> [(Point, Double)] -> Double
largestHeightError b moves ends =
  maximum
    ( 0 :
      concat
        ( zipWith3
            differences
            (0 : map snd ends)
            (map snd ends)
            (coveredParts b (map segment moves) (map fst ends))
        )
    )
  where
    levels = [(segment m, z) | m <- moves, let (_, Mm z) = heights m]
    differences z z' (_, _, covered) =
      let lengths = scanl1 (+) [l * (u - t) | (s, t, u) <- covered, let Mm l = Segment.length s]
       in [ abs (z + (z' - z) * w / last lengths - h)
            | (w, (s, _, u)) <- zip lengths covered,
              u >= 1,
              Just h <- [lookup s levels]
          ]

-- | About equidistant points of a chain with the direction there, which is not reduced to one turn.
grid :: Int -> [Segment] -> Vector (Point, Double)
grid n ss =
  Vector.fromList (concat (zipWith points headings ss) <> [(Segment.end (last ss), last headings)])
  where
    headings = scanl (+) 0 [turned s | s <- ss]
    whole = sum [l | s <- ss, let Mm l = Segment.length s]
    points h s =
      let Mm l = Segment.length s
          k = max 1 (round (fromIntegral n * l / whole)) :: Int
       in [ (Segment.at t s, h + t * turned s)
            | j <- [0 .. k - 1],
              let t = fromIntegral j / fromIntegral k
          ]
    turned s = case s of
      Straight _ _ -> 0
      Arc {sweep = Rad a} -> a

-- | Least number of chords between points of a grid. Each chord keeps the points between its ends
-- within the bounds and spans at most a quarter turn.
fewestOn :: Bounds -> Vector (Point, Double) -> Int
fewestOn b points = go 0 [0] [1 .. final]
  where
    final = Vector.length points - 1
    -- The points that need exactly n chords, and those that need more.
    go :: Int -> [Int] -> [Int] -> Int
    go n reached others
      | null reached || final `elem` reached = n
      | otherwise =
        let (next, further) =
              partition (\j -> any (`chord` j) reached) others
         in go (n + 1) next further
    chord i j =
      j > i
        && Vector.all
          (\(x, _) -> excessOf b (fst (points Vector.! i)) (fst (points Vector.! j)) x <= 1e-9)
          between
        && Vector.maximum turns - Vector.minimum turns <= pi / 2 + 1e-9
      where
        between = Vector.slice i (j - i + 1) points
        turns = Vector.map snd between

lkp01f :: Machine
lkp01f = Machines.named "lkp-01f"
