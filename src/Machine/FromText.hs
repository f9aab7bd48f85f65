-- | Reads machines from their descriptions, in three steps.
--
-- 1. "Machine.Parser" parses the text into statements.
-- 2. Each section is read by itself. A mistake in one section does not hide those in another.
-- 3. The sections are checked against each other, for example the words of the frame against axes,
--    code, feeds and commands. This step is left out if a section cannot be read.
--
-- Each step reports all mistakes that it finds. A description with a mistake gives no machine.
module Machine.FromText
  ( read,
  )
where

import Base.Quantity (Mm (..))
import Base.Quantity qualified as Quantity
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.Char (isAlphaNum)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, maybeToList)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Axis (axisName, rotaryName)
import Machine.CodeFromText qualified as CodeFromText
import Machine.CommandFromText qualified as CommandFromText
import Machine.Completeness qualified as Completeness
import Machine.ControllerFromText qualified as ControllerFromText
import Machine.Error (AxisKind (..), Error (..), FrameFault (BrakedFrequencies), ServiceFault (..))
import Machine.FeedFromText qualified as FeedFromText
import Machine.FrameFromText (LocatedLayout (locatedItems, separatorRegion), quotedText)
import Machine.FrameFromText qualified as FrameFromText
import Machine.Machine hiding (value)
import Machine.Parser (Parsed (..))
import Machine.Parser qualified as Parser
import Machine.ProgramFromText qualified as ProgramFromText
import Machine.Provenance qualified as Provenance
import Machine.Section
import Machine.Syntax (Argument_ (..), Statement (..), keyWord)
import Machine.UniqueDecoding qualified as UniqueDecoding
import Prelude hiding (read)

-- | Reads the machine that a text describes. The regions of errors count the characters of the
-- text from 0.
read :: Text -> Result w Error Machine
read text
  | closed parsed = Result.failing (mistakes parsed) () *> machineFrom text (statements parsed)
  | otherwise = Result [] (mistakes parsed) Nothing
  where
    parsed = Parser.parse text

-- | Reads the statements of a description and checks that each value has a provenance.
machineFrom :: Text -> [Statement] -> Result w Error Machine
machineFrom text ss = marked *> machine
  where
    whole =
      DescriptionSection {sectionName = "the machine", sectionRegion = Region 0 0, entries = ss}
    heading = [s | s <- ss, keyWord s == Just "machine"]
    body = [s | s <- ss, keyWord s /= Just "machine"]
    markOfMachine = case heading of
      s : _ -> mark s
      [] -> Nothing
    -- If the line @machine@ could not be read, it may have had a mark for all values. So missing
    -- marks are not reported then.
    marked =
      Result.failing (if any broken heading then [] else Provenance.unmarked markOfMachine body) ()
    machine =
      assemble (Provenance.describedValues text markOfMachine body)
        <$> required "machine" "machine my-mill \"The mill in hall 3\"" nameFrom whole
        <*> sections whole
        <* allowKeys
          ( Text.words
              "machine tape code arcs frame feeds braking commands limits controller program"
          )
          ["axis"]
          whole

-- | The values of all sections, with the regions that the checks need.
data Sections = Sections
  { locatedTape :: Located Medium,
    locatedCode :: Located TapeCode,
    locatedAxes :: LocatedAxes,
    locatedArcs :: Located Arcs,
    locatedLayout :: LocatedLayout,
    locatedFeeds :: Located FeedFromText.WrittenFeeds,
    locatedBraking :: Located Braking,
    commandContext :: CommandFromText.CommandContext,
    programLimits :: Limits,
    locatedController :: Maybe (Located Controller),
    locatedProgramForm :: Maybe (Located ProgramForm)
  }

assemble :: [DescribedValue] -> (Text, Text) -> Sections -> Machine
assemble values (n, t) s =
  (machineOf s) {name = MachineName n, title = t, describedValues = values}

