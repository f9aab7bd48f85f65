-- | The moves of drilling. At each hole the drill moves above the hole in rapid, goes down at the
-- feed, and goes up again in rapid.
module Toolpath.DrillMove
  ( moves,
  )
where

import Base.Quantity (Mm (..), plus)
import Base.Region (Located (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Segment (Segment (Straight))
import Geometry.Tolerance qualified as Tolerance
import Part.Part (Drilling, Hole (Hole), SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.HoleOrder qualified as HoleOrder
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.Toolpath (Manner (Manner), Move (Move))

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
      Hole (Located hole p) bottom : rest ->
        let over =
              LinkingMove.straightMoves from [Part.Stop (Located hole p) (Just clear) Part.Rapid]
         in over
              <> [ Move (Straight p p) (Manner heights pace False) hole False
                   | (heights, pace) <- pecksTo bottom
                 ]
              <> go (SpacePoint p clear) rest
    -- The vertical moves in a hole.
    pecksTo bottom =
      let depths = depthsOf d bottom
       in concat (zipWith peck (Nothing : map Just depths) depths)
    peck before z =
      let from = maybe clear (\b -> min clear (plus b peckGap)) before
       in [((clear, from), Part.Rapid) | from /= clear]
            <> [((from, z), Part.At (Part.drillFeed d)), ((z, clear), Part.Rapid)]

-- | The heights at which the pecks of a hole end, in order; @bottom@ is the height of its bottom.
-- All pecks have equal depths, at most the depth that the program gives. If this would need more
-- than 10000 pecks, there are 10000 deeper ones. Without pecking the only height is the bottom's.
depthsOf :: Drilling -> Mm -> [Mm]
depthsOf d (Mm bottom) = case Part.peckDepth d of
  Nothing -> [Mm bottom]
  Just (Mm most) ->
    let count = max 1 (min 10000 (ceiling (-bottom / most - Tolerance.equal))) :: Int
     in [Mm (bottom * fromIntegral k / fromIntegral count) | k <- [1 .. count]]

-- | The height above the end of one peck at which the rapid move down to the next peck ends.
peckGap :: Mm
peckGap = Mm 0.5
