-- | All mentions of the name under the cursor.
module Query.Reference
  ( References (..),
    references,
  )
where

import Base.Region (Region)
import Base.Region qualified as Region
import Data.Containers.ListUtils (nubOrd)
import Data.List (sort)
import Data.Maybe (listToMaybe, mapMaybe)
import Query.Mention (Mention)
import Query.Mention qualified as Mention
import Query.Name (Found (..))
import Query.Name qualified as Name
import Query.RegionMap qualified as RegionMap
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot

-- | The mentions of one name, in the order of the text; those in imported files come last.
data References = References
  { -- | the mention under the cursor
    here :: Region,
    -- | the region of the name in its definition; absent for a name of the language
    definition :: Maybe Region,
    -- | all mentions, the definition among them
    places :: [Region]
  }
  deriving stock (Eq, Show)

-- | The mentions of the name at the offset @at@ of the present text. @now@ is the snapshot of the
-- present text, and @before@ the last snapshot without errors, whose mentions are carried over into
-- the present text if that has none there. 'Nothing' if there is no name.
references :: Snapshot -> Maybe Snapshot -> Int -> Maybe References
references now before at = listToMaybe (mapMaybe ofFound (Name.found now before at))
  where
    ofFound (Found origin carry mention place) =
      Just
        References
          { here = place,
            definition = Mention.definition mention >>= carried origin carry,
            places =
              nubOrd (sort (mapMaybe (carried origin carry) (alike origin mention)))
          }
    carried origin carry region = case carry of
      Just regionMap
        | Name.isOwn (Snapshot.source origin) region -> RegionMap.forward regionMap region
        | Region.files (Snapshot.source origin) /= Region.files (Snapshot.source now) -> Nothing
      _ -> Just region

-- | The regions of all mentions of the same name.
alike :: Snapshot -> Mention -> [Region]
alike origin mention =
  [ Mention.place m
    | m <- Mention.mentions (Snapshot.facts origin),
      Mention.word m == Mention.word mention,
      Mention.definition m == Mention.definition mention
  ]
