-- | The requests that change the layout of a document.
module Lsp.LayoutRequest
  ( formatting,
    onType,
  )
where

import Base.Region qualified as Region
import Data.Aeson (Value, toJSON)
import Data.Maybe (maybeToList)
import Lsp.Subject (Method, Subject, offsetIn, source, textEdit)
import Query.Formatting (Change (..))
import Query.Formatting qualified as Formatting
import Surface.Formatter qualified as Formatter

-- | The request @textDocument/formatting@: edits of those lines that differ.
formatting :: Method
formatting _ subject _ = pure (edits subject (maybe [] (Formatting.changes text) formatted))
  where
    text = Region.text (source subject)
    formatted = Formatter.format text

-- | The request @textDocument/onTypeFormatting@ after a line end: closes a block.
onType :: Method
onType _ subject params = closed <$> offsetIn subject params
  where
    closed at = edits subject (maybeToList (Formatting.closing (Region.text (source subject)) at))

edits :: Subject -> [Change] -> Value
edits subject cs = toJSON [textEdit subject (region c) (newText c) | c <- cs]
