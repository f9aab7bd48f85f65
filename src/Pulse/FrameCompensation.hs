-- | Cutter compensation of a control with switches for the cutter's radius.
--
-- The tape has the edge of the part. G41, G42 and G40 have frames of their own, and a word with
-- the number of a switch gives the radius. The path of the centre is that of
-- "Control.Compensation", as the first and the last motion are: it is computed from two
-- neighbouring frames, and its ends are rounded to pulses. At an outer corner an arc round the
-- corner comes before the frame. If two frames do not fit, the control stops before the first of
-- them.
--
-- Centres are whole pulses already: an arc keeps the centre of its frame, and a corner is its own
-- centre. Only the ends of the offset are rounded. So the radii at both ends of an arc may differ
-- by up to a pulse. An arc of more than a half turn is divided in its middle, so that rounding
-- cannot exchange a small sweep and a large one.
module Pulse.FrameCompensation
  ( PreparedFrame (..),
    prepared,
    switchRadii,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), Rad (..))
import Control.Compensation (Moved (..))
import Control.Compensation qualified as Compensation
import Control.CompensationCheck qualified as CompensationCheck
import Control.Motion (Motion)
import Control.Motion qualified as Motion
import Data.IntMap.Strict qualified as IntMap
import Data.List (tails)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust, maybeToList)
import Frame.Frame (Frame, PlannedFrame (cutterRadius))
import Frame.Frame qualified as Frame
import Geometry.Segment (Segment (centre, sweep))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (CommandWord (..), CompensationCommands (..), Machine)
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (StopReason (..))
import Pulse.FramePath (FramePath (..))
import Pulse.FramePath qualified as FramePath
import Pulse.Steps (Pulses5 (..))
import Tape.Damage (Damage)
import Tape.Punch (TapeFrame (..))

-- | Frame with the paths of the cutter's centre in it; none if it does not move. True for a frame
-- under compensation.
data PreparedFrame = PreparedFrame
  { tapeFrame :: TapeFrame,
    paths :: ~[FramePath],
    isCompensated :: Bool
  }

-- | Frames of a tape with their paths. The arguments are the radius of the cutter for each switch
-- that is set, and the position of the cutter before the tape.
prepared ::
  Machine ->
  [(Int, Mm)] ->
  Pulses3 ->
  LazyList (Maybe Damage) TapeFrame ->
  LazyList StopReason PreparedFrame
prepared machine radii = go 1
  where
    commands = Machine.compensation (Machine.commandWords machine)
    -- An unevaluated position would keep all frames before it in memory.
    go n position frames =
      position `seq` case frames of
        LazyList.End damage -> LazyList.End (maybe TapeEnds Unreadable damage)
        LazyList.Next f more -> case commands of
          Just c
            | isOn c (frameRead f) -> section n position c f more
          _ ->
            LazyList.Next
              (PreparedFrame f (maybeToList (FramePath.fromFrame (frameRead f))) False)
              (go (n + 1) (position + Frame.increment (frameRead f)) more)
    section n position c first more = case radiusIn c (frameRead first) of
      Left missing -> LazyList.End (SwitchNotSet n missing)
      Right radius ->
        let (inside, after) = untilExit c first more
            (ready, stop) = compensated machine n position radius inside
            end = position + sum (map (Frame.increment . frameRead) inside)
         in appended ready (maybe (go (n + length inside) end after) LazyList.End stop)
    radiusIn c f = case radiusSwitch c >>= \w -> lookup (commandName w) (Frame.commands f) of
      Nothing -> Left 0
      Just k -> maybe (Left k) Right (lookup k radii)

-- | Radius of the cutter at each switch that planned frames use: the number of the switch, and the
-- radius of the cutter in the next motion.
switchRadii :: Machine -> [PlannedFrame] -> [(Int, Mm)]
switchRadii machine planned = case Machine.compensation (Machine.commandWords machine) of
  Nothing -> []
  Just c ->
    [ (k, cutterRadius next)
      | p : more <- tails planned,
        isOn c (plannedFrame p),
        Just w <- [radiusSwitch c],
        Just k <- [lookup (commandName w) (Frame.commands (plannedFrame p))],
        next <- take 1 (filter (Frame.isMoving . plannedFrame) (p : more))
    ]
  where
    plannedFrame = Frame.frame

appended :: [a] -> LazyList e a -> LazyList e a
appended items list = foldr LazyList.Next list items

-- | True if a frame switches compensation on.
isOn :: CompensationCommands -> Frame -> Bool
isOn c f = any (hasCommand f) [compensateLeft c, compensateRight c]

hasCommand :: Frame -> CommandWord -> Bool
hasCommand f w = isJust (lookup (commandName w) (Frame.commands f))

