-- | The pair search of the kernel's bounding-box tree against a test of all pairs.
module Geometry.Index.SegmentBoxTreeSpec (spec) where

import Control.Monad.ST (runST)
import Data.Primitive.MutVar (modifyMutVar', newMutVar, readMutVar)
import Data.Primitive.PrimArray (indexPrimArray, sizeofPrimArray)
import Data.Set (Set)
import Data.Set qualified as Set
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Index.SegmentBoxTree qualified as SegmentBoxTree
import Geometry.Polyarc (Ends (..))
import Offset.SegmentIntersection (Visitor (..))
import Offset.SegmentIntersection qualified as SegmentIntersection
import Test.Hspec
import Test.QuickCheck hiding (tolerance)

spec :: Spec
spec = describe "the pair search of a tree" $ do
  it "finds all pairs that meet (catches a run that is wrongly taken to advance in one direction)" $
    withMaxSuccess 1000 . forAll polyarcs $ \os ->
      let c = ClosedPolyarcs.fromFlatPolyarcs tolerance os
          expected = meetings AllPairs c
       in cover 40 (Set.size expected > 1) "that meet"
            . cover 20 (ClosedPolyarcs.loopCount c > 1) "several loops"
            $ meetings FoundByTree c === expected

-- | The pairs of segments whose intersection is tested: all pairs, or those that the tree finds.
data Candidates = AllPairs | FoundByTree

-- | The candidates that meet.
meetings :: Candidates -> ClosedPolyarcs -> Set (Int, Int)
meetings candidates c = runST $ do
  pairs <- newMutVar Set.empty
  let record i j = modifyMutVar' pairs (Set.insert (i, j))
      visit =
        SegmentIntersection.meet
          tolerance
          c
          Visitor
            { crossing = \i _ j _ _ _ _ -> record i j,
              resting = record,
              touching = \i j _ _ -> record i j
            }
  case candidates of
    AllPairs -> sequence_ [visit i j | i <- segments, j <- segments, i < j]
    FoundByTree -> SegmentBoxTree.pairs (SegmentBoxTree.build tolerance c) (pure True) visit
  readMutVar pairs
  where
    segments =
      [ i
        | i <- [0 .. sizeofPrimArray (ClosedPolyarcs.xs c) - 2],
          not
            ( ClosedPolyarcs.hasMark
                ClosedPolyarcs.repeatedMark
                (indexPrimArray (ClosedPolyarcs.marks c) i)
            )
      ]

tolerance :: Double
tolerance = 1e-11

-- | One to three closed polyarcs: long ones that turn gently, and ones with random vertices, on a
-- grid or not.
polyarcs :: Gen [FlatPolyarc]
polyarcs = do
  loops <- elements [1, 1, 2, 3]
  vectorOf loops (oneof [winding, scattered, onGrid])
  where
    polyarc = FlatPolyarc.fromVertices Closed
    -- Directions change little from step to step, so that many runs advance in one direction.
    winding = do
      n <- choose (3, 300 :: Int)
      changes <- vectorOf n (choose (-0.3, 0.35))
      bulges <- vectorOf n bulge
      let headings = scanl (+) 0 changes
          points = scanl (\(x, y) a -> (x + cos a, y + sin a)) (0, 0) headings
      pure (polyarc (zipWith (\(x, y) b -> (x, y, b)) points bulges))
    scattered =
      choose (3, 40 :: Int) >>= \n ->
        polyarc <$> vectorOf n ((,,) <$> choose (-5, 5) <*> choose (-5, 5) <*> bulge)
    onGrid =
      choose (3, 60 :: Int) >>= \n -> polyarc <$> vectorOf n ((,,) <$> whole <*> whole <*> bulge)
    whole = fromIntegral <$> choose (-6, 6 :: Int)
    bulge =
      frequency [(3, pure 0), (2, choose (-0.3, 0.3)), (1, choose (-1, 1)), (1, elements [-1, 1])]
