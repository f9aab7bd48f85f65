-- | Constructions of the drawing board: lines and circles that touch others or go through points.
-- Each gives all its answers; which one is meant is for the caller to choose.
module Geometry.Construction.TangentCircle
  ( Touched (..),
    touchingLines,
    circles,
    through,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Geometry.Carrier (Circle (..), Line (..), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.CarrierIntersection (Carrier (..))
import Geometry.Construction.CarrierIntersection qualified as CarrierIntersection
import Geometry.Construction.Intersection (Intersection (..))
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Construction.TangentLine qualified as TangentLine
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | What a circle of a given radius goes through or touches.
data Touched
  = Through Point
  | LeftOf Line
  | RightOf Line
  | -- | from outside
    OutsideOf Circle
  | -- | one inside the other
    InsideOf Circle
  deriving stock (Eq, Show)

-- | The directed lines that touch two circles from the one to the other; a circle of radius 0 is a
-- point. The senses are those in which a circle may be passed: counter-clockwise, it lies to the
-- left.
touchingLines :: ([Sense], Circle) -> ([Sense], Circle) -> [Line]
touchingLines (ts, a) (us, b) =
  distinct [l | t <- senses a ts, u <- senses b us, Just l <- [TangentLine.directed (t, a) (u, b)]]
  where
    -- A point has no sides.
    senses (Circle _ r) list = if r <= Tolerance.coincident then take 1 list else list
    distinct ls = case ls of
      [] -> []
      l : rest -> l : distinct (filter (different l) rest)
    different l m = not (Vec.near (from l) (from m) && Vec.near (to l) (to m))

-- | The circles of a radius that touch two things: at most two.
circles :: Mm -> Touched -> Touched -> [Circle]
circles r a b =
  [ Circle c r
    | Just la <- [locus r a],
      Just lb <- [locus r b],
      c <- CarrierIntersection.common la lb
  ]

-- | Where the centre may lie.
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

-- | The circle through three points, unless they lie on one line.
through :: Point -> Point -> Point -> Maybe Circle
through p q s
  | Vec.near p q || Vec.near q s || Vec.near p s = Nothing
  | otherwise = case Intersection.lines (bisector p q) (bisector q s) of
    CrossingOnce c -> Just (Circle c (Vec.distance c p))
    _ -> Nothing
  where
    bisector a b =
      let m = Vec.between 0.5 a b
       in Line m (Vec.shift (Vec.left (Vec.to a b)) m)
