-- | Motions over tabs, brought to the height of their pass.
--
-- A pass below the top of a tab goes up over it. If the heights of a motion are those that the tabs
-- of the pass demand, the motion gets the height of the pass, so that the comparisons in the plane
-- take it for a part of the pass. If not, it keeps its heights, and does not count as a motion
-- along the contour: a cut through a tab leaves excess, and so does a tab where none is asked for.
--
-- The toolpath says where the tabs are. The proof tests by itself that they are as many as the
-- statement asks for, near the points of the statement, apart from each other, and away from
-- corners and small arcs. Their width, height and slope follow from the statement alone.
module Verify.Tab
  ( levelled,
    isBelow,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times)
import Base.Region (Located (..))
import Data.IntSet qualified as IntSet
import Data.List (mapAccumL, sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes, fromMaybe, listToMaybe, mapMaybe)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (Closed))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part (Milling, Tabs)
import Part.Part qualified as Part
import Part.Tolerance qualified as PartTolerance
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.LevelledMotion (Levelled (..))
import Verify.Motion (CutterMotion (..))
import Verify.Motion qualified as Motion
import Verify.Requirement qualified as Requirement

-- | Bring the motions over tabs to the heights of their passes. Other motions stay as they are.
levelled :: Machine -> Toolpath -> [CutterMotion] -> Levelled
levelled machine path ms
  | null passes = Levelled {motions = ms, isAsDemanded = const True}
  | otherwise =
    Levelled
      { motions = zipWith fromMaybe ms fitting,
        isAsDemanded = \m -> IntSet.member (number m) fitted
      }
  where
    -- The top of a tab is the same in all passes, and may be the height of a pass above. There a
    -- motion belongs to a pass of the motion before it. A motion may fit several passes at the same
    -- height that leave other allowances. The motions after it show to which of them it belongs.
    fitting = snd (mapAccumL fit [] ms)
    fit before m =
      let ofPass (k, pass) = (k,isOnTop machine pass m,) <$> levelledIn machine pass m
          found = mapMaybe ofPass (zip [0 :: Int ..] passes)
          same = [(k, m') | (k, _, m') <- found, k `elem` before]
          begun = [(k, m') | (k, False, m') <- found]
       in case if null same then begun else same of
            fits@((_, first) : _) -> (map fst fits, Just first)
            [] -> ([], Nothing)
    fitted = IntSet.fromList (map number (catMaybes fitting))
    passes =
      [ p
        | Toolpath.Cutting
            { Toolpath.job = Located _ milling,
              Toolpath.pass,
              Toolpath.tabs
            } <-
            Toolpath.blocks path,
          Just (Located _ asked) <- [Part.tabs milling],
          isBelow machine asked (Toolpath.atHeight pass),
          p <- [tabbedPass milling asked pass tabs]
      ]

-- | Test that a pass at the height @level@ is below the tops of tabs, by more than a pulse.
isBelow :: Machine -> Tabs -> Mm -> Bool
isBelow machine asked level =
  minus (Part.tabTop asked) level > Machine.resolutionOf machine Machine.Z

-- | Test that a motion is at the height of the tops of the tabs.
isOnTop :: Machine -> TabbedPass -> CutterMotion -> Bool
isOnTop machine pass m = all isThere [fromHeight m, toHeight m]
  where
    isThere z = let Mm d = minus z (top pass) in Mm (abs d) <= pulse
    pulse = Machine.resolutionOf machine Machine.Z

-- | A pass over tabs.
data TabbedPass = TabbedPass
  { -- | height of the pass
    level :: Mm,
    -- | height of the tops of the tabs, and the tangent of the angle of their sides
    top :: Mm,
    rise :: Double,
    -- | larger of the allowed chord errors
    tolerance :: Mm,
    -- | largest distance of the centre from the contour
    maxReach :: Mm,
    -- | elements of the contour, by their numbers from 0
    elements :: BoxTree (Int, Segment),
    -- | length of the path of the centre up to each element, with that of the whole path at the end
    starts :: Vector Mm,
    -- | distance of the centre from each element, and the element
    offsets :: Vector (Mm, Segment),
    side :: Maybe Side,
    -- | places of the middles of the tabs on this path, and the halves of their flats. It is empty
    -- if the tabs are not where the statement asks for them
    places :: [(Mm, Mm)]
  }

