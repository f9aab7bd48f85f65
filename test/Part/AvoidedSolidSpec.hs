-- | Laws of solids that no tool may touch: the place at which a tool is deepest in them.
module Part.AvoidedSolidSpec (spec) where

import Base.Name (Name (..))
import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region (Region))
import Data.List.NonEmpty (NonEmpty (..))
import Data.Maybe (isJust)
import Geometry.Distance qualified as Distance
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.AvoidedSolid qualified as AvoidedSolid
import Part.Part (Contour (..), Element (..), Solid (..))
import Part.Part qualified as Part
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck hiding (elements)

spec :: Spec
spec = describe "the deepest point of a path in a solid" $ do
  prop "exists exactly where the cylinder enters the solid" $
    forAll paths $ \(r, path) ->
      isJust (AvoidedSolid.deepestPoint clamp r path)
        === (AvoidedSolid.depthOf clamp r path > Mm 0)
  prop "is on the path, and as deep as the whole path" $
    forAll paths $ \(r, path) -> case AvoidedSolid.deepestPoint clamp r path of
      Nothing -> property True
      Just p ->
        let Mm whole = AvoidedSolid.depthOf clamp r path
            Mm there = AvoidedSolid.depthOf clamp r (Straight p p)
            Mm away = Distance.toPoint p path
         in counterexample (show (whole, there, away)) $
              abs (whole - there) < 1.0e-6 && away < 1.0e-6
  it "is 7.5 mm deep over the middle of the narrow side of a clamp of 20 mm by 10 mm" $ do
    let path = Straight (Vec.point 10 5) (Vec.point 10 5)
    AvoidedSolid.depthOf clamp (Mm 2.5) path `shouldBe` Mm 7.5
    AvoidedSolid.deepestPoint clamp (Mm 2.5) path `shouldBe` Just (Vec.point 10 5)

-- | Radii, and lines about the clamp.
paths :: Gen (Mm, Segment)
paths = (,) . Mm <$> choose (0.5, 6) <*> (Straight <$> place <*> place)
  where
    place = Vec.point <$> choose (-10, 30) <*> choose (-10, 20)

-- | A clamp from (0, 0) to (20, 10).
clamp :: AvoidedSolid.AvoidedSolid
clamp =
  AvoidedSolid.prepared
    Solid {outlines = [outline], lowest = Mm (-10), highest = Mm 12}
  where
    outline =
      Contour
        { contourName = Located here (Name "clamp"),
          ends = Closed,
          elements =
            side (0, 0) (20, 0)
              :| [side (20, 0) (20, 10), side (20, 10) (0, 10), side (0, 10) (0, 0)],
          breaks = [],
          writtenElements = []
        }
    side a b =
      Element
        { segment = Straight (corner a) (corner b),
          origin = here,
          finish = Part.plainFinish,
          continues = False,
          ofCurve = False,
          replaced = Nothing,
          bevel = Nothing
        }
    corner :: (Double, Double) -> Point
    corner = uncurry Vec.point
    here = Region 0 0
