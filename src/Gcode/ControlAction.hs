-- | Meanings of the commands of a frame for a modern control.
module Gcode.ControlAction
  ( ControlAction (..),
    SpindleWords,
    actionsOf,
    setsSpindle,
  )
where

import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Frame.Frame (Frame (..))
import Machine.Machine
  ( CommandName,
    CommandValue (..),
    CommandWord (..),
    CommandWords (..),
    Machine,
  )
import Machine.Machine qualified as Machine

-- | Meaning of the commands of a frame.
data ControlAction
  = ToTool Int
  | Turning SpindleWords
  | StopSpindle
  | CoolantSwitch Bool
  | OtherCommand (CommandName, Int)

-- | Words that turn the spindle, with their numbers.
type SpindleWords = [(CommandName, Int)]

-- | Meanings of the commands of a frame, in the order in which the control has to carry them out.
actionsOf :: Machine -> Frame -> [ControlAction]
actionsOf machine f = go (commands f) candidates
  where
    table = Machine.commandWords machine
    candidates =
      [ (toolChange table, ToTool . argumentOf (toolChange table)),
        (spindleClockwise table, Turning),
        (spindleCounterClockwise table, Turning),
        (surfaceClockwise table, Turning),
        (surfaceCounterClockwise table, Turning),
        (spindleOff table, const StopSpindle),
        (coolantOn table, const (CoolantSwitch True)),
        (coolantOff table, const (CoolantSwitch False))
      ]
    go left list = case list of
      [] -> map OtherCommand left
      (ws, make) : more
        | not (null ws),
          Just found <- traverse (`numberIn` left) ws ->
          make found : go (filter (`notElem` found) left) more
        | otherwise -> go left more
    numberIn w left = case lookup (commandName w) left of
      Just n | isNumberOf n (value w) -> Just (commandName w, n)
      _ -> Nothing
    isNumberOf n v = case v of
      Fixed k -> k == n
      SurfaceSpeed _ -> True
      _ -> v `elem` [Argument, SpeedLimit]
    argumentOf ws found = fromMaybe 0 (listToMaybe (mapMaybe (argumentIn found) ws))
    argumentIn found w
      | value w == Argument = lookup (commandName w) found
      | otherwise = Nothing

-- | Test that an action turns the spindle on or off.
setsSpindle :: ControlAction -> Bool
setsSpindle action = case action of
  ToTool _ -> True
  Turning _ -> True
  StopSpindle -> True
  CoolantSwitch _ -> False
  OtherCommand _ -> False
