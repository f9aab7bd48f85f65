-- | Distances by which shifts move the points of a curve along its normals. A cipher is the digit
-- that names a kind of distance on the input sheet of the Minsk-22 system (Kolsanova, section 5).
--
-- A distance belongs to the curve that it shifts and may depend on that curve's arc length. It is
-- in mm, and positive towards the side of the shift. A position on a curve is a parameter, and the
-- direction from which it is approached: from smaller or from larger parameters.
module Geometry.Curve.ShiftDistance
  ( Distance (..),
    Growth (..),
    Joggle (..),
    ramp,
    ShiftInterval,
    intervalOf,
    marks,
    knots,
    CurveBelow (..),
    vanishes,
    series,
    scaled,
    reversed,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Geometry.Curve.BasisCurve (BasisCurve, CurvePosition (..), SpanPoint)
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Curve.Column (Column)
import Geometry.Curve.Column qualified as Column
import Geometry.Numeric.ArcLength (ArcLength)
import Geometry.Numeric.ArcLength qualified as ArcLength
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion (Approach (..), TaylorExpansion)
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Tolerance qualified as Tolerance

-- | Distance of a shift as a function of the position on the curve.
data Distance
  = -- | constant (cipher 2)
    Constant Mm
  | -- | the distances in mm at the rows of the curve's point table, interpolated between the rows
    -- (cipher 6)
    Pointwise Column
  | -- | @H·tan μ + δ@ for a bevel μ (radians), a flange height H (mm) and an allowance δ (cipher 4)
    Bevelled Column Column Mm
  | -- | linear in arc length (cipher 1)
    Growing Growth
  | -- | @d / cos μ@ for the bevel μ (radians) of a surface, and a distance d that is measured
    -- square to this surface
    Square Column Distance
  | -- | a local step of the edge; the distance is 0 outside of it
    Joggled Joggle
  deriving stock (Eq, Show)

-- | Linear growth of the distance along the curve. @between@ has the two parameters between which
-- it grows, in ascending order; Nothing means the whole curve. Before the first parameter the
-- distance is @from@, after the second it is @to@.
data Growth = Growth {from :: Mm, to :: Mm, between :: Maybe (Double, Double)}
  deriving stock (Eq, Show)

-- | Joggle: a local step of the edge between the parameters @begins@ and @ends@, in ascending
-- order. Inside of this interval, a ramp at each end leads to the full depth. A ramp consists of
-- two arcs of the given radius, which is more than half of the depth. A negative depth shifts away
-- from the side of the shift.
data Joggle = Joggle {begins :: Double, ends :: Double, depth :: Mm, radius :: Mm}
  deriving stock (Eq, Show)

-- | Length in mm of a joggle's ramp, @√(d·(4r − d))@ with the absolute value d of the depth, and
-- the radius r.
ramp :: Joggle -> Mm
ramp Joggle {depth = Mm d, radius = Mm r} = Mm (sqrt (max 0 (abs d * (4 * r - abs d))))

-- | Interval of a shift: the part of the curve on which the distance changes. @marks@ are the
-- parameters at which the formula of the distance changes. @first@ and @final@ are the arc lengths,
-- from the curve's start, at the beginning and at the end of the interval.
data ShiftInterval = ShiftInterval
  { -- | parameters in ascending order; empty if one formula holds for the whole curve
    marks :: [Double],
    first :: Mm,
    final :: Mm
  }

-- | All intervals compare equal: a distance and its curve, which are compared as well, determine
-- the interval.
instance Eq ShiftInterval where
  _ == _ = True

instance Show ShiftInterval where
  show _ = "ShiftInterval"

-- | Interval on which @distance@ changes. For a joggle, and for a distance that grows from one
-- parameter to another, it lies between the two parameters. For a 'Square' distance it is that of
-- the distance inside. Otherwise it is the whole curve. @arcLength@ is the arc length of the curve
-- as a function of its parameter.
intervalOf :: ArcLength -> Distance -> ShiftInterval
intervalOf arcLength distance = case distance of
  Constant _ -> wholeCurve
  Pointwise _ -> wholeCurve
  Bevelled {} -> wholeCurve
  Growing Growth {between = Nothing} -> wholeCurve
  Growing Growth {between = Just (a, b)} ->
    ShiftInterval
      { marks = [a, b],
        first = ArcLength.lengthAt arcLength a,
        final = ArcLength.lengthAt arcLength b
      }
  Square _ inner -> intervalOf arcLength inner
  Joggled joggle@Joggle {begins, ends} ->
    let first = ArcLength.lengthAt arcLength begins
        final = ArcLength.lengthAt arcLength ends
        on share = ArcLength.parameterAt arcLength (plus first (times share (ramp joggle)))
        off share = ArcLength.parameterAt arcLength (minus final (times share (ramp joggle)))
     in ShiftInterval {marks = [begins, on 0.5, on 1, off 1, off 0.5, ends], first, final}
  where
    wholeCurve = ShiftInterval {marks = [], first = Mm 0, final = ArcLength.total arcLength}

-- | Parameters of the base, in ascending order, at which the columns of a distance change from one
-- cubic to the next. There the third derivative of the distance may jump. It may also jump at the
-- 'marks' of the distance and at the ends of the base's spans, but the result does not contain
-- these.
knots :: BasisCurve -> Distance -> [Double]
knots base distance = case distance of
  Constant _ -> []
  Pointwise c -> Column.knots base c
  -- Both columns belong to the same table, so the knots of one are enough.
  Bevelled mu _ _ -> Column.knots base mu
  Growing _ -> []
  Square mu _ -> Column.knots base mu
  Joggled _ -> []

-- | True if a distance is 0 at a position and near it, as outside of a joggle. Then the curve need
-- not be shifted there.
vanishes :: Distance -> CurvePosition -> Bool
vanishes distance position = case distance of
  Joggled Joggle {begins, ends} -> not (position `isPast` begins) || position `isPast` ends
  Square _ inner -> vanishes inner position
  Constant h -> h == Mm 0
  Pointwise _ -> False
  Bevelled {} -> False
  Growing _ -> False

-- | Properties of the curve that is shifted: its base, its arc length, its Taylor expansion about a
-- position, and the point of the base below it. The arc lengths are evaluated only for distances
-- that depend on them.
data CurveBelow = CurveBelow
  { under :: BasisCurve,
    along :: ~ArcLength,
    -- | arc length in mm from the position's home to its parameter; 0 if both are equal
    beyond :: ~Double,
    near :: TaylorExpansion,
    -- | the position's point on the base
    onBase :: SpanPoint,
    -- | derivative of the parameter of the base by that of the curve
    baseRate :: Double
  }

-- | Power series of the distance in mm about a position, up to the power @n@ of the parameter. The
-- expansion in @below@ must go at least to the power @n@.
series :: Int -> CurveBelow -> ShiftInterval -> Distance -> CurvePosition -> PowerSeries
series n below interval distance position = case distance of
  Constant (Mm h) -> PowerSeries.constant n h
  Pointwise c -> columnSeries c
  Bevelled mu height (Mm delta) ->
    PowerSeries.plusConstant
      delta
      ( PowerSeries.multiply
          (columnSeries height)
          (PowerSeries.tangent (columnSeries mu))
      )
  Growing growth -> growthSeries n below interval growth position
  Square mu inner ->
    PowerSeries.divide
      (series n below interval inner position)
      (PowerSeries.cosine (columnSeries mu))
  Joggled joggle -> joggleSeries n below interval joggle position
  where
    columnSeries c =
      PowerSeries.stretched (baseRate below) (Column.series n (under below) c (onBase below))

-- | Power series of the distance of a growth from h₁ to h₂, up to the power @n@. Let s be the arc
-- length from the start of the growth, and S the arc length of the whole growth. Within the growth,
-- the distance is @h₁ + (h₂ − h₁)·s/S@ (Kolsanova, cipher 1).
growthSeries :: Int -> CurveBelow -> ShiftInterval -> Growth -> CurvePosition -> PowerSeries
growthSeries n below interval Growth {from = Mm h1, to = Mm h2, between} position = case between of
  Nothing -> inside
  Just _ -> case marksBefore position (marks interval) of
    0 -> PowerSeries.constant n h1
    1 -> inside
    _ -> PowerSeries.constant n h2
  where
    Mm s1 = first interval
    Mm s2 = final interval
    inside
      | s2 > s1 =
        PowerSeries.plusConstant
          h1
          ( PowerSeries.scale
              ((h2 - h1) / (s2 - s1))
              (PowerSeries.plusConstant (-s1) (lengthSeries n below position))
          )
      | otherwise = PowerSeries.constant n h1

-- | Power series of the distance of a joggle with the radius r, up to the power @n@. Let d be the
-- absolute value of the depth, and t the arc length from the outer end of a ramp of length ℓ. The
-- distance is @r − √(r² − t²)@ up to the middle of the ramp, then @d − (r − √(r² − (ℓ − t)²))@. It
-- is d between the ramps. For a negative depth, it has the opposite sign.
joggleSeries :: Int -> CurveBelow -> ShiftInterval -> Joggle -> CurvePosition -> PowerSeries
joggleSeries n below interval joggle@Joggle {depth = Mm depth, radius = Mm r} position =
  PowerSeries.scale (signum depth) $
    case marksBefore position (marks interval) of
      1 -> lowerArc (PowerSeries.plusConstant (-s1) runLength)
      2 -> upperArc (PowerSeries.plusConstant (-s1) runLength)
      3 -> PowerSeries.constant n d
      4 -> upperArc (PowerSeries.plusConstant s2 (PowerSeries.scale (-1) runLength))
      5 -> lowerArc (PowerSeries.plusConstant s2 (PowerSeries.scale (-1) runLength))
      _ -> PowerSeries.constant n 0
  where
    d = abs depth
    runLength = lengthSeries n below position
    Mm s1 = first interval
    Mm s2 = final interval
    Mm l = ramp joggle
    arcRise t =
      PowerSeries.plusConstant
        r
        ( PowerSeries.scale
            (-1)
            ( PowerSeries.power
                0.5
                ( PowerSeries.plusConstant
                    (r * r)
                    (PowerSeries.scale (-1) (PowerSeries.multiply t t))
                )
            )
        )
    lowerArc t = arcRise t
    upperArc t =
      PowerSeries.plusConstant
        d
        (PowerSeries.scale (-1) (arcRise (PowerSeries.plusConstant (-l) t)))

-- | Power series about the position, up to the power @n@. It gives the arc length in mm from the
-- start of the curve below to a point near the position.
lengthSeries :: Int -> CurveBelow -> CurvePosition -> PowerSeries
lengthSeries n below position = case n of
  0 -> PowerSeries.constant 0 runLength
  _ -> PowerSeries.integral runLength (TaylorExpansion.speed (near below))
  where
    Mm upToHome = ArcLength.lengthAt (along below) (home position)
    runLength = upToHome + beyond below

-- | Count of the given marks (parameters) before a position. It tells which formula gives the
-- distance at this position.
marksBefore :: CurvePosition -> [Double] -> Int
marksBefore position = length . filter (position `isPast`)

-- | True if the home of a position is past the parameter @mark@. A position at @mark@ itself counts
-- as past if it is approached from larger parameters, otherwise as not past.
isPast :: CurvePosition -> Double -> Bool
isPast position mark = case approach position of
  After -> mark <= home position + Tolerance.sameParameter
  Before -> mark < home position - Tolerance.sameParameter

-- | Distance for a curve that is scaled by the factor @k@, given the scaled base. Angles do not
-- change.
scaled :: BasisCurve -> Double -> Distance -> Distance
scaled on k distance = case distance of
  Constant h -> Constant (times k h)
  Pointwise c -> Pointwise (Column.scaled on k c)
  Bevelled mu height delta ->
    Bevelled (Column.scaled on 1 mu) (Column.scaled on k height) (times k delta)
  Growing growth -> Growing growth {from = times k (from growth), to = times k (to growth)}
  Square mu inner -> Square (Column.scaled on 1 mu) (scaled on k inner)
  Joggled joggle ->
    Joggled joggle {depth = times k (depth joggle), radius = times k (radius joggle)}

-- | Distance for the reversed curve. @old@ is the base of the curve, @new@ the reversed base.
reversed :: BasisCurve -> BasisCurve -> Distance -> Distance
reversed old new distance = case distance of
  Constant h -> Constant h
  Pointwise c -> Pointwise (reverseColumn c)
  Bevelled mu height delta -> Bevelled (reverseColumn mu) (reverseColumn height) delta
  Growing growth ->
    Growing
      Growth
        { from = to growth,
          to = from growth,
          between = fmap (\(a, b) -> (n - b, n - a)) (between growth)
        }
  Square mu inner -> Square (reverseColumn mu) (reversed old new inner)
  Joggled joggle -> Joggled joggle {begins = n - ends joggle, ends = n - begins joggle}
  where
    reverseColumn = Column.reversed old new
    n = fromIntegral (BasisCurve.count old)
