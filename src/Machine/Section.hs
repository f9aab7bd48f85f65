-- | Access to the statements of a section by their keys, and to the arguments of a statement. A
-- statement is one line of a description, together with the block in braces that may follow it.
-- The key is the word, number or text with which the line begins.
--
-- A function that reads arguments returns 'Nothing' if they do not have the form that it accepts.
-- It returns a failed result if they have that form but contain a mistake.
module Machine.Section
  ( DescriptionSection (..),

    -- * Keys
    allowKeys,
    required,
    optional,
    allWith,

    -- * Lines
    withArguments,
    withBlock,
    noArguments,
    malformed,
    keyText,

    -- * Failures
    attempt,
    alreadyReported,

    -- * Numbers and words
    wholeIn,
    quantityIn,
    choice,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name qualified as Name
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Error (Error (..))
import Machine.Syntax

-- | The statements of a block, or of the whole file.
data DescriptionSection = DescriptionSection
  { -- | name in reports, such as @the tape@
    sectionName :: Text,
    -- | region of the report if a key is missing
    sectionRegion :: Region,
    entries :: [Statement]
  }

-- Keys --------------------------------------------------------------------------------------------

-- | Reports every key of the section that is in neither @once@ nor @often@, and every repetition
-- of a key in @once@. The keys in @often@ may be repeated.
allowKeys :: [Text] -> [Text] -> DescriptionSection -> Result w Error ()
allowKeys once often section = Result.failing (concat (zipWith fault [0 ..] (entries section))) ()
  where
    fault k s = case keyWord s of
      Just w
        | w `elem` often -> []
        | w `elem` once ->
          [ Twice (region (key s)) (quoted w) (region (key first))
            | first <- take 1 (statementsWith w (take k (entries section)))
          ]
      _ -> [UnknownKey (region (key s)) (keyText s) (sectionName section) (once <> often)]
    quoted w = "‘" <> w <> "’"

-- | Reads the first statement with the key @word@ by @f@. If the key is missing, the report shows
-- @example@. No report is made if the section has a key that looks like @word@ misspelt, because
-- 'allowKeys' reports that key as unknown.
required ::
  Text ->
  Text ->
  (Statement -> Result w Error a) ->
  DescriptionSection ->
  Result w Error a
required word example f section = case statementsWith word (entries section) of
  s : _ -> f s
  []
    | any isMisspelling (entries section) -> alreadyReported
    | otherwise ->
      Result.failed (Missing (sectionRegion section) (sectionName section) word example)
  where
    isMisspelling s = case keyWord s of
      Just w -> not (null (Name.nearest w [word] <> Name.lookAlike w [word]))
      Nothing -> False

-- | Reads the first statement with the key @word@ by @f@. Without such a statement, the result is
-- @absent@.
optional :: Text -> a -> (Statement -> Result w Error a) -> DescriptionSection -> Result w Error a
optional word absent f section = case statementsWith word (entries section) of
  s : _ -> f s
  [] -> pure absent

-- | Reads all statements with the key @word@ by @f@.
allWith :: Text -> (Statement -> Result w Error a) -> DescriptionSection -> Result w Error [a]
allWith word f section = traverse f (statementsWith word (entries section))

statementsWith :: Text -> [Statement] -> [Statement]
statementsWith word ss = [s | s <- ss, keyWord s == Just word]

-- Lines -------------------------------------------------------------------------------------------

-- | Reads the arguments of a line by @f@. The line must have neither a formula nor a block. The
-- report of a malformed line lists @forms@, the forms that are allowed.
withArguments ::
  [Text] -> ([Argument] -> Maybe (Result w Error a)) -> Statement -> Result w Error a
withArguments forms f s
  | broken s = alreadyReported
  | Just r <- f (arguments s), Nothing <- formula s, Nothing <- block s = r
  | otherwise = malformed forms s

-- | Reads a line with a block: the value that @f@ makes of its arguments, and the block as a
-- section with the name @title@. The report of a malformed line lists @forms@.
withBlock ::
  [Text] ->
  Text ->
  ([Argument] -> Maybe (Result w Error a)) ->
  Statement ->
  Result w Error (a, DescriptionSection)
withBlock forms title f s = case block s of
  _ | broken s -> alreadyReported
  Just ss
    | Just r <- f (arguments s),
      Nothing <- formula s ->
      (,DescriptionSection {sectionName = title, sectionRegion = extent s, entries = ss}) <$> r
  _ -> malformed forms s

-- | Reads the arguments of a line that must have none; 'Nothing' if there is one.
noArguments :: [Argument] -> Maybe (Result w Error ())
noArguments args = if null args then Just (pure ()) else Nothing

-- | Reports a line that has none of the allowed forms, which the report lists.
malformed :: [Text] -> Statement -> Result w Error a
malformed forms s = Result.failed (Malformed (extent s) (keyText s) forms)

-- | The key of a line as a report shows it.
keyText :: Statement -> Text
keyText s = case value (key s) of
  Word w -> w
  Quoted t -> t
  Number t _ -> t
  Range a b -> Decimal.whole a <> ".." <> Decimal.whole b
  Bit name k -> name <> ":" <> Decimal.whole k
  Dash -> "-"

-- Failures ----------------------------------------------------------------------------------------

-- | Makes a result that always has an output: 'Nothing' if @r@ has none. So the reader continues
-- after a failed result. The errors of @r@ are kept.
attempt :: Result w e a -> Result w e (Maybe a)
attempt r = r {output = Just (output r)}

-- | A failure without an error, for a mistake that is reported already.
alreadyReported :: Result w e a
alreadyReported = Result [] [] Nothing

-- Numbers and words -------------------------------------------------------------------------------

-- | Reads a whole number from @low@ to @high@. In the report of a number out of range, @name@ says
-- what the number is. 'Nothing' if the argument is no whole number.
wholeIn :: Text -> Int -> Int -> Argument -> Maybe (Result w Error Int)
wholeIn name low high a = case value a of
  Number t v
    | Text.any (== '.') t -> Nothing
    | v < fromIntegral low || v > fromIntegral high ->
      Just (Result.failed (OutOfRange (region a) name (Decimal.whole low) (Decimal.whole high)))
    | otherwise -> Just (pure (round v))
  _ -> Nothing

-- | Reads a number, from 'leastQuantity' to @high@, and the unit after it, which has to be @unit@.
-- In the report of a number out of range, @name@ says what the number is. 'Nothing' if the two
-- arguments are no number with this unit.
quantityIn :: Text -> Text -> Double -> Argument -> Argument -> Maybe (Result w Error Double)
quantityIn name unit high a b = case (value a, value b) of
  (Number _ v, Word u)
    | u /= unit -> Nothing
    | v < leastQuantity || v > high ->
      Just (Result.failed (OutOfRange (region a) name lowText (Decimal.exact high)))
    | otherwise -> Just (pure v)
  _ -> Nothing
  where
    lowText = Decimal.exact leastQuantity

-- | Lower limit of every number that 'quantityIn' reads, in the unit of the number.
leastQuantity :: Double
leastQuantity = 0.000001

-- | Reads a line whose only argument is a word of @table@, and gives the value of this word.
choice :: [(Text, a)] -> Statement -> Result w Error a
choice table s = withArguments [keyText s <> " " <> w | (w, _) <- table] one s
  where
    one args = case map value args of
      [Word w] -> pure <$> lookup w table
      _ -> Nothing
