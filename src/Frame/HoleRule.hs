-- | Holes on a machine: the pecks of its control's own cycles, and what it can tap.
module Frame.HoleRule
  ( adapted,
    tapErrors,
  )
where

import Base.Quantity (Feed (..), Mm (..), minus, times)
import Base.Region (Located (..))
import Frame.Error (Error (..))
import Frame.TapError (TapFault (..))
import Frame.TapError qualified as TapError
import Machine.Machine (Axis (Z), Machine)
import Machine.Machine qualified as Machine
import Machine.ProgramForm (HoleCycles, TapControl (..))
import Machine.ProgramForm qualified as ProgramForm
import Part.CutFeed qualified as CutFeed
import Part.Part (Drilling, HoleForm (..), TapStroke (..))
import Part.Part qualified as Part
import Toolpath.DrillMove (PeckRule (..))
import Toolpath.DrillMove qualified as DrillMove
import Toolpath.Toolpath (Block (..), Toolpath (..))

-- | A toolpath whose pecks are those of the control's own cycle, where it has one for them.
adapted :: Machine -> Toolpath -> Toolpath
adapted machine path = path {blocks = map adaptedBlock (blocks path)}
  where
    adaptedBlock b = case b of
      Holing d ms
        | Just rule <- peckRule machine (value d) ->
          Holing d (DrillMove.withRule rule (value d) ms)
      _ -> b

-- | The pecks of the control's own cycle; Nothing if it has none for a drilling, for a drilling in
-- one move, and if the first peck of the cycle would end above the part.
peckRule :: Machine -> Drilling -> Maybe PeckRule
peckRule machine d = case (cyclesOf machine, Part.peckDepth d) of
  (Just cycles, Just most) | most > Part.travelHeight d -> case Part.chipRise d of
    Nothing -> rule <$> ProgramForm.peckReturn cycles
    Just rise
      | Just own <- ProgramForm.chipReturn cycles, isSame own rise -> Just (rule own)
      | otherwise -> Nothing
  _ -> Nothing
  where
    rule back = PeckRule {peckReturn = back, peckUnit = unit}
    unit = Machine.resolutionOf machine Z
    isSame a b = abs' (minus a b) <= times 0.5 unit
    abs' (Mm x) = Mm (abs x)

cyclesOf :: Machine -> Maybe HoleCycles
cyclesOf machine = ProgramForm.cycles <$> Machine.programForm machine

-- | Errors of the taps that a machine cannot drive.
tapErrors :: Machine -> Toolpath -> [Error]
tapErrors machine path =
  [ CannotTap (region (Part.drillFeed d)) fault
    | Holing (Located _ d) _ <- blocks path,
      Tapped t <- [Part.form d],
      Just fault <- [faultOf d t]
  ]
  where
    faultOf d t = case (ProgramForm.tapControl =<< cyclesOf machine, floats t) of
      (Nothing, _) -> Just NoTapCycle
      (Just FloatingTap, Nothing) -> Just NeedsFloatingHolder
      (Just SynchronousTap, Nothing) -> Nothing
      _
        | tapSense t == Part.CounterClockwise -> Just OnlyRightHand
        | Just fault <- tapFeed d t, not (TapError.holdsFeed fault) -> Just (UnevenFeed fault)
        | otherwise -> Nothing
    tapFeed d t = case (CutFeed.perMinute (value (Part.drillFeed d)), tapPitch t) of
      (Just (Feed f), Mm pitch) ->
        Just
          TapError.TapFeed
            { TapError.tappedPitch = Mm pitch,
              TapError.tapSpeed = f / pitch,
              TapError.feedStep = Machine.directStep (Machine.feeds machine)
            }
      _ -> Nothing
