-- | Computes the segments of a contour from its elements and links.
--
-- A joint is one solution of a link. A fillet can have several joints, one for each arc that fits;
-- every other link has one ("Part.LinkCandidate"). Dynamic programming along the contour chooses
-- one joint for each link. Its choice traverses no element backwards and makes the contour as short
-- as possible. Two choices that make equally long contours are a fault.
--
-- A curve is represented by its polyarc, a chain of lines and arcs. A station is the position of a
-- point on a curve: the arc length from the start of its polyarc, in mm.
module Part.LinkSolver
  ( LinkedElement (..),
    Link (..),
    breakBetween,
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
import Data.Maybe (catMaybes, fromMaybe, isNothing, listToMaybe, mapMaybe)
import Data.Ord (comparing)
import Geometry.Carrier (Circle (Circle), Line (Line))
import Geometry.Carrier qualified as Carrier
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.MeasuredPolyarc (MeasuredPolyarc)
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.SelfIntersection qualified as SelfIntersection
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ContourError
  ( ContourEnd (ContourEnd),
    ContourFault (..),
    LinkFault (..),
    Neighbours (Neighbours),
  )
import Part.ContourError qualified as ContourError
import Part.Link (Link (..))
import Part.LinkCandidate (Joint (..))
import Part.LinkCandidate qualified as LinkCandidate
import Part.LinkElement (LinkedElement (..), breakBetween, edgesOf)
import Part.LinkSearch qualified as LinkSearch
import Part.Part (Element (Element, continues, origin, segment), plainFinish)
import Part.Tolerance qualified as Tolerance

-- | Computes the segments of a contour. @region@ is that of the contour's name, and @ends@ has the
-- region of the word @open@ or @closed@. If links cannot
-- join their neighbours, it fails with the faults of all these links. Of other faults it reports
-- only the first.
solve ::
  Region ->
  Located Ends ->
  NonEmpty LinkedElement ->
  Either (NonEmpty ContourFault) (NonEmpty Element)
solve region ends linked = case attempt region ends linked of
  Right elements -> Right elements
  Left found ->
    let faults = fromMaybe (found :| []) (NonEmpty.nonEmpty (unlinked (value ends) linked))
        succeeds as changed = either (const False) (const True) (attempt region as changed)
        fits = succeeds ends
        isMeantClosed =
          case ends of
            Located word Open | succeeds ends {value = Closed} linked -> Just word
            _ -> Nothing
        distinct = withoutRepetition (value ends) linked faults
     in Left (LinkSearch.explained fits isMeantClosed linked distinct)

-- | The faults of the links that cannot join their neighbours. A repetition can make several links
-- with one region, or between elements of the same two regions. Of the faults of such links, only
-- the first is reported.
unlinked :: Ends -> NonEmpty LinkedElement -> [ContourFault]
unlinked ends linked = case linked of
  _ :| [] -> []
  first :| rest ->
    let neighbours = zip (first : rest) (rest <> [first | ends == Closed])
        faults = [(linkRegion a b, f) | (a, b) <- neighbours, Left f <- [jointsOf a b]]
     in oncePerElement (map snd (nubOrdOn pairOf (nubOrdOn fst faults)))
  where
    pairOf (at, f) = case f of
      NotLinked (Neighbours _ (Located a _) (Located b _) _) _ -> (min a b, max a b)
      _ -> (at, at)

-- | Leaves out a fault of two elements that lie apart if the fault before it has one of them, too:
-- one mistake in the numbers of this element makes both faults.
oncePerElement :: [ContourFault] -> [ContourFault]
oncePerElement faults = case faults of
  f : g : more
    | Just (_, shared) <- ContourError.apart f,
      Just (before, _) <- ContourError.apart g,
      shared == before ->
      f : oncePerElement more
  f : more -> f : oncePerElement more
  [] -> []

-- | Joins the faults of links that have one cause: tangents beside elements that are no circles,
-- and fillets beside points. The joined fault takes the place of the first one.
withoutRepetition ::
  Ends -> NonEmpty LinkedElement -> NonEmpty ContourFault -> NonEmpty ContourFault
withoutRepetition ends linked faults =
  fromMaybe faults (NonEmpty.nonEmpty (go (NonEmpty.toList faults)))
  where
    go fs = case fs of
      NotLinked j cause : more
        | cause == TangentNeedsCircles || cause == FilletAtPoint ->
          let same f = case f of
                NotLinked k cause' | cause' == cause -> Just k
                _ -> Nothing
           in NotLinkedOften (j :| mapMaybe same more) cause (edgesOf ends linked) :
              go (filter (isNothing . same) more)
      f : more -> f : go more
      [] -> []

-- | Computes the segments of a contour, or its first fault.
attempt ::
  Region ->
  Located Ends ->
  NonEmpty LinkedElement ->
  Either ContourFault (NonEmpty Element)
attempt region (Located closure ends) linked = do
  chosen <- case (ends, linked) of
    (Closed, only :| []) -> singleElement closure only
    (Closed, _) -> closed linked
    (Open, LinkedElement {elementRegion, carrier = OnCurve c} :| [])
      | MeasuredPolyarc.isClosed c -> Left (ClosedCurve elementRegion closure)
    (Open, _) -> open closure linked
  elements <- maybe (Left (NoLength region)) Right (NonEmpty.nonEmpty (filter isLong chosen))
  let contour = Polyarc.closeGaps segment (\s e -> e {segment = s}) ends elements
      originOf i = origin (contour NonEmpty.!! i)
  case SelfIntersection.firstSelfIntersectionBy segment ends contour of
    Just (i, j, p) ->
      let beside = [hasFillet a || hasFillet b | (a, b) <- pairs, isMeeting b]
          isMeeting w = elementRegion w `elem` [originOf i, originOf j]
       in Left (CrossesItself region (originOf i) (originOf j) p (or beside) Nothing)
    Nothing -> Right contour
  where
    isLong e = Segment.length (segment e) > Tolerance.coincident
    -- Each element with the one before it, which has the link that leads to it.
    pairs = case linked of first :| rest -> zip (NonEmpty.last linked : first : rest) (first : rest)
    hasFillet w = case link w of
      Just (_, Fillet _ _) -> True
      _ -> False

-- | The segments of a closed contour that consists of one element. A circle begins at its rightmost
-- point, a closed curve at its own start. @closure@ is the region of the word @closed@.
singleElement :: Region -> LinkedElement -> Either ContourFault [Element]
singleElement closure w@LinkedElement {elementRegion, carrier, link} = case (carrier, link) of
  (OnCircle _ _, Just (at, _)) -> Left (LinkOfLoneCircle at)
  (OnCircle sense circle@(Circle c (Mm r)), Nothing) ->
    Right (marked w (Mm 0) [Segment.fullCircle sense circle (Vec.shift (Vec.vec r 0) c)])
  (OnCurve c, Nothing)
    | MeasuredPolyarc.isClosed c ->
      Right (closedSmoothly (marked w (Mm 0) (NonEmpty.toList (MeasuredPolyarc.segments c))))
  (OnCurve c, Just (at, _)) | MeasuredPolyarc.isClosed c -> Left (LinkOfLoneCircle at)
  (OnCurve _, _) -> Left (LoneElement elementRegion carrier asOpen)
  (OnLine _, _) -> Left (LoneElement elementRegion carrier asOpen)
  (AtPoint _, _) -> Left (LoneElement elementRegion carrier asOpen)
  where
    asOpen = if isNothing link then Just closure else Nothing

-- | Marks the first segment of a closed curve as a continuation of the last one. Leaves it unmarked
-- if there is a corner between them.
closedSmoothly :: [Element] -> [Element]
closedSmoothly elements = case elements of
  first : rest@(_ : _)
    | isSmooth (segment (last rest)) (segment first) ->
      first {continues = True} : rest
  _ -> elements

-- | True if segment @b@ continues segment @a@ without a corner.
isSmooth :: Segment -> Segment -> Bool
isSmooth a b =
  -- The cross product excludes most corners, and costs less than the angle.
  Rad (abs (Vec.cross u v)) <= times 2 Tolerance.smoothAngle
    && (let Rad angle = Vec.signedAngle u v in Rad (abs angle) <= Tolerance.smoothAngle)
  where
    u = Segment.endDirection a
    v = Segment.startDirection b

-- | The segments of an open contour, from the start of its first element to the end of its last
-- one. @closure@ is the region of the word @open@.
open :: Region -> NonEmpty LinkedElement -> Either ContourFault [Element]
open closure linked = do
  begin <- maybe (Left (withoutEnd first)) Right (ownStart first)
  end <- maybe (Left (withoutEnd final)) Right (ownEnd final)
  case link final of
    Just (at, _) -> Left (LinkAtEnd at closure)
    Nothing -> Right ()
  case withoutChoice list begin Nothing (LinkCandidate.through end) of
    Just elements -> Right elements
    Nothing -> do
      joints <- traverse (uncurry jointsOf) (zip list (drop 1 list))
      route <- unambiguous =<< shortest list begin Nothing [LinkCandidate.through end] joints
      Right (elementsOf list begin Nothing route)
  where
    list = NonEmpty.toList linked
    first = NonEmpty.head linked
    final = NonEmpty.last linked
    isLone = null (NonEmpty.tail linked)
    withoutEnd w =
      NoEnd
        (elementRegion w)
        (carrier w)
        ( [ContourEnd (itemRegion first) True (carrier first) | isNothing (ownStart first)]
            <> [ContourEnd (itemRegion final) False (carrier final) | isNothing (ownEnd final)]
        )
        (if isLone then Just closure else Nothing)

-- | The segments of a closed contour. It begins at the point where the link after the last element
-- reaches the first element.
closed :: NonEmpty LinkedElement -> Either ContourFault [Element]
closed linked
  | Right (c :| []) <- jointsOf (NonEmpty.last linked) (NonEmpty.head linked),
    Just elements <- withoutChoice (NonEmpty.toList linked) (enter c) (inserted c) c =
    Right elements
  | otherwise = closedByShortest linked

-- | The segments of a closed contour in which a link has several joints, or the fault of the
-- contour. Solves the contour once for each joint of the link after the last element, and takes the
-- shortest result.
closedByShortest :: NonEmpty LinkedElement -> Either ContourFault [Element]
closedByShortest linked = do
  joints <- traverse (uncurry jointsOf) (zip list (drop 1 list))
  closing <- jointsOf final first
  let attempts =
        [(c, shortest list (enter c) (inserted c) [c] joints) | c <- NonEmpty.toList closing]
      routes = [(c, r) | (c, Right r) <- attempts]
  case sortOn (cost . snd) routes of
    [] -> Left (minimumBy (comparing overlapOf) [f | (_, Left f) <- attempts])
    (c, route) : others ->
      case [o | (o, r) <- others, cost r <= plus (cost route) Tolerance.sameLength] of
        o : _ | Just fault <- tie (neighboursOf final first) [c, o] -> Left fault
        _ -> elementsOf list (enter c) (inserted c) <$> unambiguous route
  where
    list = NonEmpty.toList linked
    first = NonEmpty.head linked
    final = NonEmpty.last linked
    -- Orders the faults of several attempts; only the first is reported. Elements that are too
    -- short are ordered by the length that they lack. All other faults come before them.
    overlapOf fault = case fault of
      Overrun _ _ overlap _ _ -> overlap
      _ -> Mm 0

-- | All joints of element @a@ with element @b@ after it. Two elements without a link between them
-- meet.
jointsOf :: LinkedElement -> LinkedElement -> Either ContourFault (NonEmpty Joint)
jointsOf a b = case (maybe (Meet Nothing) snd (link a), breakBetween a b) of
  (Smooth, Just (p, q)) -> Right (Joint p q Nothing :| [])
  (written, _) ->
    LinkCandidate.candidates (neighboursOf a b) (catMaybes [ownEnd a, ownStart b]) written

-- | Two neighbouring elements with the region of the link between them, for reports.
neighboursOf :: LinkedElement -> LinkedElement -> Neighbours
neighboursOf a b =
  Neighbours
    (linkRegion a b)
    (Located (elementRegion a) (carrier a))
    (Located (elementRegion b) (carrier b))
    (itemRegion a, itemRegion b)

-- | The region of the link between two neighbours. Without a link it is the region of element @b@.
linkRegion :: LinkedElement -> LinkedElement -> Region
linkRegion a b = maybe (elementRegion b) fst (link a)

-- Dynamic programming

-- | A choice of one joint for each link, from the start of the contour up to some link.
--
-- 'cost' is the length in mm of the part of the contour that it makes, and 'taken' are the joints,
-- the last one first. If another choice makes an equally long contour, 'ambiguous' is the fault
-- that reports this.
data Route = Route {cost :: Mm, taken :: [Joint], ambiguous :: Maybe ContourFault}

-- | The values that stay the same during one run of the dynamic programming. 'previous' is the
-- segment that the last link of a closed contour inserts before the first element.
data Stage = Stage {previous :: Maybe Segment, allElements :: [LinkedElement]}

-- | The shortest route through all links. It starts at the point @begin@ of the first element, and
-- @before@ is the segment inserted before this point. @final@ are the joints at which the last
-- element may end. @joints@ has one list for each link between two elements: its joints.
shortest ::
  [LinkedElement] ->
  Point ->
  Maybe Segment ->
  [Joint] ->
  [NonEmpty Joint] ->
  Either ContourFault Route
shortest linked begin before final joints =
  go linked [(begin, Route (Mm 0) [] Nothing)] (map NonEmpty.toList joints <> [final])
  where
    stage = Stage {previous = before, allElements = linked}
    go ws states layers = case (ws, layers) of
      (w : rest, layer : more) -> do
        next <- advance stage w (listToMaybe rest) states layer
        go rest next more
      _ -> Right (minimumBy (comparing cost) (map snd states))

-- | One step of the dynamic programming. Each of the @states@ is a point on element @w@ and the
-- route that reaches it. The step extends each route to each of the @joints@ at the end of @w@. It
-- keeps only the shortest route to each joint. @next@ is the element after @w@, for a report.
advance ::
  Stage ->
  LinkedElement ->
  Maybe LinkedElement ->
  [(Point, Route)] ->
  [Joint] ->
  Either ContourFault [(Point, Route)]
advance stage w next states joints = case (states, joints) of
  -- Most links have one joint, so that one route remains.
  ([state], [joint]) -> case extend (previous stage) w state joint of
    Left overlap -> Left (overrun stage w overlap next)
    Right route -> Right [(enter joint, route)]
  _ -> do
    let extended joint = [extend (previous stage) w state joint | state <- states]
        reached = [(joint, sortOn cost [r | Right r <- extended joint]) | joint <- joints]
    case [(joint, best, others) | (joint, best : others) <- reached] of
      [] ->
        let overlaps = [overlap | joint <- joints, Left overlap <- extended joint]
         in Left (overrun stage w (minimum overlaps) next)
      sound -> Right [(enter joint, withTie stage best others) | (joint, best, others) <- sound]

-- | The shortest route @best@ to a joint. If one of the routes @others@ is equally long, the result
-- also holds the fault that reports this.
withTie :: Stage -> Route -> [Route] -> Route
withTie stage best others =
  case [o | o <- others, cost o <= plus (cost best) Tolerance.sameLength] of
    o : _
      | Just (j, a, b) <- firstDifference (reverse (taken best)) (reverse (taken o)) links,
        Just fault <- tie j [a, b] ->
        best {ambiguous = Just fault}
    _ -> best
  where
    links = zipWith neighboursOf (allElements stage) (drop 1 (allElements stage))

-- | The fault that element @w@ is too short, by the length @overlap@, for the links at its ends.
overrun :: Stage -> LinkedElement -> Mm -> Maybe LinkedElement -> ContourFault
overrun stage w overlap next =
  Overrun
    (elementRegion w)
    (carrier w)
    overlap
    (catMaybes [fst <$> link w, linkRegion w <$> next] <> linksBefore)
    Nothing
  where
    linked = allElements stage
    linksBefore =
      [ at
        | (a, b) <- zip linked (drop 1 linked <> take 1 linked),
          elementRegion b == elementRegion w,
          Just (at, _) <- [link a]
      ]

-- | Fails if another route is equally long.
unambiguous :: Route -> Either ContourFault Route
unambiguous route = maybe (Right route) Left (ambiguous route)

-- | The first link at which two lists of joints differ: its neighbours, and its joint in each list.
-- @js@ are the neighbours of all links, in the order of the lists.
firstDifference :: [Joint] -> [Joint] -> [Neighbours] -> Maybe (Neighbours, Joint, Joint)
firstDifference as bs js = case (as, bs, js) of
  (a : as', b : bs', j : js')
    | a == b -> firstDifference as' bs' js'
    | otherwise -> Just (j, a, b)
  _ -> Nothing

-- | The fault that the two joints in @choice@ make equally long contours. @j@ are the neighbours of
-- their link. 'Nothing' unless both joints insert a segment.
tie :: Neighbours -> [Joint] -> Maybe ContourFault
tie j choice = case mapMaybe inserted choice of
  segments@(_ : _ : _) ->
    Just (NotLinked j (AmbiguousFillet [centre | Arc {centre} <- segments]))
  _ -> Nothing

-- | Extends a route that has reached the point @at@ of element @w@. The extension follows @w@ to
-- the joint, and then the segment that the joint inserts. @before@ is the segment inserted before
-- the first element. If @w@ would be traversed backwards, which is not allowed, the result is
-- 'Left' with the length of the backward part in mm.
extend :: Maybe Segment -> LinkedElement -> (Point, Route) -> Joint -> Either Mm Route
extend before w (at, Route c js choice) joint
  | along < Mm 0 = Left (let Mm x = along in Mm (-x))
  | otherwise = Right (Route (plus c (plus along insertedLength)) (joint : js) choice)
  where
    along = lengthOn (carrier w) (arrival before js) (inserted joint) at (leave joint)
    insertedLength = maybe (Mm 0) Segment.length (inserted joint)

-- | The segment inserted just before an element that a route has reached. @js@ are the joints of
-- the route, the newest first. If there are none, the segment is @before@.
arrival :: Maybe Segment -> [Joint] -> Maybe Segment
arrival before js = case js of
  [] -> before
  j : _ -> inserted j

-- Segments along elements

-- | The length along an element from its point @a@ to its point @b@, negative if @b@ lies before
-- @a@. @before@ and @after@ are the segments inserted at @a@ and @b@.
lengthOn :: ElementCarrier -> Maybe Segment -> Maybe Segment -> Point -> Point -> Mm
lengthOn shape before after a b = case shape of
  OnLine l
    | Vec.isNear a b -> Mm 0
    | otherwise -> Mm (Vec.dot (Carrier.direction l) (Vec.to a b))
  OnCircle _ _ -> total (map Segment.length (segmentsOn shape before after a b))
  OnCurve c -> let (Mm from, Mm to) = stations c a b in Mm (to - from)
  AtPoint _ -> Mm 0

-- | The segments along an element from its point @a@ to its point @b@. @before@ and @after@ are the
-- segments inserted at @a@ and @b@.
--
-- On a circle, two equal points give a full circle. Without this rule, the shortest contour would
-- skip the circle. There is one exception: a circle between two straight segments whose directions
-- differ by less than 60° gives no segment. An example is the middle one of three equal circles
-- joined by tangents.
segmentsOn :: ElementCarrier -> Maybe Segment -> Maybe Segment -> Point -> Point -> [Segment]
segmentsOn shape before after a b = case shape of
  OnLine (Line _ _) -> [Straight a b | not (Vec.isNear a b)]
  OnCircle sense circle@(Circle c _)
    | Vec.isNear a b && passesBy -> []
    | Vec.isNear a b -> [Segment.fullCircle sense circle a]
    | otherwise -> [Segment.arc sense c a b]
  OnCurve c
    | to > MeasuredPolyarc.length c ->
      MeasuredPolyarc.segmentsBetween c from (MeasuredPolyarc.length c)
        <> MeasuredPolyarc.segmentsBetween c (Mm 0) (minus to (MeasuredPolyarc.length c))
    | otherwise -> MeasuredPolyarc.segmentsBetween c from to
    where
      (from, to) = stations c a b
  AtPoint _ -> []
  where
    passesBy = case (before, after) of
      (Just (Straight p q), Just (Straight s t)) ->
        Vec.dot (Vec.unit (Vec.to p q)) (Vec.unit (Vec.to s t)) > 0.5
      _ -> False

-- | The stations of the points @a@ and @b@ on the curve @c@. On a closed curve the station of @b@
-- must be the larger one. The length of the curve is therefore added to it if necessary.
stations :: MeasuredPolyarc -> Point -> Point -> (Mm, Mm)
stations c a b
  | MeasuredPolyarc.isClosed c && (to <= from || Vec.isNear a b) =
    (from, plus to (MeasuredPolyarc.length c))
  | otherwise = (from, to)
  where
    from =
      if Vec.isNear a (MeasuredPolyarc.start c) then Mm 0 else MeasuredPolyarc.nearestStation c a
    to =
      if Vec.isNear b (MeasuredPolyarc.end c) && not (MeasuredPolyarc.isClosed c)
        then MeasuredPolyarc.length c
        else MeasuredPolyarc.nearestStation c b

-- | The station of the point @a@ on an element that is followed from @a@ to @b@. It is 0 on a line,
-- a circle or a point, which have no stations.
entryStation :: ElementCarrier -> Point -> Point -> Mm
entryStation shape a b = case shape of
  OnCurve c -> fst (stations c a b)
  OnLine _ -> Mm 0
  OnCircle _ _ -> Mm 0
  AtPoint _ -> Mm 0

-- | Makes an 'Element' of each of the segments @whole@, which follow one another along one element
-- of the program. @from@ is the station in mm at which the first segment begins. Segments are cut
-- at the stations of the bevels. A segment that continues the segment before it without a corner is
-- marked.
marked :: LinkedElement -> Mm -> [Segment] -> [Element]
marked w (Mm from) whole = case whole of
  [] -> []
  first : rest | null bevel -> unbevelled False first rest
  _ -> zipWith3 element cuts (False : isContinued) (zip marks (drop 1 marks))
  where
    unbevelled continues s rest =
      let e = Element s elementRegion finish continues isCurve replacedCurve Nothing
       in e `seq` (e : continued s rest)
    continued s rest = case rest of
      [] -> []
      next : more -> unbevelled (isSmooth s next) next more
    element s continues (a, b) =
      let bevels = (,) <$> interpolated angles a <*> interpolated angles b
       in Element s elementRegion finish continues isCurve replacedCurve bevels
    LinkedElement {elementRegion, carrier, finish, bevel, replacedCurve} = w
    (isCurve, closedLength) = case carrier of
      OnCurve c ->
        (True, if MeasuredPolyarc.isClosed c then Just (MeasuredPolyarc.length c) else Nothing)
      OnLine _ -> (False, Nothing)
      OnCircle _ _ -> (False, Nothing)
      AtPoint _ -> (False, Nothing)
    -- The bevels by station. On a closed curve each bevel is repeated at a station larger by the
    -- curve's length, because the stations of its segments may exceed this length.
    angles =
      Map.fromList (bevel <> [(s + l, a) | Just (Mm l) <- [closedLength], (s, a) <- drop 1 bevel])
    cuts =
      if Map.size angles > 1
        then concat (zipWith (cutAtKeys angles) (stationsOf whole) whole)
        else whole
    isContinued = zipWith isSmooth cuts (drop 1 cuts)
    marks = stationsOf cuts
    stationsOf = scanl (\s g -> let Mm l = Segment.length g in s + l) from

-- | Cuts the segment @s@ at those keys of the table that are stations inside it. @from@ is the
-- station of its start in mm.
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

-- | Interpolates linearly between the nearest key of the table at or below @s@ and the nearest one
-- at or above it. Outside of the keys the result is the value at the nearest key. 'Nothing' if the
-- table is empty.
interpolated :: Map Double Double -> Double -> Maybe Double
interpolated table s = case (Map.lookupLE s table, Map.lookupGE s table) of
  (Just (a, x), Just (b, y)) -> Just (if b > a then x + (y - x) * (s - a) / (b - a) else x)
  (Just (_, x), Nothing) -> Just x
  (Nothing, Just (_, y)) -> Just y
  (Nothing, Nothing) -> Nothing

-- | The segments of a contour, without dynamic programming. @begin@ is the starting point on the
-- first element, @before@ the segment inserted before it, and @final@ the joint after the last
-- element. 'Nothing' if a link has several joints or none, or if an element would be traversed
-- backwards. The caller then uses dynamic programming.
--
-- Each joint is computed twice, which takes less time than keeping all of them.
withoutChoice :: [LinkedElement] -> Point -> Maybe Segment -> Joint -> Maybe [Element]
withoutChoice linked begin before final
  | allForwards linked begin = Just (from linked begin before)
  | otherwise = Nothing
  where
    allForwards ws at = case ws of
      [] -> True
      w : rest -> case jointTo w rest of
        Just joint -> isForwards (carrier w) at (leave joint) && allForwards rest (enter joint)
        Nothing -> False
    from ws at previous' = case ws of
      w : rest
        | Just joint <- jointTo w rest ->
          between w at previous' joint <> from rest (enter joint) (inserted joint)
      _ -> []
    jointTo w rest = case rest of
      [] -> Just final
      next : _ -> case jointsOf w next of
        Right (joint :| []) -> Just joint
        _ -> Nothing
    isForwards w a b = case w of
      OnCircle _ _ -> True
      AtPoint _ -> True
      OnLine _ -> lengthOn w Nothing Nothing a b >= Mm 0
      OnCurve _ -> lengthOn w Nothing Nothing a b >= Mm 0

-- | Makes the 'Element' values along the element @w@ of the program, from its point @at@ to a
-- joint. The segment that the joint inserts gives one more. @before@ is the segment inserted before
-- @at@.
between :: LinkedElement -> Point -> Maybe Segment -> Joint -> [Element]
between w@LinkedElement {elementRegion, carrier, link} at before joint =
  marked w (entryStation carrier at (leave joint)) segments
    <> [ Element s (maybe elementRegion fst link) plainFinish False False Nothing Nothing
         | Just s <- [inserted joint]
       ]
  where
    segments = segmentsOn carrier before (inserted joint) at (leave joint)

-- | Makes the 'Element' values of a contour whose joints are those of a route. @begin@ is the
-- starting point on the first element, and @before@ the segment inserted before it.
elementsOf :: [LinkedElement] -> Point -> Maybe Segment -> Route -> [Element]
elementsOf linked begin before route = go linked begin before (reverse (taken route))
  where
    go ws at previous' js = case (ws, js) of
      (w : rest, joint : more) ->
        between w at previous' joint <> go rest (enter joint) (inserted joint) more
      _ -> []
