{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Errors of toolpaths, with the texts of their reports.
module Toolpath.Error
  ( Error (..),
    Intrusion (..),
    ContourBeginning (..),
    Tool (..),
    Unsupported (..),
    toReport,
    Warning (..),
    RestPosition (..),
    warningReport,
    cutter,
    fittingSize,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..), Rad (..), minus, plus, times)
import Base.Region (Located (..), Region)
import Data.Maybe (isJust)
import Data.Text (Text)
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Geometry
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part
  ( Contour (contourName),
    Element (..),
    Ends (..),
    MillingPlaces,
    Side (..),
    Work (Engraved),
  )
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at)
import Toolpath.CarvingReport qualified as CarvingReport
import Toolpath.CompensationReport (Unsupported (..))
import Toolpath.CompensationReport qualified as CompensationReport
import Toolpath.DescentReport (DescentFault)
import Toolpath.DescentReport qualified as DescentReport
import Toolpath.ErrorFix qualified as ErrorFix
import Toolpath.HoleReport (HoleCut)
import Toolpath.HoleReport qualified as HoleReport
import Toolpath.LinkingMoveError (LinkingMoveError)
import Toolpath.LinkingMoveError qualified as LinkingMoveError
import Toolpath.Tab (TabFault)
import Toolpath.Tolerance qualified as Tolerance
import Toolpath.Toolpath (CarvingRest)
import Toolpath.WarningReport

