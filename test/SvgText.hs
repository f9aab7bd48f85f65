-- | SVG documents as text, for tests: tags, texts, and the elements of a layer.
module SvgText
  ( isWellFormed,
    texts,
    layer,
    attributes,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text

-- | True if every tag is closed by its own end tag, and no ampersand or angle bracket is left over.
isWellFormed :: Text -> Bool
isWellFormed svg =
  go [] (drop 1 (Text.splitOn "<" svg)) && all isEntity (drop 1 (Text.splitOn "&" svg))
  where
    isEntity rest = any (`Text.isPrefixOf` rest) ["amp;", "lt;", "gt;", "quot;", "#39;"]
    go open pieces = case pieces of
      [] -> null (open :: [Text])
      piece : more
        | Text.null rest || Text.any (== '>') (Text.drop 1 rest) -> False
        | Text.isPrefixOf "?" tag || Text.isPrefixOf "!" tag -> go open more
        | Just name <- Text.stripPrefix "/" tag -> case open of
          first : others | first == name -> go others more
          _ -> False
        | Text.isSuffixOf "/" tag -> go open more
        | otherwise -> go (Text.takeWhile (/= ' ') (Text.map space tag) : open) more
        where
          (tag, rest) = Text.breakOn ">" piece
    space c = if c == '\n' then ' ' else c

-- | Contents of the text elements, in order.
texts :: Text -> [Text]
texts svg =
  [ Text.drop 1 (Text.dropWhile (/= '>') (Text.takeWhile (/= '<') piece))
    | piece <- drop 1 (Text.splitOn "<text" svg)
  ]

-- | Part of a document that is the layer of a name; layers contain no groups.
layer :: Text -> Text -> Text
layer name svg = fst (Text.breakOn "</g>" (snd (Text.breakOn ("<g id=\"" <> name <> "\"") svg)))

-- | Values of an attribute, in order.
attributes :: Text -> Text -> [Text]
attributes name svg =
  map (Text.takeWhile (/= '"')) (drop 1 (Text.splitOn (" " <> name <> "=\"") svg))
