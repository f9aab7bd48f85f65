-- | Allowed chord errors, and the chords of single segments.
--
-- A job is the milling or turning of a contour. From the tolerance of a job this module derives how
-- far a chord may lie from the toolpath. It divides an arc into equal chords within this distance,
-- and counts chords and frames in advance. A run is a sequence of moves along one line, arc or
-- curve. Curves of several moves are divided by "Frame.Chording".
module Frame.ChordError
  ( ChordTolerance (..),
    chordTolerance,
    betweenWalls,
    onBothSides,
    raisedToRounding,
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
import Data.Maybe (isJust)
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

-- | Allowed chord error of a run of moves.
data ChordTolerance
  = -- | largest sagitta in mm between a segment and its chords; the ends of the chords lie on the
    -- segment
    Sagitta Mm
  | -- | band about an arc, in mm: the width on the side of the arc's centre, and the width on the
    -- other side
    ArcBand Mm Mm
  | -- | largest distances of a curve of several moves from its chords, on both sides
    OnCurve Chording.Bounds
  deriving stock (Eq, Show)

-- | Allowed chord error of the runs of a job. Apply the first two arguments once, and the result to
-- many runs.
chordTolerance :: Machine -> Milling -> NonEmpty Move -> ChordTolerance
chordTolerance machine job = \run ->
  if Toolpath.isCurve run
    then onCurve
    else segmentTolerance side job (segment (NonEmpty.head run))
  where
    -- Both values are the same for all runs of a job, so they are computed once per job.
    side = fromRight Nothing (Toolpath.leadingSide job)
    onCurve = OnCurve (curveBounds machine side job)

-- | Chord error in mm that @tolerance@ allows when the ends of the chords are rounded to whole
-- pulses; at least 0. Rounding moves an end by up to half the diagonal of a square with sides of
-- one pulse, so this amount is subtracted from @tolerance@. The difference is multiplied by
-- @1 − 'Tolerance.equal'@, to allow for the rounding of doubles.
remainder :: Machine -> Mm -> Mm
remainder machine tolerance =
  times
    (1 - Tolerance.equal)
    (max (Mm 0) (minus tolerance (times (sqrt 0.5) (Machine.planeResolution machine))))

-- | Bounds for the chords of a curve of the toolpath. @side@ is the side of the contour on which
-- the cutter moves; Nothing when the cutter's centre moves on the contour. A chord that lies nearer
-- to the material than the curve has the curve on this side. Therefore the tolerance towards the
-- material is the bound on this side. The moves of a curve are approximations themselves, so
-- 'Tolerance.curve' is subtracted from the tolerance. The bound for heights is the smaller one of
-- the bounds to the left and to the right, but at least a pulse.
curveBounds :: Machine -> Maybe Carrier.Side -> Milling -> Chording.Bounds
curveBounds machine side job =
  Chording.Bounds
    { Chording.left = l,
      Chording.right = r,
      Chording.rise = max pulse (min l r),
      Chording.shortest = pulse
    }
  where
    pulse = Machine.planeResolution machine
    (l, r) = case (Part.tolerance job, side) of
      (Part.OnPath d, _) -> (less d, less d)
      (Part.Band a b, Just _) | isPointed job -> let d = min a b in (less d, less d)
      (Part.Band a b, Just Carrier.LeftOf) -> (less a, less b)
      (Part.Band a b, Just Carrier.RightOf) -> (less b, less a)
      (Part.Band a b, Nothing) -> let d = sideless a b in (less d, less d)
    less d = max (Mm 0) (minus d Tolerance.curve)

-- | Allowed chord error of the segment @s@. @leading@ is the side of the contour on which the
-- cutter moves; Nothing when the cutter's centre moves on the contour. A band has a tolerance
-- towards the material and another one away from it. The cutter's side decides which of the two is
-- towards the centre of an arc.
segmentTolerance :: Maybe Carrier.Side -> Milling -> Segment -> ChordTolerance
segmentTolerance leading job s = case (Part.tolerance job, s) of
  (Part.OnPath d, _) -> Sagitta d
  (Part.Band a b, Straight _ _) -> Sagitta (max a b)
  (Part.Band a b, Arc {}) | isPointed job, isJust leading -> Sagitta (min a b)
  (Part.Band a b, Arc {sweep = Rad angle}) -> case leading of
    -- The centre of a counter-clockwise arc lies on its left. The material lies on the side
    -- opposite to the cutter.
    Just side
      | (angle > 0) == (side == Carrier.LeftOf) -> ArcBand b a
      | otherwise -> ArcBand a b
    Nothing -> Sagitta (sideless a b)

-- | Tolerance of the moves in a pocket with the tolerance @t@. There may be a wall on both sides of
-- the cutter, so the smaller one of a band's two tolerances holds on both sides. A band with a
-- tolerance of 0 stays unchanged, because no chords of an arc keep 0 on both sides.
betweenWalls :: Part.Accuracy -> Part.Accuracy
betweenWalls t = case t of
  Part.Band a b | a > Mm 0, b > Mm 0 -> let d = min a b in Part.Band d d
  _ -> t

-- | The chord tolerance @tolerance@ with the chord error @least@ in mm on both sides. If @least@ is
-- smaller than rounding makes sense of, the result is the least value of 'raisedToRounding'.
onBothSides :: Machine -> Mm -> ChordTolerance -> ChordTolerance
onBothSides machine least tolerance = raisedToRounding machine $ case tolerance of
  Sagitta y -> Sagitta (min y least)
  ArcBand _ _ -> ArcBand least least
  OnCurve bounds ->
    let d = max (Mm 0) (minus least Tolerance.curve)
     in OnCurve bounds {Chording.left = d, Chording.right = d}

-- | True for a pointed tool. Its path is the contour itself, and its distance from the contour does
-- not show on which side it is. So the smaller tolerance of a band holds on both sides.
isPointed :: Milling -> Bool
isPointed job = Part.radius job <= Mm 0

-- | Tolerance in mm where the cutter's centre moves on the contour, so that the cutter has no side.
-- It is the smaller one of a band's two tolerances, or the larger one if the smaller one is 0.
sideless :: Mm -> Mm -> Mm
sideless a b = if a > Mm 0 && b > Mm 0 then min a b else max a b

-- | The chord error @tolerance@, raised to a least value if it is smaller, because rounding makes
-- smaller ones pointless. This least value is the result of 'remainder' for a tolerance of one
-- pulse. A band stays unchanged if its wider side is at least that wide.
raisedToRounding :: Machine -> ChordTolerance -> ChordTolerance
raisedToRounding machine tolerance = case tolerance of
  Sagitta y -> Sagitta (max least y)
  ArcBand a b -> if max a b >= least then tolerance else ArcBand least least
  OnCurve bounds
    | max (Chording.left bounds) (Chording.right bounds) >= leastOnCurve -> tolerance
    | otherwise -> OnCurve bounds {Chording.left = leastOnCurve, Chording.right = leastOnCurve}
  where
    least = remainder machine (Machine.planeResolution machine)
    -- The arcs of a run themselves deviate from the curve by up to 'Tolerance.curve'.
    leastOnCurve = minus least Tolerance.curve

-- | Ends of the chords of a run in mm, with their heights. If a curve has more than @limit@ chords,
-- the list is incomplete but has at least @limit@ entries.
ends :: Int -> Machine -> ChordTolerance -> NonEmpty Move -> [PathPosition]
ends limit machine tolerance run = case tolerance of
  Sagitta y ->
    let points = chords machine y (segment m)
        count = length points
     in withHeights [fromIntegral k / fromIntegral count | k <- [1 .. count]] points
  ArcBand toward away ->
    let points = bandChords machine toward away (segment m)
     in withHeights (map (Segment.fraction (segment m)) (init points) <> [1]) points
  OnCurve bounds -> Chording.chordEnds limit bounds run
  where
    m = NonEmpty.head run
    withHeights fractions points = zip points (map (`Rounding.heightAt` m) fractions)

-- | Ends of the chords of a segment, the last of which is the end of the segment. The chords are
-- equal, and each stays within @sagitta@ (y, in mm) of the segment. A chord of an arc of radius R
-- spans at most @Δφ = 2·arccos(1 − y/R) = 4·arcsin √(y/2R)@, and at most a quarter turn. The
-- formula is that of the paper on the Ural-1 computer. If such chords are shorter than a pulse,
-- chords of about one pulse replace them, even if these exceed @sagitta@.
chords :: Machine -> Mm -> Segment -> [Point]
chords machine sagitta segment =
  [Segment.at (fromIntegral k / fromIntegral n) segment | k <- [1 .. n]]
  where
    n = chordCount machine sagitta segment

-- | Ends of the chords of the segment @s@ within a band. The band has the width @toward@ (δ₁, in
-- mm) towards the centre of the arc, and @away@ (δ₂) away from it. The chain of chords begins at
-- the start of the arc and ends at its end. The corners of the chain lie on the outer edge of the
-- band, a circle of the radius @ρ = R + δ₂@. A chord may reach to the inner edge. So it spans at
-- most the angle Δφ with @cos(Δφ/2) = (R − δ₁)/ρ@, and at most a quarter turn. But a chord of about
-- one pulse is always allowed. A chain with one corner only keeps this corner as near to the arc as
-- the inner edge permits: both chords touch that edge.
bandChords :: Machine -> Mm -> Mm -> Segment -> [Point]
bandChords machine toward away s = case s of
  Straight _ b -> [b]
  Arc {start = p, centre, sweep = Rad angle}
    | away <= Mm 0 -> chords machine toward s
    | 2 * toInnerEdge >= abs angle && abs angle <= pi / 2 -> [Segment.end s]
    | count == 0 ->
      [ cornerAt (min outer (inner / cos (abs angle / 2 - toInnerEdge))) (abs angle / 2),
        Segment.end s
      ]
    | otherwise ->
      [cornerAt outer (toFirstCorner + fromIntegral k * step) | k <- [0 .. count]]
        <> [Segment.end s]
    where
      Mm r = Segment.radius centre p
      inner = max 0 (let Mm d = toward in r - d)
      outer = let Mm d = away in r + d
      -- Angle in radians from an end of the arc to the point where the chord from this end touches
      -- the inner edge.
      toInnerEdge = acos (inner / r)
      toFirstCorner = min (pi / 4) (toInnerEdge + acos (inner / outer))
      widest =
        max
          (2 * asin (min 1 (let Mm pulse = Machine.planeResolution machine in pulse / (2 * r))))
          (min (pi / 2) (2 * acos (inner / outer)))
      count = max 0 (ceiling ((abs angle - 2 * toFirstCorner) / widest - countSlack)) :: Int
      step = (abs angle - 2 * toFirstCorner) / fromIntegral count
      cornerAt radius a =
        Vec.shift
          (Vec.scale (radius / r) (Vec.rotate (Rad (signum angle * a)) (Vec.to centre p)))
          centre

-- | Number of frames for a run, to reject a program with too many frames before they are made. Each
-- chord is split to fit the fields of a frame. Rounding may lengthen a chord, which then needs one
-- more frame than is counted. @chordEnds@ are the ends of the run's chords; they are used only for
-- a curve.
frameCount :: Machine -> ChordTolerance -> NonEmpty Move -> [PathPosition] -> Int
frameCount machine tolerance run chordEnds = case tolerance of
  Sagitta y -> equalChords y
  ArcBand a b -> equalChords (max a b)
  OnCurve _ ->
    let points = map fst chordEnds
     in sum
          ( zipWith
              (\p q -> parts (let Mm d = Vec.distance p q in d))
              (Segment.start only : points)
              points
          )
  where
    only = segment (NonEmpty.head run)
    equalChords y =
      let n = chordCount machine y only
          Mm l = Segment.length only
       in n * parts (l / fromIntegral n)
    parts l = max 1 (ceiling (l / (fromIntegral field * pulse)))
    Mm pulse = Machine.planeResolution machine
    Pulses field = max 1 (minimum [Machine.capacity machine axis | axis <- [X, Y]])

-- | Number of equal chords of a segment within the sagitta @y@ in mm; 1 for a line. Chords shorter
-- than a pulse are useless. Where the sagitta would need them, the length of the arc in pulses is
-- the number of chords.
chordCount :: Machine -> Mm -> Segment -> Int
chordCount machine (Mm y) segment = case segment of
  Straight _ _ -> 1
  Arc {start = p, centre, sweep = Rad angle} ->
    let Mm r = Segment.radius centre p
        step = min (pi / 2) (4 * asin (min 1 (sqrt (y / (2 * r)))))
        bySagitta = ceiling (abs angle / step - countSlack) :: Int
        Mm l = Segment.length segment
        Mm pulse = Machine.planeResolution machine
        byPulse = ceiling (l / pulse)
     in max 1 (if step * r < pulse then byPulse else bySagitta)

-- | Share of a step that is ignored when steps are counted, as a fraction. Without it the rounding
-- of doubles would add a chord where the arc is a whole number of steps.
countSlack :: Double
countSlack = 1e-9
