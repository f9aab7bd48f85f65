-- | An evaluated part as a sheet: every milled contour an array of pieces, every stop a point.
module Sheet.FromPart
  ( fromPart,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (Name))
import Base.Quantity (Feed (..), Mm (..), Rad (..))
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Checked.Syntax qualified as Checked
import Data.Foldable (toList)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Part.Curve qualified as Curve
import Part.LinkCandidate qualified as LinkCandidate
import Part.Part (Milling, Part)
import Part.Part qualified as Part
import Part.Tolerance qualified as Tolerance
import Sheet.FromCurve (here)
import Sheet.FromCurve qualified as FromCurve
import Sheet.Sheet
import Sheet.Unsupported (Unfit (..))

-- | The sheet of a part, or all that does not fit one. The program tells the dimensions of a cone,
-- which the part no longer knows.
fromPart :: Checked.Program -> Part -> Result w Unfit Sheet
fromPart written part = case (Part.start part, runsOf (Part.operations part)) of
  (_, Left e) -> Result [] [e] Nothing
  (Nothing, _) -> Result [] [NoWay Nothing "the program does not say where the tool stands"] Nothing
  (Just _, Right ([], _)) -> Result [] [NoWay Nothing "the program mills nothing"] Nothing
  (Just (Located _ spot), Right (one : more, final)) ->
    checkCount (one : more)
      *> ( build
             <$> generalData written part (fmap milled (one :| more))
               <*> wayOf spot (one : more) final
               <*> traverse (arrayOf . milled) (one :| more)
         )
  where
    build general (approach, onwards) arrays' =
      case NonEmpty.zipWith (\a w -> a {onward = w}) arrays' onwards of
        a :| as -> Sheet {general, approach, first = a, others = as}
    checkCount list = case drop mostArrays list of
      [] -> pure ()
      r : _ -> refused (ManyArrays (region' r))

refused :: Unfit -> Result w Unfit a
refused e = Result [] [e] Nothing

-- | A contour that is milled, and the stops before it.
data Run = Run {stops :: [Part.Stop], region' :: Region, milled :: (Region, Milling)}

-- | The contours, and the stops behind the last one.
runsOf :: [Part.Operation] -> Either Unfit ([Run], [Part.Stop])
runsOf = go []
  where
    go before operations = case operations of
      [] -> Right ([], before)
      Part.Travel ss : rest -> go (before <> toList ss) rest
      Part.Mill (Located at m) : rest -> do
        (runs, final) <- go (Part.retract m) rest
        Right
          ( Run
              { stops = before <> Part.approach m,
                region' = keyword at,
                milled = (keyword at, m)
              } :
            runs,
            final
          )
      Part.Pocket (Located at _) : _ -> Left (NoNumbers at "the clearing of a pocket")
      Part.Drill (Located at _) : _ -> Left (NoNumbers at "drilling")
      Part.Command (Located at c) : _ -> Left (NoNumbers at (commandName c))
    commandName c = case c of
      Part.SpindleOn _ _ -> "a command to the spindle"
      Part.SpindleOff -> "a command to the spindle"
      Part.CoolantTo _ -> "a command to the coolant"
      Part.Auxiliary _ -> "an auxiliary command"
      Part.ChangeTool _ _ -> "a second tool"

-- | The first word of a statement that mills or turns.
keyword :: Region -> Region
keyword (Region a b) = Region a (min b (a + 4))

-- General data

generalData :: Checked.Program -> Part -> NonEmpty (Region, Milling) -> Result w Unfit General
generalData written part ((at, one) :| more) = do
  mapM_ differs more
  side <- sideOf (Part.side one)
  tolerance <- case Part.tolerance one of
    Part.OnPath (Mm t) -> pure t
    Part.Band _ _ -> refused (NoNumbers at "a tolerance that differs inside and outside")
  pure
    General
      { productCipher = here product',
        partCipher = here part',
        program = here (numberOf (Part.name part)),
        diameter = here d,
        gear = here (maybe 0 (\(Mm g) -> g) (Part.gear one)),
        bevel = here b,
        height = here h,
        tolerance = here tolerance,
        side
      }
  where
    (product', part') = fromMaybe (0, 0) (titleNumbers =<< Part.title part)
    (d, b, h) = toolOf written (Part.radius one)
    differs (place, m) = do
      same place "tool" (Part.radius m == Part.radius one && Part.gear m == Part.gear one)
      same place "tolerance" (Part.tolerance m == Part.tolerance one)
      same place "side of the walk" (value (Part.side m) == value (Part.side one))
    same place what holds = if holds then pure () else refused (TwoOfOne place what)

sideOf :: Located Part.Side -> Result w Unfit (Located (Maybe Side))
sideOf (Located at side) = case side of
  Part.LeftSide -> pure (here (Just LeftSide))
  Part.RightSide -> pure (here (Just RightSide))
  Part.On -> pure (here Nothing)
  Part.Outside -> refused (NoNumbers at "the outside of a contour")
  Part.Inside -> refused (NoNumbers at "the inside of a contour")

-- | Diameter, bevel in degrees and height of the tool: those of the program's cone, if it touches
-- at this radius. Without a bevel it is a cylinder.
toolOf :: Checked.Program -> Mm -> (Double, Double, Double)
toolOf written (Mm radius) =
  case [ (d, mu, h)
         | Located _ (Checked.Tool (Located _ (Checked.ConeCutter a b c))) <-
             Checked.statements written,
           Just d <- [literal a],
           Just mu <- [literal b],
           Just h <- [literal c]
       ] of
    (d, mu, h) : _ | mu /= 0, d / 2 + h * tan mu == radius -> (d, FromCurve.degreesOf mu, h)
    _ -> (2 * radius, 0, 0)
  where
    literal (Located _ e) = case e of
      Checked.Number n -> Just n
      Checked.Negate inner -> negate <$> literal inner
      _ -> Nothing

-- | The number in a name as 'Sheet.ToSurface.partName' makes it; 0 for other names.
numberOf :: Maybe Name -> Double
numberOf name = fromMaybe 0 $ do
  Name text <- name
  wholeNumber =<< Text.stripPrefix "program_" text

-- | The numbers in a title as 'Sheet.ToSurface.partTitle' makes it.
titleNumbers :: Text -> Maybe (Double, Double)
titleNumbers title = do
  rest <- Text.stripPrefix "Product " title
  let (a, more) = Text.breakOn ", part " rest
  (,) <$> wholeNumber a <*> (wholeNumber =<< Text.stripPrefix ", part " more)

-- | A number of at most nine digits.
wholeNumber :: Text -> Maybe Double
wholeNumber text =
  if Text.length text <= 9 && not (Text.any (== '.') text) then Decimal.amount text else Nothing

-- The way

-- | The points up to the first array, and those behind each: where the tool stands at first, the
-- runs, the stops behind the last one.
wayOf ::
  Part.SpacePoint ->
  [Run] ->
  [Part.Stop] ->
  Result w Unfit (NonEmpty Waypoint, NonEmpty (NonEmpty Waypoint))
wayOf spot runs final = do
  feeds <- traverse feedOfRun runs
  before <- traverse (traverse paced . stops) runs
  after <- traverse paced final
  case (runs, before, feeds) of
    (_, first' : rest, f : fs) -> do
      let z0 = let Mm z = Part.height spot in z
          (z1, begin) = walk z0 [] first'
          approach = points (Vec.x (Part.plane spot), Vec.y (Part.plane spot), z0) begin f
      mapM_
        (refused . unheighted)
        [ s
          | Run {milled = (_, m)} : _ <- [runs],
            Just _ <- [Part.gear m],
            s <- concatMap stops (drop 1 runs) <> final,
            Nothing <- [Part.level s]
        ]
      onwards <- behind z1 f (zip3 (map region' runs) (rest <> [after]) (map Just fs <> [Nothing]))
      maybe
        (refused (NoWay Nothing "the program mills nothing"))
        (pure . (approach,))
        (NonEmpty.nonEmpty onwards)
    _ -> refused (NoWay Nothing "the program mills nothing")
  where
    unheighted s =
      NoWay
        (Just (region (Part.place s)))
        "a swivelling blade leaves its height, and this point does not say one"
    walk z done list = case list of
      [] -> (z, reverse done)
      (s, pace) : rest ->
        let z' = maybe z (\(Mm h) -> h) (Part.level s)
            p = value (Part.place s)
         in walk z' (((Vec.x p, Vec.y p, z'), pace) : done) rest
    points at list feed' = case list of
      [] -> waypoint at feed' :| []
      (next, pace) : rest -> waypoint at pace NonEmpty.<| points next rest feed'
    behind z f list = case list of
      [] -> pure []
      (at, ss, onto) : rest -> case walk z [] ss of
        (z', (place, pace) : others') -> do
          if pace == f
            then pure ()
            else
              refused
                ( NoFeed
                    (maybe at (region . Part.place . fst) (listToMaybe ss))
                    "the tool leaves a contour at another feed than that of the contour"
                    "On a sheet a feed holds from a point on: go to the first point behind a \
                    \contour at the contour's feed, and from there as you like."
                )
          (points place others' (fromMaybe 0 onto) :) <$> behind z' (fromMaybe 0 onto) rest
        (_, []) -> refused (NoWay (Just at) "behind this contour the tool goes to no point")
    waypoint (a, b, c) f = Waypoint {x = here a, y = here b, z = here c, feed = here f}

-- | A stop and the feed at which it is reached.
paced :: Part.Stop -> Result w Unfit (Part.Stop, Double)
paced s = case Part.pace s of
  Part.Rapid -> pure (s, rapidFeed)
  Part.At f -> (s,) <$> plainFeed f

feedOfRun :: Run -> Result w Unfit Double
feedOfRun = plainFeed . Part.feed . snd . milled

plainFeed :: Located Feed -> Result w Unfit Double
plainFeed (Located at (Feed f))
  | f >= rapidFeed =
    refused (NoFeed at "a feed of 9999 mm/min or more" "On a sheet 9999 means rapid.")
  | otherwise = pure f

-- Arrays

-- | The pieces of a contour, and what is asked of its milling; the way on is still open.
arrayOf :: (Region, Milling) -> Result w Unfit Array
arrayOf (at, m) = do
  mapM_ (refused . NoNumbers at) $
    ["turning" | Part.work m == Part.Turned]
      <> ["a depth" | not (null (Part.levels m))]
      <> ["a lead" | Just _ <- [Part.leadIn m, Part.leadOut m]]
      <> ["an allowance of all of a contour" | Part.allowances m /= Mm 0 :| []]
      <> ["a sharp corner" | Part.corners m == Part.Sharp]
      <> ["a compensation by the control" | Just _ <- [Part.byControl m]]
  case NonEmpty.nonEmpty (Part.legs contour) of
    _
      | Part.ends contour == Part.Closed ->
        refused (NoPiece name "a closed contour" "A sheet joins its pieces to open contours.")
    Nothing ->
      refused
        ( NoPiece
            name
            "a contour that is moved, turned, or made of others"
            "Write its pieces down where they are walked."
        )
    Just legs -> do
      pieces' <- traverse (pieceOf m) legs
      links <- traverse linkOf (NonEmpty.init legs)
      pure
        Array
          { joined = zipWith LinkedPiece (NonEmpty.init pieces') links,
            final = NonEmpty.last pieces',
            onward = nowhere :| []
          }
  where
    contour = Part.contour m
    name = region (Part.contourName contour)
    nowhere = Waypoint {x = here 0, y = here 0, z = here 0, feed = here 0}

pieceOf :: Milling -> Part.ContourElement -> Result w Unfit Piece
pieceOf m leg = case Part.source leg of
  Nothing ->
    refused
      ( NoPiece
          at
          "this element"
          "Elements of a sheet are curves: write a line as polyline([p, q]), a curve as \
          \spline(table), and those of another contour once more."
      )
  Just curve -> do
    mapM_
      ( \f ->
          refused
            ( NoFeed
                (region f)
                "an element with a feed of its own"
                "On a sheet all pieces of an array have one feed."
            )
      )
      (Part.ownFeed (Part.asked leg))
    made <- FromCurve.piece at (Curve.exact curve) (Part.asked leg)
    mapM_ (const (swivelling at curve made leans)) (Part.gear m)
    pure made
  where
    at = Part.spot leg
    leans =
      [ (Part.segment e, b)
        | e <- toList (Part.elements (Part.contour m)),
          Part.origin e == at,
          Just b <- [Part.bevel e]
      ]

-- | A blade swivels on every piece with a bevel by that bevel, and on the others not at all: on
-- each element by what the bevels of the rows come to at its ends.
swivelling ::
  Region ->
  Curve.PartCurve ->
  Piece ->
  [(Segment, (Double, Double))] ->
  Result w Unfit ()
swivelling at curve made leans
  | surfaced made && null leans =
    refused
      ( NoCipher
          at
          "the blade does not swivel by the bevel of its cipher"
          "Behind an element with a 4 write: bevel mu"
      )
  | any differs (concat [[(Segment.start e, a), (Segment.end e, b)] | (e, (a, b)) <- leans]) =
    refused
      ( NoCipher
          at
          "the blade swivels by another bevel than that of its cipher"
          "Behind an element with a 4 write: bevel mu; behind another one: bevel 0"
      )
  | otherwise = pure ()
  where
    bevels = [maybe 0 (\w -> value (mu w) * pi / 180) (surface r) | r <- toList (rows made)]
    marks = Curve.along curve (Vector.fromList bevels)
    differs (p, b) =
      let Mm s =
            MeasuredPolyarc.station (Curve.laid curve) p
          Rad slack = Tolerance.bevel
       in abs (b - between s marks) > 2 * slack
    between s known = case known of
      (a, x) : more@((b, y) : _)
        | s <= b || null (drop 1 more) ->
          if b > a then x + (y - x) * max 0 (min 1 ((s - a) / (b - a))) else y
        | otherwise -> between s more
      [(_, x)] -> x
      [] -> 0

linkOf :: Part.ContourElement -> Result w Unfit (Located Link)
linkOf leg = case Part.link leg of
  Nothing -> pure (here Intersection)
  Just (LinkCandidate.Meet Nothing) -> pure (here Intersection)
  Just LinkCandidate.Smooth -> pure (here Joint)
  Just (LinkCandidate.Fillet turn (Mm r)) ->
    pure
      (here (Rounding (case turn of Carrier.Clockwise -> r; Carrier.CounterClockwise -> negate r)))
  Just (LinkCandidate.Meet (Just _)) -> refused (NoLink at "an intersection with a choice")
  Just (LinkCandidate.Fixed _) ->
    refused (NoPiece at "a contour in a contour" "Write its pieces down where they are walked.")
  Just LinkCandidate.Tangent -> refused (NoLink at "a tangent")
  Just (LinkCandidate.Chamfer _) -> refused (NoLink at "a chamfer")
  where
    at = Part.spot leg
