-- | Feed codes: the code of a frame for a feed, and the feed that a code gives.
--
-- On some machines a code is a feed along the path. On others it is a frequency of the leading
-- axis, in pulses per second. The feed along the path then depends on the direction of the frame as
-- well. The leading axis of a frame is the axis with the most pulses.
module Frame.FeedCode
  ( codeFor,
    turnCode,
    cutCode,
    feedOf,
    frequencies,
    frameLength,
    codeValue,
    rapidFeed,
    expectedFeed,
    nearestCode,
    feedAlongAxis,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Feed (..), Mm (..), Pulses (..))
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Geometry.Segment qualified as Segment
import Machine.Machine (Axis (..), FeedChoice (..), FeedCode, FeedMeasure (..), Machine)
import Machine.Machine qualified as Machine
import Part.CutFeed (CutFeed (..))
import Part.CutFeed qualified as CutFeed

-- | Code of the machine for the feed @v@ in the frame @f@, whose length is @l@; 'NoSuchFeed' if the
-- feed is outside of the machine's range. The code that the frame already holds is ignored.
codeFor :: Machine -> Feed -> Frame -> Mm -> FeedChoice
codeFor machine v f l = Machine.choose machine (codeValue machine v f l)

-- | Code for a feed for one turn of the spindle, on a machine that has such codes.
turnCode :: Machine -> CutFeed -> Maybe FeedChoice
turnCode machine v = case v of
  PerMinute _ -> Nothing
  PerTurn (Mm d) _ -> Machine.chooseTurn machine d

-- | The feed @v@ in the unit of the machine's codes, for the frame @f@ of length @l@: mm/min along
-- the path, or pulses per second of the leading axis.
codeValue :: Machine -> Feed -> Frame -> Mm -> Double
codeValue machine (Feed v) f l = maybe v (v / 60 *) (pulsesPerMm machine f l)

-- | Feed along the path that the code of the frame @f@ gives; @l@ is the length of the frame.
-- Nothing for the motions 'NoMotion' and 'Rapid', and for a code that the machine does not have.
feedOf :: Machine -> Frame -> Mm -> Maybe Feed
feedOf machine f l = case motion f of
  NoMotion -> Nothing
  Rapid -> Nothing
  Linear -> obtained
  Circular _ -> obtained
  where
    obtained =
      fmap
        (\x -> Feed (maybe x (\n -> 60 * x / n) (pulsesPerMm machine f l)))
        (Machine.valueOf machine (feedCode f))

-- | Pulses per second of each axis in a straight frame, on a machine whose codes are frequencies.
-- The leading axis has the frequency of the code, and every other axis a share of it in proportion
-- to its pulses. Empty on other machines, for other frames, and for a code that the machine does
-- not have.
frequencies :: Machine -> Frame -> [(Axis, Double)]
frequencies machine f = case (Machine.feedMeasure (Machine.feeds machine), motion f) of
  (LeadingAxis, Linear) ->
    [ (axis, code * fromIntegral n / fromIntegral leading)
      | leading > 0,
        Just code <- [Machine.valueOf machine (feedCode f)],
        (axis, Pulses n) <- [(X, x), (Y, y), (Z, z)]
    ]
  _ -> []
  where
    Pulses3 x y z = abs (increment f)
    Pulses2 a b = abs (turn f)
    Pulses leading = maximum [x, y, z, a, b]

-- | Pulses of the leading axis per mm of the path. Nothing on a machine whose codes are feeds along
-- the path. On an arc the leading axis changes. Therefore an arc counts as a move along one axis,
-- and so does a frame of length 0.
pulsesPerMm :: Machine -> Frame -> Mm -> Maybe Double
pulsesPerMm machine f (Mm l) = case Machine.feedMeasure (Machine.feeds machine) of
  AlongPath -> Nothing
  LeadingAxis -> Just (if l > 0 && leading > 0 then fromIntegral leading / l else 1 / pulse)
  where
    Mm pulse = Machine.planeResolution machine
    leading = case motion f of
      Circular _ -> 0
      _ ->
        let Pulses3 x y z = abs (increment f)
            Pulses2 a b = abs (turn f)
            Pulses n = maximum [x, y, z, a, b]
         in n

-- | Length of a frame in mm, in space: of its line, arc or helix.
frameLength :: Machine -> Frame -> Mm
frameLength machine f = Mm (sqrt (l * l + h * h))
  where
    Mm l = Segment.length (Frame.segment machine 0 f)
    Mm h = Frame.height machine (increment f)

-- | Code for the feed @v@ of a cut in the frame @f@, as 'nearestCode' gives it. A feed that is not
-- known has the code of the lowest feed; "Frame.InstructionCheck" reports it.
cutCode :: Machine -> CutFeed -> Frame -> FeedCode
cutCode machine v f = case (turnCode machine v, CutFeed.perMinute v) of
  (Just (Given code _), _) -> code
  (_, Just feed) -> nearestCode machine feed f
  (_, Nothing) -> fst (Machine.slowest machine)

-- | Code for the feed @v@ in the frame @f@. For a feed outside of the machine's range it is the
-- code of the machine's lowest or highest feed.
nearestCode :: Machine -> Feed -> Frame -> FeedCode
nearestCode machine v f = case Machine.choose machine asked of
  Given code _ -> code
  NoSuchFeed low high -> case Machine.choose machine (if asked < low then low else high) of
    Given code _ -> code
    NoSuchFeed _ _ -> Machine.rapidCode machine
  where
    asked = codeValue machine v f (frameLength machine f)

-- | Feed in mm/min of rapid moves along an axis; 0 if the machine description does not give it.
rapidFeed :: Machine -> Feed
rapidFeed machine =
  maybe (Feed 0) (feedAlongAxis machine) (Machine.valueOf machine (Machine.rapidCode machine))

-- | Feed that the machine gives for the feed @asked@. The result is exact if codes are feeds along
-- the path. If codes are frequencies, the feed depends on the direction of the frame, which is not
-- known here, so the result is @asked@. It is also @asked@ if the machine has no such feed.
expectedFeed :: Machine -> Feed -> Feed
expectedFeed machine asked@(Feed v) =
  case (Machine.feedMeasure (Machine.feeds machine), Machine.choose machine v) of
    (AlongPath, Given _ x) -> Feed x
    (AlongPath, NoSuchFeed _ _) -> asked
    (LeadingAxis, _) -> asked

-- | Feed in mm/min along an axis, from the feed @x@ in the unit of the machine's codes.
feedAlongAxis :: Machine -> Double -> Feed
feedAlongAxis machine x = case Machine.feedMeasure (Machine.feeds machine) of
  AlongPath -> Feed x
  LeadingAxis -> let Mm pulse = Machine.planeResolution machine in Feed (60 * x * pulse)
