-- | The evaluated part: exact geometry, with the place in the program that each piece came from.
module Part.Part
  ( Part (..),
    Contour (..),
    ContourElement (..),
    Element (..),
    Finish (..),
    plainFinish,
    runs,
    outline,
    backwards,
    SpacePoint (..),
    Operation (..),
    Milling (..),
    RestPolicy (..),
    Pocketing (..),
    Work (..),
    Accuracy (..),
    deepest,
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
import Part.LinkCandidate (Link)

-- | What the program says, computed.
data Part = Part
  { name :: Maybe Name,
    title :: Maybe Text,
    machine :: Maybe (Located MachineRef),
    -- | where the cutter stands before the first frame
    start :: Maybe (Located SpacePoint),
    -- | the cutter in the spindle then
    firstCutter :: Maybe Cutter,
    contours :: [Contour],
    -- | in the order of the tape
    operations :: [Operation],
    -- | the curves of pieces that were chosen for a table, by their names
    fittings :: [(Located Name, Fitting)],
    -- | the values of the definitions by the places of their names, for a reader
    readings :: [(Region, Text)]
  }
  deriving stock (Eq, Show)

-- | A contour of the part with the elements that it was walked on.
data Contour = Contour
  { contourName :: Located Name,
    ends :: Ends,
    elements :: NonEmpty Element,
    -- | as it was written; nothing when it was turned or moved since
    legs :: [ContourElement]
  }
  deriving stock (Eq, Show)

-- | One element of a contour as it was written: what was walked, exactly if it is a curve; what is
-- asked on it; the link behind it.
data ContourElement = ContourElement
  { spot :: Region,
    shape :: ElementCarrier,
    source :: Maybe PartCurve,
    asked :: Finish,
    link :: Maybe Link
  }
  deriving stock (Eq, Show)

-- | A segment, the element or the link of the program that it came from, and what is asked on it.
data Element = Element
  { segment :: Segment,
    origin :: Region,
    finish :: Finish,
    -- | it goes on, without a corner, with the curve of the element before: one of the arcs that a
    -- curve is replaced by
    continues :: Bool,
    -- | it is one of the arcs that a curve is replaced by
    ofCurve :: Bool,
    -- | how far its surface leans from the axis of the tool at its beginning and its end, in
    -- radians, if it is said
    bevel :: Maybe (Double, Double)
  }
  deriving stock (Eq, Show)

-- | What is asked on one element.
data Finish = Finish
  { -- | instead of the feed of the statement
    ownFeed :: Maybe (Located Feed),
    -- | slow down at its end
    slow :: Bool,
    -- | what is left on it besides what the pass leaves
    allowance :: Mm
  }
  deriving stock (Eq, Show)

-- | Nothing out of the ordinary.
plainFinish :: Finish
plainFinish = Finish {ownFeed = Nothing, slow = False, allowance = Mm 0}

-- | Elements in groups, each of which is one curve.
runs :: [Element] -> [NonEmpty Element]
runs es = case es of
  [] -> []
  e : rest -> let (same, others) = span continues rest in (e :| same) : runs others

-- | A contour walked the other way. An element then continues the one that continued it.
backwards :: Contour -> Contour
backwards c =
  c
    { elements =
        NonEmpty.reverse
          (snd (mapAccumR turned (continues (NonEmpty.head (elements c))) (elements c))),
      legs = []
    }
  where
    turned next e =
      ( continues e,
        e {segment = Segment.reverse (segment e), bevel = fmap swap (bevel e), continues = next}
      )

-- | The bare geometry of a contour.
outline :: Contour -> Polyarc.Polyarc
outline contour = Polyarc.Polyarc (ends contour) (segment first :| segmentsOf others)
  where
    first :| others = elements contour
    -- A segment that waited to be taken out of its element would need as much room again.
    segmentsOf es = case es of
      [] -> []
      e : rest -> let s = segment e in s `seq` (s : segmentsOf rest)

-- | A place and the height above the top of the part; negative in the material.
data SpacePoint = SpacePoint {plane :: Point, height :: Mm}
  deriving stock (Eq, Show)

-- | What the machine is to do.
data Operation
  = Mill (Located Milling)
  | Pocket (Located Pocketing)
  | Drill (Located Drilling)
  | -- | moves without cutting
    Travel (NonEmpty Stop)
  | Command (Located Command)
  deriving stock (Eq, Show)

-- | A contour to be milled or turned.
data Milling = Milling
  { contour :: Contour,
    work :: Work,
    side :: Located Side,
    -- | of the cutter, or of the nose of a turning tool
    radius :: Mm,
    -- | of a blade, the diameter of the wheel that swivels it
    gear :: Maybe Mm,
    tolerance :: Accuracy,
    feed :: Located Feed,
    approach :: [Stop],
    retract :: [Stop],
    -- | the heights of the passes, downwards; none when the cutter stays at the height at which it
    -- stands
    levels :: [Mm],
    -- | the height at which nothing is in the way
    clearance :: Maybe Mm,
    plunge :: Maybe (Located Feed),
    leadIn :: Maybe (LeadForm, Mm),
    leadOut :: Maybe (LeadForm, Mm),
    -- | what each pass leaves standing
    allowances :: NonEmpty Mm,
    corners :: Corners,
    sense :: Maybe (Located CutSense),
    -- | of the spindle
    spin :: Sense,
    -- | where it is asked that the control keeps the cutter beside the contour; else the compiler
    -- does
    byControl :: Maybe Region,
    rest :: RestPolicy
  }
  deriving stock (Eq, Show)

-- | What is done where the cutter cannot reach: into a corner, a concave radius smaller than its
-- own, a gap narrower than itself.
data RestPolicy
  = -- | there is no path
    Refused
  | -- | the material stays, and a warning tells of it
    Allowed
  deriving stock (Eq, Show)

-- | A closed contour whose inside is cleared.
data Pocketing = Pocketing
  { -- corners, and no compensation by the control

    -- | the outline, milled inside, with the ways, depths, allowances and feeds of the whole
    -- pocket. It has no leads, round
    wall :: Milling,
    -- | closed contours inside it, apart from it and from one another, that stay standing
    islands :: [Contour],
    -- | how far the passes lie apart: above zero, at most the diameter of the cutter
    apart :: Mm
  }
  deriving stock (Eq, Show)

data Work = Milled | Turned
  deriving stock (Eq, Ord, Show)

-- | The chord error allowed.
data Accuracy
  = -- | chords between points of the path
    OnPath Mm
  | -- | chords within a band: so far into the material, so far out of it
    Band Mm Mm
  deriving stock (Eq, Show)

-- | How far chords may go into the material, and how far out of it.
deepest :: Accuracy -> (Mm, Mm)
deepest accuracy = case accuracy of
  OnPath d -> (d, d)
  Band a b -> (a, b)

-- | Holes, one after the other.
data Drilling = Drilling
  { holes :: NonEmpty (Located Point),
    -- | of the drill
    drillRadius :: Mm,
    -- | the height of the bottom, below zero
    bottom :: Mm,
    clear :: Mm,
    -- | the most of it before the drill is drawn out
    pecked :: Maybe Mm,
    drillFeed :: Located Feed
  }
  deriving stock (Eq, Show)

data Command
  = -- | in a sense, at a speed in turns a minute
    SpindleOn Sense (Maybe Double)
  | SpindleOff
  | CoolantTo Switch
  | Auxiliary Int
  | -- | the number of the tool
    ChangeTool Int Cutter
  deriving stock (Eq, Show)

-- | A tool, and its radius where it cuts.
data Cutter = Cutter {kind :: CutterKind, cutterRadius :: Mm}
  deriving stock (Eq, Show)

data CutterKind
  = -- | upright
    MillingCutter
  | -- | with a flank that leans, narrowest at the tip …
    ConeCutter
  | -- | … or widest
    DovetailCutter
  | -- | swivels as it goes along, by a wheel of this diameter
    BladeCutter Mm
  | DrillingCutter
  | TurningCutter
  deriving stock (Eq, Show)

-- | A point to go to; without a height it is that at which the cutter stands.
data Stop = Stop {place :: Located Point, level :: Maybe Mm, pace :: Pace}
  deriving stock (Eq, Show)

-- | How fast.
data Pace
  = Rapid
  | -- | the feed and the place that sets it
    At (Located Feed)
  deriving stock (Eq, Show)
