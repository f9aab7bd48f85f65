-- | Conversion of an evaluated part to an input sheet. Every milled contour becomes an array of
-- pieces. Every stop before, between and after the contours becomes a point of the sheet. A stop is
-- a point to which a statement moves the tool. A piece is a curve with a cipher, whose digits
-- express the shifts of the curve. The conversion refuses a part that the numbers of a sheet cannot
-- express.
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
import Control.Monad (unless, when)
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
import Part.CutFeed (CutFeed (..))
import Part.Link qualified as Link
import Part.Part (Milling, Part)
import Part.Part qualified as Part
import Part.Tolerance qualified as Tolerance
import Sheet.FromCurve (here)
import Sheet.FromCurve qualified as FromCurve
import Sheet.Sheet
import Sheet.Unsupported
  ( Feature (..),
    FeedFault (..),
    LinkFeature (..),
    PathFault (..),
    PieceFault (..),
    SharedSetting (..),
    Unfit (..),
    UnsupportedCipher (..),
  )

-- | The sheet of a part, or the reasons why there is no such sheet. The dimensions of a conical
-- cutter come from the program @written@. The part has only the radius at the height where the
-- cutter touches the contour.
fromPart :: Checked.Program -> Part -> Result w Unfit Sheet
fromPart written part = case (Part.start part, runsOf (Part.operations part)) of
  (_, Left e) -> refused e
  (Nothing, _) -> refused (NoPath NoStart)
  (Just _, Right ([], _)) -> refused (NoPath NothingMilled)
  (Just (Located _ startPoint), Right (one : more, final)) ->
    mapM_ (refused . ManyArrays . keywordRegion) (take 1 (drop maxArrays (one : more)))
      *> ( build
             <$> generalData written part (fmap milled (one :| more))
               <*> pathOf startPoint (one : more) final
               <*> traverse (arrayOf . milled) (one :| more)
         )
  where
    build general (approach, retracts) arrays' =
      case NonEmpty.zipWith (\a points -> a {retract = points}) arrays' retracts of
        a :| as -> Sheet {general, approach, first = a, others = as}

refused :: Unfit -> Result w Unfit a
refused e = Result [] [e] Nothing

-- | A milled contour and the stops before it. @keywordRegion@ is the region of the keyword @mill@
-- or @turn@. @milled@ is the pair of the same region and the milling.
data Run = Run {stops :: [Part.Stop], keywordRegion :: Region, milled :: (Region, Milling)}

-- | The milled contours of a list of operations, and the stops after the last contour. 'Left' if an
-- operation is neither a milled contour nor a move to stops.
runsOf :: [Part.Operation] -> Either Unfit ([Run], [Part.Stop])
runsOf = go []
  where
    go before operations = case operations of
      [] -> Right ([], before)
      Part.Travel ss : rest -> go (before <> toList ss) rest
      Part.Mill (Located at m) : rest -> do
        (runs, final) <- go (Part.retract m) rest
        let keywordRegion = keyword at
            stops = before <> Part.approach m
        Right (Run {stops, keywordRegion, milled = (keywordRegion, m)} : runs, final)
      Part.Pocket (Located at _) : _ -> Left (NoNumbers at PocketClearing)
      Part.Drill (Located at _) : _ -> Left (NoNumbers at DrillingHoles)
      Part.Carve (Located at _) : _ -> Left (NoNumbers at CarvingRegion)
      Part.Command (Located at c) : rest ->
        maybe (go before rest) (Left . NoNumbers at) (commandFeature c)

-- | The feature that a command needs and a sheet does not have; 'Nothing' for a command that is not
-- on the tape.
commandFeature :: Part.Command -> Maybe Feature
commandFeature c = case c of
  Part.SpindleOn _ _ -> Just SpindleCommand
  Part.SpindleOff -> Just SpindleCommand
  Part.SpindleByHand -> Nothing
  Part.CoolantTo _ -> Just CoolantCommand
  Part.Auxiliary _ -> Just AuxiliaryCommand
  Part.ChangeTool _ _ -> Just SecondTool
  Part.ProgramStop -> Just StopCommand
  Part.OptionalStop -> Just StopCommand
  Part.Dwell _ -> Just DwellCommand

