{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | The offset kernel: the boundary of all places where the centre of a cutter can stand beside closed contours, or on one
-- side of an open one.
module Geometry.Offset.Kernel
  ( Corners (..),
    Fault (..),
    offset,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Offset.Boxes qualified as Boxes
import Geometry.Offset.Chain qualified as Chain
import Geometry.Offset.Clip qualified as Clip
import Geometry.Offset.Crossings (Found (..))
import Geometry.Offset.Crossings qualified as Crossings
import Geometry.Offset.Loops (Loops)
import Geometry.Offset.Raw (Corners (..))
import Geometry.Offset.Raw qualified as Raw
import Geometry.Offset.Winding qualified as Winding
import Geometry.Outline (Outline)

data Fault = Crossed Int Int | Unsure
  deriving stock (Eq, Show)

-- | Positive to the right of the walk.
offset :: Mm -> [Outline] -> Either Fault Loops
offset (Mm d) outlines = case Crossings.find tol source sourceBoxes of
  Unclear -> Left Unsure
  Found xs
    | Crossings.count xs > 0 -> let (i, j) = Crossings.firstOf xs 0 in Left (Crossed i j)
    | otherwise -> case Crossings.find tol rough roughBoxes of
      Unclear -> Left Unsure
      Found ys -> maybe (Left Unsure) Right (Clip.clip tol wanted rough roughBoxes ys)
  where
    tol = 1e-14 * (Chain.extent outlines + abs d)
    chain = Chain.fromOutlines tol outlines
    (rough, source) = Raw.raw tol 1e-9 Round (const d) chain
    sourceBoxes = Boxes.boxes tol source
    roughBoxes = Boxes.boxes tol rough
    wanted = maybe 1 id (Winding.leftMore (Winding.extreme Winding.Leftmost source sourceBoxes 0))
