-- | The keys of machine descriptions, for an editor.
--
-- The reader of descriptions knows which keys a section may have, and names them in its report on
-- an unknown key. So the word at the cursor is replaced by a key that does not exist, and this
-- report is looked for.
module Query.DescriptionKey
  ( DescriptionKeys (..),
    keysAt,
  )
where

import Base.Region (Region (..))
import Base.Result (Result (errors))
import Data.Char (isAlphaNum)
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Error (Error (UnknownKey))
import Machine.FromText qualified as Machine
import Machine.Machine (Machine)

-- | The word at the cursor, where a statement begins: its region, the section, and all keys that
-- the section may have.
data DescriptionKeys = DescriptionKeys {word :: Region, section :: Text, keys :: [Text]}
  deriving stock (Eq, Show)

-- | The keys that may stand at the offset @at@ of a description; nothing if no statement begins
-- there, or if the description has mistakes that hide the section.
keysAt :: Text -> Int -> Maybe DescriptionKeys
keysAt text at =
  listToMaybe
    [ DescriptionKeys {word = Region from to, section, keys}
      | UnknownKey (Region place _) _ section keys <- errors described,
        place == from
    ]
  where
    from = at - Text.length (Text.takeWhileEnd isWordPart (Text.take at text))
    to = at + Text.length (Text.takeWhile isWordPart (Text.drop at text))
    changed = Text.concat [Text.take from text, noKey, Text.drop to text]
    described = Machine.read changed :: Result () Error Machine
    noKey = "no-such-key"
    isWordPart c = isAlphaNum c || c == '-'