-- | Reasons why there is no toolpath. Each comment lists the fields of its constructor in order.
--
-- In these lists "the statement" is the region of the statement's first word, and "the centre" is
-- the cutter's centre. "The largest radius that fits" is that of the largest cutter without this
-- problem; Nothing if there is none. A constructor without a list has the statement only.
data Error
  = -- | @outside@ or @inside@ at an open contour: the region of the side, the side, the contour's
    -- name, the region of that name
    SideOfOpen Region Side Name Region
  | -- | @outside@ or @inside@ at a profile that ends at the x at which it begins: the region of the
    -- side, the side, the profile's name, the region of that name
    SideOfFace Region Side Name Region
  | -- | a concave radius smaller than the cutter's: the statement, the cutter, the arc and its
    -- radius, the largest radius that fits
    ConcaveRadius Region Tool Element Mm (Maybe Mm)
  | -- | an inner corner: the statement, the cutter, both elements, the corner, the largest radius
    -- that fits, and True if the program may write a fillet after the first element
    InnerCorner Region Tool Element Element Point (Maybe Mm) Bool
  | -- | in its pass along the first element the cutter would cut the second one: the statement, the
    -- cutter, both elements, the position of the centre, the largest radius that fits
    Collision Region Tool Element Element Point (Maybe Mm)
  | -- | a move that cuts into an element: the region that asks for the move, the move, the element,
    -- the depth of the cut, the kind of intrusion, the position of the centre,
    -- and, for the last move of an approach to a contour, the beginning of this contour
    CutsPart Region Segment Element Mm Intrusion Point (Maybe ContourBeginning)
  | -- | linking moves that cut into the part for one cause
    WrongLink LinkingMoveError
  | -- | a V-carving whose tip fits nowhere: the statement, the radius of the tip
    NowhereCarved Region Mm
  | -- | a V-carving whose tip leaves material because it is too wide: the statement, what it
    -- leaves, the radius of the tip
    CarvingLeaves Region CarvingRest Mm
  | -- | a hole that cuts into a contour
    HoleCuts HoleCut
  | -- | a V-carving whose tip goes across a contour: the statement, the element, the position of
    -- the tool's axis
    CarvesAcross Region Element Point
  | -- | milling one contour cuts into another: the kind of work, the statement, the region of the
    -- element along which the cutter moves, the element that is cut, the depth of the cut, the
    -- position of the centre. In a pocket the second region is that of the statement, too
    MillsAnother Work Region Region Element Mm Point
  | -- | milling on a contour that another statement mills on one of its sides: the statement, the
    -- region of @on@, the element, the depth of the cut, the ends of the contour
    MillsItself Region Region Element Mm Ends
  | -- | milling without a depth at a height above the part, where the cutter cuts nothing: the
    -- statement, the height, and the last point of the approach if it gives this height
    CutsAir Region Mm (Maybe (Located Point))
  | -- | a closed contour to be turned: the region of the side, the contour's name, the region of
    -- that name
    TurnsClosed Region Name Region
  | -- | climb or conventional milling where the cutter's centre moves on the contour: the word in
    -- the program, the statement
    SenseOnContour Region Region
  | -- | climb or conventional milling that contradicts the side: the word in the program, the
    -- region of the side
    SenseAgainstSide Region Region
  | -- | a turned profile that goes below the axis of the spindle: the statement, the element
    BelowAxis Region Element
  | -- | an allowance where the cutter's centre moves on the contour: the statement, the side, the
    -- ends of the contour
    AllowanceOnContour Region (Located Side) Ends
  | -- | a blade along a contour on which no element has a bevel
    NoBevel Region
  | -- | a blade that has no side of the contour, because @on@ is asked for: the statement, the
    -- side, the ends of the contour
    BladeOnContour Region (Located Side) Ends
  | -- | two elements that meet without a corner but with different bevels: the statement, both
    -- elements, their bevels at the joint in radians
    BevelJumps Region Element Element Double Double
  | -- | cutter compensation by the control, together with a request that the input of a control
    -- cannot express: the region that asks for cutter compensation, the other request
    NotForControl Region Unsupported
  | -- | an approach or retract too short for a control: the move, the region that asks for cutter
    -- compensation, True for an approach and False for a retract, the length of the move, the
    -- cutter's radius. If there is no straight and level move, the length is 0, and the first
    -- region is the statement
    ShortForControl Region Region Bool Mm Mm
  | -- | an approach from a direction that a control does not accept: the move, the region that asks
    -- for cutter compensation, the end of the approach
    WrongWayForControl Region Region Point
  | -- | a concave arc that a control cannot follow: the statement, the region that asks for cutter
    -- compensation, the element (Nothing for a lead), the radius of the arc, the cutter's radius
    TightForControl Region Region (Maybe Element) Mm Mm
  | -- | an element that is too short for a control: the statement, the region that asks for cutter
    -- compensation, the element (Nothing for a lead), its length, the least length. Both are
    -- radii if the element is an arc that is refused because of the arc after it
    TinyForControl Region Region (Maybe Element) Mm Mm
  | -- | a slight corner that a control ignores: the region that asks for cutter compensation, both
    -- elements, the change of direction, the depth of the control's cut into the part
    SlightForControl Region Element Element Rad Mm
  | -- | a corner at which the contour almost reverses, which a control refuses: the region that
    -- asks for cutter compensation, both elements, the change of direction
    BackForControl Region Element Element Rad
  | -- | no toolpath clears the pocket: the statement's first word, the outer contour, the
    -- allowance of the pass
    NoPathInPocket Region Contour Mm
  | -- | no toolpath along a contour although rest material is allowed: the statement, the contour,
    -- the allowance of the pass
    NoPathAlong Region Contour Mm
  | -- | a pocket without a depth in which the cutter must be lifted: the statement's first word,
    -- the beginning and the end of the straight move that a wall blocks
    HasToRise Region Point Point
  | -- | an element of a pocket's walls whose own allowance exceeds that of the pocket's last pass:
    -- the statement's first word, the element
    KeepsMore Region Element
  | -- | a pass of a pocket whose loops have too many segments: the statement's first word, the
    -- largest number
    TooManyLoops Region Int
  | -- | a way down that is not possible
    NoDescent DescentFault
  | -- | tabs without room: the region of the setting, the length of the raised part of one tab,
    -- and the fault
    NoTab Region Mm TabFault
  deriving stock (Eq, Show)

