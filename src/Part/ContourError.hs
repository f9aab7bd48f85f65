{-# OPTIONS_GHC -O0 #-}

-- | Faults of contours: wrong elements, and links that cannot join their neighbours.
module Part.ContourError
  ( ContourFault (..),
    Neighbours (..),
    LinkFault (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm, Rad, degrees)
import Base.Region (Located (..), Region (end))
import Data.List (nub)
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Carrier (Sense (..))
import Geometry.Construction.Fillet qualified as Fillet
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ErrorText (andMore, at, describe, downTo, stop)
import Part.Tolerance qualified as Tolerance
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), ReportCode, quote)

-- | A fault of a contour. The first field is the region that the report points at, unless the
-- comment of the constructor says otherwise. The comment names the other fields in order.
data ContourFault
  = EmptyContour Region Name
  | -- | a closed contour whose only element is neither a circle nor a closed curve: that element
    LoneElement Region ElementCarrier
  | -- | a contour whose segments are all no longer than 'Geometry.Tolerance.coincident'
    NoLength Region
  | -- | a link after the only element of a contour, although a circle or a closed curve needs none
    LinkOfLoneCircle Region
  | -- | an open contour whose first or last element is a circle, which has no ends: the circle
    NoEnd Region ElementCarrier
  | -- | a link after the last element of an open contour: the region of the contour's first element
    LinkAtEnd Region Region
  | -- | a closed contour as an element of another contour: the name of the closed contour
    ClosedElement Region Name
  | -- | a closed curve as the element of an open contour
    ClosedCurve Region
  | -- | a statement that sets a starting point on an open contour: the name of the contour
    OpenBegins Region Name
  | -- | a link that cannot join its neighbours, whatever the other links do: the neighbours, and
    -- the reason. The report points at the link
    NotLinked Neighbours LinkFault
  | -- | an element that is too short for the links at its two ends: the element, the length by
    -- which it is too short, the regions of these links, and the largest fillet radius that fits.
    -- The radius is 'Nothing' if no link is a fillet or no radius fits
    Overrun Region ElementCarrier Mm [Region] (Maybe Mm)
  | -- | a contour that meets itself: the region of its name, the regions of the two elements that
    -- meet, their common point, and true if the contour has fillets. The report points at the first
    -- of the two elements
    CrossesItself Region Region Region Point Bool
  deriving stock (Eq, Show)

