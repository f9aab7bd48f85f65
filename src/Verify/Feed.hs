-- | Comparison of the feeds of a tape. The planned frames are those that the compiler made for the
-- program. A tape with as many frames is compared with them frame by frame. Any other tape is
-- compared with the feeds that the statements demand. The third comparison is for every tape: the
-- cutter has to be able to slow down in time. The /leading axis/ of a motion is the axis that moves
-- by the most pulses.
module Verify.Feed
  ( asPlanned,
    atFeed,
    atPace,
    notSlow,
    tooFast,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Feed (..), Mm (..), Pulses (..))
import Base.Region (Located (..), Region)
import Control.Motion (Motion (..))
import Control.Motion qualified as Control
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Frame.FeedCode qualified as FeedCode
import Frame.Frame (Frame, FrameMotion (..), FrameProgram)
import Frame.Frame qualified as Frame
import Machine.Machine (BrakingForm (..), FeedCode (..), FeedMeasure (..), Machine)
import Machine.Machine qualified as Machine
import Part.CutFeed (CutFeed)
import Part.CutFeed qualified as CutFeed
import Part.Part (Pace)
import Part.Part qualified as Part
import Verify.Proof (Finding (..), Speed (..))

-- | Speed that a frame asks for: rapid or a feed code, and with braking or without.
speedOf :: Frame -> Speed
speedOf f =
  Speed {rapidly = Frame.motion f == Rapid, code = Frame.feedCode f, braking = Frame.braking f}

-- Demanded feeds ----------------------------------------------------------------------------------

-- | Findings for frames whose speed differs from that of the planned frame with the same number.
asPlanned :: FrameProgram -> [Frame] -> [Finding]
asPlanned program frames =
  [ WrongFeed n (speedOf f) (speedOf (Frame.frame planned)) (Frame.origin planned)
    | (n, planned, f) <- zip3 [1 ..] (Frame.plannedFrames program) frames,
      isOtherSpeed f (Frame.frame planned)
  ]
  where
    isOtherSpeed a b =
      Frame.feedCode a /= Frame.feedCode b
        || Frame.braking a /= Frame.braking b
        || (Frame.motion a == Rapid) /= (Frame.motion b == Rapid)

-- | Findings for motions with a wrong feed. Allowed are @demanded@, the feed of the statement, and
-- the feeds of single elements, which are in @finishes@. If the cutter has to slow down at the end
-- of any element, the lowest feed of the machine is allowed too. A braking frame may have any feed
-- up to the highest allowed one.
atFeed :: Machine -> Located CutFeed -> [Part.Finish] -> [Motion] -> [Finding]
atFeed machine demanded finishes = mapMaybe wrongFeed
  where
    wrongFeed m = do
      wanted <- codeFor machine m (value demanded)
      let found = speedOf (frame m)
          expected = Speed {rapidly = False, code = wanted, braking = False}
          allowed = wanted : mapMaybe (codeFor machine m) elementFeeds <> slowest
      if isAllowed allowed found
        then Nothing
        else Just (WrongFeed (number m) found expected (region demanded))
    elementFeeds = [f | finish <- finishes, Just (Located _ f) <- [Part.ownFeed finish]]
    slowest = [fst (Machine.slowest machine) | any Part.slow finishes]
    isAllowed allowed found =
      not (rapidly found) && (code found `elem` allowed || isBrakingBelow allowed found)
    isBrakingBelow allowed found =
      braking found
        && maybe
          False
          (<= maximum (map feedOf allowed))
          (Machine.valueOf machine (code found))
    feedOf = fromMaybe 0 . Machine.valueOf machine

-- | Finding for a motion whose speed is not that of the @pace@ in the program; @asked@ is the
-- region that asks for it. A braking frame may be slower. If the cutter may slow down at the end of
-- the move, the lowest feed of the machine is allowed too.
atPace :: Machine -> Pace -> Bool -> Region -> Motion -> Maybe Finding
atPace machine pace slows asked m = case pace of
  Part.At demanded ->
    listToMaybe (atFeed machine demanded [Part.plainFinish {Part.slow = slows}] [m])
  Part.Rapid
    | isRapid || braking found -> Nothing
    | otherwise -> Just (WrongFeed (number m) found expected asked)
  where
    found = speedOf (frame m)
    expected = Speed {rapidly = hasRapid, code = rapidCode, braking = False}
    hasRapid = Machine.hasRapidMotion machine
    rapidCode = if hasRapid then FeedCode 0 else Machine.rapidCode machine
    isRapid = rapidly found == hasRapid && code found == rapidCode

-- | Finding for a motion that has to run at the lowest feed of the machine; @asked@ is the region
-- that gives the feed before.
notSlow :: Machine -> Region -> Motion -> Finding
notSlow machine asked m = WrongFeed (number m) (speedOf (frame m)) lowest asked
  where
    lowest = Speed {rapidly = False, code = fst (Machine.slowest machine), braking = False}

-- Codes and speeds --------------------------------------------------------------------------------

-- | Code for the feed of a cut in a motion. Nothing if the machine has no such feed.
codeFor :: Machine -> Motion -> CutFeed -> Maybe FeedCode
codeFor machine m v = case (FeedCode.turnCode machine v, CutFeed.perMinute v) of
  (Just (Machine.Given c _), _) -> Just c
  (Just (Machine.NoSuchFeed _ _), _) -> Nothing
  (Nothing, Just feed) -> codePerMinute machine m feed
  (Nothing, Nothing) -> Nothing

