-- | The work of the language server in time: which document is analysed next, what its results
-- change, and what happens if an analysis takes long.
--
-- The worker analyses one document at a time. The document that has changed last comes first: work
-- on another document is stopped and done later. If no analysis is left, the tapes of programs
-- without errors are made and proven, one after the other.
module Lsp.Schedule
  ( deadline,
    advance,
    worked,
    halt,
    abandon,
    refuseWaiting,
    tooLate,
    isReady,
    answer,
    answered,
    patience,
    waitingTime,
  )
where

import Data.Aeson (Value (..))
import Data.Aeson.Types (Parser)
import Data.Aeson.Types qualified as Aeson (parseEither)
import Data.List qualified as List
import Data.Map.Strict qualified as Map
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Capability (Client)
import Lsp.Conversation
import Lsp.Diagnostic qualified as Diagnostic
import Lsp.Document qualified as Document
import Lsp.Message (ErrorCode (..), Failure (..), Id, Outgoing (..))
import Lsp.OpenDocument
  ( Milliseconds (..),
    OpenDocument (..),
    Stage (..),
    WaitingRequest (..),
    plus,
    reportsFor,
  )
import Lsp.OpenDocument qualified as OpenDocument
import Lsp.Request (Need (..))
import Lsp.Request qualified as Request
import Lsp.Status (Interruption (..))
import Lsp.Status qualified as Status
import Lsp.Uri qualified as Uri
import Query.TapeFacts (TapeFacts (isProven))

-- | The time in ms that a request waits for an analysis. An analysis that takes longer shows its
-- progress in the editor.
waitingTime :: Int
waitingTime = 1000

-- | The time in ms after which a request is refused if its results are not there: 'waitingTime', or
-- much longer for the first snapshot of a document.
patience :: Need -> Int
patience = \case
  LastSnapshot -> longestWork
  Evaluation -> waitingTime
  SharedEvaluation -> waitingTime
  AllPasses -> waitingTime

-- | The longest time in ms of an analysis or a proof in the editor. @partc check@ has no such
-- limit.
longestWork :: Int
longestWork = 60000

-- | The earliest time at which the passing of time has an effect; nothing if there is no such time.
deadline :: Session -> Maybe Milliseconds
deadline session = if null times then Nothing else Just (minimum times)
  where
    times = concatMap ofDocument (Map.elems (documents session)) <> foldMap ofWork (current session)
    ofDocument o =
      Maybe.catMaybes [due o, if isIdle then proofDue o else Nothing] <> map refusedAt (waiting o)
    ofWork w =
      [since w `plus` waitingTime | not (isShown w), kind (work w) == Analysis]
        <> [since w `plus` longestWork]
    isIdle = null (queue session) && Maybe.isNothing (current session)

-- | Does what is due at the time @now@: refuses requests that have waited too long, shows the
-- progress of a long analysis, stops work that takes too long, and begins the next work.
advance :: Client -> Milliseconds -> Session -> (Session, [Effect])
advance c now session =
  List.foldl'
    (\(s, effects) next -> let (s', more) = next s in (s', effects <> more))
    (session, [])
    [refuseLate c now, showProgress c now, stopLongWork c now, beginWork c now]

-- | Refuses the requests that have waited too long. If a request has waited only for the results of
-- other documents, it is answered without them.
refuseLate :: Client -> Milliseconds -> Session -> (Session, [Effect])
refuseLate c now session =
  ( session {documents = Map.map patient (documents session)},
    [ if OpenDocument.isReady (Request.need (method w)) o
        then answer c session o w
        else Send (Refusal (identifier w) tooLate)
      | o <- Map.elems (documents session),
        w <- reverse (waiting o),
        refusedAt w <= now
    ]
  )
  where
    patient o = o {waiting = filter ((> now) . refusedAt) (waiting o)}

-- | The failure of a request whose answer would come too late.
tooLate :: Failure
tooLate =
  Failure
    ContentModified
    "the text has changed, or its analysis takes longer than a request waits"

-- | Refuses all requests that wait for results of the document with this path.
refuseWaiting :: Failure -> Text -> Session -> (Session, [Effect])
refuseWaiting failure there session =
  ( adjusted there (\o -> o {waiting = []}) session,
    [ Send (Refusal (identifier w) failure)
      | Just o <- [Map.lookup there (documents session)],
        w <- reverse (waiting o)
    ]
  )

