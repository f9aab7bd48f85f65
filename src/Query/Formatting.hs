-- | The canonical layout of a program, as a change of its text.
module Query.Formatting
  ( Change (..),
    change,
  )
where

import Base.Region (Region (..))
import Data.Text (Text)
import Data.Text qualified as Text

-- | New text for a stretch of whole lines.
data Change = Change {place :: Region, put :: Text}
  deriving stock (Eq, Show)

-- | The lines that differ between two texts, from the first to the last of them.
change :: Text -> Text -> Maybe Change
change before after
  | before == after = Nothing
  | otherwise =
    Just
      Change {place = Region from (from + sum (map Text.length middle)), put = Text.concat middle'}
  where
    (front, old, new) = common (linesOf before) (linesOf after)
    (_, old', new') = common (reverse old) (reverse new)
    (middle, middle') = (reverse old', reverse new')
    from = sum (map Text.length front)

common :: [Text] -> [Text] -> ([Text], [Text], [Text])
common a b = case (a, b) of
  (x : as, y : bs) | x == y -> let (front, as', bs') = common as bs in (x : front, as', bs')
  _ -> ([], a, b)

-- | The lines, each with its end: LF, CR or CR LF.
linesOf :: Text -> [Text]
linesOf text
  | Text.null text = []
  | otherwise = (before <> ending) : linesOf (Text.drop (Text.length ending) rest)
  where
    (before, rest) = Text.break (\c -> c == '\n' || c == '\r') text
    ending = if "\r\n" `Text.isPrefixOf` rest then "\r\n" else Text.take 1 rest
