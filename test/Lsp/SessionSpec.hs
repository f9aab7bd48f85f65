-- | Laws of the conversation with an editor: order of messages, edits, diagnostics, answers.
module Lsp.SessionSpec (spec) where

import Base.Region qualified as Region
import Base.Result qualified as Result
import Control.Monad (forM_)
import Data.Aeson (Value (..), object, toJSON, (.=))
import Data.Aeson.Key qualified as Key
import Data.Either (lefts)
import Data.List (sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (filesBelow, readText)
import Lsp.Conversation (Effect (..), Ending (..))
import Lsp.Message (ErrorCode (..), Failure (..), Incoming (..), Outgoing (..))
import Lsp.Talk
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot qualified as Snapshot
import Report.Report (ReportCode (..), ReportPlace (..))
import Report.Report qualified as Report
import System.FilePath (takeExtension)
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck hiding (Failure)

spec :: Spec
spec = do
  describe "the order of a conversation" $ do
    it "requests before initialize are refused" $
      refusals (say (Request (Number 1) "textDocument/hover" Null) begin)
        `shouldBe` [(Number 1, NotInitialized)]
    it "notifications before initialize are ignored" $
      heard (pause 900 (open addressOf 1 "x" begin)) `shouldBe` []
    it "a second initialize is refused" $
      refusals (say (Request (String "two") "initialize" Null) (running (object [])))
        `shouldBe` [(String "two", InvalidRequest)]
    it "unknown requests are refused, unknown notifications are ignored" $ do
      refusals (say (Request (Number 7) "textDocument/frobnicate" Null) ready)
        `shouldBe` [(Number 7, MethodNotFound)]
      heard (say (Notification "$/setTrace" Null) ready) `shouldBe` []
      heard
        (say (Notification "workspace/didChangeConfiguration" (object ["settings" .= Null])) ready)
        `shouldBe` []
    it "wrong parameters are refused" $
      refusals (say (Request (Number 7) "textDocument/hover" (String "no")) ready)
        `shouldBe` [(Number 7, InvalidParams)]
    it "a request about a document that is not open has the answer null" $
      ask "textDocument/hover" (about "file:///tmp/other.part" (0, 0)) ready `shouldBe` Right Null
    it "requests after shutdown are refused, and exit is orderly" $ do
      let gone = say (Request (Number 1) "shutdown" Null) ready
      [m | Send m <- heard gone] `shouldBe` [Result (Number 1) Null]
      refusals (say (Request (Number 2) "textDocument/hover" Null) gone)
        `shouldBe` [(Number 2, InvalidRequest)]
      last (heard (say (Notification "exit" Null) gone)) `shouldBe` Stop Orderly
    it "exit without shutdown is abrupt" $
      last (heard (say (Notification "exit" Null) ready)) `shouldBe` Stop Abrupt
  describe "diagnostics" $ do
    it "are published on opening, with the version and the client's own address" $
      published (pause 0 (open "file:///tmp/%d1%84.part" 0 wrong ready))
        `shouldSatisfy` \case
          [(String "file:///tmp/%d1%84.part", Number 0, [Squiggle {code = "E0201"}])] -> True
          _ -> False
    it "are published 30 ms after a change" $ do
      let touched = replace addressOf 2 right (opened wrong)
      length (published (pause 29 touched)) `shouldBe` 1
      length (published (pause 30 touched)) `shouldBe` 2
    it "of edits at intervals below 30 ms are published every 300 ms, and for the last text" $ do
      let fast =
            pause
              500
              ( foldl
                  (\t n -> pause 20 (replace addressOf n (if even n then right else wrong) t))
                  (opened wrong)
                  [2 .. 40]
              )
      map (\(_, v, found) -> (v, map code found)) (drop 1 (published fast))
        `shouldBe` [(Number 16, []), (Number 31, ["E0201"]), (Number 40, [])]
    it "are removed after the mistake is fixed" $
      map
        (\(_, _, found) -> map code found)
        (published (pause 200 (replace addressOf 2 right (opened wrong))))
        `shouldBe` [["E0201"], []]
    it "are removed when the document is closed" $
      map (\(u, _, found) -> (u, map code found)) (published (close addressOf (opened wrong)))
        `shouldBe` [(String addressOf, ["E0201"]), (String addressOf, [])]
    it "are not published after the document is closed" $
      length (published (pause 900 (close addressOf (replace addressOf 2 wrong (opened wrong)))))
        `shouldBe` 2
    it "are published although a request was answered before" $
      length
        ( published
            ( pause
                500
                ( say
                    (Request (Number 1) "textDocument/documentSymbol" (about addressOf (0, 0)))
                    (open addressOf 0 wrong ready)
                )
            )
        )
        `shouldBe` 1
    it "change when an imported file is edited in another window" $ do
      let both =
            pause
              500
              ( open
                  addressOf
                  1
                  importing
                  (open "file:///tmp/pins.part" 1 "part pins\nlet pin = 3 mm\n" ready)
              )
          spoilt = pause 500 (replace "file:///tmp/pins.part" 2 "part pins\nlet pen = 3 mm\n" both)
          mended =
            pause
              500
              (replace "file:///tmp/pins.part" 3 "part pins\n-- wider\nlet pin = 3 mm\n" spoilt)
          latest talk =
            [map code found | (String u, _, found) <- reverse (published talk), u == addressOf]
      map (take 1 . latest) [both, spoilt, mended] `shouldBe` [[[]], [["E0201"]], [[]]]
      fmap (field "uri") (ask "textDocument/definition" (about addressOf (2, 9)) mended)
        `shouldBe` Right (String "file:///tmp/pins.part")
      fmap
        (field "line" . field "start" . field "range")
        (ask "textDocument/definition" (about addressOf (2, 9)) mended)
        `shouldBe` Right (Number 2)
    it "change when a missing import is opened" $ do
      let alone = pause 500 (open addressOf 1 importing ready)
          found = pause 500 (open "file:///tmp/pins.part" 1 "part pins\nlet pin = 3 mm\n" alone)
          latest talk =
            [map code there | (String u, _, there) <- reverse (published talk), u == addressOf]
      map (take 1 . latest) [alone, found] `shouldBe` [[["E0112"]], [[]]]
    it "of an imported file are at the import statement, and name the file" $ do
      let talk =
            pause
              500
              ( open
                  addressOf
                  1
                  importing
                  (open "file:///tmp/pins.part" 1 "part pins\nlet pin = 3 mm + 1 deg\n" ready)
              )
      let facts f = (from f, code f, "pins.part:2" `Text.isInfixOf` message f)
      [map facts found | (String u, _, found) <- published talk, u == addressOf]
        `shouldBe` [[((1, 7), "E0206", True)]]
    it "have hints in the message, and related regions too if the client cannot show them" $
      map message (squiggles (header <> "let a = 1\nlet a = 2\n"))
        `shouldBe` [ "‘a’ is defined twice\ndefined again here\nline 7: first defined here\nhint: \
                     \Name the second one a1.\nhint: Leave the second one out."
                   ]
    it "have related regions of their own if the client can show them" $ do
      let talk =
            pause
              0
              ( open
                  addressOf
                  0
                  (header <> "let a = 1\nlet a = 2\n")
                  (running (object ["publishDiagnostics" .= object ["relatedInformation" .= True]]))
              )
          related =
            take
              1
              [ field "relatedInformation" d
                | Send (Notify _ p) <- heard talk,
                  Array ds <- [field "diagnostics" p],
                  d <- foldMap pure ds
              ]
      related
        `shouldBe` [ Array
                       ( pure
                           ( object
                               [ "message" .= ("first defined here" :: Text),
                                 "location"
                                   .= object
                                     [ "uri" .= addressOf,
                                       "range" .= object ["start" .= at (6, 4), "end" .= at (6, 5)]
                                     ]
                               ]
                           )
                       )
                   ]
    it "have their fixes as code actions, if the client knows such actions" $ do
      let misspelt = header <> "let depth = 1\nlet b = deptth\n"
          client = object ["codeAction" .= object ["codeActionLiteralSupport" .= object []]]
          request =
            object
              [ "textDocument" .= object ["uri" .= addressOf],
                "range" .= object ["start" .= at (7, 9), "end" .= at (7, 9)],
                "context" .= object ["diagnostics" .= ([] :: [Value])]
              ]
          answer capabilities =
            ask
              "textDocument/codeAction"
              request
              (pause 0 (open addressOf 1 misspelt (running capabilities)))
          wanted =
            object
              [ "range" .= object ["start" .= at (7, 8), "end" .= at (7, 14)],
                "newText" .= ("depth" :: Text)
              ]
      fmap (map (\a -> (field "title" a, field "edit" a)) . items) (answer client)
        `shouldBe` Right
          [ ( String "Write ‘depth’",
              object ["changes" .= object [Key.fromText addressOf .= [wanted]]]
            )
          ]
      fmap items (answer (object [])) `shouldBe` Right []
    it "leave what is at a position to a request of its own" $ do
      let answer line column =
            ask
              "partc/at"
              (about addressOf (line, column))
              (opened (header <> "let depth = 1 mm\nlet b = depth\n"))
      fmap (\v -> (field "title" v, field "rows" v)) (answer 7 9)
        `shouldBe` Right
          ( String "depth",
            toJSON [["value" :: Text, "1 mm"], ["meaning", "a length"]]
          )
      answer 99 0 `shouldBe` Right Null
    it "of a text with a byte order mark count this mark as a character" $
      map from (squiggles ("\xFEFFpart p junk\n" <> Text.drop 7 header)) `shouldBe` [(0, 8)]
    prop "are shifted by the UTF-16 length of a text that is inserted before them in the line"
      . forAll (listOf (elements "aж€🙂𝔸 -"))
      $ \put ->
        let title = Text.pack put
         in map
              (\s -> (from s, to s))
              (squiggles ("part p \"" <> title <> "\" junk\n" <> Text.drop 7 header))
              === [((0, 10 + units title), (0, 14 + units title))]
    prop "have the same positions in lines that end with LF, CR or CR LF" . forAll broken $ \text ->
      let ended end = squiggles (Text.intercalate end (Text.splitOn "\n" text))
       in conjoin [ended "\r\n" === ended "\n", ended "\r" === ended "\n"]
    prop "after any edits are those of the final text in a new session" . forAll edits $
      \(first, steps) ->
        let (final, talk) = foldl edited (first, opened first) (zip [2 ..] steps)
            (_, version, found) = last (published (pause 200 talk))
         in conjoin
              [ textOf "/tmp/a.part" talk === Just final,
                found === squiggles final,
                version === Number (fromIntegral (1 + length steps))
              ]
    programs <- runIO (sort . filter ((== ".part") . takeExtension) <$> filesBelow "test/programs")
    it "have the regions and codes of the command line's reports, for all test programs" $
      forM_ programs $ \file -> do
        text <- readText file
        map (\s -> (from s, to s, code s)) (squiggles text) `shouldBe` reported text
    it "every request at every position of every program has an answer" $
      forM_ programs $ \file -> do
        text <- readText file
        let talk = opened text
            positions =
              [ (line, character)
                | (line, content) <- zip [0 ..] (Text.lines text <> ["", ""]),
                  character <- [0 .. Text.length content + 1]
              ]
        lefts
          [ ask method (about addressOf position) talk
            | position <- positions,
              method <- ["textDocument/hover", "textDocument/definition"]
          ]
          `shouldBe` []
        lefts
          [ ask method (about addressOf (0, 0)) talk
            | method <- ["textDocument/documentSymbol", "textDocument/formatting"]
          ]
          `shouldBe` []

items :: Value -> [Value]
items v = case v of
  Array vs -> foldMap pure vs
  _ -> []

ready :: Talk
ready = running (object [])

opened :: Text -> Talk
opened text = pause 0 (open addressOf 1 text ready)

refusals :: Talk -> [(Value, ErrorCode)]
refusals talk = [(ident, errorCode) | Send (Refusal ident (Failure errorCode _)) <- heard talk]

-- | The first six lines of a program, without errors.
header :: Text
header =
  "part p\nmachine lkp-01f\ntool mill(diameter 2 mm)\nfeed 60 mm/min\ntolerance 0.02 mm\nfrom (0, \
  \0)\n"

right, wrong :: Text
right = header <> "let a = 1\nlet b = a\n"
wrong = header <> "let a = 1\nlet b = c\n"

-- | The reports of the command line: both ends of the regions, in the units of the protocol, and
-- the codes.
reported :: Text -> [((Int, Int), (Int, Int), Text)]
reported text =
  [ (ends Region.start r, ends Region.end r, c)
    | r <- Report.sorted (Result.errors result <> Result.warnings result),
      let ReportCode c = Report.code r
  ]
  where
    result = Snapshot.whole (Snapshot.checkWith [] (LoadedProgram.fromText "/tmp/a.part" text))
    ends end r = case Report.place r of
      InSource region -> positionIn text (end region)
      InTape _ -> (0, 0)
      InFile -> (0, 0)
      InCommandLine -> (0, 0)

-- | Texts with errors in most lines.
broken :: Gen Text
broken =
  (header <>) . Text.unlines
    <$> listOf
      ( elements
          [ "let ж = 1 + (1, 2)",
            "let b = nothing -- 🙂",
            "🙂",
            "contour k closed {",
            "}",
            "",
            "part q \"€\" x",
            "let f(x) = x"
          ]
      )

-- | A text and edits: both ends as shares of the present text, and the new text.
edits :: Gen (Text, [[(Double, Double, Text)]])
edits =
  (,)
    <$> oneof [pure right, pure wrong, broken]
      <*> listOf (listOf1 ((,,) <$> choose (0, 1) <*> choose (0, 1) <*> piece))
  where
    piece =
      elements ["", "a", "ж", "🙂", "\n", "\r\n", "\r", "let z = a\n", "(", "\"", "-- 🙂 ж", "1"]

-- | Applies edits to a text and in a session.
edited :: (Text, Talk) -> (Int, [(Double, Double, Text)]) -> (Text, Talk)
edited (text, talk) (version, steps) =
  (final, change addressOf version (map snd changes) (pause 30 talk))
  where
    changes = drop 1 (scanl next (text, Null) steps)
    final = fst (last changes)
    next (old, _) (a, b, put) =
      let (begin', end') = (offsetAt old (min a b), offsetAt old (max a b))
       in ( Text.take begin' old <> put <> Text.drop end' old,
            object
              [ "range"
                  .= object
                    ["start" .= at (positionIn old begin'), "end" .= at (positionIn old end')],
                "text" .= put
              ]
          )
    -- No position lies between CR and LF.
    offsetAt old share =
      let offset = round (share * fromIntegral (Text.length old))
       in if offset > 0 && Text.take 2 (Text.drop (offset - 1) old) == "\r\n"
            then offset - 1
            else offset

-- | A program that imports another.
importing :: Text
importing = "part a\nimport \"pins.part\"\nlet b = pin + 1 mm\n"
