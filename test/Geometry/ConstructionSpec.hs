-- | Intersections, tangents and fillets against the conditions that define them.
module Geometry.ConstructionSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Apart (away)
import Geometry.Carrier (Circle (Circle), Line (..), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.Fillet (Fillet (..))
import Geometry.Construction.Fillet qualified as Fillet
import Geometry.Construction.Intersection (Intersection (..))
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Construction.TangentLine qualified as TangentLine
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "intersections" $ do
    it "lie on both carriers, or the gap is right (catches a swapped radius)" $
      property $
        forAll ((,) <$> circle <*> circle) $ \(a@(Circle c1 (Mm r1)), b@(Circle c2 (Mm r2))) ->
          case Intersection.circles a b of
            Apart (Mm gap) ->
              gap
                > 0
                  .&&. property
                    (abs (max (away c1 c2 - r1 - r2) (abs (r1 - r2) - away c1 c2) - gap) < 1e-9)
            Touching p -> on a p .&&. on b p
            Crossing p q -> conjoin [on a p, on b p, on a q, on b q, property (away p q > 0)]
            CrossingOnce _ -> property False
            Same -> property False
    it
      "lie on both circles, even if one is almost a line (catches points that are computed from a \
      \distant centre)"
      $ property $
        forAll ((,,) <$> circle <*> choose (4, 8) <*> choose (-0.9, 0.9)) $
          \(b@(Circle c (Mm r)), power, share) ->
            forAll (choose (0, 2 * pi)) $ \angle ->
              let far = 10 ** power
                  distant = Vec.shift (Vec.polar (Mm (far + share * r)) (Rad angle)) c
                  a = Circle distant (Mm far)
                  near p = abs (away c p - r) < 1e-9 && abs (away distant p - far) < 1e-6
               in conjoin
                    [ counterexample (show (p, q)) (near p && near q)
                      | (one, other) <- [(a, b), (b, a)],
                        (p, q) <- case Intersection.circles one other of
                          Crossing p q ->
                            [(p, q)]
                          m -> error (show m)
                    ]
    it "of a line and a circle come in the order of the line (catches a lost sign)" $
      property $
        forAll ((,) <$> line <*> circle) $ \(l, c) -> case Intersection.lineCircle l c of
          Crossing p q ->
            conjoin
              [ on c p,
                on c q,
                onLine l p,
                onLine l q,
                property (Vec.dot (Carrier.direction l) (Vec.to p q) > 0)
              ]
          _ -> property True
    it "distinguish coincident, touching and concentric circles" $ do
      let c r = Circle (Vec.point 1 2) (Mm r)
      Intersection.circles (c 5) (c 5) `shouldBe` Same
      Intersection.circles (c 5) (c 7) `shouldBe` Apart (Mm 2)
      Intersection.circles (c 5) (Circle (Vec.point 9 2) (Mm 3)) `shouldBe` Touching (Vec.point 6 2)
      Intersection.circles (c 5) (Circle (Vec.point 3 2) (Mm 3)) `shouldBe` Touching (Vec.point 6 2)
  describe "tangents" $ do
    it "touch both circles in the direction of travel (catches a tangent on the wrong side)" $
      property $
        forAll ((,,,) <$> sense <*> circle <*> sense <*> circle) $ \(t1, a, t2, b) ->
          case TangentLine.directed (t1, a) (t2, b) of
            Nothing -> property (noTangent (t1, a) (t2, b))
            Just l ->
              touches (OnCircle t1 a) (from l) (Carrier.direction l)
                .&&. touches (OnCircle t2 b) (to l) (Carrier.direction l)
    it "are four for circles apart, two for crossing ones, none for one inside the other" $ do
      let far = Circle (Vec.point 20 0) (Mm 3)
      map (\d -> length (TangentLine.all (Circle (Vec.point d 0) (Mm 5)) far)) [0, 13, 19]
        `shouldBe` [4, 2, 0]
  describe "fillets" $
    it
      "touch both neighbours in the direction of travel, at their radius (catches an arc on the \
      \wrong side)"
      $ property $
        forAll ((,,,) <$> choose (0.5, 30) <*> sense <*> carrier <*> carrier) $ \(r, t, a, b) ->
          let found = Fillet.between (Mm r) t a b
           in classify (null found) "none" $
                conjoin
                  [ conjoin
                      [ counterexample
                          "radius"
                          ( abs (away middle start - r) < 1e-6
                              && abs (away middle end - r) < 1e-6
                          ),
                        touches a start (Segment.startDirection arc),
                        touches b end (Segment.endDirection arc)
                      ]
                    | Fillet {middle, start, end} <- found,
                      let arc = Segment.arc t middle start end,
                      away start end > 1e-3
                  ]

-- | The point lies on the carrier, and the direction of travel there is as given.
touches :: ElementCarrier -> Point -> Vec -> Property
touches w p direction = case w of
  OnLine l -> onLine l p .&&. same (Carrier.direction l)
  OnCircle t c@(Circle m _) ->
    on c p .&&. same (Vec.unit (Vec.scale (Carrier.senseSign t) (Vec.left (Vec.to m p))))
  AtPoint q -> property (away p q < 1e-6)
  OnCurve _ -> property False
  where
    same d = counterexample (show (direction, d)) (Vec.dot d direction > 1 - 1e-6)

-- | The signed radii differ by more than the distance of the centres: there is no tangent.
noTangent :: (Sense, Circle) -> (Sense, Circle) -> Bool
noTangent (t1, Circle c1 (Mm r1)) (t2, Circle c2 (Mm r2)) =
  away c1 c2 <= abs (Carrier.senseSign t1 * r1 - Carrier.senseSign t2 * r2) + 1e-6

on :: Circle -> Point -> Property
on (Circle c (Mm r)) p = counterexample (show (away c p, r)) (abs (away c p - r) < 1e-6)

onLine :: Line -> Point -> Property
onLine l p = let Mm d = Carrier.signedDistance l p in counterexample (show d) (abs d < 1e-6)

point :: Gen Point
point = Vec.point <$> choose (-40, 40) <*> choose (-40, 40)

circle :: Gen Circle
circle = Circle <$> point <*> (Mm <$> oneof [choose (0.01, 1), choose (1, 40)])

sense :: Gen Sense
sense = elements [Clockwise, CounterClockwise]

line :: Gen Line
line = do
  a <- point
  b <- point `suchThat` (\q -> away a q > 1)
  pure (Line a b)

carrier :: Gen ElementCarrier
carrier = oneof [OnLine <$> line, OnCircle <$> sense <*> circle]
