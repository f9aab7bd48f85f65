-- | The path in drawings and in the preview, compared with the toolpath in mm, and the area that
-- the cutter sweeps along it.
module Draw.SweptAreaSpec (spec) where

import Base.Quantity (Mm (..))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Control.Monad (forM_)
import Data.Char (isAlpha)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Geometry.Carrier (Side (..))
import Geometry.Polyarc (Ends (Closed), Polyarc (Polyarc))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Offset.Equidistant qualified as Equidistant
import Offset.SourceOffset qualified as SourceOffset
import Part.Part qualified as Part
import Plotted (drawing)
import Preview.Answer qualified as Answer
import Preview.Drawing qualified as Drawing
import Project.LoadedProgram qualified as LoadedProgram
import SvgText qualified
import Test.Hspec
import Toolpath.Toolpath (Block (Cutting, cut), Toolpath (blocks))
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec = do
  describe "the path data of a drawing" $
    forM_ ["examples/flange.part", "examples/gear.part", "examples/window.part"] $ \file ->
      it ("are the toolpath of " <> file <> ", to a hundredth of a mm") $ do
        exact <- fmap NonEmpty.toList . snd <$> contourAndCut file
        svg <- drawing [file]
        case (map commands (SvgText.attributes "d" (SvgText.layer "path" svg)), exact) of
          (drawn : _, Just segments@(first : _)) -> do
            let scale = scaleOf svg
                (left, top) = head (map endOf drawn)
                onPaper p =
                  ( left + scale * (Vec.x p - Vec.x (Segment.start first)),
                    top - scale * (Vec.y p - Vec.y (Segment.start first))
                  )
            length drawn `shouldSatisfy` (>= length segments)
            forM_ (zip (drop 1 drawn) segments) $ \(command, s) -> do
              endOf command `shouldBeNear` onPaper (Segment.end s)
              forM_ (radiusOf command) $ \r -> case s of
                Straight _ _ -> expectationFailure "an arc is drawn for a line"
                Arc {centre, start} ->
                  let Mm exactly = Segment.radius centre start
                   in abs (r - scale * exactly) `shouldSatisfy` (< 0.011)
          _ -> expectationFailure "there is no path"
  describe "the area that the cutter sweeps" $ do
    it "is bounded by the contour and by the equidistant at the diameter" $ do
      (contour, found) <- contourAndCut "examples/flange.part"
      forM_ found $ \segments -> do
        let path = Polyarc Closed segments
        areaBeside path RightOf `shouldBeArea` Just (abs (Polyarc.signedArea contour))
        areaBeside path LeftOf
          `shouldBeArea` areaOf (Equidistant.equidistant LeftOf (Mm 20) contour)
    it "is drawn along the same path in the preview" $ do
      followed <- Answer.followedFile "examples/flange.part"
      (_, found) <- contourAndCut "examples/flange.part"
      let answer = Answer.decode (Drawing.container False followed)
          moves =
            zip
              (groupsOf 9 (Answer.reals "move" answer))
              (groupsOf 5 (Answer.wholes "moveInfo" answer))
      Just [take 4 m | (m, kind : _) <- moves, kind == 2]
        `shouldBe` fmap (map ends . NonEmpty.toList) found
  where
    areaBeside path side = areaOf (Equidistant.equidistant side (Mm 10) path)
    areaOf result = case result of
      Right segments ->
        Just (abs (Polyarc.signedArea (Polyarc Closed (fmap SourceOffset.segment segments))))
      Left _ -> Nothing
    shouldBeArea a b = case (a, b) of
      (Just x, Just y) -> abs (x - y) `shouldSatisfy` (< 1e-6)
      _ -> expectationFailure "there is no equidistant"
    ends s = let (a, b) = (Segment.start s, Segment.end s) in [Vec.x a, Vec.y a, Vec.x b, Vec.y b]

-- | The contour that a program mills first, and the moves along it.
contourAndCut :: FilePath -> IO (Polyarc, Maybe (NonEmpty Segment))
contourAndCut file = do
  text <- readText file
  case Result.output (Compile.analyse [] (LoadedProgram.fromText (Text.pack file) text)) of
    Just Analysis {part, path} ->
      pure
        ( Part.polyarcOf (head (Part.contours part)),
          case [cut | Cutting {cut} <- blocks path] of
            moves : _ -> Just (fmap Toolpath.segment moves)
            [] -> Nothing
        )
    Nothing -> fail "the program has mistakes"

-- | Command of path data with its numbers.
data PathCommand = PathCommand {letter :: Char, numbers :: [Double]}

-- | Commands of path data with absolute coordinates.
commands :: Text -> [PathCommand]
commands text = case Text.uncons (Text.strip text) of
  Just (c, rest) ->
    let (mine, more) = Text.break isAlpha rest
     in PathCommand c (map (read . leading) (Text.words (separated mine))) : commands more
  Nothing -> []
  where
    separated = Text.replace "," " " . Text.replace "-" " -"
    leading w = case Text.unpack w of
      '.' : digits -> "0." <> digits
      '-' : '.' : digits -> "-0." <> digits
      other -> other

endOf :: PathCommand -> (Double, Double)
endOf command = case reverse (numbers command) of
  y : x : _ -> (x, y)
  _ -> (0, 0)

radiusOf :: PathCommand -> Maybe Double
radiusOf command = case (letter command, numbers command) of
  ('A', r : _) -> Just r
  _ -> Nothing

-- | Scale of a drawing, from its title.
scaleOf :: Text -> Double
scaleOf svg = case [w | t <- SvgText.texts svg, Just w <- [Text.stripPrefix "scale " t]] of
  found : _ | [a, b] <- Text.splitOn ":" (Text.takeWhile (/= ' ') found) -> number a / number b
  _ -> 1
  where
    number = read . Text.unpack

shouldBeNear :: (Double, Double) -> (Double, Double) -> Expectation
shouldBeNear (x, y) (x', y') = max (abs (x - x')) (abs (y - y')) `shouldSatisfy` (< 0.011)

groupsOf :: Int -> [a] -> [[a]]
groupsOf n list = case splitAt n list of
  ([], _) -> []
  (group, more) -> group : groupsOf n more
