-- | Closed contours of usual shapes, counter-clockwise: rectangles, slots, polygons, ellipses and
-- gears with involute teeth. Lengths are in mm, angles in radians.
--
-- Ellipses and involutes are replaced by arcs within 'Tolerance.shape' of the exact curve.
module Part.Shape
  ( ShapeSegment (..),
    ShapeFault (..),
    Gear (..),
    circle,
    rectangle,
    rounded,
    slot,
    polygon,
    ellipse,
    gear,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.Foldable (maximumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Geometry.ArcFitting.ParametricFit (ParametricCurve (..))
import Geometry.ArcFitting.ParametricFit qualified as ParametricFit
import Geometry.Carrier (Circle (Circle), Line (Line), Sense (..))
import Geometry.Curve qualified as Curve
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Contour (ReplacedCurve (ReplacedCurve))
import Part.Tolerance qualified as PartTolerance

-- | A segment of a shape.
data ShapeSegment = ShapeSegment
  { -- | true if the segment is one of the arcs that replace a curve
    isOfCurve :: Bool,
    -- | true if the segment continues the one before it in the same curve
    isContinued :: Bool,
    -- | the curve that the segment replaces a part of, if it is known
    shapeCurve :: Maybe ReplacedCurve,
    shapeSegment :: Segment
  }
  deriving stock (Eq, Show)

-- | A reason why there is no such shape.
data ShapeFault
  = -- | two corners or centres that must differ are the same, or lie on one line along an axis
    NoExtent
  | -- | the radius of the corners is larger than this half of the shorter side
    CornersTooRound Mm
  | -- | fewer than three corners
    TooFewCorners
  | -- | a pressure angle that is not between 0 and 60 degrees
    WrongPressureAngle Rad
  | -- | the angle of a part of an ellipse, which is 0 or larger than a full turn
    WrongSweep Rad
  | -- | a gear of so few teeth that it has no root circle
    NoRootCircle
  | -- | the flanks of a tooth meet below its tip
    PointedTeeth
  | -- | the flanks of neighbouring teeth meet above the root
    NoRoot
  deriving stock (Eq, Show)

-- | A spur gear: the module in mm, the count of teeth, and the pressure angle.
data Gear = Gear {gearModule :: Double, teeth :: Int, pressureAngle :: Double}

type Shape = Either ShapeFault (NonEmpty ShapeSegment)

-- | A circle that begins at its point with the largest x.
circle :: Circle -> NonEmpty ShapeSegment
circle c@(Circle o r) =
  plain (Segment.fullCircle CounterClockwise c (Vec.shift (Vec.polar r (Rad 0)) o)) :| []

-- | A rectangle between two opposite corners; it begins at the corner with the least x and y.
rectangle :: Point -> Point -> Shape
rectangle p q
  | width <= short || height <= short = Left NoExtent
  | otherwise = polygon (corner 0 0 :| [corner 1 0, corner 1 1, corner 0 1])
  where
    (width, height) = (abs (Vec.x q - Vec.x p), abs (Vec.y q - Vec.y p))
    corner u v =
      Vec.point
        (min (Vec.x p) (Vec.x q) + u * width)
        (min (Vec.y p) (Vec.y q) + v * height)

-- | A rectangle whose corners are arcs of a radius; it begins after the arc of its first corner.
rounded :: Point -> Point -> Mm -> Shape
rounded p q (Mm r)
  | width <= short || height <= short = Left NoExtent
  | r > half + short = Left (CornersTooRound (Mm half))
  | otherwise = closed (concatMap side [0 .. 3])
  where
    (width, height) = (abs (Vec.x q - Vec.x p), abs (Vec.y q - Vec.y p))
    half = min width height / 2
    (left, below) = (min (Vec.x p) (Vec.x q) + r, min (Vec.y p) (Vec.y q) + r)
    -- The centres of the arcs, counter-clockwise from the lower left one.
    centres =
      [Vec.point x y | (x, y) <- [(left, below), (right, below), (right, above), (left, above)]]
    (right, above) = (left + width - 2 * r, below + height - 2 * r)
    side k =
      let (here, next) = (centres !! k, centres !! ((k + 1) `mod` 4))
          out turns = Vec.polar (Mm r) (Rad ((fromIntegral k - 1 + turns) * pi / 2))
          corner = Vec.shift (out 0) next
       in [ Straight (Vec.shift (out 0) here) corner,
            Arc {start = corner, end = Vec.shift (out 1) next, centre = next, sweep = Rad (pi / 2)}
          ]

-- | A slot of a width around the line between two centres.
slot :: Point -> Point -> Mm -> Shape
slot p q (Mm width)
  | Vec.norm (Vec.to p q) <= short = Left NoExtent
  | otherwise =
    closed
      [ Straight (beside (-1) p) (beside (-1) q),
        Arc {start = beside (-1) q, end = beside 1 q, centre = q, sweep = Rad pi},
        Straight (beside 1 q) (beside 1 p),
        Arc {start = beside 1 p, end = beside (-1) p, centre = p, sweep = Rad pi}
      ]
  where
    across = Vec.scale (width / 2) (Vec.left (Vec.unit (Vec.to p q)))
    beside side c = Vec.shift (Vec.scale side across) c

-- | A polygon through its corners, in their order.
polygon :: NonEmpty Point -> Shape
polygon corners
  | length sides < 3 || all isOnOneLine list = Left TooFewCorners
  | otherwise = closed sides
  where
    list = NonEmpty.toList corners
    first = NonEmpty.head corners
    farthest = maximumBy (comparing (Vec.distance first)) list
    isOnOneLine p =
      abs (Vec.cross (Vec.to first farthest) (Vec.to first p))
        <= short * (let Mm l = Vec.distance first farthest in l)
    sides =
      [Straight a b | (a, b) <- zip list (drop 1 list <> take 1 list), not (Vec.isNear a b)]

-- | An ellipse with its semi-axes; the first one has an angle to the x axis. It begins at the end
-- of the first semi-axis.
ellipse :: Point -> Mm -> Mm -> Rad -> NonEmpty ShapeSegment
ellipse o (Mm a) (Mm b) turn =
  NonEmpty.map
    (\s -> ShapeSegment {isOfCurve = True, isContinued = True, shapeCurve, shapeSegment = s})
    (gapless (foldr1 (<>) (ParametricFit.approximate PartTolerance.shape curve)))
  where
    shapeCurve = case Curve.ellipse o (Mm a) (Mm b) turn (Rad 0) (Rad (2 * pi)) of
      Right exact -> Just (ReplacedCurve exact PartTolerance.shape)
      Left _ -> Nothing
    curve =
      ParametricCurve
        { place = \t -> Vec.shift (Vec.rotate turn (Vec.vec (a * cos t) (b * sin t))) o,
          direction = \_ t -> Vec.unit (Vec.rotate turn (Vec.vec (-(a * sin t)) (b * cos t))),
          begin = 0,
          breaks = fmap (* (pi / 2)) (1 :| [2, 3, 4])
        }

-- | A spur gear about (0, 0), whose first tooth points along the x axis. The module is m and the
-- count of teeth z. The pitch circle has the radius m·z\/2, the tip circle m more and the root
-- circle 1.25 m less (ISO 53). The flanks are involutes of the base circle, whose radius is that of
-- the pitch circle times the cosine of the pressure angle. Below the base circle they are radial
-- lines; an undercut, as hobbing leaves it in gears of few teeth, is not made.
gear :: Gear -> Shape
gear g@Gear {gearModule = m, teeth, pressureAngle}
  | pressureAngle <= 0 || pressureAngle >= pi / 3 = Left (WrongPressureAngle (Rad pressureAngle))
  | root <= 0 = Left NoRootCircle
  | halfAt tip <= 0 = Left PointedTeeth
  | gap <= 0 = Left NoRoot
  | otherwise = Right (gaplessShape (NonEmpty.fromList (concatMap turned [0 .. teeth - 1])))
  where
    z = fromIntegral teeth
    (base, tip, root) = (baseRadius g, m * z / 2 + m, m * z / 2 - 1.25 * m)
    low = max base root
    -- Half of the angle of a tooth at a radius, and the angle between two teeth at the root.
    halfAt r = let t = rollAt base r in halfAtBase g - (t - atan t)
    gap = 2 * pi / z - 2 * halfAt low
    rising = flank g low tip
    falling = map mirrored (reverse rising)
    mirrored =
      Segment.reverse
        . Transformation.segment
          (Transformation.reflection (Line (Vec.point 0 0) (Vec.point 1 0)))
    tooth =
      [plain (Straight (at root (-(halfAt low))) (at low (-(halfAt low)))) | low > root]
        <> curved rising
        <> [plain (arcAbout tip (-(halfAt tip)) (halfAt tip))]
        <> curved falling
        <> [plain (Straight (at low (halfAt low)) (at root (halfAt low))) | low > root]
        <> [plain (arcAbout root (halfAt low) (halfAt low + gap))]
    turned :: Int -> [ShapeSegment]
    turned k =
      let turn = Transformation.rotation (Rad (2 * pi * fromIntegral k / z)) (Vec.point 0 0)
       in [s {shapeSegment = Transformation.segment turn (shapeSegment s)} | s <- tooth]
    at r angle = Vec.shift (Vec.polar (Mm r) (Rad angle)) (Vec.point 0 0)
    arcAbout r from to =
      Arc {start = at r from, end = at r to, centre = Vec.point 0 0, sweep = Rad (to - from)}

-- | The radius of the base circle of a gear in mm.
baseRadius :: Gear -> Double
baseRadius g = gearModule g * fromIntegral (teeth g) / 2 * cos (pressureAngle g)

-- | Half of the angle of a tooth at the base circle.
halfAtBase :: Gear -> Double
halfAtBase g = pi / (2 * fromIntegral (teeth g)) + tan (pressureAngle g) - pressureAngle g

-- | The roll angle of the involute of a base circle at a radius: the tangent of the angle between
-- the involute and the radius. The involute has turned by the roll angle less its arc tangent.
rollAt :: Double -> Double -> Double
rollAt base r = sqrt (max 0 ((r / base) * (r / base) - 1))

-- | The flank of the first tooth on the side of negative angles, between two radii.
flank :: Gear -> Double -> Double -> [Segment]
flank g low tip =
  concatMap NonEmpty.toList . NonEmpty.toList $
    ParametricFit.approximate
      PartTolerance.shape
      ParametricCurve
        { place = \t ->
            let p = Vec.vec (base * (cos t + t * sin t)) (base * (sin t - t * cos t))
             in Vec.shift (Vec.rotate (Rad (-(halfAtBase g))) p) (Vec.point 0 0),
          direction = \_ t -> Vec.polar (Mm 1) (Rad (t - halfAtBase g)),
          begin = rollAt base low,
          breaks = rollAt base tip :| []
        }
  where
    base = baseRadius g

-- | Segments that replace a curve, in order.
curved :: [Segment] -> [ShapeSegment]
curved segments =
  [ ShapeSegment {isOfCurve = True, isContinued, shapeCurve = Nothing, shapeSegment}
    | (isContinued, shapeSegment) <- zip (False : repeat True) segments
  ]

-- | A closed shape of separate segments. Segments without length are left out.
closed :: [Segment] -> Shape
closed segments = case filter isLong segments of
  [] -> Left NoExtent
  s : more -> Right (gaplessShape (fmap plain (s :| more)))
  where
    isLong s = Segment.length s > Mm short

plain :: Segment -> ShapeSegment
plain s =
  ShapeSegment {isOfCurve = False, isContinued = False, shapeCurve = Nothing, shapeSegment = s}

-- | The segments, each of which begins exactly where the one before ends.
gapless :: NonEmpty Segment -> NonEmpty Segment
gapless = fmap shapeSegment . gaplessShape . fmap plain

gaplessShape :: NonEmpty ShapeSegment -> NonEmpty ShapeSegment
gaplessShape =
  Polyarc.closeGaps shapeSegment (\s shape -> shape {shapeSegment = s}) Polyarc.Closed

-- | The length in mm below which a side has no extent.
short :: Double
short = let Mm l = Tolerance.coincident in l
