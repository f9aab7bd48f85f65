-- | The moves of drilling: rapid over each hole, down at the feed, up in rapid.
module Toolpath.DrillMove
  ( moves,
  )
where

import Base.Quantity (Mm (..), plus)
import Base.Region (Located (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Segment (Segment (Straight))
import Geometry.Tolerance qualified as Tolerance
import Part.Part (Drilling, SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.Toolpath (Manner (Manner), Move (Move))

-- | The moves of a drilling statement, from the tool's position before it. The tool rises to the
-- clearance height first if it is below.
moves :: SpacePoint -> Located Drilling -> [Move]
moves at (Located region d) =
  LinkingMove.rise at clear (LinkingMove.keyword 4 region)
    <> go (SpacePoint (plane at) (max clear (height at))) (NonEmpty.toList (Part.holes d))
  where
    clear = Part.travelHeight d
    go from holes = case holes of
      [] -> []
      Located hole p : rest ->
        let over =
              LinkingMove.straightMoves from [Part.Stop (Located hole p) (Just clear) Part.Rapid]
         in over
              <> [ Move (Straight p p) (Manner heights pace False) hole False
                   | (heights, pace) <- pecks
                 ]
              <> go (SpacePoint p clear) rest
    -- The vertical moves are the same at each hole.
    pecks = concat (zipWith peck (Nothing : map Just depths) depths)
    peck before z =
      let from = maybe clear (\b -> min clear (plus b peckGap)) before
       in [((clear, from), Part.Rapid) | from /= clear]
            <> [((from, z), Part.At (Part.drillFeed d)), ((z, clear), Part.Rapid)]
    depths = depthsOf d

-- | The heights to which a drill goes down, in order: equal pecks, none deeper than is asked.
depthsOf :: Drilling -> [Mm]
depthsOf d = case Part.peckDepth d of
  Nothing -> [Part.bottom d]
  Just (Mm most) ->
    let Mm bottom = Part.bottom d
        count = max 1 (min 10000 (ceiling (-bottom / most - Tolerance.equal))) :: Int
     in [Mm (bottom * fromIntegral k / fromIntegral count) | k <- [1 .. count]]

-- | The distance above the last depth at which a drill's rapid move down ends.
peckGap :: Mm
peckGap = Mm 0.5
