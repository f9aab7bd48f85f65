-- | Tabs: places along a path at which the cutter rises and leaves material, which holds the part.
--
-- A /place/ on a path is the length of the path up to it. A tab has a /flat/, where the cutter is
-- at the top of the tab, and a slope on both sides. The flat is so long that the cutters at its two
-- ends leave the width of the tab between them. So the tab is as wide as the program says in the
-- middle of the cut, and wider elsewhere. A /room/ is a stretch of the path without a corner and
-- without a small radius, where a tab may be. It keeps the cutter's radius from them.
module Toolpath.Tab
  ( Tab (..),
    TabFault (..),
    chosen,
    onPath,
    raisedLength,
    raised,
    raisedAlong,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times)
import Base.Region (Located (..), Region)
import Data.Containers.ListUtils (nubOrd)
import Data.List (minimumBy, sort, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Data.Ord (comparing)
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Equidistant (OffsetSegment)
import Offset.Equidistant qualified as Equidistant
import Part.Part (Tabs (..))
import Part.Part qualified as Part
import Toolpath.Toolpath (Move)
import Toolpath.Toolpath qualified as Toolpath

-- | A tab on a path.
data Tab = Tab
  { -- | the place of its middle
    middle :: Mm,
    -- | half of the length of its flat
    flat :: Mm,
    -- | half of the length of the path on which the cutter is above the lowest pass
    half :: Mm,
    -- | the position of the cutter's centre in its middle
    centre :: Point,
    -- | the height of its top; the top of the part is 0
    top :: Mm,
    -- | the rise of its sides, in mm for each mm of the path
    rise :: Double
  }
  deriving stock (Eq, Show)

-- | The reason why a tab has no room.
data TabFault
  = -- | one of several tabs along the whole path: its number from 1, and how many there are
    NoRoomFor Int Int
  | -- | a tab at a point: the region of the point, and the nearest position of the cutter's centre
    -- at which there is room, if there is one
    NoRoomNear Region (Maybe Point)
  | -- | two tabs at points that meet: the regions of the points
    TabsMeet Region Region
  deriving stock (Eq, Show)

-- | A segment of a path, with the place of its beginning.
data Stretch = Stretch Mm Segment

-- | The positions of the cutter's centre in the middles of the tabs of a statement, on the path of
-- its last pass, in the order of the path. If the path has several parts, they follow one another.
-- @radius@ is the radius of the cutter, @reach@ the distance of the path from the contour, and
-- @bottom@ the height of the lowest pass.
chosen :: Tabs -> Mm -> Mm -> Mm -> NonEmpty OffsetSegment -> Either TabFault [Point]
chosen tabs radius reach bottom path = case tabPlaces tabs of
  Part.Evenly n -> do
    found <- traverse (inShare n) [1 .. n]
    case [k | (k, (a, b)) <- zip [2 ..] (zip found (drop 1 found)), meets a b] of
      k : _ -> Left (NoRoomFor k n)
      [] -> Right (map centre found)
  Part.NearPoints ps -> do
    found <- traverse (\p -> (region p,) <$> atPoint p) ps
    let inOrder = sortOn (middle . snd) (NonEmpty.toList found)
    case [TabsMeet p q | ((p, a), (q, b)) <- zip inOrder (drop 1 inOrder), meets a b] of
      fault : _ -> Left fault
      [] -> Right (map (centre . snd) inOrder)
  where
    stretches = stretchesOf (fmap Equidistant.segment path)
    chord = plus (tabWidth tabs) (times 2 radius)
    rooms = roomsIn radius (times 0.75 chord) reach path
    long = endOf stretches
    meets a b = minus (middle b) (middle a) < plus (half a) (half b)
    inShare n k =
      let share = times (1 / fromIntegral n) long
          ideal = times (fromIntegral k - 0.5) share
          isNear t = apart (middle t) ideal <= plus (times 0.5 share) Tolerance.coincident
       in maybe (Left (NoRoomFor k n)) Right (nearest ideal (filter isNear (around ideal)))
    atPoint (Located at p) =
      let place = placeNear p stretches
       in case nearest place (around place) of
            Just t | apart (middle t) place <= Tolerance.coincident -> Right t
            other -> Left (NoRoomNear at (centre <$> other))
    nearest place ts = case ts of
      [] -> Nothing
      _ -> Just (minimumBy (comparing (apart place . middle)) ts)
    around place = mapMaybe (inRoom tabAt (times 0.5 (raisedLength tabs radius bottom)) place) rooms
    tabAt = tabOn tabs radius bottom stretches

-- | The tab in a room that is nearest to a place; Nothing if the room is too short. @tabAt@ gives a
-- tab by its middle. Its half depends a little on the middle, if the room has arcs, so that the
-- middle is found in a few steps. The first of them takes @least@, the half on a straight path: at
-- the end of a room the path may turn too much for a tab.
inRoom :: (Mm -> Maybe Tab) -> Mm -> Mm -> (Mm, Mm) -> Maybe Tab
inRoom tabAt least place (from, to) = do
  c <- foldr (const (>>= settled)) (Just (within least)) [1 :: Int .. 8]
  t <- tabAt c
  let isInside =
        plus (minus (middle t) (half t)) Tolerance.coincident >= from
          && minus (plus (middle t) (half t)) Tolerance.coincident <= to
  if isInside then Just t else Nothing
  where
    settled c = within . half <$> tabAt c
    within h = max (plus from h) (min (minus to h) place)

-- | The tabs on a path, in its order, with their middles at the positions of the path nearest to
-- @middles@. Positions further from the path than @far@ are left out: they are on another part of
-- the path. @radius@ is the radius of the cutter, and @bottom@ the height of the lowest pass.
onPath :: Tabs -> (Mm, Mm) -> Mm -> [Point] -> NonEmpty Segment -> [Tab]
onPath tabs (radius, bottom) far middles path =
  sortOn
    middle
    [ t
      | p <- middles,
        any (\s -> Distance.toPoint p s <= far) path,
        Just t <- [tabOn tabs radius bottom stretches (placeNear p stretches)]
    ]
  where
    stretches = stretchesOf path

-- | The length of the straight path on which the cutter rises over a tab. @radius@ is the radius of
-- the cutter, and @bottom@ the height of the lowest pass.
raisedLength :: Tabs -> Mm -> Mm -> Mm
raisedLength tabs radius bottom =
  plus
    (plus (tabWidth tabs) (times 2 radius))
    (times (2 / tan angle) (minus (tabTop tabs) bottom))
  where
    Rad angle = tabSides tabs

-- | The tab with its middle at a place of a path. Nothing if the path turns too much there.
tabOn :: Tabs -> Mm -> Mm -> [Stretch] -> Mm -> Maybe Tab
tabOn tabs radius bottom stretches c = do
  flat <- flatAt stretches (plus (tabWidth tabs) (times 2 radius)) c
  let rise = let Rad a = tabSides tabs in tan a
      half = plus flat (times (1 / rise) (minus (tabTop tabs) bottom))
  Just Tab {middle = c, flat, half, centre = positionAt stretches c, top = tabTop tabs, rise}

-- | The distance of two places.
apart :: Mm -> Mm -> Mm
apart a b = let Mm d = minus a b in Mm (abs d)

-- | The rooms of a path, by their ends: its smooth stretches, less the margin @margin@ at both
-- ends. An arc is small if its radius, or that of the element beside it, is below @least@. @reach@
-- is the distance of the path from the contour. A room does not extend across the beginning of the
-- path.
roomsIn :: Mm -> Mm -> Mm -> NonEmpty OffsetSegment -> [(Mm, Mm)]
roomsIn margin least reach path =
  [ (plus from margin, minus to margin)
    | run <- runs (filter hasLength (zip (stretchesOf segments) (NonEmpty.toList path))),
      let from = beginOf (NonEmpty.head run)
          to = finishOf (NonEmpty.last run),
      plus from (times 2 margin) < to
  ]
  where
    segments = fmap Equidistant.segment path
    hasLength (Stretch _ s, _) = Segment.length s > Tolerance.coincident
    beginOf (Stretch from _, _) = from
    finishOf (Stretch from s, _) = plus from (Segment.length s)
    runs items = case dropWhile (not . isWide) items of
      [] -> []
      first : more -> let (run, others) = extended first more in run : runs others
    extended item more = case more of
      next : others
        | isWide next && isSmooth item next ->
          let (run, rest) = extended next others in (NonEmpty.cons item run, rest)
      _ -> (item :| [], more)
    isWide (Stretch _ s, o) = case (s, Equidistant.origin o) of
      (_, Equidistant.Around _) -> False
      (Straight _ _, _) -> True
      (Arc {Segment.centre = c, Segment.start}, _) ->
        let r = Segment.radius c start in r >= least && minus r reach >= least
    isSmooth (Stretch _ a, _) (Stretch _ b, _) =
      let Rad turn = Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
       in abs turn <= smoothTurn && Vec.isNear (Segment.end a) (Segment.start b)

-- | The largest change of direction, in radians, at a joint that is no corner.
smoothTurn :: Double
smoothTurn = 1e-4

-- | Half of the length of a flat: the positions at its ends are @chord@ apart. Nothing if the path
-- turns too much for that.
flatAt :: [Stretch] -> Mm -> Mm -> Maybe Mm
flatAt stretches chord c
  | apartAt longest < chord = Nothing
  | otherwise = Just (go (60 :: Int) (times 0.5 chord) longest)
  where
    -- The half of an arc of three quarters of the chord as radius is 0.55 of the chord.
    longest = times 0.6 chord
    apartAt f = Vec.distance (positionAt stretches (minus c f)) (positionAt stretches (plus c f))
    go k low high
      | k == 0 || apartAt low >= chord = low
      | apartAt between < chord = go (k - 1) between high
      | otherwise = go (k - 1) low between
      where
        between = times 0.5 (plus low high)

-- | The segments of a path with the places of their beginnings.
stretchesOf :: NonEmpty Segment -> [Stretch]
stretchesOf segments = zipWith Stretch (scanl plus (Mm 0) (map Segment.length list)) list
  where
    list = NonEmpty.toList segments

-- | The place of the end of a path.
endOf :: [Stretch] -> Mm
endOf stretches = case reverse stretches of
  Stretch from s : _ -> plus from (Segment.length s)
  [] -> Mm 0

-- | The position at a place of a path. Before the beginning it is the beginning, after the end the
-- end.
positionAt :: [Stretch] -> Mm -> Point
positionAt stretches place = case stretches of
  [] -> Vec.point 0 0
  Stretch from s : more -> case more of
    Stretch next _ : _ | next <= place -> positionAt more place
    _ | l <- Segment.length s, l > Mm 0 -> Segment.at (over (minus place from) l) s
    _ -> Segment.start s

-- | The place of a path that is nearest to a point.
placeNear :: Point -> [Stretch] -> Mm
placeNear p stretches =
  maybe
    (Mm 0)
    snd
    ( listToMaybe
        ( sortOn
            fst
            [ (d, plus from (times (Distance.nearestFraction p s) (Segment.length s)))
              | Stretch from s <- stretches,
                let d = Distance.toPoint p s
            ]
        )
    )

-- | Moves along a path, raised over its tabs. The first place is that of the beginning of the first
-- move. Parts that go down have the speed @down@.
raisedAlong :: [Tab] -> Part.Pace -> NonEmpty Move -> NonEmpty Move
raisedAlong tabs down = go (Mm 0)
  where
    go from (m :| more) =
      let to = plus from (Segment.length (Toolpath.segment m))
          first = raised tabs down (from, to) m
       in maybe first ((first <>) . go to) (NonEmpty.nonEmpty more)

-- | A move raised over the tabs of its path. The places are those of its beginning and its end; the
-- second one is the smaller one if the move goes backwards along the path. The move is divided
-- where its slope changes. Parts that go down have the speed @down@.
raised :: [Tab] -> Part.Pace -> (Mm, Mm) -> Move -> NonEmpty Move
raised tabs down (from, to) m = case filter isNear tabs of
  [] -> m :| []
  near ->
    let cuts = 0 : filter (\t -> t > 0 && t < 1) (nubOrd (sort (concatMap bends near))) <> [1]
        highest t = maximum (own t : map (\k -> heightOver k (placeAt t)) near)
        part a b =
          atPace (highest a) (highest b) $
            (Toolpath.atHeights (highest a, highest b) m)
              { Toolpath.segment = Segment.between a b (Toolpath.segment m),
                Toolpath.continues = Toolpath.continues m && a <= 0
              }
     in fromMaybe (m :| []) (NonEmpty.nonEmpty (zipWith part cuts (drop 1 cuts)))
  where
    (low, high) = Toolpath.heights m
    own t
      | t >= 1 = high
      | otherwise = plus low (times t (minus high low))
    placeAt t = plus from (times t (minus to from))
    isNear k =
      minus (max from to) (minus (middle k) (half k)) > Mm 0
        && minus (plus (middle k) (half k)) (min from to) > Mm 0
    atPace a b moved
      | b < a && low == high = Toolpath.withPace down moved
      | otherwise = moved
    -- The fractions of the move at which the larger of its height and that of a tab may bend.
    bends k =
      map fractionOf [minus (middle k) (flat k), plus (middle k) (flat k)]
        <> filter
          (\t -> apart (heightOver k (placeAt t)) (own t) <= Tolerance.coincident)
          (crossings (const (top k)) <> concatMap (crossings . sideHeight k) [-1, 1])
    fractionOf place = over (minus place from) (minus to from)
    sideHeight k side t =
      minus
        (top k)
        (times (rise k) (minus (times side (minus (placeAt t) (middle k))) (flat k)))
    -- Both heights are linear, so that two values give their crossing.
    crossings :: (Double -> Mm) -> [Double]
    crossings height =
      let Mm a = minus (own 0) (height 0)
          Mm b = minus (own 1) (height 1)
       in [a / (a - b) | a /= b]

-- | The height of the surface of a tab at a place; below its top beside the flat.
heightOver :: Tab -> Mm -> Mm
heightOver k place =
  min (top k) (minus (top k) (times (rise k) (minus (apart place (middle k)) (flat k))))
