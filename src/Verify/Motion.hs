{-# OPTIONS_GHC -O2 #-}

-- | What the cutter's centre does in a stroke, or in one of several parts of it, as a few bare
-- numbers: there are as many as frames on the tape. All else is made from them where it is looked
-- at.
module Verify.Motion
  ( CutterMotion (..),
    tracesOf,
    heights,
    ways,
    courses,
    bridges,
    box,
    isSame,
    isUpright,
    places,
    pieces,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Control.Compensation (Moved)
import Control.Compensation qualified as Compensation
import Control.Motion qualified as Control
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment (..))
import Machine.Machine (Machine)

-- | In the plane a trace is without length when it goes straight up or down.
data CutterMotion = CutterMotion
  { -- | of the stroke's frame
    number :: Int,
    -- | which part of the stroke, from 0
    part :: Int,
    line :: Segment,
    -- | the heights at its beginning and at its end
    fromHeight :: Mm,
    toHeight :: Mm
  }

-- | What the cutter's centre does in a stroke on a machine, before what it does in those behind it.
-- If there are several parts, it rises in the last one.
tracesOf :: Machine -> Moved -> [CutterMotion] -> [CutterMotion]
tracesOf machine m behind = go 0 (Compensation.legs m)
  where
    s = Compensation.stroke m
    (from, to) = Control.height machine s
    go n (leg :| legs) = case legs of
      [] -> let t = trace n leg to in t `seq` (t : behind)
      next : more -> let t = trace n leg from in t `seq` (t : go (n + 1) (next :| more))
    trace n leg end =
      CutterMotion
        { number = Control.number s,
          part = n,
          line = leg,
          fromHeight = from,
          toHeight = end
        }

-- | At its beginning and at its end.
heights :: CutterMotion -> (Mm, Mm)
heights t = (fromHeight t, toHeight t)

-- | The ways between which the control goes there.
ways :: CutterMotion -> NonEmpty Segment
ways = Control.between . line

-- | The same as bare numbers …
courses :: CutterMotion -> [Segment]
courses t
  | FastDistance.isLine (line t) = [line t]
  | otherwise = NonEmpty.toList (ways t)

-- | … and the ways across from one to another.
bridges :: CutterMotion -> [Segment]
bridges t
  | FastDistance.isLine (line t) = []
  | otherwise = Control.across (ways t)

-- | All of the ways lie in it.
box :: CutterMotion -> BoundingBox
box t = case FastDistance.uneven (line t) of
  0 -> FastDistance.box (line t)
  -- The ends of a way lie beside those of the stroke, and its bow is higher by no more.
  off -> BoundingBox.inflate (Mm (2 * off)) (FastDistance.box (line t))

-- | Whether two are the same part of the same stroke.
isSame :: CutterMotion -> CutterMotion -> Bool
isSame a b = number a == number b && part a == part b

-- | Whether a stroke goes straight up or down. A full circle ends where it begins, too.
isUpright :: CutterMotion -> Bool
isUpright t = case line t of
  Straight a b -> a == b
  Arc {} -> False

-- | The places of a stroke at which it is looked at, as shares of its length, the last one its end.
places :: CutterMotion -> [Double]
places t = let n = pieces t in [fromIntegral k / fromIntegral n | k <- [1 .. n]]

-- | How many these are: two of a straight one, and so many of an arc that a contour that is
-- followed does not turn by more than an eighth of a half turn from one to the next, nor is a
-- quarter of a closed one passed.
pieces :: CutterMotion -> Int
pieces t = case line t of
  Straight _ _ -> 2
  Arc {sweep = Rad s} -> max 4 (ceiling (abs s / (pi / 8)))
