{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Positions in whole pulses, and the splitting of straight moves that are too long for one frame.
--
-- Every position is rounded by itself as an absolute position, so rounding errors never add up. An
-- increment is the difference of two rounded positions. Each axis has a resolution of its own, the
-- size of its pulse in mm.
module Frame.Rounding
  ( PathPosition,
    rounded,
    heightAt,
    isLevel,
    split,
    component,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), minus, plus, times)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (..), AxisMeasure (..), Machine)
import Machine.Machine qualified as Machine
import Toolpath.Toolpath (Move (..), heights)

-- | Position in mm: the point in the plane x, y, and the height z.
type PathPosition = (Point, Mm)

-- | Position in mm, rounded to the nearest whole pulse on each axis; half a pulse is rounded up.
rounded :: Machine -> PathPosition -> Pulses3
rounded machine (p, Mm z) = Pulses3 (pulses X (Vec.x p)) (pulses Y (Vec.y p)) (pulses Z z)
  where
    pulses axis x =
      let Mm step = Machine.resolutionOf machine axis in Pulses (floor (x / step + 0.5))

-- | Height in mm at the fraction @t@ of a move, by linear interpolation. For a @t@ of 1 or more it
-- is the height of the move's end.
heightAt :: Double -> Move -> Mm
heightAt t m
  | t >= 1 = snd (heights m)
  | otherwise = plus (fst (heights m)) (times t (minus (snd (heights m)) (fst (heights m))))

-- | True for moves that all stay at one height when heights are rounded to whole pulses. Only such
-- moves can become frames with arcs.
isLevel :: Machine -> NonEmpty Move -> Bool
isLevel machine ms =
  isFlat ms || all (\m -> isSameLevel (fst (heights m)) && isSameLevel (snd (heights m))) ms
  where
    isSameLevel z = level z == level (fst (heights (NonEmpty.head ms)))
    level z = component Z (rounded machine (Vec.point 0 0, z))

-- | True for moves that all stay at one height exactly. This holds for most moves, so 'isLevel'
-- tries this quick test first.
isFlat :: NonEmpty Move -> Bool
isFlat (m :| more) = case heights m of
  (Mm first, Mm final) -> first == final && go first more
  where
    go !z ms = case ms of
      [] -> True
      n : others -> case heights n of
        (Mm a, Mm b) -> a == z && b == z && go z others

-- | Ends, in pulses, of the frames for a straight move from @begin@, its rounded start. The pair
-- has the exact start and end of the move. The move is divided into the fewest equal parts whose
-- increments fit their fields, and each end is rounded by itself. A field for absolute positions
-- takes a move of any length, so there the move is not divided.
split :: Machine -> Pulses3 -> (PathPosition, PathPosition) -> [Pulses3]
split machine begin ((a, za), (b, zb)) = case Machine.measure (Machine.layout machine) of
  Positions -> [finish]
  Increments -> first (filter isFitting (map parts [fewest .. fewest + spareParts]))
  where
    finish = rounded machine (b, zb)
    fewest = maximum (1 : [partCount axis d | (axis, d) <- axes (finish - begin)])
    -- An axis without a field has the capacity 0; "Frame.FrameCheck" reports a move along it.
    partCount axis (Pulses d) =
      let Pulses c = Machine.capacity machine axis
       in if d == 0 || c == 0 then 1 else (abs d + c - 1) `div` c
    parts n =
      [ rounded machine (Vec.interpolate t a b, plus za (times t (minus zb za)))
        | k <- [1 .. n - 1],
          let t = fromIntegral k / fromIntegral n
      ]
        <> [finish]
    isFitting ends =
      and
        [ abs d <= Machine.capacity machine axis
          | step <- zipWith (-) ends (begin : ends),
            (axis, d) <- axes step
        ]
    axes v = [(axis, d) | axis <- [X, Y, Z], let d = component axis v, d /= 0]
    first xs = case xs of
      x : _ -> x
      [] -> [finish]

-- | Largest number of parts that 'split' tries beyond @fewest@. It adds one part at a time, until
-- all parts fit their fields. Rounding makes a part at most one pulse too long. If a field holds up
-- to c pulses, and @fewest@ is at most @1000·(c − 1)@, then 1000 additional parts always suffice.
spareParts :: Int
spareParts = 1000

-- | Component of a position along the given axis, in pulses.
component :: Axis -> Pulses3 -> Pulses
component axis (Pulses3 x y z) = case axis of
  X -> x
  Y -> y
  Z -> z
