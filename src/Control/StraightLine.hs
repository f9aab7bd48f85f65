-- | A virtual controller without arcs: every frame is one straight stroke.
module Control.StraightLine
  ( Stroke (..),
    run,
    segment,
  )
where

import Base.Quantity (Pulses)
import Data.List (mapAccumL)
import Frame.Frame (Frame (..))
import Frame.Frame qualified as Frame
import Geometry.Segment (Segment (..))
import Linear.V3 (V3)
import Machine.Machine (FeedCode, Machine)

-- | What one frame does: from where to where, in pulses.
data Stroke = Stroke {number :: Int, from :: V3 Pulses, to :: V3 Pulses, code :: FeedCode}
  deriving stock (Eq, Show)

-- | Run frames from a position. A frame that only commands makes no stroke.
run :: V3 Pulses -> [Frame] -> [Stroke]
run begin frames = [s | s <- snd (mapAccumL step begin (zip [1 ..] frames)), from s /= to s]
  where
    step at (n, f) = let next = at + increment f in (next, Stroke {number = n, from = at, to = next, code = speed f})

-- | The stroke in the plane, in mm.
segment :: Machine -> Stroke -> Segment
segment machine s = Straight (Frame.position machine (from s)) (Frame.position machine (to s))
