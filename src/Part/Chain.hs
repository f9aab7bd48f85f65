-- | From walked elements and links to the segments of a contour.
--
-- Every link has a few places where it can join its neighbours (two fillets, one
-- intersection …). Of all combinations in which every element is walked forwards, the one
-- that makes the whole contour shortest is taken, by dynamic programming along the
-- contour.
module Part.Chain
  ( Walk (..),
    Link (..),
    solve,
  )
where

import Base.Quantity (Mm (..), plus)
import Base.Region (Region)
import Data.List (minimumBy, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes, mapMaybe)
import Data.Ord (comparing)
import Geometry.Contour (Ends (..))
import Geometry.Contour qualified as Contour
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Shape (Circle (Circle), Line (Line), Walked (..))
import Geometry.Shape qualified as Shape
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Error (Fact (..), Joined (Joined))
import Part.Error qualified as Error
import Part.Joint (Joint (..), Link (..))
import Part.Joint qualified as Joint
import Part.Part (Element (..))

-- | An element, its place, and the link behind it with its place.
data Walk = Walk {place :: Region, shape :: Walked, link :: Maybe (Region, Link)}
  deriving stock (Eq, Show)

-- | The elements of a contour that stands at a region.
solve :: Region -> Ends -> NonEmpty Walk -> Either Fact (NonEmpty Element)
solve region ends walks = do
  chosen <- case (ends, walks) of
    (Closed, only :| []) -> lone only
    (Closed, _) -> closed walks
    (Open, _) -> open walks
  elements <- maybe (Left nothingLeft) Right (NonEmpty.nonEmpty (filter long chosen))
  let contour = Contour.chained segment (\s e -> e {segment = s}) ends elements
  case Contour.selfCrossing (Contour.Contour ends (fmap segment contour)) of
    Just (i, j, p) -> Left (CrossesItself region (origin (contour NonEmpty.!! i)) (origin (contour NonEmpty.!! j)) p (any hasFillet walks))
    Nothing -> Right contour
  where
    long e = Segment.length (segment e) > Tolerance.coincident
    nothingLeft = NoLength region
    hasFillet w = case link w of
      Just (_, Fillet _ _) -> True
      _ -> False

-- | A closed contour of one element: a circle, from its rightmost point.
lone :: Walk -> Either Fact [Element]
lone (Walk place shape link) = case (shape, link) of
  (OnCircle _ _, Just (at, _)) -> Left (LinkOfLoneCircle at)
  (OnCircle turn circle@(Circle c (Mm r)), Nothing) ->
    Right [Element (Segment.fullCircle turn circle (Vec.shift (Vec.vec r 0) c)) place]
  (OnLine _, _) -> Left (LoneElement place shape)
  (AtPoint _, _) -> Left (LoneElement place shape)

-- | An open contour runs from the first point of its first element to the last one of its last.
open :: NonEmpty Walk -> Either Fact [Element]
open walks = do
  begin <- endOf Shape.from first
  finish <- endOf Shape.to final
  case link final of
    Just (at, _) -> Left (LinkAtEnd at (place first))
    Nothing -> Right ()
  joints <- traverse (uncurry jointsOf) (zip list (drop 1 list))
  route <- decided =<< shortest list begin [Joint.through finish] joints
  Right (elementsOf list begin route)
  where
    list = NonEmpty.toList walks
    first = NonEmpty.head walks
    final = NonEmpty.last walks
    endOf side walk = case shape walk of
      OnLine l -> Right (side l)
      AtPoint p -> Right p
      OnCircle _ _ -> Left (NoEnd (place walk) (shape walk))

-- | A closed contour begins where its last link reaches its first element.
closed :: NonEmpty Walk -> Either Fact [Element]
closed walks = do
  joints <- traverse (uncurry jointsOf) (zip list (drop 1 list))
  closing <- jointsOf (NonEmpty.last walks) first
  let attempts = [(c, shortest list (enter c) [c] joints) | c <- NonEmpty.toList (snd closing)]
      routes = [(c, r) | (c, Right r) <- attempts]
  case sortOn (cost . snd) routes of
    [] -> Left (minimumBy (comparing gravity) [f | (_, Left f) <- attempts])
    (c, route) : others -> case [o | (o, r) <- others, cost r <= plus (cost route) Tolerance.sameLength] of
      o : _ | Just fact <- tie (fst closing) [c, o] -> Left fact
      _ -> elementsOf list (enter c) <$> decided route
  where
    list = NonEmpty.toList walks
    first = NonEmpty.head walks
    -- Of several failures the smallest overrun is the most telling.
    gravity fact = case fact of
      Overrun _ _ by _ -> by
      _ -> Mm 0

