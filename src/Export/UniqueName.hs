-- | Different names for the objects of a file whose own names may be equal.
module Export.UniqueName
  ( distinguished,
  )
where

import Base.Decimal qualified as Decimal
import Data.List (mapAccumL)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text

-- | The names, of which each that is equal to one before it, or to one of @taken@, is followed by
-- @-2@, @-3@ and so on. Upper and lower case count as the same letter, because CAD programs do not
-- distinguish them.
distinguished :: [Text] -> [Text] -> [Text]
distinguished taken = snd . mapAccumL next (Set.fromList (map Text.toCaseFold taken))
  where
    next :: Set Text -> Text -> (Set Text, Text)
    next used name =
      let chosen = free used (name : [name <> "-" <> Decimal.whole k | k <- [2 ..]])
       in (Set.insert (Text.toCaseFold chosen) used, chosen)
    free used candidates = case dropWhile ((`Set.member` used) . Text.toCaseFold) candidates of
      first : _ -> first
      [] -> ""
