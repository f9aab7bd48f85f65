-- | The meanings of names during type inference, and the constraints that it cannot solve yet. An
-- unknown is a type or a dimension that inference has yet to find; it is identified by a number.
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
  = -- | a value that the program defines: its type
    Value Region Type
  | -- | a function that the program defines: the names of its parameters, and its type
    Function Region [Text] Scheme
  | -- | a parameter of a function, or the variable of a repetition: its type
    Local Region Type
  | -- | a name whose definition is already reported as wrong; uses of it are not reported again
    Poisoned Region

-- | The type of a function of the program. It is polymorphic: calls may have arguments of different
-- types.
data Scheme = Scheme
  { -- | the numbers of its variables: the unknowns for which each call has new unknowns
    quantified :: IntSet,
    parameters :: [Type],
    result :: Type,
    -- | the constraints of the function's body that only the arguments of a call can solve
    deferred :: [DeferredConstraint]
  }

-- | The facts about a mentioned name, from which inference makes the description that an editor
-- shows.
data Meaning
  = -- | a value: its type
    Valued Type
  | -- | a function: the names of its parameters, and its type
    Callable [Text] Scheme
  | -- | anything else: its description in words
    Described Text

-- | A constraint that inference can solve only when it knows more types.
data DeferredConstraint = Operation Arithmetic | Overloaded OverloadedCall

-- | An operation with two operands, whose types may be unknown.
data Arithmetic = Arithmetic
  { -- | the region of the whole operation
    arithmeticRegion :: Region,
    operator :: Operator,
    -- | the region and the type of the left operand
    left :: (Region, Type),
    -- | the region and the type of the right operand
    right :: (Region, Type),
    -- | the type of the result
    outcome :: Type
  }

-- | A call of a built-in function that has several forms: lists of parameters with the type of the
-- result.
data OverloadedCall = OverloadedCall
  { -- | the region of the whole call
    callRegion :: Region,
    builtin :: Builtin,
    -- | the labels of all arguments in order: each is a word such as @near@, a rank (@first@ or
    -- @last@), or the mark of an argument without a label
    labels :: [ArgumentLabel],
    -- | the regions and the types of the arguments that have a value: all but @first@ and @last@
    arguments :: [(Region, Type)],
    -- | the type of the result
    callType :: Type
  }
