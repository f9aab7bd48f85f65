-- | Motions along a contour on the wrong side of it, or against the direction of travel. A /job/ is
-- a cut along a contour as the part demands it ("Verify.MillingJob").
module Verify.WrongSide
  ( wrongSide,
    runsBack,
    strays,
    repeats,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Data.List (minimumBy)
import Data.Maybe (listToMaybe, mapMaybe)
import Data.Ord (comparing)
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part qualified as Part
import Verify.Edge (Edge (element, long, ownAllowance, shape))
import Verify.Edge qualified as Edge
import Verify.MillingJob (MillingJob (..))
import Verify.MillingJob qualified as MillingJob
import Verify.MillingJob.Fast qualified as FastContact
import Verify.Motion (CutterMotion (number, segment))
import Verify.Motion qualified as Motion
import Verify.Proof (Finding (WrongSide))

-- | Finding for the motion @m@ if it runs beside an element on the wrong side of the element.
-- Nothing if it does not, or if the job has no side because the cutter runs on the contour. A line
-- is tested at its middle. An arc is tested midway between neighbouring points; these are its start
-- and 'Motion.samples'. @close@ are the elements that the cutter may touch during the motion.
wrongSide :: MillingJob -> CutterMotion -> [Edge] -> Maybe Finding
wrongSide job m close = do
  demanded <- side job
  let suspicious = filter (mayBeWrong job demanded close around) sampled
  listToMaybe (mapMaybe (wrongAt job demanded m around) suspicious)
  where
    around = MillingJob.edgesInBox job m
    sampled = map (\k -> Segment.at k (segment m)) fractions
    fractions
      | FastDistance.isLine (segment m) = [0.5]
      | otherwise = let ks = Motion.samples m in zipWith (\a b -> (a + b) / 2) (0 : ks) ks

-- | Fast test by bounds for the point @p@ of a motion. True if @p@ may be on the wrong side of the
-- nearest element; 'wrongAt' then decides. False means that 'wrongAt' would surely give Nothing.
-- @demanded@ is the side on which the cutter has to be. The elements @close@, which the cutter may
-- touch, are examined if one of them is surely within 'MillingJob.contactLimit' of @p@. Otherwise
-- the elements @around@ are examined: all whose bounding boxes are near the motion.
mayBeWrong :: MillingJob -> Side -> [Edge] -> [Edge] -> Point -> Bool
mayBeWrong job demanded close around p =
  least > a - FastDistance.unsure && any isWrong near
  where
    (x, y) = (Vec.x p, Vec.y p)
    Mm a = allowance job
    Mm limit = MillingJob.contactLimit job
    leastOf es = FastContact.leastDistance (1 / 0) es x y
    (near, least)
      | ofClose + FastDistance.unsure <= limit = (close, ofClose)
      | otherwise = (around, leastOf around)
    ofClose = leastOf close
    isWrong e =
      FastDistance.mayLieWithin (least + FastDistance.unsure) (long e) (shape e) x y
        && FastDistance.distance (shape e) x y <= least + FastDistance.unsure
        && FastDistance.spansAbout (shape e) x y
        && not (isOn e)
    isOn e = case demanded of
      Carrier.LeftOf -> FastDistance.isLeftOf (FastDistance.spot x y) (shape e)
      Carrier.RightOf -> FastDistance.isRightOf (FastDistance.spot x y) (shape e)

-- | Finding if the point @p@ of the motion @m@ is not on the side @demanded@ of the nearest of the
-- elements @around@, by an exact comparison. Nothing if the distance of @p@ from this element is
-- within the allowed deviation, or if no normal of the element goes through @p@. Nothing also if
-- @p@ is on the demanded side of another element that is as near within the allowed deviation.
wrongAt :: MillingJob -> Side -> CutterMotion -> [Edge] -> Point -> Maybe Finding
wrongAt job demanded m around p = case [(Distance.toPoint p (segmentOf e), e) | e <- around] of
  [] -> Nothing
  distances
    | d > allowance job
        && isBeside nearest
        && not (any isRight [e | (d', e) <- distances, d' <= plus d (allowance job)]) ->
      Just (WrongSide (number m) (Part.origin (element nearest)))
    | otherwise -> Nothing
    where
      (d, nearest) = minimumBy (comparing fst) distances
  where
    segmentOf = Part.segment . element
    isBeside e = Segment.hasFootOf (segmentOf e) p
    isRight e = sideOf job p (segmentOf e) == demanded

-- | Side of the contour on which the point @p@ lies. @s@ is the element nearest to @p@. If its
-- nearest point is a corner, both elements of the corner decide.
sideOf :: MillingJob -> Point -> Segment -> Side
sideOf job p s
  | Edge.leftwardness (edges job) (snd (Distance.nearest p s)) p > 0 = Carrier.LeftOf
  | otherwise = Carrier.RightOf

-- | Test that a motion runs against the direction of travel at one of its test points. The test
-- point of a line is its middle. The test points of an arc lie midway between neighbouring sample
-- points. At a test point the motion has to run against all elements that the cutter touches there
-- and that are nearest within twice the allowed deviation; there has to be at least one. False for
-- a motion so short that rounding decides its direction.
runsBack :: Machine -> MillingJob -> CutterMotion -> Bool
runsBack machine job m =
  Segment.length (segment m) > times 4 pulse && any isBack fractions
  where
    pulse = Machine.planeResolution machine
    fractions = case segment m of
      Straight _ _ -> [0.5]
      Arc {} -> let ks = Motion.samples m in zipWith (\a b -> (a + b) / 2) (0 : ks) ks
    around = MillingJob.edgesInBox job m
    isBack k =
      not (null nearest)
        && all (isAgainst job ahead p) nearest
        && not (isStep job around m ahead || isLengthened job around m ahead p)
      where
        p = Segment.at k (segment m)
        ahead = Segment.directionAt k (segment m)
        nearest = touchedAt job around p

-- | Test that the motion @m@ is a step along the normal of one of the two elements at a vertex. A
-- step leads from the distance of the one to that of the other, where the allowance changes or
-- where one of them is an arc too narrow for the distance. The normals at the ends of such an arc
-- cross, and its allowance ends beyond their crossing. The step may touch another element
-- meanwhile. @around@ are the elements near the motion, @ahead@ is its direction.
isStep :: MillingJob -> [Edge] -> CutterMotion -> Vec -> Bool
isStep job around m ahead =
  or
    [ any (isAlongNormal vertex) [Segment.endDirection (shape e), Segment.startDirection (shape e')]
        && all (isBetween vertex (lowest e e') (largest e e')) (bothEnds m)
      | e <- around,
        e' <- around,
        ownAllowance e /= ownAllowance e' || any isTooNarrow [e, e'],
        let vertex = Segment.end (shape e),
        Vec.isNear vertex (Segment.start (shape e'))
    ]
  where
    isAlongNormal vertex direction =
      abs (Vec.dot direction ahead) < clearly
        && all (\q -> Mm (abs (Vec.dot direction (Vec.to vertex q))) <= allowance job) (bothEnds m)
    largest e e' = max (ownAllowance e) (ownAllowance e')
    lowest e e'
      | any isTooNarrow [e, e'] = Mm 0
      | otherwise = min (ownAllowance e) (ownAllowance e')
    isBetween vertex a b q =
      let d = Vec.distance q vertex
       in d >= minus (plus (reach job) a) (allowance job)
            && d <= plus (plus (reach job) b) (allowance job)
    isTooNarrow e =
      ownAllowance e > Mm 0 && case shape e of
        Arc {start, centre, sweep} ->
          MillingJob.isInsideArc job sweep
            && Segment.radius centre start < plus (reach job) (ownAllowance e)
        Straight _ _ -> False

-- | Test that the motion @m@ lengthens the path beside an element to a sharp corner, in the
-- direction of the element. Another element may be nearer than the corner. @around@ are the
-- elements near the motion, @ahead@ is its direction at its point @p@.
isLengthened :: MillingJob -> [Edge] -> CutterMotion -> Vec -> Point -> Bool
isLengthened job around m ahead p =
  Part.corners (milling job) == Part.Sharp && or [isTangent k e | e <- around, k <- [0, 1]]
  where
    isTangent k e =
      Vec.dot ahead tangent > 0
        && Vec.distance p vertex <= MillingJob.contactLimit job
        && all (\q -> Mm (abs (Vec.cross tangent (Vec.to beside q))) <= allowance job) (bothEnds m)
      where
        vertex = Segment.at k (shape e)
        tangent = Segment.directionAt k (shape e)
        keeps = plus (reach job) (ownAllowance e)
        beside = maybe vertex (\s -> Carrier.beside s keeps tangent vertex) (side job)

-- | Test that a motion leaves the contour at one of its ends or its middle, where the path has no
-- sharp corner. Near such a corner a motion may be further from the contour, up to the corner.
strays :: MillingJob -> CutterMotion -> Bool
strays job m = any isAway [0, 0.5, 1]
  where
    around = MillingJob.edgesInBox job m
    isAway k = not (any (touches p) around) && not (isLengthened job around m ahead p)
      where
        p = Segment.at k (segment m)
        ahead = Segment.directionAt k (segment m)
    touches p e =
      minus (Distance.toPoint p (shape e)) (ownAllowance e) <= plus (reach job) (allowance job)

bothEnds :: CutterMotion -> [Point]
bothEnds m = [Segment.start (segment m), Segment.end (segment m)]

-- | Point of an element that a cutter touches. @excessDistance@ is the distance of the centre from
-- the point, less the allowance of the element.
data Contact = Contact {excessDistance :: Mm, foot :: Point, touched :: Edge}

-- | Contacts of a cutter with its centre at @p@ that are nearest within twice the allowed
-- deviation: the distances from two touched elements may deviate in opposite directions. @close@
-- are the elements near the centre. If the cutter keeps its distance from no element, as at a sharp
-- corner, the elements within 'MillingJob.contactLimit' count.
touchedAt :: MillingJob -> [Edge] -> Point -> [Contact]
touchedAt job close p =
  filter ((<= plus least (times 2 (allowance job))) . excessDistance) contacts
  where
    least = minimum (map excessDistance contacts)
    contacts = if null inContact then within else inContact
    inContact = filter ((<= plus (reach job) (allowance job)) . excessDistance) within
    within =
      [ c
        | e <- close,
          point <- feet e,
          Vec.distance p point <= MillingJob.contactLimit job,
          let c = Contact (minus (Vec.distance p point) (ownAllowance e)) point e,
          -- Beyond the ends of an element its allowance is not in force.
          excessDistance c >= minus (reach job) (allowance job)
      ]
    -- At a tip, the end of an element with an allowance may be touched although the other end is
    -- nearer. An end is touched only between the normals of the two elements at the tip.
    feet e
      | ownAllowance e > Mm 0,
        not (Segment.hasFootOf (shape e) p) =
        filter isBetweenNormals [Segment.start (shape e), Segment.end (shape e)]
      | otherwise = [snd (Distance.nearest p (shape e))]
    isBetweenNormals vertex =
      and
        [ along (Segment.endDirection (shape o)) >= negate deviation
          | o <- close,
            Vec.isNear vertex (Segment.end (shape o))
        ]
        && and
          [ along (Segment.startDirection (shape o)) <= deviation
            | o <- close,
              Vec.isNear vertex (Segment.start (shape o))
          ]
      where
        along direction = Vec.dot direction (Vec.to vertex p)
    Mm deviation = allowance job

-- | Test that another one of the motions @along@ a contour runs over the middle of @m@ in the same
-- direction. On an equidistant no two motions do so: the material beside one of them would lie in
-- the way of the other.
repeats :: MillingJob -> BoxTree CutterMotion -> CutterMotion -> Bool
repeats job along m = not (null (drop 1 (filter (> clearly) (directionsOver job along m))))

-- | Components, in the direction of the motion @m@, of the directions of the motions that run over
-- its middle, with @m@ itself. Motions so short that they turn round within the allowed deviation
-- are left out.
directionsOver :: MillingJob -> BoxTree CutterMotion -> CutterMotion -> [Double]
directionsOver job along m =
  [ Vec.dot (Segment.directionAt 0.5 (segment m)) (Segment.directionAt k s)
    | s <- map segment (BoxTree.within (boxAround job p) along),
      Segment.length s > times 2 (allowance job),
      Distance.toPoint p s <= allowance job,
      let k = Distance.nearestFraction p s,
      k > 0 && k < 1
  ]
  where
    p = Segment.at 0.5 (segment m)

-- | Box around a point that contains all points within the allowed deviation.
boxAround :: MillingJob -> Point -> BoundingBox
boxAround job p = BoundingBox.inflate (allowance job) (BoundingBox.ofPoints p [])

-- | Test that the unit direction @ahead@ at the centre @p@ leads against the direction of travel of
-- an element. A centre beside the element has to move so that it keeps the element on the side
-- opposite to the demanded one. A centre on the element has to move in the direction of the
-- element.
isAgainst :: MillingJob -> Vec -> Point -> Contact -> Bool
isAgainst job ahead p Contact {foot, touched} = case side job of
  Just demanded
    | Vec.distance p foot > allowance job ->
      Carrier.sideSign demanded * Vec.cross ahead (Vec.unit (Vec.to foot p)) < negate clearly
  _ -> Vec.dot ahead (Segment.directionAt share (shape touched)) < negate clearly
  where
    share = Distance.nearestFraction foot (shape touched)

-- | Least component, against the direction of travel, of the unit direction of a motion that counts
-- as running back. A smaller component may be due to rounding.
clearly :: Double
clearly = 0.5
