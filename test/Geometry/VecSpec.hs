-- | Law of the angle between two vectors.
module Geometry.VecSpec (spec) where

import Base.Quantity (Rad (..))
import Geometry.Vec (Vec)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  it
    "the angle from a vector to another one turns it into the other's direction, by at most half a \
    \turn (catches a formula that depends on the axes)"
    $ property $
      forAll ((,) <$> anyVector <*> anyVector) $ \(a, b) ->
        let Rad turned = Vec.signedAngle a b
            off = Vec.add (Vec.rotate (Rad turned) (Vec.unit a)) (Vec.negate (Vec.unit b))
         in counterexample (show (turned, off)) (abs turned <= pi && Vec.norm off < 1e-9)

-- | Vector with a length between 0.1 and 100 in any direction.
anyVector :: Gen Vec
anyVector = do
  l <- choose (0.1, 100)
  direction <- choose (-pi, pi)
  pure (Vec.rotate (Rad direction) (Vec.vec l 0))
