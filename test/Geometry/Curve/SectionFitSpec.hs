-- | Laws of sections through a table; each names the bug that it catches. The tests find the
-- optimum by trying all divisions of a table into sections. They find each section by
-- golden-section search for its one parameter.
module Geometry.Curve.SectionFitSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Data.Foldable (toList)
import Data.List (nub, sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Lazy qualified as Map
import Data.Maybe (fromMaybe)
import Geometry.Curve.Section
  ( PointTable,
    Section (..),
    SectionFormula (..),
    SectionKind (..),
    SectionShape (..),
  )
import Geometry.Curve.Section qualified as Section
import Geometry.Curve.SectionFit (SectionFault (..))
import Geometry.Curve.SectionFit qualified as SectionFit
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "sections through a table" $ do
    it
      "fit: every row is within the tolerance, and the sections join (catches a deviation that is \
      \measured at some rows only)"
      $ property $
        forAll ((,) <$> kinds <*> noisyTable 2 20) (uncurry withinLaw)
    it
      "fit: no other fit has fewer sections, or as many and a smaller deviation (catches a section \
      \that is given up too early)"
      $ withMaxSuccess 3000 $
        forAll ((,) <$> kinds <*> noisyTable 2 9) (uncurry bestLaw)
    it
      "fit: rows on one line, parabola or arc give it as the only section (catches the root on the \
      \other side of the circle)"
      $ property $
        forAll exactTable wholeLaw
    it
      "fit: the order in which the kinds are given does not matter (catches the first possible \
      \kind in place of the simplest)"
      $ property $
        forAll ((,) <$> kinds <*> noisyTable 2 12) $ \(ks, c) ->
          forAll (shuffle (toList ks <> take 1 (toList ks))) $ \again' ->
            fmap shape (fitted ks c)
              === maybe
                (pure (0, 0, LineKind))
                (fmap shape . (`fitted` c))
                (NonEmpty.nonEmpty again')
    it "fit: a section has the simplest possible kind (catches a parabola in place of a line)" $
      property $
        forAll ((,) <$> kinds <*> noisyTable 2 9) (uncurry simplestLaw)
    it "fit: moving or reversing a table keeps the count of sections (catches falling x)" $
      property $
        forAll ((,) <$> kinds <*> noisyTable 2 12) (uncurry movedLaw)
    it
      "fit: mirroring a table in y mirrors its sections (catches an arc that bends to one side \
      \only)"
      $ property $
        forAll ((,) <$> kinds <*> noisyTable 2 12) (uncurry mirroredLaw)
    it "the generator reaches lines, parabolas and arcs, with rising and falling x" $
      checkCoverage $
        forAll (noisyTable 2 12) $ \c ->
          let found = map (Section.kind . curve) (toList (fitted everyKind c))
           in cover 20 (LineKind `elem` found) "line" $
                cover 10 (ParabolaKind `elem` found) "parabola" $
                  cover 10 (ArcKind `elem` found) "arc" $
                    cover 20 (isFalling c) "falling" True
  describe "tables and sections" $ do
    it "a table whose x reverses or repeats is refused, and the fault names the row" $ do
      Section.table (map (uncurry Vec.point) [(0, 0), (1, 0), (2, 5), (1.5, 0)])
        `shouldBe` Left (Section.OutOfOrder 4)
      Section.table (map (uncurry Vec.point) [(0, 0), (-1, 0), (-1, 5)])
        `shouldBe` Left (Section.OutOfOrder 3)
      Section.table (map (uncurry Vec.point) [(0, 0), (0, 1)])
        `shouldBe` Left (Section.OutOfOrder 2)
      Section.table (map (uncurry Vec.point) [(0, 0), (1, 0 / 0), (0 / 0, 1)])
        `shouldBe` Left (Section.OutOfOrder 3)
      Section.table [Vec.point 0 0] `shouldBe` Left (Section.TooFewRows 1)
    it "sections that do not fit together are refused, and the fault names the section" $
      map
        (either Just (const Nothing) . SectionFit.sections template)
        [ [],
          [[1, 3], [3, 5, 8, 9], [8, 13]],
          [[1, 14]],
          [[3, 1]],
          [[1, 5, 3]],
          [[1, 3], [4, 13]],
          [[2, 13]],
          [[1, 3], [3, 8]]
        ]
        `shouldBe` map
          Just
          [ NoSections,
            WrongCount 2 4,
            NoSuchRow 1 14,
            RowsDoNotRise 1,
            RowsDoNotRise 1,
            NotJoined 2 4 3,
            NotJoined 1 2 1,
            EndsEarly 8 13
          ]
  describe "the template of the turbine blade" $ do
    it "has the coefficients of the paper, corrected" $
      fmap (map (coefficients . Section.formula) . toList) (SectionFit.sections template paper)
        `shouldBe` Right
          [(0, 63366, -17545), (-722596, 11707467, -27504988), (-460579, 8200501, -16220749)]
    it "has the deviations of the paper's tables" $
      fmap
        ( map (\d -> let Mm m = SectionFit.signedDeviation d in rounded 100 m)
            . SectionFit.deviations template
        )
        (SectionFit.sections template paper)
        `shouldBe` Right [0, 1, 0, 3, 0, 0, -2, 0, -2, 0, 1, 3, 0]
    it "deviates from its second point by 0.006" $
      fmap
        ( map (\d -> let Mm m = SectionFit.signedDeviation d in rounded 1000 m)
            . take 2
            . SectionFit.deviations template
        )
        (SectionFit.sections template paper)
        `shouldBe` Right [0, 6]
    it "needs three lines and parabolas within 0.03" $
      summary (LineKind :| [ParabolaKind])
        `shouldBe` ([(1, 3, LineKind), (3, 8, ParabolaKind), (8, 13, ParabolaKind)], 286)
    it "needs three sections even with arcs, with a slightly smaller deviation" $
      summary everyKind
        `shouldBe` ([(1, 4, ParabolaKind), (4, 8, ParabolaKind), (8, 13, ArcKind)], 271)
  where
    paper = [[1, 3], [3, 5, 8], [8, 10, 13]]
    rounded k m = round (m * k) :: Int
    coefficients f = case f of
      Polynomial a b c
        | a == 0 -> (0, rounded 1e5 b, rounded 1e3 c)
        | otherwise -> (rounded 1e8 a, rounded 1e7 b, rounded 1e6 c)
      Circle _ _ -> (0, 0, 0)
    summary ks =
      let ps =
            toList (SectionFit.fit ks (Mm 0.03) template)
       in (map shape ps, rounded 1e4 (maximum (map deviationInMm ps)))

everyKind :: NonEmpty SectionKind
everyKind = LineKind :| [ParabolaKind, ArcKind]

shape :: Section -> (Int, Int, SectionKind)
shape p = (first p, final p, Section.kind (curve p))

deviationInMm :: Section -> Double
deviationInMm p = let Mm d = largestDeviation p in d

template :: PointTable
template =
  tableOf
    [ Vec.point 25.40 (-1.45),
      Vec.point 30.38 1.70,
      Vec.point 35.50 4.95,
      Vec.point 39.98 7.72,
      Vec.point 44.95 10.52,
      Vec.point 47.33 11.72,
      Vec.point 49.51 12.77,
      Vec.point 53.81 14.57,
      Vec.point 57.83 15.82,
      Vec.point 61.65 16.83,
      Vec.point 65.48 17.72,
      Vec.point 69.48 18.49,
      Vec.point 70.85 18.76
    ]

tableOf :: [Point] -> PointTable
tableOf ps = case Section.table ps of
  Right t -> t
  Left _ -> template

-- Random tables ---------------------------------------------------------------------------------

-- | Rows and a tolerance in mm.
data Case = Case [Point] Double
  deriving stock (Show)

kinds :: Gen (NonEmpty SectionKind)
kinds = do
  some <- sublistOf [LineKind, ParabolaKind, ArcKind]
  pure (fromMaybe everyKind (NonEmpty.nonEmpty some))

-- | Rows of a curve that nearly consists of a few sections, some of them steep. x rises or falls.
noisyTable :: Int -> Int -> Gen Case
noisyTable low high = do
  n <- choose (low, high)
  steps <- vectorOf n (choose (0.2, 6))
  noise <- elements [0, 0.01, 0.1, 1]
  jitter <- vectorOf n (choose (-noise, noise))
  steep <- elements [0.1, 1, 5]
  f <- oneof [wave, bow, bow, broken]
  back <- arbitrary
  -- The noise is often as large as the tolerance. Then a longer section can succeed where a shorter
  -- one fails.
  tolerance <-
    oneof [elements [0.003, 0.03, 0.1, 0.3, 2], max 0.003 . (noise *) <$> choose (0.6, 1.5)]
  let xs = scanl1 (+) steps
      whole = sum steps
      rise x = f (x / whole) * whole * steep
      ps = zipWith (\x e -> Vec.point (if back then -x else x) (rise x + e)) xs jitter
  pure (Case ps tolerance)
  where
    wave = (\a k x -> a * sin (k * x)) <$> choose (0.05, 1) <*> choose (1, 8)
    bow =
      (\c s x -> s * sqrt (c * c - (x - 0.5) * (x - 0.5))) <$> choose (0.51, 2) <*> elements [1, -1]
    broken = (\k x -> abs (x - k)) <$> choose (0.2, 0.8)

isFalling :: Case -> Bool
isFalling (Case ps _) = case ps of
  a : b : _ -> Vec.x b < Vec.x a
  _ -> False

fitted :: NonEmpty SectionKind -> Case -> NonEmpty Section
fitted ks (Case ps tolerance) = SectionFit.fit ks (Mm tolerance) (tableOf ps)

-- Laws ------------------------------------------------------------------------------------------

withinLaw :: NonEmpty SectionKind -> Case -> Property
withinLaw ks c@(Case ps tolerance) =
  first (NonEmpty.head pieces) === 1
    .&&. final (NonEmpty.last pieces) === length ps
    .&&. conjoin
      ( zipWith
          (\a b -> (final a, to a) === (first b, from b))
          (toList pieces)
          (NonEmpty.tail pieces)
      )
    .&&. conjoin (map near (toList pieces))
    .&&. conjoin (map onSegment (toList pieces))
    .&&. map SectionFit.rowNumber deviations === [1 .. length ps]
    .&&. conjoin
      [ counterexample (show d) (abs m <= tolerance + 2e-9)
        | d <- deviations,
          let Mm m = SectionFit.signedDeviation d
      ]
    .&&. conjoin
      [ counterexample (show p) (Section.kind (curve p) `elem` ks || final p == first p + 1)
        | p <- toList pieces
      ]
  where
    pieces = fitted ks c
    deviations = SectionFit.deviations (tableOf ps) pieces
    rowsOf p = take (final p - first p + 1) (drop (first p - 1) ps)
    near p =
      let off = maximum [abs (equation p (Vec.x q) - Vec.y q) | q <- rowsOf p]
       in counterexample (show (p, off)) $
            off <= tolerance + 1e-6 && abs (off - deviationInMm p) < 1e-6
    -- Points on the segment of a line or an arc satisfy its equation.
    onSegment p = case Section.segment p of
      Nothing -> Section.kind (curve p) === ParabolaKind
      Just s ->
        conjoin
          [ counterexample
              (show (s, q))
              (abs (Section.height p (Vec.x q) - Vec.y q) < 1e-5 * (1 + abs (slope p)))
            | f <- [0.2, 0.5, 0.7],
              let q = Segment.at f s
          ]
    slope p = case curve p of
      Arc (Rad a) ->
        1
          / max
            1e-3
            ( cos
                ( abs a
                    + abs (atan ((Vec.y (to p) - Vec.y (from p)) / (Vec.x (to p) - Vec.x (from p))))
                )
            )
      _ -> 1

-- | y of a section from its equation; for a circle, on the branch of the arc.
equation :: Section -> Double -> Double
equation p x = case Section.formula p of
  Polynomial a b c -> (a * x + b) * x + c
  Circle m (Mm r) ->
    let h = sqrt (max 0 (r * r - (x - Vec.x m) * (x - Vec.x m)))
        above = case curve p of
          Arc (Rad t) -> t > 0
          _ -> True
     in if r > 1e5 then Section.height p x else if above then Vec.y m + h else Vec.y m - h

-- | Comparison with all divisions of a small table into sections, with every kind for each section.
bestLaw :: NonEmpty SectionKind -> Case -> Property
bestLaw ks c@(Case ps tolerance) =
  counterexample
    (show pieces)
    ( length pieces
        === fewest .&&. counterexample (show (worst', least)) (abs (worst' - least) < 1e-6)
    )
  where
    pieces = fitted ks c
    worst' = maximum (fmap deviationInMm pieces)
    splits = allSplits ks tolerance ps
    fewest = minimum (map length splits)
    least =
      minimum
        [maximum (map (\(_, _, ds) -> minimum (map snd ds)) s) | s <- splits, length s == fewest]

-- | No division of the table keeps the largest deviation with a smaller sum of ranks. The optimum
-- is known to 1e-5 only. The fit may therefore be the simplest division within that of the optimum.
-- It is compared only with divisions that are certainly as good: they contain the section with the
-- largest deviation, and no other section comes close to this deviation.
simplestLaw :: NonEmpty SectionKind -> Case -> Property
simplestLaw ks c@(Case ps tolerance) =
  counterexample
    (show pieces)
    (counterexample (show (low, found, high)) (low <= found && found <= high))
  where
    pieces = fitted ks c
    found = sum (map (fromEnum . Section.kind . curve) (toList pieces))
    bound = maximum (fmap deviationInMm pieces)
    splits =
      [ s
        | s <- allSplits ks tolerance ps,
          length s == length pieces,
          all (\(_, _, ds) -> any ((<= bound + 1e-5) . snd) ds) s
      ]
    low = minimum (map (sum . map (\(_, _, ds) -> simplest (bound + 1e-5) ds)) splits)
    high = minimum (100 : map (sum . map surely) splits)
    simplest most ds = minimum (100 : [fromEnum k | (k, d) <- ds, d <= most])
    surely (i, j, ds)
      | (i, j) `elem` decisive = maximum [fromEnum k | (k, d) <- ds, d <= bound + 1e-5]
      | otherwise = simplest (max 1e-9 (bound - 1e-5)) ds
    decisive = [(first p - 1, final p - 1) | p <- toList pieces, deviationInMm p == bound]

allSplits :: NonEmpty SectionKind -> Double -> [Point] -> [[(Int, Int, [(SectionKind, Double)])]]
allSplits ks tolerance ps = from' 0
  where
    final' = length ps - 1
    from' i
      | i == final' = [[]]
      | otherwise =
        [ (i, j, ds) : rest
          | j <- [i + 1 .. final'],
            Just ds <- [Map.lookup (i, j) known],
            not (null ds),
            rest <- from' j
        ]
    known = Map.fromList [((i, j), good (slice i j)) | i <- [0 .. final'], j <- [i + 1 .. final']]
    slice i j = take (j - i + 1) (drop i ps)
    good rows
      | length rows == 2 = [(LineKind, 0)]
      | otherwise =
        [(k, d) | k <- nub (sort (toList ks)), let d = leastDeviation k rows, d <= tolerance + 1e-9]

-- | Least possible largest deviation of a section of some kind through the first and the last row.
leastDeviation :: SectionKind -> [Point] -> Double
leastDeviation k rows = case k of
  LineKind -> largestOf (const 0)
  ParabolaKind -> goldenSection (-50) 50 (\a -> largestOf (\x -> a * (x - x1) * (x - x2)))
  ArcKind -> goldenSection (-limit) limit (\t -> largestOf (bulge t))
  where
    (x1, y1) = (Vec.x (head' rows), Vec.y (head' rows))
    (x2, y2) = (Vec.x (last' rows), Vec.y (last' rows))
    head' = foldr const (Vec.point 0 0)
    last' = foldl (const id) (Vec.point 0 0)
    lineAt x = y1 + (y2 - y1) * (x - x1) / (x2 - x1)
    largestOf extra =
      maximum
        [ abs (lineAt (Vec.x q) + extra (Vec.x q) - Vec.y q)
          | q <- drop 1 (take (length rows - 1) rows)
        ]
    limit = pi / 2 - atan (abs ((y2 - y1) / (x2 - x1)))
    -- Rise from the chord to the arc whose ends make the angle t with the chord.
    bulge t x
      | abs t < 1e-6 =
        let m = (y2 - y1) / (x2 - x1) in t * (x - x1) * (x2 - x) * (1 + m * m) / abs (x2 - x1)
      | otherwise =
        let chord = sqrt ((x2 - x1) * (x2 - x1) + (y2 - y1) * (y2 - y1))
            r = chord / 2 / sin (abs t)
            down = chord / 2 / tan (abs t)
            up = if x2 > x1 then 1 else -1
            (nx, ny) = (-(up * (y2 - y1) / chord), up * (x2 - x1) / chord)
            s = signum t
            (mx, my) = ((x1 + x2) / 2 - s * down * nx, (y1 + y2) / 2 - s * down * ny)
         in my + s * sqrt (max 0 (r * r - (x - mx) * (x - mx))) - lineAt x

-- | Minimum of a unimodal function by golden-section search.
goldenSection :: Double -> Double -> (Double -> Double) -> Double
goldenSection low high f = go (120 :: Int) low high
  where
    go k a b
      | k == 0 = f ((a + b) / 2)
      | f u <= f v = go (k - 1) a v
      | otherwise = go (k - 1) u b
      where
        u = a + 0.382 * (b - a)
        v = a + 0.618 * (b - a)

-- | A line, parabola or arc, and rows on it.
exactTable :: Gen (SectionFormula, SectionKind, [Point])
exactTable = do
  n <- choose (5, 30)
  steps <- vectorOf n (choose (0.2, 2))
  back <- arbitrary
  x0 <- choose (-50, 50)
  let xs = scanl1 (+) steps
      whole = sum steps
      put f = [Vec.point (x0 + side * x) (f (x0 + side * x)) | x <- xs]
      side = if back then -1 else 1
  oneof
    [ do
        (b, c) <- (,) <$> choose (-3, 3) <*> choose (-50, 50)
        pure (Polynomial 0 b c, LineKind, put (\x -> b * x + c)),
      do
        (a, b, c) <-
          (,,)
            <$> ((*) <$> elements [1, -1] <*> choose (0.01, 0.5))
              <*> choose (-3, 3)
              <*> choose (-50, 50)
        pure (Polynomial a b c, ParabolaKind, put (\x -> (a * x + b) * x + c)),
      do
        r <- (whole *) <$> choose (0.51, 1.5)
        m <- (x0 +) . (side *) <$> choose (whole - r + 1e-3, r)
        y0 <- choose (-50, 50)
        s <- elements [1, -1]
        pure
          ( Circle (Vec.point m y0) (Mm r),
            ArcKind,
            put (\x -> y0 + s * sqrt (max 0 (r * r - (x - m) * (x - m))))
          )
    ]

wholeLaw :: (SectionFormula, SectionKind, [Point]) -> Property
wholeLaw (f, k, ps) =
  classify True (show k) $ case SectionFit.fit everyKind (Mm 1e-6) (tableOf ps) of
    p :| [] ->
      Section.kind (curve p)
        === k .&&. counterexample (show (Section.formula p)) (same f (Section.formula p))
    more -> counterexample (show more) False
  where
    same one other = case (one, other) of
      (Polynomial a b c, Polynomial a' b' c') ->
        abs (a - a') < 1e-7 && abs (b - b') < 1e-5 && abs (c - c') < 1e-3
      (Circle m (Mm r), Circle m' (Mm r')) ->
        let Mm d =
              Vec.distance m m'
         in d < 1e-3 && abs (r - r') < 1e-3
      _ -> False

movedLaw :: NonEmpty SectionKind -> Case -> Property
movedLaw ks c@(Case ps tolerance) =
  forAll ((,) <$> choose (-100, 100) <*> choose (-100, 100)) $ \(dx, dy) ->
    conjoin
      [ alike (outcome (Case ps' tolerance)) (outcome c)
        | ps' <-
            [ map (Vec.shift (Vec.vec dx dy)) ps,
              reverse ps,
              [Vec.point (-(Vec.x p)) (Vec.y p) | p <- ps]
            ]
      ]
  where
    outcome c' =
      let pieces = fitted ks c' in (length pieces, maximum (fmap deviationInMm pieces))
    alike (n, d) (m, e) = n === m .&&. counterexample (show (d, e)) (abs (d - e) < 1e-7)

mirroredLaw :: NonEmpty SectionKind -> Case -> Property
mirroredLaw ks c@(Case ps tolerance) =
  fmap shape pieces
    === fmap shape flipped .&&. conjoin (zipWith turned (toList pieces) (toList flipped))
  where
    pieces = fitted ks c
    flipped = fitted ks (Case [Vec.point (Vec.x p) (-(Vec.y p)) | p <- ps] tolerance)
    turned a b = counterexample (show (a, b)) $ case (curve a, curve b) of
      (Line, Line) -> True
      (Parabola s, Parabola t) -> abs (s + t) < 1e-6
      (Arc (Rad s), Arc (Rad t)) -> abs (s + t) < 1e-6
      _ -> False
