-- | Chords: how far they may be off, and where they end.
module Frame.Chord
  ( Allowed (..),
    allowedOn,
    rounding,
    remainder,
    ends,
    chords,
    bandChords,
    chordCount,
    frameCount,
  )
where

import Base.Quantity (Mm (..), Pulses (..), Rad (..), minus, times)
import Data.Either (fromRight)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Frame.Chording qualified as Chording
import Frame.Rounding (PathPosition)
import Frame.Rounding qualified as Rounding
import Geometry.Carrier qualified as Carrier
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Milling)
import Part.Part qualified as Part
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Move (..))
import Toolpath.Toolpath qualified as Toolpath

-- | How far chords may be off.
data Allowed
  = -- | between points of the path
    Sagitta Mm
  | -- | so far towards the centre of an arc, and so far away from it
    BandOf Mm Mm
  | -- | along a curve
    Along Chording.Bounds

-- | What is allowed to the chords of a run.
allowedOn :: Machine -> Milling -> NonEmpty Move -> Allowed
allowedOn machine job =
  \ms -> if Toolpath.isCurve ms then onCurve else chordError side job (segment (NonEmpty.head ms))
  where
    -- Both are the same for all runs of a job.
    side = fromRight Nothing (Toolpath.leadingSide job)
    onCurve = Along (curveBounds machine side job)

-- | What the rounding of their ends leaves to the chords of an arc that may be off by so much, less
-- a hair.
remainder :: Machine -> Mm -> Mm
remainder machine off =
  times (1 - Tolerance.equal) (max (Mm 0) (minus off (times (sqrt 0.5) (Machine.pulse machine))))

-- | How far a curve may lie from its chords: a chord that runs inside of the material has the curve
-- on the cutter's side. What the arcs are off from the curve is taken from it first. Heights are as
-- exact as the chords, or to a pulse.
curveBounds :: Machine -> Maybe Carrier.Side -> Milling -> Chording.Bounds
curveBounds machine side job =
  Chording.Bounds
    { Chording.left = l,
      Chording.right = r,
      Chording.rise = max pulse (min l r),
      Chording.shortest = pulse
    }
  where
    pulse = Machine.pulse machine
    (l, r) = case (Part.tolerance job, side) of
      (Part.OnPath d, _) -> (less d, less d)
      (Part.Band a b, Just Carrier.LeftOf) -> (less a, less b)
      (Part.Band a b, Just Carrier.RightOf) -> (less b, less a)
      (Part.Band a b, Nothing) ->
        let d =
              if a > Mm 0 && b > Mm 0 then min a b else max a b
         in (less d, less d)
    less d = max (Mm 0) (minus d Tolerance.curve)

-- | The chord error of a segment: on the side of the material its own, and on the other one.
chordError :: Maybe Carrier.Side -> Milling -> Segment -> Allowed
chordError leading job s = case (Part.tolerance job, s) of
  (Part.OnPath d, _) -> Sagitta d
  (Part.Band a b, Straight _ _) -> Sagitta (max a b)
  (Part.Band a b, Arc {sweep = Rad angle}) -> case leading of
    -- The centre of an arc lies on the left when it is walked counter-clockwise; the material lies
    -- on the side on which the cutter is not.
    Just side
      | (angle > 0) == (side == Carrier.LeftOf) -> BandOf b a
      | otherwise -> BandOf a b
    Nothing -> Sagitta (if a > Mm 0 && b > Mm 0 then min a b else max a b)

-- | What is allowed to chords whose ends are rounded: where the tolerance is less than rounding
-- leaves of a pulse, that. A band of which one side is wider stays as it was asked for.
rounding :: Machine -> Allowed -> Allowed
rounding machine allowed = case allowed of
  Sagitta y -> Sagitta (max least y)
  BandOf a b -> if max a b >= least then allowed else BandOf least least
  -- What the arcs are off from the curve is taken from it first.
  Along bounds
    | max (Chording.left bounds) (Chording.right bounds) >= most -> allowed
    | otherwise -> Along bounds {Chording.left = most, Chording.right = most}
  where
    least = remainder machine (Machine.pulse machine)
    most = minus least Tolerance.curve

