-- | Narrow passages: places where the cutter has a wall on both sides.
--
-- A tolerance may be larger away from the material than into it. In a passage that is hardly wider
-- than the cutter, "away from the material" is into the opposite wall. Chords that use the larger
-- tolerance would gouge that wall, so there the smaller one holds on both sides.
module Frame.Passage
  ( Walls,
    walls,
    tolerance,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Frame.ChordError (ChordTolerance)
import Frame.ChordError qualified as ChordError
import Frame.Frame qualified as Frame
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Machine.Machine (Arcs (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Contour, Element, Milling)
import Part.Part qualified as Part
import Toolpath.Toolpath (Move (..), Pass)
import Toolpath.Toolpath qualified as Toolpath

-- | Elements beside which the passes of a statement move.
data Walls = Walls
  { elements :: BoxTree Element,
    -- | largest allowance of an element in mm
    largestAllowance :: Mm
  }

-- | Walls of a statement that machines these contours.
walls :: [Contour] -> Walls
walls contours =
  Walls
    { elements = BoxTree.index (BoundingBox.ofSegment . Part.segment) list,
      largestAllowance = maximum (Mm 0 : map (Part.allowance . Part.finish) list)
    }
  where
    list = concatMap (NonEmpty.toList . Part.elements) contours

-- | Chord tolerance of the run @moves@ in the pass @pass@ of the milling @job@. It is @wide@, or
-- the smaller tolerance on both sides if chords with the tolerance @wide@ come too near to the
-- walls. A chord may come nearer to them than the path by the tolerance into the material. A
-- machine with arcs keeps the tolerance @wide@: it makes chords only of arcs that fit into no
-- frame.
tolerance ::
  Machine -> Milling -> Pass -> Walls -> NonEmpty Move -> ChordTolerance -> ChordTolerance
tolerance machine job pass Walls {elements, largestAllowance} moves wide
  | Machine.arcs machine == NoArcs && inside < outside && any comesTooNear chords =
    ChordError.onBothSides machine inside wide
  | otherwise = wide
  where
    (inside, outside) = Part.deviationLimits (Part.tolerance job)
    chords = zipWith Straight (Segment.start (segment (NonEmpty.head moves)) : ends) ends
    ends =
      map
        fst
        ( ChordError.ends
            Frame.mostFrames
            machine
            (ChordError.raisedToRounding machine wide)
            moves
        )
    comesTooNear chord =
      or
        [ Distance.distance (Distance.segments chord (Part.segment e)) < minus (required e) slack
          | e <- BoxTree.within (BoundingBox.inflate largest (BoundingBox.ofSegment chord)) elements
        ]
    required e = plus (Toolpath.reach pass) (Part.allowance (Part.finish e))
    -- The path of a curve consists of arcs that are approximations themselves.
    slack = plus inside (plus Tolerance.curve Tolerance.coincident)
    largest = plus (Toolpath.reach pass) largestAllowance
