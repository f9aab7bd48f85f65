-- | Moves and groups of motions that a program asks for, in order. "Verify.MotionMatch" compares
-- the motions of a tape with them.
--
-- A /group/ is a pass along a contour, or one pass of a pocket. Its motions are not single moves:
-- other comparisons examine them. Moves and groups together are called /items/.
module Verify.RequiredMove
  ( RequiredMove (..),
    MotionGroup (..),
    RequiredItem (..),
    itemsOf,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..), Region)
import Control.Motion (Motion)
import Control.Motion qualified as Control
import Data.IntSet qualified as IntSet
import Data.List (find, foldl', mapAccumL)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isNothing)
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part (Drilling, Milling, Pace, SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.Toolpath (Move, Sent, Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Deviation (MillingPass (..))
import Verify.Deviation qualified as Deviation
import Verify.Feed qualified as Feed
import Verify.MillingJob (MillingJob (..))
import Verify.Motion qualified as Motion
import Verify.MotionSet qualified as MotionSet
import Verify.Pocket (ClearingPass, Pocket)
import Verify.Pocket qualified as Pocket

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
    earliestEnd :: Int
  }

-- | Item of the sequence that the program asks for.
data RequiredItem
  = Single RequiredMove
  | Several MotionGroup

-- | Items of a toolpath. @isFlat@ is true if the whole toolpath is at the height of its start; the
-- heights in pockets are then not compared. @passes@ are the passes along contours as they were
-- found on the tape, one for each block that cuts a contour; @pockets@ are the pockets of the
-- blocks. The moves of a hole come from the drilling statement, all other single moves from the
-- toolpath.
itemsOf :: Machine -> Bool -> [MillingPass] -> [Pocket] -> Toolpath -> [RequiredItem]
itemsOf machine isFlat passes pockets toolpath =
  concat
    ( snd
        ( mapAccumL
            itemsOfBlock
            (passes, clearings)
            (zip (beginnings toolpath) (Toolpath.blocks toolpath))
        )
    )
  where
    clearings = [(pocket, p) | pocket <- pockets, p <- NonEmpty.toList (Pocket.passes pocket)]
    pulse = Machine.planeResolution machine
    -- The state has the passes and the clearings of this block and of the later ones.
    itemsOfBlock left@(along, clearing) (begin, block) = case block of
      Toolpath.Travelling _ ms -> (left, singles pulse ms)
      Toolpath.Holing drilling _ -> (left, map Single (holeMoves pulse begin drilling))
      Toolpath.Commanding _ -> (left, [])
      Toolpath.Cutting {Toolpath.job, Toolpath.sent = Just s} ->
        ((drop 1 along, clearing), singles (slackOf machine (value job)) (edgeMoves s))
      Toolpath.Cutting {Toolpath.job, Toolpath.approach, Toolpath.retract} ->
        let around = singles (slackOf machine (value job))
            cut = map (Several . alongContour) (take 1 along)
         in ((drop 1 along, clearing), around approach <> cut <> around retract)
      Toolpath.Clearing {Toolpath.pocket, Toolpath.approach, Toolpath.retract} ->
        let around = singles (slackOf machine (Part.wall (value pocket)))
            cleared = map (Several . uncurry (inPocket machine isFlat)) (take 1 clearing)
         in ((along, drop 1 clearing), around approach <> cleared <> around retract)

-- | Positions of the cutter at the beginnings of the blocks of a toolpath.
beginnings :: Toolpath -> [SpacePoint]
beginnings toolpath = scanl after (value (Toolpath.start toolpath)) (Toolpath.blocks toolpath)
  where
    after at = foldl' (\_ m -> endOf m) at . Toolpath.moves
    endOf m = SpacePoint (Segment.end (Toolpath.segment m)) (snd (Toolpath.heights m))

-- | Moves of a drilling statement, as the manual describes them (docs/language.md, "Drilling"). The
-- drill goes from hole to hole in rapid at the clearance height. In a hole it goes down at the feed
-- of the statement, and rises in rapid to the clearance height. With pecks it goes down in equal
-- steps, none deeper than the peck. It returns in rapid to 0.5 mm above the end of the step before,
-- but not above the clearance height. @begin@ is the drill's position before the statement. @slack@
-- is the largest distance in mm of a motion from its move, in the plane.
holeMoves :: Mm -> SpacePoint -> Located Drilling -> [RequiredMove]
holeMoves slack begin (Located statement drilling) =
  [vertical statement at (height begin, clear) Part.Rapid | height begin < clear]
    <> concat (zipWith hole (SpacePoint at (max clear (height begin)) : overHoles) holes)
  where
    at = plane begin
    clear = Part.travelHeight drilling
    holes = NonEmpty.toList (Part.holes drilling)
    overHoles = map (\(Located _ p) -> SpacePoint p clear) holes
    hole (SpacePoint from z) (Located region p) =
      move region (Straight from p) (z, clear) Part.Rapid :
      concat (zipWith (step region p) (clear : map returning steps) steps)
    step region p from to =
      [ vertical region p (clear, from) Part.Rapid,
        vertical region p (from, to) (Part.At (Part.drillFeed drilling)),
        vertical region p (to, clear) Part.Rapid
      ]
    returning z = min clear (plus z (Mm 0.5))
    steps = [times (fromIntegral k / fromIntegral count) (Part.bottom drilling) | k <- [1 .. count]]
    count = maybe 1 (stepCount (Part.bottom drilling)) (Part.peckDepth drilling)
    vertical region p = move region (Straight p p)
    move origin path between pace =
      RequiredMove {path, between, slack, pace, slows = False, origin}

-- | Least number of equal steps down to a depth, none of them deeper than the peck; 10000 at most.
stepCount :: Mm -> Mm -> Int
stepCount (Mm bottom) (Mm peck) = max 1 (min 10000 (ceiling (-bottom / peck - Tolerance.equal)))

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
slackOf machine milling =
  plus
    (uncurry max (Part.deviationLimits (Part.tolerance milling)))
    (Machine.planeResolution machine)

-- | Group of the motions along a contour. The first motions may also belong to the approach, as
-- long as they stay at the start of the cut. The last motions may also belong to the retract if
-- they stay at the end of the cut.
alongContour :: MillingPass -> MotionGroup
alongContour MillingPass {job, found} =
  MotionGroup
    { includes = \m -> IntSet.member (Control.number m) members,
      latestBegin = maybe maxBound Motion.number (find isAwayFromEntry along),
      earliestEnd = maybe 0 ((+ 1) . Motion.number) (find isAwayFromExit (reverse along))
    }
  where
    along = filter (not . Motion.isVertical) (Deviation.motionsAlong found)
    members = IntSet.fromList (map Motion.number along)
    isAwayFromEntry = isAwayFrom (entry job) (allowance job)
    isAwayFromExit = isAwayFrom (exit job) (exitTolerance job)
    isAwayFrom p limit m =
      any
        (\k -> Vec.distance p (Segment.at k (Motion.segment m)) > limit)
        [0, 0.5, 1]

-- | Group of the motions in one pass of a pocket: those at the height of the pass, and the linking
-- moves over walls and islands. A linking move rises to the clearance height, goes there to another
-- position in the pocket, and plunges.
inPocket :: Machine -> Bool -> Pocket -> ClearingPass -> MotionGroup
inPocket machine isFlat pocket pass =
  MotionGroup {includes, latestBegin = maxBound, earliestEnd = 0}
  where
    milling = Pocket.milling pocket
    clear = Part.clearance milling
    level = Pocket.level pass
    isAt = MotionSet.isSameHeight machine
    pulse = Machine.resolutionOf machine Machine.Z
    plungeFeed = Part.At (fromMaybe (Part.feed milling) (Part.plunge milling))
    includes m
      | isVertical = isInside && any isBetween clear && hasPace verticalPace
      | isFlat || isAt level from && isAt level to = isInside && not isRapid
      | otherwise = any (\z -> isAt z from && isAt z to) clear && hasPace Part.Rapid
      where
        s = Control.segment machine m
        (from, to) = Control.height machine m
        isVertical = Segment.start s == Segment.end s && not (Control.isRound (Control.frame m))
        isInside = Pocket.contains pocket (Segment.at 0.5 s)
        isBetween z = minus level pulse <= min from to && max from to <= plus z pulse
        verticalPace = if from < to then Part.Rapid else plungeFeed
        isRapid = hasPace Part.Rapid && not (hasPace (Part.At (Part.feed milling)))
        hasPace pace = isNothing (Feed.atPace machine pace False (Pocket.statement pocket) m)