-- | Reads all sections, and then checks them against each other.
sections :: DescriptionSection -> Result w Error Sections
sections whole =
  ( Sections
      <$> tape
      <*> codeSection
      <*> axesFrom whole
      <*> required "arcs" "arcs none" (located arcsFrom) whole
      <*> required "frame" "frame { … }" (FrameFromText.frame hasService) whole
      <*> required "feeds" "feeds { … }" (located FeedFromText.feeds) whole
      <*> required "braking" "braking { … }" (located FeedFromText.braking) whole
      <*> optional "commands" CommandFromText.noCommands CommandFromText.commands whole
      <*> optional "limits" (Limits Nothing) limitsFrom whole
      <*> optional "controller" Nothing (fmap Just . located ControllerFromText.controller) whole
      <*> optional "program" Nothing (fmap Just . located ProgramFromText.programForm) whole
  )
    >>= crossChecked
  where
    tape = required "tape" "tape { tracks 8 … }" (located tapeFrom) whole
    -- The number of tracks is read by itself. So the code can be checked even if another line of
    -- the section @tape@ contains a mistake.
    trackCount = output (required "tape" "" tracksFrom whole)
    codeSection =
      required "code" "code \"ISO\" { … }" (located (CodeFromText.code trackCount)) whole
    hasService = isJust . serviceTrack . value <$> Result.ifSound codeSection
    located f s = Located (extent s) <$> f s

-- | Checks the sections against each other.
crossChecked :: Sections -> Result w Error Sections
crossChecked s = Result.failing faults s
  where
    machine = machineOf s
    frame = locatedLayout s
    faults =
      concat
        [ Completeness.check
            machine
            (axisContents (locatedAxes s))
            (region (locatedArcs s))
            (region (locatedFeeds s))
            (NonEmpty.toList (locatedItems frame)),
          UniqueDecoding.check
            (value (locatedTape s))
            (region (locatedTape s))
            (value (locatedCode s))
            (locatedItems frame)
            (separatorRegion frame, separator (FrameFromText.layout frame)),
          FeedFromText.checkFeeds (locatedFeeds s) (locatedBraking s) feedCapacity,
          brakedFrameFaults machine (region (locatedBraking s)),
          CommandFromText.check machine (commandContext s),
          concat
            [ ControllerFromText.check machine r c
              | Located r c <- maybeToList (locatedController s)
            ],
          concat
            [ ProgramFromText.check machine r form
              | Located r form <- maybeToList (locatedProgramForm s)
            ]
        ]
    feedCapacity = (\w -> 10 ^ digits (form w) - 1) <$> wordFor machine FeedWord

-- | Checks a machine that brakes in marked frames: the frame must have a hole for the mark, and
-- feeds must be in mm/min. The region is that of the section @braking@.
brakedFrameFaults :: Machine -> Region -> [Error]
brakedFrameFaults machine brakingRegion = case brakingForm (braking machine) of
  ByControl -> []
  SlowFrames -> []
  BrakedFrames _ ->
    [ BadService brakingRegion NoBrakingHole
      | BrakingHole `notElem` concatMap (service . form) (wordsOf machine)
    ]
      <> [BadFrame brakingRegion BrakedFrequencies | feedMeasure (feeds machine) == LeadingAxis]

-- | The machine without its name, its title and its described values.
machineOf :: Sections -> Machine
machineOf s =
  Machine
    { name = MachineName "",
      title = "",
      medium = value (locatedTape s),
      code = value (locatedCode s),
      axes = fmap value (linear (locatedAxes s)),
      rotaryAxes = map value (rotary (locatedAxes s)),
      arcs = value (locatedArcs s),
      layout = FrameFromText.layout (locatedLayout s),
      feeds = FeedFromText.feedsOf (value (locatedFeeds s)),
      braking = value (locatedBraking s),
      commandWords = CommandFromText.allWords (commandContext s),
      limits = programLimits s,
      controller = value <$> locatedController s,
      programForm = value <$> locatedProgramForm s,
      describedValues = []
    }

-- | Reads the name of a machine and its title. The name has letters, digits, points and single
-- minus signs only, so that part programs can write it without quotation marks.
nameFrom :: Statement -> Result w Error (Text, Text)
nameFrom = withArguments ["machine my-mill \"The mill in hall 3\""] heading
  where
    heading args = case map value args of
      [Word n, Quoted t] | isName n -> Just (pure (n, t))
      [Quoted n, Quoted t] | isName n -> Just (pure (n, t))
      _ -> Nothing
    isName n =
      n /= ""
        && Text.all (\c -> isAlphaNum c || c `elem` ("-." :: String)) n
        && not ("--" `Text.isInfixOf` n)

