-- | A client for tests. It talks to a session directly, without a process, and has a simulated
-- clock.
module Lsp.Talk
  ( Talk,
    begin,
    running,
    say,
    pause,
    heard,
    ask,
    open,
    change,
    replace,
    close,
    textOf,
    published,
    Squiggle (..),
    squiggles,
    addressOf,
    about,
    at,
    field,
    listed,
    units,
    positionIn,
  )
where

import Data.Aeson (Value (..), object, (.=))
import Data.Aeson.Key (Key)
import Data.Aeson.KeyMap qualified as KeyMap
import Data.ByteString qualified as ByteString
import Data.Foldable (toList)
import Data.Functor.Identity (Identity (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Lsp.Message (Failure, Incoming (..), Outgoing (..))
import Lsp.Session (Awaited (..), Effect (..), Event (..), Milliseconds (..), Session)
import Lsp.Session qualified as Session
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot qualified as Snapshot
import Surface.Import qualified as Import

-- | A conversation: the session, the time in ms, and all effects of the server so far, the last one
-- first.
data Talk = Talk Session Int [Effect]

-- | The state before the first message.
begin :: Talk
begin = Talk Session.start 0 []

-- | The state after @initialize@ with these capabilities of text documents. Earlier messages are
-- dropped.
running :: Value -> Talk
running capabilities = Talk session now []
  where
    Talk session now _ =
      say
        ( Request
            (Number 0)
            "initialize"
            (object ["capabilities" .= object ["textDocument" .= capabilities]])
        )
        begin

-- | Sends a message from the client.
say :: Incoming -> Talk -> Talk
say incoming = happen (Received incoming)

-- | Brings the awaited snapshots and handles an event.
happen :: Event -> Talk -> Talk
happen event (Talk session now sent) = Talk session' now (reverse effects <> sent)
  where
    time = Milliseconds now
    (session', effects) =
      Session.step time event (foldl supply session (Session.awaited time event session))
    supply s Awaited {path, text} =
      Session.supply
        path
        ( Snapshot.take
            (Snapshot.checkWith [])
            (runIdentity (LoadedProgram.load (Import.byName (opened s)) (Text.unpack path) text))
        )
        s
    -- Imports find only open documents.
    opened s there =
      Identity (maybe (Left "it is not open") Right (Session.openText s (Text.pack there)))

-- | Lets the clock advance by a time in ms; deadlines within it are handled.
pause :: Int -> Talk -> Talk
pause milliseconds talk@(Talk session now sent) = case Session.deadline session of
  Just (Milliseconds due)
    | due <= now + milliseconds ->
      pause (now + milliseconds - max now due) (happen Due (Talk session (max now due) sent))
  _ -> let Talk s _ e = talk in Talk s (now + milliseconds) e

-- | All effects of the server so far, in order.
heard :: Talk -> [Effect]
heard (Talk _ _ sent) = reverse sent

-- | The answer to a request.
ask :: Text -> Value -> Talk -> Either Failure Value
ask method params talk = case say (Request (String "q") method params) talk of
  Talk _ _ (Send (Result (String "q") value) : _) -> Right value
  Talk _ _ (Send (Refusal (String "q") failure) : _) -> Left failure
  Talk _ _ sent -> error ("no answer: " <> show (take 1 sent))

-- | Opens a text under an address.
open :: Text -> Int -> Text -> Talk -> Talk
open uri version text =
  say
    ( Notification
        "textDocument/didOpen"
        ( object
            [ "textDocument"
                .= object
                  [ "uri" .= uri,
                    "languageId" .= ("part" :: Text),
                    "version" .= version,
                    "text" .= text
                  ]
            ]
        )
    )

-- | Changes an open text.
change :: Text -> Int -> [Value] -> Talk -> Talk
change uri version edits =
  say
    ( Notification
        "textDocument/didChange"
        ( object
            [ "textDocument" .= object ["uri" .= uri, "version" .= version],
              "contentChanges" .= edits
            ]
        )
    )

-- | Replaces the whole of an open text.
replace :: Text -> Int -> Text -> Talk -> Talk
replace uri version text = change uri version [object ["text" .= text]]

-- | Closes an open text.
close :: Text -> Talk -> Talk
close uri =
  say (Notification "textDocument/didClose" (object ["textDocument" .= object ["uri" .= uri]]))

-- | The server's text of an open file.
textOf :: Text -> Talk -> Maybe Text
textOf path (Talk session _ _) = Session.openText session path

-- | All published diagnostics in order, each set with its address and version.
published :: Talk -> [(Value, Value, [Squiggle])]
published talk =
  [ (field "uri" p, field "version" p, map squiggle (listed (field "diagnostics" p)))
    | Send (Notify "textDocument/publishDiagnostics" p) <- heard talk
  ]

-- | A diagnostic: line and character of both ends, code, message.
data Squiggle = Squiggle {from :: (Int, Int), to :: (Int, Int), code :: Text, message :: Text}
  deriving stock (Eq, Show)

squiggle :: Value -> Squiggle
squiggle d =
  Squiggle
    { from = place "start",
      to = place "end",
      code = words' "code",
      message = words' "message"
    }
  where
    place end =
      let p = field end (field "range" d) in (int (field "line" p), int (field "character" p))
    words' key = case field key d of
      String text -> text
      other -> Text.pack (show other)

int :: Value -> Int
int v = case v of
  Number n -> round n
  _ -> error ("no number: " <> show v)

-- | The diagnostics that are published when a text is opened.
squiggles :: Text -> [Squiggle]
squiggles text = case published (pause 0 (open addressOf 1 text (running (object [])))) of
  [(_, _, found)] -> found
  other -> error (show other)

-- | The address that most tests use.
addressOf :: Text
addressOf = "file:///tmp/a.part"

-- | Parameters that name a document and a position.
about :: Text -> (Int, Int) -> Value
about uri (line, character) =
  object ["textDocument" .= object ["uri" .= uri], "position" .= at (line, character)]

-- | A position of the protocol: line and character.
at :: (Int, Int) -> Value
at (line, character) = object ["line" .= line, "character" .= character]

-- | A field of an object, or null.
field :: Key -> Value -> Value
field key v = case v of
  Object o | Just x <- KeyMap.lookup key o -> x
  _ -> Null

-- | The listed of a list, or none.
listed :: Value -> [Value]
listed v = case v of
  Array xs -> toList xs
  _ -> []

-- | The number of UTF-16 code units of a text, by encoding it.
units :: Text -> Int
units text = ByteString.length (Encoding.encodeUtf16LE text) `div` 2

-- | The line and the UTF-16 code units of an offset, counted over all characters before it.
positionIn :: Text -> Int -> (Int, Int)
positionIn text offset = go 0 "" (Text.unpack (Text.take offset text)) (Text.drop offset text)
  where
    go line current before after = case before of
      [] -> (line, units (Text.pack (reverse current)))
      '\r' : '\n' : rest -> go (line + 1) "" rest after
      "\r" | "\n" `Text.isPrefixOf` after -> (line, units (Text.pack (reverse current)))
      c : rest | c == '\r' || c == '\n' -> go (line + 1 :: Int) "" rest after
      c : rest -> go line (c : current) rest after
