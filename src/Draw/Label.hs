-- | Labels beside points, where they cover neither lines nor one another.
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

-- | A text for a point, the direction in which it had best stand, of length 1, and how many mm it
-- may be off, the best first.
data PointLabel = PointLabel
  { caption :: Text,
    anchor :: Point,
    outward :: Vec,
    distances :: [Double]
  }
  deriving stock (Eq, Show)

-- | The size of the letters in mm.
size :: Double
size = 3

-- | The middles of the labels, in order, in an area and clear of lines. A label for which there is
-- no room is left out.
settle :: Area -> BoxTree Segment -> [PointLabel] -> [(Point, Text)]
settle area drawn = catMaybes . snd . List.mapAccumL next Map.empty
  where
    next taken label = case find (free area drawn taken) (candidates label) of
      Just box -> (settled box taken, Just (middleOf box, caption label))
      Nothing -> (taken, Nothing)

-- | The middle of a box.
middleOf :: BoundingBox -> Point
middleOf BoundingBox {left, bottom, right, top} =
  Vec.point ((left + right) / 2) ((bottom + top) / 2)

-- | What labels cover, by the squares in which some of it lies.
type Taken = Map (Int, Int) [BoundingBox]

settled :: BoundingBox -> Taken -> Taken
settled box taken =
  foldl' (\known square -> Map.insertWith (<>) square [box] known) taken (squares box)

-- | The squares of paper, 10 mm wide, in which some of a box lies.
squares :: BoundingBox -> [(Int, Int)]
squares BoundingBox {left, bottom, right, top} =
  [(i, j) | i <- [at left .. at right], j <- [at bottom .. at top]]
  where
    at x = floor (x / 10)

-- | What the label covers at places near its point, the best first.
candidates :: PointLabel -> [BoundingBox]
candidates PointLabel {caption, anchor, outward, distances} = [at d a | d <- distances, a <- angles]
  where
    -- Figures are 0.72 of their size high.
    high = 0.36 * size
    wide = max high (Draw.textWidth size caption / 2)
    at distance angle =
      let direction = Vec.rotate angle outward
          -- From the middle of the text to its edge, as far as the direction goes across it.
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
    -- A text is a horizontal line as thick as its letters are high.
    middle = Straight (Vec.point (left + half / 2) y) (Vec.point (right - half / 2) y)
    clear s = let ClosestPoint (Mm d) _ = Distance.segments middle s in d > half + 0.5
