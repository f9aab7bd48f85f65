-- | Arcs fitted to curves, for machines with circular interpolation. A run is the sequence of moves
-- along one curve. Its moves are arcs and lines within 'Geometry.Tolerance.curve' of the curve. A
-- milling usually has a much larger tolerance, for which far fewer arcs are enough. This module
-- fits these arcs to the run. A level run stays at one height.
module Frame.ArcFitting
  ( RunPart (..),
    divisions,
    arcs,
    roundingAllowance,
  )
where

import Base.Quantity (Mm (..), Pulses (..), Rad (..), minus, plus, times)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Frame.Chording (Bounds (..))
import Geometry.ArcFitting.PolyarcFit qualified as PolyarcFit
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Machine.Machine (Axis (..), Machine)
import Machine.Machine qualified as Machine
import Toolpath.Toolpath (Move (segment))

-- | Largest distance in mm of the fitted arcs from the run. @bounds@ are the distances in mm that
-- the tolerance of the milling allows to the left and to the right of an arc or chord. The result
-- is the smaller one of both, but at least 'leastShare' of a pulse. The smaller bound is nearly 0
-- for a tolerance on one side of the contour only. Then the result exceeds this bound, and
-- 'roundingAllowance' is smaller by the excess.
fitTolerance :: Machine -> Bounds -> Mm
fitTolerance machine bounds =
  max (times leastShare (Machine.planeResolution machine)) (min (left bounds) (right bounds))

-- | Share of a pulse by which the fitted arcs may always deviate, as a fraction.
leastShare :: Double
leastShare = 0.1

-- | Error in mm allowed for rounding: one pulse, less the amount by which 'fitTolerance' exceeds
-- the smaller one of the left and the right bound.
roundingAllowance :: Machine -> Bounds -> Mm
roundingAllowance machine bounds =
  minus
    (Machine.planeResolution machine)
    (max (Mm 0) (minus (fitTolerance machine bounds) (min (left bounds) (right bounds))))

-- | Part of a run, and the form in which it becomes frames.
data RunPart
  = -- | moves to be divided into chords
    Chords (NonEmpty Move)
  | -- | fitted arcs and lines
    Arcs (NonEmpty Segment)
  deriving stock (Eq, Show)

-- | Alternative divisions of a level run into parts; the caller chooses the one with the fewest
-- frames. The first division consists of fitted arcs and lines only. If the centres of some arcs of
-- the run do not fit their fields, there may be two more. The second division has chords for the
-- moves with these centres, and fitted arcs for the others. The third one has chords for the whole
-- run; it is left out if an estimate says that it needs no fewer frames than the first one.
divisions :: Machine -> Bounds -> NonEmpty Move -> NonEmpty [RunPart]
divisions machine bounds run
  | or kinds && (any isRemoteBend fitted || length fitted <= mostTried) =
    [Arcs fitted] :| [map part (NonEmpty.groupBy (\(a, _) (b, _) -> a == b) (zip kinds moves))]
      <> [[Chords run] | mayNeedFewerChords]
  | otherwise = [Arcs fitted] :| []
  where
    fitted = fit run
    moves = NonEmpty.toList run
    -- For each move True when it becomes chords in the second division. A line becomes what the arc
    -- before it becomes.
    kinds = drop 1 (scanl (\before m -> fromMaybe before (isRemote (segment m))) False moves)
    part ms@((isRemotePart, _) :| _)
      | isRemotePart = Chords (fmap snd ms)
      | otherwise = Arcs (fit (fmap snd ms))
    fit = arcs (fitTolerance machine bounds)
    -- True for an arc whose centre does not fit its field: a remote arc. Nothing for a line.
    isRemote s = case s of
      Straight _ _ -> Nothing
      Arc {start, centre} -> Just (Segment.radius centre start >= largestRadius)
    -- True for a remote bend: a fitted arc whose centre does not fit its field, and whose sagitta
    -- is too large for a line in its place.
    isRemoteBend s =
      isRemote s == Just True && Segment.sagitta s >= times 0.5 (Machine.planeResolution machine)
    -- True when chords for the whole run may need fewer frames than the first division: a lower
    -- bound of the number of these chords is less than an estimated number of frames of the first
    -- division.
    --
    -- The lower bound: the curve along a chord lies in a strip whose width is the sum of the left
    -- and the right bound. The fitted arc lies in a strip that is wider by 'fitTolerance' on each
    -- side. Its width @band@ is the largest sagitta that the arc can have along one chord. A chord
    -- across the joint of two arcs is counted for both arcs. Therefore one chord for each arc is
    -- subtracted.
    --
    -- The estimate: each fitted arc or line needs two frames. But a remote bend becomes chords. It
    -- needs twice the least number of chords with a chord error of 0.3 pulses.
    mayNeedFewerChords =
      sum (fmap (leastChords band) fitted) - length fitted
        < sum
          (fmap (\s -> if isRemoteBend s then 2 * leastChords (0.3 * pulse) s else 2) fitted)
    Mm band = plus (plus (left bounds) (right bounds)) (times 2 (fitTolerance machine bounds))
    Mm pulse = Machine.planeResolution machine
    largestRadius =
      let Pulses n = Machine.centreCapacity machine
       in times (fromIntegral n) (minimum [Machine.resolutionOf machine axis | axis <- [X, Y]])

-- | Largest number of fitted arcs for which other divisions are tried even if none of these arcs is
-- a remote bend. A remote bend is an arc that is too curved for a line, and whose centre does not
-- fit its field. With more arcs the attempts would take longer than the rest of the compilation.
mostTried :: Int
mostTried = 1000

-- | Least number of chords of a segment with a chord error of at most @sagitta@ mm. A chord of an
-- arc of radius r spans at most the angle @2·arccos(1 − sagitta/r)@.
leastChords :: Double -> Segment -> Int
leastChords sagitta s = case s of
  Straight _ _ -> 1
  Arc {start, centre, sweep = Rad a} ->
    let Mm r = Segment.radius centre start
     in max 1 (ceiling (abs a / (2 * acos (max (-1) (1 - sagitta / r)))))

-- | Arcs and lines from the start of the run to its end, whose distance from the run is at most
-- @tolerance@ mm. The number of arcs and lines is at most the number of moves of the run.
arcs :: Mm -> NonEmpty Move -> NonEmpty Segment
arcs tolerance run =
  case NonEmpty.nonEmpty (filter ((> Mm 0) . Segment.length) (map segment (NonEmpty.toList run))) of
    Nothing -> pure (segment (NonEmpty.head run))
    Just segments ->
      let fitted = MeasuredPolyarc.fromFlatPolyarc (PolyarcFit.approximate tolerance segments)
       in if MeasuredPolyarc.count fitted <= length segments
            then MeasuredPolyarc.segments fitted
            else segments
