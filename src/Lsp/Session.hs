-- | The conversation with one client (an editor) in the Language Server Protocol, as a state
-- machine. A step takes a state and an event, and gives the next state and the messages to send.
-- All functions are pure.
--
-- A snapshot is one state of a program's text with its imported files, as analysed by the compiler.
-- A step may need snapshots, and to make one the server has to read imported files. So before each
-- step the server calls 'awaited', analyses the programs that it names, and passes their snapshots
-- to 'supply'.
--
-- The argument @now@ is the present time. Diagnostics of a document are /due/ when the time has
-- come to publish them.
module Lsp.Session
  ( Session,
    start,
    leaving,
    Milliseconds (..),
    Event (..),
    Effect (..),
    Ending (..),
    Awaited (..),
    deadline,
    awaited,
    supply,
    openText,
    step,
    failed,
  )
where

import Data.Aeson (FromJSON, Value (..), withObject, (.:), (.:?), (.=))
import Data.Aeson qualified as Aeson
import Data.Aeson.Types (Parser)
import Data.Aeson.Types qualified as Aeson (parseEither, parseMaybe)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Capability (Client)
import Lsp.Capability qualified as Capability
import Lsp.Diagnostic qualified as Diagnostic
import Lsp.Document (Document, Edit)
import Lsp.Document qualified as Document
import Lsp.Message (ErrorCode (..), Failure (..), Id, Incoming (..), Outgoing (..))
import Lsp.Request (Subject)
import Lsp.Request qualified as Request
import Lsp.Uri (Uri)
import Lsp.Uri qualified as Uri
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot

-- | The state of the conversation: its phase, and the open documents by the paths of their files.
data Session = Session {phase :: Phase, documents :: Map Text Open}

-- | The phases of the protocol's life cycle.
data Phase
  = -- | before the request @initialize@; all other requests are refused
    Waiting
  | Running Client
  | -- | after @shutdown@: only @exit@ has an effect
    Closing

-- | An open document.
data Open = Open
  { document :: Document,
    -- | the snapshot of the present text; nothing if this text is not analysed yet
    present :: Maybe Snapshot,
    -- | the snapshot of the last text without errors; nothing if there was no such text
    sound :: Maybe Snapshot,
    -- | the time at which the document's diagnostics are to be published; nothing if the published
    -- ones are up to date
    due :: Maybe Milliseconds
  }

-- | The session before the first message.
start :: Session
start = Session {phase = Waiting, documents = Map.empty}

-- | A time in ms since an arbitrary origin.
newtype Milliseconds = Milliseconds Int
  deriving stock (Eq, Ord, Show)

-- | A message from the editor, or the passing of time.
data Event
  = Received Incoming
  | -- | a deadline has passed
    Due
  deriving stock (Eq, Show)

-- | A message to the editor, or the end of the conversation.
data Effect = Send Outgoing | Stop Ending
  deriving stock (Eq, Show)

-- | The end of the conversation: orderly after the request @shutdown@, abrupt without it.
data Ending = Orderly | Abrupt
  deriving stock (Eq, Show)

-- | The time at which the diagnostics of a document become due after a change at the time @now@:
-- 200 ms later. Each further change of the document delays them again, so they are not published
-- while the user types.
afterDelay :: Milliseconds -> Milliseconds
afterDelay (Milliseconds now) = Milliseconds (now + 200)

-- | The earliest time at which diagnostics become due; nothing if all are up to date.
deadline :: Session -> Maybe Milliseconds
deadline session = case Maybe.mapMaybe due (Map.elems (documents session)) of
  [] -> Nothing
  times -> Just (minimum times)

-- | A program to analyse: the path of its file, its text.
data Awaited = Awaited {path :: Text, text :: Text}
  deriving stock (Eq, Show)

-- | The programs that a step for this event needs, and whose present text has no snapshot yet.
awaited :: Milliseconds -> Event -> Session -> [Awaited]
awaited now event session =
  [ Awaited {path, text = Document.program (document o)}
    | (path, o) <- wanted,
      Maybe.isNothing (present o)
  ]
  where
    wanted = case event of
      Received (Request _ _ params) | Running _ <- phase session ->
        case Aeson.parseMaybe named params of
          Just path -> [(path, o) | Just o <- [Map.lookup path (documents session)]]
          Nothing -> []
      Received _ -> []
      Due -> filter (isDue now . snd) (Map.toList (documents session))

