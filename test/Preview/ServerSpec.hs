module Preview.ServerSpec
  ( spec,
  )
where

import Control.Concurrent (threadDelay)
import Control.Monad (forM, forM_, replicateM)
import Data.ByteString (ByteString)
import Data.ByteString.Char8 qualified as Bytes
import Data.Maybe (fromMaybe)
import Network.Socket (close)
import Network.Socket.ByteString (recv, sendAll)
import Preview.Answer qualified as Answer
import Preview.Server (Listening (..), Site)
import Preview.Server qualified as Server
import Preview.Subject qualified as Subject
import Preview.WebClient
import Preview.WebClient qualified as WebClient
import Project.LoadedProgram qualified as LoadedProgram
import System.Timeout (timeout)
import Test.Hspec

spec :: Spec
spec = around served . describe "withServer" $ do
  it "serves the page with a policy that lets nothing in from elsewhere" $ \(_, address) -> do
    answer <- ask address (request address "" [])
    status answer `shouldBe` "200"
    Bytes.unpack answer `shouldContain` "Content-Security-Policy: default-src 'self'"
    Bytes.unpack answer `shouldContain` "<!DOCTYPE html>"
  it "serves every file that the page names" $ \(_, address) -> do
    answer <- ask address (request address "" [])
    let names = namesIn answer
    length names `shouldSatisfy` (> 2)
    forM_ names $ \name -> do
      found <- ask address (request address name [])
      (name, status found) `shouldBe` (name, "200")
  it "answers for each machine, also for one that cannot make the part" $ \(_, address) ->
    forM_ ["n55", "fanuc", "no-such-machine", "..%2F..%2Fetc"] $ \machine -> do
      answer <- ask address (request address ("run?version=1&machine=" <> machine) [])
      status answer `shouldBe` "200"
  it "refuses what the page would not ask, and stays up" $ \(_, address) -> do
    forM_ hostile $ \(expected, make) -> do
      answer <- ask address (make address)
      (make address, status answer) `shouldSatisfy` ((`elem` expected) . snd)
    status <$> ask address (request address "drawing" []) `shouldReturn` "200"
  it "survives clients that go away at any moment" $ \(_, address) -> do
    forM_ [0 .. 40] $ \n ->
      withConnection address $ \socket ->
        sendAll socket (Bytes.take (n * 4) (request address "drawing" []))
    forM_ ["drawing", "run?machine=n55", "pulses?machine=n55", "events"] $ \name ->
      withConnection address $ \socket -> sendAll socket (request address name [])
    status <$> ask address (request address "drawing" []) `shouldReturn` "200"
  it "tells open pages of a change within a second" $ \(site, address) ->
    withConnection address $ \socket -> do
      sendAll socket (request address "events" [])
      untilSeen socket "\"version\":1" `shouldReturn` True
      Server.publish site (Subject.following [] (LoadedProgram.fromText "flange.part" "part other"))
      timeout 1000000 (untilSeen socket "\"version\":2") `shouldReturn` Just True
  it "tells open pages of the cursor" $ \(site, address) ->
    withConnection address $ \socket -> do
      sendAll socket (request address "events" [])
      untilSeen socket "\"version\":1" `shouldReturn` True
      Server.pointAt site 0 19
      timeout 1000000 (untilSeen socket "\"line\":19") `shouldReturn` Just True
  it "serves on after more streams than it allows" $ \(_, address) -> do
    sockets <- replicateM 40 (connected address)
    answers <- forM sockets $ \socket -> do
      sendAll socket (request address "events" [])
      fromMaybe "" <$> timeout 1000000 (recv socket 64)
    map status answers `shouldContain` ["503"]
    mapM_ close sockets
    threadDelay 200000
    status <$> ask address (request address "drawing" []) `shouldReturn` "200"

-- | Requests that no page makes, with the statuses that may answer them; the empty one is for a
-- connection that is closed without an answer.
hostile :: [([ByteString], Address -> ByteString)]
hostile =
  [ (["404"], \a -> get "/" (hostOf a) []),
    (["404"], \a -> get "/0123456789abcdef0123456789abcdef/drawing" (hostOf a) []),
    (["404"], \a -> get (path a <> "../../etc/passwd") (hostOf a) []),
    (["404"], \a -> get (path a <> "%2e%2e%2f%2e%2e%2fetc%2fpasswd") (hostOf a) []),
    (["404"], \a -> get (path a <> "nothing.js") (hostOf a) []),
    (["403"], \a -> get (path a <> "drawing") "evil.example" []),
    (["403"], \a -> get (path a <> "drawing") ("evil.example:" <> Bytes.pack (port a)) []),
    (["403"], \a -> request a "drawing" ["Origin: http://evil.example"]),
    (["403"], \a -> request a "drawing" ["Origin: null"]),
    (["403"], \a -> request a "drawing" ["Sec-Fetch-Site: cross-site"]),
    (["405"], \a -> "DELETE " <> path a <> "drawing HTTP/1.1\r\nHost: " <> hostOf a <> "\r\n\r\n"),
    ( ["413"],
      \a ->
        Bytes.concat
          [ "POST " <> path a <> "show HTTP/1.1\r\n",
            "Host: " <> hostOf a <> "\r\n",
            "Content-Length: 99999999999\r\n\r\n"
          ]
    ),
    (["400"], \a -> request a "run" []),
    (["400", "431", ""], \a -> request a "drawing" ["X: " <> Bytes.replicate 100000 'x']),
    (["400", "414", "431", ""], \a -> request a (Bytes.replicate 100000 'x') []),
    (["400", ""], const "\x16\x03\x01\x02\x00\x01\x00\x01\xFC\x03\x03\r\n\r\n"),
    (["400", ""], const "GET\r\n\r\n"),
    (["400", ""], const "no request at all\r\n\r\n")
  ]

-- | Server for the flange.
served :: ((Site, Address) -> IO ()) -> IO ()
served test = do
  followed <- Answer.followedFile "examples/flange.part"
  site <- Server.newSite Nothing followed
  done <- Server.withServer AnyPort site (\text -> test (site, WebClient.addressFrom text))
  either (fail . show) pure done

-- | Names of files in the attributes of a page.
namesIn :: ByteString -> [ByteString]
namesIn page =
  [ name
    | word <- ["href=\"", "src=\""],
      piece <- drop 1 (splitOn word page),
      let name = Bytes.takeWhile (/= '"') piece,
      Bytes.elem '.' name
  ]
  where
    splitOn word text = case Bytes.breakSubstring word text of
      (front, rest)
        | Bytes.null rest -> [front]
        | otherwise -> front : splitOn word (Bytes.drop (Bytes.length word) rest)
