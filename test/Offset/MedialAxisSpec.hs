-- | Laws of the medial axis, against the distance from all elements of the boundary.
module Offset.MedialAxisSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Generate.Area (area)
import Geometry.Distance qualified as Distance
import Geometry.Polyarc (Polyarc (..))
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Offset.MedialAxis (Branch, Disc (..), Stretch (..))
import Offset.MedialAxis qualified as MedialAxis
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it
    "discs on the medial axis lie in the area and touch its boundary (catches a site that is \
    \overlooked between two samples)"
    $ property $
      forAll area $ \loops -> forAll limit $ \most ->
        let axis = branchesOf most loops
         in conjoin
              [ counterexample (show (d, clearance loops c)) $
                  isInside loops c r .&&. abs (clearance loops c - r) <= 2 * tolerance
                | d@(Disc c (Mm r)) <- concatMap discsAlong axis
              ]
  it
    "the largest disc at any point of the boundary is on the medial axis (catches branches that \
    \are left out by both of their sites)"
    $ property $
      forAll area $ \loops -> forAll limit $ \most ->
        forAll (choose (0, length (sidesOf loops) - 1)) $ \k -> forAll (choose (0.01, 0.99)) $ \u ->
          let s = sidesOf loops !! k
              p = Segment.at u s
              n = Vec.left (Segment.directionAt u s)
              r = largest loops most p n
              c = Vec.shift (Vec.scale r n) p
              nearest = minimum (map (distanceOf (Disc c (Mm r))) (branchesOf most loops))
           in counterexample (show (p, r, c, nearest)) (nearest <= 3 * tolerance)
  where
    tolerance = 1e-5
    branchesOf most = MedialAxis.branches (Mm tolerance) (Mm most)
    limit = elements [2, 7, 1000]

-- | Sides of all loops.
sidesOf :: NonEmpty Polyarc -> [Segment]
sidesOf = concatMap (NonEmpty.toList . segments)

-- | The distance of a point from the boundary.
clearance :: NonEmpty Polyarc -> Point -> Double
clearance loops p = minimum [d | s <- sidesOf loops, let Mm d = Distance.toPoint p s]

isInside :: NonEmpty Polyarc -> Point -> Double -> Property
isInside loops p r =
  counterexample "outside" (r < 1e-4 || WindingNumber.about p (sidesOf loops) == 1)

-- | The radius of the largest disc that touches the boundary at a point with a normal, found by
-- halving.
largest :: NonEmpty Polyarc -> Double -> Point -> Vec.Vec -> Double
largest loops most p n = go (60 :: Int) 0 most
  where
    fits r = clearance loops (Vec.shift (Vec.scale r n) p) >= r - 1e-9
    go steps a b
      | fits b = b
      | steps == 0 = a
      | otherwise = let m = (a + b) / 2 in if fits m then go (steps - 1) m b else go (steps - 1) a m

-- | Discs at some places of a branch.
discsAlong :: Branch -> [Disc]
discsAlong branch = [discIn t s | s <- NonEmpty.toList branch, t <- [0, 0.2, 0.5, 0.9, 1]]

discIn :: Double -> Stretch -> Disc
discIn t stretch = case stretch of
  Sloping (Disc p (Mm a)) (Disc q (Mm b)) -> Disc (Vec.interpolate t p q) (Mm (a + t * (b - a)))
  Level s r -> Disc (Segment.at t s) r

-- | The distance of a disc from the nearest one of a branch, as the larger one of the distance of
-- the centres and the difference of the radii.
distanceOf :: Disc -> Branch -> Double
distanceOf (Disc c (Mm r)) branch =
  minimum
    [ max d (abs (r - s))
      | stretch <- NonEmpty.toList branch,
        let Disc q (Mm s) = discIn (share stretch) stretch,
        let Mm d = Vec.distance c q
    ]
  where
    share stretch = case stretch of
      Sloping (Disc p _) (Disc q _)
        | p == q -> 0
        | otherwise -> Distance.nearestFraction c (Segment.Straight p q)
      Level s _ -> Distance.nearestFraction c s
