-- | Pockets of a toolpath as the part demands them, with the passes that clear them. The /walls/ of
-- a pocket are the elements of its outline and of its islands. The /free side/ of a wall is the
-- side on which the pocket lies. The /rim/ is the border of the region that the cutter's centre may
-- enter in the final pass, moved away from the walls by 'spareRoom'.
--
-- A statement that clears what a larger cutter has left has a rim only where it has to cut. A point
-- of the floor within that cutter's radius of a position of its centre is cleared by it, as the
-- proof of that statement shows. A position on the rim where the smaller cutter covers nothing else
-- is no part of the rim. This is worked out from the walls and from both radii by distances,
-- without the loops and chains of the toolpath. Layers that are no thicker than
-- 'Offset.Tolerance.thinnestRest' count as cleared.
module Verify.Pocket
  ( Pocket (..),
    ClearingPass (..),
    RoughedFloor (..),
    pocketsOf,
    withRimOf,
    contains,
    isOver,
    nearestWall,
    isOnFreeSide,
    isInOrder,
    spareRoom,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..), Region)
import Data.Function (on)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side (..))
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Offset.Tolerance qualified as Tolerance
import Part.Part (Element, Milling, Pocketing)
import Part.Part qualified as Part
import Toolpath.Toolpath (Block)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Edge (Edge (Edge))
import Verify.Edge qualified as Edge
import Verify.Motion (CutterMotion (segment))
import Verify.Motion qualified as Motion
import Verify.MotionSet qualified as MotionSet
import Verify.Reachability qualified as Reachability
import Verify.Requirement qualified as Requirement

-- | Pocket with its passes in the order of the toolpath.
data Pocket = Pocket
  { -- | region of the statement in the part program
    statement :: Region,
    milling :: Milling,
    -- | side of the walls on which material is removed, in the direction of travel along them
    side :: Side,
    -- | elements of the outline and of the islands, with numbers from 0
    walls :: BoxTree Edge,
    -- | bounding box of the outline
    bounds :: BoundingBox,
    -- | segments of the rim, each with the wall to which it runs parallel
    rim :: [(Element, Segment)],
    -- | distance of the rim from the walls: that of the cutter's centre in the final pass, plus
    -- 'spareRoom'
    rimDistance :: Mm,
    -- | rim at another distance from the walls
    rimAt :: Mm -> [(Element, Segment)],
    -- | floor that a larger cutter has cleared before
    roughed :: Maybe RoughedFloor,
    -- | true if the cutter faces a region and may run over its contours. The rim is then the border
    -- of the region, moved inwards by 'spareRoom'
    isSurface :: Bool,
    passes :: NonEmpty ClearingPass
  }

-- | Floor of a pocket that a larger cutter has cleared.
data RoughedFloor = RoughedFloor
  { -- | border of the positions that the centre of that cutter could take
    roughRim :: BoxTree Segment,
    -- | distance of this border from the walls
    roughRimDistance :: Mm,
    -- | distance from these positions within which the floor counts as cleared
    clearedReach :: Mm
  }

-- | Pass of a pocket at one depth.
data ClearingPass = ClearingPass
  { -- | number among all passes of the toolpath, from 0
    passIndex :: Int,
    -- | height of the cutter; the top of the part is 0
    level :: Mm,
    -- | distance of the cutter's centre from the walls
    reach :: Mm,
    -- | true if the allowance that the pass leaves is the last in the statement's list
    isFinal :: Bool,
    -- | linking moves before and after the pass
    linkingMoves :: [Segment]
  }

-- | Block of a toolpath that clears a pocket in one pass. The fields are the number of the pass
-- among all passes of the toolpath, from 0, the statement, the pass, and its linking moves.
data Clearing = Clearing Int (Located Pocketing) Toolpath.Pass [Segment]

-- | Pockets of the blocks of a toolpath. A statement that is executed twice makes two pockets.
pocketsOf :: [Block] -> [Pocket]
pocketsOf blocks = map pocketOf (NonEmpty.groupBy ((==) `on` statementNumber) clearings)
  where
    statementNumber (Clearing _ _ pass _) = Toolpath.number pass
    clearings =
      [ Clearing n pocket pass (map Toolpath.segment (approach <> retract))
        | ( n,
            Toolpath.Clearing
              { Toolpath.pocket,
                Toolpath.pass,
                Toolpath.approach,
                Toolpath.retract
              }
            ) <-
            zip (Toolpath.passNumbers blocks) blocks
      ]

