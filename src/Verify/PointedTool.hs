-- | Gouges of a pointed turning tool, that is, of one with nose radius 0.
--
-- The tip of such a tool lies on the contour itself, so its distance from the contour does not show
-- a gouge. A motion is therefore divided where it crosses the contour. Each part lies on one side:
-- that of the tool or that of the material. On the side of the material, the largest distance of
-- the part from the contour is the depth of the gouge. Beyond the ends of an open contour there is
-- no side, so the motion is also divided at the normals at these ends.
module Verify.PointedTool
  ( gougeOf,
  )
where

import Base.Quantity (Mm (..))
import Data.List (minimumBy, sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (maybeToList)
import Data.Ord (comparing)
import Geometry.Carrier (Side (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Contour)
import Part.Part qualified as Part
import Verify.Coverage (Cover (Cover), Gap (..))
import Verify.Coverage qualified as Coverage
import Verify.Edge (Edge (element, shape))
import Verify.Edge qualified as Edge
import Verify.Motion (CutterMotion (number))
import Verify.Motion qualified as Motion
import Verify.Proof (Witness (Witness))
import Verify.Proof qualified as Proof

-- | Deepest gouge of the motion @m@ into the material beside a contour; Nothing if there is none.
-- The tool has to stay on @side@ of the contour. The search for the deepest gouge begins with the
-- depth @first@, in mm, because usually no gouge is deeper. The result may be less deep.
gougeOf :: Side -> Contour -> BoxTree Edge -> Mm -> CutterMotion -> Maybe Witness
gougeOf side contour edges first m =
  Proof.deepest (concatMap onPath (NonEmpty.toList (Motion.paths m)))
  where
    onPath path =
      [ gap
        | (s, part) <- concatMap (sided contour edges) (divided (marksOn path) path),
          s /= side,
          gap <- gouges part
      ]
    marksOn path =
      concatMap
        (Distance.intersections path . shape)
        ( BoxTree.within
            (BoundingBox.inflate Tolerance.coincident (BoundingBox.ofSegment path))
            edges
        )
        <> concatMap (Distance.intersections path) (normals contour)
    gouges part = map witness (maybeToList (Coverage.largestGap cover Nothing (Mm 0) part))
    cover =
      Cover
        { Coverage.index = edges,
          Coverage.pathsOf = (:| []) . shape,
          Coverage.isEligible = const True,
          Coverage.reach = Mm 0,
          Coverage.allowance = first
        }
    witness Gap {size, location, members} =
      Witness
        { Proof.amount = size,
          Proof.frame = number m,
          Proof.element =
            Part.origin
              (element (minimumBy (comparing (Distance.toPoint location . shape)) members)),
          Proof.location
        }

-- | Parts into which some points on a segment divide it. Parts of negligible length are left out.
divided :: [Point] -> Segment -> [Segment]
divided points s =
  [Segment.between a b s | (a, b) <- zip marks (drop 1 marks), b - a > Tolerance.negligibleShare]
  where
    marks = 0 : sort (filter (\t -> t > 0 && t < 1) (map (Segment.fraction s) points)) <> [1]

-- | Normals of an open contour at both ends, as lines that extend by 'Tolerance.reach' to either
-- side. Empty for a closed contour, which has no ends.
normals :: Contour -> [Segment]
normals contour = case Part.ends contour of
  Part.Closed -> []
  Part.Open ->
    [ across (Segment.start first) (Segment.startDirection first),
      across (Segment.end final) (Segment.endDirection final)
    ]
  where
    first = Part.segment (NonEmpty.head (Part.elements contour))
    final = Part.segment (NonEmpty.last (Part.elements contour))
    across p d =
      let Mm far = Tolerance.reach
          n = Vec.scale far (Vec.left d)
       in Straight (Vec.shift (Vec.negate n) p) (Vec.shift n p)

-- | Parts of the segment @s@, each with the side of the contour on which it lies. @s@ is a part of
-- a motion and does not cross the contour. If 'sideOf' knows the side of the middle of @s@, the
-- result is @s@ as a whole with this side. Otherwise @s@ is divided into eight parts. An eighth is
-- listed with its side if 'sideOf' knows the side of its middle, and is left out if not.
sided :: Contour -> BoxTree Edge -> Segment -> [(Side, Segment)]
sided contour edges s = case sideOf contour edges (Segment.at 0.5 s) of
  Just side -> [(side, s)]
  Nothing ->
    [ (side, part)
      | part <- divided [Segment.at (fromIntegral k / parts) s | k <- [1 .. parts - 1 :: Int]] s,
        Just side <- [sideOf contour edges (Segment.at 0.5 part)]
    ]
  where
    parts :: Num a => a
    parts = 8

-- | Side of the contour on which a point lies, at the nearest point of the contour. Nothing for a
-- point on the contour, or beyond an end of an open contour.
sideOf :: Contour -> BoxTree Edge -> Point -> Maybe Side
sideOf contour edges p =
  case BoxTree.closest (Distance.toPoint p . shape) p edges of
    Just (d, nearest)
      | d <= Tolerance.coincident -> Nothing
      | Part.ends contour == Part.Open
          && (Vec.isNear foot begin || Vec.isNear foot finish)
          && not (Segment.hasFootOf (shape nearest) p) ->
        Nothing
      | otherwise -> Just (if Edge.leftwardness edges foot p > 0 then LeftOf else RightOf)
      where
        foot = snd (Distance.nearest p (shape nearest))
    Nothing -> Nothing
  where
    begin = Segment.start (Part.segment (NonEmpty.head (Part.elements contour)))
    finish = Segment.end (Part.segment (NonEmpty.last (Part.elements contour)))
