-- | References, and the renaming of names.
module Query.RenameSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Base.Result (Result (..))
import Compile qualified
import Control.Monad (forM_)
import Data.Either (isLeft)
import Data.List (find, sort)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Files (filesBelow, readText)
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Project.Job qualified as Job
import Project.LoadedProgram qualified as LoadedProgram
import Query.Marked (marked)
import Query.Mention qualified as Mention
import Query.Reference qualified as Reference
import Query.Rename qualified as Rename
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Surface.Import qualified as Import
import System.FilePath (takeExtension)
import Test.Hspec

spec :: Spec
spec = do
  describe "references" $ do
    it "are the definition and all uses of a name" $
      placesAt "let a = 1\nlet b = ^a + a\nlet f(a) = a\n" `shouldBe` [(4, 5), (18, 19), (22, 23)]
    it "of a parameter are inside its function" $
      placesAt "let a = 1\nlet f(a) = ^a\n" `shouldBe` [(16, 17), (21, 22)]
    it "of a column are in the heading and in the ciphers" $
      length (placesAt (columns "^mu")) `shouldBe` 2
    it "of a function of the language are all its calls" $
      length (placesAt "let a = ^sqrt(4)\nlet b = sqrt(9)\n") `shouldBe` 2
  describe "renaming" $ do
    it "is refused for names of the language and where there is no name" $ do
      prepared "let a = ^sqrt(4)\n" `shouldBe` Left "‘sqrt’ belongs to the language"
      prepared "let a = ^4\n" `shouldBe` Left "there is no name here"
      prepared "table t {\n  ^x y\n  0 0\n}\n" `shouldBe` Left "‘x’ belongs to the language"
    it "is refused for words that cannot be names" $ do
      renamed "mill" "let ^a = 4\n" `shouldBe` Left "‘mill’ is a word of the language"
      renamed "sqrt" "let ^a = 4\n" `shouldBe` Left "‘sqrt’ belongs to the language"
      renamed "a b" "let ^a = 4\n" `shouldSatisfy` isLeft
      renamed "1a" "let ^a = 4\n" `shouldSatisfy` isLeft
      renamed "" "let ^a = 4\n" `shouldSatisfy` isLeft
    it "is refused for a name that is taken" $ do
      renamed "b" "let ^a = 4\nlet b = 5\n" `shouldBe` Left "‘b’ is taken: see a.part, line 2"
      renamed "b" "let b = 4\nlet f(^a) = a + b\n" `shouldSatisfy` isLeft
      renamed "x" "let f(x) = x\nlet ^a = 4\nlet c = [a + x for x in [1, 2]]\n"
        `shouldSatisfy` isLeft
    it "may use a name that is known only elsewhere" $
      renamed "x" "let f(x) = x\nlet ^a = 4\n" `shouldBe` Right "let f(x) = x\nlet x = 4\n"
    it "is refused if the name also occurs in a statement with a mistake" $
      renamed "c" "let ^a = 4\nlet b = (a,\nlet d = a\n" `shouldSatisfy` isLeft
    it "changes the heading of a column and the ciphers" $
      renamed "bevel_1" (columns "^mu")
        `shouldBe` Right (Text.replace "mu" "bevel_1" (columns "mu"))
  describe "renaming in the examples" $ do
    files <- runIO (sort . filter ((== ".part") . takeExtension) <$> filesBelow "examples")
    forM_ files $ \file ->
      it ("keeps the frames of " <> file <> ", and back again its text") $ do
        snapshot <- loaded file
        let offsets = renamable snapshot
        forM_ offsets $ \at -> do
          let there = applied snapshot at fresh
              back = applied there (offsetOf fresh there) (wordAt snapshot at)
          framesOf there `shouldBe` framesOf snapshot
          Region.files (Snapshot.source back) `shouldBe` Region.files (Snapshot.source snapshot)

-- | A name that no program has.
fresh :: Text
fresh = "новое_имя_1"

-- | The snapshot of a file with its imports.
loaded :: FilePath -> IO Snapshot
loaded file = do
  text <- readText file
  Snapshot.take (Snapshot.checkWith []) <$> LoadedProgram.load reader file text
  where
    reader = Import.byName (fmap Right . readText)

-- | One offset for each name of the program's own text that can be renamed.
renamable :: Snapshot -> [Int]
renamable snapshot =
  [ start (Mention.place m)
    | m : _ <- Map.elems (Map.fromListWith (flip (<>)) [(Mention.definition m, [m]) | m <- own])
  ]
  where
    own =
      [ m
        | m <- Mention.mentions (Snapshot.facts snapshot),
          start (Mention.place m) < Text.length (Region.text (Snapshot.source snapshot)),
          Just _ <- [Mention.definition m]
      ]

-- | The snapshot after a renaming.
applied :: Snapshot -> Int -> Text -> Snapshot
applied snapshot at new = case Rename.rename snapshot at new of
  Left why -> error (Text.unpack why)
  Right regions -> case Rename.applied snapshot regions new of
    (_, own) : others ->
      Snapshot.take (Snapshot.checkWith []) (Snapshot.reloaded snapshot others own)
    [] -> error "no file"

-- | The frames of a program for its own machine, without the regions that they come from.
framesOf :: Snapshot -> [[Frame]]
framesOf snapshot =
  [ map Frame.frame (Frame.plannedFrames frames)
    | Just (_, made) <- [output (Compile.checkedFrames (Job.forOwnMachine [] program) program)],
      (_, frames) <- made
  ]
  where
    program = Snapshot.reloaded snapshot [] (Region.text (Snapshot.source snapshot))

-- | The text of the mention at an offset.
wordAt :: Snapshot -> Int -> Text
wordAt snapshot at =
  maybe "" Mention.word (find isThere (Mention.mentions (Snapshot.facts snapshot)))
  where
    isThere m = start (Mention.place m) == at

-- | The offset of a word in the text of a program.
offsetOf :: Text -> Snapshot -> Int
offsetOf word = Text.length . fst . Text.breakOn word . Region.text . Snapshot.source

-- | A program with a piece; the argument is the name of its column of bevels.
columns :: Text -> Text
columns name =
  "table t {\n  x y " <> name <> " deg H\n  0 0 5 9\n  9 0 6 9\n}\ncurve k = polyline(t)\n"
    <> "piece w = k cipher 4("
    <> Text.replace "^" "" name
    <> ", H) left\n"

placesAt :: Text -> [(Int, Int)]
placesAt text =
  let (now, at) = marked text
   in [ (start r, end r)
        | r <- maybe [] Reference.places (Reference.references now Nothing at)
      ]

prepared :: Text -> Either Text Text
prepared text = let (now, at) = marked text in snd <$> Rename.prepare now at

-- | The text after a renaming.
renamed :: Text -> Text -> Either Text Text
renamed new text =
  let (now, at) = marked text
   in (\regions -> Text.concat (map snd (take 1 (Rename.applied now regions new))))
        <$> Rename.rename now at new