-- | Reads the number of tracks from the section @tape@, and nothing else.
tracksFrom :: Statement -> Result w Error Int
tracksFrom s =
  withBlock [] "" noArguments s >>= required "tracks" "tracks 8" (countFrom "tracks" 1 8) . snd

-- | Reads the section @tape@.
tapeFrom :: Statement -> Result w Error Medium
tapeFrom s = do
  ((), section) <- withBlock ["tape { … }"] "the tape" noArguments s
  Medium
    <$> required "tracks" "tracks 8" (countFrom "tracks" 1 8) section
    <*> required "pitch" "pitch 2.54 mm" pitchFrom section
    <*> optional "width" Nothing widthFrom section
    <*> optional "punch" Nothing punchFrom section
    <*> required "suffix" "suffix \"tape\"" suffixFrom section
    <*> required "leader" "leader 25" (countFrom "leader" 0 mostRows) section
    <*> required "gap" "gap 3" (countFrom "gap" 0 mostRows) section
    <*> optional "even-shift" 0 (countFrom "even-shift" 0 mostRows) section
    <*> required "spare" "spare skipped" spareFrom section
    <*> optional "opening" "" quotedText section
    <*> optional "closing" "" quotedText section
    <* allowKeys
      (Text.words "tracks pitch width punch suffix leader gap even-shift spare opening closing")
      []
      section
  where
    spareFrom = choice [("counted", Counted), ("skipped", Skipped)]
    pitchFrom = withArguments ["pitch 2.54 mm", "pitch none"] onePitch
    onePitch args = case args of
      [Located _ (Word "none")] -> Just (pure Nothing)
      [a, b] -> fmap (Just . Mm) <$> quantityIn "the pitch" "mm" 1000 a b
      _ -> Nothing
    widthFrom = withArguments ["width 25.4 mm"] oneWidth
    oneWidth args = case args of
      [a, b] -> fmap (Just . Mm) <$> quantityIn "the width" "mm" 1000 a b
      _ -> Nothing
    punchFrom = withArguments ["punch 300 rows/min"] oneRate
    oneRate args = case args of
      [a, b] -> fmap Just <$> quantityIn "the speed of the punch" "rows/min" 100000 a b
      _ -> Nothing
    suffixFrom e = do
      t <- quotedText e
      if t /= "" && Text.all (\c -> isAlphaNum c || c `elem` ("-_" :: String)) t
        then pure t
        else malformed ["suffix \"tape\""] e

-- | Largest count of blank rows that a description may give for @leader@, @gap@ or @even-shift@.
mostRows :: Int
mostRows = 10000

-- | Reads a line with the key @word@ and one whole number from @low@ to @high@.
countFrom :: Text -> Int -> Int -> Statement -> Result w Error Int
countFrom word low high = withArguments [word <> " " <> Text.pack (show example)] one
  where
    example = max low (min 5 high)
    one args = case args of
      [a] -> wholeIn ("‘" <> word <> "’") low high a
      _ -> Nothing

-- | All axes of a machine, with their regions.
data LocatedAxes = LocatedAxes
  { linear :: NonEmpty (Located AxisForm),
    rotary :: [Located RotaryForm]
  }

-- | Contents of the words that the axes need, with the regions of the axes.
axisContents :: LocatedAxes -> [Located Content]
axisContents found =
  [Located r (Along (axis f)) | Located r f <- NonEmpty.toList (linear found)]
    <> [Located r (About (rotaryAxis f)) | Located r f <- rotary found]

-- | Reads all axes. Reports a missing axis if there is none of x, y and z, and every repetition of
-- an axis.
axesFrom :: DescriptionSection -> Result w Error LocatedAxes
axesFrom whole = do
  found <- allWith "axis" axisFrom whole
  case NonEmpty.nonEmpty [Located r f | Located r (Left f) <- found] of
    Nothing -> Result.failed missing
    Just linear ->
      Result.failing
        (repetitions found)
        LocatedAxes {linear, rotary = [Located r f | Located r (Right f) <- found]}
  where
    missing =
      Missing (sectionRegion whole) (sectionName whole) "axis" "axis x { pulse 0.01 mm }"
    repetitions found =
      [ Twice r "an axis" first
        | (k, Located r a) <- zip [0 ..] found,
          Located first _ <- take 1 [b | b <- take k found, letter (value b) == letter a]
      ]
    letter = either (axisName . axis) (rotaryName . rotaryAxis)

