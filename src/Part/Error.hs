{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

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
import Base.Quantity (LengthUnit, Mm (..), Seconds (..), times)
import Base.Region (Region (Region))
import Data.List (nub)
import Data.Maybe (isNothing, listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.BodyError (BodyMistake)
import Part.BodyError qualified as BodyError
import Part.CarvingError (CarvingMistake)
import Part.CarvingError qualified as CarvingError
import Part.ConstructionError (ConstructionFault)
import Part.ConstructionError qualified as ConstructionError
import Part.ContourError (ContourFault)
import Part.ContourError qualified as ContourError
import Part.CurveError (CurveMistake)
import Part.CurveError qualified as CurveError
import Part.DescentError (DescentMisfit)
import Part.DescentError qualified as DescentError
import Part.EngravingError (EngravingMistake)
import Part.EngravingError qualified as EngravingError
import Part.ErrorText (alternatively)
import Part.HoleError (HoleMistake)
import Part.HoleError qualified as HoleError
import Part.Parameter (Domain, LimitedQuantity, Range (..), WholeNumber)
import Part.Parameter qualified as Parameter
import Part.Part (CutterKind (..))
import Part.PocketError (PocketMisfit)
import Part.PocketError qualified as PocketError
import Part.RegionError (RegionMistake)
import Part.RegionError qualified as RegionError
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at, quote)
import Surface.HoleForm qualified as HoleForm
import Surface.Syntax (HoleWork (..))

-- | A mistake of the program.
data Error = Error
  { fact :: ValueFact,
    -- | the regions of the calls of the program's functions in whose evaluation the mistake was
    -- found, the innermost call first
    calls :: [Region],
    -- | the regions of the arguments of the built-in function that found the mistake, without
    -- @first@ and @last@; empty if no built-in function found it
    arguments :: [Region]
  }
  deriving stock (Eq, Show)

-- | A mistake in a value, a statement or the geometry. The first field of a constructor is the
-- region that the report points at, and its comment names the other fields in order. The last
-- ten constructors contain facts of other modules.
data ValueFact
  = DivisionByZero Region
  | OutOfDomain Region Domain
  | -- | a result that is infinite or not a number
    TooLarge Region
  | -- | a length, radius or coordinate that no machine can reach: the largest one that is allowed
    OutOfReach Region Mm
  | -- | a program whose evaluation takes too many steps: the number of steps that is allowed
    TooMuchWork Region Int
  | -- | a circle whose radius is not above 0: this radius, and the index of the argument that gives
    -- it, if there is one
    RadiusNotPositive Region Mm (Maybe Int)
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
  | -- | passes at several heights with a cutter that is widest at its tip: the region of the
    -- stepdown with the word before it
    StepsUndercut Region (Maybe Region)
  | -- | a safe height below a clearance height: the safe height, and the clearance height with its
    -- region
    SafeTooLow Region Mm (Region, Mm)
  | -- | a tool change whose number the first tool has, which is another cutter: the number, and the
    -- region of the number of the first tool
    NumberOfFirstTool Region Int Region
  | -- | a dwell that is too long: the longest one, in seconds
    DwellTooLong Region Seconds
  | InBody BodyMistake
  | InCarving CarvingMistake
  | InDescent DescentMisfit
  | InConstruction ConstructionFault
  | InContour ContourFault
  | InCurve CurveMistake
  | InEngraving EngravingMistake
  | InHole HoleMistake
  | InPocket PocketMisfit
  | InRegion RegionMistake
  deriving stock (Eq, Show)

-- | A statement that needs cutters of certain kinds.
data CutterStatement
  = MillStatement
  | TurnStatement
  | PocketStatement
  | RestStatement
  | FaceStatement
  | EngraveStatement
  | CarveStatement
  | DrillStatement
  | HoleStatement HoleWork
  deriving stock (Eq, Show)

-- | The report of a mistake. It also points at the outermost and at the innermost function call in
-- which the mistake was found.
toReport :: LengthUnit -> Error -> Report
toReport unit (Error fact calls arguments) =
  report {others = others report <> [Label c "in this call" | c <- nub (innermost <> outermost)]}
  where
    report = factReport unit arguments fact
    innermost = take 1 calls
    outermost = take 1 (reverse calls)

-- | The report of a fact, without the function calls. @arguments@ are the regions of the arguments
-- of the built-in function that found it.
factReport :: LengthUnit -> [Region] -> ValueFact -> Report
factReport unit arguments fact = case fact of
  DivisionByZero region ->
    (at region "E0301" "this divides by 0")
      { hints = ["Check the divisor, or leave the division out where it is 0: if … then … else …"]
      }
  OutOfDomain region domain ->
    let (function, argument, range) = Parameter.domainTexts domain
     in (at region "E0302" (function <> " of " <> argument <> " does not exist"))
          { message = [function <> " takes " <> range <> "."],
            hints = ["Check the numbers from which the argument is computed."]
          }
  TooLarge region ->
    (at region "E0303" "the result is too large for a number")
      { hints = ["Check the numbers from which it is computed."]
      }
  OutOfReach region limit ->
    (at region "E0326" "this is further than any machine reaches")
      { message =
          [ "A place is no further than "
              <> Decimal.inUnit unit limit
              <> " from zero, and no radius is longer."
          ],
        hints = ["Check the units and the decimal points of the numbers."]
      }
  TooMuchWork region limit ->
    (at region "E0327" ("this takes more than " <> Decimal.whole limit <> " steps to compute"))
      { message =
          [ "Functions that use one another several times, or repetitions in repetitions, \
            \multiply their steps."
          ],
        hints = ["Repeat fewer times, or give a name to a value that is computed several times."]
      }
  RadiusNotPositive region r index ->
    ( at
        region
        "E0304"
        ( "a circle needs a radius above 0, and this one is "
            <> Decimal.inUnit unit r
        )
    )
      { label = Decimal.inUnit unit r,
        fixes =
          [ withoutMinus argument (Decimal.inUnit unit (times (-1) r))
            | r < Mm 0,
              Just k <- [index],
              argument : _ <- [drop k arguments]
          ],
        hints = ["Give the circle a radius above 0." | isNothing index || r >= Mm 0]
      }
  ZeroLine region p ->
    (at region "E0305" "this line has no length")
      { message =
          [ "Both its points are "
              <> Vec.toText unit 4 p
              <> "; a line needs two different ones."
          ],
        hints = ["Correct the coordinates of one of them."]
      }
  NotPositive region parameter x ->
    (at region "E0306" (limited unit parameter "has to be more than 0" x))
      { fixes = signFixes unit region parameter arguments x,
        hints = ["Write a number above 0." | null (signFixes unit region parameter arguments x)]
      }
  Negative region parameter x ->
    (at region "E0345" (limited unit parameter "cannot be less than 0" x))
      { fixes = signFixes unit region parameter arguments x,
        hints =
          [ "For a point on the other side of (0, 0), add 180 deg to its angle."
            | parameter == Parameter.PolarRadius
          ]
      }
  NotWhole region number range x -> notWholeReport region number range arguments x
  NoSuchItem region n count ->
    (at region "E0339" ("the list has no item " <> Decimal.whole n))
      { message = ["It has " <> counted count "item" <> ", which are counted from 1."],
        fixes =
          [ Fix.proposed
              (Fix.exchange ("Take the last one: " <> last' <> ".") argument last')
            | count > 0,
              let last' = Decimal.whole count,
              _ : argument : _ <- [arguments]
          ]
      }
  StepOfZero region ->
    (at region "E0340" "a range cannot go in steps of 0")
      { hints = ["Write a step above 0, or one below 0 to count downwards."]
      }
  NothingToDrill region ->
    (at region "E0346" "this list of points is empty, so there is nothing to drill")
      { hints = ["Write a point in the list, or leave the statement out."]
      }
  DoesNotHold region values ->
    (at region "E0341" "this does not hold")
      { others = [Label r value | (r, value) <- values],
        hints = ["Correct the numbers that the assertion compares, or the assertion."]
      }
  DoNotAgree region (leftRegion, left) (rightRegion, right) difference allowed ->
    (at region "E0342" ("this is " <> left <> ", not " <> right))
      { others = [Label leftRegion left, Label rightRegion right],
        message =
          [ if difference == allowed
              then "They differ by somewhat more than " <> allowed <> ", which is allowed."
              else "They differ by " <> difference <> "; " <> allowed <> " is allowed."
          ],
        hints = ["Correct one of the two, or allow a larger difference: within …"]
      }
  WrongCutter region statement kind -> wrongCutterReport region statement kind
  StepsUndercut region steps ->
    (at region "E0360" "a cutter that is widest at its tip cannot go down in steps")
      { message = ["Above the last depth its tip would cut into the wall that leans over it."],
        fixes = inOnePass,
        hints = [alternatively inOnePass "Clear the way before with an upright mill."]
      }
    where
      inOnePass = [Fix.proposed (Fix.removal "Leave the step out: one pass." s) | Just s <- [steps]]
  SafeTooLow region (Mm safe) (higher, Mm clearance) ->
    let text = Decimal.inUnit unit (Mm clearance)
     in (at region "E0361" "the safe height is below the clearance height")
          { message =
              [ "It is "
                  <> Decimal.inUnit unit (Mm safe)
                  <> ", and the clearance height is "
                  <> text
                  <> "."
              ],
            others = [Label higher ("a clearance of " <> text)],
            fixes = [Fix.proposed (Fix.exchange ("Write " <> text <> ".") region text)]
          }
  NumberOfFirstTool region n first ->
    let text = Decimal.whole (if n < 99 then n + 1 else 1)
     in (at region "E0362" ("tool " <> Decimal.whole n <> " is already another cutter"))
          { message = ["The tool table of the control has one cutter under each number."],
            others = [Label first "the first tool has this number"],
            fixes =
              [Fix.proposed (Fix.exchange ("Give it the number " <> text <> ".") region text)],
            hints = ["If it is the first tool again, write the same cutter."]
          }
  DwellTooLong region (Seconds most) ->
    (at region "E0363" ("a dwell is at most " <> Decimal.short 0 most <> " s"))
      { hints = ["Write stop if the program has to wait for the operator."]
      }
  InConstruction fault -> ConstructionError.toReport unit arguments fault
  InContour fault -> ContourError.toReport unit fault
  InCurve fault -> CurveError.toReport unit fault
  InHole fault -> HoleError.toReport unit fault
  InPocket fault -> PocketError.toReport unit fault
  InEngraving fault -> EngravingError.toReport unit fault
  InRegion fault -> RegionError.toReport unit fault
  InBody fault -> BodyError.toReport unit fault
  InCarving fault -> CarvingError.toReport unit fault
  InDescent fault -> DescentError.toReport unit fault

-- | The sentence that a quantity has the value @x@, which breaks a rule.
limited :: LengthUnit -> LimitedQuantity -> Text -> Double -> Text
limited unit parameter rule x =
  Parameter.name parameter <> " " <> rule <> ", and this one is "
    <> Parameter.written unit parameter x

-- | Fixes of a quantity with the negative value @x@: the same number without its minus.
signFixes :: LengthUnit -> Region -> LimitedQuantity -> [Region] -> Double -> [Fix]
signFixes unit region parameter arguments x =
  [ withoutMinus place (Parameter.written unit parameter (negate x))
    | x < 0,
      Just place <- [written]
  ]
  where
    written = case parameter of
      Parameter.CurveTolerance -> listToMaybe (reverse arguments)
      Parameter.ScalingFactor -> Nothing
      Parameter.RadiusAtHeight -> Nothing
      Parameter.OneSidedTolerance -> Nothing
      -- The region is that of the whole row.
      Parameter.PolarRadius -> Nothing
      Parameter.HoleDepth -> Nothing
      _ -> Just region

-- | Fix that writes a number without its minus.
withoutMinus :: Region -> Text -> Fix
withoutMinus region text =
  Fix.proposed (Fix.exchange ("Write it without the minus: " <> text <> ".") region text)

-- | A count with its noun.
counted :: Int -> Text -> Text
counted n noun = Decimal.whole n <> " " <> noun <> (if n == 1 then "" else "s")

-- | The report of a number that is not whole or outside of its range. The fix writes the nearest
-- number that is allowed.
notWholeReport :: Region -> WholeNumber -> Range -> [Region] -> Double -> Report
notWholeReport region number range arguments x =
  ( at
      region
      "E0338"
      ( Parameter.wholeName number
          <> " has to be a whole number "
          <> Parameter.rangeText range
          <> ", and this one is "
          <> Decimal.short 6 x
      )
  )
    { label = Decimal.short 6 x,
      fixes =
        [ Fix.proposed (Fix.exchange ("Write " <> text <> ".") place text)
          | let text = Decimal.whole nearest,
            Just place <- [written]
        ]
    }
  where
    nearest = case range of
      UpTo high -> min high (round (min 1e9 x))
      FromTo low high -> max low (min high (round (max (-1e9) (min 1e9 x))))
    argument k = listToMaybe (drop k arguments)
    written = case number of
      Parameter.ToolNumber -> Just region
      Parameter.AuxiliaryCommand -> Just region
      Parameter.WorkOffset -> Just region
      Parameter.ProgramNumber -> Just region
      Parameter.TipDirection -> Just region
      Parameter.PassCount -> Nothing
      Parameter.PeckCount -> Nothing
      Parameter.OrderedHoleCount -> Nothing
      Parameter.TurnCount -> Nothing
      Parameter.RowPointCount -> argument 2
      Parameter.RowCount -> argument 4
      Parameter.PointCount -> argument 1
      Parameter.ItemNumber -> argument 1
      Parameter.TableRowNumber -> Nothing
      Parameter.ListPointNumber -> Nothing
      Parameter.CurveDegree -> argument 0
      Parameter.CornerCount -> argument 1
      Parameter.ToothCount -> argument 1
      Parameter.TabCount -> Just region

-- | The report of a statement for which the tool has the wrong kind. It points at the keyword with
-- which the statement begins.
wrongCutterReport :: Region -> CutterStatement -> CutterKind -> Report
wrongCutterReport (Region begin _) statement kind =
  (at (Region begin (begin + Text.length keyword)) "E0344" (quote keyword <> " needs " <> needed))
    { message = ["The tool is " <> tool <> "."],
      fixes =
        [ Fix.proposed
            ( Fix.insertion
                ("Change the tool first, for example: " <> change <> ".")
                begin
                (change <> "\n")
            )
        ]
    }
  where
    (keyword, needed, change) = case statement of
      MillStatement -> ("mill", "a mill", "change 2 mill(diameter 5 mm)")
      TurnStatement -> ("turn", "a turning tool", "change 2 turn(nose 0.4 mm)")
      PocketStatement -> ("pocket", "a mill", "change 2 mill(diameter 5 mm)")
      FaceStatement -> ("face", "a mill", "change 2 mill(diameter 50 mm)")
      EngraveStatement -> ("engrave", "a mill", "change 2 mill(diameter 0.5 mm)")
      CarveStatement ->
        ( "vcarve",
          "a V-bit, or a cone that is narrowest at its tip",
          "change 2 vbit(angle 60 deg, tip 0.1 mm, diameter 6 mm)"
        )
      RestStatement -> ("rest", "a mill", "change 2 mill(diameter 5 mm)")
      DrillStatement -> ("drill", "a drill or a mill", "change 2 drill(diameter 5 mm)")
      HoleStatement work -> (HoleForm.word work, neededFor work, toolFor work)
    tool = case kind of
      MillingCutter -> "a mill"
      ConeCutter -> "a cone"
      VBitCutter -> "a V-bit"
      DovetailCutter -> "a cone"
      BladeCutter _ -> "a blade that swivels"
      DrillingCutter -> "a drill"
      TurningCutter -> "a turning tool"
      TappingCutter -> "a tap"
      ThreadCutter _ -> "a thread mill"

-- | The tool that a work on holes needs.
neededFor :: HoleWork -> Text
neededFor work = case work of
  Spotting -> "a drill, a cone or a V-bit"
  Countersinking -> "a drill, a cone or a V-bit"
  Reaming -> "a drill, which also stands for a reamer"
  Counterboring -> "a mill"
  Boring -> "a mill"
  Tapping -> "a tap"
  Threading -> "a thread mill"

-- | A change to a tool for a work on holes.
toolFor :: HoleWork -> Text
toolFor work = case work of
  Spotting -> "change 2 drill(diameter 6 mm, angle 90 deg)"
  Countersinking -> "change 2 drill(diameter 12 mm, angle 90 deg)"
  Reaming -> "change 2 drill(diameter 6 mm)"
  Counterboring -> "change 2 mill(diameter 5 mm)"
  Boring -> "change 2 mill(diameter 5 mm)"
  Tapping -> "change 2 tap(diameter 6 mm)"
  Threading -> "change 2 threadmill(diameter 4 mm, pitch 1 mm)"
