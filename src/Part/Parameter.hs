-- | The quantities that statements and functions take as parameters, with their names and units in
-- reports.
--
-- A mistake keeps only the kind of a quantity and a number. The functions of this module turn them
-- into words.
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
import Base.Quantity (LengthUnit, Mm (..), Rad, degrees)
import Base.Quantity qualified as Quantity
import Data.Text (Text)

-- | A quantity that must not be negative. Most of these quantities must not be 0, either.
data LimitedQuantity
  = Feed
  | -- | the feed for one turn of the spindle
    TurnFeed
  | SpindleSpeed
  | CuttingSpeed
  | ScalingFactor
  | ClearanceHeight
  | Tolerance
  | -- | the larger limit of a tolerance that has one limit inwards and one outwards
    OneSidedTolerance
  | -- | the largest deviation of a fitted curve from the points or the curve that the fit replaces
    CurveTolerance
  | CutterDiameter
  | DrillDiameter
  | TipDiameter
  | TapDiameter
  | BladeDiameter
  | WheelDiameter
  | FlankHeight
  | -- | the radius of a conical cutter at the height at which its flank touches the part
    RadiusAtHeight
  | NoseRadius
  | Lead
  | Stepover
  | Depth
  | -- | the depth of a hole, in a row of a table
    HoleDepth
  | PassDepth
  | PeckDepth
  | -- | the rise of a drill after a peck
    ChipRise
  | HoleDiameter
  | -- | the pitch of a thread, or the depth of one turn of a helix
    ThreadPitch
  | Allowance
  | -- | the height of the capitals of a text
    TextHeight
  | Chamfer
  | FilletRadius
  | -- | a width, a height, a radius or a module of a shape
    ShapeSize
  | -- | the depth or the radius of a joggle, which is a local step of an edge
    JoggleMeasure
  | SafeHeight
  | -- | the distance of a point of a table from (0, 0)
    PolarRadius
  | -- | the length of the cutting edges of a tool
    FluteLength
  | -- | the length of a tool from its tip to the holder
    StickOut
  | -- | the diameter or the height of a cylinder of a holder
    HolderSize
  | -- | the height of one turn of a helix
    Pitch
  | -- | the diameter of the path of the cutter's centre in a helix
    HelixDiameter
  | TabWidth
  | TabHeight
  | -- | the time of a pause of the axes
    DwellTime
  deriving stock (Eq, Show)

-- | The name that reports use for a quantity.
name :: LimitedQuantity -> Text
name parameter = case parameter of
  Feed -> "the feed"
  TurnFeed -> "the feed"
  SpindleSpeed -> "the speed of the spindle"
  CuttingSpeed -> "the cutting speed"
  ScalingFactor -> "the factor of a scaling"
  ClearanceHeight -> "the clearance height"
  Tolerance -> "the tolerance"
  OneSidedTolerance -> "the tolerance on one side at least"
  CurveTolerance -> "the tolerance of a curve"
  CutterDiameter -> "the cutter's diameter"
  DrillDiameter -> "the drill's diameter"
  TipDiameter -> "the diameter of the tip"
  TapDiameter -> "the tap's diameter"
  BladeDiameter -> "the blade's diameter"
  WheelDiameter -> "the diameter of the wheel"
  FlankHeight -> "the height of the flank"
  RadiusAtHeight -> "the radius of the cutter at this height"
  NoseRadius -> "the radius of the nose"
  Lead -> "the lead"
  Stepover -> "the step from pass to pass"
  Depth -> "the depth"
  HoleDepth -> "the depth of a hole"
  PassDepth -> "the depth of a pass"
  PeckDepth -> "the depth of a peck"
  ChipRise -> "the rise of a chip break"
  HoleDiameter -> "the diameter of a hole"
  ThreadPitch -> "the pitch"
  Allowance -> "the allowance"
  TextHeight -> "the height of the text"
  Chamfer -> "the chamfer"
  FilletRadius -> "the radius of a fillet"
  ShapeSize -> "a size of a shape"
  JoggleMeasure -> "a measure of a joggle"
  SafeHeight -> "the safe height"
  PolarRadius -> "the radius of a point"
  FluteLength -> "the length of the flutes"
  StickOut -> "the stick-out"
  HolderSize -> "a size of the holder"
  Pitch -> "the pitch"
  HelixDiameter -> "the diameter of a helix"
  TabWidth -> "the width of a tab"
  TabHeight -> "the height of a tab"
  DwellTime -> "a dwell"

