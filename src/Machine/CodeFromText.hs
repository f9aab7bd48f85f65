-- | Reads the section @code@ of a description: the rows of the symbols.
--
-- A row is the holes across the tape at one position; a symbol is a character that a row means. A
-- description gives a row as a pattern of holes: digits 0 and 1, the highest track first. The
-- parity track makes the number of holes in every row even. In the row of a digit, a hole in the
-- service track has a meaning of its own, such as the sign of a number or a bit of a command.
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
import Machine.Error (Error (..), HoleFault (..))
import Machine.Machine (TapeCode (..))
import Machine.Section
import Machine.Syntax

-- | Reads the section @code@. @trackCount@ is the number of tracks. It is 'Nothing' if the number
-- cannot be read, and then the pattern of a symbol may have 1 to 8 digits.
code :: Maybe Int -> Statement -> Result w Error TapeCode
code trackCount s = do
  (name, section) <- withBlock ["code \"NAME\" { … }"] "the code" codeNameFrom s
  made <-
    TapeCode name
      <$> (Map.map value <$> locatedSymbols section)
      <*> (Map.map value <$> locatedWeights section)
      <*> track "parity-track" section
      <*> track "service-track" section
      <*> optional "skip" [] (skipsFrom width) section
      <* allowKeys ["symbols", "weights", "parity-track", "service-track", "skip"] [] section
  let faults = case output (locatedSymbols section) of
        Nothing -> []
        Just located -> check (most width) section made located <> unknownWeights section located
  Result.failing faults made
  where
    width = maybe (Width 1 8) (\n -> Width (max 1 (n - 1)) n) trackCount
    codeNameFrom args = case map value args of
      [Quoted n] -> Just (pure n)
      _ -> Nothing
    locatedSymbols = required "symbols" "symbols { 0 = 0000 … }" (symbolsFrom width)
    locatedWeights = optional "weights" Map.empty weightsFrom
    -- Reports weights of characters that are not symbols. Such a character may be a letter of
    -- another alphabet that looks like a symbol.
    unknownWeights section located =
      [ NotInCode r "the weight" [c]
        | Just weights' <- [output (locatedWeights section)],
          (c, Located r _) <- Map.toList weights',
          Map.notMember c located
      ]
    track word = optional word Nothing (withArguments [word <> " 5"] (single trackNumber))
    trackNumber = fmap (fmap Just) . wholeIn "the track" 1 (most width)

-- | Reads the only argument of a line by @f@; 'Nothing' if the line has no argument or several.
single :: (Argument -> Maybe (Result w Error a)) -> [Argument] -> Maybe (Result w Error a)
single f args = case args of
  [a] -> f a
  _ -> Nothing

-- | Least and largest count of digits in a pattern of holes. A pattern may leave the highest track
-- out, because it is often the service track or the parity track.
data Width = Width {least :: Int, most :: Int}

-- | Reads the symbols, each with its region and its holes. The holes are a number whose bit k−1 is
-- 1 if there is a hole in track k.
symbolsFrom :: Width -> Statement -> Result w Error (Map Char (Located Word8))
symbolsFrom width s = do
  ((), section) <- withBlock ["symbols { 0 = 0000 … }"] "the symbols" noArguments s
  given <- concat . catMaybes <$> traverse (attempt . symbol) (entries section)
  Result.failing
    (repetitions "the symbol " [(c, r) | (c, Located r _) <- given])
    (Map.fromListWith (\_ first -> first) given)
  where
    symbol e
      | keyWord e == Just "ascii" && null (arguments e) && isNothing (formula e) =
        if most width < 7
          then Result.failed (BadHoles (extent e) TooFewTracks)
          else pure [(c, Located (extent e) (fromIntegral (ord c))) | c <- '\n' : [' ' .. '~']]
      | otherwise = case (charOf e, formula e) of
        _ | broken e -> alreadyReported
        (Just c, Just (Located r (Constant digits _)))
          | null (arguments e) ->
            (\p -> [(c, Located (region (key e)) p)]) <$> holesOf width (Located r digits)
        _ -> malformed ["X = 0101", "\"\\n\" = 0101", "ascii"] e

-- | The key of a line as a symbol; 'Nothing' if the key is not a single character.
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

-- | Reports each symbol that an earlier line gives too. The report contains @title@, such as ‘the
-- weight of’, and after it the symbol.
repetitions :: Text -> [(Char, Region)] -> [Error]
repetitions title given =
  [ Twice r (title <> "‘" <> Text.singleton c <> "’") first
    | ((c, r), earlier) <- zip given earlierOnes,
      Just first <- [Map.lookup c earlier]
  ]
  where
    earlierOnes = scanl (\m (c, r) -> Map.insertWith (\_ old -> old) c r m) Map.empty given

