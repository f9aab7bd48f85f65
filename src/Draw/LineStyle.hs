-- | Line styles, colours and symbols of the drawing, after ISO 128. The legend uses them too.
module Draw.LineStyle
  ( black,
    blue,
    red,
    axisPen,
    small,
    Appearance (..),
    LineStyles (..),
    lineStyles,
    stockColour,
    hatchings,
    classPen,
    lettering,
    arrowAt,
    arrowOn,
    axisArrow,
    node,
    origin,
    cutter,
    cross,
    start,
    diamond,
    centreMark,
    descent,
    tab,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Data.Text (Text)
import Draw.Descent (DescentKind (..))
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

-- | Pen of the axes.
axisPen :: Pen
axisPen = Pen grey 0.13 []

-- | Style of small letters, for coordinates and the legend.
small :: TextStyle
small = TextStyle {size = 2.5, ink = black, bold = False}

-- | Appearance of a plot.
data Appearance
  = -- | colours on white
    Screen
  | -- | black on white, with hatching in place of colours
    Print
  | -- | colours on a dark ground
    Dark
  deriving stock (Eq, Show, Enum, Bounded)

-- | Colours and pens of a plot. A colour may also be a hatching.
data LineStyles = LineStyles
  { background :: Text,
    -- | letters, symbols and borders
    inkColour :: Text,
    materialColour :: Text,
    -- | the area over which a cutter sweeps
    sweptColour :: Text,
    restColour :: Text,
    -- | letters at rest material
    reasonColour :: Text,
    -- | nodes and arrows of the cutter's path
    pathColour :: Text,
    -- | arrows and symbols of linking moves
    linkingColour :: Text,
    contourPen :: Pen,
    -- | If the cutter's centre moves on the contour itself, the contour is drawn as two thin lines:
    -- the 'bedPen' in the colour of the paper over the wider 'edgePen'. The 'pathPen' is drawn
    -- between the two lines.
    edgePen :: Pen,
    bedPen :: Pen,
    pathPen :: Pen,
    feedPen :: Pen,
    rapidPen :: Pen,
    cutterPen :: Pen,
    framePen :: Pen,
    -- | axes of the part
    coordinatePen :: Pen,
    -- | the other half of a turned part
    mirrorPen :: Pen,
    -- | axis of the spindle, and centres of holes
    spindlePen :: Pen,
    restPen :: Pen,
    stockPen :: Pen,
    holderPen :: Pen,
    avoidedColour :: Text,
    avoidedPen :: Pen,
    -- | red, green and blue, from 0 to 255, of the stock that nothing has removed, and of the
    -- lowest stock
    stockTones :: ((Double, Double, Double), (Double, Double, Double)),
    -- | True if labels need a ground in the colour of the paper, because areas are hatched
    labelsHaveGround :: Bool,
    -- | colours of the classes of cuts
    classColours :: [Text]
  }

-- | Line styles of an appearance. The classes have the colours of Okabe and Ito, which people with
-- any kind of colour vision can tell apart.
lineStyles :: Appearance -> LineStyles
lineStyles appearance = case appearance of
  Screen ->
    (inColours "white" black blue red)
      { materialColour = "#e4e4e4",
        sweptColour = "#dfe8f7",
        restColour = "#e8604c",
        avoidedColour = "#fbe3bd",
        avoidedPen = Pen "#a65c00" 0.35 [],
        stockTones = ((208, 208, 208), (240, 240, 240)),
        classColours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]
      }
  Dark ->
    (inColours "#14181d" "#e8e8e8" "#7cb8f5" "#ff8c7a")
      { materialColour = "#2b3138",
        sweptColour = "#1d3450",
        restColour = "#c2402c",
        avoidedColour = "#4d3a17",
        avoidedPen = Pen "#ffb84d" 0.35 [],
        stockTones = ((66, 74, 84), (32, 38, 45)),
        classColours = ["#56b4e9", "#ff7f2a", "#2fd0a0", "#f2a3cf", "#f0e442", "#ffffff"]
      }
  Print ->
    (inColours "white" black black black)
      { materialColour = "white",
        sweptColour = "url(#swept-hatching)",
        restColour = "url(#rest-hatching)",
        avoidedColour = "url(#avoided-hatching)",
        contourPen = Pen black 0.7 [],
        coordinatePen = Pen black 0.1 [],
        mirrorPen = Pen black 0.35 [],
        labelsHaveGround = True,
        classColours = [black]
      }

