-- | Gouges: motions whose distance from an element is smaller than it has to be.
module Verify.Gouge
  ( KeepOut (..),
    constantKeepOut,
    gougeOf,
    mayGougeDeeper,
    allowanceAt,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Vec (Point)
import Offset.Tolerance qualified as Tolerance
import Part.Part (Element)
import Part.Part qualified as Part
import Verify.Edge (Edge (element, shape))
import Verify.Motion (CutterMotion (number, segment), connectors, paths)
import Verify.Proof (Witness (Witness))
import Verify.Proof qualified as Proof

-- | Distance that a motion has to keep from the elements of a contour.
data KeepOut = KeepOut
  { -- | elements further away are not looked at
    searchRadius :: Mm,
    -- | largest distance to keep from any element
    largest :: Mm,
    -- | distance to keep from an element, at a point of the motion
    required :: Element -> Point -> Mm
  }

-- | One distance to all elements.
constantKeepOut :: Mm -> KeepOut
constantKeepOut d = KeepOut {searchRadius = d, largest = d, required = \_ _ -> d}

-- | Deepest gouge of a motion, if there is one: by how much it comes nearer to an element than it
-- may.
gougeOf :: KeepOut -> BoxTree Edge -> CutterMotion -> Maybe Witness
gougeOf KeepOut {searchRadius, required} edges m = Proof.deepest gouges
  where
    gouges =
      [ Witness
          { Proof.amount = minus (required e p) d,
            Proof.frame = number m,
            Proof.element = Part.origin e,
            Proof.location = p
          }
        | path <- NonEmpty.toList (paths m) <> connectors m,
          e <- map element (BoxTree.select (isWithinReach path) edges),
          let Distance.ClosestPoint d p = Distance.segments path (Part.segment e),
          d < required e p
      ]
    isWithinReach path b =
      BoundingBox.meets (BoundingBox.inflate searchRadius (BoundingBox.ofSegment path)) b
        && BoundingBox.lowerBound (`Distance.toPoint` path) b <= searchRadius

-- | Test by fast bounds that a motion may gouge some elements deeper than the deepest gouge so far.
-- Its bounding paths are given. Those of an arc differ from its segment by the difference of its
-- radii.
mayGougeDeeper :: KeepOut -> Maybe Witness -> CutterMotion -> [Segment] -> [Edge] -> Bool
mayGougeDeeper keepOut best m bounding =
  any
    ( \e ->
        FastDistance.apartAtLeast (segment m) (shape e) < least + difference
          && FastDistance.apart (segment m) (shape e) < least + difference
          && ( difference <= 0
                 || any
                   (\path -> FastDistance.apart path (shape e) < least)
                   (bounding <> connectors m)
             )
    )
  where
    difference = FastDistance.uneven (segment m)
    least =
      let Mm d = largest keepOut
       in d - maybe 0 (\w -> let Mm a = Proof.amount w in a) best + FastDistance.unsure

-- | Allowance on an element at the point nearest to a given one. Within a pulse of a joint it is
-- the smallest of those that meet there, because a step between two allowances ends on whole
-- pulses. It is zero if another element is nearer to the point.
allowanceAt :: Mm -> BoxTree Edge -> Element -> Point -> Mm
allowanceAt pulse edges e p
  | own <= Mm 0 = own
  | any (\other -> plus (Distance.toPoint p (Part.segment other)) Tolerance.resolution < d) joined =
    Mm 0
  | otherwise = minimum (own : map allowanceOf joined)
  where
    own = allowanceOf e
    allowanceOf = Part.allowance . Part.finish
    (d, foot) = Distance.nearest p (Part.segment e)
    joined =
      [ other
        | other <-
            map
              element
              (BoxTree.within (BoundingBox.inflate pulse (BoundingBox.ofPoints foot [])) edges),
          Distance.toPoint foot (Part.segment other) <= pulse
      ]
