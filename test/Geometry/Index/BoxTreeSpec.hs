-- | The flat index against looking at everything.
module Geometry.Index.BoxTreeSpec (spec) where

import Base.Quantity (Mm (..), plus)
import Data.List (minimumBy, sort)
import Data.Ord (comparing)
import Generate.Run qualified as Curve
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it "finds what meets a box, all of it and in order (catches the last group that is not full)" $
    property $
      forAll ((,) <$> boxes <*> box) $ \(things, b) ->
        map fst (BoxTree.within b (BoxTree.index snd things))
          === [i | (i, b') <- things, BoundingBox.meets b' b]
  it
    "tells each of many boxes what it would be told alone (catches things that only the boxes \
    \beside it meet, and one that is asked for twice)"
    $ property $
      forAll ((,) <$> boxes <*> oneof [boxes, alike]) $ \(things, others) ->
        let n = BoxTree.index snd things
            holds (i, _) (k, _) = (i + k) `mod` 3 /= (0 :: Int)
         in map (map fst) (BoxTree.each snd holds n others)
              === [[fst t | t <- BoxTree.within b n, holds o t] | o@(_, b) <- others]
  it
    "finds what is nearest to a point, of several the first (catches a group left out by the bound \
    \of another)"
    $ property $
      forAll ((,) <$> boxes <*> point) $ \(things, p) ->
        let distanceTo (_, b) = BoundingBox.distance p b
            found =
              fmap
                (\(d, (i, _)) -> (d, i))
                (BoxTree.closest distanceTo p (BoxTree.index snd things))
            wanted = case things of
              [] -> Nothing
              _ -> let t = minimumBy (comparing distanceTo) things in Just (distanceTo t, fst t)
         in found === wanted
  it
    "gives the nearest of its things, of several the first (catches a box that seems further off \
    \than what is in it)"
    $ property $
      forAll
        ((,,) <$> oneof [Curve.open, Curve.closed] <*> choose (-150, 150) <*> choose (-150, 150))
        $ \(ss, x, y) ->
          let p = Vec.point x y
              numbered = zip [0 :: Int ..] ss
              away (_, s) = Distance.toPoint p s
              nearest = minimumBy (comparing away) numbered
           in BoxTree.closest away p (BoxTree.index (BoundingBox.ofSegment . snd) numbered)
                === Just (away nearest, nearest)
  it
    "finds it though distances are rounded otherwise than those of boxes (catches a thing that is \
    \passed over because its box seems further away than it)"
    $ property $
      forAll ((,) <$> boxes <*> point) $ \(things, p) ->
        forAll (vectorOf (length things) (choose (-1e-9, 0))) $ \slips ->
          let slipped =
                [(plus (BoundingBox.distance p b) (Mm e), (i, b)) | ((i, b), e) <- zip things slips]
              found =
                fmap
                  (\(d, (_, (i, _))) -> (d, i))
                  (BoxTree.closest fst p (BoxTree.index (snd . snd) slipped))
              wanted = case slipped of
                [] -> Nothing
                _ -> let (d, (i, _)) = minimumBy (comparing fst) slipped in Just (d, i)
           in found === wanted
  it
    "sorted by place it holds the same things, each once, and finds one that is as near (catches a \
    \column that is left out)"
    $ property $
      forAll ((,) <$> boxes <*> point) $ \(things, p) ->
        let sorted = BoxTree.byPlace snd things
            distanceOf = fmap fst . BoxTree.closest (BoundingBox.distance p . snd) p
         in (sort (map fst (BoxTree.toList sorted)), distanceOf sorted)
              === (map fst things, distanceOf (BoxTree.index snd things))
  it "gives everything back in order (catches a level taken for the things)" $
    property $
      forAll boxes $ \things ->
        map fst (BoxTree.toList (BoxTree.index snd things)) === map fst things

point :: Gen Point
point = Vec.point <$> choose (-50, 50) <*> choose (-50, 50)

box :: Gen BoundingBox
box = do
  p <- point
  w <- choose (0, 20)
  -- Some touch, to whole millimetres.
  whole <- arbitrary
  let b = BoundingBox.inflate (Mm w) (BoundingBox.ofPoints p [])
      rounded x = fromIntegral (round x :: Int)
  pure
    ( if whole
        then
          let BoundingBox l c r t =
                b
           in BoundingBox (rounded l) (rounded c) (rounded r) (rounded t)
        else b
    )

-- | Some beside one another, and then some elsewhere.
alike :: Gen [(Int, BoundingBox)]
alike = zip [0 ..] . concat <$> listOf (point >>= \p -> listOf (near p))
  where
    near p =
      (\a b w -> BoundingBox.inflate (Mm w) (BoundingBox.ofPoints (Vec.shift (Vec.vec a b) p) []))
        <$> choose (-3, 3) <*> choose (-3, 3) <*> choose (0, 4)

-- | Along a walk, as contours are.
boxes :: Gen [(Int, BoundingBox)]
boxes = do
  n <- oneof [choose (0, 20), choose (60, 70), choose (500, 600)]
  zip [0 ..] <$> vectorOf n box
