-- | Cubic Bézier curves of the plane. A curve with the control points p₀ to p₃ has the point
-- @(1−t)³·p₀ + 3·(1−t)²·t·p₁ + 3·(1−t)·t²·p₂ + t³·p₃@ at the parameter t from 0 to 1.
module Export.Bezier
  ( CubicBezier (..),
    fromSpan,
    alongArc,
    start,
    end,
    at,
    isStraight,
    reversed,
    between,
    withStart,
    withEnd,
    boundingBox,
    nearest,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.Ord (comparing)
import Geometry.Curve.Span (Span (..))
import Geometry.Curve.Spline (Cubic (..))
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The four control points, in mm.
data CubicBezier = CubicBezier Point Point Point Point
  deriving stock (Eq, Show)

-- | Curves of a span. A span of cubics is one curve, exactly. An arc is within @tolerance@ of its
-- curves. Nothing for another Bézier curve: 'Geometry.Curve.cubics' has the curves of these.
fromSpan :: Mm -> Span -> Maybe (NonEmpty CubicBezier)
fromSpan tolerance s = case s of
  Polynomial x y ->
    let (x0, x1, x2, x3) = controls x
        (y0, y1, y2, y3) = controls y
     in Just
          ( CubicBezier (Vec.point x0 y0) (Vec.point x1 y1) (Vec.point x2 y2) (Vec.point x3 y3)
              :| []
          )
  Round arc -> Just (alongArc tolerance (Mm 0) arc)
  Controlled _ -> Nothing
  where
    controls (Cubic a b c d) = (a, a + b / 3, a + (2 * b + c) / 3, a + b + c + d)

-- | Curves along a segment, of equal lengths. Each end of a curve lies on the segment, and so does
-- the tangent there. Between them the curve is within @tolerance@ of the segment. The height along
-- the segment rises by @rise@ in proportion to the length; if it rises in proportion to the
-- parameter along each curve instead, it is within @tolerance@ as well.
--
-- With the radius r and the angle φ of one curve, the distance is at most
-- @4/27·r·sin⁶(φ\/4)\/cos²(φ\/4)@ (Goldapp, "Approximation of circular arcs by cubic polynomials").
-- The angle at the parameter t differs from t·φ by about @φ³\/48·t·(1−t)·(1−2t)@, which is at most
-- @φ³\/498@.
alongArc :: Mm -> Mm -> Segment -> NonEmpty CubicBezier
alongArc (Mm tolerance) (Mm rise) s = case s of
  Straight p q -> CubicBezier p (Vec.interpolate (1 / 3) p q) (Vec.interpolate (2 / 3) p q) q :| []
  Arc {Segment.centre, Segment.sweep = Rad sweep} ->
    let Mm r = Segment.radius centre (Segment.start s)
        inPlane = 4 * (3 * tolerance / max tolerance r) ** (1 / 6)
        inHeight = (400 * tolerance * abs sweep / max tolerance (abs rise)) ** (1 / 3)
        count = max 1 (ceiling (abs sweep / minimum [inPlane, inHeight, pi / 2])) :: Int
        angle = sweep / fromIntegral count
        handle = 4 / 3 * tan (angle / 4)
        node k = Segment.at (fromIntegral k / fromIntegral count) s
        piece k =
          let (p, q) = (node k, node (k + 1 :: Int))
              along sign m = Vec.shift (Vec.scale (sign * handle) (Vec.left (Vec.to centre m))) m
           in CubicBezier p (along 1 p) (along (-1) q) q
     in piece 0 :| map piece [1 .. count - 1]

-- | The first point.
start :: CubicBezier -> Point
start (CubicBezier p _ _ _) = p

-- | The last point.
end :: CubicBezier -> Point
end (CubicBezier _ _ _ q) = q

-- | The point at a parameter.
at :: Double -> CubicBezier -> Point
at t (CubicBezier a b c d) = mix (mix ab bc) (mix bc cd)
  where
    mix = Vec.interpolate t
    (ab, bc, cd) = (mix a b, mix b c, mix c d)

-- | True if both inner control points lie where those of a straight line at constant speed lie, but
-- for rounding.
isStraight :: CubicBezier -> Bool
isStraight (CubicBezier a b c d) = near b (1 / 3) && near c (2 / 3)
  where
    near p t = let Mm e = Vec.distance p (Vec.interpolate t a d) in e <= 1e-12 * (1 + size)
    Mm size = Vec.distance a d

-- | The curve in the opposite direction.
reversed :: CubicBezier -> CubicBezier
reversed (CubicBezier a b c d) = CubicBezier d c b a

-- | The part of a curve between two parameters, by the algorithm of de Casteljau.
between :: Double -> Double -> CubicBezier -> CubicBezier
between t u = tailFrom . headTo u
  where
    tailFrom = if u > 0 then reversed . headTo (1 - t / u) . reversed else id

-- | The part of a curve up to a parameter.
headTo :: Double -> CubicBezier -> CubicBezier
headTo t curve@(CubicBezier a b c _)
  | t >= 1 = curve
  | otherwise = CubicBezier a ab (mix ab bc) (at t curve)
  where
    mix = Vec.interpolate t
    (ab, bc) = (mix a b, mix b c)

-- | The curve with another first point.
withStart :: Point -> CubicBezier -> CubicBezier
withStart p (CubicBezier _ b c d) = CubicBezier p b c d

-- | The curve with another last point.
withEnd :: Point -> CubicBezier -> CubicBezier
withEnd p (CubicBezier a b c _) = CubicBezier a b c p

-- | A box around a curve: that of its control points.
boundingBox :: CubicBezier -> BoundingBox
boundingBox (CubicBezier a b c d) = BoundingBox.ofPoints a [b, c, d]

-- | The parameter of the point of a curve that is nearest to the point @p@, and their distance; it
-- is found from the nearest of nine points by Newton's method. Nothing if the curve is further than
-- @reach@ from the point.
nearest :: Mm -> Point -> CubicBezier -> Maybe (Double, Mm)
nearest reach p curve@(CubicBezier a b c d)
  | BoundingBox.distance p (boundingBox curve) > reach = Nothing
  | snd found <= reach = Just found
  | otherwise = Nothing
  where
    found = minimumBy (comparing snd) (map measured [0, coarse, 1, refined])
    measured t = (t, Vec.distance p (at t curve))
    coarse = fst (minimumBy (comparing snd) (map (measured . (/ 8)) [0 .. 8]))
    refined = iterate step coarse !! 12
    -- The derivative of half the squared distance is the scalar product of the distance and the
    -- tangent. Its own derivative is approximated by the square of the tangent.
    step t =
      let tangent = tangentAt t
          square = Vec.dot tangent tangent
       in if square > 0
            then min 1 (max 0 (t - Vec.dot (Vec.to p (at t curve)) tangent / square))
            else t
    tangentAt t =
      let e = Vec.scale (3 * (1 - t) * (1 - t)) (Vec.to a b)
          f = Vec.scale (6 * (1 - t) * t) (Vec.to b c)
          g = Vec.scale (3 * t * t) (Vec.to c d)
       in Vec.add e (Vec.add f g)
