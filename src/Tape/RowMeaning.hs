-- | Rows of a tape explained in English, for the picture of a tape and for reports.
--
-- "Tape.FrameWriter" gives the meaning of each row as a 'RowKind'. This module puts it into words;
-- it does not interpret holes. A hole in the service track gives the digit in its row an extra
-- meaning.
module Tape.RowMeaning
  ( Row (..),
    row,
    wordMeaning,
    shown,
  )
where

import Base.Decimal qualified as Decimal
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word8)
import Machine.Machine
  ( CommandName (..),
    Content (..),
    Machine,
    MotionCodes (..),
    NumberForm (..),
    Service (..),
    Sign (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Tape.Layout
  ( BlankRows (..),
    MarkedRow (MarkedRow),
    PreparedLayout,
    RowKind (..),
    WordRow (..),
  )
import Tape.Layout qualified as Layout
import Tape.Symbol qualified as Symbol

-- | Row of a tape with its explanation.
data Row = Row
  { holes :: Word8,
    -- | number of the row's frame, from 1; 'Nothing' for rows before the first frame and after the
    -- last one
    frame :: Maybe Int,
    -- | symbol that the tape code gives to 'holes'; 'Nothing' if it gives none
    symbol :: Maybe Char,
    -- | purpose of the row
    kind :: RowKind,
    -- | the purpose of the row in English, on one line
    meaning :: Text
  }
  deriving stock (Eq, Show)

-- | Explains a row. The number @n@ of its frame counts from 1; it is 'Nothing' for a row outside of
-- all frames.
row :: PreparedLayout -> Maybe Int -> MarkedRow -> Row
row layout n (MarkedRow h _ purpose) =
  Row
    { holes = h,
      frame = n,
      symbol = Symbol.symbolAt (Layout.symbols layout) h,
      kind = purpose,
      meaning = meaningOf layout purpose
    }

-- | English text for the purpose of a row.
meaningOf :: PreparedLayout -> RowKind -> Text
meaningOf layout purpose = case purpose of
  Blank Leader -> "leader"
  Blank Gap -> "gap"
  Blank Shift -> "shift of an even frame"
  Blank Trailer -> "trailer"
  Opening c -> "opening " <> shown c
  Closing c -> "closing " <> shown c
  Constant c -> "always " <> shown c
  Separator c -> "between words " <> shown c
  CheckSymbol d -> "check digit " <> Decimal.whole d
  InWord c _ (AddressSymbol a) -> Machine.contentName c <> ", address " <> shown a
  InWord c n (PriorityDigit d) ->
    Machine.contentName c <> ", " <> priorityText c n d <> " " <> Decimal.whole d
  InWord c _ (SignSymbol '-') -> Machine.contentName c <> ", minus"
  InWord c _ (SignSymbol _) -> Machine.contentName c <> ", plus"
  InWord c _ Point -> Machine.contentName c <> ", point"
  InWord c n (Digit d k use isPunched) ->
    Machine.contentName c
      <> positionText (formOf c) k
      <> " "
      <> Decimal.whole d
      <> motionAfterDigit c n k
      <> (if isPunched then serviceText use else "")
  where
    formOf c = case [form w | w <- Layout.frameWords layout, content w == c] of
      f : _ -> Just f
      [] -> Nothing
    priorityText c n d =
      (if isLeading c d then "leading " else "following ")
        <> (if n < 0 then "backwards" else "forwards")
    isLeading c d = or [d == a || d == b | Just NumberForm {sign = Priority a b _ _} <- [formOf c]]

-- | Name of the decimal position of digit @k@ (0 is the last digit) in a number of the form @f@,
-- with a space before the name: @" tens"@. Empty for a form with one digit, and without a form.
positionText :: Maybe NumberForm -> Int -> Text
positionText f k = case f of
  Just NumberForm {digits = 1} -> ""
  Just NumberForm {decimals} -> named (k - decimals)
  Nothing -> ""
  where
    named e
      | e < 0 = " " <> fraction (negate e)
      | otherwise = " " <> whole e
    whole e = case e of
      0 -> "units"
      1 -> "tens"
      2 -> "hundreds"
      3 -> "thousands"
      4 -> "ten thousands"
      5 -> "hundred thousands"
      6 -> "millions"
      _ -> "10^" <> Decimal.whole e
    fraction e = case e of
      1 -> "tenths"
      2 -> "hundredths"
      3 -> "thousandths"
      _ -> "10^-" <> Decimal.whole e

-- | Name of the motion with the code @n@, after a comma, for the last digit (@k@ = 0) of a motion
-- word. Empty for all other digits, and for words whose content @c@ is not a motion.
motionAfterDigit :: Content -> Int -> Int -> Text
motionAfterDigit c n k = case c of
  Motion codes | k == 0 -> ", " <> motionText codes n
  _ -> ""

-- | Name of the motion that the code @n@ of a motion word means, or @unknown@ if the machine does
-- not use the code.
motionText :: MotionCodes -> Int -> Text
motionText codes n
  | n == straight codes = "straight"
  | Just n == rapid codes = "rapid"
  | Just n == clockwise codes = "clockwise"
  | Just n == counterClockwise codes = "counter-clockwise"
  | otherwise = "unknown"

-- | Meaning of a hole in the service track, with a comma before it.
serviceText :: Service -> Text
serviceText s = case s of
  MinusHole -> ", minus"
  CommandBit (CommandName o) k -> ", " <> o <> " bit " <> Decimal.whole k
  Marker -> ", marker"
  BrakingHole -> ", braking"
  NoHole -> ""

-- | Symbol as reports print it in a sentence: in quotation marks, but a space and a line feed by
-- their names.
shown :: Char -> Text
shown c = case c of
  '\n' -> "LF"
  ' ' -> "space"
  _ -> "‘" <> Text.singleton c <> "’"

-- | English text for a word with the content @c@ and the number @n@, in units of the last
-- decimal. The picture of a tape uses it if the machine reads a text instead of a punched tape.
wordMeaning :: Machine -> Content -> Int -> Text
wordMeaning machine c n = case (c, [form w | w <- Machine.wordsOf machine, content w == c]) of
  (Motion codes, _) -> motionText codes n
  (FrameNumber, _) -> "number " <> Decimal.whole n
  (_, NumberForm {digits = 0} : _) -> Machine.contentName c
  (_, NumberForm {decimals} : _)
    | decimals > 0 ->
      Machine.contentName c <> " " <> Decimal.fixed decimals (fromIntegral n / 10 ^ decimals)
  _ -> Machine.contentName c <> " " <> Decimal.whole n
