-- | The law of edited files: G-code files with one edit each, judged by the proof and by a simple
-- judge that shares no code with it ("GcodeJudge").
--
-- PARTC_EDITED_FILES sets another number of edits. They are then random; without it, the edits are
-- always the same, and docs/proof.md lists their counts. With PARTC_RECORD set, the list is
-- written.
module Verify.EditedFileSpec (spec) where

import CaseCount (askedCount)
import Control.Monad (forM_, unless, when)
import Data.ByteString qualified as ByteString
import Data.List (intercalate, nub)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isNothing)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Files (readText)
import GcodeJudge (Reason (..), Verdict (..), clearsTheSame, reasonText, verdict)
import GcodeSubject (Subject (..), judged, programs, subjectOf)
import Generate.GcodeEdit (GcodeEdit (..), editKinds, gcodeEdit)
import System.Environment (lookupEnv)
import Test.Hspec hiding (after, before)
import Test.QuickCheck.Gen (Gen (unGen), elements, generate)
import Test.QuickCheck.Random (mkQCGen)
import Verify.Proof qualified as Proof

-- | Outcome of an edit.
data Outcome
  = -- | refused, and changed by the judge
    Refused
  | -- | refused, but the same by the judge
    RefusedSame
  | Accepted [Reason]
  | -- | accepted, but changed by the judge, or without a reason
    Wrong String
  deriving stock (Eq, Show)

spec :: Spec
spec = describe "edited files" $ do
  files <- runIO programs
  it "the file of each program is accepted as it is" $
    forM_ files $ \file -> do
      subject <- subjectOf file
      isAccepted subject (ownLines subject) `shouldBe` True
      verdict allowed (ownLines subject) (ownLines subject) `shouldBe` Same [Just NotRead]
  it
    "a file that cuts something else, or in an unsafe state, is refused; others have a reason"
    $ do
      subjects <- mapM subjectOf files
      asked <- askedCount "PARTC_EDITED_FILES"
      let edits = mapM (const (randomEdit subjects)) [1 .. fromMaybe 5000 asked]
      chosen <- if isNothing asked then pure (unGen edits (mkQCGen 31) 30) else generate edits
      let outcomes = [(kind edit, outcomeOf subject edit) | (subject, edit) <- chosen]
          wrong =
            [ name subject <> ", " <> change edit <> ": " <> why
              | ((subject, edit), (_, Wrong why)) <- zip chosen outcomes
            ]
      putStrLn (table outcomes)
      unless (null wrong) (expectationFailure (unlines (nub wrong)))
      when (isNothing asked) (recorded (Text.pack (table outcomes)))

ownLines :: Subject -> [String]
ownLines = lines . Text.unpack . own

randomEdit :: [Subject] -> Gen (Subject, GcodeEdit)
randomEdit subjects = do
  subject <- elements subjects
  edit <- gcodeEdit (ownLines subject)
  pure (subject, edit)

-- | Largest deviation that the programs allow: their tolerance of 0.02 mm and one pulse.
allowed :: Double
allowed = 0.021

outcomeOf :: Subject -> GcodeEdit -> Outcome
outcomeOf subject edit = case (isAccepted subject new, verdict allowed old new) of
  (False, Changed _) -> Refused
  (False, Same _) -> RefusedSame
  (True, Changed why)
    | clearsTheSame allowed old new -> Accepted [OtherLoops]
    | otherwise -> Wrong ("accepted, but " <> why)
  (True, Same found) -> maybe (Wrong "accepted without a reason") Accepted (sequence found)
  where
    (old, new) = (ownLines subject, edited edit)

-- | Verdict of the proof.
isAccepted :: Subject -> [String] -> Bool
isAccepted subject text =
  either (const False) Proof.isProven (judged subject (Text.pack (unlines text)))

-- Table -------------------------------------------------------------------------------------------

-- | Counts by kinds of edits, and by reasons.
table :: [(String, Outcome)] -> String
table outcomes =
  unlines
    ( ["| edit | files | refused | refused, though the same | accepted |", "|---|---|---|---|---|"]
        <> [row k (ofKind k) | (_, k, _) <- editKinds]
        <> [row "all" (map snd outcomes), "", "| reason | files |", "|---|---|"]
        <> [ "| " <> reasonText r <> " | " <> show n <> " |"
             | (r, n) <- Map.toList byReason
           ]
    )
  where
    ofKind k = [o | (k', o) <- outcomes, k' == k]
    row k os = "| " <> intercalate " | " (k : map show (counts os)) <> " |"
    counts os =
      [ length os,
        length (filter (== Refused) os),
        length (filter (== RefusedSame) os),
        length [() | Accepted _ <- os]
      ]
    byReason :: Map Reason Int
    byReason = Map.fromListWith (+) [(r, 1) | (_, Accepted rs) <- outcomes, r <- rs]

-- | Compares a table with the one in docs/proof.md, or writes it there.
recorded :: Text -> Expectation
recorded made = do
  page <- readText "docs/proof.md"
  recording <- lookupEnv "PARTC_RECORD"
  let begin = "<!-- edited files -->\n"
      (before, rest) = Text.breakOn begin page
      (inside, after) =
        Text.breakOn "<!-- end of edited files -->" (Text.drop (Text.length begin) rest)
      wanted = "\n" <> made <> "\n"
  case recording of
    Just _ ->
      ByteString.writeFile
        "docs/proof.md"
        (Encoding.encodeUtf8 (before <> begin <> wanted <> after))
    Nothing -> inside `shouldBe` wanted
