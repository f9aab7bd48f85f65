{-# OPTIONS_GHC -O0 #-}

-- | Faults of constructions that have no answer, or several answers of which the program does not
-- choose one. The constructions are intersections, tangents, circles, points of a curve, distances
-- and directions.
module Part.ConstructionError
  ( ConstructionFault (..),
    Sought (..),
    NoAnswer (..),
    TangentObstacle (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm)
import Base.Region (Region)
import Data.Text (Text)
import Geometry.ElementCarrier (ElementCarrier)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ErrorText (Candidate, at, describe, listed)
import Report.Report (Report (..))

-- | A fault of a construction. The first field of every constructor is the region of the function
-- call. A 'Sought' is the kind of result that was wanted. The comment of a constructor names the
-- other fields in order.
data ConstructionFault
  = -- | two figures without a common point: both figures, and the shortest distance between them
    NothingCommon Region ElementCarrier ElementCarrier Mm
  | -- | the intersection or the point of contact of two figures that coincide
    SameThing Region
  | -- | a construction with several answers, for which the program chooses none: these answers
    Several Region Sought [Candidate]
  | -- | a choice that excludes every answer: all answers
    NoneFits Region Sought [Candidate]
  | -- | a choice that leaves several answers: these answers. For @near@ with two answers that are
    -- equally near: all answers of the construction
    SeveralFit Region Sought [Candidate]
  | -- | a construction without an answer: the reason
    NoAnswer Region NoAnswer
  | -- | the point of contact of figures that do not touch: the least distance by which one of them
    -- would have to move, so that they touch
    NotTouching Region Mm
  | -- | a circle through three points that lie on one line
    OnOneLine Region
  deriving stock (Eq, Show)

-- | The kind of result that a construction looks for.
data Sought = SoughtPoint | SoughtTangency | SoughtLine | SoughtCircle
  deriving stock (Eq, Show)

-- | The reason why a construction has no answer. 'Sought' is the kind of result that is missing.
data NoAnswer
  = -- | no circle of the given radius touches both figures on the sides that the program demands
    NothingTouches Sought
  | -- | the distance between two lines that are not parallel was requested
    LinesNotParallel
  | -- | the direction of a vector of length 0 was requested
    ZeroVector
  | -- | two circles, or a point and a circle, have no common tangent: the reason
    NoTangent Sought TangentObstacle
  | -- | the curve has no point with the given x: the least and the greatest x of the curve
    OutsideCurve Mm Mm
  | -- | the given arc length is negative or exceeds the length of the curve: the length of the
    -- curve
    BeyondLength Mm
  deriving stock (Eq, Show)

-- | The reason why two circles, or a point and a circle, have no common tangent.
data TangentObstacle
  = SamePoints
  | PointOnCircle Point
  | -- | a point that lies inside the circle: its depth, that is, its distance from the circle
    PointInside Mm
  | SameCircles
  | CircleInCircle
  | -- | circles that intersect: the sum of their radii minus the distance between their centres
    CirclesOverlap Mm
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: ConstructionFault -> Report
toReport fault = case fault of
  NothingCommon region a b gap ->
    (at region "E0330" (describe a <> " and " <> describe b <> " do not meet"))
      { message = ["They miss one another by " <> Decimal.nonZeroMm gap <> "."]
      }
  SameThing region ->
    at region "E0331" "these are the same curve, so they have no one point in common"
  Several region sought candidates ->
    (at region "E0332" ("there is more than one such " <> nameOf sought))
      { message = [listed candidates],
        hints = [choiceHint sought]
      }
  NoneFits region sought candidates ->
    (at region "E0333" ("no such " <> nameOf sought <> " is where it is sought"))
      { message = [listed candidates]
      }
  SeveralFit region sought candidates ->
    (at region "E0334" ("the choice leaves more than one " <> nameOf sought))
      { message = [listed candidates],
        hints = ["Choose by something that only one of them has."]
      }
  NoAnswer region reason ->
    let (result, why) = noAnswerTexts reason
     in (at region "E0335" ("there is no such " <> result)) {message = [why]}
  NotTouching region gap ->
    (at region "E0336" ("these do not touch: they miss it by " <> Decimal.mm gap))
      { hints = ["For the points in which they cross, write intersection."]
      }
  OnOneLine region ->
    at region "E0337" "no circle goes through three points of one line"

-- | The name that a report uses for a kind of result.
nameOf :: Sought -> Text
nameOf sought = case sought of
  SoughtPoint -> "point"
  SoughtTangency -> "point of tangency"
  SoughtLine -> "line"
  SoughtCircle -> "circle"

-- | The hint of a report that tells the user how to choose one of several answers.
choiceHint :: Sought -> Text
choiceHint sought = case sought of
  SoughtLine -> bySides
  SoughtTangency -> bySides
  SoughtPoint -> byThings <> ", first or last along a line."
  SoughtCircle -> byThings <> "."
  where
    bySides =
      "Say for each circle on which side of the directed line it lies: left C or right C."
    byThings =
      "Choose one that stays right when the part is turned: near P, left L or right L (of a \
      \directed line), inside C or outside C"

-- | The two texts of a report on a missing answer: the name of the result, and the sentence with
-- the reason.
noAnswerTexts :: NoAnswer -> (Text, Text)
noAnswerTexts reason = case reason of
  NothingTouches sought ->
    ( nameOf sought,
      "No "
        <> nameOf sought
        <> " of this size touches both things on these sides, or goes through them."
    )
  LinesNotParallel -> ("distance", "These lines are not parallel.")
  ZeroVector -> ("direction", "The vector has no length.")
  NoTangent sought obstacle -> (nameOf sought, obstacleText obstacle)
  OutsideCurve low high ->
    ( "point",
      "The curve runs from x = " <> Decimal.mm low <> " to x = " <> Decimal.mm high <> "."
    )
  BeyondLength l -> ("point", "The curve is " <> Decimal.mm l <> " long.")

-- | The sentence of a report that explains why there is no common tangent.
obstacleText :: TangentObstacle -> Text
obstacleText obstacle = case obstacle of
  SamePoints -> "The points are the same."
  PointOnCircle p ->
    "The point "
      <> Vec.toText 4 p
      <> " lies on the circle; the line that touches it there is perpendicular to its radius."
  PointInside depth ->
    "The point lies inside the circle, " <> Decimal.mm depth <> " from its edge."
  SameCircles -> "The circles are the same."
  CircleInCircle -> "One circle lies inside the other."
  CirclesOverlap overlap -> "The circles overlap by " <> Decimal.mm overlap <> "."
