-- | A map of regions from an old text to a new one. The common prefix and suffix of the texts bound
-- the changed region; outside it every region has its counterpart.
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

-- | Both texts are equal before the offset @same@, and from the offset @old@ of the old text and
-- @new@ of the new text to their ends.
data RegionMap = RegionMap {same :: Int, old :: Int, new :: Int}
  deriving stock (Eq, Show)

-- | The map from an old text to a new one. A word that the change touches belongs to the change.
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

isWordPart :: Char -> Bool
isWordPart c = isAlphaNum c || c == '_'

-- | The region of the new text for a region of the old one, if it is unchanged.
forward :: RegionMap -> Region -> Maybe Region
forward RegionMap {same, old, new} (Region from to)
  | to <= same = Just (Region from to)
  | from >= old = Just (Region (from - old + new) (to - old + new))
  | otherwise = Nothing

-- | The offset in the old text for an offset of the new one. At a pure deletion it is the offset
-- after the deleted text.
back :: RegionMap -> Int -> Maybe Int
back RegionMap {same, old, new} at
  | at >= new = Just (at - new + old)
  | at <= same = Just at
  | otherwise = Nothing
