-- | Whether the frames of a layout can be read back: symbol by symbol, in one way only.
--
-- Addresses are no numbers and none begins with another that may stand in its place; a number of
-- any length is followed by what is no digit; something stands in every frame. A reader that tries
-- the items in order needs no more.
module Machine.UniqueDecoding
  ( check,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region)
import Data.Char (isDigit)
import Data.List (nub)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.CodeFromText qualified as CodeFromText
import Machine.Error (Error (..), Unclear (..))
import Machine.Machine

-- | What is wrong with the items of a frame on a tape, and with its separator and the closing
-- symbols.
check :: Medium -> Region -> TapeCode -> NonEmpty (Region, LayoutItem) -> (Region, Text) -> [Error]
check medium tape code' placed separator' =
  concat
    [ symbolFaults tape medium code' items' separator',
      concatMap addressFaults items',
      [ Unreadable (fst separator') (LikeNumber (snd separator'))
        | beginsLikeNumber (snd separator')
      ],
      pairs items',
      concatMap (runsOn (snd separator')) (followed items'),
      concatMap (runsOut medium code') (followed items'),
      [Unreadable r NothingFixed | all (isOptional . snd) items', (r, _) <- take 1 items'],
      [ Unreadable r (TwoChecks first)
        | (k, (r, CheckDigit _)) <- zip [0 ..] items',
          (first, CheckDigit _) <- take 1 [i | i@(_, CheckDigit _) <- take k items']
      ],
      blankStart medium code' items',
      [ Unreadable tape ClosingLikeFrame
        | not (Text.null (closing medium)),
          mayBegin (closing medium) (map snd items')
      ]
    ]
  where
    items' = NonEmpty.toList placed

isOptional :: LayoutItem -> Bool
isOptional item = case item of
  AWord w -> presence w /= Always
  Literal _ -> False
  CheckDigit _ -> False

-- | Characters that the code lacks.
symbolFaults :: Region -> Medium -> TapeCode -> [(Region, LayoutItem)] -> (Region, Text) -> [Error]
symbolFaults tape medium code' items' (r, between) =
  catMaybes
    ( lacks tape "the opening" (opening medium) :
      lacks tape "the closing" (closing medium) :
      lacks r "the separator" between : map ofItem items'
    )
  where
    ofItem (place, item) = case item of
      Literal t -> lacks place "the frame" t
      CheckDigit _ -> lacks place "the check digit" "0123456789"
      AWord w -> lacks place "the word" (address w <> numerals (form w))
    lacks place what text = case filter (`Map.notMember` symbols code') (nub (Text.unpack text)) of
      [] -> Nothing
      missing -> Just (NotInCode place what missing)
    numerals f =
      (if digits f > 0 then "0123456789" else "")
        <> (if decimals f > 0 then "." else "")
        <> signs (sign f)
    signs s = case s of
      Unsigned -> ""
      ServiceSign -> ""
      MinusSign -> "-"
      EitherSign -> "+-"
      Priority {} -> "0123456789"

-- | An address by itself.
addressFaults :: (Region, LayoutItem) -> [Error]
addressFaults (r, item) = case item of
  AWord w ->
    [Unreadable r NoAddress | Text.null (address w), isOptional item]
      <> [Unreadable r (LikeNumber (address w)) | beginsLikeNumber (address w)]
  Literal _ -> []
  CheckDigit _ -> []

beginsLikeNumber :: Text -> Bool
beginsLikeNumber t = Text.any (\c -> isDigit c || c `elem` ("+-." :: String)) (Text.take 1 t)

-- | Addresses that are alike or begin alike.
pairs :: [(Region, LayoutItem)] -> [Error]
pairs items' =
  concat
    [take 1 (concat [two first second | first <- take k items']) | (k, second) <- zip [0 ..] items']
  where
    two (r, a) (r', b) = case (a, b) of
      (AWord v, AWord w)
        | Text.null (address v) || Text.null (address w) -> []
        | address v == address w -> [Unreadable r' (SameAddress (address w) r)]
        | address v `Text.isPrefixOf` address w ->
          [Unreadable r' (Prefix (address v) (address w) r)]
        | address w `Text.isPrefixOf` address v
            && continues w (Text.drop (Text.length (address w)) (address v)) ->
          [Unreadable r (Prefix (address w) (address v) r')]
        | otherwise -> []
      (AWord v, Literal t) | isOptional a -> alike r' r (address v) t
      (Literal t, AWord v) | isOptional b -> alike r r' (address v) t
      _ -> []
    alike r r' short long
      | Text.null short || Text.null long = []
      | short `Text.isPrefixOf` long = [Unreadable r (Prefix short long r')]
      | long `Text.isPrefixOf` short = [Unreadable r' (Prefix long short r)]
      | otherwise = []

-- | Whether a word with the shorter address can go on like the rest of the longer one.
continues :: Word' -> Text -> Bool
continues w rest = case content w of
  Motion m ->
    or
      [ rest `Text.isPrefixOf` t || t `Text.isPrefixOf` rest
        | t <-
            map
              (number (form w))
              (catMaybes [rapid m, Just (straight m), clockwise m, counterClockwise m])
      ]
  _ -> digits (form w) == 0 || beginsLikeNumber rest
  where
    number f n = (if padded f then Text.justifyRight (digits f) '0' else id) (Decimal.whole n)

-- | Each item with those that may follow it at once, up to one that stands in every frame; the next
-- frame's too. The flag says whether the two stand in one frame.
followed :: [(Region, LayoutItem)] -> [((Region, LayoutItem), [(Bool, (Region, LayoutItem))])]
followed items' =
  [ (i, upToFixed (map (True,) (drop (k + 1) items') <> map (False,) items'))
    | (k, i) <- zip [0 ..] items'
  ]
  where
    upToFixed is = case is of
      i : rest | isOptional (snd (snd i)) -> i : upToFixed rest
      _ -> take 1 is

-- | A number of any length before a digit.
runsOn :: Text -> ((Region, LayoutItem), [(Bool, (Region, LayoutItem))]) -> [Error]
runsOn between ((r, item), behind) = case item of
  AWord w | not (padded (form w)) && digits (form w) > 0 -> take 1 (mapMaybe next behind)
  _ -> []
  where
    next (same, (r', following)) = case following of
      AWord w
        | Text.null (address w) && beginsWithDigit (form w) && (Text.null between || not same) ->
          Just (Unreadable r (RunsOn r'))
      AWord _ -> Nothing
      Literal t
        | Text.any (\c -> isDigit c || c == '.') (Text.take 1 t) ->
          Just (Unreadable r (RunsOn r'))
      Literal _ -> Nothing
      CheckDigit _ -> Just (Unreadable r (RunsOn r'))
    beginsWithDigit f = sign f /= EitherSign

-- | A number of any length at the end of a frame, before closing symbols or skipped rows that read
-- like its next digit.
runsOut :: Medium -> TapeCode -> ((Region, LayoutItem), [(Bool, (Region, LayoutItem))]) -> [Error]
runsOut medium code' ((r, item), behind) = case item of
  AWord w
    | not (padded (form w)) && digits (form w) > 0 && not (all fst behind) ->
      [ Unreadable r RunsOnClosing
        | Text.any (\c -> isDigit c || c == '.') (Text.take 1 (closing medium))
      ]
        <> [ Unreadable r (RunsOnBlank d)
             | spare medium == Skipped,
               d <- ['0' .. '9'],
               isBlank medium code' d
           ]
  _ -> []

-- | Whether a symbol is a row without holes.
isBlank :: Medium -> TapeCode -> Char -> Bool
isBlank medium code' c =
  or
    [ 0 `elem` take 1 (CodeFromText.rowsOf (tracks medium) code' p)
      | Just p <- [Map.lookup c (symbols code')]
    ]

-- | The items with which a frame can begin.
beginning :: [(Region, LayoutItem)] -> [(Region, LayoutItem)]
beginning items' = let (may, fixed) = span (isOptional . snd) items' in may <> take 1 fixed

-- | Blank rows that are skipped, and a frame that may begin with one.
blankStart :: Medium -> TapeCode -> [(Region, LayoutItem)] -> [Error]
blankStart medium code' items' = case spare medium of
  Counted -> []
  Skipped ->
    [ Unreadable r BlankStart
      | (r, item) <- beginning items',
        any (isBlank medium code') (firsts item)
    ]
  where
    firsts item = case item of
      Literal t -> Text.unpack (Text.take 1 t)
      CheckDigit _ -> ['0' .. '9']
      AWord w
        | not (Text.null (address w)) -> Text.unpack (Text.take 1 (address w))
        | sign (form w) == EitherSign -> "+-"
        | take 1 (service (form w)) == [Marker] -> ""
        | otherwise -> ['0' .. '9']

-- | Whether a frame may begin with these symbols.
mayBegin :: Text -> [LayoutItem] -> Bool
mayBegin text items' = case items' of
  _ | Text.null text -> True
  [] -> False
  Literal t : rest -> maybe (text `Text.isPrefixOf` t) (`mayBegin` rest) (Text.stripPrefix t text)
  CheckDigit _ : _ -> beginsLikeNumber text
  AWord w : rest -> here w rest || (isOptional (AWord w) && mayBegin text rest)
  where
    here w rest = case Text.stripPrefix (address w) text of
      Nothing -> text `Text.isPrefixOf` address w
      Just behind
        | digits (form w) == 0 -> mayBegin behind rest
        | otherwise -> Text.null behind || beginsLikeNumber behind
