-- | The laws of the index of boxes.
module Geometry.Index.BoundingBoxSpec (spec) where

import Base.Quantity (Mm (..))
import Data.Bifunctor (bimap)
import Data.List (sort)
import Generate.Run qualified as Curve
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "an index" $ do
  it "leaves out only what is further off than asked (catches a bound above the distance)" $
    property $
      forAll ((,,) <$> curve <*> curve <*> choose (0, 30)) $ \(ss, others, d) ->
        conjoin
          [ counterexample
              (show s)
              ( [o | o <- others, Distance.distance (Distance.segments s o) <= Mm d]
                  === [ o
                        | o <-
                            BoundingBox.select
                              (\box -> BoundingBox.atLeast (`Distance.toPoint` s) box <= Mm d)
                              (BoundingBox.index BoundingBox.ofSegment others),
                          Distance.distance (Distance.segments s o) <= Mm d
                      ]
              )
            | s <- take 5 ss
          ]
  it
    "pairs all things whose boxes meet, the earlier one first (catches a branch that is not gone \
    \down)"
    $ property $
      forAll curve $ \ss ->
        let numbered = zip [0 :: Int ..] ss
            meet (_, s) (_, t) =
              BoundingBox.meets (BoundingBox.ofSegment s) (BoundingBox.ofSegment t)
         in sort
              ( map
                  (bimap fst fst)
                  (BoundingBox.pairs (BoundingBox.index (BoundingBox.ofSegment . snd) numbered))
              )
              === [(fst a, fst b) | a <- numbered, b <- numbered, fst a < fst b, meet a b]
  it
    "finds the two things that are nearest to one another (catches a nearer one behind a box that \
    \is further)"
    $ property $
      forAll ((,) <$> curve <*> curve) $ \(ss, others) ->
        let indexed = BoundingBox.index BoundingBox.ofSegment
            found =
              BoundingBox.closest Distance.segments Distance.distance (indexed ss) (indexed others)
         in fmap Distance.distance found
              === Just (minimum [Distance.distance (Distance.segments s o) | s <- ss, o <- others])
  where
    curve = oneof [Curve.open, Curve.closed]
