{-# LANGUAGE BangPatterns #-}

-- | Greedy arc fitting along a smooth stretch of a curve: each biarc is as long as the tolerance
-- allows. It serves all curves for which a formula bounds the deviation from a biarc: cubics in
-- "Geometry.ArcFitting.CubicFit" and polyarcs in "Geometry.ArcFitting.PolyarcFit".
--
-- A stretch is the part of a curve between two corners. A pose is a position in mm with a unit
-- direction. The chord ratio of a biarc is the second arc's chord divided by the first one's. The
-- default ratio is that of 'Geometry.ArcFitting.Biarc.join'. A step is the difference of the
-- parameters at both ends of a biarc.
module Geometry.ArcFitting.LongestBiarc
  ( ParameterRange (..),
    Spans (..),
    ArcDistances (..),
    forStretches,
    along,
  )
where

import Control.Monad (when)
import Control.Monad.ST (ST)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.ArcFitting.Biarc.Fast (FastBiarc (..), Pose (..))
import Geometry.ArcFitting.Biarc.Fast qualified as FastBiarc
import Geometry.ArcFitting.Builder (Vertices)
import Geometry.ArcFitting.Builder qualified as Builder
import Geometry.ArcFitting.ParametricFit (FitStep (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | Range of parameters: index, from 0, of the span in which it begins, first and last parameter,
-- and the step that is tried first.
data ParameterRange = ParameterRange
  { inSpan :: Int,
    begin :: Double,
    final :: Double,
    step :: Double
  }

-- | Upper bounds, in mm, of the distances between the curve and a biarc: for the first and for the
-- second arc. They hold from the curve to the arcs and from the arcs to the curve. A bound is
-- infinite where none is known.
data ArcDistances = ArcDistances Double Double

-- | Curve of consecutive spans, given by functions. A parameter at which two spans meet belongs to
-- the later span.
data Spans = Spans
  { -- | index, from 0, of the span that contains a parameter. The first argument is the index at
    -- which the search begins; it is at most the result
    seek :: Int -> Double -> Int,
    -- | pose at a parameter, given the index of its span; where spans meet, the direction is the
    -- mean of both
    pose :: Int -> Double -> Pose,
    -- | distances of a biarc from the curve between its two ends. The arguments are a limit in mm,
    -- then span, parameter and pose of the start, those of the end, and the biarc. A result above
    -- the limit need not be a bound
    arcDistances ::
      Double ->
      Int ->
      Double ->
      Pose ->
      Int ->
      Double ->
      Pose ->
      FastBiarc ->
      ArcDistances,
    -- | biarc by the general fit of "Geometry.ArcFitting.ParametricFit", used where no step
    -- succeeds. The arguments are the parameter at the start, the position and direction there, and
    -- the first step
    fallback :: Double -> (Point, Vec) -> Double -> FitStep,
    -- | True only if every biarc between two positions of the curve is farther from the curve than
    -- a given distance; the caller then tries none. A function that is always False is valid too.
    -- The arguments are the distance in mm, then span, parameter and pose of both positions
    isHopeless :: Double -> Int -> Double -> Pose -> Int -> Double -> Pose -> Bool,
    -- | True to try longer biarcs with other chord ratios where the curvature changes unevenly. On
    -- curves of few spans the result then has a tenth fewer biarcs
    triesLonger :: Bool
  }

-- | Runs an action for each stretch of a curve with @count@ spans. Spans are counted from 0.
-- @isCornerAt i@ is True if the curve has a corner at the start of span @i@. The action receives
-- the index of the stretch's first span and the index after its last span.
forStretches :: Int -> (Int -> Bool) -> (Int -> Int -> ST s ()) -> ST s ()
forStretches count isCornerAt action = when (count > 0) (go 0 1)
  where
    go from to
      | to < count && not (isCornerAt to) = go from (to + 1)
      | otherwise = action from to >> when (to < count) (go to (to + 1))
{-# INLINE forStretches #-}

-- | Appends the vertices of the biarcs along a range of a curve's parameter. Each biarc is as long
-- as the tolerance @aim@ (mm) allows. The vertex at the end of the range is not appended, because
-- the next range starts with it.
along :: Vertices s -> Double -> ParameterRange -> Spans -> ST s ()
along
  vertices
  aim
  ParameterRange {inSpan, begin, final, step = first}
  Spans {seek, pose, arcDistances, fallback, isHopeless, triesLonger} =
    go inSpan begin (pose inSpan begin) first 0
    where
      go !i !u !from !step !bending
        | u >= final = pure ()
        | otherwise =
          bracket
            maxTries
            i
            u
            from
            (Previous step bending)
            Success {reach = u, chords = 1}
            (1 / 0)
            1
            (if final - u <= 1.5 * step then final else u + step)
      -- Bracketing search for the end of the biarc that starts at @u@. The end lies between the
      -- longest success so far (@u@ if there is none) and the nearest failure. The biarc to @v@ is
      -- tried next; its chord ratio is @r@ times the default one.
      bracket !remaining !i !u !from before !success !failed !r !v
        | v <= u || remaining <= 0 = settle i u from before success
        | d <= aim =
          if v >= final || d >= longEnough * aim || failed - v <= narrowBracket * (v - u)
            then lengthen i u from before j v to pair ((v - u) * grown)
            else
              bracket
                (remaining - 1)
                i
                u
                from
                before
                (Success v r)
                failed
                balanced
                (closer v failed (u + (v - u) * grown))
        | reach success > u && v - reach success <= narrowBracket * (reach success - u) =
          settle i u from before success
        | otherwise =
          bracket
            (remaining - 1)
            i
            u
            from
            before
            success
            v
            balanced
            (closer (reach success) v (u + (v - u) * shrunk))
        where
          j = seek i v
          to = pose j v
          pair = FastBiarc.biarc r from to
          ArcDistances d1 d2 = arcDistances (1e6 * aim) i u from j v to pair
          d = if d1 > d2 then d1 else d2
          isKnown = d < 1e5 * aim
          -- Deviation of the first arc divided by that of the second; 1 if one of them is unknown
          -- or very small. The chord ratio times the cube root of this number shortens the arc with
          -- the larger deviation.
          imbalance = if isKnown && d1 > 0.01 * d && d2 > 0.01 * d then d1 / d2 else 1
          balanced = max 0.4 (min 2.5 (r * cubeRoot imbalance))
          expected = if imbalance > 1 then d / sqrt imbalance else d * sqrt imbalance
          -- On a smooth curve the deviation grows with the third power of the step.
          grown = if 60 * expected <= aim then 4 else max 1.02 (cubeRoot (0.97 * aim / expected))
          shrunk = if isKnown then max 0.1 (min 0.97 (cubeRoot (0.97 * aim / expected))) else 0.4
          closer low high w
            | low <= u = w
            | high > final = min final w
            | otherwise = max (low + 0.1 * (high - low)) (min (high - 0.1 * (high - low)) w)
      settle i u from before success
        | reach success > u =
          let j =
                seek i (reach success)
              to = pose j (reach success)
              pair = FastBiarc.biarc (chords success) from to
           in lengthen i u from before j (reach success) to pair (reach success - u)
        | otherwise =
          case fallback
            u
            (Vec.point (px from) (py from), Vec.vec (dx from) (dy from))
            (if final - u <= 4 * lastStep before then final - u else lastStep before) of
            FitStep v segments
              | v > u ->
                mapM_ writeSegment (NonEmpty.toList segments)
                  >> (let j = seek i v in go j v (pose j v) (v - u) 0)
              | otherwise -> pure ()
      -- Tries biarcs longer than the one found up to @v@. Where the curvature changes unevenly, a
      -- longer one can succeed although shorter ones fail.
      lengthen !i !u !from before !j !v !to !pair !step
        | not triesLonger
            || v >= final
            || single pair
            || abs (rate - lastRate before) <= evenRate * abs rate =
          accept j from v to pair step rate
        | otherwise = tryLonger 0
        where
          rate = (bend2 pair - bend1 pair) / (v - u)
          -- Tries the longest step first, and several chord ratios for each step.
          tryLonger k
            | k >= 5 = accept j from v to pair step rate
            | w >= final = tryLonger (k + 1 :: Int)
            | isHopeless aim i u from l w at = tryLonger (k + 1)
            | otherwise = tryRatios 0
            where
              w = u + (v - u) * (case k of 0 -> 2.2; 1 -> 1.8; 2 -> 1.5; 3 -> 1.25; _ -> 1.1)
              l = seek i w
              at = pose l w
              biarcs = FastBiarc.between from at
              tryRatios tried
                | tried >= 7 = tryLonger (k + 1)
                | d1 <= aim && d2 <= aim = lengthen i u from before l w at pair' (w - u)
                | otherwise = tryRatios (tried + 1 :: Int)
                where
                  pair' =
                    FastBiarc.withRatio
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
                  ArcDistances d1 d2 = arcDistances aim i u from l w at pair'
      accept !j !from !v !to !pair !step !rate = do
        Builder.push vertices (px from) (py from) (bulge1 pair)
        if single pair
          then pure ()
          else Builder.push vertices (px (joint pair)) (py (joint pair)) (bulge2 pair)
        go j v to step rate
      writeSegment s =
        let p = Segment.start s in Builder.push vertices (Vec.x p) (Vec.y p) (Segment.bulge s)
{-# INLINE along #-}

-- | Biarc within the tolerance: the parameter at its end, and its chord ratio divided by the
-- default one.
data Success = Success {reach :: Double, chords :: Double}

-- | Facts from the previous biarc. 'lastStep' is the step that its deviation suggests for the next
-- biarc. 'lastRate' is the curvature (1/mm) of its second arc less that of its first arc, divided
-- by its own step.
data Previous = Previous {lastStep :: Double, lastRate :: Double}

-- | Largest relative change of 'lastRate' from one biarc to the next for which the curvature is
-- said to change evenly. Then longer biarcs are not tried.
evenRate :: Double
evenRate = 0.25

-- | Largest count of biarcs that the bracketing search tries from one position.
maxTries :: Int
maxTries = 20

-- | Share of the tolerance: a biarc that deviates by at least this share is long enough.
longEnough :: Double
longEnough = 0.9

-- | Width of the bracket at which the search ends, as a share of the step of the longest biarc
-- within the tolerance. The width is the difference of the parameters at the end of this biarc and
-- at the end of the shortest one that failed.
narrowBracket :: Double
narrowBracket = 0.03

-- | Cube root of a positive number, with an error below 0.3 %. The number is first scaled by powers
-- of 8 to between 1/8 and 8; two Halley steps follow.
cubeRoot :: Double -> Double
cubeRoot a
  | a > 8 = 2 * cubeRoot (a / 8)
  | a < 0.125 = 0.5 * cubeRoot (a * 8)
  | otherwise = halley (halley 1)
  where
    halley x = let c = x * x * x in x * (c + 2 * a) / (2 * c + a)
