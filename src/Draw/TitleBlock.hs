-- | Strip below the drawing, with three fields: the legend, the scale bar and the title block (ISO
-- 7200). The field of the page is the area above the strip, for the part.
module Draw.TitleBlock
  ( name,
    block,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name qualified as Name
import Base.Quantity (LengthUnit, Mm (..), millimetresIn, times)
import Data.List (nub)
import Data.Maybe (catMaybes)
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.LineStyle qualified as LineStyle
import Draw.Page (Area (..), Page)
import Draw.Page qualified as Page
import Draw.Scene (Cut (isOnContour, numbered), MaterialSide (..), Scene (..), Shape (..))
import Draw.Svg (Anchor (..), Pen (..), Svg, TextStyle (..))
import Draw.Svg qualified as Svg
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (CutterKind, Part)
import Part.Part qualified as Part

-- | Name and title of the part on one line; empty if the part has neither.
name :: Part -> Text
name part = Text.intercalate ". " (catMaybes [Name.text <$> Part.name part, Part.title part])

-- | Borders of the page's field and of the strip, and the content of the strip.
block :: Part -> Scene -> [Svg]
block part scene =
  borders <> legend scene <> scaleBar (Part.unit part) (page scene) <> title part scene

-- | Left edges of the scale bar's field and of the title block, in mm from the left edge of the
-- page.
barEdge, titleEdge :: Double
barEdge = 160
titleEdge = 203

-- | Borders of the field and the strip, and the lines that divide the strip.
borders :: [Svg]
borders =
  [ Svg.rectangle LineStyle.framePen "none" Page.field,
    Svg.rectangle LineStyle.framePen "none" Page.strip,
    upright barEdge,
    upright titleEdge
  ]
  where
    upright x =
      Svg.stroke
        LineStyle.framePen
        [Straight (Vec.point x (upper Page.strip)) (Vec.point x (lower Page.strip))]

-- | Legend of the symbols that the drawing uses. Entries fill two rows, column by column.
legend :: Scene -> [Svg]
legend scene =
  concat (zipWith entry [0 ..] [(sample, words') | (True, sample, words') <- legendEntries scene])
  where
    entry i (sample, words') =
      let (column, row) = (i :: Int) `divMod` 2
          p =
            Vec.point
              (leftmost Page.strip + 3 + 29.4 * fromIntegral column)
              (upper Page.strip + 5 + 6.2 * fromIntegral row)
       in sample p <> [Svg.text LineStyle.small Start (Vec.shift (Vec.vec 10 0.9) p) words']

-- | Possible entries of the legend. Each has True if the drawing uses the symbol, a function that
-- draws the symbol to the right of a given point, and the symbol's meaning.
legendEntries :: Scene -> [(Bool, Point -> [Svg], Text)]
legendEntries Scene {page, shapes, cuts, restMaterial, feeds, rapids} =
  [ (any (\s -> materialSide s == Unknown) shapes, line LineStyle.contourPen, "contour"),
    ( any (\s -> materialSide s /= Unknown) shapes,
      \p -> surface LineStyle.materialColour p <> line LineStyle.contourPen p,
      "part"
    ),
    (not (null restMaterial), surface LineStyle.restColour, "material left"),
    ( not (null cuts),
      \p -> surface (colour (LineStyle.sweptPen 1)) p <> line LineStyle.pathPen p,
      "cutter path"
    ),
    ( any isOnContour cuts,
      \p -> concatMap (`line` p) [LineStyle.edgePen, LineStyle.bedPen, LineStyle.pathPen],
      "on a contour"
    ),
    (any numbered cuts, \p -> [LineStyle.node True (middle p)], "node"),
    (not (null feeds), linkingMove LineStyle.feedPen, "move at feed"),
    (not (null rapids), linkingMove LineStyle.rapidPen, "rapid move"),
    (not (null cuts), LineStyle.cutter 2 . middle, "cutter"),
    (True, LineStyle.start . middle, "start"),
    (Page.holds Page.field (Page.place page (Vec.point 0 0)), LineStyle.origin . middle, "origin")
  ]
  where
    line pen p = [Svg.stroke pen [Straight p (right p)]]
    linkingMove pen p =
      line pen p <> [Svg.arrow LineStyle.red 2.4 (Vec.vec 1 0) (Vec.shift (Vec.vec 5.2 0) p)]
    surface colour p =
      [ Svg.rectangle
          (Pen "none" 0 [])
          colour
          (Area (Vec.x p) (Vec.y p) (Vec.x p + 8) (Vec.y p + 2))
      ]
    right = Vec.shift (Vec.vec 8 0)
    middle = Vec.shift (Vec.vec 4 0)

-- | Scale bar: a round length of the part in its unit, 12 to 30 mm on paper, in four sections that
-- are alternately black and white.
scaleBar :: LengthUnit -> Page -> [Svg]
scaleBar unit page =
  zipWith step [0 ..] [LineStyle.black, "white", LineStyle.black, "white"]
    <> zipWith mark [0, 0.5, 1] ["", "", " " <> Decimal.unitText unit]
  where
    total = Page.round125 (30 / Page.onPaper page one)
    one = Mm (millimetresIn unit)
    width = Page.onPaper page (times total one)
    left = (barEdge + titleEdge - width) / 2
    y = upper Page.strip + 5
    step from colour =
      Svg.rectangle
        LineStyle.axisPen {colour = LineStyle.black}
        colour
        (Area (left + width * from / 4) y (left + width * (from + 1) / 4) (y + 1.6))
    mark fraction word =
      Svg.text
        LineStyle.small
        Middle
        (Vec.point (left + width * fraction) (y + 5))
        (Decimal.short 4 (total * fraction) <> word)

-- | Title block: the part's name and title, the scale, the diameters of cutters and drills, the
-- nose radii of turning tools.
title :: Part -> Scene -> [Svg]
title part Scene {page, tools} =
  [ fitted
      TextStyle {size = 4, ink = LineStyle.black, bold = True}
      (Vec.point left (y + 5.6))
      (name part),
    Svg.stroke
      LineStyle.axisPen {colour = LineStyle.black}
      [Straight (Vec.point titleEdge (y + 8.2)) (Vec.point (rightmost Page.strip) (y + 8.2))],
    Svg.text plain Start (Vec.point left (y + 13.2)) ("scale " <> Page.ratio (Page.scale page)),
    fitted plain (Vec.point (left + 30) (y + 13.2)) cutters
  ]
  where
    unit = Part.unit part
    left = titleEdge + 3
    y = upper Page.strip
    plain = TextStyle {size = 3, ink = LineStyle.black, bold = False}
    cutters =
      Text.intercalate "; " (map sized (nub (map (wordOf . fst) tools)))
        <> (if null tools then "" else " " <> Decimal.unitText unit)
    sized word = word <> Text.intercalate ", " [sizeOf k r | (k, r) <- tools, wordOf k == word]
    sizeOf kind r =
      Decimal.shortIn unit 4 (if kind == Part.TurningCutter then r else times 2 r)

-- | Word for the size of a tool.
wordOf :: CutterKind -> Text
wordOf kind = case kind of
  Part.MillingCutter -> "cutter Ø "
  Part.DrillingCutter -> "drill Ø "
  Part.ConeCutter -> "cone Ø "
  Part.DovetailCutter -> "dovetail Ø "
  Part.BladeCutter _ -> "blade Ø "
  Part.TurningCutter -> "nose R "

-- | Text that begins at point @p@ and ends before the right edge of the strip. A text that is too
-- long gets smaller letters, down to 2 mm. If that is not enough, "…" replaces its end.
fitted :: TextStyle -> Point -> Text -> Svg
fitted style p words' =
  Svg.text style {size = chosen} Start p (if fits chosen words' then words' else short)
  where
    room = rightmost Page.strip - 3 - Vec.x p
    fits s w = widthOf s w <= room
    chosen = max 2 (min (size style) (size style * room / max 1 (widthOf (size style) words')))
    -- Bold letters are wider than the estimate.
    widthOf s w = (if bold style then 1.1 else 1) * Svg.textWidth s w
    short = case filter (fits chosen) (map (<> "…") (reverse (Text.inits words'))) of
      longest : _ -> longest
      [] -> "…"
