-- | Client of the preview's server for tests, which can also send what no browser sends.
module Preview.WebClient
  ( Address (..),
    addressFrom,
    hostOf,
    request,
    get,
    ask,
    status,
    untilSeen,
    withConnection,
    connected,
  )
where

import Control.Exception (bracket, try)
import Data.ByteString (ByteString)
import Data.ByteString.Char8 qualified as Bytes
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
import Network.Socket
  ( AddrInfo (..),
    Socket,
    SocketType (Stream),
    close,
    connect,
    defaultHints,
    getAddrInfo,
    openSocket,
  )
import Network.Socket.ByteString (recv, sendAll)
import System.Timeout (timeout)

-- | Address of a page: its port, and its path with the token.
data Address = Address {port :: String, path :: ByteString}

-- | Address from the text that the server gives.
addressFrom :: Text -> Address
addressFrom text = Address {port = Bytes.unpack digits, path = rest}
  where
    (front, rest) = Bytes.breakSubstring "/" (Bytes.drop 7 (Encoding.encodeUtf8 text))
    digits = Bytes.drop 1 (Bytes.dropWhile (/= ':') front)

hostOf :: Address -> ByteString
hostOf address = "127.0.0.1:" <> Bytes.pack (port address)

-- | Request of the page for a thing, with further headers.
request :: Address -> ByteString -> [ByteString] -> ByteString
request address name = get (path address <> name) (hostOf address)

get :: ByteString -> ByteString -> [ByteString] -> ByteString
get target host others =
  Bytes.concat (map (<> "\r\n") (first : "Host: " <> host : "Connection: close" : others <> [""]))
  where
    first = "GET " <> target <> " HTTP/1.1"

-- | The answer to a request, or what came of it within two seconds.
ask :: Address -> ByteString -> IO ByteString
ask address bytes = withConnection address $ \socket -> do
  _ <- try (sendAll socket bytes) :: IO (Either IOError ())
  Bytes.concat . reverse <$> received socket []
  where
    received socket chunks = do
      chunk <- try (timeout 2000000 (recv socket 65536)) :: IO (Either IOError (Maybe ByteString))
      case chunk of
        Right (Just bytes') | not (Bytes.null bytes') -> received socket (bytes' : chunks)
        _ -> pure chunks

status :: ByteString -> ByteString
status answer = Bytes.take 3 (Bytes.drop 9 answer)

-- | Reads until a word was seen; false at the end of the stream.
untilSeen :: Socket -> ByteString -> IO Bool
untilSeen socket word = go ""
  where
    go seen
      | word `Bytes.isInfixOf` seen = pure True
      | otherwise = do
        chunk <- recv socket 4096
        if Bytes.null chunk then pure False else go (seen <> chunk)

withConnection :: Address -> (Socket -> IO a) -> IO a
withConnection address = bracket (connected address) close

connected :: Address -> IO Socket
connected address = do
  found <- getAddrInfo (Just hints) (Just "127.0.0.1") (Just (port address))
  case listToMaybe found of
    Nothing -> fail "no address"
    Just there -> do
      socket <- openSocket there
      socket <$ connect socket (addrAddress there)
  where
    hints = defaultHints {addrSocketType = Stream}
