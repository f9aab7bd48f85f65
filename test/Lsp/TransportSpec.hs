-- | Messages on a stream of bytes.
module Lsp.TransportSpec (spec) where

import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Lsp.Transport (Received (..))
import Lsp.Transport qualified as Transport
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck

spec :: Spec
spec = do
  prop "messages are received as they were sent, in whatever pieces the bytes arrive"
    . forAll (listOf body)
    $ \bodies ->
      forAll (cut (ByteString.concat (map Transport.framed bodies))) $ \pieces ->
        received "" pieces === bodies
  it "counts bytes, not characters" $
    Transport.framed (Encoding.encodeUtf8 "ж🙂")
      `shouldSatisfy` ByteString.isPrefixOf "Content-Length: 6\r\n\r\n"
  it "accepts further header fields, and field names in any case" $
    Transport.next
      "Content-Type: application/vscode-jsonrpc; charset=utf-8\r\ncontent-length:2\r\n\r\n{}rest"
      `shouldBe` Complete "{}" "rest"
  it "gives the count of missing bytes" $
    Transport.next "Content-Length: 5\r\n\r\n{}" `shouldBe` Incomplete 3
  it "skips a header without a length or with an impossible one" $
    map
      Transport.next
      [ "X: 1\r\n\r\nrest",
        "Content-Length: -1\r\n\r\nrest",
        "Content-Length: 99999999999999\r\n\r\nrest",
        "Content-Length: x\r\n\r\nrest"
      ]
      `shouldBe` replicate 4 (Headless "rest")
  it
    "finds the next message after one whose header has no length (catches a server that never \
    \reads again)"
    $ case Transport.next "X: 1\r\n\r\n{\"a\": 1}Content-Length: 2\r\n\r\n{}rest" of
      Headless rest -> Transport.next rest `shouldBe` Complete "{}" "rest"
      other -> expectationFailure (show other)

-- | All messages of a stream that arrives in pieces.
received :: ByteString -> [ByteString] -> [ByteString]
received waiting pieces = case Transport.next waiting of
  Complete message rest -> message : received rest pieces
  Headless rest -> received rest pieces
  Incomplete _ -> case pieces of
    [] -> []
    piece : more -> received (waiting <> piece) more

body :: Gen ByteString
body = Encoding.encodeUtf8 . Text.pack <$> listOf (elements "{}\"ж🙂\r\n: ")

cut :: ByteString -> Gen [ByteString]
cut bytes
  | ByteString.null bytes = pure []
  | otherwise = do
    size <- chooseInt (1, 9)
    let (piece, rest) = ByteString.splitAt size bytes
    (piece :) <$> cut rest
