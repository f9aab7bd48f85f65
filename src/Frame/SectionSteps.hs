-- | The steps into which the sections of a pass are divided: the numbers k, h and Δφ of the paper
-- on the Ural-1 computer.
--
-- A section is a line, an arc or a curve of the toolpath along a contour. On a machine without arcs
-- an arc and a curve become chords. A line is divided only if it does not fit into one frame.
-- Braking divides frames further, which is not counted here.
module Frame.SectionSteps
  ( SectionSteps (..),
    sectionSteps,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet qualified as IntSet
import Data.List.NonEmpty (NonEmpty (..))
import Frame.ChordError (ChordTolerance)
import Frame.ChordError qualified as ChordError
import Frame.Frame (Role (..))
import Frame.Frame qualified as Frame
import Frame.Instruction (Instruction (..))
import Frame.Instruction qualified as Instruction
import Frame.Rounding qualified as Rounding
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), Machine)
import Machine.Machine qualified as Machine
import Toolpath.Toolpath (Move (..), Toolpath, heights)
import Toolpath.Toolpath qualified as Toolpath

-- | The steps of one section.
data SectionSteps
  = -- | a line: the count k of its increments, and the increment h of x in each of them
    LineSteps Int Mm
  | -- | an arc: the count k of its chords, and the largest angle Δφ of a chord, positive if the arc
    -- is counter-clockwise. The angle of all chords is equal, except for a tolerance with two sides
    ArcSteps Int Rad
  | -- | a curve: the count k of its chords
    CurveSteps Int
  | -- | an arc or a curve that the machine makes as arcs
    NoSteps
  deriving stock (Eq, Show)

-- | The steps of all sections of each pass along a contour, by the number of the pass in
-- 'Toolpath.passNumbers'. A pass with cutter compensation by the control is left out, because the
-- control computes its sections.
sectionSteps :: Machine -> Toolpath -> IntMap [SectionSteps]
sectionSteps machine path =
  IntMap.fromListWith (<>) . reverse $
    [ (n, [stepsOf machine tolerance run])
      | Run {role = Cutting n, tolerance, run} <- Instruction.instructions machine path,
        IntSet.member n passes
    ]
  where
    passes =
      IntSet.fromList
        [ n
          | (n, Toolpath.Cutting {Toolpath.sent = Nothing}) <-
              zip (Toolpath.passNumbers blocks) blocks
        ]
    blocks = Toolpath.blocks path

-- | The steps of a section.
stepsOf :: Machine -> ChordTolerance -> NonEmpty Move -> SectionSteps
stepsOf machine tolerance run@(m :| _)
  | not isOfCurve, Straight a b <- segment m = LineSteps parts (share a b)
  | makesArcs = NoSteps
  | isOfCurve = CurveSteps (length chordEnds)
  | otherwise = ArcSteps (length chordEnds) (widest (segment m))
  where
    isOfCurve = Toolpath.isCurve run
    makesArcs = case Machine.arcs machine of
      NoArcs -> False
      Arcs {} -> Rounding.isLevel machine run
    parts =
      let begin = (Segment.start (segment m), fst (heights m))
          end = (Segment.end (segment m), snd (heights m))
       in length (Rounding.split machine (Rounding.rounded machine begin) (begin, end))
    chordEnds =
      map
        fst
        ( ChordError.ends
            Frame.mostFrames
            machine
            (ChordError.raisedToRounding machine tolerance)
            run
        )
    share a b = Mm ((Vec.x b - Vec.x a) / fromIntegral parts)
    widest s = case s of
      Straight _ _ -> Rad 0
      Arc {start, centre} ->
        let radii = map (Vec.to centre) (start : chordEnds)
            largest a b = if abs b > abs a then b else a
         in Rad (foldl largest 0 [a | Rad a <- zipWith Vec.signedAngle radii (drop 1 radii)])
