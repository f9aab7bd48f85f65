{-# LANGUAGE BangPatterns #-}
-- The loops carry more than ten numbers. The option -fmax-worker-args keeps these unboxed.
{-# OPTIONS_GHC -O2 -fmax-worker-args=40 #-}

-- | Rounded arcs about given grid points, and the choice of the best grid point. A grid point is a
-- position in whole pulses. An attempt is the rounded arc about one grid point, which becomes its
-- centre. It is divided into steps, one for each frame. The deviation of an attempt is its largest
-- distance from the exact arc.
--
-- Some controls need arcs that stay within a quadrant. For them the arc is cut at the axes through
-- its centre.
module Frame.Arc.Attempt
  ( bestAbout,
    isNearlyStraight,
    isStraightEnough,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..), xy)
import Base.Quantity (Mm (..), Rad (..), minus, plus)
import Data.List (foldl')
import Data.Maybe (mapMaybe)
import Data.Ord (comparing)
import Frame.Arc.Centre qualified as Centre
import Frame.Arc.Context
  ( ArcContext (..),
    ArcStep (..),
    ArcTolerance (..),
    Grid (..),
    RoundedArc (..),
  )
import Frame.Arc.Context qualified as Context
import Frame.Arc.Deviation (ArcDeviation (..))
import Frame.Arc.Deviation qualified as Deviation
import Frame.Arc.Estimate (ArcEnds)
import Frame.Arc.Estimate qualified as Estimate
import Frame.Arc.Quadrant qualified as Quadrant
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), Axis (..))
import Machine.Machine qualified as Machine

-- | Steps of an arc about one grid point, with their largest deviation in mm.
data Attempt = Attempt {steps :: [ArcStep], deviation :: Double}

-- | Attempt about a grid point, with the rank of this point: its number from 0 among all grid
-- points that are tried. Of two equally good attempts the one of lower rank wins.
data Ranked = Ranked {rank :: Int, attempted :: Attempt}

-- | Steps of an arc about the best of some grid points. Nothing when no 'attempt' about them
-- succeeds.
--
-- Grid points about which the whole arc is one frame have priority. Of these, the one with the
-- least deviation is chosen, and the first of several equal ones. The grid point with the least
-- estimated deviation is attempted first. Another grid point is attempted only if 'isBetter' finds
-- it better than the best so far. When no single frame is within the tolerance, all grid points are
-- attempted, and the attempt with the fewest steps is chosen. If several have the fewest, the one
-- with the least deviation is chosen.
bestAbout :: ArcContext -> RoundedArc -> [Pulses2] -> Maybe [ArcStep]
bestAbout context arc centres
  | Just ends <- Estimate.endsOf (grid context) arc,
    Likeliest first c <- likeliest ends wholes,
    Just found <- leastDeviation context arc ends wholes (ranked context arc first c) =
    Just (steps (attempted found))
  | otherwise = fewestSteps (mapMaybe (attempt context arc) centres)
  where
    wholes = filter (Centre.isOneFrame context arc) centres

