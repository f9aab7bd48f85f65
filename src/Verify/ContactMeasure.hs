-- | Arc length along a contour as a measure of the cutter's progress, and the uncertainty of that
-- measure.
--
-- Rounding moves the cutter's centre by up to the allowance, and with it the contact point: on the
-- inside of an arc that is hardly larger than the cutter, by a multiple. So a cutter that goes
-- forward may seem to go back. If the uncertainty is as large as an arc itself, the contact points
-- say nothing about the progress.
module Verify.ContactMeasure
  ( Measure (..),
    measureOf,
    isMeasurable,
  )
where

import Base.Quantity (Mm (..), Rad (..), total)
import Data.List (foldl')
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector.Unboxed (Vector, (!))
import Data.Vector.Unboxed qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Part.Part qualified as Part
import Verify.Edge (Edge (element, long, shape, startsAt))
import Verify.Edge qualified as Edge
import Verify.MillingJob (MillingJob (..))
import Verify.MillingJob qualified as MillingJob

-- | Measure of a contour, in mm.
data Measure = Measure
  { contourLength :: Double,
    -- | how far back a step of the cutter may seem to go because of rounding: the largest
    -- uncertainty
    slack :: Double,
    isClosed :: Bool,
    -- | true if the uncertainty is smaller than each arc, or each curve of arcs
    isResolved :: Bool
  }

-- | Measure of the contour of a job.
measureOf :: MillingJob -> Measure
measureOf job =
  Measure
    { contourLength = BoxTree.foldl' (\_ e -> startsAt e + long e) 0 (edges job),
      slack = largest,
      isClosed = MillingJob.isClosed job,
      isResolved
    }
  where
    Uncertainty largest isResolved = uncertaintyOf job

-- | Test that contact points show the progress of the cutter. They do not in a hollow that the
-- cutter touches all over while its centre hardly moves.
isMeasurable :: MillingJob -> Bool
isMeasurable job = let Uncertainty _ isResolved = uncertaintyOf job in isResolved

-- | Largest uncertainty on a contour, in mm, and true if each run with an arc is longer than its
-- own uncertainty.
data Uncertainty = Uncertainty Double Bool

-- | Uncertainty on the contour of a job.
uncertaintyOf :: MillingJob -> Uncertainty
uncertaintyOf job
  | Edge.isCurved (edges job) = foldl' withRun (Uncertainty 0 True) (runsOf job)
  | otherwise = BoxTree.foldl' withElement (Uncertainty 0 True) (edges job)
  where
    withRun (Uncertainty most resolved) run =
      let own@(Mm u) = uncertaintyOfRun job run
          isShort = any isArc run && own >= total (map Segment.length (NonEmpty.toList run))
       in Uncertainty (max most u) (resolved && not isShort)
    -- Without curves each element is a run of its own.
    withElement (Uncertainty most resolved) e
      | FastDistance.isLine (shape e) = Uncertainty (max most onLine) resolved
      | otherwise =
        let u = uncertaintyOn job (Part.segment (element e))
         in Uncertainty (max most u) (resolved && u < long e)
    onLine = uncertaintyOn job (Straight (entry job) (entry job))
    isArc s = case s of
      Arc {} -> True
      Straight _ _ -> False

-- | Runs of elements: each element of a run continues the curve of the one before. On a closed
-- contour a run may extend across the start.
runsOf :: MillingJob -> [NonEmpty Segment]
runsOf job = case (elements, runs elements) of
  (e : _, first : more)
    | MillingJob.isClosed job,
      Part.continues e,
      final : others <- reverse more ->
      reverse ((final <> first) : others)
  (_, found) -> found
  where
    elements = MillingJob.elementsOf job
    runs es = case es of
      [] -> []
      -- Most lines are alone.
      e : rest@(next : _) | not (Part.continues next) -> (Part.segment e :| []) : runs rest
      e : rest ->
        let (along, others) = span Part.continues rest
         in (Part.segment e :| map Part.segment along) : runs others

-- | Uncertainty on a run of segments: the longest part of it that the cutter touches while its
-- centre moves by twice the allowance.
uncertaintyOfRun :: MillingJob -> NonEmpty Segment -> Mm
uncertaintyOfRun job run = case run of
  s :| [] -> Mm (uncertaintyOn job s)
  _ -> Mm (max (longest id) (longest Vector.reverse))
  where
    lengths = Vector.fromList [l | s <- NonEmpty.toList run, let Mm l = Segment.length s]
    -- Movement of the centre on each segment.
    moved =
      Vector.zipWith
        (\l u -> l * 2 * a / u)
        lengths
        (Vector.fromList (map (uncertaintyOn job) (NonEmpty.toList run)))
    Mm a = allowance job
    longest change =
      largestGrowth
        (2 * a)
        (Vector.scanl' (+) 0 (change moved))
        (Vector.scanl' (+) 0 (change lengths))

-- | Largest growth of the second sequence while the first one, which rises, grows by the width of a
-- window that starts at one of its samples. Both are linear between samples.
largestGrowth :: Double -> Vector Double -> Vector Double -> Double
largestGrowth window firsts seconds = go 0 0 0
  where
    count = Vector.length firsts
    go :: Double -> Int -> Int -> Double
    go most from step
      | from >= count = most
      | step + 1 < count && firsts ! (step + 1) <= firsts ! from + window = go most from (step + 1)
      | otherwise = go (max most (grown from step - seconds ! from)) (from + 1) step
    grown from step
      | step + 1 >= count = Vector.last seconds
      | otherwise =
        seconds ! step
          + (seconds ! (step + 1) - seconds ! step)
            * (firsts ! from + window - firsts ! step) / (firsts ! (step + 1) - firsts ! step)

-- | Uncertainty of the contact point on one segment, in mm. On the inside of an arc of radius @R@,
-- the contact point moves by @R / |R − r|@ times as much as the centre; @r@ is the distance of the
-- centre from the contour.
uncertaintyOn :: MillingJob -> Segment -> Double
uncertaintyOn job s = case s of
  Arc {start, centre, sweep = Rad angle}
    | isInside angle ->
      let Mm old = Segment.radius centre start
       in 4 * a * old / max 1e-9 (abs (old - r))
  _ -> 2 * a
  where
    Mm a = allowance job
    Mm r = reach job
    isInside angle = maybe False (\s' -> Carrier.sideSign s' * angle > 0) (side job)
