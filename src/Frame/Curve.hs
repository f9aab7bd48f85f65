-- | Curves on machines that walk arcs. A run of moves along a curve holds the arcs that stand for it to 'Tolerance.curve';
-- within what a job allows far fewer do.
module Frame.Curve
  ( Part (..),
    ways,
    arcs,
    allowance,
    remainder,
  )
where

import Base.Quantity (Mm (..), Pulses (..), minus, times)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe)
import Frame.Run (Bounds (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Track (Side (..), Track (Track))
import Geometry.Track qualified as Track
import Machine.Machine (Axis (..), Machine)
import Machine.Machine qualified as Machine
import Path.Path (Move (segment))

-- | How far the arcs may leave the curve: by what is allowed on the side where less is. Where that is nothing to speak
-- of, as in a band that lies on one side of the contour, by a small share of a pulse, which is to be taken from what
-- rounding may add.
allowance :: Machine -> Bounds -> Mm
allowance machine bounds = max (times leastShare (Machine.pulse machine)) (min (left bounds) (right bounds))

-- | A pulse's share that arcs may always be off.
leastShare :: Double
leastShare = 0.1

-- | What the arcs leave of the pulse that rounding may add.
remainder :: Machine -> Bounds -> Mm
remainder machine bounds = minus (Machine.pulse machine) (max (Mm 0) (minus (allowance machine bounds) (min (left bounds) (right bounds))))

-- | A part of a run, and how it is walked.
data Part
  = -- | in chords
    Chords (NonEmpty Move)
  | -- | on arcs and lines that stand for it
    Arcs (NonEmpty Segment)
  deriving stock (Eq, Show)

-- | Ways to walk a run at one height, in parts one behind the other: on arcs, and if the centres of some of it do not fit
-- their fields, in chords there or everywhere as well.
ways :: Machine -> Bounds -> NonEmpty Move -> NonEmpty [Part]
ways machine bounds run
  | or kinds = [onArcs run] :| [map part (NonEmpty.groupBy (\(a, _) (b, _) -> a == b) (zip kinds moves)), [Chords run]]
  | otherwise = [onArcs run] :| []
  where
    moves = NonEmpty.toList run
    -- A straight move is walked like what is before it.
    kinds = drop 1 (scanl (\before m -> fromMaybe before (isFar (segment m))) False moves)
    part ms@((far, _) :| _)
      | far = Chords (fmap snd ms)
      | otherwise = onArcs (fmap snd ms)
    onArcs ms = Arcs (arcs (allowance machine bounds) ms)
    isFar s = case s of
      Straight _ _ -> Nothing
      Arc {start, centre} -> Just (Segment.radius centre start >= most)
    most = let Pulses n = Machine.centreCapacity machine in times (fromIntegral n) (minimum [Machine.pulseOf machine axis | axis <- [X, Y]])

-- | Few arcs and lines that stay so near to a run, from its beginning to its end.
arcs :: Mm -> NonEmpty Move -> NonEmpty Segment
arcs allowed run = case NonEmpty.nonEmpty (filter ((> Mm 0) . Segment.length) (map segment (NonEmpty.toList run))) of
  Nothing -> pure (segment (NonEmpty.head run))
  Just pieces -> case concatMap NonEmpty.toList (NonEmpty.toList (Track.approximate allowed (trackOf pieces))) of
    -- No more than there were.
    first : others | length others < length pieces -> first :| others
    _ -> pieces

-- | A chain by its length in mm.
trackOf :: NonEmpty Segment -> Track
trackOf pieces = Track {Track.place = place, Track.direction = direction, Track.begin = 0, Track.breaks = ends}
  where
    lengths = fmap (\s -> let Mm l = Segment.length s in l) pieces
    ends = case NonEmpty.scanl (+) 0 lengths of
      _ :| e : es -> e :| es
      zero :| [] -> pure zero
    beginnings = Map.fromList (zip (0 : NonEmpty.toList ends) (NonEmpty.toList (NonEmpty.zip pieces lengths)))
    place u = let (s, t) = at Leaving u in Segment.at t s
    direction side u = let (s, t) = at side u in Segment.directionAt t s
    -- The piece, and the fraction of it.
    at side u = case side of
      Leaving -> found u (Map.lookupLE u beginnings)
      Arriving -> found u (Map.lookupLT u beginnings)
    found u entry = case entry of
      Just (from, (s, l)) -> (s, min 1 ((u - from) / l))
      Nothing -> (NonEmpty.head pieces, 0)