-- | Line styles without tints, from the colours of the paper, the letters, the path and the linking
-- moves.
inColours :: Text -> Text -> Text -> Text -> LineStyles
inColours paper ink path linking =
  LineStyles
    { background = paper,
      inkColour = ink,
      materialColour = paper,
      sweptColour = paper,
      restColour = linking,
      reasonColour = linking,
      pathColour = path,
      linkingColour = linking,
      contourPen = Pen ink 0.6 [],
      edgePen = Pen ink 1.3 [],
      bedPen = Pen paper 0.9 [],
      pathPen = Pen path 0.25 [],
      feedPen = Pen linking 0.2 [4, 0.8],
      rapidPen = Pen linking 0.2 [1.4, 1.2],
      cutterPen = Pen ink 0.2 [],
      framePen = Pen ink 0.35 [],
      coordinatePen = axisPen,
      mirrorPen = Pen grey 0.35 [],
      spindlePen = Pen ink 0.2 [8, 1.2, 1.2, 1.2],
      restPen = Pen linking 0.15 [],
      stockPen = Pen ink 0.25 [6, 1, 1, 1, 1, 1],
      holderPen = Pen ink 0.2 [2, 1],
      avoidedColour = paper,
      avoidedPen = Pen ink 0.35 [],
      stockTones = ((255, 255, 255), (255, 255, 255)),
      labelsHaveGround = False,
      classColours = []
    }