-- | The region of the keyword @mill@ or @turn@, which begins a statement with the given region.
-- Both have four letters.
keyword :: Region -> Region
keyword (Region a b) = Region a (min b (a + 4))

-- General data

-- | The general data of the sheet, from the first contour. A sheet has them once, so a later
-- contour with another tool, tolerance or side is refused.
generalData :: Checked.Program -> Part -> NonEmpty (Region, Milling) -> Result w Unfit General
generalData written part ((at, one) :| more) = do
  mapM_ checkShared more
  side <- sideOf (Part.side one)
  tolerance <- case Part.tolerance one of
    Part.OnPath (Mm t) -> pure t
    Part.Band _ _ -> refused (NoNumbers at BandTolerance)
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
    checkShared (place, m) = do
      same place SharedTool (Part.radius m == Part.radius one && Part.gear m == Part.gear one)
      same place SharedTolerance (Part.tolerance m == Part.tolerance one)
      same place SharedSide (value (Part.side m) == value (Part.side one))
    same place setting isSame = unless isSame (refused (TwoOfOne place setting))

sideOf :: Located Part.Side -> Result w Unfit (Located (Maybe Side))
sideOf (Located at side) = case side of
  Part.LeftSide -> pure (here (Just LeftSide))
  Part.RightSide -> pure (here (Just RightSide))
  Part.On -> pure (here Nothing)
  Part.Outside -> refused (NoNumbers at OutsideOfContour)
  Part.Inside -> refused (NoNumbers at InsideOfContour)

