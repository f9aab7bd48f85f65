-- | Lines and arcs: places along them.
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
    "places on very flat arcs are the same from either end (catches a place about a centre that is \
    \far away)"
    $ forAll flatArc $ \arc -> forAll share $ \t ->
      Vec.distance (Segment.at t arc) (Segment.at (1 - t) (Segment.reverse arc)) `atMost` Mm 1e-11
  it
    "places on very flat arcs are as high above the chord as an arc is (catches a line instead of \
    \the arc)"
    $ forAll flatArc $ \arc -> forAll share $ \t -> case arc of
      Arc {start, end, sweep = Rad s} ->
        let c = Vec.to start end
            Mm chord = Vec.distance start end
            height = Vec.cross c (Vec.to start (Segment.at t arc)) / chord
         in Mm (abs (height + chord * s * t * (1 - t) / 2)) `atMost` Mm 1e-11
      Straight _ _ -> property False

atMost :: Mm -> Mm -> Property
atMost d most = counterexample (show d) (d <= most)

-- | An arc between two places, of less than a ten-thousandth, about a centre up to many kilometres
-- away.
flatArc :: Gen Segment
flatArc = do
  start <- place
  end <- place `suchThat` (\p -> Vec.distance start p > Mm 0.1)
  size <- choose (-9, -4.1)
  sense <- elements [1, -1]
  let s = sense * 10 ** size
      centre =
        Vec.shift
          (Vec.scale (1 / (2 * tan (s / 2))) (Vec.left (Vec.to start end)))
          (Vec.between 0.5 start end)
  pure Arc {start, end, centre, sweep = Rad s}

place :: Gen Point
place = Vec.point <$> choose (-100, 100) <*> choose (-100, 100)

share :: Gen Double
share = choose (0, 1)
