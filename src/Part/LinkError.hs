{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

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
import Base.Quantity (LengthUnit, Mm (..), Rad, degrees, minus)
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
import Part.ErrorText
  ( alternatively,
    describe,
    downTo,
    meetingPoints,
    mostPoints,
    nested,
  )
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
toReport :: LengthUnit -> Neighbours -> LinkFault -> Report
toReport unit j fault = (faultReport unit j fault) {controlStop = Just (stopOf fault)}

-- | The control stop of the Minsk-22 system for a link that fails: 17533 for a joint or an
-- intersection, 17535 for a fillet.
stopOf :: LinkFault -> Text
stopOf fault = if isFillet then "17535" else "17533"
  where
    isFillet = case fault of
      FilletAtPoint -> True
      NoFillet {} -> True
      AmbiguousFillet _ -> True
      _ -> False

-- | The report of a fault without its control stop.
faultReport :: LengthUnit -> Neighbours -> LinkFault -> Report
faultReport unit j fault = case fault of
  NoMeeting gap ->
    (titled "E0311" (both unit j <> " do not meet: they are " <> apartBy gap))
      { message = touchText unit j,
        fixes = joinFixes unit j <> tangentFixes j,
        hints =
          [ alternatively
              (joinFixes unit j <> tangentFixes j)
              "Correct the numbers of one of the two, so that they meet."
          ]
      }
  ParallelLines gap ->
    ( titled
        "E0312"
        ( "these lines are parallel, " <> Decimal.inUnit unit gap
            <> " apart, and do not meet"
        )
    )
      { message = ["A closed contour joins its last element to its first." | isClosing j],
        fixes = joinFixes unit j,
        hints = [alternatively (joinFixes unit j) "Write the edge that is missing between them."]
      }
  SameCurve isEnough ->
    (titled "E0313" "these two elements lie on the same curve, so they have no one point in common")
      { fixes = if isEnough then leaveOutSecond j else [],
        hints = ["Leave one of them out, or correct its numbers."]
      }
  AmbiguousMeeting points ->
    (titled "E0314" (both unit j <> " meet in " <> Decimal.whole (length points) <> " points"))
      { message = [meetingPoints unit points],
        fixes = map (nearFix unit j) (take mostPoints points)
      }
  NotSmooth gap rounded ->
    (titled "E0315" (both unit j <> " do not touch: they miss it by " <> Decimal.inUnit unit gap))
      { message = touchText unit j,
        fixes = [filletsFix unit "Join them with a fillet: " fillets | Just fillets <- [rounded]],
        hints =
          [ alternatively
              (maybe [] (pure . filletsFix unit "") rounded)
              "Correct the numbers of one of the two, so that they touch."
          ]
      }
  Kinked angle isEnough -> kinkedReport unit j angle isEnough
  TurnsBack mending ->
    (titled "E0316" "the elements touch here, but the contour would have to turn back")
      { message = sideText j,
        fixes =
          [ senseFix unit (word, sense, c)
            | (at', word, sense, c) <- turnable j,
              at' `elem` mending
          ],
        hints =
          [ "Turn the line round, let it touch the circle on the other side, or change the sense \
            \of the circle."
            | null mending
          ]
      }
  TangentNeedsCircles -> repeatedReport unit (j :| []) [] fault
  ConcentricTangent ->
    (titled "E0318" "circles with the same centre have no common tangent")
      { hints = ["Correct the centre of one of the two, or leave one of them out."]
      }
  CoincidentTangent isEnough ->
    (titled "E0319" "these circles are the same, so there is no tangent from one to the other")
      { fixes = if isEnough then leaveOutSecond j else [],
        hints = ["Leave one of them out, or correct its centre or its radius."]
      }
  NoCommonTangent senses -> noTangentReport unit j senses
  FilletAtPoint -> repeatedReport unit (j :| []) [] fault
  NoFillet sense r largest turned -> noFilletReport unit j sense r (largest, turned)
  AmbiguousFillet centres ->
    (titled "E0323" "two fillets make contours of the same length")
      { message =
          [ "Their centres are "
              <> Text.intercalate " and " (map (Vec.toText unit 4) centres)
              <> "."
          ],
        hints =
          ["Change the order or the senses of the elements so that one of them is the shorter way."]
      }
  where
    titled = linkTitle unit j
    apartBy gap = Decimal.nonZeroIn unit gap <> " apart"

-- | The report of a smooth link at a corner. If @isEnough@, the contour has no fault without it.
kinkedReport :: LengthUnit -> Neighbours -> Rad -> Bool -> Report
kinkedReport unit j angle isEnough =
  ( linkTitle
      unit
      j
      "E0348"
      (both unit j <> " meet at an angle of " <> Decimal.short 2 (degrees angle) <> " deg")
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

noTangentReport :: LengthUnit -> Neighbours -> [(Sense, Sense)] -> Report
noTangentReport unit j senses =
  ( linkTitle
      unit
      j
      "E0320"
      "no common tangent fits the senses in which these circles are traversed"
  )
    { message = ["One circle lies inside the other: they have no common tangent." | null senses],
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
  LengthUnit ->
  Neighbours ->
  Sense ->
  Mm ->
  (Maybe FittingFillets, Maybe FittingFillets) ->
  Report
noFilletReport unit j sense r (largest, turned) =
  ( linkTitle unit j "E0322" $
      "no "
        <> (if sense == Clockwise then "clockwise" else "counter-clockwise")
        <> " arc of radius "
        <> Decimal.inUnit unit r
        <> " leads from "
        <> describe unit (value (before j))
        <> " to "
        <> describe unit (value (after j))
  )
    { message = why,
      fixes = offered,
      hints = [if null why then hint else alternatively offered hint]
    }
  where
    offered =
      [largestFix unit fillets | Just fillets <- [largest]]
        <> [turnedFix unit fillets | Just fillets <- [turned]]
    (why, hint) = case (value (before j), value (after j)) of
      (OnLine l, OnLine m)
        | Intersection.Apart gap <- Intersection.lines l m ->
          ( [ "The lines are parallel, "
                <> Decimal.inUnit unit gap
                <> " apart: there is no corner to round."
            ],
            "Write the element that is missing between them."
          )
      (OnCircle _ c, OnCircle _ d)
        | Just words' <- nested unit c d ->
          (words', "Correct the centre or the radius of one of them.")
      _ ->
        ( [],
          "A radius without a sign makes a clockwise arc, one with a minus a counter-clockwise \
          \one; check the sign, the radius, and the senses of the neighbours."
        )

-- | The report of one cause that several links of a contour have in common: a tangent beside
-- elements that are no circles, or a fillet beside a point. It points at the first of these links.
-- If all elements of the contour are points, @edges@ has the region of each point that has a point
-- before it, and the point before it.
repeatedReport :: LengthUnit -> NonEmpty Neighbours -> [(Region, Point)] -> LinkFault -> Report
repeatedReport unit js@(j :| more) edges fault = stopped $ case fault of
  FilletAtPoint ->
    ( linkTitle
        unit
        j
        "E0321"
        ( "a fillet or chamfer rounds a corner of edges, not a point"
            <> count
        )
    )
      { others = places,
        fixes = edgesFix unit edges,
        hints = ["Write the edges as lines: line(p, q)."]
      }
  _ ->
    ( linkTitle
        unit
        j
        "E0317"
        ( "a tangent joins two circles, not "
            <> describe unit (value (if isCircle (value (before j)) then after j else before j))
            <> count
        )
    )
      { others = if null more then others (linkTitle unit j "E0317" "") else places,
        fixes = commonFixes unit js,
        hints =
          [ "Where the two elements touch, write smooth; where they meet at a corner, nothing; to \
            \round the corner, fillet and a radius."
            | null (commonFixes unit js)
          ]
      }
  where
    stopped found = found {controlStop = Just (stopOf fault)}
    count = case length more of
      0 -> ""
      n -> " (" <> Decimal.whole (n + 1) <> " times in this contour)"
    places = [Label (link k) "also here" | k <- take 5 more]

-- | The sentence that says what would make a circle touch a line or another circle. Empty for other
-- neighbours.
touchText :: LengthUnit -> Neighbours -> [Text]
touchText unit j = case (value (before j), value (after j)) of
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
          <> Decimal.inUnit unit r
          <> ", or with its centre "
          <> Decimal.inUnit unit (abs' (minus r (radius c)))
          <> (if r > radius c then " nearer, " else " further away, ")
          <> describe unit (OnCircle Clockwise c)
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
linkTitle :: LengthUnit -> Neighbours -> ReportCode -> Text -> Report
linkTitle unit j code title =
  (at (link j) code title)
    { others =
        [ Label r (describe unit carrier)
          | Located r carrier <- [before j, after j],
            r /= link j
        ]
    }

-- | The descriptions of two neighbours, joined by "and".
both :: LengthUnit -> Neighbours -> Text
both unit j = describe unit (value (before j)) <> " and " <> describe unit (value (after j))

-- Fixes

-- | Proposal that makes several changes.
changes :: Text -> [Fix] -> Fix
changes what = Fix.proposed . Fix.joined what

-- | Fix that gives fillets the largest radius that fits.
largestFix :: LengthUnit -> FittingFillets -> Fix
largestFix unit = filletsFix unit "Write the largest radius that fits here: "

-- | Fix that gives fillets the other sense.
turnedFix :: LengthUnit -> FittingFillets -> Fix
turnedFix unit = filletsFix unit "Give the fillet the other sense: "

-- | Fix that writes fillets. Its title ends with the text of the first one. Radii are rounded down
-- to three decimals.
filletsFix :: LengthUnit -> Text -> FittingFillets -> Fix
filletsFix unit what (FittingFillets fillets) =
  changes
    (what <> Text.concat (take 1 [text sense r | (_, sense, r) <- fillets]) <> ".")
    [Fix.exchange "" word (text sense r) | (word, sense, r) <- fillets]
  where
    text sense r = "fillet " <> (if sense == Clockwise then "" else "-") <> downTo unit r

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
nearFix :: LengthUnit -> Neighbours -> Point -> Fix
nearFix unit j p =
  let text = "meet near " <> Vec.toText unit 4 p
   in linkFix
        ( "Write " <> text
            <> "."
        )
        j
        text

-- | Fix that draws a line from the end of the first element to the start of the second one. There
-- is none if the program writes a link, or if an element has no end.
joinFixes :: LengthUnit -> Neighbours -> [Fix]
joinFixes unit j =
  [ Fix.proposed
      ( between
          ( "Join them by a line from " <> Vec.toText unit 4 p <> " to " <> Vec.toText unit 4 q
              <> "."
          )
          j
          ("line(" <> Vec.toExactText unit p <> ", " <> Vec.toExactText unit q <> ")")
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

senseFix :: LengthUnit -> (Region, Sense, Circle) -> Fix
senseFix unit (word, sense, c) =
  Fix.proposed
    ( Fix.exchange
        ( "Traverse " <> describe unit (OnCircle sense c) <> " the other way: write " <> other
            <> "."
        )
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
commonFixes :: LengthUnit -> NonEmpty Neighbours -> [Fix]
commonFixes unit js = case traverse remedy (NonEmpty.toList js) of
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
      Intersection.Crossing p _ -> Just ("meet near " <> Vec.toText unit 4 p)
      Intersection.Apart _ -> Nothing
      Intersection.Same -> Nothing

-- | Fix that writes lines in place of points: each point becomes the line to it from the point
-- before. There is none if an item of the program gives several points.
edgesFix :: LengthUnit -> [(Region, Point)] -> [Fix]
edgesFix unit edges =
  [ changes
      "Write the edges as lines from point to point."
      [Fix.enclosure "" ("line(" <> Vec.toExactText unit p <> ", ") r ")" | (r, p) <- edges]
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

-- | The hint that names the pairs of senses with which the circles have a common tangent.
tangentHint :: [(Sense, Sense)] -> Text
tangentHint senses =
  "There is one when they are traversed " <> Text.intercalate ", or " (map pairText senses) <> "."

pairText :: (Sense, Sense) -> Text
pairText (first, second) = senseText first <> " then " <> senseText second
