-- | The program after checking: every name known, every term of the right type, every number in
-- mm, radians, minutes and turns.
module Checked.Syntax
  ( Program (..),
    Mention (..),
    Statement,
    Statement_ (..),
    Cutter,
    Cutter_ (..),
    Columns (..),
    Cells (..),
    Cipher,
    Cipher_ (..),
    Joggle,
    Joggle_ (..),
    Accuracy (..),
    Spin (..),
    Assertion (..),
    Settings (..),
    Expr,
    Expr_ (..),
    Argument (..),
    Item,
    Item_ (..),
    Modifier,
    Modifier_ (..),
    Link,
    Link_ (..),
    Stop (..),
    Pace (..),
    Builtin (..),

    -- * As in the surface syntax
    Selector (..),
    Closure (..),
    Corners (..),
    Compensation (..),
    CutSense (..),
    Lead (..),
    LeadForm (..),
    MachineRef (..),
    Operator (..),
    Rank (..),
    Side (..),
    Switch (..),
    Sense (..),
  )
where

import Base.Name (Name)
import Base.NumberTable (NumberTable)
import Base.Region (Located, Region)
import Checked.Dimension (Dimension)
import Data.List.NonEmpty (NonEmpty)
import Data.Text (Text)
import Surface.Syntax
  ( Closure (..),
    Compensation (..),
    Corners (..),
    CutSense (..),
    Lead (..),
    LeadForm (..),
    MachineRef (..),
    Operator (..),
    Rank (..),
    Selector (..),
    Sense (..),
    Side (..),
    Switch (..),
  )

-- | A program. Statements that contain a mistake are left out.
data Program = Program
  { name :: Maybe Name,
    title :: Maybe Text,
    machine :: Maybe (Located MachineRef),
    statements :: [Statement],
    -- | every place at which a name stands, in no order
    mentions :: [Mention]
  }
  deriving stock (Eq, Show)

-- | A name where it is defined or used: its place, where it is defined unless the language brings
-- it along, and what it means.
data Mention = Mention {place :: Region, definition :: Maybe Region, word :: Text, meaning :: Text}
  deriving stock (Eq, Show)

type Statement = Located Statement_

data Statement_
  = Tool Cutter
  | Feed Expr
  | Tolerance Accuracy
  | Clearance Expr
  | From Expr
  | -- | with the dimension of its quantities
    LetValue (Located Name) Dimension Expr
  | LetFunction Name (NonEmpty Name) Expr
  | Table (Located Name) Columns
  | -- | the curve, the columns of its table, its recalculations, the side, the joggles
    Piece (Located Name) Expr [Cipher] (Located Side) [Joggle]
  | Contour (Located Name) Closure [Item]
  | Assert Assertion
  | Mill Expr (Located Side) Settings
  | -- | the outline, how far the passes lie apart
    Pocket Expr Expr Settings
  | Turn Expr (Located Side) Settings
  | -- | the points, the depth
    Drill Expr Expr Settings
  | Travel (NonEmpty Stop)
  | -- | the number of the tool
    Change Expr Cutter
  | Spindle Spin
  | Coolant Switch
  | Auxiliary Expr
  | Repeat Name Expr [Statement]
  | When Expr [Statement] [Statement]
  | With Expr [Statement]
  deriving stock (Eq, Show)

-- | The columns of a table besides x and y with their dimensions, and its rows: x, y, and the
-- others in order.
data Columns = Columns [(Name, Dimension)] [Cells]
  deriving stock (Eq, Show)

