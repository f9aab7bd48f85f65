-- | The area of the half plane that a turning tool removes besides that of its nose.
--
-- x runs along the spindle, and y is the radius. The nose removes what is within its radius of its
-- path. The edge behind it removes what lies further on the side from which the tool comes: further
-- from the axis in an outside cut, nearer to the axis in a bore. It is counted with the width of
-- the nose.
module Part.TurnedArea
  ( OpenSide (..),
    areaBehind,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The side from which a tool comes, with a y beyond all stock on this side.
data OpenSide
  = -- | a larger y: an outside cut
    Above Mm
  | -- | a smaller y: a bore
    Below Mm
  deriving stock (Eq, Ord, Show)

-- | The corners of the area behind the nose, in order. It begins at the path of the nose's centre.
-- An arc counts by its end of the box that is nearer to the open side. The area is larger by
-- @growth@ towards the path and to both sides.
areaBehind :: Mm -> OpenSide -> Mm -> Segment -> [Point]
areaBehind (Mm growth) side (Mm radius) path = case side of
  Above (Mm end) -> corners (-growth) end
  Below (Mm end) -> corners growth end
  where
    out = radius + growth
    corners by end =
      [ Vec.point (x - out) (y + by),
        Vec.point x (y + by),
        Vec.point x' (y' + by),
        Vec.point (x' + out) (y' + by),
        Vec.point (x' + out) end,
        Vec.point (x - out) end
      ]
    (x, y, x', y') = case path of
      Straight a b
        | Vec.x a < Vec.x b -> (Vec.x a, Vec.y a, Vec.x b, Vec.y b)
        | Vec.x a > Vec.x b -> (Vec.x b, Vec.y b, Vec.x a, Vec.y a)
        | otherwise -> let z = furthest (Vec.y a) (Vec.y b) in (Vec.x a, z, Vec.x a, z)
      Arc {} ->
        let BoundingBox left low right high = BoundingBox.ofSegment path
            z = nearest low high
         in (left, z, right, z)
    -- The one of two heights that is further from the open side, and the one nearer to it.
    furthest a b = case side of
      Above _ -> min a b
      Below _ -> max a b
    nearest a b = case side of
      Above _ -> max a b
      Below _ -> min a b
