-- | Tables and the pieces of curves that are made of them: columns, ciphers, joggles.
module Checked.Piece
  ( Checker (..),
    table,
    columnsOf,
    withColumns,
    cipher,
    joggle,
    unitType,
  )
where

import Base.Name (Name (..))
import Base.NumberTable (NumberTable)
import Base.NumberTable qualified as NumberTable
import Base.Region (Located (..), Region)
import Checked.Builtin qualified as Builtin
import Checked.Deferred (Deferred, resolveAll)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..))
import Checked.Inference (Infer, Solution)
import Checked.Inference qualified as Inference
import Checked.Syntax (Cells, Columns (..))
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Monad (when, zipWithM)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes, fromMaybe, isNothing)
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Text (Text)
import Surface.Syntax qualified as Surface
import Surface.Token (Numeral (..), Unit (..))

-- | Checks a value of a type.
newtype Checker = Checker {expect :: Type -> Surface.Expr -> Infer (Solution -> Checked.Expr)}

-- Tables

-- | A column of a table: its name, its type, the size of its bare numbers if its heading tells
-- their unit.
data Column = Column {called :: Located Name, kind :: Type, size :: Maybe Double}

-- | The columns and the rows of a table, and its type.
table :: Checker -> Located Name -> [Surface.TableLine] -> Infer (Type, Solution -> Columns)
table checker name written = case written of
  Located at (Surface.Header headings) : rows -> do
    columns <- traverse column (NonEmpty.toList headings)
    mapM_ twice (zip [0 ..] columns)
    mapM_ (meant . called) columns
    mapM_
      (\n -> when (null (named n columns)) (Inference.mistake (ColumnMissing at (Name n))))
      ["x", "y"]
    rows' <- rowsOf checker columns rows
    let extra = [c | c <- columns, value (called c) `notElem` map Name ["x", "y"]]
        order =
          concatMap (`named` columns) ["x", "y"]
            <> [ i
                 | (i, c) <- zip [0 ..] columns,
                   value (called c) `elem` map (value . called) extra
               ]
    pure
      ( Type.Table
          (Type.Fields [(text, kind c) | c <- extra, let Located _ (Name text) = called c]),
        \sol ->
          let sizes =
                [ fromMaybe (Dimension.defaultUnit (sol (Type.dimensionOf (kind c)))) (size c)
                  | c <- columns
                ]
           in Columns
                [(value (called c), sol (Type.dimensionOf (kind c))) | c <- extra]
                (resolveAll sol (map (filled order sizes) (gathered rows')))
      )
    where
      twice (i, c) =
        case [ region (called b)
               | b <- take i columnsBefore,
                 value (called b) == value (called c)
             ] of
          before : _ ->
            Inference.mistake (ColumnTwice (region (called c)) (value (called c)) before)
          [] -> pure ()
        where
          columnsBefore =
            [Column n Type.Wrong Nothing | Surface.Heading n _ <- NonEmpty.toList headings]
      -- In what is asked along a curve of the table a column stands by its bare name, as a constant
      -- does.
      meant (Located place n@(Name text)) =
        when
          (maybe False Builtin.isConstant (Builtin.lookup text))
          (Inference.mistake (NameTaken place n))
  Located _ Surface.BrokenLine : _ -> missing <$ Inference.taint
  _ -> missing <$ Inference.mistake (HeadingsMissing (maybe (region name) region (firstOf written)))
  where
    missing = (Type.Wrong, const (Columns [] []))
    named n columns = [i | (i, c) <- zip [0 :: Int ..] columns, value (called c) == Name n]
    firstOf xs = case xs of
      [] -> Nothing
      x : _ -> Just x

-- | The cells of rows, brought into order, with the sizes of the bare numbers of their columns.
filled :: [Int] -> [Double] -> Row -> Deferred Cells
filled order sizes found sol = case found of
  Numbers rows -> arranged rows
  Bares at xs -> arranged (NumberTable.fromList [(at, xs)])
  Cells at cells ->
    let es =
          zipWith expression sizes cells
     in foldr seq (Checked.Written at [es !! i | i <- order]) es
  where
    arranged = Checked.Numbers . NumberTable.arranged [(i, sizes !! i) | i <- order]
    expression s c = case c of
      Bare at x -> Located at (Checked.Number (x * s))
      Written later -> later sol

-- | Rows in order, given the last one first; those of bare numbers that follow one another
-- together.
gathered :: [Row] -> [Row]
gathered = go []
  where
    go behind rows = case rows of
      [] -> behind
      Bares at xs : before -> bare behind [(at, xs)] before
      other : before -> go (other : behind) before
    bare behind found rows = case rows of
      Bares at xs : before -> bare behind ((at, xs) : found) before
      _ -> go (Numbers (NumberTable.fromList found) : behind) rows

-- | The lengths x and y; what the others are is said by their unit, or by their use.
column :: Surface.Heading -> Infer Column
column (Surface.Heading name unit) = case (unit, value name) of
  (Just u, n) -> do
    let (t, factor) = unitType u
    when
      (n `elem` map Name ["x", "y"] && t /= Type.len)
      (Inference.mistake (Mismatch (region name) Type.len t []))
    pure (Column name t (Just factor))
  (Nothing, n)
    | n `elem` map Name ["x", "y"] -> pure (Column name Type.len Nothing)
    | otherwise -> do
      d <- Inference.freshDimension
      Inference.monomorphic d
      pure (Column name (Type.Quantity d) Nothing)

-- | Rows of bare numbers for all columns; one such row; one of other cells.
data Row = Numbers NumberTable | Bares Region (PrimArray Double) | Cells Region [Cell]

-- | The rows of lines, the last one first.
rowsOf :: Checker -> [Column] -> [Surface.TableLine] -> Infer [Row]
rowsOf checker columns = go 1 []
  where
    go number found ls = case ls of
      [] -> pure found
      line : rest ->
        row checker columns number line >>= \r ->
          go (number + rowsIn (value line)) (maybe found (: found) r) rest
    rowsIn line = case line of
      Surface.Numbers numbers -> NumberTable.count numbers
      _ -> 1

-- | The rows of a line, the first of which has this number.
row :: Checker -> [Column] -> Int -> Surface.TableLine -> Infer (Maybe Row)
row checker columns number (Located at line) = case line of
  Surface.Header _ -> Nothing <$ Inference.mistake (HeadingsRepeated at)
  Surface.BrokenLine -> Nothing <$ Inference.taint
  Surface.Numbers numbers
    | NumberTable.width numbers /= length columns ->
      Nothing
        <$ mapM_
          (\k -> wrongLength (NumberTable.place numbers k) (number + k) (NumberTable.width numbers))
          [0 .. NumberTable.count numbers - 1]
    | otherwise -> pure (Just (Numbers numbers))
  Surface.Entries cells
    | length cells /= length columns -> Nothing <$ wrongLength at number (length cells)
    | otherwise -> do
      cells' <- zipWithM (cell checker) columns (NonEmpty.toList cells)
      pure
        $! Just
        $! maybe (Cells at cells') (Bares at . PrimArray.primArrayFromList) (traverse bare cells')
  where
    wrongLength place k found = Inference.mistake (RowLength place k (length columns) found)
    bare c = case c of
      Bare _ x -> Just x
      Written _ -> Nothing

-- | What stands in a cell: a bare number, which has the unit of its column, or something else.
data Cell = Bare Region Double | Written (Solution -> Checked.Expr)

cell :: Checker -> Column -> Surface.Expr -> Infer Cell
cell checker c e = case bare e of
  Just x -> pure $! Bare (region e) x
  Nothing -> Written <$> expect checker (kind c) e
  where
    bare (Located _ written) = case written of
      Surface.Literal (Numeral _ x) Nothing -> Just x
      Surface.Negate inner -> negate <$> bare inner
      _ -> Nothing

-- | The columns that the values of a curve's or a table's points stand in.
-- | Not known of what is reported already.
columnsOf :: Type -> Infer (Maybe [(Text, Type)])
columnsOf t = do
  t' <- Inference.resolved t
  pure $ case t' of
    Type.Curve (Type.Fields cs) -> Just cs
    Type.Curve _ -> Nothing
    Type.Wrong -> Nothing
    _ -> Just []

-- | With the columns as values; their names win over those of the program.
withColumns :: Region -> [(Text, Type)] -> Infer a -> Infer a
withColumns at columns = Inference.withLocals [(Located at (Name text), t) | (text, t) <- columns]

-- Ciphers

-- | A recalculation of a curve with these columns, as far as they are known; nothing when there is
-- none such.
cipher ::
  Checker ->
  Maybe [(Text, Type)] ->
  Surface.Cipher ->
  Infer (Maybe (Solution -> Checked.Cipher))
cipher checker known (Located at (Surface.Cipher (Located place digit) given)) =
  case (digits digit, NonEmpty.toList given) of
    ("1", [a, b]) -> made (Checked.Growing <$$> one a <**> one b <**> none <**> none)
    ("1", [a, b, m]) -> made (Checked.Growing <$$> one a <**> one b <**> some (angle m) <**> none)
    ("1", [a, b, p, q]) ->
      made (Checked.Growing <$$> one a <**> one b <**> none <**> some (between p q))
    ("1", [a, b, m, p, q]) ->
      made (Checked.Growing <$$> one a <**> one b <**> some (angle m) <**> some (between p q))
    ("2", [h]) -> made (Checked.Constant <$$> one h <**> none)
    ("2", [h, m]) -> made (Checked.Constant <$$> one h <**> some (angle m))
    ("4", [m, h]) -> made (Checked.Bevelled <$$> angle m <**> len h <**> none)
    ("4", [m, h, d]) -> made (Checked.Bevelled <$$> angle m <**> len h <**> some (one d))
    ("6", [h]) -> made (Checked.Pointwise <$$> len h <**> none)
    ("6", [h, m]) -> made (Checked.Pointwise <$$> len h <**> some (angle m))
    (d, es)
      | d `elem` ["1", "2", "4", "6"] ->
        Nothing <$ Inference.mistake (CipherMisfit at d (length es))
      | otherwise -> Nothing <$ Inference.mistake (NoSuchCipher place d)
  where
    columns = fromMaybe [] known
    made later = case known of
      Just _ -> Just . (Located at .) <$> later
      Nothing -> Nothing <$ Inference.taint
    len = along Type.len
    -- One value for the whole piece.
    one e = case [(r, n) | (r, n) <- namesIn e, n `elem` map (Name . fst) columns] of
      (r, n) : _ ->
        const (Located (region e) (Checked.Number 0))
          <$ Inference.mistake (ColumnForWholePiece r (digits digit) n)
      [] -> expect checker Type.len e
    angle = along Type.angle
    point p = expect checker Type.aPoint p
    between p q = (\a b sol -> (a sol, b sol)) <$> point p <*> point q
    none = pure (const Nothing)
    some = fmap (Just .)
    f <$$> a = (f .) <$> a
    f <**> a = (\g x sol -> g sol (x sol)) <$> f <*> a
    -- A value at every point.
    along t e = do
      mapM_ (\(r, n) -> Inference.mistake (NoColumn r n (map fst columns))) =<< missing e
      absent <- not . null <$> missing e
      if absent
        then pure (const (Located (region e) (Checked.Number 0)))
        else withColumns (region e) columns (expect checker t e)
    missing e = catMaybes <$> traverse unknown (namesIn e)
    unknown (r, n@(Name text)) = do
      entry <- Inference.find n
      pure
        ( if isNothing entry && text `notElem` map fst columns && isNothing (Builtin.lookup text)
            then Just (r, n)
            else Nothing
        )

-- | The names in a value, as far as they are not its own.
namesIn :: Surface.Expr -> [(Region, Name)]
namesIn (Located at e) = case e of
  Surface.Literal _ _ -> []
  Surface.Variable name -> [(at, name)]
  Surface.Call _ arguments -> concatMap inArgument (NonEmpty.toList arguments)
  Surface.Negate a -> namesIn a
  Surface.Not a -> namesIn a
  Surface.Binary _ a b -> namesIn a <> namesIn b
  Surface.Range a b c -> namesIn a <> namesIn b <> maybe [] namesIn c
  Surface.If c a b -> concatMap namesIn [c, a, b]
  Surface.Pair a b -> namesIn a <> namesIn b
  Surface.Triple a b c -> concatMap namesIn [a, b, c]
  Surface.List es -> concatMap namesIn es
  Surface.Each a name from -> namesIn from <> filter ((/= value name) . snd) (namesIn a)
  where
    inArgument a = case a of
      Surface.Given x -> namesIn x
      Surface.Chosen _ x -> namesIn x
      Surface.Ranked _ -> []

joggle :: Checker -> Surface.Joggle -> Infer (Solution -> Checked.Joggle)
joggle checker (Located at (Surface.Joggle from to depth radius)) = do
  from' <- len from
  to' <- len to
  depth' <- len depth
  radius' <- len radius
  pure (\sol -> Located at (Checked.Joggle (from' sol) (to' sol) (depth' sol) (radius' sol)))
  where
    len = expect checker Type.len

-- Units

-- | What a unit measures, and its size in mm, radians and minutes.
unitType :: Unit -> (Type, Double)
unitType unit = case unit of
  Millimetre -> (Type.len, 1)
  Centimetre -> (Type.len, 10)
  Metre -> (Type.len, 1000)
  Inch -> (Type.len, 25.4)
  Degree -> (Type.angle, pi / 180)
  Radian -> (Type.angle, 1)
  MmPerMin -> (Type.feed, 1)
  MPerMin -> (Type.feed, 1000)
  InPerMin -> (Type.feed, 25.4)
  Rpm -> (Type.spindleSpeed, 1)
