-- | How deep a tool without a radius goes into the material.
--
-- A nose of radius 0 lies on the contour itself. No distance tells on which side of it: a stroke is
-- cut where it crosses the contour, and each of its stretches lies on one side, that of the tool or
-- that of the material. On that of the material its distance from the contour is the depth of a
-- gouge, exactly as long as the stretch is. Beyond the ends of an open contour there is no side:
-- the stretches are cut at the normals there.
module Verify.PointedTool
  ( gougeOf,
  )
where

import Base.Quantity (Mm (..))
import Data.List (minimumBy, sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Data.Ord (comparing)
import Geometry.Carrier (Side (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Part.Part (Contour)
import Part.Part qualified as Part
import Verify.Coverage (Beyond (Beyond, around, most), Others (..))
import Verify.Coverage qualified as Coverage
import Verify.Motion (CutterMotion (number), ways)
import Verify.PassSearch (Edge (element))
import Verify.Proof (Witness (Witness, amount, frame, place))
import Verify.Proof qualified
import Prelude hiding (lines)

-- | The deepest that a stroke goes into the material beside a contour, if it does; the tool has to
-- stay on a side of it.
gougeOf :: Side -> Contour -> BoxTree Edge -> Mm -> CutterMotion -> Maybe Witness
gougeOf side contour elements allowance t = case concatMap deep (NonEmpty.toList (ways t)) of
  [] -> Nothing
  ws -> Just (minimumBy (comparing (\w -> let Mm a = amount w in -a)) ws)
  where
    deep way = mapMaybe depth (concatMap (judged contour elements) (stretches (marks way) way))
    marks way =
      concatMap
        (Distance.crossings way . Part.segment . element)
        ( BoxTree.within
            (BoundingBox.inflate Tolerance.coincident (BoundingBox.ofSegment way))
            elements
        )
        <> beside way
    beside way = [p | n <- normals contour, p <- Distance.crossings way n]
    depth (s, stretch) =
      if s == side then Nothing else witness <$> Coverage.furthest others Nothing (Mm 0) stretch
    others =
      Others
        { index = elements,
          lines = (:| []) . Part.segment . element,
          counts = const True,
          reach = Mm 0,
          allowance
        }
    witness Beyond {most, Coverage.place = p, around} =
      Witness
        { amount = most,
          frame = number t,
          Verify.Proof.element =
            Part.origin
              ( element
                  (minimumBy (comparing (Distance.toPoint p . Part.segment . element)) around)
              ),
          place = p
        }

-- | The stretches of a segment between some of its points.
stretches :: [Point] -> Segment -> [Segment]
stretches points s = [part a b | (a, b) <- zip marks (drop 1 marks), b - a > hair]
  where
    marks = 0 : sort (filter (\t -> t > 0 && t < 1) (map (Segment.fraction s) points)) <> [1]
    part a b =
      let upTo =
            if b < 1 then fst (Segment.cutAt b s) else s
       in if a > 0 then snd (Segment.cutAt (a / b) upTo) else upTo

-- | A share of a stroke too short to matter.
hair :: Double
hair = 1e-9

-- | Lines across the ends of an open contour, so far as a part reaches.
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
      let Mm far =
            Tolerance.reach
          n = Vec.scale far (Vec.left d)
       in Straight (Vec.shift (Vec.negate n) p) (Vec.shift n p)

-- | A stretch that does not cross the contour with its side; a stretch whose middle lies beyond an
-- end of the contour in parts, of which those are left out that do so, too.
judged :: Contour -> BoxTree Edge -> Segment -> [(Side, Segment)]
judged contour elements s = case sideOf contour elements (Segment.at 0.5 s) of
  Just side -> [(side, s)]
  Nothing ->
    [ (side, part)
      | part <- stretches [Segment.at (fromIntegral k / parts) s | k <- [1 .. parts - 1 :: Int]] s,
        Just side <- [sideOf contour elements (Segment.at 0.5 part)]
    ]
  where
    parts :: Num a => a
    parts = 8

-- | The side of a contour on which a point lies, by where it is nearest; none beyond its ends, nor
-- on it.
sideOf :: Contour -> BoxTree Edge -> Point -> Maybe Side
sideOf contour elements p =
  case BoxTree.closest (Distance.toPoint p . Part.segment . element) p elements of
    Just (d, nearest)
      | d <= Tolerance.coincident -> Nothing
      | Part.ends contour == Part.Open
          && (Vec.near foot begin || Vec.near foot finish)
          && not (Segment.spans (Part.segment (element nearest)) p) ->
        Nothing
      | otherwise -> Just (if leftward > 0 then LeftOf else RightOf)
      where
        foot = snd (Distance.nearest p (Part.segment (element nearest)))
        -- In a corner the elements before and behind it count together.
        touching =
          filter
            (\e -> Distance.toPoint foot (Part.segment (element e)) <= Tolerance.coincident)
            ( BoxTree.within
                (BoundingBox.inflate Tolerance.coincident (BoundingBox.ofPoints foot []))
                elements
            )
        leftward =
          sum
            [ Vec.cross (directionBeside foot (Part.segment (element e))) (Vec.to foot p)
              | e <- touching
            ]
    Nothing -> Nothing
  where
    begin = Segment.start (Part.segment (NonEmpty.head (Part.elements contour)))
    finish = Segment.end (Part.segment (NonEmpty.last (Part.elements contour)))

-- | The direction of a segment at one of its points.
directionBeside :: Point -> Segment -> Vec
directionBeside p s
  | Vec.near p (Segment.start s) = Segment.startDirection s
  | Vec.near p (Segment.end s) = Segment.endDirection s
  | otherwise = Segment.directionAt (Segment.fraction s p) s
