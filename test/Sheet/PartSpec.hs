-- | Laws of the conversions between input sheets, part programs and parts.
module Sheet.PartSpec (spec) where

import Base.Result (Result (..))
import Base.Result qualified as Result
import Compile (Analysis (..), Punched (..))
import Compile qualified
import Control.Exception (evaluate)
import Control.Monad (forM_)
import Data.ByteString qualified as ByteString
import Data.Either (fromLeft)
import Data.List (sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (expected, filesBelow, readText)
import Generate.Sheet qualified as Generate
import Machines (lkp01f)
import Project.LoadedProgram qualified as LoadedProgram
import Report.Human qualified as Human
import Report.Report (Report, ReportCode (..))
import Report.Report qualified as Report
import Sheet.Error (Error)
import Sheet.Error qualified as Error
import Sheet.FromPart qualified as FromPart
import Sheet.FromText qualified as FromText
import Sheet.Sheet (Sheet)
import Sheet.ToSurface qualified as ToSurface
import Sheet.ToText qualified as ToText
import Sheet.Unsupported qualified as Unsupported
import System.Directory (listDirectory)
import System.FilePath (takeExtension, (-<.>), (</>))
import Tape.Tape (Tape (..))
import Test.Hspec hiding (after, before)
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck hiding (Result (..), again)

spec :: Spec
spec = do
  rib <- runIO (readText "examples/spar.sheet")
  describe "a sheet with one number changed" $ do
    -- Catches a missing or doubled number that is not noticed, and a crash.
    forM_
      [ ("the number is left out", const []),
        ("the number is doubled", \w -> [w, w]),
        ("the number is an end mark", const ["-0"])
      ]
      $ \(what, change) ->
        it ("is refused, or is another sheet without mistakes: " <> what) $
          forM_ (variants change (Text.words rib)) $ \(n, text) -> do
            result <- judged "x.sheet" text
            case result of
              Right _ -> (n, meaning text) `shouldNotBe` (n, meaning rib)
              Left codes -> (n, codes) `shouldSatisfy` (not . null . snd)
    it "is refused with the report for the control stop of the Minsk-22 if it is left out" $ do
      let left = variants (const []) (Text.words rib)
          codesOf (n, text) = (n, fromLeft [] (fromTextCodes text))
          stops code = sort [n | (n, [c]) <- map codesOf left, c == ReportCode code]
      -- Any of the eight numbers of the approach.
      [n | n <- [17 .. 24], n `notElem` stops "E0904"] `shouldBe` []
      -- Any number of the first piece but its cipher, and of the second piece's points.
      [n | n <- [27 .. 45] <> [51 .. 54], n `notElem` stops "E0907"] `shouldBe` []
      -- Any of the twelve numbers of the retract but the last one.
      [n | n <- [59 .. 70], n `notElem` stops "E0905"] `shouldBe` []
  describe "a part as a sheet" $ do
    -- Catches a number that the part loses, and a sign or a side that is swapped.
    modifyMaxSuccess (const 30) . prop "has the numbers of the sheet from which the part is made" $
      forAll Generate.cut $ \s ->
        let text = ToText.write s
         in counterexample (Text.unpack text) $
              classify (not (null (fst (exported "x.sheet" text)))) "without a part" $
                case exported "x.sheet" text of
                  ([], again) -> again === Just text
                  (codes, _) ->
                    counterexample
                      (show codes)
                      ( all
                          (`notElem` codes)
                          [ ReportCode "E0921",
                            ReportCode "E0922",
                            ReportCode "E0923",
                            ReportCode "E0924",
                            ReportCode "E0925",
                            ReportCode "E0926",
                            ReportCode "E0927"
                          ]
                      )
    -- Catches a program whose text differs from the sheet in meaning.
    modifyMaxSuccess (const 10) . prop "has the tape of the program and of the first sheet" $
      forAll Generate.cut $ \s ->
        let text = ToText.write s
            program = ToSurface.text s
         in counterexample (Text.unpack program) $
              ioProperty $ do
                a <- judged "x.sheet" text
                b <- judged "x.part" program
                c <- case exported "x.part" program of
                  ([], Just again) -> judged "x.sheet" again
                  _ -> pure a
                pure (a === b .&&. a === c)
    it "is the example sheet, character by character, if the part is made from it" $
      exported "x.sheet" rib `shouldBe` ([], Just rib)
    it "is the same sheet for every good sheet, and its program has the same tape" $ do
      sheets <- filter ((== ".sheet") . takeExtension) <$> filesBelow "test/programs/sheet/good"
      forM_ sheets $ \file -> do
        text <- readText file
        (file, exported "x.sheet" text) `shouldBe` (file, ([], meaning text))
        tape' <- judged "x.sheet" text
        again <-
          traverse
            (judged "x.part" . ToSurface.text)
            (output (FromText.read text :: Result () Error Sheet))
        again `shouldBe` Just tape'
    it
      "is refused if a blade does not swivel by the spline through the cipher's bevels (catches a \
      \check that accepts any bevel between those of the points)"
      $ do
        blade <- readText "test/programs/sheet/good/blade.sheet"
        let steep = Text.replace "\n50 4 1.5 8\n" "\n20 4 1.5 8\n" blade
            programOf text = ToSurface.text <$> output (FromText.read text :: Result () Error Sheet)
        steep `shouldNotBe` blade
        forM_ [blade, steep] $ \sheet ->
          fmap (exported "x.part") (programOf sheet) `shouldBe` Just ([], meaning sheet)
        forM_ ["bevel 2", "bevel mu / 2", "bevel 1.2 * mu"] $ \other ->
          (other, fmap (fst . exported "x.part" . Text.replace "bevel mu" other) (programOf blade))
            `shouldBe` (other, Just [ReportCode "E0924"])
    it "has a cylinder as its tool for a cone without a bevel" $ do
      program <- readText "test/programs/tool/good/cone-without-bevel.part"
      case exported "x.part" program of
        ([], Just sheet) -> exported "x.sheet" sheet `shouldBe` ([], Just sheet)
        other -> expectationFailure (show other)
  describe "a part that cannot become a sheet is refused" $ do
    files <- runIO (sort . filter ((== ".part") . takeExtension) <$> listDirectory "test/unfit")
    forM_ files $ \file -> it file $ do
      text <- readText ("test/unfit" </> file)
      let loaded = LoadedProgram.fromText (Text.pack file) text
          outcome =
            Compile.evaluate [] loaded
              `Result.thenSound` ( Result.mapErrors id Unsupported.toReport
                                     . uncurry FromPart.fromPart
                                 )
          source = LoadedProgram.source loaded
          rendered r = Human.render Human.Plain (Text.pack file) source r <> "\n"
      errors outcome `shouldNotBe` []
      expected
        (("test/unfit" </> file) -<.> "report")
        (Text.concat (map rendered (Report.sorted (errors outcome))))
  where
    meaning text = fmap ToText.write (output (FromText.read text :: Result () Error Sheet))

-- | The sheet of a text, or the codes of the reports about it.
fromTextCodes :: Text -> Either [ReportCode] Sheet
fromTextCodes text = case FromText.read text :: Result () Error Sheet of
  Result {errors = [], output = Just s} -> Right s
  Result {errors} -> Left (map (Report.code . Error.toReport) errors)

-- | Converts the text of a program or a sheet to a sheet. The path's extension tells which it is.
-- The codes are those of the reports.
exported :: Text -> Text -> ([ReportCode], Maybe Text)
exported path' text = (map Report.code (errors outcome), ToText.write <$> Result.ifSound outcome)
  where
    outcome =
      Compile.evaluate [] (LoadedProgram.fromText path' text)
        `Result.thenSound` (Result.mapErrors id Unsupported.toReport . uncurry FromPart.fromPart) ::
        Result Report Report Sheet

-- | All texts in which one word is changed, each with the number of the word from 1.
variants :: (Text -> [Text]) -> [Text] -> [(Int, Text)]
variants change words' =
  [ (n, Text.unwords (before <> change w <> after))
    | n <- [1 .. length words'],
      (before, w : after) <- [splitAt (n - 1) words'],
      change w /= [w]
  ]

-- | The tape of a program or a sheet, or the codes of its errors. Renders the reports too, so that
-- a crash in their texts is noticed.
judged :: Text -> Text -> IO (Either [ReportCode] Tape)
judged path' text = case Result.ifSound outcome of
  Nothing ->
    Left (map Report.code (errors outcome))
      <$ evaluate (sum (map (Text.length . shown) (errors outcome)))
  Just p -> Right (tape p) <$ evaluate (let Tape bytes = tape p in ByteString.length bytes)
  where
    loaded = LoadedProgram.fromText path' text
    outcome =
      Compile.analyse [] loaded `Result.thenSound` \a ->
        Compile.punch lkp01f (path a) :: Result Report Report Punched
    shown = Human.render Human.Plain path' (LoadedProgram.source loaded)
