-- | One pass along a contour: the moves on the offset of the contour, the lead-in and the lead-out,
-- and the approach and the retract.
--
-- The /path/ of a pass is that offset or a part of it, or the contour itself if the cutter's centre
-- moves on the contour. A /blade/ is a tool that swivels along a contour. The machine's z axis does
-- not lift a blade but turns it, so z changes along the path ("Toolpath.Swivel").
module Toolpath.CuttingPass
  ( CuttingPass (..),
    block,
    touchedRadius,
  )
where

import Base.Quantity (Mm (..), plus)
import Base.Region (Located (..), Region)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isNothing, listToMaybe)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Geometry
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Equidistant (OffsetSegment)
import Offset.Equidistant qualified as Equidistant
import Part.Part
  ( Contour (elements),
    Milling (contour, feed, radius),
    Side (..),
    SpacePoint,
  )
import Part.Part qualified as Part
import Toolpath.Compensation (PassMoves (PassMoves))
import Toolpath.Compensation qualified as Compensation
import Toolpath.Descent (Way)
import Toolpath.Descent qualified as Descent
import Toolpath.DescentChoice qualified as DescentChoice
import Toolpath.Error (Error)
import Toolpath.Lead qualified as Lead
import Toolpath.LinkingMove (Visit (Visit))
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.MillingSide (keyword)
import Toolpath.Swivel qualified as Swivel
import Toolpath.Tab (Tab)
import Toolpath.Tab qualified as Tab
import Toolpath.Tolerance qualified as Tolerance
import Toolpath.Toolpath (Block (..), Manner (Manner), Move (Move), Pass (..))
import Toolpath.Toolpath qualified as Toolpath

-- | A pass along a contour, or along one of several paths beside a contour that the cutter does not
-- reach everywhere. The path itself is no field, so that the garbage collector frees its segments
-- while moves are made from them.
data CuttingPass = CuttingPass
  { -- | number of the milling statement in the order of execution, from 0
    statement :: Int,
    milled :: Located Milling,
    -- | side of the contour, in the direction of travel, on which the cutter moves; Nothing when
    -- its centre moves on the contour
    cutterSide :: Maybe Carrier.Side,
    -- | the elements of the contour; the index of an element is its number, from 0
    numbered :: Vector Part.Element,
    -- | true for the first path of the statement's first pass
    isFirst :: Bool,
    -- | true for the last path of the statement's last pass
    isLast :: Bool,
    -- | position of the cutter before the pass
    from :: SpacePoint,
    -- | thickness of the material that the pass leaves on the contour
    allowance :: Mm,
    -- | height of the pass; the top of the part is 0
    level :: Mm,
    -- | height down to which the material is cut before the pass: that of the pass before it with
    -- the same allowance, or the height at which the material begins
    above :: Mm,
    -- | positions of the cutter's centre in the middles of the statement's tabs
    tabCentres :: [Point],
    -- | parts of the contour that the cutter does not reach; only the first of several paths has
    -- them, the others have none
    restMaterial :: [Equidistant.UnreachedPart]
  }

-- | The part of the toolpath for a pass along a path: the moves to the contour, along it and away
-- from it, and the input for a control with cutter compensation, if the program asks for that.
-- Fails when a blade or a control with cutter compensation cannot make the pass.
block :: CuttingPass -> NonEmpty OffsetSegment -> Either Error Block
block p path = do
  swivels <- Swivel.axis word milling (cutterSide p) path
  let cut = cutMoves p swivels path
      raisedOver = tabsOn p path
  way <- DescentChoice.alongContour milling (reachOf p) (above p, level p) (fmap segmentOf path)
  blockOf p swivels way raisedOver cut (pathEnds milling path cut)
  where
    milling = value (milled p)
    word = wordOf p
    segmentOf = Equidistant.segment

-- | The tabs over which the cutter rises in a pass along a path; none above their top.
tabsOn :: CuttingPass -> NonEmpty OffsetSegment -> [Tab]
tabsOn p path = case Part.tabs (value (milled p)) of
  Just (Located _ t)
    | level p < Part.tabTop t ->
      Tab.onPath
        t
        (Part.radius (value (milled p)), level p)
        (plus (largestAllowance (value (milled p))) Tolerance.alongTabs)
        (tabCentres p)
        (fmap Equidistant.segment path)
  _ -> []

-- | The largest allowance of the passes of a milling.
largestAllowance :: Milling -> Mm
largestAllowance = maximum . Part.allowances

-- | Distance of the cutter's centre from the contour in a pass.
reachOf :: CuttingPass -> Mm
reachOf p = plus (touchedRadius (value (milled p))) (allowance p)

-- | The ends of the path of a pass. The fields are strict. Computing @lastSegment@ makes all moves
-- along the path. After that, the path itself is not needed any more.
data PathEnds = PathEnds
  { -- | true when the control does the compensation and the path ends with the arc round a corner
    endsAtCorner :: Bool,
    firstSegment :: Segment,
    lastSegment :: Segment
  }

