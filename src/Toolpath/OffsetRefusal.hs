-- | Reasons why a cutter cannot follow contours, expressed in elements of the part program.
--
-- An /obstacle/ is such a reason in the form that "Offset.Equidistant" gives: it names elements by
-- numbers.
module Toolpath.OffsetRefusal
  ( refusal,
    restPositions,
    renumbered,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus)
import Base.Region (Region)
import Data.Vector (Vector, (!))
import Data.Vector qualified as Vector
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Offset.Equidistant (Cause (..), Obstacle (..))
import Offset.Equidistant qualified as Equidistant
import Part.Break (Break)
import Part.Break qualified as Break
import Part.Part (Element)
import Part.Part qualified as Part
import Toolpath.Error (Error (ConcaveRadius), RestPosition (..), Tool (leaves))
import Toolpath.Error qualified as Error

-- | The error for an obstacle. @region@ is the region of the statement's first word. The index of
-- an element in @elements@ is the number by which the obstacle names it.
refusal :: Region -> Tool -> Vector Element -> Obstacle -> Error
refusal region tool elements (Obstacle cause largest) = case cause of
  Concave i old -> ConcaveRadius region tool (elements ! i) old (fitting tool largest)
  InnerCorner i j p ->
    Error.InnerCorner region tool (elements ! i) (elements ! j) p (fitting tool largest) False
  Collision i j p ->
    Error.Collision region tool (elements ! i) (elements ! j) p (fitting tool largest)

-- | The rest material, one entry for each unreached part of the contour. The index of an element in
-- @elements@ is the number by which the unreached parts name it. @breaks@ are the breaks of the
-- contour, and @distance@ is that of the cutter's centre from it.
restPositions ::
  Functor f =>
  Tool ->
  Mm ->
  [Break] ->
  Vector Element ->
  f Equidistant.UnreachedPart ->
  f RestPosition
restPositions tool distance breaks elements = fmap restPosition
  where
    restPosition rest = case Break.isLeftAt distance breaks (Equidistant.cutterCentre rest) of
      Just b -> AtBreak (Break.before b) (Break.vertex b) (Break.leftMaterial distance b)
      Nothing -> elsewhere rest
    elsewhere rest = case cause (Equidistant.stop rest) of
      InnerCorner i j p -> InCorner (elements ! i) (elements ! j) p
      Concave i old -> InConcaveArc (elements ! i) old (largest' rest)
      Collision i j _ -> case onlyCorner i j of
        -- Here a corner lies between the elements @i@ and @j@. No round cutter reaches into the
        -- corner, so the report names no largest cutter.
        Just (a, b) | isCorner rest a b -> InCorner a b (Segment.start (Part.segment b))
        _ -> Between (elements ! i) (elements ! j) (Equidistant.cutterCentre rest) (largest' rest)
    largest' rest = fitting tool (largest (Equidistant.stop rest))
    -- @corners@: the numbers of the elements that do not continue the curve of the element before,
    -- so that a corner may be at their start. @cornersBefore@: for each element, the count of
    -- @corners@ before it; at the end, the count of all @corners@.
    corners = Vector.findIndices (not . Part.continues) elements
    cornersBefore = Vector.scanl' (\n e -> if Part.continues e then n else n + 1) 0 elements
    -- The two elements that meet at the corner between the elements @i@ and @j@, if exactly one
    -- corner lies between them. If @j@ is less than @i@, the end of a closed contour lies between
    -- them.
    onlyCorner i j =
      let from = cornersBefore ! (i + 1)
          around = if j < i then Vector.length corners else 0
          l = corners ! (from `mod` Vector.length corners)
       in if cornersBefore ! (j + 1) - from + around == 1
            then Just (elements ! ((l - 1) `mod` Vector.length elements), elements ! l)
            else Nothing
    -- True for a corner that turns towards the cutter.
    isCorner rest a b =
      let along = Segment.endDirection (Part.segment a)
          Rad deflection = Vec.signedAngle along (Segment.startDirection (Part.segment b))
          Rad smooth = Tolerance.smoothAngle
       in deflection
            * signum
              ( Vec.cross
                  along
                  (Vec.to (Segment.end (Part.segment a)) (Equidistant.cutterCentre rest))
              )
              > smooth

-- | The radius of the largest cutter that fits. It is @largest@, the largest possible distance of
-- the centre from the contour, minus the allowance. Nothing when @largest@ is unknown or the radius
-- is not positive.
fitting :: Tool -> Maybe Mm -> Maybe Mm
fitting tool largest = do
  l <- largest
  let d = minus l (leaves tool)
  if d > Mm 0 then Just d else Nothing

-- | Adds @n@ to the element numbers of an obstacle.
renumbered :: Int -> Obstacle -> Obstacle
renumbered n (Obstacle cause largest) = Obstacle (moved cause) largest
  where
    moved c = case c of
      Concave i old -> Concave (n + i) old
      InnerCorner i j p -> InnerCorner (n + i) (n + j) p
      Collision i j p -> Collision (n + i) (n + j) p
