-- | Random points and segments for tests.
module Geometry.RandomSegment
  ( point,
    segment,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.QuickCheck

-- | A point in a square of 100 mm.
point :: Gen Point
point = Vec.point <$> choose (-50, 50) <*> choose (-50, 50)

-- | A line, or an arc of any sweep in either sense, often a full circle.
segment :: Gen Segment
segment = oneof [straight, arc]
  where
    straight = Straight <$> point <*> point
    arc = do
      c <- point
      r <- oneof [choose (0.01, 2), choose (2, 40)]
      a <- choose (-4, 4)
      s <- oneof [choose (-6.28, 6.28), choose (-1.5, 1.5), elements [2 * pi, -2 * pi]]
      let begin = Vec.shift (Vec.polar (Mm r) (Rad a)) c
      pure
        Arc
          { start = begin,
            end = Vec.shift (Vec.polar (Mm r) (Rad (a + s))) c,
            centre = c,
            sweep = Rad s
          }
