-- | Chords along a run: moves that go on, without a corner, along one curve. Each chord reaches
-- from where the last one ended as far along the run as it may, whatever arcs it passes.
--
-- From the beginning of a chord every point of the run is seen in a direction, and the chord has to
-- pass it within what is allowed on either side: that leaves a sector of directions, which narrows
-- as the run goes on. An arc narrows it by its end and by the place at which its tangent runs along
-- the edge of the sector, so nothing is sampled.
--
-- Where more is allowed on one side than on the other, the chords may meet in the middle of what is
-- allowed, beside the run, if that makes them fewer; only its beginning and its end lie on it then.
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

-- | How far a run may lie from its chords.
data Bounds = Bounds
  { -- | to the left of the chord
    left :: Mm,
    -- | to its right
    right :: Mm,
    -- | above and below it, at the same share of the way
    rise :: Mm,
    -- | no chord need be shorter along the run
    shortest :: Mm
  }
  deriving stock (Eq, Show)

-- | The ends of the chords of a run with their heights, the last one its end. When there are more
-- than so many, at least so many of them.
chordEnds :: Int -> Bounds -> NonEmpty Move -> [(Point, Mm)]
chordEnds most bounds run =
  map
    (\p -> (place p, Mm (level p)))
    (maybe [final] (\pieces -> ends most bounds pieces final) (NonEmpty.nonEmpty (map piece long)))
  where
    long = NonEmpty.filter (\m -> Segment.length (Toolpath.segment m) > Mm 0) run
    piece m = let (Mm a, Mm b) = Toolpath.heights m in Piece (Toolpath.segment m) 0 (a, b)
    final =
      let m =
            NonEmpty.last run
          Mm z = snd (Toolpath.heights m)
       in Place (Segment.end (Toolpath.segment m)) z []

-- | The ends of the chords of pieces, whose own end is given.
ends :: Int -> Bounds -> NonEmpty Piece -> Place -> [Place]
ends most bounds pieces final =
  if count > most
    then widest chosen
    else kept <> evenest evenings (1 - 1 / fromIntegral (length others)) 1 others
  where
    chosen
      | n <- counted quick,
        n > 2,
        n <= min few most,
        bendsBack pieces,
        counted thorough < n =
        thorough
      | otherwise = quick
    quick = fewest (walks AtEnds bounds pieces id)
    thorough =
      fewest
        (walks Anywhere bounds pieces id <> walks Anywhere (mirrored bounds) (turned pieces) back)
    back places = drop 1 (reverse places) <> [final]
    fewest = minimumBy (comparing counted)
    counted = length . take (most + 1) . widest
    count = counted chosen
    (kept, others) = splitAt (count - mostEvened) (widest chosen)
    -- The tightest limits that need no more chords make the last one as long as the others.
    evenest :: Int -> Double -> Double -> [Place] -> [Place]
    evenest tries low high best
      | tries <= 0 || count == 1 = best
      | null (drop (length others) tighter) = evenest (tries - 1) low middle tighter
      | otherwise = evenest (tries - 1) middle high best
      where
        middle = (low + high) / 2
        tighter = walk chosen middle (NonEmpty.last (begin chosen :| kept))

-- | Of no more chords than so many, one less makes a difference: where a run bends to both sides
-- they are looked for thoroughly, and from its end as well.
few :: Int
few = 16

-- | The chords of a run are made as long as one another; of more than so many, only the last ones.
mostEvened :: Int
mostEvened = 256

-- | Whether a run bends to both sides. On one that does not, no chords are fewer than those that
-- reach furthest.
bendsBack :: NonEmpty Piece -> Bool
bendsBack pieces = any (> 0) sweeps && any (< 0) sweeps
  where
    sweeps = [s | Piece {segment = Arc {sweep = Rad s}} <- NonEmpty.toList pieces]

-- | Chords along pieces: where they begin, where they end when they are widest, and where they do
-- by how tight the limits are and from which place on.
data Walk = Walk {begin :: Place, widest :: [Place], walk :: Double -> Place -> [Place]}

-- | The walks along pieces: upon the run, and beside it where that may help.
walks :: Search -> Bounds -> NonEmpty Piece -> ([Place] -> [Place]) -> [Walk]
walks search bounds pieces onto =
  [ Walk {begin, widest = walk 1 begin, walk}
    | walk <- upon : [between | left bounds /= right bounds]
  ]
  where
    begin =
      let p =
            NonEmpty.head pieces
       in Place
            { place = Segment.at 0 (segment p),
              level = levelAt 0 p,
              rest = NonEmpty.toList pieces
            }
    between tightness from = onto (chords (limits tightness) from)
    upon tightness from = onto (chords (limits tightness) {aside = 0} from)
    limits tightness = (limitsOf bounds tightness) {search}

