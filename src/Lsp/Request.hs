-- | The requests about an open document, and their answers. A snapshot is one state of a document's
-- text with its imported files, as analysed by the compiler; the answers are read from it.
module Lsp.Request
  ( Subject (..),
    Method,
    method,
    Need (..),
    need,
  )
where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.Aeson (Value (Null), object, toJSON, withObject, (.:), (.=))
import Data.Aeson.Key qualified as Key
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Capability (Client (..))
import Lsp.CompletionRequest qualified as CompletionRequest
import Lsp.DescriptionKeyRequest qualified as DescriptionKeyRequest
import Lsp.Diagnostic qualified as Diagnostic
import Lsp.Document (Document (..))
import Lsp.Document qualified as Document
import Lsp.Location qualified as Location
import Lsp.NameRequest qualified as NameRequest
import Lsp.PanelRequest qualified as PanelRequest
import Lsp.Position qualified as Position
import Lsp.Subject (Method, Subject (..), source)
import Lsp.Uri (Uri (..))
import Query.Formatting qualified as Formatting
import Query.Snapshot qualified as Snapshot
import Query.Symbol (SymbolKind (..))
import Query.Symbol qualified as Symbol
import Report.Fix qualified as Fix
import Report.Report (Report (fixes, place), ReportPlace (..))
import Surface.Formatter qualified as Formatter

-- | The function for a method name of the protocol, such as @textDocument/hover@. Nothing if the
-- server does not support this method.
method :: Text -> Maybe Method
method name = ofKind <$> lookup name table
  where
    ofKind ofPrograms client subject
      | Document.isDescription (document subject) =
        case lookup name DescriptionKeyRequest.table of
          Just ofDescriptions -> ofDescriptions client subject
          Nothing -> const (pure Null)
      | otherwise = ofPrograms client subject

-- | The results that must be there before a request is answered.
data Need
  = -- | any snapshot of the document
    LastSnapshot
  | -- | the evaluation of the present text
    Evaluation
  | -- | all passes on the present text
    AllPasses
  deriving stock (Eq, Show)

-- | The results that a request with this method needs.
need :: Text -> Need
need name
  | name `elem` quick = LastSnapshot
  | name `elem` late = AllPasses
  | otherwise = Evaluation
  where
    quick =
      ["textDocument/hover", "textDocument/definition", "textDocument/documentSymbol", "partc/at"]
    late = ["textDocument/codeAction", "textDocument/codeLens"]

table :: [(Text, Method)]
table =
  [ ("textDocument/completion", CompletionRequest.completion),
    ("textDocument/signatureHelp", CompletionRequest.signatureHelp),
    ("textDocument/hover", NameRequest.hover),
    ("textDocument/definition", NameRequest.definition),
    ("textDocument/references", NameRequest.references),
    ("textDocument/documentHighlight", NameRequest.highlights),
    ("textDocument/prepareRename", NameRequest.prepareRename),
    ("textDocument/rename", NameRequest.rename),
    ("textDocument/documentSymbol", symbols),
    ("textDocument/formatting", formatting),
    ("textDocument/codeAction", codeActions),
    ("partc/at", PanelRequest.atPosition)
  ]

symbols :: Method
symbols client subject _ = pure (toJSON (map shown (Symbol.symbols (now subject))))
  where
    shown s = object (["name" .= Symbol.name s, "kind" .= number (Symbol.kind s)] <> placed s)
    placed s
      | hierarchical client =
        [ "detail" .= Symbol.detail s,
          "range" .= Position.range (source subject) (Symbol.whole s),
          "selectionRange" .= Position.range (source subject) (Symbol.selection s)
        ]
      | otherwise =
        ["location" .= Location.location (uri (document subject)) (source subject) (Symbol.whole s)]

formatting :: Method
formatting _ subject _ =
  pure (toJSON (map edit (Maybe.maybeToList (Formatter.format text >>= Formatting.change text))))
  where
    text = Region.text (source subject)
    edit change =
      object
        [ "range" .= Position.range (source subject) (Formatting.region change),
          "newText" .= Formatting.newText change
        ]

-- | The fixes of all reports in a range, as actions of the kind @quickfix@.
codeActions :: Method
codeActions client subject = withObject "parameters" $ \o -> do
  range <- o .: "range"
  from <- withObject "a range" (\r -> Position.offset (source subject) <$> r .: "start") range
  to <- withObject "a range" (\r -> Position.offset (source subject) <$> r .: "end") range
  pure . toJSON $
    [ action r f
      | actions client,
        r <- Snapshot.reports (now subject),
        InSource (Region a b) <- [place r],
        a <= to && b >= from,
        f <- fixes r,
        Fix.isWithin (source subject) f
    ]
  where
    action r f =
      object
        [ "title" .= Text.dropWhileEnd (== '.') (Fix.title f),
          "kind" .= ("quickfix" :: Text),
          "diagnostics"
            .= [Diagnostic.diagnostic client (uri (document subject)) (now subject) r],
          "isPreferred" .= (map Fix.isProposal (fixes r) == [False]),
          "edit" .= object ["changes" .= object [Key.fromText address .= map edit (Fix.edits f)]]
        ]
    Uri address = uri (document subject)
    edit e =
      object
        [ "range" .= Position.range (source subject) (Fix.replaced e),
          "newText" .= Fix.newText e
        ]

-- | The protocol's number of a kind of symbol.
number :: SymbolKind -> Int
number kind = case kind of
  Part' -> 4 -- package
  Value -> 13 -- variable
  Function -> 12 -- function
  Contour' -> 5 -- class
  Machining -> 24 -- event