-- | Diameter in mm, bevel in degrees and height in mm of the tool. The bevel is the angle between
-- the tool's flank and its axis. @radius@ is the tool's radius at the height where it touches the
-- part.
--
-- The tool is the program's first cone with literal dimensions if the cone's bevel is not 0 and its
-- radius at its height is exactly @radius@. Otherwise the tool is a cylinder, with bevel 0 and
-- height 0.
toolOf :: Checked.Program -> Mm -> (Double, Double, Double)
toolOf written (Mm radius) =
  case [ (d, mu, h)
         | Located _ (Checked.Tool _ (Located _ (Checked.ConeCutter a b c))) <-
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

-- | The number of the program in a part's name like @program_5@, which "Sheet.ToSurface" makes; 0
-- for other names.
numberOf :: Maybe Name -> Double
numberOf name = fromMaybe 0 $ do
  Name text <- name
  wholeNumber =<< Text.stripPrefix "program_" text

-- | The numbers of the product and of the part in a title like @Product 5, part 6@, which
-- "Sheet.ToSurface" makes. Nothing for other titles.
titleNumbers :: Text -> Maybe (Double, Double)
titleNumbers title = do
  rest <- Text.stripPrefix "Product " title
  let (a, more) = Text.breakOn ", part " rest
  (,) <$> wholeNumber a <*> (wholeNumber =<< Text.stripPrefix ", part " more)

-- | A whole number that is written with at most nine characters; Nothing for other texts.
wholeNumber :: Text -> Maybe Double
wholeNumber text =
  if Text.length text <= 9 && not (Text.any (== '.') text) then Decimal.parse text else Nothing

-- The toolpath between the arrays

-- | The points up to the first array, and the points after each array. The arguments are the
-- starting position, the milled contours, and the stops after the last contour.
pathOf ::
  Part.SpacePoint ->
  [Run] ->
  [Part.Stop] ->
  Result w Unfit (NonEmpty Waypoint, NonEmpty (NonEmpty Waypoint))
pathOf startPoint runs final = do
  feeds <- traverse feedOfRun runs
  before <- traverse (traverse paced . stops) runs
  after <- traverse paced final
  case (before, feeds) of
    (firstStops : rest, f : fs) -> do
      let Mm z = Part.height startPoint
          (z', approachPoints) = located z firstStops
          origin = (Vec.x (Part.plane startPoint), Vec.y (Part.plane startPoint), z)
      checkHeights runs final
      retracts <-
        retractsOf z' f (zip3 (map keywordRegion runs) (rest <> [after]) (map Just fs <> [Nothing]))
      maybe
        (refused (NoPath NothingMilled))
        (pure . (waypoints origin approachPoints f,))
        (NonEmpty.nonEmpty retracts)
    _ -> refused (NoPath NothingMilled)

-- | Refuses every stop without a height after the first contour, if the tool is a swivelling blade.
-- The blade changes its height along a contour, so the height before the contour does not hold
-- after it.
checkHeights :: [Run] -> [Part.Stop] -> Result w Unfit ()
checkHeights runs final = case runs of
  Run {milled = (_, Part.Milling {Part.gear = Just _})} : others' ->
    mapM_
      (refused . NoPath . NoHeight . region . Part.place)
      [s | s <- concatMap stops others' <> final, Nothing <- [Part.level s]]
  _ -> pure ()

-- | Coordinates x, y, z in mm.
type Position = (Double, Double, Double)

-- | The height (mm) after the last stop, and the position of each stop with its feed (mm\/min). @z@
-- is the height before the first stop. A stop without a height keeps the height before it.
located :: Double -> [(Part.Stop, Double)] -> (Double, [(Position, Double)])
located z list = case list of
  [] -> (z, [])
  (s, pace) : rest ->
    let z' = maybe z (\(Mm h) -> h) (Part.level s)
        p = value (Part.place s)
        (final, others') = located z' rest
     in (final, ((Vec.x p, Vec.y p, z'), pace) : others')

-- | Makes waypoints of a first position and of further positions, each with the feed of the move to
-- it. A waypoint has the feed of the move that starts there. @final@ is the feed of the last
-- waypoint. All feeds are in mm\/min.
waypoints :: Position -> [(Position, Double)] -> Double -> NonEmpty Waypoint
waypoints from list final = case list of
  [] -> waypoint from final :| []
  (next, pace) : rest -> waypoint from pace NonEmpty.<| waypoints next rest final
  where
    waypoint (a, b, c) f = Waypoint {x = here a, y = here b, z = here c, feed = here f}

-- | The points after each array. The first arguments are the height (mm) and the feed (mm\/min) at
-- the end of the first array. The list has an entry for each array: the region of its statement's
-- keyword, the stops after it with the feeds of the moves to them, and the feed of the next array.
-- For the last array this feed is Nothing.
retractsOf ::
  Double ->
  Double ->
  [(Region, [(Part.Stop, Double)], Maybe Double)] ->
  Result w Unfit [NonEmpty Waypoint]
retractsOf z f list = case list of
  [] -> pure []
  (at, ss, nextFeed) : rest -> case located z ss of
    (z', (position, pace) : others') -> do
      let leaving = maybe at (region . Part.place . fst) (listToMaybe ss)
      when (pace /= f) (refused (NoFeed leaving LeavingFeed))
      let f' = fromMaybe 0 nextFeed
      (waypoints position others' f' :) <$> retractsOf z' f' rest
    (_, []) -> refused (NoPath (NoRetract at))

-- | A stop with the feed of the move to it, in mm\/min.
paced :: Part.Stop -> Result w Unfit (Part.Stop, Double)
paced s = case Part.pace s of
  Part.Rapid -> pure (s, rapidFeed)
  Part.At f -> (s,) <$> belowRapid f

-- | The feed of a milled contour, in mm\/min.
feedOfRun :: Run -> Result w Unfit Double
feedOfRun = belowRapid . Part.feed . snd . milled

-- | A feed in mm\/min. Refuses 'rapidFeed', which means a rapid move on a sheet, and all higher
-- feeds.
belowRapid :: Located CutFeed -> Result w Unfit Double
belowRapid (Located at v) = case v of
  PerTurn _ _ -> refused (NoFeed at FeedForTurn)
  PerMinute (Feed f)
    | f >= rapidFeed -> refused (NoFeed at FeedTooHigh)
    | otherwise -> pure f

-- Arrays

-- | The array of a contour. The points after the array are a placeholder, which 'fromPart'
-- replaces.
arrayOf :: (Region, Milling) -> Result w Unfit Array
arrayOf (at, m) = do
  mapM_ (refused . NoNumbers at) (unsupported m)
  when (Part.ends contour == Part.Closed) (refused (NoPiece name ClosedContour))
  case NonEmpty.nonEmpty (Part.writtenElements contour) of
    Nothing -> refused (NoPiece name DerivedContour)
    Just elements -> do
      pieces' <- traverse (pieceOf m) elements
      links <- traverse linkOf (NonEmpty.init elements)
      pure
        Array
          { joined = zipWith LinkedPiece (NonEmpty.init pieces') links,
            final = NonEmpty.last pieces',
            retract = nowhere :| []
          }
  where
    contour = Part.contour m
    name = region (Part.contourName contour)
    nowhere = Waypoint {x = here 0, y = here 0, z = here 0, feed = here 0}

-- | The settings of a milling statement that a sheet cannot express.
unsupported :: Milling -> [Feature]
unsupported m =
  [TurningContour | Part.work m == Part.Turned]
    <> [Depth | not (null (Part.levels m))]
    <> [Lead | Just _ <- [Part.leadIn m, Part.leadOut m]]
    <> [ContourAllowance | Part.allowances m /= Mm 0 :| []]
    <> [SharpCorner | Part.corners m == Part.Sharp]
    <> [ControlCompensation | Just _ <- [Part.controlCompensation m]]

-- | The piece of a contour element. Refuses elements that are not curves.
pieceOf :: Milling -> Part.ContourElement -> Result w Unfit Piece
pieceOf m element = case Part.elementCurve element of
  Nothing -> refused (NoPiece at PlainElement)
  Just curve -> do
    piece <- FromCurve.piece at (Curve.exact curve) (Part.elementFinish element)
    mapM_ (const (checkSwivel at curve piece bevels)) (Part.gear m)
    own <- traverse belowRapid (Part.ownFeed (Part.elementFinish element))
    pure piece {ownFeed = fmap here own}
  where
    at = Part.elementRegion element
    bevels =
      [ (Part.segment e, b)
        | e <- toList (Part.elements (Part.contour m)),
          Part.origin e == at,
          Just b <- [Part.bevel e]
      ]

-- | Refuses a piece if the blade's swivel differs from the bevel of the piece. A piece without a
-- bevel has the bevel 0. @bevels@ has each segment of the element with the blade's swivel at the
-- segment's start and at its end, in radians. Each swivel is compared with the bevel at the same
-- point, which is interpolated along the curve.
checkSwivel ::
  Region ->
  Curve.PartCurve ->
  Piece ->
  [(Segment, (Double, Double))] ->
  Result w Unfit ()
checkSwivel at curve piece bevels
  | hasSurface piece && null bevels = refused (NoCipher at NotSwivelling)
  | any isOther ends = refused (NoCipher at OtherSwivel)
  | otherwise = pure ()
  where
    ends = concat [[(Segment.start e, a), (Segment.end e, b)] | (e, (a, b)) <- bevels]
    bevelOf r = maybe 0 (\s -> value (mu s) * pi / 180) (surface r)
    marks = Curve.alongPolyarc curve (Vector.fromList (map bevelOf (toList (rows piece))))
    Rad slack = Tolerance.bevel
    isOther (p, b) =
      let Mm s = MeasuredPolyarc.nearestStation (Curve.approximation curve) p
       in abs (b - interpolated s marks) > 2 * slack

-- | The value at the arc length @s@ (mm) by linear interpolation. @known@ has pairs of an arc
-- length and the value there, by rising arc length. The first and the last value hold outside of
-- the pairs; the result is 0 if there are no pairs.
interpolated :: Double -> [(Double, Double)] -> Double
interpolated s known = case known of
  (a, x) : more@((b, y) : _)
    | s <= b || null (drop 1 more) ->
      if b > a then x + (y - x) * max 0 (min 1 ((s - a) / (b - a))) else y
    | otherwise -> interpolated s more
  [(_, x)] -> x
  [] -> 0

-- | The sheet's link of an element to the next one. Refuses a link that a sheet does not have.
linkOf :: Part.ContourElement -> Result w Unfit (Located Link)
linkOf element = case Part.link element of
  Nothing -> pure (here Intersection)
  Just (Link.Meet Nothing) -> pure (here Intersection)
  Just Link.Smooth -> pure (here Joint)
  Just (Link.Fillet sense (Mm r)) ->
    pure
      (here (Rounding (case sense of Carrier.Clockwise -> r; Carrier.CounterClockwise -> negate r)))
  Just (Link.Meet (Just _)) -> refused (NoLink at ChosenIntersection)
  Just (Link.Fixed _) -> refused (NoPiece at NestedContour)
  Just Link.Tangent -> refused (NoLink at TangentLink)
  Just (Link.Chamfer _) -> refused (NoLink at ChamferLink)
  where
    at = Part.elementRegion element
