-- | Comparison of all motions of a tape with the moves that the program asks for, in order.
--
-- The program asks for single moves and for /groups/ of motions. A single move is an approach, a
-- retract, a lead, a peck or a programmed move; it has an exact line or arc. A group is a pass
-- along a contour or one clearing of a pocket; other comparisons examine its motions. Moves and
-- groups together, in the order of the program, are called /items/.
--
-- Each motion of the tape has to match an item: it runs along a single move, in its direction, or
-- it belongs to a group. A motion that does neither is a finding, and so is a move that no motion
-- makes. A move may be divided into several motions. At the end of a move, which is rounded to
-- pulses, a motion may match two neighbouring items. So the comparison keeps all items that the
-- last motion may match, as in the simulation of a nondeterministic automaton (Aho et al.,
-- Compilers, section 3.7).
module Verify.MotionMatch
  ( mismatches,
    ClearingFrames (..),
    clearingFrames,
    CommandPlace,
    commandPlaces,
  )
where

import Base.PulseVector (Pulses3)
import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times)
import Control.Monad (foldM)
import Control.Motion (Motion (..))
import Control.Motion qualified as Control
import Data.Either (fromRight)
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet qualified as IntSet
import Data.List (minimumBy)
import Data.Maybe (fromMaybe, isNothing, mapMaybe)
import Data.Ord (comparing)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Frame.Frame qualified as Frame
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (Z), Machine)
import Machine.Machine qualified as Machine
import Verify.Feed qualified as Feed
import Verify.MotionSet qualified as MotionSet
import Verify.PassFrames (FrameRange (..))
import Verify.Proof (Finding (MoveMissing, NotAsked))
import Verify.RequiredMove (MotionGroup (..), RequiredItem (..), RequiredMove (..))

-- | Position of the cutter: the point in the plane, and the height.
data Position = Position Point Mm

-- | Items that the last motion may match, by their indices from 0. The index of the last item plus
-- one means that all items are done.
type States = IntMap Progress

-- | Progress along the items: the part of the present item that is done, and the items so far.
data Progress = Progress
  { -- | fraction of a single move that is made; of a group, 1 if a motion belongs to it, else 0
    made :: Double,
    -- | items to which the motions so far belong, each with the number of its first frame; the last
    -- one comes first
    begun :: [(Int, Int)]
  }

-- | State before the first motion of a tape.
firstStates :: States
firstStates = IntMap.singleton 0 (Progress 0 [])

-- | Greater progress of two ways to the same item: more of the item is done. The first way if there
-- is no difference.
further :: Progress -> Progress -> Progress
further a b = if made b > made a then b else a

-- | Findings for the first motion of a tape that matches no item, or else for the first move that
-- no motion makes. Empty if all motions match and all moves are made. @begin@ is the position
-- before the first frame, in pulses. Each motion along a single move also needs the speed of the
-- move.
mismatches :: Machine -> Pulses3 -> [RequiredItem] -> [Motion] -> [Finding]
mismatches machine begin list motions =
  either pure (const []) (matched machine True begin (Vector.fromList list) motions)

-- | Frames of the passes of pockets on a tape, by the number of the pass.
data ClearingFrames = ClearingFrames
  { -- | frames in each pass; a pass without such frames is missing
    inPass :: IntMap FrameRange,
    -- | frames in each pass and in the moves before and after it
    withMoves :: IntMap FrameRange
  }

-- | Frames of the passes of pockets; Nothing if the motions do not match the items. @begin@ is the
-- position before the first frame, in pulses.
clearingFrames :: Machine -> Pulses3 -> [RequiredItem] -> [Motion] -> Maybe ClearingFrames
clearingFrames machine begin list motions = case matched machine False begin items motions of
  Left _ -> Nothing
  Right found ->
    let firsts = IntMap.fromList found
        beginOf = maybe maxBound snd
        ranges lower upper =
          IntMap.fromList
            [ (k, FrameRange (beginOf (lower i)) (beginOf (upper i) - 1))
              | (i, Several MotionGroup {clearingPass = Just k}) <- zip [0 ..] list
            ]
        groups = IntSet.fromList [i | (i, Several _) <- zip [0 ..] list]
        own i = (i,) <$> IntMap.lookup i firsts
        afterGroupBefore i = IntMap.lookupGT (fromMaybe (-1) (IntSet.lookupLT i groups)) firsts
        ofGroupAfter i = (`IntMap.lookupGE` firsts) =<< IntSet.lookupGT i groups
     in Just
          ClearingFrames
            { inPass = ranges own (`IntMap.lookupGT` firsts),
              withMoves = ranges afterGroupBefore ofGroupAfter
            }
  where
    items = Vector.fromList list

-- | The items that the motions match, in order, each with the number of its first frame; or a
-- finding for the first motion that matches no item, or for the first move that is missing.
matched ::
  Machine -> Bool -> Pulses3 -> Vector RequiredItem -> [Motion] -> Either Finding [(Int, Int)]
