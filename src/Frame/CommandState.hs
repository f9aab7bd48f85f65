-- | State that the commands of a program have switched: tool, spindle and coolant.
--
-- For a modern control only this state at each move counts, not the commands that lead to it. So
-- its frames have the commands in one form: between two moves the tool, then the spindle, then the
-- coolant, each only if it changes. The frames that are read from a file get the same form, so both
-- can be compared.
module Frame.CommandState
  ( CommandState (..),
    SpindleNumbers (..),
    initial,
    isEvent,
    reversed,
    after,
    between,
  )
where

import Data.Bifunctor (first)
import Machine.Machine
  ( CommandName,
    CommandValue (..),
    CommandWord (..),
    CommandWords (..),
    Machine,
  )
import Machine.Machine qualified as Machine
import Part.CutFeed (SpindleRate (..))
import Part.Part (Command (..), Sense (..), Switch (..))

-- | Tool, spindle and coolant.
data CommandState = CommandState
  { -- | number of the tool; Nothing for a first tool without a number
    tool :: Maybe Int,
    -- | sense and speed in turns per minute; Nothing while the spindle is off
    spindle :: Maybe (Sense, SpindleNumbers),
    coolantRuns :: Bool
  }
  deriving stock (Eq, Show)

-- | Speed of the spindle in whole numbers.
data SpindleNumbers
  = NoNumber
  | -- | turns per minute
    TurnNumber Int
  | -- | constant cutting speed in mm\/min, and the limit in turns per minute, if there is one
    SurfaceNumbers Double (Maybe Int)
  deriving stock (Eq, Show)

-- | Whole numbers of a rate of the spindle.
spindleNumbers :: SpindleRate -> SpindleNumbers
spindleNumbers rate = case rate of
  NoRate -> NoNumber
  TurnsPerMinute n -> TurnNumber (round n)
  CuttingSpeed v limit -> SurfaceNumbers v (Just (round limit))

-- | State at the beginning of a program.
initial :: CommandState
initial = CommandState {tool = Nothing, spindle = Nothing, coolantRuns = False}

-- | State after a command. A change of the tool stops the spindle.
after :: CommandState -> Command -> CommandState
after state command = case command of
  SpindleOn sense speed -> state {spindle = Just (sense, spindleNumbers speed)}
  SpindleOff -> state {spindle = Nothing}
  CoolantTo SwitchOn -> state {coolantRuns = True}
  CoolantTo SwitchOff -> state {coolantRuns = False}
  ChangeTool n _ -> state {tool = Just n, spindle = Nothing}
  SpindleByHand -> state {spindle = Nothing}
  Auxiliary _ -> state
  ProgramStop -> state
  OptionalStop -> state
  Dwell _ -> state

-- | State with the spindle in the other sense.
reversed :: CommandState -> CommandState
reversed state = state {spindle = fmap (first other) (spindle state)}
  where
    other sense = case sense of
      Clockwise -> CounterClockwise
      CounterClockwise -> Clockwise

-- | True for a command that happens once and changes no state.
isEvent :: Command -> Bool
isEvent command = case command of
  Auxiliary _ -> True
  ProgramStop -> True
  OptionalStop -> True
  Dwell _ -> True
  SpindleOn _ _ -> False
  SpindleOff -> False
  CoolantTo _ -> False
  ChangeTool _ _ -> False
  SpindleByHand -> False

-- | Words of a machine that lead from one state to another, in one group for each command.
between :: Machine -> CommandState -> CommandState -> [[(CommandName, Int)]]
between machine before now =
  filter
    (not . null)
    [ if tool before == tool now then [] else numbers (tool now) (toolChange table),
      if hasChanged then spindleWords else [],
      if coolantRuns before == coolantRuns now then [] else coolantNumbers
    ]
  where
    table = Machine.commandWords machine
    -- A change of the tool stops the spindle.
    spindleBefore = if tool before == tool now then spindle before else Nothing
    hasChanged = spindleBefore /= spindle now
    spindleWords = case spindle now of
      Just (Clockwise, SurfaceNumbers v limit) -> surface v limit (surfaceClockwise table)
      Just (CounterClockwise, SurfaceNumbers v limit) ->
        surface v limit (surfaceCounterClockwise table)
      Just (Clockwise, TurnNumber n) -> numbers (Just n) (spindleClockwise table)
      Just (CounterClockwise, TurnNumber n) -> numbers (Just n) (spindleCounterClockwise table)
      Just (Clockwise, NoNumber) -> numbers Nothing (spindleClockwise table)
      Just (CounterClockwise, NoNumber) -> numbers Nothing (spindleCounterClockwise table)
      Nothing -> numbers Nothing (spindleOff table)
    coolantNumbers = numbers Nothing ((if coolantRuns now then coolantOn else coolantOff) table)

-- | Words with their numbers. @argument@ is the number of the tool or the speed.
numbers :: Maybe Int -> [CommandWord] -> [(CommandName, Int)]
numbers argument ws = [(commandName w, n) | w <- ws, Just n <- [numberOf (value w)]]
  where
    numberOf v = case v of
      Fixed n -> Just n
      Argument -> argument
      Step _ -> Nothing
      Diameter -> Nothing
      InSeconds -> Nothing
      InMilliseconds -> Nothing
      SurfaceSpeed _ -> Nothing
      SpeedLimit -> Nothing

-- | Words of a spindle at a constant cutting speed in mm\/min, with its limit.
surface :: Double -> Maybe Int -> [CommandWord] -> [(CommandName, Int)]
surface v limit ws =
  [ (commandName w, n)
    | w <- ws,
      Just n <-
        [ case value w of
            Fixed k -> Just k
            SurfaceSpeed step -> Just (round (v / step))
            SpeedLimit -> limit
            Argument -> Nothing
            Step _ -> Nothing
            Diameter -> Nothing
            InSeconds -> Nothing
            InMilliseconds -> Nothing
        ]
  ]
