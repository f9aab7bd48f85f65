{-# LANGUAGE BangPatterns #-}
-- The numbers that a loop carries stay bare even where there are more than ten of them.
{-# OPTIONS_GHC -O2 -fmax-worker-args=40 #-}

-- | Arcs in whole pulses.
--
-- The ends of an arc are rounded as absolute positions. About them and a centre that is a lattice
-- point the control walks: from the radius at the beginning to that at the end, evenly at best, all
-- at once at worst. Of the lattice points near the true centre, and near the one that is equally
-- far from both rounded ends, that is taken whose arc deviates least.
--
-- A control that ends arcs at the axes through their centres asks for more: the cuts lie, in whole
-- pulses, exactly on these axes. So the centre is chosen first, for the whole arc, and the cuts are
-- laid on its axes from there: what follows from whole numbers cannot be on the wrong side of an
-- axis by rounding.
module Frame.Arc
  ( ArcStep (..),
    ArcTolerance (..),
    Grid,
    gridOf,
    steps,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..), flat)
import Base.Quantity (Mm (..), Pulses (..), Rad (..), minus, plus)
import Data.List (foldl')
import Data.Maybe (fromMaybe, mapMaybe)
import Data.Ord (comparing)
import Frame.Rounding qualified as Rounding
import Geometry.Carrier (Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), Axis (..), Machine)
import Machine.Machine qualified as Machine

-- | A stop, and how it is reached: straight, or about a centre, which is counted from where the
-- step begins.
data ArcStep = ArcStep {stop :: Pulses3, about :: Maybe (Sense, Pulses2)}
  deriving stock (Eq, Show)

-- | How far the steps of an arc may leave it, rounding included.
data ArcTolerance = ArcTolerance
  { -- | those that are arcs, when the control goes evenly from the radius of their beginning to
    -- that of their end
    roundly :: Mm,
    -- | towards its centre, whatever they are and however the control goes
    inwards :: Mm,
    -- | away from its centre
    outwards :: Mm
  }
  deriving stock (Eq, Show)

-- | What is the same for all arcs on a machine.
data Grid = Grid
  { machine :: Machine,
    -- | the ways of one pulse in mm: along the axes, and the coarser one of them
    grainX :: Double,
    grainY :: Double,
    grain :: Double,
    -- | the largest number of pulses in the field of a centre
    furthestCentre :: Pulses
  }

gridOf :: Machine -> Grid
gridOf machine =
  Grid {machine, grainX, grainY, grain, furthestCentre = Machine.centreCapacity machine}
  where
    Mm grainX = Machine.pulseOf machine X
    Mm grainY = Machine.pulseOf machine Y
    Mm grain = Machine.pulse machine

-- | An arc to be walked.
data Task = Task
  { grid :: Grid,
    room :: ArcTolerance,
    -- | how it is walked in chords, from a position
    chorded :: Pulses3 -> Segment -> [Pulses3],
    height :: Mm
  }

-- | The steps along a segment at a height, from its rounded beginning to its rounded end. What can
-- not be an arc goes as chords.
steps ::
  Grid ->
  ArcTolerance ->
  (Pulses3 -> Segment -> [Pulses3]) ->
  Mm ->
  Pulses3 ->
  Segment ->
  [ArcStep]
steps grid room chorded height = walk deepest Task {grid, room, chorded, height}

-- | How often an arc is halved before it goes as chords.
deepest :: Int
deepest = 5

walk :: Int -> Task -> Pulses3 -> Segment -> [ArcStep]
walk left task begin s = case s of
  Straight _ _ -> straight
  Arc {sweep}
    | isFlat task s && goesStraight task s (flat begin : map (flat . stop) straight) -> straight
    | left <= 0 || not (holds task begin s) -> map alone (chorded task begin s)
    | otherwise ->
      case mapMaybe
        (truest task begin finish s (sense sweep))
        [centres task begin finish s, outer task begin finish s (sense sweep)] of
        found : _ -> found
        [] ->
          let (front, back) = Segment.cutAt 0.5 s
              middle = place task (Segment.end front)
           in walk (left - 1) task begin front <> walk (left - 1) task middle back
  where
    finish = place task (Segment.end s)
    alone p = ArcStep {stop = p, about = Nothing}
    straight =
      map
        alone
        ( Rounding.split
            (machine (grid task))
            begin
            ((Segment.start s, height task), (Segment.end s, height task))
        )
    sense (Rad a) = if a > 0 then CounterClockwise else Clockwise

place :: Task -> Point -> Pulses3
place task p = Rounding.rounded (machine (grid task)) (p, height task)

-- | Whether an arc deviates from its chord by less than half a pulse.
isFlat :: Task -> Segment -> Bool
isFlat task s = Segment.bulge s < Mm (0.5 * grain (grid task))

-- | Whether straight steps from a position to the next ones stay as near to an arc as they have to:
-- half a pulse of sagitta and the rounding of the ends add to more than a pulse.
goesStraight :: Task -> Segment -> [Pulses2] -> Bool
goesStraight task exact stops = case exact of
  Straight _ _ -> True
  Arc {start, centre}
    -- One way is no further from it than the arc from its chord and the chord's ends from those of
    -- the way.
    | [a, b] <- places,
      plus (Segment.bulge exact) (max (Vec.distance a start) (Vec.distance b (Segment.end exact)))
        <= most ->
      isWithinRoom
        (Distance.toPoint centre (Straight a b))
        (max (Vec.distance centre a) (Vec.distance centre b))
    -- An arc that is dropped has nothing beside it.
    | otherwise ->
      isWithinRoom
        (minimum (map (Distance.toPoint centre) ways))
        (maximum (map (Vec.distance centre) places))
        && all ((<= most) . left) [Segment.at (k / 8) exact | k <- [0 .. 8]]
    where
      isWithinRoom nearest furthest =
        let r =
              Segment.radius centre start
         in minus r nearest <= inwards (room task) && minus furthest r <= outwards (room task)
      left p = minimum (map (Distance.toPoint p) ways)
  where
    most = max (inwards (room task)) (outwards (room task))
    places = map (point task) stops
    ways = zipWith Straight places (drop 1 places)

-- | Whether the field of a centre holds the radius. A centre further away than its field holds
-- would fit in parts of the arc only.
holds :: Task -> Pulses3 -> Segment -> Bool
holds task (Pulses3 x y _) s = case s of
  Straight _ _ -> True
  Arc {start, centre} ->
    abs (i - x) < furthestCentre (grid task)
      && abs (j - y) < furthestCentre (grid task)
      && Pulses (ceiling (r / min (grainX (grid task)) (grainY (grid task))))
        < furthestCentre (grid task)
    where
      Pulses3 i j _ = place task centre
      Mm r = Segment.radius centre start

-- | The lattice points to try as centres.
centres :: Task -> Pulses3 -> Pulses3 -> Segment -> [Pulses2]
centres task begin finish s = case s of
  Straight _ _ -> []
  Arc {centre}
    | begin == finish -> around (middle centre)
    | otherwise ->
      let first =
            middle centre
       in around first <> filter (not . isBeside first) (around (middle (level centre)))
  where
    middle c = flat (place task c)
    around c = map (c +) offsets
    isBeside = isWithin neighbours
    a = point task (flat begin)
    b = point task (flat finish)
    -- Equally far from both ends.
    level c =
      let u =
            Vec.unit (Vec.to a b)
       in Vec.shift (Vec.scale (Vec.dot u (Vec.to c (Vec.between 0.5 a b))) u) c

-- | So many pulses about a place the centre is looked for.
neighbours :: Pulses
neighbours = 2

offsets :: [Pulses2]
offsets = square neighbours

-- | What is so many pulses from zero at most, in a column or a row.
square :: Pulses -> [Pulses2]
square most = [Pulses2 di dj | di <- [-most .. most], dj <- [-most .. most]]

-- | Whether two lattice points are no further apart, in a column or a row.
isWithin :: Pulses -> Pulses2 -> Pulses2 -> Bool
isWithin most (Pulses2 i j) (Pulses2 k l) = abs (i - k) <= most && abs (j - l) <= most

-- | The lattice points to try where none of those near the true centre does and the whole arc can
-- be one step: those about which its middle is near enough. About a centre that is off by n towards
-- the middle of an arc that turns by 2h, and by t across, the middle is off by @(1 − cos h)·n + sin
-- h·t@ and the end by @2·sin h·t@, besides the rounding of the beginning. So @(1 − cos h)·n@ is no
-- more than 3/2 of the room and that rounding.
outer :: Task -> Pulses3 -> Pulses3 -> Segment -> Sense -> [Pulses2]
outer task begin finish s turn = case s of
  Straight _ _ -> []
  Arc {centre, sweep = Rad a}
    | begin == finish -> []
    | otherwise ->
      let first = flat (place task centre)
          Mm most = roundly (room task)
          reach =
            ceiling
              ( min
                  1000
                  (1.5 * (most / grain (grid task) + sqrt 0.5) / (1 - cos (min pi (abs a / 2))))
              )
          offAbout = offInMiddle task s turn (flat begin) (flat finish)
       in [ c
            | c <- map (first +) (square (min remotest (Pulses reach))),
              not (isWithin neighbours first c),
              inOneStep task turn begin finish c,
              offAbout c <= most
          ]

-- | No centre is looked for further away, in pulses: an arc that turns so little that it could be
-- there lets so many beside one another do that one of them is near.
remotest :: Pulses
remotest = 8

-- | Whether the whole arc about a lattice point can be one step.
inOneStep :: Task -> Sense -> Pulses3 -> Pulses3 -> Pulses2 -> Bool
inOneStep task turn begin finish c = case Machine.arcs (machine (grid task)) of
  NoArcs -> False
  Arcs {Machine.quadrants} -> not quadrants || inQuadrant turn (flat begin - c) (flat finish - c)

-- | Steps that have been tried, and how far they deviate.
data Attempt = Attempt {way :: [ArcStep], off :: Double}

-- | The fewest steps; of several the truest.
best :: [Attempt] -> Maybe [ArcStep]
best attempts = case attempts of
  [] -> Nothing
  first : others ->
    Just (way (foldl (\x y -> if comparing cost y x == LT then y else x) first others))
  where
    cost a = (length (way a), off a)

-- | The best about any of some lattice points. Where the whole arc can be one step, each of them
-- has to be truer than the best so far, beginning with the one that seems least off; of two that
-- are as true the first one is taken.
truest :: Task -> Pulses3 -> Pulses3 -> Segment -> Sense -> [Pulses2] -> Maybe [ArcStep]
truest task begin finish s turn cs
  | Just ends <- endsOf task s (flat begin) (flat finish),
    Likeliest number c <- likeliest ends,
    Just found <- among ends (tried number c) =
    Just (way (result found))
  | otherwise = best (mapMaybe (attempt task begin finish s turn) cs)
  where
    wholes = filter (inOneStep task turn begin finish) cs
    tried number c = Tried number <$> attempt task begin finish s turn c
    likeliest ends = go 0 None (1 / 0) wholes
      where
        go !rank so !least todo = case todo of
          [] -> so
          c : more
            | d <- seemingOff ends c,
              d < least,
              d' <- max d (offAtBegin ends c),
              d' < least ->
              go (rank + 1) (Likeliest rank c) d' more
            | None <- so -> go (rank + 1) (Likeliest rank c) least more
            | otherwise -> go (rank + 1) so least more
    among ends = go 0 wholes
      where
        go !rank todo so = case todo of
          [] -> so
          c : more -> go (rank + 1) more (better ends so rank c)
    better ends so rank c = case so of
      Nothing -> tried rank c
      Just b
        | isTruer ends (number b) (off (result b)) rank c, Just a <- tried rank c -> Just a
        | otherwise -> so
    isTruer ends before most rank c =
      not isSurelyWorse && isLess (offAtBegin ends c) && isLess (offAt leg 1) && isTrueAll
      where
        isSurelyWorse = seemingOff ends c - unsureOff ends c > most
        isLess o = o < most || o == most && rank < before
        leg = legAbout ends turn c
        isTrueAll = case atEnds task leg of
          Just d -> isLess (evenly d)
          Nothing -> all (isLess . offAt leg) samples && isLess (evenly (deviationOf leg))

-- | Shares of a sweep between its ends, those first at which an arc is most likely to be off.
samples :: [Double]
samples = [4 / 8, 2 / 8, 6 / 8, 1 / 8, 7 / 8, 3 / 8, 5 / 8]

-- | The lattice point that seems least off so far, by its place among the others.
data Likeliest = None | Likeliest Int Pulses2

-- | What has been tried, and its place.
data Tried = Tried {number :: Int, result :: Attempt}

-- | An arc's rounded ends and its exact circle, in bare numbers: the ways of one pulse, both ends,
-- the centre, the radius; how far off the ends are; and by how much the directions from the centre
-- to its middle and to its end differ from that to its beginning.
data Ends = Ends
  { pulseX :: Double,
    pulseY :: Double,
    beginX :: Double,
    beginY :: Double,
    finishX :: Double,
    finishY :: Double,
    centreX :: Double,
    centreY :: Double,
    circle :: Double,
    firstOff :: Double,
    finalOff :: Double,
    halfX :: Double,
    halfY :: Double,
    wholeX :: Double,
    wholeY :: Double
  }

endsOf :: Task -> Segment -> Pulses2 -> Pulses2 -> Maybe Ends
endsOf task exact begin finish = case exact of
  Straight _ _ -> Nothing
  Arc {start, centre, sweep = Rad angle}
    | begin == finish -> Nothing
    | otherwise ->
      let a = point task begin
          b = point task finish
          from = Vec.unit (Vec.to centre a)
          half = Vec.add (Vec.rotate (Rad (angle / 2)) from) (Vec.negate from)
          whole = Vec.add (Vec.unit (Vec.to centre b)) (Vec.negate from)
          Mm circle = Segment.radius centre start
          Mm far = Vec.distance centre a
          Mm far' = Vec.distance centre b
       in Just
            Ends
              { pulseX = grainX (grid task),
                pulseY = grainY (grid task),
                beginX = Vec.x a,
                beginY = Vec.y a,
                finishX = Vec.x b,
                finishY = Vec.y b,
                centreX = Vec.x centre,
                centreY = Vec.y centre,
                circle,
                firstOff = far - circle,
                finalOff = far' - circle,
                halfX = Vec.dot (Vec.vec 1 0) half,
                halfY = Vec.dot (Vec.vec 0 1) half,
                wholeX = Vec.dot (Vec.vec 1 0) whole,
                wholeY = Vec.dot (Vec.vec 0 1) whole
              }

-- | About how far off an arc about a lattice point is at its middle or its end with the radius of
-- its beginning, or at its middle going evenly, in mm. About a centre that is off by a vector v it
-- is off by @o + v·(u − u₀)@ where the true radius has the direction u, if it is off by o at its
-- beginning, where that has the direction u₀; what is left out goes with the square of v.
seemingOff :: Ends -> Pulses2 -> Double
seemingOff
  Ends {pulseX, pulseY, centreX, centreY, firstOff, finalOff, halfX, halfY, wholeX, wholeY}
  (Pulses2 (Pulses i) (Pulses j)) =
    larger even' (larger (abs half) (abs whole))
    where
      x = fromIntegral i * pulseX - centreX
      y = fromIntegral j * pulseY - centreY
      half = firstOff + x * halfX + y * halfY
      whole = firstOff + x * wholeX + y * wholeY
      -- Its end is off by what that itself is off; half of the difference is made up for in the
      -- middle.
      even' = abs (half + 0.5 * (finalOff - whole))
      larger a b = if a > b then a else b
{-# INLINE seemingOff #-}

-- | By how much less an arc about a lattice point may be off than it seems, in mm.
unsureOff :: Ends -> Pulses2 -> Double
unsureOff Ends {pulseX, pulseY, centreX, centreY, circle} (Pulses2 (Pulses i) (Pulses j)) =
  (if 8 * far < circle then 4 else 16) * far * far / circle + rounding'
  where
    far =
      abs (fromIntegral i * pulseX - centreX)
        + abs (fromIntegral j * pulseY - centreY)
        + pulseX
        + pulseY
{-# INLINE unsureOff #-}

-- | What the rounding of doubles adds at most, in mm.
rounding' :: Double
rounding' = 1e-9

-- | How far off the beginning of an arc about a lattice point is, as 'offAt' has it.
offAtBegin :: Ends -> Pulses2 -> Double
offAtBegin
  Ends {pulseX, pulseY, beginX, beginY, centreX, centreY, circle}
  (Pulses2 (Pulses i) (Pulses j)) =
    abs (sqrt (x * x + y * y) - circle)
    where
      mx = fromIntegral i * pulseX
      my = fromIntegral j * pulseY
      x = mx + (beginX - mx) - centreX
      y = my + (beginY - my) - centreY
{-# INLINE offAtBegin #-}

-- | The whole arc about a lattice point, as 'legOf' has it.
legAbout :: Ends -> Sense -> Pulses2 -> Leg
legAbout
  Ends {pulseX, pulseY, beginX, beginY, finishX, finishY, centreX, centreY, circle}
  turn
  (Pulses2 (Pulses i) (Pulses j)) =
    Leg
      { middleX,
        middleY,
        outX,
        outY,
        radiusFirst = sqrt (outX * outX + outY * outY),
        radiusLast = sqrt (inX * inX + inY * inY),
        turned,
        trueX = centreX,
        trueY = centreY,
        trueRadius = circle
      }
    where
      middleX = fromIntegral i * pulseX
      middleY = fromIntegral j * pulseY
      outX = beginX - middleX
      outY = beginY - middleY
      inX = finishX - middleX
      inY = finishY - middleY
      short = atan2 (outX * inY - outY * inX) (outX * inX + outY * inY)
      turned = case turn of
        CounterClockwise | short < 0 -> short + 2 * pi
        Clockwise | short > 0 -> short - 2 * pi
        _ -> short
{-# INLINE legAbout #-}

-- | How far off the middle of an arc about a lattice point is, as 'offAt' has it but without an
-- angle: the middle lies square to the chord between the directions of the ends. The ends come
-- first: many points are tried between the same ones.
offInMiddle :: Task -> Segment -> Sense -> Pulses2 -> Pulses2 -> Pulses2 -> Double
offInMiddle task exact turn begin finish = case exact of
  Straight _ _ -> const 0
  Arc {start, centre} ->
    let a = point task begin
        b = point task finish
        Mm r = Segment.radius centre start
     in \c ->
          let m = point task c
              toA = Vec.to m a
              toB = Vec.to m b
              first = Vec.norm toA
              final = Vec.norm toB
              chord = Vec.unit (Vec.add (Vec.scale (-1 / first) toA) (Vec.scale (1 / final) toB))
              outwards' = Vec.scale (-(Carrier.sense turn)) (Vec.left chord)
              off' radius =
                let Mm far =
                      Vec.distance centre (Vec.shift (Vec.scale radius outwards') m)
                 in abs (far - r)
           in max (off' first) (off' ((first + final) / 2))

-- | The arc about a lattice point, if the machine can walk it and it is true enough.
attempt :: Task -> Pulses3 -> Pulses3 -> Segment -> Sense -> Pulses2 -> Maybe Attempt
attempt task begin finish s turn c = case s of
  Straight _ _ -> Nothing
  Arc {start, centre, sweep = Rad exact}
    | null stops
        || ( begin == finish
               && length stops == 1
               && not (wholes && abs exact >= 2 * pi - Tolerance.equal)
           ) ->
      Nothing
    | all sound legs
        && and (zipWith near walks deviations)
        && abs (sum (map (swept . arcAlong) walks) - exact) <= slack ->
      Just (Attempt (map step walks) deviation)
    | otherwise -> Nothing
    where
      stops =
        stopsAbout
          (machine (grid task))
          (onAxes task (Segment.radius centre start) centre c)
          turn
          c
          (flat begin)
          (flat finish)
      legs = zip (flat begin : stops) stops
      walks = map walked legs
      deviations = map (deviate task s . arcAlong) walks
      deviation = maximum (map evenly deviations)
      near leg d =
        isStraight leg
          || Mm (evenly d) <= roundly (room task)
            && Mm (innermost d) <= inwards (room task)
            && Mm (outermost d) <= outwards (room task)
      Mm r = Segment.radius centre start
      -- An end moves by a pulse at most, and so does the centre beside it.
      slack = min (pi / 2) (4 * grain (grid task) / r)
  where
    wholes = case Machine.arcs (machine (grid task)) of
      NoArcs -> False
      Arcs {Machine.fullCircle} -> fullCircle
    Pulses3 _ _ z = finish
    -- A piece that a cut left nearly straight is straight.
    walked leg@(from, to) =
      let arcAlong =
            arcOf task turn c leg
       in Walked
            { from,
              to,
              arcAlong,
              isStraight = isFlat task arcAlong && goesStraight task s [from, to]
            }
    step Walked {from, to = Pulses2 x y, isStraight}
      | isStraight = ArcStep {stop = Pulses3 x y z, about = Nothing}
      | otherwise = ArcStep {stop = Pulses3 x y z, about = Just (turn, c - from)}
    sound leg@(from, to) =
      from /= c
        && to /= c
        && (let Pulses2 i j = abs (c - from) in max i j <= furthestCentre (grid task))
        && within (to - from)
        && level leg
    within (Pulses2 dx dy) = case Machine.measure (Machine.layout (machine (grid task))) of
      Machine.Positions -> True
      Machine.Increments ->
        abs dx <= Machine.capacity (machine (grid task)) X
          && abs dy <= Machine.capacity (machine (grid task)) Y
    -- The radii at the ends of a frame differ by no more than two pulses.
    level (from, to) =
      let Mm a =
            Vec.distance (point task c) (point task from)
          Mm b = Vec.distance (point task c) (point task to)
       in abs (a - b) <= 2 * grain (grid task)

-- | A step between two stops, and whether its arc is so flat that it goes straight.
data Walked = Walked {from :: Pulses2, to :: Pulses2, arcAlong :: Segment, isStraight :: Bool}

-- | Where the axes through a lattice point near the centre of a circle cross it, in pulses from
-- there: to the right, to the left, upwards, downwards.
data Crossings = Crossings {rightwards :: Pulses, leftwards :: Pulses, up :: Pulses, down :: Pulses}

onAxes :: Task -> Mm -> Point -> Pulses2 -> Crossings
onAxes task (Mm r) true c =
  Crossings
    { rightwards = crossing X 1 dx dy,
      leftwards = -(crossing X (-1) dx dy),
      up = crossing Y 1 dy dx,
      down = -(crossing Y (-1) dy dx)
    }
  where
    off = Vec.to true (point task c)
    dx = Vec.dot (Vec.vec 1 0) off
    dy = Vec.dot (Vec.vec 0 1) off
    crossing axis sign along across =
      let Mm p = Machine.pulseOf (machine (grid task)) axis
       in Pulses (max 1 (round ((sqrt (max 0 (r * r - across * across)) - sign * along) / p)))

-- | Where the frames of an arc end, given its centre: at its end, and before that, for a control
-- that asks it, wherever the arc crosses the axes through the centre. None if it cannot be in one
-- turn.
stopsAbout :: Machine -> Crossings -> Sense -> Pulses2 -> Pulses2 -> Pulses2 -> [Pulses2]
stopsAbout machine crossings turn c begin finish = case Machine.arcs machine of
  NoArcs -> []
  Arcs {Machine.quadrants}
    | quadrants -> map (c +) (toAxes (5 :: Int) (begin - c))
    | otherwise -> [finish]
  where
    goal = finish - c
    toAxes left from
      | inQuadrant turn from goal = [goal]
      | left <= 0 || from == 0 || goal == 0 = []
      | otherwise = let next = nextAxis turn crossings from in next : toAxes (left - 1) next

-- | Whether an arc about zero goes from one place to another within a quadrant.
inQuadrant :: Sense -> Pulses2 -> Pulses2 -> Bool
inQuadrant turn (Pulses2 a b) (Pulses2 c d) =
  a * c >= 0 && b * d >= 0 && Carrier.sense turn * fromIntegral (a * d - b * c) > 0

-- | The next place on an axis on the way about zero.
nextAxis :: Sense -> Crossings -> Pulses2 -> Pulses2
nextAxis turn at (Pulses2 x y) = case turn of
  CounterClockwise
    | x > 0 && y >= 0 -> Pulses2 0 (up at)
    | x <= 0 && y > 0 -> Pulses2 (leftwards at) 0
    | x < 0 -> Pulses2 0 (down at)
    | otherwise -> Pulses2 (rightwards at) 0
  Clockwise
    | x > 0 && y <= 0 -> Pulses2 0 (down at)
    | x <= 0 && y < 0 -> Pulses2 (leftwards at) 0
    | x < 0 -> Pulses2 0 (up at)
    | otherwise -> Pulses2 (rightwards at) 0

-- What is walked ----------------------------------------------------------------------------------

-- | A lattice point in mm.
point :: Task -> Pulses2 -> Point
point task (Pulses2 (Pulses x) (Pulses y)) =
  Vec.point (fromIntegral x * grainX (grid task)) (fromIntegral y * grainY (grid task))

-- | One frame's arc about a centre; a full circle where it ends where it begins.
arcOf :: Task -> Sense -> Pulses2 -> (Pulses2, Pulses2) -> Segment
arcOf task turn c (from, to)
  | from == to =
    Segment.Arc {start = a, end = a, centre = m, sweep = Rad (Carrier.sense turn * 2 * pi)}
  | otherwise = Segment.arc turn m a (point task to)
  where
    m = point task c
    a = point task from

swept :: Segment -> Double
swept s = case s of
  Straight _ _ -> 0
  Arc {sweep = Rad a} -> a

-- | How far a frame's arc leaves the exact circle, in mm.
data Deviation = Deviation
  { -- | with the radius of its beginning all the way, or going evenly to that of its end
    evenly :: Double,
    -- | towards the centre at most, however the control goes from one radius to the other
    innermost :: Double,
    -- | and away from it
    outermost :: Double
  }

-- | It is looked at in eighths, and where it is furthest from and nearest to the exact centre.
deviate :: Task -> Segment -> Segment -> Deviation
deviate task exact s =
  maybe (Deviation 0 0 0) (\leg -> fromMaybe (deviationOf leg) (atEnds task leg)) (legOf exact s)

-- | How far off it is at its ends, if it is not further off between them with the radius of its
-- beginning or going evenly, and stays within what is allowed however the control goes. Between its
-- ends it is as far off as they are by their shares, but for
-- @φ²·v/8@ where its centre is off by v and it turns by φ; half as much again is for what goes with
--  the square of v.
atEnds :: Task -> Leg -> Maybe Deviation
atEnds task leg
  | abs (turned leg) < 1
      && off' < radiusFirst leg / 8
      && crossing 0 * crossing 1 > 0
      && abs (evenly a - evenly b) > 8 * more
      && max (innermost d) (outermost d) + more < narrower =
    Just d
  | otherwise = Nothing
  where
    a = offsAt leg 0
    b = offsAt leg 1
    d = further a b
    asideX = middleX leg - trueX leg
    asideY = middleY leg - trueY leg
    off' = abs asideX + abs asideY
    more = turned leg * turned leg * off' / 4 + rounding'
    Mm narrower = min (inwards (room task)) (outwards (room task))
    -- Where it is furthest from the exact centre or nearest to it, the radius is parallel to what
    -- its centre is off by.
    crossing t =
      let (c, s) =
            (cos (t * turned leg), sin (t * turned leg))
       in (c * outX leg - s * outY leg) * asideY - (c * outY leg + s * outX leg) * asideX

deviationOf :: Leg -> Deviation
deviationOf leg =
  foldl'
    (\d t -> further d (offsAt leg t))
    (foldl' (\d t -> further d (offsAt leg t)) (offsAt leg 0) eighths)
    extremes
  where
    out = Vec.vec (outX leg) (outY leg)
    aside = Vec.vec (middleX leg - trueX leg) (middleY leg - trueY leg)
    Rad toward = Vec.turn out aside
    share angle =
      let t = angle * signum (turned leg) in (if t < 0 then t + 2 * pi else t) / abs (turned leg)
    extremes =
      if Vec.norm aside > 0
        then filter (< 1) [share toward, share (if toward > 0 then toward - pi else toward + pi)]
        else []

further :: Deviation -> Deviation -> Deviation
further (Deviation a b d) (Deviation a' b' d') = Deviation (max a a') (max b b') (max d d')

eighths :: [Double]
eighths = [k / 8 | k <- [1 .. 8]]

-- | A frame's arc beside an exact one, in bare numbers: its centre, where it begins from there, its
-- radii at both ends, how far it turns in radians; the exact centre and radius.
data Leg = Leg
  { middleX :: Double,
    middleY :: Double,
    outX :: Double,
    outY :: Double,
    radiusFirst :: Double,
    radiusLast :: Double,
    turned :: Double,
    trueX :: Double,
    trueY :: Double,
    trueRadius :: Double
  }

legOf :: Segment -> Segment -> Maybe Leg
legOf exact walked = case (exact, walked) of
  (Arc {start = p, centre = true}, Arc {start = a, end = b, centre = m, sweep = Rad turned}) ->
    let Mm trueRadius = Segment.radius true p
        Mm radiusFirst = Vec.distance m a
        Mm radiusLast = Vec.distance m b
     in Just
          Leg
            { middleX = Vec.x m,
              middleY = Vec.y m,
              outX = Vec.x a - Vec.x m,
              outY = Vec.y a - Vec.y m,
              radiusFirst,
              radiusLast,
              turned,
              trueX = Vec.x true,
              trueY = Vec.y true,
              trueRadius
            }
  _ -> Nothing

-- | How far it is off at a share of its sweep.
offsAt :: Leg -> Double -> Deviation
offsAt leg t =
  Deviation
    { evenly = max (abs first) (abs even'),
      innermost = -(min first final),
      outermost = max first final
    }
  where
    first = beyond leg t (radiusFirst leg)
    even' = beyond leg t (radiusFirst leg + t * (radiusLast leg - radiusFirst leg))
    final = beyond leg t (radiusLast leg)

-- | The same as far as the control goes evenly.
offAt :: Leg -> Double -> Double
offAt leg t =
  max
    (abs (beyond leg t (radiusFirst leg)))
    (abs (beyond leg t (radiusFirst leg + t * (radiusLast leg - radiusFirst leg))))
{-# INLINE offAt #-}

-- | How far beyond the exact circle the place at a share of its sweep is, on a radius.
beyond :: Leg -> Double -> Double -> Double
beyond Leg {middleX, middleY, outX, outY, radiusFirst, turned, trueX, trueY, trueRadius} t radius =
  sqrt (dx * dx + dy * dy) - trueRadius
  where
    (along, across) = (cos (t * turned), sin (t * turned))
    (vx, vy) = (radius / radiusFirst * outX, radius / radiusFirst * outY)
    dx = middleX + (along * vx + across * negate vy) - trueX
    dy = middleY + (along * vy + across * vx) - trueY
{-# INLINE beyond #-}
