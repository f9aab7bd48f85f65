-- | Uncertainty of the progress of a cutter along a curve.
module Verify.ContactMeasureSpec (spec) where

import Base.Quantity (Mm (..))
import Base.Region (Region (Region))
import Data.List.NonEmpty qualified as NonEmpty
import Generate (Case (Case))
import Generate.Run qualified as Curve
import Geometry.Carrier (Side (..))
import Geometry.Polyarc (Ends (Open), Polyarc (..))
import Geometry.Segment (Segment)
import Geometry.Vec qualified as Vec
import Offset.Equidistant qualified as Equidistant
import Part.Part qualified as Part
import Test.Hspec
import Test.QuickCheck
import Verify.ContactMeasure (Measure (..))
import Verify.ContactMeasure qualified as ContactMeasure
import Verify.Edge qualified as Edge
import Verify.MillingJob (MillingJob (..))

spec :: Spec
spec =
  it
    "a curve has the same uncertainty however many arcs replace it (catches a curve that is not \
    \measured as a whole)"
    $ property $
      forAll hollow $ \(arc, r) ->
        forAll (choose (2, 60)) $ \count ->
          let measureOf = ContactMeasure.measureOf . jobBeside r
              whole = measureOf [arc]
              divided = measureOf (Curve.parts count arc)
           in cover 10 (isResolved whole) "the progress shows" $
                cover 10 (not (isResolved whole)) "the progress does not show" $
                  counterexample (show (slack whole, slack divided)) $
                    isResolved divided === isResolved whole
                      .&&. (not (isResolved whole) || abs (slack divided - slack whole) < 1e-6)

-- | Arc with the cutter on its inside, and the radius of the cutter in mm. The radius of the arc is
-- a little larger.
hollow :: Gen (Segment, Double)
hollow = do
  r <- choose (1, 10)
  more <- exp <$> choose (log 0.01, 0)
  turned <- choose (0.2, 3)
  pure (Curve.arcFrom (Vec.point 0 0) 0 turned (turned * (r + more)), r)

-- | Cut along a curve that the given segments replace, by a cutter of a radius in mm on the left.
jobBeside :: Double -> [Segment] -> MillingJob
jobBeside r segments =
  MillingJob
    { milling,
      statement = Region 0 0,
      side = Just LeftOf,
      entry = Vec.point 0 r,
      exit = Vec.point 0 r,
      reach = Mm r,
      maxReach = Mm r,
      allowance = Mm 0.021,
      exitTolerance = Mm 0.021,
      isPartialCut = False,
      edges = Edge.edgesOf (Part.contour milling)
    }
  where
    milling = Curve.jobAlong (Case contour LeftOf (Mm r) pieces)
    contour = Polyarc Open (NonEmpty.fromList segments)
    pieces = either (error . show) id (Equidistant.equidistant LeftOf (Mm r) contour)
