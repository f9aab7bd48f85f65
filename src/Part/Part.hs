-- | The evaluated part: contours and operations as exact geometry in mm. Everything keeps the
-- region of the program that it comes from.
--
-- Nothing here depends on a machine. Toolpaths belong to the next stage.
module Part.Part
  ( Part (..),
    Contour (..),
    ContourElement (..),
    Element (..),
    Finish (..),
    plainFinish,
    curveRuns,
    polyarcOf,
    reversedContour,
    SpacePoint (..),
    Operation (..),
    Milling (..),
    RestPolicy (..),
    Pocketing (..),
    Work (..),
    Accuracy (..),
    deviationLimits,
    Drilling (..),
    Command (..),
    Cutter (..),
    CutterKind (..),
    Stop (..),
    Pace (..),
    Ends (..),
    Corners (..),
    CutSense (..),
    LeadForm (..),
    Side (..),
    Switch (..),
    Sense (..),
    MachineRef (..),
  )
where

import Base.Name (Name)
import Base.Quantity (Feed, Mm (..))
import Base.Region (Located, Region)
import Checked.Syntax
  ( Corners (..),
    CutSense (..),
    LeadForm (..),
    MachineRef (..),
    Sense (..),
    Side (..),
    Switch (..),
  )
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Traversable (mapAccumR)
import Data.Tuple (swap)
import Geometry.ElementCarrier (ElementCarrier)
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Part.Curve (Fitting, PartCurve)
import Part.Link (Link)

-- | An evaluated program.
data Part = Part
  { name :: Maybe Name,
    title :: Maybe Text,
    machine :: Maybe (Located MachineRef),
    -- | the cutter's position before the first frame
    start :: Maybe (Located SpacePoint),
    -- | the cutter in the spindle before the first frame
    firstCutter :: Maybe Cutter,
    contours :: [Contour],
    -- | in the order of the tape
    operations :: [Operation],
    -- | the curves whose sections were fitted to a table, with their names
    fittings :: [(Located Name, Fitting)],
    -- | the values of the definitions as text, each with the region of the defined name
    readings :: [(Region, Text)]
  }
  deriving stock (Eq, Show)

-- | A contour of the part.
data Contour = Contour
  { contourName :: Located Name,
    ends :: Ends,
    -- | segments, each of which begins where the segment before it ends
    elements :: NonEmpty Element,
    -- | the elements as the program writes them; empty after a transformation or a reversal
    writtenElements :: [ContourElement]
  }
  deriving stock (Eq, Show)

-- | An element of a contour as the program writes it.
data ContourElement = ContourElement
  { elementRegion :: Region,
    elementCarrier :: ElementCarrier,
    -- | the exact curve, for an element that is a curve
    elementCurve :: Maybe PartCurve,
    elementFinish :: Finish,
    -- | the link to the element after it
    link :: Maybe Link
  }
  deriving stock (Eq, Show)

-- | A segment of a contour, with the properties of the element or link that it comes from.
data Element = Element
  { segment :: Segment,
    -- | the region of that element or link
    origin :: Region,
    finish :: Finish,
    -- | true if the segment continues the segment before it in the same element, without a corner
    continues :: Bool,
    -- | true for one of the arcs and lines that approximate a curve
    ofCurve :: Bool,
    -- | the bevels of the surface at the segment's start and end, if it has any: angles from the
    -- axis of the tool in radians
    bevel :: Maybe (Double, Double)
  }
  deriving stock (Eq, Show)

-- | The modifiers of one element.
data Finish = Finish
  { -- | the feed along the element, instead of that of the machining statement
    ownFeed :: Maybe (Located Feed),
    -- | true if the cutter slows down at the element's end
    slow :: Bool,
    -- | an allowance in addition to that of the pass
    allowance :: Mm
  }
  deriving stock (Eq, Show)

-- | The finish of an element without modifiers.
plainFinish :: Finish
plainFinish = Finish {ownFeed = Nothing, slow = False, allowance = Mm 0}

-- | Groups segments that continue one another. Each group is one line, one arc or one smooth curve.
curveRuns :: [Element] -> [NonEmpty Element]
curveRuns es = case es of
  [] -> []
  e : rest -> let (same, others) = span continues rest in (e :| same) : curveRuns others

-- | A contour in the opposite direction. If segment B continued segment A, A now continues B.
reversedContour :: Contour -> Contour
reversedContour c =
  c {elements = NonEmpty.reverse opposite, writtenElements = []}
  where
    opposite = snd (mapAccumR reversed first (elements c))
    first = continues (NonEmpty.head (elements c))
    reversed next e =
      ( continues e,
        e {segment = Segment.reverse (segment e), bevel = fmap swap (bevel e), continues = next}
      )

-- | The segments of a contour as a polyarc. Every segment is evaluated, so that the polyarc does
-- not keep the elements in memory.
polyarcOf :: Contour -> Polyarc.Polyarc
polyarcOf contour = Polyarc.Polyarc (ends contour) (segment first :| segmentsOf others)
  where
    first :| others = elements contour
    segmentsOf es = case es of
      [] -> []
      e : rest -> let s = segment e in s `seq` (s : segmentsOf rest)

-- | A point of the plane and a height. Heights count from the top of the part, upwards; in the
-- material they are negative.
data SpacePoint = SpacePoint {plane :: Point, height :: Mm}
  deriving stock (Eq, Show)

