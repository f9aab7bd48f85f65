-- | The envelope of messages: JSON-RPC 2.0.
module Lsp.Message
  ( Incoming (..),
    Id,
    decode,
    Outgoing (..),
    Failure (..),
    ErrorCode (..),
    encode,
  )
where

import Data.Aeson (Value (..), object, (.=))
import Data.Aeson qualified as Aeson
import Data.Aeson.KeyMap qualified as KeyMap
import Data.ByteString (ByteString)
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Maybe qualified as Maybe
import Data.Text (Text)

-- | What a client sends.
data Incoming
  = -- | the number or text that the answer repeats, the method, the parameters
    Request Id Text Value
  | Notification Text Value
  | -- | an answer to a request of ours; we send none
    Reply
  | -- | something else: what to answer
    Malformed Failure
  deriving stock (Eq, Show)

type Id = Value

-- | What the server sends.
data Outgoing
  = Result Id Value
  | Refusal Id Failure
  | Notify Text Value
  deriving stock (Eq, Show)

-- | Why a request has no result.
data Failure = Failure ErrorCode Text
  deriving stock (Eq, Show)

data ErrorCode
  = ParseError
  | InvalidRequest
  | MethodNotFound
  | InvalidParams
  | InternalError
  | NotInitialized
  deriving stock (Eq, Show, Enum, Bounded)

-- | Read a message.
decode :: ByteString -> Incoming
decode body = case Aeson.decodeStrict' body of
  Nothing -> Malformed (Failure ParseError "this is not JSON")
  Just (Object o) -> case (KeyMap.lookup "method" o, KeyMap.lookup "id" o) of
    (Just (String method), Just ident) -> Request ident method (params o)
    (Just (String method), Nothing) -> Notification method (params o)
    (Nothing, Just _) | any (`KeyMap.member` o) ["result", "error"] -> Reply
    _ -> invalid
  Just _ -> invalid
  where
    params o = Maybe.fromMaybe Null (KeyMap.lookup "params" o)
    invalid = Malformed (Failure InvalidRequest "this is no message of the protocol")

-- | Write a message.
encode :: Outgoing -> ByteString
encode outgoing = LazyByteString.toStrict . Aeson.encode $ case outgoing of
  Result ident result -> object [version, "id" .= ident, "result" .= result]
  Refusal ident (Failure trouble words') ->
    object
      [version, "id" .= ident, "error" .= object ["code" .= number trouble, "message" .= words']]
  Notify method params -> object [version, "method" .= method, "params" .= params]
  where
    version = "jsonrpc" .= ("2.0" :: Text)

number :: ErrorCode -> Int
number trouble = case trouble of
  ParseError -> -32700
  InvalidRequest -> -32600
  MethodNotFound -> -32601
  InvalidParams -> -32602
  InternalError -> -32603
  NotInitialized -> -32002
