{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Faults of engraved texts.
module Part.EngravingError
  ( EngravingMistake (..),
    CircleMisfit (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm)
import Base.Region (Region)
import Data.Char (isPrint)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (Report (..), at, quote)

-- | A fault of an engraved text. The first field of every constructor is the region that the report
-- points at. The comment of a constructor names the other fields in order.
data EngravingMistake
  = -- | a character for which there is no letter
    NoLetter Region Char
  | -- | a text that is empty, or consists of spaces
    NothingToEngrave Region
  | -- | a statement without a depth
    NoDepth Region
  | -- | a text that does not fit its circle
    NoFit Region CircleMisfit
  deriving stock (Eq, Show)

-- | The reason why a text does not fit its circle.
data CircleMisfit
  = -- | its point is the centre of the circle
    AtCentre
  | -- | it is longer than the circle on which its widths are measured: its width, and the length of
    -- this circle
    TooLong Mm Mm
  | -- | letters inside the circle that are not lower than its radius: their height, and the radius
    TooHigh Mm Mm
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: LengthUnit -> EngravingMistake -> Report
toReport unit fault = case fault of
  NoLetter region c ->
    (at region "E0385" ("there is no letter for " <> written c))
      { message = ["There are letters of the Latin and of the Russian alphabet, digits and signs."],
        hints =
          [ if c == '\t'
              then "Write spaces instead of the tabulator."
              else "Write another character, or draw it as a contour and mill on the contour."
          ]
      }
  NothingToEngrave region ->
    (at region "E0386" "this text has nothing to engrave")
      { hints = ["Write the text, or leave the statement out."]
      }
  NoDepth region ->
    (at region "E0387" "this text has no depth")
      { message = ["From one stroke to the next the cutter has to be lifted and to go down again."],
        hints = ["Give the depth in the braces, for example depth 0.3."]
      }
  NoFit region misfit ->
    let (title, sentence, hint) = misfitWords unit misfit
     in (at region "E0388" title) {message = [sentence], hints = [hint]}

-- | The title of the report, its sentence and its hint.
misfitWords :: LengthUnit -> CircleMisfit -> (Text, Text, Text)
misfitWords unit misfit = case misfit of
  AtCentre ->
    ( "the point of the text is the centre of its circle",
      "The point says where on the circle the text is.",
      "Give a point in the direction of the text, for example one on the circle."
    )
  TooLong width circumference ->
    ( "this text is longer than its circle",
      "The text has a width of " <> size width <> ", once round the circle is "
        <> size circumference
        <> ".",
      smaller
    )
  TooHigh height radius ->
    ( "this circle is too small for letters inside it",
      "The capitals are " <> size height <> " high, the radius is " <> size radius <> ".",
      smaller
    )
  where
    size = Decimal.inUnit unit
    smaller = "Give the text a smaller height, or a larger circle."

-- | A character in the words of a report. One that cannot be seen is given by its number.
written :: Char -> Text
written c
  | isPrint c = quote (Text.singleton c)
  | otherwise = "the character with the number " <> Text.pack (show (fromEnum c))
