-- | The conversation with one client as a state and a step: a message in, messages out. No effects.
--
-- Before an event is handled, 'awaited' names the programs that have to be looked at for it and
-- 'supply' brings what was found; so reading imported files stays with the server, and a handler
-- sees the present text.
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

-- | Where the conversation is, and the open documents by the paths of their files.
data Session = Session {phase :: Phase, documents :: Map Text Open}

data Phase
  = -- | nothing but @initialize@ is answered
    Waiting
  | Running Client
  | -- | nothing but @exit@ is heard
    Closing

-- | An open document.
data Open = Open
  { document :: Document,
    -- | what the present text says, once it has been looked at
    present :: Maybe Snapshot,
    -- | what the last text without errors said
    sound :: Maybe Snapshot,
    -- | when its diagnostics are to be published
    due :: Maybe Milliseconds
  }

-- | Before the first message.
start :: Session
start = Session {phase = Waiting, documents = Map.empty}

-- | Time from some beginning.
newtype Milliseconds = Milliseconds Int
  deriving stock (Eq, Ord, Show)

-- | What comes from the editor, or with time.
data Event
  = Received Incoming
  | -- | a deadline has passed
    Due
  deriving stock (Eq, Show)

-- | What is answered, or the end of the conversation.
data Effect = Send Outgoing | Stop Ending
  deriving stock (Eq, Show)

-- | Whether the client took its leave before it went.
data Ending = Orderly | Abrupt
  deriving stock (Eq, Show)

-- | How long the text has to rest before its diagnostics are published.
rest :: Milliseconds -> Milliseconds
rest (Milliseconds now) = Milliseconds (now + 200)

-- | When to bring the next 'Due'.
deadline :: Session -> Maybe Milliseconds
deadline session = case Maybe.mapMaybe due (Map.elems (documents session)) of
  [] -> Nothing
  times -> Just (minimum times)

-- | A program to look at: the path of its file, its text.
data Awaited = Awaited {path :: Text, text :: Text}
  deriving stock (Eq, Show)

-- | The programs that an event asks about and that have not been looked at since they changed.
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

isDue :: Milliseconds -> Open -> Bool
isDue now o = maybe False (<= now) (due o)

-- | What a program says. It is forced as far as its errors, so that no chain of old texts is kept.
supply :: Text -> Snapshot -> Session -> Session
supply path snapshot session = session {documents = Map.adjust supplied path (documents session)}
  where
    supplied o =
      o
        { present = Just snapshot,
          sound = if Snapshot.isGood snapshot then Just snapshot else sound o
        }

-- | The text of an open file, which goes before the one on disk.
openText :: Session -> Text -> Maybe Text
openText session path = Document.program . document <$> Map.lookup path (documents session)

-- | Handle an event.
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

-- | How the conversation ends when the client leaves now.
leaving :: Session -> Ending
leaving session = case phase session of
  Closing -> Orderly
  Waiting -> Abrupt
  Running _ -> Abrupt

-- | What is left to do when handling an event has failed: the request is refused, the texts stay.
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

logged :: Text -> Outgoing
logged why =
  Notify
    "window/logMessage"
    (Aeson.object ["type" .= (1 :: Int), "message" .= ("this is a bug in partc: " <> why)])

-- Requests

request :: Id -> Text -> Value -> Session -> (Session, [Effect])
request ident method params session = case (phase session, method) of
  (Waiting, "initialize") ->
    ( session {phase = Running (Capability.fromInitialize params)},
      [Send (Result ident Capability.welcome)]
    )
  (Waiting, _) -> refuse NotInitialized "the first request must be initialize"
  (Closing, _) -> refuse InvalidRequest "the server has been shut down"
  (Running _, "initialize") -> refuse InvalidRequest "the server is initialized already"
  (Running _, "shutdown") ->
    (session {phase = Closing, documents = Map.empty}, [Send (Result ident Null)])
  (Running client, _) -> (session, [Send (answered client)])
  where
    refuse trouble why = (session, [Send (Refusal ident (Failure trouble why))])
    answered client = case Request.method method of
      Nothing -> Refusal ident (Failure MethodNotFound ("there is no request " <> method))
      Just answer ->
        case Aeson.parseEither
          (\p -> subject p session >>= maybe (pure Null) (\s -> answer client s p))
          params of
          Left why -> Refusal ident (Failure InvalidParams (Text.pack why))
          Right result -> Result ident result

