-- | Fast distances and bounds against exact distances and against many sample points.
module Geometry.Distance.FastSpec (spec) where

import Base.Quantity (Mm (..), Rad (..), times)
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.RandomSegment (point, segment)
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it "distance: of a point is the exact one (catches a foot beyond an end)" $
    property $
      forAll ((,) <$> point <*> segment) $ \(p, s) ->
        let Mm d = Distance.toPoint p s
            found = FastDistance.distance s (Vec.x p) (Vec.y p)
         in counterexample (show (d, found)) (abs (d - found) <= 1e-9)
  it
    "apart: of two segments is the exact distance (catches a missing intersection, and a missing \
    \normal)"
    $ property $
      forAll pair $ \(a, b) ->
        let Distance.ClosestPoint (Mm d) _ = Distance.segments a b
            found = FastDistance.apart a b
         in counterexample (show (d, found)) (found <= d + 1e-9 && found >= d - 1e-6)
  it
    "furthest: no point of one segment is further from the other (catches an arc that is measured \
    \at its ends only)"
    $ property $
      forAll pair $ \(a, b) ->
        let bound = FastDistance.furthest a b
            sampled = greatest a b
         in classify (bound < sampled + 1e-3) "tight" $
              counterexample (show (bound, sampled)) (bound >= sampled - 1e-9)
  it
    "isCovered: is true only of segments without an uncovered part (catches a part between two \
    \others)"
    $ withMaxSuccess 300 $
      forAll ((,) <$> oneof [pure <$> segment, chain] <*> choose (0.5, 12)) $ \(others, r) ->
        forAll (oneof [beside r others, alongAll r others]) $ \s ->
          forAll ((,) <$> sublistOf others <*> choose (0.9, 1.3)) $ \(some, share) ->
            let reach = share * r
                covered ss = FastDistance.isCovered reach pure (const True) ss s
                gaps ss =
                  filter (\(from, to) -> to - from > 1e-6) (Distance.uncovered (Mm reach) ss s)
             in classify (covered others) "covered" $
                  counterexample
                    (show (gaps others, gaps some))
                    (all (\ss -> not (covered ss) || null (gaps ss)) [others, some])
  it
    "apartAtLeast: is a lower bound of the distance (catches an arc that is nearest between its \
    \ends)"
    $ property $
      forAll pair $ \(a, b) ->
        let Distance.ClosestPoint (Mm d) _ = Distance.segments a b
            bound = FastDistance.apartAtLeast a b
         in classify (bound > d - 1e-6) "tight" $
              counterexample (show (d, bound)) (bound <= d + 1e-9)
  it
    "mayComeWithin, mayLieWithin: are true of everything within reach (catches a length that is \
    \not added)"
    $ property $
      forAll ((,) <$> pair <*> choose (0, 20)) $ \((a, b), r) ->
        let Distance.ClosestPoint (Mm d) _ = Distance.segments a b
            Mm long = Segment.length a
            p = Segment.start b
            Mm e = Distance.toPoint p a
         in counterexample
              (show (d, e))
              ( (d > r || FastDistance.mayComeWithin r long a b)
                  && (e > r || FastDistance.mayLieWithin r long a (Vec.x p) (Vec.y p))
              )
  it
    "isAccompanied: is true only of segments without an uncovered part (catches a curve around the \
    \far side, and one with a gap)"
    $ withMaxSuccess 1000 $
      forAll ((,,) <$> chain <*> choose (0.5, 12) <*> arbitrary) $ \(others, r, backwards) ->
        forAll (oneof [beside r others, alongAll r others]) $ \s ->
          forAll (sublistOf others) $ \some ->
            let reach = 1.1 * r
                covered ss =
                  FastDistance.isAccompanied reach ss (if backwards then Segment.reverse s else s)
                gaps ss =
                  filter (\(from, to) -> to - from > 1e-6) (Distance.uncovered (Mm reach) ss s)
             in classify (covered others) "accompanied" $
                  counterexample
                    (show (gaps others, gaps some))
                    (all (\ss -> not (covered ss) || null (gaps ss)) [others, some])
  it
    "divided: divides a segment at the foot of a point (catches parts that do not meet, or that \
    \are less than the segment)"
    $ property $
      forAll ((,) <$> point <*> segment) $ \(p, s) ->
        case FastDistance.divided (Vec.x p) (Vec.y p) s of
          Nothing -> property True
          Just (q, r) ->
            let apart u v = let Mm d = Vec.distance u v in d
                Mm away = Distance.toPoint p s
                Mm far = Distance.toPoint (Segment.end q) s
             in counterexample (show (q, r)) $
                  apart (Segment.start q) (Segment.start s) < 1e-9
                    && apart (Segment.end r) (Segment.end s) < 1e-9
                    && apart (Segment.end q) (Segment.start r) < 1e-9
                    && far < 1e-9
                    && case s of
                      Straight _ _ -> abs (apart p (Segment.end q) - away) < 1e-6
                      Arc {} -> True
  it
    "isLeftOf, isRightOf: are true only if every point lies on the side (catches an arc that is \
    \tested at its ends only)"
    $ property $
      forAll pair $ \(t, e) ->
        let points = samples t
         in counterexample
              (show (FastDistance.isLeftOf t e, FastDistance.isRightOf t e))
              ( (not (FastDistance.isLeftOf t e) || all (isLeft e) points)
                  && (not (FastDistance.isRightOf t e) || not (any (isLeft e) points))
              )
  it
    "furthestFrom: no point of a segment is further from any of several others (catches the least \
    \distance in place of the greatest)"
    $ property $
      forAll ((,) <$> resize 3 (listOf1 segment) <*> choose (0.5, 12)) $ \(others, r) ->
        forAll ((,) <$> beside r others <*> choose (r, 100)) $ \(s, most) ->
          let bound = FastDistance.furthestFrom most s others
              sampled = maximum (map (greatest s) others)
           in classify (bound < sampled + 1e-3) "tight" $
                counterexample (show (bound, sampled)) (bound >= sampled - 1e-9)
  it
    "isWithin: is true only if every point of a segment is within the distance (catches a segment \
    \of which only the start is tested)"
    $ property $
      forAll ((,) <$> pair <*> choose (0.5, 30)) $ \((a, b), r) ->
        let isNear = FastDistance.isWithin r a b
         in classify isNear "within" $
              counterexample (show (greatest a b)) (not isNear || greatest a b <= r + 1e-9)
  it
    "range: bounds the greatest distance from several others (catches a part that is left out)"
    $ property $
      forAll (resize 4 (listOf1 (resize 2 (listOf1 segment)))) $ \others ->
        forAll (oneof [segment, choose (0.5, 12) >>= \r -> beside r (concat others)]) $ \s ->
          let (low, high) = FastDistance.range others s
              away p t = let Mm d = Distance.toPoint p t in d
              from p = minimum [maximum (map (away p) ts) | ts <- others]
              sampled = maximum (map from (samples s))
              Mm step = times (1 / 200) (Segment.length s)
           in counterexample
                (show (low, sampled, high))
                (low <= sampled + step && sampled <= high + 1e-9)
  it
    "spansAbout: is true if the foot of a point lies on the segment (catches a foot in the second \
    \half)"
    $ property $
      forAll ((,) <$> segment <*> point) $ \(s, p) ->
        Segment.hasFootOf s p ==> FastDistance.spansAbout s (Vec.x p) (Vec.y p)
  where
    isLeft e p = case e of
      Straight a b -> Vec.cross (Vec.to a b) (Vec.to a p) > 0
      Arc {start, centre, sweep = Rad s} ->
        (Vec.distance centre p < Segment.radius centre start) == (s > 0)

