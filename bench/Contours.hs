-- | The contours of the benchmark, by family and size. They are closed and counter-clockwise;
-- coordinates are in mm.
module Contours
  ( Family (..),
    name,
    contour,
    sizes,
    small,
    distances,
  )
where

import Data.Bits (shiftR, (.&.))
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Text (Text)
import Geometry.FlatPolyarc (FlatPolyarc (FlatPolyarc))
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..))
import Noise qualified

-- | The families of contours.
data Family
  = -- | lobes of tangent lines and arcs of 3 mm
    Flange
  | -- | teeth on a ring, with sharp inner corners
    Comb
  | -- | as 'Comb', with a chamfer in each root; the offset reverses the chamfers
    ChamferedComb
  | -- | a closed curve that fills a square: points near to one another are far apart along the
    -- curve
    Moore
  | -- | a circle with noise smaller than the offset, one segment for each mm: the raw offset has
    -- about 2.4 self-intersections for each segment
    Star
  | -- | as 'Star', on a circle of fixed size: the number of self-intersections grows with the
    -- square of the number of segments
    FixedStar
  deriving stock (Eq, Show, Enum, Bounded)

-- | The name of a family in the tables and files.
name :: Family -> Text
name family = case family of
  Flange -> "flange"
  Comb -> "comb"
  ChamferedComb -> "combch"
  Moore -> "moore"
  Star -> "star"
  FixedStar -> "starfix"

-- | Numbers of segments, near the powers of ten from 10³.
sizes :: Family -> [Int]
sizes family = case family of
  Moore -> [4 ^ (5 :: Int), 4 ^ (7 :: Int), 4 ^ (8 :: Int), 4 ^ (10 :: Int)]
  ChamferedComb -> [1200, 12000, 120000, 999996]
  FixedStar -> [1000, 10000, 100000]
  _ -> [1000, 10000, 100000, 1000000]

-- | The number of segments of the small contour that is offset before the measurement.
small :: Family -> Int
small family = case family of
  Moore -> 4 ^ (4 :: Int)
  ChamferedComb -> 120
  _ -> 100

-- | The offsets in mm, positive outwards.
distances :: Family -> [Double]
distances family = case family of
  Flange -> [2, -2]
  Comb -> [2]
  ChamferedComb -> [2]
  Moore -> [1.6]
  Star -> [5, -5]
  FixedStar -> [5]

-- | A contour of @n@ segments.
contour :: Family -> Int -> FlatPolyarc
contour family n = case family of
  Flange -> generated n (flange n)
  Comb -> generated n (comb n)
  ChamferedComb -> generated n (chamfered n)
  Moore ->
    let curve = generated n (moore n)
     in if FlatPolyarc.area curve < 0 then generated n (\i -> moore n (n - 1 - i)) else curve
  Star -> generated n (star n (whole n / (2 * pi)) 3 1)
  FixedStar -> generated n (star n 500 5 2)

type Vertex = (Double, Double, Double)

generated :: Int -> (Int -> Vertex) -> FlatPolyarc
generated n vertex =
  FlatPolyarc Closed (array (\(x, _, _) -> x)) (array (\(_, y, _) -> y)) (array (\(_, _, b) -> b))
  where
    array part = PrimArray.generatePrimArray n (part . vertex)

whole :: Int -> Double
whole = fromIntegral

-- | The radius of a ring whose teeth are 12 mm apart.
ring :: Int -> Double
ring teeth = max 40 (whole teeth * 12 / (2 * pi))

onCircle :: Double -> Double -> Vertex
onCircle r a = (r * cos a, r * sin a, 0)

