-- | The syntax tree of a machine description: statements with their arguments, marks and blocks.
--
-- The tree does not depend on the keys that descriptions use. "Machine.Parser" builds it;
-- "Machine.FromText" and the modules that it calls read the sections of a description from it.
module Machine.Syntax
  ( Statement (..),
    Argument,
    Argument_ (..),
    Mark (..),
    Formula (..),
    Operator (..),
    keyWord,
    sourceText,
    evaluate,
  )
where

import Base.Region (Located (..), Region (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Machine (Provenance)

-- | One line of a description: its key, then arguments, a formula and a mark; and the block in
-- braces after the line.
data Statement = Statement
  { key :: Argument,
    arguments :: [Argument],
    -- | formula after @=@
    formula :: Maybe (Located Formula),
    mark :: Maybe (Located Mark),
    block :: Maybe [Statement],
    -- | region from the key to the end of the last argument or of the formula
    extent :: Region,
    -- | true if a part of the line could not be read; the parser has then reported the mistake
    broken :: Bool
  }
  deriving stock (Eq, Show)

-- | Argument of a machine description, with its region.
type Argument = Located Argument_

-- | Argument or key of a statement: a word, a text, a number, a range, a bit or a dash.
data Argument_
  = Word Text
  | -- | text in quotation marks, without them
    Quoted Text
  | -- | digits as written, and their value; never negative
    Number Text Double
  | -- | first and last number of a range, @0..40@
    Range Int Int
  | -- | name of a command and index of one of its bits, @name:2@
    Bit Text Int
  | -- | the sign @-@: no hole beside a digit; as a key, the symbol @-@ of the code
    Dash
  deriving stock (Eq, Show)

-- | Mark of a line: the provenance of a value. The mark may have a text, which says where the
-- source prints the value.
data Mark = Mark Provenance (Maybe Text)
  deriving stock (Eq, Show)

-- | Formula in the variable @n@. A constant consists of its digits as they are written, and of its
-- value. The digits are needed where they are a pattern of holes, with a 0 or 1 for each track.
data Formula
  = Constant Text Double
  | Variable
  | Negative Formula
  | Binary Operator Formula Formula
  deriving stock (Eq, Show)

-- | Binary operator of a formula.
data Operator = Add | Subtract | Multiply | Divide | Power
  deriving stock (Eq, Show)

-- | The key of a line; 'Nothing' if the key is not a word.
keyWord :: Statement -> Maybe Text
keyWord s = case value (key s) of
  Word w -> Just w
  Quoted _ -> Nothing
  Number _ _ -> Nothing
  Range _ _ -> Nothing
  Bit _ _ -> Nothing
  Dash -> Nothing

-- | The text of a region, with each run of white space replaced by one blank.
sourceText :: Text -> Region -> Text
sourceText text region =
  Text.unwords (Text.words (Text.take (end region - start region) (Text.drop (start region) text)))

-- | Evaluates a formula at @n@. The result is NaN or infinite if the formula has no value at @n@.
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
