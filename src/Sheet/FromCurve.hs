-- | A curve with its recalculations as a piece of a sheet.
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
import Data.Maybe (listToMaybe)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Curve qualified as Curve
import Geometry.Curve.Base qualified as Base
import Geometry.Curve.Column qualified as Column
import Geometry.Curve.ShiftDistance (Distance, Growth (..))
import Geometry.Curve.ShiftDistance qualified as ShiftDistance
import Geometry.Vec qualified as Vec
import Numeric (showEFloat)
import Part.Part (Finish)
import Part.Part qualified as Part
import Sheet.Sheet
import Sheet.Unsupported (Unfit (..))
import Text.Read (readMaybe)

-- | One shift: 1 to the left of the walk, -1 to the right; whether its distance is square to the
-- surface; the distance.
data Shift = Shift {sign :: Double, square :: Maybe (Vector Double), distance :: Distance}

-- | The piece that is walked at a place, if there is one.
piece :: Region -> Curve.Curve -> Finish -> Result w Unfit Piece
piece at curve finish = do
  base <- pointsOf at (Curve.base curve)
  let shifts = map shiftOf (Curve.layers curve)
      sides = if sideSign shifts < 0 then RightSide else LeftSide
      turned = map (turnedTo (sideSign shifts)) shifts
  mapM_ (plain at) turned
  surface <- surfaceOf at (Vector.length base) turned
  rows <-
    maybe
      (refused (NoPiece at "a curve of no points" ""))
      pure
      ( NonEmpty.nonEmpty
          (zipWith row (Vector.toList base) (maybe (repeat Nothing) (map Just) surface))
      )
  let cipher =
        map recalculation turned <> [Bevelled | not (any isBevelled turned), Just _ <- [surface]]
  pure
    Piece
      { towards = here (if null cipher then LeftSide else sides),
        cipher = here cipher,
        rows,
        slow = here (Part.slow finish),
        allowance = let Mm a = Part.allowance finish in here a
      }
  where
    row p s = PointRow {px = here (Vec.x p), py = here (Vec.y p), surface = s}
    isBevelled s = case distance s of
      ShiftDistance.Bevelled {} -> True
      _ -> False

here :: a -> Located a
here = Located (Region 0 0)

refused :: Unfit -> Result w Unfit a
refused e = Result [] [e] Nothing

-- | The points of a natural spline, or of a straight line from one to another.
pointsOf :: Region -> Base.Base -> Result w Unfit (Vector Vec.Point)
pointsOf at base = case Base.method base of
  Base.Spline Base.Natural -> pure points
  Base.Polyline | Vector.length points == 2 -> pure points
  _ ->
    refused
      ( NoPiece
          at
          "this curve"
          "The curve of a piece is a spline through the points of a table, or a polyline through \
          \two points."
      )
  where
    points = Vector.map Base.place (Base.rows base)

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
    sign = case side of
      Carrier.LeftOf -> 1
      Carrier.RightOf -> -1

-- | The side to which the distances of a piece count: that of its first distance before the points;
-- where that is nothing or 0, the side of the first shift.
sideSign :: [Shift] -> Double
sideSign shifts = case listToMaybe [sign s * h | s <- shifts, Just h <- [headOf (distance s)]] of
  Just h | h /= 0 -> signum h
  _ -> maybe 1 sign (listToMaybe shifts)
  where
    headOf d = case d of
      ShiftDistance.Constant (Mm h) -> Just h
      ShiftDistance.Growing Growth {from = Mm h} -> Just h
      _ -> Nothing

-- | The same shift as one to another side.
turnedTo :: Double -> Shift -> Shift
turnedTo wanted s
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
    -- Only the values are read.
    negative c = c {Column.values = Vector.map negate (Column.values c)}

-- | What a sheet has no numbers for.
plain :: Region -> Shift -> Result w Unfit ()
plain at s = case distance s of
  ShiftDistance.Bevelled _ _ (Mm delta)
    | delta /= 0 ->
      refused
        ( NoCipher
            at
            "its 4 has an allowance"
            "Write the allowance behind the element: allowance 0.5"
        )
  ShiftDistance.Growing Growth {between = Just _} ->
    refused
      ( NoCipher
          at
          "its 1 changes between two points"
          "On a sheet the distance changes along the whole piece: make pieces of the parts."
      )
  ShiftDistance.Joggled _ ->
    refused
      (NoCipher at "it has a joggle" "Keep the program as it is, or make pieces of the parts.")
  ShiftDistance.Square _ inner -> plain at s {distance = inner}
  ShiftDistance.Bevelled {} -> pure ()
  ShiftDistance.Growing _ -> pure ()
  ShiftDistance.Constant _ -> pure ()
  ShiftDistance.Pointwise _ -> pure ()

-- | The bevel and the height at every point, if a recalculation looks at them.
surfaceOf :: Region -> Int -> [Shift] -> Result w Unfit (Maybe [Surface])
surfaceOf at count shifts
  | null leans = pure Nothing
  | different leans =
    refused
      ( NoCipher
          at
          "its bevels differ from one recalculation to another"
          "On a sheet a point has one bevel."
      )
  | different heights =
    refused
      (NoCipher at "its heights differ from one 4 to another" "On a sheet a point has one height.")
  | any (\s -> null (square s) && needsSquare (distance s)) shifts =
    refused
      ( NoCipher
          at
          "a distance is not square to the surface"
          "On a sheet, distances of a piece with a bevel are square to the surface: 2(h, mu)."
      )
  | otherwise =
    pure
      ( Just
          ( zipWith
              (\m h -> Surface {mu = here (degreesOf m), flange = here h})
              (concatMap toList (take 1 leans))
              (concatMap toList (take 1 heights) <> replicate count 0)
          )
      )
  where
    bevelled =
      [ (Column.values mu, Column.values h)
        | Shift {distance = ShiftDistance.Bevelled mu h _} <- shifts
      ]
    leans = [mu | Shift {square = Just mu} <- shifts] <> map fst bevelled
    heights = map snd bevelled
    different list = case list of
      [] -> False
      x : xs -> any (/= x) xs
    needsSquare d = case d of
      ShiftDistance.Bevelled {} -> False
      _ -> True

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

-- | The shortest number of degrees that is this angle in radians.
degreesOf :: Double -> Double
degreesOf angle = case [d | k <- [0 .. 16], Just d <- [rounded k], d * (pi / 180) == angle] of
  d : _ -> d
  [] -> near
  where
    near = angle / (pi / 180)
    rounded :: Int -> Maybe Double
    rounded k = readMaybe (showEFloat (Just k) near "")