-- | Two neighbouring elements of a contour, and the region of the link between them.
data Neighbours = Neighbours
  { link :: Region,
    before :: {-# UNPACK #-} (Located ElementCarrier),
    after :: {-# UNPACK #-} (Located ElementCarrier)
  }
  deriving stock (Eq, Show)

-- | The reason why a link cannot join its neighbours, the elements before and after it.
data LinkFault
  = -- | the neighbours do not meet: the shortest distance between them
    NoMeeting Mm
  | -- | the neighbours are parallel lines: the distance between them
    ParallelLines Mm
  | SameCurve
  | -- | the neighbours meet in these points, and the link does not say which of them it means
    AmbiguousMeeting [Point]
  | -- | the neighbours of a smooth link cross or lie apart, but do not touch: the distance by which
    -- one of them would have to move to touch the other
    NotSmooth Mm
  | -- | the neighbours of a smooth link touch at a corner: the angle between their directions
    Kinked Rad
  | -- | the neighbours of a smooth link touch, but their directions there are opposite
    TurnsBack
  | TangentNeedsCircles
  | ConcentricTangent
  | CoincidentTangent
  | -- | the circles have no common tangent with the senses that the program writes: the pairs of
    -- senses with which they have one
    NoCommonTangent [(Sense, Sense)]
  | -- | a fillet or a chamfer beside an element that is a point
    FilletAtPoint
  | -- | no arc of the given radius touches both neighbours: this radius, and the largest one that
    -- fits. The latter is 'Nothing' if no smaller radius fits
    NoFillet Sense Mm (Maybe Mm)
  | -- | two fillet arcs make equally long contours: the centres of both arcs
    AmbiguousFillet [Point]
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: ContourFault -> Report
toReport fault = case fault of
  EmptyContour region (Name name) ->
    at region "E0307" ("the contour " <> quote name <> " has no elements")
  LoneElement region carrier ->
    (at region "E0308" ("a closed contour cannot consist of " <> describe carrier <> " alone"))
      { hints =
          [ "Only a circle or a closed curve closes by itself; add the other elements, or \
            \make the contour open."
          ]
      }
  NoLength region ->
    at region "E0328" "the contour has no length"
  LinkOfLoneCircle region ->
    (at region "E0329" "a circle or a closed curve alone needs no link")
      { fixes = [Fix.removal "Leave the link out: it closes by itself." region]
      }
  NoEnd region carrier ->
    (at region "E0309" ("an open contour cannot begin or end on " <> describe carrier))
      { message = ["A circle has no ends; the contour does not know where to begin or stop on it."],
        hints = ["Put a point of the circle before it (or behind it) as an element of its own."]
      }
  LinkAtEnd region contour ->
    (at region "E0310" "nothing follows this link")
      { others = [Label contour "the contour is open"],
        fixes = [Fix.proposed (Fix.removal "Leave the link out." region)],
        hints = ["Or make the contour closed."]
      }
  ClosedElement region (Name name) ->
    ( at
        region
        "E0343"
        ("the contour " <> quote name <> " is closed and cannot be a part of another")
    )
      { hints = ["Only an open contour leads on to the next element."]
      }
  ClosedCurve region ->
    (at region "E0343" "this curve is closed, the contour is not")
      { hints = ["Make the contour closed: contour … closed { … }"]
      }
  OpenBegins region (Name name) ->
    (at region "E0347" ("the contour " <> quote name <> " is open and begins at its first element"))
      { hints =
          [ "Leave ‘start near’ out. To begin at its other end, mill reversed("
              <> name
              <> ") on the other side."
          ]
      }
  NotLinked neighbours linkFault -> linkReport neighbours linkFault
  Overrun region carrier overlap links largest -> overrunReport region carrier overlap links largest
  CrossesItself contour first second p hasFillets ->
    (at first "E0325" "the contour crosses or touches itself")
      { label = "this element",
        others =
          [Label second "meets this one" | second /= first] <> [Label contour "in this contour"],
        message = ["They meet at " <> Vec.toText 4 p <> "."],
        hints =
          [ "Check the signs of the fillets: +R is traversed clockwise, −R counter-clockwise."
            | hasFillets
          ]
      }

-- | The report of an element that is too short for the links at its ends. It is too short by
-- @overlap@. @largest@ is the largest fillet radius that fits, if any fits.
overrunReport :: Region -> ElementCarrier -> Mm -> [Region] -> Maybe Mm -> Report
overrunReport region carrier overlap links largest =
  (at region "E0324" title)
    { label = "it would have to be traversed backwards",
      others = [Label l "this link takes its share" | l <- nub links],
      message = [stop "17535"],
      hints =
        [ maybe
            "Make the fillet or chamfer smaller, or check the directions of the neighbours."
            (\m -> "The largest radius that fits here is " <> downTo m <> ".")
            largest
        ]
    }
  where
    title =
      "the links do not fit: "
        <> describe carrier
        <> " is too short for them by "
        <> Decimal.nonZeroMm overlap

-- | The report of a link that cannot join its neighbours.
linkReport :: Neighbours -> LinkFault -> Report
linkReport j fault = case fault of
  NoMeeting gap ->
    (titled "E0311" (both j <> " do not meet: they miss one another by " <> Decimal.nonZeroMm gap))
      { message = [stop "17533"],
        hints =
          if curved
            then
              [ "A curve ends with the last row of its table, a piece where its curve ends. \
                \Correct the numbers, or join them by a line: line(end_of(a), start_of(b))."
              ]
            else
              [ "Correct the numbers; circles that are apart are joined by tangent or fillet, \
                \and a line begins at the point before it."
              ]
      }
  ParallelLines gap ->
    (titled "E0312" ("these lines are parallel, " <> Decimal.mm gap <> " apart, and do not meet"))
      { message = [stop "17533"],
        hints =
          ["Is an edge between them missing? A closed contour joins its last element to its first."]
      }
  SameCurve ->
    (titled "E0313" "these are the same curve, so they have no one point in common")
      { hints = ["Leave one of them out, or correct the numbers."]
      }
  AmbiguousMeeting points ->
    (titled "E0314" (both j <> " meet in more than one point"))
      { message = [meetingPoints points],
        fixes = map nearFix (take mostPoints points)
      }
  NotSmooth gap ->
    (titled "E0315" (both j <> " do not touch: they miss it by " <> Decimal.mm gap))
      { message = [stop "17533"],
        hints = ["Correct the numbers, or join them with a fillet."]
      }
  Kinked angle ->
    ( titled
        "E0348"
        (both j <> " meet at an angle of " <> Decimal.short 2 (degrees angle) <> " deg")
    )
      { message =
          [ "Smooth neighbours differ in direction by at most "
              <> Decimal.short 2 (degrees Tolerance.smoothTurn)
              <> " deg."
          ],
        hints = ["Correct the numbers, round the corner with a fillet, or leave smooth out."]
      }
  TurnsBack ->
    (titled "E0316" "the elements touch here, but the contour would have to turn back")
      { hints = ["Change the sense (cw, ccw) of a circle or the direction of a line."]
      }
  TangentNeedsCircles
    | curved ->
      (titled "E0317" "a tangent joins circles, not a curve")
        { hints =
            [ "If its neighbour goes on where the curve ends, write smooth; to round the \
              \corner, write fillet and a radius."
            ]
        }
    | otherwise ->
      (titled "E0317" "a tangent joins circles, not a line that is already there")
        { hints =
            [ "If the line touches the circle, write smooth; to round the corner, write \
              \fillet and a radius."
            ]
        }
  ConcentricTangent ->
    (titled "E0318" "concentric circles have no common tangent") {message = [stop "17533"]}
  CoincidentTangent ->
    (titled "E0319" "these circles are the same, so there is no tangent from one to the other")
      { hints = ["Leave one of them out, or correct the centre or the radius of one."]
      }
  NoCommonTangent senses ->
    (titled "E0320" "no common tangent fits the senses in which these circles are traversed")
      { message = [stop "17533"],
        hints = [tangentHint senses]
      }
  FilletAtPoint ->
    ( titled
        "E0321"
        "a fillet or chamfer needs a line, a circle or a curve on both sides, not a point"
    )
      { hints = ["Write the edges as lines: line(p, q)."]
      }
  NoFillet sense r largest ->
    ( titled
        "E0322"
        ( "no arc of radius "
            <> Decimal.mm r
            <> " touches both neighbours in the direction of travel"
        )
    )
      { message = [stop "17535"],
        fixes =
          [ Fix.proposed
              ( Fix.exchange
                  ("Write the largest radius that fits here: " <> downTo m <> ".")
                  (link j)
                  ("fillet " <> (if sense == Clockwise then "" else "-") <> downTo m)
              )
            | Just m <- [largest]
          ],
        hints = filletHints j r
      }
  AmbiguousFillet centres ->
    (titled "E0323" "two fillets make contours of the same length")
      { message =
          [ "Their centres are "
              <> Text.intercalate " and " (map (Vec.toText 4) centres)
              <> "."
          ],
        hints =
          ["Change the order or the senses of the elements so that one of them is the shorter way."]
      }
  where
    titled = linkTitle j
    -- A link without a text has the region of the element behind it.
    (Located ahead _, Located behind _) = (before j, after j)
    nearFix p =
      let words' = "meet near " <> Vec.toText 4 p
          title' = "Write " <> words' <> "."
       in Fix.proposed $
            if link j == behind
              then Fix.insertion title' (end ahead) (" " <> words')
              else Fix.exchange title' (link j) words'
    curved = any isCurve [before j, after j]

-- | An error that points at a link and labels its two neighbours.
linkTitle :: Neighbours -> ReportCode -> Text -> Report
linkTitle j code title =
  (at (link j) code title)
    { others = [Label r (describe carrier) | Located r carrier <- [before j, after j], r /= link j]
    }

-- | The descriptions of two neighbours, joined by "and".
both :: Neighbours -> Text
both j = describe (value (before j)) <> " and " <> describe (value (after j))

isCurve :: Located ElementCarrier -> Bool
isCurve (Located _ carrier) = case carrier of
  OnCurve _ -> True
  OnLine _ -> False
  OnCircle _ _ -> False
  AtPoint _ -> False

-- | The sentence that lists the points in which two neighbours meet. It lists at most 'mostPoints'.
meetingPoints :: [Point] -> Text
meetingPoints points =
  "They meet at "
    <> Text.intercalate
      (if length points > mostPoints then ", " else " and at ")
      (map (Vec.toText 4) (take mostPoints points))
    <> andMore mostPoints points
    <> "."

-- | The largest number of points that a report lists.
mostPoints :: Int
mostPoints = 6

-- | The hint that names the pairs of senses with which the circles have a common tangent. If
-- @senses@ is empty, they have none.
tangentHint :: [(Sense, Sense)] -> Text
tangentHint senses = case senses of
  [] ->
    "One circle lies inside the other: there is no common tangent at all. Join them with a fillet."
  _ ->
    "There is one when they are traversed " <> Text.intercalate ", or " (map pairText senses) <> "."
  where
    pairText (first, second) = senseText first <> " then " <> senseText second
    senseText sense = case sense of
      Clockwise -> "cw"
      CounterClockwise -> "ccw"

-- | The hints for a fillet of radius @r@ that does not fit.
filletHints :: Neighbours -> Mm -> [Text]
filletHints j r =
  [ "With the other sign there is one: fillet " <> signed <> "."
    | Just signed <- [otherSign j r]
  ]
    <> [ "+R is traversed clockwise, −R counter-clockwise; check the sign, the radius, and the \
         \senses of the neighbours."
       ]

-- | The text of the radius @r@ with the sign that makes the fillet fit. A positive sign means a
-- clockwise arc. 'Nothing' if both signs fit or neither.
otherSign :: Neighbours -> Mm -> Maybe Text
otherSign j r = case (fits Clockwise, fits CounterClockwise) of
  (True, False) -> Just (Decimal.mm r)
  (False, True) -> Just ("-" <> Decimal.mm r)
  (True, True) -> Nothing
  (False, False) -> Nothing
  where
    fits sense = not (null (Fillet.between r sense (value (before j)) (value (after j))))
