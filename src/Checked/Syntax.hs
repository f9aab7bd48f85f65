-- | The program after checking.
--
-- Every name is resolved and every term has the right type. All numbers are in mm, radians,
-- minutes and revolutions. Statements that contain a mistake are left out.
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

-- | A checked program.
data Program = Program
  { name :: Maybe Name,
    title :: Maybe Text,
    machine :: Maybe (Located MachineRef),
    statements :: [Statement],
    -- | all mentions of names, in no order
    mentions :: [Mention]
  }
  deriving stock (Eq, Show)

-- | A name where it is defined or used: its region, the region of its definition unless it is
-- built in, the word, and its meaning in words.
data Mention = Mention {place :: Region, definition :: Maybe Region, word :: Text, meaning :: Text}
  deriving stock (Eq, Show)

-- | A statement with its region.
type Statement = Located Statement_

-- | A statement. Imports are replaced by the definitions of the imported files.
data Statement_
  = Tool Cutter
  | Feed Expr
  | Tolerance Accuracy
  | Clearance Expr
  | From Expr
  | -- | the name, the dimension of the value or of the quantities in it, the value
    LetValue (Located Name) Dimension Expr
  | LetFunction Name (NonEmpty Name) Expr
  | Table (Located Name) Columns
  | -- | the name, the curve, its ciphers, the side, the joggles
    Piece (Located Name) Expr [Cipher] (Located Side) [Joggle]
  | Contour (Located Name) Closure [Item]
  | Assert Assertion
  | Mill Expr (Located Side) Settings
  | -- | the contour, the stepover in mm
    Pocket Expr Expr Settings
  | Turn Expr (Located Side) Settings
  | -- | the points, the depth in mm
    Drill Expr Expr Settings
  | Travel (NonEmpty Stop)
  | -- | the number of the tool, the tool
    Change Expr Cutter
  | Spindle Spin
  | Coolant Switch
  | Auxiliary Expr
  | Repeat Name Expr [Statement]
  | When Expr [Statement] [Statement]
  | With Expr [Statement]
  deriving stock (Eq, Show)

-- | The columns of a table besides x and y, with their dimensions, and the rows. The cells of a row
-- are x, y, and the other columns in this order.
data Columns = Columns [(Name, Dimension)] [Cells]
  deriving stock (Eq, Show)

