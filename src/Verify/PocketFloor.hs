-- | Search for material that a tape leaves on the floor of a pocket: a position that the cutter's
-- centre may take, but that is too far from every motion. A motion clears all positions within the
-- cutter's radius, to which the allowed excess is added.
--
-- The search starts with a square around the pocket. A square needs no division in three cases: one
-- motion clears all of it, two motions clear it together, or the centre may take no position in it.
-- Any other square is divided into four, down to 'floorResolution' (a quadtree).
module Verify.PocketFloor
  ( unclearedPoint,
    DistanceBound (..),
    boundAround,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus)
import Data.List (foldl', maximumBy)
import Data.Maybe (listToMaybe)
import Data.Ord (comparing)
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Verify.Motion (CutterMotion)
import Verify.Motion qualified as Motion
import Verify.Pocket (Pocket)
import Verify.Pocket qualified as Pocket

-- | Square by its centre and half of its side, in mm.
data Square = Square {centreX :: Double, centreY :: Double, half :: Double}

-- | Floor of a pocket at one height, with the motions at that height. A motion clears all positions
-- whose distance from its path is at most @radius@, in mm.
data Floor = Floor {pocket :: Pocket, radius :: Double, motions :: BoxTree MotionPart}

-- | Part of a motion, and the bounding paths of the whole motion. The parts of an arc are so short
-- that their bounding boxes are narrow: the boxes of whole arcs about one centre all overlap.
data MotionPart = MotionPart {part :: [Segment], whole :: [Segment]}

-- | Parts of a motion. The sagitta of a part is at most half of the radius @r@ in mm.
partsOf :: Double -> CutterMotion -> [MotionPart]
partsOf r m = case bounding of
  [arc@Arc {sweep = Rad angle}] ->
    let Mm arcRadius = Segment.radius (Segment.centre arc) (Segment.start arc)
        widest = 4 * asin (min 1 (sqrt (r / (4 * arcRadius))))
        count = max 1 (ceiling (abs angle / widest)) :: Int
        share k = fromIntegral k / fromIntegral count
     in [ MotionPart {part = [Segment.between (share k) (share (k + 1)) arc], whole = bounding}
          | k <- [0 .. count - 1]
        ]
  _ -> [MotionPart {part = bounding, whole = bounding}]
  where
    bounding = Motion.pathList m

-- | Position that the cutter's centre may take, but that is further than @radius@ from every
-- motion; Nothing if there is none. A position whose distance exceeds @radius@ by less than
-- 'floorResolution' may be missed. So may a position in a square of the smallest size, if the
-- cutter's centre may not take the middle of this square.
unclearedPoint :: Pocket -> Mm -> [CutterMotion] -> Maybe Point
unclearedPoint pocket (Mm radius) clearing =
  listToMaybe
    ( unclearedIn
        Floor
          { pocket,
            radius,
            motions = BoxTree.sortedIndex (boxOf . part) (concatMap (partsOf radius) clearing)
          }
        Nothing
        False
        Square
          { centreX = (left + right) / 2,
            centreY = (bottom + top) / 2,
            half = max (right - left) (top - bottom) / 2
          }
    )
  where
    BoundingBox left bottom right top = Pocket.bounds pocket
    boxOf = foldr1 BoundingBox.union . map BoundingBox.ofSegment

-- | Uncleared positions in a square. @hint@ has the bounding paths of the motion nearest to the
-- centre of the larger square from which this one was divided. That motion often clears this square
-- too. @hint@ is Nothing if that motion was not looked for, or if there are no motions.
-- @isKnownInside@ is true if the square is known to lie inside the pocket.
unclearedIn :: Floor -> Maybe [Segment] -> Bool -> Square -> [Point]
unclearedIn floor' hint isKnownInside square@Square {centreX = x, centreY = y, half}
  | corner < radius floor', Just paths <- hint, covers paths = []
  | corner < radius floor', Just paths <- nearest, covers paths || isSharedBy paths = []
  | otherwise = case Pocket.nearestWall walls p of
    Nothing -> [p]
    Just (w, wall)
      -- Every position in the square is too near to this wall.
      | plus w (Mm corner) < limit -> []
      -- The square meets no wall, and its centre lies outside of the pocket.
      | w > Mm corner && not isKnownInside && not (isFree wall) -> []
      -- A square of the smallest size is not divided: its centre decides for all of it.
      | Mm corner <= floorResolution ->
        [p | w >= limit, isKnownInside || w > Mm corner || isFree wall]
      | otherwise ->
        concatMap
          (unclearedIn floor' nearest (isKnownInside || w > Mm corner))
          (quarters square)
  where
    p = Vec.point x y
    walls = Pocket.walls (pocket floor')
    limit = Pocket.rimDistance (pocket floor')
    isFree = Pocket.isOnFreeSide (Pocket.side (pocket floor')) walls p
    -- Distance from the centre of the square to its corners.
    corner = half * sqrt 2
    nearest = if corner < radius floor' then nearestMotion floor' x y else Nothing
    covers paths = rangeOf x y paths + corner <= tolerantRadius floor'
    isSharedBy = isCoveredByTwo floor' square

-- | Test that two motions clear a square together: the motion with the paths @paths@, and the
-- motion nearest to the corner of the square that is furthest from @paths@. Where the mean of both
-- distances is within the radius, so is the smaller one.
--
-- The distance from a line is a convex function of the point, and so is the mean of two such
-- distances: on a square it is largest at a corner. For arcs, the mean has a bound from the
-- distances and their gradients at the centre of the square ('boundAround'). That bound holds on
-- the side of each motion on which the centre lies. A point on the other side is in the square, so
-- its distance from that motion is less than the radius.
isCoveredByTwo :: Floor -> Square -> [Segment] -> Bool
isCoveredByTwo floor' Square {centreX, centreY, half} paths =
  case nearestMotion floor' farX farY of
    Just others ->
      all FastDistance.isLine (paths <> others)
        && all
          (\(u, v) -> rangeOf u v paths + rangeOf u v others <= 2 * tolerantRadius floor')
          corners
        || isWithin paths others
    Nothing -> False
  where
    (farX, farY) = maximumBy (comparing (\(u, v) -> rangeOf u v paths)) corners
    corners = [(centreX + a * half, centreY + b * half) | (a, b) <- diagonals]
    corner = half * sqrt 2
    bound = boundAround (Vec.point centreX centreY) corner
    isWithin [one] [other] = case (bound one, bound other) of
      (Just a, Just b) ->
        atCentre a + atCentre b
          + corner * Vec.norm (Vec.add (gradient a) (gradient b))
          + corner * corner / 2 * (bend a + bend b)
          <= 2 * tolerantRadius floor'
      _ -> False
    isWithin _ _ = False

-- | Upper bound of the distance from a segment, on a disc. At the vector @v@ from the centre of the
-- disc it is @atCentre + gradient·v + bend·|v|²/2@, in mm.
data DistanceBound = DistanceBound {atCentre :: Double, gradient :: Vec, bend :: Double}

-- | Bound of the distance from a segment, on the disc with the given centre and radius. If the feet
-- of all points of the disc lie on the segment, it is the signed distance from the carrier,
-- positive on the side of the centre. On the other side a point is nearer to the carrier than the
-- radius. Otherwise it is the distance from the nearer end; Nothing if that end lies in the disc.
boundAround :: Point -> Double -> Segment -> Maybe DistanceBound
boundAround p radius segment = case segment of
  Straight a b ->
    let l = Vec.norm (Vec.to a b)
        u = Vec.scale (1 / l) (Vec.to a b)
        t = Vec.dot u (Vec.to a p)
        h = Vec.cross u (Vec.to a p)
     in if l > 0 && t >= radius && t + radius <= l
          then fromCarrier (if h < 0 then -1 else 1) (abs h) (Vec.left u) 0
          else fromEnd
  Arc {start, centre, sweep = Rad angle} ->
    let Mm r = Segment.radius centre start
        far = Vec.norm (Vec.to centre p)
        t = Segment.fraction segment p
        margin = asin (radius / far) / abs angle
        isOver = abs angle >= 2 * pi || t >= margin && t + margin <= 1
        sense = if far < r then -1 else 1
     in if far > radius && isOver
          then
            fromCarrier
              sense
              (abs (far - r))
              (Vec.scale (1 / far) (Vec.to centre p))
              -- Inside its circle, the distance from an arc is a concave function.
              (if sense > 0 then 1 / (far - radius) else 0)
          else fromEnd
  where
    fromCarrier sense d away = Just . DistanceBound d (Vec.scale sense away)
    fromEnd
      | d > radius = Just (DistanceBound d (Vec.scale (1 / d) (Vec.to end p)) (1 / (d - radius)))
      | otherwise = Nothing
      where
        d = Vec.norm (Vec.to end p)
    end
      | Vec.distance p (Segment.start segment) < Vec.distance p (Segment.end segment) =
        Segment.start segment
      | otherwise = Segment.end segment

-- | Four quarters of a square.
quarters :: Square -> [Square]
quarters Square {centreX, centreY, half} =
  [Square {centreX = centreX + a * h, centreY = centreY + b * h, half = h} | (a, b) <- diagonals]
  where
    h = half / 2

-- | Vectors from the centre of a square to its corners, in units of half its side.
diagonals :: [(Double, Double)]
diagonals = [(-1, -1), (1, -1), (1, 1), (-1, 1)]

-- | Radius plus 'floorResolution', in mm. With it, a square of the smallest size counts as cleared
-- if its centre is within the radius of a motion.
tolerantRadius :: Floor -> Double
tolerantRadius floor' = let Mm finest = floorResolution in radius floor' + finest

-- | Bounding paths of the motion nearest to the point @(x, y)@; Nothing without motions.
nearestMotion :: Floor -> Double -> Double -> Maybe [Segment]
nearestMotion floor' x y =
  whole . snd
    <$> BoxTree.closest
      (\m -> Mm (rangeOf x y (part m)))
      (Vec.point x y)
      (motions floor')

-- | Distance in mm from the point @(x, y)@ to that one of the paths which is furthest from the
-- point.
rangeOf :: Double -> Double -> [Segment] -> Double
rangeOf x y = foldl' (\d path -> max d (FastDistance.distance path x y)) 0

-- | Distance from the centre to the corners of the smallest squares, which are not divided any
-- more. A position may also count as cleared if its distance from the nearest motion exceeds the
-- radius by no more than this length.
floorResolution :: Mm
floorResolution = Mm 0.02
