-- | The program as it is written: names unresolved, units as given, every node with its place.
module Surface.Syntax
  ( Program (..),
    Statement,
    Statement_ (..),
    Cutter,
    Cutter_ (..),
    Accuracy (..),
    DefaultPace (..),
    Spin (..),
    Switch (..),
    Expr,
    Expr_ (..),
    Numeral (..),
    Operator (..),
    Argument (..),
    Selector (..),
    Rank (..),
    Closure (..),
    Item,
    Item_ (..),
    Sense (..),
    Lines (..),
    TableLine,
    TableLine_ (..),
    Heading (..),
    Cipher,
    Cipher_ (..),
    Joggle,
    Joggle_ (..),
    Modifier,
    Modifier_ (..),
    Link,
    Link_ (..),
    Side (..),
    MachineRef (..),
    Setting,
    Setting_ (..),
    Lead (..),
    LeadForm (..),
    Corners (..),
    CutSense (..),
    Compensation (..),
    Stop (..),
    Pace (..),
  )
where

import Base.Name (Name)
import Base.NumberTable (NumberTable)
import Base.Region (Located)
import Data.List.NonEmpty (NonEmpty)
import Data.Text (Text)
import Surface.Token (Numeral (..), Unit)

-- | A whole text: its statements in order, and its comments.
data Program = Program {statements :: [Statement], comments :: [Located Text]}
  deriving stock (Eq, Show)

type Statement = Located Statement_

data Statement_
  = -- | @part flange "title"@
    Part (Located Name) (Maybe (Located Text))
  | -- | @machine lkp-01f@
    Machine (Located MachineRef)
  | -- | @import "bolts.part"@
    Import (Located Text)
  | -- | @tool mill(diameter 20 mm)@
    Tool Cutter
  | -- | @feed 60 mm/min@
    Feed Expr
  | -- | @tolerance 0.02 mm@
    Tolerance Accuracy
  | -- | @clearance 5 mm@
    Clearance Expr
  | -- | @from (0, 0)@
    From Expr
  | -- | @let r = 9@
    LetValue (Located Name) Expr
  | -- | @let lug(a) = …@
    LetFunction (Located Name) (NonEmpty (Located Name)) Expr
  | -- | @param d = 25 mm@
    Param (Located Name) Expr
  | -- | @contour outline closed { … }@
    Contour (Located Name) Closure [Item]
  | -- | @table profile { x y … }@ and @table profile from "profile.csv"@
    Table (Located Name) Lines
  | -- | @curve skin = spline(profile)@
    Curve (Located Name) Expr
  | -- | @piece flange = skin cipher 2(2.5), 4(mu, H) left joggle …@
    Piece (Located Name) Expr [Cipher] (Located Side) [Joggle]
  | -- | @assert distance(p, q) = 41 within 0.1@
    Assert Expr (Maybe Expr)
  | -- | @mill outline outside { … }@
    Mill Expr (Located Side) [Setting]
  | -- | @pocket window step 4 mm { … }@: what is to be cleared, how far the passes lie apart
    Pocket Expr Expr [Setting]
  | -- | @turn profile outside { … }@
    Turn Expr (Located Side) [Setting]
  | -- | @drill at holes depth 12 mm { … }@
    Drill Expr Expr [Setting]
  | -- | @rapid p, q@ and @move p, q feed f@
    Travel DefaultPace (NonEmpty Stop)
  | -- | @change 2 drill(diameter 5 mm)@
    Change Expr Cutter
  | -- | @spindle cw 800 rpm@
    Spindle Spin
  | -- | @coolant on@
    Coolant Switch
  | -- | @aux 3@
    Auxiliary Expr
  | -- | @for p in holes { … }@
    Repeat (Located Name) Expr [Statement]
  | -- | @if with_slot { … } else { … }@
    When Expr [Statement] [Statement]
  | -- | @with rotated(60 deg) { … }@
    With Expr [Statement]
  | -- | A statement that could not be read: its first word, and the name that it would have
    -- defined.
    Broken (Maybe Text) (Maybe (Located Name))
  deriving stock (Eq, Show)

