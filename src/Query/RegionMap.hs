-- | A map of regions from an old text to a new one. With it, answers about the old text can be
-- shown in the new text.
--
-- The changed region of each text lies between the common prefix and the common suffix of both
-- texts. It is widened to whole words. A region before or after the change is mapped; a region that
-- overlaps the change is not. An offset is the number of characters before a position.
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

-- | A map given by three offsets. The old and the new text are equal from the start to the offset
-- @same@. The old text from @old@ to its end equals the new text from @new@ to its end.
data RegionMap = RegionMap {same :: Int, old :: Int, new :: Int}
  deriving stock (Eq, Show)

-- | The map from the old text @before@ to the new text @after@. The change is widened to whole
-- words, so that no word is mapped in part.
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

-- | The common prefix of two texts, and the remaining text of each.
commonPrefix :: Text -> Text -> (Text, Text, Text)
commonPrefix a b = Maybe.fromMaybe ("", a, b) (Text.commonPrefixes a b)

-- | The common suffix of two texts, and the remaining text of each.
commonSuffix :: Text -> Text -> (Text, Text, Text)
commonSuffix a b = (Text.takeEnd size a, Text.dropEnd size a, Text.dropEnd size b)
  where
    size =
      length
        (takeWhile id (zipWith (==) (Text.unpack (Text.reverse a)) (Text.unpack (Text.reverse b))))

-- | True for the characters of which words consist: letters, digits and the underscore.
isWordPart :: Char -> Bool
isWordPart c = isAlphaNum c || c == '_'

-- | The region of the new text that corresponds to a region of the old text. 'Nothing' if the
-- region overlaps the change.
forward :: RegionMap -> Region -> Maybe Region
forward RegionMap {same, old, new} (Region from to)
  | to <= same = Just (Region from to)
  | from >= old = Just (Region (from - old + new) (to - old + new))
  | otherwise = Nothing

-- | The offset in the old text that corresponds to the offset @at@ in the new text. At a point
-- where text was only deleted, it is the offset after the deleted text. 'Nothing' if @at@ lies
-- inside the change.
back :: RegionMap -> Int -> Maybe Int
back RegionMap {same, old, new} at
  | at >= new = Just (at - new + old)
  | at <= same = Just at
  | otherwise = Nothing
