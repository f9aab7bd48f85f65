-- | Gouges: motions in which the cutter's centre comes nearer to an element than the required
-- distance. The /bounding paths/ of a motion enclose its real path: one path, or two for an arc
-- whose radii at start and end differ (see "Control.Motion").
module Verify.Gouge
  ( KeepOut (..),
    constantKeepOut,
    gougeOf,
    allowanceAt,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Corner qualified as Corner
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance
import Part.Part (Element)
import Part.Part qualified as Part
import Verify.Edge (Edge (element))
import Verify.Motion (CutterMotion (number), connectors, paths)
import Verify.Proof (Witness (Witness))
import Verify.Proof qualified as Proof

-- | Distance that the cutter's centre has to keep from the elements of a contour during a motion.
data KeepOut = KeepOut
  { -- | elements further from the motion than this are not examined
    searchRadius :: Mm,
    -- | upper bound of 'required' for all elements and points
    largest :: Mm,
    -- | distance to keep from an element while the centre is at a point of the motion
    required :: Element -> Point -> Mm
  }

-- | Keep-out distance that is @d@ from all elements, at all points of the motion.
constantKeepOut :: Mm -> KeepOut
constantKeepOut d = KeepOut {searchRadius = d, largest = d, required = \_ _ -> d}

-- | Deepest gouge of the motion @m@ into the elements @edges@; Nothing if the motion keeps its
-- distance. The amount of a gouge is the required distance minus the actual one. It is measured on
-- the bounding paths of the motion, and on the lines that connect the ends of two such paths.
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

-- | Allowance that a motion has to leave on the element @e@ while the centre is at the point @p@.
-- Usually it is the allowance of @e@. It may be smaller near another element. Take the point of @e@
-- nearest to @p@, and each end of @e@ whose normal is within @rounding@ of @p@; if @e@ is an arc,
-- also such ends of other arcs of its circle. Take also the other elements within @rounding@ of
-- these points. The result is the smallest allowance of @e@ and these elements, because the
-- position at which the allowance changes is rounded; @rounding@ is the largest deviation of the
-- motion that rounding causes. If one of these elements is nearer to @p@ than @e@ is, the result is
-- 0, because that element is examined with its own allowance. It is 0, too, if @p@ lies beyond the
-- end of @e@ at an inner corner, and if it lies on the side of @e@ opposite to @side@, that of the
-- cutter: beyond a thin wall nothing is left on @e@. If the allowance of @e@ is not positive, it is
-- the result in every case.
allowanceAt :: Maybe Side -> Mm -> BoxTree Edge -> Element -> Point -> Mm
allowanceAt side rounding edges e p
  | own <= Mm 0 = own
  | any (\s -> Segment.isBehind s (Part.segment e) p) side = Mm 0
  | not (Segment.hasFootOf (Part.segment e) p), any meetsInside joined = Mm 0
  | any (\other -> plus (Distance.toPoint p (Part.segment other)) Tolerance.resolution < d) joined =
    Mm 0
  | otherwise = minimum (own : map allowanceOf joined)
  where
    own = allowanceOf e
    allowanceOf = Part.allowance . Part.finish
    meetsInside other = any (\s -> isInnerCorner s (Part.segment e) (Part.segment other)) side
    (d, foot) = Distance.nearest p (Part.segment e)
    joined =
      [ other
        | q <- foot : [end | o <- onSameCircle, (end, along) <- bothEnds o, isAbove end along],
          other <- elementsAround rounding q,
          Distance.toPoint q (Part.segment other) <= rounding
      ]
    isAbove end along =
      Mm (abs (Vec.dot along (Vec.to end p))) <= rounding
        && Vec.distance end p <= plus d rounding
    onSameCircle = e : filter (isOnCircleOf (Part.segment e) . Part.segment) (elementsAround d p)
    elementsAround far q =
      map element (BoxTree.within (BoundingBox.inflate far (BoundingBox.ofPoints q [])) edges)
    bothEnds o =
      [(Segment.at k s, Segment.directionAt k s) | let s = Part.segment o, k <- [0, 1]]

-- | Test that two arcs have the same centre and radius. A contour that begins on an arc has two
-- such arcs.
isOnCircleOf :: Segment -> Segment -> Bool
isOnCircleOf s s' = case (s, s') of
  (Arc {start, centre}, Arc {start = start', centre = centre'}) ->
    let Mm gap = minus (Segment.radius centre start) (Segment.radius centre' start')
     in Vec.isNear centre centre' && Mm (abs gap) <= Tolerance.coincident
  _ -> False

-- | Test that two segments meet, in any order, at a corner that turns towards the cutter on @side@.
isInnerCorner :: Side -> Segment -> Segment -> Bool
isInnerCorner side s s' = any turnsTowards [(s, s'), (s', s)]
  where
    turnsTowards (before, after) =
      Vec.isNear (Segment.end before) (Segment.start after)
        && let Rad angle = Corner.turning before after in Carrier.sideSign side * angle > 0
