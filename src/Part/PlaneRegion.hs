-- | Regions of the plane that closed contours bound: unions, differences, intersections and offsets
-- of them, and their measures.
--
-- A region consists of connected parts. The outer contour of a part is counter-clockwise, and the
-- contours around its holes are clockwise, so the region lies on the left of all of them. Their
-- elements are those of the contours of which the region is made.
module Part.PlaneRegion
  ( PlaneRegion (..),
    RegionPart (..),
    RegionFault (..),
    contoursOf,
    inside,
    combined,
    offsetBy,
    area,
    centroid,
    mapContours,
  )
where

import Base.Name (Name)
import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Located (..), Region)
import Data.Bifunctor qualified as Bifunctor
import Data.Graph (flattenSCC, stronglyConnComp)
import Data.IntMap.Strict qualified as IntMap
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust, mapMaybe)
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side (..))
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (Closed, Open))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Kernel qualified as Kernel
import Offset.Loop qualified as Loop
import Offset.RegionBoolean
  ( BooleanFault (..),
    BooleanOperation (..),
    ResultSegment (isForward, source),
  )
import Offset.RegionBoolean qualified as RegionBoolean
import Part.Part (Contour (..), Element (..), plainFinish, polyarcOf, reversedContour)
import Part.Part qualified as Part
import Part.Tolerance qualified as PartTolerance

-- | A region, which may be empty.
newtype PlaneRegion = PlaneRegion {parts :: [RegionPart]}
  deriving stock (Eq, Show)

-- | A connected part of a region.
data RegionPart = RegionPart {outer :: Contour, holes :: [Contour]}
  deriving stock (Eq, Show)

-- | A reason why there is no such region.
data RegionFault
  = -- | an open contour
    OpenOutline Contour
  | -- | two elements of a contour that cross
    OutlineCrosses Contour Element Element
  | -- | rounding decides
    RegionUndecided
  deriving stock (Eq, Show)

-- | All contours of a region, in the directions in which they have it on their left.
contoursOf :: PlaneRegion -> [Contour]
contoursOf (PlaneRegion ps) = concat [outer p : holes p | p <- ps]

-- | The region inside a closed contour of either direction.
inside :: Contour -> Either RegionFault PlaneRegion
inside c
  | ends c == Open = Left (OpenOutline c)
  | otherwise = case RegionBoolean.oriented whole of
    Left (CrossesItself i j) -> Left (OutlineCrosses c (element i) (element j))
    Left Undecided -> Left RegionUndecided
    Right Nothing -> Right (PlaneRegion [])
    Right (Just sound)
      | sound == whole -> Right (PlaneRegion [RegionPart c []])
      | otherwise -> Right (PlaneRegion [RegionPart (reversedContour c) []])
  where
    whole = polyarcOf c
    element i = NonEmpty.toList (elements c) !! i

-- | The result of a boolean operation, with a name for its contours. Parts whose bounding boxes do
-- not meet have no influence on each other, so each cluster of parts is combined by itself.
combined ::
  Located Name -> BooleanOperation -> [PlaneRegion] -> Either RegionFault PlaneRegion
combined name operation regions = case regions of
  [one] -> Right one
  _ -> PlaneRegion . concat <$> traverse (fmap parts . ofCluster) (clusters numbered)
  where
    numbered = concat (zipWith (\k region -> map (k,) (parts region)) [0 ..] regions)
    ofCluster ps = case (operation, IntMap.toAscList (IntMap.fromListWith (flip (<>)) ps)) of
      (Union, [(_, alone)]) -> Right (PlaneRegion (map named alone))
      (Difference, [(0, alone)]) -> Right (PlaneRegion (map named alone))
      (Difference, (k, _) : _) | k > 0 -> Right (PlaneRegion [])
      (Common, found) | length found < length regions -> Right (PlaneRegion [])
      (_, found) -> combinedTogether name operation (map (PlaneRegion . snd) found)
    named p = RegionPart (withName (outer p)) (map withName (holes p))
    withName c = c {contourName = name, breaks = [], writtenElements = []}

-- | Clusters of parts of operands whose bounding boxes meet, in the order of their first parts.
-- Each part has the number of its operand, and is in a list by itself.
clusters :: [(Int, RegionPart)] -> [[(Int, [RegionPart])]]
clusters operands =
  map (map partOf) (sortOn (map place . take 1) (map (sortOn place . flattenSCC) components))
  where
    placed = [(n, boxOf (outer p), (k, [p])) | (n, (k, p)) <- zip [0 :: Int ..] operands]
    place (n, _, _) = n
    box (_, b, _) = b
    partOf (_, _, p) = p
    tree = BoxTree.index box placed
    components =
      stronglyConnComp [(p, place p, map place (BoxTree.within (reach p) tree)) | p <- placed]
    reach p = BoundingBox.inflate PartTolerance.joint (box p)
    boxOf c = foldr1 BoundingBox.union (fmap (BoundingBox.ofSegment . segment) (elements c))

