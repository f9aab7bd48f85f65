-- | Evaluates contours: their elements with modifiers and links, and the starting point of a closed
-- contour. A modifier sets the feed, a slow-down, the allowance or the bevel of one element.
module Part.ContourElement
  ( contour,
    ofValues,
    startingNear,
  )
where

import Base.Crash (bug)
import Base.Name (Name)
import Base.Quantity (Mm (..), Rad (..), minus)
import Base.Region (Located (..), Region)
import Checked.Syntax (Item, Item_ (..), Modifier_ (..))
import Checked.Syntax qualified as Checked
import Control.Applicative ((<|>))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes, listToMaybe)
import Data.Semigroup (sconcat)
import Geometry.Carrier (Line (Line), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.ElementCarrier qualified as ElementCarrier
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ContourError (ContourFault (..))
import Part.Curve qualified as Curve
import Part.Error (Error (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.LinkSolver (Link (..))
import Part.LinkSolver qualified as LinkSolver
import Part.Measure (feedOf, lengthOf)
import Part.Parameter qualified as Parameter
import Part.Part
  ( Contour (..),
    ContourElement (ContourElement),
    Ends (..),
    Finish (..),
    plainFinish,
  )
import Part.Part qualified as Part
import Part.Piece qualified as Piece
import Part.Value (Value (..))
import Part.Value qualified as Value

-- | Evaluates the items of a contour's body, and lets "Part.LinkSolver" compute the segments. If
-- elements contain mistakes, it fails with all of these mistakes. Otherwise it fails with the
-- faults of the links.
contour :: Environment -> Located Name -> Located Checked.Closure -> [Item] -> Eval Contour
contour env name closure items = do
  linked <- Evaluation.collect (item env isWhole) items
  case NonEmpty.nonEmpty linked of
    Nothing -> Evaluation.mistake (InContour (EmptyContour (region name) (value name)))
    Just some -> solved name (Located (region closure) ends) some
  where
    ends = case value closure of
      Checked.Open -> Open
      Checked.Closed -> Closed
    -- A closed contour can be the only element of another closed one.
    isWhole = case items of
      [Located _ Element {}] -> ends == Closed
      _ -> False

-- | Makes a closed contour of values, each with its region, without modifiers and links.
ofValues :: Located Name -> NonEmpty (Region, Value) -> Eval Contour
ofValues name values = do
  linked <- traverse element values
  solved name (Located (region name) Closed) (sconcat linked)
  where
    element (at, v) = do
      found <- linkedElements (ItemPlace at at False) Nothing v plainFinish Nothing
      maybe (bug "a value without elements") pure (NonEmpty.nonEmpty found)

-- | Lets the link solver compute the segments of elements. The region is that of the word @open@ or
-- @closed@.
solved :: Located Name -> Located Ends -> NonEmpty LinkSolver.LinkedElement -> Eval Contour
solved name located@(Located _ ends) linked =
  case LinkSolver.solve (region name) located linked of
    Left faults ->
      Evaluation.mistakes [Error (InContour fault) [] [] | fault <- NonEmpty.toList faults]
    Right elements ->
      let list = NonEmpty.toList linked
          written = map asWritten list
          forced = foldr seq written written
          following = NonEmpty.tail linked <> [NonEmpty.head linked | ends == Closed]
          breaks =
            concatMap LinkSolver.breaks linked
              <> map fst (catMaybes (zipWith LinkSolver.breakBetween list following))
       in pure Contour {contourName = name, ends, elements, breaks, writtenElements = forced}

-- | Makes the record of an element as the program wrote it. The ends and the bevels of the linked
-- element are left out.
asWritten :: LinkSolver.LinkedElement -> ContourElement
asWritten w =
  ContourElement
    { Part.elementRegion = LinkSolver.elementRegion w,
      Part.elementCarrier = LinkSolver.carrier w,
      Part.elementCurve = LinkSolver.sourceCurve w,
      Part.elementFinish = LinkSolver.finish w,
      Part.link = snd <$> LinkSolver.link w
    }

-- | The elements that one item of a contour's body gives. A repetition gives the elements of its
-- body once for every value of its list or row of its table. A contour that is used as an element
-- gives several elements, too. The flag is true if the contour may be closed.
item :: Environment -> Bool -> Item -> Eval [LinkSolver.LinkedElement]
item env isWhole (Located at i) = case i of
  For name list body -> do
    turns <- Expression.evaluate env list >>= Expression.turnsOf (region list)
    Evaluation.collect
      (\turn -> Evaluation.collect (item (Expression.bindTurn name turn env) False) body)
      turns
  Choose condition body others -> do
    v <- Expression.evaluate env condition
    Evaluation.collect (item env False) (if Expression.isTrue v then body else others)
  Element sense e modifiers link -> do
    v <- Expression.evaluate env e
    finish <- foldl (\before m -> before >>= modified env m) (pure plainFinish) modifiers
    bevel <- bevelOf env v modifiers
    link' <- traverse (linkOf env) link
    linked <- linkedElements (ItemPlace at (region e) isWhole) sense v finish link'
    pure (if null bevel then linked else map (\w -> w {LinkSolver.bevel}) linked)

-- | Adds the effect of one modifier to the finish (feed, slow-down and allowance) that the earlier
-- modifiers of the element gave. A bevel leaves the finish unchanged, because 'bevelOf' evaluates
-- it.
modified :: Environment -> Checked.Modifier -> Finish -> Eval Finish
modified env (Located _ m) finish = case m of
  ElementFeed e -> (\f -> finish {ownFeed = Just f}) <$> feedOf env e
  Slow -> pure finish {slow = True}
  ElementAllowance e -> (\d -> finish {allowance = d}) <$> lengthOf env Parameter.Allowance e
  Bevel _ -> pure finish

-- | The bevels that the modifiers of an element ask for; empty if none of them is a bevel. A pair
-- is a station and an angle. The station is the arc length in mm from the start of the element. The
-- angle between surface and tool axis is in radians.
bevelOf :: Environment -> Value -> [Checked.Modifier] -> Eval [(Double, Double)]
bevelOf env v modifiers = case [e | Located _ (Bevel e) <- modifiers] of
  [] -> pure []
  e : _ -> Piece.bevelled env (case v of CurveValue c -> Just c; _ -> Nothing) e

-- | The place of an item in a contour's body.
data ItemPlace
  = -- | the region of the item, that of the value in it, and true if a contour in this place may be
    -- closed
    ItemPlace Region Region Bool

-- | The elements that a value gives: several for a contour, otherwise one. @sense@ is the sense
-- that the program writes before a circle.
linkedElements ::
  ItemPlace ->
  Maybe Part.Sense ->
  Value ->
  Finish ->
  Maybe (Region, Link) ->
  Eval [LinkSolver.LinkedElement]
linkedElements (ItemPlace whole at mayBeClosed) sense v finish link = case (v, sense) of
  (CircleValue c, Just Checked.Clockwise) -> one (OnCircle Clockwise c) Nothing Nothing
  (CircleValue c, Just Checked.CounterClockwise) ->
    one (OnCircle CounterClockwise c) Nothing Nothing
  (LineValue l@(Line p q), Nothing) -> one (OnLine l) (Just p) (Just q)
  (Spatial _, Nothing) -> let p = Expression.point v; end = Just p in one (AtPoint p) end end
  (CurveValue c, Nothing) ->
    let ends' = Curve.ends c
     in one (OnCurve (Curve.approximation c)) (listToMaybe ends') (listToMaybe (drop 1 ends'))
  (ContourValue c, Nothing)
    | ends c == Open || mayBeClosed -> pure (elementsOfContour whole at finish link c)
    | otherwise -> Evaluation.mistake (InContour (ClosedElement at (value (contourName c))))
  _ -> bug "a value that is no element where one was checked"
  where
    -- Evaluates the element @w@ at once: a thunk of it would keep the value @v@ in memory.
    one carrier ownStart ownEnd =
      let w =
            LinkSolver.LinkedElement
              { LinkSolver.elementRegion = at,
                LinkSolver.itemRegion = whole,
                LinkSolver.carrier,
                LinkSolver.ownStart,
                LinkSolver.ownEnd,
                LinkSolver.finish,
                LinkSolver.bevel = [],
                LinkSolver.sourceCurve = given,
                LinkSolver.replacedCurve = withDeviation <$> given,
                LinkSolver.breaks = maybe [] Curve.breakPoints given,
                LinkSolver.link
              }
       in w `seq` pure [w]
    given = case v of CurveValue c -> Just c; _ -> Nothing
    withDeviation c = Part.ReplacedCurve (Curve.exact c) Tolerance.curve

-- | The elements that a contour gives when it is used as an element of another contour: one for
-- each of its lines, arcs and curves. @whole@ is the region of the item that names the contour.
-- 'Fixed' links, which have the region @at@, join the elements of an open contour to one another,
-- and @link@ joins the last of them to the next element of the other contour. In a closed contour
-- @link@ is at each corner, and the arc of a fillet turns as the corner does. @finish@ is that of
-- the whole used contour; 'orElse' combines it with the finish of each element.
elementsOfContour ::
  Region ->
  Region ->
  Finish ->
  Maybe (Region, Link) ->
  Contour ->
  [LinkSolver.LinkedElement]
elementsOfContour whole at finish link c =
  withBreaks $ case (Part.curveRuns (NonEmpty.toList (elements c)), ends c) of
    ([], _) -> []
    (runs, Open) -> zipWith run runs (map fixed (init runs) <> [link])
    ([one], Closed) -> [run one link]
    (runs, Closed) -> zipWith run runs (zipWith joint runs (drop 1 runs <> take 1 runs))
  where
    -- The points of the breaks hold for the whole contour, so one element can have them all.
    withBreaks linked = case linked of
      [] -> []
      w : more -> w {LinkSolver.breaks = breaks c} : more
    run = elementOfRun whole finish
    fixed r = Just (at, Fixed (Segment.end (Part.segment (NonEmpty.last r))))
    joint a b =
      let Rad turn =
            Vec.signedAngle
              (Segment.endDirection (Part.segment (NonEmpty.last a)))
              (Segment.startDirection (Part.segment (NonEmpty.head b)))
          Rad smooth = Tolerance.smoothAngle
          sense = if turn > 0 then CounterClockwise else Clockwise
       in case link of
            Just (there, l) | abs turn > smooth -> Just (there, turned sense l)
            _ -> fixed a
    turned sense l = case l of
      Fillet _ r -> Fillet sense r
      _ -> l

-- | One element, made from a run: the segments of one line, arc or curve. @whole@ is the region of
-- the item that names the run's contour. 'orElse' combines the
-- finish of the run with @finish@, that of the whole used contour. @link@ is the link after the
-- element.
elementOfRun ::
  Region ->
  Finish ->
  NonEmpty Part.Element ->
  Maybe (Region, Link) ->
  LinkSolver.LinkedElement
elementOfRun whole finish run@(e :| more) link =
  LinkSolver.LinkedElement
    { LinkSolver.elementRegion = Part.origin e,
      LinkSolver.itemRegion = whole,
      LinkSolver.carrier =
        if null more
          then ElementCarrier.ofSegment (Part.segment e)
          else OnCurve (MeasuredPolyarc.fromSegments (fmap Part.segment run)),
      LinkSolver.ownStart = Just (Segment.start (Part.segment e)),
      LinkSolver.ownEnd = Just (Segment.end (Part.segment (NonEmpty.last run))),
      LinkSolver.finish = Part.finish e `orElse` finish,
      LinkSolver.bevel =
        [(0, b) | Just (b, _) <- [Part.bevel e]]
          <> [(s, b) | (s, Just (_, b)) <- zip ends' (map Part.bevel (NonEmpty.toList run))],
      LinkSolver.sourceCurve = Nothing,
      LinkSolver.replacedCurve = Part.replaced e,
      LinkSolver.breaks = [],
      LinkSolver.link
    }
  where
    ends' = drop 1 (scanl (+) 0 [l | x <- NonEmpty.toList run, let Mm l = lengthOf' x])
    lengthOf' = Segment.length . Part.segment

-- | Combines the finish @own@ of an element of a used contour with the finish @whole@ of the whole
-- used contour. A feed in @own@ has precedence, and so has an allowance in @own@ other than 0. The
-- cutter slows down if either finish asks for it.
orElse :: Finish -> Finish -> Finish
orElse own whole =
  Finish
    { ownFeed = ownFeed own <|> ownFeed whole,
      slow = slow own || slow whole,
      allowance = if allowance own == Mm 0 then allowance whole else allowance own
    }

-- | Evaluates a link. The result keeps the region of the link.
linkOf :: Environment -> Checked.Link -> Eval (Region, Link)
linkOf env (Located at l) =
  (at,) <$> case l of
    Checked.Meet Nothing -> pure (Meet Nothing)
    Checked.Meet (Just p) -> Meet . Just . Expression.point <$> Expression.evaluate env p
    Checked.Smooth -> pure Smooth
    Checked.Tangent -> pure Tangent
    Checked.Fillet e -> do
      r <- Expression.number <$> Expression.evaluate env e
      if r == 0
        then Evaluation.mistake (NotPositive (region e) Parameter.FilletRadius 0)
        else signed r <$ Value.within (region e) r
    Checked.Chamfer e -> Chamfer <$> lengthOf env Parameter.Chamfer e

-- | A fillet with the radius @abs r@ in mm. A positive @r@ makes a clockwise arc, a negative one a
-- counter-clockwise arc, as on the input sheet (Kolsanova).
signed :: Double -> Link
signed r = Fillet (if r > 0 then Carrier.Clockwise else Carrier.CounterClockwise) (Mm (abs r))

-- Starting points

-- | Moves the start of the closed contour @c@ to its point that is nearest to @p@. If this point
-- lies inside a segment, the segment is cut in two there.
startingNear :: Point -> Contour -> Contour
startingNear p c = case splitAt (nearestElement p list) list of
  (before, e : after) -> case NonEmpty.nonEmpty (rotated before e after) of
    Just es -> c {elements = es, writtenElements = []}
    Nothing -> c
  _ -> c
  where
    list = NonEmpty.toList (elements c)
    rotated before e after = case cutNear p (Part.segment e) of
      Just (a, b) ->
        let (first, second) = cutElement e a b
         in second : after <> withoutSlow (Part.continues e) before <> [first]
      Nothing
        | Vec.distance p (Segment.start (Part.segment e))
            <= Vec.distance p (Segment.end (Part.segment e)) ->
          e : after <> before
        | otherwise -> after <> before <> [e]

-- | The index, from 0, of the element that is nearest to @p@. Of equally near elements it is the
-- first. The distance to an element's bounding box excludes most elements.
nearestElement :: Point -> [Part.Element] -> Int
nearestElement p = closest 0 (Mm (1 / 0)) 0
  where
    closest :: Int -> Mm -> Int -> [Part.Element] -> Int
    closest best least i es = case es of
      [] -> best
      e : more
        | minus (boxDistance e) Tolerance.coincident > least -> closest best least (i + 1) more
        | d <- Distance.toPoint p (Part.segment e), d < least -> closest i d (i + 1) more
        | otherwise -> closest best least (i + 1) more
    boxDistance e = BoundingBox.distance p (BoundingBox.ofSegment (Part.segment e))

-- | Cuts the segment @s@ at its point that is nearest to @p@. 'Nothing' if this point is an end of
-- @s@, so that no cut is needed.
cutNear :: Point -> Segment.Segment -> Maybe (Segment.Segment, Segment.Segment)
cutNear p s
  | t <= 0 || t >= 1 || Vec.isNear foot (Segment.start s) || Vec.isNear foot (Segment.end s) =
    Nothing
  | otherwise = Just (Segment.cutAt t s)
  where
    t = Segment.fraction s p
    foot = Segment.at t s

-- | The two parts of the element @e@, whose segment was cut into the segments @a@ and @b@. If the
-- cutter slows down at the end of @e@, it slows down at the end of the second part only.
cutElement :: Part.Element -> Segment.Segment -> Segment.Segment -> (Part.Element, Part.Element)
cutElement e a b =
  ( e
      { Part.segment = a,
        Part.finish = (Part.finish e) {slow = False},
        Part.bevel = (,) <$> fmap fst (Part.bevel e) <*> bevelAtCut
      },
    e
      { Part.segment = b,
        Part.continues = Part.ofCurve e,
        Part.bevel = (,) <$> bevelAtCut <*> fmap snd (Part.bevel e)
      }
  )
  where
    Mm l = Segment.length (Part.segment e)
    Mm front = Segment.length a
    share = if l > 0 then front / l else 0
    bevelAtCut = fmap (\(x, y) -> x + (y - x) * share) (Part.bevel e)

-- | Removes the slow-down from the last elements of a list, if they belong to the same curve as the
-- next element, which is cut. The cutter slows down at the end of the whole curve only. @continued@
-- is true if the next element continues the last one of the list.
withoutSlow :: Bool -> [Part.Element] -> [Part.Element]
withoutSlow continued = reverse . go continued . reverse
  where
    go isContinued es = case es of
      e : others
        | isContinued ->
          e {Part.finish = (Part.finish e) {slow = False}} : go (Part.continues e) others
      _ -> es
