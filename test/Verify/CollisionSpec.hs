-- | Contacts of tools with avoided solids and with stock.
module Verify.CollisionSpec (spec) where

import Base.Quantity (LengthUnit (Millimetres))
import Base.Region qualified as Region
import Base.Result qualified as Result
import CaseCount (askedCount)
import Compile (Analysis (Analysis))
import Compile qualified
import Data.List (sort)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Frame.Frame (FrameProgram)
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate.AlteredTape qualified as AlteredTape
import Machine.Machine (Machine (name), MachineName (MachineName))
import Machines qualified
import Project.LoadedProgram qualified as LoadedProgram
import Project.Target qualified as Target
import PythonJudge qualified
import Report.Report qualified as Report
import System.Directory (listDirectory)
import System.FilePath (takeExtension, (</>))
import Test.Hspec
import Test.QuickCheck
import Toolpath.Toolpath (Toolpath)
import Verify.FromTape qualified as Verify
import Verify.Proof (Proof)
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  describe "programs with collisions" $ do
    files <- runIO (sort . filter isProgram <$> listDirectory folder)
    it "are read" $ length files `shouldSatisfy` (>= 8)
    mapM_ collides files
  count <- runIO (askedCount "PARTC_ALTERED")
  it "altered tapes of all machines with heights are refused (catches a proof of contours alone)" $
    withMaxSuccess (max 400 (fromMaybe 0 count)) $
      forAllBlind alteredTape $ \(text, machine, kind, proof) ->
        counterexample (Text.unpack text <> show (name machine) <> kind) $
          tabulate "alterations" [kind] $
            tabulate "first codes" (take 1 (codesOf machine proof)) $
              not (Proof.isProven proof)
  parts <- runIO (fromMaybe 10 <$> askedCount "PARTC_HEIGHTS")
  it "a judge with heights on a grid finds the same in random files (pending without numpy)" $
    PythonJudge.agrees
      "test/heights/collisions.py"
      [("numpy", "python3-numpy")]
      ["--parts", show parts, "--seed", "1"]
  where
    isProgram file = takeExtension file == ".part"

-- | The codes of the findings of a proof.
codesOf :: Machine -> Proof -> [String]
codesOf machine proof =
  [Text.unpack code | r <- Proof.toReports Millimetres machine proof, let code = codeOf r]
  where
    codeOf r = let Report.ReportCode code = Report.code r in code

folder :: FilePath
folder = "test/collisions"

-- | The proof of a program has the codes and the frames that the first line of the program names,
-- and the program has the warnings of moves into material in the lines that it names.
collides :: FilePath -> Spec
collides file = it file $ do
  text <- Text.readFile (folder </> file)
  case taped Machines.iso6983 text of
    Nothing -> expectationFailure "the program has no tape"
    Just (path, program) -> do
      let proof = Verify.prove Machines.iso6983 path program (own program)
          found =
            [ Text.pack (code <> " " <> show (fromMaybe 0 (Proof.frameOf finding)))
              | (code, finding) <- zip (codesOf Machines.iso6983 proof) (Proof.findings proof)
            ]
      sort (found <> intoMaterial text)
        `shouldBe` sort (Text.splitOn ", " (Text.drop 3 (Text.takeWhile (/= '\n') text)))
  where
    own = map Frame.frame . Frame.plannedFrames

-- | The warnings of rapid moves into material that is not cleared or drilled yet, with the lines of
-- the text.
intoMaterial :: Text -> [Text]
intoMaterial text =
  [ "W0402 in line " <> Text.pack (show (1 + Text.count "\n" (Text.take (Region.start r) text)))
    | Report.Report {Report.code = Report.ReportCode "W0402", Report.place = Report.InSource r} <-
        Result.warnings (Compile.analyse [] (LoadedProgram.fromText "p.part" text))
  ]

-- | The toolpath and the planned frames of a text; Nothing if it has an error.
taped :: Machine -> Text -> Maybe (Toolpath, FrameProgram)
taped machine text = do
  Analysis {Compile.path = path} <-
    Result.ifSound (Compile.analyse [] (LoadedProgram.fromText "p.part" text))
  (path,) <$> Result.ifSound (FromToolpath.quantise (Target.setUpFor path machine) path)

-- | A random program, its machine, the name of an alteration, and the proof of the altered tape.
alteredTape :: Gen (Text, Machine, String, Proof)
alteredTape = do
  machine <- elements [m | m <- Machines.known, name m /= MachineName "kontur-2p"]
  let MachineName machineName = name machine
  text <- AlteredTape.program machineName
  case taped machine text of
    Nothing -> alteredTape
    Just (path, program) -> do
      found <- AlteredTape.altered machine program
      let own = map Frame.frame (Frame.plannedFrames program)
      case found of
        Just (kind, frames)
          | frames /= own -> pure (text, machine, kind, Verify.prove machine path program frames)
        _ -> alteredTape
