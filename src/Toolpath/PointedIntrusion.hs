-- | Linking moves of a pointed turning tool that run through the material behind a profile.
--
-- A pointed tool has the nose radius 0, so its distance from the profile does not show that it is
-- in the material. A move is therefore divided where it crosses the profile, and at the normals at
-- both ends of the profile. Each part lies on one side, or beyond the ends, where there is none.
-- The proof does the same in "Verify.PointedTool", by its own computation.
module Toolpath.PointedIntrusion
  ( PointedIntrusion (..),
    deepest,
  )
where

import Base.Quantity (Mm (..))
import Data.List (maximumBy, minimumBy, sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes)
import Data.Ord (comparing)
import Geometry.Carrier (Side (..))
import Geometry.Corner qualified as Corner
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Contour, Element)
import Part.Part qualified as Part

-- | The deepest position of a move in the material: the element nearest to it, the depth in mm, and
-- the position.
data PointedIntrusion = PointedIntrusion {element :: Element, depth :: Mm, position :: Point}

-- | The deepest position of a move in the material behind a profile; Nothing if the move does not
-- enter the material by more than @allowed@. @side@ is the tool's side of the profile.
deepest :: Side -> Mm -> Contour -> Segment -> Maybe PointedIntrusion
deepest side allowed profile move = case filter ((> allowed) . depth) found of
  [] -> Nothing
  deep -> Just (maximumBy (comparing depth) deep)
  where
    found =
      catMaybes
        [ behindAt side profile (Segment.at (a + fromIntegral k / samples * (b - a)) move)
          | (a, b) <- zip marks (drop 1 marks),
            b - a > Tolerance.negligibleShare,
            k <- [0 .. samples :: Int]
        ]
    marks = 0 : sort (filter (\t -> t > 0 && t < 1) (map (Segment.fraction move) crossings)) <> [1]
    crossings =
      concatMap (Distance.intersections move) (map Part.segment elements <> endNormals profile)
    elements = NonEmpty.toList (Part.elements profile)
    samples :: Num a => a
    samples = 128

-- | The position @p@ as an intrusion if it lies in the material: on the side of the profile
-- opposite to @side@. Nothing beyond the ends of an open profile.
behindAt :: Side -> Contour -> Point -> Maybe PointedIntrusion
behindAt side profile p
  | d <= Tolerance.coincident || isBeyondEnd = Nothing
  | (Corner.leftwardness (map Part.segment elements) foot p > 0) == (side == LeftOf) = Nothing
  | otherwise = Just (PointedIntrusion nearest d p)
  where
    elements = NonEmpty.toList (Part.elements profile)
    nearest = minimumBy (comparing (Distance.toPoint p . Part.segment)) elements
    (d, foot) = Distance.nearest p (Part.segment nearest)
    isBeyondEnd =
      Part.ends profile == Part.Open
        && any (Vec.isNear foot . fst) (endsOf profile)
        && not (Segment.hasFootOf (Part.segment nearest) p)

-- | Normals at both ends of an open profile, as lines that extend by 'Tolerance.reach' to either
-- side. Empty for a closed one.
endNormals :: Contour -> [Segment]
endNormals profile = case Part.ends profile of
  Part.Closed -> []
  Part.Open -> map across (endsOf profile)
  where
    across (p, direction) =
      let Mm far = Tolerance.reach
          normal = Vec.scale far (Vec.left direction)
       in Straight (Vec.shift (Vec.negate normal) p) (Vec.shift normal p)

-- | The start and the end of a profile, each with the direction of travel there.
endsOf :: Contour -> [(Point, Vec.Vec)]
endsOf profile =
  [ (Segment.start first, Segment.startDirection first),
    (Segment.end final, Segment.endDirection final)
  ]
  where
    first :| _ = fmap Part.segment (Part.elements profile)
    final = Part.segment (NonEmpty.last (Part.elements profile))
