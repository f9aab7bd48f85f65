-- | The evaluated part: contours and operations in mm. Lines and circles are exact. A curve in a
-- contour is replaced by arcs and lines within 'Geometry.Tolerance.curve'. Contours, elements and
-- operations keep the region of the program that they come from.
--
-- Nothing here depends on a machine. The next compiler pass makes the toolpath.
module Part.Part
  ( Part (..),
    Contour (..),
    ContourElement (..),
    Element (..),
    ReplacedCurve (..),
    Finish (..),
    plainFinish,
    curveRuns,
    polyarcOf,
    reversedContour,
    SpacePoint (..),
    AssertedSize (..),
    Operation (..),
    Milling (..),
    radiusAtTop,
    MillingPlaces (..),
    RestPolicy (..),
    Descent (..),
    Tabs (..),
    TabPlaces (..),
    Pocketing (..),
    ClearedExtent (..),
    Roughing (..),
    Facing (..),
    roughing,
    surface,
    Work (..),
    Accuracy (..),
    deviationLimits,
    Drilling (..),
    Hole (..),
    HoleForm (..),
    TapStroke (..),
    Circling (..),
    Carving (..),
    carvingContours,
    carvingReach,
    carvingFlank,
    ThreadHelix (..),
    runsOf,
    Command (..),
    Cutter (..),
    CutterKind (..),
    ToolBody (..),
    plainBody,
    HolderCylinder (..),
    Solid (..),
    Stop (..),
    Pace (..),
    Ends (..),
    Corners (..),
    CutSense (..),
    VisitOrder (..),
    LeadForm (..),
    Side (..),
    Switch (..),
    Sense (..),
    MachineRef (..),
  )
where

import Base.Name (Name)
import Base.Quantity (LengthUnit, Mm (..), Rad (..), Seconds, plus, times)
import Base.Region (Located, Region)
import Checked.Syntax
  ( Corners (..),
    CutSense (..),
    LeadForm (..),
    MachineRef (..),
    Sense (..),
    Side (..),
    Switch (..),
    VisitOrder (..),
  )
import Data.List.NonEmpty (NonEmpty (..))
import Data.Text (Text)
import Geometry.Carrier (Circle)
import Geometry.Carrier qualified as Carrier
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Vec (Point, Vec)
import Part.Contour
  ( Contour (..),
    ContourElement (..),
    Element (..),
    Finish (..),
    ReplacedCurve (..),
    curveRuns,
    plainFinish,
    polyarcOf,
    reversedContour,
  )
import Part.Curve (Fitting)
import Part.CutFeed (CutFeed, SpindleRate)
import Part.Cutter
  ( Cutter (..),
    CutterKind (..),
    HolderCylinder (..),
    ToolBody (..),
    plainBody,
    radiusAbove,
  )

-- | An evaluated program.
data Part = Part
  { name :: Maybe Name,
    title :: Maybe Text,
    machine :: Maybe (Located MachineRef),
    -- | the unit in which reports, tables and drawings give lengths
    unit :: LengthUnit,
    -- | the position of the cutter at the start of the tape
    start :: Maybe (Located SpacePoint),
    -- | the tool in the spindle at the start of the tape
    firstCutter :: Maybe Cutter,
    -- | the number of this tool, from 1 to 99
    firstToolNumber :: Maybe (Located Int),
    -- | the number of the work offset, from 54 to 59
    workOffset :: Maybe (Located Int),
    -- | the number of the program, from 1 to 9999
    programNumber :: Maybe (Located Int),
    -- | the height above all clamps, at least every clearance height
    safeHeight :: Maybe (Located Mm),
    -- | the stock before the first operation, with the region of its statement
    stock :: Maybe (Located Solid),
    -- | the solids that no tool may touch, such as clamps, each with the region of its statement
    avoided :: [Located Solid],
    contours :: [Contour],
    -- | all operations in the order in which the tape makes them
    operations :: [Operation],
    -- | the curves that consist of lines, parabolas and arcs fitted to a table: the name of each
    -- curve, and the fit
    fittings :: [(Located Name, Fitting)],
    -- | the distances and radii to which assertions give values
    assertedSizes :: [AssertedSize],
    -- | for editors: the values of definitions as text, each with the region of the defined name
    readings :: [(Region, Text)],
    -- | for pictures: the points, the vectors as points, and the centres of the circles that the
    -- program defines by name
    namedPoints :: [(Located Name, Point)]
  }
  deriving stock (Eq, Show)

-- | A size to which an assertion gives a value.
data AssertedSize
  = -- | the distance of two points
    AssertedDistance Point Point Mm
  | AssertedRadius Circle Mm
  deriving stock (Eq, Show)

-- | A point of the plane and a height. The height is 0 at the top of the part, positive above it
-- and negative in the material.
data SpacePoint = SpacePoint {plane :: Point, height :: Mm}
  deriving stock (Eq, Show)

