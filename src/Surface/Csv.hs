-- | Tables from files of comma-separated values.
--
-- The first line names the columns, each with an optional unit. Every other line has one number for
-- each column. The separator is the comma, the semicolon or the tab, whichever the first line
-- contains. If it is not the comma, numbers may have a decimal comma. Blank lines are ignored.
--
-- A row is plain if its cells are numbers without spaces, quotation marks, exponents, plus signs
-- and decimal commas. A run is a sequence of consecutive plain rows; it is read into unboxed
-- arrays. The other rows are read one by one, with an error for each wrong cell. An offset is the
-- index of a character, from 0; the count goes on from one file of a program to the next.
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
import Data.IntSet (IntSet)
import Data.IntSet qualified as IntSet
import Data.List (foldl')
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
import Surface.Syntax
  ( Cell (..),
    Expr,
    Expr_ (..),
    Heading (..),
    Numeral (..),
    TableLine,
    TableLine_ (..),
  )
import Surface.Token (columnUnits, unitName)

-- | Reads a text of comma-separated values, whose first character has the offset @begin@. Gives the
-- errors and the lines of the table. Each line with errors is a 'BrokenLine'.
table :: Int -> Text -> ([Error], [TableLine])
table begin text = case filter (not . Text.all isSpace . value) (linesOf begin text) of
  [] -> ([EmptyTable (Region begin begin)], [])
  header : rest ->
    let separator = separatorOf (value header)
        texts = textColumns separator header rest
        (headingErrors, first) = headings separator texts header
        columns = case value first of
          Header hs -> Just (length hs + IntSet.size texts)
          Entries _ -> Nothing
          Numbers _ -> Nothing
          BrokenLine -> Nothing
        (rowErrors, rows) =
          unzip $
            if IntSet.null texts
              then rowsFrom separator columns 1 rest
              else zipWith (fullRow separator texts columns) [1 ..] rest
     in (headingErrors <> concat rowErrors, first : rows)

-- | The indices from 0 of the columns of texts, such as names of holes. They are left out of the
-- table. At least one cell of such a column is a text, and the others are empty.
textColumns :: Char -> Located Text -> [Located Text] -> IntSet
textColumns separator header rows = IntSet.intersection possible withText
  where
    cellsIn = zip [0 ..] . map value . NonEmpty.toList . cellsOf separator
    columnsWith is line = IntSet.fromList [k | (k, c) <- cellsIn line, is c]
    -- The columns without a number in the first row, then in all rows.
    possible = foldl' withoutNumbers free rows
    free = columnsWith (not . isCoordinate) header
    withoutNumbers left line
      | IntSet.null left = left
      | otherwise = IntSet.difference left (numbersIn [line])
    numbersIn = foldMap (columnsWith (\c -> not (Text.null c || isText c)))
    withText = foldMap (columnsWith isText) (if IntSet.null possible then [] else rows)
    isText c = maybe False (not . (`elem` ("0123456789+-.,(" :: String)) . fst) (Text.uncons c)
    isCoordinate c = take 1 (Text.words c) `elem` map pure ["x", "y", "angle", "radius"]

-- | Reads the rows @texts@, of which the first is row @k@ of the table, counted from 1. Gives the
-- errors and the line for each run of plain rows and for each other row. @columns@ is the number of
-- columns, 'Nothing' if the headings have mistakes.
rowsFrom :: Char -> Maybe Int -> Int -> [Located Text] -> [([Error], TableLine)]
rowsFrom separator columns k texts =
  [ ( [],
      Located
        (Region.span (NumberTable.regionOf found 0) (NumberTable.regionOf found (count - 1)))
        (Numbers found)
    )
    | count > 0
  ]
    <> other
  where
    (found, remaining) = maybe (NumberTable.concatenated 0 [],) (plainRows separator) columns texts
    count = NumberTable.count found
    other = case remaining of
      [] -> []
      text : rest ->
        fullRow separator IntSet.empty columns (k + count) text :
        rowsFrom separator columns (k + count + 1) rest

-- Plain rows

-- | Reads the plain rows of @width@ numbers at the start of a list of rows. Gives the numbers of
-- these rows, and the rows after them.
plainRows :: Char -> Int -> [Located Text] -> (NumberTable, [Located Text])
plainRows separator width texts = runST $ do
  ends <- newPrimArray (2 * initialRoom)
  cells <- newPrimArray (width * initialRoom)
  fillRows separator width 0 initialRoom (Rows ends cells) texts
  where
    initialRoom = 8

-- | Two growing arrays for plain rows. The first array has the offsets of the start and the end of
-- each row. The second array has the numbers of all rows, one row after the other.
data Rows s = Rows (MutablePrimArray s Int) (MutablePrimArray s Double)

-- | Adds plain rows of @width@ numbers to arrays, up to the first row that is not plain. The third
-- argument is the count of rows in the arrays, the fourth the count of rows for which they have
-- room. Full arrays get room for twice as many rows. Gives the numbers of the plain rows, and the
-- rows after them.
fillRows ::
  Char -> Int -> Int -> Int -> Rows s -> [Located Text] -> ST s (NumberTable, [Located Text])
fillRows separator width = go
  where
    go count room rows@(Rows ends cells) texts = case texts of
      Located (Region from to) text : rest
        | count >= room -> do
          ends' <- resizeMutablePrimArray ends (4 * room)
          cells' <- resizeMutablePrimArray cells (2 * width * room)
          go count (2 * room) (Rows ends' cells') texts
        | otherwise -> do
          isPlain <- plainRow separator cells (width * count) width text
          if isPlain
            then do
              writePrimArray ends (2 * count) from
              writePrimArray ends (2 * count + 1) to
              go (count + 1) room rows rest
            else finish count rows texts
      [] -> finish count rows texts
    finish count (Rows ends cells) texts = do
      shrinkMutablePrimArray ends (2 * count)
      shrinkMutablePrimArray cells (width * count)
      places <- unsafeFreezePrimArray ends
      found <- unsafeFreezePrimArray cells
      pure (NumberTable {NumberTable.width, NumberTable.places, NumberTable.numbers = found}, texts)

-- | Reads a plain row and writes its numbers into the array @cells@. The third argument is the
-- index of the first number in the array, the fourth the count of numbers in the row. Gives 'False'
-- if the row is not plain or has another count of cells.
plainRow :: Char -> MutablePrimArray s Double -> Int -> Int -> Text -> ST s Bool
plainRow separator cells = row
  where
    row i wanted text = case Text.uncons text of
      Just ('-', unsigned) -> cell i wanted negate unsigned
      _ -> cell i wanted id text
    cell i wanted signed text = case Decimal.leading text of
      Leading {consumed, parsed = Just x, remainder} | consumed > 0 -> do
        writePrimArray cells i (signed x)
        case Text.uncons remainder of
          Nothing -> pure (wanted == 1)
          Just (c, more) | c == separator && wanted > 1 -> row (i + 1) (wanted - 1) more
          _ -> pure False
      _ -> pure False

-- Lines and cells

-- | The lines of a text, with their regions. The text begins at the offset @begin@. A byte order
-- mark separates lines, so that a mark at the start of a file belongs to no cell.
linesOf :: Int -> Text -> [Located Text]
linesOf begin text = go begin text
  where
    go at rest
      | Text.null rest = []
      | otherwise =
        let (line, after) = Text.break (\c -> c == '\n' || c == '\r' || c == '\xFEFF') rest
         in Located (Region at (at + Text.length line)) line :
            go (at + Text.length line + 1) (Text.drop 1 after)

-- | The separator of cells, judged by the first line: a semicolon if the line contains one, else a
-- tab if the line contains one, else a comma.
separatorOf :: Text -> Char
separatorOf header
  | Text.any (== ';') header = ';'
  | Text.any (== '\t') header = '\t'
  | otherwise = ','

-- | Splits a line into cells. Removes spaces and a pair of quotation marks around a cell. A
-- quotation mark without its partner remains and makes the cell wrong.
cellsOf :: Char -> Located Text -> NonEmpty (Located Text)
cellsOf separator (Located (Region at _) line) = NonEmpty.zipWith trimmed starts parts
  where
    parts = NonEmpty.fromList (Text.split (== separator) line)
    starts = NonEmpty.scanl (\a p -> a + Text.length p + 1) at (NonEmpty.toList parts)

-- | The content of the cell @part@, without the spaces and quotation marks around it, and the
-- content's region. The cell as written starts at the offset @from@. An empty content has the
-- region of the cell as written.
trimmed :: Int -> Text -> Located Text
trimmed from part
  | consumed == 0 = Located (Region from (from + Text.length part)) inside
  | otherwise = Located (Region (from + before) (from + before + consumed)) inside
  where
    stripped = Text.dropAround isSpace part
    inside = case Text.stripPrefix "\"" stripped >>= Text.stripSuffix "\"" of
      Just unquoted -> Text.dropAround isSpace unquoted
      Nothing -> stripped
    consumed = Text.length inside
    before = Text.length (Text.takeWhile isSpace part) + quoteWidth
    -- The length of the opening quotation mark and the spaces after it.
    quoteWidth
      | consumed == Text.length stripped = 0
      | otherwise = 1 + Text.length (Text.takeWhile isSpace (Text.drop 1 stripped))

-- Headings

-- | Reads the line that names the columns; @separator@ separates the names. The columns with the
-- indices @texts@ are left out.
headings :: Char -> IntSet -> Located Text -> ([Error], TableLine)
headings separator texts line =
  case partitionEithers (map heading (without texts (NonEmpty.toList (cellsOf separator line)))) of
    ([], h : hs) -> ([], Located (region line) (Header (h :| hs)))
    (errors, _) -> (errors, Located (region line) BrokenLine)

-- | Reads a heading: a name with an optional unit, which may be in brackets.
heading :: Located Text -> Either Error Heading
heading (Located at text) = case if hasEmptyBrackets then [] else Text.words unbracketed of
  [word] | isColumnName word -> Right (Heading (Located at (Name word)) Nothing)
  [word, unit]
    | isColumnName word,
      u : _ <- [u | u <- columnUnits, unitName u == unit] ->
      let wordRegion = Region (start at) (start at + Text.length word)
       in Right (Heading (Located wordRegion (Name word)) (Just u))
  _ -> Left (BadHeading at text)
  where
    unbracketed = Text.map (\c -> if c `elem` ("[]()" :: String) then ' ' else c) text
    hasEmptyBrackets = any (`Text.isInfixOf` Text.filter (not . isSpace) text) ["[]", "()"]

isColumnName :: Text -> Bool
isColumnName word =
  Text.all (\c -> isAlphaNum c || c == '_') word
    && Text.any isAlpha (Text.take 1 word)
    && not (Keyword.isReserved word)

-- Other rows

-- | Reads row @k@, counted from 1, cell by cell. The row must have @columns@ cells, or any number
-- of cells if @columns@ is 'Nothing'. The cells with the indices @texts@ are left out.
fullRow :: Char -> IntSet -> Maybe Int -> Int -> Located Text -> ([Error], TableLine)
fullRow separator texts columns k line = case partitionEithers numbers of
  ([], _)
    | Just n <- columns,
      n /= length cells ->
      ( [CellCount (region line) k n (length cells) (isDecimalComma n)],
        Located (region line) BrokenLine
      )
  ([], e : es) -> ([], Located (region line) (Entries (fmap ValueCell (e :| es))))
  (errors, _) -> (errors, Located (region line) BrokenLine)
  where
    numbers = map (number separator) (without texts cells)
    cells = lastCells (NonEmpty.toList (cellsOf separator line))
    -- The empty cell of a text at the end of a line is no separator too much.
    lastCells = if maybe False (`IntSet.member` texts) lastColumn then id else withoutLastEmpty
    lastColumn = subtract 1 <$> columns
    -- True if the row has more than @n@ cells, all of them integers. The cells may then be the
    -- halves of numbers with a decimal comma.
    isDecimalComma n =
      separator == ','
        && length cells > n
        && all (Text.all isDigit . Text.dropWhile (`elem` ['-', '+']) . value) cells

-- | A list without the items at the given indices from 0.
without :: IntSet -> [a] -> [a]
without indices list = [x | (k, x) <- zip [0 ..] list, not (IntSet.member k indices)]

-- | The cells of a row without an empty last cell, which a separator at the end of a line makes.
-- The empty cell is kept if only one cell is before it.
withoutLastEmpty :: [Located Text] -> [Located Text]
withoutLastEmpty cells = case reverse cells of
  Located _ "" : rest@(_ : _ : _) -> reverse rest
  _ -> cells

-- | Reads a cell: a number with an optional sign; @separator@ is the character between cells.
number :: Char -> Located Text -> Either Error Expr
number separator (Located at text) = maybe (Left (BadCell at text)) (Right . Located at) $
  case Text.uncons text of
    Just ('-', rest) ->
      Negate . Located (Region (start at + 1) (end at)) <$> numeral separator (Text.stripStart rest)
    Just ('+', rest) -> numeral separator rest
    _ -> numeral separator text

-- | Reads a number without a sign; 'Nothing' if the text is none. A decimal comma is allowed if the
-- cells are separated by another character.
numeral :: Char -> Text -> Maybe Expr_
numeral separator text = case Read.rational digits :: Either String (Double, Text) of
  Right (x, "")
    | Text.all (`elem` ("0123456789.eE+-" :: String)) digits,
      not (isInfinite x),
      not (any ((`elem` ("+-" :: String)) . fst) (Text.uncons digits)) ->
      Just (Literal (Numeral digits x) Nothing)
  _ -> Nothing
  where
    digits = if separator == ',' then text else Text.replace "," "." text
