-- | How far the strokes of one pass are off from its contour: the three comparisons of the proof.
module Verify.Deviation
  ( Pass (..),
    examine,
    boxOf,
    isAt,
    atLevel,
    allowedOff,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus)
import Control.Walk (Stroke (number))
import Control.Walk qualified as Control
import Data.Containers.ListUtils (nubOrd)
import Data.IntSet qualified as IntSet
import Data.List (minimumBy, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isNothing, listToMaybe, mapMaybe)
import Data.Ord (comparing)
import Geometry.Box qualified as Box
import Geometry.Distance (Nearest (Nearest))
import Geometry.Distance qualified as Distance
import Geometry.Offset qualified as Offset
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (Z), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Element, Milling)
import Part.Part qualified as Part
import Verify.Cover qualified as Cover
import Verify.Passage (Job (..), Trace (..), elementsOf, isUpright)
import Verify.Passage qualified as Passage
import Verify.Pointed qualified as Pointed
import Verify.Proof (Finding (..), Passage (..), Witness (..))

-- | A pass and what was found of it.
data Pass = Pass {job :: Job, passNumber :: Int, level :: Mm, found :: Passage.Found}

-- | How one pass came out: the strokes of the tape, as far as they come near it, are compared with its contour in its
-- first pass, its own strokes in each.
examine :: Machine -> Bool -> (Trace -> Mm) -> Bool -> [Trace] -> (Box.Box -> [Trace]) -> Pass -> (Passage, [Finding])
examine machine flat toolOf isFirst traces nearby Pass {job, level, found} = (passage, if null findings then order else findings)
  where
    elements = elementsOf job
    elementIndex = Box.index (Box.ofSegment . Part.segment) elements
    contourBox = foldr1 Box.union (fmap (Box.ofSegment . Part.segment) (Part.elements (Part.contour (milling job))))
    pulse = Machine.pulse machine
    (inside, outside) = allowedOff (milling job)
    mayGouge = plus (if upon then allowance' else inside) pulse
    mayLeave = plus (if upon then allowance' else outside) pulse
    allowance' = max inside outside
    upon = isNothing (side job)
    (milled, within) = case found of
      Passage.Followed arrival along _ -> (arrival <> along, along)
      Passage.Lost _ along _ -> (atHeight traces, along)
      Passage.NeverBegun -> (atHeight traces, [])
    atHeight = filter (\t -> flat || isAt machine level t)
    ownNumbers = IntSet.fromList (map (number . stroke) within)
    -- Its own strokes stay away from the contour by what they leave; all others have to spare the contour.
    looked = if upon then [] else filter belowTop (if isFirst then nearby (Box.inflate (outreach job) contourBox) else within)
    requirement t = if IntSet.member (number (stroke t)) ownNumbers then (\e p -> plus (reach job) (leftAt elementIndex e p)) else (\_ _ -> toolOf t)
    gouges = mapMaybe (\t -> gougeOf (max (outreach job) (toolOf t)) (requirement t) elementIndex t) looked <> pierced
    -- No distance tells when a tool without a radius crosses the contour; nor, then, that it leaves nothing.
    pierced = [w | Part.radius (milling job) <= Mm 0, Just keeps <- [side job], t <- looked, Just w <- [Pointed.gougeOf keeps (Part.contour (milling job)) elementIndex mayGouge t]]
    deepest = if null gouges then Nothing else Just (minimumBy (comparing (negated . amount)) gouges)
    missed = concat [uncut job {reach = plus (reach job) more, allowance = mayLeave} milledIndex es | (more, es) <- byAllowance elements]
    milledIndex = Box.index boxOf (filter (\t -> flat || isAt machine level t) milled)
    strayed = mapMaybe (strayOf job {reach = outreach job, allowance = mayLeave} elementIndex) level'
    level' = filter (not . isUpright) within
    most = listToMaybe (sortOn (negated . amount) (missed <> strayed))
    passage = Passage {contour = Part.contourName (Part.contour (milling job)), gouge = deepest, excess = most, allowedGouge = mayGouge, allowedExcess = mayLeave}
    tooDeep w = amount w > mayGouge
    tooMuch w = amount w > mayLeave
    findings =
      [Gouge first worst mayGouge | Just worst <- [deepest], first : _ <- [filter tooDeep gouges]]
        <> [Excess first (fromMaybe first most) mayLeave | not (any tooDeep pierced), first : _ <- [filter tooMuch strayed <> sortOn frame (filter tooMuch missed)]]
        <> take 1 (mapMaybe (wrongSide job elementIndex) level')
    -- Nothing else is wrong with the contour but the order in which it is walked.
    order = case found of
      Passage.Followed {} -> []
      Passage.Lost {} -> [NotFollowed (statement job) | Passage.measurable job]
      Passage.NeverBegun -> [NeverBegun (statement job)]
    negated (Mm x) = -x
    -- Above the top of the part nothing is cut.
    belowTop t = fst (heights t) <= Mm 0 || snd (heights t) <= Mm 0

-- | Elements by what is left on them besides what the pass leaves.
byAllowance :: [Element] -> [(Mm, [Element])]
byAllowance elements = [(more, [e | e <- elements, Part.allowance (Part.finish e) == more]) | more <- nubOrd (map (Part.allowance . Part.finish) elements)]

-- | How deep a stroke cuts into the contour, if it does: how much nearer it comes to an element than it may.
gougeOf :: Mm -> (Element -> Point -> Mm) -> Box.Index Element -> Trace -> Maybe Witness
gougeOf furthest' required index t
  | null near = Nothing
  | otherwise = Just (minimumBy (comparing (\w -> let Mm a = amount w in -a)) near)
  where
    near =
      [ Witness {amount = minus (required e p) d, frame = number (stroke t), element = Part.origin e, place = p}
        | way <- NonEmpty.toList (ways t) <> Control.across (ways t),
          e <- Box.select (\box -> Box.meets (around way) box && Box.atLeast (`Distance.toPoint` way) box <= furthest') index,
          let Nearest d p = Distance.segments way (Part.segment e),
          d < required e p
      ]
    around way = Box.inflate furthest' (Box.ofSegment way)

-- | A box that holds a stroke.
boxOf :: Trace -> Box.Box
boxOf t = foldr1 Box.union (fmap Box.ofSegment (ways t))

-- | What is left on an element where it is nearest to a point; where elements join, no more than on any of them, and nothing
-- of its own where another is nearer.
leftAt :: Box.Index Element -> Element -> Point -> Mm
leftAt index e p
  | own <= Mm 0 = own
  | any (\other -> plus (Distance.toPoint p (Part.segment other)) Tolerance.resolution < d) joined = Mm 0
  | otherwise = minimum (own : map left' joined)
  where
    own = left' e
    left' = Part.allowance . Part.finish
    (d, foot) = Distance.nearest p (Part.segment e)
    joined = [other | other <- Box.within (Box.inflate Tolerance.coincident (Box.ofPoints foot [])) index, Distance.toPoint foot (Part.segment other) <= Tolerance.coincident]

-- | For each element the most that is left standing on it, as far as it is more than on those before
-- or more than is allowed.
uncut :: Job -> Box.Index Trace -> [Element] -> [Witness]
uncut job index = go (Mm 0)
  where
    go least elements = case elements of
      [] -> []
      e : rest -> case Cover.furthest (others e) least (Part.segment e) of
        Nothing -> go least rest
        Just Cover.Beyond {Cover.most, Cover.place = p, Cover.around} ->
          let nearest = minimumBy (comparing (Cover.distanceTo p . ways)) around
              next = if most > allowance job then least else most
           in Witness {amount = most, frame = number (stroke nearest), element = Part.origin e, place = p} : go next rest
    others e = Cover.Others {Cover.index, Cover.lines = ways, Cover.counts = all (onLeadingSide job (Part.segment e)) . ways, Cover.reach = reach job, Cover.allowance = allowance job}

-- | Whether a stroke runs on the side of an element on which the cutter has to stand: another one would reach
-- the element through the part. One that is on the element itself, to the allowance, does not.
onLeadingSide :: Job -> Segment -> Segment -> Bool
onLeadingSide job element t = case side job of
  Nothing -> True
  Just keeps -> leftOf == (keeps == Offset.LeftOf) || d <= allowance job
  where
    -- Where the stroke is nearest: an arc's inside and outside are not those of the whole stroke.
    Nearest d p = Distance.segments t element
    leftOf = case element of
      Straight a b -> Vec.cross (Vec.to a b) (Vec.to a p) > 0
      Arc {start, centre, sweep = Rad s} -> (Vec.distance centre p < Segment.radius centre start) == (s > 0)

-- | How far a stroke strays from the contour, if it is more than is allowed.
strayOf :: Job -> Box.Index Element -> Trace -> Maybe Witness
strayOf job index t = case mapMaybe beyond (NonEmpty.toList (ways t)) of
  [] -> Nothing
  ws -> Just (minimumBy (comparing (\w -> let Mm a = amount w in -a)) ws)
  where
    beyond way = case Cover.furthest others (allowance job) way of
      Nothing -> Nothing
      Just Cover.Beyond {Cover.most, Cover.place = p, Cover.around} ->
        let e = minimumBy (comparing (Distance.toPoint p . Part.segment)) around
         in Just Witness {amount = most, frame = number (stroke t), element = Part.origin e, place = p}
    others = Cover.Others {Cover.index, Cover.lines = (:| []) . Part.segment, Cover.counts = const True, Cover.reach = reach job, Cover.allowance = allowance job}

-- | A stroke that lies beside an element on the wrong side: a straight one by its middle, an arc by places close to one
-- another.
wrongSide :: Job -> Box.Index Element -> Trace -> Maybe Finding
wrongSide job index t = case side job of
  Nothing -> Nothing
  Just keeps -> listToMaybe (mapMaybe (\k -> beside keeps (Segment.at k (line t))) looked)
  where
    looked = let ks = Passage.places t in zipWith (\a b -> (a + b) / 2) (0 : ks) (if isArc then ks else [1])
    isArc = case line t of
      Arc {} -> True
      Straight _ _ -> False
    beside keeps p = case Box.closest (\e -> if Box.meets around (Box.ofSegment (Part.segment e)) then Distance.toPoint p (Part.segment e) else Mm (1 / 0)) p index of
      Just (d, nearest)
        | d < Mm (1 / 0) && d > allowance job && Segment.spans (Part.segment nearest) p && sideOf p (Part.segment nearest) /= keeps ->
          Just (WrongSide (number (stroke t)) (Part.origin nearest))
      _ -> Nothing
    around = Box.inflate (plus (outreach job) (allowance job)) (boxOf t)
    sideOf p s =
      let foot = Segment.at (Segment.fraction s p) s
          ahead = Segment.directionAt (Segment.fraction s p) s
       in if Vec.cross ahead (Vec.to foot p) > 0 then Offset.LeftOf else Offset.RightOf

-- | How far a tape may be off from a contour, into the material and out of it. Of a curve the contour has arcs that may be
-- off themselves: the tape has to come so much nearer to them.
allowedOff :: Milling -> (Mm, Mm)
allowedOff milling
  | any Part.continues (Part.elements (Part.contour milling)) = (less a, less b)
  | otherwise = (a, b)
  where
    (a, b) = Part.deepest (Part.tolerance milling)
    less d = minus d Tolerance.curve

-- | Whether a stroke runs at a height, to a pulse, or goes straight down to it or up from it.
isAt :: Machine -> Mm -> Trace -> Bool
isAt machine z t = atLevel machine z (fst (heights t)) && atLevel machine z (snd (heights t)) || isUpright t && atLevel machine z (uncurry min (heights t))

atLevel :: Machine -> Mm -> Mm -> Bool
atLevel machine (Mm z) (Mm h) = let Mm pulse = Machine.pulseOf machine Z in abs (z - h) <= pulse
