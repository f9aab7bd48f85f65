{-# OPTIONS_GHC -O2 #-}

-- | Interpolator: it makes the pulses of one frame, cycle by cycle.
--
-- A line or an arc is the same whatever the times of its pulses are. This module joins the
-- algorithms; the controllers decide when a cycle runs.
module Pulse.Interpolator
  ( Interpolator,
    start,
    next,
    cycles,
    isFinished,
    evaluationArc,
  )
where

import Machine.Controller (InterpolationMethod (..))
import Pulse.DifferentialAnalyser (DifferentialAnalyser)
import Pulse.DifferentialAnalyser qualified as DifferentialAnalyser
import Pulse.EvaluationArc (ArcCycle (..), EvaluationArc, StepRule (..))
import Pulse.EvaluationArc qualified as EvaluationArc
import Pulse.EvaluationLine (EvaluationLine)
import Pulse.EvaluationLine qualified as EvaluationLine
import Pulse.FramePath (FramePath (..))
import Pulse.Steps (Cycle (..), Pulses5)

-- | Interpolator within a frame.
data Interpolator
  = Analysing DifferentialAnalyser
  | Climbing EvaluationLine
  | -- | The method is that of the line at the end of the arc.
    Walking InterpolationMethod EvaluationArc

-- | Interpolator at the beginning of a path. With a differential analyser, a cycle of a line or of
-- an arc may have pulses on several axes; with evaluation functions, it has one pulse.
start :: InterpolationMethod -> FramePath -> Interpolator
start method path = case path of
  Line d -> line method d
  Arc {clockwise, from, to} -> Walking method (EvaluationArc.start rule clockwise from to)
  where
    rule = case method of
      EvaluationFunction -> OneAxis
      DifferentialAnalyser -> EightDirections

line :: InterpolationMethod -> Pulses5 -> Interpolator
line method d = case method of
  EvaluationFunction -> Climbing (EvaluationLine.start d)
  DifferentialAnalyser -> Analysing (DifferentialAnalyser.start d)

-- | Next cycle.
next :: Interpolator -> Cycle Interpolator
next interpolator = case interpolator of
  Analysing a -> case DifferentialAnalyser.next a of
    Cycle steps a' -> Cycle steps (Analysing a')
    Finished -> Finished
  Climbing s -> case EvaluationLine.next s of
    Cycle steps s' -> Cycle steps (Climbing s')
    Finished -> Finished
  Walking method w -> case EvaluationArc.next w of
    ArcCycle steps w' -> Cycle steps (Walking method w')
    ArcEnd rest -> next (line method rest)

-- | Count of cycles up to the end; 'Nothing' on an arc.
cycles :: Interpolator -> Maybe Int
cycles interpolator = case interpolator of
  Analysing a -> Just (DifferentialAnalyser.left a)
  Climbing s -> Just (EvaluationLine.left s)
  Walking _ _ -> Nothing

-- | True if no cycle is left.
isFinished :: Interpolator -> Bool
isFinished interpolator = case interpolator of
  Analysing a -> DifferentialAnalyser.left a <= 0
  Climbing s -> EvaluationLine.left s <= 0
  Walking _ w -> EvaluationArc.isFinished w

-- | The walk on an arc.
evaluationArc :: Interpolator -> Maybe EvaluationArc
evaluationArc interpolator = case interpolator of
  Walking _ w -> Just w
  Analysing _ -> Nothing
  Climbing _ -> Nothing
