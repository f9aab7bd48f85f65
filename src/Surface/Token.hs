-- | The words of a program text.
module Surface.Token
  ( Token (..),
    Token_ (..),
    Numeral (..),
    Unit (..),
    unitName,
    columnUnits,
    describe,
  )
where

import Base.Region (Region)
import Data.Text (Text)
import Data.Text qualified as Text

-- | A token, where it stands, and what stands before it.
data Token = Token
  { place :: Region,
    shape :: Token_,
    -- | it is the first on its line
    newLine :: Bool,
    -- | it touches the token before it
    attached :: Bool
  }
  deriving stock (Eq, Ord, Show)

-- | The shapes of tokens.
data Token_
  = -- | a name or a keyword; which of them is for the parser to say
    Word Text
  | -- | a number as written, and the unit behind it
    Number {-# UNPACK #-} Numeral (Maybe Unit)
  | Text Text
  | Symbol Text
  | -- | a number that is none: @1.2.3@, or one too large to hold
    BadNumber Text
  | -- | a text without its closing quotation mark
    OpenText
  | -- | a character that begins no token
    Stray Char
  deriving stock (Eq, Ord, Show)

-- | A number: its digits as they are written, and how much they are.
data Numeral = Numeral {digits :: {-# UNPACK #-} Text, amount :: Double}
  deriving stock (Eq, Ord, Show)

-- | The units of a drawing.
data Unit
  = Millimetre
  | Centimetre
  | Metre
  | Inch
  | Degree
  | Radian
  | MmPerMin
  | MPerMin
  | InPerMin
  | Rpm
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | A unit as it is written.
unitName :: Unit -> Text
unitName unit = case unit of
  Millimetre -> "mm"
  Centimetre -> "cm"
  Metre -> "m"
  Inch -> "in"
  Degree -> "deg"
  Radian -> "rad"
  MmPerMin -> "mm/min"
  MPerMin -> "m/min"
  InPerMin -> "in/min"
  Rpm -> "rpm"

-- | The units that a column of a table can have: of lengths and angles.
columnUnits :: [Unit]
columnUnits = [Millimetre, Centimetre, Metre, Inch, Degree, Radian]

-- | A token in the words of a report.
describe :: Token_ -> Text
describe token = case token of
  Word text -> "‘" <> short text <> "’"
  Number value _ -> "the number " <> short (digits value)
  Text _ -> "a text"
  Symbol text -> "‘" <> text <> "’"
  BadNumber text -> "‘" <> short text <> "’"
  OpenText -> "a text without an end"
  Stray c -> "the character ‘" <> Text.singleton c <> "’"
  where
    short text = if Text.length text > 60 then Text.take 57 text <> "…" else text