-- | Frames from the one that switches compensation on up to the motion after its release, and the
-- frames after these.
untilExit ::
  CompensationCommands ->
  TapeFrame ->
  LazyList e TapeFrame ->
  ([TapeFrame], LazyList e TapeFrame)
untilExit c first = go False [first]
  where
    go released latest list = case list of
      LazyList.End _ -> (reverse latest, list)
      LazyList.Next f more
        | released' && Frame.isMoving (frameRead f) -> (reverse (f : latest), more)
        | otherwise -> go released' (f : latest) more
        where
          released' = released || hasCommand (frameRead f) (cancelCompensation c)

-- | Frames under compensation with their paths, and the reason why the control stops after them.
-- The first of the frames has the number @n@; the cutter is at a position before it.
compensated ::
  Machine -> Int -> Pulses3 -> Mm -> [TapeFrame] -> ([PreparedFrame], Maybe StopReason)
compensated machine n position radius frames = case errors of
  [] -> (ready, Nothing)
  first : _ ->
    let (k, why, _) = CompensationCheck.wordsOf first
     in (take (k - 1) ready, Just (NotCompensated (n + k - 1) why))
  where
    (moved, errors) = run frames
    run = Compensation.run machine (const radius) position . map frameRead
    pathsOf = IntMap.fromList (zip numbers (centrePaths machine position moved))
    numbers = map (Motion.number . programmed) moved
    ready =
      [ PreparedFrame f (fromMaybe [] (IntMap.lookup k pathsOf)) True
        | (k, f) <- zip [1 ..] frames
      ]

-- | Paths of the centre in each motion, in pulses. The cutter is at a position before the first.
centrePaths :: Machine -> Pulses3 -> [Moved] -> [[FramePath]]
centrePaths machine (Pulses3 (Pulses x0) (Pulses y0) _) = go (x0, y0)
  where
    go at motions = case motions of
      [] -> []
      m : more ->
        let (ps, at') = along at (concatMap divided (NonEmpty.toList (centrePath m)))
         in withHeight (programmed m) ps : go at' more
    along at segments = case segments of
      [] -> ([], at)
      s : more ->
        let end = inPulses machine (Segment.end s)
            (ps, final) = along end more
         in (pathTo machine at end s <> ps, final)

-- | Position in whole pulses that is nearest to a point.
inPulses :: Machine -> Point -> (Int, Int)
inPulses machine p = (round (Vec.x p / px), round (Vec.y p / py))
  where
    Mm px = Machine.resolutionOf machine Machine.X
    Mm py = Machine.resolutionOf machine Machine.Y

-- | Halves of an arc of more than a half turn; every other segment alone.
divided :: Segment -> [Segment]
divided s = case s of
  Segment.Arc {sweep = Rad a}
    | abs a > pi -> let (front, back) = Segment.cutAt 0.5 s in [front, back]
  Segment.Arc {} -> [s]
  Segment.Straight _ _ -> [s]

-- | Path of a segment from a position to another one; none if both are the same. A sweep so small
-- that rounding may turn it round becomes a line.
pathTo :: Machine -> (Int, Int) -> (Int, Int) -> Segment -> [FramePath]
pathTo machine (x, y) (x', y') s
  | (x, y) == (x', y') = []
  | otherwise = case s of
    Segment.Arc {centre = c, sweep = Rad a}
      | (i, j) <- inPulses machine c,
        from <- (x - i, y - j),
        to <- (x' - i, y' - j),
        turns a from to ->
        [Arc {clockwise = a < 0, from, to}]
    _ -> [Line (Pulses5 (x' - x) (y' - y) 0 0 0)]
  where
    -- The rounded ends lie in the sense of the arc, with an angle of less than a half turn or just
    -- over it.
    turns a (u, v) (u', v') =
      (u, v) /= (0, 0) && (u', v') /= (0, 0)
        && let cross = if a < 0 then u' * v - v' * u else u * v' - v * u'
            in cross > 0 || u * u' + v * v' < 0

-- | Paths of a motion whose last one also has the pulses along z and about the rotary axes.
withHeight :: Motion -> [FramePath] -> [FramePath]
withHeight m ps
  | z == 0 && a == 0 && b == 0 = ps
  | otherwise = case reverse ps of
    Line (Pulses5 x y _ _ _) : before -> reverse (Line (Pulses5 x y z a b) : before)
    _ -> ps <> [Line (Pulses5 0 0 z a b)]
  where
    Pulses3 _ _ (Pulses z) = Frame.increment (Motion.frame m)
    Pulses2 (Pulses a) (Pulses b) = Frame.turn (Motion.frame m)
