-- | Distances in closed form against distances between many sampled points.
module Geometry.DistanceSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Apart (away)
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.RandomSegment (point, segment)
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it
    "point to segment: no sample of the segment is nearer, one is nearly as near (catches a foot \
    \outside the arc)"
    $ property $
      forAll ((,) <$> point <*> segment) $ \(p, s) ->
        let Mm d = Distance.toPoint p s
            sampled = minimum [away p q | q <- samples 2000 s]
         in counterexample (show (d, sampled)) (d <= sampled + 1e-9 && sampled <= d + step 2000 s)
  it
    "segment to segment: no pair of samples is nearer, one is nearly as near (catches a common \
    \normal that is forgotten)"
    $ property $
      forAll ((,) <$> segment <*> segment) $ \(a, b) ->
        let ClosestPoint (Mm d) p = Distance.segments a b
            sampled = minimum [away q r | q <- samples 150 a, r <- samples 150 b]
            Mm there = Distance.toPoint p b
         in counterexample
              (show (d, sampled, there))
              ( d <= sampled + 1e-9
                  && sampled <= d + step 150 a + step 150 b
                  && abs (there - d) < 1e-6
              )
  it
    "uncovered: inside the sections of the answer the others are further than the reach, outside \
    \they are not (catches a missing boundary)"
    $ property $
      forAll ((,,) <$> segment <*> resize 6 (listOf segment) <*> choose (0.5, 30)) $
        \(s, others, reach) ->
          let gaps = Distance.uncovered (Mm reach) others s
              far p = and [d > reach | o <- others, let Mm d = Distance.toPoint p o]
              nearEdge t = any (\(a, b) -> abs (t - a) < 1e-6 || abs (t - b) < 1e-6) gaps
           in conjoin
                [ counterexample
                    (show (t, gaps))
                    (nearEdge t || far (Segment.at t s) == any (\(a, b) -> t > a && t < b) gaps)
                  | k <- [0 .. 200 :: Int],
                    let t = fromIntegral k / 200
                ]
  it
    "uncovered: of a circle, at a reach of 0, all that an arc on it does not cover (catches ends \
    \that bound nothing)"
    $ property $
      forAll ((,,,) <$> point <*> choose (1, 40) <*> choose (0, 3) <*> choose (0.1, 3)) $
        \(c, r, from, turned) ->
          let at a = Vec.shift (Vec.polar (Mm r) (Rad a)) c
              circle = Arc {start = at 0, end = at 0, centre = c, sweep = Rad (2 * pi)}
              covering =
                Arc {start = at from, end = at (from + turned), centre = c, sweep = Rad turned}
              gaps = Distance.uncovered (Mm 0) [covering] circle
           in conjoin
                [ counterexample
                    (show (a, gaps))
                    (any (\(t, u) -> t * 2 * pi < a && a < u * 2 * pi) gaps)
                  | k <- [1 .. 99 :: Int],
                    let a = from + turned + (2 * pi - turned) * fromIntegral k / 100,
                    a < 2 * pi
                ]

samples :: Int -> Segment -> [Point]
samples n s = [Segment.at (fromIntegral k / fromIntegral n) s | k <- [0 .. n]]

-- | The distance between neighbouring samples.
step :: Int -> Segment -> Double
step n s = let Mm l = Segment.length s in l / fromIntegral n
