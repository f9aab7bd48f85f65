-- | The section @code@ of a description: the rows of the symbols.
module Machine.CodeFromText
  ( code,
    check,
    rowsOf,
  )
where

import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.Bits (popCount, testBit, xor, (.|.))
import Data.Char (ord)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes, isNothing, maybeToList)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word8)
import Machine.Error (Error (..), Holes (..))
import Machine.Machine (TapeCode (..))
import Machine.Section
import Machine.Syntax

-- | The code of a tape with so many tracks, if that is known.
code :: Maybe Int -> Statement -> Result w Error TapeCode
code given s = do
  (name, section) <- opened ["code \"NAME\" { … }"] "the code" named s
  made <-
    TapeCode name
      <$> ( Map.map value
              <$> required "symbols" "symbols { 0 = 0000 … }" (symbolsFrom width) section
          )
      <*> (Map.map value <$> optional "weights" Map.empty weightsFrom section)
      <*> track "parity-track" section
      <*> track "service-track" section
      <*> optional "skip" [] (skipsFrom width) section
      <* known ["symbols", "weights", "parity-track", "service-track", "skip"] [] section
  Result.failing
    ( maybe
        []
        (\given' -> check (most width) section made given' <> unknown section given')
        (output (required "symbols" "" (symbolsFrom width) section))
    )
    made
  where
    width = maybe (Width 1 8) (\n -> Width (max 1 (n - 1)) n) given
    named args = case map value args of
      [Quoted n] -> Just (pure n)
      _ -> Nothing
    -- A weight of a symbol that there is not, such as a letter of another alphabet that looks like
    -- it.
    unknown section symbols' =
      [ NotInCode r "the weight" [c]
        | Just weights' <- [output (optional "weights" Map.empty weightsFrom section)],
          (c, Located r _) <- Map.toList weights',
          Map.notMember c symbols'
      ]
    track word =
      optional
        word
        Nothing
        (plain [word <> " 5"] (single (fmap (fmap Just) . wholeIn "the track" 1 (most width))))

single :: (Argument -> Maybe (Result w Error a)) -> [Argument] -> Maybe (Result w Error a)
single f args = case args of
  [a] -> f a
  _ -> Nothing

-- | How many tracks a pattern may name: the highest may be left out, since it is often that of the
-- service or of the parity.
data Width = Width {least :: Int, most :: Int}

-- | The symbols, each with where it is given.
symbolsFrom :: Width -> Statement -> Result w Error (Map Char (Located Word8))
symbolsFrom width s = do
  ((), section) <-
    opened
      ["symbols { 0 = 0000 … }"]
      "the symbols"
      (\args -> if null args then Just (pure ()) else Nothing)
      s
  given <- concat . catMaybes <$> traverse (tried . symbol) (entries section)
  Result.failing
    (repeated "the symbol " [(c, r) | (c, Located r _) <- given])
    (Map.fromListWith (\_ first -> first) given)
  where
    symbol e
      | keyWord e == Just "ascii" && null (arguments e) && isNothing (formula e) =
        if most width < 7
          then Result.failed (BadHoles (told e) TooFewTracks)
          else pure [(c, Located (told e) (fromIntegral (ord c))) | c <- '\n' : [' ' .. '~']]
      | otherwise = case (charOf e, formula e) of
        _ | broken e -> Result [] [] Nothing
        (Just c, Just (Located r (Constant digits _)))
          | null (arguments e) ->
            (\p -> [(c, Located (region (key e)) p)]) <$> holesOf width (Located r digits)
        _ -> malformed ["X = 0101", "\"\\n\" = 0101", "ascii"] e

-- | Go on with what can be read.
tried :: Result w e a -> Result w e (Maybe a)
tried r = r {output = Just (output r)}

-- | The one character that a key is.
charOf :: Statement -> Maybe Char
charOf s = case value (key s) of
  Word w -> one w
  Quoted w -> one w
  Number w _ -> one w
  Range _ _ -> Nothing
  Bit _ _ -> Nothing
  Dash -> Just '-'
  where
    one w = case Text.unpack w of
      [c] -> Just c
      _ -> Nothing

repeated :: Text -> [(Char, Region)] -> [Error]
repeated title given =
  [ Twice r (title <> "‘" <> Text.singleton c <> "’") first
    | ((c, r), before) <- zip given befores,
      Just first <- [Map.lookup c before]
  ]
  where
    befores = scanl (\m (c, r) -> Map.insertWith (\_ old -> old) c r m) Map.empty given

-- | A pattern of holes, the highest track first. Tracks above those that are written have no hole.
holesOf :: Width -> Located Text -> Result w Error Word8
holesOf width (Located r digits)
  | Text.any (`notElem` ("01" :: String)) digits || size > most width || size < least width =
    Result.failed (BadHoles r (WrongWidth (most width) (least width)))
  | otherwise = pure (Text.foldl' (\n d -> 2 * n + (if d == '1' then 1 else 0)) 0 digits)
  where
    size = Text.length digits

skipsFrom :: Width -> Statement -> Result w Error [Word8]
skipsFrom width = plain ["skip 00000 11111"] rows
  where
    rows args = if null args then Nothing else traverse row args >>= Just . sequenceA
    row a = case value a of
      Number t _ ->
        Just
          ( if Text.length t < most width
              then Result.failed (BadHoles (region a) (WrongWidth (most width) (most width)))
              else holesOf width (Located (region a) t)
          )
      _ -> Nothing

-- | The weights, each with where it is given.
weightsFrom :: Statement -> Result w Error (Map Char (Located Int))
weightsFrom s = do
  ((), section) <-
    opened
      ["weights { digits … }"]
      "the weights"
      (\args -> if null args then Just (pure ()) else Nothing)
      s
  given <- concat . catMaybes <$> traverse (tried . weight) (entries section)
  Result.failing
    (repeated "the weight of " [(c, r) | (c, Located r _) <- given])
    (Map.fromListWith (\_ first -> first) given)
  where
    weight e
      | keyWord e == Just "digits" && null (arguments e) && isNothing (formula e) =
        pure [(c, Located (told e) n) | (c, n) <- zip ['0' .. '9'] [0 ..]]
      | otherwise = case (charOf e, formula e) of
        _ | broken e -> Result [] [] Nothing
        (Just c, Just (Located r (Constant t v)))
          | null (arguments e),
            Just n <- wholeIn "the weight" 0 1000000 (Located r (Number t v)) ->
            (\k -> [(c, Located (region (key e)) k)]) <$> n
        _ -> malformed ["X = 7", "digits"] e

-- | What the tracks say of one another.
check :: Int -> Section -> TapeCode -> Map Char (Located Word8) -> [Error]
check tracks section made given = alike <> parity <> service <> twice <> skipped
  where
    rows = Map.toList given
    alike =
      [ BadHoles r (SameHoles (Text.singleton d) r')
        | (k, (_, Located r p)) <- zip [0 ..] rows,
          (d, Located r' _) <- take 1 [e | e@(_, Located _ q) <- take k rows, q == p]
      ]
    parity =
      [ BadHoles r (InParityTrack t)
        | t <- maybeToList (evenTrack made),
          (_, Located r p) <- rows,
          testBit p (t - 1)
      ]
    service =
      [ BadHoles r (InServiceTrack t)
        | t <- maybeToList (serviceTrack made),
          (c, Located r p) <- rows,
          c `elem` ("0123456789+-." :: String),
          testBit p (t - 1)
      ]
    twice =
      [ BadHoles (told s) TwoUses
        | Just t <- [evenTrack made],
          serviceTrack made == Just t,
          s <- entries section,
          keyWord s == Just "service-track"
      ]
    skipped =
      [ BadHoles (told s) (SkippedSymbol (Text.singleton c))
        | s <- entries section,
          keyWord s == Just "skip",
          row <- skips made,
          (c, _) <- take 1 [e | e@(_, Located _ p) <- rows, row `elem` rowsOf tracks made p]
      ]

-- | The rows that a symbol can be on the tape: with the hole of the parity, with and without that
-- of the service.
rowsOf :: Int -> TapeCode -> Word8 -> [Word8]
rowsOf tracks made p = map even' (p : [p .|. bit' t | Just t <- [serviceTrack made], t <= tracks])
  where
    even' row = case evenTrack made of
      Just t | odd (popCount row) -> row `xor` bit' t
      _ -> row
    bit' t = 2 ^ (t - 1)
