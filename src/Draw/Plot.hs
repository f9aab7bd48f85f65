-- | The picture of a part and of the cutter's path: one A4 page at a standard scale, made to be
-- printed. Widths of lines and sizes of letters are mm of paper at every scale, and kinds of lines
-- differ in black and white too.
module Draw.Plot
  ( plot,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), minus, over, times, total)
import Data.Bifunctor (first)
import Data.List (sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Draw.Label qualified as Label
import Draw.Node qualified as Node
import Draw.Scene (Cut (..), Matter (..), Scene (..), Shape (..))
import Draw.Scene qualified as Scene
import Draw.Sheet (Area (..), Sheet)
import Draw.Sheet qualified as Sheet
import Draw.Sign qualified as Sign
import Draw.Svg (Anchor (..), Pen (..), Style (..), Svg)
import Draw.Svg qualified as Svg
import Draw.Title qualified as Title
import Geometry.Box (Box (..))
import Geometry.Box qualified as Box
import Geometry.Contour (Ends (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Shape (Circle (..), Turn (..))
import Geometry.Vec qualified as Vec
import Geometry.Winding qualified as Winding
import Part.Part (Part)
import Path.Path (Path)

-- | Draw a part and the path of the cutter as an SVG document.
plot :: Part -> Path -> Text
plot part path =
  Svg.document
    Sheet.page
    (Title.name part)
    ( [ Svg.layer "page" [Svg.rectangle (Pen "none" 0 []) "white" Sheet.page],
        Svg.layer "material" (material (shapes scene)),
        Svg.layer "axes" (axes (sheet scene))
      ]
        <> [Svg.layer "rests" (map (Svg.area Sign.restColour) (rests scene)) | not (null (rests scene))]
        <> [ Svg.layer "contours" (map contourLine (shapes scene)),
             Svg.layer "ways" (ways scene),
             Svg.layer "path" (concatMap cutLine (cuts scene)),
             Svg.layer "start" (Sign.start (start scene) <> originMark (sheet scene)),
             Svg.layer "cutters" (concatMap cutter (filter entered (cuts scene))),
             Svg.layer "nodes" (concatMap Node.dots (filter numbered (cuts scene))),
             Svg.layer "numbers" (numbers scene),
             Svg.layer "title" (Title.block part scene)
           ]
    )
  where
    scene = Scene.set part path

-- The part

-- | Material in grey, what lies in something else on top of it. Where nothing bounds it outwards, a band of it runs around every window.
material :: [Shape] -> [Svg]
material shapes = bands <> map snd (sortOn fst (map painted bodies <> map painted windows))
  where
    bodies = filter (\s -> matter s == Within) shapes
    windows = filter (\s -> matter s == Beyond) shapes
    bands = [Svg.loop (Pen Sign.matterColour 6 []) (outline s) | all ((> 0) . inWindows) bodies, s <- windows]
    painted s = (level s, Svg.area (if matter s == Within then Sign.matterColour else "white") (outline s))
    -- What stands in a window is drawn above it, and a window in that above that.
    level s = 2 * inWindows s + (if matter s == Within then 0 else 1)
    inWindows s = let p = beginning s in length [w | w <- Box.within (Box.ofPoints p []) index, outline w /= outline s, Winding.about p (outline w) /= 0]
    index = Box.index (\w -> foldr (Box.union . Box.ofSegment) (Box.ofPoints (beginning w) []) (outline w)) windows
    beginning s = case outline s of
      s' : _ -> Segment.start s'
      [] -> Vec.point 0 0

contourLine :: Shape -> Svg
contourLine Shape {ends, outline} = case ends of
  Open -> Svg.stroke Sign.contourPen outline
  Closed -> Svg.loop Sign.contourPen outline

-- | Thin axes through the origin; where it is off the page, a mark at a point with round coordinates.
axes :: Sheet -> [Svg]
axes sheet
  | Sheet.holds Sheet.field origin =
    [ Svg.stroke Sign.axisPen [Straight (Vec.point (leftmost Sheet.field) oy) (Vec.point right oy)],
      Svg.stroke Sign.axisPen [Straight (Vec.point ox (lower Sheet.field)) (Vec.point ox top)]
    ]
      <> heads ox oy right top
  | otherwise =
    [ Svg.stroke Sign.axisPen [Straight mark (Vec.point (mx + 12) my)],
      Svg.stroke Sign.axisPen [Straight mark (Vec.point mx (my - 12))],
      Svg.text Sign.small Start (Vec.point (mx + 1) (my + 3.2)) ("(" <> Decimal.short 4 cx <> ", " <> Decimal.short 4 cy <> ")")
    ]
      <> heads mx my (mx + 12) (my - 12)
  where
    origin = Sheet.place sheet (Vec.point 0 0)
    (ox, oy) = (Vec.x origin, Vec.y origin)
    (right, top) = (rightmost Sheet.field - 3, upper Sheet.field + 3)
    corner = Sheet.unplace sheet (Vec.point (leftmost Sheet.field + 3) (lower Sheet.field - 5))
    grid = gridOf sheet
    (cx, cy) = (up (Vec.x corner), up (Vec.y corner))
    up c = grid * fromIntegral (ceiling (c / grid) :: Integer)
    mark = Sheet.place sheet (Vec.point cx cy)
    (mx, my) = (Vec.x mark, Vec.y mark)

-- | The mark of the origin, if that is on the page.
originMark :: Sheet -> [Svg]
originMark sheet = concatMap Sign.origin (filter (Sheet.holds Sheet.field) [Sheet.place sheet (Vec.point 0 0)])

-- | The heads of the axes through a point, and their names.
heads :: Double -> Double -> Double -> Double -> [Svg]
heads px py right top =
  [ Sign.axisArrow (Vec.vec 1 0) (Vec.point right py),
    Sign.axisArrow (Vec.vec 0 (-1)) (Vec.point px top),
    Svg.text Sign.small Centred (Vec.point (right - 1) (py - 2.4)) "x",
    Svg.text Sign.small Centred (Vec.point (px + 2.4) (top + 1)) "y"
  ]

-- | A round length of 4 to 8 mm on paper.
gridOf :: Sheet -> Double
gridOf sheet = Sheet.round125 (8 / Sheet.onPaper sheet (Mm 1))

-- The path

-- | The ways between the cuts. A way back on the same line is drawn once, with arrows for both.
ways :: Scene -> [Svg]
ways Scene {feeds, rapids} = map (line Sign.feedPen) lineFeeds <> map (line Sign.rapidPen) lineRapids <> arrows
  where
    arrows = concatMap (Sign.arrowOn Sign.red 0.75) (feeds <> rapids)
    line pen s = Svg.stroke pen [s]
    (lineFeeds, drawn) = once Set.empty feeds
    (lineRapids, _) = once drawn rapids

-- | Segments that, either way round, are neither among known ones nor earlier among themselves; and all that are known then.
once :: Set Segment -> [Segment] -> ([Segment], Set Segment)
once known segments = case segments of
  [] -> ([], known)
  s : rest
    | Set.member key known -> once known rest
    | otherwise -> first (s :) (once (Set.insert key known) rest)
    where
      key = min s (Segment.reverse s)

-- | The way along a contour, with five arrows, or in a pocket, with more on a long one. On the contour itself it runs between two thin lines.
cutLine :: Cut -> [Svg]
cutLine cut@Cut {upon, numbered} = [Svg.stroke pen segments | upon, pen <- [Sign.edgePen, Sign.bedPen]] <> (Svg.stroke Sign.pathPen segments : arrows)
  where
    segments = NonEmpty.toList (Scene.lines cut)
    whole = total (map Segment.length segments)
    arrows = if whole > Mm 12 then mapMaybe (\k -> arrowFrom segments (times ((2 * fromIntegral k - 1) / (2 * fromIntegral count)) whole)) [1 .. count] else []
    count = if numbered then 5 else max 5 (floor (over whole (Mm 40))) :: Int

-- | An arrow at a distance along segments, clear of the nodes where the segment is long enough.
arrowFrom :: [Segment] -> Mm -> Maybe Svg
arrowFrom segments distance = case segments of
  [] -> Nothing
  s : rest
    | distance >= Segment.length s -> arrowFrom rest (minus distance (Segment.length s))
    | otherwise ->
      let margin = min 0.5 (over (Mm 4) (Segment.length s))
       in Just (Sign.arrowAt Sign.blue (max margin (min (1 - margin) (over distance (Segment.length s)))) s)

-- | The cutter where it begins to cut.
cutter :: Cut -> [Svg]
cutter cut@Cut {reach} = Sign.cutter reach (Segment.start (NonEmpty.head (Scene.lines cut)))

-- | The numbers of all nodes, clear of the lines.
numbers :: Scene -> [Svg]
numbers Scene {shapes, cuts, feeds, rapids, start} = [Svg.text style Centred p words' | (p, words') <- Label.settle Sheet.field index labels]
  where
    style = Style {size = Label.size, ink = Sign.blue, bold = False}
    labels = concatMap Node.labels (if length marked > Node.most then filter readable marked else marked)
    marked = filter numbered cuts
    -- Of many ways only those have numbers that are larger than these.
    readable cut = let Box {left, bottom, right, top} = foldr1 Box.union (fmap Box.ofSegment (Scene.lines cut)) in max (right - left) (top - bottom) > Label.size
    index = Box.index Box.ofSegment (filter (\s -> Segment.length s > Mm 1e-6) lines')
    lines' = concatMap outline shapes <> concatMap cutLines cuts <> feeds <> rapids <> Sign.diamond start

-- | The way of a cutter, and the cutter itself.
cutLines :: Cut -> [Segment]
cutLines cut@Cut {reach, entered} = (if entered then rim : Sign.cross reach p else []) <> NonEmpty.toList (Scene.lines cut)
  where
    rim = Segment.fullCircle Clockwise (Circle p (Mm reach)) (Vec.shift (Vec.vec reach 0) p)
    p = Segment.start (NonEmpty.head (Scene.lines cut))
