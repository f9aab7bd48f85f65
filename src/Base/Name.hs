-- | Names that a program gives to things.
module Base.Name
  ( Name (..),
    nearest,
    lookAlike,
  )
where

import Data.List (sortOn)
import Data.Maybe qualified as Maybe
import Data.String (IsString)
import Data.Text (Text)
import Data.Text qualified as Text

-- | An identifier of the part language, Cyrillic or Latin.
newtype Name = Name {text :: Text}
  deriving newtype (Eq, Ord, IsString)
  deriving stock (Show)

-- | The candidates near enough to a misspelt name to be worth suggesting, the nearest first:
-- one edit for every three letters.
nearest :: Text -> [Text] -> [Text]
nearest wanted candidates =
  map fst (sortOn snd [(c, d) | c <- candidates, abs (Text.length c - size) <= allowed, let d = distance wanted c, d <= allowed])
  where
    size = Text.length wanted
    allowed = size `div` 3

-- | The candidates that look the same but are written with letters of another alphabet.
lookAlike :: Text -> [Text] -> [Text]
lookAlike wanted candidates = [c | c <- candidates, Text.compareLength c size == EQ, c /= wanted, Text.map latin c == seen]
  where
    size = Text.length wanted
    seen = Text.map latin wanted

-- | The Latin letter that a Cyrillic one looks like.
latin :: Char -> Char
latin c = Maybe.fromMaybe c (lookup c (zip "асеорхуіјѕАВСЕНІЈКМОРЅТХ" "aceopxyijsABCEHIJKMOPSTX"))

-- | The edit distance of Levenshtein, letter case ignored.
distance :: Text -> Text -> Int
distance a b = case foldl step [0 .. Text.length b] (Text.unpack (Text.toLower a)) of
  [] -> 0
  row -> last row
  where
    other = Text.unpack (Text.toLower b)
    step row c = case row of
      [] -> []
      first : rest -> scanl (cell c) (first + 1) (zip3 other row rest)
    cell c left (d, diagonal, above) =
      minimum [left + 1, above + 1, if c == d then diagonal else diagonal + 1]
