-- | The proof: the frames read from a tape, run on the virtual controller and compared with the part.
--
-- Three comparisons, each exact over whole strokes and whole elements and none of them a
-- second equidistant:
--
-- * gouge: no stroke comes nearer to a milled element than the cutter's radius;
-- * excess: every point of a milled element has a stroke within the cutter's radius;
-- * band: between the beginning and the end of a contour no stroke strays further from it
--   than the cutter's radius, nor to its other side.
--
-- Tolerance and one pulse are allowed in each. Then the last position and the feeds.
module Verify.FromTape
  ( prove,
  )
where

import Base.Quantity (Mm (..), Pulses, Rad (..), minus, plus, times)
import Base.Region (Located (..))
import Control.StraightLine (Stroke (..))
import Control.StraightLine qualified as Control
import Data.Containers.ListUtils (nubOrd)
import Data.Either (fromRight)
import Data.IntSet qualified as IntSet
import Data.List (minimumBy, sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Data.Ord (comparing)
import Data.Vector qualified as Vector
import Frame.Frame (Frame (..), Program)
import Frame.Frame qualified as Frame
import Geometry.Box qualified as Box
import Geometry.Distance (Nearest (Nearest))
import Geometry.Distance qualified as Distance
import Geometry.Offset qualified as Offset
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Linear.V3 (V3 (..))
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part (Element, Milling)
import Part.Part qualified as Part
import Path.FromPart qualified as Path (leadingSide)
import Path.Path (Block, Path)
import Path.Path qualified as Path
import Verify.Cover qualified as Cover
import Verify.Passage (Job (..), Trace (..), elementsOf)
import Verify.Passage qualified as Passage
import Verify.Proof (Finding (..), Passage (..), Proof (Proof), Witness (..))
import Verify.Swivel qualified as Swivel

-- | Compare the frames of a tape with the part that a path goes around; the program's own frames
-- tell where the tape has to begin and end and which feeds belong where.
prove :: Machine -> Path -> Program -> [Frame] -> Proof
prove machine path program frames =
  Proof (length frames) passages closure largest firstDifference (sortOn order findings)
  where
    begin = Frame.start program
    own = map Frame.frame (Frame.planned program)
    strokes = Control.run begin frames
    traces = Swivel.levelled machine path (map traceOf strokes)
    traceOf s = Trace s (Control.segment machine s) (Frame.height machine (from s), Frame.height machine (to s))
    sameCount = length own == length frames
    flat = Path.isFlat path
    located = follow machine flat begin traces [b | b@Path.Cutting {} <- Path.blocks path]
    toolOf = if sameCount then ownTool program else supposedTool located
    (passages, found) = unzip (zipWith (\isFirst l -> examine (not sameCount) machine flat toolOf isFirst traces l) (firsts located) located)
    closure = begin + sum (map increment frames) - Frame.end program
    findings =
      concat found
        <> take 1 [OffPlane (number s) | flat, s <- strokes, V3 _ _ z <- [to s - begin], z /= 0]
        <> missingHoles machine path traces
        <> take 1 [CutsElsewhere n p | not flat, (n, p) <- strangers machine path (Swivel.levelled machine path (map traceOf (Control.run begin own))) traces]
        <> (if sameCount then wrongFeeds program frames else [])
        <> wrongCommands program frames
        <> [NotClosed closure | closure /= 0, not (any leaves (concat found))]
    largest = foldl (\(V3 a b c) (V3 x y z) -> V3 (max a (abs x)) (max b (abs y)) (max c (abs z))) 0 (map increment frames)
    -- A path that has left the band does not end where it should either.
    leaves finding = case finding of
      Gouge {} -> True
      Excess {} -> True
      WrongSide {} -> True
      NeverBegun {} -> True
      NotFollowed {} -> True
      OffPlane {} -> False
      HoleMissing {} -> False
      CutsElsewhere {} -> False
      WrongFeed {} -> False
      WrongCommand {} -> False
      NotClosed {} -> False
    firstDifference = listToMaybe ([n | (n, a, b) <- zip3 [1 ..] own frames, a /= b] <> [1 + min (length own) (length frames) | length own /= length frames])
    order finding = case finding of
      Gouge w _ _ -> (frame w, 0 :: Int)
      Excess w _ _ -> (frame w, 1)
      WrongSide n _ -> (n, 2)
      NeverBegun _ -> (0, 3)
      NotFollowed _ -> (0, 3)
      OffPlane n -> (n, 4)
      HoleMissing _ _ -> (0, 4)
      CutsElsewhere n _ -> (n, 4)
      WrongFeed n _ _ _ -> (n, 5)
      WrongCommand n _ _ -> (n, 6)
      NotClosed _ -> (maxBound, 7)

-- Where the passes are on the tape

-- | A pass and what was found of it.
data Pass = Pass {job :: Job, passNumber :: Int, level :: Mm, found :: Passage.Found}

-- | The passes one after the other, from where the cutter stands; each begins on the tape behind the
-- end of the one before. A flat path is looked for whatever the height.
follow :: Machine -> Bool -> V3 Pulses -> [Trace] -> [Block] -> [Pass]
follow machine flat begin = go begin
  where
    go at rest blocks = case blocks of
      Path.Cutting {Path.job = Located region milling, Path.pass = Path.Pass {Path.number = n, Path.reach, Path.atHeight}, Path.cut} : more ->
        let entry = Segment.start (Path.segment (NonEmpty.head cut))
            exit = Segment.end (Path.segment (NonEmpty.last cut))
            job = Job {milling, statement = region, entry, exit, reach, outreach = furthestOut milling reach, allowance = plus (uncurry max (allowedOff milling)) (Machine.pulse machine)}
            standsThere = flat || atLevel machine atHeight (Frame.height machine at)
            found = Passage.find job (if standsThere then Just (Frame.position machine at) else Nothing) (filter (\t -> flat || isAt machine atHeight t) rest)
            behind = case reverse (stretch found) of
              final : _ -> drop 1 (dropWhile ((/= number (stroke final)) . number . stroke) rest)
              [] -> rest
            next = case reverse (stretch found) of
              final : _ -> to (stroke final)
              [] -> at
         in Pass {job, passNumber = n, level = atHeight, found} : go next behind more
      _ : more -> go at rest more
      [] -> []
    stretch found = case found of
      Passage.Followed arrival along _ -> arrival <> along
      Passage.Lost arrival along _ -> arrival <> along
      Passage.NeverBegun -> []

-- | How far a tape may be off from a contour, into the material and out of it. Of a curve the contour has arcs that may be
-- off themselves: the tape has to come so much nearer to them.
allowedOff :: Milling -> (Mm, Mm)
allowedOff milling
  | any Part.continues (Part.elements (Part.contour milling)) = (less a, less b)
  | otherwise = (a, b)
  where
    (a, b) = Part.deepest (Part.tolerance milling)
    less d = minus d Tolerance.curve

-- | How far the cutter's centre goes from a contour at most.
furthestOut :: Milling -> Mm -> Mm
furthestOut milling reach
  | Part.corners milling == Part.Sharp = times 2 (plus reach most)
  | otherwise = plus reach most
  where
    most = maximum (fmap (Part.allowance . Part.finish) (Part.elements (Part.contour milling)))

-- | Whether a stroke runs at a height, to a pulse, or goes straight down to it or up from it.
isAt :: Machine -> Mm -> Trace -> Bool
isAt machine z t = atLevel machine z (fst (heights t)) && atLevel machine z (snd (heights t)) || isUpright t && atLevel machine z (uncurry min (heights t))

-- | Whether a stroke goes straight up or down.
isUpright :: Trace -> Bool
isUpright t = Segment.start (line t) == Segment.end (line t)

atLevel :: Machine -> Mm -> Mm -> Bool
atLevel machine (Mm z) (Mm h) = let Mm pulse = Machine.pulse machine in abs (z - h) <= pulse

-- | Whether each pass is the first one along its contour.
firsts :: [Pass] -> [Bool]
firsts passes = zipWith (/=) (map (Just . passNumber) passes) (Nothing : map (Just . passNumber) passes)

-- | The cutter in the spindle in each stroke of a tape with the program's own frames.
ownTool :: Program -> Trace -> Mm
ownTool program = \t -> fromMaybe (Mm 0) (tools Vector.!? (number (stroke t) - 1))
  where
    tools = Vector.fromList (map Frame.tool (Frame.planned program))

-- | The cutter in the spindle as far as a foreign tape tells: that of the pass at hand; of two passes the smaller
-- one between them.
supposedTool :: [Pass] -> Trace -> Mm
supposedTool passes = \t -> radiusAt (number (stroke t))
  where
    spans = [(number (stroke begin), number (stroke end), Part.radius (milling (job p))) | p <- passes, let s = strokesOf (found p), begin : _ <- [s], end : _ <- [reverse s]]
    radiusAt n = case ([r | (_, e, r) <- reverse spans, e < n], [r | (b, _, r) <- spans, b > n], [r | (b, e, r) <- spans, b <= n, n <= e]) of
      (_, _, r : _) -> r
      (r : _, q : _, []) -> min r q
      (r : _, [], []) -> r
      ([], q : _, []) -> q
      ([], [], []) -> Mm 0
    strokesOf f = case f of
      Passage.Followed arrival along _ -> arrival <> along
      Passage.Lost arrival along _ -> arrival <> along
      Passage.NeverBegun -> []

-- | Holes of the part at which no stroke goes straight down to their bottom.
missingHoles :: Machine -> Path -> [Trace] -> [Finding]
missingHoles machine path traces =
  [ HoleMissing at p
    | Path.Holing (Located _ d) _ <- Path.blocks path,
      Located at p <- NonEmpty.toList (Part.holes d),
      not (any (reaches (Part.bottom d) p) (Box.within (Box.inflate (times 2 pulse) (Box.ofPoints p [])) index))
  ]
  where
    pulse = Machine.pulse machine
    index = Box.index (Box.ofSegment . line) (filter isUpright traces)
    reaches bottom p t =
      Vec.distance (Segment.start (line t)) p <= pulse && minus (uncurry min (heights t)) bottom <= times 0.6 pulse

-- | Strokes below the top of the part where, or deeper than, the program's own tape does not go: the number of the
-- frame and a place.
strangers :: Machine -> Path -> [Trace] -> [Trace] -> [(Int, Point)]
strangers machine path own traces =
  [ (number (stroke t), p)
    | t <- traces,
      uncurry min (heights t) < minus (Mm 0) pulse,
      p : _ <- [[p | (p, z) <- places t, z < minus (Mm 0) pulse, not (known p z)]]
  ]
  where
    pulse = Machine.pulse machine
    index = Box.index (Box.ofSegment . line) (filter (\t -> uncurry min (heights t) < Mm 0) own)
    -- Chords of another tolerance lie within both.
    slack = plus (times 2 pulse) (maximum (Mm 0 : [times 2 (uncurry max (Part.deepest (Part.tolerance m))) | Path.Cutting {Path.job = Located _ m} <- Path.blocks path]))
    known p z = or [Distance.toPoint p (line o) <= slack && uncurry min (heights o) <= plus z pulse | o <- Box.within (Box.inflate slack (Box.ofPoints p [])) index]
    places t = [(Segment.at k (line t), plus (fst (heights t)) (times k (minus (snd (heights t)) (fst (heights t))))) | k <- [0, 0.5, 1]]

-- How a pass came out

-- | How one pass came out: the strokes of the tape are compared with its contour in its first pass, its own
-- strokes in each.
examine :: Bool -> Machine -> Bool -> (Trace -> Mm) -> Bool -> [Trace] -> Pass -> (Passage, [Finding])
examine foreign' machine flat toolOf isFirst traces Pass {job, level, found} =
  ((if null findings then order else findings) <>) <$> (passage, if foreign' then wrongCuts machine job within else [])
  where
    elements = elementsOf job
    elementIndex = Box.index (Box.ofSegment . Part.segment) elements
    pulse = Machine.pulse machine
    (inside, outside) = allowedOff (milling job)
    mayGouge = plus (if upon then allowance' else inside) pulse
    mayLeave = plus (if upon then allowance' else outside) pulse
    allowance' = max inside outside
    upon = reach job <= Mm 0
    (milled, within) = case found of
      Passage.Followed arrival along _ -> (arrival <> along, along)
      Passage.Lost _ along _ -> (atHeight traces, along)
      Passage.NeverBegun -> (atHeight traces, [])
    atHeight = filter (\t -> flat || isAt machine level t)
    ownNumbers = IntSet.fromList (map (number . stroke) within)
    -- Its own strokes stay away from the contour by what they leave; all others have to spare the contour.
    looked = if upon then [] else filter belowTop (if isFirst then traces else within)
    requirement t = if IntSet.member (number (stroke t)) ownNumbers then (\e p -> plus (reach job) (leftAt elementIndex e p)) else (\_ _ -> toolOf t)
    gouges = mapMaybe (\t -> gougeOf (max (outreach job) (toolOf t)) (requirement t) elementIndex t) looked
    deepest = if null gouges then Nothing else Just (minimumBy (comparing (negated . amount)) gouges)
    missed = concat [uncut job {reach = plus (reach job) more, allowance = mayLeave} milledIndex es | (more, es) <- byAllowance elements]
    milledIndex = Box.index (Box.ofSegment . line) (filter (\t -> flat || isAt machine level t) milled)
    strayed = mapMaybe (strayOf job {reach = outreach job, allowance = mayLeave} elementIndex) level'
    level' = filter (not . isUpright) within
    most = listToMaybe (sortOn (negated . amount) (missed <> strayed))
    passage = Passage {contour = Part.contourName (Part.contour (milling job)), gouge = deepest, excess = most, allowedGouge = mayGouge, allowedExcess = mayLeave}
    tooDeep w = amount w > mayGouge
    tooMuch w = amount w > mayLeave
    findings =
      [Gouge first worst mayGouge | Just worst <- [deepest], first : _ <- [filter tooDeep gouges]]
        <> [Excess first (fromMaybe first most) mayLeave | first : _ <- [filter tooMuch strayed <> sortOn frame (filter tooMuch missed)]]
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
        | e <- Box.select (\box -> Box.meets around box && Box.atLeast (\p -> Distance.toPoint p (line t)) box <= furthest') index,
          let Nearest d p = Distance.segments (line t) (Part.segment e),
          d < required e p
      ]
    around = Box.inflate furthest' (Box.ofSegment (line t))

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
          let nearest = minimumBy (comparing (Distance.toPoint p . line)) around
              next = if most > allowance job then least else most
           in Witness {amount = most, frame = number (stroke nearest), element = Part.origin e, place = p} : go next rest
    others e = Cover.Others {Cover.index, Cover.line, Cover.counts = onLeadingSide job (Part.segment e) . line, Cover.reach = reach job, Cover.allowance = allowance job}

-- | Whether a stroke runs on the side of an element on which the cutter has to stand: another one would reach
-- the element through the part.
onLeadingSide :: Job -> Segment -> Segment -> Bool
onLeadingSide job element t = case fromRight Nothing (Path.leadingSide (milling job)) of
  Nothing -> True
  Just side -> leftOf == (side == Offset.LeftOf)
  where
    -- Where the stroke is nearest: an arc's inside and outside are not those of the whole stroke.
    Nearest _ p = Distance.segments t element
    leftOf = case element of
      Straight a b -> Vec.cross (Vec.to a b) (Vec.to a p) > 0
      Arc {start, centre, sweep = Rad s} -> (Vec.distance centre p < Segment.radius centre start) == (s > 0)

-- | How far a stroke strays from the contour, if it is more than is allowed.
strayOf :: Job -> Box.Index Element -> Trace -> Maybe Witness
strayOf job index t = case Cover.furthest others (allowance job) (line t) of
  Nothing -> Nothing
  Just Cover.Beyond {Cover.most, Cover.place = p, Cover.around} ->
    let e = minimumBy (comparing (Distance.toPoint p . Part.segment)) around
     in Just Witness {amount = most, frame = number (stroke t), element = Part.origin e, place = p}
  where
    others = Cover.Others {Cover.index, Cover.line = Part.segment, Cover.counts = const True, Cover.reach = reach job, Cover.allowance = allowance job}

-- | A stroke whose middle lies beside an element on the wrong side.
wrongSide :: Job -> Box.Index Element -> Trace -> Maybe Finding
wrongSide job index t = case (side, Box.closest distanceTo middle index) of
  (Just s, Just (d, nearest))
    | d < Mm (1 / 0) && d > allowance job && Segment.spans (Part.segment nearest) middle && sideOf (Part.segment nearest) /= s ->
      Just (WrongSide (number (stroke t)) (Part.origin nearest))
  _ -> Nothing
  where
    side = fromRight Nothing (Path.leadingSide (milling job))
    middle = Segment.at 0.5 (line t)
    around = Box.inflate (plus (outreach job) (allowance job)) (Box.ofSegment (line t))
    distanceTo e = if Box.meets around (Box.ofSegment (Part.segment e)) then Distance.toPoint middle (Part.segment e) else Mm (1 / 0)
    sideOf s =
      let foot = Segment.at (Segment.fraction s middle) s
          ahead = Segment.directionAt (Segment.fraction s middle) s
       in if Vec.cross ahead (Vec.to foot middle) > 0 then Offset.LeftOf else Offset.RightOf

-- | Strokes along a contour that run at another feed than its statement asks.
wrongCuts :: Machine -> Job -> [Trace] -> [Finding]
wrongCuts machine job within = case Machine.chooseFeed machine (value asked) of
  Machine.Given wanted _ -> [WrongFeed (number s) (code s) wanted (region asked) | s <- map stroke within, code s `notElem` (wanted : others)]
  Machine.NoSuchFeed _ _ -> []
  where
    asked = Part.feed (milling job)
    finishes = map Part.finish (elementsOf job)
    -- Elements may have feeds of their own, or slow down.
    others =
      [c | f <- finishes, Just (Located _ own) <- [Part.ownFeed f], Machine.Given c _ <- [Machine.chooseFeed machine own]]
        <> [fst (Machine.slowest machine) | any Part.slow finishes]

-- | Frames with another auxiliary command than the program's own frame in the same place.
wrongCommands :: Program -> [Frame] -> [Finding]
wrongCommands program frames =
  [ WrongCommand n (auxiliary f) own
    | (n, own, f) <- zip3 [1 ..] (map (auxiliary . Frame.frame) (Frame.planned program) <> repeat 0) frames,
      auxiliary f /= own
  ]

-- | Frames whose feed is not that of the program's own frame in the same place.
wrongFeeds :: Program -> [Frame] -> [Finding]
wrongFeeds program frames =
  [ WrongFeed n (speed f) (speed own) (Frame.origin planned)
    | (n, planned, f) <- zip3 [1 ..] (Frame.planned program) frames,
      let own = Frame.frame planned,
      speed f /= speed own
  ]