-- | The ends of a path, given the moves along it.
pathEnds :: Milling -> NonEmpty OffsetSegment -> NonEmpty Move -> PathEnds
pathEnds milling path cut =
  PathEnds
    { endsAtCorner = Compensation.endsAtOuterCorner milling path,
      firstSegment = Toolpath.segment (NonEmpty.head cut),
      lastSegment = Toolpath.segment (NonEmpty.last cut)
    }

-- | The block of a pass. @way@ is the way down; Nothing if the cutter goes straight down. @tabs@
-- are those over which it rises. @swivels@ has, for the start and the end of each segment of the
-- path, the height of the z axis above its middle position; Nothing without a blade. @cut@ has the
-- moves along the contour. The strict @ends@ of the path are computed before the block, so the
-- block keeps no reference to the path.
blockOf ::
  CuttingPass ->
  Maybe (NonEmpty (Mm, Mm)) ->
  Maybe Way ->
  [Tab] ->
  NonEmpty Move ->
  PathEnds ->
  Either Error Block
blockOf p swivels way raisedOver cut ends@PathEnds {} = do
  sent <- Compensation.compensationInput word milling (cutterSide p) passMoves
  Right
    Cutting
      { job = milled p,
        pass =
          Pass
            { number = statement p,
              reach = reachOf p,
              left = allowance p,
              atHeight = level p
            },
        approach =
          Compensation.before passMoves
            <> (if null descent then Compensation.leadIn passMoves else []),
        descent,
        cut = if null raisedOver then cut else Tab.raisedAlong raisedOver down cut,
        tabs = map Tab.centre raisedOver,
        retract = Compensation.leadOut passMoves <> Compensation.behind passMoves,
        rests = restMaterial p,
        sent
      }
  where
    milling = value (milled p)
    word = wordOf p
    passMoves = allMoves p swivels (raisedEntry p raisedOver <$> way) cut ends
    down = LinkingMove.descentPace milling
    descent = maybe [] (descentMoves p raisedOver passMoves) way

-- | A way down whose entry is above the tab over which it begins.
raisedEntry :: CuttingPass -> [Tab] -> Way -> Way
raisedEntry p raisedOver way = case slopeOver p raisedOver way of
  m : _ -> way {Descent.entryHeight = fst (Toolpath.heights m)}
  [] -> way

-- | The moves of a way down, raised over the tabs.
slopeOver :: CuttingPass -> [Tab] -> Way -> [Move]
slopeOver p raisedOver =
  concatMap raised . NonEmpty.toList . LinkingMove.slopeMoves (wordOf p) milling
  where
    milling = value (milled p)
    raised (places, m) = case places of
      Just along ->
        NonEmpty.toList (Tab.raised raisedOver (LinkingMove.descentPace milling) along m)
      Nothing -> [m]

-- | The moves of a way down, raised over the tabs, and those from its end to the cut.
descentMoves :: CuttingPass -> [Tab] -> PassMoves -> Way -> [Move]
descentMoves p raisedOver passMoves way = slope <> link <> Compensation.leadIn passMoves
  where
    milling = value (milled p)
    slope = slopeOver p raisedOver way
    link =
      LinkingMove.straightMoves
        (LinkingMove.endPosition (from p) slope)
        [ Part.Stop
            (Located (wordOf p) begin)
            (Just (plus (level p) (Mm 0)))
            (Part.At (feed milling))
        ]
    begin = case Compensation.leadIn passMoves of
      m : _ -> Segment.start (Toolpath.segment m)
      [] -> Segment.start (Toolpath.segment (NonEmpty.head (Compensation.cut passMoves)))

-- | All moves of a pass. @swivels@ has, for the start and the end of each segment of the path, the
-- height of the z axis above its middle position; Nothing without a blade. @cut@ has the moves
-- along the contour, and @ends@ the ends of the path.
allMoves ::
  CuttingPass ->
  Maybe (NonEmpty (Mm, Mm)) ->
  Maybe Way ->
  NonEmpty Move ->
  PathEnds ->
  PassMoves
allMoves p swivels way cut ends =
  PassMoves
    { Compensation.before,
      Compensation.leadIn = map (Toolpath.atHeights (inZ, inZ)) leadIn,
      Compensation.cut,
      Compensation.leadOut = map (Toolpath.atHeights (outZ, outZ)) leadOut,
      Compensation.behind
    }
  where
    milling = value (milled p)
    (leadIn, leadOut) = leads p ends
    begin = Segment.start (maybe (firstSegment ends) Toolpath.segment (listToMaybe leadIn))
    finish = Segment.end (maybe (lastSegment ends) Toolpath.segment (listToMaybe (reverse leadOut)))
    -- The heights at the start and at the end of the path. They may differ if the z axis turns a
    -- blade.
    (inZ, outZ) = case swivels of
      Nothing -> levels p
      Just hs -> (plus (level p) (fst (NonEmpty.head hs)), plus (level p) (snd (NonEmpty.last hs)))
    (before, behind) = case (Part.levels milling, Part.clearance milling) of
      (_ : _, Just travelHeight) ->
        LinkingMove.withDepth (visit p) travelHeight (inZ, outZ) way begin finish
      _ -> LinkingMove.withoutDepth (visit p) (level p) (inZ, outZ) begin finish

