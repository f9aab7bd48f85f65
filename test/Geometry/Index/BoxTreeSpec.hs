-- | Queries of the bounding-box tree against tests of all things one by one.
module Geometry.Index.BoxTreeSpec (spec) where

import Base.Quantity (Mm (..), plus)
import Data.List (minimumBy, sort)
import Data.Ord (comparing)
import Generate.Run qualified as Curve
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it "finds all things whose boxes meet a box, in order (catches a last group that is not full)" $
    property $
      forAll ((,) <$> boxes <*> box) $ \(things, b) ->
        map fst (BoxTree.within b (BoxTree.index snd things))
          === [i | (i, b') <- things, BoundingBox.meets b' b]
  it
    "answers each of many boxes as if it were alone (catches things that meet only the boxes \
    \beside it, and one that is found twice)"
    $ property $
      forAll ((,) <$> boxes <*> oneof [boxes, alike]) $ \(things, others) ->
        let tree = BoxTree.index snd things
            holds (i, _) (k, _) = (i + k) `mod` 3 /= (0 :: Int)
         in map (map fst) (BoxTree.each snd holds tree others)
              === [[fst t | t <- BoxTree.within b tree, holds o t] | o@(_, b) <- others]
  it
    "finds the thing nearest to a point, of several the first (catches a group that is excluded by \
    \the bound of another)"
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
    "finds the segment nearest to a point, of several the first (catches a box that seems further \
    \away than its content)"
    $ property $
      forAll
        ((,,) <$> curve <*> choose (-150, 150) <*> choose (-150, 150))
        $ \(ss, x, y) ->
          let p = Vec.point x y
              numbered = zip [0 :: Int ..] ss
              away (_, s) = Distance.toPoint p s
              nearest = minimumBy (comparing away) numbered
           in BoxTree.closest away p (BoxTree.index (BoundingBox.ofSegment . snd) numbered)
                === Just (away nearest, nearest)
  it
    "finds the nearest thing even if its distance is rounded below that of its box (catches a \
    \thing that is excluded because its box seems further away)"
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
    "contains the same things if it sorts them, and finds one that is as near (catches a column \
    \that is left out)"
    $ property $
      forAll ((,) <$> boxes <*> point) $ \(things, p) ->
        let sorted = BoxTree.sortedIndex snd things
            distanceOf = fmap fst . BoxTree.closest (BoundingBox.distance p . snd) p
         in (sort (map fst (BoxTree.toList sorted)), distanceOf sorted)
              === (map fst things, distanceOf (BoxTree.index snd things))
  it "lists all things in order (catches a higher level in place of the things)" $
    property $
      forAll boxes $ \things ->
        map fst (BoxTree.toList (BoxTree.index snd things)) === map fst things
  it
    "finds the closest pair of two trees (catches a nearer pair in a box that is further away)"
    $ property $
      forAll ((,) <$> curve <*> curve) $ \(ss, others) ->
        let tree = BoxTree.index BoundingBox.ofSegment
            found =
              BoxTree.closestPair Distance.segments Distance.distance (tree ss) (tree others)
         in fmap Distance.distance found
              === Just (minimum [Distance.distance (Distance.segments s o) | s <- ss, o <- others])

curve :: Gen [Segment]
curve = oneof [Curve.open, Curve.closed]

point :: Gen Point
point = Vec.point <$> choose (-50, 50) <*> choose (-50, 50)

box :: Gen BoundingBox
box = do
  p <- point
  w <- choose (0, 20)
  -- Boxes in whole millimetres often touch.
  whole <- arbitrary
  let b = BoundingBox.inflate (Mm w) (BoundingBox.ofPoints p [])
      rounded x = fromIntegral (round x :: Int)
      BoundingBox left bottom right top = b
  pure
    ( if whole
        then BoundingBox (rounded left) (rounded bottom) (rounded right) (rounded top)
        else b
    )

-- | Several groups of boxes; the boxes of a group are close to each other.
alike :: Gen [(Int, BoundingBox)]
alike = zip [0 ..] . concat <$> listOf (point >>= \p -> listOf (near p))
  where
    near p =
      (\a b w -> BoundingBox.inflate (Mm w) (BoundingBox.ofPoints (Vec.shift (Vec.vec a b) p) []))
        <$> choose (-3, 3) <*> choose (-3, 3) <*> choose (0, 4)

-- | Boxes with numbers from 0, of such a count that their trees have one to four levels.
boxes :: Gen [(Int, BoundingBox)]
boxes = do
  n <- oneof [choose (0, 20), choose (60, 70), choose (500, 600)]
  zip [0 ..] <$> vectorOf n box
