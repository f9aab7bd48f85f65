-- | The moves of drilling and of the other works on holes. At each hole the tool moves above the
-- hole in rapid, makes the hole, and comes back to the clearance height.
module Toolpath.DrillMove
  ( PeckRule (..),
    moves,
    withRule,
    commandsAfter,
  )
where

import Base.Quantity (Mm (..), minus, over, plus, times)
import Base.Region (Located (..), Region)
import Data.List (find)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Geometry.Carrier (Sense (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.CutFeed (SpindleRate (..))
import Part.CutFeed qualified as CutFeed
import Part.Part
  ( Circling (..),
    Drilling,
    Hole (..),
    HoleForm (..),
    SpacePoint (..),
    ThreadHelix (..),
  )
import Part.Part qualified as Part
import Toolpath.HoleOrder qualified as HoleOrder
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.Toolpath (Manner (Manner), Move (Move))
import Toolpath.Toolpath qualified as Toolpath

-- | The pecks of a control's own cycle. They are counted from the clearance height, and all but the
-- last one are as deep as the program allows.
data PeckRule = PeckRule
  { -- | the height above the end of one peck at which the rapid move to the next one ends
    peckReturn :: Mm,
    -- | the unit of the depth of a peck, which is rounded down
    peckUnit :: Mm
  }
  deriving stock (Eq, Show)

-- | The moves of a drilling statement; @at@ is the tool's position before the statement. A tool
-- below the clearance height rises to that height first. "Toolpath.HoleOrder" gives the order of
-- the holes.
moves :: SpacePoint -> Located Drilling -> [Move]
moves at (Located region d) =
  LinkingMove.rise at clear (LinkingMove.keyword 4 region)
    <> go (SpacePoint (plane at) (max clear (height at))) (NonEmpty.toList ordered)
  where
    ordered = HoleOrder.ordered (plane at) d
    clear = Part.travelHeight d
    go from holes = case holes of
      [] -> []
      hole : rest ->
        let Located written p = holeCentre hole
            made = strokes Nothing d hole
            begin = maybe p (Segment.start . path) (firstOf made)
            end = maybe p (Segment.end . path) (firstOf (reverse made))
            over' =
              LinkingMove.straightMoves
                from
                [Part.Stop (Located written begin) (Just clear) Part.Rapid]
         in over' <> map (moveOf written) made <> go (SpacePoint end clear) rest
    firstOf list = case list of
      s : _ -> Just s
      [] -> Nothing

moveOf :: Region -> Stroke -> Move
moveOf hole (Stroke s zs pace) = Move s (Manner zs pace False) hole False

-- | One move at a hole: its path, its heights, and its speed.
data Stroke = Stroke {path :: Segment, _between :: (Mm, Mm), _speed :: Part.Pace}

-- | The moves at a hole, from the clearance height back to it.
strokes :: Maybe PeckRule -> Drilling -> Hole -> [Stroke]
strokes rule d hole = case Part.form d of
  Plunged -> pecks rule d hole
  Reamed -> inAndOut
  Tapped _ -> inAndOut
  Bored c -> circled d c hole
  Threaded h -> threaded d h hole
  where
    clear = Part.travelHeight d
    down = Part.At (Part.drillFeed d)
    p = value (holeCentre hole)
    inAndOut =
      [ Stroke (Straight p p) (clear, holeBottom hole) down,
        Stroke (Straight p p) (holeBottom hole, clear) down
      ]

-- | Straight down in pecks. Without pecks there is one move down.
pecks :: Maybe PeckRule -> Drilling -> Hole -> [Stroke]
pecks rule d (Hole (Located _ p) bottom _) = go clear ends
  where
    clear = Part.travelHeight d
    ends = depthsOf rule d bottom
    go _ [] = []
    go from (z : more) =
      vertical (from, z) (Part.At (Part.drillFeed d)) : case (more, Part.chipRise d) of
        ([], _) -> [vertical (z, clear) Part.Rapid]
        (_, Just rise) ->
          let up = min clear (plus z rise) in vertical (z, up) Part.Rapid : go up more
        (_, Nothing) ->
          let back = min clear (plus z (maybe peckGap peckReturn rule))
           in vertical (z, clear) Part.Rapid :
              [vertical (clear, back) Part.Rapid | back /= clear]
                <> go back more
    vertical = Stroke (Straight p p)

-- | The heights at which the pecks of a hole end, in order; @bottom@ is the height of its bottom.
-- Without a rule all pecks have equal depths, at most the depth that the program gives. If this
-- would need more than 10000 pecks, there are 10000 deeper ones. Without pecking the only height is
-- that of the hole's bottom.
depthsOf :: Maybe PeckRule -> Drilling -> Mm -> [Mm]
depthsOf rule d bottom = case (Part.peckDepth d, rule) of
  (Nothing, _) -> [bottom]
  (Just most, Nothing) ->
    let count = countOf (minus (Mm 0) bottom) most
     in [times (fromIntegral k / fromIntegral count) bottom | k <- [1 .. count]]
  (Just most, Just PeckRule {peckUnit}) ->
    let whole = max 1 (floor (over most peckUnit + Tolerance.equal)) :: Int
        step = times (fromIntegral whole) peckUnit
        ends = [minus clear (times (fromIntegral k) step) | k <- [1 :: Int ..]]
     in takeWhile (\z -> minus z bottom > times Tolerance.equal peckUnit) ends <> [bottom]
  where
    clear = Part.travelHeight d
    countOf :: Mm -> Mm -> Int
    countOf deep most = max 1 (min 10000 (ceiling (over deep most - Tolerance.equal)))

-- | The height above the end of one peck at which the rapid move down to the next peck ends.
peckGap :: Mm
peckGap = Mm 0.5

-- | A helix along the wall of a hole, from the top of the part to the bottom, and a full circle
-- there. To clear the floor, the helix keeps to the middle, and further circles follow outwards. A
-- cutter that has cleared the middle goes there before it rises.
circled :: Drilling -> Circling -> Hole -> [Stroke]
circled d c (Hole (Located _ p) bottom _) =
  [Stroke (Straight begin begin) (clear, Mm 0) (Part.At (Part.drillFeed d))]
    <> concat [halves first (level (k - 1), level k) | k <- [1 .. turns]]
    <> halves first (bottom, bottom)
    <> concat
      [ Stroke (Straight (at (fst ring)) (at (snd ring))) (bottom, bottom) feed :
        halves (snd ring) (bottom, bottom)
        | ring <- zip rings (drop 1 rings)
      ]
    <> [Stroke home (bottom, bottom) feed | isClear]
    <> [Stroke (Straight end end) (bottom, clear) Part.Rapid]
  where
    clear = Part.travelHeight d
    feed = Part.At (circleFeed c)
    tool = Part.drillRadius d
    outer = minus (boreRadius c) tool
    ringCount
      | clearsFloor c = max 1 (ceiling (over outer tool - Tolerance.equal)) :: Int
      | otherwise = 1
    rings = [times (fromIntegral k / fromIntegral ringCount) outer | k <- [1 .. ringCount]]
    first = case rings of
      r : _ -> r
      [] -> outer
    begin = at first
    at (Mm r) = Vec.shift (Vec.vec r 0) p
    across (Mm r) = Vec.shift (Vec.vec (-r) 0) p
    halves r (from, to) =
      let middle = plus from (times 0.5 (minus to from))
       in [ Stroke (arc (at r) (across r)) (from, middle) feed,
            Stroke (arc (across r) (at r)) (middle, to) feed
          ]
    arc a b = Segment.arc (circleSense c) p a b
    turns = max 1 (ceiling (over (minus (Mm 0) bottom) (turnDepth c) - Tolerance.equal)) :: Int
    level k = times (fromIntegral k / fromIntegral turns) bottom
    isClear = outer <= plus (if clearsFloor c then outer else tool) Tolerance.coincident
    home = halfTurn (circleSense c) (at outer) p
    end = if isClear then p else at outer

-- | The half circle in a sense from one point to another.
halfTurn :: Sense -> Point -> Point -> Segment
halfTurn sense a b = Segment.arc sense (Vec.shift (Vec.scale 0.5 (Vec.to a b)) a) a b

-- | A thread: a half circle onto the helix, whole turns along it, and a half circle off it. All of
-- them rise or fall by the pitch for each turn.
threaded :: Drilling -> ThreadHelix -> Hole -> [Stroke]
threaded d h (Hole (Located _ p) low _) =
  [ Stroke (Straight away away) (clear, zBegin) (Part.At (Part.drillFeed d)),
    Stroke (halfTurn leadSense away onHelix) (zBegin, move 0.5) feed
  ]
    <> concat
      [ [ Stroke (arc onHelix opposite) (move (t + 0.5), move (t + 1)) feed,
          Stroke (arc opposite onHelix) (move (t + 1), move (t + 1.5)) feed
        ]
        | t <- map fromIntegral [0 .. turns - 1]
      ]
    <> [ Stroke (halfTurn leadSense onHelix away) (move (count + 0.5), zEnd) feed,
         Stroke (Straight away away) (zEnd, clear) Part.Rapid
       ]
  where
    clear = Part.travelHeight d
    feed = Part.At (helixFeed h)
    tool = Part.drillRadius d
    radius
      | isInside h = minus (toothRadius h) tool
      | otherwise = plus (toothRadius h) tool
    onHelix = east radius
    opposite = east (times (-1) radius)
    away = if isInside h then p else east (plus radius (times 2 tool))
    east (Mm x) = Vec.shift (Vec.vec x 0) p
    leadSense
      | isInside h = helixSense h
      | otherwise = case helixSense h of
        Clockwise -> CounterClockwise
        CounterClockwise -> Clockwise
    arc a b = Segment.arc (helixSense h) p a b
    turns = max 1 (ceiling (over (minus (Mm 0) low) (pitch h) - 0.5 - Tolerance.equal)) :: Int
    count = fromIntegral turns :: Double
    high = plus low (times (count + 1) (pitch h))
    (zBegin, zEnd) = if rises h then (low, high) else (high, low)
    move t = plus zBegin (times (if rises h then t else -t) (pitch h))

-- | The moves of a drilling statement with the pecks of a control's own cycle in place of those
-- that begin at the clearance height above a hole and come back to it.
withRule :: PeckRule -> Drilling -> [Move] -> [Move]
withRule rule d = go
  where
    go ms = case ms of
      [] -> []
      m : more
        | isStroke m,
          Just hole <- holeOf ms (at m) ->
          map (moveOf (Toolpath.origin m)) (strokes (Just rule) d hole)
            <> go (drop (length (strokes Nothing d hole)) ms)
        | otherwise -> m : go more
    at = holesAt (holesByCentre d) . Segment.start . Toolpath.segment
    isStroke m =
      isVertical (Toolpath.segment m)
        && fst (Toolpath.heights m) == Part.travelHeight d
        && snd (Toolpath.heights m) < Part.travelHeight d
    isVertical s = case s of
      Straight a b -> a == b
      Arc {} -> False
    -- Several holes may have one centre; then it is the one with these heights.
    holeOf ms found = case found of
      [hole] -> Just hole
      _ -> find (areHeightsOf ms . map between . strokes Nothing d) found
    areHeightsOf ms zs = map Toolpath.heights (take (length zs) ms) == zs
    between (Stroke _ zs _) = zs

-- | The holes of a statement by the coordinates of their centres.
holesByCentre :: Drilling -> Map (Double, Double) [Hole]
holesByCentre d =
  Map.fromListWith
    (flip (<>))
    [(coordinates (value (holeCentre h)), [h]) | h <- NonEmpty.toList (Part.holes d)]

-- | The holes with this centre, in the order of the program.
holesAt :: Map (Double, Double) [Hole] -> Point -> [Hole]
holesAt holes p = Map.findWithDefault [] (coordinates p) holes

coordinates :: Point -> (Double, Double)
coordinates p = (Vec.x p, Vec.y p)

-- | The commands after a move of a drilling statement: the pause at the bottom of a hole, and the
-- reversals of the spindle of a tap.
commandsAfter :: Drilling -> Move -> [Part.Command]
commandsAfter d = after
  where
    after m = case Part.form d of
      Tapped t
        | isFeed m && isDown m -> pause <> [Part.SpindleOn (reversed (Part.tapSense t)) rate]
        | isFeed m -> [Part.SpindleOn (Part.tapSense t) rate]
      Plunged | not (null pause) && isFeed m && endsAtBottom m -> pause
      _ -> []
    isDown m = uncurry (>) (Toolpath.heights m)
    isFeed m = Toolpath.pace m /= Part.Rapid && uncurry (/=) (Toolpath.heights m)
    endsAtBottom m =
      snd (Toolpath.heights m)
        `elem` map holeBottom (holesAt holes (Segment.end (Toolpath.segment m)))
    holes = holesByCentre d
    pause = [Part.Dwell t | Just t <- [Part.bottomPause d]]
    rate = case value (Part.drillFeed d) of
      CutFeed.PerTurn _ r -> r
      CutFeed.PerMinute _ -> NoRate
    reversed s = case s of
      Part.Clockwise -> Part.CounterClockwise
      Part.CounterClockwise -> Part.Clockwise