-- | Several rows of numbers, or one row that contains other expressions, with its region.
data Cells = Numbers {-# UNPACK #-} NumberTable | Written Region [Expr]
  deriving stock (Eq, Show)

-- | A cipher with its region.
type Cipher = Located Cipher_

-- | A recalculation of a curve (Kolsanova, section 5). With a bevel, distances are measured square
-- to the surface. Distances and bevels may name columns, whose values vary along the curve.
data Cipher_
  = -- | 1: a distance that varies uniformly from the first to the second value, with an optional
    -- bevel, along the whole curve or between two of its points
    Growing Expr Expr (Maybe Expr) (Maybe (Expr, Expr))
  | -- | 2: one distance, with an optional bevel
    Constant Expr (Maybe Expr)
  | -- | 4: the distance that follows from a bevel and a height, with an optional allowance
    Bevelled Expr Expr (Maybe Expr)
  | -- | 6: a distance at each point, with an optional bevel
    Pointwise Expr (Maybe Expr)
  deriving stock (Eq, Show)

-- | A joggle with its region.
type Joggle = Located Joggle_

-- | A joggle: its first and last x, its depth and its radius, in mm.
data Joggle_ = Joggle Expr Expr Expr Expr
  deriving stock (Eq, Show)

-- | A cutter with its region.
type Cutter = Located Cutter_

-- | A cutter: a mill or a drill by its diameter, a turning tool by its nose radius.
data Cutter_
  = MillCutter Expr
  | DrillCutter Expr
  | TurningCutter Expr
  | -- | a conical mill by the diameter of its tip, the bevel of its flank, and the height of the
    -- contour above the tip
    ConeCutter Expr Expr Expr
  | -- | a swivelling blade by its diameter and that of the gear wheel that swivels it
    BladeCutter Expr Expr
  deriving stock (Eq, Show)

-- | The allowed distance between a curve and its chords in mm: the same on both sides, or one
-- inside and one outside of the material.
data Accuracy = Within Expr | Between Expr Expr
  deriving stock (Eq, Show)

-- | The command to a spindle: a sense with an optional speed in rpm, or a stop.
data Spin = Spinning Sense (Maybe Expr) | SpindleStop
  deriving stock (Eq, Show)

-- | A condition that must be true.
data Assertion
  = -- | any other expression that is true or false
    Holds Expr
  | -- | a comparison other than equality: the dimension of the operands, the region of the whole
    -- comparison, the operator, the operands
    Compares Dimension Region Operator Expr Expr
  | -- | an equality: the dimension of the operands, the operands, the tolerance if there is one
    Agrees Dimension Expr Expr (Maybe Expr)
  deriving stock (Eq, Show)

-- | The settings in the block of a machining statement. Lengths are in mm, feeds in mm/min.
data Settings = Settings
  { approach :: [Stop],
    retract :: [Stop],
    -- | the depth and the largest stepdown
    depth :: Maybe (Expr, Maybe Expr),
    -- | the form of the lead-in, and the length of the line or the radius of the arc
    leadIn :: Maybe (LeadForm, Expr),
    -- | as for 'leadIn'
    leadOut :: Maybe (LeadForm, Expr),
    -- | the material that each pass leaves
    allowances :: Maybe (NonEmpty Expr),
    corners :: Corners,
    sense :: Maybe (Located CutSense),
    compensation :: Maybe (Located Compensation),
    startNear :: Maybe Expr,
    -- | the feed downwards
    plunge :: Maybe Expr,
    -- | the depth that is drilled between two retracts
    peck :: Maybe Expr,
    -- | contours and lists of contours
    islands :: [Expr],
    -- | the region of the setting that allows rest material
    restAllowed :: Maybe Region
  }
  deriving stock (Eq, Show)

-- | An expression with its region.
type Expr = Located Expr_

-- | An expression.
data Expr_
  = -- | in mm, radians, minutes and revolutions
    Number Double
  | Variable Name
  | -- | a call of a function of the program
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

-- | An argument of a built-in function: a value, a value after a word such as @near@, or a rank.
data Argument = Given {-# UNPACK #-} Expr | Chosen Selector Expr | Ranked Rank
  deriving stock (Eq, Show)

-- | The built-in functions and constants, which "Checked.Builtin" names and types.
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

-- | An item of a contour with its region.
type Item = Located Item_

-- | An item in the braces of a contour.
data Item_
  = -- | a circle with its sense, or a line, a point, a curve or a contour without one; its
    -- modifiers and the link to the next element
    Element (Maybe Sense) {-# UNPACK #-} Expr [Modifier] (Maybe Link)
  | For Name Expr [Item]
  | Choose Expr [Item] [Item]
  deriving stock (Eq, Show)

-- | A modifier with its region.
type Modifier = Located Modifier_

-- | A property of one element of a contour.
data Modifier_ = ElementFeed Expr | Slow | ElementAllowance Expr | Bevel Expr
  deriving stock (Eq, Show)

-- | A link with its region.
type Link = Located Link_

-- | The link between two elements of a contour, as in "Surface.Syntax".
data Link_
  = Meet (Maybe Expr)
  | Smooth
  | Tangent
  | -- | the radius in mm, positive for a clockwise arc
    Fillet {-# UNPACK #-} Expr
  | -- | the distance of both ends from the intersection of the elements in mm
    Chamfer {-# UNPACK #-} Expr
  deriving stock (Eq, Show)

-- | The end of a motion and the pace to it.
data Stop = Stop {point :: Expr, pace :: Pace}
  deriving stock (Eq, Show)

-- | The pace of a motion: the present feed, rapid, or a feed of its own.
data Pace = Cutting | Rapid | AtFeed Expr
  deriving stock (Eq, Show)
