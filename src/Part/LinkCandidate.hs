-- | Computes the joints by which a link can join two neighbouring elements of a contour. A joint is
-- one solution of a link: an intersection, a smooth transition, a common tangent, a fillet arc or a
-- chamfer.
--
-- The joints of a link do not depend on the other links of the contour. Only a fillet can have
-- several joints, one for each arc; "Part.LinkSolver" chooses one of them. A curve is represented
-- by its polyarc: a chain of lines and arcs within 'Tolerance.curve' of it.
module Part.LinkCandidate
  ( Joint (..),
    through,
    candidates,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus)
import Base.Region (Located (..))
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Geometry.Carrier (Circle (Circle), Line, Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.Fillet qualified as Fillet
import Geometry.Construction.Intersection (Intersection (..))
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Construction.TangentLine qualified as TangentLine
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.ElementCarrier qualified as ElementCarrier
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.MeasuredPolyarc (MeasuredPolyarc)
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Part.ContourError (ContourFault (..), LinkFault (..), Neighbours (..))
import Part.Link (Link (..))
import Part.Tolerance qualified as Tolerance

-- | A solution of a link. The element before the link ends at 'leave', the element after it begins
-- at 'enter', and the segment 'inserted' leads from one point to the other. If no segment is
-- inserted, the points are equal, up to the small gap that a smooth link allows.
data Joint = Joint
  { leave :: {-# UNPACK #-} Point,
    enter :: {-# UNPACK #-} Point,
    inserted :: Maybe Segment
  }
  deriving stock (Eq, Show)

-- | The joint at which both elements meet in the point @p@.
through :: Point -> Joint
through p = Joint p p Nothing

-- | The joint that inserts a straight segment from @p@ to @q@.
straight :: Point -> Point -> Joint
straight p q = Joint p q (Just (Straight p q))

-- | The joints by which a link can join the neighbours @j@. A fillet can have several, sorted by
-- the length of the arc, the shortest first. Every other link has one. The points @own@ are the end
-- of the element before the link and the start of the element after it; a circle has neither. If
-- the neighbours have several intersections, 'meet' uses @own@ to choose one of them.
candidates :: Neighbours -> [Point] -> Link -> Either ContourFault (NonEmpty Joint)
candidates j own link = case link of
  Meet near -> (:| []) <$> meet j own near
  Fixed p -> Right (through p :| [])
  Smooth -> (:| []) <$> smooth j
  Tangent -> (:| []) <$> tangent j
  Fillet sense r -> fillet j sense r
  Chamfer d -> (:| []) <$> chamfer j own d

-- | The carriers of the element before the link and of the element after it.
shapes :: Neighbours -> (ElementCarrier, ElementCarrier)
shapes j = (value (before j), value (after j))

-- Intersections

-- | The joint at an intersection of two neighbours. Of several intersections it takes the one
-- nearest to the point @near@. Without @near@ it takes the one that is among the points @own@, the
-- ends of the neighbours. Between two neighbours that are points it inserts a straight segment.
meet :: Neighbours -> [Point] -> Maybe Point -> Either ContourFault Joint
meet j own near = case shapes j of
  (AtPoint p, AtPoint q)
    | Vec.isNear p q -> Left (NotLinked j (SameCurve False))
    | otherwise -> Right (straight p q)
  (AtPoint p, b) -> pointOn j p b
  (a, AtPoint q) -> pointOn j q a
  (OnCurve c, b) ->
    polyarcs (MeasuredPolyarc.segments c) (ElementCarrier.segmentsWithin (extent c) b)
  (a, OnCurve c) ->
    polyarcs (ElementCarrier.segmentsWithin (extent c) a) (MeasuredPolyarc.segments c)
  (OnLine l, OnLine m) -> case Intersection.lines l m of
    Apart gap -> Left (NotLinked j (ParallelLines gap))
    Same | Vec.isNear (Carrier.to l) (Carrier.from m) -> Right (through (Carrier.to l))
    meeting -> common meeting
  (OnLine l, OnCircle _ c) -> common (Intersection.lineCircle l c)
  (OnCircle _ c, OnLine l) -> common (Intersection.lineCircle l c)
  (OnCircle _ c, OnCircle _ d) -> common (Intersection.circles c d)
  where
    common meeting = case meeting of
      Apart gap -> Left (NotLinked j (NoMeeting gap))
      Same -> Left (NotLinked j (SameCurve False))
      Touching p -> Right (through p)
      CrossingOnce p -> Right (through p)
      Crossing p q -> choose j own near Tolerance.coincident [p, q]
    polyarcs a b = case MeasuredPolyarc.intersections a b of
      [] -> Left (NotLinked j (NoMeeting (MeasuredPolyarc.leastDistance a b)))
      [p] -> Right (through p)
      ps -> choose j own near Tolerance.nearTie ps

-- | Chooses one of the intersections @ps@: the nearest to @near@, or without @near@ the only one
-- that is among the points @own@. Fails if the two smallest distances from @near@ differ by at most
-- @tolerance@.
choose :: Neighbours -> [Point] -> Maybe Point -> Mm -> [Point] -> Either ContourFault Joint
choose j own near (Mm tolerance) ps =
  through <$> case (near, sortOn (\p -> maybe 0 (`distance` p) near) ps) of
    (Just n, p : q : _) | distance n q - distance n p > tolerance -> Right p
    (Nothing, _) | [one] <- [p | p <- ps, any (Vec.isNear p) own] -> Right one
    _ -> Left (NotLinked j (AmbiguousMeeting ps))
  where
    distance a b = let Mm d = Vec.distance a b in d

-- | The joint of two neighbours, one of which is the point @p@. Fails if @p@ does not lie on the
-- other neighbour, @carrier@. A point on a curve may be 'Tolerance.curve' away from it, because a
-- polyarc replaces the curve.
pointOn :: Neighbours -> Point -> ElementCarrier -> Either ContourFault Joint
pointOn j p carrier
  | gap <= slack = Right (through p)
  | otherwise = Left (NotLinked j (NoMeeting gap))
  where
    gap = distanceTo carrier p
    slack = case carrier of
      OnCurve _ -> plus Tolerance.curve Tolerance.coincident
      OnLine _ -> Tolerance.coincident
      OnCircle _ _ -> Tolerance.coincident
      AtPoint _ -> Tolerance.coincident

-- | The bounding box of a polyarc.
extent :: MeasuredPolyarc -> BoundingBox
extent c =
  foldl
    (\box s -> BoundingBox.union box (BoundingBox.ofSegment s))
    (BoundingBox.ofPoints (MeasuredPolyarc.start c) [])
    (MeasuredPolyarc.segments c)

-- | The distance between a point and the carrier of an element.
distanceTo :: ElementCarrier -> Point -> Mm
distanceTo carrier p = case carrier of
  OnLine l -> let Mm d = Carrier.signedDistance l p in Mm (abs d)
  OnCircle _ (Circle c (Mm r)) -> let Mm d = Vec.distance c p in Mm (abs (d - r))
  OnCurve c -> Vec.distance p (MeasuredPolyarc.at c (MeasuredPolyarc.nearestStation c p))
  AtPoint q -> Vec.distance p q

-- Smooth transitions

-- | The joint of a smooth link, at which the neighbours touch. If one of them is a circle or a
-- curve, both must have the same direction there. If one of them is a point, 'meet' makes the
-- joint, and no directions are compared.
smooth :: Neighbours -> Either ContourFault Joint
smooth j = case shapes j of
  (OnLine l, OnLine m) -> smoothLines j l m
  (OnLine l, OnCircle sense c) -> smoothLineCircle j l sense c
  (OnCircle sense c, OnLine l) -> smoothLineCircle j l sense c
  (OnCircle s c, OnCircle t d) -> smoothCircles j (s, c) (t, d)
  (AtPoint _, _) -> meet j [] Nothing
  (_, AtPoint _) -> meet j [] Nothing
  (OnCurve c, b) ->
    let p = MeasuredPolyarc.end c
     in smoothEnds j (p, MeasuredPolyarc.directionAt c (MeasuredPolyarc.length c)) (facing b p)
  (a, OnCurve c) ->
    let q = MeasuredPolyarc.start c
     in smoothEnds j (facing a q) (q, MeasuredPolyarc.directionAt c (Mm 0))

-- | The joint of a smooth link between two lines: their intersection, or an end of one of them if
-- they lie on one infinite line. Fails if they are parallel and apart, or if the angle between
-- their directions is 90° or more.
smoothLines :: Neighbours -> Line -> Line -> Either ContourFault Joint
smoothLines j l m
  | Vec.dot (Carrier.direction l) (Carrier.direction m) <= 0 = Left (NotLinked j (TurnsBack []))
  | otherwise = case Intersection.lines l m of
    Same | Vec.isNear (Carrier.to l) (Carrier.from m) -> Right (through (Carrier.to l))
    Same -> Right (through (Carrier.from m))
    Apart gap -> Left (NotLinked j (NotSmooth gap Nothing))
    _ -> meet j [] Nothing

-- | The joint of a smooth link. The first pair is the point and the direction at the end of the
-- element before the link, the second pair those at the start of the element after it. A gap of
-- 'Tolerance.smoothGap' and an angle of 'Tolerance.smoothTurn' are allowed, because curves may come
-- from measured points.
smoothEnds :: Neighbours -> (Point, Vec) -> (Point, Vec) -> Either ContourFault Joint
smoothEnds j (p, u) (q, v)
  | Vec.distance p q > Tolerance.smoothGap =
    Left (NotLinked j (NotSmooth (Vec.distance p q) Nothing))
  | abs angle > pi / 2 = Left (NotLinked j (TurnsBack []))
  | abs angle > allowed = Left (NotLinked j (Kinked (Rad (abs angle)) False))
  | otherwise = Right (Joint p q Nothing)
  where
    Rad angle = Vec.signedAngle u v
    Rad allowed = Tolerance.smoothTurn

-- | The point of an element that is nearest to @p@, and the element's direction there.
facing :: ElementCarrier -> Point -> (Point, Vec)
facing carrier p = case carrier of
  OnLine l -> (Carrier.foot l p, Carrier.direction l)
  OnCircle sense (Circle c (Mm r)) ->
    let out = Vec.unit (Vec.to c p)
     in (Vec.shift (Vec.scale r out) c, Vec.scale (Carrier.senseSign sense) (Vec.left out))
  OnCurve c ->
    let s = MeasuredPolyarc.nearestStation c p
     in (MeasuredPolyarc.at c s, MeasuredPolyarc.directionAt c s)
  AtPoint q -> (q, Vec.unit (Vec.to q p))

-- | The joint of a smooth link between a line and a circle, in either order. Fails unless the line
-- touches the circle and has, at that point, the direction of the circle's sense.
smoothLineCircle :: Neighbours -> Line -> Sense -> Circle -> Either ContourFault Joint
smoothLineCircle j l sense (Circle c (Mm r))
  | abs (abs h - r) <= tolerance && signum h /= Carrier.senseSign sense =
    Left (NotLinked j (TurnsBack []))
  | otherwise = touching j (abs h - r) (Carrier.foot l c)
  where
    Mm h = Carrier.signedDistance l c
    Mm tolerance = Tolerance.coincident

-- | The joint of a smooth link between two circles. Fails unless they touch. Circles with the same
-- sense must touch with one inside the other, circles with different senses from outside.
smoothCircles :: Neighbours -> (Sense, Circle) -> (Sense, Circle) -> Either ContourFault Joint
smoothCircles j (s, Circle c (Mm r)) (t, Circle d (Mm q))
  | distance <= tolerance = Left (NotLinked j (SameCurve False))
  | s == t && outerGap <= tolerance || s /= t && innerGap <= tolerance =
    Left (NotLinked j (TurnsBack []))
  | s == t = touching j innerGap (towards (if r >= q then r else -r))
  | otherwise = touching j outerGap (towards r)
  where
    Mm distance = Vec.distance c d
    Mm tolerance = Tolerance.coincident
    outerGap = abs (distance - r - q)
    innerGap = abs (distance - abs (r - q))
    towards x = Vec.shift (Vec.scale x (Vec.unit (Vec.to c d))) c

-- | The joint of a smooth link at the point @p@. The size of @gap@ is the distance in mm by which
-- one neighbour would have to move to touch the other. Fails if this distance exceeds
-- 'Tolerance.coincident'.
touching :: Neighbours -> Double -> Point -> Either ContourFault Joint
touching j gap p
  | abs gap <= tolerance = Right (through p)
  | otherwise = Left (NotLinked j (NotSmooth (Mm (abs gap)) Nothing))
  where
    Mm tolerance = Tolerance.coincident

-- Inserted segments

-- | The joint by a straight segment that is tangent to both circles. It leaves the first circle,
-- and reaches the second one, in the direction of their senses. A point is a circle of radius 0.
tangent :: Neighbours -> Either ContourFault Joint
tangent j = case shapes j of
  (OnLine _, _) -> Left (NotLinked j TangentNeedsCircles)
  (_, OnLine _) -> Left (NotLinked j TangentNeedsCircles)
  (OnCurve _, _) -> Left (NotLinked j TangentNeedsCircles)
  (_, OnCurve _) -> Left (NotLinked j TangentNeedsCircles)
  (OnCircle s c, OnCircle t d) -> between (s, c) (t, d)
  (AtPoint p, OnCircle t c) -> between (t, Circle p (Mm 0)) (t, c)
  (OnCircle t c, AtPoint p) -> between (t, c) (t, Circle p (Mm 0))
  (AtPoint _, AtPoint _) -> meet j [] Nothing
  where
    between a@(_, c@(Circle p _)) b@(_, d@(Circle q _))
      | Vec.isNear p q =
        Left
          ( NotLinked
              j
              ( if Intersection.circles c d == Same
                  then CoincidentTangent False
                  else ConcentricTangent
              )
          )
      | otherwise = case TangentLine.directed a b of
        Just l -> Right (straight (Carrier.from l) (Carrier.to l))
        Nothing ->
          Left (NotLinked j (NoCommonTangent [(s, t) | (s, t, _) <- TangentLine.all c d]))

-- | The joints by arcs of sense @sense@ and radius @r@ that are tangent to both neighbours, the
-- shortest arc first.
fillet :: Neighbours -> Sense -> Mm -> Either ContourFault (NonEmpty Joint)
fillet j sense r = case shapes j of
  (AtPoint _, _) -> Left (NotLinked j FilletAtPoint)
  (_, AtPoint _) -> Left (NotLinked j FilletAtPoint)
  (a, b) -> case sortOn arcLength (map joint (Fillet.between r sense a b)) of
    [] -> Left (NotLinked j (NoFillet sense r Nothing Nothing))
    first : rest -> Right (first :| rest)
  where
    joint f =
      Joint
        (Fillet.start f)
        (Fillet.end f)
        (Just (Segment.arc sense (Fillet.middle f) (Fillet.start f) (Fillet.end f)))
    arcLength = fmap Segment.length . inserted

-- | The joint by a straight segment that cuts off a corner. The ends of the segment lie on the two
-- neighbours, at the arc length @d@ from their intersection. Of several intersections it takes the
-- one that is among the points @own@, the ends of the neighbours.
chamfer :: Neighbours -> [Point] -> Mm -> Either ContourFault Joint
chamfer j own (Mm d) = case shapes j of
  (AtPoint _, _) -> Left (NotLinked j FilletAtPoint)
  (_, AtPoint _) -> Left (NotLinked j FilletAtPoint)
  (a, b) -> do
    Joint {leave = corner} <- meet j own Nothing
    checkReach j (before j) (-d) corner
    checkReach j (after j) d corner
    Right (straight (along a (-d) corner) (along b d corner))

-- | Fails for an open curve that is too short for a chamfer: it ends before the arc length
-- @distance@ from its point @p@. A negative @distance@ goes against the direction of the curve.
checkReach :: Neighbours -> Located ElementCarrier -> Double -> Point -> Either ContourFault ()
checkReach j (Located region carrier) distance p = case carrier of
  OnCurve c
    | not (MeasuredPolyarc.isClosed c), target < -tolerance -> tooShort (-target)
    | not (MeasuredPolyarc.isClosed c), target > l + tolerance -> tooShort (target - l)
    where
      Mm s = MeasuredPolyarc.nearestStation c p
      Mm l = MeasuredPolyarc.length c
      Mm tolerance = Tolerance.coincident
      target = s + distance
  _ -> Right ()
  where
    tooShort overlap = Left (Overrun region carrier (Mm overlap) [link j] Nothing)

-- | The point of an element at the arc length @s@ in mm from its point @p@. A negative @s@ goes
-- against the direction of the element.
along :: ElementCarrier -> Double -> Point -> Point
along carrier s p = case carrier of
  OnLine l -> Vec.shift (Vec.scale s (Carrier.direction l)) p
  OnCircle sense (Circle c (Mm r)) ->
    Vec.shift (Vec.rotate (Rad (Carrier.senseSign sense * s / r)) (Vec.to c p)) c
  OnCurve c -> let Mm t = MeasuredPolyarc.nearestStation c p in MeasuredPolyarc.at c (Mm (t + s))
  AtPoint q -> q
