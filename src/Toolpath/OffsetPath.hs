-- | The paths of the cutter's centre beside a contour: its offset, or the parts of the offset that
-- the cutter can follow where rest material is allowed. At the breaks of pieces ("Part.Break") rest
-- material is always allowed.
--
-- Each pass of a statement computes the polyarc of the contour anew. A polyarc that the passes
-- share would stay in memory from the first pass to the last one. The function is in a module of
-- its own, so that GHC does not share the polyarc.
module Toolpath.OffsetPath
  ( paths,
  )
where

import Base.Quantity (Mm (..), plus)
import Base.Region (Located (..))
import Data.Bifunctor (bimap)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isNothing)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Offset.Equidistant qualified as Equidistant
import Part.Break qualified as Break
import Part.Part (Contour (elements), Milling (contour, radius))
import Part.Part qualified as Part
import Toolpath.Error (Error (..), Unsupported (..))
import Toolpath.MillingSide (keyword)
import Toolpath.OffsetRefusal qualified as OffsetRefusal
import Toolpath.RestMaterial qualified as RestMaterial

-- | The paths of the cutter's centre on @side@ of a contour, at the cutter's radius plus the
-- allowance. If @side@ is Nothing, the path is the contour itself. There are several paths only
-- where rest material is allowed and divides the path. The second result lists the parts of the
-- contour that the cutter does not reach. @numbered@ has the elements of the contour; the index of
-- an element is its number. @allowance@ is that of the pass, before any allowance of an element.
paths ::
  Located Milling ->
  Maybe Carrier.Side ->
  Vector Part.Element ->
  Mm ->
  Either Error (NonEmpty (NonEmpty Equidistant.OffsetSegment), [Equidistant.UnreachedPart])
paths (Located region milling) side numbered allowance = case side of
  Nothing ->
    Right
      ( NonEmpty.zipWith
          (\i e -> Equidistant.OffsetSegment (Equidistant.Along i) (Part.segment e))
          (0 :| [1 ..])
          (elements (contour milling))
          :| [],
        []
      )
  Just s -> case (Equidistant.styled style s r polyarc, Part.rest milling) of
    (Right path, _) -> Right (path :| [], [])
    (Left _, Part.Allowed)
      | Just requested <- Part.controlCompensation milling ->
        Left (NotForControl requested Unreached)
    (Left obstacle, Part.Allowed) -> case Equidistant.reachableFitting style s r polyarc of
      ([], _) -> Left (NoPathAlong (keyword milling region) (contour milling) allowance)
      (_, []) -> Left (refusal obstacle)
      (p : ps, rests) -> Right (fmap Equidistant.pieces (p :| ps), rests)
    (Left obstacle, Part.Refused)
      | not (mayLeaveAtBreaks milling) -> Left (refusal obstacle)
      | otherwise -> case Equidistant.reachableFitting style s r polyarc of
        ([], _) -> Left (refusal obstacle)
        (p : ps, rests) ->
          bimap refusal (fmap Equidistant.pieces (p :| ps),) (restsAtBreaks milling r rests)
  where
    polyarc = Part.polyarcOf (contour milling)
    r = plus (radius milling) allowance
    style =
      Equidistant.CornerStyle
        { Equidistant.sharp = Part.corners milling == Part.Sharp,
          Equidistant.extra
        }
    -- Mostly no element has an allowance of its own; then no allowance is looked up.
    extra
      | hasNoAllowances = const (Mm 0)
      | otherwise = allowanceOf . (numbered Vector.!)
    hasNoAllowances = all ((== Mm 0) . allowanceOf) numbered
    allowanceOf = Part.allowance . Part.finish
    refusal = OffsetRefusal.refusal region (RestMaterial.toolOf milling allowance) numbered

-- | The unreached parts of a contour that are listed, if all of them are at breaks of the contour:
-- those at which more material stays than the tolerance allows. Otherwise the obstacle of the first
-- part that is not at a break. @distance@ is that of the cutter's centre from the contour.
restsAtBreaks ::
  Milling ->
  Mm ->
  [Equidistant.UnreachedPart] ->
  Either Equidistant.Obstacle [Equidistant.UnreachedPart]
restsAtBreaks milling distance rests = concat <$> traverse listed rests
  where
    listed rest = case Break.isLeftAt distance breaks (Equidistant.cutterCentre rest) of
      Nothing -> Left (Equidistant.stop rest)
      Just b -> Right [rest | Break.leftMaterial distance b > tolerated]
    breaks = Break.breaksOf (contour milling)
    (_, tolerated) = Part.deviationLimits (Part.tolerance milling)

-- | True if a contour has breaks at which the cutter may leave material. It may not if the control
-- does the cutter compensation.
mayLeaveAtBreaks :: Milling -> Bool
mayLeaveAtBreaks milling =
  isNothing (Part.controlCompensation milling) && not (null (Break.breaksOf (contour milling)))
