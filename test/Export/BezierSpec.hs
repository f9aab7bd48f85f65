-- | Laws of cubic Bézier curves.
module Export.BezierSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty qualified as NonEmpty
import Export.Bezier (CubicBezier (CubicBezier))
import Export.Bezier qualified as Bezier
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "Bézier curves" $ do
  it "along an arc are within the tolerance of it and of its rise (catches too few curves)" $
    forAll arc $ \segment -> forAll (choose (-20, 20)) $ \rise ->
      forAll (elements [1e-5, 1e-3, 0.1]) $ \tolerance ->
        let curves = NonEmpty.toList (Bezier.alongArc (Mm tolerance) (Mm rise) segment)
            count = fromIntegral (length curves)
            deviations =
              [ (off, risen)
                | (k, c) <- zip [0 ..] curves,
                  t <- [0, 0.1 .. 1],
                  let p = Bezier.at t c
                      off = abs (distance p (centre segment) - radiusOf segment)
                      risen = abs (rise * (shareOf segment ((k + t) / count) p - (k + t) / count))
              ]
         in counterexample (show (count, maximum (map fst deviations))) $
              all (\(a, b) -> a <= tolerance && b <= tolerance) deviations
                && all (\(a, b) -> Bezier.end a == Bezier.start b) (zip curves (drop 1 curves))
  it "have parts that run along them (catches a part of another share)" $
    forAll curve $ \c -> forAll (choose (0, 1)) $ \a -> forAll (choose (0, 1)) $ \b ->
      let (low, high) = (min a b, max a b)
          part = Bezier.between low high c
       in and
            [ distance (Bezier.at t part) (Bezier.at (low + t * (high - low)) c) < 1e-10
              | high > 1e-3,
                t <- [0, 0.25 .. 1]
            ]
  it "find their own points (catches a search that ends at its first step)" $
    forAll curve $ \c -> forAll (choose (0, 1)) $ \t ->
      let p = Bezier.at t c
       in case Bezier.nearest (Mm 1e-5) p c of
            Nothing -> counterexample (show (t, p)) False
            Just (u, _) -> property (distance (Bezier.at u c) p < 1e-5)
  where
    distance p q = let Mm d = Vec.distance p q in d
    radiusOf s = distance (Segment.start s) (centre s)

-- | The share of an arc's sweep before the point @p@, near the share @about@.
shareOf :: Segment -> Double -> Point -> Double
shareOf s about p = about + wrapped (angle / turn - about)
  where
    Rad turn = sweep s
    Rad angle = Vec.signedAngle (Vec.to (centre s) (start s)) (Vec.to (centre s) p)
    wrapped d = d - fromIntegral (round (d * abs turn / (2 * pi)) :: Int) * 2 * pi / abs turn

-- | Arcs up to a full circle, in both senses.
arc :: Gen Segment
arc = do
  r <- elements [0.5, 10, 300]
  from <- choose (-pi, pi)
  turn <- oneof [choose (0.05, 2 * pi), choose (-2 * pi, -0.05), elements [2 * pi, -2 * pi]]
  let m = Vec.point 7 (-3)
      at a = Vec.shift (Vec.polar (Mm r) (Rad a)) m
  pure Arc {start = at from, end = at (from + turn), centre = m, sweep = Rad turn}

-- | Curves that run to the right without turning back, so that no point is passed twice.
curve :: Gen CubicBezier
curve = do
  ys <- vectorOf 4 (choose (-5, 5))
  case zipWith Vec.point [0, 3, 6, 9] ys of
    [a, b, c, d] -> pure (CubicBezier a b c d)
    _ -> discard
