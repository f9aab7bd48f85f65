-- | The programs of test/gcode with the files that the compiler writes for them.
module GcodeSubject
  ( Subject (..),
    programs,
    subjectOf,
    judged,
  )
where

import Base.Result qualified as Result
import Compile (Analysis (..), Compiled (..), Punched (..))
import Compile qualified
import Data.List (sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (filesBelow, readText)
import Gcode.Block (Fault)
import Gcode.Heading qualified as Heading
import Gcode.Writer (ToolFile (fileText))
import Machine.Machine (ProgramForm)
import Machine.Machine qualified as Machine
import Machines qualified
import Part.Part (Part)
import Project.LoadedProgram qualified as LoadedProgram
import System.FilePath (takeExtension)
import Verify.FromGcode qualified as FromGcode
import Verify.Proof (Proof)

-- | A program with its own file.
data Subject = Subject
  { name :: FilePath,
    form :: ProgramForm,
    compiled :: Compiled,
    evaluated :: Part,
    own :: Text
  }

-- | The paths of the programs.
programs :: IO [FilePath]
programs = sort . filter ((== ".part") . takeExtension) <$> filesBelow "test/gcode"

-- | Compiles a program.
subjectOf :: FilePath -> IO Subject
subjectOf file = do
  text <- readText file
  let loaded = LoadedProgram.fromText (Text.pack file) text
      job = Machines.jobFor (Machines.named "linuxcnc-mill") []
  case (Result.output (Compile.compile job loaded), Result.output (Compile.analyse [] loaded)) of
    (Just [c], Just Analysis {part})
      | [f] <- files (punched c),
        Just form <- Machine.programForm (machine c) ->
        pure
          Subject {name = file, form, compiled = c, evaluated = part, own = fileText f}
    _ -> fail (file <> " has no file")

-- | Proof of a file for a program; a fault if it cannot be read.
judged :: Subject -> Text -> Either Fault Proof
judged Subject {form, compiled, evaluated} text =
  Compile.proveGcode form (Just evaluated) compiled
    <$> FromGcode.readTexts
      (machine compiled)
      form
      (Heading.fromToolpath (toolpath compiled))
      (program (punched compiled))
      [text]
