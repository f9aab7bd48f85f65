-- | The places where a link can join two walked elements.
module Part.LinkCandidate
  ( Link (..),
    Joint (..),
    through,
    candidates,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus)
import Base.Region (Located (..))
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.Text (Text)
import Geometry.Carrier (Circle (Circle), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.Fillet qualified as Fillet
import Geometry.Construction.Intersection (Intersection (..))
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Construction.TangentLine qualified as TangentLine
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.ElementCarrier qualified as ElementCarrier
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Error (Joined (..), ValueFact (..))
import Part.Tolerance qualified as Tolerance

-- | A link with its values.
data Link
  = Meet (Maybe Point)
  | -- | at this point, where the elements of a contour follow one another
    Fixed Point
  | Smooth
  | Tangent
  | Fillet Sense Mm
  | Chamfer Mm
  deriving stock (Eq, Show)

-- | Where the walk leaves one element and enters the next, and what lies between.
data Joint = Joint
  { leave :: {-# UNPACK #-} Point,
    enter :: {-# UNPACK #-} Point,
    inserted :: Maybe Segment
  }
  deriving stock (Eq, Show)

-- | A joint at one point.
through :: Point -> Joint
through p = Joint p p Nothing

-- | All joints that a link can make of its neighbours. The points are the ends that the neighbours
-- have of their own: one of them decides where two curves meet in two points.
candidates :: Joined -> [Point] -> Link -> Either ValueFact (NonEmpty Joint)
candidates j own link = case link of
  Meet near -> (:| []) <$> meet j own near
  Fixed p -> Right (through p :| [])
  Smooth -> (:| []) <$> smooth j
  Tangent -> (:| []) <$> tangent j
  Fillet turn r -> fillet j turn r
  Chamfer d -> (:| []) <$> chamfer j own d

shapes :: Joined -> (ElementCarrier, ElementCarrier)
shapes j = (value (before j), value (after j))

-- | The intersection. Of several the one nearest to the point given; without one, the one that is
-- an end of a neighbour.
meet :: Joined -> [Point] -> Maybe Point -> Either ValueFact Joint
meet j own near = case shapes j of
  (AtPoint p, AtPoint q)
    | Vec.near p q -> Left (SameCurve j)
    | otherwise -> Right (Joint p q (Just (Straight p q)))
  (AtPoint p, b) -> on p b
  (a, AtPoint q) -> on q a
  (OnCurve c, b) -> ofCurve (MeasuredPolyarc.segments c) (ElementCarrier.within (extent c) b)
  (a, OnCurve c) -> ofCurve (ElementCarrier.within (extent c) a) (MeasuredPolyarc.segments c)
  (OnLine l, OnLine m) -> case Intersection.lines l m of
    Apart gap -> Left (ParallelLines j gap)
    Same | Vec.near (Carrier.to l) (Carrier.from m) -> Right (through (Carrier.to l))
    meeting -> points meeting
  (OnLine l, OnCircle _ c) -> points (Intersection.lineCircle l c)
  (OnCircle _ c, OnLine l) -> points (Intersection.lineCircle l c)
  (OnCircle _ c, OnCircle _ d) -> points (Intersection.circles c d)
  where
    on p shape =
      let gap =
            distanceTo shape p
       in if gap <= slack shape then Right (through p) else Left (NoMeeting j gap)
    -- The chain that stands for a curve is off by so much.
    slack shape = case shape of
      OnCurve _ -> plus Tolerance.curve Tolerance.coincident
      OnLine _ -> Tolerance.coincident
      OnCircle _ _ -> Tolerance.coincident
      AtPoint _ -> Tolerance.coincident
    points meeting = case meeting of
      Apart gap -> Left (NoMeeting j gap)
      Same -> Left (SameCurve j)
      Touching p -> Right (through p)
      CrossingOnce p -> Right (through p)
      Crossing p q -> choose Tolerance.coincident [p, q]
    ofCurve a b = case MeasuredPolyarc.meetings a b of
      [] -> Left (NoMeeting j (MeasuredPolyarc.gap a b))
      [p] -> Right (through p)
      ps -> choose Tolerance.nearTie ps
    extent c =
      foldl
        (\box s -> BoundingBox.union box (BoundingBox.ofSegment s))
        (BoundingBox.ofPoints (MeasuredPolyarc.start c) [])
        (MeasuredPolyarc.segments c)
    choose (Mm tolerance) ps =
      through <$> case (near, sortOn (\p -> maybe 0 (`distance` p) near) ps) of
        (Just n, p : q : _) | distance n q - distance n p > tolerance -> Right p
        (Nothing, _) | [one] <- [p | p <- ps, any (Vec.near p) own] -> Right one
        _ -> Left (AmbiguousMeeting j ps)
    distance a b = let Mm d = Vec.distance a b in d

-- | How far a point lies from an element's curve.
distanceTo :: ElementCarrier -> Point -> Mm
distanceTo shape p = case shape of
  OnLine l -> let Mm d = Carrier.signedDistance l p in Mm (abs d)
  OnCircle _ (Circle c (Mm r)) -> let Mm d = Vec.distance c p in Mm (abs (d - r))
  OnCurve c -> Vec.distance p (MeasuredPolyarc.at c (MeasuredPolyarc.station c p))
  AtPoint q -> Vec.distance p q

-- | The point where neighbours that touch go over into one another.
smooth :: Joined -> Either ValueFact Joint
smooth j = case shapes j of
  (OnLine l, OnLine m)
    | Vec.dot (Carrier.direction l) (Carrier.direction m) > 0 -> case Intersection.lines l m of
      Same ->
        Right
          ( through
              (if Vec.near (Carrier.to l) (Carrier.from m) then Carrier.to l else Carrier.from m)
          )
      Apart gap -> Left (NotSmooth j gap)
      _ -> meet j [] Nothing
    | otherwise -> Left (TurnsBack j)
  (OnLine l, OnCircle turn c) -> lineCircle l turn c
  (OnCircle turn c, OnLine l) -> lineCircle l turn c
  (OnCircle t1 c1, OnCircle t2 c2) -> circles (t1, c1) (t2, c2)
  (AtPoint _, _) -> meet j [] Nothing
  (_, AtPoint _) -> meet j [] Nothing
  (OnCurve c, b) ->
    let (p, u) =
          (MeasuredPolyarc.end c, MeasuredPolyarc.directionAt c (MeasuredPolyarc.length c))
     in goesOn (p, u) (sidedBy b p)
  (a, OnCurve c) ->
    let (q, v) =
          (MeasuredPolyarc.start c, MeasuredPolyarc.directionAt c (Mm 0))
     in goesOn (sidedBy a q) (q, v)
  where
    Mm tolerance = Tolerance.coincident
    -- Curves come from measured points: a small gap and a small turn are theirs.
    goesOn (p, u) (q, v)
      | Vec.distance p q > Tolerance.smoothGap = Left (NotSmooth j (Vec.distance p q))
      | abs turned > pi / 2 = Left (TurnsBack j)
      | abs turned > smooth' = Left (Kinked j (Rad (abs turned)))
      | otherwise = Right (Joint p q Nothing)
      where
        Rad turned = Vec.turn u v
        Rad smooth' = Tolerance.smoothTurn
    -- The point of an element that faces a point, and its direction there.
    sidedBy shape p = case shape of
      OnLine l -> (Carrier.foot l p, Carrier.direction l)
      OnCircle turn (Circle c (Mm r)) ->
        let out =
              Vec.unit (Vec.to c p)
         in (Vec.shift (Vec.scale r out) c, Vec.scale (Carrier.sense turn) (Vec.left out))
      OnCurve c ->
        let s =
              MeasuredPolyarc.station c p
         in (MeasuredPolyarc.at c s, MeasuredPolyarc.directionAt c s)
      AtPoint q -> (q, Vec.unit (Vec.to q p))
    touching gap p
      | abs gap <= tolerance = Right (through p)
      | otherwise = Left (NotSmooth j (Mm (abs gap)))
    lineCircle l turn (Circle c (Mm r))
      | abs (abs h - r) <= tolerance && signum h /= Carrier.sense turn = Left (TurnsBack j)
      | otherwise = touching (abs h - r) (Carrier.foot l c)
      where
        Mm h = Carrier.signedDistance l c
    circles (t1, Circle c1 (Mm r1)) (t2, Circle c2 (Mm r2))
      | d <= tolerance = Left (SameCurve j)
      | t1 == t2 && outerGap <= tolerance || t1 /= t2 && innerGap <= tolerance = Left (TurnsBack j)
      | t1 == t2 = touching innerGap (along (if r1 >= r2 then r1 else -r1))
      | otherwise = touching outerGap (along r1)
      where
        Mm d = Vec.distance c1 c2
        outerGap = abs (d - r1 - r2)
        innerGap = abs (d - abs (r1 - r2))
        along s = Vec.shift (Vec.scale s (Vec.unit (Vec.to c1 c2))) c1

-- | The common tangent that fits the senses. A point counts as a circle of radius 0.
tangent :: Joined -> Either ValueFact Joint
tangent j = case shapes j of
  (OnLine _, _) -> Left (TangentNeedsCircles j)
  (_, OnLine _) -> Left (TangentNeedsCircles j)
  (OnCurve _, _) -> Left (TangentNeedsCircles j)
  (_, OnCurve _) -> Left (TangentNeedsCircles j)
  (OnCircle t1 c1, OnCircle t2 c2) -> between (t1, c1) (t2, c2)
  (AtPoint p, OnCircle t c) -> between (t, Circle p (Mm 0)) (t, c)
  (OnCircle t c, AtPoint p) -> between (t, c) (t, Circle p (Mm 0))
  (AtPoint _, AtPoint _) -> meet j [] Nothing
  where
    between a@(_, c1@(Circle p1 _)) b@(_, c2@(Circle p2 _))
      | Vec.near p1 p2 =
        Left
          (if Intersection.circles c1 c2 == Same then CoincidentTangent j else ConcentricTangent j)
      | otherwise = case TangentLine.directed a b of
        Just l ->
          Right
            ( Joint
                (Carrier.from l)
                (Carrier.to l)
                (Just (Straight (Carrier.from l) (Carrier.to l)))
            )
        Nothing ->
          Left
            (NoTangent j [sense t1 <> " then " <> sense t2 | (t1, t2, _) <- TangentLine.all c1 c2])

sense :: Sense -> Text
sense turn = case turn of
  Clockwise -> "cw"
  CounterClockwise -> "ccw"

-- | The arcs of a radius and a sense, the nearer ones first.
fillet :: Joined -> Sense -> Mm -> Either ValueFact (NonEmpty Joint)
fillet j turn r = case shapes j of
  (AtPoint _, _) -> Left (FilletAtPoint j)
  (_, AtPoint _) -> Left (FilletAtPoint j)
  (a, b) -> case sortOn length' (map joint (Fillet.between r turn a b)) of
    [] -> Left (NoFillet j r Nothing)
    first : rest -> Right (first :| rest)
  where
    joint f =
      Joint
        (Fillet.start f)
        (Fillet.end f)
        (Just (Segment.arc turn (Fillet.middle f) (Fillet.start f) (Fillet.end f)))
    length' = fmap Segment.length . inserted

-- | A straight line between the points at a distance along each neighbour from their intersection.
chamfer :: Joined -> [Point] -> Mm -> Either ValueFact Joint
chamfer j own (Mm d) = case shapes j of
  (AtPoint _, _) -> Left (FilletAtPoint j)
  (_, AtPoint _) -> Left (FilletAtPoint j)
  (a, b) -> do
    Joint {leave = corner} <- meet j own Nothing
    reaches (before j) (-d) corner
    reaches (after j) d corner
    let p = along a (-d) corner
        q = along b d corner
    Right (Joint p q (Just (Straight p q)))
  where
    -- A curve has to be as long as the chamfer takes from it.
    reaches (Located region shape) s p = case shape of
      OnCurve c
        | not (MeasuredPolyarc.isClosed c),
          t < -tolerance ->
          Left (Overrun region shape (Mm (-t)) [link j] Nothing)
        | not (MeasuredPolyarc.isClosed c),
          t > l + tolerance ->
          Left (Overrun region shape (Mm (t - l)) [link j] Nothing)
        where
          Mm at = MeasuredPolyarc.station c p
          Mm l = MeasuredPolyarc.length c
          Mm tolerance = Tolerance.coincident
          t = at + s
      _ -> Right ()
    along shape s p = case shape of
      OnLine l -> Vec.shift (Vec.scale s (Carrier.direction l)) p
      OnCircle turn (Circle c (Mm r)) ->
        Vec.shift (Vec.rotate (Rad (Carrier.sense turn * s / r)) (Vec.to c p)) c
      OnCurve c -> let Mm t = MeasuredPolyarc.station c p in MeasuredPolyarc.at c (Mm (t + s))
      AtPoint q -> q
