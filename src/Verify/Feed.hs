{-# OPTIONS_GHC -O2 #-}

-- | The feeds of a tape: those of the program frame by frame, those that a statement asks along its
-- contour, and whether the machine can brake from one to the next.
module Verify.Feed
  ( asPlanned,
    asAsked,
    alongAt,
    downwards,
    tooFast,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Feed (..), Mm (..), Pulses (..))
import Base.Region (Located (..))
import Control.Motion (Motion (..))
import Control.Motion qualified as Control
import Data.List (nub)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, mapMaybe)
import Frame.Frame (Frame, FrameMotion (..), FrameProgram)
import Frame.Frame qualified as Frame
import Machine.Machine (BrakingForm (..), FeedCode, FeedMeasure (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part qualified as Part
import Verify.PassSearch (MillingJob (..), elementsOf)
import Verify.Proof (Finding (..), Speed (..))

speedOf :: Frame -> Speed
speedOf f =
  Speed {rapidly = Frame.motion f == Rapid, code = Frame.speed f, braking = Frame.braking f}

-- | Frames whose feed is not that of the program's own frame in the same place.
asPlanned :: FrameProgram -> [Frame] -> [Finding]
asPlanned program frames =
  [ WrongFeed n (speedOf f) (speedOf (Frame.frame planned)) (Frame.origin planned)
    | (n, planned, f) <- zip3 [1 ..] (Frame.planned program) frames,
      isSlowerOrFaster f (Frame.frame planned)
  ]
  where
    isSlowerOrFaster a b =
      Frame.speed a /= Frame.speed b
        || Frame.braking a /= Frame.braking b
        || (Frame.motion a == Rapid) /= (Frame.motion b == Rapid)

-- | Strokes along a contour that run at another feed than its statement asks. Elements may have
-- feeds of their own, or slow down; a frame that brakes may be slower.
asAsked :: Machine -> MillingJob -> [Motion] -> [Finding]
asAsked machine job = alongAt machine (Part.feed (milling job)) (map Part.finish (elementsOf job))

-- | The same of strokes by the feed that is asked, and what single elements ask.
alongAt :: Machine -> Located Feed -> [Part.Finish] -> [Motion] -> [Finding]
alongAt machine asked finishes strokes =
  [ WrongFeed
      (number s)
      found
      Speed {rapidly = False, code = wanted, braking = False}
      (region asked)
    | s <- strokes,
      let found = speedOf (frame s),
      Just wanted <- [codeFor machine s (value asked)],
      let allowed = wanted : mapMaybe (codeFor machine s) own <> slowed,
      rapidly found
        || code found `notElem` allowed
          && not
            ( braking found
                && maybe
                  False
                  (<= maximum (map worth allowed))
                  (Machine.valueOf machine (code found))
            )
  ]
  where
    own = [f | finish <- finishes, Just (Located _ f) <- [Part.ownFeed finish]]
    slowed = [fst (Machine.slowest machine) | any Part.slow finishes]
    worth = fromMaybe 0 . Machine.valueOf machine

-- | Strokes straight down into the material, deeper than the tape has been at their places, at a
-- speed at which no such stroke of the program's own goes.
downwards :: FrameProgram -> [Frame] -> [Finding]
downwards program frames = case plunges (map Frame.frame (Frame.planned program)) of
  [] -> []
  own@(s : _) ->
    [ WrongFeed
        (number f)
        (speedOf (frame f))
        (speedOf (frame s))
        (Frame.origin (Frame.planned program !! (number s - 1)))
      | f <- plunges frames,
        speedOf (frame f) `notElem` asked
    ]
    where
      asked = nub (map (speedOf . frame) own)
  where
    plunges = deeper Map.empty . Control.run (Frame.start program)
    deeper known strokes = case strokes of
      [] -> []
      s : more
        | x == x',
          y == y',
          z' < min 0 (min z (Map.findWithDefault 0 (x, y) known)) ->
          s : deeper reached more
        | otherwise -> deeper reached more
        where
          (Pulses3 x y z, Pulses3 x' y' z') = (from s, to s)
          reached = Map.insertWith min (x', y') z' known

-- | The code for a feed along the path in a stroke, if the machine has one: the feed itself, or the
-- pulses a second
-- @v/60·n/L@ of the axis that goes n of them on the way L, the most of all axes.
codeFor :: Machine -> Motion -> Feed -> Maybe FeedCode
codeFor machine s (Feed v) = case Machine.choose machine inMeasure of
  Machine.Given c _ -> Just c
  Machine.NoSuchFeed _ _ -> Nothing
  where
    inMeasure = case Machine.feedMeasure (Machine.feeds machine) of
      AlongPath -> v
      LeadingAxis -> v / 60 * leading s / wayOf machine s

-- | The pulses of the axis that goes most of them.
leading :: Motion -> Double
leading s = let Pulses3 x y z = abs (to s - from s); Pulses n = maximum [x, y, z] in fromIntegral n

-- | The way of a stroke in mm.
wayOf :: Machine -> Motion -> Double
wayOf machine s = let Mm l = Control.lengthOf machine s in l

-- | The speed of a stroke along its way in mm/s. One whose code means nothing counts as the
-- fastest.
obtained :: Machine -> Motion -> Double
obtained machine s = case Machine.feedMeasure (Machine.feeds machine) of
  AlongPath -> told / 60
  LeadingAxis -> told * wayOf machine s / max 1 (leading s)
  where
    told =
      if Frame.motion (frame s) == Rapid
        then fromMaybe highest (Machine.valueOf machine (Machine.rapidCode machine))
        else fromMaybe highest (Machine.valueOf machine (Frame.speed (frame s)))
    highest = snd (Machine.feedRange machine)

-- | Frames at the end of which the cutter is faster than it may be: at no place of the way may its
-- speed exceed
-- @√(v² + 2·a·s)@, s the way on to any lower speed v behind it (Kolsanova; the law is
--  reconstructed). Frames that brake slow down to
-- their speed; those one after the other with one speed have it at the end of the last of them. At
-- the end of the tape the cutter has come down to the braking feed. Everywhere else the cutter is
-- as fast as its frame says.
tooFast :: Machine -> Pulses3 -> [Frame] -> [Finding]
tooFast machine start frames = case Machine.brakingForm (Machine.braking machine) of
  ByControl -> []
  SlowFrames -> []
  BrakedFrames (Feed final) ->
    snd
      ( foldr
          judge
          ((final / 60) ^ (2 :: Int) + 2 * a * sum ways, [])
          (zip3 (zip starts (drop 1 starts)) strokes (drop 1 (map Just strokes) <> [Nothing]))
      )
  where
    strokes = Control.run start frames
    a = Machine.deceleration (Machine.braking machine)
    ways = map (wayOf machine) strokes
    starts = scanl (+) 0 ways
    Mm pulse = Machine.pulse machine
    -- Of all speeds behind: the least square of one, with what is gained by braking from the
    -- beginning of the tape to it.
    judge ((begin, end), s, next) (least, found)
      | brakes s
          && maybe False (\n -> brakes n && Frame.speed (frame n) == Frame.speed (frame s)) next =
        (least, found)
      | otherwise =
        ( min least (v * v + 2 * a * (if brakes s then end else begin)),
          [TooFast (number s) (Feed (60 * v)) (Feed (60 * sqrt most)) | v * v > most + sameSquare]
            <> found
        )
      where
        v = obtained machine s
        most = max 0 (least - 2 * a * (end - roundedBy * pulse))
        sameSquare = 1e-9 * max 1 (v * v)
    brakes = Frame.braking . frame

-- | The way between two places may have become longer or shorter by so many pulses: each is rounded
-- by up to one.
roundedBy :: Double
roundedBy = 2