-- | The bounds of a run walked the other way.
mirrored :: Bounds -> Bounds
mirrored bounds = bounds {left = right bounds, right = left bounds}

-- | Whole pieces walked the other way.
turned :: NonEmpty Piece -> NonEmpty Piece
turned pieces =
  NonEmpty.reverse (fmap (\p -> Piece (Segment.reverse (segment p)) 0 (swap (heights p))) pieces)

-- | How often the limits are halved.
evenings :: Int
evenings = 5

-- | Where in a piece the end of a chord is looked for.
data Search
  = -- | at the end of the piece, or behind a beginning that a chord reaches
    AtEnds
  | -- | also where a chord reaches neither
    Anywhere
  deriving stock (Eq)

-- | Bounds in mm, and how far the run may turn within a chord, in radians.
data Limits = Limits
  { leftOf :: Double,
    rightOf :: Double,
    -- | how far to the right of the run the chords meet
    aside :: Double,
    rising :: Double,
    turning :: Double,
    least :: Double,
    search :: Search
  }

-- | The chords of an arc turn by so much of what they might when its sagitta is the square of that
-- share.
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
    -- Less than one point from the chord is on it.
    share d = let Mm y = max Tolerance.coincident (times (tightness * tightness) d) in y

-- | What is left of a move, from a fraction of its length on; the heights at the ends of the whole
-- move in mm.
data Piece = Piece {segment :: Segment, from :: Double, heights :: (Double, Double)}

-- | A place on the run, its height in mm, and what lies behind it.
data Place = Place {place :: Point, level :: Double, rest :: [Piece]}

-- | The ends of the chords from a place on.
chords :: Limits -> Place -> [Place]
chords limits begin
  | null (rest begin) = []
  | otherwise = let next = furthest limits begin in next : chords limits next

-- | A place at a fraction of the first of some pieces, where chords can meet.
placeOn :: Limits -> Piece -> Double -> [Piece] -> Place
placeOn limits piece t pieces =
  Place
    { place = meeting limits piece t (Segment.at t (segment piece)) pieces,
      level = levelAt t piece,
      rest = if t >= 1 then drop 1 pieces else piece {from = t} : drop 1 pieces
    }

-- | Where chords meet at a fraction of the first of some pieces, given the point there: beside it,
-- at its end on it.
meeting :: Limits -> Piece -> Double -> Point -> [Piece] -> Point
meeting limits piece t on pieces
  | t >= 1 && null (drop 1 pieces) || aside limits == 0 = on
  | otherwise =
    Vec.shift (Vec.scale (-(aside limits)) (Vec.left (Segment.directionAt t (segment piece)))) on

levelAt :: Double -> Piece -> Double
levelAt t piece = let (a, b) = heights piece in if t >= 1 then b else a + t * (b - a)

-- Looking along the run

-- | The beginning of a chord: the place, its height in mm, and the direction in which the run sets
-- out there.
data Eye = Eye {standing :: Point, standingAt :: Double, out :: Vec}

-- | What is seen of the run from the beginning of a chord, up to some place. Directions are angles
-- in radians from the one in which the run sets out, counter-clockwise.
data Sight = Sight
  { -- | the directions in which a chord passes the run within the limits
    lowest :: Double,
    highest :: Double,
    -- | the rises with which it does, in mm per mm of the way
    flattest :: Double,
    steepest :: Double,
    -- | the direction of the run at this place, and the least and the greatest on the way
    heading :: Double,
    leastHeading :: Double,
    mostHeading :: Double,
    -- | the way so far in mm
    gone :: Double,
    -- | how a chord to this place misses them
    missed :: Missed,
    -- | how far it does, in radians or as a rise; no more than 0 within
    beyond :: Double
  }

-- | On which side of what is allowed the direction of a chord is, and its rise; 'EQ' is within.
data Missed = Missed Ordering Ordering
  deriving stock (Eq)

-- | Whether a chord to the place stays within the limits.
fits :: Sight -> Bool
fits sight = beyond sight <= 0

