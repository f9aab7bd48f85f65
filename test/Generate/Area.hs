-- | Random areas of lines and arcs, with holes.
module Generate.Area
  ( area,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Geometry.Carrier (Circle (Circle), Sense (Clockwise))
import Geometry.Distance qualified as Distance
import Geometry.Polyarc (Ends (Closed), Polyarc (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.SelfIntersection qualified as SelfIntersection
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.QuickCheck

-- | The loops of an area, which lies on their left: a star of lines and arcs about the origin, and
-- often a round or a square hole in its middle.
area :: Gen (NonEmpty Polyarc)
area = do
  count <- choose (3, 12)
  radii <- vectorOf count (elements [20, 25, 31, 40, 57])
  bulges <- vectorOf count (elements [0, 0, 0, 0.3, -0.1, -0.2, 1e-3, -1e-4])
  turn <- choose (0, 1)
  hole <- elements [[], [Polyarc Closed (ring :| [])], [square]]
  let corners = [corner turn count i r | (i, r) <- zip [0 :: Int ..] radii]
      sides = zipWith3 side corners (drop 1 corners <> take 1 corners) (map (scaled count) bulges)
      isWide = all (\s -> Distance.toPoint origin s > Mm 4) sides
  case sides of
    s : more
      | isWide,
        let outline = Polyarc Closed (s :| more),
        Nothing <- SelfIntersection.firstSelfIntersection outline ->
        pure (outline :| hole)
    _ -> area
  where
    origin = Vec.point 0 0
    ring = Segment.fullCircle Clockwise (Circle origin (Mm 3)) (Vec.point 3 0)
    corner turn count i r =
      let t = 2 * pi * (fromIntegral i + turn) / fromIntegral count
       in Vec.shift (Vec.polar (Mm r) (Rad t)) origin
    side p q b = if b == 0 then Straight p q else Segment.fromBulge p q b
    -- Arcs inwards stay clear of the middle and of one another.
    scaled count b = if b < 0 && count < 5 then 0 else b
    square = Polyarc Closed (lines' [(-2, -2), (-2, 2), (2, 2), (2, -2)])

-- | The lines that join points to a closed chain.
lines' :: [(Double, Double)] -> NonEmpty Segment
lines' ps = case zipWith Straight points (drop 1 points <> take 1 points) of
  s : more -> s :| more
  [] -> error "no points"
  where
    points = map (uncurry Vec.point) ps :: [Point]
