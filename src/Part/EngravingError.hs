{-# OPTIONS_GHC -O0 #-}

-- | Faults of engraved texts.
module Part.EngravingError
  ( EngravingMistake (..),
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
  | -- | a text around a circle whose point is the centre of the circle
    AtCentre Region
  | -- | a text that is longer than the circle: the width of the text, and the
    -- length of the circle on which it is measured
    TooLong Region Mm Mm
  | -- | letters inside a circle that are not lower than its radius: their height, and the radius
    TooHigh Region Mm Mm
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: LengthUnit -> EngravingMistake -> Report
toReport unit fault = case fault of
  NoLetter region c ->
    (at region "E0385" ("there is no letter for " <> written c))
      { message = ["There are letters of the Latin and of the Russian alphabet, digits and signs."],
        hints = [if c == '\t' then "Write spaces instead of the tabulator." else drawIt]
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
  AtCentre region ->
    circleReport
      region
      "the point of the text is the centre of its circle"
      "The point says where on the circle the text is."
      "Give a point in the direction of the text, for example one on the circle."
  TooLong region width circumference ->
    circleReport
      region
      "this text is longer than its circle"
      ("The text is " <> size width <> " wide, the circle " <> size circumference <> " long.")
      smaller
  TooHigh region high radius ->
    circleReport
      region
      "this circle is too small for letters inside it"
      ("The capitals are " <> size high <> " high, the radius is " <> size radius <> ".")
      smaller
  where
    size = Decimal.inUnit unit
    smaller = "Give the text a smaller height, or a larger circle."
    circleReport region title sentence hint =
      (at region "E0388" title) {message = [sentence], hints = [hint]}

-- | The advice where there is no letter.
drawIt :: Text
drawIt = "Write another character, or draw it as a contour and mill on the contour."

-- | A character in the words of a report. One that cannot be seen is given by its number.
written :: Char -> Text
written c
  | isPrint c = quote (Text.singleton c)
  | otherwise = "the character with the number " <> Text.pack (show (fromEnum c))
