-- | Progress of a cutter along a contour, and the uncertainty of that progress. The progress is the
-- arc length from the start of the contour to the contact point. The contact point is the point of
-- the contour that is nearest to the cutter's centre. A /job/ is a cut along a contour as the part
-- demands it ("Verify.MillingJob").
--
-- Rounding and chords move the centre by up to the allowed deviation of the job. The contact point
-- moves with the centre. On the inside of an arc whose radius is hardly larger than the cutter's,
-- it moves much further. Then a cutter that goes forward may seem to go back. The /uncertainty/ is
-- the largest such error of the progress, in mm. If the uncertainty on an arc is as large as the
-- arc's length, the contact points do not show the progress at all.
--
-- A /run/ is a sequence of elements that replace one curve of the part; a line or an arc of the
-- drawing is a run of its own.
module Verify.ContactMeasure
  ( Measure (..),
    measureOf,
    isMeasurable,
  )
where

import Base.Quantity (Mm (..), total)
import Data.List (foldl')
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector.Unboxed (Vector, (!))
import Data.Vector.Unboxed qualified as Vector
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Part.Part qualified as Part
import Verify.Edge (Edge (element, long, shape, startsAt))
import Verify.Edge qualified as Edge
import Verify.MillingJob (MillingJob (..))
import Verify.MillingJob qualified as MillingJob

-- | Length of a contour, and the uncertainty of the progress along it.
data Measure = Measure
  { -- | in mm
    contourLength :: Double,
    -- | largest uncertainty on the contour, in mm: a step back that is smaller may be due to
    -- rounding
    slack :: Double,
    isClosed :: Bool,
    -- | true if each run with an arc is longer than its own uncertainty
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

-- | Test that the contact points show the progress of the cutter. False if the contour has a hollow
-- that the cutter touches all over while its centre hardly moves.
isMeasurable :: MillingJob -> Bool
isMeasurable job = let Uncertainty _ isResolved = uncertaintyOf job in isResolved

-- | Largest uncertainty on a contour, in mm. The 'Bool' is true if each run with an arc is longer
-- than its own uncertainty.
data Uncertainty = Uncertainty Double Bool

-- | Largest uncertainty on the contour of a job.
uncertaintyOf :: MillingJob -> Uncertainty
uncertaintyOf job
  | Edge.isCurved (edges job) = foldl' withRun (Uncertainty 0 True) (runsOf job)
  | otherwise = BoxTree.foldl' withElement (Uncertainty 0 True) (edges job)
  where
    withRun (Uncertainty most resolved) run =
      let own@(Mm u) = uncertaintyOfRun job run
          isShort = any isArc run && own >= total (map Segment.length (NonEmpty.toList run))
       in Uncertainty (max most u) (resolved && not isShort)
    -- On a contour without curves each element is a run of its own.
    withElement (Uncertainty most resolved) e
      | FastDistance.isLine (shape e) = Uncertainty (max most onLine) resolved
      | otherwise =
        let u = uncertaintyOn job (Part.segment (element e))
         in Uncertainty (max most u) (resolved && u < long e)
    onLine = uncertaintyOn job (Straight (entry job) (entry job))
    isArc s = case s of
      Arc {} -> True
      Straight _ _ -> False

-- | Runs of the contour's elements, in order. On a closed contour a run may extend across the
-- start. Such a run begins with the last elements of the contour. It is the last run of the list.
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
      -- Shortcut for a run of one element, because most runs have only one.
      e : rest@(next : _) | not (Part.continues next) -> (Part.segment e :| []) : runs rest
      e : rest ->
        let (along, others) = span Part.continues rest
         in (Part.segment e :| map Part.segment along) : runs others

-- | Uncertainty on a run of segments: the longest part of the run along which the contact point
-- moves while the centre moves by twice the allowed deviation.
uncertaintyOfRun :: MillingJob -> NonEmpty Segment -> Mm
uncertaintyOfRun job run = case run of
  s :| [] -> Mm (uncertaintyOn job s)
  _ -> Mm (max (longest id) (longest Vector.reverse))
  where
    lengths = Vector.fromList [l | s <- NonEmpty.toList run, let Mm l = Segment.length s]
    -- Lower bound, for each segment, of the length in mm of the centre's path along it. On the
    -- inside of an arc the bound is half of that length, because of the margin in 'uncertaintyOn'.
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

-- | Largest growth of the lengths @seconds@ while the lengths @firsts@ grow by @window@, all in mm.
-- Both lists have one number for each sample, rise from sample to sample, and are linear between
-- samples. Only growth that begins at a sample is examined.
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

-- | Uncertainty on one segment, in mm: twice the allowed deviation. On the inside of an arc of
-- radius @R@, the contact point moves @R / |R − r|@ times as far as the centre. Here @r@ is the
-- reach of the job, the required distance of the centre from the contour. On such an arc the
-- uncertainty is multiplied by this factor, and by 2 as a margin.
uncertaintyOn :: MillingJob -> Segment -> Double
uncertaintyOn job s = case s of
  Arc {start, centre, sweep}
    | MillingJob.isInsideArc job sweep ->
      let Mm old = Segment.radius centre start
       in 4 * a * old / max 1e-9 (abs (old - r))
  _ -> 2 * a
  where
    Mm a = allowance job
    Mm r = reach job
