-- | A curve as cubic spans: its own, or cubics that stand for a shifted one.
--
-- Between two places h apart in the parameter, Hermite's cubic has the places P and the derivatives V of both. It differs from the
-- curve by the fourth derivative times h⁴/384 in the middle, and 16 times less where it is put in two halves.
module Geometry.Curve.Cubics
  ( along,
  )
where

import Base.Quantity (Mm (..))
import Data.Vector qualified as Vector
import Geometry.Curve.Base (Course (..), course)
import Geometry.Curve.Layered (Curve (..))
import Geometry.Curve.Layered qualified as Layered
import Geometry.Curve.Search qualified as Search
import Geometry.Jet (Jet (..))
import Geometry.Series qualified as Series
import Geometry.Spline (Cubic (..), Cubics)
import Geometry.Spline qualified as Spline
import Geometry.Tolerance qualified as Tolerance

-- | Spans in x and y that stay so near to a curve, and how near; those of a spline are its own. Nothing for a curve with arcs, and for one that
-- stands still somewhere or nearly so.
along :: Mm -> Curve -> Maybe (Mm, Cubics, Cubics)
along (Mm tolerance) curve = case curve of
  Plain b -> case course b of
    Cubical xs ys -> Just (Mm 0, xs, ys)
    Mixed _ -> Nothing
  Shifted {} -> do
    halves <- traverse onStretch (Search.stretches curve)
    let spans = Vector.fromList (concat halves)
        part f = Spline.generate (Vector.length spans) (\i -> f (spans Vector.! i))
    Just (Mm tolerance, part inX, part inY)
  where
    onStretch (a, b) = refined most a b (node (a, b) a) (node (a, b) b)
    node stretch u = case Layered.jetAt 1 curve (Search.within stretch curve u) of
      Jet x y -> Node (Series.value x) (Series.value y) (Series.coefficient 1 x) (Series.coefficient 1 y)
    refined left a b from to
      | not (speed from > still && speed to > still && speed inside > still) = Nothing
      | near from inside to (b - a) tolerance = Just [span' from inside (m - a), span' inside to (b - m)]
      | left <= 0 = Nothing
      | otherwise = (<>) <$> refined (left - 1) a m from inside <*> refined (left - 1) m b inside to
      where
        m = 0.5 * (a + b)
        inside = node (a, b) m
    Mm still = Tolerance.still

-- | How often a stretch is halved.
most :: Int
most = 24

-- | A place and the derivative there, in mm for 1 of the parameter.
data Node = Node Double Double Double Double

speed :: Node -> Double
speed (Node _ _ vx vy) = sqrt (vx * vx + vy * vy)

-- | A cubic in x and one in y.
data Span = Span {inX :: Cubic, inY :: Cubic}

-- | Hermite's cubics between two nodes so far apart in the parameter.
span' :: Node -> Node -> Double -> Span
span' (Node px py vx vy) (Node qx qy wx wy) h = Span {inX = hermite px qx (h * vx) (h * wx), inY = hermite py qy (h * vy) (h * wy)}
  where
    hermite p q v w = Cubic p v (3 * (q - p) - 2 * v - w) (2 * (p - q) + v + w)

-- | Whether the cubics of both halves of a stretch, whose nodes are at its ends and in its middle, stay so near to the curve: what the cubic
-- of the whole differs by in the middle is 16 times as much. An odd difference does not tell in the place there, but in the derivative.
near :: Node -> Node -> Node -> Double -> Double -> Bool
near (Node px py vx vy) (Node mx my sx sy) (Node qx qy wx wy) h tolerance = off px mx qx vx wx + off py my qy vy wy <= 8 * tolerance && h * (bent px sx qx vx wx + bent py sy qy vy wy) <= 16 * tolerance
  where
    off p m q v w = abs (0.5 * (p + q) + 0.125 * h * (v - w) - m)
    bent p s q v w = abs (1.5 * (q - p) / h - 0.25 * (v + w) - s)
