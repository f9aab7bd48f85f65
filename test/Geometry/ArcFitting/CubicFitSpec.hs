-- | Laws of arc fitting on cubic spans. Distances are measured by other means than in the
-- program: to an arc by angles, to the curve by the nearest of many of its points.
module Geometry.ArcFitting.CubicFitSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Data.Foldable (toList)
import Data.List (sort)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Semigroup (sconcat)
import Data.Vector qualified as Vector
import Geometry.Apart (apart, away)
import Geometry.ArcFitting.CubicFit qualified as CubicFit
import Geometry.ArcFitting.CurveFit qualified as CurveFit
import Geometry.ArcFitting.ParametricFit qualified as ParametricFit
import Geometry.Curve (Curve)
import Geometry.Curve qualified as Curve
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  describe "biarcs along cubics" $ do
    it
      "every point of the curve is near the arcs (catches a maximum within a span that is ignored)"
      $ property $
        forAll fitCase curveLaw
    it
      "every point of the arcs is near the curve (catches an arc that overshoots where the curve \
      \turns back)"
      $ property $
        forAll fitCase arcsLaw
    it "no kink but at corners (catches a direction at a joint that only one side has)" $
      property $
        forAll fitCase smoothLaw
    it "needs few more biarcs than the general fit (catches a bound that is far too large)" $
      property $
        forAll fitCase fewLaw
    it "collinear points give one line (catches a fit that stops at the end of a span)" $
      fmap
        length
        ( arcsOf 1e-5
            <$> either
              (const Nothing)
              Just
              (Curve.polyline (Vector.fromList [Vec.point k (2 * k) | k <- [0, 1, 3, 4, 7]]))
        )
        `shouldBe` Just 1
    it
      "the generator reaches corners, sharp turns, kinks, and spans that need many arcs or a part \
      \of one"
      $ checkCoverage $
        forAll fitCase $ \(FitCase _ tolerance c) ->
          let n = length (arcsOf tolerance c)
           in cover 10 (cornersOf c > 0) "corners" $
                cover 20 (n > 8 * Curve.spans c) "many arcs a span" $
                  cover 10 (n < Curve.spans c) "many spans an arc" True

-- | Kind of the test curve, tolerance in mm, and curve.
data FitCase = FitCase String Double Curve

instance Show FitCase where
  show (FitCase how tolerance _) = "within " <> show tolerance <> " " <> how

fitCase :: Gen FitCase
fitCase = do
  n <- choose (3, 9)
  scattered <- vectorOf n (Vec.point <$> choose (-40, 40) <*> choose (-40, 40))
  (turning, start) <- (,) <$> choose (-0.15, 0.15) <*> choose (-3, 3)
  noise <- vectorOf 60 (choose (-1e-4, 1e-4))
  m <- choose (5, 60)
  let dense =
        [ Vec.point
            (10 * sin (start + turning * k / 4) + 0.3 * k + e)
            (8 * cos (start + turning * k / 3))
          | (k, e) <- take m (zip [0 ..] noise)
        ]
  tolerance <- (10 **) <$> choose (-5, -0.5)
  (name, points, made) <-
    elements
      [ ("spline", scattered, Curve.spline Curve.Natural),
        ("dense spline", dense, Curve.spline Curve.Natural),
        ("closed spline", scattered, Curve.spline Curve.Periodic),
        ("clamped spline", scattered, Curve.spline (Curve.Clamped (Vec.vec 1 1) (Vec.vec 0 (-1)))),
        ( "dense clamped spline",
          dense,
          Curve.spline (Curve.Clamped (Vec.vec 1 1) (Vec.vec 0 (-1)))
        ),
        ("polyline", scattered, Curve.polyline),
        ("dense polyline", dense, Curve.polyline)
      ]
  case made (Vector.fromList points) of
    Right c -> pure (FitCase (name <> " " <> show points) tolerance c)
    Left _ -> fitCase

arcsOf :: Double -> Curve -> [Segment]
arcsOf tolerance c = case Curve.cubics (Mm 1e-9) c of
  Just (_, xs, ys) ->
    toList
      ( MeasuredPolyarc.segments
          (MeasuredPolyarc.fromFlatPolyarc (CubicFit.approximate (Mm tolerance) xs ys))
      )
  Nothing -> []

cornersOf :: Curve -> Int
cornersOf c = length (filter (> 1e-3) (jumpsOf c))

-- | Jumps of direction at the ends of the spans.
jumpsOf :: Curve -> [Double]
jumpsOf c =
  [ abs (angle (Curve.tangentFrom Curve.Before c u) (Curve.tangentFrom Curve.After c u))
    | u <- drop 1 (init (Curve.breaks c))
  ]
  where
    angle a b = let Rad t = Vec.signedAngle a b in t

