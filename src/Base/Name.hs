-- | Names of a part program, and suggestions for misspelt ones.
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

-- | The candidates that the user may have meant by the misspelt name @wanted@, nearest first. Their
-- Levenshtein distance from it is at most a third of its length. Upper and lower case count as the
-- same letter.
nearest :: Text -> [Text] -> [Text]
nearest wanted candidates =
  map
    fst
    ( sortOn
        snd
        [ (c, d)
          | c <- candidates,
            abs (Text.length c - size) <= allowed,
            Just d <- [distance allowed small (lower c)]
        ]
    )
  where
    size = Text.length wanted
    allowed = size `div` 3
    small = lower wanted
    lower = Text.unpack . Text.toLower

-- | The candidates that look like the name @wanted@ but have some letters of the other alphabet:
-- Latin for Cyrillic, or Cyrillic for Latin.
lookAlike :: Text -> [Text] -> [Text]
lookAlike wanted candidates =
  [c | c <- candidates, Text.compareLength c size == EQ, c /= wanted, Text.map latin c == seen]
  where
    size = Text.length wanted
    seen = Text.map latin wanted

-- | The Latin letter that a Cyrillic letter looks like; any other letter itself.
latin :: Char -> Char
latin c = Maybe.fromMaybe c (lookup c (zip "асеорхуіјѕАВСЕНІЈКМОРЅТХ" "aceopxyijsABCEHIJKMOPSTX"))

-- | The Levenshtein distance of the words @a@ and @b@: the least count of letters to insert, delete
-- or replace. Nothing if it exceeds @most@.
--
-- The table of the Wagner–Fischer algorithm is computed row by row. The computation stops at the
-- first row in which all distances exceed @most@. Usually this is one of the first rows.
distance :: Int -> String -> String -> Maybe Int
distance most a b = go [0 .. length b] a
  where
    -- A row contains the distances of one prefix of @a@ from every prefix of @b@, the empty one
    -- first.
    go row rest = case rest of
      _ | all (> most) row -> Nothing
      [] -> let d = last row in if d <= most then Just d else Nothing
      c : more -> go (next c row) more
    next c row = case row of
      [] -> []
      first : others -> scanl (cell c) (first + 1) (zip3 b row others)
    cell c left (d, diagonal, above) =
      min (min left above + 1) (if c == d then diagonal else diagonal + 1)
