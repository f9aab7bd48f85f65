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
    strokes,
    swept,
    loop,
    outlines,
    area,
    areas,
    hatch,
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
import Geometry.Polyarc (Ends (..))
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
        <> Attribute.width (number across <> "mm")
        <> Attribute.height (number down <> "mm")
    viewBox = Attribute.viewbox (numbers [leftmost page, upper page, across, down])
    across = rightmost page - leftmost page
    down = lower page - upper page
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
stroke pen segments = strokes pen [segments]

-- | Open polyarcs, drawn with a pen as one element of the file.
strokes :: Pen -> [[Segment]] -> Svg
strokes pen chains =
  Svg.path ! Attribute.d (toValue (chainData chains)) ! Attribute.fill "none" ! drawnWith pen

-- | Open polyarcs, drawn with a pen whose ends are round: the area over which a circle sweeps.
swept :: Pen -> [[Segment]] -> Svg
swept pen chains = strokes pen chains ! Attribute.strokeLinecap "round"

-- | Closed polyarc, drawn with a pen.
loop :: Pen -> [Segment] -> Svg
loop pen segments = outlines pen [(Closed, segments)]

-- | Open and closed polyarcs, drawn with a pen as one element of the file.
outlines :: Pen -> [(Ends, [Segment])] -> Svg
outlines pen chains =
  Svg.path
    ! Attribute.d (toValue (Text.concat (concatMap chain chains)))
    ! Attribute.fill "none"
    ! drawnWith pen
  where
    chain (ends, segments) = pathData segments <> ["Z" | ends == Closed]

-- | Area that segments enclose, filled with a colour. The last segment need not end where the first
-- one begins.
area :: Text -> [Segment] -> Svg
area colour segments = areas colour [segments]

-- | Areas of a colour, as one element of the file.
areas :: Text -> [[Segment]] -> Svg
areas colour chains =
  Svg.path
    ! Attribute.d (toValue (Text.concat (concatMap (\c -> pathData c <> ["Z"]) chains)))
    ! Attribute.fill (toValue colour)

-- | Definition of a hatching: parallel lines of a pen, at a distance in mm and at an angle in
-- degrees. As a colour it is written @url(#name)@.
hatch :: Text -> Pen -> Double -> Double -> Svg
hatch name pen distance angle =
  Svg.defs $
    ( Svg.pattern
        ! Attribute.id_ (toValue name)
        ! Attribute.width (number distance)
        ! Attribute.height (number distance)
        ! Attribute.patternunits "userSpaceOnUse"
        ! Attribute.patterntransform (toValue ("rotate(" <> decimal angle <> ")"))
    )
      (stroke pen [Straight (Vec.point 0 (distance / 2)) (Vec.point distance (distance / 2))])

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
    ! Attribute.d (toValue (Text.concat ["M" <> exactly p <> "h0" | p <- points]))
    ! Attribute.fill "none"
    ! Attribute.stroke (toValue colour)
    ! Attribute.strokeWidth (number diameter)
    ! Attribute.strokeLinecap "round"
  where
    exactly p = decimal (Vec.x p) <> " " <> decimal (Vec.y p)

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

-- | Path data of open polyarcs. A polyarc that begins where the one before it ends continues it.
chainData :: [[Segment]] -> Text
chainData chains =
  Text.concat (concat (zipWith continued (Nothing : map Just chains) chains))
  where
    continued before chain = case (before, chain) of
      (Just (_ : _), first : _)
        | Just previous <- before,
          hundredths (Segment.end (last previous)) == hundredths (Segment.start first) ->
          drop 1 (pathData chain)
      _ -> pathData chain

-- | Path data of an open polyarc: a command that moves to its beginning, then commands for each
-- line and arc. A line is left out if both its ends are the same point on paper.
pathData :: [Segment] -> [Text]
pathData segments = case segments of
  [] -> []
  first : _ -> case concatMap pathCommands segments of
    [] -> [begin first, "h0"]
    commands -> begin first : commands
  where
    begin s = "M" <> pair (Segment.start s)

-- | Path commands of one segment.
pathCommands :: Segment -> [Text]
pathCommands s = case s of
  Straight a b -> ["L" <> pair b | hundredths a /= hundredths b]
  Arc {start, centre, sweep = Rad a}
    | abs a > 2 * pi - 1e-9 -> wholeCircle start centre (a > 0)
    | otherwise ->
      let Mm r = Segment.radius centre start
          -- SVG gives an arc by its ends, here rounded to two decimals. The rounding makes the
          -- centre of a long arc inexact. So the arc is divided into parts of at most a third of a
          -- circle.
          pieces = max 1 (ceiling (abs a * 3 / (2 * pi) - 1e-9)) :: Int
          sense = if a > 0 then "1 " else "0 "
          to i = Segment.at (fromIntegral i / fromIntegral pieces) s
       in [ Text.concat ["A", rounded r, " ", rounded r, " 0 0 ", sense, pair (to i)]
            | i <- [1 .. pieces]
          ]
  where
    rounded = Decimal.short 3

-- | Path commands of a circle from a point on it: two half circles. Their radius is half of the
-- rounded distance between their ends, so the centre is in the middle of this distance.
wholeCircle :: Point -> Point -> Bool -> [Text]
wholeCircle start centre isClockwise = [half (x, y), half (negate x, negate y)]
  where
    (x, y) = hundredths (Vec.shift (Vec.scale 2 (Vec.to start centre)) (Vec.point 0 0))
    r = Decimal.short 3 (sqrt (fromIntegral (x * x + y * y)) / 200)
    half (dx, dy) =
      Text.concat ["a", r, " ", r, if isClockwise then " 0 1 1 " else " 0 1 0 ", hundredth dx]
        <> " "
        <> hundredth dy

-- | Coordinates of a point in hundredths of a mm, to which the points of paths are rounded. A
-- printer has some 40 dots for a mm.
hundredths :: Point -> (Int, Int)
hundredths p = (round (100 * Vec.x p), round (100 * Vec.y p))

pair :: Point -> Text
pair p = let (x, y) = hundredths p in hundredth x <> " " <> hundredth y

-- | Decimal text of a count of hundredths. It is computed without floating point, because a drawing
-- has up to a million of these numbers.
hundredth :: Int -> Text
hundredth n
  | n < 0 = "-" <> hundredth (negate n)
  | fraction == 0 = Decimal.whole front
  | otherwise = Decimal.whole front <> "." <> digits
  where
    (front, fraction) = n `divMod` 100
    digits
      | fraction < 10 = "0" <> Decimal.whole fraction
      | fraction `mod` 10 == 0 = Decimal.whole (fraction `div` 10)
      | otherwise = Decimal.whole fraction

decimal :: Double -> Text
decimal = Decimal.short 4

number :: Double -> AttributeValue
number x = toValue (decimal x)

numbers :: [Double] -> AttributeValue
numbers xs = toValue (Text.unwords (map decimal xs))
