-- | The parser of Haskell sources, tested on made-up sources.
module HaskellSourceSpec
  ( spec,
  )
where

import Data.Text qualified as Text
import HaskellSource
import Test.Hspec

spec :: Spec
spec = do
  describe "imports" $ do
    it "reads an import without keywords" $
      importsOf ["import Data.Text", "import Base.Name (Name)"]
        `shouldBe` ["Data.Text", "Base.Name"]
    it "reads qualified before the name" $
      importsOf ["import qualified Data.Map.Strict as Map"] `shouldBe` ["Data.Map.Strict"]
    it "reads qualified after the name" $
      importsOf ["import Data.Map.Strict qualified as Map"] `shouldBe` ["Data.Map.Strict"]
    it "reads package imports, safe imports and pragmas" $
      importsOf
        [ "import \"containers\" Data.Set",
          "import safe qualified \"text\" Data.Text",
          "import {-# SOURCE #-} Base.Name"
        ]
        `shouldBe` ["Data.Set", "Data.Text", "Base.Name"]
    it "reads an import over several lines" $
      importsOf ["import", "  qualified", "  -- why", "  Data.Text", "  as Text"]
        `shouldBe` ["Data.Text"]
    it "reads hiding and nested lists" $
      importsOf ["import Prelude hiding (lookup, (++))", "import A (B (..), (-->))", "import C"]
        `shouldBe` ["Prelude", "A", "C"]
    it "reads imports that share a line" $
      importsOf ["import A; import B"] `shouldBe` ["A", "B"]
    it "ignores line comments" $
      importsOf ["-- import A", "--- import B", "import C -- import D"] `shouldBe` ["C"]
    it "does not take an operator with dashes for a comment" $
      importsOf ["x = a --> b; import A", "y = f.--.g; import B", "import C"]
        `shouldBe` ["A", "B", "C"]
    it "ignores block comments, also nested ones" $
      importsOf ["{- import A {- import B -} import C -}", "import D"] `shouldBe` ["D"]
    it "ignores string literals" $
      importsOf
        ["x = \"import A \\\" import B\"", "y = \"{-\"", "z = \"\\", "  \\ import C\"", "import D"]
        `shouldBe` ["D"]
    it "ignores character literals and primes" $
      importsOf ["q = ['\"', '\\'', '\\\\', '\\x41']", "f' = foldl' import' 'A", "import D"]
        `shouldBe` ["D"]
    it "ignores foreign imports" $
      importsOf ["foreign import ccall \"math.h sin\" sine :: Double -> Double", "import A"]
        `shouldBe` ["A"]

  describe "listsExports" $ do
    it "is true for a module with an export list" $
      listed "module A (b) where" `shouldBe` True
    it "is true for an export list after comments and pragmas" $
      listed
        "{-# LANGUAGE CPP #-}\n-- | module B where\nmodule A\n  ( -- * Section\n    b,\n  )\nwhere"
        `shouldBe` True
    it "is false for a module without an export list" $
      listed "module A where\nf (x) = x" `shouldBe` False
  describe "exportedTypes" $ do
    it "lists the exported types that the module declares" $
      exportedTypes
        (tokenise "module A (T (..), U, f, V) where\ndata T = U\ntype V = Int\ndata W = W\n")
        `shouldBe` ["T", "V"]

  describe "definitions" $ do
    it "counts the lines of all equations, with their where clauses" $
      sizes ["f :: Int -> Int", "f 0 = 1", "f n =", "  g n", "  where", "    g = id"]
        `shouldBe` [("f", 5)]
    it "counts neither comments nor blank lines nor signatures" $
      sizes ["-- | Twice.", "f :: Int -> Int", "f n =", "", "  -- why", "  n + n"]
        `shouldBe` [("f", 2)]
    it "ignores types, instances and imports" $
      sizes
        ["import A", "data T = T {a :: Int}", "instance Show T where", "  show _ = \"=\"", "x = 1"]
        `shouldBe` [("x", 1)]
    it "counts the parameters of a signature" $
      map parameters (definitions "f :: Ord a => a -> (b -> c) -> [d -> e] -> f\nf a b c = d\n")
        `shouldBe` [3]
    it "reads signatures over several lines" $
      map parameters (definitions "f ::\n  a ->\n  -- | why\n  b ->\n  c\nf = g\n") `shouldBe` [2]
  where
    importsOf = imports . tokenise . Text.unlines
    listed = listsExports . tokenise
    sizes source = [(name d, extent d) | d <- definitions (Text.unlines source)]
