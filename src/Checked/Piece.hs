-- | Checks tables, and the ciphers and joggles of pieces. The functions yield 'Deferred' terms,
-- which are complete only when type inference has found all dimensions of the program.
--
-- The cells of a table may be numbers without units. Their dimension follows from the heading of
-- their column, or from the use of the column anywhere in the program. A heading is the name of a
-- column, with an optional unit.
--
-- A piece is a curve that is shifted by ciphers and may have joggles. A cipher is a digit, 1, 2, 4
-- or 6, with values: the digit says by which rule the values give the distance of the shift. A
-- joggle is a local step of the curve. A value along a curve is an expression that may name columns
-- of the curve's table; it may have another value at each point.
module Checked.Piece
  ( table,
    cipher,
    joggle,
  )
where

import Base.Name (Name (..))
import Base.Name qualified as Name
import Base.NumberTable (NumberTable)
import Base.NumberTable qualified as NumberTable
import Base.Quantity (LengthUnit)
import Base.Region (Located (..), Region)
import Checked.Builtin qualified as Builtin
import Checked.Column qualified as Column
import Checked.Deferred (Deferred, resolveAll)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..))
import Checked.ErrorFix (unwritten)
import Checked.Expression (TypingEnvironment (unitAt), expect)
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.PieceError (PieceError (..))
import Checked.Syntax (Cells, Columns (..), PointColumns (..))
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Monad (unless, when, zipWithM)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes, fromMaybe, isJust, isNothing)
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Text (Text)
import Surface.Syntax qualified as Surface
import Surface.Token (Numeral (..))

-- Columns

-- | A column of a table. 'kind' is the type of its cells. 'size' is the factor that converts
-- numbers from the heading's unit to mm, radians, mm/min or turns per minute. It is 'Nothing' if
-- the heading has no unit.
data Column = Column
  { heading :: Located Name,
    kind :: Type,
    size :: Maybe Double,
    role :: Role
  }

-- | The role of a column: a coordinate of the points, a further column of values, or a column of
-- texts, which is left out of the checked table.
data Role = Coordinate | Further | Texts
  deriving stock (Eq)

isExtra :: Column -> Bool
isExtra = (== Further) . role

-- | Tests if all cells of the column with the index @i@, from 0, are texts, and there are such
-- cells.
holdsTexts :: [Surface.TableLine] -> Int -> Bool
holdsTexts written i = not (null found) && all isText found
  where
    found =
      [ c
        | Located _ (Surface.Entries cells) <- written,
          c : _ <- [NonEmpty.drop i cells]
      ]
    isText c = case c of
      Surface.TextCell _ -> True
      Surface.ValueCell _ -> False

