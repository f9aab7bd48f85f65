-- | What stands in the braces of a contour, evaluated.
module Part.ContourElement
  ( contour,
    feedOf,
    lengthOf,
    positive,
    startingNear,
  )
where

import Base.Crash (bug)
import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.Quantity (Feed (..), Mm (..), minus)
import Base.Region (Located (..), Region)
import Checked.Syntax (Expr, Item, Item_ (..), Modifier_ (..))
import Checked.Syntax qualified as Checked
import Control.Applicative ((<|>))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Text (Text)
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
import Part.Curve qualified as Curve
import Part.Error (Error (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.LinkSolver (Link (..))
import Part.LinkSolver qualified as LinkSolver
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

-- | The contour of a name.
contour :: Environment -> Located Name -> Checked.Closure -> [Item] -> Eval Contour
contour env name closure items = do
  walks <- Evaluation.collect (item env) items
  case NonEmpty.nonEmpty walks of
    Nothing -> Evaluation.mistake (EmptyContour (region name) (value name))
    Just some -> case LinkSolver.solve (region name) ends some of
      Left facts -> Evaluation.mistakes (NonEmpty.toList (fmap (`Error` []) facts))
      Right elements ->
        let legs =
              map leg (NonEmpty.toList some)
         in pure Contour {contourName = name, ends, elements, legs = foldr seq legs legs}
  where
    ends = case closure of
      Checked.Open -> Open
      Checked.Closed -> Closed
    leg w =
      ContourElement
        { Part.spot = LinkSolver.place w,
          Part.shape = LinkSolver.shape w,
          Part.source = LinkSolver.source w,
          Part.asked = LinkSolver.finish w,
          Part.link = snd <$> LinkSolver.link w
        }

item :: Environment -> Item -> Eval [LinkSolver.LinkedElement]
item env (Located _ i) = case i of
  For name list body -> do
    vs <- Expression.items <$> Expression.evaluate env list
    Evaluation.collect (\v -> Evaluation.collect (item (Expression.bind name v env)) body) vs
  Choose condition body others -> do
    v <- Expression.evaluate env condition
    Evaluation.collect (item env) (if Expression.isTrue v then body else others)
  Element walk e modifiers link -> do
    v <- Expression.evaluate env e
    finish <- foldl (\before m -> before >>= modified env m) (pure plainFinish) modifiers
    bevel <- bevelOf env v modifiers
    link' <- traverse (linkOf env) link
    walks <- walksOf (region e) walk v finish link'
    pure (if null bevel then walks else map (\w -> w {LinkSolver.bevel}) walks)

modified :: Environment -> Checked.Modifier -> Finish -> Eval Finish
modified env (Located _ m) finish = case m of
  AtElementFeed e -> (\f -> finish {ownFeed = Just f}) <$> feedOf env e
  Slow -> pure finish {slow = True}
  ElementAllowance e -> (\d -> finish {allowance = d}) <$> lengthOf env "the allowance" e
  Bevel _ -> pure finish

-- | How far an element leans, along it.
bevelOf :: Environment -> Value -> [Checked.Modifier] -> Eval [(Double, Double)]
bevelOf env v modifiers = case [e | Located _ (Bevel e) <- modifiers] of
  [] -> pure []
  e : _ -> Piece.bevelled env (case v of CurveValue c -> Just c; _ -> Nothing) e

-- | The walks of an element: one, or those of a whole contour.
walksOf ::
  Region ->
  Maybe Part.Sense ->
  Value ->
  Finish ->
  Maybe (Region, Link) ->
  Eval [LinkSolver.LinkedElement]
walksOf at walk v finish link = case (v, walk) of
  (CircleValue c, Just Checked.Clockwise) -> one (OnCircle Clockwise c) Nothing Nothing
  (CircleValue c, Just Checked.CounterClockwise) ->
    one (OnCircle CounterClockwise c) Nothing Nothing
  (LineValue l@(Line p q), Nothing) -> one (OnLine l) (Just p) (Just q)
  (Spatial _, Nothing) -> let p = Expression.point v; end = Just p in one (AtPoint p) end end
  (CurveValue c, Nothing) ->
    one (OnCurve (Curve.laid c)) (listToMaybe (Curve.ends c)) (listToMaybe (drop 1 (Curve.ends c)))
  (ContourValue c, Nothing) -> case ends c of
    Closed -> Evaluation.mistake (ClosedElement at (value (contourName c)))
    Open -> pure (chained (NonEmpty.toList (elements c)))
  _ -> bug "an element that can not be walked"
  where
    -- It is made at once: what it is made of is not held.
    one shape begins stops =
      let w =
            LinkSolver.LinkedElement
              { LinkSolver.place = at,
                LinkSolver.shape,
                LinkSolver.begins,
                LinkSolver.stops,
                LinkSolver.finish,
                LinkSolver.bevel = [],
                LinkSolver.source = case v of CurveValue c -> Just c; _ -> Nothing,
                LinkSolver.link
              }
       in w `seq` pure [w]
    chained es = case Part.runs es of
      [] -> []
      runs' ->
        zipWith
          walkOf
          runs'
          ( map (Just . (at,) . Fixed . Segment.end . Part.segment . NonEmpty.last) (init runs')
              <> [link]
          )
    walkOf run@(e :| more) link' =
      LinkSolver.LinkedElement
        { LinkSolver.place = Part.origin e,
          LinkSolver.shape =
            if null more
              then ElementCarrier.ofSegment (Part.segment e)
              else OnCurve (MeasuredPolyarc.fromSegments (fmap Part.segment run)),
          LinkSolver.begins = Just (Segment.start (Part.segment e)),
          LinkSolver.stops = Just (Segment.end (Part.segment (NonEmpty.last run))),
          LinkSolver.finish = merged (Part.finish e),
          LinkSolver.bevel =
            [(0, b) | Just (b, _) <- [Part.bevel e]]
              <> [ (s, b)
                   | (s, Just (_, b)) <-
                       zip (drop 1 (stationsOf run)) (map Part.bevel (NonEmpty.toList run))
                 ],
          LinkSolver.source = Nothing,
          LinkSolver.link = link'
        }
    stationsOf run =
      scanl (+) 0 [l | x <- NonEmpty.toList run, let Mm l = Segment.length (Part.segment x)]
    -- What is asked on the whole counts where its elements ask nothing.
    merged own =
      Finish
        { ownFeed = ownFeed own <|> ownFeed finish,
          slow = slow own || slow finish,
          allowance = if allowance own == Mm 0 then allowance finish else allowance own
        }

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
        then Evaluation.mistake (NotPositive (region e) "the radius of a fillet" "0 mm")
        else signed r <$ Value.within (region e) r
    Checked.Chamfer e -> Chamfer <$> lengthOf env "the chamfer" e

-- | +R is walked clockwise, −R counter-clockwise (Kolsanova: links between pieces).
signed :: Double -> Link
signed r = Fillet (if r > 0 then Carrier.Clockwise else Carrier.CounterClockwise) (Mm (abs r))

-- | A quantity above zero; what it is and how it is written for the report.
positive :: Environment -> Text -> (q -> Text) -> (Double -> q) -> Expr -> Eval q
positive env what written make e = do
  x <- Expression.number <$> Expression.evaluate env e
  if x <= 0
    then Evaluation.mistake (NotPositive (region e) what (written (make x)))
    else make x <$ Value.within (region e) x

lengthOf :: Environment -> Text -> Expr -> Eval Mm
lengthOf env what = positive env what Decimal.mm Mm

feedOf :: Environment -> Expr -> Eval (Located Feed)
feedOf env e =
  Located (region e)
    <$> positive env "the feed" (\(Feed f) -> Decimal.short 4 f <> " mm/min") Feed e

-- | A closed contour that begins where it comes nearest to a point.
startingNear :: Point -> Contour -> Contour
startingNear p c = case NonEmpty.nonEmpty turned of
  Just es -> c {elements = es, legs = []}
  Nothing -> c
  where
    list = NonEmpty.toList (elements c)
    nearest = closest 0 (Mm (1 / 0)) 0 list
    -- The number of the first element that is nearest, or of the nearest one so far.
    closest :: Int -> Mm -> Int -> [Part.Element] -> Int
    closest best least i es = case es of
      [] -> best
      e : more
        | minus
            (BoundingBox.distance p (BoundingBox.ofSegment (Part.segment e)))
            Tolerance.coincident
            > least ->
          closest best least (i + 1) more
        | d <- Distance.toPoint p (Part.segment e), d < least -> closest i d (i + 1) more
        | otherwise -> closest best least (i + 1) more
    (before, from) = splitAt nearest list
    turned = case from of
      [] -> list
      e : rest -> case cut (Part.segment e) of
        Nothing
          | Vec.distance p (Segment.start (Part.segment e))
              <= Vec.distance p (Segment.end (Part.segment e)) ->
            from <> before
          | otherwise -> rest <> before <> [e]
        Just (a, b) ->
          let Mm l = Segment.length (Part.segment e)
              share = if l > 0 then (let Mm front = Segment.length a in front) / l else 0
              lean = fmap (\(x, y) -> x + (y - x) * share) (Part.bevel e)
           in e
                { Part.segment = b,
                  Part.continues = Part.ofCurve e,
                  Part.bevel = (,) <$> lean <*> fmap snd (Part.bevel e)
                } :
              rest
                <> unhurried (Part.continues e) before
                <> [ e
                       { Part.segment = a,
                         Part.finish = (Part.finish e) {slow = False},
                         Part.bevel = (,) <$> fmap fst (Part.bevel e) <*> lean
                       }
                   ]
    -- A curve that is cut slows down where it ends, not where it is cut.
    unhurried goesOn = reverse . backwards goesOn . reverse
    backwards goesOn es = case es of
      e : others
        | goesOn ->
          e {Part.finish = (Part.finish e) {slow = False}} : backwards (Part.continues e) others
      _ -> es
    -- The segment in two, unless the point is at one of its ends.
    cut s
      | t <= 0 || t >= 1 || Vec.near foot (Segment.start s) || Vec.near foot (Segment.end s) =
        Nothing
      | otherwise = Just (Segment.cutAt t s)
      where
        t = Segment.fraction s p
        foot = Segment.at t s
