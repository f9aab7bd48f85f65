{-# LANGUAGE BangPatterns #-}

-- | One pass along a contour: the moves on the equidistant, the leads, and the moves to and from
-- them.
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
import Geometry.Tolerance qualified as Tolerance
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
import Toolpath.Error (Error)
import Toolpath.Lead qualified as Lead
import Toolpath.LinkingMove (Visit (Visit))
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.MillingSide (keyword)
import Toolpath.Swivel qualified as Swivel
import Toolpath.Toolpath (Block (..), Manner (Manner), Move (Move), Pass (..))
import Toolpath.Toolpath qualified as Toolpath

-- | A pass along a contour, or along one path of several where the cutter does not reach
-- everything. The path is not kept here, so that its segments are released as moves are made.
data CuttingPass = CuttingPass
  { -- | number of the milling statement, as it is carried out, from 0
    statement :: Int,
    milled :: Located Milling,
    -- | side of the direction of travel; nothing when the centre moves on the contour
    cutterSide :: Maybe Carrier.Side,
    -- | the elements of the contour by their numbers
    numbered :: Vector Part.Element,
    isFirst :: Bool,
    isLast :: Bool,
    -- | position of the cutter before the pass
    from :: SpacePoint,
    -- | material that the pass leaves
    allowance :: Mm,
    level :: Mm,
    restMaterial :: [Equidistant.UnreachedPart]
  }

-- | The block of a pass along a path.
block :: CuttingPass -> NonEmpty OffsetSegment -> Either Error Block
block p path = do
  swivels <- Swivel.axis word milling (cutterSide p) path
  let cut = cutMoves p swivels path
      !around = Compensation.endsAtOuterCorner milling path
      -- From here on only the moves are needed.
      !firstSegment = Toolpath.segment (NonEmpty.head cut)
      !lastSegment = Toolpath.segment (NonEmpty.last cut)
      (leadIn, leadOut) = leads p around firstSegment lastSegment
      begin = maybe (Segment.start firstSegment) Segment.start (segmentOf (listToMaybe leadIn))
      finish =
        maybe (Segment.end lastSegment) Segment.end (segmentOf (listToMaybe (reverse leadOut)))
      segmentOf = fmap Toolpath.segment
      -- The axis of a blade is higher or lower.
      (inZ, outZ) = case swivels of
        Nothing -> levels p
        Just hs ->
          (plus (level p) (fst (NonEmpty.head hs)), plus (level p) (snd (NonEmpty.last hs)))
      (before, after) = case (Part.levels milling, Part.clearance milling) of
        (_ : _, Just travelHeight) ->
          LinkingMove.withDepth (visit p) travelHeight (inZ, outZ) begin finish
        _ -> LinkingMove.withoutDepth (visit p) (level p) (inZ, outZ) begin finish
      inwards = map (Toolpath.atHeights (inZ, inZ)) leadIn
      outwards = map (Toolpath.atHeights (outZ, outZ)) leadOut
  sent <-
    Compensation.compensationInput
      word
      milling
      (cutterSide p)
      PassMoves
        { Compensation.before,
          Compensation.leadIn = inwards,
          Compensation.cut,
          Compensation.leadOut = outwards,
          Compensation.behind = after
        }
  Right
    Cutting
      { job = milled p,
        pass =
          Pass
            { number = statement p,
              reach = plus (touchedRadius milling) (allowance p),
              left = allowance p,
              atHeight = level p
            },
        approach = before <> inwards,
        cut,
        retract = outwards <> after,
        rests = restMaterial p,
        sent
      }
  where
    milling = value (milled p)
    word = wordOf p

-- | The keyword of the pass's statement.
wordOf :: CuttingPass -> Region
wordOf = keyword . region . milled

-- | The heights of a pass at the start and the end of each move, without a blade.
levels :: CuttingPass -> (Mm, Mm)
levels p = (plus (level p) (Mm 0), plus (level p) (Mm 0))

-- | The pass for the moves before and after it.
visit :: CuttingPass -> Visit
visit p =
  Visit
    { LinkingMove.word = wordOf p,
      LinkingMove.milling = value (milled p),
      LinkingMove.isFirst = isFirst p,
      LinkingMove.isLast = isLast p,
      LinkingMove.from = from p
    }

-- | The moves along the contour, given the heights of a blade's axis above its middle position.
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
    -- Most moves have the same manner, and share it.
    plainly = Manner (levels p) pace False
    heights = case swivels of
      Nothing -> NonEmpty.repeat (levels p)
      Just hs -> fmap (\(a, b) -> (plus (level p) a, plus (level p) b)) hs
    following (previous :| rest) hs = case (rest, hs) of
      (piece : more, h : higher) ->
        let m = moveAlong (isContinued previous piece) h piece
         in m `seq` (m : following (piece :| more) higher)
      _ -> []
    -- A feed of its own holds on the element, not around its corners; nor does the cutter slow down
    -- there.
    moveAlong continues zs piece = case Equidistant.origin piece of
      Equidistant.Along i ->
        let finish = Part.finish (numbered p Vector.! i)
         in moved i (Part.ownFeed finish) (Part.slow finish) continues zs piece
      Equidistant.Around i -> moved i Nothing False continues zs piece
    moved i own slows continues zs piece =
      Move
        (Equidistant.segment piece)
        ( if isNothing own && not slows && null swivels
            then plainly
            else Manner zs (maybe pace Part.At own) slows
        )
        (Part.origin (numbered p Vector.! i))
        continues
    -- After an arc in which the cutter does not move there may be a corner.
    isContinued previous piece = case (Equidistant.origin previous, Equidistant.origin piece) of
      (Equidistant.Along i, Equidistant.Along j) ->
        j == i + 1 && Part.continues (numbered p Vector.! j)
      _ -> False

-- | The lead-in and the lead-out, given the first and the last segment of the path, and whether the
-- path ends with the arc about a corner.
leads :: CuttingPass -> Bool -> Segment -> Segment -> ([Move], [Move])
leads p around firstSegment lastSegment = (leadIn, leadOut)
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
      [] | around -> Compensation.overrun (wordOf p) milling firstSegment
      moves -> moves
    -- A cutter that fills a concave arc does not move in it; then the contour gives the direction.
    directionOf :: (Segment -> Vec.Vec) -> Segment -> Part.Element -> Vec.Vec
    directionOf direction s e =
      direction (if Segment.length s > Tolerance.coincident then s else Part.segment e)

-- | The distance of the cutter's centre from the contour when nothing is left.
touchedRadius :: Milling -> Mm
touchedRadius milling = case value (Part.side milling) of
  On -> Mm 0
  Outside -> radius milling
  Inside -> radius milling
  LeftSide -> radius milling
  RightSide -> radius milling
