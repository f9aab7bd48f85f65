-- | Texts of comments in the characters that every control reads.
module Gcode.CommentText
  ( plain,
  )
where

import Data.Char (isAscii, isPrint, isSpace, isUpper, toLower, toUpper)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text

-- | The text in ASCII. Russian letters are transliterated as in ICAO Doc 9303, part 3, section 6;
-- other characters outside ASCII become underscores. Control characters are left out.
plain :: Text -> Text
plain = Text.concatMap one
  where
    one c
      | isSpace c = " "
      | isAscii c = if isPrint c then Text.singleton c else ""
      | Just latin <- Map.lookup (toLower c) cyrillic = if isUpper c then capital latin else latin
      | isPrint c = "_"
      | otherwise = ""
    capital latin = case Text.uncons latin of
      Just (c, more) -> Text.cons (toUpper c) more
      Nothing -> latin

-- | The Russian letters in Latin letters.
cyrillic :: Map Char Text
cyrillic =
  Map.fromList $
    zip
      "абвгдеёжзийклмнопрстуфхцчшщъыьэюя"
      ( Text.words "a b v g d e e zh z i i k l m n o p r s t u f kh ts ch sh shch ie y"
          <> ["", "e", "iu", "ia"]
      )
