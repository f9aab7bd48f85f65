-- | Laws of the stock that remains in the place of a tool, compared with sample points.
module Verify.RemainingStockSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Data.Maybe (isJust, isNothing)
import Geometry.Carrier (Circle (Circle), Sense (CounterClockwise))
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess)
import Test.QuickCheck
import Verify.RemainingStock (Base (Everywhere), Probe (..), Removal (..), StockSolid (..))
import Verify.RemainingStock qualified as Stock

spec :: Spec
spec = modifyMaxSuccess (const 2000) $ do
  it
    "a point that remains lies in the probe and in the solid, and no removal reaches it (catches a \
    \false collision)"
    $ forAllBlind scene $ \s -> case answer s of
      Nothing -> label "nothing remains" True
      Just p -> label "something remains" (counterexample (shown s <> show p) (isLeft 1e-4 s p))
  it "if no point remains, none of the sample points does (catches a collision that is passed)" $
    forAllBlind scene $ \s ->
      isNothing (answer s)
        ==> counterexample (shown s) (filter (isLeft (-1e-4) s) (samples s) === [])
  it "a motion along a removal of the same tool finds nothing (catches rounding that decides)" $
    forAllBlind ((,) <$> segment <*> choose (0.5, 5)) $ \(s, r) ->
      answer
        Scene
          { removals = [Removal 0 s (Mm (-1)) (Mm (-1)) (Mm r) (Mm 0) 0 Nothing],
            solid = Nothing,
            probe = Probe 1 s (Mm (r - 0.001)) (Mm (-1)) 0
          }
        === Nothing
  it "a removal above the level, or after the probe, removes nothing (catches a lost order)" $
    forAllBlind ((,) <$> segment <*> choose (0.5, 5)) $ \(s, r) ->
      forAll (elements [(0, -0.5), (2, -1)]) $ \(k, z) ->
        let found =
              answer
                Scene
                  { removals = [Removal k s (Mm z) (Mm z) (Mm r) (Mm 0) 0 Nothing],
                    solid = Nothing,
                    probe = Probe 1 s (Mm (r - 0.001)) (Mm (-1)) 0
                  }
         in isJust found

-- | Removals, the outline of the solid, which is the whole plane without one, and a probe.
data Scene = Scene {removals :: [Removal], solid :: Maybe [Segment], probe :: Probe}

answer :: Scene -> Maybe Point
answer s = case solid s of
  Nothing -> Stock.remaining index (StockSolid Everywhere (Mm (-9)) (Mm 0)) (probe s)
  Just outline -> do
    body <- Stock.solidOver (Mm (-9), Mm 0) outline
    Stock.remaining index body (probe s)
  where
    index = Stock.removalsOf (removals s)

shown :: Scene -> String
shown s =
  unlines
    [ show (solid s),
      show (path (probe s), reach (probe s), level (probe s)),
      show [(track r, fromTip r, toTip r, width r) | r <- removals s]
    ]

-- | Tells if a point is left in the probe or, with an error @e@ in mm above 0, if it may be. With
-- an error below 0 it tells if the point surely is.
isLeft :: Double -> Scene -> Point -> Bool
isLeft e s p =
  distanceTo (path (probe s)) <= mm (reach (probe s)) + e
    && maybe True isInside (solid s)
    && and [distanceTo t > mm (width r) - e | r <- removals s, Just t <- [lowPart r]]
  where
    mm (Mm x) = x
    distanceTo t = mm (Distance.toPoint p t)
    isInside outline
      | e > 0 = encloses || away <= e
      | otherwise = encloses && away > -e
      where
        encloses = WindingNumber.about p outline /= 0
        away = minimum (map distanceTo outline)
    -- The part of a removal's path on which the tip is at the level or below it.
    lowPart r
      | order r >= at (probe s) = Nothing
      | a <= z && b <= z = Just (track r)
      | a > z && b > z = Nothing
      | a <= z = Just (Segment.between 0 ((z - a) / (b - a)) (track r))
      | otherwise = Just (Segment.between ((z - a) / (b - a)) 1 (track r))
      where
        (a, b, z) = (mm (fromTip r), mm (toTip r), mm (level (probe s)))

-- | Points of the probe: on a grid of fractions along its path and distances across it.
samples :: Scene -> [Point]
samples s =
  [ Vec.shift (Vec.polar (Mm (k * r)) (Rad a)) p
    | t <- [0, 0.05 .. 1],
      let p = Segment.at t (path (probe s)),
      k <- [0, 0.25, 0.5, 0.75, 0.95, 0.999],
      a <- [0, pi / 12 .. 2 * pi]
  ]
  where
    Mm r = reach (probe s)

-- | A random scene. A third of the scenes has all coordinates on a grid, so that boundaries touch
-- and coincide.
scene :: Gen Scene
scene = do
  onGrid <- frequency [(1, pure True), (2, pure False)]
  let number low high
        | onGrid = fromIntegral <$> choose (ceiling low, floor high :: Int)
        | otherwise = choose (low, high)
      anywhere = Vec.point <$> number (-6) 6 <*> number (-6) 6
      line = Straight <$> anywhere <*> anywhere
      turn = if onGrid then elements [pi / 2, pi, -pi / 2] else choose (-6, 6)
      arc = do
        c <- anywhere
        a <- anywhere `suchThat` (/= c)
        w <- turn
        pure (Arc {start = a, end = rotated c w a, centre = c, sweep = Rad w})
      some = oneof [line, arc, (\p -> Straight p p) <$> anywhere]
      removal k =
        Removal k
          <$> some
          <*> (Mm <$> elements [-1, -1, -2, 0])
          <*> (Mm <$> elements [-1, -1, -2, 0])
          <*> (Mm <$> number 1 4)
          <*> pure (Mm 0)
          <*> pure 0
          <*> pure Nothing
  count <- choose (0, 12)
  found <- mapM removal [0 .. count - 1]
  twins <- sublistOf found
  outline <-
    oneof
      [ pure Nothing,
        (\c r -> Just [circleAbout c r]) <$> anywhere <*> number 1 6,
        (\x y w h -> Just (box x y (x + w) (y + h)))
          <$> number (-6) 4
          <*> number (-6) 4
          <*> number 1 8
          <*> number 1 8
      ]
  p <- some
  r <- number 1 3
  pure
    Scene
      { removals = found <> twins,
        solid = outline,
        probe = Probe count p (Mm (if onGrid then r else r - 0.01)) (Mm (-1)) 0
      }
  where
    circleAbout c r =
      Segment.fullCircle CounterClockwise (Circle c (Mm r)) (Vec.shift (Vec.vec r 0) c)
    box x y x' y' =
      [ Straight (Vec.point x y) (Vec.point x' y),
        Straight (Vec.point x' y) (Vec.point x' y'),
        Straight (Vec.point x' y') (Vec.point x y'),
        Straight (Vec.point x y') (Vec.point x y)
      ]

segment :: Gen Segment
segment = do
  a <- Vec.point <$> choose (-9, 9) <*> choose (-9, 9)
  b <- Vec.point <$> choose (-9, 9) <*> choose (-9, 9)
  w <- choose (-5, 5)
  elements
    [ Straight a b,
      Straight a a,
      Arc {start = a, end = rotated b w a, centre = b, sweep = Rad w}
    ]

-- | A point turned about a centre.
rotated :: Point -> Double -> Point -> Point
rotated c w p = Vec.shift (Vec.rotate (Rad w) (Vec.to c p)) c
