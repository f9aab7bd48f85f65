-- | Tabs: their places, and the heights over them.
module Toolpath.TabSpec (spec) where

import Base.Quantity (Mm (..))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Distance qualified as Distance
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Numeric (showFFloat)
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (ReportCode (..))
import Report.Report qualified as Report
import Test.Hspec
import Test.QuickCheck
import Toolpath.Toolpath (Block (..), Move)
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec = do
  it
    "leave their height over their width and the cutter, and nothing elsewhere (catches a tab that \
    \is as wide as the cutter's path)"
    $ forAll tabbed $ \t -> withTabs t $ \bottom cut places ->
      conjoin
        [ conjoin
            [ counterexample (show (t, k, z, away)) $
                if away <= flat - slack
                  then abs (z - (bottom + tall t)) <= 1e-6
                  else away < flatEnd t flat + slope t + slack || abs (z - bottom) <= 1e-6
              | m <- cut,
                k <- [0, 0.1 .. 1],
                let p = Segment.at k (Toolpath.segment m)
                    z = heightAt k m
                    away = minimum (map (distance p) places)
                    -- Half of the distance in the plane of the ends of the flat of a tab.
                    flat = (width t + cutter t) / 2
            ],
          counterexample "the count" (length places === count t)
        ]
  it "stand in their own shares of the contour, away from corners" $
    forAll tabbed $ \t -> withTabs t $ \_ _ places ->
      counterexample (show (t, places)) $
        and
          [ minimum (map (distance p) (corners t)) >= cutter t + width t / 2 - slack
            | isRectangle t,
              p <- places
          ]
  it "stand in their own shares, on a circle in the middles of them" $
    forAll tabbed $ \t -> Text.null (way t) ==> withTabs t $ \_ cut places ->
      let lengths = map (lengthOf . Toolpath.segment) cut
          share = sum lengths / fromIntegral (count t)
          room = if isRectangle t then share / 2 else 0
       in conjoin
            [ counterexample (show (t, k, place)) $
                abs (place - (fromIntegral k - 0.5) * share) <= room + slack
              | (k, p) <- zip [1 :: Int ..] places,
                let place = placeAlong p (zip (scanl (+) 0 lengths) cut)
            ]
  it "stand at the points that the program gives, or are refused with the nearest room" $
    map
      codesOf
      [ "tab at (30, 0), (0, 20) width 5 height 2",
        "tab at (2, 0) width 5 height 2",
        "tab at (30, 0), (36, 0) width 5 height 2",
        "tabs 40 width 5 height 2",
        "tabs 4 width 5 height 6",
        "tabs 0 width 5 height 2",
        "tabs 4 width 5 height 2 angle 90 deg"
      ]
      `shouldBe` [[], ["E0426"], ["E0426"], ["E0426"], ["E0375"], ["E0338"], ["E0374"]]
  where
    slack = 1e-6
    slope t = tall t / tan (angle t)
    -- The distance of an end of the flat from its middle, which on a circle is not on the line
    -- from end to end.
    flatEnd t flat
      | isRectangle t = flat
      | otherwise = 2 * r * sin (asin (flat / r) / 2)
      where
        r = (fst (size t) + (if isInside t then -1 else 1) * cutter t) / 2
    heightAt k m = let (Mm a, Mm b) = Toolpath.heights m in a + k * (b - a)
    distance p q = let Mm d = Vec.distance p q in d
    lengthOf s = let Mm l = Segment.length s in l
    -- The length of the moves up to the point nearest to @p@.
    placeAlong p moves =
      snd . minimum $
        [ (Distance.toPoint p s, from + Distance.nearestFraction p s * lengthOf s)
          | (from, m) <- moves,
            let s = Toolpath.segment m
        ]

-- | A program with tabs.
data Tabbed = Tabbed
  { isRectangle :: Bool,
    isInside :: Bool,
    size :: (Double, Double),
    cutter :: Double,
    width :: Double,
    tall :: Double,
    -- | in radians
    angle :: Double,
    count :: Int,
    way :: Text
  }
  deriving stock (Show)

tabbed :: Gen Tabbed
tabbed =
  Tabbed
    <$> arbitrary
    <*> arbitrary
    <*> ((,) <$> choose (70, 120) <*> choose (70, 120))
    <*> choose (3, 10)
    <*> choose (2, 6)
    <*> choose (0.5, 3)
    <*> choose (0.5, 1.4)
    <*> choose (1, 4)
    <*> elements ["", "ramp 4", "spiral"]

-- | The corners of the rectangle; inside of it those of the path.
corners :: Tabbed -> [Point]
corners t = [Vec.point x y | x <- [inset, w - inset], y <- [inset, h - inset]]
  where
    (w, h) = size t
    inset = if isInside t then cutter t / 2 else 0

textOf :: Tabbed -> Text
textOf t =
  Text.unlines
    [ header (cutter t),
      if isRectangle t
        then "let edge = rectangle((0, 0), " <> pair (size t) <> ")"
        else "contour edge closed { ccw circle((40, 40), " <> number (fst (size t) / 2) <> ") }",
      "mill edge "
        <> (if isInside t then "inside { approach (40, 40) rapid rest allowed" else "outside {")
        <> " depth 6 step 2 "
        <> way t
        <> " tabs "
        <> Text.pack (show (count t))
        <> " width "
        <> number (width t)
        <> " height "
        <> number (tall t)
        <> " angle "
        <> number (angle t)
        <> " rad }"
    ]
  where
    pair (a, b) = number a <> ", " <> number b
    number x = Text.pack (showFFloat (Just 12) (x :: Double) "")

header :: Double -> Text
header d =
  "part p\ntool mill(diameter " <> Text.pack (showFFloat (Just 12) d "")
    <> ")\nfeed 60\ntolerance 0.02\nclearance 5\nfrom (-90, -90, 9)"

-- | The property of the last pass of a program: the height of its bottom, its moves, and the
-- positions of the cutter's centre in the middles of its tabs.
withTabs :: Tabbed -> (Double -> [Move] -> [Point] -> Property) -> Property
withTabs t holds = case Result.ifSound (Compile.analyse [] (program (textOf t))) of
  Nothing -> counterexample (show t <> show (reportsOf (textOf t))) False
  Just analysis -> case reverse [b | b@Cutting {} <- Toolpath.blocks (path analysis)] of
    Cutting {cut, tabs, pass} : _ ->
      let Mm bottom = Toolpath.atHeight pass in holds bottom (NonEmpty.toList cut) tabs
    _ -> counterexample "no pass" False

program :: Text -> LoadedProgram.LoadedProgram
program = LoadedProgram.fromText "p.part"

reportsOf :: Text -> [Text]
reportsOf text =
  [ code
    | r <- Result.errors (Compile.analyse [] (program text)),
      ReportCode code <- [Report.code r]
  ]

codesOf :: Text -> [Text]
codesOf setting =
  reportsOf
    ( Text.unlines
        [ header 6,
          "let edge = rectangle((0, 0), 60, 40)",
          "mill edge outside { depth 6 step 2  " <> setting <> " }"
        ]
    )