-- | Steps of the attempt with the fewest steps; if there are several, of the one with the least
-- deviation. Nothing if there are no attempts.
fewestSteps :: [Attempt] -> Maybe [ArcStep]
fewestSteps attempts = case attempts of
  [] -> Nothing
  first : others ->
    Just (steps (foldl' (\x y -> if comparing cost y x == LT then y else x) first others))
  where
    cost a = (length (steps a), deviation a)

-- | The likeliest grid point: the one with the least estimated deviation, with its rank. 'None'
-- when there are no grid points.
data Likeliest = None | Likeliest Int Pulses2

-- | The likeliest of the grid points in the list.
likeliest :: ArcEnds -> [Pulses2] -> Likeliest
likeliest ends = go 0 None (1 / 0)
  where
    go !k best !least todo = case todo of
      [] -> best
      c : more
        | d <- Estimate.estimate ends c,
          d < least,
          d' <- max d (Estimate.errorAtBegin ends c),
          d' < least ->
          go (k + 1) (Likeliest k c) d' more
        | None <- best -> go (k + 1) (Likeliest k c) least more
        | otherwise -> go (k + 1) best least more

-- | Attempt with the least deviation about some grid points; Nothing when no 'attempt' about them
-- succeeds. The last argument is the attempt about the likeliest grid point; Nothing when this
-- attempt did not succeed.
leastDeviation ::
  ArcContext -> RoundedArc -> ArcEnds -> [Pulses2] -> Maybe Ranked -> Maybe Ranked
leastDeviation context arc ends = go 0
  where
    go !k todo best = case todo of
      [] -> best
      c : more -> go (k + 1) more (better best k c)
    better best k c = case best of
      Nothing -> ranked context arc k c
      Just b
        | isBetter context arc ends b k c, Just a <- ranked context arc k c -> Just a
        | otherwise -> best

-- | Attempt about the grid point @c@ with the rank @k@; Nothing when 'attempt' does not succeed.
ranked :: ArcContext -> RoundedArc -> Int -> Pulses2 -> Maybe Ranked
ranked context arc k c = Ranked k <$> attempt context arc c

-- | True if the whole arc about the grid point @c@, which has the rank @k@, is better than @best@,
-- the best attempt so far. The better one has the smaller deviation; of two equal ones it has the
-- lower rank. The cheapest tests come first.
isBetter :: ArcContext -> RoundedArc -> ArcEnds -> Ranked -> Int -> Pulses2 -> Bool
isBetter context arc ends best k c =
  not isSurelyWorse
    && isLess (Estimate.errorAtBegin ends c)
    && isLess (Deviation.linearErrorAt frameArc 1)
    && isLessEverywhere
  where
    least = deviation (attempted best)
    isSurelyWorse = Estimate.estimate ends c - Estimate.estimateError ends c > least
    isLess d = d < least || d == least && k < rank best
    frameArc = Estimate.frameArcAbout ends (sense arc) c
    isLessEverywhere = case Deviation.deviationAtEnds (tolerance context) frameArc of
      Just d -> isLess (linear d)
      Nothing ->
        all (isLess . Deviation.linearErrorAt frameArc) samples
          && isLess (linear (Deviation.sampledDeviation frameArc))

-- | Fractions of a sweep, between 0 and 1, at which the deviation is computed. Those at which it is
-- likely to be large come first.
samples :: [Double]
samples = [4 / 8, 2 / 8, 6 / 8, 1 / 8, 7 / 8, 3 / 8, 5 / 8]

-- One attempt -------------------------------------------------------------------------------------

-- | Step of an attempt: its ends in pulses, the arc between them in mm, and True when a line
-- replaces this arc.
data Leg = Leg {from :: Pulses2, to :: Pulses2, arcAlong :: Segment, isStraight :: Bool}

-- | Attempt about the grid point @c@. It succeeds if the machine can run the arc about @c@ within
-- the tolerance; otherwise Nothing.
attempt :: ArcContext -> RoundedArc -> Pulses2 -> Maybe Attempt
attempt context arc c
  | null ends || isClosed && length ends == 1 && not isFullCircle = Nothing
  | all (isValid context c) (zip starts ends)
      && and (zipWith isNear legs deviations)
      && abs (sum (map (swept . arcAlong) legs) - sweep arc) <= sweepSlack =
    Just (Attempt (map (stepOf arc c) legs) (maximum (map linear deviations)))
  | otherwise = Nothing
  where
    ends =
      Quadrant.frameEnds
        (machine (grid context))
        (Quadrant.crossings (grid context) (radius arc) (centre arc) c)
        (sense arc)
        c
        (xy (begin arc))
        (xy (finish arc))
    starts = xy (begin arc) : ends
    isClosed = begin arc == finish arc
    isFullCircle =
      allowsFullCircle context && abs (sweep arc) >= 2 * pi - Tolerance.equal
    legs = zipWith (legBetween context arc c) starts ends
    deviations = map (Deviation.deviationOf (tolerance context) (exact arc) . arcAlong) legs
    isNear leg d =
      isStraight leg || isWithinTolerance (tolerance context) d && keepsRadius (arcAlong leg)
    keepsRadius s = case (radiusChange (tolerance context), s) of
      (Just most, Segment.Arc {Segment.start = p, Segment.end = q, Segment.centre = m}) ->
        let Mm change = minus (Vec.distance m q) (Vec.distance m p) in Mm (abs change) <= most
      _ -> True
    Mm r = radius arc
    -- Largest allowed difference in radians between the sweep of the attempt and that of the exact
    -- arc. It allows for the rounding of the ends and the centre: it is the angle of four pulses
    -- along the arc, but at most a quarter turn.
    sweepSlack = min (pi / 2) (4 * pulse (grid context) / r)

-- | True when one frame of the machine can hold a full circle.
allowsFullCircle :: ArcContext -> Bool
allowsFullCircle context = case Machine.arcs (machine (grid context)) of
  NoArcs -> False
  Arcs {Machine.fullCircle} -> fullCircle

-- | True for deviations within a tolerance.
isWithinTolerance :: ArcTolerance -> ArcDeviation -> Bool
isWithinTolerance allowed d =
  Mm (linear d) <= linearError allowed
    && Mm (inward d) <= inwards allowed
    && Mm (outward d) <= outwards allowed

-- | Step between the grid points @from@ and @to@ about the grid point @c@; a full circle if @from@
-- and @to@ are equal. The step is a line if its arc is nearly straight and the line keeps the
-- tolerance. A cut at an axis can leave such an arc.
legBetween :: ArcContext -> RoundedArc -> Pulses2 -> Pulses2 -> Pulses2 -> Leg
legBetween context arc c from to =
  Leg
    { from,
      to,
      arcAlong,
      isStraight =
        isNearlyStraight context arcAlong && isStraightEnough context (exact arc) [from, to]
    }
  where
    arcAlong
      | from == to =
        Segment.Arc
          { Segment.start = a,
            Segment.end = a,
            Segment.centre = m,
            Segment.sweep = Rad (Carrier.senseSign (sense arc) * 2 * pi)
          }
      | otherwise = Segment.arc (sense arc) m a (Context.gridPoint (grid context) to)
    m = Context.gridPoint (grid context) c
    a = Context.gridPoint (grid context) from

-- | The leg about the grid point @c@ in the form of an 'ArcStep', with its centre relative to its
-- start.
stepOf :: RoundedArc -> Pulses2 -> Leg -> ArcStep
stepOf arc c Leg {from, to = Pulses2 x y, isStraight} =
  ArcStep
    { target = Pulses3 x y z,
      turnsAbout = if isStraight then Nothing else Just (sense arc, c - from)
    }
  where
    Pulses3 _ _ z = finish arc

-- | True when an arc from @from@ to @to@ about the grid point @c@ can be a frame. Its increments
-- and its centre have to fit their fields. The radii at both ends are not 0, and may differ by at
-- most two pulses.
isValid :: ArcContext -> Pulses2 -> (Pulses2, Pulses2) -> Bool
isValid context c (from, to) =
  from /= c
    && to /= c
    && (let Pulses2 i j = abs (c - from) in max i j <= largestCentre (grid context))
    && isFitting
    && abs (a - b) <= 2 * pulse (grid context)
  where
    Pulses2 dx dy = to - from
    isFitting = case Machine.measure (Machine.layout (machine (grid context))) of
      Machine.Positions -> True
      Machine.Increments ->
        abs dx <= Machine.capacity (machine (grid context)) X
          && abs dy <= Machine.capacity (machine (grid context)) Y
    inMm = Context.gridPoint (grid context)
    Mm a = Vec.distance (inMm c) (inMm from)
    Mm b = Vec.distance (inMm c) (inMm to)

-- | Sweep of an arc in radians, positive counter-clockwise; 0 for a line.
swept :: Segment -> Double
swept s = case s of
  Straight _ _ -> 0
  Segment.Arc {Segment.sweep = Rad a} -> a

-- Lines in place of arcs --------------------------------------------------------------------------

-- | True for a segment with a sagitta of less than half a pulse, which can become a line.
isNearlyStraight :: ArcContext -> Segment -> Bool
isNearlyStraight context s = Segment.sagitta s < Mm (0.5 * pulse (grid context))

-- | True when straight steps through the grid points @stops@ stay within the tolerance of the arc
-- @exact@. Even for a nearly straight arc this has to be tested. Its sagitta of up to half a pulse
-- and the rounding of the ends can together exceed a tolerance of one pulse.
isStraightEnough :: ArcContext -> Segment -> [Pulses2] -> Bool
isStraightEnough context exact stops = case exact of
  Straight _ _ -> True
  Segment.Arc {Segment.start = begin, Segment.centre = middle}
    -- The line from a to b replaces the arc. The arc is at most its sagitta away from its own
    -- chord. The chord is at most as far from the line as its ends are from a and b. If both
    -- distances together are at most @most@, no point of the arc is further from the line.
    | [a, b] <- points,
      plus
        (Segment.sagitta exact)
        (max (Vec.distance a begin) (Vec.distance b (Segment.end exact)))
        <= most ->
      isWithin
        (Distance.toPoint middle (Straight a b))
        (max (Vec.distance middle a) (Vec.distance middle b))
    -- To test the distances of the lines from the centre is not enough: lines that do not follow
    -- the arc could pass this test. So the distances of nine points of the arc from the lines are
    -- tested too.
    | otherwise ->
      isWithin
        (minimum (map (Distance.toPoint middle) lines'))
        (maximum (map (Vec.distance middle) points))
        && all ((<= most) . fromLines) [Segment.at (k / 8) exact | k <- [0 .. 8]]
    where
      isWithin nearest furthest =
        let r = Segment.radius middle begin
         in minus r nearest <= inwards (tolerance context)
              && minus furthest r <= outwards (tolerance context)
      fromLines p = minimum (map (Distance.toPoint p) lines')
  where
    most = max (inwards (tolerance context)) (outwards (tolerance context))
    points = map (Context.gridPoint (grid context)) stops
    lines' = zipWith Straight points (drop 1 points)
