-- | Laws of the work in time: requests that wait, analyses that are stopped, the two sets of
-- diagnostics, progress.
module Lsp.ScheduleSpec (spec) where

import Data.Aeson (Value (..), object, (.=))
import Data.Aeson qualified as Aeson
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Conversation (Effect (..), WorkKind (..), WorkOrder (..))
import Lsp.Diagnostic qualified as Diagnostic
import Lsp.Message (ErrorCode (..), Failure (..), Incoming (..), Outgoing (..))
import Lsp.Message qualified as Message
import Lsp.Talk
import Test.Hspec

spec :: Spec
spec = do
  describe "a request" $ do
    it "for a hover is answered at once from the last snapshot, at the moved position" $ do
      let talk = replace addressOf 2 ("-- first\n" <> right) (slow settledRight)
      fmap (field "range") (ask "textDocument/hover" (about addressOf (8, 8)) talk)
        `shouldBe` Right (object ["start" .= at (8, 8), "end" .= at (8, 9)])
      fmap
        (field "line" . field "start" . field "range")
        (ask "textDocument/definition" (about addressOf (8, 8)) talk)
        `shouldBe` Right (Number 7)
    it "for the outline is answered at once, with the positions moved" $ do
      let talk = replace addressOf 2 ("\n" <> right) (slow settledRight)
          starts v = [field "line" (field "start" (field "range" (field "location" s))) | s <- v]
      fmap (starts . listed) (ask "textDocument/documentSymbol" (about addressOf (0, 0)) talk)
        `shouldBe` Right [Number 0, Number 7, Number 8]
    it "for symbols of all documents is answered from their last snapshots" $ do
      let found = ask "workspace/symbol" (object ["query" .= ("b" :: Text)]) settledRight
      fmap (map (field "name") . listed) found `shouldBe` Right [String "b"]
    it "for formatting waits for the analysis of the present text" $ do
      let talk = format 1 (replace addressOf 2 (right <> "let  d=1\n") (slow settledRight))
      outcomes talk `shouldBe` []
      map fst (outcomes (finishEvaluation (pause 0 talk))) `shouldBe` [Number 1]
    it "lets the analysis begin at once" $ do
      let talk = replace addressOf 2 wrong (slow settledRight)
      analyses talk `shouldBe` []
      analyses (format 1 talk) `shouldBe` [(Analysis, wrong)]
    it "is refused if it waits longer than a second" $ do
      let talk = format 1 (replace addressOf 2 wrong (slow settledRight))
      outcomes (pause 999 talk) `shouldBe` []
      outcomes (pause 1000 talk) `shouldBe` [(Number 1, Just ContentModified)]
    it "is refused if the text changes while it waits" $ do
      let talk = format 1 (replace addressOf 2 wrong (slow settledRight))
      outcomes (replace addressOf 3 right talk) `shouldBe` [(Number 1, Just ContentModified)]
    it "is refused if it is cancelled while it waits" $ do
      let talk = format 1 (format 2 (replace addressOf 2 wrong (slow settledRight)))
          cancel = Notification "$/cancelRequest" (object ["id" .= (2 :: Int)])
          cancelled = say cancel talk
      outcomes cancelled `shouldBe` [(Number 2, Just RequestCancelled)]
      map fst (outcomes (finishEvaluation cancelled)) `shouldBe` [Number 2, Number 1]
    it "that waits is refused before the answer to shutdown" $ do
      let talk = format 1 (replace addressOf 2 wrong (slow settledRight))
      outcomes (say (Request (Number 9) "shutdown" Null) talk)
        `shouldBe` [(Number 1, Just ContentModified), (Number 9, Nothing)]
    it "that is no request is refused under its own identifier, if it has one" $ do
      let talkAfter body = say (Message.decode body) (slow settledRight)
          refused body = [ident | Send (Refusal ident _) <- heard (talkAfter body)]
      map refused ["{\"id\":3}", "{\"id\":\"x\",\"method\":5}", "{\"method\":5}", "["]
        `shouldBe` [[Number 3], [String "x"], [Null], [Null]]
  describe "an analysis" $ do
    it "is stopped by a change, and begins anew after 30 ms" $ do
      let talk = pause 30 (replace addressOf 2 wrong (slow settledRight))
          later = replace addressOf 3 right talk
      analyses talk `shouldBe` [(Analysis, wrong)]
      drop 1 (orders later) `shouldBe` [Nothing]
      drop 2 (orders (pause 29 later)) `shouldBe` []
      drop 2 (orders (pause 30 later)) `shouldBe` [Just (Analysis, right)]
    it "of a changed document comes before the running one, which is done later" $ do
      let other = "file:///tmp/other.part"
          both = pause 500 (open other 1 right settledRight)
          talk = pause 30 (replace addressOf 2 wrong (slow both))
          later = pause 30 (replace other 2 (wrong <> "\n") talk)
      analyses later `shouldBe` [(Analysis, wrong), (Analysis, wrong <> "\n")]
      map snd (analyses (finish later)) `shouldBe` [wrong, wrong <> "\n", wrong]
    it "that takes longer than a second shows its progress, which ends with it" $ do
      let talk = pause 1000 (replace addressOf 2 wrong (slow (capable settledRight)))
          kinds t = [field "kind" (field "value" p) | Send (Notify "$/progress" p) <- heard t]
      kinds (pause 29 talk) `shouldBe` []
      kinds (pause 30 talk) `shouldBe` [String "begin"]
      kinds (finish (pause 30 talk)) `shouldBe` [String "begin", String "end"]
    it "can be stopped by the user, and the diagnostics say so" $ do
      let talk = pause 1100 (replace addressOf 2 wrong (slow (capable settledRight)))
          tokens = [field "token" p | Send (Ask _ "window/workDoneProgress/create" p) <- heard talk]
          cancel = Notification "window/workDoneProgress/cancel"
          stopped = foldl (\t token -> say (cancel (object ["token" .= token])) t) talk tokens
      map (\(_, _, found) -> map message found) (everyPublished stopped)
        `shouldBe` [["The analysis was stopped. " <> incomplete]]
      drop 1 (orders stopped) `shouldBe` [Nothing]
    it "is stopped after a minute" $ do
      let talk = pause 60030 (replace addressOf 2 wrong (slow settledRight))
      drop 1 (orders talk) `shouldBe` [Nothing]
  describe "diagnostics" $ do
    it "after evaluation keep the later ones of the last text, moved with the text" $ do
      let settled = pause 0 (open addressOf 1 wrongSide ready)
          talk = pause 30 (replace addressOf 2 ("-- first\n" <> wrongSide) (slow settled))
          shown t = [map place (filter isLate found) | (_, _, found) <- everyPublished t]
          place s = (code s, fst (from s))
          isLate s = code s == "E0401"
      shown settled `shouldBe` [[], [("E0401", 7)]]
      shown (finishEvaluation talk) `shouldBe` [[("E0401", 8)]]
      shown (finish talk) `shouldBe` [[("E0401", 8)], [("E0401", 8)]]
    it "of more than the greatest count are cut, with the count of the others" $ do
      let many = header <> Text.concat (replicate (Diagnostic.mostDiagnostics + 20) "let a = 1\n")
          found = squiggles many
      length found `shouldBe` Diagnostic.mostDiagnostics + 1
      message (last found) `shouldBe` "partc check shows 19 more reports"
    it "of a machine description are those of its reader" $ do
      let talk = pause 0 (open "file:///tmp/m.machine" 1 "nonsense\n" ready)
      map (\(_, _, found) -> null found) (published talk) `shouldBe` [False]
    it "are settled once for each analysis" $ do
      let talk = pause 30 (replace addressOf 2 wrong settledRight)
      [field "version" p | Send (Notify "partc/settled" p) <- heard talk]
        `shouldBe` [Number 1, Number 2]
  describe "a tape" $ do
    it "is proven in idle time, and not while the text changes" $ do
      let talk = slow (pause 0 (open addressOf 1 moving ready))
      analyses (pause 499 talk) `shouldBe` []
      map fst (analyses (pause 500 talk)) `shouldBe` [TapeProof]
      map (fmap fst) (orders (replace addressOf 2 wrong (pause 500 talk)))
        `shouldBe` [Just TapeProof, Nothing]
    it "that is proven is shown with its length" $ do
      let talk = finish (pause 500 (slow (pause 0 (open addressOf 1 moving ready))))
          lenses = ask "textDocument/codeLens" (about addressOf (0, 0)) talk
      [field "proven" p | Send (Notify "partc/proof" p) <- heard talk] `shouldBe` [Bool True]
      fmap (map (field "title" . field "command") . listed) lenses `shouldSatisfy` \case
        Right (String title : _) ->
          all (`Text.isInfixOf` title) ["lkp-01f", "m of tape", "proven"]
        _ -> False
    it "of a text without moves is not made" $
      analyses (pause 5000 (slow settledRight)) `shouldBe` []
    it "of a text with errors is not made" $
      analyses (pause 5000 (slow (pause 0 (open addressOf 1 wrong ready)))) `shouldBe` []
  describe "a lone surrogate" $
    it "becomes a replacement character, and pairs stay" $
      [ Aeson.toJSON t
        | Notification _ (Object _) <- [Message.decode half],
          t <- texts (Message.decode half)
      ]
        `shouldBe` [String "a\xFFFD\&b🙂\\ud800"]
  where
    half = "{\"method\":\"m\",\"params\":{\"t\":\"a\\ud83db\\ud83d\\ude42\\\\ud800\"}}"
    texts incoming = case incoming of
      Notification _ params | String t <- field "t" params -> [t]
      _ -> []