-- | Checks the lines of a table and infers the type of the table. The first line must name the
-- columns.
table :: TypingEnvironment -> Located Name -> [Surface.TableLine] -> Infer (Type, Deferred Columns)
table env name written = case written of
  Located at (Surface.Header headings) : rows -> do
    let names = [n | Surface.Heading n _ <- NonEmpty.toList headings]
        coordinates = coordinatesOf (map value names)
    columns <- zipWithM (column coordinates . holdsTexts rows) [0 ..] (NonEmpty.toList headings)
    mapM_ mentionColumn columns
    reportRepeated names
    mapM_ reportConstant names
    reportCoordinates at names
    rows' <- rowsOf env columns rows
    let unit = unitAt env (region name)
    pure (typeOfTable columns, columnsAndRows unit coordinates columns rows')
  Located _ Surface.BrokenLine : _ -> missing <$ Inference.taint
  first : _ -> missing <$ mistake (HeadingsMissing (region first) (cellCount (value first)))
  [] -> missing <$ mistake (HeadingsMissing (region name) 0)
  where
    cellCount line = case line of
      Surface.Entries cells -> length cells
      _ -> 0
    missing = (Type.Wrong, const (Columns CartesianRows [] []))

-- | Finds the coordinates that the columns of a table give. A table with x and y is cartesian, even
-- if it has a further column @angle@ or @radius@.
coordinatesOf :: [Name] -> PointColumns
coordinatesOf names
  | any (`elem` names) (coordinateNames CartesianRows) = CartesianRows
  | any (`elem` names) (coordinateNames PolarRows) = PolarRows
  | otherwise = CartesianRows

-- | The names of the columns that give the coordinates, in the order of the cells of
-- 'Checked.Columns'.
coordinateNames :: PointColumns -> [Name]
coordinateNames coordinates = map Name $ case coordinates of
  CartesianRows -> ["x", "y"]
  PolarRows -> ["radius", "angle"]

-- | Reports columns from which no coordinates follow, and those that give them twice. @at@ is the
-- region of the first line.
reportCoordinates :: Region -> [Located Name] -> Infer ()
reportCoordinates at names = case (given CartesianRows, given PolarRows) of
  (_ : _, polar : _)
    | isGiven PolarRows || not (isGiven CartesianRows) ->
      mistake
        ( CoordinatesMixed
            (region polar)
            (value polar)
            [(region n, value n) | n <- given CartesianRows]
        )
  (_, [_]) | null (given CartesianRows) -> mapM_ (missing PolarRows) (coordinateNames PolarRows)
  (_, _ : _) | null (given CartesianRows) -> pure ()
  _ -> mapM_ (missing CartesianRows) (coordinateNames CartesianRows)
  where
    given coordinates = [n | n <- names, value n `elem` coordinateNames coordinates]
    isGiven coordinates = all (`elem` map value names) (coordinateNames coordinates)
    missing coordinates name =
      unless (name `elem` map value names) $
        mistake
          ( ColumnMissing
              at
              name
              (coordinateNames coordinates)
              [(region n, value n) | n <- names]
          )

-- | Checks the heading of a column. The dimension of a further column follows from the unit in its
-- heading, or from its use. @isOfTexts@ is true if all its cells are texts.
column :: PointColumns -> Bool -> Surface.Heading -> Infer Column
column coordinates isOfTexts (Surface.Heading name unit) = case (unit, coordinate) of
  (Just u, _) -> do
    let (t, factor) = Type.ofUnit u
    case coordinate of
      Just wanted
        | t /= wanted -> mistake (CoordinateUnit (region name) (value name) wanted t)
      _ -> pure ()
    pure (made t (Just factor))
  (Nothing, Just t) -> pure (made t Nothing)
  (Nothing, Nothing) -> do
    d <- Inference.freshDimension
    Inference.monomorphic d
    pure (made (Type.Quantity d) Nothing)
  where
    made kind size = Column {heading = name, kind, size, role}
    role
      | isJust coordinate = Coordinate
      | isOfTexts = Texts
      | otherwise = Further
    coordinate
      | value name `notElem` coordinateNames coordinates = Nothing
      | value name == Name "angle" = Just Type.angle
      | otherwise = Just Type.len

-- | Records the heading of a column, for editors. The columns of the coordinates belong to the
-- language.
mentionColumn :: Column -> Infer ()
mentionColumn Column {heading = Located at (Name text), kind, role} = case role of
  Further -> Inference.mention at (Just at) text (Inference.Valued kind)
  Coordinate -> described ("the " <> text <> " of the points of the table")
  Texts -> described "a column of texts, which are for people only"
  where
    described = Inference.mention at Nothing text . Inference.Described

-- | Reports every column whose name an earlier column has. The report also points at the first such
-- column.
reportRepeated :: [Located Name] -> Infer ()
reportRepeated names = mapM_ report (zip [0 ..] names)
  where
    report (i, name) = case [n | n <- take i names, value n == value name] of
      first : _ -> mistake (ColumnTwice (region name) (value name) (region first))
      [] -> pure ()

-- | Reports a column that has the name of a constant of the language. In a value along a curve the
-- name could mean the column or the constant.
reportConstant :: Located Name -> Infer ()
reportConstant (Located at name@(Name text)) =
  when
    (maybe False Builtin.isConstant (Builtin.lookup text))
    (Inference.mistake (NameTaken at name unwritten []))

-- | The type of a table that has the given columns.
typeOfTable :: [Column] -> Type
typeOfTable columns =
  Type.Table
    (Type.Fields [(Name.text <$> heading c, kind c) | c <- columns, isExtra c])

-- | The further columns with their dimensions, and the rows in the order of the text. The argument
-- @rows@ has them in reverse order. The cells of a row are put into the order of
-- 'coordinateNames'; the further columns follow. @unit@ is the unit of the file that contains the
-- @table@ statement; it also holds for the numbers of a table file.
columnsAndRows :: LengthUnit -> PointColumns -> [Column] -> [Row] -> Deferred Columns
columnsAndRows unit coordinates columns rows sol =
  Columns
    coordinates
    [(value (heading c), sol (Type.dimensionOf (kind c))) | c <- columns, isExtra c]
    (resolveAll sol (map (cellsOf order sizes) (joinRows rows)))
  where
    sizes =
      [ fromMaybe (Dimension.defaultUnit unit (sol (Type.dimensionOf (kind c)))) (size c)
        | c <- columns
      ]
    numbered = zip [0 :: Int ..] columns
    order =
      [i | name <- coordinateNames coordinates, (i, c) <- numbered, value (heading c) == name]
        <> [i | (i, c) <- numbered, isExtra c]

-- Rows

-- | One or more rows of a table.
data Row
  = -- | several rows of numbers without units, as they come from a file
    Numbers NumberTable
  | -- | one row of numbers without units
    Literals Region (PrimArray Double)
  | -- | one row with at least one cell that is another expression
    Cells Region [Cell]

-- | A cell: a number, in the unit of its column, or another expression.
data Cell = Literal Region Double | Written (Deferred Checked.Expr)

-- | Checks the lines of a table below the headings. The rows of the result are in reverse order.
rowsOf :: TypingEnvironment -> [Column] -> [Surface.TableLine] -> Infer [Row]
rowsOf env columns = go 1 []
  where
    go number found ls = case ls of
      [] -> pure found
      line : rest ->
        row env columns number line >>= \r ->
          go (number + rowCount (value line)) (maybe found (: found) r) rest
    rowCount line = case line of
      Surface.Numbers numbers -> NumberTable.count numbers
      _ -> 1

-- | Checks a line of a table below the headings. @number@ is the number, from 1, of the first row
-- that the line gives. 'Nothing' if the line contains a mistake.
row :: TypingEnvironment -> [Column] -> Int -> Surface.TableLine -> Infer (Maybe Row)
row env columns number (Located at line) = case line of
  Surface.Header headings ->
    Nothing
      <$ mistake (HeadingsRepeated at [region n | Surface.Heading n _ <- NonEmpty.toList headings])
  Surface.BrokenLine -> Nothing <$ Inference.taint
  Surface.Numbers numbers
    | NumberTable.width numbers /= length columns ->
      Nothing
        <$ mapM_
          ( \k ->
              wrongLength
                (NumberTable.regionOf numbers k)
                (number + k)
                (NumberTable.width numbers)
                []
          )
          [0 .. NumberTable.count numbers - 1]
    | otherwise -> pure (Just (Numbers numbers))
  Surface.Entries cells
    | length cells /= length columns ->
      Nothing <$ wrongLength at number (length cells) (map cellRegion (NonEmpty.toList cells))
    | otherwise -> do
      cells' <- zipWithM (cell env) columns (NonEmpty.toList cells)
      let literals = PrimArray.primArrayFromList <$> traverse literalOf cells'
      pure $! Just $! maybe (Cells at cells') (Literals at) literals
  where
    wrongLength rowRegion k count written =
      mistake (RowLength rowRegion k (length columns) count written)
    literalOf c = case c of
      Literal _ x -> Just x
      Written _ -> Nothing

-- | Checks a cell. The column @c@ gives the type that a cell with an expression must have.
cell :: TypingEnvironment -> Column -> Surface.Cell -> Infer Cell
cell env c given = case given of
  Surface.TextCell text -> do
    let wrong = TextAsValue (region text) (value (heading c)) (role c == Coordinate)
    unless (role c == Texts) (mistake wrong)
    pure (Literal (region text) 0)
  Surface.ValueCell e -> case literalOf e of
    Just x -> pure $! Literal (region e) x
    Nothing -> Written <$> expect env (kind c) e
  where
    literalOf (Located _ written) = case written of
      Surface.Literal (Numeral _ x) Nothing -> Just x
      Surface.Negate inner -> negate <$> literalOf inner
      _ -> Nothing

-- | The region of a cell.
cellRegion :: Surface.Cell -> Region
cellRegion c = case c of
  Surface.ValueCell e -> region e
  Surface.TextCell t -> region t

-- | Reverses the rows, and joins neighbouring 'Literals' into one table of numbers.
joinRows :: [Row] -> [Row]
joinRows = go []
  where
    go done rows = case rows of
      [] -> done
      Literals at xs : before -> literals done [(at, xs)] before
      other : before -> go (other : done) before
    literals done found rows = case rows of
      Literals at xs : before -> literals done ((at, xs) : found) before
      _ -> go (Numbers (NumberTable.fromList found) : done) rows

-- | The cells of one or more rows. @order@ gives, for each column of the result, the index from 0
-- of this column in the program's table. @sizes@ has a factor for each column of the program's
-- table. Numbers without units are multiplied by it.
cellsOf :: [Int] -> [Double] -> Row -> Deferred Cells
cellsOf order sizes rows sol = case rows of
  Numbers numbers -> inOrder numbers
  Literals at xs -> inOrder (NumberTable.fromList [(at, xs)])
  Cells at cells ->
    let es = zipWith expression sizes cells
     in foldr seq (Checked.Written at [es !! i | i <- order]) es
  where
    inOrder = Checked.Numbers . NumberTable.selectColumns [(i, sizes !! i) | i <- order]
    expression s c = case c of
      Literal at x -> Located at (Checked.Number (x * s))
      Written e -> e sol

-- Ciphers

-- | Checks a cipher on a curve whose table has the columns @known@. If a mistake that is already
-- reported makes the columns unknown, @known@ and the result are 'Nothing'. A wrong digit or a
-- wrong number of values is reported, and also gives 'Nothing'.
cipher ::
  TypingEnvironment ->
  Maybe [(Located Text, Type)] ->
  Surface.Cipher ->
  Infer (Maybe (Deferred Checked.Cipher))
cipher env known (Located at (Surface.Cipher (Located digitRegion digit) given)) =
  case recalculation env columns (Located digitRegion (digits digit)) (NonEmpty.toList given) of
    Just checked
      | isNothing known -> Nothing <$ Inference.taint
      | otherwise -> Just . (Located at .) <$> checked
    Nothing
      | digits digit `elem` ["1", "2", "4", "6"] ->
        Nothing <$ mistake (CipherMisfit at (digits digit) digitRegion values)
      | otherwise -> Nothing <$ mistake (NoSuchCipher digitRegion (digits digit) at values)
  where
    values = map region (NonEmpty.toList given)
    columns = fromMaybe [] known

-- | Checks the values of a cipher with the given digit. 'Nothing' if there is no cipher with this
-- digit and this number of values.
recalculation ::
  TypingEnvironment ->
  [(Located Text, Type)] ->
  Located Text ->
  [Surface.Expr] ->
  Maybe (Infer (Deferred Checked.Cipher_))
recalculation env columns digit values = case (value digit, values) of
  ("1", [a, b]) -> Just (growing a b absent absent)
  ("1", [a, b, m]) -> Just (growing a b (present (angleAlong m)) absent)
  ("1", [a, b, p, q]) -> Just (growing a b absent (present (between p q)))
  ("1", [a, b, m, p, q]) ->
    Just (growing a b (present (angleAlong m)) (present (between p q)))
  ("2", [h]) -> Just (apply2 Checked.Constant (constant h) absent)
  ("2", [h, m]) -> Just (apply2 Checked.Constant (constant h) (present (angleAlong m)))
  ("4", [m, h]) -> Just (apply3 Checked.Bevelled (angleAlong m) (lengthAlong h) absent)
  ("4", [m, h, d]) ->
    Just (apply3 Checked.Bevelled (angleAlong m) (lengthAlong h) (present (constant d)))
  ("6", [h]) -> Just (apply2 Checked.Pointwise (lengthAlong h) absent)
  ("6", [h, m]) -> Just (apply2 Checked.Pointwise (lengthAlong h) (present (angleAlong m)))
  _ -> Nothing
  where
    growing a b bevel points =
      (\f points' sol -> f sol (points' sol))
        <$> apply3 Checked.Growing (constant a) (constant b) bevel
          <*> points
    apply2 f a b = (\a' b' sol -> f (a' sol) (b' sol)) <$> a <*> b
    apply3 f a b c = (\a' b' c' sol -> f (a' sol) (b' sol) (c' sol)) <$> a <*> b <*> c
    absent = pure (const Nothing)
    present = fmap (Just .)
    constant = constantLength env columns digit
    lengthAlong = valueAlong env columns Type.len
    angleAlong = valueAlong env columns Type.angle
    between p q =
      (\p' q' sol -> (p' sol, q' sol)) <$> expect env Type.aPoint p <*> expect env Type.aPoint q

