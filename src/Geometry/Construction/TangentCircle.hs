-- | Constructions of lines and circles that touch others or pass through points. Each construction
-- gives all solutions; the caller chooses.
module Geometry.Construction.TangentCircle
  ( Touched (..),
    tangentLines,
    circles,
    through,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Geometry.Carrier (Carrier (..), Circle (..), Line (..), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.Intersection (Intersection (..))
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Construction.TangentLine qualified as TangentLine
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | A condition on a circle: it passes through a point, or it touches a line or another circle and
-- lies on a certain side of it. For example, a circle that is @LeftOf@ a line touches the line and
-- lies to the left of it.
data Touched
  = Through Point
  | LeftOf Line
  | RightOf Line
  | -- | the other circle; neither of the two lies inside the other
    OutsideOf Circle
  | -- | the other circle; one of the two, whichever it is, lies inside the other
    InsideOf Circle
  deriving stock (Eq, Show)

-- | The directed lines that touch the circle @a@ first and then the circle @b@. A circle of radius
-- 0 is a point. Each circle comes with the senses that it may have: a counter-clockwise circle lies
-- to the left of the line, a clockwise one to the right.
tangentLines :: ([Sense], Circle) -> ([Sense], Circle) -> [Line]
tangentLines (sensesA, a) (sensesB, b) =
  distinct
    [ l
      | senseA <- relevant a sensesA,
        senseB <- relevant b sensesB,
        Just l <- [TangentLine.directed (senseA, a) (senseB, b)]
    ]
  where
    -- A circle of radius 0 gives the same line for both senses, so one sense is enough.
    relevant (Circle _ r) senses = if r <= Tolerance.coincident then take 1 senses else senses
    distinct ls = case ls of
      [] -> []
      l : rest -> l : distinct (filter (differs l) rest)
    differs l m = not (Vec.isNear (from l) (from m) && Vec.isNear (to l) (to m))

-- | The circles of the radius @r@ that meet both conditions @a@ and @b@: at most two. The list is
-- empty also if infinitely many circles meet both.
circles :: Mm -> Touched -> Touched -> [Circle]
circles r a b =
  [ Circle c r
    | Just locusA <- [locus r a],
      Just locusB <- [locus r b],
      c <- Intersection.common locusA locusB
  ]

-- | The locus of the centres of all circles that have the radius @r@ and meet a condition. The
-- locus is a line or a circle. Nothing for 'InsideOf' a circle of the same radius.
locus :: Mm -> Touched -> Maybe Carrier
locus r@(Mm radius) touched = case touched of
  Through p -> Just (CircleCarrier (Circle p r))
  LeftOf l -> Just (LineCarrier (Carrier.parallelAt r l))
  RightOf l -> Just (LineCarrier (Carrier.parallelAt (Mm (-radius)) l))
  OutsideOf (Circle c rc) -> Just (CircleCarrier (Circle c (plus rc r)))
  InsideOf (Circle c rc)
    | gap > Tolerance.coincident -> Just (CircleCarrier (Circle c gap))
    | otherwise -> Nothing
    where
      gap = max (minus rc r) (minus r rc)

-- | The circle through three points. Nothing when they lie on one line or two of them coincide.
through :: Point -> Point -> Point -> Maybe Circle
through p q s
  | Vec.isNear p q || Vec.isNear q s || Vec.isNear p s = Nothing
  | otherwise = case Intersection.lines (bisector p q) (bisector q s) of
    CrossingOnce c -> Just (Circle c (Vec.distance c p))
    _ -> Nothing
  where
    bisector a b =
      let m = Vec.interpolate 0.5 a b
       in Line m (Vec.shift (Vec.left (Vec.to a b)) m)
