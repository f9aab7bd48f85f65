{-# OPTIONS_GHC -O2 #-}

-- | Which code a frame gets for a feed, and what feed a code gives.
module Frame.FeedCode
  ( codeFor,
    given,
    wayOf,
    valueFor,
    rapid,
    about,
    nearest,
    alongAxis,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Feed (..), Mm (..), Pulses (..))
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Geometry.Segment qualified as Segment
import Machine.Machine (FeedChoice (..), FeedCode, FeedMeasure (..), Machine)
import Machine.Machine qualified as Machine

-- | The code for a feed in a frame of this length, whatever code stands there.
codeFor :: Machine -> Feed -> Frame -> Mm -> FeedChoice
codeFor machine v f way = Machine.choose machine (valueFor machine v f way)

-- | A feed in the measure of the machine's codes.
valueFor :: Machine -> Feed -> Frame -> Mm -> Double
valueFor machine (Feed v) f way = maybe v (v / 60 *) (perMm machine f way)

-- | The feed along the path that a frame's code gives, for a frame of this length. None where
-- nothing moves, where a rapid move is a motion of its own, and for a code that the machine does
-- not have.
given :: Machine -> Frame -> Mm -> Maybe Feed
given machine f way = case motion f of
  Still -> Nothing
  Rapid -> Nothing
  Straightway -> obtained
  Round _ -> obtained
  where
    obtained =
      fmap
        (\x -> Feed (maybe x (\n -> 60 * x / n) (perMm machine f way)))
        (Machine.valueOf machine (speed f))

-- | How many pulses of the leading axis fall on a mm of the path; none where feeds are those along
-- the path. On an arc the axis that leads changes: there it is the pulses of the way itself. A
-- frame without length counts as one along an axis.
perMm :: Machine -> Frame -> Mm -> Maybe Double
perMm machine f (Mm way) = case Machine.feedMeasure (Machine.feeds machine) of
  AlongPath -> Nothing
  LeadingAxis -> Just (if way > 0 && leading > 0 then fromIntegral leading / way else 1 / grain)
  where
    Mm grain = Machine.pulse machine
    leading = case motion f of
      Round _ -> 0
      _ -> let Pulses3 x y z = abs (increment f); Pulses n = max x (max y z) in n

-- | The length of a frame's way in mm.
wayOf :: Machine -> Frame -> Mm
wayOf machine f = case motion f of
  Round _ -> plane
  _ -> let Mm l = plane; Mm h = Frame.height machine (increment f) in Mm (sqrt (l * l + h * h))
  where
    plane = Segment.length (Frame.segment machine 0 f)

-- | The code for a feed; the lowest or the highest for one that the machine does not have.
nearest :: Machine -> Feed -> Frame -> FeedCode
nearest machine v f = case Machine.choose machine asked of
  Given code _ -> code
  NoSuchFeed low high -> case Machine.choose machine (if asked < low then low else high) of
    Given code _ -> code
    NoSuchFeed _ _ -> Machine.rapidCode machine
  where
    asked = valueFor machine v f (wayOf machine f)

-- | The feed of rapid moves, as far as it is known.
rapid :: Machine -> Feed
rapid machine =
  maybe (Feed 0) (alongAxis machine) (Machine.valueOf machine (Machine.rapidCode machine))

-- | The feed that is obtained for one that is asked: exactly where codes are feeds along the path,
-- else about.
about :: Machine -> Feed -> Feed
about machine asked@(Feed v) =
  case (Machine.feedMeasure (Machine.feeds machine), Machine.choose machine v) of
    (AlongPath, Given _ x) -> Feed x
    (AlongPath, NoSuchFeed _ _) -> asked
    (LeadingAxis, _) -> asked

-- | The feed that a value of the machine's codes gives along an axis.
alongAxis :: Machine -> Double -> Feed
alongAxis machine x = case Machine.feedMeasure (Machine.feeds machine) of
  AlongPath -> Feed x
  LeadingAxis -> let Mm grain = Machine.pulse machine in Feed (60 * x * grain)
