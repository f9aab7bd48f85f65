-- | Machines from their descriptions.
--
-- A description is read in three steps: into statements ("Machine.Parser"), section by section into
-- values, and the sections against each other: the words of the frame against axes, code, feeds and
-- commands. Each step reports all that it finds.
module Machine.FromText
  ( read,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.Char (isAlphaNum)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.CodeFromText qualified as CodeFromText
import Machine.CommandFromText qualified as CommandFromText
import Machine.Completeness qualified as Completeness
import Machine.Error (Error (..), FrameMisfit (BrakedFrequencies), ServiceFault (..))
import Machine.FeedFromText qualified as FeedFromText
import Machine.FrameFromText (Placed (separatorSite, sites), quotedText)
import Machine.FrameFromText qualified as FrameFromText
import Machine.Machine hiding (value)
import Machine.Parser (Parsed (..))
import Machine.Parser qualified as Parser
import Machine.Provenance qualified as Provenance
import Machine.Section
import Machine.Syntax (Argument, Argument_ (..), Statement (..), keyWord)
import Machine.UniqueDecoding qualified as UniqueDecoding
import Prelude hiding (read)

-- | The machine that a text describes. Regions are offsets into the text.
read :: Text -> Result w Error Machine
read text
  | closed parsed = Result.failing (mistakes parsed) () *> described text (statements parsed)
  | otherwise = Result [] (mistakes parsed) Nothing
  where
    parsed = Parser.parse text

described :: Text -> [Statement] -> Result w Error Machine
described text ss = marked *> machine
  where
    whole = Section {what = "the machine", place = Region 0 0, entries = ss}
    heading = [s | s <- ss, keyWord s == Just "machine"]
    body = [s | s <- ss, keyWord s /= Just "machine"]
    byHeading = case heading of
      s : _ -> note s
      [] -> Nothing
    -- A line of the machine that cannot be read may have had a mark.
    marked =
      Result.failing (if any broken heading then [] else Provenance.unmarked byHeading body) ()
    machine =
      assemble (Provenance.facts text byHeading body)
        <$> required "machine" "machine my-mill \"The mill in hall 3\"" nameFrom whole
        <*> sections whole
        <* known
          ["machine", "tape", "code", "arcs", "frame", "feeds", "braking", "commands", "limits"]
          ["axis"]
          whole

-- | The sections, each where it stands.
data Sections = Sections
  { tapeOf :: Located Medium,
    codeOf :: Located TapeCode,
    axesOf :: NonEmpty (Located AxisForm),
    arcsOf :: Located Arcs,
    frameOf :: Placed,
    feedsOf :: Located Feeds,
    brakingOf :: Located Braking,
    commandsOf :: CommandFromText.CommandContext,
    limitsOf :: Limits
  }

assemble :: [DescribedValue] -> (Text, Text) -> Sections -> Machine
assemble fs (n, t) s = (machineOf s) {name = MachineName n, title = t, facts = fs}

-- | The sections, each by itself and then all together. What one lacks does not hide what is wrong
-- in another.
sections :: Section -> Result w Error Sections
sections whole =
  ( Sections
      <$> tape
        <*> coded
        <*> axes'
        <*> arcs'
        <*> framed
        <*> feeds'
        <*> braking'
        <*> commands'
        <*> limits'
  )
    >>= together
  where
    tape = required "tape" "tape { tracks 8 … }" (located tapeFrom) whole
    -- Known even where something else of the tape is wrong.
    tracks' = output (required "tape" "" tracksFrom whole)
    coded = required "code" "code \"ISO\" { … }" (located (CodeFromText.code tracks')) whole
    axes' = axesFrom whole
    arcs' = required "arcs" "arcs none" (located arcsFrom) whole
    framed = required "frame" "frame { … }" (FrameFromText.frame hasService) whole
    hasService = isJust . serviceTrack . value <$> Result.settled coded
    feeds' = required "feeds" "feeds { … }" (located FeedFromText.feeds) whole
    braking' = required "braking" "braking { … }" (located FeedFromText.braking) whole
    commands' =
      optional
        "commands"
        (CommandFromText.CommandContext noOrders [])
        CommandFromText.commands
        whole
    limits' = optional "limits" (Limits Nothing) limitsFrom whole
    located f s = Located (told s) <$> f s

-- | What the sections ask of one another.
together :: Sections -> Result w Error Sections
together s = Result.failing faults s
  where
    machine = machineOf s
    faults =
      concat
        [ Completeness.check
            machine
            (NonEmpty.toList (axesOf s))
            (region (arcsOf s))
            (region (feedsOf s))
            (NonEmpty.toList (sites (frameOf s))),
          UniqueDecoding.check
            (value (tapeOf s))
            (region (tapeOf s))
            (value (codeOf s))
            (sites (frameOf s))
            (separatorSite (frameOf s), separator (FrameFromText.layout (frameOf s))),
          FeedFromText.checkFeeds (feedsOf s) (brakingOf s) feedDigits,
          [ BadService (region (brakingOf s)) NoBrakingHole
            | BrakingHole `notElem` concatMap (service . form) (wordsOf machine),
              BrakedFrames _ <- [brakingForm (value (brakingOf s))]
          ],
          [ Unfit (region (brakingOf s)) BrakedFrequencies
            | LeadingAxis <- [feedMeasure (feeds machine)],
              BrakedFrames _ <- [brakingForm (value (brakingOf s))]
          ],
          CommandFromText.check machine (commandsOf s)
        ]
    feedDigits = (\w -> 10 ^ digits (form w) - 1) <$> wordFor machine FeedWord

machineOf :: Sections -> Machine
machineOf s =
  Machine
    { name = MachineName "",
      title = "",
      medium = value (tapeOf s),
      code = value (codeOf s),
      axes = fmap value (axesOf s),
      arcs = value (arcsOf s),
      layout = FrameFromText.layout (frameOf s),
      feeds = value (feedsOf s),
      braking = value (brakingOf s),
      orders = CommandFromText.orders (commandsOf s),
      limits = limitsOf s,
      facts = []
    }

-- | The name by which a program chooses the machine, and what it is.
nameFrom :: Statement -> Result w Error (Text, Text)
nameFrom = plain ["machine my-mill \"The mill in hall 3\""] heading
  where
    heading args = case map value args of
      [Word n, Quoted t] | isName n -> Just (pure (n, t))
      [Quoted n, Quoted t] | isName n -> Just (pure (n, t))
      _ -> Nothing
    -- As a program writes it.
    isName n =
      n /= ""
        && Text.all (\c -> isAlphaNum c || c `elem` ("-." :: String)) n
        && not ("--" `Text.isInfixOf` n)

tracksFrom :: Statement -> Result w Error Int
tracksFrom s = opened [] "" none s >>= required "tracks" "tracks 8" (count "tracks" 1 8) . snd

tapeFrom :: Statement -> Result w Error Medium
tapeFrom s = do
  ((), section) <- opened ["tape { … }"] "the tape" none s
  Medium
    <$> required "tracks" "tracks 8" (count "tracks" 1 8) section
    <*> required "pitch" "pitch 2.54 mm" (plain ["pitch 2.54 mm", "pitch none"] pitchFrom) section
    <*> required "suffix" "suffix \"tape\"" suffixFrom section
    <*> required "leader" "leader 25" (count "leader" 0 mostRows) section
    <*> required "gap" "gap 3" (count "gap" 0 mostRows) section
    <*> optional "even-shift" 0 (count "even-shift" 0 mostRows) section
    <*> required
      "spare"
      "spare skipped"
      (choice [("counted", Counted), ("skipped", Skipped)])
      section
    <*> optional "opening" "" quotedText section
    <*> optional "closing" "" quotedText section
    <* known
      ["tracks", "pitch", "suffix", "leader", "gap", "even-shift", "spare", "opening", "closing"]
      []
      section
  where
    pitchFrom args = case args of
      [Located _ (Word "none")] -> Just (pure Nothing)
      [a, b] -> fmap (Just . Mm) <$> amountIn "the pitch" "mm" 1000 a b
      _ -> Nothing
    suffixFrom e = do
      t <- quotedText e
      if t /= "" && Text.all (\c -> isAlphaNum c || c `elem` ("-_" :: String)) t
        then pure t
        else malformed ["suffix \"tape\""] e

-- | Blank rows in a row.
mostRows :: Int
mostRows = 10000

-- | A line with a whole number.
count :: Text -> Int -> Int -> Statement -> Result w Error Int
count word low high = plain [word <> " " <> Text.pack (show (max low (min 5 high)))] one
  where
    one args = case args of
      [a] -> wholeIn ("‘" <> word <> "’") low high a
      _ -> Nothing

none :: [Argument] -> Maybe (Result w Error ())
none args = if null args then Just (pure ()) else Nothing

-- | At least one axis, each once.
axesFrom :: Section -> Result w Error (NonEmpty (Located AxisForm))
axesFrom whole = do
  found <- every "axis" axisFrom whole
  case NonEmpty.nonEmpty found of
    Nothing -> Result.failed (Missing (place whole) (what whole) "axis" "axis x { pulse 0.01 mm }")
    Just some -> Result.failing (twice found) some
  where
    twice found =
      [ Twice r "an axis" first
        | (k, Located r a) <- zip [0 ..] found,
          Located first _ <- take 1 [b | b <- take k found, axis (value b) == axis a]
      ]

axisFrom :: Statement -> Result w Error (Located AxisForm)
axisFrom s = do
  (a, section) <- opened ["axis x { pulse 0.01 mm }"] "the axis" axisName s
  form' <-
    AxisForm a
      <$> required "pulse" "pulse 0.01 mm" (plain ["pulse 0.01 mm"] pulseFrom) section
      <*> optional "direction" False (choice [("forwards", False), ("reversed", True)]) section
      <*> optional "lathe" False (choice [("same", False), ("reversed", True)]) section
      <*> optional "moves" True (choice [("yes", True), ("unsure", False)]) section
      <* known ["pulse", "direction", "lathe", "moves"] [] section
  pure (Located (told s) form')
  where
    axisName args = case map value args of
      [Word w] -> pure <$> lookup w [("x", X), ("y", Y), ("z", Z)]
      _ -> Nothing
    pulseFrom args = case args of
      [a, b] -> fmap Mm <$> amountIn "the pulse" "mm" 1000 a b
      _ -> Nothing

arcsFrom :: Statement -> Result w Error Arcs
arcsFrom = plain ["arcs none", "arcs quadrant", "arcs any", "arcs any full-circle"] extent
  where
    extent args = case map value args of
      [Word "none"] -> Just (pure NoArcs)
      [Word "quadrant"] -> Just (pure (Arcs True False))
      [Word "quadrant", Word "full-circle"] -> Just (pure (Arcs True True))
      [Word "any"] -> Just (pure (Arcs False False))
      [Word "any", Word "full-circle"] -> Just (pure (Arcs False True))
      _ -> Nothing

limitsFrom :: Statement -> Result w Error Limits
limitsFrom s = do
  ((), section) <- opened ["limits { contours 30 }"] "the limits" none s
  Limits
    <$> optional "contours" Nothing (fmap Just . count "contours" 1 1000000) section
      <* known ["contours"] [] section
