-- | The types of the part language. An unknown is a type or a dimension that type inference has yet
-- to find; it is identified by a number.
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

import Base.Region (Located (..))
import Checked.Dimension (Atom (..), Dimension)
import Checked.Dimension qualified as Dimension
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Token (Unit (..))

-- | The type of a value.
data Type
  = -- | a number with a dimension
    Quantity Dimension
  | -- | a point or a vector, both of which are pairs of lengths. In the dimension, the exponent of
    -- 'PointWeight' is 1 for a point and 0 for a vector
    Spatial Dimension
  | Circle
  | Line
  | Contour
  | -- | a region that closed contours bound
    PlaneRegion
  | -- | a pocket that a statement clears
    Clearing
  | -- | true or false
    Boolean
  | -- | a point with a height
    SpacePoint
  | -- | a transformation of the plane
    Transformation
  | ListOf Type
  | -- | a table, with the 'Fields' of its columns or an unknown in their place
    Table Type
  | -- | a curve, with the 'Fields' of the table through which it passes or an unknown in their
    -- place
    Curve Type
  | -- | the columns of a table besides x and y: their names in the heading, and the types of their
    -- cells
    Fields [(Located Text, Type)]
  | -- | an unknown type, by its number
    Variable Int
  | -- | the type of a term that is already reported as wrong; it fits every type, so that no
    -- further report follows
    Wrong
  deriving stock (Eq, Show)

-- | The type of a plain number.
number :: Type
number = Quantity Dimension.none

-- | The type of a length. In checked programs lengths are in mm.
len :: Type
len = Quantity (Dimension.atom Length)

-- | The type of an angle. In checked programs angles are in radians.
angle :: Type
angle = Quantity (Dimension.atom Angle)

-- | The type of a feed. In checked programs feeds are in mm/min.
feed :: Type
feed =
  Quantity (Dimension.times (Dimension.atom Length) (Dimension.power (-1) (Dimension.atom Time)))

-- | The type of a spindle speed, which is in turns per minute.
spindleSpeed :: Type
spindleSpeed = Quantity (Dimension.power (-1) (Dimension.atom Time))

-- | The type of a point of the plane.
aPoint :: Type
aPoint = Spatial (Dimension.atom PointWeight)

-- | The type of a vector of the plane.
aVector :: Type
aVector = Spatial Dimension.none

-- | The type of a number with the unit @unit@, and the factor that converts this number to the unit
-- of checked programs: mm, radians, mm/min or turns per minute.
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
  FtPerMin -> (feed, 304.8)
  Rpm -> (spindleSpeed, 1)

-- | The description of a type in the words of a drawing, with an article, such as "a length".
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
  PlaneRegion -> "a region"
  Clearing -> "a pocket or a V-carving with a name"
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
    PlaneRegion -> "a list of regions"
    Clearing -> "a list of pockets and V-carvings with names"
    Curve _ -> "a list of curves"
    ListOf _ | Just items <- Text.stripPrefix "a list" (describe item) -> "a list of lists" <> items
    _ -> "a list"
  Variable _ -> "a value"
  Wrong -> "a value"

-- | The words of a description that name the columns in the 'Fields' @t@, such as "with the column
-- mu". Empty if there are no columns, or if @t@ is an unknown.
withColumns :: Type -> Text
withColumns t = case t of
  Fields [(column, _)] -> " with the column " <> value column
  Fields columns@(_ : _) ->
    " with the columns " <> Text.intercalate ", " (map (value . fst) columns)
  _ -> ""

-- | The description of several values of a type, without an article, such as "lengths".
plural :: Type -> Text
plural t = case Text.words (describe t) of
  [_, word, "in", unit] -> word <> " in " <> unit
  [_, "quantity"] -> "quantities"
  article : rest | article `elem` ["a", "an"] -> Text.unwords rest <> "s"
  phrase -> Text.unwords phrase

-- | True if a type is a quantity whose dimension contains unknowns and is a square for all values
-- of these unknowns. A known dimension gives False, even that of an area.
isSquare :: Type -> Bool
isSquare t = case t of
  Quantity d -> Dimension.isUnknownSquare d
  _ -> False

-- | The dimension of a quantity, or of the quantities in a list. It is 'Dimension.none' for all
-- other types.
dimensionOf :: Type -> Dimension
dimensionOf t = case t of
  Quantity d -> d
  ListOf item -> dimensionOf item
  _ -> Dimension.none

-- | The numbers of the unknown dimensions in a type.
dimensions :: Type -> [Int]
dimensions t = case t of
  Quantity d -> Dimension.unknowns d
  Spatial d -> Dimension.unknowns d
  _ -> concatMap dimensions (components t)

-- | The numbers of the unknown types in a type.
variables :: Type -> [Int]
variables t = case t of
  Variable n -> [n]
  _ -> concatMap variables (components t)

-- | The types that are direct parts of a type, such as the type of a list's items.
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
  PlaneRegion -> []
  Clearing -> []
  Boolean -> []
  SpacePoint -> []
  Transformation -> []
  Variable _ -> []
  Wrong -> []

-- | Applies the function @dimension@ to all dimensions in a type. Replaces each unknown type by the
-- result of the function @unknown@ for its number.
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
  PlaneRegion -> t
  Clearing -> t
  Boolean -> t
  SpacePoint -> t
  Transformation -> t
  Wrong -> t
  where
    again = substitute dimension unknown
