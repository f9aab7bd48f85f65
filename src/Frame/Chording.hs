-- | Longest chords along a run of moves. A run is a curve without corners that consists of several
-- lines and arcs. Each chord begins where the one before ends, and reaches as far along the run as
-- the bounds allow, across any number of arcs.
--
-- The method is known from polyline simplification as cone intersection (Sklansky and Gonzalez,
-- 1980). The start of a chord is called its viewpoint. A chord has to pass every point of its part
-- of the run within the bounds, so each of these points leaves a sector of directions. The chord
-- can be lengthened as long as the intersection of these sectors is not empty. An arc narrows the
-- intersection by the sector of its end, and by the sector of the point at which its tangent is
-- parallel to an edge of this sector. No points are sampled.
--
-- If the bounds on the two sides differ, chords may also meet beside the run, in the middle between
-- the bounds, where that gives fewer chords. The first and the last end always lie on the run.
--
-- A position on a move is a fraction of the move's length, from 0 to 1. All lengths and heights are
-- in mm, all angles in radians.
module Frame.Chording
  ( Bounds (..),
    chordEnds,
  )
where

import Base.Quantity (Mm (..), Rad (..), times)
import Data.List (minimumBy, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Data.Tuple (swap)
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Toolpath.Toolpath (Move)
import Toolpath.Toolpath qualified as Toolpath

-- | Largest distances in mm of a run from its chords.
data Bounds = Bounds
  { -- | distance of points of the run that lie to the left of the chord
    left :: Mm,
    -- | distance of points of the run that lie to the right of the chord
    right :: Mm,
    -- | difference of heights between the run and the chord at the same share of their lengths
    rise :: Mm,
    -- | length in mm along the run that every chord may have; a chord of this length may exceed the
    -- other bounds
    shortest :: Mm
  }
  deriving stock (Eq, Show)

-- | Ends of the chords of a run in mm, with their heights. The last one is the end of the run. If
-- there are more than @limit@ chords, the list is incomplete but has at least @limit@ entries.
chordEnds :: Int -> Bounds -> NonEmpty Move -> [(Point, Mm)]
chordEnds limit bounds run =
  map
    (\p -> (point p, Mm (level p)))
    (maybe [final] (\moves -> ends limit bounds moves final) (NonEmpty.nonEmpty (map rest long)))
  where
    long = NonEmpty.filter (\m -> Segment.length (Toolpath.segment m) > Mm 0) run
    rest m = let (Mm a, Mm b) = Toolpath.heights m in MoveRest (Toolpath.segment m) 0 (a, b)
    final =
      let m = NonEmpty.last run
          Mm z = snd (Toolpath.heights m)
       in RunPoint (Segment.end (Toolpath.segment m)) z []

-- | Part of a move from a fraction of its length to its end.
data MoveRest = MoveRest
  { -- | the whole segment of the move
    segment :: Segment,
    -- | the fraction of the segment's length at which the part begins
    from :: Double,
    -- | heights in mm at both ends of the whole move
    heights :: (Double, Double)
  }

-- | End of a chord: the point, its height in mm, and the part of the run after it.
data RunPoint = RunPoint {point :: Point, level :: Double, rest :: [MoveRest]}

-- Choice of the chords ----------------------------------------------------------------------------

-- | Ends of the chords of a run whose end is @final@. The numbers of chords are compared only up to
-- @limit@.
--
-- Two kinds of plans, that is, divisions into chords, are compared. A quick plan looks for the end
-- of a chord mostly at the ends of moves ('AtEnds'); a thorough plan looks at all points
-- ('Anywhere'). The thorough plans take longer, and can save a chord only on a run that bends to
-- both sides. They are tried only if the quick plan has at most 'fewChords' chords.
ends :: Int -> Bounds -> NonEmpty MoveRest -> RunPoint -> [RunPoint]
ends limit bounds run final =
  if count > limit then widest chosen else kept <> equalised chosen kept others
  where
    chosen
      | n <- counted quick,
        n > 2,
        n <= min fewChords limit,
        bendsBothWays run,
        counted thorough < n =
        thorough
      | otherwise = quick
    quick = fewest (plans AtEnds bounds run id)
    thorough =
      fewest
        (plans Anywhere bounds run id <> plans Anywhere (mirrored bounds) (reversed run) back)
    back points = drop 1 (reverse points) <> [final]
    fewest = minimumBy (comparing counted)
    counted = length . take (limit + 1) . widest
    count = counted chosen
    (kept, others) = splitAt (count - mostEqualised) (widest chosen)

-- | Largest number of chords for which the thorough plans are tried.
fewChords :: Int
fewChords = 16

-- | Largest number of chords that are made equally long. If a run has more chords, only this many
-- chords at its end are made equally long.
mostEqualised :: Int
mostEqualised = 256

-- | Number of bisections by which 'equalised' finds the tightest limits (see 'limitsOf').
bisections :: Int
bisections = 5

-- | Ends of chords of nearly equal length in place of @others@, the ends of the last chords of a
-- plan. The ends of the chords before them are @kept@. Greedy chords are as long as the bounds
-- allow, so the last one is a short remainder. Bisection finds the tightest limits that need no
-- more chords. Under these limits the last chord is about as long as the others.
equalised :: ChordPlan -> [RunPoint] -> [RunPoint] -> [RunPoint]
equalised plan kept others = go bisections (1 - 1 / fromIntegral (length others)) 1 others
  where
    go :: Int -> Double -> Double -> [RunPoint] -> [RunPoint]
    go tries low high best
      | tries <= 0 || null (drop 1 others) = best
      | null (drop (length others) tighter) = go (tries - 1) low middle tighter
      | otherwise = go (tries - 1) middle high best
      where
        middle = (low + high) / 2
        tighter = chordsFrom plan middle (NonEmpty.last (begin plan :| kept))

-- | True for a run with arcs of both senses. On any other run, making every chord as long as
-- possible gives the fewest chords.
bendsBothWays :: NonEmpty MoveRest -> Bool
bendsBothWays run = any (> 0) sweeps && any (< 0) sweeps
  where
    sweeps = [s | MoveRest {segment = Arc {sweep = Rad s}} <- NonEmpty.toList run]

-- | A division of a run into chords.
data ChordPlan = ChordPlan
  { -- | the start of the run
    begin :: RunPoint,
    -- | ends of the chords under the full bounds
    widest :: [RunPoint],
    -- | ends of the chords from a point to the end of the run. The limits have the given tightness
    -- from 0 to 1 (see 'limitsOf')
    chordsFrom :: Double -> RunPoint -> [RunPoint]
  }

-- | Plans for a run: one with all ends on the run and, if the bounds differ, one with ends beside
-- it. @restore@ converts the ends of chords on a reversed run into those of the original run.
plans :: EndSearch -> Bounds -> NonEmpty MoveRest -> ([RunPoint] -> [RunPoint]) -> [ChordPlan]
plans search bounds run restore =
  [ ChordPlan {begin, widest = chordsFrom 1 begin, chordsFrom}
    | chordsFrom <- onRun : [besideRun | left bounds /= right bounds]
  ]
  where
    begin =
      let first = NonEmpty.head run
       in RunPoint
            { point = Segment.at 0 (segment first),
              level = levelAt 0 first,
              rest = NonEmpty.toList run
            }
    besideRun tightness p = restore (chords (limits tightness) p)
    onRun tightness p = restore (chords (limits tightness) {aside = 0} p)
    limits tightness = (limitsOf bounds tightness) {search}

-- | Bounds of the reversed run.
mirrored :: Bounds -> Bounds
mirrored bounds = bounds {left = right bounds, right = left bounds}

-- | The run in the opposite direction. All its moves are whole.
reversed :: NonEmpty MoveRest -> NonEmpty MoveRest
reversed run =
  NonEmpty.reverse (fmap (\m -> MoveRest (Segment.reverse (segment m)) 0 (swap (heights m))) run)

-- Limits ------------------------------------------------------------------------------------------

-- | Part of a move in which the end of a chord is looked for.
data EndSearch
  = -- | the end of the move; or a point within the move, if the chord can reach the start of the
    -- move
    AtEnds
  | -- | all points of the move, even if the chord can reach neither its start nor its end
    Anywhere
  deriving stock (Eq)

-- | Limits of one chord, derived from the 'Bounds' of the run by 'limitsOf'.
data Limits = Limits
  { -- | largest distance of the run to the left of a chord
    leftOf :: Double,
    -- | largest distance of the run to the right of a chord
    rightOf :: Double,
    -- | distance from the run to the points where chords meet, positive to the right
    aside :: Double,
    -- | largest difference of heights between the run and a chord
    rising :: Double,
    -- | angle in radians by which the run may turn within one chord
    turning :: Double,
    -- | length in mm along the run that every chord may have, whatever the other limits are
    least :: Double,
    search :: EndSearch
  }

-- | Limits for a @tightness@ from 0 to 1. A smaller @tightness@ gives tighter limits; 1 gives the
-- full bounds. The largest angle of an arc that a chord may span grows with the root of the allowed
-- sagitta. Therefore the bounds are multiplied by @tightness²@, so that this angle is multiplied by
-- @tightness@.
limitsOf :: Bounds -> Double -> Limits
limitsOf bounds tightness =
  Limits
    { leftOf = share (left bounds),
      rightOf = share (right bounds),
      aside = (share (left bounds) - share (right bounds)) / 2,
      rising = share (rise bounds),
      turning = tightness * pi / 2,
      least,
      search = AtEnds
    }
  where
    Mm least = shortest bounds
    -- A point within 'Tolerance.coincident' of the chord counts as lying on the chord.
    share d = let Mm y = max Tolerance.coincident (times (tightness * tightness) d) in y

-- Points of the run -------------------------------------------------------------------------------

-- | Ends of the longest chords from the point @p@ to the end of the run.
chords :: Limits -> RunPoint -> [RunPoint]
chords limits p
  | null (rest p) = []
  | otherwise = let next = furthest limits p in next : chords limits next

-- | End of a chord at the fraction @t@ of @move@, which is the first move of @run@.
pointOn :: Limits -> MoveRest -> Double -> [MoveRest] -> RunPoint
pointOn limits move t run =
  RunPoint
    { point = meeting limits move t (Segment.at t (segment move)) run,
      level = levelAt t move,
      rest = if t >= 1 then drop 1 run else move {from = t} : drop 1 run
    }

-- | Point where two chords meet near the fraction @t@ of @move@, the first move of @run@. @on@ is
-- the point of the run at this fraction. The result lies to the right of @on@ by the distance that
-- the field 'aside' gives in mm; at the end of the run it is the run's end.
meeting :: Limits -> MoveRest -> Double -> Point -> [MoveRest] -> Point
meeting limits move t on run
  | t >= 1 && null (drop 1 run) || aside limits == 0 = on
  | otherwise =
    Vec.shift (Vec.scale (-(aside limits)) (Vec.left (Segment.directionAt t (segment move)))) on

-- | Height in mm at the fraction @t@ of a move.
levelAt :: Double -> MoveRest -> Double
levelAt t move = let (a, b) = heights move in if t >= 1 then b else a + t * (b - a)

-- | Length in mm between the fractions @a@ and @b@ of a move.
lengthBetween :: Double -> Double -> MoveRest -> Double
lengthBetween a b move = let Mm l = Segment.length (segment move) in l * (b - a)

-- | The point @distance@ mm along the run after the point @p@, or the end of the run.
advanced :: Limits -> Double -> RunPoint -> RunPoint
advanced limits distance p = case rest p of
  [] -> p
  move : _
    | distance >= l -> advanced limits (distance - l) (pointOn limits move 1 (rest p))
    | otherwise -> pointOn limits move (from move + (1 - from move) * distance / l) (rest p)
    where
      l = lengthBetween (from move) 1 move

-- The sector of directions ------------------------------------------------------------------------

-- | Start of a chord: the point, its height in mm, and the direction of the run there.
data Viewpoint = Viewpoint {eye :: Point, eyeLevel :: Double, forward :: Vec}

-- | Directions in which a chord from a viewpoint passes the run within the limits, up to some point
-- of the run. Directions are angles in radians from 'forward', counter-clockwise.
data Sector = Sector
  { -- | the least and the largest direction of the sector
    leastDirection :: Double,
    mostDirection :: Double,
    -- | the least and the largest slope of a chord, in mm per mm along the run, that keeps the
    -- heights within the limits
    leastSlope :: Double,
    mostSlope :: Double,
    -- | direction of the run at this point, and the least and the largest direction that the run
    -- has between the viewpoint and this point
    heading :: Double,
    leastHeading :: Double,
    mostHeading :: Double,
    -- | length in mm of the run from the viewpoint to this point
    travelled :: Double,
    -- | side on which a chord that ends at this point is outside of the sector
    miss :: Miss,
    -- | angle or slope by which a chord that ends at this point is outside of the sector; at most 0
    -- for a chord within the limits
    excess :: Double
  }

-- | Position of a chord relative to the sector, first by direction and then by slope: 'LT' is
-- below, 'EQ' within, 'GT' above.
data Miss = Miss Ordering Ordering
  deriving stock (Eq)

-- | True if a chord that ends at the point of the sector stays within the limits.
isReachable :: Sector -> Bool
isReachable sector = excess sector <= 0

-- | True for a sector that contains no direction or no slope, so that no chord can be longer.
isClosed :: Sector -> Bool
isClosed sector =
  leastDirection sector > mostDirection sector || leastSlope sector > mostSlope sector

-- | Sector at the viewpoint itself, which contains all directions and slopes.
unrestricted :: Sector
unrestricted =
  Sector
    { leastDirection = -pi,
      mostDirection = pi,
      leastSlope = -1 / 0,
      mostSlope = 1 / 0,
      heading = 0,
      leastHeading = 0,
      mostHeading = 0,
      travelled = 0,
      miss = Miss EQ EQ,
      excess = -1
    }

-- | End of the longest chord from the point @p@ within the limits. If this chord is shorter than
-- 'least', the result is the point of the run at the length 'least' after @p@.
furthest :: Limits -> RunPoint -> RunPoint
furthest limits p = case rest p of
  [] -> p
  first : _ ->
    let forward = Segment.directionAt (from first) (segment first)
        view = Viewpoint {eye = point p, eyeLevel = level p, forward}
     in case furthestReachable limits view Nothing unrestricted (rest p) of
          Just (l, end) | l >= least limits -> end
          _ -> advanced limits (least limits) p

-- | Last point of @run@ that a chord from the viewpoint can reach, with the length in mm of the run
-- from the viewpoint to this point. @best@ is the last such point found so far, and @before@ the
-- sector at the start of @run@. A chord to one point may exceed the limits although a chord to a
-- later point keeps them. Therefore the search ends only when the sector is closed or the run has
-- turned too far.
furthestReachable ::
  Limits ->
  Viewpoint ->
  Maybe (Double, RunPoint) ->
  Sector ->
  [MoveRest] ->
  Maybe (Double, RunPoint)
furthestReachable limits view best before run = case run of
  [] -> best
  move : more
    | isClosed after || t < 1 -> better
    | otherwise -> furthestReachable limits view better after more
    where
      t = turnLimit limits before move
      outlook =
        Outlook {limits, view, before, move, run, tangents = tangentsTo limits view move}
      after = sectorAt outlook t
      better = maybe best found (lastReachable outlook (t, after))
      found u =
        Just (travelled before + lengthBetween (from move) u move, pointOn limits move u run)

-- | A move in which a chord from a viewpoint may end, with all that the search for this end needs.
data Outlook = Outlook
  { limits :: Limits,
    view :: Viewpoint,
    -- | the sector at the beginning of the move
    before :: Sector,
    move :: MoveRest,
    -- | the run that begins with the move
    run :: [MoveRest],
    -- | the 'Tangents' of the move
    tangents :: Tangents
  }

-- | Last fraction of a move that a chord can reach; Nothing if it can reach none. @t@ is the last
-- fraction to be tried, and @after@ the sector there.
lastReachable :: Outlook -> (Double, Sector) -> Maybe Double
lastReachable outlook@Outlook {limits, view, before, move} (t, after) = case search limits of
  AtEnds
    | isReachable after -> Just t
    | isReachable before,
      u <- lastWithin (excess . sectorAt outlook) (from move, excess before) (t, excess after),
      u > from move ->
      Just u
    | otherwise -> Nothing
  Anywhere ->
    lastBetween
      (sectorAt outlook)
      ( (t, after) :
        [(u, sectorAt outlook u) | u <- turningPoints limits view move t]
          <> [(from move, before)]
      )

-- | Last fraction of a move that a chord can reach; Nothing if it can reach none. @marks@ has
-- fractions with their sectors, in descending order. Between two neighbouring fractions the
-- direction of the chord changes monotonically. The lowest fraction itself is not a result.
lastBetween :: (Double -> Sector) -> [(Double, Sector)] -> Maybe Double
lastBetween sectorOf marks = case marks of
  (high, atHigh) : earlier@((low, atLow) : _)
    | isReachable atHigh -> Just high
    | u : _ <- filter (\u -> u > low && isReachable (sectorOf u)) crossings -> Just u
    | otherwise -> lastBetween sectorOf earlier
    where
      crossings =
        [ bisected (\u -> miss (sectorOf u) /= miss atHigh) low high
          | miss atLow /= miss atHigh
        ]
          <> [ lastWithin (excess . sectorOf) (low, excess atLow) (high, excess atHigh)
               | isReachable atLow
             ]
  _ -> Nothing

-- | Bisection: the last number for which @holds@ is True. The two numbers are the ends of the
-- interval: @holds@ is True at the first one and False at the second one.
bisected :: (Double -> Bool) -> Double -> Double -> Double
bisected holds = go (40 :: Int)
  where
    go tries low high
      | tries <= 0 = low
      | holds middle = go (tries - 1) middle high
      | otherwise = go (tries - 1) low middle
      where
        middle = (low + high) / 2

-- | Last number at which a function is at most 0, by the Illinois variant of regula falsi. The two
-- pairs are the ends of the interval with the function's values: at most 0 at the first end, more
-- than 0 at the second. The Illinois rule halves the value at an end that is kept twice. Every
-- fourth step is a bisection, so the interval always shrinks.
lastWithin :: (Double -> Double) -> (Double, Double) -> (Double, Double) -> Double
lastWithin function (first, atFirst) (final, atFinal) =
  go (160 :: Int) EQ first atFirst final atFinal
  where
    finest = (final - first) / 2 ^ (40 :: Int)
    go tries moved low a high b
      | tries <= 0 || high - low <= finest || next <= low || next >= high = low
      | e <= 0 = go (tries - 1) LT next e high (if moved == LT then b / 2 else b)
      | otherwise = go (tries - 1) GT low (if moved == GT then a / 2 else a) next e
      where
        e = function next
        next =
          if tries `mod` 4 /= 0 && secant > low && secant < high
            then secant
            else (low + high) / 2
        secant = low + (high - low) * (a / (a - b))

-- | Fractions of a move below @t@, in descending order, at which the chord from the viewpoint stops
-- turning one way and begins to turn the other way. The chord to a fraction ends at its point of
-- 'meeting'. Along an arc these points form a circle, to which the chord is tangent at the
-- fractions of the result.
turningPoints :: Limits -> Viewpoint -> MoveRest -> Double -> [Double]
turningPoints limits view move t = case segment move of
  Straight _ _ -> []
  Arc {start, centre, sweep = Rad s} ->
    let Mm r = Segment.radius centre start
        away = Vec.to centre (eye view)
        -- Along an arc, chords meet on a concentric circle.
        ratio = (r + signum s * aside limits) / Vec.norm away
        fractions =
          [ u
            | abs ratio < 1,
              a <- [acos ratio, -(acos ratio)],
              let u = Segment.fraction (segment move) (Vec.shift (Vec.rotate (Rad a) away) centre),
              u > from move,
              u < t
          ]
     in sortOn negate fractions

-- | Fraction of a move at which the run has turned by the largest angle that one chord may span; 1
-- if the run does not turn so far. @before@ is the sector at the start of the move.
turnLimit :: Limits -> Sector -> MoveRest -> Double
turnLimit limits before move = case segment move of
  Straight _ _ -> 1
  Arc {sweep = Rad s}
    | s > 0 -> upTo s (leastHeading before + turning limits)
    | otherwise -> upTo s (mostHeading before - turning limits)
  where
    upTo s end
      | signum s * (heading before + s * (1 - from move) - end) <= Tolerance.equal = 1
      | otherwise = max (from move) (from move + (end - heading before) / s)

-- | Directions of lines from the viewpoint, in radians from 'forward'. The point of an arc that is
-- furthest from such a line has exactly the allowed distance from it. At this point the arc is
-- parallel to the line. The point lies to the left of a line in 'onLeft', and to the right of a
-- line in 'onRight'.
data Tangents = Tangents {onLeft :: [Double], onRight :: [Double]}

-- | 'Tangents' of a move, as seen from the viewpoint; none for a straight move.
tangentsTo :: Limits -> Viewpoint -> MoveRest -> Tangents
tangentsTo limits view move =
  Tangents {onLeft = touching (-1) (leftOf limits), onRight = touching 1 (rightOf limits)}
  where
    -- The furthest point to the left can only be on a clockwise arc, to the right only on a
    -- counter-clockwise one.
    touching :: Double -> Double -> [Double]
    touching sense y = case segment move of
      Arc {start, centre, sweep = Rad s}
        | signum s == sense,
          let Mm r = Segment.radius centre start,
          let away = Vec.to (eye view) centre,
          let sine = sense * (r - y) / Vec.norm away,
          abs sine <= 1 ->
          [let Rad toCentre = Vec.signedAngle (forward view) away in toCentre - asin sine]
      _ -> []

-- | Sector at the fraction @t@ of the move of @outlook@. Its fields 'miss' and 'excess' are those
-- of the chord to the point where chords meet near this fraction.
sectorAt :: Outlook -> Double -> Sector
sectorAt outlook@Outlook {limits, view, before, move, run} t =
  Sector
    { leastDirection = low,
      mostDirection = high,
      leastSlope = lowSlope,
      mostSlope = highSlope,
      heading = after,
      leastHeading = min (leastHeading before) after,
      mostHeading = max (mostHeading before) after,
      travelled = covered,
      miss =
        if isChord
          then Miss (side low high along) (side lowSlope highSlope slope)
          else Miss LT LT,
      excess =
        if isChord
          then max (outside low high along) (outside lowSlope highSlope slope)
          else 1
    }
  where
    covered = travelled before + lengthBetween (from move) t move
    on = Segment.at t (segment move)
    goal = meeting limits move t on run
    toPoint = Vec.to (eye view) on
    distance = Vec.norm toPoint
    chord = Vec.to (eye view) goal
    isChord = Vec.norm chord > 0 && covered > 0
    Rad along = if goal == on then Rad direction else Vec.signedAngle (forward view) chord
    Rad direction = Vec.signedAngle (forward view) toPoint
    slope = (levelAt t move - eyeLevel view) / covered
    lowSlope = max (leastSlope before) (slope - rising limits / covered)
    highSlope = min (mostSlope before) (slope + rising limits / covered)
    low = rightmostDirection outlook after direction distance
    high = leftmostDirection outlook after direction distance
    after = headingAt move (heading before) t

-- | The least direction of a chord that passes the move within the limits, up to a point of the
-- move. @after@ is the heading of the run at this point; @direction@ and @distance@ (mm) are those
-- of the point as seen from the viewpoint.
rightmostDirection :: Outlook -> Double -> Double -> Double -> Double
rightmostDirection Outlook {limits, before, tangents} after direction distance =
  maximum
    ( leastDirection before :
      [direction - asin (leftOf limits / distance) | distance > leftOf limits]
        <> [d | d <- onLeft tangents, after <= d, d <= heading before]
    )

-- | The largest direction of a chord that passes the move within the limits, up to a point of the
-- move. @after@ is the heading of the run at this point; @direction@ and @distance@ (mm) are those
-- of the point as seen from the viewpoint.
leftmostDirection :: Outlook -> Double -> Double -> Double -> Double
leftmostDirection Outlook {limits, before, tangents} after direction distance =
  minimum
    ( mostDirection before :
      [direction + asin (rightOf limits / distance) | distance > rightOf limits]
        <> [d | d <- onRight tangents, heading before <= d, d <= after]
    )

-- | Direction of the run at the fraction @t@ of a move. @before@ is the direction at the start of
-- the rest of the move. Both are in radians, measured from the direction at the viewpoint.
headingAt :: MoveRest -> Double -> Double -> Double
headingAt move before t = case segment move of
  Straight _ _ -> before
  Arc {sweep = Rad s} -> before + s * (t - from move)

-- | Position of @x@ relative to the interval from @low@ to @high@: 'LT' is below, 'EQ' within, 'GT'
-- above.
side :: Double -> Double -> Double -> Ordering
side low high x
  | x < low = LT
  | x > high = GT
  | otherwise = EQ

-- | Distance of @x@ from the interval from @low@ to @high@; at most 0 within it.
outside :: Double -> Double -> Double -> Double
outside low high x = max (low - x) (x - high)
