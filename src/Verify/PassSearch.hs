{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Where on a tape a contour is milled: the strokes that follow it from its beginning to its end,
-- in the direction of the walk.
module Verify.PassSearch
  ( MillingJob (..),
    FoundPass (..),
    stretch,
    elementsOf,
    Edge (..),
    edgesOf,
    isCurved,
    mostLeft,
    reaches,
    closeTo,
    closeToEach,
    besideOf,
    leastDistance,
    find,
    measurable,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus, total)
import Base.Region (Region)
import Control.Applicative ((<|>))
import Data.List (foldl', sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Data.Vector.Unboxed (Vector, (!))
import Data.Vector.Unboxed qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Element, Milling)
import Part.Part qualified as Part
import Verify.Motion (CutterMotion (line, number))
import Verify.Motion qualified as Motion

-- | A contour to be found on the tape.
data MillingJob = MillingJob
  { milling :: Milling,
    statement :: Region,
    -- | the side of the walk on which the cutter stands; none when it runs on the contour
    side :: Maybe Carrier.Side,
    entry :: Point,
    exit :: Point,
    -- | from the contour to the cutter's centre
    reach :: Mm,
    -- | from the contour to the cutter's centre at most: round sharp corners, along elements with
    -- an allowance
    outreach :: Mm,
    -- | how far the chords may be off on one side or the other, and one pulse
    allowance :: Mm,
    -- | how far from its exit the cutter may seem to arrive there
    exitWithin :: Mm,
    -- | it is one of several cuts of a pass: none of them goes along all of the contour
    isOneOfSeveral :: Bool,
    edges :: BoxTree Edge
  }

-- | An element with its number from 0, its place along the contour and its length in mm, and as
-- bare numbers: what is asked of all elements is kept beside them.
data Edge = Edge
  { element :: Element,
    rank :: Int,
    before :: Double,
    long :: Double,
    -- | what is left on it besides what the pass leaves
    left :: Mm,
    -- | it goes on with the curve of the element before
    continues :: Bool,
    course :: Segment
  }

-- | The elements of a contour by their places.
edgesOf :: Milling -> BoxTree Edge
edgesOf job =
  BoxTree.indexOf
    (NonEmpty.length walked)
    (FastDistance.box . course)
    (go 0 0 (NonEmpty.toList walked))
  where
    walked = Part.elements (Part.contour job)
    -- Each is made at once: nothing waits for the length of those before it.
    go :: Int -> Double -> [Element] -> [Edge]
    go rank before elements = case elements of
      [] -> []
      element : more ->
        let Mm long = Segment.length (Part.segment element)
            behind = before + long
            edge =
              Edge
                { element,
                  rank,
                  before,
                  long,
                  left = Part.allowance (Part.finish element),
                  continues = Part.continues element,
                  course = Part.segment element
                }
         in edge `seq` behind `seq` (edge : go (rank + 1) behind more)

-- | The strokes of one contour.
data FoundPass
  = -- | the stroke that reaches the beginning, those along the contour
    Followed [CutterMotion] [CutterMotion]
  | -- arrival at the end

    -- | the beginning is reached, but the contour is not followed to its end: as above, as far as
    -- the next
    Lost [CutterMotion] [CutterMotion]
  | NeverBegun

-- | All of them.
stretch :: FoundPass -> [CutterMotion]
stretch found = case found of
  Followed arrival along -> arrival <> along
  Lost arrival along -> arrival <> along
  NeverBegun -> []

elementsOf :: MillingJob -> [Element]
elementsOf = NonEmpty.toList . Part.elements . Part.contour . milling

-- | Find a contour among strokes that begin at a point of its height, if they do. Of several
-- arrivals at its beginning the first counts from which it is followed. One of several cuts only
-- has to arrive at its own end: where they meet to a hair, they may seem to follow the contour one
-- after the other.
find :: MillingJob -> Maybe Point -> [CutterMotion] -> FoundPass
find job at traces =
  case if fits blurs && not (isOneOfSeveral job) then mapMaybe followed starts else [] of
    found : _ -> found
    [] -> case filter (staysBeside . snd) starts <> starts of
      (arrival, rest) : _ -> Lost arrival (untilExit job rest)
      [] -> NeverBegun
  where
    blurs = blursOf job
    ruler = measure job blurs
    followed (arrival, rest) = (\n -> Followed arrival (take n rest)) <$> follows job ruler rest
    starts = begun Nothing traces
    -- The cutter may leave from the beginning of a contour, which was the end of another one, and
    -- come back.
    staysBeside rest =
      let along =
            untilExit job rest
       in not (null along)
            && and
              ( zipWith
                  (\t near -> all (\k -> beside job near (Segment.at k (line t))) (final t))
                  along
                  (closeToEach job along)
              )
    -- A straight stroke may cut across.
    final t = case line t of
      Straight _ _ -> [1]
      Arc {} -> Motion.places t
    -- The strokes that set out from the beginning, with the one that arrived there: none when the
    -- cutter stood there already, or came from another height. A straight one that ends nearer to
    -- the beginning is still on its way there: the end of a way in may be braked.
    begun before ts = case ts of
      [] ->
        [([t], []) | Just t <- [before], endsNear job (entry job) t]
          <> [([], []) | Nothing <- [before], Just p <- [at], isNear job (entry job) p]
      t : rest ->
        [ ([b | Just b <- [before], endsNear job (entry job) b], ts)
          | isNear job (entry job) (Segment.start (line t)),
            not (arrives t)
        ]
          <> begun (Just t) rest
    arrives t = case line t of
      Straight a b -> Vec.distance b (entry job) < Vec.distance a (entry job)
      Arc {} -> False

-- | Whether the cutter with its centre at a point touches the contour at all, of which all elements
-- are given that it may touch there.
beside :: MillingJob -> [Edge] -> Point -> Bool
beside job near p =
  any
    ( \e ->
        FastDistance.mayLieWithin most (long e) (course e) (Vec.x p) (Vec.y p)
          && FastDistance.distance (course e) (Vec.x p) (Vec.y p) <= most
    )
    near
  where
    Mm most = reaches job

isNear :: MillingJob -> Point -> Point -> Bool
isNear job p q = Vec.distance p q <= allowance job

endsNear :: MillingJob -> Point -> CutterMotion -> Bool
endsNear job p = isNear job p . Segment.end . line

-- | Whether the cutter is at its exit, and whether a stroke ends there.
isOut :: MillingJob -> Point -> Bool
isOut job p = Vec.distance (exit job) p <= exitWithin job

endsOut :: MillingJob -> CutterMotion -> Bool
endsOut job = isOut job . Segment.end . line

-- | Whether a stroke goes round something, however small it is: a whole circle.
isWhole :: CutterMotion -> Bool
isWhole t = case line t of
  Straight _ _ -> False
  Arc {start, end} -> start == end

-- | The first of some strokes, as far as they follow one another on the tape: of those at one
-- height others may have been left out between them.
unbroken :: [CutterMotion] -> [CutterMotion]
unbroken traces = case traces of
  t : rest@(next : _) | number next <= number t + 1 -> t : unbroken rest
  t : _ -> [t]
  [] -> []

-- | The strokes up to the next arrival at the end.
untilExit :: MillingJob -> [CutterMotion] -> [CutterMotion]
untilExit job traces = leaving <> along <> takeWhile (endsOut job) (unbroken back)
  where
    (leaving, away) =
      span
        ( \t ->
            endsNear job (entry job) t
              && not (isWhole t)
              && isNear job (entry job) (Segment.at 0.5 (line t))
        )
        traces
    (along, back) = break (endsOut job) away

-- | A contour as a ruler: its length, and how far back a step of the cutter may seem to go by
-- rounding alone.
data Ruler = Ruler {whole :: Double, slack :: Double, closed :: Bool}

-- | Whether the place of the cutter's centre tells where it touches: not in a hollow in which the
-- centre hardly moves while the cutter touches all of it. The arcs of a curve count together.
measurable :: MillingJob -> Bool
measurable = fits . blursOf

-- | How far back a step along a contour may seem to go by rounding alone, in mm; whether that is
-- less than each run of it that has an arc.
data Blurs = Blurs {furthestBack :: Double, fits :: Bool}

blursOf :: MillingJob -> Blurs
blursOf job
  | isCurved (edges job) = foldl' with (Blurs 0 True) (runsOf job)
  | otherwise = BoxTree.foldl' alone (Blurs 0 True) (edges job)
  where
    with (Blurs most allFit) run =
      let b@(Mm far) =
            blurAlong job run
       in Blurs
            (max most far)
            ( allFit
                && (not (any isArc run) || b < total (map Segment.length (NonEmpty.toList run)))
            )
    -- Each element is a run of its own.
    alone (Blurs most allFit) e
      | FastDistance.isLine (course e) = Blurs (max most onLine) allFit
      | otherwise =
        let b = blur job (Part.segment (element e)) in Blurs (max most b) (allFit && b < long e)
    onLine = blur job (Straight (entry job) (entry job))
    isArc s = case s of
      Arc {} -> True
      Straight _ _ -> False

-- | Whether an element goes on with the curve of another.
isCurved :: BoxTree Edge -> Bool
isCurved = BoxTree.foldl' (\is e -> is || continues e) False

-- | The most that is left on one of some elements besides what a pass leaves.
mostLeft :: BoxTree Edge -> Mm
mostLeft = BoxTree.foldl' (\most e -> max most (left e)) (Mm (-1 / 0))

-- | The elements, those together that go on with one curve; also over the beginning of a closed
-- contour.
runsOf :: MillingJob -> [NonEmpty Segment]
runsOf job = case (elementsOf job, runs (elementsOf job)) of
  (e : _, first : more)
    | closedOf job,
      Part.continues e,
      final : between <- reverse more ->
      reverse ((final <> first) : between)
  (_, found) -> found
  where
    runs es = case es of
      [] -> []
      -- Most lines are alone.
      e : rest@(next : _) | not (Part.continues next) -> (Part.segment e :| []) : runs rest
      e : rest ->
        let (along, others) =
              span Part.continues rest
         in (Part.segment e :| map Part.segment along) : runs others

-- | How far along a run the place of touch may seem to go back by rounding alone: along a curve the
-- most of it that is touched while the centre moves by as much as it does there on one arc.
blurAlong :: MillingJob -> NonEmpty Segment -> Mm
blurAlong job run = case run of
  s :| [] -> Mm (blur job s)
  _ -> Mm (max (longest id) (longest Vector.reverse))
  where
    lengths = Vector.fromList [l | s <- NonEmpty.toList run, let Mm l = Segment.length s]
    moved =
      Vector.zipWith
        (\l b -> l * 2 * a / b)
        lengths
        (Vector.fromList (map (blur job) (NonEmpty.toList run)))
    Mm a = allowance job
    longest change =
      widest (2 * a) (Vector.scanl' (+) 0 (change moved)) (Vector.scanl' (+) 0 (change lengths))

-- | The largest growth of the second of two numbers along a walk while the first one, which rises
-- too, grows by so much from any of the places; between the places both grow evenly.
widest :: Double -> Vector Double -> Vector Double -> Double
widest window firsts seconds = go 0 0 0
  where
    count = Vector.length firsts
    go :: Double -> Int -> Int -> Double
    go most from step
      | from >= count = most
      | step + 1 < count && firsts ! (step + 1) <= firsts ! from + window = go most from (step + 1)
      | otherwise = go (max most (grown from step - seconds ! from)) (from + 1) step
    grown from step
      | step + 1 >= count = Vector.last seconds
      | otherwise =
        seconds ! step
          + (seconds ! (step + 1) - seconds ! step)
            * (firsts ! from + window - firsts ! step) / (firsts ! (step + 1) - firsts ! step)

-- | How far along an element the place of touch may seem to go back by rounding alone.
blur :: MillingJob -> Segment -> Double
blur job s = case s of
  Arc {start, centre, sweep = Rad turned}
    | inside turned ->
      let Mm old =
            Segment.radius centre start
       in 4 * a * old / max 1e-9 (abs (old - r))
  _ -> 2 * a
  where
    Mm a = allowance job
    Mm r = reach job
    inside turned = case side job of
      Just Carrier.LeftOf -> turned > 0
      Just Carrier.RightOf -> turned < 0
      Nothing -> False

closedOf :: MillingJob -> Bool
closedOf job = Part.ends (Part.contour (milling job)) == Part.Closed

measure :: MillingJob -> Blurs -> Ruler
measure job blurs =
  Ruler
    { whole = BoxTree.foldl' (\_ e -> before e + long e) 0 (edges job),
      slack = furthestBack blurs,
      closed = closedOf job
    }

-- | How many of the strokes follow the contour to its end; none when they stray from it, turn back
-- on it, or end before.
follows :: MillingJob -> Ruler -> [CutterMotion] -> Maybe Int
follows job ruler strokes = go 0 0 0 (entry job) [] strokes (closeToEach job strokes)
  where
    -- Given the last stroke, if there is one.
    go ::
      Int ->
      Double ->
      Double ->
      Point ->
      [CutterMotion] ->
      [CutterMotion] ->
      [[Edge]] ->
      Maybe Int
    go !count !gone !mark at final traces close
      | isOut job at && gone + furthest places >= whole ruler - slack ruler =
        -- Where something between is not touched the contour only comes by its own end, if it goes
        -- on.
        if areNeighbours places then ended else onwards <|> ended
      | otherwise = onwards
      where
        places = ahead mark at
        ended =
          Just
            ( count
                + length
                  ( takeWhile
                      (\t -> endsOut job t && not (isWhole t))
                      (drop (length final) (unbroken (final <> traces)))
                  )
            )
        onwards = case (traces, close) of
          (t : rest, near : others) ->
            along (count + 1) t (Motion.pieces t) 1 near gone mark rest others
          _ -> Nothing
    -- From place to place of a stroke.
    along ::
      Int ->
      CutterMotion ->
      Int ->
      Int ->
      [Edge] ->
      Double ->
      Double ->
      [CutterMotion] ->
      [[Edge]] ->
      Maybe Int
    along !count t !n !k near !gone !mark rest others
      | k > n = go count gone mark (Segment.end (line t)) [t] rest others
      | isInfinite delta = Nothing
      | otherwise = along count t n (k + 1) near (gone + delta) (mark + delta) rest others
      where
        delta = step near mark (Segment.at (fromIntegral k / fromIntegral n) (line t))
    -- How far on the places are that the cutter touches, the nearest first, and the numbers of
    -- their elements.
    ahead mark p =
      sortOn
        fst
        [ (d, n)
          | (n, s) <- touched job (around job p) p,
            let d = difference mark s,
            d >= negate (slack ruler)
        ]
    furthest places = maximum (0 : map fst places)
    areNeighbours places =
      and
        ( zipWith
            (\(_, m) (_, n) -> abs (n - m) <= 1 || abs (n - m) == BoxTree.size (edges job) - 1)
            places
            (drop 1 places)
        )
    -- Of several places that the cutter touches at once the one that it reaches by the smallest
    -- step.
    step near mark p = foldTouched job near p smaller (1 / 0)
      where
        smaller least _ s =
          let d =
                difference mark s
           in if d >= negate (slack ruler) && abs d < abs least then d else least
    difference mark s
      | closed ruler =
        let d =
              s - mark - whole ruler * fromIntegral (floor ((s - mark) / whole ruler + 0.5) :: Int)
         in d
      | otherwise = s - mark

-- | How far the centre of a cutter that touches an element may be from it.
reaches :: MillingJob -> Mm
reaches job = plus (outreach job) (allowance job)

-- | The elements around a point that a cutter with its centre there may touch.
around :: MillingJob -> Point -> [Edge]
around job p =
  BoxTree.within (BoundingBox.inflate (reaches job) (BoundingBox.ofPoints p [])) (edges job)

-- | The elements that a cutter may touch as its centre goes along a stroke.
closeTo :: MillingJob -> CutterMotion -> [Edge]
closeTo job t = filter (isClose job t) (besideOf job t)

-- | The same for each of some strokes, which lie beside one another as a rule.
closeToEach :: MillingJob -> [CutterMotion] -> [[Edge]]
closeToEach job =
  BoxTree.each (BoundingBox.inflate (reaches job) . Motion.box) (isClose job) (edges job)

-- | Whether a cutter whose centre goes along a stroke may touch an element.
isClose :: MillingJob -> CutterMotion -> Edge -> Bool
isClose job t = \e -> FastDistance.mayComeWithin far (long e) (course e) (line t)
  where
    far = let Mm r = reaches job in r + FastDistance.uneven (line t)
{-# INLINE isClose #-}

-- | The same, and some around it.
besideOf :: MillingJob -> CutterMotion -> [Edge]
besideOf job t = BoxTree.within (BoundingBox.inflate (reaches job) (Motion.box t)) (edges job)

-- | The places along the contour that the cutter with its centre at a point touches, among elements
-- with all that lie within its reach, with the numbers of the elements. What it touches is nearest
-- to it; beside an arc the nearer of its ends counts.
touched :: MillingJob -> [Edge] -> Point -> [(Int, Double)]
touched job near p = reverse (foldTouched job near p (\found n s -> (n, s) : found) [])

-- | The same, one after the other.
foldTouched :: MillingJob -> [Edge] -> Point -> (b -> Int -> Double -> b) -> b -> b
foldTouched job near p with = go near
  where
    go es b = case es of
      [] -> b
      e : more
        | far <- farthest e,
          FastDistance.mayLieWithin far (long e) (course e) x y,
          FastDistance.distance (course e) x y <= far ->
          let b' =
                with b (rank e) (before e + FastDistance.footOn (course e) x y * long e)
           in b' `seq` go more b'
        | otherwise -> go more b
    !x = Vec.x p
    !y = Vec.y p
    !(Mm most) = reaches job
    !(Mm a) = allowance job
    -- An element with an allowance is touched from further away.
    !least = leastBeyond left most near x y
    farthest e = let Mm l = left e in min most (least + l + 2 * a)
{-# INLINE foldTouched #-}

-- | How far the nearest of some elements is from a point, if it is no further than so much; else
-- that.
leastDistance :: Double -> [Edge] -> Double -> Double -> Double
leastDistance = leastBeyond (const (Mm 0))

-- | The same of how much further it is than what is left on it.
leastBeyond :: (Edge -> Mm) -> Double -> [Edge] -> Double -> Double -> Double
leastBeyond leaves most near !x !y = go most near
  where
    go !d es = case es of
      [] -> d
      e : more
        | Mm l <- leaves e,
          far <- min most (d + l),
          FastDistance.mayLieWithin far (long e) (course e) x y ->
          go (min d (FastDistance.distance (course e) x y - l)) more
        | otherwise -> go d more
{-# INLINE leastBeyond #-}
