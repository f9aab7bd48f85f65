-- | The bounds by which two motions together clear a square of a pocket's floor.
module Verify.PocketFloorSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck
import Verify.PocketFloor (DistanceBound (..))
import Verify.PocketFloor qualified as PocketFloor

spec :: Spec
spec =
  it
    "a point of a disc is no further from a segment than the bound, or beyond the segment than the \
    \disc's radius"
    $ withMaxSuccess 3000 $
      forAll segment $ \s ->
        forAll (near s) $ \p ->
          forAll ((,) <$> choose (0.05, 2) <*> ((,) <$> choose (0, 1) <*> choose (0, 2 * pi))) $
            \(radius, (share, angle)) ->
              case PocketFloor.boundAround p radius s of
                Nothing -> discard
                Just DistanceBound {atCentre, gradient, bend} ->
                  let r = radius * share
                      v = Vec.vec (r * cos angle) (r * sin angle)
                      q = Vec.shift v p
                      Mm d = Distance.toPoint q s
                      bound = atCentre + Vec.dot gradient v + bend * r * r / 2
                      isBeyond = not (null (Distance.intersections (Straight p q) s))
                   in counterexample (show (d, bound)) $
                        d <= (if isBeyond then radius else bound) + 1e-9

-- | A line, or an arc of up to a full circle.
segment :: Gen Segment
segment = oneof [Straight <$> point <*> point, arc]
  where
    point = Vec.point <$> choose (-6, 6) <*> choose (-6, 6)
    arc = do
      centre <- point
      r <- choose (0.3, 6)
      from <- choose (0, 2 * pi)
      turned <- oneof [choose (0.05, 2 * pi), pure (2 * pi)]
      sense <- elements [1, -1]
      let at a = Vec.shift (Vec.vec (r * cos a) (r * sin a)) centre
      pure
        Arc
          { start = at from,
            end = at (from + sense * turned),
            centre,
            sweep = Rad (sense * turned)
          }

-- | A point within 3 mm of a segment.
near :: Segment -> Gen Point
near s = do
  t <- choose (0, 1)
  v <- Vec.vec <$> choose (-3, 3) <*> choose (-3, 3)
  pure (Vec.shift v (Segment.at t s))