-- | One operation of the program: machining, moves without cutting, or a command.
data Operation
  = Mill (Located Milling)
  | Pocket (Located Pocketing)
  | Drill (Located Drilling)
  | Carve (Located Carving)
  | -- | moves without cutting, given by their ends in order
    Travel (NonEmpty Stop)
  | Command (Located Command)
  deriving stock (Eq, Show)

-- | The radius of a tool at the top of the part while its tip is at a height.
radiusAtTop :: Mm -> Milling -> Mm
radiusAtTop tip m = maybe (radius m) (radiusAbove (times (-1) tip)) (engraver m)

-- | The milling or turning of a contour.
data Milling = Milling
  { contour :: Contour,
    -- | true if the statement says where its closed contour begins
    givesStart :: Bool,
    work :: Work,
    side :: Located Side,
    -- | the radius of the cutter where it touches the part, or of the nose of a turning tool
    radius :: Mm,
    -- | the diameter of the wheel that swivels the blade; absent for other tools
    gear :: Maybe Mm,
    -- | the V-bit that engraves, whose radius depends on the height
    engraver :: Maybe Cutter,
    tolerance :: Accuracy,
    feed :: Located CutFeed,
    approach :: [Stop],
    retract :: [Stop],
    -- | the heights of the passes, from the highest to the lowest. The list is empty if the
    -- statement gives no depth; the cutter then mills at the height at which the approach ends
    levels :: [Mm],
    -- | the height at which rapid moves pass over everything
    clearance :: Maybe Mm,
    -- | the feed of moves down into the material
    plunge :: Maybe (Located CutFeed),
    -- | the way down into the material, with the region of the setting, or of the statement if it
    -- has none
    descent :: Located Descent,
    -- | the height at which the material begins: 0, or the top of the stock if that is higher
    materialTop :: Mm,
    -- | the material that the statement leaves to hold the part, with the region of the setting
    tabs :: Maybe (Located Tabs),
    -- | the form of the lead-in, and the length of its line or the radius of its arc
    leadIn :: Maybe (LeadForm, Mm),
    leadOut :: Maybe (LeadForm, Mm),
    -- | the allowance of each pass, in the order of the passes
    allowances :: NonEmpty Mm,
    -- | the form of the toolpath around outer corners
    corners :: Corners,
    -- | climb or conventional milling; absent if the statement asks for neither
    sense :: Maybe (Located CutSense),
    -- | the sense in which the spindle rotates, seen from above
    spindleSense :: Sense,
    -- | the region of the setting that leaves cutter compensation to the control; if it is absent,
    -- the compiler computes the offset
    controlCompensation :: Maybe Region,
    rest :: RestPolicy,
    places :: MillingPlaces
  }
  deriving stock (Eq, Show)

-- | Regions of the program that a fix of a milling may change.
data MillingPlaces = MillingPlaces
  { -- | the whole statement, which ends with the closing brace of its settings
    statement :: Region,
    -- | the diameter of the tool, or the radius of its nose. It is absent for a cone, whose radius
    -- at the contour depends on more than its diameter
    toolSize :: Maybe Region,
    -- | the tolerance
    accuracy :: Region,
    -- | the depth
    depthAt :: Maybe Region,
    -- | the lengths or radii of the lead-in and of the lead-out
    leadInSize :: Maybe Region,
    leadOutSize :: Maybe Region
  }
  deriving stock (Eq, Show)

-- | The decision on rest material, which the cutter of the operation cannot reach. Rest material
-- remains in sharp inner corners, in concave arcs of a radius smaller than that of the cutter, and
-- in slots narrower than the cutter.
data RestPolicy
  = -- | rest material is an error, and there is no toolpath
    Refused
  | -- | rest material remains, and the compiler warns of it
    Allowed
  deriving stock (Eq, Show)

-- | The way down into the material before a pass.
data Descent
  = -- | straight down
    Plunging
  | -- | along the path of the pass, at this angle to the plane at most
    Ramping Rad
  | -- | by a helix: its largest pitch, and the diameter of the path of the cutter's centre if the
    -- program gives it
    Helical Mm (Maybe Mm)
  | -- | along a closed path, by this depth at most in each lap, down to the only pass
    Spiralling Mm
  deriving stock (Eq, Show)

-- | Tabs: material that is left along a contour to hold the part.
data Tabs = Tabs
  { tabPlaces :: TabPlaces,
    -- | the width of a tab at its narrowest, in the middle of the cut
    tabWidth :: Mm,
    -- | the height of the top of a tab; the top of the part is 0
    tabTop :: Mm,
    -- | the angle of the sides of a tab against the floor, below a right angle
    tabSides :: Rad
  }
  deriving stock (Eq, Show)

