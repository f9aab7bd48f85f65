-- | Model of a controller without time: each frame that moves is one motion of the cutter's centre,
-- on a line or on an arc. Speed, acceleration and the times of pulses are not modelled, nor are
-- turns of rotary axes: "Verify.FromTape" refuses tapes with such turns.
--
-- The end points of an arc and its centre are whole pulses, so its start radius and its end radius
-- may differ. Controllers resolve this difference in different manners, but all controllers move
-- about the programmed centre, in the programmed sense, between the two radii. The model therefore
-- gives two /bounding paths/ for an arc with two radii: one arc on each radius. It also gives the
-- lines that connect the ends of these two arcs. A statement about the motion is true if it is true
-- of both bounding paths and of these lines.
module Control.Motion
  ( Motion (..),
    run,
    runWith,
    isRound,
    endsInStartDirection,
    segment,
    boundingPaths,
    connectors,
    radii,
    height,
    travel,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Frame.Frame (Frame (increment, motion), FrameMotion (..))
import Frame.Frame qualified as Frame
import Geometry.Carrier qualified as Carrier
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)

-- | Motion of one frame: the number of the frame, counted from 1; the positions at both ends in
-- pulses; the frame itself.
data Motion = Motion {number :: Int, from :: Pulses3, to :: Pulses3, frame :: Frame}
  deriving stock (Eq, Show)

-- | List the motions of frames, the first of which begins at the given position. A frame that has
-- only commands gives no motion. A full circle gives one, although its increment is zero.
run :: Pulses3 -> [Frame] -> [Motion]
run = runWith (:)

-- | Fold the motions of frames from the right. The function @onto@ takes a motion and the result
-- for all later motions. The list of motions is never in memory as a whole.
runWith :: (Motion -> [a] -> [a]) -> Pulses3 -> [Frame] -> [a]
runWith onto = go 1
  where
    go n at frames = case frames of
      [] -> []
      f : more
        | increment f /= 0 || isRound f ->
          let next = at + increment f
              m = Motion {number = n, from = at, to = next, frame = f}
           in m `seq` onto m (go (n + 1) next more)
        | otherwise -> go (n + 1) at more

-- | Test that a frame is an arc whose radii at the start and at the end are not 0. In other words,
-- the centre of the arc is neither its start nor its end.
isRound :: Frame -> Bool
isRound f = case motion f of
  Circular _ -> Frame.centre f /= 0 && Frame.centre f /= Pulses2 x y
  NoMotion -> False
  Rapid -> False
  Linear -> False
  where
    Pulses3 x y _ = increment f

-- | Test, exactly in pulses, that the start and the end of an arc lie in the same direction from
-- its centre.
endsInStartDirection :: Frame -> Bool
endsInStartDirection f = a * d == b * c && a * c + b * d > 0
  where
    Pulses2 i j = Frame.centre f
    Pulses3 x y _ = increment f
    (a, b, c, d) = (-i, -j, x - i, y - j)

-- | Segment of a motion in the plane, in mm. Its ends are those of the motion, even if the ends of
-- an arc have different radii. An arc that is not 'isRound' becomes a line. If both ends lie in the
-- same direction from the centre, the arc is a full circle. Controls compare these directions, not
-- the positions of the ends.
segment :: Machine -> Motion -> Segment
segment machine m = case (Frame.segment machine (from m) (frame m), motion (frame m)) of
  (a@Arc {}, Circular sense)
    | not (isRound (frame m)) -> Straight (Segment.start a) (Segment.end a)
    | endsInStartDirection (frame m) -> a {sweep = Rad (Carrier.senseSign sense * 2 * pi)}
  (other, _) -> other

-- | Bounding paths of a motion, given by the motion's segment. A line has one bounding path, and so
-- has an arc whose radii agree within 'Tolerance.coincident'. Any other arc has two: one on its
-- start radius, one on its end radius.
boundingPaths :: Segment -> NonEmpty Segment
boundingPaths s = case s of
  Straight a b -> Straight a b :| []
  Arc {start, end, centre = c, sweep}
    | abs (endRadius - startRadius) <= same -> Arc {start, end, centre = c, sweep} :| []
    | otherwise ->
      Arc {start, end = onRadius startRadius end, centre = c, sweep}
        :| [Arc {start = onRadius endRadius start, end, centre = c, sweep}]
    where
      Mm startRadius = Vec.distance c start
      Mm endRadius = Vec.distance c end
      Mm same = Tolerance.coincident
      onRadius r p = Vec.shift (Vec.scale r (Vec.unit (Vec.to c p))) c

-- | Lines that connect the first bounding path with each of the others: one between the starts of
-- both paths, and one between their ends.
connectors :: NonEmpty Segment -> [Segment]
connectors (one :| others) =
  concat
    [ [ Straight (Segment.start one) (Segment.start other),
        Straight (Segment.end one) (Segment.end other)
      ]
      | other <- others
    ]

-- | Distances of the start and of the end of an arc from its centre. Nothing for a line, and for an
-- arc whose centre is its start or its end.
radii :: Machine -> Motion -> Maybe (Mm, Mm)
radii machine m = if isRound (frame m) then ends else Nothing
  where
    ends = case segment machine m of
      Straight _ _ -> Nothing
      Arc {start, end, centre = c} -> Just (Vec.distance c start, Vec.distance c end)

-- | Heights at the start and at the end of a motion, in mm.
height :: Machine -> Motion -> (Mm, Mm)
height machine m = (Frame.height machine (from m), Frame.height machine (to m))

-- | Length of a motion's path in space. For a helix it is the length along the slope.
travel :: Machine -> Motion -> Mm
travel machine m = Mm (Vec.norm (Vec.vec l (b - a)))
  where
    Mm l = Segment.length (segment machine m)
    (Mm a, Mm b) = height machine m