-- | Shows the progress of an analysis that takes longer than 'waitingTime'.
showProgress :: Client -> Milliseconds -> Session -> (Session, [Effect])
showProgress c now session = case current session of
  Just w
    | kind (work w) == Analysis && not (isShown w) && since w `plus` waitingTime <= now ->
      ( session {current = Just w {isShown = True}},
        map Send (Status.progressBegins c (number (work w)) (path (work w)))
      )
  _ -> (session, [])

-- | The message that ends the display of progress, if there is one.
endOfProgress :: Client -> CurrentWork -> [Effect]
endOfProgress c w = [Send m | isShown w, m <- Status.progressEnds c (number (work w))]

-- | Stops work that takes longer than 'longestWork'.
stopLongWork :: Client -> Milliseconds -> Session -> (Session, [Effect])
stopLongWork c now session = case current session of
  Just w | since w `plus` longestWork <= now -> halt c TookTooLong w session
  _ -> (session, [])

-- | Stops the work of the worker. If it is an analysis, the document gets a diagnostic that says
-- why its results are not complete.
halt :: Client -> Interruption -> CurrentWork -> Session -> (Session, [Effect])
halt c why w session =
  ( adjusted there (\o -> o {proofDue = Nothing}) refused {current = Nothing},
    Halt : endOfProgress c w <> notice <> refusals
  )
  where
    there = path (work w)
    (refused, refusals) = refuseWaiting tooLate there session
    notice =
      [ Send message
        | kind (work w) == Analysis,
          Just o <- [Map.lookup there (documents session)],
          message <-
            [ Diagnostic.incomplete c (document o) (shown o) (Status.reason why),
              Status.settled (document o)
            ]
      ]
    shown o
      | stage o == Unanalysed = Nothing
      | otherwise = (\snapshot -> (snapshot, reportsFor o snapshot)) <$> latest o

-- | Queues the documents whose analysis is due, and gives the worker the first document of the
-- queue if it is idle, if it proves a tape, or if a document has just become due. If there is
-- nothing to analyse and the worker is idle, a due proof begins.
beginWork :: Client -> Milliseconds -> Session -> (Session, [Effect])
beginWork c now session = case (queue queued, current session) of
  (there : rest, worker)
    | isFree worker || not (null nowDue) ->
      begin c now Analysis there (suspended worker) {queue = rest}
  ([], Nothing)
    | there : _ <- provable -> begin c now TapeProof there queued
  _ -> (queued, [])
  where
    nowDue = [there | (there, o) <- Map.toList (documents session), any (<= now) (due o)]
    queued =
      (foldr (\there -> adjusted there (\o -> o {due = Nothing})) session nowDue)
        { queue = List.nub (nowDue <> interrupted <> queue session)
        }
    -- The analysis that stops for a document that has just become due comes after this one.
    interrupted =
      [path (work w) | not (null nowDue), Just w <- [current session], kind (work w) == Analysis]
    isFree = maybe True ((== TapeProof) . kind . work)
    suspended worker = case worker of
      Just w
        | kind (work w) == TapeProof ->
          adjusted (path (work w)) (\o -> o {proofDue = Just (now `plus` waitingTime)}) queued
      _ -> queued
    provable = [there | (there, o) <- Map.toList (documents session), any (<= now) (proofDue o)]

-- | Gives the worker new work. Work that it has not ended is stopped.
begin :: Client -> Milliseconds -> WorkKind -> Text -> Session -> (Session, [Effect])
begin c now kind path session = case Map.lookup path (documents session) of
  Nothing -> (session, [])
  Just o ->
    let number = lastWork session + 1
        work = WorkOrder {number, kind, path, text = Document.program (document o)}
        started = Just CurrentWork {work, since = now, isShown = False}
     in ( adjusted path begun session {current = started, lastWork = number},
          foldMap (endOfProgress c) (current session) <> [Begin work]
        )
  where
    begun o = case kind of
      Analysis -> o {unsettledSince = Nothing}
      TapeProof -> o {proofDue = Nothing}

-- | Stops the work on the document with this path, whose text has changed.
abandon :: Text -> Session -> (Session, [Effect])
abandon there session = case current session of
  Just w
    | path (work w) == there ->
      (session {current = Nothing}, Halt : foldMap (`endOfProgress` w) (client session))
  _ -> (session, [])