-- | Points of a segment at equal distances along it, the ends included.
samples :: Segment -> [Point]
samples s = [Segment.at (fromIntegral k / 200) s | k <- [0 .. 200 :: Int]]

-- | The greatest distance, in mm, of a sample of the first segment from the second.
greatest :: Segment -> Segment -> Double
greatest a b = maximum [d | p <- samples a, let Mm d = Distance.toPoint p b]

-- | Two independent segments, or two of which one runs beside the other.
pair :: Gen (Segment, Segment)
pair = oneof [(,) <$> segment <*> segment, alongside]
  where
    alongside = do
      a <- segment
      r <- choose (0.5, 12)
      b <- beside r [a]
      elements [(a, b), (b, a)]

-- | A line or an arc at about a distance @r@ to the left of one of some others.
beside :: Double -> [Segment] -> Gen Segment
beside r others = do
  s <- elements others
  noise <- elements [0, 1e-4, 1e-2, 5e-2]
  let moved p =
        (\x y -> Vec.shift (Vec.vec (noise * x) (noise * y)) p)
          <$> choose (-1, 1) <*> choose (-1, 1)
  from <- elements [0, 0, 0.2]
  to <- elements [1, 1, 0.7]
  case s of
    Straight a b -> do
      let out = if a == b then Vec.vec r 0 else Vec.scale r (Vec.left (Vec.unit (Vec.to a b)))
      Straight
        <$> moved (Vec.shift out (Vec.interpolate from a b))
          <*> moved (Vec.shift out (Vec.interpolate to a b))
    Arc {start, centre, sweep = Rad sweep} -> do
      let Mm old = Segment.radius centre start
      c <- moved centre
      let turned t = Vec.rotate (Rad (t * sweep)) (Vec.to centre start)
          at t = Vec.shift (Vec.scale ((old + r) / old) (turned t)) c
      pure Arc {start = at from, end = at to, centre = c, sweep = Rad (sweep * (to - from))}

