-- | Random polyarcs that represent one smooth curve: open ones with reversals and vertical
-- tangents, closed ones with waves, and divided lines and arcs.
module Generate.Run
  ( open,
    bent,
    closed,
    wave,
    oval,
    biarcs,
    arcFrom,
    parts,
    elements,
    run,
    curveCase,
    jobAlong,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Region (Region))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Generate (Case (..))
import Generate qualified
import Geometry.Carrier (Side (..))
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Offset.Equidistant qualified as Equidistant
import Part.Part (Element (..), Milling)
import Part.Part qualified as Part
import Test.QuickCheck hiding (elements)
import Test.QuickCheck qualified as QuickCheck
import Toolpath.Toolpath (Manner (Manner), Move (Move))

-- | A smooth open polyarc of few or many arcs and lines, from strongly curved to nearly straight.
open :: Gen [Segment]
open = do
  count <- oneof [choose (1, 6), choose (20, 120)]
  start <- Vec.point <$> choose (-100, 100) <*> choose (-100, 100)
  heading <- choose (-pi, pi)
  reach <- choose (0.05, 20)
  go (count :: Int) reach start heading 0
  where
    go count reach p heading bend
      | count <= 0 = pure []
      | otherwise = do
        l <- choose (0.1 * reach, reach)
        -- The curvature sometimes jumps, otherwise it changes a little.
        bend' <-
          frequency [(1, pure 0), (2, choose (-0.3, 0.3)), (6, (bend +) <$> choose (-0.02, 0.02))]
        let turned = max (-6) (min 6 (bend' * l))
            s = arcFrom p heading turned l
        (s :) <$> go (count - 1) reach (Segment.end s) (heading + turned) bend'

-- | A smooth polyarc whose segments have the given lengths in mm and curvatures in 1/mm.
bent :: [(Double, Double)] -> [Segment]
bent = go (Vec.point 0 0) 0
  where
    go p heading wanted = case wanted of
      [] -> []
      (l, bend) : more ->
        let s =
              arcFrom p heading (bend * l) l
         in s : go (Segment.end s) (heading + bend * l) more

-- | The arc or line from a point with a first direction and a sweep, both in rad, and a length in
-- mm.
arcFrom :: Point -> Double -> Double -> Double -> Segment
arcFrom p heading turned l
  | abs turned < 1e-9 = Straight p (Vec.shift (Vec.polar (Mm l) (Rad heading)) p)
  | otherwise =
    Arc
      { start = p,
        end = Vec.shift (Vec.rotate (Rad turned) (Vec.to centre p)) centre,
        centre,
        sweep = Rad turned
      }
  where
    centre = Vec.shift (Vec.scale (l / turned) (Vec.left (Vec.polar (Mm 1) (Rad heading)))) p

-- | A closed smooth curve as biarcs: a circle with waves. Some curves are small and consist of arcs
-- that are not longer than a usual tolerance.
closed :: Gen [Segment]
closed = do
  (r, count) <-
    frequency
      [ (5, (,) <$> choose (15, 60) <*> choose (12, 150)),
        (1, (,) <$> choose (5, 9) <*> choose (500, 900))
      ]
  waves <- choose (2, 5)
  deep <- choose (0, 0.8)
  turned <- choose (-pi, pi)
  sense <- QuickCheck.elements [1, -1]
  pure (oval r waves (deep / fromIntegral (waves * waves)) turned sense count)

-- | The curve @ρ = r·(1 + deep·cos (waves·φ))@ as biarcs between @count@ points, from the angle
-- @from@, counter-clockwise for the sense 1, clockwise for -1.
oval :: Double -> Int -> Double -> Double -> Double -> Int -> [Segment]
oval r waves deep from sense count =
  biarcs
    [ at (from + sense * 2 * pi * fromIntegral k / fromIntegral count)
      | k <- map (`mod` count) [0 .. count]
    ]
  where
    w = fromIntegral waves
    at phi =
      let rho = r * (1 + deep * cos (w * phi))
          rho' = -(r * deep * w * sin (w * phi))
          out = Vec.vec (cos phi) (sin phi)
       in ( Vec.shift (Vec.scale rho out) (Vec.point 3 (-2)),
            Vec.scale sense (Vec.unit (Vec.add (Vec.scale rho' out) (Vec.scale rho (Vec.left out))))
          )

-- | The wave @y = a·sin (2πx/l)@ from 0 to @far@, as biarcs between @count + 1@ points.
wave :: Double -> Double -> Double -> Int -> [Segment]
wave a l far count = biarcs [at (far * fromIntegral k / fromIntegral count) | k <- [0 .. count]]
  where
    at x =
      let p =
            2 * pi * x / l
       in (Vec.point x (a * sin p), Vec.unit (Vec.vec 1 (2 * pi * a / l * cos p)))

-- | Biarcs through points with given directions.
biarcs :: [(Point, Vec)] -> [Segment]
biarcs points = concat (zipWith pair points (drop 1 points))
  where
    pair (p, t) (q, u) =
      let v = Vec.to p q
          along = Vec.dot v (Vec.add t u)
          spread = 2 * (1 - Vec.dot t u)
          d =
            if spread < 1e-12
              then Vec.dot v v / (2 * along)
              else (sqrt (along * along + spread * Vec.dot v v) - along) / spread
          m = Vec.interpolate 0.5 (Vec.shift (Vec.scale d t) p) (Vec.shift (Vec.scale (-d) u) q)
       in [touching p t m, Segment.reverse (touching q (Vec.negate u) m)]

-- | The arc or line from a point in a direction to another point.
touching :: Point -> Vec -> Point -> Segment
touching p t q
  | abs turned < 1e-9 = Straight p q
  | otherwise =
    Arc
      { start = p,
        end = q,
        centre = Vec.shift (Vec.scale (Vec.dot v v / (2 * Vec.dot n v)) n) p,
        sweep = Rad turned
      }
  where
    v = Vec.to p q
    n = Vec.left t
    turned = let Rad half = Vec.signedAngle t v in 2 * half

-- | A segment divided into @n@ parts of equal length.
parts :: Int -> Segment -> [Segment]
parts n s
  | n <= 1 = [s]
  | otherwise = let (a, b) = Segment.cutAt (1 / fromIntegral n) s in a : parts (n - 1) b

-- | The elements of a contour that consists of several curves, each given as segments. All segments
-- of a curve but the first are marked as its continuation.
elements :: [[Segment]] -> [Element]
elements =
  concatMap
    ( zipWith
        (\k s -> Element s (Region 0 0) Part.plainFinish (k > 0) True Nothing Nothing)
        [0 :: Int ..]
    )

-- | The rapid moves along the segments of one curve, at height 0.
run :: [Segment] -> NonEmpty Move
run =
  NonEmpty.fromList
    . zipWith
      (\k s -> Move s (Manner (Mm 0, Mm 0) Part.Rapid False) (Region 0 0) (k > 0))
      [0 :: Int ..]

-- | A closed curve with a cutter that fits on one of its sides. Toolpaths narrower than 2 mm are
-- excluded: the laws do not hold for paths shorter than the braking distance of 1.6 mm or narrower
-- than a tolerance.
curveCase :: Gen Case
curveCase = do
  chain <- closed
  side <- QuickCheck.elements [LeftOf, RightOf]
  r <- choose (0.5, 6)
  let contour = Polyarc Closed (NonEmpty.fromList chain)
  case Equidistant.equidistant side (Mm r) contour of
    Right found | isWide found -> pure Case {contour, side, radius = Mm r, pieces = found}
    _ -> curveCase
  where
    -- The curves are so round that their width is about the same in every direction.
    isWide found =
      let p :| more = fmap (Segment.start . Equidistant.segment) found
       in any (\q -> Vec.distance p q >= Mm 2) more

-- | The milling job of a case whose contour is one curve.
jobAlong :: Case -> Milling
jobAlong c =
  job
    { Part.contour =
        (Part.contour job)
          { Part.elements =
              NonEmpty.fromList (elements [NonEmpty.toList (segments (contour c))])
          }
    }
  where
    job = Generate.job c
