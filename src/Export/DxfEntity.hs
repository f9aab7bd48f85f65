-- | Entities of a DXF file: the objects of a drawing in the unit of its program.
module Export.DxfEntity
  ( DxfEntity (..),
    entities,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Rad (..), degrees)
import Data.Containers.ListUtils (nubOrd)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Export.Bezier (CubicBezier (..))
import Export.Bezier qualified as Bezier
import Export.CadDrawing
  ( CadForm (..),
    CadLayer,
    CadObject (..),
    OutlinePiece (..),
  )
import Export.CadDrawing qualified as CadDrawing
import Export.Coordinate qualified as Coordinate
import Export.DxfGroup (DxfGroup, integer, place, real, word)
import Export.Tolerance qualified as Tolerance
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Geometry
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | An entity: its kind, its layer, and the groups of its form.
data DxfEntity = DxfEntity {kind :: Text, onLayer :: CadLayer, groups :: [DxfGroup]}
  deriving stock (Eq, Show)

-- | The entities of an object.
entities :: LengthUnit -> CadObject -> [DxfEntity]
entities unit CadObject {layer, form} = [DxfEntity k layer gs | (k, gs) <- formOf scale form]
  where
    scale = Coordinate.inUnit unit

-- | The conversion of mm to the unit of the file.
type Scale = Double -> Double

formOf :: Scale -> CadForm -> [(Text, [DxfGroup])]
formOf scale form = case form of
  Outline _ ends heights pieces -> outline scale ends heights pieces
  Motion segment heights -> [motion scale segment heights]
  HoleMark c@(Circle p _) bottom -> [circle scale c (Mm 0) (Mm 0), mark scale p bottom]
  NodeMark k p z ->
    let gap = Vec.vec CadDrawing.letterGap CadDrawing.letterGap
     in [mark scale p z, ("TEXT", number scale k (Vec.shift gap p) z)]

number :: Scale -> Int -> Point -> Mm -> [DxfGroup]
number scale k p z =
  [word 100 "AcDbText"]
    <> at scale 10 p z
    <> [real 40 (scale CadDrawing.letterHeight), word 1 (Decimal.whole k), word 100 "AcDbText"]

mark :: Scale -> Point -> Mm -> (Text, [DxfGroup])
mark scale p z = ("POINT", word 100 "AcDbPoint" : at scale 10 p z)

-- | The groups of a point of the plane at a height.
at :: Scale -> Int -> Point -> Mm -> [DxfGroup]
at scale code p (Mm z) = place code (scale (Vec.x p), scale (Vec.y p), scale z)

-- | A circle at a height, drawn upwards by a thickness.
circle :: Scale -> Circle -> Mm -> Mm -> (Text, [DxfGroup])
circle scale (Circle c (Mm r)) z (Mm thickness) =
  ( "CIRCLE",
    [word 100 "AcDbCircle"]
      <> [real 39 (scale thickness) | thickness /= 0]
      <> at scale 10 c z
      <> [real 40 (scale r)]
  )

-- | The entities of an outline: one circle, or one polyline for each chain and one spline for each
-- curve. An outline between two heights has a thickness; a spline cannot have one, so there is one
-- spline at each height.
outline :: Scale -> Ends -> (Mm, Mm) -> NonEmpty OutlinePiece -> [(Text, [DxfGroup])]
outline scale ends (low@(Mm bottom), high@(Mm top)) pieces =
  case (CadDrawing.circleOf ends pieces, pieces) of
    (Just c, _) -> [circle scale c low thickness]
    (Nothing, Chain segments :| []) -> [polyline scale ends low thickness segments]
    (Nothing, _) -> concatMap piece pieces
  where
    thickness = Mm (top - bottom)
    piece p = case p of
      Chain segments -> [polyline scale Open low thickness segments]
      Smooth curves -> [spline scale True curves (z, z) | z <- nubOrd [low, high]]

-- | A polyline of lines and arcs at a height, drawn upwards by a thickness.
polyline :: Scale -> Ends -> Mm -> Mm -> NonEmpty Segment -> (Text, [DxfGroup])
polyline scale ends (Mm z) (Mm thickness) segments =
  ( "LWPOLYLINE",
    [ word 100 "AcDbPolyline",
      integer 90 (length vertices),
      integer 70 (case ends of Closed -> 1; Open -> 0),
      real 38 (scale z)
    ]
      <> [real 39 (scale thickness) | thickness /= 0]
      <> concat
        [ [real 10 (scale (Vec.x p)), real 20 (scale (Vec.y p)), real 42 bulge]
          | (p, bulge) <- vertices
        ]
  )
  where
    parts = concatMap halved segments
    vertices =
      [(Segment.start s, Segment.bulge s) | s <- parts]
        <> [(Segment.end (NonEmpty.last segments), 0) | ends == Open]

