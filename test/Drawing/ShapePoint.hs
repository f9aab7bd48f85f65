-- | Points, ends and lengths of the shapes of a drawing, by the definitions of the curves.
module Drawing.ShapePoint
  ( pieceAt,
    shapeAt,
    pieceEnds,
    lengthOf,
    isOn,
    splinePoint,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Drawing.Drawing
import Geometry.Carrier (Circle (Circle))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The point of a part at a share of its parameter, from 0 to 1.
pieceAt :: Double -> PathPart -> Point
pieceAt t part = case part of
  Plain segment -> Segment.at t segment
  EllipseArc e from to -> ellipsePoint e (from + t * (to - from))
  Bezier points weights -> deCasteljau t (weighted points weights)
  BSpline spline -> splineAt t spline

-- | The point of a shape at a share of its parameter: all parts of a path have equal shares.
shapeAt :: Double -> Shape -> Point
shapeAt t shape = case shape of
  Path _ parts ->
    let count = NonEmpty.length parts
        index = min (count - 1) (floor (t * fromIntegral count))
     in pieceAt (t * fromIntegral count - fromIntegral index) (parts NonEmpty.!! index)
  FullCircle (Circle c (Mm r)) ->
    Vec.shift (Vec.vec (r * cos (2 * pi * t)) (r * sin (2 * pi * t))) c
  FullEllipse e -> ellipsePoint e (2 * pi * t)
  Dot p -> p

-- | The ends of a part.
pieceEnds :: PathPart -> [Point]
pieceEnds part = [pieceAt 0 part, pieceAt 1 part]

-- | The length of a shape in mm, by chords and Richardson extrapolation.
lengthOf :: Shape -> Double
lengthOf shape = case shape of
  Path _ parts -> sum (fmap ofPiece parts)
  FullCircle (Circle _ (Mm r)) -> 2 * pi * r
  FullEllipse _ -> chorded (\t -> shapeAt t shape) [0, 1]
  Dot _ -> 0
  where
    ofPiece part = case part of
      Plain segment -> let Mm l = Segment.length segment in l
      BSpline Spline {knots, degree} ->
        chorded (`pieceAt` part) (shares (drop degree (take (length knots - degree) knots)))
      _ -> chorded (`pieceAt` part) [0, 1]
    shares ts = [(t - head ts) / (last ts - head ts) | t <- ts]

-- | The length of a curve that is smooth between consecutive parameters.
chorded :: (Double -> Point) -> [Double] -> Double
chorded at' breaks = sum (zipWith ofSpan breaks (drop 1 breaks))
  where
    ofSpan a b
      | a < b = (4 * chords 2000 a b - chords 1000 a b) / 3
      | otherwise = 0
    chords :: Int -> Double -> Double -> Double
    chords n a b =
      let ps = [at' (a + (b - a) * fromIntegral i / fromIntegral n) | i <- [0 .. n]]
       in sum [d | (p, q) <- zip ps (drop 1 ps), let Mm d = Vec.distance p q]

-- | True if a point lies on a shape within 10⁻⁸ mm for each mm of its size: at the share t of the
-- parameter on a path, anywhere on a circle or an ellipse.
isOn :: Double -> Point -> Shape -> Bool
isOn t p shape = case shape of
  Path _ _ -> near (shapeAt t shape) p
  FullCircle (Circle c (Mm r)) -> let Mm d = Vec.distance c p in abs (d - r) <= allowed
  FullEllipse Ellipse {middle, major = Mm a, minor = Mm b, direction = Rad angle} ->
    let v = Vec.rotate (Rad (negate angle)) (Vec.to middle p)
        (x, y) = (Vec.dot v (Vec.vec 1 0) / a, Vec.dot v (Vec.vec 0 1) / b)
     in abs (x * x + y * y - 1) * b <= allowed
  Dot q -> near q p
  where
    near q r = let Mm d = Vec.distance q r in d <= allowed
    allowed = 1e-8 * (1 + let Mm d = Vec.distance (Vec.point 0 0) p in d)

-- | A point in homogeneous coordinates.
data Homogeneous = Homogeneous Double Double Double

weighted :: NonEmpty Point -> Maybe (NonEmpty Double) -> [Homogeneous]
weighted points weights =
  [ Homogeneous (w * Vec.x p) (w * Vec.y p) w
    | (p, w) <- zip (NonEmpty.toList points) (maybe (repeat 1) NonEmpty.toList weights)
  ]

mix :: Double -> Homogeneous -> Homogeneous -> Homogeneous
mix t (Homogeneous x y w) (Homogeneous x' y' w') = Homogeneous (f x x') (f y y') (f w w')
  where
    f a b = (1 - t) * a + t * b

position :: Homogeneous -> Point
position (Homogeneous x y w) = Vec.point (x / w) (y / w)

deCasteljau :: Double -> [Homogeneous] -> Point
deCasteljau t points = case points of
  [p] -> position p
  _ -> deCasteljau t (zipWith (mix t) points (drop 1 points))

-- | The point of a clamped spline at a share of its parameters.
splineAt :: Double -> Spline -> Point
splineAt t Spline {degree, knots, controls, weights} =
  splinePoint degree knots points (NonEmpty.toList <$> weights) (a + t * (b - a))
  where
    points = NonEmpty.toList controls
    (a, b) = (knots !! degree, knots !! length points)

-- | The point of a spline of any knots at a parameter, by de Boor's algorithm.
splinePoint :: Int -> [Double] -> [Point] -> Maybe [Double] -> Double -> Point
splinePoint degree knots points weights u =
  position (go degree (take (degree + 1) (drop (k - degree) homogeneous)))
  where
    homogeneous = weighted (NonEmpty.fromList points) (NonEmpty.fromList <$> weights)
    k = last (filter nonEmptySpan [degree .. length points - 1])
    nonEmptySpan i =
      knots !! i < knots !! (i + 1) && (knots !! i <= u || knots !! i == knots !! degree)
    -- the points of one round belong to the control points from index k − left on
    go left ds = case ds of
      [d] -> d
      _ ->
        go
          (left - 1)
          [ mix ((u - knots !! i) / (knots !! (i + left) - knots !! i)) d e
            | (i, d, e) <- zip3 [k - left + 1 ..] ds (drop 1 ds)
          ]
