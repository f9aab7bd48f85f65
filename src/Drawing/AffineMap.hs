-- | Affine maps of the plane, and their exact application to the shapes of a drawing.
--
-- Lines, Bézier curves and splines are mapped by their points. An arc is an arc again under a
-- similarity, with or without a reflection, and else a part of an ellipse.
module Drawing.AffineMap
  ( AffineMap (..),

    -- * Construction
    identity,
    translation,
    scaling,
    rotation,
    after,

    -- * Application
    point,
    vector,
    shape,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Drawing.Drawing (Ellipse (..), PathPart (..), Shape (..), Spline (..))
import Drawing.Ellipse qualified as Ellipse
import Drawing.Tolerance qualified as Tolerance
import Geometry.Carrier (Circle (Circle))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point, Vec (..))
import Geometry.Vec qualified as Vec

-- | The map of (x, y) to @(xx·x + xy·y + dx, yx·x + yy·y + dy)@, with dx and dy in mm.
data AffineMap = AffineMap
  { xx :: Double,
    xy :: Double,
    yx :: Double,
    yy :: Double,
    dx :: Double,
    dy :: Double
  }
  deriving stock (Eq, Show)

-- | The map that changes nothing.
identity :: AffineMap
identity = scaling 1 1

-- | The translation by a vector.
translation :: Vec -> AffineMap
translation (Vec x y) = identity {dx = x, dy = y}

-- | The scaling of x and of y by a factor each, about the origin. A negative factor mirrors.
scaling :: Double -> Double -> AffineMap
scaling kx ky = AffineMap {xx = kx, xy = 0, yx = 0, yy = ky, dx = 0, dy = 0}

-- | The rotation about the origin, counter-clockwise positive.
rotation :: Rad -> AffineMap
rotation (Rad a) =
  AffineMap {xx = cos a, xy = negate (sin a), yx = sin a, yy = cos a, dx = 0, dy = 0}

-- | The map that applies @a@ first and then @b@.
after :: AffineMap -> AffineMap -> AffineMap
after b a =
  AffineMap
    { xx = xx b * xx a + xy b * yx a,
      xy = xx b * xy a + xy b * yy a,
      yx = yx b * xx a + yy b * yx a,
      yy = yx b * xy a + yy b * yy a,
      dx = xx b * dx a + xy b * dy a + dx b,
      dy = yx b * dx a + yy b * dy a + dy b
    }

-- | The image of a point.
point :: AffineMap -> Point -> Point
point m p = Vec.shift (vector m (Vec.vec (Vec.x p) (Vec.y p))) (Vec.point (dx m) (dy m))

-- | The image of a vector.
vector :: AffineMap -> Vec -> Vec
vector AffineMap {xx, xy, yx, yy} (Vec x y) = Vec.vec (xx * x + xy * y) (yx * x + yy * y)

-- | The image of a shape.
shape :: AffineMap -> Shape -> Shape
shape m s = case s of
  Path ends parts -> Path ends (fmap (part m) parts)
  FullCircle (Circle c (Mm r)) -> wholeOf c (Vec.vec r 0) (Vec.vec 0 r)
  FullEllipse e -> let (u, v) = Ellipse.semiDiameters e in wholeOf (middle e) u v
  Dot p -> Dot (point m p)
  where
    wholeOf c u v = Ellipse.whole (point m c) (vector m u) (vector m v)

-- | The image of a part of a path.
part :: AffineMap -> PathPart -> PathPart
part m p = case p of
  Plain (Straight a b) -> Plain (Straight (point m a) (point m b))
  Plain Arc {start, end, centre, sweep = sweep@(Rad s)}
    | isSimilarity m ->
      Plain Arc {start = point m start, end = point m end, centre = point m centre, sweep = mapped}
    | otherwise ->
      let out = Vec.to centre start
       in Ellipse.part (point m centre) (vector m out) (vector m (Vec.left out)) 0 s
    where
      mapped = if determinant m < 0 then Rad (negate s) else sweep
  EllipseArc e from to ->
    let (u, v) = Ellipse.semiDiameters e
     in Ellipse.part (point m (middle e)) (vector m u) (vector m v) from to
  Bezier points weights -> Bezier (fmap (point m) points) weights
  BSpline s -> BSpline s {controls = fmap (point m) (controls s)}

determinant :: AffineMap -> Double
determinant AffineMap {xx, xy, yx, yy} = xx * yy - xy * yx

-- | True of a similarity, with or without a reflection: the images of the unit vectors have the
-- same length and are square to each other, up to rounding.
isSimilarity :: AffineMap -> Bool
isSimilarity AffineMap {xx, xy, yx, yy} =
  abs (a - b) <= allowed && abs (xx * xy + yx * yy) <= allowed
  where
    a = xx * xx + yx * yx
    b = xy * xy + yy * yy
    allowed = Tolerance.sameAxes * max a b
