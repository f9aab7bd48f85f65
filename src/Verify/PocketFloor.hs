-- | Floor of a pocket: search for a position that the cutter's centre can reach and from which the
-- tape clears nothing.
--
-- The bounding box of the pocket is divided into squares. A square is done if one motion covers all
-- of it, or two motions cover it together, or if it lies outside of the reachable region. Other
-- squares are divided into four, down to 'floorResolution' (a quadtree).
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

-- | Floor of a pocket, the radius in mm within which a motion clears, and the motions.
data Floor = Floor {pocket :: Pocket, radius :: Double, motions :: BoxTree CutterMotion}

-- | Position of the cutter's centre in a pocket that has no motion within a distance, to
-- 'floorResolution'.
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

-- | Uncleared positions in a square. A motion that may cover the square is given by its paths, and
-- whether the square is known to lie in the pocket.
unclearedIn :: Floor -> Maybe [Segment] -> Bool -> Square -> [Point]
unclearedIn floor' hint isKnownInside square@Square {centreX = x, centreY = y, half}
  | corner < radius floor', Just paths <- hint, covers paths = []
  | corner < radius floor', Just paths <- nearest, covers paths || isSharedBy paths = []
  | otherwise = case Pocket.nearestWall walls p of
    Nothing -> [p]
    Just (w, wall)
      | plus w (Mm corner) < limit -> []
      | w > Mm corner && not isKnownInside && not (isFree wall) -> []
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

-- | Test that a motion and the one nearest to the furthest corner cover a square together. The
-- distance from a line is convex, and so is the mean of two such distances: it is largest at a
-- corner. The smaller one of both is no larger than the mean.
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

-- | Directions from the centre of a square to its corners.
diagonals :: [(Double, Double)]
diagonals = [(-1, -1), (1, -1), (1, 1), (-1, 1)]

-- | Radius with the resolution of the search added, so that the smallest squares are decided.
tolerantRadius :: Floor -> Double
tolerantRadius floor' = let Mm finest = floorResolution in radius floor' + finest

-- | Paths of the motion nearest to a point.
nearestMotion :: Floor -> Double -> Double -> Maybe [Segment]
nearestMotion floor' x y =
  Motion.pathList . snd
    <$> BoxTree.closest
      (\m -> Mm (rangeOf x y (Motion.pathList m)))
      (Vec.point x y)
      (motions floor')

-- | Distance from a point to the furthest of some paths.
rangeOf :: Double -> Double -> [Segment] -> Double
rangeOf x y = foldl' (\d path -> max d (FastDistance.distance path x y)) 0

-- | Distance from the centre to the corners of the smallest squares. A position may be further from
-- the motions by this.
floorResolution :: Mm
floorResolution = Mm 0.02
