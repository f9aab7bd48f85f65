-- | Stock that the cutter has not removed yet.
--
-- Stock is given by solids. A solid is the points over a region of the plane up to a height. The
-- stock at a height is removed where the tip of a cutter has been at this height or below it, at
-- feed: within the radius of the tip of its path. So it is never under-estimated. A turning tool
-- also removes what lies behind its nose ("Part.TurnedArea").
--
-- A /probe/ is the place of a tool, or of a part of it, during a motion: the points within a
-- distance of a path, above a level. The question is where, just above the level, stock remains in
-- the probe, that is, in the region /U/ of all points that are in the probe and in the solid and
-- within reach of no removal. If U is not empty, its boundary consists of pieces of the boundaries
-- of the probe, of the solid and of the removals. So it is enough to examine these boundaries.
-- Those of the removals are moved outwards by 'hair', and that of the probe inwards. Then a point
-- of them lies in U exactly if no removal covers it, even where boundaries coincide.
module Verify.RemainingStock
  ( StockSolid (..),
    Base (..),
    solidOver,
    boxOfSolid,
    Removal (..),
    Removals,
    removalsOf,
    Probe (..),
    remaining,
  )
where

import Base.Quantity (Mm (..), minus, over, plus, times)
import Data.Containers.ListUtils (nubOrdOn)
import Data.List (minimumBy, nub, sort)
import Data.List qualified as List
import Data.Maybe (isJust, listToMaybe)
import Data.Ord (comparing)
import Geometry.Distance (ClosestPoint (distance))
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Part.TurnedArea (OpenSide)
import Part.TurnedArea qualified as TurnedArea

-- | Solid: the points over its base, between two heights.
data StockSolid = StockSolid {base :: Base, bottom :: Mm, top :: Mm}

-- | Region of the plane.
data Base
  = -- | the whole plane
    Everywhere
  | -- | the region inside of its boundary and outside of its holes: the segments of all these, in
    -- either direction, and a box around them
    Bounded (BoxTree Segment) BoundingBox

