-- | Cubic spans of a curve: the curve's own spans, or a cubic approximation of a shifted curve.
-- Cubics have an error bound in closed form when arcs are fitted to them.
--
-- The approximation consists of Hermite cubics: each has the points and the derivatives of the
-- curve at both ends of an interval. Let t be the fraction of the interval, from 0 to 1. Where the
-- curve is smooth, the Hermite cubic differs from it by t²(1−t)²·(c + d(t−½) + …) with constants c
-- and d. At the middle, the points differ by c/16 and the derivatives by d/16. Halving an interval
-- divides c by 16 and d by 32.
module Geometry.Curve.CubicSpans
  ( along,
  )
where

import Base.Quantity (Mm (..))
import Data.Vector qualified as Vector
import Geometry.Curve.BasisCurve (SpanList (..), spanList)
import Geometry.Curve.PointSearch qualified as PointSearch
import Geometry.Curve.ShiftedCurve (Curve (..))
import Geometry.Curve.ShiftedCurve qualified as ShiftedCurve
import Geometry.Curve.Spline (Cubic (..), Cubics)
import Geometry.Curve.Spline qualified as Spline
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Tolerance qualified as Tolerance
import Linear.V2 (V2 (..))

-- | Bound of the error in mm, and the cubic spans in x and in y. They are within the tolerance of
-- the curve. Polynomial spans of an unshifted curve are returned unchanged, with the bound 0. The
-- result is Nothing for an unshifted curve with arcs, and for a shifted curve whose speed is 0 or
-- nearly 0. It is also Nothing if 'maxHalvings' halvings of an interval do not suffice.
along :: Mm -> Curve -> Maybe (Mm, Cubics, Cubics)
along (Mm tolerance) curve = case curve of
  Unshifted b -> case spanList b of
    Cubical xs ys -> Just (Mm 0, xs, ys)
    Mixed _ -> Nothing
  Shifted {} -> do
    halves <- traverse refineStretch (PointSearch.stretches curve)
    let spans = Vector.fromList (concat halves)
        part f = Spline.generate (Vector.length spans) (\i -> f (spans Vector.! i))
    Just (Mm tolerance, part inX, part inY)
  where
    refineStretch stretch@(a, b) =
      refine maxHalvings (between (node stretch) a (node stretch a) b (node stretch b))
    node stretch u =
      case ShiftedCurve.expansionAt 1 curve (PointSearch.positionWithin stretch curve u) of
        V2 x y ->
          Node
            (PowerSeries.value x)
            (PowerSeries.value y)
            (PowerSeries.coefficient 1 x)
            (PowerSeries.coefficient 1 y)
    refine remaining interval@Interval {begin, end, first, middleNode, final, nodeAt}
      | not (speed first > still && speed final > still && speed middleNode > still) = Nothing
      | areHalvesNear tolerance interval firstHalf secondHalf =
        Just [hermiteSpan firstHalf, hermiteSpan secondHalf]
      | remaining <= 0 = Nothing
      | otherwise = (<>) <$> refine (remaining - 1) firstHalf <*> refine (remaining - 1) secondHalf
      where
        m = middle begin end
        firstHalf = between nodeAt begin first m middleNode
        secondHalf = between nodeAt m middleNode end final
    Mm still = Tolerance.stationary

-- | Largest count of successive halvings of one interval, after which the approximation is given
-- up.
maxHalvings :: Int
maxHalvings = 24

-- | Point of the curve, in mm, and derivative, in mm per unit of the curve's parameter. The order
-- is x, y, x′, y′.
data Node = Node Double Double Double Double

-- | Speed at a node, in mm per unit of the parameter.
speed :: Node -> Double
speed (Node _ _ vx vy) = sqrt (vx * vx + vy * vy)

-- | Interval between the parameters @begin@ and @end@ of the curve, with the nodes at both ends and
-- at the middle. @nodeAt@ gives the node at any parameter of the curve.
data Interval = Interval
  { begin, end :: Double,
    first, middleNode, final :: Node,
    nodeAt :: Double -> Node
  }

-- | Interval from parameter @begin@ with node @first@ to parameter @end@ with node @final@. The
-- node at the middle is computed by @nodeAt@.
between :: (Double -> Node) -> Double -> Node -> Double -> Node -> Interval
between nodeAt begin first end final =
  Interval {begin, end, first, middleNode = nodeAt (middle begin end), final, nodeAt}

-- | Mean of two parameters.
middle :: Double -> Double -> Double
middle a b = 0.5 * (a + b)

-- | Span with a cubic in x and one in y, in mm, over a local parameter from 0 to 1.
data Span = Span {inX :: Cubic, inY :: Cubic}

-- | Span of the Hermite cubics over an interval, by its nodes at both ends.
hermiteSpan :: Interval -> Span
hermiteSpan Interval {begin, end, first = Node px py vx vy, final = Node qx qy wx wy} =
  Span {inX = hermite px qx (h * vx) (h * wx), inY = hermite py qy (h * vy) (h * wy)}
  where
    h = end - begin
    hermite p q v w = Cubic p v (3 * (q - p) - 2 * v - w) (2 * (p - q) + v + w)

-- | True if the Hermite cubics of both halves of an interval are within @tolerance@ (mm) of the
-- curve, so that neither half is halved again. 'difference' gives two numbers for an interval, one
-- for the points and one for the derivatives. Both numbers of the whole interval must be so small
-- that those of its halves are expected to be at most half of the tolerance. Then the error of each
-- half, computed from its own two numbers, must be at most the tolerance.
areHalvesNear :: Double -> Interval -> Interval -> Interval -> Bool
areHalvesNear tolerance interval firstHalf secondHalf =
  points <= 8 * tolerance && derivatives <= 16 * tolerance && all isNear [firstHalf, secondHalf]
  where
    (points, derivatives) = difference interval
    isNear half = let (e, o) = difference half in e + oddShare * o <= tolerance
    -- The maximum of t²(1−t)²·(t−½), which is √5/250 at t = ½ + √(1/20), divided by the derivative
    -- of this function at the middle, 1/16.
    oddShare = 16 * sqrt 5 / 250

-- | Differences between curve and Hermite cubic at the middle of an interval, in mm. The first is
-- that of the points, the second that of the derivatives by the fraction t of the interval. Each is
-- the sum of the absolute differences in x and in y, which is an upper bound of the distance.
difference :: Interval -> (Double, Double)
difference
  Interval
    { begin,
      end,
      first = Node px py vx vy,
      middleNode = Node mx my sx sy,
      final = Node qx qy wx wy
    } =
    ( pointDifference px mx qx vx wx + pointDifference py my qy vy wy,
      derivativeDifference px sx qx vx wx + derivativeDifference py sy qy vy wy
    )
    where
      h = end - begin
      pointDifference p m q v w = abs (0.5 * (p + q) + 0.125 * h * (v - w) - m)
      derivativeDifference p s q v w = abs (1.5 * (q - p) - h * (0.25 * (v + w) + s))
