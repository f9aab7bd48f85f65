-- | Moves and groups of motions that a program asks for, in order. "Verify.MotionMatch" compares
-- the motions of a tape with them.
--
-- A /group/ is a pass along a contour, or one pass of a pocket. Its motions are not single moves:
-- other comparisons examine them. Moves and groups together are called /items/.
module Verify.RequiredMove
  ( RequiredMove (..),
    MotionGroup (..),
    RequiredItem (..),
    alongContour,
    atLevels,
    itemsOf,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..), Region)
import Base.Region qualified as Region
import Control.Motion (Motion)
import Control.Motion qualified as Control
import Data.IntSet qualified as IntSet
import Data.List (find, foldl', mapAccumL, zipWith5)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust, isNothing, listToMaybe)
import Frame.Frame qualified as Frame
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.AvoidedSolid (AvoidedSolid)
import Part.AvoidedSolid qualified as AvoidedSolid
import Part.Part (Cutter, Milling, Pace, SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.Toolpath (Block, Move, Sent, Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Descent (Slope)
import Verify.Descent qualified as Descent
import Verify.Deviation (MillingPass (..))
import Verify.Deviation qualified as Deviation
import Verify.Feed qualified as Feed
import Verify.MillingJob (MillingJob (..))
import Verify.Motion qualified as Motion
import Verify.MotionSet qualified as MotionSet
import Verify.Pocket (ClearingPass, Pocket)
import Verify.Pocket qualified as Pocket
import Verify.RequiredHole qualified as RequiredHole
import Verify.RequiredLink (Place (Place), RequiredLink (RequiredLink))
import Verify.RequiredLink qualified as RequiredLink
import Verify.Requirement qualified as Requirement

-- | Move that the program asks for.
data RequiredMove = RequiredMove
  { -- | path in the plane; a vertical move has a line of length 0
    path :: Segment,
    -- | heights at the beginning and at the end; the top of the part is 0
    between :: (Mm, Mm),
    -- | largest distance of a motion from the path, in the plane
    slack :: Mm,
    -- | @pace@ is the speed; @slows@ is true if the cutter may slow down at the end of the move
    pace :: Pace,
    slows :: Bool,
    -- | region of the program that asks for the move
    origin :: Region
  }

-- | Motions that another comparison examines. Frames are numbered from 1.
data MotionGroup = MotionGroup
  { -- | test that a motion may belong to the group
    includes :: Motion -> Bool,
    -- | number of the last frame with which the group may begin
    latestBegin :: Int,
    -- | number of the first frame with which the group may end
    earliestEnd :: Int,
    -- | number of the pocket's pass among all passes of the toolpath, from 0; Nothing along a
    -- contour
    clearingPass :: Maybe Int
  }

-- | Item of the sequence that the program asks for.
data RequiredItem
  = Single RequiredMove
  | Several MotionGroup

-- | Items of a toolpath. @isFlat@ is true if the whole toolpath is at the height of its start; the
-- heights in pockets are then not compared. @alongContours@ has a group for each block that cuts a
-- contour: 'alongContour' or 'atLevels'. @pockets@ are the pockets of the blocks. All single moves
-- come from the statements ("Verify.RequiredLink"); of the toolpath only the ends of its cuts are
-- used. The moves for a control that compensates come from the toolpath.
itemsOf :: Machine -> Bool -> [MotionGroup] -> [Pocket] -> Toolpath -> [RequiredItem]
itemsOf machine isFlat alongContours pockets toolpath =
  concat (snd (mapAccumL (itemsOfBlock machine isFlat solids) (alongContours, clearings) visits))
  where
    solids = map (AvoidedSolid.prepared . value) (Toolpath.avoided (Toolpath.setup toolpath))
    tools = map fst (Toolpath.withTools (Toolpath.setup toolpath) blocks)
    clearings = [(pocket, p) | pocket <- pockets, p <- NonEmpty.toList (Pocket.passes pocket)]
    visits =
      zipWith5 BlockVisit (beginnings toolpath) tools (Nothing : map Just blocks) blocks following
    following = map Just (drop 1 blocks) <> [Nothing]
    blocks = Toolpath.blocks toolpath

-- | Position of the cutter before a block, the tool, the block before it, the block, and the one
-- after it.
data BlockVisit = BlockVisit SpacePoint (Maybe Cutter) (Maybe Block) Block (Maybe Block)

-- | Items of a block. The state has the groups along contours and the clearings of this block and
-- of the later ones.
itemsOfBlock ::
  Machine ->
  Bool ->
  [AvoidedSolid] ->
  ([MotionGroup], [(Pocket, ClearingPass)]) ->
  BlockVisit ->
  (([MotionGroup], [(Pocket, ClearingPass)]), [RequiredItem])
itemsOfBlock machine isFlat solids left@(along, clearing) visit = case block of
  Toolpath.Travelling _ stops _ -> (left, links pulse (RequiredLink.stopMoves begin stops))
  Toolpath.Holing drilling _ -> (left, map Single (holes drilling))
  Toolpath.Carved (Located _ c) ms _ ->
    (left, singles (slackWithin machine (Part.carvingTolerance c)) (NonEmpty.toList ms))
  Toolpath.Commanding _ -> (left, [])
  Toolpath.Cutting {Toolpath.job, Toolpath.sent = Just s} ->
    ((drop 1 along, clearing), singles (slackOf machine (value job)) (edgeMoves s))
  Toolpath.Cutting
    { Toolpath.job = Located region milling,
      Toolpath.pass,
      Toolpath.descent,
      Toolpath.cut
    } ->
      ( (drop 1 along, clearing),
        around
          milling
          (withSlopes milling pass cut descent (placeOf visit region 4 milling pass))
          cut
          (map Several (take 1 along))
      )
  Toolpath.Clearing {Toolpath.pocket = Located region p, Toolpath.pass, Toolpath.cleared} ->
    let first = Segment.start (Toolpath.segment (NonEmpty.head cleared))
        isStraight = isStraightDown (Part.wall p)
        milling = (if isStraight then overWall region block first else id) (Part.wall p)
        slopes = Descent.inPocket (Part.wall p) (Toolpath.atHeight pass) cleared
        place = placeOf visit region 6 milling pass
        group = map (Several . uncurry (inPocket machine isFlat solids slopes)) (take 1 clearing)
     in ( (along, drop 1 clearing),
          around
            milling
            place {RequiredLink.entry = if isStraight then Nothing else Just first}
            cleared
            group
        )
  where
    BlockVisit begin cutter _ block _ = visit
    pulse = Machine.planeResolution machine
    around milling place cut group =
      linksOf milling (RequiredLink.before place begin (beginOf milling cut))
        <> group
        <> linksOf milling (RequiredLink.behind place (finishOf milling cut))
    linksOf milling =
      links (slackOf machine milling) . concatMap (linkOver solids cutter (Part.clearance milling))
    holes drilling =
      concatMap
        (moveOver solids cutter (Part.travelHeight (value drilling)) . moveOf (slackAt drilling))
        (RequiredHole.holeLinks machine begin drilling)
    slackAt = RequiredHole.slackOf machine . value

-- | Test that the cutter goes straight down before each pass of a milling.
isStraightDown :: Milling -> Bool
isStraightDown milling = value (Part.descent milling) == Part.Plunging

-- | A place with the way down to its cut, whose moves are @descent@ in the toolpath.
withSlopes :: Milling -> Toolpath.Pass -> NonEmpty Move -> [Move] -> Place -> Place
withSlopes milling pass cut descent place =
  place
    { RequiredLink.entry = Segment.start . Descent.path <$> listToMaybe slopes,
      RequiredLink.slopes
    }
  where
    slopes = slopesTo milling pass (Toolpath.segment (NonEmpty.head cut)) descent

-- | The parts of the way down to a cut that begins with the segment @first@; empty if the way is
-- not as the statement asks, so that its moves are not required. @descent@ are the moves of the
-- toolpath before the cut.
slopesTo :: Milling -> Toolpath.Pass -> Segment -> [Move] -> [Slope]
slopesTo milling pass first descent =
  fromMaybe
    []
    ( Descent.alongContour
        milling
        (Requirement.cutterSide milling)
        (reach, times widest (plus reach (Mm largest)))
        (Toolpath.atHeight pass)
        (Segment.start first)
        descent
    )
  where
    reach = Requirement.centreDistance milling (Toolpath.left pass)
    widest = if Part.corners milling == Part.Sharp then 2 else 1
    Mm largest =
      maximum
        (fmap (Part.allowance . Part.finish) (Part.elements (Part.contour milling)))

-- | Way of a rapid linking move, in the plane and in its heights: over the solids that the program
-- avoids, straight up before and straight down after them, or as it is.
overSolids :: [AvoidedSolid] -> Mm -> Cutter -> (Segment, (Mm, Mm)) -> [(Segment, (Mm, Mm))]
overSolids solids clear cutter way@(s, (from, to)) = case s of
  Straight p q
    | p /= q,
      Just h <- AvoidedSolid.heightOver clear solids cutter s (min from to) ->
      let high = max h from
       in [(Straight p p, (from, high)) | from /= high]
            <> [(s, (high, high))]
            <> [(Straight q q, (high, to)) | high /= to]
  _ -> [way]

-- | Linking move over solids, with a clearance height; as it is without one, or if it is not rapid.
linkOver :: [AvoidedSolid] -> Maybe Cutter -> Maybe Mm -> RequiredLink -> [RequiredLink]
linkOver solids cutter clearance link@(RequiredLink s zs speed region) =
  case (speed, clearance, cutter) of
    (Part.Rapid, Just clear, Just c) ->
      [RequiredLink s' zs' speed region | (s', zs') <- overSolids solids clear c (s, zs)]
    _ -> [link]

-- | Move of a drill over solids; as it is if it is not rapid.
moveOver :: [AvoidedSolid] -> Maybe Cutter -> Mm -> RequiredMove -> [RequiredMove]
moveOver solids cutter clear move = case (pace move, cutter) of
  (Part.Rapid, Just c) ->
    [ move {path = s, between = zs}
      | (s, zs) <- overSolids solids clear c (path move, between move)
    ]
  _ -> [move]

-- | Milling of a pocket's wall, with another stop of the approach at the clearance height, if the
-- block @block@ has it: if a wall lies between the position where the cutter would plunge and the
-- beginning @first@ of the first loop, the cutter goes on to this point before it plunges. If the
-- last stop is at another height, the cutter first goes straight to the clearance height there.
overWall :: Region -> Block -> Point -> Milling -> Milling
overWall region block first milling = case Part.clearance milling of
  Just clear
    | not (null (Part.approach milling)),
      Toolpath.Clearing {Toolpath.approach} <- block,
      any (endsOver clear) approach ->
      milling
        { Part.approach =
            Part.approach milling
              <> map (atClearance clear) (filter (isElsewhere clear) (lastStop milling))
              <> [stop clear]
        }
  _ -> milling
  where
    lastStop = take 1 . reverse . Part.approach
    isElsewhere clear s = maybe False (/= clear) (Part.level s)
    atClearance clear s = s {Part.level = Just clear, Part.pace = Part.Rapid}
    stop clear = Part.Stop (Located region first) (Just clear) Part.Rapid
    endsOver clear m =
      Segment.end (Toolpath.segment m) == first && Toolpath.heights m == (clear, clear)

-- | Place of the block of a visit in its statement. @letters@ is the length of the statement's
-- first word.
placeOf :: BlockVisit -> Region -> Int -> Milling -> Toolpath.Pass -> Place
placeOf (BlockVisit _ _ previous _ next) region letters milling pass =
  Place
    { RequiredLink.milling,
      RequiredLink.word = region {Region.end = Region.start region + letters},
      RequiredLink.side = Requirement.cutterSide milling,
      RequiredLink.level = Toolpath.atHeight pass,
      RequiredLink.entry = Nothing,
      RequiredLink.slopes = [],
      RequiredLink.isFirst = not (any isSame previous),
      RequiredLink.isLast = not (any isSame next)
    }
  where
    isSame b = case b of
      Toolpath.Cutting {Toolpath.pass = p} -> Toolpath.number p == Toolpath.number pass
      Toolpath.Clearing {Toolpath.pass = p} -> Toolpath.number p == Toolpath.number pass
      _ -> False

-- | Position, unit direction and height of the cutter's centre at the beginning of a cut and at its
-- end. If the first or the last move has no length, the direction is that of the element.
beginOf, finishOf :: Milling -> NonEmpty Move -> (Point, Vec, Mm)
beginOf milling cut = (Segment.start s, Segment.startDirection along, fst (Toolpath.heights m))
  where
    m = NonEmpty.head cut
    s = Toolpath.segment m
    along = alongOr s (Part.segment (NonEmpty.head (Part.elements (Part.contour milling))))
finishOf milling cut = (Segment.end s, Segment.endDirection along, snd (Toolpath.heights m))
  where
    m = NonEmpty.last cut
    s = Toolpath.segment m
    along = alongOr s (Part.segment (NonEmpty.last (Part.elements (Part.contour milling))))

-- | First segment, or the second one if the first one has no length.
alongOr :: Segment -> Segment -> Segment
alongOr s other = if Segment.length s > Tolerance.coincident then s else other

-- | Items of linking moves. @slack@ is the largest distance in mm of a motion from its move, in the
-- plane.
links :: Mm -> [RequiredLink] -> [RequiredItem]
links slack = map (Single . moveOf slack)

-- | Linking move as a move of the program, with its 'slack'.
moveOf :: Mm -> RequiredLink -> RequiredMove
moveOf slack (RequiredLink path between pace origin) =
  RequiredMove {path, between, slack, pace, slows = False, origin}

-- | Positions of the cutter at the beginnings of the blocks of a toolpath.
beginnings :: Toolpath -> [SpacePoint]
beginnings toolpath = scanl after (value (Toolpath.start toolpath)) (Toolpath.blocks toolpath)
  where
    after at = foldl' (\_ m -> endOf m) at . Toolpath.moves
    endOf m = SpacePoint (Segment.end (Toolpath.segment m)) (snd (Toolpath.heights m))

-- | Moves that a control with cutter compensation gets in place of the toolpath.
edgeMoves :: Sent -> [Move]
edgeMoves s =
  concat
    [ Toolpath.before s,
      [Toolpath.entry s],
      NonEmpty.toList (Toolpath.edge s),
      [Toolpath.exit s],
      Toolpath.behind s
    ]

-- | Items of single moves. @slack@ is the largest distance in mm of a motion from its move, in the
-- plane.
singles :: Mm -> [Move] -> [RequiredItem]
singles slack = map single
  where
    single m =
      Single
        RequiredMove
          { path = Toolpath.segment m,
            between = Toolpath.heights m,
            slack,
            pace = Toolpath.pace m,
            slows = Toolpath.isBraked m,
            origin = Toolpath.origin m
          }

-- | Largest distance in mm, in the plane, of a motion from a linking move of a milling: the
-- tolerance plus one pulse.
slackOf :: Machine -> Milling -> Mm
slackOf machine = slackWithin machine . Part.tolerance

-- | Largest distance in mm, in the plane, of a motion from its move: the tolerance plus one pulse.
slackWithin :: Machine -> Part.Accuracy -> Mm
slackWithin machine tolerance =
  plus (uncurry max (Part.deviationLimits tolerance)) (Machine.planeResolution machine)

-- | Group of the motions along a contour. The first motions may also belong to the approach, as
-- long as they stay at the start of the cut. The last motions may also belong to the retract if
-- they stay at the end of the cut.
alongContour :: MillingPass -> MotionGroup
alongContour MillingPass {job, found} =
  MotionGroup
    { includes = \m -> IntSet.member (Control.number m) members,
      latestBegin = maybe maxBound Motion.number (find isAwayFromEntry along),
      earliestEnd = maybe 0 ((+ 1) . Motion.number) (find isAwayFromExit (reverse along)),
      clearingPass = Nothing
    }
  where
    along = filter (not . Motion.changesHeight) (Deviation.motionsAlong found)
    members = IntSet.fromList (map Motion.number along)
    isAwayFromEntry = isAwayFrom (entry job) (allowance job)
    isAwayFromExit = isAwayFrom (exit job) (exitTolerance job)
    isAwayFrom p limit m =
      any
        (\k -> Vec.distance p (Segment.at k (Motion.segment m)) > limit)
        [0, 0.5, 1]

-- | For each block that cuts a contour, the group of all motions at its height that are not rapid.
-- These groups serve as long as it is unknown which motions go along the contours.
atLevels :: Machine -> Bool -> Toolpath -> [MotionGroup]
atLevels machine isFlat toolpath =
  [ MotionGroup
      { includes = isCutting (Toolpath.atHeight pass) (isJust (Part.gear milling)),
        latestBegin = maxBound,
        earliestEnd = 0,
        clearingPass = Nothing
      }
    | Toolpath.Cutting {Toolpath.job = Located _ milling, Toolpath.pass} <- Toolpath.blocks toolpath
  ]
  where
    isCutting level swivels m =
      Frame.motion (Control.frame m) /= Frame.Rapid
        && (isFlat || swivels || all (MotionSet.isSameHeight machine level) [from, to])
      where
        (from, to) = Control.height machine m

-- | Group of the motions in one pass of a pocket: those at the height of the pass, and the linking
-- moves over walls and islands. A linking move rises to the clearance height, or higher over solids
-- that the program avoids, goes there to another position in the pocket, and plunges. It stays in
-- the bounding box of the pocket. @slopes@ are the parts of the ways down; without them the cutter
-- plunges to the depth of the pass. Without heights, only the allowance of a pass shows where it
-- ends: a motion into the allowance belongs to the next pass.
inPocket ::
  Machine -> Bool -> [AvoidedSolid] -> [Slope] -> Pocket -> ClearingPass -> MotionGroup
inPocket machine isFlat solids slopes pocket pass =
  MotionGroup {includes, latestBegin = maxBound, earliestEnd = 0, clearingPass}
  where
    clearingPass = Just (Pocket.passIndex pass)
    milling = Pocket.milling pocket
    clear = Part.clearance milling
    level = Pocket.level pass
    isAt = MotionSet.isSameHeight machine
    pulse = Machine.resolutionOf machine Machine.Z
    slack = slackOf machine milling
    plungeFeed = Part.At (fromMaybe (Part.feed milling) (Part.plunge milling))
    includes m
      | isVertical =
        isInside && maybe False isBetween clear && hasPace verticalPace && (from <= to || isDown)
      | any (Descent.isOn machine slack m) slopes = isInside && hasPace plungeFeed
      | isFlat = isInside && not isRapid && (Pocket.isFinal pass || leavesAllowance s)
      | isAt level from && isAt level to = isInside && not isRapid
      | otherwise =
        maybe False (\z -> isAt z from && isAt z to || isOverSolid z) clear
          && hasPace Part.Rapid
          && all (Pocket.isOver pulse pocket) [Segment.start s, Segment.end s]
      where
        s = Control.segment machine m
        (from, to) = Control.height machine m
        isVertical = Segment.start s == Segment.end s && not (Control.isRound (Control.frame m))
        isInside = Pocket.contains pocket (Segment.at 0.5 s)
        isBetween z =
          minus level pulse <= min from to && (max from to <= plus z pulse || not (null solids))
        -- Below the pass before, a ramp or a helix leads down.
        isDown =
          isStraightDown milling || plus to pulse >= Descent.highest milling (Pocket.level pass)
        isOverSolid z = not (null solids) && from == to && from >= minus z pulse
        verticalPace = if from < to || any (to >=) clear then Part.Rapid else plungeFeed
        isRapid = hasPace Part.Rapid && not (hasPace (Part.At (Part.feed milling)))
        hasPace pace = isNothing (Feed.atPace machine pace False (Pocket.statement pocket) m)
    leavesAllowance s =
      and
        [ plus d (slackOf machine milling) >= Pocket.reach pass
          | p <- [Segment.at 0.5 s, Segment.end s],
            Just (d, _) <- [Pocket.nearestWall (Pocket.walls pocket) p]
        ]
