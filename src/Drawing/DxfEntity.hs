-- | The entities of a DXF file as shapes, in the unit of the file and in the coordinates of the
-- block or the drawing that contains them.
--
-- Entities with an extrusion have coordinates of their own. The arbitrary axis algorithm of the DXF
-- reference gives their axes: for the extrusion (0, 0, −1), x points to the left and y upwards.
module Drawing.DxfEntity
  ( ShapeReading (..),
    shape,
    EntityPlane (..),
    plane,
    fromPlane,
  )
where

import Base.Quantity (Mm (..), radians)
import Data.List.NonEmpty (NonEmpty (..))
import Data.Text (Text)
import Drawing.AffineMap (AffineMap)
import Drawing.AffineMap qualified as AffineMap
import Drawing.ClampedSpline qualified as ClampedSpline
import Drawing.Drawing (PathPart (..), RemarkKind (..), Shape (..))
import Drawing.DxfRecord (Record (..))
import Drawing.DxfRecord qualified as DxfRecord
import Drawing.Ellipse qualified as Ellipse
import Drawing.Error (Error)
import Drawing.Tolerance qualified as Tolerance
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The shape of an entity, or the reason why it has none. A shape may come with a remark.
data ShapeReading = Read Shape | ReadWith RemarkKind Shape | LeftOut RemarkKind
  deriving stock (Eq, Show)

-- | The shape of an entity and of the vertices that follow a POLYLINE.
shape :: Record -> [Record] -> Either Error ShapeReading
shape record vertices = case word record of
  "LINE" -> line record
  "POINT" -> Read . Dot . fst <$> pointAt 10 record
  "CIRCLE" -> inPlane record (circle record)
  "ARC" -> inPlane record (arc record)
  "LWPOLYLINE" -> inPlane record (lightPolyline record)
  "POLYLINE" -> polyline record vertices
  "ELLIPSE" -> ellipse record
  "SPLINE" -> spline record
  other -> Right (LeftOut (NotUnderstood other))

-- Planes --------------------------------------------------------------------------------------

-- | The plane of an entity by its extrusion.
data EntityPlane
  = -- | the plane of the drawing
    Upright
  | -- | the plane of the drawing, seen from behind
    Mirrored
  | -- | another plane
    Oblique
  deriving stock (Eq, Show)

-- | The plane of an entity.
plane :: Record -> Either Error EntityPlane
plane record = do
  x <- DxfRecord.realOr 0 210 record
  y <- DxfRecord.realOr 0 220 record
  z <- DxfRecord.realOr 1 230 record
  Right $
    if max (abs x) (abs y) > Tolerance.uprightNormal * abs z || z == 0
      then Oblique
      else if z < 0 then Mirrored else Upright

-- | The map from the coordinates of an entity to those of its surroundings. Nothing for an oblique
-- plane.
fromPlane :: EntityPlane -> Maybe AffineMap
fromPlane p = case p of
  Upright -> Just AffineMap.identity
  Mirrored -> Just (AffineMap.scaling (-1) 1)
  Oblique -> Nothing

-- | The reading of an entity with coordinates of its own plane.
inPlane :: Record -> Either Error ShapeReading -> Either Error ShapeReading
inPlane record reading = do
  own <- plane record
  case fromPlane own of
    Nothing -> Right (LeftOut (NotInPlane (word record)))
    Just m | own == Mirrored -> mapped m <$> reading
    Just _ -> reading
  where
    mapped m r = case r of
      Read s -> Read (AffineMap.shape m s)
      ReadWith remark s -> ReadWith remark (AffineMap.shape m s)
      LeftOut _ -> r

-- | The reading of an entity, unless its points differ in height.
atOneHeight :: Record -> [Double] -> Either Error ShapeReading -> Either Error ShapeReading
atOneHeight record heights reading = case heights of
  first : others
    | any ((> Tolerance.sameHeight) . abs . subtract first) others ->
      Right (LeftOut (NotInPlane (word record)))
  _ -> reading

-- | The point whose x has a code, and its height. The codes of y and z are 10 and 20 higher.
pointAt :: Int -> Record -> Either Error (Point, Double)
pointAt code record = do
  x <- DxfRecord.needed code record
  y <- DxfRecord.needed (code + 10) record
  z <- DxfRecord.realOr 0 (code + 20) record
  Right (Vec.point x y, z)

-- Lines and arcs ------------------------------------------------------------------------------

