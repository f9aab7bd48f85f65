{-# OPTIONS_GHC -O0 #-}

-- | Mistakes in the values and the geometry of a part.
--
-- An error is a fact: numbers, and the regions that they come from. Only 'toReport' makes sentences
-- of it. Facts about contours, curves, constructions and pockets have types of their own.
module Part.Error
  ( Error (..),
    ValueFact (..),
    CutterStatement (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm)
import Base.Region (Region (Region))
import Data.List (nub)
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ConstructionError (ConstructionFault)
import Part.ConstructionError qualified as ConstructionError
import Part.ContourError (ContourFault)
import Part.ContourError qualified as ContourError
import Part.CurveError (CurveMistake)
import Part.CurveError qualified as CurveError
import Part.ErrorText (at)
import Part.Parameter (Domain, LimitedQuantity, Range, WholeNumber)
import Part.Parameter qualified as Parameter
import Part.Part (CutterKind (..))
import Part.PocketError (PocketMisfit)
import Part.PocketError qualified as PocketError
import Report.Report (Label (..), Report (..), quote)

-- | A fact, and the regions of the function calls in whose evaluation it was found, the innermost
-- call first.
data Error = Error {fact :: ValueFact, calls :: [Region]}
  deriving stock (Eq, Show)

-- | A mistake in a value, a statement or the geometry. The first field of a constructor is the
-- region that the report points at, and its comment names the other fields in order. The last four
-- constructors contain facts of other modules.
data ValueFact
  = DivisionByZero Region
  | OutOfDomain Region Domain
  | -- | a result that is infinite or not a number
    TooLarge Region
  | -- | a length, radius or coordinate that no machine can reach: the largest one that is allowed
    OutOfReach Region Mm
  | -- | a program whose evaluation takes too many steps: the number of steps that is allowed
    TooMuchWork Region Int
  | RadiusNotPositive Region Mm
  | -- | a line through two equal points: this point
    ZeroLine Region Point
  | -- | a quantity that must be above 0: its kind and its value, in the unit of 'Parameter.written'
    NotPositive Region LimitedQuantity Double
  | -- | a quantity that must be 0 or more: its kind and its value, in the unit of
    -- 'Parameter.written'
    Negative Region LimitedQuantity Double
  | -- | a number that is not whole, or is outside of its range: its kind, the range, and the number
    NotWhole Region WholeNumber Range Double
  | -- | an item that a list does not have: the number of the item, from 1, and the number of items
    -- in the list
    NoSuchItem Region Int Int
  | StepOfZero Region
  | NothingToDrill Region
  | -- | an assertion that is false: the operands of its comparison, each with its region and its
    -- value. Empty if the assertion is no comparison
    DoesNotHold Region [(Region, Text)]
  | -- | two values that the program asserts to be equal: each with its region, then their
    -- difference and the largest difference that is allowed
    DoNotAgree Region (Region, Text) (Region, Text) Text Text
  | -- | a statement for which the tool in the spindle has the wrong kind: the statement, and that
    -- kind
    WrongCutter Region CutterStatement CutterKind
  | -- | passes at several heights with a cutter that is widest at its tip
    StepsUndercut Region
  | InConstruction ConstructionFault
  | InContour ContourFault
  | InCurve CurveMistake
  | InPocket PocketMisfit
  deriving stock (Eq, Show)

-- | A statement that needs cutters of certain kinds.
data CutterStatement = MillStatement | TurnStatement | PocketStatement | DrillStatement
  deriving stock (Eq, Show)

-- | The report of a mistake. It also points at the outermost and at the innermost function call in
-- which the mistake was found.
toReport :: Error -> Report
toReport (Error fact calls) =
  report {others = others report <> [Label c "in this call" | c <- nub (innermost <> outermost)]}
  where
    report = factReport fact
    innermost = take 1 calls
    outermost = take 1 (reverse calls)

-- | The report of a fact, without the function calls.
factReport :: ValueFact -> Report
factReport fact = case fact of
  DivisionByZero region -> at region "E0301" "this divides by zero"
  OutOfDomain region domain ->
    let (function, argument, range) = Parameter.domainTexts domain
     in (at region "E0302" (function <> " of " <> argument <> " does not exist"))
          { message = [function <> " takes " <> range <> "."]
          }
  TooLarge region -> at region "E0303" "the result is too large for a number"
  OutOfReach region limit ->
    (at region "E0326" "this is further than any machine reaches")
      { message =
          [ "A place is no further than "
              <> Decimal.mm limit
              <> " from zero, and no radius is longer."
          ]
      }
  TooMuchWork region limit ->
    (at region "E0327" ("this takes more than " <> Decimal.whole limit <> " steps to compute"))
      { message =
          [ "Functions that use one another several times, or repetitions in repetitions, \
            \multiply their steps."
          ]
      }
  RadiusNotPositive region r ->
    (at region "E0304" ("a circle needs a positive radius, this one is " <> Decimal.mm r))
      { label = Decimal.mm r
      }
  ZeroLine region p ->
    (at region "E0305" "this line has no length")
      { message =
          [ "Both its points are "
              <> Vec.toText 4 p
              <> "; a line needs two different ones."
          ]
      }
  NotPositive region parameter x ->
    at
      region
      "E0306"
      ( Parameter.name parameter
          <> " must be more than zero, this one is "
          <> Parameter.written parameter x
      )
  Negative region parameter x ->
    at
      region
      "E0345"
      ( Parameter.name parameter
          <> " must not be negative, this one is "
          <> Parameter.written parameter x
      )
  NotWhole region number range x ->
    ( at
        region
        "E0338"
        (Parameter.wholeName number <> " must be a whole number " <> Parameter.rangeText range)
    )
      { label = Decimal.short 6 x
      }
  NoSuchItem region n count ->
    (at region "E0339" ("the list has no item " <> Decimal.whole n))
      { message =
          [ "It has "
              <> Decimal.whole count
              <> (if count == 1 then " item" else " items")
              <> ", counted from 1."
          ]
      }
  StepOfZero region ->
    at region "E0340" "a range cannot go in steps of zero"
  NothingToDrill region ->
    at region "E0346" "there is no point to drill at"
  DoesNotHold region values ->
    (at region "E0341" "this does not hold")
      { others = [Label r value | (r, value) <- values]
      }
  DoNotAgree region (leftRegion, left) (rightRegion, right) difference allowed ->
    (at region "E0342" ("this is " <> left <> ", not " <> right))
      { others = [Label leftRegion left, Label rightRegion right],
        message =
          [ if difference == allowed
              then "They differ by somewhat more than " <> allowed <> ", which is allowed."
              else "They differ by " <> difference <> "; " <> allowed <> " is allowed."
          ]
      }
  WrongCutter region statement kind -> wrongCutterReport region statement kind
  StepsUndercut region ->
    (at region "E0360" "a cutter that is widest at its tip cannot go down in steps")
      { message = ["Above the last depth its tip would cut into what leans over that."],
        hints = ["Give the depth without a step, or clear the way before with an upright mill."]
      }
  InConstruction fault -> ConstructionError.toReport fault
  InContour fault -> ContourError.toReport fault
  InCurve fault -> CurveError.toReport fault
  InPocket fault -> PocketError.toReport fault

-- | The report of a statement for which the tool has the wrong kind. It points at the keyword with
-- which the statement begins.
wrongCutterReport :: Region -> CutterStatement -> CutterKind -> Report
wrongCutterReport (Region begin _) statement kind =
  (at (Region begin (begin + Text.length keyword)) "E0344" (quote keyword <> " needs " <> needed))
    { message = ["The tool is " <> tool <> "."],
      hints = ["Change it first: change 2 " <> change]
    }
  where
    (keyword, needed, change) = case statement of
      MillStatement -> ("mill", "a mill", "mill(diameter 5 mm)")
      TurnStatement -> ("turn", "a turning tool", "turn(nose 0.4 mm)")
      PocketStatement -> ("pocket", "a mill", "mill(diameter 5 mm)")
      DrillStatement -> ("drill", "a drill or a mill", "drill(diameter 5 mm)")
    tool = case kind of
      MillingCutter -> "a mill"
      ConeCutter -> "a cone"
      DovetailCutter -> "a cone"
      BladeCutter _ -> "a blade that swivels"
      DrillingCutter -> "a drill"
      TurningCutter -> "a turning tool"
