-- | A client for tests. It talks to a session directly, without a process, and has a simulated
-- clock.
module Lsp.Talk
  ( Talk,
    begin,
    running,
    runningWith,
    slow,
    finish,
    finishEvaluation,
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
    everyPublished,
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
import Lsp.Conversation
  ( Effect (..),
    Event (..),
    Outcome (..),
    Session,
    WorkKind (..),
    WorkOrder (..),
    start,
  )
import Lsp.Message (Failure, Incoming (..), Outgoing (..))
import Lsp.OpenDocument (Milliseconds (..))
import Lsp.Schedule qualified as Schedule
import Lsp.Session qualified as Session
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Query.TapeFacts qualified as TapeFacts
import Surface.Import qualified as Import

-- | A conversation: the session, the time in ms, all effects of the server so far, the last one
-- first, and the work that the worker has begun. The worker is either quick and ends its work at
-- once, or slow and ends it when the test says so.
data Talk = Talk
  { session :: Session,
    time :: Int,
    sent :: [Effect],
    begun :: Maybe WorkOrder,
    isSlow :: Bool
  }

-- | A conversation before its first message.
begin :: Talk
begin = Talk {session = start, time = 0, sent = [], begun = Nothing, isSlow = False}

-- | A conversation after @initialize@ with these capabilities of text documents. It contains no
-- messages yet.
running :: Value -> Talk
running capabilities = runningWith (object ["textDocument" .= capabilities])

-- | A conversation after @initialize@ with these capabilities. It contains no messages yet.
runningWith :: Value -> Talk
runningWith capabilities =
  (say (Request (Number 0) "initialize" (object ["capabilities" .= capabilities])) begin)
    { sent = []
    }

-- | A conversation in the same state with a slow worker. It contains no messages yet.
slow :: Talk -> Talk
slow talk = talk {isSlow = True, sent = []}

-- | Sends a message from the client.
say :: Incoming -> Talk -> Talk
say incoming = happen (Received incoming)

-- | Handles an event. A quick worker ends its work.
happen :: Event -> Talk -> Talk
happen event talk
  | isSlow talk = talk'
  | otherwise = maybe talk' (const (finish talk')) (begun talk')
  where
    (session', effects) = Session.step (Milliseconds (time talk)) event (session talk)
    talk' =
      talk
        { session = session',
          sent = reverse (map atOnce effects) <> sent talk,
          begun = foldl workAfter (begun talk) effects
        }
    atOnce effect = case effect of
      Answer _ answer -> Send answer
      _ -> effect
    workAfter before effect = case effect of
      Begin work -> Just work
      Halt -> Nothing
      _ -> before

-- | Lets a worker end its work.
finish :: Talk -> Talk
finish talk = case begun talk of
  Nothing -> talk
  Just work -> case kind work of
    Analysis ->
      let (early, complete) = analysed (session talk) work
       in happen (Worked (number work) (AllChecked complete)) $
            (evaluateOnly early work talk) {begun = Nothing}
    TapeProof ->
      happen
        (Worked (number work) (TapeMade (TapeFacts.tapeFacts [] (loadedFor (session talk) work))))
        talk {begun = Nothing}

-- | Lets a slow worker end the evaluation.
finishEvaluation :: Talk -> Talk
finishEvaluation talk = case begun talk of
  Just work | kind work == Analysis -> evaluateOnly (fst (analysed (session talk) work)) work talk
  _ -> talk

evaluateOnly :: Snapshot -> WorkOrder -> Talk -> Talk
evaluateOnly early work talk =
  (happen (Worked (number work) (EvaluationChecked early)) talk {isSlow = True})
    { isSlow = isSlow talk
    }

-- | The snapshots of a document.
analysed :: Session -> WorkOrder -> (Snapshot, Snapshot)
analysed state work = Snapshot.inStages (Snapshot.checkWith []) (loadedFor state work)

-- | The program of a document. Imports find only open documents.
loadedFor :: Session -> WorkOrder -> LoadedProgram
loadedFor state work =
  runIdentity (LoadedProgram.load (Import.byName opened) (Text.unpack (path work)) (text work))
  where
    opened there =
      Identity (maybe (Left "it is not open") Right (lookup (Text.pack there) texts))
    texts = Session.openTexts state

-- | Lets the clock advance by a time in ms; deadlines within it are handled.
pause :: Int -> Talk -> Talk
pause milliseconds talk = case Schedule.deadline (session talk) of
  Just (Milliseconds due)
    | due <= time talk + milliseconds ->
      let then' = max (time talk) due
       in pause (time talk + milliseconds - then') (happen Due talk {time = then'})
  _ -> talk {time = time talk + milliseconds}

-- | All effects of the server so far, in order. An answer counts as sent.
heard :: Talk -> [Effect]
heard = reverse . sent

-- | The answer to a request.
ask :: Text -> Value -> Talk -> Either Failure Value
ask method params talk =
  case answers (sent (say (Request (String "q") method params) talk)) of
    answer : _ -> answer
    [] -> error "no answer"
  where
    answers effects =
      concat
        [ case effect of
            Send (Result (String "q") value) -> [Right value]
            Send (Refusal (String "q") failure) -> [Left failure]
            _ -> []
          | effect <- effects
        ]

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
textOf path talk = lookup path (Session.openTexts (session talk))

-- | All published diagnostics in order, each set with its address and version. The set after
-- evaluation is left out if the set after all passes follows it.
published :: Talk -> [(Value, Value, [Squiggle])]
published talk = concat (zipWith settledOnly all' (map Just (drop 1 all') <> [Nothing]))
  where
    all' = everyPublished talk
    settledOnly set@(uri, version, _) next = case next of
      Just (uri', version', _) | (uri, version) == (uri', version') -> []
      _ -> [set]

-- | All published diagnostics in order, each set with its address and version.
everyPublished :: Talk -> [(Value, Value, [Squiggle])]
everyPublished talk =
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
