-- | Random offset problems, some of them degenerate: unions of cells with touching corners and
-- spikes, polygons with integer vertices, arcs from tiny ones to almost full circles, polygons with
-- random vertices.
module Generate.Outline
  ( Case (..),
    Family (..),
    problem,
    onIntegers,
    withArcs,
    noisy,
    open,
    uneven,
    simple,
    cells,
    starred,
    convex,
    turned,
    loop,
  )
where

import Base.Quantity (Mm (..))
import Control.Monad (replicateM)
import Data.List (sort, tails)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Set (Set)
import Data.Set qualified as Set
import Geometry.Carrier (Side (..))
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..))
import Test.QuickCheck

-- | An offset problem: polyarcs and the distance of their offset.
data Case = Case
  { family :: Family,
    outlines :: [FlatPolyarc],
    side :: Side,
    -- | the distance of the offset in mm
    radius :: Double,
    -- | additional distances of the segments in turn, in mm; the list is repeated, and empty for
    -- none
    extras :: [Double],
    -- | the winding number of the region in which the cutter may move
    free :: Int,
    -- | true if the polyarcs are known to have no self-intersections
    sound :: Bool
  }
  deriving stock (Eq, Show)

-- | The kind of a problem: a union of cells, a polygon with integer vertices, polyarcs with arcs, a
-- polygon with random vertices.
data Family = Cells | Lattice | Arcs | Noise
  deriving stock (Eq, Show, Enum, Bounded)

-- | The vertex of a polyarc: x and y in mm, and the bulge of the segment after it.
type Vertex = (Double, Double, Double)

-- | The closed polyarc through vertices.
loop :: [Vertex] -> FlatPolyarc
loop = FlatPolyarc.fromVertices Closed

-- | A problem with closed polyarcs: with integer vertices, with arcs, or with random vertices.
problem :: Gen Case
problem = oneof [onIntegers, withArcs, noisy] >>= eitherSense >>= somewhere

-- | A problem with one open polyarc, which is a part of a closed one.
open :: Gen Case
open = do
  c <- problem
  case outlines c of
    o : _
      | vs <- FlatPolyarc.vertices o,
        length vs >= 3 -> do
        k <- choose (2, length vs)
        let o' = FlatPolyarc.fromVertices Open (take k vs)
        if FlatPolyarc.length o' > Mm 1e-9 then pure c {outlines = [o'], free = 0} else open
    _ -> open

-- | A problem with additional distances for some segments.
uneven :: Gen Case
uneven = do
  c <- oneof [problem, open]
  k <- choose (1, 4)
  es <- replicateM k (elements [0, 0, 0.5, 0.1, 1.3])
  pure c {extras = map (* radius c) es}

-- | A problem, sometimes with reversed polyarcs, so that the free region is on the other side.
eitherSense :: Case -> Gen Case
eitherSense c =
  elements
    [ c,
      c {outlines = map FlatPolyarc.reverse (outlines c), side = other (side c), free = -(free c)}
    ]
  where
    other s = case s of
      LeftOf -> RightOf
      RightOf -> LeftOf

-- | A problem, sometimes scaled, translated and rotated.
somewhere :: Case -> Gen Case
somewhere c = do
  size <- frequency [(5, pure 1), (1, elements [0.1, 10, 2, 25.4])]
  angle <- frequency [(4, pure 0), (1, choose (0, 2 * pi)), (1, elements [pi / 4, pi / 6])]
  (mx, my) <-
    frequency
      [ (4, pure (0, 0)),
        (1, (,) <$> choose (-100, 100) <*> choose (-100, 100)),
        (1, pure (1000, 300))
      ]
  pure
    c
      { outlines = map (turned size angle (mx, my)) (outlines c),
        radius = size * radius c,
        extras = map (size *) (extras c)
      }

-- | A polyarc, scaled by a factor, rotated by an angle in rad about the origin, and translated by a
-- vector in mm.
turned :: Double -> Double -> (Double, Double) -> FlatPolyarc -> FlatPolyarc
turned factor angle (mx, my) o =
  FlatPolyarc.fromVertices
    (FlatPolyarc.ends o)
    [ (mx + factor * (co * x - si * y), my + factor * (co * y + si * x), b)
      | (x, y, b) <- FlatPolyarc.vertices o
    ]
  where
    (co, si) = if angle == 0 then (1, 0) else (cos angle, sin angle)

