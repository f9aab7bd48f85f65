-- | The law of edited files: G-code files with one edit each, judged by the proof and by a simple
-- judge that shares no code with it ("GcodeJudge").
--
-- PARTC_EDITED_FILES sets another number of edits. They are then random; without it, the edits are
-- always the same, and docs/proof.md lists their counts. With PARTC_RECORD set, the list is written.
module Verify.EditedFileSpec (spec) where

import Base.Result qualified as Result
import CaseCount (askedCount)
import Compile (Analysis (..), Compiled (..), Punched (..))
import Compile qualified
import Control.Monad (forM_, unless)
import Data.ByteString qualified as ByteString
import Data.List (intercalate, nub, sort)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Files (filesBelow, readText)
import Gcode.Heading qualified as Heading
import Gcode.Writer (ToolFile (fileText))
import GcodeJudge (Reason (..), Verdict (..), clearsTheSame, reasonText, verdict)
import Generate.GcodeEdit (GcodeEdit (..), editKinds, gcodeEdit)
import Machine.Machine qualified as Machine
import Machines qualified
import Part.Part (Part)
import Project.LoadedProgram qualified as LoadedProgram
import System.Environment (lookupEnv)
import System.FilePath (takeExtension)
import Test.Hspec hiding (after, before)
import Test.QuickCheck.Gen (Gen (unGen), elements, generate)
import Test.QuickCheck.Random (mkQCGen)
import Verify.FromGcode qualified as FromGcode
import Verify.Proof qualified as Proof

-- | A program with its own file.
data Subject = Subject
  { name :: FilePath,
    compiled :: Compiled,
    evaluated :: Part,
    own :: [String]
  }

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
  files <- runIO (sort . filter ((== ".part") . takeExtension) <$> filesBelow "test/gcode")
  it "the file of each program is accepted as it is" $
    forM_ files $ \file -> do
      subject <- subjectOf file
      isAccepted subject (own subject) `shouldBe` True
      verdict allowed (own subject) (own subject) `shouldSatisfy` isSame
  it "a file that cuts something else, or in an unsafe state, is refused; an accepted one has a reason" $ do
    subjects <- mapM subjectOf files
    asked <- askedCount "PARTC_EDITED_FILES"
    let count = fromMaybe 5000 asked
        edits = mapM (const (randomEdit subjects)) [1 .. count]
    chosen <- if asked == Nothing then pure (unGen edits (mkQCGen 31) 30) else generate edits
    let outcomes = [(kind edit, outcomeOf subject edit) | (subject, edit) <- chosen]
        wrong =
          [ name subject <> ", " <> change edit <> ": " <> why
            | ((subject, edit), (_, Wrong why)) <- zip chosen outcomes
          ]
    putStrLn (table outcomes)
    unless (null wrong) (expectationFailure (unlines (nub wrong)))
    if asked == Nothing then recorded (Text.pack (table outcomes)) else pure ()
  where
    isSame v = case v of
      Same _ -> True
      Changed _ -> False

-- | Compiles a program.
subjectOf :: FilePath -> IO Subject
subjectOf file = do
  text <- readText file
  let loaded = LoadedProgram.fromText (Text.pack file) text
      job = Machines.jobFor (Machines.named "linuxcnc-mill") []
  case (Result.output (Compile.compile job loaded), Result.output (Compile.analyse [] loaded)) of
    (Just (c : _), Just Analysis {part})
      | [f] <- files (punched c) ->
        pure (Subject file c part (lines (Text.unpack (fileText f))))
    _ -> fail (file <> " has no file")

randomEdit :: [Subject] -> Gen (Subject, GcodeEdit)
randomEdit subjects = do
  subject <- elements subjects
  edit <- gcodeEdit (own subject)
  pure (subject, edit)

-- | Largest deviation that the programs allow: their tolerance of 0.02 mm and one pulse.
allowed :: Double
allowed = 0.021

outcomeOf :: Subject -> GcodeEdit -> Outcome
outcomeOf subject edit = case (isAccepted subject (edited edit), verdict allowed (own subject) (edited edit)) of
  (False, Changed _) -> Refused
  (False, Same _) -> RefusedSame
  (True, Changed why)
    | clearsTheSame allowed (own subject) (edited edit) -> Accepted [OtherLoops]
    | otherwise -> Wrong ("accepted, but " <> why)
  (True, Same found) -> maybe (Wrong "accepted without a reason") Accepted (sequence found)

-- | Verdict of the proof.
isAccepted :: Subject -> [String] -> Bool
isAccepted Subject {compiled, evaluated} text = case Machine.programForm (machine compiled) of
  Nothing -> False
  Just form ->
    case FromGcode.readTexts
      (machine compiled)
      form
      (Heading.fromToolpath (toolpath compiled))
      (program (punched compiled))
      [Text.pack (unlines text)] of
      Left _ -> False
      Right reading -> Proof.isProven (Compile.proveGcode form (Just evaluated) compiled reading)

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
      (inside, after) = Text.breakOn "<!-- end of edited files -->" (Text.drop (Text.length begin) rest)
      wanted = "\n" <> made <> "\n"
  case recording of
    Just _ -> ByteString.writeFile "docs/proof.md" (Encoding.encodeUtf8 (before <> begin <> wanted <> after))
    Nothing -> inside `shouldBe` wanted
