-- | The fast parser agrees with the explaining parser.
module Surface.Combinator.FastSpec (spec) where

import Base.Result (Result (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Generate.Program qualified as Generate
import Surface.Error (Error)
import Surface.Parser qualified as Parser
import Surface.PrintProgram qualified as PrintProgram
import Surface.Syntax (Program)
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck hiding (Result)

spec :: Spec
spec = describe "one grammar, two parsers" . modifyMaxSuccess (const 500) $ do
  -- The bug: a region, a value or a comment that the fast parser loses; a program without a mistake
  -- that it rejects.
  prop "both give the same tree for a program without mistakes" $
    forAllShow (PrintProgram.program <$> Generate.program) Text.unpack $ \text ->
      both text .&&. null (errors (parse text))
  -- The bug: a mistake that the fast parser accepts, or reads as something else.
  prop "both give the same tree and the same mistakes for a damaged program" $
    forAllShow (Generate.program >>= damaged 3 . PrintProgram.program) Text.unpack both
  where
    both text = parse text === Parser.parseExplained 0 text
    parse text = Parser.parse 0 text :: Result () Error Program

-- | A text in which @count@ substrings of at most four characters are replaced by symbols and
-- words.
damaged :: Int -> Text -> Gen Text
damaged count text
  | count <= 0 = pure text
  | otherwise = do
    at <- choose (0, Text.length text)
    gone <- choose (0, 4)
    new <-
      elements
        [ "",
          "(",
          ")",
          "{",
          "}",
          "[",
          "]",
          "\n",
          ",",
          "=",
          "+",
          "..",
          "\"",
          "--",
          " 3 ",
          " x ",
          " if ",
          " for ",
          " else ",
          " and ",
          " fillet ",
          "\nlet ",
          "\nmill "
        ]
    damaged (count - 1) (Text.take at text <> new <> Text.drop (at + gone) text)
