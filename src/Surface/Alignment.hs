-- | Rows of a program's text, and how their columns line up.
module Surface.Alignment
  ( AlignedLine (..),
    LineText (..),
    AlignmentColumn (..),
    plain,
    gap,
    aligned,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text
import Surface.PrettyPrinter (widest)

-- | One line of a program.
data AlignedLine = AlignedLine
  { indent :: Int,
    cells :: LineText,
    -- | it goes on with what the row above began
    continues :: Bool
  }
  deriving stock (Eq, Show)

data LineText
  = Whole Text
  | -- | two cells, the second of which lines up with its neighbours
    LineText AlignmentColumn Text Text
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
plain :: AlignedLine -> Text
plain row = case cells row of
  Whole text -> text
  LineText column first second -> first <> gap column <> second

-- | What stands between two cells at least.
gap :: AlignmentColumn -> Text
gap column = case column of
  Values -> " "
  Definitions -> " "
  Links -> "   "
  SettingValues -> " "

-- | The texts of rows that follow one another, their second cells lined up wherever rows of one
-- kind and indentation stand together. A row of one cell among them does no harm.
aligned :: [AlignedLine] -> [Text]
aligned rows = case rows of
  [] -> []
  row : rest -> case cells row of
    Whole _ -> written row : aligned rest
    LineText column _ _ ->
      let (run, others) = span (belongs row column) rest
       in lineUp (row : run) <> aligned others

-- | Whether a row can stand in a run that a row with such a column began.
belongs :: AlignedLine -> AlignmentColumn -> AlignedLine -> Bool
belongs begin column row =
  indent row == indent begin && not (continues row) && case cells row of
    Whole _ -> single
    LineText other _ _ -> other == column
  where
    -- Links may be left out, and some settings have no value.
    single = case column of
      Values -> False
      Definitions -> False
      Links -> simple
      SettingValues -> simple
    simple = not (Text.any (`elem` ("{}" :: String)) (plain row))

lineUp :: [AlignedLine] -> [Text]
lineUp run = if any tooLong padded then map written run else padded
  where
    padded = map pad run
    tooLong text = Text.length text > widest
    width = maximum [Text.length first | AlignedLine {cells = LineText _ first _} <- run]
    pad row = case cells row of
      Whole _ -> written row
      LineText column first second ->
        spaces (indent row) <> Text.justifyLeft width ' ' first <> gap column <> second

written :: AlignedLine -> Text
written row = spaces (indent row) <> plain row

spaces :: Int -> Text
spaces n = Text.replicate n " "
