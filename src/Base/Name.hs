-- | Names of a part program, and suggestions for misspelt ones.
module Base.Name
  ( Name (..),
    hidden,
    isHidden,
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

-- | A name that no program can write, of something that belongs to the name @owner@.
hidden :: Name -> Text -> Name
hidden (Name owner) word = Name (owner <> " " <> word)

-- | True for the names that 'hidden' makes.
isHidden :: Name -> Bool
isHidden (Name name) = Text.any (== ' ') name

-- | The candidates that the user may have meant by the misspelt name @wanted@, nearest first. Their
-- edit distance from it is at most a third of its length. Upper and lower case count as the same
-- letter.
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

-- | The edit distance of the words @a@ and @b@: the least count of letters to insert, delete or
-- replace, and of neighbours to exchange. Nothing if it exceeds @most@.
--
-- The table of the Wagner–Fischer algorithm, with exchanges as in optimal string alignment, is
-- computed row by row. The computation stops when no later row can have a distance of at most
-- @most@. Usually this is after a few rows.
distance :: Int -> String -> String -> Maybe Int
distance most a b = go Nothing [0 .. length b] a
  where
    -- A row contains the distances of one prefix of @a@ from every prefix of @b@, the empty one
    -- first. The first argument is the last letter of this prefix, and the row before.
    go before row rest = case rest of
      _ | all (> most) row && maybe True (all (>= most) . snd) before -> Nothing
      [] -> let d = last row in if d <= most then Just d else Nothing
      c : more -> go (Just (c, row)) (next c before row) more
    next c before row = case row of
      [] -> []
      first : others -> scanl (cell c) (first + 1) (zip3 (zip b (exchanged c before)) row others)
    cell c left ((d, swapped), diagonal, above) =
      minimum [left + 1, above + 1, if c == d then diagonal else diagonal + 1, swapped]
    -- For each letter of @b@, the distance if it and the letter before it are exchanged.
    exchanged c before = case before of
      Nothing -> repeat maxBound
      Just (p, row) ->
        maxBound :
          [ if c == x && p == y then d + 1 else maxBound
            | (x, y, d) <- zip3 b (drop 1 b) row
          ]