-- | The result of a boolean operation on parts that meet. Many regions are joined in halves, so
-- that segments inside the union are dropped early.
combinedTogether ::
  Located Name -> BooleanOperation -> [PlaneRegion] -> Either RegionFault PlaneRegion
combinedTogether name operation regions = case (operation, regions) of
  (Difference, whole : more@(_ : _ : _)) -> do
    less <- combined name Union more
    combinedAtOnce name Difference [whole, less]
  (Union, _) | length regions > 2 -> halves
  (Common, _) | length regions > 2 -> halves
  _ -> combinedAtOnce name operation regions
  where
    halves = do
      let (front, back) = splitAt (length regions `div` 2) regions
      a <- combined name operation front
      b <- combined name operation back
      combinedAtOnce name operation [a, b]

-- | The result of a boolean operation by a single arrangement.
combinedAtOnce ::
  Located Name -> BooleanOperation -> [PlaneRegion] -> Either RegionFault PlaneRegion
combinedAtOnce name operation regions =
  Bifunctor.first (const RegionUndecided) $
    made . RegionBoolean.nested RegionBoolean.segment
      <$> RegionBoolean.combine operation (map (map polyarcOf) contours)
  where
    contours = map contoursOf regions
    sources = sourcesOf (concat contours)
    made = PlaneRegion . map (\(o, hs) -> RegionPart (contourOf o) (map contourOf hs))
    contourOf loop =
      Contour
        { contourName = name,
          ends = Closed,
          elements = joinedElements (elementsOf sources (begunAtSource sources loop)),
          breaks = [],
          writtenElements = []
        }

-- | An element of an operand, with the numbers of the first and of the last element of its contour.
data Source = Source {written :: Element, firstOfContour, lastOfContour :: Int}

sourcesOf :: [Contour] -> Vector Source
sourcesOf contours = Vector.fromList (go 0 contours)
  where
    go _ [] = []
    go k (c : more) =
      let n = NonEmpty.length (elements c)
       in [Source e k (k + n - 1) | e <- NonEmpty.toList (elements c)] <> go (k + n) more

-- | The loop from the segment on that comes first in the operands, if possible from its beginning.
begunAtSource :: Vector Source -> NonEmpty ResultSegment -> NonEmpty ResultSegment
begunAtSource sources loop = case break isFirst (NonEmpty.toList loop) of
  (front, s : rest) -> s :| rest <> front
  (_, []) -> loop
  where
    isFirst r = key r == minimum (fmap key loop)
    key r = (source r, not (beginsWithSource sources r))

-- | True if a part of a segment begins where the whole segment begins in its direction.
beginsWithSource :: Vector Source -> ResultSegment -> Bool
beginsWithSource sources r = Segment.start (RegionBoolean.segment r) == begin
  where
    whole = Part.segment (written (sources Vector.! source r))
    begin = if isForward r then Segment.start whole else Segment.end whole

-- | The segments of a loop as elements, each with the number of the operand's contour.
elementsOf :: Vector Source -> NonEmpty ResultSegment -> NonEmpty (Int, Element)
elementsOf sources loop = NonEmpty.zipWith element before loop
  where
    before = NonEmpty.last loop :| NonEmpty.init loop
    element p r =
      let s = sources Vector.! source r
          e = written s
       in ( firstOfContour s,
            e
              { segment = RegionBoolean.segment r,
                continues = continuesAt p r,
                bevel = bevelOf r e
              }
          )
    -- True if the operand has no corner between the two segments.
    continuesAt p r
      | isForward p /= isForward r || not (beginsWithSource sources r) = False
      | isForward r = source r == following (source p) && continues (at (source r))
      | otherwise = source p == following (source r) && continues (at (source p))
    at = written . (sources Vector.!)
    following k =
      let s = sources Vector.! k in if k == lastOfContour s then firstOfContour s else k + 1
    -- The bevel at the ends of a part of an element. Between the ends of the whole it changes
    -- evenly.
    bevelOf r e = case bevel e of
      Nothing -> Nothing
      Just (a, b) ->
        let share p = max 0 (min 1 (Segment.fraction (Part.segment e) p))
            between t = a + (b - a) * t
            s = RegionBoolean.segment r
            end = if Segment.end s == Segment.end (Part.segment e) then 1 else share (Segment.end s)
         in Just (between (share (Segment.start s)), between end)

-- | Joins neighbours that lie on one line or on one circle and come from different contours.
joinedElements :: NonEmpty (Int, Element) -> NonEmpty Element
joinedElements list = case foldr add [] (NonEmpty.toList list) of
  [] -> fmap snd list
  e : more -> fmap snd (e :| more)
  where
    add a joined = case joined of
      b : more | Just c <- asOne a b -> c : more
      _ -> a : joined
    asOne (i, a) (j, b)
      | i == j || finish a /= finish b || isSpecial a || isSpecial b = Nothing
      | otherwise = (\s -> (j, a {segment = s})) <$> oneSegment (Part.segment a) (Part.segment b)
    isSpecial e = ofCurve e || isJust (bevel e)