-- | Colour of stock whose top is at a height: 0 at the bottom of the stock, 1 at its top.
stockColour :: LineStyles -> Double -> Text
stockColour styles height =
  "rgb(" <> tone r r' <> "," <> tone g g' <> "," <> tone b b' <> ")"
  where
    ((r, g, b), (r', g', b')) = stockTones styles
    tone high low = Decimal.whole (round (low + height * (high - low)))

-- | Hatchings that an appearance uses.
hatchings :: Appearance -> [Svg]
hatchings appearance = case appearance of
  Screen -> []
  Dark -> []
  Print ->
    [ Svg.hatch "swept-hatching" (Pen black 0.08 []) 2.2 (-45),
      Svg.hatch "rest-hatching" (Pen black 0.2 []) 0.6 45,
      Svg.hatch "avoided-hatching" (Pen black 0.2 []) 1.8 45
    ]

-- | Pen of the class of cuts with a number from 0. Its dashes distinguish it from other classes
-- without colour.
classPen :: LineStyles -> Int -> Pen
classPen styles i = Pen (pick i (classColours styles)) 0.3 (pick (i + i `div` count) dashes)
  where
    count = length dashes
    pick k list = case drop (k `mod` max 1 (length list)) list of
      x : _ -> x
      [] -> mempty
    dashes = [[], [4, 1], [1, 0.8], [6, 1, 1, 1], [2, 1], [6, 0.8, 0.8, 0.8, 0.8, 0.8]]

-- | Style of letters of a size in mm.
lettering :: LineStyles -> Double -> TextStyle
lettering styles size = TextStyle {size, ink = inkColour styles, bold = False}

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
axisArrow :: LineStyles -> Vec -> Point -> Svg
axisArrow styles = Svg.arrow (colour (coordinatePen styles)) 2.4

-- | Dot of a node; a larger one if @numbered@, that is, if the drawing shows the node's number.
node :: LineStyles -> Bool -> Point -> Svg
node styles numbered = Svg.dot (pathColour styles) (if numbered then 0.6 else 0.35)

-- | Symbol of the part's origin, the workpiece zero: a circle with two black quarters.
origin :: LineStyles -> Point -> [Svg]
origin styles p =
  [ Svg.dot (background styles) r p,
    quarter 0,
    quarter pi,
    Svg.ring (cutterPen styles) r p
  ]
  where
    r = 1.5
    rim a = Vec.shift (Vec.vec (r * cos a) (r * sin a)) p
    quarter a =
      let (from, to) = (rim a, rim (a - pi / 2))
       in Svg.area (inkColour styles) [Straight p from, Segment.arc Clockwise p from to]

-- | Circle of a cutter about @p@, and the cross at its centre; @radius@ is in mm of paper.
cutter :: LineStyles -> Double -> Point -> [Svg]
cutter styles radius p =
  [ Svg.ring (cutterPen styles) radius p,
    Svg.strokes (cutterPen styles) (map pure (cross radius p))
  ]

-- | Two lines of the cross at the centre @p@ of a cutter. @radius@ is the cutter's radius in mm of
-- paper.
cross :: Double -> Point -> [Segment]
cross radius p = [bar (Vec.vec arm 0), bar (Vec.vec 0 arm)]
  where
    arm = max 1.6 (min 3 (radius + 1))
    bar v = Straight (Vec.shift (Vec.negate v) p) (Vec.shift v p)

-- | Symbol of the start position of the cutter: a white diamond.
start :: LineStyles -> Point -> [Svg]
start styles p =
  [ Svg.area (background styles) (diamond p),
    Svg.loop (cutterPen styles) {width = 0.25} (diamond p)
  ]

-- | Edges of the symbol of the start position.
diamond :: Point -> [Segment]
diamond p = zipWith Straight corners (drop 1 corners <> take 1 corners)
  where
    corners =
      [Vec.shift v p | v <- [Vec.vec 2.6 0, Vec.vec 0 2.6, Vec.vec (-2.6) 0, Vec.vec 0 (-2.6)]]

-- | Lines that mark the centre of a hole; @radius@ is the radius of the hole in mm of paper. They
-- lead beyond the hole.
centreMark :: Double -> Point -> [Segment]
centreMark radius p = [bar (Vec.vec arm 0), bar (Vec.vec 0 arm)]
  where
    arm = radius + 1.5
    bar v = Straight (Vec.shift (Vec.negate v) p) (Vec.shift v p)

-- | Symbol of a tab: a bar with a bar across at each end.
tab :: LineStyles -> Point -> [Svg]
tab styles p = [Svg.strokes (Pen (linkingColour styles) 0.4 []) (map pure bars)]
  where
    bars = [bar (-1.4, 0) (1.4, 0), bar (-1.4, -0.9) (-1.4, 0.9), bar (1.4, -0.9) (1.4, 0.9)]
    bar (x, y) (x', y') = Straight (Vec.shift (Vec.vec x y) p) (Vec.shift (Vec.vec x' y') p)

-- | Symbol of a descent: a triangle that points down for a plunge, a wedge for a ramp, and a ring
-- about a dot for a helix.
descent :: LineStyles -> DescentKind -> Point -> [Svg]
descent styles kind p = case kind of
  Plunge -> [filled [(-1.1, -1.9), (1.1, -1.9), (0, 0)]]
  Ramp -> [filled [(-2.8, -1.6), (0, 0), (-2.8, 0)]]
  Helix -> [Svg.ring (Pen colour 0.25 []) 1.3 p, Svg.dot colour 0.4 p]
  where
    colour = linkingColour styles
    filled corners =
      let points = [Vec.shift (Vec.vec x y) p | (x, y) <- corners]
       in Svg.area colour (zipWith Straight points (drop 1 points))
