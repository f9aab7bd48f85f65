-- | From walked elements and links to the segments of a contour.
--
-- Every link has a few places where it can join its neighbours (two fillets, one
-- intersection …). Of all combinations in which every element is walked forwards, the one
-- that makes the whole contour shortest is taken, by dynamic programming along the
-- contour.
module Part.LinkSolver
  ( LinkedElement (..),
    Link (..),
    solve,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus, times, total)
import Base.Region (Located (..), Region)
import Data.Containers.ListUtils (nubOrdOn)
import Data.List (minimumBy, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes, listToMaybe, mapMaybe)
import Data.Maybe qualified as Maybe
import Data.Ord (comparing)
import Geometry.Carrier (Circle (Circle), Line (Line))
import Geometry.Carrier qualified as Carrier
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.MeasuredPolyarc (Polyarc)
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.SelfIntersection qualified as SelfIntersection
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Curve (PartCurve)
import Part.Error (Joined (Joined), ValueFact (..))
import Part.Error qualified as Error
import Part.LinkCandidate (Joint (..), Link (..))
import Part.LinkCandidate qualified as LinkCandidate
import Part.Part (Element (Element, continues, origin, segment), Finish, plainFinish)
import Part.Tolerance qualified as Tolerance

-- | An element, its place, the ends that it has of its own, what is asked on it, and the link
-- behind it with its place.
data LinkedElement = LinkedElement
  { place :: Region,
    shape :: ElementCarrier,
    begins :: Maybe Point,
    stops :: Maybe Point,
    finish :: Finish,
    -- | how far its surface leans: places along it in mm with angles in radians, rising; one holds
    -- all along
    bevel :: [(Double, Double)],
    -- | the curve that it is, exactly
    source :: Maybe PartCurve,
    link :: Maybe (Region, Link)
  }
  deriving stock (Eq, Show)

-- | The elements of a contour that stands at a region, or all that is wrong with it.
solve :: Region -> Ends -> NonEmpty LinkedElement -> Either (NonEmpty ValueFact) (NonEmpty Element)
solve region ends walks = case attempt region ends walks of
  Right elements -> Right elements
  Left found ->
    Left
      ( fmap
          (withLargest region ends walks)
          (Maybe.fromMaybe (found :| []) (NonEmpty.nonEmpty nonMeeting))
      )
  where
    -- Links that fail whatever the others do; in a repetition, and there and back between two
    -- elements, one of them is enough.
    pairOf (at, f) = case Error.joined' f of
      Just (Joined _ (Located a _) (Located b _)) -> (min a b, max a b)
      Nothing -> (at, at)
    nonMeeting = case walks of
      _ :| [] -> []
      first :| rest ->
        map
          snd
          ( nubOrdOn
              pairOf
              ( nubOrdOn
                  fst
                  [ (linkPlace a b, f)
                    | (a, b) <- zip (first : rest) (rest <> [first | ends == Closed]),
                      Left f <- [jointsOf a b]
                  ]
              )
          )

-- | Say of a fillet that does not fit the largest that does.
withLargest :: Region -> Ends -> NonEmpty LinkedElement -> ValueFact -> ValueFact
withLargest region ends walks fact = case fact of
  NoFillet j r _ -> NoFillet j r (largestFillet region ends walks [Error.link j])
  Overrun at w by links _ -> Overrun at w by links (largestFillet region ends walks links)
  _ -> fact