-- | Rows of a table: bare numbers, which most have, or one of anything else.
data Cells = Numbers {-# UNPACK #-} NumberTable | Written Region [Expr]
  deriving stock (Eq, Show)

type Cipher = Located Cipher_

-- | The recalculations of a curve (Kolsanova, section 5). Lengths and angles may name columns:
-- their values go along the curve.
data Cipher_
  = -- square to the surface; between two points of the curve, or along all of it

    -- | 1: a distance that changes uniformly along the curve, from one to another; the bevel if it
    -- is measured
    Growing Expr Expr (Maybe Expr) (Maybe (Expr, Expr))
  | -- | 2: one distance, square to the surface if there is a bevel
    Constant Expr (Maybe Expr)
  | -- | 4: what the bevel makes of the height, and an allowance
    Bevelled Expr Expr (Maybe Expr)
  | -- | 6: a distance for each point, square to the surface if there is a bevel
    Pointwise Expr (Maybe Expr)
  deriving stock (Eq, Show)

type Joggle = Located Joggle_

-- | From where to where along x, how deep, with what radius.
data Joggle_ = Joggle Expr Expr Expr Expr
  deriving stock (Eq, Show)

type Cutter = Located Cutter_

-- | A mill or a drill by its diameter, a turning tool by the radius of its nose.
data Cutter_
  = MillCutter Expr
  | DrillCutter Expr
  | TurningCutter Expr
  | -- | by its diameter, its angle, the height of what it cuts
    ConeCutter Expr Expr Expr
  | -- | by its diameter and that of the wheel that swivels it
    BladeCutter Expr Expr
  deriving stock (Eq, Show)

data Accuracy = Within Expr | Between Expr Expr
  deriving stock (Eq, Show)

data Spin = Spinning Sense (Maybe Expr) | Still
  deriving stock (Eq, Show)

-- | What has to hold.
data Assertion
  = Holds Expr
  | -- | two quantities, one of which has to be larger, or another, than the other
    Compares Dimension Region Operator Expr Expr
  | -- | two quantities that have to be equal, within a third
    Agrees Dimension Expr Expr (Maybe Expr)
  deriving stock (Eq, Show)

-- | What stands in the braces of a machining statement.
data Settings = Settings
  { approach :: [Stop],
    retract :: [Stop],
    -- | how deep, and the most of it in one pass
    depth :: Maybe (Expr, Maybe Expr),
    leadIn :: Maybe (LeadForm, Expr),
    leadOut :: Maybe (LeadForm, Expr),
    allowances :: Maybe (NonEmpty Expr),
    corners :: Corners,
    sense :: Maybe (Located CutSense),
    compensation :: Maybe (Located Compensation),
    startNear :: Maybe Expr,
    plunge :: Maybe Expr,
    peck :: Maybe Expr,
    -- | each a contour or a list of them
    islands :: [Expr],
    -- | where it is said that what the cutter cannot reach may stay
    restAllowed :: Maybe Region
  }
  deriving stock (Eq, Show)

type Expr = Located Expr_

data Expr_
  = Number Double
  | Variable Name
  | -- | a function of the program
    Apply Name {-# UNPACK #-} (NonEmpty Expr)
  | Builtin Builtin [Argument]
  | Negate {-# UNPACK #-} Expr
  | Not Expr
  | Binary Operator {-# UNPACK #-} Expr {-# UNPACK #-} Expr
  | Range Expr Expr (Maybe Expr)
  | If Expr Expr Expr
  | Pair {-# UNPACK #-} Expr {-# UNPACK #-} Expr
  | Triple Expr Expr Expr
  | List [Expr]
  | Each Expr Name Expr
  deriving stock (Eq, Show)

data Argument = Given {-# UNPACK #-} Expr | Chosen Selector Expr | Ranked Rank
  deriving stock (Eq, Show)

-- | What the language brings along.
data Builtin
  = Pi
  | Truth
  | Falsehood
  | Polar
  | Intersection
  | CentreOf
  | Midpoint
  | Foot
  | Tangency
  | PointOn
  | MakeLine
  | Horizontal
  | Vertical
  | Parallel
  | Perpendicular
  | MakeCircle
  | Concentric
  | Distance
  | DirectionOf
  | RadiusOf
  | LengthOf
  | XOf
  | YOf
  | MakeSpline
  | ClosedSpline
  | Polyline
  | Parabola
  | Biarcs
  | ClosedBiarcs
  | Fit
  | Sections
  | RowsOf
  | PointsOf
  | PointAtX
  | PointAlong
  | LengthAlong
  | StartOf
  | EndOf
  | TangentOf
  | NormalOf
  | CurvatureOf
  | Moved
  | Rotated
  | Mirrored
  | Scaled
  | Reversed
  | Row
  | Grid
  | Around
  | Count
  | ItemOf
  | Lift
  | Sin
  | Cos
  | Tan
  | Asin
  | Acos
  | Atan2
  | Sqrt
  | Abs
  | Min
  | Max
  | Floor
  deriving stock (Eq, Ord, Show, Enum, Bounded)

type Item = Located Item_

-- | What stands in the braces of a contour.
data Item_
  = -- | a circle in its sense, a line, a point or a contour, what is asked on it, and the link
    -- behind it
    Element (Maybe Sense) {-# UNPACK #-} Expr [Modifier] (Maybe Link)
  | For Name Expr [Item]
  | Choose Expr [Item] [Item]
  deriving stock (Eq, Show)

type Modifier = Located Modifier_

data Modifier_ = AtElementFeed Expr | Slow | ElementAllowance Expr | Bevel Expr
  deriving stock (Eq, Show)

type Link = Located Link_

data Link_
  = Meet (Maybe Expr)
  | Smooth
  | Tangent
  | Fillet {-# UNPACK #-} Expr
  | Chamfer {-# UNPACK #-} Expr
  deriving stock (Eq, Show)

data Stop = Stop {point :: Expr, pace :: Pace}
  deriving stock (Eq, Show)

data Pace = Cutting | Rapid | AtFeed Expr
  deriving stock (Eq, Show)
