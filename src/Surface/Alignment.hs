-- | Lines of a printed program. A line has one cell or two; a cell is a text such as the keyword of
-- a statement or its values. Second cells of neighbouring lines are aligned in a column.
module Surface.Alignment
  ( AlignedLine (..),
    LineCells (..),
    AlignmentColumn (..),
    unaligned,
    separator,
    render,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text
import Surface.PrettyPrinter (maxWidth)

-- | One line of a printed program.
data AlignedLine = AlignedLine
  { -- | the count of spaces before the line
    indent :: Int,
    cells :: LineCells,
    -- | true if the line continues the statement or item of the line above
    isContinuation :: Bool
  }
  deriving stock (Eq, Show)

-- | The text of a line, in one cell or two.
data LineCells
  = -- | one cell
    WholeLine Text
  | -- | two cells, the second aligned with the second cells of the neighbouring lines
    LineCells AlignmentColumn Text Text
  deriving stock (Eq, Show)

-- | The kinds of aligned columns. Only cells of one kind are aligned with one another.
data AlignmentColumn
  = -- | the values after the keywords of statements
    Values
  | -- | the @=@ of definitions
    Definitions
  | -- | the links after the elements of a contour
    Links
  | -- | the values after the keywords of settings
    SettingValues
  deriving stock (Eq, Show)

-- | The text of a line without indentation and alignment.
unaligned :: AlignedLine -> Text
unaligned row = case cells row of
  WholeLine text -> text
  LineCells column first second -> first <> separator column <> second

-- | The spaces between two cells of a line. Alignment adds further spaces before them.
separator :: AlignmentColumn -> Text
separator column = case column of
  Values -> " "
  Definitions -> " "
  Links -> "   "
  SettingValues -> " "

-- | Renders lines. Neighbouring lines with the same column and the same indentation form a run,
-- within which the second cells are aligned. A run of 'Links' or 'SettingValues' may contain lines
-- with one cell. A line that continues the line above it ends the run.
render :: [AlignedLine] -> [Text]
render rows = case rows of
  [] -> []
  row : rest -> case cells row of
    WholeLine _ -> indented row : render rest
    LineCells column _ _ ->
      let (run, others) = span (isAlignedWith row column) rest
       in align (row : run) <> render others

-- | Tells if the line @row@ belongs to the run of aligned lines that the line @begin@ begins.
-- @column@ is the column of @begin@.
isAlignedWith :: AlignedLine -> AlignmentColumn -> AlignedLine -> Bool
isAlignedWith begin column row =
  indent row == indent begin && not (isContinuation row) && case cells row of
    WholeLine _ -> isSingleAllowed
    LineCells other _ _ -> other == column
  where
    -- True if the run may contain a line with one cell: an element without a link, or a setting
    -- without a value. A line of one cell with a brace ends the run.
    isSingleAllowed = case column of
      Values -> False
      Definitions -> False
      Links -> hasNoBlock
      SettingValues -> hasNoBlock
    hasNoBlock = not (Text.any (`elem` ("{}" :: String)) (unaligned row))

-- | Renders a run with aligned second cells, or without alignment if a line would exceed
-- 'maxWidth'.
align :: [AlignedLine] -> [Text]
align run = if any isTooLong padded then map indented run else padded
  where
    padded = map pad run
    isTooLong text = Text.length text > maxWidth
    width = maximum [Text.length first | AlignedLine {cells = LineCells _ first _} <- run]
    pad row = case cells row of
      WholeLine _ -> indented row
      LineCells column first second ->
        spaces (indent row) <> Text.justifyLeft width ' ' first <> separator column <> second

-- | The text of a line with its indentation.
indented :: AlignedLine -> Text
indented row =
  spaces (indent row) <> unaligned row

spaces :: Int -> Text
spaces n = Text.replicate n " "
