-- | Labels beside points, where they cover neither lines nor one another.
module Draw.Label
  ( Label (..),
    size,
    settle,
  )
where

import Base.Quantity (Mm (..), Rad, radians)
import Data.List (find)
import Data.Text (Text)
import Draw.Sheet (Area, holds)
import Draw.Svg qualified as Draw
import Geometry.Box (Box (..))
import Geometry.Box qualified as Box
import Geometry.Distance (Nearest (..))
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | A text for a point, the direction in which it had best stand, of length 1, and how many mm it may
-- be off, the best first.
data Label = Label {caption :: Text, anchor :: Point, outward :: Vec, distances :: [Double]}
  deriving stock (Eq, Show)

-- | The size of the letters in mm.
size :: Double
size = 3

-- | The middles of the labels, in order, in an area and clear of lines. A label for which there is
-- no room is left out.
settle :: Area -> Box.Index Segment -> [Label] -> [(Point, Text)]
settle area drawn labels = reverse (foldl next [] labels)
  where
    next settled label = case find (free area drawn settled (caption label)) (candidates label) of
      Just p -> (p, caption label) : settled
      Nothing -> settled

-- | Places near the point, the best first.
candidates :: Label -> [Point]
candidates Label {caption, anchor, outward, distances} = [at d a | d <- distances, a <- angles]
  where
    at distance angle =
      let direction = Vec.rotate angle outward
          -- From the middle of the text to its edge, as far as the direction goes across it.
          Box {right, top} = frame caption (Vec.point 0 0)
          inside = min (right / max 1e-9 (abs (Vec.dot direction (Vec.vec 1 0)))) (top / max 1e-9 (abs (Vec.dot direction (Vec.vec 0 1))))
       in Vec.shift (Vec.scale (distance + inside) direction) anchor

angles :: [Rad]
angles = map radians [0, 30, -30, 60, -60, 90, -90, 180, 150, -150]

free :: Area -> Box.Index Segment -> [(Point, Text)] -> Text -> Point -> Bool
free area drawn settled caption p =
  all (holds area) [Vec.point left bottom, Vec.point right top]
    && not (any (\(q, w) -> Box.meets (Box.inflate (Mm 0.6) box) (frame w q)) settled)
    && all clear (Box.within (Box.inflate (Mm 0.6) box) drawn)
  where
    box@Box {left, bottom, right, top} = frame caption p
    half = (top - bottom) / 2
    -- A text is a horizontal line as thick as its letters are high.
    middle = Straight (Vec.point (left + half / 2) (Vec.y p)) (Vec.point (right - half / 2) (Vec.y p))
    clear s = let Nearest (Mm d) _ = Distance.segments middle s in d > half + 0.5

-- | What a text covers about its middle: figures are 0.72 of their size high.
frame :: Text -> Point -> Box
frame caption p = Box (Vec.x p - w) (Vec.y p - h) (Vec.x p + w) (Vec.y p + h)
  where
    w = max h (Draw.textWidth size caption / 2)
    h = 0.36 * size
