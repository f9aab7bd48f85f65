-- | Facts about a milling that the proof works out from the part alone: the side of the cutter, the
-- distance of its centre from the contour, and the bevels along the path of a swivelling blade.
--
-- The folder "Toolpath" has functions of its own for the same facts. Nothing is imported from them
-- here, so that the proof notices their mistakes: a tape with a wrong side, distance or bevel then
-- differs from the part.
module Verify.Requirement
  ( cutterSide,
    centreDistance,
    isOnContour,
    facingTheRoom,
    bevels,
  )
where

import Base.Quantity (Mm (..), plus)
import Base.Region (Located (..))
import Control.Applicative ((<|>))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isNothing)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Part.Part (Contour, Milling)
import Part.Part qualified as Part

-- Side and distance -------------------------------------------------------------------------------

-- | Side of the contour on which the cutter has to be, in the direction of travel. Nothing if the
-- cutter runs on the contour. Nothing also if the program says inside or outside of a milled open
-- contour, which has neither. An open turned profile has both: its inside is the side towards the
-- axis of the spindle, @y = 0@. So a tool outside of the profile is on the left if the profile
-- leads to larger x.
cutterSide :: Milling -> Maybe Carrier.Side
cutterSide milling = case value (Part.side milling) of
  Part.On -> Nothing
  Part.LeftSide -> Just Carrier.LeftOf
  Part.RightSide -> Just Carrier.RightOf
  Part.Inside -> interior
  Part.Outside -> fmap Carrier.oppositeSide interior
  where
    contour = Part.contour milling
    interior = case (Part.ends contour, Part.work milling) of
      (Part.Closed, _)
        | isCounterClockwise contour -> Just Carrier.LeftOf
        | otherwise -> Just Carrier.RightOf
      (Part.Open, Part.Turned)
        | Vec.x end >= Vec.x start -> Just Carrier.RightOf
        | otherwise -> Just Carrier.LeftOf
      (Part.Open, _) -> Nothing
    start = Segment.start (Part.segment (NonEmpty.head (Part.elements contour)))
    end = Segment.end (Part.segment (NonEmpty.last (Part.elements contour)))

isCounterClockwise :: Contour -> Bool
isCounterClockwise contour = Polyarc.areaOf Part.segment (Part.elements contour) > 0

-- | Test that the cutter's centre runs on the contour itself.
isOnContour :: Milling -> Bool
isOnContour milling = value (Part.side milling) == Part.On

-- | Distance of the cutter's centre from the contour in a pass that leaves @allowance@. If the
-- cutter runs on the contour, this is @allowance@ alone.
centreDistance :: Milling -> Mm -> Mm
centreDistance milling allowance
  | isOnContour milling = allowance
  | otherwise = plus (Part.radius milling) allowance

-- | Outline and islands of a pocket, directed so that the pocket lies on the left of all of them or
-- on the right of all. An island therefore has the sense opposite to that of the outline.
facingTheRoom :: Contour -> [Contour] -> [Contour]
facingTheRoom outline islands = outline : map facing islands
  where
    facing island
      | isCounterClockwise island == isCounterClockwise outline = Part.reversedContour island
      | otherwise = island

-- Bevels ------------------------------------------------------------------------------------------

-- | Arc length along the contour in mm, and the bevel in radians that is known there.
data Known = Known Double Double

-- | Bevels at the start and at the end of each element, in radians; Nothing if no element has a
-- bevel. Between two elements with a bevel, the bevel changes linearly with arc length. On a closed
-- contour it also does so between the last such element and the first one. On an open contour it is
-- constant before the first such element and after the last one.
bevels :: Contour -> Maybe (Vector (Double, Double))
bevels contour
  | Vector.all (isNothing . Part.bevel) elements = Nothing
  | otherwise = Just (Vector.imap bevelOf elements)
  where
    elements = Vector.fromList (NonEmpty.toList (Part.elements contour))
    bevelOf i element = fromMaybe (bevelAt i i, bevelAt i (i + 1)) (Part.bevel element)
    bevelAt i mark = at i (marks Vector.! mark)
    at i = interpolated (earlier Vector.! i) (later Vector.! i)
    -- Arc lengths at the starts of all elements; the last member is the length of the contour.
    marks = Vector.scanl' (+) 0 (fmap lengthOf elements)
    lengthOf e = let Mm l = Segment.length (Part.segment e) in l
    starts = Vector.imap (\i e -> Known (marks Vector.! i) . fst <$> Part.bevel e) elements
    ends = Vector.imap (\i e -> Known (marks Vector.! (i + 1)) . snd <$> Part.bevel e) elements
    -- Last known bevel at or before each element, and first known bevel at or after it. On a closed
    -- contour the search for them continues across the start.
    earlier = Vector.postscanl' (flip (<|>)) (overStart (-1) lastOf ends) ends
    later = Vector.postscanr' (<|>) (overStart 1 firstOf starts) starts
    overStart sense pick known = case Part.ends contour of
      Part.Open -> Nothing
      Part.Closed -> (\(Known x b) -> Known (x + sense * Vector.last marks) b) <$> pick known
    lastOf = Vector.foldl' (flip (<|>)) Nothing
    firstOf = Vector.foldr (<|>) Nothing

-- | Bevel in radians at the arc length @x@ in mm, interpolated linearly between the known bevels
-- before and after it. If only one of them is known, the result is that bevel; if none is known, it
-- is 0.
interpolated :: Maybe Known -> Maybe Known -> Double -> Double
interpolated before after x = case (before, after) of
  (Just (Known p a), Just (Known q b))
    | q > p -> a + (b - a) * (x - p) / (q - p)
    | otherwise -> a
  (Just (Known _ a), Nothing) -> a
  (Nothing, Just (Known _ b)) -> b
  (Nothing, Nothing) -> 0
