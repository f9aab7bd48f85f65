-- | Curves: a base curve with any number of shifts, each of which is a layer on top of the curve
-- below. They are evaluated by power series through all layers. A span is a part of the base on
-- which one formula gives the points. The parameter of a curve rises by 1 over each span.
module Geometry.Curve.ShiftedCurve
  ( Curve (..),
    Layer (..),
    Side (..),
    shifted,
    base,
    layers,
    breaks,
    arcLength,
    spanPoint,
    expansionAt,
    distanceAt,
    domain,
  )
where

import Base.Quantity (Rad (..))
import Data.List (zip4)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Geometry.Carrier (Side (..))
import Geometry.Curve.BasisCurve (BasisCurve, SpanPoint (..))
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Curve.ShiftDistance (CurveBelow (..), Distance, ShiftInterval)
import Geometry.Curve.ShiftDistance qualified as ShiftDistance
import Geometry.Numeric.ArcLength (ArcLength)
import Geometry.Numeric.ArcLength qualified as ArcLength
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion (Approach (..), TaylorExpansion)
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Vec)
import Geometry.Vec qualified as Vec

-- | Curve with any number of shifts.
data Curve
  = -- | a curve without shifts
    Unshifted BasisCurve
  | -- | the shift, the curve below, and the arc length of the result
    Shifted Layer Curve ~ArcLength
  deriving stock (Eq, Show)

-- | One shift: its side, its distance, the interval over which the distance changes, and the turns
-- of the normals beside slight corners.
data Layer = Layer
  { side :: Side,
    distance :: Distance,
    interval :: ~ShiftInterval,
    turns :: ~NormalTurns
  }
  deriving stock (Eq, Show)

-- | Turns of the normals of a curve beside its slight corners: the smooth stretches that have such
-- corners at their ends, by their first parameters.
newtype NormalTurns = NormalTurns (Map Double TurnedStretch)

-- | All turns compare equal: the curve whose normals they turn determines them.
instance Eq NormalTurns where
  _ == _ = True

instance Show NormalTurns where
  show _ = "NormalTurns"

-- | Last parameter of a smooth stretch, and the angles in radians, counter-clockwise, by which the
-- normals at its begin and at its end are turned.
data TurnedStretch = TurnedStretch {end :: Double, atBegin :: Double, atEnd :: Double}

-- | Curve @lower@ moved along its normal to a side. The distance is a function of the position on
-- @lower@.
shifted :: Side -> Distance -> Curve -> Curve
shifted side distance lower = whole
  where
    whole =
      Shifted
        Layer
          { side,
            distance,
            interval = ShiftDistance.intervalOf (arcLength lower) distance,
            turns = turnsOf lower
          }
        lower
        (ArcLength.fromSpeed speed (merge (breaks whole) (knots whole)))
    speed u = Vec.norm (TaylorExpansion.velocity (expansionAt 1 whole (spanPoint After u whole)))

-- | Base, the unshifted curve below all shifts.
base :: Curve -> BasisCurve
base curve = case curve of
  Unshifted b -> b
  Shifted _ lower _ -> base lower

-- | Sides and distances of the shifts, the innermost first.
layers :: Curve -> [(Side, Distance)]
layers curve = reverse (outermost curve)
  where
    outermost c = case c of
      Unshifted _ -> []
      Shifted layer lower _ -> (side layer, distance layer) : outermost lower

-- | Parameters, in ascending order, between which the curve is smooth. The first is 0, the last is
-- that of the curve's end.
breaks :: Curve -> [Double]
breaks curve = case curve of
  Unshifted b -> map fromIntegral [0 .. BasisCurve.count b]
  Shifted layer lower _ ->
    merge (breaks lower) (filter isInside (ShiftDistance.marks (interval layer)))
  where
    isInside u = u > 0 && u < domain curve

-- | Parameters, in ascending order, at which the distance of a shift changes from one cubic to the
-- next, because it interpolates between the rows of a table. The tangent of the curve is continuous
-- there, but a higher derivative may jump. So the table of arc lengths has a new interval at each
-- of these parameters.
knots :: Curve -> [Double]
knots curve = case curve of
  Unshifted _ -> []
  Shifted layer lower _ ->
    merge (knots lower) (filter isInside (ShiftDistance.knots (base lower) (distance layer)))
  where
    isInside u = u > 0 && u < domain curve

-- | Union of two ascending lists.
merge :: [Double] -> [Double] -> [Double]
merge as bs = case (as, bs) of
  ([], _) -> bs
  (_, []) -> as
  (a : as', b : bs')
    | a < b -> a : merge as' bs
    | b < a -> b : merge as bs'
    | otherwise -> a : merge as' bs'

