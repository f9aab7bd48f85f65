-- | Laws of winding numbers, bounding-box trees and arrangements.
module Offset.WindingNumberSpec (spec) where

import Generate.Outline qualified as Generate
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Index.SegmentBoxTree qualified as SegmentBoxTree
import Offset.Arrangement qualified as Arrangement
import Offset.Naive qualified as Naive
import Offset.WindingNumber (Extreme (..), Outward (..))
import Offset.WindingNumber qualified as WindingNumber
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "winding numbers" $ do
    it "are those of the naive count (catches a region between arc and chord that is left out)" $
      property . forAll Generate.problem $ \c -> forAll samplePoints $ \ps ->
        let os = Generate.outlines c
            chain = ClosedPolyarcs.fromFlatPolyarcs 1e-14 os
            bs = SegmentBoxTree.build 1e-14 chain
            naive = concatMap Naive.pieces os
            at (u, v) =
              let (lx, ly, hx, hy) =
                    SegmentBoxTree.boundingBox bs (,,,)
               in (lx + u * (hx - lx), ly + v * (hy - ly))
         in conjoin
              [ counterexample
                  (show (x, y))
                  ( Naive.distance naive x y
                      < 1e-6 .||. WindingNumber.at chain bs x y === Naive.winding naive x y
                  )
                | (x, y) <- map at ps
              ]
    it "are right on the chord of an arc (catches a point that belongs to neither side)" $
      let chain =
            ClosedPolyarcs.fromFlatPolyarcs
              1e-14
              [ Generate.loop [(2, 0, b), (0, 2, b), (-2, 0, b), (0, -2, b)],
                Generate.loop [(3, 1, 1), (1, 1, 1)]
              ]
          b = tan (pi / 8)
          bs = SegmentBoxTree.build 0 chain
       in [ WindingNumber.at chain bs x y
            | (x, y) <- [(1, 1), (-1, 1), (-1, -1), (1, -1), (0.5, 1.5), (2, 1)]
          ]
            `shouldBe` [1, 1, 1, 1, 1, 1]
    it
      "at the leftmost and rightmost points of a simple polyarc follow from its sense (catches an \
      \arc taken for its chord)"
      $ property . forAll Generate.simple $ \o ->
        let chain = ClosedPolyarcs.fromFlatPolyarcs 1e-14 [o]
            bs = SegmentBoxTree.build 1e-14 chain
         in map (\w -> leftExcess (WindingNumber.extreme w chain bs 0)) [Leftmost, Rightmost]
              === [Just 1, Just 1]
    it
      "at a leftmost or rightmost point that is a cusp follow from the sense (catches a cusp whose \
      \sides are exchanged)"
      $ checkCoverage . forAll horn $ \o ->
        let chain = ClosedPolyarcs.fromFlatPolyarcs 1e-14 [o]
            bs = SegmentBoxTree.build 1e-14 chain
            ends = map (\w -> WindingNumber.extreme w chain bs 0) [Leftmost, Rightmost]
            atTip e = abs (x e) + abs (y e) < 1e-9
         in cover 30 (any atTip ends) "at the tip" $
              map leftExcess ends
                === (if FlatPolyarc.area o > 0 then [Just 1, Just 1] else [Just 0, Just 0])
    it "at the leftmost point of a circle are found in the middle of an arc" $
      let chain = ClosedPolyarcs.fromFlatPolyarcs 1e-14 [Generate.loop [(0, -1, 1), (0, 1, 1)]]
          e = WindingNumber.extreme Leftmost chain (SegmentBoxTree.build 0 chain) 0
       in (segment e, x e, abs (y e) < 1e-15, leftExcess e) `shouldBe` (1, -1, True, Just 1)
  describe "a bounding-box tree" $
    it
      "finds the segments whose boxes overlap a box (catches a level of the tree that is cut short)"
      $ property . forAll Generate.simple $ \o ->
        forAll (choose (-8, 8)) $ \px ->
          forAll (choose (-8, 8)) $ \py -> forAll (choose (0, 4)) $ \r ->
            let chain = ClosedPolyarcs.fromFlatPolyarcs 1e-14 [o]
                bs = SegmentBoxTree.build 0 chain
                hit i =
                  SegmentBoxTree.segmentBoxWithMargin
                    bs
                    i
                    (\lx ly hx hy -> lx <= px + r && px - r <= hx && ly <= py + r && py - r <= hy)
             in reverse (SegmentBoxTree.around bs (px - r) (py - r) (px + r) (py + r) [] (flip (:)))
                  === filter hit [0 .. FlatPolyarc.size o - 1]
  describe "arrangements" $ do
    it "of a square that is traversed twice has the numbers 0 and 2" $
      numbersOf [square 0 0 1, square 0 0 1] `shouldBe` Just (0, 2)
    it "of squares side by side, of one sense, has the numbers 0 and 1" $
      numbersOf [square 0 0 1, square 1 0 1] `shouldBe` Just (0, 1)
    it "of a square and the reversed square has the number 0 only" $
      numbersOf [square 0 0 1, FlatPolyarc.reverse (square 0 0 1)] `shouldBe` Just (0, 0)
    it "of a figure of eight has the numbers −1 and 1" $
      numbersOf [Generate.loop [(0, 0, 0), (1, 1, 0), (2, 2, 0), (2, 0, 0), (1, 1, 0), (0, 2, 0)]]
        `shouldBe` Just (-1, 1)
    it
      "of a square beside a line traversed there and back has the numbers 0 and 1 (catches lines \
      \that cancel out and remain)"
      $ numbersOf [square 5 (-1) 2, Generate.loop [(0, 0, 0), (4, 0, 0)]] `shouldBe` Just (0, 1)
    it "whose leftmost node is smooth has the right numbers" $
      numbersOf
        [ Generate.loop [(0, 0, 1), (2, 0, 0), (2, 1, 0), (0, 1, 0)],
          Generate.loop [(0, 0, 1), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
        ]
        `shouldBe` Just (0, 2)
  where
    samplePoints = vectorOf 20 ((,) <$> choose (0, 1) <*> choose (0, 1)) :: Gen [(Double, Double)]

-- | A closed polyarc of two arcs that meet at the origin in a cusp, and a line. Its first vertex,
-- its direction and its sense are random.
horn :: Gen FlatPolyarc
horn = do
  low <- oneof [pure 0, choose (-0.8, 0.7)]
  high <- oneof [pure 0, choose (-0.7, 0.8)] `suchThat` (\k -> abs (k - low) > 0.05)
  angle <- oneof [elements [0, pi / 2, pi, 3 * pi / 2], choose (0, 2 * pi)]
  start <- choose (0, 2)
  back <- arbitrary
  let sweep k = asin k
      height k = if k == 0 then 0 else (1 - cos (sweep k)) / k
      parameter (px, py, b) = (px * cos angle - py * sin angle, px * sin angle + py * cos angle, b)
      corners =
        map
          parameter
          [ (0, 0, tan (sweep low / 4)),
            (1, height low, 0),
            (1, height high, negate (tan (sweep high / 4)))
          ]
      o = Generate.loop (drop start corners <> take start corners)
  pure (if back then FlatPolyarc.reverse o else o)

-- | The least and the largest winding number of the arrangement of polyarcs.
numbersOf :: [FlatPolyarc] -> Maybe (Int, Int)
numbersOf os =
  Arrangement.windingNumbers <$> Arrangement.arrange 1e-12 chain (SegmentBoxTree.build 1e-12 chain)
  where
    chain = ClosedPolyarcs.fromFlatPolyarcs 1e-14 os

square :: Double -> Double -> Double -> FlatPolyarc
square x y a = Generate.loop [(x, y, 0), (x + a, y, 0), (x + a, y + a, 0), (x, y + a, 0)]
