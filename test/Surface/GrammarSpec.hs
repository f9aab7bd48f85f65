-- | The grammar in the manual agrees with the parser.
module Surface.GrammarSpec (spec) where

import Base.Result qualified as Result
import Control.Monad (forM_)
import Data.Text qualified as Text
import Files (readText)
import Generate.Grammar qualified as Grammar
import Generate.Program qualified as Generate
import Report.Report qualified as Report
import Surface.Error (Error)
import Surface.Error qualified as Error
import Surface.Keyword qualified as Keyword
import Surface.Lexer qualified as Lexer
import Surface.Parser qualified as Parser
import Surface.PrintProgram qualified as PrintProgram
import Surface.Syntax (Program)
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck

spec :: Spec
spec = do
  manual <- runIO (readText "docs/language.md")
  let grammar = Grammar.fromText (Text.unlines (block "```ebnf" (Text.lines manual)))
  -- The bug: a rule that is used but not defined, or defined but not used; a grammar that is not
  -- read to its end.
  it "defines every rule that it uses, and uses every rule that it defines" $
    Grammar.loose grammar `shouldBe` []
  describe "of the manual" . modifyMaxSuccess (const 300) $ do
    -- The bug: a rule of the manual that the parser does not have, or has in another form.
    prop "the parser accepts every sentence of the grammar" $
      forAllShow (Grammar.sentence grammar) Text.unpack $ \text ->
        map
          (Report.title . Error.toReport)
          (Result.errors (Parser.parse 0 text :: Result.Result () Error Program))
          === []
    -- The bug: a literal of the manual that the parser does not have, or that no sentence reaches.
    describe "the parser accepts sentences that contain" . modifyMaxSuccess (const 10) $
      forM_ (Grammar.literals grammar) $ \literal ->
        prop (Text.unpack ("‘" <> literal <> "’")) $
          forAllShow (Grammar.sentenceWith literal grammar) Text.unpack $ \text ->
            Grammar.contains literal (fst (Lexer.tokens 0 text))
              && null (Result.errors (Parser.parse 0 text :: Result.Result () Error Program))
    -- The bug: a construct of the parser that the manual lacks.
    prop "every random program is a sentence of the grammar" $
      forAllShow Generate.program (Text.unpack . PrintProgram.program) $ \p ->
        Grammar.recognises grammar (fst (Lexer.tokens 0 (PrintProgram.program p)))
    -- The bug: a recogniser that accepts everything.
    it "the recogniser rejects texts that are not sentences" $
      map
        (Grammar.recognises grammar . fst . Lexer.tokens 0)
        [ "let a = 1",
          "let a 1",
          "part",
          "coolant on off",
          "let in = 3",
          "aux (1, 2, 3)",
          "aux (1, 2, 3, 4)"
        ]
        `shouldBe` [True, False, False, False, False, True, False]
  it "the manual lists the reserved words" $
    concatMap
      Text.words
      ( takeWhile
          ("    " `Text.isPrefixOf`)
          (drop 2 (dropWhile (/= "These words cannot be names:") (Text.lines manual)))
      )
      `shouldBe` Keyword.reservedWords
  where
    block fence = takeWhile (/= "```") . drop 1 . dropWhile (/= fence)