-- | Parameter of the curve's end, which is the count of spans.
domain :: Curve -> Double
domain = fromIntegral . BasisCurve.count . base

-- | Arc length along the curve as a function of its parameter.
arcLength :: Curve -> ArcLength
arcLength curve = case curve of
  Unshifted b -> BasisCurve.arcLength b
  Shifted _ _ along -> along

-- | Position with the parameter @u@: the span of the base that contains it, and the local
-- parameter, from 0 to 1, in this span. At a joint of two spans it lies in the earlier span for
-- 'Before' and in the later one for 'After'. A parameter outside of the domain gives the nearer
-- end.
spanPoint :: Approach -> Double -> Curve -> SpanPoint
spanPoint approach u curve = BasisCurve.spanPoint approach u (base curve)

-- | Taylor expansion of the curve's point, in mm, about the position @s@, up to the power @n@ of
-- the parameter. To evaluate a shift, the curve below is expanded to one power more, except where
-- the shift's distance is identically 0.
expansionAt :: Int -> Curve -> SpanPoint -> TaylorExpansion
expansionAt n curve s = case curve of
  Unshifted b -> BasisCurve.expansion n b s
  Shifted layer lower _
    | ShiftDistance.vanishes (distance layer) s -> expansionAt n lower s
    | otherwise ->
      let near =
            expansionAt (n + 1) lower s
       in TaylorExpansion.offset (turnAt n (turns layer) s) (distanceAt n layer lower near s) near

-- | Power series of a shift's distance in mm, positive to the left, about a position. The arguments
-- are the highest power, the shift, the curve below, the expansion of that curve about the
-- position, and the position.
distanceAt :: Int -> Layer -> Curve -> TaylorExpansion -> SpanPoint -> PowerSeries
distanceAt n layer lower near s = case side layer of
  LeftOf -> d
  RightOf -> PowerSeries.scale (-1) d
  where
    d =
      ShiftDistance.series
        n
        CurveBelow {under = base lower, along = arcLength lower, near}
        (interval layer)
        (distance layer)
        s

-- Normals beside slight corners -------------------------------------------------------------------

-- | Turns of the normals of a curve. At a slight corner the normals before and after it are turned
-- to their mean. At the start and the end of a closed curve this needs both of them to be one
-- point.
turnsOf :: Curve -> NormalTurns
turnsOf curve =
  NormalTurns
    ( Map.fromDistinctAscList
        [ (a, TurnedStretch {end = b, atBegin = -(before / 2), atEnd = after / 2})
          | (a, b, before, after) <- zip4 bs (drop 1 bs) corners (drop 1 corners),
            before /= 0 || after /= 0
        ]
    )
  where
    bs = breaks curve
    seam = slightCorner (lastUnit, firstUnit)
    corners = [seam] <> map (\u -> slightCorner (unit Before u, unit After u)) inner <> [seam]
    inner = drop 1 (take (length bs - 1) bs)
    (firstUnit, lastUnit)
      | Vec.isNear (point After 0) (point Before (domain curve)) =
        (unit After 0, unit Before (domain curve))
      | otherwise = (Nothing, Nothing)
    point approach u = TaylorExpansion.position (expansionAt 0 curve (spanPoint approach u curve))
    unit approach u =
      TaylorExpansion.direction approach (expansionAt 1 curve (spanPoint approach u curve))

-- | Angle in radians between two directions, counter-clockwise, if it is that of a slight corner.
-- Otherwise 0, also if there is no direction.
slightCorner :: (Maybe Vec, Maybe Vec) -> Double
slightCorner directions = case directions of
  (Just before, Just after)
    | Rad a <- Vec.signedAngle before after,
      Rad (abs a) > Tolerance.smoothAngle,
      Rad (abs a) <= Tolerance.kink ->
      a
  _ -> 0

-- | Turn of the normal about a position as a power series up to the power @n@, in radians. Nothing
-- if the normal is not turned.
turnAt :: Int -> NormalTurns -> SpanPoint -> Maybe PowerSeries
turnAt n (NormalTurns stretches) s
  | Map.null stretches = Nothing
  | otherwise = case found (parameter s) stretches of
    Just (a, TurnedStretch {end, atBegin, atEnd})
      | parameter s <= end ->
        let slope = (atEnd - atBegin) / (end - a)
         in Just (PowerSeries.fromList n [atBegin + slope * (parameter s - a), slope])
    _ -> Nothing
  where
    -- A position before the start of the curve is at its start.
    found = case approach s of
      Before | parameter s > 0 -> Map.lookupLT
      _ -> Map.lookupLE
