-- | Operations on unpacked coordinates against those of "Geometry.Segment".
module Geometry.Segment.FastSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.RandomSegment (point, segment)
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Segment.Fast qualified as FastSegment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck hiding (tolerance)

spec :: Spec
spec = do
  it "hypotenuse: is the norm of a vector, exactly (catches a term that is not squared)" $
    property $ \a b -> FastSegment.hypotenuse a b === Vec.norm (Vec.vec a b)
  it "lengthOf: is the length of a segment, exactly (catches a sweep with its sign)" $
    property $
      forAll segment $ \s -> Mm (FastSegment.lengthOf s) === Segment.length s
  it "begin, finish: are the ends of a segment, exactly (catches exchanged ends)" $
    property $
      forAll segment $ \s ->
        (uncurry Vec.point (FastSegment.begin s), uncurry Vec.point (FastSegment.finish s))
          === (Segment.start s, Segment.end s)
  it "at: is the point at a fraction of the length (catches a rotation in the wrong sense)" $
    property $
      forAll ((,) <$> segment <*> choose (0, 1)) $ \(s, t) ->
        close (uncurry Vec.point (FastSegment.at s t)) (Segment.at t s)
  it "shareOf: is the fraction at the foot on a line, exactly (catches an exchanged end)" $
    property $
      forAll ((,,) <$> point <*> point <*> point) $ \(a, b, p) ->
        FastSegment.shareOf (Vec.x a) (Vec.y a) (Vec.x b) (Vec.y b) (Vec.x p) (Vec.y p)
          === Segment.fraction (Straight a b) p
  it "foot: is the fraction at the foot of a point (catches a full turn that is not added)" $
    property $
      forAll ((,) <$> segment <*> point) $ \(s, p) ->
        let fast = FastSegment.foot s (Vec.x p) (Vec.y p)
            slow = Segment.fraction s p
         in -- Just before the start of an arc, rounding decides whether a full turn is added.
            not (isNearEnd s slow)
              ==> counterexample
                (show (fast, slow))
                (abs (fast - slow) <= tolerance * (1 + abs slow))
  it "footOn: is the fraction at the nearest point (catches a foot after the end of a line)" $
    property $
      forAll ((,) <$> segment <*> point) $ \(s, p) ->
        let t = FastSegment.footOn s (Vec.x p) (Vec.y p)
            Mm found = Vec.distance p (Segment.at t s)
            Mm least = Distance.toPoint p s
         in counterexample
              (show (t, found, least))
              (t >= 0 && t <= 1 && abs (found - least) <= tolerance)
  it "inSector: is true if the foot lies on the arc (catches an arc above half a turn)" $
    property $
      forAll ((,) <$> segment <*> point) $ \(s, p) ->
        let t = Segment.fraction s p
            isLine = FastSegment.isLine s
         in not (isLine || isNearEnd s t)
              ==> FastSegment.inSector s (Vec.x p) (Vec.y p) === Segment.hasFootOf s p
  it "box: contains the box of the segment (catches half of the sagitta)" $
    property $
      forAll segment $ \s ->
        let BoundingBox l b r t = BoundingBox.ofSegment s
            BoundingBox l' b' r' t' = FastSegment.box s
         in counterexample (show (BoundingBox.ofSegment s, FastSegment.box s)) $
              l' <= l + tolerance
                && b' <= b + tolerance
                && r' >= r - tolerance
                && t' >= t - tolerance
  it "between: is the part between two fractions (catches a sweep that is too large)" $
    property $
      forAll ((,,) <$> segment <*> choose (0, 1) <*> choose (0, 1)) $ \(s, t, u) ->
        let (a, b) = (min t u, max t u)
            part = FastSegment.between s a b
            (_, second) = Segment.cutAt a s
            (expected, _) = Segment.cutAt ((b - a) / (1 - a)) second
         in a < 1
              ==> conjoin
                [close (Segment.at f part) (Segment.at f expected) | f <- [0, 0.3, 0.8, 1]]

-- | The largest difference, in mm or as a fraction, between fast and slow results that are not
-- computed by the same operations.
tolerance :: Double
tolerance = 1e-9

close :: Point -> Point -> Property
close p q = counterexample (show (p, q)) (Vec.distance p q <= Mm tolerance)

-- | True if a fraction of a segment's length is so near to an end that rounding decides on which
-- side of the end it lies.
isNearEnd :: Segment -> Double -> Bool
isNearEnd s t = any (\e -> abs (t - e) <= tolerance) [0, 1, turn]
  where
    turn = case s of
      Straight _ _ -> 0
      Arc {sweep = Rad a} -> 2 * pi / abs a