-- * Integer vertices

onIntegers :: Gen Case
onIntegers = do
  radius <- elements [0.25, 0.5, 0.5, 1, 1, 1.5, 2, 3, 1 / 3, 0.7]
  inside <- arbitrary
  (family, loops) <-
    frequency
      [(4, (Cells,) <$> (cells >>= mapM decorated)), (1, (Lattice,) . pure <$> integerPolygon)]
  pure
    Case
      { family,
        outlines = map loop loops,
        side = if inside then LeftOf else RightOf,
        radius,
        extras = [],
        free = if inside then 1 else 0,
        sound = True
      }

-- | The boundary of a union of unit cells, counter-clockwise outside and clockwise around holes.
cells :: Gen [[(Int, Int)]]
cells = do
  w <- choose (1, 5)
  h <- choose (1, 4)
  share <- elements [4, 6, 8]
  chosen <-
    filter snd . zip [(x, y) | x <- [0 .. w - 1], y <- [0 .. h - 1]]
      <$> replicateM (w * h) ((< share) <$> choose (1, 10 :: Int))
  joined <- arbitrary
  case chosen of
    [] -> pure [[(0, 0), (1, 0), (1, 1), (0, 1)]]
    _ -> pure (traced joined (Set.fromList (map fst chosen)))

-- | The boundary of a union of cells, given by their lower left corners. If @joined@, the loop
-- continues on the other cell where only corners touch, otherwise it stays on its cell.
traced :: Bool -> Set (Int, Int) -> [[(Int, Int)]]
traced joined filled = loopsOf (Map.fromListWith (<>) [(a, [b]) | (a, b) <- Set.toList edges])
  where
    edges =
      Set.fromList
        [ (a, b)
          | cell <- Set.toList filled,
            (a, b, beside) <- around cell,
            Set.notMember beside filled
        ]
    around (x, y) =
      [ ((x, y), (x + 1, y), (x, y - 1)),
        ((x + 1, y), (x + 1, y + 1), (x + 1, y)),
        ((x + 1, y + 1), (x, y + 1), (x, y + 1)),
        ((x, y + 1), (x, y), (x - 1, y))
      ]
    loopsOf :: Map (Int, Int) [(Int, Int)] -> [[(Int, Int)]]
    loopsOf rest = case Map.toList rest of
      [] -> []
      (a, bs) : _ -> case bs of
        [] -> loopsOf (Map.delete a rest)
        b : _ -> let (vs, rest') = from a b (leave a b rest) in vs : loopsOf rest'
    leave a b = Map.update (\bs -> case filter (/= b) bs of [] -> Nothing; bs' -> Just bs') a
    from a b rest = go [a] a b rest
      where
        go seen p q left = case Map.findWithDefault [] q left of
          [] -> (reverse seen, left)
          [r] -> go (q : seen) q r (leave q r left)
          rs -> let r = best p q rs in go (q : seen) q r (leave q r left)
    -- The next vertex at a corner at which only two cells touch.
    best (px, py) (qx, qy) rs =
      case [ r
             | r@(rx, ry) <- rs,
               let t = (qx - px) * (ry - qy) - (qy - py) * (rx - qx),
               if joined then t < 0 else t > 0
           ] of
        r : _ -> r
        [] -> case rs of
          r : _ -> r
          [] -> (qx, qy)

-- | A polygon with random changes: rounded, chamfered or concave corners, spikes, repeated
-- vertices, vertices on straight lines.
decorated :: [(Int, Int)] -> Gen [Vertex]
decorated vs = do
  style <- frequency [(3, pure 0), (1, pure 1), (1, pure 2), (1, pure 3), (1, pure (4 :: Int))]
  cut <- elements [0.25, 0.5]
  spiky <- frequency [(4, pure False), (1, arbitrary)]
  merge <- arbitrary
  doubled <- frequency [(5, pure False), (1, pure True)]
  concat
    <$> mapM
      (corner style cut spiky merge doubled)
      (zip3 (drop (n - 1) points <> points) points (drop 1 points <> points))
  where
    points = [(fromIntegral x, fromIntegral y) | (x, y) <- vs] :: [(Double, Double)]
    n = length points
    corner style cut spiky merge doubled ((px, py), (x, y), (qx, qy)) = do
      this <- frequency [(3, pure style), (1, pure 0)]
      spike <- if spiky then frequency [(2, pure 0), (1, elements [0.5, -0.5, 0.25])] else pure 0
      twice <- if doubled then arbitrary else pure False
      let (ix, iy) = (x - px, y - py)
          (ox, oy) = (qx - x, qy - y)
          turn = ix * oy - iy * ox
          before = (x - cut * ix, y - cut * iy, b)
          after = (x + cut * ox, y + cut * oy, 0)
          b = case this of
            1 -> signum turn * tan (pi / 8)
            3 -> -(signum turn * tan (pi / 8))
            4 -> signum turn
            _ -> 0
          plain
            | turn == 0 && merge = []
            | turn == 0 || this == 0 = [(x, y, 0)]
            | this == 4 = [(x - 0.25 * ix, y - 0.25 * iy, 0), (x, y, 0)]
            | otherwise = [before, after]
          (mx, my) = (x + 0.5 * ox, y + 0.5 * oy)
          spikes =
            if spike == 0 || this == 4
              then []
              else [(mx, my, 0), (mx - spike * oy, my + spike * ox, 0), (mx, my, 0)]
      pure (plain <> [v | twice, v@(_, _, g) <- take 1 (reverse plain), g == 0] <> spikes)

-- | A polygon with integer vertices that does not touch itself.
integerPolygon :: Gen [Vertex]
integerPolygon = do
  k <- choose (3, 12)
  w <- choose (2, 8)
  points <- replicateM k ((,) <$> choose (0, w) <*> choose (0, w))
  let distinct = Set.toList (Set.fromList points)
  order <- shuffle distinct
  let polygon = untangled 60 [(fromIntegral x, fromIntegral y) | (x, y) <- order :: [(Int, Int)]]
  if length distinct >= 3 && isSimple polygon
    then pure [(x, y, 0) | (x, y) <- counterClockwise polygon]
    else integerPolygon

-- | Tells if a polygon is simple: only neighbouring edges touch, and none reverses the edge before.
isSimple :: [(Double, Double)] -> Bool
isSimple ps =
  and
    [ apart e f
      | (i, e) : more <- tails (zip [0 :: Int ..] edges),
        (j, f) <- more,
        j /= i + 1,
        not (i == 0 && j == n - 1)
    ]
    && and (zipWith fair edges (drop 1 edges <> take 1 edges))
  where
    n = length ps
    edges = zip ps (drop 1 ps <> take 1 ps)
    apart (a, b) (c, d) =
      signum (orient a b c) * signum (orient a b d) > 0
        || signum (orient c d a) * signum (orient c d b) > 0
        || collinearApart
      where
        collinearApart =
          orient a b c == 0
            && orient a b d == 0
            && ( max (along a) (along b) < min (along c) (along d)
                   || max (along c) (along d) < min (along a) (along b)
               )
        along (x, y) = x * (fst b - fst a) + y * (snd b - snd a)
    fair (a, b) (_, d) =
      orient a b d /= 0 || (fst b - fst a) * (fst d - fst b) + (snd b - snd a) * (snd d - snd b) > 0

-- | Twice the signed area of a triangle, positive if its points are in counter-clockwise order.
orient :: (Double, Double) -> (Double, Double) -> (Double, Double) -> Double
orient (ax, ay) (bx, by) (cx, cy) = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

counterClockwise :: [(Double, Double)] -> [(Double, Double)]
counterClockwise ps =
  if sum (zipWith (\(ax, ay) (bx, by) -> ax * by - ay * bx) ps (drop 1 ps <> take 1 ps)) > 0
    then ps
    else reverse ps

-- | Replaces two edges that intersect by two that do not, until no edges intersect, at most
-- @rounds@ times.
untangled :: Int -> [(Double, Double)] -> [(Double, Double)]
untangled rounds ps
  | rounds <= 0 = ps
  | otherwise =
    case [ (i, j)
           | (i, (a, b)) : more <- tails (zip [0 ..] edges),
             (j, (c, d)) <- more,
             signum (orient a b c) * signum (orient a b d) < 0,
             signum (orient c d a) * signum (orient c d b) < 0
         ] of
      [] -> ps
      (i, j) : _ ->
        let (front, rest) =
              splitAt (i + 1) ps
            (middle, end) = splitAt (j - i) rest
         in untangled (rounds - 1) (front <> reverse middle <> end)
  where
    edges = zip ps (drop 1 ps <> take 1 ps)

-- * With arcs

withArcs :: Gen Case
withArcs = do
  inside <- arbitrary
  (sound, vs, special) <- oneof [bent, rounded, round', keyhole, slot, blob]
  radius <-
    frequency
      [(2, choose (0.05, 4)), (1, elements (1 : 0.5 : special)), (1, elements (0.5 : special))]
  let outward = FlatPolyarc.area (loop vs) < 0
  pure
    Case
      { family = Arcs,
        outlines = [loop vs],
        side = if inside then LeftOf else RightOf,
        radius,
        extras = [],
        free = (if inside then 1 else 0) - (if outward then 1 else 0),
        sound
      }

-- | A star-shaped polygon with some edges replaced by arcs. It may have self-intersections.
--
-- This and the next functions give three results: the polyarc is known to be free of
-- self-intersections, its vertices, and radii for which its offset is degenerate.
bent :: Gen (Bool, [Vertex], [Double])
bent = do
  ps <- starred
  bs <- mapM (const bulge) ps
  pure (False, zipWith (\(x, y) b -> (x, y, b)) ps bs, [1])
  where
    bulge =
      frequency
        [ (3, pure 0),
          (4, choose (-0.5, 0.5)),
          (1, choose (-1.2, 1.2)),
          (1, elements [1e-3, -1e-4, 1e-6, -1e-8, 1e-10, 1, -1, 0.5]),
          (1, elements [3, -3])
        ]

-- | A polygon whose corners are rounded by tangent arcs.
rounded :: Gen (Bool, [Vertex], [Double])
rounded = do
  ps <- oneof [starred, map (\(x, y, _) -> (x, y)) <$> integerPolygon]
  share <- elements [0.3, 0.45, 0.5]
  let triples = zip3 (drop (length ps - 1) ps <> ps) ps (drop 1 ps <> ps)
      made = map (corner share) triples
  pure (False, concatMap fst made, map snd made)
  where
    corner share (p, v, q) =
      let back = share * min (dist p v) (dist v q)
          (ix, iy) = unit p v
          (ox, oy) = unit v q
          t = atan2 (ix * oy - iy * ox) (ix * ox + iy * oy)
          at (ux, uy) k = (fst v + k * ux, snd v + k * uy)
          (ax, ay) = at (ix, iy) (-back)
          (bx, by) = at (ox, oy) back
       in if abs t < 1e-9
            then ([(fst v, snd v, 0)], 1)
            else ([(ax, ay, tan (t / 4)), (bx, by, 0)], abs (back / tan (t / 2)))
    dist (ax, ay) (bx, by) = sqrt ((bx - ax) * (bx - ax) + (by - ay) * (by - ay))
    unit a@(ax, ay) b@(bx, by) = ((bx - ax) / dist a b, (by - ay) / dist a b)

-- | A circle of two to five arcs, or of one almost full arc and a short line.
round' :: Gen (Bool, [Vertex], [Double])
round' = do
  r <- elements [0.5, 1, 2, 3]
  oneof
    [ do
        k <- choose (2, 5)
        phase <- elements [0, 0.1]
        pure
          ( True,
            [ (r * cos t, r * sin t, tan (pi / (2 * fromIntegral k)))
              | i <- [0 .. k - 1 :: Int],
                let t = phase + 2 * pi * fromIntegral i / fromIntegral k
            ],
            [r, 2 * r]
          ),
      do
        gap <- elements [1e-3, 1e-6, 1e-8, 0.5]
        start <- choose (0, 2 * pi)
        pure
          ( True,
            [ (r * cos (start + gap / 2), r * sin (start + gap / 2), tan ((2 * pi - gap) / 4)),
              (r * cos (start - gap / 2), r * sin (start - gap / 2), 0)
            ],
            [r, 2 * r]
          )
    ]

-- | A circle with a channel to its outside that may be as narrow as the cutter.
keyhole :: Gen (Bool, [Vertex], [Double])
keyhole = do
  r <- elements [1, 2]
  half <- elements [0.25, 0.5, 0.7]
  long <- choose (3, 6)
  out <- arbitrary
  let s = asin (half / r)
      sweep = 2 * pi - 2 * s
      h = r * cos s
      vs =
        [ (h, half, tan (sweep / 4)),
          (h, -half, 0),
          (long, -half, if out then 1 else 0),
          (long, half, 0)
        ]
  pure (True, vs, [half, r, half * 2])

-- | A slot with round ends.
slot :: Gen (Bool, [Vertex], [Double])
slot = do
  r <- elements [0.5, 1]
  long <- frequency [(1, choose (0.01, 6)), (1, elements [1, 2, 0.5])]
  pure (True, [(0, -r, 0), (long, -r, 1), (long, r, 0), (0, r, 1)], [r, r * 1.5, 2 * r])

-- | A row of tangent half circles, concave or convex, closed by lines.
blob :: Gen (Bool, [Vertex], [Double])
blob = do
  k <- choose (1, 4)
  signs <- replicateM k (elements [1, -1])
  let wave =
        concat
          [ [(2 * fromIntegral i, 0, -s), (2 * fromIntegral i + 1, 0, s)]
            | (i, s) <- zip [0 :: Int ..] signs
          ]
      top = 2 * fromIntegral k
  height <- elements [1, 2, 1.5, 3]
  pure
    (height > 1, wave <> [(top, 0, 0), (top, height, 0), (0, height, 0)], [0.5, 0.25, height / 2])

-- * Noise

noisy :: Gen Case
noisy = do
  inside <- arbitrary
  ps <- frequency [(3, starred), (1, tangled)]
  radius <- oneof [choose (0.01, 1), choose (0.5, 6)]
  pure
    Case
      { family = Noise,
        outlines = [loop [(x, y, 0) | (x, y) <- ps]],
        side = if inside then LeftOf else RightOf,
        radius,
        extras = [],
        free = if inside then 1 else 0,
        sound = True
      }

-- | A star-shaped polygon: vertices in the order of their angles.
starred :: Gen [(Double, Double)]
starred = do
  n <- frequency [(3, choose (3, 12)), (1, choose (12, 40))]
  rough <- elements [0.1, 1, 4]
  jitters <- replicateM n (choose (0, 0.7))
  radii <- replicateM n (choose (-rough, rough))
  pure . counterClockwise $
    [ ((5 + r) * cos t, (5 + r) * sin t)
      | (i, j, r) <- zip3 [0 :: Int ..] jitters radii,
        let t = 2 * pi * (fromIntegral i + j) / fromIntegral n
    ]

-- | A simple polygon whose vertices are random points in a random order, made simple by
-- 'untangled'.
tangled :: Gen [(Double, Double)]
tangled = do
  n <- choose (3, 14)
  ps <- replicateM n ((,) <$> choose (0, 10) <*> choose (0, 10))
  let polygon = untangled 200 ps
  if isSimple polygon then pure (counterClockwise polygon) else tangled

-- | A convex polygon.
convex :: Gen [Vertex]
convex = do
  n <- choose (3, 12)
  angles <- sort <$> replicateM n (choose (0, 2 * pi))
  r <- choose (1, 10)
  pure [(r * cos t, r * sin t, 0) | t <- angles]

-- | A polygon without self-intersections whose vertices are random.
simple :: Gen FlatPolyarc
simple = do
  ps <- oneof [starred, tangled]
  pure (loop [(x, y, 0) | (x, y) <- ps])