-- | True if the diagnostics of a document are due at the time @now@.
isDue :: Milliseconds -> Open -> Bool
isDue now o = maybe False (<= now) (due o)

-- | Stores the snapshot of the document with this path. The snapshot is evaluated until its errors
-- are known; otherwise an unevaluated test for errors would keep older snapshots in memory.
supply :: Text -> Snapshot -> Session -> Session
supply path snapshot session = session {documents = Map.adjust supplied path (documents session)}
  where
    supplied o =
      o
        { present = Just snapshot,
          sound = if Snapshot.isGood snapshot then Just snapshot else sound o
        }

-- | The present text of the document with this path; nothing if it is not open.
openText :: Session -> Text -> Maybe Text
openText session path = Document.program . document <$> Map.lookup path (documents session)

-- | Handles an event. The snapshots of the programs that 'awaited' names must have been supplied.
step :: Milliseconds -> Event -> Session -> (Session, [Effect])
step now event session = case event of
  Due -> published now session
  Received incoming -> case incoming of
    Request ident method params -> request ident method params session
    Notification "exit" _ -> (session, [Stop (leaving session)])
    Notification method params -> case phase session of
      Running _ -> notified now method params session
      Waiting -> (session, [])
      Closing -> (session, [])
    Reply -> (session, [])
    Malformed failure -> (session, [Send (Refusal Null failure)])

-- | The kind of end that the conversation has if the client leaves now.
leaving :: Session -> Ending
leaving session = case phase session of
  Closing -> Orderly
  Waiting -> Abrupt
  Running _ -> Abrupt

-- | Handles an event if its ordinary handling has raised an exception. The text of the exception is
-- @why@. A request is refused. For any other message, the editor's log gets @why@. For 'Due', each
-- document whose diagnostics were due gets one diagnostic with @why@ instead.
failed :: Milliseconds -> Text -> Event -> Session -> (Session, [Effect])
failed now why event session = case event of
  Received (Request ident _ _) ->
    (session, [Send (Refusal ident (Failure InternalError ("this is a bug in partc: " <> why)))])
  Received _ -> (session, [Send (logged why)])
  Due ->
    ( session
        { documents =
            Map.map
              (\o -> if isDue now o then o {due = Nothing} else o)
              (documents session)
        },
      [Send (Diagnostic.bug (document o) why) | o <- Map.elems (documents session), isDue now o]
    )

-- | The notification that writes a bug of the compiler to the editor's log.
logged :: Text -> Outgoing
logged why =
  Notify
    "window/logMessage"
    (Aeson.object ["type" .= (1 :: Int), "message" .= ("this is a bug in partc: " <> why)])

-- Requests ----------------------------------------------------------------------------------------

-- | Answers a request. The arguments: its identifier, the name of its method, its parameters.
request :: Id -> Text -> Value -> Session -> (Session, [Effect])
request ident method params session = case (phase session, method) of
  (Waiting, "initialize") ->
    ( session {phase = Running (Capability.fromInitialize params)},
      [Send (Result ident Capability.initializeResult)]
    )
  (Waiting, _) -> refuse NotInitialized "the first request must be initialize"
  (Closing, _) -> refuse InvalidRequest "the server has been shut down"
  (Running _, "initialize") -> refuse InvalidRequest "the server is initialized already"
  (Running _, "shutdown") ->
    (session {phase = Closing, documents = Map.empty}, [Send (Result ident Null)])
  (Running client, _) -> (session, [Send (answered client)])
  where
    refuse errorCode why = (session, [Send (Refusal ident (Failure errorCode why))])
    answered client = case Request.method method of
      Nothing -> Refusal ident (Failure MethodNotFound ("there is no request " <> method))
      Just answer ->
        case Aeson.parseEither
          (\p -> subject p session >>= maybe (pure Null) (\s -> answer client s p))
          params of
          Left why -> Refusal ident (Failure InvalidParams (Text.pack why))
          Right result -> Result ident result

-- | The open document that the parameters of a request name, with its snapshots. Nothing if the
-- document is not open or its present text is not analysed.
subject :: Value -> Session -> Parser (Maybe Subject)
subject params session = do
  path <- named params
  pure $ do
    o <- Map.lookup path (documents session)
    now <- present o
    pure Request.Subject {Request.document = document o, Request.now = now, Request.sound = sound o}

-- | The path of the document that the parameters of a message name.
named :: Value -> Parser Text
named params = Uri.toPath <$> documentField "uri" params

