-- | Every example on every machine: its tape is proven, or the program is refused with a region and
-- a reason.
--
-- The outcomes are in @examples/expected/NAME.machines@. With PARTC_RECORD set, the files are
-- written.
module MachinesSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Result (Result (..))
import Base.Result qualified as Result
import Compile (Compiled (..), Punched (..))
import Compile qualified
import Control.Monad (forM_)
import Data.List (dropWhileEnd, nub, sort)
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (expected, readText)
import Frame.Frame (Frame (motion), FrameMotion (..), FrameProgram)
import Frame.Frame qualified as Frame
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Machines qualified
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (Report, ReportCode (..), ReportPlace (..))
import Report.Report qualified as Report
import Surface.Import qualified as Import
import System.Directory (listDirectory)
import System.FilePath (dropExtension, takeExtension, (<.>), (</>))
import Tape.Punch qualified as Tape
import Tape.RowMeaning qualified as RowMeaning
import Tape.Tape (Tape)
import Tape.Tape qualified as Tape
import Test.Hspec
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  everywhere
  it "the shaft of the course begins as the course prints it" $ do
    loaded <- LoadedProgram.fromText "shaft.part" <$> readText "examples/shaft.part"
    case Result.ifSound (Compile.compile (Machines.jobForOwnOr Machines.lkp01f [] loaded) loaded) of
      Just [Compiled {machine, punched = Punched {program}}] ->
        map (symbolsOf (Tape.rows machine (Frame.start program) (framesOf program))) [1, 2]
          `shouldBe` ["9Д56000П27Ш08Н", "7Е64200П32Н"]
      _ -> expectationFailure "the shaft is not compiled"
  where
    -- The symbols of a frame, up to its last Н.
    symbolsOf rows n =
      dropWhileEnd
        (/= 'Н')
        (mapMaybe RowMeaning.symbol [r | r <- rows, RowMeaning.frame r == Just n])

-- | Every example, compiled for every built-in machine.
everywhere :: Spec
everywhere = describe "every example on every machine" $ do
  files <-
    runIO
      (sort . filter ((`elem` [".part", ".sheet"]) . takeExtension) <$> listDirectory "examples")
  forM_ files $ \file -> it file $ do
    text <- readText ("examples" </> file)
    loaded <- LoadedProgram.load (Import.byName (fmap Right . readText)) ("examples" </> file) text
    outcomes <- traverse (outcomeOn loaded) Machines.known
    expected
      ("examples/expected" </> dropExtension file <.> "machines")
      ( Text.unlines
          [ n <> ": " <> o
            | (m, o) <- zip Machines.known outcomes,
              let MachineName n = Machine.name m
          ]
      )

-- | The outcome in one line: the size of the tape and the warnings, or the errors.
outcomeOn :: LoadedProgram -> Machine -> IO Text
outcomeOn loaded target = do
  let outcome = Compile.compile (Machines.jobFor target []) loaded
  case Result.ifSound outcome of
    Just [Compiled {machine, punched = Punched {program, tape}, proof}] -> do
      -- The compiler reads a tape back with its frames at hand; this reads the rows alone.
      Tape.read machine (Frame.start program) tape `shouldBe` Right (framesOf program)
      fmap Proof.findings proof `shouldBe` Just []
      pure
        ( counts (framesOf program) tape
            <> Text.concat [", " <> c | c <- nub (map codeWord (warnings outcome))]
        )
    _ -> do
      [Report.title r | r <- errors outcome, not (isPlaced r)] `shouldBe` []
      pure ("refused: " <> Text.intercalate ", " (nub (map codeWord (errors outcome))))

framesOf :: FrameProgram -> [Frame]
framesOf = map Frame.frame . Frame.plannedFrames

-- | Counts in words: of the frames of a tape, of the arcs among them, and of its rows.
counts :: [Frame] -> Tape -> Text
counts frames tape =
  Text.intercalate
    ", "
    [ Decimal.whole (length frames) <> " frames",
      Decimal.whole (length [() | Circular _ <- map motion frames]) <> " arcs",
      Decimal.whole (Tape.rowCount tape) <> " rows"
    ]

codeWord :: Report -> Text
codeWord r = let ReportCode c = Report.code r in c

-- | Does a report point at a region of the program?
isPlaced :: Report -> Bool
isPlaced r = case Report.place r of
  InSource _ -> True
  InTape _ -> False
  InFile -> False
  InCommandLine -> False
