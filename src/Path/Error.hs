-- | What can be wrong with the way of a cutter around a part.
module Path.Error
  ( Error (..),
    Tooling (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm (..), Rad (..), plus, times)
import Base.Region (Region)
import Data.Text (Text)
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Element (..), Side (..), Work (..))
import Report.Report (Code, Label (..), Place (..), Report (..), report)
import Report.Report qualified as Report

data Error
  = -- | @outside@ or @inside@ of an open contour
    SideOfOpen Region Side Name Region
  | -- | the statement, the cutter's radius, the arc and its radius, the largest radius that fits
    ConcaveRadius Region Tooling Element Mm (Maybe Mm)
  | -- | a corner towards the cutter, and where it is
    InnerCorner Region Tooling Element Element Point (Maybe Mm)
  | -- | on its way along the first element the cutter cuts the second
    Collision Region Tooling Element Element Point (Maybe Mm)
  | -- | a move that cuts into an element, how deep, and whether it even crosses it
    CutsPart Region Segment Element Mm Bool Point
  | -- | milling one contour cuts into another: the statement, the element being milled, the element cut, how deep
    MillsAnother Region Region Element Mm Point
  | -- | milling without a depth while the cutter stands so high above the part
    CutsAir Region Mm
  | -- | climb or conventional where the cutter has no side
    SenseOnContour Region Region
  | -- | climb or conventional that the side does not allow
    SenseAgainstSide Region Region
  | -- | a turned profile that goes below the axis of the spindle: the statement, the element
    BelowAxis Region Element
  | -- | an allowance where the cutter has no side: the statement, the contour's element if it asks it
    AllowanceOnContour Region
  deriving stock (Eq, Show)

-- | What cuts: the radius of the cutter or of the nose, and what it leaves standing.
data Tooling = Tooling {work :: Work, radius :: Mm, left :: Mm}
  deriving stock (Eq, Show)

-- | The words for it.
toReport :: Error -> Report
toReport err = case err of
  SideOfOpen region side (Name name) contour ->
    (at region "E0401" ("the open contour ‘" <> name <> "’ has no " <> sideWord side))
      { others = [Label contour "this contour is open"],
        hints = ["Say left or right of the walk, or on."]
      }
  ConcaveRadius region r element old largest ->
    (at (origin element) "E0402" (toolWord r <> " does not fit into a concave radius of " <> Decimal.mm old))
      { label = shape element,
        others = [Label region (doneWord r <> " here") | region /= origin element],
        hints = [fits r largest]
      }
  InnerCorner region r first second p largest ->
    (at (origin first) "E0403" "no round cutter reaches into this inner corner")
      { label = shape first,
        others = second' first second <> [Label region (doneWord r <> " here with " <> toolWord r)],
        message = ["The corner is at " <> Vec.written 3 p <> "."],
        hints = ("Round the corner with a fillet of at least " <> Decimal.mm (plus (radius r) (left r)) <> ", the " <> radiusWord r <> ".") : [fits r largest | Just _ <- [largest]]
      }
  Collision region r first second p largest ->
    (at (origin first) "E0404" (toolWord r <> " cannot follow this element without cutting another one"))
      { label = shape first,
        others = second' first second <> [Label region (doneWord r <> " here") | region /= origin first],
        message = ["With its centre at " <> Vec.written 3 p <> " on the way along " <> shape first <> " it would cut " <> shape second <> "."],
        hints = [fits r largest]
      }
  CutsPart region way element depth crosses p ->
    (at region "E0405" (if crosses then "this move crosses the contour of the part" else "this move cuts into the part by " <> Decimal.mm depth))
      { label = "the way to here",
        others = [Label (origin element) (shape element) | origin element /= region],
        message = ["It goes from " <> Vec.written 3 (Segment.start way) <> " to " <> Vec.written 3 (Segment.end way) <> "; the trouble is worst with the cutter's centre at " <> Vec.written 3 p <> "."],
        hints = ["Choose approach and retract points from which the straight way stays clear of the part."]
      }
  MillsAnother region milled element depth p ->
    (at region "E0406" ("milling this contour cuts into another one by " <> Decimal.mm depth))
      { label = "milled here",
        others = [Label milled "along this element", Label (origin element) ("it cuts " <> shape element)],
        message = ["The cutter's centre is then at " <> Vec.written 3 p <> "."],
        hints = ["Use a smaller cutter, or check the sides and the distance of the contours."]
      }
  CutsAir region z ->
    (at region "E0407" ("the cutter stands " <> Decimal.mm z <> " above the part here and cuts nothing"))
      { hints = ["Say how deep to go: depth 5 mm. Or begin at height 0, if the height is set by hand."]
      }
  SenseOnContour region statement ->
    (at region "E0408" "the cutter runs on the contour itself: it cuts on both sides, climb on one and conventional on the other")
      { others = [Label statement "milled here"],
        hints = ["Leave the word out, or mill the contour on one of its sides."]
      }
  SenseAgainstSide region side ->
    (at region "E0409" "the cutter does not cut like this on this side of the walk")
      { others = [Label side "the side is given here"],
        message = ["With the spindle clockwise the cutter climbs on the left of the walk; with the spindle counter-clockwise, on the right."],
        hints = ["Leave the word out, take the other side, or mill reversed(…). In a mirrored block left becomes right; outside and inside stay what they are."]
      }
  BelowAxis region element ->
    (at (origin element) "E0410" "a turned profile cannot go below the axis of the spindle, y = 0")
      { label = shape element,
        others = [Label region "turned here"],
        hints = ["x runs along the spindle, y is the radius: half the diameter."]
      }
  AllowanceOnContour region ->
    (at region "E0411" "nothing can be left standing where the cutter runs on the contour itself")
      { hints = ["Leave the allowance out, or take a side."]
      }

