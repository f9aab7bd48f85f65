-- | Judges the motions of a lathe that lead to its retract positions and back. In such a motion the
-- place along X or Z is not known in work coordinates.
--
-- X and Z move one after the other, and only in these steps:
--
-- * X to its retract position, whatever Z is;
-- * Z while X is at its retract position;
-- * Z to its retract position from a place in work coordinates, and then X, as after the inside of
--   the part was turned;
-- * the same steps back.
--
-- A step from a place in work coordinates, or to one, must not pass through the turned profiles.
module Verify.LatheMove
  ( LatheDemand (..),
    Nose (..),
    faults,
    comesToWork,
  )
where

import Base.Quantity (Mm (..), plus)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, mapMaybe)
import Gcode.ModalState
import Gcode.Run (Coordinate (..), Step (..), ToolPlace (..), Travel (..), picometres)
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.ProgramForm (XMeaning)
import Verify.ControlFault (ControlFault (..))

-- | Demands of a program on the motions of a lathe.
data LatheDemand = LatheDemand
  { wordsOfX :: XMeaning,
    -- | segments of the turned profiles
    profiles :: [Segment],
    -- | the tools by their numbers
    noses :: Map Int Nose,
    -- | largest deviation in mm of a cut from its profile
    slack :: Mm
  }
  deriving stock (Eq, Show)

-- | Nose of a turning tool: its radius, and the way in mm from its centre to the point that the
-- control leads, along x and y of the part.
data Nose = Nose {noseRadius :: Mm, tipX :: Mm, tipY :: Mm}
  deriving stock (Eq, Show)

-- | Test that a motion leads from the retract positions to a place in work coordinates.
comesToWork :: Travel -> Bool
comesToWork travel = not (isKnown (from travel)) && isKnown (to travel)

isKnown :: ToolPlace -> Bool
isKnown p = isAt (placeX p) && isAt (placeZ p)

isAt :: Coordinate -> Bool
isAt c = case c of
  At _ -> True
  InMachine _ -> False
  Retracted -> False
  Anywhere -> False

-- | Faults of a motion whose beginning or end is not in work coordinates.
faults :: LatheDemand -> Step -> Travel -> [ControlFault]
faults demand step travel
  | isKnown begin && isKnown finish = []
  | movesX && movesZ = [LatheOrder]
  | movesX = stepOfX
  | movesZ = stepOfZ
  | otherwise = []
  where
    begin = from travel
    finish = to travel
    movesX = placeX begin /= placeX finish
    movesZ = placeZ begin /= placeZ finish
    crossing = [ThroughProfile | any (crosses demand step) (passages begin finish)]
    stepOfX = case (placeX begin, placeX finish, placeZ finish) of
      (_, Retracted, _) -> crossing
      (_, At _, Retracted) -> []
      (Retracted, At _, At _) -> crossing
      (_, _, _) -> [LatheOrder]
    stepOfZ = case (placeZ begin, placeZ finish, placeX finish) of
      (_, At _, Retracted) -> []
      (_, Retracted, Retracted) -> []
      (At _, Retracted, At _) -> crossing
      (Retracted, At _, At _) -> crossing
      (_, _, _) -> [LatheOrder]

-- | Passage of the point that the control leads: a place in picometres along Z and X, and true if
-- the tool moves along X from there outwards, or comes that way.
data Passage = Passage (Int, Int) Bool

-- | The passage from the work to a retract position, or back.
passages :: ToolPlace -> ToolPlace -> [Passage]
passages begin finish = mapMaybe passageAt [begin, finish]
  where
    passageAt p = case (placeZ p, placeX p) of
      (At z, At x) -> Just (Passage (z, x) (placeZ begin == placeZ finish))
      _ -> Nothing

-- | Test that the tool passes through a profile. A nose may come as near as its radius less the
-- slack. A nose within the slack is taken for a point: it passes through if it would do so at
-- either side of its way.
crosses :: LatheDemand -> Step -> Passage -> Bool
crosses demand step (Passage (z, x) isAlongX)
  | noseRadius nose > slack demand =
    any (\s -> distanceOf (wayFrom 0 0) s < r - d - 1.0e-6) (profiles demand)
  | otherwise = meets d && meets (-d)
  where
    Mm r = noseRadius nose
    Mm d = slack demand
    nose =
      Map.findWithDefault
        (Nose (Mm 0) (Mm 0) (Mm 0))
        (fromMaybe 0 (valueOf (toolInSpindle (state step))))
        (noses demand)
    Mm dx = tipX nose
    Mm dy = tipY nose
    centre = Vec.point (picometres z - dx) (picometres x - dy)
    far = farthest demand
    wayFrom along aside
      | isAlongX = way (Vec.x centre + aside, Vec.y centre + along) (Vec.x centre + aside, far)
      | otherwise = way (Vec.x centre + along, Vec.y centre + aside) (far, Vec.y centre + aside)
    way (a, b) (a', b') = Straight (Vec.point a b) (Vec.point (max a a') (max b b'))
    meets aside = any (\s -> distanceOf (wayFrom d aside) s < 1.0e-6) (profiles demand)
    distanceOf w s = let Mm l = Distance.distance (Distance.segments w s) in l

-- | A coordinate beyond all profiles.
farthest :: LatheDemand -> Double
farthest demand = maximum (0 : concatMap ends (profiles demand)) + reach
  where
    ends s = concatMap coordinates [Segment.start s, Segment.end s, Segment.at 0.5 s]
    coordinates :: Point -> [Double]
    coordinates p = [Vec.x p, Vec.y p]
    Mm reach = foldr (plus . noseRadius) (Mm 1000) (Map.elems (noses demand))
