-- | Boxes round the runs of a chain: what they let through.
module Geometry.Index.SegmentTreeSpec (spec) where

import Control.Monad.ST (runST)
import Data.Primitive.MutVar (modifyMutVar', newMutVar, readMutVar)
import Data.Primitive.PrimArray (indexPrimArray, primArrayFromList, sizeofPrimArray)
import Data.Set (Set)
import Data.Set qualified as Set
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.FlatPolyarc (FlatPolyarc (FlatPolyarc))
import Geometry.Index.SegmentTree qualified as SegmentTree
import Geometry.Polyarc (Ends (..))
import Offset.SegmentIntersection (Visitor (..))
import Offset.SegmentIntersection qualified as SegmentIntersection
import Test.Hspec
import Test.QuickCheck hiding (tolerance)

spec :: Spec
spec = describe "boxes of a chain" $ do
  it "let all pairs through that meet (catches a run that is taken for one that goes forward)" $
    withMaxSuccess 1000 . forAll outlines $ \os ->
      let c = ClosedPolyarcs.fromOutlines tolerance os
          everywhere = meetings Every c
       in cover 40 (Set.size everywhere > 1) "that meet"
            . cover 20 (ClosedPolyarcs.walks c > 1) "several walks"
            $ meetings Boxed c === everywhere

-- | Which pairs of segments are looked at.
data Looked = Every | Boxed

-- | What is told of the meetings of these pairs.
meetings :: Looked -> ClosedPolyarcs -> Set (Int, Int)
meetings looked c = runST $ do
  found <- newMutVar Set.empty
  let tell i j = modifyMutVar' found (Set.insert (i, j))
      visit =
        SegmentIntersection.meet
          tolerance
          c
          Visitor
            { crossing = \i _ j _ _ _ _ -> tell i j,
              resting = tell,
              touching = \i j _ _ -> tell i j
            }
  case looked of
    Every -> sequence_ [visit i j | i <- segments, j <- segments, i < j]
    Boxed -> SegmentTree.pairs (SegmentTree.boxes tolerance c) (pure True) visit
  readMutVar found
  where
    segments =
      [ i
        | i <- [0 .. sizeofPrimArray (ClosedPolyarcs.xs c) - 2],
          not
            ( ClosedPolyarcs.marked
                ClosedPolyarcs.copied
                (indexPrimArray (ClosedPolyarcs.marks c) i)
            )
      ]

tolerance :: Double
tolerance = 1e-11

-- | One or more: long ways that wind and come back to themselves, scattered vertices, and such on a
-- grid.
outlines :: Gen [FlatPolyarc]
outlines = do
  walks <- elements [1, 1, 2, 3]
  vectorOf walks (oneof [winding, scattered, onGrid])
  where
    outline vs =
      FlatPolyarc
        Closed
        (primArrayFromList [x | (x, _, _) <- vs])
        (primArrayFromList [y | (_, y, _) <- vs])
        (primArrayFromList [b | (_, _, b) <- vs])
    -- Steps that turn little by little, so that whole runs go forward.
    winding = do
      n <- choose (3, 300 :: Int)
      turns <- vectorOf n (choose (-0.3, 0.35))
      bulges <- vectorOf n bulge
      let headings = scanl (+) 0 turns
          places = scanl (\(x, y) a -> (x + cos a, y + sin a)) (0, 0) headings
      pure (outline (zipWith (\(x, y) b -> (x, y, b)) places bulges))
    scattered =
      choose (3, 40 :: Int) >>= \n ->
        outline <$> vectorOf n ((,,) <$> choose (-5, 5) <*> choose (-5, 5) <*> bulge)
    onGrid =
      choose (3, 60 :: Int) >>= \n -> outline <$> vectorOf n ((,,) <$> whole <*> whole <*> bulge)
    whole = fromIntegral <$> choose (-6, 6 :: Int)
    bulge =
      frequency [(3, pure 0), (2, choose (-0.3, 0.3)), (1, choose (-1, 1)), (1, elements [-1, 1])]
