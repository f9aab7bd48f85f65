-- | The direction in which the walls of a pocket are cut: climb or conventional.
--
-- The rim of a pocket ("Verify.Pocket") is the path of the cutter's centre beside its walls, in
-- their direction. A motion along the rim in this direction has the free space on the same side as
-- the walls have it. In a passage of the cutter's width both directions run along the rim, and any
-- motion is right there. A motion in the other direction is right too where another one runs along
-- the same part of the rim in the direction asked: it may be a linking move.
module Verify.PocketSense
  ( againstSense,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Geometry.Carrier (Side (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Part.Part qualified as Part
import Verify.Motion (CutterMotion (number, segment))
import Verify.Pocket (Pocket (..))
import Verify.Proof (Finding (AgainstSense))

-- | Finding for the first of some motions that cuts along a wall in the direction that the program
-- does not ask for; empty if there is none, or if the program asks for no direction. The motions
-- are at the depth of a pass, and the pocket has the rim of this pass. A motion runs along the rim
-- if it is parallel to it and at most the distance @near@ away.
againstSense :: Mm -> Pocket -> [CutterMotion] -> [Finding]
againstSense near pocket motions = case Part.sense (milling pocket) of
  Nothing -> []
  Just (Located region asked) ->
    take 1 [AgainstSense (number m) region asked | m <- motions, isAgainst asked (segment m)]
  where
    rims = indexed (map snd (rim pocket))
    paths = indexed (map segment motions)
    indexed = BoxTree.index BoundingBox.ofSegment
    isAgainst asked s = Segment.length s > near && any (opposes asked s) [0.25, 0.5, 0.75]
    opposes asked s t =
      let found = alongSegments near rims s t
       in not (null found)
            && all (== (asked /= withRim)) found
            && and (alongSegments near paths s t)
    -- The sense of a motion in the direction of the rim. With a clockwise spindle, climb milling
    -- has the free space on the left.
    withRim
      | (side pocket == LeftOf) == isClockwise = Part.Climb
      | otherwise = Part.Conventional
    isClockwise = Part.spindleSense (milling pocket) == Part.Clockwise

-- | The segments that run along another one at a point of it: for each, true if it has the same
-- direction there.
alongSegments :: Mm -> BoxTree Segment -> Segment -> Double -> [Bool]
alongSegments near others s t =
  [ Vec.dot direction along > 0
    | r <- BoxTree.within (BoundingBox.inflate near (BoundingBox.ofPoints p [])) others,
      Segment.length r > near,
      Distance.toPoint p r <= near,
      let along = Segment.directionAt (Distance.nearestFraction p r) r,
      abs (Vec.cross direction along) <= parallel
  ]
  where
    p = Segment.at t s
    direction = Segment.directionAt t s

-- | The largest sine of the angle between segments of which one runs along the other.
parallel :: Double
parallel = 0.05
