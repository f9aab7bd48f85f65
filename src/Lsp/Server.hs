-- | The language server on a pair of streams: a loop around the steps of "Lsp.Session". An event is
-- a message from the client or the passing of a deadline.
--
-- One thread reads a message, handles it and writes the answers, so the answers have the order of
-- the requests. While no message arrives, the thread waits until the next deadline of the session.
module Lsp.Server
  ( Host (..),
    serve,
  )
where

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
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.Either qualified as Either
import Data.Text (Text)
import Data.Text qualified as Text
import GHC.Clock (getMonotonicTimeNSec)
import Lsp.Message qualified as Message
import Lsp.Session (Awaited (..), Effect (..), Ending (..), Event (..), Milliseconds (..), Session)
import Lsp.Session qualified as Session
import Lsp.Transport qualified as Transport
import Project.LoadedProgram (LoadedProgram)
import Query.Snapshot (Check)
import Query.Snapshot qualified as Snapshot
import System.IO (Handle, hFlush, hSetBinaryMode, hWaitForInput)
import System.IO.Error (isEOFError)

-- | The streams and functions that the server works with.
data Host = Host
  { -- | the stream of messages from the client
    input :: Handle,
    -- | the stream of messages to the client, which nothing else may use
    output :: Handle,
    -- | Loads a program with its imports. The first argument maps the path of a file to its text
    -- if the file is open in the editor; this text takes precedence over the file on the disk. The
    -- other arguments are the path and the text of the program.
    load :: (Text -> Maybe Text) -> Text -> Text -> IO LoadedProgram,
    -- | finds the mistakes of a loaded program
    check :: Check
  }

-- | Serves a client until it sends @exit@ or a stream ends.
serve :: Host -> IO Ending
serve host = do
  hSetBinaryMode (input host) True
  hSetBinaryMode (output host) True
  ended <- try (loop host "" Session.start) :: IO (Either IOException Ending)
  -- A failure of the streams means that the client is gone.
  pure (Either.fromRight Abrupt ended)

-- | Handles messages and deadlines one after the other. @received@ are the bytes that have been
-- received and not yet handled.
loop :: Host -> ByteString -> Session -> IO Ending
loop host received session = case Transport.next received of
  Transport.Complete body more ->
    handle host (Received (Message.decode body)) session >>= continue host more
  Transport.Headless more -> loop host more session
  Transport.Incomplete missing -> do
    now <- clock
    arrived <- case Session.deadline session of
      Nothing -> receive host missing
      Just time -> do
        ready <- inputWithin host (time `after` now)
        if ready then receive host missing else pure (Just "")
    case arrived of
      Nothing -> pure (Session.leaving session)
      Just "" -> handle host Due session >>= continue host received
      Just bytes -> loop host (received <> bytes) session

-- | Continues the loop with the session in @outcome@. If @outcome@ is the end of the conversation,
-- the loop ends. @received@ are the bytes not yet handled.
continue :: Host -> ByteString -> Either Ending Session -> IO Ending
continue host received outcome = case outcome of
  Left ending -> pure ending
  Right session -> loop host received session

-- | Receives bytes from the client; nothing at the end of the input. @missing@ is the least count
-- of bytes that the current message lacks. If @missing@ is above 64 KiB, the function waits for all
-- these bytes. Otherwise it returns the bytes that have arrived, at most 64 KiB.
receive :: Host -> Int -> IO (Maybe ByteString)
receive host missing = do
  bytes <-
    if missing > chunk
      then ByteString.hGet (input host) missing
      else ByteString.hGetSome (input host) chunk
  pure (if ByteString.null bytes then Nothing else Just bytes)
  where
    chunk = 65536

-- | True if bytes or the end of the input arrive within @wait@ milliseconds.
inputWithin :: Host -> Int -> IO Bool
inputWithin host wait = do
  ready <- try (hWaitForInput (input host) wait)
  case ready of
    Right answer -> pure answer
    Left e | isEOFError e -> pure True
    Left e -> throwIO e

-- | The milliseconds from @now@ to @time@, or 0 if @time@ is earlier.
after :: Milliseconds -> Milliseconds -> Int
after (Milliseconds time) (Milliseconds now) = max 0 (time - now)

-- | The present time of a clock that never goes back, since an arbitrary origin.
clock :: IO Milliseconds
clock = Milliseconds . fromIntegral . (`div` 1000000) <$> getMonotonicTimeNSec

-- | Handles an event and sends the messages that answer it. The result is the next session, or the
-- end of the conversation. An exception in the handling does not end the conversation (see
-- 'Session.failed'), except 'UserInterrupt' and 'ThreadKilled', which come from outside.
handle :: Host -> Event -> Session -> IO (Either Ending Session)
handle host event session = do
  now <- clock
  outcome <- try (handled host now event session)
  (session', ending, bytes) <- case outcome of
    Right done -> pure done
    Left e -> case fromException e of
      Just UserInterrupt -> throwIO UserInterrupt
      Just ThreadKilled -> throwIO ThreadKilled
      _ -> prepared (Session.failed now (firstLine e) event session)
  mapM_ (ByteString.hPut (output host) . Transport.framed) bytes
  hFlush (output host)
  pure (maybe (Right session') Left ending)
  where
    firstLine :: SomeException -> Text
    firstLine e = Text.takeWhile (/= '\n') (Text.pack (displayException e))

-- | The session after an event, the end of the conversation if the event ends it, and the messages
-- to send, encoded. The session and the messages are evaluated here, so that 'handle' catches their
-- exceptions.
handled :: Host -> Milliseconds -> Event -> Session -> IO (Session, Maybe Ending, [ByteString])
handled host now event session = do
  supplied <-
    foldl (\earlier a -> earlier >>= supply a) (pure session) (Session.awaited now event session)
  prepared (Session.step now event supplied)
  where
    supply Awaited {path, text} earlier = do
      loaded <- load host (Session.openText earlier) path text
      evaluate (Session.supply path (Snapshot.take (check host) loaded) earlier)

-- | Evaluates a session and encodes the messages among the effects of a step. The @Maybe@ is the
-- end of the conversation, if it is among the effects.
prepared :: (Session, [Effect]) -> IO (Session, Maybe Ending, [ByteString])
prepared (session, effects) = do
  state <- evaluate session
  bytes <- mapM evaluate [Message.encode m | Send m <- effects]
  pure (state, lookup () [((), e) | Stop e <- effects], bytes)
