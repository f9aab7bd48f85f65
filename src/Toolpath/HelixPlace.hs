-- | The place of a helix in a pocket, for which the program gives none.
module Toolpath.HelixPlace
  ( near,
    roomAt,
  )
where

import Base.Quantity (Mm (..), plus)
import Data.List (maximumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance

-- | The centre of a helix near the beginning of a path: of some points at the beginning of the path
-- and within it, the one with the most room. From it the cutter can go straight to the path, at
-- least at the distance @reach@ from the walls.
near :: Mm -> [Segment] -> NonEmpty Segment -> Point
near reach walls path = maximumBy (comparing (roomAt walls)) (begin : filter isLinked places)
  where
    begin = Segment.start (NonEmpty.head path)
    ahead = Segment.startDirection (NonEmpty.head path)
    BoundingBox l b r' t = foldr1 BoundingBox.union (fmap BoundingBox.ofSegment path)
    middle = Vec.point ((l + r') / 2) ((b + t) / 2)
    opposite = Segment.start (NonEmpty.toList path !! (NonEmpty.length path `div` 2))
    places =
      [Vec.interpolate 0.5 begin opposite, middle]
        <> [ Vec.shift (Vec.scale (sense * share * r) (Vec.left ahead)) begin
             | let Mm r = reach,
               share <- [0.25, 0.5, 1],
               sense <- [1, -1]
           ]
    isLinked p = all (isClear (Straight p begin)) walls
    isClear s w =
      let ClosestPoint d _ = Distance.segments s w
       in plus d Tolerance.clearance >= reach

-- | The distance of a point from the walls.
roomAt :: [Segment] -> Point -> Mm
roomAt walls p = minimum (map (Distance.toPoint p) walls)
