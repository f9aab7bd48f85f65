-- | Reads the sections @feeds@ and @braking@ of a description, and tables of codes. A code is a
-- number on the tape that means a feed or a step of the spindle; a table gives its value, perhaps
-- by a formula.
module Machine.FeedFromText
  ( WrittenFeeds (..),
    feeds,
    braking,
    table,
    checkFeeds,
  )
where

import Base.Quantity (Feed (..))
import Base.Region (Located (..), Region)
import Base.Result (Result)
import Base.Result qualified as Result
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes, fromMaybe, listToMaybe)
import Data.Text qualified as Text
import Machine.Error (Error (..), TableFault (..))
import Machine.Machine
  ( Braking (..),
    BrakingForm (..),
    FeedCode (..),
    FeedCodes (..),
    FeedMeasure (..),
    Feeds (..),
    RapidCode (..),
    Rule (..),
    TurnFeeds (..),
  )
import Machine.Machine qualified as Machine
import Machine.Section
import Machine.Syntax

-- | Reads the lines of a table of codes with their values, which are feeds or spindle speeds.
-- Examples of lines are @1 = 15@ and @0..40 = 10 * 10^(n/20)@. Each line gives the values of a
-- code or of a range of codes, as a formula in the code @n@. A value must be above 0 and below
-- 10^9.
table :: DescriptionSection -> Result w Error (Map Int Double)
table section = do
  given <- concat . catMaybes <$> traverse (attempt . tableLine) (entries section)
  let values = Map.fromListWith (\_ first -> first) [(n, v) | (n, _, v) <- given]
  Result.failing
    (repetitions given <> [BadTable (sectionRegion section) EmptyTable | null (entries section)])
    values

-- | Reads one line of a table: each code with the region of the line's key and the code's value.
tableLine :: Statement -> Result w Error [(Int, Region, Double)]
tableLine e = case (codesOf e, formula e) of
  _ | broken e -> alreadyReported
  (Just (a, b), Just located)
    | null (arguments e),
      Nothing <- block e ->
      rangeFrom keyRegion a b >>= traverse (entry located)
  _ -> malformed ["1 = 15", "0..40 = 10 * 10^(n/20)"] e
  where
    keyRegion = region (key e)
    rangeFrom r a b =
      if a > b || b - a >= longestRange
        then Result.failed (BadTable r (BadRange a b))
        else pure [a .. b]
    entry (Located formulaRegion f) n =
      let v = evaluate (fromIntegral n) f
       in if v > 0 && v < 1e9
            then pure (n, keyRegion, v)
            else Result.failed (BadTable formulaRegion (NoValue n))

-- | First and last code of a line of a table; 'Nothing' if the key is no code or range of codes.
codesOf :: Statement -> Maybe (Int, Int)
codesOf e = case value (key e) of
  Number t v | Text.all (/= '.') t && v < 1e9 -> Just (round v, round v)
  Range a b -> Just (a, b)
  _ -> Nothing

-- | Reports codes that an earlier line contains too. Successive codes of one line that repeat the
-- same earlier line have one report.
repetitions :: [(Int, Region, Double)] -> [Error]
repetitions given =
  withoutRuns
    [Twice r "a code" first | (n, r, _) <- given, Just first <- [Map.lookup n firsts], first /= r]
  where
    firsts = Map.fromListWith (\_ first -> first) [(n, r) | (n, r, _) <- given]
    withoutRuns es = case es of
      e : rest -> e : withoutRuns (dropWhile (== e) rest)
      [] -> []

-- | Largest count of codes that one line of a table may contain.
longestRange :: Int
longestRange = 10000

-- | The feeds of a description, and the codes at the ends of the lines of their table, with the
-- regions of these codes.
data WrittenFeeds = WrittenFeeds {feedsOf :: Feeds, lastCodes :: [Located Int]}

-- | Reads the section @feeds@.
feeds :: Statement -> Result w Error WrittenFeeds
feeds s = do
  ((), section) <- withBlock ["feeds { … }"] "the feeds" noArguments s
  (`WrittenFeeds` lastCodesIn section) <$> feedsIn section

-- | The codes at the ends of the lines of the table in the section @feeds@.
lastCodesIn :: DescriptionSection -> [Located Int]
lastCodesIn section =
  [ Located (region (key line)) code
    | s <- entries section,
      keyWord s == Just "table",
      line <- concat (block s),
      Just (_, code) <- [codesOf line]
  ]

-- | Reads the lines of the section @feeds@.
feedsIn :: DescriptionSection -> Result w Error Feeds
feedsIn section =
  Feeds
    <$> required "measure" "measure mm/min" measureFrom section
    <*> codesFrom section
    <*> pure 1
    <*> required "rule" "rule nearest" ruleFrom section
    <*> required "rapid" "rapid highest" rapidFrom section
    <*> optional "per-turn" Nothing (fmap Just . turnFeedsFrom) section
    <* allowKeys ["measure", "table", "direct", "rule", "rapid", "per-turn"] [] section
  where
    measureFrom = choice [("mm/min", AlongPath), ("Hz", LeadingAxis)]
    ruleFrom = choice [("not-above", NotAbove), ("nearest", Nearest)]
    rapidFrom = withArguments ["rapid highest", "rapid code 9"] rapidCode
    rapidCode args = case args of
      [Located _ (Word "highest")] -> Just (pure Highest)
      [Located _ (Word "code"), n] -> fmap (ByCode . FeedCode) <$> wholeIn "the code" 0 999999999 n
      _ -> Nothing

