-- | Judgement of requests, before anything else is done with them. Only the page itself may ask:
-- other programs on this machine do not know the token, and pages of other sites have another
-- origin. A name server that gives our address to another name is recognised by the host.
module Preview.Guard
  ( Door (..),
    Resource (..),
    Rejection (..),
    Asked (..),
    judge,
    mostBody,
  )
where

import Data.Bits (xor, (.|.))
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.List (foldl')
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Text.Read (readMaybe)

-- | Port of the server and token, which a request has to name.
data Door = Door {port :: Int, token :: Text}

-- | Parts of a request that are judged.
data Asked = Asked
  { method :: ByteString,
    path :: [Text],
    -- | names and values behind the question mark
    query :: [(ByteString, Maybe ByteString)],
    host :: Maybe ByteString,
    origin :: Maybe ByteString,
    -- | relation of the site that asks to ours, if the browser says it
    fetchSite :: Maybe ByteString,
    -- | count of the bytes of the body; Nothing if it is not known in advance
    bodyLength :: Maybe Int
  }

-- | Thing that is asked for. A run is named by its machine.
data Resource
  = -- | file of the page; the empty name is the page itself
    PageFile Text
  | Events
  | Drawing
  | Run Text
  | PulsesOf Text
  | -- | machine, first row and row behind the last one
    RowsOf Text Int Int
  | -- | moves the cursor of the editor
    ShowPlace
  deriving stock (Eq, Show)

-- | Reason why a request is refused.
data Rejection
  = WrongHost
  | WrongOrigin
  | WrongMethod
  | -- | there is no such thing, or the token is wrong
    NotFound
  | TooLarge
  | BadQuery
  deriving stock (Eq, Show)

-- | Thing that a request asks for, or the reason of its refusal.
judge :: Door -> Asked -> Either Rejection Resource
judge Door {port, token} asked
  | host asked `notElem` map Just hosts = Left WrongHost
  | maybe False (`notElem` map ("http://" <>) hosts) (origin asked) = Left WrongOrigin
  | maybe False (`notElem` ["same-origin", "none"]) (fetchSite asked) = Left WrongOrigin
  | otherwise = case path asked of
    given : names
      | isSame given token -> resource asked names
    _ -> Left NotFound
  where
    hosts = [name <> ":" <> ascii (Text.pack (show port)) | name <- ["127.0.0.1", "localhost"]]

-- | Thing that the path behind the token and the method name.
resource :: Asked -> [Text] -> Either Rejection Resource
resource asked names = case (method asked, names) of
  ("POST", ["show"])
    | maybe True (> mostBody) (bodyLength asked) -> Left TooLarge
    | otherwise -> Right ShowPlace
  ("GET", [name]) -> got name
  ("GET", []) -> Right (PageFile "")
  ("HEAD", _) -> Left WrongMethod
  _ | method asked `elem` ["GET", "POST"] -> Left NotFound
  _ -> Left WrongMethod
  where
    got name = case name of
      "events" -> Right Events
      "drawing" -> Right Drawing
      "run" -> Run <$> machine
      "pulses" -> PulsesOf <$> machine
      "rows" -> RowsOf <$> machine <*> number "from" <*> number "to"
      "show" -> Left WrongMethod
      _ -> Right (PageFile name)
    machine = given "machine"
    given key = case lookup key (query asked) of
      Just (Just value) | Right text <- Encoding.decodeUtf8' value -> Right text
      _ -> Left BadQuery
    number key = given key >>= maybe (Left BadQuery) Right . readMaybe . Text.unpack . Text.take 9

-- | Greatest count of bytes in the body of a request.
mostBody :: Int
mostBody = 4096

-- | Comparison that takes the same time wherever the texts differ.
isSame :: Text -> Text -> Bool
isSame a b = Text.length a == Text.length b && foldl' differing 0 (zipped a b) == 0
  where
    zipped x y = ByteString.zipWith xor (ascii x) (ascii y)
    differing d w = d .|. w

ascii :: Text -> ByteString
ascii = Encoding.encodeUtf8