-- | The open document that parameters speak of, if it has been looked at.
subject :: Value -> Session -> Parser (Maybe Subject)
subject params session = do
  path <- named params
  pure $ do
    o <- Map.lookup path (documents session)
    now <- present o
    pure Request.Subject {Request.document = document o, Request.now = now, Request.sound = sound o}

-- | The path of the document that parameters name.
named :: Value -> Parser Text
named params = Uri.toPath <$> aboutDocument "uri" params

-- | A field of the document that parameters name.
aboutDocument :: FromJSON a => Aeson.Key -> Value -> Parser a
aboutDocument key =
  withObject "parameters" (\o -> o .: "textDocument" >>= withObject "a document" (.: key))

-- Notifications

notified :: Milliseconds -> Text -> Value -> Session -> (Session, [Effect])
notified now method params session = Maybe.fromMaybe (session, []) $ case method of
  "textDocument/didOpen" -> opened now session <$> Aeson.parseMaybe documentOf params
  "textDocument/didChange" -> changed now session <$> Aeson.parseMaybe changeOf params
  "textDocument/didSave" -> Just (outside now session, [])
  "workspace/didChangeWatchedFiles" -> Just (outside now session, [])
  "textDocument/didClose" -> Aeson.parseMaybe named params >>= closed now session
  _ -> Nothing

documentOf :: Value -> Parser Document
documentOf params = do
  uri <- aboutDocument "uri" params
  version <- optionalVersion params
  Document.open uri version <$> aboutDocument "text" params

changeOf :: Value -> Parser (Uri, Maybe Int, [Edit])
changeOf params = do
  uri <- aboutDocument "uri" params
  version <- optionalVersion params
  edits <- withObject "parameters" (.: "contentChanges") params
  pure (uri, version, edits)

optionalVersion :: Value -> Parser (Maybe Int)
optionalVersion =
  withObject "parameters" (\o -> o .: "textDocument" >>= withObject "a document" (.:? "version"))

-- | A document is looked at as soon as it is open.
opened :: Milliseconds -> Session -> Document -> (Session, [Effect])
opened now session document = (outside now (put path fresh session), [])
  where
    path = Uri.toPath (Document.uri document)
    fresh = Open {document, present = Nothing, sound = Nothing, due = Just now}

changed :: Milliseconds -> Session -> (Uri, Maybe Int, [Edit]) -> (Session, [Effect])
changed now session (uri, version, edits) = case Map.lookup path (documents session) of
  Nothing -> (session, [])
  Just o ->
    ( outside
        now
        ( put
            path
            o
              { document = Document.edit version edits (document o),
                present = Nothing,
                due = Just (rest now)
              }
            session
        ),
      []
    )
  where
    path = Uri.toPath uri

put :: Text -> Open -> Session -> Session
put path o session = session {documents = Map.insert path o (documents session)}

-- | Whatever is closed has no diagnostics any more.
closed :: Milliseconds -> Session -> Text -> Maybe (Session, [Effect])
closed now session path = case phase session of
  Running client -> leave client <$> Map.lookup path (documents session)
  Waiting -> Nothing
  Closing -> Nothing
  where
    leave client o =
      ( outside now session {documents = Map.delete path (documents session)},
        [Send (Diagnostic.publish client (document o) {Document.version = Nothing} Nothing)]
      )

-- | Files may have changed: programs that import some are looked at again.
outside :: Milliseconds -> Session -> Session
outside now session = session {documents = Map.map again (documents session)}
  where
    again o
      | any hasImports (present o) =
        o {present = Nothing, due = Just (maybe (rest now) (min (rest now)) (due o))}
      | otherwise = o
    hasImports snapshot = not (null (Snapshot.imports snapshot))

-- | Publish what is due. The text that was looked at is always the present one.
published :: Milliseconds -> Session -> (Session, [Effect])
published now session = case phase session of
  Running client ->
    ( session {documents = Map.map settled (documents session)},
      concatMap (said client) (Map.elems (documents session))
    )
  Waiting -> (session, [])
  Closing -> (session, [])
  where
    settled o = if isDue now o then o {due = Nothing} else o
    said client o =
      [ Send (Diagnostic.publish client (document o) (Just snapshot))
        | isDue now o,
          Just snapshot <- [present o]
      ]
