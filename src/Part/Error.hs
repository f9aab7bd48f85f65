-- | What can be wrong with the values and the geometry of a part.
module Part.Error
  ( Error (..),
    ValueFact (..),
    Listing (..),
    Candidate (..),
    ListFault (..),
    joined',
    Joined (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm (..), Rad (..), degrees, times)
import Base.Region (Located (..), Region)
import Data.List (nub)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Carrier (Circle (..), Line (..), Sense (..))
import Geometry.Construction.Fillet qualified as Fillet
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.PocketError (PocketMisfit)
import Part.PocketError qualified as PocketError
import Part.Tolerance qualified as Tolerance
import Report.Report (Label (..), Report (..), ReportCode, ReportPlace (..), quote, report)
import Report.Report qualified as Report

-- | A fact, and the calls of functions through which it came about, the innermost first.
data Error = Error {fact :: ValueFact, calls :: [Region]}
  deriving stock (Eq, Show)

-- | Two neighbours in a contour, and the link between them.
data Joined = Joined
  { link :: Region,
    before :: {-# UNPACK #-} (Located ElementCarrier),
    after :: {-# UNPACK #-} (Located ElementCarrier)
  }
  deriving stock (Eq, Show)

-- | One of several answers.
data Candidate = APoint Point | ALine Line | ACircle Circle
  deriving stock (Eq, Show)

-- | What points stand in: the rows of a table, or a list.
data Listing = InTable | InList
  deriving stock (Eq, Show)

-- | Why points make no curve.
data ListFault
  = -- | how many there are, how many are needed
    FewPoints Int Int
  | -- | of a curve that closes: how many different ones there are, how many are needed
    FewDifferent Int Int
  | -- | this row is the point of the one before
    SamePoint Int
  | EvenPoints Int
  | -- | x does not go on in this row as it began
    Unordered Int
  | -- | a section by its number, and how many rows it has
    SectionRows Int Int
  | SectionOrder Int
  | -- | the row with which a section begins, and with which it must
    SectionJoint Int Int Int
  | -- | the last row of the sections, and of the table
    SectionEnd Int Int
  | NoSection
  deriving stock (Eq, Show)

data ValueFact
  = DivisionByZero Region
  | -- | function, its argument as written to the user, the range it takes
    OutOfRange Region Text Text Text
  | -- | a result that no number can hold
    TooLarge Region
  | -- | a length, radius or coordinate beyond what any machine reaches, and that limit
    OutOfReach Region Mm
  | -- | the evaluation would take more steps than this
    TooMuchWork Region Int
  | RadiusNotPositive Region Mm
  | -- | the two points of the line are one
    ZeroLine Region Point
  | -- | what has to be positive, and what it is
    NotPositive Region Text Text
  | EmptyContour Region Name
  | -- | a closed contour of one element that is no circle
    LoneElement Region ElementCarrier
  | -- | a contour of which nothing is left to walk
    NoLength Region
  | -- | a link behind a circle that closes by itself
    LinkOfLoneCircle Region
  | -- | an open contour whose first or last element has no end of its own
    NoEnd Region ElementCarrier
  | LinkAtEnd Region Region
  | -- | they miss one another by so much
    NoMeeting Joined Mm
  | ParallelLines Joined Mm
  | SameCurve Joined
  | -- | the points to choose from
    AmbiguousMeeting Joined [Point]
  | NotSmooth Joined Mm
  | -- | they meet at this angle
    Kinked Joined Rad
  | -- | they touch, but the walk would have to turn back
    TurnsBack Joined
  | -- | a tangent needs circles or points
    TangentNeedsCircles Joined
  | -- | the circles are concentric
    ConcentricTangent Joined
  | -- | the circles are the same
    CoincidentTangent Joined
  | -- | how to walk the circles for there to be one
    NoTangent Joined [Text]
  | FilletAtPoint Joined
  | -- | the radius, and the largest that fits
    NoFillet Joined Mm (Maybe Mm)
  | -- | centres of the arcs that make equally long contours
    AmbiguousFillet Joined [Point]
  | -- a fillet among them that fits

    -- | an element whose end lies before its beginning, by so much; the links at its ends; the
    -- largest radius of
    Overrun Region ElementCarrier Mm [Region] (Maybe Mm)
  | -- | a curve that two things do not have in common: they miss one another by so much
    NothingCommon Region ElementCarrier ElementCarrier Mm
  | -- | two things that are the same curve
    SameThing Region
  | -- | several answers and no choice among them: what is sought, the answers
    Several Region Text [Candidate]
  | -- | answers of which none is as asked
    NoneFits Region Text [Candidate]
  | -- | several answers that are all as asked
    SeveralFit Region Text [Candidate]
  | -- | there is no such line, circle or point: what, and why
    NoAnswer Region Text Text
  | -- | things that do not touch, by so much
    NotTouching Region Mm
  | -- | three points on one line
    OnOneLine Region
  | -- | what has to be a whole number within a range, as it is
    NotWhole Region Text Text Double
  | -- | the number of an item, and how many there are
    NoSuchItem Region Int Int
  | -- | the number of a row of a table or a point of a list, and how many there are
    NoSuchRow Region Listing Int Int
  | StepOfZero Region
  | -- | what must not be negative, and what it is
    Negative Region Text Text
  | NothingToDrill Region
  | -- | an assertion that does not hold; the values that it compares
    DoesNotHold Region [(Region, Text)]
  | -- | two values that should agree: as written, by how much they differ, how much is allowed
    DoNotAgree Region (Region, Text) (Region, Text) Text Text
  | -- | a closed contour as an element of another
    ClosedElement Region Name
  | -- | a closed curve as an open contour
    ClosedCurve Region
  | -- | a place to begin on a contour that begins at its first element
    OpenBegins Region Name
  | -- | a statement that needs another cutter: the statement, the cutter that it needs, the cutter
    -- there is
    WrongCutter Region Text Text Text
  | -- | several depths with a cutter that is widest at its tip: the depth
    StepsUndercut Region
  | -- | the points of a curve: the call, what they stand in, the row, why
    NoCurve Region Listing (Maybe Region) ListFault
  | -- | a shift of a curve beyond its radius of curvature: the cipher, the place, the distance, the
    -- largest there
    Folds Region Point Mm Mm
  | -- | a shift of a curve with a corner: the cipher, the place, the angle
    ShiftsCorner Region Point Rad
  | -- | the bevel in a row is no angle between −90° and 90°
    SteepBevel Region (Maybe Int) Rad
  | -- | the ends of a change of distance do not follow one another along the curve
    GrowthEnds Region
  | -- coordinates run

    -- | a coordinate of a joggle that the piece does not have, or has several times: the points;
    -- from where to where its
    JoggleCoordinate Region Mm [Point] (Mm, Mm)
  | -- | the two coordinates of a joggle are one place
    JoggleNowhere Region
  | -- | a joggle's radius does not fit: its radius, the length between its ends, the largest that
    -- fits
    JoggleRadius Region Mm Mm (Maybe Mm)
  | -- | a joggle's radius is too small for its depth: the least
    JoggleDepth Region Mm Mm
  | -- | the contour, two of its elements, where they meet, and whether there are fillets that could
    -- be wrong
    CrossesItself Region Region Region Point Bool
  | -- | contours that make no pocket
    NoPocket PocketMisfit
  deriving stock (Eq, Show)

-- | The neighbours that a link could not join.
joined' :: ValueFact -> Maybe Joined
joined' fact = case fact of
  NoMeeting j _ -> Just j
  ParallelLines j _ -> Just j
  SameCurve j -> Just j
  AmbiguousMeeting j _ -> Just j
  NotSmooth j _ -> Just j
  Kinked j _ -> Just j
  TurnsBack j -> Just j
  TangentNeedsCircles j -> Just j
  ConcentricTangent j -> Just j
  CoincidentTangent j -> Just j
  NoTangent j _ -> Just j
  FilletAtPoint j -> Just j
  NoFillet j _ _ -> Just j
  AmbiguousFillet j _ -> Just j
  _ -> Nothing

-- | The words for it.
toReport :: Error -> Report
toReport (Error fact calls) = addCalls $ case fact of
  DivisionByZero region -> at region "E0301" "this divides by zero"
  OutOfRange region function argument range ->
    (at region "E0302" (function <> " of " <> argument <> " does not exist"))
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
  NoLength region ->
    at region "E0328" "the contour has no length"
  LinkOfLoneCircle region ->
    (at region "E0329" "a circle or a closed curve alone needs no link")
      { hints = ["It closes by itself: leave the link out."]
      }
  RadiusNotPositive region r ->
    (at region "E0304" ("a circle needs a positive radius, this one is " <> Decimal.mm r))
      { label = Decimal.mm r
      }
  ZeroLine region p ->
    (at region "E0305" "this line has no length")
      { message =
          [ "Both its points are "
              <> Vec.written 4 p
              <> "; a line needs two different ones."
          ]
      }
  NotPositive region what value ->
    at region "E0306" (what <> " must be more than zero, this one is " <> value)
  EmptyContour region (Name name) ->
    at region "E0307" ("the contour " <> quote name <> " has no elements")
  LoneElement region walked ->
    (at region "E0308" ("a closed contour cannot consist of " <> describe walked <> " alone"))
      { hints =
          [ "Only a circle or a closed curve closes by itself; add the other elements, or \
            \make the contour open."
          ]
      }
  NoEnd region walked ->
    (at region "E0309" ("an open contour cannot begin or end on " <> describe walked))
      { message = ["A circle has no ends; the contour does not know where to begin or stop on it."],
        hints = ["Put a point of the circle before it (or behind it) as an element of its own."]
      }
  LinkAtEnd region contour ->
    (at region "E0310" "nothing follows this link")
      { others = [Label contour "the contour is open"],
        hints = ["Leave the link out, or make the contour closed."]
      }
  NoMeeting j gap ->
    (joined "E0311" j (things j <> " do not meet: they miss one another by " <> Decimal.some gap))
      { message = [stop "17533"],
        hints =
          if any isCurve [before j, after j]
            then
              [ "A curve ends with the last row of its table, a piece where its curve ends. \
                \Correct the numbers, or join them by a line: line(end_of(a), start_of(b))."
              ]
            else
              [ "Correct the numbers; circles that are apart are joined by tangent or fillet, \
                \and a line begins at the point before it."
              ]
      }
  ParallelLines j gap ->
    (joined "E0312" j ("these lines are parallel, " <> Decimal.mm gap <> " apart, and do not meet"))
      { message = [stop "17533"],
        hints =
          ["Is an edge between them missing? A closed contour joins its last element to its first."]
      }
  SameCurve j ->
    (joined "E0313" j "these are the same curve, so they have no one point in common")
      { hints = ["Leave one of them out, or correct the numbers."]
      }
  AmbiguousMeeting j points ->
    (joined "E0314" j (things j <> " meet in more than one point"))
      { message =
          [ "They meet at "
              <> Text.intercalate
                (if length points > mostPoints then ", " else " and at ")
                (map (Vec.written 4) (take mostPoints points))
              <> andMore mostPoints points
              <> "."
          ],
        hints = ["Choose with: meet near " <> Vec.written 4 p | p <- take 1 points]
      }
  NotSmooth j gap ->
    (joined "E0315" j (things j <> " do not touch: they miss it by " <> Decimal.mm gap))
      { message = [stop "17533"],
        hints = ["Correct the numbers, or join them with a fillet."]
      }
  Kinked j angle ->
    ( joined
        "E0348"
        j
        (things j <> " meet at an angle of " <> Decimal.short 2 (degrees angle) <> " deg")
    )
      { message =
          [ "Smooth neighbours differ in direction by at most "
              <> Decimal.short 2 (degrees Tolerance.smoothTurn)
              <> " deg."
          ],
        hints = ["Correct the numbers, round the corner with a fillet, or leave smooth out."]
      }
  TurnsBack j ->
    (joined "E0316" j "the elements touch here, but the walk would have to turn back")
      { hints = ["Change the sense (cw, ccw) of a circle or the direction of a line."]
      }
  TangentNeedsCircles j
    | any isCurve [before j, after j] ->
      (joined "E0317" j "a tangent joins circles, not a curve")
        { hints =
            [ "If its neighbour goes on where the curve ends, write smooth; to round the \
              \corner, write fillet and a radius."
            ]
        }
    | otherwise ->
      (joined "E0317" j "a tangent joins circles, not a line that is already there")
        { hints =
            [ "If the line touches the circle, write smooth; to round the corner, write \
              \fillet and a radius."
            ]
        }
  ConcentricTangent j ->
    (joined "E0318" j "concentric circles have no common tangent")
      { message = [stop "17533"]
      }
  CoincidentTangent j ->
    (joined "E0319" j "these circles are the same, so there is no tangent from one to the other")
      { hints = ["Leave one of them out, or correct the centre or the radius of one."]
      }
  NoTangent j senses ->
    (joined "E0320" j "no common tangent fits the senses in which these circles are walked")
      { message = [stop "17533"],
        hints = case senses of
          [] ->
            [ "One circle lies inside the other: there is no common tangent at all. Join them with \
              \a fillet."
            ]
          _ -> ["There is one when they are walked " <> Text.intercalate ", or " senses <> "."]
      }
  FilletAtPoint j ->
    ( joined
        "E0321"
        j
        "a fillet or chamfer needs a line, a circle or a curve on both sides, not a point"
    )
      { hints = ["Write the edges as lines: line(p, q)."]
      }
  NoFillet j r largest ->
    ( joined
        "E0322"
        j
        ( "no arc of radius "
            <> Decimal.mm r
            <> " touches both neighbours in the direction of the walk"
        )
    )
      { message = [stop "17535"],
        hints =
          ["The largest radius that fits here is " <> downTo m <> "." | Just m <- [largest]]
            <> [ "With the other sign there is one: fillet " <> signed <> "."
                 | Just signed <- [otherSign j r]
               ]
            <> [ "+R is walked clockwise, −R counter-clockwise; check the sign, the radius, and the \
                 \senses of the neighbours."
               ]
      }
  AmbiguousFillet j centres ->
    (joined "E0323" j "two fillets make contours of the same length")
      { message =
          [ "Their centres are "
              <> Text.intercalate " and " (map (Vec.written 4) centres)
              <> "."
          ],
        hints =
          ["Change the order or the senses of the elements so that one of them is the shorter way."]
      }
  Overrun region walked overlap links largest ->
    ( at
        region
        "E0324"
        ( "the links do not fit: "
            <> describe walked
            <> " is too short for them by "
            <> Decimal.some overlap
        )
    )
      { label = "it would have to be walked backwards",
        others = [Label l "this link takes its share" | l <- nub links],
        message = [stop "17535"],
        hints =
          [ maybe
              "Make the fillet or chamfer smaller, or check the directions of the neighbours."
              (\m -> "The largest radius that fits here is " <> downTo m <> ".")
              largest
          ]
      }
  NothingCommon region a b gap ->
    (at region "E0330" (described a <> " and " <> described b <> " do not meet"))
      { message = ["They miss one another by " <> Decimal.some gap <> "."]
      }
  SameThing region ->
    at region "E0331" "these are the same curve, so they have no one point in common"
  Several region what candidates ->
    (at region "E0332" ("there is more than one such " <> what))
      { message = [listed candidates],
        hints =
          [ if what == "line" || what == "point of tangency"
              then
                "Say for each circle on which side of the directed line it lies: left C or \
                \right C."
              else
                "Choose one that stays right when the part is turned: near P, left L or right L \
                \(of a directed line), inside C or outside C"
                  <> (if what == "point" then ", first or last along a line." else ".")
          ]
      }
  NoneFits region what candidates ->
    (at region "E0333" ("no such " <> what <> " is where it is sought"))
      { message = [listed candidates]
      }
  SeveralFit region what candidates ->
    (at region "E0334" ("the choice leaves more than one " <> what))
      { message = [listed candidates],
        hints = ["Choose by something that only one of them has."]
      }
  NoAnswer region what why ->
    (at region "E0335" ("there is no such " <> what))
      { message = [why]
      }
  NotTouching region gap ->
    (at region "E0336" ("these do not touch: they miss it by " <> Decimal.mm gap))
      { hints = ["For the points in which they cross, write intersection."]
      }
  OnOneLine region ->
    at region "E0337" "no circle goes through three points of one line"
  NotWhole region what range x ->
    (at region "E0338" (what <> " must be a whole number " <> range))
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
  NoSuchRow region listing n count ->
    ( at
        region
        "E0339"
        ( "the "
            <> (case listing of InTable -> "table"; InList -> "list")
            <> " has no "
            <> nounOf listing
            <> " "
            <> Decimal.whole n
            <> ", it has "
            <> (if count == 0 then "none" else Decimal.whole count)
        )
    )
      { message = ["They count from 1." | n < 1]
      }
  StepOfZero region ->
    at region "E0340" "a range cannot go in steps of zero"
  DoesNotHold region values ->
    (at region "E0341" "this does not hold")
      { others = [Label r value | (r, value) <- values]
      }
  Negative region what value ->
    at region "E0345" (what <> " must not be negative, this one is " <> value)
  NothingToDrill region ->
    at region "E0346" "there is no point to drill at"
  DoNotAgree region (leftRegion, left) (rightRegion, right) difference allowed ->
    (at region "E0342" ("this is " <> left <> ", not " <> right))
      { others = [Label leftRegion left, Label rightRegion right],
        message =
          [ if difference == allowed
              then "They differ by somewhat more than " <> allowed <> ", which is allowed."
              else "They differ by " <> difference <> "; " <> allowed <> " is allowed."
          ]
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
  NoCurve region listing row trouble ->
    (at (fromMaybe region row) "E0349" (troubled (nounOf listing) trouble))
      { others = [Label region "for this curve" | Just r <- [row], r /= region],
        hints = troubleHint (nounOf listing) trouble
      }
  Folds region p asked largest ->
    ( at
        region
        "E0350"
        ( "the curve folds over: at "
            <> Vec.written 3 p
            <> " its radius of curvature is only "
            <> below largest
        )
    )
      { message =
          [ "It is shifted there by "
              <> Decimal.mm asked
              <> " towards the inside of the bend; a curve can be shifted by less than its radius."
          ],
        hints = ["The largest distance that fits there is less than " <> below largest <> "."]
      }
  ShiftsCorner region p angle ->
    ( at
        region
        "E0351"
        ( "the curve has a corner of "
            <> Decimal.short (if degrees angle < 0.01 then 6 else 2) (degrees angle)
            <> " deg at "
            <> Vec.written 3 p
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
    (at region "E0353" "the change of distance must end behind its beginning, along the walk")
      { hints = ["Give the point first that the walk comes to first."]
      }
  JoggleCoordinate region x points (low, high) ->
    ( at
        region
        "E0354"
        ( case points of
            [] ->
              "the piece does not come to x = " <> Decimal.mm x
            _ -> "the piece has more than one point with x = " <> Decimal.mm x
        )
    )
      { message =
          [ if null points
              then "It runs from x = " <> Decimal.mm low <> " to x = " <> Decimal.mm high <> "."
              else listed (map APoint points),
            stop "15074"
          ],
        hints = ["A joggle needs x coordinates that the piece passes once."]
      }
  JoggleNowhere region ->
    (at region "E0354" "a joggle needs two different coordinates")
      { message = [stop "15074"]
      }
  JoggleRadius region r there largest ->
    ( at
        region
        "E0355"
        ( "a joggle of radius "
            <> Decimal.mm r
            <> " does not fit into "
            <> Decimal.mm there
            <> " of the piece"
        )
    )
      { message = [stop "14174"],
        hints =
          [ maybe
              ( "No radius fits: the depth must be less than half of this length, "
                  <> downTo (times 0.5 there)
                  <> "."
              )
              (\m -> "The largest radius that fits is " <> downTo m <> ".")
              largest
          ]
      }
  JoggleDepth region r least ->
    (at region "E0355" ("a joggle of radius " <> Decimal.mm r <> " cannot go so deep"))
      { hints = ["Its radius must be more than half of its depth, " <> Decimal.mm least <> "."]
      }
  WrongCutter region statement needed there ->
    (at region "E0344" (quote statement <> " needs " <> needed))
      { message = ["The tool is " <> there <> "."],
        hints =
          [ "Change it first: change 2 "
              <> (if statement == "pocket" then "mill" else statement)
              <> (if statement == "turn" then "(nose 0.4 mm)" else "(diameter 5 mm)")
          ]
      }
  StepsUndercut region ->
    (at region "E0360" "a cutter that is widest at its tip cannot go down in steps")
      { message = ["Above the last depth its tip would cut into what leans over that."],
        hints = ["Give the depth without a step, or clear the way before with an upright mill."]
      }
  CrossesItself contour first second p fillets ->
    (at first "E0325" "the contour crosses or touches itself")
      { label = "this element",
        others =
          [Label second "meets this one" | second /= first] <> [Label contour "in this contour"],
        message = ["They meet at " <> Vec.written 4 p <> "."],
        hints =
          [ "Check the signs of the fillets: +R is walked clockwise, −R counter-clockwise."
            | fillets
          ]
      }
  NoPocket misfit -> PocketError.toReport misfit
  where
    addCalls r =
      r
        { others =
            others r
              <> [Label c "in this call" | c <- nub (take 1 calls <> take 1 (reverse calls))]
        }

-- | What stands in a table or a list.
nounOf :: Listing -> Text
nounOf listing = case listing of
  InTable -> "row"
  InList -> "point"

-- | What is wrong, of rows or points.
troubled :: Text -> ListFault -> Text
troubled noun trouble = case trouble of
  FewPoints there needed ->
    "a curve needs " <> Decimal.whole needed <> " points, " <> thereAre there
  FewDifferent there needed ->
    "a closed curve needs " <> Decimal.whole needed <> " different points, " <> thereAre there
  SamePoint k -> noun <> " " <> Decimal.whole k <> " is the same point as the one before it"
  EvenPoints n -> "parabolas need an odd number of points, there are " <> Decimal.whole n
  Unordered k -> "x does not go on in " <> noun <> " " <> Decimal.whole k <> " as it began"
  SectionRows s n ->
    "section "
      <> Decimal.whole s
      <> " names "
      <> Decimal.whole n
      <> " "
      <> noun
      <> (if n == 1 then "" else "s")
  SectionOrder s -> "the " <> noun <> "s of section " <> Decimal.whole s <> " do not rise"
  SectionJoint s begins must ->
    "section "
      <> Decimal.whole s
      <> " begins with "
      <> noun
      <> " "
      <> Decimal.whole begins
      <> ", not with "
      <> noun
      <> " "
      <> Decimal.whole must
  SectionEnd final all' ->
    "the last section ends with "
      <> noun
      <> " "
      <> Decimal.whole final
      <> ", not with the last "
      <> noun
      <> ", "
      <> Decimal.whole all'
  NoSection -> "a curve of sections needs at least one"
  where
    thereAre n = case n of
      0 -> "there are none"
      1 -> "there is only one"
      _ -> "there are only " <> Decimal.whole n

troubleHint :: Text -> ListFault -> [Text]
troubleHint noun trouble = case trouble of
  FewPoints _ _ -> []
  FewDifferent _ _ -> ["The last point, when it is the first again, does not count."]
  SamePoint _ -> ["Leave one of the two " <> noun <> "s out."]
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

-- | The radius of a fillet with the one sign that fits, in words: R with + is walked clockwise.
otherSign :: Joined -> Mm -> Maybe Text
otherSign j r = case (fits Clockwise, fits CounterClockwise) of
  (True, False) -> Just (Decimal.mm r)
  (False, True) -> Just ("-" <> Decimal.mm r)
  (True, True) -> Nothing
  (False, False) -> Nothing
  where
    fits turn = not (null (Fillet.between r turn (value (before j)) (value (after j))))

at :: Region -> ReportCode -> Text -> Report
at region code = report Report.Error code (InSource region)

joined :: ReportCode -> Joined -> Text -> Report
joined code j title =
  (at (link j) code title)
    { others = [Label r (describe w) | Located r w <- [before j, after j], r /= link j]
    }

isCurve :: Located ElementCarrier -> Bool
isCurve (Located _ walked) = case walked of
  OnCurve _ -> True
  OnLine _ -> False
  OnCircle _ _ -> False
  AtPoint _ -> False

things :: Joined -> Text
things j = describe (value (before j)) <> " and " <> describe (value (after j))

-- | An element in words.
describe :: ElementCarrier -> Text
describe walked = case walked of
  OnLine (Line p q) -> "the line from " <> Vec.written 4 p <> " to " <> Vec.written 4 q
  OnCircle _ (Circle c r) -> "the circle of radius " <> Decimal.mm r <> " about " <> Vec.written 4 c
  OnCurve c ->
    "the curve from "
      <> Vec.written 4 (MeasuredPolyarc.start c)
      <> " to "
      <> Vec.written 4 (MeasuredPolyarc.end c)
  AtPoint p -> "the point " <> Vec.written 4 p

-- | A curve in words, without where it is entered.
described :: ElementCarrier -> Text
described = describe

-- | Answers with their coordinates.
listed :: [Candidate] -> Text
listed candidates = case candidates of
  [] -> "There is none."
  [one] -> "There is only " <> words' one <> "."
  _
    | length candidates > mostCandidates ->
      "There are "
        <> Text.intercalate ", " (map words' (take mostCandidates candidates))
        <> andMore mostCandidates candidates
        <> "."
  _ ->
    "There are "
      <> Text.intercalate ", " (map words' (init candidates))
      <> " and "
      <> words' (last candidates)
      <> "."
  where
    words' c = case c of
      APoint p -> Vec.written 4 p
      ALine (Line p q) -> "the line from " <> Vec.written 4 p <> " to " <> Vec.written 4 q
      ACircle (Circle c' r) ->
        "the circle of radius " <> Decimal.mm r <> " about " <> Vec.written 4 c'

-- | So many points in which two neighbours meet are told.
mostPoints :: Int
mostPoints = 6

-- | So many answers are told: as many circles of one size can touch two circles.
mostCandidates :: Int
mostCandidates = 8

-- | How many more there are than are told.
andMore :: Int -> [a] -> Text
andMore most answers = case length answers - most of
  n | n > 0 -> " and " <> Decimal.whole n <> " more"
  _ -> ""

-- | A length that is not to be reached, with three decimals; one that is whole but for the noise of
-- doubles is told as whole.
below :: Mm -> Text
below (Mm x) = downTo (Mm (x + noise))
  where
    Mm noise = Tolerance.coincident

-- | A length that is not to be exceeded, with three decimals.
downTo :: Mm -> Text
downTo (Mm x) = Decimal.mm (Mm (fromIntegral (floor (x * 1000) :: Int) / 1000))

stop :: Text -> Text
stop number = "The Minsk-22 system stopped here with " <> number <> "."
