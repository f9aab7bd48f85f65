-- | The choice of the way down of a pass: what the statement asks for, where there is room.
module Toolpath.DescentChoice
  ( alongContour,
    inPocket,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..))
import Data.List.NonEmpty (NonEmpty (..))
import Geometry.Carrier (Sense (..))
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment)
import Geometry.Vec (Point)
import Part.Part (Milling)
import Part.Part qualified as Part
import Toolpath.Descent (Way)
import Toolpath.Descent qualified as Descent
import Toolpath.DescentReport (DescentFault (..))
import Toolpath.Error (Error (NoDescent))

-- | The way down to a pass along a contour; Nothing if the cutter goes straight down. @reach@ is
-- the distance of the path from the contour, @heights@ are the heights at which the way begins and
-- ends, and @path@ is the path of the pass.
alongContour :: Milling -> Mm -> (Mm, Mm) -> NonEmpty Segment -> Either Error (Maybe Way)
alongContour milling reach heights path = case value (Part.descent milling) of
  Part.Plunging -> Right Nothing
  Part.Ramping angle -> Just <$> found (Descent.ramp angle heights path)
  Part.Spiralling step
    | Descent.isClosed path -> Just <$> found (Descent.spiral step heights path)
    | otherwise -> failed (SpiralInterrupted at)
  Part.Helical pitch diameter -> case reverse (Part.approach milling) of
    [] -> failed (HelixWithoutApproach at)
    Part.Stop (Located _ p) _ _ : _ ->
      Just <$> helixAt milling (pitch, diameter) reach (walls p) heights p
  where
    at = region (Part.descent milling)
    found = maybe (failed (TooManyTurns at Descent.mostTurns)) Right
    failed = Left . NoDescent
    walls p =
      minimum
        (fmap (Distance.toPoint p . Part.segment) (Part.elements (Part.contour milling)))

-- | The way down to a pass of a pocket about the point @p@, or along the path @path@; Nothing if
-- the cutter goes straight down. @reach@ is the distance of the outermost loop from the walls, and
-- @room@ the distance of @p@ from them.
inPocket ::
  Milling -> Mm -> (Mm, Mm) -> (Point, Mm) -> NonEmpty Segment -> Either Error (Maybe Way)
inPocket milling reach heights (p, room) path = case value (Part.descent milling) of
  Part.Helical pitch diameter ->
    Just <$> helixAt milling (pitch, diameter) reach room heights p
  _ -> alongContour milling reach heights path

-- | The helix about the point @p@, whose distance from the walls is @room@. Without a diameter it
-- is the largest one that fits, up to 'Descent.usualShare'.
helixAt ::
  Milling -> (Mm, Maybe Mm) -> Mm -> Mm -> (Mm, Mm) -> Point -> Either Error Way
helixAt milling (pitch, asked) reach room heights p
  | diameter > plus largest (Mm 1e-9) || diameter < least =
    Left (NoDescent (NoRoomForHelix at p asked (max (Mm 0) largest)))
  | otherwise =
    maybe
      (Left (NoDescent (TooManyTurns at Descent.mostTurns)))
      Right
      (Descent.helix sense pitch (times 0.5 diameter) heights p)
  where
    at = region (Part.descent milling)
    cutter = times 2 (Part.radius milling)
    largest = times 2 (minus room reach)
    least = times Descent.leastHelix cutter
    diameter = case asked of
      Just d -> d
      Nothing -> min largest (times Descent.usualShare cutter)
    -- The material is outside of the helix.
    sense
      | climbs == (Part.spindleSense milling == Part.Clockwise) = CounterClockwise
      | otherwise = Clockwise
    climbs = maybe True ((== Part.Climb) . value) (Part.sense milling)
