-- | The texts that are open in the editor, and how edits change them.
module Lsp.Document
  ( Document (..),
    Edit (..),
    open,
    edit,
    program,
  )
where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.Aeson (FromJSON (..), withObject, (.:), (.:?))
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Position (LspRange)
import Lsp.Position qualified as Position
import Lsp.Uri (Uri)
import Lsp.Uri qualified as Uri

-- | A text with the version that the client gives it.
data Document = Document {uri :: Uri, version :: Maybe Int, text :: Text}
  deriving stock (Eq, Show)

-- | A stretch that is replaced, or the whole text.
data Edit = Replace LspRange Text | Whole Text
  deriving stock (Eq, Show)

instance FromJSON Edit where
  parseJSON = withObject "a change" $ \o -> do
    place <- o .:? "range"
    put <- o .: "text"
    pure (maybe Whole Replace place put)

-- | A text as it is opened.
open :: Uri -> Maybe Int -> Text -> Document
open uri version text = Document {uri, version, text}

-- | Edits one after another; each speaks of the text that the one before has left.
edit :: Maybe Int -> [Edit] -> Document -> Document
edit version edits document =
  document {version, text = foldl (applied (uri document)) (text document) edits}

applied :: Uri -> Text -> Edit -> Text
applied uri before e = case e of
  Whole after -> after
  Replace place put ->
    let Region from to = Position.region (Region.fromText (Uri.toPath uri) before) place
     in Text.concat [Text.take from before, put, Text.drop to before]

-- | The text for the compiler. A mark of the byte order is not part of the program, but the client
-- counts it: a space stands in its place.
program :: Document -> Text
program Document {text} = Text.map unmarked (Text.take 1 text) <> Text.drop 1 text
  where
    unmarked c = if c == '\xFEFF' then ' ' else c
