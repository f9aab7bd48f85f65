-- | Distances and winding numbers of polyarcs, computed from all segments with angles and centres.
-- The laws compare the offset kernel with them; they share no code with it.
module Offset.Naive
  ( Piece (..),
    pieces,
    distance,
    blocked,
    winding,
    between,
  )
where

import Data.Primitive.PrimArray
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc

-- | A segment: both ends, and the bulge.
data Piece = Piece {x0, y0, x1, y1, bulge :: Double}
  deriving stock (Eq, Show)

-- | The segments of a polyarc.
pieces :: FlatPolyarc -> [Piece]
pieces o =
  [ Piece
      (at (FlatPolyarc.xs o) i)
      (at (FlatPolyarc.ys o) i)
      (at (FlatPolyarc.xs o) (next i))
      (at (FlatPolyarc.ys o) (next i))
      (at (FlatPolyarc.bulges o) i)
    | i <- [0 .. FlatPolyarc.size o - 1]
  ]
  where
    at = indexPrimArray
    next i = if i + 1 == sizeofPrimArray (FlatPolyarc.xs o) then 0 else i + 1

-- | The distance of a point from the nearest of some segments.
distance :: [Piece] -> Double -> Double -> Double
distance ps x y = minimum (1 / 0 : map (\p -> toPiece p x y) ps)

-- | True when a point is too near to a closed polyarc, or to an open one traversed there and back,
-- whose segments have different distances. The arguments are the side of the cutter (1 left,
-- −1 right), the least distance, and the segments with their distances. On the cutter's side,
-- between a segment's ends, its own distance holds. About an outer corner the larger one of both
-- distances holds. The least distance holds everywhere.
blocked :: Double -> Double -> [(Piece, Double)] -> Double -> Double -> Bool
blocked side least ps x y = any near ps || or (zipWith corner ps (drop 1 ps <> take 1 ps))
  where
    near (p, d) =
      let far = toPiece p x y in far < least || (far < d && beside p && side * leftward p > 0)
    beside p@(Piece ax ay bx by b)
      | b == 0 =
        let t =
              (x - ax) * (bx - ax) + (y - ay) * (by - ay)
         in t > 0 && t < (bx - ax) * (bx - ax) + (by - ay) * (by - ay)
      | otherwise = onSweep p x y
    leftward p@(Piece ax ay bx by b)
      | b == 0 = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
      | otherwise = let (cx, cy, r) = circle p in b * (abs r - norm (x - cx) (y - cy))
    corner (p, d) (q, e) =
      let (ux, uy) = direction p 1
          (vx, vy) = direction q (-1)
          turn = ux * vy - uy * vx
          (wx, wy) = (x - x0 q, y - y0 q)
          -- A cusp between two arcs is an outer corner on the side away from which they curve. A
          -- cusp between arcs of equal and opposite curvature is an outer corner on either side.
          bend = side * (curvature p + curvature q)
          outer = side * turn < -1e-9 || (abs turn <= 1e-9 && ux * vx + uy * vy < 0 && bend >= 0)
       in outer && ux * wx + uy * wy > 0 && vx * wx + vy * wy < 0 && norm wx wy < max d e
    curvature p@(Piece _ _ _ _ b) = if b == 0 then 0 else let (_, _, r) = circle p in 1 / r
    direction (Piece ax ay bx by b) end =
      let h =
            end * 2 * atan b
          l = norm (bx - ax) (by - ay)
       in (((bx - ax) * cos h - (by - ay) * sin h) / l, ((by - ay) * cos h + (bx - ax) * sin h) / l)

-- | The distance of a point from a segment.
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
    within = onSweep p x y

-- | True when the direction from an arc's centre to a point is within the arc's sweep.
onSweep :: Piece -> Double -> Double -> Bool
onSweep p@(Piece ax ay _ _ b) x y
  | b > 0 = (if turn < 0 then turn + 2 * pi else turn) <= sweep
  | turn > 0 = 2 * pi - turn <= sweep
  | otherwise = -turn <= sweep
  where
    (cx, cy, _) = circle p
    sweep = 4 * atan (abs b)
    turn =
      atan2
        ((ax - cx) * (y - cy) - (ay - cy) * (x - cx))
        ((ax - cx) * (x - cx) + (ay - cy) * (y - cy))

-- | The distance of a point from a line, or from a nearly straight arc, which is treated as a
-- parabola.
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

-- | Centre and radius of an arc. The radius of a clockwise arc is negative.
circle :: Piece -> (Double, Double, Double)
circle (Piece ax ay bx by b) =
  ( 0.5 * (ax + bx) - k * (by - ay),
    0.5 * (ay + by) + k * (bx - ax),
    norm (bx - ax) (by - ay) * (1 + b * b) / (4 * b)
  )
  where
    k = (1 - b * b) / (4 * b)

-- | The winding number of segments around a point: the sum of the angles in which the chords appear
-- from it, corrected for the arcs.
winding :: [Piece] -> Double -> Double -> Int
winding ps x y = round (sum (map angle ps) / (2 * pi))
  where
    angle p@(Piece ax ay bx by b) =
      seen (ax - x) (ay - y) (bx - x) (by - y)
        + (if b /= 0 && between p x y then 2 * pi * signum b else 0)
    seen ux uy vx vy = atan2 (ux * vy - uy * vx) (ux * vx + uy * vy)

-- | True when a point lies between an arc and its chord.
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
