-- | Arc length as a function of a curve's parameter: the integral of the speed, as a table. The
-- speed is the length of the curve's derivative, in mm per unit of the parameter.
--
-- The speed may jump at certain parameters. Each interval between two of these is bisected into
-- panels until the estimated error is small enough. On each panel a polynomial of degree 7
-- interpolates the speed at the eight Gauss–Legendre nodes. The table contains the Legendre
-- coefficients of these polynomials. The integral over a whole panel is Gauss–Legendre quadrature.
-- Up to a parameter within a panel, the polynomial is integrated by a closed formula.
--
-- Panels have indices from 0. The position within a panel is a number from −1 at its start to 1 at
-- its end.
module Geometry.Numeric.ArcLength
  ( ArcLength,
    fromSpeed,
    integral,
    total,
    lengthAt,
    parameterAt,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Base.Quantity (Mm (..))
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Unboxed
import Geometry.Numeric.RootFinding qualified as RootFinding
import Geometry.Tolerance qualified as Tolerance

-- | The arc lengths and the speed of one curve, panel by panel.
data ArcLength = ArcLength
  { -- | the parameters at which the panels start, then the parameter of the curve's end
    starts :: Vector Double,
    -- | the arc lengths, in mm, from the curve's start to the parameters in 'starts'
    lengths :: Vector Double,
    -- | the eight Legendre coefficients of the speed on each panel, as a function of the position
    -- within the panel; in mm per unit of that position
    speeds :: Vector Double
  }

-- | All tables compare equal, so that a comparison of two curves computes no table. A table is
-- determined by its curve, and the other data of the curves are compared anyway.
instance Eq ArcLength where
  _ == _ = True

-- | A constant text, so that showing a curve does not compute its table.
instance Show ArcLength where
  show _ = "ArcLength"

-- | A panel: the parameter at its start, its width in the parameter, and the eight Legendre
-- coefficients of the speed.
data Panel = Panel Double Double (Vector Double)

-- | The table of a curve. @speed@ gives the speed at a parameter and is not negative. @breaks@ are,
-- in ascending order, the parameters of the curve's ends and those at which the speed may jump. The
-- speed is never evaluated at these.
fromSpeed :: (Double -> Double) -> [Double] -> ArcLength
fromSpeed speed breaks = ArcLength {starts, lengths, speeds}
  where
    panels = concat (zipWith (measuredBetween speed 0) breaks (drop 1 breaks))
    starts = Unboxed.fromList ([u | Panel u _ _ <- panels] <> take 1 (reverse breaks))
    lengths = Unboxed.scanl' (+) 0 (Unboxed.fromList [2 * Unboxed.head cs | Panel _ _ cs <- panels])
    speeds = Unboxed.concat [cs | Panel _ _ cs <- panels]

-- | The panels between the parameters @a@ and @b@. @depth@ is the count of bisections that have led
-- to this interval.
--
-- The estimated error is the sum of the absolute values of the last two Legendre coefficients of
-- the speed. The bisection ends when this error is at most 'Tolerance.arcLength', or at most the
-- share 'Tolerance.arcLengthShare' of the mean speed on the interval. It also ends if the estimated
-- error is infinite or NaN, and at a depth of 16.
measuredBetween :: (Double -> Double) -> Int -> Double -> Double -> [Panel]
measuredBetween speed depth a b
  | b <= a = []
  | truncation <= allowed || isNaN truncation || isInfinite truncation || depth >= deepest =
    [Panel a (b - a) cs]
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
    truncation = abs (cs Unboxed.! (count - 2)) + abs (cs Unboxed.! (count - 1))
    Mm finest = Tolerance.arcLength
    allowed = max finest (Tolerance.arcLengthShare * Unboxed.head cs)
    deepest = 16 :: Int

-- | The integral of a speed from the parameter @a@ to the parameter @b@, which may be smaller, by
-- Gauss–Legendre quadrature on a single panel. It is for short stretches beyond the end of a table.
integral :: (Double -> Double) -> Double -> Double -> Double
integral speed a b =
  half * Unboxed.sum (Unboxed.imap (\i x -> 2 * (analysis Unboxed.! i) * speed (at x)) nodes)
  where
    at x = 0.5 * (a + b) + half * x
    half = 0.5 * (b - a)

-- | The arc length of the whole curve.
total :: ArcLength -> Mm
total table = Mm (Unboxed.last (lengths table))

-- | The arc length from the curve's start to the parameter @u@. A parameter outside of the curve
-- gives the nearer end.
lengthAt :: ArcLength -> Double -> Mm
lengthAt table u
  | Unboxed.null (speeds table) || u <= Unboxed.head (starts table) = Mm 0
  | u >= Unboxed.last (starts table) = total table
  | otherwise = Mm (lengths table Unboxed.! p + run)
  where
    p = lastBelow u (starts table)
    (from, width) = extent table p
    (run, _) = within table p (2 * (u - from) / width - 1)

-- | The parameter at which the arc length from the curve's start is @s@. For a negative @s@ it is
-- the parameter of the start; for an @s@ above the length of the curve, that of the end.
parameterAt :: ArcLength -> Mm -> Double
parameterAt table (Mm s)
  | Unboxed.null (speeds table) || s <= 0 = Unboxed.head (starts table)
  | Mm s >= total table = Unboxed.last (starts table)
  | otherwise = from + 0.5 * width * (1 + RootFinding.zero excess (-1) 1)
  where
    p = lastBelow s (lengths table)
    (from, width) = extent table p
    excess x = let (run, speed) = within table p x in (run - missing, speed)
    missing = s - lengths table Unboxed.! p

-- | The parameter at the start of panel @p@, and the panel's width in the parameter.
extent :: ArcLength -> Int -> (Double, Double)
extent table p =
  let from = starts table Unboxed.! p in (from, starts table Unboxed.! (p + 1) - from)

-- | The index, from 0, of the last element of the ascending vector @sorted@ that is at most @v@.
-- The very last element is not considered, since no panel starts there.
lastBelow :: Double -> Vector Double -> Int
lastBelow v sorted = BinarySearch.lastAtMost (Unboxed.length sorted - 1) v sorted

-- | The arc length, in mm, from the start of panel @p@ to the position @x@ in it; and the speed at
-- @x@, in mm per unit of the position. The formula is @∫P_k = (P_{k+1} − P_{k−1}) / (2k + 1)@ for
-- Legendre polynomials.
within :: ArcLength -> Int -> Double -> (Double, Double)
within table p x = go 1 1 x (c 0 * (x + 1)) (c 0)
  where
    c k = speeds table Unboxed.! (p * count + k)
    go :: Int -> Double -> Double -> Double -> Double -> (Double, Double)
    go k previous current run speed
      | k >= count = (run, speed)
      | otherwise =
        let run' = run + c k * (next - previous) / (2 * n + 1)
         in go (k + 1) current next run' (speed + c k * current)
      where
        n = fromIntegral k
        next = ((2 * n + 1) * x * current - n * previous) / (n + 1)

-- | The number of nodes on a panel, and of the coefficients that are computed from them.
count :: Int
count = 8

-- | The Gauss–Legendre nodes as positions in a panel: the zeros of @P_8@, by Newton's method.
nodes :: Vector Double
nodes =
  Unboxed.generate
    count
    (\i -> iterate improved (-cos (pi * (fromIntegral i + 0.75) / (fromIntegral count + 0.5))) !! 8)
  where
    improved x = let (p, slope) = legendre count x in x - p / slope

-- | The factors that give the Legendre coefficients of the speed. Coefficient k is the sum, over
-- all nodes i, of the speed at node i times the factor with the index @8·k + i@. This factor is
-- @(2k + 1)/2·w_i·P_k(x_i)@ with the weight @w_i = 2 / ((1 − x_i²)·P_8′(x_i)²)@.
analysis :: Vector Double
analysis = Unboxed.concat [Unboxed.map (weight k) nodes | k <- [0 .. count - 1]]
  where
    weight k x =
      let (_, slope) = legendre count x
          (p, _) = legendre k x
       in (fromIntegral k + 0.5) * 2 / ((1 - x * x) * slope * slope) * p

-- | The values of the Legendre polynomial @P_n@ and of its derivative at @x@, which lies between −1
-- and 1.
legendre :: Int -> Double -> (Double, Double)
legendre n x = go 0 0 1
  where
    go k previous current
      | k >= n = (current, fromIntegral n * (previous - x * current) / (1 - x * x))
      | otherwise =
        let i = fromIntegral k
            next = ((2 * i + 1) * x * current - i * previous) / (i + 1)
         in go (k + 1) current next
