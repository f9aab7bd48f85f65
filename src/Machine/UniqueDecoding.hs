-- | Checks that the frames of a layout can be decoded uniquely, symbol by symbol. The items of a
-- layout are words, literal symbols and check digits. An optional item is a word that some frames
-- lack. The separator is the text between two words of a frame that follow each other directly.
--
-- The reader tries the items of the layout in their order. The conditions on the layout are:
--
-- * The code has a row for every symbol.
-- * Every optional word has an address. No two addresses are equal.
-- * No address and no separator begins like a number: with a digit, a sign or a point.
-- * If one address is a prefix of another, the word with the longer address comes first, and the
--   rest of the longer address cannot be the number of the other word.
-- * The address of an optional word is no prefix of a literal symbol, and no literal symbol is a
--   prefix of it.
-- * The symbol after a number without fixed length is neither a digit nor a point.
-- * At least one item occurs in every frame. At most one item is a check digit.
-- * No frame can begin with a blank row if the reader skips blank rows.
-- * No frame can begin with the closing symbols of the tape.
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
import Machine.DecodingError (DecodingFault (..))
import Machine.Error (Error (..))
import Machine.Machine

-- | Item of a frame with its region.
type LocatedItem = (Region, LayoutItem)

-- | Lists the reasons why frames cannot be decoded uniquely. The arguments are the medium and the
-- region of its section, the code, the items of the layout, and the separator with its region.
check :: Medium -> Region -> TapeCode -> NonEmpty LocatedItem -> (Region, Text) -> [Error]
check medium tapeRegion tapeCode located locatedSeparator =
  concat
    [ symbolFaults tapeRegion medium tapeCode items' locatedSeparator,
      concatMap addressFaults items',
      [ NotDecodable (fst locatedSeparator) (LikeNumber (snd locatedSeparator))
        | beginsLikeNumber (snd locatedSeparator)
      ],
      prefixFaults items',
      concatMap (successorFaults (snd locatedSeparator)) (successors items'),
      concatMap (endFaults medium tapeCode) (successors items'),
      [NotDecodable r NoFixedItem | all (isOptional . snd) items', (r, _) <- take 1 items'],
      [ NotDecodable r (TwoChecks first)
        | (k, (r, CheckDigit _)) <- zip [0 ..] items',
          (first, CheckDigit _) <- take 1 [i | i@(_, CheckDigit _) <- take k items']
      ],
      blankStart medium tapeCode items',
      [ NotDecodable tapeRegion ClosingLikeFrame
        | not (Text.null (closing medium)),
          canBeginWith (closing medium) (map snd items')
      ]
    ]
  where
    items' = NonEmpty.toList located

-- | True if some frames lack the item.
isOptional :: LayoutItem -> Bool
isOptional i = case i of
  AWord w -> presence w /= Always
  Literal _ -> False
  CheckDigit _ -> False

-- | Reports characters of the layout or the medium for which the code has no symbol. @between@ is
-- the separator.
symbolFaults :: Region -> Medium -> TapeCode -> [LocatedItem] -> (Region, Text) -> [Error]
symbolFaults tapeRegion medium tapeCode items' (separatorRegion, between) =
  catMaybes
    ( missing tapeRegion "the opening" (opening medium) :
      missing tapeRegion "the closing" (closing medium) :
      missing separatorRegion "the separator" between :
      map missingInItem items'
    )
  where
    missingInItem (r, i) = case i of
      Literal t -> missing r "the frame" t
      CheckDigit _ -> missing r "the check digit" "0123456789"
      AWord w -> missing r "the word" (address w <> numerals (form w))
    missing r part text = case filter (`Map.notMember` symbols tapeCode) (nub (Text.unpack text)) of
      [] -> Nothing
      characters -> Just (NotInCode r part characters)
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

-- | Reports an optional word without address, and an address that begins like a number.
addressFaults :: (Region, LayoutItem) -> [Error]
addressFaults (r, i) = case i of
  AWord w ->
    [NotDecodable r NoAddress | Text.null (address w), isOptional i]
      <> [NotDecodable r (LikeNumber (address w)) | beginsLikeNumber (address w)]
  Literal _ -> []
  CheckDigit _ -> []

-- | True if the first symbol of a text is a digit, a sign or a point.
beginsLikeNumber :: Text -> Bool
beginsLikeNumber t = Text.any (\c -> isDigit c || c `elem` ("+-." :: String)) (Text.take 1 t)

-- | Reports each item that the reader could confuse with an earlier one, because their addresses
-- or literal symbols are equal or begin in the same way. There is at most one report for each
-- item.
prefixFaults :: [LocatedItem] -> [Error]
prefixFaults items' =
  concat
    [ take 1 (concat [pairFaults first second | first <- take k items'])
      | (k, second) <- zip [0 ..] items'
    ]

-- | Reports addresses or symbols of two items that the reader could confuse. The first item is
-- earlier in the frame.
pairFaults :: LocatedItem -> LocatedItem -> [Error]
pairFaults (r, a) (r', b) = case (a, b) of
  (AWord v, AWord w)
    | Text.null (address v) || Text.null (address w) -> []
    | address v == address w -> [NotDecodable r' (SameAddress (address w) r)]
    | address v `Text.isPrefixOf` address w ->
      [NotDecodable r' (Prefix (address v) (address w) r)]
    | address w `Text.isPrefixOf` address v
        && numberMayBegin w (Text.drop (Text.length (address w)) (address v)) ->
      [NotDecodable r (Prefix (address w) (address v) r')]
    | otherwise -> []
  (AWord v, Literal t) | isOptional a -> commonPrefix r' r (address v) t
  (Literal t, AWord v) | isOptional b -> commonPrefix r r' (address v) t
  _ -> []

-- | Reports the address @ofWord@ of an optional word and the symbols @ofLiteral@ if one is a
-- prefix of the other.
commonPrefix :: Region -> Region -> Text -> Text -> [Error]
commonPrefix literalRegion wordRegion ofWord ofLiteral
  | Text.null ofWord || Text.null ofLiteral = []
  | ofWord `Text.isPrefixOf` ofLiteral =
    [NotDecodable literalRegion (Prefix ofWord ofLiteral wordRegion)]
  | ofLiteral `Text.isPrefixOf` ofWord =
    [NotDecodable wordRegion (Prefix ofLiteral ofWord literalRegion)]
  | otherwise = []

-- | True if the reader could take the longer address of another word for the word @w@. That
-- address consists of the address of @w@ and the text @rest@. For a motion code, the result is
-- True if one of its codes is a prefix of @rest@, or @rest@ a prefix of one of its codes. For any
-- other word it is True if @rest@ begins like a number, or if @w@ has no number.
numberMayBegin :: Word' -> Text -> Bool
numberMayBegin w rest = case content w of
  Motion m -> any (\t -> rest `Text.isPrefixOf` t || t `Text.isPrefixOf` rest) (numbersOf m)
  _ -> digits (form w) == 0 || beginsLikeNumber rest
  where
    numbersOf m =
      map written (catMaybes [rapid m, Just (straight m), clockwise m, counterClockwise m])
    written n
      | padded (form w) = Text.justifyRight (digits (form w)) '0' (Decimal.whole n)
      | otherwise = Decimal.whole n

-- | An item, and the items that may come directly after it. These are optional items, and then the
-- first item that every frame contains.
data Successors = Successors
  { item :: LocatedItem,
    next :: [Successor]
  }

-- | Item that may come directly after another one. @isSameFrame@ is true if both are in one frame,
-- and false if this item is in the next frame.
data Successor = Successor
  { isSameFrame :: Bool,
    successor :: LocatedItem
  }

-- | Lists each item with its successors, in the order of the layout. If all items after an item
-- are optional, its successors include items of the next frame.
successors :: [LocatedItem] -> [Successors]
successors items' =
  [ Successors {item = i, next = upToFixed (restOfFrame k <> nextFrame)}
    | (k, i) <- zip [0 ..] items'
  ]
  where
    restOfFrame k = map (Successor True) (drop (k + 1) items')
    nextFrame = map (Successor False) items'
    upToFixed is = case is of
      i : rest | isOptional (snd (successor i)) -> i : upToFixed rest
      _ -> take 1 is

-- | True if the item is a word whose number has no fixed length. False for a word without a
-- number, which has 0 digits.
hasOpenEnd :: LayoutItem -> Bool
hasOpenEnd i = case i of
  AWord w -> not (padded (form w)) && digits (form w) > 0
  Literal _ -> False
  CheckDigit _ -> False

-- | Reports a number without fixed length before an item that may begin with a digit. @between@ is
-- the separator, which ends such a number.
successorFaults :: Text -> Successors -> [Error]
successorFaults between Successors {item = (r, i), next}
  | hasOpenEnd i = take 1 (mapMaybe fault next)
  | otherwise = []
  where
    fault (Successor isSame (r', following)) = case following of
      AWord w
        | Text.null (address w),
          sign (form w) /= EitherSign,
          Text.null between || not isSame ->
          Just (NotDecodable r (NumberRunsOn r'))
      AWord _ -> Nothing
      Literal t
        | continuesNumber t -> Just (NotDecodable r (NumberRunsOn r'))
      Literal _ -> Nothing
      CheckDigit _ -> Just (NotDecodable r (NumberRunsOn r'))

-- | True if the first symbol of a text is a digit or a point.
continuesNumber :: Text -> Bool
continuesNumber t = Text.any (\c -> isDigit c || c == '.') (Text.take 1 t)

-- | Reports a number without fixed length at the end of a frame, if the reader could take closing
-- symbols or skipped blank rows for a further digit of the number.
endFaults :: Medium -> TapeCode -> Successors -> [Error]
endFaults medium tapeCode Successors {item = (r, i), next}
  | hasOpenEnd i && not (all isSameFrame next) =
    [NotDecodable r NumberRunsIntoClosing | continuesNumber (closing medium)]
      <> [ NotDecodable r (NumberRunsIntoBlank d)
           | spare medium == Skipped,
             d <- ['0' .. '9'],
             isBlank medium tapeCode d
         ]
  | otherwise = []

-- | True if the code has a row without holes for the symbol @c@.
isBlank :: Medium -> TapeCode -> Char -> Bool
isBlank medium tapeCode c = case Map.lookup c (symbols tapeCode) of
  Nothing -> False
  Just holes -> 0 `elem` take 1 (CodeFromText.rowsOf (tracks medium) tapeCode holes)

-- | Items that can be the first one in a frame.
firstItems :: [LocatedItem] -> [LocatedItem]
firstItems items' =
  let (optional, fixed) = span (isOptional . snd) items'
   in optional <> take 1 fixed

-- | Reports a frame that may begin with a blank row, although the reader skips blank rows.
blankStart :: Medium -> TapeCode -> [LocatedItem] -> [Error]
blankStart medium tapeCode items' = case spare medium of
  Counted -> []
  Skipped ->
    [ NotDecodable r BlankStart
      | (r, i) <- firstItems items',
        any (isBlank medium tapeCode) (firstSymbols i)
    ]
  where
    firstSymbols i = case i of
      Literal t -> Text.unpack (Text.take 1 t)
      CheckDigit _ -> ['0' .. '9']
      AWord w
        | not (Text.null (address w)) -> Text.unpack (Text.take 1 (address w))
        | sign (form w) == EitherSign -> "+-"
        | take 1 (service (form w)) == [Marker] -> ""
        | otherwise -> ['0' .. '9']

-- | True if a frame with the items @items'@ may begin with the symbols @text@.
canBeginWith :: Text -> [LayoutItem] -> Bool
canBeginWith text items' = case items' of
  _ | Text.null text -> True
  [] -> False
  Literal t : rest -> case Text.stripPrefix t text of
    Nothing -> text `Text.isPrefixOf` t
    Just more -> canBeginWith more rest
  CheckDigit _ : _ -> beginsLikeNumber text
  AWord w : rest -> wordCanBegin w rest || (isOptional (AWord w) && canBeginWith text rest)
  where
    wordCanBegin w rest = case Text.stripPrefix (address w) text of
      Nothing -> text `Text.isPrefixOf` address w
      Just number
        | digits (form w) == 0 -> canBeginWith number rest
        | otherwise -> Text.null number || beginsLikeNumber number
