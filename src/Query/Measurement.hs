-- | Measures of contours and segments as facts for people: pairs of a name and a value.
module Query.Measurement
  ( facts,
    segmentFacts,
    time,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Rad (..), Seconds (..), times)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Geometry.Corner qualified as Corner
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Part.Part (Contour (..))
import Part.Part qualified as Part
import Part.Tolerance qualified as Tolerance

-- | The measures of a contour: length, area, bounding box, and the largest cutters.
facts :: LengthUnit -> Contour -> [(Text, Text)]
facts unit contour =
  ("length", Decimal.inUnit unit (Polyarc.length polyarc)) :
  [ ( "area",
      Decimal.shortAreaIn unit 2 (abs area) <> " " <> Decimal.unitText unit
        <> "²"
    )
    | isClosed
  ]
    <> [("box", boxText unit polyarc)]
    <> concatMap ofSide sides
  where
    polyarc = Part.polyarcOf contour
    isClosed = ends contour == Closed
    area = Polyarc.signedArea polyarc
    sides
      | not isClosed = [("left", 1), ("right", -1)]
      | area > 0 = [("inside", 1), ("outside", -1)]
      | otherwise = [("inside", -1), ("outside", 1)]
    ofSide (side, sign) = case tightest sign polyarc of
      NoHollow -> [("cutter " <> side, "any")]
      Hollow r ->
        [ ("tightest radius " <> side, Decimal.inUnit unit r),
          ("largest cutter " <> side, "diameter " <> Decimal.inUnit unit (times 2 r))
        ]
      SharpCorner -> [("cutter " <> side, "leaves rest material in a sharp corner")]

-- | The tightest concave part of one side of a contour.
data Hollow = NoHollow | Hollow Mm | SharpCorner

-- | The tightest concave part on the left of a polyarc (@sign@ is 1) or on its right (−1).
tightest :: Double -> Polyarc.Polyarc -> Hollow
tightest sign polyarc
  | any isSharp (Polyarc.neighbours polyarc) = SharpCorner
  | otherwise = case [Segment.radius (centre s) (start s) | s <- all', isHollow s] of
    [] -> NoHollow
    rs -> Hollow (minimum rs)
  where
    all' = NonEmpty.toList (Polyarc.segments polyarc)
    isHollow s = case s of
      Arc {sweep = Rad a} -> a * sign > 0
      Straight _ _ -> False
    isSharp (_, a, b) = let Rad angle = Corner.turning a b in angle * sign > smooth
    Rad smooth = Tolerance.smoothTurn

-- | The bounding box of a polyarc: its size, and its lower left and upper right corner.
boxText :: LengthUnit -> Polyarc.Polyarc -> Text
boxText unit polyarc =
  Decimal.shortIn unit 3 (Mm (right - left))
    <> " × "
    <> Decimal.shortIn unit 3 (Mm (top - bottom))
    <> " "
    <> Decimal.unitText unit
    <> ", from "
    <> Vec.toText unit 3 (Vec.point left bottom)
    <> " to "
    <> Vec.toText unit 3 (Vec.point right top)
  where
    BoundingBox left bottom right top = foldr BoundingBox.union box boxes
    box :| boxes = fmap exactBox (Polyarc.segments polyarc)

-- | The smallest bounding box of a segment. An arc reaches beyond its ends where it passes a point
-- of its circle that is the farthest in the direction of an axis.
exactBox :: Segment -> BoundingBox
exactBox s = BoundingBox.ofPoints (start s) (end s : extremes)
  where
    extremes = case s of
      Straight _ _ -> []
      Arc {centre} ->
        let Mm r = Segment.radius centre (start s)
         in filter
              (Segment.hasFootOf s)
              [ Vec.point (Vec.x centre + dx * r) (Vec.y centre + dy * r)
                | (dx, dy) <- [(1, 0), (0, 1), (-1, 0), (0, -1)]
              ]

-- | The measures of a segment: ends and length, and for an arc centre, radius and angle.
segmentFacts :: LengthUnit -> Segment -> [(Text, Text)]
segmentFacts unit s =
  [ ("from", Vec.toText unit 4 (start s)),
    ("to", Vec.toText unit 4 (end s)),
    ("length", Decimal.inUnit unit (Segment.length s))
  ]
    <> case s of
      Straight _ _ -> []
      Arc {centre, sweep = Rad a} ->
        [ ("centre", Vec.toText unit 4 centre),
          ("radius", Decimal.inUnit unit (Segment.radius centre (start s))),
          ("angle", Decimal.short 3 (a * 180 / pi) <> " deg")
        ]

-- | A time in minutes and seconds.
time :: Seconds -> Text
time (Seconds s)
  | s < 60 = Decimal.fixed 1 s <> " s"
  | otherwise = Decimal.whole minutes <> " min " <> Decimal.whole (whole - 60 * minutes) <> " s"
  where
    whole = round s :: Int
    minutes = whole `div` 60
