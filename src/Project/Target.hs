-- | The machines for which a program is compiled: those that the command line names, or else the
-- one that the program names.
module Project.Target
  ( targets,
    ownMachines,
    setUpFor,
    machineNamed,
    builtInNames,
  )
where

import Base.Quantity (LengthUnit (..))
import Base.Region (Located (..), Region)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.Text (Text)
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Part.Part (MachineRef (..), Part)
import Part.Part qualified as Part
import Project.Error (Error (..))
import Project.Error qualified as Project
import Project.MachineDescription (Descriptions, Missing (..))
import Project.MachineDescription qualified as MachineDescription
import Report.Report (Report)
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | The machines with the given @names@, prepared by 'setUpFor'. If there are no names, the only
-- machine is that of the program's @machine@ statement. If there is no such statement either, the
-- result is an error.
targets :: Descriptions -> [Text] -> Part -> Toolpath -> Result w Report [Machine]
targets descriptions names part path =
  Result.mapErrors id Project.toReport $
    map (setUpFor path) <$> case (names, Part.machine part) of
      ([], Nothing) -> Result.failed (NoMachine builtInNames (machineOffset part))
      ([], Just reference) -> pure <$> ownMachine descriptions reference
      (some, _) -> traverse (Result.fromEither . machineNamed descriptions) some

-- | The machine that the program names, prepared by 'setUpFor' for milling or for turning. The list
-- is empty if the program names no machine.
ownMachines :: Descriptions -> Part -> Toolpath -> Result w Report [Machine]
ownMachines descriptions part path = case Part.machine part of
  Nothing -> pure []
  Just _ -> targets descriptions [] part path

-- | The offset at which a program may name a machine: before the start of the cutter.
machineOffset :: Part -> Maybe Int
machineOffset part = (\(Located at _) -> Region.start at) <$> Part.start part

-- | Prepares a machine description for a toolpath: for turning, some machines reverse axes; for a
-- program in inches, modern controls get files in inches.
setUpFor :: Toolpath -> Machine -> Machine
setUpFor path machine = case Toolpath.unit path of
  Millimetres -> turned
  Inches -> Machine.inInches turned
  where
    turned = if Toolpath.isTurned path then Machine.forTurning machine else machine

-- | The machine that the @machine@ statement of the program names.
ownMachine :: Descriptions -> Located MachineRef -> Result w Error Machine
ownMachine descriptions (Located region reference) = case reference of
  Named name -> found name (MachineDescription.findBuiltIn name)
  Described file -> found file (MachineDescription.findDescribed descriptions file)
  where
    found name = either (Result.failed . missing (Just region) name) pure

-- | Finds a machine that the command line names: a built-in machine, or a description file.
machineNamed :: Descriptions -> Text -> Either Error Machine
machineNamed descriptions name =
  either (Left . missing Nothing name) Right (MachineDescription.find descriptions name)

-- | The error for the machine @name@, which cannot be used because of @why@. @region@ is the region
-- of the machine's name in the program. It is 'Nothing' if the command line names the machine.
missing :: Maybe Region -> Text -> Missing -> Error
missing region name why = case why of
  NoSuchMachine -> UnknownMachine region name builtInNames
  NoDescription reason -> DescriptionMissing region name reason
  BadDescription described reports -> DescriptionWrong region name described reports

-- | The names of the built-in machines.
builtInNames :: [Text]
builtInNames = [name | MachineName name <- BuiltIn.names]
