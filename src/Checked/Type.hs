-- | The types of the part language.
module Checked.Type
  ( Type (..),
    number,
    len,
    angle,
    feed,
    aPoint,
    aVector,
    describe,
    isSquare,
    dimensions,
    variables,
  )
where

import Checked.Dimension (Atom (..), Dimension)
import Checked.Dimension qualified as Dimension
import Data.Text (Text)

-- | What a value is.
data Type
  = -- | a number with a dimension
    Quantity Dimension
  | -- | a pair of lengths: a point (place 1) or a vector (place 0)
    Spatial Dimension
  | Circle
  | Line
  | Contour
  | ListOf Type
  | -- | not yet known
    Variable Int
  | -- | the type of a thing that is already reported as wrong; agrees with everything
    Wrong
  deriving stock (Eq, Show)

number, len, angle, feed, aPoint, aVector :: Type
number = Quantity Dimension.none
len = Quantity (Dimension.atom Length)
angle = Quantity (Dimension.atom Angle)
feed = Quantity (Dimension.times (Dimension.atom Length) (Dimension.power (-1) (Dimension.atom Time)))
aPoint = Spatial (Dimension.atom Place)
aVector = Spatial Dimension.none

-- | In the words of a drawing, with its article.
describe :: Type -> Text
describe t = case t of
  Quantity d -> Dimension.describe d
  Spatial d
    | d == Dimension.atom Place -> "a point"
    | d == Dimension.none -> "a vector"
    | Dimension.isKnown d -> "a sum of points"
    | otherwise -> "a pair"
  Circle -> "a circle"
  Line -> "a line"
  Contour -> "a contour"
  ListOf _ -> "a list"
  Variable _ -> "a value"
  Wrong -> "a value"

-- | Whether it is known of a quantity only that it is a square.
isSquare :: Type -> Bool
isSquare t = case t of
  Quantity d -> Dimension.isUnknownSquare d
  _ -> False

-- | The unknown dimensions in a type.
dimensions :: Type -> [Int]
dimensions t = case t of
  Quantity d -> Dimension.unknowns d
  Spatial d -> Dimension.unknowns d
  ListOf inner -> dimensions inner
  Circle -> []
  Line -> []
  Contour -> []
  Variable _ -> []
  Wrong -> []

-- | The unknown types in a type.
variables :: Type -> [Int]
variables t = case t of
  Variable n -> [n]
  ListOf inner -> variables inner
  Quantity _ -> []
  Spatial _ -> []
  Circle -> []
  Line -> []
  Contour -> []
  Wrong -> []
