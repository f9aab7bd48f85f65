-- | Pieces of paths: their ends, their reversal, and the moving of their ends.
module Drawing.PathPart
  ( start,
    end,
    middlePoint,
    reversed,
    withEnds,
    ellipseCurves,
    points,
  )
where

import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector.Unboxed qualified as Vector
import Drawing.Drawing (Ellipse (..), Piece (..), Spline (..), ellipsePoint)
import Drawing.OutlineTolerance qualified as Tolerance
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The first and the last point of a piece.
start, end :: Piece -> Point
start piece = case piece of
  Plain s -> Segment.start s
  EllipseArc e from _ -> ellipsePoint e from
  Bezier ps _ -> NonEmpty.head ps
  BSpline s -> NonEmpty.head (controls s)
end piece = case piece of
  Plain s -> Segment.end s
  EllipseArc e _ to -> ellipsePoint e to
  Bezier ps _ -> NonEmpty.last ps
  BSpline s -> NonEmpty.last (controls s)

-- | A point between the ends of a piece that is the same for the reversed piece: the middle of a
-- line, of an arc and of a part of an ellipse, the mean of the control points of a curve.
middlePoint :: Piece -> Point
middlePoint piece = case piece of
  Plain s -> Segment.at 0.5 s
  EllipseArc e from to -> ellipsePoint e ((from + to) / 2)
  Bezier ps _ -> mean ps
  BSpline s -> mean (controls s)
  where
    mean ps =
      let n = fromIntegral (NonEmpty.length ps)
       in Vec.point (sum (fmap Vec.x ps) / n) (sum (fmap Vec.y ps) / n)

-- | The piece in the opposite direction.
reversed :: Piece -> Piece
reversed piece = case piece of
  Plain s -> Plain (Segment.reverse s)
  EllipseArc e from to -> EllipseArc e to from
  Bezier ps weights -> Bezier (NonEmpty.reverse ps) (NonEmpty.reverse <$> weights)
  BSpline s ->
    BSpline
      s
        { knots = let ks = knots s in [maximum ks + minimum ks - k | k <- reverse ks],
          controls = NonEmpty.reverse (controls s),
          weights = NonEmpty.reverse <$> weights s
        }

-- | Pieces from one point to another instead of a piece whose ends are near to these points. A line
-- stays a line. An arc keeps its sweep, and its centre if only rounding moves its ends. Curves move
-- their first and last control points. A part of an ellipse becomes Bézier curves.
withEnds :: Point -> Point -> Piece -> NonEmpty Piece
withEnds p q piece
  | p == start piece && q == end piece = piece :| []
  | otherwise = case piece of
    Plain (Straight _ _) -> Plain (Straight p q) :| []
    Plain (Arc a b centre sweep)
      | isRounding p a && isRounding q b -> Plain (Arc p q centre sweep) :| []
    Plain s -> Plain (Segment.fromBulge p q (Segment.bulge s)) :| []
    Bezier ps weights -> Bezier (between ps) weights :| []
    BSpline s -> BSpline s {controls = between (controls s)} :| []
    EllipseArc e from to -> moved (ellipseCurves e from to)
  where
    moved pieces = case pieces of
      only :| [] -> withEnds p q only
      first :| second : more ->
        withEnds p (end first) first <> withLast (second :| more)
    withLast pieces = case pieces of
      final :| [] -> withEnds (start final) q final
      one :| two : more -> one :| NonEmpty.toList (withLast (two :| more))
    isRounding a b = Vec.distance a b <= Tolerance.rounding
    between ps = case NonEmpty.toList ps of
      _ : more@(_ : _) -> p :| (init more <> [q])
      _ -> p :| [q]

-- | A part of an ellipse as rational Bézier curves of degree 2, each over at most a quarter. The
-- middle control point is where the tangents at the ends meet; its weight is the cosine of half of
-- the parameter's range (The NURBS Book, section 7.3).
ellipseCurves :: Ellipse -> Double -> Double -> NonEmpty Piece
ellipseCurves e from to = fmap curve (0 :| [1 .. count - 1])
  where
    count = max 1 (ceiling (abs (to - from) / (pi / 2) - 1e-9)) :: Int
    step = (to - from) / fromIntegral count
    weight = cos (step / 2)
    curve k =
      let a = from + fromIntegral k * step
          outside = stretched (1 / weight) (ellipsePoint e (a + step / 2))
       in Bezier
            (ellipsePoint e a :| [outside, ellipsePoint e (a + step)])
            (Just (1 :| [weight, 1]))
    stretched factor p = Vec.shift (Vec.scale factor (Vec.to (middle e) p)) (middle e)

-- | Points along a piece, from its start to its end: of a line and an arc only the ends, otherwise
-- some on each stretch of a curve.
points :: Piece -> [Point]
points piece = case piece of
  Plain s -> [Segment.start s, Segment.end s]
  EllipseArc e from to -> [ellipsePoint e (from + t * (to - from)) | t <- shares]
  Bezier ps weights ->
    let ws = maybe (repeat 1) NonEmpty.toList weights
     in [deCasteljau t (zip (NonEmpty.toList ps) ws) | t <- shares]
  BSpline s ->
    let inner = dropRepeated (knots s)
     in concat
          [ [deBoor s (a + t * (b - a)) | t <- shares]
            | (a, b) <- zip inner (drop 1 inner)
          ]
  where
    shares = [k / 16 | k <- [0 .. 16]]
    dropRepeated ks = case ks of
      a : b : more
        | a == b -> dropRepeated (b : more)
        | otherwise -> a : dropRepeated (b : more)
      _ -> ks

-- | The point of a rational Bézier curve at a parameter from 0 to 1, by de Casteljau's algorithm on
-- its control points with weights.
deCasteljau :: Double -> [(Point, Double)] -> Point
deCasteljau t = go . map weighted
  where
    go ps = case ps of
      [p] -> projected p
      [] -> Vec.point 0 0
      _ -> go (zipWith (blended t) ps (drop 1 ps))

-- | The point of a B-spline at a parameter between its first and its last knot, by de Boor's
-- algorithm on its control points with weights.
deBoor :: Spline -> Double -> Point
deBoor Spline {degree, knots, controls, weights} u = go 1 affected
  where
    count = NonEmpty.length controls
    ks = Vector.fromList knots
    -- The index of the span of knots that holds the parameter.
    at' = last (degree : [k | k <- [degree .. count - 1], ks Vector.! k <= u])
    allControls = zip (NonEmpty.toList controls) (maybe (repeat 1) NonEmpty.toList weights)
    affected = map weighted (take (degree + 1) (drop (at' - degree) allControls))
    go level ps = case ps of
      [p] -> projected p
      [] -> Vec.point 0 0
      _ ->
        go
          (level + 1)
          [ blended (share (at' - degree + level + i) level) p q
            | (i, p, q) <- zip3 [0 ..] ps (drop 1 ps)
          ]
    share i level =
      let (a, b) = (ks Vector.! i, ks Vector.! (i + degree + 1 - level))
       in if b > a then (u - a) / (b - a) else 0

-- | A point times its weight, with the weight.
data Weighted = Weighted Double Double Double

weighted :: (Point, Double) -> Weighted
weighted (p, w) = Weighted (w * Vec.x p) (w * Vec.y p) w

projected :: Weighted -> Point
projected (Weighted x y w) = Vec.point (x / w) (y / w)

blended :: Double -> Weighted -> Weighted -> Weighted
blended t (Weighted a b c) (Weighted x y z) =
  Weighted (a + t * (x - a)) (b + t * (y - b)) (c + t * (z - c))
