-- | The language server as an editor starts it: streams, exit status, timing.
module Lsp.ServerSpec (spec) where

import Base.Crash (bug)
import Base.Region qualified as Region
import Control.Concurrent (forkIO, newEmptyMVar, putMVar, takeMVar)
import Control.Exception (bracket)
import Control.Monad (foldM, forM_, void)
import Data.Aeson (Value (..), object, (.=))
import Data.Aeson qualified as Aeson
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Lsp.Conversation (Ending (..))
import Lsp.Server (Host (..))
import Lsp.Server qualified as Server
import Lsp.Stream (notice, opened, question, send, until', within)
import Lsp.Talk (about, addressOf, field)
import Lsp.Transport (Received (..))
import Lsp.Transport qualified as Transport
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot (Check)
import Query.Snapshot qualified as Snapshot
import Query.TapeFacts qualified as TapeFacts
import System.Environment (getEnvironment)
import System.Exit (ExitCode (..))
import System.IO (Handle, hClose, hSetBinaryMode)
import System.Process
  ( CreateProcess (..),
    ProcessHandle,
    StdStream (..),
    createPipe,
    createProcess,
    proc,
    terminateProcess,
    waitForProcess,
  )
import Test.Hspec

spec :: Spec
spec = do
  it "writes nothing but messages, under LC_ALL=C and with the options that editors pass" $
    forM_ [["--stdio"], ["--clientProcessId=1"], ["--clientProcessId", "1"], []] $ \arguments -> do
      (status, rest, answers) <-
        conversation
          arguments
          ( opening
              <> [ question 1 "textDocument/hover" (about addressOf (6, 4)),
                   question 2 "shutdown" Null,
                   notice "exit" Null
                 ]
          )
      (status, rest) `shouldBe` (ExitSuccess, "")
      map (field "id") answers `shouldBe` [Number 0, Number 1, Number 2]
      Aeson.encode answers `shouldSatisfy` LazyByteString.isPrefixOf "["
      field "result" (answers !! 1) `shouldNotBe` Null
  it
    "has the exit status 1 for an exit without shutdown and for the end of the input, and 0 after \
    \shutdown"
    $ do
      (a, _, _) <- conversation [] (opening <> [notice "exit" Null])
      (b, _, _) <- conversation [] opening
      (c, _, _) <- conversation [] []
      (d, _, _) <-
        conversation
          []
          (opening <> [question 1 "shutdown" Null, notice "exit" Null])
      [a, b, c, d] `shouldBe` [ExitFailure 1, ExitFailure 1, ExitFailure 1, ExitSuccess]
  it "refuses input that is not a message, and continues" $ do
    (status, _, answers) <-
      conversation
        []
        ( opening
            <> ["{", "[]", "{\"id\":3}", "\255"]
            <> [question 4 "shutdown" Null, notice "exit" Null]
        )
    status `shouldBe` ExitSuccess
    map (field "code" . field "error") (take 4 (drop 1 answers))
      `shouldBe` map Number [-32700, -32600, -32600, -32700]
    field "id" (last answers) `shouldBe` Number 4
  it "publishes diagnostics after the last of several changes, without a request" $
    talking [] $ \to from -> do
      mapM_ (send to) opening
      (_, first) <- diagnosticsFrom "" from
      version first `shouldBe` Number 1
      codes first `shouldBe` [String "E0201"]
      forM_ [2 .. 9] $ \n ->
        send
          to
          ( notice
              "textDocument/didChange"
              ( object
                  [ "textDocument" .= object ["uri" .= addressOf, "version" .= (n :: Int)],
                    "contentChanges"
                      .= [object ["text" .= Text.concat (replicate n "-- жёлтый 🙂\n")]]
                  ]
              )
          )
      (_, seen) <- until' (isSettled 9) "" from
      last [version m | m <- seen, isDiagnostics m] `shouldBe` Number 9
  it "publishes an exception of an analysis, and continues" $
    inProcess
      ( \loaded ->
          if "нет" `Text.isInfixOf` Region.text (LoadedProgram.source loaded)
            then bug "a fault\nof ours"
            else Snapshot.checkWith [] loaded
      )
      $ \to from ->
        do
          mapM_ (send to) opening
          (a, shown) <- until' (isSettled 1) "" from
          send to (question 1 "textDocument/hover" (about addressOf (6, 4)))
          send
            to
            ( notice
                "textDocument/didChange"
                ( object
                    [ "textDocument" .= object ["uri" .= addressOf, "version" .= (2 :: Int)],
                      "contentChanges" .= [object ["text" .= ("let ж = 1\n" :: Text)]]
                    ]
                )
            )
          (b, _) <- until' (isSettled 2) a from
          send to (question 2 "textDocument/hover" (about addressOf (0, 4)))
          (_, more) <- until' ((== Number 2) . field "id") b from
          [field "message" d | m <- shown, isDiagnostics m, d <- diagnosticsOf m]
            `shouldBe` [String "this is a bug in partc: please send us the program\na fault"]
          field "result" (last more) `shouldSatisfy` \case
            Object _ -> True
            _ -> False
  it "answers other requests while an answer takes long" $
    talking [] $ \to from -> do
      mapM_ (send to) [initialize, opened slowHover]
      (a, _) <- until' (isSettled 1) "" from
      send to (question 1 "textDocument/hover" (about addressOf (11, 25)))
      send to (question 2 "textDocument/documentSymbol" (about addressOf (0, 0)))
      (b, first) <- until' ((== Number 2) . field "id") a from
      (_, second) <- until' ((== Number 1) . field "id") b from
      map (field "id") first `shouldBe` [Number 2]
      field "result" (last second) `shouldNotBe` Null
  it "reads a message of several megabytes" $ do
    flange <- readText "examples/flange.part"
    let long = flange <> Text.replicate 40000 "-- шестьдесят 🙂\n"
    (status, _, answers) <-
      conversation
        []
        [ initialize,
          opened long,
          question 1 "textDocument/documentSymbol" (about addressOf (0, 0)),
          question 2 "shutdown" Null,
          notice "exit" Null
        ]
    status `shouldBe` ExitSuccess
    mapMaybe named (concat [foldMap pure a | r <- answers, Array a <- [field "result" r]])
      `shouldBe` ["flange", "c", "lug", "boss", "outline", "mill outline outside"]
  where
    version = field "version" . field "params"
    codes = map (field "code") . diagnosticsOf
    named v = case field "name" v of
      String name -> Just name
      _ -> Nothing

-- | The first messages of a conversation: they open a program with one mistake.
opening :: [ByteString]
opening =
  [ initialize,
    notice "initialized" (object []),
    opened
      "part p\nmachine lkp-01f\ntool mill(diameter 2 mm)\nfeed 60 mm/min\ntolerance 0.02 mm\nfrom \
      \(0, 0)\nlet ж = 1\nlet b = ж + нет\n"
  ]

-- | A program that takes long to evaluate. The hover at its fillet evaluates it again, to find the
-- largest radius.
slowHover :: Text
slowHover =
  "part p\nmachine iso6983\ntool mill(diameter 6 mm)\nfeed 100 mm/min\ntolerance 0.02 mm\nfrom \
  \(0, -30)\nlet n = 100000\ncontour ring closed {\n  for k in 0..n - 1 { polar(1000, k * 360 / n) \
  \}\n}\ncontour c closed {\n  line((0, 0), (50, 0)) fillet -4\n  line((50, 0), (50, 50))\n  \
  \line((50, 50), (0, 0))\n}\n"

initialize :: ByteString
initialize = question 0 "initialize" (object ["capabilities" .= object []])

-- | Sends messages, each after the answer to the one before, and closes the stream. The result: the
-- exit status, the bytes after the server's last message, and its messages other than
-- notifications.
conversation :: [String] -> [ByteString] -> IO (ExitCode, ByteString, [Value])
conversation arguments messages = within . withServer arguments $ \to from process -> do
  (received, early) <- foldM (say' to from) ("", []) messages
  hClose to
  out <- ByteString.hGetContents from
  status <- waitForProcess process
  let (rest, late) = unframed (received <> out)
  pure (status, rest, [a | a <- early <> late, field "method" a == Null])
  where
    say' to from (received, answers) message = do
      send to message
      case Aeson.decodeStrict message of
        Just value
          | field "id" value /= Null && field "method" value /= Null -> do
            (received', more) <- until' ((== field "id" value) . field "id") received from
            pure (received', answers <> more)
        _ -> pure (received, answers)

-- | All messages of some bytes, and the bytes after them.
unframed :: ByteString -> (ByteString, [Value])
unframed bytes = case Transport.next bytes of
  Complete body rest | Just value <- Aeson.decodeStrict body -> (value :) <$> unframed rest
  _ -> (bytes, [])

-- | Runs an action with the streams of a server, then ends the server.
talking :: [String] -> (Handle -> Handle -> IO ()) -> IO ()
talking arguments act = void . within . withServer arguments $ \to from _ -> act to from

-- | True of the notification that the diagnostics of this version are complete.
isSettled :: Int -> Value -> Bool
isSettled n message =
  field "method" message == String "partc/settled"
    && field "version" (field "params" message) == Aeson.toJSON n

isDiagnostics :: Value -> Bool
isDiagnostics message = field "method" message == String "textDocument/publishDiagnostics"

-- | The next message with diagnostics; other messages are dropped.
diagnosticsFrom :: ByteString -> Handle -> IO (ByteString, Value)
diagnosticsFrom received from = fmap last <$> until' isDiagnostics received from

diagnosticsOf :: Value -> [Value]
diagnosticsOf message = case field "diagnostics" (field "params" message) of
  Array ds -> foldMap pure ds
  _ -> []

-- | Runs an action with the streams of a server in this process, which finds mistakes by the given
-- function.
inProcess :: Check -> (Handle -> Handle -> IO ()) -> IO ()
inProcess check act = within $ do
  (input, to) <- createPipe
  (from, output) <- createPipe
  done <- newEmptyMVar
  _ <-
    forkIO
      ( Server.serve
          Host
            { input,
              output,
              load = \_ path text -> pure (LoadedProgram.fromText path text),
              check,
              prove = TapeFacts.tapeFacts []
            }
          >>= putMVar done
      )
  act to from
  hClose to
  takeMVar done `shouldReturn` Abrupt

-- | Runs an action with a server in a process of its own, with these options.
withServer :: [String] -> (Handle -> Handle -> ProcessHandle -> IO a) -> IO a
withServer arguments act = bracket begin end (\(to, from, process) -> act to from process)
  where
    begin = do
      environment <- getEnvironment
      (Just to, Just from, _, process) <-
        createProcess
          (proc "partc" ("lsp" : arguments))
            { std_in = CreatePipe,
              std_out = CreatePipe,
              env = Just (("LC_ALL", "C") : filter ((/= "LC_ALL") . fst) environment)
            }
      hSetBinaryMode to True
      hSetBinaryMode from True
      pure (to, from, process)
    end (to, from, process) =
      hClose to *> terminateProcess process *> hClose from *> void (waitForProcess process)
