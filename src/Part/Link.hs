-- | The links between the elements of a contour, with evaluated numbers.
module Part.Link
  ( Link (..),
  )
where

import Base.Quantity (Mm)
import Geometry.Carrier (Sense)
import Geometry.Vec (Point)

-- | A link between an element and the element after it.
data Link
  = -- | at an intersection; of several, at the one nearest to the given point
    Meet (Maybe Point)
  | -- | at this point. It joins the elements of a contour that is itself an element of another one
    Fixed Point
  | -- | at a point where both have the same direction
    Smooth
  | -- | by the common tangent
    Tangent
  | -- | by an arc that is tangent to both: its sense and its radius
    Fillet Sense Mm
  | -- | by a straight segment: the length that it cuts off each element
    Chamfer Mm
  deriving stock (Eq, Show)
