-- | Random curves and shifts of curves. The curves are open or closed, with slow or sharp changes
-- of direction, with vertical tangents, with few or many points.
module Generate.Curve
  ( Table (..),
    anyCurve,
    slightCorners,
    smooth,
    gentle,
    zigzag,
    ring,
    closedRing,
    winding,
    polyline,
    parabola,
    toSegments,
    pieces,
    bezier,
    bspline,
    knotsFor,
    weights,
    controlPoints,
    parameter,
    parameterOf,
    tightest,
    distance,
    shifts,
    layered,
    columnOf,
    similarity,
    ok,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.Either (fromRight)
import Data.List (tails)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import GHC.Exts qualified as Exts
import Generate.Run qualified as Run
import Geometry.Carrier qualified as Carrier
import Geometry.Curve
  ( Approach (..),
    Curve,
    Distance (..),
    EndCondition (..),
    Growth (..),
    Joggle (..),
    Side (..),
    SpanShape (..),
  )
import Geometry.Curve qualified as Curve
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.QuickCheck

-- | A table of points with its end condition.
data Table = Table EndCondition [Point]
  deriving stock (Eq, Show)

-- | The result of a computation that must succeed.
ok :: Show e => Either e a -> a
ok = either (error . show) id

-- | A curve of any kind, without slight corners. A shift turns the normals beside a slight corner
-- ("Geometry.Curve.ShiftedCurve"), so the laws of other curves do not hold there.
anyCurve :: Gen Curve
anyCurve =
  frequency
    [ (2, smooth),
      (1, oneof [bezier, bspline]),
      (1, polyline),
      (1, parabola),
      (1, toSegments),
      (1, pieces)
    ]
    `suchThat` (null . slightCorners)

-- | The parameters of the corners at which a curve turns by at most 'Tolerance.kink'.
slightCorners :: Curve -> [Double]
slightCorners c =
  [ u
    | u <- Curve.corners c,
      Rad a <- [Vec.signedAngle (Curve.tangentFrom Before c u) (Curve.tangentFrom After c u)],
      Rad (abs a) <= Tolerance.kink
  ]

-- | A spline.
smooth :: Gen Curve
smooth = oneof [gentle, ring, ok . splineOf <$> winding]

splineOf :: Table -> Either Curve.CurveFault Curve
splineOf (Table ends points) = Curve.spline ends (Exts.fromList points)

-- | An open spline with 2 to 60 points. The directions of its chords differ by less than 1 rad.
gentle :: Gen Curve
gentle = do
  n <- frequency [(1, choose (2, 3)), (3, choose (4, 12)), (2, choose (30, 60))]
  begin <- choose (-3.1, 3.1)
  turns <- vectorOf (n - 1) (choose (-1 / fromIntegral n, 1 / fromIntegral n))
  Table ends points <- fromTurns begin turns
  pure (ok (splineOf (Table ends points)))

-- | Points with arbitrary changes of direction. Their curve may reverse in x, intersect itself, or
-- be vertical. Some tables have given directions at the ends.
winding :: Gen Table
winding = do
  n <- choose (2, 20)
  begin <- elements [0, pi / 2, 1]
  turns <- vectorOf n (oneof [choose (-0.8, 0.8), elements [0, pi / 2]])
  fromTurns begin turns

-- | A table of points from the first direction and the change of direction at each point, in rad.
fromTurns :: Double -> [Double] -> Gen Table
fromTurns begin turns = do
  steps <- vectorOf (length turns) (choose (8, 20))
  at <- Vec.point <$> choose (-100, 100) <*> choose (-100, 100)
  let headings = scanl1 (+) (begin : drop 1 turns)
      points = scanl (\p (a, s) -> Vec.shift (Vec.polar (Mm s) (Rad a)) p) at (zip headings steps)
      final = begin + sum (drop 1 turns)
  bent <- choose (-0.1, 0.1)
  ends <-
    elements
      [ Natural,
        Clamped (Vec.polar (Mm 1) (Rad (begin + bent))) (Vec.polar (Mm 1) (Rad (final - bent)))
      ]
  pure (Table ends points)

-- | A spline through a few arbitrary points. Its direction may reverse within one span.
zigzag :: Gen Curve
zigzag = do
  ends <- elements [Natural, Periodic]
  n <- choose (if ends == Periodic then 3 else 2, 6)
  points <-
    vectorOf n (Vec.point <$> choose (0, 100) <*> choose (0, 100)) `suchThat` \ps ->
      and [Vec.distance p q > Mm 5 | p : rest <- tails ps, q <- rest]
  pure (ok (splineOf (Table ends points)))

-- | A closed spline around a centre.
ring :: Gen Curve
ring = ok . splineOf <$> closedRing

-- | The table of a closed spline of either sense. The first point may be repeated.
closedRing :: Gen Table
closedRing = do
  n <- frequency [(1, pure 3), (3, choose (5, 12)), (2, choose (20, 60))]
  sense <- elements [1, -1]
  from <- choose (0, 6)
  a <- choose (30, 60)
  b <- choose (0, 8)
  lobes <- elements [2, 3]
  centre <- Vec.point <$> choose (-100, 100) <*> choose (-100, 100)
  repeated <- arbitrary
  let angle k = from + sense * 2 * pi * fromIntegral k / fromIntegral n
      point k = Vec.shift (Vec.polar (Mm (a + b * cos (lobes * angle k))) (Rad (angle k))) centre
      points = map point [0 .. n - 1 :: Int]
  pure (Table Periodic (points <> [p | repeated, p <- take 1 points]))

-- | A polyline, open or closed. Its direction may reverse at a point.
polyline :: Gen Curve
polyline = do
  n <- choose (1, 8)
  turns <- vectorOf n (frequency [(5, choose (-1.2, 1.2)), (1, pure pi), (1, pure (pi / 2))])
  Table _ points <- fromTurns 0 turns
  closing <- arbitrary
  let closedUp = points <> [p | closing, length points > 2, p <- take 1 points]
  pure
    ( fromRight
        (ok (Curve.polyline (Exts.fromList points)))
        (Curve.polyline (Exts.fromList closedUp))
    )

-- | A chain of parabolas with rising or falling x.
parabola :: Gen Curve
parabola = do
  n <- (\k -> 2 * k + 1) <$> choose (1, 5)
  sense <- elements [1, -1]
  steps <- vectorOf n (choose (4, 12))
  slopes <- vectorOf n (choose (-0.6, 0.6))
  let xs = scanl1 (+) (map (sense *) steps)
      ys = scanl1 (+) (zipWith (*) slopes steps)
  pure (ok (Curve.parabola (Exts.fromList (zipWith Vec.point xs ys))))

-- | A chain of lines and arcs, with and without corners.
toSegments :: Gen Curve
toSegments = do
  n <- choose (1, 6)
  parts <-
    vectorOf
      n
      ((,,) <$> choose (-2, 2) <*> choose (10, 40) <*> frequency [(2, pure 0), (1, choose (-1, 1))])
  pure (ok (Curve.fromSegments (segments (Vec.point 3 (-4)) 0.3 parts)))
  where
    segments p heading parts = case parts of
      [] -> Straight p (Vec.shift (Vec.polar (Mm 10) (Rad heading)) p) :| []
      part : rest ->
        let s = next p heading part
            (sweep, _, corner) = part
            after = if abs sweep < 0.2 then heading + corner else heading + sweep + corner
         in s :| if null rest then [] else NonEmpty.toList (segments (Segment.end s) after rest)
    next p heading (sweep, l, _) = Run.arcFrom p heading (if abs sweep < 0.2 then 0 else sweep) l

-- | A line, a parabola tangent to it, and an arc tangent to the parabola. The rows of the curve are
-- at random positions on them.
pieces :: Gen Curve
pieces = do
  a <- choose (-0.02, 0.02)
  l <- choose (5, 30)
  w <- choose (5, 30)
  r <- elements [20, -20, 35]
  inner <- vectorOf 5 (choose (0.1, 0.59))
  let top = Vec.point w (a * w * w)
      slope = atan (2 * a * w)
      centre = Vec.shift (Vec.scale r (Vec.left (Vec.polar (Mm 1) (Rad slope)))) top
      sweep = signum r * 0.8
      arc =
        Arc
          { start = top,
            end = Vec.shift (Vec.rotate (Rad sweep) (Vec.to centre top)) centre,
            centre,
            sweep = Rad sweep
          }
  pure
    ( ok
        ( Curve.fromShapes
            (Line (Vec.point (-l) 0) (Vec.point 0 0) :| [Quadratic a 0 0 0 w, Circular arc])
            (Exts.fromList (scanl (+) 0 inner <> [3]))
        )
    )

-- | A Bézier curve of any degree, with and without weights.
bezier :: Gen Curve
bezier = do
  n <- frequency [(3, choose (2, 7)), (1, choose (8, 21))]
  points <- controlPoints n
  ws <- weights n
  pure (ok (Curve.bezier (Exts.fromList points) ws))

-- | A B-spline of a degree up to 6, with and without weights, with any knots.
bspline :: Gen Curve
bspline = do
  degree <- choose (1, 6)
  n <- choose (degree + 1, degree + 6)
  points <- controlPoints n
  ws <- weights n
  knots <- knotsFor degree n
  pure (ok (Curve.bspline (ok (Curve.knotVector degree n knots)) (Exts.fromList points) ws))

-- | Control points of a curve whose direction turns by less than a right angle.
controlPoints :: Int -> Gen [Point]
controlPoints n = do
  begin <- choose (-3.1, 3.1)
  turns <- vectorOf (n - 1) (choose (-1.5 / fromIntegral n, 1.5 / fromIntegral n))
  Table _ points <- fromTurns begin turns
  pure points

-- | Weights of control points, or none.
weights :: Int -> Gen (Maybe Curve.Weights)
weights n = do
  list <- vectorOf n (choose (0.5, 2))
  elements [Nothing, Just (ok (Curve.weightsFor n list))]

-- | The knots of a B-spline with n control points. Those outside of the curve may differ from its
-- ends or not, and some knots within it are equal.
knotsFor :: Int -> Int -> Gen [Double]
knotsFor degree n = do
  begin <- choose (-5, 5)
  isClamped <- arbitrary
  outer <- vectorOf (2 * degree) (choose (0.2, 2))
  runs <- lengths (n - degree - 1)
  steps <- vectorOf (length runs + 1) (choose (0.2, 2))
  let inner = drop 1 (scanl (+) begin steps)
      (before, after) = splitAt degree (map (if isClamped then const 0 else id) outer)
  pure
    ( reverse (drop 1 (scanl (-) begin before))
        <> [begin]
        <> concat (zipWith replicate runs inner)
        <> scanl (+) (last inner) after
    )
  where
    -- Multiplicities, each at most the degree, of @count@ knots together.
    lengths count
      | count <= 0 = pure []
      | otherwise = do
        k <- frequency [(3, pure 1), (1, choose (1, min count degree))]
        (k :) <$> lengths (count - k)

-- | A parameter of a curve as a fraction of its domain, from 0 to 1. It may be at a row or an end.
parameter :: Gen Double
parameter = frequency [(8, choose (0, 1)), (1, elements [0, 1, 0.5])]

-- | The parameter of a curve at a fraction of its domain.
parameterOf :: Curve -> Double -> Double
parameterOf curve share = share * Curve.domain curve

-- | The largest absolute curvature at 12 points of each span, in 1/mm.
tightest :: Curve -> Double
tightest curve =
  maximum
    [ abs (Curve.curvature curve (a + (b - a) * k / 12))
      | (a, b) <- zip bs (drop 1 bs),
        k <- [0.01 .. 12]
    ]
  where
    bs = Curve.breaks curve

-- | A column of a curve: values between @low@ and @high@ that change slowly from row to row.
columnOf :: Curve -> Double -> Double -> Gen Curve.Column
columnOf curve low high = do
  middle <- choose (low, high)
  wave <- choose (0, min (high - middle) (middle - low))
  phase <- choose (0, 6)
  let n = length (BasisCurve.rows (Curve.base curve))
      repeated = Curve.isClosed curve && not (BasisCurve.lacksRepeatedStart (Curve.base curve))
      turns = 2 * pi / fromIntegral (if repeated then n - 1 else n)
      value k =
        if repeated && k == n - 1
          then value 0
          else middle + 0.5 * wave * sin (phase + turns * fromIntegral k)
  pure (Curve.column curve (Exts.fromList (map value [0 .. n - 1])))

-- | A shift distance of any kind, at most @reach@ mm.
distance :: Double -> Curve -> Gen Distance
distance reach curve =
  oneof
    [ Constant . Mm <$> choose (0, reach),
      Pointwise <$> columnOf curve 0 reach,
      bevelled,
      Growing <$> growth,
      Square <$> columnOf curve (-0.5) 0.5 <*> (Constant . Mm <$> choose (0, 0.8 * reach)),
      Square <$> columnOf curve (-0.5) 0.5 <*> (Growing <$> growth),
      fitJoggle
    ]
  where
    bevelled =
      Bevelled
        <$> columnOf curve (-0.4) 0.4
          <*> columnOf curve 0 reach
          <*> (Mm <$> choose (0, 0.5 * reach))
    growth = do
      h1 <- choose (0, 0.8 * reach)
      h2 <- choose (0, 0.8 * reach)
      a <- choose (0.05, 0.4)
      b <- choose (0.6, 0.95)
      ends <- elements [Nothing, Just (parameterOf curve a, parameterOf curve b)]
      pure Growth {from = Mm h1, to = Mm h2, between = ends}
    fitJoggle = do
      a <- choose (0.05, 0.2)
      b <- choose (0.8, 0.95)
      d <- choose (0.2, 0.8) >>= \share -> pure (share * min 1 reach)
      k <- choose (0.6, 3)
      flip' <- elements [1, -1]
      pure
        ( fromRight
            (Constant (Mm d))
            ( Curve.fitJoggle
                Joggle
                  { begins = parameterOf curve a,
                    ends = parameterOf curve b,
                    depth = Mm (flip' * d),
                    radius = Mm (k * d)
                  }
                curve
            )
        )

-- | A curve, shifted by a distance that is well below its radius of curvature.
shifts :: Curve -> Gen Curve
shifts curve = do
  side <- elements [LeftOf, RightOf]
  d <- distance (min 5 (0.3 / (1e-9 + tightest curve))) curve
  let s = Curve.shifted side d curve
  pure
    (case Curve.firstCusp s of Nothing -> s; Just _ -> Curve.shifted side (Constant (Mm 0)) curve)

-- | A curve that is shifted up to @most@ times.
layered :: Int -> Gen Curve -> Gen Curve
layered most gen = do
  curve <- gen
  n <- choose (0, most)
  go n curve
  where
    go :: Int -> Curve -> Gen Curve
    go n curve = if n <= 0 then pure curve else shifts curve >>= go (n - 1)

-- | A product of up to four transformations: a translation, a rotation, a reflection, a scaling.
similarity :: Gen Transformation
similarity = do
  v <- Vec.vec <$> choose (-50, 50) <*> choose (-50, 50)
  p <- Vec.point <$> choose (-50, 50) <*> choose (-50, 50)
  q <- Vec.shift <$> (Vec.polar (Mm 10) . Rad <$> choose (0, 6)) <*> pure p
  a <- choose (-3, 3)
  k <- choose (0.3, 3)
  chosen <-
    sublistOf
      [ Transformation.translation v,
        Transformation.rotation (Rad a) p,
        Transformation.reflection (Carrier.Line p q),
        Transformation.scaling k p
      ]
  pure (foldr Transformation.after Transformation.identity chosen)
