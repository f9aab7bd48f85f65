{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | The proof: the frames read from a tape, run on the virtual controller and compared with the
-- part.
--
-- Three comparisons, each exact over whole strokes and whole elements and none of them a second
-- equidistant:
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

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..))
import Control.Compensation qualified as Compensation
import Control.Motion qualified as Control
import Data.Either (fromRight)
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet qualified as IntSet
import Data.List (foldl', sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust)
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Vector
import Frame.Frame (Frame (..), FrameProgram)
import Frame.Frame qualified as Frame
import Frame.Rounding qualified as Rounding
import Geometry.Carrier (Side (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part (Milling, SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.FromPart qualified as Toolpath (leadingSide)
import Toolpath.Tolerance qualified as Tolerance
import Toolpath.Toolpath (Block, Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Deviation (MillingPass (..))
import Verify.Deviation qualified as Deviation
import Verify.Feed qualified as Feed
import Verify.FrameRule qualified as FrameRule
import Verify.Motion (CutterMotion (number), box, heights, line)
import Verify.Motion qualified as Motion
import Verify.PassSearch (MillingJob (..))
import Verify.PassSearch qualified as PassSearch
import Verify.Pocket qualified as Pocket
import Verify.Proof (Finding (..), Proof (Proof), Refusal (NotKept), Witness (frame))
import Verify.Proof qualified as Proof
import Verify.Swivel qualified as Swivel

-- | Compare the frames of a tape with the part that a path goes around; the program's own frames
-- tell where the tape has to begin and end and which feeds belong where.
prove :: Machine -> Toolpath -> FrameProgram -> [Frame] -> Proof
prove machine path program frames = case centres frames of
  -- There is no list of the strokes: their traces are much less.
  (traces, unkept) ->
    compared
      machine
      path
      program
      frames
      tools
      (levelled traces)
      (levelled (fst (centres (map Frame.frame (Frame.planned program)))))
      unkept
  where
    tools = ownTools program
    centres =
      Compensation.runWith (Motion.tracesOf machine) machine (toolAt tools) (Frame.start program)
    levelled = Swivel.levelled machine path

-- | The same of the traces on the tape and of the program's own, and what the control refuses.
compared ::
  Machine ->
  Toolpath ->
  FrameProgram ->
  [Frame] ->
  Vector Double ->
  [CutterMotion] ->
  [CutterMotion] ->
  [Compensation.Unkept] ->
  Proof
compared machine path program frames tools traces ownTraces unkept =
  Proof
    (count run)
    (passages <> emptied)
    closure
    (largest run)
    (firstDifference run)
    (sortOn order findings)
  where
    begin = Frame.start program
    run = sumOf begin (Frame.planned program) frames
    sameCount = Vector.length tools == count run
    flat = Toolpath.isFlat path
    located =
      follow
        machine
        flat
        (if sameCount then lastFrame else const Nothing)
        ( if isOnly || isJust (firstDifference run)
            then const Nothing
            else (`IntMap.lookup` cutFrames)
        )
        (Frame.position machine begin, Frame.height machine begin)
        traces
        (Toolpath.blocks path)
    toolOf =
      if sameCount
        then toolAt tools . number
        else
          supposedTool
            ([(begin', end', Part.radius (Pocket.milling p)) | (p, (begin', end')) <- clearedIn])
            located
    -- The last frame of a pass, by its number among all passes.
    lastFrame n = (\(Frames _ b) -> b) <$> IntMap.lookup n framesOfPasses
    framesOfPasses =
      IntMap.fromListWith
        wider
        [ (n, Frames k k)
          | (k, p) <- zip [1 ..] (Frame.planned program),
            Just n <- [Frame.passOf (Frame.role p)]
        ]
    -- There is nothing to confuse a single way along a contour with.
    isOnly = null (drop 1 [() | Toolpath.Cutting {} <- Toolpath.blocks path])
    -- Those along its contour.
    cutFrames =
      IntMap.fromListWith
        wider
        [ (n, Frames k k)
          | (k, p) <- zip [1 ..] (Frame.planned program),
            Frame.Cutting n <- [Frame.role p]
        ]
    isOwn pass t =
      sameCount
        && maybe
          False
          (\(Frames a b) -> a <= number t && number t <= b)
          (IntMap.lookup (Pocket.order pass) framesOfPasses)
    -- The strokes of each pocket, by its number from 0.
    ownTo :: IntMap [CutterMotion]
    ownTo =
      foldr
        (\t known -> maybe known (\k -> IntMap.insertWith (<>) k [t] known) (pocketAt (number t)))
        IntMap.empty
        traces
    pocketAt n = case IntMap.lookupLE n pocketFrames of
      Just (_, (b, k)) | n <= b -> Just k
      _ -> Nothing
    pocketFrames =
      IntMap.fromList
        [ (a, (b, k))
          | (k, p) <- zip [0 ..] pockets,
            pass <- NonEmpty.toList (Pocket.passes p),
            Just (Frames a b) <- [IntMap.lookup (Pocket.order pass) framesOfPasses]
        ]
    pockets = Pocket.pocketsOf (Toolpath.blocks path)
    (emptied, foundIn) =
      unzip
        [ Pocket.examine machine flat toolOf traces nearby (isOwn pass) p isFirst pass
          | p <- pockets,
            (isFirst, pass) <- zip (True : repeat False) (NonEmpty.toList (Pocket.passes p))
        ]
    -- On a foreign tape, the strokes in each pass of a pocket.
    inPockets =
      [ ( p,
          pass,
          [ t
            | t <- BoxTree.within (Pocket.about p) strokesByPlace,
              flat || Deviation.isAt machine (Pocket.level pass) t,
              Pocket.holds p (Segment.at 0.5 (line t))
          ]
        )
        | p <- pockets,
          pass <- NonEmpty.toList (Pocket.passes p)
      ]
    clearedIn = [(p, (number t, number (fromMaybe t (lastOf ts)))) | (p, _, t : ts) <- inPockets]
    -- The strokes that may touch what lies in a box, in the order of the tape, or more. An index
    -- pays where they are asked for often.
    nearby about =
      if often
        then BoxTree.within (BoundingBox.inflate largestTool about) strokesByPlace
        else traces
    often = not (null (drop 1 (filter id (firsts located) <> map (const True) pockets)))
    strokesByPlace = BoxTree.index box traces
    largestTool = foldl' (\most t -> max most (toolOf t)) (Mm 0) traces
    (passages, found) =
      unzip
        ( zipWith
            (\isFirst l -> Deviation.examine machine flat toolOf isFirst traces nearby l)
            (firsts located)
            located
        )
    closure =
      endsAt run - Rounding.rounded machine (let SpacePoint p z = Toolpath.end path in (p, z))
    findings =
      concat found
        <> concat foundIn
        <> [ NotInOrder (Pocket.statement p)
             | not flat,
               (k, p) <- zip [0 ..] pockets,
               not
                 ( Pocket.isInOrder
                     machine
                     p
                     (if sameCount then IntMap.findWithDefault [] k ownTo else traces)
                 )
           ]
        <> [OffPlane n | flat, Just n <- [firstRisen run]]
        <> missingHoles machine path traces
        <> take
          1
          [ CutsElsewhere n p
            | not flat,
              isJust (firstDifference run),
              (n, p) <- strangers machine path ownTraces traces
          ]
        <> ( if sameCount
               then unlessSame (Feed.asPlanned program frames)
               else
                 concatMap foreignFeeds located
                   <> concatMap foreignPocket inPockets
                   <> Feed.downwards program frames
           )
        <> Feed.tooFast machine begin frames
        <> unlessSame (FrameRule.wrongCommands program frames)
        <> FrameRule.refused machine begin frames
        <> map (Refused . NotKept) unkept
        <> [NotClosed closure | closure /= 0, not (any leaves (concat found <> concat foundIn))]
    foreignFeeds pass = case Deviation.found pass of
      PassSearch.Followed _ along -> asked pass along
      PassSearch.Lost _ along -> asked pass along
      PassSearch.NeverBegun -> []
    -- The way up or down at the end is none along the contour.
    asked pass along =
      Feed.asAsked machine (Deviation.job pass) (strokesOf (filter (not . Motion.isUpright) along))
    foreignPocket (p, pass, ts) =
      Feed.alongAt
        machine
        (Part.feed (Pocket.milling p))
        []
        ( strokesOf
            [ t
              | t <- ts,
                not (Motion.isUpright t),
                not (any (isAlong (line t)) (Pocket.aside pass))
            ]
        )
    -- Few tapes are asked for them: they are run once more.
    strokesOf ts =
      let numbers =
            IntSet.fromList (map number ts)
       in filter (\s -> IntSet.member (Control.number s) numbers) (Control.run begin frames)
    isAlong s way =
      all
        (\q -> Distance.toPoint q way <= times 2 (Machine.pulse machine))
        [Segment.start s, Segment.end s]
    -- The frames of the program itself have its feeds and its commands.
    unlessSame = if isJust (firstDifference run) then id else const []
    -- A path that has left the band does not end where it should either.
    leaves finding = case finding of
      Gouge {} -> True
      Excess {} -> True
      WrongSide {} -> True
      NeverBegun {} -> True
      NotFollowed {} -> True
      NotCleared {} -> True
      NotInOrder {} -> False
      OffPlane {} -> False
      HoleMissing {} -> False
      CutsElsewhere {} -> False
      WrongFeed {} -> False
      WrongCommand {} -> False
      TooFast {} -> False
      Refused _ -> False
      NotClosed {} -> False
    order finding = case finding of
      Gouge w _ _ -> (frame w, 0 :: Int)
      Excess w _ _ -> (frame w, 1)
      WrongSide n _ -> (n, 2)
      NeverBegun _ -> (0, 3)
      NotFollowed _ -> (0, 3)
      NotCleared {} -> (0, 3)
      NotInOrder _ -> (0, 3)
      OffPlane n -> (n, 4)
      HoleMissing _ _ -> (0, 4)
      CutsElsewhere n _ -> (n, 4)
      WrongFeed n _ _ _ -> (n, 5)
      TooFast n _ _ -> (n, 6)
      WrongCommand n _ _ _ -> (n, 7)
      Refused refusal -> (Proof.refusedFrame refusal, 8)
      NotClosed _ -> (maxBound, 9)

-- | What frames come to: how many there are, where they end, the largest increment of each axis,
-- whatever its sign; the first of them behind which the cutter is above or below its first height,
-- the first that is not the program's own.
data Sum = Sum
  { count :: Int,
    endsAt :: Pulses3,
    largest :: Pulses3,
    firstRisen :: Maybe Int,
    firstDifference :: Maybe Int
  }

-- | In one go, as they are many.
sumOf :: Pulses3 -> [Frame.Planned] -> [Frame] -> Sum
sumOf begin@(Pulses3 _ _ z0) = go 0 begin 0 Nothing Nothing
  where
    go :: Int -> Pulses3 -> Pulses3 -> Maybe Int -> Maybe Int -> [Frame.Planned] -> [Frame] -> Sum
    go !n at@(Pulses3 x y z) most@(Pulses3 a b c) risen differs own frames = case frames of
      [] ->
        Sum
          { count = n,
            endsAt = at,
            largest = most,
            firstRisen = risen,
            firstDifference = if null own then differs else earlier differs
          }
      f : more ->
        let Pulses3 dx dy dz = increment f
            z' = z + dz
            isOwn = case own of
              p : _ -> Frame.frame p == f
              [] -> False
         in go
              (n + 1)
              (Pulses3 (x + dx) (y + dy) z')
              (Pulses3 (max a (abs dx)) (max b (abs dy)) (max c (abs dz)))
              (if isJust risen || z' == z0 then risen else Just (n + 1))
              (if isOwn then differs else earlier differs)
              (drop 1 own)
              more
      where
        earlier known = if isJust known then known else Just (n + 1)

-- Where the passes are on the tape

-- | The passes along contours one after the other, from where the cutter stands; each begins on the
-- tape behind the end of the one before, and behind pockets, if their last frames are known by the
-- numbers of their passes; so are the frames along each contour, which may lie as near to those of
-- the next pass as is allowed. A flat path is looked for whatever the height.
follow ::
  Machine ->
  Bool ->
  (Int -> Maybe Int) ->
  (Int -> Maybe Frames) ->
  (Point, Mm) ->
  [CutterMotion] ->
  [Block] ->
  [MillingPass]
follow machine flat lastFrame cutFrames begin traces blocks =
  go begin traces Nothing (zip3 (Toolpath.passNumbers blocks) (areOfSeveral blocks) blocks)
  where
    -- The cuts of a pass have its elements in common.
    go at rest before numbered = case numbered of
      ( k,
        isOneOfSeveral,
        Toolpath.Cutting
          { Toolpath.job = Located region milling,
            Toolpath.pass = Toolpath.Pass {Toolpath.number = n, Toolpath.reach, Toolpath.atHeight},
            Toolpath.cut
          }
        )
        : more ->
          let entry = Segment.start (Toolpath.segment (NonEmpty.head cut))
              exit =
                fromMaybe
                  (Segment.end (Toolpath.segment (NonEmpty.last cut)))
                  (exitByControl milling reach)
              edges = case before of
                Just MillingPass {job = MillingJob {edges = same}, passNumber = m} | m == n -> same
                _ -> PassSearch.edgesOf milling
              allowance =
                plus
                  (uncurry max (Deviation.allowedOff (PassSearch.isCurved edges) milling))
                  (Machine.pulse machine)
              job =
                MillingJob
                  { milling,
                    statement = region,
                    side = fromRight Nothing (Toolpath.leadingSide milling),
                    entry,
                    exit,
                    reach,
                    outreach = furthestOut milling (PassSearch.mostLeft edges) reach,
                    allowance,
                    exitWithin = plus allowance (unsureExit machine milling reach),
                    isOneOfSeveral,
                    edges
                  }
              standsThere = flat || Deviation.atLevel machine atHeight (snd at)
              found =
                PassSearch.find
                  job
                  (if standsThere then Just (fst at) else Nothing)
                  (if flat then own else filter (Deviation.isAt machine atHeight) own)
              own =
                maybe
                  rest
                  ( \(Frames a b) ->
                      takeWhile ((<= b) . number) (dropWhile ((< a - 1) . number) rest)
                  )
                  (cutFrames k)
              final = lastOf (PassSearch.stretch found)
              behind = maybe rest (\t -> drop 1 (dropWhile (not . Motion.isSame t) rest)) final
              next = maybe at standing final
              pass = MillingPass {job, passNumber = n, level = atHeight, found}
           in pass : go next behind (Just pass) more
      -- What a pocket asks is no way along a contour.
      (n, _, Toolpath.Clearing {}) : more
        | Just final <- lastFrame n ->
          let (done, rest') =
                span ((<= final) . number) rest
           in go (maybe at standing (lastOf done)) rest' before more
      _ : more -> go at rest before more
      [] -> []
    standing t = (Segment.end (line t), snd (heights t))

-- | Whether each block is one of several cuts of a pass: only where material may stay are there
-- any.
areOfSeveral :: [Block] -> [Bool]
areOfSeveral blocks =
  zipWith3
    (\before own next -> isJust own && (own == before || own == next))
    (Nothing : passes)
    passes
    (drop 1 passes <> [Nothing])
  where
    passes = map passOf blocks
    passOf b = case b of
      Toolpath.Cutting
        { Toolpath.job = Located _ milling,
          Toolpath.pass = Toolpath.Pass {Toolpath.number, Toolpath.left, Toolpath.atHeight}
        }
          | Part.rest milling == Part.Allowed ->
            Just (number, left, atHeight)
      _ -> Nothing

lastOf :: [a] -> Maybe a
lastOf = foldl' (\_ a -> Just a) Nothing

-- | Where the cutter's centre arrives beside the end of a contour beside which the control keeps
-- it. A control may take the last corner of a closed one for none, and the direction in which it
-- leaves a larger one is as exact as the pulses of a short move.
exitByControl :: Milling -> Mm -> Maybe Point
exitByControl milling (Mm reach) = case (Part.byControl milling, Toolpath.leadingSide milling) of
  (Just _, Right (Just side)) ->
    Just
      ( Vec.shift
          ( Vec.scale
              (if side == LeftOf then reach else -reach)
              (Vec.left (Segment.endDirection final))
          )
          (Segment.end final)
      )
  _ -> Nothing
  where
    final = Part.segment (NonEmpty.last (Part.elements (Part.contour milling)))

-- | How far from there it may arrive: the direction of the last move is off by what rounding makes
-- of the shortest one.
unsureExit :: Machine -> Milling -> Mm -> Mm
unsureExit machine milling reach = case Part.byControl milling of
  Just _ ->
    let Mm pulse =
          Machine.pulse machine
        Mm shortest = Tolerance.controlLength
     in times (2 * pulse / shortest) reach
  Nothing -> Mm 0

-- | How far the cutter's centre goes from a contour at most, on whose elements so much is left at
-- most.
furthestOut :: Milling -> Mm -> Mm -> Mm
furthestOut milling most reach
  | Part.corners milling == Part.Sharp = times 2 (plus reach most)
  | otherwise = plus reach most

-- | Whether each pass is the first one along its contour.
firsts :: [MillingPass] -> [Bool]
firsts passes =
  zipWith (/=) (map (Just . passNumber) passes) (Nothing : map (Just . passNumber) passes)

-- | The first and the last of some frames, by their numbers.
data Frames = Frames Int Int

wider :: Frames -> Frames -> Frames
wider (Frames a b) (Frames c d) = Frames (min a c) (max b d)

-- | The radius of the cutter in the spindle in each of the program's own frames, in mm.
ownTools :: FrameProgram -> Vector Double
ownTools program = Vector.fromList [r | p <- Frame.planned program, let Mm r = Frame.tool p]

-- | The radius in a frame by its number.
toolAt :: Vector Double -> Int -> Mm
toolAt tools n = maybe (Mm 0) Mm (tools Vector.!? (n - 1))

-- | The cutter in the spindle as far as a foreign tape tells, by the frames between which pockets
-- are cleared and the passes along contours: that of the pass at hand; of two passes the smaller
-- one between them.
supposedTool :: [(Int, Int, Mm)] -> [MillingPass] -> CutterMotion -> Mm
supposedTool pockets passes = \t -> radiusAt (number t)
  where
    spans =
      [ (number begin, number end, Part.radius (milling (job p)))
        | p <- passes,
          let s = PassSearch.stretch (found p),
          begin : _ <- [s],
          Just end <- [lastOf s]
      ]
        <> pockets
    radiusAt n =
      case ( [r | (_, e, r) <- reverse spans, e < n],
             [r | (b, _, r) <- spans, b > n],
             [r | (b, e, r) <- spans, b <= n, n <= e]
           ) of
        (_, _, r : _) -> r
        (r : _, q : _, []) -> min r q
        (r : _, [], []) -> r
        ([], q : _, []) -> q
        -- No pass is found: of all cutters the smallest.
        ([], [], []) ->
          minimum
            (maybe (Mm 0 :| []) (fmap (Part.radius . milling . job)) (NonEmpty.nonEmpty passes))

-- | Holes of the part at which no stroke goes straight down to their bottom.
missingHoles :: Machine -> Toolpath -> [CutterMotion] -> [Finding]
missingHoles machine path traces =
  [ HoleMissing at p
    | Toolpath.Holing (Located _ d) _ <- Toolpath.blocks path,
      Located at p <- NonEmpty.toList (Part.holes d),
      not
        ( any
            (reaches (Part.bottom d) p)
            (BoxTree.within (BoundingBox.inflate (times 2 pulse) (BoundingBox.ofPoints p [])) index)
        )
  ]
  where
    pulse = Machine.pulse machine
    index = BoxTree.index box (filter Motion.isUpright traces)
    reaches bottom p t =
      Vec.distance (Segment.start (line t)) p <= pulse
        && minus (uncurry min (heights t)) bottom <= times 0.6 (Machine.pulseOf machine Machine.Z)

-- | Strokes below the top of the part where, or deeper than, the program's own tape does not go:
-- the number of the frame and a place.
strangers :: Machine -> Toolpath -> [CutterMotion] -> [CutterMotion] -> [(Int, Point)]
strangers machine path own traces =
  [ (number t, p)
    | t <- traces,
      uncurry min (heights t) < minus (Mm 0) pulse,
      p : _ <- [[p | (p, z) <- places t, z < minus (Mm 0) pulse, not (known p z)]]
  ]
  where
    pulse = Machine.pulse machine
    index =
      BoxTree.index
        (BoundingBox.ofSegment . line)
        (filter (\t -> uncurry min (heights t) < Mm 0) own)
    -- Chords of another tolerance lie within both.
    slack =
      plus
        (times 2 pulse)
        ( maximum
            ( Mm 0 :
                [ times 2 (uncurry max (Part.deepest (Part.tolerance m)))
                  | m <- concatMap millingOf (Toolpath.blocks path)
                ]
            )
        )
    millingOf b = case b of
      Toolpath.Cutting {Toolpath.job = Located _ m} -> [m]
      Toolpath.Clearing {Toolpath.pocket = Located _ p} -> [Part.wall p]
      Toolpath.Travelling _ _ -> []
      Toolpath.Holing _ _ -> []
      Toolpath.Commanding _ -> []
    known p z =
      or
        [ Distance.toPoint p (line o) <= slack && uncurry min (heights o) <= plus z pulse
          | o <- BoxTree.within (BoundingBox.inflate slack (BoundingBox.ofPoints p [])) index
        ]
    places t =
      [ ( Segment.at k (line t),
          plus (fst (heights t)) (times k (minus (snd (heights t)) (fst (heights t))))
        )
        | k <- 0 : Motion.places t
      ]