-- | The largest radius that one of some fillets may have, the others staying as they are; or else
-- all that have its radius together.
largestFillet :: Region -> Ends -> NonEmpty LinkedElement -> [Region] -> Maybe Mm
largestFillet region ends walks links =
  listToMaybe (mapMaybe (uncurry search) (map alone given <> map together given))
  where
    given =
      [ (at, r)
        | LinkedElement {link = Just (at, Fillet _ r)} <- NonEmpty.toList walks,
          at `elem` links
      ]
    alone (at, r) = (r, \at' _ -> at' == at)
    together (_, r) = (r, \_ r' -> r' == r)
    search (Mm r) chosen =
      listToMaybe
        [ grown chosen low (2 * low)
          | low <- takeWhile (> smallest) (drop 1 (iterate (/ 2) r)),
            fits chosen low
        ]
    Mm smallest = Tolerance.smallestFillet
    -- Between a radius that fits and one that does not.
    grown chosen low high
      | high - low <= low * 1e-9 = Mm low
      | fits chosen middle = grown chosen middle high
      | otherwise = grown chosen low middle
      where
        middle = (low + high) / 2
    fits chosen r = case attempt region ends (fmap (with chosen r) walks) of
      Right _ -> True
      Left _ -> False
    with chosen r w = case link w of
      Just (at, Fillet turn r') | chosen at r' -> w {link = Just (at, Fillet turn (Mm r))}
      _ -> w

attempt :: Region -> Ends -> NonEmpty LinkedElement -> Either ValueFact (NonEmpty Element)
attempt region ends walks = do
  chosen <- case (ends, walks) of
    (Closed, only :| []) -> lone only
    (Closed, _) -> closed walks
    (Open, LinkedElement {place, shape = OnCurve c} :| [])
      | MeasuredPolyarc.isClosed c ->
        Left (ClosedCurve place)
    (Open, _) -> open walks
  elements <- maybe (Left nothingLeft) Right (NonEmpty.nonEmpty (filter long chosen))
  let contour = Polyarc.chained segment (\s e -> e {segment = s}) ends elements
  case SelfIntersection.crossingOf segment ends contour of
    Just (i, j, p) ->
      Left
        ( CrossesItself
            region
            (origin (contour NonEmpty.!! i))
            (origin (contour NonEmpty.!! j))
            p
            (any hasFillet walks)
        )
    Nothing -> Right contour
  where
    long e = Segment.length (segment e) > Tolerance.coincident
    nothingLeft = NoLength region
    hasFillet w = case link w of
      Just (_, Fillet _ _) -> True
      _ -> False

-- | A closed contour of one element: a circle, from its rightmost point.
lone :: LinkedElement -> Either ValueFact [Element]
lone w@LinkedElement {place, shape, link} = case (shape, link) of
  (OnCircle _ _, Just (at, _)) -> Left (LinkOfLoneCircle at)
  (OnCircle turn circle@(Circle c (Mm r)), Nothing) ->
    Right (marked w (Mm 0) [Segment.fullCircle turn circle (Vec.shift (Vec.vec r 0) c)])
  (OnCurve c, Nothing)
    | MeasuredPolyarc.isClosed c ->
      Right (roundly (marked w (Mm 0) (NonEmpty.toList (MeasuredPolyarc.segments c))))
  (OnCurve c, Just (at, _)) | MeasuredPolyarc.isClosed c -> Left (LinkOfLoneCircle at)
  (OnCurve _, _) -> Left (LoneElement place shape)
  (OnLine _, _) -> Left (LoneElement place shape)
  (AtPoint _, _) -> Left (LoneElement place shape)

-- | The elements of a closed curve, of which the first goes on with the last if there is no corner.
roundly :: [Element] -> [Element]
roundly elements = case elements of
  first : rest@(_ : _)
    | smoothly (segment (last rest)) (segment first) ->
      first {continues = True} : rest
  _ -> elements

-- | Whether one segment goes over into another without a corner.
smoothly :: Segment -> Segment -> Bool
smoothly a b =
  Rad (abs (Vec.cross u v)) <= times 2 Tolerance.smoothAngle
    && (let Rad turned = Vec.turn u v in Rad (abs turned) <= Tolerance.smoothAngle)
  where
    -- Most corners turn by an angle whose sine tells already.
    u = Segment.endDirection a
    v = Segment.startDirection b

-- | An open contour runs from the first point of its first element to the last one of its last.
open :: NonEmpty LinkedElement -> Either ValueFact [Element]
open walks = do
  begin <- endOf begins first
  end <- endOf stops final
  case link final of
    Just (at, _) -> Left (LinkAtEnd at (place first))
    Nothing -> Right ()
  case directly list begin Nothing (LinkCandidate.through end) of
    Just elements -> Right elements
    Nothing -> do
      joints <- traverse (uncurry jointsOf) (zip list (drop 1 list))
      route <- decided =<< shortest list begin Nothing [LinkCandidate.through end] joints
      Right (elementsOf list begin Nothing route)
  where
    list = NonEmpty.toList walks
    first = NonEmpty.head walks
    final = NonEmpty.last walks
    endOf side walk = maybe (Left (NoEnd (place walk) (shape walk))) Right (side walk)

-- | A closed contour begins where its last link reaches its first element.
closed :: NonEmpty LinkedElement -> Either ValueFact [Element]
closed walks
  | Right (c :| []) <- jointsOf (NonEmpty.last walks) (NonEmpty.head walks),
    Just elements <- directly (NonEmpty.toList walks) (enter c) (inserted c) c =
    Right elements
  | otherwise = selected walks

-- | The same where some link joins its neighbours in several places, or something is wrong.
selected :: NonEmpty LinkedElement -> Either ValueFact [Element]
selected walks = do
  joints <- traverse (uncurry jointsOf) (zip list (drop 1 list))
  closing <- jointsOf (NonEmpty.last walks) first
  let attempts =
        [(c, shortest list (enter c) (inserted c) [c] joints) | c <- NonEmpty.toList closing]
      routes = [(c, r) | (c, Right r) <- attempts]
  case sortOn (cost . snd) routes of
    [] -> Left (minimumBy (comparing gravity) [f | (_, Left f) <- attempts])
    (c, route) : others ->
      case [o | (o, r) <- others, cost r <= plus (cost route) Tolerance.sameLength] of
        o : _ | Just fact <- tie (joinedBetween (NonEmpty.last walks) first) [c, o] -> Left fact
        _ -> elementsOf list (enter c) (inserted c) <$> decided route
  where
    list = NonEmpty.toList walks
    first = NonEmpty.head walks
    -- Of several failures the smallest overrun is the most telling.
    gravity fact = case fact of
      Overrun _ _ by _ _ -> by
      _ -> Mm 0

-- | The places where two neighbours can be joined.
jointsOf :: LinkedElement -> LinkedElement -> Either ValueFact (NonEmpty Joint)
jointsOf a b =
  LinkCandidate.candidates
    (joinedBetween a b)
    (catMaybes [stops a, begins b])
    (maybe (Meet Nothing) snd (link a))

-- | Two neighbours and the link between them, for a report.
joinedBetween :: LinkedElement -> LinkedElement -> Joined
joinedBetween a b =
  Joined (linkPlace a b) (Located (place a) (shape a)) (Located (place b) (shape b))

-- | Where the link between two neighbours stands.
linkPlace :: LinkedElement -> LinkedElement -> Region
linkPlace a b = maybe (place b) fst (link a)

-- | A way through the links so far: its length, the joints with the last one first, and the choice
-- between it and another of the same length, if there is one.
data Route = Route {cost :: Mm, taken :: [Joint], ambiguous :: Maybe ValueFact}

-- | The shortest way from a point on the first element through all links; the last link is given
-- by its candidates.
shortest ::
  [LinkedElement] ->
  Point ->
  Maybe Segment ->
  [Joint] ->
  [NonEmpty Joint] ->
  Either ValueFact Route
shortest walks begin before final joints =
  go walks [(begin, Route (Mm 0) [] Nothing)] (map NonEmpty.toList joints <> [final])
  where
    go ws states layers = case (ws, layers) of
      (w : rest, layer : more) -> do
        next <- advance w (listToMaybe rest) states layer
        go rest next more
      _ -> Right (minimumBy (comparing cost) (map snd states))
    -- Most links join their neighbours in one place.
    advance w next [state] [joint] = case extend before w state joint of
      Left by -> Left (overrun w by next)
      Right route -> Right [(enter joint, route)]
    advance w next states candidates = do
      let ways joint = [extend before w state joint | state <- states]
          reached = [(joint, sortOn cost [r | Right r <- ways joint]) | joint <- candidates]
      case [(joint, best, others) | (joint, best : others) <- reached] of
        [] -> Left (overrun w (minimum [by | joint <- candidates, Left by <- ways joint]) next)
        fine -> Right [(enter joint, weighed best others) | (joint, best, others) <- fine]
    -- Of two ways of one length to the same joint either will do, but not without asking.
    weighed best others = case [o | o <- others, cost o <= plus (cost best) Tolerance.sameLength] of
      o : _
        | Just (j, a, b) <-
            firstDifference
              (reverse (taken best))
              (reverse (taken o))
              (zipWith joinedBetween walks (drop 1 walks)),
          Just fact <- tie j [a, b] ->
          best {ambiguous = Just fact}
      _ -> best
    overrun w by next =
      Overrun
        (place w)
        (shape w)
        by
        (catMaybes [fst <$> link w, linkPlace w <$> next] <> linkBefore w)
        Nothing
    linkBefore w =
      [ at
        | (a, b) <- zip walks (drop 1 walks <> take 1 walks),
          place b == place w,
          Just (at, _) <- [link a]
      ]

-- | A way without another of the same length.
decided :: Route -> Either ValueFact Route
decided route = maybe (Right route) Left (ambiguous route)

-- | The first link at which two ways part.
firstDifference :: [Joint] -> [Joint] -> [Joined] -> Maybe (Joined, Joint, Joint)
firstDifference as bs js = case (as, bs, js) of
  (a : as', b : bs', j : js')
    | a == b -> firstDifference as' bs' js'
    | otherwise -> Just (j, a, b)
  _ -> Nothing

tie :: Joined -> [Joint] -> Maybe ValueFact
tie j choice = case mapMaybe inserted choice of
  segments@(_ : _ : _) -> Just (AmbiguousFillet j [centre | Arc {centre} <- segments])
  _ -> Nothing

-- | Walk an element from where a way has come to a joint, and along what the joint inserts; or how
-- far that would be backwards. What was walked before the first joint is given.
extend :: Maybe Segment -> LinkedElement -> (Point, Route) -> Joint -> Either Mm Route
extend before w (at, Route c js choice) joint
  | along < Mm 0 = Left (let Mm by = along in Mm (-by))
  | otherwise =
    Right
      ( Route
          (plus c (plus along (maybe (Mm 0) Segment.length (inserted joint))))
          (joint : js)
          choice
      )
  where
    along = walked (shape w) (arrival before js) (inserted joint) at (leave joint)

-- | What was walked right before an element.
arrival :: Maybe Segment -> [Joint] -> Maybe Segment
arrival before js = case js of
  [] -> before
  j : _ -> inserted j

-- | How far it is along an element from one of its points to another; negative when it would
-- be backwards along a line.
walked :: ElementCarrier -> Maybe Segment -> Maybe Segment -> Point -> Point -> Mm
walked shape before behind a b = case shape of
  OnLine l
    | Vec.near a b -> Mm 0
    | otherwise -> Mm (Vec.dot (Carrier.direction l) (Vec.to a b))
  OnCircle _ _ -> total (map Segment.length (stretch shape before behind a b))
  OnCurve c -> let (Mm from, Mm to) = stations c a b in Mm (to - from)
  AtPoint _ -> Mm 0

-- | The segment along an element between two of its points. A circle that is entered where it is
-- left is walked once round (a contour that does not walk an element at all would be the shortest),
-- unless a straight line goes by it: circles in a row, joined by tangents.
stretch :: ElementCarrier -> Maybe Segment -> Maybe Segment -> Point -> Point -> [Segment]
stretch shape before behind a b = case shape of
  OnLine (Line _ _) -> [Straight a b | not (Vec.near a b)]
  OnCircle turn circle@(Circle c _)
    | Vec.near a b && goesBy -> []
    | Vec.near a b -> [Segment.fullCircle turn circle a]
    | otherwise -> [Segment.arc turn c a b]
  OnCurve c
    | to > MeasuredPolyarc.length c ->
      MeasuredPolyarc.stretch c from (MeasuredPolyarc.length c)
        <> MeasuredPolyarc.stretch c (Mm 0) (minus to (MeasuredPolyarc.length c))
    | otherwise -> MeasuredPolyarc.stretch c from to
    where
      (from, to) = stations c a b
  AtPoint _ -> []
  where
    goesBy = case (before, behind) of
      (Just (Straight p q), Just (Straight s t)) ->
        Vec.dot (Vec.unit (Vec.to p q)) (Vec.unit (Vec.to s t)) > 0.5
      _ -> False

-- | Where on a curve the walk enters and where it leaves; on a closed one, that may be in the next
-- round.
stations :: Polyarc -> Point -> Point -> (Mm, Mm)
stations c a b
  | MeasuredPolyarc.isClosed c && (to <= from || Vec.near a b) =
    (from, plus to (MeasuredPolyarc.length c))
  | otherwise = (from, to)
  where
    from = if Vec.near a (MeasuredPolyarc.start c) then Mm 0 else MeasuredPolyarc.station c a
    to =
      if Vec.near b (MeasuredPolyarc.end c) && not (MeasuredPolyarc.isClosed c)
        then MeasuredPolyarc.length c
        else MeasuredPolyarc.station c b

-- | The place on a curve at which the walk enters it.
begun :: ElementCarrier -> Point -> Point -> Mm
begun shape a b = case shape of
  OnCurve c -> fst (stations c a b)
  OnLine _ -> Mm 0
  OnCircle _ _ -> Mm 0
  AtPoint _ -> Mm 0

-- | The segments of one element from a place on it, cut where its bevel is known. Those that go on
-- smoothly on the same curve are marked.
marked :: LinkedElement -> Mm -> [Segment] -> [Element]
marked LinkedElement {place, shape, finish, bevel} (Mm from) whole = case whole of
  [] -> []
  first : rest | null bevel -> unbevelled False first rest
  _ -> zipWith3 element ss (False : zipWith smoothly ss (drop 1 ss)) (zip marks (drop 1 marks))
  where
    unbevelled continues s rest =
      let e = Element s place finish continues isCurve Nothing in e `seq` (e : behind s rest)
    behind s rest = case rest of
      [] -> []
      next : more -> unbevelled (smoothly s next) next more
    element s continues (a, b) =
      Element s place finish continues isCurve ((,) <$> leaning angles a <*> leaning angles b)
    (isCurve, round') = case shape of
      OnCurve c ->
        (True, if MeasuredPolyarc.isClosed c then Just (MeasuredPolyarc.length c) else Nothing)
      OnLine _ -> (False, Nothing)
      OnCircle _ _ -> (False, Nothing)
      AtPoint _ -> (False, Nothing)
    -- A closed curve may be walked on into its next round.
    angles = Map.fromList (bevel <> [(s + l, a) | Just (Mm l) <- [round'], (s, a) <- drop 1 bevel])
    ss =
      if Map.size angles > 1 then concat (zipWith (cutAtKeys angles) (along whole) whole) else whole
    marks = along ss
    along = scanl (\s g -> let Mm l = Segment.length g in s + l) from

-- | A segment that begins at a place, cut at the places of a table.
cutAtKeys :: Map Double a -> Double -> Segment -> [Segment]
cutAtKeys table from s = case Map.lookupGT (from + least) table of
  Just (at, _)
    | at < from + l - least,
      (a, b) <- Segment.cutAt ((at - from) / l) s ->
      a : cutAtKeys table at b
  _ -> [s]
  where
    Mm l = Segment.length s
    Mm least = Tolerance.coincident

-- | The angle at a place along an element, from those at some places.
leaning :: Map Double Double -> Double -> Maybe Double
leaning angles s = case (Map.lookupLE s angles, Map.lookupGE s angles) of
  (Just (a, x), Just (b, y)) -> Just (if b > a then x + (y - x) * (s - a) / (b - a) else x)
  (Just (_, x), Nothing) -> Just x
  (Nothing, Just (_, y)) -> Just y
  (Nothing, Nothing) -> Nothing

-- | The elements from a point on the first one to a joint behind the last one, if every link
-- between joins its neighbours in one place alone and none is walked backwards: then there is
-- nothing to choose. What was walked right before them is given. Joints are found anew for the
-- elements: that takes less time than to keep all of them.
directly :: [LinkedElement] -> Point -> Maybe Segment -> Joint -> Maybe [Element]
directly walks begin before final
  | sound walks begin = Just (from walks begin before)
  | otherwise = Nothing
  where
    sound ws at = case ws of
      [] -> True
      w : rest -> case jointTo w rest of
        Just joint -> forwards (shape w) at (leave joint) && sound rest (enter joint)
        Nothing -> False
    from ws at came = case ws of
      w : rest
        | Just joint <- jointTo w rest ->
          between w at came joint <> from rest (enter joint) (inserted joint)
      _ -> []
    jointTo w rest = case rest of
      [] -> Just final
      next : _ -> case jointsOf w next of
        Right (joint :| []) -> Just joint
        _ -> Nothing
    -- Along a circle or to a point no way is backwards.
    forwards w a b = case w of
      OnCircle _ _ -> True
      AtPoint _ -> True
      OnLine _ -> walked w Nothing Nothing a b >= Mm 0
      OnCurve _ -> walked w Nothing Nothing a b >= Mm 0

-- | The segments of one element from a point on it to a joint, and what that inserts.
between :: LinkedElement -> Point -> Maybe Segment -> Joint -> [Element]
between w@LinkedElement {place, shape, link} at came joint =
  marked w (begun shape at (leave joint)) (stretch shape came (inserted joint) at (leave joint))
    <> [ Element s (maybe place fst link) plainFinish False False Nothing
         | Just s <- [inserted joint]
       ]

-- | The segments of a way.
elementsOf :: [LinkedElement] -> Point -> Maybe Segment -> Route -> [Element]
elementsOf walks begin before route = go walks begin before (reverse (taken route))
  where
    go ws at came js = case (ws, js) of
      (w : rest, joint : more) ->
        between w at came joint <> go rest (enter joint) (inserted joint) more
      _ -> []