-- | Checks a length that is the same along the whole piece. It must not name a column. @digit@ is
-- that of the cipher, for reports.
constantLength ::
  TypingEnvironment ->
  [(Located Text, Type)] ->
  Located Text ->
  Surface.Expr ->
  Infer (Deferred Checked.Expr)
constantLength env columns digit e =
  case [(r, n) | (r, n) <- freeNames e, n `elem` map (Name . value . fst) columns] of
    (r, n) : _ -> zero e <$ mistake (ColumnForWholePiece r (value digit) (region digit) n)
    [] -> expect env Type.len e

-- | Checks a value of type @t@ that may vary along a curve. It may name the columns of the curve's
-- table.
valueAlong ::
  TypingEnvironment ->
  [(Located Text, Type)] ->
  Type ->
  Surface.Expr ->
  Infer (Deferred Checked.Expr)
valueAlong env columns t e = do
  unknown <- catMaybes <$> traverse unknownName (freeNames e)
  mapM_ (\(r, n) -> mistake (NoColumn r n (map (value . fst) columns))) unknown
  if null unknown
    then Column.inScope columns (expect env t e)
    else pure (zero e)
  where
    unknownName (r, n@(Name text)) = do
      binding <- Inference.find n
      let isKnown = text `elem` map (value . fst) columns || isJust (Builtin.lookup text)
      pure (if isNothing binding && not isKnown then Just (r, n) else Nothing)

