-- | Line styles, colours and symbols of the drawing, after ISO 128. The legend uses them too.
module Draw.LineStyle
  ( black,
    blue,
    red,
    materialColour,
    restColour,
    contourPen,
    edgePen,
    bedPen,
    pathPen,
    feedPen,
    rapidPen,
    framePen,
    axisPen,
    mirrorPen,
    spindlePen,
    sweptPen,
    small,
    arrowAt,
    arrowOn,
    axisArrow,
    node,
    origin,
    cutter,
    cross,
    start,
    diamond,
  )
where

import Base.Quantity (Mm (..))
import Data.Text (Text)
import Draw.Svg (Pen (..), Svg, TextStyle (..))
import Draw.Svg qualified as Svg
import Geometry.Carrier (Sense (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | Colours that are dark enough to be printed in black and white.
black, grey, blue, red :: Text
black = "#000000"
grey = "#909090"
blue = "#0b3d91"
red = "#a01818"

-- | Pens of the drawing. If the cutter's centre moves on the contour itself, the contour is drawn
-- as two thin lines: the white 'bedPen' is drawn over the wider black 'edgePen'. The 'pathPen' is
-- drawn between the two lines.
contourPen, edgePen, bedPen, pathPen, feedPen, rapidPen, cutterPen, framePen :: Pen
contourPen = Pen black 0.6 []
edgePen = Pen black 1.3 []
bedPen = Pen "white" 0.9 []
pathPen = Pen blue 0.25 []
feedPen = Pen red 0.2 [4, 0.8]
rapidPen = Pen red 0.2 [1.4, 1.2]
cutterPen = Pen black 0.2 []
framePen = Pen black 0.35 []

-- | Pens of the axes of the part, of the other half of a turned part, and of the spindle's axis.
axisPen, mirrorPen, spindlePen :: Pen
axisPen = Pen grey 0.13 []
mirrorPen = Pen grey 0.35 []
spindlePen = Pen black 0.2 [8, 1.2, 1.2, 1.2]

-- | Pen of the area over which a cutter with a radius in mm of paper sweeps.
sweptPen :: Double -> Pen
sweptPen radius = Pen "#dfe8f7" (2 * radius) []

-- | Grey of the material.
materialColour :: Text
materialColour = "#e4e4e4"

-- | Colour of rest material.
restColour :: Text
restColour = "#f0a090"

-- | Style of small letters, for coordinates and the legend.
small :: TextStyle
small = TextStyle {size = 2.5, ink = black, bold = False}

-- | Arrowhead of the given colour on a segment. Its tip is at @fraction@ of the segment's length, 0
-- at the start and 1 at the end. The segment must have a positive length.
arrowAt :: Text -> Double -> Segment -> Svg
arrowAt colour fraction s =
  Svg.arrow colour 2.4 (Segment.directionAt fraction s) (Segment.at fraction s)

-- | Arrowhead of the given colour on a segment, with its tip at @fraction@ of the segment's length;
-- none if the segment is shorter than 4 mm of paper.
arrowOn :: Text -> Double -> Segment -> [Svg]
arrowOn colour fraction s
  | room < 4 = []
  | otherwise = [arrowAt colour fraction s]
  where
    Mm room = Segment.length s

-- | Arrowhead of a coordinate axis, by its direction (a unit vector) and its tip.
axisArrow :: Vec -> Point -> Svg
axisArrow = Svg.arrow grey 2.4

-- | Dot of a node; a larger one if @numbered@, that is, if the drawing shows the node's number.
node :: Bool -> Point -> Svg
node numbered = Svg.dot blue (if numbered then 0.6 else 0.35)

-- | Symbol of the part's origin, the workpiece zero: a circle with two black quarters.
origin :: Point -> [Svg]
origin p = [Svg.dot "white" r p, quarter 0, quarter pi, Svg.ring (Pen black 0.2 []) r p]
  where
    r = 1.5
    rim a = Vec.shift (Vec.vec (r * cos a) (r * sin a)) p
    quarter a =
      let (from, to) = (rim a, rim (a - pi / 2))
       in Svg.area black [Straight p from, Segment.arc Clockwise p from to]

-- | Circle of a cutter about @p@, and the cross at its centre; @radius@ is in mm of paper.
cutter :: Double -> Point -> [Svg]
cutter radius p = Svg.ring cutterPen radius p : map bar (cross radius p)
  where
    bar s = Svg.stroke cutterPen [s]

-- | Two lines of the cross at the centre @p@ of a cutter. @radius@ is the cutter's radius in mm of
-- paper.
cross :: Double -> Point -> [Segment]
cross radius p = [bar (Vec.vec arm 0), bar (Vec.vec 0 arm)]
  where
    arm = max 1.6 (min 3 (radius + 1))
    bar v = Straight (Vec.shift (Vec.negate v) p) (Vec.shift v p)

-- | Symbol of the start position of the cutter: a white diamond.
start :: Point -> [Svg]
start p = [Svg.area "white" (diamond p), Svg.loop (Pen black 0.25 []) (diamond p)]

-- | Edges of the symbol of the start position.
diamond :: Point -> [Segment]
diamond p = zipWith Straight corners (drop 1 corners <> take 1 corners)
  where
    corners =
      [Vec.shift v p | v <- [Vec.vec 2.6 0, Vec.vec 0 2.6, Vec.vec (-2.6) 0, Vec.vec 0 (-2.6)]]
