-- | Tables of numbers with formulas, and the sections @feeds@ and @braking@ of a description.
module Machine.FeedFromText
  ( feeds,
    braking,
    table,
    checkFeeds,
  )
where

import Base.Quantity (Feed (..))
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes)
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
  )
import Machine.Section
import Machine.Syntax

-- | The lines @1 = 15@ and @0..40 = 10 * 10^(n/20)@ of a block.
table :: Section -> Result w Error (Map Int Double)
table section = do
  given <- concat . catMaybes <$> traverse (tried . line) (entries section)
  let values = Map.fromListWith (\_ first -> first) [(n, v) | (n, _, v) <- given]
  Result.failing
    (repeated given <> [BadTable (place section) EmptyTable | null (entries section)])
    values
  where
    tried r = r {output = Just (output r)}
    line e = case (codesOf e, formula e) of
      _ | broken e -> Result [] [] Nothing
      (Just (a, b), Just (Located r f))
        | null (arguments e),
          Nothing <- block e ->
          range (region (key e)) a b >>= traverse (entry (region (key e)) r f)
      _ -> malformed ["1 = 15", "0..40 = 10 * 10^(n/20)"] e
    range r a b =
      if a > b || b - a >= longest then Result.failed (BadTable r (BadRange a b)) else pure [a .. b]
    entry r r' f n =
      let v =
            evaluate (fromIntegral n) f
       in if v > 0 && v < 1e9 then pure (n, r, v) else Result.failed (BadTable r' (NoValue n))
    codesOf e = case value (key e) of
      Number t v | Text.all (/= '.') t && v < 1e9 -> Just (round v, round v)
      Range a b -> Just (a, b)
      _ -> Nothing

-- | Codes that are given twice, once for each line.
repeated :: [(Int, Region, Double)] -> [Error]
repeated given =
  dedupe
    [Twice r "a code" first | (n, r, _) <- given, Just first <- [Map.lookup n firsts], first /= r]
  where
    firsts = Map.fromListWith (\_ first -> first) [(n, r) | (n, r, _) <- given]
    dedupe es = case es of
      e : rest -> e : dedupe (dropWhile (== e) rest)
      [] -> []

-- | A table has at most so many lines by one formula.
longest :: Int
longest = 10000

feeds :: Statement -> Result w Error Feeds
feeds s = do
  ((), section) <-
    opened ["feeds { … }"] "the feeds" (\args -> if null args then Just (pure ()) else Nothing) s
  Feeds
    <$> required
      "measure"
      "measure mm/min"
      (choice [("mm/min", AlongPath), ("Hz", LeadingAxis)])
      section
    <*> codesFrom section
    <*> required
      "rule"
      "rule nearest"
      (choice [("not-above", NotAbove), ("nearest", Nearest)])
      section
    <*> required "rapid" "rapid highest" (plain ["rapid highest", "rapid code 9"] rapid) section
    <* known ["measure", "table", "direct", "rule", "rapid"] [] section
  where
    rapid args = case args of
      [Located _ (Word "highest")] -> Just (pure Highest)
      [Located _ (Word "code"), n] -> fmap (ByCode . FeedCode) <$> wholeIn "the code" 0 999999999 n
      _ -> Nothing

-- | Either a table or codes that are the values.
codesFrom :: Section -> Result w Error FeedCodes
codesFrom section =
  case ( [s | s <- entries section, keyWord s == Just "table"],
         [s | s <- entries section, keyWord s == Just "direct"]
       ) of
    (t : _, d : _) -> Result.failed (Twice (told d) "the codes of the feeds" (told t))
    (_, []) ->
      Listed . Map.mapKeysMonotonic FeedCode
        <$> required "table" "table { 1 = 15 … }, or: direct 1..999" listed section
    ([], d : _) -> plain ["direct 1..999"] direct d
  where
    listed t =
      opened
        ["table { 1 = 15 … }"]
        "the table of feeds"
        (\args -> if null args then Just (pure ()) else Nothing)
        t
        >>= table . snd
    direct args = case args of
      [Located r (Range a b)]
        | a < 1 || b < a -> Just (Result.failed (BadTable r (BadRange a b)))
        | otherwise -> Just (pure (Direct a b))
      _ -> Nothing

braking :: Statement -> Result w Error Braking
braking s = do
  ((), section) <-
    opened
      ["braking { … }"]
      "the braking"
      (\args -> if null args then Just (pure ()) else Nothing)
      s
  Braking
    <$> required
      "deceleration"
      "deceleration 5 mm/s2"
      (plain ["deceleration 5 mm/s2"] deceleration')
      section
    <*> required
      "by"
      "by control"
      (plain ["by control", "by slow-frames", "by braked-frames 10 mm/min"] form)
      section
    <* known ["deceleration", "by"] [] section
  where
    deceleration' args = case args of
      [a, b] -> amountIn "the deceleration" "mm/s2" 1000000 a b
      _ -> Nothing
    form args = case args of
      [Located _ (Word "control")] -> Just (pure ByControl)
      [Located _ (Word "slow-frames")] -> Just (pure SlowFrames)
      [Located _ (Word "braked-frames"), a, b] ->
        fmap (BrakedFrames . Feed) <$> amountIn "the feed" "mm/min" 1e9 a b
      _ -> Nothing

-- | What feeds and braking say of each other: where each stands, and the largest code that the word
-- of the feed holds.
checkFeeds :: Located Feeds -> Located Braking -> Maybe Int -> [Error]
checkFeeds (Located r f) (Located r' b) holds = rapid <> held <> slow
  where
    rapid = [BadTable r (NoSuchCode n) | ByCode (FeedCode n) <- [rapidFeed f], not (isCode n)]
    isCode n = case codes f of
      Listed t -> Map.member (FeedCode n) t
      Direct a z -> a <= n && n <= z
    highest = case codes f of
      Listed t -> maybe 0 (\(FeedCode n, _) -> n) (Map.lookupMax t)
      Direct _ z -> z
    held = [BadTable r (CodeTooLarge highest most) | Just most <- [holds], highest > most]
    values = case codes f of
      Listed t -> Map.elems t
      Direct a z -> [fromIntegral a, fromIntegral z]
    slow = case (brakingForm b, feedMeasure f, values) of
      (BrakedFrames (Feed v), AlongPath, _ : _) ->
        let (low, high) =
              (minimum values, maximum values)
         in [BadTable r' (NoSuchFeed low high) | v < low - 1e-9 * low || v > high + 1e-9 * high]
      _ -> []
