-- | Laws of values that translated copies of contours share.
module Geometry.TranslatedCopySpec
  ( spec,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Generate.Area (area)
import Geometry.Carrier (Circle (Circle), Sense (CounterClockwise))
import Geometry.Polyarc (Ends (Closed), Polyarc (..))
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
    forAll groups $ \known -> forAll place $ \v ->
      let others = [fmap (change v) g | g <- known, change <- [copy, turnedCopy, further]]
          answers = drop (length known) (sharedBy Vec.shift (known <> others))
       in conjoin
            [ near value (middles k loops)
              | (asked, found) <- zip others answers,
                ((k, loops), value) <- zip (NonEmpty.toList asked) (NonEmpty.toList found)
            ]
  -- A number that lies between two multiples of the tolerance may be rounded to another one in the
  -- copy, which then computes its own value.
  prop "a copy takes the value of the first one, without computing its own" $
    checkCoverage . forAll groups $ \known -> forAll place $ \v ->
      let both = sharedBy (const id) (known <> map (fmap (copy v)) known)
          isTaken = drop (length known) both == take (length known) both
       in cover 90 isTaken "taken" True
  it "circles of other sizes are no copies, although they start at the same point" $
    let circle r =
          Segment.fullCircle CounterClockwise (Circle (Vec.point r 0) (Mm r)) (Vec.point 0 0)
        loops = [(0 :: Int, Polyarc Closed (circle r :| []) :| []) :| [] | r <- [3, 5]]
        radii = TranslatedCopy.shared (const (fmap radiusOf)) (const id) loops
     in radii `shouldBe` [(Mm 3 :| []) :| [], (Mm 5 :| []) :| []]
  where
    radiusOf loop = case NonEmpty.head (segments loop) of
      Segment.Arc {Segment.start, Segment.centre} -> Segment.radius centre start
      Segment.Straight _ _ -> Mm 0
    sharedBy move = TranslatedCopy.shared middles (map . move)
    copy v (k, loops) = (k, moved v loops)
    turnedCopy v (k, loops) = (k, turned (moved v loops))
    further v (k, loops) = (k + 1, moved v loops)
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
groups :: Gen [NonEmpty (Int, NonEmpty Polyarc)]
groups = choose (1, 3) >>= \n -> vectorOf n group
  where
    group = choose (1, 3) >>= \n -> NonEmpty.fromList <$> vectorOf n numbered
    numbered = (,) <$> choose (1, 2) <*> area

place :: Gen Vec.Vec
place = Vec.vec <$> choose (-1000, 1000) <*> choose (-1000, 1000)
