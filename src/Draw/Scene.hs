-- | Objects of a drawing: contours, cuts, linking moves and rest material. A cut is a part of the
-- toolpath that removes material; linking moves are all other moves. Rest material is material that
-- the cutter cannot reach. An outline is the chain of segments along a contour or a drilled hole,
-- or around an area of rest material.
--
-- A scene is first in mm of the part, and is then placed on a page, in mm of paper.
module Draw.Scene
  ( Scene (..),
    Shape (..),
    MaterialSide (..),
    Cut (..),
    Rest (..),
    lines,
    onPage,
  )
where

import Base.Quantity (Mm (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.Semigroup (sconcat)
import Data.Text (Text)
import Draw.Descent (Descent)
import Draw.Descent qualified as Descent
import Draw.DimensionLine (DimensionLine)
import Draw.DimensionLine qualified as DimensionLine
import Draw.Page (Page)
import Draw.Page qualified as Page
import Draw.StockPlot (StockPlot)
import Draw.StockPlot qualified as StockPlot
import Draw.ToolUse (ToolUse)
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment)
import Geometry.Vec (Point)
import Part.CutFeed (CutFeed)
import Prelude hiding (lines)

-- | All objects of a drawing.
data Scene = Scene
  { -- | contours and drilled holes
    shapes :: [Shape],
    -- | centres and radii of drilled holes
    holes :: [(Point, Double)],
    -- | moves that cut
    cuts :: [Cut],
    -- | moves at feed that are no cuts, but not above the highest cut either, such as leads and
    -- ramps; each with the radius of its cutter
    leads :: [(Double, Segment)],
    restMaterial :: [Rest],
    -- | linking moves at feed
    feeds :: [Segment],
    -- | linking moves that are rapid moves
    rapids :: [Segment],
    -- | points at which the tool has gone down into the material
    descents :: [Descent],
    -- | tabs: the position of the cutter's centre in the middle, and the height of the top in mm of
    -- the part
    tabs :: [(Point, Mm)],
    -- | sizes that the program asserts
    dimensions :: [DimensionLine],
    -- | starting position of the cutter
    start :: Point,
    -- | a point on the axis of the spindle, which is horizontal; Nothing for a milled part
    spindleAxis :: Maybe Point,
    -- | tools that cut, in the order of their use
    tools :: [ToolUse],
    stock :: StockPlot
  }

-- | Contour of the part, or circle of a drilled hole.
data Shape = Shape {ends :: Ends, materialSide :: MaterialSide, outline :: [Segment]}

-- | Side of a contour on which the material of the part lies.
data MaterialSide
  = -- | inside the contour
    Inside
  | -- | outside the contour
    Outside
  | -- | not known, because the contour is open or no cutter moves beside it
    Unknown
  deriving stock (Eq, Ord)

-- | Toolpath of one cut: one pass along a contour, or the moves in a pocket from one plunge to the
-- next lift.
data Cut = Cut
  { -- | parts of the cut in order, each of them one line, one arc, or all arcs of one curve. The
    -- ends of the parts are the nodes
    sections :: NonEmpty (NonEmpty Segment),
    -- | the same segments, grouped by their feeds
    feedRuns :: [(CutFeed, [Segment])],
    -- | height of the pass, in mm of the part
    height :: Mm,
    -- | position of the tool in 'tools'
    tool :: Maybe Int,
    cutterRadius :: Double,
    -- | radius of the tool's holder, where it is widest; 0 without a holder
    holderRadius :: Double,
    -- | side of the path on paper that faces away from the contour: +1 for its right, -1 for its
    -- left. It is a factor for 'Vec.left', which points to the right on paper, because y points
    -- down there
    away :: Double,
    -- | True if the cutter's centre is on the contour
    isOnContour :: Bool,
    -- | True if the nodes have numbers: in the last pass of a milling statement, but not in a
    -- pocket
    numbered :: Bool,
    -- | True if the cutter is drawn where the cut begins; in a pocket only for the first cut of a
    -- pass
    showsCutter :: Bool
  }

-- | Rest material: its outline, the position of the cutter's centre before it, and the reason why
-- the cutter does not reach it.
data Rest = Rest {around :: [Segment], centre :: Point, reason :: Text}

-- | All segments of a cut.
lines :: Cut -> NonEmpty Segment
lines = sconcat . sections

-- | Places a scene on a page: converts mm of the part to mm of paper.
onPage :: Page -> Scene -> Scene
onPage page scene =
  scene
    { shapes = [s {outline = map segment (outline s)} | s <- shapes scene],
      holes = [(point p, length' r) | (p, r) <- holes scene],
      cuts = map cut (cuts scene),
      leads = [(length' r, segment s) | (r, s) <- leads scene],
      restMaterial =
        [ r {around = map segment (around r), centre = point (centre r)}
          | r <- restMaterial scene
        ],
      feeds = map segment (feeds scene),
      rapids = map segment (rapids scene),
      descents = [d {Descent.at = point (Descent.at d)} | d <- descents scene],
      tabs = [(point p, top) | (p, top) <- tabs scene],
      dimensions = map (DimensionLine.onPage page) (dimensions scene),
      start = point (start scene),
      spindleAxis = point <$> spindleAxis scene,
      stock = StockPlot.onPage page (stock scene)
    }
  where
    segment = Page.segment page
    point = Page.place page
    length' = Page.onPaper page . Mm
    cut c =
      c
        { sections = fmap (fmap segment) (sections c),
          feedRuns = [(f, map segment ss) | (f, ss) <- feedRuns c],
          cutterRadius = length' (cutterRadius c),
          holderRadius = length' (holderRadius c)
        }
