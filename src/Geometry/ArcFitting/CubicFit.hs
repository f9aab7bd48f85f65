{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 -fno-full-laziness #-}

-- | Arc fitting of cubic spans by biarcs, with an error bound in closed form.
--
-- The bound and the arcs are those of "Geometry.ArcFitting.ArcDistance". The function F of a
-- position is 0 on the circle of an arc, and the largest |F| along a curve gives a bound of its
-- distance from the arc. The bound holds only if the curve runs forwards: its direction makes an
-- angle of less than a quarter turn with the arc's directions at both ends. On a cubic, F is a
-- polynomial of degree 6. Chebyshev economization reduces it to degree 3, plus a small remainder;
-- the maximum of a cubic is known in closed form.
--
-- The parameter of a curve rises by 1 over each span; the local parameter of a span goes from 0 to
-- 1. A stretch is the part between two corners, given by the index @from@ of its first span and the
-- index @to@ after its last. A pose is a position in mm with a unit direction.
module Geometry.ArcFitting.CubicFit
  ( approximate,
  )
where

import Base.Quantity (Mm (..))
import Control.Monad.ST (runST)
import Data.List.NonEmpty (NonEmpty (..))
import Geometry.ArcFitting.ArcDistance
import Geometry.ArcFitting.Biarc.Fast (FastBiarc (..), Pose (..))
import Geometry.ArcFitting.Biarc.Fast qualified as FastBiarc
import Geometry.ArcFitting.Builder qualified as Builder
import Geometry.ArcFitting.LongestBiarc (ArcDistances (..), ParameterRange (..), Spans (..))
import Geometry.ArcFitting.LongestBiarc qualified as LongestBiarc
import Geometry.ArcFitting.ParametricFit (OneSided (..), ParametricCurve (ParametricCurve))
import Geometry.ArcFitting.ParametricFit qualified as ParametricFit
import Geometry.Curve.Spline (Cubic (..), Cubics)
import Geometry.Curve.Spline qualified as Spline
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec

-- | Arcs and lines within a tolerance of a curve. The arguments are the tolerance and the cubics of
-- the curve's spans in x and in y. The tolerance holds from the curve to the arcs and from the arcs
-- to the curve. The fit is greedy: each biarc is as long as possible. The speed must not be 0 at
-- the ends of spans, because a direction is computed as the velocity divided by the speed.
approximate :: Mm -> Cubics -> Cubics -> FlatPolyarc
approximate (Mm tolerance) xs ys = runST $ do
  vertices <- Builder.new
  LongestBiarc.forStretches n (hasCorner xs ys) $ \from to ->
    if to == from + 1 && isStraight (Spline.at xs from) && isStraight (Spline.at ys from)
      then let begin = poseAt xs ys from 0 in Builder.push vertices (px begin) (py begin) 0
      else
        LongestBiarc.along
          vertices
          (tolerance * (1 - Tolerance.roundingShare))
          (stretchRange from to)
          (stretchSpans tolerance xs ys from to)
  let end = poseAt xs ys (n - 1) 1
  Builder.push vertices (px end) (py end) 0
  Builder.polyarc vertices
  where
    n = Spline.count xs

-- | Parameters of the spans @from@ to @to − 1@. A biarc over one span is tried first.
stretchRange :: Int -> Int -> ParameterRange
stretchRange from to =
  ParameterRange {inSpan = from, begin = fromIntegral from, final = fromIntegral to, step = 1}

-- | The spans @from@ to @to − 1@ as a curve for the fit, within @tolerance@ (mm).
stretchSpans :: Double -> Cubics -> Cubics -> Int -> Int -> Spans
stretchSpans tolerance xs ys from to =
  Spans
    { seek = \_ u -> truncate u,
      pose = poseWithin xs ys from to,
      LongestBiarc.arcDistances = biarcDistances xs ys,
      fallback = generalFit,
      isHopeless = \_ _ _ _ _ _ _ -> False,
      triesLonger = False
    }
  where
    -- The cost of "Geometry.ArcFitting.ParametricFit" grows with the count of spans. Therefore it
    -- gets only the span that contains @u@ and the next 63 spans.
    generalFit u =
      let i = max 0 (min (to - 1) (truncate u))
          end = min to (i + 64)
       in ParametricFit.oneBiarc (Mm tolerance) (parametricCurve xs ys i end) (fromIntegral end) u
{-# INLINE stretchSpans #-}

-- | True if a cubic is linear. A span with linear x and linear y is a line.
isStraight :: Cubic -> Bool
isStraight (Cubic _ _ c d) = c == 0 && d == 0

-- | True if the curve has a corner at the start of span @k@, which is not the first (0).
hasCorner :: Cubics -> Cubics -> Int -> Bool
hasCorner xs ys k = FastBiarc.isCorner (poseAt xs ys (k - 1) 1) (poseAt xs ys k 0)

-- | Pose in span @i@, counted from 0, at the local parameter @t@ from 0 to 1.
poseAt :: Cubics -> Cubics -> Int -> Double -> Pose
poseAt xs ys i t = Pose (Spline.value a t) (Spline.value b t) (vx / v) (vy / v)
  where
    a = Spline.at xs i
    b = Spline.at ys i
    vx = Spline.rate a t
    vy = Spline.rate b t
    v = sqrt (vx * vx + vy * vy)
{-# INLINE poseAt #-}

-- | Pose at parameter @u@ of the stretch of spans @from@ to @to − 1@; @i@ is the index of the span
-- that contains @u@. Where two spans meet, the direction is the mean of both.
poseWithin :: Cubics -> Cubics -> Int -> Int -> Int -> Double -> Pose
poseWithin xs ys from to i u
  | i >= to = poseAt xs ys (to - 1) 1
  | t > 0 || i <= from = poseAt xs ys i t
  | otherwise = FastBiarc.meanPose (poseAt xs ys (i - 1) 1) (poseAt xs ys i 0)
  where
    t = u - fromIntegral i

-- | Bounds of the distances of a biarc's two arcs from the curve between two parameters. After the
-- limit @largest@ (mm) come the span, the parameter and the pose of the first end, then those of
-- the second. A result above the limit need not be a bound, as the caller rejects the biarc anyway.
biarcDistances ::
  Cubics ->
  Cubics ->
  Double ->
  Int ->
  Double ->
  Pose ->
  Int ->
  Double ->
  Pose ->
  FastBiarc ->
  ArcDistances
biarcDistances xs ys largest first u from _ v to pair
  | single pair =
    if isForwards one
      then let Reached _ _ d = advance xs ys largest v True one start in ArcDistances d d
      else unknown
  | isForwards one && isForwards two = case advance xs ys largest v False one start of
    Reached i a d1 | d1 <= largest -> case advance xs ys largest v True two (Reached i a 0) of
      Reached _ _ d2 -> ArcDistances d1 d2
    _ -> unknown
  | otherwise = unknown
  where
    start = Reached first (u - fromIntegral first) 0
    unknown = ArcDistances (1 / 0) (1 / 0)
    !one = fastArc from (bend1 pair) (if single pair then to else joint pair)
    !two = fastArc (joint pair) (bend2 pair) to

-- | Position on the curve: the index of its span, and its local parameter there. The third argument
-- is a bound in mm of the distance between an arc and the curve up to this position.
data Reached = Reached Int Double Double

-- | Advances on the curve along one arc, and bounds the distance between curve and arc. The result
-- is where it stops. Along a first arc it stops where the curve crosses the normal at the arc's
-- end, because the second arc begins there. Along a second or single arc, for which @final@ is
-- True, it stops at parameter @v@. It also stops once the bound exceeds @largest@ (mm).
advance :: Cubics -> Cubics -> Double -> Double -> Bool -> FastArc -> Reached -> Reached
advance xs ys largest v final f (Reached i0 a0 d0) = go i0 a0 d0
  where
    go i a d
      | d > largest = Reached i a d
      | final =
        if whole then Reached i b (larger d (bound a b)) else go (i + 1) 0 (larger d (bound a b))
      | ahead b < 0 = if whole then Reached i b (1 / 0) else go (i + 1) 0 (larger d (bound a b))
      | otherwise = let c = crossing in Reached i c (larger d (bound a c))
      where
        whole = fromIntegral (i + 1) >= v
        b = if whole then v - fromIntegral i else 1
        x = Spline.at xs i
        y = Spline.at ys i
        ahead t = beyond f (Spline.value x t) (Spline.value y t)
        aheadSlope t = Spline.rate x t * dx (limit f) + Spline.rate y t * dy (limit f)
        crossing =
          let from = ahead a
              newton t = clamped (t - ahead t / aheadSlope t)
              clamped t = if t > a then if t < b then t else b else a
           in newton (newton (clamped (a - (b - a) * from / (ahead b - from))))
        bound = distanceBound f x y
    larger d e = if e <= d then d else e

-- | Bound in mm of the distance between an arc and a span, over the span's local parameters from
-- @a@ to @b@. It is infinite where the span might not run forwards.
distanceBound :: FastArc -> Cubic -> Cubic -> Double -> Double -> Double
distanceBound f p q a b = inFrame f p q a b $ \x@(Cubic _ x1 x2 x3) y@(Cubic _ y1 y2 y3) ->
  if isForwardsBy f x1 y1
    && isForwardsBy f (x1 + x2) (y1 + y2)
    && isForwardsBy f (x1 + 2 * x2 + 3 * x3) (y1 + 2 * y2 + 3 * y3)
    then distanceOfLevel f (largestLevel (bend f) x y)
    else 1 / 0

-- | Passes a part of a span to the continuation @next@, as cubics x and y in coordinates at the
-- arc's start: x along the arc's direction there, y to its left. The part has the local parameters
-- from @a@ to @b@ of the span; the new cubics have the parameter from 0 to 1.
inFrame :: FastArc -> Cubic -> Cubic -> Double -> Double -> (Cubic -> Cubic -> r) -> r
inFrame f (Cubic p0 p1 p2 p3) (Cubic q0 q1 q2 q3) a b next =
  next
    (Cubic (along ux0 uy0) (along ux1 uy1) (along ux2 uy2) (along ux3 uy3))
    (Cubic (across ux0 uy0) (across ux1 uy1) (across ux2 uy2) (across ux3 uy3))
  where
    w = b - a
    tx = dx (origin f)
    ty = dy (origin f)
    along ux uy = ux * tx + uy * ty
    across ux uy = uy * tx - ux * ty
    -- Coefficients relative to the arc's start, in the axes of the plane.
    ux0 = p0 + a * (p1 + a * (p2 + a * p3)) - px (origin f)
    uy0 = q0 + a * (q1 + a * (q2 + a * q3)) - py (origin f)
    ux1 = w * (p1 + a * (2 * p2 + 3 * a * p3))
    uy1 = w * (q1 + a * (2 * q2 + 3 * a * q3))
    ux2 = w * w * (p2 + 3 * a * p3)
    uy2 = w * w * (q2 + 3 * a * q3)
    ux3 = w * w * w * p3
    uy3 = w * w * w * q3
{-# INLINE inFrame #-}

-- | Bound of |F|, in mm, for the circle of curvature @k@ (1/mm), along a curve. The curve is given
-- by cubics x and y in a parameter from 0 to 1, in coordinates at a point of the circle: x along
-- the circle there, y to its left.
largestLevel :: Double -> Cubic -> Cubic -> Double
largestLevel k (Cubic x0 x1 x2 x3) (Cubic y0 y1 y2 y3) =
  largestCubic e0 e1 e2 e3 + abs c6 / 2048 + abs e5 / 512 + abs e4 / 128
  where
    h = 0.5 * k
    -- Coefficients of F by powers of the parameter.
    c0 = y0 - h * (x0 * x0 + y0 * y0)
    c1 = y1 - 2 * h * (x0 * x1 + y0 * y1)
    c2 = y2 - h * (x1 * x1 + y1 * y1 + 2 * (x0 * x2 + y0 * y2))
    c3 = y3 - 2 * h * (x0 * x3 + y0 * y3 + x1 * x2 + y1 * y2)
    c4 = -(h * (x2 * x2 + y2 * y2 + 2 * (x1 * x3 + y1 * y3)))
    c5 = -(2 * h * (x2 * x3 + y2 * y3))
    c6 = -(h * (x3 * x3 + y3 * y3))
    -- Chebyshev economization on [0, 1] replaces t⁶ by 3·t⁵ − 27/8·t⁴ + 7/4·t³ − 105/256·t² +
    -- 9/256·t − 1/2048, with an error of at most 1/2048. It replaces t⁵ by 5/2·t⁴ − 35/16·t³ +
    -- 25/32·t² − 25/256·t + 1/512, with an error of at most 1/512. It replaces t⁴ by
    -- 2·t³ − 5/4·t² + t/4 − 1/128, with an error of at most 1/128.
    e5 = c5 + 3 * c6
    e4 = c4 - 3.375 * c6 + 2.5 * e5
    e3 = c3 + 1.75 * c6 - 2.1875 * e5 + 2 * e4
    e2 = c2 - 0.41015625 * c6 + 0.78125 * e5 - 1.25 * e4
    e1 = c1 + 0.03515625 * c6 - 0.09765625 * e5 + 0.25 * e4
    e0 = c0 - c6 / 2048 + e5 / 512 - e4 / 128
{-# INLINE largestLevel #-}

-- | Largest absolute value, on [0, 1], of the cubic with the given coefficients. It lies at an end
-- or at a zero of the slope @c₁ + 2·c₂·t + 3·c₃·t²@.
largestCubic :: Double -> Double -> Double -> Double -> Double
largestCubic c0 c1 c2 c3
  | square <= 0 = ends
  | otherwise = inside (q / (3 * c3)) (inside (c1 / q) ends)
  where
    ends = greater (abs c0) (abs (c0 + c1 + c2 + c3))
    greater m n = if m > n then m else n
    square = c2 * c2 - 3 * c1 * c3
    q = if c2 > 0 then -(c2 + sqrt square) else sqrt square - c2
    inside t d = if t > 0 && t < 1 then greater d (abs (c0 + t * (c1 + t * (c2 + t * c3)))) else d

-- | Spans @from@ to @to − 1@ as a parametric curve for "Geometry.ArcFitting.ParametricFit".
parametricCurve :: Cubics -> Cubics -> Int -> Int -> ParametricCurve
parametricCurve xs ys from to =
  ParametricCurve
    { ParametricFit.place = place,
      ParametricFit.direction = direction,
      ParametricFit.begin = fromIntegral from,
      ParametricFit.breaks = fromIntegral (from + 1) :| map fromIntegral [from + 2 .. to]
    }
  where
    place u =
      let i =
            clamped (truncate u)
          t = u - fromIntegral i
       in Vec.point (Spline.value (Spline.at xs i) t) (Spline.value (Spline.at ys i) t)
    direction side u = case side of
      Arriving -> tangentIn (-1) (clamped (ceiling u - 1)) u
      Leaving -> tangentIn 1 (clamped (truncate u)) u
    clamped i = max from (min (to - 1) i)
    -- At zero speed, the second derivative gives the direction.
    tangentIn sign i u
      | Mm (Vec.norm first) > Tolerance.stationary = Vec.unit first
      | Vec.norm second > 0 = Vec.unit (Vec.scale sign second)
      | otherwise = Vec.vec 1 0
      where
        t = u - fromIntegral i
        first = Vec.vec (Spline.rate x t) (Spline.rate y t)
        second = Vec.vec (bending x) (bending y)
        bending (Cubic _ _ c d) = 2 * c + 6 * d * t
        x = Spline.at xs i
        y = Spline.at ys i
