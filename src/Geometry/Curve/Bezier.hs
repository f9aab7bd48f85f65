-- | Bézier curves: polynomial or rational curves of one degree by their control points.
--
-- With the Bernstein polynomials B of the degree, the control points P and the weights w, the point
-- is @Σ B_i·w_i·P_i / Σ B_i·w_i@ (Piegl and Tiller, "The NURBS Book", sections 1.3 and 1.4). The
-- coordinates are kept as the Bernstein coefficients of x·w, of y·w and of w. All weights are
-- positive, so neither sum loses digits for a parameter from 0 to 1: the error of a point is about
-- @2·p·10⁻¹⁶@ of its largest coordinate, with the degree p.
module Geometry.Curve.Bezier
  ( -- * Weights
    Weights,
    WeightFault (..),
    weightsFor,

    -- * Curves
    Bezier,
    fromCoordinates,
    fromPoints,
    ellipse,
    degree,
    controlPoints,
    weights,
    ends,
    isPoint,
    cubics,
    expansion,
    direction,
    reversed,
    transformed,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (find)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Data.Vector.Unboxed qualified as Unboxed
import Geometry.Curve.Spline (Cubic (..))
import Geometry.Numeric.Bernstein (Bernstein)
import Geometry.Numeric.Bernstein qualified as Bernstein
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion (Approach (..), TaylorExpansion)
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Linear.V2 (V2 (..))

-- Weights -----------------------------------------------------------------------------------------

-- | Weights of the control points of a curve: positive numbers without unit.
newtype Weights = Weights (Unboxed.Vector Double)
  deriving stock (Eq, Show)

-- | Reason why numbers are not the weights of a curve. Weights are counted from 1.
data WeightFault
  = -- | the count of the weights, which is not that of the points
    WeightCount Int
  | -- | the weight with this number is not above 0, or not finite
    NoWeight Int Double
  | -- | the numbers of the least and of the largest weight; their quotient exceeds
    -- 'Tolerance.weightRatio'
    UnevenWeights Int Int
  deriving stock (Eq, Show)

-- | Weights of @count@ control points.
weightsFor :: Int -> [Double] -> Either WeightFault Weights
weightsFor count list
  | length list /= count = Left (WeightCount (length list))
  | Just (k, w) <- find (not . isWeight . snd) (zip [1 ..] list) = Left (NoWeight k w)
  | count > 0 && largest > Tolerance.weightRatio * least =
    Left (UnevenWeights (1 + Unboxed.minIndex flat) (1 + Unboxed.maxIndex flat))
  | otherwise = Right (Weights flat)
  where
    flat = Unboxed.fromList list
    (least, largest) = (Unboxed.minimum flat, Unboxed.maximum flat)
    isWeight w = w > 0 && not (isInfinite w)

-- Curves ------------------------------------------------------------------------------------------

-- | Curve over a parameter from 0 to 1. There are no weights if all of them are 1.
data Bezier = Bezier
  { weightedX, weightedY :: Bernstein,
    weightPolynomial :: Maybe Bernstein
  }
  deriving stock (Eq, Show)

-- | Curves by the Bernstein coefficients of some polynomials. The function @spans@ gives the
-- coefficients of consecutive spans for the numbers at the control points, and is linear. It is
-- applied to x·w, to y·w and to w.
fromCoordinates ::
  (Unboxed.Vector Double -> [Bernstein]) -> Vector Point -> Maybe Weights -> [Bezier]
fromCoordinates spans points ws = case ws of
  Just (Weights w)
    | Unboxed.any (/= Unboxed.head w) w ->
      zipWith3
        (\x y v -> Bezier x y (Just v))
        (spans (Unboxed.zipWith (*) w xs))
        (spans (Unboxed.zipWith (*) w ys))
        (spans w)
  _ -> zipWith (\x y -> Bezier x y Nothing) (spans xs) (spans ys)
  where
    xs = Unboxed.convert (Vector.map Vec.x points)
    ys = Unboxed.convert (Vector.map Vec.y points)

-- | Curve by its control points, of which there are at least two.
fromPoints :: Vector Point -> Maybe Weights -> [Bezier]
fromPoints = fromCoordinates pure

-- | Part of an ellipse about a centre with the semi-axes @a@ and @b@ in mm; the first one has the
-- direction @turn@. Its parameter angle goes from @begin@ to @end@: the points are
-- @(a·cos θ, b·sin θ)@ in the directions of the axes. Each span has an equal part of the angle, at
-- most a quarter turn. With half of this part, φ, its inner control point is the intersection of
-- the tangents at its ends and has the weight cos φ (Piegl and Tiller, section 7.3).
ellipse :: Point -> Mm -> Mm -> Rad -> Rad -> Rad -> NonEmpty Bezier
ellipse centre (Mm a) (Mm b) turn (Rad begin) (Rad end) = fmap part (NonEmpty.fromList [1 .. count])
  where
    count = max 1 (ceiling (abs (end - begin) / (pi / 2) - Tolerance.equal)) :: Int
    half = (end - begin) / fromIntegral (2 * count)
    angle k
      | k == count = end
      | otherwise = begin + 2 * half * fromIntegral k
    place size t =
      Vec.shift (Vec.rotate turn (Vec.vec (size * a * cos t) (size * b * sin t))) centre
    part k = weighted (cos half) (place 1 s) (place (1 / cos half) ((s + t) / 2)) (place 1 t)
      where
        (s, t) = (angle (k - 1), angle k)
    weighted w p q r =
      Bezier
        { weightedX = Unboxed.fromList [Vec.x p, w * Vec.x q, Vec.x r],
          weightedY = Unboxed.fromList [Vec.y p, w * Vec.y q, Vec.y r],
          weightPolynomial = Just (Unboxed.fromList [1, w, 1])
        }

-- | Degree of a curve, at least 1.
degree :: Bezier -> Int
degree = Bernstein.degree . weightedX

-- | Control points in order.
controlPoints :: Bezier -> [Point]
controlPoints c = map (controlPoint c) [0 .. degree c]

-- | Control point with an index from 0 to the degree.
controlPoint :: Bezier -> Int -> Point
controlPoint c i = Vec.point (weightedX c Unboxed.! i / w) (weightedY c Unboxed.! i / w)
  where
    w = maybe 1 (Unboxed.! i) (weightPolynomial c)

-- | Weights of the control points in order.
weights :: Bezier -> [Double]
weights c = maybe (replicate (degree c + 1) 1) Unboxed.toList (weightPolynomial c)

-- | Start and end of a curve: its first and last control point.
ends :: Bezier -> (Point, Point)
ends c = (controlPoint c 0, controlPoint c (degree c))

-- | True if all control points coincide with the first.
isPoint :: Bezier -> Bool
isPoint c = all (Vec.isNear (controlPoint c 0)) (controlPoints c)

-- | Curve as a cubic in x and one in y; Nothing if it is rational or has a higher degree.
cubics :: Bezier -> Maybe (Cubic, Cubic)
cubics c
  | degree c <= 3 && null (weightPolynomial c) =
    Just (cubic (weightedX c), cubic (weightedY c))
  | otherwise = Nothing
  where
    cubic b = case Bernstein.powers b <> repeat 0 of
      c0 : c1 : c2 : c3 : _ -> Cubic c0 c1 c2 c3
      _ -> Cubic 0 0 0 0

-- | Taylor expansion of the point, in mm, about the parameter @t@, up to the power @n@.
expansion :: Int -> Bezier -> Double -> TaylorExpansion
expansion n Bezier {weightedX, weightedY, weightPolynomial} t = case weightPolynomial of
  Nothing -> V2 x y
  Just ws -> let w = Bernstein.series n ws t in V2 (PowerSeries.divide x w) (PowerSeries.divide y w)
  where
    x = Bernstein.series n weightedX t
    y = Bernstein.series n weightedY t

-- | Direction of travel just before or just after the parameter @t@, of length 1. It holds even
-- where any number of derivatives is 0. The curve on this side of @t@ is a Bézier curve itself; its
-- direction at @t@ leads from its first control point to the next one that differs from it. The
-- other control points are the farther ones of those that are all near to the first.
direction :: Approach -> Bezier -> Double -> Vec
direction approach c t = case approach of
  After -> leaving (partFrom t c)
  Before -> Vec.negate (leaving (partFrom (1 - t) (reversed c)))
  where
    leaving part = case map (Vec.to (controlPoint part 0)) (controlPoints part) of
      vs
        | Just v <- find ((> Tolerance.stationary) . Mm . Vec.norm) vs -> Vec.unit v
        | v : _ <- filter ((> 0) . Vec.norm) vs -> Vec.unit v
        | otherwise -> Vec.vec 1 0

-- | Part of a curve from the parameter @t@ to 1.
partFrom :: Double -> Bezier -> Bezier
partFrom t = mapCoordinates (Bernstein.from t)

-- | Curve in the opposite direction.
reversed :: Bezier -> Bezier
reversed = mapCoordinates Unboxed.reverse

-- | Curve after a linear function was applied to the polynomials of x·w, of y·w and of w.
mapCoordinates :: (Bernstein -> Bernstein) -> Bezier -> Bezier
mapCoordinates f Bezier {weightedX, weightedY, weightPolynomial} =
  Bezier
    { weightedX = f weightedX,
      weightedY = f weightedY,
      weightPolynomial = fmap f weightPolynomial
    }

-- | Image of a curve under a similarity: that of its control points.
transformed :: Transformation -> Bezier -> Bezier
transformed s c@Bezier {weightPolynomial} =
  Bezier
    { weightedX = weightedBy (map Vec.x points),
      weightedY = weightedBy (map Vec.y points),
      weightPolynomial
    }
  where
    points = map (Transformation.point s) (controlPoints c)
    weightedBy = Unboxed.fromList . zipWith (*) (weights c)