-- | Solid over the region inside closed contours, between two heights; a contour inside another one
-- bounds a hole. The contours are given by their segments. Nothing without segments.
solidOver :: (Mm, Mm) -> [Segment] -> Maybe StockSolid
solidOver (low, high) boundary = case map BoundingBox.ofSegment boundary of
  [] -> Nothing
  b : bs ->
    Just
      StockSolid
        { base =
            Bounded
              (BoxTree.index BoundingBox.ofSegment boundary)
              (List.foldl' BoundingBox.union b bs),
          bottom = low,
          top = high
        }

-- | Bounding box of the base of a solid; that of the reach of all machines for the whole plane.
boxOfSolid :: StockSolid -> BoundingBox
boxOfSolid solid = case base solid of
  Everywhere -> BoundingBox.inflate Tolerance.reach (BoundingBox.ofPoints (Vec.point 0 0) [])
  Bounded _ box -> box

-- | Motion that removes stock: the points within its radius of its path.
data Removal = Removal
  { -- | number of the motion in the order of the tape
    order :: Int,
    track :: Segment,
    -- | heights of the tip at the start and at the end
    fromTip, toTip :: Mm,
    width :: Mm,
    -- | height of the cutter's point, above which it has the radius 'width'; 0 without a point
    point :: Mm,
    -- | number of the tool
    tool :: Int,
    -- | for a turning tool, the side from which it comes
    openSide :: Maybe OpenSide
  }

-- | All removals of a tape, and the largest radius among them.
data Removals = Removals (BoxTree Removal) Mm

-- | Index of removals.
removalsOf :: [Removal] -> Removals
removalsOf rs =
  Removals
    (BoxTree.index boxOfRemoval rs)
    (List.foldl' max (Mm 0) (map width rs))

-- | Bounding box of the path of a removal and of the area behind a turning tool.
boxOfRemoval :: Removal -> BoundingBox
boxOfRemoval r =
  List.foldl'
    (\box p -> BoundingBox.union box (BoundingBox.ofPoints p []))
    (BoundingBox.ofSegment (track r))
    (cornersBehind (Mm 0) (track r) r)

-- | Corners of the area that a turning tool removes behind its nose on a part of its path; empty
-- for other tools. See 'TurnedArea.areaBehind' for the growth.
cornersBehind :: Mm -> Segment -> Removal -> [Point]
cornersBehind growth part r = case openSide r of
  Nothing -> []
  Just side -> TurnedArea.areaBehind growth side (width r) part

-- | Place of a part of a tool during a motion.
data Probe = Probe
  { -- | number of the motion in the order of the tape; the removals before it count
    at :: Int,
    path :: Segment,
    reach :: Mm,
    level :: Mm,
    -- | number of the tool, whose point fits into the holes that it has drilled
    byTool :: Int
  }

-- | Point of the solid's stock that remains in the probe just above its level, if possible near the
-- beginning of its path. Nothing if there is none.
remaining :: Removals -> StockSolid -> Probe -> Maybe Point
remaining removals solid given
  | reach probe <= hair || top solid <= level probe || not (meetsBase solid probe) = Nothing
  | isQuicklyCovered probe gone = Nothing
  | otherwise = case filter (isInside (base solid)) inner of
    [] -> listToMaybe (filter (isInside (base solid)) (concatMap around gone) <> rim)
    ps -> Just (minimumBy (comparing (Vec.distance (Segment.start (path probe)))) ps)
  where
    -- Below its bottom, the solid ends.
    probe = given {level = max (level given) (bottom solid)}
    gone = removalsNear removals probe
    -- Middles of the parts of segments that no removal covers.
    exposed pieces =
      [ Segment.at 0.5 s
        | piece <- pieces,
          s <- bare [piece] (filter (mayCover piece) gone)
      ]
    mayCover piece g = BoundingBox.meets (BoundingBox.ofSegment piece) (swept g)
    bare pieces others = case others of
      g : more | not (null pieces) -> bare (outsideArea (outside g pieces) g) more
      _ -> pieces
    inner =
      exposed (concatMap inProbe (Distance.neighbourhood (minus (reach probe) hair) (path probe)))
    around g =
      exposed . concatMap inProbe $
        Distance.neighbourhood (plus (within' g) hair) (ofPath g) <> loop (behind g hair)
    rim = case base solid of
      Everywhere -> []
      Bounded boundary _ -> exposed (concatMap inProbe (BoxTree.within (boxOf probe) boundary))
    -- The boundary of a neighbourhood is given by whole circles. Only their parts in the probe
    -- count. Parts inside it are no boundary, but a point on them that nothing covers is left too.
    inProbe = within (minus (reach probe) (times 0.5 hair)) (path probe)

-- | Distance in mm by which boundaries are moved so that they do not coincide.
hair :: Mm
hair = Mm 1e-5

-- | Bounding box of a probe.
boxOf :: Probe -> BoundingBox
boxOf probe = BoundingBox.inflate (reach probe) (BoundingBox.ofSegment (path probe))

-- | Test that a probe has a point in common with the base of a solid.
meetsBase :: StockSolid -> Probe -> Bool
meetsBase solid probe = case base solid of
  Everywhere -> True
  Bounded boundary box ->
    BoundingBox.meets (boxOf probe) box
      && ( any isNear (BoxTree.within (boxOf probe) boundary)
             || isInside (base solid) (Segment.start (path probe))
         )
  where
    isNear s = distance (Distance.segments s (path probe)) < reach probe

-- | Test that a point lies in a region.
isInside :: Base -> Point -> Bool
isInside region p = case region of
  Everywhere -> True
  Bounded boundary box ->
    BoundingBox.distance p box <= Mm 0 && odd (WindingNumber.about p (BoxTree.toList boundary))

-- | Stock that a removal has removed at a level.
data Gone = Gone
  { -- | radius of the tool
    within' :: Mm,
    -- | part of the path on which the tip was low enough
    ofPath :: Segment,
    -- | corners of the area behind a turning tool, by their growth
    behind :: Mm -> [Point],
    -- | box around all that is removed, with some room
    swept :: BoundingBox
  }

-- | Removals before a probe that have removed stock in it at its level.
removalsNear :: Removals -> Probe -> [Gone]
removalsNear (Removals tree widest) probe =
  [ Gone
      { within' = width r,
        ofPath = s,
        behind = \growth -> cornersBehind growth s r,
        swept = BoundingBox.inflate (plus (width r) hair) (boxOfRemoval r {track = s})
      }
    | (r, s) <- nubOrdOn (\(r, s) -> (width r, openSide r, s)) candidates
  ]
  where
    -- The passes of a statement at several depths have the same paths.
    candidates =
      [ (r, s)
        | r <- BoxTree.within (BoundingBox.inflate widest (boxOf probe)) tree,
          order r < at probe,
          Just s <- [lowPart (limit r) r],
          isJust (openSide r)
            || distance (Distance.segments s (path probe)) < plus (width r) (reach probe)
      ]
    limit r = if tool r == byTool probe then level probe else minus (level probe) (point r)

-- | Part of a removal's path on which the tip is at a height or below it. A vertical motion leaves
-- the tip at its lower end.
lowPart :: Mm -> Removal -> Maybe Segment
lowPart limit Removal {track, fromTip, toTip}
  | max fromTip toTip <= limit = Just track
  | min fromTip toTip > limit = Nothing
  | Segment.length track <= Mm 0 = Just track
  | fromTip <= limit = Just (Segment.between 0 share track)
  | otherwise = Just (Segment.between share 1 track)
  where
    share = over (minus limit fromTip) (minus toTip fromTip)

-- | Test by bounds that removals cover a whole probe. True is certain, False proves nothing.
isQuicklyCovered :: Probe -> [Gone] -> Bool
isQuicklyCovered probe gone = any covers (nub (filter (>= reach probe) (map within' gone)))
  where
    covers r =
      let Mm slack = minus r (reach probe)
       in FastDistance.isCovered
            slack
            pure
            (const True)
            [ofPath g | g <- gone, within' g >= r]
            (path probe)

-- | Parts of segments out of the reach of a tool on the path of its removal.
outside :: Gone -> [Segment] -> [Segment]
outside g pieces =
  [ Segment.between a b s
    | s <- pieces,
      (a, b) <- Distance.uncovered (plus (within' g) (times 0.5 hair)) [ofPath g] s,
      times (b - a) (Segment.length s) > times 0.01 hair
  ]

-- | Parts of segments that are outside of the area behind a turning tool.
outsideArea :: [Segment] -> Gone -> [Segment]
outsideArea pieces g
  | null outline = pieces
  | otherwise = filter isOutside (concatMap cut pieces)
  where
    outline = loop (behind g (times 0.5 hair))
    isOutside s = WindingNumber.about (Segment.at 0.5 s) outline == 0
    cut s =
      [ Segment.between a b s
        | (a, b) <- zip (0 : marks) (marks <> [1]),
          times (b - a) (Segment.length s) > times 0.01 hair
      ]
      where
        marks =
          sort
            [ t
              | o <- outline,
                p <- Distance.intersections s o,
                let t = Segment.fraction s p,
                t > 0,
                t < 1
            ]

-- | Closed chain of lines through points; empty without points.
loop :: [Point] -> [Segment]
loop ps = zipWith Straight ps (drop 1 ps <> take 1 ps)

-- | Parts of a segment that are at most a distance away from a path.
within :: Mm -> Segment -> Segment -> [Segment]
within d other s =
  [ Segment.between a b s
    | (a, b) <- complement 0 (Distance.uncovered d [other] s),
      b > a
  ]
  where
    complement from gaps = case gaps of
      [] -> [(from, 1)]
      (a, b) : more -> (from, a) : complement b more
