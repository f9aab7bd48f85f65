-- | Strip below the drawing, with three fields: the legend, the scale bar and the title block (ISO
-- 7200). On an upright page the legend is above the other two.
module Draw.TitleBlock
  ( TitleContent (..),
    height,
    block,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Seconds (..), millimetresIn, times)
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.Legend (Legend)
import Draw.Legend qualified as Legend
import Draw.LineStyle (LineStyles (..))
import Draw.LineStyle qualified as LineStyle
import Draw.Page (Area (..), Page, PageFormat)
import Draw.Page qualified as Page
import Draw.Svg (Anchor (..), Pen (..), Svg, TextStyle (..))
import Draw.Svg qualified as Svg
import Draw.ToolUse (ToolUse (..))
import Draw.ToolUse qualified as ToolUse
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | Facts in the strip.
data TitleContent = TitleContent
  { -- | name and title of the part on one line; empty if the part has neither
    heading :: Text,
    unit :: LengthUnit,
    format :: PageFormat,
    tools :: [ToolUse],
    -- | time of the whole machining at the feeds of the program
    machining :: Seconds,
    legend :: Legend
  }

-- | Fields of the strip.
data Fields = Fields {legendField :: Area, barField :: Area, titleField :: Area}

-- | Width of the scale bar's field in mm.
barWidth :: Double
barWidth = 43

-- | Height in mm of the strip on a paper.
height :: TitleContent -> Area -> Double
height content paper
  | isUpright paper = legendHeight wide content + titleHeight (wide - barWidth) content
  | otherwise =
    max
      (titleHeight (titleWidth paper) content)
      (legendHeight (wide - barWidth - titleWidth paper) content)
  where
    wide = Page.fieldWidth paper

isUpright :: Area -> Bool
isUpright paper = lower paper - upper paper > rightmost paper - leftmost paper

-- | Width of the title block in mm on a page in landscape.
titleWidth :: Area -> Double
titleWidth paper = if rightmost paper > 400 then 150 else 102

legendHeight :: Double -> TitleContent -> Double
legendHeight wide content =
  3.5 + legendStep * fromIntegral (Legend.rowsIn wide (legend content))

-- | Distance of the rows of the legend in mm.
legendStep :: Double
legendStep = 5.2

titleHeight :: Double -> TitleContent -> Double
titleHeight wide content = 14.5 + toolStep * fromIntegral (toolRows wide content)

-- | Distance of the rows of the tools in mm.
toolStep :: Double
toolStep = 4

-- | Columns of tools in a title block of a width: two if there are many tools.
toolColumns :: Double -> TitleContent -> Int
toolColumns wide content = if length (tools content) > 4 && wide > 120 then 2 else 1

toolRows :: Double -> TitleContent -> Int
toolRows wide content = (length (tools content) + columns - 1) `div` columns
  where
    columns = toolColumns wide content

-- | Fields of the strip of a page.
fields :: TitleContent -> Page -> Fields
fields content page
  | isUpright (Page.paper page) =
    let below = upper whole + legendHeight (rightmost whole - leftmost whole) content
        barEdge = leftmost whole + barWidth
     in Fields
          { legendField = whole {lower = below},
            barField = whole {upper = below, rightmost = barEdge},
            titleField = whole {upper = below, leftmost = barEdge}
          }
  | otherwise =
    let titleEdge = rightmost whole - titleWidth (Page.paper page)
        barEdge = titleEdge - barWidth
     in Fields
          { legendField = whole {rightmost = barEdge},
            barField = whole {leftmost = barEdge, rightmost = titleEdge},
            titleField = whole {leftmost = titleEdge}
          }
  where
    whole = Page.strip page

-- | Borders of the page's field and of the strip, and the content of the strip.
block :: LineStyles -> TitleContent -> Page -> [Svg]
block styles content page =
  map border [Page.field page, legendField areas, barField areas, titleField areas]
    <> Legend.legend styles legendStep (legendField areas) (legend content)
    <> scaleBar styles (unit content) (barField areas) page
    <> title styles content (titleField areas) page
  where
    areas = fields content page
    border = Svg.rectangle (framePen styles) "none"

