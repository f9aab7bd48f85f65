-- | Laws of the curves that stand in drawings for the arcs of contours.
module Export.ElementCurveSpec (spec) where

import Base.Name (Name (..))
import Base.Quantity (Mm (..))
import Base.Region (Located (Located), Region (Region))
import Data.List (sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, isNothing)
import Export.Bezier (CubicBezier)
import Export.Bezier qualified as Bezier
import Export.ElementCurve qualified as ElementCurve
import Generate.Curve qualified as Curves
import Geometry.Curve (Curve)
import Geometry.Distance qualified as Distance
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Curve qualified as PartCurve
import Part.Part (Contour (Contour), Element (Element), ReplacedCurve (ReplacedCurve))
import Part.Part qualified as Part
import Part.Transformation qualified as PartTransformation
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "curves of elements" $ do
  it "run along the arcs, also backwards (catches a direction in which none is found)" $
    forAll curve $ \exact ->
      forAll (part (arcsOf exact)) $ \segments ->
        forAll arbitrary $ \isTurned ->
          let given = if isTurned then backwards segments else segments
              found = ElementCurve.along (replacing exact) given
           in cover 90 (isJust found) "curves are found" $
                case found of
                  Nothing -> counterexample "no curve" (property (all isLine segments))
                  Just curves ->
                    counterexample (show (deviation given curves)) $
                      deviation given curves <= 3e-5
                        && Bezier.start (NonEmpty.head curves) == firstOf given
                        && Bezier.end (NonEmpty.last curves) == lastOf given
                        && covers given curves
  it "are none for arcs that lie elsewhere (catches a curve beside its contour)" $
    forAll curve $ \exact ->
      let shift = Transformation.translation (Vec.vec 0.01 0.01)
          moved = fmap (Transformation.segment shift) (arcsOf exact)
       in isNothing (ElementCurve.along (replacing exact) moved)
  it "are not evaluated where contours are compared (catches a comparison of curves)" $
    forAll curve $ \exact ->
      let unknown = error "the curve was evaluated"
          c = contour exact
          d = c {Part.elements = fmap (\e -> e {Part.replaced = Just unknown}) (Part.elements c)}
       in d == d
  it "move with a contour (catches a curve that stays behind, or is not scaled)" $
    forAll curve $ \exact ->
      forAll Curves.similarity $ \s ->
        let moved = Part.elements (PartTransformation.image s (contour exact))
            given = fmap Part.segment moved
            found = do
              own <- Part.replaced (NonEmpty.head moved)
              ElementCurve.along own given
         in cover 90 (isJust found) "curves are found" $ case found of
              Nothing -> counterexample "no curve" (property (all isLine given))
              Just curves ->
                counterexample (show (deviation given curves)) $
                  deviation given curves <= 3e-5 * max 1 (Transformation.factor s)
  where
    firstOf = Segment.start . NonEmpty.head
    lastOf = Segment.end . NonEmpty.last
    curve = oneof [Curves.gentle, Curves.ring]
    isLine s = Segment.bulge s == 0
    backwards = NonEmpty.reverse . fmap Segment.reverse

-- | The arcs of a contour that consists of a curve.
arcsOf :: Curve -> NonEmpty Segment
arcsOf = MeasuredPolyarc.segments . PartCurve.approximation . PartCurve.plain

-- | Some consecutive segments, or all of them.
part :: NonEmpty Segment -> Gen (NonEmpty Segment)
part segments = do
  ends <- vectorOf 2 (choose (0, length segments))
  case sort ends of
    [a, b] | some : others <- take (b - a) (NonEmpty.drop a segments) -> pure (some :| others)
    _ -> pure segments

-- | A curve that arcs replace.
replacing :: Curve -> ReplacedCurve
replacing exact = ReplacedCurve exact Tolerance.curve

-- | A contour that consists of a curve.
contour :: Curve -> Contour
contour exact =
  Contour
    { Part.contourName = Located place (Name "c"),
      Part.ends = Part.Open,
      Part.elements = fmap element (arcsOf exact),
      Part.breaks = [],
      Part.writtenElements = []
    }
  where
    place = Region 10 20
    element segment =
      Element
        { Part.segment,
          Part.origin = place,
          Part.finish = Part.plainFinish,
          Part.continues = True,
          Part.ofCurve = True,
          Part.replaced = Just (replacing exact),
          Part.bevel = Nothing
        }

-- | The largest distance of points of the curves from the segments, in mm.
deviation :: NonEmpty Segment -> NonEmpty CubicBezier -> Double
deviation segments curves =
  maximum [nearestOf (Bezier.at t c) | c <- NonEmpty.toList curves, t <- [0, 0.25 .. 1]]
  where
    nearestOf p = minimum [d | s <- NonEmpty.toList segments, let Mm d = Distance.toPoint p s]

-- | True if the curves pass all nodes of the segments.
covers :: NonEmpty Segment -> NonEmpty CubicBezier -> Bool
covers segments curves = all isPassed (fmap Segment.start segments)
  where
    isPassed :: Point -> Bool
    isPassed p = any (isJust . Bezier.nearest (Mm 3e-5) p) curves
