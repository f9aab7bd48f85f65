-- | What of the path becomes frames, before anything is rounded.
module Frame.Task
  ( Task (..),
    Drive (..),
    tasksOf,
    wayOf,
    cutBefore,
  )
where

import Base.Quantity (Feed, Mm (..), minus)
import Base.Region (Located (..), Region)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Frame.Chord (Allowed (..))
import Frame.Chord qualified as Chord
import Frame.Frame (Role (..))
import Frame.Order (Told)
import Frame.Order qualified as Order
import Frame.Pulses qualified as Pulses
import Geometry.Segment qualified as Segment
import Machine.Machine (Machine)
import Part.Part qualified as Part
import Path.Path (Move (..), Path, heights, pace)
import Path.Path qualified as Path

-- | Moves along one line, arc or curve with their role and what is allowed to their chords, or a command.
data Task
  = Run
      { role :: Role,
        allowed :: Allowed,
        -- | the radius of the cutter
        tool :: Mm,
        drive :: Drive,
        run :: NonEmpty Move
      }
  | -- | a command, or what tells the control to keep the cutter beside the contour or no longer: where it is asked
    Order Region Told

-- | How fast.
data Drive
  = -- | as the program asks
    Asked
  | -- | at the lowest code
    Lowest
  | -- | slowing down to a feed, by a sign of its own
    Slowing Feed
  deriving stock (Eq, Show)

-- | The tasks of a path in order.
tasksOf :: Machine -> Path -> [Task]
tasksOf machine path = concat (zipWith block (Path.passNumbers (Path.blocks path)) (Path.blocks path))
  where
    straight r radius = map (Run r (Sagitta (Mm 0)) radius Asked . (:| []))
    block n b = case b of
      Path.Travelling radius ms -> straight Travelling radius ms
      Path.Holing (Located _ d) ms -> straight Drilling (Part.drillRadius d) ms
      Path.Commanding c -> [Order (region c) (Order.told machine c)]
      Path.Cutting {Path.job = Located region' job, Path.approach = before, Path.cut = along, Path.retract = after, Path.sent} ->
        fromMaybe (concat [led (Approaching n) job before, led (Cutting n) job (NonEmpty.toList along), led (Retracting n) job after]) (keeping n (fromMaybe region' (Part.byControl job)) job =<< sent)
      Path.Clearing {Path.pocket = Located _ p, Path.approach = before, Path.cleared = along, Path.retract = after} ->
        let job = Part.wall p in concat [led (Approaching n) job before, concatMap (inPocket n job) (NonEmpty.toList along), led (Retracting n) job after]
    -- Where something is in the way, the cutter leaves what it cuts and comes back.
    inPocket n job m
      | pace m == Part.Rapid = led (Retracting n) job [m]
      | uncurry (/=) (heights m) = led (Approaching n) job [m]
      | otherwise = led (Cutting n) job [m]
    -- The control keeps the cutter beside the contour: each move of the edge goes as it is, those along a curve, too.
    keeping n asked job edge
      | null (Order.errors on) = Just (concat [led (Approaching n) job (Path.before edge), [Order asked on], one (Approaching n) (Path.entry edge), concatMap (one (Cutting n)) (Path.edge edge), [Order asked (Order.released machine)], one (Retracting n) (Path.exit edge), led (Retracting n) job (Path.behind edge)])
      | otherwise = Just [Order asked on]
      where
        on = Order.kept machine asked (Path.side edge) (Part.radius job)
        one r m = led r job [m {continues = False}]
    led r job = let allowed = Chord.allowedOn machine job in map (\ms -> Run r (allowed ms) (Part.radius job) Asked ms) . Path.runs

-- | The way of a move, in space.
wayOf :: Move -> Mm
wayOf m = Mm (sqrt (l * l + h * h))
  where
    Mm l = Segment.length (segment m)
    Mm h = uncurry minus (heights m)

-- | A move in two, so many mm before its end; the way is longer.
cutBefore :: Double -> Move -> (Move, Move)
cutBefore stretch m = (Path.unbraked (Path.atHeights (fst (heights m), z) m) {segment = front}, (Path.atHeights (z, snd (heights m)) m) {segment = back})
  where
    Mm way = wayOf m
    share = 1 - stretch / way
    (front, back) = Segment.cutAt share (segment m)
    z = Pulses.heightAt share m