-- | Stores a result of the worker, publishes it, and answers the requests that have waited for it.
worked :: Client -> Milliseconds -> CurrentWork -> Outcome -> Session -> (Session, [Effect])
worked c now w outcome session = case Map.lookup there (documents session) of
  Nothing -> (idle, [])
  Just o -> case outcome of
    EvaluationChecked snapshot ->
      let (session', messages, answers) = publish c (OpenDocument.evaluated snapshot o) session
       in (session', messages <> answers)
    AllChecked snapshot ->
      let (session', messages, answers) = publish c (OpenDocument.settled now snapshot o) idle
          ended = Send (Status.settled (document o)) : endOfProgress c w
       in (session', messages <> ended <> answers)
    TapeMade facts ->
      ( adjusted there (\d -> d {tape = Just facts}) idle,
        map Send (Status.proofEnded c (lastWork session) (document o) (isProven facts))
      )
    Fault why -> faulty c why w idle
    TooLarge -> halt c TookTooMuchMemory w session
  where
    there = path (work w)
    idle = session {current = Nothing}

-- | Stores a document whose last snapshot is new. The lists have the message with its diagnostics,
-- and the answers to the requests that have waited for the snapshot.
publish :: Client -> OpenDocument -> Session -> (Session, [Effect], [Effect])
publish c o session =
  ( stored {documents = Map.map (\d -> d {waiting = snd (divided d)}) (documents stored)},
    [Send (Diagnostic.publish c (document o) ((\s -> (s, reportsFor o s)) <$> latest o))],
    [ answer c stored d r
      | d <- Map.elems (documents stored),
        r <- reverse (fst (divided d))
    ]
  )
  where
    stored = session {documents = Map.insert (pathOf o) o (documents session)}
    divided d = List.partition (isReady stored d) (waiting d)

-- | Reports a fault of the compiler during some work.
faulty :: Client -> Text -> CurrentWork -> Session -> (Session, [Effect])
faulty c why w session = case kind (work w) of
  Analysis ->
    ( session',
      foldMap (map Send . notice . document) found
        <> endOfProgress c w
        <> refusals
    )
  TapeProof -> (session, [Send (Status.logged why)])
  where
    found = Map.lookup (path (work w)) (documents session)
    notice d = [Diagnostic.bug d why, Status.settled d]
    failure = Failure InternalError (Status.fault why)
    (session', refusals) = refuseWaiting failure (path (work w)) session

-- | The path of a document.
pathOf :: OpenDocument -> Text
pathOf = Uri.toPath . Document.uri . document

-- | True if the results that a request about the document @o@ needs are there. Results of another
-- document are not needed if there will be none, because its analysis was stopped.
isReady :: Session -> OpenDocument -> WaitingRequest -> Bool
isReady session o r =
  OpenDocument.isReady need o && not (need == SharedEvaluation && any isAwaited (others session o))
  where
    need = Request.need (method r)
    isAwaited other =
      stage other == Unanalysed && isPending other && OpenDocument.mayShareFiles o other
    isPending other =
      Maybe.isJust (due other)
        || pathOf other `elem` queue session
        || any ((== pathOf other) . path . work) (current session)

-- | The other open programs.
others :: Session -> OpenDocument -> [OpenDocument]
others session o =
  [ other
    | other <- Map.elems (Map.delete (pathOf o) (documents session)),
      not (Document.isDescription (document other))
  ]

-- | The answer to a request about a document.
answer :: Client -> Session -> OpenDocument -> WaitingRequest -> Effect
answer c session o r = Answer (identifier r) $ case Request.method (method r) of
  Nothing ->
    Refusal (identifier r) (Failure MethodNotFound ("there is no request " <> method r))
  Just f -> answered (identifier r) (f c (OpenDocument.subject (others session o) o)) (parameters r)

-- | The answer that a function gives for the parameters of a request with this identifier. If the
-- function fails, the request is refused with the reason.
answered :: Id -> (Value -> Parser Value) -> Value -> Outgoing
answered ident f params = case Aeson.parseEither f params of
  Right result -> Result ident result
  Left why -> Refusal ident (Failure InvalidParams (withoutPlace (Text.pack why)))
  where
    -- The parser of JSON puts the place in the parameters before the reason.
    withoutPlace why
      | "Error in $" `Text.isPrefixOf` why = Text.drop 2 (snd (Text.breakOn ": " why))
      | otherwise = why
