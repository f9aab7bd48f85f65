-- | The requests about the structure of a document: symbols, colours, hints, links and lenses.
module Lsp.OutlineRequest
  ( symbols,
    workspaceSymbols,
    semanticTokens,
    inlayHints,
    documentLinks,
    codeLenses,
    foldingRanges,
    selectionRanges,
  )
where

import Base.Region (Located (..), Region (..))
import Base.Region qualified as Region
import Data.Aeson (Value (..), object, toJSON, withObject, (.:), (.=))
import Data.Aeson.Types (Parser)
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Capability (Client (..))
import Lsp.Document (Document (..))
import Lsp.Location qualified as Location
import Lsp.Position (LspPosition (..), LspRange (..))
import Lsp.Position qualified as Position
import Lsp.Subject (Method, Subject (..), rangeOf, source)
import Lsp.Uri qualified as Uri
import Query.CodeLens qualified as CodeLens
import Query.Folding (Folding (..))
import Query.Folding qualified as Folding
import Query.InlayHint qualified as InlayHint
import Query.Selection qualified as Selection
import Query.SemanticToken (SemanticToken (..))
import Query.SemanticToken qualified as SemanticToken
import Query.Snapshot qualified as Snapshot
import Query.Symbol (DocumentSymbol, SymbolKind (..))
import Query.Symbol qualified as Symbol
import Surface.Syntax qualified as Surface
import System.FilePath (takeDirectory, (</>))

-- | The request @textDocument/documentSymbol@.
symbols :: Method
symbols client subject _ = pure (toJSON shown)
  where
    found = Symbol.present (now subject) (sound subject)
    shown
      | hierarchical client = map nested found
      | otherwise = map (flatSymbol subject) (concatMap Symbol.flattened found)
    nested s =
      object $
        [ "name" .= Symbol.name s,
          "kind" .= number (Symbol.kind s),
          "detail" .= Symbol.detail s,
          "range" .= rangeOf subject (Symbol.whole s),
          "selectionRange" .= rangeOf subject (Symbol.selection s)
        ]
          <> ["children" .= map nested (Symbol.children s) | not (null (Symbol.children s))]

-- | The request @workspace/symbol@: the symbols of all open documents that fit a query.
workspaceSymbols :: [Subject] -> Value -> Parser Value
workspaceSymbols subjects = withObject "parameters" $ \o -> do
  query <- o .: "query"
  pure
    ( toJSON
        [ flatSymbol subject s
          | subject <- subjects,
            s <- Symbol.matching query (now subject)
        ]
    )

-- | A symbol with the location of its statement.
flatSymbol :: Subject -> DocumentSymbol -> Value
flatSymbol subject s =
  object
    [ "name" .= Symbol.name s,
      "kind" .= number (Symbol.kind s),
      "location" .= Location.location (uri (document subject)) (source subject) (Symbol.whole s)
    ]

-- | The protocol's number of a kind of symbol.
number :: SymbolKind -> Int
number kind = case kind of
  Part' -> 4 -- package
  Value -> 13 -- variable
  Function -> 12 -- function
  Contour' -> 5 -- class
  Machining -> 24 -- event

-- | The request @textDocument/semanticTokens/full@: five numbers for each token, the first two of
-- them relative to the token before.
semanticTokens :: Method
semanticTokens _ subject _ =
  pure (object ["data" .= concat (zipWith encoded (LspPosition 0 0 : starts) tokens)])
  where
    tokens = SemanticToken.semanticTokens (now subject)
    starts = map (from . rangeOf subject . place') tokens
    encoded (LspPosition line before) token =
      let LspRange (LspPosition l c) (LspPosition _ e) = rangeOf subject (place' token)
       in [ l - line,
            if l == line then c - before else c,
            e - c,
            fromEnum (SemanticToken.kind token),
            (if isDefinition token then 1 else 0) + (if isOfLanguage token then 2 else 0)
          ]

-- | The request @textDocument/inlayHint@. The answer is empty unless the client has asked for hints
-- when it began.
inlayHints :: Method
inlayHints client subject = withObject "parameters" $ \o -> do
  range <- o .: "range"
  let shown = InlayHint.inlayHints (now subject) (Position.region (source subject) range)
  pure (toJSON (if hints client then map hint shown else []))
  where
    hint h =
      object
        [ "position" .= Position.position (source subject) (InlayHint.offset h),
          "label" .= InlayHint.text h,
          "kind" .= (if InlayHint.isType h then 1 else 2 :: Int),
          "paddingLeft" .= not (InlayHint.isType h)
        ]

-- | The request @textDocument/documentLink@: the names of imported files, of table files and of
-- machine descriptions.
documentLinks :: Method
documentLinks _ subject _ =
  pure
    ( toJSON
        [ object ["range" .= rangeOf subject at, "target" .= Uri.fromPath path]
          | (at, path) <- Snapshot.imports (now subject) <> descriptions,
            start at < Text.length (Region.text (source subject))
        ]
    )
  where
    descriptions =
      [ (at, Text.pack (takeDirectory itself </> Text.unpack file))
        | Located _ (Surface.Machine (Located at (Surface.Described file))) <-
            Surface.statements (Snapshot.program (now subject))
      ]
    itself = Text.unpack (Region.mainFile (source subject))

-- | The request @textDocument/codeLens@.
codeLenses :: Method
codeLenses _ subject _ =
  pure (toJSON (map lens (CodeLens.codeLenses (now subject) (tape subject))))
  where
    lens l =
      object
        [ "range" .= rangeOf subject (CodeLens.place l),
          "command" .= object ["title" .= CodeLens.title l, "command" .= ("" :: Text)]
        ]

-- | The request @textDocument/foldingRange@.
foldingRanges :: Method
foldingRanges _ subject _ = pure (toJSON (map shown (Folding.foldings (source subject))))
  where
    shown f =
      object $
        ["startLine" .= firstLine f, "endLine" .= lastLine f]
          <> ["kind" .= ("comment" :: Text) | isComment f]

-- | The request @textDocument/selectionRange@.
selectionRanges :: Method
selectionRanges _ subject = withObject "parameters" $ \o -> do
  positions <- o .: "positions"
  pure (toJSON (map (chain . Selection.enclosing (now subject)) (offsets positions)))
  where
    offsets = map (Position.offset (source subject))
    chain regions = case regions of
      [] -> Null
      r : outer ->
        object (["range" .= rangeOf subject r] <> ["parent" .= chain outer | not (null outer)])
