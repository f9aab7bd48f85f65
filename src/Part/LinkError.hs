{-# OPTIONS_GHC -O0 #-}

-- | Faults of the links of a contour: links that cannot join their neighbours. Their reports offer
-- fixes with the numbers that are known.
module Part.LinkError
  ( Neighbours (..),
    LinkFault (..),
    FittingFillets (..),
    toReport,
    repeatedReport,
    largestFix,
    turnedFix,
    turnable,
    senseRegion,
    senseFix,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad, degrees, minus)
import Base.Region (Located (..), Region (..))
import Data.List (nub)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Carrier (Circle (..), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Construction.TangentLine qualified as TangentLine
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ErrorText (alternatively, andMore, describe, downTo)
import Part.Tolerance qualified as Tolerance
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), ReportCode, at)

-- | Two neighbouring elements of a contour, and the region of the link between them.
data Neighbours = Neighbours
  { link :: Region,
    before :: {-# UNPACK #-} (Located ElementCarrier),
    after :: {-# UNPACK #-} (Located ElementCarrier),
    -- | the regions of the items of the contour that give these elements, with the sense before the
    -- element, its modifiers and its link
    items :: (Region, Region)
  }
  deriving stock (Eq, Show)

-- | The reason why a link cannot join its neighbours, the elements before and after it.
data LinkFault
  = -- | the neighbours do not meet: the shortest distance between them
    NoMeeting Mm
  | -- | the neighbours are parallel lines: the distance between them
    ParallelLines Mm
  | -- | the neighbours lie on one curve: true if the contour has no fault without the second one
    SameCurve Bool
  | -- | the neighbours meet in these points, and the link does not say which of them it means
    AmbiguousMeeting [Point]
  | -- | the neighbours of a smooth link cross or lie apart, but do not touch: the distance by which
    -- one of them would have to move to touch the other, and a fillet in place of the link with
    -- which the contour has no fault
    NotSmooth Mm (Maybe FittingFillets)
  | -- | the neighbours of a smooth link touch at a corner: the angle between their directions, and
    -- true if the contour has no fault without this link
    Kinked Rad Bool
  | -- | the neighbours of a smooth link touch, but their directions there are opposite: the
    -- regions of the circles whose other sense leaves the contour without a fault
    TurnsBack [Region]
  | TangentNeedsCircles
  | ConcentricTangent
  | -- | the neighbours of a tangent are the same circle: true if the contour has no fault without
    -- the second one
    CoincidentTangent Bool
  | -- | the circles have no common tangent with the senses that the program writes: the pairs of
    -- senses with which they have one
    NoCommonTangent [(Sense, Sense)]
  | -- | a fillet or a chamfer beside an element that is a point
    FilletAtPoint
  | -- | no arc of the given radius touches both neighbours: this radius, the largest one that fits,
    -- and the fillets that fit if they get the other sense. 'Nothing' if none fits
    NoFillet Sense Mm (Maybe FittingFillets) (Maybe FittingFillets)
  | -- | two fillet arcs make equally long contours: the centres of both arcs
    AmbiguousFillet [Point]
  deriving stock (Eq, Show)

-- | Fillets with which a contour has no fault: their regions, senses and radii.
newtype FittingFillets = FittingFillets [(Region, Sense, Mm)]
  deriving stock (Eq, Show)

-- | The report of a link that cannot join its neighbours.
toReport :: Neighbours -> LinkFault -> Report
toReport j fault = case fault of
  NoMeeting gap ->
    (titled "E0311" (both j <> " do not meet: they are " <> Decimal.nonZeroMm gap <> " apart"))
      { controlStop = Just "17533",
        message = touchText j,
        fixes = joinFixes j <> tangentFixes j,
        hints =
          [ alternatively
              (joinFixes j <> tangentFixes j)
              "Correct the numbers of one of the two, so that they meet."
          ]
      }
  ParallelLines gap ->
    (titled "E0312" ("these lines are parallel, " <> Decimal.mm gap <> " apart, and do not meet"))
      { controlStop = Just "17533",
        message = ["A closed contour joins its last element to its first." | isClosing j],
        fixes = joinFixes j,
        hints = [alternatively (joinFixes j) "Write the edge that is missing between them."]
      }
  SameCurve isEnough ->
    (titled "E0313" "these two elements lie on the same curve, so they have no one point in common")
      { fixes = if isEnough then leaveOutSecond j else [],
        hints = ["Leave one of them out, or correct its numbers."]
      }
  AmbiguousMeeting points ->
    (titled "E0314" (both j <> " meet in " <> Decimal.whole (length points) <> " points"))
      { message = [meetingPoints points],
        fixes = map (nearFix j) (take mostPoints points)
      }
  NotSmooth gap rounded ->
    (titled "E0315" (both j <> " do not touch: they miss it by " <> Decimal.mm gap))
      { controlStop = Just "17533",
        message = touchText j,
        fixes = [filletsFix "Join them with a fillet: " fillets | Just fillets <- [rounded]],
        hints =
          [ alternatively
              (maybe [] (pure . filletsFix "") rounded)
              "Correct the numbers of one of the two, so that they touch."
          ]
      }
  Kinked angle isEnough -> kinkedReport j angle isEnough
  TurnsBack mending ->
    (titled "E0316" "the elements touch here, but the contour would have to turn back")
      { message = sideText j,
        fixes =
          [ senseFix (word, sense, c)
            | (at', word, sense, c) <- turnable j,
              at' `elem` mending
          ],
        hints =
          [ "Turn the line round, let it touch the circle on the other side, or change the sense \
            \of the circle."
            | null mending
          ]
      }
  TangentNeedsCircles -> repeatedReport (j :| []) [] fault
  ConcentricTangent ->
    (titled "E0318" "circles with the same centre have no common tangent")
      { controlStop = Just "17533",
        hints = ["Correct the centre of one of the two, or leave one of them out."]
      }
  CoincidentTangent isEnough ->
    (titled "E0319" "these circles are the same, so there is no tangent from one to the other")
      { fixes = if isEnough then leaveOutSecond j else [],
        hints = ["Leave one of them out, or correct its centre or its radius."]
      }
  NoCommonTangent senses -> noTangentReport j senses
  FilletAtPoint -> repeatedReport (j :| []) [] fault
  NoFillet sense r largest turned -> noFilletReport j sense r (largest, turned)
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

-- | The report of a smooth link at a corner. If @isEnough@, the contour has no fault without it.
kinkedReport :: Neighbours -> Rad -> Bool -> Report
kinkedReport j angle isEnough =
  ( linkTitle
      j
      "E0348"
      (both j <> " meet at an angle of " <> Decimal.short 2 (degrees angle) <> " deg")
  )
    { message =
        [ "Smooth neighbours differ in direction by at most "
            <> Decimal.short 2 (degrees Tolerance.smoothTurn)
            <> " deg."
        ],
      fixes = leavingOut,
      hints =
        [ alternatively
            leavingOut
            "Correct the numbers, or round the corner: write fillet and a radius."
        ]
    }
  where
    leavingOut =
      [ Fix.proposed (Fix.removal "Leave smooth out: there is a corner here." (link j))
        | isEnough
      ]

noTangentReport :: Neighbours -> [(Sense, Sense)] -> Report
noTangentReport j senses =
  (linkTitle j "E0320" "no common tangent fits the senses in which these circles are traversed")
    { controlStop = Just "17533",
      message = ["One circle lies inside the other: they have no common tangent." | null senses],
      fixes = concatMap pairFix senses,
      hints =
        if null senses
          then ["Join them with a fillet instead: write fillet and a radius."]
          else [tangentHint senses]
    }
  where
    pairFix (first, second) =
      [ changes ("Traverse them " <> pairText (first, second) <> ".") (concat edits)
        | Just edits <- [sequence [change fst before first, change snd after second]],
          not (all null edits)
      ]
    change item side wanted = case value (side j) of
      OnCircle sense _
        | sense == wanted -> Just []
        | Just word <- senseRegion (item (items j)) (side j) ->
          Just [Fix.exchange "" word (senseText wanted)]
      AtPoint _ -> Just []
      _ -> Nothing

-- | The report of a fillet that does not fit. The last argument has fillets that do: those with the
-- largest radius, and those with the other sense.
noFilletReport ::
  Neighbours -> Sense -> Mm -> (Maybe FittingFillets, Maybe FittingFillets) -> Report
noFilletReport j sense r (largest, turned) =
  ( linkTitle
      j
      "E0322"
      ( "no "
          <> (if sense == Clockwise then "clockwise" else "counter-clockwise")
          <> " arc of radius "
          <> Decimal.mm r
          <> " leads from "
          <> describe (value (before j))
          <> " to "
          <> describe (value (after j))
      )
  )
    { controlStop = Just "17535",
      message = why,
      fixes = offered,
      hints = [if null why then hint else alternatively offered hint]
    }
  where
    offered =
      [largestFix fillets | Just fillets <- [largest]]
        <> [turnedFix fillets | Just fillets <- [turned]]
    (why, hint) = case (value (before j), value (after j)) of
      (OnLine l, OnLine m)
        | Intersection.Apart gap <- Intersection.lines l m ->
          ( [ "The lines are parallel, "
                <> Decimal.mm gap
                <> " apart: there is no corner to round."
            ],
            "Write the element that is missing between them."
          )
      (OnCircle _ c, OnCircle _ d)
        | Just words' <- nested c d -> (words', "Correct the centre or the radius of one of them.")
      _ ->
        ( [],
          "A radius without a sign makes a clockwise arc, one with a minus a counter-clockwise \
          \one; check the sign, the radius, and the senses of the neighbours."
        )

-- | The sentence that one circle lies inside the other. 'Nothing' for other circles.
nested :: Circle -> Circle -> Maybe [Text]
nested c d
  | Intersection.Apart _ <- Intersection.circles c d,
    apart < max (radius c) (radius d) =
    Just
      [ "One circle lies inside the other: their centres are "
          <> Decimal.mm apart
          <> " apart, and their radii are "
          <> Decimal.mm (radius c)
          <> " and "
          <> Decimal.mm (radius d)
          <> "."
      ]
  | otherwise = Nothing
  where
    apart = Vec.distance (centre c) (centre d)

-- | The report of one cause that several links of a contour have in common: a tangent beside
-- elements that are no circles, or a fillet beside a point. It points at the first of these links.
-- If all elements of the contour are points, @edges@ has the region of each point that has a point
-- before it, and the point before it.
repeatedReport :: NonEmpty Neighbours -> [(Region, Point)] -> LinkFault -> Report
repeatedReport js@(j :| more) edges fault = case fault of
  FilletAtPoint ->
    (linkTitle j "E0321" ("a fillet or chamfer rounds a corner of edges, not a point" <> count))
      { others = places,
        fixes = edgesFix edges,
        hints = ["Write the edges as lines: line(p, q)."]
      }
  _ ->
    ( linkTitle
        j
        "E0317"
        ( "a tangent joins two circles, not "
            <> describe (value (if isCircle (value (before j)) then after j else before j))
            <> count
        )
    )
      { others = if null more then others (linkTitle j "E0317" "") else places,
        fixes = commonFixes js,
        hints =
          [ "Where the two elements touch, write smooth; where they meet at a corner, nothing; to \
            \round the corner, fillet and a radius."
            | null (commonFixes js)
          ]
      }
  where
    count = case length more of
      0 -> ""
      n -> " (" <> Decimal.whole (n + 1) <> " times in this contour)"
    places = [Label (link k) "also here" | k <- take 5 more]

-- | The sentence that says what would make a circle touch a line or another circle. Empty for other
-- neighbours.
touchText :: Neighbours -> [Text]
touchText j = case (value (before j), value (after j)) of
  (OnLine l, OnCircle _ c) -> beside (abs' (Carrier.signedDistance l (centre c))) c "line"
  (OnCircle _ c, OnLine l) -> beside (abs' (Carrier.signedDistance l (centre c))) c "line"
  (OnCircle _ c, OnCircle _ d) ->
    let between' = Vec.distance (centre c) (centre d)
     in if between' > max (radius c) (radius d)
          then beside (minus between' (radius c)) d "other circle"
          else []
  _ -> []
  where
    abs' (Mm x) = Mm (abs x)
    beside r c other =
      [ "With the radius "
          <> Decimal.mm r
          <> ", or with its centre "
          <> Decimal.mm (abs' (minus r (radius c)))
          <> (if r > radius c then " nearer, " else " further away, ")
          <> describe (OnCircle Clockwise c)
          <> " would touch the "
          <> other
          <> "."
        | r > Mm 0
      ]

-- | The sentence that says on which side of a line a circle lies, and on which it would have to
-- lie. Empty for other neighbours.
sideText :: Neighbours -> [Text]
sideText j = case (value (before j), value (after j)) of
  (OnLine _, OnCircle sense _) -> text sense
  (OnCircle sense _, OnLine _) -> text sense
  _ -> []
  where
    text sense =
      [ "A line joins a circle that is traversed "
          <> (if sense == Clockwise then "clockwise" else "counter-clockwise")
          <> " smoothly if it has the circle on its "
          <> (if sense == Clockwise then "right" else "left")
          <> ". This line has it on its "
          <> (if sense == Clockwise then "left" else "right")
          <> "."
      ]

-- | An error that points at a link and labels its two neighbours.
linkTitle :: Neighbours -> ReportCode -> Text -> Report
linkTitle j code title =
  (at (link j) code title)
    { others = [Label r (describe carrier) | Located r carrier <- [before j, after j], r /= link j]
    }

-- | The descriptions of two neighbours, joined by "and".
both :: Neighbours -> Text
both j = describe (value (before j)) <> " and " <> describe (value (after j))

-- Fixes

-- | Proposal that makes several changes.
changes :: Text -> [Fix] -> Fix
changes what = Fix.proposed . Fix.joined what

-- | Fix that gives fillets the largest radius that fits.
largestFix :: FittingFillets -> Fix
largestFix = filletsFix "Write the largest radius that fits here: "

-- | Fix that gives fillets the other sense.
turnedFix :: FittingFillets -> Fix
turnedFix = filletsFix "Give the fillet the other sense: "

-- | Fix that writes fillets. Its title ends with the text of the first one. Radii are rounded down
-- to three decimals.
filletsFix :: Text -> FittingFillets -> Fix
filletsFix what (FittingFillets fillets) =
  changes
    (what <> Text.concat (take 1 [text sense r | (_, sense, r) <- fillets]) <> ".")
    [Fix.exchange "" word (text sense r) | (word, sense, r) <- fillets]
  where
    text sense r = "fillet " <> (if sense == Clockwise then "" else "-") <> downTo r

-- | True if the link joins the last element of a closed contour to the first one.
isClosing :: Neighbours -> Bool
isClosing j = snd (items j) < fst (items j)

-- | True if the program writes the link. A link without a text has the region of the element after
-- it.
isWritten :: Neighbours -> Bool
isWritten j = let Located r _ = after j in link j /= r

-- | Fix that writes a text between the two neighbours.
between :: Text -> Neighbours -> Text -> Fix
between what j text
  | isClosing j || uncurry (==) (items j) =
    Fix.insertion what (end (fst (items j))) (" " <> text)
  | otherwise = Fix.insertion what (start (snd (items j))) (text <> " ")

-- | Fix that writes a link, in place of the link that the program writes.
linkFix :: Text -> Neighbours -> Text -> Fix
linkFix what j text =
  Fix.proposed (if isWritten j then Fix.exchange what (link j) text else between what j text)

-- | Fix that chooses the meeting of two elements near a point.
nearFix :: Neighbours -> Point -> Fix
nearFix j p = let text = "meet near " <> Vec.toText 4 p in linkFix ("Write " <> text <> ".") j text

-- | Fix that draws a line from the end of the first element to the start of the second one. There
-- is none if the program writes a link, or if an element has no end.
joinFixes :: Neighbours -> [Fix]
joinFixes j =
  [ Fix.proposed
      ( between
          ("Join them by a line from " <> Vec.toText 4 p <> " to " <> Vec.toText 4 q <> ".")
          j
          ("line(" <> exactPoint p <> ", " <> exactPoint q <> ")")
      )
    | not (isWritten j),
      Just p <- [lastPoint (value (before j))],
      Just q <- [firstPoint (value (after j))],
      not (Vec.isNear p q)
  ]
  where
    lastPoint carrier = case carrier of
      OnLine l -> Just (Carrier.to l)
      OnCircle _ _ -> Nothing
      OnCurve c -> Just (MeasuredPolyarc.end c)
      AtPoint p -> Just p
    firstPoint carrier = case carrier of
      OnLine l -> Just (Carrier.from l)
      OnCircle _ _ -> Nothing
      OnCurve c -> Just (MeasuredPolyarc.start c)
      AtPoint p -> Just p

-- | The text of a point with all decimals of its coordinates.
exactPoint :: Point -> Text
exactPoint p = "(" <> Decimal.exact (Vec.x p) <> ", " <> Decimal.exact (Vec.y p) <> ")"

-- | Fix that joins two circles by a tangent.
tangentFixes :: Neighbours -> [Fix]
tangentFixes j = case (value (before j), value (after j)) of
  (OnCircle s c, OnCircle t d)
    | Just _ <- TangentLine.directed (s, c) (t, d) ->
      [linkFix "Join them by a straight line that touches both: write tangent." j "tangent"]
  _ -> []

-- | Fix that leaves out the second of two elements of different items.
leaveOutSecond :: Neighbours -> [Fix]
leaveOutSecond j =
  [ Fix.proposed (Fix.removal "Leave the second one out." (snd (items j)))
    | uncurry (/=) (items j)
  ]

-- | The circles of which a contour writes the sense: the region of the circle, that of the word,
-- the sense and the circle.
turnable :: Neighbours -> [(Region, Region, Sense, Circle)]
turnable j =
  [ (at', word, sense, c)
    | (item, located@(Located at' (OnCircle sense c))) <-
        [(fst (items j), before j), (snd (items j), after j)],
      Just word <- [senseRegion item located]
  ]

-- | The region of the sense that an item writes before its circle. 'Nothing' if the circle is part
-- of a contour that the item names.
senseRegion :: Region -> Located ElementCarrier -> Maybe Region
senseRegion item (Located at' carrier) = case carrier of
  OnCircle sense _
    | start item < start at' && end at' <= end item ->
      Just (Region (start item) (start item + Text.length (senseText sense)))
  _ -> Nothing

senseFix :: (Region, Sense, Circle) -> Fix
senseFix (word, sense, c) =
  Fix.proposed
    ( Fix.exchange
        ("Traverse " <> describe (OnCircle sense c) <> " the other way: write " <> other <> ".")
        word
        other
    )
  where
    other = senseText (Carrier.oppositeSense sense)

senseText :: Sense -> Text
senseText sense = case sense of
  Clockwise -> "cw"
  CounterClockwise -> "ccw"

-- | Fixes of links that are tangents beside elements that are no circles: smooth where the elements
-- touch, nothing where they meet at a corner.
commonFixes :: NonEmpty Neighbours -> [Fix]
commonFixes js = case traverse remedy (NonEmpty.toList js) of
  Nothing -> []
  Just edits ->
    let texts = nub (map snd edits)
        words'
          | texts == [""] = "Leave tangent out: they meet at a corner."
          | texts == ["smooth"] = "Write smooth: they touch."
          | otherwise = "Write smooth where they touch, and nothing where they meet at a corner."
     in [changes words' [Fix.exchange "" r text | (r, text) <- nub edits]]
  where
    remedy j = case (value (before j), value (after j)) of
      (OnLine l, OnLine m) -> edit j =<< meeting (Intersection.lines l m)
      (OnLine l, OnCircle _ c) -> edit j =<< meeting (Intersection.lineCircle l c)
      (OnCircle _ c, OnLine l) -> edit j =<< meeting (Intersection.lineCircle l c)
      (OnCurve c, OnLine l) -> ends j (MeasuredPolyarc.end c) (Carrier.from l)
      (OnLine l, OnCurve c) -> ends j (Carrier.to l) (MeasuredPolyarc.start c)
      (OnCurve c, OnCurve d) -> ends j (MeasuredPolyarc.end c) (MeasuredPolyarc.start d)
      _ -> Nothing
    edit j text = Just (link j, text)
    ends j p q = if Vec.isNear p q then edit j "" else Nothing
    meeting answer = case answer of
      Intersection.Touching _ -> Just "smooth"
      Intersection.CrossingOnce _ -> Just ""
      Intersection.Crossing p _ -> Just ("meet near " <> Vec.toText 4 p)
      Intersection.Apart _ -> Nothing
      Intersection.Same -> Nothing

-- | Fix that writes lines in place of points: each point becomes the line to it from the point
-- before. There is none if an item of the program gives several points.
edgesFix :: [(Region, Point)] -> [Fix]
edgesFix edges =
  [ changes
      "Write the edges as lines from point to point."
      [Fix.enclosure "" ("line(" <> exactPoint p <> ", ") r ")" | (r, p) <- edges]
    | not (null edges),
      length edges == length (nub (map fst edges))
  ]

-- Words

isCircle :: ElementCarrier -> Bool
isCircle carrier = case carrier of
  OnCircle _ _ -> True
  OnLine _ -> False
  OnCurve _ -> False
  AtPoint _ -> True

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

-- | The hint that names the pairs of senses with which the circles have a common tangent.
tangentHint :: [(Sense, Sense)] -> Text
tangentHint senses =
  "There is one when they are traversed " <> Text.intercalate ", or " (map pairText senses) <> "."

pairText :: (Sense, Sense) -> Text
pairText (first, second) = senseText first <> " then " <> senseText second
