{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 -fno-full-laziness #-}

-- | Boxes around segments in the order of the walk: eight consecutive ones in a box, eight boxes in a larger one, and so
-- on. A walk's own order is a good order in the plane, so nothing is sorted.
module Geometry.Offset.Boxes
  ( Boxes,
    boxes,
    leaf,
    whole,
    pairs,
    around,
  )
where

import Control.Monad (when)
import Control.Monad.ST (ST, runST)
import Data.Primitive.PrimArray
import Geometry.Offset.Chain (Chain)
import Geometry.Offset.Chain qualified as Chain

-- | Four numbers a box: least x, least y, largest x, largest y; level after level, and where each level begins and how many
-- boxes it has.
data Boxes = Boxes (PrimArray Double) (PrimArray Int) (PrimArray Int) Int

-- | So many boxes are in the next larger one.
fan :: Int
fan = 8

-- | The boxes of a chain, each wider by a margin in mm on every side. The copy of a first vertex has none.
boxes :: Double -> Chain -> Boxes
boxes margin c = runST $ do
  let n = sizeofPrimArray (Chain.xs c)
  cs <- newPrimArray (4 * (n + n `quot` 7 + 16))
  bs <- newPrimArray 16
  ns <- newPrimArray 16
  let put !k !a !b !a' !b' = do
        writePrimArray cs (4 * k) a
        writePrimArray cs (4 * k + 1) b
        writePrimArray cs (4 * k + 2) a'
        writePrimArray cs (4 * k + 3) b'
      leaves !i
        | i >= n = pure ()
        | Chain.marked Chain.copied (indexPrimArray (Chain.marks c) i) = put i far far (-far) (-far) >> leaves (i + 1)
        | otherwise = do
          let x0 = indexPrimArray (Chain.xs c) i
              y0 = indexPrimArray (Chain.ys c) i
              x1 = indexPrimArray (Chain.xs c) (i + 1)
              y1 = indexPrimArray (Chain.ys c) (i + 1)
              b = indexPrimArray (Chain.bulges c) i
              lx = least x0 x1
              ly = least y0 y1
              hx = most x0 x1
              hy = most y0 y1
          if b == 0
            then put i (lx - margin) (ly - margin) (hx + margin) (hy + margin)
            else do
              -- An arc of half a turn or less lies in the parallelogram over its chord that its highest point touches.
              let ox = 0.5 * b * (y1 - y0)
                  oy = -0.5 * b * (x1 - x0)
              put i (least lx (lx + ox) - margin) (least ly (ly + oy) - margin) (most hx (hx + ox) + margin) (most hy (hy + oy) + margin)
          leaves (i + 1)
      up !l !o !count
        | count <= 1 = pure l
        | otherwise = do
          let count' = (count + fan - 1) `quot` fan
              o' = o + count
              node !i
                | i >= count' = pure ()
                | otherwise = do
                  let e = if count < (i + 1) * fan then count else (i + 1) * fan
                      gather !k !a !b !a' !b'
                        | k >= e = put (o' + i) a b a' b'
                        | otherwise = do
                          p <- readPrimArray cs (4 * (o + k))
                          q <- readPrimArray cs (4 * (o + k) + 1)
                          p' <- readPrimArray cs (4 * (o + k) + 2)
                          q' <- readPrimArray cs (4 * (o + k) + 3)
                          gather (k + 1) (least a p) (least b q) (most a' p') (most b' q')
                  gather (i * fan) far far (-far) (-far)
                  node (i + 1)
          node 0
          writePrimArray bs (l + 1) o'
          writePrimArray ns (l + 1) count'
          up (l + 1) o' count'
  writePrimArray bs 0 0
  writePrimArray ns 0 n
  leaves 0
  highest <- up (0 :: Int) 0 n
  Boxes <$> unsafeFreezePrimArray cs <*> unsafeFreezePrimArray bs <*> unsafeFreezePrimArray ns <*> pure highest

far :: Double
far = 1e300

least, most :: Double -> Double -> Double
least a b = if a < b then a else b
most a b = if a > b then a else b
{-# INLINE least #-}
{-# INLINE most #-}

-- | The box of a segment: least x, least y, largest x, largest y.
leaf :: Boxes -> Int -> (Double -> Double -> Double -> Double -> r) -> r
leaf (Boxes cs _ _ _) i k = k (indexPrimArray cs (4 * i)) (indexPrimArray cs (4 * i + 1)) (indexPrimArray cs (4 * i + 2)) (indexPrimArray cs (4 * i + 3))
{-# INLINE leaf #-}

-- | The box of everything.
whole :: Boxes -> (Double -> Double -> Double -> Double -> r) -> r
whole bs@(Boxes _ begins _ highest) = leaf bs (indexPrimArray begins highest)

-- | Visit every two segments whose boxes overlap, the earlier one first, as long as the test allows.
pairs :: Boxes -> ST s Bool -> (Int -> Int -> ST s ()) -> ST s ()
pairs (Boxes cs bs ns highest) goesOn visit = within highest 0
  where
    within !l !a
      | l == 0 = pure ()
      | otherwise = do
        let !o = indexPrimArray bs (l - 1)
            !e = let c = indexPrimArray ns (l - 1) in if c < (a + 1) * fan then c else (a + 1) * fan
            outer !i
              | i >= e = pure ()
              | otherwise = within (l - 1) i >> leaf' (o + i) (inner i (i + 1)) >> outer (i + 1)
            inner !i !j !lx !ly !hx !hy
              | j >= e = pure ()
              | otherwise = when (meets (o + j) lx ly hx hy) (between (l - 1) i j) >> inner i (j + 1) lx ly hx hy
        more <- if l == 1 then pure True else goesOn
        when more (outer (a * fan))
    between !l !a !b
      | l == 0 = visit a b
      | otherwise = do
        let !o' = indexPrimArray bs l
            !o = indexPrimArray bs (l - 1)
            !c = indexPrimArray ns (l - 1)
            !ea = if c < (a + 1) * fan then c else (a + 1) * fan
            !eb = if c < (b + 1) * fan then c else (b + 1) * fan
            outer !i !lx !ly !hx !hy
              | i >= ea = pure ()
              | otherwise = when (meets (o + i) lx ly hx hy) (leaf' (o + i) (inner i (b * fan))) >> outer (i + 1) lx ly hx hy
            inner !i !j !lx !ly !hx !hy
              | j >= eb = pure ()
              | otherwise = when (meets (o + j) lx ly hx hy) (between (l - 1) i j) >> inner i (j + 1) lx ly hx hy
        leaf' (o' + b) (outer (a * fan))
    leaf' !i k =
      let !lx = at i 0
          !ly = at i 1
          !hx = at i 2
          !hy = at i 3
       in k lx ly hx hy
    {-# INLINE leaf' #-}
    meets !i !lx !ly !hx !hy = at i 0 <= hx && lx <= at i 2 && at i 1 <= hy && ly <= at i 3
    {-# INLINE meets #-}
    at i k = indexPrimArray cs (4 * i + k)
    {-# INLINE at #-}
{-# INLINE pairs #-}

-- | Gather over the segments whose boxes overlap a box, in order.
around :: Boxes -> Double -> Double -> Double -> Double -> a -> (a -> Int -> a) -> a
around (Boxes cs bs ns highest) lx ly hx hy start f = go highest 0 start
  where
    go !l !a acc
      | not (hits (indexPrimArray bs l + a)) = acc
      | l == 0 = f acc a
      | otherwise = children (l - 1) (a * fan) (let c = indexPrimArray ns (l - 1) in if c < (a + 1) * fan then c else (a + 1) * fan) acc
    children !l !k !e acc
      | k >= e = acc
      | otherwise = let acc' = go l k acc in acc' `seq` children l (k + 1) e acc'
    hits i = at 0 <= hx && lx <= at 2 && at 1 <= hy && ly <= at 3
      where
        at k = indexPrimArray cs (4 * i + k)
{-# INLINE around #-}
