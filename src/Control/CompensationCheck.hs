-- | Check of planned frames with cutter compensation: a control refuses none of them. The check
-- needs the frames, because a control computes the offset of the edge as it is rounded to pulses.
-- "Toolpath.Compensation" refuses before what does not depend on that rounding.
module Control.CompensationCheck
  ( reports,
    wordsOf,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Control.Compensation (CompensationError (..))
import Control.Compensation qualified as Compensation
import Data.IntMap.Strict qualified as IntMap
import Data.List (nubBy)
import Data.Text (Text)
import Frame.Frame (FrameProgram (..), PlannedFrame (..))
import Frame.Frame qualified as Frame
import Machine.Machine (Machine)
import Report.Report (Report (label, message), ReportCode, ReportPlace (..), report)
import Report.Report qualified as Report

-- | Reports of planned frames that a control refuses, each at the region of the program that asks
-- for the frame. A region with several such frames has one report, about the first of them. Only an
-- edge is examined: a program that switches compensation on or off at a wrong place is a bug, and
-- the proof finds it.
reports :: Machine -> FrameProgram -> [Report]
reports machine program =
  nubBy
    (\a b -> Report.place a == Report.place b)
    [ refused code p err
      | err <- snd (Compensation.run machine radiusAt (start program) frames),
        let (n, _, _) = wordsOf err,
        Just code <- [codeOf err],
        Just p <- [IntMap.lookup n planned]
    ]
  where
    frames = map frame (plannedFrames program)
    planned = IntMap.fromDistinctAscList (zip [1 ..] (plannedFrames program))
    -- A frame of commands has the cutter of the next motion.
    radiusAt n = maybe (Mm 0) (cutterRadius . snd) (IntMap.lookupGE n moving)
    moving = IntMap.filter (Frame.isMoving . frame) planned

-- | Report that a control refuses a planned frame.
refused :: ReportCode -> PlannedFrame -> CompensationError -> Report
refused code p err =
  ( report
      Report.Error
      code
      (InSource (origin p))
      ("a control would refuse frame " <> Decimal.whole n <> ", which " <> reason)
  )
    { label = "the frame is along this",
      message = "A control computes the offset of the edge as it is rounded to pulses." : others,
      Report.hints =
        [ "Take a smaller cutter or longer elements. Or leave compensation controller out: the \
          \path that the compiler computes fits."
        ]
    }
  where
    (n, reason, others) = wordsOf err

-- | Code of the report of an error in the edge. Nothing for errors of commands.
codeOf :: CompensationError -> Maybe ReportCode
codeOf err = case err of
  ShortEntry {} -> Just "E0417"
  ArcEntry _ -> Just "E0417"
  ArcExit _ -> Just "E0417"
  TightArc {} -> Just "E0419"
  CornerNotReached _ -> Just "E0419"
  SwitchedOnTwice _ -> Nothing
  ToolChanged _ -> Nothing
  NotSwitchedOff _ -> Nothing

-- | Number of a frame, the reason why cutter compensation fails in it, and further sentences. The
-- reason completes a sentence that begins with the frame.
wordsOf :: CompensationError -> (Int, Text, [Text])
wordsOf err = case err of
  ShortEntry n l r ->
    ( n,
      "switches compensation on in a move that is too short",
      [ "It is "
          <> lengthOf l
          <> " long, and has to be longer than the cutter's radius, "
          <> lengthOf r
          <> "."
      ]
    )
  ArcEntry n -> (n, "switches compensation on in an arc", straightOnly)
  ArcExit n -> (n, "switches compensation off in an arc", straightOnly)
  TightArc n old r ->
    ( n,
      "is a concave arc of radius " <> lengthOf old <> ", into which the cutter does not fit",
      ["The radius of the cutter is " <> lengthOf r <> "."]
    )
  CornerNotReached n ->
    ( n,
      "is too short for a corner into which the cutter does not fit",
      ["The cutter would cut into the move beside it."]
    )
  SwitchedOnTwice n -> (n, "switches compensation on while it is on", [])
  ToolChanged n -> (n, "changes the tool while compensation is on", [])
  NotSwitchedOff n -> (n, "ends the tape while compensation is on", [])
  where
    straightOnly = ["A control does this in a straight move only."]
    lengthOf (Mm x) = Decimal.fixed 3 x <> " mm"
