-- | The language server on a pair of streams: a loop around the steps of "Lsp.Session".
--
-- Four threads share the work. The reader receives messages. The writer sends messages, so that a
-- client that does not read stops nothing else. The worker analyses texts; its work can be stopped
-- at any time. The main thread takes events one after the other (a message, a result of the worker,
-- the passing of a deadline) and does only short steps. Each answer about a document is computed by
-- a short thread of its own.
module Lsp.Server
  ( Host (..),
    serve,
  )
where

import Control.Concurrent
  ( Chan,
    MVar,
    ThreadId,
    forkIO,
    killThread,
    modifyMVar_,
    newChan,
    newEmptyMVar,
    newMVar,
    putMVar,
    readChan,
    readMVar,
    takeMVar,
    threadDelay,
    writeChan,
  )
import Control.Exception
  ( AsyncException (..),
    IOException,
    SomeException,
    displayException,
    evaluate,
    fromException,
    throwIO,
    try,
  )
import Control.Monad (unless, void, when)
import Data.Aeson (Value (String), object, (.=))
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import GHC.Clock (getMonotonicTimeNSec)
import GHC.Stats qualified as Stats
import Lsp.Capability (Client (showsDocuments))
import Lsp.Conversation
import Lsp.Diagnostic qualified as Diagnostic
import Lsp.Message (Id, Outgoing (Ask, Refusal, Result))
import Lsp.Message qualified as Message
import Lsp.OpenDocument (Milliseconds (..))
import Lsp.PreviewPages (Pages)
import Lsp.PreviewPages qualified as PreviewPages
import Lsp.Schedule qualified as Schedule
import Lsp.Session qualified as Session
import Lsp.Transport qualified as Transport
import Preview.Subject qualified as Subject
import Project.LoadedProgram (LoadedProgram)
import Project.MachineDescription qualified as MachineDescription
import Query.Snapshot (Check)
import Query.Snapshot qualified as Snapshot
import Query.TapeFacts (TapeFacts)
import System.Exit (ExitCode (..))
import System.IO (Handle, hFlush, hSetBinaryMode)
import System.Posix.Process (exitImmediately)
import System.Timeout (timeout)

-- | The streams and functions that the server works with.
data Host = Host
  { -- | the stream of messages from the client
    input :: Handle,
    -- | the stream of messages to the client, which nothing else may use
    output :: Handle,
    -- | Loads a program with its imports. The first argument has the paths and the texts of the
    -- files that are open in the editor; these texts take precedence over the files on the disk.
    -- The other arguments are the path and the text of the program.
    load :: [(Text, Text)] -> Text -> Text -> IO LoadedProgram,
    -- | finds the mistakes of a loaded program
    check :: Check,
    -- | makes the tape of a program for its machine and proves it
    prove :: LoadedProgram -> TapeFacts
  }

-- | Serves a client until it sends @exit@ or a stream ends.
serve :: Host -> IO Ending
serve host = do
  hSetBinaryMode (input host) True
  hSetBinaryMode (output host) True
  events <- newChan
  messages <- newChan
  answers <- newMVar 0
  hasWritten <- newEmptyMVar
  _ <- forkIO (readMessages (input host) events)
  _ <- forkIO (writeMessages (output host) messages events >> putMVar hasWritten ())
  pages <- PreviewPages.none
  ending <- converse Lines {host, pages, events, messages, answers} Nothing start
  _ <- timeout patience (untilAnswered answers)
  writeChan messages Nothing
  isWritten <- timeout patience (takeMVar hasWritten)
  -- A client that does not read must not keep the process alive.
  unless (Maybe.isJust isWritten) (exitImmediately (ExitFailure 1))
  pure ending
  where
    patience = 80000 -- µs
    untilAnswered answers = do
      count <- readMVar answers
      unless (count == 0) (threadDelay 1000 >> untilAnswered answers)

-- | The lines between the threads: events for the main thread, of which 'Nothing' is the end of a
-- stream, and encoded messages for the writer, of which 'Nothing' is the last.
data Lines = Lines
  { host :: Host,
    pages :: Pages,
    events :: Chan (Maybe Event),
    messages :: Chan (Maybe ByteString),
    -- | the count of answers that are being computed
    answers :: MVar Int
  }

-- | Receives messages until the end of the input.
readMessages :: Handle -> Chan (Maybe Event) -> IO ()
readMessages from events = go ""
  where
    go received = case Transport.next received of
      Transport.Complete body more -> do
        incoming <- evaluate (Message.decode body)
        writeChan events (Just (Received incoming))
        go more
      Transport.Headless more -> go more
      Transport.Incomplete missing -> do
        arrived <- try (receive from missing) :: IO (Either IOException ByteString)
        case arrived of
          Right bytes | not (ByteString.null bytes) -> go (received <> bytes)
          _ -> writeChan events Nothing