-- | The segment that two consecutive ones make together, if they lie on one line or one circle.
oneSegment :: Segment -> Segment -> Maybe Segment
oneSegment a b = case (a, b) of
  (Straight p q, Straight _ r)
    | Vec.dot (Vec.to p q) (Vec.to q r) > 0,
      abs (Vec.cross (Vec.unit (Vec.to p r)) (Vec.to p q)) <= joint ->
      Just (Straight p r)
  (Arc {centre = c, sweep = Rad s}, Arc {centre = d, sweep = Rad t})
    | Vec.distance c d <= PartTolerance.joint && s * t > 0 && abs (s + t) < 2 * pi ->
      Just Arc {start = Segment.start a, end = Segment.end b, centre = c, sweep = Rad (s + t)}
  _ -> Nothing
  where
    Mm joint = PartTolerance.joint

-- | The points whose distance from a region, or from an open contour, is at most a distance. With a
-- negative distance: the points of the region that are so far from all others. Corners become
-- round. The region gives the contours their name, and @at@ is the place of their elements.
offsetBy :: Region -> Located Name -> Mm -> [Contour] -> Either RegionFault PlaneRegion
offsetBy at name (Mm d) contours
  | null contours = Right (PlaneRegion [])
  | otherwise = case Kernel.offset (Kernel.roundOffset side (Mm (abs d))) flats of
    Left _ -> Left RegionUndecided
    Right reachable ->
      Right . PlaneRegion . map part . RegionBoolean.nested fst $
        loopsOf (curveMarks contours numbers) reachable
  where
    side = if d < 0 then LeftOf else RightOf
    (flats, numbers) = unzip (map (FlatPolyarc.fromPolyarc . polyarcOf) contours)
    part (o, hs) = RegionPart (contourOf o) (map contourOf hs)
    contourOf loop =
      Contour
        { contourName = name,
          ends = Closed,
          elements = joinedElements (NonEmpty.zip (0 :| [1 ..]) (offsetElements at loop)),
          breaks = [],
          writtenElements = []
        }

-- | True for each segment of the flat polyarcs of contours that belongs to a curve. @numbers@ has
-- the elements from which the flat segments are made.
curveMarks :: [Contour] -> [PrimArray Int] -> Vector Bool
curveMarks contours numbers =
  Vector.fromList
    [ ofCurve (es Vector.! k)
      | (c, ns) <- zip contours numbers,
        let es = Vector.fromList (NonEmpty.toList (elements c)),
        k <- PrimArray.primArrayToList ns
    ]

-- | The loops of an offset. Each segment has the mark of the one of which it is the offset.
loopsOf :: Vector Bool -> Kernel.ReachableRegion -> [NonEmpty (Segment, Bool)]
loopsOf marks Kernel.ReachableRegion {Kernel.loops, Kernel.raw} =
  mapMaybe
    (NonEmpty.nonEmpty . loop)
    [0 .. Loop.count loops - 1]
  where
    loop n =
      [ (s, markOf (PrimArray.indexPrimArray (Loop.raws loops) k))
        | (k, s) <-
            zip
              [PrimArray.indexPrimArray (Loop.starts loops) n ..]
              (FlatPolyarc.segments (Loop.polyarc loops n))
      ]
    markOf r =
      fromMaybe False (marks Vector.!? fromIntegral (sourceOf (fromIntegral r)))
    sourceOf = PrimArray.indexPrimArray (ClosedPolyarcs.sources raw)

-- | The elements of an offset loop whose segments have marks: true for the offset of a curve.
offsetElements :: Region -> NonEmpty (Segment, Bool) -> NonEmpty Element
offsetElements at loop = NonEmpty.zipWith element (NonEmpty.last loop :| NonEmpty.init loop) loop
  where
    element (p, wasOfCurve) (s, isOfCurve) =
      Element
        { segment = s,
          origin = at,
          finish = plainFinish,
          continues = wasOfCurve && isOfCurve && isSmooth p s,
          ofCurve = isOfCurve,
          replaced = Nothing,
          bevel = Nothing
        }
    isSmooth p s =
      let Rad turn = Vec.signedAngle (Segment.endDirection p) (Segment.startDirection s)
          Rad most = PartTolerance.smoothTurn
       in abs turn <= most

-- | The area in mm².
area :: PlaneRegion -> Double
area = sum . map (Polyarc.signedArea . polyarcOf) . contoursOf

-- | The centre of gravity of a region of even thickness; Nothing for an empty region.
centroid :: PlaneRegion -> Maybe Point
centroid region = case contoursOf region of
  [] -> Nothing
  first' : _ ->
    let origin = Segment.start (Part.segment (NonEmpty.head (elements first')))
        moments = map (Polyarc.firstMoment origin . polyarcOf) (contoursOf region)
        sum' = foldr Vec.add (Vec.vec 0 0) moments
     in Just (Vec.shift (Vec.scale (1 / area region) sum') origin)

-- | The region with changed contours.
mapContours :: (Contour -> Contour) -> PlaneRegion -> PlaneRegion
mapContours f (PlaneRegion ps) = PlaneRegion [RegionPart (f (outer p)) (map f (holes p)) | p <- ps]
