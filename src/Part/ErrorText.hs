-- | The texts of elements, answers, limits and control stops of the Minsk-22 system. All reports on
-- a part use them.
module Part.ErrorText
  ( at,
    describe,
    Candidate (..),
    listed,
    andMore,
    below,
    downTo,
    stop,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Base.Region (Region)
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Carrier (Circle (..), Line (..))
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Report (Report (..), ReportCode, ReportPlace (..), report)
import Report.Report qualified as Report

-- | The report of an error, from its region, its code and its title.
at :: Region -> ReportCode -> Text -> Report
at region code = report Report.Error code (InSource region)

-- | An element in words, with its coordinates.
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

describeLine :: Line -> Text
describeLine (Line p q) = "the line from " <> Vec.toText 4 p <> " to " <> Vec.toText 4 q

describeCircle :: Circle -> Text
describeCircle (Circle c r) =
  "the circle of radius " <> Decimal.mm r <> " about " <> Vec.toText 4 c

-- | One of the answers to a construction.
data Candidate = APoint Point | ALine Line | ACircle Circle
  deriving stock (Eq, Show)

-- | A sentence with the coordinates of the answers, at most 'mostCandidates' of them.
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
  where
    described candidate = case candidate of
      APoint p -> Vec.toText 4 p
      ALine l -> describeLine l
      ACircle c -> describeCircle c

-- | The largest number of answers in a report: eight circles of one radius can touch two circles.
mostCandidates :: Int
mostCandidates = 8

-- | The words for the answers that a report leaves out, given how many it lists. Empty if it lists
-- all of them.
andMore :: Int -> [a] -> Text
andMore most answers = case length answers - most of
  n | n > 0 -> " and " <> Decimal.whole n <> " more"
  _ -> ""

-- | An upper limit that is itself not allowed, rounded down to three decimals. It adds
-- 'Tolerance.coincident' first: a whole number with a small error of rounding then stays whole.
below :: Mm -> Text
below (Mm x) = downTo (Mm (x + noise))
  where
    Mm noise = Tolerance.coincident

-- | An upper limit that is allowed, rounded down to three decimals.
downTo :: Mm -> Text
downTo (Mm x) = Decimal.mm (Mm (fromIntegral (floor (x * 1000) :: Int) / 1000))

-- | The sentence for a control stop of the Minsk-22 system.
stop :: Text -> Text
stop number = "The Minsk-22 system stopped here with " <> number <> "."
