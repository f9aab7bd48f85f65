-- | The tokens of a program text.
module Surface.Token
  ( Token (..),
    Token_ (..),
    Numeral (..),
    Unit (..),
    unitName,
    columnUnits,
    spelling,
    scaledDigits,
    describe,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (quote)

-- | A token with its region, and with facts about the space before it.
data Token = Token
  { place :: Region,
    shape :: Token_,
    -- | true for the first token of a line
    newLine :: Bool,
    -- | true if nothing separates the token from the token before it
    attached :: Bool
  }
  deriving stock (Eq, Ord, Show)

-- | The kind and the content of a token.
data Token_
  = -- | a name or a keyword; the parser tells them apart
    Word Text
  | -- | a number as written, with its unit if it has one
    Number {-# UNPACK #-} Numeral (Maybe Unit)
  | -- | a text without its quotation marks
    Text Text
  | -- | punctuation or an operator
    Symbol Text
  | -- | a malformed number such as @1.2.3@, or one with too many digits
    BadNumber Text
  | -- | a text without its closing quotation mark
    OpenText
  | -- | a character that begins no token
    Stray Char
  deriving stock (Eq, Ord, Show)

-- | A number: its digits as written, and its value.
data Numeral = Numeral {digits :: {-# UNPACK #-} Text, amount :: Double}
  deriving stock (Eq, Ord, Show)

-- | The units that a number in a program may have.
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
  | FtPerMin
  | Rpm
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | The name of a unit in programs.
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
  FtPerMin -> "ft/min"
  Rpm -> "rpm"

-- | The units that a column of a table can have: those of lengths and angles.
columnUnits :: [Unit]
columnUnits = [Millimetre, Centimetre, Metre, Inch, Degree, Radian]

-- | A token as a program writes it; a number and its unit have one space between them.
spelling :: Token_ -> Text
spelling token = case token of
  Word text -> text
  Number value unit -> digits value <> maybe "" ((" " <>) . unitName) unit
  Text text -> "\"" <> text <> "\""
  Symbol text -> text
  BadNumber text -> text
  OpenText -> "\""
  Stray c -> Text.singleton c

-- | The digits of a multiple of a number, to six places after the point.
scaledDigits :: Double -> Numeral -> Text
scaledDigits factor n = Decimal.short 6 (factor * amount n)

-- | Describes a token in the words of a report. A word or a number of more than 60 characters is
-- shortened.
describe :: Token_ -> Text
describe token = case token of
  Word text -> quote text
  Number value _ -> "the number " <> short (digits value)
  Text _ -> "a text"
  Symbol text -> quote text
  BadNumber text -> quote text
  OpenText -> "a text without an end"
  Stray c -> "the character " <> quote (Text.singleton c)
  where
    short text = if Text.length text > 60 then Text.take 57 text <> "…" else text
