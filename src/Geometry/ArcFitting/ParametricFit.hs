-- | Tracks: curves given by a parameter, and the arcs and lines that stand for them.
module Geometry.ArcFitting.ParametricFit
  ( ParametricCurve (..),
    OneSided (..),
    approximate,

    -- * One biarc
    Further (..),
    further,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (minimumBy, sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Ord (comparing)
import Geometry.ArcFitting.Biarc qualified as Biarc
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | A curve given by a parameter that rises.
data ParametricCurve = ParametricCurve
  { place :: Double -> Point,
    -- | of length 1; the sides differ at most where one span goes over into the next
    direction :: OneSided -> Double -> Vec,
    -- | the parameter where the curve begins
    begin :: Double,
    -- | where each span ends, rising; within a span the direction does not jump
    breaks :: NonEmpty Double
  }

-- | The direction in which a walk arrives at a point, or in which it leaves.
data OneSided = Arriving | Leaving
  deriving stock (Eq, Show)

-- | A part of a track without corners: spans that go over into one another.
type Stretch = NonEmpty (Double, Double)

-- | Arcs and lines that stay within a distance of a curve, both ways, in as few biarcs as going as
-- far as possible each time gives. One group for each stretch between corners; within a group the
-- directions agree. The ends of the biarcs lie on the curve and have its direction (the mean of the
-- two at a kink that is no corner). Where a curve has no direction to go by, a straight line of
-- 'Tolerance.finestStep' of a span is put. A biarc costs some dozens of points of the curve, and a
-- few for each span that it passes.
approximate :: Mm -> ParametricCurve -> NonEmpty (NonEmpty Segment)
approximate (Mm tolerance) track =
  case concatMap (long . follow track tolerance) (NonEmpty.toList (stretches track)) of
    [] ->
      (Straight (place track (begin track)) (place track (NonEmpty.last (breaks track))) :| [])
        :| []
    group : more -> group :| more
  where
    long segments =
      maybe [] pure (NonEmpty.nonEmpty (filter (\s -> Segment.start s /= Segment.end s) segments))

-- | The spans of a track, in groups between corners.
stretches :: ParametricCurve -> NonEmpty Stretch
stretches track =
  case filter
    (uncurry (<))
    (zip (begin track : NonEmpty.toList (breaks track)) (NonEmpty.toList (breaks track))) of
    [] -> pure (pure (begin track, begin track))
    first : rest -> gather (first :| []) rest
  where
    gather (before :| others) spans = case spans of
      [] -> pure (NonEmpty.reverse (before :| others))
      next : more
        | corner (snd before) ->
          NonEmpty.cons (NonEmpty.reverse (before :| others)) (gather (next :| []) more)
        | otherwise -> gather (next :| before : others) more
    corner u =
      let Rad jump =
            Vec.turn (direction track Arriving u) (direction track Leaving u)
       in Rad (abs jump) > Tolerance.kink

-- | The walk along one stretch: its spans from where the walk is to the end, the largest deviation
-- to aim at.
data Walk = Walk
  { track :: ParametricCurve,
    aim :: Double,
    final :: Double,
    at :: Double,
    pose :: (Point, Vec),
    ahead :: [(Double, Double)]
  }

-- | The segments along a stretch. Where the end may be near, the whole rest is tried first: that a
-- shorter biarc does not do it does not mean that a longer one does not either.
follow :: ParametricCurve -> Double -> Stretch -> [Segment]
follow track tolerance stretch = go walk (final walk - start)
  where
    start = fst (NonEmpty.head stretch)
    walk =
      Walk
        { track,
          aim = tolerance * (1 - Tolerance.deviationShare),
          final = snd (NonEmpty.last stretch),
          at = start,
          pose = (place track start, direction track Leaving start),
          ahead = NonEmpty.toList stretch
        }
    go w step
      | at w < final w =
        let rest = final w - at w
            Trial {reached, pieces} = furthest w (if rest <= 4 * step then rest else step)
            next =
              w
                { at = reached,
                  pose = (Segment.end (NonEmpty.last pieces), heading w reached),
                  ahead = dropWhile ((<= reached) . snd) (ahead w)
                }
         in NonEmpty.toList pieces <> go next (reached - at w)
      | otherwise = []

-- | A biarc, and the parameter at which it ends on the curve.
data Further = Further Double (NonEmpty Segment)

-- | One biarc of a stretch that ends at a parameter: from a parameter, the place and the direction
-- of the biarc before, and a step to try.
further :: Mm -> ParametricCurve -> Double -> Double -> (Point, Vec) -> Double -> Further
further (Mm tolerance) track final at pose step = Further reached pieces
  where
    Trial {reached, pieces} =
      furthest
        Walk {track, aim = tolerance * (1 - Tolerance.deviationShare), final, at, pose, ahead}
        step
    ahead = takeWhile ((< final) . fst) (dropWhile ((<= at) . snd) (zip (begin track : ends) ends))
    ends = NonEmpty.toList (breaks track)

-- | The direction at a joint: the mean of both sides where spans meet.
heading :: Walk -> Double -> Vec
heading w u
  | u >= final w = arriving
  | any ((== u) . snd) (takeWhile ((<= u) . fst) (ahead w)) = Vec.unit (Vec.add arriving leaving)
  | otherwise = leaving
  where
    arriving = direction (track w) Arriving u
    leaving = direction (track w) Leaving u

-- | A biarc that has been tried: how far it reaches, and the largest distance from the curve.
data Trial = Trial {reached :: Double, pieces :: NonEmpty Segment, off :: Double}

-- | The biarc that reaches furthest within the tolerance. The deviation grows with the third power
-- of the step where the curve is smooth; the next step to try is taken from that, between the
-- longest that held and the shortest that did not.
furthest :: Walk -> Double -> Trial
furthest w first = beyond (search (24 :: Int) Nothing Nothing first)
  where
    u = at w
    -- On a rough scale longer biarcs can hold where shorter ones do not.
    beyond best
      | final w - u > 16 * (reached best - u) = best
      | otherwise =
        case [ t
               | f <- [2.2, 1.8, 1.5, 1.25],
                 let v = u + f * (reached best - u),
                 v < final w,
                 let t = try w v,
                 off t <= aim w
             ] of
          [] -> best
          t : _ -> search (8 :: Int) (Just t) Nothing (1.1 * (reached t - u))
    search left held missed step
      | step <= least = fromMaybe forced held
      | off found <= aim w =
        if enough found then found else search (left - 1) (Just found) missed (longer found)
      | otherwise = case held of
        Just best | left <= 0 || narrow best (reached found) -> best
        _ -> search (left - 1) held (Just (reached found)) (shorter found)
      where
        found = try w (min (final w) (u + step))
        enough t =
          left <= 0
            || reached t >= final w
            || off t >= 0.93 * aim w
            || maybe False (narrow t) missed
        longer t = within t (fromMaybe (u + 4 * step) missed) (step * growth t)
        shorter t = case held of
          Just best -> within best (reached t) (step * growth t)
          Nothing -> step * max 0.1 (min 0.9 (growth t))
    -- By how much the step can grow.
    growth t = if off t > 0 then (0.97 * aim w / off t) ** (1 / 3) else 4
    narrow best missed = missed - reached best <= 0.02 * (reached best - u)
    -- A step between two others.
    within best limit s =
      let a =
            reached best - u
          gap = limit - reached best
       in max (a + 0.15 * gap) (min (a + 0.85 * gap) s)
    least = case ahead w of
      (lo, hi) : _ -> (hi - lo) * Tolerance.finestStep
      [] -> final w - u
    forced =
      let v =
            min (final w) (u + least)
       in Trial v (Straight (fst (pose w)) (place (track w) v) :| []) 0

-- | The biarc to a parameter, measured; where the usual ratio of the chords misses, the best of
-- others, among them those that put the joint where spans meet.
try :: Walk -> Double -> Trial
try w v
  | Vec.near p q = measured (Straight p q :| [])
  | otherwise = case tried [usual] of
    (d, _, pieces) : _ | d <= aim w -> measured pieces
    _ -> case tried (map (* usual) [1, 0.7, 1.4, 0.5, 2, 0.35, 2.8, 0.25, 4] <> breaking) of
      [] -> Trial v (Straight p q :| []) (8 * aim w)
      some -> let (_, _, pieces) = closer (6 :: Int) 1.4 (least some) in measured pieces
  where
    u = at w
    p = fst (pose w)
    q = place (track w) v
    end = (q, heading w v)
    usual = Biarc.ratio (pose w) end
    tried rs =
      [(roughly pieces, r, pieces) | r <- rs, Just pieces <- [Biarc.joinWith r (pose w) end]]
    least some = minimumBy (comparing (\(d, _, _) -> d)) some
    -- A better ratio in the neighbourhood, where that can be enough.
    closer left factor best@(d, r, _)
      | left <= 0 || d <= aim w || d > 4 * aim w = best
      | otherwise =
        closer (left - 1) (sqrt factor) (least (best : tried [r / sqrt factor, r * sqrt factor]))
    -- Few spans are enough: what has many is no chain of lines and arcs.
    breaking = case drop 1 parts of
      inner
        | length inner <= 8 ->
          [ b / a
            | (m, _) <- inner,
              let c = place (track w) m,
              let Mm a = Vec.distance p c,
              let Mm b = Vec.distance c q,
              a > 0,
              b > 0
          ]
      _ -> []
    parts = [(max u lo, min v hi) | (lo, hi) <- takeWhile ((< v) . fst) (ahead w), hi > u]
    middles = concatMap snd stations
    stations = [(part, spread (place (track w)) 0.5 part) | part <- counted w v parts]
    roughly pieces = maximum (map (apart pieces . snd) middles)
    measured pieces
      | roughly pieces > aim w = Trial v pieces (roughly pieces)
      | otherwise =
        Trial
          v
          pieces
          ( deviation
              (place (track w))
              (aim w)
              pieces
              ( (u, p) :
                concat [interleaved ms (spread (place (track w)) 0 part) | (part, ms) <- stations]
              )
          )
    interleaved as bs = concat (zipWith (\a b -> [a, b]) as bs)

-- | Parts of spans, with the number of points to look at: as many as their share of the parameter
-- or of the length asks for.
counted :: Walk -> Double -> [(Double, Double)] -> [(Int, (Double, Double))]
counted w v parts = case parts of
  [one] -> [(8, one)]
  _ ->
    [ (max 3 (ceiling (8 * max ((b - a) / (v - at w)) (chord / whole))), (a, b))
      | ((a, b), chord) <- zip parts chords
    ]
  where
    chords =
      [let Mm d = Vec.distance (place (track w) a) (place (track w) b) in d | (a, b) <- parts]
    whole = sum chords

-- | Points of a curve over a part of a span, moved back by a share of their distance; not quite
-- evenly, so that a wave does not pass for its samples.
spread :: (Double -> Point) -> Double -> (Int, (Double, Double)) -> [(Double, Point)]
spread point back (n, (a, b)) =
  [ let u =
          a + (b - a) * uneven ((fromIntegral k - back) / fromIntegral n)
     in (u, point u)
    | k <- [1 .. n]
  ]
  where
    uneven f = f + 0.2 * f * (1 - f)

-- | The distance of a point from the nearest of some segments.
apart :: NonEmpty Segment -> Point -> Double
apart pieces p = let Mm d = minimum (fmap (Distance.toPoint p) pieces) in d

-- | The largest distance between segments and a curve given by points along it: at these points,
-- near the segments' joint, and at each maximum between them. Infinite where the feet on the
-- segments jump or go back: then not every point of the segments is near the curve.
deviation :: (Double -> Point) -> Double -> NonEmpty Segment -> [(Double, Point)] -> Double
deviation point aim pieces points
  | largest > aim || covered point aim pieces feet = largest
  | otherwise = 1 / 0
  where
    feet = [(w, p, progress pieces p) | (w, p) <- points]
    Mm half = Segment.length (NonEmpty.head pieces)
    atJoint =
      [ let w = a + (b - a) * (half - s) / (t - s) in (w, off w)
        | length pieces > 1,
          ((a, _, s), (b, _, t)) <- zip feet (drop 1 feet),
          s < half,
          half < t
      ]
    known = sort ([(w, apart pieces p) | (w, p) <- points] <> atJoint)
    off w = apart pieces (point w)
    largest =
      maximum
        ( map snd known
            <> zipWith3
              (\a b c -> snd (highest off aim (6 :: Int) a b c))
              known
              (drop 1 known)
              (drop 2 known)
        )

-- | The maximum about the middle one of three neighbouring values, if that is the largest and
-- matters: the vertex of the parabola through them, again and again until it says nothing new.
highest ::
  (Double -> Double) ->
  Double ->
  Int ->
  (Double, Double) ->
  (Double, Double) ->
  (Double, Double) ->
  (Double, Double)
highest off aim left one@(a, da) two@(b, db) three@(c, dc)
  | left <= 0
      || db < da
      || db < dc
      || db < 0.3 * aim
      || not (below > 0 && w > a && w < c && w /= b) =
    two
  | abs (dw - db) < 0.002 * aim = max' new two
  | dw > db = if w < b then again one new two else again two new three
  | w < b = again new two three
  | otherwise = again one two new
  where
    below = (b - a) * (db - dc) + (c - b) * (db - da)
    w = b - ((b - a) * (b - a) * (db - dc) - (c - b) * (c - b) * (db - da)) / (2 * below)
    dw = off w
    new = (w, dw)
    again = highest off aim (left - 1)
    max' x y = if snd x > snd y then x else y

-- | Whether the feet of a curve's points move along the segments without a jump. Where a foot moves
-- much further than its point, the curve between is looked at more closely.
covered :: (Double -> Point) -> Double -> NonEmpty Segment -> [(Double, Point, Double)] -> Bool
covered point aim pieces feet = and (zipWith (steady (20 :: Int)) feet (drop 1 feet))
  where
    steady left one@(a, p, s) two@(b, q, t)
      | t < s - grain = False
      | t - s <= 1.5 * far + grain = True
      | far <= grain || left <= 0 = False
      | otherwise =
        let middle =
              at ((a + b) / 2)
         in steady (left - 1) one middle && steady (left - 1) middle two
      where
        Mm far = Vec.distance p q
    at w = let p = point w in (w, p, progress pieces p)
    grain = 0.1 * aim

-- | How far along segments the foot of a point lies.
progress :: NonEmpty Segment -> Point -> Double
progress pieces p = go 0 (NonEmpty.toList pieces) (1 / 0, 0)
  where
    go before list best@(nearest, _) = case list of
      [] -> snd best
      s : more ->
        let Mm d = Distance.toPoint p s
            Mm long = Segment.length s
         in go (before + long) more (if d < nearest then (d, before + long * footAt s) else best)
    footAt s
      | Segment.spans s p = Segment.fraction s p
      | Vec.distance p (Segment.start s) <= Vec.distance p (Segment.end s) = 0
      | otherwise = 1
