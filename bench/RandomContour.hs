-- | Small closed contours that do not cross themselves, determined by a seed and an index. A third
-- of them has integer vertices, a third has arcs, and a third has noise. Each has an offset in mm.
module RandomContour
  ( contour,
  )
where

import Data.Bits (shiftR)
import Data.List (nub, sortOn)
import Data.Maybe (fromMaybe)
import Data.Word (Word64)
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..))
import Noise qualified

type Vertex = (Double, Double, Double)

-- | A counter-clockwise contour, and its offset in mm, positive outwards.
contour :: Word64 -> Int -> (FlatPolyarc, Double)
contour seed index = (FlatPolyarc.fromVertices Closed vertices, distance)
  where
    stream = Noise.bits seed (fromIntegral index)
    u place = Noise.uniform stream (1000000 + place)
    count = 3 + floor (u 0 * u 1 * 40) :: Int
    grid =
      if u 4 < 0.5
        then [(wide * x, wide * y) | (x, y) <- cells stream (1 + floor (u 5 * 50))]
        else corners stream (3 + floor (u 5 * 10)) (3 + floor (u 6 * 9))
    wide = 1 + floor (u 8 * 4) :: Int
    (vertices, distance) = case index `mod` 3 of
      -- Integers and halves give the most coincidences.
      0 ->
        ( map whole grid,
          signOf
            (if u 2 < 0.8 then fromIntegral (1 + floor (u 3 * 6) :: Int) / 2 else 0.1 + 3 * u 3)
        )
      1 -> (curved stream (star stream count 10 0.6), signOf (0.05 + 3 * u 3 * u 3))
      _ -> (star stream (10 + 3 * count) 20 (0.7 * u 4), signOf (0.05 + 4 * u 3))
    signOf d = if u 7 < 0.6 then d else -d
    whole (x, y) = (fromIntegral x, fromIntegral y, 0)

-- | A star-shaped polygon round the origin. The radii vary by the ratio @part@.
star :: Word64 -> Int -> Double -> Double -> [Vertex]
star stream count radius part = [vertex (fromIntegral i) | i <- [0 .. count - 1]]
  where
    -- The origin stays inside: neighbours differ by less than 180°.
    jitter = if count == 3 then 0.4 else 0.8
    vertex :: Word64 -> Vertex
    vertex i =
      let a = 2 * pi * (fromIntegral i + jitter * Noise.uniform stream (2 * i)) / fromIntegral count
          r = radius * (1 + part * (2 * Noise.uniform stream (2 * i + 1) - 1))
       in (r * cos a, r * sin a, 0)

-- | Replaces some segments by arcs. Each arc stays in the wedge between the origin and its chord:
-- at both ends its tangent points into the wedge, and a circle meets a line at most twice. So
-- nothing crosses.
curved :: Word64 -> [Vertex] -> [Vertex]
curved stream vertices = zipWith3 bent [0 ..] vertices (drop 1 vertices <> take 1 vertices)
  where
    bent :: Word64 -> Vertex -> Vertex -> Vertex
    bent i (x0, y0, _) (x1, y1, _) =
      ( x0,
        y0,
        if Noise.uniform stream (5000 + i) < 0.3
          then 0
          else fitting (2 * Noise.uniform stream (6000 + i) - 1)
      )
      where
        fitting b
          | abs b < 0.01 = 0
          | within b = b
          | otherwise = fitting (b / 2)
        -- The tangent at each end is the chord rotated by half of the sweep; with a margin.
        within b =
          let (dx, dy) = (x1 - x0, y1 - y0)
              (c, s) = ((1 - b * b) / (1 + b * b), 2 * b / (1 + b * b))
              inside x y tx ty =
                x * ty - y * tx > 0.02 * sqrt ((x * x + y * y) * (tx * tx + ty * ty))
           in inside x0 y0 (dx * c + dy * s) (dy * c - dx * s)
                && inside x1 y1 (dx * c - dy * s) (dy * c + dx * s)

