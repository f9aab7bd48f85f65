-- | Web server of the page, for this machine alone.
module Preview.Server
  ( Site,
    newSite,
    publish,
    present,
    pointAt,
    Listening (..),
    withServer,
  )
where

import Base.Result (Result (..))
import Control.Concurrent (forkIO, killThread, newEmptyMVar, putMVar, takeMVar)
import Control.Concurrent.MVar (MVar, modifyMVar, newMVar, withMVar)
import Control.Concurrent.STM
  ( TVar,
    atomically,
    check,
    modifyTVar',
    newTVarIO,
    orElse,
    readTVar,
    readTVarIO,
    registerDelay,
    writeTVar,
  )
import Control.Exception (IOException, bracket, bracket_, evaluate, try)
import Control.Monad (void)
import Data.Aeson (Value, object, withObject, (.:), (.=))
import Data.Aeson qualified as Aeson
import Data.Aeson.Types qualified as Aeson
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Builder qualified as Builder
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Network.HTTP.Types (Header)
import Network.HTTP.Types qualified as Http
import Network.Wai (Application, Request, Response)
import Network.Wai qualified as Wai
import Network.Wai.Handler.Warp qualified as Warp
import Numeric (showHex)
import Preview.Drawing qualified as Drawing
import Preview.Guard (Asked (..), Door (..), Rejection (..), Resource (..))
import Preview.Guard qualified as Guard
import Preview.Page qualified as Page
import Preview.Playback qualified as Playback
import Preview.PulseColumns qualified as PulseColumns
import Preview.Subject (Followed (..))
import Preview.TapeMeaning qualified as TapeMeaning
import Preview.TapeRun (TapeRun)
import Preview.TapeRun qualified as TapeRun
import Report.Report (Report)
import System.IO (IOMode (ReadMode), withBinaryFile)

-- | State that the server shows.
data Site = Site
  { shown :: TVar Followed,
    -- | place of the editor's cursor, file and line, with the count of its changes
    cursor :: TVar (Int, Maybe (Int, Int)),
    -- | tapes of the present version by their machines
    tapes :: MVar (Int, Map Text (Result Report Report TapeRun)),
    -- | held while the state changes
    publishing :: MVar (),
    -- | counts of open connections, and of open streams of events
    connections :: TVar Int,
    streams :: TVar Int,
    -- | moves the cursor of the editor to a file of the state, a line and a column; Nothing without
    -- an editor
    showPlace :: Maybe (Followed -> Int -> Int -> Int -> IO ())
  }

-- | New site with its first state.
newSite :: Maybe (Followed -> Int -> Int -> Int -> IO ()) -> Followed -> IO Site
newSite showPlace now = do
  shown <- newTVarIO now
  cursor <- newTVarIO (0, Nothing)
  tapes <- newMVar (version now, Map.empty)
  publishing <- newMVar ()
  connections <- newTVarIO 0
  streams <- newTVarIO 0
  pure Site {shown, cursor, tapes, publishing, connections, streams, showPlace}

-- | Changes the state; all open pages are told.
publish :: Site -> (Followed -> Followed) -> IO ()
publish site change = withMVar (publishing site) $ \() -> do
  next <- change <$> readTVarIO (shown site)
  -- The reports are evaluated here, not by the thread that first answers a request.
  _ <- evaluate (length (reports next))
  atomically (writeTVar (shown site) next)

-- | Present state.
present :: Site -> IO Followed
present = readTVarIO . shown

