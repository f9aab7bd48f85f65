-- | Laws of arc fitting on polyarcs.
module Geometry.ArcFitting.PolyarcFitSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Data.Foldable (toList)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Semigroup (sconcat)
import Data.Vector qualified as Vector
import Geometry.ArcFitting.Biarc qualified as Biarc
import Geometry.ArcFitting.CurveFit qualified as CurveFit
import Geometry.ArcFitting.ParametricFit qualified as ParametricFit
import Geometry.ArcFitting.PolyarcFit qualified as PolyarcFit
import Geometry.Curve qualified as Curve
import Geometry.Distance qualified as Distance
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  describe "biarcs along polyarcs" $ do
    it
      "every point of the polyarc is near the arcs (catches an extremum within a segment that is \
      \ignored)"
      $ property $
        forAll fitCase polyarcLaw
    it
      "every point of the arcs is near the polyarc (catches an arc that overshoots where the \
      \polyarc turns back)"
      $ property $
        forAll fitCase arcsLaw
    it
      "the arcs run from start to end, with no kink but at corners (catches a direction that only \
      \one side has)"
      $ property $
        forAll fitCase smoothLaw
    it "needs few more biarcs than the general fit (catches a bound that is far too large)" $
      property $
        forAll fitCase fewLaw
    it
      "a smoothed polyarc is near the original and has kinks at its corners only (catches a kink \
      \that remains, and an arc beyond a corner)"
      $ property $
        forAll fitCase smoothedLaw
    it
      "a smoothed polyarc without kinks keeps all vertices that do not lie on a merged arc \
      \(catches a polyarc that is fitted again)"
      $ property $
        forAll (fitCase `suchThat` hasCornersOnly) keptLaw
    it "the generator reaches corners, and arcs that replace many arcs or a part of one" $
      checkCoverage $
        forAll fitCase $ \t@(FitCase _ _ segments) ->
          let n = length (arcsOf t)
           in cover 10 (cornersOf (toList segments) > 0) "corners" $
                cover 20 (2 * n < length segments) "many for one" $
                  cover 5 (n > length segments) "one for many" True

-- | Kind of the test polyarc, tolerance in mm, and polyarc.
data FitCase = FitCase String Double (NonEmpty Segment)

instance Show FitCase where
  show (FitCase how tolerance segments) =
    "within " <> show tolerance <> " " <> how <> " " <> show (toList segments)

fitCase :: Gen FitCase
fitCase = oneof [splined, bent, through, polygon]
  where
    tolerance = (10 **) <$> choose (-4, -0.5)
    points =
      choose (3, 9) >>= \n -> vectorOf n (Vec.point <$> choose (-40, 40) <*> choose (-40, 40))
    -- Arc approximation of a spline, from fine to coarse.
    splined = do
      ps <- points
      fine <- (10 **) <$> choose (-5, -2)
      case Curve.spline Curve.Natural (Vector.fromList ps) of
        Left _ -> splined
        Right c ->
          ( \t ->
              FitCase
                "splined"
                t
                (sconcat (ParametricFit.approximate (Mm fine) (CurveFit.parametric c)))
          )
            <$> tolerance
    -- Lines and arcs in tangent contact.
    bent = do
      bends <-
        resize
          8
          ( listOf1
              ( (,)
                  <$> oneof [choose (1, 60), choose (0.05, 1)]
                    <*> oneof [pure 0, choose (-0.1, 0.1)]
              )
          )
      let poses = scanl step (Vec.point 0 0, 0) bends
          step (p, a) (l, k)
            | k == 0 = (Vec.shift (Vec.polar (Mm l) (Rad a)) p, a)
            | otherwise =
              ( Vec.shift (Vec.polar (Mm (2 / k * sin (k * l / 2))) (Rad (a + k * l / 2))) p,
                a + k * l
              )
          segment (p, a) (q, _) (l, k)
            | k == 0 = Straight p q
            | otherwise =
              Arc
                { start = p,
                  end = q,
                  centre = Vec.shift (Vec.polar (Mm (1 / k)) (Rad (a + pi / 2))) p,
                  sweep = Rad (k * l)
                }
      maybe
        bent
        (\ss -> (\t -> FitCase "bent" t ss) <$> tolerance)
        (NonEmpty.nonEmpty (zipWith3 segment poses (drop 1 poses) bends))
    through = do
      ps <- points
      ( \t ->
          FitCase
            "through points"
            t
            ( maybe
                (Straight (Vec.point 0 0) (Vec.point 1 0) :| [])
                (Biarc.through Open)
                (NonEmpty.nonEmpty ps)
            )
        )
        <$> tolerance
    -- Chords of a circle, with kinks below or above the limit of a corner, and perhaps one clear
    -- corner in the middle.
    polygon = do
      n <- choose (5, 60)
      turn <- elements [4e-4, 9e-4, 0.01]
      jump <- elements [0, 1.5, -2.5]
      let vertices =
            scanl
              ( \p k ->
                  Vec.shift
                    ( Vec.polar
                        (Mm 1)
                        (Rad (fromIntegral k * turn + (if 2 * k > n then jump else 0)))
                    )
                    p
              )
              (Vec.point 0 0)
              [1 .. n :: Int]
      maybe
        polygon
        (\ss -> (\t -> FitCase "polygon" t ss) <$> tolerance)
        (NonEmpty.nonEmpty (zipWith Straight vertices (drop 1 vertices)))

