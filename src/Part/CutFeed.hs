-- | The feed of a cut: for a minute, or for a turn of the spindle.
module Part.CutFeed
  ( CutFeed (..),
    SpindleRate (..),
    atRate,
    perMinute,
    perMinuteAlong,
    turnsAlong,
  )
where

import Base.Quantity (Feed (..), Mm (..))
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec

data CutFeed
  = PerMinute Feed
  | -- | the feed for one turn, and how fast the spindle turns at this cut
    PerTurn Mm SpindleRate
  deriving stock (Eq, Ord, Show)

-- | Rate at which the spindle turns.
data SpindleRate
  = -- | not known: the spindle is off, is switched by hand, or has no speed in the program
    NoRate
  | -- | turns per minute
    TurnsPerMinute Double
  | -- | a constant cutting speed in mm\/min, and the limit of the turns per minute
    CuttingSpeed Double Double
  deriving stock (Eq, Ord, Show)

-- | The feed at a cut where the spindle turns so fast.
atRate :: SpindleRate -> CutFeed -> CutFeed
atRate rate f = case f of
  PerMinute _ -> f
  PerTurn d _ -> PerTurn d rate

-- | The feed in mm\/min; Nothing if it is not known, or not the same along the whole cut.
perMinute :: CutFeed -> Maybe Feed
perMinute f = case f of
  PerMinute v -> Just v
  PerTurn (Mm d) (TurnsPerMinute n) -> Just (Feed (d * n))
  PerTurn _ (CuttingSpeed _ _) -> Nothing
  PerTurn _ NoRate -> Nothing

-- | The mean feed in mm\/min of a cut along a segment whose y is the distance from the axis of the
-- spindle: the length of the segment, divided by the time of the cut. Nothing if it is not known.
perMinuteAlong :: Segment -> CutFeed -> Maybe Feed
perMinuteAlong s f = case f of
  PerMinute v -> Just v
  PerTurn _ NoRate -> Nothing
  PerTurn (Mm d) rate -> Just (Feed (d * turnsAlong s rate))

-- | The mean turns of the spindle per minute along a segment, for a feed for one turn; 0 if they
-- are not known.
--
-- At the radius r the spindle makes n(r) turns per minute. A cut with d mm for each turn takes the
-- time ∫ ds \/ (d · n(r)), so the mean is 1 \/ mean(1 \/ n(r)). It is taken at 'radiusSamples'
-- points at equal distances along the segment.
turnsAlong :: Segment -> SpindleRate -> Double
turnsAlong s rate = case rate of
  NoRate -> 0
  TurnsPerMinute n -> n
  CuttingSpeed v limit ->
    fromIntegral radiusSamples / sum [max (1 / limit) (2 * pi * radius k / v) | k <- points]
  where
    points = [0 .. radiusSamples - 1]
    radius k = abs (Vec.y (Segment.at ((fromIntegral k + 0.5) / fromIntegral radiusSamples) s))

-- | Points of a segment at which its distance from the axis is taken. On a straight segment the
-- mean is exact, except for the part in which the limit of the turns is reached.
radiusSamples :: Int
radiusSamples = 32
