-- | Laws of shifts: to where they move a curve, how several of them combine, and where they are too
-- large.
module Geometry.Curve.ShiftSpec (spec) where

import Base.Quantity (Mm (..), Rad (..), minus, plus, times)
import Data.Containers.ListUtils (nubOrd)
import Data.Foldable (toList)
import Data.List (sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.Maybe (isJust, isNothing)
import GHC.Exts qualified as Exts
import Generate.Curve qualified as Generate
import Geometry.Curve
  ( Approach (..),
    Curve,
    CurveFault (..),
    Distance (..),
    EndCondition (..),
    Growth (..),
    Joggle (..),
    Side (..),
    SpanShape (..),
  )
import Geometry.Curve qualified as Curve
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Curve.Column qualified as Column
import Geometry.Curve.Cusp (Cusp (..))
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Segment (Segment (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Linear.V2 (V2 (..))
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "a shift" $ do
    it
      "by a constant moves every point by this distance along the normal (catches a normal that is \
      \not of length 1)"
      $ property $
        forAll Generate.anyCurve $ \c ->
          forAll ((,,) <$> choose (-4, 4) <*> choose (-1, 1) <*> Generate.parameter) $
            \(h, mu, t) ->
              let u = Generate.parameterOf c t
                  out =
                    displacement
                      c
                      u
                      (Curve.shifted LeftOf (Square (constantColumn mu c) (Constant (Mm h))) c)
               in alike 1e-6 out (Vec.scale (h / cos mu) (Curve.normal c u))
    it "stays at its distance from the curve (catches a distance along y)" $
      property $
        forAll Generate.gentle $ \c ->
          forAll ((,) <$> choose (-0.5, 0.5) <*> Generate.parameter) $ \(k, t) ->
            let h = min 10 (abs k / Generate.tightest c) * signum k
                p = Curve.at (Curve.shifted LeftOf (Constant (Mm h)) c) (Generate.parameterOf c t)
                Mm near = Vec.distance p (Curve.at c (Curve.nearest p c))
             in counterexample (show (h, near)) (abs (near - abs h) < 1e-6)
    it
      "has the distances of the table at its rows (catches μ in degrees, or a cosine that \
      \multiplies)"
      $ property $
        forAll Generate.anyCurve $ \c ->
          forAll
            ((,,) <$> Generate.columnOf c (-0.8) 0.8 <*> Generate.columnOf c 1 9 <*> choose (-2, 2))
            $ \(mu, h, delta) ->
              conjoin
                [ near' 1e-9 d (height * tan m + delta) .&&. near' 1e-9 d' (height / cos m)
                  | (row, m, height) <-
                      zip3
                        (toList (BasisCurve.rows (Curve.base c)))
                        (toList (Column.values mu))
                        (toList (Column.values h)),
                    let u = BasisCurve.at row,
                    let Mm d =
                          Curve.shiftDistance (Curve.shifted LeftOf (Bevelled mu h (Mm delta)) c) u,
                    let Mm d' =
                          Curve.shiftDistance (Curve.shifted LeftOf (Square mu (Pointwise h)) c) u
                ]
    it "grows in proportion to arc length (catches a growth by the parameter)" $
      property $
        forAll Generate.anyCurve $ \c ->
          forAll ((,,) <$> choose (-4, 4) <*> choose (-4, 4) <*> Generate.parameter) $
            \(h1, h2, t) ->
              let u = Generate.parameterOf c t
                  grown =
                    Curve.shifted
                      LeftOf
                      (Growing Growth {from = Mm h1, to = Mm h2, between = Nothing})
                      c
                  share = chordSum c 0 u / chordSum c 0 (Curve.domain c)
               in alike
                    1e-5
                    (displacement c u grown)
                    (Vec.scale (h1 + (h2 - h1) * share) (Curve.normal c u))
    it
      "that grows between two points is constant before and after them (catches ends that are \
      \exchanged)"
      $ property $
        forAll Generate.gentle $ \c ->
          forAll
            ( (,,,,)
                <$> choose (1, 3)
                  <*> choose (4, 6)
                  <*> choose (0.05, 0.4)
                  <*> choose (0.5, 0.95)
                  <*> Generate.parameter
            )
            $ \(h1, h2, a, b, t) ->
              let ua = Generate.parameterOf c a
                  ub = Generate.parameterOf c b
                  u = Generate.parameterOf c t
                  Mm d =
                    Curve.shiftDistance
                      ( Curve.shifted
                          RightOf
                          (Growing Growth {from = Mm h1, to = Mm h2, between = Just (ua, ub)})
                          c
                      )
                      u
                  expected
                    | u <= ua = h1
                    | u >= ub = h2
                    | otherwise = h1 + (h2 - h1) * chordSum c ua u / chordSum c ua ub
               in near' 1e-5 (-d) expected
    it
      "that varies does not tear apart a curve that was shifted twice before (catches normals that \
      \jump at a slight corner)"
      $ property $
        forAll Generate.smooth $ \c ->
          forAll (varying c >>= varying >>= \twice -> (,) twice <$> varying twice) $
            \(twice, thrice) ->
              let slight = Generate.slightCorners twice
                  shiftedBy u = Vec.distance (Curve.at twice u) (Curve.at thrice u)
                  asked u = abs (let Mm d = Curve.shiftDistance thrice u in d)
               in cover 50 (not (null slight)) "slight corners" $
                    conjoin
                      [ counterexample (show u) (gapAt thrice u <= Tolerance.coincident)
                          .&&. near' 1e-9 (let Mm d = shiftedBy u in d) (asked u)
                        | u <- slight
                      ]
    it
      "stays at its distance beside the corners of a change between two points (catches a part \
      \that is not cut off at a corner)"
      $ property $
        forAll Generate.gentle $ \c ->
          forAll
            ( (,,,,,)
                <$> choose (0.05, 0.4)
                  <*> choose (0.5, 0.95)
                  <*> choose (-1, 1)
                  <*> choose (-1, 1)
                  <*> Generate.parameter
                  <*> choose (0.2, 0.8)
            )
            $ \(a, b, h1, h2, t, k) ->
              let room = min 10 (1 / (1e-9 + Generate.tightest c))
                  ends = (Generate.parameterOf c a, Generate.parameterOf c b)
                  scaledBy x = Mm (0.3 * room * x)
                  growth = Growth {from = scaledBy h1, to = scaledBy h2, between = Just ends}
                  lower = Curve.shifted LeftOf (Growing growth) c
                  h = 0.3 * room * k
                  turned =
                    [ abs x
                      | u <- Curve.corners lower,
                        let Rad x =
                              Vec.signedAngle
                                (Curve.tangentFrom Before lower u)
                                (Curve.tangentFrom After lower u)
                    ]
                  sharpest = maximum (0 : turned)
                  by side = Curve.shifted side (Constant (Mm h)) lower
                  farthest = h / cos (sharpest / 2) * (1 + 0.1 * sharpest) + 1e-6
                  law side =
                    let s = by side
                        p = Curve.at s (Generate.parameterOf s t)
                        Mm d = Vec.distance p (Curve.at lower (Curve.nearest p lower))
                     in counterexample (show (h, d, sharpest)) $
                          all ((<= Tolerance.coincident) . gapAt s) (Curve.corners lower)
                            && d >= h - 1e-6
                            && d <= farthest
               in isNothing (Curve.firstCusp lower) && sharpest < 0.3
                    ==> conjoin [law s | s <- [LeftOf, RightOf], isNothing (Curve.firstCusp (by s))]
    it "that grows between two points has corners there (catches a curve without breaks there)" $
      property $
        forAll Generate.gentle $ \c ->
          forAll ((,) <$> choose (0.05, 0.4) <*> choose (0.5, 0.95)) $ \(a, b) ->
            let ends = (Generate.parameterOf c a, Generate.parameterOf c b)
             in Curve.corners
                  ( Curve.shifted
                      LeftOf
                      (Growing Growth {from = Mm 0, to = Mm 0.5, between = Just ends})
                      c
                  )
                  === [fst ends, snd ends]
    it
      "its derivatives are those of its points, through all layers (catches a missing order, and a \
      \missing term of a product)"
      $ property $
        forAll (Generate.layered 3 Generate.anyCurve) $ \c ->
          forAll (choose (0.05, 0.95)) $ \share ->
            forAll (elements (smoothStretches c)) $ \(a, b) ->
              derivativesLaw c (a + (b - a) * share) (0.01 * (b - a))
    it "its curvature is that of a circle through three near points (catches a wrong sign)" $
      property $
        forAll (Generate.layered 2 Generate.gentle) $ \c ->
          forAll (choose (0.05, 0.95)) $ \share ->
            forAll (elements (smoothStretches c) `suchThat` \(a, b) -> b - a > 0.01) $ \(a, b) ->
              -- On shorter stretches, rounding dominates the circle through three points.
              let u = a + (b - a) * share
                  e = 1e-3 * (b - a)
                  k = circleCurvature (Curve.at c (u - e)) (Curve.at c u) (Curve.at c (u + e))
               in near' (1e-4 * (1 + abs k)) (Curve.curvature c u) k

  describe "shifts in sequence" $ do
    it
      "by a and then by b are one shift by a + b (catches a normal of the curve below)"
      $ property $
        forAll Generate.smooth $ \c ->
          forAll
            ((,,,) <$> radiusShare <*> radiusShare <*> choose (-0.8, 0.8) <*> Generate.parameter)
            $ \(ka, kb, mu, t) ->
              let reach = cos mu / (1e-6 + Generate.tightest c)
                  a = ka * min 10 reach
                  b = kb * min 10 reach
                  by h = Curve.shifted LeftOf (Square (constantColumn mu c) (Constant (Mm h)))
                  u = Generate.parameterOf c t
               in close 1e-6 (Curve.at (by b (by a c)) u) (Curve.at (by (a + b) c) u)
    it
      "by the cipher 2, 4, 1 agree with each shift computed from differences (catches layers in \
      \the wrong order)"
      $ property $
        forAll Generate.gentle $ \c ->
          forAll ((,) <$> Generate.columnOf c 0.1 0.4 <*> Generate.columnOf c 1 3) $ \(mu, h) ->
            forAll (elements (toList (BasisCurve.rows (Curve.base c)))) $ \row ->
              sequenceLaw c mu h (BasisCurve.at row)

  describe "equivalent shifts" $ do
    it "a growth from h to h is the constant h (catches a growth that begins with the difference)" $
      property $
        forAll Generate.anyCurve $ \c -> forAll (choose (-4, 4)) $ \h ->
          sameShift c (Growing Growth {from = Mm h, to = Mm h, between = Nothing}) (Constant (Mm h))
    it
      "a column of equal values is a constant, exactly (catches a spline that oscillates)"
      $ property $
        forAll Generate.anyCurve $ \c ->
          forAll (choose (-4, 4)) $ \h -> forAll Generate.parameter $ \t ->
            let shiftedBy d = Curve.at (Curve.shifted LeftOf d c) (Generate.parameterOf c t)
                p = shiftedBy (Pointwise (constantColumn h c))
             in isNumber p ==> p === shiftedBy (Constant (Mm h))
    it "zero bevel and zero allowance are no shift" $
      property $
        forAll Generate.anyCurve $ \c -> forAll (Generate.columnOf c 1 9) $ \h ->
          sameShift c (Bevelled (constantColumn 0 c) h (Mm 0)) (Constant (Mm 0))
    it
      "a shift to the right is one to the left by the negative distance (catches a side that is \
      \ignored)"
      $ property $
        forAll Generate.anyCurve $ \c ->
          forAll ((,) <$> Generate.distance 3 c <*> Generate.parameter) $ \(d, t) ->
            let u = Generate.parameterOf c t
                right = displacement c u (Curve.shifted RightOf d c)
                left = displacement c u (Curve.shifted LeftOf d c)
             in alike 1e-9 right (Vec.negate left)

  describe "a joggle" $ do
    it
      "is 0 outside its interval, its depth in the middle, and continuous (catches a ramp that \
      \runs backwards)"
      $ property $
        forAll Generate.gentle $ \c ->
          forAll
            ( (,,,)
                <$> choose (0.05, 0.2)
                  <*> choose (0.8, 0.95)
                  <*> choose (0.2, 1)
                  <*> choose (0.55, 2)
            )
            $ \(a, b, d, k) ->
              let ua = Generate.parameterOf c a
                  ub = Generate.parameterOf c b
                  joggle = Joggle {begins = ua, ends = ub, depth = Mm d, radius = Mm (k * d)}
                  middle =
                    Curve.parameterAtLength
                      c
                      (times 0.5 (plus (Curve.lengthAt c ua) (Curve.lengthAt c ub)))
               in case Curve.fitJoggle joggle c of
                    Left flaw ->
                      label
                        "does not fit"
                        ( flaw
                            === LongJoggle
                              (times 2 (Curve.ramp joggle))
                              (minus (Curve.lengthAt c ub) (Curve.lengthAt c ua))
                        )
                    Right distance ->
                      let s = Curve.shifted LeftOf distance c
                          at u = let Mm v = Curve.shiftDistance s u in v
                       in near' 1e-12 (at (0.5 * ua)) 0
                            .&&. near' 1e-12 (at (0.5 * (ub + Curve.domain c))) 0
                            .&&. near' 1e-9 (at middle) d
                            .&&. conjoin
                              [ close 1e-6 (Curve.pointFrom Before s u) (Curve.pointFrom After s u)
                                | u <- Curve.breaks s
                              ]
                            .&&. Curve.corners s === []
    it
      "on a straight line has ramps of two arcs, each half of the depth (catches a wrong length of \
      \the ramp)"
      $ property $
        forAll ((,) <$> choose (0.5, 3) <*> choose (0.6, 4)) $ \(d, k) ->
          forAll (elements [1, -1]) $ \flip' -> forAll (choose (0.01, 0.99)) $ \t ->
            let r = k * d
                c = Generate.ok (Curve.polyline (Exts.fromList [Vec.point 0 0, Vec.point 100 0]))
                joggle = Joggle {begins = 0.1, ends = 0.9, depth = Mm (flip' * d), radius = Mm r}
                s = Curve.shifted LeftOf (Generate.ok (Curve.fitJoggle joggle c)) c
                Mm l = Curve.ramp joggle
                pointAt x = Curve.at s (x / 100)
                lowCentre = Vec.point 10 (flip' * r)
                highCentre = Vec.point (10 + l) (flip' * (d - r))
                on centre p = let Mm v = Vec.distance centre p in near' 1e-9 v r
             in on lowCentre (pointAt (10 + t * l / 2))
                  .&&. on highCentre (pointAt (10 + l / 2 + t * l / 2))
                  .&&. near' 1e-9 (Vec.y (pointAt (10 + l / 2))) (flip' * d / 2)
                  .&&. near' 1e-9 (Vec.y (pointAt (90 - l / 2))) (flip' * d / 2)
                  .&&. on (Vec.point 90 (flip' * r)) (pointAt (90 - t * l / 2))
    it "does not fit when its radius is too small, or its ramps too long" $ do
      let c = Generate.ok (Curve.polyline (Exts.fromList [Vec.point 0 0, Vec.point 100 0]))
          joggle d r = Joggle {begins = 0.4, ends = 0.6, depth = Mm d, radius = Mm r}
      Curve.fitJoggle (joggle 2 1) c `shouldBe` Left DeepJoggle
      Curve.fitJoggle (joggle 2 14) c
        `shouldBe` Left (LongJoggle (times 2 (Curve.ramp (joggle 2 14))) (Mm 20))

  describe "shifts that do not fit" $ do
    it
      "the vertex of a parabola y = x²/2p can be shifted inwards by p at most (catches a cusp \
      \between two rows)"
      $ property $
        forAll ((,,) <$> choose (2, 30) <*> choose (-0.4, -0.05) <*> choose (0.05, 0.4)) $
          \(p, left, right) ->
            forAll (choose (0.5, 2)) $ \k ->
              let c =
                    Generate.ok
                      ( Curve.fromShapes
                          (Quadratic (1 / (2 * p)) 0 0 (left * p) (right * p) :| [])
                          (Exts.fromList [0, 1])
                      )
                  found = Curve.firstCusp (Curve.shifted LeftOf (Constant (Mm (k * p))) c)
               in abs (k - 1) > 1e-6 ==> case found of
                    Nothing -> property (k < 1)
                    Just f ->
                      counterexample (show f) (k > 1)
                        .&&. near' 1e-6 (mm (curvatureRadius f)) p
                        .&&. near' 1e-9 (mm (requested f)) (k * p)
                        .&&. close 1e-4 (place f) (Vec.point 0 0)
    it
      "a cusp is found if and only if a distance exceeds the radius of curvature (catches a layer \
      \that is not tested)"
      $ property $
        forAll (Generate.layered 1 (oneof [Generate.ring, Generate.gentle])) $ \c ->
          forAll (choose (0.5, 2)) $ \k ->
            let most =
                  maximum
                    [ Curve.curvature c (a + (b - a) * t / 200)
                      | (a, b) <- smoothStretches c,
                        t <- [0.001, 1 .. 200]
                    ]
                distance = k / most
                above =
                  Curve.shifted
                    RightOf
                    (Constant (Mm 0.01))
                    (Curve.shifted LeftOf (Constant (Mm distance)) c)
             in most > 1e-3
                  && abs (k - 1)
                    > 0.01
                      ==> counterexample
                        (show (most, Curve.firstCusp above))
                        (isJust (Curve.firstCusp above) == (k > 1))
    it "there is no cusp on the outer side" $
      property $
        forAll (choose (0.1, 90)) $ \h ->
          isNothing (Curve.firstCusp (Curve.shifted RightOf (Constant (Mm h)) (circle 40)))
            && isJust (Curve.firstCusp (Curve.shifted LeftOf (Constant (Mm (41 + h))) (circle 40)))
    it "a curve that reverses its direction allows no shift at the reversal" $
      Curve.firstCusp
        ( Curve.shifted
            LeftOf
            (Constant (Mm 1))
            ( Generate.ok
                ( Curve.spline
                    Natural
                    (Exts.fromList [Vec.point 0 0, Vec.point 10 0, Vec.point 0 0])
                )
            )
        )
        `shouldSatisfy` isJust

  describe "columns" $ do
    it "have their values at the rows (catches the next row's value)" $
      property $
        forAll Generate.anyCurve $ \c -> forAll (Generate.columnOf c (-5) 5) $ \col ->
          conjoin
            [ near' 1e-9 d v
              | (row, v) <-
                  zip (toList (BasisCurve.rows (Curve.base c))) (toList (Column.values col)),
                let Mm d =
                      Curve.shiftDistance
                        (Curve.shifted LeftOf (Pointwise col) c)
                        (BasisCurve.at row)
            ]
    it
      "are as smooth as the points: a shifted spline has no corner (catches a column that is \
      \straight from row to row)"
      $ property $
        forAll (oneof [Generate.gentle, Generate.ring]) $ \c ->
          forAll (Generate.columnOf c 0 2) $ \col ->
            let s = Curve.shifted RightOf (Pointwise col) c
             in isNothing (Curve.firstCusp s) ==> Curve.corners s === Curve.corners c
    it "change in proportion to arc length on tangent spans (catches a column by the parameter)" $
      property $
        forAll tangentSpans $ \c ->
          forAll (Generate.columnOf c 0 2) $ \col -> forAll (elements [1, 2]) $ \u ->
            let s = Curve.shifted LeftOf (Pointwise col) c
                rate approach =
                  Vec.dot (velocity approach s) (Vec.left (Curve.tangentFrom approach c u))
                    / Vec.norm (velocity approach c)
                velocity approach curve =
                  let V2 a b =
                        Curve.expansion approach 1 curve u
                   in Vec.vec (PowerSeries.coefficient 1 a) (PowerSeries.coefficient 1 b)
             in near' 1e-9 (rate Before) (rate After)

-- Helpers -----------------------------------------------------------------------------------

-- | The distance between both sides of a curve at a parameter. At the start of a closed curve the
-- end is the other side.
gapAt :: Curve -> Double -> Mm
gapAt curve u = Vec.distance (Curve.pointFrom Before curve arrival) (Curve.pointFrom After curve u)
  where
    arrival = if u <= 0 then Curve.domain curve else u

-- | Displacement from a point of a curve to the point of its shift.
displacement :: Curve -> Double -> Curve -> Vec
displacement c u s = Vec.to (Curve.at c u) (Curve.at s u)

-- | Column with the same value for every row.
constantColumn :: Double -> Curve -> Curve.Column
constantColumn v c =
  Curve.column c (Exts.fromList (map (const v) (toList (BasisCurve.rows (Curve.base c)))))

-- | Law that two distances give the same shifted curve.
sameShift :: Curve -> Distance -> Distance -> Property
sameShift c d e = forAll (elements [LeftOf, RightOf]) $ \side -> forAll Generate.parameter $ \t ->
  let u =
        Generate.parameterOf c t
   in close 1e-9 (Curve.at (Curve.shifted side d c) u) (Curve.at (Curve.shifted side e c) u)

-- | Share of the radius of curvature by which a curve can be shifted twice in sequence.
radiusShare :: Gen Double
radiusShare = choose (-0.4, 0.4)

-- | Stretches of a curve over which no formula changes. On a curve of lines and arcs, the formulas
-- of columns change at the rows.
smoothStretches :: Curve -> [(Double, Double)]
smoothStretches c =
  let bs =
        nubOrd
          (sort (Curve.breaks c <> map BasisCurve.at (toList (BasisCurve.rows (Curve.base c)))))
   in filter (\(a, b) -> b - a > 1e-6) (zip bs (drop 1 bs))

-- | The first and the second derivative at a parameter equal the Richardson extrapolation of
-- difference quotients.
derivativesLaw :: Curve -> Double -> Double -> Property
derivativesLaw c u e =
  alike (1e-4 * (1 + Vec.norm first)) first byFirst
    .&&. alike (1e-2 * (1 + Vec.norm second + Vec.norm first)) second bySecond
  where
    V2 a b = Curve.expansion After 2 c u
    first = Vec.vec (PowerSeries.coefficient 1 a) (PowerSeries.coefficient 1 b)
    second = Vec.scale 2 (Vec.vec (PowerSeries.coefficient 2 a) (PowerSeries.coefficient 2 b))
    byFirst =
      refined (\h -> Vec.scale (1 / (2 * h)) (Vec.to (Curve.at c (u - h)) (Curve.at c (u + h))))
    bySecond =
      refined
        ( \h ->
            Vec.scale
              (1 / (h * h))
              ( Vec.add
                  (Vec.to (Curve.at c u) (Curve.at c (u - h)))
                  (Vec.to (Curve.at c u) (Curve.at c (u + h)))
              )
        )
    refined f = Vec.add (Vec.scale (4 / 3) (f (e / 2))) (Vec.scale (-1 / 3) (f e))

-- | Curvature of the circle through three points, positive to the left.
circleCurvature :: Point -> Point -> Point -> Double
circleCurvature p q r = 2 * Vec.cross (Vec.to p q) (Vec.to q r) / (norm p q * norm q r * norm p r)
  where
    norm s t = Vec.norm (Vec.to s t)

-- | A constant, a bevelled and a growing shift in sequence move a point as far as shifts along
-- normals that are computed from difference quotients of the curve below.
sequenceLaw :: Curve -> Curve.Column -> Curve.Column -> Double -> Property
sequenceLaw c mu h u = close 1e-4 (Curve.at third u) expected
  where
    first = Curve.shifted LeftOf (Constant (Mm 0.5)) c
    second = Curve.shifted RightOf (Bevelled mu h (Mm 0.2)) first
    third =
      Curve.shifted LeftOf (Growing Growth {from = Mm 0.3, to = Mm 0.9, between = Nothing}) second
    step curve d from' = Vec.shift (Vec.scale d (Vec.left (byDifference curve))) from'
    byDifference curve =
      let e = 1e-5
          lower = max 0 (u - e)
          upper = min (Curve.domain curve) (u + e)
       in Vec.unit (Vec.to (Curve.at curve lower) (Curve.at curve upper))
    value col =
      head
        ( [ v
            | (row, v) <-
                zip (toList (BasisCurve.rows (Curve.base c))) (toList (Column.values col)),
              BasisCurve.at row == u
          ]
            <> [0]
        )
    grown = 0.3 + 0.6 * chordSum second 0 u / chordSum second 0 (Curve.domain second)
    expected =
      step second grown (step first (-(value h * tan (value mu) + 0.2)) (step c 0.5 (Curve.at c u)))

-- | Arc length between two parameters: Richardson extrapolation of two chord sums.
chordSum :: Curve -> Double -> Double -> Double
chordSum c from' to' =
  sum [stretch (max a from') (min b to') | (a, b) <- smoothStretches c, a < to', b > from']
  where
    stretch a b = let fine = chords a b 400 in fine + (fine - chords a b 200) / 3
    chords a b n =
      let pointAt k =
            if k == n
              then Curve.pointFrom Before c b
              else Curve.at c (a + (b - a) * fromIntegral k / fromIntegral n)
       in sum [mm (Vec.distance (pointAt k) (pointAt (k + 1))) | k <- [0 .. n - 1 :: Int]]

-- | A line, an arc and a line, each tangent to the next.
tangentSpans :: Gen Curve
tangentSpans = do
  r <- choose (10, 40)
  sweep <- choose (0.3, 1.5)
  let centre = Vec.point 20 r
      p = Vec.point 20 0
      q = Vec.shift (Vec.rotate (Rad sweep) (Vec.to centre p)) centre
  pure
    ( Generate.ok
        ( Curve.fromSegments
            ( Straight (Vec.point 0 0) p
                :| [ Arc {start = p, end = q, centre, sweep = Rad sweep},
                     Straight q (Vec.shift (Vec.polar (Mm 15) (Rad sweep)) q)
                   ]
            )
        )
    )

circle :: Double -> Curve
circle r =
  Generate.ok
    ( Curve.fromSegments
        ( Arc
            { start = Vec.point r 0,
              end = Vec.point r 0,
              centre = Vec.point 0 0,
              sweep = Rad (2 * pi)
            }
            :| []
        )
    )

isNumber :: Point -> Bool
isNumber p = not (isNaN (Vec.x p + Vec.y p))

mm :: Mm -> Double
mm (Mm v) = v

near' :: Double -> Double -> Double -> Property
near' tolerance a b = counterexample (show (a, b)) (abs (a - b) <= tolerance)

close :: Double -> Point -> Point -> Property
close tolerance p q = counterexample (show (p, q)) (Vec.distance p q <= Mm tolerance)

alike :: Double -> Vec -> Vec -> Property
alike tolerance v w =
  counterexample (show (v, w)) (Vec.norm (Vec.add v (Vec.negate w)) <= tolerance)

-- | A curve, shifted by a distance with one value for each row of its table.
varying :: Curve -> Gen Curve
varying c = do
  d <- Generate.columnOf c 0 (min 5 (0.3 / (1e-9 + Generate.tightest c)))
  side <- elements [LeftOf, RightOf]
  pure (Curve.shifted side (Pointwise d) c)
