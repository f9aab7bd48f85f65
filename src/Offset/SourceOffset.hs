-- | The exact offset of each single element of a contour, and of each of its corners.
--
-- A line is moved along its normal. An arc keeps its centre and changes its radius. The cutter's
-- centre rounds an outer corner on an arc about the vertex. Each offset is computed from its
-- element or corner alone, so rounding errors do not add up along a toolpath.
--
-- The coordinates of a toolpath beside a contour come from here, except at the intersections of the
-- offsets of distant elements. This module does not decide which parts of an offset the cutter can
-- reach; "Offset.Kernel" does.
--
-- Elements are numbered from 0. A corner has the number of the element before it.
module Offset.SourceOffset
  ( -- * The request
    CornerStyle (..),
    OffsetSource (..),
    fromContour,
    elementCount,
    next,
    distanceAt,

    -- * Segments of an offset
    OffsetSegment (..),
    Origin (..),
    numberOf,

    -- * Elements
    movedElement,
    shortened,

    -- * Corners
    Corner (..),
    cornerAt,
    isCusp,
    Cuts (..),
    noCuts,
    cutsAt,
    cornerArc,
    cornerPoints,
    cornerStep,
    sharpCorner,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Ord (comparing)
import Data.Primitive.PrimArray (PrimArray, generatePrimArray, indexPrimArray)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Polyarc (Ends (..), Polyarc (Polyarc))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance

-- | The shape of outer corners, and the extra distances from single elements.
data CornerStyle = CornerStyle
  { -- | True: two lines along the tangents of both offsets to their intersection; False: an arc
    -- about the vertex. A corner gets an arc in any case if it turns by more than 120°, or if its
    -- elements have different distances
    sharp :: Bool,
    -- | extra distance in mm from an element, by the element's number; not negative
    extra :: Int -> Mm
  }

-- | A contour, and the request for an offset of it.
data OffsetSource = OffsetSource
  { style :: CornerStyle,
    -- | the cutter's side of the contour
    side :: Side,
    -- | the cutter's radius in mm, not negative. The offset's distance from an element is this
    -- radius plus the element's extra distance
    radius :: Mm,
    -- | elements of the contour in order; at least one
    elements :: Vector Segment,
    ends :: Ends,
    -- | angle by which the direction changes after each element, in radians, counter-clockwise
    -- positive; 0 after the last element of an open contour
    turnings :: PrimArray Double
  }

-- | The request for an offset of a contour: the style of corners, the cutter's side, the cutter's
-- radius in mm, and the contour.
fromContour :: CornerStyle -> Side -> Mm -> Polyarc -> OffsetSource
fromContour style side radius (Polyarc ends segments) =
  OffsetSource {style, side, radius, elements, ends, turnings = generatePrimArray count turning}
  where
    count = NonEmpty.length segments
    elements = Vector.fromListN count (NonEmpty.toList segments)
    turning i
      | i + 1 == count && ends == Open = 0
      | otherwise =
        let Rad angle =
              Vec.signedAngle
                (Segment.endDirection (elements Vector.! i))
                (Segment.startDirection (elements Vector.! (if i + 1 == count then 0 else i + 1)))
         in angle

-- | The number of elements of the contour.
elementCount :: OffsetSource -> Int
elementCount = Vector.length . elements

-- | The number of the element after element @i@. The first one follows the last one.
next :: OffsetSource -> Int -> Int
next source i = if i + 1 == elementCount source then 0 else i + 1

-- | The distance in mm of the offset from element @i@.
distanceAt :: OffsetSource -> Int -> Mm
distanceAt source i = plus (radius source) (extra (style source) i)

-- | A segment of an offset, and the part of the contour that it belongs to.
data OffsetSegment = OffsetSegment {origin :: Origin, segment :: Segment}
  deriving stock (Eq, Show)

-- | An element of the contour ('Along'), or the corner after it ('Around'), by the element's number
-- from 0.
data Origin = Along Int | Around Int
  deriving stock (Eq, Show)

-- | The order in which the elements and corners follow each other along the contour.
instance Ord Origin where
  compare = comparing $ \case
    Along i -> (i, False)
    Around i -> (i, True)

-- | The number of the element, or of the element before the corner.
numberOf :: Origin -> Int
numberOf origin = case origin of
  Along i -> i
  Around i -> i

-- | The offset of element @i@. An arc that is moved towards its centre by its radius or more
-- becomes a point.
movedElement :: OffsetSource -> Int -> Segment
movedElement source i = case elements source Vector.! i of
  line@(Straight _ _) -> fromMaybe line (Segment.offset (side source) distance line)
  Arc {start, end, centre, sweep} ->
    let Mm before = Segment.radius centre start
        Mm after = max (Mm 0) (Segment.offsetRadius (side source) distance sweep (Mm before))
        moved p = Vec.shift (Vec.scale (after / before) (Vec.to centre p)) centre
     in Arc {start = moved start, end = moved end, centre, sweep}
  where
    distance = distanceAt source i

-- | The part of the segment @s@ that remains when the lengths @front@ and @back@ in mm are cut off
-- its start and its end. Their sum is smaller than the segment's length.
shortened :: Double -> Double -> Segment -> Segment
shortened front back s
  | front + back <= 0 = s
  | otherwise = snd (Segment.cutAt (front / (l - back)) (fst (Segment.cutAt (1 - back / l) s)))
  where
    Mm l = Segment.length s

-- | The kind of a corner between two elements.
data Corner
  = -- | none: an open contour ends here
    NoCorner
  | -- | a smooth joint: the direction changes by no more than 'Tolerance.smoothAngle'
    Smooth
  | -- | turns towards the cutter by a small angle θ: the gap between the vertex and the cutter's
    -- edge is at most 'Tolerance.smallestRest'. The number is the length @r·tan(θ/2)@ in mm, with
    -- the offset's distance @r@, by which the offsets of lines before and after the corner are
    -- shortened. Curves through measured points have such corners
    Slight Double
  | -- | turns towards the cutter, and the cutter does not reach into the corner
    Blocked
  | -- | turns away from the cutter, or by half a turn; for the radius 0 also a corner that would
    -- block a larger cutter
    Outer
  deriving stock (Eq)

-- | The kind of the corner after element @i@.
cornerAt :: OffsetSource -> Int -> Corner
cornerAt source i
  | ends source == Open && i + 1 == elementCount source = NoCorner
  | abs turned <= smooth = Smooth
  | isInner && r1 == distanceAt source (next source i), Just t <- slight r1 = Slight t
  | isInner && radius source > Mm 0 && not (isCusp source i) = Blocked
  | otherwise = Outer
  where
    isInner = turned * Carrier.sideSign (side source) > 0
    r1 = distanceAt source i
    turned = indexPrimArray (turnings source) i
    Rad smooth = Tolerance.smoothAngle
    slight (Mm r) =
      let Mm rest = Tolerance.smallestRest
       in if r * (1 / cos (turned / 2) - 1) <= rest
            then Just (r * tan (abs turned / 2))
            else Nothing

-- | True when the contour turns back after element @i@: its direction changes by half a turn, to
-- 'Tolerance.cuspAngle'. The vertex is either the tip of a thin part of the material, which the
-- cutter goes round, or the end of a crevice that the cutter cannot enter. Only the kernel's loop
-- shows which of the two it is.
isCusp :: OffsetSource -> Int -> Bool
isCusp source i = Rad (pi - abs (indexPrimArray (turnings source) i)) <= Tolerance.cuspAngle

-- | Lengths in mm by which the segment before a corner is shortened at its end, and the segment
-- after it at its start.
data Cuts = Cuts {back :: Double, front :: Double}

noCuts :: Cuts
noCuts = Cuts 0 0

-- | The lengths cut off at the corner after element @i@, given the offsets of the elements before
-- and after the corner. They are 0 at every corner that is not slight.
cutsAt :: OffsetSource -> Int -> Segment -> Segment -> Cuts
cutsAt source i before after = case cornerAt source i of
  Slight t -> meeting t before after
  Smooth -> noCuts
  Outer -> noCuts
  Blocked -> noCuts
  NoCorner -> noCuts

-- | The lengths to cut off the end of one segment and the start of the next one, so that both meet
-- at their intersection. For two lines both lengths are @t@ mm, the number of the 'Slight' corner.
-- If a segment is an arc, Newton's method finds the lengths to rounding, in three steps from @t@.
-- Each step replaces the segments by their tangents. Both lengths are @t@ if a step gives a length
-- that is not between 0 and @2·t@, or not less than the length of the segment.
meeting :: Double -> Segment -> Segment -> Cuts
meeting t before after = case (before, after) of
  (Straight _ _, Straight _ _) -> Cuts t t
  _ -> newton (3 :: Int) t t
  where
    Mm l = Segment.length before
    Mm l' = Segment.length after
    newton steps a b
      | steps == 0 = Cuts a b
      | a' > 0 && a' < min l (2 * t) && b' > 0 && b' < min l' (2 * t) = newton (steps - 1) a' b'
      | otherwise = Cuts t t
      where
        (k, k') = (1 - a / l, b / l')
        (u, v) = (Segment.directionAt k before, Segment.directionAt k' after)
        gap = Vec.to (Segment.at k before) (Segment.at k' after)
        a' = a - Vec.cross gap v / Vec.cross u v
        b' = b - Vec.cross u gap / Vec.cross u v

-- | The arc on which the cutter's centre rounds the corner after element @i@. Its radius is the
-- larger one of both elements' distances.
cornerArc :: OffsetSource -> Int -> Segment
cornerArc source i =
  Segment.arc
    (Carrier.senseAwayFrom (side source))
    (Segment.end before)
    (beside source i wide (Segment.endDirection before))
    (beside source i wide (Segment.startDirection (elements source Vector.! next source i)))
  where
    before = elements source Vector.! i
    wide = max (distanceAt source i) (distanceAt source (next source i))

-- | The point at @distance@ from the corner after element @i@, on the cutter's side and square to
-- @direction@, a vector of length 1.
beside :: OffsetSource -> Int -> Mm -> Vec.Vec -> Point
beside source i distance direction =
  Carrier.beside (side source) distance direction (Segment.end (elements source Vector.! i))

-- | The points at which lines of the offset at the corner after element @i@ can start or end. Two
-- of them lie beside the vertex, square to the direction at the end of element @i@, at the
-- distances of both elements. Two others lie square to the direction at the start of the next
-- element. A sharp corner has its tip as well.
cornerPoints :: OffsetSource -> Int -> [Point]
cornerPoints source i =
  [beside source i r direction | direction <- [before, after], r <- [r1, r2]]
    <> [tip source i | isSharp source i]
  where
    before = Segment.endDirection (elements source Vector.! i)
    after = Segment.startDirection (elements source Vector.! next source i)
    r1 = distanceAt source i
    r2 = distanceAt source (next source i)

-- | The line at the corner after element @i@ that joins the end of this element's offset to the
-- start of the next one's. Nothing when both elements have the same distance, at 'Slight' and
-- 'Blocked' corners, and at the end of an open contour.
cornerStep :: OffsetSource -> Int -> Maybe Segment
cornerStep source i = case cornerAt source i of
  Smooth -> step
  Outer -> step
  Slight _ -> Nothing
  Blocked -> Nothing
  NoCorner -> Nothing
  where
    step
      | r1 == r2 = Nothing
      | otherwise =
        Just
          ( Straight
              (beside source i r1 (Segment.endDirection (elements source Vector.! i)))
              (beside source i r2 (Segment.startDirection (elements source Vector.! next source i)))
          )
    r1 = distanceAt source i
    r2 = distanceAt source (next source i)

-- | The two lines of the offset at the corner after element @i@. Nothing when the offset is not
-- sharp there.
sharpCorner :: OffsetSource -> Int -> Maybe (Segment, Segment)
sharpCorner source i
  | cornerAt source i == Outer && isSharp source i =
    Just
      ( Straight (at (Segment.endDirection (elements source Vector.! i))) top,
        Straight top (at (Segment.startDirection (elements source Vector.! next source i)))
      )
  | otherwise = Nothing
  where
    at = beside source i (distanceAt source i)
    top = tip source i

-- | True when the offset of the corner after element @i@ is sharp: the request asks for sharp
-- corners, both elements have the same distance, and the corner turns by at most 120°.
isSharp :: OffsetSource -> Int -> Bool
isSharp source i =
  sharp (style source)
    && distanceAt source i == distanceAt source (next source i)
    && abs (indexPrimArray (turnings source) i) <= 2 * pi / 3

-- | The intersection of the tangents of both offsets at the corner after element @i@.
tip :: OffsetSource -> Int -> Point
tip source i =
  Vec.shift (Vec.scale (r * tan (abs turned / 2)) before) (beside source i (Mm r) before)
  where
    Mm r = distanceAt source i
    turned = indexPrimArray (turnings source) i
    before = Segment.endDirection (elements source Vector.! i)
