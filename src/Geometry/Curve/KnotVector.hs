-- | Knot vectors of B-splines, and the Bézier curves of which a B-spline consists.
--
-- A B-spline of the degree p with n control points has n + p + 1 knots u in ascending order. It is
-- defined for parameters from the knot @u_p@ to @u_n@, counted from 0, and is a polynomial between
-- neighbouring knots (Piegl and Tiller, "The NURBS Book", chapters 3 and 5). Inserting a knot until
-- it occurs p times cuts the curve there, without changing it.
module Geometry.Curve.KnotVector
  ( KnotVector,
    KnotFault (..),
    knotVector,
    degree,
    bezierSpans,
  )
where

import Data.List (find)
import Data.Maybe (listToMaybe)
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Unboxed
import Geometry.Numeric.Bernstein (Bernstein)
import Geometry.Tolerance qualified as Tolerance

-- | Degree of a B-spline, from 1, and its knots.
data KnotVector = KnotVector {degree :: Int, knots :: Vector Double}
  deriving stock (Eq, Show)

-- | Reason why numbers are not the knots of a B-spline. Knots are counted from 1.
data KnotFault
  = -- | the count of the control points, which is not above the degree
    FewControlPoints Int
  | -- | the count of the knots, and the count that is needed
    KnotCount Int Int
  | -- | the knot with this number is below the one before it
    FallingKnot Int
  | -- | the knot with this number, its value, how often this value occurs, and how often it may
    -- occur
    RepeatedKnot Int Double Int Int
  | -- | the numbers of two equal knots between which the curve is defined
    NoInterval Int Int
  deriving stock (Eq, Show)

-- | Knot vector for a degree and a count of control points. Knots that differ by at most
-- 'Tolerance.knotShare' become equal.
knotVector :: Int -> Int -> [Double] -> Either KnotFault KnotVector
knotVector p count list
  | count <= p = Left (FewControlPoints count)
  | Unboxed.length given /= needed = Left (KnotCount (Unboxed.length given) needed)
  | Just k <- find (\i -> given Unboxed.! i < given Unboxed.! (i - 1)) [1 .. needed - 1] =
    Left (FallingKnot (k + 1))
  | first >= final = Left (NoInterval (p + 1) (count + 1))
  | Just fault <- repeated = Left fault
  | otherwise = Right KnotVector {degree = p, knots = equalised}
  where
    given = Unboxed.fromList list
    needed = count + p + 1
    slack = Tolerance.knotShare * (given Unboxed.! count - given Unboxed.! p)
    equalised = Unboxed.postscanl' (\u v -> if v - u <= slack then u else v) (-1 / 0) given
    first = equalised Unboxed.! p
    final = equalised Unboxed.! count
    repeated =
      listToMaybe
        [ RepeatedKnot (i + 1) u times most
          | (i, next) <- zip runs (drop 1 runs <> [needed]),
            let u = equalised Unboxed.! i,
            u >= first && u <= final,
            let times = next - i,
            let most = if u > first && u < final then p else p + 1,
            times > most
        ]
    runs =
      [i | i <- [0 .. needed - 1], i == 0 || equalised Unboxed.! i > equalised Unboxed.! (i - 1)]

-- | Bernstein coefficients of each polynomial of a B-spline, in order. @controls@ are the numbers
-- at the control points; there are as many as the knots need. Coefficient i between the knots a and
-- b is the blossom of the polynomial at a, p − i times, and at b, i times.
bezierSpans :: KnotVector -> Vector Double -> [Bernstein]
bezierSpans vector@KnotVector {degree = p, knots} controls =
  [ Unboxed.generate (p + 1) (blossom vector controls j)
    | j <- [p .. Unboxed.length knots - p - 2],
      knots Unboxed.! j < knots Unboxed.! (j + 1)
  ]

-- | Blossom of the polynomial between the knots a, with the index @j@, and b after it. Its
-- arguments are b, @upper@ times, and a, for the rest of the degree. De Boor's algorithm with one
-- argument for each of its steps gives it, by convex combinations only.
blossom :: KnotVector -> Vector Double -> Int -> Int -> Double
blossom KnotVector {degree = p, knots} controls j upper =
  Unboxed.head (foldl step (Unboxed.slice (j - p) (p + 1) controls) [1 .. p])
  where
    step left r = Unboxed.generate (p + 1 - r) $ \i ->
      let low = knots Unboxed.! (j - p + r + i)
          high = knots Unboxed.! (j + 1 + i)
          share = (knots Unboxed.! (if r <= upper then j + 1 else j) - low) / (high - low)
       in (1 - share) * left Unboxed.! i + share * left Unboxed.! (i + 1)
