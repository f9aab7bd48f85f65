-- | Random shapes of drawings, and random affine maps, for tests.
module Generate.DrawingShape
  ( shape,
    path,
    ellipse,
    spline,
    point,
    affineMap,
    similarity,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Drawing.AffineMap (AffineMap, after)
import Drawing.AffineMap qualified as AffineMap
import Drawing.Drawing (Ellipse (Ellipse), PathPart (..), Shape (..), Spline (Spline))
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (..))
import Geometry.RandomSegment (point, segment)
import Geometry.Vec qualified as Vec
import Test.QuickCheck

-- | A shape of any kind. The parts of a path need not join.
shape :: Gen Shape
shape =
  oneof
    [ path,
      FullCircle <$> (Circle <$> point <*> (Mm <$> choose (0.1, 40))),
      FullEllipse <$> ellipse,
      Dot <$> point
    ]

-- | A path of one to three parts of any kinds.
path :: Gen Shape
path = Path Open . NonEmpty.fromList <$> (choose (1, 3) >>= \n -> vectorOf n part)

part :: Gen PathPart
part =
  oneof
    [ Plain <$> segment,
      EllipseArc <$> ellipse <*> choose (-7, 0) <*> choose (0.1, 5),
      choose (2, 4) >>= \n -> Bezier <$> points (n + 1) <*> optional (positive (n + 1)),
      BSpline <$> spline
    ]

-- | An ellipse, sometimes a slender one.
ellipse :: Gen Ellipse
ellipse = do
  middle <- point
  a <- choose (0.1, 40)
  share <- oneof [choose (0.01, 0.99), choose (0.9, 0.9999)]
  Ellipse middle (Mm a) (Mm (share * a)) . Rad <$> choose (-3, 3)

-- | A clamped spline. Inner knots may occur several times.
spline :: Gen Spline
spline = do
  degree <- choose (1, 4)
  inner <- choose (0, 5) >>= \n -> sort <$> vectorOf n (elements [1, 1.5, 2, 3, 4.25, 5])
  let allowed = concatMap (take degree) (grouped inner)
      knots = replicate (degree + 1) 0 <> allowed <> replicate (degree + 1) 7
      count = degree + 1 + length allowed
  Spline degree knots <$> points count <*> optional (positive count)
  where
    grouped xs = case xs of
      [] -> []
      x : _ -> let (same, others) = span (== x) xs in same : grouped others

points :: Int -> Gen (NonEmpty Vec.Point)
points n = NonEmpty.fromList <$> vectorOf n point

positive :: Int -> Gen (NonEmpty Double)
positive n = NonEmpty.fromList <$> vectorOf n (choose (0.2, 5))

optional :: Gen a -> Gen (Maybe a)
optional gen = oneof [pure Nothing, Just <$> gen]

-- | A map of any kind: one of three is a similarity, one of three mirrors.
affineMap :: Gen AffineMap
affineMap = oneof [similarity, stretched, skewed]
  where
    stretched = do
      m <- similarity
      k <- AffineMap.scaling <$> factor <*> factor
      n <- similarity
      pure (m `after` k `after` n)
    skewed = do
      m <- similarity
      s <- choose (-2, 2)
      pure (m `after` AffineMap.identity {AffineMap.xy = s})
    factor = oneof [choose (0.2, 3), choose (-3, -0.2)]

-- | A rotation, a scaling by factors of one size, and a translation.
similarity :: Gen AffineMap
similarity = do
  a <- oneof [choose (-4, 4), elements [0, pi / 2, pi]]
  k <- choose (0.2, 3)
  mirror <- elements [1, -1]
  v <- Vec.to (Vec.point 0 0) <$> point
  pure
    ( AffineMap.translation v `after` AffineMap.rotation (Rad a)
        `after` AffineMap.scaling k (mirror * k)
    )
