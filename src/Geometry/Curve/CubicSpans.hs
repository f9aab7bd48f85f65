-- | A curve as cubic spans: its own, or cubics that stand for a shifted one.
--
-- Between two places h apart in the parameter, Hermite's cubic has the places P and the derivatives
-- V of both. At a share t of the way it differs from a smooth curve by t²(1−t)²·(c + d(t−½) + …),
-- and in the middle its place tells c/16, its derivative there d/16. Half a span has a sixteenth of
-- c and a thirty-second of d.
module Geometry.Curve.CubicSpans
  ( along,
  )
where

import Base.Quantity (Mm (..))
import Data.Vector qualified as Vector
import Geometry.Curve.Base (SpanList (..), course)
import Geometry.Curve.PointSearch qualified as PointSearch
import Geometry.Curve.ShiftedCurve (Curve (..))
import Geometry.Curve.ShiftedCurve qualified as ShiftedCurve
import Geometry.Curve.Spline (Cubic (..), Cubics)
import Geometry.Curve.Spline qualified as Spline
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Tolerance qualified as Tolerance
import Linear.V2 (V2 (..))

-- | Spans in x and y that stay so near to a curve, and how near; those of a spline are its own.
-- Nothing for a curve with arcs, and for one that stands still somewhere or nearly so.
along :: Mm -> Curve -> Maybe (Mm, Cubics, Cubics)
along (Mm tolerance) curve = case curve of
  Plain b -> case course b of
    Cubical xs ys -> Just (Mm 0, xs, ys)
    Mixed _ -> Nothing
  Shifted {} -> do
    halves <- traverse onStretch (PointSearch.stretches curve)
    let spans = Vector.fromList (concat halves)
        part f = Spline.generate (Vector.length spans) (\i -> f (spans Vector.! i))
    Just (Mm tolerance, part inX, part inY)
  where
    onStretch (a, b) = refined most (between (node (a, b)) a (node (a, b) a) b (node (a, b) b))
    node stretch u = case ShiftedCurve.jetAt 1 curve (PointSearch.within stretch curve u) of
      V2 x y ->
        Node
          (PowerSeries.value x)
          (PowerSeries.value y)
          (PowerSeries.coefficient 1 x)
          (PowerSeries.coefficient 1 y)
    refined left piece@Piece {begin, end, first, inside, final, nodeAt}
      | not (speed first > still && speed final > still && speed inside > still) = Nothing
      | near tolerance piece one other = Just [span' one, span' other]
      | left <= 0 = Nothing
      | otherwise = (<>) <$> refined (left - 1) one <*> refined (left - 1) other
      where
        m = middle begin end
        one = between nodeAt begin first m inside
        other = between nodeAt m inside end final
    Mm still = Tolerance.still

-- | How often a stretch is halved.
most :: Int
most = 24

-- | A place and the derivative there, in mm for 1 of the parameter.
data Node = Node Double Double Double Double

speed :: Node -> Double
speed (Node _ _ vx vy) = sqrt (vx * vx + vy * vy)

-- | A piece of a stretch with the nodes at its ends and in its middle, and what gives the others.
data Piece = Piece {begin, end :: Double, first, inside, final :: Node, nodeAt :: Double -> Node}

between :: (Double -> Node) -> Double -> Node -> Double -> Node -> Piece
between nodeAt begin first end final =
  Piece {begin, end, first, inside = nodeAt (middle begin end), final, nodeAt}

middle :: Double -> Double -> Double
middle a b = 0.5 * (a + b)

-- | A cubic in x and one in y.
data Span = Span {inX :: Cubic, inY :: Cubic}

-- | Hermite's cubics between the ends of a piece.
span' :: Piece -> Span
span' Piece {begin, end, first = Node px py vx vy, final = Node qx qy wx wy} =
  Span {inX = hermite px qx (h * vx) (h * wx), inY = hermite py qy (h * vy) (h * wy)}
  where
    h = end - begin
    hermite p q v w = Cubic p v (3 * (q - p) - 2 * v - w) (2 * (p - q) + v + w)

-- | Whether the cubics of both halves of a piece stay so near to the curve: by what is to be
-- expected of a half where the whole differs so, with half of it to spare, and by what each differs
-- itself. The even and the odd of a difference are looked at alike, the one in the place in the
-- middle, the other in the derivative there.
near :: Double -> Piece -> Piece -> Piece -> Bool
near tolerance whole one other =
  place <= 8 * tolerance && bend <= 16 * tolerance && all itself [one, other]
  where
    (place, bend) = difference whole
    itself half = let (e, o) = difference half in e + oddShare * o <= tolerance
    -- The most of t²(1−t)²(t−½), √5/250 where t is ½ ± √(1/20), by its derivative in the middle,
    -- 1/16.
    oddShare = 16 * sqrt 5 / 250

-- | By how much the cubic of a piece differs in the middle: in the place, mm, and in the
-- derivative, mm for the whole piece.
difference :: Piece -> (Double, Double)
difference
  Piece
    { begin,
      end,
      first = Node px py vx vy,
      inside = Node mx my sx sy,
      final = Node qx qy wx wy
    } =
    (off px mx qx vx wx + off py my qy vy wy, bent px sx qx vx wx + bent py sy qy vy wy)
    where
      h = end - begin
      off p m q v w = abs (0.5 * (p + q) + 0.125 * h * (v - w) - m)
      bent p s q v w = abs (1.5 * (q - p) - h * (0.25 * (v + w) + s))