line :: Record -> Either Error ShapeReading
line record = do
  (a, z) <- pointAt 10 record
  (b, z') <- pointAt 11 record
  atOneHeight record [z, z'] (Right (Read (Path Open (Plain (Straight a b) :| []))))

circle :: Record -> Either Error ShapeReading
circle record = Read . FullCircle <$> carrier record

carrier :: Record -> Either Error Circle
carrier record = do
  (c, _) <- pointAt 10 record
  r <- DxfRecord.needed 40 record
  Right (Circle c (Mm (abs r)))

-- | An arc runs counter-clockwise from one angle to another, both in degrees. It is a full circle
-- if they differ by whole turns.
arc :: Record -> Either Error ShapeReading
arc record = do
  full@(Circle centre r) <- carrier record
  from <- DxfRecord.needed 50 record
  to <- DxfRecord.needed 51 record
  let turn = to - from
      degrees = turn - 360 * fromIntegral (floor (turn / 360) :: Integer)
      at angle = Vec.shift (Vec.polar r (radians angle)) centre
  Right . Read $
    if degrees <= 0
      then FullCircle full
      else
        Path
          Open
          (Plain Arc {start = at from, end = at to, centre, sweep = radians degrees} :| [])

-- Polylines -----------------------------------------------------------------------------------

-- | A vertex of a polyline, and the bulge of the segment that begins there.
data Vertex = Vertex Point Double

lightPolyline :: Record -> Either Error ShapeReading
lightPolyline record = do
  flags <- DxfRecord.wholeOr 0 70 record
  vertices <- traverse vertex (DxfRecord.groups 10 record)
  Right (either (LeftOut . Unusable (word record)) Read (chain (isSet 1 flags) vertices))

vertex :: Record -> Either Error Vertex
vertex record =
  Vertex . fst <$> pointAt 10 record <*> DxfRecord.realOr 0 42 record

-- | The entity POLYLINE with its vertices. A spline that was fitted to it has its own vertices;
-- those of the frame that the user drew are left out.
polyline :: Record -> [Record] -> Either Error ShapeReading
polyline record records = do
  flags <- DxfRecord.wholeOr 0 70 record
  kinds <- traverse (DxfRecord.wholeOr 0 70) records
  let drawn = [v | (v, kind) <- zip records kinds, not (isSet 16 kind)]
      read'
        | isSet 4 flags = ReadWith (Smoothed name)
        | otherwise = Read
  vertices <- traverse vertex drawn
  heights <- traverse (fmap snd . pointAt 10) drawn
  let reading = Right (either (LeftOut . Unusable name) read' (chain (isSet 1 flags) vertices))
      isMesh = isSet 16 flags || isSet 64 flags
      isSpatial = isSet 8 flags
  case () of
    _ | isMesh -> Right (LeftOut (NotUnderstood (name <> " mesh")))
    _ | isSpatial -> atOneHeight record heights reading
    _ -> inPlane record (atOneHeight record heights reading)
  where
    name = word record

-- | The path along vertices. It is closed if the file says so, or if it ends where it begins.
chain :: Bool -> [Vertex] -> Either Text Shape
chain isClosed vertices = case vertices of
  first@(Vertex p _) : rest@(_ : _) ->
    let parts = zipWith part vertices rest
        Vertex q b = last rest
        isBack = isClosed && q /= p
        ends = if isClosed || q == p then Closed else Open
     in Right . Path ends $ case parts <> [part (Vertex q b) first | isBack] of
          a : others -> a :| others
          [] -> part first first :| []
  _ -> Left "it has fewer than two vertices"
  where
    part (Vertex a bulge) (Vertex b _) = Plain (Segment.fromBulge a b bulge)

isSet :: Int -> Int -> Bool
isSet flag flags = odd (flags `div` flag)

-- Curves --------------------------------------------------------------------------------------

-- | An ellipse by its centre, the end of an axis from the centre, the ratio of the axes, and the
-- parameters of its ends. The other axis is a quarter turn from the first one about the extrusion.
ellipse :: Record -> Either Error ShapeReading
ellipse record = do
  (c, _) <- pointAt 10 record
  (end, z) <- pointAt 11 record
  ratio <- DxfRecord.needed 40 record
  from <- DxfRecord.realOr 0 41 record
  to <- DxfRecord.realOr (2 * pi) 42 record
  own <- plane record
  let u = Vec.to (Vec.point 0 0) end
      across side = Vec.scale (side * abs ratio) (Vec.left u)
      turns = (to - from) / (2 * pi)
      rest = 2 * pi * (turns - fromIntegral (floor turns :: Integer))
      isFull = min rest (2 * pi - rest) <= Tolerance.fullTurn
      reading v
        | isFull = Ellipse.whole c u v
        | otherwise = Path Open (Ellipse.part c u v from (from + rest) :| [])
  atOneHeight record [0, z] . Right $ case own of
    Upright -> Read (reading (across 1))
    Mirrored -> Read (reading (across (-1)))
    Oblique -> LeftOut (NotInPlane (word record))

spline :: Record -> Either Error ShapeReading
spline record = do
  flags <- DxfRecord.wholeOr 0 70 record
  degree <- DxfRecord.wholeOr 3 71 record
  knots <- DxfRecord.reals 40 record
  weights <- DxfRecord.reals 41 record
  controls <- traverse (pointAt 10) (DxfRecord.groups 10 record)
  let isClosed = isSet 1 flags || isSet 2 flags
      rational = if null weights then Nothing else Just weights
      result = ClampedSpline.fromKnots isClosed degree knots (map fst controls) rational
      reading
        | null controls && not (null (DxfRecord.groups 11 record)) = LeftOut (ThroughPoints name)
        | otherwise = either (LeftOut . Unusable name) Read result
  atOneHeight record (map snd controls) (Right reading)
  where
    name = word record