-- | Code for a feed of @v@ mm/min along the path of a motion. Nothing if the machine has no such
-- feed. On some machines a code means the pulse frequency of the leading axis. That frequency is
-- @v/60·n/L@ pulses per second. Here @L@ is the length of the path in mm, and @n@ is the number of
-- pulses that the leading axis moves.
codePerMinute :: Machine -> Motion -> Feed -> Maybe FeedCode
codePerMinute machine m (Feed v) = case Machine.choose machine inMeasure of
  Machine.Given c _ -> Just c
  Machine.NoSuchFeed _ _ -> Nothing
  where
    inMeasure = case Machine.feedMeasure (Machine.feeds machine) of
      AlongPath -> v
      LeadingAxis -> v / 60 * leading m / travelOf machine m

-- | Number of pulses of the leading axis in a motion.
leading :: Motion -> Double
leading m = fromIntegral n
  where
    Pulses3 x y z = abs (to m - from m)
    Pulses n = maximum [x, y, z]

-- | Length of the path of a motion, in mm.
travelOf :: Machine -> Motion -> Double
travelOf machine m = let Mm l = Control.travel machine m in l

-- | Speed along the path of a motion, in mm/s. A code that the machine lacks counts as the highest
-- feed.
speedAlong :: Machine -> Motion -> Double
speedAlong machine m = case Machine.feedMeasure (Machine.feeds machine) of
  AlongPath -> ofCode / 60
  LeadingAxis -> ofCode * travelOf machine m / max 1 (leading m)
  where
    ofCode
      | Frame.motion (frame m) == Rapid =
        fromMaybe highest (Machine.valueOf machine (Machine.rapidCode machine))
      | otherwise = fromMaybe highest (Machine.valueOf machine (Frame.feedCode (frame m)))
    highest = snd (Machine.feedRange machine)

-- Braking -----------------------------------------------------------------------------------------

-- | Findings for frames at whose end the cutter is too fast to slow down to a later, lower speed
-- @v@. At a path length @s@ before the position at which @v@ has to be reached, the speed may be
-- @√(v² + 2·a·s)@ at most; @a@ is the deceleration of the machine (Kolsanova; the law is
-- reconstructed). Empty if the machine does not use braking frames. @start@ is the position before
-- the first frame. The model of the speeds:
--
-- * a frame without braking has its speed from its start to its end;
-- * a braking frame slows down to its speed, which it has at its end; of successive braking frames
--   with the same speed, only the last one has this speed at its end;
-- * at the end of the tape the cutter has the final braking feed.
tooFast :: Machine -> Pulses3 -> [Frame] -> [Finding]
tooFast machine start frames = case Machine.brakingForm (Machine.braking machine) of
  ByControl -> []
  SlowFrames -> []
  BrakedFrames (Feed final) ->
    snd
      ( foldr
          (tooFastIn machine)
          ((final / 60) ^ (2 :: Int) + 2 * a * sum lengths, [])
          (zip3 (zip starts (drop 1 starts)) motions (drop 1 (map Just motions) <> [Nothing]))
      )
  where
    motions = Control.run start frames
    a = Machine.deceleration (Machine.braking machine)
    lengths = map (travelOf machine) motions
    -- Path lengths in mm from the start of the tape to the start of each motion. The last number of
    -- the list is the path length to the end of the tape.
    starts = scanl (+) 0 lengths

-- | Step of 'tooFast' for the motion @m@; the steps are done from the end of the tape to its start.
-- @begin@ and @end@ are the path lengths in mm from the start of the tape to both ends of @m@;
-- @next@ is the motion after it, if there is one. @least@ is the least value of @v² + 2·a·p@ over
-- all later speeds @v@ in mm/s; @a@ is the deceleration, and @p@ is the path length from the start
-- of the tape to the position at which @v@ has to be reached. @found@ are the findings for later
-- motions. The result has @least@ and @found@ with @m@ included.
tooFastIn ::
  Machine ->
  ((Double, Double), Motion, Maybe Motion) ->
  (Double, [Finding]) ->
  (Double, [Finding])
tooFastIn machine ((begin, end), m, next) (least, found)
  | brakes m && maybe False isSameBraking next = (least, found)
  | otherwise =
    ( min least (v * v + 2 * a * (if brakes m then end else begin)),
      [TooFast (number m) (Feed (60 * v)) (Feed (60 * sqrt most)) | v * v > most + rounding]
        <> found
    )
  where
    isSameBraking n = brakes n && Frame.feedCode (frame n) == Frame.feedCode (frame m)
    brakes = Frame.braking . frame
    v = speedAlong machine m
    a = Machine.deceleration (Machine.braking machine)
    most = max 0 (least - 2 * a * (end - pulsesRounded * pulse))
    rounding = 1e-9 * max 1 (v * v)
    Mm pulse = Machine.planeResolution machine

-- | Largest change, by rounding, of the distance between two positions, in pulses. Rounding moves
-- each position by at most one pulse.
pulsesRounded :: Double
pulsesRounded = 2
