-- | Where a function of a parameter passes zero.
module Geometry.Numeric.RootFinding
  ( zero,
    rising,
    falling,
  )
where

import Geometry.Tolerance qualified as Tolerance

-- | The place between two others, at which the signs of the function differ, where it passes zero.
-- The function gives its value and its slope. Newton's steps where they stay between the two places
-- and close in, halving where not.
zero :: (Double -> (Double, Double)) -> Double -> Double -> Double
zero f from to = go most from to (0.5 * (from + to))
  where
    (atEnd, _) = f to
    go :: Int -> Double -> Double -> Double -> Double
    go left low high here
      | left <= 0 || v == 0 || high' - low' <= fine = here
      | abs (next - here) <= fine = next
      | otherwise = go (left - 1) low' high' next
      where
        -- Doubles hold a place far along a long table no better than this.
        fine = Tolerance.parameter * max 1 (abs here)
        (v, slope) = f here
        beyond = (v > 0) == (atEnd > 0)
        (low', high') = if beyond then (low, here) else (here, high)
        newton = here - v / slope
        middle = 0.5 * (low' + high')
        -- Every fourth step halves, so that Newton's cannot creep.
        next = if newton > low' && newton < high' && left `mod` 4 /= 0 then newton else middle
    most = 200

-- | The places where a function rises through zero, between neighbours of these places.
rising :: (Double -> (Double, Double)) -> [(Double, Double)] -> [Double]
rising f sampled = [zero f a b | ((a, va), (b, vb)) <- zip sampled (drop 1 sampled), va < 0, vb > 0]

-- | The places where it falls through zero.
falling :: (Double -> (Double, Double)) -> [(Double, Double)] -> [Double]
falling f = rising (\u -> let (v, slope) = f u in (-v, -slope)) . map (\(u, v) -> (u, -v))
