{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Faults of contours: wrong elements, and links that cannot join their neighbours.
module Part.ContourError
  ( ContourFault (..),
    Neighbours (..),
    LinkFault (..),
    FittingFillets (..),
    ContourEnd (..),
    apart,
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..))
import Base.Region (Located (..), Region (..))
import Data.List (nub)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text qualified as Text
import Geometry.Carrier (Circle (..))
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ErrorText (alternatively, describe)
import Part.LinkError (FittingFillets (..), LinkFault (..), Neighbours (..))
import Part.LinkError qualified as LinkError
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at, quote)

-- | A fault of a contour. The first field is the region that the report points at, unless the
-- comment of the constructor says otherwise. The comment names the other fields in order.
data ContourFault
  = EmptyContour Region Name
  | -- | a closed contour whose only element is neither a circle nor a closed curve:
    -- that element, its carrier, and the region of the word @closed@ if the contour has no fault
    -- as an open one
    LoneElement Region ElementCarrier (Maybe Region)
  | -- | a contour whose segments are all no longer than 'Geometry.Tolerance.coincident'
    NoLength Region
  | -- | a link after the only element of a contour, although a circle or a closed curve needs none
    LinkOfLoneCircle Region
  | -- | an open contour whose first or last element is a circle, which has no ends: the circle, its
    -- carrier, the ends of the contour that lie on circles, and the region of the word @open@ if
    -- the circle is the only element
    NoEnd Region ElementCarrier [ContourEnd] (Maybe Region)
  | -- | a link after the last element of an open contour: the region of the word @open@
    LinkAtEnd Region Region
  | -- | a closed contour as an element of another contour: the name of the closed contour
    ClosedElement Region Name
  | -- | a closed curve as the element of an open contour: the region of the word @open@
    ClosedCurve Region Region
  | -- | a statement that sets a starting point on an open contour: the name of the contour
    OpenBegins Region Name
  | -- | a link that cannot join its neighbours, whatever the other links do: the neighbours, and
    -- the reason. The report points at the link
    NotLinked Neighbours LinkFault
  | -- | links of a contour that cannot join their neighbours for one reason: the neighbours of each
    -- link, the reason, and, if all elements are points, the region of each point that has a point
    -- before it, and the point before it
    NotLinkedOften (NonEmpty Neighbours) LinkFault [(Region, Point)]
  | -- | an element that is too short for the links at its two ends: the element, the length by
    -- which it is too short, the regions of these links, and the largest fillet radius that fits.
    -- The radius is 'Nothing' if no link is a fillet or no radius fits
    Overrun Region ElementCarrier Mm [Region] (Maybe FittingFillets)
  | -- | a contour that meets itself: the region of its name, the regions of the two elements that
    -- meet, their common point, and true if one of the two has a fillet. If it does not meet itself
    -- when fillets get the other sense, the last field has these fillets. The report points at the
    -- first of the two elements
    CrossesItself Region Region Region Point Bool (Maybe FittingFillets)
  | -- | a contour that meets itself only because it is open: the region of the word @open@, and the
    -- fault
    ClosedMeant Region ContourFault
  | -- | a fault that ends when two neighbouring items of the contour change places
    OutOfOrder ContourFault Region Region
  | -- | a fault that ends when a line or a circle is traversed in the opposite direction: the
    -- fault, the element, and the region of the sense of a circle
    AgainstTravel ContourFault (Located ElementCarrier) (Maybe Region)
  | -- | a fault that ends when two links that meet near points exchange these points: the fault,
    -- and the region of each link with its point
    NearExchanged ContourFault (Region, Point) (Region, Point)
  | -- | lines that do not touch the circles that they join, while tangents join these circles: the
    -- fault of the first line, the region of the link before each line and the item of the line
    TangentMeant ContourFault (NonEmpty (Region, Region))
  deriving stock (Eq, Show)

-- | An end of an open contour that lies on a circle: the item of the circle, true for the beginning
-- of the contour, and the circle.
data ContourEnd = ContourEnd {item :: Region, isBeginning :: Bool, circle :: ElementCarrier}
  deriving stock (Eq, Show)

