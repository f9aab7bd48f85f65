{-# LANGUAGE BangPatterns #-}

-- | Pass along a contour as the part demands it, and the contact between the cutter and the
-- elements of the contour.
--
-- The contact point of a cutter is the point of the contour that is nearest to its centre. A
-- corner, an allowance or rounding makes several elements equally near; then all of them count.
module Verify.MillingJob
  ( MillingJob (..),
    elementsOf,
    isClosed,
    contactLimit,
    edgesAround,
    edgesNear,
    edgesNearEach,
    edgesInBox,
    contacts,
    foldContacts,
  )
where

import Base.Quantity (Mm (..), plus)
import Base.Region (Region)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier qualified as Carrier
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Element, Milling)
import Part.Part qualified as Part
import Verify.Edge (Edge (..))
import Verify.Edge qualified as Edge
import Verify.Motion (CutterMotion (segment))
import Verify.Motion qualified as Motion

-- | Pass along a contour that has to be on the tape.
data MillingJob = MillingJob
  { milling :: Milling,
    -- | region of the statement in the part program
    statement :: Region,
    -- | side of the cutter in the direction of travel; nothing if it runs on the contour
    side :: Maybe Carrier.Side,
    -- | positions of the cutter's centre at the start and at the end of the cut
    entry :: Point,
    exit :: Point,
    -- | distance from the contour to the cutter's centre
    reach :: Mm,
    -- | largest distance from the contour to the cutter's centre: round sharp corners, along
    -- elements with an allowance
    maxReach :: Mm,
    -- | allowed chord error on either side, and one pulse
    allowance :: Mm,
    -- | tolerance of the position at the end of the cut
    exitTolerance :: Mm,
    -- | the cut is one of several in its pass: none of them goes along the whole contour
    isPartialCut :: Bool,
    edges :: BoxTree Edge
  }

-- | Elements of the contour in the direction of travel.
elementsOf :: MillingJob -> [Element]
elementsOf = NonEmpty.toList . Part.elements . Part.contour . milling

-- | Test that the contour is closed.
isClosed :: MillingJob -> Bool
isClosed job = Part.ends (Part.contour (milling job)) == Part.Closed

-- | Largest distance from an element to the centre of a cutter that touches it.
contactLimit :: MillingJob -> Mm
contactLimit job = plus (maxReach job) (allowance job)

-- | Elements that a cutter with its centre at a point may touch.
edgesAround :: MillingJob -> Point -> [Edge]
edgesAround job p =
  BoxTree.within (BoundingBox.inflate (contactLimit job) (BoundingBox.ofPoints p [])) (edges job)

-- | Elements that a cutter may touch in a motion.
edgesNear :: MillingJob -> CutterMotion -> [Edge]
edgesNear job m = filter (mayTouch job m) (edgesInBox job m)

-- | 'edgesNear' for each of some motions; fast if they follow one another.
edgesNearEach :: MillingJob -> [CutterMotion] -> [[Edge]]
edgesNearEach job =
  BoxTree.each (BoundingBox.inflate (contactLimit job) . Motion.box) (mayTouch job) (edges job)

-- | Test that a cutter may touch an element in a motion.
mayTouch :: MillingJob -> CutterMotion -> Edge -> Bool
mayTouch job m = \e -> FastDistance.mayComeWithin far (long e) (shape e) (segment m)
  where
    far = let Mm r = contactLimit job in r + FastDistance.uneven (segment m)

-- | Elements whose bounding boxes lie within reach of a motion: those that a cutter may touch, and
-- some others.
edgesInBox :: MillingJob -> CutterMotion -> [Edge]
edgesInBox job m =
  BoxTree.within (BoundingBox.inflate (contactLimit job) (Motion.box m)) (edges job)

-- | Contact points of a cutter with its centre at a point: the numbers of the elements and the arc
-- lengths from the start of the contour. The list has to contain all elements within reach.
contacts :: MillingJob -> [Edge] -> Point -> [(Int, Double)]
contacts job near p = reverse (foldContacts job near p (\found n s -> (n, s) : found) [])

-- | Fold over the contact points, without a list of them. The contact with an arc beyond its ends
-- is the nearer end.
foldContacts :: MillingJob -> [Edge] -> Point -> (b -> Int -> Double -> b) -> b -> b
foldContacts job near p with = go near
  where
    go es b = case es of
      [] -> b
      e : more
        | far <- farthest e,
          FastDistance.mayLieWithin far (long e) (shape e) x y,
          FastDistance.distance (shape e) x y <= far ->
          let b' = with b (rank e) (startsAt e + FastDistance.footOn (shape e) x y * long e)
           in b' `seq` go more b'
        | otherwise -> go more b
    !x = Vec.x p
    !y = Vec.y p
    !(Mm most) = contactLimit job
    !(Mm a) = allowance job
    -- The cutter touches an element with an allowance from further away.
    !least = Edge.leastExcess ownAllowance most near x y
    farthest e = let Mm l = ownAllowance e in min most (least + l + 2 * a)
