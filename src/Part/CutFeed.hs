-- | The feed of a cut: for a minute, or for a turn of the spindle.
module Part.CutFeed
  ( CutFeed (..),
    SpindleRate (..),
    atRate,
    perMinute,
    perMinuteAt,
    turnsAt,
  )
where

import Base.Quantity (Feed (..), Mm (..))

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

-- | The feed in mm\/min of a cut at a distance from the axis of the spindle; Nothing if it is not
-- known.
perMinuteAt :: Mm -> CutFeed -> Maybe Feed
perMinuteAt radius f = case f of
  PerMinute v -> Just v
  PerTurn _ NoRate -> Nothing
  PerTurn (Mm d) rate -> Just (Feed (d * turnsAt radius rate))

-- | The turns of the spindle per minute while the tool is at a distance from the axis; 0 if they
-- are not known.
turnsAt :: Mm -> SpindleRate -> Double
turnsAt (Mm radius) rate = case rate of
  NoRate -> 0
  TurnsPerMinute n -> n
  CuttingSpeed v limit
    | radius > 0 -> min limit (v / (2 * pi * radius))
    | otherwise -> limit
