-- | Statements that a drawing gives: contours from its outlines, and lines of a table from its
-- circles.
module Surface.FromDrawing
  ( DrawingText (..),
    fromBytes,
    distance,
    remarksIn,
    chosenFrom,
    Converted (..),
    outlinesIn,
    contours,
    circleOf,
    withEarlier,
    tableLines,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Name qualified as Name
import Base.Quantity (LengthUnit (..), Mm (..), millimetresIn, times)
import Base.Region (Located (..), Region (Region))
import Base.Region qualified as Region
import Data.ByteString (ByteString)
import Data.Char (isSpace)
import Data.List (find, nub, partition, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe, maybeToList)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Drawing.Drawing
  ( Drawing (..),
    Entity,
    PathPart (..),
    PresumedSize (PresumedSize),
    Remark (..),
    RemarkKind (..),
    Shape (..),
  )
import Drawing.Drawing qualified as Drawing
import Drawing.Dxf qualified as Dxf
import Drawing.Error qualified as FileError
import Drawing.FileFormat (FileFormat (..), formatOf)
import Drawing.Nesting (ClosedBoundary, Crossing (..))
import Drawing.Nesting qualified as Nesting
import Drawing.Outline (ClosedGap (..), DrawnPart (..), JoinFault (..), Joining (..), Outline (..))
import Drawing.Outline qualified as Outline
import Drawing.OutlineTolerance qualified as Tolerance
import Drawing.PathPart qualified as PathPart
import Drawing.Svg qualified as Svg
import Geometry.Carrier (Circle (Circle))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Arc))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Report (quote)
import Surface.DrawingError (DrawingMistake (..), GapPlace (..))
import Surface.DrawnContour qualified as DrawnContour
import Surface.Syntax
import Surface.Token (Unit (..))

-- | A drawing with the places of its lines in the texts of the program.
data DrawingText = DrawingText
  { drawing :: Drawing,
    -- | region of a line of its file, by the number of the line from 1
    regionOfLine :: Int -> Region
  }

-- | Result of a part of a drawing, with the mistakes and the remarks.
data Converted a = Converted {mistakes :: [DrawingMistake], notes :: [DrawingMistake], given :: a}

instance Functor Converted where
  fmap f c = c {given = f (given c)}

-- | The drawing of a file: its mistakes, the remarks about the whole of it, and the drawing if it
-- has no mistake. @at@ is the region of the name of the file in the program, @stated@ the unit that
-- the program gives the drawing. The text @shown@ of the file begins at the offset @begin@.
fromBytes ::
  Located Text ->
  Maybe LengthUnit ->
  (Int, Text) ->
  ByteString ->
  ([DrawingMistake], [DrawingMistake], Maybe DrawingText)
fromBytes (Located at name) stated (begin, shown) content = case formatOf name of
  Nothing -> ([NotADrawing at name], [], Nothing)
  Just Dxf -> made (Dxf.fromDxf stated content)
  Just Svg -> made (Svg.fromSvg stated content)
  where
    made outcome = case outcome of
      Left faults -> (map bad (NonEmpty.toList faults), [], Nothing)
      Right drawing ->
        ([], presumption drawing, Just DrawingText {drawing, regionOfLine})
    presumption drawing =
      [UnitPresumed (regionOfLine n) u w h | Just (PresumedSize n u w h) <- [presumed drawing]]
    bad e =
      BadDrawing
        (regionOfLine (FileError.line e))
        (lowered (FileError.title e))
        [FileError.message e]
        (FileError.hints e)
    lines' = Vector.fromList (Region.numbered shown)
    lowered t = Text.toLower (Text.take 1 t) <> Text.drop 1 t
    regionOfLine n = case lines' Vector.!? (n - 1) of
      Just (offset, text) ->
        let blank = Text.length (Text.takeWhile isSpace text)
            from = begin + offset + blank
         in Region from (from + Text.length (Text.strip text))
      Nothing -> at

