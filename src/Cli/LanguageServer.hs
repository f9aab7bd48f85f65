-- | The command @partc lsp@: serves an editor on standard input and output.
module Cli.LanguageServer
  ( serve,
  )
where

import Cli.InputFile (identity, readContents, readerFrom)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Conversation (Ending (..))
import Lsp.Server (Host (..))
import Lsp.Server qualified as Server
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot qualified as Snapshot
import Query.TapeFacts qualified as TapeFacts
import System.Exit (ExitCode (..))
import System.IO (stdin, stdout)
import System.Posix.Process (exitImmediately)

-- | Serves an editor until it ends the conversation. The texts of documents that are open in the
-- editor take precedence over their files on the disk.
serve :: Reporter -> IO Exit
serve reporter = do
  ending <-
    Server.serve
      Host
        { input = stdin,
          output = stdout,
          load = loadWith,
          check = Snapshot.checkWith values,
          prove = TapeFacts.tapeFacts values
        }
  -- An orderly end of the run-time system would collect the garbage of a large analysis first.
  exitImmediately $ case ending of
    Orderly -> ExitSuccess
    Abrupt -> ExitFailure 1
  pure Done
  where
    values = Output.values (Output.settings reporter)

-- | Loads a program with its imports. @texts@ has the paths and the texts of the open documents. A
-- document is found under every path that leads to its file.
loadWith :: [(Text, Text)] -> Text -> Text -> IO LoadedProgram
loadWith texts path text = do
  byIdentity <- Map.fromList <$> traverse identified texts
  loaded <- LoadedProgram.load (readerFrom (contents byIdentity)) (Text.unpack path) text
  others <- traverse (identity . Text.unpack) (LoadedProgram.files loaded)
  let files = LoadedProgram.files loaded <> concatMap (names byIdentity) others
  pure loaded {LoadedProgram.files}
  where
    identified open@(file, _) = (,open) <$> identity (Text.unpack file)
    contents byIdentity file = do
      there <- identity file
      maybe (readContents file) (pure . Right . snd) (Map.lookup there byIdentity)

-- | The canonical path of a file, and the path under which it is open in the editor, if it is.
names :: Map FilePath (Text, Text) -> FilePath -> [Text]
names byIdentity there = Text.pack there : [file | Just (file, _) <- [Map.lookup there byIdentity]]
