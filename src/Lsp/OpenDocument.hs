-- | A document that is open in the editor: its text, the results of its analyses, and the requests
-- that wait for them.
--
-- A text is analysed in two stages: first evaluation (form, names, types, geometry), then all
-- passes up to the frames. Results of an older text stay until those of the present text are there.
module Lsp.OpenDocument
  ( OpenDocument (..),
    Stage (..),
    WaitingRequest (..),
    Milliseconds (..),
    plus,
    open,
    changed,
    evaluated,
    settled,
    subject,
    isReady,
    reportsFor,
    dependsOn,
    mayShareFiles,
    hasDependencies,
  )
where

import Base.Region qualified as Region
import Data.Aeson (Value)
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Document (Document)
import Lsp.Document qualified as Document
import Lsp.Message (Id)
import Lsp.Request (Need (..))
import Lsp.Subject (Subject (Subject, isAnalysed, now))
import Lsp.Subject qualified as Subject
import Lsp.Uri qualified as Uri
import Query.CarriedReport qualified as CarriedReport
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Query.TapeFacts (TapeFacts)
import Report.Report (Report)

-- | A time in ms since an arbitrary origin.
newtype Milliseconds = Milliseconds Int
  deriving stock (Eq, Ord, Show)

-- | The time a number of ms after another time.
plus :: Milliseconds -> Int -> Milliseconds
plus (Milliseconds time) wait = Milliseconds (time + wait)

-- | The results that exist for the present text.
data Stage = Unanalysed | Evaluated | Settled
  deriving stock (Eq, Ord, Show)

-- | A request that waits for an analysis: its identifier, its method, its parameters, and the time
-- at which it is refused.
data WaitingRequest = WaitingRequest
  { identifier :: Id,
    method :: Text,
    parameters :: Value,
    refusedAt :: Milliseconds
  }

-- | A document that is open in the editor.
data OpenDocument = OpenDocument
  { document :: Document,
    -- | the results that exist for the present text and its imports
    stage :: Stage,
    -- | the last snapshot, perhaps of an older text
    latest :: Maybe Snapshot,
    -- | the last snapshot without an error in evaluation
    sound :: Maybe Snapshot,
    -- | the last snapshot of a settled text
    lastSettled :: Maybe Snapshot,
    -- | the time of the first change after the last beginning of an analysis
    unsettledSince :: Maybe Milliseconds,
    -- | the time at which the next analysis may begin; nothing if none is needed, or if it is
    -- queued already
    due :: Maybe Milliseconds,
    -- | the time at which the tape may be made and proven; nothing if this is not to be done
    proofDue :: Maybe Milliseconds,
    -- | the facts about the tape of the present text; nothing if it is not made yet
    tape :: Maybe TapeFacts,
    -- | requests that wait for results, the newest first
    waiting :: [WaitingRequest]
  }

-- | An opened document, whose first analysis is due at once.
open :: Milliseconds -> Document -> OpenDocument
open now document =
  OpenDocument
    { document,
      stage = Unanalysed,
      latest = Nothing,
      sound = Nothing,
      lastSettled = Nothing,
      unsettledSince = Just now,
      due = Just now,
      proofDue = Nothing,
      tape = Nothing,
      waiting = []
    }

-- | The document after a change of its text or of a file on which it depends. Its analysis becomes
-- due 30 ms later. Each further change delays it again, but not beyond 300 ms after the first.
changed :: Milliseconds -> OpenDocument -> OpenDocument
changed now o =
  o
    { stage = Unanalysed,
      unsettledSince = Just since,
      due = Just (min (now `plus` silence) (since `plus` longestBurst)),
      proofDue = Nothing,
      tape = Nothing
    }
  where
    since = Maybe.fromMaybe now (unsettledSince o)
    silence = 30
    longestBurst = 300

-- | Stores the results of evaluation.
evaluated :: Snapshot -> OpenDocument -> OpenDocument
evaluated snapshot o =
  o
    { stage = Evaluated,
      latest = Just snapshot,
      sound = if Snapshot.isGood snapshot then Just snapshot else sound o
    }

-- | Stores the results of all passes. The tape may be proven a moment later, if the text has no
-- error and there are frames for the machine that it names.
settled :: Milliseconds -> Snapshot -> OpenDocument -> OpenDocument
settled now snapshot o =
  o
    { stage = Settled,
      latest = Just snapshot,
      sound =
        if any Snapshot.isGood (latest o) || Snapshot.isGood snapshot
          then Just snapshot
          else sound o,
      lastSettled = Just snapshot,
      proofDue =
        if Snapshot.isGood snapshot && Snapshot.hasFrames snapshot
          then Just (now `plus` idleTime)
          else Nothing
    }
  where
    idleTime = 500

-- | True if the results of the document itself that a request needs are there.
isReady :: Need -> OpenDocument -> Bool
isReady need o = case need of
  LastSnapshot -> Maybe.isJust (latest o)
  Evaluation -> stage o >= Evaluated
  SharedEvaluation -> stage o >= Evaluated
  AllPasses -> stage o == Settled

-- | The subject of a request, from the other open documents and the document itself. If the present
-- text is not analysed yet, its snapshot is an empty one, and answers come from the last snapshot,
-- with positions moved to the present text.
subject :: [OpenDocument] -> OpenDocument -> Subject
subject others o =
  Subject
    { Subject.document = document o,
      now,
      Subject.sound = before,
      Subject.tape = tape o,
      isAnalysed = stage o >= Evaluated,
      Subject.others = map (subject []) others
    }
  where
    (now, before) = case latest o of
      Just snapshot | stage o >= Evaluated -> (snapshot, sound o)
      Just snapshot | Snapshot.hasFacts snapshot -> (blank, Just snapshot)
      _ -> (blank, sound o)
    blank = case latest o of
      Just snapshot -> empty {Snapshot.identities = Snapshot.identities snapshot}
      Nothing -> empty
    empty =
      Snapshot.unanalysed
        (Region.fromText (Uri.toPath (Document.uri (document o))) (Document.program (document o)))

-- | The reports of a snapshot to publish. While only evaluation has ended, they include the reports
-- of later passes on the last settled text, moved to the present text.
reportsFor :: OpenDocument -> Snapshot -> [Report]
reportsFor o snapshot = case lastSettled o of
  Just before | stage o == Evaluated -> CarriedReport.carried before snapshot
  _ -> Snapshot.reports snapshot

-- | True if the results of a document depend on the file with this path.
dependsOn :: Text -> OpenDocument -> Bool
dependsOn path o = any ((path `elem`) . Snapshot.dependencies) (latest o)

-- | True if the text of a document may have an import, or if the results of the document @o@ depend
-- on it.
mayShareFiles :: OpenDocument -> OpenDocument -> Bool
mayShareFiles o other =
  dependsOn (Uri.toPath (Document.uri (document other))) o
    || any (Text.isInfixOf "import") (Document.contents (document other))

-- | True if the results of a document depend on other files.
hasDependencies :: OpenDocument -> Bool
hasDependencies o = case latest o of
  Just snapshot -> not (null (Snapshot.dependencies snapshot))
  Nothing -> False
