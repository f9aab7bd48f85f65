{-# OPTIONS_GHC -O2 #-}

-- | A virtual controller without time: every frame that moves is one stroke, straight or on an arc.
--
-- The centre of an arc is a whole number of pulses from its beginning, and so is its end: the two
-- lie at distances from the centre that may differ. What a control makes of that is its own affair:
-- it goes about the centre of the frame, in its sense, no nearer than the one and no further than
-- the other. So such a stroke has two ways, the arc with the radius of its beginning and the one
-- with that of its end, each between the directions of both, and the ways across from one to the
-- other; whatever is compared with a stroke has to hold for all of them.
module Control.Motion
  ( Motion (..),
    run,
    runWith,
    isRound,
    endsAbreast,
    segment,
    between,
    across,
    radii,
    height,
    lengthOf,
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

-- | What one frame does: its number from 1, from where to where in pulses, the frame.
data Motion = Motion {number :: Int, from :: Pulses3, to :: Pulses3, frame :: Frame}
  deriving stock (Eq, Show)

-- | Run frames from a position. A frame that only commands makes no stroke; a full circle makes
-- one.
run :: Pulses3 -> [Frame] -> [Motion]
run = runWith (:)

-- | The same, with what is made of each stroke before what is made of those behind it. There is no
-- list of the strokes themselves.
runWith :: (Motion -> [a] -> [a]) -> Pulses3 -> [Frame] -> [a]
runWith before = go 1
  where
    go n at frames = case frames of
      [] -> []
      f : more
        | increment f /= 0 || isRound f ->
          let next =
                at + increment f
              s = Motion {number = n, from = at, to = next, frame = f}
           in s `seq` before s (go (n + 1) next more)
        | otherwise -> go (n + 1) at more

-- | Whether a frame goes about a centre. About its own beginning or its own end there is no arc.
isRound :: Frame -> Bool
isRound f = case motion f of
  Round _ -> Frame.centre f /= 0 && Frame.centre f /= Pulses2 x y
  Still -> False
  Rapid -> False
  Straightway -> False
  where
    Pulses3 x y _ = increment f

-- | Whether an arc ends in the direction from its centre in which it begins, by whole pulses.
endsAbreast :: Frame -> Bool
endsAbreast f = a * d == b * c && a * c + b * d > 0
  where
    Pulses2 i j = Frame.centre f
    Pulses3 x y _ = increment f
    (a, b, c, d) = (-i, -j, x - i, y - j)

-- | The stroke in the plane, in mm, exactly from its beginning to its end; an arc has the radius of
-- its beginning. An arc whose ends lie in one direction from the centre is a full turn, as it is
-- for a control that compares angles.
segment :: Machine -> Motion -> Segment
segment machine s = case (Frame.segment machine (from s) (frame s), motion (frame s)) of
  (a@Arc {}, Round turn)
    | not (isRound (frame s)) -> Straight (Segment.start a) (Segment.end a)
    | endsAbreast (frame s) -> a {sweep = Rad (Carrier.sense turn * 2 * pi)}
  (other, _) -> other

-- | The ways between which the control goes along a segment, of which an arc may end on another
-- radius than that on which it begins: each of them whole, with its ends on its circle.
between :: Segment -> NonEmpty Segment
between s = case s of
  Straight a b -> Straight a b :| []
  Arc {start, end, centre = c, sweep}
    | abs (outer - inner) <= same -> Arc {start, end, centre = c, sweep} :| []
    | otherwise ->
      Arc {start, end = at inner end, centre = c, sweep}
        :| [Arc {start = at outer start, end, centre = c, sweep}]
    where
      Mm inner = Vec.distance c start
      Mm outer = Vec.distance c end
      Mm same = Tolerance.coincident
      at r p = Vec.shift (Vec.scale r (Vec.unit (Vec.to c p))) c

-- | The ways across from one of two ways to the other, at their beginnings and at their ends.
across :: NonEmpty Segment -> [Segment]
across (one :| others) =
  concat
    [ [ Straight (Segment.start one) (Segment.start other),
        Straight (Segment.end one) (Segment.end other)
      ]
      | other <- others
    ]

-- | The radii of an arc at its beginning and at its end.
radii :: Machine -> Motion -> Maybe (Mm, Mm)
radii machine s = if isRound (frame s) then ends else Nothing
  where
    ends = case segment machine s of
      Straight _ _ -> Nothing
      Arc {start, end, centre = c} -> Just (Vec.distance c start, Vec.distance c end)

-- | The heights at the beginning and at the end, in mm.
height :: Machine -> Motion -> (Mm, Mm)
height machine s = (Frame.height machine (from s), Frame.height machine (to s))

-- | The way that the cutter goes, in space.
lengthOf :: Machine -> Motion -> Mm
lengthOf machine s = Mm (Vec.norm (Vec.vec l (b - a)))
  where
    Mm l = Segment.length (segment machine s)
    (Mm a, Mm b) = height machine s