-- | A term that takes the place of a value that is reported as wrong.
zero :: Surface.Expr -> Deferred Checked.Expr
zero e = const (Located (region e) (Checked.Number 0))

-- | The names that an expression uses as values, with their regions. Names that the expression
-- binds itself, and names of functions that it calls, are left out.
freeNames :: Surface.Expr -> [(Region, Name)]
freeNames (Located at e) = case e of
  Surface.Literal _ _ -> []
  Surface.Variable name -> [(at, name)]
  Surface.Call _ arguments -> concatMap inArgument (NonEmpty.toList arguments)
  Surface.Negate a -> freeNames a
  Surface.Not a -> freeNames a
  Surface.Binary _ a b -> freeNames a <> freeNames b
  Surface.Range a b c -> freeNames a <> freeNames b <> maybe [] freeNames c
  Surface.If c a b -> concatMap freeNames [c, a, b]
  Surface.Pair a b -> freeNames a <> freeNames b
  Surface.Triple a b c -> concatMap freeNames [a, b, c]
  Surface.List es -> concatMap freeNames es
  Surface.Each a name from -> freeNames from <> filter ((/= value name) . snd) (freeNames a)
  where
    inArgument a = case a of
      Surface.Given x -> freeNames x
      Surface.Chosen _ x -> freeNames x
      Surface.Ranked _ -> []

-- | Records a mistake in a table or a piece.
mistake :: PieceError -> Infer ()
mistake = Inference.mistake . InPiece

-- Joggles

-- | Checks a joggle. Its two x coordinates, its depth and its radius must be lengths.
joggle :: TypingEnvironment -> Surface.Joggle -> Infer (Deferred Checked.Joggle)
joggle env (Located at (Surface.Joggle from to depth radius)) = do
  from' <- len from
  to' <- len to
  depth' <- len depth
  radius' <- len radius
  pure (\sol -> Located at (Checked.Joggle (from' sol) (to' sol) (depth' sol) (radius' sol)))
  where
    len = expect env Type.len
