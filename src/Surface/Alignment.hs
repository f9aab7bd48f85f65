-- | Rows of a program's text, and how their columns line up.
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

-- | One line of a program.
data AlignedLine = AlignedLine
  { indent :: Int,
    cells :: LineCells,
    -- | it goes on with what the row above began
    isContinuation :: Bool
  }
  deriving stock (Eq, Show)

data LineCells
  = WholeLine Text
  | -- | two cells, the second of which lines up with its neighbours
    LineCells AlignmentColumn Text Text
  deriving stock (Eq, Show)

-- | What lines up.
data AlignmentColumn
  = -- | the values behind the first words of statements
    Values
  | -- | the @=@ of definitions
    Definitions
  | -- | the links behind the elements of a contour
    Links
  | -- | the values behind the first words of settings
    SettingValues
  deriving stock (Eq, Show)

-- | The text of a row without its indentation, as if it stood alone.
unaligned :: AlignedLine -> Text
unaligned row = case cells row of
  WholeLine text -> text
  LineCells column first second -> first <> separator column <> second

-- | What stands between two cells at least.
separator :: AlignmentColumn -> Text
separator column = case column of
  Values -> " "
  Definitions -> " "
  Links -> "   "
  SettingValues -> " "

-- | The texts of rows that follow one another, their second cells lined up wherever rows of one
-- kind and indentation stand together. A row of one cell among them does no harm.
render :: [AlignedLine] -> [Text]
render rows = case rows of
  [] -> []
  row : rest -> case cells row of
    WholeLine _ -> written row : render rest
    LineCells column _ _ ->
      let (run, others) = span (belongs row column) rest
       in lineUp (row : run) <> render others

-- | Whether a row can stand in a run that a row with such a column began.
belongs :: AlignedLine -> AlignmentColumn -> AlignedLine -> Bool
belongs begin column row =
  indent row == indent begin && not (isContinuation row) && case cells row of
    WholeLine _ -> single
    LineCells other _ _ -> other == column
  where
    -- Links may be left out, and some settings have no value.
    single = case column of
      Values -> False
      Definitions -> False
      Links -> simple
      SettingValues -> simple
    simple = not (Text.any (`elem` ("{}" :: String)) (unaligned row))

lineUp :: [AlignedLine] -> [Text]
lineUp run = if any tooLong padded then map written run else padded
  where
    padded = map pad run
    tooLong text = Text.length text > maxWidth
    width = maximum [Text.length first | AlignedLine {cells = LineCells _ first _} <- run]
    pad row = case cells row of
      WholeLine _ -> written row
      LineCells column first second ->
        spaces (indent row) <> Text.justifyLeft width ' ' first <> separator column <> second

written :: AlignedLine -> Text
written row = spaces (indent row) <> unaligned row

spaces :: Int -> Text
spaces n = Text.replicate n " "
