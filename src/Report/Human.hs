{-# OPTIONS_GHC -O0 #-}

-- | Rendering of reports for a person at a terminal: heading, excerpts with marks, sentences,
-- hints.
module Report.Human
  ( Colour (..),
    render,
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

-- | Use of the terminal's colours.
data Colour = Coloured | Plain
  deriving stock (Eq, Show)

-- | Kind of a part of the rendering; it decides the colour.
data Role = Severe Severity | Title | Frame | Secondary | Advice

-- | Renders one report. The path names the file of a report that has no region in the program.
render :: Colour -> Text -> Source -> Report -> Text
render colour path source report = Text.unlines (heading : location <> body <> advice)
  where
    r = cleaned report
    painted = paint colour
    ReportCode code = Report.code r
    heading =
      painted (Severe (severity r)) (Report.severityWord (severity r) <> "[" <> code <> "]")
        <> painted Title (": " <> title r)
    marks = case place r of
      InSource region -> (True, Label region (label r)) : map (False,) (others r)
      InTape _ -> map (False,) (others r)
      InFile -> map (False,) (others r)
    ordered = sortOn (\(_, Label region _) -> start region) marks
    excerpts =
      [ (isMain, e, text)
        | ((isMain, Label _ text), e) <-
            zip ordered (Excerpt.excerpts source [region | (_, Label region _) <- ordered])
      ]
    gutter = maximum (1 : [Text.length (number' e) | (_, e, _) <- excerpts])
    bar = Text.replicate (gutter + 1) " " <> painted Frame "|"
    location = [Text.replicate gutter " " <> painted Frame "--> " <> address | address /= ""]
    address = case place r of
      InSource region -> positionText (Region.position source (start region))
      InTape row -> path <> ", row " <> Decimal.whole row
      InFile -> path
    positionText Position {file, line, column} =
      file <> ":" <> Decimal.whole line <> ":" <> Decimal.whole column
    body = concat (zipWith excerptLines (Nothing : map Just excerpts) excerpts)
    -- Two marks on one line share it; another file gets a heading.
    excerptLines before (isMain, e, text) =
      [bar | not (isSame e)]
        <> [ Text.replicate gutter " " <> painted Frame "::: " <> positionText (Excerpt.place e)
             | fileOf e /= fileBefore
           ]
        <> [ painted Frame (Text.justifyRight gutter ' ' (number' e) <> " |") <> " " <> shown e
             | not (isSame e)
           ]
        <> [bar <> " " <> Text.replicate (indent e) " " <> mark isMain e text]
      where
        fileBefore = maybe mainPlace (\(_, b, _) -> fileOf b) before
    fileOf e = let Position {file} = Excerpt.place e in file
    mainPlace = case place r of
      InSource region -> let Position {file} = Region.position source (start region) in file
      _ -> Region.mainFile source
    mark isMain e text =
      let role = if isMain then Severe (severity r) else Secondary
          sign = if isMain then "^" else "-"
       in painted
            role
            (Text.replicate (width e) sign <> (if text == "" then "" else " " <> text))
    advice =
      [bar | not (null excerpts) && not (null (message r) && null (hints r))]
        <> concatMap (adviceLines "") (message r)
        <> concatMap (adviceLines "hint: ") (hints r)
    adviceLines kind text = case wrap (76 - Text.length kind) text of
      [] -> []
      first : rest ->
        (lead <> painted Frame "= " <> painted Advice kind <> first) :
        map ((lead <> "  " <> Text.replicate (Text.length kind) " ") <>) rest
    lead = Text.replicate (gutter + 1) " "
    number' e = Decimal.whole (line (Excerpt.place e))

-- | Replaces control characters in all words of a report. Excerpts do that for source lines.
cleaned :: Report -> Report
cleaned r =
  r
    { title = clean (title r),
      label = clean (label r),
      others = [Label region (clean text) | Label region text <- others r],
      message = map clean (message r),
      hints = map clean (hints r)
    }
  where
    clean = Excerpt.visible

-- | Counts errors and warnings in a last line; empty without reports.
summary :: Colour -> [Report] -> Text
summary colour reports = case (count "error" errors, count "warning" warnings) of
  ("", "") -> ""
  ("", w) -> paint colour (Severe Warning) w <> "\n"
  (e, "") -> paint colour (Severe Error) e <> "\n"
  (e, w) -> paint colour (Severe Error) e <> ", " <> paint colour (Severe Warning) w <> "\n"
  where
    errors = length (filter Report.isError reports)
    warnings = length reports - errors
    count word n
      | n == 0 = ""
      | n == 1 = "1 " <> word
      | otherwise = Decimal.whole n <> " " <> word <> "s"

-- | Breaks a text at spaces into lines of at most @limit@ characters. Line ends of the text remain.
-- A longer word gets a line of its own.
wrap :: Int -> Text -> [Text]
wrap limit = concatMap line . Text.lines
  where
    line text
      | Text.length text <= limit = [text]
      | otherwise = case Text.words text of
        [] -> []
        first : rest -> go first rest
    go current ws = case ws of
      [] -> [current]
      w : rest
        | Text.length current + 1 + Text.length w <= limit -> go (current <> " " <> w) rest
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
