-- | The conversation with one client (an editor) in the Language Server Protocol, as a state
-- machine. A step takes a state and an event, and gives the next state and the effects: messages to
-- send, and orders to the worker. All functions are pure.
--
-- A snapshot is one state of a program's text with its imported files, as analysed by the compiler.
-- Hover, definition and symbols are answered from the last snapshot at once. Other requests wait
-- for the snapshot of the present text, but not longer than 'Schedule.patience'.
--
-- The argument @now@ is the present time. An analysis is /due/ when the time has come to begin it.
module Lsp.Session
  ( openTexts,
    step,
    leaving,
    failed,
    bug,
  )
where

import Data.Aeson (FromJSON, Value (..), withObject, (.:), (.:?))
import Data.Aeson qualified as Aeson
import Data.Aeson.Types (Parser)
import Data.Aeson.Types qualified as Aeson (parseEither, parseMaybe)
import Data.List (partition)
import Data.Map.Strict qualified as Map
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Capability (Client)
import Lsp.Capability qualified as Capability
import Lsp.Conversation
import Lsp.Diagnostic qualified as Diagnostic
import Lsp.Document (Document, Edit)
import Lsp.Document qualified as Document
import Lsp.Message (ErrorCode (..), Failure (..), Id, Incoming (..), Outgoing (..))
import Lsp.OpenDocument (Milliseconds, OpenDocument (..), WaitingRequest (..), plus)
import Lsp.OpenDocument qualified as OpenDocument
import Lsp.Request qualified as Request
import Lsp.Schedule qualified as Schedule
import Lsp.Status (Interruption (..))
import Lsp.Status qualified as Status
import Lsp.Uri (Uri)
import Lsp.Uri qualified as Uri

-- | The paths and the texts of the open documents.
openTexts :: Session -> [(Text, Text)]
openTexts session = Map.toList (Map.map (Document.program . document) (documents session))

