{-# OPTIONS_GHC -O2 #-}

-- | What the cutter's centre does under a control that keeps the cutter beside the contour by
-- itself, after LinuxCNC as it was measured. On machines without that, and where it is switched
-- off, it goes as the frames say.
--
-- The first stroke goes straight from where the centre stands to the end of that stroke, moved
-- aside by the radius. From there on each stroke runs beside what the frame says, an arc about its
-- own centre. Where the next one turns away from the cutter, the centre goes round the corner on an
-- arc; where it turns towards it, both end where they meet; where it hardly turns, the next one
-- sets out from where the one before has ended. The first stroke behind the release goes straight
-- from there to where its frame says.
module Control.Compensation
  ( Moved (..),
    run,
    runWith,
    Unkept (..),
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
import Geometry.Carrier (Circle (Circle), Line (Line), Sense (..))
import Geometry.Construction.Intersection (Intersection (..))
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (CommandValue (..), CommandWord (..), CompensationCommands (..), Machine)
import Machine.Machine qualified as Machine
import Toolpath.Tolerance qualified as Tolerance

-- | A stroke and what the cutter's centre does in it, in the plane: round the corner before it and
-- then along; without length where it goes straight up or down.
data Moved = Moved {stroke :: Motion, legs :: NonEmpty Segment}
  deriving stock (Eq, Show)

-- | Why a control does not go on; the number of the frame.
data Unkept
  = -- | the first move is no longer than the radius: its length, the radius
    ShortEntry Int Mm Mm
  | -- | the first move is an arc
    RoundEntry Int
  | -- | the first move behind the release is an arc
    RoundExit Int
  | -- | an arc about whose inside the cutter has no room to roll: its radius, that of the cutter
    TightArc Int Mm Mm
  | -- | a corner that the cutter does not reach without cutting into the move before or this one
    Unreached Int
  | -- | switched on while it is on
    OnTwice Int
  | -- | a tool changed while it is on
    ToolChanged Int
  | -- | on until the end
    NeverReleased Int
  deriving stock (Eq, Show)

-- | A cutter of a radius in mm, on the left (1) or on the right (-1).
data Keep = Keep {leftward :: Double, radius :: Double}

-- | What holds between two frames.
data Mode
  = Off
  | Entering Keep
  | Keeping
  | Leaving

-- | What a stroke is.
data Tag = Plain | First Keep | Later | Exit

-- | Run frames from a position. Where the tape does not say the cutter's diameter, its radius by
-- the number of the frame is asked.
run :: Machine -> (Int -> Mm) -> Pulses3 -> [Frame] -> ([Moved], [Unkept])
run = runWith (:)

-- | The same, with what is made of each stroke before what is made of those behind it.
runWith :: (Moved -> [a] -> [a]) -> Machine -> (Int -> Mm) -> Pulses3 -> [Frame] -> ([a], [Unkept])
runWith before machine toolAt begin frames = case Machine.compensation (Machine.orders machine) of
  Just c
    | any (switchesOn c) frames ->
      let ((final, _), told) = mapAccumL (told' c) (Off, strokes) (zip [1 ..] frames)
          (moved, problems) =
            unzip (walked machine (Frame.position machine begin) [t | (Just t, _) <- told])
       in ( foldr before [] moved,
            concatMap snd told <> concat problems <> [NeverReleased (length frames) | isOn final]
          )
  _ -> (Motion.runWith (\s -> before (Moved s (Motion.segment machine s :| []))) begin frames, [])
  where
    switchesOn c f =
      any (\o -> isJust (lookup (order o) (Frame.orders f))) [keepLeft c, keepRight c]
    strokes = Motion.run begin frames
    told' c (mode, left) (n, f) =
      let (mode', problems) = switched machine c toolAt mode n f
       in case left of
            s : rest
              | number s == n ->
                let (after, tag) =
                      taken mode'
                 in ((after, rest), (Just (tag, s), problems))
            _ -> ((mode', left), (Nothing, problems))
    taken mode = case mode of
      Off -> (Off, Plain)
      Entering k -> (Keeping, First k)
      Keeping -> (Keeping, Later)
      Leaving -> (Off, Exit)

isOn :: Mode -> Bool
isOn mode = case mode of
  Off -> False
  Leaving -> False
  Entering _ -> True
  Keeping -> True

-- | What the commands of a frame switch, before it moves.
switched ::
  Machine ->
  CompensationCommands ->
  (Int -> Mm) ->
  Mode ->
  Int ->
  Frame ->
  (Mode, [Unkept])
switched machine c toolAt mode n f =
  ( mode',
    [OnTwice n | tooOften] <> [ToolChanged n | isOn mode, not (null change), all given change]
  )
  where
    change = Machine.toolChange (Machine.orders machine)
    on =
      [ Keep s r
        | (s, o) <- [(1, keepLeft c), (-1, keepRight c)],
          given o,
          let r = radiusFor o,
          let _ = s :: Double
      ]
    off = given (release c)
    (mode', tooOften) = case (mode, on) of
      (_, _ : _ : _) -> (mode, True)
      (Off, k : _) -> (Entering (facing k), off)
      (_, _ : _) -> (mode, True)
      (Keeping, []) | off -> (Leaving, False)
      (Entering _, []) | off -> (Off, False)
      (_, []) -> (mode, False)
    facing k = if Machine.isMirrored machine then k {leftward = -(leftward k)} else k
    given o = case (value o, lookup (order o) (Frame.orders f)) of
      (Fixed v, Just w) -> v == w
      (_, found) -> isJust found
    radiusFor o = case (value o, lookup (order o) (Frame.orders f)) of
      (Diameter, Just w) -> fromIntegral w / 10 ^ Machine.orderDecimals machine (order o) / 2
      _ -> let Mm r = toolAt n in r

-- | Strokes from where the centre stands.
walked :: Machine -> Point -> [(Tag, Motion)] -> [(Moved, [Unkept])]
walked machine at strokes = case strokes of
  [] -> []
  (Plain, s) : rest ->
    (Moved s (Motion.segment machine s :| []), []) : walked machine (programmed s) rest
  (Later, s) : rest ->
    (Moved s (Motion.segment machine s :| []), []) : walked machine (programmed s) rest
  (Exit, s) : rest ->
    ( Moved s (Straight at (programmed s) :| []),
      [RoundExit (number s) | isArc (Motion.segment machine s)]
    ) :
    walked machine (programmed s) rest
  (First k, s) : rest ->
    let (kept, others) = span (isLater . fst) rest
        entry = Motion.segment machine s
        length' = Vec.distance (Segment.start entry) (Segment.end entry)
        wrong =
          [RoundEntry (number s) | isArc entry]
            <> [ShortEntry (number s) length' (Mm (radius k)) | length' <= Mm (radius k)]
        -- The centre stands where the frames say.
        section = beside k at Nothing [(t, Motion.segment machine t) | t <- s : map snd kept]
        left' = case reverse section of
          (m, _) : _ -> endOf m
          [] -> at
     in addedFirst wrong section <> walked machine left' others
  where
    programmed s = Frame.position machine (to s)
    isLater tag = case tag of
      Later -> True
      Plain -> False
      First _ -> False
      Exit -> False
    addedFirst wrong section = case section of
      (m, problems) : more -> (m, wrong <> problems) : more
      [] -> []

endOf :: Moved -> Point
endOf m = let l :| ls = legs m in Segment.end (foldl (\_ x -> x) l ls)

isArc :: Segment -> Bool
isArc s = case s of
  Straight _ _ -> False
  Arc {} -> True

-- | How a stroke goes over into the next one.
data Joint
  = Smooth
  | Around Segment
  | Intersection Point
  | NoMeeting

-- | Strokes beside what their frames say, from where the centre stands; a corner that is to be gone
-- round first.
beside :: Keep -> Point -> Maybe Segment -> [(Motion, Segment)] -> [(Moved, [Unkept])]
beside k at corner strokes = case strokes of
  [] -> []
  (s, way) : rest
    | isStill way -> (Moved s (Straight at at :| []), []) : beside k at corner rest
    | otherwise ->
      let next = listToMaybe [w | (_, w) <- rest, not (isStill w)]
          joint = fmap (jointOf k way) next
          from' = maybe at Segment.end corner
          (finish, corner') = case joint of
            Just (Around arc) -> (Segment.start arc, Just arc)
            Just (Intersection p) -> (p, Nothing)
            _ -> (asideAtEnd k way, Nothing)
          leg = along from' finish way
          back = case joint of
            Just Smooth -> False
            _ -> goesBack leg way
          problems =
            tight s way <> [Unreached (number s) | back || wraps leg way || noMeeting joint]
       in (Moved s (maybe (leg :| []) (:| [leg]) corner), problems) : beside k finish corner' rest
  where
    noMeeting joint = case joint of
      Just NoMeeting -> True
      _ -> False
    tight s way = case way of
      Arc {start, centre, sweep = Rad a}
        | Mm r <- Segment.radius centre start,
          signum a == leftward k,
          r <= radius k ->
          [TightArc (number s) (Mm r) (Mm (radius k))]
      _ -> []

isStill :: Segment -> Bool
isStill s = case s of
  Straight a b -> a == b
  Arc {} -> False

-- | From one point to another as a stroke goes, an arc about its centre.
along :: Point -> Point -> Segment -> Segment
along a b way = case way of
  Straight _ _ -> Straight a b
  Arc {centre, sweep = whole@(Rad angle)}
    | Vec.near (Segment.start way) (Segment.end way) ->
      Arc {start = a, end = b, centre, sweep = whole}
    | otherwise -> Segment.arc (if angle > 0 then CounterClockwise else Clockwise) centre a b

-- | Whether a straight way goes back, by more than rounding.
goesBack :: Segment -> Segment -> Bool
goesBack leg way = case way of
  Straight _ _ ->
    Mm (Vec.dot (Segment.startDirection way) (Vec.to (Segment.start leg) (Segment.end leg)))
      < Mm (-slack)
  Arc {} -> False
  where
    Mm slack = Tolerance.coincident

-- | Whether an arc turns further than it was programmed. One that was shortened to less than
-- nothing does, almost all the way round.
wraps :: Segment -> Segment -> Bool
wraps leg way = case (leg, way) of
  (Arc {sweep = Rad a}, Arc {sweep = Rad b}) -> Rad (abs a - abs b) > Tolerance.controlTurn
  _ -> False

asideAtEnd, asideAtStart :: Keep -> Segment -> Point
asideAtEnd k s =
  Vec.shift (Vec.scale (leftward k * radius k) (Vec.left (Segment.endDirection s))) (Segment.end s)
asideAtStart k s =
  Vec.shift
    (Vec.scale (leftward k * radius k) (Vec.left (Segment.startDirection s)))
    (Segment.start s)

jointOf :: Keep -> Segment -> Segment -> Joint
jointOf k a b
  | abs turned < least = Smooth
  -- What almost turns back is taken for a corner towards the cutter, whichever way it turns.
  | abs turned > pi - least = NoMeeting
  | turned * leftward k < 0 =
    Around
      ( Segment.arc
          (if leftward k > 0 then Clockwise else CounterClockwise)
          corner
          (asideAtEnd k a)
          (asideAtStart k b)
      )
  | otherwise = case meetings k a b of
    [] -> NoMeeting
    ps -> Intersection (minimumBy (comparing (Vec.distance corner)) ps)
  where
    Rad turned = Vec.turn (Segment.endDirection a) (Segment.startDirection b)
    Rad least = Tolerance.controlBend
    corner = Segment.end a

-- | Where the lines and circles beside two strokes meet.
meetings :: Keep -> Segment -> Segment -> [Point]
meetings k a b =
  case Intersection.lines
    <$> line a asideAtEnd Segment.endDirection <*> line b asideAtStart Segment.startDirection of
    Just m -> points m
    Nothing ->
      points
        ( other
            (line a asideAtEnd Segment.endDirection)
            (line b asideAtStart Segment.startDirection)
        )
  where
    line s p d = case s of
      Straight _ _ -> let q = p k s in Just (Line q (Vec.shift (d s) q))
      Arc {} -> Nothing
    other la lb = case (la, lb) of
      (Just l, _) -> Intersection.lineCircle l (circle b (asideAtStart k b))
      (_, Just l) -> Intersection.lineCircle l (circle a (asideAtEnd k a))
      _ -> Intersection.circles (circle a (asideAtEnd k a)) (circle b (asideAtStart k b))
    circle s p = case s of
      Arc {centre} -> Circle centre (Vec.distance centre p)
      Straight _ _ -> Circle p (Mm 0)
    points m = case m of
      Apart _ -> []
      Touching p -> [p]
      CrossingOnce p -> [p]
      Crossing p q -> [p, q]
      Same -> []
