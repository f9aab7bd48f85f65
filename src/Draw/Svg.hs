-- | SVG 1.1 documents: lines, areas, symbols and texts, in mm of paper.
--
-- An arc is an arc in the file, not a polyline. Every element has its style in its own attributes.
-- So a document needs no style sheet, and its elements can be copied into others.
module Draw.Svg
  ( Svg,
    document,
    layer,
    Pen (..),
    stroke,
    swept,
    loop,
    area,
    rectangle,
    dot,
    dots,
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

-- | SVG text of a drawing. The arguments are the area of its page, its title, and its layers, the
-- lowest one first.
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

-- | Layer: a group of elements with a name, under which graphics programs list it.
layer :: Text -> [Svg] -> Svg
layer name things = Svg.g ! Attribute.id_ (toValue name) $ rows things

-- | Elements one after the other, each on a line of its own in the file.
rows :: [Svg] -> Svg
rows things = toSvg newLine *> traverse_ (\thing -> thing *> toSvg newLine) things
  where
    newLine = "\n" :: Text

-- | Pen: colour, width in mm, and alternately the lengths of dashes and gaps in mm. @dashes@ is
-- empty for a solid line.
data Pen = Pen {colour :: Text, width :: Double, dashes :: [Double]}
  deriving stock (Eq, Show)

-- | Open polyarc, drawn with a pen. Each segment begins where the previous one ends.
stroke :: Pen -> [Segment] -> Svg
stroke pen segments =
  Svg.path ! Attribute.d (toValue (pathData segments)) ! Attribute.fill "none" ! drawnWith pen

-- | Open polyarc, drawn with a pen whose ends are round: the area over which a circle sweeps.
swept :: Pen -> [Segment] -> Svg
swept pen segments = stroke pen segments ! Attribute.strokeLinecap "round"

-- | Closed polyarc, drawn with a pen.
loop :: Pen -> [Segment] -> Svg
loop pen segments =
  Svg.path
    ! Attribute.d (toValue (pathData segments <> "Z"))
    ! Attribute.fill "none"
    ! drawnWith pen

-- | Area that segments enclose, filled with a colour. The last segment need not end where the first
-- one begins.
area :: Text -> [Segment] -> Svg
area colour segments =
  Svg.path ! Attribute.d (toValue (pathData segments <> "Z")) ! Attribute.fill (toValue colour)

-- | Rectangle, drawn with a pen and filled with a colour.
rectangle :: Pen -> Text -> Area -> Svg
rectangle pen colour Area {leftmost, upper, rightmost, lower} =
  Svg.rect
    ! Attribute.x (number leftmost)
    ! Attribute.y (number upper)
    ! Attribute.width (number (rightmost - leftmost))
    ! Attribute.height (number (lower - upper))
    ! Attribute.fill (toValue colour)
    ! drawnWith pen

-- | Filled circle of a colour about point @p@; @radius@ in mm.
dot :: Text -> Double -> Point -> Svg
dot colour radius p = circle radius p ! Attribute.fill (toValue colour)

-- | Filled circles of a colour and a diameter in mm about points. They are one element: lines
-- without length, with round ends.
dots :: Text -> Double -> [Point] -> Svg
dots colour diameter points =
  Svg.path
    ! Attribute.d (toValue (Text.concat ["M" <> pair p <> "h0" | p <- points]))
    ! Attribute.fill "none"
    ! Attribute.stroke (toValue colour)
    ! Attribute.strokeWidth (number diameter)
    ! Attribute.strokeLinecap "round"

-- | Circle about point @p@, drawn with a pen; @radius@ in mm.
ring :: Pen -> Double -> Point -> Svg
ring pen radius p = circle radius p ! Attribute.fill "none" ! drawnWith pen

circle :: Double -> Point -> Svg
circle radius p =
  Svg.circle
    ! Attribute.cx
      (number (Vec.x p))
    ! Attribute.cy (number (Vec.y p))
    ! Attribute.r (number radius)

-- | Filled arrowhead of a colour with its point at @tip@. Its length is @size@ in mm, and it points
-- in @direction@, a unit vector.
arrow :: Text -> Double -> Vec -> Point -> Svg
arrow colour size direction tip = area colour [Straight tip (back 1), Straight (back 1) (back (-1))]
  where
    along = Vec.scale (-size) direction
    back side = Vec.shift (Vec.add along (Vec.scale (side * size / 4) (Vec.left direction))) tip

-- | Point of a text that is put at the given position: the start, the middle or the end of its base
-- line. 'Centred' is the point above the middle of the base line, at half the height of a digit.
data Anchor = Start | Middle | End | Centred
  deriving stock (Eq, Show)

-- | Style of a text: size in mm, colour, weight.
data TextStyle = TextStyle {size :: Double, ink :: Text, bold :: Bool}
  deriving stock (Eq, Show)

-- | Text on one line, whose @anchor@ lies at point @p@.
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

-- | Estimated width in mm of a text whose letter size is @size@ mm. The estimate is rarely too
-- small, so a text that should fit by this estimate rarely exceeds its space.
textWidth :: Double -> Text -> Double
textWidth size words' =
  0.6
    * size
    * ( fromIntegral (DocLayout.realLength words')
          + 0.45 * fromIntegral (Text.length (Text.filter wide words'))
      )
  where
    wide c = c `elem` ("MWmwЖМФШЩЫЮжмфшщыю" :: String)

-- | Replaces control characters, and the other characters that XML does not allow, by spaces.
printable :: Text -> Text
printable = Text.map (\c -> if Char.isControl c || c >= '\xFFFE' && c <= '\xFFFF' then ' ' else c)

-- | Attributes of a line that is drawn with a pen.
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

-- | Path data of an open polyarc: a command that moves to its beginning, then commands for each
-- line and arc.
pathData :: [Segment] -> Text
pathData segments = case segments of
  [] -> ""
  first : _ -> Text.concat ("M" : pair (Segment.start first) : concatMap pathCommands segments)

-- | Path commands of one segment.
pathCommands :: Segment -> [Text]
pathCommands s = case s of
  Straight _ b -> ["L", pair b]
  Arc {start, centre, sweep = Rad a} ->
    let Mm r = Segment.radius centre start
        -- SVG gives an arc by its ends, here rounded to four decimals. The rounding makes the
        -- centre of a long arc inexact, and the ends of a full circle do not determine its centre.
        -- So the arc is divided into parts of at most a third of a circle.
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
