-- | The page of the preview that the language server offers.
module Lsp.PreviewSpec (spec) where

import Control.Concurrent (forkIO, threadDelay)
import Control.Monad (unless, void)
import Data.Aeson (Value (..), object, (.=))
import Data.ByteString (ByteString)
import Data.ByteString.Char8 qualified as Bytes
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Lsp.Server (Host (..))
import Lsp.Server qualified as Server
import Lsp.Stream (notice, opened, question, send, until', within)
import Lsp.Talk (about, addressOf, field)
import Network.Socket.ByteString (sendAll)
import Preview.WebClient
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot qualified as Snapshot
import Query.TapeFacts qualified as TapeFacts
import System.IO (Handle, hClose)
import System.Process (createPipe)
import System.Timeout (timeout)
import Test.Hspec

spec :: Spec
spec = describe "the command partc.preview" $ do
  it "gives the address of a page with the part, and asks the client to show it" $
    conversing True $ \to from -> do
      send to (command "partc.preview" [String addressOf])
      (_, seen) <- until' isShowDocument "" from
      field "external" (field "params" (last seen)) `shouldBe` Bool True
      address <- answered seen
      drawing <- ask address (request address "drawing" [])
      status drawing `shouldBe` "200"
      Bytes.unpack drawing `shouldContain` "\"editor\":true"
      Bytes.unpack drawing `shouldContain` "lug(a)"
  it "gives the same address again" $
    conversing False $ \to from -> do
      first <- pageAddress to from
      second <- pageAddress to from
      path second `shouldBe` path first
  it "tells the page of changes of the text that are not saved" $
    conversing False $ \to from -> do
      address <- pageAddress to from
      send to (changed "-- nothing\n")
      timeout 5000000 (untilDrawn address "-- nothing") `shouldReturn` Just ()
  it "tells the page where the cursor is, by the request for highlights and by our notification" $
    conversing False $ \to from -> do
      address <- pageAddress to from
      withConnection address $ \socket -> do
        sendAll socket (request address "events" [])
        untilSeen socket "\"version\":" `shouldReturn` True
        send to (question 7 "textDocument/documentHighlight" (about addressOf (18, 8)))
        timeout 5000000 (untilSeen socket "\"line\":19") `shouldReturn` Just True
        send to (notice "partc/cursor" (about addressOf (20, 8)))
        timeout 5000000 (untilSeen socket "\"line\":21") `shouldReturn` Just True
  it "moves the cursor of a client that can show positions" $
    conversing True $ \to from -> do
      address <- pageAddress to from
      answer <- ask address (clicked address)
      status answer `shouldBe` "204"
      (_, asked) <- until' (\m -> isShowDocument m && hasSelection m) "" from
      field "line" (field "start" (field "selection" (field "params" (last asked))))
        `shouldBe` Number 18
      field "uri" (field "params" (last asked)) `shouldBe` String addressOf
  it "tells nothing to a client that cannot show positions" $
    conversing False $ \to from -> do
      address <- pageAddress to from
      status <$> ask address (clicked address) `shouldReturn` "404"
      send to (question 8 "textDocument/hover" (about addressOf (18, 8)))
      (_, seen) <- until' ((== Number 8) . field "id") "" from
      filter isShowDocument seen `shouldBe` []
  it "is refused for a document that is not open, and other commands are refused" $
    conversing False $ \to from -> do
      send to (command "partc.preview" [String "file:///other.part"])
      (_, a) <- until' ((== Number 5) . field "id") "" from
      field "code" (field "error" (last a)) `shouldBe` Number (-32602)
      send to (command "partc.else" [String addressOf])
      (_, b) <- until' ((== Number 5) . field "id") "" from
      field "code" (field "error" (last b)) `shouldBe` Number (-32602)

-- | The address of the page for the document.
pageAddress :: Handle -> Handle -> IO Address
pageAddress to from = do
  send to (command "partc.preview" [String addressOf])
  (_, seen) <- until' ((== Number 5) . field "id") "" from
  answered seen

-- | The address in the answer to the command, when its page has a picture.
answered :: [Value] -> IO Address
answered seen = case [m | m <- seen, field "id" m == Number 5] of
  [m] | String text <- field "uri" (field "result" m) -> do
    let address = addressFrom text
    address <$ untilDrawn address "\"drawn\":true"
  other -> fail (show other)

-- | Waits until the drawing of a page contains a text.
untilDrawn :: Address -> ByteString -> IO ()
untilDrawn address text = do
  found <- ask address (request address "drawing" [])
  unless (text `Bytes.isInfixOf` found) (threadDelay 20000 >> untilDrawn address text)

command :: Text -> [Value] -> ByteString
command name arguments =
  question
    5
    "workspace/executeCommand"
    (object ["command" .= name, "arguments" .= arguments])

changed :: Text -> ByteString
changed text =
  notice
    "textDocument/didChange"
    ( object
        [ "textDocument" .= object ["uri" .= addressOf, "version" .= (2 :: Int)],
          "contentChanges" .= [object ["text" .= text]]
        ]
    )

-- | The request of the page after a click on something of line 19.
clicked :: Address -> ByteString
clicked address =
  Bytes.concat
    [ "POST " <> path address <> "show HTTP/1.1\r\nHost: " <> hostOf address <> "\r\n",
      "Connection: close\r\n",
      "Content-Length: " <> Bytes.pack (show (Bytes.length body)) <> "\r\n\r\n",
      body
    ]
  where
    body = "{\"file\":0,\"line\":19,\"column\":1}"

isShowDocument :: Value -> Bool
isShowDocument message = field "method" message == String "window/showDocument"

hasSelection :: Value -> Bool
hasSelection message = field "selection" (field "params" message) /= Null

-- | Runs an action with the streams of a server, to which the flange is open. The flag is true if
-- the client can show documents.
conversing :: Bool -> (Handle -> Handle -> IO ()) -> IO ()
conversing canShow act = within $ do
  (input, to) <- createPipe
  (from, output) <- createPipe
  void . forkIO . void . Server.serve $
    Host
      { input,
        output,
        load = \_ path' text -> pure (LoadedProgram.fromText path' text),
        check = Snapshot.checkWith [],
        prove = TapeFacts.tapeFacts []
      }
  text <- readText "examples/flange.part"
  send to (question 0 "initialize" (object ["capabilities" .= object ["window" .= window]]))
  send to (notice "initialized" (object []))
  send to (opened (Text.replace "\r" "" text))
  act to from
  -- The end of its input ends the server. Until here the stream is kept open.
  hClose to
  where
    window = object ["showDocument" .= object ["support" .= canShow]]