-- | A machine by its name, or by the file that describes it.
data MachineRef = Named Text | Described Text
  deriving stock (Eq, Show)

type Cutter = Located Cutter_

data Cutter_
  = -- | @mill(diameter d)@
    MillCutter Expr
  | -- | @drill(diameter d)@
    DrillCutter Expr
  | -- | @turn(nose r)@
    TurningCutter Expr
  | -- | @cone(diameter d, bevel a, height h)@: a mill whose flank leans by an angle
    ConeCutter Expr Expr Expr
  | -- | @blade(diameter d, gear e)@: a blade that swivels, by the wheel that swivels it
    BladeCutter Expr Expr
  deriving stock (Eq, Show)

-- | How far chords may be off.
data Accuracy
  = -- | by so much to either side
    Within Expr
  | -- | by so much into the material, and by so much out of it
    Between Expr Expr
  deriving stock (Eq, Show)

-- | How the stops of a motion are reached that do not say it.
data DefaultPace = RapidMotion | FeedMotion
  deriving stock (Eq, Show, Enum, Bounded)

-- | What a spindle does: turn in a sense, at a speed if one is given.
data Spin = Spinning Sense (Maybe Expr) | Still
  deriving stock (Eq, Show)

data Switch = SwitchOn | SwitchOff
  deriving stock (Eq, Show, Enum, Bounded)

type Expr = Located Expr_

