-- | Laws of the order in which the holes of a statement with @shortest@ are drilled.
module Toolpath.HoleOrderSpec (spec) where

import Base.Quantity (Feed (Feed), Mm (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Compile (Analysis (Analysis))
import Compile qualified
import Data.List (sort)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (FrameProgram)
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machines qualified
import Numeric (showFFloat)
import Part.CutFeed (CutFeed (PerMinute))
import Part.Part (Drilling (Drilling), Hole (Hole), VisitOrder (Shortest))
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Project.Target qualified as Target
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess)
import Test.QuickCheck
import Toolpath.HoleOrder qualified as HoleOrder
import Toolpath.Toolpath (Toolpath)
import Verify.FromTape qualified as Verify
import Verify.Proof qualified as Proof
import Verify.RequiredOrder qualified as RequiredOrder

spec :: Spec
spec = do
  describe "a short way by hand" $ do
    it "goes along a row to its far end" $
      HoleOrder.inOrder (Vec.point 0 0) (map onAxis [30, 10, 40, 20]) `shouldBe` [1, 3, 0, 2]
    it "takes the first one of two holes at the same distance" $
      HoleOrder.inOrder (Vec.point 0 0) (map onAxis [10, -10]) `shouldBe` [0, 1]
    it "stays in the order of the list if that is shorter than going to the nearest hole" $
      -- The list takes 5 + 9 + 5 mm. By the nearest hole it would be 4 + 5 + 14 mm, and no exchange
      -- of two links would shorten that.
      HoleOrder.inOrder (Vec.point 0 0) (map onAxis [-5, 4, 9]) `shouldBe` [0, 1, 2]
    it "goes round a square" $
      HoleOrder.inOrder (Vec.point 0 0) [Vec.point 10 10, Vec.point 10 0, Vec.point 0 10]
        `shouldBe` [1, 0, 2]
    it "exchanges two links of the way by the nearest hole" $
      -- By the nearest hole: 20 + 10 + 22.361 + 50 mm. After the exchange: 20 + 20 + 22.361 +
      -- 28.284 mm.
      HoleOrder.inOrder
        (Vec.point 0 0)
        [Vec.point 0 30, Vec.point 20 10, Vec.point 40 0, Vec.point 20 0]
        `shouldBe` [3, 2, 1, 0]
    it "of one hole is this hole" $ HoleOrder.inOrder (Vec.point 0 0) [onAxis 5] `shouldBe` [0]
  modifyMaxSuccess (const 300) $ do
    it "a short way has each hole once" . property $ \(Places begin points) ->
      sort (HoleOrder.inOrder begin points) === [0 .. length points - 1]
    it "a short way is never longer than the order of the list" . property $ \places ->
      let Places begin points = places
          (written, short) = (HoleOrder.way begin points, shortWay begin points)
       in classify (short < written) "shorter" $
            counterexample (show (written, short)) (short <= Mm (inMm written + 1e-9))
    it "no exchange of two links makes a short way shorter" . property $ \(Places begin points) ->
      let way = begin : [points !! k | k <- HoleOrder.inOrder begin points]
          whole = lengthOf way
       in conjoin
            [ counterexample (show (i, j, whole, lengthOf other)) (lengthOf other > whole - 2e-6)
              | i <- [1 .. length way - 2],
                j <- [i + 1 .. length way - 1],
                let other = exchanged i j way
            ]
    it "the proof computes the same order of holes by itself" . property $ \(Places begin points) ->
      let drilling = drillingOf points
       in RequiredOrder.holesInOrder begin drilling
            === NonEmpty.toList (HoleOrder.ordered begin drilling)
  modifyMaxSuccess (const 60) $
    it "a tape with the holes of a short way in another order is refused" . property $
      forAllBlind wrongOrder $ \(text, other) ->
        counterexample (Text.unpack text <> Text.unpack other) $
          case (taped text, taped other) of
            (Just (path, own), Just (_, exchange)) ->
              let proven = Proof.isProven . Verify.prove Machines.iso6983 path own . framesOf
                  framesOf = map Frame.frame . Frame.plannedFrames
               in conjoin
                    [ counterexample "the own tape" (proven own),
                      counterexample "the other tape" (not (proven exchange))
                    ]
            _ -> counterexample "no tape" False
  where
    onAxis x = Vec.point x 0
    inMm (Mm x) = x

-- | A position of the tool and holes. Several holes may be at one place.
data Places = Places Point [Point]

instance Show Places where
  show (Places begin points) = show (begin, points)

instance Arbitrary Places where
  arbitrary = do
    coordinate <- elements [choose (-100, 100), fromInteger . (* 10) <$> choose (-4, 4)]
    count <- choose (1, 25)
    begin <- point coordinate coordinate
    scattered <- vectorOf count (point coordinate coordinate)
    -- From one end of a row to the other, the order of the list is often the shortest one.
    row <- map (`Vec.point` Vec.y begin) . sort <$> vectorOf (min 6 count) coordinate
    Places begin <$> elements [scattered, scattered, row]
    where
      point x y = Vec.point <$> x <*> y
  shrink (Places begin points) =
    [Places begin ps | ps <- shrinkList (const []) points, not (null ps)]

shortWay :: Point -> [Point] -> Mm
shortWay begin points = HoleOrder.way begin [points !! k | k <- HoleOrder.inOrder begin points]

lengthOf :: [Point] -> Double
lengthOf way = sum [d | Mm d <- zipWith Vec.distance way (drop 1 way)]

-- | A way with its points from number @i@ to number @j@ in reverse order.
exchanged :: Int -> Int -> [Point] -> [Point]
exchanged i j way =
  let (front, rest) = splitAt i way
      (between, behind) = splitAt (j - i + 1) rest
   in front <> reverse between <> behind

drillingOf :: [Point] -> Drilling
drillingOf points =
  Drilling
    { Part.holes = NonEmpty.fromList [Hole (here p) (Mm (-3)) (Mm 1) | p <- points],
      Part.visits = Shortest,
      Part.drillSize = Nothing,
      Part.drillRadius = Mm 1,
      Part.travelHeight = Mm 5,
      Part.peckDepth = Nothing,
      Part.chipRise = Nothing,
      Part.bottomPause = Nothing,
      Part.form = Part.Plunged,
      Part.drillFeed = here (PerMinute (Feed 60))
    }
  where
    here = Located (Region 0 0)

-- | A program that asks for a short way through at least two holes, and one that drills the same
-- holes in the order of that way with two of them exchanged.
wrongOrder :: Gen (Text, Text)
wrongOrder = do
  Places _ points <- arbitrary
  let begin = Vec.point 0 0
      short = [points !! k | k <- HoleOrder.inOrder begin points]
  i <- choose (0, length short - 1)
  j <- choose (0, length short - 1)
  let swapped k
        | k == i = j
        | k == j = i
        | otherwise = k
      other = [short !! swapped k | k <- [0 .. length short - 1]]
  if other == short
    then wrongOrder
    else pure (program points " { shortest }", program other "")

-- | The toolpath and the planned frames of a text; Nothing if it has an error.
taped :: Text -> Maybe (Toolpath, FrameProgram)
taped text = do
  Analysis {Compile.path = path} <-
    Result.ifSound (Compile.analyse [] (LoadedProgram.fromText "p.part" text))
  let setUp = Target.setUpFor path Machines.iso6983
  (path,) <$> Result.ifSound (FromToolpath.quantise setUp path)

program :: [Point] -> Text -> Text
program points settings =
  Text.unlines
    [ "part p",
      "machine iso6983",
      "tool drill(diameter 2)",
      "feed 60",
      "clearance 5",
      "from (0, 0, 5)",
      "drill at [" <> Text.intercalate ", " (map place points) <> "] depth 3" <> settings
    ]
  where
    place p = "(" <> number (Vec.x p) <> ", " <> number (Vec.y p) <> ")"
    number x = Text.pack (showFFloat Nothing (x :: Double) "")
