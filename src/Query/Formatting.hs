-- | The changes that turn the text of a program into its formatted text, for editors, and the
-- closing of blocks while the user types.
module Query.Formatting
  ( Change (..),
    changes,
    closing,
  )
where

import Base.Lines qualified as Lines
import Base.Region (Region (..))
import Data.Char (isSpace)
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Lexer qualified as Lexer
import Surface.Token (Token (..), Token_ (..))

-- | A change of a text: the region that it replaces, and the new text.
data Change = Change {region :: Region, newText :: Text}
  deriving stock (Eq, Show)

-- | The changes that turn the text @before@ into the text @after@, in order. Each replaces whole
-- lines, and lines that are equal in both texts are not replaced. Lines correspond if they differ
-- in spaces only.
changes :: Text -> Text -> [Change]
changes before after = joined (go 0 (Lines.divided before) (Lines.divided after))
  where
    go at old new = case (old, new) of
      ([], []) -> []
      (x : xs, y : ys)
        | x == y -> go (at + Text.length x) xs ys
        | bare x == bare y -> changed at [x] [y] : go (at + Text.length x) xs ys
      _ ->
        let (i, j) = meeting old new
            (xs, old') = splitAt i old
            (ys, new') = splitAt j new
         in changed at xs ys : go (at + sum (map Text.length xs)) old' new'
    changed at xs ys =
      Change {region = Region at (at + sum (map Text.length xs)), newText = Text.concat ys}

-- | Joins changes that touch.
joined :: [Change] -> [Change]
joined cs = case cs of
  Change (Region a b) x : Change (Region c d) y : rest
    | b == c -> joined (Change (Region a d) (x <> y) : rest)
  c : rest -> c : joined rest
  [] -> []

-- | The least counts of lines after which two lists of lines correspond again: the old lines and
-- the new ones. If they do not within 'furthest' lines, all lines are counted.
meeting :: [Text] -> [Text] -> (Int, Int)
meeting old new =
  case [ (i, total - i)
         | total <- [1 .. furthest],
           i <- [0 .. total],
           x : _ <- [drop i old],
           y : _ <- [drop (total - i) new],
           bare x == bare y,
           bare x /= ""
       ] of
    found : _ -> found
    [] -> (length old, length new)

-- | The largest number of lines within which lines that correspond are searched for.
furthest :: Int
furthest = 40

-- | A line without its spaces.
bare :: Text -> Text
bare = Text.filter (not . isSpace)

-- | The change after the user has begun a new line at the offset @at@: if the line before it ends
-- with an opening brace that is not closed, the closing brace is inserted below the new line.
closing :: Text -> Int -> Maybe Change
closing text at
  | "{" `Text.isSuffixOf` Text.stripEnd previous,
    Text.all isSpace (Text.takeWhile (`notElem` ("\n\r" :: String)) (Text.drop at text)),
    isUnclosed =
    Just Change {region = Region at at, newText = inner <> "\n" <> indent <> "}"}
  | otherwise = Nothing
  where
    (earlier, own) = Text.breakOnEnd "\n" (Text.take at text)
    previous = Text.takeWhileEnd (/= '\n') (Text.dropEnd 1 earlier)
    indent = Text.takeWhile (== ' ') previous
    inner = Text.drop (Text.length own) (indent <> "  ")
    isUnclosed = depth (map shape (fst (Lexer.tokens 0 text))) > (0 :: Int)
    depth shapes =
      length (filter (== Symbol "{") shapes) - length (filter (== Symbol "}") shapes)