-- | Handles an event, and then does what is due.
step :: Milliseconds -> Event -> Session -> (Session, [Effect])
step now event session = case client session' of
  Just c ->
    let (session'', more) = Schedule.advance c now session' in (session'', effects <> more)
  Nothing -> (session', effects)
  where
    (session', effects) = handled now event session

handled :: Milliseconds -> Event -> Session -> (Session, [Effect])
handled now event session = case event of
  Due -> (session, [])
  Worked ended outcome -> case (client session, current session) of
    (Just c, Just w) | number (work w) == ended -> Schedule.worked c now w outcome session
    _ -> (session, [])
  Received incoming -> case incoming of
    Request ident name params -> request now ident name params session
    Notification "exit" _ -> (session, [Halt, Stop (leaving session)])
    Notification name params -> Maybe.fromMaybe (session, []) $ do
      c <- client session
      notified c now name params session
    Reply -> (session, [])
    Malformed ident failure -> (session, [Send (Refusal ident failure)])

-- | The kind of end that the conversation has if the client leaves now.
leaving :: Session -> Ending
leaving session = case phase session of
  Closing -> Orderly
  Waiting -> Abrupt
  Running _ -> Abrupt

-- | Handles an event if its ordinary handling has raised an exception. The text of the exception is
-- @why@. A request is refused. For any other event, the editor's log gets @why@.
failed :: Text -> Event -> [Effect]
failed why event = case event of
  Received (Request ident _ _) ->
    [Send (Refusal ident (bug why))]
  _ -> [Send (Status.logged why)]

-- | The failure of a request whose answer has raised an exception with the text @why@.
bug :: Text -> Failure
bug why = Failure InternalError (Status.fault why)

-- Requests ----------------------------------------------------------------------------------------

-- | Answers a request, or lets it wait for results. The arguments: its identifier, the name of its
-- method, its parameters.
request :: Milliseconds -> Id -> Text -> Value -> Session -> (Session, [Effect])
request now ident name params session = case (phase session, name) of
  (Waiting, "initialize") ->
    ( session {phase = Running (Capability.fromInitialize params)},
      [Send (Result ident Capability.initializeResult)]
    )
  (Waiting, _) -> refuse NotInitialized "the first request must be initialize"
  (Closing, _) -> refuse InvalidRequest "the server has been shut down"
  (Running _, "initialize") -> refuse InvalidRequest "the server is initialized already"
  (Running _, "shutdown") ->
    ( start {phase = Closing},
      Halt :
      concatMap refusals (Map.keys (documents session))
        <> [Send (Result ident Null)]
    )
  (Running _, _)
    | Just ofAll <- Request.workspaceMethod name ->
      let subjects = map (OpenDocument.subject []) (Map.elems (documents session))
       in (session, [Answer ident (Schedule.answered ident (ofAll subjects) params)])
  (Running _, "workspace/executeCommand") -> case Aeson.parseMaybe previewed params of
    Just path
      | Map.member path (documents session) -> (session, [ForPage (OpenPage ident path)])
      | otherwise -> refuse InvalidParams "this document is not open"
    Nothing -> refuse InvalidParams "the command is partc.preview, with the address of a document"
  (Running c, _) -> case (Request.method name, Aeson.parseEither named params) of
    (Nothing, _) -> refuse MethodNotFound ("there is no request " <> name)
    (_, Left why) -> refuse InvalidParams (Text.pack why)
    (_, Right path) ->
      let (session', effects) = asked now c path waitingRequest session
       in (session', effects <> cursorEffects name params)
  where
    refusals path = snd (Schedule.refuseWaiting Schedule.tooLate path session)
    refuse code why = (session, [Send (Refusal ident (Failure code why))])
    waitingRequest =
      WaitingRequest
        { identifier = ident,
          method = name,
          parameters = params,
          refusedAt = now `plus` Schedule.patience (Request.need name)
        }

-- | The path of the document in the command @partc.preview@.
previewed :: Value -> Parser Text
previewed = withObject "parameters" $ \o -> do
  command <- o .: "command"
  arguments <- o .: "arguments"
  case (command :: Text, arguments) of
    ("partc.preview", [uri]) -> pure (Uri.toPath uri)
    _ -> fail "another command"

-- | The order to the pages of the preview for a message that says where the cursor is: the
-- notification of our own extension, or the request that other editors send for the name at the
-- cursor.
cursorEffects :: Text -> Value -> [Effect]
cursorEffects name params
  | name `elem` ["partc/cursor", "textDocument/documentHighlight"],
    Just (path, line) <- Aeson.parseMaybe cursorOf params =
    [ForPage (CursorAt path (line + 1))]
  | otherwise = []
  where
    cursorOf all' = (,) <$> named all' <*> withObject "parameters" lineOf all'
    lineOf o = o .: "position" >>= withObject "a position" (.: "line")

-- | Answers a request about the document with this path, or lets it wait for results.
asked :: Milliseconds -> Client -> Text -> WaitingRequest -> Session -> (Session, [Effect])
asked now c path r session = case Map.lookup path (documents session) of
  Nothing -> (session, [Send (Result (identifier r) Null)])
  Just o
    | Schedule.isReady session o r -> (session, [Schedule.answer c session o r])
    | otherwise -> (adjusted path waits session, [])
  where
    -- The analysis begins now, because the user waits for the answer.
    waits o = o {waiting = r : waiting o, due = now <$ due o}

-- | The path of the document that the parameters of a message name.
named :: Value -> Parser Text
named params = Uri.toPath <$> documentField "uri" params

-- | The field @key@ of the object @textDocument@ in the parameters of a message.
documentField :: FromJSON a => Aeson.Key -> Value -> Parser a
documentField key =
  withObject "parameters" (\o -> o .: "textDocument" >>= withObject "a document" (.: key))

-- Notifications -----------------------------------------------------------------------------------

-- | Handles a notification; @name@ is its method. Unknown notifications and wrong parameters have
-- no effect.
notified :: Client -> Milliseconds -> Text -> Value -> Session -> Maybe (Session, [Effect])
notified c now name params session = case name of
  "initialized" -> Just (session, map Send (Status.watchFiles c))
  "textDocument/didOpen" -> opened now session <$> Aeson.parseMaybe documentOf params
  "textDocument/didChange" -> Aeson.parseMaybe changeOf params >>= edited now session
  "textDocument/didSave" -> Just (changedWhere now (const True) session)
  "textDocument/didClose" -> Aeson.parseMaybe named params >>= closed c now session
  "partc/cursor" -> Just (session, cursorEffects name params)
  "workspace/didChangeWatchedFiles" -> do
    paths <- Aeson.parseMaybe changedFiles params
    Just (changedWhere now (\o -> any (`OpenDocument.dependsOn` o) paths) session)
  "window/workDoneProgress/cancel" -> do
    w <- current session
    if Status.cancelledWork params == Just (number (work w))
      then Just (Schedule.halt c StoppedByUser w session)
      else Nothing
  "$/cancelRequest" ->
    cancelled session <$> Aeson.parseMaybe (withObject "parameters" (.: "id")) params
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

-- | The paths of the files that have changed on the disk.
changedFiles :: Value -> Parser [Text]
changedFiles = withObject "parameters" $ \o ->
  o .: "changes" >>= traverse (withObject "a change" (fmap Uri.toPath . (.: "uri")))

-- | Opens a document. Its analysis is due at once.
opened :: Milliseconds -> Session -> Document -> (Session, [Effect])
opened now session document =
  dependentsChanged now path $
    session {documents = Map.insert path (OpenDocument.open now document) (documents session)}
  where
    path = Uri.toPath (Document.uri document)

-- | Edits a document; nothing if it is not open. The tuple has the address of the document, its
-- version after the edits, and the edits.
edited :: Milliseconds -> Session -> (Uri, Maybe Int, [Edit]) -> Maybe (Session, [Effect])
edited now session (uri, version, edits) = do
  o <- Map.lookup path (documents session)
  let text = Document.edit version edits (document o)
      (session', effects) = changed now path (adjusted path (\d -> d {document = text}) session)
      (session'', more) = dependentsChanged now path session'
  Just (session'', effects <> more)
  where
    path = Uri.toPath uri

-- | Marks the document with this path for a new analysis. The running analysis of an older text is
-- stopped, and requests that wait for it are refused.
changed :: Milliseconds -> Text -> Session -> (Session, [Effect])
changed now path session =
  (adjusted path (OpenDocument.changed now) session'', effects <> refusals)
  where
    (session', effects) = Schedule.abandon path session
    (session'', refusals) = Schedule.refuseWaiting Schedule.tooLate path session'

-- | Marks the documents that depend on the file with this path for a new analysis.
dependentsChanged :: Milliseconds -> Text -> Session -> (Session, [Effect])
dependentsChanged now path = changedWhere now (OpenDocument.dependsOn path)

-- | Marks those documents for a new analysis that depend on other files and fulfil a condition.
changedWhere :: Milliseconds -> (OpenDocument -> Bool) -> Session -> (Session, [Effect])
changedWhere now condition session =
  foldl
    (\(s, effects) path -> let (s', more) = changed now path s in (s', effects <> more))
    (session, [])
    [ path
      | (path, o) <- Map.toList (documents session),
        OpenDocument.hasDependencies o && condition o
    ]

-- | Closes the document with this path and removes its diagnostics from the editor. Nothing if the
-- document is not open.
closed :: Client -> Milliseconds -> Session -> Text -> Maybe (Session, [Effect])
closed c now session path = do
  o <- Map.lookup path (documents session)
  let (session', effects) = changed now path session
      (session'', more) =
        dependentsChanged
          now
          path
          session'
            { documents = Map.delete path (documents session'),
              queue = filter (/= path) (queue session')
            }
      removal = Diagnostic.publish c (document o) {Document.version = Nothing} Nothing
  Just (session'', effects <> [Send removal] <> more)

-- | Refuses the waiting request with this identifier.
cancelled :: Session -> Id -> (Session, [Effect])
cancelled session ident =
  ( session {documents = Map.map (\o -> o {waiting = snd (divided o)}) (documents session)},
    [ Send (Refusal ident (Failure RequestCancelled "the request was cancelled"))
      | o <- Map.elems (documents session),
        _ <- fst (divided o)
    ]
  )
  where
    divided o = partition ((== ident) . identifier) (waiting o)
