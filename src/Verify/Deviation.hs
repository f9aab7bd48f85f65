{-# OPTIONS_GHC -O2 #-}

-- | How far the strokes of one pass are off from its contour: the three comparisons of the proof.
module Verify.Deviation
  ( MillingPass (..),
    examine,
    Spared (..),
    gougeOf,
    mayExceed,
    isAt,
    atLevel,
    allowedOff,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus)
import Control.Monad (foldM, when)
import Control.Monad.ST (runST)
import Control.Motion qualified as Control
import Data.Containers.ListUtils (nubOrd)
import Data.IntSet qualified as IntSet
import Data.List (foldl', minimumBy, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isNothing, listToMaybe, mapMaybe, maybeToList)
import Data.Ord (comparing)
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (Z), Machine)
import Machine.Machine qualified as Machine
import Offset.Tolerance qualified as Tolerance
import Part.Part (Element, Milling)
import Part.Part qualified as Part
import Verify.Coverage qualified as Coverage
import Verify.Motion
  ( CutterMotion (number, part),
    box,
    bridges,
    courses,
    fromHeight,
    heights,
    isUpright,
    line,
    toHeight,
    ways,
  )
import Verify.Motion qualified as Motion
import Verify.PassSearch (Edge (course, element, left, long, rank), MillingJob (..))
import Verify.PassSearch qualified as PassSearch
import Verify.PointedTool qualified as PointedTool
import Verify.Proof (ContourProof (..), Finding (..), Witness (Witness, amount, frame, place))
import Verify.Proof qualified
import Verify.Reachability qualified as Reachability
import Prelude hiding (lines)

-- | A pass and what was found of it.
data MillingPass = MillingPass
  { job :: MillingJob,
    passNumber :: Int,
    level :: Mm,
    found :: PassSearch.FoundPass
  }

-- | How one pass came out: the strokes of the tape, as far as they come near it, are compared with
-- its contour in its first pass, its own strokes in each.
examine ::
  Machine ->
  Bool ->
  (CutterMotion -> Mm) ->
  Bool ->
  [CutterMotion] ->
  (BoundingBox.BoundingBox -> [CutterMotion]) ->
  MillingPass ->
  (ContourProof, [Finding])
examine machine flat toolOf isFirst traces nearby MillingPass {job, level, found} =
  (passage, if null findings then order else findings)
  where
    contourBox =
      foldr1
        BoundingBox.union
        (fmap (BoundingBox.ofSegment . Part.segment) (Part.elements (Part.contour (milling job))))
    pulse = Machine.pulse machine
    (inside, outside) = allowedOff (PassSearch.isCurved (edges job)) (milling job)
    mayGouge = plus (if upon then allowance' else inside) pulse
    mayLeave = plus (if upon then allowance' else outside) pulse
    allowance' = max inside outside
    upon = isNothing (side job)
    (milled, within) = case found of
      PassSearch.Followed _ along -> (if mayStay then atHeight else PassSearch.stretch found, along)
      PassSearch.Lost _ along -> (atHeight, along)
      PassSearch.NeverBegun -> (atHeight, [])
    atHeight = if flat then traces else filter (isAt machine level) traces
    ownNumbers = IntSet.fromDistinctAscList (ascending (map number within))
    -- Its own strokes stay away from the contour by what they leave; all others have to spare the
    -- contour.
    looked =
      if upon
        then []
        else
          filter
            belowTop
            (if isFirst then nearby (BoundingBox.inflate (outreach job) contourBox) else within)
    spared t
      | IntSet.member (number t) ownNumbers =
        Spared
          { upTo = furthest t,
            most = plus (reach job) mostLeft,
            required = \e p -> plus (reach job) (leftAt pulse (edges job) e p)
          }
      | otherwise = Spared {upTo = furthest t, most = toolOf t, required = \_ _ -> toolOf t}
    furthest t = max (outreach job) (toolOf t)
    mostLeft = max (Mm 0) (PassSearch.mostLeft (edges job))
    gouges = mapMaybe (\t -> gougeOf (spared t) (edges job) t) looked <> pierced
    -- No distance tells when a tool without a radius crosses the contour; nor, then, that it leaves
    -- nothing.
    pierced =
      [ w
        | Part.radius (milling job) <= Mm 0,
          Just keeps <- [side job],
          t <- looked,
          Just w <- [PointedTool.gougeOf keeps (Part.contour (milling job)) (edges job) mayGouge t]
      ]
    (Seen {cut, strays, wrongly}, covered) = lookAlong job spared mayLeave looked within
    deepest = foldl' deeper cut pierced
    -- Where material may stay all strokes count, and they are the same for all cuts of a pass.
    missed =
      if mayStay && not isFirst
        then []
        else
          concat
            [ uncut
                job {reach = plus (reach job) more, allowance = mayLeave}
                covered
                milledIndex
                (if mayStay then concatMap (touchable (plus (reach job) more)) es else es)
              | (more, es) <- byAllowance (BoxTree.toList (edges job))
            ]
    -- What the cutter cannot touch may stay, where that is allowed.
    touchable distance e = case (Part.rest (milling job), side job) of
      (Part.Allowed, Just keeps) ->
        [ e {element = (element e) {Part.segment = s}, course = s}
          | s <- Reachability.parts keeps distance kept (Part.segment (element e))
        ]
      _ -> [e]
    -- The distances that the cutter's centre keeps from elements.
    kept =
      [ ( plus (reach job) more,
          BoxTree.index BoundingBox.ofSegment (map (Part.segment . element) es)
        )
        | (more, es) <- byAllowance (BoxTree.toList (edges job))
      ]
    mayStay = Part.rest (milling job) == Part.Allowed
    milledIndex = BoxTree.indexOf (length milled) box milled
    strayed = reverse strays
    most' = listToMaybe (sortOn (negated . amount) (missed <> strayed))
    passage =
      ContourProof
        { contour = Part.contourName (Part.contour (milling job)),
          gouge = deepest,
          excess = most',
          allowedGouge = mayGouge,
          allowedExcess = mayLeave
        }
    tooDeep w = amount w > mayGouge
    tooMuch w = amount w > mayLeave
    findings =
      [ Gouge first worst mayGouge
        | Just worst <- [deepest],
          tooDeep worst,
          first : _ <- [filter tooDeep gouges]
      ]
        <> [ Excess first (fromMaybe first most') mayLeave
             | not (any tooDeep pierced),
               first : _ <- [filter tooMuch strayed <> sortOn frame (filter tooMuch missed)]
           ]
        <> maybeToList wrongly
    -- Nothing else is wrong with the contour but the order in which it is walked.
    order = case found of
      PassSearch.Followed {} -> []
      -- A way that leaves stretches out does not go along the contour in one go.
      PassSearch.Lost {} -> [NotFollowed (statement job) | PassSearch.measurable job, not mayStay]
      PassSearch.NeverBegun -> [NeverBegun (statement job)]
    negated (Mm x) = -x
    -- Above the top of the part nothing is cut.
    belowTop t = fromHeight t <= Mm 0 || toHeight t <= Mm 0

-- | Numbers that do not fall, each once.
ascending :: [Int] -> [Int]
ascending ns = case ns of
  a : b : more | a == b -> ascending (b : more)
  a : more -> a : ascending more
  [] -> []

-- | Elements by what is left on them besides what the pass leaves.
byAllowance :: [Edge] -> [(Mm, [Edge])]
byAllowance es = case es of
  e : others | all ((== left e) . left) others -> [(left e, es)]
  _ -> [(more, [e | e <- es, left e == more]) | more <- nubOrd (map left es)]

-- | What a stroke has to spare: elements up to a distance, at most and at a point beside one of
-- them.
data Spared = Spared {upTo :: Mm, most :: Mm, required :: Element -> Point -> Mm}

-- | What is seen along the strokes: the deepest cut, where they stray with the last one first, the
-- first one on the wrong side; the courses of the stroke that was last seen to follow the contour.
data Seen = Seen
  { cut :: Maybe Witness,
    strays :: [Witness],
    wrongly :: Maybe Finding,
    behind :: [Segment]
  }

-- | Look along the strokes that have to spare a contour and those that have to follow it, both in
-- the order of the tape. Each asks once for the elements around it. With what is seen comes for
-- each element, by its number, how far any point of it is at most from one of the strokes that
-- follow the contour and lie beside it on the right side, or from one of two that do so one behind
-- the other, as far as that is easily told.
lookAlong ::
  MillingJob ->
  (CutterMotion -> Spared) ->
  Mm ->
  [CutterMotion] ->
  [CutterMotion] ->
  (Seen, PrimArray Double)
lookAlong job spared mayLeave looked0 within0 = runST $ do
  ranges <- PrimArray.newPrimArray (BoxTree.size (edges job))
  PrimArray.setPrimArray ranges 0 (PrimArray.sizeofMutablePrimArray ranges) (1 / 0)
  let go seen looked within = case (looked, within) of
        (v : vs, w : ws) -> case inOrder (trace v) w of
          EQ -> both seen v >>= \seen' -> go seen' vs ws
          LT -> go (spares v seen) vs within
          GT -> follows seen (view (PassSearch.closeTo job w) w) >>= \seen' -> go seen' looked ws
        (v : vs, []) -> go (spares v seen) vs []
        ([], ws) -> foldM follows seen (views ws)
      both seen v = follows (spares v seen) v
      follows seen v = do
        mapM_ (noted (behind seen) v) (close v)
        pure $! followed v seen
      noted before View {trace = t, lines = ls} e = do
        known <- PrimArray.readPrimArray ranges (rank e)
        -- Nearer than it has to be tells no more.
        when (known > enough) $ do
          let far = furthestFrom known before (FastDistance.begin (line t)) ls e
          when
            (far < known && all (isSurelyOn job (course e)) ls)
            (PrimArray.writePrimArray ranges (rank e) far)
  seen <- go (Seen Nothing [] Nothing []) (views looked0) within0
  frozen <- PrimArray.unsafeFreezePrimArray ranges
  pure (seen, frozen)
  where
    views ts = zipWith view (PassSearch.closeToEach job ts) ts
    view es t = View {trace = t, close = es, lines = courses t}
    inOrder a b = compare (number a) (number b) <> compare (part a) (part b)
    Mm reaches = PassSearch.reaches job
    enough = let Mm r = reach job in r - 2 * FastDistance.unsure
    -- An element may lie beside a stroke and the one before it; that is asked for where none is
    -- known to be beside all of it.
    furthestFrom known before (x, y) ls e
      | far < 1 / 0
          || known <= reaches
          || null before
          || not (FastDistance.mayLieWithin reaches (long e) (course e) x y) =
        far
      | otherwise = case FastDistance.divided x y (course e) of
        Just (p, q)
          | all (isSurelyOn job (course e)) before ->
            max
              (FastDistance.furthestFrom reaches p before)
              (FastDistance.furthestFrom reaches q ls)
        _ -> far
      where
        far = FastDistance.furthestFrom reaches (course e) ls
    spares v@View {trace = t} seen = seen {cut = cutBy (spared t) v (cut seen)}
    cutBy s View {trace = t, close, lines} best
      | mayExceed
          s
          best
          t
          lines
          ( if upTo s <= Mm reaches
              then close
              else BoxTree.within (BoundingBox.inflate (upTo s) (box t)) (edges job)
          ) =
        maybe best (deeper best) (gougeOf s (edges job) t)
      | otherwise = best
    followed v@View {trace = t, lines} seen
      | isUpright t = seen {behind = []}
      | otherwise =
        seen
          { behind = lines,
            strays =
              maybe
                (strays seen)
                (: strays seen)
                (strayOf job {reach = outreach job, allowance = mayLeave} v),
            wrongly = case wrongly seen of
              Nothing -> wrongSide job v
              found -> found
          }

-- | A stroke with the elements that it may touch and its courses.
data View = View {trace :: CutterMotion, close :: [Edge], lines :: [Segment]}

-- | The deeper one of two cuts, the first one if they are equally deep.
deeper :: Maybe Witness -> Witness -> Maybe Witness
deeper best w = case best of
  Just b | amount b >= amount w -> best
  _ -> Just w

-- | Whether a stroke of some courses may cut deeper than the deepest so far into elements around
-- it, by what can be told without comparing exactly. The courses of an arc differ by as much as its
-- radii.
mayExceed :: Spared -> Maybe Witness -> CutterMotion -> [Segment] -> [Edge] -> Bool
mayExceed spared best t lines' =
  any
    ( \e ->
        FastDistance.apartAtLeast (line t) (course e) < least + off
          && FastDistance.apart (line t) (course e) < least + off
          && (off <= 0 || any (\c -> FastDistance.apart c (course e) < least) (lines' <> bridges t))
    )
  where
    off = FastDistance.uneven (line t)
    least =
      let Mm d =
            most spared
       in d - maybe 0 (\w -> let Mm a = amount w in a) best + FastDistance.unsure

-- | How deep a stroke cuts into the contour, if it does: how much nearer it comes to an element
-- than it may.
gougeOf :: Spared -> BoxTree Edge -> CutterMotion -> Maybe Witness
gougeOf Spared {upTo, required} es t
  | null near = Nothing
  | otherwise = Just (minimumBy (comparing (\w -> let Mm a = amount w in -a)) near)
  where
    near =
      [ Witness
          { amount = minus (required e p) d,
            frame = number t,
            Verify.Proof.element = Part.origin e,
            place = p
          }
        | way <- NonEmpty.toList (ways t) <> Control.across (ways t),
          e <-
            map
              element
              ( BoxTree.select
                  ( \b ->
                      BoundingBox.meets (around way) b
                        && BoundingBox.atLeast (`Distance.toPoint` way) b <= upTo
                  )
                  es
              ),
          let Distance.ClosestPoint d p = Distance.segments way (Part.segment e),
          d < required e p
      ]
    around way = BoundingBox.inflate upTo (BoundingBox.ofSegment way)

-- | What is left on an element where it is nearest to a point; where elements join, to a pulse, no
-- more than on any of them, and nothing of its own where another is nearer: a step from what is
-- left on one to what is left on the next ends on whole pulses.
leftAt :: Mm -> BoxTree Edge -> Element -> Point -> Mm
leftAt pulse es e p
  | own <= Mm 0 = own
  | any (\other -> plus (Distance.toPoint p (Part.segment other)) Tolerance.resolution < d) joined =
    Mm 0
  | otherwise = minimum (own : map left' joined)
  where
    own = left' e
    left' = Part.allowance . Part.finish
    (d, foot) = Distance.nearest p (Part.segment e)
    joined =
      [ other
        | other <-
            map
              element
              (BoxTree.within (BoundingBox.inflate pulse (BoundingBox.ofPoints foot [])) es),
          Distance.toPoint foot (Part.segment other) <= pulse
      ]

-- | For each element the most that is left standing on it, as far as it is more than on those
-- before or more than is allowed. By its number it is known how far its furthest point is at most
-- from one of the strokes.
uncut :: MillingJob -> PrimArray Double -> BoxTree CutterMotion -> [Edge] -> [Witness]
uncut job known index = go (Mm 0)
  where
    go least es = case es of
      [] -> []
      e : rest
        | surely least e -> go least rest
        | otherwise ->
          case Coverage.furthest
            (others (element e))
            (Just (range e))
            least
            (Part.segment (element e)) of
            Nothing -> go least rest
            Just Coverage.Beyond {Coverage.most = left', Coverage.place = p, Coverage.around} ->
              let nearest = minimumBy (comparing (Coverage.distanceTo p . ways)) around
                  next = if left' > allowance job then least else left'
               in Witness
                    { amount = left',
                      frame = number nearest,
                      Verify.Proof.element = Part.origin (element e),
                      place = p
                    } :
                  go next rest
    surely least e =
      let far@(Mm d) = plus (reach job) least
       in PrimArray.indexPrimArray known (rank e) <= d - 2 * FastDistance.unsure
            || FastDistance.isCovered
              d
              snd
              (counts e)
              ( map
                  withCourses
                  (BoxTree.within (BoundingBox.inflate far (FastDistance.box (course e))) index)
              )
              (course e)
    withCourses t = (t, courses t)
    -- No other stroke is nearer than what is looked at.
    range e =
      let far@(Mm d) = plus (reach job) (allowance job)
          near =
            filter
              (counts e)
              ( map
                  withCourses
                  ( BoxTree.within
                      (BoundingBox.inflate far (BoundingBox.ofSegment (Part.segment (element e))))
                      index
                  )
              )
          (low, high) = FastDistance.range (map snd near) (course e)
       in Coverage.DistanceBounds {Coverage.atLeast = Mm (min d low), Coverage.atMost = Mm high}
    counts e (t, ts) =
      all (isSurelyOn job (course e)) ts
        || all (onLeadingSide job (Part.segment (element e))) (ways t)
    others e =
      Coverage.Others
        { Coverage.index,
          Coverage.lines = ways,
          Coverage.counts = all (onLeadingSide job (Part.segment e)) . ways,
          Coverage.reach = reach job,
          Coverage.allowance = allowance job
        }

-- | Whether all of a course surely lies on the side of an element on which the cutter has to stand.
isSurelyOn :: MillingJob -> Segment -> Segment -> Bool
isSurelyOn job e c = case side job of
  Nothing -> True
  Just Carrier.LeftOf -> FastDistance.isLeftOf c e
  Just Carrier.RightOf -> FastDistance.isRightOf c e

-- | Whether a stroke runs on the side of an element on which the cutter has to stand: another one
-- would reach the element through the part. One that is on the element itself, to the allowance,
-- does not.
onLeadingSide :: MillingJob -> Segment -> Segment -> Bool
onLeadingSide job element t = case side job of
  Nothing -> True
  Just keeps -> leftOf == (keeps == Carrier.LeftOf) || d <= allowance job
  where
    -- Where the stroke is nearest: an arc's inside and outside are not those of the whole stroke.
    Distance.ClosestPoint d p = Distance.segments t element
    leftOf = case element of
      Straight a b -> Vec.cross (Vec.to a b) (Vec.to a p) > 0
      Arc {start, centre, sweep = Rad s} ->
        (Vec.distance centre p < Segment.radius centre start) == (s > 0)

-- | How far a stroke strays from the contour, if it is more than is allowed; the elements around
-- it.
strayOf :: MillingJob -> View -> Maybe Witness
strayOf job View {trace = t, close, lines}
  | all
      ( \l ->
          any (FastDistance.isWithin (d - 2 * FastDistance.unsure) l . course) close
            || FastDistance.isAccompanied d (map course close) l
            || FastDistance.isCovered d (pure . course) (const True) close l
      )
      lines =
    Nothing
  | otherwise = case mapMaybe beyond (NonEmpty.toList (ways t)) of
    [] -> Nothing
    ws -> Just (minimumBy (comparing (\w -> let Mm a = amount w in -a)) ws)
  where
    Mm d = plus (reach job) (allowance job)
    beyond way = case Coverage.furthest others Nothing (allowance job) way of
      Nothing -> Nothing
      Just Coverage.Beyond {Coverage.most = strays, Coverage.place = p, Coverage.around} ->
        let e = element (minimumBy (comparing (Distance.toPoint p . Part.segment . element)) around)
         in Just
              Witness
                { amount = strays,
                  frame = number t,
                  Verify.Proof.element = Part.origin e,
                  place = p
                }
    others =
      Coverage.Others
        { Coverage.index = edges job,
          Coverage.lines = (:| []) . Part.segment . element,
          Coverage.counts = const True,
          Coverage.reach = reach job,
          Coverage.allowance = allowance job
        }

-- | A stroke that lies beside one of the elements around it on the wrong side: a straight one by
-- its middle, an arc by places close to one another.
wrongSide :: MillingJob -> View -> Maybe Finding
wrongSide job View {trace = t, close} = case side job of
  Nothing -> Nothing
  Just keeps ->
    listToMaybe (mapMaybe (\p -> if mayBe keeps p then beside keeps p else Nothing) looked)
  where
    looked =
      map
        (\k -> Segment.at k (line t))
        ( if FastDistance.isLine (line t)
            then [0.5]
            else
              let ks =
                    Motion.places t
               in zipWith (\a b -> (a + b) / 2) (0 : ks) ks
        )
    -- Of those that are nearest, to a hair, one may have the place on its wrong side.
    mayBe keeps p =
      least > a - FastDistance.unsure
        && any
          ( \e ->
              FastDistance.mayLieWithin (least + FastDistance.unsure) (long e) (course e) x y
                && FastDistance.distance (course e) x y <= least + FastDistance.unsure
                && FastDistance.spansAbout (course e) x y
                && wrong e
          )
          near
      where
        (x, y) = (Vec.x p, Vec.y p)
        Mm a = allowance job
        Mm far = PassSearch.reaches job
        leastOf es = PassSearch.leastDistance (1 / 0) es x y
        -- Where one is close, no other one is nearer.
        (near, least) =
          let l =
                leastOf close
           in if l + FastDistance.unsure <= far then (close, l) else (around, leastOf around)
        wrong e =
          not
            ( case keeps of
                Carrier.LeftOf ->
                  FastDistance.isLeftOf (FastDistance.spot x y) (course e)
                Carrier.RightOf -> FastDistance.isRightOf (FastDistance.spot x y) (course e)
            )
    around = PassSearch.besideOf job t
    beside keeps p =
      case closestOf [(Distance.toPoint p s, e) | e <- around, let s = Part.segment (element e)] of
        Just (d, nearest)
          | d > allowance job
              && Segment.spans (Part.segment nearest) p
              && sideOf p (Part.segment nearest) /= keeps ->
            Just (WrongSide (number t) (Part.origin nearest))
        _ -> Nothing
    closestOf away = case away of
      [] -> Nothing
      _ -> let (d, e) = minimumBy (comparing fst) away in Just (d, element e)
    sideOf p s =
      let foot = Segment.at (Segment.fraction s p) s
          ahead = Segment.directionAt (Segment.fraction s p) s
       in if Vec.cross ahead (Vec.to foot p) > 0 then Carrier.LeftOf else Carrier.RightOf

-- | How far a tape may be off from a contour, into the material and out of it. Of a curve the
-- contour has arcs that may be off themselves, if there are any: the tape has to come so much
-- nearer to them, as far as anything is allowed there but a pulse.
allowedOff :: Bool -> Milling -> (Mm, Mm)
allowedOff isCurved milling
  | isCurved = (less a, less b)
  | otherwise = (a, b)
  where
    (a, b) = Part.deepest (Part.tolerance milling)
    less d = max (Mm 0) (minus d Tolerance.curve)

-- | Whether a stroke runs at a height, to a pulse, or goes straight down to it or up from it.
isAt :: Machine -> Mm -> CutterMotion -> Bool
isAt machine z t =
  atLevel machine z (fromHeight t) && atLevel machine z (toHeight t)
    || isUpright t && atLevel machine z (uncurry min (heights t))

atLevel :: Machine -> Mm -> Mm -> Bool
atLevel machine (Mm z) (Mm h) = let Mm pulse = Machine.pulseOf machine Z in abs (z - h) <= pulse