-- | The beginning of a contour to which an approach leads.
data ContourBeginning = ContourBeginning
  { -- | the point of the contour at which the cutter would begin
    beginsAt :: Point,
    -- | the statement, if the contour may begin elsewhere
    mayMove :: Maybe MillingPlaces
  }
  deriving stock (Eq, Show)

-- | The kinds of intrusion: cuts of a move into a contour, or into the allowance on a contour.
data Intrusion
  = -- | the cutter cuts into the part, and its centre stays on one side of the contour
    CutsContour
  | -- | the path of the centre touches or crosses the contour
    Crossing
  | -- | the cutter cuts into the allowance on the contour
    CutsAllowance
  deriving stock (Eq, Show)

-- | The report of an error.
toReport :: LengthUnit -> Error -> Report
toReport unit err = case err of
  SideOfOpen region side (Name name) contour ->
    (at region "E0401" ("the open contour ‘" <> name <> "’ has no " <> sideWord side))
      { others = [Label contour "this contour is open"],
        fixes = ErrorFix.sideFixes region [LeftSide, RightSide, On]
      }
  SideOfFace region side (Name name) contour ->
    (at region "E0401" ("the profile ‘" <> name <> "’ has no " <> sideWord side))
      { others = [Label contour "this profile begins and ends at the same x"],
        fixes = ErrorFix.sideFixes region [LeftSide, RightSide, On]
      }
  ConcaveRadius region tool element old largest ->
    ( at
        (origin element)
        "E0402"
        ( cutter unit tool
            <> " does not fit into a concave radius of "
            <> Decimal.distinctIn unit (plus (radius tool) (leaves tool)) old
        )
    )
      { label = shape unit element,
        others = [Label region (workVerb tool <> " here") | region /= origin element],
        fixes =
          ErrorFix.sizeFixes unit tool largest
            <> [ ErrorFix.restFix (places tool)
                 | minus (plus (radius tool) (leaves tool)) old > Mm 0.001
               ],
        hints = [largestFit unit tool largest | null (ErrorFix.sizeFixes unit tool largest)]
      }
  InnerCorner region tool first second p largest mayRound ->
    ( at
        (origin first)
        "E0403"
        ( ( if any (>= Tolerance.smallestCutter) largest
              then cutter unit tool <> " does not reach"
              else "no round cutter reaches"
          )
            <> " into this inner corner"
        )
    )
      { label = shape unit first,
        others =
          secondLabel unit first second
            <> [Label region (workVerb tool <> " here with " <> cutter unit tool)],
        message =
          ["The corner is at " <> Vec.toText unit 3 p <> "."]
            <> narrowText unit tool first second,
        fixes =
          (if mayRound then ErrorFix.filletFixes unit tool first second else [])
            <> ErrorFix.sizeFixes unit tool largest
            <> [ErrorFix.restFix (places tool)],
        hints =
          [ "Or write the edges as lines, line(p, q), and round the corner: fillet and a radius."
            | not mayRound
          ]
            <> [ "Or take a smaller cutter, and round the corner with a fillet of its radius."
                 | mayRound && null (ErrorFix.filletFixes unit tool first second)
               ]
      }
  Collision region tool first second p largest ->
    collisionReport unit region tool (first, second) p largest
  CutsPart region move element depth intrusion p beginning ->
    (at region "E0405" ("this move " <> intruding unit intrusion depth))
      { label = "the move to here",
        others = [Label (origin element) (shape unit element) | origin element /= region],
        message =
          [ if Vec.isNear (Segment.start move) (Segment.end move)
              then "It goes up or down at " <> Vec.toText unit 3 p <> "."
              else
                "It goes from "
                  <> Vec.toText unit 3 (Segment.start move)
                  <> " to "
                  <> Vec.toText unit 3 (Segment.end move)
                  <> "; the trouble is worst with the cutter's centre at "
                  <> Vec.toText unit 3 p
                  <> "."
          ]
            <> [ "The contour begins at " <> Vec.toText unit 3 (beginsAt b) <> "."
                 | Just b <- [beginning]
               ],
        fixes =
          [ ErrorFix.startFix unit milling (Segment.start move)
            | Just ContourBeginning {mayMove = Just milling} <- [beginning]
          ],
        hints =
          [ "Choose points and leads whose ways stay clear of the part, or go over it: a third \
            \coordinate is a height."
          ]
      }
  WrongLink fault -> LinkingMoveError.toReport unit fault
  NoDescent fault -> DescentReport.toReport unit fault
  NoTab region long fault -> DescentReport.tabReport unit region long fault
  NowhereCarved region tip -> CarvingReport.nowhere unit region tip
  CarvingLeaves region rest tip -> CarvingReport.refused unit region rest tip
  HoleCuts cut -> HoleReport.toReport unit cut
  MillsItself region side element depth ends ->
    (at side "E0406" "on this contour the cutter cuts away what is to stand on one side of it")
      { others =
          [ Label (origin element) ("it cuts " <> shape unit element),
            Label region "milled here"
          ],
        message =
          [ "With on, the centre of the cutter runs along the contour, so it cuts "
              <> Decimal.inUnit unit depth
              <> " to both sides. Another statement mills the same contour on one side."
          ],
        fixes =
          ErrorFix.sideFixes
            side
            (if ends == Closed then [Inside, Outside] else [LeftSide, RightSide])
      }
  CarvesAcross region element p ->
    CarvingReport.across unit region (origin element, shape unit element) p
  MillsAnother kind region milled element depth p ->
    ( at
        region
        "E0406"
        ( (if kind == Engraved then "engraving" else "milling")
            <> " this contour cuts into another one by "
            <> Decimal.inUnit unit depth
        )
    )
      { label = if kind == Engraved then "engraved here" else "milled here",
        others =
          [Label milled "along this element" | milled /= region]
            <> [Label (origin element) ("it cuts " <> shape unit element)],
        message = ["The cutter's centre is then at " <> Vec.toText unit 3 p <> "."],
        hints =
          [ if kind == Engraved
              then "Move the text, make it smaller, or take a tool with a narrower groove."
              else "Use a smaller cutter, or check the sides and the distance of the contours."
          ]
      }
  CutsAir region z approach ->
    ( at
        region
        "E0407"
        ("the cutter is " <> Decimal.inUnit unit z <> " above the part here and cuts nothing")
    )
      { fixes = [ErrorFix.heightFix unit place p | Just (Located place p) <- [approach]],
        hints =
          [ "Write how deep to go, for example: depth 5 mm. Or begin at the height 0, if the \
            \height is set by hand."
          ]
      }
  TurnsClosed region (Name name) contour ->
    (at region "E0410" ("the contour ‘" <> name <> "’ is closed and cannot be turned"))
      { others = [Label contour "this contour is closed"],
        hints = ["A profile is an open contour: its edge as seen from the side, without the axis."]
      }
  SenseOnContour region statement ->
    ( at
        region
        "E0408"
        "the cutter runs on the contour itself: it cuts on both sides, climb on one and \
        \conventional on the other"
    )
      { others = [Label statement "milled here"],
        fixes = [Fix.proposed (Fix.removal "Leave the word out." region)],
        hints = ["Or mill the contour on one of its sides."]
      }
  SenseAgainstSide region side ->
    (at region "E0409" "the cutter does not cut like this on this side of the contour")
      { others = [Label side "the side is given here"],
        message =
          [ "With the spindle clockwise the cutter climbs on the left of the direction of travel; \
            \with the spindle counter-clockwise, on the right."
          ],
        fixes = [Fix.proposed (Fix.removal "Leave the word out." region)],
        hints =
          [ "Or take the other side, or mill reversed(…). In a mirrored block \
            \left becomes right; outside and inside stay what they are."
          ]
      }
  BelowAxis region element ->
    (at (origin element) "E0412" "a turned profile cannot go below the axis of the spindle, y = 0")
      { label = shape unit element,
        others = [Label region "turned here"],
        hints = ["x runs along the spindle, y is the radius: half the diameter."]
      }
  AllowanceOnContour region (Located side _) ends ->
    (at region "E0411" "a cutter that runs on the contour itself leaves no allowance")
      { others = [Label side "the centre of the cutter is on the contour"],
        fixes =
          ErrorFix.sideFixes
            side
            (if ends == Closed then [Outside, Inside] else [LeftSide, RightSide]),
        hints = ["Or leave the allowance out."]
      }
  NoBevel region ->
    (at region "E0414" "the blade does not know how far this contour leans")
      { hints =
          [ "Say it behind the elements of the contour: flange bevel mu, or: edge bevel 2 deg.",
            "For a surface that does not lean take a mill: tool mill(diameter 20)."
          ]
      }
  BladeOnContour region (Located side _) ends ->
    (at region "E0414" "a blade cuts on one side of its contour, not on it")
      { fixes =
          ErrorFix.sideFixes
            side
            (if ends == Closed then [Outside, Inside] else [LeftSide, RightSide])
      }
  BevelJumps region first second a b ->
    ( at
        (origin first)
        "E0415"
        ("the bevel jumps from " <> inDegrees a <> " to " <> inDegrees b <> " behind this element")
    )
      { label = shape unit first,
        others = secondLabel unit first second <> [Label region "milled here with a blade"],
        message = ["A blade swivels while it moves; it cannot jump."],
        hints = ["Put an element without a bevel between them: along it the blade turns evenly."]
      }
  NotForControl region what -> CompensationReport.unsupported region what
  ShortForControl region asked isIn length' radius' ->
    CompensationReport.shortMove unit region asked isIn length' radius'
  WrongWayForControl region asked p -> CompensationReport.wrongWay unit region asked p
  TightForControl region asked element old radius' ->
    CompensationReport.tightArc unit region asked element old radius'
  TinyForControl region asked element length' needed ->
    CompensationReport.tinyElement unit region asked element length' needed
  SlightForControl asked first second turned deep ->
    CompensationReport.slightCorner unit asked first second turned deep
  BackForControl asked first second turned ->
    CompensationReport.sharpTip unit asked first second turned
  NoPathInPocket region outline left ->
    noRoom
      region
      "no path clears this pocket"
      "its outline is"
      "in"
      outline
      (leaving unit left)
  NoPathAlong region along left ->
    noRoom
      region
      "no path goes along this contour"
      "it is"
      "beside"
      along
      (leaving unit left)
  HasToRise region p q ->
    (at region "E0421" "the cutter has to be lifted in this pocket, and it has no depth")
      { message =
          [ "On the straight line from "
              <> Vec.toText unit 3 p
              <> " to "
              <> Vec.toText unit 3 q
              <> " a wall is in the way."
          ],
        hints =
          [ "Say how deep the pocket is: depth 5 mm. The cutter then rises to the clearance height \
            \where it has to.",
            "Or begin within the pocket, and clear parts of it in statements of their own."
          ]
      }
  KeepsMore region element ->
    ( at
        (origin element)
        "E0422"
        "a pocket would cut away what is to be left on this element of its walls"
    )
      { label = shape unit element,
        others = [Label region "cleared here" | region /= origin element],
        hints =
          ["Leave so much at all walls, by allowance in the pocket. Then mill the contour inside."]
      }
  TooManyLoops region limit ->
    ( at
        region
        "E0423"
        ("clearing this pocket takes more than " <> Decimal.whole limit <> " motions at one depth")
    )
      { hints =
          [ "Take a larger step or a larger cutter; look for a coordinate in a wrong unit; or make \
            \several pockets of it."
          ]
      }