at :: Region -> Code -> Text -> Report
at region code = report Report.Error code (InSource region)

second' :: Element -> Element -> [Label]
second' first second = [Label (origin second) (shape second) | origin second /= origin first]

sideWord :: Side -> Text
sideWord side = case side of
  Outside -> "outside"
  Inside -> "inside"
  LeftSide -> "left"
  RightSide -> "right"
  On -> "centre line"

fits :: Tooling -> Maybe Mm -> Text
fits tool largest = case (largest, work tool) of
  (Nothing, Milled) -> "No cutter fits here, however small."
  (Nothing, Turned) -> "No nose fits here, however small."
  (Just (Mm r), Milled) -> "The largest cutter that fits has a diameter of " <> Decimal.mm (rounded (2 * r)) <> "."
  (Just (Mm r), Turned) -> "The largest nose that fits has a radius of " <> Decimal.mm (rounded r) <> "."
  where
    rounded x = Mm (fromInteger (floor (x * 1000)) / 1000)

-- | What cuts, in words.
toolWord :: Tooling -> Text
toolWord tool = what <> (if left tool > Mm 0 then " that leaves " <> Decimal.mm (left tool) else "")
  where
    what = case work tool of
      Milled -> "a cutter of diameter " <> Decimal.mm (times 2 (radius tool))
      Turned -> "a nose of radius " <> Decimal.mm (radius tool)

doneWord :: Tooling -> Text
doneWord tool = case work tool of
  Milled -> "milled"
  Turned -> "turned"

radiusWord :: Tooling -> Text
radiusWord tool = (case work tool of Milled -> "radius of the cutter"; Turned -> "radius of the nose") <> (if left tool > Mm 0 then " and the allowance" else "")

shape :: Element -> Text
shape element = case segment element of
  Straight a b -> "the line from " <> Vec.written 3 a <> " to " <> Vec.written 3 b
  Arc {start, centre, sweep = Rad s} ->
    "the " <> (if s > 0 then "counter-clockwise" else "clockwise") <> " arc of radius " <> Decimal.mm (Segment.radius centre start) <> " about " <> Vec.written 3 centre
