-- | Questions about the name under the cursor.
--
-- They are answered from the present text, and where that is too broken to know the name, from the
-- last text that was sound.
module Query.Name
  ( Hover (..),
    hover,
    Target (..),
    definition,
  )
where

import Base.Region (Region (..), Source)
import Base.Region qualified as Region
import Data.Foldable (find)
import Data.Maybe (listToMaybe, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Query.Mention (Mention, Mentions)
import Query.Mention qualified as Mention
import Query.RegionMap (RegionMap)
import Query.RegionMap qualified as RegionMap
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot

-- | The name where the cursor is, its value if it has one, what it is.
data Hover = Hover {place :: Region, name :: Text, value :: Maybe Text, meaning :: Text}
  deriving stock (Eq, Show)

-- | A stretch of one of the files of a source.
data Target = Target {source :: Source, region :: Region}

-- | What is known of the name at an offset of the present text. The other snapshot is the last
-- sound one.
hover :: Snapshot -> Maybe Snapshot -> Int -> Maybe Hover
hover now before at = said <$> listToMaybe (found now before at)
  where
    said (Found origin _ mention place) =
      Hover
        { place,
          name = Mention.word mention,
          value =
            Mention.definition mention >>= \d -> lookup d (Mention.values (Snapshot.facts origin)),
          meaning = Mention.meaning mention
        }

-- | Where the name at an offset is defined.
definition :: Snapshot -> Maybe Snapshot -> Int -> Maybe Target
definition now before at = listToMaybe (mapMaybe target (found now before at))
  where
    target (Found origin carry mention _) =
      Mention.definition mention >>= placed (Snapshot.source origin) carry
    placed source carry region = case carry of
      Just moved
        | isOwn source region ->
          Target (Snapshot.source now) <$> RegionMap.forward moved region
      _ -> Just Target {source, region}

-- | A mention under the cursor: the snapshot that knows it, how that one's text became the present
-- one if it is an older one, and the place of the mention in the present text.
data Found = Found Snapshot (Maybe RegionMap) Mention Region

found :: Snapshot -> Maybe Snapshot -> Int -> [Found]
found now before at = present <> maybe [] past before
  where
    present = [Found now Nothing m (Mention.place m) | Just m <- [under (Snapshot.facts now) at]]
    past snapshot =
      let moved = RegionMap.between (textOf snapshot) (textOf now)
       in [ Found snapshot (Just moved) m here
            | Just at' <- [RegionMap.back moved at],
              Just m <- [under (Snapshot.facts snapshot) at'],
              Just here <- [RegionMap.forward moved (Mention.place m)]
          ]
    textOf = Region.text . Snapshot.source

-- | The mention that an offset lies in, or else the one that it ends.
under :: Mentions -> Int -> Maybe Mention
under facts at = case find (within (<)) (Mention.mentions facts) of
  Just m -> Just m
  Nothing -> find (within (<=)) (Mention.mentions facts)
  where
    within before m = let Region from to = Mention.place m in from <= at && at `before` to

-- | Whether a stretch lies in the program's own file.
isOwn :: Source -> Region -> Bool
isOwn source place = start place <= Text.length (Region.text source)