-- | The report that there is no room in a pocket, or beside a contour, for a pass with the
-- allowance @left@. The label of the contour is @called@ followed by the contour's name. @side@ is
-- the preposition, "in" or "beside".
noRoom :: Region -> Text -> Text -> Text -> Contour -> Maybe Text -> Report
noRoom region title called side contour left =
  (at region "E0420" title)
    { others = [Label there (called <> " ‘" <> name <> "’")],
      message =
        [ "Nowhere "
            <> side
            <> " it the cutter has room"
            <> maybe "" (" for a pass that leaves " <>) left
            <> "."
        ],
      hints = ["Take a smaller cutter" <> maybe "." (const ", or leave less.") left]
    }
  where
    Located there (Name name) = contourName contour

-- | The text of what a pass leaves; 'Nothing' if it leaves nothing.
leaving :: LengthUnit -> Mm -> Maybe Text
leaving unit left = if left > Mm 0 then Just (Decimal.inUnit unit left) else Nothing

-- | The text for a side.
sideWord :: Side -> Text
sideWord side = case side of
  Outside -> "outside"
  Inside -> "inside"
  LeftSide -> "left"
  RightSide -> "right"
  On -> "centre line"

-- | The text for an intrusion of this depth.
intruding :: LengthUnit -> Intrusion -> Mm -> Text
intruding unit intrusion depth = case intrusion of
  CutsContour -> "cuts into the part by " <> Decimal.inUnit unit depth
  Crossing -> "crosses the contour of the part"
  CutsAllowance -> "takes " <> Decimal.inUnit unit depth <> " of what is to be left on the contour"

