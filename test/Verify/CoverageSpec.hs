-- | Law of 'Verify.Coverage': the largest gap of a motion beside a curve, compared with samples.
module Verify.CoverageSpec (spec) where

import Base.Quantity (Mm (..))
import Data.List.NonEmpty (NonEmpty (..))
import Generate.Run qualified as Curve
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck hiding (cover)
import Verify.Coverage (Cover (..), Gap (..))
import Verify.Coverage qualified as Coverage

spec :: Spec
spec =
  it
    "the largest gap beyond the reach of a curve is found, and its size (catches a gap between two \
    \arcs that is passed over)"
    $ property $
      forAll
        ((,,,) <$> Curve.closed <*> choose (0, 1) <*> choose (-0.5, 0.5) <*> choose (0.5, 30))
        $ \(arcs, fraction, slope, long) ->
          forAll (choose (0.05, 10)) $ \r ->
            let arc = arcs !! floor (fraction * fromIntegral (length arcs - 1) :: Double)
                motion = besideStart arc r slope long
                cover =
                  Cover
                    { index = BoxTree.index BoundingBox.ofSegment arcs,
                      pathsOf = (:| []),
                      isEligible = const True,
                      reach = Mm r,
                      allowance = Mm 0.03
                    }
                excess p = minimum [d | a <- arcs, let { Mm d = Distance.toPoint p a }] - r
                sampled = maximum [excess (Segment.at (k / 400) motion) | k <- [0 .. 400]]
             in classify (sampled > 0.01) "beyond" $
                  case Coverage.largestGap cover Nothing (Mm 0.01) motion of
                    Nothing -> counterexample (show sampled) (sampled <= 0.01 + 3e-6)
                    Just Gap {size = Mm size, location} ->
                      counterexample
                        (show (size, sampled, excess location))
                        (size >= sampled - 3e-6 && abs (excess location - size) <= 1e-5)

-- | Line that starts beside the start of an arc, at a distance to its left, and leaves the
-- direction of the arc by a slope; its length in mm.
besideStart :: Segment -> Double -> Double -> Double -> Segment
besideStart arc r slope long = Straight begin (Vec.shift (Vec.scale long direction) begin)
  where
    out = Vec.scale r (Vec.left (Segment.startDirection arc))
    begin = Vec.shift out (Segment.start arc)
    direction = Vec.add (Segment.startDirection arc) (Vec.scale slope (Vec.unit out))
