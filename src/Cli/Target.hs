-- | The machines to work for: built in or described in files.
module Cli.Target
  ( chosen,
    named,
    known,
  )
where

import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Base.Result qualified as Result
import Cli.Error (Error (..))
import Cli.Error qualified as Cli
import Compile (Analysis (Analysis, part, path), Descriptions, Unknown (..))
import Compile qualified
import Data.Text (Text)
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..))
import Part.Part (MachineRef (..))
import Part.Part qualified as Part
import Report.Report (Report)

-- | The machines that the command line names, or the program's own, set up for the program.
chosen :: Descriptions -> [Text] -> Analysis -> Result w Report [Machine]
chosen descriptions targets Analysis {part, path} =
  Result.mapErrors id Cli.toReport (map (Compile.onMachine path) <$> found)
  where
    found = case (targets, Part.machine part) of
      ([], Nothing) -> Result.failed (NoMachine known)
      ([], Just (Located region (Named n))) ->
        pure <$> look (Just region) n (Compile.machineNamed n)
      ([], Just (Located region (Described file))) ->
        pure <$> look (Just region) file (Compile.machineIn descriptions file)
      (some, _) -> traverse (\n -> look Nothing n (Compile.machineFor descriptions n)) some
    look region n = either (Result.failed . unknown region n) pure

-- | The machine of the command line, for commands that have no program.
named :: Descriptions -> Text -> Either Error Machine
named descriptions n = either (Left . unknown Nothing n) Right (Compile.machineFor descriptions n)

-- | Why a machine cannot be had, and where the program asks for it.
unknown :: Maybe Region -> Text -> Unknown -> Error
unknown region n why = case why of
  NoSuchMachine -> UnknownMachine region n known
  NoDescription reason -> DescriptionMissing region n reason
  BadDescription text reports -> DescriptionWrong region n text reports

-- | The names of the machines that are built in.
known :: [Text]
known = [n | MachineName n <- BuiltIn.names]
