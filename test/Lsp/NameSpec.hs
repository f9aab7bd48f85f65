-- | Requests about names as messages of the protocol.
module Lsp.NameSpec (spec) where

import Data.Aeson (Value (..), object, (.=))
import Data.Aeson.Key qualified as Key
import Data.Aeson.KeyMap qualified as KeyMap
import Data.Aeson.Types (Pair)
import Data.Either (isLeft)
import Data.List (sort)
import Data.Text (Text)
import Lsp.Conversation (Effect (..))
import Lsp.Message (ErrorCode (..), Failure (..), Incoming (..), Outgoing (..))
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
  describe "in a library" $ do
    it "references lead into the open programs that import it" $
      fmap (map (field "uri") . listed) (inLibrary "textDocument/references" [] opened)
        `shouldBe` Right
          [String libraryUri, String addressOf, String addressOf, String "file:///tmp/b%2Epart"]
    it "a renaming changes the open programs that import it" $
      fmap
        (fileChanges . field "changes")
        (inLibrary "textDocument/rename" ["newName" .= ("bolt" :: Text)] opened)
        `shouldBe` Right [(addressOf, 2), ("file:///tmp/b%2Epart", 1), (libraryUri, 1)]
    it "a renaming is refused for a name that is taken in such a program" $
      [ why
        | Left (Failure InvalidParams why) <-
            [inLibrary "textDocument/rename" ["newName" .= ("a" :: Text)] opened]
      ]
        `shouldBe` ["‘a’ is taken: see /tmp/a.part, line 3"]
    it "a renaming waits for the analysis of the programs that import it" $ do
      let edited = replace libraryUri 2 ("-- pins\n" <> library) (slow opened)
          waiting = say (Request (String "r") "textDocument/rename" renaming) (slow edited)
          renaming = aboutPin (2, 4) ["newName" .= ("bolt" :: Text)]
      length (answersTo "r" waiting) `shouldBe` 0
      length (answersTo "r" (finishEvaluation waiting)) `shouldBe` 0
      map (fileChanges . field "changes") (answersTo "r" (finishAll waiting))
        `shouldBe` [[(addressOf, 2), ("file:///tmp/b%2Epart", 1), (libraryUri, 1)]]
      refusals "r" (pause 1000 (finishEvaluation waiting))
        `shouldBe` ["‘pin’ also occurs in /tmp/a.part, which is not analysed yet"]
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

-- | A library, and its address.
library, libraryUri :: Text
library = "part pins\nlet pin = 3 mm\n"
libraryUri = "file:///tmp/pins.part"

-- | A conversation in which the library is open, and two programs: one that imports it, and one
-- that imports it through the first one.
opened :: Talk
opened =
  pause 400 $
    open "file:///tmp/b%2Epart" 1 "part b\nimport \"a.part\"\nlet c = pin\n" $
      open addressOf 1 importing $
        open libraryUri 1 library (running (object []))

-- | The answer to a request about the name in the library.
inLibrary :: Text -> [Pair] -> Talk -> Either Failure Value
inLibrary method more = ask method (aboutPin (1, 4) more)

aboutPin :: (Int, Int) -> [Pair] -> Value
aboutPin position more =
  object (["textDocument" .= object ["uri" .= libraryUri], "position" .= at position] <> more)

-- | The addresses of the changed files, each with the count of its edits.
fileChanges :: Value -> [(Text, Int)]
fileChanges changes = case changes of
  Object o -> sort [(Key.toText key, length (listed v)) | (key, v) <- KeyMap.toList o]
  _ -> []

-- | The answers to the request with this identifier.
answersTo :: Text -> Talk -> [Value]
answersTo ident talk = [v | Send (Result (String i) v) <- heard talk, i == ident]

-- | The reasons for which the request with this identifier is refused.
refusals :: Text -> Talk -> [Text]
refusals ident talk = [why | Send (Refusal (String i) (Failure _ why)) <- heard talk, i == ident]

-- | Lets a slow worker end all its work.
finishAll :: Talk -> Talk
finishAll = (!! 8) . iterate (finish . pause 50)