-- | Reads a pattern of holes, the highest track first, as a number whose bit k−1 is track k.
-- Tracks that the pattern leaves out have no hole.
holesOf :: Width -> Located Text -> Result w Error Word8
holesOf width (Located r digits)
  | Text.any (`notElem` ("01" :: String)) digits || size > most width || size < least width =
    Result.failed (BadHoles r (WrongWidth (most width) (least width)))
  | otherwise = pure (Text.foldl' (\n d -> 2 * n + (if d == '1' then 1 else 0)) 0 digits)
  where
    size = Text.length digits

-- | Reads the rows that a tape reader skips. Their patterns have a digit for every track.
skipsFrom :: Width -> Statement -> Result w Error [Word8]
skipsFrom width = withArguments ["skip 00000 11111"] rows
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

-- | Reads the weights of symbols in a check sum, each with the region of its symbol.
weightsFrom :: Statement -> Result w Error (Map Char (Located Int))
weightsFrom s = do
  ((), section) <- withBlock ["weights { digits … }"] "the weights" noArguments s
  given <- concat . catMaybes <$> traverse (attempt . weight) (entries section)
  Result.failing
    (repetitions "the weight of " [(c, r) | (c, Located r _) <- given])
    (Map.fromListWith (\_ first -> first) given)
  where
    weight e
      | keyWord e == Just "digits" && null (arguments e) && isNothing (formula e) =
        pure [(c, Located (extent e) n) | (c, n) <- zip ['0' .. '9'] [0 ..]]
      | otherwise = case (charOf e, formula e) of
        _ | broken e -> alreadyReported
        (Just c, Just (Located r (Constant t v)))
          | null (arguments e),
            Just n <- wholeIn "the weight" 0 1000000 (Located r (Number t v)) ->
            (\k -> [(c, Located (region (key e)) k)]) <$> n
        _ -> malformed ["X = 7", "digits"] e

-- | Checks the holes of the symbols @located@ of the code @made@, on a tape with @tracks@ tracks.
-- The rules: no two symbols have the same holes. No symbol has a hole in the parity track. No
-- digit, sign or point has a hole in the service track. The service track is not the parity track.
-- No row that a tape reader skips is a row of a symbol.
check :: Int -> DescriptionSection -> TapeCode -> Map Char (Located Word8) -> [Error]
check tracks section made located =
  equalRows <> parityFaults <> serviceFaults <> sharedTrack <> skippedSymbols
  where
    rows = Map.toList located
    equalRows =
      [ BadHoles r (SameHoles (Text.singleton d) r')
        | (k, (_, Located r p)) <- zip [0 ..] rows,
          (d, Located r' _) <- take 1 [e | e@(_, Located _ q) <- take k rows, q == p]
      ]
    parityFaults =
      [ BadHoles r (InParityTrack t)
        | t <- maybeToList (evenTrack made),
          (_, Located r p) <- rows,
          testBit p (t - 1)
      ]
    serviceFaults =
      [ BadHoles r (InServiceTrack t)
        | t <- maybeToList (serviceTrack made),
          (c, Located r p) <- rows,
          c `elem` ("0123456789+-." :: String),
          testBit p (t - 1)
      ]
    sharedTrack =
      [ BadHoles (extent s) SharedTrack
        | Just t <- [evenTrack made],
          serviceTrack made == Just t,
          s <- entries section,
          keyWord s == Just "service-track"
      ]
    skippedSymbols =
      [ BadHoles (extent s) (SkippedSymbol (Text.singleton c))
        | s <- entries section,
          keyWord s == Just "skip",
          row <- skips made,
          (c, _) <- take 1 [e | e@(_, Located _ p) <- rows, row `elem` rowsOf tracks made p]
      ]

-- | Rows that a symbol with the holes @p@ can have on a tape with @tracks@ tracks. The first row
-- has the holes @p@. If there is a service track, a second row also has a hole in this track. Each
-- row has a further hole in the parity track if this makes its number of holes even.
rowsOf :: Int -> TapeCode -> Word8 -> [Word8]
rowsOf tracks made p = map even' (p : [p .|. bit' t | Just t <- [serviceTrack made], t <= tracks])
  where
    even' row = case evenTrack made of
      Just t | odd (popCount row) -> row `xor` bit' t
      _ -> row
    bit' t = 2 ^ (t - 1)
