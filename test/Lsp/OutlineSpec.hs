-- | Requests about the structure and the layout of a document as messages of the protocol.
module Lsp.OutlineSpec (spec) where

import Data.Aeson (Value (..), object, toJSON, (.=))
import Data.Aeson.Types qualified as Aeson (parseMaybe)
import Data.Text (Text)
import Lsp.Document qualified as Document
import Lsp.Request (Subject (..))
import Lsp.Request qualified as Request
import Lsp.Talk
import Lsp.Uri (Uri (..))
import Query.Marked (look)
import Test.Hspec

spec :: Spec
spec = do
  it "symbols are nested for a client that knows this, else a list" $ do
    let nested = object ["hierarchicalDocumentSymbolSupport" .= True]
        names v = [field "name" s | s <- listed v]
        blocks client = requested "textDocument/documentSymbol" client [] block
    names (blocks (object ["documentSymbol" .= nested])) `shouldBe` [String "for k in 1..2"]
    concatMap (names . field "children") (listed (blocks (object ["documentSymbol" .= nested])))
      `shouldBe` [String "a"]
    names (blocks (object [])) `shouldBe` [String "for k in 1..2", String "a"]
  it "symbols of all open documents are found by letters of their names" $ do
    let opened uri text =
          Subject
            { document = Document.open (Uri uri) Nothing text,
              now = look text,
              sound = Nothing,
              tape = Nothing,
              isAnalysed = True,
              others = []
            }
        subjects =
          [opened "file:///a" "let pin = 1\n", opened "file:///b" "let span = 1\nlet c = 2\n"]
        answer = do
          found <- Request.workspaceMethod "workspace/symbol"
          Aeson.parseMaybe (found subjects) (object ["query" .= ("PN" :: Text)])
    fmap (\v -> [(field "name" s, field "uri" (field "location" s)) | s <- listed v]) answer
      `shouldBe` Just [(String "pin", String "file:///a"), (String "span", String "file:///b")]
  it "tokens are relative to one another and count UTF-16 code units" $
    field "data" (simple "textDocument/semanticTokens/full" [] "let 𝑥 = 1\nlet b = 𝑥\n")
      `shouldBe` toJSON
        ( concat
            [ [0, 0, 3, 0, 0],
              [0, 4, 2, 4, 1],
              [0, 5, 1, 1, 0],
              [1, 0, 3, 0, 0],
              [0, 4, 1, 4, 1],
              [0, 4, 2, 4, 0 :: Int]
            ]
        )
  it "hints are off unless the client asks for them" $
    requested "textDocument/inlayHint" (object []) ["range" .= whole] "let a = 1 mm\n"
      `shouldBe` toJSON ([] :: [Value])
  it "links lead to imported files and to machine descriptions" $
    [ (field "target" l, field "range" l)
      | l <-
          listed
            ( answered
                "textDocument/documentLink"
                []
                ( open addressOf 1 "part p\nimport \"pins.part\"\nmachine \"shop.machine\"\n" $
                    open "file:///tmp/pins.part" 1 "part q\n" (running (object []))
                )
            )
    ]
      `shouldBe` [ ( String "file:///tmp/pins.part",
                     object ["start" .= at (1, 7), "end" .= at (1, 18)]
                   ),
                   ( String "file:///tmp/shop.machine",
                     object ["start" .= at (2, 8), "end" .= at (2, 22)]
                   )
                 ]
  it "foldings have lines" $ do
    let found = listed (simple "textDocument/foldingRange" [] block)
    [(field "startLine" f, field "endLine" f) | f <- found] `shouldBe` [(Number 0, Number 2)]
  it "selections have parents" $ do
    let found = listed (simple "textDocument/selectionRange" ["positions" .= [at (1, 7)]] block)
    map (field "range" . field "parent") found
      `shouldBe` [object ["start" .= at (1, 2), "end" .= at (1, 11)]]
  it "formatting changes the lines that differ" $
    requested "textDocument/formatting" (object []) [] "let a  = 1\nlet b = 2\nlet c  = 3\n"
      `shouldBe` toJSON
        [ edit (0, 0) (1, 0) "let a = 1\n",
          edit (2, 0) (3, 0) "let c = 3\n"
        ]
  it "a new line in a block closes it" $
    requested
      "textDocument/onTypeFormatting"
      (object [])
      ["position" .= at (1, 0), "ch" .= ("\n" :: Text)]
      "for k in 1..2 {\n\n"
      `shouldBe` toJSON [edit (1, 0) (1, 0) "  \n}"]
  it "lenses are at the part and at each machining statement" $
    listed (requested "textDocument/codeLens" (object []) [] "part p\n") `shouldBe` []
  where
    block = "for k in 1..2 {\n  let a = k\n\n}\n"
    whole = object ["start" .= at (0, 0), "end" .= at (9, 0)]
    edit a b new =
      object
        ["range" .= object ["start" .= at a, "end" .= at b], "newText" .= (new :: Text)]
    simple method = requested method (object [])
    requested method client more text =
      answered method more (open addressOf 1 text (running client))
    answered method more talk =
      either
        (error . show)
        id
        (ask method (object (("textDocument" .= object ["uri" .= addressOf]) : more)) talk)
