-- | Commands of the part program as words of a machine, and the frames that hold them.
--
-- A command for which a machine has no word becomes a warning, because the operator can carry it
-- out by hand. For an auxiliary command, which the program writes as @aux N@, and for a stop or a
-- dwell, a missing word is an error. A number that does not fit its word is an error too. Commands
-- are pending until the next move, and are put into its frame. When the word of a new command is
-- already pending, the pending words first get a frame of their own. A stop and a dwell always have
-- frames of their own, because a control moves before it stops for a word of the same frame.
module Frame.Command
  ( Translation (..),
    translated,
    compensationOn,
    compensationOff,
    Pending (..),
    add,
    finalFrames,
  )
where

import Base.Quantity (Mm (..), Seconds (..), times)
import Base.Region (Located (Located), Region)
import Data.List (elemIndex, minimumBy, nub, sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Ord (comparing)
import Frame.Error (CommandKind (..), Error (..), Warning (..))
import Geometry.Carrier (Side (..))
import Machine.Machine
  ( CommandName,
    CommandValue (..),
    CommandWord (..),
    CommandWords
      ( auxiliary,
        coolantOff,
        coolantOn,
        dwell,
        optionalStop,
        programStop,
        spindleClockwise,
        spindleCounterClockwise,
        spindleOff,
        surfaceClockwise,
        surfaceCounterClockwise,
        toolChange
      ),
    CompensationCommands (..),
    Content (..),
    Machine,
    Service (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Part.CutFeed (SpindleRate (..))
import Part.Part (Command, Sense (..), Switch (..))
import Part.Part qualified as Part

-- | Words of a machine for a command, and the reports about it.
data Translation = Translation
  { -- | the words with their numbers; empty when the machine has no word for the command, or when
    -- there is no suitable number for the word
    numbers :: [(CommandName, Int)],
    -- | true if the words have frames of their own
    isAlone :: Bool,
    warnings :: [Warning],
    errors :: [Error]
  }

-- | Words for a command of the program, and the reports about it.
translated :: Machine -> Located Command -> Translation
translated machine (Located region c) = case wordsFor (Machine.commandWords machine) c of
  [] -> untranslated region c
  commandWords -> case concatMap (numbersFor machine c) commandWords of
    [] -> Translation [] False [SpindleSpeedMissing region] []
    ns ->
      Translation
        ns
        (kindOf c `elem` [StopCommand, DwellCommand])
        (concatMap (speedWarnings region c) commandWords)
        [ NoSuchCommand region (kindOf c) n most
          | (o, n) <- ns,
            Just most <- [Machine.commandCapacity machine o],
            n > most
        ]

-- | Reports about a command for which the machine has no word. The command that the operator
-- switches the spindle by hand has no words on any machine.
untranslated :: Region -> Command -> Translation
untranslated region c = case c of
  Part.Auxiliary n -> refused (NoSuchCommand region AuxiliaryCommand n 0)
  Part.ProgramStop -> refused (CannotWait region StopCommand)
  Part.OptionalStop -> refused (CannotWait region StopCommand)
  Part.Dwell _ -> refused (CannotWait region DwellCommand)
  Part.SpindleByHand -> Translation [] False [] []
  Part.SpindleOn _ (CuttingSpeed _ _) -> refused (NoCuttingSpeed region)
  Part.SpindleOn _ _ -> byHand
  Part.SpindleOff -> byHand
  Part.CoolantTo _ -> byHand
  Part.ChangeTool _ _ -> byHand
  where
    refused e = Translation [] False [] [e]
    byHand = Translation [] False [ManualCommand region (kindOf c)] []

-- | Words that a machine has for a command; empty if it has none.
wordsFor :: CommandWords -> Command -> [CommandWord]
wordsFor table c = case c of
  Part.SpindleOn Clockwise (CuttingSpeed _ _) -> surfaceClockwise table
  Part.SpindleOn CounterClockwise (CuttingSpeed _ _) -> surfaceCounterClockwise table
  Part.SpindleOn Clockwise _ -> spindleClockwise table
  Part.SpindleOn CounterClockwise _ -> spindleCounterClockwise table
  Part.SpindleOff -> spindleOff table
  Part.CoolantTo SwitchOn -> coolantOn table
  Part.CoolantTo SwitchOff -> coolantOff table
  Part.Auxiliary _ -> auxiliary table
  Part.ChangeTool _ _ -> toolChange table
  Part.SpindleByHand -> []
  Part.ProgramStop -> programStop table
  Part.OptionalStop -> optionalStop table
  Part.Dwell _ -> dwell table

-- | The kind of a command, by which reports name it.
kindOf :: Command -> CommandKind
kindOf c = case c of
  Part.Auxiliary _ -> AuxiliaryCommand
  Part.SpindleOn _ _ -> SpindleCommand
  Part.SpindleOff -> SpindleCommand
  Part.CoolantTo _ -> CoolantCommand
  Part.ChangeTool _ _ -> ToolCommand
  Part.SpindleByHand -> SpindleCommand
  Part.ProgramStop -> StopCommand
  Part.OptionalStop -> StopCommand
  Part.Dwell _ -> DwellCommand

-- | The word with its number for a command. Empty if the number is the spindle speed and the
-- program does not give it.
numbersFor :: Machine -> Command -> CommandWord -> [(CommandName, Int)]
numbersFor machine c CommandWord {commandName, value} = map (commandName,) $ case value of
  Fixed n -> [n]
  Argument -> case c of
    Part.Auxiliary n -> [n]
    Part.ChangeTool n _ -> [n]
    _ -> maybe [] (pure . round) (spindleSpeed c)
  Step table -> [n | Just asked <- [spindleSpeed c], Just (n, _) <- [nearestStep table asked]]
  Diameter -> []
  InSeconds -> [dwellNumber scale t | Part.Dwell t <- [c]]
  InMilliseconds -> [dwellNumber (1000 * scale) t | Part.Dwell t <- [c]]
  SurfaceSpeed step -> [round (v / step) | Part.SpindleOn _ (CuttingSpeed v _) <- [c]]
  SpeedLimit -> [round limit | Part.SpindleOn _ (CuttingSpeed _ limit) <- [c]]
  where
    scale = 10 ^ Machine.commandDecimals machine commandName

-- | Number of a dwell of @t@ seconds, with @scale@ units of the number in a second. It is rounded
-- up, so that the machine does not wait less. An excess of a millionth over a whole number is an
-- error of the computation, and is left out.
dwellNumber :: Double -> Seconds -> Int
dwellNumber scale (Seconds t) = max 1 (ceiling (t * scale - 1e-6))

-- | Spindle speed that a command asks for, in turns per minute. Nothing for a command without a
-- speed.
spindleSpeed :: Command -> Maybe Double
spindleSpeed c = case c of
  Part.SpindleOn _ (TurnsPerMinute n) -> Just n
  Part.SpindleOn _ (CuttingSpeed _ _) -> Nothing
  Part.SpindleOn _ NoRate -> Nothing
  Part.SpindleOff -> Nothing
  Part.CoolantTo _ -> Nothing
  Part.Auxiliary _ -> Nothing
  Part.ChangeTool _ _ -> Nothing
  Part.SpindleByHand -> Nothing
  Part.ProgramStop -> Nothing
  Part.OptionalStop -> Nothing
  Part.Dwell _ -> Nothing

-- | Warning about a spindle speed that differs from the one asked for by more than 'speedSlack'.
-- Empty for every other command.
speedWarnings :: Region -> Command -> CommandWord -> [Warning]
speedWarnings region c CommandWord {value} = case (value, spindleSpeed c) of
  (Step table, Just asked) ->
    [ SpindleSpeedDiffers region asked obtained (Just (minimum table, maximum table))
      | Just (_, obtained) <- [nearestStep table asked],
        differs asked obtained
    ]
  (Argument, Just asked)
    | differs asked (whole asked) -> [SpindleSpeedDiffers region asked (whole asked) Nothing]
  _ -> []
  where
    whole asked = fromIntegral (round asked :: Int)
    differs asked obtained = abs (obtained - asked) > speedSlack * asked

-- | Share of the requested spindle speed by which the machine's speed may differ without a
-- warning.
speedSlack :: Double
speedSlack = 0.1

-- | Number in @table@ of the speed nearest to @asked@, and that speed; the smaller number if two
-- speeds are equally near. Speeds are in turns per minute. Nothing for an empty table.
nearestStep :: Map.Map Int Double -> Double -> Maybe (Int, Double)
nearestStep table asked = case Map.toList table of
  [] -> Nothing
  steps -> Just (minimumBy (comparing (\(n, v) -> (abs (v - asked), n))) steps)

-- Cutter compensation -----------------------------------------------------------------------------

-- | Words that switch cutter compensation on, for a cutter with the radius @radius@ in mm on one
-- side of the contour. @asked@ is the region of the program that asks for compensation. If the
-- word takes the cutter's diameter, its number is the diameter in units of the word's last
-- decimal. On a machine with a mirrored plane left and right are exchanged.
compensationOn :: Machine -> Region -> Side -> Mm -> Translation
compensationOn machine asked side radius@(Mm r) =
  case Machine.compensation (Machine.commandWords machine) of
    Nothing -> Translation [] False [] [NoCompensation asked]
    Just c -> case numberOf (if isLeft then compensateLeft c else compensateRight c) of
      Just n -> Translation (n : switches c) False [] []
      Nothing -> Translation [] False [] [DiameterOutOfRange asked (times 2 radius)]
  where
    isLeft = (side == LeftOf) /= Machine.isMirrored machine
    switches c = [(commandName w, n) | Just w <- [radiusSwitch c], Fixed n <- [value w]]
    numberOf CommandWord {commandName, value} = case value of
      Fixed n -> Just (commandName, n)
      Diameter
        | Machine.canEncode machine commandName n
            && abs (fromIntegral n / scale - 2 * r) <= planeResolution ->
          Just (commandName, n)
        | otherwise -> Nothing
        where
          n = round (2 * r * scale)
          scale = 10 ^ Machine.commandDecimals machine commandName
      Argument -> Nothing
      Step _ -> Nothing
      InSeconds -> Nothing
      InMilliseconds -> Nothing
      SurfaceSpeed _ -> Nothing
      SpeedLimit -> Nothing
    Mm planeResolution = Machine.planeResolution machine

-- | Words that switch cutter compensation off.
compensationOff :: Machine -> Translation
compensationOff machine =
  Translation
    [ (commandName o, n)
      | Just c <- [Machine.compensation (Machine.commandWords machine)],
        let o = cancelCompensation c,
        Fixed n <- [value o]
    ]
    False
    []
    []

-- The frames of commands --------------------------------------------------------------------------

-- | Commands that no frame holds yet: the region of the program that asks for the first one, and
-- the words in the order of the frame layout.
data Pending = Pending {asked :: Region, given :: [(CommandName, Int)]}
  deriving stock (Eq, Show)

-- | Adds the words of a command to the pending ones; @region@ asks for the command. No word may
-- occur twice in a frame. Therefore a command that repeats a word is divided into several groups.
-- Stops, dwells and commands of cutter compensation may need a frame of their own.
-- The result has the groups of words that need frames of their own now, and the group that remains
-- pending.
add ::
  Machine ->
  Region ->
  Translation ->
  Maybe Pending ->
  ([Pending], Maybe Pending)
add machine region translation pending = case (withoutRepetition commandWords, pending) of
  ([], _) -> ([], pending)
  (groups, before)
    | isAlone translation || any ((`elem` lonely machine) . fst) commandWords ->
      (maybe [] pure before <> map group groups, Nothing)
  ([only], Just before)
    | not (any ((`elem` map fst (given before)) . fst) only) ->
      ([], Just before {given = inOrder machine (given before <> only)})
  (groups, before) ->
    (maybe [] pure before <> map group (init groups), Just (group (last groups)))
  where
    commandWords = numbers translation
    group ws = Pending {asked = region, given = inOrder machine ws}
    withoutRepetition os = case os of
      [] -> []
      o : more -> case withoutRepetition more of
        ws : others | fst o `notElem` map fst ws -> (o : ws) : others
        others -> [o] : others

-- | Commands that have a frame of their own: those of cutter compensation, if the operator sets
-- the cutter's radius at a switch.
lonely :: Machine -> [CommandName]
lonely machine =
  [ commandName w
    | Just c@CompensationCommands {radiusSwitch = Just _} <-
        [Machine.compensation (Machine.commandWords machine)],
      w <- [compensateLeft c, compensateRight c, cancelCompensation c]
  ]

-- | Words in the order in which the machine's frame has them. The frame holds the number of a
-- command in a word for this command, or in bits in the service track of other words. The service
-- track is a track of the tape besides those that hold the number of a word.
inOrder :: Machine -> [(CommandName, Int)] -> [(CommandName, Int)]
inOrder machine = sortOn (\(o, _) -> elemIndex o names)
  where
    names = nub (concatMap namesOf (Machine.wordsOf machine))
    namesOf w = case content w of
      Command o -> [o]
      FrameNumber -> bits w
      Motion _ -> bits w
      Along _ -> bits w
      About _ -> bits w
      Centre _ -> bits w
      FeedWord -> bits w
    bits w = [o | CommandBit o _ <- Machine.service (form w)]

-- | Words of the frames that end every program of a machine: one list for each frame.
finalFrames :: Machine -> [[(CommandName, Int)]]
finalFrames machine =
  [ inOrder machine [(commandName o, n) | o <- NonEmpty.toList group, Fixed n <- [value o]]
    | group <- Machine.finish (Machine.commandWords machine)
  ]
