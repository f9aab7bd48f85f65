-- | The files that several open programs share, and the mentions of names in them.
--
-- The regions of a program count from the beginning of its own text through all its files. So the
-- same place of a shared file has other regions in other programs. Here a place is given by the
-- identity of the file, and by a region that counts from the beginning of this file.
module Query.SharedFile
  ( OpenProgram (..),
    SharedFile (..),
    FilePlace (..),
    FileMentions (..),
    filesOf,
    inFile,
    inProgram,
    grouped,
    ownPrograms,
  )
where

import Base.Region (Region (..), Source)
import Base.Region qualified as Region
import Data.Containers.ListUtils (nubOrdOn)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import System.FilePath (takeExtension)

-- | A program that is open in the editor. @present@ is the snapshot of its present text, which has
-- no results if @isAnalysed@ is false. @previous@ is the last snapshot whose names had meanings.
data OpenProgram = OpenProgram
  { present :: Snapshot,
    isAnalysed :: Bool,
    previous :: Maybe Snapshot
  }

-- | A file of a program. @base@ is the offset of its first character in the program.
data SharedFile = SharedFile
  { identity :: Text,
    path :: Text,
    base :: Int,
    size :: Int,
    content :: Text
  }
  deriving stock (Eq, Show)

-- | A region of a file, which counts from the beginning of this file, and the file's identity.
data FilePlace = FilePlace {file :: Text, within :: Region}
  deriving stock (Eq, Ord, Show)

-- | All mentions of a name in one file, as regions that count from the beginning of its text.
data FileMentions = FileMentions {mentionsIn :: SharedFile, regions :: [Region]}
  deriving stock (Eq, Show)

-- | The files of a program, its own file first. @identified@ gives the identity of the file with a
-- path.
filesOf :: (Text -> Text) -> Source -> [SharedFile]
filesOf identified source = zipWith shared (scanl after 0 files) files
  where
    files = Region.files source
    after base (_, content) = base + Text.length content + 1
    shared base (path, content) =
      SharedFile {identity = identified path, path, base, size = Text.length content, content}

-- | The place of a region of a program with these files.
inFile :: [SharedFile] -> Region -> Maybe FilePlace
inFile files (Region from to) =
  case [f | f <- files, base f <= from, to <= base f + size f] of
    f : _ -> Just (FilePlace (identity f) (Region (from - base f) (to - base f)))
    [] -> Nothing

-- | The regions of a place in a program with these files. There are none if it does not contain the
-- file, and there are several if it reads the file several times, like the file of two tables.
inProgram :: [SharedFile] -> FilePlace -> [Region]
inProgram files (FilePlace file (Region from to)) =
  [Region (base f + from) (base f + to) | f <- files, identity f == file]

-- | Places grouped by their files, which are among @files@ and stay in the same order. The regions
-- are in the order of the text.
grouped :: [SharedFile] -> Set FilePlace -> [FileMentions]
grouped files places =
  [ FileMentions f found
    | f <- nubOrdOn identity files,
      let found = [within p | p <- Set.toAscList places, file p == identity f],
      not (null found)
  ]

-- | The program of a snapshot, and its imported files as programs of their own: the path and the
-- text of each. A program does not contain all statements of a file that it imports.
ownPrograms :: Snapshot -> [(Text, Text)]
ownPrograms now =
  take 1 files
    <> nubOrdOn fst [f | f <- drop 1 files, takeExtension (Text.unpack (fst f)) == ".part"]
  where
    files = Region.files (Snapshot.source now)
