-- | Laws of values that translated copies of contours share.
module Geometry.TranslatedCopySpec
  ( spec,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Generate.Area (area)
import Geometry.Polyarc (Polyarc (..))
import Geometry.Segment qualified as Segment
import Geometry.Transformation qualified as Transformation
import Geometry.TranslatedCopy qualified as TranslatedCopy
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck

spec :: Spec
spec = do
  prop "a copy has the value of the function (catches copies that stay where the first one is)" $
    forAll groups $ \known -> forAll place $ \v -> forAll (elements known) $ \(k, loops) ->
      let value = TranslatedCopy.shared middles (map . Vec.shift) known
          copy = moved v loops
       in conjoin
            [ near (value k copy) (middles k copy),
              near (value (k + 1) copy) (middles (k + 1) copy),
              near (value k (turned copy)) (middles k (turned copy))
            ]
  prop "a copy takes the value of the first one, without computing its own" $
    forAll groups $ \known -> forAll place $ \v ->
      let value = TranslatedCopy.shared middles (const id) known
       in conjoin [value k (moved v loops) === value k loops | (k, loops) <- known]
  where
    near a b =
      counterexample (show (a, b)) $
        length a == length b && and (zipWith (\p q -> Vec.distance p q <= Mm 1e-6) a b)

-- | The middles of the segments, that many times.
middles :: Int -> NonEmpty Polyarc -> [Point]
middles k loops =
  concat . replicate k $
    [Segment.at 0.5 s | l <- NonEmpty.toList loops, s <- NonEmpty.toList (segments l)]

moved :: Vec.Vec -> NonEmpty Polyarc -> NonEmpty Polyarc
moved v = fmap (Transformation.polyarc (Transformation.translation v))

-- | The contours after half a turn.
turned :: NonEmpty Polyarc -> NonEmpty Polyarc
turned = fmap (Transformation.polyarc (Transformation.rotation (Rad pi) (Vec.point 0 0)))

-- | Groups of contours, each with a number.
groups :: Gen [(Int, NonEmpty Polyarc)]
groups = choose (1, 4) >>= \n -> vectorOf n ((,) <$> choose (1, 2) <*> area)

place :: Gen Vec.Vec
place = Vec.vec <$> choose (-1000, 1000) <*> choose (-1000, 1000)
