-- | The state of the conversation with one client (an editor), the events that change it, and the
-- effects of these changes.
module Lsp.Conversation
  ( Session (..),
    Phase (..),
    CurrentWork (..),
    start,
    Event (..),
    WorkOrder (..),
    WorkKind (..),
    Outcome (..),
    Effect (..),
    PageOrder (..),
    Ending (..),
    client,
    adjusted,
  )
where

import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Lsp.Capability (Client)
import Lsp.Message (Id, Incoming, Outgoing)
import Lsp.OpenDocument (Milliseconds, OpenDocument)
import Query.Snapshot (Snapshot)
import Query.TapeFacts (TapeFacts)

-- | The state of the conversation.
data Session = Session
  { phase :: Phase,
    -- | the open documents by the paths of their files
    documents :: Map Text OpenDocument,
    -- | the paths of the documents whose analysis has been due and has not begun, the next one
    -- first
    queue :: [Text],
    -- | the work that the worker has begun; nothing if it is idle
    current :: Maybe CurrentWork,
    -- | the number of the last work
    lastWork :: Int
  }

-- | The phases of the protocol's life cycle.
data Phase
  = -- | before the request @initialize@; all other requests are refused
    Waiting
  | Running Client
  | -- | after @shutdown@: only @exit@ has an effect
    Closing

-- | Work that the worker has begun, and the time of its beginning. @isShown@ is true if the editor
-- shows its progress.
data CurrentWork = CurrentWork {work :: WorkOrder, since :: Milliseconds, isShown :: Bool}

-- | An order to the worker: its number, which no other work has, and the path and the text of the
-- document.
data WorkOrder = WorkOrder {number :: Int, kind :: WorkKind, path :: Text, text :: Text}
  deriving stock (Eq, Show)

-- | The analysis of a text, or the proof of its tape.
data WorkKind = Analysis | TapeProof
  deriving stock (Eq, Show)

-- | A result of the worker. An analysis ends with 'AllChecked', a proof with 'TapeMade'. Each may
-- end with 'Fault' or 'TooLarge' instead.
data Outcome
  = -- | the results of evaluation; the analysis continues
    EvaluationChecked Snapshot
  | -- | the results of all passes
    AllChecked Snapshot
  | -- | the tape is made and proven, or cannot be
    TapeMade TapeFacts
  | -- | the text of an exception
    Fault Text
  | -- | the work was stopped because it needed too much memory
    TooLarge

-- | A message from the editor, the passing of time, or a result of the worker.
data Event
  = Received Incoming
  | -- | a deadline has passed
    Due
  | -- | the number of the work, its result
    Worked Int Outcome

-- | The consequence of a step.
data Effect
  = Send Outgoing
  | -- | the answer to the request with this identifier; it may take long to compute, so it is
    -- computed beside the main thread
    Answer Id ~Outgoing
  | -- | the worker begins this work; work that still runs is stopped
    Begin WorkOrder
  | -- | the worker stops its work
    Halt
  | -- | an order to the pages of the preview
    ForPage PageOrder
  | -- | the end of the conversation
    Stop Ending
  deriving stock (Eq, Show)

-- | An order to the pages of the preview.
data PageOrder
  = -- | the answer to the request with this identifier is the address of the page that follows the
    -- document with this path
    OpenPage Id Text
  | -- | the cursor is in the document with this path, at this line from 1
    CursorAt Text Int
  deriving stock (Eq, Show)

-- | The end of the conversation: orderly after the request @shutdown@, abrupt without it.
data Ending = Orderly | Abrupt
  deriving stock (Eq, Show)

-- | The state before the first message.
start :: Session
start =
  Session {phase = Waiting, documents = Map.empty, queue = [], current = Nothing, lastWork = 0}

-- | The client, if the conversation is between @initialize@ and @shutdown@.
client :: Session -> Maybe Client
client session = case phase session of
  Running c -> Just c
  Waiting -> Nothing
  Closing -> Nothing

-- | Changes the document with this path.
adjusted :: Text -> (OpenDocument -> OpenDocument) -> Session -> Session
adjusted path f session = session {documents = Map.adjust f path (documents session)}
