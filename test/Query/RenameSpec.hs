-- | References, and the renaming of names.
module Query.RenameSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Base.Result (Result (..))
import Compile qualified
import Control.Monad (forM_)
import Data.ByteString qualified as ByteString
import Data.Either (isLeft)
import Data.Functor.Identity (runIdentity)
import Data.List (find, sort)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (filesBelow, readText)
import Font.TrueType qualified as TrueType
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Project.Job qualified as Job
import Project.LoadedProgram qualified as LoadedProgram
import Query.Marked (header, marked, unmarked)
import Query.Mention qualified as Mention
import Query.Reference qualified as Reference
import Query.Rename qualified as Rename
import Query.SharedFile (FileMentions (..), OpenProgram (..), SharedFile (path))
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
  describe "references in several programs" $ do
    it "are those in all programs that import the file" $
      mentionsOf (0, "let ^pin") [library, importing, further]
        `shouldBe` Just [("lib.part", 2), ("a.part", 1), ("b.part", 1)]
    it "are found from a program that imports the file" $
      mentionsOf (1, "= ^pin") [library, importing, further]
        `shouldBe` Just [("a.part", 1), ("lib.part", 2), ("b.part", 1)]
    it "contain the machining of imported files that are not open" $
      mentionsWith [("k.part", machined)] (0, "mill ^k") [("a.part", milling)]
        `shouldBe` Just [("a.part", 1), ("k.part", 2)]
    it "leave out programs with another definition of the name" $
      mentionsOf (0, "let ^pin") [library, ("c.part", "part c\nlet pin = 5\n")]
        `shouldBe` Just [("lib.part", 2)]
  describe "renaming in several programs" $ do
    it "changes all programs that import the file, directly or not" $
      renamedIn (0, "let ^pin") "bolt" [library, importing, further]
        `shouldBe` Right (map bolted [library, importing, further])
    it "is the same from a program that imports the file" $
      fmap sort (renamedIn (2, "= ^pin") "bolt" [library, importing, further])
        `shouldBe` Right (sort (map bolted [library, importing, further]))
    it "leaves out programs with another definition of the name" $
      renamedIn (0, "let ^pin") "bolt" [library, ("c.part", "part c\nlet pin = 5\n")]
        `shouldBe` Right [bolted library]
    it "is refused for a name that is taken in a program that imports the file" $
      renamedIn (0, "let ^pin") "bolt" [library, ("a.part", importer <> "let bolt = 2 mm\n")]
        `shouldBe` Left "‘bolt’ is taken: see a.part, line 4"
    it "is refused if a program that imports the file would use the new name for another thing" $
      renamedIn (0, "let ^pin") "r" [library, ("a.part", importer <> "let f(r) = r + pin\n")]
        `shouldSatisfy` isLeft
    it "is refused if the name occurs where an importing program has a mistake" $
      renamedIn (0, "let ^pin") "bolt" [library, ("a.part", importer <> "let b = (pin,\n")]
        `shouldBe` Left "‘pin’ also occurs where a.part has a mistake; correct this first"
    it "is refused if an importing program is not analysed" $ do
      let (now, others) = programsAt (0, "let ^pin") [library, importing]
          unanalysed = [o {isAnalysed = False, present = blank (present o)} | o <- others]
          blank s = Snapshot.unanalysed (Region.fromText "a.part" (Region.text (Snapshot.source s)))
      uncurry (Rename.rename unanalysed) now "bolt"
        `shouldBe` Left "‘pin’ also occurs in a.part, which is not analysed yet"
    it "is refused if an importing program was analysed with another text of the file" $ do
      let (now, _) = programsAt (0, "let ^pin") [library]
          stale = lookIn [fmap (<> "-- more\n") library] importing
      uncurry (Rename.rename [OpenProgram stale True Nothing]) now "bolt"
        `shouldBe` Left "the present text of lib.part is not analysed yet"
    it "changes the machining of imported files that are not open" $
      renamedWith [("k.part", machined)] (0, "mill ^k") "q" [("a.part", milling)]
        `shouldBe` Right
          [ ("a.part", Text.replace "mill k" "mill q" milling),
            ("k.part", Text.replace "r k" "r q" (Text.replace "mill k" "mill q" machined))
          ]
  describe "renaming in the examples, with a drawing and with letters of a font" $ do
    files <- runIO (sort . filter ((== ".part") . takeExtension) <$> filesBelow "examples")
    -- The glyphs of the last program come from the snapshot, which reads no font.
    let others = ["test/programs/drawing/good/path.part", "test/programs/font/good/areas.part"]
    forM_ (files <> others) $ \file ->
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
    reader =
      (Import.byName (fmap Right . readText))
        { Import.glyphs = \font written ->
            Right <$> (ByteString.readFile font >>= (`TrueType.glyphs` written))
        }

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
applied snapshot at new = case Rename.rename [] snapshot at new of
  Left why -> error (Text.unpack why)
  Right edited ->
    let texts = textsAfter edited new
        own = Region.text (Snapshot.source snapshot)
        main = Region.mainFile (Snapshot.source snapshot)
     in Snapshot.take
          (Snapshot.checkWith [])
          (Snapshot.reloaded snapshot texts (fromMaybe own (lookup main texts)))

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
   in (\edited -> Text.concat (map snd (textsAfter edited new))) <$> Rename.rename [] now at new

