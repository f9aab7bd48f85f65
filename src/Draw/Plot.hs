-- | Drawing of a part and its toolpath as SVG: one page at a standard scale, made to be printed.
-- Line widths and letter sizes are mm of paper at every scale. Line styles can be told apart in
-- black and white.
module Draw.Plot
  ( plot,
  )
where

import Base.Name qualified as Name
import Base.Quantity (LengthUnit, Mm (..), millimetresIn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes)
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.CutClass (CutClass)
import Draw.CutClass qualified as CutClass
import Draw.DimensionLine qualified as DimensionLine
import Draw.FromPart qualified as FromPart
import Draw.Legend qualified as Legend
import Draw.LineStyle (LineStyles (..))
import Draw.LineStyle qualified as LineStyle
import Draw.NodeLabel qualified as NodeLabel
import Draw.Page (Area (..), Page)
import Draw.Page qualified as Page
import Draw.PlotLabel qualified as PlotLabel
import Draw.PlotMove qualified as PlotMove
import Draw.PlotSettings (PlotSettings (..))
import Draw.Scene (MaterialSide (..), Rest (..), Scene (..), Shape (..))
import Draw.Scene qualified as Scene
import Draw.StockPlot qualified as StockPlot
import Draw.Svg (Anchor (..), Pen (..), Svg)
import Draw.Svg qualified as Svg
import Draw.TitleBlock (TitleContent (TitleContent, heading, legend, machining))
import Draw.TitleBlock qualified as TitleBlock
import Frame.MoveTime qualified as MoveTime
import Geometry.Carrier (Line (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (..), Polyarc (Polyarc))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Transformation qualified as Transformation
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Part.Part (Part)
import Part.Part qualified as Part
import Toolpath.Toolpath (Toolpath)

-- | Draws a part and its toolpath as an SVG document.
plot :: PlotSettings -> Part -> Toolpath -> Text
plot settings part path =
  Svg.document
    (Page.paper page)
    (heading content)
    ( lowerLayers settings styles (Part.unit part) page scene
        <> upperLayers styles (Part.unit part) page (classesOf scene) scene
        <> [Svg.layer "title" (TitleBlock.block styles content page)]
    )
  where
    styles = LineStyle.lineStyles (appearance settings)
    onPart = FromPart.scene part path
    classesOf = CutClass.classes (colouring settings) (Part.unit part)
    page = Page.choose (format settings) (TitleBlock.height content) (FromPart.extent part path)
    scene = Scene.onPage page onPart
    content =
      TitleContent
        { heading = headingOf part,
          TitleBlock.unit = Part.unit part,
          TitleBlock.format = format settings,
          TitleBlock.tools = Scene.tools onPart,
          machining = MoveTime.pathTime Nothing path,
          legend = Legend.entries styles (classesOf onPart) onPart
        }

-- | Name and title of the part on one line; empty if the part has neither.
headingOf :: Part -> Text
headingOf part = Text.intercalate ". " (catMaybes [Name.text <$> Part.name part, Part.title part])

-- | Layers below the contours. Where the stock is known, the stock that is left takes the place of
-- the material beside the contours and of the swept areas.
lowerLayers :: PlotSettings -> LineStyles -> LengthUnit -> Page -> Scene -> [Svg]
lowerLayers settings styles unit page scene =
  [ Svg.layer
      "page"
      ( LineStyle.hatchings (appearance settings)
          <> [Svg.rectangle (Pen "none" 0 []) (background styles) (Page.paper page)]
      ),
    if hasStock
      then Svg.layer "stock" (StockPlot.stockAreas styles (stock scene))
      else Svg.layer "material" (material styles (shapes scene))
  ]
    <> [ Svg.layer "swept-leads" (PlotMove.sweptLeads styles (leads scene))
         | not (null (leads scene) || hasStock)
       ]
    <> [Svg.layer "swept" (PlotMove.sweptAreas styles (cuts scene)) | not hasStock]
    <> [ Svg.layer "avoided" (StockPlot.avoidedAreas styles (stock scene))
         | not (null (StockPlot.avoidedOutlines (stock scene)))
       ]
    <> [Svg.layer "axes" (axes styles unit page)]
    <> [ Svg.layer "rests" (rests styles (map around (restMaterial scene)))
         | not (null (restMaterial scene))
       ]
    <> [ Svg.layer "mirrored-half" (mirroredHalf styles (Page.field page) (Vec.y p) scene)
         | Just p <- [spindleAxis scene]
       ]
  where
    hasStock = StockPlot.hasStock (stock scene)

-- | Layers from the contours upwards, without the title. The classes are those of the cuts.
upperLayers :: LineStyles -> LengthUnit -> Page -> [CutClass] -> Scene -> [Svg]
upperLayers styles unit page classes scene =
  [ Svg.layer "contours" (contourLines styles (shapes scene)),
    Svg.layer "linking-moves" (PlotMove.linkingMoves styles scene),
    Svg.layer "path" (PlotMove.cutLines styles classes (cuts scene)),
    Svg.layer "start" (LineStyle.start styles (start scene) <> originMark styles page),
    Svg.layer "cutters" (PlotMove.cutters styles (cuts scene))
  ]
    <> [ Svg.layer "holes" [Svg.strokes (spindlePen styles) (map pure (PlotMove.centreMarks scene))]
         | not (null (PlotMove.centreMarks scene))
       ]
    <> [ Svg.layer "descents" (PlotMove.descentMarks styles scene)
         | not (null (descents scene))
       ]
    <> [ Svg.layer "tabs" (concatMap (LineStyle.tab styles . fst) (tabs scene))
         | not (null (tabs scene))
       ]
    <> [ Svg.layer
           "dimensions"
           (concatMap (DimensionLine.drawn styles (Page.field page)) (dimensions scene))
         | not (null (dimensions scene))
       ]
    <> [ Svg.layer "nodes" (concatMap (NodeLabel.dots styles) (NodeLabel.shown (cuts scene))),
         Svg.layer "labels" (PlotLabel.labels styles unit page scene)
       ]

-- Part --------------------------------------------------------------------------------------------

-- | Areas of material in grey, with windows in white. A body is a contour with material inside, and
-- a window is a contour with material outside. A shape is drawn after the shape in which it lies.
-- If every body lies in a window, or if there is no body, each window gets a grey band around it.
-- The band shows the material outside the window.
--
-- Areas of one colour that lie in as many windows are one element of the file, if their directions
-- are the same.
material :: LineStyles -> [Shape] -> [Svg]
material styles shapes =
  bands
    <> [ Svg.areas (colour side) (map outline group)
         | ((_, side, _), group) <-
             Map.toList (Map.fromListWith (<>) (reverse (map painted (bodies <> windows))))
       ]
  where
    bodies = filter (\s -> materialSide s == Inside) shapes
    windows = filter (\s -> materialSide s == Outside) shapes
    bands =
      [ Svg.outlines
          (Pen (materialColour styles) 6 [])
          [(Closed, outline s) | s <- windows]
        | not (null windows) && length windows <= mostBands && all ((> 0) . inWindows) bodies
      ]
    painted s = ((inWindows s, materialSide s, isCounterClockwise (outline s)), [s])
    colour side = if side == Inside then materialColour styles else background styles
    inWindows s =
      let p =
            beginning s
       in length
            [ w
              | w <- BoxTree.within (BoundingBox.ofPoints p []) index,
                outline w /= outline s,
                WindingNumber.about p (outline w) /= 0
            ]
    index =
      BoxTree.index
        ( \w ->
            foldr
              (BoundingBox.union . BoundingBox.ofSegment)
              (BoundingBox.ofPoints (beginning w) [])
              (outline w)
        )
        windows
    beginning s = case outline s of
      s' : _ -> Segment.start s'
      [] -> Vec.point 0 0

-- | Greatest count of windows with a band around each. The bands of more windows cover the page.
mostBands :: Int
mostBands = 2000

-- | True if a closed chain of segments goes counter-clockwise in its coordinates.
isCounterClockwise :: [Segment] -> Bool
isCounterClockwise segments = case segments of
  [] -> False
  s : more -> Polyarc.signedArea (Polyarc Closed (s :| more)) > 0

-- | Lines along the contours of shapes.
contourLines :: LineStyles -> [Shape] -> [Svg]
contourLines styles shapes =
  [ Svg.outlines (contourPen styles) [(ends s, outline s) | s <- shapes]
    | not (null shapes)
  ]

-- | Areas of rest material. Areas that are the same on paper are drawn once.
rests :: LineStyles -> [[Segment]] -> [Svg]
rests styles given =
  [ Svg.areas (restColour styles) given,
    Svg.outlines (restPen styles) [(Closed, segments) | segments <- given]
  ]

-- | Axis of the spindle at the height @y@ across the field, and the other half of a turned part. A
-- line leads from each corner to its mirror image.
mirroredHalf :: LineStyles -> Area -> Double -> Scene -> [Svg]
mirroredHalf styles field y Scene {shapes} =
  concatMap (half . outline) shapes
    <> [ Svg.stroke
           (spindlePen styles)
           [Straight (Vec.point (leftmost field) y) (Vec.point (rightmost field) y)]
       ]
  where
    half segments =
      Svg.stroke (mirrorPen styles) (map (Transformation.segment mirror) segments) :
        [ Svg.stroke (mirrorPen styles) [Straight p (Transformation.point mirror p)]
          | (a, b) <- zip segments (drop 1 segments),
            isCorner a b,
            let p = Segment.end a
        ]
    mirror = Transformation.reflection (Line (Vec.point 0 y) (Vec.point 1 y))
    isCorner a b = Vec.dot (Segment.endDirection a) (Segment.startDirection b) < 0.9999

-- | Thin axes through the origin of the part. If the origin is not on the field, two short axes
-- cross near the lower left corner. They cross at a point with round coordinates, which are written
-- beside it, in the given unit.
axes :: LineStyles -> LengthUnit -> Page -> [Svg]
axes styles unit page
  | Page.holds area origin =
    [ Svg.stroke
        (coordinatePen styles)
        [Straight (Vec.point (leftmost area) oy) (Vec.point right oy)],
      Svg.stroke (coordinatePen styles) [Straight (Vec.point ox (lower area)) (Vec.point ox top)]
    ]
      <> axisHeads styles ox oy right top
  | otherwise =
    [ Svg.stroke (coordinatePen styles) [Straight mark (Vec.point (mx + 12) my)],
      Svg.stroke (coordinatePen styles) [Straight mark (Vec.point mx (my - 12))],
      Svg.text
        (LineStyle.lettering styles 2.5)
        Start
        (Vec.point (mx + 1) (my + 3.2))
        (Vec.toText unit 4 crossing)
    ]
      <> axisHeads styles mx my (mx + 12) (my - 12)
  where
    area = Page.field page
    origin = Page.place page (Vec.point 0 0)
    (ox, oy) = (Vec.x origin, Vec.y origin)
    (right, top) = (rightmost area - 3, upper area + 3)
    corner = Page.unplace page (Vec.point (leftmost area + 3) (lower area - 5))
    grid = gridOf unit page
    crossing = Vec.point (up (Vec.x corner)) (up (Vec.y corner))
    up c = grid * fromIntegral (ceiling (c / grid) :: Integer)
    mark = Page.place page crossing
    (mx, my) = (Vec.x mark, Vec.y mark)

-- | Symbol of the part's origin; none if the origin is not on the field.
originMark :: LineStyles -> Page -> [Svg]
originMark styles page =
  concatMap
    (LineStyle.origin styles)
    (filter (Page.holds (Page.field page)) [Page.place page (Vec.point 0 0)])

-- | Arrowheads and names of the axes, which cross at (@px@, @py@). @right@ is the x of the right
-- end of the x axis, @top@ the y of the upper end of the y axis. All arguments are in mm of paper.
axisHeads :: LineStyles -> Double -> Double -> Double -> Double -> [Svg]
axisHeads styles px py right top =
  [ LineStyle.axisArrow styles (Vec.vec 1 0) (Vec.point right py),
    LineStyle.axisArrow styles (Vec.vec 0 (-1)) (Vec.point px top),
    Svg.text (LineStyle.lettering styles 2.5) Centred (Vec.point (right - 1) (py - 2.4)) "x",
    Svg.text (LineStyle.lettering styles 2.5) Centred (Vec.point (px + 2.4) (top + 1)) "y"
  ]

-- | Step of the round coordinates in 'axes', in mm of the part: these coordinates are multiples of
-- the step, which is round in the unit. On paper the step is 3.2 to 8 mm long.
gridOf :: LengthUnit -> Page -> Double
gridOf unit page = one * Page.round125 (8 / Page.onPaper page (Mm one))
  where
    one = millimetresIn unit
