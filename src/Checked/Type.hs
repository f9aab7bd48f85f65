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

-- | What a value is.
data Type
  = -- | a number with a dimension
    Quantity Dimension
  | -- | a pair of lengths: a point (place 1) or a vector (place 0)
    Spatial Dimension
  | Circle
  | Line
  | Contour
  | -- | true or false
    Boolean
  | -- | a point with a height
    SpacePoint
  | -- | a motion of the plane
    Transformation
  | ListOf Type
  | -- | rows of values, by its columns
    Table Type
  | -- | by the columns of the table that it was made of
    Curve Type
  | -- | columns with their names, besides x and y
    Fields [(Text, Type)]
  | -- | not yet known
    Variable Int
  | -- | the type of a thing that is already reported as wrong; agrees with everything
    Wrong
  deriving stock (Eq, Show)

number, len, angle, feed, spindleSpeed, aPoint, aVector :: Type
number = Quantity Dimension.none
len = Quantity (Dimension.atom Length)
angle = Quantity (Dimension.atom Angle)
feed =
  Quantity (Dimension.times (Dimension.atom Length) (Dimension.power (-1) (Dimension.atom Time)))
spindleSpeed = Quantity (Dimension.power (-1) (Dimension.atom Time))
aPoint = Spatial (Dimension.atom PointWeight)
aVector = Spatial Dimension.none

-- | In the words of a drawing, with its article.
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
  Table columns -> "a table" <> besides columns
  Curve columns -> "a curve" <> besides columns
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

-- | The columns of a table besides x and y.
besides :: Type -> Text
besides t = case t of
  Fields columns@(_ : _) -> " with " <> Text.intercalate ", " (map fst columns)
  _ -> ""

-- | Several of a known kind.
plural :: Type -> Text
plural t = case Text.words (describe t) of
  [_, word, "in", unit] -> word <> " in " <> unit
  [_, "quantity"] -> "quantities"
  article : words' | article `elem` ["a", "an"] -> Text.unwords words' <> "s"
  words' -> Text.unwords words'

-- | Whether it is known of a quantity only that it is a square.
isSquare :: Type -> Bool
isSquare t = case t of
  Quantity d -> Dimension.isUnknownSquare d
  _ -> False

-- | The dimension of the quantities of a type; of others that of a number.
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

-- | The types in a type, one level down.
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

-- | A type with its dimensions and its unknown types replaced.
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
