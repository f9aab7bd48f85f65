-- | Reads the section @frame@ of a description: the layout of a frame. A hole of a word is a hole
-- in the service track of the tape beside one of the word's digits. In this module @hasService@ is
-- true if the code has a service track. It is 'Nothing' if the code cannot be read.
module Machine.FrameFromText
  ( LocatedLayout (..),
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
import Machine.Error (Error (..), FrameFault (..), ServiceFault (..))
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
    RotaryAxis (..),
    Service (..),
    Sign (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Machine.Section
import Machine.Syntax

-- | A layout with the regions of its items and of its separator. If the description gives no
-- separator, 'separatorRegion' is the region of the section @frame@.
data LocatedLayout = LocatedLayout
  { layout :: Layout,
    locatedItems :: NonEmpty (Region, LayoutItem),
    separatorRegion :: Region
  }

-- | Reads the section @frame@. If the code cannot be read (@hasService@ is 'Nothing'), a word may
-- have holes beside its digits.
frame :: Maybe Bool -> Statement -> Result w Error LocatedLayout
frame hasService s = do
  ((), section) <- withBlock ["frame { … }"] "the frame" noArguments s
  (numbers, between, found) <-
    (,,)
      <$> required "numbers" "numbers increments" measureFrom section
      <*> optional "separator" (extent s, "") separatorFrom section
      <*> itemsFrom hasService section
      <* allowKeys ["numbers", "separator"] ["symbols", "word", "check"] section
  case NonEmpty.nonEmpty found of
    Nothing ->
      Result.failed (Missing (extent s) "the frame" "word" "word \"X\" along x { digits 6 }")
    Just some ->
      pure
        LocatedLayout
          { layout = Layout {items = fmap snd some, measure = numbers, separator = snd between},
            locatedItems = some,
            separatorRegion = fst between
          }
  where
    measureFrom = choice [("increments", Increments), ("positions", Positions)]
    separatorFrom e = (extent e,) <$> quotedText e

-- | Reads all items of a frame, in their order: words, literal symbols and check digits.
itemsFrom :: Maybe Bool -> DescriptionSection -> Result w Error [(Region, LayoutItem)]
itemsFrom hasService section = concat <$> traverse item (entries section)
  where
    item e = case keyWord e of
      Just "symbols" -> do
        t <- quotedText e
        if t == "" then malformed ["symbols \"*\""] e else pure [(extent e, Literal t)]
      Just "check" ->
        (\m -> [(extent e, CheckDigit m)]) <$> withArguments ["check modulo 10"] modulus e
      Just "word" -> (\w -> [(extent e, AWord w)]) <$> word hasService e
      _ -> pure []
    modulus args = case args of
      [Located _ (Word "modulo"), n] -> wholeIn "the modulus" 2 10 n
      _ -> Nothing

-- | Reads a line with one text in quotation marks.
quotedText :: Statement -> Result w Error Text
quotedText e = withArguments [keyText e <> " \"…\""] text e
  where
    text args = case args of
      [Located _ (Quoted t)] -> Just (pure t)
      _ -> Nothing

-- | Reads a word of a frame: its address, its content and its form.
word :: Maybe Bool -> Statement -> Result w Error Word'
word hasService e = do
  ((address', found), section) <- withBlock forms "this word" heading e
  case found of
    Just fixed -> wordFrom hasService e address' fixed section <* allowKeys keys [] section
    Nothing -> do
      codes <- motionCodes section <* allowKeys (keys <> motionKeys) [] section
      wordFrom hasService e address' (Motion codes) section
  where
    keys = ["digits", "decimals", "sign", "holes", "when"]
    motionKeys = ["rapid", "straight", "clockwise", "counterclockwise"]
    forms = ["word \"X\" along x { … }", "word along x { … }"]
    heading args = case args of
      Located _ (Quoted a) : rest -> fmap (a,) <$> contentFrom rest
      _ -> fmap ("",) <$> contentFrom args

-- | Reads the content of a word from the arguments of its line; 'Nothing' if they name no content.
-- The output is 'Nothing' for a word that contains the kind of motion. The codes of the kinds are
-- in the block of the word, so they are not yet known.
contentFrom :: [Argument] -> Maybe (Result w Error (Maybe Content))
contentFrom args = case args of
  [Located _ (Word "frame-number")] -> known FrameNumber
  [Located _ (Word "motion")] -> Just (pure Nothing)
  [Located _ (Word "feed")] -> known FeedWord
  [Located _ (Word "along"), Located _ (Word w)]
    | Just a <- linearAxis w -> known (Along a)
    | Just a <- turningAxis w -> known (About a)
  [Located _ (Word "centre"), Located r (Word w)]
    | Just a <- linearAxis w -> known (Centre a)
    | Just _ <- turningAxis w -> Just (Result.failed (BadFrame r (CentreAlong w)))
  [Located _ (Word "command"), Located _ (Word n)] -> known (Command (CommandName n))
  [Located _ (Word "command"), Located _ (Quoted n)] -> known (Command (CommandName n))
  _ -> Nothing
  where
    known = Just . pure . Just
    linearAxis w = lookup w [("x", X), ("y", Y), ("z", Z)]
    turningAxis w = lookup w [("a", A), ("b", B)]

-- | Reads the codes of the kinds of motion from the block of a word.
motionCodes :: DescriptionSection -> Result w Error MotionCodes
motionCodes section =
  MotionCodes
    <$> optional "rapid" Nothing (fmap Just . number) section
    <*> required "straight" "straight 1" number section
    <*> optional "clockwise" Nothing (fmap Just . number) section
    <*> optional "counterclockwise" Nothing (fmap Just . number) section
  where
    number s = withArguments [keyText s <> " 1"] one s
    one args = case args of
      [a] -> wholeIn "the number of a motion" 0 999999999 a
      _ -> Nothing

-- | Reads the block of the word with the address @address'@ and the content @content'@. @e@ is the
-- line of the word.
wordFrom :: Maybe Bool -> Statement -> Text -> Content -> DescriptionSection -> Result w Error Word'
wordFrom hasService e address' content' section = do
  (exactly, n) <- required "digits" "digits 4" digitsFrom section
  (places, givenSign, givenHoles, presence') <-
    (,,,)
      <$> optional "decimals" 0 (decimalsFrom n) section
      <*> optional "sign" Unsigned (withArguments signForms signFrom) section
      <*> optional "holes" Nothing (fmap Just . withArguments holeForms holesFrom) section
      <*> optional "when" Always presenceFrom section
  let withoutHoles = if hasService /= Just False && exactly then replicate n NoHole else []
      holes = fromMaybe withoutHoles givenHoles
      isMinusHoled = MinusHole `elem` holes && givenSign == Unsigned
      form' =
        NumberForm
          { digits = n,
            padded = exactly,
            decimals = places,
            sign = if isMinusHoled then ServiceSign else givenSign,
            service = holes
          }
      made = Word' {address = address', content = content', form = form', presence = presence'}
  Result.failing
    (holeFaults hasService (extent e) (isJust givenHoles) form' <> unsuited (extent e) made)
    made
  where
    signForms = ["sign none", "sign minus", "sign both", "sign priority 5 6 1 2"]
    holeForms =
      [ "holes minus aux:1 aux:0 -",
        "the words are minus, marker, braking, and NAME:0 for a bit of a command"
      ]
    presenceFrom =
      choice
        [ ("always", Always),
          ("moving", InMotion),
          ("needed", WhenNeeded),
          ("changed", WhenChanged)
        ]

-- | Reads the count of digits of a number. The flag is true if the number is always written with
-- this count, and false if the count is a maximum.
digitsFrom :: Statement -> Result w Error (Bool, Int)
digitsFrom = withArguments ["digits 4", "digits at-most 4"] digitCount
  where
    digitCount args = case args of
      [Located _ (Word "at-most"), a] ->
        fmap (False,) <$> wholeIn "the number of digits" 0 mostDigits a
      [a] -> fmap (True,) <$> wholeIn "the number of digits" 0 mostDigits a
      _ -> Nothing

-- | Reads the count of decimals, which may be 0 to @most@. @most@ is the count of all digits of
-- the number.
decimalsFrom :: Int -> Statement -> Result w Error Int
decimalsFrom most = withArguments ["decimals 3"] one
  where
    one args = case args of
      [a] -> wholeIn "the decimals" 0 most a
      _ -> Nothing

-- | Largest count of digits that a description may give to a number. No count of pulses needs as
-- many.
mostDigits :: Int
mostDigits = 15

-- | Reads how the sign of a number is written; 'Nothing' if the arguments do not say this.
signFrom :: [Argument] -> Maybe (Result w Error Sign)
signFrom args = case args of
  [Located _ (Word "none")] -> Just (pure Unsigned)
  [Located _ (Word "minus")] -> Just (pure MinusSign)
  [Located _ (Word "both")] -> Just (pure EitherSign)
  [Located _ (Word "priority"), a, b, c, d] ->
    case traverse (wholeIn "a digit of the priority" 0 9) [a, b, c, d] of
      Just found -> Just (sequenceA found >>= priority)
      Nothing -> Nothing
  _ -> Nothing
  where
    priority ns = case ns of
      [a, b, c, d] -> pure (Priority a b c d)
      _ -> alreadyReported

-- | Reads the meanings of the holes in the service track, one meaning for each digit of a word.
-- 'Nothing' if the arguments are no such meanings.
holesFrom :: [Argument] -> Maybe (Result w Error [Service])
holesFrom args = if null args then Nothing else pure <$> traverse (hole . value) args
  where
    hole a = case a of
      Word "minus" -> Just MinusHole
      Word "marker" -> Just Marker
      Word "braking" -> Just BrakingHole
      Bit name k -> Just (CommandBit (CommandName name) k)
      Dash -> Just NoHole
      _ -> Nothing

-- | Lists the mistakes in the holes beside the digits of a word with the form @f@. @isGiven@ is
-- true if the description of the word gives holes.
holeFaults :: Maybe Bool -> Region -> Bool -> NumberForm -> [Error]
holeFaults hasService r isGiven f
  | not isGiven = []
  | hasService == Just False = [BadService r NoTrack]
  | not (padded f) = [BadService r AnyLength]
  | otherwise =
    [BadService r (WrongCount (length holes) (digits f)) | length holes /= digits f]
      <> [BadService r (SameMeaning "minus") | length (filter (== MinusHole) holes) > 1]
  where
    holes = service f

-- | Kinds of content of a word. They differ in the number forms that they allow.
data ContentKind = AxisOrCentre | CommandNumber | OtherNumber
  deriving stock (Eq)

kindOf :: Content -> ContentKind
kindOf c = case c of
  Along _ -> AxisOrCentre
  About _ -> AxisOrCentre
  Centre _ -> AxisOrCentre
  Command _ -> CommandNumber
  FrameNumber -> OtherNumber
  Motion _ -> OtherNumber
  FeedWord -> OtherNumber

-- | Reports the properties of a word that are impossible for its content; @r@ is its region.
unsuited :: Region -> Word' -> [Error]
unsuited r w =
  map
    (BadFrame r . Unsuited (Machine.contentName (content w)))
    ( catMaybes
        [ unsuitedSign kind (form w),
          unsuitedLength kind (address w) (form w),
          unsuitedDecimals kind (form w),
          unsuitedPresence (content w) (presence w),
          unsuitedPriority kind (form w)
        ]
    )
  where
    kind = kindOf (content w)

unsuitedSign :: ContentKind -> NumberForm -> Maybe Text
unsuitedSign kind f
  | sign f /= Unsigned && kind /= AxisOrCentre = Just "It is never below zero, so it has no sign."
  | MinusHole `elem` service f && sign f /= ServiceSign =
    Just "Its sign is said twice: by a hole and by symbols."
  | otherwise = Nothing

unsuitedLength :: ContentKind -> Text -> NumberForm -> Maybe Text
unsuitedLength kind address' f
  | digits f == 0 && not (kind == CommandNumber && address' /= "") =
    Just "Without digits it says nothing; only a command may be its address alone."
  | otherwise = Nothing

unsuitedDecimals :: ContentKind -> NumberForm -> Maybe Text
unsuitedDecimals kind f
  | decimals f > 0 && kind == OtherNumber = Just "It is a whole number, so it has no decimals."
  | otherwise = Nothing

unsuitedPresence :: Content -> Presence -> Maybe Text
unsuitedPresence content' presence' = case presence' of
  WhenChanged | content' /= FeedWord -> Just "‘when changed’ is for the feed."
  WhenNeeded
    | kind == OtherNumber -> Just "‘when needed’ is for axes, centres and commands."
  InMotion
    | kind == CommandNumber -> Just "A command may be given in a frame that does not move."
  _ -> Nothing
  where
    kind = kindOf content'

unsuitedPriority :: ContentKind -> NumberForm -> Maybe Text
unsuitedPriority kind f = case sign f of
  Priority a b c d
    | kind /= AxisOrCentre -> Just "Only axes and centres have a priority."
    | hasRepetition [a, b, c, d] -> Just "The four digits of the priority are different ones."
  _ -> Nothing
  where
    hasRepetition ns = or [p == q | (k, p) <- zip [0 ..] ns, q <- take k ns]