-- | Pocket that one statement clears, from the blocks of its passes.
pocketOf :: NonEmpty Clearing -> Pocket
pocketOf clearings@(Clearing _ (Located statement pocketing) _ _ :| _) =
  Pocket
    { statement,
      milling,
      side,
      walls,
      bounds,
      rim,
      rimDistance,
      rimAt,
      roughed,
      isSurface,
      passes
    }
  where
    milling = Part.wall pocketing
    side = fromMaybe LeftOf (Requirement.cutterSide milling)
    contours =
      map
        (NonEmpty.toList . Part.elements)
        (Requirement.facingTheRoom (Part.contour milling) (Part.islands pocketing))
    walls = wallsOf (concat contours)
    bounds =
      foldr1
        BoundingBox.union
        (fmap (BoundingBox.ofSegment . Part.segment) (Part.elements (Part.contour milling)))
    isSurface = isJust (Part.surface pocketing)
    rimDistance
      | isSurface = spareRoom
      | otherwise = plus (Requirement.centreDistance milling lastAllowance) spareRoom
    lastAllowance = NonEmpty.last (Part.allowances milling)
    rim = rimAt rimDistance
    wholeRimAt distance = rimOf side distance walls contours
    roughed = roughedFloor wholeRimAt <$> Part.roughing pocketing
    rimAt = uncleared (Part.radius milling) roughed wholeRimAt
    passes = fmap (clearingPass milling) clearings

-- | Pass of a pocket whose wall has the given milling.
clearingPass :: Milling -> Clearing -> ClearingPass
clearingPass milling (Clearing passIndex _ pass linkingMoves) =
  ClearingPass
    { passIndex,
      level = Toolpath.atHeight pass,
      reach = Requirement.centreDistance milling (Toolpath.left pass),
      isFinal = Toolpath.left pass == NonEmpty.last (Part.allowances milling),
      linkingMoves
    }

-- | Pocket with the rim of one of its passes in place of that of the final pass.
withRimOf :: ClearingPass -> Pocket -> Pocket
withRimOf pass pocket
  | isFinal pass || isSurface pocket = pocket
  | otherwise = pocket {rim = rimAt pocket distance, rimDistance = distance}
  where
    distance = plus (reach pass) spareRoom

-- | Bounding-box tree of the elements of the walls. The proof of a pocket needs neither their arc
-- lengths nor their allowances; these are 0.
wallsOf :: [Element] -> BoxTree Edge
wallsOf elements =
  BoxTree.index
    (BoundingBox.ofSegment . Edge.shape)
    [ Edge
        { Edge.element = e,
          Edge.rank,
          Edge.startsAt = 0,
          Edge.long = 0,
          Edge.ownAllowance = Mm 0,
          Edge.continues = False,
          Edge.shape = Part.segment e
        }
      | (rank, e) <- zip [0 ..] elements
    ]

-- | Rim of a pocket at a distance from its walls. @contours@ has the elements of the outline and
-- those of each island. Each segment of the rim comes with the wall to which it runs parallel.
-- If two walls almost touch, a segment beside one of them may lie outside of the pocket, beyond the
-- other wall; such a segment is left out.
rimOf :: Side -> Mm -> BoxTree Edge -> [[Element]] -> [(Element, Segment)]
rimOf side distance walls contours =
  [ (elements Vector.! i, s)
    | (i, s) <- Reachability.rim side distance segments (map (map Part.segment) contours),
      isInside side walls (Segment.at 0.5 s)
  ]
  where
    elements = Vector.fromList (concat contours)
    segments = BoxTree.index BoundingBox.ofSegment (map Part.segment (concat contours))

