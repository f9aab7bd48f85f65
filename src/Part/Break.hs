-- | Breaks of a contour: the slight corners at which the changes of distance of its pieces begin
-- and end.
--
-- On one of the two sides of a break a cutter does not reach the vertex. The material that it
-- leaves there is thin: with a cutter of 20 mm and a distance that changes by 1 mm over 20 mm,
-- 0.003 mm. The program asks for the change of distance, so this material is a part of what it asks
-- for, and a contour with such breaks is milled without @rest allowed@. Corners that are drawn, as
-- those of a polyline, are no breaks.
module Part.Break
  ( Break (..),
    breaksOf,
    leftMaterial,
    unreachedLength,
    isLeftAt,
    besideBreak,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus, times)
import Data.List (find)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Contour, Element)
import Part.Part qualified as Part

-- | Break of a contour.
data Break = Break
  { vertex :: Point,
    -- | element that ends at the vertex
    before :: Element,
    -- | change of direction, counter-clockwise
    turn :: Rad
  }
  deriving stock (Eq, Show)

-- | Breaks of a contour in the order of its elements.
breaksOf :: Contour -> [Break]
breaksOf contour
  | null (Part.breaks contour) = []
  | otherwise =
    [ Break {vertex, before, turn}
      | (before, after) <- zip es (drop 1 es <> [NonEmpty.head (Part.elements contour) | isClosed]),
        let vertex = Segment.end (Part.segment before),
        any (\p -> Vec.distance p vertex <= times 2 Tolerance.curve) (Part.breaks contour),
        let turn@(Rad a) =
              Vec.signedAngle
                (Segment.endDirection (Part.segment before))
                (Segment.startDirection (Part.segment after)),
        Rad (abs a) > Tolerance.smoothAngle
    ]
  where
    es = NonEmpty.toList (Part.elements contour)
    isClosed = Part.ends contour == Closed

-- | Thickness of the material between the vertex of a break and a cutter on its inner side. The
-- cutter's centre keeps the given distance from the contour.
leftMaterial :: Mm -> Break -> Mm
leftMaterial distance Break {turn = Rad a} = times (1 / cos (a / 2) - 1) distance

-- | Length of the contour on each side of a break that a cutter on its inner side does not touch,
-- if the contour is straight there.
unreachedLength :: Mm -> Break -> Mm
unreachedLength distance Break {turn = Rad a} = times (abs (tan (a / 2))) distance

-- | Break that alone keeps a cutter from the contour when the cutter's centre is at a point. The
-- material at its vertex is then not thicker than the break explains: up to twice
-- 'leftMaterial', because the contour may be curved.
isLeftAt :: Mm -> [Break] -> Point -> Maybe Break
isLeftAt distance breaks centre = find isHere breaks
  where
    isHere b =
      abs' (minus (Vec.distance (vertex b) centre) distance)
        <= plus (times 2 (leftMaterial distance b)) Tolerance.curve
    abs' (Mm d) = Mm (abs d)

-- | Test that a segment of the contour lies beside a break that turns towards a cutter on @side@,
-- so near that the cutter may not touch all of the segment.
besideBreak :: Side -> Mm -> [Break] -> Segment -> Bool
besideBreak side distance breaks segment = any isNear breaks
  where
    isNear b =
      let Rad a = turn b
       in Carrier.sideSign side * a > 0
            && Distance.toPoint (vertex b) segment <= times 2 (unreachedLength distance b)
