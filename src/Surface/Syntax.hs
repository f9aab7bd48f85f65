-- | The program as it is written: names unresolved, units as given, every node with its place.
module Surface.Syntax
  ( Program (..),
    Statement,
    Statement_ (..),
    Expr,
    Expr_ (..),
    Operator (..),
    Closure (..),
    Item,
    Item_ (..),
    Walk (..),
    Link,
    Link_ (..),
    Side (..),
    MachineRef (..),
    Setting,
    Setting_ (..),
    Stop (..),
    Pace (..),
  )
where

import Base.Name (Name)
import Base.Region (Located)
import Data.List.NonEmpty (NonEmpty)
import Data.Text (Text)
import Surface.Token (Unit)

-- | A whole text: its statements in order, and its comments.
data Program = Program {statements :: [Statement], comments :: [Located Text]}
  deriving stock (Eq, Show)

type Statement = Located Statement_

data Statement_
  = -- | @part flange "title"@
    Part (Located Name) (Maybe (Located Text))
  | -- | @machine lkp-01f@
    Machine (Located MachineRef)
  | -- | @tool mill(diameter 20 mm)@
    Tool Expr
  | -- | @feed 60 mm/min@
    Feed Expr
  | -- | @tolerance 0.02 mm@
    Tolerance Expr
  | -- | @from (0, 0)@
    From Expr
  | -- | @let r = 9@
    LetValue (Located Name) Expr
  | -- | @let lug(a) = …@
    LetFunction (Located Name) (NonEmpty (Located Name)) Expr
  | -- | @contour outline closed { … }@
    Contour (Located Name) Closure [Item]
  | -- | @mill outline outside { … }@
    Mill Expr (Located Side) [Setting]
  | -- | @rapid p, q@ and @move p, q feed f@
    Travel (NonEmpty Stop)
  | -- | A statement that could not be read: its first word, and the name that it would have defined.
    Broken (Maybe Text) (Maybe (Located Name))
  deriving stock (Eq, Show)

-- | A machine by its name, or by the file that describes it.
data MachineRef = Named Text | Described Text
  deriving stock (Eq, Show)

type Expr = Located Expr_

data Expr_
  = Literal Double (Maybe Unit)
  | Variable Name
  | -- | the name and its arguments
    Call (Located Name) (NonEmpty Expr)
  | Negate Expr
  | Binary Operator Expr Expr
  | -- | @(x, y)@: a point or a vector
    Pair Expr Expr
  | List [Expr]
  deriving stock (Eq, Show)

data Operator = Add | Subtract | Multiply | Divide
  deriving stock (Eq, Show, Enum, Bounded)

data Closure = Open | Closed
  deriving stock (Eq, Show, Enum, Bounded)

type Item = Located Item_

-- | What stands in the braces of a contour.
data Item_
  = -- | a walked element and the link to the one after it
    Element (Maybe (Located Walk)) Expr (Maybe Link)
  | -- | @for a in list { … }@
    For (Located Name) Expr [Item]
  | -- | an item that could not be read, and the name that it would have defined
    BrokenItem (Maybe (Located Name))
  deriving stock (Eq, Show)

-- | The sense in which a circle is walked.
data Walk = Clockwise | CounterClockwise
  deriving stock (Eq, Show, Enum, Bounded)

type Link = Located Link_

data Link_
  = -- | the intersection, chosen by the nearness of a point
    Meet (Maybe Expr)
  | Smooth
  | Tangent
  | -- | the radius; positive is walked clockwise, negative counter-clockwise
    Fillet Expr
  | Chamfer Expr
  deriving stock (Eq, Show)

-- | Where the cutter stands.
data Side = Outside | Inside | LeftSide | RightSide | On
  deriving stock (Eq, Show, Enum, Bounded)

type Setting = Located Setting_

-- | What stands in the braces of a machining statement.
data Setting_
  = Approach (NonEmpty Stop)
  | Retract (NonEmpty Stop)
  | -- | a setting that could not be read
    BrokenSetting
  deriving stock (Eq, Show)

-- | A point to go to, and how fast.
data Stop = Stop {point :: Expr, pace :: Pace}
  deriving stock (Eq, Show)

-- | The feed of a move.
data Pace
  = -- | the feed in force
    Cutting
  | Rapid
  | AtFeed Expr
  deriving stock (Eq, Show)
