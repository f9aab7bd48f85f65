-- | Cut along a contour as the part demands it, and the contact between the cutter and the elements
-- of the contour. The proof looks for this cut on the tape.
--
-- The contact point of a cutter is the point of the contour that is nearest to the cutter's centre.
-- At a corner, at a step between allowances, or because of rounding, several elements may be
-- equally near. Then each of them has a contact point.
module Verify.MillingJob
  ( MillingJob (..),
    elementsOf,
    isClosed,
    isInsideArc,
    contactLimit,
    edgesAround,
    edgesNear,
    edgesNearEach,
    edgesInBox,
    contacts,
    allowanceTowards,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus)
import Base.Region (Region)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Element, Milling)
import Part.Part qualified as Part
import Verify.Edge (Edge (..))
import Verify.Edge qualified as Edge
import Verify.Motion (CutterMotion (segment))
import Verify.Motion qualified as Motion

-- | Cut along a contour that has to be on the tape.
data MillingJob = MillingJob
  { milling :: Milling,
    -- | region of the statement in the part program
    statement :: Region,
    -- | side of the contour, in the direction of travel, on which the cutter moves; Nothing if its
    -- centre moves on the contour
    side :: Maybe Carrier.Side,
    -- | positions of the cutter's centre at the start and at the end of the cut
    entry :: Point,
    exit :: Point,
    -- | distance that the cutter's centre has to keep from the contour in this pass
    reach :: Mm,
    -- | largest distance that the cutter's centre may have from the contour; it is more than
    -- 'reach' at sharp corners and along elements with an allowance
    maxReach :: Mm,
    -- | allowed deviation (not material that is left): the larger of the allowed chord errors into
    -- the part and away from it, plus one pulse
    allowance :: Mm,
    -- | largest distance from 'exit' that the centre may have at the end of the cut
    exitTolerance :: Mm,
    -- | true of one of several cuts in a pass, none of which goes along the whole contour
    isPartialCut :: Bool,
    -- | elements of the contour
    edges :: BoxTree Edge
  }

-- | Elements of the contour in the direction of travel.
elementsOf :: MillingJob -> [Element]
elementsOf = NonEmpty.toList . Part.elements . Part.contour . milling

-- | Test that the contour is closed.
isClosed :: MillingJob -> Bool
isClosed job = Part.ends (Part.contour (milling job)) == Part.Closed

-- | Test that the cutter moves on the inside of the arcs of the contour that have a sweep of this
-- sign. False if the cutter has no side.
isInsideArc :: MillingJob -> Rad -> Bool
isInsideArc job (Rad sweep) = maybe False (\s -> Carrier.sideSign s * sweep > 0) (side job)

-- | Largest distance, with the allowed deviation, from an element to the centre of a cutter that
-- touches it.
contactLimit :: MillingJob -> Mm
contactLimit job = plus (maxReach job) (allowance job)

-- | Elements that a cutter with its centre at @p@ may touch, and perhaps some that it does not
-- touch.
edgesAround :: MillingJob -> Point -> [Edge]
edgesAround job p =
  BoxTree.within (BoundingBox.inflate (contactLimit job) (BoundingBox.ofPoints p [])) (edges job)

-- | Elements that a cutter may touch during a motion, by the fast test 'mayTouch'.
edgesNear :: MillingJob -> CutterMotion -> [Edge]
edgesNear job m = filter (mayTouch job m) (edgesInBox job m)

-- | Elements that a cutter may touch during each motion of a list, in the order of the list. The
-- function is fast if the motions follow one another on the tape.
edgesNearEach :: MillingJob -> [CutterMotion] -> [[Edge]]
edgesNearEach job =
  BoxTree.each (BoundingBox.inflate (contactLimit job) . Motion.box) (mayTouch job) (edges job)

-- | False only if the cutter cannot touch an element during a motion. True also for some elements
-- that it does not touch.
mayTouch :: MillingJob -> CutterMotion -> Edge -> Bool
mayTouch job m = \e -> FastDistance.mayComeWithin far (long e) (shape e) (segment m)
  where
    far = let Mm r = contactLimit job in r + FastDistance.uneven (segment m)

-- | Elements whose bounding boxes come within 'contactLimit' of the motion's bounding box. They
-- include all elements that the cutter may touch during the motion.
edgesInBox :: MillingJob -> CutterMotion -> [Edge]
edgesInBox job m =
  BoxTree.within (BoundingBox.inflate (contactLimit job) (Motion.box m)) (edges job)

-- | Contact points of a cutter with its centre at @p@. Each is given by the number of its element,
-- from 0, and by its arc length in mm from the start of the contour. @near@ has to contain all
-- elements within 'contactLimit' of @p@. If no normal of an arc goes through @p@, the contact point
-- is the end of the arc that is nearer to @p@.
contacts :: MillingJob -> [Edge] -> Point -> [(Int, Double)]
contacts job near p =
  [ (rank e, startsAt e + contactOn e * long e)
    | e <- near,
      let own = allowanceTowards job p e,
      FastDistance.distance (shape e) (Vec.x p) (Vec.y p) <= farthestContact touch own
  ]
  where
    contactOn e = FastDistance.footOn (shape e) (Vec.x p) (Vec.y p)
    touch = touchAt job near p

-- | Lengths in mm that decide which elements a cutter touches from one position of its centre. The
-- /excess distance/ of an element is its distance from the centre minus its own allowance.
data Touch = Touch
  { -- | 'contactLimit' of the job
    limit :: Double,
    -- | least excess distance of the elements near the centre
    leastExcess :: Double,
    -- | largest difference between the excess distance of a touched element and 'leastExcess'
    spread :: Double
  }

-- | 'Touch' of a cutter with its centre at @p@. @near@ are the elements near @p@.
touchAt :: MillingJob -> [Edge] -> Point -> Touch
touchAt job near p =
  Touch
    { limit,
      leastExcess = Edge.leastExcess (allowanceTowards job p) limit near p,
      spread = 2 * deviation
    }
  where
    Mm limit = contactLimit job
    Mm deviation = allowance job

-- | Allowance of an element towards a centre at @p@: its own allowance if @p@ lies beside the
-- element on the cutter's side, and 0 behind it. Beyond an end of the element, the cutter keeps the
-- allowance at an outer corner only. So there the result is the own allowance if @p@ keeps it,
-- and otherwise 0.
allowanceTowards :: MillingJob -> Point -> Edge -> Mm
allowanceTowards job p e
  | own <= Mm 0 = own
  | Segment.hasFootOf (shape e) p =
    if any (\s -> Segment.isBehind s (shape e) p) (side job) then Mm 0 else own
  | Mm (abs beyond) <= allowance job = own
  | otherwise = Mm 0
  where
    own = ownAllowance e
    Mm beyond = minus (Distance.toPoint p (shape e)) (plus (reach job) own)

-- | Largest distance in mm from an element with the allowance @own@ to the centre of a cutter that
-- touches it. The allowance of the element is included.
farthestContact :: Touch -> Mm -> Double
farthestContact touch (Mm own) = min (limit touch) (leastExcess touch + own + spread touch)
