{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Places in whole pulses: every position is rounded by itself, as an absolute position, so
-- rounding never adds up.
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

-- | In the plane, and the height.
type PathPosition = (Point, Mm)

-- | The nearest whole number of pulses on each axis; half a pulse goes up.
rounded :: Machine -> PathPosition -> Pulses3
rounded machine (p, Mm z) = Pulses3 (pulses X (Vec.x p)) (pulses Y (Vec.y p)) (pulses Z z)
  where
    pulses axis x = let Mm step = Machine.pulseOf machine axis in Pulses (floor (x / step + 0.5))

-- | The height at a fraction of a move.
heightAt :: Double -> Move -> Mm
heightAt t m
  | t >= 1 = snd (heights m)
  | otherwise = plus (fst (heights m)) (times t (minus (snd (heights m)) (fst (heights m))))

-- | Whether all moves keep one height, in whole pulses.
isLevel :: Machine -> NonEmpty Move -> Bool
isLevel machine ms =
  isFlat ms || all (\m -> isFirst (fst (heights m)) && isFirst (snd (heights m))) ms
  where
    isFirst z = level z == level (fst (heights (NonEmpty.head ms)))
    level z = component Z (rounded machine (Vec.point 0 0, z))

-- | Whether all moves keep one height exactly, as most do.
isFlat :: NonEmpty Move -> Bool
isFlat (m :| more) = case heights m of
  (Mm first, Mm final) -> first == final && go first more
  where
    go !z ms = case ms of
      [] -> True
      n : others -> case heights n of
        (Mm a, Mm b) -> a == z && b == z && go z others

-- | The stops of a straight move, given the position where it begins in pulses and its exact ends:
-- equal parts, each rounded by itself, as few as fit into the fields. Fields of positions hold a
-- move of any length.
split :: Machine -> Pulses3 -> (PathPosition, PathPosition) -> [Pulses3]
split machine begin ((a, za), (b, zb)) = case Machine.measure (Machine.layout machine) of
  Positions -> [finish]
  Increments -> first (filter fits (map parts [fewest .. fewest + spareParts]))
  where
    finish = rounded machine (b, zb)
    fewest = maximum (1 : [needed axis d | (axis, d) <- axes (finish - begin)])
    -- A machine without the axis is told so elsewhere.
    needed axis (Pulses d) =
      let Pulses c =
            Machine.capacity machine axis
       in if d == 0 || c == 0 then 1 else (abs d + c - 1) `div` c
    parts n =
      [ rounded machine (Vec.between t a b, plus za (times t (minus zb za)))
        | k <- [1 .. n - 1],
          let t = fromIntegral k / fromIntegral n
      ]
        <> [finish]
    fits stops =
      and
        [ abs d <= Machine.capacity machine axis
          | step <- zipWith (-) stops (begin : stops),
            (axis, d) <- axes step
        ]
    axes v = [(axis, d) | axis <- [X, Y, Z], let d = component axis v, d /= 0]
    first xs = case xs of
      x : _ -> x
      [] -> [finish]

-- | Rounding makes a part longer by a pulse at most: so many parts more are always enough on an
-- axis with two digits.
spareParts :: Int
spareParts = 1000

component :: Axis -> Pulses3 -> Pulses
component axis (Pulses3 x y z) = case axis of
  X -> x
  Y -> y
  Z -> z
