-- | Every example on every machine: proven, or refused with a place and a reason.
--
-- The outcomes are kept in @examples/expected/NAME.machines@. With PARTC_RECORD set they are
-- written anew.
module MachinesSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Result (Result (..))
import Base.Result qualified as Result
import Compile (Analysis (..), Punched (..))
import Compile qualified
import Control.Monad (forM, forM_)
import Data.List (dropWhileEnd, nub, sort)
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (expected, readText)
import Frame.Frame (Frame (motion), FrameMotion (..))
import Frame.Frame qualified as Frame
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Machines qualified
import Report.Report (Report, ReportCode (..), ReportPlace (..))
import Report.Report qualified as Report
import Surface.Import qualified as Import
import System.Directory (listDirectory)
import System.FilePath (dropExtension, takeExtension, (<.>), (</>))
import Tape.Punch qualified as Tape
import Tape.RowMeaning qualified as RowMeaning
import Tape.Tape qualified as Tape
import Test.Hspec

spec :: Spec
spec = do
  everywhere
  it "the shaft of the course begins as the course prints it" $ do
    text <- readText "examples/shaft.part"
    let loaded = Compile.alone "shaft.part" text
    case Result.settled
      ( Compile.analyse [] loaded `Result.thenSound` \a ->
          let m =
                Machines.ownOr Machines.lkp01f loaded a
           in Compile.punch m (path a) `Result.thenSound` \p ->
                pure
                  ( Tape.rows
                      m
                      (Frame.start (program p))
                      (map Frame.frame (Frame.planned (program p)))
                  )
      ) of
      Nothing -> expectationFailure "the shaft is not compiled"
      Just rows ->
        [ dropWhileEnd
            (/= 'Н')
            (mapMaybe RowMeaning.symbol [r | r <- rows, RowMeaning.frame r == Just n])
          | n <- [1, 2]
        ]
          `shouldBe` ["9Д56000П27Ш08Н", "7Е64200П32Н"]

everywhere :: Spec
everywhere = describe "every example on every machine" $ do
  files <-
    runIO
      (sort . filter ((`elem` [".part", ".sheet"]) . takeExtension) <$> listDirectory "examples")
  forM_ files $ \file -> it file $ do
    text <- readText ("examples" </> file)
    loaded <- Compile.load (Import.byName (fmap Right . readText)) ("examples" </> file) text
    outcomes <- forM Machines.known $ \machine -> do
      let outcome =
            Compile.analyse [] loaded `Result.thenSound` \a ->
              let m =
                    Compile.onMachine (path a) machine
               in Compile.punch m (path a) `Result.thenSound` \p -> pure (a, m, p)
      case Result.settled outcome of
        Nothing -> do
          [Report.title r | r <- errors outcome, not (isPlaced r)] `shouldBe` []
          pure ("refused: " <> Text.intercalate ", " (nub (map codeWord (errors outcome))))
        Just (a, m, p) -> do
          fs <- case Result.settled (Compile.readTape m (Frame.start (program p)) (tape p)) of
            Just fs -> pure fs
            Nothing -> fail "the tape cannot be read"
          fs `shouldBe` map Frame.frame (Frame.planned (program p))
          map Report.title (errors (Compile.prove m (path a) (program p) fs)) `shouldBe` []
          pure (counts m p <> Text.concat [", " <> c | c <- nub (map codeWord (warnings outcome))])
    expected
      ("examples/expected" </> dropExtension file <.> "machines")
      ( Text.unlines
          [ n <> ": " <> o
            | (m, o) <- zip Machines.known outcomes,
              let MachineName n = Machine.name m
          ]
      )

-- | Frames, arcs among them, rows.
counts :: Machine -> Punched -> Text
counts _ p =
  Text.intercalate
    ", "
    [ Decimal.whole (length fs) <> " frames",
      Decimal.whole (length [() | Round _ <- map motion fs]) <> " arcs",
      Decimal.whole (Tape.rowCount (tape p)) <> " rows"
    ]
  where
    fs = map Frame.frame (Frame.planned (program p))

codeWord :: Report -> Text
codeWord r = let ReportCode c = Report.code r in c

isPlaced :: Report -> Bool
isPlaced r = case Report.place r of
  InSource _ -> True
  InTape _ -> False
  InFile -> False
