-- | Answers about the name under the cursor of an editor.
--
-- The answers come from a snapshot: a program with the results of its check. There are two
-- snapshots. One is of the present text, the other of the last text without errors. The second one
-- answers if errors of the present text hide the name. An offset is the number of characters before
-- the cursor.
module Query.Name
  ( Hover (..),
    hover,
    isBuiltIn,
    Target (..),
    definition,

    -- * Mentions under the cursor
    Found (..),
    found,
    isOwn,
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

-- | The name under the cursor: its region, its values, and its meaning in words.
data Hover = Hover
  { place :: Region,
    name :: Text,
    -- | its values in the order of the program; a name in a repetition has one for each time
    values :: [Text],
    meaning :: Text,
    -- | the region of the name in its definition; absent for a name of the language
    definedAt :: Maybe Region
  }
  deriving stock (Eq, Show)

-- | A region in one of the files of a program, to which an editor can jump.
data Target = Target {source :: Source, region :: Region}

-- | Describes the name at the offset @at@ of the present text. @now@ is the snapshot of the present
-- text, and @before@ the last snapshot without errors. 'Nothing' if there is no name.
hover :: Snapshot -> Maybe Snapshot -> Int -> Maybe Hover
hover now before at = shown <$> listToMaybe (found now before at)
  where
    shown (Found origin _ mention place) =
      Hover
        { place,
          name = Mention.word mention,
          values =
            reverse
              [ v
                | (at', v) <- Mention.values (Snapshot.facts origin),
                  Just at' == Mention.definition mention
              ],
          meaning = Mention.meaning mention,
          definedAt = Mention.definition mention
        }

-- | True for a name of the language.
isBuiltIn :: Hover -> Bool
isBuiltIn = null . definedAt

-- | The region that defines the name at the offset @at@ of the present text. @now@ is the snapshot
-- of the present text, and @before@ the last snapshot without errors. 'Nothing' if there is no name
-- or it is built in.
definition :: Snapshot -> Maybe Snapshot -> Int -> Maybe Target
definition now before at = listToMaybe (mapMaybe target (found now before at))
  where
    target (Found origin carry mention _) =
      Mention.definition mention >>= inPresentText (Snapshot.source origin) carry
    inPresentText source carry region = case carry of
      Just regionMap
        | isOwn source region ->
          Target (Snapshot.source now) <$> RegionMap.forward regionMap region
      _ -> Just Target {source, region}

-- | A mention of a name under the cursor. The first field is the snapshot that contains it. The map
-- leads from the text of this snapshot to the present text; it is absent for the present snapshot.
-- The last field is the region of the mention in the present text.
data Found = Found Snapshot (Maybe RegionMap) Mention Region

-- | The mentions at the offset @at@ of the present text. If both snapshots contain one, that of the
-- present snapshot @now@ comes first.
found :: Snapshot -> Maybe Snapshot -> Int -> [Found]
found now before at = present <> maybe [] past before
  where
    present = [Found now Nothing m (Mention.place m) | Just m <- [under (Snapshot.facts now) at]]
    past snapshot =
      let regionMap = RegionMap.between (textOf snapshot) (textOf now)
       in [ Found snapshot (Just regionMap) m here
            | Just at' <- [RegionMap.back regionMap at],
              Just m <- [under (Snapshot.facts snapshot) at'],
              Just here <- [RegionMap.forward regionMap (Mention.place m)]
          ]
    textOf = Region.text . Snapshot.source

-- | The mention that contains the offset @at@; if there is none, the mention that ends at @at@.
under :: Mentions -> Int -> Maybe Mention
under facts at = case find (within (<)) (Mention.mentions facts) of
  Just m -> Just m
  Nothing -> find (within (<=)) (Mention.mentions facts)
  where
    within before m = let Region from to = Mention.place m in from <= at && at `before` to

-- | True if a region lies in the program's own file, and not in an imported file.
isOwn :: Source -> Region -> Bool
isOwn source (Region from _) = from <= Text.length (Region.text source)
