-- | Conversion of a curve with its shifts to a piece of an input sheet. A piece consists of points
-- of the curve before all shifts, and of a cipher. Each digit of the cipher expresses one shift,
-- which moves every point along the normal of the curve. On a sheet the shift is called a
-- recalculation. The conversion refuses a curve with a shift that no digit expresses.
--
-- A bevel is the angle between the part's surface and the tool axis. With the flange height at a
-- point it determines the distance by which digit 4 shifts.
module Sheet.FromCurve
  ( piece,
    degreesOf,
    here,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Data.Foldable (toList)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, listToMaybe)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Curve qualified as Curve
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Curve.Column qualified as Column
import Geometry.Curve.ShiftDistance (Distance, Growth (..))
import Geometry.Curve.ShiftDistance qualified as ShiftDistance
import Geometry.Vec qualified as Vec
import Numeric (showEFloat)
import Part.Part (Finish)
import Part.Part qualified as Part
import Sheet.Sheet
import Sheet.Unsupported (PieceFault (..), Unfit (..), UnsupportedCipher (..))
import Text.Read (readMaybe)

-- | One shift of a curve, divided into the numbers that a sheet has for it.
data Shift = Shift
  { -- | the side to which a positive distance shifts: 1 left of the curve's direction, -1 right of
    -- it
    sign :: Double,
    -- | the bevel at each point, in radians, if the distance is measured square to the part's
    -- surface; Nothing if it is measured in the plane of the curve
    square :: Maybe (Vector Double),
    distance :: Distance
  }

-- | Converts the curve of a contour element to a piece of a sheet. The reports point at the region
-- @at@ of the element. @finish@ gives the flag of the feed and the allowance. The piece gets no
-- feed of its own.
piece :: Region -> Curve.Curve -> Finish -> Result w Unfit Piece
piece at curve finish = do
  points <- pointsOf at (Curve.base curve)
  mapM_ (checkShift at) shifts
  surfaces <- surfaceOf at (Vector.length points) shifts
  let withSurfaces = maybe (repeat Nothing) (map Just) surfaces
  rows <-
    maybe
      (refused (NoPiece at NoPoints))
      pure
      (NonEmpty.nonEmpty (zipWith row (Vector.toList points) withSurfaces))
  let cipher =
        map recalculation shifts <> [Bevelled | not (any isBevelled shifts), isJust surfaces]
  pure
    Piece
      { shiftSide = here (if not (null cipher) && side < 0 then RightSide else LeftSide),
        cipher = here cipher,
        rows,
        slow = here (Part.slow finish),
        allowance = let Mm a = Part.allowance finish in here a,
        ownFeed = Nothing
      }
  where
    original = map shiftOf (Curve.layers curve)
    side = signOfPiece original
    shifts = map (onSide side) original
    row p s = PointRow {px = here (Vec.x p), py = here (Vec.y p), surface = s}
    isBevelled s = case distance s of
      ShiftDistance.Bevelled {} -> True
      _ -> False

-- | A value with an empty region, because it does not come from the text of a sheet.
here :: a -> Located a
here = Located (Region 0 0)

refused :: Unfit -> Result w Unfit a
refused e = Result [] [e] Nothing

-- | The points of a natural spline, or the two points of a straight line. Refuses any other curve.
pointsOf :: Region -> BasisCurve.BasisCurve -> Result w Unfit (Vector Vec.Point)
pointsOf at base = case BasisCurve.method base of
  BasisCurve.Spline BasisCurve.Natural -> pure points
  BasisCurve.Polyline | Vector.length points == 2 -> pure points
  _ -> refused (NoPiece at OtherCurve)
  where
    points = Vector.map BasisCurve.knotPoint (BasisCurve.rows base)

-- | One shift of a curve, from the side to which a positive distance shifts, and the distance.
shiftOf :: (Carrier.Side, Distance) -> Shift
shiftOf (side, distance) = case distance of
  ShiftDistance.Square mu inner -> Shift {sign, square = Just (Column.values mu), distance = inner}
  ShiftDistance.Constant _ -> alone
  ShiftDistance.Pointwise _ -> alone
  ShiftDistance.Bevelled {} -> alone
  ShiftDistance.Growing _ -> alone
  ShiftDistance.Joggled _ -> alone
  where
    alone = Shift {sign, square = Nothing, distance}
    sign = Carrier.sideSign side

-- | The side of a piece as a sign: 1 left, -1 right. A sheet has the distances of the digits 1 and
-- 2 before the points, and the sign of the first of them gives the side. So the result is the side
-- to which this distance shifts. If the distance is 0 or missing, the result is the side of the
-- first shift, or 1 if there are no shifts.
signOfPiece :: [Shift] -> Double
signOfPiece shifts = case listToMaybe [sign s * h | s <- shifts, Just h <- [headOf (distance s)]] of
  Just h | h /= 0 -> signum h
  _ -> maybe 1 sign (listToMaybe shifts)
  where
    headOf d = case d of
      ShiftDistance.Constant (Mm h) -> Just h
      ShiftDistance.Growing Growth {from = Mm h} -> Just h
      _ -> Nothing

