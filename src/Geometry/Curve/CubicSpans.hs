-- | Cubic spans of a curve: the curve's own spans, or a cubic approximation of a shifted curve or
-- of one with other Bézier curves. Cubics have an error bound in closed form when arcs are fitted
-- to them. This fit needs a speed above 0 at the ends of all spans.
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
import Data.List (find)
import Data.Vector qualified as Vector
import Geometry.Curve.BasisCurve (SpanList (..), spanList)
import Geometry.Curve.PointSearch qualified as PointSearch
import Geometry.Curve.ShiftedCurve (Curve (..))
import Geometry.Curve.ShiftedCurve qualified as ShiftedCurve
import Geometry.Curve.Span (Span (Controlled, Polynomial, Round))
import Geometry.Curve.Spline (Cubic (..), Cubics)
import Geometry.Curve.Spline qualified as Spline
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion (Approach (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Vec)
import Geometry.Vec qualified as Vec
import Linear.V2 (V2 (..))

-- | Bound of the error in mm, and the cubic spans in x and in y. They are within the tolerance of
-- the curve. Pairs of cubics of an unshifted curve are returned unchanged, with the bound 0, unless
-- the speed is 0 at an end of one of them. The result is Nothing for an unshifted curve of arcs and
-- cubics. It is also Nothing for a shifted curve whose speed is 0 or nearly 0, for any curve with
-- such a speed at the middle of an interval, and if 'maxHalvings' halvings of an interval do not
-- suffice.
along :: Mm -> Curve -> Maybe (Mm, Cubics, Cubics)
along tolerance curve = case curve of
  Unshifted b -> case spanList b of
    Cubical xs ys
      | hasMovingEnds xs ys -> Just (Mm 0, xs, ys)
      | otherwise -> approximated
    Mixed parts
      | any isControlled parts -> approximated
      | otherwise -> Nothing
  Shifted {} -> approximated
  where
    approximated = do
      spans <- Vector.fromList . concat <$> traverse (stretchSpans tolerance curve) stretches
      let part f = Spline.generate (Vector.length spans) (\i -> f (spans Vector.! i))
      Just (tolerance, part inX, part inY)
    stretches = PointSearch.stretches curve
    isControlled s = case s of
      Controlled _ -> True
      Polynomial _ _ -> False
      Round _ -> False

-- | True if no speed at the ends of pairs of cubics counts as 0.
hasMovingEnds :: Cubics -> Cubics -> Bool
hasMovingEnds xs ys = all moves [0 .. Spline.count xs - 1]
  where
    moves i = isFast (rates 0) && isFast (rates 1)
      where
        rates t = (Spline.rate (Spline.at xs i) t, Spline.rate (Spline.at ys i) t)
    isFast (vx, vy) = vx * vx + vy * vy > still * still
    Mm still = Tolerance.stationary

-- | Cubic spans along a smooth stretch of a curve, which is given by its first and last parameter.
-- If an unshifted curve has the speed 0 at an end of the stretch, a cap takes the place of a part
-- there that is shorter than the tolerance.
stretchSpans :: Mm -> Curve -> (Double, Double) -> Maybe [CubicSpan]
stretchSpans (Mm tolerance) curve stretch@(a, b) = do
  (begin, before) <- ending After a b
  (end, after) <- ending Before b a
  inner <- refine tolerance maxHalvings (between node begin (node begin) end (node end))
  Just (before <> inner <> after)
  where
    ending approach u other
      | speed (node u) > still || isShifted = Just (u, [])
      | otherwise = do
        v <- find (isNear u) (take 60 (iterate (\w -> u + (w - u) / 2) (u + (other - u) / 8)))
        Just (v, [cap approach (PointSearch.unitTangent approach curve u) (node u) (node v)])
    isShifted = case curve of
      Shifted {} -> True
      Unshifted _ -> False
    isNear u v = apart (node u) (node v) <= 0.5 * tolerance && speed (node v) > still
    node u = case ShiftedCurve.expansionAt 1 curve (PointSearch.positionWithin stretch curve u) of
      V2 x y ->
        Node
          (PowerSeries.value x)
          (PowerSeries.value y)
          (PowerSeries.coefficient 1 x)
          (PowerSeries.coefficient 1 y)
    Mm still = Tolerance.stationary

-- | Span between the node at an end of a curve, at which the curve has the direction @d@, and the
-- node beside it. Its control points are no farther apart than the nodes.
cap :: Approach -> Vec -> Node -> Node -> CubicSpan
cap approach d end@(Node px py _ _) beside@(Node qx qy vx vy) = case approach of
  After -> hermite 1 there here
  Before -> hermite 1 here there
  where
    there = Node px py (Vec.dot d (Vec.vec h 0)) (Vec.dot d (Vec.vec 0 h))
    here = Node qx qy (h / v * vx) (h / v * vy)
    h = apart end beside
    v = speed beside

-- | Spans of the Hermite cubics over an interval that is halved, at most @remaining@ times, until
-- they are within @tolerance@ (mm).
refine :: Double -> Int -> Interval -> Maybe [CubicSpan]
refine tolerance remaining interval@Interval {begin, end, first, middleNode, final, nodeAt}
  | not (speed first > still && speed final > still && speed middleNode > still) = Nothing
  | areHalvesNear tolerance interval firstHalf secondHalf =
    Just [hermiteSpan firstHalf, hermiteSpan secondHalf]
  | remaining <= 0 = Nothing
  | otherwise =
    (<>)
      <$> refine tolerance (remaining - 1) firstHalf
      <*> refine tolerance (remaining - 1) secondHalf
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

-- | Distance in mm between the points of two nodes.
apart :: Node -> Node -> Double
apart (Node px py _ _) (Node qx qy _ _) = sqrt ((qx - px) * (qx - px) + (qy - py) * (qy - py))

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
data CubicSpan = CubicSpan {inX :: Cubic, inY :: Cubic}

-- | Span of the Hermite cubics over an interval, by its nodes at both ends.
hermiteSpan :: Interval -> CubicSpan
hermiteSpan Interval {begin, end, first, final} = hermite (end - begin) first final

-- | Span of the Hermite cubics between two nodes whose parameters differ by @h@.
hermite :: Double -> Node -> Node -> CubicSpan
hermite h (Node px py vx vy) (Node qx qy wx wy) =
  CubicSpan {inX = through px qx (h * vx) (h * wx), inY = through py qy (h * vy) (h * wy)}
  where
    through p q v w = Cubic p v (3 * (q - p) - 2 * v - w) (2 * (p - q) + v + w)

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
