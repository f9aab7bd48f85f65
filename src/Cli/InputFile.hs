-- | The files that subcommands read: part programs with all files that they need, tapes, and
-- machine descriptions.
module Cli.InputFile
  ( Input (..),
    source,
    withoutSurface,
    withInput,
    ownFiles,
    readProgram,
    loadText,
    readBytes,
    readerFrom,
    identity,
    readContents,
    descriptionsFor,
    displayName,
  )
where

import Base.Region (Source)
import Cli.Error (Error (..))
import Cli.Error qualified as Cli
import Cli.Outcome (failWith)
import Cli.Output (Exit, Reporter)
import Cli.Output qualified as Output
import Control.Exception (IOException, try)
import Control.Monad (filterM)
import Data.ByteString (ByteString)
import Data.List (sort)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Font.TrueType qualified as TrueType
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Project.MachineDescription (Descriptions)
import Project.MachineDescription qualified as MachineDescription
import Surface.Import qualified as Import
import System.Directory (canonicalizePath, doesFileExist, listDirectory)
import System.FilePath (takeDirectory, (</>))

-- | A loaded program, its name in reports, and the names and values of the parameters that the
-- command line sets.
data Input = Input {name :: Text, loaded :: LoadedProgram, values :: [(Text, Text)]}

-- | The text of a program with the texts of its imports, to which the regions in reports refer.
source :: Input -> Source
source = LoadedProgram.source . loaded

-- | Drops the syntax tree of a program, to free its memory. The tree of a large program takes more
-- memory than its toolpath and its tape.
withoutSurface :: Input -> Input
withoutSurface input = input {loaded = LoadedProgram.withoutSurface (loaded input)}

-- | Loads a program, its imports and its machine descriptions, and continues with them. The
-- descriptions are those that the program names and those in @targets@, which the command line
-- names. The command fails with a report if the program cannot be read, or if the command line
-- sets parameters of an input sheet.
withInput :: Reporter -> FilePath -> [Text] -> (Input -> IO Exit) -> IO Exit
withInput reporter file targets continue = do
  content <- readProgram file
  case content of
    Left e -> failWith reporter (displayName file) e
    Right _
      | LoadedProgram.isInputSheet file,
        (parameter, _) : _ <- values ->
        failWith reporter (displayName file) (SheetAssigned parameter)
    Right text -> do
      loaded <- loadText targets (displayName file) text
      continue Input {name = displayName file, loaded, values}
  where
    values = Output.values (Output.settings reporter)

-- | Loads a program from its text, with its imports and with the descriptions of machines that it
-- and @targets@ name. @name@ is the path to which imports are relative.
loadText :: [Text] -> Text -> Text -> IO LoadedProgram
loadText targets name text = do
  program <- LoadedProgram.load (readerFrom readContents) (Text.unpack name) text
  descriptions <- descriptionsFor targets (LoadedProgram.descriptions program)
  pure program {LoadedProgram.descriptions}

-- | The paths of the files from which a program is compiled: the program itself, the programs and
-- tables that it imports, its machine descriptions. No output may replace them.
ownFiles :: FilePath -> Input -> [FilePath]
ownFiles file input = file : imported <> concatMap asWritten described
  where
    imported = map (Text.unpack . snd) (LoadedProgram.imports (loaded input))
    described = map (Text.unpack . fst) (LoadedProgram.descriptions (loaded input))
    -- A description's path is relative to the current folder if the command line names it, and to
    -- the program's folder if the program does. It is not known here which of them did.
    asWritten description = [description, takeDirectory file </> description]

-- | A reader of imported files that gets their texts from @contents@. It compares files by their
-- canonical paths, so a file with two paths is imported only once.
readerFrom :: (FilePath -> IO (Either Text Text)) -> Import.Reader IO
readerFrom contents =
  Import.Reader {Import.contents, Import.bytes, Import.glyphs, Import.identity, Import.listing}
  where
    bytes path = either (Left . Cli.reason) Right <$> readBytes path
    glyphs path text = bytes path >>= traverse (`TrueType.glyphs` text)

-- | The names of the files in a folder; none if it cannot be read.
listing :: FilePath -> IO [FilePath]
listing folder = do
  names <- either (const [] :: IOException -> [FilePath]) sort <$> try (listDirectory folder)
  filterM (doesFileExist . (folder </>)) names

-- | The canonical path of a file: the same for all paths that lead to it.
identity :: FilePath -> IO FilePath
identity path = either (const path :: IOException -> FilePath) id <$> try (canonicalizePath path)

-- | The text of a file on the disk, or the reason why it cannot be read.
readContents :: FilePath -> IO (Either Text Text)
readContents file = either (Left . Cli.reason) Right <$> readProgram file

-- | The text of a program file, or of standard input for @-@, without a byte order mark. The error
-- is 'CannotRead' or 'NotUtf8'.
readProgram :: FilePath -> IO (Either Error Text)
readProgram file = do
  bytes <- readBytes file
  pure $ case fmap Encoding.decodeUtf8' bytes of
    Left e -> Left e
    Right (Left _) -> Left NotUtf8
    Right (Right text) -> Right (fromMaybe text (Text.stripPrefix "\xFEFF" text))

-- | The bytes of a file, or of standard input for @-@.
readBytes :: FilePath -> IO (Either Error ByteString)
readBytes file = either (Left . CannotRead) Right <$> Output.readBytes file

-- | Loads the machine descriptions that the command line names in @targets@, and puts them before
-- @own@, the descriptions of the program. The names of built-in machines in @targets@ are skipped,
-- because these machines have no file.
descriptionsFor :: [Text] -> Descriptions -> IO Descriptions
descriptionsFor targets own =
  (<> own)
    <$> traverse
      (MachineDescription.load readContents "")
      (filter MachineDescription.isFileName targets)

-- | The name of a file in reports; @\<stdin>@ for standard input.
displayName :: FilePath -> Text
displayName file = if file == "-" then "<stdin>" else Text.pack file