-- | True if a kink that is no corner takes up between a fifth and all of the tolerance. An arc
-- across such a kink has hardly any freedom, so the fit may or may not find one. A hook between
-- points nearer than the tolerance has the same effect, because the curve does not run forwards
-- along any arc there.
isTight :: FitCase -> Bool
isTight (FitCase _ tolerance c) =
  or hooks
    || or
      [ k <= 1e-3 && tolerance >= 0.9 * sagitta && tolerance <= 5 * sagitta
        | (a, b, k) <- zip3 chords (drop 1 chords) (jumpsOf c),
          let sagitta = k * max a b / 8
      ]
  where
    points = map (Curve.at c) (Curve.breaks c)
    chords = zipWith away points (drop 1 points)
    hooks =
      [ away p q <= tolerance && (turnsBack Curve.After a || turnsBack Curve.Before b)
        | (a, b) <- zip (Curve.breaks c) (drop 1 (Curve.breaks c)),
          let (p, q) = (Curve.at c a, Curve.at c b),
          let turnsBack side u = Vec.dot (Curve.tangentFrom side c u) (Vec.to p q) < 0
      ]

curveLaw :: FitCase -> Property
curveLaw (FitCase _ tolerance c) = forAll (vectorOf 100 (choose (0, 1))) $ \fs ->
  conjoin
    [ counterexample (show (u, d)) (d <= tolerance)
      | f <- fs,
        let u = f * Curve.domain c,
        let d = minimum (map (`apart` Curve.at c u) ss)
    ]
  where
    ss = arcsOf tolerance c

arcsLaw :: FitCase -> Property
arcsLaw (FitCase _ tolerance c) =
  forAll (vectorOf 30 ((,) <$> choose (0, length ss - 1) <*> choose (0, 1))) $ \picks ->
    conjoin
      [ counterexample (show (p, d)) (d <= tolerance + 1e-8)
        | (k, f) <- picks,
          let p = Segment.at f (ss !! k),
          let d = nearest p
      ]
  where
    ss = arcsOf tolerance c
    -- Each span is searched by itself: near a sharp corner, samples of one span could hide the
    -- nearest point of the other.
    known = [(span', between 400 span') | span' <- zip (Curve.breaks c) (drop 1 (Curve.breaks c))]
    between :: Int -> (Double, Double) -> [(Double, Vec.Point)]
    between count (a, b) =
      [ (u, Curve.at c u)
        | k <- [0 .. count],
          let u = a + (b - a) * fromIntegral k / fromIntegral count
      ]
    -- At a sharp bend, the distance may have two minima between two samples.
    nearest p =
      minimum
        [ closer p (60 :: Int) a b
          | (_, about) <-
              take
                8
                (sort [(d, wider span' about) | (span', us) <- known, (d, about) <- minima p us]),
            (_, (a, b)) <- take 3 (sort (minima p (between 80 about)))
        ]
    -- At a sharp bend, the nearest point may lie beyond the next sample.
    wider (from, to) (a, b) = let w = (b - a) / 2 in (max from (a - w), min to (b + w))
    -- Samples that are nearer than both of their neighbours, each as the distance and the interval
    -- between the neighbours.
    minima p us =
      let ds = [(away p q, u) | (u, q) <- us]
       in [ (m, (a, b))
            | ((l, a), (m, _), (r, b)) <-
                zip3 (take 1 ds <> ds) ds (drop 1 ds <> take 1 (reverse ds)),
              m <= l,
              m <= r
          ]
    closer p k a b
      | k == 0 = away p (Curve.at c ((a + b) / 2))
      | away p (Curve.at c u) <= away p (Curve.at c v) = closer p (k - 1) a v
      | otherwise = closer p (k - 1) u b
      where
        u = a + (b - a) / 3
        v = b - (b - a) / 3

smoothLaw :: FitCase -> Property
smoothLaw (FitCase _ tolerance c) =
  conjoin (zipWith joined ss (drop 1 ss)) .&&. length (filter (> 2.1e-8) turns) === cornersOf c
  where
    ss = arcsOf tolerance c
    -- On a smooth curve, a turn much tighter than the tolerance may be replaced by a point at which
    -- the arcs turn back; at such a point there is a segment much shorter than the tolerance.
    turns =
      [ abs t
        | (a, b) <- zip ss (drop 1 ss),
          cornersOf c > 0 || minimum (map Segment.length [a, b]) > Mm (0.1 * tolerance),
          let Rad t = Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
      ]
    joined a b = counterexample (show (a, b)) (Segment.end a === Segment.start b)

fewLaw :: FitCase -> Property
fewLaw t@(FitCase _ tolerance c) =
  not (isTight t)
    ==> counterexample
      (show (length ss, general))
      ( fromIntegral (length ss)
          <= (2 * fromIntegral general + 4 * fromIntegral (1 + cornersOf c) :: Double)
      )
  where
    ss = arcsOf tolerance c
    general =
      NonEmpty.length (sconcat (ParametricFit.approximate (Mm tolerance) (CurveFit.parametric c)))