-- | The shift @s@, expressed so that a positive distance shifts to the side @wanted@ (1 left,
-- -1 right). If @wanted@ is not the 'sign' of @s@, the distances of @s@ change their sign. A joggle
-- stays as it is, because 'checkShift' refuses it.
onSide :: Double -> Shift -> Shift
onSide wanted s
  | wanted == sign s = s
  | otherwise = s {sign = wanted, distance = opposite (distance s)}
  where
    opposite d = case d of
      ShiftDistance.Constant h -> ShiftDistance.Constant (minus h)
      ShiftDistance.Pointwise c -> ShiftDistance.Pointwise (negative c)
      ShiftDistance.Bevelled mu height delta ->
        ShiftDistance.Bevelled mu (negative height) (minus delta)
      ShiftDistance.Growing g -> ShiftDistance.Growing g {from = minus (from g), to = minus (to g)}
      ShiftDistance.Square mu inner -> ShiftDistance.Square mu (opposite inner)
      ShiftDistance.Joggled j -> ShiftDistance.Joggled j
    minus (Mm h) = Mm (negate h)
    -- Negates only the values of the column: this module does not use the column's interpolation.
    negative c = c {Column.values = Vector.map negate (Column.values c)}

-- | Refuses a shift that the numbers of a sheet cannot express.
checkShift :: Region -> Shift -> Result w Unfit ()
checkShift at s = case distance s of
  ShiftDistance.Bevelled _ _ (Mm delta) | delta /= 0 -> refused (NoCipher at AllowanceOfFour)
  ShiftDistance.Growing Growth {between = Just _} -> refused (NoCipher at GrowthBetweenPoints)
  ShiftDistance.Joggled _ -> refused (NoCipher at HasJoggle)
  ShiftDistance.Square _ inner -> checkShift at s {distance = inner}
  ShiftDistance.Bevelled {} -> pure ()
  ShiftDistance.Growing _ -> pure ()
  ShiftDistance.Constant _ -> pure ()
  ShiftDistance.Pointwise _ -> pure ()

-- | The bevel and the flange height at each of @count@ points; Nothing if no shift uses a bevel.
-- Refuses bevels or heights that differ between the shifts. Refuses a distance that is not square
-- to the surface, because a piece with bevels has all distances square to it.
surfaceOf :: Region -> Int -> [Shift] -> Result w Unfit (Maybe [Surface])
surfaceOf at count shifts
  | null bevels = pure Nothing
  | areDifferent bevels = refused (NoCipher at DifferentBevels)
  | areDifferent heights = refused (NoCipher at DifferentHeights)
  | any isNotSquare shifts = refused (NoCipher at DistanceNotSquare)
  | otherwise = pure (Just (zipWith surfaceAt bevelsAtPoints heightsAtPoints))
  where
    bevelled =
      [ (Column.values mu, Column.values h)
        | Shift {distance = ShiftDistance.Bevelled mu h _} <- shifts
      ]
    bevels = [mu | Shift {square = Just mu} <- shifts] <> map fst bevelled
    heights = map snd bevelled
    bevelsAtPoints = concatMap toList (take 1 bevels)
    heightsAtPoints = concatMap toList (take 1 heights) <> replicate count 0
    surfaceAt m h = Surface {mu = here (degreesOf m), flangeHeight = here h}
    areDifferent list = case list of
      [] -> False
      x : xs -> any (/= x) xs
    isNotSquare s = case distance s of
      ShiftDistance.Bevelled {} -> False
      _ -> null (square s)

-- | The recalculation that expresses a shift, which 'checkShift' must have accepted.
recalculation :: Shift -> Recalculation
recalculation s = case distance s of
  ShiftDistance.Growing Growth {from = Mm a, to = Mm b} -> Growing (here a) (here b)
  ShiftDistance.Constant (Mm h) -> Constant (here h)
  ShiftDistance.Bevelled {} -> Bevelled
  ShiftDistance.Pointwise c -> maybe Bevelled (Pointwise . fmap here) (nonEmptyOf (Column.values c))
  ShiftDistance.Square _ inner -> recalculation s {distance = inner}
  ShiftDistance.Joggled _ -> Bevelled
  where
    nonEmptyOf :: Vector Double -> Maybe (NonEmpty Double)
    nonEmptyOf = NonEmpty.nonEmpty . Vector.toList

-- | An angle in radians as degrees: the shortest decimal number whose conversion to radians gives
-- exactly @angle@. If there is none, it is @angle@ divided by π/180, unrounded.
degreesOf :: Double -> Double
degreesOf angle = case [d | k <- [0 .. 16], Just d <- [rounded k], d * (pi / 180) == angle] of
  d : _ -> d
  [] -> near
  where
    near = angle / (pi / 180)
    rounded :: Int -> Maybe Double
    rounded k = readMaybe (showEFloat (Just k) near "")
