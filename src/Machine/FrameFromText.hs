-- | The section @frame@ of a description: the words of a frame in order.
module Machine.FrameFromText
  ( Placed (..),
    frame,
    quotedText,
  )
where

import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes, fromMaybe, isJust)
import Data.Text (Text)
import Machine.Error (Error (..), FrameMisfit (..), ServiceFault (..))
import Machine.Machine
  ( Axis (..),
    AxisMeasure (..),
    CommandName (..),
    Content (..),
    Layout (..),
    LayoutItem (..),
    MotionCodes (..),
    NumberForm (..),
    Presence (..),
    Service (..),
    Sign (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Machine.Section
import Machine.Syntax

-- | The layout, and where its items and its separator stand.
data Placed = Placed
  { layout :: Layout,
    sites :: NonEmpty (Region, LayoutItem),
    separatorSite :: Region
  }

-- | The layout, for a code with or without a service track; where the code cannot be read, holes
-- are taken as they are.
frame :: Maybe Bool -> Statement -> Result w Error Placed
frame service s = do
  ((), section) <-
    opened ["frame { … }"] "the frame" (\args -> if null args then Just (pure ()) else Nothing) s
  (numbers, between, found) <-
    (,,)
      <$> required
        "numbers"
        "numbers increments"
        (choice [("increments", Increments), ("positions", Positions)])
        section
      <*> optional "separator" (told s, "") (\e -> (told e,) <$> quotedText e) section
      <*> itemsFrom service section
      <* known ["numbers", "separator"] ["symbols", "word", "check"] section
  case NonEmpty.nonEmpty found of
    Nothing -> Result.failed (Missing (told s) "the frame" "word" "word \"X\" along x { digits 6 }")
    Just some ->
      pure
        Placed
          { layout = Layout {items = fmap snd some, measure = numbers, separator = snd between},
            sites = some,
            separatorSite = fst between
          }

itemsFrom :: Maybe Bool -> Section -> Result w Error [(Region, LayoutItem)]
itemsFrom service section = concat <$> traverse item (entries section)
  where
    item e = case keyWord e of
      Just "symbols" ->
        quotedText e >>= \t ->
          if t == "" then malformed ["symbols \"*\""] e else pure [(told e, Literal t)]
      Just "check" -> (\m -> [(told e, CheckDigit m)]) <$> plain ["check modulo 10"] modulus e
      Just "word" -> (\w -> [(told e, AWord w)]) <$> word service e
      _ -> pure []
    modulus args = case args of
      [Located _ (Word "modulo"), n] -> wholeIn "the modulus" 2 10 n
      _ -> Nothing

-- | A line with one text between quotation marks.
quotedText :: Statement -> Result w Error Text
quotedText e = plain [keyText e <> " \"…\""] text e
  where
    text args = case args of
      [Located _ (Quoted t)] -> Just (pure t)
      _ -> Nothing

-- | A word of a frame: an address, what it holds, and how.
word :: Maybe Bool -> Statement -> Result w Error Word'
word service e = do
  ((address', kind), section) <- opened forms "this word" headed e
  case kind of
    Just fixed -> described address' fixed section <* known common [] section
    Nothing -> do
      codes <-
        motionCodes section
          <* known (common <> ["rapid", "straight", "clockwise", "counterclockwise"]) [] section
      described address' (Motion codes) section
  where
    common = ["digits", "decimals", "sign", "holes", "when"]
    forms = ["word \"X\" along x { … }", "word along x { … }"]
    described = wordFrom service e
    headed args = case args of
      Located _ (Quoted a) : rest -> (\c -> pure (a, c)) <$> contentFrom rest
      _ -> (\c -> pure ("", c)) <$> contentFrom args

-- | What a word holds; nothing for a kind of motion, whose numbers stand in its block.
contentFrom :: [Argument] -> Maybe (Maybe Content)
contentFrom args = case map value args of
  [Word "frame-number"] -> Just (Just FrameNumber)
  [Word "motion"] -> Just Nothing
  [Word "feed"] -> Just (Just FeedWord)
  [Word "along", Word a] -> Just . Along <$> axisNamed a
  [Word "centre", Word a] -> Just . Centre <$> axisNamed a
  [Word "command", Word n] -> Just (Just (Command (CommandName n)))
  [Word "command", Quoted n] -> Just (Just (Command (CommandName n)))
  _ -> Nothing

axisNamed :: Text -> Maybe Axis
axisNamed a = lookup a [("x", X), ("y", Y), ("z", Z)]

motionCodes :: Section -> Result w Error MotionCodes
motionCodes section =
  MotionCodes
    <$> optional "rapid" Nothing (fmap Just . number) section
    <*> required "straight" "straight 1" number section
    <*> optional "clockwise" Nothing (fmap Just . number) section
    <*> optional "counterclockwise" Nothing (fmap Just . number) section
  where
    number s = plain [keyText s <> " 1"] one s
    one args = case args of
      [a] -> wholeIn "the number of a motion" 0 999999999 a
      _ -> Nothing

wordFrom :: Maybe Bool -> Statement -> Text -> Content -> Section -> Result w Error Word'
wordFrom service e address' holds section = do
  (exactly, n) <-
    required "digits" "digits 4" (plain ["digits 4", "digits at-most 4"] digitCount) section
  (places, given, named, stands) <-
    (,,,)
      <$> optional "decimals" 0 (plain ["decimals 3"] (one "the decimals" n)) section
      <*> optional
        "sign"
        Unsigned
        (plain ["sign none", "sign minus", "sign both", "sign priority 5 6 1 2"] signFrom)
        section
      <*> optional
        "holes"
        Nothing
        ( fmap Just
            . plain
              [ "holes minus aux:1 aux:0 -",
                "the words are minus, marker, braking, and NAME:0 for a bit of a command"
              ]
              holesFrom
        )
        section
      <*> optional
        "when"
        Always
        ( choice
            [ ("always", Always),
              ("moving", InMotion),
              ("needed", WhenNeeded),
              ("changed", WhenChanged)
            ]
        )
        section
  let holes = fromMaybe (if service /= Just False && exactly then replicate n NoHole else []) named
      form' =
        NumberForm
          { digits = n,
            padded = exactly,
            decimals = places,
            sign = if MinusHole `elem` holes && given == Unsigned then ServiceSign else given,
            service = holes
          }
      faults =
        holeFaults service (told e) (isJust named) form'
          <> suits (told e) holds address' form' stands
  Result.failing faults Word' {address = address', content = holds, form = form', presence = stands}
  where
    digitCount args = case args of
      [Located _ (Word "at-most"), a] ->
        fmap (False,) <$> wholeIn "the number of digits" 0 mostDigits a
      [a] -> fmap (True,) <$> wholeIn "the number of digits" 0 mostDigits a
      _ -> Nothing
    one what most args = case args of
      [a] -> wholeIn what 0 most a
      _ -> Nothing

-- | More digits are more than pulses can be.
mostDigits :: Int
mostDigits = 15

signFrom :: [Argument] -> Maybe (Result w Error Sign)
signFrom args = case args of
  [Located _ (Word "none")] -> Just (pure Unsigned)
  [Located _ (Word "minus")] -> Just (pure MinusSign)
  [Located _ (Word "both")] -> Just (pure EitherSign)
  [Located _ (Word "priority"), a, b, c, d] ->
    case traverse (wholeIn "a digit of the priority" 0 9) [a, b, c, d] of
      Just found -> Just (sequenceA found >>= four)
      Nothing -> Nothing
  _ -> Nothing
  where
    four ns = case ns of
      [a, b, c, d] -> pure (Priority a b c d)
      _ -> Result [] [] Nothing

holesFrom :: [Argument] -> Maybe (Result w Error [Service])
holesFrom args = if null args then Nothing else pure <$> traverse (hole . value) args
  where
    hole a = case a of
      Word "minus" -> Just MinusHole
      Word "marker" -> Just Marker
      Word "braking" -> Just BrakingHole
      Bit name k -> Just (OrderBit (CommandName name) k)
      Dash -> Just NoHole
      _ -> Nothing

-- | What is wrong with the holes beside the digits.
holeFaults :: Maybe Bool -> Region -> Bool -> NumberForm -> [Error]
holeFaults service' r named f
  | not named = []
  | service' == Just False = [BadService r NoTrack]
  | not (padded f) = [BadService r AnyLength]
  | otherwise =
    [BadService r (WrongCount (length holes) (digits f)) | length holes /= digits f]
      <> [BadService r (SameMeaning "minus") | length (filter (== MinusHole) holes) > 1]
  where
    holes = service f

-- | Whether a word can be so with what it holds.
suits :: Region -> Content -> Text -> NumberForm -> Presence -> [Error]
suits r holds address' f stands =
  map
    (Unfit r . Unsuited (Machine.contentWord holds))
    (catMaybes [signs, empty, points, standing, ways])
  where
    signed = sign f /= Unsigned
    along = case holds of
      Along _ -> True
      _ -> False
    centred = case holds of
      Centre _ -> True
      _ -> False
    commands = case holds of
      Command _ -> True
      _ -> False
    signs
      | signed && not (along || centred) = Just "It is never below zero, so it has no sign."
      | MinusHole `elem` service f && sign f /= ServiceSign =
        Just "Its sign is said twice: by a hole and by symbols."
      | otherwise = Nothing
    empty
      | digits f == 0 && not (commands && address' /= "") =
        Just "Without digits it says nothing; only a command may be its address alone."
      | otherwise = Nothing
    points
      | decimals f > 0 && not (along || centred || commands) =
        Just "It is a whole number, so it has no decimals."
      | otherwise = Nothing
    ways = case sign f of
      Priority a b c d
        | not (along || centred) -> Just "Only axes and centres have a priority."
        | or [p == q | (k, p) <- zip [0 ..] four, q <- take k four] ->
          Just "The four digits of the priority are different ones."
        where
          four = [a, b, c, d]
      _ -> Nothing
    standing = case stands of
      WhenChanged | holds /= FeedWord -> Just "‘when changed’ is for the feed."
      WhenNeeded
        | not (along || centred || commands) ->
          Just "‘when needed’ is for axes, centres and commands."
      InMotion | commands -> Just "A command may be given in a frame that does not move."
      _ -> Nothing