-- | A pass over tabs with its facts. @middles@ are the positions of the centre that the toolpath
-- has in the middles of the tabs.
tabbedPass :: Milling -> Tabs -> Toolpath.Pass -> [Point] -> TabbedPass
tabbedPass milling asked Toolpath.Pass {Toolpath.left, Toolpath.atHeight} middles =
  pass {places = fromMaybe [] (placesOf pass milling asked middles)}
  where
    pass =
      TabbedPass
        { level = atHeight,
          top = Part.tabTop asked,
          rise = let Rad a = Part.tabSides asked in tan a,
          tolerance = uncurry max (Part.deviationLimits (Part.tolerance milling)),
          maxReach = maximum (fmap reachOf es),
          elements =
            BoxTree.index
              (BoundingBox.ofSegment . snd)
              (zip [0 ..] (map Part.segment (NonEmpty.toList es))),
          offsets = Vector.fromList (map (\e -> (reachOf e, Part.segment e)) (NonEmpty.toList es)),
          starts = Vector.fromList (scanl plus (Mm 0) (map pathLength (NonEmpty.toList es))),
          side,
          places = []
        }
    es = Part.elements (Part.contour milling)
    side = Requirement.cutterSide milling
    reachOf e = plus (Requirement.centreDistance milling left) (Part.allowance (Part.finish e))
    pathLength e = times (magnification side (reachOf e) (Part.segment e)) (lengthOf e)
    lengthOf = Segment.length . Part.segment

-- | The places of tabs at the middles @middles@, and the halves of their flats. Nothing if the tabs
-- are not where the statement asks for them.
placesOf :: TabbedPass -> Milling -> Tabs -> [Point] -> Maybe [(Mm, Mm)]
placesOf pass milling asked middles
  | isAsked && areApart pass closed tabs && all isClear tabs = Just tabs
  | otherwise = Nothing
  where
    contour = Part.contour milling
    closed = Part.ends contour == Closed
    segments = map Part.segment (NonEmpty.toList (Part.elements contour))
    chord = plus (Part.tabWidth asked) (times 2 (Part.radius milling))
    tabs =
      [ (place, f)
        | p <- middles,
          Just place <- [placeOf pass p],
          Just f <- [flatOf pass chord place]
      ]
    isAsked =
      length tabs == length middles && case Part.tabPlaces asked of
        Part.Evenly n -> length tabs == n
        Part.NearPoints ps ->
          length tabs == length ps && all (\(Located _ p) -> any (isBeside p) middles) ps
    -- The contour's point nearest to the tab is the contour's point nearest to the point.
    isBeside p middle =
      let foot q = snd (nearestOf segments q)
       in Vec.distance (foot p) (foot middle) <= slackOfPlace
    blocked = barriers pass closed (times 0.75 chord)
    isClear (place, f) =
      let l = plus (half pass f) (Part.radius milling)
          touches (a, b) =
            plus place l > plus a slackOfPlace && b > plus (minus place l) slackOfPlace
       in not (any touches blocked)

-- | The least distance of a point from segments, and the nearest point.
nearestOf :: [Segment] -> Point -> (Mm, Point)
nearestOf segments p = minimum' [Distance.nearest p s | s <- segments]
  where
    minimum' ds = case ds of
      d : others -> foldl (\a b -> if fst b < fst a then b else a) d others
      [] -> (Mm 0, p)

-- | The length of the path of the centre for each mm of an element.
magnification :: Maybe Side -> Mm -> Segment -> Double
magnification side reach s = case (side, s) of
  (Just wanted, Arc {start, centre, sweep = Rad a}) ->
    let Mm r = Segment.radius centre start
        Mm d = reach
     in max 0 ((r - Carrier.sideSign wanted * signum a * d) / r)
  _ -> 1

-- | The place of the path at which the centre is at a point; Nothing away from the contour.
placeOf :: TabbedPass -> Point -> Maybe Mm
placeOf pass p = case near of
  [] -> Nothing
  first : others ->
    let (_, i, s) = foldl (\a b -> if distanceOf b < distanceOf a then b else a) first others
     in Just (plus (starts pass Vector.! i) (times (Distance.nearestFraction p s) (along pass i)))
  where
    limit = plus (maxReach pass) (times 2 (tolerance pass))
    distanceOf (d, _, _) = d
    near =
      [ (d, i, s)
        | (i, s) <-
            BoxTree.within
              (BoundingBox.inflate limit (BoundingBox.ofPoints p []))
              (elements pass),
          let d = Distance.toPoint p s,
          d <= limit
      ]

-- | The length of the path beside an element.
along :: TabbedPass -> Int -> Mm
along pass i = minus (starts pass Vector.! (i + 1)) (starts pass Vector.! i)

-- | The position of the centre at a place of the path. A place before the path is its beginning, a
-- place after it its end.
positionAt :: TabbedPass -> Mm -> Point
positionAt pass place = case side pass of
  Nothing -> p
  Just wanted -> Carrier.beside wanted reach (Segment.directionAt k s) p
  where
    n = Vector.length (offsets pass)
    i = max 0 (min (n - 1) (Vector.length (Vector.takeWhile (<= place) (starts pass)) - 1))
    (reach, s) = offsets pass Vector.! i
    l = along pass i
    k = if l > Mm 0 then max 0 (min 1 (over (minus place (starts pass Vector.! i)) l)) else 0
    p = Segment.at k s

