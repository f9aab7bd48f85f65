-- | Mistakes in texts with outlines of a font, and their reports. Their places are in the text of
-- the program.
module Surface.FontError
  ( FontMistake (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region)
import Data.Text (Text)
import Data.Text qualified as Text
import Font.TrueType (FontFault (..))
import Font.TrueType qualified as TrueType
import Report.Report (Report (..), at, quote)

-- | A mistake in a text with outlines of a font.
data FontMistake
  = -- | a file that is no font by its name
    NotAFont Region Text
  | -- | a font that cannot be read: the region of its name, the name, the reason
    BadFont Region Text FontFault
  | -- | a font that has no height of capitals: the region of its name, the name
    NoCapitals Region Text
  | -- | more characters than the limit: the region of the text, the count
    LongText Region Int
  | -- | a character that the font lacks: its region, the character, the name of the font
    NoGlyph Region Char Text
  | -- | a text whose letters have no outlines: the region of the text
    NothingToOutline Region
  | -- | outlines of one letter that cross or touch: the region of the letter
    CrossingGlyph Region
  | -- | a text round a circle: the region of the circle
    RoundCircle Region
  deriving stock (Eq, Ord, Show)

-- | The report of a mistake.
toReport :: FontMistake -> Report
toReport fault = case fault of
  NotAFont region name ->
    (at region "E0126" (quote name <> " is no font by its name"))
      { hints = ["The name of a font ends in .ttf, .otf or .ttc."]
      }
  BadFont region name reason -> badFont region name reason
  NoCapitals region name ->
    (at region "E0126" (quote name <> " does not tell the height of its capitals"))
      { message = ["Neither its table OS/2 states a height, nor does it have the letter H."],
        hints = ["Choose another font."]
      }
  LongText region count ->
    (at region "E0127" ("this text has " <> Decimal.whole count <> " characters"))
      { hints = ["Divide it into texts of " <> Decimal.whole TrueType.mostCharacters <> "."]
      }
  NoGlyph region character name ->
    (at region "E0127" (quote name <> " has no letter " <> quote (Text.singleton character)))
      { hints = ["Write another sign in its place, or choose another font."]
      }
  NothingToOutline region ->
    (at region "E0127" "this text has no outlines")
      { message = ["A space has none."],
        hints = ["Write at least one letter, digit or sign between the quotation marks."]
      }
  CrossingGlyph region ->
    (at region "E0127" "the outlines of this letter cross or touch")
      { message = ["So inside and outside are not clear."],
        hints = ["Choose another font."]
      }
  RoundCircle region ->
    (at region "E0127" "letters with outlines do not stand round a circle")
      { hints = ["Write direction for a straight line. Only engrave has letters round a circle."]
      }

-- | The report of a font that cannot be read.
badFont :: Region -> Text -> FontFault -> Report
badFont region name reason = case reason of
  NoFont ->
    (font "is damaged, or it is no font")
      { hints = ["Copy the file again. A font is in the format TrueType or OpenType."]
      }
  WithoutOutlines ->
    (font "has no outlines") {message = ["It has only pictures of its letters."], hints = other}
  WithoutCharacters ->
    (font "does not name its letters")
      { message = ["It does not say which of its glyphs belong to which characters of Unicode."],
        hints = other
      }
  ByInstructions ->
    (font "makes its outlines by instructions")
      { message = ["They exist only for one size in points each."],
        hints = other
      }
  TooMuch ->
    (font "is too large")
      { message =
          [ "A font may have " <> Decimal.whole (TrueType.mostBytes `div` 1048576)
              <> " MB, and FreeType 256 MB to read it."
          ],
        hints = other
      }
  DamagedGlyph ->
    (font "is damaged")
      { message = ["A letter of this text cannot be read."],
        hints = ["Copy the file again."]
      }
  where
    font title = at region "E0126" (quote name <> " " <> title)
    other = ["Choose another font."]