-- | The region of the first word of the pass's statement.
wordOf :: CuttingPass -> Region
wordOf p = let Located at milling = milled p in keyword milling at

-- | The heights at the start and at the end of each move of a pass without a blade. Both are the
-- height of the pass.
levels :: CuttingPass -> (Mm, Mm)
levels p = (plus (level p) (Mm 0), plus (level p) (Mm 0))

-- | The facts of a pass that its linking moves depend on.
visit :: CuttingPass -> Visit
visit p =
  Visit
    { LinkingMove.word = wordOf p,
      LinkingMove.milling = value (milled p),
      LinkingMove.isFirst = isFirst p,
      LinkingMove.isLast = isLast p,
      LinkingMove.from = from p
    }

-- | The moves along the contour, one for each segment of the path. @swivels@ gives, for the start
-- and the end of each segment, the height of the z axis above its middle position; Nothing without
-- a blade.
cutMoves ::
  CuttingPass ->
  Maybe (NonEmpty (Mm, Mm)) ->
  NonEmpty OffsetSegment ->
  NonEmpty Move
cutMoves p swivels path =
  moveAlong False (NonEmpty.head heights) (NonEmpty.head path)
    :| following path (NonEmpty.tail heights)
  where
    milling = value (milled p)
    pace = Part.At (feed milling)
    -- Most moves have these heights and this feed, and share one record of them.
    shared = Manner (levels p) pace False
    heights = case swivels of
      Nothing -> NonEmpty.repeat (levels p)
      Just hs -> fmap (\(a, b) -> (plus (level p) a, plus (level p) b)) hs
    following (previous :| rest) hs = case (rest, hs) of
      (current : more, zs : others) ->
        let m = moveAlong (isContinued previous current) zs current
         in m `seq` (m : following (current :| more) others)
      _ -> []
    -- The feed of an element and its braking apply to the segment along it, not to the arc round
    -- the corner after it.
    moveAlong continues zs current = case Equidistant.origin current of
      Equidistant.Along i ->
        let finish = Part.finish (numbered p Vector.! i)
         in moved i (Part.ownFeed finish) (Part.slow finish) continues zs current
      Equidistant.Around i -> moved i Nothing False continues zs current
    moved i own isBraking continues zs current =
      Move
        (Equidistant.segment current)
        ( if isNothing own && not isBraking && null swivels
            then shared
            else Manner zs (maybe pace Part.At own) isBraking
        )
        (Part.origin (numbered p Vector.! i))
        continues
    -- The offset of a concave arc may vanish. Then the segments of the elements before and after
    -- the arc meet at a corner. So only elements with consecutive numbers continue one curve.
    isContinued previous current = case (Equidistant.origin previous, Equidistant.origin current) of
      (Equidistant.Along i, Equidistant.Along j) ->
        j == i + 1 && Part.continues (numbered p Vector.! j)
      _ -> False

-- | The lead-in and the lead-out at the ends of the path. The program may ask for no lead-out; if
-- 'endsAtCorner' is true, an overrun then takes its place.
leads :: CuttingPass -> PathEnds -> ([Move], [Move])
leads p PathEnds {endsAtCorner, firstSegment, lastSegment} = (leadIn, leadOut)
  where
    milling = value (milled p)
    lead = Lead.lead (wordOf p) milling (cutterSide p)
    written = elements (contour milling)
    leadIn =
      lead
        Lead.In
        (directionOf Segment.startDirection firstSegment (NonEmpty.head written))
        (Segment.start firstSegment)
    leadOut = case lead
      Lead.Out
      (directionOf Segment.endDirection lastSegment (NonEmpty.last written))
      (Segment.end lastSegment) of
      [] | endsAtCorner -> Compensation.overrun (wordOf p) milling firstSegment
      moves -> moves
    -- In a concave arc of the cutter's radius the centre does not move, and the segment @s@ has no
    -- length. Then the result is the direction of the element @e@.
    directionOf :: (Segment -> Vec.Vec) -> Segment -> Part.Element -> Vec.Vec
    directionOf direction s e =
      direction (if Segment.length s > Geometry.coincident then s else Part.segment e)

-- | The distance of the cutter's centre from the contour in a pass without an allowance: 0 when the
-- centre moves on the contour, else the radius.
touchedRadius :: Milling -> Mm
touchedRadius milling = case value (Part.side milling) of
  On -> Mm 0
  Outside -> radius milling
  Inside -> radius milling
  LeftSide -> radius milling
  RightSide -> radius milling
