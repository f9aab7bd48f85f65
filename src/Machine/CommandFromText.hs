-- | Reads the section @commands@ of a description: the numbers that frames contain for each
-- command of a part program.
--
-- An event is what makes the compiler write a command: the spindle starts, the coolant goes off,
-- the program ends. Each event has a key in the section, such as @coolant-on@. A command word is
-- one number of an event, with the name of the word that contains it: @set M 8@ is the number 8 in
-- the word @M@.
module Machine.CommandFromText
  ( CommandContext (..),
    noCommands,
    commands,
    check,
  )
where

import Base.Crash qualified as Crash
import Base.Region (Located (..), Region)
import Base.Result (Result)
import Base.Result qualified as Result
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (maybeToList)
import Data.Text (Text)
import Machine.Error (CommandFault (..), Error (..))
import Machine.FeedFromText qualified as FeedFromText
import Machine.Machine
  ( CommandName (..),
    CommandValue (..),
    CommandWord (CommandWord, commandName),
    CommandWords (..),
    CompensationCommands (..),
    Content (..),
    Machine,
    NumberForm (..),
    Service (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Machine.Section
import Machine.Syntax

-- | The command words of all events. 'eventWords' lists the same command words for the checks,
-- each with its region and the key of its event.
data CommandContext = CommandContext
  { allWords :: CommandWords,
    eventWords :: [(Text, Located CommandWord)]
  }

-- | The command words of a description without the section @commands@: none.
noCommands :: CommandContext
noCommands = CommandContext Machine.noCommandWords []

-- | Command words of all events with their regions in the description, before they are put into a
-- 'CommandContext'.
data Events = Events
  { -- | one list of command words for each key in 'simpleEvents', in the order of the keys
    simple :: [[Located CommandWord]],
    compensations :: Maybe CompensationEvents,
    endFrames :: [NonEmpty (Located CommandWord)]
  }

-- | Command words of cutter compensation with their regions.
data CompensationEvents = CompensationEvents
  { left :: Located CommandWord,
    right :: Located CommandWord,
    off :: Located CommandWord,
    switch :: Maybe (Located CommandWord)
  }

-- | Keys of all events but @compensation@ and @finish@, whose blocks have blocks of their own.
simpleEvents :: [Text]
simpleEvents =
  [ "spindle-clockwise",
    "spindle-counterclockwise",
    "spindle-off",
    "coolant-on",
    "coolant-off",
    "tool-change",
    "auxiliary",
    "stop",
    "optional-stop",
    "dwell",
    "surface-clockwise",
    "surface-counterclockwise"
  ]

-- | Reads the section @commands@.
commands :: Statement -> Result w Error CommandContext
commands s = do
  ((), section) <- withBlock ["commands { … }"] "the commands" noArguments s
  events <-
    Events
      <$> traverse (\word -> optional word [] (eventFrom word) section) simpleEvents
      <*> optional "compensation" Nothing (fmap Just . compensationFrom) section
      <*> optional "finish" [] finishFrom section
      <* allowKeys (simpleEvents <> ["compensation", "finish"]) [] section
  pure CommandContext {allWords = commandWords events, eventWords = withEvents events}

-- | The command words of all events without their regions.
commandWords :: Events -> CommandWords
commandWords events = case map (map value) (simple events) of
  [clockwise, counterClockwise, rest, on', off', tool', aux, stop, optional', dwell', cw, ccw] ->
    CommandWords
      { spindleClockwise = clockwise,
        spindleCounterClockwise = counterClockwise,
        spindleOff = rest,
        coolantOn = on',
        coolantOff = off',
        toolChange = tool',
        auxiliary = aux,
        programStop = stop,
        optionalStop = optional',
        dwell = dwell',
        surfaceClockwise = cw,
        surfaceCounterClockwise = ccw,
        compensation = unlocated <$> compensations events,
        finish = map (fmap value) (endFrames events)
      }
  _ -> Crash.bug "the events of a machine are as many as their keys"
  where
    unlocated c =
      CompensationCommands
        { compensateLeft = value (left c),
          compensateRight = value (right c),
          cancelCompensation = value (off c),
          radiusSwitch = value <$> switch c
        }

-- | The command words of all events, each with the key of its event.
withEvents :: Events -> [(Text, Located CommandWord)]
withEvents events =
  concat
    [ [(word, w) | (word, ws) <- zip simpleEvents (simple events), w <- ws],
      [ ("compensation", w)
        | Just c <- [compensations events],
          w <- [left c, right c, off c] <> maybeToList (switch c)
      ],
      [("finish", w) | ws <- endFrames events, w <- NonEmpty.toList ws]
    ]

-- | Reads the lines, such as @set M 8@, in the block of the event with the key @word@.
eventFrom :: Text -> Statement -> Result w Error [Located CommandWord]
eventFrom word s = do
  ((), section) <- withBlock [word <> " { set M 8 }"] ("‘" <> word <> "’") noArguments s
  NonEmpty.toList <$> wordsFrom section

-- | Reads the lines of a section, such as @set M 8@. Reports a section without such a line, and a
-- second line with the same name, here @M@.
wordsFrom :: DescriptionSection -> Result w Error (NonEmpty (Located CommandWord))
wordsFrom section = do
  found <-
    traverse wordFrom (filter ((== Just "set") . keyWord) (entries section))
      <* allowKeys [] ["set"] section
  case NonEmpty.nonEmpty found of
    Nothing ->
      Result.failed (Missing (sectionRegion section) (sectionName section) "set" "set M 8")
    Just some -> Result.failing (repetitions (NonEmpty.toList some)) some
  where
    repetitions ws =
      [ Twice r ("the number of ‘" <> n <> "’") first
        | (k, Located r w) <- zip [0 ..] ws,
          let CommandName n = commandName w,
          Located first _ <- take 1 [p | p <- take k ws, commandName (value p) == commandName w]
      ]

-- | Reads a command word from a line such as @set M 8@.
wordFrom :: Statement -> Result w Error (Located CommandWord)
wordFrom s = case (arguments s, block s) of
  ([name, Located _ (Word "steps")], Just ss)
    | not (broken s),
      Nothing <- formula s,
      Just n <- nameFrom name ->
      located n . Step <$> FeedFromText.table (stepSection ss)
  _ -> withArguments forms oneNumber s
  where
    forms =
      ["set M 8", "set S argument", "set D diameter", "set P seconds", "set P milliseconds"]
        <> ["set S steps { 1 = 63 … }", "set S cutting-speed", "set D limit"]
    stepSection ss =
      DescriptionSection {sectionName = "the steps", sectionRegion = extent s, entries = ss}
    located n v = Located (extent s) (CommandWord (CommandName n) v)
    nameFrom a = case value a of
      Word n -> Just n
      Quoted n -> Just n
      _ -> Nothing
    oneNumber args = case args of
      [name, Located _ (Word "argument")] -> pure . (`located` Argument) <$> nameFrom name
      [name, Located _ (Word "diameter")] -> pure . (`located` Diameter) <$> nameFrom name
      [name, Located _ (Word "seconds")] -> pure . (`located` InSeconds) <$> nameFrom name
      [name, Located _ (Word "cutting-speed")] ->
        pure . (`located` SurfaceSpeed 1000) <$> nameFrom name
      [name, Located _ (Word "limit")] -> pure . (`located` SpeedLimit) <$> nameFrom name
      [name, Located _ (Word "milliseconds")] ->
        pure . (`located` InMilliseconds) <$> nameFrom name
      [name, a] -> do
        n <- nameFrom name
        fmap (located n . Fixed) <$> wholeIn "the number" 0 999999999 a
      _ -> Nothing

-- | Reads the event @compensation@: one command word each for left, right and off.
compensationFrom :: Statement -> Result w Error CompensationEvents
compensationFrom s = do
  ((), section) <- withBlock [example] "the compensation" noArguments s
  CompensationEvents
    <$> side "left" section
      <*> side "right" section
      <*> side "off" section
      <*> optional "switch" Nothing (fmap Just . one "switch") section
      <* allowKeys ["left", "right", "off", "switch"] [] section
  where
    example = "compensation { left { … } right { … } off { … } }"
    side word = required word (word <> " { set D diameter }") (one word)
    one word e = do
      found <- eventFrom word e
      case found of
        [w] -> pure w
        _ -> malformed [word <> " { set D diameter }, with one number"] e

-- | Reads the command words in the last frames of every program, one list for each frame.
finishFrom :: Statement -> Result w Error [NonEmpty (Located CommandWord)]
finishFrom s = do
  ((), section) <- withBlock ["finish { frame { set M 2 } }"] "the end of a program" noArguments s
  traverse frame (filter ((== Just "frame") . keyWord) (entries section))
    <* allowKeys [] ["frame"] section
  where
    frame e = withBlock ["frame { set M 2 }"] "this frame" noArguments e >>= wordsFrom . snd

-- | Checks all command words against the layout of the frame.
check :: Machine -> CommandContext -> [Error]
check machine context = concatMap (wordFaults machine) (eventWords context)

-- | Lists the mistakes in one command word of the event with the given key.
wordFaults :: Machine -> (Text, Located CommandWord) -> [Error]
wordFaults machine (event, Located r (CommandWord name v)) =
  case Machine.commandCapacity machine name of
    Nothing -> [BadCommand r (UnknownCommandName (nameText name) (namesIn machine))]
    Just most ->
      sizeFaults machine r name most v
        <> eventFaults r event v
        <> [ BadCommand r ZeroIsNoCommand
             | givesZero v,
               not (Machine.canEncode machine name 0)
           ]
  where
    nameText (CommandName n) = n

-- | Names of the commands for which the frame has a word or bits.
namesIn :: Machine -> [Text]
namesIn machine =
  [ n
    | w <- Machine.wordsOf machine,
      CommandName n <- [o | Command o <- [content w]] <> [o | CommandBit o _ <- service (form w)]
  ]

givesZero :: CommandValue -> Bool
givesZero v = case v of
  Fixed k -> k == 0
  Step t -> Map.member 0 t
  Argument -> False
  Diameter -> False
  InSeconds -> False
  InMilliseconds -> False
  SurfaceSpeed _ -> False
  SpeedLimit -> False

-- | Reports numbers above @most@, the largest number that the command's word or bits can hold. It
-- also reports whole numbers in a word with decimals.
sizeFaults :: Machine -> Region -> CommandName -> Int -> CommandValue -> [Error]
sizeFaults machine r name most v = case v of
  Fixed k -> tooLarge [k] <> decimalsFault
  Argument -> decimalsFault
  Step t -> tooLarge (take 1 (filter (> most) (Map.keys t))) <> decimalsFault
  Diameter -> []
  InSeconds -> []
  InMilliseconds -> []
  SurfaceSpeed _ -> decimalsFault
  SpeedLimit -> decimalsFault
  where
    tooLarge ks = [BadCommand r (NumberTooLarge k most) | k <- ks, k > most]
    decimalsFault =
      [ BadCommand r InDecimals
        | w <- Machine.wordsOf machine,
          content w == Command name,
          decimals (form w) > 0
      ]

-- | Reports a kind of value that the event with the key @event@ does not allow, such as a diameter
-- for a tool change.
eventFaults :: Region -> Text -> CommandValue -> [Error]
eventFaults r event v = case v of
  Fixed _ -> []
  Argument -> onlyFor "argument" (spindleEvents <> ["tool-change", "auxiliary"])
  Step _ -> onlyFor "steps" spindleEvents
  Diameter -> onlyFor "diameter" ["compensation"]
  InSeconds -> onlyFor "seconds" ["dwell"]
  InMilliseconds -> onlyFor "milliseconds" ["dwell"]
  SurfaceSpeed _ -> onlyFor "cutting-speed" surfaceEvents
  SpeedLimit -> onlyFor "limit" surfaceEvents
  where
    surfaceEvents = ["surface-clockwise", "surface-counterclockwise"]
    spindleEvents = ["spindle-clockwise", "spindle-counterclockwise"]
    onlyFor kind events = [BadCommand r (NoSuchValue kind event) | event `notElem` events]
