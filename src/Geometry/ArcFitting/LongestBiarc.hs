{-# LANGUAGE BangPatterns #-}

-- | Greedy arc fitting along a smooth stretch of a curve: each biarc is as long as the tolerance
-- allows. This is the common part for all curves whose deviation from a biarc is known in
-- closed form.
module Geometry.ArcFitting.LongestBiarc
  ( ParameterRange (..),
    Spans (..),
    Off (..),
    along,
  )
where

import Base.Quantity (Rad (..))
import Control.Monad.ST (ST)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.ArcFitting.Biarc.Fast (FastBiarc (..), Pose (..))
import Geometry.ArcFitting.Biarc.Fast qualified as FastBiarc
import Geometry.ArcFitting.Builder (Vertices)
import Geometry.ArcFitting.Builder qualified as Builder
import Geometry.ArcFitting.ParametricFit (Further (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | Range of parameters: the span in which it starts, its start and its end, and the first step
-- to try.
data ParameterRange = ParameterRange
  { inSpan :: Int,
    begin :: Double,
    final :: Double,
    step :: Double
  }

-- | Upper bounds of the distance between the curve and each of the two arcs of a biarc, in both
-- directions; infinite where no bound is known.
data Off = Off Double Double

-- | Curve of consecutive spans. A parameter at which two spans meet belongs to the later span.
data Spans = Spans
  { -- | span of a parameter, given a span that is not after it
    seek :: Int -> Double -> Int,
    -- | pose at a parameter, given its span; where spans meet, the direction is the mean of both
    pose :: Int -> Double -> Pose,
    -- | distances of a biarc from the curve between two parameters, each given with its span and
    -- pose; a result above the first argument only says that this limit is exceeded
    off :: Double -> Int -> Double -> Pose -> Int -> Double -> Pose -> FastBiarc -> Off,
    -- | biarc from a pose by the general fit, with a step to try; used where no step succeeds
    other :: Double -> (Point, Vec) -> Double -> Further,
    -- | True if no biarc between two parameters, each given with its span and pose, can stay
    -- within a distance
    hopeless :: Double -> Int -> Double -> Pose -> Int -> Double -> Pose -> Bool,
    -- | True to try longer biarcs with other chord ratios where the curvature changes unevenly;
    -- this saves a tenth of the biarcs where there are few
    patient :: Bool
  }

-- | Writes the biarcs along a range, each as long as the tolerance @aim@ allows. The vertex at
-- the end of the range is left to the caller, because the next range starts with it.
along :: Vertices s -> Double -> ParameterRange -> Spans -> ST s ()
along
  vertices
  aim
  ParameterRange {inSpan, begin, final, step = first}
  Spans {seek, pose, off, other, hopeless, patient} =
    go inSpan begin (pose inSpan begin) first 0
    where
      go !i !u !from !step !bending
        | u >= final = pure ()
        | otherwise =
          search
            tries
            i
            u
            from
            (Last step bending)
            Held {reach = u, chords = 1}
            (1 / 0)
            1
            (if final - u <= 1.5 * step then final else u + step)
      -- Bracketing search between the longest biarc within the tolerance so far (@u@ if there is
      -- none) and the nearest parameter that failed.
      search !left !i !u !from before !held !missed !r !v
        | v <= u || left <= 0 = settled i u from before held
        | d <= aim =
          if v >= final || d >= enough * aim || missed - v <= narrow * (v - u)
            then longer i u from before j v to pair ((v - u) * grown)
            else
              search
                (left - 1)
                i
                u
                from
                before
                (Held v r)
                missed
                balanced
                (closer v missed (u + (v - u) * grown))
        | reach held > u && v - reach held <= narrow * (reach held - u) =
          settled i u from before held
        | otherwise =
          search
            (left - 1)
            i
            u
            from
            before
            held
            v
            balanced
            (closer (reach held) v (u + (v - u) * shrunk))
        where
          j = seek i v
          to = pose j v
          pair = FastBiarc.joined r from to
          Off d1 d2 = off (1e6 * aim) i u from j v to pair
          d = if d1 > d2 then d1 else d2
          known = d < 1e5 * aim
          -- Shortens the arc with the larger deviation, to balance both deviations.
          uneven = if known && d1 > 0.01 * d && d2 > 0.01 * d then d1 / d2 else 1
          balanced = max 0.4 (min 2.5 (r * cubeRoot uneven))
          expected = if uneven > 1 then d / sqrt uneven else d * sqrt uneven
          -- On a smooth curve the deviation grows with the third power of the step.
          grown = if 60 * expected <= aim then 4 else max 1.02 (cubeRoot (0.97 * aim / expected))
          shrunk = if known then max 0.1 (min 0.97 (cubeRoot (0.97 * aim / expected))) else 0.4
          closer low high w
            | low <= u = w
            | high > final = min final w
            | otherwise = max (low + 0.1 * (high - low)) (min (high - 0.1 * (high - low)) w)
      settled i u from before held
        | reach held > u =
          let j =
                seek i (reach held)
              to = pose j (reach held)
              pair = FastBiarc.joined (chords held) from to
           in longer i u from before j (reach held) to pair (reach held - u)
        | otherwise =
          case other
            u
            (Vec.point (px from) (py from), Vec.vec (dx from) (dy from))
            (if final - u <= 4 * lastStep before then final - u else lastStep before) of
            Further v segments
              | v > u ->
                mapM_ written (NonEmpty.toList segments)
                  >> (let j = seek i v in go j v (pose j v) (v - u) 0)
              | otherwise -> pure ()
      -- Where the curvature changes unevenly, a longer biarc can succeed although shorter ones
      -- fail.
      longer !i !u !from before !j !v !to !pair !step
        | not patient
            || v >= final
            || single pair
            || abs (rate - lastRate before) <= even' * abs rate =
          taken j from v to pair step rate
        | otherwise = beyond 0
        where
          rate = (bend2 pair - bend1 pair) / (v - u)
          -- Tries the longest step first, and several chord ratios for each step.
          beyond k
            | k >= 5 = taken j from v to pair step rate
            | w >= final = beyond (k + 1 :: Int)
            | hopeless aim i u from l w at = beyond (k + 1)
            | otherwise = divided 0
            where
              w = u + (v - u) * (case k of 0 -> 2.2; 1 -> 1.8; 2 -> 1.5; 3 -> 1.25; _ -> 1.1)
              l = seek i w
              at = pose l w
              biarcs = FastBiarc.between from at
              divided tried
                | tried >= 7 = beyond (k + 1)
                | d1 <= aim && d2 <= aim = longer i u from before l w at pair' (w - u)
                | otherwise = divided (tried + 1 :: Int)
                where
                  pair' =
                    FastBiarc.among
                      ( case tried of
                          0 ->
                            1
                          1 -> 0.7
                          2 -> 1.4
                          3 -> 0.5
                          4 -> 2
                          5 -> 0.35
                          _ -> 2.8
                      )
                      biarcs
                  Off d1 d2 = off aim i u from l w at pair'
      taken !j !from !v !to !pair !step !rate = do
        Builder.push vertices (px from) (py from) (bulge1 pair)
        if single pair
          then pure ()
          else Builder.push vertices (px (joint pair)) (py (joint pair)) (bulge2 pair)
        go j v to step rate
      written s = let p = Segment.start s in Builder.push vertices (Vec.x p) (Vec.y p) (bulgeOf s)
      bulgeOf s = case s of
        Straight _ _ -> 0
        Arc {sweep = Rad a} -> tan (a / 4)
{-# INLINE along #-}

-- | Biarc within the tolerance: the parameter at its end, and the factor of its chord ratio.
data Held = Held {reach :: Double, chords :: Double}

-- | Previous biarc: its step, and the rate of change of its curvature, both by the parameter.
data Last = Last {lastStep :: Double, lastRate :: Double}

-- | Relative change of that rate from one biarc to the next below which the curvature changes
-- evenly.
even' :: Double
even' = 0.25

-- | Largest count of biarcs that are tried from one position.
tries :: Int
tries = 20

-- | Share of the tolerance from which on a biarc is long enough.
enough :: Double
enough = 0.9

-- | Relative step between success and failure below which a biarc is long enough.
narrow :: Double
narrow = 0.03

-- | Cube root of a positive number, by two Halley steps; accurate to a few percent between 1/1000
-- and 1000.
cubeRoot :: Double -> Double
cubeRoot a
  | a > 8 = 2 * cubeRoot (a / 8)
  | a < 0.125 = 0.5 * cubeRoot (a * 8)
  | otherwise = halley (halley 1)
  where
    halley x = let c = x * x * x in x * (c + 2 * a) / (2 * c + a)