-- | The elements before and after a link at which they do not reach each other. 'Nothing' for other
-- faults.
apart :: ContourFault -> Maybe (Located ElementCarrier, Located ElementCarrier)
apart fault = case fault of
  NotLinked j (NoMeeting _) -> Just (before j, after j)
  NotLinked j (NotSmooth _ _) -> Just (before j, after j)
  _ -> Nothing

-- | The report of a fault.
toReport :: LengthUnit -> ContourFault -> Report
toReport unit fault = case fault of
  EmptyContour region (Name name) ->
    at region "E0307" ("the contour " <> quote name <> " has no elements")
  LoneElement region carrier closure ->
    (at region "E0308" ("a closed contour cannot consist of " <> describe unit carrier <> " alone"))
      { message = ["Only a circle or a closed curve closes by itself."],
        fixes = opened,
        hints = [alternatively opened "Add the other elements of the contour."]
      }
    where
      opened =
        [ Fix.proposed (Fix.exchange "Make the contour open." word "open")
          | isLong carrier,
            Just word <- [closure]
        ]
  NoLength region ->
    at region "E0328" "the contour has no length"
  LinkOfLoneCircle region ->
    (at region "E0329" "a circle or a closed curve alone needs no link")
      { fixes = [Fix.removal "Leave the link out: it closes by itself." region]
      }
  NoEnd region carrier ends closure -> noEndReport unit region carrier ends closure
  LinkAtEnd region closure ->
    (at region "E0310" "nothing follows this link")
      { others = [Label closure "the contour is open"],
        fixes = [closedFix closure, Fix.proposed (Fix.removal "Leave the link out." region)]
      }
  ClosedElement region (Name name) ->
    ( at
        region
        "E0343"
        ("the contour " <> quote name <> " is closed and cannot be a part of another")
    )
      { hints = ["Only an open contour leads on to the next element."]
      }
  ClosedCurve region closure ->
    (at region "E0343" "this curve is closed, but the contour is open")
      { fixes = [closedFix closure],
        hints = ["Or begin and end the curve at different points."]
      }
  OpenBegins region (Name name) ->
    (at region "E0347" ("the open contour " <> quote name <> " begins at its first element"))
      { fixes = [Fix.proposed (Fix.removal "Leave start near out." region)],
        hints =
          [ "To begin at its other end, mill reversed("
              <> name
              <> ") on the other side."
          ]
      }
  NotLinked neighbours linkFault -> LinkError.toReport unit neighbours linkFault
  NotLinkedOften neighbours linkFault edges ->
    LinkError.repeatedReport unit neighbours edges linkFault
  Overrun region carrier overlap links largest ->
    overrunReport unit region carrier overlap links largest
  ClosedMeant word inner ->
    let r = toReport unit inner
     in (at word "E0325" "the open contour ends at the point where it begins")
          { others = [l | l@(Label region _) <- others r, region /= word],
            fixes = [closedFix word]
          }
  OutOfOrder inner first second ->
    let r = toReport unit inner
     in r
          { others = [Label first "exchange this", Label second "with this"],
            fixes =
              Fix.proposed (Fix.swap exchange first second) : fixes r,
            message = [],
            hints = []
          }
    where
      exchange = "Exchange the two elements, if their order is wrong."
  AgainstTravel inner (Located region carrier) word ->
    let r = toReport unit inner
     in ( at
            region
            (code r)
            ("the contour passes " <> describe unit carrier <> " in the opposite direction")
        )
          { controlStop = controlStop r,
            fixes = case (carrier, word) of
              (OnCircle sense c, Just w) -> [LinkError.senseFix unit (w, sense, c)]
              _ ->
                [ Fix.proposed
                    (Fix.enclosure "Write reversed(…) around it." "reversed(" region ")")
                ],
            hints = ["Or exchange its two points where it is made." | OnLine _ <- [carrier]]
          }
  NearExchanged inner (first, p) (second, q) ->
    let r = toReport unit inner
     in ( at
            first
            (code r)
            ( "the near points "
                <> Vec.toText unit 4 p
                <> " and "
                <> Vec.toText unit 4 q
                <> " have to change places"
            )
        )
          { controlStop = controlStop r,
            others = [Label second "with this one"],
            message = ["As they stand, " <> title r <> "."],
            fixes = [Fix.proposed (Fix.swap "Exchange the two points." first second)]
          }
  TangentMeant inner lines' ->
    let title
          | length lines' == 1 =
            "Join the circles by a tangent: write tangent in place of smooth and the line."
          | otherwise =
            "Join the circles by tangents: write tangent in place of smooth and each of the lines."
        r = toReport unit inner
     in r
          { message = case inner of NotLinked _ (TurnsBack _) -> message r; _ -> [],
            hints = [],
            fixes =
              [ Fix.proposed . Fix.joined title $
                  concat
                    [ [Fix.exchange title at' "tangent", Fix.removal title line]
                      | (at', line) <- NonEmpty.toList lines'
                    ]
              ]
          }
  CrossesItself contour first second p hasFillets turned ->
    (at first "E0325" ("the contour crosses or touches itself at " <> Vec.toText unit 4 p))
      { label = "this element",
        others =
          [Label second "meets this one" | second /= first] <> [Label contour "in this contour"],
        fixes =
          [LinkError.turnedFix unit fillets | Just fillets <- [turned]],
        hints =
          [ "Check the signs of the fillets: one without a sign is clockwise, one with a minus \
            \counter-clockwise."
            | hasFillets
          ]
            <> [ "Correct the numbers of one of the two elements, or the order of the elements."
                 | not hasFillets
               ]
      }

-- | The report of an open contour that begins or ends on a circle. If the circle is the only
-- element, @closure@ is the region of the word @open@.
noEndReport :: LengthUnit -> Region -> ElementCarrier -> [ContourEnd] -> Maybe Region -> Report
noEndReport unit region carrier ends closure =
  (at region "E0309" ("an open contour cannot " <> verbs <> " on " <> describe unit carrier))
    { message = ["A circle has no ends, so nothing says where on it the contour " <> third <> "."],
      fixes = maybe [pointFix] (pure . closedFix) closure,
      hints =
        [ "Write the point of the circle at which the contour "
            <> third
            <> " as an element of its own, before or after the circle."
        ]
    }
  where
    verbs = Text.intercalate " and " (map verb ends)
    third = Text.intercalate " and " (map ((<> "s") . verb) ends)
    verb e = if isBeginning e then "begin" else "end"
    pointFix =
      Fix.proposed . Fix.joined ("Let the contour " <> Text.intercalate ", and " places <> ".") $
        [ if isBeginning e
            then Fix.insertion "" (start (item e)) (p <> " ")
            else Fix.insertion "" (end (item e)) (" meet near " <> p <> " " <> p)
          | e <- ends,
            let p = rightmost (circle e)
        ]
    places = [verb e <> " at the point " <> rightmost (circle e) | e <- ends]
    rightmost c = case c of
      OnCircle _ (Circle m (Mm r)) ->
        Vec.toExactText unit (Vec.point (Vec.x m + r) (Vec.y m))
      _ -> ""

-- | Fix that makes a contour closed. @closure@ is the region of the word @open@.
closedFix :: Region -> Fix
closedFix closure = Fix.proposed (Fix.exchange "Make the contour closed." closure "closed")

-- | True for an element that is longer than a point.
isLong :: ElementCarrier -> Bool
isLong carrier = case carrier of
  AtPoint _ -> False
  OnLine _ -> True
  OnCircle _ _ -> True
  OnCurve _ -> True

-- | The report of an element that is too short for the links at its ends. It is too short by
-- @overlap@. @largest@ is the largest fillet radius that fits, if any fits.
overrunReport ::
  LengthUnit ->
  Region ->
  ElementCarrier ->
  Mm ->
  [Region] ->
  Maybe FittingFillets ->
  Report
overrunReport unit region carrier overlap links largest =
  (at region "E0324" title)
    { label = "it would have to be traversed backwards",
      others = [Label l "this link takes its share" | l <- nub links],
      controlStop = Just "17535",
      fixes = [LinkError.largestFix unit fillets | Just fillets <- [largest]],
      hints =
        [ case largest of
            Just _ -> "Or make the element longer."
            Nothing ->
              "Make the fillet or chamfer smaller, or check the directions of the neighbours."
        ]
    }
  where
    title =
      describe unit carrier
        <> " is too short by "
        <> Decimal.nonZeroIn unit overlap
        <> " for the links at its ends"
