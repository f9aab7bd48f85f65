-- | The law of what lies beyond the reach of others.
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
import Test.QuickCheck
import Verify.Coverage (Beyond (..), Others (..))
import Verify.Coverage qualified as Coverage
import Prelude hiding (lines)

spec :: Spec
spec =
  it
    "what lies beyond the reach of a curve is found, and how far (catches a gap between the arcs \
    \that are walked past)"
    $ property $
      forAll
        ((,,,) <$> Curve.closed <*> choose (0, 1) <*> choose (-0.5, 0.5) <*> choose (0.5, 30))
        $ \(arcs, from, turned, l) ->
          forAll (choose (0.05, 10)) $ \r ->
            let arc = arcs !! floor (from * fromIntegral (length arcs - 1) :: Double)
                -- A stroke beside the curve that runs along it at first.
                out = Vec.scale r (Vec.left (Segment.startDirection arc))
                begin = Vec.shift out (Segment.start arc)
                stroke =
                  Straight
                    begin
                    ( Vec.shift
                        ( Vec.scale
                            l
                            (Vec.add (Segment.startDirection arc) (Vec.scale turned (Vec.unit out)))
                        )
                        begin
                    )
                others =
                  Others
                    { index = BoxTree.index BoundingBox.ofSegment arcs,
                      lines = (:| []),
                      counts = const True,
                      reach = Mm r,
                      allowance = Mm 0.03
                    }
                beyond p = minimum [d | a <- arcs, let { Mm d = Distance.toPoint p a }] - r
                sampled = maximum [beyond (Segment.at (k / 400) stroke) | k <- [0 .. 400]]
             in classify (sampled > 0.01) "beyond" $
                  case Coverage.furthest others Nothing (Mm 0.01) stroke of
                    Nothing -> counterexample (show sampled) (sampled <= 0.01 + 3e-6)
                    Just Beyond {most = Mm most, place} ->
                      counterexample
                        (show (most, sampled, beyond place))
                        (most >= sampled - 3e-6 && abs (beyond place - most) <= 1e-5)