-- | An arc of more than three quarters of a circle in two halves; any other segment whole. The
-- bulge of such an arc would be so large that rounding changes its radius.
halved :: Segment -> [Segment]
halved s = case s of
  Arc {sweep = Rad a} | abs a > 1.5 * pi -> let (p, q) = Segment.cutAt 0.5 s in [p, q]
  _ -> [s]

-- | A move between two heights.
motion :: Scale -> Segment -> (Mm, Mm) -> (Text, [DxfGroup])
motion scale segment (low, high) = case segment of
  Arc {start, centre, sweep = Rad sweep}
    | Segment.length segment > Mm 0 && low /= high -> rising
    | Segment.length segment > Mm 0 && abs sweep >= 2 * pi - Geometry.equal ->
      circle scale (Circle centre (Segment.radius centre start)) low (Mm 0)
    | Segment.length segment > Mm 0 ->
      case arcGroups scale low segment of
        Just found -> ("ARC", found)
        Nothing -> polyline scale Open low (Mm 0) (segment :| [])
  _ ->
    ( "LINE",
      [word 100 "AcDbLine"]
        <> at scale 10 (Segment.start segment) low
        <> at scale 11 (Segment.end segment) high
    )
  where
    rise = let (Mm a, Mm b) = (low, high) in Mm (b - a)
    rising =
      spline scale False (Bezier.alongArc Tolerance.curvedPath rise segment) (low, high)

-- | The groups of an arc at a height: centre, radius, and the angles of both ends in degrees,
-- counter-clockwise. Nothing for a line, and for an arc whose ends these numbers do not give.
arcGroups :: Scale -> Mm -> Segment -> Maybe [DxfGroup]
arcGroups scale z segment = case segment of
  Straight _ _ -> Nothing
  Arc {start, end, centre, sweep = Rad sweep} ->
    let Mm a = Segment.radius centre start
        Mm b = Segment.radius centre end
        radius = (a + b) / 2
        (first, final) = if sweep > 0 then (start, end) else (end, start)
        angleOf = turned . degrees . Vec.angle . Vec.to centre
        given p = Vec.shift (Vec.polar (Mm radius) (Rad (angleOf p * pi / 180))) centre
        isExact p = Vec.distance p (given p) <= Tolerance.arcEnd
     in if isExact first && isExact final
          then
            Just
              ( [word 100 "AcDbCircle"]
                  <> at scale 10 centre z
                  <> [ real 40 (scale radius),
                       word 100 "AcDbArc",
                       real 50 (angleOf first),
                       real 51 (angleOf final)
                     ]
              )
          else Nothing
  where
    -- The sum of a very small negative angle and 360 is rounded to 360.
    turned d
      | d >= 0 = d
      | d + 360 < 360 = d + 360
      | otherwise = 0

-- | A spline of degree 3 along curves that join, between two heights. Each curve has a knot of its
-- own number at both ends, which counts three times between two curves and four times at the ends
-- of the spline; so the spline consists of exactly these curves. The height rises in proportion to
-- the parameter.
spline :: Scale -> Bool -> NonEmpty CubicBezier -> (Mm, Mm) -> (Text, [DxfGroup])
spline scale isPlanar curves (Mm low, Mm high) =
  ( "SPLINE",
    [ word 100 "AcDbSpline",
      integer 70 (if isPlanar then 8 else 0),
      integer 71 3,
      integer 72 (length knots),
      integer 73 (length controls),
      integer 74 0
    ]
      <> map (real 40) knots
      <> concat
        [ at scale 10 p (Mm (low + (high - low) * fromIntegral k / fromIntegral (3 * count)))
          | (k, p) <- zip [0 :: Int ..] controls
        ]
  )
  where
    count = length curves
    controls =
      Bezier.start (NonEmpty.head curves) :
      concat [[b, c, d] | CubicBezier _ b c d <- NonEmpty.toList curves]
    knots = 0 : concat [replicate 3 (fromIntegral k) | k <- [0 .. count]] <> [fromIntegral count]
