-- | The laws of the index of boxes.
module Geometry.BoxSpec (spec) where

import Base.Quantity (Mm (..))
import Data.Bifunctor (bimap)
import Data.List (minimumBy, sort)
import Data.Ord (comparing)
import Generate.Run qualified as Curve
import Geometry.Box qualified as Box
import Geometry.Distance qualified as Distance
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "an index" $ do
  it "gives the nearest of its things, of several the first (catches a box that seems further off than what is in it)" $
    property $
      forAll ((,,) <$> curve <*> choose (-150, 150) <*> choose (-150, 150)) $ \(ss, x, y) ->
        let p = Vec.point x y
            numbered = zip [0 :: Int ..] ss
            away (_, s) = Distance.toPoint p s
            nearest = minimumBy (comparing away) numbered
         in Box.closest away p (Box.index (Box.ofSegment . snd) numbered) === Just (away nearest, nearest)
  it "leaves out only what is further off than asked (catches a bound above the distance)" $
    property $
      forAll ((,,) <$> curve <*> curve <*> choose (0, 30)) $ \(ss, others, d) ->
        conjoin
          [ counterexample (show s) ([o | o <- others, Distance.distance (Distance.segments s o) <= Mm d] === [o | o <- Box.select (\box -> Box.atLeast (`Distance.toPoint` s) box <= Mm d) (Box.index Box.ofSegment others), Distance.distance (Distance.segments s o) <= Mm d])
            | s <- take 5 ss
          ]
  it "pairs all things whose boxes meet, the earlier one first (catches a branch that is not gone down)" $
    property $
      forAll curve $ \ss ->
        let numbered = zip [0 :: Int ..] ss
            meet (_, s) (_, t) = Box.meets (Box.ofSegment s) (Box.ofSegment t)
         in sort (map (bimap fst fst) (Box.pairs (Box.index (Box.ofSegment . snd) numbered))) === [(fst a, fst b) | a <- numbered, b <- numbered, fst a < fst b, meet a b]
  where
    curve = oneof [Curve.open, Curve.closed]
