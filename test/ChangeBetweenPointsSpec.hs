-- | Pieces whose distance changes between two points, in every place of a list of ciphers: they lie
-- where an independent computation puts them, and so do the paths of the cutter beside them.
--
-- test/changes/changes.py computes the points of test/changes/expected.txt, with numpy.
module ChangeBetweenPointsSpec (spec) where

import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import Compile (Analysis (..), Compiled (..))
import Compile qualified
import Control.Monad (forM_)
import Data.List (nub)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Read qualified as Text (rational, signed)
import Files (readText)
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Machines qualified
import Part.Part qualified as Part
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Surface.Import qualified as Import
import System.FilePath ((<.>), (</>))
import Test.Hspec
import Toolpath.Toolpath (Block (..), Move (segment))
import Toolpath.Toolpath qualified as Toolpath
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  points <- runIO (map lineOf . Text.lines <$> readText "test/changes/expected.txt")
  forM_ (nub [name | (name, _, _) <- points]) $ \name -> describe (Text.unpack name) $ do
    let expected what = [p | (n, w, p) <- points, n == name, w == what]
    it "lies where numpy puts it, and so do its paths, to 0.001 mm" $ do
      loaded <- loadedFrom name
      case Compile.analyse [] loaded of
        outcome | Just Analysis {path} <- Result.ifSound outcome -> do
          length (expected "piece") `shouldSatisfy` (> 30)
          farthest (expected "piece") (contourOf path) `shouldSatisfy` (< 0.001)
          farthest (expected "left") (pathOf Part.LeftSide path) `shouldSatisfy` (< 0.001)
          farthest (expected "right") (pathOf Part.RightSide path) `shouldSatisfy` (< 0.001)
        _ -> expectationFailure "it does not compile"
    it "is proven on every machine with a tape" $ do
      loaded <- loadedFrom name
      forM_ Machines.known (isProvenFor loaded)
  it "such pieces are proven on every modern control of a milling machine" $ do
    loaded <- loadedFrom "change-on-controls"
    let controls =
          [ m
            | m <- BuiltIn.machines,
              isJust (Machine.programForm m),
              not (Text.isInfixOf "lathe" (Text.pack (show (Machine.name m))))
          ]
    length controls `shouldSatisfy` (>= 5)
    forM_ controls (isProvenFor loaded)

-- | Expects that a program compiles for a machine and that its tape is proven.
isProvenFor :: LoadedProgram -> Machine -> Expectation
isProvenFor loaded machine =
  case Compile.compile (Machines.jobFor machine []) loaded of
    outcome | Just compiled <- Result.ifSound outcome -> do
      length compiled `shouldBe` 1
      forM_ compiled $ \c -> fmap Proof.isProven (proof c) `shouldBe` Just True
    _ -> expectationFailure ("it does not compile for " <> show (Machine.name machine))

-- | A program of test/programs/cipher/good.
loadedFrom :: Text -> IO LoadedProgram
loadedFrom name = do
  let file = Text.unpack name <.> "part"
  text <- readText ("test/programs/cipher/good" </> file)
  LoadedProgram.load (Import.byName (const (pure (Left "it imports nothing")))) file text

-- | The segments of the contours that a toolpath follows.
contourOf :: Toolpath.Toolpath -> [Segment]
contourOf path =
  [ Part.segment e
    | Cutting {job = Located _ milling} <- Toolpath.blocks path,
      e <- NonEmpty.toList (Part.elements (Part.contour milling))
  ]

-- | The path of the cutter's centre on one side of the contours.
pathOf :: Part.Side -> Toolpath.Toolpath -> [Segment]
pathOf side path =
  [ segment m
    | Cutting {job = Located _ milling, cut} <- Toolpath.blocks path,
      let Located _ s = Part.side milling,
      s == side,
      m <- NonEmpty.toList cut
  ]

-- | The largest distance in mm of the points from the segments; infinite if there are none.
farthest :: [Point] -> [Segment] -> Double
farthest points segments =
  maximum [d | p <- points, let Mm d = minimum (Mm (1 / 0) : map (Distance.toPoint p) segments)]

-- | A line of test/changes/expected.txt: the program, the curve, the point.
lineOf :: Text -> (Text, Text, Point)
lineOf line = case Text.words line of
  [name, what, x, y] -> (name, what, Vec.point (number x) (number y))
  _ -> error "a line of expected.txt"
  where
    number = either error fst . Text.signed Text.rational
