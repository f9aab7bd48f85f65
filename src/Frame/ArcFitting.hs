-- | Curves on machines that walk arcs. A run of moves along a curve holds the arcs that stand for
-- it to 'Tolerance.curve'; within what a job allows far fewer do.
module Frame.ArcFitting
  ( RunPart (..),
    ways,
    arcs,
    remainder,
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

-- | How far the arcs may leave the curve: by what is allowed on the side where less is. Where that
-- is nothing to speak of, as in a band that lies on one side of the contour, by a small share of a
-- pulse, which is to be taken from what rounding may add.
allowance :: Machine -> Bounds -> Mm
allowance machine bounds =
  max (times leastShare (Machine.pulse machine)) (min (left bounds) (right bounds))

-- | A pulse's share that arcs may always be off.
leastShare :: Double
leastShare = 0.1

-- | What the arcs leave of the pulse that rounding may add.
remainder :: Machine -> Bounds -> Mm
remainder machine bounds =
  minus
    (Machine.pulse machine)
    (max (Mm 0) (minus (allowance machine bounds) (min (left bounds) (right bounds))))

-- | A part of a run, and how it is walked.
data RunPart
  = -- | in chords
    Chords (NonEmpty Move)
  | -- | on arcs and lines that stand for it
    Arcs (NonEmpty Segment)
  deriving stock (Eq, Show)

-- | Ways to walk a run at one height, in parts one behind the other: on arcs, and if the centres of
-- some of them do not fit their fields, in chords where the run itself is so nearly straight, or
-- everywhere as well.
ways :: Machine -> Bounds -> NonEmpty Move -> NonEmpty [RunPart]
ways machine bounds run
  | or kinds && (any isBent few || length few <= mostTried) =
    [Arcs few] :| [map part (NonEmpty.groupBy (\(a, _) (b, _) -> a == b) (zip kinds moves))]
      <> [[Chords run] | mayBeFewer]
  | otherwise = [Arcs few] :| []
  where
    few = onArcs run
    moves = NonEmpty.toList run
    -- A straight move is walked like what is before it.
    kinds = drop 1 (scanl (\before m -> fromMaybe before (isFar (segment m))) False moves)
    part ms@((far, _) :| _)
      | far = Chords (fmap snd ms)
      | otherwise = Arcs (onArcs (fmap snd ms))
    onArcs = arcs (allowance machine bounds)
    isFar s = case s of
      Straight _ _ -> Nothing
      Arc {start, centre} -> Just (Segment.radius centre start >= most)
    -- What leaves its chord by less is walked straight, wherever its centre is.
    isBent s = isFar s == Just True && Segment.bulge s >= times 0.5 (Machine.pulse machine)
    -- A chord leaves an arc by no more than both sides allow and what the arcs are off. Those that
    -- go over from one arc to the next count for both; what is bent goes in chords itself, which
    -- leave it by a part of a pulse.
    mayBeFewer =
      sum (fmap (least band) few) - length few
        < sum (fmap (\s -> if isBent s then 2 * least (0.3 * pulse) s else 2) few)
    Mm band = plus (plus (left bounds) (right bounds)) (times 2 (allowance machine bounds))
    Mm pulse = Machine.pulse machine
    most =
      let Pulses n =
            Machine.centreCapacity machine
       in times (fromIntegral n) (minimum [Machine.pulseOf machine axis | axis <- [X, Y]])

-- | Runs of more arcs are walked on arcs if all of these are walked as such: to try other ways
-- takes longer than all else.
mostTried :: Int
mostTried = 1000

-- | How many chords touch a segment at least that leave it by so many mm at most: what one of them
-- cuts off an arc of the radius r turns by no more than @2·arccos(1 − y/r)@.
least :: Double -> Segment -> Int
least off s = case s of
  Straight _ _ -> 1
  Arc {start, centre, sweep = Rad a} ->
    let Mm r =
          Segment.radius centre start
     in max 1 (ceiling (abs a / (2 * acos (max (-1) (1 - off / r)))))

-- | Few arcs and lines that stay so near to a run, from its beginning to its end.
arcs :: Mm -> NonEmpty Move -> NonEmpty Segment
arcs allowed run =
  case NonEmpty.nonEmpty (filter ((> Mm 0) . Segment.length) (map segment (NonEmpty.toList run))) of
    Nothing -> pure (segment (NonEmpty.head run))
    Just pieces ->
      let few = MeasuredPolyarc.fromOutline (PolyarcFit.approximate allowed pieces)
       in -- No more than there were.
          if MeasuredPolyarc.count few <= length pieces
            then MeasuredPolyarc.segments few
            else pieces
