-- | The symbols of a program.
module Query.SymbolSpec (spec) where

import Base.Region (Region (..))
import Data.Text (Text)
import Files (readText)
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot qualified as Snapshot
import Query.Symbol (DocumentSymbol (..), SymbolKind (..))
import Query.Symbol qualified as Symbol
import Test.Hspec

spec :: Spec
spec = do
  it "lists the definitions and the machining statements of a program" $ do
    text <- readText "examples/flange.part"
    [(kind s, name s, detail s) | s <- outline text]
      `shouldBe` [ (Part', "flange", "Фланец, Урал-1, фиг. 2"),
                   (Value, "c", ""),
                   (Function, "lug", "(a)"),
                   (Function, "boss", "(a)"),
                   (Contour', "outline", ""),
                   (Machining, "mill outline outside", "")
                 ]
  it "lists a definition with a syntax error" $
    map name (outline "part p\nlet a = (1,\nlet b = 2\n") `shouldBe` ["p", "a", "b"]
  it "every name lies within its statement" $ do
    text <- readText "examples/flange.part"
    let isWithin s =
          let Region from to = selection s
           in start (whole s) <= from && to <= end (whole s)
    filter (not . isWithin) (outline text) `shouldBe` []

-- | The symbols of a program.
outline :: Text -> [DocumentSymbol]
outline text =
  Symbol.symbols (Snapshot.take (Snapshot.checkWith []) (LoadedProgram.fromText "a.part" text))