-- | The text of a quantity, in which lengths and feeds have the given unit. @x@ is in mm\/min for a
-- feed, in mm for a feed for one turn, in turns per minute for a spindle speed, in mm\/min for a
-- cutting speed, in seconds for a time, and in mm for a length. A factor has no unit.
written :: LengthUnit -> LimitedQuantity -> Double -> Text
written unit parameter x = case parameter of
  Feed -> Decimal.feedIn unit 4 (Quantity.Feed x)
  TurnFeed -> Decimal.inUnit unit (Mm x) <> "/rev"
  SpindleSpeed -> Decimal.short 4 x <> " rpm"
  CuttingSpeed -> Decimal.short 4 (x / 1000) <> " m/min"
  ScalingFactor -> Decimal.short 6 x
  DwellTime -> Decimal.short 6 x <> " s"
  _ -> Decimal.inUnit unit (Mm x)

-- | The kind of a parameter that must be a whole number.
data WholeNumber
  = ToolNumber
  | AuxiliaryCommand
  | WorkOffset
  | ProgramNumber
  | -- | the direction of the tip of a turning tool
    TipDirection
  | PassCount
  | PeckCount
  | -- | the number of holes that a statement orders
    OrderedHoleCount
  | -- | the number of turns of a helix
    TurnCount
  | -- | the number of points in one row of a pattern
    RowPointCount
  | -- | the number of rows of a pattern
    RowCount
  | -- | the number of points of a pattern on a circle
    PointCount
  | -- | the number of an item of a list, from 1
    ItemNumber
  | -- | the number of a row of a table, from 1
    TableRowNumber
  | -- | the number of a point, from 1, in a list of points that takes the place of a table
    ListPointNumber
  | -- | the degree of a B-spline
    CurveDegree
  | -- | the number of corners of a regular polygon
    CornerCount
  | -- | the number of teeth of a gear
    ToothCount
  | TabCount
  deriving stock (Eq, Show)

-- | The name that reports use for a whole number.
wholeName :: WholeNumber -> Text
wholeName number = case number of
  ToolNumber -> "the number of a tool"
  AuxiliaryCommand -> "an auxiliary command"
  WorkOffset -> "a work offset"
  ProgramNumber -> "the number of a program"
  TipDirection -> "the direction of the tip"
  PassCount -> "the number of passes"
  PeckCount -> "the number of pecks"
  OrderedHoleCount -> "the number of holes in a shortest order"
  TurnCount -> "the number of turns"
  RowPointCount -> "the number of points in a row"
  RowCount -> "the number of rows"
  PointCount -> "the number of points"
  ItemNumber -> "the number of an item"
  TableRowNumber -> "the number of a row"
  ListPointNumber -> "the number of a point"
  CurveDegree -> "the degree of a B-spline"
  CornerCount -> "the number of corners"
  ToothCount -> "the number of teeth"
  TabCount -> "the number of tabs"

-- | The range that a whole number must be in: up to a limit, or from one limit to another. The
-- limits belong to the range.
data Range = UpTo Int | FromTo Int Int
  deriving stock (Eq, Show)

-- | The words for a range in reports.
rangeText :: Range -> Text
rangeText range = case range of
  UpTo high -> "up to " <> Decimal.whole high
  FromTo low high -> "from " <> Decimal.whole low <> " to " <> Decimal.whole high

-- | A function and an argument outside of its domain. A constructor names the function, and its
-- field, if there is one, is the argument.
data Domain
  = -- | the tangent of an angle whose cosine is 0
    TangentAtPole Rad
  | ArcSineOf Double
  | ArcCosineOf Double
  | -- | @atan2(0, 0)@, which is no angle
    ArcTangentOfZeros
  | RootOf Double
  deriving stock (Eq, Show)

-- | The texts of a report on a wrong argument: the name of the function, the argument, and the
-- arguments that the function accepts.
domainTexts :: Domain -> (Text, Text, Text)
domainTexts domain = case domain of
  TangentAtPole a ->
    ("tan", Decimal.short 6 (degrees a) <> " deg", "any angle but 90 deg, 270 deg, …")
  ArcSineOf x -> ("asin", Decimal.short 9 x, "values from −1 to 1")
  ArcCosineOf x -> ("acos", Decimal.short 9 x, "values from −1 to 1")
  ArcTangentOfZeros -> ("atan2", "0 and 0", "two values that are not both 0")
  RootOf x -> ("sqrt", Decimal.short 9 x, "values from 0 upwards")
