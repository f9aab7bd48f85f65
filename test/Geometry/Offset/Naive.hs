-- | Distance and winding number of outlines, segment after segment with angles and centres: what the offset kernel is judged
-- by, and shares nothing with.
module Geometry.Offset.Naive
  ( Piece (..),
    pieces,
    distance,
    beyond,
    winding,
    between,
  )
where

import Data.Primitive.PrimArray
import Geometry.Outline (Outline)
import Geometry.Outline qualified as Outline

-- | A segment: both ends, and the bulge.
data Piece = Piece {x0, y0, x1, y1, bulge :: Double}
  deriving stock (Eq, Show)

pieces :: Outline -> [Piece]
pieces o = [Piece (at (Outline.xs o) i) (at (Outline.ys o) i) (at (Outline.xs o) (next i)) (at (Outline.ys o) (next i)) (at (Outline.bulges o) i) | i <- [0 .. Outline.size o - 1]]
  where
    at = indexPrimArray
    next i = if i + 1 == sizeofPrimArray (Outline.xs o) then 0 else i + 1

-- | From a point to the nearest place of all.
distance :: [Piece] -> Double -> Double -> Double
distance ps x y = minimum (1 / 0 : map (\p -> toPiece p x y) ps)

-- | The least distance of a point from a piece beyond the one that is asked of it.
beyond :: [(Piece, Double)] -> Double -> Double -> Double
beyond ps x y = minimum (1 / 0 : map (\(p, d) -> toPiece p x y - d) ps)

toPiece :: Piece -> Double -> Double -> Double
toPiece p@(Piece ax ay bx by b) x y
  | l == 0 = toStart
  | abs b < 1e-5 = toFlat p x y
  | within = abs (r - abs radius)
  | otherwise = min toStart toEnd
  where
    (dx, dy) = (bx - ax, by - ay)
    l = sqrt (dx * dx + dy * dy)
    toStart = norm (x - ax) (y - ay)
    toEnd = norm (x - bx) (y - by)
    (cx, cy, radius) = circle p
    r = norm (x - cx) (y - cy)
    -- The way round from the start to the point is no longer than the sweep.
    sweep = 4 * atan b
    turn = atan2 ((ax - cx) * (y - cy) - (ay - cy) * (x - cx)) ((ax - cx) * (x - cx) + (ay - cy) * (y - cy))
    along = if b > 0 then (if turn < 0 then turn + 2 * pi else turn) else (if turn > 0 then 2 * pi - turn else -turn)
    within = along <= abs sweep

-- | Of an arc that is nearly its chord, as a parabola; of a line.
toFlat :: Piece -> Double -> Double -> Double
toFlat (Piece ax ay bx by b) x y = iterate newton start !! 4 `seq` norm (u - best) (v - height best)
  where
    l = norm (bx - ax) (by - ay)
    (ex, ey) = ((bx - ax) / l, (by - ay) / l)
    u = (x - ax) * ex + (y - ay) * ey
    v = (y - ay) * ex - (x - ax) * ey
    height t = -(2 * b * t * (l - t) / l)
    slope t = -(2 * b * (l - 2 * t) / l)
    clamp t = max 0 (min l t)
    start = clamp u
    newton t = clamp (u + (v - height t) * slope t)
    best = iterate newton start !! 4

norm :: Double -> Double -> Double
norm a b = sqrt (a * a + b * b)

-- | Centre and radius of an arc, positive when it is walked counter-clockwise.
circle :: Piece -> (Double, Double, Double)
circle (Piece ax ay bx by b) = (0.5 * (ax + bx) - k * (by - ay), 0.5 * (ay + by) + k * (bx - ax), norm (bx - ax) (by - ay) * (1 + b * b) / (4 * b))
  where
    k = (1 - b * b) / (4 * b)

-- | How often all go round a point, by the angles in which it sees the chords.
winding :: [Piece] -> Double -> Double -> Int
winding ps x y = round (sum (map angle ps) / (2 * pi))
  where
    angle p@(Piece ax ay bx by b) = seen (ax - x) (ay - y) (bx - x) (by - y) + (if b /= 0 && between p x y then 2 * pi * signum b else 0)
    seen ux uy vx vy = atan2 (ux * vy - uy * vx) (ux * vx + uy * vy)

-- | Whether a point lies between an arc and its chord.
between :: Piece -> Double -> Double -> Bool
between p@(Piece ax ay bx by b) x y
  | side * b >= 0 = False
  | abs b < 1e-5 = along > 0 && along < l && abs side / l < abs (2 * b * along * (l - along) / l)
  | otherwise = norm (x - cx) (y - cy) < abs radius
  where
    l = norm (bx - ax) (by - ay)
    side = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
    along = ((bx - ax) * (x - ax) + (by - ay) * (y - ay)) / l
    (cx, cy, radius) = circle p