-- | The remarks about the entities that a selection takes: one for each kind of entity and reason,
-- at the first such entity.
remarksIn :: DrawingText -> Maybe (Located DrawingSelection) -> [DrawingMistake]
remarksIn text selection =
  [ LeftOut (regionOfLine text (Set.findMin lines')) (remarkText kind (Set.size lines'))
    | (kind, lines') <- Map.toList byKind
  ]
  where
    byKind =
      Map.fromListWith
        (<>)
        [ (remarkKind r, Set.singleton (remarkLine r))
          | r <- remarks (drawing text),
            all (\(Located _ choice) -> isChosen choice r) selection
        ]
    isChosen choice r = takes choice (remarkLayer r) (remarkIdentifiers r) (remarkClasses r)

-- | The sentence of a remark for a count of entities.
remarkText :: RemarkKind -> Int -> Text
remarkText kind count = case kind of
  NotUnderstood word -> left word
  Unusable word why -> left word <> ": " <> why
  NotInPlane word -> left word <> ": not parallel to the plane of the drawing"
  ThroughPoints word -> left word <> ": given only by points, without control points"
  Smoothed word -> counted word <> " read as the polyline that draws the smoothed one"
  InPaperSpace word -> left word <> ": on a page for printing"
  Invisible word -> left word <> ": invisible"
  Unclipped word -> counted word <> " read whole, although the file clips or masks it"
  OnHiddenLayer word layer -> left word <> ": on the layer " <> quote layer <> ", which is off"
  where
    left word = counted word <> " left out"
    counted word
      | count == 1 = "one " <> word <> " is"
      | otherwise = Decimal.whole count <> " times " <> word <> " are"

-- | The largest distance of ends that are joined, from the number in the program; without one it is
-- 'Tolerance.joining'. A number without a unit has the unit of the file.
distance :: LengthUnit -> Maybe Expr -> Either DrawingMistake Mm
distance unit given = case given of
  Nothing -> Right Tolerance.joining
  Just (Located at (Literal n u))
    | amount n > 0, Just factor <- factorOf u -> Right (Mm (factor * amount n))
    | otherwise -> Left (BadDistance at)
  Just (Located at _) -> Left (BadDistance at)
  where
    factorOf u = case u of
      Nothing -> Just (millimetresIn unit)
      Just Millimetre -> Just 1
      Just Centimetre -> Just 10
      Just Metre -> Just 1000
      Just Inch -> Just 25.4
      _ -> Nothing

-- | The entities that a selection takes. The place of a mistake is the region @file@ if nothing is
-- selected.
chosenFrom ::
  Region -> Maybe (Located DrawingSelection) -> Drawing -> Either DrawingMistake [Entity]
chosenFrom file selection Drawing {entities} = case selection of
  Nothing
    | null entities -> Left (NoOutline file)
    | otherwise -> Right entities
  Just (Located at choice) -> case filter (isIn choice) entities of
    [] ->
      let names = Set.toAscList (Set.fromList (concatMap (namesIn choice) entities))
       in Left (NothingSelected at (wordsFor choice) names)
    es -> Right es
  where
    isIn choice e =
      takes choice (Drawing.layer e) (Drawing.identifiers e) (Drawing.classes e)
    wordsFor choice = case choice of
      OnLayer name -> "layer " <> quote name <> " with entities"
      WithIdentifier name -> "element with the id " <> quote name
      WithClass name -> "element of the class " <> quote name
    namesIn choice e = case choice of
      OnLayer _ -> [Drawing.layer e | not (Text.null (Drawing.layer e))]
      WithIdentifier _ -> Drawing.identifiers e
      WithClass _ -> Drawing.classes e

-- | True if a selection takes what has a layer, identifiers and classes. The names of layers are
-- the same in capital and small letters.
takes :: DrawingSelection -> Text -> [Text] -> [Text] -> Bool
takes choice layer identifiers classes = case choice of
  OnLayer name -> Text.toCaseFold name == Text.toCaseFold layer
  WithIdentifier name -> name `elem` identifiers
  WithClass name -> name `elem` classes

-- Contours ----------------------------------------------------------------------------------------

-- | The outlines of some entities, and of their points as circles without a radius. @file@ is the
-- place of remarks.
outlinesIn :: DrawingText -> Region -> Mm -> [Entity] -> Converted [Outline]
outlinesIn text file tolerance chosen =
  Converted
    { mistakes = map (joinFault regionOf) (faults joining),
      notes =
        remarksOf regionOf file joining <> concatMap (nearlyClosed regionOf) (outlines joining),
      given = outlines joining
    }
  where
    joining = Outline.joined tolerance chosen
    regionOf = regionOfLine text . Drawing.line

-- | The statements in place of a contour, or of several, from some entities. @at@ is the region of
-- the statement, @file@ that of the name of the file. Ends within @tolerance@ are joined.
contours ::
  DrawingText ->
  Region ->
  Region ->
  DrawnOutlines ->
  Located Name ->
  (Mm, [Entity]) ->
  Converted [Statement]
contours text at file asked name (tolerance, chosen) = case asked of
  OneOutline -> case outlines joining of
    [one] -> result [] [contourOf name one]
    [] -> result [NoOutline file] []
    first : more ->
      result [SeveralOutlines file (1 + length more) (fmap firstOf (first :| more))] []
  AllOutlines -> case outlines joining of
    [] -> result [NoOutline file] []
    first : more -> case [o | o <- first : more, ends o == Polyarc.Open] of
      []
        -- Entities along each other touch at their ends, too.
        | not (null (faults joining)) -> result [] []
        | otherwise -> case Nesting.crossings boundaries of
          [] -> result [] (asNested at name contourOf (zip (first : more) boundaries))
          found -> result (map (crossingFault regionOf) found) []
        where
          boundaries = map Nesting.boundary (first : more)
      -- A fault at the ends leaves outlines open.
      open -> result (if null (faults joining) then map (openFault regionOf) open else []) []
  where
    joining = Outline.joined tolerance chosen
    result found made =
      Converted
        { mistakes = found <> map (joinFault regionOf) (faults joining),
          notes =
            remarksOf regionOf file joining
              <> concat [nearlyClosed regionOf o | OneOutline <- [asked], o <- outlines joining],
          given = made
        }
    regionOf = regionOfLine text . Drawing.line
    firstOf o = regionOf (entity (NonEmpty.head (parts o)))
    contourOf n o =
      Located
        at
        ( Contour
            n
            (Located at (DrawnContour.closure o))
            (map snd (DrawnContour.items (regionOf . entity) (Just Millimetre) o))
        )

-- | The contours of some closed outlines with their boundaries, and the region that they bound: the
-- value of the name. An outline within an odd count of others is a hole in what the outlines around
-- it give.
asNested ::
  Region ->
  Located Name ->
  (Located Name -> Outline -> Statement) ->
  [(Outline, ClosedBoundary)] ->
  [Statement]
asNested at name contourOf closed =
  zipWith contourOf names (map fst closed)
    <> [Located at (LetValue name (foldl nested (call "region" []) levels))]
  where
    names = [partName name k | k <- [1 .. length closed]]
    depths = Nesting.depths (map snd closed)
    levels = [(k, [n | (n, d) <- zip names depths, d == k]) | k <- [0 .. maximum (0 : depths)]]
    nested around (k, ns) = case k :: Int of
      0 -> call "region" [listOf ns]
      _
        | odd k -> call "difference" [around, listOf ns]
        | otherwise -> call "union" [Located at (List [around, call "region" [listOf ns]])]
    listOf ns = Located at (List [Located at (Variable n) | Located _ n <- ns])
    call function arguments = case map Given arguments of
      first : more -> Located at (Call (Located at (Name function)) (first :| more))
      [] -> Located at (List [])

-- | The hidden name of one of several outlines.
partName :: Located Name -> Int -> Located Name
partName (Located at name) k = Located at (Name.hidden name (Decimal.whole k))

-- | The mistake of a fault of the outlines.
joinFault :: (Entity -> Region) -> JoinFault -> DrawingMistake
joinFault regionOf fault = case fault of
  Branch p es -> BranchingOutline p (fmap regionOf es)
  Overlap a b long p -> OverlappingEntities (regionOf a) (regionOf b) long p

-- | The mistake of an open outline where all have to be closed.
openFault :: (Entity -> Region) -> Outline -> DrawingMistake
openFault regionOf o =
  OpenOutline (regionOf (entity a)) (PathPart.start (part a)) (PathPart.end (part b))
  where
    (a, b) = (NonEmpty.head (parts o), NonEmpty.last (parts o))

-- | The mistake of a crossing of closed outlines.
crossingFault :: (Entity -> Region) -> Crossing -> DrawingMistake
crossingFault regionOf (Crossing a b p) = CrossingEntities (regionOf a) (regionOf b) p

-- | The remarks of a joining.
remarksOf :: (Entity -> Region) -> Region -> Joining -> [DrawingMistake]
remarksOf regionOf file joining =
  maybeToList (ClosedGaps file <$> NonEmpty.nonEmpty (map gapPlace (gaps joining)))
    <> [SameEntity (regionOf e) (regionOf original) | (e, original) <- repeated joining]
  where
    gapPlace g = GapPlace (regionOf (before g)) (regionOf (after g)) (width g) (joint g)

-- | The remark about an open outline that is probably meant to be closed.
nearlyClosed :: (Entity -> Region) -> Outline -> [DrawingMistake]
nearlyClosed regionOf o =
  [ NearlyClosed (regionOf (entity a)) (regionOf (entity b)) gap (start a) (end b)
    | gap <- maybeToList (Outline.openBy o)
  ]
  where
    (a, b) = (NonEmpty.head (parts o), NonEmpty.last (parts o))
    start = PathPart.start . part
    end = PathPart.end . part

-- Tables ------------------------------------------------------------------------------------------

-- | A circle or a point for a row of a table: its entity, its centre, and its radius, which is 0
-- for a point.
data TableCircle = TableCircle {drawnBy :: Entity, centre :: Point, size :: Mm}

-- | The lines of a table with a row for each circle and each point among some entities: the
-- coordinates of the centre, and the diameter, which is 0 for a point. @file@ is the region of the
-- name of the file. Ends within @tolerance@ are joined, so that two arcs may make a circle. Two
-- circles on one centre are a mistake, since a hole for each row would be drilled twice.
tableLines :: DrawingText -> Region -> (Mm, [Entity]) -> Converted [TableLine]
tableLines text file (tolerance, chosen) =
  Converted
    { mistakes = [NoCircle file | null found] <> concentric,
      notes = nub (remarksOf regionOf file joining <> noCircles <> same),
      given = if null rows then [] else header : map row rows
    }
  where
    regionOf = regionOfLine text . Drawing.line
    joining = Outline.joined tolerance chosen
    found =
      [TableCircle e p (Mm 0) | e <- chosen, Dot p <- [Drawing.shape e]]
        <> mapMaybe placed (outlines joining)
    placed o = do
      Circle c r <- circleOf o
      Just (TableCircle (entity (NonEmpty.head (parts o))) c r)
    (rows, same, concentric) = distinct regionOf tolerance found
    noCircles =
      let firsts = [entity (NonEmpty.head (parts o)) | o <- outlines joining, null (circleOf o)]
       in [ LeftOut (regionOf e) (noCircleText (Drawing.word e) (length firsts))
            | e <- take 1 firsts
          ]
    header = Located file (Header (heading "x" :| [heading "y", heading "diameter"]))
    heading word = Heading (Located file (Name word)) Nothing
    row TableCircle {drawnBy, centre, size} =
      let Mm d = times 2 size
          at = regionOf drawnBy
          cell = ValueCell . DrawnContour.size at (Just Millimetre)
       in Located at (Entries (fmap cell (Vec.x centre :| [Vec.y centre, d])))

-- | The sentence for outlines that are no circles, from the word of the first one and their count.
noCircleText :: Text -> Int -> Text
noCircleText word count
  | count == 1 = word <> " is no circle, and is left out"
  | otherwise = Decimal.whole count <> " outlines are no circles, and are left out"

-- | The circles and points of a table of which no two have one centre within the tolerance, the
-- remarks on those that are left out, and the mistakes. A point on the centre of a circle marks the
-- circle, and is left out without a remark. Of circles of one size, or of points, the first one
-- counts. Circles of different sizes are a mistake.
distinct ::
  (Entity -> Region) ->
  Mm ->
  [TableCircle] ->
  ([TableCircle], [DrawingMistake], [DrawingMistake])
distinct regionOf tolerance found =
  ( [c | (c, []) <- inOrder],
    [SameEntity (placeOf c) (placeOf o) | (c, Just o) <- repeated],
    [ ConcentricCircles (placeOf o, placeOf c) (times 2 (size o), times 2 (size c)) (length more)
      | (c, o) : more <- [different]
    ]
  )
  where
    (points, circles) = partition isPoint found
    isPoint c = size c == Mm 0
    -- Circles stand before points, so that a point has the circle which it marks before it.
    neighbours = withEarlier tolerance centre (circles <> points)
    inOrder = [n | isWanted <- [isPoint, not . isPoint], n <- neighbours, isWanted (fst n)]
    repeated = [(c, find (isSameAs c) others) | (c, others) <- neighbours]
    different =
      [ (c, o)
        | (c, o : others) <- neighbours,
          not (isPoint c),
          not (any (isSameAs c) (o : others))
      ]
    isSameAs a b = isPoint a == isPoint b && isEqual (size a) (size b)
    isEqual (Mm r) (Mm s) = Mm (abs (r - s)) <= tolerance
    placeOf = regionOf . drawnBy

-- | The things of a list, each with those before it whose points are within a distance.
withEarlier :: Mm -> (a -> Point) -> [a] -> [(a, [a])]
withEarlier most pointOf list =
  [ (a, [b | (j, b) <- sortOn fst (BoxTree.within (boxOf most n) index), j < k, isNear a b])
    | n@(k, a) <- numbered
  ]
  where
    numbered = zip [0 :: Int ..] list
    index = BoxTree.index (boxOf (Mm 0)) numbered
    boxOf margin (_, a) = BoundingBox.inflate margin (BoundingBox.ofPoints (pointOf a) [])
    isNear a b = Vec.distance (pointOf a) (pointOf b) <= most

-- | The circle of a closed outline that consists of arcs of one circle.
circleOf :: Outline -> Maybe Circle
circleOf o = case traverse (arcOf . part) (parts o) of
  Just ((c, r) :| more)
    | ends o == Polyarc.Closed && all (\(d, s) -> Vec.isNear c d && isEqual r s) more ->
      Just (Circle c r)
  _ -> Nothing
  where
    arcOf p = case p of
      Plain (Arc begin _ centre _) -> Just (centre, Segment.radius centre begin)
      _ -> Nothing
    isEqual (Mm a) (Mm b) = let Mm most = Tolerance.same in abs (a - b) <= most