-- | A rounded outer and a rounded inner corner for each lobe: arc, line, arc, line.
flange :: Int -> Int -> Vertex
flange n i =
  if even i
    then (px - ix * cut, py - iy * cut, tan (turn / 4))
    else (px + ox * cut, py + oy * cut, 0)
  where
    lobes = n `div` 4
    k = i `div` 2
    r = ring lobes
    h = if lobes >= 12 then 4 else 0.5 * r
    corner j =
      let (x, y, _) =
            onCircle (if even j then r + h else r - h) (whole j * pi / whole lobes)
       in (x, y)
    (px, py) = corner k
    (qx, qy) = corner (if k == 0 then 2 * lobes - 1 else k - 1)
    (sx, sy) = corner (if k == 2 * lobes - 1 then 0 else k + 1)
    (ix, iy) = unit (px - qx, py - qy)
    (ox, oy) = unit (sx - px, sy - py)
    unit (x, y) = let l = sqrt (x * x + y * y) in (x / l, y / l)
    turn = atan2 (ix * oy - iy * ox) (ix * ox + iy * oy)
    cut = 3 * tan (abs turn / 2)

comb :: Int -> Int -> Vertex
comb n i = case i `mod` 4 of
  0 -> onCircle (r + 4) base
  1 -> onCircle (r + 4) (base + a)
  2 -> onCircle (r - 4) (base + a)
  _ -> onCircle (r - 4) (base + 2 * a)
  where
    teeth = n `div` 4
    r = ring teeth
    base = whole (i `div` 4) * 2 * pi / whole teeth
    a = pi / whole teeth

chamfered :: Int -> Int -> Vertex
chamfered n i = case i `mod` 6 of
  0 -> onCircle (r + 4) base
  1 -> onCircle (r + 4) (base + a)
  2 -> onCircle (r - 4 + leg) (base + a)
  3 -> onCircle (r - 4) (base + a + along)
  4 -> onCircle (r - 4) (base + 2 * a - along)
  _ -> onCircle (r - 4 + leg) (base + 2 * a)
  where
    leg = 0.7
    teeth = n `div` 6
    r = ring teeth
    base = whole (i `div` 6) * 2 * pi / whole teeth
    a = pi / whole teeth
    along = leg / (r - 4)

-- | A vertex of a circle of @n@ vertices with radius @r@ and noise up to @amplitude@, both in mm.
star :: Int -> Double -> Double -> Int -> Int -> Vertex
star n r amplitude seed i = onCircle (r + amplitude * (2 * u - 1)) (2 * pi * whole i / whole n)
  where
    u = Noise.uniform (fromIntegral seed) (fromIntegral i)

-- | A vertex of Moore's curve. The curve has @n@ vertices, a power of four; they are 4 mm apart,
-- and each is displaced by up to 0.7 mm.
moore :: Int -> Int -> Vertex
moore n i = (4 * whole cx + noise (2 * i), 4 * whole cy + noise (2 * i + 1), 0)
  where
    side = until (\s -> 4 * s * s >= n) (* 2) 1
    (quarter, step) = i `divMod` (side * side)
    (x, y) = hilbert side step
    (cx, cy) = case quarter of
      0 -> (side - 1 - y, x)
      1 -> (side - 1 - y, x + side)
      2 -> (side + y, 2 * side - 1 - x)
      _ -> (side + y, side - 1 - x)
    noise place = 0.7 * (2 * Noise.uniform 3 (fromIntegral place) - 1)

-- | The cell at a step of Hilbert's curve through a grid. @side@ is a power of two; the curve leads
-- from (0, 0) to (side − 1, 0).
hilbert :: Int -> Int -> (Int, Int)
hilbert side = go 1 0 0
  where
    go s x y t
      | s >= side = (x, y)
      | otherwise =
        let right = (t `shiftR` 1) .&. 1
            up = (t + right) .&. 1
            (fx, fy) = if up == 0 && right == 1 then (s - 1 - x, s - 1 - y) else (x, y)
            (sx, sy) = if up == 0 then (fy, fx) else (fx, fy)
         in go (2 * s) (sx + s * right) (sy + s * up) (t `shiftR` 2)
