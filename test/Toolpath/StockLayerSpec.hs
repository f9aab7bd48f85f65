-- | Laws of the stock that a toolpath leaves, for reports and pictures.
module Toolpath.StockLayerSpec (spec) where

import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import Compile (Analysis (Analysis))
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Distance qualified as Distance
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Numeric (showFFloat)
import Part.Part (Solid (..))
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess)
import Test.QuickCheck
import Toolpath.StockLayer (StockLayer (..))
import Toolpath.StockLayer qualified as StockLayer
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec = do
  describe "by hand" $ do
    it "a slot of 40 mm by 6 mm, 3 mm deep, with round ends" $
      removed (program "move (-20, 0, -3), (20, 0, -3)") `shouldBeNear` (3 * (40 * 6 + pi * 9))
    it "the same slot twice is removed once" $
      removed (program "move (-20, 0, -3), (20, 0, -3), (-20, 0, -3)")
        `shouldBeNear` (3 * (40 * 6 + pi * 9))
    it "a ramp counts by its highest height" $
      removed (program "move (-20, 0, -1), (20, 0, -3), (20, 0, 5)")
        `shouldBeNear` (1 * (40 * 6 + pi * 9) + 2 * pi * 9)
    it "a cut beside the stock removes nothing" $
      removed (program "rapid (0, 60, 5)\nmove (0, 60, -3), (9, 60, -3)") `shouldBeNear` 0
    it "a bar of 40 mm turned to 30 mm over 20 mm, with a nose of 1 mm" $
      removed turned `shouldBeNear` (pi * ((20 * 20 - 15 * 15) * 19 + 144 + 8 * pi - 2 / 3))
    it "a cut through the bottom removes no more than the stock" $
      removed (program "rapid (0, 0, 5)\nmove (0, 0, -30)") `shouldBeNear` (10 * pi * 9)
  modifyMaxSuccess (const 60)
    . it
      "the sections have the points that no move has reached (catches a \
      \lost or doubled area)"
    $ forAll randomMoves $ \moves -> forAll (vectorOf 200 place) $ \ps ->
      case layered (program moves) of
        Nothing -> property False
        Just (path, solid, layers) ->
          conjoin
            [ counterexample (show (p, bottom l, top l)) (inSection l p === isLeft path solid l p)
              | l <- layers,
                (x, y) <- ps,
                let p = Vec.point x y,
                not (isUnsure path solid p)
            ]
  where
    shouldBeNear (Just v) expected = abs (v - expected) `shouldSatisfy` (< 1e-6)
    shouldBeNear Nothing _ = expectationFailure "rounding decides"
    place = (,) <$> choose (-40, 40) <*> choose (-30, 30)

-- | A program with stock and these moves at feed.
program :: Text -> Text
program moves =
  Text.unlines
    [ "part p",
      "machine iso6983",
      "tool mill(diameter 6)",
      "feed 100",
      "tolerance 0.01",
      "from (-20, 0, 5)",
      "stock rectangle((-35, -25), (35, 25)) from -10 to 0",
      moves
    ]

-- | A bar that is turned from its face on, over 20 mm. The nose leaves a fillet of its radius.
turned :: Text
turned =
  Text.unlines
    [ "part p",
      "machine lkp-01f",
      "tool turn(nose 1)",
      "feed 100",
      "tolerance 0.01",
      "from (5, 30)",
      "stock bar(40, 60)",
      "move (5, 16), (-19, 16), (5, 30)"
    ]

-- | Random moves on a grid, so that they touch and coincide, at few heights.
randomMoves :: Gen Text
randomMoves = do
  n <- choose (1, 12 :: Int)
  stops <- vectorOf n stop
  pure ("move " <> Text.intercalate ", " stops)
  where
    stop = do
      x <- elements [-30, -27 .. 30]
      y <- elements [-21, -18 .. 21]
      z <- elements [-1, -1, -2, -4, 3]
      pure ("(" <> number x <> ", " <> number y <> ", " <> number z <> ")")
    number v = Text.pack (showFFloat (Just 1) (v :: Double) "")

-- | The toolpath of a program, its stock, and the layers that are left.
layered :: Text -> Maybe (Toolpath, Solid, [StockLayer])
layered text = do
  Analysis {Compile.path = path} <-
    Result.ifSound (Compile.analyse [] (LoadedProgram.fromText "p.part" text))
  Located _ solid <- Toolpath.stock (Toolpath.setup path)
  layers <- either (const Nothing) Just (StockLayer.stockLayers path solid)
  pure (path, solid, layers)

removed :: Text -> Maybe Double
removed text =
  (\(path, solid, layers) -> StockLayer.removedVolume path solid layers) <$> layered text

inSection :: StockLayer -> Point -> Bool
inSection l p = sum [WindingNumber.about p (Polyarc.segments c) | c <- section l] > 0

-- | Tells if no move has removed the stock of a layer at a point of the stock.
isLeft :: Toolpath -> Solid -> StockLayer -> Point -> Bool
isLeft path solid l p =
  isInStock solid p && and [d > 3 | (d, z) <- reaches path p, z <= bottom l]

isInStock :: Solid -> Point -> Bool
isInStock solid p = or [WindingNumber.encloses (Part.polyarcOf c) p | c <- outlines solid]

-- | The distances of a point from the moves at feed, each with the height down to which the move
-- removes stock.
reaches :: Toolpath -> Point -> [(Double, Mm)]
reaches path p =
  [ (d, if Segment.length s == Mm 0 then min a b else max a b)
    | m <- concatMap Toolpath.moves (Toolpath.blocks path),
      Toolpath.pace m /= Part.Rapid,
      let s = Toolpath.segment m
          (a, b) = Toolpath.heights m
          Mm d = Distance.toPoint p s
  ]

-- | Tells if rounding decides where a point is.
isUnsure :: Toolpath -> Solid -> Point -> Bool
isUnsure path solid p =
  or [abs (d - 3) < 1e-6 | (d, _) <- reaches path p]
    || or [d < 1e-6 | c <- outlines solid, s <- segments c, let Mm d = Distance.toPoint p s]
  where
    segments = foldr (:) [] . Polyarc.segments . Part.polyarcOf
