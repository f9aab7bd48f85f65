-- | Reports as diagnostics of the Language Server Protocol, which an editor shows at ranges of the
-- document. A snapshot is one state of a document's text with its imported files, as analysed by
-- the compiler; the reports are read from it.
module Lsp.Diagnostic
  ( publish,
    mostDiagnostics,
    incomplete,
    diagnostic,
    bug,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region (..), Source)
import Base.Region qualified as Region
import Data.Aeson (Value, object, (.=))
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Capability (Client (..))
import Lsp.Document (Document (..))
import Lsp.Location qualified as Location
import Lsp.Message (Outgoing (..))
import Lsp.Position (LspPosition (..), LspRange (..))
import Lsp.Position qualified as Position
import Lsp.Uri (Uri)
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Report.Report (Label (..), Report (..), ReportCode (..), ReportPlace (..), Severity (..))
import Report.Report qualified as Report

-- | The notification that replaces all diagnostics of a document by these reports on a snapshot.
-- Without a snapshot, it removes all diagnostics of the document. If there are more than
-- 'mostDiagnostics', the last one says how many are left out.
publish :: Client -> Document -> Maybe (Snapshot, [Report]) -> Outgoing
publish client document = notification document . foldMap (diagnostics client document)

diagnostics :: Client -> Document -> (Snapshot, [Report]) -> [Value]
diagnostics client document (snapshot, reports) =
  map (diagnostic client (uri document) snapshot) shown
    <> [atTop Warning ("partc check shows " <> more <> " more reports") | not (null left)]
  where
    (shown, left) = splitAt mostDiagnostics reports
    more = Decimal.whole (length left)

-- | The greatest count of reports that an editor shows for one document.
mostDiagnostics :: Int
mostDiagnostics = 250

-- | The notification for a document whose analysis was stopped: the reports so far, and a warning
-- with the reason @why@.
incomplete :: Client -> Document -> Maybe (Snapshot, [Report]) -> Text -> Outgoing
incomplete client document found why =
  notification document $
    atTop Warning (why <> " Later mistakes are missing here. partc check has no limit.") :
    foldMap (diagnostics client document) found

-- | The notification that replaces all diagnostics of a document by one about a bug of the
-- compiler. This diagnostic is at the beginning of the document. @failure@ is the message of the
-- exception.
bug :: Document -> Text -> Outgoing
bug document failure =
  notification
    document
    [atTop Error ("this is a bug in partc: please send us the program\n" <> failure)]

-- | A diagnostic of the server itself at the beginning of a document.
atTop :: Severity -> Text -> Value
atTop severity message =
  object
    ["range" .= top, "severity" .= number severity, "source" .= name, "message" .= message]

notification :: Document -> [Value] -> Outgoing
notification Document {uri, version} found =
  Notify "textDocument/publishDiagnostics" . object $
    ["uri" .= uri, "diagnostics" .= found] <> ["version" .= v | Just v <- [version]]

-- | Diagnostic of a report.
diagnostic :: Client -> Uri -> Snapshot -> Report -> Value
diagnostic client uri snapshot r =
  object $
    [ "range" .= range,
      "severity" .= number (severity r),
      "code" .= reportCode,
      "source" .= name,
      "message" .= Text.intercalate "\n" (prefix <> title r : sentences)
    ]
      <> ["relatedInformation" .= map relation (others r) | related client, not (null (others r))]
  where
    ReportCode reportCode = code r
    source = Snapshot.source snapshot
    (range, prefix) = shownAt snapshot (place r)
    -- The label of the report is left out if it is at most one word or is part of the title. It
    -- would then add nothing to the message.
    sentences =
      [label r | length (Text.words (label r)) > 1, not (label r `Text.isInfixOf` title r)]
        <> [relatedLine l | not (related client), l <- others r]
        <> message r
        <> map ("hint: " <>) (Report.remedies r)
    relatedLine (Label region text) = lineOf source region <> ": " <> text
    relation (Label region text) =
      object ["location" .= Location.location uri source region, "message" .= text]

-- | The range at which a report is shown, and a prefix for its message. A report on an imported
-- file is shown at the import statement, and the prefix is the position in the imported file. The
-- prefix of all other reports is empty.
shownAt :: Snapshot -> ReportPlace -> (LspRange, Text)
shownAt snapshot place = case place of
  InSource region
    | Position.fileOf source region == Region.mainFile source -> (Position.range source region, "")
    | otherwise ->
      ( maybe top (Position.range source) (Snapshot.importOf snapshot region),
        lineOf source region <> ": "
      )
  InTape _ -> (top, "")
  InFile -> (top, "")
  InCommandLine -> (top, "")
  where
    source = Snapshot.source snapshot

-- | The position of a region in words: for the main file its line, for an imported file the name of
-- the file, line and column.
lineOf :: Source -> Region -> Text
lineOf source region
  | Region.file at == Region.mainFile source = "line " <> Decimal.whole (Region.line at)
  | otherwise =
    Region.file at
      <> ":"
      <> Decimal.whole (Region.line at)
      <> ":"
      <> Decimal.whole (Region.column at)
  where
    at = Region.position source (start region)

-- | The empty range at the beginning of a document.
top :: LspRange
top = LspRange (LspPosition 0 0) (LspPosition 0 0)

-- | The name that an editor shows as the source of the diagnostics.
name :: Text
name = "partc"

-- | The protocol's number of a severity.
number :: Severity -> Int
number severity = case severity of
  Error -> 1
  Warning -> 2
