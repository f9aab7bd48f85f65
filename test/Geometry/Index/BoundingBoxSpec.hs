-- | Laws of bounding boxes.
module Geometry.Index.BoundingBoxSpec (spec) where

import Base.Quantity (Mm (..))
import Generate.Run qualified as Curve
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "a lower bound of the distance over a box" $ do
  it "excludes only segments beyond the wanted distance (catches a bound above the distance)" $
    property $
      forAll ((,,) <$> curve <*> curve <*> choose (0, 30)) $ \(ss, others, d) ->
        let tree = BoxTree.index BoundingBox.ofSegment others
            isClose s o = Distance.distance (Distance.segments s o) <= Mm d
            mayBeClose s box = BoundingBox.lowerBound (`Distance.toPoint` s) box <= Mm d
         in conjoin
              [ counterexample
                  (show s)
                  ( filter (isClose s) others
                      === filter (isClose s) (BoxTree.select (mayBeClose s) tree)
                  )
                | s <- take 5 ss
              ]
  where
    curve = oneof [Curve.open, Curve.closed]
