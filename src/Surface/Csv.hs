-- | Tables from files of comma-separated values.
--
-- The first line names the columns, each with the unit of its numbers or without one; every other
-- line has a number for each of them. Between them stand commas, semicolons or tabs, whichever the
-- first line has; where it is not commas, a number may have a decimal comma. Empty lines count for
-- nothing.
module Surface.Csv
  ( table,
  )
where

import Base.Decimal (Leading (..))
import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.NumberTable (NumberTable (NumberTable))
import Base.NumberTable qualified as NumberTable
import Base.Region (Located (..), Region (..))
import Base.Region qualified as Region
import Control.Monad.ST (ST, runST)
import Data.Char (isAlpha, isAlphaNum, isDigit, isSpace)
import Data.Either (partitionEithers)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Primitive.PrimArray
  ( MutablePrimArray,
    newPrimArray,
    resizeMutablePrimArray,
    shrinkMutablePrimArray,
    unsafeFreezePrimArray,
    writePrimArray,
  )
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Read qualified as Read
import Surface.Error (Error (..))
import Surface.Keyword qualified as Keyword
import Surface.Syntax (Expr_ (..), Heading (..), Numeral (..), TableLine, TableLine_ (..))
import Surface.Token (columnUnits, unitName)

-- | The lines of a text whose first character has the offset given, and what cannot be read.
table :: Int -> Text -> ([Error], [TableLine])
table begin text = case filter (not . Text.all isSpace . value) (linesOf begin text) of
  [] -> ([EmptyTable (Region begin begin)], [])
  header : rest ->
    let separator = separatorOf (value header)
        (wrong, first) = headings separator header
        columns = case value first of
          Header hs -> Just (length hs)
          Entries _ -> Nothing
          Numbers _ -> Nothing
          BrokenLine -> Nothing
        (wrongs, others) = unzip (rowsFrom separator columns 1 rest)
     in (wrong <> concat wrongs, first : others)

-- | The rows from one with a number on, if the columns are known so many in each, and what is wrong
-- with them.
rowsFrom :: Char -> Maybe Int -> Int -> [Located Text] -> [([Error], TableLine)]
rowsFrom separator columns k texts =
  [ ( [],
      Located
        (Region.span (NumberTable.place found 0) (NumberTable.place found (count - 1)))
        (Numbers found)
    )
    | count > 0
  ]
    <> other
  where
    (found, behind) = maybe (NumberTable.joined 0 [],) (plain separator) columns texts
    count = NumberTable.count found
    other = case behind of
      [] -> []
      text : rest ->
        numbers separator columns (k + count) text : rowsFrom separator columns (k + count + 1) rest

-- | The lines at the front with so many numbers without spaces, signs other than minus, and
-- exponents, as most are; and those behind them.
plain :: Char -> Int -> [Located Text] -> (NumberTable, [Located Text])
plain separator width texts = runST $ do
  ends <- newPrimArray (2 * few)
  cells <- newPrimArray (width * few)
  go 0 few ends cells texts
  where
    few = 8
    -- So many rows are there, and room for so many.
    go ::
      Int ->
      Int ->
      MutablePrimArray s Int ->
      MutablePrimArray s Double ->
      [Located Text] ->
      ST s (NumberTable, [Located Text])
    go k room ends cells rest = case rest of
      Located (Region from to) text : more
        | k >= room -> do
          ends' <- resizeMutablePrimArray ends (4 * room)
          cells' <- resizeMutablePrimArray cells (2 * width * room)
          go k (2 * room) ends' cells' rest
        | otherwise -> do
          fits <- row cells (width * k) width text
          if fits
            then
              writePrimArray ends (2 * k) from
                >> writePrimArray ends (2 * k + 1) to
                >> go (k + 1) room ends cells more
            else done k ends cells rest
      [] -> done k ends cells rest
    done k ends cells rest = do
      shrinkMutablePrimArray ends (2 * k)
      shrinkMutablePrimArray cells (width * k)
      places <- unsafeFreezePrimArray ends
      found <- unsafeFreezePrimArray cells
      pure (NumberTable {NumberTable.width, NumberTable.places, NumberTable.numbers = found}, rest)
    -- Whether a text is so many numbers; they are put one behind the other from a place on.
    row :: MutablePrimArray s Double -> Int -> Int -> Text -> ST s Bool
    row cells i wanted text = case Text.uncons text of
      Just ('-', digits) -> number cells i wanted negate digits
      _ -> number cells i wanted id text
    number :: MutablePrimArray s Double -> Int -> Int -> (Double -> Double) -> Text -> ST s Bool
    number cells i wanted signed text = case Decimal.leading text of
      Leading {size, worth = Just x, behind} | size > 0 -> do
        writePrimArray cells i (signed x)
        case Text.uncons behind of
          Nothing -> pure (wanted == 1)
          Just (c, more) | c == separator && wanted > 1 -> row cells (i + 1) (wanted - 1) more
          _ -> pure False
      _ -> pure False

