-- | The document that a request is about, and what all requests have in common.
module Lsp.Subject
  ( Subject (..),
    Method,
    source,
    offsetIn,
    atCursor,
    rangeOf,
    textEdit,
    markup,
    fenced,
  )
where

import Base.Region (Region, Source)
import Data.Aeson (Value (Null), object, withObject, (.:), (.=))
import Data.Aeson.Types (Parser)
import Data.Text (Text)
import Lsp.Capability (Client (..))
import Lsp.Document (Document)
import Lsp.Position (LspRange)
import Lsp.Position qualified as Position
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Query.TapeFacts (TapeFacts)

-- | The document that a request is about. @now@ is the snapshot of its present text. @sound@ is the
-- snapshot of its last text without errors; nothing if there was none.
--
-- If the present text is not analysed yet, @now@ has only this text and @sound@ is the last
-- snapshot; @isAnalysed@ is then false. @tape@ has the facts about the tape of the present text;
-- nothing if it is not made yet. @others@ are the other open documents.
data Subject = Subject
  { document :: Document,
    now :: Snapshot,
    sound :: Maybe Snapshot,
    tape :: Maybe TapeFacts,
    isAnalysed :: Bool,
    others :: ~[Subject]
  }

-- | A function that answers one kind of request. The arguments: the capabilities of the client, the
-- document, the parameters of the request. The parser fails if the parameters are wrong.
type Method = Client -> Subject -> Value -> Parser Value

-- | The present text of the document with its imported files.
source :: Subject -> Source
source = Snapshot.source . now

-- | The position in the parameters of a request, as an offset: a count of characters from the
-- beginning of the document.
offsetIn :: Subject -> Value -> Parser Int
offsetIn subject =
  withObject "parameters" (\o -> Position.offset (source subject) <$> o .: "position")

-- | The answer about the position in the parameters of a request: @shown@ of what @find@ finds
-- there, in the present snapshot or in the last sound one; null if it finds nothing.
atCursor ::
  (Snapshot -> Maybe Snapshot -> Int -> Maybe a) ->
  (a -> Value) ->
  Subject ->
  Value ->
  Parser Value
atCursor find shown subject params =
  maybe Null shown . find (now subject) (sound subject) <$> offsetIn subject params

-- | The range of a region of the present text.
rangeOf :: Subject -> Region -> LspRange
rangeOf = Position.range . source

-- | The edit that replaces a region of the present text.
textEdit :: Subject -> Region -> Text -> Value
textEdit subject region new = object ["range" .= rangeOf subject region, "newText" .= new]

-- | Text for people, as Markdown if the client can show it, else plain. The two arguments are the
-- text in these two forms.
markup :: Client -> Text -> Text -> Value
markup client marked plain
  | markdown client = object ["kind" .= ("markdown" :: Text), "value" .= marked]
  | otherwise = object ["kind" .= ("plaintext" :: Text), "value" .= plain]

-- | A piece of a program in Markdown.
fenced :: Text -> Text
fenced code = "```part\n" <> code <> "\n```"
