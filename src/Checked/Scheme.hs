-- | What a name stands for while types are inferred, and what of it is still open.
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

-- | What a name stands for.
data Binding
  = Value Region Type
  | Function Region [Text] Scheme
  | -- | a parameter or the variable of a repetition
    Local Region Type
  | -- | a definition that is already reported as wrong
    Poisoned Region

-- | The type of a function: the unknowns that are fresh at each use, and the operations of its body
-- that can be decided only when the arguments are known.
data Scheme = Scheme {quantified :: IntSet, parameters :: [Type], result :: Type, deferred :: [DeferredConstraint]}

-- | What a name stands for at a place, for a reader.
data Meaning
  = Valued Type
  | Callable [Text] Scheme
  | -- | in words
    Described Text

-- | What can be decided only when more is known.
data DeferredConstraint = Operation Arithmetic | Overloaded OverloadedCall

-- | An operation whose operands may not be known yet.
data Arithmetic = Arithmetic
  { place :: Region,
    operator :: Operator,
    left :: (Region, Type),
    right :: (Region, Type),
    outcome :: Type
  }

-- | A call of a function that has several forms.
data OverloadedCall = OverloadedCall
  { at :: Region,
    builtin :: Builtin,
    labels :: [ArgumentLabel],
    given :: [(Region, Type)],
    chosen :: Type
  }