-- | The places of tabs: so many of them, evenly along the contour, or one near each point.
data TabPlaces = Evenly Int | NearPoints (NonEmpty (Located Point))
  deriving stock (Eq, Show)

-- | The clearing of a pocket: the inside of a closed contour.
data Pocketing = Pocketing
  { -- | the milling of the outline on its inside, with round corners, without leads, and without
    -- compensation by the control. Its linking moves, depths, allowances and feeds apply to the
    -- whole pocket
    wall :: Milling,
    -- | closed contours inside the outline, inside which the material remains. They touch neither
    -- the outline nor one another
    islands :: [Contour],
    -- | the distance between neighbouring passes, above 0 and at most the diameter of the cutter
    stepover :: Mm,
    extent :: ClearedExtent
  }
  deriving stock (Eq, Show)

-- | The extent of what an operation clears between its contours.
data ClearedExtent
  = -- | all that the cutter reaches without cutting the contours
    WholePocket
  | -- | of that, what an operation with a larger cutter has left
    RestOfPocket Roughing
  | -- | all that the cutter reaches without cutting the flanks of a V-carving
    FloorOfCarving
  | -- | the surface of the region: the cutter also runs over its contours
    Surface Facing
  deriving stock (Eq, Show)

-- | The operation whose rest a clearing removes.
roughing :: Pocketing -> Maybe Roughing
roughing p = case extent p of
  RestOfPocket r -> Just r
  WholePocket -> Nothing
  FloorOfCarving -> Nothing
  Surface _ -> Nothing

-- | The facing that a clearing is.
surface :: Pocketing -> Maybe Facing
surface p = case extent p of
  Surface f -> Just f
  WholePocket -> Nothing
  FloorOfCarving -> Nothing
  RestOfPocket _ -> Nothing

-- | Parallel passes over a region.
newtype Facing = Facing
  { -- | a vector in the direction of the passes
    passDirection :: Vec
  }
  deriving stock (Eq, Show)

-- | An operation with a larger cutter that has cleared a pocket before.
data Roughing = Roughing
  { -- | the region of its statement
    roughedAt :: Region,
    roughRadius :: Mm,
    -- | the allowance that it has left at the walls and the islands
    roughAllowance :: Mm,
    -- | the height of its lowest pass
    roughedDownTo :: Mm
  }
  deriving stock (Eq, Show)

-- | The kind of machining along a contour.
data Work
  = Milled
  | -- | the milling of a stroke of a text
    Engraved
  | Turned
  deriving stock (Eq, Ord, Show)

-- | The allowed chord error of a milling or turning.
data Accuracy
  = -- | the same limit on both sides of the toolpath; the ends of the chords lie on the toolpath
    OnPath Mm
  | -- | the limit towards the material, and the limit away from it
    Band Mm Mm
  deriving stock (Eq, Show)

-- | The largest chord errors that are allowed: towards the material, and away from it.
deviationLimits :: Accuracy -> (Mm, Mm)
deviationLimits accuracy = case accuracy of
  OnPath d -> (d, d)
  Band a b -> (a, b)

-- | The drilling of holes, or another work on holes.
data Drilling = Drilling
  { -- | the holes in the order of the program
    holes :: NonEmpty Hole,
    -- | the order in which they are made
    visits :: VisitOrder,
    -- | the radius of the tool
    drillRadius :: Mm,
    -- | the region of the diameter of the drill
    drillSize :: Maybe Region,
    -- | the height at which the drill moves from hole to hole
    travelHeight :: Mm,
    -- | the largest depth to drill before the drill is retracted; without it, each hole is one move
    peckDepth :: Maybe Mm,
    -- | the rise after each peck; if it is absent, the drill leaves the hole
    chipRise :: Maybe Mm,
    -- | the pause of the axes at the bottom of each hole
    bottomPause :: Maybe Seconds,
    form :: HoleForm,
    -- | the feed straight down
    drillFeed :: Located CutFeed
  }
  deriving stock (Eq, Show)

-- | A hole: its centre, the height of its bottom (negative), and its radius at the top of the part.
data Hole = Hole {holeCentre :: Located Point, holeBottom :: Mm, holeMouth :: Mm}
  deriving stock (Eq, Show)

-- | The moves by which a hole is made.
data HoleForm
  = -- | straight down at the feed, and up in rapid
    Plunged
  | -- | straight down and up at the feed
    Reamed
  | Tapped TapStroke
  | Bored Circling
  | Threaded ThreadHelix
  deriving stock (Eq, Show)

-- | The tapping of a thread. The feed of the drilling is the pitch for each turn of the spindle.
data TapStroke = TapStroke
  { -- | the sense of the spindle on the way down; on the way up it turns in the other one
    tapSense :: Sense,
    tapPitch :: Mm,
    -- | the region of the setting that allows a floating tap holder
    floats :: Maybe Region
  }
  deriving stock (Eq, Show)