-- | Scale bar: a round length of the part in its unit, 12 to 30 mm on paper, in four sections that
-- are alternately black and white.
scaleBar :: LineStyles -> LengthUnit -> Area -> Page -> [Svg]
scaleBar styles unit area page =
  zipWith step [0 ..] [ink, background styles, ink, background styles]
    <> zipWith mark [0, 0.5, 1] ["", "", " " <> Decimal.unitText unit]
  where
    ink = inkColour styles
    total = Page.round125 (30 / Page.onPaper page one)
    one = Mm (millimetresIn unit)
    width = Page.onPaper page (times total one)
    left = (leftmost area + rightmost area - width) / 2
    y = upper area + 5
    step from colour =
      Svg.rectangle
        (coordinatePen styles) {colour = ink}
        colour
        (Area (left + width * from / 4) y (left + width * (from + 1) / 4) (y + 1.6))
    mark fraction word =
      Svg.text
        (LineStyle.lettering styles 2.5)
        Middle
        (Vec.point (left + width * fraction) (y + 5))
        (Decimal.short 4 (total * fraction) <> word)

-- | Title block: the part's name and title; the scale, the format and the time of machining; and a
-- row for each tool with its feeds and its time.
title :: LineStyles -> TitleContent -> Area -> Page -> [Svg]
title styles content area page =
  [ fitted
      (LineStyle.lettering styles 4) {bold = True}
      (Vec.point left (y + 5.6))
      edge
      (heading content),
    Svg.stroke
      (coordinatePen styles) {colour = inkColour styles}
      [Straight (Vec.point (leftmost area) (y + 8)) (Vec.point (rightmost area) (y + 8))],
    fitted plain (Vec.point left (y + 12)) edge facts
  ]
    <> concat (zipWith toolRow [0 ..] (tools content))
  where
    left = leftmost area + 3
    edge = rightmost area - 3
    y = upper area
    plain = LineStyle.lettering styles 2.8
    facts =
      Text.intercalate
        " · "
        ( ["scale " <> Page.ratio (Page.scale page), Page.formatName (format content)]
            <> ["machining " <> timeText (machining content) | machining content > Seconds 0]
        )
    wide = rightmost area - leftmost area
    columns = toolColumns wide content
    columnWidth = (edge - left) / fromIntegral columns
    toolRow i tool =
      let (column, row) = (i :: Int) `divMod` toolRows wide content
          x = left + columnWidth * fromIntegral column
       in [ fitted
              (LineStyle.lettering styles 2.5)
              (Vec.point x (y + 16 + toolStep * fromIntegral row))
              (x + columnWidth - 2)
              (toolText (unit content) tool)
          ]

-- | Tool with its number, size, feeds and time.
toolText :: LengthUnit -> ToolUse -> Text
toolText unit tool =
  Text.intercalate
    ", "
    ( filter
        (/= "")
        [ Text.unwords (filter (/= "") [ToolUse.numberText tool, ToolUse.sizeText unit tool])
            <> " "
            <> Decimal.unitText unit,
          ToolUse.feedText unit (feeds tool),
          if time tool > Seconds 0 then timeText (time tool) else ""
        ]
    )

-- | Time in seconds, in minutes and seconds, or in hours and minutes.
timeText :: Seconds -> Text
timeText (Seconds s)
  | whole < 60 = Decimal.whole whole <> " s"
  | whole < 3600 = pair "min" (whole `divMod` 60) "s"
  | otherwise = pair "h" ((whole `div` 60) `divMod` 60) "min"
  where
    whole = round s :: Int
    pair large (a, b) little =
      Decimal.whole a <> " " <> large <> " " <> Text.justifyRight 2 '0' (Decimal.whole b) <> " "
        <> little

-- | Text that begins at point @p@ and ends before the position @edge@. A text that is too long gets
-- smaller letters, down to 2 mm. If that is not enough, "…" replaces its end.
fitted :: TextStyle -> Point -> Double -> Text -> Svg
fitted style p edge words' =
  Svg.text style {size = chosen} Start p (if fits chosen words' then words' else short)
  where
    room = edge - Vec.x p
    fits s w = widthOf s w <= room
    chosen = max 2 (min (size style) (size style * room / max 1 (widthOf (size style) words')))
    -- Bold letters are wider than the estimate.
    widthOf s w = (if bold style then 1.1 else 1) * Svg.textWidth s w
    short = case filter (fits chosen) (map (<> "…") (reverse (Text.inits words'))) of
      longest : _ -> longest
      [] -> "…"
