-- | How far along a curve its parameter leads: the integral of the speed, kept as a table.
--
-- The stretches between the places where the speed may jump are halved until each piece's speed is
-- a polynomial of degree 7 through the eight nodes of Gauss and Legendre, to 'Tolerance.arcLength'.
-- The table holds that polynomial in Legendre's form; over a whole piece its integral is Gauss's
-- quadrature, within a piece it is known in closed form.
module Geometry.Numeric.ArcLength
  ( ArcLength,
    measured,
    total,
    lengthTo,
    parameterAt,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Base.Quantity (Mm (..))
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Unboxed
import Geometry.Numeric.RootFinding qualified as RootFinding
import Geometry.Tolerance qualified as Tolerance

data ArcLength = ArcLength
  { -- | where each piece begins, in the curve's parameter, and where the last one ends
    starts :: Vector Double,
    -- | how long the curve is up to there, in mm
    lengths :: Vector Double,
    -- | the coefficients of each piece's speed, in mm over the piece, eight a piece
    speeds :: Vector Double
  }

-- | What is measured tells a ruler from another; two of one curve are equal, and computing them is
-- left until they are read.
instance Eq ArcLength where
  _ == _ = True

instance Show ArcLength where
  show _ = "Ruler"

-- | A piece: where it begins, its width in the parameter, and the coefficients of its speed over
-- the piece.
data Piece = Piece Double Double (Vector Double)

-- | The ruler of a speed (mm for 1 of the parameter, not negative) between the first and the last
-- of these places, in rising order; the speed is smooth between neighbours. It is never asked for
-- at the places themselves.
measured :: (Double -> Double) -> [Double] -> ArcLength
measured speed breaks = ArcLength {starts, lengths, speeds}
  where
    pieces = concat (zipWith (measuredBetween speed 0) breaks (drop 1 breaks))
    starts = Unboxed.fromList ([u | Piece u _ _ <- pieces] <> take 1 (reverse breaks))
    lengths = Unboxed.scanl' (+) 0 (Unboxed.fromList [2 * Unboxed.head cs | Piece _ _ cs <- pieces])
    speeds = Unboxed.concat [cs | Piece _ _ cs <- pieces]

-- | The pieces between two places. A speed that is no number ends the halving too.
measuredBetween :: (Double -> Double) -> Int -> Double -> Double -> [Piece]
measuredBetween speed depth a b
  | b <= a = []
  | missed <= allowed || isNaN missed || isInfinite missed || depth >= deepest =
    [Piece a (b - a) cs]
  | otherwise =
    measuredBetween speed (depth + 1) a middle <> measuredBetween speed (depth + 1) middle b
  where
    middle = 0.5 * (a + b)
    half = 0.5 * (b - a)
    sampled = Unboxed.map (\x -> half * speed (middle + half * x)) nodes
    cs =
      Unboxed.generate
        count
        ( \k ->
            Unboxed.sum (Unboxed.imap (\i f -> f * (analysis Unboxed.! (k * count + i))) sampled)
        )
    missed = abs (cs Unboxed.! (count - 2)) + abs (cs Unboxed.! (count - 1))
    Mm finest = Tolerance.arcLength
    allowed = max finest (Tolerance.arcLengthShare * Unboxed.head cs)
    deepest = 16 :: Int

-- | The whole length.
total :: ArcLength -> Mm
total ruler = Mm (Unboxed.last (lengths ruler))

-- | The length up to a parameter.
lengthTo :: ArcLength -> Double -> Mm
lengthTo ruler u
  | Unboxed.null (speeds ruler) || u <= Unboxed.head (starts ruler) = Mm 0
  | u >= Unboxed.last (starts ruler) = total ruler
  | otherwise = Mm (lengths ruler Unboxed.! p + run)
  where
    p = lastBelow u (starts ruler)
    (from, width) = extent ruler p
    (run, _) = within ruler p (2 * (u - from) / width - 1)

-- | The parameter up to which the curve has a length.
parameterAt :: ArcLength -> Mm -> Double
parameterAt ruler (Mm s)
  | Unboxed.null (speeds ruler) || s <= 0 = Unboxed.head (starts ruler)
  | Mm s >= total ruler = Unboxed.last (starts ruler)
  | otherwise =
    from
      + 0.5
        * width
        * ( 1
              + RootFinding.zero
                (\x -> let (run, speed) = within ruler p x in (run - missing, speed))
                (-1)
                1
          )
  where
    p = lastBelow s (lengths ruler)
    (from, width) = extent ruler p
    missing = s - lengths ruler Unboxed.! p

-- | Where a piece begins, and its width in the parameter.
extent :: ArcLength -> Int -> (Double, Double)
extent ruler p =
  let from = starts ruler Unboxed.! p in (from, starts ruler Unboxed.! (p + 1) - from)

-- | The number of the last of these, in rising order, that is not above a number; never that of the
-- very last one.
lastBelow :: Double -> Vector Double -> Int
lastBelow v sorted = BinarySearch.lastBelow (Unboxed.length sorted - 1) v sorted

-- | The length from a piece's beginning to a place in it, from −1 to 1, and the speed there (in mm
-- over a half).
-- @∫P_k = (P_{k+1} − P_{k−1}) / (2k + 1)@ for Legendre's polynomials.
within :: ArcLength -> Int -> Double -> (Double, Double)
within ruler p x = go 1 1 x (c 0 * (x + 1)) (c 0)
  where
    c k = speeds ruler Unboxed.! (p * count + k)
    go :: Int -> Double -> Double -> Double -> Double -> (Double, Double)
    go k before own run speed
      | k >= count = (run, speed)
      | otherwise =
        go (k + 1) own behind (run + c k * (behind - before) / (2 * n + 1)) (speed + c k * own)
      where
        n = fromIntegral k
        behind = ((2 * n + 1) * x * own - n * before) / (n + 1)

-- | How many nodes a piece has.
count :: Int
count = 8

-- | The nodes of Gauss and Legendre, the zeros of @P_8@, by Newton's steps.
nodes :: Vector Double
nodes =
  Unboxed.generate
    count
    (\i -> iterate improved (-cos (pi * (fromIntegral i + 0.75) / (fromIntegral count + 0.5))) !! 8)
  where
    improved x = let (p, slope) = legendre count x in x - p / slope

-- | What a sample at a node adds to a coefficient: @(2k + 1)/2·w_i·P_k(x_i)@ with the weight
-- @w_i = 2 / ((1 − x_i²)·P_8′(x_i)²)@.
analysis :: Vector Double
analysis = Unboxed.concat [Unboxed.map (weight k) nodes | k <- [0 .. count - 1]]
  where
    weight k x =
      let (_, slope) = legendre count x
          (p, _) = legendre k x
       in (fromIntegral k + 0.5) * 2 / ((1 - x * x) * slope * slope) * p

-- | Legendre's polynomial and its slope, between −1 and 1.
legendre :: Int -> Double -> (Double, Double)
legendre n x = go 0 0 1
  where
    go k before own
      | k >= n = (own, fromIntegral n * (before - x * own) / (1 - x * x))
      | otherwise =
        go
          (k + 1)
          own
          (((2 * fromIntegral k + 1) * x * own - fromIntegral k * before) / (fromIntegral k + 1))
