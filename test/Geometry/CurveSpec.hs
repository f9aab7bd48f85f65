-- | Laws of curves through tables: their points and smoothness, their arc length, and the searches
-- for points on them.
module Geometry.CurveSpec (spec) where

import Base.Quantity (Mm (..), Rad (..), minus)
import Data.Foldable (toList)
import Data.List (nub, sort)
import Data.List.NonEmpty (NonEmpty (..))
import GHC.Exts qualified as Exts
import Generate.Curve (Table (..))
import Generate.Curve qualified as Generate
import Geometry.Curve
  ( Approach (..),
    Curve,
    CurveFault (..),
    EndCondition (..),
    Span (..),
    SpanShape (..),
  )
import Geometry.Curve qualified as Curve
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Curve.Spline qualified as Spline
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion (TaylorExpansion)
import Geometry.Segment (Segment (..))
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Linear.V2 (V2 (..))
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "curves through tables" $ do
    it "pass through every row at its parameter (catches a span between the wrong rows)" $
      property $
        forAll Generate.anyCurve $ \c ->
          conjoin
            [ close 1e-9 (Curve.at c (BasisCurve.at row)) (BasisCurve.knotPoint row)
              | row <- toList (BasisCurve.rows (Curve.base c))
            ]
    it
      "a spline has equal derivatives by chord length on both sides of a row (catches a wrong \
      \right-hand side of its equations)"
      $ property $
        forAll Generate.smooth periodicLaw
    it "a natural spline has no curvature at its ends (catches an end that is clamped)" $
      property $
        forAll (tableWith (const Natural)) $ \c ->
          conjoin
            [ counterexample (show v) (Vec.norm v < 1e-9)
              | (approach, u) <- endPositions c,
                let v = secondBy (chord c u) (Curve.expansion approach 2 c u)
            ]
    it
      "a clamped spline has the given end directions, and 1 mm per mm of chord as its speed there \
      \(catches a derivative by the parameter)"
      $ property $
        forAll ((,) <$> choose (-3, 3) <*> choose (-3, 3)) $ \(a, b) ->
          let from = Vec.polar (Mm 1) (Rad a)
              to = Vec.polar (Mm 1) (Rad b)
           in forAll (tableWith (const (Clamped from to))) $ \c ->
                conjoin
                  [ alike 1e-9 v w
                    | ((approach, u), w) <- zip (endPositions c) [from, to],
                      let v = firstBy (chord c u) (Curve.expansion approach 1 c u)
                  ]
    it
      "a closed spline has equal derivatives at its end and its start (catches a cyclic system \
      \without its corner)"
      $ property $
        forAll Generate.ring $ \c ->
          let n = Curve.domain c
              arriving = Curve.expansion Before 2 c n
              leaving = Curve.expansion After 2 c 0
           in alike 1e-8 (firstBy (chord c n) arriving) (firstBy (chord c 0) leaving)
                .&&. alike 1e-8 (secondBy (chord c n) arriving) (secondBy (chord c 0) leaving)
                .&&. Curve.corners c === []
    it "a closed table may repeat its first row or not" $
      property $
        forAll Generate.closedRing $ \(Table _ points) ->
          let single =
                if take 1 points == drop (length points - 1) points then init points else points
              c = splineOf Periodic single
              c' = splineOf Periodic (single <> take 1 single)
           in forAll Generate.parameter $ \t ->
                close
                  1e-9
                  (Curve.at c (Generate.parameterOf c t))
                  (Curve.at c' (Generate.parameterOf c t))
    it "points of one parabola give this parabola (catches fractions of the wrong span)" $
      property $
        forAll ((,,) <$> choose (-0.05, 0.05) <*> choose (-2, 2) <*> choose (-9, 9)) $ \(a, b, c) ->
          forAll (choose (1, 4)) $ \k -> forAll (vectorOf (2 * k + 1) (choose (1, 9))) $ \steps ->
            forAll (elements [1, -1]) $ \sense -> forAll Generate.parameter $ \t ->
              let y x = a * x * x + b * x + c
                  curve =
                    Generate.ok
                      ( Curve.parabola
                          ( Exts.fromList
                              [Vec.point x (y x) | x <- scanl1 (+) (map (sense *) steps)]
                          )
                      )
                  p = Curve.at curve (Generate.parameterOf curve t)
               in counterexample
                    (show p)
                    (abs (Vec.y p - y (Vec.x p)) < 1e-9 * (1 + abs (Vec.x p) ^ (2 :: Int)))
    it "the template's parabolas have the coefficients of the paper, corrected" $
      coefficients template
        `shouldSatisfy` and
          . zipWith
            areClose
            [(-0.00722596, 1.1707467, -27.504988), (-0.00460579, 0.8200501, -16.220749)]
    it
      "a periodic spline through 60 points of a circle, shifted or not, is a circle to 1e-4 mm \
      \(catches a spline that is flat at its start)"
      $ property $
        forAll ((,) <$> choose (-20, 20) <*> choose (0, 60)) $ \(d, u) ->
          let c = Curve.shifted Curve.LeftOf (Curve.Constant (Mm d)) (circleOf 60 50)
              Mm r = Vec.distance (Vec.point 0 0) (Curve.at c u)
           in counterexample (show r) (abs (r - (50 - d)) < 1e-4)
    it "takes a table of 20,000 points" $ do
      let c = circleOf 20000 50
          Mm l = Curve.length c
      abs (l - 100 * pi) `shouldSatisfy` (< 1e-6)

  describe "arc length" $ do
    it "equals the sum of many chords (catches a panel that is accepted too early)" $
      property $
        forAll (Generate.layered 2 Generate.anyCurve) $ \c -> forAll Generate.parameter $ \t ->
          let u = Generate.parameterOf c t
              Mm l = Curve.lengthAt c u
              byChords = chordSum c u
           in counterexample (show (l, byChords)) (abs (l - byChords) < 1e-6)
    it
      "equals the sum of many chords where rows of a column lie within spans (catches a panel \
      \across such a row)"
      $ property $
        forAll shiftedTwice $ \c ->
          let rows = map BasisCurve.at (toList (BasisCurve.rows (Curve.base c)))
              Mm l = Curve.length c
              breaks = nub (sort (rows <> Curve.breaks c))
              byChords = sum (zipWith (chordsBetween c) breaks (drop 1 breaks))
           in counterexample (show (l, byChords)) (abs (l - byChords) < 1e-7)
    it "is exact for lines and arcs" $
      property $
        forAll Generate.toSegments $ \c ->
          let Mm l = Curve.length c
              known = sum [spanLength s | s <- toList (BasisCurve.spans (Curve.base c))]
           in counterexample (show (l, known)) (abs (l - known) < 1e-8)
    it "equals the closed formula for a parabola" $
      property $
        forAll ((,) <$> choose (1, 50) <*> choose (1, 80)) $ \(p, x) ->
          let c =
                Generate.ok
                  (Curve.fromShapes (Quadratic (1 / (2 * p)) 0 0 0 x :| []) (Exts.fromList [0, 1]))
              Mm l = Curve.length c
              t = x / p
           in counterexample (show l) (abs (l - p / 2 * (t * sqrt (1 + t * t) + asinh t)) < 1e-8)
    it
      "leads back to the parameter from which it was computed (catches the panel after the right \
      \one)"
      $ property $
        forAll (Generate.layered 2 Generate.anyCurve) $ \c -> forAll Generate.parameter $ \t ->
          let u = Generate.parameterOf c t
              back = Curve.parameterAtLength c (Curve.lengthAt c u)
           in counterexample (show (u, back)) (abs (back - u) < 1e-7)

  describe "searches on a curve" $ do
    it
      "nearest: no sample of the curve is nearer (catches the first foot in place of the nearest)"
      $ property $
        forAll (Generate.layered 1 Generate.anyCurve) $ \c ->
          forAll ((,) <$> choose (-150, 150) <*> choose (-150, 150)) $ \(x, y) ->
            let p = Vec.point x y
                u = Curve.nearest p c
                found =
                  minimum
                    [Vec.distance p (Curve.pointFrom approach c u) | approach <- [Before, After]]
                sampled =
                  minimum
                    [ Vec.distance
                        p
                        (Curve.pointFrom approach c (Generate.parameterOf c (k / 1500)))
                      | k <- [0 .. 1500],
                        approach <- [Before, After]
                    ]
             in counterexample (show (found, sampled)) (minus found sampled <= Mm 1e-9)
    it
      "nearest: a point on a spline with sharp bends is its own foot (catches samples that skip a \
      \bend)"
      -- A bend is skipped in one of some hundred splines.
      $ property . withMaxSuccess 3000 $
        forAll Generate.zigzag $ \c -> forAll Generate.parameter $ \t ->
          let p = Curve.at c (Generate.parameterOf c t)
              u = Curve.nearest p c
           in counterexample (show (p, u)) (Vec.distance p (Curve.at c u) <= Mm 1e-6)
    it
      "nearest: a point on the curve is its own foot (catches samples that are not refined)"
      $ property $
        forAll Generate.gentle $ \c -> forAll Generate.parameter $ \t ->
          let u = Generate.parameterOf c t
           in counterexample (show u) (abs (Curve.nearest (Curve.at c u) c - u) < 1e-6)
    it
      "atX: every result has the given x, and no crossing is missing (catches a result of another \
      \span)"
      $ property $
        forAll (Generate.layered 1 Generate.anyCurve) $ \c -> forAll Generate.parameter $ \t ->
          let x = Vec.x (Curve.at c (Generate.parameterOf c t)) + 1e-4
              found = Curve.atX x c
              side u = Vec.x (Curve.at c u) > x
              bs = Curve.breaks c
              -- Intervals between neighbouring samples, none of which contains a break.
              steps =
                [ (a', a' + step)
                  | (a, b) <- zip bs (drop 1 bs),
                    let step = (b - a) / 40,
                    k <- [0 .. 38 :: Int],
                    let a' = a + step * fromIntegral k
                ]
           in conjoin
                [ counterexample (show u) (abs (Vec.x (Curve.pointFrom approach c u) - x) < 1e-6)
                  | u <- found,
                    let approach =
                          if u `elem` bs && abs (Vec.x (Curve.pointFrom Before c u) - x) < 1e-6
                            then Before
                            else After
                ]
                .&&. conjoin
                  [ counterexample
                      (show (a, b, found))
                      (any (\u -> u >= a - 1e-9 && u <= b + 1e-9) found)
                    | (a, b) <- steps,
                      side a /= side b
                  ]
    it
      "atX: near a corner that turns back there are two points, however close (catches two \
      \crossings taken for one)"
      $ length
        ( Curve.atX
            (-3.9999)
            ( Generate.ok
                (Curve.polyline (Exts.fromList [Vec.point 0 15, Vec.point (-4) 0, Vec.point 1 19]))
            )
        )
        `shouldBe` 2
    it "atX: a vertical stretch gives its two ends (catches samples between them)" $
      fmap
        (Curve.atX 0)
        ( Curve.polyline
            (Exts.fromList [Vec.point (-3) 2, Vec.point 0 0, Vec.point 0 10, Vec.point 5 10])
        )
        `shouldSatisfy` \case
          Right [a, b] -> abs (a - 1) < 1e-6 && abs (b - 2) < 1e-6
          _ -> False
    it
      "atX: just before an extremum in x there are two points (catches an extremum between two \
      \samples)"
      $ property $
        forAll Generate.ring $ \c -> forAll (choose (0.001, 0.02)) $ \short ->
          let xs = [Vec.x (Curve.at c (Generate.parameterOf c (k / 5000))) | k <- [0 .. 5000]]
              x = maximum xs - short
              sides = map (> x) xs
           in length (Curve.atX x c) === length (filter id (zipWith (/=) sides (drop 1 sides)))
    it
      "atX: at an extremum in x there is one point (catches a point that is counted twice)"
      $ Curve.atX 50 (circleOf 60 50) `shouldSatisfy` \case
        [0] -> True
        [0, u] -> abs (u - 60) < 1e-6
        _ -> False
    it
      "corners: a polyline has them at its kinks, a spline nowhere (catches ends that are taken \
      \for corners)"
      $ property $
        forAll Generate.polyline $ \c ->
          let turned u =
                let Rad a =
                      Vec.signedAngle (Curve.tangentFrom Before c u) (Curve.tangentFrom After c u)
                 in abs a > 1e-6
              inner = map fromIntegral [1 .. Curve.spans c - 1]
           in Curve.corners c === [0 | Curve.isClosed c, turned 0] <> filter turned inner
    it "corners: a closed square has four" $
      Curve.corners
        ( Generate.ok
            ( Curve.polyline
                ( Exts.fromList
                    [Vec.point 0 0, Vec.point 9 0, Vec.point 9 9, Vec.point 0 9, Vec.point 0 0]
                )
            )
        )
        `shouldBe` [0, 1, 2, 3]
    it
      "a spline that reverses its direction has a tangent there (catches a division by a speed of \
      \0)"
      $ do
        let c = splineOf Natural [Vec.point 0 0, Vec.point 10 0, Vec.point 0 0]
        (Curve.tangentFrom Before c 1, Curve.tangentFrom After c 1) `shouldSatisfy` \(a, b) ->
          Vec.dot a (Vec.vec 1 0) > 0.999 && Vec.dot b (Vec.vec 1 0) < -0.999

  describe "transformed and reversed curves" $ do
    it
      "a similarity maps every point of a curve with its shifts (catches a shift distance that is \
      \not scaled)"
      $ property $
        forAll (Generate.layered 3 Generate.anyCurve) $ \c ->
          forAll Generate.similarity $ \s -> forAll Generate.parameter $ \t ->
            let u = Generate.parameterOf c t
             in close
                  1e-6
                  (Curve.at (Curve.transformed s c) u)
                  (Transformation.point s (Curve.at c u))
    it
      "a reversed curve passes the same points in reverse order (catches a column that is not \
      \reversed)"
      $ property $
        forAll (Generate.layered 3 Generate.anyCurve) $ \c -> forAll Generate.parameter $ \t ->
          let u = Generate.parameterOf c t
              n = Curve.domain c
           in close 1e-6 (Curve.pointFrom Before (Curve.reversed c) (n - u)) (Curve.at c u)
    it
      "the speed after a break is that of the stretch after it (catches a stretch that counts \
      \beyond its end)"
      $ property $
        forAll (Generate.layered 3 Generate.anyCurve) $ \c ->
          conjoin
            [ counterexample (show (u, at, beyond)) (abs (at - beyond) <= 1e-4 * (1 + beyond))
              | u <- drop 1 (init (Curve.breaks c)),
                let speed = Vec.norm . firstBy 1 . Curve.expansion After 1 c
                    -- Joggles are steep, so the speed of the stretch is continued to the break.
                    (at, beyond) = (speed u, 2 * speed (u + 1e-7) - speed (u + 2e-7))
            ]
    it "the generator reaches every kind of curve" $
      checkCoverage $
        forAll Generate.anyCurve $ \c ->
          cover 5 (Curve.isClosed c) "closed" $
            cover 5 (isVertical c) "vertical tangent" $
              cover 5 (Curve.spans c >= 20) "many spans" $
                cover 5 (Curve.spans c == 1) "one span" $
                  cover 5 (reversesInX c) "doubles back" True

  describe "tables that give no curve" $ do
    it "too few points" $ do
      Curve.polyline (Exts.fromList [Vec.point 0 0]) `shouldBe` Left (TooFew 2)
      Curve.spline Natural (Exts.fromList []) `shouldBe` Left (TooFew 2)
      Curve.spline Periodic (Exts.fromList [Vec.point 0 0, Vec.point 1 0, Vec.point 0 0])
        `shouldBe` Left (TooFew 3)
      Curve.parabola (Exts.fromList [Vec.point 0 0]) `shouldBe` Left (TooFew 3)
    it "a repeated point: the fault names the first of the two rows" $
      Curve.spline
        Natural
        (Exts.fromList [Vec.point 0 0, Vec.point 1 0, Vec.point 1 0, Vec.point 2 0])
        `shouldBe` Left (Coincident 2)
    it "parabolas through an even count of points" $
      Curve.parabola (Exts.fromList [Vec.point k 0 | k <- [1 .. 4]]) `shouldBe` Left (EvenCount 4)
    it "parabolas that reverse in x: the fault names the last row in order" $
      Curve.parabola (Exts.fromList [Vec.point 0 0, Vec.point 2 1, Vec.point 1 2])
        `shouldBe` Left (NotMonotone 2)
    it "spans that do not join, and a span without length" $ do
      Curve.fromShapes
        (Line (Vec.point 0 0) (Vec.point 1 0) :| [Line (Vec.point 1 1) (Vec.point 2 0)])
        (Exts.fromList [])
        `shouldBe` Left (Disjoint 1)
      Curve.fromShapes (Quadratic 1 2 3 4 4 :| []) (Exts.fromList []) `shouldBe` Left (NoLength 1)
    it "rows out of order" $
      Curve.fromShapes (Line (Vec.point 0 0) (Vec.point 1 0) :| []) (Exts.fromList [0, 0.5, 0.4])
        `shouldBe` Left (Disordered 2)
    it "an end direction that is a zero vector" $
      Curve.spline
        (Clamped (Vec.vec 0 0) (Vec.vec 1 0))
        (Exts.fromList [Vec.point 0 0, Vec.point 1 0])
        `shouldBe` Left NoDirection

-- Helpers -----------------------------------------------------------------------------------

splineOf :: EndCondition -> [Point] -> Curve
splineOf ends points = Generate.ok (Curve.spline ends (Exts.fromList points))

circleOf :: Int -> Double -> Curve
circleOf n r =
  splineOf
    Periodic
    [ Vec.shift (Vec.polar (Mm r) (Rad (2 * pi * fromIntegral k / fromIntegral n))) (Vec.point 0 0)
      | k <- [0 .. n - 1]
    ]

-- | Spline through a random table, with the end condition changed by a function.
tableWith :: (EndCondition -> EndCondition) -> Gen Curve
tableWith f = do
  Table ends points <- Generate.winding
  pure (splineOf (f ends) points)

-- | Parameters of both ends, with the side from which the curve approaches each.
endPositions :: Curve -> [(Approach, Double)]
endPositions c = [(After, 0), (Before, Curve.domain c)]

-- | Length of the chord of the span that starts at a parameter; at the end, that of the last span.
chord :: Curve -> Double -> Double
chord c u = Exts.toList (BasisCurve.chords (Curve.base c)) !! min (Curve.spans c - 1) (truncate u)

-- | First and second derivative by chord length, given the length of the span's chord.
firstBy, secondBy :: Double -> TaylorExpansion -> Vec
firstBy h (V2 a b) =
  Vec.scale (1 / h) (Vec.vec (PowerSeries.coefficient 1 a) (PowerSeries.coefficient 1 b))
secondBy h (V2 a b) =
  Vec.scale (2 / h / h) (Vec.vec (PowerSeries.coefficient 2 a) (PowerSeries.coefficient 2 b))

periodicLaw :: Curve -> Property
periodicLaw c =
  conjoin
    [ alike 1e-8 (firstBy (chord c (u - 1)) arriving) (firstBy (chord c u) leaving)
        .&&. alike 1e-8 (secondBy (chord c (u - 1)) arriving) (secondBy (chord c u) leaving)
      | u <- map fromIntegral [1 .. Curve.spans c - 1],
        let arriving = Curve.expansion Before 2 c u,
        let leaving = Curve.expansion After 2 c u
    ]

-- | Arc length up to a parameter.
chordSum :: Curve -> Double -> Double
chordSum c u = sum [chordsBetween c a (min b u) | (a, b) <- zip bs (drop 1 bs), a < u]
  where
    bs = Curve.breaks c

-- | Arc length of a smooth stretch: Richardson extrapolation of two sums of chords, whose error
-- falls with the square of the count of chords.
chordsBetween :: Curve -> Double -> Double -> Double
chordsBetween c a b = fine + (fine - chords 300) / 3
  where
    fine = chords 600
    chords n =
      let pointAt k =
            if k == n
              then Curve.pointFrom Before c b
              else Curve.at c (a + (b - a) * fromIntegral k / fromIntegral n)
       in sum
            [ let Mm d = Vec.distance (pointAt k) (pointAt (k + 1)) in d
              | k <- [0 .. n - 1 :: Int]
            ]

-- | Consecutive spans, shifted by a column and then by a constant that is too small for a cusp.
shiftedTwice :: Gen Curve
shiftedTwice = do
  c <- Generate.pieces
  column <- Generate.columnOf c (-3) 3
  let below = Curve.shifted Curve.LeftOf (Curve.Pointwise column) c
      most = 0.5 / Generate.tightest below
  d <- choose (-(min 3 most), min 3 most)
  pure (Curve.shifted Curve.RightOf (Curve.Constant (Mm d)) below)

spanLength :: Span -> Double
spanLength s = case s of
  Polynomial x y ->
    let at t =
          Vec.point (Spline.value x t) (Spline.value y t)
        Mm d = Vec.distance (at 0) (at 1)
     in d
  Round (Arc {start, centre, sweep = Rad a}) -> let Mm r = Vec.distance centre start in r * abs a
  Round (Straight p q) -> let Mm d = Vec.distance p q in d
  -- No span of these tests is a Bézier curve.
  Controlled _ -> 1 / 0

-- | Points 3–13 of the template of the turbine blade.
template :: Curve
template =
  Generate.ok . Curve.parabola . Exts.fromList $
    [ Vec.point 35.50 4.95,
      Vec.point 44.95 10.52,
      Vec.point 53.81 14.57,
      Vec.point 61.65 16.83,
      Vec.point 70.85 18.76
    ]

-- | @a, b, c@ of every parabola, from three of its points.
coefficients :: Curve -> [(Double, Double, Double)]
coefficients c =
  [ ofThree (Curve.at c u) (Curve.at c (u + 0.3)) (Curve.pointFrom Before c (u + 1))
    | u <- map fromIntegral [0 .. Curve.spans c - 1]
  ]
  where
    ofThree p q r =
      let slope s t = (Vec.y t - Vec.y s) / (Vec.x t - Vec.x s)
          a = (slope q r - slope p q) / (Vec.x r - Vec.x p)
          b = slope p q - a * (Vec.x p + Vec.x q)
       in (a, b, Vec.y p - Vec.x p * (b + a * Vec.x p))

areClose :: (Double, Double, Double) -> (Double, Double, Double) -> Bool
areClose (a, b, c) (a', b', c') = abs (a - a') < 1e-8 && abs (b - b') < 1e-6 && abs (c - c') < 1e-5

isVertical :: Curve -> Bool
isVertical c =
  let dx u =
        Vec.dot (Curve.tangent c u) (Vec.vec 1 0)
   in or
        [ dx u * dx v < 0
          | let us = [Generate.parameterOf c (k / 60) | k <- [0 .. 60]],
            (u, v) <- zip us (drop 1 us)
        ]

reversesInX :: Curve -> Bool
reversesInX c =
  minimum
    [ Vec.dot (Curve.tangent c 0) (Curve.tangent c (Generate.parameterOf c (k / 60)))
      | k <- [0 .. 60]
    ]
    < -0.9

close :: Double -> Point -> Point -> Property
close tolerance p q = counterexample (show (p, q)) (Vec.distance p q <= Mm tolerance)

alike :: Double -> Vec -> Vec -> Property
alike tolerance v w =
  counterexample (show (v, w)) (Vec.norm (Vec.add v (Vec.negate w)) <= tolerance)