-- | Tells all open pages the file and the line of the editor's cursor.
pointAt :: Site -> Int -> Int -> IO ()
pointAt site file line =
  atomically (modifyTVar' (cursor site) (\(n, _) -> (n + 1, Just (file, line))))

-- | Wish for the port: any free one, or a certain one.
data Listening = AnyPort | AtPort Int

-- | Serves a site while an action runs, which gets the address of the page. 'Left' if the port
-- cannot be used.
withServer :: Listening -> Site -> (Text -> IO a) -> IO (Either IOException a)
withServer wish site action = do
  token <- newToken
  case wish of
    AnyPort -> try $ do
      (port, socket) <- Warp.openFreePort
      around token port (`Warp.runSettingsSocket` socket)
    AtPort port -> try (around token port (Warp.runSettings . Warp.setPort port))
  where
    around token port run = do
      ready <- newEmptyMVar
      let serve = do
            let settings = Warp.setBeforeMainLoop (putMVar ready (Right ())) quiet
            ended <- try (run settings (application Door {port, token} site))
            putMVar ready (ended :: Either IOException ())
      bracket (forkIO serve) killThread $ \_ ->
        takeMVar ready >>= either ioError pure
          >> action ("http://127.0.0.1:" <> Text.pack (show port) <> "/" <> token <> "/")
    quiet =
      Warp.setHost "127.0.0.1"
        . Warp.setServerName ""
        . Warp.setTimeout 30
        . Warp.setHTTP2Disabled
        -- More connections would use up the descriptors.
        . Warp.setOnOpen (const (opened site 1 >>= \n -> pure (n <= mostConnections)))
        . Warp.setOnClose (const (void (opened site (-1))))
        . Warp.setMaxTotalHeaderLength 16384
        . Warp.setOnException (\_ _ -> pure ())
        $ Warp.defaultSettings

-- | Count of the open connections after a change of it.
opened :: Site -> Int -> IO Int
opened site change = atomically $ do
  modifyTVar' (connections site) (+ change)
  readTVar (connections site)

-- | Greatest count of open connections. A page has one or two, and a browser opens at most six.
mostConnections :: Int
mostConnections = 48

-- | Random token of 128 bits in hexadecimal digits.
newToken :: IO Text
newToken = do
  bytes <- withBinaryFile "/dev/urandom" ReadMode (`ByteString.hGet` 16)
  pure (Text.pack (concatMap twoDigits (ByteString.unpack bytes)))
  where
    twoDigits w = let digits = showHex w "" in replicate (2 - length digits) '0' <> digits

-- | Answers requests that the guard accepts.
application :: Door -> Site -> Application
application door site request respond =
  case Guard.judge door (askedIn request) of
    Left refusal -> respond (refused refusal)
    Right found -> do
      now <- present site
      answer site now request found >>= respond

askedIn :: Request -> Asked
askedIn request =
  Asked
    { method = Wai.requestMethod request,
      path = filter (not . Text.null) (Wai.pathInfo request),
      query = Wai.queryString request,
      host = Wai.requestHeaderHost request,
      origin = header "Origin",
      fetchSite = header "Sec-Fetch-Site",
      bodyLength = case Wai.requestBodyLength request of
        Wai.KnownLength n -> Just (fromIntegral (min n (fromIntegral (maxBound :: Int))))
        Wai.ChunkedBody -> Nothing
    }
  where
    header name = lookup name (Wai.requestHeaders request)

-- | Answer to a request that is accepted.
answer :: Site -> Followed -> Request -> Resource -> IO Response
answer site now request found = case found of
  PageFile name -> pure (maybe (refused NotFound) (uncurry pageFile) (Page.find name))
  Drawing -> container (Drawing.container (isJust (showPlace site)) now)
  Run name -> tapeFor site now name >>= container . runOf name
  PulsesOf name -> pulsesOf site now name >>= container
  RowsOf name from to -> do
    made <- tapeFor site now name
    let list = maybe [] (\played -> TapeMeaning.rowList played from to) (output made)
    pure (json (Aeson.toJSON list))
  Events -> eventStream site
  ShowPlace -> placed site now request
  where
    runOf name made = case output made of
      Just played -> Playback.runContainer now played (errors made <> warnings made)
      Nothing -> Playback.refusedContainer now name (errors made <> warnings made)

-- | Pulses of a run. Two runs are made from two readings of the tape: one that is read twice would
-- stay in memory as a whole.
pulsesOf :: Site -> Followed -> Text -> IO LazyByteString.ByteString
pulsesOf site now name = do
  once <- output <$> tapeFor site now name
  again <- output <$> tapeFor site now name
  pure $ case (once, again) of
    (Just a, Just b) -> PulseColumns.container (version now) a b
    _ -> PulseColumns.nothing (version now)

-- | Tape of the present version for a machine, which is made when it is first needed.
tapeFor :: Site -> Followed -> Text -> IO (Result Report Report TapeRun)
tapeFor site now name = modifyMVar (tapes site) $ \(of', known) ->
  let usable = if of' == version now then known else Map.empty
      made = Map.findWithDefault (maybe nothing (fromSound . snd) (sound now)) name usable
      kept = if Map.size usable < mostTapes then usable else Map.empty
   in pure ((version now, Map.insert name made kept), made)
  where
    fromSound subject = TapeRun.fromSound subject name
    nothing = Result [] [] Nothing

-- | Greatest count of tapes that are kept.
mostTapes :: Int
mostTapes = 16

-- | Moves the cursor of the editor.
placed :: Site -> Followed -> Request -> IO Response
placed site now request = case showPlace site of
  Nothing -> pure (refused NotFound)
  Just move -> do
    body <- bodyOf request
    case Aeson.decodeStrict body >>= Aeson.parseMaybe place of
      Nothing -> pure (refused BadQuery)
      Just (file, line, column) -> do
        move now file line column
        pure (Wai.responseLBS Http.noContent204 common "")
  where
    place = withObject "place" (\o -> (,,) <$> o .: "file" <*> o .: "line" <*> o .: "column")

-- | Body of a request, up to the greatest length that is allowed.
bodyOf :: Request -> IO ByteString
bodyOf request = go ""
  where
    go read' = do
      chunk <- Wai.getRequestBodyChunk request
      let now = read' <> chunk
      if ByteString.null chunk || ByteString.length now > Guard.mostBody then pure now else go now

-- Events ------------------------------------------------------------------------------------------

-- | Greatest count of streams of events. Each browser window has one.
mostStreams :: Int
mostStreams = 32

-- | Stream of events, until the browser goes away. A comment every 15 seconds finds out if it has.
eventStream :: Site -> IO Response
eventStream site = do
  open <- readTVarIO (streams site)
  pure $
    if open >= mostStreams
      then Wai.responseLBS Http.serviceUnavailable503 common "too many pages are open"
      else Wai.responseStream Http.ok200 (("Content-Type", "text/event-stream") : common) stream
  where
    stream write flush =
      bracket_ (count 1) (count (-1)) $ do
        (n, _) <- readTVarIO (cursor site)
        let go told = do
              (message, told') <- next told
              write message >> flush >> go told'
        go (-1, n)
    count k = atomically (modifyTVar' (streams site) (+ k))
    next told = do
      timer <- registerDelay 15000000
      atomically (changed told `orElse` ((": still here\n\n", told) <$ (readTVar timer >>= check)))
    changed told@(v, n) = do
      now <- version <$> readTVar (shown site)
      (m, place) <- readTVar (cursor site)
      check (now /= v || m /= n)
      pure $
        if now /= v
          then (event (object ["version" .= now]), (now, n))
          else (maybe "" cursorEvent place, (fst told, m))
    cursorEvent (file, line) = event (object ["cursor" .= object ["file" .= file, "line" .= line]])
    event value = "data: " <> Builder.lazyByteString (Aeson.encode value) <> "\n\n"

-- Responses ---------------------------------------------------------------------------------------

pageFile :: ByteString -> ByteString -> Response
pageFile kind bytes =
  Wai.responseLBS
    Http.ok200
    (("Content-Type", kind) : common)
    (LazyByteString.fromStrict bytes)

-- | Response with a container, which is computed before the response begins.
container :: LazyByteString.ByteString -> IO Response
container bytes = Wai.responseLBS Http.ok200 given bytes <$ evaluate (LazyByteString.length bytes)
  where
    given = ("Content-Type", "application/octet-stream") : common

json :: Value -> Response
json = Wai.responseLBS Http.ok200 (("Content-Type", "application/json") : common) . Aeson.encode

-- | Headers of all responses: nothing from elsewhere runs in the page, and nothing is stored.
common :: [Header]
common =
  [ ( "Content-Security-Policy",
      "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; \
      \object-src 'none'"
    ),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cache-Control", "no-store")
  ]

-- | Response to a refused request.
refused :: Rejection -> Response
refused refusal =
  Wai.responseLBS status (("Content-Type", "text/plain; charset=utf-8") : common) words'
  where
    (status, words') = case refusal of
      WrongHost -> (Http.forbidden403, "this host name is not that of the page")
      WrongOrigin -> (Http.forbidden403, "another site may not ask")
      WrongMethod -> (Http.methodNotAllowed405, "this method is not allowed here")
      NotFound -> (Http.notFound404, "there is nothing here")
      TooLarge -> (Http.requestEntityTooLarge413, "the request is too large")
      BadQuery -> (Http.badRequest400, "the request cannot be understood")
