-- | The text of a machine's description as statements, before anything is known of machines.
module Machine.Syntax
  ( Statement (..),
    Argument,
    Argument_ (..),
    Note (..),
    Formula (..),
    Operator (..),
    keyWord,
    written,
    evaluate,
  )
where

import Base.Region (Located (..), Region (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Machine (Provenance)

-- | One line: a key, what it says, how that is known; and the statements in its braces.
data Statement = Statement
  { key :: Argument,
    arguments :: [Argument],
    -- | behind @=@
    formula :: Maybe (Located Formula),
    note :: Maybe (Located Note),
    block :: Maybe [Statement],
    -- | from the key to what stands before the mark
    told :: Region,
    -- | something in the line could not be read, and was reported
    broken :: Bool
  }
  deriving stock (Eq, Show)

type Argument = Located Argument_

data Argument_
  = Word Text
  | -- | between quotation marks
    Quoted Text
  | -- | as it is written, and its value; not below zero
    Number Text Double
  | -- | @0..40@
    Range Int Int
  | -- | @name:2@
    Bit Text Int
  | -- | @-@
    Dash
  deriving stock (Eq, Show)

-- | How a value is known, and where it stands.
data Note = Note Provenance (Maybe Text)
  deriving stock (Eq, Show)

-- | A formula in n. A lone number keeps how it is written: it may be a pattern of holes.
data Formula
  = Constant Text Double
  | Variable
  | Negative Formula
  | Binary Operator Formula Formula
  deriving stock (Eq, Show)

data Operator = Add | Subtract | Multiply | Divide | Power
  deriving stock (Eq, Show)

-- | The key, where it is a word.
keyWord :: Statement -> Maybe Text
keyWord s = case value (key s) of
  Word w -> Just w
  Quoted _ -> Nothing
  Number _ _ -> Nothing
  Range _ _ -> Nothing
  Bit _ _ -> Nothing
  Dash -> Nothing

-- | A stretch of the text on one line, blanks made one.
written :: Text -> Region -> Text
written text region =
  Text.unwords (Text.words (Text.take (end region - start region) (Text.drop (start region) text)))

-- | The value for an n. Not a number, or without end, where there is none.
evaluate :: Double -> Formula -> Double
evaluate n f = case f of
  Constant _ v -> v
  Variable -> n
  Negative a -> negate (evaluate n a)
  Binary operator a b -> apply operator (evaluate n a) (evaluate n b)
  where
    apply operator a b = case operator of
      Add -> a + b
      Subtract -> a - b
      Multiply -> a * b
      Divide -> a / b
      Power -> a ** b
