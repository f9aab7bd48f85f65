-- | Search for material that a tape leaves on the floor of a pocket: a position that the cutter's
-- centre may take, but that is too far from every motion. A motion clears all positions within the
-- cutter's radius, to which the allowed excess is added.
--
-- The search starts with a square around the pocket. A square needs no division in three cases: one
-- motion clears all of it, two motions clear it together, or the centre may take no position in it.
-- Any other square is divided into four, down to 'floorResolution' (a quadtree).
module Verify.PocketFloor
  ( unclearedPoint,
  )
where

import Base.Quantity (Mm (..), plus)
import Data.List (foldl', maximumBy)
import Data.Maybe (listToMaybe)
import Data.Ord (comparing)
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Verify.Motion (CutterMotion)
import Verify.Motion qualified as Motion
import Verify.Pocket (Pocket)
import Verify.Pocket qualified as Pocket

-- | Square by its centre and half of its side, in mm.
data Square = Square {centreX :: Double, centreY :: Double, half :: Double}

-- | Floor of a pocket at one height, with the motions at that height. A motion clears all positions
-- whose distance from its path is at most @radius@, in mm.
data Floor = Floor {pocket :: Pocket, radius :: Double, motions :: BoxTree CutterMotion}

-- | Position that the cutter's centre may take, but that is further than @radius@ from every
-- motion; Nothing if there is none. A position whose distance exceeds @radius@ by less than
-- 'floorResolution' may be missed. So may a position in a square of the smallest size, if the
-- cutter's centre may not take the middle of this square.
unclearedPoint :: Pocket -> Mm -> BoxTree CutterMotion -> Maybe Point
unclearedPoint pocket (Mm radius) motions =
  listToMaybe
    ( unclearedIn
        Floor {pocket, radius, motions}
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

-- | Test that two lines clear a square together: the motion with the paths @paths@, and the motion
-- nearest to the corner of the square that is furthest from @paths@. The distance from a line is a
-- convex function of the point, and so is the mean of two such distances. On a square, the mean is
-- therefore largest at a corner. Where the mean is within the radius, so is the smaller distance.
isCoveredByTwo :: Floor -> Square -> [Segment] -> Bool
isCoveredByTwo floor' Square {centreX, centreY, half} paths =
  all FastDistance.isLine paths && case nearestMotion floor' farX farY of
    Just others ->
      all FastDistance.isLine others
        && all
          (\(u, v) -> rangeOf u v paths + rangeOf u v others <= 2 * tolerantRadius floor')
          corners
    Nothing -> False
  where
    (farX, farY) = maximumBy (comparing (\(u, v) -> rangeOf u v paths)) corners
    corners = [(centreX + a * half, centreY + b * half) | (a, b) <- diagonals]

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
  Motion.pathList . snd
    <$> BoxTree.closest
      (\m -> Mm (rangeOf x y (Motion.pathList m)))
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
