-- | Laws of the boolean operations on regions of several parts.
module Part.PlaneRegionSpec
  ( spec,
  )
where

import Base.Name (Name (..))
import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Base.Region qualified as Region
import Data.List.NonEmpty (NonEmpty)
import Geometry.Carrier (Circle (..))
import Geometry.Polyarc (Ends (Closed), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Offset.RegionBoolean (BooleanOperation (..), ResultSegment)
import Offset.RegionBoolean qualified as RegionBoolean
import Part.Part (polyarcOf)
import Part.PlaneRegion (PlaneRegion)
import Part.PlaneRegion qualified as PlaneRegion
import Part.RegionBuiltin qualified as RegionBuiltin
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  it
    "regions in several clusters are those that one arrangement of all gives (catches parts that \
    \are overlooked)"
    $ withMaxSuccess 500 $
      forAll operands $ \circles -> forAll arbitraryBoundedEnum $ \operation ->
        forAll (vectorOf 20 place) $ \points ->
          case (inClusters operation circles, atOnce operation circles) of
            (Just region, Just loops) ->
              let area = sum (map (Polyarc.areaOf RegionBoolean.segment) loops)
                  whole = map polyarc loops
                  contours = map polyarcOf (PlaneRegion.contoursOf region)
               in counterexample (show (region, whole)) $
                    conjoin
                      [ property (abs (PlaneRegion.area region - area) <= 1e-6),
                        length contours === length whole,
                        conjoin [turns p contours === turns p whole | p <- points]
                      ]
            (a, b) -> counterexample (show (a, b)) False
  where
    operands = choose (2, 4) >>= \n -> vectorOf n (choose (1, 8) >>= \k -> vectorOf k circle)
    circle = Circle <$> place <*> (Mm <$> choose (0.5, 6))
    place = Vec.point <$> choose (0, 60) <*> choose (0, 40)
    polyarc loop = Polyarc Closed (fmap RegionBoolean.segment loop)
    turns p contours = sum [WindingNumber.about p (segments c) | c <- contours]

-- | The result of an operation on unions of circles.
inClusters :: BooleanOperation -> [[Circle]] -> Maybe PlaneRegion
inClusters operation = hush . combined operation . traverse (combined Union . traverse disc)
  where
    combined how regions = regions >>= PlaneRegion.combined name how
    name = Located at (Name "region")
    at = Region.Region 0 0
    disc = PlaneRegion.inside . RegionBuiltin.contourOfCircle at
    hush = either (const Nothing) Just

-- | The loops of an operation on unions of circles, which a single arrangement gives for each of
-- the unions and for the operation.
atOnce :: BooleanOperation -> [[Circle]] -> Maybe [NonEmpty ResultSegment]
atOnce operation circles = either (const Nothing) Just $ do
  unions <- traverse (RegionBoolean.combine Union . map disc) circles
  RegionBoolean.combine operation (map (map whole) unions)
  where
    disc c = [polyarcOf (RegionBuiltin.contourOfCircle (Region.Region 0 0) c)]
    whole loop = Polyarc Closed (fmap RegionBoolean.segment loop)
