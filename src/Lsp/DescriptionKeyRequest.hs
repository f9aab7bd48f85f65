-- | The requests about machine descriptions: completion and hover of their keys.
module Lsp.DescriptionKeyRequest
  ( table,
  )
where

import Base.Region qualified as Region
import Data.Aeson (Value (..), object, toJSON, (.=))
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Subject (Method, markup, offsetIn, rangeOf, source, textEdit)
import Query.DescriptionKey (DescriptionKeys (..))
import Query.DescriptionKey qualified as DescriptionKey

-- | The functions for the methods that know descriptions.
table :: [(Text, Method)]
table = [("textDocument/completion", completion), ("textDocument/hover", hover)]

completion :: Method
completion _ subject params = do
  at <- offsetIn subject params
  pure (maybe Null shown (DescriptionKey.keysAt (Region.text (source subject)) at))
  where
    shown found = toJSON (map (item found) (keys found))
    item found key =
      object
        [ "label" .= key,
          "kind" .= property,
          "detail" .= section found,
          "textEdit" .= textEdit subject (word found) key
        ]
    -- The protocol's number for Property.
    property = 10 :: Int

-- | The section of the key at the cursor, and the keys beside it.
hover :: Method
hover client subject params = do
  at <- offsetIn subject params
  pure (maybe Null shown (DescriptionKey.keysAt (Region.text (source subject)) at))
  where
    shown found =
      object
        [ "contents" .= let text = sentences found in markup client text text,
          "range" .= rangeOf subject (word found)
        ]
    sentences found =
      Text.concat
        ["A key of ", section found, ". Its keys are: ", Text.intercalate ", " (keys found), "."]