-- | The places where two neighbours can be joined.
jointsOf :: Walk -> Walk -> Either Fact (Joined, NonEmpty Joint)
jointsOf a b = (joined,) <$> Joint.candidates joined (maybe (Meet Nothing) snd (link a))
  where
    joined = Joined (maybe (place b) fst (link a)) (place a, shape a) (place b, shape b)

-- | A way through the links so far: its length, the joints with the last one first, and the choice between
-- it and another of the same length, if there is one.
data Route = Route {cost :: Mm, taken :: [Joint], ambiguous :: Maybe Fact}

-- | The shortest way from a point on the first element through all links; the last link is given
-- by its candidates.
shortest :: [Walk] -> Point -> [Joint] -> [(Joined, NonEmpty Joint)] -> Either Fact Route
shortest walks begin final joints = go walks [(begin, Route (Mm 0) [] Nothing)] (map Just joints <> [Nothing])
  where
    go ws states layers = case (ws, layers) of
      (w : rest, layer : more) -> do
        next <- advance w states layer
        go rest next more
      _ -> Right (minimumBy (comparing cost) (map snd states))
    advance w states layer = do
      let candidates = maybe final (NonEmpty.toList . snd) layer
          ways joint = [extend w state joint | state <- states]
          reached = [(joint, sortOn cost [r | Right r <- ways joint]) | joint <- candidates]
      case [(joint, best, others) | (joint, best : others) <- reached] of
        [] -> Left (overrun w (minimum [by | joint <- candidates, Left by <- ways joint]) layer)
        fine -> Right [(enter joint, weighed best others) | (joint, best, others) <- fine]
    -- Of two ways of one length to the same joint either will do, but not without asking.
    weighed best others = case [o | o <- others, cost o <= plus (cost best) Tolerance.sameLength] of
      o : _
        | Just (j, a, b) <- firstDifference (reverse (taken best)) (reverse (taken o)) (map fst joints),
          Just fact <- tie j [a, b] ->
          best {ambiguous = Just fact}
      _ -> best
    overrun w by layer = Overrun (place w) (shape w) by (catMaybes [fst <$> link w, jointRegion <$> layer])
    jointRegion (j, _) = Error.link j

-- | A way without another of the same length.
decided :: Route -> Either Fact Route
decided route = maybe (Right route) Left (ambiguous route)

-- | The first link at which two ways part.
firstDifference :: [Joint] -> [Joint] -> [Joined] -> Maybe (Joined, Joint, Joint)
firstDifference as bs js = case (as, bs, js) of
  (a : as', b : bs', j : js')
    | a == b -> firstDifference as' bs' js'
    | otherwise -> Just (j, a, b)
  _ -> Nothing

tie :: Joined -> [Joint] -> Maybe Fact
tie j choice = case mapMaybe inserted choice of
  segments@(_ : _ : _) -> Just (AmbiguousFillet j [centre | Arc {centre} <- segments])
  _ -> Nothing

-- | Walk an element from where a way has come to a joint, and along what the joint inserts; or how far
-- that would be backwards.
extend :: Walk -> (Point, Route) -> Joint -> Either Mm Route
extend w (at, Route c js choice) joint
  | along < Mm 0 = Left (let Mm by = along in Mm (-by))
  | otherwise = Right (Route (plus c (plus along (maybe (Mm 0) Segment.length (inserted joint)))) (joint : js) choice)
  where
    along = walked (shape w) at (leave joint)

-- | How far it is along an element from one of its points to another; negative when it would
-- be backwards along a line.
walked :: Walked -> Point -> Point -> Mm
walked shape a b = case shape of
  OnLine l
    | Vec.near a b -> Mm 0
    | otherwise -> Mm (Vec.dot (Shape.direction l) (Vec.to a b))
  OnCircle _ _ -> maybe (Mm 0) Segment.length (stretch shape a b)
  AtPoint _ -> Mm 0

-- | The segment along an element between two of its points. A circle that is entered where it is left is
-- walked once round: a contour that does not walk an element at all would be the shortest.
stretch :: Walked -> Point -> Point -> Maybe Segment
stretch shape a b = case shape of
  OnLine (Line _ _) -> if Vec.near a b then Nothing else Just (Straight a b)
  OnCircle turn circle@(Circle c _) -> Just (if Vec.near a b then Segment.fullCircle turn circle a else Segment.arc turn c a b)
  AtPoint _ -> Nothing

-- | The segments of a way.
elementsOf :: [Walk] -> Point -> Route -> [Element]
elementsOf walks begin route = go walks begin (reverse (taken route))
  where
    go ws at js = case (ws, js) of
      (Walk place shape link : rest, joint : more) ->
        [Element s place | Just s <- [stretch shape at (leave joint)]]
          <> [Element s (maybe place fst link) | Just s <- [inserted joint]]
          <> go rest (enter joint) more
      _ -> []
