-- | The quantities that statements and functions ask for, and their names and units in reports.
--
-- A mistake in one of them carries the 'LimitedQuantity' and the number; 'name' and 'written' are
-- the only definitions that turn them into words.
module Part.Parameter
  ( LimitedQuantity (..),
    name,
    written,
    WholeNumber (..),
    wholeName,
    Range (..),
    rangeText,
    Domain (..),
    domainTexts,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad, degrees)
import Data.Text (Text)

-- | A quantity with a lower limit of 0.
data LimitedQuantity
  = Feed
  | SpindleSpeed
  | ScalingFactor
  | ClearanceHeight
  | Tolerance
  | -- | the larger limit of a tolerance band
    OneSidedTolerance
  | -- | the largest deviation of a fitted curve
    CurveTolerance
  | CutterDiameter
  | DrillDiameter
  | BladeDiameter
  | WheelDiameter
  | FlankHeight
  | -- | the radius of a cone where its flank touches the part
    RadiusAtHeight
  | NoseRadius
  | Lead
  | Stepover
  | Depth
  | PassDepth
  | PeckDepth
  | Allowance
  | Chamfer
  | FilletRadius
  | -- | the depth or the radius of a joggle
    JoggleMeasure
  deriving stock (Eq, Show)

-- | The name of a parameter in a report.
name :: LimitedQuantity -> Text
name parameter = case parameter of
  Feed -> "the feed"
  SpindleSpeed -> "the speed of the spindle"
  ScalingFactor -> "the factor of a scaling"
  ClearanceHeight -> "the clearance height"
  Tolerance -> "the tolerance"
  OneSidedTolerance -> "the tolerance on one side at least"
  CurveTolerance -> "the tolerance of a curve"
  CutterDiameter -> "the cutter's diameter"
  DrillDiameter -> "the drill's diameter"
  BladeDiameter -> "the blade's diameter"
  WheelDiameter -> "the diameter of the wheel"
  FlankHeight -> "the height of the flank"
  RadiusAtHeight -> "the radius of the cutter at this height"
  NoseRadius -> "the radius of the nose"
  Lead -> "the lead"
  Stepover -> "the step from pass to pass"
  Depth -> "the depth"
  PassDepth -> "the depth of a pass"
  PeckDepth -> "the depth of a peck"
  Allowance -> "the allowance"
  Chamfer -> "the chamfer"
  FilletRadius -> "the radius of a fillet"
  JoggleMeasure -> "a measure of a joggle"

-- | A parameter's value with its unit: mm\/min for the feed, turns a minute for the spindle, no
-- unit for a factor, else mm.
written :: LimitedQuantity -> Double -> Text
written parameter x = case parameter of
  Feed -> Decimal.short 4 x <> " mm/min"
  SpindleSpeed -> Decimal.short 4 x <> " rpm"
  ScalingFactor -> Decimal.short 6 x
  _ -> Decimal.mm (Mm x)

-- | A number that has to be whole.
data WholeNumber
  = ToolNumber
  | AuxiliaryCommand
  | PassCount
  | PeckCount
  | -- | the points of one row of a pattern
    RowPointCount
  | RowCount
  | PointCount
  | ItemNumber
  | TableRowNumber
  | ListPointNumber
  deriving stock (Eq, Show)

-- | The name of a whole number in a report.
wholeName :: WholeNumber -> Text
wholeName number = case number of
  ToolNumber -> "the number of a tool"
  AuxiliaryCommand -> "an auxiliary command"
  PassCount -> "the number of passes"
  PeckCount -> "the number of pecks"
  RowPointCount -> "the number of points in a row"
  RowCount -> "the number of rows"
  PointCount -> "the number of points"
  ItemNumber -> "the number of an item"
  TableRowNumber -> "the number of a row"
  ListPointNumber -> "the number of a point"

-- | The range of a whole number; both limits are allowed.
data Range = UpTo Int | FromTo Int Int
  deriving stock (Eq, Show)

-- | A range in words.
rangeText :: Range -> Text
rangeText range = case range of
  UpTo high -> "up to " <> Decimal.whole high
  FromTo low high -> "from " <> Decimal.whole low <> " to " <> Decimal.whole high

-- | A function with an argument outside of its domain.
data Domain
  = TangentAtPole Rad
  | ArcSineOf Double
  | ArcCosineOf Double
  | -- | @atan2(0, 0)@
    ArcTangentOfZeros
  | RootOf Double
  deriving stock (Eq, Show)

-- | The name of the function, its argument, and the arguments that it takes.
domainTexts :: Domain -> (Text, Text, Text)
domainTexts domain = case domain of
  TangentAtPole a ->
    ("tan", Decimal.short 6 (degrees a) <> " deg", "any angle but 90 deg, 270 deg, …")
  ArcSineOf x -> ("asin", Decimal.short 9 x, "values from −1 to 1")
  ArcCosineOf x -> ("acos", Decimal.short 9 x, "values from −1 to 1")
  ArcTangentOfZeros -> ("atan2", "0 and 0", "two values that are not both 0")
  RootOf x -> ("sqrt", Decimal.short 9 x, "values from 0 upwards")
