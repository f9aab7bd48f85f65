-- | Proof of a file of G-code: its motions are compared with the part, and the state of the control
-- at each of them with what the program asks for.
module Verify.FromGcode
  ( readTexts,
    framesRead,
    lineOfFrame,
    blendingBound,
    judged,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), minus, plus, times)
import Base.Region (Located (..))
import Data.List (foldl')
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Frame, FrameProgram)
import Frame.Frame qualified as Frame
import Gcode.Block (Fault)
import Gcode.Heading (FileHeading (..))
import Gcode.Heading qualified as Heading
import Gcode.HoleCycle qualified as HoleCycle
import Gcode.ModalState (Coolant (..), Plane (..))
import Gcode.Run qualified as Run
import Gcode.ToFrames (GcodeReading (..), ReadFrame (..))
import Gcode.ToFrames qualified as ToFrames
import Gcode.ToolTip qualified as ToolTip
import Machine.Machine (CommandValue (..), CommandWords (..), Machine, ProgramForm (..))
import Machine.Machine qualified as Machine
import Machine.ProgramForm (Lathe, RapidPath (..))
import Machine.ProgramForm qualified as ProgramForm
import Part.Part qualified as Part
import Verify.ControlFault qualified as ControlFault
import Verify.ControlState (StateDemand (..))
import Verify.ControlState qualified as ControlState
import Verify.LatheMove (LatheDemand (..), Nose (..))
import Verify.Proof (ContourProof (..), Finding (LeavesPath), Proof (..), Witness (amount))

-- | Reads the files of a program. Lines are counted over all files together. @program@ has the
-- planned frames.
readTexts ::
  Machine ->
  ProgramForm ->
  FileHeading ->
  FrameProgram ->
  [Text] ->
  Either Fault GcodeReading
readTexts machine form heading program texts =
  ToFrames.reading (settingOf machine form heading program) (Frame.start program) . concat
    <$> traverse ofFile (zip3 [1 ..] firstLines texts)
  where
    firstLines = scanl (+) 1 (map (length . Text.lines) texts)
    ofFile (k, first, text) =
      filter (\s -> k == length texts || Run.action s /= Run.Ends)
        <$> Run.run form (toolOf k) first text
    toolOf k
      | ProgramForm.changesTools (dialect form) = Nothing
      | otherwise = case drop (k - 1) (toolOrder heading) of
        n : _ -> Just n
        [] -> Nothing

-- | Facts about a program for the reading of its files.
settingOf :: Machine -> ProgramForm -> FileHeading -> FrameProgram -> ToFrames.FileSetting
settingOf machine form heading program =
  ToFrames.FileSetting
    { ToFrames.machine,
      ToFrames.level = levelOf machine form heading program,
      ToFrames.firstNumber = firstTool heading,
      ToFrames.tips = tipsOf machine form heading,
      ToFrames.stops = places,
      ToFrames.commandPlaces =
        [place | (place, frame) <- zip places frames, not (null (Frame.commands frame))]
    }
  where
    frames = map Frame.frame (Frame.plannedFrames program)
    places = scanl (+) (Frame.start program) (map Frame.increment frames)

-- | Offsets in pulses from the centre of each tool to the point that the control leads.
tipsOf :: Machine -> ProgramForm -> FileHeading -> Map Int Pulses3
tipsOf machine form heading = case lathe form of
  Nothing -> Map.empty
  Just _ -> fmap (ToolTip.offset machine) (cutters heading)

-- | Largest shift in mm of a path by the rounding of these offsets.
tipRounding :: Machine -> ProgramForm -> FileHeading -> Mm
tipRounding machine form heading = case lathe form of
  Nothing -> Mm 0
  Just _ -> foldl' max (Mm 0) (fmap (ToolTip.rounding machine) (cutters heading))

-- | Height in pulses from which on the tool is above everything, and a motion is not one of the
-- program; Nothing if no height in work coordinates is.
levelOf :: Machine -> ProgramForm -> FileHeading -> FrameProgram -> Maybe Pulses
levelOf machine form heading program =
  Heading.aboveEverything machine <$> Heading.safeHeightOn form raised
  where
    raised = Heading.raised machine form program heading

-- | Frames that were read.
framesRead :: GcodeReading -> [Frame]
framesRead = map readFrame . readFrames

-- | Number of the line of a frame, which is counted from 1.
lineOfFrame :: GcodeReading -> Int -> Maybe Int
lineOfFrame reading n = case drop (n - 1) (readFrames reading) of
  f : _ | n > 0 -> Just (readFrom f)
  _ -> Nothing