-- | The last sentences of the warning about a stopped analysis.
incomplete :: Text
incomplete = "Later mistakes are missing here. partc check has no limit."

-- | A conversation with a right program whose analysis has ended, with all its messages.
settledRight :: Talk
settledRight = pause 0 (open addressOf 1 right ready)

-- | A client that shows progress.
capable :: Talk -> Talk
capable _ =
  pause 0 . open addressOf 1 right $
    runningWith (object ["window" .= object ["workDoneProgress" .= True]])

ready :: Talk
ready = running (object [])

-- | Asks for formatting, with an identifier.
format :: Int -> Talk -> Talk
format ident =
  say (Request (Number (fromIntegral ident)) "textDocument/formatting" (about addressOf (0, 0)))

-- | The requests that have been answered or refused, in order, each with its identifier.
outcomes :: Talk -> [(Value, Maybe ErrorCode)]
outcomes talk = concatMap outcome (heard talk)
  where
    outcome effect = case effect of
      Send (Result ident _) -> [(ident, Nothing)]
      Send (Refusal ident (Failure why _)) -> [(ident, Just why)]
      _ -> []

-- | The orders to the worker after it became slow: work, or an order to stop.
orders :: Talk -> [Maybe (WorkKind, Text)]
orders talk = concatMap order (heard talk)
  where
    order effect = case effect of
      Begin work -> [Just (kind work, text work)]
      Halt -> [Nothing]
      _ -> []

-- | The work that has begun after the worker became slow.
analyses :: Talk -> [(WorkKind, Text)]
analyses = Maybe.catMaybes . orders

header, right, wrong, moving, wrongSide :: Text
header =
  "part p\nmachine lkp-01f\ntool mill(diameter 2 mm)\nfeed 60 mm/min\ntolerance 0.02 mm\nfrom (0, \
  \0)\n"
right = header <> "let a = 1\nlet b = a\n"
wrong = header <> "let a = 1\nlet b = c\n"
moving = header <> "rapid (10, 0)\n"
wrongSide =
  header <> "contour c open { line((0, 0), (50, 0)) }\nmill c outside { approach (0, 40) }\n"
