-- | The moves of a V-carving: along the medial axis of each area, at the depth at which the cone
-- touches the contours on both sides, or at the largest depth, beside the contours.
module Toolpath.CarvingPath
  ( moves,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus)
import Base.Region (Located (..), Region)
import Data.List (mapAccumL)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Geometry.Segment (Segment (Straight))
import Offset.MedialAxis (Branch, Disc (..), Stretch (..))
import Offset.MedialAxis qualified as MedialAxis
import Part.Part (Carving, SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.CarvingArea (CarvedArea)
import Toolpath.CarvingArea qualified as CarvingArea
import Toolpath.Error (Error (..))
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.Toolpath (CarvingRest (..), Manner (Manner), Move (Move))

-- | The moves of a V-carving, and what it leaves because its tip is too wide. @at@ is the position
-- of the tool before the statement, and @areas@ are the areas of the carving. Fails if the tip fits
-- nowhere, or if it leaves material that the program does not allow.
moves ::
  [CarvedArea] ->
  SpacePoint ->
  Located Carving ->
  Either Error (NonEmpty Move, Maybe CarvingRest)
moves areas at (Located region c) =
  case concat (snd (mapAccumL alongChain at (concatMap CarvingArea.chains areas))) of
    [] -> Left (NowhereCarved word (Part.carvingTip c))
    m : more -> case restOf (concatMap CarvingArea.rests areas) of
      Just rest
        | Part.carvingRest c == Part.Refused -> Left (CarvingLeaves word rest (Part.carvingTip c))
      rest -> Right (m :| more, rest)
  where
    word = LinkingMove.keyword 6 region
    alongChain from chain = (LinkingMove.endPosition from made, made)
      where
        made = chainMoves word c from chain

-- | All places that a tip leaves, as one with their count and the thickest of them.
restOf :: [CarvingRest] -> Maybe CarvingRest
restOf = fmap (foldr1 thicker) . NonEmpty.nonEmpty
  where
    thicker a b =
      (if thickest a >= thickest b then a else b) {restCount = restCount a + restCount b}

-- | The moves to a chain, down, along it, and up. @at@ is the position of the tool before.
chainMoves :: Region -> Carving -> SpacePoint -> NonEmpty Branch -> [Move]
chainMoves word c at chain =
  LinkingMove.rise at clear word
    <> LinkingMove.straightMoves over [Part.Stop (Located word begin) (Just clear) Part.Rapid]
    <> [vertical begin clear first (Part.At plunge)]
    <> map along (concatMap NonEmpty.toList (NonEmpty.toList chain))
    <> [vertical stop final clear Part.Rapid]
  where
    clear = Part.carvingTravel c
    over = SpacePoint (plane at) (max clear (height at))
    plunge = fromMaybe (Part.carvingFeed c) (Part.carvingPlunge c)
    feed = Part.At (Part.carvingFeed c)
    Disc begin firstRadius = MedialAxis.firstDisc (NonEmpty.head chain)
    Disc stop finalRadius = MedialAxis.lastDisc (NonEmpty.last chain)
    (first, final) = (heightAt c firstRadius, heightAt c finalRadius)
    vertical p from to pace = Move (Straight p p) (Manner (from, to) pace False) word False
    along stretch = case stretch of
      Sloping (Disc p a) (Disc q b) ->
        Move (Straight p q) (Manner (heightAt c a, heightAt c b) feed False) word False
      Level g r -> Move g (Manner (heightAt c r, heightAt c r) feed False) word False

-- | The height of the tip at which the cone has a radius at the top of the part. The radius is at
-- least that of the tip.
heightAt :: Carving -> Mm -> Mm
heightAt c r = Mm (negate wider / tan half)
  where
    Mm wider = max (Mm 0) (minus r (Part.carvingTip c))
    Rad half = Part.halfAngle c
