-- | Requests about names as messages of the protocol.
module Lsp.NameSpec (spec) where

import Data.Aeson (Value (..), object, (.=))
import Data.Either (isLeft)
import Data.Text (Text)
import Lsp.Message (ErrorCode (..), Failure (..))
import Lsp.Talk
import Test.Hspec

spec :: Spec
spec = do
  it "references lead into imported files, with or without the definition" $ do
    fmap uris (references True) `shouldBe` Right [addressOf, addressOf, "file:///tmp/pins.part"]
    fmap uris (references False) `shouldBe` Right [addressOf, addressOf]
  it "highlights are those of the document itself" $
    fmap (map (field "range") . listed) (asked "textDocument/documentHighlight" [])
      `shouldBe` Right [range (2, 8) (2, 11), range (3, 8) (3, 11)]
  it "a renaming changes all files of the program" $
    asked "textDocument/rename" ["newName" .= ("bolt" :: Text)]
      `shouldBe` Right
        ( object
            [ "changes"
                .= object
                  [ "file:///tmp/a.part"
                      .= [bolt (2, 8) (2, 11), bolt (3, 8) (3, 11)],
                    "file:///tmp/pins.part" .= [bolt (1, 4) (1, 7)]
                  ]
            ]
        )
  it "a renaming is prepared with the region and the text of the name" $
    asked "textDocument/prepareRename" []
      `shouldBe` Right (object ["range" .= range (2, 8) (2, 11), "placeholder" .= ("pin" :: Text)])
  it "a renaming that is not possible is refused with the reason" $ do
    asked "textDocument/rename" ["newName" .= ("mill" :: Text)] `shouldSatisfy` isLeft
    [why | Left (Failure InvalidParams why) <- [ask' "textDocument/prepareRename" (0, 1) []]]
      `shouldBe` ["there is no name here"]
  where
    references isWanted =
      asked "textDocument/references" ["context" .= object ["includeDeclaration" .= isWanted]]
    uris v = [u | String u <- map (field "uri") (listed v)]
    asked method = ask' method (2, 9)
    range a b = object ["start" .= at a, "end" .= at b]
    bolt a b = object ["range" .= range a b, "newText" .= ("bolt" :: Text)]
    ask' method position more =
      ask
        method
        ( object
            ( ["textDocument" .= object ["uri" .= addressOf], "position" .= at position]
                <> more
            )
        )
        ( open addressOf 1 importing $
            open "file:///tmp/pins.part" 1 "part pins\nlet pin = 3 mm\n" (running (object []))
        )

-- | A program that uses a name of another file twice.
importing :: Text
importing = "part p\nimport \"pins.part\"\nlet a = pin\nlet b = pin\n"
