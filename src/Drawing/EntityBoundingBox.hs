-- | The size of what entities draw.
module Drawing.EntityBoundingBox
  ( extent,
  )
where

import Base.Quantity (Mm (..))
import Data.List.NonEmpty qualified as NonEmpty
import Drawing.Drawing (Entity (shape), PathPart (EllipseArc), Shape (..))
import Drawing.PathPart qualified as PathPart
import Geometry.Carrier (Circle (Circle))
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox

-- | The width and the height in mm of the area that some entities take; 0 if there are none.
extent :: [Entity] -> (Mm, Mm)
extent entities = case concatMap (boxes . shape) entities of
  [] -> (Mm 0, Mm 0)
  b : more ->
    let BoundingBox left bottom right top = foldl BoundingBox.union b more
     in (Mm (right - left), Mm (top - bottom))
  where
    boxes s = case s of
      Path _ parts -> concatMap ofPart (NonEmpty.toList parts)
      FullCircle (Circle c r) -> [BoundingBox.inflate r (BoundingBox.ofPoints c [])]
      FullEllipse e -> ofPart (EllipseArc e 0 (2 * pi))
      Dot p -> [BoundingBox.ofPoints p []]
    ofPart = map BoundingBox.around . NonEmpty.toList . PathPart.segments
