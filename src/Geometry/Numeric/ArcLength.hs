-- | Arc length as a function of a curve's parameter: the integral of the speed, as a table.
--
-- The intervals between parameters at which the speed may jump are bisected into panels, until the
-- speed on each panel is a polynomial of degree 7 through the eight Gauss–Legendre nodes, to
-- 'Tolerance.arcLength'. The table holds its Legendre coefficients. Over a whole panel the integral
-- is Gauss–Legendre quadrature; up to a parameter within the panel it is a closed formula.
module Geometry.Numeric.ArcLength
  ( ArcLength,
    fromSpeed,
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

-- | The table of a curve.
data ArcLength = ArcLength
  { -- | the parameters at which the panels start, and that of the end
    starts :: Vector Double,
    -- | the arc lengths there, in mm
    lengths :: Vector Double,
    -- | the Legendre coefficients of the speed on each panel, eight for each, in mm per half panel
    speeds :: Vector Double
  }

-- | All tables are equal: a table is a cache that belongs to a curve, is determined by it, and
-- should not be computed for a comparison.
instance Eq ArcLength where
  _ == _ = True

-- | The name alone, so that showing a curve does not compute its table.
instance Show ArcLength where
  show _ = "Ruler"

-- | A panel: its start and width in the parameter, and the Legendre coefficients of the speed.
data Panel = Panel Double Double (Vector Double)

-- | The table for a speed in mm per unit of the parameter, not negative. @breaks@ are the ends of
-- the curve and the parameters between at which the speed may jump, in ascending order; the speed
-- is never evaluated there.
fromSpeed :: (Double -> Double) -> [Double] -> ArcLength
fromSpeed speed breaks = ArcLength {starts, lengths, speeds}
  where
    panels = concat (zipWith (measuredBetween speed 0) breaks (drop 1 breaks))
    starts = Unboxed.fromList ([u | Panel u _ _ <- panels] <> take 1 (reverse breaks))
    lengths = Unboxed.scanl' (+) 0 (Unboxed.fromList [2 * Unboxed.head cs | Panel _ _ cs <- panels])
    speeds = Unboxed.concat [cs | Panel _ _ cs <- panels]

-- | The panels between two parameters. A speed that is infinite or not a number ends the bisection
-- as well.
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

-- | The length of the whole curve.
total :: ArcLength -> Mm
total table = Mm (Unboxed.last (lengths table))

-- | The arc length from the start to a parameter.
lengthAt :: ArcLength -> Double -> Mm
lengthAt table u
  | Unboxed.null (speeds table) || u <= Unboxed.head (starts table) = Mm 0
  | u >= Unboxed.last (starts table) = total table
  | otherwise = Mm (lengths table Unboxed.! p + run)
  where
    p = lastBelow u (starts table)
    (from, width) = extent table p
    (run, _) = within table p (2 * (u - from) / width - 1)

-- | The parameter at which the arc length from the start has a value.
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

-- | The start of a panel and its width, in the parameter.
extent :: ArcLength -> Int -> (Double, Double)
extent table p =
  let from = starts table Unboxed.! p in (from, starts table Unboxed.! (p + 1) - from)

-- | The index of the last element, but for the very last, that is not above a value; the elements
-- are ascending.
lastBelow :: Double -> Vector Double -> Int
lastBelow v sorted = BinarySearch.lastAtMost (Unboxed.length sorted - 1) v sorted

-- | The arc length from the start of a panel to a position in it, from −1 to 1, and the speed there
-- in mm per half panel. It uses @∫P_k = (P_{k+1} − P_{k−1}) / (2k + 1)@ for Legendre polynomials.
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

-- | The number of nodes on a panel.
count :: Int
count = 8

-- | The Gauss–Legendre nodes, the zeros of @P_8@, by Newton's method.
nodes :: Vector Double
nodes =
  Unboxed.generate
    count
    (\i -> iterate improved (-cos (pi * (fromIntegral i + 0.75) / (fromIntegral count + 0.5))) !! 8)
  where
    improved x = let (p, slope) = legendre count x in x - p / slope

-- | The contribution of a sample at node i to coefficient k, @(2k + 1)/2·w_i·P_k(x_i)@ with the
-- weight @w_i = 2 / ((1 − x_i²)·P_8′(x_i)²)@; at index @8·k + i@.
analysis :: Vector Double
analysis = Unboxed.concat [Unboxed.map (weight k) nodes | k <- [0 .. count - 1]]
  where
    weight k x =
      let (_, slope) = legendre count x
          (p, _) = legendre k x
       in (fromIntegral k + 0.5) * 2 / ((1 - x * x) * slope * slope) * p

-- | The Legendre polynomial @P_n@ and its derivative, for arguments between −1 and 1.
legendre :: Int -> Double -> (Double, Double)
legendre n x = go 0 0 1
  where
    go k previous current
      | k >= n = (current, fromIntegral n * (previous - x * current) / (1 - x * x))
      | otherwise =
        let i = fromIntegral k
            next = ((2 * i + 1) * x * current - i * previous) / (i + 1)
         in go (k + 1) current next
