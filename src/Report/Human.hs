{-# OPTIONS_GHC -O0 #-}

-- | Reports for a person at a terminal: title, source excerpt, sentences, hints.
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

-- | Whether to use the terminal's colours.
data Colour = Coloured | Plain
  deriving stock (Eq, Show)

-- | What a piece of the rendering is, which decides its colour.
data Role = Severe Severity | Title | Frame | Secondary | Advice

-- | One report; the path names the file it is about when it has no place in the program.
render :: Colour -> Text -> Source -> Report -> Text
render colour path source report = Text.unlines (heading : location <> body <> advice)
  where
    r = cleaned report
    paint' = paint colour
    ReportCode code = Report.code r
    heading =
      paint' (Severe (severity r)) (Report.severityWord (severity r) <> "[" <> code <> "]")
        <> paint' Title (": " <> title r)
    marks = case place r of
      InSource region -> (True, Label region (label r)) : map (False,) (others r)
      InTape _ -> map (False,) (others r)
      InFile -> map (False,) (others r)
    ordered = sortOn (\(_, Label region _) -> start region) marks
    excerpts =
      [ (isMain, e, words')
        | ((isMain, Label _ words'), e) <-
            zip ordered (Excerpt.excerpts source [region | (_, Label region _) <- ordered])
      ]
    gutter = maximum (1 : [Text.length (number' e) | (_, e, _) <- excerpts])
    bar = Text.replicate (gutter + 1) " " <> paint' Frame "|"
    location = [Text.replicate gutter " " <> paint' Frame "--> " <> where' | where' /= ""]
    where' = case place r of
      InSource region -> written (Region.position source (start region))
      InTape row -> path <> ", row " <> Decimal.whole row
      InFile -> path
    written Position {file, line, column} =
      file <> ":" <> Decimal.whole line <> ":" <> Decimal.whole column
    body = concat (zipWith shownAt (Nothing : map Just excerpts) excerpts)
    -- Nothing between two marks of one line; a heading where another file begins.
    shownAt before (isMain, e, words') =
      [bar | not (isSame e)]
        <> [ Text.replicate gutter " " <> paint' Frame "::: " <> written (Excerpt.place e)
             | fileOf e /= fileBefore
           ]
        <> [ paint' Frame (Text.justifyRight gutter ' ' (number' e) <> " |") <> " " <> shown e
             | not (isSame e)
           ]
        <> [bar <> " " <> Text.replicate (indent e) " " <> mark isMain e words']
      where
        fileBefore = maybe mainPlace (\(_, b, _) -> fileOf b) before
    fileOf e = let Position {file} = Excerpt.place e in file
    -- The excerpts begin in the file that the heading names.
    mainPlace = case place r of
      InSource region -> let Position {file} = Region.position source (start region) in file
      _ -> Region.mainFile source
    mark isMain e words' =
      let role = if isMain then Severe (severity r) else Secondary
          sign = if isMain then "^" else "-"
       in paint'
            role
            (Text.replicate (width e) sign <> (if words' == "" then "" else " " <> words'))
    advice =
      [bar | not (null excerpts) && not (null (message r) && null (hints r))]
        <> concatMap (noted "") (message r)
        <> concatMap (noted "hint: ") (hints r)
    noted kind words' = case wrap (76 - Text.length kind) words' of
      [] -> []
      first : rest ->
        (lead <> paint' Frame "= " <> paint' Advice kind <> first) :
        map ((lead <> "  " <> Text.replicate (Text.length kind) " ") <>) rest
    lead = Text.replicate (gutter + 1) " "
    number' e = Decimal.whole (line (Excerpt.place e))

-- | Without characters that a terminal would obey; the excerpt sees to its own.
cleaned :: Report -> Report
cleaned r =
  r
    { title = clean (title r),
      label = clean (label r),
      others = [Label region (clean words') | Label region words' <- others r],
      message = map clean (message r),
      hints = map clean (hints r)
    }
  where
    clean = Excerpt.visible

-- | How many errors and warnings there were, as the last line. Nothing when there were none.
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

-- | Break at spaces so that lines are at most so wide; explicit line ends stay.
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

paint :: Colour -> Role -> Text -> Text
paint colour role text = case colour of
  Plain -> text
  Coloured | Text.null text -> text
  Coloured ->
    Text.pack (Ansi.setSGRCode (codes role)) <> text <> Text.pack (Ansi.setSGRCode [Ansi.Reset])

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
