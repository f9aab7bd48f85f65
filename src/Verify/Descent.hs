-- | Judgement of the ways down of a toolpath: ramps, helices and spirals. The proof asks for the
-- moves of a way down only if they are what the statement allows. So a toolpath that goes down in
-- another manner makes a tape that is refused.
module Verify.Descent
  ( Slope (..),
    highest,
    alongContour,
    inPocket,
    isOn,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times)
import Base.Region (Located (..))
import Control.Motion (Motion)
import Control.Motion qualified as Control
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier (Side)
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Part.Part (Milling)
import Part.Part qualified as Part
import Toolpath.Toolpath (Move)
import Toolpath.Toolpath qualified as Toolpath
import Verify.MotionSet qualified as MotionSet

-- | A part of a way down: its line or arc in the plane, and its heights.
data Slope = Slope {path :: Segment, between :: (Mm, Mm)}

-- | The height at which the way down to a pass at the height @level@ begins: the next higher pass,
-- or the height at which the material begins.
highest :: Milling -> Mm -> Mm
highest milling level =
  minimum (Part.materialTop milling : filter (> level) (Part.levels milling))

-- | The way down at the beginning of the moves of a toolpath before a cut, and the moves after it.
-- Nothing if the way is not as the statement asks. @side@ is the cutter's side of the contour,
-- @reaches@ are the least and the largest distance of the path from the contour, @level@ is the
-- height of the pass, and @begin@ the beginning of the cut.
alongContour :: Milling -> Maybe Side -> (Mm, Mm) -> Mm -> Point -> [Move] -> Maybe [Slope]
alongContour milling side reaches level begin moves = case value (Part.descent milling) of
  Part.Plunging -> Just []
  Part.Ramping angle
    | isJoined milling level slopes && all (isFlatEnough angle) slopes && beside && ends begin ->
      Just slopes
  Part.Spiralling step
    | isJoined milling level slopes && beside && ends begin,
      fromIntegral (laps slopes) * number step >= number (minus top level) - tiny ->
      Just slopes
  Part.Helical pitch diameter
    | Just p <- lastApproach milling,
      isHelix milling (pitch, diameter) level p slopes ->
      Just slopes
  _ -> Nothing
  where
    top = highest milling level
    slopes = slopesOf milling moves
    beside = all (isBeside milling side reaches) slopes
    ends p = any (\s -> Vec.isNear (Segment.end (path s)) p) (take 1 (reverse slopes))
    isFlatEnough (Rad angle) = isWithin (max (tan angle) (steepestTab milling))
    number (Mm x) = x
    -- Over tabs the path rises, so that a lap there is not judged by its slope.
    laps ss = length (filter (\s -> Vec.isNear (Segment.start (path s)) begin) ss)

-- | The parts of a way down among the moves before a cut. After a helix come moves to the cut.
slopesOf :: Milling -> [Move] -> [Slope]
slopesOf milling moves = case value (Part.descent milling) of
  Part.Helical _ _ ->
    let (arcs, others) = span (isArc . path) all' in arcs <> take 1 others
  _ -> all'
  where
    all' = map (\m -> Slope (Toolpath.segment m) (Toolpath.heights m)) moves
    isArc s = case s of
      Arc {} -> True
      Straight _ _ -> False

-- | The ways down among the moves of a pass of a pocket: those parts that are as the statement
-- asks.
inPocket :: Milling -> Mm -> NonEmpty Move -> [Slope]
inPocket milling level moves = filter isRight (map slope (filter descends (NonEmpty.toList moves)))
  where
    slope m = Slope (Toolpath.segment m) (Toolpath.heights m)
    descends m = uncurry (/=) (Toolpath.heights m) && Segment.length (Toolpath.segment m) > Mm 0
    isRight s =
      isBetween s && case value (Part.descent milling) of
        Part.Ramping (Rad angle) -> isWithin (tan angle) s
        Part.Helical pitch diameter -> isTurn milling (pitch, diameter) s
        _ -> False
    isBetween s =
      let (a, b) = between s in a > b && a <= highest milling level && b >= level

-- | The last stop of the approach.
lastApproach :: Milling -> Maybe Point
lastApproach milling = case reverse (Part.approach milling) of
  Part.Stop (Located _ p) _ _ : _ -> Just p
  [] -> Nothing

