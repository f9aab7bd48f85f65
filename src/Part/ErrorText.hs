-- | The phrases that all reports on a part share. They name elements and the answers of
-- constructions, and give limits rounded to three decimals.
module Part.ErrorText
  ( alternatively,
    describe,
    Candidate (..),
    listed,
    described,
    andMore,
    below,
    downTo,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), degrees)
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Carrier (Circle (..), Line (..))
import Geometry.Carrier qualified as Carrier
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
describe :: ElementCarrier -> Text
describe carrier = case carrier of
  OnLine l -> describeLine l
  OnCircle _ c -> describeCircle c
  OnCurve c ->
    "the curve from "
      <> Vec.toText 4 (MeasuredPolyarc.start c)
      <> " to "
      <> Vec.toText 4 (MeasuredPolyarc.end c)
  AtPoint p -> "the point " <> Vec.toText 4 p

-- | The description of a line. A line of the length 1 is made by a function that fixes no ends; it
-- is named by a point and its direction.
describeLine :: Line -> Text
describeLine l@(Line p q)
  | abs (length' - 1) > noise = "the line from " <> Vec.toText 4 p <> " to " <> Vec.toText 4 q
  | abs (Vec.y p - Vec.y q) < noise = "the line y = " <> Decimal.short 4 (Vec.y p)
  | abs (Vec.x p - Vec.x q) < noise = "the line x = " <> Decimal.short 4 (Vec.x p)
  | otherwise =
    "the line through "
      <> Vec.toText 4 p
      <> " at "
      <> Decimal.short 4 (degrees (Vec.angle (Carrier.direction l)))
      <> " deg"
  where
    Mm length' = Vec.distance p q
    Mm noise = Tolerance.coincident

describeCircle :: Circle -> Text
describeCircle (Circle c r) =
  "the circle of radius " <> Decimal.mm r <> " about " <> Vec.toText 4 c

-- | One of the answers to a construction, for a report.
data Candidate = APoint Point | ALine Line | ACircle Circle
  deriving stock (Eq, Show)

-- | The sentence that lists the answers of a construction with their coordinates. It lists at most
-- 'mostCandidates'.
listed :: [Candidate] -> Text
listed candidates = case candidates of
  [] -> "There is none."
  [one] -> "There is only " <> described one <> "."
  _
    | length candidates > mostCandidates ->
      "There are "
        <> Text.intercalate ", " (map described (take mostCandidates candidates))
        <> andMore mostCandidates candidates
        <> "."
  _ ->
    "There are "
      <> Text.intercalate ", " (map described (init candidates))
      <> " and "
      <> described (last candidates)
      <> "."

-- | The words for an answer.
described :: Candidate -> Text
described candidate = case candidate of
  APoint p -> Vec.toText 4 p
  ALine l -> describeLine l
  ACircle c -> describeCircle c

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

-- | The text of a limit in mm that values must stay below. The limit is rounded down to three
-- decimals. 'Tolerance.coincident' is added first, so that a rounding error does not turn 5 into
-- 4.999.
below :: Mm -> Text
below (Mm x) = downTo (Mm (x + noise))
  where
    Mm noise = Tolerance.coincident

-- | The text of a limit in mm that values may reach. The limit is rounded down to three decimals.
downTo :: Mm -> Text
downTo (Mm x) = Decimal.mm (Mm (fromIntegral (floor (x * 1000) :: Int) / 1000))
