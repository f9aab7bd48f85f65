-- | Messages of the protocol on the streams of a server, for tests.
module Lsp.Stream
  ( opened,
    question,
    notice,
    send,
    nextFrom,
    until',
    within,
  )
where

import Data.Aeson (Value (..), object, (.=))
import Data.Aeson qualified as Aeson
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Text (Text)
import Lsp.Talk (addressOf)
import Lsp.Transport (Received (..))
import Lsp.Transport qualified as Transport
import System.IO (Handle, hFlush)
import System.Timeout (timeout)

opened :: Text -> ByteString
opened text =
  notice
    "textDocument/didOpen"
    ( object
        [ "textDocument"
            .= object
              [ "uri" .= addressOf,
                "languageId" .= ("part" :: Text),
                "version" .= (1 :: Int),
                "text" .= text
              ]
        ]
    )

question :: Int -> Text -> Value -> ByteString
question ident method params = encoded ["id" .= ident, "method" .= method, "params" .= params]

notice :: Text -> Value -> ByteString
notice method params = encoded ["method" .= method, "params" .= params]

encoded :: [(Aeson.Key, Value)] -> ByteString
encoded fields =
  LazyByteString.toStrict (Aeson.encode (object (("jsonrpc" .= ("2.0" :: Text)) : fields)))

send :: Handle -> ByteString -> IO ()
send to message = ByteString.hPut to (Transport.framed message) *> hFlush to

-- | The next message and the bytes received after it. The bytes given were received before.
nextFrom :: ByteString -> Handle -> IO (ByteString, Value)
nextFrom waiting from = case Transport.next waiting of
  Complete body rest | Just value <- Aeson.decodeStrict body -> pure (rest, value)
  Incomplete _ -> do
    bytes <- ByteString.hGetSome from 65536
    if ByteString.null bytes then fail "the server is gone" else nextFrom (waiting <> bytes) from
  _ -> fail "this is not the protocol"

-- | Messages up to the first that fulfils a condition, and the bytes received after it.
until' :: (Value -> Bool) -> ByteString -> Handle -> IO (ByteString, [Value])
until' isLast received from = do
  (rest, value) <- nextFrom received from
  if isLast value
    then pure (rest, [value])
    else fmap (value :) <$> until' isLast rest from

-- | Fails after half a minute.
within :: IO a -> IO a
within act = timeout 30000000 act >>= maybe (fail "the server did not answer in time") pure
