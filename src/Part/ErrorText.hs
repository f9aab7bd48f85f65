-- | The phrases that all reports on a part share. They name elements and the answers of
-- constructions, and give limits rounded to three decimals.
module Part.ErrorText
  ( alternatively,
    describe,
    Candidate (..),
    listed,
    described,
    andMore,
    meetingPoints,
    mostPoints,
    nested,
    below,
    downTo,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), degrees)
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Carrier (Circle (..), Line (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Fix (Fix)

-- | The text of a hint that stands below fixes as another way. Without fixes it is the hint alone;
-- the hint is a sentence that begins with a capital letter.
alternatively :: [Fix] -> Text -> Text
alternatively fixes hint
  | null fixes = hint
  | otherwise = "Or " <> Text.toLower (Text.take 1 hint) <> Text.drop 1 hint

-- | The description of an element's carrier, with its coordinates.
describe :: LengthUnit -> ElementCarrier -> Text
describe unit carrier = case carrier of
  OnLine l -> describeLine unit l
  OnCircle _ c -> describeCircle unit c
  OnCurve c ->
    "the curve from "
      <> Vec.toText unit 4 (MeasuredPolyarc.start c)
      <> " to "
      <> Vec.toText unit 4 (MeasuredPolyarc.end c)
  AtPoint p -> "the point " <> Vec.toText unit 4 p

-- | The description of a line. A line of the length 1 is made by a function that fixes no ends; it
-- is named by a point and its direction.
describeLine :: LengthUnit -> Line -> Text
describeLine unit l@(Line p q)
  | abs (length' - 1) > noise =
    "the line from " <> Vec.toText unit 4 p <> " to "
      <> Vec.toText unit 4 q
  | abs (Vec.y p - Vec.y q) < noise = "the line y = " <> Decimal.shortIn unit 4 (Mm (Vec.y p))
  | abs (Vec.x p - Vec.x q) < noise = "the line x = " <> Decimal.shortIn unit 4 (Mm (Vec.x p))
  | otherwise =
    "the line through "
      <> Vec.toText unit 4 p
      <> " at "
      <> Decimal.short 4 (degrees (Vec.angle (Carrier.direction l)))
      <> " deg"
  where
    Mm length' = Vec.distance p q
    Mm noise = Tolerance.coincident

describeCircle :: LengthUnit -> Circle -> Text
describeCircle unit (Circle c r) =
  "the circle of radius " <> Decimal.inUnit unit r <> " about " <> Vec.toText unit 4 c

-- | One of the answers to a construction, for a report.
data Candidate = APoint Point | ALine Line | ACircle Circle
  deriving stock (Eq, Show)

-- | The sentence that lists the answers of a construction with their coordinates. It lists at most
-- 'mostCandidates'.
listed :: LengthUnit -> [Candidate] -> Text
listed unit candidates = case candidates of
  [] -> "There is none."
  [one] -> "There is only " <> described unit one <> "."
  _
    | length candidates > mostCandidates ->
      "There are "
        <> Text.intercalate ", " (map (described unit) (take mostCandidates candidates))
        <> andMore mostCandidates candidates
        <> "."
  _ ->
    "There are "
      <> Text.intercalate ", " (map (described unit) (init candidates))
      <> " and "
      <> described unit (last candidates)
      <> "."

-- | The words for an answer.
described :: LengthUnit -> Candidate -> Text
described unit candidate = case candidate of
  APoint p -> Vec.toText unit 4 p
  ALine l -> describeLine unit l
  ACircle c -> describeCircle unit c

-- | The largest number of answers that a report lists. This is also the largest number of circles
-- of one radius that can touch two given circles.
mostCandidates :: Int
mostCandidates = 8

-- | The words that end a list of at most @most@ of the given answers: " and 3 more" if the list
-- leaves out 3 answers. Empty if it leaves out none.
andMore :: Int -> [a] -> Text
andMore most answers = case length answers - most of
  n | n > 0 -> " and " <> Decimal.whole n <> " more"
  _ -> ""

-- | The sentence that lists the points in which two neighbours meet. It lists at most 'mostPoints'.
meetingPoints :: LengthUnit -> [Point] -> Text
meetingPoints unit points =
  "They meet at "
    <> Text.intercalate
      (if length points > mostPoints then ", " else " and at ")
      (map (Vec.toText unit 4) (take mostPoints points))
    <> andMore mostPoints points
    <> "."

-- | The largest number of points that a report lists.
mostPoints :: Int
mostPoints = 6

-- | The sentence that one circle lies inside the other. 'Nothing' for other circles.
nested :: LengthUnit -> Circle -> Circle -> Maybe [Text]
nested unit c d
  | Intersection.Apart _ <- Intersection.circles c d,
    apart < max (radius c) (radius d) =
    Just
      [ "One circle lies inside the other: their centres are "
          <> Decimal.inUnit unit apart
          <> " apart, and their radii are "
          <> Decimal.inUnit unit (radius c)
          <> " and "
          <> Decimal.inUnit unit (radius d)
          <> "."
      ]
  | otherwise = Nothing
  where
    apart = Vec.distance (centre c) (centre d)

-- | The text of a limit that values must stay below. The limit is rounded down to three decimals in
-- mm, or four in inches. 'Tolerance.coincident' is added first, so that a rounding error does not
-- turn 5 into 4.999.
below :: LengthUnit -> Mm -> Text
below unit (Mm x) = downTo unit (Mm (x + noise))
  where
    Mm noise = Tolerance.coincident

-- | The text of a limit that values may reach. The limit is rounded down to three decimals in mm,
-- or four in inches.
downTo :: LengthUnit -> Mm -> Text
downTo unit x = Decimal.inUnit unit (Decimal.roundedDown unit x)
