-- | The links between the elements of a contour, with evaluated numbers.
module Part.Link
  ( Link (..),
  )
where

import Base.Quantity (Mm)
import Geometry.Carrier (Sense)
import Geometry.Vec (Point)

-- | A link between an element of a contour and the element after it.
data Link
  = -- | at an intersection of the two elements: at the one nearest to the given point if there are
    -- several. 'Nothing' if the program gives no point
    Meet (Maybe Point)
  | -- | at this point. If an open contour is used as an element of another contour, such links join
    -- its lines, arcs and curves to one another
    Fixed Point
  | -- | at a point where both elements have the same direction
    Smooth
  | -- | by a straight segment that is tangent to both elements, which are circles or points
    Tangent
  | -- | by an arc that is tangent to both elements: the sense and the radius of the arc
    Fillet Sense Mm
  | -- | by a straight segment that cuts off the corner: the length that it takes off each element
    Chamfer Mm
  deriving stock (Eq, Show)