arcsOf :: FitCase -> [Segment]
arcsOf (FitCase _ tolerance segments) =
  toList
    ( MeasuredPolyarc.segments
        (MeasuredPolyarc.fromFlatPolyarc (PolyarcFit.approximate (Mm tolerance) segments))
    )

cornersOf :: [Segment] -> Int
cornersOf ss = length (filter (> 1e-3) (jumpsOf ss))

jumpsOf :: [Segment] -> [Double]
jumpsOf ss =
  zipWith
    ( \a b ->
        let Rad t =
              Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
         in abs t
    )
    ss
    (drop 1 ss)

polyarcLaw :: FitCase -> Property
polyarcLaw t@(FitCase _ tolerance segments) = near tolerance (toList segments) (arcsOf t)

arcsLaw :: FitCase -> Property
arcsLaw t@(FitCase _ tolerance segments) = near (tolerance + 1e-9) (arcsOf t) (toList segments)

-- | Random points of some segments are within a distance of the others.
near :: Double -> [Segment] -> [Segment] -> Property
near tolerance ss others =
  forAll (vectorOf 60 ((,) <$> choose (0, length ss - 1) <*> choose (0, 1))) $ \picks ->
    conjoin
      [ counterexample (show (p, d)) (d <= tolerance)
        | (k, f) <- picks,
          let p = Segment.at f (ss !! k),
          let d = minimum (map (distanceTo p) others)
      ]

smoothedLaw :: FitCase -> Property
smoothedLaw t@(FitCase _ tolerance segments) =
  conjoin
    [ near (tolerance + 1e-9) found (toList segments),
      near (tolerance + 1e-9) (toList segments) found,
      counterexample
        (show found)
        (property (and (zipWith (\a b -> Segment.end a == Segment.start b) found (drop 1 found)))),
      counterexample (show (jumpsOf found)) (all (\k -> k <= 1e-6 || k > 1e-3) (jumpsOf found)),
      cornersOf found === cornersOf (toList segments)
    ]
  where
    found = smoothedOf t

keptLaw :: FitCase -> Property
keptLaw t@(FitCase _ _ segments) =
  conjoin
    [ counterexample
        (show s)
        (any (begins s) segments && Segment.end s `elem` map Segment.end (toList segments))
      | s <- smoothedOf t
    ]
  where
    -- A merged arc starts where the first of its arcs does, and lies on its circle.
    begins s p = Segment.start p == Segment.start s && centreOf p == centreOf s
    centreOf s = case s of
      Arc {centre} -> Just centre
      Straight _ _ -> Nothing

smoothedOf :: FitCase -> [Segment]
smoothedOf (FitCase _ tolerance segments) = toList (PolyarcFit.smoothed (Mm tolerance) segments)

-- | True if a polyarc has kinks at corners only.
hasCornersOnly :: FitCase -> Bool
hasCornersOnly (FitCase _ _ segments) =
  all (\k -> k <= 1e-7 || k > 1e-3) (jumpsOf (toList segments))

-- | True if a kink that is no corner takes up between half and all of the tolerance. An arc across
-- such a kink has hardly any freedom, so the fit may or may not find one.
isTight :: FitCase -> Bool
isTight (FitCase _ tolerance segments) =
  or
    [ k <= 1e-3 && tolerance >= 0.9 * sagitta && tolerance <= 2 * sagitta
      | (s, s', k) <- zip3 ss (drop 1 ss) (jumpsOf ss),
        let sagitta = k * max (long s) (long s') / 8
    ]
  where
    ss = toList segments
    long s = let Mm l = Segment.length s in l

distanceTo :: Point -> Segment -> Double
distanceTo p s = let Mm d = Distance.toPoint p s in d

smoothLaw :: FitCase -> Property
smoothLaw t@(FitCase _ _ segments) =
  conjoin (zipWith (\a b -> Segment.end a === Segment.start b) ss (drop 1 ss))
    .&&. Segment.start (NonEmpty.head segments)
      === Segment.start (foldr const (NonEmpty.head segments) ss)
    .&&. Segment.end (NonEmpty.last segments)
      === Segment.end (foldl (const id) (NonEmpty.last segments) ss)
    .&&. counterexample
      (show ss)
      (length (filter (> 3e-8) (jumpsOf ss)) === cornersOf (toList segments))
  where
    ss = arcsOf t

fewLaw :: FitCase -> Property
fewLaw t@(FitCase _ tolerance segments) =
  all ((< 1.5) . sweepOf) segments
    && not (isTight t)
      ==> counterexample
        (show (found, general))
        ( fromIntegral found
            <= ( 2 * fromIntegral general
                   + 4 * fromIntegral (1 + cornersOf (toList segments)) ::
                   Double
               )
        )
  where
    -- Arcs of more than half a turn are handled in parts.
    sweepOf s = case s of
      Straight _ _ -> 0
      Arc {sweep = Rad a} -> abs a
    found = length (arcsOf t)
    general = case Curve.fromSegments segments of
      Right c ->
        NonEmpty.length (sconcat (ParametricFit.approximate (Mm tolerance) (CurveFit.parametric c)))
      Left _ -> found