-- | The paths and the texts of files after a renaming.
textsAfter :: [FileMentions] -> Text -> [(Text, Text)]
textsAfter edited new = [(path f, text) | (f, text) <- Rename.applied edited new]

-- | A library, a program that imports it, and a program that imports it through that program.
library, importing, further :: (Text, Text)
library = ("lib.part", "let pin = 3 mm\nlet two = 2 * pin\n")
importing = ("a.part", importer)
further = ("b.part", "part b\nimport \"a.part\"\nlet c = pin\n")

importer :: Text
importer = "part a\nimport \"lib.part\"\nlet b = pin\n"

-- | A file with a contour that it mills, and a program that mills it, too.
machined, milling :: Text
machined = "contour k closed {\n  ccw circle((0, 0), 30)\n}\nmill k inside {\n}\n"
milling = header <> "import \"k.part\"\nmill k inside {\n}\n"

-- | A file in which the name of a pin is replaced.
bolted :: (Text, Text) -> (Text, Text)
bolted = fmap (Text.replace "pin" "bolt")

-- | The snapshot of a program that may import the given files.
lookIn :: [(Text, Text)] -> (Text, Text) -> Snapshot
lookIn files (path', text) =
  Snapshot.take
    (Snapshot.checkWith [])
    (runIdentity (LoadedProgram.load (Import.byName reader) (Text.unpack path') text))
  where
    reader file = pure (maybe (Left "missing") Right (lookup (Text.pack file) files))

-- | The open programs with these paths and texts: the one with the given index, with the offset of
-- the mark in the given piece of its text, and the others. They may import each other and the given
-- further files.
programsWith ::
  [(Text, Text)] ->
  (Int, Text) ->
  [(Text, Text)] ->
  ((Snapshot, Int), [OpenProgram])
programsWith closed (index, piece) opened =
  ( (asked, Text.length (fst (Text.breakOn (unmarked piece) (snd (opened !! index)))) + mark),
    [OpenProgram s True Nothing | (n, s) <- zip [0 ..] snapshots, n /= index]
  )
  where
    snapshots = map (lookIn (opened <> closed)) opened
    asked = snapshots !! index
    mark = Text.length (fst (Text.breakOn "^" piece))

programsAt :: (Int, Text) -> [(Text, Text)] -> ((Snapshot, Int), [OpenProgram])
programsAt = programsWith []

-- | The count of mentions in each file.
mentionsOf :: (Int, Text) -> [(Text, Text)] -> Maybe [(Text, Int)]
mentionsOf = mentionsWith []

mentionsWith :: [(Text, Text)] -> (Int, Text) -> [(Text, Text)] -> Maybe [(Text, Int)]
mentionsWith closed at' opened =
  let ((now, at), others) = programsWith closed at' opened
   in map (\ms -> (path (mentionsIn ms), length (regions ms))) . Reference.mentions
        <$> Reference.sharedReferences others now Nothing at

-- | The paths and the texts of the changed files.
renamedIn :: (Int, Text) -> Text -> [(Text, Text)] -> Either Text [(Text, Text)]
renamedIn = renamedWith []

renamedWith ::
  [(Text, Text)] ->
  (Int, Text) ->
  Text ->
  [(Text, Text)] ->
  Either Text [(Text, Text)]
renamedWith closed at' new opened =
  let ((now, at), others) = programsWith closed at' opened
   in (`textsAfter` new) <$> Rename.rename others now at new
