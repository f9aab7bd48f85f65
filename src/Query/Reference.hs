-- | All mentions of the name under the cursor, in its program and in other open programs.
module Query.Reference
  ( References (..),
    references,
    SharedReferences (..),
    sharedReferences,
  )
where

import Base.Region (Region)
import Base.Region qualified as Region
import Data.Containers.ListUtils (nubOrd)
import Data.List (sort)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Project.LoadedProgram qualified as LoadedProgram
import Query.Mention (Mention)
import Query.Mention qualified as Mention
import Query.Name (Found (..))
import Query.Name qualified as Name
import Query.RegionMap qualified as RegionMap
import Query.SharedFile (FileMentions, FilePlace (..), OpenProgram (..), SharedFile (..))
import Query.SharedFile qualified as SharedFile
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot

-- | The mentions of one name, in the order of the text; those in imported files come last.
data References = References
  { -- | the mention under the cursor
    here :: Region,
    -- | the name
    name :: Text,
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
            name = Mention.word mention,
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

-- | The mentions of one name in several programs, by their files, and the place of its definition.
-- The files of the program in which the name was asked for come first.
data SharedReferences = SharedReferences
  { definedAt :: Maybe FilePlace,
    mentions :: [FileMentions]
  }
  deriving stock (Eq, Show)

-- | The mentions, by files, of the name at the offset @at@ of the present text. They are looked for
-- in the program of the snapshot @now@, in its imported files as programs of their own, and in all
-- other open programs that share the file of the definition. @before@ is the last snapshot without
-- errors, as for 'references'. A name of the language is looked for in the one program only.
sharedReferences ::
  [OpenProgram] ->
  Snapshot ->
  Maybe Snapshot ->
  Int ->
  Maybe SharedReferences
sharedReferences others now before at = ofOwn <$> references now before at
  where
    own = filesOf now
    snapshots = map informed others
    files = own <> concatMap (filesOf . present) others <> concatMap filesOf snapshots
    texts = Map.fromListWith (\_ first' -> first') [(identity f, content f) | f <- files]
    ofOwn found =
      SharedReferences
        { definedAt = definition found >>= SharedFile.inFile own,
          mentions =
            SharedFile.grouped
              files
              ( Set.fromList
                  (mapMaybe (SharedFile.inFile own) (places found) <> elsewhere found)
              )
        }
    elsewhere found =
      [ place
        | Just d <- [definition found >>= SharedFile.inFile own],
          (inProgram, ms) <-
            [(filesOf s, Mention.mentions (Snapshot.facts s)) | s <- snapshots]
              <> concatMap (importedPrograms (name found)) (now : snapshots),
          place <- placesOf texts inProgram d [m | m <- ms, Mention.word m == name found]
      ]

-- | The snapshot of an open program that knows the meanings of its names.
informed :: OpenProgram -> Snapshot
informed OpenProgram {present, previous}
  | Snapshot.hasFacts present = present
  | otherwise = fromMaybe present previous

filesOf :: Snapshot -> [SharedFile]
filesOf now = SharedFile.filesOf (Snapshot.identityOf now) (Snapshot.source now)

-- | The imported files of a snapshot that contain a word, as programs of their own: the files and
-- the mentions of each.
importedPrograms :: Text -> Snapshot -> [([SharedFile], [Mention])]
importedPrograms word now =
  [ ( SharedFile.filesOf (Snapshot.identityOf now) (LoadedProgram.source loaded),
      Mention.ofLoaded loaded
    )
    | (path, text) <- drop 1 (SharedFile.ownPrograms now),
      word `Text.isInfixOf` text,
      let loaded = Snapshot.loadedWith now [] path text
  ]

-- | The places of those mentions that have the definition @d@, in the present texts of their files.
-- @texts@ are these texts by the identities of the files.
placesOf :: Map Text Text -> [SharedFile] -> FilePlace -> [Mention] -> [FilePlace]
placesOf texts files d ms =
  [ place
    | m <- ms,
      (Mention.definition m >>= carried) == Just d,
      Just place <- [carried (Mention.place m)]
  ]
  where
    carried region = SharedFile.inFile files region >>= toPresent
    toPresent place@(FilePlace i region) =
      case (listToMaybe [content f | f <- files, identity f == i], Map.lookup i texts) of
        (Just old, Just new)
          | old /= new -> FilePlace i <$> RegionMap.forward (RegionMap.between old new) region
        _ -> Just place
