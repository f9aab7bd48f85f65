{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Frames: what a controller is told, in whole pulses along the axes of the part.
module Frame.Frame
  ( Frame (..),
    FrameMotion (..),
    still,
    isMoving,
    Planned (..),
    Role (..),
    passOf,
    FrameProgram (..),
    position,
    height,
    centreOf,
    segment,
    Broken (..),
    invariants,
    broken,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), Rad (..))
import Base.Region (Region)
import Data.Maybe (isNothing)
import Geometry.Carrier (Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), Axis (..), AxisMeasure (..), CommandName, FeedCode (..), Machine)
import Machine.Machine qualified as Machine

-- | What stands on the tape.
data Frame = Frame
  { motion :: FrameMotion,
    increment :: {-# UNPACK #-} Pulses3,
    -- | of an arc: from its beginning to its centre; else 0
    centre :: {-# UNPACK #-} Pulses2,
    -- | 0 where nothing moves, and where a rapid move is a motion of its own
    speed :: FeedCode,
    -- | it slows down to its speed
    braking :: Bool,
    -- | commands with their numbers, in the order of the layout's words; each at most once
    orders :: [(CommandName, Int)]
  }
  deriving stock (Eq, Show)

data FrameMotion
  = Still
  | -- | only on machines that have a motion for it; elsewhere it is straight at the highest speed
    Rapid
  | Straightway
  | -- | an arc in the plane; with no increment a full circle
    Round Sense
  deriving stock (Eq, Show)

-- | A frame that only commands.
still :: [(CommandName, Int)] -> Frame
still given =
  Frame
    { motion = Still,
      increment = 0,
      centre = 0,
      speed = FeedCode 0,
      braking = False,
      orders = given
    }

isMoving :: Frame -> Bool
isMoving f = motion f /= Still

-- | A frame with the reason for it.
data Planned = Planned
  { frame :: Frame,
    role :: Role,
    origin :: Region,
    -- | the radius of the cutter in the spindle
    tool :: Mm
  }
  deriving stock (Eq, Show)

-- | What a frame does. The number counts the passes along contours and in pockets from 0.
data Role = Approaching Int | Cutting Int | Retracting Int | Travelling | Drilling | Commanding
  deriving stock (Eq, Show)

-- | The number of the pass to which a frame belongs.
passOf :: Role -> Maybe Int
passOf role = case role of
  Approaching n -> Just n
  Cutting n -> Just n
  Retracting n -> Just n
  Travelling -> Nothing
  Drilling -> Nothing
  Commanding -> Nothing

-- | The frames of a tape, and where the cutter stands before the first, in pulses from the zero of
-- the part.
data FrameProgram = FrameProgram {start :: Pulses3, planned :: [Planned]}
  deriving stock (Eq, Show)

-- | A position in mm, in the plane.
position :: Machine -> Pulses3 -> Point
position machine (Pulses3 (Pulses x) (Pulses y) _) =
  Vec.point (fromIntegral x * px) (fromIntegral y * py)
  where
    Mm px = Machine.pulseOf machine X
    Mm py = Machine.pulseOf machine Y

-- | The height of a position in mm.
height :: Machine -> Pulses3 -> Mm
height machine (Pulses3 _ _ (Pulses z)) =
  let Mm p = Machine.pulseOf machine Z in Mm (fromIntegral z * p)

-- | The centre of an arc that begins at a position.
centreOf :: Machine -> Pulses3 -> Frame -> Point
centreOf machine (Pulses3 x y z) f =
  let Pulses2 i j = centre f in position machine (Pulses3 (x + i) (y + j) z)

-- | What a frame does in the plane from a position, in mm. The radius of an arc may differ at its
-- ends by rounding; the segment goes about the centre of the frame and ends where the frame ends.
segment :: Machine -> Pulses3 -> Frame -> Segment
segment machine at f = case motion f of
  Round turn
    | begin == finish ->
      Segment.Arc
        { Segment.start = begin,
          Segment.end = finish,
          Segment.centre = middle,
          Segment.sweep = Rad (Carrier.sense turn * 2 * pi)
        }
    | otherwise -> Segment.arc turn middle begin finish
  _ -> Straight begin finish
  where
    begin = position machine at
    finish = position machine (at + increment f)
    middle = centreOf machine at f

-- | A rule that a frame breaks; the frame's number from 1.
data Broken
  = -- | an increment that its field does not hold
    OverCapacity Int Axis Pulses
  | -- | a centre that its field does not hold, or that is none
    BadCentre Int
  | -- | a feed code that the machine does not have, or none where the frame moves
    NoSuchSpeed Int FeedCode
  | -- | a motion that the machine does not have, or that its increments contradict
    NoSuchMotion Int
  | -- | a command that the machine does not have, or one given twice
    NoSuchOrder Int CommandName
  | -- | a frame that moves nothing and commands nothing
    Idle Int
  deriving stock (Eq, Show)

-- | The rules that every list of frames for a machine keeps; the ones that are broken.
invariants :: Machine -> [Frame] -> [Broken]
invariants machine = concat . zipWith (broken machine) [1 ..]

-- | The rules that a frame with a number breaks. Most frames keep them all, and nothing is made for
-- them.
broken :: Machine -> Int -> Frame -> [Broken]
broken machine n f
  | null fields && null speeds && null motions && null commands && not idle = []
  | otherwise = fields <> speeds <> motions <> commands <> [Idle n | idle]
  where
    !fields = inFields machine n f
    !speeds = atSpeed machine n f
    !motions = asMoved machine n f
    !commands = asCommanded machine n f
    !idle = not (isMoving f) && null (orders f)

-- What a field of positions holds depends on where the tape stands; there the increments are free.
inFields :: Machine -> Int -> Frame -> [Broken]
inFields machine n f =
  [ OverCapacity n axis d
    | Machine.measure (Machine.layout machine) == Increments,
      (axis, d) <- [(X, x), (Y, y), (Z, z)],
      abs d > Machine.capacity machine axis
  ]
  where
    Pulses3 x y z = increment f

atSpeed :: Machine -> Int -> Frame -> [Broken]
atSpeed machine n f = case motion f of
  Still -> [NoSuchSpeed n (speed f) | speed f /= FeedCode 0]
  Rapid -> [NoSuchSpeed n (speed f) | speed f /= FeedCode 0]
  Straightway -> known
  Round _ -> known
  where
    known = [NoSuchSpeed n (speed f) | isNothing (Machine.valueOf machine (speed f))]

asMoved :: Machine -> Int -> Frame -> [Broken]
asMoved machine n f = case motion f of
  Still -> [NoSuchMotion n | increment f /= 0 || centre f /= 0]
  Rapid ->
    [NoSuchMotion n | increment f == 0 || centre f /= 0 || not (Machine.hasRapidMotion machine)]
  Straightway -> [NoSuchMotion n | increment f == 0 || centre f /= 0]
  Round turn -> case Machine.arcs machine of
    NoArcs -> [NoSuchMotion n]
    Arcs {Machine.fullCircle = whole, Machine.quadrants = parts} ->
      [ NoSuchMotion n
        | (increment f == 0 && not whole) || z /= 0 || (parts && not (inQuadrant turn f))
      ]
        <> [BadCentre n | centre f == 0 || max (abs i) (abs j) > Machine.centreCapacity machine]
  where
    Pulses3 _ _ z = increment f
    Pulses2 i j = centre f

asCommanded :: Machine -> Int -> Frame -> [Broken]
asCommanded machine n f =
  [ NoSuchOrder n o
    | (k, (o, v)) <- zip [0 :: Int ..] (orders f),
      o `elem` map fst (take k (orders f)) || not (Machine.canOrder machine o v)
  ]

-- | Whether an arc keeps to one quadrant about its centre, by whole pulses: its ends lie in one,
-- and it goes from one to the other without leaving it.
inQuadrant :: Sense -> Frame -> Bool
inQuadrant turn f = a * c >= 0 && b * d >= 0 && forwards (a * d - b * c)
  where
    Pulses2 i j = centre f
    Pulses3 x y _ = increment f
    (a, b) = (-i, -j)
    (c, d) = (x - i, y - j)
    forwards cross = case turn of
      CounterClockwise -> cross > 0
      Clockwise -> cross < 0
