-- | Ways down: their lengths, slopes and ends.
module Toolpath.DescentSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier (Sense (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck
import Toolpath.Descent (Slope (..), Way (..))
import Toolpath.Descent qualified as Descent

spec :: Spec
spec = do
  describe "a ramp" $ do
    it "has the slope of its angle, and ends at the beginning of a closed path" $
      forAll closedPath $ \path ->
        forAll heightsAndAngle $ \(top, bottom, angle) ->
          case Descent.ramp (Rad angle) (Mm top, Mm bottom) path of
            Nothing -> counterexample "no ramp" False
            Just way ->
              conjoin
                [ isJoined way,
                  endsAt path way,
                  goesDown (top, bottom) way,
                  counterexample "the slope" $
                    near ((top - bottom) / lengthOf way) (tan angle)
                ]
    it "goes forth and back on an open path, no steeper than its angle" $
      forAll openPath $ \path ->
        forAll heightsAndAngle $ \(top, bottom, angle) ->
          case Descent.ramp (Rad angle) (Mm top, Mm bottom) path of
            Nothing ->
              counterexample "no ramp" ((top - bottom) / tan angle > 400 * lengthAlong path)
            Just way ->
              conjoin
                [ isJoined way,
                  endsAt path way,
                  goesDown (top, bottom) way,
                  counterexample "the slope" $
                    (top - bottom) / lengthOf way <= tan angle + 1e-9,
                  counterexample "leaves the path" $
                    all (\s -> Segment.length (piece s) <= Mm (lengthAlong path + 1e-9)) (slope way)
                ]
  describe "a spiral" $
    it "goes down by the step at most in each lap, in the fewest laps" $
      forAll closedPath $ \path ->
        forAll heightsAndAngle $ \(top, bottom, _) ->
          forAll (choose (0.3, 5)) $ \step ->
            case Descent.spiral (Mm step) (Mm top, Mm bottom) path of
              Nothing -> counterexample "no spiral" False
              Just way ->
                let laps = lengthOf way / lengthAlong path
                 in conjoin
                      [ isJoined way,
                        endsAt path way,
                        goesDown (top, bottom) way,
                        counterexample "whole laps" (near laps (fromIntegral (round laps :: Int))),
                        counterexample "the step" ((top - bottom) / laps <= step + 1e-9),
                        counterexample "too many laps" ((laps - 1) * step < top - bottom)
                      ]
  describe "a helix" $
    it "goes down by the pitch at most in each turn, then round, and to its centre" $
      forAll heightsAndAngle $ \(top, bottom, _) ->
        forAll ((,) <$> choose (0.3, 4) <*> choose (0.5, 6)) $ \(pitch, radius) ->
          let centre' = Vec.point 7 (-3)
              heights' = (Mm top, Mm bottom)
           in case Descent.helix CounterClockwise (Mm pitch) (Mm radius) heights' centre' of
                Nothing -> counterexample "no helix" False
                Just way ->
                  let parts = NonEmpty.toList (slope way)
                      turns = take (length parts - 2) parts
                   in conjoin
                        [ isJoined way,
                          counterexample "ends at its centre" $
                            Vec.isNear (Segment.end (piece (last parts))) centre',
                          counterexample "a full circle at the bottom" $
                            map heights (take 1 (drop (length turns) parts))
                              === [(Mm bottom, Mm bottom)],
                          counterexample "the pitch" $
                            (top - bottom) / fromIntegral (length turns) <= pitch + 1e-9,
                          counterexample "too many turns" $
                            fromIntegral (length turns - 1) * pitch < top - bottom
                        ]
  it "is refused if it takes more than a thousand laps" $ do
    Descent.ramp (Rad 1e-6) (Mm 0, Mm (-5)) square `shouldBe` Nothing
    Descent.spiral (Mm 0.001) (Mm 0, Mm (-5)) square `shouldBe` Nothing
    Descent.helix Clockwise (Mm 0.001) (Mm 2) (Mm 0, Mm (-5)) (Vec.point 0 0) `shouldBe` Nothing
  where
    square = polygon [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)]
    endsAt path way =
      counterexample "the end" $
        Vec.isNear
          (Segment.end (piece (NonEmpty.last (slope way))))
          (Segment.start (NonEmpty.head path))

-- | Each part begins where the part before it ends, in the plane and in height.
isJoined :: Way -> Property
isJoined way =
  counterexample "a gap" $
    Vec.isNear (Segment.start (piece (head parts))) (entry way)
      && and (zipWith follows parts (drop 1 parts))
  where
    parts = NonEmpty.toList (slope way)
    follows a b =
      Vec.isNear (Segment.end (piece a)) (Segment.start (piece b))
        && snd (heights a) == fst (heights b)

-- | All parts have one slope, from the one height to the other.
goesDown :: (Double, Double) -> Way -> Property
goesDown (top, bottom) way =
  counterexample "the heights" $
    entryHeight way == Mm top
      && fst (heights (NonEmpty.head (slope way))) == Mm top
      && snd (heights (NonEmpty.last (slope way))) == Mm bottom
      && all isEven (slope way)
  where
    rate = (top - bottom) / lengthOf way
    isEven s =
      let (Mm a, Mm b) = heights s
          Mm l = Segment.length (piece s)
       in abs (a - b - rate * l) <= 1e-6

lengthOf :: Way -> Double
lengthOf way = sum [l | s <- NonEmpty.toList (slope way), let Mm l = Segment.length (piece s)]

lengthAlong :: NonEmpty Segment -> Double
lengthAlong path = sum [l | Mm l <- map Segment.length (NonEmpty.toList path)]

near :: Double -> Double -> Bool
near a b = abs (a - b) <= 1e-6 * max 1 (abs b)

heightsAndAngle :: Gen (Double, Double, Double)
heightsAndAngle = do
  top <- choose (-4, 3)
  depth <- choose (0.2, 8)
  angle <- choose (0.02, 1.2)
  pure (top, top - depth, angle)

-- | A closed path of lines, with an arc at its end; some of its lines have no length.
closedPath :: Gen (NonEmpty Segment)
closedPath = do
  n <- choose (2, 6)
  ps <- vectorOf n ((,) <$> choose (-30, 30) <*> choose (-30, 30))
  doubled <- elements [ps, take 1 ps <> ps]
  r <- choose (3, 9)
  let (x, y) = head doubled
      (u, v) = last doubled
      lines' = NonEmpty.toList (polygon (doubled <> [(u + 60, v), (x + 60, y), (x + 2 * r, y)]))
  pure
    ( NonEmpty.fromList
        ( lines'
            <> [ Segment.arc
                   CounterClockwise
                   (Vec.point (x + r) y)
                   (Vec.point (x + 2 * r) y)
                   (Vec.point x y)
               ]
        )
    )

openPath :: Gen (NonEmpty Segment)
openPath = do
  n <- choose (2, 6)
  ps <- vectorOf n ((,) <$> choose (-30, 30) <*> choose (-30, 30))
  pure (polygon (ps <> [(100, 100)]))

polygon :: [(Double, Double)] -> NonEmpty Segment
polygon ps = NonEmpty.fromList (zipWith line ps (drop 1 ps))
  where
    line (a, b) (c, d) = Straight (Vec.point a b) (Vec.point c d)
