-- | The rules on the form of the code, tested on made-up sources.
module FormSpec
  ( spec,
  )
where

import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Form
import Test.Hspec

spec :: Spec
spec = do
  describe "problems" $ do
    it "passes a file that keeps the rules" $
      found "src/Base/Name.hs" ["module Base.Name (f) where", "f :: Int -> Int", "f = id"]
        `shouldBe` []
    it "notices a line of 101 columns, in tests too" $ do
      found "test/NameSpec.hs" [Text.replicate 100 "x"] `shouldBe` []
      found "test/NameSpec.hs" ["", Text.replicate 101 "x"] `shouldBe` [WideLine 2 101]
    it "notices a comment that begins with what, whether, how, where or of" $ do
      found "src/Base/Name.hs" ["-- | Count of names.", "-- Where they are, is not said."]
        `shouldBe` []
      found "src/Base/Name.hs" ["f = id", "  where", "    -- Where names are.", "    g = id"]
        `shouldBe` [VagueComment 3 "Where"]
      found "test/NameSpec.hs" ["-- | What a name is.", "f = id"] `shouldBe` [VagueComment 1 "What"]
    it "notices a module of 601 lines" $ do
      found "src/Base/Name.hs" (replicate 600 "--") `shouldBe` []
      found "src/Base/Name.hs" (replicate 601 "--") `shouldBe` [LongModule 601]
    it "notices a function of 41 lines" $ do
      found "src/Base/Name.hs" (function 40) `shouldBe` []
      found "src/Base/Name.hs" (function 41) `shouldBe` [LongFunction "Base.Name.f" 41]
    it "notices a function of seven parameters" $
      found "src/Base/Name.hs" ["f :: a -> b -> c -> d -> e -> f -> g -> h", "f = g"]
        `shouldBe` [ManyParameters "Base.Name.f" 7]
    it "allows a function in the list of exceptions, and notices a needless entry" $ do
      let listed = none {long = Map.fromList [("Base.Name.f", "a table")]}
      problems listed (Source "src/Base/Name.hs" (Text.unlines (function 41))) `shouldBe` []
      problems listed (Source "src/Base/Name.hs" (Text.unlines (function 40)))
        `shouldBe` [NeedlessException "Base.Name.f"]
    it "notices a tuning pragma where machining is decided, and allows it in the kernel" $ do
      let tuned = ["{-# OPTIONS_GHC -O2 #-}"]
      found "src/Toolpath/FromPart.hs" tuned `shouldBe` [Tuned "-O2"]
      found "src/Offset/Kernel.hs" tuned `shouldBe` []
      found "src/Tape/FrameReader/Fast.hs" tuned `shouldBe` []

  describe "sharedTypes" $ do
    it "notices two exported types of one name" $
      sharedTypes none [exporting "A", exporting "B"] `shouldBe` [("T", ["A", "B"])]
    it "allows a group in the list of exceptions, but no further module" $ do
      let listed = none {shared = [("T", ["A", "B"], "the same at two stages")]}
      sharedTypes listed [exporting "A", exporting "B"] `shouldBe` []
      sharedTypes listed [exporting "A", exporting "B", exporting "C"]
        `shouldBe` [("T", ["A", "B", "C"])]
    it "ignores types that are not exported" $
      sharedTypes none [exporting "A", Source "src/B.hs" "module B (f) where\ndata T = T\n"]
        `shouldBe` []
  where
    found path = problems none . Source path . Text.unlines
    function count = "f =" : replicate (count - 1) "  x"
    none = Exceptions {long = Map.empty, wide = Map.empty, shared = []}

-- | A module that exports a type T.
exporting :: Text -> Source
exporting name =
  Source
    ("src/" <> Text.unpack name <> ".hs")
    ("module " <> name <> " (T (..)) where\ndata T = T\n")
