-- | A text that is open in the editor, and its edits.
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

-- | A text with the address of its file and the version number that the client gives to this state
-- of the text. The version is Nothing if the client gives none.
data Document = Document {uri :: Uri, version :: Maybe Int, text :: Text}
  deriving stock (Eq, Show)

-- | An edit of a document: a new text for a range, or for the whole document.
data Edit = Replace LspRange Text | Whole Text
  deriving stock (Eq, Show)

instance FromJSON Edit where
  parseJSON = withObject "a change" $ \o -> do
    range <- o .:? "range"
    new <- o .: "text"
    pure (maybe Whole Replace range new)

-- | The document that a client opens, with its version number if there is one.
open :: Uri -> Maybe Int -> Text -> Document
open uri version text = Document {uri, version, text}

-- | Applies edits in the order of the list and sets the version. The range of an edit refers to the
-- text as the previous edits have left it.
edit :: Maybe Int -> [Edit] -> Document -> Document
edit version edits document =
  document {version, text = foldl (applied (uri document)) (text document) edits}

applied :: Uri -> Text -> Edit -> Text
applied uri old e = case e of
  Whole new -> new
  Replace range new ->
    let Region from to = Position.region (Region.fromText (Uri.toPath uri) old) range
     in Text.concat [Text.take from old, new, Text.drop to old]

-- | The text for the compiler. A byte order mark at the beginning becomes a space. It cannot be
-- dropped, because the client's positions count it as a character.
program :: Document -> Text
program Document {text} = Text.map unmarked (Text.take 1 text) <> Text.drop 1 text
  where
    unmarked c = if c == '\xFEFF' then ' ' else c