-- | The milling of a cylinder in circles: a helix down to the bottom, and full circles there.
data Circling = Circling
  { -- | the radius of the cylinder
    boreRadius :: Mm,
    -- | the largest depth of one turn of the helix
    turnDepth :: Mm,
    -- | true if the whole floor of the cylinder is cleared; otherwise the cutter keeps to its wall
    clearsFloor :: Bool,
    -- | the sense of the circles
    circleSense :: Carrier.Sense,
    circleFeed :: Located CutFeed,
    circleTolerance :: Accuracy
  }
  deriving stock (Eq, Show)

-- | The milling of a thread in a helix.
data ThreadHelix = ThreadHelix
  { -- | the radius that the teeth reach: the largest one inside, the smallest one outside
    toothRadius :: Mm,
    pitch :: Mm,
    isInside :: Bool,
    -- | the sense of the helix, seen from above
    helixSense :: Carrier.Sense,
    -- | true if the helix leads upwards
    rises :: Bool,
    helixFeed :: Located CutFeed,
    helixTolerance :: Accuracy
  }
  deriving stock (Eq, Show)

-- | The feed and the tolerance of the circles of a hole, if it has some.
runsOf :: Drilling -> Maybe (Located CutFeed, Accuracy)
runsOf d = case form d of
  Bored c -> Just (circleFeed c, circleTolerance c)
  Threaded h -> Just (helixFeed h, helixTolerance h)
  Plunged -> Nothing
  Reamed -> Nothing
  Tapped _ -> Nothing

-- | The V-carving of a region. The cone of the tool touches the top edges of the region, and its
-- tip is as deep as it then comes, but no deeper than 'carvingDepth'.
data Carving = Carving
  { -- | the connected areas of the region: the outline of each, counter-clockwise, and the holes in
    -- it, clockwise. All are closed. The contours of one area do not touch one another
    carvedAreas :: NonEmpty (Contour, [Contour]),
    -- | the radius of the tool at its tip
    carvingTip :: Mm,
    -- | the angle between the flank and the axis, above 0 and below a right angle
    halfAngle :: Rad,
    -- | the largest depth of the tip below the top of the part, above 0, and at most the height of
    -- the flank
    carvingDepth :: Mm,
    -- | the region of the depth
    carvingDepthAt :: Region,
    carvingTolerance :: Accuracy,
    carvingFeed :: Located CutFeed,
    -- | the feed of moves straight down into the material
    carvingPlunge :: Maybe (Located CutFeed),
    -- | the height of rapid moves over the part
    carvingTravel :: Mm,
    carvingRest :: RestPolicy
  }
  deriving stock (Eq, Show)

-- | The contours of each area of a V-carving, the outline first.
carvingContours :: Carving -> NonEmpty (NonEmpty Polyarc.Polyarc)
carvingContours = fmap (\(outline, inner) -> fmap polyarcOf (outline :| inner)) . carvedAreas

-- | The distance of the axis of a V-carving's tool, at the largest depth, from the contours.
carvingReach :: Carving -> Mm
carvingReach c = plus (carvingTip c) (carvingFlank c)

-- | The distance of the flank of a V-carving's tool, at the largest depth, from the contours.
carvingFlank :: Carving -> Mm
carvingFlank c = let Rad a = halfAngle c in times (tan a) (carvingDepth c)

-- | A command to the machine: an auxiliary function.
data Command
  = -- | the sense of rotation, and the speed
    SpindleOn Sense SpindleRate
  | SpindleOff
  | CoolantTo Switch
  | -- | the auxiliary function that has this number on the machine
    Auxiliary Int
  | -- | the number of the new tool, and the new tool
    ChangeTool Int Cutter
  | -- | the operator switches the spindle; the tape does not
    SpindleByHand
  | -- | a stop until the operator starts the program again
    ProgramStop
  | -- | such a stop, if a switch of the control asks for it
    OptionalStop
  | -- | a pause of the axes
    Dwell Seconds
  deriving stock (Eq, Show)

-- | The points over a region of the plane between two heights. The contours have the region on
-- their left.
data Solid = Solid {outlines :: [Contour], lowest :: Mm, highest :: Mm}
  deriving stock (Eq, Show)

-- | The end of a move without cutting, and the speed of the move. @level@ is the height of the end.
-- If @level@ is absent, the cutter keeps its height during the move.
data Stop = Stop {place :: Located Point, level :: Maybe Mm, pace :: Pace}
  deriving stock (Eq, Show)

-- | The speed of a move without cutting.
data Pace
  = Rapid
  | -- | the feed, with the region of the program that sets it
    At (Located CutFeed)
  deriving stock (Eq, Show)
