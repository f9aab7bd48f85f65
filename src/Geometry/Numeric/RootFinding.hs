-- | Roots of functions of one parameter. Such a function returns its value and its derivative.
module Geometry.Numeric.RootFinding
  ( zero,
    rising,
    falling,
  )
where

import Geometry.Tolerance qualified as Tolerance

-- | A root of the function @f@ between the parameter @from@ and the larger parameter @to@. The
-- values of @f@ at these two parameters have different signs.
--
-- This is Newton's method safeguarded by bisection. The bracket is the interval that contains the
-- root. A step that leaves the bracket is replaced by the step to its midpoint. The iteration ends
-- when the step or the length of the bracket is at most 'Tolerance.parameter'. Where the
-- parameter's absolute value is above 1, that tolerance is multiplied by this value. The iteration
-- also ends after 200 steps.
zero :: (Double -> (Double, Double)) -> Double -> Double -> Double
zero f from to = go steps from to (0.5 * (from + to))
  where
    (atEnd, _) = f to
    go :: Int -> Double -> Double -> Double -> Double
    go budget low high here
      | budget <= 0 || v == 0 || high' - low' <= fine = here
      | abs (next - here) <= fine = next
      | otherwise = go (budget - 1) low' high' next
      where
        fine = Tolerance.parameter * max 1 (abs here)
        (v, slope) = f here
        sameSignAsEnd = (v > 0) == (atEnd > 0)
        (low', high') = if sameSignAsEnd then (low, here) else (here, high)
        newton = here - v / slope
        middle = 0.5 * (low' + high')
        -- Every fourth step bisects, so that slow convergence of Newton's method does no harm.
        next = if newton > low' && newton < high' && budget `mod` 4 /= 0 then newton else middle
    steps = 200

-- | The roots at which a function rises. @f@ gives its value and its derivative at a parameter. A
-- sample is a parameter and the function's value at it. The result has one root for each pair of
-- neighbouring samples of which the first has a negative value and the second a positive one.
rising :: (Double -> (Double, Double)) -> [(Double, Double)] -> [Double]
rising f samples = [zero f a b | ((a, va), (b, vb)) <- zip samples (drop 1 samples), va < 0, vb > 0]

-- | The roots at which a function falls. @f@ gives its value and its derivative at a parameter. A
-- sample is a parameter and the function's value at it. The result has one root for each pair of
-- neighbouring samples of which the first has a positive value and the second a negative one.
falling :: (Double -> (Double, Double)) -> [(Double, Double)] -> [Double]
falling f = rising (\u -> let (v, slope) = f u in (-v, -slope)) . map (\(u, v) -> (u, -v))
