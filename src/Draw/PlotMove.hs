-- | Drawing of the moves of a toolpath: cuts, linking moves, descents, cutters and holes.
module Draw.PlotMove
  ( sweptAreas,
    sweptLeads,
    linkingMoves,
    cutLines,
    cutters,
    shownCutters,
    centreMarks,
    descentMarks,
  )
where

import Base.Quantity (Mm (..), over, times, total)
import Data.Bifunctor (first)
import Data.Containers.ListUtils (nubOrd, nubOrdOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Set (Set)
import Data.Set qualified as Set
import Draw.CutClass (CutClass (..))
import Draw.Descent qualified as Descent
import Draw.LineStyle (LineStyles (..))
import Draw.LineStyle qualified as LineStyle
import Draw.Scene (Cut (..), Scene (..))
import Draw.Scene qualified as Scene
import Draw.Svg (Pen, Svg)
import Draw.Svg qualified as Svg
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)

-- | Areas over which cutters sweep along cuts; one element for each radius.
sweptAreas :: LineStyles -> [Cut] -> [Svg]
sweptAreas styles cuts = sweptBy styles [(cutterRadius c, chain c) | c <- cuts]

-- | Areas over which cutters sweep in leads and ramps; one element for each radius.
sweptLeads :: LineStyles -> [(Double, Segment)] -> [Svg]
sweptLeads styles leads = sweptBy styles [(r, [s]) | (r, s) <- leads]

sweptBy :: LineStyles -> [(Double, [Segment])] -> [Svg]
sweptBy styles paths =
  [ Svg.swept (Svg.Pen (sweptColour styles) (2 * r) []) chains
    | (r, chains) <- Map.toList (Map.fromListWith (<>) [(r, [c]) | (r, c) <- reverse paths])
  ]

-- | Segments of a cut.
chain :: Cut -> [Segment]
chain = NonEmpty.toList . Scene.lines

-- | Lines of the linking moves. A segment that the cutter traverses in both directions is drawn
-- once, with an arrow for each direction.
linkingMoves :: LineStyles -> Scene -> [Svg]
linkingMoves styles Scene {feeds, rapids} =
  line (feedPen styles) lineFeeds <> line (rapidPen styles) lineRapids <> heads
  where
    heads = concatMap (LineStyle.arrowOn (linkingColour styles) 0.75) (feeds <> rapids)
    line pen segments = [Svg.strokes pen (map pure segments) | not (null segments)]
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

-- | Paths of the cuts in the line styles of their classes, and arrows. If the cutter's centre is on
-- the contour, the path is drawn between two thin lines. A single class has the pen of the path.
cutLines :: LineStyles -> [CutClass] -> [Cut] -> [Svg]
cutLines styles classes cuts =
  [ Svg.strokes pen (map chain onContours)
    | not (null onContours),
      pen <- [edgePen styles, bedPen styles]
  ]
    <> [Svg.strokes (penOf i) (chains c) | (i, c) <- zip [0 ..] classes]
    <> concatMap (arrows styles) cuts
  where
    onContours = filter isOnContour cuts
    penOf :: Int -> Pen
    penOf i = if isPlain then pathPen styles else LineStyle.classPen styles i
    isPlain = map caption classes == ["cutter path"]

-- | Arrows of a cut. A cut that is at most 12 mm long on paper has none. A longer cut has five
-- along a contour; in a pocket it has one for every 40 mm, but at least five.
arrows :: LineStyles -> Cut -> [Svg]
arrows styles cut
  | whole > Mm 12 =
    arrowsAt
      styles
      [ times ((2 * fromIntegral k - 1) / (2 * fromIntegral count)) whole
        | k <- [1 .. count]
      ]
      (chain cut)
  | otherwise = []
  where
    whole = total (map Segment.length (chain cut))
    count = if numbered cut then 5 else max 5 (floor (over whole (Mm 40))) :: Int

-- | Arrows at ascending distances in mm of paper from the start of a chain of segments. An arrow is
-- moved along the segment on which it lies until it is at least 4 mm away from both ends of this
-- segment. On a segment shorter than 8 mm it is in the middle.
arrowsAt :: LineStyles -> [Mm] -> [Segment] -> [Svg]
arrowsAt styles = go 0
  where
    go before distances segments = case (distances, segments) of
      (Mm d : more, s : rest)
        | d >= before + long -> go (before + long) distances rest
        | otherwise ->
          let margin = min 0.5 (4 / long)
              fraction = max margin (min (1 - margin) ((d - before) / long))
           in LineStyle.arrowAt (pathColour styles) fraction s : go before more segments
        where
          Mm long = Segment.length s
      _ -> []

-- | Cutters at the points where cuts begin.
cutters :: LineStyles -> [Cut] -> [Svg]
cutters styles cuts =
  [Svg.ring (holderPen styles) h p | (_, h, p) <- shown, h > 0]
    <> concat [LineStyle.cutter styles r p | (r, _, p) <- shown]
  where
    shown = shownCutters cuts

-- | Radii of the cutters that are drawn and of their holders, and their centres, each once. If
-- there are more than a few, only the first one of each radius is drawn.
shownCutters :: [Cut] -> [(Double, Double, Point)]
shownCutters cuts = if length every > few then nubOrdOn (\(r, h, _) -> (r, h)) every else every
  where
    every =
      nubOrd
        [ (cutterRadius c, holderRadius c, Segment.start (NonEmpty.head (Scene.lines c)))
          | c <- cuts,
            showsCutter c
        ]
    few = 6

-- | Lines that mark the centres of drilled holes. They would hide holes smaller than a dot.
centreMarks :: Scene -> [Segment]
centreMarks scene = concat [LineStyle.centreMark r p | (p, r) <- holes scene, r > 0.5]

-- | Symbols of descents.
descentMarks :: LineStyles -> Scene -> [Svg]
descentMarks styles scene =
  concat
    [LineStyle.descent styles (Descent.kind d) (Descent.at d) | d <- descents scene]
