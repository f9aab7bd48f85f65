-- | The program after checking: every name known, every term of the right type, every number in
-- mm, radians and mm/min.
module Checked.Syntax
  ( Program (..),
    Statement,
    Statement_ (..),
    Expr,
    Expr_ (..),
    Item,
    Item_ (..),
    Link,
    Link_ (..),
    Stop (..),
    Pace (..),
    Builtin (..),

    -- * As in the surface syntax
    Closure (..),
    MachineRef (..),
    Operator (..),
    Side (..),
    Walk (..),
  )
where

import Base.Name (Name)
import Base.Region (Located)
import Data.List.NonEmpty (NonEmpty)
import Data.Text (Text)
import Surface.Syntax (Closure (..), MachineRef (..), Operator (..), Side (..), Walk (..))

-- | A program. Statements that contain a mistake are left out.
data Program = Program
  { name :: Maybe Name,
    title :: Maybe Text,
    machine :: Maybe (Located MachineRef),
    statements :: [Statement]
  }
  deriving stock (Eq, Show)

type Statement = Located Statement_

data Statement_
  = -- | the diameter of a cutter
    Tool Expr
  | Feed Expr
  | Tolerance Expr
  | From Expr
  | LetValue Name Expr
  | LetFunction Name (NonEmpty Name) Expr
  | Contour (Located Name) Closure [Item]
  | -- | the contour, the side, approach points, retract points
    Mill Expr (Located Side) [Stop] [Stop]
  | Travel (NonEmpty Stop)
  deriving stock (Eq, Show)

type Expr = Located Expr_

data Expr_
  = Number Double
  | Variable Name
  | -- | a function of the program
    Apply Name (NonEmpty Expr)
  | Builtin Builtin [Expr]
  | Negate Expr
  | Binary Operator Expr Expr
  | Pair Expr Expr
  | List [Expr]
  deriving stock (Eq, Show)

-- | What the language brings along.
data Builtin
  = Pi
  | Polar
  | MakeCircle
  | MakeLine
  | Distance
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
  deriving stock (Eq, Show, Enum, Bounded)

type Item = Located Item_

data Item_
  = -- | a circle in its sense, a line, or a point, and the link behind it
    Element (Maybe Walk) Expr (Maybe Link)
  | For Name Expr [Item]
  deriving stock (Eq, Show)

type Link = Located Link_

data Link_
  = Meet (Maybe Expr)
  | Smooth
  | Tangent
  | Fillet Expr
  | Chamfer Expr
  deriving stock (Eq, Show)

data Stop = Stop {point :: Expr, pace :: Pace}
  deriving stock (Eq, Show)

data Pace = Cutting | Rapid | AtFeed Expr
  deriving stock (Eq, Show)
