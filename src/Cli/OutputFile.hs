-- | The files that subcommands write. No output replaces a file from which it is made.
module Cli.OutputFile
  ( writeTapes,
    writeText,
  )
where

import Cli.Error (Error (..))
import Cli.Outcome (exitAfterWriting, failWith, printResult)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Control.Monad (filterM)
import Data.ByteString (ByteString)
import Data.Maybe (listToMaybe)
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

-- | Writes the tapes of a program. The arguments: the program's name in reports, its file, all
-- files of which it is made, the output path of the command line, and the tapes.
writeTapes ::
  Reporter ->
  Text ->
  FilePath ->
  [FilePath] ->
  Maybe FilePath ->
  [(Machine, Tape)] ->
  IO Exit
writeTapes reporter name file sources wanted tapes = do
  destinations <- traverse (destination file wanted (length tapes) . fst) tapes
  clash <- overwritten sources destinations
  case (clash, firstRepeated destinations) of
    (Just path, _) -> failWith reporter name (OverwritesProgram (Text.pack path))
    (Nothing, Just path) -> failWith reporter name (OneForSeveral (Text.pack path))
    (Nothing, Nothing) -> writeAll reporter (zip destinations [bytes | (_, Tape bytes) <- tapes])

-- | The path of a tape. Without an output path it is beside the program. If the output path is a
-- folder, or if there are several tapes (@count@), it is in that folder. Otherwise it is the output
-- path itself.
destination :: FilePath -> Maybe FilePath -> Int -> Machine -> IO FilePath
destination file wanted count machine = case wanted of
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
    MachineName machineName = Machine.name machine
    base = if file == "-" then "stdin" else dropExtension (takeFileName file)
    standard =
      base <.> Text.unpack machineName <.> Text.unpack (Machine.suffix (Machine.medium machine))
    folder = take (length file - length (takeFileName file)) file

-- | The first element that occurs again later in the list.
firstRepeated :: Eq a => [a] -> Maybe a
firstRepeated items = case items of
  [] -> Nothing
  first : more -> if first `elem` more then Just first else firstRepeated more

-- | The first destination that is the same file as one of the sources, even under another path.
overwritten :: [FilePath] -> [FilePath] -> IO (Maybe FilePath)
overwritten sources destinations = do
  present <- filterM doesFileExist sources
  sourcePaths <- traverse canonicalizePath present
  paths <- traverse canonicalizePath destinations
  pure (listToMaybe [given | (path, given) <- zip paths destinations, path `elem` sourcePaths])

-- | Writes files one after the other, up to the first that cannot be written.
writeAll :: Reporter -> [(FilePath, ByteString)] -> IO Exit
writeAll reporter files = case files of
  [] -> pure Done
  (path, bytes) : more -> do
    written <- if path == "-" then Output.resultBytes bytes else Output.writeFileWhole path bytes
    exit <- exitAfterWriting reporter "" (Text.pack path) written
    if exit == Done then writeAll reporter more else pure exit

-- | Writes a text to a file, or to standard output if there is no path or the path is @-@. The
-- arguments: the name of the program in reports, all files of which the text is made, the output
-- path, and the text.
writeText :: Reporter -> Text -> [FilePath] -> Maybe FilePath -> Text -> IO Exit
writeText reporter name sources wanted text = case wanted of
  Just path | path /= "-" -> do
    clash <- overwritten sources [path]
    case clash of
      Just same -> failWith reporter name (OverwritesProgram (Text.pack same))
      Nothing -> writeAll reporter [(path, Encoding.encodeUtf8 text)]
  _ -> printResult reporter text
