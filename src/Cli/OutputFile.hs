-- | The files that commands write. No output replaces a file that it was made from.
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

-- | Writes the tapes of a program: its name in reports, its file, the files that it is made of, and
-- the output path of the command line.
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

-- | The path of a tape: beside the program, in a folder, or exactly as the command line says. The
-- count is that of all tapes of the run.
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

firstRepeated :: Eq a => [a] -> Maybe a
firstRepeated items = case items of
  [] -> Nothing
  first : more -> if first `elem` more then Just first else firstRepeated more

-- | The first destination that is one of these source files, by whatever path.
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

-- | Writes a text to a file, or to standard output if there is no path or the path is @-@.
writeText :: Reporter -> Text -> [FilePath] -> Maybe FilePath -> Text -> IO Exit
writeText reporter name sources wanted text = case wanted of
  Just path | path /= "-" -> do
    clash <- overwritten sources [path]
    case clash of
      Just same -> failWith reporter name (OverwritesProgram (Text.pack same))
      Nothing -> writeAll reporter [(path, Encoding.encodeUtf8 text)]
  _ -> printResult reporter text
