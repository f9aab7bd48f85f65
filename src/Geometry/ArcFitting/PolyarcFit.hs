{-# LANGUAGE BangPatterns #-}
-- The inner loop has more than ten unboxed arguments; under the default limit they would be boxed.
{-# OPTIONS_GHC -O2 -fno-full-laziness -fmax-worker-args=40 #-}

-- | Arc fitting of polyarcs by biarcs, with an error bound in closed form.
--
-- The bound and the arcs are those of "Geometry.ArcFitting.ArcDistance". The function F of a
-- position is 0 on the circle of an arc. The largest |F| along a curve gives a bound of the curve's
-- distance from the arc. The bound holds only if the curve runs forwards: its direction makes an
-- angle of less than a quarter turn with the arc's directions at both ends.
--
-- Along a segment that sweeps less than a quarter turn, F has at most one extremum. It lies where
-- the slope @F′ = d_y − k·(x·d_x + y·d_y)@ is 0. Here k is the arc's curvature, (x, y) the position
-- on the segment, and d the segment's direction there. The coordinates have their origin at the
-- arc's start and the x axis in the arc's direction at its start. The slope is nearly linear from
-- one end of the segment to the other.
--
-- A polyarc is a chain of lines and arcs. Its parameter is the arc length in mm. Segments are
-- counted from 0. A stretch is the part between two corners, given by the index @from@ of its first
-- segment and the index @to@ after its last. A pose is a position in mm with a unit direction.
module Geometry.ArcFitting.PolyarcFit
  ( approximate,
    simplified,
    smoothed,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Base.Quantity (Mm (..), Rad (..))
import Control.Monad (foldM_)
import Control.Monad.ST (ST, runST)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Unboxed
import Data.Vector.Unboxed.Mutable qualified as Mutable
import Geometry.ArcFitting.ArcDistance
import Geometry.ArcFitting.Biarc.Fast (FastBiarc (..), Pose (..))
import Geometry.ArcFitting.Biarc.Fast qualified as FastBiarc
import Geometry.ArcFitting.Builder qualified as Builder
import Geometry.ArcFitting.LongestBiarc (ArcDistances (..), ParameterRange (..), Spans (..))
import Geometry.ArcFitting.LongestBiarc qualified as LongestBiarc
import Geometry.ArcFitting.ParametricFit (OneSided (..), ParametricCurve (ParametricCurve))
import Geometry.ArcFitting.ParametricFit qualified as ParametricFit
import Geometry.Carrier qualified as Carrier
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Polyarc (Polyarc)
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec

-- | Polyarc in arrays. @stations@ are the arc lengths in mm at the starts of the segments; the last
-- entry is the whole length. @entries@ has seven numbers per segment: x and y of the start in mm,
-- the unit directions at the start and at the end, and the curvature in 1/mm, positive to the left.
data SegmentTable = SegmentTable {stations :: Vector Double, entries :: Vector Double}

-- | Arcs and lines within a tolerance of a polyarc. The tolerance holds from the polyarc to the
-- result and from the result to the polyarc. The fit is greedy: each biarc is as long as possible.
-- Corners are kept. Every segment of the input must be longer than 0.
approximate :: Mm -> NonEmpty Segment -> FlatPolyarc
approximate (Mm tolerance) segments = runST $ do
  vertices <- Builder.new
  LongestBiarc.forStretches n (hasCorner chain) $ \from to ->
    LongestBiarc.along
      vertices
      (tolerance * (1 - Tolerance.roundingShare))
      (stretchRange chain from to)
      (stretchSpans tolerance chain from to)
  Builder.push vertices (Vec.x end) (Vec.y end) 0
  Builder.polyarc vertices
  where
    chain = tableOf segments
    n = Unboxed.length (stations chain) - 1
    end = Segment.end (NonEmpty.last segments)

-- | A polyarc of fewer lines and arcs within a tolerance, as 'approximate' finds it, if that halves
-- their count. This is so for contours of curves, which have very many arcs. Others are kept.
simplified :: Mm -> Polyarc -> Polyarc
simplified tolerance contour
  | 2 * NonEmpty.length fewer <= NonEmpty.length every = contour {Polyarc.segments = fewer}
  | otherwise = contour
  where
    every = Polyarc.segments contour
    fewer =
      MeasuredPolyarc.segments
        (MeasuredPolyarc.fromFlatPolyarc (approximate tolerance every))

-- | Parameter range of the segments @from@ to @to − 1@, in arc length. The step that is tried first
-- is the whole range.
stretchRange :: SegmentTable -> Int -> Int -> ParameterRange
stretchRange chain from to = ParameterRange {inSpan = from, begin, final, step = final - begin}
  where
    begin = station chain from
    final = station chain to

-- | The segments @from@ to @to − 1@ as a curve for the fit, within @tolerance@ (mm).
stretchSpans :: Double -> SegmentTable -> Int -> Int -> Spans
stretchSpans tolerance chain from to =
  Spans
    { seek = seekFrom chain to,
      pose = poseWithin chain from to,
      LongestBiarc.arcDistances = biarcDistances chain,
      fallback = generalFit,
      isHopeless = isTooFar chain,
      triesLonger = True
    }
  where
    n = Unboxed.length (stations chain) - 1
    -- The cost of the fit by "Geometry.ArcFitting.ParametricFit" grows with the count of segments.
    -- Therefore it gets only the current segment and the next 63.
    generalFit u =
      let i = min (to - 1) (BinarySearch.lastAtMost n u (stations chain))
          end = min to (i + 64)
       in ParametricFit.oneBiarc (Mm tolerance) (parametricCurve chain i end) (station chain end) u
{-# INLINE stretchSpans #-}

-- | Polyarc within a tolerance of a given one, without kinks except at corners. A kink is a joint
-- at which the direction changes by more than 'Tolerance.smoothAngle'. A corner is a kink at which
-- it changes by more than 'Tolerance.kink'. A stretch without a kink is kept, but neighbouring arcs
-- on one circle are merged. A stretch with kinks is replaced by the result of 'approximate'.
smoothed :: Mm -> NonEmpty Segment -> NonEmpty Segment
smoothed tolerance (first :| others) = groups (first :| []) first False others
  where
    groups before@(b :| earlier) s hasKink rest = case rest of
      [] -> finished hasKink before
      next : more
        | jump > Tolerance.kink -> finished hasKink before <> groups (next :| []) next False more
        | jump > Tolerance.smoothAngle -> groups (NonEmpty.cons next before) next True more
        | otherwise ->
          groups
            (maybe (NonEmpty.cons next before) (:| earlier) (mergedArc b next))
            next
            hasKink
            more
        where
          jump =
            let Rad a =
                  Vec.signedAngle (Segment.endDirection s) (Segment.startDirection next)
             in Rad (abs a)
    finished hasKink before
      | hasKink =
        MeasuredPolyarc.segments
          (MeasuredPolyarc.fromFlatPolyarc (approximate tolerance (NonEmpty.reverse before)))
      | otherwise = NonEmpty.reverse before

-- | One arc in place of two consecutive arcs. Nothing if they do not lie on one circle, up to
-- rounding, if their senses differ, or if they sweep more than half a turn together.
mergedArc :: Segment -> Segment -> Maybe Segment
mergedArc s next = case (s, next) of
  (Arc {start, centre, sweep = Rad a}, Arc {end, sweep = Rad b})
    | signum a == signum b
        && abs (a + b) <= pi
        && all (isOnCircle centre (Segment.radius centre start)) [Segment.at 0.5 next, end]
        && Rad (abs (bend both)) <= Tolerance.oneArc ->
      Just both
    where
      both = Segment.arc (Carrier.senseOf (Rad a)) centre start end
  _ -> Nothing
  where
    isOnCircle c (Mm r) p = let Mm d = Vec.distance c p in Mm (abs (d - r)) <= Tolerance.arcLength
    bend both =
      let Rad t = Vec.signedAngle (Segment.endDirection next) (Segment.endDirection both) in t

-- | Table of a polyarc.
tableOf :: NonEmpty Segment -> SegmentTable
tableOf segments =
  SegmentTable
    { stations =
        Unboxed.scanl'
          (+)
          0
          (Unboxed.fromListN n (map (\s -> let Mm l = Segment.length s in l) list)),
      entries =
        Unboxed.create
          (Mutable.unsafeNew (7 * n) >>= \array -> array <$ foldM_ (writeSegment array) 0 list)
    }
  where
    n = NonEmpty.length segments
    list = NonEmpty.toList segments

-- | Writes the seven numbers of a segment to an array from index @i@ on; returns the index after
-- them.
writeSegment :: Mutable.MVector s Double -> Int -> Segment -> ST s Int
writeSegment array i s = case s of
  Straight p q -> let d = Vec.unit (Vec.to p q) in writeNumbers p d d 0
  Arc {start, end, centre, sweep = Rad a} ->
    let Mm r = Segment.radius centre start
        k = signum a / r
     in writeNumbers
          start
          (Vec.scale k (Vec.left (Vec.to centre start)))
          (Vec.scale k (Vec.left (Vec.to centre end)))
          k
  where
    writeNumbers p (Vec.Vec sx sy) (Vec.Vec ex ey) k = do
      put 0 (Vec.x p) >> put 1 (Vec.y p) >> put 2 sx >> put 3 sy >> put 4 ex >> put 5 ey >> put 6 k
      pure (i + 7)
    put j = Mutable.unsafeWrite array (i + j)

-- | Arc length in mm at the start of a segment; for the index after the last one, the whole length.
station :: SegmentTable -> Int -> Double
station chain = Unboxed.unsafeIndex (stations chain)

-- | Pose at the start of segment @i@.
beginning :: SegmentTable -> Int -> Pose
beginning chain i = Pose (part 0) (part 1) (part 2) (part 3)
  where
    part k = Unboxed.unsafeIndex (entries chain) (7 * i + k)

-- | Unit direction, as x and y, at the end of segment @i@.
ending :: SegmentTable -> Int -> (Double, Double)
ending chain i =
  (Unboxed.unsafeIndex (entries chain) (7 * i + 4), Unboxed.unsafeIndex (entries chain) (7 * i + 5))
{-# INLINE ending #-}

-- | Curvature of segment @i@ in 1/mm, positive to the left.
curvature :: SegmentTable -> Int -> Double
curvature chain i = Unboxed.unsafeIndex (entries chain) (7 * i + 6)

-- | True if the polyarc has a corner at the start of segment @k@, which is not the first (0).
hasCorner :: SegmentTable -> Int -> Bool
hasCorner chain k = FastBiarc.isCorner b {dx = ex, dy = ey} b
  where
    (ex, ey) = ending chain (k - 1)
    b = beginning chain k

-- | Index of the segment, below @to@, that contains the arc length @u@ (mm). The search begins at
-- @from@, which is this index or a smaller one. It is a galloping (exponential) search followed by
-- a binary search.
seekFrom :: SegmentTable -> Int -> Int -> Double -> Int
seekFrom chain to from u = gallop from 1
  where
    gallop low step
      | low + step >= to = if to - low <= 1 then low else search low to
      | station chain (low + step) <= u = gallop (low + step) (2 * step)
      | otherwise = search low (low + step)
    -- Invariant: the result is at least @low@ and below @high@.
    search low high
      | high - low <= 1 = low
      | station chain middle <= u = search middle high
      | otherwise = search low middle
      where
        middle = (low + high) `div` 2

-- | Pose at the arc length @s@ (mm) after a given pose, along a segment with the curvature @k@
-- (1/mm).
poseAlong :: Double -> Pose -> Double -> Pose
poseAlong k (Pose x y ux uy) s
  | k == 0 = Pose (x + s * ux) (y + s * uy) ux uy
  | otherwise =
    Pose
      { px = x + chord * (c * ux - n * uy),
        py = y + chord * (c * uy + n * ux),
        dx = (c * c - n * n) * ux - 2 * c * n * uy,
        dy = (c * c - n * n) * uy + 2 * c * n * ux
      }
  where
    c = cos (0.5 * k * s)
    n = sin (0.5 * k * s)
    chord = 2 * n / k

-- | Pose at the arc length @u@ (mm) in the stretch of segments @from@ to @to − 1@; @i@ is the
-- segment that contains @u@. Where two segments meet, the direction is the mean of both.
poseWithin :: SegmentTable -> Int -> Int -> Int -> Double -> Pose
poseWithin chain from to i u
  | u >= station chain to = arriving (to - 1)
  | s > 0 || i <= from = poseAlong (curvature chain i) (beginning chain i) s
  | otherwise = FastBiarc.meanPose (arriving (i - 1)) (beginning chain i)
  where
    s = u - station chain i
    arriving j =
      let (ex, ey) = ending chain j
          whole = station chain (j + 1) - station chain j
          end = poseAlong (curvature chain j) (beginning chain j) whole
       in end {dx = ex, dy = ey}

-- | Bounds of the distances of a biarc's two arcs from the polyarc between two arc lengths. After
-- the limit @largest@ (mm) come segment, arc length and pose of the first end, then those of the
-- second. A result above the limit need not be a bound, as the caller rejects the biarc anyway.
biarcDistances ::
  SegmentTable ->
  Double ->
  Int ->
  Double ->
  Pose ->
  Int ->
  Double ->
  Pose ->
  FastBiarc ->
  ArcDistances
biarcDistances chain largest first u from final v to pair
  | isVertexFar chain largest first final from pair = unknown
  | single pair =
    let one = fastArc from (bend1 pair) to
     in if isForwards one
          then let Reached _ _ _ d = advance chain largest v to True one start in ArcDistances d d
          else unknown
  | one <- fastArc from (bend1 pair) (joint pair),
    two <- fastArc (joint pair) (bend2 pair) to,
    isForwards one && isForwards two = case advance chain largest v to False one start of
    Reached i s p d1 | d1 <= largest ->
      case advance chain largest v to True two (Reached i s p 0) of
        Reached _ _ _ d2 -> ArcDistances d1 d2
    _ -> unknown
  | otherwise = unknown
  where
    -- At a vertex the polyarc continues in the direction of the later segment; the biarc starts in
    -- the mean direction.
    start = Reached first u (if u > station chain first then from else ownDirection) 0
    ownDirection = let b = beginning chain first in from {dx = dx b, dy = dy b}
    unknown = ArcDistances (1 / 0) (1 / 0)

-- | True if a tested vertex of the polyarc is farther than @largest@ (mm) from a biarc. The biarc
-- starts at pose @from@ in segment @first@ and ends in segment @final@. This test rejects most
-- biarcs that deviate too much, before the exact bound is computed. It tests all vertices between
-- the ends of the biarc if they are at most three, otherwise three of them.
isVertexFar :: SegmentTable -> Double -> Int -> Int -> Pose -> FastBiarc -> Bool
isVertexFar chain largest first final from pair
  | final - first >= 4 = isQuarterFar 1 || isQuarterFar 2 || isQuarterFar 3
  | otherwise = isAnyFar (first + 1)
  where
    isQuarterFar k = isFar (isOnFirst p) p
      where
        !p = beginning chain (first + k * (final - first) `quot` 4)
    -- Tests one vertex after another: against the first arc up to the normal at the end of this
    -- arc, then against the second arc.
    isAnyFar i
      | i > final = False
      | isOnFirst p = isFar True p || isAnyFar (i + 1)
      | otherwise = isFar False p || isAnyFarFromSecond (i + 1)
      where
        !p = beginning chain i
    isAnyFarFromSecond i =
      i <= final && (isFar False (beginning chain i) || isAnyFarFromSecond (i + 1))
    isOnFirst p =
      single pair
        || (px p - px (joint pair)) * dx (joint pair) + (py p - py (joint pair)) * dy (joint pair)
          < 0
    isFar onFirst p
      | onFirst = abs (above (bend1 pair) from p) > largest
      | otherwise = abs (above (bend2 pair) (joint pair) p) > largest
    {-# INLINE isFar #-}

-- | True if a tested vertex between two positions is farther than @largest@ (mm) from every biarc
-- between them, so that the caller tries none. Each position is given by its segment, arc length
-- and pose. All biarcs between two poses lie between two circles through both positions: one has
-- the start direction, the other the end direction.
isTooFar :: SegmentTable -> Double -> Int -> Double -> Pose -> Int -> Double -> Pose -> Bool
isTooFar chain largest first _ from final _ to =
  max (abs bendA) (abs bendB) * largest < slack / 2 && go 1
  where
    cx = px to - px from
    cy = py to - py from
    square = cx * cx + cy * cy
    !bendA = 2 * (cy * dx from - cx * dy from) / square
    !bendB = 2 * (cx * dy to - cy * dx to) / square
    far = (1 + slack) * largest
    n = min testedVertices (final - first)
    go :: Int -> Bool
    go k
      | k >= n = False
      | otherwise = isOutside (above bendA from p) (above bendB to p) || go (k + 1)
      where
        !p = beginning chain (first + k * (final - first) `quot` n)
    isOutside a b = a > far && b > far || a < -far && b < -far

-- | 'isTooFar' divides the segments between two positions into groups, and tests the vertex at the
-- end of each group but the last. This is the largest number of groups.
testedVertices :: Int
testedVertices = 8

-- | Margin of 'isTooFar', as a share of its limit @largest@. |F| has to exceed the limit by this
-- margin, since |F| differs from the distance to a circle by up to half of the margin.
slack :: Double
slack = 0.05

-- | Position on the polyarc, by its segment, its arc length (mm) and its pose. The last number is a
-- bound, in mm, of the distance between an arc and the polyarc up to this position.
data Reached = Reached Int Double Pose Double

-- | Advances on the polyarc along one arc, and bounds the distance between polyarc and arc. The
-- result is where it stops. Along a first arc it stops where the polyarc crosses the normal at the
-- arc's end, because the second arc begins there. Along a second or single arc, for which @final@
-- is True, it stops at the arc length @v@ with the pose @to@. It also stops once the bound exceeds
-- @largest@ (mm).
advance :: SegmentTable -> Double -> Double -> Pose -> Bool -> FastArc -> Reached -> Reached
advance !chain !largest !v !to !final !f (Reached i0 u0 begin d0) =
  go i0 u0 (px begin) (py begin) (dx begin) (dy begin) (level f begin) (abs (level f begin))
  where
    -- The arguments are the segment, the arc length, the pose as four numbers, F at the pose, and
    -- the largest |F| so far. They are unboxed, because this loop runs once per segment and biarc.
    go !i !u !x !y !hx !hy !here !greatestLevel
      | end >= v = finish i u (Pose x y hx hy) (larger d0 (distanceOfLevel f greatestLevel))
      | otherwise = case beginning chain (i + 1) of
        Pose nx ny kx ky
          | not final && beyond f nx ny >= 0 ->
            finishAtNormal i u end p arriving (larger d0 (distanceOfLevel f greatestLevel))
          | not (runsForwards f p && runsForwards f arriving) ->
            Reached (i + 1) end arriving (1 / 0)
          -- Tests for an inner extremum of F above @greater@ only if there can be one, which is
          -- rare.
          | abs here + 1.5 * abs m * (end - u) > greater,
            e <- extreme here m (slope f arriving) (hx * ey - hy * ex) (end - u),
            e > greater ->
            continue e
          | otherwise -> continue greater
          where
            p = Pose x y hx hy
            (ex, ey) = ending chain i
            arriving = Pose nx ny ex ey
            !there = level f arriving
            !m = slope f p
            !greater = if abs there > greatestLevel then abs there else greatestLevel
            continue !now
              | now > greatestLevel && distanceOfLevel f now > largest =
                Reached (i + 1) end arriving (1 / 0)
              | otherwise = go (i + 1) end nx ny kx ky there now
      where
        !end = station chain (i + 1)
    -- Ends in segment @i@, which contains the arc length @v@.
    finish !i !u !p !d
      | final = Reached i v to (larger d (distanceBound f p to (v - u)))
      | beyond f (px to) (py to) < 0 = Reached i v to (1 / 0)
      | otherwise = finishAtNormal i u v p to d
    {-# NOINLINE finish #-}
    -- Ends where segment @i@ crosses the normal at the arc's end.
    finishAtNormal !i !u !w !p !q !d = Reached i (u + s) c (larger d (distanceBound f p c s))
      where
        s = normalCrossing f (curvature chain i) p q (w - u)
        c = poseAlong (curvature chain i) p s
    {-# NOINLINE finishAtNormal #-}
    larger d e = if e <= d then d else e

-- | Length in mm along a part of a segment to the point at which it crosses the normal at an arc's
-- end. It takes one step of linear interpolation and one of Newton's method. The arguments are the
-- arc, the segment's curvature (1/mm), the poses at both ends of the part, and its length (mm).
normalCrossing :: FastArc -> Double -> Pose -> Pose -> Double -> Double
normalCrossing f k p q l = newton (clamped (-l * from / (beyond f (px q) (py q) - from)))
  where
    from = beyond f (px p) (py p)
    newton a =
      let b = poseAlong k p a
       in clamped (a - beyond f (px b) (py b) / (dx b * dx (limit f) + dy b * dy (limit f)))
    clamped a = if a > 0 then if a < l then a else l else 0

-- | Bound in mm of the distance between an arc and a part of a segment. The part is given by the
-- poses at its ends and its length (mm). The bound is infinite if the part might not run forwards.
distanceBound :: FastArc -> Pose -> Pose -> Double -> Double
distanceBound f p q l
  | runsForwards f p && runsForwards f q =
    distanceOfLevel
      f
      ( greater
          (extreme from (slope f p) (slope f q) (dx p * dy q - dy p * dx q) l)
          (greater (abs from) (abs to))
      )
  | otherwise = 1 / 0
  where
    from = level f p
    to = level f q
    greater a b = if a > b then a else b

-- | Absolute value of the extremum of F between two positions on a segment, in mm; 0 if there is
-- none. The arguments are F at the first position, and the slopes of F at both. Then come the sine
-- of the sweep and the length (mm) between the positions. The extremum is that of a parabola,
-- corrected by the square of the sine. The result is at most @|F| + 3/2·|slope|·length@ with F and
-- the slope at the first position.
extreme :: Double -> Double -> Double -> Double -> Double -> Double
extreme from m n sweepSine l
  | m * n < 0 = abs (from - 0.5 * m * m * l / (n - m) * (1 + 2 * sweepSine * sweepSine))
  | otherwise = 0
{-# INLINE extreme #-}

-- | Segments @from@ to @to − 1@ as a parametric curve over arc length.
parametricCurve :: SegmentTable -> Int -> Int -> ParametricCurve
parametricCurve chain from to =
  ParametricCurve
    { ParametricFit.place = place,
      ParametricFit.direction = direction,
      ParametricFit.begin = station chain from,
      ParametricFit.breaks = station chain (from + 1) :| map (station chain) [from + 2 .. to]
    }
  where
    place u =
      let p = poseWithin chain from to (seekFrom chain to from u) u in Vec.point (px p) (py p)
    direction side u =
      let i = seekFrom chain to from u
          p = case side of
            Arriving
              | u <= station chain i && i > from ->
                let (ex, ey) =
                      ending chain (i - 1)
                 in (beginning chain i) {dx = ex, dy = ey}
            _ -> poseAlong (curvature chain i) (beginning chain i) (u - station chain i)
       in Vec.vec (dx p) (dy p)
