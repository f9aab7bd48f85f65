-- | The counts of frames that an editor shows, compared with the tape.
module Query.MachiningSpec (spec) where

import Base.Crash (bug)
import Base.LazyList qualified as LazyList
import Base.Region (Region)
import Base.Region qualified as Region
import Base.Result qualified as Result
import Compile (Compiled (..), Punched (..))
import Compile qualified
import Control.Applicative (liftA2)
import Control.Monad (forM_)
import Data.Map.Strict qualified as Map
import Data.Text qualified as Text
import Files (readText)
import Frame.Frame (PlannedFrame, Role (..))
import Frame.Frame qualified as Frame
import Project.Job qualified as Job
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Query.CodeLens qualified as CodeLens
import Query.Machining qualified as Machining
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Surface.Import qualified as Import
import Tape.Punch qualified as Tape
import Test.Hspec

spec :: Spec
spec =
  forM_ ["examples/holes.part", "examples/spacer.part", "examples/tray.part"] $ \file ->
    describe file $ do
      loaded <- runIO (load file)
      let snapshot = Snapshot.take (Snapshot.checkWith []) loaded
          Compiled {machine, punched} = compiled loaded
          planned = Frame.plannedFrames (program punched)
      it "has as many frames in the lens on ‘part’ as its tape" $ do
        let onTape = Tape.readInTurn machine (Frame.start (program punched)) (tape punched)
        take 1 (framesInLenses snapshot) `shouldBe` [length (LazyList.toList onTape)]
      it "has all frames of machining in the lenses on its statements" $
        sum (drop 1 (framesInLenses snapshot))
          `shouldBe` length (filter (isMachining . Frame.role) planned)
      it "has the frames of each drilling in its lens" $
        drillFrames snapshot `shouldBe` plannedDrillFrames snapshot planned

load :: FilePath -> IO LoadedProgram
load file = readText file >>= LoadedProgram.load (Import.byName (fmap Right . readText)) file

-- | The tape for the machine that the program names.
compiled :: LoadedProgram -> Compiled
compiled loaded = case Result.ifSound (Compile.compile (Job.forOwnMachine [] loaded) loaded) of
  Just [c] -> c
  _ -> bug "the example has no tape"

-- | The counts of frames in the lenses of a program, from the first lens to the last.
framesInLenses :: Snapshot -> [Int]
framesInLenses snapshot =
  [ read (Text.unpack n)
    | lens <- CodeLens.codeLenses snapshot Nothing,
      n : "frames" : _ <- map Text.words (Text.splitOn " · " (CodeLens.title lens))
  ]

-- | True for frames of machining statements.
isMachining :: Role -> Bool
isMachining = \case
  Approaching _ -> True
  Cutting _ -> True
  Retracting _ -> True
  Drilling _ -> True
  Carving _ -> True
  Linking -> False
  Commanding -> False

-- | The lines of the drilling statements, and the counts of their frames in the summaries.
drillFrames :: Snapshot -> [(Int, Maybe Int)]
drillFrames snapshot =
  [ (lineOf snapshot (Machining.statement s), Machining.ownFrames s)
    | m <- Snapshot.machines snapshot,
      s <- Machining.work m,
      Machining.passes s == 0
  ]

-- | The lines of the drilling statements, and the counts of the planned frames for which each line
-- asks.
plannedDrillFrames :: Snapshot -> [PlannedFrame] -> [(Int, Maybe Int)]
plannedDrillFrames snapshot planned =
  Map.toList
    ( Map.fromListWith
        (liftA2 (+))
        [ (lineOf snapshot (Frame.origin f), Just 1)
          | f@Frame.PlannedFrame {Frame.role = Drilling _} <- planned
        ]
    )

-- | The line of a region's beginning.
lineOf :: Snapshot -> Region -> Int
lineOf snapshot = Region.line . Region.position (Snapshot.source snapshot) . Region.start