-- | Reads the feeds for one turn of the spindle: the step, and the range of the counts of steps.
turnFeedsFrom :: Statement -> Result w Error TurnFeeds
turnFeedsFrom = withArguments ["per-turn 0.001 mm/rev 1..20000"] form
  where
    form args = case args of
      [Located _ (Number _ step), Located _ (Word "mm/rev"), Located r (Range a b)]
        | a < 1 || b < a -> Just (Result.failed (BadTable r (BadRange a b)))
        | any (isStep step) [0 .. 6] -> Just (pure (TurnFeeds step a b))
      _ -> Nothing
    isStep step d = abs (step * 10 ^ (d :: Int) - 1) < 1.0e-9

-- | Reads the feed codes: either a table, or a range of codes that are their own values.
codesFrom :: DescriptionSection -> Result w Error FeedCodes
codesFrom section =
  case ( [s | s <- entries section, keyWord s == Just "table"],
         [s | s <- entries section, keyWord s == Just "direct"]
       ) of
    (t : _, d : _) -> Result.failed (Twice (extent d) "the codes of the feeds" (extent t))
    (_, []) ->
      Listed . Map.mapKeysMonotonic FeedCode
        <$> required "table" "table { 1 = 15 … }, or: direct 1..999" listed section
    ([], d : _) -> withArguments ["direct 1..999"] direct d
  where
    listed t = withBlock ["table { 1 = 15 … }"] "the table of feeds" noArguments t >>= table . snd
    direct args = case args of
      [Located r (Range a b)]
        | a < 1 || b < a -> Just (Result.failed (BadTable r (BadRange a b)))
        | otherwise -> Just (pure (Direct a b))
      _ -> Nothing

-- | Reads the section @braking@.
braking :: Statement -> Result w Error Braking
braking s = do
  ((), section) <- withBlock ["braking { … }"] "the braking" noArguments s
  Braking
    <$> required "deceleration" "deceleration 5 mm/s2" decelerationFrom section
    <*> required "by" "by control" formFrom section
    <* allowKeys ["deceleration", "by"] [] section
  where
    decelerationFrom = withArguments ["deceleration 5 mm/s2"] oneDeceleration
    oneDeceleration args = case args of
      [a, b] -> quantityIn "the deceleration" "mm/s2" 1000000 a b
      _ -> Nothing
    formFrom = withArguments ["by control", "by slow-frames", "by braked-frames 10 mm/min"] oneForm
    oneForm args = case args of
      [Located _ (Word "control")] -> Just (pure ByControl)
      [Located _ (Word "slow-frames")] -> Just (pure SlowFrames)
      [Located _ (Word "braked-frames"), a, b] ->
        fmap (BrakedFrames . Feed) <$> quantityIn "the feed" "mm/min" 1e9 a b
      _ -> Nothing

-- | Checks that the code of rapid moves is a feed code, that the feed word can hold the largest
-- code, and that the machine has the feed at the end of braking. @wordCapacity@ is the largest
-- code that the feed word can hold; 'Nothing' if frames have no feed word.
checkFeeds :: Located WrittenFeeds -> Located Braking -> Maybe Int -> [Error]
checkFeeds (Located feedsRegion written) (Located brakingRegion b) wordCapacity =
  rapidFaults <> capacityFaults <> brakingFaults
  where
    WrittenFeeds {feedsOf = f, lastCodes} = written
    rapidFaults =
      [BadTable feedsRegion (NoSuchCode n) | ByCode (FeedCode n) <- [rapidFeed f], not (isCode n)]
    isCode n = case codes f of
      Listed t -> Map.member (FeedCode n) t
      Direct a z -> a <= n && n <= z
    highest = case codes f of
      Listed t -> maybe 0 (Machine.codeNumber . fst) (Map.lookupMax t)
      Direct _ z -> z
    capacityFaults =
      [ BadTable tooLarge (CodeTooLarge highest most)
        | Just most <- [wordCapacity],
          highest > most,
          let found = [r | Located r n <- lastCodes, n > most]
              tooLarge = fromMaybe feedsRegion (listToMaybe found)
      ]
    values = case codes f of
      Listed t -> Map.elems t
      Direct a z -> [fromIntegral a, fromIntegral z]
    brakingFaults = case (brakingForm b, feedMeasure f, values) of
      (BrakedFrames (Feed v), AlongPath, _ : _) ->
        let (low, high) = (minimum values, maximum values)
         in [ BadTable brakingRegion (NoSuchFeed low high)
              | v < low - 1e-9 * low || v > high + 1e-9 * high
            ]
      _ -> []
