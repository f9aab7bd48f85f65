-- | Arc fitting of parametric curves by biarcs. Deviations are measured at sample points, so the
-- curve may be any function of its parameter.
--
-- A stretch is the part of a curve between two corners; a corner is a change of direction above
-- 'Tolerance.kink'. A foot of a point on segments is the nearest point of the segments. A step is
-- the difference of the parameters at both ends of a biarc. The chord ratio of a biarc is the
-- length of its second arc's chord divided by that of its first arc's.
module Geometry.ArcFitting.ParametricFit
  ( ParametricCurve (..),
    OneSided (..),
    approximate,

    -- * One biarc
    FitStep (..),
    oneBiarc,
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

-- | Curve given by functions of a parameter. The parameter increases from the start of the curve to
-- its end.
data ParametricCurve = ParametricCurve
  { -- | point at a parameter
    place :: Double -> Point,
    -- | unit direction in which the curve arrives at a parameter or leaves it; the two differ only
    -- where spans meet
    direction :: OneSided -> Double -> Vec,
    -- | parameter at the start of the curve
    begin :: Double,
    -- | parameters at the ends of the spans, ascending; within a span the direction is continuous
    breaks :: NonEmpty Double
  }

-- | Choice between two directions of a curve at one of its points: the direction in which the curve
-- arrives at the point, or the direction in which it leaves the point.
data OneSided = Arriving | Leaving
  deriving stock (Eq, Show)

-- | Stretch of a curve: consecutive spans, each by its first and last parameter.
type Stretch = NonEmpty (Double, Double)

-- | Arcs and lines within a tolerance of a curve. The tolerance holds from the curve to the arcs
-- and from the arcs to the curve. The fit is greedy: each biarc is as long as possible. The result
-- has one group of segments for each stretch; within a group the direction is continuous.
--
-- The ends of the biarcs lie on the curve and have the curve's direction. Where two spans meet with
-- directions that differ too little for a corner, the end of a biarc has their mean direction.
-- If no biarc succeeds, a very short line between two points of the curve takes its place. Its
-- step is the share 'Tolerance.finestStep' of the span's parameter interval, and the direction may
-- change at its ends. For each biarc some dozens of curve points are computed, and a few more for
-- each span that the biarc passes.
approximate :: Mm -> ParametricCurve -> NonEmpty (NonEmpty Segment)
approximate (Mm tolerance) curve =
  case concatMap (long . follow curve tolerance) (NonEmpty.toList (stretches curve)) of
    [] ->
      (Straight (place curve (begin curve)) (place curve (NonEmpty.last (breaks curve))) :| [])
        :| []
    group : more -> group :| more
  where
    long segments =
      maybe [] pure (NonEmpty.nonEmpty (filter (\s -> Segment.start s /= Segment.end s) segments))

-- | Stretches of a curve, in order.
stretches :: ParametricCurve -> NonEmpty Stretch
stretches curve =
  case filter
    (uncurry (<))
    (zip (begin curve : NonEmpty.toList (breaks curve)) (NonEmpty.toList (breaks curve))) of
    [] -> pure (pure (begin curve, begin curve))
    first : rest -> gather (first :| []) rest
  where
    gather (before :| others) spans = case spans of
      [] -> pure (NonEmpty.reverse (before :| others))
      next : more
        | isCorner (snd before) ->
          NonEmpty.cons (NonEmpty.reverse (before :| others)) (gather (next :| []) more)
        | otherwise -> gather (next :| before : others) more
    isCorner u =
      let Rad jump =
            Vec.signedAngle (direction curve Arriving u) (direction curve Leaving u)
       in Rad (abs jump) > Tolerance.kink

-- | State of the fit along one stretch.
data FitState = FitState
  { curve :: ParametricCurve,
    -- | largest allowed deviation at sample points, in mm
    aim :: Double,
    -- | parameter at the end of the stretch
    final :: Double,
    -- | parameter at which the next biarc starts
    at :: Double,
    -- | position and unit direction at @at@
    pose :: (Point, Vec),
    -- | spans that end after @at@, each by its first and last parameter
    ahead :: [(Double, Double)]
  }

-- | Segments along a stretch, within a tolerance in mm. When the end of the stretch is near, a
-- biarc to this end is tried first: a longer biarc can succeed where a shorter one fails.
follow :: ParametricCurve -> Double -> Stretch -> [Segment]
follow curve tolerance stretch = go initial (final initial - start)
  where
    start = fst (NonEmpty.head stretch)
    initial =
      FitState
        { curve,
          aim = tolerance * (1 - Tolerance.deviationShare),
          final = snd (NonEmpty.last stretch),
          at = start,
          pose = (place curve start, direction curve Leaving start),
          ahead = NonEmpty.toList stretch
        }
    go w step
      | at w < final w =
        let toEnd = final w - at w
            Trial {reached, biarc} = longestBiarc w (if toEnd <= 4 * step then toEnd else step)
            next =
              w
                { at = reached,
                  pose = (Segment.end (NonEmpty.last biarc), heading w reached),
                  ahead = dropWhile ((<= reached) . snd) (ahead w)
                }
         in NonEmpty.toList biarc <> go next (reached - at w)
      | otherwise = []

-- | Parameter at which a biarc ends on the curve, and the segments of the biarc.
data FitStep = FitStep Double (NonEmpty Segment)

-- | Longest biarc along a stretch, within a tolerance. It starts at the parameter @at@ with the
-- position and direction @pose@. @final@ is the parameter at the end of the stretch. The step
-- @step@ is tried first.
oneBiarc :: Mm -> ParametricCurve -> Double -> Double -> (Point, Vec) -> Double -> FitStep
oneBiarc (Mm tolerance) curve final at pose step = FitStep reached biarc
  where
    Trial {reached, biarc} =
      longestBiarc
        FitState {curve, aim = tolerance * (1 - Tolerance.deviationShare), final, at, pose, ahead}
        step
    ahead = takeWhile ((< final) . fst) (dropWhile ((<= at) . snd) (zip (begin curve : ends) ends))
    ends = NonEmpty.toList (breaks curve)

-- | Unit direction in which a biarc ends at parameter @u@: that of the curve. Where spans meet
-- inside of the stretch, it is the mean of the arriving and the leaving direction. At the end of
-- the stretch it is the arriving one.
heading :: FitState -> Double -> Vec
heading w u
  | u >= final w = arriving
  | any ((== u) . snd) (takeWhile ((<= u) . fst) (ahead w)) = Vec.unit (Vec.add arriving leaving)
  | otherwise = leaving
  where
    arriving = direction (curve w) Arriving u
    leaving = direction (curve w) Leaving u

-- | Biarc that was tried: the parameter at its end, its segments, and its largest distance from the
-- curve in mm.
data Trial = Trial {reached :: Double, biarc :: NonEmpty Segment, distance :: Double}

-- | Longest biarc within the tolerance, by a bracketing search that begins with the step @first@.
-- On a smooth curve the deviation grows with the third power of the step. The next step is
-- extrapolated by this rule and clamped between the longest success and the shortest failure.
longestBiarc :: FitState -> Double -> Trial
longestBiarc w first = tryLonger (search w 24 Nothing Nothing first)
  where
    u = at w
    -- Longer biarcs are tried if the best covers a sixteenth of the remaining stretch or more: one
    -- of them can succeed where shorter ones fail.
    tryLonger best
      | final w - u > 16 * (reached best - u) = best
      | otherwise =
        case [ t
               | f <- [2.2, 1.8, 1.5, 1.25],
                 let v = u + f * (reached best - u),
                 v < final w,
                 let t = try w v,
                 distance t <= aim w
             ] of
          [] -> best
          t : _ -> search w 8 (Just t) Nothing (1.1 * (reached t - u))

-- | Bracketing search for the longest biarc. @step@ is tried next. @success@ is the longest trial
-- within the tolerance so far, and @failure@ the least parameter whose trial failed. Each is
-- Nothing if there is none. Once there is a success, the search ends after at most @remaining@
-- further trials. As long as there is none, the search goes on beyond this count with smaller
-- steps. If no step above 'leastStep' succeeds, the result is the 'fallbackLine'.
search :: FitState -> Int -> Maybe Trial -> Maybe Double -> Double -> Trial
search w remaining success failure step
  | step <= leastStep w = fromMaybe (fallbackLine w) success
  | distance found <= aim w =
    if isLongEnough then found else search w (remaining - 1) (Just found) failure longer
  | otherwise = case success of
    Just best | remaining <= 0 || isNarrow best (reached found) -> best
    _ -> search w (remaining - 1) success (Just (reached found)) shorter
  where
    u = at w
    found = try w (min (final w) (u + step))
    isLongEnough =
      remaining <= 0
        || reached found >= final w
        || distance found >= 0.93 * aim w
        || maybe False (isNarrow found) failure
    longer = within found (fromMaybe (u + 4 * step) failure) (step * growth)
    shorter = case success of
      Just best -> within best (reached found) (step * growth)
      Nothing -> step * max 0.1 (min 0.9 growth)
    -- Factor of the step for which the deviation should be 0.97 of the tolerance; below 1 after a
    -- failure.
    growth = if distance found > 0 then (0.97 * aim w / distance found) ** (1 / 3) else 4
    isNarrow best failed = failed - reached best <= 0.02 * (reached best - u)
    -- Clamps a step to the interior of the bracket.
    within best limit s =
      let a = reached best - u
          gap = limit - reached best
       in max (a + 0.15 * gap) (min (a + 0.85 * gap) s)

-- | Smallest step of the fit, a fixed share of the current span. Only a line covers so small a
-- step; biarcs are tried over longer ones.
leastStep :: FitState -> Double
leastStep w = case ahead w of
  (lo, hi) : _ -> (hi - lo) * Tolerance.finestStep
  [] -> final w - at w

-- | Line over the smallest step, for positions from which no biarc succeeds. Its deviation is not
-- measured and counts as 0.
fallbackLine :: FitState -> Trial
fallbackLine w = Trial v (Straight (fst (pose w)) (place (curve w) v) :| []) 0
  where
    v = min (final w) (at w + leastStep w)

-- | Biarc from the current position to parameter @v@, with its deviation. If the default chord
-- ratio (second chord divided by first) fails, other ratios are tried. Some of them put the joint
-- near a point at which spans meet.
try :: FitState -> Double -> Trial
try w v
  | Vec.isNear p q = measured w v stations (Straight p q :| [])
  | otherwise = case tried [usual] of
    (d, _, segments) : _ | d <= aim w -> measured w v stations segments
    _ -> case tried (map (* usual) [1, 0.7, 1.4, 0.5, 2, 0.35, 2.8, 0.25, 4] <> atSpans) of
      [] -> Trial v (Straight p q :| []) (8 * aim w)
      some ->
        let (_, _, segments) = refineRatio (aim w) tried 6 1.4 (least some)
         in measured w v stations segments
  where
    p = fst (pose w)
    q = place (curve w) v
    end = (q, heading w v)
    usual = Biarc.ratio (pose w) end
    tried rs =
      [ (sampledDistance samples segments, r, segments)
        | r <- rs,
          Just segments <- [Biarc.joinWith r (pose w) end]
      ]
    atSpans = ratiosAtSpans (curve w) p q parts
    parts = [(max (at w) lo, min v hi) | (lo, hi) <- takeWhile ((< v) . fst) (ahead w), hi > at w]
    samples = concatMap snd stations
    stations = [(part, samplePoints (place (curve w)) 0.5 part) | part <- sampleCounts w v parts]

-- | Biarc that was tried: its largest distance in mm from samples of the curve, its chord ratio,
-- and its segments.
type Attempt = (Double, Double, NonEmpty Segment)

-- | The attempt with the least distance from the samples.
least :: [Attempt] -> Attempt
least = minimumBy (comparing (\(d, _, _) -> d))

-- | Refines the chord ratio of the attempt @best@. The result is @best@ itself if its distance is
-- within the tolerance @aim@ (mm) or above four times @aim@. Otherwise the ratio is multiplied and
-- divided by the square root of @factor@, and the best of the three attempts is refined again. This
-- root is the @factor@ of the next round. There are at most @remaining@ rounds. @tried@ makes
-- attempts with given ratios.
refineRatio :: Double -> ([Double] -> [Attempt]) -> Int -> Double -> Attempt -> Attempt
refineRatio aim tried remaining factor best@(d, r, _)
  | remaining <= 0 || d <= aim || d > 4 * aim = best
  | otherwise =
    refineRatio
      aim
      tried
      (remaining - 1)
      (sqrt factor)
      (least (best : tried [r / sqrt factor, r * sqrt factor]))

-- | Chord ratios for biarcs between two points of a curve. Each ratio puts the joint near a point
-- at which two of the @parts@ meet. A part is a span, or the rest of one, by its first and last
-- parameter. Such ratios help where the curve is a chain of lines and arcs. A curve with more than
-- nine parts is not taken for such a chain, and the list is empty.
ratiosAtSpans :: ParametricCurve -> Point -> Point -> [(Double, Double)] -> [Double]
ratiosAtSpans curve p q parts = case drop 1 parts of
  inner
    | length inner <= 8 ->
      [ b / a
        | (m, _) <- inner,
          let c = place curve m,
          let Mm a = Vec.distance p c,
          let Mm b = Vec.distance c q,
          a > 0,
          b > 0
      ]
  _ -> []

-- | A count of sample points, a part of a span by its first and last parameter, and the samples of
-- this part, each with its parameter.
type Station = ((Int, (Double, Double)), [(Double, Point)])

-- | Largest distance, in mm, of the given sample points from the nearest of the segments.
sampledDistance :: [(Double, Point)] -> NonEmpty Segment -> Double
sampledDistance samples segments = maximum (map (distanceTo segments . snd) samples)

-- | Trial of segments from the current position to parameter @v@. If the sample points of
-- @stations@ are within the tolerance, the deviation is measured at twice as many points and
-- between them.
measured :: FitState -> Double -> [Station] -> NonEmpty Segment -> Trial
measured w v stations segments
  | sampled > aim w = Trial v segments sampled
  | otherwise = Trial v segments (deviation (place (curve w)) (aim w) segments points)
  where
    sampled = sampledDistance (concatMap snd stations) segments
    points =
      (at w, fst (pose w)) :
      concat [interleaved ms (samplePoints (place (curve w)) 0 part) | (part, ms) <- stations]
    interleaved as bs = concat (zipWith (\a b -> [a, b]) as bs)

-- | Counts of sample points for the parts of spans between the current parameter and @v@, each with
-- its part. A part is given by its first and last parameter. A single part has 8 points. Of several
-- parts, each has 8 points times its share, rounded up, but at least 3. Its share is that of the
-- parameter range or that of the sum of all parts' chords, whichever is larger.
sampleCounts :: FitState -> Double -> [(Double, Double)] -> [(Int, (Double, Double))]
sampleCounts w v parts = case parts of
  [one] -> [(8, one)]
  _ ->
    [ (max 3 (ceiling (8 * max ((b - a) / (v - at w)) (chord / whole))), (a, b))
      | ((a, b), chord) <- zip parts chords
    ]
  where
    chords =
      [let Mm d = Vec.distance (place (curve w) a) (place (curve w) b) in d | (a, b) <- parts]
    whole = sum chords

-- | Sample points on part of a span, each with its parameter. Point @k@, from 1 to @n@, lies at the
-- fraction @(k − back)/n@ of the interval from the parameter @a@ to @b@. These even fractions are
-- then made uneven, so that the samples cannot all fall on the zeros of a periodic deviation.
samplePoints :: (Double -> Point) -> Double -> (Int, (Double, Double)) -> [(Double, Point)]
samplePoints point back (n, (a, b)) =
  [ let u =
          a + (b - a) * uneven ((fromIntegral k - back) / fromIntegral n)
     in (u, point u)
    | k <- [1 .. n]
  ]
  where
    uneven f = f + 0.2 * f * (1 - f)

-- | Distance, in mm, from a point to the nearest of some segments.
distanceTo :: NonEmpty Segment -> Point -> Double
distanceTo segments p = let Mm d = minimum (fmap (Distance.toPoint p) segments) in d

-- | Largest distance, in mm, between segments and a curve, for a comparison with the tolerance
-- @aim@ (mm). The curve is given by the function @point@ of the parameter and by the samples
-- @points@ in order. The distance is measured at the samples, near the joint of the segments, and
-- at every maximum between samples. The result is infinite if the feet of the samples on the
-- segments jump or reverse, because then some point of the segments may be far from the curve.
deviation :: (Double -> Point) -> Double -> NonEmpty Segment -> [(Double, Point)] -> Double
deviation point aim segments points
  | largest > aim || isCovered point aim segments feet = largest
  | otherwise = 1 / 0
  where
    feet = [(w, p, lengthAtFoot segments p) | (w, p) <- points]
    Mm half = Segment.length (NonEmpty.head segments)
    atJoint =
      [ let w = a + (b - a) * (half - s) / (t - s) in (w, distance w)
        | length segments > 1,
          ((a, _, s), (b, _, t)) <- zip feet (drop 1 feet),
          s < half,
          half < t
      ]
    known = sort ([(w, distanceTo segments p) | (w, p) <- points] <> atJoint)
    distance w = distanceTo segments (point w)
    largest =
      maximum
        ( map snd known
            <> zipWith3
              (\a b c -> snd (highest distance aim (6 :: Int) a b c))
              known
              (drop 1 known)
              (drop 2 known)
        )

-- | Parameter and value of a maximum of a distance near the middle one of three neighbouring
-- samples, by at most @remaining@ steps of parabolic interpolation. The middle sample is the result
-- if it is not the largest of the three or is below 0.3 of the tolerance @aim@ (mm). A sample is a
-- parameter and the distance there in mm.
highest ::
  (Double -> Double) ->
  Double ->
  Int ->
  (Double, Double) ->
  (Double, Double) ->
  (Double, Double) ->
  (Double, Double)
highest distance aim remaining one@(a, da) two@(b, db) three@(c, dc)
  | remaining <= 0
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
    dw = distance w
    new = (w, dw)
    again = highest distance aim (remaining - 1)
    max' x y = if snd x > snd y then x else y

-- | True if the feet of a curve's points move forwards along the segments without a jump. Movements
-- of a foot by less than a tenth of the tolerance @aim@ (mm) are ignored. Each entry of @feet@ has
-- a parameter, the point there, and the length along the segments up to its foot. If a foot moves
-- much farther than the point from one entry to the next, the interval of the parameter is
-- bisected.
isCovered :: (Double -> Point) -> Double -> NonEmpty Segment -> [(Double, Point, Double)] -> Bool
isCovered point aim segments feet = and (zipWith (isSteady (20 :: Int)) feet (drop 1 feet))
  where
    isSteady remaining one@(a, p, s) two@(b, q, t)
      | t < s - smallestStep = False
      | t - s <= 1.5 * far + smallestStep = True
      | far <= smallestStep || remaining <= 0 = False
      | otherwise =
        let middle =
              at ((a + b) / 2)
         in isSteady (remaining - 1) one middle && isSteady (remaining - 1) middle two
      where
        Mm far = Vec.distance p q
    at w = let p = point w in (w, p, lengthAtFoot segments p)
    smallestStep = 0.1 * aim

-- | Length, in mm, along the segments from their start to the foot of point @p@.
lengthAtFoot :: NonEmpty Segment -> Point -> Double
lengthAtFoot segments p = go 0 (NonEmpty.toList segments) (1 / 0, 0)
  where
    go before list best@(nearest, _) = case list of
      [] -> snd best
      s : more ->
        let Mm d = Distance.toPoint p s
            Mm long = Segment.length s
            found = before + long * Distance.nearestFraction p s
         in go (before + long) more (if d < nearest then (d, found) else best)
