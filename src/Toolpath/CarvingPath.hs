-- | The moves of a V-carving: along the medial axis of each area, at the depth at which the cone
-- touches the contours on both sides, or at the largest depth, beside the contours.
module Toolpath.CarvingPath
  ( moves,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus, times)
import Base.Region (Located (..), Region)
import Data.List (mapAccumL)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, mapMaybe)
import Geometry.ArcFitting.PolyarcFit qualified as PolyarcFit
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.MedialAxis (Branch, Disc (..), Stretch (..))
import Offset.MedialAxis qualified as MedialAxis
import Part.Part (Carving, SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.CarvingChain qualified as CarvingChain
import Toolpath.Error (Error (..))
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.Tolerance qualified as Tolerance
import Toolpath.Toolpath (CarvingRest (..), Manner (Manner), Move (Move))

-- | The moves of a V-carving, and what it leaves because its tip is too wide. @at@ is the position
-- of the tool before the statement. Fails if the tip fits nowhere, or if it leaves material that
-- the program does not allow.
moves :: SpacePoint -> Located Carving -> Either Error (NonEmpty Move, Maybe CarvingRest)
moves at (Located region c) = case concat (snd (mapAccumL alongChain at chains)) of
  [] -> Left (NowhereCarved word (Part.carvingTip c))
  m : more -> case restOf c axes of
    Just rest
      | Part.carvingRest c == Part.Refused -> Left (CarvingLeaves word rest (Part.carvingTip c))
    rest -> Right (m :| more, rest)
  where
    word = LinkingMove.keyword 6 region
    axes = map (axisOf c) (NonEmpty.toList (Part.carvedAreas c))
    deep = map (concatMap (CarvingChain.deepParts (Part.carvingTip c))) axes
    chains = concatMap CarvingChain.chains deep
    alongChain from chain = (LinkingMove.endPosition from made, made)
      where
        made = chainMoves word c from chain

-- | The medial axis of an area, for discs up to the radius of the cone at the largest depth.
axisOf :: Carving -> (Part.Contour, [Part.Contour]) -> [Branch]
axisOf c (outline, holes) =
  MedialAxis.branches (Mm (Tolerance.axisShare * limit)) (Part.carvingReach c) loops
  where
    loops = fmap (PolyarcFit.simplified allowed . Part.polyarcOf) (outline :| holes)
    allowed = times Tolerance.contourShare (Mm limit)
    Mm limit = uncurry min (Part.deviationLimits (Part.carvingTolerance c))

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

-- | The material in corners and narrow places of the areas that the tip leaves: the count of such
-- places that are thicker than the tolerance, and the thickest of them. Nothing if there is none.
restOf :: Carving -> [[Branch]] -> Maybe CarvingRest
restOf c axes = foldr1 thicker <$> NonEmpty.nonEmpty (map single (filter isThick found))
  where
    found = mapMaybe (narrowest (Part.carvingTip c)) (concat axes)
    limit = uncurry max (Part.deviationLimits (Part.carvingTolerance c))
    isThick (thickness, _) = thickness > limit
    single (thickness, p) = CarvingRest {restCount = 1, thickest = thickness, restAt = p}
    thicker a b =
      (if thickest a >= thickest b then a else b) {restCount = restCount a + restCount b}

-- | The thickness of what a tip of some radius leaves along a branch, and the point there. The
-- discs that are smaller than the tip go beyond the nearest one as large as the tip by this
-- thickness. If all are smaller, it is the diameter of the largest one.
narrowest :: Mm -> Branch -> Maybe (Mm, Point)
narrowest tip branch = case (filter isNarrow discs, ends) of
  ([], _) -> Nothing
  (small, []) -> Just (largest [(times 2 (discRadius d), discCentre d) | d <- small])
  (small, _) -> Just (largest [(minimum (map (beyond d) ends), discCentre d) | d <- small])
  where
    discs = MedialAxis.firstDisc branch : map final (NonEmpty.toList branch)
    final s = MedialAxis.lastDisc (s :| [])
    isNarrow d = discRadius d < tip
    ends =
      concat
        [ [MedialAxis.firstDisc b, MedialAxis.lastDisc b]
          | b <- CarvingChain.deepParts tip branch
        ]
    beyond (Disc p r) (Disc q _) = minus (plus (Vec.distance p q) r) tip
    largest = foldr1 (\a b -> if fst a >= fst b then a else b)