-- | Test that parts of a way down follow one another, from the height at which the way begins to
-- the height of the pass.
isJoined :: Milling -> Mm -> [Slope] -> Bool
isJoined milling level slopes = case slopes of
  [] -> False
  first : more ->
    isBegin (fst (between first))
      && isEqual (snd (between (foldl (\_ s -> s) first more))) level
      && and (zipWith follows slopes more)
  where
    follows a b =
      Vec.isNear (Segment.end (path a)) (Segment.start (path b))
        && isEqual (snd (between a)) (fst (between b))
    isEqual a b = let Mm d = minus a b in abs d <= tiny
    -- The way down may begin over a tab.
    isBegin z =
      isEqual z top
        || any (\(Located _ t) -> z <= Part.tabTop t && z >= top) (Part.tabs milling)
    top = highest milling level

-- | Test that a part of a way down is not steeper than the tangent @steepest@.
isWithin :: Double -> Slope -> Bool
isWithin steepest s = max (minus a b) (minus b a) <= plus (times steepest long) (Mm tiny)
  where
    long = Segment.length (path s)
    (a, b) = between s

-- | The tangent of the angle of the sides of the statement's tabs; 0 without tabs.
steepestTab :: Milling -> Double
steepestTab milling = case Part.tabs milling of
  Just (Located _ t) -> let Rad a = Part.tabSides t in tan a
  Nothing -> 0

-- | Test that a way down is a helix about @p@, with a full circle at its end, and a line to @p@.
isHelix :: Milling -> (Mm, Maybe Mm) -> Mm -> Point -> [Slope] -> Bool
isHelix milling asked level p slopes = case reverse slopes of
  inwards : final : turns ->
    isJoined milling level slopes
      && all (isTurn milling asked) (final : turns)
      && all (isAbout . path) (final : turns)
      && isFull (path final)
      && between final == (level, level)
      && between inwards == (level, level)
      && Vec.isNear (Segment.end (path inwards)) p
  _ -> False
  where
    isAbout s = case s of
      Arc {centre} -> Vec.isNear centre p
      Straight _ _ -> False
    isFull s = case s of
      Arc {sweep = Rad a} -> abs a >= 2 * pi - tiny
      Straight _ _ -> False

-- | Test that a part of a way down is an arc whose pitch and diameter are as asked. The path of the
-- centre is at most as wide as the cutter.
isTurn :: Milling -> (Mm, Maybe Mm) -> Slope -> Bool
isTurn milling (pitch, diameter) s = case path s of
  Arc {start, centre, sweep = Rad a} ->
    let r = Segment.radius centre start
        (from, to) = between s
     in r <= plus (Part.radius milling) (Mm tiny)
          && all (\d -> let Mm e = minus (times 2 r) d in abs e <= tiny) diameter
          && minus from to <= plus (times (abs a / (2 * pi)) pitch) (Mm tiny)
  Straight _ _ -> False

-- | Test that a part of a way down stays beside the contour, on the cutter's side.
isBeside :: Milling -> Maybe Side -> (Mm, Mm) -> Slope -> Bool
isBeside milling side (least, most) s = all isThere [0, 0.125 .. 1]
  where
    elements = map Part.segment (NonEmpty.toList (Part.elements (Part.contour milling)))
    isThere k =
      let p = Segment.at k (path s)
          d = minimum (map (Distance.toPoint p) elements)
       in plus d tolerance >= least && d <= plus most tolerance && isOnSide p d
    isOnSide p d = case side of
      Nothing -> True
      Just wanted ->
        any
          (\e -> not (Segment.isBehind wanted e p))
          [e | e <- elements, Distance.toPoint p e <= plus d tolerance]
    tolerance = plus Tolerance.curve Tolerance.coincident

-- | Test that a motion runs along a part of a way down, in the plane within @slack@, and at its
-- heights.
isOn :: Machine -> Mm -> Motion -> Slope -> Bool
isOn machine slack m s = all isThere [0, 0.25 .. 1]
  where
    (from, to) = Control.height machine m
    (high, low) = between s
    long = Segment.length (path s)
    isThere k =
      let p = Segment.at k (Control.segment machine m)
          z = plus from (times k (minus to from))
          foot = Distance.nearestFraction p (path s)
       in Distance.toPoint p (path s) <= slack
            && any (isHeight z) (foot : [1 - foot | over slack long > min foot (1 - foot)])
    isHeight z k =
      MotionSet.isSameHeight machine z (plus high (times k (minus low high)))
        || let Mm d = minus z (plus high (times k (minus low high)))
            in Mm (abs d) <= plus (times (over (minus high low) long) slack) (Mm tiny)

-- | Rounding of double precision, in mm or radians.
tiny :: Double
tiny = 1e-6
