-- | Spans: the consecutive parts of a curve. A span has a local parameter from 0 to 1.
module Geometry.Curve.Span
  ( Span (..),
    SpanShape (..),
    fromShape,
    fromSegment,
    fromBezier,
    ends,
    segment,
    isPoint,
    expansion,
    direction,
    degree,
    reversed,
    transformed,
    image,
  )
where

import Base.Quantity (Rad (..))
import Geometry.Curve.Bezier (Bezier)
import Geometry.Curve.Bezier qualified as Bezier
import Geometry.Curve.Spline (Cubic (..))
import Geometry.Curve.Spline qualified as Spline
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion (Approach, TaylorExpansion)
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Linear.V2 (V2 (..))

-- | Part of a curve over a local parameter from 0 to 1.
data Span
  = -- | a cubic in x and one in y, in mm
    Polynomial Cubic Cubic
  | -- | an arc, along which the parameter is proportional to the length
    Round Segment
  | -- | a Bézier curve that is rational or has a degree above 3
    Controlled Bezier
  deriving stock (Eq, Show)

-- | Shape of a part of a curve, as a part program or an input sheet gives it.
data SpanShape
  = -- | a straight line from one point to another
    Line Point Point
  | -- | the parabola @y = a·x² + b·x + c@ from one x to another; the fields are a in 1/mm, b
    -- without unit, c in mm, the first x in mm and the last x in mm
    Quadratic Double Double Double Double Double
  | -- | an arc
    Circular Segment
  deriving stock (Eq, Show)

-- | Span with the given shape.
fromShape :: SpanShape -> Span
fromShape shape = case shape of
  Line p q -> Polynomial (Spline.line (Vec.x p) (Vec.x q)) (Spline.line (Vec.y p) (Vec.y q))
  Quadratic a b c from to ->
    let d = to - from
     in Polynomial
          (Spline.line from to)
          (Cubic (c + from * (b + from * a)) (d * (b + 2 * a * from)) (a * d * d) 0)
  Circular s -> fromSegment s

-- | Span along a line or an arc.
fromSegment :: Segment -> Span
fromSegment s = case s of
  Straight p q -> fromShape (Line p q)
  Arc {} -> Round s

-- | Span along a Bézier curve: a pair of cubics if it is a polynomial of degree 3 or less.
fromBezier :: Bezier -> Span
fromBezier c = maybe (Controlled c) (uncurry Polynomial) (Bezier.cubics c)

-- | Start and end of a span.
ends :: Span -> (Point, Point)
ends s = case s of
  Polynomial x y ->
    let place t =
          Vec.point (Spline.value x t) (Spline.value y t)
     in (place 0, place 1)
  Round g -> (Segment.start g, Segment.end g)
  Controlled c -> Bezier.ends c

-- | Span as a segment; Nothing if it is neither a line nor an arc.
segment :: Span -> Maybe Segment
segment s = case s of
  Polynomial (Cubic _ _ 0 0) (Cubic _ _ 0 0) -> let (p, q) = ends s in Just (Straight p q)
  Polynomial _ _ -> Nothing
  Round g -> Just g
  Controlled _ -> Nothing

-- | True if a span counts as a point, so that a curve cannot contain it. A span of polynomials
-- counts as a point if all its control points coincide, an arc if its length is at most
-- 'Tolerance.coincident'. So a full circle and a loop are not points.
isPoint :: Span -> Bool
isPoint s = case s of
  Polynomial x y ->
    let p = Vec.point (Spline.value x 0) (Spline.value y 0)
     in and (zipWith (\a b -> Vec.isNear p (Vec.point a b)) (Spline.controls x) (Spline.controls y))
  Round g -> Segment.length g <= Tolerance.coincident
  Controlled c -> Bezier.isPoint c

-- | Taylor expansion of the point of a span, in mm, about the local parameter @t@, up to the power
-- @n@.
expansion :: Int -> Span -> Double -> TaylorExpansion
expansion n s t = case s of
  Polynomial x y -> V2 (Spline.series n x t) (Spline.series n y t)
  Round (Arc {start, centre, sweep = Rad sweep}) ->
    -- Each derivative is the previous one, rotated by a quarter turn and multiplied by the sweep.
    let rotated = Vec.rotate (Rad (sweep * t)) (Vec.to centre start)
        factors = scanl (\k j -> k * sweep / j) 1 [1 ..]
        terms = zipWith Vec.scale factors (iterate Vec.left rotated)
     in fromCoefficients n centre terms
  Round (Straight p q) -> fromCoefficients n p [Vec.scale t (Vec.to p q), Vec.to p q]
  Controlled c -> Bezier.expansion n c t

-- | Direction of travel just before or just after the local parameter @t@, of length 1, even where
-- the speed is 0. Nothing if the span is a point.
direction :: Approach -> Span -> Double -> Maybe Vec
direction approach s t = case s of
  Polynomial _ _ -> TaylorExpansion.direction approach (expansion 3 s t)
  Round _ -> TaylorExpansion.direction approach (expansion 1 s t)
  Controlled c -> Just (Bezier.direction approach c t)

-- | Degree of the polynomials of a span; that of an arc, by its length, counts as 3.
degree :: Span -> Int
degree s = case s of
  Polynomial _ _ -> 3
  Round _ -> 3
  Controlled c -> Bezier.degree c

-- | Taylor expansion up to the power @n@. @terms@ are the coefficients of the powers from 0 on; the
-- point @p@ is added to the first of them.
fromCoefficients :: Int -> Point -> [Vec] -> TaylorExpansion
fromCoefficients n p terms =
  V2 (part (Vec.x p) (map fst parts)) (part (Vec.y p) (map snd parts))
  where
    parts = map components (take (n + 1) terms)
    part :: Double -> [Double] -> PowerSeries
    part c cs = PowerSeries.plusConstant c (PowerSeries.fromList n cs)

-- | Span in the opposite direction.
reversed :: Span -> Span
reversed s = case s of
  Polynomial x y -> Polynomial (Spline.reversed x) (Spline.reversed y)
  Round g -> Round (Segment.reverse g)
  Controlled c -> Controlled (Bezier.reversed c)

-- | Image of a span under a similarity. For cubics, the constant coefficients are mapped as a point
-- and the coefficients of each higher power as a displacement.
transformed :: Transformation -> Span -> Span
transformed s g = case g of
  Polynomial (Cubic x0 x1 x2 x3) (Cubic y0 y1 y2 y3) ->
    let p = Transformation.point s (Vec.point x0 y0)
        (a1, b1) = components (image s (Vec.vec x1 y1))
        (a2, b2) = components (image s (Vec.vec x2 y2))
        (a3, b3) = components (image s (Vec.vec x3 y3))
     in Polynomial (Cubic (Vec.x p) a1 a2 a3) (Cubic (Vec.y p) b1 b2 b3)
  Round arc -> Round (Transformation.segment s arc)
  Controlled c -> Controlled (Bezier.transformed s c)

-- | Image of the displacement @v@: it is rotated, scaled and reflected, but not moved.
image :: Transformation -> Vec -> Vec
image s v = Vec.to (Transformation.point s origin) (Transformation.point s (Vec.shift v origin))
  where
    origin = Vec.point 0 0

-- | x and y of a displacement in mm.
components :: Vec -> (Double, Double)
components v = (Vec.dot v (Vec.vec 1 0), Vec.dot v (Vec.vec 0 1))
