-- | Laws of biarcs; each names the bug that it catches. Distances are measured by other means than
-- in the program: to an arc by angles, to a curve by the nearest of many of its points.
module Geometry.ArcFitting.BiarcSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Data.Foldable (toList)
import Data.IntMap.Lazy (IntMap, (!))
import Data.IntMap.Lazy qualified as IntMap
import Data.List (sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust)
import Generate.FitCase
import Geometry.Apart (apart, away)
import Geometry.ArcFitting.Biarc qualified as Biarc
import Geometry.ArcFitting.CubicFit qualified as CubicFit
import Geometry.ArcFitting.ParametricFit (OneSided (..), ParametricCurve (..))
import Geometry.ArcFitting.ParametricFit qualified as ParametricFit
import Geometry.Curve.Spline qualified as Spline
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "biarcs between two ends" $ do
    it
      "biarc: has the given ends and end directions and no kink (catches a joint at a wrong point)"
      $ property $
        forAll pair joinLaw
    it
      "biarc: exists for all directions at less than 90° to the chord (catches a formula that \
      \fails for parallel directions)"
      $ property $
        forAll (posesWithin 1.57) $ \(a, b) -> counterexample "none" (isJust (Biarc.join a b))
    it "biarc: is the same from either end (catches a ratio that favours one end)" $
      property $
        forAll (posesWithin 1.5) backwardsLaw
    it
      "biarc: of ends that bend to one side bends to this side (catches equal chords where the \
      \angles differ much)"
      $ property $
        forAll oneSided oneSidedLaw
    it "is one line between collinear ends, and one arc between the ends of an arc" $ do
      fmap length (Biarc.join (Vec.point 1 2, east) (Vec.point 5 2, east)) `shouldBe` Just 1
      fmap
        (fmap Segment.length)
        (Biarc.join (Vec.point 5 0, Vec.vec 0 1) (Vec.point (-5) 0, Vec.vec 0 (-1)))
        `shouldSatisfy` \case
          Just (Mm l :| []) -> abs (l - 5 * pi) < 1e-9
          _ -> False
    it "is two half circles between parallel ends perpendicular to the chord" $
      fmap
        (fmap (roundTo . sweepOf))
        (Biarc.join (Vec.point 0 0, Vec.vec 0 1) (Vec.point 4 0, Vec.vec 0 1))
        `shouldBe` Just (roundTo (-pi) :| [roundTo pi])
    it "does not exist between coincident points, and where an arc would sweep too far" $ do
      Biarc.join (Vec.point 1 1, east) (Vec.point 1 1, east) `shouldBe` Nothing
      Biarc.join (Vec.point 0 0, Vec.vec (-1) 0) (Vec.point 4 0, Vec.vec (-1) 0) `shouldBe` Nothing
  describe "biarcs through points" $ do
    it
      "through: passes every point in order without a kink, closed or open (catches a direction \
      \that differs between neighbours)"
      $ property $
        forAll ((,) <$> elements [Open, Closed] <*> scattered) (uncurry throughLaw)
    it
      "through: points of a circle give the circle, points of a line the line (catches a direction \
      \that is only nearly that of the circle)"
      $ property $
        forAll ((,) <$> elements [Open, Closed] <*> onCircle) (uncurry circleLaw)
    it "joins two points by a line, or by a circle if closed" $ do
      Biarc.through Open (Vec.point 0 0 :| [Vec.point 4 0])
        `shouldBe` (Straight (Vec.point 0 0) (Vec.point 4 0) :| [])
      fmap (roundTo . sweepOf) (Biarc.through Closed (Vec.point 0 0 :| [Vec.point 4 0]))
        `shouldBe` (roundTo pi :| [roundTo pi])
    it "counts coincident points once" $
      Biarc.through
        Closed
        (Vec.point 0 0 :| [Vec.point 0 0, Vec.point 4 0, Vec.point 4 3, Vec.point 0 0])
        `shouldBe` Biarc.through Closed (Vec.point 0 0 :| [Vec.point 4 0, Vec.point 4 3])
  describe "biarcs along a curve" $ do
    it
      "approximate: every point of the curve is near the arcs (catches a deviation that is \
      \measured at too few points)"
      $ property $
        forAll fitCase curveLaw
    it
      "approximate: every point of the arcs is near the curve (catches an arc around the far side)"
      $ property $
        forAll fitCase arcsLaw
    it
      "approximate: every point of the arcs is near a curve that turns back within a radius far \
      \below the tolerance (catches an arc that overshoots)"
      $ property $
        forAll nearCusp arcsLaw
    it
      "approximate: no kink but at corners, and a group for each stretch between them (catches a \
      \small kink taken for a corner)"
      $ property $
        forAll fitCase kinkLaw
    it
      "approximate: needs hardly more biarcs than the best choice among 64 joints (catches a step \
      \that stops early)"
      $ property $
        forAll fitCase fewLaw
    it
      "along cubics: needs hardly more biarcs than the best choice among 64 joints (catches a step \
      \that stops early)"
      $ property $
        forAll smoothCubic fewOnCubicsLaw
    it "approximate: keeps 1e-5 mm on a curve of 10 m (catches distances that lose digits)" $
      property $
        withMaxSuccess 10 $
          forAll large curveLaw
    it "approximate: the generator reaches closed curves, vertical tangents, corners and kinks" $
      checkCoverage $
        forAll fitCase $ \(FitCase c _) ->
          cover 10 (isClosed c) "closed" $
            cover 5 (corners c > 0) "corners" $
              cover 4 (hasKinks c) "kinks" $
                cover 20 (reversesInX c) "doubles back" True
    it "terminates on degenerate curves" $ do
      count 0.01 (odd' (\_ -> Vec.point 1 1) (const east)) `shouldBe` 1
      count
        0.01
        (odd' (\u -> Vec.point (u * u) (u ** 3)) (\u -> Vec.unit (Vec.vec (2 * u) (3 * u * u))))
        `shouldSatisfy` (< 40)
      count 0.01 (odd' (\u -> Vec.point u (fromIntegral (floor (3 * u) :: Int))) (const east))
        `shouldSatisfy` (< 1000)
      count 0.01 (odd' (Vec.point <*> abs) (const (Vec.vec 0 1))) `shouldSatisfy` (>= 1)
  where
    east = Vec.vec 1 0
    roundTo a = fromIntegral (round (a * 1e6 :: Double) :: Int) / 1e6 :: Double
    odd' place d = ParametricCurve {place, direction = const d, begin = -2, breaks = 2 :| []}
    count tolerance curve = sum (fmap length (ParametricFit.approximate (Mm tolerance) curve))

-- Between two ends ------------------------------------------------------------------------------

type End = (Point, Vec)

-- | Two end poses, often in special positions.
pair :: Gen (End, End)
pair =
  posesLeaning
    ( oneof
        [ choose (-pi, pi),
          elements [0, pi / 2, -(pi / 2), pi, 1e-9, -1e-9, 1e-5, pi / 4, -(pi / 4)]
        ]
    )

-- | Two end poses whose directions make at most a given angle with the chord; often both directions
-- are parallel or mirrored.
posesWithin :: Double -> Gen (End, End)
posesWithin limit = posesLeaning (oneof [choose (-limit, limit), elements special])
  where
    special = [0, limit, -limit, 1e-7, 0.3, -0.3]

posesLeaning :: Gen Double -> Gen (End, End)
posesLeaning angles = do
  p <- Vec.point <$> choose (-300, 300) <*> choose (-300, 300)
  chord <-
    Vec.polar . Mm <$> oneof [choose (0.01, 1), choose (1, 1000)] <*> (Rad <$> choose (-pi, pi))
  a <- angles
  b <- oneof [angles, pure a, pure (-a)]
  let u = Vec.unit chord
  pure ((p, Vec.rotate (Rad a) u), (Vec.shift chord p, Vec.rotate (Rad b) u))

joinLaw :: (End, End) -> Property
joinLaw (from@(p, s), to@(q, t)) = case Biarc.join from to of
  Nothing -> classify True "none" True
  Just ss ->
    let list = toList ss
     in conjoin (map isConsistent list)
          .&&. Segment.start (NonEmpty.head ss) === p
          .&&. Segment.end (NonEmpty.last ss) === q
          .&&. counterexample
            (show list)
            ( aligned s (Segment.startDirection (NonEmpty.head ss))
                .&&. aligned (Segment.endDirection (NonEmpty.last ss)) t
            )
          .&&. smooth list

-- | The sweep of an arc is at most half a turn and leads from the start to the end on the circle.
isConsistent :: Segment -> Property
isConsistent s = case s of
  Straight _ _ -> property True
  Arc {start, end, centre, sweep = Rad a} ->
    let r = away centre start
     in counterexample (show s) $
          abs (away centre end - r) <= 1e-9 * r
            && away (Vec.shift (Vec.rotate (Rad a) (Vec.to centre start)) centre) end <= 1e-9 * r
            && abs a <= pi + 1e-6

-- | Neighbouring segments share a point exactly and have one direction there.
smooth :: [Segment] -> Property
smooth ss = conjoin (zipWith joined ss (drop 1 ss))
  where
    joined a b =
      counterexample
        (show (a, b))
        ( Segment.end a
            === Segment.start b .&&. aligned (Segment.endDirection a) (Segment.startDirection b)
        )

-- | Directions agree, except for the error of a line in place of a nearly straight arc.
aligned :: Vec -> Vec -> Property
aligned a b = let Rad off = Vec.signedAngle a b in counterexample (show off) (abs off < 2.1e-8)

sweepOf :: Segment -> Double
sweepOf s = case s of
  Straight _ _ -> 0
  Arc {sweep = Rad a} -> a

backwardsLaw :: (End, End) -> Property
backwardsLaw ((p, s), (q, t)) =
  case (Biarc.join (p, s) (q, t), Biarc.join (q, Vec.negate t) (p, Vec.negate s)) of
    (Just there, Just back) ->
      length there === length back
        .&&. conjoin
          [ counterexample
              (show (a, b))
              (away (Segment.end a) (Segment.start b) < 1e-9 * (1 + away p q))
            | (a, b) <- zip (toList there) (toList (NonEmpty.reverse back))
          ]
    both -> counterexample (show both) False

-- | End poses of a curve that bends to one side. The angle to the chord at one end is up to five
-- times that at the other.
oneSided :: Gen (End, End)
oneSided = do
  a <- choose (0.05, 0.3)
  times <- choose (1, 5)
  mirror <- elements [1, -1]
  (small, big) <- elements [(a, times * a), (times * a, a)]
  let q = Vec.point 40 0
  pure
    ( (Vec.point 0 0, Vec.polar (Mm 1) (Rad (mirror * small))),
      (q, Vec.polar (Mm 1) (Rad (-(mirror * big))))
    )

oneSidedLaw :: (End, End) -> Property
oneSidedLaw (a, b) = case Biarc.join a b of
  Nothing -> property False
  Just ss ->
    let sweeps =
          map sweepOf (toList ss)
     in counterexample (show sweeps) (all (> 0) sweeps || all (< 0) sweeps)

-- Through points --------------------------------------------------------------------------------

-- | Random points, points in a row, and points there and back.
scattered :: Gen (NonEmpty Point)
scattered = do
  n <- choose (3, 9)
  ps <- vectorOf n (Vec.point <$> choose (-50, 50) <*> oneof [choose (-50, 50), pure 0])
  extra <- elements [[], take 1 (drop (n - 2) ps)]
  pure (fromMaybe (Vec.point 0 0 :| []) (NonEmpty.nonEmpty (ps <> extra)))

throughLaw :: Ends -> NonEmpty Point -> Property
throughLaw ends ps =
  conjoin (map isConsistent list)
    .&&. smooth (list <> closing)
    .&&. counterexample
      (show list)
      (inOrder (toList ps <> oncemore) (map Segment.start list <> [Segment.end (NonEmpty.last ss)]))
  where
    ss = Biarc.through ends ps
    list = toList ss
    (closing, oncemore) = case ends of
      Open -> ([], [])
      Closed -> ([NonEmpty.head ss], [NonEmpty.head ps])
    inOrder wanted found = case (wanted, found) of
      ([], _) -> True
      (w : ws, f : fs)
        | away w f < 1e-6 ->
          inOrder (dropWhile ((< 1e-6) . away w) ws) (f : fs) || inOrder ws (f : fs)
        | otherwise -> inOrder wanted fs
      (_, []) -> False

-- | Circle by its centre and radius, or nothing for a line; and points on it in order, less than
-- half a turn apart.
onCircle :: Gen (Maybe (Point, Double), NonEmpty Point)
onCircle = do
  n <- choose (3, 8)
  jitters <- vectorOf n (choose (0, 0.4))
  r <- choose (1, 500)
  c <- Vec.point <$> choose (-100, 100) <*> choose (-100, 100)
  line <- arbitrary
  turned <- elements [1, -1]
  let steps = zipWith (+) [0 ..] jitters
      about k = Vec.shift (Vec.polar (Mm r) (Rad (turned * 2 * pi * k / fromIntegral n))) c
      along k = Vec.shift (Vec.scale k (Vec.vec 3 r)) c
      ps = map (if line then along else about) steps
  pure (if line then Nothing else Just (c, r), fromMaybe (c :| []) (NonEmpty.nonEmpty ps))

circleLaw :: Ends -> (Maybe (Point, Double), NonEmpty Point) -> Property
circleLaw ends (shape, ps) = case shape of
  Nothing -> ends == Open ==> conjoin [counterexample (show s) (sweepOf s == 0) | s <- list]
  Just (c, r) ->
    conjoin
      [ counterexample (show (s, c, r)) (abs (away c p - r) < 1e-6 * r)
        | s <- list,
          p <- [Segment.at 0.3 s, Segment.at 0.8 s]
      ]
  where
    list = toList (Biarc.through ends ps)

-- Along a curve ---------------------------------------------------------------------------------

arcsOf :: FitCase -> [Segment]
arcsOf (FitCase c tolerance) =
  concatMap toList (toList (ParametricFit.approximate (Mm tolerance) (parametricCurve c)))

curveLaw :: FitCase -> Property
curveLaw w@(FitCase c tolerance) = forAll (vectorOf 200 (choose (0, 1))) $ \fs ->
  conjoin
    [ counterexample (show (u, d)) (d <= tolerance)
      | f <- fs,
        let u = f * NonEmpty.last (breaks t),
        let d = minimum (map (`apart` place t u) ss)
    ]
  where
    t = parametricCurve c
    ss = arcsOf w

arcsLaw :: FitCase -> Property
arcsLaw w@(FitCase c tolerance) =
  forAll (vectorOf 40 ((,) <$> choose (0, length ss - 1) <*> choose (0, 1))) $ \picks ->
    conjoin
      [ counterexample (show (p, d)) (d <= tolerance + 1e-9)
        | (k, f) <- picks,
          let p = Segment.at f (ss !! k),
          let (d, _) = near p
      ]
  where
    near = nearest (parametricCurve c)
    ss = arcsOf w

-- | Distance from a point to a curve, and the parameter of the nearest point. The search refines
-- the minima among many samples, and the neighbourhood of each corner.
nearest :: ParametricCurve -> Point -> (Double, Double)
nearest t =
  \p ->
    minimum
      [ closer p (14 :: Int) step (clamped u)
        | u <- map snd (take 4 (sort (minima [(away p q, v) | (v, q) <- known]))) <> besideCorners
      ]
  where
    known = map (\u -> (u, place t u)) (parameters 3000 t)
    step = (NonEmpty.last (breaks t) - begin t) / 3000
    besideCorners = concat [[u - step, u + step] | u <- toList (breaks t)]
    minima ds =
      take 1 ds
        <> [b | (a, b, d) <- zip3 ds (drop 1 ds) (drop 2 ds), b <= a, b <= d]
        <> take 1 (reverse ds)
    closer p k h u
      | k == 0 = (away p (place t u), u)
      | otherwise =
        let (_, v) =
              minimum
                [ (away p (place t x), x)
                  | x <- map clamped [u - h, u - h / 2, u, u + h / 2, u + h]
                ]
         in closer p (k - 1) (h / 2) v
    clamped = max (begin t) . min (NonEmpty.last (breaks t))

kinkLaw :: FitCase -> Property
kinkLaw (FitCase c tolerance) =
  length groups === corners c + 1
    .&&. conjoin (map (smooth . toList) (toList groups))
    .&&. conjoin (map isConsistent (concatMap toList (toList groups)))
    .&&. conjoin
      ( zipWith
          (\a b -> Segment.end (NonEmpty.last a) === Segment.start (NonEmpty.head b))
          (toList groups)
          (NonEmpty.tail groups)
      )
  where
    groups = ParametricFit.approximate (Mm tolerance) (parametricCurve c)

-- | Comparison with the fewest biarcs, of several chord ratios, between 65 points of the curve.
-- Such a biarc counts only if it is within the tolerance, which is tested at many points.
--
-- The biarcs of the fit are counted by the joints that have the position and direction of the
-- curve. On a chain of lines and arcs, the joint in the middle of a biarc may have them, too;
-- segments are counted there, two for each biarc. Joints after very short segments do not count.
--
-- The fit looks for the longest biarc. If a biarc fits up to some end, does not fit up to later
-- ends, and fits again up to still later ones, the search may stop at the first of these ends. So
-- the comparison is with biarcs that fit up to all ends before their own.
fewLaw :: FitCase -> Property
fewLaw w@(FitCase c tolerance) =
  corners c == 0
    && not (hasKinks c)
    && length ss <= 40 ==> fewerLaw found (fewest tolerance t) slack
  where
    ss = arcsOf w
    t = parametricCurve c
    near = nearest t
    (found, fewest, slack) = case c of
      Bends _ -> (length ss, fewestOf length, 2)
      _ -> (1 + length (filter ends (zip ss (drop 1 ss))), fewestWithoutGaps, 1)
    ends (previous, s) =
      let (_, u) = near (Segment.start s)
          Rad off = Vec.signedAngle (Segment.startDirection s) (direction t Leaving u)
       in Segment.length previous > Mm 0.1
            && abs (Vec.cross (direction t Leaving u) (Vec.to (place t u) (Segment.start s))) < 1e-9
            && abs off < 5e-6

-- | Comparison as in 'fewLaw' for biarcs whose directions may differ from those of the curve;
-- segments are counted.
fewOnCubicsLaw :: FitCase -> Property
fewOnCubicsLaw (FitCase c tolerance) = case c of
  Cubic closed nodes
    | length ss <= 60 -> fewerLaw (length ss) (fewestOf length tolerance (parametricCurve c)) 2
    where
      pairs = zip nodes (drop 1 nodes <> [p | closed, p <- take 1 nodes])
      part f =
        let spans =
              IntMap.fromList (zip [0 ..] pairs)
         in Spline.generate (length pairs) (\i -> spanOf f (spans ! i))
      ss =
        toList
          ( MeasuredPolyarc.segments
              ( MeasuredPolyarc.fromFlatPolyarc
                  (CubicFit.approximate (Mm tolerance) (part (Vec.vec 1 0)) (part (Vec.vec 0 1)))
              )
          )
  _ -> discard
  where
    -- The cubic of 'hermite' in one coordinate.
    spanOf axis ((p, a, jump, _, out), (q, b, _, into, _)) =
      let chord = Vec.to p q
          p0 = Vec.dot axis (Vec.to (Vec.point 0 0) p)
          d = Vec.dot axis chord
          v = Vec.dot axis (Vec.polar (Mm (Vec.norm chord * out)) (Rad (a + jump)))
          w = Vec.dot axis (Vec.polar (Mm (Vec.norm chord * into)) (Rad b))
       in Spline.Cubic p0 v (3 * d - 2 * v - w) (v + w - 2 * d)

fewerLaw :: Int -> Int -> Int -> Property
fewerLaw found fewest slack =
  counterexample
    (show (found, fewest))
    (fromIntegral found <= (1.3 * fromIntegral fewest + fromIntegral slack :: Double))

-- | Least total cost of a chain of biarcs between 65 points of a curve, with a given cost of each
-- biarc.
fewestOf :: (NonEmpty Segment -> Int) -> Double -> ParametricCurve -> Int
fewestOf size tolerance t = leastCost (cheapest size tolerance t)

-- | Least number of biarcs in a chain between 65 points of a curve. Between the same points, every
-- biarc with the same start and an earlier end fits too.
fewestWithoutGaps :: Double -> ParametricCurve -> Int
fewestWithoutGaps tolerance t = leastCost (\i j -> if j <= reach ! i then Just 1 else Nothing)
  where
    fits i j = isJust (cheapest (const 1) tolerance t i j)
    reach =
      IntMap.fromList
        [(i, last (i : takeWhile (fits i) [i + 1 .. joints])) | i <- [0 .. joints - 1]]

-- | Number of the last one of the points between which biarcs are compared; the first one is 0.
joints :: Int
joints = 64

-- | Least total cost of a chain from point 0 to the last point. The function gives the cost from a
-- point to a later one, by their numbers; Nothing if no biarc joins them.
leastCost :: (Int -> Int -> Maybe Int) -> Int
leastCost costOf = best ! joints
  where
    best = IntMap.fromList (zip [0 ..] (0 : map upTo [1 .. joints])) :: IntMap Int
    upTo j = minimum (1000 : [best ! i + cost | i <- [0 .. j - 1], Just cost <- [costOf i j]])

-- | Least cost of a biarc between two of the points, which are given by their numbers. Nothing if
-- no biarc between them is within the tolerance.
cheapest :: (NonEmpty Segment -> Int) -> Double -> ParametricCurve -> Int -> Int -> Maybe Int
cheapest size tolerance t = between
  where
    us = IntMap.fromList (zip [0 ..] (parameters joints t))
    between i j =
      let from = (place t (us ! i), direction t Leaving (us ! i))
          to = (place t (us ! j), direction t Arriving (us ! j))
          inside =
            [ place t (us ! i + (us ! j - us ! i) * fromIntegral m / parts)
              | (parts, most) <- [(24, 23), (199, 198)],
                m <- [1 .. most :: Int]
            ]
          sizes =
            [ size b
              | r <- [0.5, 0.7, 1, 1.4, 2],
                Just b <- [Biarc.joinWith r from to],
                all (\p -> minimum (fmap (`apart` p) b) <= tolerance) inside
            ]
       in if null sizes then Nothing else Just (minimum sizes)
