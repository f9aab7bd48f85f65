-- | Rendering of reports for other programs, one line for each report: the usual format of
-- compilers, which editors recognise, and JSON.
module Report.LineFormat
  ( short,
    json,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Position (..), Region (..), Source)
import Base.Region qualified as Region
import Data.Aeson (Series, Value, object, pairs, (.=))
import Data.Aeson.Encoding (encodingToLazyByteString)
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
import Report.Excerpt qualified as Excerpt
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), ReportCode (..), ReportPlace (..))
import Report.Report qualified as Report

-- | Renders a report as GCC does, @file:line:column: error: title [E0123]@, with a line end. A
-- report about a tape has the row of the tape, from 1, in place of the line. @path@ is the file's
-- name, which is written if the report's place is not a region of the program. A report that
-- concerns no file begins with @partc: error@.
short :: Text -> Source -> Report -> Text
short path source r =
  at
    <> ": "
    <> Report.severityWord (severity r)
    <> ": "
    <> Excerpt.visible (title r)
    <> " ["
    <> code
    <> "]\n"
  where
    ReportCode code = Report.code r
    at = case place r of
      InSource region ->
        let Position {file, line, column} = Region.position source (start region)
         in file <> ":" <> Decimal.whole line <> ":" <> Decimal.whole column
      InTape row -> path <> ":" <> Decimal.whole row <> ":1"
      InFile -> if path == "" then "partc" else path <> ":1:1"
      InCommandLine -> "partc"

-- | Renders a report as one JSON object with a line end. Lines count from 1, columns count
-- characters from 1; the field @end@ is the position after the last character. @path@ is the
-- file's name, which is written if the report's place is not a region of the program.
json :: Text -> Source -> Report -> Text
json path source r =
  Encoding.decodeUtf8 (LazyByteString.toStrict (encodingToLazyByteString (pairs fields))) <> "\n"
  where
    ReportCode code = Report.code r
    fields =
      "schemaVersion" .= (1 :: Int)
        <> "severity" .= Report.severityWord (severity r)
        <> "code" .= code
        <> "file" .= file'
        <> placed
        <> "title" .= title r
        <> "label" .= label r
        <> "message" .= message r
        <> "hints" .= Report.remedies r
        <> "fixes" .= map (jsonFix source) (filter (Fix.isWithin source) (fixes r))
        <> "related" .= map related (others r)
    file' = case place r of
      InSource region -> let Position {file} = Region.position source (start region) in file
      InTape _ -> path
      InFile -> path
      InCommandLine -> ""
    placed :: Series
    placed = case place r of
      InSource region -> "start" .= position (start region) <> "end" .= position (end region)
      InTape row -> "row" .= row
      InFile -> mempty
      InCommandLine -> mempty
    position = jsonPosition source
    related (Label region words') =
      let Position {file} = Region.position source (start region)
       in object
            [ "file" .= file,
              "start" .= position (start region),
              "end" .= position (end region),
              "label" .= words'
            ]

jsonPosition :: Source -> Int -> Value
jsonPosition source offset =
  let Position {line, column} = Region.position source offset
   in object ["line" .= line, "column" .= column]

jsonFix :: Source -> Fix -> Value
jsonFix source f = object ["title" .= Fix.title f, "edits" .= map edited (Fix.edits f)]
  where
    edited e =
      object
        [ "start" .= jsonPosition source (start (Fix.replaced e)),
          "end" .= jsonPosition source (end (Fix.replaced e)),
          "text" .= Fix.newText source e
        ]
