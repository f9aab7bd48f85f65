-- | Drawing of a part and its toolpath as SVG: one A4 page at a standard scale, made to be printed.
-- Line widths and letter sizes are mm of paper at every scale. Line styles can be told apart in
-- black and white.
module Draw.Plot
  ( plot,
  )
where

import Base.Quantity (LengthUnit, Mm (..), millimetresIn, minus, over, times, total)
import Data.Bifunctor (first)
import Data.List (sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Draw.Label qualified as Label
import Draw.LineStyle qualified as LineStyle
import Draw.NodeLabel qualified as NodeLabel
import Draw.Page (Area (..), Page)
import Draw.Page qualified as Page
import Draw.Scene (Cut (..), MaterialSide (..), Scene (..), Shape (..))
import Draw.Scene qualified as Scene
import Draw.Svg (Anchor (..), Pen (..), Svg, TextStyle (..))
import Draw.Svg qualified as Svg
import Draw.TitleBlock qualified as TitleBlock
import Geometry.Carrier (Circle (..), Line (..), Sense (..))
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Transformation qualified as Transformation
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Part.Part (Part)
import Part.Part qualified as Part
import Toolpath.Toolpath (Toolpath)

-- | Draws a part and its toolpath as an SVG document.
plot :: Part -> Toolpath -> Text
plot part path =
  Svg.document
    Page.wholePage
    (TitleBlock.name part)
    ( [ Svg.layer "page" [Svg.rectangle (Pen "none" 0 []) "white" Page.wholePage],
        Svg.layer "material" (material (shapes scene)),
        Svg.layer "swept" (map sweptArea (cuts scene)),
        Svg.layer "axes" (axes (Part.unit part) (page scene))
      ]
        <> [ Svg.layer "rests" (map (Svg.area LineStyle.restColour) (restMaterial scene))
             | not (null (restMaterial scene))
           ]
        <> [Svg.layer "mirrored-half" (mirroredHalf y scene) | Just y <- [spindleAxis scene]]
        <> [ Svg.layer "contours" (map contourLine (shapes scene)),
             Svg.layer "linking-moves" (linkingMoves scene),
             Svg.layer "path" (concatMap cutLine (cuts scene)),
             Svg.layer "start" (LineStyle.start (start scene) <> originMark (page scene)),
             Svg.layer "cutters" (concatMap cutter (filter showsCutter (cuts scene))),
             Svg.layer "nodes" (concatMap NodeLabel.dots (filter numbered (cuts scene))),
             Svg.layer "numbers" (numbers scene),
             Svg.layer "title" (TitleBlock.block part scene)
           ]
    )
  where
    scene = Scene.fromPart part path

-- | Axis of the spindle at the height @y@, and the other half of a turned part. A line leads from
-- each corner to its mirror image.
mirroredHalf :: Double -> Scene -> [Svg]
mirroredHalf y Scene {shapes} =
  concatMap (half . outline) shapes
    <> [ Svg.stroke
           LineStyle.spindlePen
           [Straight (Vec.point (leftmost Page.field) y) (Vec.point (rightmost Page.field) y)]
       ]
  where
    half segments =
      Svg.stroke LineStyle.mirrorPen (map (Transformation.segment mirror) segments) :
        [ Svg.stroke LineStyle.mirrorPen [Straight p (Transformation.point mirror p)]
          | (a, b) <- zip segments (drop 1 segments),
            isCorner a b,
            let p = Segment.end a
        ]
    mirror = Transformation.reflection (Line (Vec.point 0 y) (Vec.point 1 y))
    isCorner a b = Vec.dot (Segment.endDirection a) (Segment.startDirection b) < 0.9999

-- Part --------------------------------------------------------------------------------------------

-- | Area over which the cutter sweeps along a cut.
sweptArea :: Cut -> Svg
sweptArea cut =
  Svg.swept (LineStyle.sweptPen (cutterRadius cut)) (NonEmpty.toList (Scene.lines cut))

-- | Areas of material in grey, with windows in white. A body is a contour with material inside, and
-- a window is a contour with material outside. A shape is drawn after the shape in which it lies.
-- If every body lies in a window, or if there is no body, each window gets a grey band around it.
-- The band shows the material outside the window.
material :: [Shape] -> [Svg]
material shapes = bands <> map snd (sortOn fst (map painted bodies <> map painted windows))
  where
    bodies = filter (\s -> materialSide s == Inside) shapes
    windows = filter (\s -> materialSide s == Outside) shapes
    bands =
      [ Svg.loop (Pen LineStyle.materialColour 6 []) (outline s)
        | all ((> 0) . inWindows) bodies,
          s <- windows
      ]
    painted s =
      ( level s,
        Svg.area (colour s) (outline s)
      )
    colour s = if materialSide s == Inside then LineStyle.materialColour else "white"
    -- Number for the drawing order: a body is drawn before the windows in it, and a window before
    -- the bodies in it.
    level s = 2 * inWindows s + (if materialSide s == Inside then 0 else 1)
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

-- | Line along the contour of a shape.
contourLine :: Shape -> Svg
contourLine Shape {ends, outline} = case ends of
  Open -> Svg.stroke LineStyle.contourPen outline
  Closed -> Svg.loop LineStyle.contourPen outline

-- | Thin axes through the origin of the part. If the origin is not on the field, two short axes
-- cross near the lower left corner. They cross at a point with round coordinates, which are written
-- beside it, in the given unit.
axes :: LengthUnit -> Page -> [Svg]
axes unit page
  | Page.holds Page.field origin =
    [ Svg.stroke
        LineStyle.axisPen
        [Straight (Vec.point (leftmost Page.field) oy) (Vec.point right oy)],
      Svg.stroke LineStyle.axisPen [Straight (Vec.point ox (lower Page.field)) (Vec.point ox top)]
    ]
      <> axisHeads ox oy right top
  | otherwise =
    [ Svg.stroke LineStyle.axisPen [Straight mark (Vec.point (mx + 12) my)],
      Svg.stroke LineStyle.axisPen [Straight mark (Vec.point mx (my - 12))],
      Svg.text
        LineStyle.small
        Start
        (Vec.point (mx + 1) (my + 3.2))
        (Vec.toText unit 4 crossing)
    ]
      <> axisHeads mx my (mx + 12) (my - 12)
  where
    origin = Page.place page (Vec.point 0 0)
    (ox, oy) = (Vec.x origin, Vec.y origin)
    (right, top) = (rightmost Page.field - 3, upper Page.field + 3)
    corner = Page.unplace page (Vec.point (leftmost Page.field + 3) (lower Page.field - 5))
    grid = gridOf unit page
    crossing = Vec.point (up (Vec.x corner)) (up (Vec.y corner))
    up c = grid * fromIntegral (ceiling (c / grid) :: Integer)
    mark = Page.place page crossing
    (mx, my) = (Vec.x mark, Vec.y mark)

-- | Symbol of the part's origin; none if the origin is not on the field.
originMark :: Page -> [Svg]
originMark page =
  concatMap LineStyle.origin (filter (Page.holds Page.field) [Page.place page (Vec.point 0 0)])

-- | Arrowheads and names of the axes, which cross at (@px@, @py@). @right@ is the x of the right
-- end of the x axis, @top@ the y of the upper end of the y axis. All arguments are in mm of paper.
axisHeads :: Double -> Double -> Double -> Double -> [Svg]
axisHeads px py right top =
  [ LineStyle.axisArrow (Vec.vec 1 0) (Vec.point right py),
    LineStyle.axisArrow (Vec.vec 0 (-1)) (Vec.point px top),
    Svg.text LineStyle.small Centred (Vec.point (right - 1) (py - 2.4)) "x",
    Svg.text LineStyle.small Centred (Vec.point (px + 2.4) (top + 1)) "y"
  ]

-- | Step of the round coordinates in 'axes', in mm of the part: these coordinates are multiples of
-- the step, which is round in the unit. On paper the step is 3.2 to 8 mm long.
gridOf :: LengthUnit -> Page -> Double
gridOf unit page = one * Page.round125 (8 / Page.onPaper page (Mm one))
  where
    one = millimetresIn unit

-- Toolpath ----------------------------------------------------------------------------------------

-- | Lines of the linking moves. A segment that the cutter traverses in both directions is drawn
-- once, with an arrow for each direction.
linkingMoves :: Scene -> [Svg]
linkingMoves Scene {feeds, rapids} =
  map (line LineStyle.feedPen) lineFeeds <> map (line LineStyle.rapidPen) lineRapids <> arrows
  where
    arrows = concatMap (LineStyle.arrowOn LineStyle.red 0.75) (feeds <> rapids)
    line pen s = Svg.stroke pen [s]
    (lineFeeds, drawn) = once Set.empty feeds
    (lineRapids, _) = once drawn rapids

-- | Drops repeated segments, so that dashes are not drawn over dashes. A segment in the opposite
-- direction counts as a repetition. @known@ are the segments drawn before. The result has the
-- remaining segments, and @known@ with these added.
once :: Set Segment -> [Segment] -> ([Segment], Set Segment)
once known segments = case segments of
  [] -> ([], known)
  s : rest
    | Set.member key known -> once known rest
    | otherwise -> first (s :) (once (Set.insert key known) rest)
    where
      key = min s (Segment.reverse s)

-- | Toolpath of a cut with its arrows. A cut that is at most 12 mm long on paper has no arrows. A
-- longer cut has five along a contour; in a pocket it has one for every 40 mm, but at least five.
-- If the cutter's centre is on the contour, the toolpath is drawn between two thin lines.
cutLine :: Cut -> [Svg]
cutLine cut@Cut {isOnContour, numbered} =
  [Svg.stroke pen segments | isOnContour, pen <- [LineStyle.edgePen, LineStyle.bedPen]]
    <> (Svg.stroke LineStyle.pathPen segments : arrows)
  where
    segments = NonEmpty.toList (Scene.lines cut)
    whole = total (map Segment.length segments)
    arrows =
      if whole > Mm 12
        then
          mapMaybe
            ( \k ->
                arrowFrom
                  segments
                  (times ((2 * fromIntegral k - 1) / (2 * fromIntegral count)) whole)
            )
            [1 .. count]
        else []
    count = if numbered then 5 else max 5 (floor (over whole (Mm 40))) :: Int

-- | Arrow at @distance@ mm of paper from the start of a chain of segments. It is moved along the
-- segment on which it lies until it is at least 4 mm away from both ends of this segment. On a
-- segment shorter than 8 mm it is in the middle. Nothing if the distance is not less than the
-- length of the chain.
arrowFrom :: [Segment] -> Mm -> Maybe Svg
arrowFrom segments distance = case segments of
  [] -> Nothing
  s : rest
    | distance >= Segment.length s -> arrowFrom rest (minus distance (Segment.length s))
    | otherwise ->
      let margin = min 0.5 (over (Mm 4) (Segment.length s))
       in Just
            ( LineStyle.arrowAt
                LineStyle.blue
                (max margin (min (1 - margin) (over distance (Segment.length s))))
                s
            )

-- | Cutter, drawn at the point where a cut begins.
cutter :: Cut -> [Svg]
cutter cut@Cut {cutterRadius} =
  LineStyle.cutter cutterRadius (Segment.start (NonEmpty.head (Scene.lines cut)))

-- | Node numbers of the cuts, placed so that they cover no line.
numbers :: Scene -> [Svg]
numbers Scene {shapes, cuts, feeds, rapids, start} =
  [Svg.text style Centred p words' | (p, words') <- Label.place Page.field index labels]
  where
    style = TextStyle {size = Label.size, ink = LineStyle.blue, bold = False}
    labels =
      concatMap
        NodeLabel.labels
        (if length marked > NodeLabel.most then filter readable marked else marked)
    marked = filter numbered cuts
    -- Node numbers would hide a cut that is no larger than a digit.
    readable cut =
      let BoundingBox {left, bottom, right, top} =
            foldr1 BoundingBox.union (fmap BoundingBox.ofSegment (Scene.lines cut))
       in max (right - left) (top - bottom) > Label.size
    index =
      BoxTree.index BoundingBox.ofSegment (filter (\s -> Segment.length s > Mm 1e-6) lines')
    lines' =
      concatMap outline shapes
        <> concatMap cutLines cuts
        <> feeds
        <> rapids
        <> LineStyle.diamond start

-- | Segments of a cut, and of the cutter's symbol if it is drawn at the beginning of the cut.
-- Labels must not cover these segments.
cutLines :: Cut -> [Segment]
cutLines cut@Cut {cutterRadius, showsCutter} =
  (if showsCutter then rim : LineStyle.cross cutterRadius p else [])
    <> NonEmpty.toList (Scene.lines cut)
  where
    rim = Segment.fullCircle Clockwise circle (Vec.shift (Vec.vec cutterRadius 0) p)
    circle = Circle p (Mm cutterRadius)
    p = Segment.start (NonEmpty.head (Scene.lines cut))