-- | The ends of the chords of a run with their heights; of a curve, when there are more than so
-- many, at least so many.
ends :: Int -> Machine -> Allowed -> NonEmpty Move -> [PathPosition]
ends most machine allowed ms = case allowed of
  Sagitta y -> alone (chords machine y)
  BandOf toward away -> alone (bandChords machine toward away)
  Along bounds -> Chording.chordEnds most bounds ms
  where
    m = NonEmpty.head ms
    alone chordsOf =
      let points =
            chordsOf (segment m)
       in zip
            points
            [ Rounding.heightAt (fromIntegral k / fromIntegral (length points)) m
              | k <- [1 .. length points]
            ]

-- | The ends of the chords of a segment, the last one its end: equal steps that stay within the
-- sagitta, @Δφ = 2·arccos(1 − y/R) = 4·arcsin √(y/2R)@ (Ural paper; R is the radius of the path),
-- none longer than a quarter turn.
chords :: Machine -> Mm -> Segment -> [Point]
chords machine sagitta segment =
  [Segment.at (fromIntegral k / fromIntegral n) segment | k <- [1 .. n]]
  where
    n = chordCount machine sagitta segment

-- | The ends of the chords of a segment within a band: so far towards the centre of an arc, so far
-- away from it. Between its ends, which lie on the arc, the corners lie on the outer edge of the
-- band, @ρ = R + δ₂@, and the chords touch its inner edge: @cos(Δφ/2) = (R − δ₁)/ρ@.
bandChords :: Machine -> Mm -> Mm -> Segment -> [Point]
bandChords machine toward away s = case s of
  Straight _ b -> [b]
  Arc {start = p, centre, sweep = Rad angle}
    | away <= Mm 0 -> chords machine toward s
    | 2 * leave >= abs angle && abs angle <= pi / 2 -> [Segment.end s]
    | otherwise -> [corner (first + fromIntegral k * step) | k <- [0 .. count]] <> [Segment.end s]
    where
      Mm r = Segment.radius centre p
      inner = max 0 (let Mm d = toward in r - d)
      outer = let Mm d = away in r + d
      -- From an end of the arc to where its chord touches the inner edge, and on to the outer one.
      leave = acos (inner / r)
      first' = min (pi / 4) (leave + acos (inner / outer))
      widest =
        max
          (2 * asin (min 1 (let Mm pulse = Machine.pulse machine in pulse / (2 * r))))
          (min (pi / 2) (2 * acos (inner / outer)))
      count = max 0 (ceiling ((abs angle - 2 * first') / widest - 1e-9)) :: Int
      first = if count == 0 then abs angle / 2 else first'
      step = if count == 0 then 0 else (abs angle - 2 * first) / fromIntegral count
      corner a =
        Vec.shift
          (Vec.scale (outer / r) (Vec.rotate (Rad (signum angle * a)) (Vec.to centre p)))
          centre

-- | How many frames a run needs, or one less for each chord: its chords, each split to fit the
-- fields of a frame. Where the chords of a curve end is given.
frameCount :: Machine -> Allowed -> NonEmpty Move -> [PathPosition] -> Int
frameCount machine allowed ms stops = case allowed of
  Sagitta y -> alone y
  BandOf a b -> alone (max a b)
  Along _ ->
    let points =
          map fst stops
     in sum
          ( zipWith
              (\p q -> parts (let Mm d = Vec.distance p q in d))
              (Segment.start only : points)
              points
          )
  where
    only = segment (NonEmpty.head ms)
    alone y =
      let n =
            chordCount machine y only
          Mm l = Segment.length only
       in n * parts (l / fromIntegral n)
    parts l = max 1 (ceiling (l / (fromIntegral field * pulse)))
    Mm pulse = Machine.pulse machine
    Pulses field = max 1 (minimum [Machine.capacity machine axis | axis <- [X, Y]])

-- | How many chords a segment needs. Chords shorter than a pulse serve nobody.
chordCount :: Machine -> Mm -> Segment -> Int
chordCount machine (Mm y) segment = case segment of
  Straight _ _ -> 1
  Arc {start = p, centre, sweep = Rad angle} ->
    let Mm r = Segment.radius centre p
        step = min (pi / 2) (4 * asin (min 1 (sqrt (y / (2 * r)))))
        wanted = ceiling (abs angle / step - almost) :: Int
        Mm l = Segment.length segment
        Mm pulse = Machine.pulse machine
        sensible = ceiling (l / pulse)
     in max 1 (if step * r < pulse then sensible else wanted)
  where
    -- A step that fits a whole number of times is not to need one more for rounding.
    almost = 1e-9
