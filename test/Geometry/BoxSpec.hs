-- | The laws of the index of boxes.
module Geometry.BoxSpec (spec) where

import Base.Quantity (Mm (..))
import Data.Bifunctor (bimap)
import Data.List (sort)
import Generate.Run qualified as Curve
import Geometry.Box qualified as Box
import Geometry.Distance qualified as Distance
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "an index" $ do
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
  it "finds the two things that are nearest to one another (catches a nearer one behind a box that is further)" $
    property $
      forAll ((,) <$> curve <*> curve) $ \(ss, others) ->
        let indexed = Box.index Box.ofSegment
            found = Box.closest Distance.segments Distance.distance (indexed ss) (indexed others)
         in fmap Distance.distance found === Just (minimum [Distance.distance (Distance.segments s o) | s <- ss, o <- others])
  where
    curve = oneof [Curve.open, Curve.closed]
