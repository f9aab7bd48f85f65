-- | What the rows of a tape mean, in words.
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
import Tape.Layout (BlankRows (..), Layout, MarkedRow (MarkedRow), RowContent (..), RowMeaning (..))
import Tape.Layout qualified as Layout
import Tape.Symbol qualified as Symbol

-- | A row of a tape as a person wants it explained.
data Row = Row
  { holes :: Word8,
    -- | the frame that it belongs to, from 1
    frame :: Maybe Int,
    -- | what a text shows for it
    symbol :: Maybe Char,
    sense :: RowMeaning,
    meaning :: Text
  }
  deriving stock (Eq, Show)

row :: Layout -> Maybe Int -> MarkedRow -> Row
row p n (MarkedRow h _ s) =
  Row
    { holes = h,
      frame = n,
      symbol = Symbol.symbolAt (Layout.symbols p) h,
      sense = s,
      meaning = meaningOf p s
    }

-- | What a row is for, in words.
meaningOf :: Layout -> RowMeaning -> Text
meaningOf p s = case s of
  Blank Leader -> "leader"
  Blank Gap -> "gap"
  Blank Shift -> "shift of an even frame"
  Blank Trailer -> "trailer"
  Opening c -> "opening " <> shown c
  Closing c -> "closing " <> shown c
  Constant c -> "always " <> shown c
  Separator c -> "between words " <> shown c
  CheckSymbol d -> "check digit " <> Decimal.whole d
  InWord c _ (Address a) -> Machine.contentWord c <> ", address " <> shown a
  InWord c n (Lead d) -> Machine.contentWord c <> ", " <> leadWord c n d <> " " <> Decimal.whole d
  InWord c _ (SignSymbol '-') -> Machine.contentWord c <> ", minus"
  InWord c _ (SignSymbol _) -> Machine.contentWord c <> ", plus"
  InWord c _ Point -> Machine.contentWord c <> ", point"
  InWord c n (Digit d k sv hole) ->
    Machine.contentWord c
      <> placeWord (formOf c) k
      <> " "
      <> Decimal.whole d
      <> kindWord c n k
      <> (if hole then holeWord sv else "")
  where
    formOf c = case [form w | w <- Layout.ws p, content w == c] of
      f : _ -> Just f
      [] -> Nothing
    leadWord c n d =
      (if isLeading c d then "leading " else "following ")
        <> (if n < 0 then "backwards" else "forwards")
    isLeading c d = or [d == a || d == b | Just NumberForm {sign = Priority a b _ _} <- [formOf c]]

-- | The name of a digit's place, with a blank before it; none where there is but one digit.
placeWord :: Maybe NumberForm -> Int -> Text
placeWord f k = case f of
  Just NumberForm {digits = 1} -> ""
  Just NumberForm {decimals} -> named (k - decimals)
  Nothing -> ""
  where
    named e
      | e < 0 = " " <> Text.replicate 1 (fraction (negate e))
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

-- | Behind the last digit of a motion its name.
kindWord :: Content -> Int -> Int -> Text
kindWord c n k = case c of
  Motion codes | k == 0 -> ", " <> motionWord codes n
  _ -> ""

motionWord :: MotionCodes -> Int -> Text
motionWord codes n
  | n == straight codes = "straight"
  | Just n == rapid codes = "rapid"
  | Just n == clockwise codes = "clockwise"
  | Just n == counterClockwise codes = "counter-clockwise"
  | otherwise = "unknown"

holeWord :: Service -> Text
holeWord s = case s of
  MinusHole -> ", minus"
  OrderBit (CommandName o) k -> ", " <> o <> " bit " <> Decimal.whole k
  Marker -> ", marker"
  BrakingHole -> ", braking"
  NoHole -> ""

-- | A symbol in a sentence.
shown :: Char -> Text
shown c = case c of
  '\n' -> "LF"
  ' ' -> "space"
  _ -> "‘" <> Text.singleton c <> "’"

-- | A word with its number, for a line of text.
wordMeaning :: Machine -> Content -> Int -> Text
wordMeaning machine c n = case (c, [form w | w <- Machine.wordsOf machine, content w == c]) of
  (Motion codes, _) -> motionWord codes n
  (FrameNumber, _) -> "number " <> Decimal.whole n
  (_, NumberForm {digits = 0} : _) -> Machine.contentWord c
  (_, NumberForm {decimals} : _)
    | decimals > 0 ->
      Machine.contentWord c <> " " <> Decimal.fixed decimals (fromIntegral n / 10 ^ decimals)
  _ -> Machine.contentWord c <> " " <> Decimal.whole n
