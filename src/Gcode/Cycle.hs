-- | Canned cycles of modern controls: the vertical moves that one line makes at a hole.
--
-- The writer and the reader use the same expansion. Heights may be of any kind of number: pulses or
-- picometres.
--
-- Sources: the pages on canned cycles of LinuxCNC 2.9 and its interpreter; Fanuc's operator's
-- manual for the series 0i, model F.
module Gcode.Cycle
  ( CycleForm (..),
    CycleStep (..),
    steps,
    codeOf,
    name,
    known,
    words',
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm, Seconds)
import Data.Text (Text)
import Gcode.ModalState (CannedCycle (..))
import Machine.ProgramForm (Dialect (..), HoleCycles (..), PlainCycle (..), TapControl (..))

-- | Sizes of a cycle at a hole.
data CycleForm a = CycleForm
  { canned :: CannedCycle,
    dialect :: Dialect,
    -- | height R, at which the feed down begins
    plane :: a,
    bottom :: a,
    -- | height at the end: that before the cycles (G98), or R (G99)
    final :: a,
    -- | depth of a peck (Q)
    peck :: Maybe a,
    -- | height of the control's own return after a peck
    back :: a,
    -- | pause at the bottom (P)
    wait :: Maybe Seconds
  }
  deriving stock (Eq, Show)

-- | Step of a cycle.
data CycleStep a
  = RapidTo a
  | FeedTo a
  | Wait Seconds
  | -- | the spindle turns back
    Reversal
  | -- | the spindle turns forward again
    Forward
  deriving stock (Eq, Show)

-- | Steps of a cycle from the height R on.
steps :: (Ord a, Num a) => CycleForm a -> [CycleStep a]
steps c = case canned c of
  DrillingCycle -> down <> up
  DwellingCycle -> down <> pause <> up
  PeckingCycle -> pecks (\z -> [RapidTo (plane c), RapidTo (z + back c)]) <> up
  ChipCycle -> pecks (\z -> [RapidTo (z + back c)]) <> up
  ReamingCycle -> down <> [FeedTo (plane c)] <> [RapidTo (final c) | final c /= plane c]
  TappingCycle ->
    down <> [Reversal] <> pause <> case dialect c of
      LinuxCnc -> [FeedTo (final c), Forward]
      _ -> [FeedTo (plane c), Forward] <> [RapidTo (final c) | final c /= plane c]
  SynchronousCycle -> down <> [Reversal, FeedTo (plane c), Forward]
  where
    down = [FeedTo (bottom c)]
    up = [RapidTo (final c)]
    pause = [Wait t | Just t <- [wait c]]
    pecks between = case peck c of
      Just q | q > 0 -> concat [FeedTo z : between z | z <- inner q] <> down
      _ -> down
    inner q = takeWhile (> bottom c) (drop 1 (iterate (subtract q) (plane c)))

-- | Number of the G word of a cycle, in tenths.
codeOf :: CannedCycle -> Int
codeOf cycle' = case cycle' of
  DrillingCycle -> 810
  DwellingCycle -> 820
  PeckingCycle -> 830
  ChipCycle -> 730
  ReamingCycle -> 850
  TappingCycle -> 840
  SynchronousCycle -> 331

-- | The G word of a cycle.
name :: CannedCycle -> Text
name cycle' = case codeOf cycle' `quotRem` 10 of
  (n, 0) -> "G" <> Decimal.whole n
  (n, tenth) -> "G" <> Decimal.whole n <> "." <> Decimal.whole tenth

-- | Cycles of a control, each with the height of its return after a peck, if it has one.
known :: HoleCycles -> [(CannedCycle, Maybe Mm)]
known cycles =
  [(cycleOf c, Nothing) | c <- plainCycles cycles]
    <> [(PeckingCycle, Just z) | Just z <- [peckReturn cycles]]
    <> [(ChipCycle, Just z) | Just z <- [chipReturn cycles]]
    <> [ (c, Nothing)
         | Just control <- [tapControl cycles],
           c <- case control of
             SynchronousTap -> [SynchronousCycle, TappingCycle]
             RigidTap -> [TappingCycle]
             FloatingTap -> [TappingCycle]
       ]
  where
    cycleOf c = case c of
      DrillCycle -> DrillingCycle
      DwellCycle -> DwellingCycle
      ReamCycle -> ReamingCycle

-- | Letters of the words that a cycle takes besides those of the axes.
words' :: CannedCycle -> [Char]
words' cycle' = case cycle' of
  DrillingCycle -> "R"
  DwellingCycle -> "RP"
  PeckingCycle -> "RQ"
  ChipCycle -> "RQ"
  ReamingCycle -> "R"
  TappingCycle -> "RP"
  SynchronousCycle -> "K"