-- | A polygon with vertices on a grid of @side@ cells, in the order of their angles about their
-- centre. Repeats until it is simple.
corners :: Word64 -> Int -> Int -> [(Int, Int)]
corners stream count side = case filter isSimple (map try [0 .. 30]) of
  found : _ -> found
  [] -> [(0, 0), (side, 0), (side, side), (0, side)]
  where
    try :: Word64 -> [(Int, Int)]
    try k =
      around
        ( nub
            [ (pick (200 * k + 2 * i), pick (200 * k + 2 * i + 1))
              | i <- [0 .. fromIntegral count - 1]
            ]
        )
    pick place = fromIntegral (Noise.bits stream place `shiftR` 20) `mod` (side + 1)
    around ps =
      let n = fromIntegral (max 1 (length ps)) :: Double
          (mx, my) = (fromIntegral (sum (map fst ps)) / n, fromIntegral (sum (map snd ps)) / n)
       in sortOn (\(x, y) -> atan2 (fromIntegral y - my) (fromIntegral x - mx)) ps

-- | Is the polygon simple, with a positive area? The answer is exact.
isSimple :: [(Int, Int)] -> Bool
isSimple ps =
  length ps >= 3 && twiceArea > 0 && and [apart i j | i <- [0 .. n - 1], j <- [i + 1 .. n - 1]]
  where
    n = length ps
    edges = zip ps (drop 1 ps <> take 1 ps)
    twiceArea = sum [x0 * y1 - x1 * y0 | ((x0, y0), (x1, y1)) <- edges]
    turn (ax, ay) (bx, by) (cx, cy) = signum ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))
    on (a, b) p = turn a b p == 0 && between fst && between snd
      where
        between part = min (part a) (part b) <= part p && part p <= max (part a) (part b)
    apart i j
      | j == i + 1 = not (on e (snd f) || on f (fst e))
      | i == 0 && j == n - 1 = not (on f (snd e) || on e (fst f))
      | otherwise =
        not (crosses e f) && not (any (on e) [fst f, snd f]) && not (any (on f) [fst e, snd e])
      where
        e = edges !! i
        f = edges !! j
    crosses (a, b) (c, d) = turn a b c /= turn a b d && turn c d a /= turn c d b

-- | The boundary of @count@ unit squares, each beside an earlier one, without holes and without
-- shared corners.
cells :: Word64 -> Int -> [(Int, Int)]
cells stream count = grow 0 [(0, 0)]
  where
    grow :: Word64 -> [(Int, Int)] -> [(Int, Int)]
    grow step taken
      | length taken >= count || step > 200 = straightened (boundary taken)
      | otherwise =
        let (x, y) =
              taken !! (fromIntegral (Noise.bits stream (2 * step) `shiftR` 20) `mod` length taken)
            next = case Noise.bits stream (2 * step + 1) `shiftR` 62 of
              0 -> (x + 1, y)
              1 -> (x - 1, y)
              2 -> (x, y + 1)
              _ -> (x, y - 1)
         in grow
              (step + 1)
              (if next `elem` taken || not (isOneLoop (next : taken)) then taken else next : taken)
    -- The edges between taken and free squares, with the taken one on the left.
    edgesOf taken =
      [ e
        | (x, y) <- taken,
          (free, e) <-
            [ ((x, y - 1), ((x, y), (x + 1, y))),
              ((x + 1, y), ((x + 1, y), (x + 1, y + 1))),
              ((x, y + 1), ((x + 1, y + 1), (x, y + 1))),
              ((x - 1, y), ((x, y + 1), (x, y)))
            ],
          free `notElem` taken
      ]
    -- One loop contains every edge, and visits no corner twice.
    isOneLoop taken =
      let es =
            edgesOf taken
          starts = map fst es
       in length (nub starts) == length starts && length (boundary taken) == length es
    boundary taken = case edgesOf taken of
      es@((begin, _) : _) ->
        begin :
        takeWhile
          (/= begin)
          (drop 1 (take (length es + 1) (iterate (\p -> fromMaybe begin (lookup p es)) begin)))
      [] -> []
    -- Every other polygon keeps its vertices on straight lines.
    straightened ps
      | odd (Noise.bits stream 999) = ps
      | otherwise =
        [ p
          | (o, p, q) <- zip3 (drop (length ps - 1) ps <> ps) ps (drop 1 ps <> take 1 ps),
            not (straight o p q)
        ]
    straight (ax, ay) (bx, by) (cx, cy) = (bx - ax) * (cy - by) == (by - ay) * (cx - bx)
