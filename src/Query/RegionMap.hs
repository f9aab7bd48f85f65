-- | A map of regions from an old text to a new one. The changed region of each text lies between
-- the common prefix and the common suffix of the texts. Regions outside of it are mapped; regions
-- that touch the change are not.
module Query.RegionMap
  ( RegionMap,
    between,
    forward,
    back,
  )
where

import Base.Region (Region (..))
import Data.Char (isAlphaNum)
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text

-- | The texts are equal up to the offset @same@. They are also equal from the offset @old@ of the
-- old text and the offset @new@ of the new text to their ends.
data RegionMap = RegionMap {same :: Int, old :: Int, new :: Int}
  deriving stock (Eq, Show)

-- | The map from an old text to a new one. A word that the change touches counts as changed.
between :: Text -> Text -> RegionMap
between before after =
  RegionMap
    { same = Text.length prefix - length cutFront,
      old = Text.length before - kept,
      new = Text.length after - kept
    }
  where
    (prefix, before', after') = commonPrefix before after
    (suffix, left, right) = commonSuffix before' after'
    touches =
      any
        (Text.any isWordPart)
        [Text.take 1 before', Text.take 1 after', Text.takeEnd 1 left, Text.takeEnd 1 right]
    cutFront = if touches then Text.unpack (Text.takeWhileEnd isWordPart prefix) else ""
    cutBack = if touches then Text.takeWhile isWordPart suffix else ""
    kept = Text.length suffix - Text.length cutBack

-- | The common prefix of two texts, and the rest of each.
commonPrefix :: Text -> Text -> (Text, Text, Text)
commonPrefix a b = Maybe.fromMaybe ("", a, b) (Text.commonPrefixes a b)

-- | The common suffix of two texts, and the rest of each.
commonSuffix :: Text -> Text -> (Text, Text, Text)
commonSuffix a b = (Text.takeEnd size a, Text.dropEnd size a, Text.dropEnd size b)
  where
    size =
      length
        (takeWhile id (zipWith (==) (Text.unpack (Text.reverse a)) (Text.unpack (Text.reverse b))))

-- | Can a character be a part of a name or a number?
isWordPart :: Char -> Bool
isWordPart c = isAlphaNum c || c == '_'

-- | The region of the new text that corresponds to a region of the old text. Nothing for a region
-- that overlaps the change.
forward :: RegionMap -> Region -> Maybe Region
forward RegionMap {same, old, new} (Region from to)
  | to <= same = Just (Region from to)
  | from >= old = Just (Region (from - old + new) (to - old + new))
  | otherwise = Nothing

-- | The offset in the old text that corresponds to an offset of the new text. Where text was only
-- deleted, it is the offset after the deleted text. Nothing within the change.
back :: RegionMap -> Int -> Maybe Int
back RegionMap {same, old, new} at
  | at >= new = Just (at - new + old)
  | at <= same = Just at
  | otherwise = Nothing
