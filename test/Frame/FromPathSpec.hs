-- | The laws of frames.
module Frame.FromPathSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Base.Result qualified as Result
import Data.List.NonEmpty qualified as NonEmpty
import Frame.Frame (Frame (..), Planned (frame))
import Frame.Frame qualified as Frame
import Frame.FromPath qualified as FromPath
import Generate qualified
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Lkp01f (lkp01f)
import Path.Path (Block (..), Move (segment))
import Path.Path qualified as Path
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "chords" $ do
    it "stay within the sagitta of their arc, both ways (catches the radius of the part in the step's formula)" $
      property $
        forAll ((,) <$> arc <*> sagitta) $ \(a, y) ->
          let chords = chordsOf y a
              furthest c = maximum [d | k <- [0 .. 20 :: Int], let Mm d = Distance.toPoint (Segment.at (fromIntegral k / 20) c) a]
              missed = Distance.uncovered (Mm (y + 1e-9)) chords a
           in counterexample (show (map furthest chords)) (all ((<= y + 1e-9) . furthest) chords && null missed)
    it "are as few as the sagitta allows, within a quarter turn each and no shorter than a pulse (catches a wasteful step)" $
      property $
        forAll ((,) <$> arc <*> sagitta) $ \(a, y) ->
          let n = FromPath.chordCount lkp01f (Mm y) a
              Mm r = Segment.radius (centre a) (start a)
              Rad s = sweep a
              sag k = r * (1 - cos (abs s / fromIntegral k / 2))
           in n > 1 ==> counterexample (show n) (sag (n - 1) > y - 1e-9 || abs s / fromIntegral (n - 1) > pi / 2 - 1e-9)
    it "in a band stay within it, and end where the arc ends (catches the edges of the band exchanged)" $
      property $
        forAll ((,,) <$> arc <*> sagitta <*> sagitta) $ \(a, toward, away) -> forAll (elements [(toward, away), (0, away), (toward, 0)]) $ \(i, o) ->
          let ends = FromPath.bandChords lkp01f (Mm i) (Mm o) a
              Mm r = Segment.radius (centre a) (start a)
              radii = [d | (p, q) <- zip (start a : ends) ends, k <- [0 .. 40 :: Int], let Mm d = Vec.distance (centre a) (Vec.between (fromIntegral k / 40) p q)]
           in -- A step of a pulse is taken also where it leaves the band.
              (r + o) * cos (asin (min 1 (0.02 / (2 * r)))) >= r - i ==> counterexample (show (r, minimum radii, maximum radii)) (minimum radii >= r - i - 1e-9 && maximum radii <= r + o + 1e-9 && last ends == end a)
    it "in a band are fewer than on the arc alone (catches corners that stay on the arc)" $
      property $
        forAll ((,) <$> arc <*> choose (0.02, 0.1)) $ \(a, y) ->
          let n = FromPath.chordCount lkp01f (Mm y) a
           in n >= 8 && y < 0.05 * (let Mm r = Segment.radius (centre a) (start a) in r) ==> length (FromPath.bandChords lkp01f (Mm y) (Mm y) a) < n
    it "of arc 1–2 of the Ural paper are nine" $
      FromPath.chordCount lkp01f (Mm 0.02) (Segment.Arc (Vec.point 18 0) (Vec.point (18 * cos 0.7982) (18 * sin 0.7982)) (Vec.point 0 0) (Rad 0.7982)) `shouldBe` 9
  describe "increments" $ do
    it "of a closed contour add to zero (catches rounded increments instead of rounded positions)" $
      property $
        forAll Generate.closedCase $ \c -> case Generate.milled (Mm 0.02) c >>= Result.output . FromPath.quantise lkp01f of
          Nothing -> counterexample "no frames" False
          Just program -> sum [increment (frame p) | p <- Frame.planned program, Frame.role p == Frame.Cutting 0] === 0
    it "lead to within half a pulse of every node (catches rounding that adds up)" $
      property $
        forAll Generate.openCase $ \c -> case Generate.milled (Mm 0.02) c of
          Nothing -> counterexample "no path" False
          Just path -> case Result.output (FromPath.quantise lkp01f path) of
            Nothing -> counterexample "no frames" False
            Just program ->
              let positions = map (Frame.position lkp01f) (scanl (+) (Frame.start program) (map (increment . frame) (Frame.planned program)))
                  nodes = map (Segment.end . segment) (concatMap cutOf (Path.blocks path))
                  off n = minimum [max (abs (Vec.x n - Vec.x p)) (abs (Vec.y n - Vec.y p)) | p <- positions]
               in conjoin [counterexample (show (n, off n)) (off n <= 0.01 + 1e-9) | n <- nodes]
    it "keep the machine's invariants (catches a move that does not fit its field)" $
      property $
        forAll (choose (-3e4, 3e4)) $ \x -> forAll (choose (-3e4, 3e4)) $ \y ->
          let frames = longMove x y
           in Frame.invariants lkp01f frames === [] .&&. counterexample (show (length frames)) (length frames <= 1 + ceiling (max (abs x) (abs y) / 199.98 :: Double))

-- | The moves along a contour.
cutOf :: Block -> [Move]
cutOf block = case block of
  Travelling _ _ -> []
  Holing _ _ -> []
  Commanding _ -> []
  Cutting {cut} -> NonEmpty.toList cut

chordsOf :: Double -> Segment -> [Segment]
chordsOf y a = let ends = start a : FromPath.chords lkp01f (Mm y) a in zipWith Straight ends (drop 1 ends)

-- | Arcs from a hundredth of a millimetre to ten metres.
arc :: Gen Segment
arc = do
  r <- (10 **) <$> choose (-2, 4)
  a <- choose (-4, 4)
  s <- choose (0.001, 2 * pi)
  sign <- elements [1, -1]
  let at t = Vec.point (r * cos t) (r * sin t)
  pure (Arc (at a) (at (a + sign * s)) (Vec.point 0 0) (Rad (sign * s)))

sagitta :: Gen Double
sagitta = elements [0.005, 0.02, 0.1, 1]

longMove :: Double -> Double -> [Frame]
longMove x y = maybe [] (map frame . Frame.planned) (Result.output (FromPath.quantise lkp01f (Generate.straightPath x y)))
