-- | The files that subcommands write. An output that would replace one of its sources is refused.
-- The sources are the files of which it is made: the program, the programs and tables that it
-- imports, and its machine descriptions.
module Cli.OutputFile
  ( TapeOutput (..),
    writeTapes,
    tapeNames,
    numbered,
    writeText,
    writeBytes,
    unlessSource,
  )
where

import Base.Decimal qualified as Decimal
import Cli.Error (Error (..))
import Cli.Outcome (exitAfterWriting, failWith, printResult)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Control.Monad (filterM)
import Data.ByteString (ByteString)
import Data.Maybe (listToMaybe, maybeToList)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import System.Directory (canonicalizePath, doesDirectoryExist, doesFileExist)
import System.FilePath
  ( dropExtension,
    hasTrailingPathSeparator,
    replaceDirectory,
    takeFileName,
    (<.>),
    (</>),
  )
import Tape.Tape (Tape (..))

-- | A tape to write: its machine, the word for its tool if each tool has a file of its own, and its
-- rows.
data TapeOutput = TapeOutput {machine :: Machine, toolWord :: Maybe Text, content :: Tape}

-- | Words for the files of tools: @T@ with the number. A tool that comes again has the number of
-- its turn behind it, as in @T1-2@. Nothing for a file of all tools.
numbered :: [Maybe Int] -> [Maybe Text]
numbered tools = zipWith word [0 ..] tools
  where
    word k tool = case tool of
      Nothing -> Nothing
      Just n -> Just ("T" <> Decimal.whole n <> turn (length (filter (== tool) (take k tools))))
    turn before = if before == 0 then "" else "-" <> Decimal.whole (before + 1)

-- | Names of the files of a program, from its path, for the tools of these files.
tapeNames :: FilePath -> Machine -> [Maybe Int] -> [FilePath]
tapeNames file machine tools =
  [standardName file (TapeOutput machine word (Tape "")) | word <- numbered tools]

-- | Writes the tapes of a program. @name@ is the program's name in reports, @file@ its path.
-- @sources@ are the files that must not be replaced. @wanted@ is the output path of the command
-- line, if there is one. Nothing is written if two tapes have the same destination,
-- or if there is no folder for several tapes.
writeTapes ::
  Reporter ->
  Text ->
  FilePath ->
  [FilePath] ->
  Maybe FilePath ->
  [TapeOutput] ->
  IO Exit
writeTapes reporter name file sources wanted tapes = do
  destinations <- traverse (destination file wanted (length tapes)) tapes
  clash <- overwritten sources destinations
  noFolder <- filterM (fmap not . doesDirectoryExist) [p | Just p <- [wanted], isForSeveral p]
  case (clash, firstRepeated destinations, noFolder) of
    (Just path, _, _) -> failWith reporter name (OverwritesProgram (Text.pack path))
    (Nothing, Just path, _) -> failWith reporter name (OneForSeveral (Text.pack path))
    (Nothing, Nothing, path : _) ->
      failWith reporter name (NoFolder (Text.pack path) (length tapes))
    (Nothing, Nothing, []) ->
      writeAll reporter (zip destinations (map (bytesOf . content) tapes))
  where
    bytesOf (Tape bytes) = bytes
    isForSeveral path = path /= "-" && length tapes > 1

-- | The path of a tape; @-@ is standard output. @file@ is the path of the program,
-- @wanted@ the output path of the command line, and @count@ the count of all tapes. Without an
-- output path the tape is put into the program's folder. If there are several tapes, the output
-- path is the folder into which they are put. For one tape it is a folder if it exists as one or
-- ends with a slash; otherwise it is the path of the tape itself.
destination :: FilePath -> Maybe FilePath -> Int -> TapeOutput -> IO FilePath
destination file wanted count output = case wanted of
  Nothing -> pure (if file == "-" then standard else replaceDirectory standard folder)
  Just "-" -> pure "-"
  Just path -> do
    isFolder <- doesDirectoryExist path
    pure
      ( if isFolder || hasTrailingPathSeparator path || count > 1
          then path </> standard
          else path
      )
  where
    standard = standardName file output
    folder = take (length file - length (takeFileName file)) file

-- | The name of the file of a tape, without a folder: that of the program, the machine, the tool.
standardName :: FilePath -> TapeOutput -> FilePath
standardName file TapeOutput {machine, toolWord} =
  foldl (<.>) base (map Text.unpack ([machineName] <> maybeToList toolWord <> [suffix]))
  where
    MachineName machineName = Machine.name machine
    base = if file == "-" then "stdin" else dropExtension (takeFileName file)
    suffix = Machine.suffix (Machine.medium machine)

-- | The first element that occurs again later in the list; nothing if all elements differ.
firstRepeated :: Eq a => [a] -> Maybe a
firstRepeated items = case items of
  [] -> Nothing
  first : more -> if first `elem` more then Just first else firstRepeated more

-- | The first destination that is the same file as one of the sources; the two paths of this file
-- may differ. Nothing if no source would be replaced.
overwritten :: [FilePath] -> [FilePath] -> IO (Maybe FilePath)
overwritten sources destinations = do
  present <- filterM doesFileExist sources
  sourcePaths <- traverse canonicalizePath present
  paths <- traverse canonicalizePath destinations
  pure (listToMaybe [given | (path, given) <- zip paths destinations, path `elem` sourcePaths])

-- | Writes bytes to each path, in the order of the list; @-@ is standard output. It stops at the
-- first path that cannot be written.
writeAll :: Reporter -> [(FilePath, ByteString)] -> IO Exit
writeAll reporter files = case files of
  [] -> pure Done
  (path, bytes) : more -> do
    written <- if path == "-" then Output.resultBytes bytes else Output.writeFileWhole path bytes
    exit <- exitAfterWriting reporter "" (Text.pack path) written
    if exit == Done then writeAll reporter more else pure exit

-- | Writes a text to the file @wanted@, or to standard output if this is nothing or @-@. @name@ is
-- the program's name in reports. @sources@ are the files that must not be replaced.
writeText :: Reporter -> Text -> [FilePath] -> Maybe FilePath -> Text -> IO Exit
writeText reporter name sources wanted text = case wanted of
  Just path | path /= "-" -> writeBytes reporter name sources path (Encoding.encodeUtf8 text)
  _ -> printResult reporter text

-- | Writes bytes to a file. @name@ is the program's name in reports. @sources@ are the files that
-- must not be replaced.
writeBytes :: Reporter -> Text -> [FilePath] -> FilePath -> ByteString -> IO Exit
writeBytes reporter name sources path bytes =
  unlessSource reporter name sources path (writeAll reporter [(path, bytes)])

-- | Does something with an output file, unless it is one of the sources.
unlessSource :: Reporter -> Text -> [FilePath] -> FilePath -> IO Exit -> IO Exit
unlessSource reporter name sources path act = do
  clash <- overwritten sources [path]
  case clash of
    Just same -> failWith reporter name (OverwritesProgram (Text.pack same))
    Nothing -> act
