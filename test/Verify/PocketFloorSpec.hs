-- | The search for uncleared positions on the floor of a pocket.
module Verify.PocketFloorSpec (spec) where

import Base.Quantity (Mm (..), Rad (..), minus, plus, times)
import Data.List.NonEmpty qualified as NonEmpty
import Generate.Pocket qualified as Generate
import Geometry.Carrier (Side (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Offset.Tolerance qualified as Tolerance
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess)
import Test.QuickCheck
import Toolpath.Toolpath qualified as Toolpath
import Verify.Motion (CutterMotion (CutterMotion))
import Verify.Motion qualified as Motion
import Verify.Pocket (Pocket (bounds, rimDistance))
import Verify.Pocket qualified as Pocket
import Verify.PocketFloor (floorResolution)
import Verify.PocketFloor qualified as PocketFloor

spec :: Spec
spec = do
  modifyMaxSuccess (const 150) $
    it
      "a position that the cutter can take, and that no motion clears, is found; one that is found \
      \is such a position"
      $ forAll Generate.pocket $ \p ->
        case Toolpath.blocks <$> Generate.toolpathOf (Generate.pocketing [] p) of
          Just blocks
            | [pocket] <- Pocket.pocketsOf blocks ->
              forAll (strokes (bounds pocket) (cutsOf blocks)) $ \kept ->
                forAll ((`times` Generate.cutter p) <$> choose (0.6, 1.1)) $ \radius ->
                  forAllBlind (vectorOf 300 (positionIn (bounds pocket))) $ \ps ->
                    judged p pocket radius kept ps
          _ -> discard
  modifyMaxSuccess (const 500) $
    it "a position whose distance from a chain of paths is that of its borders lies on a border" $
      forAll chain $ \paths ->
        forAll (choose (0.3, 4)) $ \r ->
          forAll ((,) <$> near paths <*> near paths) $ \(p, q) ->
            case atDistance r paths p q of
              Nothing -> discard
              Just x ->
                let borders =
                      concatMap (\side -> PocketFloor.bordersOn side (Mm r) paths) [LeftOf, RightOf]
                 in counterexample (show x) $
                      minimum (map (Distance.toPoint x) borders) <= times 0.1 floorResolution

-- | Law: the result of the search agrees with the distances of the positions @ps@.
judged :: Generate.Pocket -> Pocket -> Mm -> [Segment] -> [Point] -> Property
judged p pocket radius paths ps = case PocketFloor.unclearedPoint pocket radius motions of
  Nothing ->
    counterexample
      "missed"
      ([q | q <- ps, isFree (Mm 0) q, away q > plus radius floorResolution] === [])
  Just q ->
    counterexample
      ("found " <> show (q, away q, radius))
      (isFree (times 2 Tolerance.clearance) q && away q > radius)
  where
    motions = zipWith motion [1 ..] paths
    away q = minimum (Mm (1 / 0) : map (Distance.toPoint q) paths)
    walls' = concatMap NonEmpty.toList (Generate.loops p)
    isFree less q =
      WindingNumber.about q walls' > 0
        && minimum (map (Distance.toPoint q) walls') >= minus (rimDistance pocket) less

-- | Some of the given cuts, and a few strokes anywhere in a box.
strokes :: BoundingBox -> [Segment] -> Gen [Segment]
strokes box cuts = do
  share <- elements [0, 0.5, 0.9, 1, 1]
  marks <- vectorOf (length cuts) (choose (0, 1 :: Double))
  others <- oneof [pure [], listOf (Straight <$> at <*> at), listOf (arcIn at)]
  pure ([s | (s, mark) <- zip cuts marks, mark <= share] <> take 4 others)
  where
    at = positionIn box

-- | A motion at the depth of the pocket.
motion :: Int -> Segment -> CutterMotion
motion number segment =
  CutterMotion
    { Motion.number,
      Motion.part = 0,
      Motion.segment,
      Motion.fromHeight = Mm (-1.5),
      Motion.toHeight = Mm (-1.5)
    }

-- | The segments along which a toolpath cuts at the depth of the pocket.
cutsOf :: [Toolpath.Block] -> [Segment]
cutsOf blocks =
  [ Toolpath.segment m
    | Toolpath.Clearing {Toolpath.cleared} <- blocks,
      m <- NonEmpty.toList cleared,
      Toolpath.heights m == (Mm (-1.5), Mm (-1.5))
  ]

positionIn :: BoundingBox -> Gen Point
positionIn (BoundingBox l b r t) = Vec.point <$> choose (l, r) <*> choose (b, t)

-- | A chain of lines and arcs, each of which begins where the one before ends, or nearly all.
chain :: Gen [Segment]
chain = choose (1, 5) >>= \n -> point >>= go (n :: Int)
  where
    point = Vec.point <$> choose (-6, 6) <*> choose (-6, 6)
    go n at
      | n <= 0 = pure []
      | otherwise = do
        s <- oneof [Straight at <$> point, arcIn (pure at), pure (Straight at at)]
        next <- frequency [(5, pure (Segment.end s)), (1, point)]
        (s :) <$> go (n - 1) next

-- | An arc of up to a full circle that begins at a position.
arcIn :: Gen Point -> Gen Segment
arcIn begin = do
  start <- begin
  r <- choose (0.3, 6)
  angle <- choose (0, 2 * pi)
  turned <- oneof [choose (0.05, 2 * pi), pure (2 * pi)]
  sense <- elements [1, -1]
  let centre = Vec.shift (Vec.polar (Mm r) (Rad angle)) start
      sweep = Rad (sense * turned)
  pure
    Arc {start, end = Vec.shift (Vec.rotate sweep (Vec.to centre start)) centre, centre, sweep}

-- | A position within 6 mm of one of several paths.
near :: [Segment] -> Gen Point
near paths = do
  s <- elements paths
  t <- choose (0, 1)
  v <- Vec.vec <$> choose (-6, 6) <*> choose (-6, 6)
  pure (Vec.shift v (Segment.at t s))

-- | A position between two others whose distance from the nearest path is @r@.
atDistance :: Double -> [Segment] -> Point -> Point -> Maybe Point
atDistance r paths p q
  | away p > Mm r, away q < Mm r = Just (go (60 :: Int) p q)
  | otherwise = Nothing
  where
    away x = minimum (map (Distance.toPoint x) paths)
    go n a b
      | n <= 0 = a
      | away middle > Mm r = go (n - 1) middle b
      | otherwise = go (n - 1) a middle
      where
        middle = Vec.interpolate 0.5 a b
