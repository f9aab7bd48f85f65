-- | Lines, areas, marks and texts in SVG 1.1, in mm of paper.
--
-- Arcs stay arcs. Every line says how it looks in its own attributes, so that a drawing needs no
-- style sheet and any part of it can be copied out.
module Draw.Svg
  ( Svg,
    document,
    layer,
    Pen (..),
    stroke,
    loop,
    area,
    rectangle,
    dot,
    ring,
    arrow,
    Anchor (..),
    TextStyle (..),
    text,
    textWidth,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad (..))
import Data.Char qualified as Char
import Data.Foldable (traverse_)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Lazy qualified as Lazy
import Draw.Page (Area (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Text.Blaze.Svg (Svg)
import Text.Blaze.Svg.Renderer.Text qualified as Blaze
import Text.Blaze.Svg11 (AttributeValue, toSvg, toValue, (!))
import Text.Blaze.Svg11 qualified as Svg
import Text.Blaze.Svg11.Attributes qualified as Attribute
import Text.DocLayout qualified as DocLayout

-- | A page with its title and its layers, from the lowest to the topmost.
document :: Area -> Text -> [Svg] -> Text
document page title layers =
  Lazy.toStrict (Blaze.renderSvg (Svg.docTypeSvg ! size ! viewBox ! font $ rows (heading : layers)))
  where
    size =
      Attribute.version "1.1"
        <> Attribute.width (number (rightmost page) <> "mm")
        <> Attribute.height (number (lower page) <> "mm")
    viewBox = Attribute.viewbox (numbers [leftmost page, upper page, rightmost page, lower page])
    font = Attribute.fontFamily "Arial, Helvetica, sans-serif"
    heading = Svg.title (toSvg (printable title))

-- | Things that belong together, under a name.
layer :: Text -> [Svg] -> Svg
layer name things = Svg.g ! Attribute.id_ (toValue name) $ rows things

-- | One below the other in the file.
rows :: [Svg] -> Svg
rows things = toSvg newLine *> traverse_ (\thing -> thing *> toSvg newLine) things
  where
    newLine = "\n" :: Text

-- | How a line is drawn: its width and its dashes and gaps in mm.
data Pen = Pen {colour :: Text, width :: Double, dashes :: [Double]}
  deriving stock (Eq, Show)

-- | Segments that follow one another, as a line.
stroke :: Pen -> [Segment] -> Svg
stroke pen segments =
  Svg.path ! Attribute.d (toValue (course segments)) ! Attribute.fill "none" ! drawnWith pen

-- | Segments that end where they begin, as a line without an end.
loop :: Pen -> [Segment] -> Svg
loop pen segments =
  Svg.path ! Attribute.d (toValue (course segments <> "Z")) ! Attribute.fill "none" ! drawnWith pen

-- | What segments enclose, in a colour.
area :: Text -> [Segment] -> Svg
area colour segments =
  Svg.path ! Attribute.d (toValue (course segments <> "Z")) ! Attribute.fill (toValue colour)

-- | A rectangle, filled with a colour.
rectangle :: Pen -> Text -> Area -> Svg
rectangle pen colour Area {leftmost, upper, rightmost, lower} =
  Svg.rect
    ! Attribute.x (number leftmost)
    ! Attribute.y (number upper)
    ! Attribute.width (number (rightmost - leftmost))
    ! Attribute.height (number (lower - upper))
    ! Attribute.fill (toValue colour)
    ! drawnWith pen

-- | A filled circle about a point.
dot :: Text -> Double -> Point -> Svg
dot colour radius p = circle radius p ! Attribute.fill (toValue colour)

-- | A circle about a point, as a line.
ring :: Pen -> Double -> Point -> Svg
ring pen radius p = circle radius p ! Attribute.fill "none" ! drawnWith pen

circle :: Double -> Point -> Svg
circle radius p =
  Svg.circle
    ! Attribute.cx
      (number (Vec.x p))
    ! Attribute.cy (number (Vec.y p))
    ! Attribute.r (number radius)

-- | An arrow's head of a length, with its tip at a point.
arrow :: Text -> Double -> Vec -> Point -> Svg
arrow colour size direction tip = area colour [Straight tip (back 1), Straight (back 1) (back (-1))]
  where
    along = Vec.scale (-size) direction
    back side = Vec.shift (Vec.add along (Vec.scale (side * size / 4) (Vec.left direction))) tip

-- | Which point of a text is given: on its base line, or in its very middle.
data Anchor = Start | Middle | End | Centred
  deriving stock (Eq, Show)

-- | The height of the letters' bodies in mm, their colour, and whether they are bold.
data TextStyle = TextStyle {size :: Double, ink :: Text, bold :: Bool}
  deriving stock (Eq, Show)

-- | A text on one line.
text :: TextStyle -> Anchor -> Point -> Text -> Svg
text TextStyle {size, ink, bold} anchor p words' =
  Svg.text_
    ! Attribute.x (number (Vec.x p))
    ! Attribute.y (number (Vec.y p + sunk))
    ! Attribute.fontSize (number size)
    ! Attribute.fontWeight (if bold then "bold" else "normal")
    ! Attribute.fill (toValue ink)
    ! Attribute.textAnchor at
    $ toSvg (printable words')
  where
    (at, sunk) = case anchor of
      Start -> ("start", 0)
      Middle -> ("middle", 0)
      End -> ("end", 0)
      Centred -> ("middle", 0.36 * size)

-- | About how wide a text is in a size, rather too much than too little.
textWidth :: Double -> Text -> Double
textWidth size words' =
  0.6
    * size
    * ( fromIntegral (DocLayout.realLength words')
          + 0.45 * fromIntegral (Text.length (Text.filter wide words'))
      )
  where
    wide c = c `elem` ("MWmwЖМФШЩЫЮжмфшщыю" :: String)

-- | A character that XML can not hold becomes a blank.
printable :: Text -> Text
printable = Text.map (\c -> if Char.isControl c || c >= '\xFFFE' && c <= '\xFFFF' then ' ' else c)

drawnWith :: Pen -> Svg.Attribute
drawnWith Pen {colour, width, dashes} =
  Attribute.stroke (toValue colour)
    <> Attribute.strokeWidth (number width)
    <> Attribute.strokeLinejoin "round"
    <> dashed
  where
    dashed = case dashes of
      [] -> mempty
      _ -> Attribute.strokeDasharray (numbers dashes)

-- | The commands that walk along segments.
course :: [Segment] -> Text
course segments = case segments of
  [] -> ""
  first : _ -> Text.concat ("M" : pair (Segment.start first) : concatMap walked segments)

walked :: Segment -> [Text]
walked s = case s of
  Straight _ b -> ["L", pair b]
  Arc {start, centre, sweep = Rad a} ->
    let Mm r = Segment.radius centre start
        -- Ends of a long arc say little about its centre when they are rounded, those of a full
        -- circle nothing; thirds of a circle are safe.
        pieces = max 1 (ceiling (abs a * 3 / (2 * pi) - 1e-9)) :: Int
        sense = if a > 0 then "1 " else "0 "
        to i = Segment.at (fromIntegral i / fromIntegral pieces) s
     in concat [["A", decimal r, " ", decimal r, " 0 0 ", sense, pair (to i)] | i <- [1 .. pieces]]

pair :: Point -> Text
pair p = decimal (Vec.x p) <> " " <> decimal (Vec.y p)

decimal :: Double -> Text
decimal = Decimal.short 4

number :: Double -> AttributeValue
number x = toValue (decimal x)

numbers :: [Double] -> AttributeValue
numbers xs = toValue (Text.unwords (map decimal xs))
