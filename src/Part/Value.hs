-- | The values of the language, and checks that the built-in functions make of their results. The
-- parameter @region@ of a check is the region that a mistake points at.
module Part.Value
  ( Value (..),
    NamedOperation (..),
    MachinedBefore (..),
    Argument (..),
    spatial,
    lifted,
    within,
    finite,
    fromOrigin,
    offset,
    whole,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Region)
import Checked.Syntax (Rank (..), Selector (..))
import Data.Vector (Vector)
import Geometry.Carrier (Circle (..), Line (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Part.Curve (PartCurve, PartTable)
import Part.Error (ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Parameter (Range (FromTo), WholeNumber)
import Part.Part (Carving, Contour, Pocketing)
import Part.PlaneRegion (PlaneRegion)

-- | A value of the language. Numbers are in mm, radians, minutes and turns, or in products of
-- powers of these units.
data Value
  = Quantity Double
  | -- | a vector, or a point of the plane as the vector from (0, 0) to it
    Spatial Vec
  | -- | a point with a height
    SpaceValue Point Mm
  | TruthValue Bool
  | CircleValue Circle
  | LineValue Line
  | ContourValue Contour
  | RegionValue PlaneRegion
  | ListValue (Vector Value)
  | PlacementValue Transformation
  | TableValue PartTable
  | CurveValue PartCurve
  | OperationValue NamedOperation
  deriving stock (Eq, Show)

-- | A statement with a name that leaves something to a later one.
data NamedOperation = NamedOperation
  { -- | the region of the statement
    operationAt :: Region,
    machinedBefore :: MachinedBefore,
    -- | true inside a @with@ if the statement is outside of it, so that the transformation does not
    -- hold for it
    isElsewhere :: Bool
  }
  deriving stock (Eq, Show)

-- | The object of a statement with a name.
data MachinedBefore
  = -- | the pockets, one for each part of its region
    Pockets [Pocketing]
  | -- | a region, along its edges only where it is wide
    Carved Carving
  deriving stock (Eq, Show)

-- | An argument of a built-in function: a value, a value after a word such as @near@ or @left@, or
-- one of the words @first@ and @last@.
data Argument = Plain Value | Choosing Selector Value | Ranking Rank
  deriving stock (Eq, Show)

-- | Makes the value of a point or vector. Fails if its length exceeds 'Tolerance.reach'. The length
-- of a point is its distance from (0, 0).
spatial :: Region -> Vec -> Eval Value
spatial region v = Spatial v <$ within region (Vec.norm v)

-- | Makes the value of a point with the height @z@. Fails if the distance of the point from (0, 0),
-- or the absolute value of @z@, exceeds 'Tolerance.reach'.
lifted :: Region -> Point -> Mm -> Eval Value
lifted region p z@(Mm h) =
  SpaceValue p z <$ (within region (Vec.norm (offset p)) *> within region h)

-- | Fails if the absolute value of the length @x@, in mm, exceeds 'Tolerance.reach'.
within :: Region -> Double -> Eval ()
within region x
  | abs x <= limit = pure ()
  | otherwise = Evaluation.mistake (OutOfReach region Tolerance.reach)
  where
    Mm limit = Tolerance.reach

-- | Makes the value of a computed number. Fails if the number is infinite or not a number.
finite :: Region -> Double -> Eval Value
finite region x
  | isNaN x || isInfinite x = Evaluation.mistake (TooLarge region)
  | otherwise = pure (Quantity x)

-- | The point at the end of a vector that starts at (0, 0).
fromOrigin :: Vec -> Point
fromOrigin v = Vec.shift v (Vec.point 0 0)

-- | The vector from (0, 0) to a point.
offset :: Point -> Vec
offset = Vec.to (Vec.point 0 0)

-- | Converts @x@ to a whole number from 1 to 10⁷. If @x@ is within 'Tolerance.equal' of a whole
-- number, it is rounded. Fails if @x@ is not whole or out of range. @what@ names @x@ in mistakes.
whole :: Region -> WholeNumber -> Double -> Eval Int
whole region what x
  | abs (x - fromIntegral n) > Tolerance.equal || n < 1 || x > 1e7 =
    Evaluation.mistake (NotWhole region what (FromTo 1 10000000) x)
  | otherwise = pure n
  where
    n = if abs x > 1e8 then 0 else round x :: Int
