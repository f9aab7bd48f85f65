-- | Model of cutter compensation (G41, G42) in the control: the path of the cutter's centre while
-- the frames describe the edge of the part. The model follows LinuxCNC; a test compares the paths
-- of both. Without compensation, the centre moves as the frames say.
--
-- * Entry: the first motion goes straight from the present position of the centre to a point beside
--   the end of the programmed motion, one cutter radius to the side of it. A corner at that end is
--   treated like a corner of the contour, as described below.
-- * Contour: each later motion is the offset of the programmed one; an arc keeps its centre. At a
--   corner that turns away from the cutter, the centre goes round the corner on an arc. At a corner
--   that turns towards the cutter, both offsets are trimmed at their intersection. If the direction
--   changes by less than 'Tolerance.controlBend', the next motion starts at the end of the one
--   before.
-- * Exit: the first motion after the release (the end of compensation) goes straight from the
--   present position to the programmed end.
--
-- The model reports what a control refuses; it does not repair it.
module Control.Compensation
  ( Moved (..),
    run,
    runWith,
    CompensationError (..),
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Rad (..))
import Control.Motion (Motion (..))
import Control.Motion qualified as Motion
import Data.List (mapAccumL, minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.Maybe (isJust, listToMaybe)
import Data.Ord (comparing)
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Geometry.Carrier (Carrier (..), Circle (Circle), Line (Line), Side (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Machine.Machine (CommandValue (..), CommandWord (..), CompensationCommands (..), Machine)
import Machine.Machine qualified as Machine
import Toolpath.Tolerance qualified as Tolerance

-- | Programmed motion, and the path of the cutter's centre during that motion, in the plane. With
-- compensation the path may begin with an arc round the corner before the motion. The path of a
-- vertical motion is a straight segment of length 0.
data Moved = Moved {programmed :: Motion, centrePath :: NonEmpty Segment}
  deriving stock (Eq, Show)

-- | Reason why a control stops. The first field is the number of the frame, from 1.
data CompensationError
  = -- | The first motion after compensation is switched on is not longer than the cutter's radius:
    -- its length, the radius.
    ShortEntry Int Mm Mm
  | -- | The first motion after compensation is switched on is an arc.
    ArcEntry Int
  | -- | The first motion after the release is an arc.
    ArcExit Int
  | -- | The cutter does not fit inside an arc: the radius of the arc, that of the cutter.
    TightArc Int Mm Mm
  | -- | The cutter cannot reach the corner at the end of this frame without cutting into the part,
    -- or the offset of this frame would run backwards.
    CornerNotReached Int
  | -- | One frame switches compensation on for both sides, or on and off. Or compensation is
    -- switched on while it is on, or after its release but before the exit.
    SwitchedOnTwice Int
  | -- | The tool is changed while compensation is on.
    ToolChanged Int
  | -- | Compensation is on at the end of the tape.
    NotSwitchedOff Int
  deriving stock (Eq, Show)

-- | Compensation that is on: the side of the cutter, seen in the direction of the programmed
-- motion, and the cutter's radius.
data Offset = Offset {side :: Side, radius :: Mm}

-- | State of the control between two frames.
data Mode
  = -- | compensation is off
    Off
  | -- | switched on; the next motion is the entry
    Entering Offset
  | -- | on, after the entry
    Active
  | -- | released; the next motion is the exit
    Leaving

-- | Role of one motion in compensation.
data Role
  = -- | compensation is off
    Uncompensated
  | -- | the first motion after compensation is switched on
    Entry Offset
  | -- | a later motion, up to the release
    Contour
  | -- | the first motion after the release
    Exit

-- Frames in order ---------------------------------------------------------------------------------

-- | Motions of frames from a start position, and the errors at which a control would stop. The
-- second argument is a function from the number of a frame, from 1, to the cutter's radius. It is
-- applied to a frame that switches compensation on without giving the cutter's diameter.
run :: Machine -> (Int -> Mm) -> Pulses3 -> [Frame] -> ([Moved], [CompensationError])
run = runWith (:)

-- | Variant of 'run' that folds the motions from the right. @onto@ joins a motion with the list
-- made of all later motions. @toolAt@ gives the cutter's radius for the number of a frame, from 1.
-- It is applied to a frame that switches compensation on without giving the cutter's diameter.
-- Without compensation, the list of motions is never in memory as a whole.
runWith ::
  (Moved -> [a] -> [a]) ->
  Machine ->
  (Int -> Mm) ->
  Pulses3 ->
  [Frame] ->
  ([a], [CompensationError])
runWith onto machine toolAt begin frames =
  case Machine.compensation (Machine.commandWords machine) of
    Just commands
      | any (switchesOn commands) frames ->
        let (final, tagged) = withRoles machine commands toolAt begin frames
            start = Frame.position machine begin
            (moved, errors) = unzip (pathsFrom machine start [m | (Just m, _) <- tagged])
         in ( foldr onto [] moved,
              concatMap snd tagged <> concat errors <> [NotSwitchedOff (length frames) | isOn final]
            )
    _ -> (Motion.runWith (onto . uncompensated machine) begin frames, [])
  where
    switchesOn c f =
      any
        (\o -> isJust (lookup (commandName o) (Frame.commands f)))
        [compensateLeft c, compensateRight c]

-- | Mode at the end of the tape, and a list with one pair for each frame. The pair has the motion
-- of the frame with its role, and the errors of the frame. Nothing in place of the motion means
-- that the frame does not move. @toolAt@ gives the cutter's radius in a frame, by the frame's
-- number from 1.
withRoles ::
  Machine ->
  CompensationCommands ->
  (Int -> Mm) ->
  Pulses3 ->
  [Frame] ->
  (Mode, [(Maybe (Role, Motion), [CompensationError])])
withRoles machine commands toolAt begin frames = (final, tagged)
  where
    ((final, _), tagged) = mapAccumL inFrame (Off, Motion.run begin frames) (zip [1 ..] frames)
    inFrame (mode, motions) (n, f) =
      let (mode', errors) = switched machine commands toolAt mode n f
       in case motions of
            m : rest
              | number m == n ->
                let (after, role) = taken mode' in ((after, rest), (Just (role, m), errors))
            _ -> ((mode', motions), (Nothing, errors))
    taken mode = case mode of
      Off -> (Off, Uncompensated)
      Entering k -> (Active, Entry k)
      Active -> (Active, Contour)
      Leaving -> (Off, Exit)

-- | Test that compensation is switched on and not yet released.
isOn :: Mode -> Bool
isOn mode = case mode of
  Off -> False
  Leaving -> False
  Entering _ -> True
  Active -> True

-- | Mode after the commands of the frame @f@ with the number @n@ and before the motion of @f@; and
-- the errors of these commands. @mode@ is the mode before the frame.
switched ::
  Machine ->
  CompensationCommands ->
  (Int -> Mm) ->
  Mode ->
  Int ->
  Frame ->
  (Mode, [CompensationError])
switched machine commands toolAt mode n f =
  ( mode',
    [SwitchedOnTwice n | isTwice]
      <> [ToolChanged n | isOn mode, not (null change), all isGiven change]
  )
  where
    change = Machine.toolChange (Machine.commandWords machine)
    on =
      [ Offset s (radiusFor o)
        | (s, o) <- [(LeftOf, compensateLeft commands), (RightOf, compensateRight commands)],
          isGiven o
      ]
    isReleased = isGiven (cancelCompensation commands)
    (mode', isTwice) = case (mode, on) of
      -- The frame switches compensation on for both sides.
      (_, _ : _ : _) -> (mode, True)
      (Off, k : _) -> (Entering (facing k), isReleased)
      (_, _ : _) -> (mode, True)
      (Active, []) | isReleased -> (Leaving, False)
      (Entering _, []) | isReleased -> (Off, False)
      (_, []) -> (mode, False)
    -- On a mirrored machine, left and right are exchanged.
    facing k = if Machine.isMirrored machine then k {side = Carrier.oppositeSide (side k)} else k
    isGiven o = case (value o, lookup (commandName o) (Frame.commands f)) of
      (Fixed v, Just w) -> v == w
      (_, found) -> isJust found
    radiusFor o = case (value o, lookup (commandName o) (Frame.commands f)) of
      (Diameter, Just w) ->
        Mm (fromIntegral w / 10 ^ Machine.commandDecimals machine (commandName o) / 2)
      _ -> toolAt n

-- Paths of the centre -----------------------------------------------------------------------------

-- | Motion without compensation.
uncompensated :: Machine -> Motion -> Moved
uncompensated machine m = Moved m (Motion.segment machine m :| [])

-- | Paths of the centre in motions, from the present position @at@ of the centre.
pathsFrom :: Machine -> Point -> [(Role, Motion)] -> [(Moved, [CompensationError])]
pathsFrom machine at motions = case motions of
  [] -> []
  (Uncompensated, m) : rest -> (uncompensated machine m, []) : pathsFrom machine (endpoint m) rest
  (Contour, m) : rest -> (uncompensated machine m, []) : pathsFrom machine (endpoint m) rest
  (Exit, m) : rest ->
    ( Moved m (Straight at (endpoint m) :| []),
      [ArcExit (number m) | isArc (Motion.segment machine m)]
    ) :
    pathsFrom machine (endpoint m) rest
  (Entry k, m) : rest ->
    let (contour, others) = span (isContour . fst) rest
        section = compensatedSection machine k at (m :| map snd contour)
        final = maybe at (endOf . fst) (listToMaybe (reverse section))
     in section <> pathsFrom machine final others
  where
    endpoint m = Frame.position machine (to m)
    isContour role = case role of
      Contour -> True
      Uncompensated -> False
      Entry _ -> False
      Exit -> False

-- | Paths of the centre in the entry motion and in all motions up to the release, from the present
-- position @at@ of the centre.
compensatedSection ::
  Machine ->
  Offset ->
  Point ->
  NonEmpty Motion ->
  [(Moved, [CompensationError])]
compensatedSection machine k at (entry :| contour) =
  case offsetPaths k at Nothing [(m, Motion.segment machine m) | m <- entry : contour] of
    (moved, errors) : more -> (moved, entryErrors <> errors) : more
    [] -> []
  where
    edge = Motion.segment machine entry
    long = Vec.distance (Segment.start edge) (Segment.end edge)
    entryErrors =
      [ArcEntry (number entry) | isArc edge]
        <> [ShortEntry (number entry) long (radius k) | long <= radius k]

-- | Position of the centre at the end of a motion.
endOf :: Moved -> Point
endOf m = let first :| others = centrePath m in Segment.end (foldl (\_ s -> s) first others)

-- | Test that a segment is an arc.
isArc :: Segment -> Bool
isArc s = case s of
  Straight _ _ -> False
  Arc {} -> True

-- | Offset paths of programmed motions, from the present position @at@ of the centre. Each motion
-- is given with its segment. @corner@ is the arc of the centre round the corner before the first
-- motion; Nothing if there is no such arc.
offsetPaths ::
  Offset ->
  Point ->
  Maybe Segment ->
  [(Motion, Segment)] ->
  [(Moved, [CompensationError])]
offsetPaths k at corner motions = case motions of
  [] -> []
  (m, edge) : rest
    | isVertical edge -> (Moved m (Straight at at :| []), []) : offsetPaths k at corner rest
    | otherwise ->
      let joint = jointOf k edge <$> listToMaybe [e | (_, e) <- rest, not (isVertical e)]
          (finish, corner') = case joint of
            Just (Around arc) -> (Segment.start arc, Just arc)
            Just (Intersection p) -> (p, Nothing)
            _ -> (offsetEnd k edge, Nothing)
          path = along (maybe at Segment.end corner) finish edge
       in (Moved m (maybe (path :| []) (:| [path]) corner), offsetErrors k m edge path joint) :
          offsetPaths k finish corner' rest

-- | Errors of the offset @path@ of the programmed segment @edge@. There are two kinds: an arc
-- inside which the cutter does not fit; and a path that goes backwards, has too large a sweep, or
-- does not meet the next path. @joint@ is the transition to the next path; Nothing for the last
-- path.
offsetErrors :: Offset -> Motion -> Segment -> Segment -> Maybe Joint -> [CompensationError]
offsetErrors k m edge path joint =
  tight <> [CornerNotReached (number m) | isBackwards || winds path edge || isApart]
  where
    isBackwards = case joint of
      Just Smooth -> False
      _ -> goesBack path edge
    isApart = case joint of
      Just NoMeeting -> True
      _ -> False
    tight = case edge of
      Arc {start, centre, sweep = Rad a}
        | r <- Segment.radius centre start,
          signum a == Carrier.sideSign (side k),
          r <= radius k ->
          [TightArc (number m) r (radius k)]
      _ -> []

-- | Test that a motion has no length in the plane.
isVertical :: Segment -> Bool
isVertical s = case s of
  Straight a b -> a == b
  Arc {} -> False

-- | Path from @a@ to @b@ with the shape of a programmed segment. An arc keeps its centre, and a
-- full circle also its sweep.
along :: Point -> Point -> Segment -> Segment
along a b edge = case edge of
  Straight _ _ -> Straight a b
  Arc {centre, sweep = whole}
    | Vec.isNear (Segment.start edge) (Segment.end edge) ->
      Arc {start = a, end = b, centre, sweep = whole}
    | otherwise -> Segment.arc (Carrier.senseOf whole) centre a b

-- | Test that a straight path leads backwards relative to its programmed segment, by a distance of
-- more than 'Tolerance.coincident'. A shorter distance may come from rounding. False for an arc.
goesBack :: Segment -> Segment -> Bool
goesBack path edge = case edge of
  Straight _ _ ->
    Mm (Vec.dot (Segment.startDirection edge) (Vec.to (Segment.start path) (Segment.end path)))
      < Mm (-slack)
  Arc {} -> False
  where
    Mm slack = Tolerance.coincident

-- | Test that the sweep of the arc @path@ exceeds that of its programmed segment @edge@ by more
-- than 'Tolerance.controlTurn'. This happens if the trimmed path would need a negative sweep: the
-- arc then becomes almost a full circle.
winds :: Segment -> Segment -> Bool
winds path edge = case (path, edge) of
  (Arc {sweep = Rad a}, Arc {sweep = Rad b}) -> Rad (abs a - abs b) > Tolerance.controlTurn
  _ -> False

-- Corners -----------------------------------------------------------------------------------------

-- | Transition from the offset of one segment to that of the next.
data Joint
  = -- | the change of direction is so small that the control ignores the corner
    Smooth
  | -- | the centre goes round the corner on an arc
    Around Segment
  | -- | both offsets are trimmed at this point, their intersection
    Intersection Point
  | -- | the offsets do not meet
    NoMeeting

-- | Transition between the offsets of two successive programmed segments @a@ and @b@.
jointOf :: Offset -> Segment -> Segment -> Joint
jointOf k a b
  | abs turned < least = Smooth
  -- If the contour almost reverses its direction, the cutter cannot reach the corner, whatever the
  -- side of the cutter.
  | abs turned > pi - least = NoMeeting
  | turned * Carrier.sideSign (side k) < 0 =
    Around
      (Segment.arc (Carrier.senseAwayFrom (side k)) corner (offsetEnd k a) (offsetStart k b))
  | otherwise = case meetings k a b of
    [] -> NoMeeting
    ps -> Intersection (minimumBy (comparing (Vec.distance corner)) ps)
  where
    Rad turned = Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
    Rad least = Tolerance.controlBend
    corner = Segment.end a

-- | End and start of the offset of a programmed segment, before trimming: the end or start of the
-- segment, shifted sideways by the cutter's radius.
offsetEnd, offsetStart :: Offset -> Segment -> Point
offsetEnd k s = Carrier.beside (side k) (radius k) (Segment.endDirection s) (Segment.end s)
offsetStart k s = Carrier.beside (side k) (radius k) (Segment.startDirection s) (Segment.start s)

-- | Intersections of the carriers (infinite lines or full circles) on which the offsets of two
-- programmed segments lie.
meetings :: Offset -> Segment -> Segment -> [Point]
meetings k a b =
  Intersection.common
    (carrierThrough (offsetEnd k a) (Segment.endDirection a) a)
    (carrierThrough (offsetStart k b) (Segment.startDirection b) b)

-- | Carrier of the offset of the segment @s@; @p@ is a point of the offset, and @direction@ the
-- direction of the offset there.
carrierThrough :: Point -> Vec -> Segment -> Carrier
carrierThrough p direction s = case s of
  Straight _ _ -> LineCarrier (Line p (Vec.shift direction p))
  Arc {centre} -> CircleCarrier (Circle centre (Vec.distance centre p))
