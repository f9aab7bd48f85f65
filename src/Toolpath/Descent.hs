-- | Ways down into the material: along a path (a ramp or a spiral), or by a helix.
--
-- A way begins straight down, to the height at which the material begins or to the height of the
-- pass before. From there it goes down in a slope to the height of the pass. It ends where the path
-- of the pass begins, or, for a helix, at its centre.
module Toolpath.Descent
  ( Way (..),
    Slope (..),
    ramp,
    spiral,
    helix,
    isClosed,
    mostTurns,
    leastHelix,
    usualShare,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier (Circle (Circle), Sense)
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | A way down into the material.
data Way = Way
  { -- | the point above which the slope begins
    entry :: Point,
    -- | the height at which the slope begins; the top of the part is 0
    entryHeight :: Mm,
    -- | the parts of the slope in order
    slope :: NonEmpty Slope
  }
  deriving stock (Eq, Show)

-- | A part of a way down.
data Slope = Slope
  { -- | its line or arc in the plane
    piece :: Segment,
    -- | its heights at the beginning and at the end
    heights :: (Mm, Mm),
    -- | the length of the path up to its beginning and to its end; Nothing for a helix, which is
    -- beside the path
    along :: Maybe (Mm, Mm)
  }
  deriving stock (Eq, Show)

-- | A part of a path, with the lengths of the path up to its beginning and to its end.
data Stretch = Stretch Segment (Mm, Mm)

-- | The largest number of turns of a helix, laps of a spiral, or strokes of a ramp. No real part
-- needs more.
mostTurns :: Int
mostTurns = 1000

-- | The least diameter of the path of the centre in a helix, as a share of the cutter's diameter. A
-- smaller helix is hardly better than going straight down.
leastHelix :: Double
leastHelix = 0.1

-- | The diameter of the path of the centre in a helix for which the program gives none, as a share
-- of the cutter's diameter: the cutter overlaps the axis of the helix, so that no core stays.
usualShare :: Double
usualShare = 0.9

-- | The ramp from the height @top@ to the height @bottom@ at the angle @angle@ at most, which ends
-- where the path begins. On a closed path the ramp is the last part of the path, in several laps if
-- it is longer than the path. On an open path it goes forth and back. Nothing if that takes more
-- than 'mostTurns' laps or strokes.
ramp :: Rad -> (Mm, Mm) -> NonEmpty Segment -> Maybe Way
ramp (Rad angle) (top, bottom) given = do
  path <- withLength given
  let far = times (1 / tan angle) (minus top bottom)
      long = lengthOf path
      -- An even number of strokes, which all have the same length.
      pairs = max 1 (min 1000000 (ceiling' (over far (times 2 long))))
      share = times (1 / fromIntegral (2 * pairs)) far
  if isClosed given
    then
      if over far long > fromIntegral mostTurns
        then Nothing
        else Just (sloped (top, bottom) (lastPart far (NonEmpty.cycle (NonEmpty.reverse path))))
    else
      if 2 * pairs > mostTurns
        then Nothing
        else Just (sloped (top, bottom) (thereAndBack pairs (firstPart share path)))

-- | The spiral from the height @top@ to the height @bottom@ along a closed path, by the depth
-- @step@ at most in each lap. Nothing if that takes more than 'mostTurns' laps, or if the path is
-- open.
spiral :: Mm -> (Mm, Mm) -> NonEmpty Segment -> Maybe Way
spiral step (top, bottom) given = do
  path <- withLength given
  if laps > mostTurns || not (isClosed given)
    then Nothing
    else Just (sloped (top, bottom) (repeated laps path))
  where
    laps = max 1 (ceiling' (over (minus top bottom) step))

-- | The helix from the height @top@ to the height @bottom@ about @centre@, with the radius @radius@
-- of the path of the cutter's centre and the pitch @pitch@ at most. A full circle at the bottom and
-- a line to the centre follow. Nothing if the helix has more than 'mostTurns' turns.
helix :: Sense -> Mm -> Mm -> (Mm, Mm) -> Point -> Maybe Way
helix sense pitch radius (top, bottom) centre
  | turns > mostTurns = Nothing
  | otherwise = Just down {slope = beside (slope down <> (flat circle :| [flat inwards]))}
  where
    turns = max 1 (ceiling' (over (minus top bottom) pitch))
    down = sloped (top, bottom) (repeated turns (stretches (circle :| [])))
    flat s = Slope {piece = s, heights = (bottom, bottom), along = Nothing}
    inwards = Straight (Segment.start circle) centre
    beside = fmap (\s -> s {along = Nothing})
    Mm r = radius
    circle = Segment.fullCircle sense (Circle centre radius) (Vec.shift (Vec.vec r 0) centre)

-- | The way along a path with one slope from the height @top@ to the height @bottom@.
sloped :: (Mm, Mm) -> NonEmpty Stretch -> Way
sloped (top, bottom) path =
  Way
    { entry = let Stretch s _ = NonEmpty.head path in Segment.start s,
      entryHeight = top,
      slope = go (Mm 0) path
    }
  where
    long = lengthOf path
    at done = plus top (times (min 1 (over done long)) (minus bottom top))
    go done (Stretch piece place :| more) =
      let ended = plus done (Segment.length piece)
          part z = Slope {piece, heights = (at done, z), along = Just place}
       in case NonEmpty.nonEmpty more of
            Nothing -> part bottom :| []
            Just others -> NonEmpty.cons (part (at ended)) (go ended others)

-- | The last part of a path, of the length @far@. The stretches come in the reverse order, again
-- and again.
lastPart :: Mm -> NonEmpty Stretch -> NonEmpty Stretch
lastPart = go []
  where
    go done left (s@(Stretch piece _) :| more) = case more of
      next : others
        | Segment.length piece < left ->
          go (s : done) (minus left (Segment.length piece)) (next :| others)
      _ -> snd (cut (max 0 (1 - over left (Segment.length piece))) s) :| done

-- | The first part of a path, of the length @far@ at most.
firstPart :: Mm -> NonEmpty Stretch -> NonEmpty Stretch
firstPart far (s@(Stretch piece _) :| more) = case more of
  next : others
    | Segment.length piece < far ->
      NonEmpty.cons s (firstPart (minus far (Segment.length piece)) (next :| others))
  _ -> fst (cut (min 1 (over far (Segment.length piece))) s) :| []

-- | The parts of a stretch before and after a fraction of its length.
cut :: Double -> Stretch -> (Stretch, Stretch)
cut share (Stretch piece (from, to)) = (Stretch front (from, middle), Stretch back (middle, to))
  where
    (front, back) = Segment.cutAt share piece
    middle = plus from (times share (minus to from))

-- | A path forth and back, so many times.
thereAndBack :: Int -> NonEmpty Stretch -> NonEmpty Stretch
thereAndBack count path = repeated count (path <> NonEmpty.reverse (fmap backwards path))
  where
    backwards (Stretch piece (from, to)) = Stretch (Segment.reverse piece) (to, from)

-- | A path so many times, at least once.
repeated :: Int -> NonEmpty Stretch -> NonEmpty Stretch
repeated count path = foldr1 (<>) (path :| replicate (count - 1) path)

-- | The segments of a path as stretches.
stretches :: NonEmpty Segment -> NonEmpty Stretch
stretches = go (Mm 0)
  where
    go done (s :| more) =
      let ended = plus done (Segment.length s)
          stretch = Stretch s (done, ended)
       in maybe (stretch :| []) (NonEmpty.cons stretch . go ended) (NonEmpty.nonEmpty more)

-- | The stretches that have a length; Nothing if none has.
withLength :: NonEmpty Segment -> Maybe (NonEmpty Stretch)
withLength = NonEmpty.nonEmpty . NonEmpty.filter isLong . stretches
  where
    isLong (Stretch s _) = Segment.length s > Tolerance.coincident

-- | The number rounded up, unless it exceeds a whole number by 'Tolerance.equal' only.
ceiling' :: Double -> Int
ceiling' x = ceiling (min 1e9 x - Tolerance.equal)

-- | True for a path that ends where it begins.
isClosed :: NonEmpty Segment -> Bool
isClosed path =
  Vec.isNear (Segment.start (NonEmpty.head path)) (Segment.end (NonEmpty.last path))

lengthOf :: NonEmpty Stretch -> Mm
lengthOf = foldl (\l (Stretch s _) -> plus l (Segment.length s)) (Mm 0)
