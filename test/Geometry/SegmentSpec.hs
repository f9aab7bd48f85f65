-- | Points along lines and arcs.
module Geometry.SegmentSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it
    "points on very flat arcs are the same from either end (catches a point computed from a \
    \distant centre)"
    $ forAll flatArc $ \arc -> forAll share $ \t ->
      Vec.distance (Segment.at t arc) (Segment.at (1 - t) (Segment.reverse arc)) `atMost` Mm 1e-11
  it
    "points on very flat arcs have the height of an arc above the chord (catches a line in place \
    \of the arc)"
    $ forAll flatArc $ \arc -> forAll share $ \t -> case arc of
      Arc {start, end, sweep = Rad s} ->
        let c = Vec.to start end
            Mm chord = Vec.distance start end
            height = Vec.cross c (Vec.to start (Segment.at t arc)) / chord
         in Mm (abs (height + chord * s * t * (1 - t) / 2)) `atMost` Mm 1e-11
      Straight _ _ -> property False

atMost :: Mm -> Mm -> Property
atMost d most = counterexample (show d) (d <= most)

-- | An arc between two points that sweeps less than 10⁻⁴; its centre is up to many kilometres away.
flatArc :: Gen Segment
flatArc = do
  start <- point
  end <- point `suchThat` (\p -> Vec.distance start p > Mm 0.1)
  size <- choose (-9, -4.1)
  sign <- elements [1, -1]
  pure (Segment.fromBulge start end (tan (sign * 10 ** size / 4)))

point :: Gen Point
point = Vec.point <$> choose (-100, 100) <*> choose (-100, 100)

share :: Gen Double
share = choose (0, 1)
