{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

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
import Base.Quantity (LengthUnit, Mm (..))
import Base.Region (Region (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Carrier qualified as Carrier
import Geometry.ElementCarrier (ElementCarrier)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ErrorText (Candidate (..), describe, described, listed)
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Report (..), at)

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
  | -- | a tangent of which there are several: each line, and for each of the two arguments whether
    -- the circle lies on the left of the line. This is 'Nothing' if the argument is a point, or if
    -- the program writes the side
    SeveralTangents Region Sought [(Candidate, [Maybe Bool])]
  | -- | a choice that excludes every answer: all answers
    NoneFits Region Sought [Candidate]
  | -- | a choice that leaves several answers: these answers. For @near@ with two answers that are
    -- equally near: all answers of the construction
    SeveralFit Region Sought [Candidate]
  | -- | a construction without an answer: the reason
    NoAnswer Region NoAnswer
  | -- | the point of contact of figures that do not touch: the least distance by which one of them
    -- would have to move, so that they touch, and the points in which they cross
    NotTouching Region Mm [Point]
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

-- | The report of a fault. @arguments@ are the regions of the arguments of the call.
toReport :: LengthUnit -> [Region] -> ConstructionFault -> Report
toReport unit arguments fault = case fault of
  NothingCommon region a b gap ->
    (at region "E0330" (describe unit a <> " and " <> describe unit b <> " do not meet"))
      { message = ["They are " <> Decimal.nonZeroIn unit gap <> " apart."],
        hints = ["Correct the numbers of one of the two, so that they meet."]
      }
  SameThing region ->
    (at region "E0331" "both are the same curve, so they have no one point in common")
      { hints = ["Write two different ones."]
      }
  Several region sought candidates ->
    (at region "E0332" (manyTitle sought (length candidates)))
      { message = [listed unit candidates],
        fixes = concatMap (chosenNear unit region arguments sought) candidates,
        hints = [choiceHint sought]
      }
  SeveralTangents region sought answers ->
    (at region "E0332" (manyTitle sought (length answers)))
      { message = [listed unit (map fst answers)],
        fixes = concatMap (uncurry (chosenBySides unit arguments)) answers,
        hints = [choiceHint sought]
      }
  NoneFits region sought candidates ->
    (at region "E0333" ("no such " <> nameOf sought <> " lies where the choice looks for it"))
      { message = [listed unit candidates],
        fixes = concatMap (chosenNear unit region arguments sought) candidates
      }
  SeveralFit region sought candidates ->
    (at region "E0334" ("the choice leaves more than one " <> nameOf sought))
      { message = [listed unit candidates],
        fixes = concatMap (chosenNear unit region arguments sought) candidates,
        hints = ["Choose by something that only one of them has."]
      }
  NoAnswer region reason ->
    let (result, why) = noAnswerTexts unit reason
     in (at region "E0335" ("there is no such " <> result))
          { message = [why],
            fixes = limitFixes unit arguments reason,
            hints = [remedyText unit reason | null (limitFixes unit arguments reason)]
          }
  NotTouching region gap points ->
    (at region "E0336" ("these do not touch: they miss it by " <> Decimal.inUnit unit gap))
      { fixes = map (crossingFix unit region) points,
        hints = ["Correct the numbers, so that they touch."]
      }
  OnOneLine region ->
    (at region "E0337" "the three points lie on one line, and no circle goes through them")
      { hints = ["Correct the coordinates of one of them."]
      }

-- Fixes

-- | Fix that chooses one answer of a call by a point near it. The choice takes the place of the one
-- that the program writes behind the arguments, if there is one.
chosenNear :: LengthUnit -> Region -> [Region] -> Sought -> Candidate -> [Fix]
chosenNear unit region arguments sought candidate =
  [ Fix.proposed
      ( Fix.exchange
          ("Write " <> words' <> ".")
          (Region (end figure) (end region - 1))
          (", " <> words')
      )
    | Just p <- [keyPoint],
      let words' = "near " <> Vec.toText unit 4 p,
      figure : _ <- [drop (if sought == SoughtCircle then 2 else 1) arguments]
  ]
  where
    keyPoint = case candidate of
      APoint p -> Just p
      ACircle c -> Just (Carrier.centre c)
      ALine _ -> Nothing

-- | Fix that chooses a tangent by the sides on which the circles lie: the words left and right
-- before the arguments.
chosenBySides :: LengthUnit -> [Region] -> Candidate -> [Maybe Bool] -> [Fix]
chosenBySides unit arguments candidate sides =
  [ Fix.proposed . Fix.joined title' $
      [ Fix.insertion "" (start at') (word <> " ")
        | (at', Just isLeft) <- zip arguments sides,
          let word = sideWord isLeft
      ]
    | not (null sideWords)
  ]
  where
    title' =
      "Choose "
        <> described unit candidate
        <> ": write "
        <> Text.intercalate " and " sideWords
        <> "."
    sideWords = case [sideWord isLeft | Just isLeft <- sides] of
      [a, b] -> [a <> " before the first circle", b <> " before the second"]
      words' -> map (<> " before the circle") words'
    sideWord isLeft = if isLeft then "left" else "right"

-- | Fixes of an argument that lies beyond the ends of a curve: the number at each end.
limitFixes :: LengthUnit -> [Region] -> NoAnswer -> [Fix]
limitFixes unit arguments reason = case (reason, drop 1 arguments) of
  (OutsideCurve (Mm low) (Mm high), argument : _) ->
    [limit argument (rounded ceiling low), limit argument (rounded floor high)]
  (BeyondLength (Mm l), argument : _) -> [limit argument (rounded floor l)]
  _ -> []
  where
    limit argument x =
      let text = Decimal.inUnit unit (Mm x)
       in Fix.proposed (Fix.exchange ("Write " <> text <> ".") argument text)
    -- Rounds to three decimals in mm, or four in inches, towards the curve.
    rounded :: (Double -> Int) -> Double -> Double
    rounded towards x
      | abs (x - nearest) < 1e-9 = nearest
      | otherwise = fromIntegral (towards (x * steps)) / steps
      where
        nearest = fromIntegral (round (x * steps) :: Int) / steps
    steps = Decimal.stepsPerMm unit

-- | Fix that writes an intersection near a point in place of a point of tangency.
crossingFix :: LengthUnit -> Region -> Point -> Fix
crossingFix unit region p =
  Fix.proposed
    . Fix.joined
      ( "They cross: write intersection and near " <> Vec.toText unit 4 p
          <> "."
      )
    $ [ Fix.exchange "" name "intersection",
        Fix.insertion "" (end region - 1) (", near " <> Vec.toText unit 4 p)
      ]
  where
    name = Region (start region) (start region + Text.length "tangency")

-- Words

-- | The name that a report uses for a kind of result.
nameOf :: Sought -> Text
nameOf sought = case sought of
  SoughtPoint -> "point"
  SoughtTangency -> "point of tangency"
  SoughtLine -> "line"
  SoughtCircle -> "circle"

-- | The title of a report on a construction with @count@ answers.
manyTitle :: Sought -> Int -> Text
manyTitle sought count = "there are " <> Decimal.whole count <> " such " <> many sought

-- | The plural of the name of a kind of result.
many :: Sought -> Text
many sought = case sought of
  SoughtPoint -> "points"
  SoughtTangency -> "points of tangency"
  SoughtLine -> "lines"
  SoughtCircle -> "circles"

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
noAnswerTexts :: LengthUnit -> NoAnswer -> (Text, Text)
noAnswerTexts unit reason = case reason of
  NothingTouches sought ->
    ( nameOf sought,
      "No "
        <> nameOf sought
        <> " of this size touches both things on these sides, or goes through them."
    )
  LinesNotParallel -> ("distance", "These lines are not parallel.")
  ZeroVector -> ("direction", "The vector has no length.")
  NoTangent sought obstacle -> (nameOf sought, obstacleText unit obstacle)
  OutsideCurve low high ->
    ( "point",
      "The curve runs from x = " <> Decimal.inUnit unit low <> " to x = "
        <> Decimal.inUnit unit high
        <> "."
    )
  BeyondLength l -> ("point", "The curve is " <> Decimal.inUnit unit l <> " long.")

-- | The sentence of a report that says how there would be an answer.
remedyText :: LengthUnit -> NoAnswer -> Text
remedyText unit reason = case reason of
  NoTangent _ (PointInside depth) ->
    "Move the point outwards by at least " <> Decimal.inUnit unit depth
      <> ", or take a smaller circle."
  NoTangent _ (CirclesOverlap overlap) ->
    "Move the circles apart by more than "
      <> Decimal.inUnit unit overlap
      <> ", or take smaller ones, or the tangent on the same side of both."
  NoTangent _ CircleInCircle -> "Correct the centre or the radius of one of them."
  NothingTouches _ -> "Correct the size, or the sides."
  _ -> "Correct the numbers."

-- | The sentence of a report that explains why there is no common tangent.
obstacleText :: LengthUnit -> TangentObstacle -> Text
obstacleText unit obstacle = case obstacle of
  SamePoints -> "The points are the same."
  PointOnCircle p ->
    "The point "
      <> Vec.toText unit 4 p
      <> " lies on the circle; the line that touches it there is perpendicular to its radius."
  PointInside depth ->
    "The point lies inside the circle, " <> Decimal.inUnit unit depth <> " from its edge."
  SameCircles -> "The circles are the same."
  CircleInCircle -> "One circle lies inside the other."
  CirclesOverlap overlap -> "The circles overlap by " <> Decimal.inUnit unit overlap <> "."
