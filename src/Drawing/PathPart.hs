-- | Parts of paths: their ends, their reversal, the moving of their ends, and their segments.
module Drawing.PathPart
  ( start,
    end,
    middlePoint,
    reversed,
    withEnds,
    joint,
    meeting,
    ellipseCurves,
    segments,
  )
where

import Base.Quantity (Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Semigroup (sconcat)
import Data.Vector qualified as Vector
import Drawing.Drawing (Ellipse (..), PathPart (..), Spline (..), ellipsePoint)
import Drawing.OutlineTolerance qualified as Tolerance
import Geometry.ArcFitting.CurveFit qualified as CurveFit
import Geometry.Carrier (Circle (..), Sense (..))
import Geometry.Curve qualified as Curve
import Geometry.Curve.Bezier qualified as Bezier
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The first and the last point of a part.
start, end :: PathPart -> Point
start part = case part of
  Plain s -> Segment.start s
  EllipseArc e from _ -> ellipsePoint e from
  Bezier ps _ -> NonEmpty.head ps
  BSpline s -> NonEmpty.head (controls s)
end part = case part of
  Plain s -> Segment.end s
  EllipseArc e _ to -> ellipsePoint e to
  Bezier ps _ -> NonEmpty.last ps
  BSpline s -> NonEmpty.last (controls s)

-- | A point between the ends of a part that is the same for the reversed part: the middle of a
-- line, of an arc and of a part of an ellipse, the mean of the control points of a curve.
middlePoint :: PathPart -> Point
middlePoint part = case part of
  Plain s -> Segment.at 0.5 s
  EllipseArc e from to -> ellipsePoint e ((from + to) / 2)
  Bezier ps _ -> mean ps
  BSpline s -> mean (controls s)
  where
    mean ps =
      let n = fromIntegral (NonEmpty.length ps)
       in Vec.point (sum (fmap Vec.x ps) / n) (sum (fmap Vec.y ps) / n)

-- | The part in the opposite direction.
reversed :: PathPart -> PathPart
reversed part = case part of
  Plain s -> Plain (Segment.reverse s)
  EllipseArc e from to -> EllipseArc e to from
  Bezier ps weights -> Bezier (NonEmpty.reverse ps) (NonEmpty.reverse <$> weights)
  BSpline s ->
    BSpline
      s
        { knots = let ks = knots s in [maximum ks + minimum ks - k | k <- reverse ks],
          controls = NonEmpty.reverse (controls s),
          weights = NonEmpty.reverse <$> weights s
        }

-- | Parts from one point to another instead of a part whose ends are near to these points. A line
-- stays a line. An arc keeps its sweep, and its centre if only rounding moves its ends; it becomes
-- a circle if it has to end where it begins. Curves move their first and last control points. A
-- part of an ellipse stays as it is if only rounding would move its ends, and becomes Bézier curves
-- otherwise.
withEnds :: Point -> Point -> PathPart -> NonEmpty PathPart
withEnds p q part
  | p == start part && q == end part = part :| []
  | otherwise = case part of
    Plain (Straight _ _) -> Plain (Straight p q) :| []
    Plain (Arc a b centre sweep)
      | isRounding p a && isRounding q b -> Plain (Arc p q centre sweep) :| []
    Plain (Arc _ _ centre (Rad sweep))
      | p == q && abs sweep > pi ->
        let sense = if sweep > 0 then CounterClockwise else Clockwise
         in Plain (Segment.fullCircle sense (Circle centre (Vec.distance centre p)) p) :| []
    Plain s -> Plain (Segment.fromBulge p q (Segment.bulge s)) :| []
    Bezier ps weights -> Bezier (between ps) weights :| []
    BSpline s -> BSpline s {controls = between (controls s)} :| []
    EllipseArc e from to
      | isRounding p (start part) && isRounding q (end part) -> part :| []
      | otherwise -> moved (ellipseCurves e from to)
  where
    moved parts = case parts of
      only :| [] -> withEnds p q only
      first :| second : more ->
        withEnds p (end first) first <> withLast (second :| more)
    withLast parts = case parts of
      final :| [] -> withEnds (start final) q final
      one :| two : more -> one :| NonEmpty.toList (withLast (two :| more))
    isRounding a b = Vec.distance a b <= Tolerance.rounding
    between ps = case NonEmpty.toList ps of
      _ : more@(_ : _) -> p :| (init more <> [q])
      _ -> p :| [q]

-- | The joint between the end of a part and the start of the next one. Ends that count as the same
-- meet at the end of a line, whose numbers are those of the file. Otherwise the joint of a line and
-- another part lies at the end of the other part, and that of two lines in the middle of the gap.
joint :: PathPart -> PathPart -> Point
joint a b
  | p == q = p
  | Vec.distance p q <= Tolerance.same = if isLine b && not (isLine a) then q else p
  | not (isLine a) = p
  | not (isLine b) = q
  | otherwise = Vec.shift (Vec.scale 0.5 (Vec.to p q)) p
  where
    (p, q) = (end a, start b)

-- | Parts whose ends count as the same, moved so that each begins exactly where the one before it
-- ends. Of two parts that meet, a line moves rather than another part, and the earlier one of two
-- lines.
meeting :: Ends -> NonEmpty PathPart -> NonEmpty PathPart
meeting ends parts = sconcat (NonEmpty.zipWith between (NonEmpty.zip starts stops) parts)
  where
    following = NonEmpty.tail parts <> [NonEmpty.head parts | ends == Closed]
    places = zipWith place (NonEmpty.toList parts) following
    begin = case reverse places of
      back : _ | ends == Closed -> back
      _ -> start (NonEmpty.head parts)
    starts = begin :| places
    stops = foldr NonEmpty.cons (end (NonEmpty.last parts) :| []) places
    between (p, q) = withEnds p q
    place a b = if isLine a then start b else end a

isLine :: PathPart -> Bool
isLine part = case part of
  Plain (Straight _ _) -> True
  _ -> False

-- | Part of an ellipse from one parameter in radians to another, as Bézier curves
-- ("Geometry.Curve.Bezier").
ellipseCurves :: Ellipse -> Double -> Double -> NonEmpty PathPart
ellipseCurves Ellipse {middle, major, minor, direction} from to =
  fmap curve (Bezier.ellipse middle major minor direction (Rad from) (Rad to))
  where
    curve c = Bezier (listed middle (Bezier.controlPoints c)) (Just (listed 1 (Bezier.weights c)))
    listed other list = case list of
      first : more -> first :| more
      [] -> other :| []

-- | Lines and arcs along a part: its own, or those within 'Tolerance.curve' of a curve. A curve
-- that the geometry does not accept has the lines between its control points.
segments :: PathPart -> NonEmpty Segment
segments part = case part of
  Plain s -> s :| []
  EllipseArc e@Ellipse {middle, major, minor, direction} from to ->
    along
      (ellipsePoint e from :| [ellipsePoint e to])
      (Curve.ellipse middle major minor direction (Rad from) (Rad to))
  Bezier controls weights ->
    along controls (Curve.bezier (vectorOf controls) (weightsOf controls weights))
  BSpline Spline {degree, knots, controls, weights} ->
    case Curve.knotVector degree (NonEmpty.length controls) knots of
      Right vector ->
        along controls (Curve.bspline vector (vectorOf controls) (weightsOf controls weights))
      Left _ -> polygon controls
  where
    vectorOf = Vector.fromList . NonEmpty.toList
    weightsOf controls weights =
      either (const Nothing) Just . Curve.weightsFor (NonEmpty.length controls) . NonEmpty.toList
        =<< weights
    along controls made = case made of
      Right c -> MeasuredPolyarc.segments (CurveFit.approximate Tolerance.curve c)
      Left _ -> polygon controls
    polygon ps = case NonEmpty.tail ps of
      q : more -> NonEmpty.zipWith Straight ps (q :| more)
      [] -> Straight (NonEmpty.head ps) (NonEmpty.head ps) :| []
