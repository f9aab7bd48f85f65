-- | Placement of labels beside points, clear of lines and of each other. The search is greedy:
-- each label takes the first of its candidate positions that is free.
module Draw.Label
  ( PointLabel (..),
    size,
    settle,
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

-- | Label of a point: its text, the preferred direction from the point (a unit vector), and the
-- allowed distances from the point in mm, the preferred one first.
data PointLabel = PointLabel
  { caption :: Text,
    anchor :: Point,
    outward :: Vec,
    distances :: [Double]
  }
  deriving stock (Eq, Show)

-- | Size of the letters in mm.
size :: Double
size = 3

-- | Places labels in an area, clear of segments, in the order given. The result has the centre of
-- each label. A label without a free position is left out.
settle :: Area -> BoxTree Segment -> [PointLabel] -> [(Point, Text)]
settle area drawn = catMaybes . snd . List.mapAccumL next Map.empty
  where
    next taken label = case find (free area drawn taken) (candidates label) of
      Just box -> (settled box taken, Just (middleOf box, caption label))
      Nothing -> (taken, Nothing)

-- | Centre of a box.
middleOf :: BoundingBox -> Point
middleOf BoundingBox {left, bottom, right, top} =
  Vec.point ((left + right) / 2) ((bottom + top) / 2)

-- | Boxes of placed labels, by the squares of the paper that they touch.
type Taken = Map (Int, Int) [BoundingBox]

settled :: BoundingBox -> Taken -> Taken
settled box taken =
  foldl' (\known square -> Map.insertWith (<>) square [box] known) taken (squares box)

-- | Squares of paper, 10 mm wide, that a box touches.
squares :: BoundingBox -> [(Int, Int)]
squares BoundingBox {left, bottom, right, top} =
  [(i, j) | i <- [at left .. at right], j <- [at bottom .. at top]]
  where
    at x = floor (x / 10)

-- | Boxes of a label at its candidate positions, the preferred one first.
candidates :: PointLabel -> [BoundingBox]
candidates PointLabel {caption, anchor, outward, distances} = [at d a | d <- distances, a <- angles]
  where
    -- The height of digits is 0.72 of their size.
    high = 0.36 * size
    wide = max high (Draw.textWidth size caption / 2)
    at distance angle =
      let direction = Vec.rotate angle outward
          -- Distance from the centre of the text to its edge in the label's direction.
          inside =
            min
              (wide / max 1e-9 (abs (Vec.dot direction (Vec.vec 1 0))))
              (high / max 1e-9 (abs (Vec.dot direction (Vec.vec 0 1))))
          p = Vec.shift (Vec.scale (distance + inside) direction) anchor
       in BoundingBox (Vec.x p - wide) (Vec.y p - high) (Vec.x p + wide) (Vec.y p + high)

angles :: [Rad]
angles = map radians [0, 30, -30, 60, -60, 90, -90, 180, 150, -150]

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
    -- For the test against lines, a text is a horizontal line as thick as its letters are high.
    middle = Straight (Vec.point (left + half / 2) y) (Vec.point (right - half / 2) y)
    clear s = let ClosestPoint (Mm d) _ = Distance.segments middle s in d > half + 0.5
