-- | Random regions for boolean operations: on a grid, with arcs, and with noise.
module Generate.Operands
  ( Operands (..),
    OperandFamily (..),
    operands,
  )
where

import Data.List.NonEmpty qualified as NonEmpty
import Generate.Outline (Case (..))
import Generate.Outline qualified as Outline
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Offset.RegionBoolean qualified as RegionBoolean
import Test.QuickCheck

-- | Three regions of one family.
data Operands = Operands {family :: OperandFamily, first, second, third :: [Polyarc]}
  deriving stock (Eq, Show)

-- | The kind of regions: on integer or half-integer coordinates; with arcs; with random vertices,
-- or with integer ones that noise has moved.
data OperandFamily = OnGrid | WithArcs | WithNoise
  deriving stock (Eq, Show, Enum, Bounded)

operands :: Gen Operands
operands = do
  family <- elements [minBound .. maxBound]
  let one = case family of
        OnGrid -> Outline.onIntegers >>= moved onGrid
        WithArcs ->
          frequency [(2, Outline.withArcs), (1, Outline.onIntegers)] >>= moved anywhere
        WithNoise ->
          oneof
            [Outline.noisy >>= moved anywhere, Outline.onIntegers >>= moved onGrid >>= noise]
  Operands family <$> valid one <*> valid one <*> valid one
  where
    onGrid = elements (map (/ 2) [-4 .. 4])
    anywhere = oneof [onGrid, choose (-3, 3)]
    moved by c = do
      v <- (,) <$> by <*> by
      pure (map (Outline.turned 1 0 v) (outlines c))

-- | The loops with all vertices moved a little.
noise :: [FlatPolyarc] -> Gen [FlatPolyarc]
noise loops = do
  size <- (10 **) . negate <$> choose (6, 15 :: Double)
  mapM (fmap Outline.loop . mapM (shaken size) . FlatPolyarc.vertices) (take 1 loops)
  where
    shaken size (x, y, b) = do
      dx <- choose (-size, size)
      dy <- choose (-size, size)
      pure (x + dx, y + dy, b)

-- | A region whose loops have it on their left. Loops that cross themselves are not taken.
valid :: Gen [FlatPolyarc] -> Gen [Polyarc]
valid gen = do
  loops <- map polyarcOf <$> gen
  case loops of
    [loop] -> case RegionBoolean.oriented loop of
      Right (Just sound) -> pure [sound]
      _ -> valid gen
    _ -> pure loops
  where
    polyarcOf o = Polyarc Closed (NonEmpty.fromList (FlatPolyarc.segments o))
