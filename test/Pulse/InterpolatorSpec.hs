{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O1 #-}

-- | Laws of the interpolation algorithms, in exact whole numbers: the end, the bound, and pulses
-- that are undone.
module Pulse.InterpolatorSpec
  ( spec,
  )
where

import CaseCount (askedCount)
import Data.List (foldl', minimumBy, sortOn)
import Data.Maybe (fromMaybe)
import Data.Ord (comparing)
import Machine.Controller (InterpolationMethod (..))
import Pulse.FramePath (FramePath (..))
import Pulse.FramePath qualified as FramePath
import Pulse.Interpolator qualified as Interpolator
import Pulse.Steps (Cycle (..), Pulses5 (..))
import Pulse.Steps qualified as Steps
import Test.Hspec
import Test.QuickCheck

-- | PARTC_PATHS sets another number of random paths of up to a million pulses.
spec :: Spec
spec = do
  paths <- fromMaybe 100 <$> runIO (askedCount "PARTC_PATHS")
  describe "a digital differential analyser" (laws paths DifferentialAnalyser 0.5)
  describe "an evaluation function" (laws paths EvaluationFunction (sqrt 0.5))

-- | The laws of a method whose distance from the path is at most @bound@ pulses.
laws :: Int -> InterpolationMethod -> Double -> Spec
laws paths method bound = do
  it
    "keeps to all lines up to 200 by 200 pulses, and uses its bound (catches a remainder that does \
    \not start at one half)"
    $ allWithin
      method
      bound
      [ Line (Pulses5 x y 0 0 0)
        | x <- [-200 .. 200],
          y <- [-200 .. 200],
          (x, y) /= (0, 0)
      ]
  it
    "keeps to all arcs of equal radii up to 60 pulses, and uses its bound (catches a wrong sign of \
    \the evaluation function)"
    $ allWithin method bound (concatMap equalArcs (circles 60))
  it
    "keeps to the band of all arcs of unequal radii up to 12 pulses (catches an arc that misses \
    \its end)"
    $ faultsIn method [Arc c a b | a <- disc 12, b <- disc 12, c <- [False, True]] `shouldBe` []
  it "keeps to random lines and arcs up to a million pulses (catches an overflow of a number)" $
    withMaxSuccess paths (forAll (longPath 1000000) (isSound method))
  it
    "makes the pulses of a model in exact fractions (catches an error in the way the evaluation is \
    \carried on)"
    $ withMaxSuccess 300 (forAll (longPath 1000) (\p -> pulses method p === model method p))
  it "keeps to lines in up to five axes (catches an axis that is left out)" $
    forAll (five 2000) (isSound method)

-- Paths -------------------------------------------------------------------------------------------

-- | All whole points but the centre at a distance of at most @r@.
disc :: Int -> [(Int, Int)]
disc r = [(x, y) | x <- [-r .. r], y <- [-r .. r], (x, y) /= (0, 0), x * x + y * y <= r * r]

-- | Whole points of each circle about the centre with a radius up to @r@.
circles :: Int -> [[(Int, Int)]]
circles r = groups (sortOn square (disc r))
  where
    square (x, y) = x * x + y * y
    groups ps = case ps of
      [] -> []
      a : _ -> let (same, others) = span ((== square a) . square) ps in same : groups others

equalArcs :: [(Int, Int)] -> [FramePath]
equalArcs ps = [Arc c a b | a <- ps, b <- ps, c <- [False, True]]

-- | A line or an arc whose size is log-uniform up to @most@ pulses. The radii of an arc differ by
-- rounding.
longPath :: Int -> Gen FramePath
longPath most = do
  size <- (\e -> exp (e * log (fromIntegral most))) <$> choose (0, 1 :: Double)
  let inRange = choose (-size, size)
  oneof
    [ (\x y -> Line (Pulses5 (round x) (round y) 0 0 0)) <$> inRange <*> inRange,
      do
        r <- choose (1, size / 6 + 1)
        a <- choose (0, 2 * pi)
        b <- choose (0, 2 * pi)
        let point w = (round (r * cos w), round (r * sin w)) :: (Int, Int)
        c <- arbitrary
        pure $
          if point a == (0, 0) || point b == (0, 0)
            then Line (Pulses5 1 0 0 0 0)
            else Arc c (point a) (point b)
    ]

five :: Int -> Gen FramePath
five most = (\x y z a b -> Line (Pulses5 x y z a b)) <$> n <*> n <*> n <*> n <*> n
  where
    n = oneof [pure 0, choose (-most, most)]

-- Observation -------------------------------------------------------------------------------------

-- | Observation of the pulses of a path.
data Seen = Seen
  { position :: Pulses5,
    -- | a bound is broken, a pulse is undone, or a cycle has too many pulses
    isBroken :: Bool,
    cycleCount :: Int,
    -- | direction of the last pulse along x and y, and the quadrant in which it was made
    lastX :: Int,
    quadrantX :: Int,
    lastY :: Int,
    quadrantY :: Int,
    -- | largest distance from the path, in pulses
    farthest :: Double
  }

observe :: InterpolationMethod -> FramePath -> Seen
observe method path =
  go (Seen (Pulses5 0 0 0 0 0) False 0 0 0 0 0 0) (Interpolator.start method path)
  where
    go !seen interpolator = case Interpolator.next interpolator of
      Finished -> seen
      Cycle steps rest -> go (afterCycle method path steps seen) rest

afterCycle :: InterpolationMethod -> FramePath -> Steps.Steps -> Seen -> Seen
afterCycle method path steps seen =
  Seen
    { position = p,
      isBroken =
        isBroken seen || not (isWithin method path n p) || undone || tooMany,
      cycleCount = n,
      lastX = if dx /= 0 then dx else lastX seen,
      quadrantX = if dx /= 0 then quadrant else quadrantX seen,
      lastY = if dy /= 0 then dy else lastY seen,
      quadrantY = if dy /= 0 then quadrant else quadrantY seen,
      farthest = max (farthest seen) (distance path p)
    }
  where
    p = Steps.advance steps (position seen)
    n = cycleCount seen + 1
    dx = Steps.onAxis 0 steps
    dy = Steps.onAxis 1 steps
    tooMany = method == EvaluationFunction && Steps.count steps /= 1
    quadrant = quadrantOf path (position seen)
    undone =
      isEven path
        && ( (dx * lastX seen < 0 && quadrant == quadrantX seen)
               || (dy * lastY seen < 0 && quadrant == quadrantY seen)
           )

-- | True for lines, and for arcs whose radii are equal.
isEven :: FramePath -> Bool
isEven path = case path of
  Line _ -> True
  Arc {from = (a, b), to = (c, d)} -> a * a + b * b == c * c + d * d

-- | Quadrant of a position, 0 for lines. On the border between two quadrants it is
-- the later one.
quadrantOf :: FramePath -> Pulses5 -> Int
quadrantOf path (Pulses5 x y _ _ _) = case path of
  Line _ -> 0
  Arc {clockwise, from = (a, b)}
    | clockwise -> turned (a + x) (negate (b + y))
    | otherwise -> turned (a + x) (b + y)
  where
    turned u v
      | u > 0 && v >= 0 = 1
      | u <= 0 && v > 0 = 2
      | u < 0 && v <= 0 = 3
      | otherwise = 4

-- | True if the position after @n@ cycles is within the bound of the method, in exact numbers.
isWithin :: InterpolationMethod -> FramePath -> Int -> Pulses5 -> Bool
isWithin method path n p@(Pulses5 x y z a b) = case path of
  Line d@(Pulses5 dx dy dz da db) -> case method of
    DifferentialAnalyser ->
      let lead = FramePath.leadingPulses d
          isNear c e = abs (2 * (c * lead - e * n)) <= lead
       in isNear x dx && isNear y dy && isNear z dz && isNear a da && isNear b db
    EvaluationFunction -> squareFromLine d p
  Arc {from = (i, j), to = (k, l)} ->
    let r2 = i * i + j * j
        s2 = k * k + l * l
        q2 = (i + x) * (i + x) + (j + y) * (j + y)
        outer = q2 - max r2 s2
        inner = min r2 s2 - q2
     in case method of
          DifferentialAnalyser ->
            (outer <= 0 || square (4 * outer - 1) <= 16 * max r2 s2)
              && (inner <= 0 || square (4 * inner + 1) <= 16 * min r2 s2)
          EvaluationFunction ->
            (outer <= 0 || square (2 * outer - 1) <= 8 * max r2 s2)
              && (inner <= 0 || square (2 * inner + 1) <= 8 * min r2 s2)
  where
    square m = m * m

-- | True if four times the square of the distance from a line is at most the count of axes that
-- move.
squareFromLine :: Pulses5 -> Pulses5 -> Bool
squareFromLine (Pulses5 dx dy dz da db) (Pulses5 x y z a b)
  | dz == 0 && da == 0 && db == 0 =
    let cross = dx * y - dy * x
     in z == 0 && a == 0 && b == 0 && 2 * cross * cross <= dx * dx + dy * dy
  | otherwise =
    4 * (dot c c * dot d d - dot c d * dot c d) <= axesMoved * dot d d
  where
    c = map toInteger [x, y, z, a, b]
    d = map toInteger [dx, dy, dz, da, db]
    dot u v = sum (zipWith (*) u v)
    axesMoved = toInteger (length (filter (/= 0) d))

-- | Distance from a path in the plane, in pulses.
distance :: FramePath -> Pulses5 -> Double
distance path (Pulses5 x y _ _ _) = case path of
  Line (Pulses5 dx dy _ _ _) ->
    abs (fromIntegral (dx * y - dy * x)) / sqrt (fromIntegral (dx * dx + dy * dy))
  Arc {from = (i, j), to = (k, l)} ->
    let size u v = sqrt (fromIntegral (u * u + v * v))
        r = size (i + x) (j + y)
     in max (r - max (size i j) (size k l)) (min (size i j) (size k l) - r)

-- | Paths whose end is missed, or on which a bound is broken or a pulse is undone; at most five.
faultsIn :: InterpolationMethod -> [FramePath] -> [FramePath]
faultsIn method paths = take 5 [p | p <- paths, not (isRight (observe method p) p)]

isRight :: Seen -> FramePath -> Bool
isRight seen path = not (isBroken seen) && position seen == FramePath.endOf path

isSound :: InterpolationMethod -> FramePath -> Bool
isSound method path = isRight (observe method path) path

-- | Expects that no path breaks the bound, and that one comes within 2 percent of it.
allWithin :: InterpolationMethod -> Double -> [FramePath] -> Expectation
allWithin method bound paths = do
  faults `shouldBe` []
  most `shouldSatisfy` (\m -> m > 0.98 * bound)
  where
    (faults, most) = foldl' add ([], 0) paths
    add (!bad, !m) path =
      let seen = observe method path
       in (if isRight seen path then bad else take 5 (path : bad), max m (farthest seen))

-- The model ---------------------------------------------------------------------------------------

-- | Positions after each cycle.
pulses :: InterpolationMethod -> FramePath -> [Pulses5]
pulses method path = go (Pulses5 0 0 0 0 0) (Interpolator.start method path)
  where
    go p interpolator = case Interpolator.next interpolator of
      Finished -> []
      Cycle steps rest -> let p' = Steps.advance steps p in p' : go p' rest

-- | Positions after each cycle by a model that uses the definitions in exact fractions.
model :: InterpolationMethod -> FramePath -> [Pulses5]
model method path = case path of
  Line d -> lineModel method d
  Arc {clockwise, from = (i, j), to} ->
    [Pulses5 (x - i) (y - j) 0 0 0 | (x, y) <- arcModel method clockwise (i, j) to]

-- | Positions on a line. With an analyser, an axis with d pulses has made the nearest whole number
-- to d·n\/N after cycle n of N. With an evaluation function, its pulse k is due at (2k + 1)\/(2d).
lineModel :: InterpolationMethod -> Pulses5 -> [Pulses5]
lineModel method d@(Pulses5 dx dy dz da db) = case method of
  DifferentialAnalyser ->
    [ Pulses5 (nearest n dx) (nearest n dy) (nearest n dz) (nearest n da) (nearest n db)
      | n <- [1 .. FramePath.leadingPulses d]
    ]
  EvaluationFunction ->
    drop 1 (scanl advanced (Pulses5 0 0 0 0 0) (map snd (sortOn fst dues)))
  where
    nearest n e = signum e * floor (fromIntegral (abs e * n) / lead + 1 / 2 :: Rational)
    lead = fromIntegral (FramePath.leadingPulses d) :: Rational
    dues =
      [ ((fromIntegral (2 * k + 1) / fromIntegral (2 * abs e) :: Rational, axis), (axis, signum e))
        | (axis, e) <- zip [0 :: Int ..] [dx, dy, dz, da, db],
          k <- [0 .. abs e - 1]
      ]
    advanced (Pulses5 x y z a b) (axis, s) = case axis of
      0 -> Pulses5 (x + s) y z a b
      1 -> Pulses5 x (y + s) z a b
      2 -> Pulses5 x y (z + s) a b
      3 -> Pulses5 x y z (a + s) b
      _ -> Pulses5 x y z a (b + s)

-- | Positions on an arc relative to the centre, up to the end. Of the allowed next points, the one
-- is taken whose squared distance from the centre is nearest to that of the start. The walk stops
-- before the point that lies past the direction of the end.
arcModel :: InterpolationMethod -> Bool -> (Int, Int) -> (Int, Int) -> [(Int, Int)]
arcModel method clockwise begin finish = go 0 begin
  where
    whole = let t = angle begin finish in if t <= 1e-12 then t + 2 * pi else t
    go swept p
      | abs (swept - whole) < 1e-12 && p == finish = []
      | swept' > whole + 1e-12 = straight p
      | otherwise = q : go swept' q
      where
        q = minimumBy (comparing deviation) (candidates method clockwise p)
        swept' = swept + angle p q
    -- Angle between two directions in the sense of the arc, from -π to π.
    angle (a, b) (c, d) =
      let t = atan2 (fromIntegral (a * d - b * c)) (fromIntegral (a * c + b * d)) :: Double
       in if clockwise then negate t else t
    straight (a, b) =
      [ (a + x, b + y)
        | Pulses5 x y _ _ _ <- lineModel method (Pulses5 (fst finish - a) (snd finish - b) 0 0 0)
      ]
    deviation (a, b) = abs (toInteger (a * a + b * b) - toInteger (square begin))
    square (a, b) = a * a + b * b

-- | Points that may follow a point on an arc: steps with the direction of the tangent. With an
-- analyser, the axis along which the tangent is longer makes a step.
candidates :: InterpolationMethod -> Bool -> (Int, Int) -> [(Int, Int)]
candidates method clockwise (x, y) = case method of
  EvaluationFunction -> [outward, inward]
  DifferentialAnalyser
    | shorter > longer -> [outward, both]
    | otherwise -> [inward, both]
  where
    v = if clockwise then negate y else y
    mirrored (a, b) = if clockwise then (a, negate b) else (a, b)
    (shorter, longer, inward, outward, both)
      | x > 0 && v >= 0 = (x, v, mirrored (x - 1, v), mirrored (x, v + 1), mirrored (x - 1, v + 1))
      | x <= 0 && v > 0 = (v, -x, mirrored (x, v - 1), mirrored (x - 1, v), mirrored (x - 1, v - 1))
      | x < 0 && v <= 0 =
        (-x, -v, mirrored (x + 1, v), mirrored (x, v - 1), mirrored (x + 1, v - 1))
      | otherwise = (-v, x, mirrored (x, v + 1), mirrored (x + 1, v), mirrored (x + 1, v + 1))
