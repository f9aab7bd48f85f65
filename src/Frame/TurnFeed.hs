-- | Frames with feeds per minute in place of feeds for one turn of the spindle, for estimates of
-- times and for models of controllers. A frame has one feed: at a constant cutting speed, that with
-- which it takes the same time.
module Frame.TurnFeed
  ( perMinute,
  )
where

import Base.PulseVector (Pulses3)
import Data.List (mapAccumL)
import Data.Maybe (fromMaybe)
import Frame.Frame (Frame (..))
import Frame.Frame qualified as Frame
import Machine.Machine
  ( CommandValue (..),
    CommandWord (..),
    CommandWords (..),
    FeedChoice (..),
    FeedCode,
    Machine,
  )
import Machine.Machine qualified as Machine
import Part.CutFeed (SpindleRate (..))
import Part.CutFeed qualified as CutFeed

-- | The frames with feeds per minute. @begin@ is the position before the first frame, in pulses.
perMinute :: Machine -> Pulses3 -> [Frame] -> [Frame]
perMinute machine begin frames = snd (mapAccumL next (begin, NoRate) frames)
  where
    next (at, rate) f =
      let end = at + increment f
          rate' = fromMaybe rate (rateIn machine f)
          turns = CutFeed.turnsAlong (Frame.segment machine at f) rate'
          code = maybe (feedCode f) (inMinutes turns) (Machine.forTurn machine (feedCode f))
       in at `seq` ((end, rate'), f {feedCode = code})
    inMinutes turns d = codeFor machine (turns * d)

-- | Code of the feed in mm\/min that is nearest to the one asked for.
codeFor :: Machine -> Double -> FeedCode
codeFor machine v = case Machine.choose machine v of
  Given code _ -> code
  NoSuchFeed low high -> case Machine.choose machine (if v < low then low else high) of
    Given code _ -> code
    NoSuchFeed _ _ -> fst (Machine.slowest machine)

-- | Rate at which the spindle turns after the commands of a frame.
rateIn :: Machine -> Frame -> Maybe SpindleRate
rateIn machine f = case (cuttingSpeeds, given SpeedLimit surfaces, turns) of
  (v : _, limit : _, _) -> Just (CuttingSpeed v (fromIntegral limit))
  (_, _, n : _) -> Just (TurnsPerMinute (fromIntegral n))
  _ -> Nothing
  where
    turns = given Argument plain
    table = Machine.commandWords machine
    plain = spindleClockwise table <> spindleCounterClockwise table
    surfaces = surfaceClockwise table <> surfaceCounterClockwise table
    cuttingSpeeds =
      [ step * fromIntegral n
        | CommandWord {commandName, value = SurfaceSpeed step} <- surfaces,
          Just n <- [lookup commandName (commands f)]
      ]
    given :: CommandValue -> [CommandWord] -> [Int]
    given source ws =
      [n | w <- ws, value w == source, Just n <- [lookup (commandName w) (commands f)]]
