-- | The law of shared walls: they change no report.
module Toolpath.WallSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Region (Located (..), Region (..))
import Base.Result qualified as Result
import Compile qualified
import Data.List (nub)
import Data.Text (Text)
import Data.Text qualified as Text
import Part.Part (Element (origin), Operation (..), Part (operations))
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Test.QuickCheck
import Toolpath.Error (Error (..))
import Toolpath.FromPart qualified as Toolpath
import Toolpath.HoleReport qualified as HoleReport

spec :: Spec
spec =
  describe "statements with equal contours" $
    it
      "get the same reports as statements with contours of their own (catches an allowance that \
      \counts for the first statement of a wall only)"
      $ property $
        forAll programs $ \(text, isRepeated) ->
          case snd <$> Result.output (Compile.evaluate [] (LoadedProgram.fromText "w.part" text)) of
            Nothing -> counterexample (Text.unpack text) False
            Just part ->
              let shared = errorsOf part
                  own = map unmarked (errorsOf (markedApart part))
               in checkCoverage
                    . cover 20 (isRepeated && not (null shared)) "with errors at equal contours"
                    . cover 5 (length shared > 1) "with several errors"
                    $ counterexample (Text.unpack text) (shared === own)
  where
    errorsOf = Result.errors . Toolpath.toToolpath

-- | A program that mills a few contours in random order, each one several times with other depths
-- or allowances, and that drills and moves among them. True if it mills one of them twice.
programs :: Gen (Text, Bool)
programs = do
  diameter <- elements [2, 5, 9]
  milled <- vectorOf 5 (choose (0, 2 :: Int))
  mills <- traverse mill milled
  others <- vectorOf 3 other
  statements <- shuffle (mills <> others)
  pure (Text.unlines (header diameter <> statements), length (nub milled) < length milled)
  where
    header diameter =
      [ "part walls",
        "tool mill(diameter " <> Decimal.whole diameter <> " mm)",
        "feed 60 mm/min",
        "tolerance 0.02 mm",
        "clearance 5 mm",
        "from (-60, -20, 5)",
        "contour c0 closed { (0, 0) (30, 0) (30, 20) (0, 20) }",
        "contour c1 closed { ccw circle((45, 10), 11) }",
        "contour c2 closed { (0, 24) (30, 24) (30, 44) (0, 44) }"
      ]
    mill n = do
      allowance <- elements [0, 0, 1, 3]
      depth <- choose (1, 3)
      approach <- frequency [(2, pure ""), (1, ("  approach " <>) <$> place)]
      pure
        ( Text.concat
            [ "mill c" <> Decimal.whole n <> " outside { depth " <> Decimal.whole depth,
              " mm  allowance " <> Decimal.whole allowance <> " mm" <> approach <> " }"
            ]
        )
    other = do
      p <- place
      elements
        [ "drill at " <> p <> " depth 2 mm",
          "rapid to " <> p
        ]
    place = do
      x <- choose (-10, 60)
      y <- choose (-10, 50)
      pure ("(" <> Decimal.whole x <> ", " <> Decimal.whole y <> ")")

-- | Shifts the regions of all elements of each statement by a distance of its own, so that no two
-- statements have equal contours.
markedApart :: Part -> Part
markedApart part = part {operations = zipWith marked [1 ..] (operations part)}
  where
    marked k operation = case operation of
      Mill (Located at milling) ->
        let c = Part.contour milling
            shiftedContour = c {Part.elements = shifted k <$> Part.elements c}
         in Mill (Located at milling {Part.contour = shiftedContour})
      _ -> operation
    shifted k e =
      let Region a b = origin e
       in e {origin = Region (a + k * apart) (b + k * apart)}

-- | The error with the regions of elements as the program has them.
unmarked :: Error -> Error
unmarked e = case e of
  CutsPart at move element deep how p begins ->
    CutsPart at move (original element) deep how p begins
  HoleCuts cut -> HoleCuts cut {HoleReport.element = original (HoleReport.element cut)}
  MillsAnother kind at along element deep p ->
    MillsAnother kind at (inText along) (original element) deep p
  _ -> e
  where
    original element = element {origin = inText (origin element)}
    inText (Region a b) = Region (a `mod` apart) (b `mod` apart)

-- | A distance longer than the text of any of the programs.
apart :: Int
apart = 100000