-- | Reads the section of one axis: x, y and z move along a line, a and b turn.
axisFrom :: Statement -> Result w Error (Located (Either AxisForm RotaryForm))
axisFrom s = do
  (a, section) <-
    withBlock ["axis x { pulse 0.01 mm }", "axis a { pulse 0.001 deg }"] "the axis" axisLetter s
  Located (extent s) <$> case a of
    Left l -> Left <$> linearFrom l section
    Right t -> Right <$> rotaryFrom t section {sectionName = "a rotary axis"}
  where
    axisLetter args = case map value args of
      [Word w] ->
        pure
          <$> lookup
            w
            [("x", Left X), ("y", Left Y), ("z", Left Z), ("a", Right A), ("b", Right B)]
      _ -> Nothing

-- | Reads the properties of the linear axis @a@.
linearFrom :: Axis -> DescriptionSection -> Result w Error AxisForm
linearFrom a section =
  AxisForm a
    <$> required "pulse" "pulse 0.01 mm" pulseFrom section
    <*> optional "direction" False directionFrom section
    <*> optional "lathe" False (choice [("same", False), ("reversed", True)]) section
    <*> optional "moves" True (choice [("yes", True), ("unsure", False)]) section
    <* allowKeys ["pulse", "direction", "lathe", "moves"] [] section
  where
    pulseFrom = withArguments ["pulse 0.01 mm"] onePulse
    onePulse args = case args of
      [_, Located r (Word word)]
        | word /= "mm" -> Just (Result.failed (WrongUnit r LinearAxis (axisName a)))
      [n, unit] -> fmap Mm <$> quantityIn "the pulse" "mm" 1000 n unit
      _ -> Nothing

-- | Reads the properties of the rotary axis @a@.
rotaryFrom :: RotaryAxis -> DescriptionSection -> Result w Error RotaryForm
rotaryFrom a section =
  RotaryForm a
    <$> required "pulse" "pulse 0.001 deg" pulseFrom section
    <*> optional "direction" False directionFrom section
    <* allowKeys ["pulse", "direction"] [] section
  where
    pulseFrom = withArguments ["pulse 0.001 deg"] onePulse
    onePulse args = case args of
      [_, Located r (Word word)]
        | word /= "deg" -> Just (Result.failed (WrongUnit r TurningAxis (rotaryName a)))
      [n, unit] -> fmap Quantity.radians <$> quantityIn "the pulse" "deg" 360 n unit
      _ -> Nothing

-- | Reads the direction of an axis: true if it is reversed.
directionFrom :: Statement -> Result w Error Bool
directionFrom = choice [("forwards", False), ("reversed", True)]

-- | Reads the arcs that a frame can describe.
arcsFrom :: Statement -> Result w Error Arcs
arcsFrom =
  withArguments
    ["arcs none", "arcs quadrant", "arcs any", "arcs any full-circle", "arcs any rising"]
    kind
  where
    kind args = case map value args of
      [Word "none"] -> Just (pure NoArcs)
      Word "quadrant" : more -> arcsOf True more
      Word "any" : more -> arcsOf False more
      _ -> Nothing
    arcsOf quadrants more = case more of
      [] -> given False False
      [Word "full-circle"] -> given True False
      [Word "rising"] -> given False True
      [Word "full-circle", Word "rising"] -> given True True
      _ -> Nothing
      where
        given fullCircle rising = Just (pure Arcs {quadrants, fullCircle, rising})

-- | Reads the section @limits@.
limitsFrom :: Statement -> Result w Error Limits
limitsFrom s = do
  ((), section) <- withBlock ["limits { contours 30 }"] "the limits" noArguments s
  Limits
    <$> optional "contours" Nothing (fmap Just . countFrom "contours" 1 1000000) section
    <* allowKeys ["contours"] [] section
