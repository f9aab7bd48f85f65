-- | B-splines of any knots turned into splines with clamped ends.
--
-- A spline of degree p with the knots t₀, t₁, … and n control points is a curve over the parameters
-- from t_p to t_n. Knot insertion (Boehm, "Inserting new knots into B-spline curves") at both ends
-- gives control points at the ends of the curve, without changing it. Rational splines are computed
-- in homogeneous coordinates.
module Drawing.ClampedSpline
  ( fromKnots,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Data.IntSet qualified as IntSet
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Vector qualified as Vector
import Drawing.Drawing (PathPart (..), Shape (..), Spline (..))
import Drawing.Tolerance qualified as Tolerance
import Geometry.Polyarc (Ends (..))
import Geometry.Tolerance qualified as Geometry
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | A control point in homogeneous coordinates: weight·x, weight·y, weight.
data Control = Control Double Double Double
  deriving stock (Eq)

-- | Knots and control points in the course of the insertions.
data Net = Net {knotsOf :: Vector.Vector Double, controlsOf :: Vector.Vector Control}

-- | The path of the spline that has a degree, knots, control points and weights. @isClosed@ says
-- that the file calls the spline closed. The reason in 'Left' if the numbers make no spline.
fromKnots :: Bool -> Int -> [Double] -> [Point] -> Maybe [Double] -> Either Text Shape
fromKnots isClosed degree knots points weights
  | degree < 1 || degree > Geometry.largestDegree =
    Left ("its degree is not 1 to " <> Decimal.whole Geometry.largestDegree)
  | count <= degree = Left "it has too few control points"
  | Vector.length knotVector /= count + degree + 1 =
    Left "the count of its knots does not fit the count of its control points"
  | Vector.any id (Vector.zipWith (>) knotVector (Vector.drop 1 knotVector)) =
    Left "its knots do not ascend"
  | knotVector Vector.! degree >= knotVector Vector.! count = Left "all its knots are equal"
  | maybe False ((/= count) . length) weights =
    Left "the count of its weights does not fit the count of its control points"
  | maybe False (any (<= 0)) weights = Left "a weight is not positive"
  | otherwise = withoutBreaks degree clamped >>= path isClosed degree (weights >>= distinct)
  where
    count = length points
    knotVector = Vector.fromList knots
    clamped = reversed (clampStart degree (reversed (clampStart degree net)))
    net = Net {knotsOf = knotVector, controlsOf = Vector.fromList (zipWith control points ws)}
    ws = fromMaybe (repeat 1) (weights >>= distinct)
    control p w = Control (w * Vec.x p) (w * Vec.y p) w

-- | Weights that are not all equal. Equal ones have no effect.
distinct :: [Double] -> Maybe [Double]
distinct ws = case ws of
  first : others | any (/= first) others -> Just ws
  _ -> Nothing

-- | The path of a clamped spline.
path :: Bool -> Int -> Maybe [Double] -> Net -> Either Text Shape
path isClosed degree rational Net {knotsOf, controlsOf} =
  case NonEmpty.nonEmpty (Vector.toList controlsOf) of
    Nothing -> Left "it has too few control points"
    Just net -> Right (Path ends (BSpline spline :| []))
      where
        ends = if NonEmpty.head controls == NonEmpty.last controls then Closed else Open
        spline = Spline {degree, knots = Vector.toList knotsOf, controls, weights}
        controls = if isClosed then joined (fmap position net) else fmap position net
        weights = fmap weight net <$ rational
  where
    position (Control x y w) = Vec.point (x / w) (y / w)
    weight (Control _ _ w) = w

-- | The control points with the last one exactly at the first one, if they differ by rounding only.
joined :: NonEmpty Point -> NonEmpty Point
joined (first :| others)
  | gap <= Tolerance.closedSpline * spread = first :| (take between others <> [first])
  | otherwise = first :| others
  where
    between = length others - 1
    gap = distance (NonEmpty.last (first :| others))
    spread = maximum (map distance (first : others))
    distance p = let Mm d = Vec.distance first p in d

-- | Spline in the opposite direction. Its knots are negated, so that they ascend.
reversed :: Net -> Net
reversed Net {knotsOf, controlsOf} =
  Net
    { knotsOf = Vector.reverse (Vector.map negate knotsOf),
      controlsOf = Vector.reverse controlsOf
    }

-- | The spline from its parameter t_p on, with the first @p + 1@ knots equal.
clampStart :: Int -> Net -> Net
clampStart degree net =
  Net
    { knotsOf = Vector.cons start (Vector.drop (final - degree + 1) (knotsOf full)),
      controlsOf = Vector.drop (final - degree) (controlsOf full)
    }
  where
    start = knotsOf net Vector.! degree
    missing = degree - Vector.length (Vector.filter (== start) (knotsOf net))
    full = iterate (insert degree start) net !! max 0 missing
    final = lastAtMost start (knotsOf full)

-- | Inserts the knot u once. The span with the index k contains u, so @t_k ≤ u < t_(k+1)@. The
-- control point i is the old one up to i = k − p, the old one before it from i = k + 1 on, and
-- between these a mean of both with the share @(u − t_i) \/ (t_(i+p) − t_i)@.
insert :: Int -> Double -> Net -> Net
insert degree u Net {knotsOf, controlsOf} =
  Net
    { knotsOf = Vector.concat [before, Vector.singleton u, after],
      controlsOf =
        Vector.concat
          [ Vector.take (k - degree + 1) controlsOf,
            Vector.generate degree (inner . (+ (k - degree + 1))),
            Vector.drop k controlsOf
          ]
    }
  where
    k = lastAtMost u knotsOf
    (before, after) = Vector.splitAt (k + 1) knotsOf
    inner i = mean share (controlsOf Vector.! (i - 1)) (controlsOf Vector.! i)
      where
        share = (u - knotsOf Vector.! i) / (knotsOf Vector.! (i + degree) - knotsOf Vector.! i)

mean :: Double -> Control -> Control -> Control
mean share (Control x y w) (Control x' y' w') =
  Control (between x x') (between y y') (between w w')
  where
    between a b = (1 - share) * a + share * b

-- | The index of the last knot that is not above a parameter.
lastAtMost :: Double -> Vector.Vector Double -> Int
lastAtMost u ts = Vector.length (Vector.takeWhile (<= u) ts) - 1

-- | The clamped spline without knots that occur more than p times inside. At such a knot the curve
-- ends at one control point and begins anew at the next one; the two have to be equal.
withoutBreaks :: Int -> Net -> Either Text Net
withoutBreaks degree net@Net {knotsOf, controlsOf}
  | null surplus = Right net
  | all joins surplus =
    Right
      Net
        { knotsOf = without surplus knotsOf,
          controlsOf = without (map (subtract degree) surplus) controlsOf
        }
  | otherwise = Left "it has a gap"
  where
    size = Vector.length controlsOf
    -- the knot with the index i is the last of p + 1 equal ones
    surplus =
      [ i
        | i <- [2 * degree + 1 .. size - 1],
          knotsOf Vector.! i == knotsOf Vector.! (i - degree),
          knotsOf Vector.! i < knotsOf Vector.! size
      ]
    joins i = controlsOf Vector.! (i - degree - 1) == controlsOf Vector.! (i - degree)
    without indices =
      let set = IntSet.fromList indices in Vector.ifilter (\i _ -> i `IntSet.notMember` set)
