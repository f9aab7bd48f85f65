-- | Law of exact intersections of curves.
module Geometry.Curve.IntersectionSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Generate.Curve qualified as Curves
import Geometry.Carrier (Circle (..), Line (..))
import Geometry.Curve qualified as Curve
import Geometry.Curve.Intersection qualified as Intersection
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  it
    "refining a point near an intersection gives the exact intersection (catches one on the \
    \polyarc that represents a curve)"
    $ property $
      forAll Curves.gentle $ \curve -> forAll (Curves.parameterOf curve <$> choose (0, 1)) $ \u ->
        forAll
          ( (,,,)
              <$> choose (0.1, 1.4) <*> elements [-1, 1] <*> choose (20, 100) <*> choose (0, 2 * pi)
          )
          $ \(angle, sense, r, direction) ->
            let p = Curve.at curve u
                across = Vec.rotate (Rad (sense * angle)) (Vec.unit (Curve.tangent curve u))
                straight = Intersection.onLine (Line p (Vec.shift (Vec.scale 10 across) p))
                round' =
                  Intersection.onCircle
                    (Circle (Vec.shift (Vec.scale r (Vec.left across)) p) (Mm r))
                off =
                  Vec.distance p
                    . ( \foot ->
                          Intersection.refine
                            (Intersection.onCurve curve)
                            foot
                            (Vec.shift (Vec.polar (Mm 1e-5) (Rad direction)) p)
                      )
             in counterexample
                  (show (off straight, off round'))
                  (off straight <= Mm 1e-7 && off round' <= Mm 1e-7)