-- | The field @key@ of the object @textDocument@ in the parameters of a message.
documentField :: FromJSON a => Aeson.Key -> Value -> Parser a
documentField key =
  withObject "parameters" (\o -> o .: "textDocument" >>= withObject "a document" (.: key))

-- Notifications -----------------------------------------------------------------------------------

-- | Handles a notification; @method@ is its name. Unknown notifications and wrong parameters have
-- no effect.
notified :: Milliseconds -> Text -> Value -> Session -> (Session, [Effect])
notified now method params session = Maybe.fromMaybe (session, []) $ case method of
  "textDocument/didOpen" -> opened now session <$> Aeson.parseMaybe documentOf params
  "textDocument/didChange" -> changed now session <$> Aeson.parseMaybe changeOf params
  "textDocument/didSave" -> Just (filesChanged now session, [])
  "workspace/didChangeWatchedFiles" -> Just (filesChanged now session, [])
  "textDocument/didClose" -> Aeson.parseMaybe named params >>= closed now session
  _ -> Nothing

documentOf :: Value -> Parser Document
documentOf params = do
  uri <- documentField "uri" params
  version <- optionalVersion params
  Document.open uri version <$> documentField "text" params

changeOf :: Value -> Parser (Uri, Maybe Int, [Edit])
changeOf params = do
  uri <- documentField "uri" params
  version <- optionalVersion params
  edits <- withObject "parameters" (.: "contentChanges") params
  pure (uri, version, edits)

optionalVersion :: Value -> Parser (Maybe Int)
optionalVersion =
  withObject "parameters" (\o -> o .: "textDocument" >>= withObject "a document" (.:? "version"))

-- | Opens a document. Its diagnostics are due at once.
opened :: Milliseconds -> Session -> Document -> (Session, [Effect])
opened now session document = (filesChanged now (put path fresh session), [])
  where
    path = Uri.toPath (Document.uri document)
    fresh = Open {document, present = Nothing, sound = Nothing, due = Just now}

-- | Edits a document. Its diagnostics become due 200 ms later (see 'afterDelay'). The tuple has the
-- address of the document, its version after the edits, and the edits.
changed :: Milliseconds -> Session -> (Uri, Maybe Int, [Edit]) -> (Session, [Effect])
changed now session (uri, version, edits) = case Map.lookup path (documents session) of
  Nothing -> (session, [])
  Just o ->
    ( filesChanged
        now
        ( put
            path
            o
              { document = Document.edit version edits (document o),
                present = Nothing,
                due = Just (afterDelay now)
              }
            session
        ),
      []
    )
  where
    path = Uri.toPath uri

-- | Adds or replaces the document with this path.
put :: Text -> Open -> Session -> Session
put path o session = session {documents = Map.insert path o (documents session)}

-- | Closes the document with this path and removes its diagnostics from the editor. Nothing if the
-- session is not running or the document not open.
closed :: Milliseconds -> Session -> Text -> Maybe (Session, [Effect])
closed now session path = case phase session of
  Running client -> leave client <$> Map.lookup path (documents session)
  Waiting -> Nothing
  Closing -> Nothing
  where
    leave client o =
      ( filesChanged now session {documents = Map.delete path (documents session)},
        [Send (Diagnostic.publish client (document o) {Document.version = Nothing} Nothing)]
      )

-- | Marks all programs with imports for a new analysis, because an imported file may have changed.
filesChanged :: Milliseconds -> Session -> Session
filesChanged now session = session {documents = Map.map again (documents session)}
  where
    again o
      | any hasImports (present o) =
        o {present = Nothing, due = Just (maybe (afterDelay now) (min (afterDelay now)) (due o))}
      | otherwise = o
    hasImports snapshot = not (null (Snapshot.imports snapshot))

-- | Publishes the diagnostics that are due at the time @now@.
published :: Milliseconds -> Session -> (Session, [Effect])
published now session = case phase session of
  Running client ->
    ( session {documents = Map.map settled (documents session)},
      concatMap (diagnostics client) (Map.elems (documents session))
    )
  Waiting -> (session, [])
  Closing -> (session, [])
  where
    settled o = if isDue now o then o {due = Nothing} else o
    diagnostics client o =
      [ Send (Diagnostic.publish client (document o) (Just snapshot))
        | isDue now o,
          Just snapshot <- [present o]
      ]
