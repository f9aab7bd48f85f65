-- | The links between the elements of a contour, as data.
module Part.Link
  ( Link (..),
  )
where

import Base.Quantity (Mm)
import Geometry.Carrier (Sense)
import Geometry.Vec (Point)

-- | A link with its values.
data Link
  = -- | the intersection nearest to the point, if there is one
    Meet (Maybe Point)
  | -- | at this point, between the elements of a contour that is an element itself
    Fixed Point
  | Smooth
  | Tangent
  | -- | the sense and the radius of the arc
    Fillet Sense Mm
  | -- | the length that it cuts off each neighbour
    Chamfer Mm
  deriving stock (Eq, Show)