-- | A line or a flat arc along all of some others: from about a distance @r@ to the left of the
-- start of the first to as far to the left of the end of the last.
alongAll :: Double -> [Segment] -> Gen Segment
alongAll r others = case others of
  [] -> segment
  first : more -> fromTo r first (foldl (\_ s -> s) first more)

-- | A line or a flat arc from about a distance @r@ to the left of one segment to as far to the left
-- of another one.
fromTo :: Double -> Segment -> Segment -> Gen Segment
fromTo r first final = do
  noise <- choose (-0.05, 0.05)
  share <- elements [0, 0.05, 0.2]
  bend <- oneof [pure 0, choose (-0.9, 0.9)]
  let out s t =
        Vec.shift (Vec.scale (r + noise) (Vec.left (Segment.directionAt t s))) (Segment.at t s)
      (a, b) = (out first share, out final (1 - share))
      l = Vec.to a b
      c = Vec.shift (Vec.scale (1 / (2 * tan (bend / 2))) (Vec.left l)) (Vec.interpolate 0.5 a b)
  pure
    ( if abs bend < 0.01 || a == b
        then Straight a b
        else Arc {start = a, end = b, centre = c, sweep = Rad bend}
    )

-- | A chain of lines and arcs without a corner.
chain :: Gen [Segment]
chain = do
  n <- choose (2, 5)
  begin <- point
  a <- choose (-4, 4)
  go n begin a
  where
    go :: Int -> Point -> Double -> Gen [Segment]
    go n p a
      | n <= 0 = pure []
      | otherwise = do
        isArc <- arbitrary
        l <- choose (1, 15)
        if isArc
          then do
            r <- choose (2, 20)
            side <- elements [1, -1]
            let c = Vec.shift (Vec.polar (Mm r) (Rad (a + side * pi / 2))) p
                sweep = side * min 3 (l / r)
                end = Vec.shift (Vec.rotate (Rad sweep) (Vec.to c p)) c
            (Arc {start = p, end, centre = c, sweep = Rad sweep} :) <$> go (n - 1) end (a + sweep)
          else
            let end =
                  Vec.shift (Vec.polar (Mm l) (Rad a)) p
             in (Straight p end :) <$> go (n - 1) end a
