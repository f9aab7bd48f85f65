-- | Reads the section @program@ of a description, and checks it against the other sections.
module Machine.ProgramFromText
  ( programForm,
    check,
  )
where

import Base.Quantity (LengthUnit (..), Mm (..), Seconds (..))
import Base.Region (Located (..), Region)
import Base.Result (Result)
import Data.List (nub)
import Data.Maybe (isNothing)
import Machine.Error (Error (..), FrameFault (..))
import Machine.FrameFromText (quotedText)
import Machine.Machine (Axis (..), CommandWords (..), Content (..), Machine)
import Machine.Machine qualified as Machine
import Machine.ProgramForm
import Machine.Section
import Machine.Syntax (Argument, Argument_ (..), Statement)

-- | Reads the section @program@.
programForm :: Statement -> Result w Error ProgramForm
programForm s = do
  ((), section) <- withBlock ["program { … }"] "the program" noArguments s
  ProgramForm
    <$> required "dialect" "dialect linuxcnc" dialectFrom section
    <*> required "retract" "retract machine 0 mm" retractFrom section
    <*> required "spin-up" "spin-up 3 s" spinUpFrom section
    <*> required "rapid" "rapid straight" rapidFrom section
    <*> optional "cross-slide" Nothing (fmap Just . latheFrom) section
    <*> required "characters" "characters 250" charactersFrom section
    <*> optional "change-at" Nothing (fmap Just . placeFrom) section
    <*> cyclesFrom section
    <*> pure Millimetres
    <*> optional "line-numbers" Nothing (fmap Just . stepFrom) section
    <*> optional "remark" "" quotedText section
    <* allowKeys keys [] section
  where
    keys =
      ["dialect", "retract", "spin-up", "rapid", "cross-slide", "characters", "change-at"]
        <> ["line-numbers", "remark", "cycles", "peck-return", "chip-return", "tapping"]
    dialectFrom =
      choice [("linuxcnc", LinuxCnc), ("grbl", Grbl), ("marlin", Marlin), ("fanuc", Fanuc)]
    rapidFrom = choice [("straight", StraightPath), ("box", BoxPath)]
    spinUpFrom = withArguments ["spin-up 3 s"] oneTime
    oneTime args = case args of
      [a, b] -> fmap Seconds <$> quantityIn "the time of the spindle" "s" 60 a b
      _ -> Nothing
    stepFrom = withArguments ["line-numbers 10"] oneStep
    oneStep args = case args of
      [a] -> wholeIn "the step of the line numbers" 1 100 a
      _ -> Nothing
    charactersFrom = withArguments ["characters 250"] oneCount
    oneCount args = case args of
      [a] -> wholeIn "the count of characters" 40 1000 a
      _ -> Nothing

-- | Reads the place of the tool change.
placeFrom :: Statement -> Result w Error (Mm, Mm)
placeFrom = withArguments ["change-at 0 mm 0 mm"] place
  where
    place :: [Argument] -> Maybe (Result w Error (Mm, Mm))
    place args = case map value args of
      [Number _ x, Word "mm", Number _ y, Word "mm"]
        | abs x <= 10000, abs y <= 10000 -> Just (pure (Mm x, Mm y))
      _ -> Nothing

-- | Reads the canned cycles for holes.
cyclesFrom :: DescriptionSection -> Result w Error HoleCycles
cyclesFrom section =
  HoleCycles
    <$> optional "cycles" [] (withArguments ["cycles drill dwell ream"] plain) section
    <*> optional "peck-return" Nothing (fmap Just . heightOf "peck-return 0.254 mm") section
    <*> optional "chip-return" Nothing (fmap Just . heightOf "chip-return 0.254 mm") section
    <*> optional "tapping" Nothing (fmap Just . tapFrom) section
  where
    plain :: [Argument] -> Maybe (Result w Error [PlainCycle])
    plain args = case traverse (named . value) args of
      Just cs | not (null cs), length (nub cs) == length cs -> Just (pure cs)
      _ -> Nothing
    named a = case a of
      Word "drill" -> Just DrillCycle
      Word "dwell" -> Just DwellCycle
      Word "ream" -> Just ReamCycle
      _ -> Nothing
    heightOf example = withArguments [example] height
    height :: [Argument] -> Maybe (Result w Error Mm)
    height args = case map value args of
      [Number _ v, Word "mm"] | v > 0 && v <= 100 -> Just (pure (Mm v))
      _ -> Nothing
    tapFrom =
      choice
        [("synchronous", SynchronousTap), ("rigid", RigidTap), ("floating", FloatingTap)]

-- | Reads the height to which the tool goes first.
retractFrom :: Statement -> Result w Error Retract
retractFrom =
  withArguments
    ["retract machine 0 mm", "retract reference", "retract safe", "retract safe 40 mm"]
    form
  where
    form :: [Argument] -> Maybe (Result w Error Retract)
    form args = case map value args of
      [Word "machine", Number _ v, Word "mm"]
        | abs v <= 10000 -> Just (pure (MachineHeight (Mm v)))
      [Word "reference"] -> Just (pure ReferencePoint)
      [Word "safe"] -> Just (pure (SafeHeight Nothing))
      [Word "safe", Number _ v, Word "mm"]
        | v > 0 && v <= 10000 -> Just (pure (SafeHeight (Just (Mm v))))
      _ -> Nothing

-- | Reads how a lathe leaves the work.
latheFrom :: Statement -> Result w Error Lathe
latheFrom = withArguments ["cross-slide 0 mm diameters", "cross-slide 0 mm radii"] form
  where
    form :: [Argument] -> Maybe (Result w Error Lathe)
    form args = case map value args of
      [Number _ v, Word "mm", Word "diameters"] -> position v XDiameter
      [Number _ v, Word "mm", Word "radii"] -> position v XRadius
      _ -> Nothing
    position v meaning
      | abs v <= 10000 = Just (pure (Lathe (Mm v) meaning))
      | otherwise = Nothing

-- | Commands that every program of this form needs, and the words of a lathe.
check :: Machine -> Region -> ProgramForm -> [Error]
check machine region form =
  [ Missing region "the commands" name example
    | (name, example, False) <-
        [ ("spindle-clockwise", "spindle-clockwise { set S argument … }", has spindleClockwise),
          ("spindle-off", "spindle-off { set M 5 }", has spindleOff),
          ("tool-change", "tool-change { set T argument … }", has toolChange || isFixed)
        ]
  ]
    <> [ BadFrame region (Unsuited (Machine.contentName content) why)
         | Just _ <- [lathe form],
           (content, why, False) <-
             [ (Along X, "On a lathe the address of x, along the spindle, is Z.", isNamed "Z" X),
               (Along Y, "On a lathe the address of y, the radius, is X.", isNamed "X" Y),
               (Along Z, "A lathe has the axes x and y only.", isNothing (wordOf Z))
             ]
       ]
    <> [ Missing region "the program" name example
         | Just _ <- [lathe form],
           (name, example, False) <-
             [ ("dialect linuxcnc", "dialect linuxcnc", dialect form == LinuxCnc),
               ("retract machine", "retract machine 0 mm", isMachineHeight (retract form))
             ]
       ]
  where
    wordOf = Machine.wordFor machine . Along
    isNamed name axis = (Machine.address <$> wordOf axis) == Just name
    isMachineHeight r = case r of
      MachineHeight _ -> True
      ReferencePoint -> False
      SafeHeight _ -> False
    has list = not (null (list (Machine.commandWords machine)))
    isFixed = not (changesTools (dialect form))
