-- | The types of the part language.
module Checked.Type
  ( Type (..),
    number,
    len,
    angle,
    feed,
    spindleSpeed,
    aPoint,
    aVector,
    ofUnit,
    describe,
    isSquare,
    dimensions,
    dimensionOf,
    variables,
    components,
    substitute,
  )
where

import Checked.Dimension (Atom (..), Dimension)
import Checked.Dimension qualified as Dimension
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Token (Unit (..))

-- | The type of a value.
data Type
  = -- | a number with a dimension
    Quantity Dimension
  | -- | a pair of lengths. The power of 'PointWeight' is 1 for a point and 0 for a vector
    Spatial Dimension
  | Circle
  | Line
  | Contour
  | -- | true or false
    Boolean
  | -- | a point with a height
    SpacePoint
  | -- | a transformation of the plane
    Transformation
  | ListOf Type
  | -- | a table, by the 'Fields' of its columns
    Table Type
  | -- | a curve, by the 'Fields' of the table through which it passes
    Curve Type
  | -- | the columns besides x and y, with their names
    Fields [(Text, Type)]
  | -- | an unknown of type inference, by its number
    Variable Int
  | -- | the type of a term that is already reported as wrong; it agrees with every type
    Wrong
  deriving stock (Eq, Show)

-- | A number without a dimension.
number :: Type
number = Quantity Dimension.none

-- | A length, in mm after checking.
len :: Type
len = Quantity (Dimension.atom Length)

-- | An angle, in radians after checking.
angle :: Type
angle = Quantity (Dimension.atom Angle)

-- | A feed, in mm/min after checking.
feed :: Type
feed =
  Quantity (Dimension.times (Dimension.atom Length) (Dimension.power (-1) (Dimension.atom Time)))

-- | A spindle speed, in revolutions per minute.
spindleSpeed :: Type
spindleSpeed = Quantity (Dimension.power (-1) (Dimension.atom Time))

-- | A point of the plane.
aPoint :: Type
aPoint = Spatial (Dimension.atom PointWeight)

-- | A vector of the plane.
aVector :: Type
aVector = Spatial Dimension.none

-- | The type of a number with a unit, and the size of the unit in mm, radians, minutes and
-- revolutions.
ofUnit :: Unit -> (Type, Double)
ofUnit unit = case unit of
  Millimetre -> (len, 1)
  Centimetre -> (len, 10)
  Metre -> (len, 1000)
  Inch -> (len, 25.4)
  Degree -> (angle, pi / 180)
  Radian -> (angle, 1)
  MmPerMin -> (feed, 1)
  MPerMin -> (feed, 1000)
  InPerMin -> (feed, 25.4)
  Rpm -> (spindleSpeed, 1)

-- | Describes a type in the words of a drawing, with its article.
describe :: Type -> Text
describe t = case t of
  Quantity d -> Dimension.describe d
  Spatial d
    | d == Dimension.atom PointWeight -> "a point"
    | d == Dimension.none -> "a vector"
    | Dimension.isKnown d -> "a sum of points"
    | otherwise -> "a pair"
  Circle -> "a circle"
  Line -> "a line"
  Contour -> "a contour"
  Boolean -> "true or false"
  SpacePoint -> "a point with a height"
  Transformation -> "a transformation"
  Table columns -> "a table" <> withColumns columns
  Curve columns -> "a curve" <> withColumns columns
  Fields _ -> "columns"
  ListOf item -> case item of
    Quantity d | Dimension.isKnown d -> "a list of " <> plural item
    Spatial d | Dimension.isKnown d -> "a list of " <> plural item
    Circle -> "a list of circles"
    Line -> "a list of lines"
    Contour -> "a list of contours"
    Curve _ -> "a list of curves"
    ListOf (Quantity d) | d == Dimension.none -> "a list of lists of numbers"
    _ -> "a list"
  Variable _ -> "a value"
  Wrong -> "a value"

-- | Names the columns of a table besides x and y; empty if there are none.
withColumns :: Type -> Text
withColumns t = case t of
  Fields columns@(_ : _) -> " with " <> Text.intercalate ", " (map fst columns)
  _ -> ""

-- | Describes several values of a known type, without an article.
plural :: Type -> Text
plural t = case Text.words (describe t) of
  [_, word, "in", unit] -> word <> " in " <> unit
  [_, "quantity"] -> "quantities"
  article : rest | article `elem` ["a", "an"] -> Text.unwords rest <> "s"
  phrase -> Text.unwords phrase

-- | Tells if only one thing is known of a quantity: that its dimension is a square.
isSquare :: Type -> Bool
isSquare t = case t of
  Quantity d -> Dimension.isUnknownSquare d
  _ -> False

-- | The dimension of a quantity or of the quantities in a list; 'Dimension.none' for other types.
dimensionOf :: Type -> Dimension
dimensionOf t = case t of
  Quantity d -> d
  ListOf item -> dimensionOf item
  _ -> Dimension.none

-- | The unknown dimensions in a type.
dimensions :: Type -> [Int]
dimensions t = case t of
  Quantity d -> Dimension.unknowns d
  Spatial d -> Dimension.unknowns d
  _ -> concatMap dimensions (components t)

-- | The unknown types in a type.
variables :: Type -> [Int]
variables t = case t of
  Variable n -> [n]
  _ -> concatMap variables (components t)

-- | The types of which a type is directly composed.
components :: Type -> [Type]
components t = case t of
  ListOf a -> [a]
  Table a -> [a]
  Curve a -> [a]
  Fields columns -> map snd columns
  Quantity _ -> []
  Spatial _ -> []
  Circle -> []
  Line -> []
  Contour -> []
  Boolean -> []
  SpacePoint -> []
  Transformation -> []
  Variable _ -> []
  Wrong -> []

-- | Applies one function to all dimensions in a type, and another one to all unknown types.
substitute :: (Dimension -> Dimension) -> (Int -> Type) -> Type -> Type
substitute dimension unknown t = case t of
  Quantity d -> Quantity (dimension d)
  Spatial d -> Spatial (dimension d)
  Variable n -> unknown n
  ListOf a -> ListOf (again a)
  Table a -> Table (again a)
  Curve a -> Curve (again a)
  Fields columns -> Fields (map (fmap again) columns)
  Circle -> t
  Line -> t
  Contour -> t
  Boolean -> t
  SpacePoint -> t
  Transformation -> t
  Wrong -> t
  where
    again = substitute dimension unknown
