-- | A base and the shifts laid on it, one on the other, and what they give near a place.
module Geometry.Curve.ShiftedCurve
  ( Curve (..),
    Layer (..),
    Side (..),
    shifted,
    base,
    layers,
    breaks,
    ruler,
    spot,
    jetAt,
    distanceAt,
    domain,
  )
where

import Geometry.Carrier (Side (..))
import Geometry.Curve.Base (Base, SpanPoint (..))
import Geometry.Curve.Base qualified as Base
import Geometry.Curve.ShiftDistance (Below (..), Distance, ShiftInterval)
import Geometry.Curve.ShiftDistance qualified as ShiftDistance
import Geometry.Numeric.ArcLength (ArcLength)
import Geometry.Numeric.ArcLength qualified as ArcLength
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion (Approach (..), TaylorExpansion)
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Vec qualified as Vec

data Curve
  = Plain Base
  | -- | a curve moved along its left normal; the ruler is that of the outcome
    Shifted Layer Curve ~ArcLength
  deriving stock (Eq, Show)

-- | One shift.
data Layer = Layer {side :: Side, distance :: Distance, known :: ~ShiftInterval}
  deriving stock (Eq, Show)

-- | Every point moved along the normal, to a side, by a distance that is known for the curve.
shifted :: Side -> Distance -> Curve -> Curve
shifted side distance lower = whole
  where
    whole =
      Shifted
        Layer {side, distance, known = ShiftDistance.stretch (ruler lower) distance}
        lower
        (ArcLength.measured speed (merged (breaks whole) (knots whole)))
    speed u = Vec.norm (TaylorExpansion.velocity (jetAt 1 whole (spot After u whole)))

-- | What lies under all shifts.
base :: Curve -> Base
base curve = case curve of
  Plain b -> b
  Shifted _ lower _ -> base lower

-- | The shifts, the innermost first.
layers :: Curve -> [(Side, Distance)]
layers curve = reverse (outermost curve)
  where
    outermost c = case c of
      Plain _ -> []
      Shifted layer lower _ -> (side layer, distance layer) : outermost lower

-- | The parameters between which the curve is smooth, in rising order, from its beginning to its
-- end.
breaks :: Curve -> [Double]
breaks curve = case curve of
  Plain b -> map fromIntegral [0 .. Base.count b]
  Shifted layer lower _ -> merged (breaks lower) (filter inside (ShiftDistance.marks (known layer)))
  where
    inside u = u > 0 && u < domain curve

-- | Where a column goes over from one cubic to the next within a span: the curve is smooth there,
-- but a shift of it has no smooth speed.
knots :: Curve -> [Double]
knots curve = case curve of
  Plain _ -> []
  Shifted layer lower _ ->
    merged (knots lower) (filter inside (ShiftDistance.knots (base lower) (distance layer)))
  where
    inside u = u > 0 && u < domain curve

-- | Two rising lists as one, without repetition.
merged :: [Double] -> [Double] -> [Double]
merged as bs = case (as, bs) of
  ([], _) -> bs
  (_, []) -> as
  (a : as', b : bs')
    | a < b -> a : merged as' bs
    | b < a -> b : merged as bs'
    | otherwise -> a : merged as' bs'

-- | The parameter of the end: the number of spans.
domain :: Curve -> Double
domain = fromIntegral . Base.count . base

-- | How far along the curve its parameter leads.
ruler :: Curve -> ArcLength
ruler curve = case curve of
  Plain b -> Base.ruler b
  Shifted _ _ along -> along

-- | The place with a parameter; beyond the ends, the end.
spot :: Approach -> Double -> Curve -> SpanPoint
spot approach u curve = Base.spot approach u (base curve)

-- | The power series of the place up to an order. Every shift asks the curve under it for one order
-- more, but where there is none.
jetAt :: Int -> Curve -> SpanPoint -> TaylorExpansion
jetAt n curve s = case curve of
  Plain b -> Base.jet n b s
  Shifted layer lower _
    | ShiftDistance.vanishes (distance layer) s -> jetAt n lower s
    | otherwise ->
      let near =
            jetAt (n + 1) lower s
       in TaylorExpansion.moved (distanceAt n layer lower near s) near

-- | The power series of a shift's distance to the left up to an order, given the curve below near
-- the spot.
distanceAt :: Int -> Layer -> Curve -> TaylorExpansion -> SpanPoint -> PowerSeries
distanceAt n layer lower near s = case side layer of
  LeftOf -> d
  RightOf -> PowerSeries.scale (-1) d
  where
    d =
      ShiftDistance.series
        n
        Below {under = base lower, along = ruler lower, near}
        (known layer)
        (distance layer)
        s
