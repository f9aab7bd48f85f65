-- | Small closed contours that do not cross themselves, by a seed and a number: a third on a grid
-- of whole numbers, a third with arcs, a third noisy. Each comes with an offset in mm.
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

-- | A contour, counter-clockwise, and how far to offset it, outwards when positive.
contour :: Word64 -> Int -> (FlatPolyarc, Double)
contour seed index = (FlatPolyarc.outline Closed vertices, distance)
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
      -- Halves and whole numbers meet the most coincidences.
      0 ->
        ( map whole grid,
          signOf
            (if u 2 < 0.8 then fromIntegral (1 + floor (u 3 * 6) :: Int) / 2 else 0.1 + 3 * u 3)
        )
      1 -> (curved stream (star stream count 10 0.6), signOf (0.05 + 3 * u 3 * u 3))
      _ -> (star stream (10 + 3 * count) 20 (0.7 * u 4), signOf (0.05 + 4 * u 3))
    signOf d = if u 7 < 0.6 then d else -d
    whole (x, y) = (fromIntegral x, fromIntegral y, 0)

-- | Vertices seen one after the other from the origin, at radii that vary by a part.
star :: Word64 -> Int -> Double -> Double -> [Vertex]
star stream count radius part = [vertex (fromIntegral i) | i <- [0 .. count - 1]]
  where
    -- The origin stays inside: no two neighbours are half a turn apart.
    jitter = if count == 3 then 0.4 else 0.8
    vertex :: Word64 -> Vertex
    vertex i =
      let a = 2 * pi * (fromIntegral i + jitter * Noise.uniform stream (2 * i)) / fromIntegral count
          r = radius * (1 + part * (2 * Noise.uniform stream (2 * i + 1) - 1))
       in (r * cos a, r * sin a, 0)

-- | Arcs instead of some segments. Each keeps to the wedge in which its chord is seen from the
-- origin: at both ends its tangent leads into the wedge, and a circle meets a line twice only. So
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
        -- Tangents at both ends, by the chord turned by half of the sweep; with a margin.
        within b =
          let (dx, dy) = (x1 - x0, y1 - y0)
              (c, s) = ((1 - b * b) / (1 + b * b), 2 * b / (1 + b * b))
              inside x y tx ty =
                x * ty - y * tx > 0.02 * sqrt ((x * x + y * y) * (tx * tx + ty * ty))
           in inside x0 y0 (dx * c + dy * s) (dy * c - dx * s)
                && inside x1 y1 (dx * c - dy * s) (dy * c + dx * s)

-- | Corners on a grid of so many lines: as they are seen around their middle, tried until nothing
-- touches.
corners :: Word64 -> Int -> Int -> [(Int, Int)]
corners stream count side = case filter sound (map try [0 .. 30]) of
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

-- | Whether corners make a contour that goes around something and touches itself nowhere; exact.
sound :: [(Int, Int)] -> Bool
sound ps =
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

-- | The outline of so many squares that grew from one, each beside one before, without holes and
-- without corners that two parts share.
cells :: Word64 -> Int -> [(Int, Int)]
cells stream count = grow 0 [(0, 0)]
  where
    grow :: Word64 -> [(Int, Int)] -> [(Int, Int)]
    grow step taken
      | length taken >= count || step > 200 = straightened (walked taken)
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
              (if next `elem` taken || not (simple (next : taken)) then taken else next : taken)
    -- The edges between taken and free, with the taken one on the left.
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
    -- One walk takes in every edge, and no corner is passed twice.
    simple taken =
      let es =
            edgesOf taken
          starts = map fst es
       in length (nub starts) == length starts && length (walked taken) == length es
    walked taken = case edgesOf taken of
      es@((begin, _) : _) ->
        begin :
        takeWhile
          (/= begin)
          (drop 1 (take (length es + 1) (iterate (\p -> fromMaybe begin (lookup p es)) begin)))
      [] -> []
    -- Every other outline keeps the corners that turn nothing: there segments go on straight.
    straightened ps
      | odd (Noise.bits stream 999) = ps
      | otherwise =
        [ p
          | (o, p, q) <- zip3 (drop (length ps - 1) ps <> ps) ps (drop 1 ps <> take 1 ps),
            not (straight o p q)
        ]
    straight (ax, ay) (bx, by) (cx, cy) = (bx - ax) * (cy - by) == (by - ay) * (cx - bx)
