-- | Labels of a plot, placed so that they cover no line: the numbers of nodes, the depths of
-- descents, and the reasons of rest material.
module Draw.PlotLabel
  ( labels,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..))
import Data.Containers.ListUtils (nubOrdOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.Descent qualified as Descent
import Draw.DimensionLine qualified as DimensionLine
import Draw.Label (PointLabel (PointLabel))
import Draw.Label qualified as Label
import Draw.LineStyle (LineStyles (..))
import Draw.LineStyle qualified as LineStyle
import Draw.NodeLabel qualified as NodeLabel
import Draw.Page (Area (..), Page)
import Draw.Page qualified as Page
import Draw.PlotMove qualified as PlotMove
import Draw.Scene (Rest (..), Scene (..), Shape (outline))
import Draw.Scene qualified as Scene
import Draw.Svg (Anchor (..), Pen (..), Svg, TextStyle (..))
import Draw.Svg qualified as Svg
import Geometry.Carrier (Circle (Circle), Sense (..))
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | Labels of a scene in the field of a page.
labels :: LineStyles -> LengthUnit -> Page -> Scene -> [Svg]
labels styles unit page scene =
  concat [written p label | (p, label) <- Label.place (Page.field page) index wanted]
  where
    wanted = depths styles unit scene <> reasons styles scene <> nodeNumbers styles scene
    index =
      BoxTree.index
        BoundingBox.ofSegment
        (filter hasLength (obstacles (Page.field page) scene <> originSymbol))
    hasLength s = Segment.length s > Mm 1e-6
    originSymbol = LineStyle.diamond (Page.place page (Vec.point 0 0))
    written p PointLabel {Label.caption, Label.letters} =
      [ Svg.rectangle (Pen "none" 0 []) (background styles) (ground p (size letters) caption)
        | labelsHaveGround styles
      ]
        <> [Svg.text letters Centred p caption]
    ground p high caption =
      let w = Svg.textWidth high caption / 2
       in Area (Vec.x p - w) (Vec.y p - 0.45 * high) (Vec.x p + w) (Vec.y p + 0.45 * high)

-- | Segments in a field that labels must not cover.
obstacles :: Area -> Scene -> [Segment]
obstacles field scene =
  concatMap outline (shapes scene)
    <> concatMap (NonEmpty.toList . Scene.lines) (cuts scene)
    <> concat [rim r p : LineStyle.cross r p | (r, _, p) <- PlotMove.shownCutters (cuts scene)]
    <> concat [LineStyle.cross 0 (Descent.at d) | d <- descents scene]
    <> concat [LineStyle.cross 0 p | (p, _) <- tabs scene]
    <> feeds scene
    <> rapids scene
    <> PlotMove.centreMarks scene
    <> concatMap (DimensionLine.segments field) (dimensions scene)
    <> LineStyle.diamond (start scene)
  where
    rim r p = Segment.fullCircle Clockwise (Circle p (Mm r)) (Vec.shift (Vec.vec r 0) p)

-- | Numbers of nodes.
nodeNumbers :: LineStyles -> Scene -> [PointLabel]
nodeNumbers styles scene =
  concatMap (NodeLabel.labels styles) (NodeLabel.shown (cuts scene))

-- | Heights at the ends of descents, and of the tops of tabs.
depths :: LineStyles -> LengthUnit -> Scene -> [PointLabel]
depths styles unit scene =
  sparse
    [ PointLabel (heightText z) p (Vec.vec 0 (-1)) [2.2, 3.2, 4.5, 6, 8, 11] letters
      | (p, z) <- [(Descent.at d, Descent.bottom d) | d <- descents scene] <> tabs scene
    ]
  where
    letters = (LineStyle.lettering styles 2.5) {ink = linkingColour styles}
    heightText z = "z " <> Text.replace "-" "−" (Decimal.shortIn unit 3 z)

-- | Reasons of rest material, at its middle.
reasons :: LineStyles -> Scene -> [PointLabel]
reasons styles scene =
  sparse
    [ PointLabel (reason r) p (directionFrom (centre r) p) [1.5, 3, 5, 8, 12, 17] letters
      | r <- restMaterial scene,
        s : more <- [around r],
        let p = middleOf (foldl add (BoundingBox.ofSegment s) more)
    ]
  where
    add box s = BoundingBox.union box (BoundingBox.ofSegment s)
    letters = (LineStyle.lettering styles 2.5) {ink = reasonColour styles}
    middleOf BoundingBox {left, bottom, right, top} =
      Vec.point ((left + right) / 2) ((bottom + top) / 2)

-- | Unit vector from one point to another; to the upper edge of the paper if they are the same.
directionFrom :: Point -> Point -> Vec.Vec
directionFrom a b = if Vec.norm v > 1e-6 then Vec.unit v else Vec.vec 0 (-1)
  where
    v = Vec.to a b

-- | Labels without those that repeat another one close by, in the same square of 15 mm.
sparse :: [PointLabel] -> [PointLabel]
sparse = nubOrdOn square
  where
    square :: PointLabel -> (Text, Int, Int)
    square l = (Label.caption l, cell (Vec.x (Label.anchor l)), cell (Vec.y (Label.anchor l)))
    cell x = floor (x / 15)
