-- | Placement of labels beside points, so that the labels cover neither lines nor each other. The
-- search is greedy: each label takes the first of its candidate positions that is free. A bounding
-- box is the rectangle of a label on the paper, with the coordinates of its sides in mm.
module Draw.Label
  ( PointLabel (..),
    size,
    place,
  )
where

import Base.Quantity (Mm (..), Rad, radians)
import Data.List (find, foldl')
import Data.List qualified as List
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes)
import Data.Text (Text)
import Draw.Page (Area, holds)
import Draw.Svg (TextStyle)
import Draw.Svg qualified as Draw
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | Label to be placed beside a point.
data PointLabel = PointLabel
  { caption :: Text,
    -- | the point, in mm of paper
    anchor :: Point,
    -- | preferred direction from the point to the label; a unit vector
    outward :: Vec,
    -- | allowed distances from the point to the edge of the label in mm, the preferred one first
    distances :: [Double],
    letters :: TextStyle
  }
  deriving stock (Eq, Show)

-- | Letter size of the numbers of nodes in mm, as the font size of SVG.
size :: Double
size = 3

-- | Placed labels, each with its centre in mm of paper. Labels are placed in @area@, in the given
-- order, so that they do not cover the segments @drawn@. A label without a free position is left
-- out.
place :: Area -> BoxTree Segment -> [PointLabel] -> [(Point, PointLabel)]
place area drawn = catMaybes . snd . List.mapAccumL next Map.empty
  where
    next taken label = case find (free area drawn taken) (candidates label) of
      Just box -> (occupied box taken, Just (middleOf box, label))
      Nothing -> (taken, Nothing)

-- | Centre of a bounding box.
middleOf :: BoundingBox -> Point
middleOf BoundingBox {left, bottom, right, top} =
  Vec.point ((left + right) / 2) ((bottom + top) / 2)

-- | Bounding boxes of the labels placed so far, by the squares of a grid. Each box is listed under
-- all 'squares' that it touches. A new label is compared only with the boxes under its own squares.
type Taken = Map (Int, Int) [BoundingBox]

-- | Adds the bounding box of a label to those of the placed labels.
occupied :: BoundingBox -> Taken -> Taken
occupied box taken =
  foldl' (\known square -> Map.insertWith (<>) square [box] known) taken (squares box)

-- | Column and row, counted from the upper left corner of the paper, of the grid squares that a
-- bounding box touches. The squares are 10 mm wide and high.
squares :: BoundingBox -> [(Int, Int)]
squares BoundingBox {left, bottom, right, top} =
  [(i, j) | i <- [at left .. at right], j <- [at bottom .. at top]]
  where
    at x = floor (x / 10)

-- | Bounding boxes of a label at its candidate positions, the preferred one first.
candidates :: PointLabel -> [BoundingBox]
candidates PointLabel {caption, anchor, outward, distances, letters} =
  [at d a | d <- distances, a <- angles]
  where
    -- Half the height and half the width of the label. The height of a digit is 0.72 of the letter
    -- size.
    high = 0.36 * Draw.size letters
    wide = max high (Draw.textWidth (Draw.size letters) caption / 2)
    at distance angle =
      let direction = Vec.rotate angle outward
          -- Distance from the centre of the label to its edge, along the direction to the point.
          inside =
            min
              (wide / max 1e-9 (abs (Vec.dot direction (Vec.vec 1 0))))
              (high / max 1e-9 (abs (Vec.dot direction (Vec.vec 0 1))))
          p = Vec.shift (Vec.scale (distance + inside) direction) anchor
       in BoundingBox (Vec.x p - wide) (Vec.y p - high) (Vec.x p + wide) (Vec.y p + high)

-- | Angles from the preferred direction of a label to the directions that are tried, in this order.
angles :: [Rad]
angles = map radians [0, 30, -30, 60, -60, 90, -90, 180, 150, -150]

-- | True if a label may have the bounding box @box@. The box must lie in the area, more than 0.6 mm
-- away from the boxes in @taken@. The text is the box with rounded ends; it must be more than
-- 0.5 mm away from every segment.
free :: Area -> BoxTree Segment -> Taken -> BoundingBox -> Bool
free area drawn taken box@BoundingBox {left, bottom, right, top} =
  all (holds area) [Vec.point left bottom, Vec.point right top]
    && not
      ( any
          (BoundingBox.meets around)
          (concatMap (\square -> Map.findWithDefault [] square taken) (squares around))
      )
    && all clear (BoxTree.within around drawn)
  where
    around = BoundingBox.inflate (Mm 0.6) box
    half = (top - bottom) / 2
    y = (bottom + top) / 2
    -- For its distance from a segment, the text counts as a thick line with round ends, which is as
    -- long and as high as the box.
    middle = Straight (Vec.point (left + half / 2) y) (Vec.point (right - half / 2) y)
    clear s = let ClosestPoint (Mm d) _ = Distance.segments middle s in d > half + 0.5