-- | Half of the length of a flat around a place: the positions at its ends are @chord@ apart.
-- Nothing if the path turns too much.
flatOf :: TabbedPass -> Mm -> Mm -> Maybe Mm
flatOf pass chord place
  | apartBy longest < chord = Nothing
  | otherwise = Just (go (50 :: Int) (times 0.5 chord) longest)
  where
    longest = times 0.6 chord
    apartBy f = Vec.distance (positionAt pass (minus place f)) (positionAt pass (plus place f))
    go k low high
      | k == 0 = high
      | apartBy between < chord = go (k - 1) between high
      | otherwise = go (k - 1) low between
      where
        between = times 0.5 (plus low high)

-- | Half of the length of the path on which the centre is above the pass, by the half of the flat.
half :: TabbedPass -> Mm -> Mm
half pass f = plus f (times (1 / rise pass) (minus (top pass) (level pass)))

-- | Test that no two tabs meet. A closed path goes on at its beginning.
areApart :: TabbedPass -> Bool -> [(Mm, Mm)] -> Bool
areApart pass closed tabs = and (zipWith clear inOrder (drop 1 inOrder <> wrapped))
  where
    inOrder = sortOn fst tabs
    wrapped = [(plus place (whole pass), f) | closed, (place, f) <- take 1 inOrder]
    clear (a, f) (b, g) =
      plus (minus b a) slackOfPlace >= plus (half pass f) (half pass g)

-- | Stretches of the path that tabs keep away from: corners, which have no length, and arcs with a
-- radius below @least@. On a closed path they also stand before its beginning and after its end.
barriers :: TabbedPass -> Bool -> Mm -> [(Mm, Mm)]
barriers pass closed least =
  concat
    [ [(minus a (whole pass), minus b (whole pass)) | closed]
        <> [(a, b)]
        <> [(plus a (whole pass), plus b (whole pass)) | closed]
      | (a, b) <- corners <> small
    ]
  where
    list = Vector.toList (offsets pass)
    followers = map Just (drop 1 list) <> [if closed then listToMaybe list else Nothing]
    elements' = zip3 [0 ..] list followers
    corners =
      [ (p, p)
        | (i, (_, s), Just (_, next)) <- elements',
          let Rad turn = Vec.signedAngle (Segment.endDirection s) (Segment.startDirection next)
              Rad most = PartTolerance.smoothTurn
              p = starts pass Vector.! (i + 1),
          abs turn > most
      ]
    small =
      [ (starts pass Vector.! i, starts pass Vector.! (i + 1))
        | (i, (reach, s@(Arc {start, centre})), _) <- elements',
          let r = Segment.radius centre start,
          plus (min r (times (magnification (side pass) reach s) r)) slackOfPlace < least
      ]

-- | The length of the whole path.
whole :: TabbedPass -> Mm
whole pass = Vector.last (starts pass)

-- | Uncertainty of places along the path and of points on the contour.
slackOfPlace :: Mm
slackOfPlace = Mm 0.01

-- | The motion @m@ at the height of a pass. Nothing if it is away from the contour, or does not
-- have the right height everywhere.
levelledIn :: Machine -> TabbedPass -> CutterMotion -> Maybe CutterMotion
levelledIn machine pass m
  | all isRight (0 : sampled <> edges) = Just m {fromHeight = level pass, toHeight = level pass}
  | otherwise = Nothing
  where
    (low, high) = Motion.heights m
    sampled = case segment m of
      Straight _ _ -> [0.5, 1]
      Arc {} -> Motion.samples m
    slack =
      plus
        (tolerance pass)
        (times 1.5 (Machine.planeResolution machine))
    -- The motion may pass a whole tab between two samples.
    edges =
      [ Distance.nearestFraction q (segment m)
        | (place, f) <- places pass,
          let l = half pass f,
          at <- [minus place f, place, plus place f, minus place l, plus place l],
          let q = positionAt pass at,
          Distance.toPoint q (segment m) <= slack
      ]
    isRight k =
      let z = plus low (times k (minus high low))
       in case placeOf pass (Segment.at k (segment m)) of
            Nothing -> False
            Just place ->
              minus z (demanded (\d -> minus d slack) place) <= heightSlack
                && minus (demanded (plus slack) place) z <= heightSlack
    heightSlack = plus (Machine.resolutionOf machine Machine.Z) Tolerance.coincident
    -- The largest height that the tabs demand at a place, where the distance from a tab is changed
    -- by the uncertainty of the place.
    demanded change place = maximum (level pass : map (over' change place) (places pass))
    over' change place (middle, f) =
      let Mm d = minus place middle
          away = minus (change (Mm (abs d))) f
       in min (top pass) (minus (top pass) (times (rise pass) away))
