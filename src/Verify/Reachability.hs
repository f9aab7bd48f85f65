-- | Parts of a contour that a cutter can touch at all, and the rim of a pocket. The proof needs the
-- parts for a program that allows rest material.
--
-- A cutter touches a point of an element if its centre is on the normal at that point, at the
-- cutter's radius from it. The cutter can touch the point if no other element is then nearer to the
-- centre than the radius. The test looks at one element and its surroundings at a time, by
-- distances. It is independent of the trimming that made the toolpath.
module Verify.Reachability
  ( Surroundings,
    surroundings,
    parts,
    rim,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, times)
import Data.Containers.ListUtils (nubOrd)
import Data.List (foldl', sort, sortOn)
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Corner qualified as Corner
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance

-- | A contour as a cutter meets it.
data Surroundings = Surroundings
  { -- | the cutter's side of the contour
    cutterSide :: Side,
    -- | segments of the contour, grouped by the distance that the centre keeps from them
    kept :: [KeptDistance],
    -- | the segments and corners of an open contour in the opposite direction, in the same groups.
    -- The toolpath keeps the allowance of an element of an open contour on both of its sides
    back :: [KeptDistance],
    -- | tips of the cusps that are open towards the cutter. The cutter cannot enter them
    crevices :: [Point]
  }

-- | A distance, and the segments from which the centre keeps it: the cutter's radius plus the
-- allowances of the pass and of these segments.
data KeptDistance = KeptDistance Mm (BoxTree Segment)

-- | Interval of a segment: its beginning and end as fractions of the segment's length, from 0 to 1.
type Interval = (Double, Double)

-- Elements ----------------------------------------------------------------------------------------

-- | The surroundings of a cutter on @side@ of a contour. The segments come in the order of the
-- contour, with the distance that the centre keeps from each.
surroundings :: Ends -> Side -> [(Mm, Segment)] -> Surroundings
surroundings ends side elements =
  Surroundings
    { cutterSide = side,
      kept = grouped (elements <> cornerFans side corners <> endFans ends side elements),
      back = case ends of
        Closed -> []
        Open ->
          let reversed = reverse (map (fmap Segment.reverse) elements)
           in grouped (reversed <> cornerFans side (zip reversed (drop 1 reversed))),
      crevices =
        [ Segment.end s
          | ((_, s), (_, s')) <- corners,
            Corner.isCusp s s',
            let Rad turned = Corner.turning s s',
            Carrier.sideSign side * turned > 0
        ]
    }
  where
    grouped list =
      [ KeptDistance d (BoxTree.index BoundingBox.ofSegment [s | (d', s) <- list, d' == d])
        | d <- nubOrd (map fst elements)
      ]
    corners = zip elements $ case ends of
      Closed -> drop 1 elements <> take 1 elements
      Open -> drop 1 elements

-- | Corners of a contour, each with the larger one of the distances that the centre keeps from its
-- two elements. An outer corner is represented by an arc about the vertex, of the radius
-- 'fanRadius': its normals fill the space between the normals of both elements. Where this distance
-- is the smallest one of the contour, the corner is not listed, because there the distance from the
-- vertex decides.
cornerFans :: Side -> [((Mm, Segment), (Mm, Segment))] -> [(Mm, Segment)]
cornerFans side corners =
  [ (max d d', fan)
    | ((d, s), (d', s')) <- corners,
      max d d' > smallest,
      Just fan <- [outerCorner side fanRadius s s']
  ]
  where
    smallest = minimum (Mm (1 / 0) : concat [[d, d'] | ((d, _), (d', _)) <- corners])

-- | Both ends of an open contour, each with the distance that the centre keeps from the element
-- there. An end is represented like a corner: by half a circle about it. Empty for a closed
-- contour.
endFans :: Ends -> Side -> [(Mm, Segment)] -> [(Mm, Segment)]
endFans ends side elements = case (ends, elements, reverse elements) of
  (Open, (d, first) : _, (d', final) : _) ->
    [ (d, roundEnd (Segment.start first) (Vec.negate (Segment.startDirection first))),
      (d', roundEnd (Segment.end final) (Segment.endDirection final))
    ]
  _ -> []
  where
    roundEnd end outwards =
      Segment.arc
        (Carrier.senseAwayFrom side)
        end
        (Carrier.beside side fanRadius outwards end)
        (Carrier.beside (Carrier.oppositeSide side) fanRadius outwards end)

-- | The radius of the arcs that represent corners. It is negligible, and large enough for the
-- directions of points on the arc to be exact.
fanRadius :: Mm
fanRadius = times 0.1 Tolerance.clearance

-- | Parts of an element that a cutter can touch with its centre at @distance@ from the element. If
-- the distance kept from another segment is larger than @distance@, the centre has to keep it only
-- where it lies on a normal of such a segment. Elsewhere @distance@ is enough, because the toolpath
-- steps back to the smaller distance there.
parts :: Surroundings -> Mm -> Segment -> [Segment]
parts Surroundings {cutterSide, kept, back, crevices} distance element =
  case Segment.offset cutterSide distance element of
    Nothing -> []
    Just centres
      -- The cutter just fits into an arc: it touches the whole arc from one position, unless
      -- another element keeps it away from there.
      | Segment.length centres <= Tolerance.clearance,
        isKeptFrom (Segment.start centres) ->
        []
      | otherwise ->
        [ Segment.between a b element
          | (a, b) <- foldl' (freeOf cutterSide distance element centres) [(0, 1)] (kept <> back),
            b - a > Tolerance.negligibleShare,
            let p = Segment.at ((a + b) / 2) element
                c = Segment.at ((a + b) / 2) centres,
            times (b - a) (Segment.length element) > shortest
              || not (any (isTight . (`Segment.at` centres)) [(3 * a + b) / 4, (a + 3 * b) / 4]),
            not (any ((<= Mm Tolerance.cuspDepth) . Vec.distance p) crevices),
            not (isInMaterial cutterSide distance kept c)
        ]
  where
    isTight = isNearerThan clearlyNearer [(min d distance, tree) | KeptDistance d tree <- kept]
    isKeptFrom =
      isNearerThan Tolerance.clearance [(d, tree) | KeptDistance d tree <- kept, d > distance]

-- | Test that a point is nearer to a segment of one of the trees than the distance of that tree, by
-- more than @margin@.
isNearerThan :: Mm -> [(Mm, BoxTree Segment)] -> Point -> Bool
isNearerThan margin trees p =
  or [Distance.toPoint p s < minus d margin | (d, tree) <- trees, s <- segmentsWithin d p tree]

-- | Segments within a distance of a point, and perhaps some that are further away.
segmentsWithin :: Mm -> Point -> BoxTree Segment -> [Segment]
segmentsWithin d p = BoxTree.within (BoundingBox.inflate d (BoundingBox.ofPoints p []))

-- | The length below which a part of an element counts as touched only if the centre keeps its
-- distances without the margin of 'roomy' at both quarters of the part. The margin makes such parts
-- where the cutter just fits in a single position.
shortest :: Mm
shortest = times 100 Tolerance.clearance

-- | Test that a centre @p@ lies in the material: the segment nearest to it has @p@ on the side
-- opposite to @side@, and is clearly nearer than @distance@. In the tip of a cusp the test by
-- distances alone ('roomy') takes such centres for possible ones.
isInMaterial :: Side -> Mm -> [KeptDistance] -> Point -> Bool
isInMaterial side distance others p =
  or
    [ Segment.isBehind side s p
      | (d, s) <- take 1 (sortOn fst near),
        d < minus distance clearlyNearer
    ]
  where
    near =
      [ (Distance.toPoint p s, s)
        | KeptDistance _ tree <- others,
          s <- segmentsWithin distance p tree
      ]

-- | The least difference between two distances from a centre that is not due to rounding.
clearlyNearer :: Mm
clearlyNearer = times 0.01 Tolerance.clearance

-- | Parts of the intervals @free@ in which the centre of the cutter is not too near to the segments
-- @others@. @kept@ is the distance that the centre keeps from them. @centres@ is the path of the
-- centre along the element, at @distance@ on @side@.
freeOf :: Side -> Mm -> Segment -> Segment -> [Interval] -> KeptDistance -> [Interval]
freeOf side distance element centres free (KeptDistance kept others) =
  case compare kept distance of
    GT -> concatMap (withoutNormals side kept near centres) open
    EQ -> open
    LT -> concatMap (onThisSide element centres (BoxTree.within aroundBoth others)) open
  where
    near = BoxTree.within (BoundingBox.inflate kept (BoundingBox.ofSegment centres)) others
    open = common free (Distance.uncovered (roomy (min kept distance)) near centres)
    aroundBoth =
      BoundingBox.union (BoundingBox.ofSegment element) (BoundingBox.ofSegment centres)
    common xs ys = [(max a c, min b d) | (a, b) <- xs, (c, d) <- ys, max a c < min b d]

-- | Distance below which a centre counts as too near to a segment from which it has to keep the
-- distance @d@. It is smaller than @d@ by half of 'Tolerance.clearance'. So a cutter that just fits
-- is not rejected because of rounding.
roomy :: Mm -> Mm
roomy d = minus d (times 0.5 Tolerance.clearance)

-- | Parts of an interval in which none of the segments @near@ lies between the element and the path
-- @centres@. The centre keeps a smaller distance from @near@ than from the element; only such
-- segments can lie there.
onThisSide :: Segment -> Segment -> [Segment] -> Interval -> [Interval]
onThisSide element centres near (a, b) =
  [ (from, to)
    | (from, to) <- dividedAt marks (a, b),
      not (any (isBetween ((from + to) / 2)) near)
  ]
  where
    marks =
      concat
        [ [ Segment.fraction element p
            | p <-
                [Segment.start s, Segment.end s]
                  <> Distance.intersections element s
                  <> touchedByNormals element s
          ]
            <> [Segment.fraction centres p | p <- Distance.intersections centres s]
          | s <- near
        ]
    isBetween t s =
      let foot = Segment.at t element
       in any
            (\p -> Vec.distance foot p > Tolerance.clearance)
            (Distance.intersections (Straight foot (Segment.at t centres)) s)

-- | Points at which normals of an element touch the circle of an arc. Normals on one side of such a
-- point cross the circle, those on the other side do not. Empty for a line.
touchedByNormals :: Segment -> Segment -> [Point]
touchedByNormals element s = case (s, element) of
  (Straight _ _, _) -> []
  (Arc {start, centre}, Straight _ _) ->
    [ Vec.shift (Vec.scale (k * r) along) centre
      | let Mm r = Segment.radius centre start,
        k <- [-1, 1]
    ]
    where
      along = Vec.unit (Segment.startDirection element)
  (Arc {start, centre}, Arc {centre = origin}) ->
    [ Vec.shift (Vec.scale (r / d) (Vec.rotate (Rad (k * acos (r / d))) away)) centre
      | let Mm r = Segment.radius centre start,
        let d = Vec.norm away,
        r < d,
        k <- [-1, 1]
    ]
    where
      away = Vec.to centre origin

-- | Parts of an interval in which each centre keeps the distance @kept@ from all segments on whose
-- normals it lies. @near@ are the segments from which the centre keeps the distance @kept@. @kept@
-- is larger than the distance that the centre keeps from the element.
withoutNormals :: Side -> Mm -> [Segment] -> Segment -> Interval -> [Interval]
withoutNormals side kept near centres (a, b) =
  [ (from, to)
    | (from, to) <- dividedAt marks (a, b),
      not (any (isAbove (Segment.at ((from + to) / 2) centres)) near)
  ]
  where
    marks =
      [ Segment.fraction centres p
        | border <- concatMap (bordersOf side kept) near,
          p <- Distance.intersections centres border
      ]
    isAbove p s = Segment.hasFootOf s p && Distance.toPoint p s < roomy kept

-- | Border of the region that the normals of a segment fill on @side@, up to the length @kept@: the
-- offset at their ends, and the first and the last normal. The normals of an arc end at its centre.
bordersOf :: Side -> Mm -> Segment -> [Segment]
bordersOf side kept s = case (Segment.offset side kept s, s) of
  (Just offset, _) ->
    [ offset,
      Straight (Segment.start s) (Segment.start offset),
      Straight (Segment.end s) (Segment.end offset)
    ]
  (Nothing, Arc {start, end, centre}) -> [Straight start centre, Straight end centre]
  (Nothing, Straight _ _) -> []

-- | Intervals into which the marks inside an interval divide it. A mark is a fraction like the
-- interval's ends.
dividedAt :: [Double] -> Interval -> [Interval]
dividedAt marks (a, b) = zip (a : inside) (inside <> [b])
  where
    inside = sort [t | t <- marks, t > a, t < b]

-- Pockets -----------------------------------------------------------------------------------------

-- | Rim of a pocket with the closed contours @contours@: the border of the region in which centres
-- lie on @side@ of the contours, at least @distance@ away from them. The rim consists of offsets of
-- the segments and of arcs round outer corners, without the parts that are too near to a segment.
-- Each curve of the rim comes with the number of the segment to which it belongs, counted from 0
-- over all contours. @segments@ is a tree of all segments of the contours.
rim :: Side -> Mm -> BoxTree Segment -> [[Segment]] -> [(Int, Segment)]
rim side distance segments contours =
  concatMap free (concat (zipWith around firstNumbers contours))
  where
    firstNumbers = scanl (+) 0 (map length contours)
    around first contour =
      concat (zipWith3 offsets [first ..] contour (drop 1 contour <> take 1 contour))
    offsets i s next =
      [ (i, c)
        | Just c <- [Segment.offset side distance s, outerCorner side distance s next]
      ]
    -- Parts of an offset that are not too near to any segment.
    free (i, s) =
      [ (i, Segment.between a b s)
        | (a, b) <-
            Distance.uncovered
              (minus distance Tolerance.clearance)
              (BoxTree.within (BoundingBox.inflate distance (BoundingBox.ofSegment s)) segments)
              s,
          b - a > Tolerance.negligibleShare
      ]

-- Offsets -----------------------------------------------------------------------------------------

-- | Smallest change of direction, in radians, at a corner that gets an arc round it.
smallestTurn :: Double
smallestTurn = 1e-9

-- | Path of the centre round the corner between @s@ and @next@: an arc about the corner. Nothing if
-- the contour does not turn away from the cutter there.
outerCorner :: Side -> Mm -> Segment -> Segment -> Maybe Segment
outerCorner side distance s next
  | Carrier.sideSign side * t < negate smallestTurn =
    Just
      Arc
        { start = off (Segment.endDirection s),
          end = off (Segment.startDirection next),
          centre,
          sweep = turned
        }
  | otherwise = Nothing
  where
    turned@(Rad t) = Corner.turning s next
    centre = Segment.end s
    off direction = Carrier.beside side distance (Vec.unit direction) centre
