-- | Pockets in the evaluated part, and winding numbers.
module Part.PocketCheckSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Located (..), Region (Region))
import Base.Result (Result (..))
import Compile qualified
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Generate (Case (..), closedCase)
import Geometry.Distance qualified as Distance
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Transformation qualified as Transformation
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Part.Part (Operation (..), Pocketing)
import Part.Part qualified as Part
import Part.Transformation qualified as Transformation
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck hiding (Result (..))

spec :: Spec
spec = do
  describe "a pocket of the program" $ do
    let whole =
          pocketOf
            [ "pocket edge step 4 { islands boss, [moved(boss, (30, 0)), moved(boss, (60, 0))]  \
              \allowance 0.5, 0  depth 6 step 2  plunge 20  climb  rest allowed }"
            ]
    it "has its outline, its islands in order, its stepover, and the settings of mill" $ do
      fmap
        ( \p ->
            ( map
                (Segment.start . NonEmpty.head . Polyarc.segments . Part.polyarcOf)
                (Part.islands p),
              Part.stepover p
            )
        )
        whole
        `shouldBe` Just ([Vec.point 15 20, Vec.point 45 20, Vec.point 75 20], Mm 4)
      fmap (asked . Part.wall) whole
        `shouldBe` Just
          ( Part.Inside,
            [Mm (-2), Mm (-4), Mm (-6)],
            Mm 0.5 :| [Mm 0],
            Just Part.Climb,
            Part.Allowed
          )
    it "refuses rest material unless it is allowed" $
      fmap (Part.rest . Part.wall) (pocketOf ["pocket edge step 4 { }"])
        `shouldBe` Just Part.Refused
    it "may have an outline with the name pocket" $
      fmap
        Part.stepover
        (pocketOf ["contour pocket closed { ccw circle((0, 0), 40) }", "pocket pocket step 4 { }"])
        `shouldBe` Just (Mm 4)
    -- Catches islands that are not transformed with the pocket.
    it "moves with its islands, but keeps its stepover" $
      fmap (\p -> (starts (transformed p), Part.stepover (transformed p))) whole
        `shouldBe` fmap (\p -> (map (Transformation.point turn) (starts p), Part.stepover p)) whole
  describe "mill" $
    it "leaves rest material when that is allowed" $
      [ Part.rest m
        | Mill (Located _ m) <-
            operations ["mill edge inside { rest allowed }", "mill edge inside { }"]
      ]
        `shouldBe` [Part.Allowed, Part.Refused]
  describe "the winding number" $ do
    prop
      "is the same on the chord of an arc as next to it (catches an arc that passes a point of its \
      \chord on the wrong side)"
      $ forAll ((,,) <$> choose (-9, 9 :: Int) <*> choose (0, 3 :: Int) <*> arbitrary) $
        \(k, turns, isReversed) ->
          let turned q = iterate (\v -> Vec.point (negate (Vec.y v)) (Vec.x v)) q !! turns
              place x y = turned (Vec.point x y)
              segments =
                [ Segment.Arc
                    { Segment.start = place 0 (-10),
                      Segment.end = place 0 10,
                      Segment.centre = place 0 0,
                      Segment.sweep = Rad pi
                    },
                  Segment.Straight (place 0 10) (place (-10) 10),
                  Segment.Straight (place (-10) 10) (place (-10) (-10)),
                  Segment.Straight (place (-10) (-10)) (place 0 (-10))
                ]
           in WindingNumber.about
                (place 0 (fromIntegral k))
                (if isReversed then map Segment.reverse segments else segments)
                === if isReversed
                  then -1
                  else 1
    -- Catches an arc that is counted like its chord.
    prop
      "is that of many chords (catches a circular segment that is left out, or added on the wrong \
      \side of its chord)"
      $ forAll closedCase $ \c ->
        forAll
          ((,,,) <$> choose (0, 1000) <*> choose (0, 1) <*> choose (-8, 8) <*> choose (-8, 8))
          $ \(k, t, a, b) ->
            let segments = NonEmpty.toList (Polyarc.segments (contour c))
                p = Vec.shift (Vec.vec a b) (Segment.at t (segments !! (k `mod` length segments)))
                chords = concatMap (chorded 64) segments
                away = minimum (map (Distance.toPoint p) segments)
             in away > Mm 0.5 ==> WindingNumber.about p segments === WindingNumber.about p chords
  where
    starts p =
      map
        (Segment.start . Part.segment . NonEmpty.head . Part.elements)
        (Part.contour (Part.wall p) : Part.islands p)
    turn = Transformation.rotation (Rad 0.3) (Vec.point 10 20)
    transformed p = case Transformation.operation turn (Pocket (Located (Region 0 0) p)) of
      Pocket (Located _ q) -> q
      _ -> p
    asked m =
      ( let Located _ side = Part.side m in side,
        Part.levels m,
        Part.allowances m,
        (\(Located _ s) -> s) <$> Part.sense m,
        Part.rest m
      )

-- | A segment as @n@ straight segments.
chorded :: Int -> Segment -> [Segment]
chorded n s = zipWith Segment.Straight marks (drop 1 marks)
  where
    marks = [Segment.at (fromIntegral k / fromIntegral n) s | k <- [0 .. n]]

-- | The only pocket of a program with these statements.
pocketOf :: [Text] -> Maybe Pocketing
pocketOf statements = case [p | Pocket (Located _ p) <- operations statements] of
  [p] -> Just p
  _ -> Nothing

-- | The operations of a program with these statements after a common head.
operations :: [Text] -> [Operation]
operations statements =
  case Compile.evaluate [] (LoadedProgram.fromText "pocket.part" text) of
    Result {errors = [], output = Just (_, part)} -> Part.operations part
    _ -> []
  where
    text = Text.unlines (start <> statements)
    start =
      [ "part tray",
        "tool mill(diameter 8 mm)",
        "feed 60 mm/min",
        "tolerance 0.02 mm",
        "clearance 3 mm",
        "from (0, 0, 20)",
        "contour edge closed { (0, 0) (120, 0) (120, 60) (0, 60) }",
        "contour boss closed { (15, 20) (25, 20) (25, 40) (15, 40) }"
      ]
