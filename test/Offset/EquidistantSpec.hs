-- | The laws of the equidistant. Each says which bug it would catch.
module Offset.EquidistantSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Base.Quantity qualified as Quantity
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Generate (Case (..), Motion (..))
import Generate qualified
import Geometry.Carrier (Circle (Circle), Sense (..), Side (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Elementwise qualified as Elementwise
import Offset.Equidistant (Cause (..), Obstacle (..), OffsetSegment (..), Origin (..))
import Offset.Equidistant qualified as Equidistant
import Offset.ReachableSpec qualified as Reachable
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "laws of the equidistant" $ do
    it
      "distance: every point is at the cutter's radius from the contour (catches an arc that \
      \runs the other way)"
      $ property $
        forAll Generate.closedCase distanceLaw
    it
      "agreement: the path equals the offset made element by element, segment for segment (catches \
      \a lost segment, or one with the wrong element)"
      $ property $
        forAll anyContour $ \(contour', side', radius') ->
          forAll styles (agreementLaw contour' side' radius')
    it "distance, open contours (catches an open path that is closed)" $
      property $
        forAll Generate.openCase distanceLaw
    it
      "clearance: no segment of the path is nearer to any element than the radius (catches an arc \
      \that continues beyond its end)"
      $ property $
        forAll Generate.closedCase clearanceLaw
    it
      "continuity: every segment begins where the one before ends, also the first of a closed path \
      \(catches a missing corner arc)"
      $ property $
        forAll Generate.closedCase continuityLaw
    it
      "reversal: the path on the other side of the reversed contour is the reversed path (catches \
      \a side that depends on the sense of an arc)"
      $ property $
        forAll Generate.closedCase reversalLaw
    it
      "motion: a translated, rotated or mirrored contour has the translated, rotated or mirrored \
      \path (catches a formula that depends on the axes)"
      $ property $
        forAll Generate.closedCase $ \c -> forAll Generate.motion (motionLaw c)
    it
      "length: outside of a closed contour it is L + 2πR, inside L − 2πR, where L is the contour's \
      \length (catches an arc in the wrong sense)"
      $ property $
        forAll Generate.smoothCase lengthLaw
    it "covers contours with arcs of both senses, with corners, and cutters on both sides" $
      checkCoverage $
        forAll Generate.closedCase $ \c ->
          cover
            25
            (hasBothSenses c)
            "both senses"
            (cover 25 (any isCorner (pieces c)) "corner" (cover 25 (side c == LeftOf) "left" True))
    it "length, contours with corners (catches a corner arc of another radius or sweep)" $
      property $
        forAll Generate.closedCase $ \c -> not (hasSlightCorner c) ==> lengthLaw c
    it
      "slight inner corners: the offsets of two arcs, or of an arc and a line, meet at the radius \
      \from both (catches arcs that are cut like lines)"
      $ property slightCornerLaw
  describe "obstacles" $ do
    it
      "the largest cutter that fits does fit, and one a little larger does not (catches a \
      \bisection that stops early)"
      $ property $
        forAll (Generate.contour <$> Generate.closedCase) $ \c ->
          forAll (elements [LeftOf, RightOf]) (largestLaw c)
    it "a concave arc with a radius below the cutter's is reported" $
      causeOf LeftOf 6 (circle CounterClockwise 5) `shouldBe` Just (Concave 0 (Mm 5), 5)
    it "a cutter that just fits into a circle does not move in it" $
      fmap (fmap segmentLength) (Equidistant.equidistant LeftOf (Mm 5) (circle CounterClockwise 5))
        `shouldBe` Right (0 :| [])
    it "an inner corner is reported, and no cutter fits" $
      fmap fst (causeOf LeftOf 2 square) `shouldBe` Just (InnerCorner 0 1 (Vec.point 10 0))
    it "a slot 8 mm wide, whose walls are far apart along the contour, stops a cutter of 10 mm" $
      causeOf RightOf 5 keyhole `shouldSatisfy` \case
        Just (Collision {}, fits) -> abs (fits - 4) < 1e-5
        _ -> False
    it "the last element of an open contour stops a cutter at the start of the contour" $
      causeOf LeftOf 14 hook `shouldSatisfy` \case
        -- The contour's end is then as far from the cutter's centre as the contour's start.
        Just (Collision 0 2 _, fits) -> abs (fits - 12.33589) < 1e-4
        _ -> False
    it "a cutter of 8 mm enters a slot 8 mm wide" $
      causeOf RightOf 4 keyhole `shouldBe` Nothing
    it "a radius of 0 gives the contour itself" $
      fmap (fmap segment) (Equidistant.equidistant LeftOf (Mm 0) square)
        `shouldBe` Right (segments square)

samples :: Segment -> [Point]
samples s = [Segment.at t s | t <- [0, 0.13, 0.5, 0.77, 1]]

distanceLaw :: Case -> Property
distanceLaw c = conjoin (map near (concatMap (samples . segment) (NonEmpty.toList (pieces c))))
  where
    near p =
      let Mm d =
            minimum (fmap (Distance.toPoint p) (segments (contour c)))
       in counterexample (show (p, d)) (abs (d - Generate.radiusOf c) < 1e-6)

clearanceLaw :: Case -> Property
clearanceLaw c =
  conjoin
    [ counterexample (show (p, s, d)) (d > Generate.radiusOf c - 1e-6)
      | p <- NonEmpty.toList (pieces c),
        s <- NonEmpty.toList (segments (contour c)),
        let Mm d = Distance.distance (Distance.segments (segment p) s)
    ]

continuityLaw :: Case -> Property
continuityLaw c =
  conjoin (zipWith joined ps (drop 1 ps <> take 1 ps)) .&&. conjoin (map onCircle ps)
  where
    ps = map segment (NonEmpty.toList (pieces c))
    joined a b = Segment.end a === Segment.start b
    -- Both ends of an arc lie on its circle, a sweep apart.
    onCircle s = case s of
      Straight _ _ -> property True
      Arc {start, end, centre, sweep} ->
        counterexample
          (show s)
          (apart (Vec.shift (Vec.rotate sweep (Vec.to centre start)) centre) end < 1e-6)

reversalLaw :: Case -> Property
reversalLaw c =
  case Equidistant.equidistant opposite (radius c) (Polyarc.reverse (contour c)) of
    Left o -> counterexample (show o) False
    Right back ->
      samePath
        (map (Segment.reverse . segment) (NonEmpty.toList back))
        (map segment (NonEmpty.toList (pieces c)))
  where
    opposite = Carrier.oppositeSide (side c)

motionLaw :: Case -> Motion -> Property
motionLaw c m = case Equidistant.equidistant side' (radius c) moved of
  Left o -> counterexample (show o) False
  Right ps ->
    samePath
      (map segment (NonEmpty.toList ps))
      (map (Generate.move m . segment) (NonEmpty.toList (pieces c)))
  where
    moved = Polyarc (ends (contour c)) (fmap (Generate.move m) (segments (contour c)))
    side' = if mirrored m then Carrier.oppositeSide (side c) else side c

-- | Sharp or round corners, and extra distances, which are sometimes different from 0.
styles :: Gen (Bool, [Double])
styles =
  (,)
    <$> arbitrary
      <*> frequency [(2, pure [0]), (1, vectorOf 3 (elements [0, 0.5, 1]))]

-- | Contours with a side and a radius: smooth ones and ones with corners, beside which the cutter
-- fits, and degenerate ones, beside which it fits sometimes.
anyContour :: Gen (Polyarc, Side, Mm)
anyContour = oneof [whole <$> Generate.closedCase, whole <$> Generate.openCase, small]
  where
    whole c = (contour c, side c, radius c)
    small = do
      s <- Reachable.subject
      share <- elements [0.01, 0.1, 1]
      pure (Reachable.contour s, Reachable.side s, Mm (share * Reachable.radius s))

-- | The path is that of the oracle "Offset.Elementwise" if the cutter fits.
agreementLaw :: Polyarc -> Side -> Mm -> (Bool, [Double]) -> Property
agreementLaw contour' side' radius' (isSharp, extras) =
  case Equidistant.styled style side' radius' contour' of
    Left _ -> classify True "does not fit" True
    Right path ->
      let found = NonEmpty.toList path
       in counterexample (show (found, expected)) (map origin found === map origin expected)
            .&&. conjoin (zipWith alike found expected)
  where
    expected = NonEmpty.toList (Elementwise.elementwise style side' radius' contour')
    style =
      Equidistant.CornerStyle
        { Equidistant.sharp = isSharp,
          Equidistant.extra = \i -> Mm (extras !! (i `mod` length extras))
        }
    alike p q = counterexample (show (p, q)) $ case (segment p, segment q) of
      (Arc a b m (Rad s), Arc a' b' m' (Rad s')) ->
        -- A degenerate contour may close with a gap of 10⁻⁶ mm.
        m == m' && apart a a' < 1e-9 && apart b b' < 1e-9 && abs (s - s') < 2e-6
      (Straight a b, Straight a' b') -> apart a a' < 1e-9 && apart b b' < 1e-9
      _ -> False

-- | Two paths consist of the same segments. They may begin with different ones.
samePath :: [Segment] -> [Segment] -> Property
samePath as bs =
  length as === length bs .&&. conjoin [counterexample (show a) (any (alike a) bs) | a <- as]
  where
    alike a b =
      apart (Segment.start a) (Segment.start b) < 1e-6
        && apart (Segment.end a) (Segment.end b) < 1e-6
        && apart (Segment.at 0.5 a) (Segment.at 0.5 b) < 1e-6

-- | True when a corner turns slightly towards the cutter. The path is shorter there.
hasSlightCorner :: Case -> Bool
hasSlightCorner c =
  or
    [ turned * (if side c == LeftOf then 1 else -1) > 1e-6
      | (a, b) <- zip ss (drop 1 ss <> take 1 ss),
        let Rad turned = Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
    ]
  where
    ss = NonEmpty.toList (segments (contour c))

lengthLaw :: Case -> Property
lengthLaw c = counterexample (show (len, old, r)) (abs (len - (old + sign * 2 * pi * r)) < 1e-6)
  where
    Mm len = Quantity.total (map (Segment.length . segment) (NonEmpty.toList (pieces c)))
    Mm old = Polyarc.length (contour c)
    r = Generate.radiusOf c
    outside = (Polyarc.signedArea (contour c) > 0) == (side c == RightOf)
    sign = if outside then 1 else -1

-- | Two elements, at least one of them an arc, join at a corner so slight that the cutter passes
-- it. There the cutter's centre is at the radius from both elements.
slightCornerLaw :: Property
slightCornerLaw =
  forAll (choose (2e-7, 0.0039)) $ \turned ->
    forAll bend $ \k -> forAll (bend `suchThat` \k' -> k /= 0 || k' /= 0) $ \k' ->
      let corner = Vec.point 0 0
          first = Segment.reverse (from corner (Vec.vec (-1) 0) (negate k))
          second = from corner (Vec.vec (cos turned) (sin turned)) k'
       in case Equidistant.equidistant LeftOf (Mm r) (Polyarc Open (first :| [second])) of
            Right (p :| [q]) ->
              conjoin
                [ Segment.end (segment p) === Segment.start (segment q),
                  isAway (segment p) first,
                  isAway (segment p) second
                ]
            found -> counterexample (show found) False
  where
    r = 5
    -- A curvature, positive to the left; 0 for a line.
    bend =
      frequency
        [(1, pure 0), (4, (\sign old -> sign / old) <$> elements [-1, 1] <*> choose (12, 300))]
    -- An element 4 mm long with a start, a direction there, and a curvature.
    from at u bent
      | bent == 0 = Straight at (Vec.shift (Vec.scale 4 u) at)
      | otherwise =
        let c =
              Vec.shift (Vec.scale (1 / bent) (Vec.left u)) at
         in Arc
              { start = at,
                end = Vec.shift (Vec.rotate (Rad (4 * bent)) (Vec.to c at)) c,
                centre = c,
                sweep = Rad (4 * bent)
              }
    isAway path s =
      let Mm d = toCarrier s (Segment.end path)
       in counterexample (show (s, d)) (abs (d - r) < 1e-9)
    -- The distance of a point from the line or the circle on which an element lies.
    toCarrier s p = case s of
      Straight a b -> Mm (abs (Vec.cross (Vec.unit (Vec.to a b)) (Vec.to a p)))
      Arc {start, centre} ->
        let Mm d =
              Quantity.minus (Vec.distance centre p) (Vec.distance centre start)
         in Mm (abs d)

largestLaw :: Polyarc -> Side -> Property
largestLaw c s = case Equidistant.equidistant s (Mm 60) c of
  Right _ -> discard
  Left (Obstacle _ Nothing) -> classify True "no cutter fits" (isBlocked 0.001)
  Left (Obstacle _ (Just (Mm r))) ->
    classify
      True
      "some cutter fits"
      (counterexample (show r) (not (isBlocked r) && isBlocked (r + 1e-3)))
  where
    isBlocked r = case Equidistant.equidistant s (Mm r) c of
      Left _ -> True
      Right _ -> False

causeOf :: Side -> Double -> Polyarc -> Maybe (Cause, Double)
causeOf s r c = case Equidistant.equidistant s (Mm r) c of
  Left (Obstacle cause largest) ->
    Just (cause, maybe 0 (\(Mm l) -> fromIntegral (round (l * 1e5) :: Int) / 1e5) largest)
  Right _ -> Nothing

circle :: Sense -> Double -> Polyarc
circle sense r =
  Polyarc
    Closed
    (Segment.fullCircle sense (Circle (Vec.point 3 4) (Mm r)) (Vec.point (3 + r) 4) :| [])

-- | True for a contour with arcs of both senses.
hasBothSenses :: Case -> Bool
hasBothSenses c =
  any ((> 0) . sweepOf) (segments (contour c)) && any ((< 0) . sweepOf) (segments (contour c))
  where
    sweepOf s = case s of
      Straight _ _ -> 0
      Arc {sweep = Rad a} -> a

isCorner :: OffsetSegment -> Bool
isCorner p = case origin p of
  Around _ -> True
  Along _ -> False

square :: Polyarc
square = Polyarc Closed (lines' :| rest)
  where
    lines' = Straight (Vec.point 0 0) (Vec.point 10 0)
    rest =
      [ Straight (Vec.point 10 0) (Vec.point 10 10),
        Straight (Vec.point 10 10) (Vec.point 0 10),
        Straight (Vec.point 0 10) (Vec.point 0 0)
      ]

-- | A block with a slot of width 8 that widens to a circle of radius 20, counter-clockwise.
keyhole :: Polyarc
keyhole =
  Polyarc
    Closed
    ( Straight (Vec.point (-40) (-80)) (Vec.point 40 (-80))
        :| [ Straight (Vec.point 40 (-80)) (Vec.point 40 40),
             Straight (Vec.point 40 40) (Vec.point 4 40),
             Straight (Vec.point 4 40) (Vec.point 4 neck),
             Segment.arc Clockwise (Vec.point 0 (-20)) (Vec.point 4 neck) (Vec.point (-4) neck),
             Straight (Vec.point (-4) neck) (Vec.point (-4) 40),
             Straight (Vec.point (-4) 40) (Vec.point (-40) 40),
             Straight (Vec.point (-40) 40) (Vec.point (-40) (-80))
           ]
    )
  where
    neck = -20 + sqrt (20 * 20 - 4 * 4)

-- | An open contour that returns below its own start: a line, an arc of more than three quarters of
-- a turn, a line.
hook :: Polyarc
hook =
  Polyarc
    Open
    ( Straight (Vec.point 70 30) begin
        :| [ Segment.arc CounterClockwise middle begin behind,
             Straight behind (Vec.shift (Vec.vec 8 6) behind)
           ]
    )
  where
    begin = Vec.point 50 50
    middle = Vec.shift (Vec.scale (-30 / sqrt 2) (Vec.vec 1 1)) begin
    behind = Vec.shift (Vec.vec 18 (-24)) middle

segmentLength :: OffsetSegment -> Double
segmentLength p = let Mm l = Segment.length (segment p) in l

apart :: Point -> Point -> Double
apart a b = let Mm d = Vec.distance a b in d
