-- | The laws of the equidistant. Each says which bug it would catch.
module Offset.EquidistantSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Base.Quantity qualified as Quantity
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Generate (Case (..), Motion (..))
import Generate qualified
import Geometry.Carrier (Circle (Circle), Sense (..), Side (..))
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
      "both agree: the kernel's loops and the offset element by element are one path, piece by \
      \piece (catches a coordinate that drifts, a piece that is lost or belongs to another element)"
      $ property $
        forAll anyContour $ \(contour', side', radius') ->
          forAll styles (agreementLaw contour' side' radius')
    it "distance, open contours (catches an open path that is closed)" $
      property $
        forAll Generate.openCase distanceLaw
    it
      "clearance: no piece comes nearer to any element, by closed form (catches an arc that \
      \continues beyond its end)"
      $ property $
        forAll Generate.closedCase clearanceLaw
    it
      "continuity: every piece begins where the one before ends, a closed path closes (catches a \
      \missing corner arc)"
      $ property $
        forAll Generate.closedCase continuityLaw
    it
      "reversal: the other side of the reversed contour is the reversed path (catches a side that \
      \depends on the sense of an arc)"
      $ property $
        forAll Generate.closedCase reversalLaw
    it
      "motion: moving, turning and mirroring the part does so to the path (catches a formula that \
      \knows the axes)"
      $ property $
        forAll Generate.closedCase $ \c -> forAll Generate.motion (motionLaw c)
    it
      "length: outside of a closed contour it is L + 2πR, inside L − 2πR (catches an arc walked \
      \the long way round)"
      $ property $
        forAll Generate.smoothCase lengthLaw
    it "reaches contours with hollows, with corners, and with the cutter on either side" $
      checkCoverage $
        forAll Generate.closedCase $ \c ->
          cover
            25
            (hollow c)
            "hollow"
            (cover 25 (any isCorner (pieces c)) "corner" (cover 25 (side c == LeftOf) "left" True))
    it "length, with sharp corners (catches a corner arc of another radius or sweep)" $
      property $
        forAll Generate.closedCase $ \c -> not (cutOff c) ==> lengthLaw c
    it
      "slight inner corners: the ways along two arcs, or an arc and a line, meet where both are at \
      \the radius (catches arcs cut as lines are)"
      $ property slightCornerLaw
  describe "obstacles" $ do
    it
      "the largest cutter that fits does fit, and one a little larger does not (catches a search \
      \that stops early)"
      $ property $
        forAll (Generate.contour <$> Generate.closedCase) $ \c ->
          forAll (elements [LeftOf, RightOf]) (largestLaw c)
    it "a concave radius below the cutter's is named" $
      causeOf LeftOf 6 (circle CounterClockwise 5) `shouldBe` Just (Concave 0 (Mm 5), 5)
    it "a cutter that just fits into a circle stands still in its centre" $
      fmap (fmap segmentLength) (Equidistant.equidistant LeftOf (Mm 5) (circle CounterClockwise 5))
        `shouldBe` Right (0 :| [])
    it "an inner corner is named, and no cutter fits" $
      fmap fst (causeOf LeftOf 2 square) `shouldBe` Just (InnerCorner 0 1 (Vec.point 10 0))
    it "a slot of 8 whose walls are far apart in the contour stops a cutter of 10" $
      causeOf RightOf 5 keyhole `shouldSatisfy` \case
        Just (Collision {}, fits) -> abs (fits - 4) < 1e-5
        _ -> False
    it "the far end of an open contour stops a cutter where it begins" $
      causeOf LeftOf 14 hook `shouldSatisfy` \case
        -- Its end is then as far from the centre as its beginning.
        Just (Collision 0 2 _, fits) -> abs (fits - 12.33589) < 1e-4
        _ -> False
    it "a cutter of 8 goes down a slot of 8" $
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
  case Equidistant.equidistant (other (side c)) (radius c) (Polyarc.reverse (contour c)) of
    Left o -> counterexample (show o) False
    Right back ->
      sameWalk
        (map (Segment.reverse . segment) (NonEmpty.toList back))
        (map segment (NonEmpty.toList (pieces c)))

other :: Side -> Side
other s = case s of
  LeftOf -> RightOf
  RightOf -> LeftOf

motionLaw :: Case -> Motion -> Property
motionLaw c m = case Equidistant.equidistant side' (radius c) moved of
  Left o -> counterexample (show o) False
  Right ps ->
    sameWalk
      (map segment (NonEmpty.toList ps))
      (map (Generate.move m . segment) (NonEmpty.toList (pieces c)))
  where
    moved = Polyarc (ends (contour c)) (fmap (Generate.move m) (segments (contour c)))
    side' = if mirrored m then other (side c) else side c

-- | Corners of both shapes, with allowances of single elements now and then.
styles :: Gen (Bool, [Double])
styles =
  (,)
    <$> arbitrary
      <*> frequency [(2, pure [0]), (1, vectorOf 3 (elements [0, 0.5, 1]))]

-- | Contours with a side and a radius: smooth ones and ones with corners, in which the cutter fits,
-- and degenerate ones, in which a small cutter fits now and then.
anyContour :: Gen (Polyarc, Side, Mm)
anyContour = oneof [whole <$> Generate.closedCase, whole <$> Generate.openCase, small]
  where
    whole c = (contour c, side c, radius c)
    small = do
      s <- Reachable.subject
      share <- elements [0.01, 0.1, 1]
      pure (Reachable.contour s, Reachable.side s, Mm (share * Reachable.radius s))

-- | The path is that of the oracle where the cutter fits.
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

-- | Compares two paths; the first segment may differ.
sameWalk :: [Segment] -> [Segment] -> Property
sameWalk as bs =
  length as === length bs .&&. conjoin [counterexample (show a) (any (alike a) bs) | a <- as]
  where
    alike a b =
      apart (Segment.start a) (Segment.start b) < 1e-6
        && apart (Segment.end a) (Segment.end b) < 1e-6
        && apart (Segment.at 0.5 a) (Segment.at 0.5 b) < 1e-6

-- | Whether a corner turns slightly towards the cutter. The path is shorter there.
cutOff :: Case -> Bool
cutOff c =
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

-- | At a corner between two elements, at least one of them an arc, that is so slight that the
-- cutter passes it, the centre is at the radius from both.
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
    -- From a point in a direction, 4 mm long.
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
    isAway way s =
      let Mm d = carrier s (Segment.end way) in counterexample (show (s, d)) (abs (d - r) < 1e-9)
    -- From the line or the circle that carries an element.
    carrier s p = case s of
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
circle turn r =
  Polyarc
    Closed
    (Segment.fullCircle turn (Circle (Vec.point 3 4) (Mm r)) (Vec.point (3 + r) 4) :| [])

-- | A contour with arcs of both senses.
hollow :: Case -> Bool
hollow c =
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

-- | A wall with its inside on the left that comes back below its own start: a line, an arc of more
-- than three quarters of a turn, a line.
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