-- | The lines with their places, without a mark of the byte order.
linesOf :: Int -> Text -> [Located Text]
linesOf begin text = go begin text
  where
    go at rest
      | Text.null rest = []
      | otherwise =
        let (line, after) = Text.break (\c -> c == '\n' || c == '\r' || c == '\xFEFF') rest
         in Located (Region at (at + Text.length line)) line :
            go (at + Text.length line + 1) (Text.drop 1 after)

separatorOf :: Text -> Char
separatorOf header = case filter (`Text.any` header) [(== ';'), (== '\t')] of
  _ : _ | Text.any (== ';') header -> ';'
  _ : _ -> '\t'
  [] -> ','

-- | What stands between the separators, without the spaces around it and a pair of quotation marks.
-- A single one stays: it belongs to nothing.
fields :: Char -> Located Text -> NonEmpty (Located Text)
fields separator (Located (Region at _) line) = NonEmpty.zipWith field starts parts
  where
    parts = NonEmpty.fromList (Text.split (== separator) line)
    starts = NonEmpty.scanl (\a p -> a + Text.length p + 1) at (NonEmpty.toList parts)
    field from part =
      let spaced = Text.dropAround isSpace part
          inside =
            maybe
              spaced
              (Text.dropAround isSpace)
              (Text.stripPrefix "\"" spaced >>= Text.stripSuffix "\"")
          before =
            Text.length (Text.takeWhile isSpace part)
              + (if Text.length inside == Text.length spaced then 0 else quotedFrom spaced)
          size = Text.length inside
       in Located
            ( if size == 0
                then Region from (from + Text.length part)
                else Region (from + before) (from + before + size)
            )
            inside
    -- Behind the quotation mark and the spaces that follow it.
    quotedFrom spaced = 1 + Text.length (Text.takeWhile isSpace (Text.drop 1 spaced))

headings :: Char -> Located Text -> ([Error], TableLine)
headings separator line =
  case partitionEithers (map heading (NonEmpty.toList (fields separator line))) of
    ([], h : hs) -> ([], Located (region line) (Header (h :| hs)))
    (wrong, _) -> (wrong, Located (region line) BrokenLine)
  where
    heading (Located at text) =
      case if isHollow text
        then []
        else Text.words (Text.map (\c -> if c `elem` ("[]()" :: String) then ' ' else c) text) of
        [word] | isName word -> Right (Heading (Located at (Name word)) Nothing)
        [word, unit]
          | isName word,
            u : _ <- [u | u <- columnUnits, unitName u == unit] ->
            Right
              ( Heading
                  (Located (Region (start at) (start at + Text.length word)) (Name word))
                  (Just u)
              )
        _ -> Left (BadHeading at text)
    -- Brackets without a unit say nothing.
    isHollow text = any (`Text.isInfixOf` Text.filter (not . isSpace) text) ["[]", "()"]
    isName word =
      Text.all (\c -> isAlphaNum c || c == '_') word
        && Text.any isAlpha (Text.take 1 word)
        && not (Keyword.isReserved word)

-- | A row, which has its number from 1, with a cell for each column, if those are known.
numbers :: Char -> Maybe Int -> Int -> Located Text -> ([Error], TableLine)
numbers separator columns k line = case partitionEithers (map number cells) of
  ([], _)
    | Just n <- columns,
      n /= length cells ->
      ([CellCount (region line) k n (length cells) (decimal n)], Located (region line) BrokenLine)
  ([], e : es) -> ([], Located (region line) (Entries (e :| es)))
  (wrong, _) -> (wrong, Located (region line) BrokenLine)
  where
    cells = filled (NonEmpty.toList (fields separator line))
    -- Too many cells of digits alone may be the halves of numbers with a decimal comma.
    decimal n =
      separator == ','
        && length cells > n
        && all (Text.all isDigit . Text.dropWhile (`elem` ['-', '+']) . value) cells
    -- Nothing behind the last separator is no cell.
    filled found = case reverse found of
      Located _ "" : rest@(_ : _ : _) -> reverse rest
      _ -> found
    number (Located at text) = case Text.uncons text of
      Just ('-', rest) ->
        maybe
          (wrongly at text)
          (Right . Located at . Negate . Located (Region (start at + 1) (end at)))
          (numeral (Text.stripStart rest))
      Just ('+', rest) -> maybe (wrongly at text) (Right . Located at) (numeral rest)
      _ -> maybe (wrongly at text) (Right . Located at) (numeral text)
    wrongly at text = Left (BadCell at text)
    -- Behind its sign.
    numeral text =
      let digits = if separator == ',' then text else Text.replace "," "." text
       in case Read.rational digits :: Either String (Double, Text) of
            Right (x, "")
              | Text.all (`elem` ("0123456789.eE+-" :: String)) digits,
                not (isInfinite x),
                not (any ((`elem` ("+-" :: String)) . fst) (Text.uncons digits)) ->
                Just (Literal (Numeral digits x) Nothing)
            _ -> Nothing
