{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Rendering of reports for a person at a terminal: heading, source lines with marks, sentences
-- and hints. Line numbers and a vertical bar to the left of the source lines form the /gutter/.
module Report.Human
  ( Colour (..),
    render,
    renderWithin,
    usualWidth,
    summary,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Position (..), Region (..), Source)
import Base.Region qualified as Region
import Data.List (sortOn)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Excerpt (Excerpt (indent, isSame, shown, width))
import Report.Excerpt qualified as Excerpt
import Report.Report (Label (..), Report (..), ReportCode (..), ReportPlace (..), Severity (..))
import Report.Report qualified as Report
import System.Console.ANSI.Codes qualified as Ansi
import Text.DocLayout (realLength)

-- | The choice between coloured and plain text.
data Colour = Coloured | Plain
  deriving stock (Eq, Show)

-- | Kind of a text in the rendering, which decides its colour.
data Role
  = -- | severity and code, and the mark of the main region, which is the report's place
    Severe Severity
  | -- | title of the report
    Title
  | -- | line numbers, bars and arrows
    Frame
  | -- | marks of other regions
    Secondary
  | -- | the word @hint@
    Advice

-- | Facts that all parts of one rendering use.
data Layout = Layout
  { -- | colours a text for its role
    painted :: Role -> Text -> Text,
    report :: Report,
    source :: Source,
    -- | width of the line numbers in characters: the count of digits of the largest one
    gutter :: Int,
    -- | count of columns to the right of the gutter, of its bar and of the space behind the bar
    room :: Int
  }

-- | Mark of a region. The components: true for the report's place and false for other regions; the
-- excerpt; the text beside the mark, which may be empty.
type Marked = (Bool, Excerpt, Text)

-- | Renders one report as lines of text for a page of the usual width. @path@ is the file's name,
-- which is printed if the report's place is not a region of the program. It is empty if the report
-- concerns no file.
render :: Colour -> Text -> Source -> Report -> Text
render = renderWithin usualWidth

-- | The count of columns of a page that is not a terminal, such as a file.
usualWidth :: Int
usualWidth = 120

-- | Renders one report, as 'render' does, for a terminal of @columns@ columns. Source lines,
-- labels, sentences and hints keep to this width. The title and the position stay on one line each,
-- so that they can be searched for. A terminal of less than 40 columns gets lines for 40.
renderWithin :: Int -> Colour -> Text -> Source -> Report -> Text
renderWithin columns colour path source given =
  Text.unlines (heading layout : location layout path <> body <> remedies)
  where
    report = cleaned given
    marks = marksOf source report
    gutter = maximum (1 : [Text.length (Decimal.whole n) | (_, n, _) <- marks])
    room = max 40 columns - gutter - 3
    layout = Layout {painted = paint colour, report, source, gutter, room}
    excerpts = markedExcerpts layout marks
    remedies = advice layout (not (null excerpts))
    body = concat (zipWith (excerptLines layout) (Nothing : map Just excerpts) excerpts)

-- | Severity, code and title.
heading :: Layout -> Text
heading Layout {painted, report} =
  painted (Severe (severity report)) (Report.severityWord (severity report) <> "[" <> code <> "]")
    <> painted Title (": " <> title report)
  where
    ReportCode code = Report.code report

-- | Line with the position of the report; the empty list for a report that concerns no file.
location :: Layout -> Text -> [Text]
location Layout {painted, report, source, gutter} path =
  [Text.replicate gutter " " <> painted Frame "--> " <> address | address /= ""]
  where
    address = case place report of
      InSource region -> positionText (Region.position source (start region))
      InTape row -> path <> ", row " <> Decimal.whole row
      InFile -> path
      InCommandLine -> "the command line"

-- | All regions of a report in the order of the source: true for the report's place and false for
-- others, the number of the line, and the label.
marksOf :: Source -> Report -> [(Bool, Int, Label)]
marksOf source report =
  [ (isMain, line (Region.position source (start region)), label')
    | (isMain, label'@(Label region _)) <- sortOn (\(_, Label region _) -> start region) marks
  ]
  where
    marks = case place report of
      InSource region -> (True, Label region (label report)) : map (False,) (others report)
      InTape _ -> map (False,) (others report)
      InFile -> map (False,) (others report)
      InCommandLine -> map (False,) (others report)

-- | Excerpts of the marks of 'marksOf'.
markedExcerpts :: Layout -> [(Bool, Int, Label)] -> [Marked]
markedExcerpts Layout {source, room} marks =
  [ (isMain, e, text)
    | ((isMain, _, Label _ text), e) <-
        zip marks (Excerpt.excerpts room source [region | (_, _, Label region _) <- marks])
  ]

-- | Lines that show a mark below its source line. @before@ is the previous mark, nothing for the
-- first. If both marks are under the same line, that line is printed only once. If they are in
-- different files, the position of the new mark is printed first.
excerptLines :: Layout -> Maybe Marked -> Marked -> [Text]
excerptLines layout@Layout {painted, report, source, gutter, room} before (isMain, e, text) =
  [bar layout | not (isSame e)]
    <> [ Text.replicate gutter " " <> painted Frame "::: " <> positionText (Excerpt.place e)
         | fileOf e /= fileBefore
       ]
    <> [ painted Frame (Text.justifyRight gutter ' ' (lineNumber e) <> " |") <> " " <> shown e
         | not (isSame e)
       ]
    <> [ bar layout <> " " <> Text.replicate column " " <> painted role line'
         | (column, line') <- labelled room e sign text
       ]
  where
    fileBefore = maybe mainFile (\(_, b, _) -> fileOf b) before
    fileOf excerpt = let Position {file} = Excerpt.place excerpt in file
    mainFile = case place report of
      InSource region -> let Position {file} = Region.position source (start region) in file
      InTape _ -> Region.mainFile source
      InFile -> Region.mainFile source
      InCommandLine -> Region.mainFile source
    role = if isMain then Severe (severity report) else Secondary
    sign = Text.replicate (width e) (if isMain then "^" else "-")

-- | The mark of an excerpt with its label, as lines, each with the column at which it begins. The
-- label is beside the mark, or below it if there is too little room beside it.
labelled :: Int -> Excerpt -> Text -> Text -> [(Int, Text)]
labelled room e sign text
  | text == "" = [(indent e, sign)]
  | realLength text <= beside = [(indent e, sign <> " " <> text)]
  | beside >= narrowest = case wrap beside text of
    [] -> [(indent e, sign)]
    first : rest -> (indent e, sign <> " " <> first) : map (indent e + width e + 1,) rest
  | otherwise = (indent e, sign) : map (below,) (wrap (room - below) text)
  where
    beside = room - indent e - width e - 1
    below = max 0 (min (indent e) (room - min narrowest (realLength text)))
    narrowest = 30

-- | Sentences and hints, broken into lines of at most 76 columns to the right of the gutter. If
-- @hasExcerpts@ is true, an empty line of the gutter separates them from the excerpts above.
advice :: Layout -> Bool -> [Text]
advice layout@Layout {painted, report, gutter, room} hasExcerpts =
  [bar layout | hasExcerpts && not (null (message report) && null (hints report))]
    <> concatMap (adviceLines "") (message report)
    <> concatMap (adviceLines "hint: ") (hints report)
  where
    adviceLines kind text = case wrap (min 76 room - Text.length kind) text of
      [] -> []
      first : rest ->
        (lead <> painted Frame "= " <> painted Advice kind <> first) :
        map ((lead <> "  " <> Text.replicate (Text.length kind) " ") <>) rest
    lead = Text.replicate (gutter + 1) " "

-- | Line of the gutter that has a bar but no line number.
bar :: Layout -> Text
bar Layout {painted, gutter} = Text.replicate (gutter + 1) " " <> painted Frame "|"

-- | Number of the line of an excerpt.
lineNumber :: Excerpt -> Text
lineNumber e = Decimal.whole (line (Excerpt.place e))

-- | Position as @file:line:column@, where lines and columns count from 1.
positionText :: Position -> Text
positionText Position {file, line, column} =
  file <> ":" <> Decimal.whole line <> ":" <> Decimal.whole column

-- | Replaces control characters in all texts of a report, because they could control the terminal.
-- Those in source lines are replaced by "Report.Excerpt".
cleaned :: Report -> Report
cleaned r =
  r
    { title = clean (title r),
      label = clean (label r),
      others = [Label region (clean text) | Label region text <- others r],
      message = map clean (message r),
      hints = map clean (Report.remedies r),
      fixes = []
    }
  where
    clean = Excerpt.visible

-- | The last line after all reports: the counts of errors and warnings, and the command that
-- explains the first error, or the first warning if there is no error. It is empty if there are no
-- reports.
summary :: Colour -> [Report] -> Text
summary colour reports = case filter Report.isError reports <> reports of
  [] -> ""
  first : _ ->
    Text.intercalate ", " (count Error "error" <> count Warning "warning")
      <> ". ‘partc explain "
      <> codeOf first
      <> "’ explains "
      <> (if length reports == 1 then "it" else "the first")
      <> ".\n"
  where
    codeOf r = let ReportCode code = Report.code r in code
    count kind word = case length (filter ((== kind) . severity) reports) of
      0 -> []
      1 -> [paint colour (Severe kind) ("1 " <> word)]
      n -> [paint colour (Severe kind) (Decimal.whole n <> " " <> word <> "s")]

-- | Breaks a text at spaces into lines of at most @limit@ columns. Line ends in the text stay line
-- ends. A word longer than @limit@ gets a line of its own.
wrap :: Int -> Text -> [Text]
wrap limit = concatMap line . Text.lines
  where
    line text
      | realLength text <= limit = [text]
      | otherwise = case Text.words text of
        [] -> []
        first : rest -> go first rest
    go current ws = case ws of
      [] -> [current]
      w : rest
        | realLength current + 1 + realLength w <= limit -> go (current <> " " <> w) rest
        | otherwise -> current : go w rest

-- | Colours a text for its role. An empty text stays empty.
paint :: Colour -> Role -> Text -> Text
paint colour role text = case colour of
  Plain -> text
  Coloured | Text.null text -> text
  Coloured ->
    Text.pack (Ansi.setSGRCode (codes role)) <> text <> Text.pack (Ansi.setSGRCode [Ansi.Reset])

-- | Codes of a role for SGR, the "select graphic rendition" sequence of ECMA-48.
codes :: Role -> [Ansi.SGR]
codes role = case role of
  Severe Error -> [bold, foreground Ansi.Red]
  Severe Warning -> [bold, foreground Ansi.Yellow]
  Title -> [bold]
  Frame -> [bold, foreground Ansi.Blue]
  Secondary -> [bold, foreground Ansi.Blue]
  Advice -> [bold]
  where
    bold = Ansi.SetConsoleIntensity Ansi.BoldIntensity
    foreground = Ansi.SetColor Ansi.Foreground Ansi.Vivid
