-- | Finds the frames that a canned cycle of the control makes: those of a whole hole, if the
-- expansion of a cycle is exactly the same.
module Gcode.HoleCycle
  ( FoundCycle (..),
    AfterTap (..),
    TapNeed (..),
    found,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), Seconds (..))
import Data.List (find)
import Data.Maybe (isJust, listToMaybe)
import Frame.Frame (Frame (..), FrameMotion (..), PlannedFrame (..), Role (..))
import Gcode.ControlAction (SpindleWords)
import Gcode.Cycle (CycleForm (..), CycleStep (..))
import Gcode.Cycle qualified as Cycle
import Gcode.ModalState (CannedCycle (..))
import Machine.Machine
  ( Axis (Z),
    CommandName,
    CommandValue (..),
    CommandWord (..),
    CommandWords (..),
    FeedCode,
    Machine,
    ProgramForm,
  )
import Machine.Machine qualified as Machine
import Machine.ProgramForm (TapControl (..))
import Machine.ProgramForm qualified as ProgramForm

-- | A cycle in place of frames.
data FoundCycle = FoundCycle
  { form :: CycleForm Pulses,
    -- | feed code of the moves that cut
    feed :: FeedCode,
    -- | position over the hole, before the cycle and after it
    over :: Pulses3,
    -- | the spindle after a tap
    afterTap :: Maybe AfterTap,
    -- | the tap, if it is one
    tap :: Maybe TapNeed,
    -- | the frames after those of the cycle
    others :: [PlannedFrame]
  }

-- | Spindle words after a tap. In the frames the spindle turns back until a frame turns it forward;
-- the control turns it forward at once.
data AfterTap = AfterTap {byControl :: SpindleWords, ofFrames :: SpindleWords}
  deriving stock (Eq, Show)

-- | Tap of a block: its pitch, and true if it is in a floating holder.
data TapNeed = TapNeed {tapPitch :: Mm, isFloating :: Bool}
  deriving stock (Eq, Show)

-- | The cycle that makes the next frames, which begin at a position. A level rapid move to the hole
-- belongs to the cycle, except before a tap in step with the spindle. @taps@ are the taps of the
-- blocks, by their numbers. Beside the position are the spindle words that the control carries out
-- by itself.
found ::
  Machine ->
  ProgramForm ->
  (Int -> Maybe TapNeed) ->
  (Pulses3, Maybe SpindleWords) ->
  [PlannedFrame] ->
  Maybe FoundCycle
found machine program taps (at, byItself) frames = case frames of
  p : more
    | Drilling n <- role p,
      isWay (frame p) ->
      case made n (at + increment (frame p)) more of
        Just c | canned (form c) /= SynchronousCycle -> Just c
        _ -> Nothing
    | Drilling n <- role p -> made n at frames
  _ -> Nothing
  where
    isWay f =
      motion f == Rapid && isFree (commands f) && case increment f of
        Pulses3 x y z -> z == 0 && (x, y) /= (0, 0)
    isFree cs = null cs || Just cs == byItself
    made n from list =
      let own = takeWhile (isOf n) list
          heights = drop 1 (scanl (\z p -> z + rise (frame p)) 0 own)
          count = maximum (0 : [k | (k, 0, p) <- zip3 [1 ..] heights own, rise (frame p) /= 0])
          (inHole, rest) = splitAt count list
       in if count == 0
            then Nothing
            else fitting machine program (taps n) from (map frame inHole) rest
    isOf n p = role p `elem` [Drilling n, Commanding] && isVertical (frame p)
    isVertical f = case increment f of
      Pulses3 0 0 _ -> True
      _ -> False
    rise f = case increment f of
      Pulses3 _ _ z -> z

-- | The cycle whose steps are the given frames, which come back to the height of their beginning.
fitting ::
  Machine ->
  ProgramForm ->
  Maybe TapNeed ->
  Pulses3 ->
  [Frame] ->
  [PlannedFrame] ->
  Maybe FoundCycle
fitting machine program tap from@(Pulses3 _ _ top) made rest = do
  steps <- concat <$> traverse (stepsOf machine) (zip (drop 1 (scanl (+) from increments)) made)
  (code, feeds) <- case [feedCode f | f <- made, motion f == Linear] of
    code : feeds -> Just (code, feeds)
    [] -> Nothing
  cycle' <- find ((== steps) . filter (/= Forward) . Cycle.steps) (candidates steps)
  if all (== code) feeds
    then Just FoundCycle {form = cycle', feed = code, over = from, afterTap, tap, others = rest}
    else Nothing
  where
    increments = map increment made
    afterTap =
      listToMaybe
        [ AfterTap {byControl = forward, ofFrames = commands f}
          | f <- made,
            Just (_, forward) <- [turnedBack machine (commands f)]
        ]
    candidates steps =
      [ CycleForm
          { canned = c,
            Cycle.dialect = ProgramForm.dialect program,
            plane = top,
            bottom = minimum [z | FeedTo z <- steps],
            final = top,
            peck = (top -) <$> listToMaybe [z | FeedTo z <- steps],
            back = maybe 0 inPulses back',
            wait = listToMaybe [t | Wait t <- steps]
          }
        | (c, back') <- Cycle.known cycles,
          suits c
      ]
    cycles = ProgramForm.cycles program
    -- A control that taps in step with the spindle does so unless the holder floats.
    suits c = case c of
      SynchronousCycle -> fmap isFloating tap == Just False
      TappingCycle
        | ProgramForm.tapControl cycles == Just SynchronousTap -> fmap isFloating tap == Just True
        | otherwise -> isJust tap
      _ -> True
    inPulses (Mm z) = let Mm p = Machine.resolutionOf machine Z in Pulses (round (z / p))

-- | Steps of a frame that ends at a position; Nothing for one that no cycle makes.
stepsOf :: Machine -> (Pulses3, Frame) -> Maybe [CycleStep Pulses]
stepsOf machine (Pulses3 _ _ z, f) = case (motion f, commands f) of
  (NoMotion, [(name, n)])
    | w : _ <- [w | w <- dwell table, commandName w == name] -> case value w of
      InSeconds -> Just [Wait (Seconds (fromIntegral n / scale name))]
      InMilliseconds -> Just [Wait (Seconds (fromIntegral n / (1000 * scale name)))]
      _ -> Nothing
  (Rapid, []) -> Just [RapidTo z]
  (Linear, []) -> Just [FeedTo z]
  (Linear, ws) | Just _ <- turnedBack machine ws -> Just [Reversal, FeedTo z]
  _ -> Nothing
  where
    table = Machine.commandWords machine
    scale name = 10 ^ Machine.commandDecimals machine name :: Double

-- | The speed of spindle words, and the words for the other sense; Nothing for other words.
turnedBack :: Machine -> [(CommandName, Int)] -> Maybe (Int, [(CommandName, Int)])
turnedBack machine ws =
  listToMaybe
    [ (n, spindleWords other n)
      | (sense, other) <- [(clockwise, back), (back, clockwise)],
        w <- sense,
        value w == Argument,
        Just n <- [lookup (commandName w) ws],
        spindleWords sense n == ws
    ]
  where
    clockwise = spindleClockwise (Machine.commandWords machine)
    back = spindleCounterClockwise (Machine.commandWords machine)
    spindleWords list n =
      [ (commandName w, k)
        | w <- list,
          k <- case value w of
            Fixed m -> [m]
            Argument -> [n]
            _ -> []
      ]
