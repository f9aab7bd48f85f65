-- | Lines of facts that an editor shows above the statements of a program: above @part@ the machine
-- and the whole tape, above each machining statement its passes, its length and its time.
module Query.CodeLens
  ( CodeLens (..),
    codeLenses,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit)
import Base.Region (Located (..), Region)
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Query.Machining (StatementSummary (..))
import Query.Machining qualified as Machining
import Query.Measurement qualified as Measurement
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Query.TapeFacts (TapeFacts (..))
import Surface.Syntax qualified as Surface

-- | A line of facts above a statement.
data CodeLens = CodeLens {place :: Region, title :: Text}
  deriving stock (Eq, Show)

-- | The lenses of a program. The facts about its tape are absent until the tape is made.
codeLenses :: Snapshot -> Maybe TapeFacts -> [CodeLens]
codeLenses now tape =
  [ CodeLens {place = at, title = joined (wholeFacts now tape)}
    | not (null (wholeFacts now tape)),
      Located _ (Surface.Part (Located at _) _) <- take 1 ownStatements
  ]
    <> [ CodeLens {place = statement s, title = joined (workFacts (Snapshot.unit now) s)}
         | s <- summaries
       ]
  where
    ownStatements = Surface.statements (Snapshot.program now)
    summaries = case Snapshot.machines now of
      m : _ -> Machining.work m
      [] -> maybe [] (Machining.statements Nothing) (Snapshot.path now)
    joined = Text.intercalate " · "

wholeFacts :: Snapshot -> Maybe TapeFacts -> [Text]
wholeFacts now tape = case listToMaybe (Snapshot.machines now) of
  Nothing -> []
  Just m ->
    [Machining.machine m, counted (Machining.frames m) "frame", Measurement.time (Machining.time m)]
      <> [Decimal.fixed 2 x <> " m of tape" | Just t <- [tape], Just x <- [metres t]]
      <> [if isProven t then "proven" else "not proven" | Just t <- [tape]]

workFacts :: LengthUnit -> StatementSummary -> [Text]
workFacts unit s =
  [counted (passes s) "pass" | passes s > 0]
    <> [Decimal.inUnit unit (path s), Measurement.time (duration s)]
    <> [counted n "frame" | Just n <- [ownFrames s]]

-- | A count with its noun.
counted :: Int -> Text -> Text
counted n noun
  | n == 1 = "1 " <> noun
  | "s" `Text.isSuffixOf` noun = Decimal.whole n <> " " <> noun <> "es"
  | otherwise = Decimal.whole n <> " " <> noun <> "s"
