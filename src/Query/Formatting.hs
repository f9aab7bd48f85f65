-- | The change that turns the text of a program into its formatted text, for editors.
module Query.Formatting
  ( Change (..),
    change,
  )
where

import Base.Lines qualified as Lines
import Base.Region (Region (..))
import Data.Text (Text)
import Data.Text qualified as Text

-- | A change of a text: the region that it replaces, which consists of whole lines, and the new
-- text.
data Change = Change {region :: Region, newText :: Text}
  deriving stock (Eq, Show)

-- | The change that turns the text @before@ into the text @after@. It replaces all lines from the
-- first difference to the last difference. 'Nothing' if the texts are equal.
change :: Text -> Text -> Maybe Change
change before after
  | before == after = Nothing
  | otherwise =
    Just
      Change
        { region = Region from (from + sum (map Text.length oldMiddle)),
          newText = Text.concat newMiddle
        }
  where
    (front, old, new) = splitCommonPrefix (Lines.divided before) (Lines.divided after)
    (_, reversedOld, reversedNew) = splitCommonPrefix (reverse old) (reverse new)
    (oldMiddle, newMiddle) = (reverse reversedOld, reverse reversedNew)
    from = sum (map Text.length front)

-- | The common prefix of two lists of lines, and the remaining lines of each list.
splitCommonPrefix :: [Text] -> [Text] -> ([Text], [Text], [Text])
splitCommonPrefix a b = case (a, b) of
  (x : as, y : bs)
    | x == y ->
      let (front, as', bs') = splitCommonPrefix as bs in (x : front, as', bs')
  _ -> ([], a, b)