-- | Where the longest chord from a place ends. A place behind one that no chord reaches may be
-- reached again, as long as there is any direction left.
furthest :: Limits -> Place -> Place
furthest limits begin = case rest begin of
  [] -> begin
  first : _ ->
    case reached
      (Eye (place begin) (level begin) (Segment.directionAt (from first) (segment first)))
      Nothing
      nothing
      (rest begin) of
      Just (way, p) | way >= least limits -> p
      _ -> onward limits (least limits) begin
  where
    nothing =
      Sight
        { lowest = -pi,
          highest = pi,
          flattest = -1 / 0,
          steepest = 1 / 0,
          heading = 0,
          leastHeading = 0,
          mostHeading = 0,
          gone = 0,
          missed = Missed EQ EQ,
          beyond = -1
        }
    reached eye best before pieces = case pieces of
      [] -> best
      piece : more
        | isClosed after || t < 1 -> better
        | otherwise -> reached eye better after more
        where
          t = turnsAt limits before piece
          tangents = tangentsTo limits eye piece
          seen u =
            let on =
                  Segment.at u (segment piece)
             in see limits eye before piece tangents u on (meeting limits piece u on pieces)
          after = seen t
          better = maybe best found $ case search limits of
            AtEnds
              | fits after -> Just t
              | fits before,
                share <- lastWithin (beyond . seen) (from piece, beyond before) (t, beyond after),
                share > from piece ->
                Just share
              | otherwise -> Nothing
            Anywhere ->
              lastFit
                seen
                ( (t, after) :
                  [(u, seen u) | u <- standstills limits eye piece t]
                    <> [(from piece, before)]
                )
          found u =
            Just (gone before + lengthBetween (from piece) u piece, placeOn limits piece u pieces)
    isClosed sight = lowest sight > highest sight || flattest sight > steepest sight