-- | One operation: machining, moves without cutting, or an auxiliary function.
data Operation
  = Mill (Located Milling)
  | Pocket (Located Pocketing)
  | Drill (Located Drilling)
  | -- | moves without cutting
    Travel (NonEmpty Stop)
  | Command (Located Command)
  deriving stock (Eq, Show)

-- | The milling or turning of a contour.
data Milling = Milling
  { contour :: Contour,
    work :: Work,
    side :: Located Side,
    -- | the radius of the cutter where it touches the part, or of the nose of a turning tool
    radius :: Mm,
    -- | only for a blade: the diameter of the wheel that swivels it
    gear :: Maybe Mm,
    tolerance :: Accuracy,
    feed :: Located Feed,
    approach :: [Stop],
    retract :: [Stop],
    -- | the heights of the passes, from the highest to the lowest; empty when the cutter keeps its
    -- height
    levels :: [Mm],
    -- | the clearance height, at which rapid moves pass over everything
    clearance :: Maybe Mm,
    -- | the feed of downward moves into the material
    plunge :: Maybe (Located Feed),
    -- | the form of the lead-in, and its length or its radius
    leadIn :: Maybe (LeadForm, Mm),
    leadOut :: Maybe (LeadForm, Mm),
    -- | the allowance of each pass, in order
    allowances :: NonEmpty Mm,
    -- | the form of the toolpath at outer corners
    corners :: Corners,
    -- | climb or conventional milling, if the statement asks for one of them
    sense :: Maybe (Located CutSense),
    -- | the sense in which the spindle rotates
    spindleSense :: Sense,
    -- | the region of the setting that leaves cutter compensation to the control; without it, the
    -- compiler computes the offset
    controlCompensation :: Maybe Region,
    rest :: RestPolicy
  }
  deriving stock (Eq, Show)

-- | The treatment of rest material. It remains in sharp inner corners, in concave arcs of a radius
-- below the cutter's, and in gaps narrower than the cutter.
data RestPolicy
  = -- | rest material is an error, and there is no toolpath
    Refused
  | -- | rest material remains, with a warning
    Allowed
  deriving stock (Eq, Show)

-- | A closed contour whose inside is cleared.
data Pocketing = Pocketing
  { -- | the milling of the outline on its inside. Its linking moves, depths, allowances and feeds
    -- are those of the whole pocket. It has round corners, no leads, and no compensation by the
    -- control
    wall :: Milling,
    -- | closed contours inside the outline whose material remains. They touch neither the outline
    -- nor one another
    islands :: [Contour],
    -- | above 0 and at most the diameter of the cutter
    stepover :: Mm
  }
  deriving stock (Eq, Show)

-- | The kind of machining along a contour.
data Work = Milled | Turned
  deriving stock (Eq, Ord, Show)

-- | The allowed chord error of a milling or turning.
data Accuracy
  = -- | the same limit to both sides; the ends of the chords lie on the toolpath
    OnPath Mm
  | -- | the limit into the material, and the limit away from it
    Band Mm Mm
  deriving stock (Eq, Show)

-- | The allowed chord errors: into the material, and away from it.
deviationLimits :: Accuracy -> (Mm, Mm)
deviationLimits accuracy = case accuracy of
  OnPath d -> (d, d)
  Band a b -> (a, b)

-- | The drilling of holes.
data Drilling = Drilling
  { -- | the centres of the holes, in the order of drilling
    holes :: NonEmpty (Located Point),
    drillRadius :: Mm,
    -- | the height of the bottom, below 0
    bottom :: Mm,
    -- | the height of moves between the holes
    travelHeight :: Mm,
    -- | the largest depth that is drilled before the drill is retracted; without it, each hole is
    -- drilled in one move
    peckDepth :: Maybe Mm,
    drillFeed :: Located Feed
  }
  deriving stock (Eq, Show)

-- | An auxiliary function of the machine.
data Command
  = -- | the sense, and the speed in turns per minute if the program gives one
    SpindleOn Sense (Maybe Double)
  | SpindleOff
  | CoolantTo Switch
  | -- | the auxiliary function of the machine with this number
    Auxiliary Int
  | -- | the number of the new tool, and the tool
    ChangeTool Int Cutter
  deriving stock (Eq, Show)

-- | A tool: its kind, and its radius where it touches the part.
data Cutter = Cutter {kind :: CutterKind, cutterRadius :: Mm}
  deriving stock (Eq, Show)

-- | The kind of a tool.
data CutterKind
  = -- | a cutter with a flank parallel to its axis
    MillingCutter
  | -- | a cutter with a conical flank, narrowest at the tip
    ConeCutter
  | -- | a cutter with a conical flank, widest at the tip
    DovetailCutter
  | -- | a blade that swivels along the contour, driven by a wheel of this diameter
    BladeCutter Mm
  | DrillingCutter
  | TurningCutter
  deriving stock (Eq, Show)

-- | The end of a move without cutting, and the speed. Without a level the cutter keeps its height.
data Stop = Stop {place :: Located Point, level :: Maybe Mm, pace :: Pace}
  deriving stock (Eq, Show)

-- | The speed of a move.
data Pace
  = Rapid
  | -- | a feed, with the region of the program that sets it
    At (Located Feed)
  deriving stock (Eq, Show)
