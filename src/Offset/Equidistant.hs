{-# LANGUAGE BangPatterns #-}

-- | The equidistant (offset) of a contour of lines and arcs: the path of the centre of a cutter
-- that rolls along one side of it.
--
-- Lines move along their normal, arcs change their radius, and about an outer corner the centre
-- walks on an arc of the cutter's radius (Ural paper: at a change of surface the centre moves on a
-- circle). Everything stays exact. Whether the cutter fits everywhere is decided by
-- "Offset.Kernel". Where it does not (a concave radius below its own, an inner corner, two parts of
-- the contour too near to one another) there is an obstacle, with the largest cutter that does fit;
-- or, if that is allowed, only the ways that the centre can go, and what stops it there.
module Offset.Equidistant
  ( OffsetSegment (..),
    Origin (..),
    Obstacle (..),
    Cause (..),
    CornerStyle (..),
    equidistant,
    styled,
    TrimmedOffset (..),
    UnreachedPart (..),
    RestMaterial (..),
    reachable,
    reachableFitting,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Base.Quantity (Mm (..), Rad (..), minus, plus, times, total)
import Control.Monad.ST (runST)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet (IntSet)
import Data.IntSet qualified as IntSet
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Data.Primitive.PrimArray
  ( PrimArray,
    indexPrimArray,
    newPrimArray,
    sizeofPrimArray,
    unsafeFreezePrimArray,
    writePrimArray,
  )
import Data.Set qualified as Set
import Data.Vector qualified as Vector
import Geometry.Carrier (Sense (..), Side (..))
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.RestMaterial (RestMaterial (..), standings)
import Offset.Tolerance qualified as Tolerance
import Offset.TrimmedOffset
  ( CornerStyle (..),
    OffsetSegment (..),
    Origin (..),
    TrimmedOffset (TrimmedOffset),
    leftward,
    numberOf,
    radiusAt,
  )
import Offset.TrimmedOffset qualified as TrimmedOffset

-- | Why a cutter does not fit, and the largest radius that does, if any does.
data Obstacle = Obstacle {cause :: Cause, largest :: Maybe Mm}
  deriving stock (Eq, Show)

data Cause
  = -- | a concave arc of this radius
    Concave Int Mm
  | -- | a corner towards the cutter, between two segments
    InnerCorner Int Int Point
  | -- | on its way along the first segment the cutter would cut the second; where its centre would
    -- be
    Collision Int Int Point
  deriving stock (Eq, Show)

-- | The equidistant at a radius, in the order of the walk, on arcs round the corners. The radius is
-- not negative.
equidistant :: Side -> Mm -> Polyarc -> Either Obstacle (NonEmpty OffsetSegment)
equidistant = styled CornerStyle {sharp = False, extra = const (Mm 0)}

-- | The equidistant in a style.
styled :: CornerStyle -> Side -> Mm -> Polyarc -> Either Obstacle (NonEmpty OffsetSegment)
styled style side radius contour = case attempt style side radius contour of
  Right pieces -> Right pieces
  Left cause -> Left Obstacle {cause, largest = largestFitting style side radius contour}

-- | The equidistant, or the first reason against it.
attempt :: CornerStyle -> Side -> Mm -> Polyarc -> Either Cause (NonEmpty OffsetSegment)
attempt style side radius contour = do
  pieces <- raw style side radius contour
  if radius <= Mm 0 || fits radius || fits (minus radius Tolerance.clearance)
    then Right pieces
    else Left (collision style radius contour pieces)
  where
    -- A cutter that just fits has nothing around it: there is no area in which it could stand.
    fits r = r > Mm 0 && TrimmedOffset.reachesAll style side r contour

-- | Segments and corners, each for itself. Whether there is a way is known first; its pieces come
-- when they are asked for, and need not all be there at once.
raw :: CornerStyle -> Side -> Mm -> Polyarc -> Either Cause (NonEmpty OffsetSegment)
raw style side radius contour@(Polyarc ends (first :| others)) =
  case causes style side radius contour turnings of
    cause : _ -> Left cause
    -- A cutter that just fits into an arc stands still there; a contour of such arcs alone is one
    -- point.
    [] ->
      Right
        ( maybe
            (along side (radiusAt style radius 0) 0 first :| [])
            chained
            (NonEmpty.nonEmpty (from 0 (frontOf bends contour) first (way 0 first) others))
        )
  where
    turnings = turningsOf contour
    bends = Bends {style, side, radius, turnings, isClosed = ends == Closed}
    way = wayOf bends
    -- A segment, by how much its way is shortened at its beginning, that way, and what is behind
    -- it.
    from !i !front s p rest = real (shortened front back p) (corner <> next)
      where
        Cuts back front' = cutsAt bends i (segment p) (segment p')
        s' = case rest of
          [] -> first
          behind : _ -> behind
        p' = way (following bends i) s'
        next = case rest of
          [] -> []
          _ : more -> from (i + 1) front' s' p' more
        corner = if null rest && ends == Open then [] else filter long (cornerWay bends i s s')
    real p rest = if long p then p : rest else rest
    long p = Segment.length (segment p) > Tolerance.coincident
    chained = Polyarc.chained segment (\s p -> p {segment = s}) ends

-- | By how much the walk turns behind each segment, in radians; there is none behind the last one
-- of an open contour.
turningsOf :: Polyarc -> PrimArray Double
turningsOf (Polyarc ends ss@(first :| _)) = runST $ do
  let count = NonEmpty.length ss
  turnings <- newPrimArray count
  let go !i list = case list of
        [] -> pure ()
        [s] -> writePrimArray turnings i (if ends == Closed then between s first else 0)
        s : rest@(s' : _) -> writePrimArray turnings i (between s s') >> go (i + 1) rest
  go 0 (NonEmpty.toList ss)
  unsafeFreezePrimArray turnings
  where
    between s s' =
      let Rad turned = Vec.turn (Segment.endDirection s) (Segment.startDirection s') in turned

-- | What is to be known at every corner: what was asked, the turning behind each segment, and
-- whether there is a corner behind the last one.
data Bends = Bends
  { style :: CornerStyle,
    side :: Side,
    radius :: Mm,
    turnings :: PrimArray Double,
    isClosed :: Bool
  }

-- | How many segments there are.
segmentCount :: Bends -> Int
segmentCount = sizeofPrimArray . turnings

-- | The way along a segment, by its number, before anything of it is cut.
wayOf :: Bends -> Int -> Segment -> OffsetSegment
wayOf Bends {style, side, radius} i = along side (radiusAt style radius i) i

-- | By how much the way before a corner is shortened at its end, and that behind it at its
-- beginning, in mm.
data Cuts = Cuts Double Double

-- | The same at the corner behind a segment, between two ways.
cutsAt :: Bends -> Int -> Segment -> Segment -> Cuts
cutsAt bends i before behind = case cornerOf bends i of
  Bent t -> meeting t before behind
  Passed -> Cuts 0 0
  Blocked -> Cuts 0 0

-- | By how much the way along the first segment is shortened at its beginning.
frontOf :: Bends -> Polyarc -> Double
frontOf bends (Polyarc _ ss@(first :| _)) = front
  where
    Cuts _ front =
      cutsAt
        bends
        final
        (segment (wayOf bends final (NonEmpty.last ss)))
        (segment (wayOf bends 0 first))
    final = segmentCount bends - 1

-- | How far before the end of the one way and behind the beginning of the other they meet, in mm,
-- given how far lines would. Arcs meet nearby: three of Newton's steps, which take both for
-- straight, leave rounding only. Where they lead to no place on both ways, the ways are cut as
-- lines are.
meeting :: Double -> Segment -> Segment -> Cuts
meeting t before behind = case (before, behind) of
  (Straight _ _, Straight _ _) -> Cuts t t
  _ -> go (3 :: Int) t t
  where
    Mm l = Segment.length before
    Mm l' = Segment.length behind
    go n a b
      | n == 0 = Cuts a b
      | a' > 0 && a' < min l (2 * t) && b' > 0 && b' < min l' (2 * t) = go (n - 1) a' b'
      | otherwise = Cuts t t
      where
        (k, k') = (1 - a / l, b / l')
        (u, v) = (Segment.directionAt k before, Segment.directionAt k' behind)
        gap = Vec.to (Segment.at k before) (Segment.at k' behind)
        a' = a - Vec.cross gap v / Vec.cross u v
        b' = b - Vec.cross u gap / Vec.cross u v

-- | All that is in the way, the most telling first.
causes :: CornerStyle -> Side -> Mm -> Polyarc -> PrimArray Double -> [Cause]
causes style side radius contour@(Polyarc ends ss@(first :| _)) turnings =
  concaves 0 list <> blocked 0 list <> overlong 0 (frontOf bends contour) list
  where
    list = NonEmpty.toList ss
    count = segmentCount bends
    bends = Bends {style, side, radius, turnings, isClosed = ends == Closed}
    concaves !i rest = case rest of
      [] -> []
      s : more
        | Just r <- tooTight side (radiusAt style radius i) s -> Concave i r : concaves (i + 1) more
        | otherwise -> concaves (i + 1) more
    blocked !i rest = case rest of
      [] -> []
      s : more
        | Blocked <- cornerOf bends i ->
          InnerCorner i (following bends i) (Segment.end s) : blocked (i + 1) more
        | otherwise -> blocked (i + 1) more
    overlong !i !front rest = case rest of
      [] -> []
      s : more
        | front + back > 0,
          Mm (front + back) >= Segment.length (way i s) ->
          let a = if front > 0 && (i > 0 || back <= 0) then (i - 1) `mod` count else i
           in InnerCorner a ((a + 1) `mod` count) (Segment.end (way i s)) :
              overlong (i + 1) front' more
        | otherwise -> overlong (i + 1) front' more
        where
          Cuts back front' = cutsAt bends i (way i s) $ case more of
            [] -> way 0 first
            s' : _ -> way (i + 1) s'
    way i = segment . wayOf bends i

-- | A way without so much of it at its beginning and at its end, in mm.
shortened :: Double -> Double -> OffsetSegment -> OffsetSegment
shortened front back way
  | front + back <= 0 = way
  | otherwise =
    way
      { segment =
          snd
            (Segment.cutAt (front / (l - back)) (fst (Segment.cutAt (1 - back / l) (segment way))))
      }
  where
    Mm l = Segment.length (segment way)

-- | The radius of an arc towards the cutter that is smaller than the cutter's own.
tooTight :: Side -> Mm -> Segment -> Maybe Mm
tooTight side radius s = case s of
  Arc {start, centre, sweep = Rad angle}
    | signum angle == leftward side,
      old <- Segment.radius centre start,
      minus old radius < times (-1) Tolerance.coincident ->
      Just old
  _ -> Nothing

-- | A segment moved to its side.
along :: Side -> Mm -> Int -> Segment -> OffsetSegment
along side (Mm r) number s = case s of
  Straight a b ->
    let n = Vec.scale (leftward side * r) (Vec.left (Vec.unit (Vec.to a b)))
     in OffsetSegment (Along number) (Straight (Vec.shift n a) (Vec.shift n b))
  Arc {start, end, centre, sweep = sweep@(Rad angle)} ->
    let Mm before = Segment.radius centre start
        after = if signum angle == leftward side then max 0 (before - r) else before + r
        moved p = Vec.shift (Vec.scale (after / before) (Vec.to centre p)) centre
     in OffsetSegment (Along number) Arc {start = moved start, end = moved end, centre, sweep}

-- | What is behind a segment.
data Corner
  = -- | a way round it, or none is needed
    Passed
  | -- before and behind it are shortened, @r·tan(θ/2)@. Measured curves that are joined smoothly
    -- have such ones

    -- | a corner towards the cutter that is too slight to leave more than 'Tolerance.slightRest'
    -- standing: by how much straight ways
    Bent Double
  | -- | a corner into which the cutter does not get
    Blocked

cornerOf :: Bends -> Int -> Corner
cornerOf bends@Bends {style, side, radius} number
  | not (isClosed bends) && number + 1 == segmentCount bends = Passed
  | abs turned <= smooth = Passed
  | turned * leftward side > 0 && r1 == radiusAt style radius (following bends number),
    Just t <- bend r1 =
    Bent t
  | radius <= Mm 0 = Passed
  | turned * leftward side > 0 && pi - abs turned > smooth = Blocked
  | otherwise = Passed
  where
    r1 = radiusAt style radius number
    turned = indexPrimArray (turnings bends) number
    Rad smooth = Tolerance.smoothAngle
    bend (Mm r) =
      let Mm rest =
            Tolerance.slightRest
       in if r * (1 / cos (turned / 2) - 1) <= rest
            then Just (r * tan (abs turned / 2))
            else Nothing

-- | The segment behind a corner.
following :: Bends -> Int -> Int
following bends number = if number + 1 == segmentCount bends then 0 else number + 1

-- | The way round a corner that is passed, if there is one, and from one distance to another.
cornerWay :: Bends -> Int -> Segment -> Segment -> [OffsetSegment]
cornerWay bends@Bends {style, side, radius} number before after = case cornerOf bends number of
  Bent _ -> []
  Blocked -> []
  Passed
    | abs turned <= smooth || radius <= Mm 0 ->
      [OffsetSegment (Around number) (Straight (from r1 before') (from r2 after')) | r1 /= r2]
    | sharp style && r1 == r2 && abs turned <= 2 * pi / 3 ->
      [ OffsetSegment (Around number) (Straight (from r1 before') (tip r1)),
        OffsetSegment (Around number) (Straight (tip r1) (from r2 after'))
      ]
    | r1 == r2 -> [OffsetSegment (Around number) (round' r1)]
    | r1 < r2 ->
      [ OffsetSegment (Around number) (Straight (from r1 before') (from r2 before')),
        OffsetSegment (Around number) (round' r2)
      ]
    | otherwise ->
      [ OffsetSegment (Around number) (round' r1),
        OffsetSegment (Around number) (Straight (from r1 after') (from r2 after'))
      ]
  where
    r1 = radiusAt style radius number
    r2 = radiusAt style radius (following bends number)
    Rad smooth = Tolerance.smoothAngle
    before' = Segment.endDirection before
    after' = Segment.startDirection after
    turned = indexPrimArray (turnings bends) number
    vertex = Segment.end before
    from (Mm r) direction = Vec.shift (Vec.scale (leftward side * r) (Vec.left direction)) vertex
    -- Where the ways before and behind the corner meet.
    tip (Mm r) = Vec.shift (Vec.scale (r * tan (abs turned / 2)) before') (from (Mm r) before')
    round' r = Segment.arc sense vertex (from r before') (from r after')
    sense = case side of
      LeftOf -> Clockwise
      RightOf -> CounterClockwise

-- | The worst place at which the cutter, on the equidistant, would cut the contour.
collision :: CornerStyle -> Mm -> Polyarc -> NonEmpty OffsetSegment -> Cause
collision style radius contour pieces
  | null found =
    let OffsetSegment origin s =
          NonEmpty.head pieces
     in Collision (numberOf origin) (numberOf origin) (Segment.start s)
  | otherwise = case minimumBy (comparing (\(d, _, _, _) -> d)) found of
    (_, i, j, p) -> Collision i j p
  where
    found = struck style radius contour (NonEmpty.toList pieces)

-- | Where the cutter, on some pieces, would cut the contour: how far its centre is then, the
-- segments of the piece and of the contour, the place of the centre.
struck :: CornerStyle -> Mm -> Polyarc -> [OffsetSegment] -> [(Mm, Int, Int, Point)]
struck style radius contour = concatMap strikes
  where
    index =
      BoxTree.index
        (BoundingBox.ofSegment . snd)
        (zip [0 ..] (NonEmpty.toList (segments contour)))
    strikes (OffsetSegment origin s) =
      [ (d, numberOf origin, j, p)
        | (j, other) <-
            BoxTree.select
              ( \box ->
                  BoundingBox.meets (BoundingBox.inflate widest (BoundingBox.ofSegment s)) box
                    && BoundingBox.atLeast (`Distance.toPoint` s) box < widest
              )
              index,
          let ClosestPoint d p = Distance.segments s other,
          plus d Tolerance.clearance < plus radius (extra style j)
      ]
    widest =
      plus
        radius
        (maximum (fmap (extra style) (0 :| [1 .. NonEmpty.length (segments contour) - 1])))

-- | The largest radius below the one asked that fits everywhere; a smaller cutter than one that
-- fits fits too, so halving finds it.
largestFitting :: CornerStyle -> Side -> Mm -> Polyarc -> Maybe Mm
largestFitting style side asked contour
  | fits smallest = Just (largestOf fits smallest asked)
  | otherwise = Nothing
  where
    smallest = times 10 Tolerance.clearance
    fits r = case attempt style side r contour of
      Right _ -> True
      Left _ -> False

-- | Between a radius that fits and one that does not, the largest that does.
largestOf :: (Mm -> Bool) -> Mm -> Mm -> Mm
largestOf fits low high = fst (BinarySearch.turningPoint Tolerance.resolution fits low high)

-- What can be reached -----------------------------------------------------------------------------

-- | Material that stays because the cutter cannot get at it: what stops the cutter, the place of
-- its centre then, and the material.
data UnreachedPart = UnreachedPart {stop :: Obstacle, middle :: Point, standing :: RestMaterial}
  deriving stock (Eq, Show)

-- | The ways beside a contour that the centre can go, in the order of the contour; and for every
-- place where a stretch of it is cut away, what stays there. The radius is positive.
reachable :: CornerStyle -> Side -> Mm -> Polyarc -> ([TrimmedOffset], [UnreachedPart])
reachable style side radius contour =
  ( if sharp style then map (sharpened style side radius contour) ways else ways,
    zipWith rest [0 ..] stops
  )
  where
    -- Round corners reach furthest.
    rolling = style {sharp = False}
    ways = TrimmedOffset.along rolling side radius contour
    stops = cuts contour (radiusAt style radius) ways
    past = largestPast rolling side radius contour [cause | (cause, _, _, _) <- stops]
    material = standings side contour ways [(o, o', at) | (_, o, o', at) <- stops]
    rest k (cause, _, _, at) =
      UnreachedPart
        { stop = Obstacle {cause, largest = past k},
          middle = at,
          standing = IntMap.findWithDefault Unbounded k material
        }

-- | A way with sharp corners instead of round ones wherever these are whole and nothing is in the
-- way.
sharpened :: CornerStyle -> Side -> Mm -> Polyarc -> TrimmedOffset -> TrimmedOffset
sharpened style side radius contour =
  \way -> way {TrimmedOffset.pieces = corner =<< TrimmedOffset.pieces way}
  where
    whole = Vector.fromList (NonEmpty.toList (segments contour))
    bends =
      Bends
        { style,
          side,
          radius,
          turnings = turningsOf contour,
          isClosed = Polyarc.ends contour == Closed
        }
    strikes = struck style radius contour
    corner p = case (origin p, segment p) of
      (Around i, Arc {start, end})
        | [a@(OffsetSegment _ (Straight from tip)), b@(OffsetSegment _ (Straight _ to))] <-
            cornerWay bends i (whole Vector.! i) (whole Vector.! following bends i),
          Vec.near from start,
          Vec.near to end,
          null (strikes [a, b]) ->
          a {segment = Straight start tip} :| [b {segment = Straight tip end}]
      _ -> p :| []

-- | The same for a cutter that goes down slots of just its own width, too. No area is there in
-- which its centre could stand, but a line: that of a cutter that is smaller by
-- 'Tolerance.clearance'.
reachableFitting :: CornerStyle -> Side -> Mm -> Polyarc -> ([TrimmedOffset], [UnreachedPart])
reachableFitting style side radius contour
  | less > Mm 0 && minus (longAll smaller) (longAll own) > Tolerance.slot = smaller
  | otherwise = own
  where
    less = minus radius Tolerance.clearance
    own = reachable style side radius contour
    smaller = reachable style side less contour
    longAll (ways, _) =
      total [Segment.length (segment p) | w <- ways, p <- NonEmpty.toList (TrimmedOffset.pieces w)]

-- | What is in the way wherever a way goes over from one segment to another that does not follow
-- it, or ends before the contour does; what the cutter touches on both sides, and where its centre
-- then is.
cuts :: Polyarc -> (Int -> Mm) -> [TrimmedOffset] -> [(Cause, Origin, Origin, Point)]
cuts contour radiusOf ways = if null ways then [] else concatMap along' ways
  where
    whole = Vector.fromList (NonEmpty.toList (segments contour))
    n = Vector.length whole
    along' way =
      [ stopped (Along i) (origin p) front
        | not (passed front (reverse [0 .. numberOf (origin p) - 1])),
          Just i <- [fst (TrimmedOffset.stops way)]
      ]
        <> concat (zipWith between list (drop 1 list <> [p | TrimmedOffset.ends way == Closed]))
        <> [ stopped (origin q) (Along j) back
             | not (passed back [numberOf (origin q) + 1 .. n - 1]),
               Just j <- [snd (TrimmedOffset.stops way)]
           ]
      where
        list = NonEmpty.toList (TrimmedOffset.pieces way)
        p = NonEmpty.head (TrimmedOffset.pieces way)
        q = NonEmpty.last (TrimmedOffset.pieces way)
        (front, back) = (Segment.start (segment p), Segment.end (segment q))
    stopped o o' at = (Collision (numberOf o) (numberOf o') at, o, o', at)
    between p q = [(cause, origin p, origin q, Segment.end (segment p)) | cause <- inTheWay p q]
    inTheWay p q = case (origin p, origin q) of
      (Around i, Along j) | j == next i -> []
      (Around i, Around j) | j == i -> []
      (Along i, Around j) | j == i -> []
      (Along i, Along j)
        | j == next i ->
          [ InnerCorner i j vertex
            | let vertex = Segment.end (whole Vector.! i),
              turns (whole Vector.! i) (whole Vector.! j)
          ]
        | j == next (next i),
          Just r <- tight (next i) ->
          [Concave (next i) r | let Mm d = minus (radiusOf (next i)) r, Mm d > Tolerance.clearance]
      (o, o') -> [Collision (numberOf o) (numberOf o') (Segment.end (segment p))]
    next i = if i + 1 == n then 0 else i + 1
    turns a b =
      let Rad t =
            Vec.turn (Segment.endDirection a) (Segment.startDirection b)
          Rad smooth = Tolerance.smoothAngle
       in abs t > smooth
    -- Beyond a place there are only arcs of the cutter's radius, in which it stands still there.
    passed at is = not (null is) && all (standsStill at) is
    standsStill at i = case whole Vector.! i of
      Arc {centre, start} ->
        let Mm d =
              minus (radiusOf i) (Segment.radius centre start)
         in Mm (abs d) <= Tolerance.clearance && Vec.distance at centre <= Tolerance.clearance
      Straight _ _ -> False
    tight i = case whole Vector.! i of
      Arc {start, centre}
        | r <- Segment.radius centre start,
          r <= plus (radiusOf i) Tolerance.clearance ->
          Just r
      _ -> Nothing

-- | The largest cutter, smaller than this one, that each of some causes does not stop, by their
-- numbers from 0.
largestPast :: CornerStyle -> Side -> Mm -> Polyarc -> [Cause] -> Int -> Maybe Mm
largestPast style side radius contour stops =
  \k -> if IntSet.member k passSmallest then Just (search k smallest radius whole) else Nothing
  where
    whole = halvings smallest radius
    passSmallest = passing smallest
    smallest = times 10 Tolerance.clearance
    search k low high Halving {middling, passed, below, above}
      | minus high low <= Tolerance.resolution = low
      | IntSet.member k passed = search k middling high above
      | otherwise = search k low middling below
    halvings low high =
      let middling =
            times 0.5 (plus low high)
       in Halving
            { middling,
              passed = passing middling,
              below = halvings low middling,
              above = halvings middling high
            }
    -- Those that do not stop a cutter of this radius, and whose segments are on some way at all.
    passing r =
      IntSet.fromDistinctAscList
        [ k
          | (k, c) <- zip [0 ..] stops,
            Just es <- [between c],
            Set.notMember es stopped,
            all (`IntSet.member` on) es
        ]
      where
        found = TrimmedOffset.along style side r contour
        stopped =
          Set.fromList
            [es | (c, _, _, _) <- cuts contour (radiusAt style r) found, Just es <- [between c]]
        on =
          IntSet.fromList
            [numberOf (origin p) | w <- found, p <- NonEmpty.toList (TrimmedOffset.pieces w)]
    -- A smaller cutter does not come into a corner either.
    between c = case c of
      Concave i _ -> Just [i]
      Collision i j _ -> Just [min i j, max i j]
      InnerCorner {} -> Nothing

-- | What passes a cutter in the middle between two radii, and the same for either half. It is
-- computed once for all that ask.
data Halving = Halving {middling :: Mm, passed :: ~IntSet, below, above :: ~Halving}
