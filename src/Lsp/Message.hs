-- | The messages of JSON-RPC 2.0, in which editor and server talk by the Language Server Protocol.
-- Their parameters and results stay JSON values.
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
import Lsp.Surrogate qualified as Surrogate

-- | A message from the client: a request wants an answer, a notification wants none.
data Incoming
  = -- | the identifier that the answer repeats, the name of the method, the parameters
    Request Id Text Value
  | -- | the name of the method, the parameters
    Notification Text Value
  | -- | an answer to a request of the server; it is ignored, because no answer changes anything
    Reply
  | -- | a message that is not understood: the identifier if it has one, or null, and the failure
    -- with which the server answers
    Malformed Id Failure
  deriving stock (Eq, Show)

-- | A number or a text that names a request.
type Id = Value

-- | A message to the client.
data Outgoing
  = -- | the answer to a request: the identifier of the request, the result
    Result Id Value
  | -- | the answer to a request that failed: the identifier of the request, the reason
    Refusal Id Failure
  | -- | a notification: the name of the method, the parameters
    Notify Text Value
  | -- | a request of the server: its identifier, the name of the method, the parameters
    Ask Id Text Value
  deriving stock (Eq, Show)

-- | The reason why a request has no result: a code of the protocol, and a message for people.
data Failure = Failure ErrorCode Text
  deriving stock (Eq, Show)

-- | The error codes of JSON-RPC and of the protocol that this server uses.
data ErrorCode
  = ParseError
  | InvalidRequest
  | MethodNotFound
  | InvalidParams
  | InternalError
  | NotInitialized
  | RequestCancelled
  | ContentModified
  deriving stock (Eq, Show, Enum, Bounded)

-- | Reads the JSON body of a message, without the header. Wrong bytes give 'Malformed'. Half of a
-- surrogate pair, which some editors send while an emoji is deleted, becomes a replacement
-- character.
decode :: ByteString -> Incoming
decode body = case decoded of
  Nothing -> Malformed Null (Failure ParseError "this is not JSON")
  Just (Object o) -> case (KeyMap.lookup "method" o, KeyMap.lookup "id" o) of
    (Just (String method), Nothing) -> Notification method (params o)
    (Just (String method), Just ident) | isId ident -> Request ident method (params o)
    (Nothing, Just _) | any (`KeyMap.member` o) ["result", "error"] -> Reply
    (_, Just ident) | isId ident -> invalid ident
    _ -> invalid Null
  Just _ -> invalid Null
  where
    decoded = case Aeson.decodeStrict' body of
      Nothing -> Aeson.decodeStrict' (Surrogate.replaced body)
      found -> found
    params o = Maybe.fromMaybe Null (KeyMap.lookup "params" o)
    invalid ident = Malformed ident (Failure InvalidRequest "this is no message of the protocol")
    isId ident = case ident of
      Number _ -> True
      String _ -> True
      _ -> False

-- | Writes the JSON body of a message, without the header.
encode :: Outgoing -> ByteString
encode outgoing = LazyByteString.toStrict . Aeson.encode $ case outgoing of
  Result ident result -> object [version, "id" .= ident, "result" .= result]
  Refusal ident (Failure errorCode text) ->
    object
      [version, "id" .= ident, "error" .= object ["code" .= number errorCode, "message" .= text]]
  Notify method params -> object [version, "method" .= method, "params" .= params]
  Ask ident method params ->
    object [version, "id" .= ident, "method" .= method, "params" .= params]
  where
    version = "jsonrpc" .= ("2.0" :: Text)

-- | The protocol's number of an error code.
number :: ErrorCode -> Int
number errorCode = case errorCode of
  ParseError -> -32700
  InvalidRequest -> -32600
  MethodNotFound -> -32601
  InvalidParams -> -32602
  InternalError -> -32603
  NotInitialized -> -32002
  RequestCancelled -> -32800
  ContentModified -> -32801