matched machine comparesFeeds begin items = go begin firstStates
  where
    go at states motions = case motions of
      [] -> case missingFrom items final of
        missing : _ | IntMap.notMember (Vector.length items) final -> Left missing
        _ -> Right (maybe [] (reverse . begun . snd) (IntMap.lookupMax final))
        where
          final = withSkipped machine items (positionOf machine at) maxBound states
      m : more
        | not (IntMap.null right) -> go (to m) right more
        | wrong : _ <- mapMaybe (wrongFeed m) (IntMap.keys states') -> Left wrong
        | otherwise -> Left (NotAsked (number m) (Frame.position machine (to m)))
        where
          states' = statesAfter machine items m states
          -- A motion at the joint of two moves may have the feed of either, but then it belongs to
          -- that move.
          right = IntMap.filterWithKey (\i _ -> isNothing (wrongFeed m i)) states'
    wrongFeed m i = case items Vector.! i of
      Single r | comparesFeeds -> Feed.atPace machine (pace r) (slows r) (origin r) m
      _ -> Nothing

-- | Place of a command in the order of a program.
data CommandPlace = CommandPlace
  { -- | index of the item that comes next
    nextItem :: Int,
    -- | true if that item is a group of which a motion came before
    isBegun :: Bool,
    -- | true if motions of the same item come before the command and after it
    isWithin :: Bool
  }
  deriving stock (Eq)

-- | Places of the commands on a tape, by the numbers of their frames. @commanded@ are these
-- numbers, in order. Frames after the first motion that matches no item are missing. @begin@ is the
-- position before the first frame, in pulses.
commandPlaces :: Machine -> Pulses3 -> [RequiredItem] -> [Int] -> [Motion] -> IntMap CommandPlace
commandPlaces machine begin list = \commanded motions ->
  let isWithin = withinItem machine begin items motions
   in IntMap.fromList
        [ (n, CommandPlace {nextItem, isBegun, isWithin = isWithin n})
          | (n, (nextItem, isBegun)) <- go begin firstStates commanded motions
        ]
  where
    items = Vector.fromList list
    go at states commanded motions
      | IntMap.null states = []
      | otherwise = case motions of
        [] -> map (placed at states maxBound) commanded
        m : more ->
          let (before, others) = span (<= number m) commanded
           in map (placed at states (number m)) before
                <> go (to m) (statesAfter machine items m states) others more
    placed at states next n =
      let skipped = withSkipped machine items (positionOf machine at) next states
       in (n, maybe (0, False) (fmap ((> 0) . made)) (IntMap.lookupMax skipped))

-- | Test that motions of the same item come before the frame of a command and after it. False on a
-- tape whose motions do not match the items.
withinItem :: Machine -> Pulses3 -> Vector RequiredItem -> [Motion] -> Int -> Bool
withinItem machine begin items motions = \n ->
  case (IntSet.lookupLT n firsts, IntSet.lookupGE n numbers) of
    (Just _, Just following) -> maybe True (following <) (IntSet.lookupGE n firsts)
    _ -> False
  where
    firsts = IntSet.fromList (map snd (fromRight [] (matched machine False begin items motions)))
    numbers = IntSet.fromDistinctAscList (map number motions)

-- | Findings for the moves that remain at the end of the tape: from the last item that the motions
-- match, this item included, to the last item of the program.
missingFrom :: Vector RequiredItem -> States -> [Finding]
missingFrom items states =
  [ MoveMissing (origin r) (Segment.end (path r))
    | Just (reached, _) <- [IntMap.lookupMax states],
      Single r <- Vector.toList (Vector.drop reached items)
  ]

-- | States after the motion @m@, from those before it; empty if the motion matches no item.
statesAfter :: Machine -> Vector RequiredItem -> Motion -> States -> States
statesAfter machine items m states =
  IntMap.fromListWith
    (flip further)
    [ (i, Progress made' (withItem i (begun progress)))
      | (i, progress) <- IntMap.toList (withSkipped machine items at (number m) states),
        Just made' <- [madeAfter i (made progress) =<< items Vector.!? i]
    ]
  where
    at = positionOf machine (from m)
    samples = samplesOf machine m
    madeAfter i before item = case item of
      Single r -> fractionAfter machine r samples before
      Several g
        | includes g m && (IntMap.member i states || number m <= latestBegin g) -> Just 1
        | otherwise -> Nothing
    withItem i known = case known of
      (j, _) : _ | j == i -> known
      _ -> (i, number m) : known

-- | Position in mm, from a position in pulses.
positionOf :: Machine -> Pulses3 -> Position
positionOf machine p = Position (Frame.position machine p) (Frame.height machine p)

-- | Adds to the states each item that the cutter may begin at the position @at@, because the items
-- before it are done. @next@ is the number of the frame that comes next. If no move separates two
-- groups, the second one begins as late as possible.
withSkipped :: Machine -> Vector RequiredItem -> Position -> Int -> States -> States
withSkipped machine items at next states =
  IntMap.unionWithKey
    (\i known begins -> if followsGroup i then begins else further known begins)
    states
    (IntMap.fromListWith (flip further) (concatMap later (IntMap.toList states)))
  where
    later (i, progress) = case items Vector.!? i of
      Just item
        | isDone item (made progress),
          let next' = progress {made = 0} ->
          (i + 1, next') : later (i + 1, next')
      _ -> []
    followsGroup i = all isGroup [items Vector.!? (i - 1), items Vector.!? i]
    isGroup item = case item of
      Just (Several _) -> True
      _ -> False
    isDone item before = case item of
      Single r -> isMade machine r at before
      Several g -> next >= earliestEnd g

-- Single moves ------------------------------------------------------------------------------------

-- | Test that the move @r@ is completely made when the cutter is at a position. The 'slack' of the
-- move and one pulse in height are allowed. @share@ is the fraction of the move that is made. A
-- move so short that rounding may leave nothing of it counts as made once the cutter is at its end.
isMade :: Machine -> RequiredMove -> Position -> Double -> Bool
isMade machine r (Position p z) share =
  Vec.distance p (Segment.end (path r)) <= slack r
    && MotionSet.isSameHeight machine z (snd (between r))
    && (times (1 - share) long <= largest || long <= times 2 largest)
  where
    long = lengthOf r
    largest = plus (slack r) (Machine.resolutionOf machine Z)

-- | Largest fraction of a move that is made after a motion with these samples, if it was @share@
-- before. Nothing if the motion does not run along the move in its direction. Rounding may lead
-- back from the furthest position, by no more than the 'slack' of the move.
fractionAfter :: Machine -> RequiredMove -> [Position] -> Double -> Maybe Double
fractionAfter machine r samples share = foldM onwards share samples
  where
    onwards before at@(Position p z)
      | Vec.distance p (Segment.at t (path r)) <= sideways
          && (MotionSet.isSameHeight machine z (heightAt r t) || isOnSlope z t)
          && times (before - t) (lengthOf r) <= slack r =
        Just (max before t)
      | otherwise = Nothing
      where
        t = fractionAt r before at
    -- On a move that changes the height, the fraction @t@ also depends on the height. Rounding the
    -- height to pulses changes @t@, so the point of the path at @t@ may be further from @p@.
    -- On an arc it depends on the plane alone, where rounding by a pulse changes the height of the
    -- path by its slope.
    isOnSlope z t = case path r of
      Straight _ _ -> False
      Arc {} ->
        let Mm d = minus z (heightAt r t)
            Mm rise = uncurry minus (between r)
            slope = over (Mm (abs rise)) (Segment.length (path r))
         in Mm (abs d)
              <= plus
                (Machine.resolutionOf machine Z)
                (times slope (Machine.planeResolution machine))
    sideways
      | uncurry (==) (between r) = slack r
      | otherwise = plus (slack r) (Machine.resolutionOf machine Z)

-- | Positions on a motion at which it is compared with a move: the ends and the middle of a line,
-- nine positions on an arc.
samplesOf :: Machine -> Motion -> [Position]
samplesOf machine m =
  [ Position (Segment.at k s) (plus low (times k (minus high low)))
    | k <- map (/ count) [0 .. count]
  ]
  where
    s = Control.segment machine m
    (low, high) = Control.height machine m
    count = case s of
      Straight _ _ -> 2
      Arc {} -> 8

-- | Fraction of a move, from 0 to 1, at which it is nearest to a position. If the arc is nearly
-- closed, a position may have several fractions. Then the result is the fraction nearest to
-- @before@.
fractionAt :: RequiredMove -> Double -> Position -> Double
fractionAt r before (Position p (Mm z)) = max 0 (min 1 fraction)
  where
    fraction = case path r of
      Straight a b
        | square > 0 -> (Vec.dot along (Vec.to a p) + rise * (z - low)) / square
        | otherwise -> 1
        where
          along = Vec.to a b
          square = Vec.dot along along + rise * rise
      Arc {sweep = Rad sweep} -> minimumBy (comparing (\t -> abs (t - before))) (turned sweep)
    turned sweep =
      let once = Segment.fraction (path r) p
          period = 2 * pi / abs sweep
       in [once - period, once, once + period]
    (Mm low, Mm high) = between r
    rise = high - low

-- | Height of a move at a fraction of its length.
heightAt :: RequiredMove -> Double -> Mm
heightAt r t = plus low (times t (minus high low))
  where
    (low, high) = between r

-- | Length of a move in space.
lengthOf :: RequiredMove -> Mm
lengthOf r = Mm (sqrt (l * l + h * h))
  where
    Mm l = Segment.length (path r)
    Mm h = uncurry minus (between r)
