-- | Foldings, selections, colours, hints and lenses.
module Query.StructureSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Query.CodeLens qualified as CodeLens
import Query.Folding (Folding (..))
import Query.Folding qualified as Folding
import Query.InlayHint (InlayHint (..))
import Query.InlayHint qualified as InlayHint
import Query.Marked (header, look, marked)
import Query.Selection qualified as Selection
import Query.SemanticToken (SemanticToken (..), TokenKind (..))
import Query.SemanticToken qualified as SemanticToken
import Query.Symbol qualified as Symbol
import Query.TapeFacts (TapeFacts (..))
import Test.Hspec

spec :: Spec
spec = do
  describe "foldings" $ do
    it "are the inner lines of brackets and of comments" $
      folded "-- a\n-- b\npart p\nfor a in [1] {\n  rapid (a, 0)\n  rapid (a, 1)\n}\n"
        `shouldBe` [(3, 5, False), (0, 1, True)]
    it "are found in a broken text" $
      folded "part p\nlet = (\n  1,\n  2\n)\nmill {\n" `shouldBe` [(1, 3, False)]
    it "are not made of the comments behind statements" $
      folded "part p -- a\nlet a = 1 -- b\n" `shouldBe` []
  describe "selections" $ do
    it "grow from a word to the whole text" $
      selected "part p\nfor k in 1..3 {\n  rapid (k, 2 + ^k)\n}\n"
        `shouldBe` [ "k",
                     "2 + k",
                     "(k, 2 + k)",
                     "rapid (k, 2 + k)",
                     "for k in 1..3 {\n  rapid (k, 2 + k)\n}",
                     "part p\nfor k in 1..3 {\n  rapid (k, 2 + k)\n}\n"
                   ]
    it "contain elements and settings" $ do
      selected "part p\ncontour c closed {\n  ccw circle((0, 0), ^5) slow\n}\n"
        `shouldSatisfy` elem "ccw circle((0, 0), 5) slow"
      selected "part p\nmill c outside {\n  depth ^5 step 2\n}\n"
        `shouldSatisfy` elem "depth 5 step 2"
  describe "colours" $ do
    it "know names, words, numbers and comments" $
      coloured "part p -- x\nlet a = sqrt(4)\nlet b = a\n"
        `shouldBe` [ ("part", KeywordToken),
                     ("p", ValueToken),
                     ("-- x", CommentToken),
                     ("let", KeywordToken),
                     ("a", ValueToken),
                     ("sqrt", FunctionToken),
                     ("4", NumberToken),
                     ("let", KeywordToken),
                     ("b", ValueToken),
                     ("a", ValueToken)
                   ]
    it "mark definitions and names of the language" $
      [ (isDefinition t, isOfLanguage t)
        | t <- SemanticToken.semanticTokens (look "let a = sqrt(4)\n"),
          kind t `elem` [ValueToken, FunctionToken]
      ]
        `shouldBe` [(True, False), (False, True)]
    it "cover every word of an example but unknown names" $ do
      text <- readText "examples/flange.part"
      length (SemanticToken.semanticTokens (look text)) `shouldSatisfy` (> 70)
  describe "hints" $ do
    it "are the units of numbers, the types of values and the radii of circles" $
      hinted
        "let r = 9\nlet c = circle((1, -2 mm), r)\nfeed 60\ncontour k closed {\n  cw c\n}\n\
        \mill k outside {\n  approach (20, 0)\n  depth 3\n}\n"
        `shouldBe` "let r: a length = 9mm\nlet c: a circle = circle((1mm, -2 mm), r)\n\
                   \feed 60mm/min\ncontour k closed {\n  cw cradius 9 mm\n}\n\
                   \mill k outside {\n  approach (20mm, 0mm)\n  depth 3mm\n}\n"
    it "are absent at counts, and outside of the region" $ do
      hinted "let n = count_of([1, 2])\nassert n = 2\n"
        `shouldBe` "let n: a number = count_of([1, 2])\nassert n = 2\n"
      length (InlayHint.inlayHints (look "let r = 9 mm\nlet s = 9 mm\n") (Region 0 12)) `shouldBe` 1
  describe "lenses" $ do
    it "show the machine and the work in numbers" $
      map CodeLens.title (CodeLens.codeLenses milled Nothing)
        `shouldBe` [ "lkp-01f · 57 frames · 2 min 43 s",
                     "1 pass · 162.7554 mm · 2 min 43 s · 57 frames"
                   ]
    it "show the tape and its proof when they are known" $
      take
        1
        (map CodeLens.title (CodeLens.codeLenses milled (Just (TapeFacts (Just 1.5) True))))
        `shouldBe` ["lkp-01f · 57 frames · 2 min 43 s · 1.50 m of tape · proven"]
  describe "symbols" $ do
    it "of the statements in a block are inside the symbol of the block" $
      [(Symbol.name s, map Symbol.name (Symbol.children s)) | s <- Symbol.symbols nested]
        `shouldBe` [("for k in 1..3", ["inner", "if k > 1"])]
    it "are found by letters of their names" $ do
      map Symbol.name (Symbol.matching "INR" nested) `shouldBe` ["inner"]
      map Symbol.name (Symbol.matching "deep" nested) `shouldBe` ["deep"]
      map Symbol.name (Symbol.matching "xyz" nested) `shouldBe` []
  where
    nested = look "for k in 1..3 {\n  let inner = k\n  if k > 1 {\n    let deep = 1\n  }\n}\n"
    milled =
      look
        ( header
            <> "contour k closed {\n  ccw circle((30, 0), 10)\n}\n"
            <> "mill k outside {\n  approach (45, -20), (45, 0)\n  retract (45, -20)\n}\n"
        )

folded :: Text -> [(Int, Int, Bool)]
folded text =
  [(firstLine f, lastLine f, isComment f) | f <- Folding.foldings (Region.fromText "a.part" text)]

selected :: Text -> [Text]
selected text =
  let (now, at) = marked text
   in [ Text.take (b - a) (Text.drop a (Text.replace "^" "" text))
        | Region a b <- Selection.enclosing now at
      ]

coloured :: Text -> [(Text, TokenKind)]
coloured text =
  [ (Text.take (b - a) (Text.drop a text), kind t)
    | t <- SemanticToken.semanticTokens (look text),
      let Region a b = place' t
  ]

-- | A text with its hints.
hinted :: Text -> Text
hinted text = foldr put text (InlayHint.inlayHints (look text) (Region 0 (Text.length text)))
  where
    put h old = Text.take (offset h) old <> InlayHint.text h <> Text.drop (offset h) old