-- | Receives bytes from the client; none at the end of the input. @missing@ is the least count of
-- bytes that the current message lacks. If @missing@ is above 64 KiB, the function waits for all
-- these bytes. Otherwise it returns the bytes that have arrived, at most 64 KiB.
receive :: Handle -> Int -> IO ByteString
receive from missing
  | missing > chunk = ByteString.hGet from missing
  | otherwise = ByteString.hGetSome from chunk
  where
    chunk = 65536

-- | Sends messages until the last one. If the client is gone, the main thread gets the end of the
-- stream.
writeMessages :: Handle -> Chan (Maybe ByteString) -> Chan (Maybe Event) -> IO ()
writeMessages to messages events = do
  next <- readChan messages
  case next of
    Nothing -> pure ()
    Just body -> do
      sent <- try (ByteString.hPut to (Transport.framed body) >> hFlush to)
      case sent :: Either IOException () of
        Right () -> writeMessages to messages events
        Left _ -> writeChan events Nothing

-- | Handles events one after the other. @worker@ is the thread of the running work.
converse :: Lines -> Maybe ThreadId -> Session -> IO Ending
converse between worker session = do
  now <- clock
  next <- nextEvent between now session
  case next of
    Nothing -> do
      mapM_ stopThread worker
      pure (Session.leaving session)
    Just event -> do
      (session', effects) <- handled now event session
      (worker', ending) <- performAll between session' worker effects
      maybe (converse between worker' session') pure ending

-- | The next event; nothing at the end of a stream. While the worker has work, its use of memory is
-- watched.
nextEvent :: Lines -> Milliseconds -> Session -> IO (Maybe Event)
nextEvent between@Lines {events} now session = case waits of
  [] -> readChan events
  _ -> do
    arrived <- if wait <= 0 then pure Nothing else timeout (1000 * wait) (readChan events)
    case (arrived, current session) of
      (Just event, _) -> pure event
      (Nothing, Just w) -> do
        memory <- memoryInUse
        if memory > mostMemory
          then pure (Just (Worked (number (work w)) TooLarge))
          else timePassed
      (Nothing, Nothing) -> timePassed
  where
    wait = minimum waits
    waits =
      [time `after` now | Just time <- [Schedule.deadline session]]
        <> [watchInterval | Just _ <- [current session]]
    watchInterval = 100
    timePassed = do
      later <- clock
      if any (<= later) (Schedule.deadline session)
        then pure (Just Due)
        else nextEvent between later session

-- | The greatest memory in bytes that the server may use while it analyses a text: 1 GB.
mostMemory :: Int
mostMemory = 1000000000

-- | The memory in bytes that the process has from the operating system for its data, as of the last
-- garbage collection; 0 if the collector keeps no statistics.
memoryInUse :: IO Int
memoryInUse = do
  isKnown <- Stats.getRTSStatsEnabled
  if isKnown
    then fromIntegral . Stats.gcdetails_mem_in_use_bytes . Stats.gc <$> Stats.getRTSStats
    else pure 0

-- | The milliseconds from @now@ to @time@, or 0 if @time@ is earlier.
after :: Milliseconds -> Milliseconds -> Int
after (Milliseconds time) (Milliseconds now) = max 0 (time - now)

-- | The present time of a clock that never goes back, since an arbitrary origin.
clock :: IO Milliseconds
clock = Milliseconds . fromIntegral . (`div` 1000000) <$> getMonotonicTimeNSec

-- | Handles an event. The effects are evaluated here. An exception in the handling does not end the
-- conversation (see 'Session.failed'), except 'UserInterrupt' and 'ThreadKilled', which come from
-- outside.
handled :: Milliseconds -> Event -> Session -> IO (Session, [Performed])
handled now event session = do
  outcome <- try (prepared (Session.step now event session))
  case outcome of
    Right done -> pure done
    Left e -> case fromException e of
      Just UserInterrupt -> throwIO UserInterrupt
      Just ThreadKilled -> throwIO ThreadKilled
      _ -> prepared (session, Session.failed (firstLine e) event)

-- | The first line of the text of an exception.
firstLine :: SomeException -> Text
firstLine = Text.takeWhile (/= '\n') . Text.pack . displayException

-- | An effect to perform, whose message is encoded.
data Performed = Write ByteString | Other Effect

-- | Evaluates a session and encodes the messages among the effects of a step.
prepared :: (Session, [Effect]) -> IO (Session, [Performed])
prepared (session, effects) = do
  state <- evaluate session
  performed <- mapM performedOf effects
  pure (state, performed)
  where
    performedOf effect = case effect of
      Send message -> Write <$> evaluate (Message.encode message)
      _ -> pure (Other effect)

-- | Performs effects in turn. The result has the thread of the running work, and the end of the
-- conversation if the effects contain it.
performAll ::
  Lines -> Session -> Maybe ThreadId -> [Performed] -> IO (Maybe ThreadId, Maybe Ending)
performAll between session worker effects = case effects of
  [] -> pure (worker, Nothing)
  Write bytes : more -> do
    writeChan (messages between) (Just bytes)
    performAll between session worker more
  Other effect : more -> case effect of
    Begin work -> do
      mapM_ stopThread worker
      thread <- forkIO (perform between (Session.openTexts session) work)
      performAll between session (Just thread) more
    Halt -> do
      mapM_ stopThread worker
      performAll between session Nothing more
    Stop ending -> pure (worker, Just ending)
    Answer ident answer -> do
      modifyMVar_ (answers between) (pure . (+ 1))
      _ <- forkIO (answerBeside between ident answer)
      performAll between session worker more
    ForPage order -> do
      _ <- forkIO (performOrder between session order)
      performAll between session worker more
    Send _ -> performAll between session worker more

-- | Carries out an order to the pages of the preview.
performOrder :: Lines -> Session -> PageOrder -> IO ()
performOrder Lines {host, pages, messages} session order = case order of
  CursorAt path line -> PreviewPages.cursorAt pages path line
  OpenPage ident path -> do
    found <- PreviewPages.open pages (if canShow then Just send else Nothing) path (state path)
    case found of
      Nothing -> send (Refusal ident (Session.bug "the page cannot be served"))
      Just address -> do
        send (Result ident (object ["uri" .= address]))
        when canShow (send (external address))
  where
    canShow = any showsDocuments (client session)
    send = writeChan messages . Just . Message.encode
    texts = Session.openTexts session
    state path = do
      loaded <- load host texts path (Maybe.fromMaybe "" (lookup path texts))
      pure (Subject.afterSnapshot loaded (Snapshot.take (check host) loaded))
    external address =
      Ask
        (String "show-page")
        "window/showDocument"
        (object ["uri" .= address, "external" .= True, "takeFocus" .= True])

-- | Computes and sends the answer to a request. The request is refused if this takes too long or
-- raises an exception.
answerBeside :: Lines -> Id -> Outgoing -> IO ()
answerBeside between ident answer = do
  computed <- try (timeout patience (evaluate (Message.encode answer)))
  writeChan (messages between) . Just $ case computed of
    Right (Just bytes) -> bytes
    Right Nothing -> Message.encode (Refusal ident Schedule.tooLate)
    Left e -> Message.encode (Refusal ident (Session.bug (firstLine e)))
  modifyMVar_ (answers between) (pure . subtract 1)
  where
    patience = 1000 * Schedule.waitingTime

-- | Stops a thread. The function does not wait until the thread has stopped.
stopThread :: ThreadId -> IO ()
stopThread = void . forkIO . killThread

-- | Does the work of the worker, and passes the results to the main thread. @texts@ are the open
-- documents.
perform :: Lines -> [(Text, Text)] -> WorkOrder -> IO ()
perform Lines {host, pages, events} texts WorkOrder {number, kind, path, text} = do
  ended <- try (doWork kind)
  case ended of
    Right () -> pure ()
    Left e -> case fromException e of
      Just ThreadKilled -> pure ()
      _ -> tell (Fault (firstLine e))
  where
    tell = writeChan events . Just . Worked number
    force = Snapshot.force Diagnostic.mostDiagnostics
    doWork work = case work of
      Analysis
        | MachineDescription.isDescription path -> do
          let snapshot = Snapshot.ofDescription path text
          evaluate (force snapshot)
          tell (AllChecked snapshot)
        | otherwise -> do
          loaded <- load host texts path text
          let (early, complete) = Snapshot.inStages (check host) loaded
          evaluate (force early)
          tell (EvaluationChecked early)
          evaluate (force complete)
          tell (AllChecked complete)
          PreviewPages.update pages path (Subject.afterSnapshot loaded complete)
      TapeProof -> do
        loaded <- load host texts path text
        facts <- evaluate (prove host loaded)
        tell (TapeMade facts)
