-- | Completion and signature help as messages of the protocol.
module Lsp.CompletionSpec (spec) where

import Data.Aeson (Value (..), object, (.=))
import Data.Text (Text)
import Lsp.Talk
import Test.Hspec

spec :: Spec
spec = do
  it "completes an empty file with snippets for a client that knows them" $ do
    map (field "newText" . field "textEdit") (take 1 (completed capable "" (0, 0)))
      `shouldBe` [String "part ${1:name} \"${2:title}\""]
    map (field "insertTextFormat") (take 1 (completed capable "" (0, 0))) `shouldBe` [Number 2]
  it "completes without marks for a client that does not know snippets" $
    [ (field "newText" (field "textEdit" i), field "insertTextFormat" i)
      | i <- take 1 (completed (object []) "" (0, 0))
    ]
      `shouldBe` [(String "part ", Number 1)]
  it "replaces the word at the cursor, in UTF-16 code units" $
    [field "range" (field "textEdit" i) | i <- take 1 (completed capable letters (1, 13))]
      `shouldBe` [object ["start" .= at (1, 11), "end" .= at (1, 14)]]
  it "documents an item with a sentence and the section of the manual" $
    [ field "documentation" i
      | i <- completed capable "part p\n" (1, 0),
        field "label" i == String "feed"
    ]
      `shouldBe` [ object
                     [ "kind" .= ("markdown" :: Text),
                       "value"
                         .= ( "Gives the feed from here on; after an element or a point, the feed \
                              \there.\n\nManual, Statements: docs/language.md#statements" ::
                                Text
                            )
                     ]
                 ]
  it "shows the form of a call and its active parameter" $ do
    let text = "part p\nlet a = polar(1, \n"
        answer = requested "textDocument/signatureHelp" capable text (1, 17)
    field "activeParameter" answer `shouldBe` Number 1
    map (field "label") (listed (field "signatures" answer))
      `shouldBe` [String "polar(length, angle)"]
  it "answers null outside of calls and in comments" $ do
    requested "textDocument/signatureHelp" capable "part p\n" (0, 3) `shouldBe` Null
    requested "textDocument/completion" capable "part p -- x\n" (0, 11) `shouldBe` Null
  where
    letters = "part p\nlet 𝑥𝑥 = flo\n"
    completed client text position =
      listed (field "items" (requested "textDocument/completion" client text position))

-- | The capabilities of a client with snippets and Markdown.
capable :: Value
capable =
  object
    [ "completion" .= object ["completionItem" .= object item],
      "hover" .= object ["contentFormat" .= ["markdown" :: Text]],
      "signatureHelp"
        .= object ["signatureInformation" .= object ["documentationFormat" .= ["markdown" :: Text]]]
    ]
  where
    item = ["snippetSupport" .= True, "documentationFormat" .= ["markdown" :: Text]]

-- | The answer to a request about a position of a text.
requested :: Text -> Value -> Text -> (Int, Int) -> Value
requested method client text position =
  either (error . show) id $
    ask method (about addressOf position) (open addressOf 1 text (running client))