-- | The place so many mm further on, or the end.
onward :: Limits -> Double -> Place -> Place
onward limits way at = case rest at of
  [] -> at
  piece : _
    | way >= left' -> onward limits (way - left') (placeOn limits piece 1 (rest at))
    | otherwise -> placeOn limits piece (from piece + (1 - from piece) * way / left') (rest at)
    where
      left' = lengthBetween (from piece) 1 piece

-- | The last fraction at which a chord fits. Given are fractions from the last one back to one that
-- does not count, with what is seen there; between two of them the direction of the chord turns one
-- way only.
lastFit :: (Double -> Sight) -> [(Double, Sight)] -> Maybe Double
lastFit seen marks = case marks of
  (high, atHigh) : earlier@((low, atLow) : _)
    | fits atHigh -> Just high
    | share : _ <- filter (\u -> u > low && fits (seen u)) crossings -> Just share
    | otherwise -> lastFit seen earlier
    where
      crossings =
        [ lastWhere (\u -> missed (seen u) /= missed atHigh) low high
          | missed atLow /= missed atHigh
        ]
          <> [lastWithin (beyond . seen) (low, beyond atLow) (high, beyond atHigh) | fits atLow]
  _ -> Nothing

-- | The last fraction of which something holds, between one of which it does and one of which it
-- does not.
lastWhere :: (Double -> Bool) -> Double -> Double -> Double
lastWhere holds = go (40 :: Int)
  where
    go tries low high
      | tries <= 0 = low
      | holds middle = go (tries - 1) middle high
      | otherwise = go (tries - 1) low middle
      where
        middle = (low + high) / 2

-- | The same of what is no more than 0 at the first one and more at the last one, given both. Where
-- a straight line between the two says, of an end that stays with half of what it is there (the
-- rule of Illinois); every fourth time in the middle.
lastWithin :: (Double -> Double) -> (Double, Double) -> (Double, Double) -> Double
lastWithin excess (first, atFirst) (final, atFinal) = go (160 :: Int) EQ first atFirst final atFinal
  where
    finest = (final - first) / 2 ^ (40 :: Int)
    go tries moved low a high b
      | tries <= 0 || high - low <= finest || next <= low || next >= high = low
      | e <= 0 = go (tries - 1) LT next e high (if moved == LT then b / 2 else b)
      | otherwise = go (tries - 1) GT low (if moved == GT then a / 2 else a) next e
      where
        e = excess next
        next =
          if tries `mod` 4 /= 0 && straight > low && straight < high
            then straight
            else (low + high) / 2
        straight = low + (high - low) * (a / (a - b))

-- | The fractions up to one at which the direction of a chord to a piece turns back: where the
-- piece heads away from the eye or towards it. The last one first.
standstills :: Limits -> Eye -> Piece -> Double -> [Double]
standstills limits eye piece t = case segment piece of
  Straight _ _ -> []
  Arc {start, centre, sweep = Rad s} ->
    let Mm r = Segment.radius centre start
        away = Vec.to centre (standing eye)
        -- Chords meet on a circle about the same centre.
        ratio = (r + signum s * aside limits) / Vec.norm away
        turnings =
          [ u
            | abs ratio < 1,
              a <- [acos ratio, -(acos ratio)],
              let u = Segment.fraction (segment piece) (Vec.shift (Vec.rotate (Rad a) away) centre),
              u > from piece,
              u < t
          ]
     in sortOn negate turnings

-- | The way on a piece from one fraction to another in mm.
lengthBetween :: Double -> Double -> Piece -> Double
lengthBetween a b piece = let Mm l = Segment.length (segment piece) in l * (b - a)

-- | As far as a piece can be followed before the run has turned by more than it may within a chord.
turnsAt :: Limits -> Sight -> Piece -> Double
turnsAt limits before piece = case segment piece of
  Straight _ _ -> 1
  Arc {sweep = Rad s}
    | s > 0 -> within s (leastHeading before + turning limits)
    | otherwise -> within s (mostHeading before - turning limits)
  where
    within s end
      | signum s * (heading before + s * (1 - from piece) - end) <= Tolerance.equal = 1
      | otherwise = max (from piece) (from piece + (end - heading before) / s)

-- | The directions in which the tangents to a piece run along the edges of what is allowed, to its
-- left and to its right.
data Tangents = Tangents {onLeft :: [Double], onRight :: [Double]}

tangentsTo :: Limits -> Eye -> Piece -> Tangents
tangentsTo limits eye piece =
  Tangents {onLeft = touched (-1) (leftOf limits), onRight = touched 1 (rightOf limits)}
  where
    -- The direction in which a circle walked in a sense bulges by so much: its tangent there is
    -- that direction.
    touched :: Double -> Double -> [Double]
    touched sense y = case segment piece of
      Arc {start, centre, sweep = Rad s}
        | signum s == sense,
          let Mm r = Segment.radius centre start,
          let away = Vec.to (standing eye) centre,
          let sine = sense * (r - y) / Vec.norm away,
          abs sine <= 1 ->
          [let Rad there = Vec.turn (out eye) away in there - asin sine]
      _ -> []

-- | What is seen when a piece has been passed up to a fraction, given the point there, and whether
-- a chord to a point beside it fits.
see :: Limits -> Eye -> Sight -> Piece -> Tangents -> Double -> Point -> Point -> Sight
see limits eye before piece tangents t on goal =
  Sight
    { lowest = low,
      highest = high,
      flattest = flat,
      steepest = steep,
      heading = after,
      leastHeading = min (leastHeading before) after,
      mostHeading = max (mostHeading before) after,
      gone = way,
      missed =
        if isChord then Missed (beside low high along) (beside flat steep climb) else Missed LT LT,
      beyond =
        if isChord
          then max (max (low - along) (along - high)) (max (flat - climb) (climb - steep))
          else 1
    }
  where
    way = gone before + lengthBetween (from piece) t piece
    end = Vec.to (standing eye) on
    distance = Vec.norm end
    chord = Vec.to (standing eye) goal
    isChord = Vec.norm chord > 0 && way > 0
    Rad along = if goal == on then Rad direction else Vec.turn (out eye) chord
    Rad direction = Vec.turn (out eye) end
    climb = (levelAt t piece - standingAt eye) / way
    flat = max (flattest before) (climb - rising limits / way)
    steep = min (steepest before) (climb + rising limits / way)
    low =
      maximum
        ( lowest before :
          [direction - asin (leftOf limits / distance) | distance > leftOf limits]
            <> [d | d <- onLeft tangents, after <= d, d <= heading before]
        )
    high =
      minimum
        ( highest before :
          [direction + asin (rightOf limits / distance) | distance > rightOf limits]
            <> [d | d <- onRight tangents, heading before <= d, d <= after]
        )
    after = case segment piece of
      Straight _ _ -> heading before
      Arc {sweep = Rad s} -> heading before + s * (t - from piece)
    beside a b x
      | x < a = LT
      | x > b = GT
      | otherwise = EQ
