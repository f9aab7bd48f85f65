-- | Hover and definition.
module Query.NameSpec (spec) where

import Base.Region (Region (..))
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Project.LoadedProgram qualified as LoadedProgram
import Query.Name (Hover (..), Target (..))
import Query.Name qualified as Name
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Test.Hspec

spec :: Spec
spec = do
  describe "hover" $ do
    it "shows the value of a name, at its use and at its definition" $ do
      hovered "let длина = 41 mm\nlet b = ^длина\n" `shouldBe` Just ("длина", Just "41 mm")
      hovered "let ^длина = 41 mm\n" `shouldBe` Just ("длина", Just "41 mm")
    it "takes a cursor after a name as a cursor on it" $
      hovered "let a = 1\nlet b = (a^, 2)\n" `shouldBe` Just ("a", Just "1 mm")
    it "knows functions, their parameters and the names of the language" $ do
      hovered "let f(x) = x\nlet b = ^f(1)\n" `shouldBe` Just ("f", Nothing)
      hovered "let f(x) = ^x\n" `shouldBe` Just ("x", Nothing)
      hovered "let b = ^sqrt(4)\n" `shouldBe` Just ("sqrt", Nothing)
    it "has no answer for numbers, keywords and unknown names" $
      map hovered ["let b = ^4\n", "^let b = 4\n", "let b = ^c\n"]
        `shouldBe` [Nothing, Nothing, Nothing]
  describe "definition" $ do
    it "leads from a use to the defined name" $
      defined "let a = 1\nlet b = ^a\n" `shouldBe` Just "a@4"
    it "leads to the parameter inside a function, and to the statement above outside of it" $ do
      defined "let a = 1\nlet f(a) = ^a\n" `shouldBe` Just "a@16"
      defined "let f(a) = a\nlet a = 1\nlet b = ^a\n" `shouldBe` Just "a@17"
    it "leads into the list of a repetition" $
      defined "contour k closed {\n  for a in [1] {\n    cw circle((^a, 0), 1)\n  }\n}\n"
        `shouldBe` Just "a@25"
    it "leads from a name in a cipher to the heading of its column" $ do
      let table = "table t {\n  x y mu deg H\n  0 0 5 9\n  9 0 6 9\n}\n"
          piece = "curve k = polyline(t)\npiece w = k cipher 4(^mu, H) left\n"
      defined (table <> piece) `shouldBe` Just "mu@16"
      hovered (table <> piece) `shouldBe` Just ("mu", Nothing)
    it "leads from a name in a repetition to the heading of its column" $ do
      let table = "table t {\n  angle radius deep\n  0 0 5\n  9 0 6\n}\n"
      defined (table <> "drill at t depth ^deep\n") `shouldBe` Just "deep@25"
      defined (table <> "for p in t {\n  rapid p + (^deep, 0)\n}\n") `shouldBe` Just "deep@25"
      hovered (table <> "drill at t depth ^deep\n") `shouldBe` Just ("deep", Nothing)
    it "has no answer for names of the language" $
      defined "let b = ^pi\n" `shouldBe` Nothing
  describe "while the text is broken" $ do
    it "a definition with a syntax error keeps its last meaning" $ do
      let sound = header <> "let aa = 41 mm\nlet b = aa\n"
          text = header <> "let aa = (41 mm\nlet b = aa\n"
      let asked = Name.hover (look text) (Just (look sound)) (offsetOf "= aa" text + 2)
      fmap values asked
        `shouldBe` Just ["41 mm"]
    it "names outside the change keep their definitions in the last text without errors" $ do
      let sound = header <> "let aa = 1\nlet f(x) = x + aa\nlet c = 2\n"
          text = header <> "let aa = 1\nlet f(x = x + aa\nlet c = 2\n"
          asked = Name.definition (look text) (Just (look sound)) (offsetOf "+ aa" text + 2)
      fmap region asked `shouldBe` Just (Region (offsetOf "aa" text) (offsetOf "aa" text + 2))

-- | The first statements of a program.
header :: Text
header =
  "part p\nmachine lkp-01f\ntool mill(diameter 2 mm)\nfeed 60 mm/min\ntolerance 0.02 mm\nfrom (0, \
  \0)\n"

-- | The snapshot of a text.
look :: Text -> Snapshot
look = Snapshot.take (Snapshot.checkWith []) . LoadedProgram.fromText "a.part"

-- | The offset of the first occurrence of a word in a text.
offsetOf :: Text -> Text -> Int
offsetOf word = Text.length . fst . Text.breakOn word

-- | The name and the value at the marked position.
hovered :: Text -> Maybe (Text, Maybe Text)
hovered marked =
  (\h -> (name h, listToMaybe (values h)))
    <$> Name.hover (look (Text.replace "^" "" marked)) Nothing (offsetOf "^" marked)

-- | The definition of the name at the marked position: its text and its offset.
defined :: Text -> Maybe Text
defined marked = said . region <$> Name.definition (look text) Nothing (offsetOf "^" marked)
  where
    text = Text.replace "^" "" marked
    said (Region from to) =
      Text.take (to - from) (Text.drop from text) <> "@" <> Text.pack (show from)
