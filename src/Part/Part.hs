-- | The evaluated part: exact geometry, with the place in the program that each piece came from.
module Part.Part
  ( Part (..),
    Contour (..),
    Element (..),
    outline,
    Operation (..),
    Milling (..),
    Stop (..),
    Pace (..),
    Ends (..),
    Side (..),
    MachineRef (..),
  )
where

import Base.Name (Name)
import Base.Quantity (Feed, Mm)
import Base.Region (Located, Region)
import Checked.Syntax (MachineRef (..), Side (..))
import Data.List.NonEmpty (NonEmpty)
import Data.Text (Text)
import Geometry.Contour (Ends (..))
import Geometry.Contour qualified as Geometry
import Geometry.Segment (Segment)
import Geometry.Vec (Point)

-- | What the program says, computed.
data Part = Part
  { name :: Maybe Name,
    title :: Maybe Text,
    machine :: Maybe (Located MachineRef),
    -- | where the cutter stands before the first frame
    start :: Maybe (Located Point),
    contours :: [Contour],
    -- | in the order of the tape
    operations :: [Operation]
  }
  deriving stock (Eq, Show)

-- | A contour of the part with the elements that it was walked on.
data Contour = Contour {contourName :: Located Name, ends :: Ends, elements :: NonEmpty Element}
  deriving stock (Eq, Show)

-- | A segment and the element or the link of the program that it came from.
data Element = Element {segment :: Segment, origin :: Region}
  deriving stock (Eq, Show)

-- | The bare geometry of a contour.
outline :: Contour -> Geometry.Contour
outline contour = Geometry.Contour (ends contour) (fmap segment (elements contour))

-- | What the machine is to do.
data Operation
  = Mill (Located Milling)
  | -- | moves without cutting
    Travel (NonEmpty Stop)
  deriving stock (Eq, Show)

-- | A contour to be milled.
data Milling = Milling
  { contour :: Contour,
    side :: Located Side,
    -- | of the cutter
    radius :: Mm,
    -- | the chord error allowed
    tolerance :: Mm,
    feed :: Located Feed,
    approach :: [Stop],
    retract :: [Stop]
  }
  deriving stock (Eq, Show)

-- | A point to go to.
data Stop = Stop {place :: Located Point, pace :: Pace}
  deriving stock (Eq, Show)

-- | How fast.
data Pace
  = Rapid
  | -- | the feed and the place that sets it
    At (Located Feed)
  deriving stock (Eq, Show)
