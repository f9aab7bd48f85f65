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
    Just (i, j, p) -> Left (CrossesItself region (origin (contour NonEmpty.!! i)) (origin (contour NonEmpty.!! j)) p)
    Nothing -> Right contour
  where
    long e = Segment.length (segment e) > Tolerance.coincident
    nothingLeft = case NonEmpty.head walks of
      Walk {place, shape} -> Overrun place shape (Mm 0) []

-- | A closed contour of one element: a circle, from its rightmost point.
lone :: Walk -> Either Fact [Element]
lone (Walk place shape link) = case (shape, link) of
  (_, Just (at, _)) -> Left (SameCurve (Joined at (place, shape) (place, shape)))
  (OnCircle turn circle@(Circle c (Mm r)), Nothing) ->
    Right [Element (Segment.fullCircle turn circle (Vec.shift (Vec.vec r 0) c)) place]
  (OnLine _, Nothing) -> Left (LoneElement place shape)
  (AtPoint _, Nothing) -> Left (LoneElement place shape)

-- | An open contour runs from the first point of its first element to the last one of its last.
open :: NonEmpty Walk -> Either Fact [Element]
open walks = do
  begin <- endOf Shape.from first
  finish <- endOf Shape.to final
  case link final of
    Just (at, _) -> Left (LinkAtEnd at (place first))
    Nothing -> Right ()
  joints <- traverse (uncurry jointsOf) (zip list (drop 1 list))
  route <- shortest list begin [Joint.through finish] joints
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
      o : _ | Just ambiguous <- tie (fst closing) [c, o] -> Left ambiguous
      _ -> Right (elementsOf list (enter c) route)
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

-- | A way through all links: the joints in order, the last one first, and its length so far.
data Route = Route {cost :: Mm, taken :: [Joint]}

-- | The shortest way from a point on the first element through all links; the last link is given
-- by its candidates.
shortest :: [Walk] -> Point -> [Joint] -> [(Joined, NonEmpty Joint)] -> Either Fact Route
shortest walks begin final joints = go walks [(begin, Route (Mm 0) [])] (map Just joints <> [Nothing])
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
        fine -> do
          mapM_ unambiguous fine
          Right [(enter joint, best) | (joint, best, _) <- fine]
    -- Two ways of one length to the same joint differ in the link before it.
    unambiguous (_, best, others) = case [o | o <- others, cost o <= plus (cost best) Tolerance.sameLength] of
      o : _
        | Just (j, a, b) <- firstDifference (reverse (taken best)) (reverse (taken o)) (map fst joints),
          Just fact <- tie j [a, b] ->
          Left fact
      _ -> Right ()
    overrun w by layer = Overrun (place w) (shape w) by (catMaybes [fst <$> link w, jointRegion <$> layer])
    jointRegion (j, _) = Error.link j

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
extend w (at, Route c js) joint
  | along < Mm 0 = Left (let Mm by = along in Mm (-by))
  | otherwise = Right (Route (plus c (plus along (maybe (Mm 0) Segment.length (inserted joint)))) (joint : js))
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

-- | The segment along an element between two of its points; none when they are one.
stretch :: Walked -> Point -> Point -> Maybe Segment
stretch shape a b
  | Vec.near a b = Nothing
  | otherwise = case shape of
    OnLine (Line _ _) -> Just (Straight a b)
    OnCircle turn (Circle c _) -> Just (Segment.arc turn c a b)
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
