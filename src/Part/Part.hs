-- | The evaluated part: contours and operations as exact geometry in mm, with the regions of the
-- program that they come from.
--
-- Nothing here depends on a machine. The part has no toolpaths: those are the next stage's.
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
    -- | the curves of sections that were fitted to a table, with their names
    fittings :: [(Located Name, Fitting)],
    -- | the values of the definitions in words, with the regions of their names
    readings :: [(Region, Text)]
  }
  deriving stock (Eq, Show)

-- | A contour of the part.
data Contour = Contour
  { contourName :: Located Name,
    ends :: Ends,
    -- | segments, each of which begins where the one before it ends
    elements :: NonEmpty Element,
    -- | the elements as written; empty after a transformation or a reversal
    writtenElements :: [ContourElement]
  }
  deriving stock (Eq, Show)

-- | An element of a contour as written.
data ContourElement = ContourElement
  { elementRegion :: Region,
    elementCarrier :: ElementCarrier,
    -- | the exact curve, if the element is one
    elementCurve :: Maybe PartCurve,
    elementFinish :: Finish,
    -- | the link to the element after it
    link :: Maybe Link
  }
  deriving stock (Eq, Show)

-- | A segment of a contour.
data Element = Element
  { segment :: Segment,
    -- | the region of the element or of the link that it comes from
    origin :: Region,
    finish :: Finish,
    -- | it continues the curve of the segment before it without a corner
    continues :: Bool,
    -- | it is one of the arcs and lines that approximate a curve
    ofCurve :: Bool,
    -- | the bevels of the surface at its start and its end: angles from the axis of the tool in
    -- radians
    bevel :: Maybe (Double, Double)
  }
  deriving stock (Eq, Show)

-- | The modifiers of one element.
data Finish = Finish
  { -- | replaces the feed of the statement
    ownFeed :: Maybe (Located Feed),
    -- | slow down at its end
    slow :: Bool,
    -- | added to the allowance of the pass
    allowance :: Mm
  }
  deriving stock (Eq, Show)

-- | The finish of an element without modifiers.
plainFinish :: Finish
plainFinish = Finish {ownFeed = Nothing, slow = False, allowance = Mm 0}

-- | Groups segments that continue one another: each group is one line, arc or smooth curve.
curveRuns :: [Element] -> [NonEmpty Element]
curveRuns es = case es of
  [] -> []
  e : rest -> let (same, others) = span continues rest in (e :| same) : curveRuns others

-- | A contour in the opposite direction. A segment then continues the segment that continued it.
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

-- | The segments of a contour as a polyarc. Strict, so that the polyarc does not retain the
-- elements.
polyarcOf :: Contour -> Polyarc.Polyarc
polyarcOf contour = Polyarc.Polyarc (ends contour) (segment first :| segmentsOf others)
  where
    first :| others = elements contour
    segmentsOf es = case es of
      [] -> []
      e : rest -> let s = segment e in s `seq` (s : segmentsOf rest)

-- | A point, and its height above the top of the part: negative in the material.
data SpacePoint = SpacePoint {plane :: Point, height :: Mm}
  deriving stock (Eq, Show)

-- | An operation of the machine.
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
    -- | of the cutter, or of the nose of a turning tool
    radius :: Mm,
    -- | of a blade: the diameter of the wheel that swivels it
    gear :: Maybe Mm,
    tolerance :: Accuracy,
    feed :: Located Feed,
    approach :: [Stop],
    retract :: [Stop],
    -- | the heights of the passes, from the highest one; empty when the cutter keeps its height
    levels :: [Mm],
    -- | the height at which nothing is in the way of the cutter
    clearance :: Maybe Mm,
    plunge :: Maybe (Located Feed),
    leadIn :: Maybe (LeadForm, Mm),
    leadOut :: Maybe (LeadForm, Mm),
    -- | the material that each pass leaves
    allowances :: NonEmpty Mm,
    corners :: Corners,
    sense :: Maybe (Located CutSense),
    -- | the sense of the spindle
    spindleSense :: Sense,
    -- | the region that asks for cutter compensation by the control; without it, the compiler
    -- computes the offset
    controlCompensation :: Maybe Region,
    rest :: RestPolicy
  }
  deriving stock (Eq, Show)

-- | The treatment of rest material: corners, concave radii below the cutter's radius, gaps narrower
-- than the cutter.
data RestPolicy
  = -- | an error: there is no toolpath
    Refused
  | -- | a warning: the material remains
    Allowed
  deriving stock (Eq, Show)

-- | A closed contour whose inside is cleared.
data Pocketing = Pocketing
  { -- | the outline, milled inside, with the linking moves, depths, allowances and feeds of the
    -- whole pocket. It has no leads, round corners, and no compensation by the control
    wall :: Milling,
    -- | closed contours inside the outline, apart from it and from one another, that remain
    islands :: [Contour],
    -- | the stepover: above 0, at most the diameter of the cutter
    stepover :: Mm
  }
  deriving stock (Eq, Show)

-- | The kind of machining along a contour.
data Work = Milled | Turned
  deriving stock (Eq, Ord, Show)

-- | The chord error allowed.
data Accuracy
  = -- | in both directions, for chords between points of the toolpath
    OnPath Mm
  | -- | into the material, and out of it
    Band Mm Mm
  deriving stock (Eq, Show)

-- | The chord error allowed into the material, and out of it.
deviationLimits :: Accuracy -> (Mm, Mm)
deviationLimits accuracy = case accuracy of
  OnPath d -> (d, d)
  Band a b -> (a, b)

-- | Holes, in the order of drilling.
data Drilling = Drilling
  { holes :: NonEmpty (Located Point),
    -- | of the drill
    drillRadius :: Mm,
    -- | the height of the bottom, below 0
    bottom :: Mm,
    -- | the height of moves between the holes
    travelHeight :: Mm,
    -- | the largest depth before the drill is retracted
    peckDepth :: Maybe Mm,
    drillFeed :: Located Feed
  }
  deriving stock (Eq, Show)

-- | An auxiliary function of the machine.
data Command
  = -- | a sense, and a speed in turns a minute
    SpindleOn Sense (Maybe Double)
  | SpindleOff
  | CoolantTo Switch
  | Auxiliary Int
  | -- | the number of the tool
    ChangeTool Int Cutter
  deriving stock (Eq, Show)

-- | A tool, and its radius where it touches the part.
data Cutter = Cutter {kind :: CutterKind, cutterRadius :: Mm}
  deriving stock (Eq, Show)

-- | The kind of a tool.
data CutterKind
  = -- | with an upright flank
    MillingCutter
  | -- | with a conical flank, narrowest at the tip
    ConeCutter
  | -- | with a conical flank, widest at the tip
    DovetailCutter
  | -- | swivels along the contour, driven by a wheel of this diameter
    BladeCutter Mm
  | DrillingCutter
  | TurningCutter
  deriving stock (Eq, Show)

-- | A point to move to; without a height the cutter keeps its own.
data Stop = Stop {place :: Located Point, level :: Maybe Mm, pace :: Pace}
  deriving stock (Eq, Show)

-- | The speed of a move.
data Pace
  = Rapid
  | -- | a feed, with the region that sets it
    At (Located Feed)
  deriving stock (Eq, Show)