data Expr_
  = Literal {-# UNPACK #-} Numeral (Maybe Unit)
  | Variable Name
  | -- | the name and its arguments
    Call {-# UNPACK #-} (Located Name) {-# UNPACK #-} (NonEmpty Argument)
  | Negate {-# UNPACK #-} Expr
  | Not Expr
  | Binary Operator {-# UNPACK #-} Expr {-# UNPACK #-} Expr
  | -- | @a..b@ and @a..b by s@
    Range Expr Expr (Maybe Expr)
  | -- | @if c then a else b@
    If Expr Expr Expr
  | -- | @(x, y)@: a point or a vector
    Pair {-# UNPACK #-} Expr {-# UNPACK #-} Expr
  | -- | @(x, y, z)@: a point in space
    Triple Expr Expr Expr
  | List [Expr]
  | -- | @[e for x in list]@
    Each Expr (Located Name) Expr
  deriving stock (Eq, Show)

data Operator
  = Add
  | Subtract
  | Multiply
  | Divide
  | Less
  | AtMost
  | Greater
  | AtLeast
  | Equal
  | Unequal
  | And
  | Or
  deriving stock (Eq, Show, Enum, Bounded)

-- | An argument of a call. The words choose among the answers that geometry has.
data Argument
  = Given {-# UNPACK #-} Expr
  | -- | @near p@, @left l@, @inside c@ …
    Chosen (Located Selector) Expr
  | -- | @first@ and @last@
    Ranked (Located Rank)
  deriving stock (Eq, Show)

data Selector
  = Near
  | ToLeft
  | ToRight
  | -- | @inside c@
    Within'
  | Beyond
  | -- | @within d@: a tolerance
    UpTo
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | The lines of a table.
data Lines
  = WrittenLines [TableLine]
  | -- | the name of a file of comma-separated values
    LinesOf (Located Text)
  deriving stock (Eq, Show)

type TableLine = Located TableLine_

data TableLine_
  = -- | @x y mu deg H@: the columns, with the unit of their bare numbers
    Header (NonEmpty Heading)
  | -- | a value for each column
    Entries {-# UNPACK #-} (NonEmpty Expr)
  | -- | lines one after the other with a bare number for each column, as a file has them
    Numbers {-# UNPACK #-} NumberTable
  | -- | a line that could not be read
    BrokenLine
  deriving stock (Eq, Show)

data Heading = Heading (Located Name) (Maybe Unit)
  deriving stock (Eq, Show)

type Cipher = Located Cipher_

-- | One recalculation of a curve: its digit, and what it is given.
data Cipher_ = Cipher (Located Numeral) (NonEmpty Expr)
  deriving stock (Eq, Show)

type Joggle = Located Joggle_

-- | @joggle from x1 to x2 depth d radius r@
data Joggle_ = Joggle {from :: Expr, to :: Expr, depth :: Expr, radius :: Expr}
  deriving stock (Eq, Show)

data Rank = First | Last
  deriving stock (Eq, Ord, Show, Enum, Bounded)

data Closure = Open | Closed
  deriving stock (Eq, Show, Enum, Bounded)

type Item = Located Item_

-- | What stands in the braces of a contour.
data Item_
  = -- | a walked element, what is asked on it, and the link to the one after it
    Element (Maybe (Located Sense)) {-# UNPACK #-} Expr [Modifier] (Maybe Link)
  | -- | @for a in list { … }@
    For (Located Name) Expr [Item]
  | -- | @if c { … } else { … }@
    Choose Expr [Item] [Item]
  | -- | an item that could not be read, and the name that it would have defined
    BrokenItem (Maybe (Located Name))
  deriving stock (Eq, Show)

-- | The sense in which a circle is walked, or a spindle turns.
data Sense = Clockwise | CounterClockwise
  deriving stock (Eq, Show, Enum, Bounded)

type Modifier = Located Modifier_

-- | What is asked on one element.
data Modifier_
  = AtElementFeed Expr
  | -- | slow down at its end
    Slow
  | -- | what is left on it
    ElementAllowance Expr
  | -- | how far its surface leans from the axis of the tool
    Bevel Expr
  deriving stock (Eq, Show)

type Link = Located Link_

data Link_
  = -- | the intersection, chosen by the nearness of a point
    Meet (Maybe Expr)
  | Smooth
  | Tangent
  | -- | the radius; positive is walked clockwise, negative counter-clockwise
    Fillet {-# UNPACK #-} Expr
  | Chamfer {-# UNPACK #-} Expr
  deriving stock (Eq, Show)

-- | Where the cutter stands.
data Side = Outside | Inside | LeftSide | RightSide | On
  deriving stock (Eq, Show, Enum, Bounded)

type Setting = Located Setting_

-- | What stands in the braces of a machining statement.
data Setting_
  = Approach (NonEmpty Stop)
  | Retract (NonEmpty Stop)
  | -- | @depth 12 step 4@: how deep, and how much of it in one pass at most
    Depth Expr (Maybe Expr)
  | -- | @lead in arc 5@
    LeadBy Lead LeadForm Expr
  | -- | @allowance 1, 0.3, 0@: what each pass leaves standing
    Allowances (NonEmpty Expr)
  | -- | @corners sharp@
    CornerStyle Corners
  | -- | @climb@ and @conventional@
    CutBy CutSense
  | -- | @compensation controller@
    CompensationBy Compensation
  | -- | @start near p@
    StartNear Expr
  | -- | @plunge 20 mm/min@: the feed downwards
    Plunge Expr
  | -- | @peck 3 mm@: how deep a drill goes before it is drawn out
    Peck Expr
  | -- | @islands a, b@: contours in a pocket that stay standing
    Islands (NonEmpty Expr)
  | -- | @rest allowed@: what the cutter cannot reach may stay
    RestAllowed
  | -- | a setting that could not be read
    BrokenSetting
  deriving stock (Eq, Show)

-- | Onto the contour or away from it.
data Lead = LeadIn | LeadOut
  deriving stock (Eq, Show, Enum, Bounded)

data LeadForm = LeadLine | LeadArc
  deriving stock (Eq, Show, Enum, Bounded)

-- | How the path goes round an outer corner.
data Corners = Round | Sharp
  deriving stock (Eq, Show, Enum, Bounded)

-- | How the teeth of a mill meet the material.
data CutSense = Climb | Conventional
  deriving stock (Eq, Show, Enum, Bounded)

-- | Who works out the path of the cutter beside the contour.
data Compensation = ByCompiler | ByController
  deriving stock (Eq, Show, Enum, Bounded)

-- | A point to go to, and how fast.
data Stop = Stop {point :: Expr, pace :: Pace}
  deriving stock (Eq, Show)

-- | The feed of a move.
data Pace
  = -- | as the motion or the feed in force say
    Cutting
  | Rapid
  | AtFeed Expr
  deriving stock (Eq, Show)
