-- | What of the path becomes frames, before anything is rounded.
module Frame.Instruction
  ( Instruction (..),
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
import Frame.Command (Told)
import Frame.Command qualified as Command
import Frame.Frame (Role (..))
import Frame.Rounding qualified as Rounding
import Geometry.Segment qualified as Segment
import Machine.Machine (Machine)
import Part.Part qualified as Part
import Toolpath.Toolpath (Move (..), Toolpath, heights, pace)
import Toolpath.Toolpath qualified as Toolpath

-- | Moves along one line, arc or curve with their role and what is allowed to their chords, or a
-- command.
data Instruction
  = Run
      { role :: Role,
        allowed :: Allowed,
        -- | the radius of the cutter
        tool :: Mm,
        drive :: Drive,
        run :: NonEmpty Move
      }
  | -- | a command, or what tells the control to keep the cutter beside the contour or no longer:
    -- where it is asked
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
tasksOf :: Machine -> Toolpath -> [Instruction]
tasksOf machine path =
  concat (zipWith block (Toolpath.passNumbers (Toolpath.blocks path)) (Toolpath.blocks path))
  where
    straight r radius = map (Run r (Sagitta (Mm 0)) radius Asked . (:| []))
    block n b = case b of
      Toolpath.Travelling radius ms -> straight Travelling radius ms
      Toolpath.Holing (Located _ d) ms -> straight Drilling (Part.drillRadius d) ms
      Toolpath.Commanding c -> [Order (region c) (Command.told machine c)]
      Toolpath.Cutting
        { Toolpath.job = Located region' job,
          Toolpath.approach = before,
          Toolpath.cut = along,
          Toolpath.retract = after,
          Toolpath.sent
        } ->
          fromMaybe
            ( concat
                [ led (Approaching n) job before,
                  led (Cutting n) job (NonEmpty.toList along),
                  led (Retracting n) job after
                ]
            )
            (keeping n (fromMaybe region' (Part.byControl job)) job =<< sent)
      Toolpath.Clearing
        { Toolpath.pocket = Located _ p,
          Toolpath.approach = before,
          Toolpath.cleared = along,
          Toolpath.retract = after
        } ->
          let job =
                Part.wall p
           in concat
                [ led (Approaching n) job before,
                  concatMap (inPocket n job) (NonEmpty.toList along),
                  led (Retracting n) job after
                ]
    -- Where something is in the way, the cutter leaves what it cuts and comes back.
    inPocket n job m
      | pace m == Part.Rapid = led (Retracting n) job [m]
      | uncurry (/=) (heights m) = led (Approaching n) job [m]
      | otherwise = led (Cutting n) job [m]
    -- The control keeps the cutter beside the contour: each move of the edge goes as it is, those
    -- along a curve, too.
    keeping n asked job edge
      | null (Command.errors on) =
        Just
          ( concat
              [ led (Approaching n) job (Toolpath.before edge),
                [Order asked on],
                one (Approaching n) (Toolpath.entry edge),
                concatMap (one (Cutting n)) (Toolpath.edge edge),
                [Order asked (Command.released machine)],
                one (Retracting n) (Toolpath.exit edge),
                led (Retracting n) job (Toolpath.behind edge)
              ]
          )
      | otherwise = Just [Order asked on]
      where
        on = Command.kept machine asked (Toolpath.side edge) (Part.radius job)
        one r m = led r job [m {continues = False}]
    led r job =
      let allowed =
            Chord.allowedOn machine job
       in map (\ms -> Run r (allowed ms) (Part.radius job) Asked ms) . Toolpath.runs

-- | The way of a move, in space.
wayOf :: Move -> Mm
wayOf m = Mm (sqrt (l * l + h * h))
  where
    Mm l = Segment.length (segment m)
    Mm h = uncurry minus (heights m)

-- | A move in two, so many mm before its end; the way is longer.
cutBefore :: Double -> Move -> (Move, Move)
cutBefore stretch m =
  ( Toolpath.unbraked (Toolpath.atHeights (fst (heights m), z) m) {segment = front},
    (Toolpath.atHeights (z, snd (heights m)) m) {segment = back}
  )
  where
    Mm way = wayOf m
    share = 1 - stretch / way
    (front, back) = Segment.cutAt share (segment m)
    z = Rounding.heightAt share m