-- | The report of 'Collision'.
collisionReport :: LengthUnit -> Region -> Tool -> (Element, Element) -> Point -> Maybe Mm -> Report
collisionReport unit region tool (first, second) p largest =
  (at (origin first) "E0404" title)
    { label = shape unit first,
      others =
        secondLabel unit first second
          <> [Label region (workVerb tool <> " here") | region /= origin first],
      message =
        [ "On its way along the first one, with its centre at "
            <> Vec.toText unit 3 p
            <> ", the cutter would cut the second one."
          | not (isInside (segment first) (segment second))
        ],
      fixes =
        if isSlight
          then ErrorFix.sizeFixes unit tool largest <> [ErrorFix.restFix (places tool)]
          else [],
      hints =
        if isSlight
          then ["Or correct the place or the size of one of the two."]
          else
            ["Correct the place or the size of one of the two. " <> largestFit unit tool largest]
              <> [ "Or let the material that the cutter does not reach stay: rest allowed."
                   | isJust largest
                 ]
    }
  where
    title
      | isInside (segment first) (segment second) =
        shape unit first <> " and " <> shape unit second <> " lie one inside the other"
      | otherwise =
        cutter unit tool <> " does not fit between " <> shape unit first <> " and "
          <> shape unit second
    -- A much smaller cutter is hardly meant: then a number is wrong.
    isSlight = any (> times 0.5 (radius tool)) largest
    isInside a b = case (a, b) of
      (Arc {centre = c, start = s}, Arc {centre = d, start = t}) ->
        let (r, q) = (Segment.radius c s, Segment.radius d t)
         in Vec.distance c d <= plus (minus (max r q) (min r q)) Geometry.coincident
      _ -> False

-- | The sentence that an element is too short for a fillet that the tool could follow. Empty if it
-- is long enough.
narrowText :: LengthUnit -> Tool -> Element -> Element -> [Text]
narrowText unit tool first second =
  [ "No fillet that this tool could follow fits here: "
      <> shape unit narrow
      <> " is only "
      <> Decimal.inUnit unit (Segment.length (segment narrow))
      <> " long."
    | narrow : _ <- [filter isNarrow [first, second]]
  ]
  where
    isNarrow e =
      not (ofCurve e) && Segment.length (segment e) < times 2 (plus (radius tool) (leaves tool))
