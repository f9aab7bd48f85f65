-- | Places of an old text in a new one. The stretch in which the texts differ is found from both
-- ends; outside it every place has its counterpart.
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

-- | Both texts agree before the first offset, and from the second (in the old) and the third (in
-- the new) to the end.
data RegionMap = RegionMap {same :: Int, old :: Int, new :: Int}
  deriving stock (Eq, Show)

-- | From the old text to the new one. A word that the change touches belongs to the change.
between :: Text -> Text -> RegionMap
between before after =
  RegionMap
    { same = Text.length prefix - length cutFront,
      old = Text.length before - kept,
      new = Text.length after - kept
    }
  where
    (prefix, before', after') = common before after
    (suffix, left, right) = commonEnd before' after'
    touches =
      any
        (Text.any isWordPart)
        [Text.take 1 before', Text.take 1 after', Text.takeEnd 1 left, Text.takeEnd 1 right]
    cutFront = if touches then Text.unpack (Text.takeWhileEnd isWordPart prefix) else ""
    cutBack = if touches then Text.takeWhile isWordPart suffix else ""
    kept = Text.length suffix - Text.length cutBack

common :: Text -> Text -> (Text, Text, Text)
common a b = Maybe.fromMaybe ("", a, b) (Text.commonPrefixes a b)

commonEnd :: Text -> Text -> (Text, Text, Text)
commonEnd a b = (Text.takeEnd size a, Text.dropEnd size a, Text.dropEnd size b)
  where
    size =
      length
        (takeWhile id (zipWith (==) (Text.unpack (Text.reverse a)) (Text.unpack (Text.reverse b))))

isWordPart :: Char -> Bool
isWordPart c = isAlphaNum c || c == '_'

-- | Where a stretch of the old text is in the new one, if it is there unchanged.
forward :: RegionMap -> Region -> Maybe Region
forward RegionMap {same, old, new} (Region from to)
  | to <= same = Just (Region from to)
  | from >= old = Just (Region (from - old + new) (to - old + new))
  | otherwise = Nothing

-- | Where an offset of the new text was in the old one. Where something was only taken out, what
-- begins there is what stood behind it.
back :: RegionMap -> Int -> Maybe Int
back RegionMap {same, old, new} at
  | at >= new = Just (at - new + old)
  | at <= same = Just at
  | otherwise = Nothing
