-- | Evaluates the places of texts with outlines. "Surface.TextPlace" has the names of the point and
-- the vectors of such a place.
module Part.TextPlace
  ( TextPlace (..),
    vectors,
    bound,
  )
where

import Base.Name (Name)
import Base.Quantity (Mm (..), Rad (..), over)
import Checked.Syntax (Expr)
import Data.Map.Strict qualified as Map
import Geometry.Vec (Vec)
import Geometry.Vec qualified as Vec
import Part.Evaluation (Eval)
import Part.Expression (Environment (..))
import Part.Expression qualified as Expression
import Part.Measure (lengthOf)
import Part.Parameter qualified as Parameter
import Part.Value (Value (Spatial))
import Surface.TextPlace qualified as Surface

-- | The place of a text: the point to which it is aligned, as the vector from (0, 0), the vector
-- along its line, and the vector from its feet to its heads. Both belong to 1 mm of the text before
-- it is scaled.
data TextPlace = TextPlace {origin :: Vec, along :: Vec, upward :: Vec}
  deriving stock (Eq, Show)

-- | Evaluates the point of a text, the height of its capitals, and its direction, which is along x
-- if it is 'Nothing'.
vectors :: Environment -> Expr -> Expr -> Maybe Expr -> Eval TextPlace
vectors env point height direction = do
  size <- lengthOf env Parameter.TextHeight height
  anchor <- Expression.point <$> Expression.evaluate env point
  turned <- maybe (pure 0) (fmap Expression.number . Expression.evaluate env) direction
  let scale = over size Surface.capitals
      unit a = Vec.rotate (Rad turned) a
  pure
    TextPlace
      { origin = Vec.to (Vec.point 0 0) anchor,
        along = unit (Vec.vec scale 0),
        upward = unit (Vec.vec 0 scale)
      }

-- | The environment with the point and the vectors of a text, whose region has the given name.
bound :: Name -> TextPlace -> Environment -> Environment
bound name place env =
  env
    { values = Map.union (Map.fromList found) (values env),
      locals = foldr (Map.delete . fst) (locals env) found
    }
  where
    found =
      [ (Surface.origin name, Spatial (origin place)),
        (Surface.along name, Spatial (along place)),
        (Surface.upward name, Spatial (upward place))
      ]
