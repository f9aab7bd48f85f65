-- | Tables and drawings of programs in inches.
module Cli.LengthUnitSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit (..))
import Base.Result qualified as Result
import Cli.NodeTable qualified as NodeTable
import Compile (Analysis (..))
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.Plot qualified as Plot
import Draw.PlotSettings qualified as PlotSettings
import Generate.MachinedText qualified as MachinedText
import Machines qualified
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec = do
  modifyMaxSuccess (const 60) $
    -- The bug: a length of a table that is in mm in every program.
    prop "the tables of a program in inches have the lengths of the tables in mm" $
      forAllShow (MachinedText.program Machines.iso6983) Text.unpack $ \text ->
        case Result.ifSound (Compile.analyse [] (LoadedProgram.fromText "p.part" text)) of
          Nothing -> property Discard
          Just analysis ->
            let tables unit = Text.words (NodeTable.nodes Nothing Nothing (inUnit unit analysis))
                inches = filter (/= "(in)") (tables Inches)
             in conjoin
                  ( (length inches === length (tables Millimetres)) :
                    zipWith isSame (tables Millimetres) inches
                  )
  it "a drawing of a program in inches has its scale bar and its cutter in inches" $
    case Result.ifSound (Compile.analyse [] (LoadedProgram.fromText "p.part" plate)) of
      Nothing -> expectationFailure "there is no path"
      Just Analysis {part, path} -> do
        let drawing = Plot.plot PlotSettings.standard part path
        drawing `shouldSatisfy` Text.isInfixOf "cutter Ø 0.25 in, 5 in/min"
        drawing `shouldSatisfy` Text.isInfixOf ">1 in<"
        drawing `shouldSatisfy` (not . Text.isInfixOf " mm<")
  where
    plate =
      Text.unlines
        [ "part p",
          "units in",
          "machine iso6983",
          "tool mill(diameter 0.25)",
          "feed 5",
          "tolerance 0.001",
          "from (-1, -1)",
          "contour c closed { (0, 0) (0, 2) (3, 2) (3, 0) }",
          "mill c outside { approach (-1, 1) retract (-1, 1) }"
        ]

-- | The results of a program, with another unit of its tables.
inUnit :: LengthUnit -> Analysis -> Analysis
inUnit unit a =
  a {part = (part a) {Part.unit = unit}, path = (path a) {Toolpath.unit = unit}}

-- | True if a word of a table in mm and the word in its place of the table in inches say the same.
-- A length has three decimals in mm and four in inches, an area three and five. Radii and the sizes
-- of cutters have up to four decimals in mm and up to five in inches, and the sizes are rounded
-- down. The slope of a line has seven decimals and no unit.
isSame :: Text -> Text -> Property
isSame mm inch = counterexample (show (mm, inch)) $ case (number mm, number inch) of
  (Just a, Just b)
    | decimals mm == 7 -> mm === inch
    | decimals mm == 3 && decimals inch == 4 -> near 0.0036 a (25.4 * b)
    | decimals mm == 3 && decimals inch == 5 ->
      near 0.0038 a (25.4 * 25.4 * b) .||. near 0.0036 a (25.4 * b)
    | mm /= inch -> near 0.0036 a (25.4 * b)
    | otherwise -> property (decimals mm < 3)
  _ -> Text.replace "mm" "in" mm === inch
  where
    near most a b = property (abs (a - b) <= most)
    number = Decimal.parse . digitsOf
    decimals = Text.length . Text.drop 1 . snd . Text.breakOn "." . digitsOf
    digitsOf = Text.dropAround (`elem` ("-(),:." :: String))
