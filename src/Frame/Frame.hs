-- | Frames: what a controller does at once, in whole pulses along the axes of the part.
--
-- The module owns the frame, the program of frames and the rules that every frame of a machine
-- keeps; 'violations' lists the broken rules. 'position', 'height', 'centreOf' and 'segment'
-- convert pulses to mm. Passes are numbered from 0, and frames from 1.
module Frame.Frame
  ( Frame (..),
    mostFrames,
    FrameMotion (..),
    commandFrame,
    isMoving,
    isStill,
    turnAbout,
    turnedAxes,
    PlannedFrame (..),
    Role (..),
    passNumber,
    FrameProgram (..),
    position,
    height,
    centreOf,
    segment,
    Violation (..),
    violations,
    frameViolations,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Base.Region (Region)
import Geometry.Carrier (Sense (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine
  ( Arcs (..),
    Axis (..),
    AxisMeasure (..),
    CommandName,
    FeedCode (..),
    Machine,
    RotaryAxis (..),
    RotaryForm (..),
  )
import Machine.Machine qualified as Machine

-- | Largest number of frames of a program. With 15 rows of 2.54 mm for each frame, so many frames
-- need 38 km of tape.
mostFrames :: Int
mostFrames = 1000000

-- | One frame in the machine's own numbers: pulses, the feed code and the numbers of commands. Even
-- if the tape holds absolute positions, a frame here has increments.
data Frame = Frame
  { motion :: FrameMotion,
    -- | pulses along x, y and z from the beginning of the frame to its end
    increment :: {-# UNPACK #-} Pulses3,
    -- | pulses about the rotary axes a and b from the beginning of the frame to its end; 0 in all
    -- frames of a part program
    turn :: {-# UNPACK #-} Pulses2,
    -- | pulses along x and y from the beginning of an arc to its centre; 0 for every other motion
    centre :: {-# UNPACK #-} Pulses2,
    -- | feed code; 0 for a frame without motion and for 'Rapid'
    feedCode :: FeedCode,
    -- | True when the frame is marked as braking: the cutter slows down to the feed of the frame
    braking :: Bool,
    -- | commands with their numbers, in the order that they have in the machine's frame layout;
    -- each at most once
    commands :: [(CommandName, Int)]
  }
  deriving stock (Eq, Show)

-- | Kind of motion in a frame.
data FrameMotion
  = -- | none: the frame holds only commands
    NoMotion
  | -- | rapid move, on machines that have a motion code for it; on all others a rapid move is a
    -- straight line with the feed code of rapid moves
    Rapid
  | -- | straight line
    Linear
  | -- | circular arc in the plane x, y. An arc whose increments along x and y are 0 is a full
    -- circle. If z has an increment, the arc is a helix, and z changes in proportion to the angle
    Circular Sense
  deriving stock (Eq, Show)

-- | Frame that holds only the commands @given@.
commandFrame :: [(CommandName, Int)] -> Frame
commandFrame given =
  Frame
    { motion = NoMotion,
      increment = 0,
      turn = 0,
      centre = 0,
      feedCode = FeedCode 0,
      braking = False,
      commands = given
    }

-- | True for a frame with a motion.
isMoving :: Frame -> Bool
isMoving f = motion f /= NoMotion

-- | True for a frame without pulses on any axis, linear or rotary.
isStill :: Frame -> Bool
isStill f = increment f == 0 && turn f == 0

-- | Pulses about the rotary axis @a@ from the beginning of a frame to its end.
turnAbout :: RotaryAxis -> Frame -> Pulses
turnAbout axis f = case (axis, turn f) of
  (A, Pulses2 a _) -> a
  (B, Pulses2 _ b) -> b

-- | Rotary axes that a frame turns.
turnedAxes :: Frame -> [RotaryAxis]
turnedAxes f
  | turn f == 0 = []
  | otherwise = filter (\axis -> turnAbout axis f /= 0) [minBound .. maxBound]

-- | Frame with its purpose and its origin in the part program.
data PlannedFrame = PlannedFrame
  { frame :: Frame,
    role :: Role,
    -- | the text in the part program that asks for the frame
    origin :: Region,
    -- | radius in mm of the cutter in the spindle; 0 for a frame of commands
    cutterRadius :: Mm,
    -- | tool in the spindle: the count of tool changes before the frame; 0 for a frame of commands
    toolIndex :: Int
  }
  deriving stock (Eq, Show)

-- | Purpose of a frame. The first three purposes have the number of the pass along a contour or in
-- a pocket, from 0. Drilling and carving have the number of their block in the toolpath, from 0.
data Role
  = Approaching Int
  | Cutting Int
  | Retracting Int
  | Linking
  | Drilling Int
  | Carving Int
  | Commanding
  deriving stock (Eq, Show)

-- | Number of the pass to which a frame belongs, from 0; Nothing for frames outside of passes.
passNumber :: Role -> Maybe Int
passNumber role = case role of
  Approaching n -> Just n
  Cutting n -> Just n
  Retracting n -> Just n
  Linking -> Nothing
  Drilling _ -> Nothing
  Carving _ -> Nothing
  Commanding -> Nothing

-- | All frames of a tape, and the position of the cutter before the first one, in pulses from the
-- zero of the part.
data FrameProgram = FrameProgram {start :: Pulses3, plannedFrames :: [PlannedFrame]}
  deriving stock (Eq, Show)

-- | Position in mm in the plane x, y, from a position in pulses.
position :: Machine -> Pulses3 -> Point
position machine (Pulses3 (Pulses x) (Pulses y) _) =
  Vec.point (fromIntegral x * px) (fromIntegral y * py)
  where
    Mm px = Machine.resolutionOf machine X
    Mm py = Machine.resolutionOf machine Y

-- | Height in mm, from a position in pulses.
height :: Machine -> Pulses3 -> Mm
height machine (Pulses3 _ _ (Pulses z)) =
  let Mm p = Machine.resolutionOf machine Z in Mm (fromIntegral z * p)

-- | Centre in mm of the arc of the frame @f@, which begins at the given position in pulses.
centreOf :: Machine -> Pulses3 -> Frame -> Point
centreOf machine (Pulses3 x y z) f =
  let Pulses2 i j = centre f in position machine (Pulses3 (x + i) (y + j) z)

-- | Line or arc in mm that the frame @f@ describes in the plane, from the position @at@ in pulses.
-- An arc has the centre of the frame and ends where the frame ends. Start, end and centre are
-- rounded, so the radii at the arc's start and at its end may differ.
segment :: Machine -> Pulses3 -> Frame -> Segment
segment machine at f = case motion f of
  Circular sense -> Segment.arcOrCircle sense (centreOf machine at f) begin finish
  _ -> Straight begin finish
  where
    begin = position machine at
    finish = position machine (at + increment f)

-- | Violation of a rule by a frame. The first argument of every constructor is the number of the
-- frame, from 1.
data Violation
  = -- | an increment that does not fit its field: the axis, and the increment in pulses
    OverCapacity Int Axis Pulses
  | -- | a turn that does not fit its field, or about an axis that the machine lacks: the axis, and
    -- the turn in pulses
    TurnOverCapacity Int RotaryAxis Pulses
  | -- | a centre that is at the beginning of its arc, or that does not fit its field
    BadCentre Int
  | -- | a feed code that the machine does not have, or a feed code other than 0 where the motion
    -- takes none
    NoSuchFeedCode Int FeedCode
  | -- | a motion that the machine does not have, or that contradicts its increments
    NoSuchMotion Int
  | -- | a command that the machine does not have, or a command given twice
    UnknownCommand Int CommandName
  | -- | a frame without motion and without commands
    EmptyFrame Int
  deriving stock (Eq, Show)

-- | All broken rules in the frames of a program, in the order of the frames; empty for valid
-- frames.
violations :: Machine -> [Frame] -> [Violation]
violations machine = concat . zipWith (frameViolations machine) [1 ..]

-- | Rules that the frame @f@ with the number @n@ breaks. Nearly all frames keep every rule; for
-- them no list is built. The functions from 'capacityFaults' to 'commandFaults' have the same
-- arguments.
frameViolations :: Machine -> Int -> Frame -> [Violation]
frameViolations machine n f = case faults of
  Faults [] [] [] [] | not isEmpty -> []
  Faults fields feeds motions repeated ->
    fields <> feeds <> motions <> repeated <> [EmptyFrame n | isEmpty]
  where
    faults =
      Faults
        (capacityFaults machine n f)
        (feedCodeFaults machine n f)
        (motionFaults machine n f)
        (commandFaults machine n f)
    isEmpty = not (isMoving f) && null (commands f)

-- | Broken rules of a frame in four lists: on increments, feed codes, motions and commands.
data Faults = Faults [Violation] [Violation] [Violation] [Violation]

-- | Increments that do not fit their fields. A field for absolute positions limits the position and
-- not the increment, so nothing is checked there, except that the machine has the rotary axes.
capacityFaults :: Machine -> Int -> Frame -> [Violation]
capacityFaults machine n f =
  [ OverCapacity n axis d
    | hasIncrements,
      (axis, d) <- [(X, x), (Y, y), (Z, z)],
      abs d > Machine.capacity machine axis
  ]
    <> [ TurnOverCapacity n axis d
         | axis <- turnedAxes f,
           let d = turnAbout axis f,
           axis `notElem` map rotaryAxis (Machine.rotaryAxes machine)
             || hasIncrements && abs d > Machine.turnCapacity machine axis
       ]
  where
    hasIncrements = Machine.measure (Machine.layout machine) == Increments
    Pulses3 x y z = increment f

-- | Feed codes that the machine does not have, or that the frame's motion does not take.
feedCodeFaults :: Machine -> Int -> Frame -> [Violation]
feedCodeFaults machine n f = case motion f of
  NoMotion -> [NoSuchFeedCode n (feedCode f) | feedCode f /= FeedCode 0]
  Rapid -> [NoSuchFeedCode n (feedCode f) | feedCode f /= FeedCode 0]
  Linear -> unknown
  Circular _ -> unknown
  where
    unknown = [NoSuchFeedCode n (feedCode f) | not (Machine.hasFeedCode machine (feedCode f))]

-- | Motions that the machine does not have, or that contradict the frame's increments or centre.
-- Only lines and rapid moves turn rotary axes.
motionFaults :: Machine -> Int -> Frame -> [Violation]
motionFaults machine n f = case motion f of
  NoMotion -> [NoSuchMotion n | not (isStill f) || centre f /= 0]
  Rapid ->
    [NoSuchMotion n | isStill f || centre f /= 0 || not (Machine.hasRapidMotion machine)]
  Linear -> [NoSuchMotion n | isStill f || centre f /= 0]
  Circular sense -> case Machine.arcs machine of
    NoArcs -> [NoSuchMotion n]
    Arcs {Machine.fullCircle, Machine.quadrants, Machine.rising} ->
      [ NoSuchMotion n
        | (x == 0 && y == 0 && not fullCircle)
            || (z /= 0 && not rising)
            || turn f /= 0
            || (quadrants && not (isInQuadrant sense f))
      ]
        <> [BadCentre n | centre f == 0 || max (abs i) (abs j) > Machine.centreCapacity machine]
  where
    Pulses3 x y z = increment f
    Pulses2 i j = centre f

-- | Commands that the machine cannot encode, or that occur twice.
commandFaults :: Machine -> Int -> Frame -> [Violation]
commandFaults machine n f =
  [ UnknownCommand n o
    | (k, (o, v)) <- zip [0 :: Int ..] (commands f),
      o `elem` map fst (take k (commands f)) || not (Machine.canEncode machine o v)
  ]

-- | True for an arc within one quadrant about its centre, computed in whole pulses: both ends lie
-- in the same quadrant, and the arc does not leave this quadrant between them.
isInQuadrant :: Sense -> Frame -> Bool
isInQuadrant sense f = a * c >= 0 && b * d >= 0 && isForward (a * d - b * c)
  where
    Pulses2 i j = centre f
    Pulses3 x y _ = increment f
    (a, b) = (-i, -j)
    (c, d) = (x - i, y - j)
    isForward cross = case sense of
      CounterClockwise -> cross > 0
      Clockwise -> cross < 0
