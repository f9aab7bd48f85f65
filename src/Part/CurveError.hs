{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Faults of curves and pieces. Points may make no curve, a shifted curve may turn back or have a
-- gap, and a bevel or a joggle may not fit.
--
-- A piece is a curve that is recalculated by ciphers: each cipher shifts every point of the curve
-- along its normal. A joggle is a local step of the curve, with a ramp at each of its two ends. A
-- bevel is the angle between the surface of the part and the axis of the tool. A section is one
-- line, parabola or arc of a curve that is fitted to a table.
module Part.CurveError
  ( CurveMistake (..),
    Listing (..),
    ListFault (..),
    ControlPointFault (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Rad, degrees, times)
import Base.Region (Region)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Geometry.Curve (KnotFault (..), WeightFault (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ErrorText (Candidate (APoint), below, downTo, listed)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at)

-- | A fault of a curve or a piece. The first field of every constructor is the region of the call,
-- the cipher or the expression. The comment of a constructor names the other fields in order.
data CurveMistake
  = -- | points that make no curve: their source, the region of the row that shows this, and the
    -- reason
    BadPoints Region Listing (Maybe Region) ListFault
  | -- | numbers that describe no Bézier curve or B-spline: the reason
    BadControls Region ControlPointFault
  | -- | a row or a point that does not exist: the number of it, and the number of rows or points
    NoSuchRow Region Listing Int Int
  | -- | a shift by at least the radius of curvature, at which the curve would turn back: the point,
    -- the distance of the shift, and the radius of curvature there
    Folds Region Point Mm Mm
  | -- | a shift of a curve that has a corner: the point, and the angle between the directions
    -- before and after it
    ShiftsCorner Region Point Rad
  | -- | a bevel of 90° or more, or of −90° or less: the number, from 1, of its row in a table, and
    -- the bevel. There is no number if the bevel is the same in all rows
    SteepBevel Region (Maybe Int) Rad
  | -- | a cipher 1 whose second point does not lie after its first point in the direction of the
    -- curve. Between these two points the distance of the shift changes
    GrowthEnds Region
  | -- | an x coordinate of a joggle that does not belong to exactly one point of the piece: this x,
    -- the points that have it, and the least and the greatest x of the piece
    JoggleCoordinate Region Mm [Point] (Mm, Mm)
  | -- | a joggle whose two x coordinates are equal
    JoggleNowhere Region
  | -- | a joggle whose two ramps together are longer than the curve between the joggle's ends: the
    -- joggle's radius, the length of the curve between the ends, and the largest radius that fits.
    -- The last is 'Nothing' if no radius fits
    JoggleRadius Region Mm Mm (Maybe Mm)
  | -- | a joggle whose radius is too small for its depth: the radius, and the limit it must exceed
    JoggleDepth Region Mm Mm
  deriving stock (Eq, Show)

-- | The source of points in the program: the rows of a table, or the points of a list.
data Listing = InTable | InList
  deriving stock (Eq, Show)

-- | The reason why points make no curve. Rows, points and sections are counted from 1.
data ListFault
  = -- | too few points: the number of points, and the number that is needed
    FewPoints Int Int
  | -- | too few different points for a closed curve: the number of them, and the number that is
    -- needed
    FewDifferent Int Int
  | -- | a row with the same point as the row before it: the number of the row, and true if the rows
    -- are two different ones of the program
    SamePoint Int Bool
  | -- | parabolas through an even number of points, although an odd number is needed: the number of
    -- points
    EvenPoints Int
  | -- | a row at which x stops rising, or stops falling: the number of the row
    Unordered Int
  | -- | a section for which the program names neither two nor three rows: the number of the
    -- section, and the count of its rows
    SectionRows Int Int
  | -- | a section whose row numbers do not rise: the number of the section
    SectionOrder Int
  | -- | a section that does not begin with the last row of the section before it: the number of the
    -- section, the row with which it begins, and the row with which it should begin
    SectionJoint Int Int Int
  | -- | sections that do not reach the end of the table: their last row, and the last row of the
    -- table
    SectionEnd Int Int
  | -- | a curve for which the program lists no section
    NoSection
  deriving stock (Eq, Show)

-- | The reason why control points, knots and weights describe no curve.
data ControlPointFault
  = -- | more control points than a Bézier curve can have: the number of them, and the largest
    -- number
    ManyControls Int Int
  | -- | wrong weights for this number of control points
    WrongWeights Int WeightFault
  | WrongKnots KnotFault
  | -- | a curve without length, because all control points that determine it are one point
    OnePoint
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: LengthUnit -> CurveMistake -> Report
toReport unit fault = case fault of
  BadPoints region listing row listFault ->
    (at (fromMaybe region row) "E0349" (listTitle (nounOf listing) listFault))
      { others = [Label region "for this curve" | Just r <- [row], r /= region],
        fixes =
          [ Fix.proposed (Fix.removal ("Leave this " <> nounOf listing <> " out.") r)
            | SamePoint _ True <- [listFault],
              InTable <- [listing],
              Just r <- [row]
          ],
        hints = listHint (nounOf listing) listFault
      }
  BadControls region controlFault ->
    let (title, hint) = controlTexts controlFault in (at region "E0376" title) {hints = [hint]}
  NoSuchRow region listing n count ->
    (at region "E0339" (noRowTitle listing n count)) {message = ["They count from 1." | n < 1]}
  Folds region p asked largest ->
    ( at
        region
        "E0350"
        ( "the curve folds over: at "
            <> Vec.toText unit 3 p
            <> " its radius of curvature is only "
            <> below unit largest
        )
    )
      { message =
          [ "It is shifted there by "
              <> Decimal.inUnit unit asked
              <> " towards the inside of the bend; a curve can be shifted by less than its radius."
          ],
        hints = ["The largest distance that fits there is less than " <> below unit largest <> "."]
      }
  ShiftsCorner region p angle ->
    ( at
        region
        "E0351"
        ( "the curve has a corner of "
            <> Decimal.short (if degrees angle < 0.01 then 6 else 2) (degrees angle)
            <> " deg at "
            <> Vec.toText unit 3 p
        )
    )
      { message = ["A shift would tear it open there, or let its parts cross."],
        hints =
          [ "Lay a spline through the points, a closed_spline if they close, or make a piece of \
            \each part and join them by a link."
          ]
      }
  SteepBevel region row angle ->
    (at region "E0352" (Decimal.short 3 (degrees angle) <> " deg is no bevel"))
      { message = ["In row " <> Decimal.whole k <> " of the table." | Just k <- [row]],
        hints =
          ["The bevel is measured from the axis of the tool; it lies between -90 deg and 90 deg."]
      }
  GrowthEnds region ->
    (at region "E0353" "this change of distance ends before it starts")
      { hints = ["Give the two points in the direction of travel."]
      }
  JoggleCoordinate region x points range -> coordinateReport unit region x points range
  JoggleNowhere region ->
    (at region "E0354" "a joggle needs two different coordinates")
      { controlStop = Just "15074",
        hints = ["Write the x at which the joggle begins and another one at which it ends."]
      }
  JoggleRadius region r available largest -> radiusReport unit region r available largest
  JoggleDepth region r least ->
    (at region "E0355" ("a joggle of radius " <> Decimal.inUnit unit r <> " cannot go so deep"))
      { message =
          [ "Its radius has to be more than half of its depth, "
              <> Decimal.inUnit unit least
              <> "."
          ],
        fixes =
          [ Fix.proposed (Fix.exchange ("Write a larger radius: " <> text <> ".") region text)
            | let text = Decimal.inUnit unit (above unit least)
          ]
      }

-- | The report of a joggle whose coordinate @x@ does not belong to exactly one point of the piece.
-- @low@ and @high@ are the least and the greatest x of the piece.
coordinateReport :: LengthUnit -> Region -> Mm -> [Point] -> (Mm, Mm) -> Report
coordinateReport unit region x points (low, high) =
  (at region "E0354" title)
    { message = [detail],
      controlStop = Just "15074",
      hints = ["A joggle needs x coordinates that the piece passes once."]
    }
  where
    title = case points of
      [] -> "the piece does not come to x = " <> Decimal.inUnit unit x
      _ -> "the piece has more than one point with x = " <> Decimal.inUnit unit x
    detail = case points of
      [] ->
        "It runs from x = " <> Decimal.inUnit unit low <> " to x = "
          <> Decimal.inUnit unit high
          <> "."
      _ -> listed unit (map APoint points)

-- | The report of a joggle with radius @r@ that needs more than the @available@ length of curve
-- between its ends. @largest@ is the largest radius that fits, or 'Nothing' if none fits.
radiusReport :: LengthUnit -> Region -> Mm -> Mm -> Maybe Mm -> Report
radiusReport unit region r available largest =
  (at region "E0355" title)
    { controlStop = Just "14174",
      fixes = foldMap fitting largest,
      hints = [none | null largest]
    }
  where
    title =
      "a joggle of radius "
        <> Decimal.inUnit unit r
        <> " does not fit into "
        <> Decimal.inUnit unit available
        <> " of the piece"
    none =
      "No radius fits: the depth must be less than half of this length, "
        <> downTo unit (times 0.5 available)
        <> "."
    fitting m =
      [ Fix.proposed
          ( Fix.exchange
              ("Write the largest radius that fits: " <> downTo unit m <> ".")
              region
              (downTo unit m)
          )
      ]

-- | A length above a limit, rounded up to three decimals in mm, or four in inches.
above :: LengthUnit -> Mm -> Mm
above unit (Mm x) = Mm (fromIntegral (ceiling (x * steps + 1) :: Int) / steps)
  where
    steps = Decimal.stepsPerMm unit

-- | The title of a report on row or point @n@, which does not exist among @count@ rows or points.
noRowTitle :: Listing -> Int -> Int -> Text
noRowTitle listing n count =
  "the "
    <> (case listing of InTable -> "table"; InList -> "list")
    <> " has no "
    <> nounOf listing
    <> " "
    <> Decimal.whole n
    <> ", it has "
    <> (if count == 0 then "none" else Decimal.whole count)

-- | The word for one member of the source: a row of a table, a point of a list.
nounOf :: Listing -> Text
nounOf listing = case listing of
  InTable -> "row"
  InList -> "point"

-- | The title of a report on points that make no curve. @noun@ is the word for one point, from
-- 'nounOf'.
listTitle :: Text -> ListFault -> Text
listTitle noun fault = case fault of
  FewPoints count least ->
    "a curve needs " <> Decimal.whole least <> " points, " <> thereAre count
  FewDifferent count least ->
    "a closed curve needs " <> Decimal.whole least <> " different points, " <> thereAre count
  SamePoint k _ -> numbered k <> " is the same point as the one before it"
  EvenPoints n -> "parabolas need an odd number of points, there are " <> Decimal.whole n
  Unordered k -> "x does not go on in " <> numbered k <> " as it began"
  SectionRows s n ->
    "section "
      <> Decimal.whole s
      <> " names "
      <> Decimal.whole n
      <> " "
      <> noun
      <> (if n == 1 then "" else "s")
  SectionOrder s -> "the " <> noun <> "s of section " <> Decimal.whole s <> " do not rise"
  SectionJoint s begins needed ->
    "section "
      <> Decimal.whole s
      <> " begins with "
      <> numbered begins
      <> ", not with "
      <> numbered needed
  SectionEnd end count ->
    "the last section ends with "
      <> numbered end
      <> ", not with the last "
      <> noun
      <> ", "
      <> Decimal.whole count
  NoSection -> "a curve of sections needs at least one"
  where
    numbered k = noun <> " " <> Decimal.whole k
    thereAre n = case n of
      0 -> "there are none"
      1 -> "there is only one"
      _ -> "there are only " <> Decimal.whole n

-- | The hints of a report on points that make no curve. @noun@ is the word for one point, from
-- 'nounOf'.
listHint :: Text -> ListFault -> [Text]
listHint noun fault = case fault of
  FewPoints _ _ -> []
  FewDifferent _ _ -> ["The last point, when it is the first again, does not count."]
  SamePoint _ _ -> ["Leave one of the two " <> noun <> "s out."]
  EvenPoints _ ->
    [ "The first parabola goes through "
        <> noun
        <> "s 1 to 3, the next through "
        <> noun
        <> "s 3 to 5, and so on."
    ]
  Unordered _ ->
    ["Sort the " <> noun <> "s by x. A curve that turns back in x is a spline, arcs or a polyline."]
  SectionRows _ _ -> [example]
  SectionOrder _ -> ["Write the " <> noun <> "s in their order: [3, 5, 8]."]
  SectionJoint {} ->
    [ "The first section begins with "
        <> noun
        <> " 1, every other one with the "
        <> noun
        <> " that the one before ends with."
    ]
  SectionEnd _ _ -> []
  NoSection -> [example]
  where
    example = "Two " <> noun <> "s are joined by a line, three by a parabola: [[1, 3], [3, 5, 8]]."

-- | The title and the hint of a report on control points, knots or weights. Knots and weights are
-- counted from 1.
controlTexts :: ControlPointFault -> (Text, Text)
controlTexts fault = case fault of
  ManyControls count most ->
    ( "a Bézier curve has at most " <> Decimal.whole most <> " control points, there are "
        <> Decimal.whole count,
      "Write a bspline: its degree does not depend on the number of points."
    )
  OnePoint ->
    ("all control points are one point", "Give the curve control points that differ.")
  WrongWeights points (WeightCount count) ->
    ( Decimal.whole points <> " control points need " <> Decimal.whole points
        <> " weights, there "
        <> areNumber count,
      "Write one weight for each control point; without weights all of them are 1."
    )
  WrongWeights _ (NoWeight k w) ->
    ( "weight " <> Decimal.whole k <> " is " <> Decimal.short 6 w,
      "Weights are above 0: a larger one draws the curve nearer to its control point."
    )
  WrongWeights _ (UnevenWeights low high) ->
    ( "weights " <> Decimal.whole low <> " and " <> Decimal.whole high <> " differ too much",
      "The largest weight is at most "
        <> Decimal.short 0 Tolerance.weightRatio
        <> " times the smallest."
    )
  WrongKnots knotFault -> knotTexts knotFault

-- | The title and the hint of a report on the knots of a B-spline.
knotTexts :: KnotFault -> (Text, Text)
knotTexts fault = case fault of
  FewControlPoints count ->
    ("there are only " <> Decimal.whole count <> " control points", "Give the curve more of them.")
  KnotCount count needed ->
    ( "this B-spline needs " <> Decimal.whole needed <> " knots, there " <> areNumber count,
      "There is one knot for each control point, and one more than the degree."
    )
  FallingKnot k ->
    ( "knot " <> Decimal.whole k <> " is below the one before it",
      "Write the knots in ascending order; equal ones may follow one another."
    )
  RepeatedKnot k u count most ->
    ( "the knot " <> Decimal.short 9 u <> " occurs " <> Decimal.whole count
        <> " times, first as knot "
        <> Decimal.whole k,
      "Here it may occur " <> Decimal.whole most
        <> (if most == 1 then " time" else " times")
        <> ": at an end as often as the degree and once more, within the curve as often as the \
           \degree."
    )
  NoInterval low high ->
    ( "knots " <> Decimal.whole low <> " and " <> Decimal.whole high <> " are equal",
      "The curve runs from the one to the other; the second has to be larger."
    )

-- | A number of things after the word /there/: /is 1/, /are 5/.
areNumber :: Int -> Text
areNumber n = if n == 1 then "is 1" else "are " <> Decimal.whole n
