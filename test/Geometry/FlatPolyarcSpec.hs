-- | Flat polyarcs: area, length and reversal.
module Geometry.FlatPolyarcSpec (spec) where

import Base.Quantity (Mm (..))
import Data.List.NonEmpty qualified as NonEmpty
import Generate qualified
import Generate.Outline qualified
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment qualified as Segment
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "a flat polyarc" $ do
  it "of a circle has the area and length of the circle, however it is divided" $
    property . forAll (choose (2, 60)) $ \k -> forAll (choose (0.1, 10)) $ \r ->
      let o =
            Generate.Outline.loop
              [ (r * cos t, r * sin t, tan (pi / (2 * fromIntegral k)))
                | i <- [0 .. k - 1 :: Int],
                  let t = 2 * pi * fromIntegral i / fromIntegral k
              ]
          Mm l = FlatPolyarc.length o
       in counterexample
            (show (FlatPolyarc.area o, l))
            ( abs (FlatPolyarc.area o - pi * r * r) < 1e-11 * r * r
                && abs (l - 2 * pi * r) < 1e-11 * r
            )
  it
    "reversed has the negative area and the same length (catches a bulge of the wrong segment)"
    $ property . forAll Generate.Outline.problem $ \c ->
      conjoin
        [ counterexample
            (show o)
            ( near (FlatPolyarc.area o) (-(FlatPolyarc.area (FlatPolyarc.reverse o)))
                .&&. near (len o) (len (FlatPolyarc.reverse o))
            )
          | o <- Generate.Outline.outlines c
        ]
  it "reversed twice is itself" $
    property . forAll Generate.Outline.open $ \c ->
      map (FlatPolyarc.reverse . FlatPolyarc.reverse) (Generate.Outline.outlines c)
        === map lastless (Generate.Outline.outlines c)
  it
    "is as long as the polyarc of which it is made (catches an arc that is divided at the wrong \
    \point)"
    $ property . forAll Generate.closedCase $ \c ->
      let contour = Generate.contour c
          (o, numbers) = FlatPolyarc.fromPolyarc contour
          Mm whole =
            foldr (plus . Segment.length) (Mm 0) (NonEmpty.toList (Polyarc.segments contour))
       in near (len o) whole
            .&&. counterexample
              (show numbers)
              (FlatPolyarc.size o >= NonEmpty.length (Polyarc.segments contour))
  where
    len o = let Mm l = FlatPolyarc.length o in l
    near :: Double -> Double -> Property
    near a b = counterexample (show (a, b)) (abs (a - b) < 1e-9 * (1 + abs a + abs b))
    plus (Mm a) (Mm b) = Mm (a + b)
    -- The last bulge of an open polyarc has no meaning.
    lastless o =
      FlatPolyarc.fromVertices (FlatPolyarc.ends o) (withoutLast (FlatPolyarc.vertices o))
    withoutLast vs = case reverse vs of
      (x, y, _) : rest -> reverse ((x, y, 0) : rest)
      [] -> []
