-- | What keeps a cutter from following contours, in the words of the program.
module Toolpath.OffsetRefusal
  ( refusal,
    stays,
    shifted,
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
import Part.Part (Element)
import Part.Part qualified as Part
import Toolpath.Error (Error (ConcaveRadius), Stay (..), Tool (leaves))
import Toolpath.Error qualified as Error

-- | Why there is no path: the statement's first word, the cutter, the elements by their numbers.
refusal :: Region -> Tool -> Vector Element -> Obstacle -> Error
refusal region tool elements (Obstacle cause largest) = case cause of
  Concave i old -> ConcaveRadius region tool (elements ! i) old (fitting tool largest)
  InnerCorner i j p ->
    Error.InnerCorner region tool (elements ! i) (elements ! j) p (fitting tool largest)
  Collision i j p ->
    Error.Collision region tool (elements ! i) (elements ! j) p (fitting tool largest)

-- | What stays, place by place.
stays :: Functor f => Tool -> Vector Element -> f Equidistant.UnreachedPart -> f Stay
stays tool elements = fmap stay
  where
    stay rest = case cause (Equidistant.stop rest) of
      InnerCorner i j p -> InCorner (elements ! i) (elements ! j) p
      Concave i old -> InHollow (elements ! i) old (largest' rest)
      Collision i j _ -> case onlyCorner i j of
        -- The arcs of a curve behind a corner, or before one: no cutter comes into it, though a
        -- smaller one comes further.
        Just (a, b) | isCorner rest a b -> InCorner a b (Segment.start (Part.segment b))
        _ -> Between (elements ! i) (elements ! j) (Equidistant.middle rest) (largest' rest)
    largest' rest = fitting tool (largest (Equidistant.stop rest))
    -- Those with which a curve does not go on, and how many of them stand before each element and
    -- before the end.
    corners = Vector.findIndices (not . Part.continues) elements
    before = Vector.scanl' (\n e -> if Part.continues e then n else n + 1) 0 elements
    -- On the way from one element to another, and round the end, if there is just one.
    onlyCorner i j =
      let from = before ! (i + 1)
          around = if j < i then Vector.length corners else 0
          l = corners ! (from `mod` Vector.length corners)
       in if before ! (j + 1) - from + around == 1
            then Just (elements ! ((l - 1) `mod` Vector.length elements), elements ! l)
            else Nothing
    -- Towards the cutter.
    isCorner rest a b =
      let along = Segment.endDirection (Part.segment a)
          Rad turned = Vec.turn along (Segment.startDirection (Part.segment b))
          Rad smooth = Tolerance.smoothAngle
       in turned
            * signum
              (Vec.cross along (Vec.to (Segment.end (Part.segment a)) (Equidistant.middle rest)))
              > smooth

-- | The cutter that fits is smaller than what fits by the allowance.
fitting :: Tool -> Maybe Mm -> Maybe Mm
fitting tool largest = do
  l <- largest
  let d = minus l (leaves tool)
  if d > Mm 0 then Just d else Nothing

-- | The same with the elements behind so many others.
shifted :: Int -> Obstacle -> Obstacle
shifted n (Obstacle cause largest) = Obstacle (moved cause) largest
  where
    moved c = case c of
      Concave i old -> Concave (n + i) old
      InnerCorner i j p -> InnerCorner (n + i) (n + j) p
      Collision i j p -> Collision (n + i) (n + j) p