-- | Floor that a larger cutter has cleared. @rimAt'@ gives the rim at a distance from the walls.
roughedFloor :: (Mm -> [(Element, Segment)]) -> Part.Roughing -> RoughedFloor
roughedFloor rimAt' roughing =
  RoughedFloor
    { roughRim = BoxTree.index BoundingBox.ofSegment (map snd (rimAt' roughRimDistance)),
      roughRimDistance,
      clearedReach = plus (Part.roughRadius roughing) Tolerance.thinnestRest
    }
  where
    roughRimDistance =
      plus (plus (Part.roughRadius roughing) (Part.roughAllowance roughing)) spareRoom

-- | Parts of a rim at which a cutter of the radius @r@ covers a point that a larger cutter has not
-- cleared; all of the rim without such a cutter. @wholeRimAt@ gives the rim at a distance from the
-- walls.
uncleared ::
  Mm ->
  Maybe RoughedFloor ->
  (Mm -> [(Element, Segment)]) ->
  Mm ->
  [(Element, Segment)]
uncleared r roughed wholeRimAt distance = case roughed of
  Nothing -> wholeRimAt distance
  Just floor'
    | distance >= roughRimDistance floor' -> []
    | otherwise ->
      [ (e, Segment.between a b s)
        | let idle = minus (clearedReach floor') r,
          (e, s) <- wholeRimAt distance,
          let box = BoundingBox.inflate idle (BoundingBox.ofSegment s),
          (a, b) <- Distance.uncovered idle (BoxTree.within box (roughRim floor')) s
      ]

-- | Extra distance of the rim from the walls. The proof demands a cut between two walls only if
-- their distance exceeds the cutter's width by twice this length. In a narrower passage the cutter
-- just fits, and rounding may prevent the toolpath from entering.
spareRoom :: Mm
spareRoom = times 3 Tolerance.clearance

-- | Test that a point lies in a pocket, or so near to a region that is faced that a cutter which
-- clears it may be there.
contains :: Pocket -> Point -> Bool
contains pocket
  | isSurface pocket = isAt (times 2.5 (Part.radius (milling pocket))) pocket
  | otherwise = isInside (side pocket) (walls pocket)

-- | Test that a point is no further than a distance from the bounding box of a pocket.
isAt :: Mm -> Pocket -> Point -> Bool
isAt distance pocket p = BoundingBox.distance p (bounds pocket) <= distance

-- | Test that the cutter may cross at a point above a pocket. @slack@ is the accuracy of a tape.
isOver :: Mm -> Pocket -> Point -> Bool
isOver slack pocket p
  | isSurface pocket = contains pocket p
  | otherwise = isAt slack pocket p

-- | Test that a point lies on the free side of the wall nearest to it; false without walls.
isInside :: Side -> BoxTree Edge -> Point -> Bool
isInside side walls p = maybe False (isOnFreeSide side walls p . snd) (nearestWall walls p)

-- | Wall nearest to a point, with its distance; Nothing without walls.
nearestWall :: BoxTree Edge -> Point -> Maybe (Mm, Edge)
nearestWall walls p =
  BoxTree.closest
    (\e -> Mm (FastDistance.distance (Edge.shape e) (Vec.x p) (Vec.y p)))
    p
    walls

-- | Test that the point @p@ lies on the free side of the wall @e@. @e@ has to be the wall nearest
-- to @p@. If the nearest point of @e@ is a corner, both walls of the corner decide.
isOnFreeSide :: Side -> BoxTree Edge -> Point -> Edge -> Bool
isOnFreeSide side walls p e = (Edge.leftwardness walls foot p > 0) == (side == LeftOf)
  where
    foot = snd (Distance.nearest p (Edge.shape e))

-- | Test that the depths of a pocket are cut one after the other, in the order of its passes. A
-- depth is cut by a horizontal motion in the pocket at that depth. The next depth has to be cut by
-- a later motion. If the cutter has less than a pulse of room in a pass, there is no such
-- horizontal motion. Then a motion down to the depth counts if the next motion goes up.
isInOrder :: Machine -> Pocket -> [CutterMotion] -> Bool
isInOrder machine pocket motions =
  go (map NonEmpty.head (NonEmpty.group (map level (NonEmpty.toList (passes pocket))))) motions
  where
    go levels later = case (levels, later) of
      ([], _) -> True
      (_, []) -> False
      (z : more, m : others)
        | cutsAt z m || goesDownTo z m && all goesUp (take 1 others) -> go more others
        | otherwise -> go levels others
    cutsAt z m = isHorizontal m && isThere z m
    goesDownTo z m = Motion.isVertical m && uncurry (>) (Motion.heights m) && isThere z m
    goesUp m = Motion.isVertical m && uncurry (<) (Motion.heights m)
    isHorizontal m = uncurry (==) (Motion.heights m) && not (Motion.isVertical m)
    isThere z m =
      MotionSet.isSameHeight machine z (snd (Motion.heights m))
        && contains pocket (Segment.at 0.5 (segment m))
