{-# OPTIONS_GHC -O2 #-}

-- | Whether the kernel's answer is true, looked at without what led to it: a place on every loop is as far from the source
-- as was asked.
module Geometry.Offset.Certificate
  ( clear,
    covers,
  )
where

import Data.Primitive.PrimArray
import Geometry.Offset.Boxes (Boxes)
import Geometry.Offset.Boxes qualified as Boxes
import Geometry.Offset.Chain (Chain)
import Geometry.Offset.Chain qualified as Chain
import Geometry.Offset.Loops (Loops)
import Geometry.Offset.Loops qualified as Loops

-- | Whether the middle of a loop's first segment is no nearer to any segment of the source than that one's distance less
-- an error (both in mm). The largest distance limits the search.
clear :: Double -> Double -> (Int -> Double) -> Chain -> Boxes -> Loops -> Int -> Bool
clear slack largest distance source bs l k = uncurry (farFrom slack largest distance source bs) (witness l k)

-- | Whether a cutter that stands where that place is reaches every segment of the source.
covers :: Double -> (Int -> Double) -> Chain -> Loops -> Int -> Bool
covers slack distance source l k = and [fromPoint source i x y <= abs (reach i) + slack | i <- [0 .. sizeofPrimArray (Chain.xs source) - 1], not (Chain.marked Chain.copied (indexPrimArray (Chain.marks source) i))]
  where
    (x, y) = witness l k
    reach i = distance (fromIntegral (indexPrimArray (Chain.sources source) i))

-- | The middle of a loop's first segment.
witness :: Loops -> Int -> (Double, Double)
witness l k = (x0 + 0.5 * (dx + b * dy), y0 + 0.5 * (dy - b * dx))
  where
    i = indexPrimArray (Loops.starts l) k
    j = if i + 1 == indexPrimArray (Loops.starts l) (k + 1) then i else i + 1
    (x0, y0) = (indexPrimArray (Loops.xs l) i, indexPrimArray (Loops.ys l) i)
    (dx, dy) = (indexPrimArray (Loops.xs l) j - x0, indexPrimArray (Loops.ys l) j - y0)
    b = indexPrimArray (Loops.bulges l) i

-- | Whether a point is no nearer to any segment than that one's distance less an error.
farFrom :: Double -> Double -> (Int -> Double) -> Chain -> Boxes -> Double -> Double -> Bool
farFrom slack largest distance source bs x y = Boxes.around bs (x - largest) (y - largest) (x + largest) (y + largest) True $ \good i ->
  good && fromPoint source i x y >= abs (distance (fromIntegral (indexPrimArray (Chain.sources source) i))) - slack

-- | The distance of a point from a segment.
fromPoint :: Chain -> Int -> Double -> Double -> Double
fromPoint c i x y
  | b == 0 = Chain.chord c i $ \ux uy ->
    let t = max 0 (min 1 ((ux * ax + uy * ay) / (ux * ux + uy * uy)))
     in hypotenuse (ax - t * ux) (ay - t * uy)
  | inSector = abs (Chain.power c i x y) / (0.5 * hypotenuse gx gy + 0.5 * Chain.diameter c i)
  | otherwise = min (hypotenuse ax ay) (hypotenuse bx by)
  where
    b = indexPrimArray (Chain.bulges c) i
    x0 = indexPrimArray (Chain.xs c) i
    y0 = indexPrimArray (Chain.ys c) i
    x1 = indexPrimArray (Chain.xs c) (i + 1)
    y1 = indexPrimArray (Chain.ys c) (i + 1)
    (ax, ay) = (x - x0, y - y0)
    (bx, by) = (x - x1, y - y1)
    (gx, gy) = Chain.gradient c i x y (,)
    (px, py) = Chain.gradient c i x0 y0 (,)
    (qx, qy) = Chain.gradient c i x1 y1 (,)
    inSector = (px * gy - py * gx) * b >= 0 && (gx * qy - gy * qx) * b >= 0
    hypotenuse u v = sqrt (u * u + v * v)
