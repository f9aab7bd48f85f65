-- | The requests about an open document, and their answers. A snapshot is one state of a document's
-- text with its imported files, as analysed by the compiler; the answers are read from it.
module Lsp.Request
  ( Subject (..),
    Method,
    method,
    Need (..),
    need,
    workspaceMethod,
  )
where

import Base.Region (Region (..))
import Data.Aeson (Value (Null), object, toJSON, withObject, (.:), (.=))
import Data.Aeson.Key qualified as Key
import Data.Aeson.Types (Parser)
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Capability (Client (..))
import Lsp.CompletionRequest qualified as CompletionRequest
import Lsp.DescriptionKeyRequest qualified as DescriptionKeyRequest
import Lsp.Diagnostic qualified as Diagnostic
import Lsp.Document (Document (..))
import Lsp.Document qualified as Document
import Lsp.LayoutRequest qualified as LayoutRequest
import Lsp.NameRequest qualified as NameRequest
import Lsp.OutlineRequest qualified as OutlineRequest
import Lsp.PanelRequest qualified as PanelRequest
import Lsp.Position qualified as Position
import Lsp.Subject (Method, Subject (..), source)
import Lsp.Uri (Uri (..))
import Query.Snapshot qualified as Snapshot
import Report.Fix qualified as Fix
import Report.Report (Report (fixes, place), ReportPlace (..))

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
  | -- | the evaluation of the present text, and of all open documents that may share files with it
    SharedEvaluation
  | -- | all passes on the present text
    AllPasses
  deriving stock (Eq, Show)

-- | The results that a request with this method needs.
need :: Text -> Need
need name
  | name `elem` quick = LastSnapshot
  | name `elem` late = AllPasses
  | name `elem` shared = SharedEvaluation
  | otherwise = Evaluation
  where
    quick =
      [ "textDocument/hover",
        "textDocument/definition",
        "textDocument/documentSymbol",
        "textDocument/foldingRange",
        "textDocument/onTypeFormatting",
        "partc/at"
      ]
    shared = ["textDocument/references", "textDocument/rename"]
    late = ["textDocument/codeAction", "textDocument/codeLens"]

-- | The function for a method of the protocol that is about all open documents, such as
-- @workspace/symbol@. Nothing if the server does not support this method.
workspaceMethod :: Text -> Maybe ([Subject] -> Value -> Parser Value)
workspaceMethod name = lookup name [("workspace/symbol", OutlineRequest.workspaceSymbols)]

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
    ("textDocument/documentSymbol", OutlineRequest.symbols),
    ("textDocument/semanticTokens/full", OutlineRequest.semanticTokens),
    ("textDocument/inlayHint", OutlineRequest.inlayHints),
    ("textDocument/documentLink", OutlineRequest.documentLinks),
    ("textDocument/codeLens", OutlineRequest.codeLenses),
    ("textDocument/foldingRange", OutlineRequest.foldingRanges),
    ("textDocument/selectionRange", OutlineRequest.selectionRanges),
    ("textDocument/formatting", LayoutRequest.formatting),
    ("textDocument/onTypeFormatting", LayoutRequest.onType),
    ("textDocument/codeAction", codeActions),
    ("partc/at", PanelRequest.atPosition)
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
          "newText" .= Fix.newText (source subject) e
        ]
