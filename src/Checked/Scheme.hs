-- | The meanings of names during type inference, and constraints that cannot be solved yet.
module Checked.Scheme
  ( Binding (..),
    Scheme (..),
    Meaning (..),
    DeferredConstraint (..),
    Arithmetic (..),
    OverloadedCall (..),
  )
where

import Base.Region (Region)
import Checked.Builtin (ArgumentLabel)
import Checked.Syntax (Builtin, Operator)
import Checked.Type (Type)
import Data.IntSet (IntSet)
import Data.Text (Text)

-- | The meaning of a name in scope. The region is that of the name in its definition.
data Binding
  = -- | a constant of the program
    Value Region Type
  | -- | a function with the names of its parameters
    Function Region [Text] Scheme
  | -- | a parameter of a function or the variable of a repetition
    Local Region Type
  | -- | a definition that is already reported as wrong
    Poisoned Region

-- | The polymorphic type of a function.
data Scheme = Scheme
  { -- | the numbers of the unknowns that are replaced by fresh unknowns at each use
    quantified :: IntSet,
    parameters :: [Type],
    result :: Type,
    -- | the constraints of the body that only the arguments of a call can solve
    deferred :: [DeferredConstraint]
  }

-- | The meaning of one mention of a name, from which editors describe it.
data Meaning
  = -- | a value of a type
    Valued Type
  | -- | a function with the names of its parameters
    Callable [Text] Scheme
  | -- | anything else, described in words
    Described Text

-- | A constraint that can be solved only when more types are known.
data DeferredConstraint = Operation Arithmetic | Overloaded OverloadedCall

-- | An operation whose operands may have unknown types.
data Arithmetic = Arithmetic
  { -- | the region of the whole operation
    arithmeticRegion :: Region,
    operator :: Operator,
    -- | the left operand
    left :: (Region, Type),
    -- | the right operand
    right :: (Region, Type),
    -- | the type of the result
    outcome :: Type
  }

-- | A call of a built-in function that has several forms.
data OverloadedCall = OverloadedCall
  { -- | the region of the whole call
    callRegion :: Region,
    builtin :: Builtin,
    -- | the labels of all arguments
    labels :: [ArgumentLabel],
    -- | the arguments with values: all but @first@ and @last@
    arguments :: [(Region, Type)],
    -- | the type of the result
    callType :: Type
  }