-- | State of the control that a program asks for. @hasContours@ is true if contours bound the
-- deviation at corners.
demandOf :: Machine -> ProgramForm -> FileHeading -> FrameProgram -> Bool -> StateDemand
demandOf machine form heading program hasContours =
  StateDemand
    { offset = workOffset heading,
      cuttingPlane = maybe PlaneXY (const PlaneZX) (lathe form),
      level = inPicometres <$> levelOf machine form heading program,
      boxLevel =
        let Mm z = freeHeight heading
            Mm pulse = Machine.resolutionOf machine Machine.Z
         in case rapidPath form of
              StraightPath -> Nothing
              BoxPath | isInfinite z -> Just maxBound
              -- The file has the height in whole pulses.
              BoxPath -> Just (round ((z - pulse / 2) * 1.0e9)),
      isByHand = isSpindleByHand heading,
      hasTurnFeeds = isJust (Machine.turnFeeds (Machine.feeds machine)),
      latheDemand = latheDemandOf machine heading <$> lathe form,
      runningCoolant = if switchesMist then Mist else Flood,
      mostBlending = if hasContours then Nothing else Just (Machine.planeResolution machine),
      tapNumbers =
        [n | (n, c) <- Map.toList (cutters heading), Part.kind c == Part.TappingCutter],
      tapPitches = map HoleCycle.tapPitch (Map.elems (tapNeeds heading))
    }
  where
    inPicometres (Pulses n) = n * round (resolution * 1.0e9)
    switchesMist =
      Fixed 7 `elem` map Machine.value (coolantOn (Machine.commandWords machine))
    Mm resolution = Machine.resolutionOf machine Machine.Z

-- | Demands of the program on the motions of a lathe.
latheDemandOf :: Machine -> FileHeading -> Lathe -> LatheDemand
latheDemandOf machine heading form =
  LatheDemand
    { wordsOfX = ProgramForm.meaningOfX form,
      profiles =
        map Part.segment (concatMap (NonEmpty.toList . Part.elements . Part.contour) turned),
      noses = fmap nose (cutters heading),
      slack =
        plus
          (times 2 (Machine.planeResolution machine))
          (foldl' max (Mm 0) (map (uncurry max . Part.deviationLimits . Part.tolerance) turned))
    }
  where
    turned = turnings heading
    nose cutter =
      let Pulses3 x y _ = ToolTip.offset machine cutter
          length' axis (Pulses n) =
            times (fromIntegral n) (Machine.resolutionOf machine axis)
       in Nose (Part.cutterRadius cutter) (length' Machine.X x) (length' Machine.Y y)

-- | Largest deviation that a control may make at corners: what the deviations of all contours leave
-- of the tolerance, rounded down to the last decimal of the file. Nothing if nothing is left, or
-- without contours.
blendingBound :: Machine -> Proof -> Maybe Mm
blendingBound machine proof = case mapMaybe left (contourProofs proof) of
  _ | null (contourProofs proof) -> Nothing
  rests -> positive (foldl' min (Mm (1 / 0)) rests)
  where
    pulse@(Mm step) = Machine.planeResolution machine
    left c = Just (minus (min (leftOf allowedGouge gouge c) (leftOf allowedExcess excess c)) pulse)
    leftOf allowed found c = minus (allowed c) (maybe (Mm 0) amount (found c))
    positive (Mm d)
      | n > 0 = Just (Mm (fromIntegral n * step))
      | otherwise = Nothing
      where
        n = floor (d / step + 1.0e-6) :: Int

-- | Judges the state of the control in all actions of a file. @proof@ is that of the path. What the
-- control may leave the path by is added to all deviations. If the control reads the numbers of the
-- file in another way than the program means them, the findings of the path are left out: they
-- would only follow from that.
judged :: Machine -> ProgramForm -> FileHeading -> FrameProgram -> GcodeReading -> Proof -> Proof
judged machine form heading program reading proof =
  proof
    { contourProofs = map farther (contourProofs proof),
      findings =
        if any (ControlFault.changesReading . ControlFault.fault) controlFindings
          then []
          else findings proof <> mapMaybe tooFar (contourProofs proof),
      controlFindings,
      mayLeave = p
    }
  where
    demand = demandOf machine form heading program (not (null (contourProofs proof)))
    controlFindings = ControlState.findings form demand (steps reading)
    p =
      plus
        (tipRounding machine form heading)
        (plus (ControlState.largestBlending (steps reading)) (offGrid reading))
    farther c = c {gouge = further <$> gouge c, excess = further <$> excess c}
    further w = w {amount = plus (amount w) p}
    tooFar c
      | p > Mm 0 && (isOver allowedGouge gouge || isOver allowedExcess excess) =
        Just (LeavesPath (region (contour c)) p largest least)
      | otherwise = Nothing
      where
        isOver allowed found =
          amountOf found <= allowed c
            && plus p (amountOf found) > plus (allowed c) (Mm 1.0e-9)
        amountOf found = maybe (Mm 0) amount (found c)
        largest = max (amountOf gouge) (amountOf excess)
        least = min (allowedGouge c) (allowedExcess c)
